/* The truss's picture: a quarter of the contact nodes, one panel an increment, and their
 * displacements at the end. */
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

static void write_panel(FILE *out, const quarter *q, const rb_fem_step *step, int total,
                        int panel)
{
    const double most = longest(q->model, step, total);
    const double scale =
        most > 1e-9 ? rb_report_fem_round(1.1e3 * q->spacing / most) : 1.0;
    const double wide = 0.93 / COLUMNS, left = 0.055 + wide * (panel % COLUMNS);
    const double tall = 0.45, top = 0.90 - tall * (panel / COLUMNS);
    write_vectors(out, q, step, total, scale, panel);
    fprintf(out,
            "set lmargin at screen %.4f\nset rmargin at screen %.4f\n"
            "set tmargin at screen %.4f\nset bmargin at screen %.4f\n",
            left, left + 0.82 * wide, top - 0.085, top - tall + 0.065);
    fprintf(out, "set title '{/:Bold %s%d}  (×%g)' offset 0,0.1\n",
            total ? "total, m = " : "m = ", total ? panel : panel + 1, scale);
    if (!total)
        fprintf(out,
                "set label 3 '{/*0.8 stick %d, slip %d}' at graph 0.5, graph 1.06 center "
                "textcolor rgb '#555555'\n",
                step->stick, step->slip);
    fprintf(
        out,
        "plot $rest%d using 1:2 with points pointtype 6 pointsize 1.1 linecolor rgb "
        "'#1f4e79' notitle, $move%d using 1:2 with points pointtype 7 pointsize 0.5 "
        "linecolor rgb '#c0392b' notitle, $move%d using 1:2:3:4 with vectors head size "
        "screen 0.007,20 filled linecolor rgb '#c0392b' linewidth 1.3 notitle\n",
        panel, panel, panel);
}

static void write_legend(FILE *out)
{
    static const char *const lines[] = {"{/:Bold Quarter of the contact nodes,}",
                                        "x, y ≥ 0 from the centre [m].",
                                        "",
                                        "{/:Bold Red}: slip, its displacement",
                                        "times the factor in parentheses.",
                                        "{/:Bold Blue}: stick (m = 1 ... 6)",
                                        "or no displacement (total).",
                                        "",
                                        "Counts are of the whole grid."};
    for (int k = 0; k < (int)(sizeof lines / sizeof *lines); k++)
        fprintf(out, "set label %d '{/*0.75 %s}' at screen 0.76, %.4f\n", 10 + k,
                lines[k], 0.36 - 0.035 * k);
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
    for (int k = 0; k < history->steps; k++) {
        write_panel(out, q, &history->step[k], 0, k);
        fputs("unset label\n", out); /* drawn over and over they grow fat */
    }
    write_panel(out, q, &history->step[history->steps - 1], 1, history->steps);
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
