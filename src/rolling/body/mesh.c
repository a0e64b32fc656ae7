/* The mesh of the potential contact: ends and midpoints of its elements, and the gap of the
 * undeformed bodies there. */
#include "rolling/body/body.h"
#include "rolling/body/interpolant.h"
#include "rolling/body/mesh.h"
#include "rolling/case/internal.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_interp.h>
#include <stdlib.h>
#include <string.h>

void rb_rolling_mesh_free(rb_rolling_mesh *mesh)
{
    free(mesh->ends);
    free(mesh->gap);
    memset(mesh, 0, sizeof *mesh);
}

double rb_rolling_worn_depth(const rb_rolling_case *rc, double x)
{
    const int n = rc->worn.n;
    const double *row = rc->worn.x;

    if (n == 0 || x < row[0] || x > row[n - 1])
        return 0.0;
    const int i = (int)gsl_interp_bsearch(row, x, 0, (size_t)n - 1);
    const double t = i + 1 < n ? (x - row[i]) / (row[i + 1] - row[i]) : 0.0;
    return t > 0.0 ? (1.0 - t) * rc->worn.y[i] + t * rc->worn.y[i + 1] : rc->worn.y[i];
}

/* g_0 of (K1) without a tilt: table, wave, x^2/(2R), or circles without cancellation (B9). */
static double upright_gap(const rb_rolling_case *rc, double x)
{
    const double worn = rb_rolling_worn_depth(rc, x), R = rc->a.radius, bore = -rc->b.radius;

    if (rc->gap == RB_GAP_TABLE)
        return rb_rolling_profile_gap(rc->profile, x) + worn;
    if (rc->gap == RB_GAP_WAVE)
        return 2.0 * rc->amplitude * gsl_pow_2(sin(M_PI * x / rc->period)) + worn;
    if (rc->gap == RB_GAP_PARABOLA)
        return x * x / (2.0 * rb_rolling_radius(rc)) + worn;
    if (!(bore > 0.0))
        return rb_bem_circle_height(R, x) +
               (isfinite(bore) ? rb_bem_circle_height(rc->b.radius, x) : 0.0) + worn;
    /* The difference of the heights x^2/(R + sqrt(R^2 - x^2)) of two circles, formed from
     * that of their radii: a journal may be smaller than its bore by a part in a
     * million. */
    const double a = sqrt(R * R - x * x), b = sqrt(bore * bore - x * x);
    return x * x * (bore - R) * (1.0 + (R + bore) / (a + b)) / ((R + a) * (bore + b)) + worn;
}

/* (U3) A tilt of the upper body lowers its gap on one side. */
double rb_rolling_initial_gap(const rb_rolling_case *rc, double x)
{
    const double tilt = rb_rolling_tilt(rc);
    return tilt != 0.0 ? upright_gap(rc, x) - tilt * x : upright_gap(rc, x);
}

rb_status rb_rolling_mesh_alloc(int n, rb_rolling_mesh *mesh)
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

/* An irregularity passes through the contact: `passed` is how far it has moved. */
rb_status rb_rolling_gap_along(const rb_rolling_case *rc, double passed, int n, const double *x,
                               double *gap)
{
    for (int i = 0; i < n; i++)
        gap[i] = rb_rolling_initial_gap(rc, x[i]);
    if (!(rc->irregularity.n > 0))
        return RB_OK;
    const int rows = rc->irregularity.n;
    const double *row = rc->irregularity.x;
    rb_rolling_interpolant *curve;
    const rb_status s = rb_rolling_interpolant_create(rows, row, rc->irregularity.y, 0, &curve);

    if (s != RB_OK)
        return s;
    for (int i = 0; i < n; i++) {
        const double place = x[i] + passed;
        if (place > row[0] && place < row[rows - 1])
            gap[i] += rb_rolling_interpolant_at(curve, place);
    }
    rb_rolling_interpolant_free(curve);
    return RB_OK;
}

