/* Derivatives of the results of a case with respect to one of its numbers (theory.md,
 * D4). At four (five at the end of a range) values of the number nearby the problem is
 * built anew on the same elements: its equations at the unknowns that are there give the
 * rates, and the results of the unknowns moved along the tangent their derivatives.
 * Elements that the program has placed move with the contact (D6): what that adds follows
 * from the derivatives with respect to two motions of the elements. */
#include "sensitivity/internal.h"

#include <cblas.h>
#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

/* Parts of the input's scale: where flexibilities change, which are known to fewer
 * digits, and where they do not. */
static const double STEP_OF_BODIES = 5e-4, STEP = 2e-5;

/* Flexibilities of wheels are known to fewer digits still: their step is longer, in such steps,
 * where steps even longer lead to no end of the input's range. */
static const double STEP_OF_WHEELS = 4.0, NEAR = 40.0;

/* The same, of a step along the tangent within which no other element comes first, and the
 * pressure beside an edge hardly changes. */
static const double STEP_OF_STATE = 5e-7;
/* A step, in such steps, that rounding leaves more digits; a deviation of its derivative that
 * the rounding of the short step explains. */
static const double LONGER_STEP = 40.0, SAME = 1e-7;

/* A change of a result over the input's scale that is none, as a part of its size. */
static const double ROUNDING = 1e-11;

/* Of 1 - found_e: edges that stand at midpoints move with them, whatever these do. */
static const double LEAST_DETERMINANT = 0.1;

/* Elements by which the edge found may miss the end of an aligned element. */
static const double LARGEST_MISS = 5e-3;

enum { PLACES = RB_SENSITIVITY_PLACES };

/* Of two values that share the largest one. */
static const double TIE = 1e-9;

static const rb_sensitivity_stencil nearest = {2, {-1, 1}, {-0.5, 0.5}},
                                    onwards = {3, {0, 1, 2}, {-1.5, 2.0, -0.5}};
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

/* ---- Variants ---------------------------------------------------------------------- */

typedef struct {
    const rb_rolling_model *base;
    int results; /* 0: rates alone */
    int bodies;  /* 1: they or the interlayer change with the input */
    int own;     /* 1: the bodies do; where they are compressed, each place has its own */
    rb_sensitivity_stencil at;
    int is_long; /* 1: the step is the longer one of wheels */
    double step, scale;
    rb_rolling_model model[PLACES];
    const rb_rolling_model *of[PLACES]; /* that each has borrowed from */
} variants;

static int has_wheels(const rb_rolling_model *model)
{
    return model->bodies.system_a || model->bodies.system_b;
}

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
    if (v->results && v->bodies && has_wheels(s->model) &&
        rb_sensitivity_stencil_of(input, NEAR * v->step) == &rb_sensitivity_middle) {
        v->step *= STEP_OF_WHEELS;
        v->is_long = 1;
    }
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

/* Elements move to shift + scale x. */
static void motion_by(const motion *m, double by, double *shift, double *scale)
{
    *shift = m->kind == SHIFT ? by : -by * m->centre / m->half;
    *scale = m->kind == SHIFT ? 1.0 : 1.0 + by / m->half;
}

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
            double shift, scale;
            motion_by(input->context, by, &shift, &scale);
            s = rb_rolling_variant_move(base, shift, scale, &v->model[k], why);
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
    const int trials = TRIALS + v->is_long;
    rb_status s = RB_INACCURATE;

    for (int k = 0; k < trials && s == RB_INACCURATE; k++) {
        if (k > 0) {
            variants_free(v);
            memset(v->model, 0, sizeof v->model);
            v->step *= v->is_long ? 1.0 / STEP_OF_WHEELS : 0.1;
            v->is_long = 0;
        }
        s = variants_at_places(base, input, others, freely, v, why);
    }
    return s;
}

/* D2: how the equations change while the unknowns stay.  A law asks for the size of slips, and
 * within the step small ones change their sign: the law is differentiated where they stay, and by
 * them as in J. */
