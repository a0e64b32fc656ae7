/* What the state of a model says: P, Q and their ratio to friction, the creepage in units of mu
 * a/R, what the interface has yielded, and the LCP that it solves. */
#include "rolling/case/derived.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/model.h"

#include <math.h>

double rb_rolling_model_load(const rb_rolling_model *model)
{
    return rb_contact_load(&model->problem, &model->state);
}

double rb_rolling_model_force(const rb_rolling_model *model)
{
    return rb_contact_force(&model->problem, &model->state);
}

double rb_rolling_force_ratio(const rb_rolling_model *model)
{
    const double most = rb_rolling_law_depends_on_state(model->rc)
                            ? model->problem.mu * rb_rolling_model_load(model)
                            : rb_contact_capacity(&model->problem, &model->state);
    return most > 0.0 ? rb_rolling_model_force(model) / most : NAN;
}

double rb_rolling_creepage_of_ratio(const rb_rolling_model *model, double ratio)
{
    return ratio * model->problem.mu * model->half_width / rb_rolling_radius(model->rc);
}

double rb_rolling_ratio_of_creepage(const rb_rolling_model *model, double creepage)
{
    const double mu = model->problem.mu, a = model->half_width;
    return mu > 0.0 && a > 0.0 && rb_rolling_has_radius(model->rc)
               ? creepage * rb_rolling_radius(model->rc) / (mu * a)
               : NAN;
}

void rb_rolling_yielded(const rb_rolling_model *model, double *yielded)
{
    rb_contact_yielded(&model->problem, model->state.plastic, model->state.zone, yielded);
    for (int i = 0; i < model->mesh.n && model->carried.yielded; i++)
        yielded[i] += model->carried.yielded[i];
}

rb_status rb_rolling_model_lcp(const rb_rolling_model *model, rb_contact_lcp *lcp, rb_message *why)
{
    rb_contact_problem problem = model->problem; /* arrays stay the model's */

    problem.sliding = rb_rolling_sliding_creepage(model->rc, &problem);
    return rb_contact_lcp_first(&problem, &model->rc->contact, &model->state, lcp, why);
}
