/* The part of LAPACKE that rollbem's core calls, for WebAssembly: see lapack.c. */
#ifndef ROLLBEM_WASM_LAPACKE_H
#define ROLLBEM_WASM_LAPACKE_H

#define LAPACK_COL_MAJOR 102
#define LAPACK_WORK_MEMORY_ERROR (-1010)
#define LAPACK_TRANSPOSE_MEMORY_ERROR (-1011)
typedef int lapack_int;

int LAPACKE_dgetrf_work(int layout, int m, int n, double *A, int lda, int *pivots);
int LAPACKE_dgetrf(int layout, int m, int n, double *A, int lda, int *pivots);
int LAPACKE_dgetrs_work(int layout, char trans, int n, int nrhs, const double *A, int lda,
                        const int *pivots, double *B, int ldb);
int LAPACKE_dgesv_work(int layout, int n, int nrhs, double *A, int lda, int *pivots, double *B,
                       int ldb);
int LAPACKE_dgecon_work(int layout, char norm, int n, const double *A, int lda, double anorm,
                        double *rcond, double *work, int *iwork);
int LAPACKE_dpotrf(int layout, char uplo, int n, double *A, int lda);
int LAPACKE_dpotrf_work(int layout, char uplo, int n, double *A, int lda);
int LAPACKE_dgetri_work(int layout, int n, double *A, int lda, const int *pivots, double *work,
                        int size);
int LAPACKE_dpotri(int layout, char uplo, int n, double *A, int lda);
int LAPACKE_dlaswp_work(int layout, int n, double *A, int lda, int k1, int k2, const int *pivots,
                        int incx);

#endif
