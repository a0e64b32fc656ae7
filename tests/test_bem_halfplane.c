/* Stress in the half-plane against Hertz's field. */
#include "check.h"
#include "bem/bem.h"

#include <gsl/gsl_math.h>

enum { n_strips = 400 };

typedef struct {
    double ends[n_strips + 1], p[n_strips], q[n_strips];
} load;

/* Mean over each strip of p0 sqrt(1 - x^2), a = p0 = 1; q = ratio p. */
static load hertz(double ratio)
{
    load l;
    for (int i = 0; i <= n_strips; i++)
        l.ends[i] = -cos(M_PI * i / n_strips);
    for (int i = 0; i < n_strips; i++) {
        const double a = l.ends[i], b = l.ends[i + 1];
        const double area =
            0.5 * (b * sqrt(fmax(0, 1 - b * b)) + asin(b) - a * sqrt(fmax(0, 1 - a * a)) - asin(a));
        l.p[i] = area / (b - a);
        l.q[i] = ratio * l.p[i];
    }
    return l;
}

static void stress_at(const load *l, double x, double y, double s[3])
{
    const double xy[2] = {x, y};
    CHECK_OK(rb_bem_halfplane_stress(&(rb_bem_edge_load){n_strips, l->ends, l->p, l->q},
                                     (rb_bem_points){1, xy}, s));
}

static double max_shear(const double s[3])
{
    return hypot(0.5 * (s[0] - s[1]), s[2]);
}

/* plane strain, szz = nu (sxx + syy) */
static double von_mises(const double s[3])
{
    const double nu = 0.3, z = nu * (s[0] + s[1]);
    return sqrt(0.5 * (pow(s[0] - s[1], 2) + pow(s[1] - z, 2) + pow(z - s[0], 2)) +
                3 * s[2] * s[2]);
}

typedef struct {
    double value, x, y;
} maximum;

/* On ever finer grids about the best point so far. */
static maximum largest(const load *l, double (*of)(const double *), maximum best, double step)
{
    for (int round = 0; round < 12; round++, step *= 0.4) {
        const double cx = best.x, cy = best.y;
        for (int i = -3; i <= 3; i++)
            for (int j = -3; j <= 3; j++) {
                const double x = cx + i * step, y = fmax(0.0, cy + j * step);
                double s[3];
                stress_at(l, x, y, s);
                if (of(s) > best.value)
                    best = (maximum){of(s), x, y};
            }
    }
    return best;
}

static double shear_xy(const double s[3])
{
    return fabs(s[2]);
}

TEST(hertz_maxima_are_those_of_the_books)
{
    const load l = hertz(0.0);
    const maximum tau = largest(&l, max_shear, (maximum){0, 0, 0.7}, 0.1),
                  mises = largest(&l, von_mises, (maximum){0, 0, 0.7}, 0.1),
                  xy = largest(&l, shear_xy, (maximum){0, 0.8, 0.5}, 0.05);
    CHECK_REL(tau.value, 0.30028, 3e-4, "max shear");
    CHECK_REL(tau.y, 0.78615, 1e-2, "its depth");
    CHECK_REL(mises.value, 0.55752, 3e-4, "von Mises");
    CHECK_REL(mises.y, 0.70429, 1e-2, "its depth");
    CHECK_REL(xy.value, 0.25, 3e-4, "orthogonal shear");
    CHECK_REL(xy.x, 0.866, 1e-2, "its place");
    CHECK_REL(xy.y, 0.5, 1e-2, "its depth");
}

/* Friction towards +x on the body. */
TEST(full_sliding_moves_the_maximum)
{
    const load l = hertz(0.2);
    const maximum tau = largest(&l, max_shear, (maximum){0, 0.6, 0.6}, 0.1);
    CHECK_REL(tau.value, 0.31899, 3e-4, "max shear");
    CHECK_ABS(tau.x, 0.625, 6e-3, "x");
    CHECK_REL(tau.y, 0.601, 1e-2, "y");
}

/* McEwen's field below the centre: sxx = -p0 [(1 + 2y^2)/sqrt(1 + y^2) - 2y], syy = -p0/
 * sqrt(1 + y^2). */
