/* Kelvin's integrals over one straight constant element (B2, B3), written once for single
 * points and for the vector loops of column.c.  Plain arithmetic, no calls: every
 * instruction set gives the same bits.
 *
 *     U_ij = C [-kap ln r d_ij + r,i r,j],           C = 1/(8 pi G (1-nu)), kap = 3 - 4
 * nu T_ij = (D/r) [r,n ((1-2nu) d_ij + 2 r,i r,j) - (1-2nu) (r,i n_j - r,j n_i)], D =
 * -1/(4 pi (1-nu))
 *
 * Seen from p, an element of half-length a with midpoint m, direction t and outward
 * normal n = (ty, -tx) lies at  X = (m-p).t,  d = (m-p).n.  With r1, r2 the distances to
 * its ends:
 *
 *     dot = X^2 + d^2 - a^2,   cross = 2 a d,   W = dot^2 + cross^2 = r1^2 r2^2
 *     Lam = ln(r2/r1),   Th = atan2(cross, dot)  (the angle that it subtends, with sign)
 *     L   = int ln r ds = X Lam + (a/2) ln W - 2a + d Th
 *
 *     G11, G22 = C (a - kap L) +- C (a - d Th),   G12 = G21 = C d Lam
 *     H11, H22 = D (2 (1-nu) Th +- q (X^2 - d^2 - a^2)),        q = cross/W
 *     H12, H21 = D (2 d X q -+ (1-2nu) Lam)
 *
 * in the axes (t, n).  Turning them to (x, y) keeps the isotropic parts, turns the
 * deviators by twice the angle of t, and reverses the sign of the skew part, (t, n) being
 * left-handed.  Nothing here subtracts nearly equal numbers. */
#ifndef ROLLBEM_BEM_KERNELS_H
#define ROLLBEM_BEM_KERNELS_H

#include "rollbem/bem.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* gcc takes contraction off with -std=c11; clang has to be told */
#ifdef __clang__
#pragma STDC FP_CONTRACT OFF
#endif
#define RB_INLINE static inline __attribute__((always_inline))

typedef struct {
    double mx, my, a; /* midpoint, half-length */
    double tx, ty;    /* direction */
    double log_r0;    /* of the length in which the logarithm's distance is measured */
} rb_element;

/* The constants of one element's integrals in one material. */
typedef struct {
    double H_mean, H_cos, H_sin,
        H_skew;           /* D times 2 (1-nu), cos 2 angle, sin, 1 - 2 nu */
    double G_cos, G_sin;  /* C times cos 2 angle, sin */
    double G_kap, G_mean; /* C kap; C [a + 2 a kap (1 + ln r0)] */
    double half_a;
} rb_constants;

/* G: Gxx, Gyy, Gxy = Gyx; H: row = load direction at p, column = component. */
typedef struct {
    double Hxx, Hyx, Hxy, Hyy, Gxx, Gxy, Gyy;
} rb_influence;

static inline rb_element rb_element_make(double x0, double y0, double x1, double y1,
                                         double r0)
{
    const double dx = x1 - x0, dy = y1 - y0, length = hypot(dx, dy);
    return (rb_element){.mx = 0.5 * (x0 + x1),
                        .my = 0.5 * (y0 + y1),
                        .a = 0.5 * length,
                        .tx = dx / length,
                        .ty = dy / length,
                        .log_r0 = log(r0)};
}

static inline rb_constants rb_constants_make(const rb_element *e,
                                             rb_bem_material material)
{
    const double pi = 3.14159265358979323846, nu = material.poisson;
    const double C = 1.0 / (8.0 * pi * material.shear * (1.0 - nu)), kap = 3.0 - 4.0 * nu;
    const double D = -1.0 / (4.0 * pi * (1.0 - nu));
    const double cos2 = (e->tx - e->ty) * (e->tx + e->ty), sin2 = 2.0 * e->tx * e->ty;
    return (rb_constants){.H_mean = 2.0 * (1.0 - nu) * D,
                          .H_cos = D * cos2,
                          .H_sin = D * sin2,
                          .H_skew = (1.0 - 2.0 * nu) * D,
                          .G_cos = C * cos2,
                          .G_sin = C * sin2,
                          .G_kap = C * kap,
                          .G_mean = C * e->a * (1.0 + 2.0 * kap * (1.0 + e->log_r0)),
                          .half_a = 0.5 * e->a};
}

