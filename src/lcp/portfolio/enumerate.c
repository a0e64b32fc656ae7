/* All solutions of a small problem: every complementary basis is tried, and none is left out
 * because its matrix is singular.  What may be a solution is proved to be one, or not to be
 * one (exact.c), or the basis is undecided; solutions within rounding only are marked. */
#include "lcp/portfolio/enumerate.h"
#include "lcp/proof/exact.h"
#include "lcp/proof/linear.h"
#include "lcp/proof/bounds.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What decides, as parts of what the rounding errors of z are a part of (bound) and of the
 * terms of a row: below RIGHT a wrong sign is rounding; of two components below SAME of
 * themselves they are one.  Closer to a bound than ROUGHLY of the largest z the size of
 * the rounding errors is asked for, and they are no more.  A matrix with rows and columns near 1
 * and a smaller reciprocal condition than SINGULAR is not inverted; below DOUBTFUL that it is
 * regular is shown exactly, below POOR its solution is refined. */
static const double RIGHT = 1e-11, SAME = 1e-9, ROUGHLY = 1e-6, SINGULAR = 1e-15, DOUBTFUL = 1e-13,
                    POOR = 1e-7;

/* Bases that are tried at most. */
static const double MOST_BASES = 4194304.0;

/* Bases between two looks at the clock. */
enum { BETWEEN_LOOKS = 64 };

typedef struct {
    int n;
    rb_lcp_problem p;
    const double *lower, *upper;
    const lcp_choices *choices;
    int *choice;            /* blocks: the present one */
    lcp_side *at;           /* n: LCP_AT_LOWER, LCP_AT_UPPER, LCP_BETWEEN */
    double *A, *x;          /* n x n, n: system of the z between their bounds */
    double *row, *col;      /* n each: its scales */
    int *inside, *swap, m;  /* n, 2n: those z; pivots, and work of dgecon; how many */
    double *z, *w, *terms;  /* n; terms: of the rows of w, by modulus */
    double *bound;          /* n: what the rounding errors of z are a part of */
    unsigned char *zeros;   /* n: of the present point; of each solution, none where it is one */
    unsigned char *known;   /* within rounding; known: n x all->count, owned */
    double *inverse, *work; /* n x n each; work: of dgecon as well, 4 n at least */
    lcp_linear *linear;     /* owned */
} search;

/* M z + q, with the z that are between their bounds as they stand. */
static void product(search *s)
{
    memcpy(s->w, s->p.q, (size_t)s->n * sizeof *s->w);
    cblas_dgemv(CblasColMajor, CblasNoTrans, s->n, s->n, 1.0, s->p.M, s->p.ldm, s->z, 1, 1.0, s->w,
                1);
}

/* ---- The basic solution of a basis --------------------------------------------------- */

/* z to full precision by residuals in twice the precision.  0: they do not get small. */
static int refine_basic_solution(search *s)
{
    enum { TURNS = 10 };
    const double enough = 1e-14, *q = s->p.q;
    double change = INFINITY;
    for (int turn = 0; turn < TURNS && change > enough; turn++) {
        for (int r = 0; r < s->m; r++) {
            const int i = s->inside[r];
            proof_dot sum = {q[i], 0.0, fabs(q[i])};
            double error;
            for (int j = 0; j < s->n; j++)
                proof_add(&sum, s->p.M[(size_t)i + (size_t)j * (size_t)s->p.ldm], s->z[j]);
            s->x[r] = -s->row[r] * proof_value(&sum, (size_t)s->n + 1, &error);
        }
        LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', s->m, 1, s->A, s->m, s->swap, s->x, s->m);
        double most = 0.0, largest = 0.0;
        for (int c = 0; c < s->m; c++) {
            double *z = s->z + s->inside[c];
            *z += s->x[c] * s->col[c];
            most = fmax(most, fabs(s->x[c]));
            largest = fmax(largest, fabs(*z / s->col[c]));
        }
        change = largest > 0.0 ? most / largest : 0.0;
    }
    return change <= SAME;
}

