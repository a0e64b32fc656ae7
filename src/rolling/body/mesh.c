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

enum {
    OUTSIDE = 6, /* fitted: elements beyond each edge at least */
    MOST_OUTSIDE = 64,
    LEAST_ACROSS = 12 /* elements of one of several patches */
};
static const double GROWTH = 1.5; /* of one element beyond an edge to the next */

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

/* How much steeper a corner makes the surface, times the logarithm of what shorter elements see of
 * it more; before, behind: how far the surface is straight or smooth on either side. */
static double rise_at(double turn, double before, double behind, double element, double times)
{
    const double shorter = times * fmin(before, behind) / element;
    return turn > 0.0 && shorter > 1.0 ? turn * log(fmin(times, shorter)) : 0.0;
}

double rb_rolling_rise_at_corners(const rb_rolling_case *rc, double from, double to, double element,
                                  double times)
{
    const double *x = rc->worn.x, *y = rc->worn.y, *bend;
    double most = 0.0;

    if (rc->interlayer_normal > 0.0) /* which rounds the corner off */
        return 0.0;
    for (int i = 0; i < rc->worn.n; i++) {
        const double before = i > 0 ? x[i] - x[i - 1] : INFINITY;
        const double behind = i + 1 < rc->worn.n ? x[i + 1] - x[i] : INFINITY;
        const double turn = (i + 1 < rc->worn.n ? (y[i + 1] - y[i]) / behind : 0.0) -
                            (i > 0 ? (y[i] - y[i - 1]) / before : 0.0);
        if (x[i] > from && x[i] < to)
            most = fmax(most, rise_at(turn, before, behind, element, times));
    }
    const int corners =
        rc->gap == RB_GAP_TABLE ? rb_rolling_profile_corners(rc->profile, &x, &bend) : 0;
    for (int i = 0; i < corners; i++)
        if (x[i] > from && x[i] < to)
            most =
                fmax(most, rise_at(bend[i], i > 0 ? x[i] - x[i - 1] : INFINITY,
                                   i + 1 < corners ? x[i + 1] - x[i] : INFINITY, element, times));
    return rb_rolling_derive(rc).modulus * most / (2.0 * M_PI);
}

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

