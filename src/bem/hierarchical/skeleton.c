/* QR with column pivoting, in blocks by LAPACK, until what is left is below the tolerance: K P =
 * Q [R_1 R_2].  The columns chosen are Q R_1, and the others Q R_2 = (Q R_1) R_1^-1 R_2: they are
 * the chosen ones times T = R_1^-1 R_2. */
#include "bem/hierarchical/skeleton.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>

void rb_skeleton_free(rb_skeleton *s)
{
    rb_arena_free(&s->memory);
}

rb_status rb_skeleton_alloc(int rows, int columns, rb_skeleton *s)
{
    const int ld = rows > 0 ? rows : 1;

    *s = (rb_skeleton){.rows = rows, .columns = columns, .ld = ld};
    s->K = rb_arena_doubles(&s->memory, (size_t)ld, (size_t)columns);
    s->scale = rb_arena_doubles(&s->memory, (size_t)columns, 1);
    s->pivot = rb_arena_zeros(&s->memory, (size_t)columns, sizeof *s->pivot);
    return s->memory.failed ? rb_arena_done(&s->memory, RB_ENOMEM) : RB_OK;
}

/* LAPACK's pivoted QR up to where the rank ends: `block` columns of the n that are left behind
 * the first `offset`; F: n x block. */
#define LAPACK_dlaqps LAPACK_GLOBAL(dlaqps, DLAQPS)
void LAPACK_dlaqps(const lapack_int *m, const lapack_int *n, const lapack_int *offset,
                   const lapack_int *block, lapack_int *done, double *A, const lapack_int *lda,
                   lapack_int *pivot, double *scale, double *norm, double *first_norm,
                   double *auxiliary, double *F, const lapack_int *ldf);

enum { BLOCK = 16 };

/* Until the diagonal falls below `tolerance` times its first entry; how many columns. */
static int factor_pivoted(rb_skeleton *s, double tolerance, double *work)
{
    const lapack_int most = s->rows < s->columns ? s->rows : s->columns;
    double *norm = work, *first_norm = norm + s->columns, *auxiliary = first_norm + s->columns,
           *F = auxiliary + BLOCK;
    lapack_int at = 0;

    for (int j = 0; j < s->columns; j++) {
        s->pivot[j] = j + 1;
        norm[j] = first_norm[j] = cblas_dnrm2(s->rows, s->K + (size_t)j * (size_t)s->ld, 1);
    }
    while (at < most && (at == 0 || fabs(s->K[(size_t)(at - 1) * (size_t)(s->ld + 1)]) >
                                        tolerance * fabs(s->K[0]))) {
        const lapack_int left = s->columns - at, block = BLOCK < most - at ? BLOCK : most - at,
                         rows = s->rows, ld = s->ld;
        lapack_int done;
        LAPACK_dlaqps(&rows, &left, &at, &block, &done, s->K + (size_t)at * (size_t)s->ld, &ld,
                      s->pivot + at, s->scale + at, norm + at, first_norm + at, auxiliary, F,
                      &left);
        at += done;
    }
    return at;
}

rb_status rb_skeleton_factor(rb_skeleton *s, double tolerance)
{
    double *work = rb_alloc((size_t)s->columns + 1, BLOCK + 2);

    if (!work)
        return RB_ENOMEM;
    const int most = factor_pivoted(s, tolerance, work);
    free(work);
    const double least = tolerance * fabs(s->K[0]);
    while (s->rank < most && fabs(s->K[(size_t)s->rank * (size_t)(s->ld + 1)]) > least)
        s->rank++;
    return RB_OK;
}

rb_status rb_skeleton_split(const rb_skeleton *s, int kept, int *order, double *T)
{
    /* X = R_1^-1 R_2, in the order of the pivots. */
    const int others = s->columns - kept, used = kept < s->rank ? kept : s->rank;
    const size_t ld = (size_t)s->ld;
    rb_arena scratch = {0};
    int *to = rb_arena_ints(&scratch, (size_t)s->columns);
    double *X = rb_arena_doubles(&scratch, (size_t)kept, (size_t)others);

    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    for (int j = 0; j < others; j++)
        cblas_dcopy(used, s->K + (size_t)(kept + j) * ld, 1, X + (size_t)j * (size_t)kept, 1);
    if (used && others)
        cblas_dtrsm(CblasColMajor, CblasLeft, CblasUpper, CblasNoTrans, CblasNonUnit, used, others,
                    1.0, s->K, s->ld, X, kept);
    /* to[i]: the place of pivot i among the first `kept`, or among the others. */
    const int n = s->columns;
    int *place = order; /* of each column in the pivots, until it is overwritten */

    for (int i = 0; i < n; i++)
        place[s->pivot[i] - 1] = i;
    int first = 0, other = kept;
    for (int c = 0; c < n; c++)
        to[place[c]] = place[c] < kept ? first++ : other++;
    for (int i = 0; i < n; i++)
        order[to[i]] = s->pivot[i] - 1;
    for (int j = 0; j < others; j++)
        for (int i = 0; i < kept; i++)
            T[to[i] + (size_t)(to[kept + j] - kept) * (size_t)kept] =
                X[i + (size_t)j * (size_t)kept];
    return rb_arena_done(&scratch, RB_OK);
}

rb_status rb_skeleton_reduce(rb_skeleton *s, double tolerance, rb_arena *memory, int *kept,
                             int **order, double **T)
{
    const rb_status status = rb_skeleton_factor(s, tolerance);

    if (status != RB_OK)
        return status;
    *kept = s->rank;
    *order = rb_arena_ints(memory, (size_t)s->columns);
    *T = rb_arena_doubles(memory, (size_t)s->rank, (size_t)(s->columns - s->rank) + 1);
    return memory->failed ? RB_ENOMEM : rb_skeleton_split(s, *kept, *order, *T);
}
