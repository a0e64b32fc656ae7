#include "rolling/internal.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_spline.h>
#include <stdlib.h>
#include <string.h>

enum { OUTSIDE = 6 };             /* fitted: elements beyond each edge */
static const double GROWTH = 1.5; /* of one such element to the next */

void rb_rolling_mesh_free(rb_rolling_mesh *mesh)
{
    free(mesh->ends);
    free(mesh->gap);
    memset(mesh, 0, sizeof *mesh);
}

/* R - sqrt(R^2 - x^2) without cancellation (B9); 0 for a plane. */
static double circle_gap(double radius, double x)
{
    return x * x / (radius + sqrt(radius * radius - x * x));
}

static double initial_gap(const rb_rolling_case *rc, double x)
{
    switch (rc->gap) {
    case RB_GAP_TABLE:
        return rb_rolling_profile_gap(rc->profile, x);
    case RB_GAP_EXACT:
        return circle_gap(rc->a.radius, x) +
               (isfinite(rc->b.radius) ? circle_gap(rc->b.radius, x) : 0.0);
    case RB_GAP_PARABOLA:
        break;
    }
    return x * x / (2.0 * rb_rolling_radius(rc));
}

static rb_status mesh_alloc(int n, rb_rolling_mesh *mesh)
{
    memset(mesh, 0, sizeof *mesh);
    mesh->n = n;
    mesh->ends = rb_alloc((size_t)n + 2, 1);
    mesh->gap = rb_alloc((size_t)n, 1);
    if (mesh->ends && mesh->gap)
        return RB_OK;
    rb_rolling_mesh_free(mesh);
    return RB_ENOMEM;
}

static double midpoint(const rb_rolling_mesh *mesh, int i)
{
    return 0.5 * (mesh->ends[i] + mesh->ends[i + 1]);
}

/* A cubic spline: the pressure follows the curvature, which it keeps continuous. */
static rb_status add_irregularity(const rb_rolling_case *rc, rb_rolling_mesh *mesh)
{
    const size_t n = (size_t)rc->irregularity_n;
    const double *x = rc->irregularity_x;
    gsl_spline *spline = gsl_spline_alloc(gsl_interp_cspline, n);

    if (!spline)
        return RB_ENOMEM;
    gsl_spline_init(spline, x, rc->irregularity_gap, n);
    for (int i = 0; i < mesh->n; i++) {
        const double place = midpoint(mesh, i) + rc->passed;
        if (place > x[0] && place < x[n - 1])
            mesh->gap[i] += gsl_spline_eval(spline, place, NULL);
    }
    gsl_spline_free(spline);
    return RB_OK;
}

rb_status rb_rolling_mesh_set_gap(const rb_rolling_case *rc, rb_rolling_mesh *mesh)
{
    for (int i = 0; i < mesh->n; i++)
        mesh->gap[i] = initial_gap(rc, midpoint(mesh, i));
    return rc->irregularity_n > 0 ? add_irregularity(rc, mesh) : RB_OK;
}

/* The mesh must stay on the lower half of every round body. */
static rb_status check_extent(const rb_rolling_case *rc, double from, double to,
                              rb_message *why)
{
    const double radius = fmin(rc->a.radius, rc->b.radius);

    if (!(from < to))
        return rb_fail(why, RB_EINVAL, "potential contact from %g to %g is empty", from,
                       to);
    if (fmax(fabs(from), fabs(to)) >= radius)
        return rb_fail(why, RB_EINVAL,
                       "potential contact from %g to %g is wider than the radius %g",
                       from, to, radius);
    return RB_OK;
}

/* Equal elements of a boundary-element cylinder are equal arcs, of a half-plane equal
 * lengths; both are symmetric to rounding where from = -to. */
static void equal_ends(const rb_rolling_case *rc, double from, double to, int n,
                       double *ends)
{
    const double R = rc->a.support == RB_BEM_HALFPLANE ? INFINITY : rc->a.radius;
    const double s0 = isinf(R) ? from : R * asin(from / R);
    const double s1 = isinf(R) ? to : R * asin(to / R);

    for (int i = 0; i <= n + 1; i++) {
        const double s = (s0 * (n - i) + s1 * i) / n;
        ends[i] = isinf(R) ? s : R * sin(s / R);
    }
}

rb_status rb_rolling_mesh_uniform(const rb_rolling_case *rc, double from, double to,
                                  rb_rolling_mesh *mesh, rb_message *why)
{
    rb_status s = check_extent(rc, from, to, why);

    if (s == RB_OK)
        s = mesh_alloc(rc->contact_elements, mesh);
    if (s != RB_OK)
        return s;
    equal_ends(rc, from, to, mesh->n, mesh->ends);
    s = rb_rolling_mesh_set_gap(rc, mesh);
    if (s == RB_OK && mesh->ends[mesh->n + 1] > mesh->ends[mesh->n])
        return RB_OK;
    rb_rolling_mesh_free(mesh);
    if (s != RB_OK)
        return s;
    /* an arc beyond the quarter circle turns back */
    return rb_fail(why, RB_EINVAL,
                   "potential contact from %g to %g: no room for the element before it "
                   "within the radius %g; take more elements",
                   from, to, rc->a.radius);
}

/* ends[OUTSIDE .. OUTSIDE + n] at from ... to, symmetric to rounding. */
static void cosine_ends(double from, double to, int n, double *ends)
{
    const double centre = 0.5 * (from + to), half = 0.5 * (to - from);

    for (int i = 0; i <= n; i++)
        ends[i] = centre - half * sin(0.5 * M_PI * (n - 2 * i) / n);
    ends[0] = from;
    ends[n] = to;
}

rb_status rb_rolling_mesh_fitted(const rb_rolling_case *rc, double from, double to,
                                 rb_rolling_mesh *mesh, rb_message *why)
{
    const int across = rc->contact_elements;
    rb_status s = check_extent(rc, from, to, why);

    if (s == RB_OK)
        s = mesh_alloc(across + 2 * OUTSIDE, mesh);
    if (s != RB_OK)
        return s;
    double *edge = mesh->ends + OUTSIDE;
    cosine_ends(from, to, across, edge);
    double step = edge[1] - edge[0];
    for (int k = 1; k <= OUTSIDE; k++, step *= GROWTH)
        edge[-k] = edge[-k + 1] - step;
    step = edge[across] - edge[across - 1];
    for (int k = 1; k <= OUTSIDE + 1; k++, step *= GROWTH)
        edge[across + k] = edge[across + k - 1] + step;
    s = check_extent(rc, mesh->ends[0], mesh->ends[mesh->n + 1], why);
    if (s == RB_OK)
        s = rb_rolling_mesh_set_gap(rc, mesh);
    if (s != RB_OK)
        rb_rolling_mesh_free(mesh);
    return s;
}
