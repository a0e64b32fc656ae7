/* Derivatives of the results of a case with respect to one of its numbers (theory.md,
 * D4). At four (five at the end of a range) values of the number nearby the problem is
 * built anew on the same elements: its equations at the unknowns that are there give the
 * rates, and the results of the unknowns moved along the tangent their derivatives.
 * Elements that the program has placed move with the contact (D6): what that adds follows
 * from the derivatives with respect to two motions of the elements. */
#include "sensitivity/internal.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

/* Parts of the input's scale: where flexibilities change, which are known to fewer
 * digits, and where they do not. */
static const double STEP_OF_BODIES = 5e-4, STEP = 2e-5;

/* The same, of a step along the tangent within which no other element comes first, and the
 * pressure beside an edge hardly changes. */
static const double STEP_OF_STATE = 5e-7;

/* A change of a result over the input's scale that is none, as a part of its size. */
static const double ROUNDING = 1e-11;

/* Of 1 - found_e: edges that stand at midpoints move with them, whatever these do. */
static const double LEAST_DETERMINANT = 0.1;

/* Elements by which the edge found may miss the end of an aligned element. */
static const double LARGEST_MISS = 5e-3;

enum { PLACES = RB_SENSITIVITY_PLACES };

static const rb_sensitivity_stencil nearest = {2, {-1, 1}, {-0.5, 0.5}};
static const rb_sensitivity_stencil behind = {
    5, {0, -1, -2, -3, -4}, {25 / 12., -48 / 12., 36 / 12., -16 / 12., 3 / 12.}};

const rb_sensitivity_stencil *rb_sensitivity_stencil_of(const rb_sensitivity_input *input,
                                                        double step)
{
    const int can_fall = input->value - 2.0 * step > input->from,
              can_grow = input->value + 2.0 * step < input->to;

    return can_fall && can_grow ? &rb_sensitivity_middle
           : can_grow           ? &rb_sensitivity_ahead
           : can_fall           ? &behind
                                : NULL;
}

int rb_sensitivity_has(const rb_rolling_result *r)
{
    return r->kind == RB_RESULT_NUMBER && !r->no_derivative;
}

void rb_sensitivity_derivative_free(rb_sensitivity_derivative *d)
{
    for (int k = 0; k < 2; k++)
        rb_rolling_solution_free(&d->value[k]);
    rb_sensitivity_rate_free(&d->rate);
    memset(d, 0, sizeof *d);
}

/* ---- Variants ---------------------------------------------------------------------- */

typedef struct {
    const rb_rolling_model *base;
    int results; /* 0: rates alone */
    int bodies;  /* 1: they or the interlayer change with the input */
    int own;     /* 1: the bodies do; where they are compressed, each place has its own */
    rb_sensitivity_stencil at;
    double step, scale;
    rb_rolling_model model[PLACES];
    const rb_rolling_model *of[PLACES]; /* that each has borrowed from */
} variants;

/* Step and stencil: both ways where the range allows it. */
static rb_status choose_places(const rb_sensitivity *s, const rb_sensitivity_input *input,
                               variants *v, rb_message *why)
{
    const double longest = STEP_OF_BODIES * input->scale, x = input->value;
    const int falls = x + longest > input->to;
    rb_rolling_case rc;
    const rb_status status =
        input->vary ? input->vary(input->context, x + (falls ? -longest : longest), &rc, why)
                    : RB_OK;

    if (status != RB_OK)
        return status;
    v->bodies = !input->vary || !rb_rolling_same_bodies(&rc, s->model->rc);
    if (v->bodies && input->vary) {
        rc.interlayer_normal = s->model->rc->interlayer_normal;
        rc.interlayer_tangential = s->model->rc->interlayer_tangential;
        v->own = !rb_rolling_same_bodies(&rc, s->model->rc) && rb_rolling_is_compressed(s->model);
    }
    v->step = (v->bodies ? STEP_OF_BODIES : STEP) * input->scale;
    v->scale = input->scale;
    const rb_sensitivity_stencil *at = rb_sensitivity_stencil_of(input, v->step);
    if (!at)
        return rb_fail(why, RB_EINVAL, "derivatives: the input cannot vary within its range");
    v->at = *at;
    return RB_OK;
}

