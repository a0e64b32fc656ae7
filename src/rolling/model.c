/* From a case to a solved contact problem: the choice of the potential contact, the
 * fitted mesh, the given ratios. */
#include "rolling/internal.h"

#include <cblas.h>
#include <stdlib.h>
#include <string.h>

enum {
    ZONE_ROUNDS = 12,
    SEPARATED_AT_END = 3,
    FIT_ROUNDS = 4,
    RATIO_ROUNDS = 40,
    FIRST_FIT = 30,
    MANY_OUTER = 600 /* elements not worth solving to learn where the contact is */
};

void rb_rolling_model_free(rb_rolling_model *model)
{
    rb_rolling_state_free(&model->state);
    rb_rolling_problem_free(&model->problem);
    rb_rolling_bodies_free(&model->bodies);
    rb_rolling_mesh_free(&model->mesh);
    memset(model, 0, sizeof *model);
}

double rb_rolling_model_load(const rb_rolling_model *model)
{
    const rb_rolling_problem *p = &model->problem;
    return cblas_ddot(p->n, p->load_N, 1, model->state.p, 1) +
           cblas_ddot(p->n, p->load_T, 1, model->state.q, 1);
}

double rb_rolling_model_force(const rb_rolling_model *model)
{
    const rb_rolling_problem *p = &model->problem;
    return cblas_ddot(p->n, p->force_N, 1, model->state.p, 1) +
           cblas_ddot(p->n, p->force_T, 1, model->state.q, 1);
}

/* Beyond a gap table nothing is known of the gap: no contact there is a result. */
static rb_status check_within_table(const rb_rolling_model *model, rb_message *why)
{
    const double *ends = model->mesh.ends;
    double from, to;

    if (model->rc.gap != RB_GAP_TABLE)
        return RB_OK;
    rb_rolling_profile_range(model->rc.profile, &from, &to);
    for (int i = 0; i < model->mesh.n; i++) {
        const double middle = 0.5 * (ends[i] + ends[i + 1]);
        if (model->state.zone[i] != RB_ZONE_SEPARATED && (middle < from || middle > to))
            return rb_fail(why, RB_ZONE,
                           "the contact reaches x = %g, and the gap table has x from %g "
                           "to %g only",
                           middle, from, to);
    }
    return RB_OK;
}

rb_status rb_rolling_model_resolve(rb_rolling_model *model, int warm, rb_message *why)
{
    const double start = rb_seconds();
    rb_status s =
        rb_rolling_problem_solve(&model->problem, &model->rc, warm, &model->state, why);

    model->seconds_lcp += rb_seconds() - start;
    model->iterations += model->state.iterations;
    if (s >= 0)
        model->half_width = rb_rolling_hertz_half_width(
            &model->rc, fmax(0.0, rb_rolling_model_load(model)));
    if (s == RB_OK)
        s = check_within_table(model, why);
    return s;
}

/* A given creepage ratio refers to the load, which approach control only finds: secants
 * to the creepage that is the one of the load found with it, as nearly as rounding lets
 * them. */
static rb_status solve_ratio(rb_rolling_model *model, int warm, rb_message *why)
{
    const rb_rolling_case *rc = &model->rc;
    double step = NAN, excess_before = NAN, missing = INFINITY;
    rb_status s = rb_rolling_model_resolve(model, warm, why);

    if (isnan(rc->creep_ratio) || rc->formulation == RB_STATIC ||
        model->problem.load_given)
        return s;
    for (int k = 0; s == RB_OK; k++) {
        const double xi =
            rc->creep_ratio * rc->mu * model->half_width / rb_rolling_radius(rc);
        const double excess = model->problem.xi - xi;
        missing = fabs(excess / xi);
        if (!(missing > 1e-13) || k == RATIO_ROUNDS)
            break;
        const double slope = k > 0 ? (excess - excess_before) / step : 1.0;
        step = -excess / (slope > 0.1 && slope < 10.0 ? slope : 1.0);
        excess_before = excess;
        model->problem.xi += step;
        s = rb_rolling_model_resolve(model, 1, why);
    }
    if (s == RB_OK && missing > fmax(rc->tol, model->problem.rounding))
        s = model->state.status =
            rb_fail(why, RB_MAXITER,
                    "creep-ratio: the load changes with the creepage; after %d rounds "
                    "the two differ by %.2g of the creepage",
                    RATIO_ROUNDS, missing);
    return s;
}

