/* Closed forms of contact on half-planes. */
#include "program/verify/internal.h"

#include "rolling/case/closed_forms.h"

#include <gsl/gsl_math.h>
#include <math.h>

static rb_rolling_case rolling_at(double s)
{
    rb_rolling_case rc = rb_verify_uncoupled();
    rc.formulation = RB_STEADY;
    rc.creep_ratio = s;
    return rc;
}

/* rms of f(x) - wanted over the contact elements, divided by scale */
static double rms_error(const rb_rolling_solution *s, const double *f, double scale,
                        double (*wanted)(double x, const void *context), const void *context)
{
    double sum = 0.0, length = 0.0;
    for (int i = 0; i < s->n; i++) {
        const double e = (f[i] - wanted(s->x[i], context)) / scale;
        sum += e * e * s->h[i];
        length += s->h[i];
    }
    return sqrt(sum / length);
}

typedef struct {
    double mu, p0, a, s;
} curve;

static double hertz_at(double x, const void *context)
{
    const curve *c = context;
    return rb_closed_hertz_pressure(c->p0, c->a, x);
}

static double carter_at(double x, const void *context)
{
    const curve *c = context;
    return rb_closed_carter_traction(c->mu, c->p0, c->a, c->s, x);
}

/* ---- Normal contact --------------------------------------------------------------- */

static void hertz(rb_verify *v, rb_rolling_mesh_kind mesh, int elements, const char *name,
                  const double bound[4])
{
    rb_rolling_case rc = rb_verify_uncoupled();
    rc.mesh = mesh;
    rc.contact_elements = elements;
    const double modulus = rc.a.young / 0.75, a = rc.half_width;
    const double P = rb_closed_hertz_load(a, rc.a.radius, modulus);
    const curve c = {.p0 = rb_closed_hertz_max_pressure(P, a), .a = a};
    const rb_rolling_solution *s = rb_verify_solve(v, &rc);
    rb_verify_relative(v, s->normal_load, P, 1e-9, "Hertz, %s: load", name);
    rb_verify_absolute(v, s->max_pressure / c.p0, 1.0, bound[0], "Hertz, %s: p0", name);
    rb_verify_absolute(v, s->half_width / a, 1.0, bound[1], "Hertz, %s: half-width", name);
    rb_verify_absolute(v, rms_error(s, s->p, c.p0, hertz_at, &c), 0.0, bound[2],
                       "Hertz, %s: rms of p / p0", name);
    rb_verify_absolute(v,
                       s->approach / rb_closed_half_cylinder_approach(P, rc.a.radius, modulus, a),
                       1.0, bound[3], "half-cylinder compression, %s", name);
}

/* ---- Similar bodies --------------------------------------------------------------- */

/* A cylinder with a boundary on a half-plane of its material: a/R = 1e-3, so half-plane
 * theory holds to the order of approach/R (theory.md 4.3). */
static void carter_on(rb_verify *v, rb_bem_support support, const char *name)
{
    rb_rolling_case rc = rolling_at(0.4);
    rc.a.support = support;
    rc.a.poisson = rc.b.poisson = 0.3;
    rc.elastic_b = 1;
    rc.half_width = rc.a.radius * 1e-3;
    rc.mesh = RB_MESH_UNIFORM;
    rc.contact_elements = 100;
    const rb_rolling_solution *s = rb_verify_solve(v, &rc);
    rb_verify_absolute(v, s->force_ratio, rb_closed_carter_force_ratio(0.4), 0.02,
                       "Carter on a cylinder held by its %s", name);
}

/* At rest under Q and a bulk stress of B in one step the stick zone is displaced (theory-rolling.md
 * U2). */
static double displaced_at(double x, const void *context)
{
    const curve *c = context;
    const double own = rb_closed_hertz_pressure(1.0, 1.0, x / c->a),
                 half = rb_closed_cattaneo_stick(0.6);
    return c->mu * c->p0 * (own - half * rb_closed_hertz_pressure(1.0, half, x / c->a - c->s));
}