TEST(the_axis_is_in_closed_form)
{
    const load l = hertz(0.0);
    for (double y = 0.01; y < 100.0; y *= 2.0) {
        double s[3];
        stress_at(&l, 0.0, y, s);
        CHECK_ABS(s[0], -((1 + 2 * y * y) / sqrt(1 + y * y) - 2 * y), 3e-5, "sxx at %g", y);
        CHECK_ABS(s[1], -1 / sqrt(1 + y * y), 3e-5, "syy at %g", y);
        CHECK_ABS(s[2], 0.0, 1e-15, "sxy at %g", y);
    }
}

TEST(the_surface_carries_the_tractions)
{
    const load l = hertz(0.3);
    for (int i = 0; i < n_strips; i += 7) {
        double s[3], near[3];
        const double x = 0.4 * l.ends[i] + 0.6 * l.ends[i + 1];
        stress_at(&l, x, 0.0, s);
        CHECK_REL(s[1], -l.p[i], 1e-13, "syy in strip %d", i);
        CHECK_REL(s[2], -l.q[i], 1e-13, "sxy in strip %d", i);
        stress_at(&l, x, 1e-12, near);
        for (int c = 0; c < 3; c++)
            CHECK_ABS(near[c], s[c], 1e-6, "limit from inside, strip %d, %d", i, c);
    }
    double s[3], end[3];
    stress_at(&l, 3.0, 0.0, s);
    CHECK_ABS(fabs(s[1]) + fabs(s[2]), 0.0, 1e-15, "outside the load");
    stress_at(&l, l.ends[200], 0.0, end);
    CHECK_REL(end[1], -0.5 * (l.p[199] + l.p[200]), 1e-12, "between two strips");
    assert_true(isfinite(end[0]));
}

/* The end of a strip sees half of it: under pressure alone all components are the mean of
 * both sides, sxx = syy = -p/2. */
TEST(the_end_of_a_strip_sees_half_of_it)
{
    const double ends[] = {-1.0, 2.0}, p[] = {3.0}, q[] = {0.0};
    for (int k = 0; k < 2; k++) {
        const double at[2] = {ends[k], 0.0};
        double s[3];
        CHECK_OK(
            rb_bem_halfplane_stress(&(rb_bem_edge_load){1, ends, p, q}, (rb_bem_points){1, at}, s));
        CHECK_REL(s[0], -1.5, 1e-14, "sxx at end %d", k);
        CHECK_REL(s[1], -1.5, 1e-14, "syy at end %d", k);
        CHECK_ABS(s[2], 0.0, 1e-14, "sxy at end %d", k);
    }
}

/* div s = 0 by central differences of order h^2 */
TEST(the_field_is_in_equilibrium)
{
    const load l = hertz(0.3);
    for (int k = 0; k < 40; k++) {
        const double x = -1.5 + 0.07 * k, y = 0.002 + 0.01 * k, h = 1e-4 * y;
        double e[3], w[3], n[3], s[3];
        stress_at(&l, x + h, y, e);
        stress_at(&l, x - h, y, w);
        stress_at(&l, x, y + h, n);
        stress_at(&l, x, y - h, s);
        CHECK_ABS((e[0] - w[0] + n[2] - s[2]) / (2 * h), 0.0, 1e-5 / y, "x, point %d", k);
        CHECK_ABS((e[2] - w[2] + n[1] - s[1]) / (2 * h), 0.0, 1e-5 / y, "y, point %d", k);
    }
}

/* Of many points the far ones are computed by a series, of a single one never. */
TEST(far_points_are_those_of_single_strips)
{
    enum { POINTS = 400 };
    const load l = hertz(0.3);
    double xy[2 * POINTS], s[3 * POINTS];
    for (int k = 0; k < POINTS; k++) { /* from a distance of 1.7 to one of 60 */
        const double r = 1.7 * pow(60.0 / 1.7, (k / 20) / 19.0), t = M_PI * (k % 20) / 19;
        xy[2 * k] = r * cos(t);
        xy[2 * k + 1] = fmax(r * sin(t), 0.0);
    }
    CHECK_OK(rb_bem_halfplane_stress(&(rb_bem_edge_load){n_strips, l.ends, l.p, l.q},
                                     (rb_bem_points){POINTS, xy}, s));
    for (int k = 0; k < POINTS; k++) {
        double one[3];
        stress_at(&l, xy[2 * k], xy[2 * k + 1], one);
        for (int c = 0; c < 3; c++)
            CHECK_ABS(s[3 * k + c], one[c], 1e-14, "(%g, %g), %d", xy[2 * k], xy[2 * k + 1], c);
    }
}