static rb_status rates(const rb_sensitivity *s, variants *v, rb_sensitivity_rate *rate,
                       rb_message *why)
{
    const rb_contact_state *state = &s->model->state;
    const size_t n = (size_t)s->n;
    rb_sensitivity_rate left;
    rb_status status = rb_sensitivity_rate_alloc(s->n, &left);

    for (int k = 0; k < v->at.n && status == RB_OK; k++) {
        rb_rolling_model *at = &v->model[k];
        status = rb_sensitivity_residual(v->base, at, &left, why);
        if (status == RB_OK && s->law_slip) {
            memcpy(at->state.lambda, state->lambda, n * sizeof *state->lambda);
            status = rb_rolling_model_friction(at, why);
            memcpy(left.bound, at->problem.bound, n * sizeof *left.bound);
        }
        rb_sensitivity_rate_add(&left, v->at.weight[k] / v->step, rate);
    }
    for (size_t j = 0; j < n && status == RB_OK && s->law_slip; j++)
        if (state->zone[j] != RB_ZONE_STICK)
            cblas_daxpy(s->n, rate->slip[j], s->law_slip + j * n, 1, rate->bound, 1);
    rb_sensitivity_rate_free(&left);
    return status;
}

/* Tables of gap and friction over x have kinks, which the step of a flexibility would span: of
 * elements that move, what these tables add is that of a short step. */
static rb_status rates_of_tables(const variants *v, const motion *m, rb_sensitivity_rate *rate,
                                 rb_message *why)
{
    const int n = v->base->mesh.n, law = rb_rolling_law_depends_on_state(v->base->rc);
    const double step = STEP * m->half;
    double *gap = rb_alloc((size_t)n, 2), *bound = gap + n;
    rb_status s = gap ? RB_OK : RB_ENOMEM;

    for (int k = 0; k < v->at.n && s == RB_OK; k++) {
        const double of_short = v->at.weight[k] / step, of_long = v->at.weight[k] / v->step;
        double shift, scale;
        motion_by(m, v->at.place[k] * step, &shift, &scale);
        s = rb_rolling_variant_data(v->base, shift, scale, gap, bound, why);
        for (int i = 0; i < n && s == RB_OK; i++) {
            rate->gap[i] += of_short * gap[i] - of_long * v->model[k].mesh.gap[i];
            if (!law)
                rate->bound[i] += of_short * bound[i] - of_long * v->model[k].problem.bound[i];
        }
    }
    free(gap);
    return s;
}

/* By what the varied case gives, where it differs in nothing else.  0: it does. */
static int rates_of_given(const rb_sensitivity *s, const rb_sensitivity_input *input,
                          const variants *v, rb_sensitivity_rate *rate, double *mu,
                          rb_status *status, rb_message *why)
{
    rb_sensitivity_rate left = {0};
    int is_given = !v->own;

    *status = rb_sensitivity_rate_alloc(s->n, &left);
    /* the last place tells: the first one may be the value itself, where nothing differs */
    for (int k = v->at.n - 1; k >= 0 && is_given && *status == RB_OK; k--) {
        const double weight = v->at.weight[k] / v->step;
        rb_rolling_case rc;
        rb_contact_problem given;
        *status = input->vary(input->context, input->value + v->at.place[k] * v->step, &rc, why);
        if (*status != RB_OK)
            break;
        rc = on_the_same_elements(&rc, s->model->rc, s->n);
        is_given = rb_rolling_variant_given(s->model, &rc, left.bound, &given, status, why);
        if (!is_given)
            break;
        rb_sensitivity_given(s->model, &given, &s->model->state, &left);
        rb_sensitivity_rate_add(&left, weight, rate);
        *mu += weight * given.mu;
    }
    rb_sensitivity_rate_free(&left);
    return is_given;
}

