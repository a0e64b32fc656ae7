/* A certificate of a result: the problem is built again from the inputs that the result
 * prints, on the elements of its table, and everything else that it prints is computed
 * again from its pressures, friction, approach and creepage.  Nothing is solved.
 * What a file holds is read in json.c and table.c; a history is followed by the states of its
 * steps in history.c. */
#include "program/certificate/internal.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

static const double CONTROLS = 1e-9; /* a given value against the one that was met */
static const double RATIO = 1e-13;   /* rounding of the creepage ratio of a table */
static const double KELVIN = 1e-13;  /* temperatures of slip that is none but for rounding */
enum { UNRESOLVED = 4 };             /* slip zones at the trailing edge of fewer elements */

void rb_certificate_violated(rb_certificate *c, const char *format, ...)
{
    va_list args;
    c->found->violations++;
    fprintf(c->out, "%s: violated: ", c->name);
    if (c->step > 0)
        fprintf(c->out, "step %d: ", c->step);
    va_start(args, format);
    vfprintf(c->out, format, args);
    va_end(args);
    fputc('\n', c->out);
}

void rb_certificate_expect(rb_certificate *c, const char *what, int element, double printed,
                           double want, double allowed)
{
    char place[40] = "";
    c->found->numbers++;
    if (fabs(printed - want) <= allowed || (isnan(printed) && isnan(want)))
        return;
    if (element > 0)
        snprintf(place, sizeof place, " of element %d", element);
    rb_certificate_violated(c,
                            "%s%s: printed %.17g, recomputed %.17g (difference %.2g, allowed %.2g)",
                            what, place, printed, want, printed - want, allowed);
}

double rb_certificate_number(const json_t *value)
{
    return json_is_number(value) ? json_number_value(value) : NAN;
}

double rb_certificate_member(const json_t *object, const char *key)
{
    return rb_certificate_number(json_object_get(object, key));
}

static double largest(const json_t *list)
{
    double most = 0.0;
    for (size_t i = 0; i < json_array_size(list); i++)
        most = fmax(most, fabs(rb_certificate_number(json_array_get(list, i))));
    return most;
}

rb_status rb_certificate_refuse(const char *name, const char *what, rb_message *why)
{
    return rb_fail(why, RB_EFORMAT, "%s: cannot be checked: %s", name, what);
}

const char *rb_certificate_word(const json_t *object, const char *key)
{
    const char *text = json_string_value(json_object_get(object, key));
    return text ? text : "";
}

/* ---- The model again --------------------------------------------------------------- */

static rb_status read_list(const char *name, const json_t *list, const char *heading, int n,
                           double *x, rb_message *why)
{
    if ((int)json_array_size(list) != n)
        return rb_fail(why, RB_EFORMAT, "%s: table: expected %d numbers in %s", name, n, heading);
    for (int i = 0; i < n; i++) {
        x[i] = rb_certificate_number(json_array_get(list, (size_t)i));
        if (!isfinite(x[i]))
            return rb_fail(why, RB_EFORMAT, "%s: table: %s of element %d is no number", name,
                           heading, i + 1);
    }
    return RB_OK;
}

rb_status rb_certificate_lists(const char *name, const char *of, const json_t *table,
                               const char *heading, int steps, int n, size_t apart, double *x,
                               rb_message *why)
{
    const json_t *lists = json_object_get(table, heading);
    rb_status s = RB_OK;

    if ((int)json_array_size(lists) != steps)
        return rb_fail(why, RB_EFORMAT, "%s: %sexpected %d steps in %s", name, of, steps, heading);
    for (int k = 0; k < steps && s == RB_OK; k++)
        s = read_list(name, json_array_get(lists, (size_t)k), heading, n, x + (size_t)k * apart,
                      why);
    return s;
}

rb_status rb_certificate_column(const char *name, const json_t *table, const char *heading, int n,
                                double *x, rb_message *why)
{
    return read_list(name, json_object_get(table, heading), heading, n, x, why);
}