static rb_rolling_case on_the_same_elements(const rb_rolling_case *rc, const rb_rolling_case *of,
                                            int n)
{
    rb_rolling_case varied = *rc;

    varied.mesh = of->mesh;
    varied.slip_operator = of->slip_operator;
    varied.outer_refinement = of->outer_refinement;
    varied.outer_elements = of->outer_elements;
    varied.contact_elements = of->mesh == RB_MESH_UNIFORM ? n : of->contact_elements;
    return varied;
}

static void variants_free(variants *v)
{
    for (int k = 0; k < v->at.n; k++)
        if (v->of[k])
            rb_rolling_variant_free(v->of[k], &v->model[k]);
}

/* An input that cannot vary is a motion of the elements, of this kind. */
typedef struct {
    enum { STRETCH, SHIFT } kind;
    double centre, half; /* of what is stretched */
} motion;

static rb_status variants_at_places(const rb_rolling_model *base, const rb_sensitivity_input *input,
                                    const variants *others, int freely, variants *v,
                                    rb_message *why)
{
    rb_status s = RB_OK;

    for (int k = 0; k < v->at.n && s == RB_OK; k++) {
        const double by = v->at.place[k] * v->step;
        /* Another model's variant has the flexibility too, if it was computed for it on the same
         * elements; by formula it has that of its own tractions alone. */
        const rb_rolling_model *other = others ? &others->model[k] : NULL;
        const int lends = other && others->step == v->step && other->bodies.f.data &&
                          other->bodies.f.data != others->base->bodies.f.data &&
                          other->mesh.n == base->mesh.n &&
                          memcmp(others->base->mesh.ends, base->mesh.ends,
                                 (size_t)base->mesh.n * sizeof *base->mesh.ends) == 0;
        const rb_rolling_model *of = v->of[k] = lends ? other : base;
        rb_rolling_case rc;
        if (!input->vary) {
            const motion *m = input->context;
            s = m->kind == SHIFT ? rb_rolling_variant_move(base, by, 1.0, &v->model[k], why)
                                 : rb_rolling_variant_move(base, -by * m->centre / m->half,
                                                           1.0 + by / m->half, &v->model[k], why);
        } else {
            s = input->vary(input->context, input->value + by, &rc, why);
            if (s != RB_OK)
                return s;
            rc = on_the_same_elements(&rc, base->rc, base->mesh.n);
            if (freely)
                rc = rb_rolling_without_force(&rc);
            s = rb_rolling_variant_create(of, &rc, v->results, of == base && v->own, &v->model[k],
                                          why);
            if (s == RB_OK && of != base)
                rb_rolling_variant_set(&base->state, NULL, 0.0, &v->model[k].state);
        }
        if (s == RB_OK && !rb_rolling_same_sides(base, &v->model[k]))
            s = rb_fail(why, RB_INACCURATE,
                        "the elements outside the contact change with the input");
    }
    return s;
}

/* others: for the same values of the input, of the model in free rolling its model; or NULL.
 * The step is made smaller where the elements outside the contact change within it. */
static rb_status variants_create(const rb_rolling_model *base, const rb_sensitivity_input *input,
                                 const variants *others, int freely, variants *v, rb_message *why)
{
    enum { TRIALS = 3 };
    rb_status s = RB_INACCURATE;

    for (int k = 0; k < TRIALS && s == RB_INACCURATE; k++) {
        if (k > 0) {
            variants_free(v);
            memset(v->model, 0, sizeof v->model);
            v->step *= 0.1;
        }
        s = variants_at_places(base, input, others, freely, v, why);
    }
    return s;
}

/* D2: how the equations change while the unknowns stay. */
static rb_status rates(variants *v, rb_sensitivity_rate *rate, rb_message *why)
{
    rb_sensitivity_rate left;
    rb_status s = rb_sensitivity_rate_alloc(v->base->mesh.n, &left);

    for (int k = 0; k < v->at.n && s == RB_OK; k++) {
        s = rb_sensitivity_residual(v->base, &v->model[k], &left, why);
        rb_sensitivity_rate_add(&left, v->at.weight[k] / v->step, rate);
    }
    rb_sensitivity_rate_free(&left);
    return s;
}

