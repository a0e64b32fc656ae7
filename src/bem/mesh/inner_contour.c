/* The inner contour of a cylinder: the hub of a wheel, the inner side of a thin wall, and the core
 * below a cover (B11). */
#include "bem/mesh/cylinder.h"
#include "bem/internal.h"

#include <gsl/gsl_math.h>

static rb_side interface_side(const rb_bem_cylinder *cylinder, double from, double h)
{
    rb_side side = {
        .from = from, .h0 = h, .cap = rb_cylinder_largest_size(cylinder), .clamped = M_PI - from};
    side.growth = copysign(RB_GROWTH / rb_cylinder_refinement(cylinder), side.cap - h);
    rb_side_count(&side, 0);
    return side;
}

void rb_inner_lay_out(const rb_bem_cylinder *cylinder, int n_c, const double *ends, double finer,
                      rb_inner_layout *inner)
{
    const double R = cylinder->radius;

    if (rb_cylinder_is_thin(cylinder)) {
        /* Ten elements to the thickness of the wall under the contact, or fewer, but
         * four, where the contact's own are eight times as long. */
        const double radius = rb_cylinder_inner_radius(cylinder);
        const double low = asin(ends[0] / R), high = asin(ends[n_c] / R);
        const double fine = fmin(0.1 * rb_cylinder_thickness(cylinder) / radius, RB_LARGEST_ANGLE),
                     coarse =
                         fmax(0.25 * rb_cylinder_thickness(cylinder) / radius, RB_SMALLEST_FEATURE),
                     longest =
                         fmin(coarse / rb_cylinder_refinement(cylinder), (high - low) / (8 * n_c)),
                     size = fmax(fine / rb_cylinder_refinement(cylinder), longest);
        const double half = fmax(0.5 * (high - low), size), centre = 0.5 * (low + high);
        rb_inner_layout in = {.low = centre - half,
                              .high = centre + half,
                              .middle_n = (int)ceil(2.0 * half / size - 1e-9)};
        const double h = 2.0 * half / in.middle_n;
        in.right = interface_side(cylinder, in.high, h);
        in.left = interface_side(cylinder, -in.low, h);
        in.n = in.middle_n + in.right.free_n + in.left.free_n;
        *inner = in;
    } else if (cylinder->support == RB_BEM_HUB) {
        /* The hub's elements are as small as the largest outer ones, and resolve the rim. */
        const double rho = cylinder->hub_ratio;
        const double size =
            fmin(RB_LARGEST_ANGLE,
                 fmin(2.0 * M_PI * rho / 36.0, fmax((1.0 - rho) / 4.0, RB_SMALLEST_FEATURE)));
        inner->n = (int)fmin(fmax(16.0, ceil(finer * 2.0 * M_PI * rho / size)), 20000.0);
    }
}

/* Angle of end k of the inner contour, from that of end 0 to 2 pi less. */
static double angle_of(const rb_inner_layout *in, int k)
{
    const int left = in->middle_n + in->left.free_n;

    if (in->middle_n == 0)
        return -2.0 * M_PI * k / in->n;
    if (k <= in->middle_n)
        return in->high + (in->low - in->high) * k / in->middle_n;
    if (k <= left)
        return -rb_side_end(&in->left, k - in->middle_n);
    return rb_side_end(&in->right, in->n - k) - 2.0 * M_PI;
}

/* Clockwise: the body lies outside. */
void rb_inner_place(double R, double r, const rb_inner_layout *inner, int first, rb_bem_mesh *mesh)
{
    const double begin = angle_of(inner, 0);
    const rb_point start = {r * sin(begin), R - r * cos(begin)};
    rb_point from = start;
    for (int k = 0; k < inner->n; k++) {
        const double angle = angle_of(inner, k + 1);
        const rb_point to =
            k + 1 < inner->n ? (rb_point){r * sin(angle), R - r * cos(angle)} : start;
        rb_place(mesh, first + k, from, to, RB_BEM_DISPLACEMENT);
        from = to;
    }
}

rb_status rb_bem_mesh_core(const rb_bem_cylinder *cylinder, const rb_bem_mesh *cover,
                           rb_bem_mesh *core, rb_message *why)
{
    const double R = cylinder->radius, hub = cylinder->hub_ratio * R,
                 outside = rb_cylinder_inner_radius(cylinder);
    int n = 0;

    *core = (rb_bem_mesh){0};
    while (n < cover->n && cover->condition[2 * (cover->n - 1 - n)] == RB_BEM_DISPLACEMENT)
        n++;
    if (!(hub < 0.98 * outside))
        return rb_fail(why, RB_EINVAL,
                       "hub of radius %g: expected less than 0.98 of the radius %g of the "
                       "core under the cover",
                       hub, outside);
    const double size = fmin(RB_LARGEST_ANGLE, fmin(M_PI / 18.0, 0.5 * (outside / hub - 1.0)));
    const rb_inner_layout layout = {
        .n = (int)fmin(fmax(16.0, ceil(rb_cylinder_refinement(cylinder) * 2.0 * M_PI / size)),
                       20000.0)};
    rb_status s = rb_bem_mesh_alloc(n + layout.n, core);
    if (s != RB_OK)
        return rb_fail(why, s, "core: out of memory for %d elements", n + layout.n);
    for (int i = 0; i < n; i++) {
        const int j = cover->n - 1 - i;
        rb_place(core, i, (rb_point){cover->x1[j], cover->y1[j]},
                 (rb_point){cover->x0[j], cover->y0[j]}, RB_BEM_TRACTION);
    }
    rb_inner_place(R, hub, &layout, n, core);
    return rb_bem_mesh_check(core, why);
}
