/* Coulomb's cone of one contact: projection on it, distances to the law, the measures of error. */
#include "lcp/friction/internal.h"

#include <math.h>

/* Sums of squares in this range have lost nothing to overflow or underflow. */
static inline int is_safe(double sum)
{
    return sum >= 1e-280 && sum <= 1e280;
}

double rb_friction_norm(size_t n, const double *x)
{
    double sum = rb_dot(n, x, x);
    if (is_safe(sum))
        return sqrt(sum);
    const double largest = rb_norm_inf(n, x);
    if (!(largest > 0.0) || !isfinite(largest))
        return largest;
    sum = 0.0;
    for (size_t k = 0; k < n; k++)
        sum += (x[k] / largest) * (x[k] / largest);
    return largest * sqrt(sum);
}

/* Inline, so that loops over contacts are compiled for each dimension. */
static inline double tangential(int d, const double *x)
{
    if (d == 2)
        return fabs(x[1]);
    const double sum = x[1] * x[1] + x[2] * x[2];
    return is_safe(sum) ? sqrt(sum) : hypot(x[1], x[2]);
}

double rb_friction_tangential(int d, const double *x)
{
    return tangential(d, x);
}

static inline void project(int d, double mu, const double *z, double *p)
{
    const double zn = z[0], t = tangential(d, z);
    if (zn >= 0.0 && t <= mu * zn) { /* inside K; mu = 0: 0 <= -0 is true */
        for (int a = 0; a < d; a++)
            p[a] = z[a];
        return;
    }
    /* on the face, or the apex where -z lies in K* */
    const double face = (zn + mu * t) / (1.0 + mu * mu), pn = face > 0.0 ? face : 0.0;
    const double factor = t > 0.0 ? mu * pn / t : 0.0;
    for (int a = 1; a < d; a++)
        p[a] = factor * z[a];
    p[0] = pn;
}

void rb_friction_project(int d, double mu, const double *z, double *p)
{
    project(d, mu, z, p);
}

void rb_friction_project_derivative(int d, double mu, const double *z, double *D)
{
    const double zn = z[0], t = tangential(d, z);
    const int inside = zn >= 0.0 && t <= mu * zn;
    for (int k = 0; k < d * d; k++)
        D[k] = 0.0;
    if (inside)
        for (int a = 0; a < d; a++)
            D[a + a * d] = 1.0;
    if (inside || zn + mu * t <= 0.0)
        return;
    const double c = 1.0 / (1.0 + mu * mu), pn = c * (zn + mu * t);
    D[0] = c;
    for (int a = 1; a < d; a++) {
        const double na = z[a] / t;
        D[a] = D[a * d] = mu * c * na;
        for (int b = 1; b < d; b++) {
            const double nn = na * z[b] / t;
            D[a + b * d] = mu * mu * c * nn + mu * pn / t * ((a == b) - nn);
        }
    }
}

/* ||F||^2 of one contact */
static inline double natural_square(int d, double mu, double rho, const double *r, const double *u)
{
    double z[3], p[3], square = 0.0;
    for (int a = 0; a < d; a++)
        z[a] = r[a] - rho * u[a];
    z[0] -= rho * mu * tangential(d, u);
    project(d, mu, z, p);
    for (int a = 0; a < d; a++)
        square += (r[a] - p[a]) * (r[a] - p[a]);
    return square / (rho * rho);
}

double rb_friction_acary_norm(const rb_friction_problem *problem, const double *unit,
                              const double *r, const double *u)
{
    const int d = problem->dimension;
    double sum = 0.0;
    for (int c = 0; c < problem->contacts; c++, r += d, u += d) {
        if (r[0] == 0.0 && r[1] == 0.0 && r[d - 1] == 0.0 && u[0] >= 0.0)
            continue; /* open: F = 0 */
        /* D r and u / D with rho = 1 */
        const double own = unit ? unit[c] : 1.0, rho = 1.0 / (own * own);
        sum += natural_square(d, problem->mu[c], rho, r, u) * rho;
    }
    return sqrt(sum);
}

/* ---- The law of one contact ---------------------------------------------------------- */

