/* A case: its defaults, and which numbers go together. */
#include "rolling/body/internal.h"
#include "rolling/body/mesh.h"
#include "rolling/case/check.h"
#include "rolling/case/internal.h"
#include "rolling/solve/law.h"

#include <gsl/gsl_math.h>

/* The case of *Addi* (theory.md 7): what the paper leaves open has the values stated there. NAN:
 * not given. */
rb_rolling_case rb_rolling_case_defaults(void)
{
    const rb_rolling_body body = {.young = 94500.0,
                                  .poisson = 0.1,
                                  .radius = 50.0,
                                  .support = RB_BEM_ARC,
                                  .arc = 30.0,
                                  .hub_ratio = 0.3,
                                  .base_poisson = 0.1,
                                  .core_poisson = 0.1};
    rb_rolling_case rc = {.a = body,
                          .b = body,
                          .gap = RB_GAP_EXACT,
                          .mu = 0.3,
                          .approach = NAN,
                          .load = NAN,
                          .half_width = NAN,
                          .max_pressure = NAN,
                          .pressed_by = NAN,
                          .wheel_load = NAN,
                          .transverse_radius = INFINITY,
                          .transverse_radius_b = INFINITY,
                          .moment = NAN,
                          .tilted_by = NAN,
                          .shift = NAN,
                          .creep = NAN,
                          .creep_ratio = NAN,
                          .force = NAN,
                          .force_ratio = NAN,
                          .formulation = RB_STATIC,
                          .mesh = RB_MESH_UNIFORM,
                          .contact_elements = 60,
                          .normals = RB_BEM_NORMALS_OBSTACLE,
                          .contact = rb_contact_defaults()};

    rc.b.radius = INFINITY;
    rc.b.support = RB_BEM_HALFPLANE;
    return rc;
}

/* ---- Checks ------------------------------------------------------------------------ */

rb_status rb_rolling_check_size(const char *what, double value, rb_message *why)
{
    static const double least = 1e-100, most = 1e100;
    const double size = fabs(value);

    if (size > 0.0 && isfinite(size) && (size < least || size > most))
        return rb_refuse(why, what, "expected a size of %g to %g, got %g", least, most, value);
    return RB_OK;
}

/* Steady rolling averages over what a particle has passed, which must be alike everywhere
 * for that.  Step by step a body has one compliance, so that nothing may be under it that
 * does not relax. */
static rb_status check_relaxing_body(const rb_rolling_case *rc, const rb_rolling_body *body,
                                     rb_message *why)
{
    const int steps = rc->formulation != RB_STEADY;

    if (body->memory.n == 0)
        return RB_OK;
    if (rc->formulation == RB_STEADY && !rb_rolling_body_can(body, RB_BODY_TURNS))
        return rb_refuse(why, "relaxation-time,relaxation-time-b",
                         "steady rolling of a viscoelastic wheel needs whole turns, and a "
                         "clamped arc cannot turn; expected --support hub or halfplane");
    if (rc->formulation == RB_TRANSIENT && !rb_rolling_can(rc, RB_BODY_FLAT))
        return rb_refuse(why, "relaxation-time,relaxation-time-b",
                         "in transient rolling for the support halfplane only, "
                         "because the state of a wheel or cover extends over its whole "
                         "circumference; use --formulation steady");
    if (steps &&
        ((body->layer > 0.0 && body->base_young > 0.0) || rb_rolling_has_elastic_core(body)))
        return rb_refuse(why, "relaxation-time,relaxation-time-b",
                         "in a computation with steps the base or core of a "
                         "viscoelastic body must be rigid, got an elastic one");
    return RB_OK;
}

