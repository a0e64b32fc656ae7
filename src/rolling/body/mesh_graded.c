/* Meshes whose elements differ in length: fitted to the edges of patches, shorter towards both ends
 * of a punch, and those of a result. */
#include "rolling/body/body.h"
#include "rolling/body/mesh.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

enum {
    OUTSIDE = 6, /* fitted: elements beyond each edge at least */
    MOST_OUTSIDE = 64,
    LEAST_ACROSS = 12 /* elements of one of several patches */
};
static const double GROWTH = 1.5; /* of one element beyond an edge to the next */

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

    ends[n + 1] = ends[n] + fmin(step, 0.5 * (rb_rolling_lower_half(rc) - ends[n]));
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
    rb_status s = rb_rolling_check_extent(rc, all.from, all.to, why);
    if (s == RB_OK)
        s = rb_rolling_mesh_alloc(plan->elements, mesh);
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
    rb_status s = rb_rolling_check_extent(rc, span[0].from, span[count - 1].to, why);

    for (int k = 0; k < count; k++)
        most += elements_across(all, count, span, k);
    if (s == RB_OK)
        s = rb_rolling_mesh_alloc(most, mesh);
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
        return rb_rolling_mesh_uniform(rc, &(rb_rolling_plan){.elements = n}, from, to, mesh, why);
    rb_status s = rb_rolling_check_extent(rc, from, to, why);
    if (s == RB_OK)
        s = rb_rolling_mesh_alloc(n, mesh);
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
