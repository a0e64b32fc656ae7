/* Which rigid motions do the given displacements leave free? (B6) */
#include "bem/internal.h"

#include <math.h>

/* The lines along which one direction is held: all at one place, or not. */
typedef struct {
    int any, spread;
    double at;
} held_direction;

static void hold(held_direction *d, double at, double tolerance)
{
    if (d->any && fabs(at - d->at) > tolerance)
        d->spread = 1;
    if (!d->any)
        d->at = at;
    d->any = 1;
}

/* A body held in x at two heights cannot turn, nor one held in y at two abscissae; held
 * in x at one height and in y at one abscissa it turns about the point where they meet. */
rb_status rb_bem_support_check(const rb_bem_mesh *mesh, rb_message *why)
{
    const double tolerance = 1e-9 * rb_bem_mesh_size(mesh);
    held_direction x = {0}, y = {0};
    for (int j = 0; j < mesh->n; j++) {
        if (mesh->condition[2 * j] == RB_BEM_DISPLACEMENT)
            hold(&x, 0.5 * (mesh->y0[j] + mesh->y1[j]), tolerance);
        if (mesh->condition[2 * j + 1] == RB_BEM_DISPLACEMENT)
            hold(&y, 0.5 * (mesh->x0[j] + mesh->x1[j]), tolerance);
    }
    const int turns = !x.spread && !y.spread;
    if (x.any && y.any && !turns)
        return RB_OK;
    return rb_fail(why, RB_EINVAL, "no support: the body is free in%s%s%s; prescribe displacements",
                   x.any ? "" : " translation along x",
                   y.any   ? ""
                   : x.any ? " translation along y"
                           : ", translation along y",
                   !turns           ? ""
                   : x.any && y.any ? " rotation"
                                    : ", rotation");
}
