/* The linear system of a Newton step in local form, (A + B W) dr = -F.
 *
 * A contact whose equation reads r = 0 (A = 1, B = 0) has dr = -F on its own: the dense
 * system is that of the others.  The sparse one keeps its pattern; such rows cost it
 * nothing. */
#include "lcp/friction/internal.h"

#include <lapacke.h>

/* y = B x for d x d column-major B */
static void times(int d, const double *B, const double *x, double *y)
{
    for (int a = 0; a < d; a++) {
        y[a] = B[a] * x[0];
        for (int b = 1; b < d; b++)
            y[a] += B[a + b * d] * x[b];
    }
}

/* ---- Dense ------------------------------------------------------------------------- */

/* The columns of contact c in the matrix of the closed contacts. */
static void fill_dense_columns(rb_friction_system *s, int c, size_t order, const double *A,
                               const double *B)
{
    const rb_friction_blocks *w = s->blocks;
    const int d = s->d, dd = d * d;
    double *column = s->dense + (size_t)(s->place[c] * d) * order;
    for (int k = w->p[c]; k < w->p[c + 1]; k++) {
        const int i = w->i[k], row = s->place[i] * d;
        for (int b = 0; s->place[i] >= 0 && b < d; b++)
            times(d, B + i * dd, w->x + (size_t)k * (size_t)dd + b * d,
                  column + (size_t)b * order + row);
    }
    for (int b = 0; b < d; b++)
        for (int a = 0; a < d; a++)
            column[(size_t)b * order + (size_t)(s->place[c] * d + a)] += A[c * dd + a + b * d];
}

/* ---- Sparse ------------------------------------------------------------------------ */

rb_status rb_friction_local_pattern(rb_friction_system *s)
{
    const rb_friction_blocks *w = s->blocks;
    const int d = s->d;
    const size_t nz = (size_t)w->p[s->contacts] * (size_t)(d * d);
    s->j = (rb_sparse){.rows = s->m,
                       .cols = s->m,
                       .p = rb_alloc_int((size_t)s->m + 1),
                       .i = rb_alloc_int(nz),
                       .x = rb_alloc(nz, 1)};
    if (!s->j.p || !s->j.i || !s->j.x)
        return RB_ENOMEM;
    int n = 0;
    for (int j = 0; j < s->m; j++) {
        for (int k = w->p[j / d]; k < w->p[j / d + 1]; k++)
            for (int a = 0; a < d; a++)
                s->j.i[n++] = w->i[k] * d + a;
        s->j.p[j + 1] = n;
    }
    return rb_sparse_lu_create(&s->j, &s->lu);
}

/* ---- One factorisation, many solves ------------------------------------------------ */

static int wants_dense(const rb_friction_system *s)
{
    const double nc = s->contacts;
    return rb_friction_system_is_dense(s->m, s->blocks->p[s->contacts] / (nc * nc));
}

rb_status rb_friction_local_factor(rb_friction_system *s, const double *A, const double *B)
{
    const double m = s->m;
    s->flops += 2.0 * s->d * s->d * s->d * (double)s->blocks->p[s->contacts];
    if (!wants_dense(s)) {
        const rb_status st = s->lu ? RB_OK : rb_friction_local_pattern(s);
        if (st != RB_OK)
            return st;
        const rb_friction_blocks *w = s->blocks;
        const int d = s->d, dd = d * d;
        double *x = s->j.x;
        for (int c = 0; c < s->contacts; c++)
            for (int b = 0; b < d; b++)
                for (int k = w->p[c]; k < w->p[c + 1]; k++, x += d) {
                    times(d, B + w->i[k] * dd, w->x + (size_t)k * (size_t)dd + b * d, x);
                    for (int a = 0; k == w->diag[c] && a < d; a++)
                        x[a] += A[c * dd + a + b * d];
                }
        s->beside += RB_FRICTION_LU_ENTRY * s->j.p[s->j.cols];
        return rb_sparse_lu_factor(s->lu, &s->j, &s->flops);
    }
    const rb_status st = rb_friction_system_dense(s, (size_t)s->m);
    if (st != RB_OK)
        return st;
    for (int c = 0; c < s->contacts; c++)
        s->place[c] = c;
    for (int c = 0; c < s->contacts; c++)
        fill_dense_columns(s, c, (size_t)s->m, A, B);
    s->flops += 2.0 / 3.0 * m * m * m;
    return rb_lapack_status(
        LAPACKE_dgetrf(LAPACK_COL_MAJOR, s->m, s->m, s->dense, s->m, s->pivots));
}

