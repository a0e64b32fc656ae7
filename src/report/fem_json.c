/* The examples' steps as JSON. */
#include "rollbem/report_fem.h"

#include <jansson.h>
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

static json_t *start_step(const rb_fem_step *s)
{
    json_t *o = json_object();
    rb_report_json_set(&o, "status", json_string(rb_status_text(s->status)));
    rb_report_json_set(&o, "stick", json_integer(s->stick));
    rb_report_json_set(&o, "slip", json_integer(s->slip));
    rb_report_json_set(&o, "separated", json_integer(s->separated));
    rb_report_json_set(&o, "iterations", json_integer(s->iterations));
    rb_report_json_set(&o, "residual", rb_report_json_number(s->residual));
    return o;
}

static void set_number(json_t **o, const char *key, double x)
{
    rb_report_json_set(o, key, rb_report_json_number(x));
}

json_t *rb_report_json_bar(const rb_fem_model *model, const rb_fem_history *history)
{
    json_t *steps = json_array();
    for (int k = 0; k < history->steps; k++) {
        const rb_report_fem_sums sums = rb_report_fem_sum(model, &history->step[k]);
        json_t *o = start_step(&history->step[k]);
        set_number(&o, "corner_ux_mm", sums.corner[0]);
        set_number(&o, "corner_uy_mm", sums.corner[1]);
        set_number(&o, "normal_sum_N", sums.normal);
        set_number(&o, "tangential_sum_N", sums.tangential[0]);
        rb_report_json_append(&steps, o);
    }
    return steps;
}

json_t *rb_report_json_truss(const rb_fem_model *model, const rb_fem_history *history)
{
    json_t *steps = json_array();
    for (int k = 0; k < history->steps; k++) {
        const rb_report_fem_sums sums = rb_report_fem_sum(model, &history->step[k]);
        json_t *o = start_step(&history->step[k]);
        set_number(&o, "max_increment_mm", sums.increment);
        set_number(&o, "normal_sum_N", sums.normal);
        rb_report_json_append(&steps, o);
    }
    return steps;
}

json_t *rb_report_json_wall(int steps, const rb_fem_wall_step *step)
{
    json_t *list = json_array();
    for (int k = 0; k < steps; k++) {
        const rb_fem_wall_step *s = &step[k];
        json_t *o = json_object();
        set_number(&o, "time_s", s->time);
        set_number(&o, "compression_N", s->compression);
        set_number(&o, "shear_N", s->shear);
        set_number(&o, "drift_m", s->drift);
        rb_report_json_set(&o, "stick", json_integer(s->stick));
        rb_report_json_set(&o, "slip", json_integer(s->slip));
        rb_report_json_set(&o, "separated", json_integer(s->separated));
        rb_report_json_set(&o, "iterations", json_integer(s->iterations));
        set_number(&o, "residual", s->residual);
        set_number(&o, "seconds", s->seconds);
        rb_report_json_append(&list, o);
    }
    return list;
}
