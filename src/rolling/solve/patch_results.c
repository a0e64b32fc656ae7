/* What a solution says of its patches: forces, edges, and the largest pressure. */
#include "base/units.h"
#include "rolling/body/mesh.h"
#include "rolling/case/derived.h"
#include "rolling/solve/model.h"
#include "rolling/solve/patches.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>

/* Whether an element is one of the last two that stick, or of the first that slip, at a limit of
 * stick.  Their pressures are disturbed, because the kink at the limit lies inside an element; that
 * of the limit itself is known by (E4). */
static int is_beside_limit(const rb_rolling_case *rc, const rb_rolling_tractions *of, int i)
{
    rb_rolling_stick_limit limit;

    for (int side = -1; side <= 1; side += 2)
        for (int last = i - RB_ROLLING_DISTURBED + 1; last < i + RB_ROLLING_DISTURBED; last++)
            if (last >= 0 && last < of->n && rb_rolling_stick_limit_of(rc, of, last, side, &limit))
                return 1;
    return 0;
}

/* Vertex of the parabola of p^2 through the largest element and its neighbours: exact for
 * Hertz's ellipse.  Or the pressure at a limit of stick. */
static void set_peak(const rb_rolling_model *model, const rb_rolling_run *run,
                     rb_rolling_patch *patch)
{
    const rb_contact_state *state = &model->state;
    const double *x = model->bodies.f.x, *p = state->p;
    const rb_rolling_tractions of = {.n = state->n,
                                     .has_history = model->rc->formulation != RB_STEADY,
                                     .zone = state->zone,
                                     .x = x,
                                     .p = p,
                                     .q = state->q};
    int k = -1;

    for (int i = run->first; i <= run->last; i++)
        if ((k < 0 || p[i] > p[k]) && !is_beside_limit(model->rc, &of, i))
            k = i;
    patch->max_pressure = p[k];
    patch->peak = x[k];
    if (k > 0 && k < of.n - 1 && !is_beside_limit(model->rc, &of, k - 1) &&
        !is_beside_limit(model->rc, &of, k + 1)) {
        const double d[2] = {x[k - 1] - x[k], x[k + 1] - x[k]};
        const double f[2] = {gsl_pow_2(p[k - 1]) - gsl_pow_2(p[k]),
                             gsl_pow_2(p[k + 1]) - gsl_pow_2(p[k])};
        double rise, at;
        if (rb_rolling_vertex(d, f, &rise, &at)) {
            patch->max_pressure = sqrt(gsl_pow_2(p[k]) + rise);
            patch->peak += at;
        }
    }
    rb_rolling_stick_limit limit;
    for (int i = run->first; i <= run->last; i++)
        for (int side = -1; side <= 1; side += 2)
            if (rb_rolling_stick_limit_of(model->rc, &of, i, side, &limit) &&
                limit.pressure > patch->max_pressure) {
                patch->max_pressure = limit.pressure;
                patch->peak = limit.at;
            }
}

double rb_rolling_peak_pressure(const rb_rolling_model *model)
{
    rb_rolling_run run = {.last = -1};
    rb_rolling_patch patch;
    double p0 = 0.0;

    while (rb_rolling_next_patch(model->rc, &model->mesh, &model->state, run.last + 1, &run)) {
        set_peak(model, &run, &patch);
        p0 = fmax(p0, patch.max_pressure);
    }
    return p0;
}

rb_status rb_rolling_set_patches(const rb_rolling_model *model, rb_rolling_solution *s)
{
    rb_rolling_run run = {.last = -1};
    size_t count = 0;

    while (rb_rolling_next_patch(model->rc, &model->mesh, &model->state, run.last + 1, &run))
        count++;
    s->contact_from = s->contact_to = NAN;
    s->max_pressure = 0.0;
    s->patch = calloc(count + 1, sizeof *s->patch);
    if (!s->patch)
        return RB_ENOMEM;
    run.last = -1;
    while (rb_rolling_next_patch(model->rc, &model->mesh, &model->state, run.last + 1, &run)) {
        const rb_contact_problem *problem = &model->problem;
        const rb_contact_state *state = &model->state;
        rb_rolling_patch patch = {.from = run.from, .to = run.to};

        for (int i = run.first; i <= run.last; i++) {
            patch.normal_load +=
                problem->load_N[i] * state->p[i] + problem->load_T[i] * state->q[i];
            patch.tangential_load +=
                problem->force_N[i] * state->p[i] + problem->force_T[i] * state->q[i];
            patch.stick += state->zone[i] == RB_ZONE_STICK;
        }
        patch.contact = run.last - run.first + 1;
        patch.bounded = run.bounded;
        set_peak(model, &run, &patch);
        s->contact_from = s->patches ? s->contact_from : patch.from;
        s->contact_to = patch.to;
        s->max_pressure = fmax(s->max_pressure, patch.max_pressure);
        s->edges_bounded |= run.bounded != 0;
        s->patch[s->patches++] = patch;
    }
    s->half_width = 0.5 * (s->contact_to - s->contact_from);
    s->contact_share = model->rc->period > 0.0 ? 0.0 : NAN;
    for (int k = 0; k < s->patches && model->rc->period > 0.0; k++)
        s->contact_share += (s->patch[k].to - s->patch[k].from) / model->rc->period;
    return RB_OK;
}

double rb_rolling_longest_element(int n, const int *zone, const double *h)
{
    double longest = 0.0;

    for (int i = 0; i < n; i++)
        if (zone[i] != RB_ZONE_SEPARATED)
            longest = fmax(longest, h[i]);
    return longest;
}

double rb_rolling_rise_in_patches(const rb_rolling_case *rc, const rb_rolling_solution *s,
                                  double times)
{
    double element = 0.0, most = 0.0;

    for (int i = 0; i < s->n; i++)
        if (s->zone[i] != RB_ZONE_SEPARATED)
            element = fmax(element, rb_unit_stored(s->units, "mm", s->h[i]));
    for (int k = 0; k < s->patches && element > 0.0; k++)
        most = fmax(most,
                    rb_rolling_rise_at_corners(
                        rc, rb_unit_stored(s->units, "mm", s->patch[k].from) + element,
                        rb_unit_stored(s->units, "mm", s->patch[k].to) - element, element, times));
    return most;
}

int rb_rolling_presses_with_end(const rb_rolling_case *rc, const rb_rolling_solution *s)
{
    return rc->mesh == RB_MESH_PUNCH && s->n > 0 && (s->p[0] > 0.0 || s->p[s->n - 1] > 0.0);
}
