/* Kelvin's integrals over one straight constant element (B2, B3), written once for single
 * points and for the vector loops of column.c.  Plain arithmetic, no calls: instruction
 * sets differ by fused multiply-adds alone, that is by rounding.
 *
 *     U_ij = C [-kap ln r d_ij + r,i r,j]
 *     T_ij = (D/r) [r,n ((1-2nu) d_ij + 2 r,i r,j) - (1-2nu) (r,i n_j - r,j n_i)]
 *     C = 1/(8 pi G (1-nu)),   D = -1/(4 pi (1-nu)),   kap = 3 - 4nu
 *
 * Seen from p, an element of half-length a with midpoint m, direction t and outward
 * normal n = (ty, -tx) lies at  X = (m-p).t,  d = (m-p).n.  With r1, r2 the distances to
 * its ends:
 *
 *     rho = X^2 + d^2,   dot = rho - a^2,   cross = 2 a d
 *     Z = w1 w2 = (m-p)^2 - (a t)^2   (complex; w1, w2: from p to its ends)
 *     W = |Z|^2 = dot^2 + cross^2 = r1^2 r2^2
 *     Lam = ln(r2/r1),   Th = atan2(cross, dot)  (the angle that it subtends, with sign)
 *     L   = int ln r ds = (a/2) ln W + 2a M,   M = (X Lam + d Th)/2a - 1  (0 far away)
 *
 *     G11, G22 = C (a - kap L) +- C (a - d Th),   G12 = G21 = C d Lam
 *
 * in the axes (t, n), and in any axes, with q = cross/W,
 *
 *     Hxx, Hyy = D (2 (1-nu) Th +- q Re Z),   Hxy, Hyx = D (q Im Z +- (1-2nu) Lam)
 *
 * Turning G to (x, y) keeps its isotropic part and turns its deviator by twice the angle
 * of t.  Where nearly equal numbers are subtracted, larger ones stand beside. */
#ifndef ROLLBEM_BEM_KERNELS_H
#define ROLLBEM_BEM_KERNELS_H

#include "bem/boundary.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#ifndef RB_INLINE /* make coverage counts a function once, not in every copy */
#define RB_INLINE static inline __attribute__((always_inline))
#endif

typedef struct {
    double mx, my, a;      /* midpoint, half-length */
    double tx, ty;         /* direction */
    double end_re, end_im; /* (a t)^2 */
    double log_r0;         /* of the length in which the logarithm's distance is measured */
} rb_element;

/* The constants of one element's integrals in one material. */
typedef struct {
    double H_mean, H_dev, H_skew; /* D times 2 (1-nu), 1, 1 - 2 nu */
    double G_cos, G_sin;          /* C times cos 2 angle, sin */
    double G_mean, G_log, G_M;    /* C a (1 + 2 kap ln r0); C kap times a/2, 2a */
} rb_constants;

/* G: Gxx, Gyy, Gxy = Gyx; H: row = load direction at p, column = component. */
typedef struct {
    double Hxx, Hyx, Hxy, Hyy, Gxx, Gxy, Gyy;
} rb_influence;

static inline rb_element rb_element_make(double x0, double y0, double x1, double y1, double r0)
{
    const double dx = x1 - x0, dy = y1 - y0, length = hypot(dx, dy);
    return (rb_element){.mx = 0.5 * (x0 + x1),
                        .my = 0.5 * (y0 + y1),
                        .a = 0.5 * length,
                        .tx = dx / length,
                        .ty = dy / length,
                        .end_re = 0.25 * (dx - dy) * (dx + dy),
                        .end_im = 0.5 * dx * dy,
                        .log_r0 = log(r0)};
}

static inline rb_constants rb_constants_make(const rb_element *e, rb_bem_material material)
{
    const double pi = 3.14159265358979323846, nu = material.poisson;
    const double C = 1.0 / (8.0 * pi * material.shear * (1.0 - nu)), kap = 3.0 - 4.0 * nu;
    const double D = -1.0 / (4.0 * pi * (1.0 - nu));
    const double cos2 = (e->tx - e->ty) * (e->tx + e->ty), sin2 = 2.0 * e->tx * e->ty;
    return (rb_constants){.H_mean = 2.0 * (1.0 - nu) * D,
                          .H_dev = D,
                          .H_skew = (1.0 - 2.0 * nu) * D,
                          .G_cos = C * cos2,
                          .G_sin = C * sin2,
                          .G_mean = C * e->a * (1.0 + 2.0 * kap * e->log_r0),
                          .G_log = 0.5 * C * kap * e->a,
                          .G_M = 2.0 * C * kap * e->a};
}

