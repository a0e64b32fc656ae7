/* Curves over the creepage, with one mesh and one factorisation (theory.md 4.6), and over
 * the speed of viscoelastic bodies (V4). */
#include "rolling/case/derived.h"
#include "rolling/case/ellipse.h"
#include "rolling/case/internal.h"
#include "rolling/results/columns.h"
#include "rolling/solve/fit.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/law.h"
#include "rolling/solve/law_iteration.h"
#include "rolling/solve/model.h"
#include "rolling/solve/patches.h"
#include "rolling/solve/power.h"
#include "rolling/solve/resolution.h"
#include "rolling/solve/solution.h"
#include "rolling/solve/zone.h"
#include "rolling/study/study.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void rb_rolling_curve_free(rb_rolling_curve *c)
{
    if (c->deviations)
        rb_rolling_curve_free(c->deviations);
    free(c->deviations);
    rb_rolling_columns_free(&rb_rolling_curve_columns, c);
    rb_rolling_solution_free(&c->last);
    memset(c, 0, sizeof *c);
}

/* Function called for each point; point NULL: none. */
typedef struct {
    rb_rolling_point *point;
    void *context;
    rb_units units; /* of notes */
} watcher;

/* The creepage of a point was not given like that of a case. */
static rb_status note_point(const rb_rolling_model *model, rb_units units, rb_rolling_curve *c,
                            rb_message *why)
{
    rb_rolling_case rc = *model->rc;
    rb_rolling_solution at;
    const rb_status s = rb_rolling_bare_solution(model, &at, why);

    if (s != RB_OK)
        return s;
    if (!isnan(rc.creep)) {
        rc.creep = NAN;
        rc.creep_ratio = at.creep_ratio;
    }
    rb_rolling_solution_convert(&at, units);
    const rb_rolling_row_notes notes = rb_rolling_find_row_notes(&rc, &at);
    rb_rolling_add_row_notes(&c->notes, c->n - 1, &notes);
    rb_rolling_solution_free(&at);
    return notes.status;
}

/* The solution of the last point, with the least dissipation and the largest kappa of all, which
 * notes are about. */
static rb_status keep_last(const rb_rolling_model *model, rb_rolling_curve *c, rb_message *why)
{
    const rb_status s = rb_rolling_model_solution(model, &c->last, why);

    if (c->ellipse_force)
        c->last.ellipse_force = c->ellipse_force[c->n - 1];
    for (int i = 0; i < c->n && s == RB_OK; i++) {
        c->last.dissipation = fmin(c->last.dissipation, c->dissipation[i]);
        if (c->kappa)
            c->last.kappa = fmax(c->last.kappa, c->kappa[i]);
    }
    return s;
}

/* The columns of one more point, from the state as solved. */
static rb_status record_point(const rb_rolling_model *model, const watcher *w, rb_rolling_curve *c,
                              rb_message *why)
{
    const rb_contact_problem *p = &model->problem;
    const rb_contact_state *state = &model->state;
    const double P = rb_rolling_model_load(model), Q = rb_rolling_model_force(model);
    const int k = c->n++;
    double contact, stick, yields = 0.0;
    const double longest = rb_rolling_longest_element(p->n, state->zone, model->bodies.f.h);

    rb_rolling_zone_lengths(p->n, state->zone, model->bodies.f.h, &contact, &stick);
    c->creepage[k] = state->xi;
    c->creep_ratio[k] = rb_rolling_ratio_of_creepage(model, state->xi);
    c->normal_load[k] = P;
    c->tangential_load[k] = Q;
    c->force_ratio[k] = rb_rolling_force_ratio(model);
    c->stick_ratio[k] = contact > 0.0 ? stick / contact : 0.0;
    for (int i = 0; i < p->n && c->yield_ratio; i++)
        yields += state->zone[i] > RB_ZONE_SLIP_POSITIVE ? model->bodies.f.h[i] : 0.0;
    if (c->yield_ratio)
        c->yield_ratio[k] = contact > 0.0 ? yields / contact : 0.0;
    /* A limit of stick is known to an element. */
    if (contact > 0.0)
        c->stick_step = fmax(c->stick_step, longest / contact);
    c->dissipation[k] = rb_rolling_dissipated_power(model->rc, p->n, state->lambda, state->q,
                                                    model->bodies.f.h, p->e_T);
    c->residual[k] = state->residual;
    c->half_width = model->half_width;
    c->speed[k] = model->rc->speed;
    if (c->branch) {
        c->branch[k] = k < c->rising ? 1 : 2;
        const rb_status s = rb_rolling_law_kappa(model, &c->kappa[k]);
        if (s != RB_OK)
            return s;
    }
    c->resistance_moment[k] = rb_contact_moment(p, state);
    c->resistance_ratio[k] = rb_rolling_has_radius(model->rc)
                                 ? c->resistance_moment[k] / (P * rb_rolling_radius(model->rc))
                                 : NAN;
    double torque_b;
    rb_rolling_torques(model->rc, c->resistance_moment[k], Q, &c->torque_a[k], &torque_b);
    if (c->torque_b)
        c->torque_b[k] = torque_b;
    rb_status s = rb_rolling_hysteresis(model, &c->hysteresis[k]);
    if (c->ellipse_force) {
        rb_rolling_set_ellipse_forces(model->rc, c->creep_ratio[k], &c->ellipse_force[k],
                                      &c->ellipse_force_kalker[k]);
        if (s == RB_OK)
            s = rb_rolling_solve_strips(model, &c->ellipse_force[k], why);
    }
    if (s == RB_OK && c->max_temperature) {
        rb_rolling_solution warm;
        s = rb_rolling_model_solution(model, &warm, why);
        c->max_temperature[k] = s == RB_OK ? warm.max_temperature : 0.0;
        rb_rolling_solution_free(&warm);
    }
    if (s == RB_OK)
        s = note_point(model, w->units, c, why);
    if (s == RB_OK && w->point)
        s = w->point(model, k, w->context, why);
    const int is_last = c->n == (c->branch ? 2 * c->rising : c->rising);
    return s == RB_OK && is_last ? keep_last(model, c, why) : s;
}

