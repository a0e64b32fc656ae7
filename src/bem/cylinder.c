/* The mesh of a cylinder on its lowest point (B7, B9). */
#include "bem/internal.h"

#include <gsl/gsl_math.h>
#include <math.h>

/* Beside the contact lies one element on each side: the upstream one on the right and its
 * mirror image on the left.  From there to the top each side is graded: at the distance
 * s, an angle, elements have the size h(s) = min(h0 + g s, cap, e0 + f (S - s)), so that
 * N(s) = int ds/h = ln(1 + g s/h0)/g while they grow, linear where they have their largest size
 * and the mirror image of the first towards a clamped arc at S that is small; elements lie
 * between, and ends are where N is a multiple of N(total)/elements.  Both sides count angles from
 * the lowest point as positive: symmetric ends make a symmetric mesh. */
typedef struct {
    double from;     /* angle at which the element beside the contact ends */
    double h0;       /* size of that element */
    double growth;   /* g; negative where the cap is below h0 */
    double cap;      /* largest size */
    double clamped;  /* S at which the clamped arc starts; the top where there is none */
    double e0, fall; /* size beside a small arc and f; e0 = 0: the arc has elements of the cap */
    int free_n, arc_n;
} graded_side;

static const double automatic_growth = 0.15; /* neighbours differ by at most a fifth */
static const double largest_angle = 2.0 * M_PI / 72.0;
/* What is finer, a thin rim, would need the whole circle as fine. */
static const double smallest_feature = 0.003;
/* A larger hub leaves a rim whose elements would be thousands if all were as fine. */
static const double largest_thick = 0.95;
/* Half-angle of arcs that have graded elements, because the tractions at the ends of an arc are
 * infinite like those of a punch; and the part of it that the first one is. */
static const double small_arc = 20.0 * M_PI / 180.0, first_on_arc = 0.02;

static double side_length(const graded_side *side)
{
    return M_PI - side->from;
}

/* Where elements end to grow, and where they begin to shrink again. */
typedef struct {
    double up, down;
} turns;

static turns turns_of(const graded_side *side)
{
    const double g = side->growth, f = side->fall, S = side->clamped;
    const double up = (side->cap - side->h0) / g;

    if (!(side->e0 > 0.0))
        return (turns){up, INFINITY};
    const double down = S - (side->cap - side->e0) / f;
    /* sizes that meet below the cap */
    const double meet = fmin(fmax((side->e0 + f * S - side->h0) / (g + f), 0.0), S);
    return up <= down || !(g > 0.0) ? (turns){fmin(up, S), fmax(down, fmin(up, S))}
                                    : (turns){meet, meet};
}

static double elements_until(const graded_side *side, double s)
{
    const double g = side->growth, f = side->fall, h0 = side->h0;
    const turns at = turns_of(side);
    const double grown = log1p(g * fmin(s, at.up) / h0) / g;
    double shrunk = 0.0, rest = s;

    if (s > at.down) {
        const double high = side->e0 + f * (side->clamped - at.down),
                     low = side->e0 + f * fmax(side->clamped - s, 0.0);
        shrunk = log(high / low) / f;
        rest = at.down;
    }
    return grown + fmax(rest - at.up, 0.0) / side->cap + shrunk;
}

static double angle_after(const graded_side *side, double elements)
{
    const double g = side->growth, f = side->fall, h0 = side->h0;
    const turns at = turns_of(side);
    const double grown = log1p(g * at.up / h0) / g, flat = (fmin(at.down, 1e9) - at.up) / side->cap;

    if (elements <= grown)
        return h0 * expm1(g * elements) / g;
    if (elements <= grown + flat || !(side->e0 > 0.0))
        return at.up + (elements - grown) * side->cap;
    const double high = side->e0 + f * (side->clamped - at.down);
    return side->clamped - (high * exp(-f * (elements - grown - flat)) - side->e0) / f;
}

/* Half of the clamped arc.  On a small one they grow from its end to the top as fast as beside it.
 */
static double arc_elements(const graded_side *side)
{
    const double arc = side_length(side) - side->clamped;
    return side->e0 > 0.0
               ? log1p(side->fall * arc / side->e0) / side->fall
               : elements_until(side, side_length(side)) - elements_until(side, side->clamped);
}

