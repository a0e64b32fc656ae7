/* Stress inside a loaded body (B8, B10): strips under the contact tractions, linear
 * between nodes, in closed form, and Somigliana's identity for the smooth
 * remainder. */
#include "bem/bond.h"
#include "bem/interior.h"
#include "bem/internal.h"
#include "bem/strip.h"
#include "bem/system.h"

#include <math.h>
#include <stdlib.h>

/* A part of a contact element; the traction in its middle and its change per length. */
typedef struct {
    rb_strip strip;
    double complex traction, slope;
    int contact; /* the contact element */
} piece;

struct rb_bem_field {
    int pieces;
    piece *piece;      /* owned */
    double *u, *t;     /* 2n: boundary values of the rest; owned, t behind u */
    rb_interior *rest; /* owned */
};

void rb_bem_field_free(rb_bem_field *field)
{
    if (!field)
        return;
    rb_interior_free(field->rest);
    free(field->piece);
    free(field->u);
    free(field);
}

/* The part from `from` to `to`, measured from its start, of contact element c, between the
 * tractions at both, along the element and into the body: linear in its own frame, if the
 * vector went on around a corner, the friction would jump by the pressure times the angle
 * between the elements, and the stress would be infinite there, which on the circle it is
 * not. */
static piece part_of_element(const rb_bem_system *system, int c, double from, double to,
                             double complex f_from, double complex f_to, double unit)
{
    const rb_bem_mesh *mesh = &system->mesh;
    const int j = mesh->contact_first + c;
    const double h = rb_bem_mesh_length(mesh, j);
    const double complex start = mesh->x0[j] + mesh->y0[j] * I, end = mesh->x1[j] + mesh->y1[j] * I;
    const rb_strip strip =
        rb_strip_between(from > 0.0 ? start + from / h * (end - start) : start,
                         to < h ? start + to / h * (end - start) : end, system->material, unit);
    return (piece){strip, strip.along * 0.5 * (f_from + f_to),
                   strip.along * (f_to - f_from) / strip.h, c};
}

/* The load between its nodes, cut at the ends of the contact elements.  Returns the number
 * of parts; part: NULL, or room for them. */
static int cut(const rb_bem_system *system, const rb_bem_edge_load *load, double unit, piece *part)
{
    const rb_bem_mesh *mesh = &system->mesh;
    double start = 0.0, h = rb_bem_mesh_length(mesh, mesh->contact_first); /* of element c */
    int parts = 0;

    for (int k = 0, c = 0; k + 1 < load->n; k++) {
        const double length = load->x[k + 1] - load->x[k];
        double from = fmax(load->x[k], start);
        while (c < mesh->contact_n && from < load->x[k + 1]) {
            const double end = start + h, to = fmin(load->x[k + 1], end);
            /* what is shorter is the rounding of the sum of lengths */
            if (to - from > 1e-14 * end) {
                double complex f[2];
                for (int i = 0; part && i < 2; i++) {
                    const double w = ((i ? to : from) - load->x[k]) / length;
                    f[i] = (1.0 - w) * (load->q[k] + load->p[k] * I) +
                           w * (load->q[k + 1] + load->p[k + 1] * I);
                }
                if (part)
                    part[parts] = part_of_element(system, c, from - start,
                                                  to < end ? to - start : h, f[0], f[1], unit);
                parts++;
            }
            from = fmax(from, to);
            if (from >= end && ++c < mesh->contact_n) {
                start = end;
                h = rb_bem_mesh_length(mesh, mesh->contact_first + c);
            }
        }
    }
    return parts;
}

/* Of all strips but the parts of contact element `without`; -1: of all. */
static void add_strips(const rb_bem_field *f, double complex z, int without, double stress[3])
{
    for (int k = 0; k < f->pieces; k++) {
        const piece *p = &f->piece[k];
        double own[3];
        if (p->contact == without || (p->traction == 0.0 && p->slope == 0.0))
            continue;
        rb_strip_linear_stress(&p->strip, z, p->traction, p->slope, own);
        for (int i = 0; i < 3; i++)
            stress[i] += own[i];
    }
}

