/* Discretisation errors from coarser runs (theory-solvers.md 5.1). */
#include "base/sizes.h"
#include "rolling/body/body.h"
#include "rolling/body/mesh.h"
#include "rolling/case/check.h"
#include "rolling/case/internal.h"
#include "rolling/solve/patches.h"
#include "rolling/solve/resolution.h"
#include "rolling/solve/solution.h"
#include "rolling/stress/stress.h"
#include "rolling/solve/zone.h"
#include "rolling/study/internal.h"
#include "rolling/study/study.h"

#include <gsl/gsl_math.h>
#include <string.h>

/* Where --accuracy gives up: contact elements, and how much finer than usual the boundary
 * of a wheel is. */
enum { MOST_ELEMENTS = 6400, MOST_WITHOUT_MATRIX = 102400, MOST_ON_WHEELS = 1600 };
static const double finest_boundary = 32.0;

/* ---- The coarser runs -------------------------------------------------------------- */

/* The contact elements, with the steps of a transient, and the elements of the wheels
 * outside the contact are made coarser in turn: errors of different signs would cancel in
 * runs that make both coarser together. */
static const struct {
    double contact, boundary;
} part[RB_ERROR_MESHES] = {
    {0.5, 1.0}, {0.7, 1.0}, {1.0, 0.5}, [RB_ERROR_ANOTHER_RUN] = {0.85, 1.0}};

int rb_rolling_error_runs(const rb_rolling_case *rc)
{
    const int boundary = rb_rolling_body_can(&rc->a, RB_BODY_BOUNDARY) ||
                         (rc->elastic_b && rb_rolling_body_can(&rc->b, RB_BODY_BOUNDARY));
    return boundary ? 3 : 2;
}

rb_rolling_case rb_rolling_error_run(const rb_rolling_case *rc, int k)
{
    rb_rolling_case coarser = *rc;

    coarser.contact_elements = (int)(part[k].contact * rc->contact_elements);
    if (rc->steps > 0)
        coarser.steps = (int)ceil(part[k].contact * rc->steps);
    coarser.outer_refinement =
        part[k].boundary * (rc->outer_refinement > 0.0 ? rc->outer_refinement : 1.0);
    return coarser;
}

rb_status rb_rolling_error_check(const rb_rolling_case *rc, rb_message *why)
{
    if (rc->contact_elements < 12)
        return rb_refuse(why, "contact-elements,error,accuracy",
                         "error bars compare with half the elements: expected 12 contact elements "
                         "or more, got %d",
                         rc->contact_elements);
    if (rb_rolling_error_runs(rc) > 2 && rc->outer_elements > 0 && rc->outer_elements < 16)
        return rb_refuse(
            why, "outer-elements,error,accuracy",
            "error bars compare with half the elements: expected 16 outer elements or more, got %d",
            rc->outer_elements);
    return RB_OK;
}

/* ---- From their values to a bar ---------------------------------------------------- */

/* Whether the meshes go to and fro, as the edges pass elements: finer ones have not come nearer
 * yet. Equal values differ by rounding, which turns one way or the other. */
static int meshes_turn(const double coarser[], double own)
{
    const double first = coarser[1] - coarser[0], second = own - coarser[1];

    return first * second < -1e-6 * gsl_pow_2(fmax(fabs(first), fabs(second)));
}

/* Three times the spread over the contact meshes: three errors where they are of first
 * order, nine where of second.  Five times the spread where they turn. */
double rb_rolling_contact_error(const double coarser[], double own)
{
    const double most = fmax(own, fmax(coarser[0], coarser[1]));
    const double least = fmin(own, fmin(coarser[0], coarser[1]));

    return (meshes_turn(coarser, own) ? 5.0 : 3.0) * (most - least) +
           0.0 * (own + coarser[0] + coarser[1]); /* NAN stays */
}

/* The boundary outside the contact is smooth and its error of second order: half the
 * elements differ by three errors, of which this is twice as much.  Thin rims and clamped
 * arcs are of first order at first. */
double rb_rolling_boundary_error(int runs, const double coarser[], double own)
{
    return runs > 2 ? 2.0 * fabs(own - coarser[2]) : 0.0;
}

double rb_rolling_error_strain(const rb_rolling_case *rc, double a)
{
    return rb_rolling_has_radius(rc) ? a / rb_rolling_radius(rc) : rb_rolling_derive(rc).strain;
}

double rb_rolling_error_unit(const rb_rolling_case *rc, rb_rolling_error_scale scale, double P,
                             double p0, double a)
{
    const double mu = rb_rolling_largest_mu(rc), strain = mu * rb_rolling_error_strain(rc, a);

    switch (scale) {
    case RB_SCALE_LOAD:
        return P;
    case RB_SCALE_FRICTION:
        return mu * P;
    case RB_SCALE_SHIFT:
        return strain * a;
    case RB_SCALE_CREEPAGE:
        return strain;
    case RB_SCALE_WIDTH:
        return a;
    case RB_SCALE_PRESSURE:
        return p0;
    case RB_SCALE_MOMENT:
        return P * a;
    case RB_SCALE_TORQUE:
        return P * (a + mu * rb_rolling_larger_radius(rc));
    default:
        return 0.0;
    }
}

