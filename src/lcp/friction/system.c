/* The linear system of one Newton step (internal.h): what both forms share, and the global form,
 * which is sparse where W = H' K^-1 H is full. */
#include "lcp/friction/internal.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>

void rb_friction_system_free(rb_friction_system *s)
{
    rb_sparse_lu_free(s->lu);
    rb_sparse_free(&s->j);
    free(s->dense);
    free(s->pivots);
    free(s->place);
    free(s->rho);
    *s = (rb_friction_system){0};
}

/* ---- Global form: the transposed matrix, whose columns are the equations ----------- */

rb_status rb_friction_system_init(rb_friction_task *task, int n, rb_friction_system *s)
{
    const size_t order = (size_t)(n + task->m), nc = (size_t)task->contacts;
    *s = (rb_friction_system){.problem = task->problem,
                              .d = task->d,
                              .contacts = task->contacts,
                              .m = task->m,
                              .n = n,
                              .rho = rb_alloc(2 * nc + 2 * order, 1),
                              .place = rb_alloc_int(nc)};
    rb_status st = s->rho && s->place ? RB_OK : RB_ENOMEM;
    if (st == RB_OK) {
        s->rhs = s->rho + 2 * nc;
        s->x = s->rhs + order;
        if (!n)
            st = rb_friction_task_blocks(task, &s->blocks);
        else { /* one filling of the global pattern; only places matter */
            const rb_sparse *h = &s->problem->H;
            const int d = s->d;
            rb_triplets t = {.rows = n + s->m, .cols = n + s->m};
            rb_triplets_add_matrix(&t, 1.0, &s->problem->K);
            for (int j = 0; j < h->cols; j++) {
                const int c = j / d;
                for (int l = h->p[j]; l < h->p[j + 1]; l++)
                    rb_triplets_add(&t, n + j, h->i[l], -h->x[l]);
                for (int a = 0; a < d; a++) {
                    for (int l = h->p[c * d + a]; l < h->p[c * d + a + 1]; l++)
                        rb_triplets_add(&t, h->i[l], n + j, 0.0);
                    rb_triplets_add(&t, n + c * d + a, n + j, 0.0);
                }
            }
            st = rb_sparse_from_triplets(&t, &s->j);
            rb_triplets_free(&t);
        }
    }
    if (st == RB_OK)
        st = rb_friction_rho(n ? task->problem : task->shared->local, s->rho);
    if (st != RB_OK)
        rb_friction_system_free(s);
    return st;
}

/* ---- Products ---------------------------------------------------------------------- */

void rb_friction_system_velocity(const rb_friction_system *s, double constant, const double *r,
                                 const double *v, double *u)
{
    const rb_friction_problem *p = s->problem;
    if (s->n)
        rb_sparse_apply_transposed(1.0, &p->H, v, 0.0, u);
    else
        rb_friction_blocks_apply(s->blocks, r, u);
    for (int k = 0; k < s->m && constant != 0.0; k++)
        u[k] += constant * (s->n ? p->w[k] : p->q[k]);
}

void rb_friction_system_imbalance(const rb_friction_system *s, const double *r, const double *v,
                                  double *e)
{
    if (!s->n)
        return;
    for (int i = 0; i < s->n; i++)
        e[i] = -s->problem->f[i];
    rb_sparse_apply(1.0, &s->problem->K, v, 1.0, e);
    rb_sparse_apply(-1.0, &s->problem->H, r, 1.0, e);
}

/* Above this share of entries, and below this order, dense LU is the faster one. */
#define DENSE_FILL 0.15
#define DENSE_ORDER 120

int rb_friction_system_is_dense(int order, double fill)
{
    return order <= DENSE_ORDER || fill > DENSE_FILL;
}

/* ---- Steps ------------------------------------------------------------------------- */

rb_status rb_friction_system_dense(rb_friction_system *s, size_t order)
{
    if (order > s->order) {
        free(s->dense);
        free(s->pivots);
        s->dense = rb_alloc(order, order);
        s->pivots = rb_alloc_int(order);
        s->order = s->dense && s->pivots ? order : 0;
    }
    for (size_t k = 0; s->order && k < order * order; k++)
        s->dense[k] = 0.0;
    return s->order || !order ? RB_OK : RB_ENOMEM;
}

rb_status rb_friction_system_solve_dense(rb_friction_system *s, int order, char transposed)
{
    int info = LAPACKE_dgetrf(LAPACK_COL_MAJOR, order, order, s->dense, order, s->pivots);
    if (info == 0)
        info = LAPACKE_dgetrs(LAPACK_COL_MAJOR, transposed, order, 1, s->dense, order, s->pivots,
                              s->x, order);
    s->flops += (double)order * order * (2.0 / 3.0 * order + 2.0);
    return rb_lapack_status(info);
}

