#include "friction/internal.h"

#include <math.h>

/* Sums of squares in this range have lost nothing to overflow or underflow. */
#define LEAST_SQUARE 1e-280
#define LARGEST_SQUARE 1e280

double rb_friction_norm(size_t n, const double *x)
{
    double sum = 0.0;
    for (size_t k = 0; k < n; k++)
        sum += x[k] * x[k];
    if (sum >= LEAST_SQUARE && sum <= LARGEST_SQUARE)
        return sqrt(sum);
    const double largest = rb_norm_inf(n, x);
    if (!(largest > 0.0) || !isfinite(largest))
        return largest;
    sum = 0.0;
    for (size_t k = 0; k < n; k++)
        sum += (x[k] / largest) * (x[k] / largest);
    return largest * sqrt(sum);
}

double rb_friction_tangential(int d, const double *x)
{
    if (d == 2)
        return fabs(x[1]);
    const double sum = x[1] * x[1] + x[2] * x[2];
    return sum >= LEAST_SQUARE && sum <= LARGEST_SQUARE ? sqrt(sum) : hypot(x[1], x[2]);
}

void rb_friction_project(int d, double mu, const double *z, double *p)
{
    const double zn = z[0], t = rb_friction_tangential(d, z);
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

void rb_friction_project_derivative(int d, double mu, const double *z, double *D)
{
    const double zn = z[0], t = rb_friction_tangential(d, z);
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
    for (int a = 1; a < d && t > 0.0; a++) {
        const double na = z[a] / t;
        D[a] = D[a * d] = mu * c * na;
        for (int b = 1; b < d; b++) {
            const double nn = na * z[b] / t;
            D[a + b * d] = mu * mu * c * nn + mu * pn / t * ((a == b) - nn);
        }
    }
}

double rb_friction_natural_norm(int d, int contacts, const double *mu, const double *rho,
                                const double *r, const double *u)
{
    double sum = 0.0;
    for (int c = 0; c < contacts; c++) {
        const double *rc = r + c * d, *uc = u + c * d, k = rho ? rho[2 * c] : 1.0;
        double z[3], p[3];
        if (rc[0] == 0.0 && rc[1] == 0.0 && rc[d - 1] == 0.0 && uc[0] >= 0.0)
            continue; /* open: F = 0 */
        for (int a = 0; a < d; a++)
            z[a] = rc[a] - k * uc[a];
        z[0] -= k * mu[c] * rb_friction_tangential(d, uc);
        rb_friction_project(d, mu[c], z, p);
        double square = 0.0;
        for (int a = 0; a < d; a++)
            square += (rc[a] - p[a]) * (rc[a] - p[a]);
        sum += square / (k * k);
    }
    return sqrt(sum);
}