rb_status rb_sensitivity_rates(const rb_sensitivity *s, const rb_sensitivity_input *input,
                               rb_sensitivity_rate *rate, double *mu, rb_message *why)
{
    variants v = {.base = s->model};
    rb_status status = choose_places(s, input, &v, why);

    memset(rate, 0, sizeof *rate);
    *mu = 0.0;
    if (v.at.n == rb_sensitivity_middle.n)
        v.at = nearest;
    if (status == RB_OK)
        status = rb_sensitivity_rate_alloc(s->n, rate);
    if (status != RB_OK || rates_of_given(s, input, &v, rate, mu, &status, why))
        return status;
    if (status == RB_OK)
        status = variants_create(s->model, input, NULL, 0, &v, why);
    if (status == RB_OK)
        status = rates(s, &v, rate, why);
    for (int k = 0; k < v.at.n && status == RB_OK; k++)
        *mu += v.at.weight[k] / v.step * v.model[k].problem.mu;
    variants_free(&v);
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

void rb_sensitivity_scale(rb_rolling_solution *s, double factor)
{
    blend(s, factor, NULL, 0.0, NULL);
}

/* 1: the largest strain is that of no layer, a/(2R). */
static int follows_half_width(const rb_sensitivity *s)
{
    const rb_rolling_solution *at = &s->solution;

    return at->max_strain == 0.5 * at->half_width / rb_rolling_derive(s->model->rc).radius;
}

/* In the place of the second one the derivative: weights times what each has more than
 * the first one, so that what does not change has a derivative of exactly 0. */
static void combine(const rb_sensitivity *s, const rb_sensitivity_stencil *at, double step,
                    rb_rolling_solution *moved)
{
    const double half = s->solution.half_width;

    /* An edge that is found may jump between the places; what is proportional to the half-width
     * has the same factor beside it. */
    for (int j = 0; j < at->n; j++) {
        moved[j].peclet *= half / moved[j].half_width;
        if (follows_half_width(s))
            moved[j].max_strain *= half / moved[j].half_width;
        moved[j].half_width = half;
    }
    for (int j = 1; j < at->n; j++)
        blend(&moved[1], j > 1, &moved[j], at->weight[j] / step, &moved[0]);
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        if (r->kind != RB_RESULT_WHOLE && !rb_sensitivity_has(r))
            *number_of(r, &moved[1]) = NAN;
    }
}

/* What place k of the stencil adds to the derivatives of both temperatures.  Only powers > 0 heat,
 * and small ones change their sign within the step: the case varies where the solution stays, and
 * the solution goes a small part of its way. */
static rb_status add_heat(const rb_sensitivity *s, const variants *v, int k,
                          const rb_rolling_solution *moved, double *warmer, rb_message *why)
{
    const rb_rolling_solution *at = &s->solution;
    const size_t n = (size_t)s->n;
    const double part = STEP_OF_STATE * v->scale / v->step, weight = v->at.weight[k] / v->step;
    const double *from[] = {at->x, at->h, at->q, at->slip, at->shift},
                 *to[] = {moved->x, moved->h, moved->q, moved->slip, moved->shift};
    double *near = rb_alloc(n, 7), *t = near + 5 * n;
    rb_rolling_solution small = *at;

    if (!near)
        return RB_ENOMEM;
    for (size_t i = 0; i < 5 * n; i++)
        near[i] = from[i / n][i % n] + part * (to[i / n][i % n] - from[i / n][i % n]);
    small.x = near;
    small.h = near + n;
    small.q = near + 2 * n;
    small.slip = near + 3 * n;
    small.shift = near + 4 * n;
    rb_status status = rb_rolling_solution_heat(v->model[k].rc, at, t, t + n, why);
    cblas_daxpy(2 * s->n, weight, t, 1, warmer, 1);
    if (status == RB_OK)
        status = rb_rolling_solution_heat(s->model->rc, &small, t, t + n, why);
    cblas_daxpy(2 * s->n, weight / part, t, 1, warmer, 1);
    free(near);
    return status;
}

/* (D4) the results at the places of the stencil, moved along the tangent. */
static rb_status differentiate_results(const rb_sensitivity *s, variants *v,
                                       const rb_contact_state *tangent, rb_rolling_solution *d,
                                       rb_message *why)
{
    rb_rolling_solution moved[PLACES] = {{0}};
    double *warmer = s->solution.temperature ? rb_alloc((size_t)s->n, 2) : NULL;
    rb_status status = warmer || !s->solution.temperature ? RB_OK : RB_ENOMEM;

    for (int k = 0; k < v->at.n && status == RB_OK; k++) {
        rb_rolling_variant_set(&v->base->state, tangent, v->at.place[k] * v->step,
                               &v->model[k].state);
        status = rb_rolling_variant_complete(&v->model[k], NULL, NULL, why);
        if (status == RB_OK)
            status = rb_rolling_variant_solution(&v->model[k], &moved[k], why);
        if (status == RB_OK && warmer)
            status = add_heat(s, v, k, &moved[k], warmer, why);
    }
    if (status == RB_OK)
        combine(s, &v->at, v->step, moved);
    if (status == RB_OK && warmer) {
        memcpy(moved[1].temperature, warmer, (size_t)s->n * sizeof *warmer);
        memcpy(moved[1].temperature_b, warmer + s->n, (size_t)s->n * sizeof *warmer);
    }
    *d = moved[1];
    for (int k = 0; k < v->at.n; k++)
        if (k != 1)
            rb_rolling_solution_free(&moved[k]);
    free(warmer);
    return status;
}

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

