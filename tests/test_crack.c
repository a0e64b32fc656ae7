/* Cracks: stress intensities in tension, histories of closed cracks, passes of a contact
 * with and without friction, trapped fluid.  The numbers of edge cracks and passes come
 * from an independent discretisation (dislocations collocated with graded elements, 9
 * digits, and Galerkin at n = 40), those of the full plane from closed forms. */
#include "check.h"
#include "analysis/crack/crack_case.h"
#include "rolling/case/case.h"
#include "lcp/contact/contact.h"
#include "analysis/crack/crack.h"

#include <complex.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>

HELD_TYPE(rb_crack, rb_crack_free)
#define held_crack HELD(rb_crack)

enum { STRIPS = 100, STEPS = 121 };

static rb_crack *create(rb_crack_shape shape)
{
    rb_crack *c = NULL;
    CHECK_OK(rb_crack_create(&shape, &c, &message));
    return c;
}

static rb_crack_shape edge_crack(double angle, int n, double friction)
{
    return (rb_crack_shape){.path = rb_crack_straight(0.0, 0.0, 1.0, angle),
                            .elements = n,
                            .friction = friction,
                            .shear = 1.0,
                            .poisson = 0.3};
}

static rb_crack_shape closed_crack(int n, double friction)
{
    rb_crack_shape shape = edge_crack(90.0, n, friction);
    shape.path = rb_crack_straight(0.8, 0.8, 1.0, 0.0);
    shape.full_plane = 1;
    return shape;
}

/* ---- Tension ----------------------------------------------------------------------- */

static void in_tension(double angle, int n, double K[2])
{
    held_crack *c = create(edge_crack(angle, n, 0.1));
    const double x = 0.0;
    const rb_crack_passage passage = {.steps = 1, .x = &x, .passes = 1, .tension = 2.0};
    OWNED(rb_crack_history) h;
    CHECK_OK(rb_crack_pass(c, &passage, &h, NULL));
    K[0] = h.K_I[0] / (2.0 * sqrt(M_PI));
    K[1] = h.K_II[0] / (2.0 * sqrt(M_PI));
}

TEST(edge_cracks_in_tension)
{
    static const double reference[][3] = {{90, 1.12152226, 0.0},
                                          {75, 1.068546, 0.173807},
                                          {60, 0.920100, 0.305800},
                                          {45, 0.704910, 0.364491},
                                          {30, 0.462431, 0.336140}};
    for (size_t k = 0; k < sizeof reference / sizeof *reference; k++) {
        const double *want = reference[k];
        double K[3][2];
        for (int i = 0; i < 3; i++)
            in_tension(want[0], 20 << i, K[i]);
        for (int mode = 0; mode < 2; mode++) {
            const double extrapolated = (4.0 * K[2][mode] - K[1][mode]) / 3.0;
            CHECK_ABS(K[2][mode], want[1 + mode], 1e-4, "%g degrees, K %d", want[0], mode);
            CHECK_ABS(extrapolated, want[1 + mode], 2e-6, "%g degrees, K %d, limit", want[0], mode);
            if (want[0] < 90.0)
                CHECK_ABS((K[0][mode] - K[1][mode]) / (K[1][mode] - K[2][mode]), 4.0, 0.2,
                          "%g degrees: order 2", want[0]);
        }
    }
}

/* A larger crack is similar: K grows with the root of its length. */
TEST(length_is_the_only_scale)
{
    const double x = 0.0;
    const rb_crack_passage passage = {.steps = 1, .x = &x, .passes = 1, .tension = 1.0};
    double K[3][2];
    for (int k = 0; k < 3; k++) {
        const double length = pow(10.0, 4.0 * (k - 1));
        rb_crack_shape shape = edge_crack(60.0, 20, 0.1);
        OWNED(rb_crack_history) h;
        shape.path = rb_crack_straight(0.0, 0.0, length, 60.0);
        held_crack *c = create(shape);
        CHECK_OK(rb_crack_pass(c, &passage, &h, NULL));
        K[k][0] = h.K_I[0] / sqrt(length);
        K[k][1] = h.K_II[0] / sqrt(length);
    }
    for (int mode = 0; mode < 2; mode++) {
        CHECK_REL(K[0][mode], K[1][mode], 1e-11, "short, K %d", mode);
        CHECK_REL(K[2][mode], K[1][mode], 1e-11, "long, K %d", mode);
    }
}

/* A crack and its mirror image: K_I alike, K_II turned. */
TEST(mirror_images)
{
    double left[2], right[2];
    in_tension(50.0, 20, right);
    in_tension(130.0, 20, left);
    CHECK_REL(left[0], right[0], 1e-12, "K_I");
    CHECK_REL(left[1], -right[1], 1e-12, "K_II");
}

/* Far below the surface both tips have the closed form of the full plane; near it the
 * upper one has more. */