/* Gaps and shifts of the printed tractions at an approach and a motion: w, 2 n. */
static void kinematics_at(const rb_certificate *c, double delta, double xi, double *w)
{
    rb_contact_state at = c->model.state;
    at.delta = delta;
    at.xi = xi;
    rb_contact_kinematics(&c->model.problem, &at, w, w + c->model.problem.n);
}

/* The factor of a for which r - factor a is least, in the sense of least squares. */
static double fit(size_t n, const double *a, const double *r)
{
    double aa = 0.0, ar = 0.0;
    for (size_t i = 0; i < n; i++) {
        aa += a[i] * a[i];
        ar += a[i] * r[i];
    }
    return ar / aa;
}

/* Gaps and shifts are linear in both.  What is given is taken as it is. */
static rb_status fit_motion(rb_certificate *c, rb_message *why)
{
    const rb_contact_problem *p = &c->model.problem;
    rb_contact_state *x = &c->model.state;
    const size_t n = (size_t)p->n;
    double *w = rb_alloc(n, 6);
    if (!w)
        return RB_ENOMEM;
    double *unit = w + 2 * n, *printed = w + 4 * n;
    const rb_status s = rb_certificate_column(c->name, c->table, "gap_mm", p->n, printed, why);
    memcpy(printed + n, x->lambda, n * sizeof *printed);
    x->xi = p->xi;
    x->delta = p->delta;
    kinematics_at(c, 0.0, 0.0, w);
    for (size_t i = 0; i < 2 * n; i++)
        printed[i] -= w[i];
    if (p->load_given) {
        kinematics_at(c, 1.0, 0.0, unit);
        for (size_t i = 0; i < n; i++)
            unit[i] -= w[i];
        x->delta = fit(n, unit, printed);
    }
    if (p->force_given || !isnan(c->model.rc->creep_ratio)) {
        kinematics_at(c, 0.0, 1.0, unit);
        for (size_t i = n; i < 2 * n; i++)
            unit[i] -= w[i];
        x->xi = fit(n, unit + n, printed + n);
    }
    free(w);
    return s;
}

/* The printed unknowns. */
static rb_status read_state(rb_certificate *c, rb_message *why)
{
    rb_rolling_model *m = &c->model;
    const int n = m->mesh.n, is_static = m->rc->formulation == RB_STATIC;
    rb_status s = rb_certificate_column(c->name, c->table, "p_MPa", n, m->state.p, why);

    if (s == RB_OK)
        s = rb_certificate_column(c->name, c->table, "q_MPa", n, m->state.q, why);
    if (s == RB_OK)
        s = rb_certificate_column(c->name, c->table, "zone", n, m->state.lambda, why);
    for (int i = 0; i < n && s == RB_OK; i++) {
        const double zone = m->state.lambda[i];
        if (!(zone >= 0.0 && zone <= (m->problem.yield ? 5.0 : 3.0)) || zone != floor(zone))
            s = rb_fail(why, RB_EFORMAT, "%s: table: zone of element %d is %g", c->name, i + 1,
                        zone);
        else
            m->state.zone[i] = (int)zone;
    }
    if (s == RB_OK)
        s = rb_certificate_column(c->name, c->table, "shift_mm", n, m->state.lambda, why);
    if (s == RB_OK && m->problem.yield) {
        /* Plastic slips from what has yielded, u, against the friction, or against the slip where
         * the interface has softened to nothing. */
        const rb_contact_problem *p = &m->problem;
        double *u = m->state.plastic;
        s = rb_certificate_column(c->name, c->table, "plastic_mm", n, u, why);
        for (int i = 0; i < n && s == RB_OK; i++) {
            const double next = i + 1 < n ? u[i + 1] : 0.0, second = i + 2 < n ? u[i + 2] : 0.0;
            const double own = (u[i] - p->recall[0] * next - p->recall[1] * second) / p->own;
            const double with = m->state.q[i] != 0.0 ? -m->state.q[i] : m->state.lambda[i];
            u[i] = with < 0.0 ? -own : own;
        }
    }
    if (s == RB_OK && !c->summary)
        return fit_motion(c, why);
    m->state.delta = rb_certificate_member(c->summary, "approach");
    m->state.xi = rb_certificate_member(c->summary, is_static ? "tangential_shift" : "creepage");
    if (s == RB_OK && !(isfinite(m->state.delta) && isfinite(m->state.xi)))
        s = rb_fail(why, RB_EFORMAT, "%s: summary: no approach, shift or creepage", c->name);
    return s;
}

