/* Measured gaps: the spline through a table, its smoothing, and what is refused. */
#include "cases.h"
#include "check.h"
#include "profiles.h"
#include "solved.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

HELD_TYPE(rb_rolling_profile, rb_rolling_profile_free)
#define held_profile HELD(rb_rolling_profile)

/* A wheel of 460 mm under p0 = 1 GPa, a = 8 mm (examples/rail). */
static rb_rolling_case rail(void)
{
    rb_rolling_case rc = half_plane(RB_STEADY, 100);
    set(&rc, "young 210000 young-b 210000 poisson 0.3 poisson-b 0.3 radius 460 gap parabola "
             "load 12500 creep-ratio 0.4");
    return rc;
}

enum { MOST = 6001 };

/* The rail's parabola every `step` from `from` to `to`, with noise; how many points. */
static int tabulate(double from, double to, double step, double noise, unsigned long seed,
                    double *x, double *gap)
{
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    const int n = (int)lround((to - from) / step) + 1;
    gsl_rng_set(rng, seed);
    for (int i = 0; i < n; i++) {
        x[i] = from + step * i;
        gap[i] = x[i] * x[i] / 920.0 + gsl_ran_gaussian(rng, noise);
    }
    gsl_rng_free(rng);
    return n;
}

static double peak(const rb_rolling_case *rc)
{
    OWNED(rb_rolling_solution) s = solved(rc);
    return s.max_pressure;
}

static double x[MOST], gap[MOST];

/* p0 of the rail case on the tabulated parabola. */
static double tabulated_peak(int n, double noise)
{
    rb_rolling_case rc = rail();
    rb_rolling_profile *profile = profile_of(n, x, gap, noise);
    rc.gap = RB_GAP_TABLE;
    rc.profile = profile;
    const double p0 = peak(&rc);
    rb_rolling_profile_free(profile);
    return p0;
}

TEST(a_coarse_table_of_a_parabola_is_that_parabola)
{
    const rb_rolling_case rc = rail();
    const double want = peak(&rc);
    const double steps[] = {0.5, 1.0, 2.0}, offsets[] = {0.0, 0.13, 0.25};
    for (int k = 0; k < 9; k++) {
        const double step = steps[k / 3];
        const int n = tabulate(-30.0 + offsets[k % 3], 30.0, step, 0.0, 1, x, gap);
        CHECK_REL(tabulated_peak(n, 0.0), want, 1e-5, "every %g mm from %g", step, x[0]);
        CHECK_REL(tabulated_peak(n, 1e-3), want, 1e-5, "the same, smoothed");
    }
}

/* The potential contact of a tabulated parabola is the one of the parabola: where its gap
 * is less than at the edge of Hertz's contact, and as much beyond. */
TEST(a_table_of_a_parabola_has_its_zone)
{
    double ends[2][2];
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = rail();
        rb_rolling_profile *profile =
            profile_of(tabulate(-30.0, 30.0, 0.5, 0.0, 1, x, gap), x, gap, 0.0);
        set(&rc, "mesh uniform contact-elements 40");
        rc.gap = k ? RB_GAP_TABLE : RB_GAP_PARABOLA;
        rc.profile = profile;
        OWNED(rb_rolling_solution) s = solved(&rc);
        ends[k][0] = s.x[0] - 0.5 * s.h[0];
        ends[k][1] = s.x[s.n - 1] + 0.5 * s.h[s.n - 1];
        CHECK_REL(ends[k][1], 1.3 * rb_rolling_derive(&rc).half_width, 1e-3, "zone");
        rb_rolling_profile_free(profile);
    }
    CHECK_REL(ends[1][0], ends[0][0], 1e-3, "left end");
    CHECK_REL(ends[1][1], ends[0][1], 1e-3, "right end");
}

TEST(smoothing_takes_the_noise_away)
{
    const rb_rolling_case rc = rail();
    const double want = peak(&rc), noise = 2e-3, steps[] = {0.5, 0.5, 0.5, 0.1, 0.01};
    for (unsigned long k = 0; k < 5; k++) {
        const int n = tabulate(-30.0, 30.0, steps[k], noise, 7 + k, x, gap);
        CHECK_REL(tabulated_peak(n, noise), want, 0.01, "seed %lu", 7 + k);
        CHECK_REL(tabulated_peak(n, 3.0 * noise), want, 0.01, "three times the noise");
    }
    const int n = tabulate(-12.0, 30.0, 0.5, noise, 3, x, gap);
    CHECK_REL(tabulated_peak(n, noise), want, 0.01, "not centred");
}

