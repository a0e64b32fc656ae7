/* What follows from the numbers of a case by formulas: radius, modulus, Dundurs' constants,
 * half-width, load and pressure of Hertz's contact and of its kin (4.4, 4.5). */
#include "rolling/body/internal.h"
#include "rolling/body/mesh.h"
#include "rolling/case/internal.h"

#include <gsl/gsl_math.h>

/* (1 - nu^2)/E, in plane stress 1/E: what a half-plane adds to 1/E*. */
static double compliance(rb_bem_material m)
{
    return (1.0 - m.poisson) / (2.0 * m.shear);
}

/* c of kernels (Flamant): the coupling compliance of a half-plane. */
static double coupling(rb_bem_material m)
{
    return (1.0 - 2.0 * m.poisson) / (4.0 * m.shear);
}

/* Solves a^2/(4R) (2 ln(4R/a) - 1) = delta for a, the compression of a half-cylinder
 * (theory-solvers.md 6).  Newton's method starts where the contact is never wider: at the overlap
 * of the rigid shapes, or at 0.7 R.  It ends at rounding, because the width of the
 * automatic zone, and with it every result, follows from a. */
static double half_width_of_approach(double radius, double approach)
{
    enum { ROUNDS = 60 };
    double a = fmin(sqrt(2.0 * radius * approach), 0.7 * radius);

    for (int k = 0; k < ROUNDS; k++) {
        const double l = log(4.0 * radius / a);
        const double excess = a * a / (4.0 * radius) * (2.0 * l - 1.0) - approach;
        if (k == 0 && excess < 0.0)
            return a;
        const double step = excess / (a / radius * (l - 1.0));
        a -= step;
        if (fabs(step) <= 1e-15 * a)
            break;
    }
    return a;
}

static double modulus(const rb_rolling_case *rc)
{
    return 1.0 / (compliance(rb_rolling_material(rc, &rc->a)) +
                  (rc->elastic_b ? compliance(rb_rolling_material(rc, &rc->b)) : 0.0));
}

/* In a bore the difference of the radii, not that of their inverses, which may agree in
 * most of their digits. */
double rb_rolling_radius(const rb_rolling_case *rc)
{
    const double a = rc->a.radius, b = rc->b.radius;
    if (rc->ellipse.radius > 0.0)
        return rc->ellipse.radius;
    if (rc->gap == RB_GAP_WAVE) /* of the crest */
        return gsl_pow_2(rc->period / (2.0 * M_PI)) / rc->amplitude;
    return b < 0.0 && isfinite(b) && isfinite(a) ? a * b / (a + b) : 1.0 / (1.0 / a + 1.0 / b);
}

int rb_rolling_has_radius(const rb_rolling_case *rc)
{
    return isfinite(rb_rolling_radius(rc));
}

static double thickness_of(const rb_rolling_body *body, const char **what)
{
    const int layer = body->layer > 0.0, cover = body->cover > 0.0;

    *what = layer ? "layer" : cover ? "cover" : "rim";
    return layer                         ? rb_rolling_layers_depth(body)
           : cover                       ? body->cover
           : body->support == RB_BEM_HUB ? (1.0 - body->hub_ratio) * body->radius
                                         : INFINITY;
}

void rb_rolling_strains(const rb_rolling_case *rc, double approach, double pressure,
                        double strain[4])
{
    const rb_rolling_body *const bodies[] = {&rc->a, &rc->b};

    for (int b = 0; b < 2; b++) {
        const char *what;
        const double thickness = thickness_of(bodies[b], &what);
        double slow = 1.0;
        strain[2 * b] = strain[2 * b + 1] = NAN;
        if (isinf(thickness) || (b == 1 && !rc->elastic_b))
            continue;
        for (int k = 0; k < bodies[b]->memory.n; k++)
            slow += bodies[b]->memory.ratio[k];
        strain[2 * b] =
            approach * compliance(rb_rolling_material(rc, bodies[b])) * modulus(rc) / thickness;
        const rb_bem_stack *stack = bodies[b]->stack;
        double softness = stack ? 0.0 : slow / bodies[b]->young; /* the mean of all layers */
        for (int k = 0; stack && k < stack->n; k++)
            softness += stack->thickness[k] / (stack->young[k] * thickness);
        strain[2 * b + 1] = 2.0 * pressure * softness;
    }
}