static double side_elements(const graded_side *side)
{
    return elements_until(side, side->clamped) + arc_elements(side);
}

/* Rounded, where x.5 is as likely as any other: arcs and sides that are alike have it,
 * and whichever way the last digit of an end has gone, there are as many elements. */
static int whole(double elements)
{
    return (int)floor(elements + 0.5 + 1e-9);
}

/* Whole numbers of elements on the free and on the clamped part: as many as the grading
 * asks for, or `all` together. */
static void count_elements(graded_side *side, int all)
{
    const double share = all > 0 ? all / side_elements(side) : 1.0;
    const int has_arc = side->clamped < side_length(side);

    side->arc_n = has_arc ? (int)fmax(1.0, whole(share * arc_elements(side))) : 0;
    side->free_n = all > 0 ? all - side->arc_n : whole(elements_until(side, side->clamped));
    side->free_n = side->free_n > 0 ? side->free_n : 1;
}

/* Angle of end k, k = 0 ... free_n + arc_n, counted from the contact. */
static double end_angle(const graded_side *side, int k)
{
    const double free_part = elements_until(side, side->clamped);
    const int on_arc = k - side->free_n;
    if (on_arc > 0 && side->e0 > 0.0) {
        const double N = arc_elements(side) * on_arc / side->arc_n;
        return on_arc == side->arc_n
                   ? M_PI
                   : side->from + side->clamped + side->e0 * expm1(side->fall * N) / side->fall;
    }
    const double N = on_arc <= 0 ? free_part * k / side->free_n
                                 : free_part + arc_elements(side) * on_arc / side->arc_n;
    const double s = on_arc == 0 ? side->clamped : angle_after(side, N);
    return on_arc == side->arc_n ? M_PI : side->from + s;
}

/* The inner contour of a thin wall: equal elements under the contact, from angle low to
 * high, and graded sides. */
typedef struct {
    double low, high;
    int middle_n;
    graded_side right, left;
} interface_layout;

typedef struct {
    graded_side right, left;
    int hub_n;
    interface_layout interface; /* of a thin wall, hub_n elements */
} outer_layout;

/* With the two elements beside the contact. */
static int outer_count(const outer_layout *layout)
{
    return 2 + layout->right.free_n + layout->right.arc_n + layout->left.free_n +
           layout->left.arc_n;
}

static double outer_demand(const outer_layout *layout)
{
    return 2.0 + side_elements(&layout->right) + side_elements(&layout->left);
}

/* Angle at which the mirror image of the upstream element ends, left of the contact: it
 * is to the first contact element what the upstream one is to the last. */
static double downstream_angle(double R, int n_c, const double *ends)
{
    const double first = asin(ends[0] / R), last = asin(ends[n_c] / R);
    const double ratio = (asin(ends[1] / R) - first) / (last - asin(ends[n_c - 1] / R));
    return first - ratio * (asin(ends[n_c + 1] / R) - last);
}

/* A thin wall, of a cover or of the rim around a large hub: what happens in it has died
 * down some thicknesses beside the contact, so that its elements may grow from there. */
static int is_thin(const rb_bem_cylinder *cylinder)
{
    return cylinder->cover > 0.0 ||
           (cylinder->support == RB_BEM_HUB && cylinder->hub_ratio > largest_thick);
}

/* A rim has twice the elements of a cover, and is then as accurate as with equal ones. */
static double refinement(const rb_bem_cylinder *cylinder)
{
    const double asked = cylinder->refinement > 0.0 ? cylinder->refinement : 1.0;
    return is_thin(cylinder) && cylinder->cover == 0.0 ? 2.0 * asked : asked;
}

/* Radius of the rigid core, or of the core under a cover. */
static double inner_radius(const rb_bem_cylinder *cylinder)
{
    return cylinder->cover > 0.0 ? cylinder->radius - cylinder->cover
                                 : cylinder->hub_ratio * cylinder->radius;
}

/* Of a thin wall. */
static double thickness(const rb_bem_cylinder *cylinder)
{
    return cylinder->cover > 0.0 ? cylinder->cover : (1.0 - cylinder->hub_ratio) * cylinder->radius;
}

/* Angle of the largest elements.  A chord is away from its arc by angle^2/8 radii, at
 * most an eighth of a thin wall. */
