/* Sequences of contact problems, each starting from the state the last one left: static
 * increments and transient rolling (theory.md 4.2). */
#include "rolling/internal.h"

#include <cblas.h>
#include <stdlib.h>
#include <string.h>

/* Change of the friction per rolled half-width, in units of its bound, below which a
 * state counts as steady. */
static const double STEADY_RATE = 1e-3;

void rb_rolling_history_free(rb_rolling_history *h)
{
    rb_rolling_columns_free(&rb_rolling_history_columns, h);
    free(h->stick);
    free(h->slipping);
    memset(h, 0, sizeof *h);
}

rb_status rb_rolling_history_alloc(int steps, rb_rolling_history *h)
{
    const rb_status s = rb_rolling_columns_alloc(&rb_rolling_history_columns, steps, h);

    h->stick = rb_alloc_int((size_t)steps);
    h->slipping = rb_alloc_int((size_t)steps);
    return s == RB_OK && h->stick && h->slipping ? RB_OK : RB_ENOMEM;
}

/* ---- The program --------------------------------------------------------------------
 */

/* Value of a column between its rows r - 1 and r, or what the case has. */
static double column_value(const double *column, int r, double t, double own)
{
    if (!column)
        return own;
    return r == 0 ? column[0] : column[r - 1] + t * (column[r] - column[r - 1]);
}

/* The case at a place of the program: row r reached from row r - 1 by the fraction `end`;
 * the creepage is that of `middle`. */
static rb_rolling_case case_at(const rb_rolling_case *rc,
                               const rb_rolling_program *program, int r, double middle,
                               double end)
{
    rb_rolling_case at = *rc;

    at.load = column_value(program->load, r, end, rc->load);
    at.approach = column_value(program->approach, r, end, rc->approach);
    at.shift = column_value(program->shift, r, end, rc->shift);
    at.force = column_value(program->force, r, end, rc->force);
    at.force_ratio = column_value(program->force_ratio, r, end, rc->force_ratio);
    at.creep = column_value(program->creep, r, middle, rc->creep);
    at.creep_ratio = column_value(program->creep_ratio, r, middle, rc->creep_ratio);
    return at;
}

static rb_status check_columns(const rb_rolling_program *p, int transient,
                               rb_message *why)
{
    const double *const columns[] = {p->distance, p->load,       p->approach,
                                     p->shift,    p->creep,      p->creep_ratio,
                                     p->force,    p->force_ratio};
    static const char *const names[] = {"distance", "load",       "approach",
                                        "shift",    "creep",      "creep_ratio",
                                        "force",    "force_ratio"};

    if (p->n < 1)
        return rb_fail(why, RB_EINVAL, "history: expected 1 row or more");
    if (transient && !p->distance)
        return rb_fail(why, RB_EINVAL,
                       "history: transient rolling needs a column distance");
    for (int c = 0; c < 8; c++)
        for (int r = 0; columns[c] && r < p->n; r++)
            if (!isfinite(columns[c][r]))
                return rb_fail(why, RB_EINVAL, "history: row %d: %s is not a number",
                               r + 1, names[c]);
    for (int r = 0; p->distance && r < p->n; r++) {
        if (p->distance[r] < (r ? p->distance[r - 1] : 0.0))
            return rb_fail(why, RB_EINVAL,
                           "history: row %d: distance %g is behind the row before", r + 1,
                           p->distance[r]);
        if (r && p->distance[r] > 0.0 && p->distance[r] == p->distance[r - 1])
            return rb_fail(why, RB_EINVAL,
                           "history: row %d: distance %g twice; a jump needs two rows a "
                           "little apart",
                           r + 1, p->distance[r]);
    }
    return RB_OK;
}