/* Displacement of the strips; far away, where it is asked for, their mean is enough. */
static double complex strips_field(rb_bem_material material, double complex z, const void *context)
{
    const rb_bem_field *f = context;
    double complex u = 0.0;
    for (int k = 0; k < f->pieces; k++) {
        const rb_strip strip = rb_strip_in(f->piece[k].strip, material);
        u += rb_strip_under(rb_strip_displacement(&strip, z), f->piece[k].traction);
    }
    return u;
}

rb_status rb_bem_field_create(const rb_bem_system *system, const rb_bem_edge_load *load,
                              rb_bem_field **field, rb_message *why)
{
    const size_t dofs = (size_t)system->dofs;
    const double unit = rb_bem_mesh_size(&system->mesh);
    *field = NULL;
    rb_status s = rb_bem_check_convex(system, why);
    if (s != RB_OK)
        return s;
    rb_bem_field *f = calloc(1, sizeof *f);
    double *value = rb_alloc(dofs, 1);
    s = RB_ENOMEM;
    if (f && value) {
        f->pieces = cut(system, load, unit, NULL);
        f->piece = calloc((size_t)f->pieces + 1, sizeof *f->piece);
        f->u = rb_alloc(dofs, 2);
    }
    if (f && value && f->piece && f->u) {
        f->t = f->u + dofs;
        const rb_bem_mesh *mesh = &system->mesh;
        cut(system, load, unit, f->piece);
        /* What the strips leave of the given values.  A contact element's own strips give
         * its traction exactly: computed at its midpoint, where their ends meet, they would
         * give it but for the rounding of coordinates over a part in 1e9 of a short element. */
        for (int j = 0; j < mesh->n; j++) {
            const double complex z = rb_strip_midpoint(mesh, j), n = rb_strip_outward(mesh, j);
            const int contact =
                mesh->condition[2 * j] == RB_BEM_CONTACT ? j - mesh->contact_first : -1;
            double sum[3] = {0.0, 0.0, 0.0};
            add_strips(f, z, contact, sum);
            const double t[2] = {sum[0] * creal(n) + sum[2] * cimag(n),
                                 sum[2] * creal(n) + sum[1] * cimag(n)};
            const double complex u = strips_field(system->material, z, f);
            for (int d = 0; d < 2; d++) {
                const int held = mesh->condition[2 * j + d] != RB_BEM_TRACTION;
                value[2 * j + d] = contact >= 0 ? -t[d]
                                   : held       ? mesh->value[2 * j + d] - (d ? cimag(u) : creal(u))
                                                : mesh->value[2 * j + d] - t[d];
            }
        }
        s = system->bond ? rb_bond_left_over(system->bond, &system->mesh, system->material,
                                             strips_field, f, value + 2 * system->bond->first)
                         : RB_OK;
        if (s == RB_OK)
            s = rb_bem_system_solve_values(system, value, f->u, f->t);
        if (s == RB_OK)
            s = rb_interior_create(&(rb_bem_boundary){&system->mesh, system->material, f->u, f->t},
                                   &f->rest);
    }
    free(value);
    if (s == RB_OK)
        *field = f;
    else
        rb_bem_field_free(f);
    return s;
}

rb_status rb_bem_field_stress(const rb_bem_field *field, rb_bem_points points, double *stress,
                              rb_message *why)
{
    rb_status s = rb_interior_at(field->rest, 1, points, NULL, stress, why);

    for (int k = 0; k < points.n && s == RB_OK; k++) {
        if (rb_interrupted())
            s = RB_INTERRUPTED;
        add_strips(field, points.xy[2 * k] + points.xy[2 * k + 1] * I, -1, stress + 3 * k);
    }
    return s;
}