double rb_rolling_strain(const rb_rolling_case *rc, double approach, double pressure,
                         const char **what)
{
    double all[4], most = NAN;

    rb_rolling_strains(rc, approach, pressure, all);
    for (int b = 0; b < 2; b++) {
        const double strain = fmin(all[2 * b], all[2 * b + 1]);
        const char *of_body;
        if (isnan(strain) || strain <= most)
            continue;
        most = strain;
        thickness_of(b ? &rc->b : &rc->a, &of_body);
        if (what)
            *what = of_body;
    }
    return most;
}

int rb_rolling_has_thickness(const rb_rolling_case *rc)
{
    return !isnan(rb_rolling_strain(rc, 0.0, 0.0, NULL));
}

double rb_rolling_larger_radius(const rb_rolling_case *rc)
{
    return fmax(rc->a.radius, isfinite(rc->b.radius) ? fabs(rc->b.radius) : 0.0);
}

double rb_rolling_hertz_half_width(const rb_rolling_case *rc, double load)
{
    return sqrt(4.0 * load * rb_rolling_radius(rc) / (M_PI * modulus(rc)));
}

double rb_rolling_hertz_load(const rb_rolling_case *rc, double half_width)
{
    return M_PI * modulus(rc) * gsl_pow_2(half_width) / (4.0 * rb_rolling_radius(rc));
}

double rb_rolling_pressure_load(const rb_rolling_case *rc)
{
    enum { ROUNDS = 60 };
    const double p = rc->max_pressure;
    if (rb_rolling_has_radius(rc))
        return M_PI * rb_rolling_radius(rc) * gsl_pow_2(p) / modulus(rc);
    double load = p; /* 2P/(pi a) = p, a that of the load */
    for (int k = 0; k < ROUNDS; k++)
        load = 0.5 * M_PI * p * rb_rolling_contact_half_width(rc, load);
    return load;
}

/* What terms of relaxation add to the compliance of a body under a contact of half-width a that
 * rolls steadily, as a part of the glassy one (A1): the whole of f_k where it rolls slowly, nothing
 * where it passes before anything relaxes. */
static double relaxed_part(const rb_rolling_case *rc, const rb_rolling_memory *memory, double a)
{
    double all = 0.0, sum = 0.0;

    for (int k = 0; k < memory->n; k++)
        all += memory->ratio[k];
    for (int k = 0; k < memory->n; k++) {
        const double z = rc->speed * memory->time[k] / a;
        sum += memory->ratio[k] / (1.0 + z + 1.15 * z * z / pow(1.0 + all, 0.6));
    }
    return sum;
}

/* Half of where a table without a radius is no higher than 2P/(pi E*) above its lowest place, as
 * Hertz's gap at the edge of the contact.  NAN: there is no table. */
static double half_of_low_part(const rb_rolling_case *rc, double load)
{
    const double *x;
    if (!rc->profile) /* which is refused */
        return NAN;
    const int rows = rb_rolling_profile_rows(rc->profile, &x);
    int lowest = 0, first, last;

    for (int i = 1; i < rows; i++)
        if (rb_rolling_profile_gap(rc->profile, x[i]) <
            rb_rolling_profile_gap(rc->profile, x[lowest]))
            lowest = i;
    const double level =
        rb_rolling_profile_gap(rc->profile, x[lowest]) + 2.0 * load / (M_PI * modulus(rc));
    for (first = lowest; first > 0 && rb_rolling_profile_gap(rc->profile, x[first - 1]) <= level;)
        first--;
    for (last = lowest;
         last + 1 < rows && rb_rolling_profile_gap(rc->profile, x[last + 1]) <= level;)
        last++;
    /* between two rows by the chord */
    double from = x[first], to = x[last];
    if (first > 0) {
        const double low = rb_rolling_profile_gap(rc->profile, x[first]),
                     high = rb_rolling_profile_gap(rc->profile, x[first - 1]);
        from -= (x[first] - x[first - 1]) * (level - low) / (high - low);
    }
    if (last + 1 < rows) {
        const double low = rb_rolling_profile_gap(rc->profile, x[last]),
                     high = rb_rolling_profile_gap(rc->profile, x[last + 1]);
        to += (x[last + 1] - x[last]) * (level - low) / (high - low);
    }
    return 0.5 * (to - from);
}

/* (P1) Westergaard's, of a wave. */
static double half_width_on_wave(const rb_rolling_case *rc, double load)
{
    const double flattens = M_PI * modulus(rc) * rc->amplitude; /* load per period */
    return rc->period / M_PI * asin(sqrt(fmin(1.0, load / flattens)));
}