static double largest_size(const rb_bem_cylinder *cylinder)
{
    const double feature = is_thin(cylinder) ? sqrt(thickness(cylinder) / cylinder->radius)
                           : cylinder->support == RB_BEM_HUB ? (1.0 - cylinder->hub_ratio) / 4.0
                                                             : INFINITY;
    return fmin(largest_angle, fmax(feature, smallest_feature)) / refinement(cylinder);
}

static graded_side lay_out_side(const rb_bem_cylinder *cylinder, double contact, double from)
{
    const int has_hub = cylinder->support == RB_BEM_HUB;
    graded_side side = {.from = from, .h0 = from - contact, .cap = largest_size(cylinder)};

    side.growth = copysign(automatic_growth / refinement(cylinder), side.cap - side.h0);
    side.clamped = side_length(&side) - (has_hub ? 0.0 : cylinder->arc);
    if (!has_hub && cylinder->arc < small_arc) {
        side.fall = automatic_growth / refinement(cylinder);
        /* or as small as they get from those of the contact */
        const double first = first_on_arc * cylinder->arc / gsl_pow_2(refinement(cylinder));
        side.e0 = fmin(cylinder->arc, fmax(first, side.h0 - side.fall * side.clamped));
    }
    return side;
}

static graded_side interface_side(const rb_bem_cylinder *cylinder, double from, double h)
{
    graded_side side = {
        .from = from, .h0 = h, .cap = largest_size(cylinder), .clamped = M_PI - from};
    side.growth = copysign(automatic_growth / refinement(cylinder), side.cap - h);
    count_elements(&side, 0);
    return side;
}

static outer_layout lay_out(const rb_bem_cylinder *cylinder, int n_c, const double *ends)
{
    const double R = cylinder->radius;
    outer_layout layout = {
        .right = lay_out_side(cylinder, asin(ends[n_c] / R), asin(ends[n_c + 1] / R)),
        .left = lay_out_side(cylinder, -asin(ends[0] / R), -downstream_angle(R, n_c, ends))};
    double finer = refinement(cylinder);

    if (cylinder->outer_elements > 0) {
        const int asked = (int)round(finer * cylinder->outer_elements),
                  wanted = asked > 8 ? asked : 8;
        finer *= asked / outer_demand(&layout);
        /* The growth that needs so many, without a cap, by bisection of the falling
         * function outer_demand.  Where even equal elements are too few the growth ends at
         * zero, and count_elements takes smaller ones. */
        double low = 1e-9, high = 20.0;
        layout.right.cap = layout.left.cap = 1e6; /* none */
        for (int k = 0; k < 100; k++) {
            const double g = sqrt(low * high);
            layout.right.growth = layout.left.growth = g;
            layout.right.fall = layout.left.fall = g;
            *(outer_demand(&layout) > wanted ? &low : &high) = g;
        }
        const double right = side_elements(&layout.right), left = side_elements(&layout.left);
        count_elements(&layout.right, whole((wanted - 2) * right / (right + left)));
        count_elements(&layout.left, whole((wanted - 2) * left / (right + left)));
    } else {
        count_elements(&layout.right, 0);
        count_elements(&layout.left, 0);
    }
    if (is_thin(cylinder)) {
        /* Ten elements to the thickness of the wall under the contact, or fewer, but
         * four, where the contact's own are eight times as long. */
        const double inner = inner_radius(cylinder);
        const double low = asin(ends[0] / R), high = asin(ends[n_c] / R);
        const double fine = fmin(0.1 * thickness(cylinder) / inner, largest_angle),
                     coarse = fmax(0.25 * thickness(cylinder) / inner, smallest_feature),
                     longest = fmin(coarse / refinement(cylinder), (high - low) / (8 * n_c)),
                     size = fmax(fine / refinement(cylinder), longest);
        const double half = fmax(0.5 * (high - low), size), centre = 0.5 * (low + high);
        interface_layout in = {.low = centre - half,
                               .high = centre + half,
                               .middle_n = (int)ceil(2.0 * half / size - 1e-9)};
        const double h = 2.0 * half / in.middle_n;
        in.right = interface_side(cylinder, in.high, h);
        in.left = interface_side(cylinder, -in.low, h);
        layout.interface = in;
        layout.hub_n = layout.interface.middle_n + layout.interface.right.free_n +
                       layout.interface.left.free_n;
    } else if (cylinder->support == RB_BEM_HUB) {
        /* The hub's elements are as small as the largest outer ones, and resolve the rim. */
        const double rho = cylinder->hub_ratio;
        const double size = fmin(largest_angle, fmin(2.0 * M_PI * rho / 36.0,
                                                     fmax((1.0 - rho) / 4.0, smallest_feature)));
        layout.hub_n = (int)fmin(fmax(16.0, ceil(finer * 2.0 * M_PI * rho / size)), 20000.0);
    }
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
        return rb_fail(why, RB_EINVAL, "clamped arc: half-angle %g, expected in (0, pi/2]", c->arc);
    if (c->support == RB_BEM_HUB && !(c->hub_ratio > 0.0 && c->hub_ratio < 1.0))
        return rb_fail(why, RB_EINVAL, "hub ratio = %g: expected in (0, 1)", c->hub_ratio);
    if (c->cover != 0.0 && !(c->support == RB_BEM_HUB && c->cover > 0.0 && c->cover < c->radius))
        return rb_fail(why, RB_EINVAL,
                       "cover of thickness %g: expected > 0 and less than the radius %g, "
                       "on a hub",
                       c->cover, c->radius);
    if (c->outer_elements < 0 || (c->outer_elements > 0 && c->outer_elements < 8))
        return rb_fail(why, RB_EINVAL, "outer elements = %d: expected at least 8, or 0",
                       c->outer_elements);
    if (!(c->refinement >= 0.0 && c->refinement <= 1000.0))
        return rb_fail(why, RB_EINVAL, "refinement = %g: expected 0 ... 1000", c->refinement);
    if (n_c > RB_BEM_MOST_ELEMENTS || c->outer_elements > RB_BEM_MOST_ELEMENTS)
        return rb_fail(why, RB_EINVAL, "%d contact and %d outer elements: at most a million", n_c,
                       c->outer_elements);
    const double reach = fmax(-ends[0], ends[n_c + 1]);
    if (!(reach < c->radius))
        return rb_fail(why, RB_EINVAL, "zone up to |x| = %g on a radius of %g", reach, c->radius);
    const double angle =
        fmax(asin(ends[n_c + 1] / c->radius), -downstream_angle(c->radius, n_c, ends));
    if (c->support == RB_BEM_ARC && angle > 0.95 * (M_PI - c->arc))
        return rb_fail(why, RB_EINVAL,
                       "zone up to |x| = %g reaches the clamped arc of half-angle %g", reach,
                       c->arc);
    if (angle > 0.95 * M_PI)
        return rb_fail(why, RB_EINVAL, "zone up to |x| = %g: no space for elements beside it",
                       reach);
    return RB_OK;
}