rb_status rb_rolling_model_control(rb_rolling_model *model, rb_message *why)
{
    rb_rolling_set_control(&model->rc, &model->problem);
    return solve_ratio(model, 1, why);
}

static rb_status build_and_solve(rb_rolling_model *model, rb_rolling_mesh *mesh,
                                 rb_message *why);

/* Zones and tractions of a large contact, from fewer elements over the same line. */
static rb_status start_from_coarse(rb_rolling_model *model, rb_message *why)
{
    const double *ends = model->mesh.ends;
    rb_rolling_model coarse = {.rc = model->rc};
    rb_rolling_mesh mesh;

    coarse.rc.contact_elements = rb_rolling_coarse_elements(model->mesh.n);
    rb_status s =
        rb_rolling_mesh_uniform(&coarse.rc, ends[0], ends[model->mesh.n], &mesh, why);
    if (s == RB_OK)
        s = build_and_solve(&coarse, &mesh, why);
    if (s >= 0)
        rb_rolling_start_from(&coarse.mesh, &coarse.state, &model->mesh, &model->state);
    model->iterations += coarse.iterations;
    rb_rolling_model_free(&coarse);
    return s < 0 ? s : RB_OK;
}

/* Takes over the mesh, builds the bodies on it and solves. */
static rb_status build_and_solve(rb_rolling_model *model, rb_rolling_mesh *mesh,
                                 rb_message *why)
{
    rb_rolling_state_free(&model->state);
    rb_rolling_problem_free(&model->problem);
    rb_rolling_bodies_free(&model->bodies);
    rb_rolling_mesh_free(&model->mesh);
    model->mesh = *mesh;
    memset(mesh, 0, sizeof *mesh);
    rb_status s = rb_rolling_bodies_create(&model->rc, &model->mesh, &model->bodies, why);
    if (s == RB_OK)
        s = rb_rolling_problem_create(&model->rc, &model->mesh, &model->bodies, NULL, 0.0,
                                      &model->problem, why);
    if (s == RB_OK)
        s = rb_rolling_state_alloc(model->mesh.n, &model->state);
    const int large = !model->bodies.F;
    if (s == RB_OK && large)
        s = start_from_coarse(model, why);
    return s == RB_OK ? solve_ratio(model, large, why) : s;
}

static rb_status solve_uniform(rb_rolling_model *model, double zone, rb_message *why)
{
    rb_rolling_mesh mesh;
    const rb_status s = rb_rolling_mesh_uniform(&model->rc, -zone, zone, &mesh, why);
    return s == RB_OK ? build_and_solve(model, &mesh, why) : s;
}

/* Elements without contact at the emptier of the two ends; n if there is no contact. */
static int separated_at_ends(const rb_rolling_state *state)
{
    int left = 0, right = 0;

    while (left < state->n && state->zone[left] == RB_ZONE_SEPARATED)
        left++;
    while (right < state->n - left &&
           state->zone[state->n - 1 - right] == RB_ZONE_SEPARATED)
        right++;
    return left == state->n ? state->n : left < right ? left : right;
}

/* Grows the potential contact until three separated elements stand at each end, and
 * tightens it when the contact turns out to fill less than two thirds of it. */
static rb_status solve_automatic_zone(rb_rolling_model *model, double known,
                                      rb_message *why)
{
    const double widest = rb_rolling_widest_zone(&model->rc);
    double zone = known > 0.0
                      ? known
                      : fmin(1.3 * rb_rolling_estimate_half_width(&model->rc), widest);
    double too_narrow = 0.0;
    rb_status s = RB_OK;

    for (int round = 0; round < ZONE_ROUNDS; round++) {
        s = solve_uniform(model, zone, why);
        if (s < 0 || !model->state.p)
            return s;
        const int separated = separated_at_ends(&model->state);
        double from, to;
        if (separated == model->state.n)
            return s;
        if (separated < SEPARATED_AT_END) {
            too_narrow = zone;
            if (zone >= widest)
                return rb_fail(why, RB_ZONE,
                               "the contact does not end within %g of the lowest point",
                               zone);
            zone = fmin(1.3 * zone, widest);
            continue;
        }
        rb_rolling_contact_edges(&model->mesh, model->state.p, &from, &to);
        const double wanted = 1.25 * fmax(fabs(from), fabs(to));
        if (zone < 1.25 * wanted || wanted <= too_narrow)
            return s;
        zone = wanted;
    }
    return s;
}