/* ---- Sums -------------------------------------------------------------------------- */

/* a'p + b'q: Neumaier's sum of products that fma splits without error. */
static double weighted(int n, const double *a, const double *p, const double *b, const double *q)
{
    double sum = 0.0, lost = 0.0;
    for (int i = 0; i < 2 * n; i++) {
        const double x = i % 2 ? b[i / 2] : a[i / 2], y = i % 2 ? q[i / 2] : p[i / 2];
        const double product = x * y, t = sum + product;
        lost += fabs(sum) >= fabs(product) ? (sum - t) + product : (product - t) + sum;
        lost += fma(x, y, -product);
        sum = t;
    }
    return sum + lost;
}

void rb_certificate_given(rb_certificate *c, double load)
{
    const rb_contact_problem *p = &c->model.problem;
    const double delta = c->model.state.delta;

    if (p->load_given)
        rb_certificate_expect(c, "the given load", 0, load, p->load, CONTROLS * p->load);
    else
        rb_certificate_expect(c, "the given approach", 0, delta, p->delta,
                              CONTROLS * fabs(p->delta));
}

/* ---- Laws, element by element ------------------------------------------------------ */

/* What is given of creepage, shift, force: the residual has the force. */
void rb_certificate_motion(rb_certificate *c)
{
    const rb_contact_problem *p = &c->model.problem;
    const rb_rolling_case *rc = c->model.rc;
    if (p->force_given)
        return;
    if (c->step == 0 && rc->formulation == RB_STEADY && !isnan(rc->creep_ratio))
        rb_certificate_expect(c, "the given creep_ratio", 0, c->again.creep_ratio, rc->creep_ratio,
                              CONTROLS * fabs(rc->creep_ratio) + RATIO);
    else
        rb_certificate_expect(c, "the given shift or creepage", 0, c->model.state.xi, p->xi,
                              CONTROLS * fabs(p->xi));
}

/* The residual that the result prints is believed where it is below what was asked for.
 * Hierarchical matrices approximate: other ends of elements, by a rounding, other digits. */
void rb_certificate_tolerances(rb_certificate *c, double residual)
{
    const rb_contact_problem *p = &c->model.problem;
    c->hierarchical =
        c->summary ? strcmp(rb_certificate_word(c->summary, "boundary_matrix"), "hierarchical") == 0
                   : c->again.hierarchical;
    const double asked = fmax(c->model.rc->contact.tol, p->rounding);

    c->exact = 10.0 * fmax(residual < asked ? residual : asked, p->rounding);
    /* A share of the largest displacement: that of a wheel comes from solving the system of
     * its boundary again, on ends of elements that differ by a rounding. */
    const double share = c->hierarchical                             ? 1e-10
                         : rb_rolling_can(c->model.rc, RB_BODY_FLAT) ? 1e-13
                                                                     : 2e-12;
    /* Of the half-planes that thin layers would be without their bases: what these take away is
     * subtracted from it. */
    const rb_rolling_case *rc = c->model.rc;
    const rb_rolling_body *const bodies[] = {&rc->a, &rc->b};
    double tractions = 0.0, compliance = 0.0;
    for (int i = 0; i < p->n; i++)
        tractions +=
            (fabs(c->model.state.p[i]) + fabs(c->model.state.q[i])) * c->model.bodies.f.h[i];
    for (int b = 0; b < 1 + rc->elastic_b; b++) {
        const rb_bem_material material = rb_rolling_material(rc, bodies[b]);
        if (bodies[b]->layer > 0.0)
            compliance += (1.0 - material.poisson) / material.shear;
    }
    c->displacement =
        share * (largest(json_object_get(c->table, "un_mm")) +
                 largest(json_object_get(c->table, "ut_mm")) + tractions * compliance);
    c->tol = (c->hierarchical ? 100.0 : 10.0) * asked +
             c->displacement / fmin(p->gap_length, p->slip_length);
}