static double half_width_alone(const rb_rolling_case *rc, double load)
{
    enum { ROUNDS = 100 };
    const int relaxes = rc->formulation != RB_STATIC && rb_rolling_relaxes(rc);
    const double soft = 1.5 * rb_rolling_radius(rc) * rc->interlayer_normal * load;

    if (!rb_rolling_has_radius(rc))
        return half_of_low_part(rc, load);
    const double hertz = rb_rolling_hertz_half_width(rc, load);
    if ((!(soft > 0.0) && !relaxes) || !(hertz > 0.0))
        return hertz;
    /* a^3 = A(a) a + B, with the pressure of A flatter the more B gives way: the right side grows
     * like a at most, so that iterates come nearer by a third or more. */
    const double rigid = modulus(rc) * compliance(rb_rolling_material(rc, &rc->a)),
                 other = 1.0 - rigid;
    double a = fmax(hertz, cbrt(soft));
    for (int k = 0; k < ROUNDS; k++) {
        const double relaxed = relaxes ? rigid * relaxed_part(rc, &rc->a.memory, a) +
                                             other * relaxed_part(rc, &rc->b.memory, a)
                                       : 0.0;
        const double flatter = soft > 0.0 ? 1.0 + 0.13 * pow(soft / (a * a * a), 0.4) : 1.0;
        const double next = cbrt(hertz * hertz * (1.0 + relaxed) * a * flatter + soft);
        const double step = next - a;
        a = next;
        if (fabs(step) <= 1e-15 * a)
            break;
    }
    return a;
}

/* A contact is no longer than its period. */
static double within_period(const rb_rolling_case *rc, double half_width)
{
    return rc->period > 0.0 ? fmin(half_width, 0.5 * rc->period) : half_width;
}

double rb_rolling_contact_half_width(const rb_rolling_case *rc, double load)
{
    return rc->gap == RB_GAP_WAVE && rc->interlayer_normal == 0.0
               ? half_width_on_wave(rc, load)
               : within_period(rc, half_width_alone(rc, load));
}

rb_rolling_derived rb_rolling_derive(const rb_rolling_case *rc)
{
    const rb_rolling_body *a = &rc->a;
    rb_rolling_derived d = {.radius = rb_rolling_radius(rc), .modulus = modulus(rc)};
    const int has_radius = rb_rolling_has_radius(rc);

    d.dundurs = (coupling(rb_rolling_material(rc, a)) -
                 (rc->elastic_b ? coupling(rb_rolling_material(rc, &rc->b)) : 0.0)) *
                d.modulus;
    d.load = rb_rolling_has_ellipse(rc) ? M_PI_2 * rc->ellipse.a * rc->ellipse.pressure
             : !isnan(rc->half_width)   ? rb_rolling_hertz_load(rc, rc->half_width)
             : isnan(rc->max_pressure)  ? rc->load
             : isnan(rc->pressed_by)    ? rb_rolling_pressure_load(rc)
                                        : rc->pressed_by;
    if (!isnan(d.load)) {
        d.approach = NAN;
        d.half_width = rb_rolling_contact_half_width(rc, d.load);
    } else {
        d.approach = isnan(rc->approach) ? a->radius / 2.0 : rc->approach;
    }
    /* in a history the bodies may be apart */
    const double down = fmax(0.0, d.approach);
    if (isnan(d.load))
        /* 2P/(pi E*) of the load that flattens the lower half of the approach */
        d.half_width =
            within_period(rc, has_radius ? half_width_of_approach(d.radius, down)
                                         : half_of_low_part(rc, 0.25 * M_PI * d.modulus * down));
    const int hertz = has_radius && !(rc->interlayer_normal > 0.0) && rc->period == 0.0 &&
                      !(rc->formulation != RB_STATIC && rb_rolling_relaxes(rc));
    const double P = isnan(d.load) ? 0.25 * M_PI * d.modulus * down : d.load;
    d.stress = P == 0.0 ? 0.0
               : hertz || (isnan(d.load) && has_radius)
                   ? d.modulus * d.half_width / (2.0 * d.radius)
                   : 2.0 * P / (M_PI * d.half_width);
    /* what lies between the bodies bears no more where nothing else gives way */
    if (isnan(d.load) && rc->interlayer_normal > 0.0)
        d.stress = fmin(d.stress, down / rc->interlayer_normal);
    d.strain = has_radius ? d.half_width / d.radius : 2.0 * d.stress / d.modulus;
    return d;
}