/* z of the basis; 0: its matrix has no inverse that could be told from rounding. */
static int basic_solution(search *s)
{
    int m = 0;
    for (int i = 0; i < s->n; i++) {
        s->z[i] = s->at[i] == LCP_AT_UPPER  ? rb_lcp_upper(s->upper, i)
                  : s->at[i] == LCP_BETWEEN ? 0.0
                                            : rb_lcp_lower(s->lower, i);
        if (s->at[i] == LCP_BETWEEN)
            s->inside[m++] = i;
    }
    s->m = m;
    if (m == 0)
        return 1;
    product(s);
    for (int c = 0; c < m; c++) {
        const double *column = s->p.M + (size_t)s->inside[c] * (size_t)s->p.ldm;
        for (int r = 0; r < m; r++)
            s->A[r + c * m] = column[s->inside[r]];
        s->x[c] = -s->w[s->inside[c]];
    }
    /* Rows, then columns by powers of two: a block need not be balanced where M is. */
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < m; i++) {
            double most = 0.0;
            for (int j = 0; j < m; j++)
                most = fmax(most, fabs(s->A[pass ? j + i * m : i + j * m]));
            const double by = most > 0.0 && isfinite(most) ? exp2(-(double)ilogb(most)) : 1.0;
            for (int j = 0; j < m; j++)
                s->A[pass ? j + i * m : i + j * m] *= by;
            (pass ? s->col : s->row)[i] = by;
        }
    for (int r = 0; r < m; r++)
        s->x[r] *= s->row[r];
    double rcond = 0.0;
    const double norm = LAPACKE_dlange(LAPACK_COL_MAJOR, '1', m, m, s->A, m);
    if (LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, m, m, s->A, m, s->swap) != 0 ||
        LAPACKE_dgecon_work(LAPACK_COL_MAJOR, '1', m, s->A, m, norm, &rcond, s->work,
                            s->swap + s->n) != 0 ||
        rcond < SINGULAR ||
        (rcond < DOUBTFUL && !rb_lcp_is_regular(s->p.M, s->p.ldm, m, s->inside, s->inside)))
        return 0;
    LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', m, 1, s->A, m, s->swap, s->x, m);
    for (int c = 0; c < m; c++)
        s->z[s->inside[c]] = s->x[c] * s->col[c];
    return rcond > POOR || refine_basic_solution(s);
}

/* bound = |A^-1| (|L| |U| |z| + |M| |z| + |q|), by components, of the basis whose LU is in A:
 * elimination can leave more than rounding of the terms of a row. */
static void bound_errors(search *s)
{
    const int m = s->m;
    memset(s->bound, 0, (size_t)s->n * sizeof *s->bound);
    if (m == 0)
        return;
    for (int r = 0; r < m; r++) { /* |U| |z| */
        s->terms[r] = 0.0;
        for (int c = r; c < m; c++)
            s->terms[r] += fabs(s->A[r + c * m] * s->z[s->inside[c]] / s->col[c]);
    }
    for (int r = m - 1; r >= 0; r--) { /* |L| of that */
        s->x[r] = s->terms[r];
        for (int c = 0; c < r; c++)
            s->x[r] += fabs(s->A[r + c * m]) * s->terms[c];
    }
    for (int r = m - 1; r >= 0; r--) { /* the rows were exchanged */
        const double x = s->x[r];
        s->x[r] = s->x[s->swap[r] - 1];
        s->x[s->swap[r] - 1] = x;
    }
    memcpy(s->inverse, s->A, (size_t)m * (size_t)m * sizeof *s->inverse);
    LAPACKE_dgetri_work(LAPACK_COL_MAJOR, m, s->inverse, m, s->swap, s->work, m * m);
    for (int r = 0; r < m; r++) {
        const double *row = s->p.M + s->inside[r];
        double sum = fabs(s->p.q[s->inside[r]]);
        for (int j = 0; j < s->n; j++)
            sum += fabs(row[(size_t)j * (size_t)s->p.ldm] * s->z[j]);
        s->x[r] += sum * s->row[r];
    }
    for (int c = 0; c < m; c++) {
        double sum = 0.0;
        for (int r = 0; r < m; r++)
            sum += fabs(s->inverse[c + r * m]) * s->x[r];
        s->bound[s->inside[c]] = sum * s->col[c];
    }
}

