/* Sums over the contacts of a step of an example. */
#include "program/report/report_fem.h"

#include <math.h>

rb_report_fem_sums rb_report_fem_sum(const rb_fem_model *model, const rb_fem_step *step)
{
    const int d = model->mesh.dimension;
    const double *last = step->u + d * (model->mesh.nodes - 1);
    rb_report_fem_sums sums = {.corner = {last[0], last[1]}};
    for (int i = 0; i < model->structure.contacts; i++) {
        const double *r = step->r + d * i, *du = step->du + d * i;
        sums.normal += r[0];
        for (int k = 1; k < d; k++)
            sums.tangential[k - 1] += r[k];
        sums.increment = fmax(sums.increment, d == 2 ? fabs(du[1]) : hypot(du[1], du[2]));
    }
    return sums;
}
