/* The wall's picture: its deformed front on the left, forces and contacts over time on
 * the right. */
#include "program/report/internal.h"
#include "program/report/report_fem.h"

#include <math.h>
#include <stdlib.h>

typedef struct {
    const rb_fem_mesh *mesh;
    const double *u; /* 3 x nodes */
    double magnify, width, height;
} front;

static void write_node(FILE *out, const front *f, int node)
{
    fprintf(out, "%.6g %.6g\n", f->mesh->x[3 * node] + f->magnify * f->u[3 * node],
            f->mesh->x[3 * node + 2] + f->magnify * f->u[3 * node + 2]);
}

/* Corners of element e on the plane y = 0; 0 when it lies behind. */
static int front_face(const front *f, int e, int corner[4])
{
    static const int which[4] = {0, 1, 5, 4};
    for (int k = 0; k < 4; k++) {
        corner[k] = f->mesh->node[8 * e + which[k]];
        if (f->mesh->x[3 * corner[k] + 1] != 0.0)
            return 0;
    }
    return 1;
}

/* 1: another front face has the same edge, run through the other way. */
static int is_inner(const front *f, int a, int b)
{
    int corner[4];
    for (int e = 0; e < f->mesh->elements; e++) {
        if (!front_face(f, e, corner))
            continue;
        for (int k = 0; k < 4; k++)
            if (corner[k] == b && corner[(k + 1) % 4] == a)
                return 1;
    }
    return 0;
}

enum { FRONT, FORCES, CONTACTS };

/* Where the panels lie on the canvas: side by side, or below each other in a column. */
static const struct {
    double left, right, bottom, top;
} panels[2][3] = {
    {{0.08, 0.54, 0.14, 0.85}, {0.655, 0.965, 0.53, 0.87}, {0.655, 0.965, 0.14, 0.485}},
    {{0.18, 0.93, 0.50, 0.93}, {0.18, 0.93, 0.27, 0.41}, {0.18, 0.93, 0.09, 0.245}}};

static void open_panel(FILE *out, int column, int which)
{
    rb_report_room(out, panels[column][which].left, panels[column][which].right,
                   panels[column][which].bottom, panels[column][which].top);
}

typedef struct {
    front f;
    int steps;
    const rb_fem_wall_step *step;
} wall_view;