TEST(cracks_below_the_surface)
{
    const double x = 0.0, angle = 60.0 * M_PI / 180.0;
    const rb_crack_passage passage = {.steps = 1, .x = &x, .passes = 1, .tension = 1.0};
    for (int k = 0; k < 2; k++) {
        rb_crack_shape shape = edge_crack(60.0, 20, 0.0);
        OWNED(rb_crack_history) h;
        shape.path = rb_crack_straight(0.0, k ? 0.1 : 1e4, 2.0, 60.0);
        held_crack *c = create(shape);
        CHECK_OK(rb_crack_pass(c, &passage, &h, NULL));
        if (k == 0) {
            const double K_I = sin(angle) * sin(angle) * sqrt(M_PI),
                         K_II = sin(angle) * cos(angle) * sqrt(M_PI);
            CHECK_REL(h.K_I[0], K_I, 1e-6, "tip");
            CHECK_REL(h.K_I_upper[0], K_I, 1e-6, "upper end");
            CHECK_REL(h.K_II[0], K_II, 1e-6, "tip");
            CHECK_REL(h.K_II_upper[0], K_II, 1e-6, "upper end");
        } else {
            CHECK_MAX(1.1 * h.K_I[0], h.K_I_upper[0], "the end near the surface");
        }
    }
}

/* ---- Closed crack in the full plane ------------------------------------------------ */

/* The play operator: unit pressure, friction 0.3, a shear that goes back and forth. */
TEST(history_of_a_closed_crack)
{
    static const double tau[] = {.2, .5, .8, .6, .4, .1, -.3, -.5, 0, .2, .8},
                        want[] = {0, .2, .5, .5, .5, .4, 0, -.2, -.2, -.1, .5};
    double T[2 * 19], hat[19];
    held_crack *c = create(closed_crack(20, 0.3));
    OWNED(rb_crack_state) s;
    assert_int_equal(rb_crack_nodes(c), 19);
    rb_crack_places(c, NULL, NULL, hat, NULL, NULL);
    CHECK_OK(rb_crack_state_alloc(c, &s));
    for (size_t k = 0; k < sizeof tau / sizeof *tau; k++) {
        for (int j = 0; j < 19; j++) {
            T[j] = -hat[j];
            T[19 + j] = tau[k] * hat[j];
        }
        CHECK_OK(rb_crack_step(c, T, RB_CRACK_DRY, 0.0, 1.0, &s, NULL));
        CHECK_ABS(s.K_II / sqrt(M_PI_2), want[k], 1e-12, "step %zu", k);
        CHECK_ABS(s.K_II_upper / sqrt(M_PI_2), want[k], 1e-12, "step %zu", k);
        CHECK_ABS(s.K_I, 0.0, 1e-15, "step %zu", k);
        CHECK_MAX(s.residual, 1e-12, "step %zu", k);
    }
}

/* Strips of Hertz's pressure p0 = a = 1 whose mean pressures are exact; q = ratio p. */
typedef struct {
    double x[STRIPS + 1], p[STRIPS], q[STRIPS];
    rb_bem_edge_load load;
} hertz;

static double primitive(double x)
{
    return 0.5 * (x * sqrt(fmax(1.0 - x * x, 0.0)) + asin(fmin(fmax(x, -1.0), 1.0)));
}

static void set_hertz(double ratio, hertz *h)
{
    for (int i = 0; i <= STRIPS; i++)
        h->x[i] = -cos(M_PI * i / STRIPS);
    for (int i = 0; i < STRIPS; i++) {
        h->p[i] = (primitive(h->x[i + 1]) - primitive(h->x[i])) / (h->x[i + 1] - h->x[i]);
        h->q[i] = ratio * h->p[i];
    }
    h->load = (rb_bem_edge_load){STRIPS, h->x, h->p, h->q};
}

/* All of it slips: K_II is an integral of tau - mu sigma, 0.15965661352 by quadrature. */
TEST(sliding_under_a_contact)
{
    double error[3];
    hertz load;
    set_hertz(0.0, &load);
    for (int k = 0; k < 3; k++) {
        held_crack *c = create(closed_crack(20 << k, 0.1));
        const double x = 0.0;
        const rb_crack_passage passage = {
            .steps = 1, .x = &x, .loads = 1, .load = &load.load, .passes = 1};
        OWNED(rb_crack_history) h;
        CHECK_OK(rb_crack_pass(c, &passage, &h, NULL));
        error[k] = fabs(h.K_II[0]) - 0.15965661352;
    }
    CHECK_MAX(fabs(error[2]), 3e-5, "n = 80");
    CHECK_MAX(fabs(error[2]), 0.5 * fabs(error[1]), "n = 40, 80");
}

