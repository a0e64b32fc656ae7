/* The truss's picture: a quarter of it from above, one panel an increment, the
 * displacements of its contact nodes at the end, and the quarter seen from the side, at
 * rest and at the end. */
#include "report/fem_internal.h"

#include <math.h>

enum { COLUMNS = 4 };

/* Vectors on the contact nodes with x, y >= 0. */
typedef struct {
    const rb_fem_model *model;
    double spacing, width, height; /* of the quarter [m] */
} quarter;

static quarter make_quarter(const rb_fem_model *model)
{
    const double *x = model->mesh.x;
    const int last = model->structure.contacts - 1;
    return (quarter){model, 1e-3 * (x[3] - x[0]), 1e-3 * x[3 * last],
                     1e-3 * x[3 * last + 1]};
}

/* Increments of a step, or displacements where total. */
static const double *vector_of(const rb_fem_step *step, int total, int node)
{
    return total ? step->u + 3 * node : step->du + 3 * node + 1;
}

static double longest(const rb_fem_model *model, const rb_fem_step *step, int total)
{
    double most = 0.0;
    for (int i = 0; i < model->structure.contacts; i++) {
        const double *t = vector_of(step, total, i);
        most = fmax(most, hypot(t[0], t[1]));
    }
    return most;
}

/* Two blocks of data: slipping nodes with their vectors, sticking ones. */
static void write_vectors(FILE *out, const quarter *q, const rb_fem_step *step, int total,
                          double scale, int panel)
{
    for (int slip = 1; slip >= 0; slip--) {
        fprintf(out, "$%s%d << EOD\n", slip ? "move" : "rest", panel);
        fputs("1e9 1e9 0 0\n", out); /* gnuplot refuses an empty block */
        for (int i = 0; i < q->model->structure.contacts; i++) {
            const double *x = q->model->mesh.x + 3 * i;
            const double *t = vector_of(step, total, i);
            const int moves =
                total ? t[0] != 0.0 || t[1] != 0.0 : step->contact[i] == RB_FEM_SLIP;
            if (x[0] >= 0.0 && x[1] >= 0.0 && moves == slip)
                fprintf(out, "%.9g %.9g %.9g %.9g\n", 1e-3 * x[0], 1e-3 * x[1],
                        1e-3 * scale * t[0], 1e-3 * scale * t[1]);
        }
        fputs("EOD\n", out);
    }
}

/* Where a node is drawn: from above, or along a line of sight that looks down on it. */
static void project(const double *x, int from_above, double at[2])
{
    static const double turn = 0.62, rise = 0.42; /* [rad] */
    const double away = x[0] * sin(turn) + x[1] * cos(turn);
    at[0] = 1e-3 * (from_above ? x[0] : x[0] * cos(turn) - x[1] * sin(turn));
    at[1] = 1e-3 * (from_above ? x[1] : away * sin(rise) + x[2] * cos(rise));
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
            project(x, from_above, at[k]);
        }
        if (inside)
            fprintf(out, "%.7g %.7g\n%.7g %.7g\n\n", at[0][0], at[0][1], at[1][0],
                    at[1][1]);
    }
    fputs("EOD\n", out);
}

static double scale_of(const quarter *q, const rb_fem_step *step, int total)
{
    const double most = longest(q->model, step, total);
    return most > 1e-9 ? rb_report_fem_round(1.1e3 * q->spacing / most) : 1.0;
}

static void open_panel(FILE *out, int panel)
{
    const double wide = 0.93 / COLUMNS, left = 0.055 + wide * (panel % COLUMNS);
    const double tall = 0.42, top = 0.925 - tall * (panel / COLUMNS);
    fprintf(out,
            "set lmargin at screen %.4f\nset rmargin at screen %.4f\n"
            "set tmargin at screen %.4f\nset bmargin at screen %.4f\n",
            left, left + 0.82 * wide, top - 0.085, top - tall + 0.065);
}

