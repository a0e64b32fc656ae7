/* Waves on rings by Michell's functions, which the library does not use. */
#ifndef ROLLBEM_TESTS_MICHELL_H
#define ROLLBEM_TESTS_MICHELL_H

#include "check.h"
#include "bem/bem.h"

#include <complex.h>
#include <lapacke.h>
#include <string.h>

typedef double complex cplx;

/* r^(m+1), r^(m-1), r^(1-m), r^(-1-m): displacements u_r = u cos, u_t = v sin over 1/(2
 * G), stresses s, t. */

static inline void michell(int m, double nu, double r, double scale, cplx column[4][4])
{
    const double ka = 3.0 - 4.0 * nu, x = r / scale;
    const double power[4] = {pow(x, m + 1), pow(x, m - 1), pow(x, 1 - m), pow(x, -m - 1)};
    const double value[4][4] = {{ka - m - 1, ka + m + 1, (m + 1.0) * (2 - m), (m + 1.0) * m},
                                {-1, 1, 1 - m, m - 1},
                                {ka + m - 1, m - 1 - ka, (1.0 - m) * (2 + m), m * (1.0 - m)},
                                {-1, -1, m + 1, m + 1}};
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < 4; i++)
            column[k][i] = power[k] * value[k][i] / (i < 2 ? 1.0 : x);
    if (m == 1) { /* the third is a translation like the second: the force's own field */
        const double third[4] = {2 * ka * log(x) - 1, -2 * ka * log(x) - 1, (3 + ka) / x,
                                 (1 - ka) / x};
        for (int i = 0; i < 4; i++)
            column[2][i] = third[i];
    }
    if (m == 0) { /* stretch and turn */
        const double zero[4][4] = {{(ka - 1) * x, 0, 2, 0},
                                   {0, x, 0, 0},
                                   {-1 / x, 0, 1 / (x * x), 0},
                                   {0, 1 / x, 0, -1 / (x * x)}};
        for (int k = 0; k < 4; k++)
            for (int i = 0; i < 4; i++)
                column[k][i] = zero[k][i];
    }
}

/* Compliance C (uu, vu, uv, vv) [length/stress] of a ring on what has the compliance
 * `below`. */
static inline void ring(int m, cplx shear, double nu, double inner, double outer,
                        const cplx below[4], cplx C[4])
{
    cplx in[4][4], out[4][4], A[16], b[8] = {0};
    int pivot[4];
    michell(m, nu, inner, outer, in);
    michell(m, nu, outer, outer, out);
    for (int k = 0; k < 4; k++) {
        for (int i = 0; i < 2; i++) {
            const cplx stress = below[i] * in[k][2] + below[2 + i] * in[k][3];
            A[i + 4 * k] = in[k][i] * outer / (2.0 * shear) - stress;
            A[2 + i + 4 * k] = out[k][2 + i];
        }
    }
    b[2] = b[7] = 1.0;
    for (int i = 0; i < 4; i++) { /* rows of one size */
        double largest = 0.0;
        for (int k = 0; k < 4; k++)
            largest = fmax(largest, cabs(A[i + 4 * k]));
        for (int k = 0; k < 4; k++)
            A[i + 4 * k] /= largest;
        for (int k = 0; k < 2; k++)
            b[i + 4 * k] /= largest;
    }
    assert_int_equal(LAPACKE_zgesv(LAPACK_COL_MAJOR, 4, 2, (lapack_complex_double *)A, 4, pivot,
                                   (lapack_complex_double *)b, 4),
                     0);
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 2; i++) {
            C[i + 2 * j] = 0.0;
            for (int k = 0; k < 4; k++)
                C[i + 2 * j] += out[k][i] * b[k + 4 * j] * outer / (2.0 * shear);
        }
}

static inline void wheel_answers(const rb_bem_wheel *w, int m, cplx softer, cplx C[4])
{
    cplx rigid[4] = {0}, core[4] = {0};
    if (w->hub > 0.0)
        ring(m, w->core.shear, w->core.poisson, w->hub, w->inner, rigid, core);
    ring(m, w->material.shear / softer, w->material.poisson, w->inner, w->radius, core, C);
}

#endif