/* Many elements need not be solved to learn how wide their line should be; 0: unknown. */
static double coarse_zone(const rb_rolling_case *rc)
{
    rb_rolling_case few = *rc;
    rb_rolling_model model;
    double zone = 0.0;

    if (rc->contact_elements < RB_ROLLING_LARGE && rc->outer_elements < MANY_OUTER)
        return zone;
    if (rc->contact_elements >= RB_ROLLING_LARGE)
        few.contact_elements = rb_rolling_coarse_elements(0);
    few.outer_elements = 0;
    few.mesh = RB_MESH_UNIFORM;
    if (rb_rolling_model_create(&few, &model, NULL) == RB_OK)
        zone = model.mesh.ends[model.mesh.n];
    rb_rolling_model_free(&model);
    return zone;
}

/* A potential contact that fills is no potential contact: says how wide it should be. */
static rb_status solve_given_zone(rb_rolling_model *model, rb_message *why)
{
    const rb_status s = solve_uniform(model, model->rc.zone, why);

    if (s < 0 || !model->state.p || separated_at_ends(&model->state) > 0)
        return s;
    rb_rolling_case free_zone = model->rc;
    rb_rolling_model wider = {0};
    free_zone.zone = 0.0;
    const rb_status t = rb_rolling_model_create(&free_zone, &wider, NULL);
    double wanted = 1.3 * model->rc.zone;
    if (t == RB_OK)
        wanted = fmax(fabs(wider.mesh.ends[0]), wider.mesh.ends[wider.mesh.n]);
    rb_rolling_model_free(&wider);
    return rb_fail(
        why, RB_ZONE,
        "zone: the contact fills the potential contact of half-width %g; widen it "
        "to %.4g or leave it out",
        model->rc.zone, wanted);
}

/* Edges that have come to rest; or that go to and fro by less than an element, because
 * another one is the last in contact whenever they move. */
static int rests(double moved, double moved_before, double h)
{
    return moved < 0.1 * h || (moved < 0.5 * h && moved > 0.5 * moved_before);
}

/* theory.md 5.1: from a solution to elements fitted to its edges, until these rest.
 * *moved: how far they came last; INFINITY before the first call. */
static rb_status fit(rb_rolling_model *model, double *moved, rb_message *why)
{
    double from, to, moved_before = INFINITY, h = 0.0;
    rb_status s = RB_OK;

    rb_rolling_contact_edges(&model->mesh, model->state.p, &from, &to);
    for (int round = 0; round < FIT_ROUNDS && s == RB_OK; round++) {
        const double old_from = from, old_to = to;
        rb_rolling_mesh mesh;
        if (round > 0 && rests(*moved, moved_before, h))
            break;
        s = rb_rolling_mesh_fitted(&model->rc, from, to, &mesh, why);
        if (s == RB_OK)
            s = build_and_solve(model, &mesh, why);
        if (s != RB_OK)
            break;
        rb_rolling_contact_edges(&model->mesh, model->state.p, &from, &to);
        moved_before = *moved;
        *moved = fmax(fabs(from - old_from), fabs(to - old_to));
        h = model->mesh.ends[7] - model->mesh.ends[6];
    }
    return s;
}

rb_status rb_rolling_model_refit(rb_rolling_model *model, rb_message *why)
{
    double moved = INFINITY;

    return fit(model, &moved, why);
}

