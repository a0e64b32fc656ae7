/* The exact elastic disc: what the elements converge to (theory: kernels of the disc).
 * A force P = p exp(i alpha) on the rim, p = p_r + i p_t, and with b the angle from it to
 * the point, kap = 3 - 4 nu:
 *     4 pi G (u_r + i u_t) = p exp(-ib) [-kap ln(1-exp(ib)) - kap exp(ib) -
 * ln(1-exp(-ib))]
 *                            + (kap-1)/2 Re p - conj(p) exp(ib)
 * up to a rigid motion, the resultant balanced by a force and a couple at the centre.
 * Over an arc the logarithms integrate to elementary functions: I1 = int exp(-ix)
 * ln(1-exp(ix)) dx  = -i [(1-exp(-ix)) ln(1-exp(ix)) - ix] I2 = int exp(-ix)
 * ln(1-exp(-ix)) dx =  i (1-exp(-ix)) [1 - ln(1-exp(-ix))] */
#include "bem/internal.h"
#include "bem/layers/ring.h"

#include <complex.h>
#include <gsl/gsl_math.h>
#include <math.h>

typedef double complex cplx;

/* ln(1 - exp(ix)), 0 < |x| < 2 pi, without cancellation at small x */
static cplx log_one_less(double x)
{
    return log(2.0 * fabs(sin(0.5 * x))) + 0.5 * I * (x - copysign(M_PI, x));
}

/* 1 - exp(-ix) */
static cplx one_less(double x)
{
    const double s = 2.0 * sin(0.5 * x);
    return s * sin(0.5 * x) + s * cos(0.5 * x) * I;
}

static cplx primitive_1(double x)
{
    return x == 0.0 ? 0.0 : -I * (one_less(x) * log_one_less(x) - x * I);
}

static cplx primitive_2(double x)
{
    return x == 0.0 ? 0.0 : I * one_less(x) * (1.0 - conj(log_one_less(x)));
}

/* -kap exp(-ix) ln(1-exp(ix)) - kap - exp(-ix) ln(1-exp(-ix)) has the wave 1 of
 * kap/2 exp(ix), and none of the waves 0 and -1. */
double complex rb_ring_disc_primitive(double kappa, double x)
{
    return -kappa * (primitive_1(x) + x + 0.5 * I * conj(one_less(x))) - primitive_2(x);
}

rb_status rb_bem_disc_response(const rb_bem_disc *disc, double h, double angle, double response[4])
{
    const rb_bem_material material = disc->material;
    if (!(disc->radius > 0.0 && h > 0.0 && h < 2.0 * M_PI) || !isfinite(angle) ||
        rb_bem_material_check(material, NULL) != RB_OK)
        return RB_EINVAL;
    const double b = remainder(angle, 2.0 * M_PI), kap = 3.0 - 4.0 * material.poisson;
    const double scale = disc->radius / (4.0 * M_PI * material.shear);
    /* int over [b - h/2, b + h/2] of exp(-ix) ln(1-exp(ix)) and exp(-ix) ln(1-exp(-ix)); far
     * off by three Gauss points, where primitives would cancel. */
    cplx first = 0.0, second = 0.0;
    if (fabs(b) < 50.0 * h) {
        first = primitive_1(b + 0.5 * h) - primitive_1(b - 0.5 * h);
        second = primitive_2(b + 0.5 * h) - primitive_2(b - 0.5 * h);
    } else {
        for (int k = -1; k <= 1; k++) {
            const double x = b + k * (0.5 * h * sqrt(0.6)), weight = h * (k ? 5.0 : 8.0) / 18.0;
            const cplx l = log_one_less(x), turn = weight * (cos(x) - sin(x) * I);
            first += turn * l;
            second += turn * conj(l);
        }
    }
    const cplx direct = -kap * first - kap * h - second,
               turned = 2.0 * sin(0.5 * h) * (cos(b) + sin(b) * I);
    for (int k = 0; k < 2; k++) {
        const cplx p = k ? I : 1.0;
        const cplx u = scale * (p * direct + 0.5 * h * (kap - 1.0) * creal(p) - conj(p) * turned);
        response[2 * k] = creal(u);
        response[2 * k + 1] = cimag(u);
    }
    return RB_OK;
}