/* Tractions that are linear between nodes, with a jump, are a line load from far away. */
TEST(far_linear_tractions_are_a_line_load)
{
    const double nodes[] = {-1.0, 0.5, 0.5, 1.0}, p[] = {0.0, 2.0, 1.0, 0.0},
                 q[] = {0.0, 1.0, 3.0, 0.0}, P = 1.75, Q = 1.5;
    for (double r = 1e8; r < 1e302; r *= 1e7) {
        const double xy[2] = {-0.8 * r, 0.6 * r}, radial = -2 * (0.6 * P - 0.8 * Q) / (M_PI * r);
        double s[3];
        CHECK_OK(rb_bem_halfplane_stress_linear(&(rb_bem_edge_load){4, nodes, p, q},
                                                (rb_bem_points){1, xy}, s));
        CHECK_REL(s[0], 0.64 * radial, 1e-7, "sxx at %g", r);
        CHECK_REL(s[1], 0.36 * radial, 1e-7, "syy at %g", r);
        CHECK_REL(s[2], -0.48 * radial, 1e-7, "sxy at %g", r);
    }
}

/* A strip between ends 2 c apart in the third direction, on a half-space: Boussinesq's
 * and Cerruti's displacements, the third direction in closed form, x by midpoints. */
static double of_half_space(int tangential, double from, double to, double c)
{
    enum { POINTS = 2000 };
    const double nu = 0.28, h = (to - from) / POINTS;
    double sum = 0.0;
    for (int i = 0; i < POINTS; i++) {
        const double x = from + (i + 0.5) * h;
        const double one = 2.0 * asinh(c / x), other = 2.0 * c / hypot(x, c);
        sum += h * ((1.0 - nu) * one + (tangential ? nu * other : 0.0));
    }
    return sum * (1.0 + nu) / (M_PI * 210000.0);
}

/* In its middle: the plane's with w_N = 0 at the depth 2 c and w_T = 0 at
 * 2 c exp(nu/(1 - nu)). */
TEST(a_long_strip_has_two_datums)
{
    const double c = 500.0, ends[2] = {1.0, 3.0}, x = 0.0;
    rb_bem_surface body = rb_bem_halfplane(rb_bem_material_from_young(210000.0, 0.28), 2.0 * c);
    double W[4];
    body.datum_tangential = 2.0 * c * exp(0.28 / 0.72);
    CHECK_OK(rb_bem_surface_displacement(&body, 1, ends, 1, &x, W));
    CHECK_REL(W[0], of_half_space(0, 1.0, 3.0, c), 1e-5, "w_N under p");
    CHECK_REL(W[3], of_half_space(1, 1.0, 3.0, c), 1e-5, "w_T under q");
}

TEST(bad_input_and_short_memory)
{
    const double ends[] = {0, 1, 2}, back[] = {0, 1, 1}, one[] = {1, 1}, xy[] = {0.5, 1},
                 above[] = {0.5, -1}, nan[] = {0.5, NAN};
    double s[3];
    CHECK_STATUS(
        rb_bem_halfplane_stress(&(rb_bem_edge_load){0, ends, one, one}, (rb_bem_points){1, xy}, s),
        RB_EINVAL);
    CHECK_STATUS(
        rb_bem_halfplane_stress(&(rb_bem_edge_load){2, back, one, one}, (rb_bem_points){1, xy}, s),
        RB_EINVAL);
    CHECK_STATUS(
        rb_bem_halfplane_stress(&(rb_bem_edge_load){2, ends, one, one}, (rb_bem_points){-1, xy}, s),
        RB_EINVAL);
    CHECK_STATUS(rb_bem_halfplane_stress(&(rb_bem_edge_load){2, ends, one, one},
                                         (rb_bem_points){1, above}, s),
                 RB_EINVAL);
    CHECK_STATUS(
        rb_bem_halfplane_stress(&(rb_bem_edge_load){2, ends, one, one}, (rb_bem_points){1, nan}, s),
        RB_EINVAL);
    alloc_fail_after(0);
    CHECK_STATUS(
        rb_bem_halfplane_stress(&(rb_bem_edge_load){2, ends, one, one}, (rb_bem_points){1, xy}, s),
        RB_ENOMEM);
    alloc_succeed();
    CHECK_OK(
        rb_bem_halfplane_stress(&(rb_bem_edge_load){2, ends, one, one}, (rb_bem_points){0, xy}, s));
}

RUN_TESTS(NULL, NULL)