rb_status rb_friction_local_solve(rb_friction_system *s, double *x)
{
    if (wants_dense(s)) {
        s->flops += 2.0 * s->m * (double)s->m;
        return rb_lapack_status(
            LAPACKE_dgetrs(LAPACK_COL_MAJOR, 'N', s->m, 1, s->dense, s->m, s->pivots, x, s->m));
    }
    for (int k = 0; k < s->m; k++)
        s->rhs[k] = x[k];
    s->flops += 2.0 * rb_sparse_lu_entries(s->lu);
    s->beside += RB_FRICTION_LU_SOLVE * rb_sparse_lu_entries(s->lu);
    return rb_sparse_lu_solve_once(s->lu, s->rhs, x);
}

/* ---- A step ------------------------------------------------------------------------ */

rb_status rb_friction_local_step(rb_friction_system *s, const rb_friction_linearised *at)
{
    const double blocks = s->blocks->p[s->contacts], nc = s->contacts;
    /* Numbers the contacts whose equations do not read r = 0; how many. */
    const int d = s->d, dd = d * d;
    int closed = 0;
    for (int c = 0; c < s->contacts; c++) {
        const double *A = at->A + c * dd, *B = at->B + c * dd;
        int open = 1;
        for (int k = 0; open && k < dd; k++)
            open = B[k] == 0.0 && A[k] == (k % (d + 1) == 0);
        s->place[c] = open ? -1 : closed++;
    }
    const int order = d * closed;
    if (!rb_friction_system_is_dense(order, blocks / (nc * nc))) {
        rb_status st = rb_friction_local_factor(s, at->A, at->B); /* sparse all the more */
        if (!s->lu)
            return st;
        for (int k = 0; k < s->m; k++)
            s->rhs[k] = -at->F[k];
        if (st == RB_OK)
            st = rb_sparse_lu_solve(s->lu, s->rhs, s->x);
        s->flops += 4.0 * s->j.p[s->j.cols];
        return st;
    }
    s->flops += 2.0 * s->d * s->d * s->d * blocks;
    rb_status st = rb_friction_system_dense(s, (size_t)order);
    if (st != RB_OK)
        return st;
    double *moved = s->rhs; /* W dr of the open contacts */
    for (int k = 0; k < s->m; k++)
        moved[k] = 0.0;
    for (int c = 0; c < s->contacts; c++) {
        double dr[3] = {0.0, 0.0, 0.0};
        int any = 0;
        for (int a = 0; s->place[c] < 0 && a < d; a++) {
            dr[a] = -at->F[c * d + a];
            any |= dr[a] != 0.0;
        }
        if (any)
            rb_friction_blocks_add(s->blocks, c, dr, moved);
    }
    for (int c = 0; c < s->contacts; c++) {
        if (s->place[c] < 0)
            continue;
        double *x = s->x + s->place[c] * d;
        times(d, at->B + c * dd, moved + c * d, x);
        for (int a = 0; a < d; a++)
            x[a] = -at->F[c * d + a] - x[a];
        fill_dense_columns(s, c, (size_t)order, at->A, at->B);
    }
    st = order ? rb_friction_system_solve_dense(s, order, 'N') : RB_OK;
    if (st != RB_OK)
        return st;
    /* x of the closed contacts -> dr of all; from the end, since both are in s->x */
    for (int c = s->contacts - 1; c >= 0; c--)
        for (int a = 0; a < d; a++)
            s->x[c * d + a] = s->place[c] < 0 ? -at->F[c * d + a] : s->x[s->place[c] * d + a];
    return RB_OK;
}