double rb_rolling_edge_power(const rb_rolling_case *rc, double P, double creepage, double a,
                             double share)
{
    const double slip =
        fabs(creepage) + fabs(rb_rolling_derive(rc).dundurs) * rb_rolling_error_strain(rc, a);

    return rb_rolling_largest_mu(rc) * P * slip * pow(share, 1.5);
}

/* ---- Results of a solution --------------------------------------------------------- */

/* Stick zones over which slip turns round and which the mesh does not resolve. */
typedef struct {
    double pressure; /* the largest one in those of fewer than four elements [stress]; 0: none */
    double risen;    /* the largest one that shorter elements may find in one [stress]; 0: none */
    double rise;     /* by which it is higher [stress] */
} unresolved_stick;

/* Friction jumps there by 2 mu p, and between unlike bodies the pressure has a logarithm: it rises
 * by (2/pi) mu beta p where the zone is shorter by the factor e.  One of m elements is m - 1 long
 * at least; one of a single element is looked at on elements ten times shorter.  From seven on its
 * limits are known (rb_rolling_stick_limit_of). */
static unresolved_stick find_unresolved_stick(const rb_rolling_case *rc,
                                              const rb_rolling_solution *s)
{
    enum { SHOWS_NO_PLACE = 4 };
    const double slope = M_2_PI * rb_rolling_largest_mu(rc) * fabs(rb_rolling_derive(rc).dundurs);
    int before = RB_ZONE_SEPARATED, stuck = 0;
    unresolved_stick found = {0.0, 0.0, 0.0};

    for (int i = 0; i < s->n; i++) {
        if (s->zone[i] == RB_ZONE_STICK) {
            stuck++;
            continue;
        }
        if (before > RB_ZONE_STICK && s->zone[i] > RB_ZONE_STICK && s->zone[i] != before &&
            stuck < RB_ROLLING_LIMIT_LEAST) {
            double most = 0.0;
            for (int j = i - stuck - 1; j <= i; j++)
                most = fmax(most, s->p[j]);
            const double rise = slope * most * (stuck < 2 ? M_LN10 : log(stuck / (stuck - 1.0)));
            if (stuck < SHOWS_NO_PLACE)
                found.pressure = fmax(found.pressure, most);
            if (most + rise > found.risen) {
                found.risen = most + rise;
                found.rise = rise;
            }
        }
        before = s->zone[i];
        stuck = 0;
    }
    return found;
}

static double slip_of(const rb_rolling_case *rc, const rb_rolling_solution *s, int i)
{
    return rc->formulation == RB_STEADY ? s->slip[i] : s->shift[i];
}

/* Whether slip of one direction grows from a stick zone on, as far as element i: the zone ends
 * where the mesh shows it, and there is no other one between. */
static int grows_from_stick(const rb_rolling_case *rc, const rb_rolling_solution *s, int i)
{
    for (int side = -1; side <= 1; side += 2) {
        int j = i;
        while (j + side >= 0 && j + side < s->n && s->zone[j + side] == s->zone[i] &&
               fabs(slip_of(rc, s, j + side)) < fabs(slip_of(rc, s, j)))
            j += side;
        if (j + side >= 0 && j + side < s->n && s->zone[j + side] == RB_ZONE_STICK)
            return 1;
    }
    return 0;
}

/* Whether an element slips by no more than the slip changes from there to the next one, at an end
 * of the contact by no more than five quarters of that, as its slope is infinite there:
 * a finer mesh may find that some of it sticks.  An elastic third body that rolls in always sticks
 * at first: it is not sheared yet, and the bound of friction begins with an infinite slope. */
static int may_stick(const rb_rolling_case *rc, const rb_rolling_solution *s, int i)
{
    const double own = slip_of(rc, s, i);

    if (rc->formulation == RB_STEADY && rc->interlayer_tangential > 0.0 &&
        s->zone[i] > RB_ZONE_STICK && (i + 1 == s->n || s->zone[i + 1] == RB_ZONE_SEPARATED))
        return 1;
    for (int j = i - 1; j <= i + 1; j += 2) {
        if (j < 0 || j >= s->n || s->zone[j] == RB_ZONE_SEPARATED)
            continue;
        const int other = 2 * i - j;
        const double steeper =
            other < 0 || other >= s->n || s->zone[other] == RB_ZONE_SEPARATED ? 1.25 : 1.0;
        if (s->zone[i] > RB_ZONE_STICK && fabs(own) <= steeper * fabs(own - slip_of(rc, s, j)))
            return !grows_from_stick(rc, s, i);
    }
    return 0;
}