/* The curve stays within the noise of the points, and a shape larger than the noise is
 * still there. */
TEST(smoothing_keeps_the_shape)
{
    const double noise = 1e-3;
    const int n = tabulate(-30.0, 30.0, 0.25, noise, 11, x, gap);
    double sum = 0.0, worst = 0.0;
    for (int i = 0; i < n; i++)
        gap[i] += 0.02 * exp(-0.5 * x[i] * x[i] / 9.0);
    held_profile *profile = profile_of(n, x, gap, noise);
    for (int i = 0; i < n; i++) {
        const double shape = x[i] * x[i] / 920.0 + 0.02 * exp(-0.5 * x[i] * x[i] / 9.0);
        const double got = rb_rolling_profile_gap(profile, x[i]);
        sum += (got - gap[i]) * (got - gap[i]);
        worst = fmax(worst, fabs(got - shape));
    }
    CHECK_REL(sqrt(sum / n), noise, 0.1, "distance from the points");
    CHECK_MAX(worst, 2.0 * noise, "distance from the shape");
}

/* A curve of mirrored points is the mirrored curve: the splines stand alike at both
 * ends. */
TEST(smoothing_does_not_know_left_from_right)
{
    enum { N = 40 };
    double u[2][N], g[2][N];
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (int i = 0; i < N; i++) {
        u[0][i] = -7.0 + 0.3 * i + 0.1 * gsl_rng_uniform(rng);
        g[0][i] = u[0][i] * u[0][i] / 90.0 + gsl_ran_gaussian(rng, 0.02);
        u[1][N - 1 - i] = -u[0][i];
        g[1][N - 1 - i] = g[0][i];
    }
    held_profile *one = profile_of(N, u[0], g[0], 0.015);
    held_profile *other = profile_of(N, u[1], g[1], 0.015);
    for (int i = 0; i < 3 * N; i++) {
        const double at = -8.0 + 0.12 * i;
        CHECK_REL(rb_rolling_profile_gap(other, -at), rb_rolling_profile_gap(one, at), 1e-8,
                  "x = %g", at);
    }
    gsl_rng_free(rng);
}

/* On points anywhere, also on uneven ones; beyond them straight on. */
TEST(the_spline_passes_through_its_points)
{
    const double u[] = {-3.0, -2.9, -1.0, 0.5, 4.0}, g[] = {2.0, 1.9, 0.3, 0.1, 3.0};
    double from, to;
    held_profile *profile = profile_of(5, u, g, 0.0);
    for (int i = 0; i < 5; i++)
        CHECK_ABS(rb_rolling_profile_gap(profile, u[i]), g[i], 1e-14, "point %d", i);
    rb_rolling_profile_range(profile, &from, &to);
    assert_true(from == -3.0 && to == 4.0);
    for (int side = -1; side < 2; side += 2) {
        const double end = side < 0 ? from : to;
        const double at_end = rb_rolling_profile_gap(profile, end);
        const double one = rb_rolling_profile_gap(profile, end + side) - at_end;
        const double step = rb_rolling_profile_gap(profile, end - 1e-6 * side) - at_end;
        CHECK_REL(rb_rolling_profile_gap(profile, end + 7.0 * side) - at_end, 7.0 * one, 1e-12,
                  "straight");
        CHECK_REL(one, -1e6 * step, 1e-4, "slope at the end");
    }
}

/* ---- Corners ----------------------------------------------------------------------- */

static double chamfered(double at)
{
    return 0.2 * fmax(0.0, fabs(at) - 2.0);
}

static double grooved(double at) /* walls of 0.1 mm */
{
    return at * at / 100.0 + 0.05 * fmin(fmax(5.0 - 10.0 * fabs(at), 0.0), 1.0);
}

static double cliff(double at)
{
    return at * at / 100.0 + 5.0 * fmin(fmax((at - 1.0) / 1e-3, 0.0), 1.0);
}

static double roof(double at)
{
    return 0.1 * fabs(at) + at * at / 100.0;
}

static double dented(double at)
{
    return at * at / 100.0 + 0.02 * exp(-0.5 * at * at / 0.04);
}

