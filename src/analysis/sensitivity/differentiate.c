/* Derivatives of the results of a case with respect to one of its numbers (theory-solvers.md,
 * D4). At four (five at the end of a range) values of the number nearby the problem is
 * built anew on the same elements: its equations at the unknowns that are there give the
 * rates, and the results of the unknowns moved along the tangent their derivatives.
 * Elements that the program has placed move with the contact (D6): what that adds follows
 * from the derivatives with respect to two motions of the elements. */
#include "analysis/sensitivity/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of 1 - found_e: edges that stand at midpoints move with them, whatever these do. */
static const double LEAST_DETERMINANT = 0.1;

static const rb_sensitivity_stencil onwards = {3, {0, 1, 2}, {-1.5, 2.0, -0.5}};

void rb_sensitivity_derivative_free(rb_sensitivity_derivative *d)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_solution_free(&d->value[k]);
        rb_contact_state_free(&d->state[k]);
    }
    rb_sensitivity_rate_free(&d->rate);
    if (d->free_rolling)
        rb_sensitivity_derivative_free(d->free_rolling);
    free(d->free_rolling);
    memset(d, 0, sizeof *d);
}

/* ---- Elements that move (D6) ------------------------------------------------------- */

/* (1 - found_e)^-1 from the derivatives of half-width and centre by both motions.  0: the
 * edges do not tell how the elements move. */
static int set_gain(rb_sensitivity *s)
{
    const double *stretched = s->motion[0].edges[0], *shifted = s->motion[1].edges[0];
    const double a[2] = {1.0 - stretched[0], -stretched[1]}, b[2] = {-shifted[0], 1.0 - shifted[1]},
                 det = a[0] * b[1] - b[0] * a[1];

    s->gain[0] = b[1] / det;
    s->gain[1] = -b[0] / det;
    s->gain[2] = -a[1] / det;
    s->gain[3] = a[0] / det;
    return fabs(det) > LEAST_DETERMINANT;
}

/* A stretch of what lies between the edges that the elements follow. */
static rb_sensitivity_move stretch_of(const rb_rolling_model *model)
{
    double edges[2];

    rb_sensitivity_edges_of(model, edges);
    return (rb_sensitivity_move){STRETCH, edges[1], edges[0]};
}

/* The half-width that equal elements of an automatic zone follow. */
static double half_of_zone(const rb_rolling_case *rc)
{
    return rb_rolling_zone_half_width(rc, rb_rolling_derive(rc).load);
}

/* How much the elements are stretched and shifted: as the half-width of the zone grows, or as
 * the contact that is found on them grows and shifts, e' = found' + found_e e'.  v: NULL: no
 * input, which leaves the half-width of the zone as it is. */
static void set_motions(const rb_sensitivity *s, const rb_sensitivity_variants *v,
                        const double edges[2], double by[2])
{
    by[0] = by[1] = 0.0;
    for (int k = 0; s->moves == RB_SENSITIVITY_ZONE && v && k < v->at.n; k++)
        by[0] += v->at.weight[k] / v->step * half_of_zone(v->model[k].rc);
    if (s->moves != RB_SENSITIVITY_EDGES)
        return;
    by[0] = s->gain[0] * edges[0] + s->gain[1] * edges[1];
    by[1] = s->gain[2] * edges[0] + s->gain[3] * edges[1];
}

/* What the motion of the elements changes. */
static void add_motions(const rb_sensitivity *s, const double by[2], double strain[4],
                        rb_rolling_solution *d)
{
    for (int k = 0; k < 2; k++) {
        if (by[k] == 0.0)
            continue;
        rb_sensitivity_blend(d, 1.0, &s->motion[k].value[0], by[k], NULL);
        for (int j = 0; j < 4; j++)
            strain[j] += by[k] * s->motion[k].strain[0][j];
    }
    if (s->moves == RB_SENSITIVITY_EDGES) { /* edges move as the elements there */
        const rb_sensitivity_move m = stretch_of(s->model);
        rb_sensitivity_set_edges(s, by[1] + by[0] * (s->solution.contact_from - m.centre) / m.half,
                                 by[1] + by[0] * (s->solution.contact_to - m.centre) / m.half, d);
    }
}