/* (U3) */
double rb_rolling_initial_gap(const rb_rolling_case *rc, double x)
{
    const double tilt = rb_rolling_tilt(rc);
    return tilt != 0.0 ? upright_gap(rc, x) - tilt * x : upright_gap(rc, x);
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

/* Half-width of the lower half of every round body.  Half-planes under a table are flat. */
static double lower_half(const rb_rolling_case *rc)
{
    return rb_rolling_gap_has_shape(rc) && rb_rolling_can(rc, RB_BODY_FLAT)
               ? INFINITY
               : fmin(rc->a.radius, fabs(rc->b.radius));
}

void rb_rolling_extent(const rb_rolling_case *rc, double *from, double *to)
{
    *to = fmin(0.95 * lower_half(rc), rc->period > 0.0 ? 0.5 * rc->period : INFINITY);
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

/* The mesh must stay on the lower half of every round body. */
static rb_status check_extent(const rb_rolling_case *rc, double from, double to, rb_message *why)
{
    const double radius = lower_half(rc);

    if (!(from < to))
        return rb_refuse(why, of_extent, "the potential contact from %g to %g mm is empty", from,
                         to);
    if (fmax(fabs(from), fabs(to)) >= radius)
        return rb_refuse(why, of_extent,
                         "the potential contact from %g to %g mm is wider than the radius, %g mm",
                         from, to, radius);
    return RB_OK;
}

/* n equal elements: of a boundary-element cylinder equal arcs, of a half-plane equal
 * lengths; both are symmetric to rounding where from = -to. */
static rb_status equal_elements(const rb_rolling_case *rc, int n, double from, double to,
                                rb_rolling_mesh *mesh, rb_message *why)
{
    const double R = rb_rolling_body_can(&rc->a, RB_BODY_FLAT) ? INFINITY : rc->a.radius;
    rb_status s = check_extent(rc, from, to, why);

    if (s == RB_OK)
        s = mesh_alloc(n, mesh);
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

rb_status rb_rolling_mesh_uniform(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                  double from, double to, rb_rolling_mesh *mesh, rb_message *why)
{
    return equal_elements(rc, plan ? plan->elements : rc->contact_elements, from, to, mesh, why);
}

/* ---- Fitted elements --------------------------------------------------------------- */

/* Distances from an edge at which elements beyond it end: the first one as long as the
 * last inside, OUTSIDE of them or as many as reach `room`, none beyond `available`. */
static int distances(double step, double room, double available, double *distance)
{
    double reach = 0.0;
    int n = 0;

    while ((n < OUTSIDE || reach < room) && n < MOST_OUTSIDE && reach < available) {
        reach = reach + 1.25 * step < available ? reach + step : available;
        distance[n++] = reach;
        step *= GROWTH;
    }
    return n;
}

/* Elements between two patches: they grow from either edge until they meet. */
static double *put_between(double from, double to, double left, double right, double *end)
{
    double distance[2][MOST_OUTSIDE], step[2] = {left, right}, reach[2] = {0.0, 0.0};
    int n[2] = {0, 0};

    while (n[0] + n[1] < MOST_OUTSIDE) {
        const double next = fmin(step[0], step[1]) * (1.0 + 1e-9); /* both where alike */
        const int grows[2] = {step[0] <= next, step[1] <= next};
        if (reach[0] + reach[1] + (grows[0] + grows[1]) * next > to - from)
            break;
        for (int side = 0; side < 2; side++)
            if (grows[side]) {
                distance[side][n[side]++] = reach[side] += step[side];
                step[side] *= GROWTH;
            }
    }
    const double stretch = (to - from) / (reach[0] + reach[1]);
    for (int k = 0; k < n[0] - (n[1] == 0); k++)
        *++end = from + stretch * distance[0][k];
    for (int k = n[1] - 2; k >= 0; k--) /* the last of either side is the same */
        *++end = to - stretch * distance[1][k];
    *++end = to;
    return end;
}
/* Elements of a patch: its share of those across the contact, and not too few of them. */
static int elements_across(int all, int count, const rb_rolling_span *span, int k)
{
    double width = 0.0;

    if (count == 1)
        return all;
    for (int l = 0; l < count; l++)
        width += span[l].to - span[l].from;
    return (int)fmax(fmax(LEAST_ACROSS, all / 4), round(all * (span[k].to - span[k].from) / width));
}

/* Length of the element beside either edge of a patch. */
static double edge_step(const rb_rolling_span *span, int across)
{
    return (span->to - span->from) * gsl_pow_2(sin(0.5 * M_PI / across));
}

/* The end of the element upstream of n fitted ones. */
static void put_upstream(const rb_rolling_case *rc, int n, double *ends)
{
    const double step = GROWTH * (ends[n] - ends[n - 1]);

    ends[n + 1] = ends[n] + fmin(step, 0.5 * (lower_half(rc) - ends[n]));
}

/* `across` elements from span->from, whose end lies in *end; the last one's end is returned.
 * Symmetric to rounding. */
static double *put_across(const rb_rolling_span *span, int across, double *end)
{
    const double centre = 0.5 * (span->from + span->to), half = 0.5 * (span->to - span->from);

    for (int i = 1; i < across; i++)
        *++end = centre - half * sin(0.5 * M_PI * (across - 2 * i) / across);
    *++end = span->to;
    return end;
}

rb_status rb_rolling_mesh_punch(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                rb_rolling_mesh *mesh, rb_message *why)
{
    rb_rolling_span all = {.h_left = 0.0};

    rb_rolling_extent(rc, &all.from, &all.to);
    rb_status s = check_extent(rc, all.from, all.to, why);
    if (s == RB_OK)
        s = mesh_alloc(plan->elements, mesh);
    if (s != RB_OK)
        return s;
    mesh->ends[0] = all.from;
    put_across(&all, mesh->n, mesh->ends);
    put_upstream(rc, mesh->n, mesh->ends);
    s = rb_rolling_mesh_set_gap(rc, mesh);
    if (s != RB_OK)
        rb_rolling_mesh_free(mesh);
    return s;
}

rb_status rb_rolling_mesh_spans(const rb_rolling_case *rc, int all, int count,
                                const rb_rolling_span *span, rb_rolling_mesh *mesh, rb_message *why)
{
    int most = (count + 1) * 2 * MOST_OUTSIDE;
    rb_status s = check_extent(rc, span[0].from, span[count - 1].to, why);

    for (int k = 0; k < count; k++)
        most += elements_across(all, count, span, k);
    if (s == RB_OK)
        s = mesh_alloc(most, mesh);
    if (s != RB_OK)
        return s;
    /* All ends, the one behind the upstream element included. */
    const rb_rolling_span *last = span + count - 1;
    double from, to, distance[MOST_OUTSIDE], *end = mesh->ends;

    rb_rolling_extent(rc, &from, &to);
    double step = edge_step(span, elements_across(all, count, span, 0));
    const int left = distances(step, span->margin_left, span->from - from, distance);
    for (int k = left - 1; k >= 0; k--)
        *end++ = span->from - distance[k];
    *end = span->from;
    for (int k = 0; k < count; k++) {
        const int across = elements_across(all, count, span, k);
        step = edge_step(span + k, across);
        end = put_across(span + k, across, end);
        if (k + 1 < count)
            end =
                put_between(span[k].to, span[k + 1].from, step,
                            edge_step(span + k + 1, elements_across(all, count, span, k + 1)), end);
    }
    const int right = distances(step, last->margin_right, to - last->to, distance);
    for (int k = 0; k < right; k++)
        *++end = last->to + distance[k];
    const int n = (int)(end - mesh->ends);
    put_upstream(rc, n, mesh->ends);
    mesh->n = n;
    s = rb_rolling_mesh_set_gap(rc, mesh);
    if (s != RB_OK)
        rb_rolling_mesh_free(mesh);
    return s;
}

rb_status rb_rolling_mesh_fitted(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                 double from, double to, rb_rolling_mesh *mesh, rb_message *why)
{
    const rb_rolling_span span = {.from = from, .to = to};

    return rb_rolling_mesh_spans(rc, plan ? plan->elements : rc->contact_elements, 1, &span, mesh,
                                 why);
}

/* ---- The mesh of a result ---------------------------------------------------------- */

/* Half of an element's extent along x: on a wheel elements are chords of its circle. */
static double half_extent(const rb_rolling_case *rc, double x, double h)
{
    if (rb_rolling_body_can(&rc->a, RB_BODY_FLAT))
        return 0.5 * h;
    const double apothem = sqrt(gsl_pow_2(rc->a.radius) - gsl_pow_2(0.5 * h));
    return 0.5 * h * sqrt(1.0 - gsl_pow_2(x / apothem));
}

rb_status rb_rolling_mesh_of_result(const rb_rolling_case *rc, const rb_rolling_elements *elements,
                                    rb_rolling_mesh *mesh, rb_message *why)
{
    const int n = elements->n;
    const double *x = elements->x, *h = elements->h;
    const double from = x[0] - half_extent(rc, x[0], h[0]);
    const double to = x[n - 1] + half_extent(rc, x[n - 1], h[n - 1]);

    memset(mesh, 0, sizeof *mesh);
    if (elements->are_equal)
        return equal_elements(rc, n, from, to, mesh, why);
    rb_status s = check_extent(rc, from, to, why);
    if (s == RB_OK)
        s = mesh_alloc(n, mesh);
    if (s != RB_OK)
        return s;
    mesh->ends[0] = from;
    for (int i = 0; i < n; i++)
        mesh->ends[i + 1] = x[i] + half_extent(rc, x[i], h[i]);
    put_upstream(rc, n, mesh->ends);
    for (int i = 0; i <= n; i++)
        if (!(mesh->ends[i + 1] > mesh->ends[i])) {
            rb_rolling_mesh_free(mesh);
            return rb_fail(why, RB_EINVAL, "element %d ends before it begins", i + 1);
        }
    s = rb_rolling_mesh_set_gap(rc, mesh);
    if (s != RB_OK)
        rb_rolling_mesh_free(mesh);
    return s;
}
