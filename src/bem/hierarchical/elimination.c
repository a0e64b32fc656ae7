/* X = L U of the part that is eliminated, and the passes up and down the tree with it. */
#include "bem/hierarchical/elimination.h"

#include <cblas.h>

rb_status rb_elimination_begin(int m, rb_elimination *e)
{
    *e = (rb_elimination){.m = m, .kept = m};
    e->row = rb_arena_ints(&e->memory, 2 * (size_t)m);
    if (!e->row)
        return RB_ENOMEM;
    e->column = e->row + m;
    return RB_OK;
}

rb_status rb_elimination_keep(int kept, rb_elimination *e)
{
    const size_t k = (size_t)kept, others = (size_t)(e->m - kept);
    e->kept = kept;
    e->V = rb_arena_doubles(&e->memory, 4 * k + others + 1, others + 1);
    e->pivot = rb_arena_zeros(&e->memory, others + 1, sizeof *e->pivot);
    if (e->memory.failed)
        return RB_ENOMEM;
    e->Z = e->V + k * others;
    e->lower = e->Z + k * others;
    e->upper = e->lower + k * others;
    e->LU = e->upper + k * others;
    return RB_OK;
}

/* Leading dimension of a matrix of so many rows. */
static int lead(int rows)
{
    return rows > 0 ? rows : 1;
}

rb_status rb_elimination_run(rb_elimination *e, double *X)
{
    const int m = e->m, kept = e->kept, others = m - kept, ld = lead(kept);
    double *RS = X + kept, *SR = X + (size_t)kept * (size_t)m, *RR = SR + kept;

    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, m, others, kept, -1.0, X, m, e->Z, ld,
                1.0, SR, m); /* and RR below it */
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, others, m, kept, -1.0, e->V, ld, X, m, 1.0,
                RS, m); /* and RR beside it */
    LAPACKE_dlacpy_work(LAPACK_COL_MAJOR, 'A', others, others, RR, m, e->LU, others);
    LAPACKE_dlacpy_work(LAPACK_COL_MAJOR, 'A', others, kept, RS, m, e->upper, others);
    LAPACKE_dlacpy_work(LAPACK_COL_MAJOR, 'A', kept, others, SR, m, e->lower, ld);
    if (LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, others, others, e->LU, others, e->pivot))
        return RB_SINGULAR;
    LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', others, kept, e->LU, others, e->pivot, e->upper,
                        others);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, kept, kept, others, -1.0, e->lower, ld,
                e->upper, others, 1.0, X, m);
    return RB_OK;
}

/* Rows list of X (n x columns) to or from the rows of a small matrix. */
static void gather(const double *X, size_t n, int columns, const int *list, int count, double *to)
{
    for (int c = 0; c < columns; c++)
        for (int i = 0; i < count; i++)
            to[i + (size_t)c * (size_t)count] = X[(size_t)list[i] + (size_t)c * n];
}

static void put_back(const double *from, int columns, const int *list, int count, double *X,
                     size_t n)
{
    for (int c = 0; c < columns; c++)
        for (int i = 0; i < count; i++)
            X[(size_t)list[i] + (size_t)c * n] = from[i + (size_t)c * (size_t)count];
}

/* b_R -= V' b_S,  y_R = X_RR^-1 b_R,  b_S -= lower y_R */
void rb_elimination_up(const rb_elimination *e, size_t n, int q, double *b, double *y,
                       double *scratch)
{
    const int kept = e->kept, others = e->m - kept, ld = lead(kept);
    double *S = scratch, *R = scratch + (size_t)kept * (size_t)q;

    if (others == 0)
        return;
    gather(b, n, q, e->row, kept, S);
    gather(b, n, q, e->row + kept, others, R);
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, others, q, kept, -1.0, e->V, ld, S, ld,
                1.0, R, others);
    LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', others, q, e->LU, others, e->pivot, R, others);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, kept, q, others, -1.0, e->lower, ld, R,
                others, 1.0, S, ld);
    put_back(S, q, e->row, kept, b, n);
    put_back(R, q, e->column + kept, others, y, n);
}

/* y_R -= upper y_S,  x_R = y_R,  x_S = y_S - Z y_R */
void rb_elimination_down(const rb_elimination *e, size_t n, int q, double *y, double *scratch)
{
    const int kept = e->kept, others = e->m - kept, ld = lead(kept);
    double *S = scratch, *R = scratch + (size_t)kept * (size_t)q;

    if (others == 0)
        return;
    gather(y, n, q, e->column, kept, S);
    gather(y, n, q, e->column + kept, others, R);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, others, q, kept, -1.0, e->upper, others,
                S, ld, 1.0, R, others);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, kept, q, others, -1.0, e->Z, ld, R,
                others, 1.0, S, ld);
    put_back(S, q, e->column, kept, y, n);
    put_back(R, q, e->column + kept, others, y, n);
}
