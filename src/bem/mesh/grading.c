/* How long the elements around a cylinder are: what the thickness of its wall asks for, and the
 * grading of a side from the contact to the top (B7). */
#include "bem/mesh/cylinder.h"

#include <gsl/gsl_math.h>

/* A larger hub leaves a rim whose elements would be thousands if all were as fine. */
static const double largest_thick = 0.95;

/* ---- What a wall asks for ------------------------------------------------------------ */

/* A thin wall, of a cover or of the rim around a large hub: what happens in it has died
 * down some thicknesses beside the contact, so that its elements may grow from there. */
int rb_cylinder_is_thin(const rb_bem_cylinder *cylinder)
{
    return cylinder->cover > 0.0 ||
           (cylinder->support == RB_BEM_HUB && cylinder->hub_ratio > largest_thick);
}

/* A rim has twice the elements of a cover, and is then as accurate as with equal ones. */
double rb_cylinder_refinement(const rb_bem_cylinder *cylinder)
{
    const double asked = cylinder->refinement > 0.0 ? cylinder->refinement : 1.0;
    return rb_cylinder_is_thin(cylinder) && cylinder->cover == 0.0 ? 2.0 * asked : asked;
}

/* Radius of the rigid core, or of the core under a cover. */
double rb_cylinder_inner_radius(const rb_bem_cylinder *cylinder)
{
    return cylinder->cover > 0.0 ? cylinder->radius - cylinder->cover
                                 : cylinder->hub_ratio * cylinder->radius;
}

/* Of a thin wall. */
double rb_cylinder_thickness(const rb_bem_cylinder *cylinder)
{
    return cylinder->cover > 0.0 ? cylinder->cover : (1.0 - cylinder->hub_ratio) * cylinder->radius;
}

/* Angle of the largest elements.  A chord is away from its arc by angle^2/8 radii, at
 * most an eighth of a thin wall. */
double rb_cylinder_largest_size(const rb_bem_cylinder *cylinder)
{
    const double feature = rb_cylinder_is_thin(cylinder)
                               ? sqrt(rb_cylinder_thickness(cylinder) / cylinder->radius)
                           : cylinder->support == RB_BEM_HUB ? (1.0 - cylinder->hub_ratio) / 4.0
                                                             : INFINITY;
    return fmin(RB_LARGEST_ANGLE, fmax(feature, RB_SMALLEST_FEATURE)) /
           rb_cylinder_refinement(cylinder);
}

/* ---- A graded side -------------------------------------------------------------------- */

double rb_side_length(const rb_side *side)
{
    return M_PI - side->from;
}

/* Where elements end to grow, and where they begin to shrink again. */
typedef struct {
    double up, down;
} turns;

static turns turns_of(const rb_side *side)
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

static double elements_until(const rb_side *side, double s)
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

static double angle_after(const rb_side *side, double elements)
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
static double arc_elements(const rb_side *side)
{
    const double arc = rb_side_length(side) - side->clamped;
    return side->e0 > 0.0
               ? log1p(side->fall * arc / side->e0) / side->fall
               : elements_until(side, rb_side_length(side)) - elements_until(side, side->clamped);
}

double rb_side_elements(const rb_side *side)
{
    return elements_until(side, side->clamped) + arc_elements(side);
}

/* Rounded, where x.5 is as likely as any other: arcs and sides that are alike have it,
 * and whichever way the last digit of an end has gone, there are as many elements. */
int rb_whole(double elements)
{
    return (int)floor(elements + 0.5 + 1e-9);
}

/* Whole numbers of elements on the free and on the clamped part: as many as the grading
 * asks for, or `all` together. */
void rb_side_count(rb_side *side, int all)
{
    const double share = all > 0 ? all / rb_side_elements(side) : 1.0;
    const int has_arc = side->clamped < rb_side_length(side);

    side->arc_n = has_arc ? (int)fmax(1.0, rb_whole(share * arc_elements(side))) : 0;
    side->free_n = all > 0 ? all - side->arc_n : rb_whole(elements_until(side, side->clamped));
    side->free_n = side->free_n > 0 ? side->free_n : 1;
}

/* Angle of end k, k = 0 ... free_n + arc_n, counted from the contact. */
double rb_side_end(const rb_side *side, int k)
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