static int touches_stick(const rb_rolling_solution *s, int i)
{
    return (i > 0 && s->zone[i - 1] == RB_ZONE_STICK) ||
           (i + 1 < s->n && s->zone[i + 1] == RB_ZONE_STICK);
}

/* What a stick zone of fewer than four elements may be off by in friction [load]:
 * Carter's falls short of mu P by the square of the part of the contact that sticks,
 * whose length is known to an element beside it. */
static double friction_of_short_stick(const rb_rolling_case *rc, const rb_rolling_solution *s)
{
    const double width = 2.0 * s->half_width, stick = s->stick_length;
    double element = 0.0;

    if (rc->formulation != RB_STEADY || s->stick < 1 || s->stick >= 4)
        return 0.0;
    for (int i = 0; i < s->n; i++)
        if (s->zone[i] == RB_ZONE_STICK || touches_stick(s, i))
            element = fmax(element, s->h[i]);
    return rb_rolling_largest_mu(rc) * s->normal_load * element * (2.0 * stick + element) /
           (width * width);
}

/* What zones of stick that the mesh does not show may change: the friction of an element
 * of each of them [load], and how far from those that it shows they are [length]. */
typedef struct {
    double friction, length;
} hidden_stick;

static hidden_stick find_hidden_stick(const rb_rolling_case *rc, const rb_rolling_solution *s)
{
    hidden_stick hidden = {0.0, rb_rolling_longest_element(s->n, s->zone, s->h)};
    const double element = hidden.length;
    double farthest = 0.0;

    for (int i = 0; i < s->n; i++) {
        if (!may_stick(rc, s, i) || touches_stick(s, i))
            continue;
        const double left = s->x[i] - 0.5 * s->h[i], right = s->x[i] + 0.5 * s->h[i];
        hidden.friction = fmax(hidden.friction, fabs(s->q[i]) * s->h[i]);
        if (s->stick == 0 && rb_rolling_largest_mu(rc) > 0.0)
            farthest = element; /* a zone up to two long hides between midpoints and an edge */
        else if (s->stick > 0)
            farthest = fmax(farthest, fmax(s->stick_from - left, right - s->stick_to));
    }
    hidden.length += farthest;
    return hidden;
}

/* The largest pressure [stress] to which that of a stick zone, smooth there, goes on at limits
 * where the solution does not say it (rb_rolling_stick_limit_of).  Between unlike bodies it falls
 * from there with an infinite slope where they slip, and elements do not show how high it was.  0:
 * the mesh tells it nowhere. */
static double pressure_at_limits_of_stick(const rb_rolling_case *rc, const rb_rolling_solution *s)
{
    enum { SECOND = 2, LAST = 4 }; /* the first one errs by what it does not show beside it */
    const rb_rolling_tractions of = {.n = s->n,
                                     .has_history = rc->formulation != RB_STEADY,
                                     .zone = s->zone,
                                     .x = s->x,
                                     .p = s->p,
                                     .q = s->q};
    rb_rolling_stick_limit known;
    double most = 0.0;

    if (!rb_rolling_couples(rc))
        return 0.0;
    for (int i = 0; i < s->n; i++)
        for (int side = -1; side <= 1; side += 2) {
            const int last = i - LAST * side, beyond = i + side;
            int sticks = last >= 0 && last < s->n && beyond >= 0 && beyond < s->n &&
                         s->zone[beyond] > RB_ZONE_STICK;
            for (int k = 0; k <= LAST && sticks; k++)
                sticks = s->zone[i - k * side] == RB_ZONE_STICK;
            if (!sticks || rb_rolling_stick_limit_of(rc, &of, i, side, &known))
                continue;
            const int second = i - SECOND * side;
            const double slope = (s->p[second] - s->p[last]) / (s->x[second] - s->x[last]);
            most =
                fmax(most, s->p[second] + slope * (s->x[i] + 0.5 * side * s->h[i] - s->x[second]));
        }
    return most;
}

/* What half the distance of two edges may be off by, where one is only known to lie between the
 * midpoints of the last element in contact and the next one. */
static double half_of_bounded_edges(const rb_rolling_solution *s)
{
    const rb_rolling_patch *const first = &s->patch[0], *const last = &s->patch[s->patches - 1];
    int i = 0, j = s->n - 1;

    while (s->zone[i] == RB_ZONE_SEPARATED)
        i++;
    while (s->zone[j] == RB_ZONE_SEPARATED)
        j--;
    const double before = i > 0 ? s->h[i - 1] : 0.0, after = j + 1 < s->n ? s->h[j + 1] : 0.0;
    return 0.25 * ((first->bounded & RB_LEFT_BOUNDED ? before + s->h[i] : 0.0) +
                   (last->bounded & RB_RIGHT_BOUNDED ? s->h[j] + after : 0.0));
}