static void write_panel(FILE *out, const quarter *q, const rb_fem_step *step, int total,
                        int panel)
{
    const double scale = scale_of(q, step, total);
    write_vectors(out, q, step, total, scale, panel);
    open_panel(out, panel);
    fprintf(out, "set title '{/:Bold %s%d}  (×%g)' offset 0,0.1\n",
            total ? "total, m = " : "m = ", total ? panel : panel + 1, scale);
    if (!total)
        fprintf(out,
                "set label 3 '{/*0.8 stick %d, slip %d}' at graph 0.5, graph 1.06 center "
                "textcolor rgb '#555555'\n",
                step->stick, step->slip);
    fprintf(
        out,
        "plot $bars using 1:2 with lines linecolor rgb '#c8ccd0' linewidth 0.7 notitle, "
        "$rest%d using 1:2 with points pointtype 6 pointsize 1.1 linecolor rgb "
        "'#1f4e79' notitle, $move%d using 1:2 with points pointtype 7 pointsize 0.5 "
        "linecolor rgb '#c0392b' notitle, $move%d using 1:2:3:4 with vectors head size "
        "screen 0.007,20 filled linecolor rgb '#c0392b' linewidth 1.3 notitle\n",
        panel, panel, panel);
}

/* The quarter from the side, at rest and after the last increment. */
static void write_side(FILE *out, const quarter *q, const rb_fem_step *last, int panel)
{
    const double scale = scale_of(q, last, 1);
    write_bars(out, q, "before", 0, NULL, 0.0);
    write_bars(out, q, "after", 0, last->u, scale);
    open_panel(out, panel);
    fprintf(out,
            "set title '{/:Bold from the side}  (×%g)' offset 0,0.1\n"
            "set autoscale\nset size ratio -1\nunset tics\nunset border\n"
            "plot $before using 1:2 with lines linecolor rgb '#b4bac0' linewidth 0.6 "
            "notitle, $after using 1:2 with lines linecolor rgb '#1f4e79' linewidth 0.7 "
            "notitle\n",
            scale);
}

static void write_legend(FILE *out)
{
    static const char *const lines[] = {
        "A quarter of the truss from above, x, y ≥ 0 from its centre [m].  {/:Bold Red}: "
        "slip, its displacement times the factor in parentheses.  {/:Bold Blue}: stick",
        "(total: no displacement).  Counts are of the whole truss.  From the side: grey "
        "at rest, blue after the last increment."};
    for (int k = 0; k < (int)(sizeof lines / sizeof *lines); k++)
        fprintf(out, "set label %d '{/*0.75 %s}' at screen 0.055, %.4f\n", 10 + k,
                lines[k], 0.052 - 0.028 * k);
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
    (void)canvas;
    fprintf(out,
            "set multiplot\nset label 1 '{/:Bold Truss on an obstacle: increments of the "
            "contact nodes} (Kanno, example 3.1; %s)' at screen 0.5, 0.955 center\n",
            v->layout);
    fprintf(out, "set xrange [0:%g]\nset yrange [0:%g]\nset xtics 0, 4\nset ytics 0, 4\n",
            q->width + 1.1 * q->spacing, q->height + 1.1 * q->spacing);
    write_legend(out);
    write_bars(out, q, "bars", 1, NULL, 0.0);
    for (int k = 0; k < history->steps; k++) {
        write_panel(out, q, &history->step[k], 0, k);
        fputs("unset label\n", out); /* drawn over and over they grow fat */
    }
    write_panel(out, q, &history->step[history->steps - 1], 1, history->steps);
    write_side(out, q, &history->step[history->steps - 1], history->steps + 1);
    fputs("unset multiplot\n", out);
}

rb_status rb_report_picture_truss(FILE *out, rb_report_canvas canvas,
                                  const rb_fem_model *model,
                                  const rb_fem_history *history, rb_message *why)
{
    if (history->steps < 1)
        return rb_fail(why, RB_EINVAL, "nothing to draw");
    const int upper = model->mesh.nodes - model->structure.contacts;
    const truss_view v = {make_quarter(model), history,
                          upper < model->structure.contacts ? "upper nodes inside"
                                                            : "upper nodes overhanging"};
    return rb_report_draw(out, canvas, RB_REPORT_SCREEN, write_script, &v, why);
}