double rb_sensitivity_creepage(const rb_sensitivity *s, const rb_sensitivity_derivative *d, int k)
{
    double xi = d->state[k].xi;

    for (int j = 0; j < 2; j++)
        xi += d->by[k][j] != 0.0 ? d->by[k][j] * s->motion[j].state[0].xi : 0.0;
    return xi;
}

/* ---- With respect to an input ------------------------------------------------------ */

/* The slip that belongs to a tangent; rate: of an input, or NULL; `released`: element that
 * sticks and begins to slip, or -1. */
static rb_status set_slip(const rb_sensitivity *s, const rb_sensitivity_rate *rate, int released,
                          rb_contact_state *y)
{
    const rb_contact_problem *p = &s->model->problem;
    double *gap = rb_alloc((size_t)s->n, 1);

    if (!gap)
        return RB_ENOMEM;
    for (int i = 0; i < s->n; i++)
        y->lambda[i] = y->xi * p->e_T[i] + (rate ? rate->slip[i] : 0.0);
    rb_contact_operator_add(p->op, y->p, y->q, gap, y->lambda);
    for (int i = 0; i < s->n; i++)
        y->lambda[i] *= s->model->state.zone[i] != RB_ZONE_STICK || i == released;
    free(gap);
    return RB_OK;
}

/* On one side, of elements that move. */
static rb_status differentiate_side(const rb_sensitivity *s, rb_sensitivity_variants *v, int k,
                                    rb_sensitivity_derivative *d, rb_message *why)
{
    rb_contact_state state = v->model[0].state; /* its arrays serve all */
    rb_status status = rb_contact_state_alloc(s->n, &d->state[k]);

    if (status == RB_OK)
        status = rb_sensitivity_tangent(s, &d->rate, k ? 1 : -1, &d->state[k], why);
    if (status == RB_OK)
        status = set_slip(s, &d->rate, -1, &d->state[k]);
    if (status != RB_OK)
        return status;
    const rb_sensitivity_picked x = rb_sensitivity_differentiate_picked(s, v, &d->state[k], &state);
    rb_sensitivity_find_edges(x, d->edges[k]);
    set_motions(s, v, d->edges[k], d->by[k]);
    if (!v->results)
        return RB_OK;
    status = rb_sensitivity_results(s, v, &d->state[k], &d->value[k], why);
    if (status == RB_OK) {
        rb_sensitivity_set_picked(s, v, x, d->state[k].delta, d->strain[k], &d->value[k]);
        add_motions(s, d->by[k], d->strain[k], &d->value[k]);
        rb_sensitivity_set_strain(s, k, d);
    }
    return status;
}

/* On the sides that d has.  others: variants for the same input, of the model to which this is
 * free rolling; NULL: it is not. */
static rb_status differentiate_sides(const rb_sensitivity *s, const rb_sensitivity_input *input,
                                     const rb_sensitivity_variants *others,
                                     rb_sensitivity_variants *v, rb_sensitivity_derivative *d,
                                     rb_message *why)
{
    rb_status status =
        rb_sensitivity_variants_create(s->model, input, others, others != NULL, v, why);

    if (status == RB_OK)
        status = rb_sensitivity_rate_alloc(s->n, &d->rate);
    if (status == RB_OK)
        status = rb_sensitivity_rates_at(s, v, &d->rate, why);
    /* over a friction of 0; surfaces that do not slide rest */
    if (status == RB_OK && !isfinite(d->rate.tangential) && s->at_rest < s->contact)
        status = rb_fail(why, RB_EINVAL,
                         "derivatives: a given force does not tell the creepage of surfaces that "
                         "slide without friction");
    for (int k = 0; k < 2 && status == RB_OK; k++)
        if (d->has[k])
            status = differentiate_side(s, v, k, d, why);
    return status;
}