/* What no mesh tells apart: rounding and the tolerance of the solver, in units of what
 * the scalar is made of; the length of an element, where it is the place where stick
 * begins; slip over an element; the friction of an element that may stick; the pressure
 * at a corner, which is infinite, on elements ten times shorter, and at a limit of stick; and with
 * an unresolved stick zone the friction of an element, and the pressure that a jump of friction
 * brings about there between dissimilar bodies.  of_stress: 0 for the pressure, 1 for stresses. */
static double least_error(const rb_rolling_case *rc, const rb_rolling_solution *s, int of_stress,
                          rb_rolling_error_scale scale)
{
    const hidden_stick hidden = find_hidden_stick(rc, s);
    const double rounding = fmax(s->residual, rc->contact.tol);
    const double a = isnan(s->hertz_half_width) ? s->half_width : s->hertz_half_width;
    const double tolerance =
        rounding * rb_rolling_error_unit(rc, scale, s->normal_load, s->max_pressure, a);
    const unresolved_stick unresolved = find_unresolved_stick(rc, s);
    double missed, missed_mu; /* of tables that are finer than the elements */
    if (rb_rolling_missed_by_elements(rc, &missed, &missed_mu) != RB_OK)
        return NAN;
    const int force_given = rb_rolling_force_is_given(rc),
              fitted = rc->mesh == RB_MESH_FITTED && !s->equal_instead;
    const double friction =
        force_given ? 0.0
        : unresolved.pressure > 0.0
            ? rb_rolling_largest_mu(rc) * s->max_pressure *
                  rb_rolling_longest_element(s->n, s->zone, s->h)
            : fmax(hidden.friction, friction_of_short_stick(rc, s)) + missed_mu * s->normal_load;

    switch (scale) {
    case RB_SCALE_ONE:
        return rounding +
               (friction > 0.0 ? friction / (rb_rolling_largest_mu(rc) * s->normal_load) : 0.0);
    case RB_SCALE_LOAD:
    case RB_SCALE_MOMENT:
        return tolerance;
    case RB_SCALE_FRICTION:
        return tolerance + friction;
    case RB_SCALE_APPROACH:
        return rounding * fabs(s->approach);
    case RB_SCALE_SHIFT:
        return fmax(tolerance, rounding * fabs(s->tangential_shift));
    case RB_SCALE_CREEPAGE:
        return fmax(tolerance, rounding * fabs(s->creepage));
    case RB_SCALE_WIDTH:
        /* found within an element where bodies relax and where the pressure is no power there,
         * which is one of the shortest of fitted elements; equal ones show it to .02 to .15 of one,
         * as it lies in one; friction between unlike bodies may lift an edge of a punch less than
         * its first element is long */
        return tolerance +
               (rb_rolling_relaxes(rc) || (s->edges_bounded && !fitted) ? 0.5
                : rc->mesh == RB_MESH_UNIFORM                           ? 0.1
                                                                        : 0.0) *
                   rb_rolling_longest_element(s->n, s->zone, s->h) +
               (s->edges_bounded && fitted ? half_of_bounded_edges(s) : 0.0) +
               (rc->mesh == RB_MESH_PUNCH && rb_rolling_couples(rc)
                    ? 0.5 * (s->h[0] + s->h[s->n - 1])
                    : 0.0);
    case RB_SCALE_PRESSURE:
        if (rb_rolling_presses_with_end(rc, s))
            return NAN; /* infinite */
        return tolerance +
               (of_stress ? unresolved.rise
                          : fmax(0.0, fmax(unresolved.risen, pressure_at_limits_of_stick(rc, s)) -
                                          s->max_pressure)) +
               rb_rolling_rise_in_patches(rc, s, 10.0) + missed;
    case RB_SCALE_POWER: {
        /* where no element slips, all of what the force does beside free rolling */
        const double driven =
            s->slipping == 0 ? fabs((s->creepage - s->free_creepage) * s->tangential_load) : 0.0;
        return (driven > 0.0 ? driven : 0.0) +
               rb_rolling_edge_power(rc, s->normal_load, s->creepage, a,
                                     rb_rolling_longest_element(s->n, s->zone, s->h) /
                                         (2.0 * s->half_width));
    }
    case RB_SCALE_TORQUE:
        return tolerance + friction * rb_rolling_larger_radius(rc);
    case RB_SCALE_STRAIN:
        return rounding * rb_rolling_error_strain(rc, a);
    case RB_SCALE_WORK:
        return rounding * s->normal_load * rb_rolling_error_strain(rc, a);
    case RB_SCALE_HEAT:
        return rounding *
               fabs(s->max_temperature - fmin(rc->heat_a.temperature, rc->heat_b.temperature));
    case RB_SCALE_ELEMENT:
    case RB_SCALE_NONE:
        break;
    }
    return hidden.length;
}

/* One run: what it says. */
typedef struct {
    rb_rolling_solution solution;
    rb_rolling_stress_maxima stress[2]; /* of A and B */
} sample;

enum { TABLES = 3 };