static void bulk_stress(rb_verify *v)
{
    rb_rolling_case rc = rb_verify_uncoupled();
    rc.mesh = RB_MESH_UNIFORM;
    rc.contact_elements = 200;
    rb_verify_on_same(&rc);
    const rb_rolling_derived d = rb_rolling_derive(&rc);
    const curve c = {rc.mu, d.stress, rc.half_width, -0.25};
    rc.force_ratio = 0.6;
    rc.bulk_stress_b = -4.0 * c.s * c.mu * c.p0;
    const rb_rolling_solution *s = rb_verify_solve(v, &rc);
    rb_verify_absolute(v, rms_error(s, s->q, c.mu * c.p0, displaced_at, &c), 0.0, 3e-3,
                       "bulk stress mu p0 of B: rms of q / (mu p0)");
    rc.formulation = RB_STEADY;
    const double strain = -rc.bulk_stress_b * 0.5 / d.modulus;
    const double xi = rb_verify_solve(v, &rc)->creepage;
    rc.bulk_stress_b = 0.0;
    rb_verify_relative(v, xi - rb_verify_solve(v, &rc)->creepage, strain, 1e-6,
                       "bulk stress of B: shift of the creepage");
}

/* A moment moves the contact of a cylinder by M/P (theory-rolling.md U3). */
static void tilted(rb_verify *v)
{
    rb_rolling_case rc = rb_verify_uncoupled();
    rc.mu = 0.0;
    const rb_rolling_derived d = rb_rolling_derive(&rc);
    const double arm = 0.5 * rc.half_width;
    rc.moment = arm * d.load;
    static rb_message why;
    rb_verify_note(v, rb_rolling_find_tilt(&rc, &why), &why);
    const rb_rolling_solution *s = rb_verify_solve(v, &rc);
    rb_verify_relative(v, s->tilt, arm / rc.a.radius, 1e-4, "moment P a/2 on a parabola: tilt");
    rb_verify_relative(v, 0.5 * (s->contact_from + s->contact_to), arm, 1e-4,
                       "moment P a/2 on a parabola: middle of the contact");
}

/* Of square corners, on which M = pi a^2 E* X/4 acts (theory-rolling.md U3). */
static void square_punch(rb_verify *v)
{
    static const double x[] = {-1.0, 0.0, 1.0}, gap[] = {0.0, 0.0, 0.0};
    rb_rolling_case rc = rb_verify_uncoupled();
    rb_rolling_profile *flat = NULL;
    static rb_message why;
    rb_verify_note(v, rb_rolling_profile_punch(3, x, gap, 0.0, &flat, &why), &why);
    rc.gap = RB_GAP_TABLE;
    rc.profile = flat;
    rc.mesh = RB_MESH_PUNCH;
    rc.contact_elements = 100;
    rc.half_width = NAN;
    rc.mu = 0.0;
    rc.load = 1.0;
    rc.tilt = 1.0 / (M_PI * rb_rolling_derive(&rc).modulus);
    if (flat)
        rb_verify_relative(v, rb_verify_solve(v, &rc)->resistance_moment, 0.25, 3e-4,
                           "flat punch, 100 elements: moment of its tilt");
    rb_rolling_profile_free(flat);
}

/* What slides on a rigid plane with tan(pi g) = mu beta (Johnson, Contact Mechanics, 7.2 and 2.8c):
 * a cylinder has p = E'/(2R) cos(pi g) (a + x)^(1/2 + g) (a - x)^(1/2 - g),  a = a_h/sqrt(1 - 4
 * g^2), x from the middle of its contact, which is 2 g a ahead of its axis, p largest below the
 * axis; a flat punch has p = P cos(pi g)/(pi sqrt(a^2 - x^2)) ((a + x)/(a - x))^g. Friction on the
 * body points to -x. */