/* x = 2^k m with m in [sqrt(1/2), sqrt 2), for normal x > 0. */
RB_INLINE double rb_log_split(double x, double *k)
{
    const uint64_t root_half = 0x3fe6a09e667f3bcd, bias = 1023;
    uint64_t bits, power;
    double m;
    memcpy(&bits, &x, sizeof bits);
    const uint64_t shifted = bits - root_half + (bias << 52);
    power = (shifted >> 52) | 0x4330000000000000; /* the double 2^52 + bias + k */
    bits -= ((shifted >> 52) - bias) << 52;
    memcpy(k, &power, sizeof *k);
    memcpy(&m, &bits, sizeof m);
    *k -= 4503599627370496.0 + 1023.0;
    return m;
}

/* ln(2^k m) from s = (m-1)/(m+1):  ln m = 2 atanh s,  s^2 < 0.0295: ten terms. */
RB_INLINE double rb_log_join(double k, double s)
{
    /* in pairs: a chain of nine would wait for each product */
    const double z = s * s, zz = z * z, z4 = zz * zz;
    const double low = (1.0 / 3 + z * (1.0 / 5)) + zz * (1.0 / 7 + z * (1.0 / 9)),
                 high = (1.0 / 11 + z * (1.0 / 13)) + zz * (1.0 / 15 + z * (1.0 / 17));
    const double p = low + z4 * (high + z4 * (1.0 / 19));
    const double twice = s + s;
    return k * 0.69314718055994530942 + (twice + twice * (z * p));
}

RB_INLINE double rb_log(double x)
{
    double k;
    const double m = rb_log_split(x, &k);
    return rb_log_join(k, (m - 1.0) / (m + 1.0));
}

/* atan2(y, x), not both 0: the angle of the first octant less that of the nearest of the
 * slopes 0, 1/4, 1/2, 3/4, 1, |tan| < 1/8: nine terms.  Conditions are numbers, because
 * branches would keep loops from being vectorised. */
RB_INLINE double rb_atan2(double y, double x)
{
    const double pi = 3.14159265358979323846, pi_low = 1.2246467991473532e-16;
    const double ax = fabs(x), ay = fabs(y), big = ax > ay ? ax : ay,
                 small = ax > ay ? ay : ax;
    const double q1 = small > 0.125 * big ? 1.0 : 0.0,
                 q2 = small > 0.375 * big ? 1.0 : 0.0,
                 q3 = small > 0.625 * big ? 1.0 : 0.0,
                 q4 = small > 0.875 * big ? 1.0 : 0.0;
    const double steep = ay > ax ? 1.0 : 0.0, left = x < 0.0 ? 1.0 : 0.0,
                 sign = y < 0.0 ? -1.0 : 1.0;
    const double slope = 0.25 * ((q1 + q2) + (q3 + q4));
    /* atan 1/4 and what each further quarter adds */
    const double base = (q1 * 0.24497866312686415417 + q2 * 0.21866894587394196204) +
                        (q3 * 0.17985349979247827059 + q4 * 0.14189705460416392281);
    const double s = (small - slope * big) / (big + slope * small), z = s * s;
    double p = 1.0 / 17;
    p = 1.0 / 15 - p * z;
    p = 1.0 / 13 - p * z;
    p = 1.0 / 11 - p * z;
    p = 1.0 / 9 - p * z;
    p = 1.0 / 7 - p * z;
    p = 1.0 / 5 - p * z;
    p = 1.0 / 3 - p * z;
    const double octant = base + (s - s * z * p);
    const double half =
        steep * (0.5 * pi) + (1.0 - 2.0 * steep) * (octant - steep * (0.5 * pi_low));
    return sign * (left * pi + (1.0 - 2.0 * left) * (half - left * pi_low));
}

/* rho = X^2 + d^2; square = (X + i d)^2, real part and imaginary part. */
typedef struct {
    double X, d, rho, square_re, square_im, dot, cross, W, over_W;
    double a_over_rho, Lam, Th, log_W;
} rb_seen;

/* Where rho > 400 a^2 the two transcendentals are one short series. */
RB_INLINE int rb_is_far(const rb_element *e, double px, double py)
{
    const double dx = e->mx - px, dy = e->my - py;
    return dx * dx + dy * dy > 400.0 * (e->a * e->a);
}

RB_INLINE rb_seen rb_see(const rb_element *e, double px, double py)
{
    const double dx = e->mx - px, dy = e->my - py, a = e->a;
    rb_seen v;
    v.X = dx * e->tx + dy * e->ty;
    v.d = dx * e->ty - dy * e->tx;
    const double XX = v.X * v.X, dd = v.d * v.d;
    v.rho = XX + dd;
    v.square_re = XX - dd;
    v.square_im = (v.X + v.X) * v.d;
    v.dot = v.rho - a * a;
    v.cross = (a + a) * v.d;
    v.W = v.dot * v.dot + v.cross * v.cross;
    return v;
}

