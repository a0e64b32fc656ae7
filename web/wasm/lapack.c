/* LAPACKE for WebAssembly: the functions that rollbem's core calls. */
#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void swap_rows(int n, double *A, size_t lda, int i, int k)
{
    if (i == k)
        return;
    for (int j = 0; j < n; j++) {
        double *column = A + (size_t)j * lda, kept = column[i];
        column[i] = column[k];
        column[k] = kept;
    }
}

/* Columns first ... first + width - 1 of the LU, unblocked; the rows of these alone are
 * interchanged. */
static int factor_panel(int m, double *A, size_t lda, int first, int width, int *pivots)
{
    int fault = 0;
    for (int j = first; j < first + width && j < m; j++) {
        double *a = A + (size_t)j * lda;
        const int p = j + (int)cblas_idamax(m - j, a + j, 1);
        pivots[j] = p + 1;
        swap_rows(width, A + (size_t)first * lda, lda, j, p);
        if (a[j] == 0.0) {
            fault = fault ? fault : j + 1;
            continue;
        }
        cblas_dscal(m - j - 1, 1.0 / a[j], a + j + 1, 1);
        for (int k = j + 1; k < first + width; k++) {
            double *x = A + (size_t)k * lda;
            cblas_daxpy(m - j - 1, -x[j], a + j + 1, 1, x + j + 1, 1);
        }
    }
    return fault;
}

int LAPACKE_dgetrf_work(int layout, int m, int n, double *A, int lda, int *pivots)
{
    enum { PANEL = 24 };
    const size_t ld = (size_t)lda;
    const int least = m < n ? m : n;
    int fault = 0;
    (void)layout;
    for (int first = 0; first < least; first += PANEL) {
        const int width = least - first < PANEL ? least - first : PANEL, behind = first + width;
        const int f = factor_panel(m, A, ld, first, width, pivots);
        fault = fault ? fault : f;
        for (int j = first; j < behind; j++) {
            swap_rows(first, A, ld, j, pivots[j] - 1);
            swap_rows(n - behind, A + (size_t)behind * ld, ld, j, pivots[j] - 1);
        }
        if (behind == n)
            continue;
        double *right = A + first + (size_t)behind * ld;
        cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasUnit, width,
                    n - behind, 1.0, A + (size_t)first * (ld + 1), lda, right, lda);
        if (behind < m)
            cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, m - behind, n - behind, width,
                        -1.0, A + behind + (size_t)first * ld, lda, right, lda, 1.0,
                        A + behind + (size_t)behind * ld, lda);
    }
    return fault;
}

int LAPACKE_dgetrf(int layout, int m, int n, double *A, int lda, int *pivots)
{
    return LAPACKE_dgetrf_work(layout, m, n, A, lda, pivots);
}

int LAPACKE_dlaswp_work(int layout, int n, double *A, int lda, int k1, int k2, const int *pivots,
                        int incx)
{
    (void)layout;
    for (int step = 0; step <= k2 - k1; step++) {
        const int i = incx > 0 ? k1 + step : k2 - step;
        swap_rows(n, A, (size_t)lda, i - 1, pivots[i - 1] - 1);
    }
    return 0;
}

int LAPACKE_dgetrs_work(int layout, char trans, int n, int nrhs, const double *A, int lda,
                        const int *pivots, double *B, int ldb)
{
    const enum CBLAS_TRANSPOSE t = trans == 'N' ? CblasNoTrans : CblasTrans;
    const enum CBLAS_UPLO first = trans == 'N' ? CblasLower : CblasUpper,
                          second = trans == 'N' ? CblasUpper : CblasLower;
    if (trans == 'N')
        LAPACKE_dlaswp_work(layout, nrhs, B, ldb, 1, n, pivots, 1);
    cblas_dtrsm(CblasColMajor, CblasLeft, first, t, first == CblasLower ? CblasUnit : CblasNonUnit,
                n, nrhs, 1.0, A, lda, B, ldb);
    cblas_dtrsm(CblasColMajor, CblasLeft, second, t,
                second == CblasLower ? CblasUnit : CblasNonUnit, n, nrhs, 1.0, A, lda, B, ldb);
    if (trans != 'N')
        LAPACKE_dlaswp_work(layout, nrhs, B, ldb, 1, n, pivots, -1);
    return 0;
}

int LAPACKE_dgesv_work(int layout, int n, int nrhs, double *A, int lda, int *pivots, double *B,
                       int ldb)
{
    const int fault = LAPACKE_dgetrf_work(layout, n, n, A, lda, pivots);
    return fault ? fault : LAPACKE_dgetrs_work(layout, 'N', n, nrhs, A, lda, pivots, B, ldb);
}