/* Squared distance of (s, u), s = r / rho, to the graph of the law, which is the union of
 *     open   s = 0, u_N >= 0
 *     stick  u = 0, s in K
 *     slip   u_N = 0, s = a (1, -mu v), u_T = b v;  a, b >= 0, |v| = 1.
 * Of slip the direction v is that of u_T or of -s_T, whichever is nearer: in 2D that is
 * exact, in 3D within sqrt 2.  Unlike the natural map, which is the distance of uhat to
 * the dual cone, this neither divides u_N by mu nor multiplies u_T by it. */
static inline double law_square(int d, double mu, double rho, const double *r, const double *u)
{
    double s[3], closed = 0.0, force = 0.0;
    for (int a = 0; a < d; a++) {
        s[a] = r[a] / rho;
        force += s[a] * s[a];
        closed += u[a] * u[a];
    }
    const double un = u[0], into = un < 0.0 ? un * un : 0.0;
    double least = force + into; /* open */
    if (un * un >= least)
        return least; /* closed is further away */

    /* Stick: out is how far s lies outside of the face of K, along the face's normal. */
    const double length = hypot(1.0, mu), wn = 1.0 / length, wt = mu / length;
    const double st = tangential(d, s), ut = tangential(d, u), out = wn * st - wt * s[0];
    if (out <= 0.0 && s[0] >= 0.0)
        least = fmin(least, closed);
    else
        least = fmin(least, closed + (wn * s[0] + wt * st > 0.0 ? out * out : force));

    /* Slip: the parts of s and u beside the two half-lines. */
    for (int which = 0; which < 2; which++) {
        const double *along = which ? s : u, size = which ? -st : ut;
        double v[3] = {0.0, 0.0, 0.0}, sv = 0.0, uv = 0.0, sum = un * un;
        if (size == 0.0)
            continue;
        for (int a = 1; a < d; a++) {
            v[a] = along[a] / size;
            sv += v[a] * s[a];
            uv += v[a] * u[a];
        }
        const double a0 = fmax(wn * s[0] - wt * sv, 0.0), b0 = fmax(uv, 0.0);
        sum += (s[0] - a0 * wn) * (s[0] - a0 * wn);
        for (int a = 1; a < d; a++) {
            const double ds = s[a] + a0 * wt * v[a], du = u[a] - b0 * v[a];
            sum += ds * ds + du * du;
        }
        least = fmin(least, sum);
    }
    return least;
}

double rb_friction_law_distance(int d, double mu, double rho, const double *r, const double *u)
{
    return sqrt(law_square(d, mu, rho, r, u));
}

static inline double law_norm(int d, const rb_friction_problem *problem, const double *rho,
                              const double *r, const double *u)
{
    double sum = 0.0;
    for (int c = 0; c < problem->contacts; c++, r += d, u += d)
        if (!(r[0] == 0.0 && r[1] == 0.0 && r[d - 1] == 0.0 && u[0] >= 0.0))
            sum += law_square(d, problem->mu[c], rho[2 * c], r, u);
    return sqrt(sum);
}

double rb_friction_law_norm(const rb_friction_problem *problem, const double *rho, const double *r,
                            const double *u)
{
    return problem->dimension == 2 ? law_norm(2, problem, rho, r, u)
                                   : law_norm(3, problem, rho, r, u);
}

double rb_friction_size(const rb_friction_problem *problem, const double *rho, const double *r,
                        double *work)
{
    const int d = problem->dimension, nc = problem->contacts;
    double sum = 0.0;
    for (int c = 0; c < nc; c++) {
        const double *rc = r + c * d, k = rho[2 * c], last = d == 3 ? rc[2] : 0.0;
        sum += (rc[0] * rc[0] + rc[1] * rc[1] + last * last) / (k * k);
    }
    if (is_safe(sum))
        return sqrt(sum);
    for (int c = 0; c < nc; c++)
        for (int a = 0; a < d; a++)
            work[c * d + a] = r[c * d + a] / rho[2 * c];
    return rb_friction_norm((size_t)(d * nc), work);
}
