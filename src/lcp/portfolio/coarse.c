/* A start for Newton's method on large sparse problems, which needs no grid: neighbours
 * are joined to aggregates, and the basic variables of the coarser problem, which itself
 * starts from a coarser one, are the first basic variables of the finer problem. */

#include "lcp/portfolio/methods.h"
#include "base/sizes.h"
#include <math.h>
#include <stdlib.h>

/* Two unknowns are strongly coupled from this part of the strongest coupling on. */
static const double STRONG = 0.25;

/* Off the diagonal, entries of the wrong sign may come to this part of the diagonal. */
static const double WRONG_SIGN = 0.25;

/* Functions that are constant on aggregates are too stiff by as many times as aggregates
 * are long (Braess, Computing 55, 1995): 3 on lines; 15 / 5 in the plane, where each of
 * them has five points and three links to each neighbour. */
static const double TOO_STIFF = 3.0;

/* A coarser problem has at most this part of the unknowns. */
static const double COARSER = 0.7;

/* Systems for a coarser problem: if they are not enough it is no start. */
enum { STEPS = 40 };

/* Operations of a system, per entry of its matrix. */
static const double WORK = 200.0;

int rb_lcp_coarse_fits(const rb_sparse *M)
{
    for (int j = 0; j < M->cols; j++) {
        double diagonal = 0.0, wrong = 0.0;
        for (int k = M->p[j]; k < M->p[j + 1]; k++)
            if (M->i[k] == j)
                diagonal = M->x[k];
            else
                wrong += fmax(M->x[k], 0.0);
        if (!(diagonal > 0.0 && wrong <= WRONG_SIGN * diagonal))
            return 0;
    }
    return 1;
}

/* of[i]: the aggregate of i.  First every unknown none of whose strong neighbours belongs
 * to an aggregate becomes the centre of a new one, which takes them; then those that are
 * left join a neighbour's.  Returns how many there are. */
static int aggregate(const rb_sparse *M, int *of)
{
    const int n = M->cols;
    int count = 0;
    for (int j = 0; j < n; j++)
        of[j] = -1;
    for (int pass = 0; pass < 2; pass++)
        for (int j = 0; j < n; j++) {
            double strong = 0.0;
            int joined = -1;
            if (of[j] >= 0)
                continue;
            for (int k = M->p[j]; k < M->p[j + 1]; k++)
                if (M->i[k] != j)
                    strong = fmax(strong, -STRONG * M->x[k]);
            for (int k = M->p[j]; k < M->p[j + 1]; k++)
                if (M->i[k] != j && strong > 0.0 && -M->x[k] >= strong && of[M->i[k]] >= 0)
                    joined = of[M->i[k]];
            if (joined >= 0) {
                of[j] = pass == 0 ? -1 : joined;
                continue;
            }
            of[j] = count;
            for (int k = M->p[j]; k < M->p[j + 1]; k++)
                if (strong > 0.0 && -M->x[k] >= strong && of[M->i[k]] < 0)
                    of[M->i[k]] = count;
            count++;
        }
    return count;
}

rb_status rb_lcp_coarse_start(const rb_sparse *M, const double *q, double *z, double *work)
{
    const int n = M->cols;
    int *of = rb_alloc_int((size_t)n);
    const int count = of ? aggregate(M, of) : 0;
    double *coarse_q = rb_alloc((size_t)count, 3);
    rb_sparse C = {0};
    rb_status s = !of || !coarse_q ? RB_ENOMEM : count > COARSER * n ? RB_SINGULAR : RB_OK;
    if (s == RB_OK) {
        /* Sums of M over pairs of aggregates; what couples different ones is made softer
         * without a change of the columns' sums. */
        rb_triplets t = {.rows = count, .cols = count};
        s = rb_triplets_reserve(&t, (size_t)M->p[M->cols]);
        for (int j = 0; s == RB_OK && j < M->cols; j++)
            for (int k = M->p[j]; k < M->p[j + 1]; k++) {
                const int a = of[M->i[k]], b = of[j];
                const double x = M->x[k], soft = a == b ? x : x / TOO_STIFF;
                rb_triplets_add(&t, a, b, soft);
                if (a != b)
                    rb_triplets_add(&t, b, b, x - soft);
            }
        if (s == RB_OK)
            s = rb_sparse_from_triplets(&t, &C);
        rb_triplets_free(&t);
    }
    if (s == RB_OK) {
        double *start = coarse_q + count, *coarse_z = start + count;
        rb_lcp_options opt = {.max_iters = STEPS, .start = start};
        rb_lcp_info info = {0};
        for (int i = 0; i < n; i++)
            coarse_q[of[i]] += q[i];
        s = count < RB_LCP_COARSE_FROM ? RB_SINGULAR
                                       : rb_lcp_coarse_start(&C, coarse_q, start, work);
        for (int a = 0; s == RB_SINGULAR && a < count; a++)
            start[a] = 1.0;
        if (s != RB_ENOMEM)
            s = rb_lcp_newton(&C, coarse_q, &opt, coarse_z, &info);
        *work += WORK * info.iters * C.p[count];
        for (int i = 0; s == RB_OK && i < n; i++)
            z[i] = coarse_z[of[i]];
        s = s > 0 || s == RB_EINVAL ? RB_SINGULAR : s;
    }
    rb_sparse_free(&C);
    free(coarse_q);
    free(of);
    return s;
}