static void sliding(rb_verify *v)
{
    static const double x[] = {-1.0, 0.0, 1.0}, gap[] = {0.0, 0.0, 0.0};
    rb_rolling_case rc = rb_verify_uncoupled();
    rc.a.poisson = 0.3;
    rc.mu = 1.0;
    rc.formulation = RB_STEADY;
    rc.creep = 0.1;
    const rb_rolling_derived d = rb_rolling_derive(&rc);
    const double g = atan(rc.mu * d.dundurs) / M_PI, a = rc.half_width / sqrt(1.0 - 4.0 * g * g);
    const rb_rolling_solution *s = rb_verify_solve(v, &rc);
    rb_verify_relative(v, s->half_width, a, 3e-4, "sliding cylinder, mu = 1: half-width");
    rb_verify_absolute(v, 0.5 * (s->contact_from + s->contact_to) / a, 2.0 * g, 3e-4,
                       "sliding cylinder, mu = 1: middle of the contact / a");
    rb_verify_relative(v, s->max_pressure,
                       d.modulus * a / (2.0 * rc.a.radius) * cos(M_PI * g) *
                           pow(1.0 + 2.0 * g, 0.5 + g) * pow(1.0 - 2.0 * g, 0.5 - g),
                       3e-4, "sliding cylinder, mu = 1: largest pressure");

    rb_rolling_profile *flat = NULL;
    static rb_message why;
    rb_verify_note(v, rb_rolling_profile_punch(3, x, gap, 0.0, &flat, &why), &why);
    rc.formulation = RB_STATIC;
    rc.gap = RB_GAP_TABLE;
    rc.profile = flat;
    rc.mesh = RB_MESH_PUNCH;
    rc.half_width = rc.creep = NAN;
    rc.load = 1.0;
    rc.force_ratio = -1.0;
    s = flat ? rb_verify_solve(v, &rc) : s;
    double off = v->why ? NAN : 0.0;
    for (int i = 0; i < s->n && !v->why; i++)
        if (fabs(s->x[i]) < 0.9)
            off = fmax(off, fabs(s->p[i] * M_PI * sqrt(1.0 - gsl_pow_2(s->x[i])) / cos(M_PI * g) *
                                     pow((1.0 - s->x[i]) / (1.0 + s->x[i]), g) -
                                 1.0));
    rb_verify_absolute(v, off, 0.0, 1e-3,
                       "sliding flat punch, mu = 1: p for |x| < 0.9 a, relative");
    rb_rolling_profile_free(flat);
}

/* Steel, R = 460 mm on a rail head of 300 mm, 100 kN (theory-rolling.md E2). */
static void ellipse(rb_verify *v)
{
    rb_rolling_case rc = rb_verify_uncoupled();
    rc.half_width = NAN;
    rc.mu = 0.0;
    rc.a.radius = 460.0;
    rc.a.young = 210000.0;
    rc.a.poisson = 0.3;
    rb_verify_on_same(&rc);
    rc.transverse_radius_b = 300.0;
    rc.wheel_load = 1e5;
    static rb_message why;
    rb_verify_note(v, rb_rolling_find_ellipse(&rc, &why), &why);
    const rb_rolling_solution *s = rb_verify_solve(v, &rc);
    rb_verify_relative(v, s->ellipse.b, 5.387172, 1e-6, "Hertz's ellipse of wheel and rail: b");
    rb_verify_relative(v, s->half_width, 7.161676, 1e-3, "its strip: half-width");
    rb_verify_relative(v, s->max_pressure, 1237.559, 1e-3, "its strip: largest pressure");
    rc.mu = 0.3;
    rc.formulation = RB_STEADY;
    rc.creep_ratio = 0.5;
    rc.strips = 9;
    s = rb_verify_solve(v, &rc);
    rb_verify_absolute(v, s->ellipse_force / (rc.mu * rc.wheel_load), -0.811119584, 4.4e-4,
                       "its 9 strips, s = %g: Q/(mu W)", rc.creep_ratio);
}

/* Westergaard's wave, half flattened and flat (theory-rolling.md P1). */
static void wave(rb_verify *v)
{
    rb_rolling_case rc = rb_verify_uncoupled();
    rc.half_width = NAN;
    rc.mu = 0.0;
    rc.gap = RB_GAP_WAVE;
    rc.mesh = RB_MESH_UNIFORM;
    rc.period = 10.0;
    rc.amplitude = 0.01;
    rc.zone = 5.0;
    rc.contact_elements = 128;
    const double flat = M_PI * rb_rolling_derive(&rc).modulus * rc.amplitude;
    rc.load = 0.5 * flat;
    const rb_rolling_solution *s = rb_verify_solve(v, &rc);
    rb_verify_relative(v, s->contact_share, 0.5, 1e-2, "wave, P half of what flattens it: 2a/L");
    rb_verify_relative(v, s->max_pressure, M_SQRT2 * flat / rc.period, 1e-3,
                       "wave, P half of what flattens it: p0");
    rb_verify_relative(v, s->approach, 0.5 * (1.0 + M_LN2) * rc.amplitude, 1e-3,
                       "wave, P half of what flattens it: approach");
    rc.load = 1.5 * flat;
    s = rb_verify_solve(v, &rc);
    rb_verify_relative(v, s->max_pressure, 2.5 * flat / rc.period, 1e-3, "flattened wave: p0");
}

