/* Errors of fitted elements compared with closed forms, and pairs of cases that must give
 * the same result. */
#include "program/verify/internal.h"

#include "rolling/case/closed_forms.h"

#include <math.h>

/* The larger error; NaN, of a case that was not solved, stays. */
static double larger(double error, double so_far)
{
    return error <= so_far ? so_far : error;
}

/* ---- Carter ------------------------------------------------------------------------ */

/* Largest error of Q/(mu P) for s = 0.1 ... 0.95. */
static void carter_at(rb_verify *v, int elements, double bound)
{
    double largest = 0.0;
    for (int k = 1; k <= 10; k++) {
        const double ratio = fmin(0.1 * k, 0.95);
        rb_rolling_case rc = rb_verify_uncoupled();
        rc.formulation = RB_STEADY;
        rc.contact_elements = elements;
        rc.creep_ratio = ratio;
        const rb_rolling_solution *s = rb_verify_solve(v, &rc);
        const double error = fabs(s->force_ratio - rb_closed_carter_force_ratio(ratio));
        largest = larger(error, largest);
    }
    rb_verify_absolute(v, largest, 0.0, bound, "Carter, %d elements: largest error of Q/(mu P)",
                       elements);
}

/* Two similar cylinders roll as one of nu = 1/2 on a rigid plane. */
static void similar_pair(rb_verify *v)
{
    rb_rolling_case rc = rb_verify_uncoupled();
    rc.formulation = RB_STEADY;
    rc.creep_ratio = 0.4;
    const rb_rolling_solution *one = rb_verify_solve(v, &rc);
    rc.a.poisson = 0.3;
    rc.b = rc.a;
    rc.elastic_b = 1;
    const rb_rolling_solution *two = rb_verify_solve(v, &rc);
    rb_verify_relative(v, two->force_ratio, one->force_ratio, 1e-9,
                       "similar cylinders as nu = 1/2 on a rigid plane");
}

/* ---- Cattaneo ---------------------------------------------------------------------- */

static void cattaneo_traction(rb_verify *v)
{
    rb_rolling_case rc = rb_verify_uncoupled();
    double sum = 0.0, length = 0.0;
    rc.contact_elements = 200;
    rc.force_ratio = 0.64;
    const rb_rolling_solution *s = rb_verify_solve(v, &rc);
    const double a = rc.half_width, p0 = rb_closed_hertz_max_pressure(s->normal_load, a);
    for (int i = 0; i < s->n; i++) {
        const double q = rb_closed_cattaneo_traction(rc.mu, p0, a, 0.64, s->x[i]);
        sum += (s->q[i] - q) * (s->q[i] - q) * s->h[i];
        length += s->h[i];
    }
    rb_verify_absolute(v, sqrt(sum / length) / (rc.mu * p0), 0.0, 2e-3,
                       "Cattaneo-Mindlin, 200 elements: rms of q / (mu p0)");
}

/* ---- Bentall and Johnson ----------------------------------------------------------- */

static void bentall_johnson_at(rb_verify *v, double mu, double wanted, double bound)
{
    rb_rolling_case rc = rb_verify_aluminium_on_steel(mu);
    rc.contact_elements = 200;
    const rb_rolling_solution *s = rb_verify_solve(v, &rc);
    rb_verify_relative(v, s->creepage, wanted, bound,
                       "Bentall-Johnson, mu = %g, 200 elements: creepage", mu);
}

void rb_verify_accuracy(rb_verify *v)
{
    const double beta = 0.143834, modulus = 51572.3, a = 0.1, R = 25.0;
    const double rough = rb_closed_bentall_johnson_stick(beta, a, R, modulus).creepage,
                 smooth = rb_closed_bentall_johnson_slip(beta, a, R);
    carter_at(v, 50, 3e-4);
    carter_at(v, 100, 1.5e-4);
    carter_at(v, 200, 3e-5);
    /* The creepage of a given force, Q/(mu P) = 0.1 ... 0.99. */
    double largest = 0.0, off = 0.0;
    for (int k = 1; k <= 10; k++) {
        const double ratio = fmin(0.1 * k, 0.99);
        rb_rolling_case rc = rb_verify_uncoupled();
        rc.formulation = RB_STEADY;
        rc.contact_elements = 200;
        rc.force_ratio = -ratio;
        const rb_rolling_solution *s = rb_verify_solve(v, &rc);
        const double wanted = rb_closed_carter_creep_ratio(-ratio);
        const double error = fabs(s->creep_ratio / wanted - 1.0);
        largest = larger(error, largest);
        off = larger(fabs(s->force_ratio / ratio + 1.0), off);
    }
    rb_verify_absolute(v, off, 0.0, 1e-10, "Carter by force: Q as asked, relative");
    rb_verify_absolute(v, largest, 0.0, 2e-4, "Carter by force, 200 elements: creepage, relative");
    similar_pair(v);
    cattaneo_traction(v);
    bentall_johnson_at(v, 10.0, -rough, 1e-3);
    bentall_johnson_at(v, 1e-4, -smooth, 5e-3);
    bentall_johnson_at(v, 1e-6, -smooth, 5e-3);
    /* Dissimilar bodies also do work against the pressure: D = -xi Q + (1/R) int x p dx. */
    rb_rolling_case rc = rb_verify_aluminium_on_steel(0.1);
    double moment = 0.0;
    rc.contact_elements = 200;
    rc.force = NAN;
    rc.creep_ratio = 0.4;
    const rb_rolling_solution *s = rb_verify_solve(v, &rc);
    for (int i = 0; i < s->n; i++)
        moment += s->x[i] * s->p[i] * s->h[i];
    rb_verify_relative(v, s->dissipation, -s->creepage * s->tangential_load + moment / 25.0, 1e-3,
                       "dissipated power of dissimilar bodies");
}
