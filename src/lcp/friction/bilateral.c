/* Bilateral constraints (joints, held points), eliminated before a problem is solved:
 * every solver then meets a problem without them.
 *
 * Global form: K v = H r + G l + f,  u = H' v + w,  G' v + b = 0.  Gauss-Jordan with
 * complete pivoting solves the constraints for as many degrees of freedom as G has rank,
 * so that v = v_0 + Z y and Z'K Z y = Z'H r + Z'(f - K v_0),  u = (Z'H)' y + w + H' v_0.
 * Local form: u = W r + V l + q,  V' r + R l + s = 0.  The same steps give l = l_0 - L r
 * and u = (W - V L) r + q + V l_0. What is redundant among the constraints drops out. */
#include "lcp/friction/internal.h"

#include <math.h>
#include <stdlib.h>

/* Parts of the largest entry: pivots below RANK are zeros, and what cancels to less than
 * ROUNDING of its terms is one. */
static const double RANK = 1e-10, ROUNDING = 1e-14;

/* Linear equations A x = 0 with A dense, row-major: x ends in known entries, and perhaps
 * a 1.  Solved for some of the first `unknowns` entries: row k says x at[k] = minus the
 * rest of the row. */
typedef struct {
    int rows, unknowns, width, rank;
    double *A;
    int *at; /* rows */
} equations;

/* The equations are dense: 2 GB of them at most. */
#define MOST_ENTRIES ((size_t)1 << 28)

static rb_status make_equations(int rows, int unknowns, int width, rb_arena *memory, equations *e)
{
    if ((size_t)rows * (size_t)width > MOST_ENTRIES)
        return RB_ENOMEM;
    *e = (equations){.rows = rows,
                     .unknowns = unknowns,
                     .width = width,
                     .A = rb_arena_doubles(memory, (size_t)rows, (size_t)width),
                     .at = rb_arena_ints(memory, (size_t)rows)};
    return memory->failed ? RB_ENOMEM : RB_OK;
}

static double *row_of(const equations *e, int i)
{
    return e->A + (size_t)i * (size_t)e->width;
}

/* Rows of size 1 first, so that units of single constraints do not matter. */
static void solve_equations(equations *e)
{
    for (int i = 0; i < e->rows; i++) {
        double *a = row_of(e, i);
        const double most = rb_norm_inf((size_t)e->unknowns, a);
        for (int j = 0; most > 0.0 && j < e->width; j++)
            a[j] /= most;
    }
    for (e->rank = 0; e->rank < e->rows; e->rank++) {
        int row = 0, col = 0;
        double most = 0.0;
        for (int i = e->rank; i < e->rows; i++)
            for (int j = 0; j < e->unknowns; j++)
                if (fabs(row_of(e, i)[j]) > most) {
                    most = fabs(row_of(e, i)[j]);
                    row = i, col = j;
                }
        if (most <= RANK)
            return;
        double *a = row_of(e, e->rank), *b = row_of(e, row);
        for (int j = 0; j < e->width; j++) {
            const double x = a[j];
            a[j] = b[j];
            b[j] = x;
        }
        for (int j = 0; j < e->width; j++)
            a[j] = j == col ? a[j] : a[j] / a[col];
        a[col] = 1.0;
        e->at[e->rank] = col;
        for (int i = 0; i < e->rows; i++) {
            double *to = row_of(e, i);
            const double factor = i == e->rank ? 0.0 : to[col];
            for (int j = 0; factor != 0.0 && j < e->width; j++) {
                const double change = factor * a[j], left = to[j] - change;
                to[j] = fabs(left) <= ROUNDING * fabs(change) ? 0.0 : left;
            }
        }
    }
}

/* A redundant row is to leave nothing to what is known, beyond rounding: columns `first`
 * ... `last` - 1 of the equations, of one unit. */
static int contradicts(const equations *e, int first, int last)
{
    double size = 0.0, left = 0.0;
    for (int i = 0; i < e->rows; i++)
        for (int j = first; j < last; j++) {
            const double x = fabs(row_of(e, i)[j]);
            size = fmax(size, x);
            left = i < e->rank ? left : fmax(left, x);
        }
    return left > RANK * size;
}