/* What rounding errors leave open. */
typedef enum { NONE, POSSIBLE, NEARLY } likelihood;

/* The bounds of z and the signs of w, which the basis alone does not give; and that the
 * rows of z between their bounds are still zero, which large entries of M may spoil
 * where a z was put on a bound.  regular: 0 where z is the point of a linear program.
 * NEARLY: z solves the problem within rounding; POSSIBLE: the z without rounding errors may. */
static likelihood is_solution(search *s, int regular)
{
    const int n = s->n;
    /* Linear programming knows M and q, whose entries are near 1, and z but for rounding of
     * them. */
    const double norm = rb_norm_inf((size_t)n, s->z), largest = regular ? norm : fmax(norm, 1.0);
    const double rough = ROUGHLY * largest;
    int close = !regular;
    if (!isfinite(largest)) /* entries near the largest double can give no numbers */
        return NONE;
    for (int i = 0; i < n; i++) {
        const double low = rb_lcp_lower(s->lower, i), high = rb_lcp_upper(s->upper, i);
        if (s->z[i] < low - rough || s->z[i] > high + rough)
            return NONE;
        close |= s->at[i] == LCP_BETWEEN && (s->z[i] < low + rough || s->z[i] > high - rough);
    }
    for (int i = 0; i < n; i++)
        s->bound[i] = largest;
    if (regular) {
        bound_errors(s);
        for (int i = 0; i < n; i++)
            s->bound[i] = fmin(s->bound[i], rough / RIGHT);
    }
    /* What is outside of the box, or just inside, by rounding is put on it. */
    for (int i = 0; close && i < n; i++) {
        const double low = rb_lcp_lower(s->lower, i), high = rb_lcp_upper(s->upper, i);
        const double small = RIGHT * s->bound[i];
        if (s->z[i] < low - small || s->z[i] > high + small)
            return NONE;
        s->z[i] = s->z[i] <= low + small ? low : s->z[i] >= high - small ? high : s->z[i];
    }
    product(s);
    /* The terms of every row of M z + q, whose rounding is a part of them, and what those of z
     * come to in it. */
    likelihood is = NEARLY;
    for (int i = 0; i < n; i++) {
        const double *row = s->p.M + i;
        double of_z = 0.0;
        s->terms[i] = fabs(s->p.q[i]);
        for (int j = 0; j < n; j++) {
            const double a = fabs(row[(size_t)j * (size_t)s->p.ldm]);
            s->terms[i] += a * fabs(s->z[j]);
            of_z += a * s->bound[j];
        }
        if (!isfinite(s->terms[i]))
            return NONE;
        const int fixed = rb_lcp_lower(s->lower, i) >= rb_lcp_upper(s->upper, i);
        const double wrong = s->at[i] == LCP_LEFT_OUT   ? 0.0
                             : s->at[i] == LCP_BETWEEN  ? fabs(s->w[i])
                             : fixed                    ? 0.0
                             : s->at[i] == LCP_AT_UPPER ? s->w[i]
                                                        : -s->w[i];
        if (wrong > RIGHT * (s->terms[i] + of_z))
            return NONE;
        if (wrong > RIGHT * s->terms[i])
            is = POSSIBLE;
    }
    return is;
}

void rb_lcp_solutions_free(rb_lcp_solutions *all)
{
    if (!all)
        return;
    free(all->z);
    free(all->singular_basis);
    free(all->nearby);
    free(all->set);
    free(all->member);
    *all = (rb_lcp_solutions){0};
}