static void set_creepage(rb_rolling_variable over, double value, rb_rolling_case *rc)
{
    rc->creep = over == RB_OVER_CREEP ? value : NAN;
    rc->creep_ratio = over == RB_OVER_CREEP_RATIO ? value : NAN;
}

/* Equal steps of the creepage, equal ratios of the speed. */
static double value_at(const rb_rolling_range *r, int k)
{
    const double t = r->points > 1 ? (double)k / (r->points - 1) : 0.0;
    return r->over == RB_OVER_SPEED ? r->from * pow(r->to / r->from, t)
                                    : r->from + t * (r->to - r->from);
}

/* The coefficients of the last point, from which a solve on another mesh starts. */
typedef struct {
    rb_rolling_table table;
    double *scratch;
} branch_start;

static rb_status remember_branch(const rb_rolling_model *model, branch_start *start)
{
    const size_t n = (size_t)model->mesh.n;
    double *scratch = rb_alloc(n, 2);

    if (!scratch)
        return RB_ENOMEM;
    memcpy(scratch, model->bodies.f.x, n * sizeof *scratch);
    memcpy(scratch + n, model->problem.bound, n * sizeof *scratch);
    free(start->scratch);
    start->scratch = scratch;
    start->table = (rb_rolling_table){model->mesh.n, scratch, scratch + n};
    return RB_OK;
}

/* 1: a solver found nothing there; it may elsewhere. */
static int is_unsolved(rb_status s)
{
    return s == RB_MAXITER || s == RB_RAY || s == RB_SINGULAR || s == RB_INACCURATE;
}

/* A point without a solution keeps its place; why: of the first one. */
static rb_status record_unsolved(const rb_rolling_model *model, const rb_rolling_range *r,
                                 double value, rb_status s, rb_rolling_curve *c, rb_message *why)
{
    const rb_rolling_derived d = rb_rolling_derive(model->rc);
    const double unit = rb_rolling_largest_mu(model->rc) * d.half_width / d.radius; /* of xi */
    const int k = c->n++;

    for (int j = 0; j < rb_rolling_curve_columns.n; j++) {
        const rb_rolling_result *column = &rb_rolling_curve_columns.row[j];
        double *at = column->kind == RB_RESULT_NUMBER ? rb_rolling_column(column, c) : NULL;
        if (at)
            at[k] = NAN;
    }
    rb_rolling_add_row_notes(&c->notes, k, &(rb_rolling_row_notes){.n = 0});
    c->speed[k] = model->rc->speed;
    if (r->over != RB_OVER_SPEED) {
        c->creepage[k] = r->over == RB_OVER_CREEP ? value : value * unit;
        c->creep_ratio[k] = r->over == RB_OVER_CREEP ? value / unit : value;
    }
    if (c->branch)
        c->branch[k] = k < c->rising ? 1 : 2;
    if (c->unsolved++ == 0 && why) {
        const rb_message reason = *why;
        rb_fail(why, s, "the point at %s = %g has no solution: %.400s",
                r->over == RB_OVER_SPEED   ? "speed"
                : r->over == RB_OVER_CREEP ? "xi"
                                           : "xi R/(mu a)",
                value, rb_status_reason(s, &reason));
    }
    return c->kappa && model->state.p ? rb_rolling_law_kappa(model, &c->kappa[k]) : RB_OK;
}

