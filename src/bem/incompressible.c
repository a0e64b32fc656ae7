#include "bem/incompressible.h"
#include "bem/internal.h"

#include <math.h>
#include <stdlib.h>

int rb_bem_is_incompressible(rb_bem_material material)
{
    return 1.0 - 2.0 * material.poisson <= 1e-9;
}

void rb_held_contours_free(rb_held_contours *held)
{
    free(held->contour);
    free(held->normal);
    *held = (rb_held_contours){0};
}

rb_status rb_held_contours_find(const rb_bem_mesh *mesh, rb_bem_material material,
                                rb_held_contours *held)
{
    const size_t n = (size_t)mesh->n;

    *held = (rb_held_contours){0};
    if (!rb_bem_is_incompressible(material))
        return RB_OK;
    int *next = rb_alloc_int(n);
    held->contour = rb_alloc_int(n);
    held->normal = rb_alloc(n, 2);
    const rb_status s = next && held->contour && held->normal ? RB_OK : RB_ENOMEM;
    if (s == RB_OK)
        rb_bem_mesh_next(mesh, next);
    for (int j = 0, first = 0, all = 1; s == RB_OK && j < mesh->n; j++) {
        held->contour[j] = -1;
        all = all && mesh->condition[2 * j] == RB_BEM_DISPLACEMENT &&
              mesh->condition[2 * j + 1] == RB_BEM_DISPLACEMENT;
        if (next[j] == j + 1)
            continue;
        /* Elements first ... j are a whole contour. */
        for (int i = first; all && i <= j; i++) {
            const double dx = mesh->x1[i] - mesh->x0[i], dy = mesh->y1[i] - mesh->y0[i],
                         scale = 1.0 / (hypot(dx, dy) * sqrt(j + 1 - first));
            held->contour[i] = held->count;
            held->normal[2 * i] = dy * scale;
            held->normal[2 * i + 1] = -dx * scale;
        }
        held->count += all;
        first = j + 1;
        all = 1;
    }
    if (s != RB_OK || held->count == 0)
        rb_held_contours_free(held);
    free(next);
    return s;
}