/* Which of them are asked for. */
typedef struct {
    int of[2];
} asked_stress;

/* The parts of the errors, kept apart because --accuracy refines the larger one. */
typedef struct {
    rb_rolling_errors contact, boundary;
} error_parts;

/* What has error bars: numbers of a solution, and of the largest stresses of A and of B. */
typedef struct {
    rb_rolling_solution *scalar;
    rb_rolling_stress_maxima *stress[2];
} numbers;

static numbers numbers_of(sample *s)
{
    return (numbers){&s->solution, {&s->stress[0], &s->stress[1]}};
}

static numbers errors_of(rb_rolling_errors *e)
{
    return (numbers){&e->scalar, {&e->stress, &e->stress_b}};
}

/* Number k of the scalars, table 0, or of a body's stress, 1 and 2; NULL: there are no more. */
static double *number_at(const numbers *of, int table, int k, rb_rolling_error_scale *scale)
{
    if (table > 0) {
        *scale = k % 3 == 0 ? RB_SCALE_PRESSURE : RB_SCALE_WIDTH;
        return rb_rolling_maximum_number(of->stress[table - 1], k / 3, k % 3);
    }
    if (k >= rb_rolling_solution_scalars.n)
        return NULL;
    const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
    *scale = r->error_bar;
    return (double *)(void *)((char *)of->scalar + r->offset);
}

void rb_rolling_errors_free(rb_rolling_errors *errors)
{
    rb_rolling_stress_maxima_free(&errors->stress);
    rb_rolling_stress_maxima_free(&errors->stress_b);
}

/* NANs of so many bonds of A and of B. */
static rb_status errors_alloc(int bonds, int bonds_b, rb_rolling_errors *errors)
{
    *errors = rb_rolling_no_row(RB_OK).errors;
    const rb_status s = rb_rolling_stress_maxima_alloc(bonds, &errors->stress);
    return s == RB_OK ? rb_rolling_stress_maxima_alloc(bonds_b, &errors->stress_b) : s;
}

/* Where a coarser run has no stick at all: the zone is shorter than its elements, of
 * which one is added to the bar. */
static double take_unseen(const rb_rolling_solution *s, int runs, double value, double coarser[])
{
    const double element = rb_rolling_longest_element(s->n, s->zone, s->h);
    double longest = 0.0;

    for (int j = 0; j < runs && !isnan(value); j++)
        if (isnan(coarser[j])) {
            coarser[j] = value;
            longest = fmax(longest, element / part[j].contact);
        }
    return longest;
}

static rb_status add_parts(error_parts *parts, rb_rolling_errors *errors)
{
    const numbers contact = errors_of(&parts->contact), boundary = errors_of(&parts->boundary);
    const rb_status s =
        errors_alloc(parts->contact.stress.bonds, parts->contact.stress_b.bonds, errors);
    const numbers sum = errors_of(errors);
    rb_rolling_error_scale scale;
    const double *x;

    for (int t = 0; t < TABLES && s == RB_OK; t++)
        for (int k = 0; (x = number_at(&contact, t, k, &scale)); k++)
            if (scale != RB_SCALE_NONE)
                *number_at(&sum, t, k, &scale) = *x + *number_at(&boundary, t, k, &scale);
    return s;
}

static void parts_free(error_parts *parts)
{
    rb_rolling_errors_free(&parts->contact);
    rb_rolling_errors_free(&parts->boundary);
}

/* ---- One case and its error bars --------------------------------------------------- */

static void sample_free(sample *s)
{
    rb_rolling_solution_free(&s->solution);
    for (int body = 0; body < 2; body++)
        rb_rolling_stress_maxima_free(&s->stress[body]);
}

static rb_status take_sample(const rb_rolling_case *rc, asked_stress with, sample *s,
                             rb_message *why)
{
    rb_rolling_model model = {0};
    rb_status status = rb_rolling_solve_model(rc, &model, &s->solution, why);
    if (status == RB_OK && with.of[0])
        status = rb_rolling_stress_maxima_find(&model, 0.0, &s->stress[0], why);
    if (status == RB_OK && with.of[1])
        status = rb_rolling_stress_maxima_of_b(&model, 0.0, &s->stress[1], why);
    rb_rolling_model_free(&model);
    return status;
}

/* The error by the spread over the coarser runs and over another one, NAN where it does
 * not have the value. */
double rb_rolling_contact_error_with(const double coarser[], double own, double another,
                                     int is_finer)
{
    const double error = rb_rolling_contact_error(coarser, own);
    const double first[] = {coarser[0], another}, second[] = {coarser[1], another};

    if (isnan(error) || isnan(another))
        return error;
    return fmax(error, is_finer ? 3.0 * fabs(own - another)
                                : fmax(rb_rolling_contact_error(first, own),
                                       rb_rolling_contact_error(second, own)));
}

/* At least twice the spread over all meshes, with that of another one, NAN where it does not have
 * the value: three that see an edge in the same phase agree by chance, as far as they all err. */
