/* The mesh of a cylinder on its lowest point (B7, B9). */
#include "bem/internal.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>

/* The sides of the outer circle, from the two ends of the zone to the top, are graded: at
 * the angle s from the zone elements have the size h(s) = min(h0 + g s, cap), so that
 *     N(s) = int ds/h = ln(1 + g s/h0)/g   up to  s* = (cap - h0)/g,  then linear,
 * elements lie between, and ends are where N is a multiple of N(total)/elements. */
typedef struct {
    double from;   /* angle of the zone's end, from the lowest point */
    double to;     /* the top: +pi or -pi */
    double h0;     /* size of the element at the zone's end */
    double growth; /* g; negative where the cap is below h0 */
    double cap;
    double
        clamped; /* angle from the zone at which the clamped arc starts; to top: none */
    int free_n, arc_n;
} graded_side;

static const double automatic_growth = 0.15; /* neighbours differ by at most a fifth */
static const double largest_angle = 2.0 * M_PI / 72.0;
/* What is finer, a clamped point or a thin rim, would need the whole circle as fine. */
static const double smallest_feature = 0.003;

static double side_length(const graded_side *side)
{
    return fabs(side->to - side->from);
}

static double elements_until(const graded_side *side, double s)
{
    const double g = side->growth, h0 = side->h0, bend = (side->cap - h0) / g;
    const double graded = log1p(g * fmin(s, bend) / h0) / g;
    return graded + fmax(s - bend, 0.0) / side->cap;
}

static double angle_after(const graded_side *side, double elements)
{
    const double g = side->growth, h0 = side->h0, bend = (side->cap - h0) / g;
    const double graded = log1p(g * bend / h0) / g;
    return h0 * expm1(g * fmin(elements, graded)) / g +
           fmax(elements - graded, 0.0) * side->cap;
}

static double arc_elements(const graded_side *side)
{
    return elements_until(side, side_length(side)) - elements_until(side, side->clamped);
}

/* Whole numbers of elements on the free and on the clamped part. */
static void count_elements(graded_side *side)
{
    side->free_n = (int)fmax(1.0, round(elements_until(side, side->clamped)));
    side->arc_n =
        side->clamped < side_length(side) ? (int)fmax(1.0, round(arc_elements(side))) : 0;
}

/* Angle of end k, k = 0 ... free_n + arc_n, counted from the zone. */
static double end_angle(const graded_side *side, int k)
{
    const int all = side->free_n + side->arc_n;
    const double free_part = elements_until(side, side->clamped);
    const double N = k <= side->free_n ? free_part * k / side->free_n
                                       : free_part + arc_elements(side) *
                                                         (k - side->free_n) / side->arc_n;
    const double s = k == side->free_n ? side->clamped : angle_after(side, N);
    if (k == all)
        return side->to;
    return side->to > side->from ? side->from + s : side->from - s;
}

typedef struct {
    graded_side right, left;
    int hub_n;
} outer_layout;

static int outer_count(const outer_layout *layout)
{
    return layout->right.free_n + layout->right.arc_n + layout->left.free_n +
           layout->left.arc_n;
}

static double outer_demand(const outer_layout *layout)
{
    return elements_until(&layout->right, side_length(&layout->right)) +
           elements_until(&layout->left, side_length(&layout->left));
}

/* `wanted` elements outside the contact: the growth that needs so many, without a cap,
 * by bisection of the falling function outer_demand. */
static void fit_growth(outer_layout *layout, double wanted)
{
    double low = 1e-9, high = 20.0;
    layout->right.cap = layout->left.cap = 1e6; /* none */
    for (int k = 0; k < 100; k++) {
        const double g = sqrt(low * high);
        layout->right.growth = layout->left.growth = g;
        if (outer_demand(layout) > wanted)
            low = g;
        else
            high = g;
    }
}

