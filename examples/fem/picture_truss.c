/* The truss's picture: a quarter of it from above, one panel an increment, the
 * displacements of its contact nodes at the end, and the quarter seen from the side, at
 * rest and at the end. */
#include "program/report/internal.h"
#include "fem/pictures.h"

#include <math.h>

/* Vectors on the contact nodes with x, y >= 0. */
typedef struct {
    const rb_fem_model *model;
    double spacing, width, height; /* of the quarter [m] */
} quarter;

/* Increments of a step, or displacements where total. */
static const double *vector_of(const rb_fem_step *step, int total, int node)
{
    return total ? step->u + 3 * node : step->du + 3 * node + 1;
}

/* The bars of the quarter as a block of data, displaced by scale times u (NULL: not). */
static void write_bars(FILE *out, const quarter *q, const char *name, int from_above,
                       const double *u, double scale)
{
    const rb_fem_mesh *mesh = &q->model->mesh;
    fprintf(out, "$%s << EOD\nx y\n", name);
    for (int e = 0; e < mesh->elements; e++) {
        double at[2][2];
        int inside = 1;
        for (int k = 0; k < 2; k++) {
            const int node = mesh->node[2 * e + k];
            double x[3];
            inside &= mesh->x[3 * node] >= 0.0 && mesh->x[3 * node + 1] >= 0.0;
            for (int d = 0; d < 3; d++)
                x[d] = mesh->x[3 * node + d] + (u ? scale * u[3 * node + d] : 0.0);
            /* Where a node is drawn: from above, or along a line of sight that looks down
             * on it. */
            static const double turn = 0.62, rise = 0.42; /* [rad] */
            const double away = x[0] * sin(turn) + x[1] * cos(turn);
            at[k][0] = 1e-3 * (from_above ? x[0] : x[0] * cos(turn) - x[1] * sin(turn));
            at[k][1] = 1e-3 * (from_above ? x[1] : away * sin(rise) + x[2] * cos(rise));
        }
        if (inside)
            fprintf(out, "%.7g %.7g\n%.7g %.7g\n\n", at[0][0], at[0][1], at[1][0], at[1][1]);
    }
    fputs("EOD\n", out);
}

static double scale_of(const quarter *q, const rb_fem_step *step, int total)
{
    double most = 0.0;
    for (int i = 0; i < q->model->structure.contacts; i++) {
        const double *t = vector_of(step, total, i);
        most = fmax(most, hypot(t[0], t[1]));
    }
    return most > 1e-9 ? rb_report_round_down(1.1e3 * q->spacing / most) : 1.0;
}

/* The nodes of a panel, each with its vector as it is drawn. */
static void write_nodes(FILE *out, const quarter *q, const rb_fem_step *step, int total, int panel)
{
    const double scale = scale_of(q, step, total);
    for (int i = 0; i < q->model->structure.contacts; i++) {
        const double *x = q->model->mesh.x + 3 * i;
        const double *t = vector_of(step, total, i);
        const int moves = total ? t[0] != 0.0 || t[1] != 0.0 : step->contact[i] == RB_FEM_SLIP;
        if (x[0] >= 0.0 && x[1] >= 0.0)
            fprintf(out, "%d\t%.9g\t%.9g\t%.9g\t%.9g\t%d\n", panel, 1e-3 * x[0], 1e-3 * x[1],
                    1e-3 * scale * t[0], 1e-3 * scale * t[1], moves);
    }
}

typedef struct {
    quarter q;
    const rb_fem_history *history;
    const char *layout;
} truss_view;

static void write_inputs(FILE *out, rb_report_canvas canvas, const void *view)
{
    const truss_view *v = view;
    const quarter *q = &v->q;
    const int steps = v->history->steps;
    const rb_fem_step *step = v->history->step, *last = &step[steps - 1];
    const double scale = scale_of(q, last, 1); /* of all increments */

    (void)canvas;
    write_bars(out, q, "bars", 1, NULL, 0.0);
    write_bars(out, q, "before", 0, NULL, 0.0);
    write_bars(out, q, "after", 0, last->u, scale);
    fputs("$table << EOD\npanel\tx\ty\tdx\tdy\tmoves\n", out);
    for (int k = 0; k < steps; k++)
        write_nodes(out, q, &step[k], 0, k);
    write_nodes(out, q, last, 1, steps);
    fputs("EOD\nscales = '", out);
    for (int k = 0; k < steps; k++)
        fprintf(out, "%g ", scale_of(q, &step[k], 0));
    fprintf(out, "%g'\nstick = '", scale);
    for (int k = 0; k < steps; k++)
        fprintf(out, "%d ", step[k].stick);
    fputs("'\nslip = '", out);
    for (int k = 0; k < steps; k++)
        fprintf(out, "%d ", step[k].slip);
    fputs("'\n", out);
    rb_report_let_whole(out, "steps", steps);
    rb_report_let(out, "spacing", q->spacing);
    rb_report_let(out, "width", q->width);
    rb_report_let(out, "height", q->height);
    rb_report_let_text(out, "layout", "%s", v->layout);
}

rb_status rb_fem_picture_truss(FILE *out, rb_report_canvas canvas, const rb_fem_model *model,
                               const rb_fem_history *history, rb_message *why)
{
    if (history->steps < 1)
        return rb_fail(why, RB_EINVAL, "nothing to draw");
    const int upper = model->mesh.nodes - model->structure.contacts;
    const double *x = model->mesh.x, *last = x + 3 * (model->structure.contacts - 1);
    const truss_view v = {{model, 1e-3 * (x[3] - x[0]), 1e-3 * last[0], 1e-3 * last[1]},
                          history,
                          upper < model->structure.contacts ? "upper nodes inside"
                                                            : "upper nodes overhanging"};
    return rb_report_draw(out, canvas, RB_REPORT_PANELS, "truss", write_inputs, &v, why);
}