static rb_status check_memory(const rb_rolling_case *rc, rb_message *why)
{
    const rb_rolling_memory *const memory[2] = {&rc->a.memory, &rc->b.memory};
    rb_status s;
    int terms = 0;

    /* The terms of (V1) of each body that is elastic. */
    for (int b = 0; b < 1 + rc->elastic_b; b++) {
        if (memory[b]->n < 0 || memory[b]->n > RB_ROLLING_TERMS)
            return rb_refuse(why, "relaxation-time,relaxation-time-b",
                             "expected 0 ... %d terms, got %d", RB_ROLLING_TERMS, memory[b]->n);
        for (int k = 0; k < memory[b]->n; k++) {
            s = rb_rolling_check_number(b ? "relaxation-time-b" : "relaxation-time",
                                        memory[b]->time[k], why);
            if (s == RB_OK)
                s = rb_rolling_check_number(b ? "relaxation-ratio-b" : "relaxation-ratio",
                                            memory[b]->ratio[k], why);
            if (s == RB_OK)
                s = rb_rolling_check_size(b ? "relaxation-time-b" : "relaxation-time",
                                          memory[b]->time[k], why);
            if (s != RB_OK)
                return s;
        }
        terms += memory[b]->n;
    }
    s = check_relaxing_body(rc, &rc->a, why);
    if (s == RB_OK && rc->elastic_b)
        s = check_relaxing_body(rc, &rc->b, why);
    if (s != RB_OK || terms == 0)
        return s;
    if (rc->formulation != RB_STATIC && rc->speed == 0.0)
        return rb_refuse(why, "relaxation-time,relaxation-time-b",
                         "needs the speed of rolling, add --speed");
    if (rc->formulation != RB_STEADY &&
        (rc->gap == RB_GAP_TABLE || rc->irregularity.n > 0 || rc->worn.n > 0))
        return rb_refuse(why, "relaxation-time,relaxation-time-b",
                         "a computation with steps needs a parabola or circle "
                         "as gap, got a table");
    return RB_OK;
}

/* Friction heats what rolls; steps follow it where both bodies start equally warm. */
static rb_status check_heat(const rb_rolling_case *rc, rb_message *why)
{
    enum { MOST = 100000, MOST_UNLIKE = 4000 };
    const rb_rolling_heat *a = &rc->heat_a, *b = &rc->heat_b;

    if (a->conductivity == 0.0)
        return RB_OK;
    if (a->heat_capacity == 0.0 || (b->conductivity > 0.0 && b->heat_capacity == 0.0))
        return rb_refuse(why, "conductivity,conductivity-b",
                         "needs the heat capacity, add --heat-capacity");
    if (rc->formulation == RB_STATIC)
        return rb_refuse(why, "conductivity,conductivity-b",
                         "friction heats bodies that roll, add --formulation "
                         "steady or transient");
    if (rc->speed == 0.0)
        return rb_refuse(why, "conductivity,conductivity-b",
                         "needs the speed of rolling, add --speed");
    /* A layer or a cover. */
    if (!rb_rolling_can(rc, RB_BODY_HOMOGENEOUS))
        return rb_refuse(
            why, "conductivity,conductivity-b", "it needs homogeneous elastic bodies; %s",
            (rc->a.layer > 0.0 || rc->a.cover > 0.0 ||
             (rc->elastic_b && (rc->b.layer > 0.0 || rc->b.cover > 0.0)))
                ? "the flash temperature is computed for homogeneous bodies only, and a "
                  "layer or cover conducts differently"
                : "a viscoelastic body is also heated inside, which is not computed");
    if (rc->formulation == RB_TRANSIENT && a->temperature != b->temperature)
        return rb_refuse(why, "temperature-b,temperature",
                         "in transient rolling both bodies must have the "
                         "same temperature");
    /* Equal bodies share the heat equally; others need a full matrix in the contact (T2). */
    const int unlike = b->conductivity > 0.0 &&
                       (a->conductivity != b->conductivity ||
                        a->heat_capacity != b->heat_capacity || a->temperature != b->temperature);
    const int most = unlike ? MOST_UNLIKE : MOST;
    if (rc->contact_elements > most)
        return rb_refuse(why, "conductivity,conductivity-b",
                         "expected at most %d contact elements%s, got %d", most,
                         unlike ? " of bodies that conduct differently" : "", rc->contact_elements);
    return RB_OK;
}

static int count_given(int n, const double *value)
{
    int given = 0;
    for (int i = 0; i < n; i++)
        given += !isnan(value[i]);
    return given;
}

static rb_status check_normal(const rb_rolling_case *rc, rb_message *why)
{
    const double normal[] = {rc->approach, rc->load, rc->half_width, rc->max_pressure,
                             rc->wheel_load};

    if (count_given(5, normal) > 1)
        return rb_fail(
            why, RB_EINVAL,
            "approach, load, half-width, max-pressure and wheel-load exclude each other");
    /* A half-width is one of Hertz's parabola, which no circle has beyond its radius. */
    const double reach = fmin(fabs(rc->a.radius), fabs(rc->b.radius));
    if (rc->half_width >= reach)
        return rb_refuse(why, "half-width",
                         "expected less than the radius of either body, %g mm, "
                         "got %g mm",
                         reach, rc->half_width);
    return RB_OK;
}