/* The hub's elements are as small as the largest outer ones, and resolve the rim. */
static int hub_elements(const rb_bem_cylinder *cylinder, double scale)
{
    const double rho = cylinder->hub_ratio;
    const double size =
        fmin(largest_angle,
             fmin(2.0 * M_PI * rho / 36.0, fmax((1.0 - rho) / 4.0, smallest_feature)));
    return (int)fmin(fmax(16.0, ceil(scale * 2.0 * M_PI * rho / size)), 20000.0);
}

static outer_layout lay_out(const rb_bem_cylinder *cylinder, int n_c, const double *ends)
{
    const double R = cylinder->radius, first = asin(ends[0] / R),
                 last = asin(ends[n_c + 1] / R);
    const int has_hub = cylinder->support == RB_BEM_HUB;
    const double feature =
        has_hub ? (1.0 - cylinder->hub_ratio) / 4.0 : 2.0 * cylinder->arc / 8.0;
    const graded_side side = {.growth = automatic_growth,
                              .cap =
                                  fmin(largest_angle, fmax(feature, smallest_feature))};
    outer_layout layout = {.right = side, .left = side};

    layout.right.from = last;
    layout.right.to = M_PI;
    layout.right.h0 = last - asin(ends[n_c] / R);
    layout.left.from = first;
    layout.left.to = -M_PI;
    layout.left.h0 = asin(ends[1] / R) - first;
    layout.right.clamped = side_length(&layout.right) - (has_hub ? 0.0 : cylinder->arc);
    layout.left.clamped = side_length(&layout.left) - (has_hub ? 0.0 : cylinder->arc);
    layout.right.growth = copysign(automatic_growth, layout.right.cap - layout.right.h0);
    layout.left.growth = copysign(automatic_growth, layout.left.cap - layout.left.h0);
    const double automatic = outer_demand(&layout);
    if (cylinder->outer_elements > 0)
        fit_growth(&layout, cylinder->outer_elements);
    count_elements(&layout.right);
    count_elements(&layout.left);
    layout.hub_n =
        has_hub ? hub_elements(cylinder, outer_demand(&layout) / automatic) : 0;
    return layout;
}

static rb_status check_cylinder(const rb_bem_cylinder *c, int n_c, const double *ends,
                                rb_message *why)
{
    const rb_status s = rb_bem_ends_check(n_c, ends, why);
    if (s != RB_OK)
        return s;
    if (!(c->radius > 0.0 && isfinite(c->radius)))
        return rb_fail(why, RB_EINVAL, "radius = %g: expected > 0", c->radius);
    if (c->support != RB_BEM_ARC && c->support != RB_BEM_HUB)
        return rb_fail(why, RB_EINVAL, "a cylinder's mesh has support arc or hub");
    if (c->support == RB_BEM_ARC && !(c->arc > 0.0 && c->arc <= M_PI_2))
        return rb_fail(why, RB_EINVAL,
                       "clamped arc: half-angle %g, expected in (0, pi/2]", c->arc);
    if (c->support == RB_BEM_HUB && !(c->hub_ratio > 0.0 && c->hub_ratio < 1.0))
        return rb_fail(why, RB_EINVAL, "hub ratio = %g: expected in (0, 1)",
                       c->hub_ratio);
    if (c->outer_elements < 0 || (c->outer_elements > 0 && c->outer_elements < 8))
        return rb_fail(why, RB_EINVAL, "outer elements = %d: expected at least 8, or 0",
                       c->outer_elements);
    if (n_c > 1000000 || c->outer_elements > 1000000)
        return rb_fail(why, RB_EINVAL,
                       "%d contact and %d outer elements: at most a million", n_c,
                       c->outer_elements);
    const double reach = fmax(-ends[0], ends[n_c + 1]);
    if (!(reach < c->radius))
        return rb_fail(why, RB_EINVAL, "zone up to |x| = %g on a radius of %g", reach,
                       c->radius);
    if (c->support == RB_BEM_ARC && asin(reach / c->radius) > 0.95 * (M_PI - c->arc))
        return rb_fail(why, RB_EINVAL,
                       "zone up to |x| = %g reaches the clamped arc of half-angle %g",
                       reach, c->arc);
    return RB_OK;
}