int rb_rolling_is_convex(const rb_rolling_case *rc)
{
    return rc->gap != RB_GAP_TABLE && rc->irregularity.n == 0 && rc->worn.n == 0;
}

rb_status rb_rolling_mesh_set_gap(const rb_rolling_case *rc, rb_rolling_mesh *mesh)
{
    double *x = rb_alloc((size_t)mesh->n, 1);
    rb_status s = x ? RB_OK : RB_ENOMEM;

    for (int i = 0; i < mesh->n && x; i++)
        x[i] = 0.5 * (mesh->ends[i] + mesh->ends[i + 1]);
    if (s == RB_OK)
        s = rb_rolling_gap_along(rc, mesh->passed, mesh->n, x, mesh->gap);
    free(x);
    return s;
}

double rb_rolling_lower_half(const rb_rolling_case *rc)
{
    return rb_rolling_gap_has_shape(rc) && rb_rolling_can(rc, RB_BODY_FLAT)
               ? INFINITY
               : fmin(rc->a.radius, fabs(rc->b.radius));
}

void rb_rolling_extent(const rb_rolling_case *rc, double *from, double *to)
{
    *to = fmin(0.95 * rb_rolling_lower_half(rc), rc->period > 0.0 ? 0.5 * rc->period : INFINITY);
    *from = -*to;
    if (rc->gap == RB_GAP_TABLE) {
        double first, last;
        rb_rolling_profile_range(rc->profile, &first, &last);
        *from = rc->period > 0.0 ? first : fmax(*from, first);
        *to = rc->period > 0.0 ? first + rc->period : fmin(*to, last);
    }
}

int rb_rolling_fills_period(const rb_rolling_case *rc, const rb_rolling_mesh *mesh)
{
    return rc->period > 0.0 && mesh->ends[mesh->n] - mesh->ends[0] >= (1.0 - 1e-9) * rc->period;
}

/* What decides how wide the potential contact is. */
static const char of_extent[] = "zone,approach,load,half-width,max-pressure,radius";

rb_status rb_rolling_check_extent(const rb_rolling_case *rc, double from, double to,
                                  rb_message *why)
{
    const double radius = rb_rolling_lower_half(rc);

    if (!(from < to))
        return rb_refuse(why, of_extent, "the potential contact from %g to %g mm is empty", from,
                         to);
    if (fmax(fabs(from), fabs(to)) >= radius)
        return rb_refuse(why, of_extent,
                         "the potential contact from %g to %g mm is wider than the radius, %g mm",
                         from, to, radius);
    return RB_OK;
}

/* Equal elements: of a boundary-element cylinder equal arcs, of a half-plane equal lengths; both
 * are symmetric to rounding where from = -to. */
rb_status rb_rolling_mesh_uniform(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                  double from, double to, rb_rolling_mesh *mesh, rb_message *why)
{
    const int n = plan ? plan->elements : rc->contact_elements;
    const double R = rb_rolling_body_can(&rc->a, RB_BODY_FLAT) ? INFINITY : rc->a.radius;
    rb_status s = rb_rolling_check_extent(rc, from, to, why);

    if (s == RB_OK)
        s = rb_rolling_mesh_alloc(n, mesh);
    if (s != RB_OK)
        return s;
    const double first = isinf(R) ? from : R * asin(from / R),
                 last = isinf(R) ? to : R * asin(to / R);
    for (int i = 0; i <= n + 1; i++) {
        const double arc = (first * (n - i) + last * i) / n;
        mesh->ends[i] = isinf(R) ? arc : R * sin(arc / R);
    }
    s = rb_rolling_mesh_set_gap(rc, mesh);
    if (s == RB_OK && mesh->ends[mesh->n + 1] > mesh->ends[mesh->n])
        return RB_OK;
    rb_rolling_mesh_free(mesh);
    if (s != RB_OK)
        return s;
    /* an arc beyond the quarter circle turns back */
    return rb_refuse(why, of_extent,
                     "the potential contact from %g to %g mm: no room for the element before it "
                     "within the radius, %g mm; take more elements",
                     from, to, rc->a.radius);
}