/* One tangential condition: a shift at rest, a creepage or a force in rolling. */
static rb_status check_tangential(const rb_rolling_case *rc, rb_message *why)
{
    const double all[] = {rc->shift, rc->creep, rc->creep_ratio, rc->force, rc->force_ratio};
    const double load[] = {rc->shift, rc->force, rc->force_ratio};

    if (!isnan(rc->creep) && !isnan(rc->creep_ratio))
        return rb_fail(why, RB_EINVAL, "creep and creep-ratio exclude each other");
    if (rb_rolling_largest_mu(rc) == 0.0 && !isnan(rc->creep_ratio))
        return rb_refuse(why, "creep-ratio", "xi R/(mu a) has no meaning at mu = 0");
    if (rc->formulation == RB_STATIC && count_given(3, load) > 1)
        return rb_fail(why, RB_EINVAL, "shift, force and force-ratio exclude each other");
    if (rc->formulation != RB_STATIC && !isnan(rc->shift))
        return rb_refuse(why, "shift",
                         "rolling is driven by creep, creep-ratio, force or force-ratio");
    if (rc->formulation != RB_STATIC && count_given(4, all + 1) > 1)
        return rb_fail(why, RB_EINVAL,
                       "creep, creep-ratio, force and force-ratio exclude each other");
    if (rc->free_axle && count_given(5, all) > 0)
        return rb_refuse(why, "free-axle",
                         "it excludes shift, creep, creep-ratio, force and "
                         "force-ratio");
    if (rc->free_axle && rc->formulation != RB_STEADY)
        return rb_refuse(why, "free-axle", "it needs steady rolling");
    if (rc->free_axle && rb_rolling_largest_mu(rc) == 0.0)
        return rb_refuse(why, "free-axle", "only friction turns it, expected mu > 0");
    if (rc->fretting && rc->formulation != RB_STATIC)
        return rb_refuse(why, "fretting",
                         "what rolls has no cycle that closes; take --formulation static");
    if (rc->fretting && rb_rolling_largest_mu(rc) == 0.0)
        return rb_refuse(why, "fretting", "without friction nothing frets; expected mu > 0");
    if (rc->fretting && rb_rolling_relaxes(rc))
        return rb_refuse(why, "fretting",
                         "it needs elastic bodies; leave out the relaxation times");
    /* Beyond full sliding there is no equilibrium; without friction no force but zero. */
    if (!isnan(rc->force_ratio) && fabs(rc->force_ratio) > 1.0)
        return rb_refuse(why, "force-ratio", "Q/(mu P) = %g: friction carries at most 1",
                         rc->force_ratio);
    if (!isnan(rc->force_ratio) && rb_rolling_largest_mu(rc) == 0.0 && rc->force_ratio != 0.0)
        return rb_refuse(why, "force-ratio", "%g: Q/(mu P) has no meaning at mu = 0",
                         rc->force_ratio);
    /* NAN where the load follows from the approach only after the solution. */
    const double P = rb_rolling_derive(rc).load, mu = rb_rolling_largest_mu(rc);
    /* a coefficient that differs from place to place or falls, or an interface that yields,
     * carries less: the solver knows */
    if (!isnan(rc->force) && !isnan(P) && !(rc->yield_stress > 0.0) &&
        rc->friction.law != RB_FRICTION_table && !rb_rolling_law_depends_on_state(rc) &&
        fabs(rc->force) > mu * P * (1.0 + 1e-12))
        return rb_refuse(why, "force", "Q = %.10g N/mm: friction carries at most mu P = %g N/mm",
                         rc->force, rb_largest_shown(mu * P));
    return RB_OK;
}