typedef struct {
    double x, y;
} point;

/* (B9): no difference of nearly equal numbers near the lowest point. */
static point at_abscissa(double R, double x)
{
    return (point){x, x * x / (R + sqrt((R - x) * (R + x)))};
}

static point at_angle(double R, double angle)
{
    const double half = sin(0.5 * angle);
    return (point){R * sin(angle), 2.0 * R * half * half};
}

/* End k of the outer circle, counted from the first contact end counter-clockwise. */
static point outer_node(const outer_layout *layout, double R, int n_c, const double *ends,
                        int k)
{
    const int zone = n_c + 1, right = layout->right.free_n + layout->right.arc_n,
              left = layout->left.free_n + layout->left.arc_n;
    if (k <= zone)
        return at_abscissa(R, ends[k]);
    if (k <= zone + right)
        return at_angle(R, end_angle(&layout->right, k - zone));
    if (k < zone + right + left)
        return at_angle(R, end_angle(&layout->left, zone + right + left - k));
    return at_abscissa(R, ends[0]);
}

static void place(rb_bem_mesh *mesh, int j, point from, point to, rb_bem_condition type)
{
    mesh->x0[j] = from.x;
    mesh->y0[j] = from.y;
    mesh->x1[j] = to.x;
    mesh->y1[j] = to.y;
    mesh->condition[2 * j] = mesh->condition[2 * j + 1] = type;
}

static void place_outer(const rb_bem_cylinder *cylinder, int n_c, const double *ends,
                        const outer_layout *layout, rb_bem_mesh *mesh)
{
    const int arc_first = n_c + 1 + layout->right.free_n,
              arc_n = layout->right.arc_n + layout->left.arc_n,
              n = n_c + 1 + outer_count(layout);
    point from = outer_node(layout, cylinder->radius, n_c, ends, 0);
    for (int j = 0; j < n; j++) {
        const point to = outer_node(layout, cylinder->radius, n_c, ends, j + 1);
        const int clamped = j >= arc_first && j < arc_first + arc_n;
        place(mesh, j, from, to,
              j < n_c   ? RB_BEM_CONTACT
              : clamped ? RB_BEM_DISPLACEMENT
                        : RB_BEM_TRACTION);
        from = to;
    }
}

/* Clockwise: the body lies outside. */
static void place_hub(const rb_bem_cylinder *cylinder, int first, int n,
                      rb_bem_mesh *mesh)
{
    const double R = cylinder->radius, r = cylinder->hub_ratio * R;
    point start = {0.0, R - r}, from = start;
    for (int k = 0; k < n; k++) {
        const double angle = 2.0 * M_PI * (k + 1) / n;
        const point to = k + 1 < n ? (point){-r * sin(angle), R - r * cos(angle)} : start;
        place(mesh, first + k, from, to, RB_BEM_DISPLACEMENT);
        from = to;
    }
}

rb_status rb_bem_mesh_cylinder(const rb_bem_cylinder *cylinder, int n_c,
                               const double *ends, rb_bem_mesh *mesh, rb_message *why)
{
    *mesh = (rb_bem_mesh){0};
    rb_status s = check_cylinder(cylinder, n_c, ends, why);
    if (s != RB_OK)
        return s;
    const outer_layout layout = lay_out(cylinder, n_c, ends);
    const int outer = n_c + 1 + outer_count(&layout);

    s = rb_bem_mesh_alloc(outer + layout.hub_n, mesh);
    if (s != RB_OK)
        return rb_fail(why, s, "cylinder: no memory for %d elements",
                       outer + layout.hub_n);
    mesh->contact_n = n_c;
    place_outer(cylinder, n_c, ends, &layout, mesh);
    place_hub(cylinder, outer, layout.hub_n, mesh);
    return rb_bem_mesh_check(mesh, why);
}