/* Results that are found at elements which a change may exchange for others: the edges of
 * the contact, those that elements follow (D6), and the largest pressure. */
enum { FROM, TO, FOLLOWED_FROM, FOLLOWED_TO, PEAK, PICKED };
typedef struct {
    double of[PICKED];
} picked;

/* Elements follow the edges that they were aligned with; otherwise, as those that a mesh is
 * fitted to jump with its elements, the zeros of p^2. */
static picked pick(const rb_rolling_model *of, const rb_contact_state *state, int aligned)
{
    rb_rolling_model model = *of; /* borrows */
    picked x;
    double *d = x.of;

    model.state = *state;
    rb_rolling_contact_edges(model.rc, &model.mesh, state, &d[FROM], &d[TO]);
    d[FOLLOWED_FROM] = aligned ? d[FROM] : zero_of(&model.mesh, state, -1);
    d[FOLLOWED_TO] = aligned ? d[TO] : zero_of(&model.mesh, state, 1);
    d[PEAK] = rb_rolling_peak_pressure(&model);
    return x;
}

/* Weights times what each has more than `at`, as in combine. */
static void add_picked(double weight, picked x, picked at, picked *sum)
{
    for (int k = 0; k < PICKED; k++)
        sum->of[k] += weight * (x.of[k] - at.of[k]);
}

/* With these steps along the tangent. at: before them; state: of the model, overwritten. */
static picked pick_with_steps(const rb_rolling_model *model, const rb_contact_state *tangent,
                              const rb_sensitivity_stencil *steps, double step, picked at,
                              rb_contact_state *state)
{
    const int aligned = are_aligned(model);
    picked d = {{0.0}};

    for (int k = 0; k < steps->n; k++) {
        rb_rolling_variant_set(&model->state, tangent, steps->place[k] * step, state);
        add_picked(steps->weight[k] / step, pick(model, state, aligned), at, &d);
    }
    return d;
}

/* Adds their derivatives along the tangent: to ten digits, unless another element comes first
 * within these steps. */
static void pick_along(const rb_rolling_model *model, const rb_contact_state *tangent, double scale,
                       rb_contact_state *state, picked *d)
{
    const picked at = pick(model, &model->state, are_aligned(model)),
                 near = pick_with_steps(model, tangent, &nearest, STEP_OF_STATE * scale, at, state),
                 far = pick_with_steps(model, tangent, &rb_sensitivity_middle,
                                       LONGER_STEP * STEP_OF_STATE * scale, at, state);

    for (int k = 0; k < PICKED; k++) {
        const double off = fabs(far.of[k] - near.of[k]);
        d->of[k] +=
            off <= SAME * fmax(fabs(near.of[k]), fabs(at.of[k]) / scale) ? far.of[k] : near.of[k];
    }
}

/* Half-width and centre between the edges that elements follow. */
static void find_edges(picked x, double edges[2])
{
    edges[0] = 0.5 * (x.of[FOLLOWED_TO] - x.of[FOLLOWED_FROM]);
    edges[1] = 0.5 * (x.of[FOLLOWED_TO] + x.of[FOLLOWED_FROM]);
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
    if (follows_half_width(s))
        d->max_strain += 0.5 * (d->half_width - before) / radius;
}

/* The warmest element is that of the solution, though another one may be warmer at the
 * places of the stencil. */