double rb_rolling_zone_half_width(const rb_rolling_case *rc, double load)
{
    const rb_rolling_derived d = rb_rolling_derive(rc);
    const double P = isnan(load) ? d.load : load;

    if (!rb_rolling_has_radius(rc))
        return isnan(P) ? d.half_width : rb_rolling_contact_half_width(rc, P);
    const double hertz = isnan(P) ? d.half_width : rb_rolling_hertz_half_width(rc, P),
                 soft = isnan(P) ? sqrt(2.0 * d.radius * d.approach)
                                 : cbrt(1.5 * d.radius * rc->interlayer_normal * P);
    return rc->interlayer_normal > 0.0 ? fmax(hertz, soft) : hertz;
}

int rb_rolling_pressing_is_given(const rb_rolling_case *rc)
{
    return !isnan(rc->load) || !isnan(rc->approach) || !isnan(rc->half_width) ||
           !isnan(rc->max_pressure) || rb_rolling_has_ellipse(rc);
}

void rb_rolling_press_by_load(rb_rolling_case *rc)
{
    rc->half_width = rc->max_pressure = rc->pressed_by = rc->wheel_load = NAN;
    rc->transverse_radius = rc->transverse_radius_b = INFINITY;
    rc->strips = 0;
}

int rb_rolling_is_strained(const rb_rolling_case *rc)
{
    return rc->bulk_stress != 0.0 || rc->bulk_stress_b != 0.0;
}

/* The strain of A, and that of B, by its bulk stress. */
static void bulk_strains(const rb_rolling_case *rc, double strain[2])
{
    const int any = rb_rolling_is_strained(rc);
    strain[0] = any ? rc->bulk_stress * compliance(rb_rolling_material(rc, &rc->a)) : 0.0;
    strain[1] = any && rc->elastic_b
                    ? rc->bulk_stress_b * compliance(rb_rolling_material(rc, &rc->b))
                    : 0.0;
}

double rb_rolling_bulk_strain(const rb_rolling_case *rc)
{
    double strain[2];
    bulk_strains(rc, strain);
    return strain[0] - strain[1];
}

double rb_rolling_largest_bulk_strain(const rb_rolling_case *rc)
{
    double strain[2];
    bulk_strains(rc, strain);
    return fmax(fabs(strain[0]), fabs(strain[1]));
}

int rb_rolling_has_ellipse(const rb_rolling_case *rc)
{
    return !isnan(rc->wheel_load);
}

int rb_rolling_has_heat(const rb_rolling_case *rc)
{
    return rc->heat_a.conductivity > 0.0;
}

int rb_rolling_is_tilted(const rb_rolling_case *rc)
{
    return rc->tilt != 0.0 || !isnan(rc->moment);
}

double rb_rolling_tilt(const rb_rolling_case *rc)
{
    return isnan(rc->moment) ? rc->tilt : isnan(rc->tilted_by) ? 0.0 : rc->tilted_by;
}

double rb_rolling_mu_beta(const rb_rolling_case *rc)
{
    return rb_rolling_largest_mu(rc) * fabs(rb_rolling_derive(rc).dundurs);
}

int rb_rolling_force_is_given(const rb_rolling_case *rc)
{
    return !isnan(rc->force) || !isnan(rc->force_ratio) || rc->free_axle;
}

/* The page has none: its rule of the Makefile says 0. */
#ifndef RB_TRANSFORMS
#define RB_TRANSFORMS 1
#endif

/* Beside a wheel, a half-plane of one elastic material only. */
static int is_transformed(const rb_rolling_case *rc, const rb_rolling_body *body)
{
    const rb_rolling_body_kind *kind = rb_rolling_kind_of(body);
    return kind->transforms &&
           (kind->transformed
                ? kind->transformed(rc, body)
                : rb_rolling_can(rc, RB_BODY_FLAT) ||
                      rb_rolling_body_can(body, RB_BODY_HOMOGENEOUS | RB_BODY_ELASTIC));
}

/* Elements of any lengths, rolling steadily.
 * From mu beta = 1 on many steps of Newton fail, and those of Lemke want a matrix. */
static int suits_fitted_products(const rb_rolling_case *rc)
{
    return rc->formulation == RB_STEADY && rc->slip_operator == RB_SLIP_UPSTREAM &&
           rc->yield_stress == 0.0 && rb_rolling_mu_beta(rc) < 1.0;
}

