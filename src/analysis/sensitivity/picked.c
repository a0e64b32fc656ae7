/* Results that are found at single elements: the edges of the contact, the largest pressure,
 * temperature and strain.  A step of the input may exchange these elements for others; the
 * derivative is that of the element of the solution. */
#include "analysis/sensitivity/internal.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>

/* A step, in those of the state, that rounding leaves more digits; a deviation of its derivative
 * that the rounding of the short step explains. */
static const double LONGER_STEP = 40.0, SAME = 1e-7;

/* Elements by which the edge found may miss the end of an aligned element. */
static const double LARGEST_MISS = 5e-3;

/* Of two values that share the largest one. */
static const double TIE = 1e-9;

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
static rb_sensitivity_picked pick(const rb_rolling_model *of, const rb_contact_state *state,
                                  int aligned)
{
    rb_rolling_model model = *of; /* borrows */
    rb_sensitivity_picked x;
    double *d = x.of;

    model.state = *state;
    rb_rolling_contact_edges(model.rc, &model.mesh, state, &d[FROM], &d[TO]);
    d[FOLLOWED_FROM] = aligned ? d[FROM] : zero_of(&model.mesh, state, -1);
    d[FOLLOWED_TO] = aligned ? d[TO] : zero_of(&model.mesh, state, 1);
    d[PEAK] = rb_rolling_peak_pressure(&model);
    return x;
}

/* Weights times what each has more than `at`, as in combine. */
static void add_picked(double weight, rb_sensitivity_picked x, rb_sensitivity_picked at,
                       rb_sensitivity_picked *sum)
{
    for (int k = 0; k < PICKED; k++)
        sum->of[k] += weight * (x.of[k] - at.of[k]);
}

/* With these steps along the tangent. at: before them; state: of the model, overwritten. */
static rb_sensitivity_picked pick_with_steps(const rb_rolling_model *model,
                                             const rb_contact_state *tangent,
                                             const rb_sensitivity_stencil *steps, double step,
                                             rb_sensitivity_picked at, int aligned,
                                             rb_contact_state *state)
{
    rb_sensitivity_picked d = {{0.0}};

    for (int k = 0; k < steps->n; k++) {
        rb_rolling_variant_set(&model->state, tangent, steps->place[k] * step, state);
        add_picked(steps->weight[k] / step, pick(model, state, aligned), at, &d);
    }
    return d;
}

/* By the input where the state stays, and along the tangent: to ten digits, unless another element
 * comes first within these steps. */
rb_sensitivity_picked rb_sensitivity_differentiate_picked(const rb_sensitivity *s,
                                                          const rb_sensitivity_variants *v,
                                                          const rb_contact_state *tangent,
                                                          rb_contact_state *state)
{
    const rb_rolling_model *model = s->model;
    const int aligned = are_aligned(model);
    const double scale = v ? v->scale : 1.0;
    const rb_sensitivity_picked at = pick(model, &model->state, aligned);
    rb_sensitivity_picked d = {{0.0}};

    rb_rolling_variant_set(&model->state, NULL, 0.0, state);
    for (int k = 0; v && k < v->at.n; k++)
        add_picked(v->at.weight[k] / v->step, pick(&v->model[k], state, aligned), at, &d);
    const rb_sensitivity_picked near =
                                    pick_with_steps(model, tangent, &rb_sensitivity_nearest,
                                                    RB_STEP_OF_STATE * scale, at, aligned, state),
                                far = pick_with_steps(model, tangent, &rb_sensitivity_middle,
                                                      LONGER_STEP * RB_STEP_OF_STATE * scale, at,
                                                      aligned, state);
    for (int k = 0; k < PICKED; k++) {
        const double off = fabs(far.of[k] - near.of[k]);
        d.of[k] +=
            off <= SAME * fmax(fabs(near.of[k]), fabs(at.of[k]) / scale) ? far.of[k] : near.of[k];
    }
    return d;
}

void rb_sensitivity_find_edges(rb_sensitivity_picked x, double edges[2])
{
    edges[0] = 0.5 * (x.of[FOLLOWED_TO] - x.of[FOLLOWED_FROM]);
    edges[1] = 0.5 * (x.of[FOLLOWED_TO] + x.of[FOLLOWED_FROM]);
}

void rb_sensitivity_edges_of(const rb_rolling_model *model, double edges[2])
{
    rb_sensitivity_find_edges(pick(model, &model->state, are_aligned(model)), edges);
}

