/* Derivatives after every step of a history (theory-solvers.md, D7). */
#include "analysis/sensitivity/derivatives.h"
#include "analysis/sensitivity/sensitivity.h"
#include "rolling/case/words.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* A number, and the history at values of it nearby, whose states lie along the tangent. */
typedef struct {
    const rb_case_number *number;
    double step;
    rb_sensitivity_stencil of;
    rb_rolling_follower *at[RB_SENSITIVITY_PLACES];
    rb_rolling_model *model[RB_SENSITIVITY_PLACES]; /* theirs */
    rb_sensitivity_rate left, rate; /* what one of them leaves; by how much all differ */
    rb_contact_state tangent;
    rb_sensitivity_at_elements *picked; /* a derivative for each step; owned */
} varied;

/* What the steps allow. */
typedef struct {
    int rows;          /* that have derivatives: those before the first that has none */
    int *is_arbitrary; /* steps: 1: the motion of this step is, because everything slides at
                         Q = +-mu P; borrowed */
    int moved;         /* the first of them; steps: none */
} allowed;

/* The elements of bodies that relax and roll are steps of the way. */
static int elements_are_steps(const rb_rolling_case *rc)
{
    return rb_rolling_relaxes(rc) && rc->formulation != RB_STATIC;
}

/* What the elements grow with, under the largest load: the unit of the way, or the zone, which
 * holds what has relaxed. */
static double unit_of_elements(const rb_rolling_case *rc, const rb_rolling_program *program)
{
    const rb_rolling_case relaxed = rb_rolling_memory_case(rc, INFINITY);
    double load = rb_rolling_derive(rc).load;

    for (int k = 0; program && program->load && k < program->n; k++)
        load = k > 0 ? fmax(load, program->load[k]) : program->load[k];
    return elements_are_steps(rc) ? rb_rolling_unit_of_distance(rc, load)
                                  : rb_rolling_zone_half_width(&relaxed, load);
}

static void followers_free(varied *v)
{
    for (int k = 0; k < RB_SENSITIVITY_PLACES; k++) {
        rb_rolling_follower_free(v->at[k]);
        v->at[k] = NULL;
    }
}

/* 1: elements grow with their unit; those of an automatic zone under a table of the gap,
 * whose search no closed form tells, stay as those of a given zone do. */
static int elements_grow(const rb_rolling_case *rc)
{
    return (rc->zone == 0.0 && rc->gap != RB_GAP_TABLE && rc->worn.n == 0) ||
           elements_are_steps(rc);
}

/* RB_INACCURATE: elements outside the contact go from one side of it to the other. */
static rb_status follow_all(const rb_case *c, const rb_rolling_states *states,
                            rb_rolling_follower *base, varied *v, rb_message *why)
{
    const rb_sensitivity_input *input = &v->number->input;
    const rb_rolling_case *rc = &c->resolved.rc;
    const int grow = elements_grow(rc);
    rb_status s = RB_OK;

    for (int k = 0; k < v->of.n && s == RB_OK; k++) {
        rb_rolling_case at;
        s = input->vary(input->context, input->value + v->of.place[k] * v->step, &at, why);
        if (s == RB_OK)
            s = rb_rolling_follower_create(&at, states, base,
                                           grow ? unit_of_elements(&at, states->program) /
                                                      unit_of_elements(rc, states->program)
                                                : 1.0,
                                           &v->at[k], why);
        v->model[k] = s == RB_OK ? rb_rolling_follower_model(v->at[k]) : NULL;
        if (s == RB_OK && !rb_rolling_same_sides(rb_rolling_follower_model(base), v->model[k]))
            s = rb_fail(why, RB_INACCURATE,
                        "derivatives: the elements outside the contact change with %s",
                        v->number->name);
    }
    return s;
}

/* The four histories at values beside the number, with the longest step for which the elements stay
 * on their sides of the contact.  Free v in any case. */