/* (Y1): Coulomb's law and the yield stress of the third body bound friction together. */
static rb_status check_interlayer(const rb_rolling_case *rc, rb_message *why)
{
    if (rc->hardening != 0.0 && rc->yield_stress == 0.0)
        return rb_refuse(why, "hardening", "only for an interface that yields, add --yield-stress");
    if (rc->yield_stress > 0.0 &&
        (rb_rolling_law_depends_on_slip(&rc->friction) || rc->friction.heat != 0.0))
        return rb_refuse(why, "yield-stress",
                         "with one coefficient of friction or a table over "
                         "x, not with a law that follows slip or heat: such a law does not "
                         "apply where the interface yields instead of sliding");
    if (rc->yield_stress > 0.0 && rc->contact.solver == RB_SOLVER_CONE)
        return rb_refuse(
            why, "solver,yield-stress",
            "%s solves Coulomb's law only, expected lemke, newton or auto with --yield-stress",
            rc->contact.cone_solver.name);
    return RB_OK;
}

/* What lies in a bore is smaller than it, or they touch at the ends first. */
static rb_status check_bore(const rb_rolling_case *rc, rb_message *why)
{
    if (!rc->elastic_b || rc->b.radius > 0.0 || rc->b.radius < -rc->a.radius)
        return RB_OK;
    return rb_refuse(why, "radius-b",
                     "a bore must be larger than body A; expected less "
                     "than -%g mm, got %g mm",
                     rc->a.radius, rc->b.radius);
}

/* Without a radius nothing is known of what refers to one. */
static rb_status check_gap(const rb_rolling_case *rc, rb_message *why)
{
    static const char no_radius[] =
        "the gap has no radius, because its table is no parabola where it is low; give --radius";

    if (rc->gap == RB_GAP_TABLE && !rc->profile)
        return rb_refuse(why, "gap", "expected a table, and none is given");
    if (rb_rolling_has_radius(rc))
        return RB_OK;
    if (rc->gap != RB_GAP_TABLE || !rb_rolling_can(rc, RB_BODY_FLAT))
        return rb_refuse(why, "radius",
                         "expected a finite one; only half-planes under a gap from a file "
                         "may have none");
    if (!rb_rolling_pressing_is_given(rc))
        return rb_refuse(why, "approach", "R/2 unless it is given, and %s, or --load", no_radius);
    if (!isnan(rc->half_width))
        return rb_refuse(why, "half-width", "Hertz's, and %s, or --load", no_radius);
    if (!isnan(rc->creep_ratio))
        return rb_refuse(why, "creep-ratio", "xi R/(mu a), and %s, or --creep", no_radius);
    if (rc->free_axle)
        return rb_refuse(why, "free-axle", "Q = -M/R, and %s", no_radius);
    return RB_OK;
}

/* The surface is smooth again where the points end; steady rolling sees nothing pass. */
static rb_status check_irregularity(const rb_rolling_case *rc, rb_message *why)
{
    const int n = rc->irregularity.n;

    if (n == 0)
        return RB_OK;
    if (rc->formulation == RB_STEADY)
        return rb_refuse(why, "irregularity",
                         "only for transient rolling, in which it moves "
                         "through the contact");
    const rb_status s =
        rb_rolling_points_check("irregularity", n, rc->irregularity.x, rc->irregularity.y, why);
    for (int i = 0; s == RB_OK && i < n; i += n - 1)
        if (rc->irregularity.y[i] != 0.0)
            return rb_refuse_row(why, "irregularity", i + 1, "expected gap 0 where it ends, got %g",
                                 rc->irregularity.y[i]);
    return s;
}

static rb_status check_worn(const rb_rolling_case *rc, rb_message *why)
{
    for (int i = 0; i < rc->worn.n; i++)
        if (!isfinite(rc->worn.x[i]) || !isfinite(rc->worn.y[i]) ||
            (i > 0 && !(rc->worn.x[i] > rc->worn.x[i - 1])))
            return rb_refuse_row(why, "worn", i + 1, "expected finite numbers, x increasing");
    return RB_OK;
}

static rb_status check_increments(const rb_rolling_case *rc, rb_message *why)
{
    if (rc->increments > 1 && rc->formulation == RB_STEADY)
        return rb_refuse(why, "increments",
                         "static contact and the start of a transient have increments; "
                         "steady rolling does not depend on its beginning");
    return RB_OK;
}

/* Nothing holds a layer on a smooth base along the surface (L9). */
static rb_status check_smooth_base(const rb_rolling_case *rc, rb_message *why)
{
    const char *name = rc->a.layer_base == RB_BASE_SMOOTH ? "layer-base" : "layer-base-b";

    if (!rb_rolling_slides_on_base(rc))
        return RB_OK;
    if (rc->formulation == RB_TRANSIENT || rb_rolling_has_steps(rc))
        return rb_refuse(why, name,
                         "smooth: it needs steady rolling, or bodies at rest in one step; "
                         "nothing holds the layer from step to step");
    if (rc->formulation == RB_STATIC && rb_rolling_largest_mu(rc) > 0.0 &&
        !rb_rolling_force_is_given(rc))
        return rb_refuse(why, name,
                         "smooth: a shift means nothing where no datum holds the layer; "
                         "give --force");
    return RB_OK;
}