/* One division serves 1/W, 1/rho and, where wanted, ln W. */
RB_INLINE void rb_divide_far(double a, int with_log, rb_seen *v)
{
    double k = 0.0, m = 1.0, over = v->W * v->rho;
    if (with_log) {
        m = rb_log_split(v->W, &k);
        const double above = 1.0 / (over * (m + 1.0));
        v->log_W = rb_log_join(k, (m - 1.0) * (above * over));
        over = above * (m + 1.0);
    } else {
        over = 1.0 / over;
    }
    v->over_W = over * v->rho;
    v->a_over_rho = a * (over * v->W);
}

/* Lam + i Th = 2 atanh u = 2u (1 + w/3 + w^2/5 + ...), u = a (X + i d)/rho, w = u^2,
 * |w| < 1/400: six terms, summed in real arithmetic (b_k = c_k + 2 Re w b_k+1 -
 * |w|^2 b_k+2). */
RB_INLINE void rb_turn_far(double a, rb_seen *v)
{
    const double f = v->a_over_rho, ff = f * f, af = a * f;
    const double wr = ff * v->square_re, half_wi = 0.5 * (ff * v->square_im);
    const double p = wr + wr, q = af * af;
    const double b4 = 1.0 / 9 + p * (1.0 / 11), b3 = 1.0 / 7 + p * b4 - q * (1.0 / 11),
                 b2 = 1.0 / 5 + p * b3 - q * b4, b1 = 1.0 / 3 + p * b2 - q * b3;
    const double sr = 2.0 + (p * b1 - 2.0 * (q * b2)), si = 4.0 * (half_wi * b1);
    const double ur = f * v->X, ui = f * v->d;
    v->Lam = ur * sr - ui * si;
    v->Th = ur * si + ui * sr;
}

RB_INLINE double rb_Lam_near(double a, const rb_seen *v)
{
    const double x1 = v->X - a, x2 = v->X + a, dd = v->d * v->d;
    return 0.5 * rb_log((x2 * x2 + dd) / (x1 * x1 + dd));
}

RB_INLINE double rb_Th_near(const rb_seen *v)
{
    return rb_atan2(v->cross, v->dot);
}

RB_INLINE void rb_integrate_H(const rb_constants *k, double a, const rb_seen *v,
                              rb_influence *out)
{
    const double q = v->cross * v->over_W;
    const double s11 = q * (v->square_re - a * a), s12 = q * v->square_im;
    const double mean = k->H_mean * v->Th, skew = k->H_skew * v->Lam;
    const double dev = k->H_cos * s11 + k->H_sin * s12,
                 shear = k->H_sin * s11 - k->H_cos * s12;
    out->Hxx = mean + dev;
    out->Hyy = mean - dev;
    out->Hxy = shear + skew;
    out->Hyx = shear - skew;
}

RB_INLINE void rb_integrate_G(const rb_constants *k, double a, const rb_seen *v,
                              rb_influence *out)
{
    const double d_th = v->d * v->Th, s11 = a - d_th, s12 = v->d * v->Lam;
    const double L = (v->X * v->Lam + d_th) + k->half_a * v->log_W; /* + the constant */
    const double mean = k->G_mean - k->G_kap * L, dev = k->G_cos * s11 + k->G_sin * s12;
    out->Gxx = mean + dev;
    out->Gyy = mean - dev;
    out->Gxy = k->G_sin * s11 - k->G_cos * s12;
}

/* p = m: the principal value of T is 0, the free term 1/2 stands in H. */
static inline void rb_integrate_self(const rb_constants *k, double a, rb_influence *out)
{
    const rb_seen v = {.log_W = rb_log(a * a * (a * a))};
    rb_integrate_G(k, a, &v, out);
    out->Hxx = out->Hyy = 0.5;
    out->Hxy = out->Hyx = 0.0;
}

/* From a point other than the element's own midpoint: all of rb_seen. */
RB_INLINE rb_seen rb_look(const rb_element *e, double px, double py)
{
    rb_seen v = rb_see(e, px, py);
    if (rb_is_far(e, px, py)) {
        rb_divide_far(e->a, 1, &v);
        rb_turn_far(e->a, &v);
    } else {
        v.over_W = 1.0 / v.W;
        v.log_W = rb_log(v.W);
        v.Lam = rb_Lam_near(e->a, &v);
        v.Th = rb_Th_near(&v);
    }
    return v;
}

#endif
