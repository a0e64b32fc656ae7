/* Functions of x >= 0 that are smooth on the scale of max(1, x), as polynomials on panels:
 * four in [0, 1), four in [1, 2) and in every octave beyond.  Not installed. */
#ifndef ROLLBEM_BEM_LAYERS_PANELS_H
#define ROLLBEM_BEM_LAYERS_PANELS_H

#include <gsl/gsl_math.h>
#include <math.h>

enum { RB_PANELS_PER_OCTAVE = 4 };

/* The panel that holds x, and the place in it, -1 to 1. */
static inline int rb_panel_of(double x, double *t)
{
    int octave = 0;
    double part = x; /* 0 to 1 of the octave */
    if (x >= 1.0)
        part = 2.0 * frexp(x, &octave) - 1.0;
    const int k = (int)(RB_PANELS_PER_OCTAVE * part);
    *t = 2.0 * (RB_PANELS_PER_OCTAVE * part - k) - 1.0;
    return RB_PANELS_PER_OCTAVE * octave + k;
}

/* Panel k: from *low, *width long. */
static inline void rb_panel_place(int k, double *low, double *width)
{
    const int octave = k / RB_PANELS_PER_OCTAVE, part = k % RB_PANELS_PER_OCTAVE;
    *width = ldexp(1.0 / RB_PANELS_PER_OCTAVE, octave > 0 ? octave - 1 : 0);
    *low = (octave > 0 ? ldexp(1.0, octave - 1) : 0.0) + part * *width;
}

/* Chebyshev's point j of n, 0 to 1. */
static inline double rb_panel_point(int n, int j)
{
    return 0.5 * (1.0 + cos(M_PI * (j + 0.5) / n));
}

/* From the values of three functions at the n points to the coefficients of T_0 ... T_n-1. */
static inline void rb_panel_chebyshev(int n, const double (*value)[3], double (*c)[3])
{
    for (int k = 0; k < n; k++)
        for (int d = 0; d < 3; d++) {
            double sum = 0.0;
            for (int j = 0; j < n; j++)
                sum += value[j][d] * cos(M_PI * k * (j + 0.5) / n);
            c[k][d] = sum * ((k ? 2.0 : 1.0) / n);
        }
}

#endif