static rb_status check_mesh(const rb_rolling_case *rc, rb_message *why)
{
    if (rc->slip_operator == RB_SLIP_SECOND && rc->formulation != RB_STEADY)
        return rb_refuse(why, "slip-operator", "second is only for steady rolling");
    if (rc->slip_operator == RB_SLIP_SECOND && rb_rolling_mesh_is_graded(rc))
        return rb_refuse(why, "slip-operator,mesh", "second is only for equal elements");
    if (rc->mesh == RB_MESH_ALIGNED && rc->contact_elements < 12)
        return rb_refuse(why, "contact-elements,mesh",
                         "expected 12 contact elements or more on the mesh aligned, got %d",
                         rc->contact_elements);
    if (rc->mesh == RB_MESH_PUNCH) {
        if (rc->formulation != RB_STATIC || rb_rolling_has_steps(rc))
            return rb_refuse(why, "mesh", "punch: it needs bodies at rest, in one step");
        if (rc->gap != RB_GAP_TABLE || !rb_rolling_can(rc, RB_BODY_FLAT))
            return rb_refuse(
                why, "mesh",
                "punch: it needs half-planes and a table of the punch; add --gap FILE");
        if (rc->zone > 0.0)
            return rb_refuse(why, "mesh,zone", "the punch is the zone; leave --zone out");
    }
    if (!(rc->outer_refinement >= 0.0 && rc->outer_refinement <= 1000.0))
        return rb_refuse(why, "outer-refinement", "expected 0 ... 1000, got %g",
                         rc->outer_refinement);
    if (rc->period == 0.0 && (rc->zone >= rc->a.radius || rc->zone >= fabs(rc->b.radius)))
        return rb_refuse(why, "zone", "%g mm is wider than the radius, %g mm", rc->zone,
                         fmin(rc->a.radius, fabs(rc->b.radius)));
    if (rc->period > 0.0 && rc->zone > 0.5 * rc->period * (1.0 + 1e-12))
        return rb_refuse(why, "zone", "%g mm is more than half the period, %g mm; leave it out",
                         rc->zone, 0.5 * rc->period);
    if (rc->normals == RB_BEM_NORMALS_SURFACE && rb_rolling_body_can(&rc->a, RB_BODY_FLAT))
        return rb_refuse(why, "normals", "surface: a half-plane has the obstacle's");
    if (rc->normals == RB_BEM_NORMALS_SURFACE && rc->elastic_b)
        return rb_refuse(why, "normals", "surface: with a rigid plane only");
    if (rc->contact.solver == RB_SOLVER_CONE && !rc->contact.cone_solver.solve)
        return rb_refuse(why, "solver",
                         "expected auto, lemke, newton or a cone solver, got '%.60s'",
                         rc->contact.cone_solver.name ? rc->contact.cone_solver.name : "");
    return RB_OK;
}

/* A stress that is uniform along the surface, and so is its strain: of what is flat, of one
 * material, and keeps no memory. */
static rb_status check_bulk(const rb_rolling_case *rc, rb_message *why)
{
    const double stress[2] = {rc->bulk_stress, rc->bulk_stress_b};

    if (rc->bulk_stress_b != 0.0 && !rc->elastic_b)
        return rb_refuse(why, "bulk-stress-b",
                         "a rigid body B is not strained; make it elastic (--similar, "
                         "--young-b)");
    for (int k = 0; k < 2; k++)
        if (stress[k] != 0.0 &&
            !rb_rolling_body_can(k ? &rc->b : &rc->a,
                                 RB_BODY_FLAT | RB_BODY_HOMOGENEOUS | RB_BODY_ELASTIC))
            return rb_refuse(
                why, k ? "bulk-stress-b" : "bulk-stress",
                "it needs half-planes of one elastic material (--support%s halfplane), "
                "without layer and relaxation",
                k ? "-b" : "");
    return RB_OK;
}

