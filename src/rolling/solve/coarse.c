/* A solution on a coarser mesh is the start on a finer one, so that the number of Newton
 * steps does not grow. */
#include "rolling/case/derived.h"
#include "rolling/solve/coarse.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/law_iteration.h"
#include "rolling/solve/model.h"

#include <stdlib.h>

/* The coarsest mesh, which starts cold, has fewer elements than any that starts from another one.
 */
int rb_rolling_coarse_elements(int n)
{
    return n / 4 >= RB_ROLLING_TRANSFORMS ? n / 4 : RB_ROLLING_COARSEST;
}

/* Value at x of tractions at the coarse midpoints, linear in between. */
static double interpolated(const rb_rolling_mesh *mesh, const double *value, double x, int j)
{
    const double here = 0.5 * (mesh->ends[j] + mesh->ends[j + 1]);
    const int other = x < here ? j - 1 : j + 1;

    if (other < 0 || other >= mesh->n)
        return value[j];
    const double there = 0.5 * (mesh->ends[other] + mesh->ends[other + 1]);
    return value[j] + (value[other] - value[j]) * (x - here) / (there - here);
}

double *rb_rolling_friction_of(const rb_rolling_model *model)
{
    const rb_rolling_case *rc = model->rc;
    double kappa;

    /* kappa < 1: only one state is possible with the friction law */
    return rb_rolling_law_depends_on_state(rc) && model->state.status == RB_OK &&
                   rc->formulation == RB_STEADY && rc->friction.heat <= 0.0 &&
                   rb_rolling_law_kappa(model, &kappa) == RB_OK && kappa < 1.0
               ? rb_copy((size_t)model->problem.n, model->problem.bound)
               : NULL;
}

void rb_rolling_follow_friction(const rb_rolling_mesh *mesh, const double *bound,
                                rb_rolling_model *fine)
{
    rb_contact_problem *p = &fine->problem;
    const double *ends = fine->mesh.ends;

    for (int i = 0, j = 0; i < p->n && bound; i++) {
        const double x = 0.5 * (ends[i] + ends[i + 1]);
        while (j < mesh->n - 1 && mesh->ends[j + 1] < x)
            j++;
        p->bound[i] = interpolated(mesh, bound, x, j);
    }
    if (bound)
        rb_contact_set_friction(p, p->mu, p->bound);
    fine->follows = bound != NULL;
}

void rb_rolling_start_from(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                           const rb_contact_state *coarse, const rb_rolling_mesh *fine_mesh,
                           rb_contact_state *fine)
{
    double from, to;
    int j = 0;

    rb_rolling_contact_edges(rc, mesh, coarse, &from, &to);
    for (int i = 0; i < fine_mesh->n; i++) {
        const double x = 0.5 * (fine_mesh->ends[i] + fine_mesh->ends[i + 1]);
        while (j < mesh->n - 1 && mesh->ends[j + 1] < x)
            j++;
        fine->p[i] = interpolated(mesh, coarse->p, x, j);
        fine->q[i] = interpolated(mesh, coarse->q, x, j);
        /* The coarse edges are known to less than an element: the outermost zones follow
         * them. */
        const int zone = coarse->zone[j];

        if (x < from || x > to)
            fine->zone[i] = RB_ZONE_SEPARATED;
        else {
            if (zone != RB_ZONE_SEPARATED)
                fine->zone[i] = zone;
            else {
                const int left = j > 0 ? coarse->zone[j - 1] : RB_ZONE_SEPARATED;
                const int right = j + 1 < coarse->n ? coarse->zone[j + 1] : RB_ZONE_SEPARATED;
                fine->zone[i] = left != RB_ZONE_SEPARATED ? left : right;
            }
        }
    }
    fine->delta = coarse->delta;
    fine->xi = coarse->xi;
}

void rb_rolling_start_near(const rb_rolling_mesh *old_mesh, const rb_contact_state *old,
                           const double *bound, rb_rolling_model *model)
{
    if (model->rc->mesh == RB_MESH_FITTED && old->n == model->state.n)
        rb_contact_copy_start(old, &model->state);
    else
        rb_rolling_start_from(model->rc, old_mesh, old, &model->mesh, &model->state);
    rb_rolling_follow_friction(old_mesh, bound, model);
}

rb_status rb_rolling_start_from_coarse(rb_rolling_model *model, rb_message *why)
{
    const double *ends = model->mesh.ends;
    rb_rolling_plan fewer = model->plan;
    rb_rolling_model coarse;
    rb_rolling_mesh mesh;

    fewer.elements = rb_rolling_coarse_elements(model->mesh.n);
    rb_status s = rb_rolling_model_begin(model->rc, &fewer, &coarse, why);
    if (s == RB_OK)
        s = rb_rolling_mesh_uniform(model->rc, &fewer, ends[0], ends[model->mesh.n], &mesh, why);
    if (s == RB_OK)
        s = rb_rolling_model_build(&coarse, &mesh, why);
    if (s >= 0 && coarse.state.p)
        rb_rolling_start_from(coarse.rc, &coarse.mesh, &coarse.state, &model->mesh, &model->state);
    if (s == RB_OK) {
        double *bound = rb_rolling_friction_of(&coarse);
        rb_rolling_follow_friction(&coarse.mesh, bound, model);
        free(bound);
    }
    model->iterations += coarse.iterations;
    model->state.refused_at = coarse.state.refused_at;
    /* more elements would be given up, too */
    const int gave_up = s != RB_ZONE && rb_rolling_gave_up(&coarse);
    if (gave_up) {
        model->problem.step_limit = coarse.problem.step_limit;
        model->state.status = s;
    }
    rb_rolling_model_free(&coarse);
    return s < 0 || gave_up ? s : RB_OK;
}