/* Records a point with the status s, or keeps the place of one without a solution.  first: the
 * first status of these.  Returns RB_OK where the curve goes on. */
static rb_status end_point(const rb_rolling_model *model, const watcher *w,
                           const rb_rolling_range *r, double value, rb_status s,
                           const rb_message *reason, rb_status *first, rb_rolling_curve *c,
                           rb_message *why)
{
    if (s != RB_OK && *first == RB_OK && why)
        *why = *reason;
    if (is_unsolved(s)) {
        *first = *first == RB_OK ? s : *first;
        return record_unsolved(model, r, value, s, c, why);
    }
    if (s < 0 || !model->state.p)
        return s;
    const rb_status t = record_point(model, w, c, why);
    return t < 0 ? t : s;
}

/* A fitted mesh whose contact has moved is fitted again, with the zones of the state; after
 * RB_ZONE, a potential contact that is full, the whole search for the contact begins again.  edge:
 * of the contact for which the mesh was made, set anew. */
static rb_status follow_contact(const rb_rolling_case *steady, rb_status s, double edge[2],
                                rb_rolling_model *model, rb_message *why)
{
    double from = NAN, to = NAN;

    if (s == RB_OK)
        rb_rolling_contact_edges(model->rc, &model->mesh, &model->state, &from, &to);
    const double moved =
        fmax(fabs(from - edge[0]), fabs(to - edge[1])) / (0.5 * (edge[1] - edge[0]));
    if (s == RB_ZONE) {
        const int iterations = model->iterations;
        rb_rolling_plan plan = rb_rolling_plan_of(steady);
        plan.start = model->plan.start;
        rb_rolling_model_free(model);
        s = rb_rolling_model_reuse(steady, &plan, model, why);
        model->iterations += iterations;
    } else if (s == RB_OK && steady->mesh != RB_MESH_UNIFORM && moved > RB_ROLLING_REFIT)
        s = steady->mesh == RB_MESH_ALIGNED ? rb_rolling_model_realign(model, why)
                                            : rb_rolling_model_refit(model, why);
    else
        return s;
    if (s == RB_OK)
        rb_rolling_contact_edges(model->rc, &model->mesh, &model->state, &edge[0], &edge[1]);
    return s;
}

/* One model for all creepages (4.6): the flexibility does not depend on them, and each point starts
 * from the zones of the point before.  Friction that depends on the state may have two branches
 * (F3): the creepages are then followed there and back. */
static rb_status over_creepages(const rb_rolling_case *rc, const rb_rolling_range *r,
                                const watcher *w, rb_rolling_model *model, rb_rolling_curve *c,
                                rb_message *why)
{
    rb_rolling_case steady = *rc;
    rb_status s = RB_OK, first = RB_OK;
    double edge[2] = {NAN, NAN};
    int is_made = 0;

    steady.shift = steady.force = steady.force_ratio = NAN;
    steady.free_axle = 0;
    const int moves = rb_rolling_law_depends_on_state(&steady), points = r->points;
    branch_start start = {.scratch = NULL};
    for (int k = 0; k < (moves ? 2 * points : points) && s == RB_OK; k++) {
        const double value = value_at(r, k < points ? k : 2 * points - 1 - k);
        rb_message reason = {.text = ""};
        set_creepage(r->over, value, &steady);
        /* The first point that has a solution makes the mesh and the factors of all that follow. */
        if (is_made)
            s = rb_rolling_model_set_case(model, &steady, &reason);
        else {
            rb_rolling_model_free(model);
            s = rb_rolling_model_create(&steady, model, &reason);
            is_made = s == RB_OK;
            if (is_made)
                rb_rolling_contact_edges(model->rc, &model->mesh, &model->state, &edge[0],
                                         &edge[1]);
        }
        if (s == RB_OK)
            s = rb_rolling_model_control(model, &reason);
        if (moves && s == RB_OK) {
            s = remember_branch(model, &start);
            model->plan.start = &start.table;
        }
        if (is_made)
            s = follow_contact(&steady, s, edge, model, &reason);
        s = end_point(model, w, r, value, s, &reason, &first, c, why);
    }
    model->plan.start = NULL;
    free(start.scratch);
    if (s == RB_OK && is_made && model->state.status == RB_OK && rb_rolling_largest_mu(rc) > 0.0)
        s = rb_rolling_free_creepage_if_any(model, &c->free_creepage, why);
    return s == RB_OK ? first : s;
}

