/* What a result stores: elements, tractions, zones, approach and motion, of each step where it has
 * several.  They are read, the model is built on them, and the rest follows as if it had been
 * solved. */
#include "program/certificate/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A few units in the last place: what printing, reading and adding up in another order make of a
 * number. */
static const double ROUNDING = 1e-15;

/* ---- Numbers ----------------------------------------------------------------------- */

double rb_certificate_moved(rb_certificate *c, double x)
{
    if (c->moving == 0)
        return x;
    c->moving = c->moving * 6364136223846793005u + 1442695040888963407u;
    return x * (1.0 + ROUNDING * (2.0 * (double)(c->moving >> 11) / 9007199254740992.0 - 1.0));
}

static rb_status read_list(rb_certificate *c, const json_t *list, const char *key, int n, double *x,
                           rb_message *why)
{
    if ((int)json_array_size(list) != n)
        return rb_fail(why, RB_EFORMAT, "%s: table: expected %d numbers in %s", c->name, n, key);
    for (int i = 0; i < n; i++) {
        const json_t *one = json_array_get(list, (size_t)i);
        if (!json_is_number(one))
            return rb_fail(why, RB_EFORMAT, "%s: table: %s of element %d is no number", c->name,
                           key, i + 1);
        x[i] = rb_certificate_moved(c, json_number_value(one));
    }
    return RB_OK;
}

rb_status rb_certificate_list(rb_certificate *c, const json_t *object, const char *key, int n,
                              double *x, rb_message *why)
{
    return read_list(c, json_object_get(object, key), key, n, x, why);
}

rb_status rb_certificate_lists(rb_certificate *c, const json_t *object, const char *key, int steps,
                               int n, size_t apart, double *x, rb_message *why)
{
    const json_t *lists = json_object_get(object, key);
    rb_status s = RB_OK;

    if ((int)json_array_size(lists) != steps)
        return rb_fail(why, RB_EFORMAT, "%s: expected %d steps in %s", c->name, steps, key);
    for (int k = 0; k < steps && s == RB_OK; k++)
        s = read_list(c, json_array_get(lists, (size_t)k), key, n, x + (size_t)k * apart, why);
    return s;
}

rb_status rb_certificate_zones(rb_certificate *c, const json_t *object, const char *key, int steps,
                               int n, int most, int *zone, rb_message *why)
{
    const json_t *lists = json_object_get(object, key);

    if (steps > 0 && (int)json_array_size(lists) != steps)
        return rb_fail(why, RB_EFORMAT, "%s: expected %d steps in %s", c->name, steps, key);
    for (int k = 0; k < (steps > 0 ? steps : 1); k++) {
        const json_t *list = steps > 0 ? json_array_get(lists, (size_t)k) : lists;
        if ((int)json_array_size(list) != n)
            return rb_fail(why, RB_EFORMAT, "%s: table: expected %d numbers in %s", c->name, n,
                           key);
        for (int i = 0; i < n; i++) {
            const json_t *one = json_array_get(list, (size_t)i);
            const double value = json_number_value(one);
            if (!json_is_number(one) || !(value >= 0.0 && value <= most) || value != floor(value))
                return rb_fail(why, RB_EFORMAT, "%s: table: zone of element %d is %g", c->name,
                               i + 1, json_is_number(one) ? value : (double)NAN);
            zone[(size_t)k * (size_t)n + (size_t)i] = (int)value;
        }
    }
    return RB_OK;
}

double rb_certificate_stored(rb_certificate *c, const json_t *object, const char *key)
{
    return rb_certificate_moved(c, rb_certificate_member(object, key));
}

/* ---- A state ----------------------------------------------------------------------- */

/* Gaps and shifts of the state's tractions at an approach and a motion: w, 2 n. */
static void kinematics_at(const rb_rolling_model *m, double delta, double xi, double *w)
{
    rb_contact_state at = m->state;
    at.delta = delta;
    at.xi = xi;
    rb_contact_kinematics(&m->problem, &at, w, w + m->problem.n);
}

/* The factor of a for which r - factor a is least, in the sense of least squares. */
static double best_factor(size_t n, const double *a, const double *r)
{
    double aa = 0.0, ar = 0.0;
    for (size_t i = 0; i < n; i++) {
        aa += a[i] * a[i];
        ar += a[i] * r[i];
    }
    return ar / aa;
}