/* Every row must be a case that could be solved. */
static rb_status check_program(const rb_rolling_case *rc,
                               const rb_rolling_program *program, rb_message *why)
{
    rb_status s = check_columns(program, rc->formulation == RB_TRANSIENT, why);
    rb_message reason = {""};

    for (int r = 0; r < program->n && s == RB_OK; r++) {
        const rb_rolling_case at = case_at(rc, program, r, 1.0, 1.0);
        s = rb_rolling_case_check(&at, &reason);
        if (s != RB_OK)
            rb_fail(why, s, "history: row %d: %.200s", r + 1, reason.text);
    }
    return s;
}

/* ---- Steps ----------------------------------------------------------------------------
 */

typedef struct {
    const rb_rolling_case *rc;
    const rb_rolling_program *program;
    rb_rolling_model *model;
    rb_rolling_history *history;
    int steps;    /* in all */
    double unit;  /* half-width that distances are measured in [length] */
    double step;  /* c [length] */
    double shift; /* rigid shift so far [length] */
    double *w_T;  /* n: tangential displacement that the next step starts from */
    double *q;    /* n: friction before the step */
    double *W_T;  /* n x 2n: w_T at x + c; NULL where that is the next point */
} run;

/* w_T of the present tractions: at the same places, or where a particle that arrives at x
 * was a step earlier. */
static rb_status remember(run *r, int rolling)
{
    const rb_rolling_state *state = &r->model->state;
    const int n = state->n, m = n + 1;

    memcpy(r->q, state->q, (size_t)n * sizeof(double));
    if (r->W_T && rolling) {
        memcpy(r->w_T, r->model->bodies.f.w0 + m, (size_t)n * sizeof(double));
        cblas_dgemv(CblasColMajor, CblasNoTrans, n, n, 1.0, r->W_T, n, state->p, 1, 1.0,
                    r->w_T, 1);
        cblas_dgemv(CblasColMajor, CblasNoTrans, n, n, 1.0, r->W_T + (size_t)n * n, n,
                    state->q, 1, 1.0, r->w_T, 1);
        return RB_OK;
    }
    double *w = rb_alloc(2 * (size_t)m, 1);
    const rb_status s =
        w ? rb_rolling_displacement(&r->model->bodies, state->p, state->q, w) : RB_ENOMEM;
    if (s == RB_OK)
        memcpy(r->w_T, w + m + rolling, (size_t)n * sizeof(double));
    free(w);
    return s;
}

static void record(run *r, double distance, int rolling)
{
    rb_rolling_history *h = r->history;
    const rb_rolling_problem *p = &r->model->problem;
    const rb_rolling_state *state = &r->model->state;
    const int k = h->n++;

    h->distance[k] = distance;
    h->creepage[k] = rolling ? state->xi : 0.0;
    h->shift[k] = r->shift;
    h->approach[k] = state->delta;
    h->normal_load[k] = rb_rolling_model_load(r->model);
    h->tangential_load[k] = rb_rolling_model_force(r->model);
    h->force_ratio[k] =
        p->mu > 0.0 ? h->tangential_load[k] / (p->mu * h->normal_load[k]) : NAN;
    h->residual[k] = state->residual;
    for (int i = 0; i < p->n; i++) {
        h->stick[k] += state->zone[i] == RB_ZONE_STICK;
        h->slipping[k] += state->zone[i] > RB_ZONE_STICK;
    }
}

/* Follows how long the friction has not changed. */
static void watch_steadiness(run *r)
{
    const rb_rolling_state *state = &r->model->state;
    const double bound =
        r->model->problem.mu * r->model->problem.stress * STEADY_RATE * r->step / r->unit;
    int moves = 0;

    for (int i = 0; i < state->n; i++)
        moves += fabs(state->q[i] - r->q[i]) > bound;
    if (moves)
        r->history->steady_from = -1;
    else if (r->history->steady_from < 0)
        r->history->steady_from = r->history->n;
}