static double wavy(double at)
{
    return at * at / 100.0 + 0.01 * cos(2.0 * M_PI * (at + 0.037));
}

/* How much steeper the curve is behind a point. */
static double bend(const rb_rolling_profile *p, double at)
{
    const double e = 1e-6, g = rb_rolling_profile_gap(p, at);
    return (rb_rolling_profile_gap(p, at + e) - 2.0 * g + rb_rolling_profile_gap(p, at - e)) / e;
}

/* Rows wherever there is a multiple of the step, and at the ends of a steep wall. */
static int rows_of(double (*shape)(double), double step)
{
    int n = 0;
    for (double at = -4.0; at < 4.0 + 0.5 * step; at += step) {
        x[n] = at;
        gap[n] = shape(at);
        n++;
        if (shape == cliff && at <= 1.0 && at + step > 1.001) {
            x[n] = 1.001;
            gap[n] = shape(1.001);
            n++;
        }
    }
    return n;
}

/* Straight and smooth stretches stay what they are up to their corners, and what is smooth has
 * none: its slope changes from one side of a row to the other by what 1e-6 mm make of it. */
TEST(the_curve_breaks_at_corners_alone)
{
    static const struct {
        double (*shape)(double), step, error; /* error: of the smooth stretches between rows */
        double corner[2], bend[2];            /* NAN: none */
    } rows[] = {{chamfered, 2.0, 1e-12, {-2.0, 2.0}, {0.2, 0.2}},
                {chamfered, 0.5, 1e-12, {-2.0, 2.0}, {0.2, 0.2}},
                {chamfered, 0.1, 1e-12, {-2.0, 2.0}, {0.2, 0.2}},
                {grooved, 0.1, 3e-5, {-0.4, 0.5}, {-0.5, 0.5}},
                {grooved, 0.05, 1e-5, {0.4, -0.5}, {-0.5, 0.5}},
                {cliff, 0.25, 1e-4, {1.0, 1.001}, {5e3, -5e3}},
                {cliff, 0.01, 1e-6, {1.0, 1.001}, {5e3, -5e3}},
                {roof, 1.0, 1e-3, {0.0, NAN}, {0.2, NAN}},
                {roof, 0.1, 1e-5, {0.0, NAN}, {0.2, NAN}},
                {dented, 0.1, 2e-5, {NAN, NAN}, {NAN, NAN}},
                {wavy, 0.1, 2e-4, {NAN, NAN}, {NAN, NAN}},
                {wavy, 0.05, 5e-5, {NAN, NAN}, {NAN, NAN}}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        const int n = rows_of(rows[k].shape, rows[k].step);
        held_profile *p = profile_of(n, x, gap, 0.0);
        int corners = 0;
        for (int i = 0; i + 1 < n; i++)
            for (double t = 0.01; t < 1.0; t += 0.07) {
                const double at = x[i] + t * (x[i + 1] - x[i]);
                CHECK_ABS(rb_rolling_profile_gap(p, at), rows[k].shape(at), rows[k].error,
                          "row %zu, x = %g", k + 1, at);
            }
        for (int i = 1; i + 1 < n; i++)
            corners += fabs(bend(p, x[i])) > 1e-4;
        for (int j = 0; j < 2 && !isnan(rows[k].corner[j]); j++)
            CHECK_REL(bend(p, rows[k].corner[j]), rows[k].bend[j], 0.05, "row %zu, corner", k + 1);
        assert_int_equal(corners, isnan(rows[k].corner[0])   ? 0
                                  : isnan(rows[k].corner[1]) ? 1
                                  : rows[k].shape == grooved ? 4
                                                             : 2);
    }
}

