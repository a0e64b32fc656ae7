/* References for transient rolling and for rolling resistance. */
#include "analysis/prony/prony.h"
#include "program/verify/internal.h"

#include "rolling/case/closed_forms.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <string.h>

/* ---- Cattaneo to Carter ------------------------------------------------------------ */

/* Creepage in the middle of the step that ends nearest to the distance. */
static double creepage_at(const rb_rolling_history *h, double distance)
{
    int nearest = 0;
    for (int k = 1; k < h->n; k++)
        if (fabs(h->distance[k] - distance) < fabs(h->distance[nearest] - distance))
            nearest = k;
    return h->n > 0 ? h->creepage[nearest] : NAN;
}

/* Steel on steel from rest to Q = 0.64 mu P: theory-solvers.md 6, computed with CONTACT, 200
 * elements across, steps of one element.  Near the kink at 0.8 it still moves with n. */
static void cattaneo_to_carter(rb_verify *v)
{
    static const double distance[] = {0.04, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0, 1.4, 2.0, 3.0};
    static const double wanted[] = {1.214e-4, 1.243e-4, 1.298e-4, 1.432e-4, 1.619e-4,
                                    2.027e-4, 2.818e-4, 2.393e-4, 2.371e-4, 2.389e-4};
    rb_rolling_case rc = rb_verify_uncoupled();
    rb_rolling_history h;
    rb_rolling_model model;
    static rb_message why;
    rc.a.radius = 500.0;
    rc.a.poisson = 0.28;
    rc.a.young = 2.0 * 82000.0 * 1.28;
    rb_verify_on_same(&rc);
    rc.half_width = NAN;
    rc.load = 178.896;
    rc.mu = 0.3;
    rc.formulation = RB_TRANSIENT;
    rc.mesh = RB_MESH_UNIFORM;
    rc.contact_elements = 250;
    rc.zone = 1.25 * rb_closed_hertz_half_width(rc.load, rc.a.radius,
                                                rc.a.young / 2.0 / (1.0 - 0.28 * 0.28));
    rc.force_ratio = -0.64;
    rc.distance = 3.0;
    const rb_status s = rb_rolling_history_run(&rc, NULL, NULL, &model, &h, &why);
    rb_verify_note(v, s, &why);
    for (int k = 0; k < 10; k++)
        rb_verify_relative(v, creepage_at(&h, distance[k]), wanted[k], 0.01,
                           "Cattaneo to Carter: creepage after %g a", distance[k]);
    rb_rolling_history_free(&h);
    rb_rolling_model_free(&model);
}

/* ---- Power ------------------------------------------------------------------------- */

/* Similar bodies: what friction loses is what the creepage feeds, D = -xi Q. */
static void dissipation(rb_verify *v)
{
    rb_rolling_case rc = rb_verify_uncoupled();
    rc.formulation = RB_STEADY;
    rc.creep_ratio = 0.4;
    const rb_rolling_solution *s = rb_verify_solve(v, &rc);
    rb_verify_relative(v, s->dissipation, -s->creepage * s->tangential_load, 1e-3,
                       "dissipated power: D = -xi Q");
}

/* ---- Bodies that relax ------------------------------------------------------------- */

/* A cylinder that relaxes, with a_g = 1, and rolls without friction. */
static rb_rolling_case relaxing_cylinder(double radius, double ratio, double length, int elements)
{
    rb_rolling_case rc = rb_verify_uncoupled();
    rc.a.radius = radius;
    rc.half_width = 1.0;
    rc.a.memory = (rb_rolling_memory){1, {length}, {ratio}};
    rc.speed = 1.0;
    rc.mu = 0.0;
    rc.creep = 0.0;
    rc.formulation = RB_STEADY;
    rc.contact_elements = elements;
    return rc;
}

/* Hunter's solution (V3), a_g = 1: f, V tau, both edges, p_max over the glassy Hertz's,
 * M/P. */
static void hunter(rb_verify *v)
{
    static const double rows[3][6] = {{1.0, 1.0, 1.3698037, -1.0148946, 0.8318884, 0.2621595},
                                      {1.0, 10.0, 1.1283544, -0.8863649, 0.9930890, 0.1334710},
                                      {4.0, 1.0, 2.1922928, -1.5023576, 0.5770909, 0.5920417}};
    for (int k = 0; k < 3; k++) {
        const double *row = rows[k];
        const rb_rolling_case rc = relaxing_cylinder(1e4, row[0], row[1], 200);
        const rb_rolling_solution *s = rb_verify_solve(v, &rc);
        const double P = s->normal_load, p_glassy = 2.0 * P / M_PI;
        rb_verify_absolute(v, s->contact_to, row[2], 1e-3,
                           "Hunter, f = %g, V tau = %g a: leading edge / a", row[0], row[1]);
        rb_verify_absolute(v, s->contact_from, row[3], 1e-3,
                           "Hunter, f = %g, V tau = %g a: trailing edge / a", row[0], row[1]);
        rb_verify_relative(v, s->max_pressure / p_glassy, row[4], 2e-3,
                           "Hunter, f = %g, V tau = %g a: p_max / p0", row[0], row[1]);
        rb_verify_absolute(v, s->resistance_moment / P, row[5], 1e-4,
                           "Hunter, f = %g, V tau = %g a: M/(P a)", row[0], row[1]);
        rb_verify_relative(v, s->hysteresis, s->resistance_moment / rc.a.radius, 1e-3,
                           "Hunter, f = %g, V tau = %g a: hysteresis = M/R", row[0], row[1]);
    }
}