/* ---- Global form ------------------------------------------------------------------- */

rb_status rb_friction_eliminate(rb_friction_problem *global, const rb_sparse *G, const double *b,
                                rb_message *why)
{
    const int n = global->dofs;
    equations e = {0};
    if (global->form != RB_FRICTION_GLOBAL)
        return rb_fail(why, RB_EINVAL, "constraints on v: expected the global form");
    rb_status s = rb_friction_problem_check(global, why);
    if (s == RB_OK)
        s = rb_friction_check_sparse("G", G, n, G->cols, why);
    if (s == RB_OK)
        s = rb_friction_check_vector("b", (size_t)G->cols, b, why);
    if (s != RB_OK)
        return s;
    /* touched: the degrees of freedom that constraints move; number: the place among them
     * or -1, later that in y. */
    rb_arena scratch = {0};
    int *touched = rb_arena_ints(&scratch, (size_t)n), *number = rb_arena_ints(&scratch, (size_t)n);
    double *v0 = rb_arena_doubles(&scratch, (size_t)n, 1), *f = NULL;
    s = RB_ENOMEM;
    if (!scratch.failed) {
        int count = 0;
        for (int i = 0; i < G->rows; i++)
            number[i] = -1;
        for (int k = 0; k < G->p[G->cols]; k++)
            number[G->i[k]] = 0;
        for (int i = 0; i < G->rows; i++)
            if (number[i] == 0) {
                number[i] = count;
                touched[count++] = i;
            }
        s = make_equations(G->cols, count, count + 1, &scratch, &e);
    }
    if (s == RB_OK) {
        /* Row by row of G': the motions it couples, and b. */
        for (int c = 0; c < G->cols; c++) {
            for (int k = G->p[c]; k < G->p[c + 1]; k++)
                row_of(&e, c)[number[G->i[k]]] = G->x[k];
            row_of(&e, c)[e.unknowns] = b[c];
        }
        solve_equations(&e);
        if (contradicts(&e, e.unknowns, e.width))
            s = rb_fail(why, RB_EINVAL, "the constraints G'v + b = 0 contradict each other");
        else if (e.rank == n)
            s = rb_fail(why, RB_EINVAL, "the constraints G'v + b = 0 leave no motion");
    }
    /* v = v0 + Z y: every motion that is not solved for is one of y.  Zt: Z'. */
    rb_sparse Zt = {0}, Z = {0}, ZK = {0}, K = {0}, H = {0};
    if (s == RB_OK) {
        rb_triplets t = {.rows = n - e.rank, .cols = n};
        for (int i = 0; i < n; i++)
            number[i] = 0;
        for (int k = 0; k < e.rank; k++)
            number[touched[e.at[k]]] = -1;
        for (int i = 0, kept = 0; i < n; i++)
            if (number[i] == 0) {
                number[i] = kept++;
                rb_triplets_add(&t, number[i], i, 1.0);
            }
        for (int k = 0; k < e.rank; k++) {
            const double *a = row_of(&e, k);
            v0[touched[e.at[k]]] = -a[e.unknowns];
            for (int j = 0; j < e.unknowns; j++)
                if (a[j] != 0.0 && j != e.at[k])
                    rb_triplets_add(&t, number[touched[j]], touched[e.at[k]], -a[j]);
        }
        s = rb_sparse_from_triplets(&t, &Zt);
        rb_triplets_free(&t);
        f = rb_alloc((size_t)(n - e.rank), 1);
    }
    if (s == RB_OK)
        s = f ? rb_sparse_transpose(&Zt, &Z) : RB_ENOMEM;
    if (s == RB_OK)
        s = rb_sparse_multiply(&Zt, &global->K, &ZK);
    if (s == RB_OK)
        s = rb_sparse_multiply(&ZK, &Z, &K);
    if (s == RB_OK)
        s = rb_sparse_multiply(&Zt, &global->H, &H);
    if (s == RB_OK) { /* on failure the problem stays */
        rb_sparse_apply_transposed(1.0, &global->H, v0, 1.0, global->w);
        rb_sparse_apply(-1.0, &global->K, v0, 1.0, global->f);
        rb_sparse_apply(1.0, &Zt, global->f, 0.0, f);
        rb_sparse_free(&global->K);
        rb_sparse_free(&global->H);
        free(global->f);
        global->K = K, global->H = H, global->f = f, global->dofs = n - e.rank;
    } else {
        rb_sparse_free(&K);
        free(f);
    }
    rb_sparse_free(&ZK);
    rb_sparse_free(&Z);
    rb_sparse_free(&Zt);
    return rb_arena_done(&scratch, s);
}

