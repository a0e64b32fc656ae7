/* Kwak's form of the LCP (K4), with slips instead of friction as unknowns. */
#include "lcp/contact/lcp_order.h"

#include <cblas.h>
#include <lapacke.h>
#include <string.h>

/* The principal pivot of the pivoted form on S_T: lambda+ is given and gamma+ follows
 * from it, gamma = S_T^-1 (lambda+ - the other columns - b), in the rows of lambda+ and
 * in all others. */
rb_status rb_contact_kwak_form(const rb_contact_problem *p, rb_contact_lcp *lcp)
{
    const int n = p->n, size = lcp->size;
    const size_t length = (size_t)n, ld = (size_t)size;
    double *own = lcp->M + length * ld;
    rb_arena scratch = {0};
    /* the columns of gamma; and gamma by the other unknowns and 1 */
    double *gamma = rb_arena_doubles(&scratch, ld, length),
           *solved = rb_arena_doubles(&scratch, length, ld + 1),
           *S_T = rb_arena_doubles(&scratch, length, length),
           *M = rb_arena_doubles(&scratch, ld, ld), *b = rb_arena_doubles(&scratch, ld, 1);
    lapack_int *pivots = rb_arena_zeros(&scratch, length, sizeof *pivots);

    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    /* Right-hand sides of gamma = S_T^-1 (lambda+ - M_other z_other - b), for each unknown and 1.
     */
    memcpy(gamma, own, length * ld * sizeof *own);
    for (int j = 0; j <= size; j++)
        for (int i = 0; i < n; i++)
            solved[(size_t)i + (size_t)j * length] = j >= n && j < 2 * n ? i == j - n
                                                     : j < size ? -lcp->M[n + i + (size_t)j * ld]
                                                                : -lcp->b[n + i];
    for (size_t j = 0; j < length; j++)
        memcpy(S_T + j * length, gamma + j * ld + n, length * sizeof *S_T);
    memset(own, 0, length * ld * sizeof *own);
    /* B = A F_TT of (K4) is S_T. */
    const int fault = LAPACKE_dgesv_work(LAPACK_COL_MAJOR, n, size + 1, S_T, n, pivots, solved, n);
    if (fault != 0)
        return rb_arena_done(&scratch, rb_lapack_status(fault));
    /* gamma, as it is now known, goes into all other rows. */
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, size, size, n, 1.0, gamma, size, solved,
                n, 1.0, lcp->M, size);
    cblas_dgemv(CblasColMajor, CblasNoTrans, size, n, 1.0, gamma, size, solved + length * ld, 1,
                1.0, lcp->b, 1);
    /* Unknowns and rows in Kwak's order: r_N, then lambda+ and lambda- of each element side by
     * side. */
    for (int i = 0; i < size; i++) {
        const int row = rb_contact_kwak_place(p, i), is_gamma = i >= n && i < 2 * n;
        const double *from = is_gamma ? solved + i - n : lcp->M + i;
        const size_t step = is_gamma ? length : ld;
        for (int j = 0; j < size; j++)
            M[row + (size_t)rb_contact_kwak_place(p, j) * ld] = from[(size_t)j * step];
        b[row] = is_gamma ? from[ld * step] : lcp->b[i];
    }
    memcpy(lcp->M, M, ld * ld * sizeof *M);
    memcpy(lcp->b, b, ld * sizeof *b);
    return rb_arena_done(&scratch, RB_OK);
}