/* Held approach: all tractions follow the relaxation modulus, [1 + f exp(-(1+f) t/tau)]
 * over 1 + f. */
static void relaxation(rb_verify *v)
{
    enum { STEPS = 60 };
    static const double time[2] = {0.0, 0.6}, approach[2] = {0.01, 0.01}, f = 3.0;
    const rb_rolling_program program = {.n = 2, .time = time, .approach = approach};
    rb_rolling_case rc = rb_verify_uncoupled();
    rb_rolling_model model = {0};
    rb_rolling_history h = {0};
    rb_message why = {.text = ""};
    rc.half_width = rc.load = NAN;
    rc.mu = 0.0;
    rc.formulation = RB_STATIC;
    rc.mesh = RB_MESH_UNIFORM;
    rc.a.memory = (rb_rolling_memory){1, {1.0}, {f}};
    rc.time_step = time[1] / STEPS;
    const rb_status s = rb_rolling_history_run(&rc, &program, NULL, &model, &h, &why);
    rb_verify_note(v, s, &why);
    for (int k = STEPS / 3; k <= STEPS; k += STEPS / 3) {
        const double got = s == RB_OK ? h.normal_load[k] / h.normal_load[0] : NAN;
        const double t = k * rc.time_step;
        rb_verify_absolute(v, got, (1.0 + f * exp(-(1.0 + f) * t)) / (1.0 + f), 1e-4,
                           "held approach, f = 3: P(t)/P(0) at t = %g tau", t);
    }
    rb_rolling_history_free(&h);
    rb_rolling_model_free(&model);
}

/* A material of three terms comes back from its moduli, 2 times per decade; the middle one has its
 * time among them, the last one lies between two. */
static void prony(rb_verify *v)
{
    enum { POINTS = 31, TERMS = 3 };
    static const double f[TERMS] = {0.5, 1.5, 0.8}, tau[TERMS] = {1e-3, 0.1, 5.0};
    rb_prony_series s = {.young = 10.0, .terms = TERMS};
    double omega[POINTS], storage[POINTS], loss[POINTS];
    rb_message why = {.text = ""};
    memcpy(s.ratio, f, sizeof f);
    memcpy(s.time, tau, sizeof tau);
    for (int i = 0; i < POINTS; i++) {
        omega[i] = pow(10.0, -2.0 + 0.2 * i);
        rb_prony_moduli(&s, omega[i], &storage[i], &loss[i]);
    }
    const rb_prony_data data = {POINTS, omega, storage, loss};
    rb_verify_note(v, rb_prony_solve(&data, 2.0, RB_ROLLING_TERMS, &s, &why), &why);
    for (int k = 0; k < TERMS; k++) {
        const int found = s.terms == TERMS;
        rb_verify_relative(v, found ? s.ratio[k] : NAN, f[k], 0.006, "prony: f of tau = %g",
                           tau[k]);
        rb_verify_relative(v, found ? s.time[k] : NAN, tau[k], 0.02, "prony: tau = %g", tau[k]);
    }
}

void rb_verify_rolling(rb_verify *v)
{
    dissipation(v);
    hunter(v);
    /* The same on a large wheel: its memory goes round with it, and the half-plane is its
     * limit, of first order in a/R. */
    rb_rolling_case rc = relaxing_cylinder(400.0, 1.0, 1.0, 100);
    rc.a.support = RB_BEM_HUB;
    rc.a.hub_ratio = 0.3;
    const rb_rolling_solution *s = rb_verify_solve(v, &rc);
    rb_verify_absolute(v, s->resistance_moment / s->normal_load, 0.2621595, 1e-3,
                       "Hunter on a cylinder held by its hub: M/(P a)");
    rb_verify_relative(v, s->hysteresis, s->resistance_moment / rc.a.radius, 1e-3,
                       "Hunter on a cylinder held by its hub: hysteresis = M/R");
    relaxation(v);
    prony(v);
    cattaneo_to_carter(v);
}