/* 1: the z of a basis and of solution k differ by rounding at most. */
static int is_close(const search *s, const rb_lcp_solutions *all, int k)
{
    const double *known = all->z + (size_t)k * (size_t)s->n;
    for (int i = 0; i < s->n; i++)
        if (!(s->choices->compared && !s->choices->compared[i]) &&
            fabs(known[i] - s->z[i]) >
                SAME * fmax(fabs(known[i]), fabs(s->z[i])) + RIGHT * s->bound[i])
            return 0;
    return 1;
}

/* 1: solution k is one of this basis, exactly. */
static int is_of_basis(const search *s, int k)
{
    const unsigned char *zeros = s->known + (size_t)k * (size_t)s->n;
    for (int i = 0; i < s->n; i++)
        if (!(zeros[i] & (s->at[i] == LCP_AT_LOWER   ? LCP_Z_IS_LOWER
                          : s->at[i] == LCP_AT_UPPER ? LCP_Z_IS_UPPER
                                                     : LCP_W_IS_ZERO)))
            return 0;
    return 1;
}

/* 1: solution k is that of this basis: z with these zeros, none where it is one within rounding
 * only.  Of regular bases that is decided exactly, if all of z is compared. */
static int is_same(const search *s, const rb_lcp_solutions *all, int k, int regular)
{
    const int exact = regular && !s->choices->compared && s->zeros[0] && !all->nearby[k] &&
                      !all->singular_basis[k];
    return exact ? is_of_basis(s, k) : is_close(s, all, k);
}

/* Room for twice as many solutions where count of them are all that there is room for. */
static rb_status make_room(search *s, rb_lcp_solutions *all)
{
    const size_t n = (size_t)s->n, count = (size_t)all->count, room = count ? 2 * count : 1;
    if ((count & (count - 1)) != 0)
        return RB_OK;
    double *z = realloc(all->z, room * n * sizeof *z);
    all->z = z ? z : all->z;
    int *singular = realloc(all->singular_basis, room * sizeof *singular);
    all->singular_basis = singular ? singular : all->singular_basis;
    int *nearby = realloc(all->nearby, room * sizeof *nearby);
    all->nearby = nearby ? nearby : all->nearby;
    unsigned char *known = realloc(s->known, room * n);
    s->known = known ? known : s->known;
    return z && singular && nearby && known ? RB_OK : RB_ENOMEM;
}

/* Adds z, unless it is known already.  nearby: it is a solution within rounding only, as which
 * it gives way to a near one.  RB_ENOMEM. */
static rb_status keep_basic_solution(search *s, int regular, int nearby, rb_lcp_solutions *all)
{
    const size_t n = (size_t)s->n;
    int at = 0;
    while (at < all->count && !is_same(s, all, at, regular))
        at++;
    const int is_new = at == all->count;
    if (is_new && make_room(s, all) != RB_OK)
        return RB_ENOMEM;
    if (is_new || (all->nearby[at] && !nearby)) {
        memcpy(all->z + n * (size_t)at, s->z, n * sizeof *s->z);
        memcpy(s->known + n * (size_t)at, s->zeros, n);
        all->singular_basis[at] = !regular;
        all->nearby[at] = nearby;
        all->count += is_new;
    } else if (all->nearby[at] == nearby)
        all->singular_basis[at] &= !regular;
    if (s->choices->found)
        s->choices->found(s->choices->context, at, s->choice);
    return RB_OK;
}

/* Choice k of the block whose indices begin at `first`. */
static void choose(search *s, int block, int first, int k)
{
    const int size = s->choices->size[block];
    s->choice[block] = k;
    memcpy(s->at + first, s->choices->side[block] + (size_t)k * (size_t)size,
           (size_t)size * sizeof *s->at);
}

/* The z between their bounds by the rows of the same numbers. */
static lcp_point point_of(search *s)
{
    return (lcp_point){.p = &s->p,
                       .lower = s->lower,
                       .upper = s->upper,
                       .m = s->m,
                       .row = s->inside,
                       .column = s->inside,
                       .z = s->z};
}

