/* Meshes that several tests of the boundary elements share. */
#ifndef ROLLBEM_TESTS_BEM_SHAPES_H
#define ROLLBEM_TESTS_BEM_SHAPES_H

#include "check.h"
#include "bem/bem.h"

#include <gsl/gsl_math.h>

/* An elastic half-plane with its datum, for calls that take a surface. */
#define HALFPLANE(solid, depth) (&(rb_bem_surface){.material = (solid), .datum = (depth)})

/* Elements first ... first + n - 1 on a circle about (0, 0); turn: +1 counter-clockwise
 * (outer contour), -1 clockwise (hole).  The first end is at the angle `from`. */
static inline void put_circle(rb_bem_mesh *mesh, int first, int n, double radius, int turn,
                              double from)
{
    for (int k = 0; k < n; k++) {
        const double a = from + turn * 2.0 * M_PI * k / n,
                     b = from + turn * 2.0 * M_PI * ((k + 1) % n) / n;
        mesh->x0[first + k] = radius * cos(a);
        mesh->y0[first + k] = radius * sin(a);
        mesh->x1[first + k] = radius * cos(b);
        mesh->y1[first + k] = radius * sin(b);
    }
}

static inline rb_bem_mesh circle(int n, double radius)
{
    rb_bem_mesh mesh;
    assert_int_equal(rb_bem_mesh_alloc(n, &mesh), RB_OK);
    put_circle(&mesh, 0, n, radius, 1, 0.0);
    return mesh;
}

static inline rb_bem_mesh ring(int n, double outer, double inner)
{
    rb_bem_mesh mesh;
    assert_int_equal(rb_bem_mesh_alloc(2 * n, &mesh), RB_OK);
    put_circle(&mesh, 0, n, outer, 1, 0.0);
    put_circle(&mesh, n, n, inner, -1, 0.0);
    return mesh;
}

static inline double midpoint_x(const rb_bem_mesh *mesh, int j)
{
    return 0.5 * (mesh->x0[j] + mesh->x1[j]);
}

static inline double midpoint_y(const rb_bem_mesh *mesh, int j)
{
    return 0.5 * (mesh->y0[j] + mesh->y1[j]);
}

static inline void give(rb_bem_mesh *mesh, int j, rb_bem_condition what, double x, double y)
{
    mesh->condition[2 * j] = mesh->condition[2 * j + 1] = what;
    mesh->value[2 * j] = x;
    mesh->value[2 * j + 1] = y;
}

/* A disc whose elements are centred on the axes, held by its symmetry alone: ux = 0 at
 * the top and bottom elements, uy = 0 at the left and right ones; the other direction of
 * these elements carries its traction.  n: a multiple of 4. */
static inline rb_bem_mesh symmetric_disc(int n, double radius)
{
    rb_bem_mesh mesh;
    assert_int_equal(rb_bem_mesh_alloc(n, &mesh), RB_OK);
    put_circle(&mesh, 0, n, radius, 1, -M_PI / n);
    mesh.condition[2 * (n / 4)] = mesh.condition[2 * (3 * n / 4)] = RB_BEM_DISPLACEMENT;
    mesh.condition[1] = mesh.condition[2 * (n / 2) + 1] = RB_BEM_DISPLACEMENT;
    return mesh;
}

/* The same, of radius 1, under the pressure 1 on arcs of half-angle alpha about its top
 * and bottom, which end at element ends: alpha = (2k + 1) pi/n. */
static inline rb_bem_mesh pressed_disc(int n, double alpha)
{
    rb_bem_mesh mesh = symmetric_disc(n, 1.0);
    for (int j = 0; j < n; j++) {
        const double x = midpoint_x(&mesh, j), y = midpoint_y(&mesh, j), r = hypot(x, y);
        if (fabs(x / r) > sin(alpha))
            continue;
        if (mesh.condition[2 * j] == RB_BEM_TRACTION)
            mesh.value[2 * j] = -x / r;
        mesh.value[2 * j + 1] = -y / r;
    }
    return mesh;
}

/* log2 of the ratio of two errors on meshes one of which is twice as fine */
static inline double order(double coarse, double fine)
{
    return log2(coarse / fine);
}

/* What docs/library.md says of three meshes, each so many times as fine as the one before:
 * tests/formula/figures.py reads it. */
static inline void print_errors(const char *what, double coarse, double fine, double finest,
                                double finer)
{
    print_message("%s: %.3e, %.3e, %.3e, order %.3f, %.3f\n", what, coarse, fine, finest,
                  order(coarse, fine) / log2(finer), order(fine, finest) / log2(finer));
}

#endif