rb_status rb_sensitivity_rates(const rb_sensitivity *s, const rb_sensitivity_input *input,
                               rb_sensitivity_rate *rate, double *mu, rb_message *why)
{
    const rb_rolling_model *model = s->model;
    variants v = {.base = model};
    rb_sensitivity_rate left = {0};
    rb_status status = choose_places(s, input, &v, why);

    memset(rate, 0, sizeof *rate);
    *mu = 0.0;
    if (v.at.n == rb_sensitivity_middle.n)
        v.at = nearest;
    if (status == RB_OK)
        status = rb_sensitivity_rate_alloc(s->n, rate);
    if (status == RB_OK)
        status = rb_sensitivity_rate_alloc(s->n, &left);
    for (int k = 0; k < v.at.n && status == RB_OK; k++) {
        const double weight = v.at.weight[k] / v.step;
        rb_rolling_case rc;
        rb_contact_problem given;
        status = input->vary(input->context, input->value + v.at.place[k] * v.step, &rc, why);
        if (status != RB_OK)
            break;
        rc = on_the_same_elements(&rc, model->rc, s->n);
        if (!v.own && rb_rolling_variant_given(model, &rc, left.bound, &given, &status, why)) {
            rb_sensitivity_given(model, &given, &model->state, &left);
            *mu += weight * given.mu;
        } else {
            status = rb_rolling_variant_create(model, &rc, 0, v.own, &v.model[k], why);
            if (status == RB_OK)
                status = rb_sensitivity_residual(model, &v.model[k], &left, why);
            *mu += weight * v.model[k].problem.mu;
            rb_rolling_variant_free(model, &v.model[k]);
        }
        rb_sensitivity_rate_add(&left, weight, rate);
    }
    rb_sensitivity_rate_free(&left);
    return status;
}

/* ---- Results ----------------------------------------------------------------------- */

static double *number_of(const rb_rolling_result *r, rb_rolling_solution *s)
{
    return (double *)(void *)((char *)s + r->offset);
}

/* NULL: s has no such column, or it has no derivative. */
static double *column_of(const rb_rolling_result *r, rb_rolling_solution *s)
{
    return rb_sensitivity_has(r) && rb_rolling_has_column(r, s)
               ? *(double **)(void *)((char *)s + r->offset)
               : NULL;
}

/* d = keep d + weight (x - less) of all that has derivatives; NULL: nothing. */
static void blend(rb_rolling_solution *d, double keep, const rb_rolling_solution *x, double weight,
                  const rb_rolling_solution *less)
{
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        if (rb_sensitivity_has(r))
            *number_of(r, d) =
                (keep != 0.0 ? keep * *number_of(r, d) : 0.0) +
                (x ? weight * (rb_rolling_number(r, x) - (less ? rb_rolling_number(r, less) : 0.0))
                   : 0.0);
    }
    for (int k = 0; k < rb_rolling_solution_columns.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_columns.row[k];
        double *to = column_of(r, d);
        for (int i = 0; i < d->n && to; i++)
            to[i] = (keep != 0.0 ? keep * to[i] : 0.0) +
                    (x ? weight * (rb_rolling_entry(r, x, i) -
                                   (less ? rb_rolling_entry(r, less, i) : 0.0))
                       : 0.0);
    }
}

void rb_sensitivity_add(rb_rolling_solution *d, double factor, const rb_rolling_solution *x)
{
    blend(d, 1.0, x, factor, NULL);
}

void rb_sensitivity_scale(rb_rolling_solution *s, double factor)
{
    blend(s, factor, NULL, 0.0, NULL);
}

/* In the place of the second one the derivative: weights times what each has more than
 * the first one, so that what does not change has a derivative of exactly 0. */
static void combine(const rb_sensitivity_stencil *at, double step, rb_rolling_solution *moved)
{
    for (int j = 1; j < at->n; j++)
        blend(&moved[1], j > 1, &moved[j], at->weight[j] / step, &moved[0]);
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        if (r->kind != RB_RESULT_WHOLE && !rb_sensitivity_has(r))
            *number_of(r, &moved[1]) = NAN;
    }
}