/* ---- Local form -------------------------------------------------------------------- */

rb_status rb_friction_eliminate_local(rb_friction_problem *local, const rb_sparse *V,
                                      const rb_sparse *R, const double *s, rb_message *why)
{
    const int m = local->dimension * local->contacts, c = R->cols;
    equations e = {0};
    if (local->form == RB_FRICTION_GLOBAL)
        return rb_fail(why, RB_EINVAL, "constraints with R: expected the local form");
    rb_status st = rb_friction_problem_check(local, why);
    if (st == RB_OK)
        st = rb_friction_check_sparse("R", R, c, c, why);
    if (st == RB_OK)
        st = rb_friction_check_sparse("V", V, m, c, why);
    if (st == RB_OK)
        st = rb_friction_check_vector("s", (size_t)c, s, why);
    if (st != RB_OK)
        return st;
    rb_arena scratch = {0};
    st = make_equations(c, c, c + m + 1, &scratch, &e);
    if (st == RB_OK) {
        /* [R, V', s] (l, r, 1) = 0 */
        for (int j = 0; j < c; j++) {
            for (int k = R->p[j]; k < R->p[j + 1]; k++)
                row_of(&e, R->i[k])[j] = R->x[k];
            for (int k = V->p[j]; k < V->p[j + 1]; k++)
                row_of(&e, j)[c + V->i[k]] = V->x[k];
            row_of(&e, j)[e.width - 1] = s[j];
        }
        solve_equations(&e);
        if (contradicts(&e, c, c + m) || contradicts(&e, c + m, e.width))
            st = rb_fail(why, RB_EINVAL,
                         "V'r + R l + s = 0: R has rank %d of %d, and what it leaves "
                         "undetermined of l is no redundant constraint",
                         e.rank, c);
    }
    /* W - V L and q + V l0, of l = l0 - L r; W is sparse from now on. */
    rb_sparse minus_L = {0}, change = {0}, W = {0};
    rb_triplets l = {.rows = c, .cols = m}, t = {.rows = m, .cols = m};
    for (int k = 0; st == RB_OK && k < e.rank; k++) {
        const double *row = row_of(&e, k) + c;
        for (int j = 0; j < m; j++)
            if (row[j] != 0.0)
                rb_triplets_add(&l, e.at[k], j, -row[j]);
    }
    if (st == RB_OK)
        st = rb_sparse_from_triplets(&l, &minus_L);
    if (st == RB_OK)
        st = rb_sparse_multiply(V, &minus_L, &change);
    if (st == RB_OK && local->form == RB_FRICTION_LOCAL_DENSE) {
        st = rb_sparse_from_dense(m, m, local->W, m, &W);
        if (st == RB_OK)
            rb_triplets_add_matrix(&t, 1.0, &W);
        rb_sparse_free(&W);
    } else if (st == RB_OK) {
        rb_triplets_add_matrix(&t, 1.0, &local->Ws);
    }
    if (st == RB_OK) {
        rb_triplets_add_matrix(&t, 1.0, &change);
        st = rb_sparse_from_triplets(&t, &W);
    }
    if (st == RB_OK) {
        for (int k = 0; k < e.rank; k++)
            for (int a = V->p[e.at[k]]; a < V->p[e.at[k] + 1]; a++)
                local->q[V->i[a]] -= V->x[a] * row_of(&e, k)[e.width - 1];
        free(local->W);
        rb_sparse_free(&local->Ws);
        local->W = NULL, local->Ws = W, local->form = RB_FRICTION_LOCAL_SPARSE;
    }
    rb_triplets_free(&t);
    rb_triplets_free(&l);
    rb_sparse_free(&change);
    rb_sparse_free(&minus_L);
    return rb_arena_done(&scratch, st);
}