rb_status rb_certificate_laws(rb_certificate *c)
{
    const rb_contact_problem *problem = &c->model.problem;
    const rb_contact_state *x = &c->model.state;
    const int n = problem->n;
    const double apart = c->tol * problem->gap_length + c->displacement;
    const double length = c->tol * problem->slip_length;
    const double stress = c->tol * fmax(problem->mu, 1e-3) * problem->stress;
    double *gap = rb_alloc((size_t)n, 3);
    rb_contact_violation v;

    if (!gap)
        return RB_ENOMEM;
    double *yielded = gap + 2 * n;
    rb_contact_kinematics(problem, x, gap, gap + n);
    rb_contact_yielded(problem, x->plastic, NULL, yielded);
    for (int i = 0; i < n; i++) {
        const json_t *printed = json_array_get(json_object_get(c->table, "gap_mm"), (size_t)i);
        const double p = x->p[i], q = x->q[i], slip = x->lambda[i], bound = problem->bound[i] * p;
        const double yield = rb_contact_yield_stress(problem, i, yielded[i]);
        const int zone = x->zone[i];

        if (c->step == 0)
            rb_certificate_expect(c, "gap_mm", i + 1, rb_certificate_number(printed), gap[i],
                                  c->exact * problem->gap_length + c->displacement);
        rb_certificate_expect(c, "shift_mm", i + 1, slip, gap[n + i],
                              c->exact * problem->slip_length + c->displacement);
        if (p > 0.0 ? fabs(gap[i]) > apart : gap[i] < -apart)
            rb_certificate_violated(c,
                                    "gap of element %d: %.3g at a pressure of %.3g (allowed %.2g)",
                                    i + 1, gap[i], p, apart);
        if (p < 0.0)
            rb_certificate_violated(c, "pressure of element %d: %.3g < 0", i + 1, p);
        if ((p > 0.0) != (zone != RB_ZONE_SEPARATED))
            rb_certificate_violated(c, "zone of element %d: %d at a pressure of %.3g", i + 1, zone,
                                    p);
        if (fabs(q) > bound + stress)
            rb_certificate_violated(
                c, "Coulomb's bound of element %d: |q| exceeds mu p by %.3g (allowed %.2g)", i + 1,
                fabs(q) - bound, stress);
        if (zone == RB_ZONE_STICK && fabs(slip) > length)
            rb_certificate_violated(c, "stick of element %d: it slips by %.3g (allowed %.2g)",
                                    i + 1, fabs(slip), length);
        if (zone == RB_ZONE_SLIP_NEGATIVE && (fabs(q + bound) > stress || slip < -length))
            rb_certificate_violated(c, "slip of element %d: q + mu p = %.3g, shift %.3g", i + 1,
                                    q + bound, slip);
        if (zone == RB_ZONE_SLIP_POSITIVE && (fabs(q - bound) > stress || slip > length))
            rb_certificate_violated(c, "slip of element %d: q - mu p = %.3g, shift %.3g", i + 1,
                                    q - bound, slip);
        if (zone > RB_ZONE_SLIP_POSITIVE && fabs(fabs(q) - yield) > stress)
            rb_certificate_violated(c, "yield of element %d: |q| is off its yield stress by %.3g",
                                    i + 1, fabs(q) - yield);
        if (fabs(q) > yield + stress)
            rb_certificate_violated(
                c, "yield stress of element %d: |q| exceeds it by %.3g (allowed %.2g)", i + 1,
                fabs(q) - yield, stress);
    }
    if (x->p[0] > 0.0 || x->p[n - 1] > 0.0)
        rb_certificate_violated(c, "the contact reaches an end of the table");
    free(gap);
    const rb_status s = rb_contact_residual(problem, x, &v);
    if (s == RB_OK && !(v.scaled <= c->tol))
        rb_certificate_violated(c, "residual: %.3g (allowed %.2g)", v.scaled, c->tol);
    c->found->residual = v.scaled;
    return s;
}