void rb_sensitivity_set_edges(const rb_sensitivity *s, double from, double to,
                              rb_rolling_solution *d)
{
    const rb_rolling_solution *at = &s->solution;
    const double radius = rb_rolling_derive(s->model->rc).radius, before = d->half_width;

    d->contact_from = from;
    d->contact_to = to;
    d->nip_width = to - from;
    d->half_width = 0.5 * d->nip_width;
    d->peclet += at->peclet / at->half_width * (d->half_width - before);
    if (rb_sensitivity_follows_half_width(s))
        d->max_strain += 0.5 * (d->half_width - before) / radius;
}

/* The warmest element is that of the solution, though another one may be warmer at the
 * places of the stencil.  The largest value of the parabola through it and its neighbours changes
 * as the parabola does where it lies, and with the places of the elements.  t: temperatures, by:
 * their derivatives; v: NULL: no input moves the elements. */
static double differentiate_peak_temperature(const rb_sensitivity *s,
                                             const rb_sensitivity_variants *v, const double *t,
                                             const double *by)
{
    const double *x = s->model->bodies.f.x;
    const int *zone = s->model->state.zone;
    double most, at, sum = 0.0;
    int k = -1;

    for (int i = 0; v && i < v->at.n; i++) {
        rb_rolling_peak_temperature(s->n, v->model[i].bodies.f.x, zone, t, &most, &at);
        sum += v->at.weight[i] / v->step * most;
    }
    rb_rolling_peak_temperature(s->n, x, zone, t, &most, &at);
    for (int i = 0; i < s->n; i++)
        if (zone[i] != RB_ZONE_SEPARATED && (k < 0 || t[i] > t[k]))
            k = i;
    if (k < 0 || at == x[k])
        return k < 0 ? NAN : sum + by[k];
    for (int i = k - 1; i <= k + 1; i++) {
        double share = 1.0;
        for (int j = k - 1; j <= k + 1; j++)
            share *= j == i ? 1.0 : (at - x[j]) / (x[i] - x[j]);
        sum += share * by[i];
    }
    return sum;
}

rb_status rb_sensitivity_differentiate_at_elements(const rb_sensitivity *s,
                                                   const rb_sensitivity_input *input,
                                                   const rb_sensitivity_stencil *at, double step,
                                                   rb_rolling_model *const variant[],
                                                   const rb_contact_state *tangent,
                                                   rb_sensitivity_at_elements *d)
{
    const size_t n = (size_t)s->n;
    rb_sensitivity_variants v = {.base = s->model, .at = *at, .step = step, .scale = input->scale};
    rb_contact_state state;
    double *t = rb_alloc(n, 1);
    rb_status status = rb_contact_state_alloc(s->n, &state);

    for (int k = 0; k < at->n; k++) {
        v.model[k] = *variant[k]; /* borrows */
        for (size_t i = 0; i < n && t && variant[k]->carried.temperature; i++)
            t[i] += at->weight[k] / step * variant[k]->carried.temperature[i];
    }
    if (status == RB_OK && !t)
        status = RB_ENOMEM;
    if (status == RB_OK) {
        const rb_sensitivity_picked x = rb_sensitivity_differentiate_picked(s, &v, tangent, &state);
        *d = (rb_sensitivity_at_elements){x.of[FROM], x.of[TO], x.of[PEAK], 0.0};
    }
    if (status == RB_OK && s->model->carried.temperature)
        d->max_temperature =
            differentiate_peak_temperature(s, &v, s->model->carried.temperature, t);
    rb_contact_state_free(&state);
    free(t);
    return status;
}

void rb_sensitivity_set_picked(const rb_sensitivity *s, const rb_sensitivity_variants *v,
                               rb_sensitivity_picked x, double approach, double strain[4],
                               rb_rolling_solution *d)
{
    const rb_rolling_solution *at = &s->solution;
    double by[4];

    d->max_pressure = x.of[PEAK];
    rb_sensitivity_set_edges(s, x.of[FROM], x.of[TO], d);
    /* what compresses the layers is linear in approach and pressure */
    rb_rolling_strains(s->model->rc, approach, x.of[PEAK], strain);
    for (int k = 0; v && k < v->at.n; k++) {
        rb_rolling_strains(v->model[k].rc, at->approach, at->max_pressure, by);
        for (int j = 0; j < 4; j++)
            strain[j] += v->at.weight[k] / v->step * by[j];
    }
    if (at->temperature)
        d->max_temperature = differentiate_peak_temperature(s, v, at->temperature, d->temperature);
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

void rb_sensitivity_set_strain(const rb_sensitivity *s, int k, rb_sensitivity_derivative *d)
{
    const double strain = strain_of(s, k ? 1 : -1, d->strain[k]);

    if (!isnan(strain)) /* otherwise it is that of the contact */
        d->value[k].max_strain = strain;
}

int rb_sensitivity_strain_has_sides(const rb_sensitivity *s, const double strain[4])
{
    return !are_equal(strain_of(s, -1, strain), strain_of(s, 1, strain));
}