/* p_f = sigma + 4 G V_0/(pi (kappa + 1) a^2), K_I = (p_f - sigma) sqrt(pi a). */
TEST(trapped_in_the_full_plane)
{
    const double sigma = 0.7, volume = 0.02, a = 0.5, kappa = 3.0 - 4.0 * 0.3;
    const double want = sigma + 4.0 * volume / (M_PI * (kappa + 1.0) * a * a);
    double T[2 * 39] = {0}, hat[39];
    held_crack *c = create(closed_crack(40, 0.3));
    OWNED(rb_crack_state) s;
    rb_crack_places(c, NULL, NULL, hat, NULL, NULL);
    CHECK_OK(rb_crack_state_alloc(c, &s));
    for (int j = 0; j < 39; j++)
        T[j] = -sigma * hat[j];
    s.volume = volume;
    CHECK_OK(rb_crack_step(c, T, RB_CRACK_TRAPPED, 0.0, 1.0, &s, NULL));
    CHECK_REL(s.fluid_pressure, want, 2e-3, "pressure, of second order");
    CHECK_REL(s.K_I, (s.fluid_pressure - sigma) * sqrt(M_PI * a), 1e-12, "K_I");
    CHECK_ABS(s.K_II, 0.0, 1e-15, "K_II");
    double held = 0.0;
    for (int j = 0; j < 39; j++)
        held += s.D[j] * hat[j];
    CHECK_REL(held, volume, 1e-12, "volume");
}

/* ---- Load -------------------------------------------------------------------------- */

/* Nodal forces against the stress of bem, near the load and beyond the switch to the
 * series: the body below is the mirror image of the one above. */
TEST(stress_of_strips)
{
    enum { N = 8 };
    static const double at[] = {0.3, -2.9, 3.1, 40.0};
    hertz load;
    double mirrored[STRIPS];
    set_hertz(0.3, &load);
    for (int i = 0; i < STRIPS; i++)
        mirrored[i] = -load.q[i];
    for (size_t k = 0; k < sizeof at / sizeof *at; k++) {
        rb_crack_shape shape = edge_crack(0.0, N, 0.0);
        shape.path = rb_crack_straight(0.0, 0.5, 1e-6, 0.0); /* short: stress is constant */
        held_crack *c = create(shape);
        double T[2 * (N - 1)], hat[N - 1], places[2 * (N - 1)], stress[3 * (N - 1)];
        rb_crack_places(c, places, NULL, hat, NULL, NULL);
        for (int j = N - 2; j >= 0; j--) {
            places[2 * j] = places[j] - at[k];
            places[2 * j + 1] = 0.5;
        }
        const rb_bem_edge_load above = {STRIPS, load.x, load.p, mirrored};
        CHECK_OK(rb_bem_halfplane_stress(&above, (rb_bem_points){N - 1, places}, stress));
        CHECK_OK(rb_crack_load(c, &load.load, RB_CRACK_STRIPS, at[k], 0.0, T));
        for (int j = 0; j < N - 1; j++) {
            CHECK_ABS(T[j] / hat[j], stress[3 * j + 1], 1e-7, "syy, x = %g", at[k]);
            /* along t = +x: sigma_ns is sxy, which the mirror turns */
            CHECK_ABS(T[N - 1 + j] / hat[j], -stress[3 * j + 2], 1e-7, "sxy, x = %g", at[k]);
        }
    }
}

/* Slope dv/dx of the surface, times 2 G/(kappa + 1), of a crack with sliding and opening
 * D at nodes z and a tip: potentials of its dislocations (C2) again, by Gauss points. */
static double surface_slope(int n, const double complex *z, const double complex *D, double x)
{
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(24);
    const double shear = 1.0, kappa = 3.0 - 4.0 * 0.3;
    double slope = 0.0;
    for (int l = 0; l < n; l++)
        for (size_t i = 0; i < 24; i++) {
            double u, w;
            gsl_integration_glfixed_point(0.0, 1.0, i, &u, &w, rule);
            const double complex at = z[l] + u * (z[l + 1] - z[l]), c = x - conj(at),
                                 g = shear * (D[l] - D[l + 1]) / (I * M_PI * (kappa + 1.0));
            slope += w * cimag(g / (x - at) - (conj(g) + g) / c - conj(g) * (at - x) / (c * c));
        }
    gsl_integration_glfixed_table_free(rule);
    return slope;
}

/* Betti: the work of a strip's stress on the opening and sliding of a crack is what the
 * crack lifts the surface below the strip, times its pressure. */
