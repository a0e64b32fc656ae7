/* CBLAS for WebAssembly: the functions that rollbem's core calls, and no more of them.
 * Loops run down columns, four columns at a time, so that the compiler fills its vectors
 * without changing the order of a sum's terms within a column. */
#include <cblas.h>
#include <math.h>
#include <stdlib.h>

double cblas_ddot(int n, const double *x, int incx, const double *y, int incy)
{
    double sum[4] = {0.0, 0.0, 0.0, 0.0};
    int i = 0;
    if (incx == 1 && incy == 1)
        for (; i + 4 <= n; i += 4)
            for (int k = 0; k < 4; k++)
                sum[k] += x[i + k] * y[i + k];
    for (; i < n; i++)
        sum[0] += x[(ptrdiff_t)i * incx] * y[(ptrdiff_t)i * incy];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

double cblas_dasum(int n, const double *x, int incx)
{
    double sum = 0.0;
    for (ptrdiff_t i = 0; i < n; i++)
        sum += fabs(x[i * incx]);
    return sum;
}

size_t cblas_idamax(int n, const double *x, int incx)
{
    size_t at = 0;
    double most = -1.0;
    for (ptrdiff_t i = 0; i < n; i++)
        if (fabs(x[i * incx]) > most) {
            most = fabs(x[i * incx]);
            at = (size_t)i;
        }
    return at;
}

double cblas_dnrm2(int n, const double *x, int incx)
{
    const double most = n > 0 ? fabs(x[(ptrdiff_t)cblas_idamax(n, x, incx) * incx]) : 0.0;
    double sum = 0.0;
    if (!(most > 0.0 && isfinite(most)))
        return most;
    for (ptrdiff_t i = 0; i < n; i++)
        sum += (x[i * incx] / most) * (x[i * incx] / most);
    return most * sqrt(sum);
}

void cblas_daxpy(int n, double a, const double *x, int incx, double *y, int incy)
{
    if (incx == 1 && incy == 1)
        for (int i = 0; i < n; i++)
            y[i] += a * x[i];
    else
        for (ptrdiff_t i = 0; i < n; i++)
            y[i * incy] += a * x[i * incx];
}

void cblas_dscal(int n, double a, double *x, int incx)
{
    for (ptrdiff_t i = 0; i < n; i++)
        x[i * incx] *= a;
}

/* For crack.c, whose steps are positive. */
void cblas_drot(int n, double *x, int incx, double *y, int incy, double c, double s)
{
    for (int i = 0; i < n; i++) {
        const double before = x[i * incx];
        x[i * incx] = c * before + s * y[i * incy];
        y[i * incy] = c * y[i * incy] - s * before;
    }
}

void cblas_dswap(int n, double *x, int incx, double *y, int incy)
{
    cblas_drot(n, x, incx, y, incy, 0.0, 1.0);
    cblas_dscal(n, -1.0, y, incy);
}

void cblas_dcopy(int n, const double *x, int incx, double *y, int incy)
{
    for (ptrdiff_t i = 0; i < n; i++)
        y[i * incy] = x[i * incx];
}

static void scale(int n, double beta, double *y, int incy)
{
    for (ptrdiff_t i = 0; i < n; i++)
        y[i * incy] = beta == 0.0 ? 0.0 : beta * y[i * incy];
}

/* y += four columns of A times four numbers. */
static void add_columns(int m, const double *A, size_t lda, const double s[4], double *y)
{
    const double *a = A, *b = a + lda, *c = b + lda, *d = c + lda;
    for (int i = 0; i < m; i++)
        y[i] += (s[0] * a[i] + s[1] * b[i]) + (s[2] * c[i] + s[3] * d[i]);
}

void cblas_dgemv(enum CBLAS_ORDER order, enum CBLAS_TRANSPOSE trans, int m, int n, double alpha,
                 const double *A, int lda, const double *x, int incx, double beta, double *y,
                 int incy)
{
    const size_t ld = (size_t)lda;
    (void)order;
    if (beta != 1.0)
        scale(trans == CblasNoTrans ? m : n, beta, y, incy);
    if (trans == CblasTrans) {
        for (ptrdiff_t j = 0; j < n; j++)
            y[j * incy] += alpha * cblas_ddot(m, A + (size_t)j * ld, 1, x, incx);
        return;
    }
    int j = 0;
    for (; incy == 1 && j + 4 <= n; j += 4) {
        double s[4];
        for (int k = 0; k < 4; k++)
            s[k] = alpha * x[(ptrdiff_t)(j + k) * incx];
        add_columns(m, A + (size_t)j * ld, ld, s, y);
    }
    for (; j < n; j++)
        cblas_daxpy(m, alpha * x[(ptrdiff_t)j * incx], A + (size_t)j * ld, 1, y, incy);
}

/* Panels of A that stay in the cache. */
enum { PANEL_ROWS = 128, PANEL_COLUMNS = 64 };

static double entry_of(enum CBLAS_TRANSPOSE t, const double *B, size_t ldb, int i, int j)
{
    return t == CblasNoTrans ? B[(size_t)i + (size_t)j * ldb] : B[(size_t)j + (size_t)i * ldb];
}

/* Columns j and j + 1 of C together: each load of A serves twice. */
static void add_two(int m, int k, const double *A, size_t lda, const double *s, const double *t,
                    double *y, double *z)
{
    int l = 0;
    for (; l + 2 <= k; l += 2) {
        const double *a = A + (size_t)l * lda, *b = a + lda;
        const double s0 = s[l], s1 = s[l + 1], t0 = t[l], t1 = t[l + 1];
        for (int i = 0; i < m; i++) {
            y[i] += s0 * a[i] + s1 * b[i];
            z[i] += t0 * a[i] + t1 * b[i];
        }
    }
    for (; l < k; l++) {
        const double *a = A + (size_t)l * lda;
        for (int i = 0; i < m; i++) {
            y[i] += s[l] * a[i];
            z[i] += t[l] * a[i];
        }
    }
}

static void add_panel(int m, int n, int k, double alpha, const double *A, size_t lda,
                      enum CBLAS_TRANSPOSE tb, const double *B, size_t ldb, int first, double *C,
                      size_t ldc)
{
    double s[PANEL_COLUMNS], t[PANEL_COLUMNS], none[PANEL_ROWS];
    for (int j = 0; j < n; j += 2) {
        const int two = j + 1 < n;
        for (int l = 0; l < k; l++) {
            s[l] = alpha * entry_of(tb, B, ldb, first + l, j);
            t[l] = two ? alpha * entry_of(tb, B, ldb, first + l, j + 1) : 0.0;
        }
        double *y = C + (size_t)j * ldc, *z = two ? y + ldc : none;
        if (!two)
            scale(m, 0.0, none, 1);
        add_two(m, k, A, lda, s, t, y, z);
    }
}

void cblas_dgemm(enum CBLAS_ORDER order, enum CBLAS_TRANSPOSE ta, enum CBLAS_TRANSPOSE tb, int m,
                 int n, int k, double alpha, const double *A, int lda, const double *B, int ldb,
                 double beta, double *C, int ldc)
{
    (void)order;
    for (int j = 0; beta != 1.0 && j < n; j++)
        scale(m, beta, C + (size_t)j * (size_t)ldc, 1);
    if (ta == CblasTrans) {
        for (int j = 0; j < n; j++)
            for (int i = 0; i < m; i++)
                for (int l = 0; l < k; l++)
                    C[(size_t)i + (size_t)j * (size_t)ldc] +=
                        alpha * A[(size_t)l + (size_t)i * (size_t)lda] *
                        entry_of(tb, B, (size_t)ldb, l, j);
        return;
    }
    for (int l = 0; l < k; l += PANEL_COLUMNS)
        for (int i = 0; i < m; i += PANEL_ROWS)
            add_panel(m - i < PANEL_ROWS ? m - i : PANEL_ROWS, n,
                      k - l < PANEL_COLUMNS ? k - l : PANEL_COLUMNS, alpha,
                      A + i + (size_t)l * (size_t)lda, (size_t)lda, tb, B, (size_t)ldb, l, C + i,
                      (size_t)ldc);
}

void cblas_dtrsv(enum CBLAS_ORDER order, enum CBLAS_UPLO uplo, enum CBLAS_TRANSPOSE trans,
                 enum CBLAS_DIAG diag, int n, const double *A, int lda, double *x, int incx)
{
    (void)incx;
    cblas_dtrsm(order, CblasLeft, uplo, trans, diag, n, 1, 1.0, A, lda, x, n);
}

/* One column of B: forward or backward substitution. */
static void substitute(enum CBLAS_UPLO uplo, enum CBLAS_TRANSPOSE trans, enum CBLAS_DIAG diag,
                       int m, const double *A, size_t lda, double *x)
{
    const int forward = (uplo == CblasLower) == (trans == CblasNoTrans);
    for (int step = 0; step < m; step++) {
        const int j = forward ? step : m - 1 - step;
        const double *a = A + (size_t)j * lda;
        const int from = uplo == CblasLower ? j + 1 : 0, count = uplo == CblasLower ? m - 1 - j : j;
        if (trans == CblasTrans)
            x[j] -= cblas_ddot(count, a + from, 1, x + from, 1);
        if (diag == CblasNonUnit)
            x[j] /= a[j];
        if (trans == CblasNoTrans && x[j] != 0.0)
            cblas_daxpy(count, -x[j], a + from, 1, x + from, 1);
    }
}

/* Blocks of the diagonal are substituted, the rest is products of matrices. */
void cblas_dtrsm(enum CBLAS_ORDER order, enum CBLAS_SIDE side, enum CBLAS_UPLO uplo,
                 enum CBLAS_TRANSPOSE trans, enum CBLAS_DIAG diag, int m, int n, double alpha,
                 const double *A, int lda, double *B, int ldb)
{
    enum { BLOCK = 32 };
    const size_t la = (size_t)lda, lb = (size_t)ldb;
    (void)side;
    for (int j = 0; alpha != 1.0 && j < n; j++)
        scale(m, alpha, B + (size_t)j * lb, 1);
    if (trans == CblasTrans || m <= BLOCK || n == 1) {
        for (int j = 0; j < n; j++)
            substitute(uplo, trans, diag, m, A, la, B + (size_t)j * lb);
        return;
    }
    const int blocks = (m + BLOCK - 1) / BLOCK;
    for (int step = 0; step < blocks; step++) {
        const int b = uplo == CblasLower ? step : blocks - 1 - step, first = b * BLOCK,
                  size = m - first < BLOCK ? m - first : BLOCK;
        for (int j = 0; j < n; j++)
            substitute(uplo, trans, diag, size, A + (size_t)first * (la + 1), la,
                       B + first + (size_t)j * lb);
        const int from = uplo == CblasLower ? first + size : 0,
                  rest = uplo == CblasLower ? m - from : first;
        if (rest > 0)
            cblas_dgemm(order, CblasNoTrans, CblasNoTrans, rest, n, size, -1.0,
                        A + from + (size_t)first * la, lda, B + first, ldb, 1.0, B + from, ldb);
    }
}