/* The matrix of Addi et al. and its pivoted form are one problem. */
static void two_forms(rb_verify *v)
{
    rb_rolling_case rc = rolling_at(0.4);
    rc.contact.solver = RB_SOLVER_LEMKE;
    const rb_rolling_solution *s = rb_verify_solve(v, &rc);
    rc.contact.lcp_form = RB_LCP_KWAK;
    const rb_rolling_solution *t = rb_verify_solve(v, &rc);
    double difference = s->n == t->n ? 0.0 : NAN;
    for (int i = 0; i < s->n && s->n == t->n; i++)
        difference = fmax(difference, fabs(s->q[i] - t->q[i]) + fabs(s->p[i] - t->p[i]));
    rb_verify_absolute(v, difference / s->max_pressure, 0.0, 1e-9,
                       "LCP of Kwak against the pivoted form: tractions / p0");
}

/* ---- Dissimilar bodies ------------------------------------------------------------ */

/* Pressed in increments; beta is small, as the closed form wants. */
static void spence(rb_verify *v, double stick)
{
    rb_rolling_case rc = rb_verify_uncoupled();
    rb_rolling_history h;
    rb_rolling_model model;
    static rb_message why;
    rc.a.poisson = 0.499;
    rc.mu = rb_closed_spence_friction(rb_rolling_derive(&rc).dundurs, stick);
    rc.mesh = RB_MESH_UNIFORM;
    rc.contact_elements = 200;
    rc.increments = 40;
    const rb_status s = rb_rolling_history_run(&rc, NULL, NULL, &model, &h, &why);
    rb_verify_note(v, s, &why);
    const int last = h.n - 1;
    const double part = h.n > 0 ? (double)h.stick[last] / (h.stick[last] + h.slipping[last]) : NAN;
    rb_verify_absolute(v, part, stick, 0.01, "Spence, growing load: part that sticks");
    rb_rolling_history_free(&h);
    rb_rolling_model_free(&model);
}

/* Thin discs: E* and beta by the constants themselves (theory.md B2). */
static void thin_discs(rb_verify *v)
{
    rb_rolling_case rc = rb_verify_aluminium_on_steel(20.0);
    rc.plane = RB_PLANE_STRESS;
    const double E_a = rc.a.young, E_b = rc.b.young, a = rc.half_width, R = 25.0;
    const double modulus = 1.0 / (1.0 / E_a + 1.0 / E_b);
    const double beta = 0.5 * modulus * ((1.0 - rc.a.poisson) / E_a - (1.0 - rc.b.poisson) / E_b);
    const rb_closed_bentall_johnson rough = rb_closed_bentall_johnson_stick(beta, a, R, modulus);
    const rb_rolling_solution *s = rb_verify_solve(v, &rc);
    rb_verify_relative(v, s->creepage, -rough.creepage, 1e-3,
                       "plane stress, Bentall-Johnson, mu = 20: creepage of mu -> inf");
    rc = rb_verify_aluminium_on_steel(1e-4);
    rc.plane = RB_PLANE_STRESS;
    rc.contact_elements = 200; /* one of them is all that the creepage of mu -> 0 knows */
    s = rb_verify_solve(v, &rc);
    rb_verify_relative(v, s->normal_load, rb_closed_hertz_load(a, R, modulus), 1e-9,
                       "plane stress, Hertz: load");
    rb_verify_relative(v, s->creepage, -rb_closed_bentall_johnson_slip(beta, a, R), 2e-3,
                       "plane stress, Bentall-Johnson, mu = 1e-4: creepage of mu -> 0");
}