TEST(betti)
{
    enum { N = 20 };
    const double x = 0.0, width = 0.3, left = 1.1, right = 2.9;
    const double compliance = (3.0 - 4.0 * 0.3 + 1.0) / 2.0; /* (kappa + 1)/(2 G) */
    const rb_crack_passage passage = {.steps = 1, .x = &x, .passes = 1, .tension = 1.0};
    const double ends[2] = {-0.5 * width, 0.5 * width}, unit = 1.0, none = 0.0;
    const rb_bem_edge_load strip = {1, ends, &unit, &none};
    double px[N], py[N], tx[N], ty[N], T[2][2 * N], work = 0.0, lift = 0.0;
    double complex z[N + 1], D[N + 1];
    OWNED(rb_crack_history) h;
    held_crack *c = create(edge_crack(60.0, N, 0.1));
    CHECK_OK(rb_crack_pass(c, &passage, &h, NULL));
    rb_crack_places(c, px, py, NULL, tx, ty);
    CHECK_OK(rb_crack_load(c, &strip, RB_CRACK_STRIPS, left, 0.0, T[0]));
    CHECK_OK(rb_crack_load(c, &strip, RB_CRACK_STRIPS, right, 0.0, T[1]));
    for (int j = 0; j < N; j++) {
        const double complex t = tx[j] + I * ty[j];
        z[j] = px[j] + I * py[j];
        D[j] = I * t * h.D[j] + t * h.D[N + j];
        work += (T[0][j] - T[1][j]) * h.D[j] + (T[0][N + j] - T[1][N + j]) * h.D[N + j];
    }
    z[N] = cexp(-I * M_PI / 3.0);
    D[N] = 0.0;
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(40);
    for (size_t i = 0; i < 40; i++) /* v(left + s) - v(right + s) over the strip */
        for (size_t k = 0; k < 40; k++) {
            double s, w, at, v;
            gsl_integration_glfixed_point(ends[0], ends[1], i, &s, &w, rule);
            gsl_integration_glfixed_point(right, left, k, &at, &v, rule);
            lift += w * v * compliance * surface_slope(N, z, D, at + s);
        }
    gsl_integration_glfixed_table_free(rule);
    CHECK_MAX(1e-2, fabs(work), "there is some");
    CHECK_REL(work, -lift, 1e-12, "Betti");
}

/* ---- Passes ------------------------------------------------------------------------ */

typedef struct {
    rb_crack_history h;
    rb_case_crack_summary s;
} pass;

/* Whether trapped fluid is that of the place where the mouth closes. */
static int located;

static void run(int n, double friction, double ratio, rb_crack_fluid fluid, int steps, int passes,
                pass *p)
{
    static double x[4 * STEPS];
    hertz load;
    set_hertz(ratio, &load);
    for (int k = 0; k < steps; k++)
        x[k] = -6.0 + 12.0 * k / (steps - 1);
    held_crack *c = create(edge_crack(30.0, n, friction));
    const rb_crack_passage passage = {.steps = steps,
                                      .x = x,
                                      .loads = 1,
                                      .load = &load.load,
                                      .passes = passes,
                                      .fluid = fluid,
                                      .locate_closing = located};
    CHECK_OK(rb_crack_pass(c, &passage, &p->h, NULL));
    p->s = rb_case_crack_summarise(&p->h, passes);
}

/* The table was made with 40 elements of the same kind, and is met to its digits and
 * those of STRIPS strips.  Of 20 elements the largest K_II is 2.6e-4 to 3.5e-4 away from
 * it, as second order says: from the limit of many elements four times as far as that
 * of 40. */
TEST(passes_of_a_contact)
{
    static const double reference[][11] = {
        {.1, 0, -.09154, .15226, .0002, -.02567, .03211, .15226, -.00518, -.09116, -.00617},
        {.3, 0, -.05491, .06401, 0, -.02366, -.00368, .06401, .06401, -.04651, -.00695},
        {.3, -.1, -.05736, .05546, .00485, -.03968, -.01912, .05546, .05546, -.02563, .00152}};
    static const int step[] = {45, 55, 65, 75, 80, 120};
    static const double off[] = {2.7e-4, 2.7e-4, 3.6e-4};
    const double unit = sqrt(M_PI);
    for (size_t k = 0; k < sizeof reference / sizeof *reference; k++) {
        const double *want = reference[k];
        double largest[3];
        for (int i = 0; i < 3; i++) {
            const int n = 20 << i;
            pass p;
            run(n, want[0], want[1], RB_CRACK_DRY, STEPS, 3, &p);
            largest[i] = p.s.K_II_max / unit;
            if (n == 40) {
                CHECK_ABS(p.s.K_II_min / unit, want[2], 3e-5, "K_II min");
                CHECK_ABS(p.s.K_II_max / unit, want[3], 3e-5, "K_II max");
                CHECK_ABS(p.s.K_I_max / unit, want[4], 5e-5, "K_I max");
                for (int m = 0; m < 6; m++)
                    CHECK_ABS(p.h.K_II[step[m]] / unit, want[5 + m], 3e-5, "K_II, step %d",
                              step[m]);
            }
            CHECK_MAX(p.s.pass_change, 1e-12, "shakedown: the third pass is the second");
            CHECK_MAX(p.s.residual, 1e-9, "residual");
            rb_crack_history_free(&p.h);
        }
        CHECK_ABS((largest[0] - largest[1]) / (largest[1] - largest[2]), 4.3, 1.0, "order 2");
        CHECK_ABS(fabs(largest[0] - want[3]), off[k], 0.06e-4, "as docs/crack.md says");
        CHECK_ABS(largest[0], (4.0 * largest[2] - largest[1]) / 3.0, 4.5e-4, "n = 20");
    }
}