/* ---- Everything else that is printed ----------------------------------------------- */

/* How exactly a result comes out again beside its own nine digits, by its unit. */
double rb_certificate_rounding(const rb_rolling_results *all, const char *name,
                               const rb_certificate_scales *s, double otherwise)
{
    const rb_rolling_result *r = rb_rolling_find_result(all, name);

    if (strncmp(name, "torque", 6) == 0)
        return 1e-13 * s->load * s->radius;
    if (strstr(name, "_work")) /* of friction on a slip */
        return 1e-15 * s->load * s->half_width;
    if (!r || !r->unit)
        return otherwise;
    return strcmp(r->unit, "mm") == 0     ? 1e-12 * s->half_width
           : strcmp(r->unit, "N/mm") == 0 ? 1e-13 * s->load
           : strcmp(r->unit, "N") == 0    ? 1e-12 * s->load * s->half_width
           : strcmp(r->unit, "MPa") == 0  ? 1e-12 * s->pressure
           : strcmp(r->unit, "1") == 0    ? 1e-13 * s->number
           : strcmp(r->unit, "K") == 0    ? KELVIN
                                          : 0.0;
}

static double slack_of_summary(const rb_certificate *c, const char *path, double want)
{
    const char *key = rb_certificate_last(path);
    const rb_rolling_solution *s = &c->again;
    const rb_certificate_scales scales = {.half_width = /* or nothing in contact */
                                          isnan(s->half_width) ? 0.0 : s->half_width,
                                          .load = s->normal_load,
                                          .pressure = s->max_pressure,
                                          .radius = rb_rolling_larger_radius(c->model.rc)};
    const rb_contact_problem *p = &c->model.problem;

    return 1e-9 * fabs(want) +
           (strcmp(key, "residual") == 0            ? c->tol
            : strcmp(key, "residual_friction") == 0 ? c->tol * p->stress
            : strcmp(key, "residual_gap") == 0      ? c->tol * p->gap_length
            : strncmp(key, "residual_", 9) == 0
                ? c->tol * p->slip_length
                : rb_certificate_rounding(&rb_rolling_solution_scalars, key, &scales, 1e-10));
}

/* How the answer was found, which nothing but solving again would tell. */
static int is_of_the_way(const char *key)
{
    static const char *const keys[] = {"iterations", "solver",   "lcp_form",     "seconds",
                                       "integrals",  "openblas", "free_creepage"};
    for (size_t k = 0; k < sizeof keys / sizeof *keys; k++)
        if (strcmp(key, keys[k]) == 0)
            return 1;
    return 0;
}

const char *rb_certificate_last(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot ? dot + 1 : path;
}

/* 0: no list; 1: a list; 2: lists in it. */
static int depth(const json_t *value)
{
    int most = 0;
    for (size_t k = 0; k < json_array_size(value); k++)
        most = most || json_is_array(json_array_get(value, k));
    return json_is_array(value) + most;
}

/* 1: `one` has [left, right] of a derivative and `other` a value for both: a rounding decides
 * which of them is printed.  element: the step of a history, 0 otherwise. */
static int are_sides(const rb_certificate *c, int element, const json_t *one, const json_t *other)
{
    /* of a history there is a list of them, and of a column of a case they are lists */
    return c->sides == (element > 0 ? RB_SIDES_OF_STEPS : RB_SIDES_OF_CASE) &&
           json_array_size(one) == 2 && depth(one) == depth(other) + 1;
}