/* A wheel that rolls turns, and has no tilt; one that is held by its boundary elements has its
 * own. */
static rb_status check_tilt(const rb_rolling_case *rc, rb_message *why)
{
    const char *which = isnan(rc->moment) ? "tilt" : "moment";

    if (!rb_rolling_is_tilted(rc))
        return RB_OK;
    if (rc->tilt != 0.0 && !isnan(rc->moment))
        return rb_refuse(why, "tilt,moment", "excludes moment");
    if (rc->formulation != RB_STATIC)
        return rb_refuse(
            why, which,
            "it needs bodies at rest (--formulation static); what rolls turns, and its "
            "moment is the result resistance_moment");
    if (!rb_rolling_can(rc, RB_BODY_FLAT | RB_BODY_ELASTIC))
        return rb_refuse(why, which,
                         "it needs elastic half-planes (--support halfplane), without relaxation");
    return RB_OK;
}

static int has_rigid_base(const rb_rolling_body *body)
{
    return body->layer > 0.0 && body->base_young == 0.0;
}

/* The mean of a periodic pressure moves a half-plane as a whole; only a layer on a rigid base is
 * compressed by it (P1). */
int rb_rolling_mean_compresses(const rb_rolling_case *rc)
{
    return has_rigid_base(&rc->a) || (rc->elastic_b && has_rigid_base(&rc->b));
}

static int holds_friction(const rb_rolling_body *body)
{
    return has_rigid_base(body) && body->layer_base != RB_BASE_SMOOTH;
}

/* And only if that layer is bonded does the mean of the friction shear it. */
int rb_rolling_mean_shears(const rb_rolling_case *rc)
{
    return holds_friction(&rc->a) || (rc->elastic_b && holds_friction(&rc->b));
}

/* The mean of the undeformed gap over a period: the approach at which nothing stays open. */
static double mean_gap(const rb_rolling_case *rc)
{
    enum { POINTS = 4096 };
    double from, to, sum = 0.0;

    if (rc->gap != RB_GAP_TABLE)
        /* The means of D (1 - cos(2 pi x/L)) and of x^2/(2R) over |x| < L/2. */
        return rc->gap == RB_GAP_WAVE ? rc->amplitude
                                      : gsl_pow_2(rc->period) / (24.0 * rb_rolling_radius(rc));
    rb_rolling_profile_range(rc->profile, &from, &to);
    for (int k = 0; k < POINTS; k++)
        sum += rb_rolling_profile_gap(rc->profile, from + (k + 0.5) * (to - from) / POINTS);
    return sum / POINTS;
}

/* The ends of a period are one place. */
static rb_status check_closed(const rb_rolling_case *rc, rb_message *why)
{
    double from, to;

    if (rc->gap == RB_GAP_EXACT)
        return rb_refuse(why, "period",
                         "needs --gap parabola, wave, or a table that is one period long");
    if (rc->gap == RB_GAP_PARABOLA) {
        const double least = fmin(rc->a.radius, fabs(rc->b.radius));
        return 0.5 * rc->period <= 0.95 * least
                   ? RB_OK
                   : rb_refuse(why, "period",
                               "cylinders of the radius %g mm stand that close only up to "
                               "%g mm; got %g mm",
                               least, 1.9 * least, rc->period);
    }
    if (rc->gap == RB_GAP_WAVE)
        return RB_OK;
    rb_rolling_profile_range(rc->profile, &from, &to);
    if (fabs(to - from - rc->period) > 1e-6 * rc->period)
        return rb_refuse(why, "period",
                         "the table of the gap must be one period long, %g mm; it is %g mm",
                         rc->period, to - from);
    const double first = rb_rolling_profile_gap(rc->profile, from),
                 last = rb_rolling_profile_gap(rc->profile, to);
    return fabs(first - last) <= 1e-6 * fabs(mean_gap(rc)) + 1e-12 * rc->period
               ? RB_OK
               : rb_refuse(why, "period",
                           "the table of the gap must end as it begins, with %g mm; it ends "
                           "with %g mm",
                           first, last);
}