typedef struct {
    double x, y;
} point;

double rb_bem_circle_height(double radius, double x)
{
    return x * x / (radius + sqrt((radius - x) * (radius + x)));
}

static point at_abscissa(double R, double x)
{
    return (point){x, rb_bem_circle_height(R, x)};
}

static point at_angle(double R, double angle)
{
    const double half = sin(0.5 * angle);
    return (point){R * sin(angle), 2.0 * R * half * half};
}

/* End k of the outer circle, counted from the first contact end counter-clockwise. */
static point outer_node(const outer_layout *layout, double R, int n_c, const double *ends, int k)
{
    const int zone = n_c + 1, right = layout->right.free_n + layout->right.arc_n,
              all = n_c + outer_count(layout);
    if (k <= zone)
        return at_abscissa(R, ends[k]);
    if (k <= zone + right)
        return at_angle(R, end_angle(&layout->right, k - zone));
    if (k < all)
        return at_angle(R, -end_angle(&layout->left, all - 1 - k));
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

/* Angle of end k of the inner contour, from that of end 0 to 2 pi less. */
static double inner_angle(const outer_layout *layout, int k)
{
    const interface_layout *in = &layout->interface;
    const int left = in->middle_n + in->left.free_n;

    if (in->middle_n == 0)
        return -2.0 * M_PI * k / layout->hub_n;
    if (k <= in->middle_n)
        return in->high + (in->low - in->high) * k / in->middle_n;
    if (k <= left)
        return -end_angle(&in->left, k - in->middle_n);
    return end_angle(&in->right, layout->hub_n - k) - 2.0 * M_PI;
}

/* Clockwise: the body lies outside. */
static void place_hub(double R, double r, const outer_layout *layout, int first, rb_bem_mesh *mesh)
{
    const double begin = inner_angle(layout, 0);
    const point start = {r * sin(begin), R - r * cos(begin)};
    point from = start;
    for (int k = 0; k < layout->hub_n; k++) {
        const double angle = inner_angle(layout, k + 1);
        const point to =
            k + 1 < layout->hub_n ? (point){r * sin(angle), R - r * cos(angle)} : start;
        place(mesh, first + k, from, to, RB_BEM_DISPLACEMENT);
        from = to;
    }
}

rb_status rb_bem_mesh_cylinder(const rb_bem_cylinder *cylinder, int n_c, const double *ends,
                               rb_bem_mesh *mesh, rb_message *why)
{
    *mesh = (rb_bem_mesh){0};
    rb_status s = check_cylinder(cylinder, n_c, ends, why);
    if (s != RB_OK)
        return s;
    const double R = cylinder->radius, core = inner_radius(cylinder);
    const outer_layout layout = lay_out(cylinder, n_c, ends);
    const int outer = n_c + outer_count(&layout), arc_first = n_c + 1 + layout.right.free_n,
              arc_n = layout.right.arc_n + layout.left.arc_n;

    s = rb_bem_mesh_alloc(outer + layout.hub_n, mesh);
    if (s != RB_OK)
        return rb_fail(why, s, "cylinder: out of memory for %d elements", outer + layout.hub_n);
    mesh->contact_n = n_c;
    point from = outer_node(&layout, R, n_c, ends, 0);
    for (int j = 0; j < outer; j++) {
        const point to = outer_node(&layout, R, n_c, ends, j + 1);
        const int clamped = j >= arc_first && j < arc_first + arc_n;
        place(mesh, j, from, to,
              j < n_c   ? RB_BEM_CONTACT
              : clamped ? RB_BEM_DISPLACEMENT
                        : RB_BEM_TRACTION);
        from = to;
    }
    place_hub(R, core, &layout, outer, mesh);
    /* Few elements are long chords, which must not cut the core. */
    for (int j = 0; cylinder->support == RB_BEM_HUB && s == RB_OK && j < outer; j++)
        if (hypot(0.5 * (mesh->x0[j] + mesh->x1[j]), 0.5 * (mesh->y0[j] + mesh->y1[j]) - R) <= core)
            s = rb_fail(why, RB_EINVAL,
                        "outer elements = %d: elements this long cut through the "
                        "hub of radius %g; use more, or 0",
                        cylinder->outer_elements, core);
    if (s == RB_OK)
        s = rb_bem_mesh_check(mesh, why);
    if (s != RB_OK)
        rb_bem_mesh_free(mesh);
    return s;
}

rb_status rb_bem_mesh_core(const rb_bem_cylinder *cylinder, const rb_bem_mesh *cover,
                           rb_bem_mesh *core, rb_message *why)
{
    const double R = cylinder->radius, hub = cylinder->hub_ratio * R,
                 outside = inner_radius(cylinder);
    int n = 0;

    *core = (rb_bem_mesh){0};
    while (n < cover->n && cover->condition[2 * (cover->n - 1 - n)] == RB_BEM_DISPLACEMENT)
        n++;
    if (!(hub < 0.98 * outside))
        return rb_fail(why, RB_EINVAL,
                       "hub of radius %g: expected less than 0.98 of the radius %g of the "
                       "core under the cover",
                       hub, outside);
    const double size = fmin(largest_angle, fmin(M_PI / 18.0, 0.5 * (outside / hub - 1.0)));
    const outer_layout layout = {
        .hub_n = (int)fmin(fmax(16.0, ceil(refinement(cylinder) * 2.0 * M_PI / size)), 20000.0)};
    rb_status s = rb_bem_mesh_alloc(n + layout.hub_n, core);
    if (s != RB_OK)
        return rb_fail(why, s, "core: out of memory for %d elements", n + layout.hub_n);
    for (int i = 0; i < n; i++) {
        const int j = cover->n - 1 - i;
        place(core, i, (point){cover->x1[j], cover->y1[j]}, (point){cover->x0[j], cover->y0[j]},
              RB_BEM_TRACTION);
    }
    place_hub(R, hub, &layout, n, core);
    return rb_bem_mesh_check(core, why);
}