static void write_script(FILE *out, rb_report_canvas canvas, const void *view)
{
    const wall_view *v = view;
    const rb_fem_wall_step *last = &v->step[v->steps - 1];
    const int column = !rb_report_place_of(canvas).titled;
    int corner[4];
    fputs("$mesh << EOD\n", out);
    for (int e = 0; e < v->f.mesh->elements; e++)
        if (front_face(&v->f, e, corner)) {
            for (int k = 0; k < 5; k++)
                write_node(out, &v->f, corner[k % 4]);
            fputs("\n", out);
        }
    fputs("EOD\n$edge << EOD\n", out);
    for (int e = 0; e < v->f.mesh->elements; e++)
        for (int k = 0; k < 4 && front_face(&v->f, e, corner); k++)
            if (!is_inner(&v->f, corner[k], corner[(k + 1) % 4])) {
                write_node(out, &v->f, corner[k]);
                write_node(out, &v->f, corner[(k + 1) % 4]);
                fputs("\n", out);
            }
    fputs("EOD\n", out);
    fputs("$step << EOD\n", out);
    for (int k = 0; k < v->steps; k++)
        fprintf(out, "%g %.6g %.6g %d %d %d %d\n", v->step[k].time, 1e-3 * v->step[k].compression,
                1e-3 * v->step[k].shear, v->step[k].stick, v->step[k].slip, v->step[k].separated,
                v->step[k].iterations);
    fputs("EOD\n", out);
    char magnify[40];
    fprintf(out,
            "set multiplot\nset label 1 '{/:Bold Wall of 12 blocks, pressed with %g kN and "
            "sheared}' at screen 0.5, 0.955 center\n"
            "set label 2 'displacements × %s, drift %s%.3g mm' at screen %g, %g center textcolor "
            "rgb '#444444'\n%s",
            1e-3 * last->compression, rb_report_number(v->f.magnify, 5, magnify),
            column ? "" : "of the upper support ", 1e3 * last->drift, column ? 0.5 : 0.31,
            panels[column][FRONT].top + (column ? 0.025 : 0.035), column ? "unset label 1\n" : "");
    open_panel(out, column, FRONT);
    fprintf(out,
            "set size ratio -1\nset xrange [%g:%g]\n"
            "set yrange [%g:%g]\nset xlabel 'x [m]' offset 0,0.3\nset ylabel 'z [m]' offset "
            "1.5,0\nset xtics 0, 0.1\n"
            "set ytics 0, 0.1\n"
            "set object rectangle from %g, %g to %g, 0 fillcolor rgb '#bdbdbd' fillstyle solid "
            "noborder behind\n"
            "plot $mesh using 1:2 with lines linecolor rgb '#d9a679' linewidth 0.4 notitle, $edge "
            "using 1:2 with lines linecolor rgb '#7b3f00' linewidth 1.3 notitle\n",
            -0.1 * v->f.width, 1.35 * v->f.width, -0.05 * v->f.height, 1.08 * v->f.height,
            -0.1 * v->f.width, -0.05 * v->f.height, 1.35 * v->f.width);
    fputs("unset label\nunset object\nset size noratio\nset xrange [0:*]\nset yrange [0:*]\n"
          "set xtics autofreq\nset ytics autofreq\nunset xlabel\nset format x ''\n",
          out);
    if (column)
        fputs("set xtics 0.2\nset ytics 10\n", out);
    open_panel(out, column, FORCES);
    fputs(
        "set ylabel 'force [kN]' offset -0.7,0\n"
        "set key bottom right Left reverse samplen 2\n"
        "plot $step using 1:2 with lines linewidth 2 linecolor rgb '#1f4e79' title 'compression', "
        "$step using 1:3 with lines linewidth 2 linecolor rgb '#c0392b' dashtype (9,4) title "
        "'shear'\n",
        out);
    if (column)
        fprintf(out, "set ytics %g\n",
                rb_report_round_step((last->stick + last->slip + last->separated) / 4.0));
    open_panel(out, column, CONTACTS);
    fputs(column ? "set ylabel 'contact points' offset 0.5,0\n"
                 : "set ylabel 'contact points' offset -0.7,0\n",
          out);
    fputs(
        "set format x '%g'\nset xlabel 'time [s]' offset 0,0.3\nset key center left Left reverse\n"
        "plot $step using 1:4 with lines linewidth 2 linecolor rgb '#2c7a57' title 'stick', $step "
        "using 1:5 with lines linewidth 2 linecolor rgb '#c4501b' dashtype (9,4) title 'slip', "
        "$step using 1:6 "
        "with lines linewidth 2 linecolor rgb '#9a9a9a' dashtype (3,3) title 'separated'\n"
        "unset multiplot\n",
        out);
}

rb_status rb_report_picture_wall(FILE *out, rb_report_canvas canvas, const rb_fem_wall *wall,
                                 int steps, const rb_fem_wall_step *step, rb_message *why)
{
    const rb_fem_mesh *mesh = rb_fem_wall_mesh(wall);
    wall_view v = {.f = {.mesh = mesh, .magnify = 1.0}, .steps = steps, .step = step};
    double *u = rb_alloc(3, (size_t)mesh->nodes), most = 0.0;
    rb_status s = RB_OK;
    if (steps < 1)
        s = rb_fail(why, RB_EINVAL, "nothing to draw");
    else if (!u || rb_fem_wall_displacements(wall, u) != RB_OK)
        s = rb_fail(why, RB_ENOMEM, "out of memory");
    if (s == RB_OK) {
        for (int a = 0; a < mesh->nodes; a++) {
            most = fmax(most, hypot(u[3 * a], u[3 * a + 2]));
            v.f.width = fmax(v.f.width, mesh->x[3 * a]);
            v.f.height = fmax(v.f.height, mesh->x[3 * a + 2]);
        }
        v.f.u = u;
        if (most > 0.0)
            v.f.magnify = rb_report_round_down(0.12 * v.f.height / most);
        s = rb_report_draw(out, canvas, RB_REPORT_PANELS, NULL, write_script, &v, why);
    }
    free(u);
    return s;
}
