/* Linear systems with a proof: the approximate inverse R of A, how much R A lacks to the
 * identity, and the bound of each unknown that follows from a residual. */
#include "lcp/proof/bounds.h"

#include "base/base.h"

#include <cblas.h>
#include <fenv.h>
#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

int rb_proof_arithmetic(void)
{
    volatile double least = DBL_MIN, one = 1.0, u = PROOF_U;
    return fegetround() == FE_TONEAREST && least / 2.0 > 0.0 && one + u == 1.0 &&
           one + u * 1.5 == 1.0 + DBL_EPSILON;
}

void rb_proof_abs_product(int m, int n, const double *A, int ld, const double *x, double *y)
{
    memset(y, 0, (size_t)m * sizeof *y);
    for (int j = 0; j < n; j++) {
        const double *a = A + (size_t)j * (size_t)ld;
        for (int i = 0; i < m; i++)
            y[i] += fabs(a[i]) * x[j];
    }
}

/* Rows and columns by powers of two, so that the largest modulus of each is near 1; factor:
 * 2k.  Where scaling back does not give A again, because of underflow, A stays as it is. */
static void scale(int k, const double *A, int *row, int *column, double *factor, double *B)
{
    const size_t n = (size_t)k;
    double *by_row = factor, *by_column = factor + n;
    for (size_t i = 0; i < 2 * n; i++)
        factor[i] = 1.0;
    for (int pass = 0; pass < 4; pass++) {
        int *power = pass % 2 ? column : row;
        double *by = pass % 2 ? by_column : by_row;
        double *most = factor + 2 * n;
        memset(most, 0, n * sizeof *most);
        for (size_t j = 0; j < n; j++)
            for (size_t i = 0; i < n; i++) {
                const double a = fabs(A[i + j * n]) * by_row[i] * by_column[j];
                double *of = most + (pass % 2 ? j : i);
                *of = a > *of ? a : *of;
            }
        for (size_t i = 0; i < n; i++) {
            if (most[i] > 0.0 && isfinite(most[i]))
                power[i] -= (int)rint(log2(most[i]));
            by[i] = ldexp(1.0, power[i]);
        }
    }
    int same = 1;
    for (size_t i = 0; i < 2 * n; i++)
        same &= factor[i] >= DBL_MIN && factor[i] <= 1.0 / DBL_MIN;
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < n; i++) {
            const double a = A[i + j * n], b = a * by_row[i] * by_column[j];
            B[i + j * n] = b;
            same &= b * (1.0 / by_column[j]) * (1.0 / by_row[i]) == a;
        }
    if (same)
        return;
    memset(row, 0, n * sizeof *row);
    memset(column, 0, n * sizeof *column);
    memcpy(B, A, n * n * sizeof *B);
}

/* Step 2 of docs/proof.md: R and g_i >= sum_j |I - R A|_ij, of which norm = max g < 1 says that A
 * is regular. */
int rb_proof_inverse(int k, double *A, double unknown, proof_inverse *v)
{
    const size_t n = (size_t)k;
    *v = (proof_inverse){.k = k, .norm = 0.0};
    v->A = rb_alloc(n, n);
    v->R = rb_alloc(n, n);
    v->g = rb_alloc(n, 1);
    v->work = rb_alloc(n, 5);
    v->row = rb_alloc_int(n);
    v->column = rb_alloc_int(n);
    lapack_int *pivot = malloc((n ? n : 1) * sizeof *pivot);
    const int room = A && v->A && v->R && v->g && v->work && v->row && v->column && pivot;
    if (room && k) {
        double *rows = v->work, *sums = v->work + n;
        scale(k, A, v->row, v->column, v->work, v->A);
        memcpy(v->R, v->A, n * n * sizeof *v->R);
        v->norm = INFINITY;
        if (LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, k, k, v->R, k, pivot) == 0 &&
            LAPACKE_dgetri_work(LAPACK_COL_MAJOR, k, v->R, k, pivot, A, k * k) == 0) {
            /* D = R A - I, whose own rounding is bounded by |R| |A| 1: no second product. */
            cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, k, k, k, 1.0, v->R, k, v->A, k,
                        0.0, A, k);
            for (size_t i = 0; i < n; i++) {
                A[i + i * n] -= 1.0;
                v->g[i] = 1.0;
            }
            rb_proof_abs_product(k, k, v->A, k, v->g, rows);
            for (size_t i = 0; i < n; i++)
                rows[i] = proof_up(n, rows[i]);
            rb_proof_abs_product(k, k, v->R, k, rows, sums);
            rb_proof_abs_product(k, k, A, k, v->g, rows);
            for (size_t i = 0; i < n; i++)
                v->g[i] = proof_up(4, proof_up(n, rows[i]) + unknown * proof_up(n, sums[i]) +
                                          proof_error(n, proof_up(n, sums[i]) + 1.0) +
                                          (double)k * (double)k * PROOF_TINY);
            v->norm = rb_norm_inf(n, v->g);
        }
    }
    free(pivot);
    free(A);
    return room;
}

