/* Where elements may lie, the gap at them, and the corners of tables. */
#ifndef ROLLBEM_ROLLING_BODY_MESH_H
#define ROLLBEM_ROLLING_BODY_MESH_H

#include "rolling/body/gap.h"

/* ---- profile.c ------------------------------------------------------------------ */

/* Number and abscissae of the points of the spline; borrowed. */
int rb_rolling_profile_rows(const rb_rolling_profile *profile, const double **x);
/* Checks for three or more finite points with increasing x: RB_EINVAL "<what>: row
 * ...". */
rb_status rb_rolling_points_check(const char *what, int n, const double *x, const double *gap,
                                  rb_message *why);

/* ---- mesh.c --------------------------------------------------------------------- */

static inline double rb_rolling_midpoint(const rb_rolling_mesh *mesh, int i)
{
    return 0.5 * (mesh->ends[i] + mesh->ends[i + 1]);
}

/* Computes the gaps at the midpoints with the irregularity at its present place.
 * RB_ENOMEM. */
rb_status rb_rolling_mesh_set_gap(const rb_rolling_case *rc, rb_rolling_mesh *mesh);

/* The worn depth at x. */
double rb_rolling_worn_depth(const rb_rolling_case *rc, double x);
/* The undeformed gap at n places, with the irregularity moved by `passed`.  RB_ENOMEM. */
rb_status rb_rolling_gap_along(const rb_rolling_case *rc, double passed, int n, const double *x,
                               double *gap);
/* 0: the bodies may touch in several places. */
int rb_rolling_is_convex(const rb_rolling_case *rc);
/* The interval in which elements may lie: on the lower half of every round body, within
 * the table and one period. */
void rb_rolling_extent(const rb_rolling_case *rc, double *from, double *to);

/* Half-width of the lower half of every round body.  Half-planes under a table are flat. */
double rb_rolling_lower_half(const rb_rolling_case *rc);
/* RB_EINVAL: elements from `from` to `to` do not stay on the lower half of every round body. */
rb_status rb_rolling_check_extent(const rb_rolling_case *rc, double from, double to,
                                  rb_message *why);
/* Zeros for n elements.  RB_ENOMEM. */
rb_status rb_rolling_mesh_alloc(int n, rb_rolling_mesh *mesh);

/* ---- corners.c ------------------------------------------------------------------ */

/* How much the largest pressure rises where elements get so many times shorter, because
 * the slope of the worn table, or of the gap's, turns by s at a corner between `from` and
 * `to`: there the pressure is infinite, p = -E* s ln|x| / (2 pi) + ..., up to the next one. */
double rb_rolling_rise_at_corners(const rb_rolling_case *rc, double from, double to, double element,
                                  double times);
/* The same in the patches of a solution, in mm, N, MPa, but for corners so near an edge that the
 * surface is pressed on one side of them only. */
double rb_rolling_rise_in_patches(const rb_rolling_case *rc, const rb_rolling_solution *s,
                                  double times);
/* 1: a punch presses with an end of its table, a square corner, where the pressure is infinite
 * like 1/sqrt(distance) or another power: that of the last element says nothing of it. */
int rb_rolling_presses_with_end(const rb_rolling_case *rc, const rb_rolling_solution *s);

/* ---- mesh_graded.c -------------------------------------------------------------- */

/* A patch for fitted elements, and how far the elements must extend beyond its edges. */
typedef struct {
    double from, to, margin_left, margin_right;
    double h_left, h_right; /* lengths of the elements from which the edges were computed; fit.c */
} rb_rolling_span;

/* The elements of a punch, whose pressure may be infinite at its ends. */
rb_status rb_rolling_mesh_punch(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                rb_rolling_mesh *mesh, rb_message *why);
rb_status rb_rolling_mesh_spans(const rb_rolling_case *rc, int all, int count,
                                const rb_rolling_span *span, rb_rolling_mesh *mesh,
                                rb_message *why);

#endif