/* (D4) the results at the places of the stencil, moved along the tangent. */
static rb_status differentiate_results(variants *v, const rb_contact_state *tangent,
                                       rb_rolling_solution *d, rb_message *why)
{
    rb_rolling_solution moved[PLACES] = {{0}};
    rb_status s = RB_OK;

    for (int k = 0; k < v->at.n && s == RB_OK; k++) {
        rb_rolling_variant_set(&v->base->state, tangent, v->at.place[k] * v->step,
                               &v->model[k].state);
        s = rb_rolling_variant_complete(&v->model[k], NULL, NULL, why);
        if (s == RB_OK)
            s = rb_rolling_variant_solution(&v->model[k], &moved[k], why);
    }
    if (s == RB_OK)
        combine(&v->at, v->step, moved);
    *d = moved[1];
    for (int k = 0; k < v->at.n; k++)
        if (k != 1)
            rb_rolling_solution_free(&moved[k]);
    return s;
}

/* Results that are found at elements which a change may exchange for others: the edges of
 * the contact, those that elements follow (D6), and the largest pressure. */
typedef struct {
    double from, to, followed_from, followed_to, peak;
} picked;

/* Where p^2, on a line through the second and third element in contact, is zero, on the
 * side -1 or 1; NAN: too few are in contact. */
static double zero_of(const rb_rolling_mesh *mesh, const rb_contact_state *state, int side)
{
    const double *p = state->p, *ends = mesh->ends;
    int j = side > 0 ? state->n - 1 : 0;

    while (j >= 0 && j < state->n && state->zone[j] == RB_ZONE_SEPARATED)
        j -= side;
    j -= side;
    const int i = j - side;
    if (i < 0 || i >= state->n)
        return NAN;
    const double fall = gsl_pow_2(p[j] / p[i]),
                 apart = 0.5 * (ends[j] + ends[j + 1] - ends[i] - ends[i + 1]);
    return 0.5 * (ends[j] + ends[j + 1]) + apart * fall / (1.0 - fall);
}

/* 1: aligned elements end where the contact that is found on them does, and not at the
 * outer side of a jump. */
static int are_aligned(const rb_rolling_model *model)
{
    const double *ends = model->mesh.ends, h = ends[1] - ends[0];
    double from, to;

    rb_rolling_contact_edges(model->rc, &model->mesh, &model->state, &from, &to);
    const double across[2] = {(from - ends[0]) / h, (to - ends[0]) / h};
    return model->rc->mesh == RB_MESH_ALIGNED &&
           fabs(across[0] - round(across[0])) < LARGEST_MISS &&
           fabs(across[1] - round(across[1])) < LARGEST_MISS;
}

/* Elements follow the edges that they were aligned with; otherwise, as those that a mesh is
 * fitted to jump with its elements, the zeros of p^2. */
static picked pick(const rb_rolling_model *of, const rb_contact_state *state, int aligned)
{
    rb_rolling_model model = *of; /* borrows */
    picked x;

    model.state = *state;
    rb_rolling_contact_edges(model.rc, &model.mesh, state, &x.from, &x.to);
    x.followed_from = aligned ? x.from : zero_of(&model.mesh, state, -1);
    x.followed_to = aligned ? x.to : zero_of(&model.mesh, state, 1);
    x.peak = rb_rolling_peak_pressure(&model);
    return x;
}

static void add_picked(double weight, picked x, picked *sum)
{
    sum->from += weight * x.from;
    sum->to += weight * x.to;
    sum->followed_from += weight * x.followed_from;
    sum->followed_to += weight * x.followed_to;
    sum->peak += weight * x.peak;
}

/* Their derivatives: by the input where the state stays, and along the tangent. */
static picked differentiate_picked(const variants *v, const rb_contact_state *tangent)
{
    const int aligned = are_aligned(v->base);
    const double step = STEP_OF_STATE * v->scale;
    rb_contact_state state = v->model[0].state; /* its arrays serve all */
    picked d = {0.0, 0.0, 0.0, 0.0, 0.0};

    rb_rolling_variant_set(&v->base->state, NULL, 0.0, &state);
    for (int k = 0; k < v->at.n; k++)
        add_picked(v->at.weight[k] / v->step, pick(&v->model[k], &state, aligned), &d);
    for (int side = -1; side < 2; side += 2) {
        rb_rolling_variant_set(&v->base->state, tangent, side * step, &state);
        add_picked(0.5 * side / step, pick(v->base, &state, aligned), &d);
    }
    return d;
}