/* Of variants that borrow the operator of the model it does not tell whether they are coupled. */
static int is_coupled(const rb_rolling_model *v)
{
    const rb_rolling_case *rc = v->rc;
    rb_rolling_body a = rc->a;

    if (rb_rolling_can(rc, RB_BODY_FLAT)) { /* the depth of zero displacement couples nothing */
        a.radius = rc->b.radius;
        a.datum = rc->b.datum;
        a.strip = rc->b.strip;
    }
    return rb_contact_operator_response(v->problem.op).coupled ||
           fabs(rb_rolling_derive(rc).dundurs) >= 1e-12 ||
           (!rb_rolling_can(rc, RB_BODY_FLAT | RB_BODY_HOMOGENEOUS | RB_BODY_ELASTIC) &&
            memcmp(&a, &rc->b, sizeof a) != 0);
}

/* Free rolling has its own equations. */
static rb_status differentiate_free(const rb_sensitivity *s, const rb_sensitivity_input *input,
                                    const rb_sensitivity_variants *of, rb_sensitivity_derivative *d,
                                    rb_message *why)
{
    const rb_sensitivity *freely = s->free_rolling;
    /* Bodies without coupling roll freely at no creepage, unless the input makes them unlike. */
    int rests = s->model->rc->formulation == RB_STEADY &&
                !rb_contact_operator_response(s->model->problem.op).coupled;
    rb_status status = RB_OK;

    for (int k = 0; k < of->at.n && of->bodies; k++)
        rests &= !is_coupled(&of->model[k]);
    if (freely && input->vary) {
        rb_sensitivity_derivative *f = d->free_rolling = calloc(1, sizeof *f);
        rb_sensitivity_variants v = *of;
        v.base = freely->model;
        v.perturbation = freely->perturbation;
        v.results = 0;
        memset(v.model, 0, sizeof v.model);
        memset(v.of, 0, sizeof v.of);
        if (!f)
            return RB_ENOMEM;
        memcpy(f->has, d->has, sizeof f->has);
        status = differentiate_sides(freely, input, of, &v, f, why);
        rb_sensitivity_variants_free(&v);
    }
    if (d->free_rolling && status != RB_OK && status != RB_ENOMEM) {
        /* what free rolling has not, the other results have */
        rb_sensitivity_derivative_free(d->free_rolling);
        free(d->free_rolling);
        d->free_rolling = NULL;
        status = RB_OK;
    }
    for (int k = 0; k < 2 && status == RB_OK; k++) /* between two zones its elements stay */
        d->value[k].free_creepage = rests ? 0.0
                                    : !d->free_rolling || !d->has[k] || freely->moves != s->moves
                                        ? NAN
                                        : rb_sensitivity_creepage(freely, d->free_rolling, k);
    return status;
}

rb_status rb_sensitivity_differentiate(const rb_sensitivity *s, const rb_sensitivity_input *input,
                                       rb_sensitivity_derivative *d, rb_message *why)
{
    rb_sensitivity_variants v = {.base = s->model, .perturbation = s->perturbation, .results = 1};

    memset(d, 0, sizeof *d);
    if (s->solution.n == 0)
        return rb_fail(why, RB_EINVAL, "derivatives: made without results");
    rb_status status = rb_sensitivity_choose_places(s, input, &v, why);
    const int both = v.at.n == rb_sensitivity_middle.n,
              two = s->degenerate > 0 || (s->free_rolling && s->free_rolling->degenerate);
    d->has[0] = both || v.at.place[1] < 0.0;
    d->has[1] = both ? two : !d->has[0];
    if (status == RB_OK)
        status = differentiate_sides(s, input, NULL, &v, d, why);
    if (status == RB_OK && both && !d->has[1] && rb_sensitivity_strain_has_sides(s, d->strain[0])) {
        d->has[1] = 1;
        status = differentiate_side(s, &v, 1, d, why);
    }
    if (status == RB_OK)
        status = differentiate_free(s, input, &v, d, why);
    rb_sensitivity_variants_free(&v);
    if (status != RB_OK)
        return status;
    for (int k = 0; k < 2; k++)
        if (d->has[k]) {
            d->value[k].stick_length = rb_sensitivity_stick_length(s, input->scale, d, k);
            rb_sensitivity_clean(s, input->scale, &d->value[k]);
        }
    if (both && d->has[1] && rb_sensitivity_unite_sides(d)) {
        rb_rolling_solution_free(&d->value[1]);
        d->has[1] = 0;
    }
    d->sides = both && !d->has[1] ? 1 : 2;
    return status;
}

