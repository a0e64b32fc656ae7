/* The edge of a contact on equal elements that are aligned with it: known more exactly than where a
 * power law between two elements ends (theory-rolling.md 4.7). */
#include "rolling/body/mesh.h"
#include "rolling/case/derived.h"
#include "rolling/solve/patches.h"

#include <math.h>

/* How far the root of the parabola below lies inside of an edge where the pressure starts
 * like a square root, in elements: measured on 50 to 800 elements. */
static const double BIAS = 0.0076;

/* The root of the parabola y through the third, fourth and fifth element from the
 * edge, in elements beyond the third.  An edge lies between the midpoints of the last
 * loaded and the first open element. */
static double root_beyond(double y0, double y1, double y2)
{
    const double b = 0.5 * (3.0 * y0 - 4.0 * y1 + y2), c = 0.5 * (y0 - 2.0 * y1 + y2);
    const double square = b * b - 4.0 * c * y0;
    const double root = square >= 0.0 ? 2.0 * y0 / (sqrt(square) - b) : 2.5;

    return fmin(fmax(root > 0.0 ? root : 2.5, 2.0), 3.0);
}

double rb_rolling_aligned_edge(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                               const double *p, int outer, int side)
{
    const int third = outer - 2 * side;
    const double *end = mesh->ends + third, h = end[1] - end[0];
    const double y[3] = {p[third], p[third - side], p[third - 2 * side]};
    const double root = rb_rolling_interlayer_is_soft(rc, h)
                            ? root_beyond(y[0], y[1], y[2])
                            : root_beyond(y[0] * y[0], y[1] * y[1], y[2] * y[2]) + BIAS;

    const double x = 0.5 * (end[0] + end[1]) + side * h * root;
    const int open = outer + side;
    if (open < 0 || open >= mesh->n)
        return x;
    const double farthest = 0.5 * (mesh->ends[open] + mesh->ends[open + 1]);
    return side > 0 ? fmin(x, farthest) : fmax(x, farthest);
}
