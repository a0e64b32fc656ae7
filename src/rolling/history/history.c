/* Sequences of contact problems, each starting from the state the last one left: static
 * increments and transient rolling (theory.md 4.2). */
#include "rolling/body/internal.h"
#include "rolling/body/mesh.h"
#include "rolling/case/check.h"
#include "rolling/case/internal.h"
#include "rolling/history/row.h"
#include "rolling/results/columns.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/law.h"
#include "rolling/solve/resolution.h"
#include "rolling/stress/stress.h"
#include "rolling/solve/variant.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void rb_rolling_history_free(rb_rolling_history *h)
{
    struct rb_rolling_history *const beside[] = {h->errors, h->deviations};

    for (int k = 0; k < 2; k++) {
        if (beside[k])
            rb_rolling_history_free(beside[k]);
        free(beside[k]);
    }
    free(h->cycle_errors);
    free(h->halved_work);
    rb_rolling_columns_free(&rb_rolling_history_columns, h);
    memset(h, 0, sizeof *h);
}

/* ---- The last cycle -------------------------------------------------------------- */

/* The row at which the last cycle begins: the last row and the one before it are prescribed as it
 * and the one before it; -1: none is. */
static int begin_of_cycle(const rb_rolling_program *program)
{
    const int last = program->n - 1;
    int j = last - 1;

    while (j > 0 && !(rb_rolling_program_is_same(program, j, last) &&
                      rb_rolling_program_is_same(program, j - 1, last - 1)))
        j--;
    return j > 0 ? j : -1;
}

/* The same for --fretting, which sees by the friction whether the cycle closes: the row before may
 * differ, as when the force rises from zero the first time. */
static int begin_of_fretting(const rb_rolling_program *program)
{
    const int last = program->n - 1;
    int j = begin_of_cycle(program);

    if (j >= 0)
        return j;
    for (j = last - 1; j >= 0 && !rb_rolling_program_is_same(program, j, last);)
        j--;
    return j;
}

/* Without `fretting` -1.  A body whose stress is not known is refused before anything is solved. */
static rb_status prepare_cycle(history_state *r, rb_message *why)
{
    const int from = r->rc->cycle_from, to = r->rc->cycle_to, rows = r->program->n;

    r->frets_from = -1;
    r->frets_to = rows - 1;
    if (!r->rc->fretting)
        return RB_OK;
    if (to > 0 && !(from >= 1 && from < to && to <= rows))
        return rb_refuse(why, "cycle",
                         "expected two rows of the history, 1 to %d, the earlier one first, got "
                         "%d,%d",
                         rows, from, to);
    rb_status s = rb_rolling_stress_check(r->rc, why);
    if (s == RB_OK && r->rc->elastic_b)
        s = rb_rolling_mirror_check(r->rc, why);
    r->frets_from = to > 0 ? from - 1 : begin_of_fretting(r->program);
    r->frets_to = to > 0 ? to - 1 : r->frets_to;
    return s == RB_OK && r->frets_from < 0
               ? rb_refuse(why, "fretting",
                           "the rows of the history end with no cycle; the last row must prescribe "
                           "what a row before it does, or --cycle name two rows")
               : s;
}

/* How much of mu p0 the friction at the end of a cycle may differ from that at its beginning. */
static const double CLOSES = 1e-6;

static rb_status check_cycle(const history_state *r, rb_message *why)
{
    const double misses = rb_rolling_cycle_misses(r->model);
    char end[30] = "the last one";

    if (misses <= CLOSES)
        return RB_OK;
    if (r->rc->cycle_to > 0)
        snprintf(end, sizeof end, "row %d", r->frets_to + 1);
    return rb_refuse(why, "fretting,cycle",
                     "the cycle from row %d of the history to %s does not close, "
                     "friction differs by %.2g mu p0; append the rows of the cycle once more",
                     r->frets_from + 1, end, misses);
}

/* After a row. */
static rb_status follow_cycle(const history_state *r, rb_message *why)
{
    const int row = r->row - 1;
    rb_status s = RB_OK;

    if (row == r->frets_from)
        s = rb_rolling_cycle_begin(r->model, why);
    else if (row > r->frets_from && row <= r->frets_to)
        s = rb_rolling_cycle_end_row(r->model, why);
    if (s == RB_OK && row == r->frets_to) {
        s = check_cycle(r, why);
        rb_rolling_cycle_end(r->model);
    }
    return s;
}