/* What belongs to one contact alone means nothing to many of them. */
static rb_status check_alone(const rb_rolling_case *rc, rb_message *why)
{
    const struct {
        int given;
        const char *what, *instead;
    } of_one[] = {
        {rc->a.datum > 0.0 || rc->b.datum > 0.0, rc->a.datum > 0.0 ? "datum" : "datum-b",
         "displacements are those from the mean line of the surface"},
        {!isnan(rc->half_width), "half-width", "Hertz's is that of one contact; give --load"},
        {rb_rolling_has_ellipse(rc), "wheel-load", "give --load"},
        {rb_rolling_is_tilted(rc), isnan(rc->moment) ? "tilt" : "moment",
         "neighbours hold the surface level"},
        {rb_rolling_is_strained(rc), rc->bulk_stress != 0.0 ? "bulk-stress" : "bulk-stress-b",
         "the mean strain of both bodies is the same"},
        {rc->irregularity.n > 0, "irregularity", "put it into a table of the gap"},
        {rc->worn.n > 0, "worn", "put it into a table of the gap"},
        {rc->mesh != RB_MESH_UNIFORM, "mesh", "equal elements only (--mesh uniform)"}};

    for (size_t k = 0; k < sizeof of_one / sizeof *of_one; k++)
        if (of_one[k].given)
            return rb_refuse(why, of_one[k].what, "not with a period: %s", of_one[k].instead);
    return RB_OK;
}

static rb_status check_wave(const rb_rolling_case *rc, rb_message *why)
{
    if (rc->gap != RB_GAP_WAVE)
        return rc->amplitude > 0.0 ? rb_refuse(why, "amplitude", "that of a wave, add --gap wave")
                                   : RB_OK;
    if (!(rc->period > 0.0) || !(rc->amplitude > 0.0))
        return rb_refuse(why, "gap,period,amplitude", "a wave needs --period and --amplitude");
    if (isfinite(rc->b.radius))
        return rb_refuse(why, "radius-b",
                         "a wave lies on a plane; a table of the gap knows other shapes");
    if (!rb_rolling_pressing_is_given(rc))
        return rb_refuse(why, "gap,period,amplitude",
                         "a wave needs --load, --approach or --max-pressure");
    return RB_OK;
}

/* (P1) */
static rb_status check_period(const rb_rolling_case *rc, rb_message *why)
{
    rb_status s = check_wave(rc, why);

    if (s != RB_OK || !(rc->period > 0.0))
        return s;
    if (rc->formulation != RB_STATIC)
        return rb_refuse(why, "period",
                         "it needs bodies at rest (--formulation static); what rolls over "
                         "waves is never steady");
    if (!rb_rolling_can(rc, RB_BODY_FLAT | RB_BODY_ELASTIC) || rc->a.stack ||
        (rc->elastic_b && rc->b.stack))
        return rb_refuse(why, "period",
                         "it needs half-planes of one elastic material, or one layer of it "
                         "(--support halfplane), without relaxation");
    for (int b = 0; b <= rc->elastic_b; b++) {
        const double layer = b ? rc->b.layer : rc->a.layer;
        if (layer > 0.0 && layer < 1e-3 * rc->period)
            return rb_refuse(why, b ? "layer-thickness-b" : "layer-thickness",
                             "with a period: a layer of a thousandth of it or more, got %g mm",
                             layer);
    }
    if (rc->gap == RB_GAP_TABLE && !rc->profile)
        return RB_OK; /* check_gap says so */
    s = check_alone(rc, why);
    if (s == RB_OK)
        s = check_closed(rc, why);
    const double approach = s == RB_OK ? rb_rolling_derive(rc).approach : NAN;
    /* which the mean pressure compresses */
    if (isnan(approach) || rc->interlayer_normal > 0.0 || rb_rolling_mean_compresses(rc))
        return s;
    const double most = mean_gap(rc);
    return approach < most ? RB_OK
                           : rb_refuse(why, "approach",
                                       "at %g mm, the mean of the gap, nothing is open, "
                                       "and only --load tells more; got %g mm",
                                       most, approach);
}