/* G times factor. */
static inline void rb_constants_scale_G(rb_constants *k, double factor)
{
    k->G_cos *= factor;
    k->G_sin *= factor;
    k->G_mean *= factor;
    k->G_log *= factor;
    k->G_M *= factor;
}

/* x = 2^k m with m in [sqrt(1/2), sqrt 2), for normal x > 0. */
RB_INLINE double rb_log_split(double x, double *k)
{
    const uint64_t root_half = 0x3fe6a09e667f3bcd, one = (uint64_t)1023 << 52,
                   fraction = ((uint64_t)1 << 52) - 1;
    uint64_t bits, power;
    double m;
    memcpy(&bits, &x, sizeof bits);
    bits += one - root_half;
    power = (bits >> 52) | 0x4330000000000000; /* the double 2^52 + 1023 + k */
    bits = (bits & fraction) + root_half;
    memcpy(k, &power, sizeof *k);
    memcpy(&m, &bits, sizeof m);
    *k -= 4503599627370496.0 + 1023.0;
    return m;
}

/* ln(2^k m) from s = (m-1)/(m+1):  ln m = 2 atanh s = s (2 + z p(z)),  z = s^2 < 0.02944;
 * p: the polynomial nearest to 2/3 + 2z/5 + 2z^2/7 + ..., z p to 4e-18. */