void rb_certificate_compare(rb_certificate *c, const char *name, int element, const json_t *printed,
                            const json_t *again, rb_certificate_slack *slack)
{
    const size_t n = json_array_size(again);
    const int of_again = are_sides(c, element, again, printed);
    if (printed && (of_again || are_sides(c, element, printed, again)))
        for (size_t k = 0; k < 2; k++)
            rb_certificate_compare(c, name, element,
                                   of_again ? printed : json_array_get(printed, k),
                                   of_again ? json_array_get(again, k) : again, slack);
    else if (json_is_object(again)) {
        /* Its members, and that there are no others. */
        const char *key;
        json_t *value;
        char own[120] = "", path[160];
        snprintf(own, sizeof own, element > 0 ? "%s.%d" : "%s", name, element);
        json_object_foreach((json_t *)again, key, value)
        {
            snprintf(path, sizeof path, "%s.%s", own, key);
            if (strcmp(name, "summary") != 0 || !is_of_the_way(key))
                rb_certificate_compare(c, path, 0, json_object_get(printed, key), value, slack);
        }
        json_object_foreach((json_t *)printed, key, value)
        {
            if (!json_object_get(again, key))
                rb_certificate_violated(c, "%s.%s is no result of this case", own, key);
        }
    } else if (json_is_number(again) || json_is_null(again)) {
        const double want = rb_certificate_number(again);
        const int exact = json_is_null(again) || json_is_integer(again);

        if (!printed || (json_is_null(again) && !json_is_null(printed)))
            rb_certificate_violated(c, "%s is missing, or should be null", name);
        else
            rb_certificate_expect(c, name, element, rb_certificate_number(printed), want,
                                  exact ? 0.0 : slack(c, name, want));
    } else if (json_is_array(again) && json_array_size(printed) == n)
        for (size_t i = 0; i < n; i++)
            rb_certificate_compare(c, name, (int)i + 1, json_array_get(printed, i),
                                   json_array_get(again, i), slack);
    else if (!json_equal(printed, again))
        rb_certificate_violated(c, "%s is not what it should be", name);
}

/* The library's own formula against one that shares nothing with it.  What sticks up to
 * the trailing edge is set free there, in a slip zone that the elements do not resolve:
 * differences along the contact count that work as hysteresis, waves do not. */
static rb_status check_hysteresis(rb_certificate *c)
{
    const double printed =
        c->summary ? rb_certificate_member(c->summary, "hysteresis") : c->again.hysteresis;
    double waves, allowed;

    if (c->model.rc->formulation != RB_STEADY || !(c->again.n > 0) ||
        !rb_rolling_relaxes(c->model.rc))
        return RB_OK;
    const rb_status s = rb_certificate_hysteresis(c, &waves, &allowed);
    if (s != RB_OK)
        return s;
    if (printed > waves) {
        /* Elements that slip at the trailing edge, behind those that stick. */
        int first = 0, last;
        while (first < c->again.n && !(c->again.p[first] > 0.0))
            first++;
        for (last = first;
             last < c->again.n && c->again.p[last] > 0.0 && c->again.zone[last] != RB_ZONE_STICK;)
            last++;
        const int slipping = last - first;
        if (slipping < UNRESOLVED)
            return RB_OK;
        allowed += 0.4 * (fabs(waves) + fabs(c->again.dissipation)) / slipping / slipping;
    }
    rb_certificate_expect(c, "hysteresis by waves", 0, printed, waves, allowed);
    return RB_OK;
}

/* The creepage of free rolling is that of another solution; but it is 0 where friction acts on
 * nothing else than itself, and friction drives towards it elsewhere. */
static void check_free_creepage(rb_certificate *c)
{
    const rb_rolling_case *rc = c->model.rc;
    const rb_contact_problem *p = &c->model.problem;
    const json_t *printed = json_object_get(c->summary, "free_creepage");
    const double free = rb_certificate_number(printed), xi = c->again.creepage,
                 Q = c->again.tangential_load;

    c->found->numbers++;
    if (rc->formulation != RB_STEADY || rb_rolling_largest_mu(rc) == 0.0) {
        if (!json_is_null(printed))
            rb_certificate_violated(c, "summary.free_creepage is missing, or should be null");
    } else if (!rb_contact_operator_response(p->op).coupled &&
               rb_norm_inf((size_t)p->n, p->d_T) == 0.0)
        rb_certificate_expect(c, "summary.free_creepage", 0, free, 0.0, 0.0);
    else if (!json_is_null(printed) && !json_is_number(printed))
        rb_certificate_violated(c, "summary.free_creepage is no number");
    else if (!rb_rolling_law_depends_on_state(rc) && fabs(Q) > 1e-6 * c->again.normal_load &&
             (free - xi) * Q < 0.0)
        rb_certificate_violated(c,
                                "summary.free_creepage: printed %.17g, which the friction at a "
                                "creepage of %.17g does not drive to",
                                free, xi);
}

