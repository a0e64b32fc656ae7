/* The truss's picture: a quarter of it from above, one panel an increment, the
 * displacements of its contact nodes at the end, and the quarter seen from the side, at
 * rest and at the end. */
#include "program/report/internal.h"
#include "program/report/report_fem.h"

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
    fprintf(out, "$%s << EOD\n", name);
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

/* Four panels in a row, or two in a column of print, whose letters are larger. */
static void open_panel(FILE *out, int column, int panel)
{
    const int row = column ? 2 : 4;
    const double wide = (column ? 0.95 : 0.93) / row;
    const double left = (column ? 0.1 : 0.055) + wide * (panel % row);
    const double tall = column ? 0.223 : 0.42;
    const double top = (column ? 0.99 : 0.925) - tall * (panel / row);
    fprintf(out,
            "set lmargin at screen %.4f\nset rmargin at screen %.4f\n"
            "set tmargin at screen %.4f\nset bmargin at screen %.4f\n",
            left, left + (column ? 0.78 : 0.82) * wide, top - (column ? 0.05 : 0.085),
            top - tall + (column ? 0.052 : 0.065));
}

static void write_panel(FILE *out, const quarter *q, const rb_fem_step *step, int total, int column,
                        int panel)
{
    const double scale = scale_of(q, step, total);
    /* Two blocks of data: slipping nodes with their vectors, sticking ones. */
    for (int slip = 1; slip >= 0; slip--) {
        fprintf(out, "$%s%d << EOD\n", slip ? "move" : "rest", panel);
        fputs("1e9 1e9 0 0\n", out); /* gnuplot refuses an empty block */
        for (int i = 0; i < q->model->structure.contacts; i++) {
            const double *x = q->model->mesh.x + 3 * i;
            const double *t = vector_of(step, total, i);
            const int moves = total ? t[0] != 0.0 || t[1] != 0.0 : step->contact[i] == RB_FEM_SLIP;
            if (x[0] >= 0.0 && x[1] >= 0.0 && moves == slip)
                fprintf(out, "%.9g %.9g %.9g %.9g\n", 1e-3 * x[0], 1e-3 * x[1], 1e-3 * scale * t[0],
                        1e-3 * scale * t[1]);
        }
        fputs("EOD\n", out);
    }
    open_panel(out, column, panel);
    fprintf(out, "set title '{/:Bold %s%d}  (×%g)' offset 0,0.1\n",
            total ? "total, m = " : "m = ", total ? panel : panel + 1, scale);
    if (!total)
        fprintf(out,
                "set label 3 '{/*0.8 stick %d, slip %d}' at graph 0.5, graph 1.06 center textcolor "
                "rgb '#555555'\n",
                step->stick, step->slip);
    fprintf(out,
            "plot $bars using 1:2 with lines linecolor rgb '#c8ccd0' linewidth 0.7 notitle, "
            "$rest%d using 1:2 with points pointtype 6 pointsize 1.1 linecolor rgb '#1f4e79' "
            "notitle, $move%d using 1:2 with points pointtype 7 pointsize 0.5 linecolor rgb "
            "'#c0392b' notitle, $move%d using 1:2:3:4 with vectors head size screen 0.007,20 "
            "filled linecolor rgb '#c0392b' linewidth 1.3 notitle\n",
            panel, panel, panel);
}

typedef struct {
    quarter q;
    const rb_fem_history *history;
    const char *layout;
} truss_view;

static void write_script(FILE *out, rb_report_canvas canvas, const void *view)
{
    const truss_view *v = view;
    const quarter *q = &v->q;
    const rb_fem_history *history = v->history;
    const rb_fem_step *last = &history->step[history->steps - 1];
    const int column = !rb_report_place_of(canvas).titled;
    fputs("set multiplot\n", out);
    if (!column)
        fprintf(out,
                "set label 1 '{/:Bold Truss on an obstacle: increments of the contact nodes} "
                "(Kanno, example 3.1; %s)' at screen 0.5, 0.955 center\n",
                v->layout);
    fprintf(out, "set xrange [0:%g]\nset yrange [0:%g]\nset xtics 0, 4\nset ytics 0, 4\n",
            q->width + 1.1 * q->spacing, q->height + 1.1 * q->spacing);
    enum { LINES = 4 };
    static const char *const lines[2][LINES] = {
        {"A quarter of the truss from above, x, y ≥ 0 from its centre [m].  {/:Bold Red}: slip, "
         "its displacement times the factor in parentheses.  {/:Bold Blue}: stick",
         "(total: no displacement).  Counts are of the whole truss.  From the side: grey at rest, "
         "blue after the last increment."},
        {"A quarter of the truss from above, x, y ≥ 0 from its centre [m].",
         "{/:Bold Red}: slip, its displacement times the factor in parentheses.",
         "{/:Bold Blue}: stick (total: no displacement).  Counts are of the whole truss.",
         "From the side: grey at rest, blue after the last increment."}};
    for (int k = 0; k < LINES && lines[column][k]; k++)
        fprintf(out, "set label %d '{/*%g %s}' at screen 0.055, %.4f\n", 10 + k,
                column ? 0.65 : 0.75, lines[column][k],
                (column ? 0.08 : 0.052) - (column ? 0.02 : 0.028) * k);
    write_bars(out, q, "bars", 1, NULL, 0.0);
    for (int k = 0; k < history->steps; k++) {
        write_panel(out, q, &history->step[k], 0, column, k);
        fputs("unset label\n", out); /* drawn over and over they grow fat */
    }
    write_panel(out, q, last, 1, column, history->steps);
    /* The quarter from the side, at rest and after the last increment. */
    const double scale = scale_of(q, last, 1);
    write_bars(out, q, "before", 0, NULL, 0.0);
    write_bars(out, q, "after", 0, last->u, scale);
    open_panel(out, column, history->steps + 1);
    fprintf(out,
            "set title '{/:Bold from the side}  (×%g)' offset 0,0.1\n"
            "set autoscale\nset size ratio -1\nunset tics\nunset border\n"
            "plot $before using 1:2 with lines linecolor rgb '#b4bac0' linewidth 0.6 notitle, "
            "$after using 1:2 with lines linecolor rgb '#1f4e79' linewidth 0.7 notitle\n",
            scale);
    fputs("unset multiplot\n", out);
}

rb_status rb_report_picture_truss(FILE *out, rb_report_canvas canvas, const rb_fem_model *model,
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
    return rb_report_draw(out, canvas, RB_REPORT_PANELS, NULL, write_script, &v, why);
}