/* Half-width and centre between the edges that elements follow. */
static void find_edges(picked x, double edges[2])
{
    edges[0] = 0.5 * (x.followed_to - x.followed_from);
    edges[1] = 0.5 * (x.followed_to + x.followed_from);
}

/* Of the edges of the contact, and what follows from them. */
static void set_edges(const rb_sensitivity *s, double from, double to, rb_rolling_solution *d)
{
    const rb_rolling_solution *at = &s->solution;
    const double radius = rb_rolling_derive(s->model->rc).radius, before = d->half_width;

    d->contact_from = from;
    d->contact_to = to;
    d->nip_width = to - from;
    d->half_width = 0.5 * d->nip_width;
    d->peclet += at->peclet / at->half_width * (d->half_width - before);
    if (at->max_strain == 0.5 * at->half_width / radius)
        d->max_strain += 0.5 * (d->half_width - before) / radius;
}

/* The warmest element is that of the solution, though another one may be warmer at the
 * places of the stencil. */
static rb_status set_peak_temperature(const rb_sensitivity *s, const variants *v,
                                      rb_rolling_solution *d)
{
    const rb_rolling_solution *at = &s->solution;
    const double step = STEP_OF_STATE * v->scale;
    double peak[2], x;

    if (!at->temperature)
        return RB_OK;
    double *t = rb_alloc((size_t)s->n, 1);
    for (int k = 0; k < 2 && t; k++) {
        for (int i = 0; i < s->n; i++)
            t[i] = at->temperature[i] + (k ? step : -step) * d->temperature[i];
        rb_rolling_peak_temperature(s->n, at->x, at->zone, t, &peak[k], &x);
    }
    d->max_temperature = t ? (peak[1] - peak[0]) / (2.0 * step) : NAN;
    free(t);
    return t ? RB_OK : RB_ENOMEM;
}

/* What follows from the rates on one side, on elements that move as the input says; edges:
 * of those that elements follow. */
static rb_status differentiate_side(const rb_sensitivity *s, variants *v, int side,
                                    const rb_sensitivity_rate *rate, rb_rolling_solution *d,
                                    double edges[2], rb_message *why)
{
    rb_contact_state tangent;
    rb_status status = rb_contact_state_alloc(s->n, &tangent);

    if (status == RB_OK)
        status = rb_sensitivity_tangent(s, rate, side, &tangent, why);
    if (status == RB_OK)
        status = differentiate_results(v, &tangent, d, why);
    if (status == RB_OK) {
        const picked x = differentiate_picked(v, &tangent);
        d->max_pressure = x.peak;
        set_edges(s, x.from, x.to, d);
        find_edges(x, edges);
        status = set_peak_temperature(s, v, d);
    }
    rb_contact_state_free(&tangent);
    return status;
}

/* 1: both sides have the same derivatives, but for rounding. */
static int sides_agree(const rb_sensitivity_derivative *d)
{
    double worst = 0.0;

    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        const double x = rb_rolling_number(r, &d->value[0]), y = rb_rolling_number(r, &d->value[1]);
        if (rb_sensitivity_has(r) && !(isnan(x) && isnan(y)) && x != y)
            worst = fmax(worst, fabs(x - y) / fmax(fabs(x), fabs(y)));
    }
    return worst < 1e-8;
}

double rb_sensitivity_rounding(const rb_rolling_case *rc, const rb_rolling_result *r, double value)
{
    const rb_rolling_derived d = rb_rolling_derive(rc);
    const char *unit = r->unit ? r->unit : "1";
    const double P = isnan(d.load) ? d.stress * d.half_width : d.load,
                 strain = d.half_width / d.radius;
    const int is_share = r->error_bar == RB_SCALE_ONE && !r->is_mean;
    const int is_loss =
        r->is_mean || r->error_bar == RB_SCALE_POWER || r->error_bar == RB_SCALE_WORK;
    const double usual = strcmp(unit, "mm") == 0              ? strain * d.half_width
                         : strcmp(unit, "MPa") == 0           ? d.stress
                         : strcmp(unit, "N/mm") == 0          ? (is_loss ? strain * P : P)
                         : strcmp(unit, "N") == 0             ? P * d.half_width
                         : strcmp(unit, "K") == 0 || is_share ? 1.0
                                                              : strain;

    return ROUNDING * fmax(usual, fabs(value));
}