/* The last cycle, or the one that is asked for. */
static void find_cycle(const history_state *r)
{
    rb_rolling_history *h = r->history;
    const rb_rolling_program *program = r->program;
    const int given = r->rc->cycle_to > 0, last = given ? r->frets_to : program->n - 1,
              j = program->distance || h->n != program->n ? -1
                  : given                                 ? r->frets_from
                                                          : begin_of_cycle(program);

    h->cycle_work = j < 0 ? (double)NAN : h->friction_work[last] - h->friction_work[j];
    h->cycle_rows = j < 0 ? 0 : last - j;
}

/* ---- All rows -------------------------------------------------------------------- */

/* Steps of the next row, where its state is given. */
static int steps_found(const history_state *r)
{
    const int known = rb_rolling_row_is_at_rest(r) ? rb_rolling_row_steps_at_rest(r)
                      : r->is_variant              ? 0
                                                   : r->rolled;
    return known > 0 ? known : r->found->substeps[r->history->n];
}

/* Each row is one or more steps; at rest the answer may ask for more of them than the case says.
 * The model keeps the state from row to row. */
static rb_status all_rows(history_state *r, rb_message *why)
{
    const rb_rolling_observer *o = r->observer;

    for (int k = 0; k < r->rows; k++) {
        const int rests = rb_rolling_row_is_at_rest(r);
        const rb_status s = r->found ? rb_rolling_row_compute(r, steps_found(r), why)
                            : rests  ? rb_rolling_row_compute_at_rest(r, why)
                                     : rb_rolling_row_compute(r, r->rolled, why);
        if (s != RB_OK)
            return s;
        if (r->rc->fretting && r->part == 0) {
            const rb_status of_cycle = follow_cycle(r, why);
            if (of_cycle != RB_OK)
                return of_cycle;
        }
        /* A history that is checked has the jump where its result says that it is. */
        if (r->found && r->found->rows.jumped == r->history->n)
            rb_rolling_row_note_jump(r);
        if (r->model->rows.not_unique == 0 &&
            (r->not_unique || (k + 1 < r->rows && rb_rolling_row_is_not_unique(r))))
            r->model->rows.not_unique = r->history->n;
        if (o && o->step && o->step(r->model, r->history, k, r->rows, o->context))
            return rb_fail(why, RB_INTERRUPTED, "interrupted after step %d of %d", k + 1, r->rows);
    }
    return RB_OK;
}

/* ---- Preparation ------------------------------------------------------------------- */

/* Of a column of the program, or the case's own value without one. */
static double largest(const double *column, int n, double own)
{
    double max = column ? column[0] : own;
    for (int r = 1; column && r < n; r++)
        max = fmax(max, column[r]);
    return max;
}

/* A mesh that holds the contact of the largest load, solved at rest; zone: 0, automatic. */
static rb_status widest_contact(const history_state *r, double zone, rb_message *why)
{
    const rb_rolling_program *program = r->program;
    rb_rolling_case widest = rb_rolling_memory_case(r->rc, INFINITY);

    widest.formulation = RB_STATIC;
    widest.increments = 1;
    widest.heat_a.conductivity = 0.0; /* nothing slides yet */
    if (rb_rolling_law_depends_on_slip(&widest.friction)) {
        widest.mu = rb_rolling_law_at_rest(&widest, 0.0);
        widest.friction = (rb_rolling_friction){.law = RB_FRICTION_constant};
    }
    /* The largest load or approach of all rows, without a tangential one: the widest contact at
     * rest. */
    widest.zone = zone;
    widest.load = largest(program->load, program->n, widest.load);
    widest.approach = largest(program->approach, program->n, widest.approach);
    widest.shift = widest.creep = widest.creep_ratio = widest.force = NAN;
    widest.force_ratio = 0.0;
    /* Solved, or placed on the elements of a history that exists already: a variant of it, the same
     * elements for another case, or those of a result. */
    if (!r->found)
        return rb_rolling_model_create(&widest, r->model, why);
    if (r->like)
        return rb_rolling_variant_place(r->like, &widest, 0.0, r->scale, r->model, why);
    rb_rolling_plan plan = rb_rolling_plan_of(&widest);
    rb_rolling_mesh mesh = {0};
    plan.compression = r->compression;
    if (r->elements) { /* equal arcs, also of another circle */
        const double *ends = r->elements->ends;
        const int n = plan.elements = r->elements->n;
        const rb_status s = rb_rolling_mesh_uniform(&widest, &plan, r->scale * ends[0],
                                                    r->scale * ends[n], &mesh, why);
        return s == RB_OK ? rb_rolling_model_on_mesh(&widest, &plan, &mesh, r->model, why) : s;
    }
    const rb_rolling_elements elements = {
        .are_equal = 1, .n = r->found->n, .x = r->found->x, .h = r->found->h};
    return rb_rolling_model_of_result(&widest, &plan, &elements, r->model, why);
}