/* Of a table, which prints neither: gaps and shifts are linear in approach and motion.  What is
 * given is taken as it is. */
static rb_status fit_motion(rb_certificate *c, const json_t *table, rb_rolling_model *m,
                            rb_message *why)
{
    const rb_contact_problem *p = &m->problem;
    rb_contact_state *x = &m->state;
    const size_t n = (size_t)p->n;
    double *w = rb_alloc(n, 6);
    if (!w)
        return RB_ENOMEM;
    double *unit = w + 2 * n, *printed = w + 4 * n;
    const rb_status s = rb_certificate_list(c, table, "gap_mm", p->n, printed, why);
    memcpy(printed + n, x->lambda, n * sizeof *printed);
    x->xi = p->xi;
    x->delta = p->delta;
    kinematics_at(m, 0.0, 0.0, w);
    for (size_t i = 0; i < 2 * n; i++)
        printed[i] -= w[i];
    if (p->load_given) {
        kinematics_at(m, 1.0, 0.0, unit);
        for (size_t i = 0; i < n; i++)
            unit[i] -= w[i];
        x->delta = best_factor(n, unit, printed);
    }
    if (p->force_given || !isnan(m->rc->creep_ratio)) {
        kinematics_at(m, 0.0, 1.0, unit);
        for (size_t i = n; i < 2 * n; i++)
            unit[i] -= w[i];
        x->xi = best_factor(n, unit + n, printed + n);
    }
    free(w);
    return s;
}

/* Plastic slips from what has yielded, u, against the friction, or against the slip where the
 * interface has softened to nothing. */
static void set_plastic(const rb_contact_problem *p, rb_contact_state *state)
{
    double *u = state->plastic;
    for (int i = 0; i < p->n; i++) {
        const double next = i + 1 < p->n ? u[i + 1] : 0.0, second = i + 2 < p->n ? u[i + 2] : 0.0;
        const double own = (u[i] - p->recall[0] * next - p->recall[1] * second) / p->own;
        const double with = state->q[i] != 0.0 ? -state->q[i] : state->lambda[i];
        u[i] = with < 0.0 ? -own : own;
    }
}

static rb_status read_state(rb_certificate *c, const rb_certificate_contact *stored,
                            rb_rolling_model *m, rb_message *why)
{
    const int n = m->mesh.n, yields = m->problem.yield != NULL;
    rb_contact_state *x = &m->state;
    rb_status s = rb_certificate_list(c, stored->table, "p_MPa", n, x->p, why);

    if (s == RB_OK)
        s = rb_certificate_list(c, stored->table, "q_MPa", n, x->q, why);
    if (s == RB_OK)
        s = rb_certificate_zones(c, stored->table, "zone", 0, n, yields ? 5 : 3, x->zone, why);
    if (s == RB_OK)
        s = rb_certificate_list(c, stored->table, "shift_mm", n, x->lambda, why);
    if (s == RB_OK && yields)
        s = rb_certificate_list(c, stored->table, "plastic_mm", n, x->plastic, why);
    if (s == RB_OK && yields)
        set_plastic(&m->problem, x);
    if (s != RB_OK || !stored->summary)
        return s == RB_OK ? fit_motion(c, stored->table, m, why) : s;
    x->delta = rb_certificate_stored(c, stored->summary, "approach");
    x->xi = rb_certificate_stored(
        c, stored->summary, m->rc->formulation == RB_STATIC ? "tangential_shift" : "creepage");
    if (!(isfinite(x->delta) && isfinite(x->xi)))
        s = rb_fail(why, RB_EFORMAT, "%s: summary: no approach, shift or creepage", c->name);
    return s;
}

/* ---- One step ---------------------------------------------------------------------- */