static rb_status vary_history(const rb_case *c, const rb_rolling_states *states,
                              rb_rolling_follower *base, varied *v, rb_message *why)
{
    enum { TRIALS = 3 };
    const rb_sensitivity_input *input = &v->number->input;
    const rb_rolling_case *rc = &c->resolved.rc;
    rb_rolling_case at;
    rb_status s = rb_sensitivity_rate_alloc(states->n, &v->rate);

    if (s == RB_OK)
        s = rb_sensitivity_rate_alloc(states->n, &v->left);
    if (s == RB_OK)
        s = rb_contact_state_alloc(states->n, &v->tangent);
    if (s == RB_OK && !(v->picked = calloc((size_t)states->steps, sizeof *v->picked)))
        s = RB_ENOMEM;
    if (s != RB_OK)
        return s;
    /* A change of bodies is known to fewer digits than one of the right side, and needs a longer
     * step. */
    v->step = RB_SENSITIVITY_STEP_OF_BODIES * input->scale;
    const rb_sensitivity_stencil *stencil = rb_sensitivity_stencil_of(input, v->step);
    if (stencil)
        s = input->vary(input->context, input->value + stencil->place[stencil->n - 1] * v->step,
                        &at, why);
    if (s != RB_OK)
        return s;
    /* powers and slips that are nearly 0 have kinks nearby */
    if (stencil && rb_rolling_same_bodies(&at, rc) &&
        (!elements_grow(rc) ||
         unit_of_elements(&at, states->program) == unit_of_elements(rc, states->program))) {
        v->step = RB_SENSITIVITY_STEP * input->scale;
        stencil = rb_sensitivity_stencil_of(input, v->step);
    }
    if (!stencil)
        return rb_fail(why, RB_EINVAL, "derivatives: %s cannot vary within its range",
                       v->number->name);
    v->of = *stencil;
    s = follow_all(c, states, base, v, why);
    for (int k = 1; k < TRIALS && s == RB_INACCURATE; k++) {
        followers_free(v);
        v->step *= 0.1;
        s = follow_all(c, states, base, v, why);
    }
    return s;
}

static void varied_free(varied *v)
{
    followers_free(v);
    rb_sensitivity_rate_free(&v->left);
    rb_sensitivity_rate_free(&v->rate);
    rb_contact_state_free(&v->tangent);
    free(v->picked);
}

/* The equations of the step at the four values change at the state that is there also by
 * what the states before, which have moved, left to them; that gives the tangent along
 * which the state of this step moves. */
static rb_status differentiate_step(const rb_sensitivity *s, rb_rolling_model *base, varied *v,
                                    rb_message *why)
{
    const int holds = !base->problem.force_given;

    /* rate sums the four left sides with the weights of the stencil: -R' of (D2), to fourth
     * order. */
    memset(v->rate.gap, 0, 4 * (size_t)v->rate.n * sizeof *v->rate.gap);
    v->rate.normal = v->rate.tangential = 0.0;
    for (int k = 0; k < v->of.n; k++) {
        rb_rolling_model *at = v->model[k];
        rb_status status = rb_rolling_follower_begin(v->at[k], why);

        if (status != RB_OK)
            return status;
        /* An equation for the force where the base has none would be another system. */
        if (holds)
            at->problem.force_given = 0;
        rb_rolling_variant_set(&base->state, NULL, 0.0, &at->state);
        status =
            rb_sensitivity_add_variant(s, at, v->of.weight[k] / v->step, &v->left, &v->rate, why);
        if (status != RB_OK)
            return status;
    }
    rb_status status = rb_sensitivity_tangent(s, &v->rate, 1, &v->tangent, why);
    for (int k = 0; k < v->of.n; k++) {
        rb_rolling_model *at = v->model[k];

        if (status != RB_OK)
            return status;
        rb_rolling_variant_set(&base->state, &v->tangent, v->of.place[k] * v->step, &at->state);
        status = rb_rolling_variant_complete(at, NULL, NULL, why);
        if (status == RB_OK)
            status = rb_sensitivity_set_law(s, at, why);
        if (status == RB_OK)
            rb_rolling_follower_end(v->at[k]);
    }
    return status;
}