/* A crack below the surface, which opens at its upper end and slides at both, under the
 * tractions of Carter: half of the contact sticks, mu 0.3, braked.  K/p0 of an
 * independent program (tests share nothing with it): 80 constant displacement
 * discontinuities, collocated; real fields of dislocations, the surface freed by
 * Flamant's solution integrated over it; active sets and projected Gauss-Seidel. */
TEST(below_the_surface_under_carter)
{
    static const struct {
        int step;
        double K_I_upper, K_II_upper, K_II;
    } want[] = {{50, 0.0, 0.036418, -0.009954},
                {60, 0.0, 0.322678, 0.244568},
                {70, 0.0, 0.293120, 0.413131},
                {83, 0.005122, -0.000879, 0.175429},
                {100, 0.019191, 0.003301, -0.050692}};
    double x[STEPS], most[2] = {0.0};
    hertz load;
    set_hertz(0.0, &load);
    for (int i = 0; i < STRIPS; i++) { /* the stick zone is that of a contact half as wide */
        const double h = load.x[i + 1] - load.x[i];
        const double stuck =
            0.25 * (primitive(2.0 * load.x[i + 1] - 1.0) - primitive(2.0 * load.x[i] - 1.0)) / h;
        load.q[i] = -0.3 * (load.p[i] - stuck);
    }
    for (int k = 0; k < STEPS; k++)
        x[k] = -6.0 + 0.1 * k;
    for (int n = 40; n <= 80; n += 40) {
        rb_crack_shape shape = edge_crack(30.0, n, 0.2);
        shape.path = rb_crack_straight(0.0, 0.4, 2.0, 30.0);
        shape.poisson = 0.1;
        held_crack *c = create(shape);
        const rb_crack_passage passage = {
            .steps = STEPS, .x = x, .loads = 1, .load = &load.load, .passes = 1};
        OWNED(rb_crack_history) h;
        CHECK_OK(rb_crack_pass(c, &passage, &h, NULL));
        for (size_t k = 0; k < sizeof want / sizeof *want; k++) {
            const int i = want[k].step;
            const double off[] = {h.K_I_upper[i] - want[k].K_I_upper,
                                  h.K_II_upper[i] - want[k].K_II_upper, h.K_II[i] - want[k].K_II};
            for (int m = 0; m < 3; m++)
                most[n / 40 - 1] = fmax(most[n / 40 - 1], fabs(off[m]));
        }
    }
    CHECK_MAX(most[0], 8e-4, "40 elements");
    CHECK_MAX(most[1], 0.3 * most[0], "80 elements: order 2");
    CHECK_ABS(most[0], 7.1e-4, 0.06e-4, "as docs/crack.md says");
    CHECK_ABS(most[1], 1.8e-4, 0.06e-4, "as docs/crack.md says");
}

/* From position to position by rb_crack_step, where what is trapped is the volume at the
 * last position with an open mouth; x grows.  Returns the largest K_I/(p0 sqrt(pi a)). */
static double by_steps(int n, int positions, const double *x, double *pressure)
{
    double T[2 * 80], most = 0.0;
    hertz load;
    OWNED(rb_crack_state) s;
    held_crack *c = create(edge_crack(30.0, n, 0.1));
    set_hertz(0.3, &load);
    CHECK_OK(rb_crack_state_alloc(c, &s));
    *pressure = 0.0;
    for (int k = 0; k < positions; k++) {
        CHECK_OK(rb_crack_load(c, &load.load, RB_CRACK_STRIPS, x[k], 0.0, T));
        CHECK_OK(rb_crack_step(c, T, RB_CRACK_TRAPPED, 0.0, 1.0, &s, NULL));
        most = fmax(most, s.K_I);
        *pressure = fmax(*pressure, s.fluid_pressure);
    }
    return most / sqrt(M_PI);
}

/* An independent program that knows positions alone. */
TEST(trapped_fluid_by_positions)
{
    static const double reference[][4] = {
        {10, 61, 0.332, 1.088}, {20, 121, 0.336, 1.104}, {40, 241, 0.337, 1.104}};
    double x[241], pressure;
    for (int k = 0; k < 3; k++) {
        const int positions = (int)reference[k][1];
        for (int i = 0; i < positions; i++)
            x[i] = -6.0 + 12.0 * i / (positions - 1);
        const double K_I = by_steps((int)reference[k][0], positions, x, &pressure);
        CHECK_ABS(K_I, reference[k][2], 6e-4, "K_I, case %d", k);
        CHECK_ABS(pressure, reference[k][3], 1e-3, "p_f, case %d", k);
        pass p;
        located = 0;
        run((int)reference[k][0], 0.1, 0.3, RB_CRACK_TRAPPED, positions, 1, &p);
        CHECK_ABS(p.s.K_I_max / sqrt(M_PI), reference[k][2], 6e-4, "K_I, pass %d", k);
        CHECK_ABS(p.s.fluid_pressure_max, reference[k][3], 1e-3, "p_f, pass %d", k);
        rb_crack_history_free(&p.h);
    }
}