/* On the elements of the table. */
static rb_status restore_step(rb_certificate *c, const rb_resolved_case *resolved,
                              const rb_certificate_contact *stored, int n, rb_case_result *r,
                              rb_message *why)
{
    rb_rolling_model *m = &r->model;
    double *xh = rb_alloc((size_t)n, 2);
    rb_status s = xh ? RB_OK : RB_ENOMEM;

    if (s == RB_OK)
        s = rb_certificate_list(c, stored->table, "x_mm", n, xh, why);
    if (s == RB_OK)
        s = rb_certificate_list(c, stored->table, "h_mm", n, xh + n, why);
    if (stored->summary)
        m->equal_instead = strcmp(rb_certificate_word(stored->summary, "mesh"), "uniform") == 0;
    else { /* a table does not say it */
        const int instead = rb_rolling_equal_elements_instead(resolved->rc.contact_elements);
        m->equal_instead = resolved->rc.mesh == RB_MESH_FITTED ||
                           (resolved->rc.mesh == RB_MESH_ALIGNED && n == instead);
        for (int i = 1; i < n && s == RB_OK; i++)
            m->equal_instead &= fabs(xh[n + i] - xh[n]) <= 1e-9 * xh[n];
    }
    const int are_equal = m->equal_instead || !rb_rolling_mesh_is_graded(&resolved->rc);
    for (int i = 0; i < n && s == RB_OK; i++)
        if (!(xh[n + i] > 0.0) || (i > 0 && !(xh[i] > xh[i - 1])))
            s = rb_fail(why, RB_EFORMAT, "%s: table: element %d is out of order", c->name, i + 1);
    if (s == RB_OK)
        s = rb_rolling_model_of_result(&resolved->rc, NULL,
                                       &(rb_rolling_elements){n, xh, xh + n, are_equal}, m, why);
    free(xh);
    if (s == RB_OK)
        s = read_state(c, stored, m, why);
    if (s == RB_OK)
        s = rb_rolling_model_friction(m, why);
    if (s != RB_OK)
        return s;
    /* As solving would have left it. */
    const double P = rb_rolling_model_load(m);
    m->half_width = P > 0.0 ? rb_rolling_contact_half_width(m->rc, P) : 0.0;
    if (m->rc->formulation == RB_STEADY && !m->problem.load_given && !m->problem.force_given &&
        !isnan(m->rc->creep_ratio))
        m->problem.xi = m->state.xi;
    if (c->judges) {
        c->model = m;
        rb_certificate_tolerances(c, stored->residual);
        s = rb_certificate_laws(c);
        if (s == RB_OK)
            s = rb_certificate_prove(c);
    }
    return s;
}

/* ---- A sequence of steps ----------------------------------------------------------- */

typedef struct {
    rb_certificate *c;
    const rb_resolved_case *resolved;
    const json_t *residual;        /* printed, an entry per step */
    rb_rolling_study_notes *notes; /* on the steps before the last */
    rb_status status;
    rb_message *why;
} step_check;

static int judge_step(const rb_rolling_model *model, const rb_rolling_history *h, int step,
                      int steps, void *context)
{
    step_check *j = context;
    rb_certificate *c = j->c;

    (void)h;
    j->status =
        rb_rolling_note_step(j->notes, &j->resolved->rc, RB_UNITS_MM, model, step, steps, j->why);
    if (!c->judges || j->status != RB_OK)
        return j->status != RB_OK;
    c->step = step + 1;
    c->model = model;
    rb_certificate_tolerances(c, json_number_value(json_array_get(j->residual, (size_t)step)));
    j->status = rb_certificate_laws(c);
    if (j->status == RB_OK)
        j->status = rb_certificate_prove(c);
    c->step = 0;
    return j->status != RB_OK;
}

