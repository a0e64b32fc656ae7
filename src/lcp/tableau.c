#include "lcp/tableau.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A constant that a step brings to this part of itself was to vanish: kept, its rounding
 * error would break ties that are to be broken lexicographically. */
static const double SNAP = 1e-11;

/* Memory traffic per pivot: 16 n^2/depth bytes in the product, 4 n depth in the columns.
 */
static int delay(int n)
{
    return n < 16 ? n : n < 256 ? 16 : n < 1024 ? 24 : 64;
}

static double *column_of(const lcp_tableau *t, int c)
{
    return t->T + (size_t)c * (size_t)t->n;
}

void rb_lcp_tableau_free(lcp_tableau *t)
{
    free(t->T);
    free(t->q);
    free(t->basis);
    free(t->U);
    free(t->S);
    free(t->L);
    free(t->s);
    free(t->row);
    memset(t, 0, sizeof *t);
}

void rb_lcp_tableau_forget(lcp_tableau *t)
{
    memset(t->row_hit, 0, (size_t)t->n * sizeof *t->row_hit);
    for (int c = 0; c <= t->n; c++)
        t->col_hit[c] = -1;
    t->k = 0;
}

static void start(const lcp_data *data, lcp_tableau *t)
{
    const int n = data->n;
    const size_t bytes = (size_t)n * sizeof(double);
    for (int j = 0; j < n; j++)
        memcpy(column_of(t, j), data->M + (size_t)j * (size_t)data->ldm, bytes);
    for (int i = 0; i < n; i++)
        column_of(t, n)[i] = rb_lcp_cover(data, i);
    memcpy(t->q, data->q, bytes);
    for (int i = 0; i < n; i++)
        t->basis[i] = t->place[i] = i;
    for (int c = 0; c <= n; c++) {
        t->nonbasis[c] = n + c;
        t->place[n + c] = -1 - c;
    }
    rb_lcp_tableau_forget(t);
}

rb_status rb_lcp_tableau_create(const lcp_data *data, lcp_tableau *t)
{
    const size_t rows = (size_t)data->n, cols = rows + 1, depth = (size_t)delay(data->n);
    memset(t, 0, sizeof *t);
    t->n = data->n;
    t->depth = (int)depth;
    t->T = rb_alloc(rows, cols);
    t->q = rb_alloc(rows, 1);
    t->U = rb_alloc(rows, depth);
    t->S = rb_alloc(depth, cols);
    t->L = rb_alloc(depth, depth);
    t->s = rb_alloc(depth, 1);
    t->basis = rb_alloc_int(2 * (rows + cols));
    t->row = rb_alloc_int(2 * depth + rows + cols);
    if (!t->T || !t->q || !t->U || !t->S || !t->L || !t->s || !t->basis || !t->row) {
        rb_lcp_tableau_free(t);
        return RB_ENOMEM;
    }
    t->nonbasis = t->basis + rows;
    t->place = t->nonbasis + cols;
    t->first = t->row + depth;
    t->row_hit = t->first + depth;
    t->col_hit = t->row_hit + rows;
    start(data, t);
    return RB_OK;
}

/* Takes the pivot rows out of column c (x: its values at the last flush): they are the
 * right-hand side of the triangular solve for S_:c. */
static void take_pivot_rows(const lcp_tableau *t, int c, double *x, double *rhs)
{
    if (t->col_hit[c] < 0) {
        for (int j = 0; j < t->k; j++)
            rhs[j] = t->first[j] ? x[t->row[j]] : 0.0;
        for (int j = 0; j < t->k; j++)
            x[t->row[j]] = 0.0;
    } else {
        memset(rhs, 0, (size_t)t->k * sizeof *rhs);
        memset(x, 0, (size_t)t->n * sizeof *x);
        rhs[t->col_hit[c]] = -1.0;
    }
}

void rb_lcp_tableau_column(lcp_tableau *t, int c, double *a)
{
    memcpy(a, column_of(t, c), (size_t)t->n * sizeof *a);
    if (!t->k)
        return;
    take_pivot_rows(t, c, a, t->s);
    cblas_dtrsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, t->k, t->L,
                t->depth, t->s, 1);
    cblas_dgemv(CblasColMajor, CblasNoTrans, t->n, t->k, -1.0, t->U, t->n, t->s, 1, 1.0,
                a, 1);
}

static int is_zero(int n, const double *x)
{
    int i = 0;
    while (i < n && x[i] == 0.0)
        i++;
    return i == n;
}

/* T <- T - U S on the columns from first to before last. */
static void update_columns(lcp_tableau *t, int first, int last)
{
    double *S = t->S + (size_t)first * (size_t)t->depth;
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, t->k,
                last - first, 1.0, t->L, t->depth, S, t->depth);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, t->n, last - first, t->k, -1.0,
                t->U, t->n, S, t->depth, 1.0, column_of(t, first), t->n);
}

/* Columns without entries in the pivot rows do not change: half of them in the pivoted
 * form of friction problems.  A gap shorter than GAP is not worth another product. */
void rb_lcp_tableau_flush(lcp_tableau *t)
{
    enum { GAP = 32 };
    int first = 0, last = 0;
    for (int c = 0; c <= t->n && t->k; c++) {
        double *rhs = t->S + (size_t)c * (size_t)t->depth;
        take_pivot_rows(t, c, column_of(t, c), rhs);
        if (is_zero(t->k, rhs))
            continue;
        if (c - last >= GAP) {
            update_columns(t, first, last);
            first = c;
        }
        last = c + 1;
    }
    update_columns(t, first, last);
    rb_lcp_tableau_forget(t);
}

static void exchange(lcp_tableau *t, int r, int c)
{
    const int leaving = t->basis[r], entering = t->nonbasis[c];
    t->basis[r] = entering;
    t->place[entering] = r;
    t->nonbasis[c] = leaving;
    t->place[leaving] = -1 - c;
}

/* Pivot number k enters L and U. */
static void remember_pivot(lcp_tableau *t, int r, int c, const double *a)
{
    const size_t n = (size_t)t->n, depth = (size_t)t->depth, k = (size_t)t->k;
    for (size_t j = 0; j < k; j++) {
        double *u = t->U + j * n + r;
        t->L[k + j * depth] = *u;
        *u = 0.0;
    }
    t->L[k + k * depth] = a[r];
    memcpy(t->U + k * n, a, n * sizeof *a);
    t->U[k * n + (size_t)r] = 1.0;
    t->row[k] = r;
    t->first[k] = !t->row_hit[r];
    t->row_hit[r] = 1;
    t->col_hit[c] = t->k++;
}

void rb_lcp_tableau_pivot(lcp_tableau *t, int r, int c, const double *a)
{
    const double step = t->q[r] / a[r];
    for (int i = 0; i < t->n; i++) {
        const double change = step * a[i], value = t->q[i] - change;
        t->q[i] = fabs(value) <= SNAP * fabs(change) ? 0.0 : value;
    }
    t->q[r] = -step;
    remember_pivot(t, r, c, a);
    exchange(t, r, c);
    if (t->k == t->depth)
        rb_lcp_tableau_flush(t);
}