/* Whether a given force finds everything sliding by Coulomb's law: then no motion is its. */
static int slides_under_force(const rb_rolling_model *model)
{
    const rb_contact_state *state = &model->state;
    int contact = 0, slides = 0;

    for (int i = 0; i < state->n; i++) {
        contact += state->zone[i] != RB_ZONE_SEPARATED;
        slides +=
            state->zone[i] == RB_ZONE_SLIP_NEGATIVE || state->zone[i] == RB_ZONE_SLIP_POSITIVE;
    }
    return model->problem.force_given && contact > 0 && slides == contact &&
           rb_rolling_largest_mu(model->rc) > 0.0 && !rb_rolling_law_depends_on_state(model->rc);
}

/* A step without derivatives ends those of the rows: the ones before it have theirs. */
static rb_status all_steps(const rb_rolling_states *states, rb_rolling_follower *base, int n,
                           varied *v, rb_case_slopes *slopes, allowed *can, rb_message *why)
{
    rb_rolling_model *model = rb_rolling_follower_model(base);

    for (int step = 0; step < states->steps;) {
        /* A step of the base history: its state is the given one at the end of a row, and is solved
         * inside. */
        rb_sensitivity *s = NULL;
        rb_message reason = {.text = ""};
        rb_status status = rb_rolling_follower_begin(base, &reason);
        const int ends_row = rb_rolling_follower_ends_row(base);
        if (ends_row)
            rb_rolling_states_get(states, step, &model->state);
        /* the states were found with what is compressed less closely; inside a row there are
         * none */
        if (status == RB_OK)
            status = !ends_row || rb_rolling_is_compressed(model)
                         ? rb_rolling_follower_solve(base, &reason)
                         : rb_rolling_model_friction(model, &reason);
        if (status == RB_OK && slides_under_force(model)) {
            /* All of mu P, if it is given as such, changes with it at any motion, also at one at
             * which the slowest element slides, too; a given force would be more than friction
             * carries. */
            double more = 0.0;
            for (int i = 0; i < model->state.n; i++)
                more = fmax(more, fabs(model->state.lambda[i] / model->problem.e_T[i]));
            more = rb_rolling_model_force(model) > 0.0 ? -more : more;
            if (!isnan(model->rc->force) || model->problem.axle != 0.0)
                status =
                    rb_fail(&reason, RB_SINGULAR,
                            "the whole contact slides under the given force; with less friction "
                            "or load there is no solution, and this and all later rows have no "
                            "derivative; a given force-ratio has them");
            model->problem.force_given = 0;
            model->state.xi += more;
            for (int i = 0; i < model->state.n; i++)
                model->state.lambda[i] += more * model->problem.e_T[i];
            can->is_arbitrary[step] = 1;
            can->moved = step < can->moved ? step : can->moved;
        }
        if (status == RB_OK)
            status = rb_sensitivity_create(model, 0, &s, &reason);
        if (status == RB_OK)
            slopes->degenerate += ends_row && rb_sensitivity_degenerate(s) > 0;
        for (int k = 0; k < n && status == RB_OK; k++)
            /* Each number moves its four histories along its own tangent, so that the next step
             * starts from there. */
            status = rb_interrupted() ? rb_fail(why, RB_INTERRUPTED,
                                                "derivatives: interrupted after step %d of %d",
                                                step, states->steps)
                                      : differentiate_step(s, model, &v[k], &reason);
        if (status == RB_OK)
            rb_rolling_follower_end(base);
        for (int k = 0; k < n && status == RB_OK; k++)
            status = rb_sensitivity_differentiate_at_elements(s, &v[k].number->input, &v[k].of,
                                                              v[k].step, v[k].model, &v[k].tangent,
                                                              &v[k].picked[step]);
        rb_sensitivity_free(s);
        if (status == RB_INTERRUPTED)
            return status;
        if (status == RB_ENOMEM || (status != RB_OK && step == 0))
            return rb_fail(why, status, "derivatives: row %d of the history: %.400s", step + 1,
                           rb_status_reason(status, &reason));
        if (status != RB_OK) {
            rb_fail(&slopes->reason, status, "from row %d on: %.400s", step + 1,
                    rb_status_reason(status, &reason));
            return RB_OK;
        }
        step += ends_row;
        can->rows = step;
    }
    return RB_OK;
}

