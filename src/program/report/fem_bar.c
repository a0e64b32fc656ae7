/* The bar's picture: deformed mesh above, reactions below. */
#include "program/report/internal.h"
#include "program/report/report_fem.h"

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

static void write_script(FILE *out, rb_report_canvas canvas, const void *view)
{
    const bar_view *v = view;
    const rb_report_place place = rb_report_place_of(canvas);
    const double *end = v->step->u + 2 * (v->model->mesh.nodes - 1);
    fputs("$mesh << EOD\n", out);
    for (int j = 0; j <= v->ny; j++, fputs("\n", out))
        for (int i = 0; i <= v->nx; i++)
            write_node(out, v, i, j);
    for (int i = 0; i <= v->nx; i++, fputs("\n", out))
        for (int j = 0; j <= v->ny; j++)
            write_node(out, v, i, j);
    fputs("EOD\n$edge << EOD\n", out);
    for (int i = 0; i <= v->nx; i++)
        write_node(out, v, i, 0);
    for (int j = 0; j <= v->ny; j++)
        write_node(out, v, v->nx, j);
    for (int i = v->nx; i >= 0; i--)
        write_node(out, v, i, v->ny);
    for (int j = v->ny; j >= 0; j--)
        write_node(out, v, 0, j);
    fputs("EOD\n", out);
    /* Reactions per length: a node at an end carries half an element. */
    const double *r = v->step->r, h = v->length / v->nx;
    fputs("$reaction << EOD\n", out);
    for (int i = 0; i <= v->nx; i++) {
        const double share = i == 0 || i == v->nx ? 0.5 * h : h, mu = v->model->structure.mu[i];
        fprintf(out, "%.9g %.9g %.9g\n", h * i, r[2 * i] / share,
                mu > 0.0 ? r[2 * i + 1] / (mu * share) : 0.0);
    }
    fputs("EOD\n", out);
    fprintf(out,
            "set multiplot\nset lmargin at screen %g\nset rmargin at screen %g\n"
            "set xrange [0:%g]\nset tmargin at screen 0.86\nset bmargin at screen 0.60\n",
            canvas.size == RB_REPORT_SLIDE ? 0.125 : 0.10 + 1.6 * place.right,
            place.titled ? 0.975 : 0.95, 1.005 * v->length);
    if (place.titled)
        fprintf(out,
                "set label 1 '{/:Bold Bar pressed onto an obstacle and pushed from the right} "
                "(Kanno, example 3.2)' at screen 0.535, 0.955 center\n"
                "set label 2 'deformed mesh, displacements × %g;  end of the bar: %.4f mm, %+.4f "
                "mm' at screen 0.535, 0.90 center textcolor rgb '#444444'\n",
                magnify, end[0], end[1]);
    else
        fprintf(out,
                "set xtics 100\nset label 2 'displacements × %g' at screen 0.58, 0.9 center "
                "textcolor rgb '#444444'\n",
                magnify);
    fprintf(out,
            "set yrange [%g:%g]\nset ytics 0, %g\nset format x ''\nset ylabel 'y [mm]'\n"
            "set object rectangle from graph 0, graph 0 to graph 1, first 0 fillcolor rgb "
            "'#cfcfcf' fillstyle solid noborder behind\n"
            "plot $mesh using 1:2 with lines linecolor rgb '#6f9fc8' linewidth 0.35 notitle, $edge "
            "using 1:2 with lines linecolor rgb '#1f4e79' linewidth 1.2 notitle\n",
            -0.2 * v->height, 1.55 * v->height, 0.5 * v->height);
    fputs("unset label\nunset object\nset tmargin at screen 0.55\nset bmargin at screen 0.13\n"
          "set format x '%g'\nset xlabel 'x [mm]' offset 0,0.3\nset ylabel 'reaction [N/mm]'\n"
          "set yrange [0:*]\nset ytics autofreq\nset offsets 0, 0, graph 0.2, 0\n"
          "set key at graph 0.06, graph 0.46 left Left reverse samplen 1.5\n",
          out);
    /* Stretches of equal state, half-way between the nodes. */
    static const int zone[] = {RB_ZONE_SEPARATED, RB_ZONE_STICK, RB_ZONE_SLIP_NEGATIVE};
    static const char *const name[] = {"separated", "stick", "slip"};

    for (int i = 0, first = 0; i <= v->nx; i++) {
        const rb_fem_contact state = v->step->contact[first];
        if (i < v->nx && v->step->contact[i + 1] == state)
            continue;
        const double from = fmax(h * (first - 0.5), 0.0), to = fmin(h * (i + 0.5), v->length);
        fprintf(out,
                "set object rectangle from first %.9g, graph 0 to first %.9g, graph 1 fillcolor "
                "rgb '%s' fillstyle solid noborder behind\n",
                from, to, rb_report_zone_colour(zone[state], 1));
        const int wide = to - from > 0.1 * v->length;
        fprintf(
            out,
            "set label '{/*0.85 %s: %d}' at first %.9g, graph %s textcolor rgb '#555555' front\n",
            name[state], i - first + 1, 0.5 * (from + to),
            wide ? "0.93 center" : "0.97 right rotate by 90");
        first = i + 1;
    }
    fprintf(out,
            "plot $reaction using 1:2 with points pointtype 5 pointsize 0.9 linecolor rgb "
            "'#1f4e79' title 'normal', $reaction using 1:3 with points pointtype 9 pointsize 1.0 "
            "linecolor rgb '#c0392b' title 'tangential / μ%s'\nunset multiplot\n",
            place.titled ? ", to the right" : "");
}

rb_status rb_report_picture_bar(FILE *out, rb_report_canvas canvas, const rb_fem_model *model,
                                const rb_fem_history *history, rb_message *why)
{
    if (history->steps < 1)
        return rb_fail(why, RB_EINVAL, "nothing to draw");
    const double *x = model->mesh.x + 2 * (model->mesh.nodes - 1);
    const int nx = model->structure.contacts - 1;
    const bar_view v = {
        model, &history->step[history->steps - 1], nx, model->mesh.elements / nx, x[0], x[1]};
    return rb_report_draw(out, canvas, RB_REPORT_SCREEN, NULL, write_script, &v, why);
}