/* What is rounding of the result is no change. */
static void clean(const rb_sensitivity *s, double scale, rb_rolling_solution *d)
{
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        if (rb_sensitivity_has(r) &&
            fabs(*number_of(r, d)) * scale <
                rb_sensitivity_rounding(s->model->rc, r, rb_rolling_number(r, &s->solution)))
            *number_of(r, d) = 0.0;
    }
}

/* (D6) how an input moves the elements: stretches them as Hertz's half-width grows, or as
 * the contact that is found on them grows and shifts, e' = found' + found_e e'. */
static void motions_of(const rb_sensitivity *s, int moves, const variants *v, const double edges[2],
                       double by[2])
{
    by[0] = by[1] = 0.0;
    for (int k = 0; k < v->at.n && moves == RB_SENSITIVITY_HERTZ; k++)
        by[0] += v->at.weight[k] / v->step * rb_rolling_derive(v->model[k].rc).half_width;
    if (moves != RB_SENSITIVITY_EDGES)
        return;
    by[0] = s->gain[0] * edges[0] + s->gain[1] * edges[1];
    by[1] = s->gain[2] * edges[0] + s->gain[3] * edges[1];
}

/* (1 - found_e)^-1 from the derivatives of half-width and centre by both motions.  0: the
 * edges do not tell how the elements move. */
static int set_gain(rb_sensitivity *s, const double stretched[2], const double shifted[2])
{
    const double a[2] = {1.0 - stretched[0], -stretched[1]}, b[2] = {-shifted[0], 1.0 - shifted[1]},
                 det = a[0] * b[1] - b[0] * a[1];

    s->gain[0] = b[1] / det;
    s->gain[1] = -b[0] / det;
    s->gain[2] = -a[1] / det;
    s->gain[3] = a[0] / det;
    return fabs(det) > LEAST_DETERMINANT;
}

/* A stretch of what lies between the edges that the elements follow. */
static motion stretch_of(const rb_rolling_model *model)
{
    double edges[2];

    find_edges(pick(model, &model->state, are_aligned(model)), edges);
    return (motion){STRETCH, edges[1], edges[0]};
}

/* The tangent of free rolling, which has its own equations, and what the motion of its
 * elements adds to its creepage. */
static rb_status differentiate_free(const rb_sensitivity *freely, const rb_sensitivity_input *input,
                                    const variants *of, int side, rb_contact_state *tangent,
                                    double edges[2], rb_message *why)
{
    variants v = {.base = freely->model,
                  .bodies = of->bodies,
                  .own = of->own,
                  .at = of->at,
                  .step = of->step,
                  .scale = of->scale};
    rb_sensitivity_rate rate = {0};
    double by[2];
    rb_status status = variants_create(freely->model, input, of, 1, &v, why);

    if (status == RB_OK)
        status = rb_sensitivity_rate_alloc(freely->n, &rate);
    if (status == RB_OK)
        status = rates(&v, &rate, why);
    if (status == RB_OK)
        status = rb_contact_state_alloc(freely->n, tangent);
    if (status == RB_OK)
        status = rb_sensitivity_tangent(freely, &rate, side, tangent, why);
    if (status == RB_OK) {
        find_edges(differentiate_picked(&v, tangent), edges);
        motions_of(freely, freely->moves, &v, edges, by);
        tangent->xi += by[0] * freely->creepage[0] + by[1] * freely->creepage[1];
    }
    rb_sensitivity_rate_free(&rate);
    variants_free(&v);
    return status;
}

