/* Arnoldi's process by Gram and Schmidt, one vector after the other; Givens' rotations turn
 * Hessenberg's matrix into a triangle as it grows, so that each step says what is left. */
#include "base/gmres.h"

#include <cblas.h>
#include <math.h>
#include <string.h>

/* Column j of the rotated Hessenberg matrix, j + 2 entries. */
static double *column_of(const rb_gmres *g, int j)
{
    return g->small + (size_t)j * (size_t)(g->most + 1);
}

/* Cosine and sine of rotation j, and then the rotated right-hand side, most + 1. */
static double *rotations_of(const rb_gmres *g)
{
    return column_of(g, g->most);
}

static double *right_side_of(const rb_gmres *g)
{
    return rotations_of(g) + 2 * (size_t)g->most;
}

double rb_gmres_begin(rb_gmres *g)
{
    const double length = cblas_dnrm2(g->n, g->v[0], 1);

    g->used = 0;
    if (length > 0.0)
        cblas_dscal(g->n, 1.0 / length, g->v[0], 1);
    right_side_of(g)[0] = length;
    return length;
}

double rb_gmres_step(rb_gmres *g)
{
    const int j = g->used++;
    double *next = g->v[j + 1], *column = column_of(g, j), *rotation = rotations_of(g),
           *right = right_side_of(g);

    for (int i = 0; i <= j; i++) {
        column[i] = cblas_ddot(g->n, next, 1, g->v[i], 1);
        cblas_daxpy(g->n, -column[i], g->v[i], 1, next, 1);
    }
    const double below = cblas_dnrm2(g->n, next, 1);
    if (below > 0.0)
        cblas_dscal(g->n, 1.0 / below, next, 1);
    for (int i = 0; i < j; i++) {
        const double c = rotation[2 * i], s = rotation[2 * i + 1], a = column[i], b = column[i + 1];
        column[i] = c * a + s * b;
        column[i + 1] = -s * a + c * b;
    }
    const double length = hypot(column[j], below), c = column[j] / length, s = below / length;
    rotation[2 * j] = c;
    rotation[2 * j + 1] = s;
    column[j] = length;
    right[j + 1] = -s * right[j];
    right[j] *= c;
    return below > 0.0 ? fabs(right[j + 1]) : 0.0;
}

void rb_gmres_combine(rb_gmres *g, double *x)
{
    double *y = right_side_of(g);

    for (int i = g->used - 1; i >= 0; i--) {
        for (int j = i + 1; j < g->used; j++)
            y[i] -= column_of(g, j)[i] * y[j];
        y[i] /= column_of(g, i)[i];
    }
    memset(x, 0, (size_t)g->n * sizeof *x);
    for (int i = 0; i < g->used; i++)
        cblas_daxpy(g->n, y[i], g->v[i], 1, x, 1);
}
