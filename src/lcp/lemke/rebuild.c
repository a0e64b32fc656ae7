/* The tableau of Lemke's method computed again from the data and the basis. */
#include "lcp/lemke/tableau.h"

#include <cblas.h>
#include <lapacke.h>
#include <stdlib.h>
#include <string.h>

/* w = q + M z + d z0 solved for the basic variables: with C the basic ones of z and z0, R
 * the rows whose w is nonbasic (as many), A = [M d]_RC and E = [M d]_rest,C,
 *     x_C = -A^-1 g_R,   w_rest = g_rest + E x_C
 * where g is q, or the coefficients of a nonbasic variable: M_:j, d, -e_i for w_i. */
typedef struct {
    const lcp_data *data;
    int n, m;       /* order; size of R and C */
    int *row, *var; /* n: R, then the rest; the variables solved for, in that order */
    int *pivots;    /* m */
    double *A, *E;  /* m x m, (n - m) x m */
    double *g;      /* n: a column in the order of row */
} solver;

/* g of variable v. */
static void gather(const solver *p, int v)
{
    const int n = p->n;
    const double *x = p->data->p.M + (size_t)(v < n ? 0 : v - n) * (size_t)p->data->p.ldm;
    for (int k = 0; k < n; k++) {
        const int i = p->row[k];
        p->g[k] = v < n ? -(double)(i == v) : v < 2 * n ? x[i] : rb_lcp_cover(p->data, i);
    }
}

/* The columns of X, ld n, hold g in the order of row; they become the tableau's. */
static void express_in_basis(solver *p, const lcp_tableau *t, int columns, double *X)
{
    const int n = p->n, m = p->m;
    for (int c = 0; c < columns; c++)
        cblas_dscal(m, -1.0, X + (size_t)c * (size_t)n, 1);
    if (m)
        LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', m, columns, p->A, m, p->pivots, X, n);
    if (n > m)
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, n - m, columns, m, 1.0, p->E, n - m,
                    X, n, 1.0, X + m, n);
    for (int c = 0; c < columns; c++) {
        double *x = X + (size_t)c * (size_t)n;
        memcpy(p->g, x, (size_t)n * sizeof *x);
        for (int k = 0; k < n; k++)
            x[t->place[p->var[k]]] = p->g[k];
    }
}

rb_status rb_lcp_tableau_rebuild(lcp_tableau *t)
{
    const lcp_data *data = t->data;
    const int n = t->n;
    solver p = {.data = data, .n = n};
    for (int i = 0; i < n; i++)
        p.m += t->place[i] < 0;
    const size_t m = (size_t)p.m, rest = (size_t)(p.n - p.m);
    p.row = rb_alloc_int(2 * (size_t)n + m);
    p.A = rb_alloc((size_t)n, m);
    p.g = rb_alloc((size_t)n, 1);
    rb_status s = p.row && p.A && p.g ? RB_OK : RB_ENOMEM;
    if (s == RB_OK) {
        p.var = p.row + n;
        p.pivots = p.var + n;
        p.E = p.A + m * m;
        int inside = 0, outside = p.m, solved = 0;
        for (int i = 0; i < n; i++)
            p.row[t->place[i] < 0 ? inside++ : outside++] = i;
        for (int v = n; v <= 2 * n; v++)
            if (t->place[v] >= 0)
                p.var[solved++] = v;
        memcpy(p.var + m, p.row + m, rest * sizeof *p.var);
    }
    for (size_t c = 0; s == RB_OK && c < m; c++) {
        gather(&p, p.var[c]);
        memcpy(p.A + c * m, p.g, m * sizeof *p.A);
        if (rest)
            memcpy(p.E + c * rest, p.g + m, rest * sizeof *p.E);
    }
    if (s == RB_OK && m && LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, p.m, p.m, p.A, p.m, p.pivots) != 0)
        s = RB_SINGULAR;
    if (s == RB_OK) {
        for (int c = 0; c <= n; c++) {
            gather(&p, t->nonbasis[c]);
            memcpy(t->T + (size_t)c * (size_t)n, p.g, (size_t)n * sizeof *p.g);
        }
        for (int k = 0; k < n; k++)
            t->q[k] = data->p.q[p.row[k]];
        express_in_basis(&p, t, n + 1, t->T);
        express_in_basis(&p, t, 1, t->q);
        /* All columns of T are up to date. */
        for (int c = 0; c <= t->n; c++)
            t->slot[c] = c;
        t->spares = 0;
        rb_lcp_tableau_no_pivots(t);
    }
    free(p.row);
    free(p.A);
    free(p.g);
    return s;
}