/* ---- Along a line ------------------------------------------------------------------ */

rb_status rb_sensitivity_along(const rb_sensitivity *s, const rb_sensitivity_rate *rate,
                               int released, rb_sensitivity_derivative *d, rb_message *why)
{
    rb_contact_state scratch = {0};

    memset(d, 0, sizeof *d);
    rb_status status = rb_contact_state_alloc(s->n, &d->state[0]);
    if (status == RB_OK)
        status = rb_contact_state_alloc(s->n, &scratch);
    if (status == RB_OK)
        status = rb_sensitivity_tangent(s, rate, 1, &d->state[0], why);
    if (status == RB_OK)
        status = set_slip(s, NULL, released, &d->state[0]);
    if (status == RB_OK) {
        rb_sensitivity_find_edges(
            rb_sensitivity_differentiate_picked(s, NULL, &d->state[0], &scratch), d->edges[0]);
        set_motions(s, NULL, d->edges[0], d->by[0]);
    }
    rb_contact_state_free(&scratch);
    return status;
}

/* to += factor times x. */
static void add_state(rb_contact_state *to, double factor, const rb_contact_state *x)
{
    for (int i = 0; i < to->n; i++) {
        to->p[i] += factor * x->p[i];
        to->q[i] += factor * x->q[i];
        to->lambda[i] += factor * x->lambda[i];
    }
    to->delta += factor * x->delta;
    to->xi += factor * x->xi;
}

/* The results of state y, with its slips. */
static rb_status results_of(const rb_contact_state *y, rb_rolling_model *v,
                            rb_rolling_solution *results, rb_message *why)
{
    rb_rolling_variant_set(y, NULL, 0.0, &v->state);
    rb_status status = rb_rolling_variant_complete(v, NULL, NULL, why);

    memcpy(v->state.lambda, y->lambda, (size_t)y->n * sizeof *y->lambda);
    if (status == RB_OK)
        status = rb_rolling_bare_solution(v, results, why);
    return status == RB_OK ? rb_rolling_set_temperature(v, results, why) : status;
}

rb_status rb_sensitivity_add_jump(const rb_sensitivity *s, const rb_sensitivity_derivative *line,
                                  int element, double factor, double ahead, int k,
                                  rb_sensitivity_derivative *d, rb_message *why)
{
    /* to the side on which friction heats, as it does on one side of the change */
    const double way = line->state[0].lambda[element] * s->model->state.q[element] > 0.0 ? -1 : 1,
                 step = way * RB_SENSITIVITY_STEP_OF_BODIES;
    rb_rolling_model v = {.mesh = {.n = 0}};
    rb_rolling_solution moved[3] = {{0}};
    rb_contact_state y = {0};
    double strain[4];
    rb_status status = rb_contact_state_alloc(s->n, &y);

    if (status == RB_OK)
        status = rb_rolling_variant_create(s->model, s->model->rc, 1, 0, NULL, &v, why);
    for (int j = 0; j < onwards.n && status == RB_OK; j++) {
        rb_rolling_variant_set(&s->model->state, NULL, 0.0, &y);
        memcpy(y.lambda, s->model->state.lambda, (size_t)s->n * sizeof *y.lambda);
        add_state(&y, ahead, &d->state[k]);
        for (int m = 0; m < 2; m++)
            if (d->by[k][m] != 0.0)
                add_state(&y, ahead * d->by[k][m], &s->motion[m].state[0]);
        y.lambda[element] = 0.0; /* it changes its zone there */
        add_state(&y, onwards.place[j] * step, &line->state[0]);
        status = results_of(&y, &v, &moved[j], why);
    }
    if (status == RB_OK) {
        rb_sensitivity_combine(s, &onwards, step, moved);
        rb_sensitivity_set_picked(s, NULL,
                                  rb_sensitivity_differentiate_picked(s, NULL, &line->state[0], &y),
                                  line->state[0].delta, strain, &moved[1]);
        add_motions(s, line->by[0], strain, &moved[1]);
        rb_sensitivity_blend(&d->value[k], 1.0, &moved[1], factor, NULL);
        for (int j = 0; j < 4; j++)
            d->strain[k][j] += factor * strain[j];
        rb_sensitivity_set_strain(s, k, d);
    }
    for (int j = 0; j < onwards.n; j++)
        rb_rolling_solution_free(&moved[j]);
    rb_rolling_variant_free(s->model, &v);
    rb_contact_state_free(&y);
    return status;
}