/* A pass that locates where the mouth closes: K_I does not depend on the positions, is
 * that of many small steps, and converges with the elements. */
TEST(trapped_fluid)
{
    double x[600], pressure, K_I[3];
    int positions = 0;
    pass dry;
    located = 1;
    for (int k = 0; k < 3; k++) {
        pass p;
        run(20 << k, 0.1, 0.3, RB_CRACK_TRAPPED, 2 * STEPS - 1, 1, &p);
        K_I[k] = p.s.K_I_max / sqrt(M_PI);
        CHECK_ABS(p.s.fluid_pressure_max, 1.0909, k == 0 ? 3e-3 : 6e-4, "p_f, between positions");
        rb_crack_history_free(&p.h);
    }
    CHECK_ABS((K_I[0] - K_I[1]) / (K_I[1] - K_I[2]), 4.0, 1.2, "order 2");
    CHECK_ABS(K_I[2], 0.2724, 1.2e-3, "n = 80");
    for (int steps = STEPS; steps <= 4 * STEPS; steps *= 2) {
        pass p;
        run(40, 0.1, 0.3, RB_CRACK_TRAPPED, steps, 1, &p);
        CHECK_REL(p.s.K_I_max / sqrt(M_PI), K_I[1], 2e-3, "%d steps", steps);
        rb_crack_history_free(&p.h);
    }
    for (double at = -6.0; at < 0.5; positions++) { /* 1e-4 apart where the mouth closes */
        x[positions] = at;
        at += at > -0.99 && at < -0.98 ? 1e-4 : at > -1.04 && at < -0.97 ? 5e-3 : 0.05;
    }
    located = 0;
    CHECK_REL(by_steps(40, positions, x, &pressure), K_I[1], 5e-3, "by small steps");
    run(20, 0.1, 0.3, RB_CRACK_DRY, STEPS, 1, &dry);
    CHECK_MAX(dry.s.K_I_max / sqrt(M_PI), 0.05, "without fluid it hardly opens");
    rb_crack_history_free(&dry.h);
}

/* The pressure of the contact at the mouth acts on the faces: under it they are open. */
TEST(pressure_at_the_mouth)
{
    pass p;
    run(20, 0.1, 0.0, RB_CRACK_PRESSURE, STEPS, 1, &p);
    CHECK_REL(p.h.fluid_pressure[60], 1.0, 1e-3, "the contact stands on the mouth");
    CHECK_ABS(p.h.fluid_pressure[49], 0.0, 1e-15, "x = -1.1");
    CHECK_MAX(0.2, p.s.K_I_max / sqrt(M_PI), "it opens the crack");
    rb_crack_history_free(&p.h);
}

/* ---- Kinks ------------------------------------------------------------------------- */

/* A path with a vertex on its straight line is the straight crack, whatever the share of
 * quadrature and closed forms. */
TEST(a_kink_of_no_angle)
{
    const double x = 0.0;
    const rb_crack_passage passage = {.steps = 1, .x = &x, .passes = 1, .tension = 1.0};
    double K[2][2];
    for (int k = 0; k < 2; k++) {
        rb_crack_shape shape = edge_crack(50.0, 32, 0.1);
        OWNED(rb_crack_history) h;
        if (k == 1) {
            shape.path.pieces = 2;
            shape.path.x[2] = shape.path.x[1];
            shape.path.y[2] = shape.path.y[1];
            shape.path.x[1] *= 0.5;
            shape.path.y[1] *= 0.5;
        }
        held_crack *c = create(shape);
        CHECK_OK(rb_crack_pass(c, &passage, &h, NULL));
        K[k][0] = h.K_I[0];
        K[k][1] = h.K_II[0];
    }
    CHECK_REL(K[1][0], K[0][0], 1e-5, "K_I");
    CHECK_REL(K[1][1], K[0][1], 1e-5, "K_II");
}

/* Of a short kink at the tip of a crack that is opened alone, over its K_I before the
 * kink: the series of Amestoy and Leblond, Int. J. Solids Structures 29 (1992) 465, in
 * the angle over pi. */