/* The columns of z between its bounds, and as many rows of w that is zero which are independent in
 * them (s->swap), of the point that is_solution has seen; RB_UNDECIDED: LAPACK finds too few. */
static rb_status choose_system(search *s, lcp_point *point)
{
    int m = 0, rows = 0, *column = s->swap, *row = column + s->n;
    for (int i = 0; i < s->n; i++) {
        const double z = s->z[i];
        if (s->at[i] == LCP_BETWEEN ||
            (s->at[i] != LCP_LEFT_OUT && fabs(s->w[i]) <= RIGHT * s->terms[i]))
            row[rows++] = i;
        if (s->at[i] == LCP_BETWEEN && z != rb_lcp_lower(s->lower, i) &&
            z != rb_lcp_upper(s->upper, i) && (z != 0.0 || isfinite(rb_lcp_lower(s->lower, i))))
            column[m++] = i;
    }
    for (int c = 0; c < m; c++)
        for (int r = 0; r < rows; r++)
            s->A[r + c * rows] = s->p.M[(size_t)row[r] + (size_t)column[c] * (size_t)s->p.ldm];
    if (m > rows ||
        (m > 0 && LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, rows, m, s->A, rows, s->inside) != 0))
        return RB_UNDECIDED;
    for (int c = 0; c < m; c++) {
        const int other = s->inside[c] - 1, kept = row[c];
        row[c] = row[other];
        row[other] = kept;
    }
    point->m = m;
    point->row = row;
    point->column = column;
    return RB_OK;
}

/* A basis: its block has an inverse to work with; it is not singular, but for rounding it could
 * be; it is singular; and then it has no point. */
typedef enum { INVERTED, REGULAR, SINGULAR_ONE, CONTRADICTORY } basis_kind;

/* What may be a solution is proved to be one, or is one within rounding.  RB_ENOMEM. */
static rb_status look_at_point(search *s, likelihood is, basis_kind kind, rb_lcp_solutions *all)
{
    const int regular = kind <= REGULAR;
    memset(s->zeros, 0, (size_t)s->n);
    for (int k = 0; kind == INVERTED && !s->choices->compared && k < all->count; k++)
        if (!all->nearby[k] && is_of_basis(s, k)) {
            all->singular_basis[k] = 0;
            return RB_OK;
        }
    lcp_point point = point_of(s);
    rb_status exact = kind == INVERTED        ? RB_OK
                      : kind == CONTRADICTORY ? RB_NO_SOLUTION
                                              : choose_system(s, &point);
    if (exact == RB_OK)
        exact = rb_lcp_is_exact(&point, s->at, s->zeros);
    if (exact == RB_OK || exact == RB_ENOMEM)
        return exact == RB_OK ? keep_basic_solution(s, regular, 0, all) : exact;
    memset(s->zeros, 0, (size_t)s->n);
    /* of a singular basis another point than this one may be a solution */
    all->undecided += kind != CONTRADICTORY && (exact == RB_UNDECIDED || kind != INVERTED);
    return is == NEARLY ? keep_basic_solution(s, regular, 1, all) : RB_OK;
}

/* One basis: its point, or where its matrix is singular what linear programming says of its
 * complementary cone.  RB_ENOMEM. */
static rb_status look_at_basis(search *s, rb_lcp_solutions *all)
{
    all->bases++;
    if (basic_solution(s)) {
        const likelihood is = is_solution(s, 1);
        return is == NONE ? RB_OK : look_at_point(s, is, INVERTED, all);
    }
    const lcp_point point = point_of(s);
    const int regular = rb_lcp_is_regular(s->p.M, s->p.ldm, s->m, s->inside, s->inside);
    const rb_status exists = rb_lcp_linear_decide(s->linear, s->at, s->z);
    all->singular += !regular;
    if (exists == RB_NO_SOLUTION)
        return RB_OK;
    basis_kind kind = REGULAR;
    if (!regular)
        kind = rb_lcp_has_no_point(&point) ? CONTRADICTORY : SINGULAR_ONE;
    const likelihood is = exists == RB_OK ? is_solution(s, 0) : NONE;
    if (is != NONE)
        return look_at_point(s, is, kind, all);
    all->undecided += kind != CONTRADICTORY;
    return RB_OK;
}

