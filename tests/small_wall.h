/* A wall with few nodes. */
#ifndef ROLLBEM_TESTS_SMALL_WALL_H
#define ROLLBEM_TESTS_SMALL_WALL_H

#include "fem/fem.h"

#include <string.h>

static inline rb_fem_wall_options small_wall(int rigid)
{
    rb_fem_wall_options o = rb_fem_wall_defaults();
    const int fine[3] = {4, 3, 3}, coarse[3] = {3, 2, 3};
    memcpy(o.fine, fine, sizeof fine);
    memcpy(o.coarse, coarse, sizeof coarse);
    o.rigid = rigid;
    return o;
}

#endif
