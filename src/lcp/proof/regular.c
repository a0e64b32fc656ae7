/* Whether a small matrix of doubles is singular, and which numbers of a basis are zero.  Doubles
 * are fractions with a power of two below, so that they have residues modulo a prime, in which
 * elimination makes no rounding errors.  A determinant that is not zero modulo one prime is not
 * zero at all: that is proved.  One that is zero modulo both primes, of 61 bits each, is taken for
 * zero; it would have to be a multiple of both. */
#include "lcp/proof/exact.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

/* The largest order, and how many primes. */
enum { MOST = 32, PRIMES = 2 };
static const uint64_t primes[PRIMES] = {2305843009213693921ULL, 2305843009213693907ULL};

static uint64_t times(uint64_t a, uint64_t b, uint64_t prime)
{
    __extension__ typedef unsigned __int128 two_words;
    return (uint64_t)((two_words)a * b % prime);
}

static uint64_t power(uint64_t a, uint64_t exponent, uint64_t prime)
{
    uint64_t x = 1;
    for (; exponent; exponent >>= 1, a = times(a, a, prime))
        if (exponent & 1)
            x = times(x, a, prime);
    return x;
}

/* A double is a whole number of 53 bits times a power of two; modulo a prime 1/2 is (prime + 1)/2.
 */
static uint64_t residue(double x, uint64_t prime)
{
    int e;
    const uint64_t whole = (uint64_t)ldexp(frexp(fabs(x), &e), 53), half = (prime + 1) / 2;
    e -= 53;
    const uint64_t value =
        times(whole % prime, power(e < 0 ? half : 2, (uint64_t)abs(e), prime), prime);
    return x < 0.0 && value ? prime - value : value;
}

static uint64_t minus(uint64_t a, uint64_t b, uint64_t prime)
{
    return a >= b ? a - b : a + (prime - b);
}

/* Elimination of m rows of m + 1 entries, by Gauss and Jordan to the unit matrix where the result,
 * the rank, is m.  only_regular: ends where it is not, and leaves what is above the diagonal. */
static int eliminate(int m, uint64_t (*a)[MOST + 1], uint64_t prime, int only_regular)
{
    int rank = 0;
    for (int c = 0; c < m && !(only_regular && rank < c); c++) {
        int r = rank;
        while (r < m && !a[r][c])
            r++;
        if (r == m)
            continue;
        for (int j = c; j <= m && r > rank; j++) {
            const uint64_t t = a[r][j];
            a[r][j] = a[rank][j];
            a[rank][j] = t;
        }
        /* Fermat: a^(prime - 1) = 1, so that a^(prime - 2) is the inverse. */
        const uint64_t inverse = power(a[rank][c], prime - 2, prime);
        for (int j = c; j <= m; j++)
            a[rank][j] = times(a[rank][j], inverse, prime);
        for (int i = only_regular ? rank + 1 : 0; i < m; i++) {
            const uint64_t f = a[i][c];
            for (int j = c; f && i != rank && j <= m; j++)
                a[i][j] = minus(a[i][j], times(f, a[rank][j], prime), prime);
        }
        rank++;
    }
    return rank;
}

int rb_lcp_is_regular(const double *M, int ld, int m, const int *row, const int *column)
{
    uint64_t a[MOST][MOST + 1];
    for (int k = 0; m <= MOST && k < PRIMES; k++) {
        for (int i = 0; i < m; i++) {
            a[i][m] = 0;
            for (int j = 0; j < m; j++)
                a[i][j] = residue(M[(size_t)row[i] + (size_t)column[j] * (size_t)ld], primes[k]);
        }
        if (eliminate(m, a, primes[k], 1) == m)
            return 1;
    }
    return 0;
}

/* w_i of z, all of them as residues. */
static uint64_t residue_of_row(const rb_lcp_problem *p, int i, const uint64_t *z, uint64_t prime)
{
    uint64_t sum = residue(p->q[i], prime);
    for (int j = 0; j < p->n; j++)
        if (z[j])
            sum = minus(
                sum,
                times(residue(-p->M[(size_t)i + (size_t)j * (size_t)p->ldm], prime), z[j], prime),
                prime);
    return sum;
}

/* The rank of w_row = 0 for the columns; z: n, the others, and zero for the columns. */
static int eliminate_point(const lcp_point *point, uint64_t prime, uint64_t *z,
                           uint64_t (*a)[MOST + 1])
{
    const rb_lcp_problem *p = point->p;
    const int m = point->m;
    for (int j = 0; j < p->n; j++)
        z[j] = residue(point->z[j], prime);
    for (int c = 0; c < m; c++)
        z[point->column[c]] = 0;
    for (int r = 0; r < m; r++) {
        const double *row = p->M + point->row[r];
        for (int c = 0; c < m; c++)
            a[r][c] = residue(row[(size_t)point->column[c] * (size_t)p->ldm], prime);
        a[r][m] = minus(0, residue_of_row(p, point->row[r], z, prime), prime);
    }
    return eliminate(m, a, prime, 0);
}

int rb_lcp_has_no_point(const lcp_point *point)
{
    const int m = point->m;
    uint64_t a[MOST][MOST + 1], z[MOST];
    for (int k = 0; k < PRIMES; k++) {
        if (point->p->n > MOST)
            return 0;
        const int rank = eliminate_point(point, primes[k], z, a);
        int differs = 0;
        for (int r = rank; r < m; r++)
            differs |= a[r][m] != 0;
        if (!differs)
            return 0;
    }
    return 1;
}

void rb_lcp_zeros(const lcp_point *point, unsigned char *zeros)
{
    const rb_lcp_problem *p = point->p;
    const int n = p->n, m = point->m;
    uint64_t a[MOST][MOST + 1], z[MOST];
    for (int i = 0; i < n; i++)
        zeros[i] = 0;
    for (int k = 0; n <= MOST && k < PRIMES; k++) {
        const uint64_t prime = primes[k];
        const int solved = eliminate_point(point, prime, z, a) == m;
        for (int c = 0; c < m; c++)
            z[point->column[c]] = a[c][m];
        for (int i = 0; i < n; i++) {
            const double low = rb_lcp_lower(point->lower, i), high = rb_lcp_upper(point->upper, i);
            const int is = (isfinite(low) && z[i] == residue(low, prime) ? LCP_Z_IS_LOWER : 0) |
                           (isfinite(high) && z[i] == residue(high, prime) ? LCP_Z_IS_UPPER : 0) |
                           (residue_of_row(p, i, z, prime) == 0 ? LCP_W_IS_ZERO : 0);
            zeros[i] = (unsigned char)(!solved ? 0 : k == 0 ? is : zeros[i] & is);
        }
    }
}
