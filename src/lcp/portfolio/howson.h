#include "base/base.h"
#include "rollbem/lcp.h"

/* The path of Lemke and Howson on two tableaus of the type REAL.  bimatrix.c includes this
 * file twice: where rounding errors have spoilt the path of doubles, that of long doubles
 * follows.  IN(name): a name of its own for each; CANCELLED: the part of their terms below
 * which differences are zero. */

/* s = 1 - P v >= 0, v >= 0: the best replies of one player, P the other player's payoffs
 * made positive.  A column per label: a label belongs to a strategy, that is to one v
 * and, in the other tableau, to one s.  Row-major: rows of labels + 1 numbers, the last
 * one the right-hand side. */
typedef struct {
    int rows, width;
    REAL *T;    /* rows x width */
    int *basis; /* rows: labels */
    int first;  /* label of the s of row 0 */
} IN(tableau);

static REAL *IN(row_of)(const IN(tableau) * t, int row)
{
    return t->T + (size_t)row * (size_t)t->width;
}

/* In an arena that may have failed. */
static void IN(tableau_create)(int rows, int labels, int first, rb_arena *memory, IN(tableau) * t)
{
    *t = (IN(tableau)){.rows = rows, .width = labels + 1, .first = first};
    t->T = rb_arena_zeros(memory, (size_t)rows * ((size_t)labels + 1), sizeof *t->T);
    t->basis = rb_arena_ints(memory, (size_t)rows);
    for (int r = 0; r < rows && !memory->failed; r++) {
        IN(row_of)(t, r)[first + r] = 1.0;
        IN(row_of)(t, r)[labels] = 1.0;
        t->basis[r] = first + r;
    }
}

/* The row that blocks the entering label: least ratio of the right-hand side, then of the
 * columns of s, which are the basis inverse, one after the other (lexicographic). */
static int IN(blocking_row)(const IN(tableau) * t, int entering, int *tied)
{
    int count = 0;
    for (int r = 0; r < t->rows; r++)
        if (IN(row_of)(t, r)[entering] > 0.0)
            tied[count++] = r;
    for (int k = -1; k < t->rows && count > 1; k++) {
        const int column = k < 0 ? t->width - 1 : t->first + k;
        REAL least = INFINITY, size = 0.0;
        int kept = 0;
        for (int i = 0; i < count; i++) {
            const REAL *row = IN(row_of)(t, tied[i]), ratio = row[column] / row[entering];
            least = ratio < least ? ratio : least;
            size = fabs(ratio) > size ? fabs(ratio) : size;
        }
        for (int i = 0; i < count; i++) {
            const REAL *row = IN(row_of)(t, tied[i]);
            if (row[column] / row[entering] - least <= SAME * fmax(fabs(least), SAME * size))
                tied[kept++] = tied[i];
        }
        count = kept;
    }
    return count ? tied[0] : -1;
}

static void IN(pivot)(IN(tableau) * t, int row, int entering)
{
    REAL *own = IN(row_of)(t, row);
    const REAL by = 1.0 / own[entering];
    for (int k = 0; k < t->width; k++)
        own[k] *= by;
    own[entering] = 1.0;
    for (int r = 0; r < t->rows; r++) {
        REAL *other = IN(row_of)(t, r);
        const REAL factor = other[entering];
        if (r == row || factor == 0.0)
            continue;
        for (int k = 0; k < t->width; k++) {
            const REAL before = other[k], x = before - factor * own[k];
            other[k] = fabs(x) <= CANCELLED * fabs(before) ? (REAL)0.0 : x;
        }
        other[entering] = 0.0;
        if (other[t->width - 1] < 0.0) /* rounding of a tie */
            other[t->width - 1] = 0.0;
    }
    t->basis[row] = entering;
}

/* x = the v of the tableau, which add up to 1. */
static void IN(strategy)(const IN(tableau) * t, int first, int count, double *x)
{
    double sum = 0.0;
    memset(x, 0, (size_t)count * sizeof *x);
    for (int r = 0; r < t->rows; r++) {
        const int k = t->basis[r] - first;
        if (k >= 0 && k < count)
            sum += x[k] = fmax((double)IN(row_of)(t, r)[t->width - 1], 0.0);
    }
    if (sum > 0.0)
        cblas_dscal(count, 1.0 / sum, x, 1);
}

/* Drops the label, and then in turn every label that the last pivot has doubled, from the
 * tableau where it can enter, until the dropped one is back.  z = (x, y).  RB_NUMERICAL:
 * rounding errors; RB_MAXITER, RB_TIME_LIMIT, RB_ENOMEM. */
static rb_status IN(follow_path)(const howson_game *g, int dropped, const rb_lcp_options *opt,
                                 double began, double *z, rb_lcp_info *info)
{
    const int m = g->m, n = g->n, labels = m + n, before = info->iters;
    rb_arena memory = {0};
    IN(tableau) of_x, of_y, *t = dropped < m ? &of_x : &of_y;
    int *tied = rb_arena_ints(&memory, (size_t)labels);
    IN(tableau_create)(n, labels, m, &memory, &of_x);
    IN(tableau_create)(m, labels, 0, &memory, &of_y);
    if (memory.failed)
        return rb_arena_done(&memory, RB_ENOMEM);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < m; i++) {
            IN(row_of)(&of_x, j)[i] = 1.0 + g->b[i + j * m];
            IN(row_of)(&of_y, i)[m + j] = 1.0 + g->a[i + j * m];
        }
    /* No basis comes twice on an exact path: each is compared with one that is kept, which
     * is a later one after twice as many pivots (Brent). */
    uint64_t basis = 0, kept = 0;
    int until = 1;
    rb_status s = RB_OK;
    for (int entering = dropped, leaving = -1; s == RB_OK && leaving != dropped;) {
        s = rb_lcp_check_limits(info, opt, labels, began);
        const int row = s == RB_OK ? IN(blocking_row)(t, entering, tied) : -1;
        const int done = info->iters - before;
        if (s == RB_OK && (row < 0 || (done > 0 && basis == kept)))
            s = rb_fail(&info->msg, RB_NUMERICAL,
                        "lcp: rounding errors are too large after %d pivots", info->iters);
        if (s != RB_OK)
            break;
        if (done == until) {
            kept = basis;
            until = until <= INT_MAX / 2 ? 2 * until : INT_MAX;
        }
        leaving = t->basis[row];
        IN(pivot)(t, row, entering);
        const int in_y = t == &of_y;
        basis ^= hash_of(2 * leaving + in_y) ^ hash_of(2 * entering + in_y);
        /* After the pivot on that row of t; of a label's two variables z is the one of its own
         * tableau. */
        const rb_lcp_pivot record = {.pivot = info->iters,
                                     .entering =
                                         (entering < m) != in_y ? labels + entering : entering,
                                     .leaving = (leaving < m) != in_y ? labels + leaving : leaving,
                                     .row = in_y ? row : m + row,
                                     .ratio = (double)IN(row_of)(t, row)[t->width - 1],
                                     .attempt = opt->attempt,
                                     .n = labels};
        if (opt->trace)
            opt->trace(&record, opt->trace_context);
        info->iters++;
        entering = leaving;
        t = in_y ? &of_x : &of_y;
    }
    IN(strategy)(&of_x, 0, m, z);
    IN(strategy)(&of_y, m, n, z + m);
    return rb_arena_done(&memory, s);
}
