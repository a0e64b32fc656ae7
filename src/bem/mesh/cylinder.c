/* The mesh of a cylinder on its lowest point (B7, B9). */
#include "bem/mesh/cylinder.h"
#include "bem/internal.h"

#include <gsl/gsl_math.h>
#include <math.h>

/* Half-angle of arcs that have graded elements, because the tractions at the ends of an arc are
 * infinite like those of a punch; and the part of it that the first one is. */
static const double small_arc = 20.0 * M_PI / 180.0, first_on_arc = 0.02;

typedef struct {
    rb_side right, left;
    rb_inner_layout inner;
} outer_layout;

/* With the two elements beside the contact. */
static int outer_count(const outer_layout *layout)
{
    return 2 + layout->right.free_n + layout->right.arc_n + layout->left.free_n +
           layout->left.arc_n;
}

static double outer_demand(const outer_layout *layout)
{
    return 2.0 + rb_side_elements(&layout->right) + rb_side_elements(&layout->left);
}

/* Angle at which the mirror image of the upstream element ends, left of the contact: it
 * is to the first contact element what the upstream one is to the last. */
static double downstream_angle(double R, int n_c, const double *ends)
{
    const double first = asin(ends[0] / R), last = asin(ends[n_c] / R);
    const double ratio = (asin(ends[1] / R) - first) / (last - asin(ends[n_c - 1] / R));
    return first - ratio * (asin(ends[n_c + 1] / R) - last);
}

static rb_side lay_out_side(const rb_bem_cylinder *cylinder, double contact, double from)
{
    const int has_hub = cylinder->support == RB_BEM_HUB;
    rb_side side = {.from = from, .h0 = from - contact, .cap = rb_cylinder_largest_size(cylinder)};

    side.growth = copysign(RB_GROWTH / rb_cylinder_refinement(cylinder), side.cap - side.h0);
    side.clamped = rb_side_length(&side) - (has_hub ? 0.0 : cylinder->arc);
    if (!has_hub && cylinder->arc < small_arc) {
        side.fall = RB_GROWTH / rb_cylinder_refinement(cylinder);
        /* or as small as they get from those of the contact */
        const double first =
            first_on_arc * cylinder->arc / gsl_pow_2(rb_cylinder_refinement(cylinder));
        side.e0 = fmin(cylinder->arc, fmax(first, side.h0 - side.fall * side.clamped));
    }
    return side;
}

static outer_layout lay_out(const rb_bem_cylinder *cylinder, int n_c, const double *ends)
{
    const double R = cylinder->radius;
    outer_layout layout = {
        .right = lay_out_side(cylinder, asin(ends[n_c] / R), asin(ends[n_c + 1] / R)),
        .left = lay_out_side(cylinder, -asin(ends[0] / R), -downstream_angle(R, n_c, ends))};
    double finer = rb_cylinder_refinement(cylinder);

    if (cylinder->outer_elements > 0) {
        const int asked = (int)round(finer * cylinder->outer_elements),
                  wanted = asked > 8 ? asked : 8;
        finer *= asked / outer_demand(&layout);
        /* The growth that needs so many, without a cap, by bisection of the falling
         * function outer_demand.  Where even equal elements are too few the growth ends at
         * zero, and rb_side_count takes smaller ones. */
        double low = 1e-9, high = 20.0;
        layout.right.cap = layout.left.cap = 1e6; /* none */
        for (int k = 0; k < 100; k++) {
            const double g = sqrt(low * high);
            layout.right.growth = layout.left.growth = g;
            layout.right.fall = layout.left.fall = g;
            *(outer_demand(&layout) > wanted ? &low : &high) = g;
        }
        const double right = rb_side_elements(&layout.right), left = rb_side_elements(&layout.left);
        rb_side_count(&layout.right, rb_whole((wanted - 2) * right / (right + left)));
        rb_side_count(&layout.left, rb_whole((wanted - 2) * left / (right + left)));
    } else {
        rb_side_count(&layout.right, 0);
        rb_side_count(&layout.left, 0);
    }
    if (cylinder->support == RB_BEM_HUB)
        rb_inner_lay_out(cylinder, n_c, ends, finer, &layout.inner);
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

double rb_bem_circle_height(double radius, double x)
{
    return x * x / (radius + sqrt((radius - x) * (radius + x)));
}

static rb_point at_abscissa(double R, double x)
{
    return (rb_point){x, rb_bem_circle_height(R, x)};
}

static rb_point at_angle(double R, double angle)
{
    const double half = sin(0.5 * angle);
    return (rb_point){R * sin(angle), 2.0 * R * half * half};
}

/* End k of the outer circle, counted from the first contact end counter-clockwise. */
static rb_point outer_node(const outer_layout *layout, double R, int n_c, const double *ends, int k)
{
    const int zone = n_c + 1, right = layout->right.free_n + layout->right.arc_n,
              all = n_c + outer_count(layout);
    if (k <= zone)
        return at_abscissa(R, ends[k]);
    if (k <= zone + right)
        return at_angle(R, rb_side_end(&layout->right, k - zone));
    if (k < all)
        return at_angle(R, -rb_side_end(&layout->left, all - 1 - k));
    return at_abscissa(R, ends[0]);
}

rb_status rb_bem_mesh_cylinder(const rb_bem_cylinder *cylinder, int n_c, const double *ends,
                               rb_bem_mesh *mesh, rb_message *why)
{
    *mesh = (rb_bem_mesh){0};
    rb_status s = check_cylinder(cylinder, n_c, ends, why);
    if (s != RB_OK)
        return s;
    const double R = cylinder->radius, core = rb_cylinder_inner_radius(cylinder);
    const outer_layout layout = lay_out(cylinder, n_c, ends);
    const int outer = n_c + outer_count(&layout), arc_first = n_c + 1 + layout.right.free_n,
              arc_n = layout.right.arc_n + layout.left.arc_n;

    s = rb_bem_mesh_alloc(outer + layout.inner.n, mesh);
    if (s != RB_OK)
        return rb_fail(why, s, "cylinder: out of memory for %d elements", outer + layout.inner.n);
    mesh->contact_n = n_c;
    rb_point from = outer_node(&layout, R, n_c, ends, 0);
    for (int j = 0; j < outer; j++) {
        const rb_point to = outer_node(&layout, R, n_c, ends, j + 1);
        const int clamped = j >= arc_first && j < arc_first + arc_n;
        rb_place(mesh, j, from, to,
                 j < n_c   ? RB_BEM_CONTACT
                 : clamped ? RB_BEM_DISPLACEMENT
                           : RB_BEM_TRACTION);
        from = to;
    }
    if (cylinder->support == RB_BEM_HUB)
        rb_inner_place(R, core, &layout.inner, outer, mesh);
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