double rb_rolling_unit_of_distance(const rb_rolling_case *rc, double load)
{
    rb_rolling_case at_rest = *rc;

    at_rest.formulation = RB_STATIC;
    return rb_rolling_contact_half_width(&at_rest, load);
}

static rb_status prepare_history(history_state *r, double zone, rb_message *why)
{
    rb_rolling_model *model = r->model;
    rb_rolling_history *h = r->history;
    rb_status s = widest_contact(r, zone, why);

    if (s != RB_OK)
        return s;
    r->shift = 0.0;
    model->varies = rb_rolling_program_varies(r->program);
    /* The unit of distances: the half-width of the largest load, of bodies that relax with
     * the glassy modulus; under a given approach of the load that the largest one
     * brings at rest.  Of a gap without a radius that of the contact at rest itself. */
    if (!rb_rolling_has_radius(r->rc)) {
        double from, to;
        rb_rolling_contact_edges(r->rc, &model->mesh, &model->state, &from, &to);
        if (!r->found)
            h->half_width = 0.5 * (to - from);
    } else if (model->problem.load_given && (r->found || rb_rolling_relaxes(r->rc)))
        h->half_width = rb_rolling_unit_of_distance(r->rc, model->problem.load);
    else if (!r->found)
        h->half_width = model->half_width;
    if (r->found) /* as solving would have left it */
        model->half_width = h->half_width;
    /* Rows that roll, and their steps.  Where the case does not say, a row is one step of one
     * element, or of as little less as brings the last one to the last row: a single short step
     * would find a creepage that is mostly error.  Of a variant of a history there are as many as
     * there.  Longer rows are computed in equal steps of at most an element. */
    const int rows = rb_rolling_program_at_rest(r->program), n = r->program->n;
    const double way = rows < n ? r->program->distance[n - 1] * h->half_width : 0.0;
    const double elements = way / rb_rolling_middle_length(model),
                 shortest = ceil(elements * (1.0 - 1e-9));
    r->at_rest = 0;
    for (int row = 0; row < rows; row++)
        r->at_rest += rb_rolling_program_parts(r->program, r->rc, row);
    const double count = way == 0.0         ? 0.0
                         : r->rc->steps > 0 ? r->rc->steps
                         : r->is_variant    ? fmax(1.0, r->found->steps - r->at_rest)
                                            : shortest;
    const double each = way == 0.0 || count > shortest ? 1.0
                        : r->is_variant && r->found->steps > r->at_rest
                            ? r->found->substeps[r->at_rest]
                            : ceil(elements / count * (1.0 - 1e-9));

    /* count rows that roll, of `each` steps. */
    if (count * each > RB_ROLLING_MOST_STEPS)
        return rb_refuse(why, "distance", "%g half-widths are %.3g steps; expected at most %g",
                         way / h->half_width, count * each, (double)RB_ROLLING_MOST_STEPS);
    if (count > shortest && rb_rolling_relaxes(r->rc) && !r->found)
        return rb_refuse(why, "steps",
                         "viscoelastic bodies roll by one element in each step; expected at "
                         "most %g with these elements, got %g",
                         shortest, count);
    r->rows = r->at_rest + (int)count;
    r->rolled = (int)each;
    if (r->found && r->found->steps != r->rows)
        return rb_refuse(why, "history", "%d steps, the program has %d", r->found->steps, r->rows);
    h->step = way == 0.0 ? 0.0 : way / count;
    h->steady_from = -1;
    r->row = r->part = r->step = 0;
    r->particles = (rb_rolling_particles){.rc = r->rc,
                                          .model = model,
                                          .step = h->step / r->rolled,
                                          .steps = r->at_rest + (int)(count * each),
                                          .keeps_elements = r->found != NULL};
    s = rb_rolling_particles_create(&r->particles, why);
    if (s == RB_OK)
        s = rb_rolling_steady_create(model->mesh.n, &r->particles.memory, &r->steady);
    if (s == RB_OK)
        s = rb_rolling_columns_alloc(&rb_rolling_history_columns, r->rc, model->varies, r->rows, h);
    if (s == RB_OK && !(h->halved_work = calloc((size_t)r->rows, sizeof *h->halved_work)))
        s = RB_ENOMEM;
    return s;
}