/* 1: a result of the motion alone, which nothing determines in that row; a shift is that of all
 * rows up to it. */
static int is_undetermined(const allowed *can, const rb_rolling_result *r, int row)
{
    return row >= can->rows ||
           (can->is_arbitrary[row] && (r->offset == offsetof(rb_rolling_history, creepage) ||
                                       r->offset == offsetof(rb_rolling_history, dissipation))) ||
           (row >= can->moved && r->offset == offsetof(rb_rolling_history, shift));
}

/* Of a column after a step, from the histories at the four values. */
static double slope_of(const varied *v, const allowed *can, const rb_rolling_result *r, int row)
{
    if (is_undetermined(can, r, row))
        return NAN;
    const rb_sensitivity_at_elements *picked = &v->picked[row];
    double sum = 0.0, at = 0.0;

    for (int i = 0; i < v->of.n; i++) {
        at = rb_rolling_entry(r, rb_rolling_follower_history(v->at[i]), row);
        sum += v->of.weight[i] / v->step * at;
    }
    /* Edges and peaks jump from element to element; their derivatives are those at the elements
     * that have them. */
    sum = r->offset == offsetof(rb_rolling_history, contact_from)      ? picked->contact_from
          : r->offset == offsetof(rb_rolling_history, contact_to)      ? picked->contact_to
          : r->offset == offsetof(rb_rolling_history, max_pressure)    ? picked->max_pressure
          : r->offset == offsetof(rb_rolling_history, max_temperature) ? picked->max_temperature
                                                                       : sum;
    const rb_rolling_case *rc = v->model[0]->rc;
    return fabs(sum) * v->number->input.scale < rb_sensitivity_rounding(rc, r, at) ? 0.0 : sum;
}

/* Standard deviations of all columns that the history has; without memory it has none. */
static rb_status take_deviations(const rb_case_tolerances *t, const varied *v, int n,
                                 const allowed *can, rb_rolling_history *history)
{
    rb_rolling_history *d = history->deviations = calloc(1, sizeof *d);

    if (!d)
        return RB_ENOMEM;
    d->n = history->n;
    for (int k = 0; k < rb_rolling_history_columns.n; k++) {
        const rb_rolling_result *r = &rb_rolling_history_columns.row[k];
        double **column = (double **)(void *)((char *)d + r->offset);
        if (!rb_sensitivity_has(r) || !rb_rolling_has_column(r, history))
            continue;
        if (!(*column = rb_alloc((size_t)d->n, 1))) {
            rb_rolling_history_free(d);
            free(d);
            history->deviations = NULL;
            return RB_ENOMEM;
        }
        for (int j = 0; j < n; j++)
            for (int i = 0; i < t->n; i++)
                for (int row = 0; row < d->n && strcmp(t->name[i], v[j].number->name) == 0; row++)
                    (*column)[row] =
                        hypot((*column)[row], t->deviation[i] * slope_of(&v[j], can, r, row));
    }
    return RB_OK;
}

static rb_status check_elements(int n, rb_message *why)
{
    return n < RB_ROLLING_LARGE
               ? RB_OK
               : rb_refuse(
                     why, "contact-elements,mesh",
                     "derivatives of a history need a matrix: expected fewer than %d elements",
                     RB_ROLLING_LARGE);
}

