#include "bem/incompressible.h"
#include "bem/internal.h"

#include <math.h>
#include <stdlib.h>

int rb_is_incompressible(rb_bem_material material)
{
    return 1.0 - 2.0 * material.poisson <= 1e-9;
}

void rb_held_contours_free(rb_held_contours *held)
{
    free(held->contour);
    free(held->normal);
    *held = (rb_held_contours){0};
}

static int is_held(const rb_bem_mesh *mesh, int j)
{
    return mesh->condition[2 * j] == RB_BEM_DISPLACEMENT &&
           mesh->condition[2 * j + 1] == RB_BEM_DISPLACEMENT;
}

/* Elements first ... last - 1 are a whole contour. */
static void add_contour(const rb_bem_mesh *mesh, int first, int last,
                        rb_held_contours *held)
{
    for (int j = first; j < last; j++) {
        const double dx = mesh->x1[j] - mesh->x0[j], dy = mesh->y1[j] - mesh->y0[j],
                     scale = 1.0 / (hypot(dx, dy) * sqrt(last - first));
        held->contour[j] = held->count;
        held->normal[2 * j] = dy * scale;
        held->normal[2 * j + 1] = -dx * scale;
    }
    held->count++;
}

static void add_contours(const rb_bem_mesh *mesh, const int *next, rb_held_contours *held)
{
    int first = 0, all = 1;
    for (int j = 0; j < mesh->n; j++) {
        held->contour[j] = -1;
        all = all && is_held(mesh, j);
        if (next[j] == j + 1)
            continue;
        if (all)
            add_contour(mesh, first, j + 1, held);
        first = j + 1;
        all = 1;
    }
}

rb_status rb_held_contours_find(const rb_bem_mesh *mesh, rb_bem_material material,
                                rb_held_contours *held)
{
    const size_t n = (size_t)mesh->n;

    *held = (rb_held_contours){0};
    if (!rb_is_incompressible(material))
        return RB_OK;
    int *next = rb_alloc_int(n);
    held->contour = rb_alloc_int(n);
    held->normal = rb_alloc(n, 2);
    const rb_status s = next && held->contour && held->normal ? RB_OK : RB_ENOMEM;
    if (s == RB_OK) {
        rb_bem_mesh_next(mesh, next);
        add_contours(mesh, next, held);
    }
    if (s != RB_OK || held->count == 0)
        rb_held_contours_free(held);
    free(next);
    return s;
}