/* The case and its program. */
static rb_status begin_program(history_state *r, const rb_rolling_case *rc, rb_message *why)
{
    const rb_rolling_program *program = r->program;
    const rb_rolling_case whole = program ? rb_rolling_program_base(program, rc) : *rc;

    r->base = whole;
    r->base.mesh = RB_MESH_UNIFORM;
    r->rc = &r->base;
    r->program = program ? program : &r->own;
    memset(r->model, 0, sizeof *r->model);
    /* a variant is nearly what was checked, and may be beyond a bound by as much */
    rb_status s = r->is_variant ? RB_OK
                  : program     ? rb_rolling_program_check_base(program, &whole, why)
                                : rb_rolling_case_check(&whole, why);
    if (s == RB_OK && !program && rc->formulation == RB_TRANSIENT && rc->distance == 0.0)
        s = rb_refuse(why, "distance", "expected > 0, got 0");
    if (s == RB_OK && !program) {
        rb_rolling_press_by_load(&r->base); /* a column of loads replaces it */
        s = rb_rolling_program_of_case(rc, &r->columns, &r->own);
    }
    if (s == RB_OK && !r->is_variant)
        s = rb_rolling_program_check(r->program, r->rc, why);
    return s == RB_OK ? prepare_cycle(r, why) : s;
}

/* Loads that move and surfaces that are irregular may widen the contact beyond that of
 * the largest load at rest: the run starts again on a wider zone then. */
static rb_status run_program(history_state *r, const rb_rolling_case *rc, rb_message *why)
{
    rb_rolling_model *model = r->model;
    rb_status s = begin_program(r, rc, why);

    /* wider > 0: the zone of the next attempt; 0: this one is the last. */
    for (double zone = r->base.zone, wider = 1.0; s == RB_OK && wider > 0.0; zone = wider) {
        wider = 0.0;
        s = prepare_history(r, zone, why);
        if (s == RB_OK) {
            s = rb_rolling_check_layer_resolved(model, all_rows(r, why), why);
            r->history->steady_from = rb_rolling_steady_from(&r->steady, r->rc, r->history);
            find_cycle(r);
            if (r->found) {
                model->rows.changed = r->found->rows.changed;
                model->rows.changes = r->found->rows.changes;
            }
            r->history->rows = model->rows;
            if (s == RB_OK && r->history->step == 0.0 && !model->problem.load_given)
                /* nothing rolls, no distance is measured by a: it is that of the largest load */
                r->history->half_width = rb_rolling_contact_half_width(
                    r->rc, fmax(0.0, largest(r->history->normal_load, r->history->n, 0.0)));
            /* An automatic zone may grow to the extent of the bodies or of the gap's table. */
            if (s == RB_ZONE && r->rc->zone == 0.0) {
                const double now = fmax(-model->mesh.ends[0], model->mesh.ends[model->mesh.n]);
                double from, to;
                rb_rolling_extent(r->rc, &from, &to);
                const double widest = fmax(-from, to);
                wider = now < 0.999 * widest ? fmin(1.3 * now, widest) : 0.0;
            }
        }
        rb_rolling_particles_free(&r->particles);
        if (wider > 0.0) {
            /* more than asked for, with patches */
            r->base.contact_elements = model->mesh.n;
            rb_rolling_model_free(model);
            rb_rolling_history_free(r->history);
            s = RB_OK;
        }
    }
    return rb_arena_done(&r->columns, s);
}