/* Between rows that are too few to tell, or as many as tell, a chamfer is flat. */
TEST(a_chamfer_of_any_number_of_rows_has_its_corners)
{
    const double at[][7] = {{-4.0, -2.0, 2.0, 4.0},
                            {-4.0, -2.0, 0.0, 2.0, 4.0},
                            {-4.0, -3.0, -2.0, 2.0, 3.0, 4.0},
                            {-4.0, -3.0, -2.0, 0.0, 2.0, 3.0, 4.0}};
    for (int k = 0; k < 4; k++) {
        double of[7];
        for (int i = 0; i < 4 + k; i++)
            of[i] = chamfered(at[k][i]);
        held_profile *p = profile_of(4 + k, at[k], of, 0.0);
        for (double u = -5.0; u < 5.0; u += 0.03)
            CHECK_ABS(rb_rolling_profile_gap(p, u), chamfered(u), 1e-14, "%d rows, x = %g", 4 + k,
                      u);
    }
    for (int rows = 9; rows <= 65;
         rows += 4) { /* a row every 1 ... 1/8 mm, at the corners too or not */
        const int n = rows_of(chamfered, 8.0 / (rows - 1));
        held_profile *p = profile_of(n, x, gap, 0.0);
        for (double u = -1.0; u <= 1.0; u += 0.03)
            CHECK_ABS(rb_rolling_profile_gap(p, u), 0.0, 1e-12, "%d rows, x = %g", n, u);
        if ((rows - 1) % 8 == 0)
            CHECK_REL(bend(p, 2.0), 0.2, 1e-6, "%d rows", n);
    }
}

/* Coarse rows do not tell a corner from a bend: the curve keeps between them. */
TEST(what_is_flat_or_rises_stays_so)
{
    for (double step = 0.15; step < 1.9; step += 0.05) {
        const int n = rows_of(chamfered, step);
        held_profile *p = profile_of(n, x, gap, 0.0);
        for (int i = 1; i + 2 < n; i++)
            for (double t = 0.0; t <= 1.0; t += 0.05) {
                if (gap[i] < gap[i - 1] && gap[i + 1] < gap[i + 2]) /* a minimum in between */
                    continue;
                const double at = x[i] + t * (x[i + 1] - x[i]);
                const double g = rb_rolling_profile_gap(p, at);
                if (!(g >= fmin(gap[i], gap[i + 1]) - 1e-13 &&
                      g <= fmax(gap[i], gap[i + 1]) + 1e-13))
                    fail_msg("rows every %g mm: %g at x = %g, between %g and %g", step, g, at,
                             gap[i], gap[i + 1]);
            }
    }
}

/* Of a grooved roller, six rows of it and 81: it touches beside the groove only. */
TEST(a_groove_stays_open)
{
    static const double u[] = {-4.0, -0.51, -0.5, 0.5, 0.51, 4.0},
                        g[] = {0.16, 0.0026, 0.0525, 0.0525, 0.0026, 0.16};
    const double reach[] = {0.64, 0.9};
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = half_plane(RB_STATIC, 120);
        set(&rc, "young 210000 poisson 0.3 similar mu 0 load 1000");
        const int n = k ? rows_of(grooved, 0.1) : 6;
        held_profile *p = profile_of(n, k ? x : u, k ? gap : g, 0.0);
        rc.gap = RB_GAP_TABLE;
        rc.profile = p;
        OWNED(rb_rolling_solution) s = solved(&rc);
        assert_int_equal(s.patches, 2);
        CHECK_ABS(s.patch[1].from, 0.505, 0.01, "beside the groove");
        CHECK_REL(s.patch[1].to, reach[k], 0.01, "table %d", k + 1);
        CHECK_REL(s.patch[0].to, -s.patch[1].from, 1e-3, "both sides alike");
        const rb_rolling_note_list notes = rb_rolling_find_notes(&rc, &s);
        assert_non_null(strstr(notes.text[0], "has 4 corners, at x = -0.5"));
    }
}

/* Steep walls of an irregularity do not swing, and are no higher than in its table. */
TEST(an_irregularity_stays_within_its_table)
{
    static const double u[] = {-1.0, -0.5, -0.49, 0.49, 0.5, 1.0},
                        rise[] = {0.0, 0.0, 0.02, 0.02, 0.0, 0.0};
    rb_rolling_case rc = half_plane(RB_TRANSIENT, 1000);
    set(&rc, "gap parabola");
    rb_rolling_case smooth = rc;
    rc.irregularity = (rb_rolling_table){6, u, rise};
    rb_rolling_mesh mesh, without;
    CHECK_OK(rb_rolling_mesh_uniform(&rc, NULL, -1.2, 1.2, &mesh, &message));
    CHECK_OK(rb_rolling_mesh_uniform(&smooth, NULL, -1.2, 1.2, &without, &message));
    for (int i = 0; i < mesh.n; i++) {
        const double at = 0.5 * (mesh.ends[i] + mesh.ends[i + 1]),
                     high = mesh.gap[i] - without.gap[i];
        CHECK_ABS(high, 0.02 * fmin(fmax((0.5 - fabs(at)) / 0.01, 0.0), 1.0), 1e-12, "x = %g", at);
    }
    rb_rolling_mesh_free(&mesh);
    rb_rolling_mesh_free(&without);
}