static rb_status set_free_creepage(const rb_sensitivity *s, const rb_sensitivity_input *input,
                                   const variants *v, int side, rb_rolling_solution *d,
                                   rb_message *why)
{
    rb_contact_state tangent = {0};
    double edges[2];
    /* Bodies without coupling roll freely at no creepage, unless the input makes them unlike. */
    int rests = s->model->rc->formulation == RB_STEADY &&
                !rb_contact_operator_response(s->model->problem.op).coupled;

    for (int k = 0; k < v->at.n && v->bodies; k++)
        rests &= !rb_contact_operator_response(v->model[k].problem.op).coupled &&
                 fabs(rb_rolling_derive(v->model[k].rc).dundurs) < 1e-12;
    d->free_creepage = rests ? 0.0 : NAN;
    if (!s->free_rolling || !input->vary)
        return RB_OK;
    const rb_status status =
        differentiate_free(s->free_rolling, input, v, side, &tangent, edges, why);
    /* between two zones its elements do not move as the others do */
    d->free_creepage = s->free_rolling->moves == s->moves ? tangent.xi : NAN;
    rb_contact_state_free(&tangent);
    return status;
}

/* What the motion of the elements changes, but for free rolling, which has its own.  edges: of
 * those that the elements follow. */
static void add_motions(const rb_sensitivity *s, const variants *v, const double edges[2],
                        rb_rolling_solution *d)
{
    const double free_creepage = d->free_creepage;
    double by[2];

    motions_of(s, s->moves, v, edges, by);
    for (int k = 0; k < 2; k++)
        if (by[k] != 0.0)
            blend(d, 1.0, &s->motion[k], by[k], NULL);
    d->free_creepage = free_creepage;
    if (s->moves == RB_SENSITIVITY_EDGES) { /* edges move as the elements there */
        const motion m = stretch_of(s->model);
        set_edges(s, by[1] + by[0] * (s->solution.contact_from - m.centre) / m.half,
                  by[1] + by[0] * (s->solution.contact_to - m.centre) / m.half, d);
    }
}

rb_status rb_sensitivity_differentiate(const rb_sensitivity *s, const rb_sensitivity_input *input,
                                       rb_sensitivity_derivative *d, rb_message *why)
{
    variants v = {.base = s->model, .results = 1};
    const int two = s->degenerate > 0 || (s->free_rolling && s->free_rolling->degenerate);

    memset(d, 0, sizeof *d);
    if (s->solution.n == 0)
        return rb_fail(why, RB_EINVAL, "derivatives: made without results");
    rb_status status = choose_places(s, input, &v, why);
    const int both = v.at.n == rb_sensitivity_middle.n;
    const int from = both ? 0 : v.at.place[1] > 0.0, to = both ? two : from;
    d->sides = two || !both ? 2 : 1;
    if (status == RB_OK)
        status = variants_create(s->model, input, NULL, 0, &v, why);
    if (status == RB_OK)
        status = rb_sensitivity_rate_alloc(s->n, &d->rate);
    if (status == RB_OK)
        status = rates(&v, &d->rate, why);
    for (int k = from; k <= to && status == RB_OK; k++) {
        const int side = k ? 1 : -1;
        d->has[k] = 1;
        status = differentiate_side(s, &v, side, &d->rate, &d->value[k], d->edges[k], why);
        if (status == RB_OK)
            status = set_free_creepage(s, input, &v, side, &d->value[k], why);
        if (status == RB_OK && s->moves != RB_SENSITIVITY_FIXED)
            add_motions(s, &v, d->edges[k], &d->value[k]);
        if (status == RB_OK)
            clean(s, input->scale, &d->value[k]);
    }
    if (status == RB_OK && both && d->sides == 2 && sides_agree(d)) {
        rb_rolling_solution_free(&d->value[1]);
        d->has[1] = 0;
        d->sides = 1;
    }
    variants_free(&v);
    return status;
}

/* The case itself, whatever the input. */
static rb_status same_case(void *context, double value, rb_rolling_case *rc, rb_message *why)
{
    const rb_sensitivity *s = context;

    (void)value;
    (void)why;
    *rc = *s->model->rc;
    return RB_OK;
}