rb_status rb_rolling_history_run(const rb_rolling_case *rc, const rb_rolling_program *program,
                                 const rb_rolling_observer *observer, rb_rolling_model *model,
                                 rb_rolling_history *history, rb_message *why)
{
    history_state r = {
        .program = program, .observer = observer, .model = model, .history = history};

    memset(history, 0, sizeof *history);
    return run_program(&r, rc, why);
}

static rb_status check_followed(const rb_rolling_states *states, rb_message *why)
{
    return states->half_width > 0.0
               ? RB_OK
               : rb_refuse(why, "history", "half-width %g: expected > 0", states->half_width);
}

rb_status rb_rolling_history_follow(const rb_rolling_case *rc, const rb_rolling_states *states,
                                    const rb_rolling_observer *observer, rb_rolling_model *model,
                                    rb_rolling_history *history, rb_message *why)
{
    history_state r = {.program = states->program,
                       .observer = observer,
                       .found = states,
                       .compression = INFINITY,
                       .scale = 1.0,
                       .model = model,
                       .history = history};

    memset(history, 0, sizeof *history);
    memset(model, 0, sizeof *model);
    history->half_width = states->half_width;
    const rb_status s = check_followed(states, why);
    return s == RB_OK ? run_program(&r, rc, why) : s;
}

/* ---- Step by step, with states that the caller sets -------------------------------- */

struct rb_rolling_follower {
    history_state r;
    rb_rolling_model model;
    rb_rolling_history history;
    const rb_rolling_follower *of;
};

rb_status rb_rolling_follower_create(const rb_rolling_case *rc, const rb_rolling_states *states,
                                     const rb_rolling_follower *of, double scale,
                                     rb_rolling_follower **follower, rb_message *why)
{
    rb_rolling_follower *f = *follower = calloc(1, sizeof *f);

    if (!f)
        return rb_fail(why, RB_ENOMEM, "out of memory for a history");
    f->r = (history_state){.program = states->program,
                           .found = states,
                           .like = of && !rb_rolling_relaxes(rc) ? &of->model : NULL,
                           .elements = of ? &of->model.mesh : NULL,
                           .compression = RB_ROLLING_CLOSE,
                           .scale = scale,
                           .is_variant = of != NULL,
                           .model = &f->model,
                           .history = &f->history};
    f->of = f->r.like ? of : NULL;
    f->history.half_width = states->half_width;
    rb_status s = check_followed(states, why);
    if (s == RB_OK)
        s = begin_program(&f->r, rc, why);
    return s == RB_OK ? prepare_history(&f->r, f->r.base.zone, why) : s;
}

rb_rolling_model *rb_rolling_follower_model(rb_rolling_follower *f)
{
    return &f->model;
}

const rb_rolling_history *rb_rolling_follower_history(const rb_rolling_follower *f)
{
    return &f->history;
}

rb_status rb_rolling_follower_begin(rb_rolling_follower *f, rb_message *why)
{
    if (f->r.step == 0)
        f->r.steps = steps_found(&f->r);
    return rb_rolling_row_begin_step(&f->r, why);
}

int rb_rolling_follower_ends_row(const rb_rolling_follower *f)
{
    return f->r.step + 1 == f->r.steps;
}

rb_status rb_rolling_follower_solve(rb_rolling_follower *f, rb_message *why)
{
    return rb_rolling_row_solve_step(&f->r, why);
}

void rb_rolling_follower_end(rb_rolling_follower *f)
{
    rb_rolling_row_end_step(&f->r, RB_OK);
}

void rb_rolling_follower_free(rb_rolling_follower *f)
{
    if (!f)
        return;
    rb_rolling_particles_free(&f->r.particles);
    rb_arena_free(&f->r.columns);
    if (f->of)
        rb_rolling_variant_free(&f->of->model, &f->model);
    else
        rb_rolling_model_free(&f->model);
    rb_rolling_history_free(&f->history);
    free(f);
}