static void check_refused(int n, const double *u, const double *g, double noise, const char *text)
{
    rb_rolling_profile *profile;
    CHECK_STATUS(rb_rolling_profile_create(n, u, g, noise, &profile, &message), RB_EINVAL);
    assert_null(profile);
    if (!strstr(message.text, text))
        fail_msg("'%s' does not say '%s'", message.text, text);
}

TEST(bad_tables_are_refused)
{
    const double u[] = {-1.0, 0.0, 1.0, 2.0}, g[] = {1.0, 0.0, 1.0, 2.0};
    const double twice[] = {-1.0, 0.0, 0.0, 2.0}, back[] = {2.0, 1.0, 0.0, -1.0};
    const double wrong_sign[] = {-1.0, 0.0, -1.0, -2.0}, flat[] = {1.0, 1.0, 1.0, 1.0};
    const double none[] = {1.0, 0.0, NAN, 1.0};
    const double far[] = {1e12, 1e12 + 1.0, 1e12 + 2.0, 1e12 + 3.0};
    check_refused(2, u, g, 0.0, "3 points");
    check_refused(4, twice, g, 0.0, "row 3: expected an x larger");
    check_refused(4, back, g, 0.0, "row 2: expected an x larger");
    check_refused(4, u, none, 0.0, "row 3: not a finite");
    check_refused(4, u, wrong_sign, 0.0, "row 4: the smallest gap, -2");
    check_refused(4, u, flat, 0.0, "the smallest gap, 1");
    check_refused(3, u + 1, g + 1, 0.0, "row 1: the smallest gap, 0");
    check_refused(4, u, g, -1.0, "smoothing");
    check_refused(4, u, g, NAN, "smoothing");
    check_refused(4, far, g, 1e-3, "x = 1e+12");
    for (int k = 0; k < 2; k++) { /* a stretch of so many times 1e-9 of where it lies */
        double near[4];
        for (int i = 0; i < 4; i++)
            near[i] = -1.0 + (k ? 1.1e-9 : 0.9e-9) * i / 3.0;
        if (k == 0)
            check_refused(4, near, g, 1e-3, "all points lie at x = -1");
        else
            rb_rolling_profile_free(profile_of(4, near, g, 1e-3));
    }
}

/* Under load and under approach, without rolling and with it, on half-planes and wheels:
 * a contact wider than the table is no result. */
TEST(contact_beyond_the_table_is_no_result)
{
    const int n = tabulate(-5.0, 5.0, 0.5, 0.0, 1, x, gap);
    rb_rolling_profile *profile = profile_of(n, x, gap, 0.0);
    for (int k = 0; k < 16; k++) {
        OWNED(rb_rolling_solution) s;
        rb_rolling_case rc = rail();
        rc.gap = RB_GAP_TABLE;
        rc.profile = profile;
        rc.contact_elements = 50;
        if (k & 1) {
            set(&rc, "load nan approach 0.34");
        }
        if (k & 2) {
            set(&rc, "formulation static creep-ratio nan");
        }
        if (k & 4)
            rc.mesh = RB_MESH_FITTED;
        if (k & 8)
            rc.a.support = RB_BEM_HUB;
        CHECK_SAYS(rb_rolling_solve(&rc, &s, &message), RB_ZONE, "from -5 to 5");
    }
    rb_rolling_profile_free(profile);
}

/* The spline's own library ends the program where its memory runs out, if it is let. */
TEST(every_failed_allocation_is_reported)
{
    const int n = tabulate(-30.0, 30.0, 0.5, 0.0, 1, x, gap);
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    for (int k = 0; k < 2; k++) {
        for (int count = 0, refused = 1; refused; count++) {
            rb_rolling_profile *profile;
            refused = REFUSED_FROM(
                count, rb_rolling_profile_create(n, x, gap, k ? 1e-3 : 0.0, &profile, NULL));
            rb_rolling_profile_free(profile);
        }
    }
    gsl_set_error_handler(handler);
}

RUN_TESTS(NULL, NULL)