static rb_status solve_step(run *r, int warm, rb_message *why)
{
    rb_message reason = {""};
    rb_status s = rb_rolling_model_resolve(r->model, warm, &reason);
    const rb_rolling_state *state = &r->model->state;

    if (s == RB_OK && (state->zone[0] != RB_ZONE_SEPARATED ||
                       state->zone[state->n - 1] != RB_ZONE_SEPARATED)) {
        rb_fail(&reason, RB_ZONE,
                "the contact fills the potential contact; widen the zone");
        s = RB_ZONE;
    }
    if (s != RB_OK)
        rb_fail(why, s, "step %d: %.260s", r->history->n + 1, reason.text);
    return s;
}

/* A step at rest: the rigid shift moves the contact, or the given force does. */
static rb_status static_step(run *r, const rb_rolling_case *at, rb_message *why)
{
    rb_rolling_problem *p = &r->model->problem;
    const rb_rolling_past past = {r->w_T};
    rb_rolling_case rest = *at;
    const int first = r->history->n == 0;

    rest.formulation = RB_STATIC;
    if (at->formulation == RB_TRANSIENT && isnan(at->force) && isnan(at->force_ratio))
        rest.force_ratio = 0.0;
    rb_rolling_set_past(&rest, &r->model->bodies, first ? NULL : &past, 0.0, p);
    rb_rolling_set_control(&rest, p);
    p->xi -= p->force_given ? 0.0 : r->shift;
    const rb_status s = solve_step(r, 0, why);
    r->shift += r->model->state.xi;
    return s;
}

static rb_status rolling_step(run *r, const rb_rolling_case *at, rb_message *why)
{
    const rb_rolling_past past = {r->w_T};

    rb_rolling_set_past(at, &r->model->bodies, &past, r->step, &r->model->problem);
    rb_rolling_set_control(at, &r->model->problem);
    const rb_status s = solve_step(r, 1, why);
    if (s == RB_OK)
        watch_steadiness(r);
    return s;
}

/* The last rolled step ends at the last row, the others in between. */
static rb_status one_step(run *r, int row, double from, double to, rb_message *why)
{
    const double *d = r->program->distance;
    const int rolling = d && d[row] > 0.0;
    const double span = rolling ? d[row] - d[row - 1] : 1.0;
    const double t0 = rolling ? (from - d[row - 1]) / span : 1.0;
    const double t1 = rolling ? (to - d[row - 1]) / span : 1.0;
    const rb_rolling_case at = case_at(r->rc, r->program, row, 0.5 * (t0 + t1), t1);

    rb_status s = r->history->n > 0 ? remember(r, rolling) : RB_OK;
    if (s != RB_OK)
        return s;
    s = rolling ? rolling_step(r, &at, why) : static_step(r, &at, why);
    if (s >= 0)
        record(r, rolling ? to : 0.0, rolling);
    return s;
}

static int rows_at_rest(const rb_rolling_program *program)
{
    int rows = 0;
    while (rows < program->n && (!program->distance || program->distance[rows] == 0.0))
        rows++;
    return rows;
}

static rb_status all_steps(run *r, rb_rolling_step *see, void *context, rb_message *why)
{
    const int at_rest = rows_at_rest(r->program), n = r->program->n;
    const double c = r->step / r->unit;
    rb_status s = RB_OK;
    int row = at_rest;

    for (int k = 0; k < r->steps && s == RB_OK; k++) {
        const double from = (k - at_rest) * c, to = (k - at_rest + 1) * c;
        while (k >= at_rest && row < n - 1 && r->program->distance[row] < from + 0.5 * c)
            row++;
        s = one_step(r, k < at_rest ? k : row, from, to, why);
        if (s == RB_OK && see && see(r->model, r->history, k, r->steps, context))
            s = rb_fail(why, RB_INTERRUPTED, "interrupted after step %d of %d", k + 1,
                        r->steps);
    }
    return s;
}

/* ---- Preparation
 * ------------------------------------------------------------------------ */

static double largest(const double *column, int n, double own)
{
    double max = column ? column[0] : own;
    for (int r = 1; column && r < n; r++)
        max = fmax(max, column[r]);
    return max;
}

