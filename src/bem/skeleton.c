#include "bem/skeleton.h"

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

enum { WIDE = 96 };

rb_status rb_skeleton_factor(rb_skeleton *s, double tolerance)
{
    const int n = s->columns, most = s->rows < n ? s->rows : n, block = 64;
    const lapack_int lwork = 2 * n + (n + 1) * block;
    double *work = rb_alloc((size_t)lwork, 1);

    if (!work)
        return RB_ENOMEM;
    /* K = Q R first where there are many columns: pivoting cannot work on whole blocks,
     * and then does so on fewer rows. */
    if (!(n < WIDE || s->rows < n)) {
        LAPACKE_dgeqrf_work(LAPACK_COL_MAJOR, s->rows, n, s->K, s->ld, s->scale, work, lwork);
        s->rows = n;
        LAPACKE_dlaset_work(LAPACK_COL_MAJOR, 'L', n - 1, n - 1, 0.0, 0.0, s->K + 1, s->ld);
    }
    LAPACKE_dgeqp3_work(LAPACK_COL_MAJOR, s->rows, n, s->K, s->ld, s->pivot, s->scale, work, lwork);
    free(work);
    const double least = tolerance * fabs(s->K[0]);
    while (s->rank < most && fabs(s->K[(size_t)s->rank * (size_t)(s->ld + 1)]) > least)
        s->rank++;
    return RB_OK;
}

rb_status rb_skeleton_split(const rb_skeleton *s, int kept, int *order, double *T)
{
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
