#include "friction/internal.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>

/* Above this share of entries, and below this order, dense LU is the faster one. */
#define DENSE_FILL 0.15
#define DENSE_ORDER 120

void rb_friction_system_free(rb_friction_system *s)
{
    if (!s)
        return;
    rb_sparse_lu_free(s->lu);
    rb_sparse_free(&s->jt);
    rb_friction_blocks_free(&s->blocks);
    free(s->rho);
    free(s->J);
    free(s->pivots);
    free(s->rhs);
    free(s->x);
    *s = (rb_friction_system){0};
}

/* ---- rho: the inverse of each contact's own compliance --------------------------------
 */

/* Of finite-element structures diag(K)^-1 is about a tenth of a node's compliance. */
#define DIAGONAL_SHARE 0.1

/* Global form: from the diagonal of H' diag(K)^-1 H. */
static rb_status global_rho(const rb_friction_problem *p, double *rho)
{
    const rb_sparse *h = &p->H;
    const int d = p->dimension;
    double *diagonal = rb_alloc((size_t)p->dofs, 1);
    if (!diagonal)
        return RB_ENOMEM;
    for (int j = 0; j < p->dofs; j++)
        for (int k = p->K.p[j]; k < p->K.p[j + 1]; k++)
            if (p->K.i[k] == j)
                diagonal[j] = p->K.x[k];
    for (int j = 0; j < h->cols; j++) {
        double w = 0.0, *at = &rho[2 * (j / d) + (j % d > 0)];
        for (int k = h->p[j]; k < h->p[j + 1]; k++)
            if (diagonal[h->i[k]] > 0.0)
                w += h->x[k] * h->x[k] / (DIAGONAL_SHARE * diagonal[h->i[k]]);
        *at = fmax(*at, w);
    }
    rb_friction_invert_compliances(p->contacts, rho);
    free(diagonal);
    return RB_OK;
}

static rb_status choose_rho(rb_friction_system *s)
{
    if (s->n)
        return global_rho(s->problem, s->rho);
    rb_friction_blocks_rho(&s->blocks, s->rho);
    return RB_OK;
}

/* ---- Patterns (of the transposed matrix: its columns are the equations)
 * ---------------- */

static rb_status local_pattern(rb_friction_system *s)
{
    const rb_friction_blocks *b = &s->blocks;
    const int d = s->d;
    const size_t nz = (size_t)b->p[s->contacts] * (size_t)(d * d);
    s->jt = (rb_sparse){.rows = s->m,
                        .cols = s->m,
                        .p = rb_alloc_int((size_t)s->m + 1),
                        .i = rb_alloc_int(nz),
                        .x = rb_alloc(nz, 1)};
    if (!s->jt.p || !s->jt.i || !s->jt.x)
        return RB_ENOMEM;
    int n = 0;
    for (int i = 0; i < s->m; i++) {
        for (int k = b->p[i / d]; k < b->p[i / d + 1]; k++)
            for (int a = 0; a < d; a++)
                s->jt.i[n++] = b->j[k] * d + a;
        s->jt.p[i + 1] = n;
    }
    return RB_OK;
}

/* Triplets of one filling of the global pattern; only places matter. */
static int global_places(const rb_friction_problem *p, int d, int *row, int *col,
                         double *x)
{
    const rb_sparse *k = &p->K, *h = &p->H;
    const int n = p->dofs;
    int count = 0;
    for (int j = 0; j < n; j++)
        for (int l = k->p[j]; l < k->p[j + 1]; l++)
            row[count] = k->i[l], col[count] = j, x[count++] = k->x[l];
    for (int j = 0; j < h->cols; j++) {
        const int c = j / d;
        for (int l = h->p[j]; l < h->p[j + 1]; l++)
            row[count] = n + j, col[count] = h->i[l], x[count++] = -h->x[l];
        for (int a = 0; a < d; a++) {
            for (int l = h->p[c * d + a]; l < h->p[c * d + a + 1]; l++)
                row[count] = h->i[l], col[count] = n + j, x[count++] = 0.0;
            row[count] = n + c * d + a, col[count] = n + j, x[count++] = 0.0;
        }
    }
    return count;
}