static void bentall_johnson(rb_verify *v)
{
    const double beta = 0.143834, modulus = 51572.3, a = 0.1, R = 25.0;
    const rb_closed_bentall_johnson rough = rb_closed_bentall_johnson_stick(beta, a, R, modulus);
    rb_rolling_case rc = rb_verify_aluminium_on_steel(20.0);
    const rb_rolling_solution *s = rb_verify_solve(v, &rc);
    rb_verify_relative(v, s->creepage, -rough.creepage, 1e-3,
                       "Bentall-Johnson, mu = 20: creepage of mu -> inf");
    rb_verify_relative(v, s->half_width, rough.half_width, 1e-3,
                       "Bentall-Johnson, mu = 20: half-width of mu -> inf");
    rc = rb_verify_aluminium_on_steel(1e-4);
    s = rb_verify_solve(v, &rc);
    rb_verify_relative(v, s->creepage, -rb_closed_bentall_johnson_slip(beta, a, R), 2e-3,
                       "Bentall-Johnson, mu = 1e-4: creepage of mu -> 0");
}

/* ---- All -------------------------------------------------------------------------- */

void rb_verify_contact(rb_verify *v)
{
    static const double ratios[] = {0.1, 0.4, 0.7, -0.7, 0.95, 1.5};
    static const double arcs[] = {0.01, 0.3, 0.8};
    static const double sticking[] = {0.2, 0.5, 0.9};
    static const double equal[] = {1e-3, 2e-3, 3e-3, 1e-3}, fitted[] = {3e-4, 2e-4, 1e-3, 1e-4};
    hertz(v, RB_MESH_UNIFORM, 240, "equal elements", equal);
    hertz(v, RB_MESH_FITTED, 100, "fitted elements", fitted);
    for (int k = 0; k < 3; k++) {
        /* A journal in its bearing, the gap of both circles, half-planes up to any arc. */
        const double part = arcs[k];
        rb_rolling_case rc = rb_verify_uncoupled();
        rc.gap = RB_GAP_EXACT;
        rb_verify_on_same(&rc);
        rc.b.radius = -1.02 * rc.a.radius;
        const double modulus = rc.a.young / 1.5, a = part * rc.a.radius;
        rc.half_width = NAN;
        rc.load = rb_closed_circle_load(a, rc.a.radius, modulus) +
                  rb_closed_circle_load(a, rc.b.radius, modulus);
        const rb_rolling_solution *s = rb_verify_solve(v, &rc);
        rb_verify_relative(v, s->half_width, a, 2e-4,
                           "journal in a bore 2 %% wider, a/R = %g: half-width", part);
    }
    for (size_t k = 0; k < sizeof ratios / sizeof ratios[0]; k++) {
        const double ratio = ratios[k];
        const rb_rolling_case rc = rolling_at(ratio);
        const rb_rolling_solution *s = rb_verify_solve(v, &rc);
        const double a = rc.half_width, P = s->normal_load;
        const curve c = {rc.mu, rb_closed_hertz_max_pressure(P, a), a, ratio};
        rb_verify_absolute(v, s->force_ratio, rb_closed_carter_force_ratio(ratio), 5e-4,
                           "Carter, s = %g: Q/(mu P)", ratio);
        if (fabs(ratio) < 1.0)
            rb_verify_absolute(v, s->stick_from / a, 1.0 - 2.0 * (1.0 - fabs(ratio)), 0.04,
                               "Carter, s = %g: start of stick / a", ratio);
        rb_verify_absolute(v, rms_error(s, s->q, rc.mu * c.p0, carter_at, &c), 0.0, 1e-2,
                           "Carter, s = %g: rms of q / (mu p0)", ratio);
    }
    carter_on(v, RB_BEM_ARC, "arc");
    carter_on(v, RB_BEM_HUB, "hub");
    two_forms(v);
    bulk_stress(v);
    tilted(v);
    square_punch(v);
    sliding(v);
    ellipse(v);
    wave(v);
    rb_rolling_case rc = rb_verify_uncoupled();
    rc.force_ratio = 0.64;
    const rb_rolling_solution *s = rb_verify_solve(v, &rc);
    rb_verify_relative(v, s->force_ratio, 0.64, 1e-9, "Cattaneo-Mindlin: Q/(mu P) as asked");
    rb_verify_absolute(v, (s->stick_to - s->stick_from) / (2.0 * rc.half_width),
                       rb_closed_cattaneo_stick(0.64), 0.02,
                       "Cattaneo-Mindlin, Q = %g mu P: stick half-width / a", 0.64);
    for (size_t k = 0; k < sizeof sticking / sizeof *sticking; k++)
        spence(v, sticking[k]);
    bentall_johnson(v);
    thin_discs(v);
}