/* At the end: solutions within rounding that come to a proved one are left out, unless somebody
 * knows their numbers, and z are those of the problem as given. */
static void finish(search *s, const lcp_posed *posed, double unit, rb_lcp_solutions *all)
{
    const size_t n = (size_t)s->n;
    int kept = 0;
    for (int k = 0; k < all->count; k++) {
        double *z = all->z + (size_t)k * n;
        memcpy(s->z, z, n * sizeof *z);
        for (size_t i = 0; i < n; i++)
            s->bound[i] = rb_norm_inf(n, z);
        int covered = 0;
        for (int l = 0; all->nearby[k] && !s->choices->found && !covered && l < all->count; l++)
            covered = !all->nearby[l] && is_close(s, all, l);
        if (covered)
            continue;
        all->singular_basis[kept] = all->singular_basis[k];
        all->nearby[kept] = all->nearby[k];
        memmove(all->z + (size_t)kept++ * n, z, n * sizeof *z);
    }
    all->count = kept;
    kept = 0;
    for (int k = 0; k < all->count; k++) {
        double *z = all->z + (size_t)k * n;
        for (size_t i = 0; i < n; i++)
            z[i] *= unit;
        rb_lcp_scale_back(posed, z);
        if (isfinite(rb_norm_inf(n, z))) {
            all->singular_basis[kept] = all->singular_basis[k];
            all->nearby[kept] = all->nearby[k];
            memmove(all->z + (size_t)kept++ * n, z, n * sizeof *z);
        }
    }
    all->undecided += all->count - kept; /* beyond the largest number */
    all->count = kept;
}