static void series_of_kinks(double m, double *K_I, double *K_II)
{
    const double p = M_PI, p2 = p * p, p3 = p2 * p, p4 = p2 * p2, p5 = p4 * p, p6 = p4 * p2;
    const double opening[] = {1.0,
                              -3.0 * p2 / 8.0,
                              p2 - 5.0 * p4 / 128.0,
                              p2 / 9.0 - 11.0 * p4 / 72.0 + 119.0 * p6 / 15360.0,
                              5.07790,
                              -2.88312,
                              -0.0925,
                              2.996,
                              -4.059,
                              1.63,
                              4.1},
                 sliding[] = {p / 2.0,
                              -(4.0 * p / 3.0 + p3 / 48.0),
                              -2.0 * p / 3.0 + 13.0 * p3 / 30.0 - 59.0 * p5 / 3840.0,
                              -6.176023,
                              4.44112,
                              -1.5340,
                              -2.0700,
                              4.684,
                              -3.95,
                              -1.32};
    double power = 1.0;
    *K_I = *K_II = 0.0;
    for (int k = 0; k < 11; k++, power *= m * m) {
        *K_I += opening[k] * power;
        *K_II += k < 10 ? sliding[k] * power * m : 0.0;
    }
}

/* Uniform tension in all directions, so that no stress along the crack disturbs a short
 * kink: the nodal forces are the normals of the neighbouring elements. */
static void kinked(double degrees, double length, double *K_I, double *K_II)
{
    enum { N = 120 };
    const double w = degrees * M_PI / 180.0;
    rb_crack_shape shape = edge_crack(90.0, N, 0.0);
    double x[N + 1], y[N + 1], t_x[N], t_y[N], T[2 * (N - 1)];
    OWNED(rb_crack_state) s;
    shape.full_plane = 1;
    shape.path = (rb_crack_path){
        .pieces = 2, .x = {-2.0, 0.0, length * cos(w)}, .y = {0.0, 0.0, -length * sin(w)}};
    held_crack *c = create(shape);
    CHECK_OK(rb_crack_state_alloc(c, &s));
    rb_crack_places(c, x + 1, y + 1, NULL, t_x, t_y);
    x[0] = -2.0;
    y[0] = 0.0;
    x[N] = shape.path.x[2];
    y[N] = shape.path.y[2];
    for (int j = 0; j < N - 1; j++) { /* half of i times the chord */
        const double n_x = -0.5 * (y[j + 2] - y[j]), n_y = 0.5 * (x[j + 2] - x[j]);
        T[j] = -n_x * t_y[j] + n_y * t_x[j];
        T[N - 1 + j] = n_x * t_x[j] + n_y * t_y[j];
        /* the tangent of a node halves the angle between its two elements */
        const double before = atan2(y[j + 1] - y[j], x[j + 1] - x[j]);
        const double behind = atan2(y[j + 2] - y[j + 1], x[j + 2] - x[j + 1]);
        CHECK_ABS(atan2(t_y[j], t_x[j]), 0.5 * (before + behind), 1e-9, "tangent %d", j);
    }
    CHECK_OK(rb_crack_step(c, T, RB_CRACK_DRY, 0.0, 1.0, &s, NULL));
    *K_I = s.K_I / sqrt(M_PI);
    *K_II = fabs(s.K_II) / sqrt(M_PI);
}

TEST(kinks)
{
    static const double angles[] = {15.0, 30.0, 45.0, 60.0};
    for (size_t k = 0; k < sizeof angles / sizeof *angles; k++) {
        double want[2], long_kink[2], kink[2];
        series_of_kinks(angles[k] / 180.0, &want[0], &want[1]);
        kinked(angles[k], 0.02, &long_kink[0], &long_kink[1]);
        kinked(angles[k], 0.01, &kink[0], &kink[1]);
        for (int mode = 0; mode < 2; mode++)
            CHECK_ABS(2.0 * kink[mode] - long_kink[mode], want[mode], 1.5e-3,
                      "kink of %g degrees, K %d", angles[k], mode);
    }
}

/* Under K_I alone straight on, under K_II alone at 70.5 degrees with 2/sqrt(3) K_II; the
 * largest over the steps counts. */
TEST(directions)
{
    double x[3] = {0.0}, K_I[] = {2.0, 0.0, 0.0}, K_II[] = {0.0, 1.0, -1.5}, none[3] = {0.0};
    rb_crack_history h = {.n = 1,
                          .x = x,
                          .K_I = K_I,
                          .K_II = K_II,
                          .open_length = none,
                          .stick_length = none,
                          .fluid_pressure = none,
                          .residual = none};
    rb_case_crack_summary s = rb_case_crack_summarise(&h, 1);
    CHECK_REL(s.K_theta_max, 2.0, 1e-15, "mode I");
    CHECK_ABS(s.kink_angle, 0.0, 1e-15, "mode I");
    K_I[0] = 0.0;
    K_II[0] = 1.0;
    s = rb_case_crack_summarise(&h, 1);
    CHECK_REL(s.K_theta_max, 2.0 / sqrt(3.0), 1e-14, "mode II");
    CHECK_REL(s.kink_angle, -acos(1.0 / 3.0) * 180.0 / M_PI, 1e-14, "mode II");
    h.n = 3;
    s = rb_case_crack_summarise(&h, 1);
    CHECK_REL(s.K_theta_max, 1.5 * 2.0 / sqrt(3.0), 1e-14, "the largest");
    CHECK_REL(s.kink_angle, acos(1.0 / 3.0) * 180.0 / M_PI, 1e-14, "the largest");
}