/* Follows the steps by their states and leaves the model at the last one. */
static rb_status follow_steps(rb_certificate *c, const rb_resolved_case *resolved,
                              const rb_certificate_contact *stored, int n, rb_case_result *r,
                              rb_rolling_states *to, rb_message *why)
{
    const json_t *history = stored->history, *states = json_object_get(history, "states");
    const int steps = (int)json_array_size(json_object_get(history, "approach"));
    step_check j = {
        .c = c, .resolved = resolved, .residual = json_object_get(history, "residual"), .why = why};
    const rb_rolling_observer observer = {judge_step, &j};

    if (steps < 1)
        return rb_certificate_refuse(c, "no steps", why);
    j.notes = r->of_steps = calloc(1, sizeof *r->of_steps);
    if (!r->of_steps)
        return RB_ENOMEM;
    rb_status s = rb_rolling_states_alloc(n, steps, to);
    const struct {
        const json_t *of;
        const char *key;
        int n; /* 0: a list of all elements for each step */
        double *to;
    } parts[] = {{stored->table, "x_mm", n, to->x},
                 {stored->table, "h_mm", n, to->h},
                 {states, "p_MPa", 0, to->p},
                 {states, "q_MPa", 0, to->q},
                 {states, "shift_mm", 0, to->lambda},
                 {states, "plastic_mm", 0, to->plastic},
                 {history, "approach", steps, to->delta},
                 {states, "motion", steps, to->xi}};
    for (size_t k = 0; k < sizeof parts / sizeof *parts && s == RB_OK; k++) {
        const char *key = parts[k].key;
        if (parts[k].to == to->plastic && !json_object_get(states, key))
            continue; /* nothing yields */
        s = parts[k].n > 0
                ? rb_certificate_list(c, parts[k].of, key, parts[k].n, parts[k].to, why)
                : rb_certificate_lists(c, parts[k].of, key, steps, n, (size_t)n, parts[k].to, why);
    }
    if (s == RB_OK)
        s = rb_certificate_zones(c, states, "zone", steps, n, 5, to->zone, why);
    for (int k = 0; k < steps && s == RB_OK; k++) {
        const json_t *one = json_array_get(json_object_get(history, "substeps"), (size_t)k);
        to->substeps[k] = (int)json_integer_value(one);
        if (!json_is_integer(one) || !(json_integer_value(one) >= 1) ||
            json_integer_value(one) > RB_ROLLING_MOST_STEPS)
            s = rb_fail(why, RB_EFORMAT, "%s: history: substeps of row %d are none", c->name,
                        k + 1);
    }
    to->half_width = rb_certificate_member(history, "half_width");
    /* what more or fewer steps would give is not known; the jump itself is computed again */
    if (json_object_get(history, "row_changed")) {
        to->rows.changes = rb_certificate_member(history, "row_changes");
        to->rows.changed = (int)json_integer_value(json_object_get(history, "row_changed"));
    }
    to->rows.jumped = (int)json_integer_value(json_object_get(history, "jump_row"));
    to->program = resolved->program.n > 0 ? &resolved->program : NULL;
    if (s == RB_OK)
        s = rb_rolling_history_follow(&resolved->rc, to, &observer, &r->model, &r->history, why);
    return j.status != RB_OK ? j.status : s;
}

/* ---- The result -------------------------------------------------------------------- */

/* How the answer was found, which nothing but finding it would tell: times, counts, the solver, as
 * far as they can be. */
static void take_over(const json_t *summary, const rb_rolling_model *m, rb_rolling_solution *s)
{
    const json_t *seconds = json_object_get(summary, "seconds"),
                 *iterations = json_object_get(summary, "iterations");
    const rb_contact_options *asked = &m->rc->contact;
    const char *solver = rb_certificate_word(summary, "solver"),
               *form = rb_certificate_word(summary, "lcp_form");

    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        const double time = rb_certificate_member(seconds, r->name);
        if (r->kind == RB_RESULT_SECONDS)
            rb_rolling_set_number(r, s, time >= 0.0 ? time : 0.0);
    }
    s->iterations = json_integer_value(iterations) > 0 ? (int)json_integer_value(iterations) : 0;
    s->solver = strcmp(solver, rb_case_word("solver", RB_SOLVER_LEMKE)) == 0 ? RB_SOLVER_LEMKE
                : asked->solver == RB_SOLVER_CONE && strcmp(solver, asked->cone_solver.name) == 0
                    ? RB_SOLVER_CONE
                    : RB_SOLVER_NEWTON;
    s->lcp_form =
        strcmp(form, rb_case_word("lcp-form", RB_LCP_KWAK)) == 0 ? RB_LCP_KWAK : RB_LCP_PIVOTED;
    s->status = RB_OK;
}

/* Results that are nothing but rounding follow from no number that is stored: each moves by a
 * rounding of what results of its unit usually are, and errors that are shares by one of 1. */
