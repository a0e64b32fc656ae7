/* The bar's picture: deformed mesh above, reactions below. */
#include "program/report/internal.h"
#include "fem/pictures.h"

#include <math.h>

static const double magnify = 50.0; /* *Kanno*, figure 5 */

typedef struct {
    const rb_fem_model *model;
    const rb_fem_step *step;
    int nx, ny; /* elements */
    double length, height;
} bar_view;

static void write_node(FILE *out, const bar_view *v, int i, int j)
{
    const int node = i + (v->nx + 1) * j;
    for (int k = 0; k < 2; k++)
        fprintf(out, "%.6g ", v->model->mesh.x[2 * node + k] + magnify * v->step->u[2 * node + k]);
    fputs("\n", out);
}

/* The lines of the mesh, and its edge. */
static void write_mesh(FILE *out, const bar_view *v)
{
    fputs("$mesh << EOD\nx y\n", out);
    for (int j = 0; j <= v->ny; j++, fputs("\n", out))
        for (int i = 0; i <= v->nx; i++)
            write_node(out, v, i, j);
    for (int i = 0; i <= v->nx; i++, fputs("\n", out))
        for (int j = 0; j <= v->ny; j++)
            write_node(out, v, i, j);
    fputs("EOD\n$edge << EOD\nx y\n", out);
    for (int i = 0; i <= v->nx; i++)
        write_node(out, v, i, 0);
    for (int j = 0; j <= v->ny; j++)
        write_node(out, v, v->nx, j);
    for (int i = v->nx; i >= 0; i--)
        write_node(out, v, i, v->ny);
    for (int j = v->ny; j >= 0; j--)
        write_node(out, v, 0, j);
    fputs("EOD\n", out);
}

/* Reactions per length: a node at an end carries half an element. */
static void write_reactions(FILE *out, const bar_view *v)
{
    const double *r = v->step->r, h = v->length / v->nx;
    fputs("$table << EOD\nx\tnormal\ttangential\n", out);
    for (int i = 0; i <= v->nx; i++) {
        const double share = i == 0 || i == v->nx ? 0.5 * h : h, mu = v->model->structure.mu[i];
        fprintf(out, "%.9g\t%.9g\t%.9g\n", h * i, r[2 * i] / share,
                mu > 0.0 ? r[2 * i + 1] / (mu * share) : 0.0);
    }
    fputs("EOD\n", out);
}

/* Stretches of equal state, half-way between the nodes. */
static void write_zones(FILE *out, const bar_view *v)
{
    static const int zone[] = {RB_ZONE_SEPARATED, RB_ZONE_STICK, RB_ZONE_SLIP_NEGATIVE};
    const double h = v->length / v->nx;
    fputs("$zones << EOD\nfrom to zone nodes\n", out);
    for (int i = 0, first = 0; i <= v->nx; i++) {
        const rb_fem_contact state = v->step->contact[first];
        if (i < v->nx && v->step->contact[i + 1] == state)
            continue;
        fprintf(out, "%.9g %.9g %d %d\n", fmax(h * (first - 0.5), 0.0),
                fmin(h * (i + 0.5), v->length), zone[state], i - first + 1);
        first = i + 1;
    }
    fputs("EOD\n", out);
}

static void write_inputs(FILE *out, rb_report_canvas canvas, const void *view)
{
    const bar_view *v = view;
    const double *end = v->step->u + 2 * (v->model->mesh.nodes - 1);

    (void)canvas;
    write_mesh(out, v);
    write_reactions(out, v);
    write_zones(out, v);
    rb_report_let(out, "length", v->length);
    rb_report_let(out, "height", v->height);
    rb_report_let(out, "magnify", magnify);
    rb_report_let(out, "end_x", end[0]);
    rb_report_let(out, "end_y", end[1]);
}

rb_status rb_fem_picture_bar(FILE *out, rb_report_canvas canvas, const rb_fem_model *model,
                             const rb_fem_history *history, rb_message *why)
{
    if (history->steps < 1)
        return rb_fail(why, RB_EINVAL, "nothing to draw");
    const double *x = model->mesh.x + 2 * (model->mesh.nodes - 1);
    const int nx = model->structure.contacts - 1;
    const bar_view v = {
        model, &history->step[history->steps - 1], nx, model->mesh.elements / nx, x[0], x[1]};
    return rb_report_draw(out, canvas, RB_REPORT_SCREEN, "bar", write_inputs, &v, why);
}