/* ---- Refusals ---------------------------------------------------------------------- */

static void refuses(rb_crack_shape shape, const char *word)
{
    rb_crack *c = NULL;
    CHECK_STATUS(rb_crack_create(&shape, &c, &message), RB_EINVAL);
    assert_null(c);
    if (!strstr(message.text, word))
        fail_msg("'%s' does not say '%s'", message.text, word);
}

TEST(bad_input)
{
    rb_crack_shape shape = edge_crack(30.0, 20, 0.1);
    shape.elements = 2;
    refuses(shape, "2 elements");
    refuses(edge_crack(0.0, 20, 0.1), "outside the body");
    refuses(edge_crack(-30.0, 20, 0.1), "outside the body");
    refuses(edge_crack(180.0, 20, 0.1), "below 15 degrees");
    refuses(edge_crack(14.0, 20, 0.1), "below 15 degrees");
    refuses(edge_crack(30.0, 20, -0.1), "friction");
    shape = edge_crack(30.0, 20, 0.1);
    shape.path.pieces = RB_CRACK_PIECES + 1;
    refuses(shape, "pieces");
    shape = edge_crack(30.0, 20, 0.1);
    shape.path.x[1] = shape.path.y[1] = 0.0;
    refuses(shape, "no length");
    shape = edge_crack(30.0, 20, 0.1);
    shape.poisson = -1.0;
    refuses(shape, "Poisson");
    rb_crack_free(NULL);

    const double x = 0.0;
    OWNED(rb_crack_history) h;
    held_crack *c = create(closed_crack(10, 0.1));
    const rb_crack_passage none = {.steps = 0, .x = &x, .passes = 1},
                           wet = {.steps = 1, .x = &x, .passes = 1, .fluid = RB_CRACK_TRAPPED};
    CHECK_STATUS(rb_crack_pass(c, &none, &h, &message), RB_EINVAL);
    CHECK_SAYS(rb_crack_pass(c, &wet, &h, &message), RB_EINVAL, "mouth");
    /* flat elements are all pressed */
    const double ends[] = {-0.2, -0.1, 0.0, 0.1, 0.2}, gap[4] = {0.0}, p[4] = {1, 1, 1, 1};
    const double F[16] = {[0] = 0.1, [5] = 0.1, [10] = 0.1, [15] = 0.1};
    const rb_bem_edge_load load = {4, ends, p, gap};
    const rb_crack_wheel wheel = {4, ends, F, gap, 4, 0.4, 0.1};
    const rb_crack_passage pressed = {
        .steps = 1, .x = &x, .loads = 1, .load = &load, .passes = 1, .wheel = &wheel};
    CHECK_SAYS(rb_crack_pass(c, &pressed, &h, &message), RB_ZONE,
               "crack: step 1, contact at x = 0: the contact fills its elements");
}

TEST(no_memory)
{
    const double x = 0.0;
    const rb_crack_shape shape = edge_crack(30.0, 8, 0.1);
    hertz load;
    set_hertz(0.3, &load);
    const rb_crack_passage passage = {.steps = 1,
                                      .x = &x,
                                      .loads = 1,
                                      .load = &load.load,
                                      .passes = 1,
                                      .fluid = RB_CRACK_TRAPPED};
    int done = 0;
    for (int k = 0; k < 400 && !done; k++) {
        rb_crack *c = NULL;
        OWNED(rb_crack_history) h = {0};
        alloc_fail_after(k);
        rb_status s = rb_crack_create(&shape, &c, &message);
        if (s == RB_OK)
            s = rb_crack_pass(c, &passage, &h, &message);
        alloc_fail_after(-1);
        done = s == RB_OK;
        if (!done)
            CHECK_STATUS(s, RB_ENOMEM);
        rb_crack_free(c);
    }
    assert_true(done);
}

/* Asked so many times, no more. */
static int is_over(void *context)
{
    int *left = context;
    return (*left)-- <= 0;
}

/* A crack of many elements takes long: it can be stopped at each of them. */
TEST(a_crack_can_be_stopped_while_it_is_made)
{
    enum { ELEMENTS = 12 };
    const rb_crack_shape shape = edge_crack(30.0, ELEMENTS, 0.1);
    int times = 0, done = 0;
    for (; !done && times < 200; times++) {
        rb_crack *c = NULL;
        int left = times;
        const rb_interrupt before = rb_interrupt_by((rb_interrupt){is_over, &left});
        const rb_status s = rb_crack_create(&shape, &c, &message);
        rb_interrupt_by(before);
        done = s == RB_OK;
        if (!done) {
            CHECK_STATUS(s, RB_INTERRUPTED);
            assert_null(c);
        }
        rb_crack_free(c);
    }
    assert_true(done && times > 4 * ELEMENTS); /* two parts of two matrices */
}

RUN_TESTS(NULL, NULL)
