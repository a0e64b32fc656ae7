/* The contact problem of a model as a file of FCLib. */
#include "lcp/friction/friction.h"
#include "program/report/report.h"

#include <stdlib.h>

rb_status rb_report_fclib(const char *path, const rb_rolling_model *model, rb_message *why)
{
    const rb_contact_problem *p = &model->problem;
    const rb_contact_state *state = &model->state;
    rb_contact_cone cone;
    if (p->yield)
        return rb_fail(why, RB_EINVAL,
                       "an FCLib file has Coulomb's cones alone, no interface that "
                       "yields (--yield-stress)");
    rb_status s = rb_contact_cone_create(p, state->delta, state->xi, &cone, why);

    if (s != RB_OK)
        return s;
    const rb_friction_problem problem = rb_friction_of_cone(&cone);
    double *r = rb_alloc(2 * (size_t)p->n, 1);
    const rb_friction_solution forces = {.r = r};
    for (int i = 0; r && i < p->n; i++) {
        r[2 * i] = state->p[i] / p->stress;
        r[2 * i + 1] = state->q[i] / p->stress;
    }
    s = r ? rb_friction_write(path, &problem, &forces, "rolling contact by rollbem", why)
          : rb_fail(why, RB_ENOMEM, "out of memory for %d contacts", p->n);
    free(r);
    rb_contact_cone_free(&cone);
    return s;
}