/* ---- Two motions of the elements --------------------------------------------------- */

/* Those that the program has placed: fitted to the edges of the only patch, or equal ones
 * of an automatic zone under a gap that is symmetric. */
static int motion_of(const rb_sensitivity *s)
{
    const rb_rolling_model *model = s->model;
    const rb_rolling_case *rc = model->rc;
    const int equal = rc->mesh == RB_MESH_UNIFORM || model->equal_instead;

    if (s->degenerate > 0 || s->solution.patches != 1 || s->solution.contact < 6 ||
        (equal && rc->zone > 0.0) || rc->mesh == RB_MESH_PUNCH)
        return RB_SENSITIVITY_FIXED;
    return !equal                                      ? RB_SENSITIVITY_EDGES
           : rc->gap == RB_GAP_TABLE || rc->worn.n > 0 ? RB_SENSITIVITY_FIXED
                                                       : RB_SENSITIVITY_ZONE;
}

static rb_status differentiate_motions(rb_sensitivity *s, int moves)
{
    rb_sensitivity_move m = moves == RB_SENSITIVITY_EDGES
                                ? stretch_of(s->model)
                                : (rb_sensitivity_move){STRETCH, 0.0, half_of_zone(s->model->rc)};
    const rb_sensitivity_input input = {0.0, m.half, -INFINITY, INFINITY, NULL, &m};
    rb_status status = RB_OK;

    for (int k = 0; k < moves && status == RB_OK; k++) { /* as many motions */
        rb_sensitivity_variants v = {
            .base = s->model,
            .perturbation = s->perturbation,
            .results = s->solution.n > 0,
            .at = rb_sensitivity_middle,
            .is_long = rb_sensitivity_has_wheels(s->model),
            .step = (rb_sensitivity_has_wheels(s->model) ? RB_STEP_OF_WHEELS : 1.0) *
                    RB_SENSITIVITY_STEP_OF_BODIES * m.half,
            .scale = m.half};
        rb_message why;
        m.kind = k ? SHIFT : STRETCH;
        s->motion[k].has[0] = 1;
        status = differentiate_sides(s, &input, NULL, &v, &s->motion[k], &why);
        rb_sensitivity_variants_free(&v);
        if (status == RB_OK && v.results)
            rb_sensitivity_clean(s, m.half, &s->motion[k].value[0]);
    }
    if (status == RB_OK && (moves != RB_SENSITIVITY_EDGES || set_gain(s)))
        s->moves = moves;
    return status == RB_ENOMEM ? status : RB_OK;
}

rb_status rb_sensitivity_set_motion(rb_sensitivity *s)
{
    const int moves = motion_of(s);
    rb_status status = differentiate_motions(s, moves);

    if (status == RB_OK && s->free_rolling && !s->free_rolling->degenerate)
        status = differentiate_motions(s->free_rolling, moves);
    return status;
}
