/* Bilateral constraints (joints, held points), eliminated before a problem is solved:
 * every solver then meets a problem without them.
 *
 * Global form: K v = H r + G l + f,  u = H' v + w,  G' v + b = 0.  Gauss-Jordan with
 * complete pivoting solves the constraints for as many degrees of freedom as G has rank,
 * so that v = v_0 + Z y and Z'K Z y = Z'H r + Z'(f - K v_0),  u = (Z'H)' y + w + H' v_0.
 * Local form: u = W r + V l + q,  V' r + R l + s = 0.  The same steps give l = l_0 - L r
 * and u = (W - V L) r + q + V l_0. What is redundant among the constraints drops out. */
#include "friction/internal.h"

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

static void free_equations(equations *e)
{
    free(e->A);
    free(e->at);
}

/* The equations are dense: 2 GB of them at most. */
#define MOST_ENTRIES ((size_t)1 << 28)

static rb_status make_equations(int rows, int unknowns, int width, equations *e)
{
    if ((size_t)rows * (size_t)width > MOST_ENTRIES)
        return RB_ENOMEM;
    *e = (equations){.rows = rows,
                     .unknowns = unknowns,
                     .width = width,
                     .A = rb_alloc((size_t)rows, (size_t)width),
                     .at = rb_alloc_int((size_t)rows)};
    return e->A && e->at ? RB_OK : RB_ENOMEM;
}

static double *row_of(const equations *e, int i)
{
    return e->A + (size_t)i * (size_t)e->width;
}

/* The largest entry of an unknown from row `first` on. */
static double find_pivot(const equations *e, int first, int *row, int *col)
{
    double most = 0.0;
    for (int i = first; i < e->rows; i++)
        for (int j = 0; j < e->unknowns; j++)
            if (fabs(row_of(e, i)[j]) > most) {
                most = fabs(row_of(e, i)[j]);
                *row = i, *col = j;
            }
    return most;
}