RB_INLINE double rb_log_join(double k, double s)
{
    /* in pairs: a chain of six would wait for each product */
    const double z = s * s, zz = z * z;
    const double p0 = 0.66666666666667340 + z * 0.39999999999414661,
                 p1 = 0.28571428742392652 + z * 0.22222198572670959,
                 p2 = 0.18183564351825265 + z * 0.15314049925196338;
    const double p = p0 + zz * (p1 + zz * (p2 + zz * 0.14795955669007360));
    return k * 0.69314718055994530942 + s * (2.0 + z * p);
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
    const double ax = fabs(x), ay = fabs(y), big = ax > ay ? ax : ay, small = ax > ay ? ay : ax;
    const double q1 = small > 0.125 * big ? 1.0 : 0.0, q2 = small > 0.375 * big ? 1.0 : 0.0,
                 q3 = small > 0.625 * big ? 1.0 : 0.0, q4 = small > 0.875 * big ? 1.0 : 0.0;
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

typedef struct {
    double X, d, rho, Z_re, Z_im, W, q, Lam, Th, M, log_W;
} rb_view_angles;

/* Beyond `reach` half-lengths the two transcendentals are `terms` terms of one series. */
typedef struct {
    int terms;
    double reach;
} rb_far_range;
static const rb_far_range rb_far = {10, 6.0}, rb_farther = {6, 20.0}, rb_farthest = {4, 100.0};

RB_INLINE int rb_is_far(const rb_element *e, double px, double py)
{
    const double dx = e->mx - px, dy = e->my - py, reach = rb_far.reach * e->a;
    return dx * dx + dy * dy > reach * reach;
}

RB_INLINE rb_view_angles rb_see(const rb_element *e, double px, double py)
{
    const double dx = e->mx - px, dy = e->my - py;
    rb_view_angles v;
    v.X = dx * e->tx + dy * e->ty;
    v.d = dx * e->ty - dy * e->tx;
    v.rho = dx * dx + dy * dy;
    v.Z_re = (dx * dx - e->end_re) - dy * dy;
    v.Z_im = (dx + dx) * dy - e->end_im;
    v.W = v.Z_re * v.Z_re + v.Z_im * v.Z_im;
    return v;
}

/* Lam + i Th = 2 atanh u = 2u (1 + w/3 + w^2/5 + ...), u = a (X + i d)/rho, w = u^2, in
 * U = 2u = factor (X + i d) and V = U^2 = 4w:  U (1 + c_0 V + c_1 V^2 + ...), summed in
 * real arithmetic (b_k = c_k + 2 Re V b_k+1 - |V|^2 b_k+2);  M = Re (c_0 V + ...).
 * The rest is below |w|^terms/(2 terms + 1), |w| = 1/reach^2: 1e-17, 2e-17, 1e-17. */
RB_INLINE void rb_turn_far(double a, int terms, double factor, rb_view_angles *v)
{
    const double c[] = {1.0 / 12,    1.0 / 80,     1.0 / 448,     1.0 / 2304,   1.0 / 11264,
                        1.0 / 53248, 1.0 / 245760, 1.0 / 1114112, 1.0 / 4980736};
    const double Ur = factor * v->X, Ui = factor * v->d, Vr = Ur * Ur - Ui * Ui, half_Vi = Ur * Ui,
                 twice_Vr = Vr + Vr, V = (a + a) * factor, VV = V * V;
    double b = 0.0, next = 0.0;
    for (int k = terms - 2; k >= 0; k--) {
        const double after = next;
        next = b;
        b = (c[k] + twice_Vr * next) - VV * after;
    }
    const double sr = Vr * b - VV * next, si = 2.0 * (half_Vi * b);
    v->Lam = (Ur + Ur * sr) - Ui * si;
    v->Th = (Ui + Ui * sr) + Ur * si;
    v->M = sr;
}

RB_INLINE double rb_Lam_near(double a, const rb_view_angles *v)
{
    const double x1 = v->X - a, x2 = v->X + a, dd = v->d * v->d;
    return 0.5 * rb_log((x2 * x2 + dd) / (x1 * x1 + dd));
}

RB_INLINE double rb_Th_near(double a, const rb_view_angles *v)
{
    return rb_atan2((a + a) * v->d, v->rho - a * a);
}

RB_INLINE double rb_M_near(double a, const rb_view_angles *v)
{
    return (v->X * v->Lam + v->d * v->Th) / (a + a) - 1.0;
}

RB_INLINE void rb_integrate_H(const rb_constants *k, const rb_view_angles *v, rb_influence *out)
{
    const double q = k->H_dev * v->q, dev = q * v->Z_re, shear = q * v->Z_im;
    const double mean = k->H_mean * v->Th, skew = k->H_skew * v->Lam;
    out->Hxx = mean + dev;
    out->Hyy = mean - dev;
    out->Hxy = shear + skew;
    out->Hyx = shear - skew;
}

RB_INLINE void rb_integrate_G(const rb_constants *k, double a, const rb_view_angles *v,
                              rb_influence *out)
{
    const double s11 = a - v->d * v->Th, s12 = v->d * v->Lam;
    const double mean = (k->G_mean - k->G_M * v->M) - k->G_log * v->log_W;
    const double dev = k->G_cos * s11 + k->G_sin * s12;
    out->Gxx = mean + dev;
    out->Gyy = mean - dev;
    out->Gxy = k->G_sin * s11 - k->G_cos * s12;
}

/* p = m: the principal value of T is 0, the free term 1/2 stands in H. */
static inline void rb_integrate_self(const rb_constants *k, double a, rb_influence *out)
{
    const rb_view_angles v = {.M = -1.0, .log_W = rb_log(a * a * (a * a))};
    rb_integrate_G(k, a, &v, out);
    out->Hxx = out->Hyy = 0.5;
    out->Hxy = out->Hyx = 0.0;
}

/* From a point other than the element's own midpoint: all of rb_view_angles. */
RB_INLINE rb_view_angles rb_view_angles_of(const rb_element *e, double px, double py)
{
    rb_view_angles v = rb_see(e, px, py);
    v.q = (e->a + e->a) * v.d / v.W;
    v.log_W = rb_log(v.W);
    if (rb_is_far(e, px, py)) {
        rb_turn_far(e->a, rb_far.terms, (e->a + e->a) / v.rho, &v);
    } else {
        v.Lam = rb_Lam_near(e->a, &v);
        v.Th = rb_Th_near(e->a, &v);
        v.M = rb_M_near(e->a, &v);
    }
    return v;
}

#endif