static rb_status set_peak_temperature(const rb_sensitivity *s, double step, rb_rolling_solution *d)
{
    const rb_rolling_solution *at = &s->solution;
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

/* Of what compresses the layers, which is linear in approach and pressure. v: NULL: no input
 * changes the layers. */
static void set_strains(const rb_sensitivity *s, const variants *v, double approach,
                        double pressure, double strain[4])
{
    const rb_rolling_solution *at = &s->solution;
    double x[4];

    rb_rolling_strains(s->model->rc, approach, pressure, strain);
    for (int k = 0; v && k < v->at.n; k++) {
        rb_rolling_strains(v->model[k].rc, at->approach, at->max_pressure, x);
        for (int j = 0; j < 4; j++)
            strain[j] += v->at.weight[k] / v->step * x[j];
    }
}

static rb_status set_picked(const rb_sensitivity *s, picked x, double scale, rb_rolling_solution *d)
{
    d->max_pressure = x.of[PEAK];
    set_edges(s, x.of[FROM], x.of[TO], d);
    return set_peak_temperature(s, STEP_OF_STATE * scale, d);
}

/* 1: but for rounding, or none is there. */
static int are_equal(double x, double y)
{
    return !(fabs(x - y) > TIE * fmax(fabs(x), fabs(y)));
}

/* The derivative of the largest strain: that of the body that is compressed most, by the lesser
 * of two amounts. Where two are equal, the side decides. */
static double strain_of(const rb_sensitivity *s, int side, const double strain[4])
{
    double at[4], most = NAN, of_most = NAN;

    rb_rolling_strains(s->model->rc, s->solution.approach, s->solution.max_pressure, at);
    for (int b = 0; b < 4; b += 2) {
        const double *x = at + b, *by = strain + b;
        const int second = are_equal(x[0], x[1]) ? side * by[1] < side * by[0] : x[1] < x[0];
        if (isnan(x[second]) ||
            (!isnan(most) &&
             (are_equal(most, x[second]) ? side * by[second] <= side * of_most : x[second] < most)))
            continue;
        most = x[second];
        of_most = by[second];
    }
    return of_most;
}

static void set_strain(const rb_sensitivity *s, int k, rb_sensitivity_derivative *d)
{
    const double strain = strain_of(s, k ? 1 : -1, d->strain[k]);

    if (!isnan(strain)) /* otherwise it is that of the contact */
        d->value[k].max_strain = strain;
}

/* Where both sides of a result are the same but for rounding, they are equal.  1: of all. */
static int unite_sides(rb_sensitivity_derivative *d)
{
    int all = 1;

    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        const double x = rb_rolling_number(r, &d->value[0]), y = rb_rolling_number(r, &d->value[1]);
        if (!rb_sensitivity_has(r) || (isnan(x) && isnan(y)))
            continue;
        if (fabs(x - y) <= 1e-8 * fmax(fabs(x), fabs(y)))
            *number_of(r, &d->value[1]) = x;
        else
            all = 0;
    }
    return all;
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

void rb_sensitivity_clean(const rb_sensitivity *s, double scale, rb_rolling_solution *d)
{
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        if (rb_sensitivity_has(r) &&
            fabs(*number_of(r, d)) * scale <
                rb_sensitivity_rounding(s->model->rc, r, rb_rolling_number(r, &s->solution)))
            *number_of(r, d) = 0.0;
    }
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
static motion stretch_of(const rb_rolling_model *model)
{
    double edges[2];

    find_edges(pick(model, &model->state, are_aligned(model)), edges);
    return (motion){STRETCH, edges[1], edges[0]};
}

/* How much the elements are stretched and shifted: as Hertz's half-width grows, or as the
 * contact that is found on them grows and shifts, e' = found' + found_e e'.  v: NULL: no
 * input, which leaves Hertz's half-width as it is. */
static void set_motions(const rb_sensitivity *s, const variants *v, const double edges[2],
                        double by[2])
{
    by[0] = by[1] = 0.0;
    for (int k = 0; s->moves == RB_SENSITIVITY_HERTZ && v && k < v->at.n; k++)
        by[0] += v->at.weight[k] / v->step * rb_rolling_derive(v->model[k].rc).half_width;
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
        blend(d, 1.0, &s->motion[k].value[0], by[k], NULL);
        for (int j = 0; j < 4; j++)
            strain[j] += by[k] * s->motion[k].strain[0][j];
    }
    if (s->moves == RB_SENSITIVITY_EDGES) { /* edges move as the elements there */
        const motion m = stretch_of(s->model);
        set_edges(s, by[1] + by[0] * (s->solution.contact_from - m.centre) / m.half,
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
static rb_status differentiate_side(const rb_sensitivity *s, variants *v, int k,
                                    rb_sensitivity_derivative *d, rb_message *why)
{
    const int aligned = are_aligned(s->model);
    const picked at = pick(s->model, &s->model->state, aligned);
    rb_contact_state state = v->model[0].state; /* its arrays serve all */
    picked x = {{0.0}};
    rb_status status = rb_contact_state_alloc(s->n, &d->state[k]);

    if (status == RB_OK)
        status = rb_sensitivity_tangent(s, &d->rate, k ? 1 : -1, &d->state[k], why);
    if (status == RB_OK)
        status = set_slip(s, &d->rate, -1, &d->state[k]);
    if (status != RB_OK)
        return status;
    /* by the input where the state stays, and along the tangent */
    rb_rolling_variant_set(&s->model->state, NULL, 0.0, &state);
    for (int j = 0; j < v->at.n; j++)
        add_picked(v->at.weight[j] / v->step, pick(&v->model[j], &state, aligned), at, &x);
    pick_along(s->model, &d->state[k], v->scale, &state, &x);
    find_edges(x, d->edges[k]);
    set_motions(s, v, d->edges[k], d->by[k]);
    if (!v->results)
        return RB_OK;
    status = differentiate_results(s, v, &d->state[k], &d->value[k], why);
    if (status == RB_OK)
        status = set_picked(s, x, v->scale, &d->value[k]);
    if (status == RB_OK) {
        set_strains(s, v, d->state[k].delta, x.of[PEAK], d->strain[k]);
        add_motions(s, d->by[k], d->strain[k], &d->value[k]);
        set_strain(s, k, d);
    }
    return status;
}

/* On the sides that d has.  others: variants for the same input, of the model to which this is
 * free rolling; NULL: it is not. */
static rb_status differentiate(const rb_sensitivity *s, const rb_sensitivity_input *input,
                               const variants *others, variants *v, rb_sensitivity_derivative *d,
                               rb_message *why)
{
    rb_status status = variants_create(s->model, input, others, others != NULL, v, why);

    if (status == RB_OK)
        status = rb_sensitivity_rate_alloc(s->n, &d->rate);
    if (status == RB_OK)
        status = rates(s, v, &d->rate, why);
    if (status == RB_OK && !input->vary)
        status = rates_of_tables(v, input->context, &d->rate, why);
    for (int k = 0; k < 2 && status == RB_OK; k++)
        if (d->has[k])
            status = differentiate_side(s, v, k, d, why);
    return status;
}

/* Free rolling has its own equations. */
static rb_status differentiate_free(const rb_sensitivity *s, const rb_sensitivity_input *input,
                                    const variants *of, rb_sensitivity_derivative *d,
                                    rb_message *why)
{
    const rb_sensitivity *freely = s->free_rolling;
    /* Bodies without coupling roll freely at no creepage, unless the input makes them unlike. */
    int rests = s->model->rc->formulation == RB_STEADY &&
                !rb_contact_operator_response(s->model->problem.op).coupled;
    rb_status status = RB_OK;

    for (int k = 0; k < of->at.n && of->bodies; k++)
        rests &= !rb_contact_operator_response(of->model[k].problem.op).coupled &&
                 fabs(rb_rolling_derive(of->model[k].rc).dundurs) < 1e-12;
    if (freely && input->vary) {
        rb_sensitivity_derivative *f = d->free_rolling = calloc(1, sizeof *f);
        variants v = *of;
        v.base = freely->model;
        v.results = 0;
        memset(v.model, 0, sizeof v.model);
        memset(v.of, 0, sizeof v.of);
        if (!f)
            return RB_ENOMEM;
        memcpy(f->has, d->has, sizeof f->has);
        status = differentiate(freely, input, of, &v, f, why);
        variants_free(&v);
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
    variants v = {.base = s->model, .results = 1};

    memset(d, 0, sizeof *d);
    if (s->solution.n == 0)
        return rb_fail(why, RB_EINVAL, "derivatives: made without results");
    rb_status status = choose_places(s, input, &v, why);
    const int both = v.at.n == rb_sensitivity_middle.n,
              two = s->degenerate > 0 || (s->free_rolling && s->free_rolling->degenerate);
    d->has[0] = both || v.at.place[1] < 0.0;
    d->has[1] = both ? two : !d->has[0];
    if (status == RB_OK)
        status = differentiate(s, input, NULL, &v, d, why);
    if (status == RB_OK && both && !d->has[1] &&
        !are_equal(strain_of(s, -1, d->strain[0]), strain_of(s, 1, d->strain[0]))) {
        d->has[1] = 1;
        status = differentiate_side(s, &v, 1, d, why);
    }
    if (status == RB_OK)
        status = differentiate_free(s, input, &v, d, why);
    variants_free(&v);
    if (status != RB_OK)
        return status;
    for (int k = 0; k < 2; k++)
        if (d->has[k])
            rb_sensitivity_clean(s, input->scale, &d->value[k]);
    if (both && d->has[1] && unite_sides(d)) {
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
    picked x = {{0.0}};

    memset(d, 0, sizeof *d);
    rb_status status = rb_contact_state_alloc(s->n, &d->state[0]);
    if (status == RB_OK)
        status = rb_contact_state_alloc(s->n, &scratch);
    if (status == RB_OK)
        status = rb_sensitivity_tangent(s, rate, 1, &d->state[0], why);
    if (status == RB_OK)
        status = set_slip(s, NULL, released, &d->state[0]);
    if (status == RB_OK) {
        pick_along(s->model, &d->state[0], 1.0, &scratch, &x);
        find_edges(x, d->edges[0]);
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
    const rb_status status = rb_rolling_variant_complete(v, NULL, NULL, why);

    memcpy(v->state.lambda, y->lambda, (size_t)y->n * sizeof *y->lambda);
    return status == RB_OK ? rb_rolling_variant_solution(v, results, why) : status;
}

rb_status rb_sensitivity_add_jump(const rb_sensitivity *s, const rb_sensitivity_derivative *line,
                                  int element, double factor, double ahead, int k,
                                  rb_sensitivity_derivative *d, rb_message *why)
{
    /* to the side on which friction heats, as it does on one side of the change */
    const double way = line->state[0].lambda[element] * s->model->state.q[element] > 0.0 ? -1 : 1,
                 step = way * STEP_OF_BODIES;
    rb_rolling_model v = {.mesh = {.n = 0}};
    rb_rolling_solution moved[3] = {{0}};
    rb_contact_state y = {0};
    picked x = {{0.0}};
    double strain[4];
    rb_status status = rb_contact_state_alloc(s->n, &y);

    if (status == RB_OK)
        status = rb_rolling_variant_create(s->model, s->model->rc, 1, 0, &v, why);
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
        combine(s, &onwards, step, moved);
        pick_along(s->model, &line->state[0], 1.0, &y, &x);
        status = set_picked(s, x, 1.0, &moved[1]);
    }
    if (status == RB_OK) {
        set_strains(s, NULL, line->state[0].delta, x.of[PEAK], strain);
        add_motions(s, line->by[0], strain, &moved[1]);
        blend(&d->value[k], 1.0, &moved[1], factor, NULL);
        for (int j = 0; j < 4; j++)
            d->strain[k][j] += factor * strain[j];
        set_strain(s, k, d);
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
        (equal && rc->zone > 0.0))
        return RB_SENSITIVITY_FIXED;
    return !equal                                      ? RB_SENSITIVITY_EDGES
           : rc->gap == RB_GAP_TABLE || rc->worn.n > 0 ? RB_SENSITIVITY_FIXED
                                                       : RB_SENSITIVITY_HERTZ;
}

static rb_status differentiate_motions(rb_sensitivity *s, int moves)
{
    motion m = moves == RB_SENSITIVITY_EDGES
                   ? stretch_of(s->model)
                   : (motion){STRETCH, 0.0, rb_rolling_derive(s->model->rc).half_width};
    const rb_sensitivity_input input = {0.0, m.half, -INFINITY, INFINITY, NULL, &m};
    rb_status status = RB_OK;

    for (int k = 0; k < moves && status == RB_OK; k++) { /* as many motions */
        variants v = {.base = s->model,
                      .results = s->solution.n > 0,
                      .at = rb_sensitivity_middle,
                      .is_long = has_wheels(s->model),
                      .step =
                          (has_wheels(s->model) ? STEP_OF_WHEELS : 1.0) * STEP_OF_BODIES * m.half,
                      .scale = m.half};
        rb_message why;
        m.kind = k ? SHIFT : STRETCH;
        s->motion[k].has[0] = 1;
        status = differentiate(s, &input, NULL, &v, &s->motion[k], &why);
        variants_free(&v);
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