static int suits_transforms(const rb_rolling_case *rc)
{
    return (rc->contact.solver == RB_SOLVER_AUTO || rc->contact.solver == RB_SOLVER_NEWTON) &&
           (!rb_rolling_mesh_is_graded(rc) || suits_fitted_products(rc)) &&
           is_transformed(rc, &rc->a) && (!rc->elastic_b || is_transformed(rc, &rc->b)) &&
           !(rc->period > 0.0 && (rc->a.layer > 0.0 || (rc->elastic_b && rc->b.layer > 0.0)));
}

int rb_rolling_has_transforms(const rb_rolling_case *rc)
{
    return RB_TRANSFORMS && !rb_rolling_mesh_is_graded(rc) && suits_transforms(rc);
}

int rb_rolling_suits_large(const rb_rolling_case *rc, const rb_rolling_mesh *mesh)
{
    const int least = rc->mesh == RB_MESH_FITTED     ? RB_ROLLING_TRANSFORMS_FITTED
                      : rc->formulation != RB_STEADY ? RB_ROLLING_TRANSFORMS_STEPS
                      : rc->mesh == RB_MESH_ALIGNED  ? RB_ROLLING_TRANSFORMS_ALIGNED
                                                     : RB_ROLLING_TRANSFORMS;

    return mesh->n >= least && suits_transforms(rc);
}

int rb_rolling_is_large(const rb_rolling_case *rc, const rb_rolling_mesh *mesh)
{
    return RB_TRANSFORMS && rb_rolling_suits_large(rc, mesh);
}

/* 1: the bodies answer alike to the same tractions, but for a rigid displacement. */
static int are_alike(const rb_rolling_body *a, const rb_rolling_body *b)
{
    int alike = a->support == b->support && a->young == b->young && a->poisson == b->poisson &&
                a->layer == b->layer && a->stack == b->stack && a->cover == b->cover &&
                a->memory.n == b->memory.n;

    if (a->layer > 0.0)
        alike &= a->base_young == b->base_young && a->base_poisson == b->base_poisson &&
                 a->layer_base == b->layer_base;
    if (a->cover > 0.0)
        alike &= a->core_young == b->core_young && a->core_poisson == b->core_poisson;
    if (a->support != RB_BEM_HALFPLANE)
        alike &= a->radius == b->radius && a->arc == b->arc && a->hub_ratio == b->hub_ratio;
    for (int k = 0; alike && k < a->memory.n; k++)
        alike = a->memory.time[k] == b->memory.time[k] && a->memory.ratio[k] == b->memory.ratio[k];
    return alike;
}

int rb_rolling_couples(const rb_rolling_case *rc)
{
    return rb_rolling_can(rc, RB_BODY_FLAT | RB_BODY_HOMOGENEOUS)
               ? fabs(rb_rolling_derive(rc).dundurs) > 1e-9
               : !rc->elastic_b || !are_alike(&rc->a, &rc->b);
}

int rb_rolling_carter_holds(const rb_rolling_case *rc)
{
    return rc->formulation == RB_STEADY && rb_rolling_largest_mu(rc) > 0.0 &&
           rc->friction.law == RB_FRICTION_constant && !rb_rolling_law_depends_on_state(rc) &&
           rc->interlayer_normal == 0.0 && rc->interlayer_tangential == 0.0 &&
           rc->yield_stress == 0.0 && rb_rolling_can(rc, RB_BODY_FLAT | RB_BODY_HOMOGENEOUS) &&
           rc->gap != RB_GAP_TABLE && rc->worn.n == 0 && !rb_rolling_is_strained(rc) &&
           !rb_rolling_couples(rc);
}

rb_rolling_plan rb_rolling_plan_of(const rb_rolling_case *rc)
{
    return (rb_rolling_plan){rc->contact_elements, rc->near_field, rc->outer_elements,
                             rc->outer_refinement, NULL,           INFINITY};
}

int rb_rolling_has_fine_boundary(const rb_rolling_plan *plan)
{
    return plan->outer_refinement > 1.0 || plan->outer_elements >= RB_ROLLING_FINE_BOUNDARY_FROM;
}

void rb_rolling_coarsen_boundary(rb_rolling_plan *plan)
{
    plan->outer_elements = 0;
    plan->outer_refinement = 0.0;
}