static rb_status global_step(rb_friction_system *s, const rb_friction_linearised *at,
                             const double *e)
{
    const int n = s->n, order = n + s->m;
    /* The rows B H' and A of the contacts change from step to step; K and -H stay.  The matrix is
     * kept transposed, so that each row is a column that can be filled at once. */
    const rb_sparse *h = &s->problem->H;
    const int d = s->d;
    double *place = s->x; /* dense column under construction, zeroed as it is read */
    for (int i = 0; i < n + s->m; i++)
        place[i] = 0.0;
    for (int j = 0; j < s->m; j++) {
        const int c = j / d, a = j % d;
        for (int b = 0; b < d; b++) {
            const double factor = at->B[c * d * d + a + b * d];
            for (int k = h->p[c * d + b]; k < h->p[c * d + b + 1]; k++)
                place[h->i[k]] += factor * h->x[k];
            place[n + c * d + b] = at->A[c * d * d + a + b * d];
        }
        for (int k = s->j.p[n + j]; k < s->j.p[n + j + 1]; k++) {
            s->j.x[k] = place[s->j.i[k]];
            place[s->j.i[k]] = 0.0;
        }
    }
    for (int i = 0; i < n; i++)
        s->rhs[i] = -e[i];
    for (int k = 0; k < s->m; k++)
        s->rhs[n + k] = -at->F[k];
    /* Dense LU where the order is small or the matrix rather full, else sparse. */
    s->flops += 2.0 * s->d * (double)s->problem->H.p[s->m] * s->d;
    if (rb_friction_system_is_dense(order, s->j.p[order] / ((double)order * order))) {
        const size_t ld = (size_t)order;
        const rb_status dense = rb_friction_system_dense(s, ld);
        for (size_t j = 0; dense == RB_OK && j < ld; j++) {
            s->x[j] = s->rhs[j];
            for (int k = s->j.p[j]; k < s->j.p[j + 1]; k++)
                s->dense[(size_t)s->j.i[k] + ld * j] = s->j.x[k];
        }
        return dense == RB_OK ? rb_friction_system_solve_dense(s, order, 'T') : dense;
    }
    rb_status st = s->lu ? RB_OK : rb_sparse_lu_create(&s->j, &s->lu);
    if (st == RB_OK)
        st = rb_sparse_lu_factor(s->lu, &s->j, &s->flops);
    s->beside += RB_FRICTION_LU_ENTRY * s->j.p[order];
    if (st == RB_OK)
        st = rb_sparse_lu_solve_transposed(s->lu, s->rhs, s->x);
    s->flops += 4.0 * s->j.p[s->j.cols];
    return st;
}

rb_status rb_friction_system_estimate(rb_friction_system *s, double *flops)
{
    const double order = s->n + s->m, nc = s->contacts;
    const double fill =
        s->n ? s->j.p[s->n + s->m] / (order * order) : s->blocks->p[s->contacts] / (nc * nc);
    rb_status st = RB_OK;
    *flops = 2.0 / 3.0 * order * order * order;
    if (rb_friction_system_is_dense((int)order, fill))
        return st;
    if (!s->lu)
        st = s->n ? rb_sparse_lu_create(&s->j, &s->lu) : rb_friction_local_pattern(s);
    if (st == RB_OK)
        st = rb_sparse_lu_estimate(&s->j, flops);
    if (s->lu) { /* the orderings take about as long as a factorisation of a sparse matrix */
        const double beside = RB_FRICTION_LU_ENTRY * s->j.p[s->j.cols];
        *flops += beside;
        s->beside += beside;
    }
    return st;
}

void rb_friction_system_count(rb_friction_system *s, rb_friction_task *task)
{
    task->info->flops += s->flops;
    task->beside += s->beside;
    s->flops = s->beside = 0.0;
}

rb_status rb_friction_system_begin(rb_friction_system *s, rb_friction_task *task, int *begun,
                                   double *cost)
{
    if (*begun)
        return RB_MAXITER;
    *begun = 1;
    rb_status st = rb_friction_task_assess(task);
    if (st == RB_MAXITER && isfinite(task->budget) &&
        rb_friction_system_estimate(s, cost) == RB_ENOMEM)
        st = RB_ENOMEM;
    rb_friction_system_count(s, task);
    return st;
}

rb_status rb_friction_system_step(rb_friction_system *s, const rb_friction_linearised *at,
                                  const double *e, double *dr, double *dv)
{
    /* x = (dv, dr); in the local form dr alone. */
    const rb_status st = s->n ? global_step(s, at, e) : rb_friction_local_step(s, at);
    for (int i = 0; i < s->n; i++)
        dv[i] = s->x[i];
    for (int k = 0; k < s->m; k++) {
        dr[k] = s->x[s->n + k];
        if (st == RB_OK && !isfinite(dr[k]))
            return RB_SINGULAR;
    }
    return st;
}