/* A = U'U column by column, in the upper triangle; uplo is 'U' here. */
int LAPACKE_dpotrf(int layout, char uplo, int n, double *A, int lda)
{
    (void)layout;
    (void)uplo;
    for (int j = 0; j < n; j++) {
        double *column = A + (size_t)j * (size_t)lda;
        for (int i = 0; i <= j; i++) {
            const double *other = A + (size_t)i * (size_t)lda;
            const double left = column[i] - cblas_ddot(i, other, 1, column, 1);
            if (i == j && !(left > 0.0))
                return j + 1;
            column[i] = i == j ? sqrt(left) : left / other[i];
        }
    }
    return 0;
}

/* A = LL' by columns, in the lower triangle; uplo is 'L' here. */
int LAPACKE_dpotrf_work(int layout, char uplo, int n, double *A, int lda)
{
    (void)layout;
    (void)uplo;
    for (int j = 0; j < n; j++) {
        double *column = A + (size_t)j * (size_t)lda;
        for (int k = 0; k < j; k++) {
            const double *other = A + (size_t)k * (size_t)lda;
            cblas_daxpy(n - j, -other[j], other + j, 1, column + j, 1);
        }
        if (!(column[j] > 0.0))
            return j + 1;
        cblas_dscal(n - j, 1.0 / sqrt(column[j]), column + j, 1);
    }
    return 0;
}

/* The inverse from an LU; work holds n x n numbers. */
int LAPACKE_dgetri_work(int layout, int n, double *A, int lda, const int *pivots, double *work,
                        int size)
{
    (void)size;
    memset(work, 0, (size_t)n * (size_t)n * sizeof *work);
    for (int i = 0; i < n; i++)
        work[(size_t)i * ((size_t)n + 1)] = 1.0;
    LAPACKE_dgetrs_work(layout, 'N', n, n, A, lda, pivots, work, n);
    for (int j = 0; j < n; j++)
        memcpy(A + (size_t)j * (size_t)lda, work + (size_t)j * (size_t)n, (size_t)n * sizeof *work);
    return 0;
}

/* The upper triangle of the inverse, from U: columns of U^-1 U^-T e_j. */
int LAPACKE_dpotri(int layout, char uplo, int n, double *A, int lda)
{
    double *X = calloc((size_t)n * (size_t)n + 1, sizeof *X);
    (void)layout;
    (void)uplo;
    if (!X)
        return LAPACK_WORK_MEMORY_ERROR;
    for (int i = 0; i < n; i++)
        X[(size_t)i * ((size_t)n + 1)] = 1.0;
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasUpper, CblasTrans, CblasNonUnit, n, n, 1.0, A, lda,
                X, n);
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasUpper, CblasNoTrans, CblasNonUnit, n, n, 1.0, A, lda,
                X, n);
    for (int j = 0; j < n; j++)
        memcpy(A + (size_t)j * (size_t)lda, X + (size_t)j * (size_t)n, ((size_t)j + 1) * sizeof *X);
    free(X);
    return 0;
}

/* Hager's estimate of the 1-norm of the inverse from an LU whose rows keep their order:
 * as dgecon, the permutation does not matter. */
int LAPACKE_dgecon_work(int layout, char norm, int n, const double *A, int lda, double anorm,
                        double *rcond, double *work, int *iwork)
{
    double *x = work, estimate = 0.0;
    int at = -1;
    (void)norm;
    for (int i = 0; i < n; i++) {
        iwork[i] = i + 1; /* no interchanges */
        x[i] = 1.0 / n;
    }
    for (int round = 0; round < 5; round++) {
        LAPACKE_dgetrs_work(layout, 'N', n, 1, A, lda, iwork, x, n);
        const double size = cblas_dasum(n, x, 1);
        if (round > 0 && size <= estimate)
            break;
        estimate = size;
        for (int i = 0; i < n; i++)
            x[i] = x[i] >= 0.0 ? 1.0 : -1.0;
        LAPACKE_dgetrs_work(layout, 'T', n, 1, A, lda, iwork, x, n);
        const int next = (int)cblas_idamax(n, x, 1);
        if (next == at)
            break;
        at = next;
        memset(x, 0, (size_t)n * sizeof *x);
        x[at] = 1.0;
    }
    *rcond = estimate > 0.0 && anorm > 0.0 ? 1.0 / (estimate * anorm) : 0.0;
    return 0;
}