static rb_status compare_results(rb_certificate *c)
{
    json_t *summary = rb_report_json_summary(&c->again);
    json_t *table =
        c->summary ? rb_report_json_table(&c->again) : rb_report_json_table_columns(&c->again);
    rb_status s = summary && table ? RB_OK : RB_ENOMEM;
    if (s == RB_OK) {
        if (c->summary)
            rb_certificate_compare(c, "summary", 0, c->summary, summary, slack_of_summary);
        const char *key;
        json_t *list;
        json_object_foreach((json_t *)table, key, list)
        {
            const json_t *printed = json_object_get(c->table, key);
            if (json_array_size(printed) != json_array_size(list))
                rb_certificate_violated(c, "%s: %zu numbers, expected %zu", key,
                                        json_array_size(printed), json_array_size(list));
            if (strcmp(key, "gap_mm") == 0)
                continue; /* the laws have it; p and q are those of the last step */
            /* Displacements are differences of larger ones; in static contact the slip, of
             * these. */
            const double most = largest(list);
            const int is_length = strcmp(key, "un_mm") == 0 || strcmp(key, "ut_mm") == 0;
            const int is_slip = strcmp(key, "slip") == 0;
            for (size_t i = 0; i < json_array_size(list); i++) {
                const double want = rb_certificate_number(json_array_get(list, i));
                rb_certificate_expect(c, key, (int)i + 1,
                                      rb_certificate_number(json_array_get(printed, i)), want,
                                      1e-9 * fabs(want) + 1e-11 * most +
                                          (is_length ? c->displacement
                                           : is_slip ? c->displacement / c->again.h[i]
                                           : strncmp(key, "temperature", 11) == 0 ? KELVIN
                                                                                  : 0.0));
            }
        }
        if (json_object_size(c->table) != json_object_size(table))
            rb_certificate_violated(c, "table: %zu columns, expected %zu",
                                    json_object_size(c->table), json_object_size(table));
        if (c->summary) {
            /* Which solver it was is not known, but which it may be and which was asked for. */
            const rb_contact_options *asked = &c->model.rc->contact;
            const char *solver = rb_certificate_word(c->summary, "solver");
            const char *form = rb_certificate_word(c->summary, "lcp_form");
            const char *pivoted = rb_case_word("lcp-form", RB_LCP_PIVOTED),
                       *kwak = rb_case_word("lcp-form", RB_LCP_KWAK);
            const int is_plain = strcmp(solver, rb_case_word("solver", RB_SOLVER_LEMKE)) == 0 ||
                                 strcmp(solver, rb_case_word("solver", RB_SOLVER_NEWTON)) == 0;

            if (!is_plain &&
                !(asked->solver == RB_SOLVER_CONE && strcmp(solver, asked->cone_solver.name) == 0))
                rb_certificate_violated(c, "summary.solver is none that this case may have");
            if (strcmp(form, kwak) != 0 && strcmp(form, pivoted) != 0)
                rb_certificate_violated(c, "summary.lcp_form is none");
            /* How the answer was found: of the right kind. */
            const json_t *steps = json_object_get(c->summary, "iterations");
            const json_t *seconds = json_object_get(c->summary, "seconds");
            json_t *time;
            if (!json_is_integer(steps) || json_integer_value(steps) < 0)
                rb_certificate_violated(c, "summary.iterations is no count");
            if (!json_is_object(seconds))
                rb_certificate_violated(c, "summary.seconds is missing, or holds no times");
            json_object_foreach((json_t *)seconds, key, time)
            {
                if (!(rb_certificate_number(time) >= 0.0))
                    rb_certificate_violated(c, "summary.seconds.%s is no time", key);
            }
            if (!rb_certificate_word(c->summary, "integrals")[0] ||
                !rb_certificate_word(c->summary, "openblas")[0])
                rb_certificate_violated(c, "summary.integrals or summary.openblas is missing");
            check_free_creepage(c);
        }
        rb_certificate_motion(c);
        s = check_hysteresis(c);
    }
    json_decref(summary);
    json_decref(table);
    return s;
}

