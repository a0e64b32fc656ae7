/* What a solution says of its patches: forces, edges, and the largest pressure. */
#include "base/units.h"
#include "rolling/body/mesh.h"
#include "rolling/case/derived.h"
#include "rolling/solve/model.h"
#include "rolling/solve/patches.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>

/* Vertex of the parabola of p^2 through the largest element and its neighbours: exact for
 * Hertz's ellipse. */
static void set_peak(const rb_rolling_mesh *mesh, const double *p, const rb_rolling_run *run,
                     rb_rolling_patch *patch)
{
    int k = run->first;

    for (int i = run->first; i <= run->last; i++)
        k = p[i] > p[k] ? i : k;
    patch->max_pressure = p[k];
    patch->peak = rb_rolling_midpoint(mesh, k);
    if (k == 0 || k == mesh->n - 1)
        return;
    const double d[2] = {rb_rolling_midpoint(mesh, k - 1) - rb_rolling_midpoint(mesh, k),
                         rb_rolling_midpoint(mesh, k + 1) - rb_rolling_midpoint(mesh, k)};
    const double f[2] = {gsl_pow_2(p[k - 1]) - gsl_pow_2(p[k]),
                         gsl_pow_2(p[k + 1]) - gsl_pow_2(p[k])};
    double rise, at;
    if (!rb_rolling_vertex(d, f, &rise, &at))
        return;
    patch->max_pressure = sqrt(gsl_pow_2(p[k]) + rise);
    patch->peak += at;
}

double rb_rolling_peak_pressure(const rb_rolling_model *model)
{
    rb_rolling_run run = {.last = -1};
    rb_rolling_patch patch;
    double p0 = 0.0;

    while (rb_rolling_next_patch(model->rc, &model->mesh, &model->state, run.last + 1, &run)) {
        set_peak(&model->mesh, model->state.p, &run, &patch);
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
        set_peak(&model->mesh, state->p, &run, &patch);
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
