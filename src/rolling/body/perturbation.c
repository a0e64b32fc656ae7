/* Bodies that are slightly others than those of a model, under the model's tractions: how much more
 * they displace, without flexibilities of their own where they have boundary elements
 * (theory-bodies.md, B13).  A body that stays costs nothing. */
#include "bem/bem.h"
#include "rolling/body/internal.h"
#include "rolling/body/perturbation.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct rb_rolling_perturbation {
    const rb_rolling_model *of; /* borrowed */
    struct {
        rb_bem_loaded *loaded; /* of a body with boundary elements; NULL: not made yet; owned */
        double *w;             /* 2m: displacements of another one; NULL: not made yet; owned */
    } body[2];
};

rb_rolling_perturbation *rb_rolling_perturbation_create(const rb_rolling_model *of)
{
    rb_rolling_perturbation *perturbation = calloc(1, sizeof *perturbation);

    if (perturbation)
        perturbation->of = of;
    return perturbation;
}

void rb_rolling_perturbation_free(rb_rolling_perturbation *perturbation)
{
    for (int k = 0; perturbation && k < 2; k++) {
        rb_bem_loaded_free(perturbation->body[k].loaded);
        free(perturbation->body[k].w);
    }
    free(perturbation);
}

/* 1: element j climbs, -1: it falls, 0: it is level but for rounding. */
static int climbs(const rb_bem_mesh *m, int j)
{
    const double rise = m->y1[j] - m->y0[j];
    return fabs(rise) < 1e-9 * rb_bem_mesh_length(m, j) ? 0 : rise > 0.0 ? 1 : -1;
}

/* All sides as well as all elements: those of a side climb on the upper half, those of the
 * next one fall; and those that are held. */
static int have_same_sides(const rb_bem_mesh *a, const rb_bem_mesh *b)
{
    double top = 0.0;

    if (a->n != b->n)
        return 0;
    for (int j = 0; j < a->n; j++)
        top = fmax(top, a->y0[j]);
    for (int j = 0; j < a->n; j++)
        if (a->condition[2 * j] != b->condition[2 * j] ||
            (a->y0[j] + a->y1[j] > top && climbs(a, j) != climbs(b, j)))
            return 0;
    return 1;
}

int rb_rolling_same_sides(const rb_rolling_model *x, const rb_rolling_model *y)
{
    const rb_bem_system *const a[] = {x->bodies.system_a, x->bodies.system_b},
                               *const b[] = {y->bodies.system_a, y->bodies.system_b};

    for (int k = 0; k < 2; k++)
        if (a[k] && !have_same_sides(rb_bem_system_mesh(a[k]), rb_bem_system_mesh(b[k])))
            return 0;
    return 1;
}

/* The body of v less that of the model, both under r: 2m; and, x not NULL, the elements of v, m
 * each. */
static rb_status change_of_body(rb_rolling_perturbation *perturbation, const rb_rolling_model *v,
                                int k, const double *r, double *change, double *x, double *h,
                                rb_message *why)
{
    const rb_rolling_model *of = perturbation->of;
    const rb_rolling_body *body = k ? &of->rc->b : &of->rc->a;
    const rb_bem_system *system = k ? of->bodies.system_b : of->bodies.system_a;
    const int m = of->mesh.n + 1;
    rb_bem_loaded **loaded = &perturbation->body[k].loaded;
    double **w = &perturbation->body[k].w;
    rb_bem_mesh boundary = {0};
    rb_status s = RB_OK;

    if (!system || rb_rolling_has_elastic_core(body)) {
        if (!*w) {
            if (!(*w = rb_alloc((size_t)m, 2)))
                return RB_ENOMEM;
            s = rb_rolling_body_displacement(of, k, r, *w, NULL, NULL, why);
        }
        if (s == RB_OK)
            s = rb_rolling_body_displacement(v, k, r, change, x, h, why);
        if (s == RB_OK)
            cblas_daxpy(2 * m, -1.0, *w, 1, change, 1);
        return s;
    }
    if (!*loaded)
        s = rb_bem_loaded_create(system, of->rc->normals,
                                 rb_rolling_subtracts(of->rc, &of->plan, body), r, loaded, why);
    if (s == RB_OK)
        s = rb_rolling_boundary_mesh(v, k, &boundary, why);
    if (s == RB_OK && !have_same_sides(rb_bem_system_mesh(system), &boundary))
        s = rb_fail(why, RB_INACCURATE, "the elements outside the contact change with the input%s",
                    rb_bem_system_mesh(system)->n == boundary.n ? "" : "; give --outer-elements");
    if (s == RB_OK)
        s = rb_bem_loaded_change(*loaded, &boundary,
                                 rb_rolling_material(v->rc, k ? &v->rc->b : &v->rc->a), change);
    for (int i = 0; s == RB_OK && i < m && x; i++) {
        const int j = boundary.contact_first + i;
        x[i] = 0.5 * (boundary.x0[j] + boundary.x1[j]);
        h[i] = rb_bem_mesh_length(&boundary, j);
    }
    rb_bem_mesh_free(&boundary);
    return s;
}

rb_status rb_rolling_perturbation_add(rb_rolling_perturbation *perturbation,
                                      const rb_rolling_model *v, double *w, double *x, double *h,
                                      rb_message *why)
{
    const rb_rolling_model *of = perturbation->of;
    const int n = of->mesh.n, m = n + 1,
              moves = memcmp(of->mesh.ends, v->mesh.ends, ((size_t)n + 2) * sizeof *x) != 0;
    rb_arena scratch = {0};
    double *r = rb_arena_doubles(&scratch, (size_t)n, 2),
           *change = rb_arena_doubles(&scratch, (size_t)m, 2);
    rb_status s = scratch.failed ? RB_ENOMEM : RB_OK;

    for (int k = 0; k <= of->rc->elastic_b && s == RB_OK; k++) {
        const double mirror = k ? -1.0 : 1.0; /* B's own frame */
        const rb_rolling_body *is = k ? &v->rc->b : &v->rc->a, *was = k ? &of->rc->b : &of->rc->a;
        /* of zero displacement below a flat body: of the radius of A, too */
        const double depth[] = {rb_rolling_datum(v->rc, is), rb_rolling_datum(of->rc, was)};
        if (!moves && rb_rolling_same_body(is, was) &&
            memcmp(&depth[0], &depth[1], sizeof *depth) == 0 &&
            (is->memory.n == 0 || v->rc->speed == of->rc->speed))
            continue;
        for (int i = 0; i < n; i++) {
            r[i] = of->state.p[i];
            r[n + i] = mirror * of->state.q[i];
        }
        s = change_of_body(perturbation, v, k, r, change, k ? NULL : x, k ? NULL : h, why);
        cblas_daxpy(m, 1.0, change, 1, w, 1);
        cblas_daxpy(m, mirror, change + m, 1, w + m, 1);
    }
    return rb_arena_done(&scratch, s);
}
