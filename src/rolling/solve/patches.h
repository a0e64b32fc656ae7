/* Patches of the contact and their edges. */
#ifndef ROLLBEM_ROLLING_SOLVE_PATCHES_H
#define ROLLBEM_ROLLING_SOLVE_PATCHES_H

#include "rolling/case/inputs.h"

#include <math.h>

/* A patch: neighbouring elements first ... last in contact, and its edges. */
typedef struct {
    int first, last;
    double from, to;
    int bounded; /* edges that are only known to lie within one element, as in rb_rolling_patch */
} rb_rolling_run;

/* 1: a third body is softer than the half-planes under such a length: then the pressure itself is
 * smooth up to the edge, otherwise its square is. */
static inline int rb_rolling_interlayer_is_soft(const rb_rolling_case *rc, double length)
{
    return rc->interlayer_normal * rb_rolling_derive(rc).modulus > 4.0 * length;
}

/* Of n tractions in their zones: 1 where A slides in element i, or sticks with all of its friction,
 * as in rows that repeat the one before, where rounding decides which.  Friction at its bound is
 * the same part of the pressure in one of its neighbours, too. */
static inline int rb_rolling_is_at_bound(int n, const int *zone, const double *p, const double *q,
                                         int i)
{
    int is_same = zone[i] > RB_ZONE_STICK;

    for (int j = i - 1; j <= i + 1; j += 2)
        is_same |= j >= 0 && j < n && zone[i] == RB_ZONE_STICK && zone[j] >= RB_ZONE_STICK &&
                   q[i] != 0.0 && fabs(q[j] * p[i] - q[i] * p[j]) <= 1e-9 * fabs(q[i] * p[j]);
    return is_same;
}

/* (E1) The power of the distance from the edge on that side (-1 left, +1 right) with which
 * the pressure starts there.  Where A slides with q = -+mu p up to the edge, it is
 * 1/2 + side atan(beta q/p)/pi; without friction, without coupling and in stick 1/2; on a
 * third body that is softer than the half-planes under an element of such a length 1.  j: an
 * element near the edge; a slip zone that does not hold its inner neighbour is too short. */
double rb_rolling_edge_exponent(const rb_rolling_case *rc, double length,
                                const rb_contact_state *state, int j, int side);

/* Smallest number of equal elements of a patch whose edges can be computed from the
 * pressure (theory-rolling.md 4.7). */
enum { RB_ROLLING_ALIGNED_LEAST = 9 };
/* And of any elements. */
enum { RB_ROLLING_PATCH_LEAST = 5 };

/* Vertex of the parabola through (0, 0) and two neighbours (d, f): its height and place.
 * 0: the parabola has no maximum. */
static inline int rb_rolling_vertex(const double d[2], const double f[2], double *rise, double *at)
{
    const double left = f[0] / d[0], right = f[1] / d[1];
    const double curvature = (right - left) / (d[1] - d[0]);
    const double slope = left - curvature * d[0];

    if (!(curvature < 0.0))
        return 0;
    *rise = -slope * slope / (4.0 * curvature);
    *at = -slope / (2.0 * curvature);
    return 1;
}
/* 1 + b t + c t^2. */
typedef struct {
    double b, c;
} rb_rolling_parabola;
static inline double rb_rolling_parabola_at(const rb_rolling_parabola *of, double t)
{
    return 1.0 + t * (of->b + of->c * t);
}
/* Through three points, the first one (0, 1); its root, 0 where there is none ahead. */
static inline double rb_rolling_set_parabola(const double t[3], const double y[3],
                                             rb_rolling_parabola *of)
{
    const double slope = (y[1] - y[0]) / t[1], next = (y[2] - y[1]) / (t[2] - t[1]);
    of->c = (next - slope) / t[2];
    of->b = slope - of->c * t[1];
    const double square = of->b * of->b - 4.0 * of->c;
    return of->b < 0.0 && square >= 0.0 ? 2.0 / (sqrt(square) - of->b) : 0.0;
}
/* aligned_edge.c: the edge beyond the outermost loaded element on that side (-1 left, +1 right) of
 * a patch of RB_ROLLING_ALIGNED_LEAST equal elements or more.  p: n. */
double rb_rolling_aligned_edge(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                               const double *p, int outer, int side);
/* stick_limit.c: tractions of elements at x; n each. */
typedef struct {
    int n, has_history; /* 1: what slipped in an earlier step may stick now */
    const int *zone;
    const double *x, *p, *q;
} rb_rolling_tractions;
/* Of a stick zone this many elements at either limit are disturbed, and so many it has at least
 * where its limits are known. */
enum { RB_ROLLING_DISTURBED = 2, RB_ROLLING_LIMIT_LEAST = 7 };
/* The largest pressure of a stick zone between its fourth element from a limit and the limit
 * itself, and where it is. */
typedef struct {
    double pressure, at;
} rb_rolling_stick_limit;
/* (E4) Of the limit towards `side` (-1 left, +1 right) of element `last`, beyond which A slips.
 * Returns 0 where it tells nothing: last is not such an element, the stick zone is shorter than
 * seven elements, friction does not feed back on the pressure there, or the friction that is left
 * ends too far from where the mesh has the limit. */
int rb_rolling_stick_limit_of(const rb_rolling_case *rc, const rb_rolling_tractions *of, int last,
                              int side, rb_rolling_stick_limit *limit);
/* Finds the next patch from element `at` on; returns 0 if there is none. */
int rb_rolling_next_patch(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                          const rb_contact_state *state, int at, rb_rolling_run *run);
/* The same, but patches are merged if more elements between them would not help: all
 * patches under a convex gap (single open elements next to an edge are ignored), and
 * patches that are separated by one open element if large friction between dissimilar
 * bodies opens every other element. */
int rb_rolling_next_merged_patch(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                 const rb_contact_state *state, int at, rb_rolling_run *run);
/* Computes the patches of a solution and the results that depend on all of them.
 * RB_ENOMEM. */
rb_status rb_rolling_set_patches(const rb_rolling_model *model, rb_rolling_solution *solution);

/* Length of the longest element in contact. */
double rb_rolling_longest_element(int n, const int *zone, const double *h);

#endif
