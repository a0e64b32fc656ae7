/* The two bounds that carry every proof (docs/proof.md).  u = 2^-53.  A sum of k products in
 * any order, with or without fused operations, differs from the exact one by at most
 * k u/(1 - k u) times the sum of the moduli of its terms, and by k 2^-1074 where products
 * underflow.  Private to src/lcp. */
#ifndef LCP_PROOF_BOUNDS_H
#define LCP_PROOF_BOUNDS_H

#include <stddef.h>

static const double PROOF_U = 0x1p-53, PROOF_TINY = 0x1p-1022;

/* The error of a sum of k products whose moduli add up to `size`, as computed.  The factor 2
 * pays for the rounding of size and of this bound itself. */
static inline double proof_error(size_t k, double size)
{
    return 2.0 * ((double)k + 4.0) * PROOF_U * size + (double)k * PROOF_TINY;
}

/* Not below the exact sum of k products >= 0 that was computed as `size`. */
static inline double proof_up(size_t k, double size)
{
    return size * (1.0 + 2.0 * ((double)k + 4.0) * PROOF_U) + (double)k * PROOF_TINY;
}

/* A sum of products in twice the precision (Ogita, Rump, Oishi, SIAM J. Sci. Comput. 26, 2005,
 * Dot2): sum + rest, with an error of gamma_k^2 times the moduli before the last rounding. */
typedef struct {
    double sum, rest, size; /* size: the sum of the moduli of the terms */
} proof_dot;

static inline void proof_add(proof_dot *d, double a, double b)
{
    const double product = a * b, sum = d->sum + product, part = sum - d->sum;
    d->rest += __builtin_fma(a, b, -product) + ((d->sum - (sum - part)) + (product - part));
    d->sum = sum;
    d->size += __builtin_fabs(product);
}

/* The value of a proof_dot of k terms, and the bound of its error. */
static inline double proof_value(const proof_dot *d, size_t k, double *error)
{
    const double value = d->sum + d->rest;
    *error = 4.0 * PROOF_U * __builtin_fabs(value) +
             2.0 * ((double)k + 4.0) * PROOF_U * proof_error(k, d->size) + (double)k * PROOF_TINY;
    return value;
}

/* A matrix that is proved to be regular: its approximate inverse, and what that lacks. */
typedef struct {
    int k;
    int *row, *column; /* k: exponents of two that scale it; owned, as the others */
    double *A, *R, *g; /* k x k scaled, its inverse R, and g_i >= sum_j |I - R A|_ij */
    double norm;       /* max g; infinite: LAPACK found no inverse */
    double *work;      /* 5 k */
} proof_inverse;

/* Takes over A (k x k, from malloc), of whose entries this part is not known.  It is regular if
 * norm < 0.99.  1: there was memory. */
int rb_proof_inverse(int k, double *A, double unknown, proof_inverse *inverse);
void rb_proof_inverse_free(proof_inverse *inverse);
/* x, e: |A^-1 (-b) - x| <= e for each b within `radius` (k, or NULL).  PROOF_FINE: residuals in
 * twice the precision; PROOF_FINEST: and, for a few unknowns (A has to be known), bounds that go
 * with the size of each. */
enum { PROOF_FINE = 1, PROOF_FINEST };
void rb_proof_solve(const proof_inverse *inverse, const double *b, const double *radius, int fine,
                    double *x, double *e);
/* y = |A| x, A m x n column-major. */
void rb_proof_abs_product(int m, int n, const double *A, int ld, const double *x, double *y);

/* 1: arithmetic rounds to nearest and keeps numbers below the least normal one. */
int rb_proof_arithmetic(void);

#endif
