/* Signs without rounding: sums of products as sums of doubles that do not overlap (Shewchuk,
 * Discrete and Computational Geometry 18, 1997). */
#include "base/base.h"

#include <math.h>
#include <stdlib.h>

/* The sum of `count` doubles of increasing size that do not overlap, and of x, is written
 * in their place; returns how many it takes. */
static int grow(int count, double *sum, double x)
{
    int kept = 0;
    for (int k = 0; k < count; k++) {
        const double whole = x + sum[k], part = whole - x,
                     rest = (x - (whole - part)) + (sum[k] - part);
        if (rest != 0.0)
            sum[kept++] = rest;
        x = whole;
    }
    if (x != 0.0 || kept == 0)
        sum[kept++] = x;
    return kept;
}

int rb_exact_sign(size_t n, const double *a, const double *b)
{
    double *sum = rb_alloc(2 * n + 2, 1), safe = 0x1p-900;
    int count = 1, certain = sum != NULL;
    for (size_t i = 0; certain && i < n; i++) {
        const double product = a[i] * b[i], rest = fma(a[i], b[i], -product);
        if (a[i] == 0.0 || b[i] == 0.0)
            continue;
        /* the rest of a product must not underflow */
        certain = fabs(product) > safe && fabs(product) < 0x1p900;
        count = grow(count, sum, rest);
        count = grow(count, sum, product);
    }
    const double last = certain ? sum[count - 1] : NAN;
    free(sum);
    return isnan(last) ? RB_SIGN_UNKNOWN : (last > 0.0) - (last < 0.0);
}