void rb_proof_inverse_free(proof_inverse *v)
{
    free(v->A);
    free(v->R);
    free(v->g);
    free(v->work);
    free(v->row);
    free(v->column);
    *v = (proof_inverse){0};
}

/* Step 3 by components: e = min(e, d + |I - R A| e), where unknowns are of very different sizes:
 * the row sums g take all of them for as large as the largest. */
static void tighten(const proof_inverse *v, const double *d, double *e)
{
    enum { SWEEPS = 3 };
    const size_t n = (size_t)v->k;
    for (int sweep = 0; sweep < SWEEPS; sweep++)
        for (size_t i = 0; i < n; i++) {
            double sum = d[i];
            for (size_t j = 0; j < n; j++) {
                double lack = i == j ? -1.0 : 0.0, size = i == j ? 1.0 : 0.0;
                for (size_t k = 0; k < n; k++) {
                    lack += v->R[i + k * n] * v->A[k + j * n];
                    size += fabs(v->R[i + k * n] * v->A[k + j * n]);
                }
                sum += proof_up(4, fabs(lack) + proof_error(n + 1, size)) * e[j];
            }
            e[i] = fmin(e[i], proof_up(2 * n + 2, sum));
        }
}

/* Step 3: |A^-1 r| <= d + g max(d)/(1 - norm) with d = |R| |r|, r = A x + b bounded as in bounds.h.
 */
void rb_proof_solve(const proof_inverse *v, const double *given, const double *radius, int fine,
                    double *x, double *e)
{
    const int k = v->k;
    const size_t n = (size_t)k;
    double *b = v->work, *r = b + n, *size = r + n, *low = size + n, *d = low + n;
    if (k == 0)
        return;
    /* x = -R b, refined twice */
    for (size_t i = 0; i < n; i++) {
        b[i] = ldexp(given[i], v->row[i]);
        low[i] = 0.0;
    }
    cblas_dgemv(CblasColMajor, CblasNoTrans, k, k, -1.0, v->R, k, b, 1, 0.0, x, 1);
    for (int turn = 0; turn < 2; turn++) {
        memcpy(r, b, n * sizeof *r);
        cblas_dgemv(CblasColMajor, CblasNoTrans, k, k, 1.0, v->A, k, x, 1, 1.0, r, 1);
        cblas_dgemv(CblasColMajor, CblasNoTrans, k, k, -1.0, v->R, k, r, 1, 1.0, x, 1);
    }
    /* d >= |R| |A x + b| */
    if (!fine) {
        for (size_t i = 0; i < n; i++)
            e[i] = fabs(x[i]);
        rb_proof_abs_product(k, k, v->A, k, e, size);
        memcpy(r, b, n * sizeof *r);
        cblas_dgemv(CblasColMajor, CblasNoTrans, k, k, 1.0, v->A, k, x, 1, 1.0, r, 1);
        for (size_t i = 0; i < n; i++)
            r[i] = fabs(r[i]) + proof_error(n + 1, size[i] + fabs(b[i]));
    } else /* of x + low, low a correction by a residual in twice the precision */
        for (int turn = 0; turn < 2; turn++) {
            for (size_t i = 0; i < n; i++) {
                proof_dot sum = {b[i], 0.0, fabs(b[i])};
                for (size_t j = 0; j < n; j++)
                    proof_add(&sum, v->A[i + j * n], x[j]);
                for (size_t j = 0; turn && j < n; j++)
                    proof_add(&sum, v->A[i + j * n], low[j]);
                double error;
                r[i] = proof_value(&sum, 2 * n + 1, &error);
                if (turn)
                    r[i] = fabs(r[i]) + error;
            }
            if (!turn)
                cblas_dgemv(CblasColMajor, CblasNoTrans, k, k, -1.0, v->R, k, r, 1, 0.0, low, 1);
        }
    for (size_t i = 0; i < n; i++) {
        r[i] = proof_up(4, r[i]) + PROOF_TINY;
        if (radius)
            r[i] = proof_up(4, r[i] + ldexp(radius[i], v->row[i])) + PROOF_TINY;
    }
    rb_proof_abs_product(k, k, v->R, k, r, d);
    /* |A^-1 r| <= d + g max(d)/(1 - max g), by components */
    for (size_t i = 0; i < n; i++)
        d[i] = proof_up(n, d[i]);
    const double most = rb_norm_inf(n, d);
    for (size_t i = 0; i < n; i++)
        e[i] = proof_up(8, d[i] + v->g[i] * (most / (1.0 - v->norm)));
    if (fine == PROOF_FINEST)
        tighten(v, d, e);
    for (size_t i = 0; i < n; i++) {
        e[i] = proof_up(8, e[i] + 4.0 * PROOF_U * (fabs(x[i]) + fabs(low[i])));
        x[i] = ldexp(x[i] + low[i], v->column[i]);
        e[i] = ldexp(e[i], v->column[i]) + PROOF_TINY;
    }
}