static rb_status global_pattern(rb_friction_system *s)
{
    const rb_friction_problem *p = s->problem;
    const size_t places = (size_t)p->K.p[p->dofs] +
                          (size_t)(s->d + 1) * (size_t)p->H.p[s->m] +
                          (size_t)s->m * (size_t)s->d;
    int *row = rb_alloc_int(places), *col = rb_alloc_int(places);
    double *x = rb_alloc(places, 1);
    rb_status st = RB_ENOMEM;
    if (row && col && x) {
        const int count = global_places(p, s->d, row, col, x);
        st =
            rb_sparse_from_triplets(s->n + s->m, s->n + s->m, count, row, col, x, &s->jt);
    }
    free(x);
    free(col);
    free(row);
    return st;
}

static rb_status choose_solver(rb_friction_system *s)
{
    const size_t order = (size_t)(s->n + s->m);
    const double all = (double)order * (double)order;
    if (order > DENSE_ORDER && s->jt.p[order] <= DENSE_FILL * all)
        return rb_sparse_lu_create(&s->jt, &s->lu);
    s->J = rb_alloc(order, order);
    s->pivots = rb_alloc_int(order);
    return s->J && s->pivots ? RB_OK : RB_ENOMEM;
}

rb_status rb_friction_system_init(const rb_friction_problem *problem,
                                  rb_friction_system *s)
{
    const int m = problem->dimension * problem->contacts;
    const int n = problem->form == RB_FRICTION_GLOBAL ? problem->dofs : 0;
    *s = (rb_friction_system){.problem = problem,
                              .d = problem->dimension,
                              .contacts = problem->contacts,
                              .m = m,
                              .n = n,
                              .rho = rb_alloc((size_t)problem->contacts, 2),
                              .rhs = rb_alloc((size_t)(n + m), 1),
                              .x = rb_alloc((size_t)(n + m), 1)};
    rb_status st = s->rho && s->rhs && s->x ? RB_OK : RB_ENOMEM;
    if (st == RB_OK && !n)
        st = rb_friction_blocks_init(problem, &s->blocks);
    if (st == RB_OK)
        st = choose_rho(s);
    if (st == RB_OK)
        st = n ? global_pattern(s) : local_pattern(s);
    if (st == RB_OK)
        st = choose_solver(s);
    if (st != RB_OK)
        rb_friction_system_free(s);
    return st;
}

/* ---- Products
 * ---------------------------------------------------------------------------- */

void rb_friction_system_velocity(const rb_friction_system *s, double constant,
                                 const double *r, const double *v, double *u)
{
    const rb_friction_problem *p = s->problem;
    if (s->n)
        rb_sparse_apply_transposed(1.0, &p->H, v, 0.0, u);
    else
        rb_friction_blocks_apply(&s->blocks, r, u);
    for (int k = 0; k < s->m && constant != 0.0; k++)
        u[k] += constant * (s->n ? p->w[k] : p->q[k]);
}

void rb_friction_system_imbalance(const rb_friction_system *s, const double *r,
                                  const double *v, double *e)
{
    if (!s->n)
        return;
    for (int i = 0; i < s->n; i++)
        e[i] = -s->problem->f[i];
    rb_sparse_apply(1.0, &s->problem->K, v, 1.0, e);
    rb_sparse_apply(-1.0, &s->problem->H, r, 1.0, e);
}

/* ---- Steps
 * ------------------------------------------------------------------------------- */

/* row a of B_c (block of W): b-th entry */
static double row_times_block(int d, const double *B, int a, const double *w, int b)
{
    double sum = 0.0;
    for (int c = 0; c < d; c++)
        sum += B[a + c * d] * w[c + b * d];
    return sum;
}