/* Row i -= what makes its entry in this column 0, exactly, as the pivot is 1. */
static void subtract(equations *e, int i, int pivot, int col)
{
    double *to = row_of(e, i);
    const double *from = row_of(e, pivot), factor = to[col];
    for (int j = 0; factor != 0.0 && j < e->width; j++) {
        const double change = factor * from[j], left = to[j] - change;
        to[j] = fabs(left) <= ROUNDING * fabs(change) ? 0.0 : left;
    }
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
        if (find_pivot(e, e->rank, &row, &col) <= RANK)
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
        for (int i = 0; i < e->rows; i++)
            if (i != e->rank)
                subtract(e, i, e->rank, col);
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

/* v = v0 + Z y, Z by rows: row i of Z is column i of rows. */
typedef struct {
    int kept; /* of y */
    rb_sparse rows;
    double *v0;
} motions;

/* Every motion that is not solved for is one of y. */
static rb_status form_motions(const equations *e, const int *touched, int n, motions *m)
{
    rb_triplets t = {.cols = n};
    int *place = rb_alloc_int((size_t)n);
    m->v0 = rb_alloc((size_t)n, 1);
    rb_status s = place && m->v0 ? RB_OK : RB_ENOMEM;
    if (s == RB_OK) {
        for (int k = 0; k < e->rank; k++)
            place[touched[e->at[k]]] = -1;
        for (int i = 0; i < n; i++) {
            if (place[i] < 0)
                continue;
            place[i] = m->kept++;
            rb_triplets_add(&t, place[i], i, 1.0);
        }
        for (int k = 0; k < e->rank; k++) {
            const double *a = row_of(e, k);
            const int i = touched[e->at[k]];
            m->v0[i] = -a[e->unknowns];
            for (int j = 0; j < e->unknowns; j++)
                if (a[j] != 0.0 && j != e->at[k])
                    rb_triplets_add(&t, place[touched[j]], i, -a[j]);
        }
        t.rows = m->kept;
        s = rb_sparse_from_triplets(&t, &m->rows);
    }
    rb_triplets_free(&t);
    free(place);
    return s;
}

/* p becomes the problem in y; on failure it stays. */
static rb_status reduce(rb_friction_problem *p, const motions *m)
{
    rb_sparse Z = {0}, ZK = {0}, K = {0}, H = {0};
    double *f = rb_alloc((size_t)m->kept, 1);
    rb_status s = f ? rb_sparse_transpose(&m->rows, &Z) : RB_ENOMEM;
    if (s == RB_OK)
        s = rb_sparse_multiply(&m->rows, &p->K, &ZK);
    if (s == RB_OK)
        s = rb_sparse_multiply(&ZK, &Z, &K);
    if (s == RB_OK)
        s = rb_sparse_multiply(&m->rows, &p->H, &H);
    rb_sparse_free(&ZK);
    rb_sparse_free(&Z);
    if (s != RB_OK) {
        free(f);
        rb_sparse_free(&K);
        return s;
    }
    rb_sparse_apply_transposed(1.0, &p->H, m->v0, 1.0, p->w);
    rb_sparse_apply(-1.0, &p->K, m->v0, 1.0, p->f);
    rb_sparse_apply(1.0, &m->rows, p->f, 0.0, f);
    rb_sparse_free(&p->K);
    rb_sparse_free(&p->H);
    free(p->f);
    p->K = K, p->H = H, p->f = f, p->dofs = m->kept;
    return RB_OK;
}

rb_status rb_friction_eliminate(rb_friction_problem *global, const rb_sparse *G, const double *b,
                                rb_message *why)
{
    const int n = global->dofs;
    equations e = {0};
    motions m = {0};
    if (global->form != RB_FRICTION_GLOBAL)
        return rb_fail(why, RB_EINVAL, "constraints on v: expected the global form");
    rb_status s = rb_friction_problem_check(global, why);
    if (s == RB_OK)
        s = rb_friction_check_sparse("G", G, n, G->cols, why);
    if (s == RB_OK)
        s = rb_friction_check_vector("b", (size_t)G->cols, b, why);
    if (s != RB_OK)
        return s;
    int *touched = rb_alloc_int(2 * (size_t)n);
    s = RB_ENOMEM;
    if (touched) {
        /* touched: the degrees of freedom that constraints move, number: the place among
         * them or -1. */
        int *number = touched + n;
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
        s = make_equations(G->cols, count, count + 1, &e);
    }
    if (s == RB_OK) {
        /* Row by row of G': the motions it couples, and b. */
        const int *number = touched + n;
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
    if (s == RB_OK)
        s = form_motions(&e, touched, n, &m);
    if (s == RB_OK)
        s = reduce(global, &m);
    rb_sparse_free(&m.rows);
    free(m.v0);
    free_equations(&e);
    free(touched);
    return s;
}

/* ---- Local form -------------------------------------------------------------------- */

/* -L, of which row at[k] is the r part of row k: l = l0 - L r. */
static rb_status form_forces(const equations *e, int m, rb_sparse *minus_L)
{
    rb_triplets t = {.rows = e->rows, .cols = m};
    for (int k = 0; k < e->rank; k++) {
        const double *row = row_of(e, k) + e->unknowns;
        for (int j = 0; j < m; j++)
            if (row[j] != 0.0)
                rb_triplets_add(&t, e->at[k], j, -row[j]);
    }
    const rb_status s = rb_sparse_from_triplets(&t, minus_L);
    rb_triplets_free(&t);
    return s;
}

/* W - V L and q + V l0; W is sparse from now on.  On failure p stays. */
static rb_status subtract_constraints(rb_friction_problem *p, const rb_sparse *V,
                                      const equations *e)
{
    const int m = p->dimension * p->contacts;
    rb_sparse minus_L = {0}, change = {0}, W = {0};
    rb_triplets t = {.rows = m, .cols = m};
    rb_status s = form_forces(e, m, &minus_L);
    if (s == RB_OK)
        s = rb_sparse_multiply(V, &minus_L, &change);
    if (s == RB_OK && p->form == RB_FRICTION_LOCAL_DENSE) {
        s = rb_sparse_from_dense(m, m, p->W, m, &W);
        if (s == RB_OK)
            rb_triplets_add_matrix(&t, 1.0, &W);
        rb_sparse_free(&W);
    } else if (s == RB_OK) {
        rb_triplets_add_matrix(&t, 1.0, &p->Ws);
    }
    if (s == RB_OK) {
        rb_triplets_add_matrix(&t, 1.0, &change);
        s = rb_sparse_from_triplets(&t, &W);
    }
    rb_triplets_free(&t);
    rb_sparse_free(&change);
    rb_sparse_free(&minus_L);
    if (s != RB_OK)
        return s;
    for (int k = 0; k < e->rank; k++)
        for (int a = V->p[e->at[k]]; a < V->p[e->at[k] + 1]; a++)
            p->q[V->i[a]] -= V->x[a] * row_of(e, k)[e->width - 1];
    free(p->W);
    rb_sparse_free(&p->Ws);
    p->W = NULL, p->Ws = W, p->form = RB_FRICTION_LOCAL_SPARSE;
    return RB_OK;
}

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
    st = make_equations(c, c, c + m + 1, &e);
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
    if (st == RB_OK)
        st = subtract_constraints(local, V, &e);
    free_equations(&e);
    return st;
}
