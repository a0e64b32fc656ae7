/* Whether a small matrix of doubles is singular, exactly. */
#include "lcp/portfolio/linear.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

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

/* A double is a whole number of 53 bits times a power of two. */
static uint64_t residue(double x, uint64_t prime)
{
    int e;
    const uint64_t whole = (uint64_t)ldexp(frexp(fabs(x), &e), 53), half = (prime + 1) / 2;
    e -= 53;
    const uint64_t value =
        times(whole % prime, power(e < 0 ? half : 2, (uint64_t)abs(e), prime), prime);
    return x < 0.0 && value ? prime - value : value;
}

int rb_lcp_is_regular(const double *M, int ld, int m, const int *row, const int *column)
{
    static const uint64_t primes[2] = {2305843009213693921ULL, 2305843009213693907ULL};
    enum { MOST = 32 };
    uint64_t a[MOST][MOST];
    if (m > MOST)
        return 0;
    for (int k = 0; k < 2; k++) {
        const uint64_t prime = primes[k];
        int c = 0;
        for (int j = 0; j < m; j++)
            for (int i = 0; i < m; i++)
                a[i][j] = residue(M[(size_t)row[i] + (size_t)column[j] * (size_t)ld], prime);
        for (; c < m; c++) { /* Gauss' elimination */
            int r = c;
            while (r < m && !a[r][c])
                r++;
            if (r == m)
                break;
            for (int j = c; j < m && r > c; j++) {
                const uint64_t t = a[r][j];
                a[r][j] = a[c][j];
                a[c][j] = t;
            }
            const uint64_t inverse = power(a[c][c], prime - 2, prime);
            for (int i = c + 1; i < m; i++) {
                const uint64_t f = times(a[i][c], inverse, prime);
                for (int j = c; f && j < m; j++) {
                    const uint64_t t = times(f, a[c][j], prime);
                    a[i][j] += a[i][j] >= t ? -t : prime - t;
                }
            }
        }
        if (c == m)
            return 1;
    }
    return 0;
}