rb_status rb_certificate_rebuild(rb_certificate *c, const rb_resolved_case *resolved, int n,
                                 rb_message *why)
{
    rb_rolling_model *m = &c->model;
    double *xh = rb_alloc((size_t)n, 2);
    rb_status s = xh ? RB_OK : RB_ENOMEM;

    if (s == RB_OK)
        s = rb_certificate_column(c->name, c->table, "x_mm", n, xh, why);
    if (s == RB_OK)
        s = rb_certificate_column(c->name, c->table, "h_mm", n, xh + n, why);
    if (c->summary)
        m->equal_instead = strcmp(rb_certificate_word(c->summary, "mesh"), "uniform") == 0;
    else { /* a table does not say whether its mesh could be fitted */
        m->equal_instead = 1;
        for (int i = 1; i < n && s == RB_OK; i++)
            m->equal_instead &= fabs(xh[n + i] - xh[n]) <= 1e-9 * xh[n];
    }
    const int are_equal = m->equal_instead || resolved->rc.mesh != RB_MESH_FITTED;
    for (int i = 0; i < n && s == RB_OK; i++)
        if (!(xh[n + i] > 0.0) || (i > 0 && !(xh[i] > xh[i - 1])))
            s = rb_fail(why, RB_EFORMAT, "%s: table: element %d is out of order", c->name, i + 1);
    if (s == RB_OK)
        s = rb_rolling_model_of_result(&resolved->rc, NULL,
                                       &(rb_rolling_elements){n, xh, xh + n, are_equal}, m, why);
    free(xh);
    if (s == RB_OK)
        s = read_state(c, why);
    return s == RB_OK ? rb_rolling_model_friction(&c->model, why) : s;
}

rb_status rb_certificate_assess(rb_certificate *c, double residual, rb_message *why)
{
    /* Load and force, and what was given of them. */
    const rb_contact_problem *p = &c->model.problem;
    const rb_contact_state *x = &c->model.state;
    const double P = weighted(p->n, p->load_N, x->p, p->load_T, x->q);
    const double Q = weighted(p->n, p->force_N, x->p, p->force_T, x->q);

    if (c->summary) {
        rb_certificate_expect(c, "normal_load", 0, rb_certificate_member(c->summary, "normal_load"),
                              P, 1e-13 * fabs(P));
        rb_certificate_expect(c, "tangential_load", 0,
                              rb_certificate_member(c->summary, "tangential_load"), Q,
                              1e-13 * fabs(P));
    }
    /* which ratios of the creepage take */
    c->model.half_width = P > 0.0 ? rb_rolling_contact_half_width(c->model.rc, P) : 0.0;
    if (c->model.rc->formulation == RB_STEADY && !p->load_given && !p->force_given &&
        !isnan(c->model.rc->creep_ratio))
        c->model.problem.xi = x->xi; /* as solving would have left it; its ratio is compared */
    rb_certificate_given(c, P);
    rb_status s = rb_rolling_model_solution(&c->model, &c->again, why);
    if (s != RB_OK)
        return s;
    rb_certificate_tolerances(c, residual);
    s = rb_certificate_laws(c);
    return s == RB_OK ? compare_results(c) : s;
}

rb_status rb_certificate_end(rb_certificate *c, rb_status s, rb_message *why)
{
    rb_rolling_solution_free(&c->again);
    rb_rolling_model_free(&c->model);
    if (s == RB_OK || s == RB_EFORMAT)
        return s;
    const rb_message reason = *why;
    return s == RB_ENOMEM
               ? rb_fail(why, s, "%s: out of memory", c->name)
               : rb_fail(why, RB_EFORMAT, "%s: cannot be checked: %s", c->name, reason.text);
}
