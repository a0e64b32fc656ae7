/* Waves on rings.  In ln r the equations for y = (2 G U, 2 G V, r S, r T) have constant
 * coefficients. */
#include "bem/layers/ring.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <string.h>

typedef double complex cplx;

enum { TERMS = 24 }; /* of the exponential series, of matrices with a norm of about 2 */

void rb_ring_equations(double m, double nu, double M[4][4])
{
    const double a = nu / (1.0 - nu), c = 1.0 / (1.0 - nu);
    const double equations[4][4] = {{-a, -a * m, 1.0 - a, 0.0},
                                    {m, 1.0, 0.0, 2.0},
                                    {c, c * m, a, -m},
                                    {c * m, c * m * m, a * m, -1.0}};
    memcpy(M, equations, sizeof equations);
}

void rb_ring_transfer(double m, double nu, double step, double E[4][4])
{
    double M[4][4];
    rb_ring_equations(m, nu, M);
    double power[4][4] = {{1.0, 0, 0, 0}, {0, 1.0, 0, 0}, {0, 0, 1.0, 0}, {0, 0, 0, 1.0}};

    memcpy(E, power, sizeof power);
    for (int k = 1; k <= TERMS; k++) {
        const double factor = step / k;
        double next[4][4] = {{0.0}};
        for (int i = 0; i < 4; i++)
            for (int l = 0; l < 4; l++)
                for (int j = 0; j < 4; j++)
                    next[i][j] += power[i][l] * M[l][j];
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++) {
                power[i][j] = next[i][j] * factor;
                E[i][j] += power[i][j];
            }
    }
}

rb_ring_compliance rb_ring_across(double m, double nu, double inner, double outer,
                                  rb_ring_compliance K)
{
    double thickness = log(outer / inner);
    if (m * thickness > RB_RING_REACH) {
        thickness = RB_RING_REACH / m;
        K = (rb_ring_compliance){0.0, 0.0, 0.0, 0.0};
    }
    const int steps = (int)ceil(fmax(1.0, (m + 1.0) * thickness));
    double E[4][4];

    rb_ring_transfer(m, nu, thickness / steps, E);
    for (int k = 0; k < steps; k++) {
        cplx D[2][2], S[2][2];
        for (int i = 0; i < 2; i++) {
            D[i][0] = E[i][0] * K.uu + E[i][1] * K.vu + E[i][2];
            D[i][1] = E[i][0] * K.uv + E[i][1] * K.vv + E[i][3];
            S[i][0] = E[i + 2][0] * K.uu + E[i + 2][1] * K.vu + E[i + 2][2];
            S[i][1] = E[i + 2][0] * K.uv + E[i + 2][1] * K.vv + E[i + 2][3];
        }
        const cplx det = S[0][0] * S[1][1] - S[0][1] * S[1][0];
        /* without the care of C11's quotients, which numbers of this size do not need */
        const cplx per_det = conj(det) / (gsl_pow_2(creal(det)) + gsl_pow_2(cimag(det)));
        K = (rb_ring_compliance){(D[0][0] * S[1][1] - D[0][1] * S[1][0]) * per_det,
                                 (D[0][1] * S[0][0] - D[0][0] * S[0][1]) * per_det,
                                 (D[1][0] * S[1][1] - D[1][1] * S[1][0]) * per_det,
                                 (D[1][1] * S[0][0] - D[1][0] * S[0][1]) * per_det};
    }
    return K;
}

rb_ring_compliance rb_ring_of_disc(double m, double kappa)
{
    const double outer = 0.5 * kappa / (m + 1.0), inner = 0.5 / (m - 1.0);
    return (rb_ring_compliance){outer + inner, outer - inner, outer - inner, outer + inner};
}
