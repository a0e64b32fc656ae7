/* Newton steps on the smoothed projection with a line search; the smoothing and the regularisation
 * become smaller with the residual. */
#include "lcp/friction/smoothing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- The smoothed projection ------------------------------------------------------- */

/* (sqrt(s^2 + 4 mu^2) + s)/2 and its derivative, without cancellation for s < 0 */
static double plus(double mu, double s, double *derivative)
{
    const double root = hypot(s, 2.0 * mu);
    if (root == 0.0) {
        *derivative = 0.5;
        return 0.0;
    }
    const double value = s > 0.0 ? 0.5 * (root + s) : 2.0 * mu * mu / (root - s);
    *derivative = value / root;
    return value;
}

double rb_friction_smoothed(int n, double mu, const double *x, double *P, double *D)
{
    double t = 0.0, slope[2];
    for (int a = 1; a < n; a++)
        t = hypot(t, x[a]);
    const double lo = x[0] - t, hi = x[0] + t;
    const double plo = plus(mu, lo, &slope[0]), phi = plus(mu, hi, &slope[1]);
    P[0] = n == 1 ? phi : 0.5 * (plo + phi);
    for (int a = 1; a < n; a++)
        P[a] = t > 0.0 ? 0.5 * (phi - plo) * x[a] / t : 0.0;
    if (D) {
        const double mean = 0.5 * (slope[0] + slope[1]), half = 0.5 * (slope[1] - slope[0]);
        const double across = hi > lo ? (phi - plo) / (hi - lo) : mean;
        D[0] = mean;
        for (int a = 1; a < n; a++) {
            const double xa = t > 0.0 ? x[a] / t : 0.0;
            D[a] = D[a * n] = half * xa;
            for (int b = 1; b < n; b++) {
                const double xb = t > 0.0 ? x[b] / t : 0.0;
                D[a + b * n] = across * (a == b) + (mean - across) * xa * xb;
            }
        }
    }
    double least = INFINITY;
    if (lo != 0.0)
        least = fabs(lo);
    if (hi != 0.0)
        least = fmin(least, fabs(hi));
    return least;
}

/* ---- The method -------------------------------------------------------------------- */

#define ETA 0.05             /* mu, eps and the inner accuracy shrink by it per outer step */
#define LEAST_SMOOTHING 1e-2 /* of eps */
#define ARMIJO 1e-4
#define SMALLEST_STEP 1e-10

typedef struct {
    const rb_friction_smooth_problem *p;
    double *H, *dz, *trial;
    double unit; /* ||H(z0)||: mu, eps and beta are 1 at the start in this unit */
} smoother;

static double residual_norm(const smoother *s, double mu, double eps, const double *z, double *gap)
{
    s->p->residual(s->p->context, mu * s->unit, eps, z, s->H, gap);
    return rb_friction_norm((size_t)s->p->n, s->H) / s->unit;
}

rb_status rb_friction_smooth(const rb_friction_smooth_problem *problem, int limit, double *z,
                             int *iters)
{
    const size_t n = (size_t)problem->n;
    smoother s = {.p = problem, .unit = 1.0};
    s.H = rb_alloc(n, 3);
    if (!s.H)
        return RB_ENOMEM;
    s.dz = s.H + n;
    s.trial = s.dz + n;
    const double start = residual_norm(&s, 0.0, 0.0, z, NULL);
    if (start > 0.0 && isfinite(start))
        s.unit = start;
    double mu = 1.0, eps = 1.0, power = 1.0, gap;
    rb_status st = RB_OK;
    while (st == RB_OK && !problem->accepts(problem->context, z)) {
        /* Newton with Armijo's rule on ||H_{mu,eps}||, until it is at most beta. */
        const double beta = power;
        double norm = residual_norm(&s, mu, eps, z, NULL);
        while (st == RB_OK && norm > beta) {
            st = limit-- == 0 ? RB_MAXITER
                 : problem->late(problem->context)
                     ? RB_INTERRUPTED
                     : problem->step(problem->context, mu * s.unit, eps, z, s.H, s.dz);
            if (st != RB_OK)
                break;
            ++*iters;
            double t = 1.0, next = INFINITY;
            for (; t > SMALLEST_STEP; t *= 0.5) {
                for (size_t k = 0; k < n; k++)
                    s.trial[k] = z[k] + t * s.dz[k];
                next = residual_norm(&s, mu, eps, s.trial, NULL);
                if (next <= beta || next * next <= (1.0 - 2.0 * ARMIJO * t) * norm * norm)
                    break;
            }
            if (!(t > SMALLEST_STEP)) /* rounding: no descent is left */
                break;
            memcpy(z, s.trial, n * sizeof *z);
            norm = next;
        }
        /* The next beta; mu and eps follow the residual without smoothing, h, so that both tend to
         * 0 with it: eps <= h^2, and mu stays below what the cones' nearest kink (gap) allows. */
        const double h = st == RB_OK ? residual_norm(&s, 0.0, 0.0, z, &gap) : 0.0;
        power *= ETA;
        if (st == RB_OK && !isfinite(h))
            st = RB_SINGULAR;
        else if (st == RB_OK && power < 1e-40)
            st = RB_INACCURATE;
        if (st != RB_OK)
            break;
        eps = fmin(h * h, power);
        /* gaps at rounding would switch the smoothing off */
        mu = fmin(eps, fmax(sqrt(h) * gap / s.unit, LEAST_SMOOTHING * eps));
    }
    free(s.H);
    return st;
}