static void move_results(const rb_rolling_results *table, const rb_rolling_case *rc, int rows,
                         void *owner)
{
    for (int k = 0; k < table->n; k++) {
        const rb_rolling_result *r = &table->row[k];
        const double by = r->no_derivative && !r->unit
                              ? 1e-15
                              : 1e-4 * rb_sensitivity_rounding(rc, r, 0.0); /* 1e-15 of it */
        if (r->kind != RB_RESULT_NUMBER)
            continue;
        if (rows == 0)
            rb_rolling_set_number(r, owner, rb_rolling_number(r, owner) + by);
        for (int i = 0; i < rows && rb_rolling_has_column(r, owner); i++)
            rb_rolling_column(r, owner)[i] += by;
    }
}

/* The case on the elements that --accuracy has ended with, which cannot be fewer than asked for nor
 * more than the table has: *resolved, or the one that c keeps. */
static rb_status take_mesh(rb_certificate *c, const rb_certificate_contact *stored, int n,
                           const rb_resolved_case **resolved, rb_message *why)
{
    static const double FINEST = 32.0; /* boundary of a wheel */

    if (!((*resolved)->accuracy > 0.0))
        return RB_OK;
    if (isnan(stored->elements))
        return rb_certificate_refuse(c, "summary.accuracy_elements is missing", why);
    if (!(stored->elements >= (*resolved)->rc.contact_elements && stored->elements <= n &&
          stored->elements == floor(stored->elements)))
        return rb_fail(why, RB_EFORMAT, "%s: accuracy_elements: expected %d to %d, got %.9g",
                       c->name, (*resolved)->rc.contact_elements, n, stored->elements);
    if (!isnan(stored->boundary) && !(stored->boundary >= 1.0 && stored->boundary <= FINEST))
        return rb_fail(why, RB_EFORMAT, "%s: accuracy_boundary: expected 1 to %g, got %.9g",
                       c->name, FINEST, stored->boundary);
    c->of_mesh = **resolved;
    c->of_mesh.rc.contact_elements = (int)stored->elements;
    c->of_mesh.rc.outer_refinement = isnan(stored->boundary) ? 0.0 : stored->boundary;
    *resolved = &c->of_mesh;
    return RB_OK;
}

rb_status rb_certificate_restore(rb_certificate *c, const rb_resolved_case *resolved,
                                 const rb_certificate_contact *stored, rb_case_result *r,
                                 rb_rolling_states *states, rb_message *why)
{
    const int n = (int)json_array_size(json_object_get(stored->table, "x_mm"));

    if (n < 3)
        return rb_certificate_refuse(c, "its table has no elements", why);
    c->proves = c->judges && (c->found->prove || json_object_get(stored->summary, "proof"));
    rb_status s = take_mesh(c, stored, n, &resolved, why);
    const rb_rolling_case *rc = &resolved->rc;
    if (s == RB_OK)
        s = stored->history ? follow_steps(c, resolved, stored, n, r, states, why)
                            : restore_step(c, resolved, stored, n, r, why);
    if (s == RB_OK)
        s = rb_rolling_model_solution(&r->model, &r->solution, why);
    if (s == RB_OK && resolved->accuracy > 0.0)
        rb_rolling_set_accuracy(rc, &r->solution);
    /* The creepage of free rolling is that of another solution, found as the solve has found it. */
    if (s == RB_OK && stored->summary && rc->formulation == RB_STEADY &&
        rb_rolling_largest_mu(rc) > 0.0 && n >= rc->contact_elements) {
        rb_message unsolved;
        double *creepage = &r->solution.free_creepage;
        const rb_status free_rolling = rb_rolling_free_creepage(&r->model, creepage, &unsolved);
        *creepage = free_rolling == RB_OK ? *creepage : (double)NAN;
        s = free_rolling == RB_ENOMEM ? free_rolling : RB_OK;
    }
    /* so are the strips of an ellipse */
    if (s == RB_OK && stored->summary)
        s = rb_rolling_solve_strips(&r->model, &r->solution.ellipse_force, why);
    if (s == RB_OK && stored->summary)
        take_over(stored->summary, &r->model, &r->solution);
    if (s == RB_OK && c->moving > 0) {
        move_results(&rb_rolling_solution_scalars, r->model.rc, 0, &r->solution);
        if (r->history.n > 0)
            move_results(&rb_rolling_history_columns, r->model.rc, r->history.n, &r->history);
    }
    if (s == RB_OK && c->judges)
        s = rb_certificate_balances(c, &r->solution);
    return s;
}