rb_status rb_lcp_try_all(const rb_lcp_problem *p, const double *lower, const double *upper,
                         const lcp_choices *choices, double seconds, rb_lcp_solutions *all,
                         rb_message *why)
{
    const int n = p->n;
    const size_t order = (size_t)n;
    const double began = rb_seconds();
    search s = {.n = n, .choices = choices};
    *all = (rb_lcp_solutions){.n = n};
    const rb_lcp_options plain = rb_lcp_defaults();
    double bases = 1.0;
    for (int block = 0; block < choices->blocks; block++)
        bases *= choices->count[block];
    if (bases > MOST_BASES)
        return rb_fail(why, RB_EINVAL,
                       "lcp: all solutions: %.3g complementary bases: expected at most "
                       "%.3g, that is order 22 without bounds",
                       bases, MOST_BASES);
    /* In units of their own for rows and columns, and q as a whole near 1. */
    rb_arena scratch = {0};
    lcp_posed posed = {0};
    const lcp_matrix given = {.n = n, .dense = p->M, .ld = p->ldm};
    double *ends = rb_arena_doubles(&scratch, order, 3), unit = 1.0;
    s.at = rb_arena_zeros(&scratch, order, sizeof *s.at);
    s.choice = rb_arena_ints(&scratch, (size_t)choices->blocks);
    s.A = rb_arena_doubles(&scratch, order, order);
    s.inverse = rb_arena_doubles(&scratch, order, order);
    s.work = rb_arena_doubles(&scratch, order, order + 4);
    s.x = rb_arena_doubles(&scratch, order, 7);
    s.inside = rb_arena_ints(&scratch, order);
    s.swap = rb_arena_ints(&scratch, 2 * order);
    s.zeros = rb_arena_zeros(&scratch, order, sizeof *s.zeros);
    rb_status status =
        scratch.failed ? RB_ENOMEM : rb_lcp_pose(&given, p->q, lower, upper, &plain, 1, &posed);
    if (status == RB_OK) {
        s.row = s.x + order;
        s.col = s.row + order;
        s.z = s.col + order;
        s.w = s.z + order;
        s.terms = s.w + order;
        s.bound = s.terms + order;
        const lcp_near_one near = rb_lcp_bring_near_one(&posed, ends);
        unit = near.unit;
        s.p = (rb_lcp_problem){n, posed.M.dense, posed.M.ld, near.q};
        s.lower = near.lower;
        s.upper = near.upper;
        status = rb_lcp_linear_create(&posed.M, s.p.q, s.lower, s.upper, &s.linear);
    }
    for (int block = 0, first = 0; status == RB_OK && block < choices->blocks; block++) {
        choose(&s, block, first, 0);
        first += choices->size[block];
    }
    for (int digit = 0; status == RB_OK && digit < choices->blocks;) {
        status = look_at_basis(&s, all);
        if (status == RB_OK && rb_interrupted())
            status = rb_fail(why, RB_INTERRUPTED, "lcp: interrupted after %d %s", all->bases,
                             all->bases == 1 ? "basis" : "bases");
        if (status == RB_OK && seconds > 0.0 && all->bases % BETWEEN_LOOKS == 0 &&
            all->bases < bases && rb_seconds() - began > seconds)
            status = rb_fail(why, RB_TIME_LIMIT, "lcp: %d of %.0f complementary bases in %g s",
                             all->bases, bases, seconds);
        /* The next basis, the choices being the digits of a number. */
        int first = 0;
        for (digit = 0; digit < choices->blocks; digit++) {
            const int next = s.choice[digit] + 1, carries = next == choices->count[digit];
            choose(&s, digit, first, carries ? 0 : next);
            if (!carries)
                break;
            first += choices->size[digit];
        }
    }
    if (status == RB_OK || status == RB_TIME_LIMIT)
        finish(&s, &posed, unit, all);
    free(s.known);
    rb_lcp_linear_free(s.linear);
    rb_lcp_posed_free(&posed);
    rb_arena_free(&scratch);
    if (status == RB_OK || status == RB_TIME_LIMIT)
        return status;
    rb_lcp_solutions_free(all);
    return status == RB_INTERRUPTED
               ? status
               : rb_fail(why, status, "lcp: out of memory for all solutions of order %d", n);
}

rb_status rb_lcp_enumerate(const rb_lcp_problem *p, const double *lower, const double *upper,
                           double seconds, rb_lcp_solutions *all, rb_message *why)
{
    const size_t order = (size_t)(p->n > 0 ? p->n : 0);
    const rb_lcp_options plain = rb_lcp_defaults();
    rb_arena scratch = {0};
    *all = (rb_lcp_solutions){.n = p->n};
    rb_status s = rb_lcp_check_dense(p, &plain, why);
    if (s == RB_OK)
        s = rb_lcp_check_boxes(p->n, lower, upper, why);
    if (s != RB_OK)
        return s;
    /* Each index by itself, at the bounds that it has or between them. */
    int *size = rb_arena_ints(&scratch, order), *count = rb_arena_ints(&scratch, order);
    lcp_side *side = rb_arena_zeros(&scratch, 3 * order, sizeof *side);
    const lcp_side **of_index = rb_arena_zeros(&scratch, order, sizeof *of_index);
    for (int i = 0; i < p->n && !scratch.failed; i++) {
        lcp_side *own = side + 3 * (size_t)i;
        size[i] = 1;
        of_index[i] = own;
        for (int at = LCP_AT_LOWER; at <= LCP_BETWEEN; at++)
            if (rb_lcp_is_place(lower, upper, i, (lcp_side)at))
                own[count[i]++] = (lcp_side)at;
    }
    const lcp_choices choices = {.blocks = p->n, .size = size, .count = count, .side = of_index};
    s = scratch.failed
            ? rb_fail(why, RB_ENOMEM, "lcp: out of memory for all solutions of order %d", p->n)
            : rb_lcp_try_all(p, lower, upper, &choices, seconds, all, why);
    return rb_arena_done(&scratch, s);
}