double rb_rolling_contact_error_of_phases(const double coarser[], double own, double another)
{
    const double most = fmax(fmax(own, another), fmax(coarser[0], coarser[1]));
    const double least = fmin(fmin(own, another), fmin(coarser[0], coarser[1]));

    return fmax(rb_rolling_contact_error(coarser, own),
                (meshes_turn(coarser, own) ? 4.0 : 2.0) * (most - least)) +
           0.0 * (own + coarser[0] + coarser[1]);
}

/* From the case's own results and those of its coarser runs. */
static rb_status find_parts(const rb_rolling_case *rc, asked_stress with, const sample *own,
                            error_parts *parts, rb_message *why)
{
    sample run[RB_ERROR_RUNS] = {0}, another = {0};
    rb_message reason = {.text = ""};
    /* a convex body touches in one place: an element that opens or closes beside an edge makes no
     * patch of its own */
    const int runs = rb_rolling_error_runs(rc),
              patches = rb_rolling_is_convex(rc) ? 1 : own->solution.patches;
    rb_status status = RB_OK;

    for (int k = 0; k < runs && status == RB_OK; k++) {
        const rb_rolling_case coarser = rb_rolling_error_run(rc, k);
        status = take_sample(&coarser, with, &run[k], &reason);
        if (status != RB_OK)
            rb_fail(why, status, "error bars: %d contact elements: %.200s",
                    coarser.contact_elements, rb_status_reason(status, &reason));
    }
    /* Edges pass elements, and three meshes agree by chance: a fourth one, which costs little
     * between the coarser ones. Those of several patches pass them each on its own: between the
     * finer ones. A fitted patch has 12 elements at least, which half of fewer than 24 still are: a
     * finer one. */
    int fewest = 24;
    for (int k = 0; k < patches; k++)
        fewest = own->solution.patch[k].contact < fewest ? own->solution.patch[k].contact : fewest;
    const double other_is = patches < 2                                 ? 0.6
                            : rc->mesh == RB_MESH_FITTED && fewest < 24 ? 2.0
                                                                        : 0.85;
    rb_rolling_case other_mesh = *rc;
    other_mesh.contact_elements = (int)(other_is * rc->contact_elements);
    if (patches < 2 && rc->steps > 0)
        other_mesh.steps = (int)ceil(other_is * rc->steps);
    const int has_another =
        status == RB_OK && take_sample(&other_mesh, with, &another, NULL) == RB_OK;
    rb_rolling_errors *const part_of[] = {&parts->contact, &parts->boundary};
    for (int k = 0; k < 2 && status == RB_OK; k++)
        status = errors_alloc(own->stress[0].bonds, own->stress[1].bonds, part_of[k]);
    sample mine = *own;
    const numbers of_own = numbers_of(&mine), contact = errors_of(&parts->contact),
                  boundary = errors_of(&parts->boundary);
    for (int t = 0; t < TABLES && status == RB_OK; t++) {
        rb_rolling_error_scale scale;
        const double *value;
        for (int k = 0; (value = number_at(&of_own, t, k, &scale)); k++) {
            double coarser[RB_ERROR_RUNS], other = NAN;
            if (scale == RB_SCALE_NONE || (t > 0 && !with.of[t - 1]))
                continue;
            for (int j = 0; j < runs; j++) {
                const numbers of_run = numbers_of(&run[j]);
                coarser[j] = *number_at(&of_run, t, k, &scale);
            }
            if (has_another) {
                const numbers of_other = numbers_of(&another);
                other = *number_at(&of_other, t, k, &scale);
            }
            const double unseen = scale == RB_SCALE_ELEMENT
                                      ? take_unseen(&own->solution, runs, *value, coarser)
                                      : 0.0;
            *number_at(&contact, t, k, &scale) =
                (patches > 1 ? rb_rolling_contact_error_with(coarser, *value, other, other_is > 1.0)
                             : rb_rolling_contact_error_of_phases(coarser, *value, other)) +
                least_error(rc, &own->solution, t > 0, scale) + unseen;
            *number_at(&boundary, t, k, &scale) = rb_rolling_boundary_error(runs, coarser, *value);
        }
    }
    for (int k = 0; k < runs; k++)
        sample_free(&run[k]);
    sample_free(&another);
    return status;
}

rb_status rb_rolling_estimate_errors(const rb_rolling_case *rc, const rb_rolling_solution *solution,
                                     const rb_rolling_stress_maxima *stress,
                                     const rb_rolling_stress_maxima *stress_b,
                                     rb_rolling_errors *errors, rb_message *why)
{
    sample own = {.solution = *solution};
    const asked_stress with = {{stress != NULL, stress_b != NULL}};
    error_parts parts;
    rb_status status = rb_rolling_error_check(rc, why);

    memset(&parts, 0, sizeof parts);
    if (stress)
        own.stress[0] = *stress;
    if (stress_b)
        own.stress[1] = *stress_b;
    *errors = rb_rolling_no_row(RB_OK).errors;
    if (status == RB_OK)
        status = find_parts(rc, with, &own, &parts, why);
    if (status == RB_OK)
        status = add_parts(&parts, errors);
    parts_free(&parts);
    return status;
}