/* A uniform mesh for the answer, or a coarse one to fit the next to. */
static rb_status solve_uniform_stage(const rb_rolling_case *rc, rb_rolling_model *model,
                                     rb_message *why)
{
    if (rc->mesh == RB_MESH_FITTED && rc->zone == 0.0) {
        model->rc.contact_elements =
            FIRST_FIT > rc->contact_elements / 2 ? FIRST_FIT : rc->contact_elements / 2;
        model->rc.near_field = RB_NEAR_FIELD_PLAIN;
        if (rc->outer_elements > MANY_OUTER)
            model->rc.outer_elements = 0;
    }
    const rb_status s = rc->zone > 0.0
                            ? solve_given_zone(model, why)
                            : solve_automatic_zone(model, coarse_zone(&model->rc), why);
    model->rc.contact_elements = rc->contact_elements;
    model->rc.near_field = rc->near_field;
    return s;
}

rb_status rb_rolling_model_create(const rb_rolling_case *rc, rb_rolling_model *model,
                                  rb_message *why)
{
    double moved = INFINITY;

    memset(model, 0, sizeof *model);
    model->rc = *rc;
    rb_status s = rb_rolling_case_check(rc, why);
    if (s == RB_OK)
        s = solve_uniform_stage(rc, model, why);
    if (s == RB_OK && separated_at_ends(&model->state) == model->state.n)
        s = rb_fail(why, RB_NO_CONTACT, "no contact: the bodies do not touch");
    if (s == RB_OK && rc->mesh == RB_MESH_FITTED)
        s = fit(model, &moved, why);
    if (s == RB_OK && model->rc.outer_elements != rc->outer_elements) {
        model->rc.outer_elements = rc->outer_elements;
        s = fit(model, &moved, why);
    }
    return s;
}

/* Similar bodies without a history roll freely at no creepage. */
static int rolls_freely_at_rest(const rb_rolling_problem *problem)
{
    return !problem->coupled && rb_norm_inf((size_t)problem->n, problem->d_T) == 0.0;
}

/* As a case of its own: a fitted mesh belongs to the contact that rolls freely, and a
 * large one starts on fewer elements. */
static rb_status free_creepage_alone(const rb_rolling_model *model, double *creepage,
                                     rb_message *why)
{
    rb_rolling_model freely = {.rc = model->rc};
    rb_rolling_mesh mesh;
    rb_status s;

    freely.rc.creep = freely.rc.creep_ratio = freely.rc.force = NAN;
    freely.rc.force_ratio = 0.0;
    if (model->rc.mesh == RB_MESH_FITTED) {
        const rb_rolling_case rc = freely.rc;
        s = rb_rolling_model_create(&rc, &freely, why);
    } else {
        s = rb_rolling_mesh_uniform(&freely.rc, model->mesh.ends[0],
                                    model->mesh.ends[model->mesh.n], &mesh, why);
        if (s == RB_OK)
            s = build_and_solve(&freely, &mesh, why);
    }
    if (s == RB_OK)
        *creepage = freely.state.xi;
    rb_rolling_model_free(&freely);
    return s;
}

rb_status rb_rolling_free_creepage(rb_rolling_model *model, double *creepage,
                                   rb_message *why)
{
    rb_rolling_problem problem = model->problem; /* arrays stay the model's */
    rb_rolling_state state;

    *creepage = rolls_freely_at_rest(&problem) ? 0.0 : NAN;
    if (*creepage == 0.0)
        return RB_OK;
    if (!problem.F || model->rc.mesh == RB_MESH_FITTED)
        return free_creepage_alone(model, creepage, why);
    rb_status s = rb_rolling_state_alloc(problem.n, &state);
    if (s != RB_OK)
        return s;
    problem.force_given = 1;
    problem.force = problem.force_ratio = 0.0;
    memcpy(state.zone, model->state.zone, (size_t)problem.n * sizeof(int));
    s = rb_rolling_problem_solve(&problem, &model->rc, 1, &state, why);
    if (s == RB_OK)
        *creepage = state.xi;
    rb_rolling_state_free(&state);
    return s;
}

rb_status rb_rolling_free_creepage_if_any(rb_rolling_model *model, double *creepage,
                                          rb_message *why)
{
    rb_message reason = {""};
    const rb_status s = rb_rolling_free_creepage(model, creepage, &reason);

    if (s != RB_OK)
        *creepage = NAN;
    return s == RB_ENOMEM ? rb_fail(why, s, "%s", reason.text) : RB_OK;
}