/* The flexibility of bodies that relax depends on the speed (V4): each point has a model of its
 * own.
 */
static rb_status over_speeds(const rb_rolling_case *rc, const rb_rolling_range *r, const watcher *w,
                             rb_rolling_model *model, rb_rolling_curve *c, rb_message *why)
{
    rb_rolling_case steady = *rc;
    rb_status s = RB_OK, first = RB_OK;

    for (int k = 0; k < r->points && s == RB_OK; k++) {
        const int iterations = model->iterations;
        rb_message reason = {.text = ""};
        steady.speed = value_at(r, k);
        rb_rolling_model_free(model);
        s = rb_rolling_model_create(&steady, model, &reason);
        model->iterations += iterations;
        s = end_point(model, w, r, steady.speed, s, &reason, &first, c, why);
    }
    return s == RB_OK ? first : s;
}

/* What a curve over this variable needs, before its first point is solved. */
static rb_status check_curve(const rb_rolling_case *rc, const rb_rolling_range *r, rb_message *why)
{
    if (!isfinite(r->from) || !isfinite(r->to))
        return rb_fail(why, RB_EINVAL, "curve: from %g to %g: expected finite numbers", r->from,
                       r->to);
    rb_status s = rb_rolling_check_size("from", r->from, why);
    if (s == RB_OK)
        s = rb_rolling_check_size("to", r->to, why);
    if (s != RB_OK)
        return s;
    if (r->points < 1 || r->points > RB_ROLLING_MOST_POINTS)
        return rb_fail(why, RB_EINVAL, "points: expected 1 ... %d, got %d", RB_ROLLING_MOST_POINTS,
                       r->points);
    if (r->over == RB_OVER_CREEP_RATIO && rb_rolling_largest_mu(rc) == 0.0)
        return rb_fail(why, RB_EINVAL,
                       "curve: xi R/(mu a) has no meaning at mu = 0; give creepages");
    if (r->over == RB_OVER_SPEED && !(r->from > 0.0 && r->to > 0.0))
        return rb_fail(why, RB_EINVAL, "curve over speed: expected from and to > 0, got %g and %g",
                       r->from, r->to);
    if (r->over == RB_OVER_SPEED && !rb_rolling_relaxes(rc) && !rb_rolling_has_heat(rc) &&
        !rb_rolling_law_depends_on_slip(&rc->friction))
        return rb_fail(why, RB_EINVAL,
                       "curve over speed: no body is viscoelastic, nothing is heated and friction "
                       "does not depend on the slip, so that nothing depends on the speed; add "
                       "--relaxation-time and --relaxation-ratio, --conductivity or "
                       "--friction-law");
    return RB_OK;
}

rb_status rb_rolling_curve_solve(const rb_rolling_case *rc, const rb_rolling_range *range,
                                 rb_rolling_curve *curve, rb_message *why)
{
    return rb_rolling_curve_observe(rc, range, NULL, NULL, curve, why);
}

rb_status rb_rolling_curve_observe(const rb_rolling_case *rc, const rb_rolling_range *range,
                                   rb_rolling_point *point, void *context, rb_rolling_curve *curve,
                                   rb_message *why)
{
    const watcher w = {point, context, range->units};
    const double start = rb_seconds();
    rb_rolling_case steady = *rc;
    rb_rolling_model model = {0};
    rb_status s = check_curve(rc, range, why);

    memset(curve, 0, sizeof *curve);
    curve->free_creepage = NAN;
    steady.formulation = RB_STEADY;
    /* Two rows per creepage where it is followed there and back. */
    const int returns = range->over != RB_OVER_SPEED && rb_rolling_law_depends_on_state(&steady);
    if (s == RB_OK)
        s = rb_rolling_columns_alloc(&rb_rolling_curve_columns, &steady, 0,
                                     returns ? 2 * range->points : range->points, curve);
    curve->rising = range->points;
    if (s == RB_OK)
        s = (range->over == RB_OVER_SPEED ? over_speeds : over_creepages)(&steady, range, &w,
                                                                          &model, curve, why);
    if (curve->unsolved == 0)
        s = rb_rolling_check_layer_resolved(&model, s, why);
    curve->iterations = model.iterations;
    curve->seconds = rb_seconds() - start;
    rb_rolling_model_free(&model);
    return s;
}