rb_status rb_case_slopes_check_steps(const rb_case *c, rb_message *why)
{
    const rb_rolling_case *rc = &c->resolved.rc;

    if (isnan(rb_rolling_derive(rc).load) &&
        !(c->resolved.program.n > 0 && c->resolved.program.load))
        return rb_refuse(why, "approach",
                         "derivatives of a history: under a given approach the unit of "
                         "its distances depends on the solution; give a load");
    return elements_are_steps(rc) ? RB_OK : check_elements(rc->contact_elements, why);
}

/* Derivatives and deviations of every row: of the base history and of four others per number,
 * followed side by side. */
rb_status rb_case_slopes_of_steps(const rb_case *c, const rb_rolling_states *states,
                                  rb_case_slopes *s, const rb_case_tolerances *t,
                                  rb_rolling_history *history, rb_message *why)
{
    const char *name[RB_CASE_NUMBERS_MAX];
    const rb_rolling_case *rc = &c->resolved.rc;
    rb_case_slopes none = {0};
    rb_arena scratch = {0};
    rb_rolling_follower *base = NULL;
    int numbers = 0, n = 0;

    rb_status status = rb_case_slopes_check_steps(c, why);
    if (status == RB_OK)
        status = check_elements(states->n, why);
    if (status != RB_OK)
        return status;
    s = s ? s : &none;
    s->stay = rc->zone == 0.0 && !elements_grow(rc);
    int asked = rb_case_slope_inputs(s, name);
    for (int i = 0; t && i < t->n; i++)
        asked = rb_case_add_name(name, asked, t->name[i]);
    rb_case_number *number = rb_arena_zeros(&scratch, RB_CASE_NUMBERS_MAX, sizeof *number);
    varied *v = rb_arena_zeros(&scratch, RB_CASE_NUMBERS_MAX, sizeof *v);
    allowed can = {.moved = states->steps,
                   .is_arbitrary =
                       rb_arena_zeros(&scratch, (size_t)states->steps, sizeof *can.is_arbitrary)};
    if (scratch.failed)
        return rb_fail(why, rb_arena_done(&scratch, RB_ENOMEM), "out of memory for derivatives");
    status = rb_case_numbers(c, number, &numbers, why);
    if (status == RB_OK)
        status = rb_rolling_follower_create(rc, states, NULL, 1.0, &base, why);
    for (int k = 0; k < numbers; k++)
        for (int j = 0; j < asked && status == RB_OK; j++)
            if (strcmp(number[k].name, name[j]) == 0) {
                v[n].number = &number[k];
                status = vary_history(c, states, base, &v[n++], why);
            }
    if (status == RB_OK)
        status = all_steps(states, base, n, v, s, &can, why);
    if (status == RB_OK && s->n > 0 && rb_case_slopes_alloc(states->steps, s) != RB_OK)
        status = rb_fail(why, RB_ENOMEM, "out of memory for derivatives");
    for (int k = 0; k < s->n && status == RB_OK; k++)
        for (int j = 0; j < n; j++)
            for (int row = 0; row < s->rows && strcmp(v[j].number->name, s->of[k].input) == 0;
                 row++) {
                double *both = s->value + 2 * ((size_t)row * (size_t)s->n + (size_t)k);
                both[0] = both[1] = slope_of(&v[j], &can, s->of[k].result, row);
            }
    s->without = status == RB_OK ? states->steps - can.rows : 0;
    if (status == RB_OK && t && take_deviations(t, v, n, &can, history) != RB_OK)
        status = rb_fail(why, RB_ENOMEM, "out of memory for deviations");
    for (int k = 0; k < n; k++)
        varied_free(&v[k]);
    rb_rolling_follower_free(base);
    return rb_arena_done(&scratch, status);
}