static void fill_local(rb_friction_system *s, const double *A, const double *B)
{
    const rb_friction_blocks *w = &s->blocks;
    const int d = s->d, dd = d * d;
    double *x = s->jt.x;
    for (int i = 0; i < s->contacts; i++)
        for (int a = 0; a < d; a++)
            for (int k = w->p[i]; k < w->p[i + 1]; k++)
                for (int b = 0; b < d; b++) {
                    *x = row_times_block(d, B + i * dd, a, w->x + (size_t)k * dd, b);
                    if (k == w->diag[i])
                        *x += A[i * dd + a + b * d];
                    x++;
                }
}

/* The contact equations B H' dv + A dr; K and -H stay. */
static void fill_global(rb_friction_system *s, const double *A, const double *B)
{
    const rb_sparse *h = &s->problem->H;
    const int d = s->d, n = s->n;
    double *place = s->x; /* dense column under construction, zeroed as it is read */
    for (int i = 0; i < n + s->m; i++)
        place[i] = 0.0;
    for (int j = 0; j < s->m; j++) {
        const int c = j / d, a = j % d;
        for (int b = 0; b < d; b++) {
            const double factor = B[c * d * d + a + b * d];
            for (int k = h->p[c * d + b]; k < h->p[c * d + b + 1]; k++)
                place[h->i[k]] += factor * h->x[k];
            place[n + c * d + b] = A[c * d * d + a + b * d];
        }
        for (int k = s->jt.p[n + j]; k < s->jt.p[n + j + 1]; k++) {
            s->jt.x[k] = place[s->jt.i[k]];
            place[s->jt.i[k]] = 0.0;
        }
    }
}

/* LAPACKE refuses NaN with a small negative number. */
rb_status rb_friction_lapack_status(int info)
{
    if (info == 0)
        return RB_OK;
    return info == LAPACK_WORK_MEMORY_ERROR ? RB_ENOMEM : RB_SINGULAR;
}

static rb_status solve_dense(rb_friction_system *s)
{
    const int n = s->n + s->m;
    const size_t order = (size_t)n;
    for (size_t k = 0; k < order * order; k++)
        s->J[k] = 0.0;
    for (size_t j = 0; j < order; j++)
        for (int k = s->jt.p[j]; k < s->jt.p[j + 1]; k++)
            s->J[(size_t)s->jt.i[k] + order * j] = s->jt.x[k];
    for (size_t k = 0; k < order; k++)
        s->x[k] = s->rhs[k];
    int info = LAPACKE_dgetrf(LAPACK_COL_MAJOR, n, n, s->J, n, s->pivots);
    if (info == 0)
        info = LAPACKE_dgetrs(LAPACK_COL_MAJOR, 'T', n, 1, s->J, n, s->pivots, s->x, n);
    s->flops += (double)n * n * (2.0 / 3.0 * n + 2.0);
    return rb_friction_lapack_status(info);
}

static rb_status solve_sparse(rb_friction_system *s)
{
    rb_status st = rb_sparse_lu_factor(s->lu, &s->jt, &s->flops);
    if (st == RB_OK)
        st = rb_sparse_lu_solve_transposed(s->lu, s->rhs, s->x);
    s->flops += 4.0 * s->jt.p[s->jt.cols];
    return st;
}

rb_status rb_friction_system_step(rb_friction_system *s, const double *A, const double *B,
                                  const double *F, const double *e, double *dr,
                                  double *dv)
{
    const int n = s->n;
    if (n)
        fill_global(s, A, B);
    else
        fill_local(s, A, B);
    for (int i = 0; i < n; i++)
        s->rhs[i] = -e[i];
    for (int k = 0; k < s->m; k++)
        s->rhs[n + k] = -F[k];
    s->flops += 2.0 * s->d *
                (n ? (double)s->problem->H.p[s->m] * s->d
                   : (double)s->blocks.p[s->contacts] * s->d * s->d);
    const rb_status st = s->J ? solve_dense(s) : solve_sparse(s);
    for (int i = 0; i < n; i++)
        dv[i] = s->x[i];
    for (int k = 0; k < s->m; k++) {
        dr[k] = s->x[n + k];
        if (st == RB_OK && !isfinite(dr[k]))
            return RB_SINGULAR;
    }
    return st;
}