/* The strip through the middle of an ellipse. */
static rb_status check_ellipse(const rb_rolling_case *rc, rb_message *why)
{
    if (!rb_rolling_has_ellipse(rc) && rc->strips > 0)
        return rb_refuse(why, "strips",
                         "it needs an ellipse under a load of all of it; add --wheel-load");
    if (!rb_rolling_has_ellipse(rc))
        return isinf(rc->transverse_radius) && isinf(rc->transverse_radius_b)
                   ? RB_OK
                   : rb_refuse(why,
                               isinf(rc->transverse_radius) ? "transverse-radius-b"
                                                            : "transverse-radius",
                               "that of an ellipse under a load of all of it; give --wheel-load, "
                               "or leave it out");
    if (rc->strips > 0 && rc->formulation != RB_STEADY)
        return rb_refuse(why, "strips", "of an ellipse that rolls, add --formulation steady");
    if (!(rc->ellipse.radius > 0.0))
        return rb_refuse(why, "wheel-load", "its ellipse has not been found");
    if (rc->gap != RB_GAP_PARABOLA || rc->worn.n > 0)
        return rb_refuse(why, "wheel-load", "Hertz's ellipse needs --gap parabola, without wear");
    return rb_rolling_can(rc, RB_BODY_FLAT | RB_BODY_HOMOGENEOUS | RB_BODY_ELASTIC) &&
                   rc->plane == RB_PLANE_STRAIN && rc->interlayer_normal == 0.0
               ? RB_OK
               : rb_refuse(why, "wheel-load",
                           "Hertz's ellipse is that of half-planes of one elastic material "
                           "each in plane strain (--support halfplane), without normal interlayer");
}

/* 0 says that a number is not given. */
static rb_status check_sizes(const rb_rolling_case *rc, rb_message *why)
{
    const struct {
        const char *what;
        double value;
    } sizes[] = {{"young", rc->a.young},
                 {"radius", rc->a.radius},
                 {"datum", rc->a.datum},
                 {"layer-thickness", rc->a.layer},
                 {"base-young", rc->a.base_young},
                 {"core-young", rc->a.core_young},
                 {"young-b", rc->elastic_b ? rc->b.young : 1.0},
                 {"radius-b", rc->elastic_b ? rc->b.radius : INFINITY},
                 {"datum-b", rc->b.datum},
                 {"layer-thickness-b", rc->b.layer},
                 {"base-young-b", rc->b.base_young},
                 {"core-young-b", rc->b.core_young},
                 {"interlayer-normal", rc->interlayer_normal},
                 {"interlayer-tangential", rc->interlayer_tangential},
                 {"load", rc->load},
                 {"approach", rc->approach},
                 {"half-width", rc->half_width},
                 {"max-pressure", rc->max_pressure},
                 {"bulk-stress", rc->bulk_stress},
                 {"bulk-stress-b", rc->bulk_stress_b},
                 {"wheel-load", rc->wheel_load},
                 {"period", rc->period},
                 {"amplitude", rc->gap == RB_GAP_WAVE ? rc->amplitude : 1.0},
                 {"transverse-radius", rc->transverse_radius},
                 {"transverse-radius-b", rc->transverse_radius_b},
                 {"mu", rc->mu},
                 {"shift", rc->shift},
                 {"creep", rc->creep},
                 {"force", rc->force},
                 {"tilt", rc->tilt},
                 {"zone", rc->zone},
                 {"speed", rc->speed}};

    for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; k++) {
        const rb_status s = rb_rolling_check_size(sizes[k].what, sizes[k].value, why);
        if (s != RB_OK)
            return s;
    }
    return RB_OK;
}

/* Ranges first, then what each body needs, then what goes together; the order decides which of
 * several mistakes is named. */
rb_status rb_rolling_case_check(const rb_rolling_case *rc, rb_message *why)
{
    static rb_status (*const checks[])(const rb_rolling_case *, rb_message *) = {
        check_period,       check_memory,     check_heat,       rb_rolling_law_check,
        check_interlayer,   check_normal,     check_tangential, check_bore,
        check_gap,          check_bulk,       check_tilt,       check_ellipse,
        check_irregularity, check_worn,       check_increments, check_sizes,
        check_mesh,         check_smooth_base};
    const rb_rolling_case defaults = rb_rolling_case_defaults();
    rb_status s = rb_rolling_check_ranges(rc, &defaults, why);

    if (s == RB_OK)
        s = rb_rolling_body_check(rc, &rc->a, "", 0, why);
    if (s == RB_OK && rc->elastic_b)
        s = rb_rolling_body_check(rc, &rc->b, "-b", 1, why);
    for (size_t k = 0; k < sizeof checks / sizeof *checks && s == RB_OK; k++)
        s = checks[k](rc, why);
    return s;
}

int rb_rolling_has_steps(const rb_rolling_case *rc)
{
    return rc->formulation == RB_TRANSIENT || (rc->formulation == RB_STATIC && rc->increments > 1);
}
