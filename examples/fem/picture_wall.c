/* The wall's picture: its deformed front on the left, forces and contacts over time on
 * the right. */
#include "program/report/internal.h"
#include "fem/pictures.h"

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

typedef struct {
    front f;
    int steps;
    const rb_fem_wall_step *step;
} wall_view;

/* The faces of the front, and the edges of the blocks. */
static void write_front(FILE *out, const front *f)
{
    int corner[4];
    fputs("$mesh << EOD\nx z\n", out);
    for (int e = 0; e < f->mesh->elements; e++)
        if (front_face(f, e, corner)) {
            for (int k = 0; k < 5; k++)
                write_node(out, f, corner[k % 4]);
            fputs("\n", out);
        }
    fputs("EOD\n$edge << EOD\nx z\n", out);
    for (int e = 0; e < f->mesh->elements; e++)
        for (int k = 0; k < 4 && front_face(f, e, corner); k++)
            if (!is_inner(f, corner[k], corner[(k + 1) % 4])) {
                write_node(out, f, corner[k]);
                write_node(out, f, corner[(k + 1) % 4]);
                fputs("\n", out);
            }
    fputs("EOD\n", out);
}

static void write_inputs(FILE *out, rb_report_canvas canvas, const void *view)
{
    const wall_view *v = view;
    const rb_fem_wall_step *last = &v->step[v->steps - 1];

    (void)canvas;
    write_front(out, &v->f);
    fputs("$table << EOD\ntime\tcompression\tshear\tstick\tslip\tseparated\n", out);
    for (int k = 0; k < v->steps; k++)
        fprintf(out, "%g\t%.6g\t%.6g\t%d\t%d\t%d\n", v->step[k].time, 1e-3 * v->step[k].compression,
                1e-3 * v->step[k].shear, v->step[k].stick, v->step[k].slip, v->step[k].separated);
    fputs("EOD\n", out);
    rb_report_let(out, "width", v->f.width);
    rb_report_let(out, "height", v->f.height);
    rb_report_let(out, "compression", 1e-3 * last->compression);
    rb_report_let(out, "drift", 1e3 * last->drift);
    rb_report_let_text(out, "magnify", "%s", RB_REPORT_NUMBER(v->f.magnify, 5));
    rb_report_let(out, "points_step",
                  rb_report_round_step((last->stick + last->slip + last->separated) / 4.0));
}

rb_status rb_fem_picture_wall(FILE *out, rb_report_canvas canvas, const rb_fem_wall *wall,
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
        s = rb_report_draw(out, canvas, RB_REPORT_PANELS, "wall", write_inputs, &v, why);
    }
    free(u);
    return s;
}