/* A mesh that holds the contact of the largest load, solved at rest. */
static rb_status widest_contact(const rb_rolling_case *rc,
                                const rb_rolling_program *program,
                                rb_rolling_model *model, rb_message *why)
{
    rb_rolling_case widest = *rc;

    widest.formulation = RB_STATIC;
    widest.mesh = RB_MESH_UNIFORM;
    widest.load = largest(program->load, program->n, rc->load);
    widest.approach = largest(program->approach, program->n, rc->approach);
    widest.shift = widest.creep = widest.creep_ratio = widest.force = NAN;
    widest.force_ratio = 0.0;
    return rb_rolling_model_create(&widest, model, why);
}

static rb_status look_ahead(run *r)
{
    const size_t n = (size_t)r->model->mesh.n;

    r->W_T = rb_alloc(n, 2 * n);
    return r->W_T
               ? rb_rolling_displacement_ahead(r->rc, &r->model->bodies, r->step, r->W_T)
               : RB_ENOMEM;
}

/* Step length and number; one element long where the case does not say. */
static rb_status plan_steps(run *r, rb_message *why)
{
    const int at_rest = rows_at_rest(r->program), n = r->program->n;
    const double h = r->model->bodies.f.h[r->model->mesh.n / 2];
    const double way = at_rest < n ? r->program->distance[n - 1] * r->unit : 0.0;

    r->steps = at_rest;
    if (way == 0.0)
        return RB_OK;
    const double count = r->rc->steps > 0 ? r->rc->steps : ceil(way / h - 1e-9);
    if (count > 1e7)
        return rb_fail(why, RB_EINVAL,
                       "distance: %g half-widths are %.3g steps; expected at "
                       "most 1e7",
                       way / r->unit, count);
    r->steps += (int)count;
    r->step = r->rc->steps > 0 ? way / count : h;
    return fabs(r->step - h) <= 1e-9 * h ? RB_OK : look_ahead(r);
}

static rb_status prepare(run *r, rb_message *why)
{
    rb_status s = widest_contact(r->rc, r->program, r->model, why);

    if (s != RB_OK)
        return s;
    r->model->rc.formulation = r->rc->formulation;
    r->unit = r->model->half_width;
    r->w_T = rb_alloc((size_t)r->model->mesh.n, 1);
    r->q = rb_alloc((size_t)r->model->mesh.n, 1);
    if (!r->w_T || !r->q)
        return RB_ENOMEM;
    s = plan_steps(r, why);
    if (s == RB_OK)
        s = rb_rolling_history_alloc(r->steps, r->history);
    r->history->step = r->step;
    r->history->steady_from = -1;
    return s;
}

rb_status rb_rolling_history_run(const rb_rolling_case *rc,
                                 const rb_rolling_program *program, rb_rolling_step *step,
                                 void *context, rb_rolling_model *model,
                                 rb_rolling_history *history, rb_message *why)
{
    /* compressed at rest, then rolled to the end */
    const double way[] = {0.0, rc->distance};
    const rb_rolling_program own = {.n = 2, .distance = way};
    run r = {.rc = rc,
             .program = program ? program : &own,
             .model = model,
             .history = history};

    memset(model, 0, sizeof *model);
    memset(history, 0, sizeof *history);
    if (!program && rc->formulation != RB_TRANSIENT)
        return rb_fail(why, RB_EINVAL, "history: a static history needs a table");
    if (!program && !(rc->distance > 0.0))
        return rb_fail(why, RB_EINVAL, "distance: expected > 0, got %g", rc->distance);
    rb_status s = rb_rolling_case_check(rc, why);
    if (s == RB_OK)
        s = check_program(rc, r.program, why);
    if (s == RB_OK)
        s = prepare(&r, why);
    if (s == RB_OK)
        s = all_steps(&r, step, context, why);
    free(r.w_T);
    free(r.q);
    free(r.W_T);
    return s;
}