rb_status rb_sensitivity_along(const rb_sensitivity *s, const rb_sensitivity_rate *rate,
                               rb_rolling_solution *d, rb_message *why)
{
    rb_sensitivity own = *s;
    const rb_sensitivity_input input = {.vary = same_case, .context = &own};
    variants v = {.base = s->model,
                  .results = 1,
                  .at = rb_sensitivity_middle,
                  .step = STEP_OF_BODIES,
                  .scale = 1.0};
    double edges[2];
    rb_status status = variants_create(s->model, &input, NULL, 0, &v, why);

    if (status == RB_OK)
        status = differentiate_side(s, &v, 1, rate, d, edges, why);
    if (status == RB_OK && s->moves != RB_SENSITIVITY_FIXED)
        add_motions(s, &v, edges, d);
    if (status == RB_OK)
        clean(s, 1.0, d);
    variants_free(&v);
    return status;
}

/* ---- Elements that move (D6) ------------------------------------------------------- */

/* Those that the program has placed: fitted to the edges of the only patch, or equal ones
 * of an automatic zone under a gap that is symmetric. */
static int motion_of(const rb_sensitivity *s)
{
    const rb_rolling_model *model = s->model;
    const rb_rolling_case *rc = model->rc;
    const int equal = rc->mesh == RB_MESH_UNIFORM || model->equal_instead;

    if (s->degenerate > 0 || s->solution.patches != 1 || s->solution.contact < 6 ||
        (equal && rc->zone > 0.0))
        return RB_SENSITIVITY_FIXED;
    return !equal                                      ? RB_SENSITIVITY_EDGES
           : rc->gap == RB_GAP_TABLE || rc->worn.n > 0 ? RB_SENSITIVITY_FIXED
                                                       : RB_SENSITIVITY_HERTZ;
}

/* Of the creepage of free rolling, by its own contact on these elements. */
static rb_status set_free_motion(rb_sensitivity *freely, int moves, rb_sensitivity_input *input,
                                 motion *m)
{
    rb_contact_state tangent[2] = {{0}, {0}};
    const variants v = {
        .at = rb_sensitivity_middle, .step = STEP_OF_BODIES * input->scale, .scale = input->scale};
    rb_message why;
    double edges[2][2];
    rb_status status = RB_OK;

    if (moves == RB_SENSITIVITY_EDGES)
        *m = stretch_of(freely->model);
    for (int k = 0; k < moves && status == RB_OK; k++) {
        m->kind = k ? SHIFT : STRETCH;
        status = differentiate_free(freely, input, &v, 1, &tangent[k], edges[k], &why);
        freely->creepage[k] = tangent[k].xi;
    }
    if (status == RB_OK && (moves != RB_SENSITIVITY_EDGES || set_gain(freely, edges[0], edges[1])))
        freely->moves = moves;
    rb_contact_state_free(&tangent[0]);
    rb_contact_state_free(&tangent[1]);
    return status;
}

rb_status rb_sensitivity_set_motion(rb_sensitivity *s)
{
    const int moves = motion_of(s);
    motion m = {STRETCH, 0.0, rb_rolling_derive(s->model->rc).half_width};
    double edges[2][2] = {{0.0}};
    rb_status status = RB_OK;

    if (moves == RB_SENSITIVITY_EDGES)
        m = stretch_of(s->model);
    rb_sensitivity_input input = {0.0, m.half, -INFINITY, INFINITY, NULL, &m};
    for (int k = 0; k < moves && status == RB_OK; k++) { /* as many motions */
        rb_sensitivity_derivative d;
        rb_message why;
        m.kind = k ? SHIFT : STRETCH;
        status = rb_sensitivity_differentiate(s, &input, &d, &why);
        if (status == RB_OK) {
            memcpy(edges[k], d.edges[0], sizeof edges[k]);
            s->motion[k] = d.value[0];
            memset(&d.value[0], 0, sizeof d.value[0]);
        }
        rb_sensitivity_derivative_free(&d);
    }
    if (status == RB_OK && s->free_rolling && !s->free_rolling->degenerate)
        status = set_free_motion(s->free_rolling, moves, &input, &m);
    if (status == RB_OK && (moves != RB_SENSITIVITY_EDGES || set_gain(s, edges[0], edges[1])))
        s->moves = moves;
    return status == RB_ENOMEM ? status : RB_OK;
}