/* The solution stays where a coarser run fails. */
static rb_status solve_parts(const rb_rolling_case *rc, rb_rolling_solution *solution,
                             error_parts *parts, rb_message *why)
{
    sample own = {0};
    const rb_status status = take_sample(rc, (asked_stress){{0, 0}}, &own, why);

    *solution = own.solution;
    return status == RB_OK ? find_parts(rc, (asked_stress){{0, 0}}, &own, parts, why) : status;
}

rb_status rb_rolling_solve_with_errors(const rb_rolling_case *rc, rb_rolling_solution *solution,
                                       rb_rolling_errors *errors, rb_message *why)
{
    error_parts parts;
    rb_status status = rb_rolling_error_check(rc, why);

    memset(solution, 0, sizeof *solution);
    *errors = rb_rolling_no_row(RB_OK).errors;
    if (status == RB_OK)
        status = solve_parts(rc, solution, &parts, why);
    return status == RB_OK ? add_parts(&parts, errors) : status; /* no bonds, nothing to free */
}

/* ---- To a given accuracy ----------------------------------------------------------- */

/* Largest of the relative estimates that --accuracy asks for: forces in units of their
 * bound, creepage in units of itself, or of mu a/R where it is less.  The creepage of
 * free rolling, of wheels or of unlike bodies, does not vanish with mu: in units of mu
 * a/R alone no mesh would do for a small one.  *of: the name of that result. */
static double worst_relative(const rb_rolling_case *rc, const rb_rolling_solution *s,
                             const rb_rolling_solution *e, const char **of)
{
    const int slides = rb_rolling_largest_mu(rc) > 0.0;
    const double strain =
        rb_rolling_largest_mu(rc) * rb_rolling_error_strain(rc, s->hertz_half_width);
    const struct {
        const char *name;
        double error;
    } relative[] = {{"normal_load", e->normal_load / s->normal_load},
                    {"max_pressure", e->max_pressure / s->max_pressure},
                    {"half_width", e->half_width / s->half_width},
                    {"force_ratio", slides ? e->force_ratio : 0.0},
                    {"creepage", slides && rc->formulation != RB_STATIC
                                     ? e->creepage / fmax(strain, fabs(s->creepage))
                                     : 0.0}};
    int worst = 0;

    for (int k = 1; k < (int)(sizeof relative / sizeof *relative); k++)
        if (relative[k].error > relative[worst].error || isnan(relative[worst].error))
            worst = k;
    *of = relative[worst].name;
    return relative[worst].error;
}

/* Largest part of the error that the contact elements and the boundary have, and that of the
 * pressure which the contact elements have. */
typedef struct {
    int elements;
    double outer; /* how much finer than usual the boundary is */
    double contact, boundary, pressure;
} estimate;

/* Whether the pressure could come to an error on so many elements, at the highest order at which
 * its part has fallen since the first round.  A bar can be too small by chance, and is no proof of
 * a lower order: that of twice the first one.  Bars of the other results may fall at once, where
 * a short zone of stick is resolved. */
static int pressure_could_come(const estimate *first, const estimate *now, double error,
                               double elements)
{
    if (now->elements <= first->elements || !(now->pressure > error))
        return 1;
    const double order =
        log(2.0 * first->pressure / now->pressure) / log((double)now->elements / first->elements);
    return order > 0.0 && log(now->pressure / error) < order * log(elements / now->elements);
}

/* Makes the elements of the contact and those of the boundary finer: each until its part of
 * the error is what the other one leaves of the accuracy, half of it at least, and by at
 * most two because an error may fall faster than its order says.  That of fitted elements on flat
 * bodies hardly does, and many of them cost little: by at most four.  0: the limit of a part
 * is reached, or twice that would not do, or not the limit itself at the order of the rounds
 * before: where the pressure is singular, as at the end of stick between unlike bodies, finer ones
 * would take minutes and hardly be better. */
static int refined_elements(double accuracy, const estimate *first, const estimate *now, int fitted,
                            rb_rolling_case *rc)
{
    const int wheels = rb_rolling_error_runs(rc) > 2;
    const rb_rolling_mesh twice = {.n = 2 * rc->contact_elements};
    const int strong = rc->mesh == RB_MESH_FITTED && rb_rolling_mu_beta(rc) >= 1.0;
    const double most = strong                               ? RB_ROLLING_GRADED_STRONG_UP_TO
                        : wheels                             ? MOST_ON_WHEELS
                        : rb_rolling_suits_large(rc, &twice) ? MOST_WITHOUT_MATRIX
                                                             : MOST_ELEMENTS;
    const double order = fitted ? 2.0 : 1.0, step = fitted && !wheels ? 4.0 : 2.0,
                 spare = wheels ? 1.1 : 1.2;
    const double n = rc->contact_elements, outer = fmax(rc->outer_refinement, 1.0);
    const double for_contact = fmax(0.5 * accuracy, accuracy - now->boundary);
    const double for_boundary = fmax(0.5 * accuracy, accuracy - now->contact);
    const double n_factor = fmax(1.0, pow(now->contact / for_contact, 1.0 / order));
    /* the second order, or that at which the boundary's part has fallen so far: thin rims are of
     * the first */
    const double grown = outer / first->outer,
                 fallen = log(first->boundary / now->boundary) / log(grown),
                 boundary_order = grown > 1.1 ? fmin(fmax(fallen, 1.0), 2.0) : 2.0;
    const double outer_factor = fmax(1.0, pow(now->boundary / for_boundary, 1.0 / boundary_order));

    if (n * n_factor > 2.0 * most || outer * outer_factor > 2.0 * finest_boundary ||
        !pressure_could_come(first, now, for_contact, most))
        return 0;
    const double finer = fmin(most / n, fmin(step, n_factor > 1.0 ? spare * n_factor : 1.0));
    rc->contact_elements = (int)(finer * n + 0.5);
    rc->steps = (int)ceil(finer * rc->steps);
    rc->outer_refinement =
        fmin(finest_boundary, outer * fmin(2.0, outer_factor > 1.0 ? 1.1 * outer_factor : 1.0));
    return rc->contact_elements > n || rc->outer_refinement > outer;
}

void rb_rolling_set_accuracy(const rb_rolling_case *refined, rb_rolling_solution *solution)
{
    solution->accuracy_elements = refined->contact_elements;
    solution->accuracy_boundary =
        rb_rolling_error_runs(refined) > 2 ? fmax(refined->outer_refinement, 1.0) : (double)NAN;
}

rb_status rb_rolling_solve_to_accuracy(const rb_rolling_case *rc, double accuracy,
                                       rb_rolling_solution *solution, rb_rolling_errors *errors,
                                       int *elements, rb_message *why)
{
    rb_rolling_case refined = *rc;
    error_parts parts;
    double worst = INFINITY, before;
    const char *of = "", *of_part; /* results that are the worst */
    estimate first = {0}, now;
    int round = 0, stood = 0; /* rounds in which the bars did not fall */
    rb_status status = rb_rolling_error_check(rc, why);
    const int second_order = rb_rolling_mesh_is_graded(rc) ||
                             (rc->mesh == RB_MESH_ALIGNED && (rc->slip_operator == RB_SLIP_SECOND
                                                                  ? rb_rolling_carter_holds(rc)
                                                                  : rb_rolling_cattaneo_holds(rc)));

    memset(solution, 0, sizeof *solution);
    *errors = rb_rolling_no_row(RB_OK).errors;
    *elements = 0;
    if (status == RB_OK)
        status = rb_rolling_check_number("accuracy", accuracy, why);
    if (status != RB_OK)
        return status;
    do {
        rb_rolling_solution finer;
        status = solve_parts(&refined, &finer, &parts, why);
        if (status != RB_OK && round > 0) {
            rb_rolling_solution_free(&finer); /* the best one so far stays */
            break;
        }
        rb_rolling_solution_free(solution);
        *solution = finer;
        *elements = status >= 0 ? refined.contact_elements : 0;
        rb_rolling_set_accuracy(&refined, solution);
        round++;
        if (status != RB_OK)
            return status;
        add_parts(&parts, errors);
        before = worst;
        worst = worst_relative(rc, solution, &errors->scalar, &of);
        stood = fabs(worst - before) < 0.05 * worst ? stood + 1 : 0;
        if (worst <= accuracy)
            return RB_OK;
        now = (estimate){*elements, fmax(refined.outer_refinement, 1.0),
                         worst_relative(rc, solution, &parts.contact.scalar, &of_part),
                         worst_relative(rc, solution, &parts.boundary.scalar, &of_part),
                         parts.contact.scalar.max_pressure / solution->max_pressure};
        first = round == 1 ? now : first;
    } while (stood < 2 && refined_elements(accuracy, &first, &now,
                                           second_order && !solution->equal_instead, &refined));
    if (status == RB_ENOMEM || status == RB_EINVAL) /* more than the machine has is refused */
        return rb_fail(why, RB_ENOMEM,
                       "accuracy %g: out of memory beyond %d elements, whose estimated error is "
                       "%.2g of %s",
                       accuracy, *elements, worst, of);
    if (status == RB_OK)
        status = rb_fail(why, RB_INACCURATE,
                         "accuracy %g not reached with %d elements: estimated error "
                         "%.2g of %s%s",
                         accuracy, *elements, worst, of,
                         rc->mesh == RB_MESH_UNIFORM ? "; a fitted mesh needs fewer" : "");
    return status;
}
