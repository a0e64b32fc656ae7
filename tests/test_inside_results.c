/* What src/rolling/solve keeps to itself, from states that are made up: edges and peaks, of
 * which a power law or a parabola gives the exact ones, powers, columns, temperatures. */
#include "cases.h"
#include "rolling/history/internal.h"
#include "rolling/results/columns.h"
#include "rolling/solve/patches.h"
#include "rolling/solve/power.h"
#include "solved.h"

#include <gsl/gsl_math.h>

/* ---- Heat -------------------------------------------------------------------------- */

TEST(the_warmest_place_is_a_vertex_in_contact)
{
    enum { N = 6 };
    const double x[N] = {0.0, 1.0, 2.0, 3.5, 4.0, 5.0};
    double t[N], value, at;
    int zone[N] = {0, 1, 1, 2, 2, 0};
    for (int i = 0; i < N; i++)
        t[i] = 90.0 - 2.0 * (x[i] - 2.3) * (x[i] - 2.3);
    rb_rolling_peak_temperature(N, x, zone, t, &value, &at);
    CHECK_REL(value, 90.0, 1e-13, "of a parabola");
    CHECK_REL(at, 2.3, 1e-13, "its place");
    zone[3] = 0; /* a neighbour that is open tells nothing */
    rb_rolling_peak_temperature(N, x, zone, t, &value, &at);
    CHECK_ABS(value, t[2], 0.0, "beside an open element");
    CHECK_ABS(at, 2.0, 0.0, "beside an open element");
    zone[3] = 2;
    zone[1] = 0;
    rb_rolling_peak_temperature(N, x, zone, t, &value, &at);
    CHECK_ABS(at, 2.0, 0.0, "beside an open element");
    t[0] = 500.0; /* open */
    t[4] = 100.0;
    zone[5] = 1;
    t[5] = 100.0;
    rb_rolling_peak_temperature(N, x, zone, t, &value, &at);
    assert_true(value > 100.0 && at > 4.0 && at < 5.0); /* the first of two */
    t[5] = 120.0;
    rb_rolling_peak_temperature(N, x, zone, t, &value, &at);
    CHECK_ABS(value, 120.0, 0.0, "at the end of the mesh");
    CHECK_ABS(at, 5.0, 0.0, "at the end of the mesh");
    zone[0] = 1;
    rb_rolling_peak_temperature(N, x, zone, t, &value, &at);
    CHECK_ABS(value, 500.0, 0.0, "at the other end");
    for (int i = 0; i < N; i++) {
        zone[i] = 1;
        t[i] = 7.0;
    }
    rb_rolling_peak_temperature(N, x, zone, t, &value, &at);
    CHECK_ABS(value, 7.0, 0.0, "equally warm");
    memset(zone, 0, sizeof zone);
    rb_rolling_peak_temperature(N, x, zone, t, &value, &at);
    assert_true(isnan(value) && isnan(at));
}

TEST(peclets_number_compares_speed_and_diffusion)
{
    const rb_rolling_heat steel = {.conductivity = 40.0, .heat_capacity = 4.0}, none = {0};
    CHECK_REL(rb_rolling_peclet(&steel, 500.0, 0.2), 500.0 * 0.2 / 20.0, 1e-15, "V a/2k");
    assert_true(isinf(rb_rolling_peclet(&none, 500.0, 0.2)));
}

/* (T3) Each step's heat H warms what has passed it since: 2 H sqrt(c/(pi V))/(b_A + b_B)
 * (sqrt(k+1) - sqrt(k)) after k steps, linear between midpoints, from elements alone. */
TEST(steps_warm_what_passes_them)
{
    enum { N = 8, STEPS = 9 };
    static const double lengths[] = {1.0, 2.0, 0.5, 0.7};
    for (int j = 0; j < 4; j++) {
        const double h = 0.1, c = lengths[j] * h, V = 500.0;
        rb_rolling_case rc = rolling_case("speed %g conductivity 40 heat-capacity 4 temperature 20 "
                                          "conductivity-b 10 heat-capacity-b 1 temperature-b 20",
                                          V);
        OWNED(rb_arena) memory = {0};
        rb_rolling_heat_track track = {.n = N, .h = h, .step = c};
        double q[N], lambda[N], t[N], heat[STEPS][N];
        const rb_contact_state moved = {.n = N, .q = q, .lambda = lambda};
        CHECK_OK(rb_rolling_heat_track_create(&rc, 5.0, &memory, &track, NULL));
        assert_int_equal(track.rows, (int)ceil(N / lengths[j]) + 1);
        const double unit = 2.0 * sqrt(c / (M_PI * V)) / (sqrt(160.0) + sqrt(10.0));
        for (int k = 0; k < STEPS; k++) {
            for (int i = 0; i < N; i++) {
                q[i] = -10.0 * (i + 1) - k;
                lambda[i] = 0.001 * (N - i) + 0.0001 * k * k;
                heat[k][i] = -q[i] * lambda[i] * V / c;
            }
            rb_rolling_heat_track_advance(&track);
            rb_rolling_heat_track_step(&rc, &moved, &track, t);
            for (int i = 0; i < N; i++) {
                double want = 20.0;
                for (int b = 0; b <= k; b++) { /* b steps ago it stood at place */
                    const double place = i + b * lengths[j];
                    const int left = (int)(place + 1e-9);
                    const double part = fmax(0.0, place - left);
                    double H = left < N ? (1.0 - part) * heat[k - b][left] : 0.0;
                    H += left + 1 < N ? part * heat[k - b][left + 1] : 0.0;
                    want += unit * H * (sqrt(b + 1.0) - sqrt(b));
                }
                CHECK_REL(t[i], want, 1e-9, "length %g, step %d, element %d", lengths[j], k, i);
            }
        }
    }
}

/* Where nothing rolls no heat is kept; along the depth only where heat is slow. */
TEST(a_track_is_refused_where_heat_runs_along)
{
    rb_rolling_case rc = rolling_case("speed 500");
    OWNED(rb_arena) memory = {0};
    rb_rolling_heat_track track = {.n = 8, .h = 0.1, .step = 0.0};
    rc.heat_a = (rb_rolling_heat){40.0, 4.0, 20.0}; /* V a/(2 k) = 25 a */
    CHECK_OK(rb_rolling_heat_track_create(&rc, 0.4, &memory, &track, &message));
    assert_int_equal(track.rows, 1);
    CHECK_SAYS(rb_rolling_heat_track_create(&rc, 0.399, &memory, &track, &message), RB_EINVAL,
               "V a/(2 diffusivity) >= 10");
    rc.heat_b = (rb_rolling_heat){400.0, 4.0, 20.0};
    CHECK_STATUS(rb_rolling_heat_track_create(&rc, 0.4, &memory, &track, &message), RB_EINVAL);
}

/* Equal temperatures beside the warmest element have no vertex. */
TEST(an_even_temperature_has_its_first_place)
{
    const double x[] = {-1.0, 0.0, 1.0, 2.0}, t[] = {5.0, 7.0, 7.0, 7.0};
    const int zone[] = {RB_ZONE_STICK, RB_ZONE_STICK, RB_ZONE_STICK, RB_ZONE_STICK};
    double value, at;
    rb_rolling_peak_temperature(4, x, zone, t, &value, &at);
    CHECK_REL(value, 7.25, 1e-12, "a vertex");
    CHECK_REL(at, 0.5, 1e-12, "in the middle of the two");
    rb_rolling_peak_temperature(3, x + 1, zone, t + 1, &value, &at);
    CHECK_ABS(value, 7.0, 0.0, "no vertex");
    CHECK_ABS(at, 0.0, 0.0, "the first place");
}

/* B takes as much heat as A where it is the same in all three; otherwise the surfaces are
 * equally warm where they touch. */
TEST(unlike_bodies_share_by_temperature)
{
    for (int k = 0; k < 4; k++) {
        rb_rolling_case rc = warm_sliding(RB_STEADY);
        rc.heat_b = rc.heat_a;
        rc.heat_b.heat_capacity *= k == 1 ? 2.0 : 1.0;
        rc.heat_b.temperature += k == 2 ? 10.0 : 0.0;
        rc.heat_b.conductivity *= k == 3 ? 2.0 : 1.0;
        OWNED(rb_rolling_solution) s = solved(&rc);
        int touch = 0;
        for (int i = 0; i < s.n; i++) {
            touch += s.zone[i] != RB_ZONE_SEPARATED;
            if (s.zone[i] != RB_ZONE_SEPARATED)
                CHECK_REL(s.temperature_b[i], s.temperature[i], 1e-9, "%d at %d", k, i);
        }
        assert_true(touch > 3);
        memset(s.zone, 0, (size_t)s.n * sizeof *s.zone); /* nowhere in contact */
        s.contact = 0;
        double power[100] = {0.0};
        assert_true(s.n <= 100 && RB_ZONE_SEPARATED == 0);
        struct rb_rolling_conduction *conduction = NULL;
        CHECK_OK(rb_rolling_steady_temperature(&rc, &s, power, power, &conduction, s.temperature,
                                               s.temperature_b, NULL, NULL, NULL));
        rb_rolling_conduction_free(conduction);
        for (int i = 0; i < s.n; i++) {
            CHECK_ABS(s.temperature[i], 0.0, 1e-12, "A away from B, %d at %d", k, i);
            CHECK_ABS(s.temperature_b[i], rc.heat_b.temperature, 1e-12, "B");
        }
    }
}

/* One contact of equal elements has a matrix of distances, which is solved without being
 * made; the same elements taken as fitted ones have it made. */
TEST(shares_of_equal_elements_are_those_of_any)
{
    rb_rolling_case rc = warm_sliding(RB_STEADY);
    set(&rc, "contact-elements 60 conductivity-b 7 heat-capacity-b 2 temperature-b 30");
    OWNED(rb_rolling_solution) s = solved(&rc);
    double power[200], t[4][200];
    assert_true(s.n <= 200 && s.contact > 20);
    for (int hole = 0; hole < 2; hole++) {
        if (hole) /* two contacts */
            s.contact -= s.zone[s.n / 2] != RB_ZONE_SEPARATED;
        s.zone[s.n / 2] = hole ? RB_ZONE_SEPARATED : s.zone[s.n / 2];
        for (int i = 0; i < s.n; i++)
            power[i] = s.zone[i] != RB_ZONE_SEPARATED ? 1.0 + 0.01 * i : 0.0;
        for (int k = 0; k < 2; k++) {
            rc.mesh = k ? RB_MESH_FITTED : RB_MESH_UNIFORM;
            struct rb_rolling_conduction *conduction = NULL;
            CHECK_OK(rb_rolling_steady_temperature(&rc, &s, power, power, &conduction, t[2 * k],
                                                   t[2 * k + 1], NULL, NULL, NULL));
            rb_rolling_conduction_free(conduction);
        }
        for (int i = 0; i < s.n; i++) {
            CHECK_REL(t[0][i], t[2][i], 1e-11, "A at %d, hole %d", i, hole);
            CHECK_REL(t[1][i], t[3][i], 1e-11, "B at %d, hole %d", i, hole);
            if (s.zone[i] != RB_ZONE_SEPARATED)
                CHECK_REL(t[0][i], t[1][i], 1e-11, "both at %d, hole %d", i, hole);
        }
    }
}

TEST(tracks_longer_than_memory_are_refused)
{
    rb_rolling_case rc = rolling_case("speed 1e6");
    OWNED(rb_arena) memory = {0};
    rb_rolling_heat_track track = {.n = 1000, .h = 1.0, .step = 1e-15};
    rc.heat_a = rc.heat_b = (rb_rolling_heat){.conductivity = 40.0, .heat_capacity = 3.5};
    CHECK_SAYS(rb_rolling_heat_track_create(&rc, 1.0, &memory, &track, &message), RB_EINVAL,
               "the heat of steps");
}

/* ---- Columns and sums -------------------------------------------------------------- */

TEST(columns_are_those_of_the_state)
{
    for (int k = 0; k < 3; k++) {
        rb_rolling_case rc = rolled_plane((rb_rolling_formulation)k);
        OWNED(rb_rolling_model) model;
        OWNED(rb_rolling_solution) s;
        on_its_like(&rc);
        CHECK_OK(rb_rolling_solve_model(&rc, &model, &s, NULL));
        const rb_contact_state *c = &model.state;
        const int n = s.n;
        double *w = rb_alloc(2 * (size_t)n + 2, 1), contact = 0.0, stick = 0.0;
        int loaded = 0, stuck = 0, first = -1, last = -1;
        assert_non_null(w);
        CHECK_OK(rb_rolling_displacement(&model.bodies, c->p, c->q, w));
        for (int i = 0; i < n; i++) {
            CHECK_ABS(s.p[i], c->p[i], 0.0, "p %d", i);
            CHECK_ABS(s.q[i], c->q[i], 0.0, "q %d", i);
            CHECK_ABS(s.shift[i], c->lambda[i], 0.0, "shift %d", i);
            CHECK_ABS(s.un[i], w[i], 0.0, "w_N %d", i);
            CHECK_ABS(s.ut[i], w[n + 1 + i], 0.0, "w_T %d", i);
            CHECK_ABS(s.gap[i], model.mesh.gap[i] + w[i] - c->delta, 1e-12, "gap %d", i);
            const double dx = model.bodies.f.x[i + 1] - model.bodies.f.x[i];
            const double slip = k == RB_STATIC   ? s.creepage - (w[n + 2 + i] - w[n + 1 + i]) / dx
                                : k == RB_STEADY ? c->lambda[i] / dx
                                                 : c->lambda[i] / model.problem.e_T[i];
            CHECK_ABS(s.slip[i], slip, 1e-15, "slip %d", i);
            loaded += c->zone[i] != RB_ZONE_SEPARATED;
            contact += c->zone[i] != RB_ZONE_SEPARATED ? s.h[i] : 0.0;
            if (c->zone[i] == RB_ZONE_STICK) {
                stuck++;
                stick += s.h[i];
                first = first < 0 ? i : first;
                last = i;
            }
        }
        assert_int_equal(s.contact, loaded);
        assert_int_equal(s.stick, stuck);
        assert_int_equal(s.slipping, loaded - stuck);
        assert_int_equal(s.yielding, -1);
        assert_true(stuck > 2);
        CHECK_REL(s.stick_length, stick, 1e-14, "stuck");
        CHECK_ABS(s.stick_from, model.mesh.ends[first], 0.0, "from");
        CHECK_ABS(s.stick_to, model.mesh.ends[last + 1], 0.0, "to");
        double all, stuck_length;
        rb_rolling_zone_lengths(n, s.zone, s.h, &all, &stuck_length);
        CHECK_REL(all, contact, 1e-14, "in contact");
        CHECK_REL(stuck_length, stick, 1e-14, "stuck");
        CHECK_REL(rb_rolling_longest_element(n, s.zone, s.h), s.h[0], 1e-9, "equal");
        if (k != RB_STATIC)
            assert_int_equal(s.slip_violations, 0);
        free(w);
    }
}

/* The support of a wheel holds the load; both wheels' elements are counted. */
TEST(a_support_holds_the_load)
{
    rb_rolling_case rc = with(rolled_plane(RB_STATIC), "support hub");
    rc.a.core_young = 1e3; /* not read: there is no cover */
    set(&rc, "outer-elements 60 contact-elements 16");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    rb_rolling_solution s = solution_of(&model);
    CHECK_ABS(s.support_balance, 0.0, 2e-2, "reaction");
    assert_true(s.support_balance != 0.0);
    assert_int_equal(s.boundary_elements, rb_bem_system_mesh(model.bodies.system_a)->n);
    assert_int_equal(s.hierarchical, 0);
    assert_true(isnan(s.datum));
    double t[2 * 64];
    rb_rolling_contact_tractions(&model, t);
    for (int i = 0; i < s.n; i++) {
        CHECK_REL(t[2 * i + 1], s.p[i], 1e-12, "vertical %d", i);
        CHECK_ABS(t[2 * i], s.q[i], 1e-12 * s.max_pressure, "horizontal %d", i);
    }
    rb_rolling_solution_free(&s);
    memset(model.state.p, 0, sizeof(double) * 16);
    s = solution_of(&model);
    assert_true(isnan(s.support_balance)); /* nothing to hold */
    rb_rolling_solution_free(&s);
}

/* Along normals that turn with the surface pressure and friction have both components. */
TEST(tilted_tractions_add_up_to_both_forces)
{
    rb_rolling_case rc = rolling_case("normals surface");
    rc.approach = 2.0; /* a wide contact */
    set(&rc, "mu 0.5 contact-elements 16");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    OWNED(rb_rolling_solution) s = solution_of(&model);
    double t[2 * 64], down = 0.0, along = 0.0;
    assert_true(s.n <= 64);
    rb_rolling_contact_tractions(&model, t);
    for (int i = 0; i < s.n; i++) {
        along += s.h[i] * t[2 * i];
        down += s.h[i] * t[2 * i + 1];
    }
    CHECK_REL(down, s.normal_load, 1e-12, "load");
    CHECK_REL(along, s.tangential_load, 1e-12, "force");
    double plain = 0.0;
    for (int i = 0; i < s.n; i++)
        plain += s.h[i] * s.p[i];
    CHECK_MAX(1e-4, fabs(down / plain - 1.0), "tilt");
}

/* ---- Patches ----------------------------------------------------------------------- */

enum { N = 40 };

typedef struct {
    rb_rolling_case rc;
    rb_rolling_mesh mesh;
    rb_contact_state state;
    double ends[N + 2], p[N], q[N];
    int zone[N];
} made_up;

/* Elements of length 1 from 0 on; similar half-planes, nothing touches. */
static void make(made_up *m)
{
    memset(m, 0, sizeof *m);
    m->rc = rb_rolling_case_defaults();
    m->rc.a.support = RB_BEM_HALFPLANE;
    m->rc.b = m->rc.a;
    m->rc.b.radius = INFINITY;
    m->rc.elastic_b = 1;
    for (int i = 0; i < N + 2; i++)
        m->ends[i] = i;
    m->mesh = (rb_rolling_mesh){.n = N, .ends = m->ends};
    m->state = (rb_contact_state){.n = N, .p = m->p, .q = m->q, .zone = m->zone, .delta = 1.0};
}

/* Pressure of the distance to either edge to the power of its exponent. */
static void press(made_up *m, double from, double to, double left, double right, int zone)
{
    for (int i = 0; i < N; i++) {
        const double x = i + 0.5;
        if (x <= from || x >= to)
            continue;
        m->p[i] = x < 0.5 * (from + to) ? pow(x - from, left) : pow(to - x, right);
        m->zone[i] = zone;
    }
}

static void check_edges(const made_up *m, double from, double to, double tol, const char *what)
{
    double got[2];
    rb_rolling_contact_edges(&m->rc, &m->mesh, &m->state, &got[0], &got[1]);
    CHECK_ABS(got[0], from, tol, "%s: left edge", what);
    CHECK_ABS(got[1], to, tol, "%s: right edge", what);
}

TEST(a_root_ends_where_it_ends)
{
    made_up m;
    make(&m);
    double from, to;
    rb_rolling_contact_edges(&m.rc, &m.mesh, &m.state, &from, &to);
    assert_true(isnan(from) && isnan(to));
    press(&m, 5.2, 30.7, 0.5, 0.5, RB_ZONE_STICK);
    check_edges(&m, 5.2, 30.7, 1e-12, "in stick");
    rb_rolling_run run = {.last = -1};
    assert_true(rb_rolling_next_patch(&m.rc, &m.mesh, &m.state, 0, &run));
    assert_int_equal(run.first, 5);
    assert_int_equal(run.last, 30);
    assert_int_equal(run.bounded, 0);
    assert_false(rb_rolling_next_patch(&m.rc, &m.mesh, &m.state, run.last + 1, &run));
}

/* (E1) beta of the bodies, q = -+mu p: 1/2 + side atan(beta q/p)/pi. */
TEST(slip_of_unlike_bodies_makes_edges_steep_or_flat)
{
    static const double friction[] = {0.4, -0.4, 2.0, -2.0};
    for (int k = 0; k < 4; k++) {
        made_up m;
        make(&m);
        m.rc.elastic_b = 0;
        const double beta = rb_rolling_derive(&m.rc).dundurs;
        const double turn = atan(beta * friction[k]) / M_PI;
        press(&m, 5.2, 30.7, 0.5 - turn, 0.5 + turn, RB_ZONE_SLIP_NEGATIVE);
        for (int i = 0; i < N; i++)
            m.q[i] = friction[k] * m.p[i];
        check_edges(&m, 5.2, 30.7, 1e-11, "in slip");
        /* where it is steep, the neighbour of the outermost element counts as disturbed */
        const int steep = turn < 0.0 ? 29 : 6;
        m.p[steep] *= 0.5 - fabs(turn) < 0.45 ? 1.01 : 1.0;
        m.q[steep] = friction[k] * m.p[steep];
        check_edges(&m, 5.2, 30.7, 1e-11, "disturbed");
    }
}

/* The outermost element does not count; a slip zone of one element neither. */
TEST(what_the_outermost_element_has_does_not_count)
{
    made_up m;
    make(&m);
    press(&m, 5.2, 30.7, 0.5, 0.5, RB_ZONE_STICK);
    m.rc.elastic_b = 0;
    m.p[5] *= 3.0;
    m.p[30] *= 0.1;
    m.zone[29] = m.zone[6] = RB_ZONE_SLIP_POSITIVE;
    m.q[29] = m.q[6] = 1.0;
    check_edges(&m, 5.2, 30.7, 1e-12, "disturbed");
}

/* An edge lies between the midpoints of the last loaded and of the first open element. */
TEST(an_edge_stays_between_its_elements)
{
    made_up m;
    make(&m);
    rb_rolling_run run;
    press(&m, 5.2, 30.7, 0.5, 0.5, RB_ZONE_STICK);
    m.p[31] = 0.1; /* the law ends at 30.7, before this element's midpoint */
    m.p[4] = 0.1;
    m.zone[31] = m.zone[4] = RB_ZONE_STICK;
    m.p[30] = sqrt(0.2);
    m.p[5] = sqrt(0.7);
    m.p[29] = sqrt(1.2);
    m.p[6] = sqrt(1.7);
    check_edges(&m, 4.5, 31.5, 1e-12, "inside");
    assert_true(rb_rolling_next_patch(&m.rc, &m.mesh, &m.state, 0, &run));
    assert_int_equal(run.bounded, 0); /* not by more than an element */

    make(&m);
    press(&m, 3.0, 33.0, 0.5, 0.5, RB_ZONE_STICK);
    for (int i = 0; i < 7; i++) /* open up to 7 and from 28 on */
        m.zone[i] = 0, m.p[i] = 0.0;
    for (int i = 28; i < N; i++)
        m.zone[i] = 0, m.p[i] = 0.0;
    check_edges(&m, 6.5, 28.5, 1e-12, "cut off");
    assert_true(rb_rolling_next_patch(&m.rc, &m.mesh, &m.state, 0, &run));
    assert_int_equal(run.bounded,
                     RB_LEFT_BOUNDED | RB_RIGHT_BOUNDED); /* misses the elements by more than one */
}

TEST(few_elements_end_at_their_ends)
{
    for (int n = 4; n <= 5; n++) {
        made_up m;
        make(&m);
        rb_rolling_run run;
        press(&m, 10.0, 10.0 + n, 0.5, 0.5, RB_ZONE_STICK);
        assert_true(rb_rolling_next_patch(&m.rc, &m.mesh, &m.state, 0, &run));
        assert_int_equal(run.bounded, n < 5 ? RB_LEFT_BOUNDED | RB_RIGHT_BOUNDED : 0);
        if (n < 5)
            check_edges(&m, 10.0, 14.0, 0.0, "four elements");
    }
    made_up m; /* pressure that does not fall towards the edge */
    make(&m);
    rb_rolling_run run;
    for (int i = 10; i < 20; i++) {
        m.p[i] = 1.0;
        m.zone[i] = RB_ZONE_STICK;
    }
    check_edges(&m, 10.0, 20.0, 0.0, "a flat pressure");
    assert_true(rb_rolling_next_patch(&m.rc, &m.mesh, &m.state, 0, &run));
    assert_int_equal(run.bounded, RB_LEFT_BOUNDED | RB_RIGHT_BOUNDED);
}

TEST(the_outer_edges_are_those_of_all_patches)
{
    made_up m;
    make(&m);
    press(&m, 2.2, 12.7, 0.5, 0.5, RB_ZONE_STICK);
    press(&m, 20.4, 37.6, 0.5, 0.5, RB_ZONE_STICK);
    check_edges(&m, 2.2, 37.6, 1e-12, "two patches");
}

/* Up to the end of the mesh, behind which there is no element. */
TEST(a_patch_may_reach_the_ends_of_the_mesh)
{
    made_up m;
    make(&m);
    press(&m, -0.2, N + 0.2, 0.5, 0.5, RB_ZONE_STICK);
    check_edges(&m, 0.0, N, 0.0, "cut off at the mesh");
    m.rc.mesh = RB_MESH_ALIGNED;
    for (int i = 0; i < N; i++)
        m.p[i] = sqrt((i + 0.5 + 0.2) * (N + 0.2 - i - 0.5));
    check_edges(&m, -0.2, N + 0.2, 0.01, "aligned, told by the pressure");
}

/* The parabola through p^2 of Hertz is exact but for the bias that its discretisation
 * has; a third body that is soft makes p itself smooth. */
TEST(aligned_edges_are_roots_of_a_parabola)
{
    for (int soft = 0; soft < 2; soft++)
        for (int k = 0; k < 3; k++) {
            made_up m;
            make(&m);
            m.rc.mesh = RB_MESH_ALIGNED;
            const double modulus = rb_rolling_derive(&m.rc).modulus;
            m.rc.interlayer_normal = (soft ? 4.01 : 3.99) / modulus;
            const double from = 5.2 - 0.1 * k, to = 30.7 + 0.1 * k;
            press(&m, from, to, 0.5, 0.5, RB_ZONE_STICK);
            for (int i = 0; i < N; i++) {
                const double square = (i + 0.5 - from) * (to - i - 0.5);
                if (m.zone[i])
                    m.p[i] = soft ? square : sqrt(square);
            }
            const double bias = soft ? 0.0 : 0.0076;
            check_edges(&m, from - bias, to + bias, 1e-12, "aligned");
        }
}

/* The root lies two to three elements beyond the third one: there the edge is, wherever
 * the pressure points; between the midpoints of the outermost and the open element. */
TEST(aligned_edges_stay_beside_their_element)
{
    static const struct {
        double p[3];                     /* of the third, fourth and fifth element from the edge */
        double off;                      /* of the edge, from the midpoint of the third */
    } rows[] = {{{1.0, 2.0, 3.0}, 2.0},  /* a line: its root is 1, too near */
                {{1.0, 1.2, 1.4}, 3.0},  /* 5, too far */
                {{1.0, 1.4, 1.8}, 2.5},  /* of a line */
                {{1.0, 2.25, 4.0}, 2.0}, /* a double root */
                {{12.0, 6.0, 2.0}, 2.5}, /* roots on the other side */
                {{3.0, 2.0, 3.0}, 2.5},  /* no root */
                {{2.0, 1.0, 0.5}, 2.5}}; /* no root on this side */
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        made_up m;
        make(&m);
        m.rc.mesh = RB_MESH_ALIGNED;
        m.rc.interlayer_normal = 10.0 / rb_rolling_derive(&m.rc).modulus;
        for (int i = 10; i < 30; i++) {
            m.p[i] = 1.0;
            m.zone[i] = RB_ZONE_STICK;
        }
        for (int j = 0; j < 3; j++)
            m.p[12 + j] = m.p[27 - j] = rows[k].p[j];
        check_edges(&m, 12.5 - rows[k].off, 27.5 + rows[k].off, 1e-12, "aligned");
    }
}

TEST(few_aligned_elements_follow_the_power_law)
{
    for (int n = 8; n <= 9; n++) {
        made_up m;
        double from, to;
        make(&m);
        m.rc.mesh = RB_MESH_ALIGNED;
        press(&m, 10.0, 10.0 + n, 0.5, 0.5, RB_ZONE_STICK);
        rb_rolling_contact_edges(&m.rc, &m.mesh, &m.state, &from, &to);
        if (n < RB_ROLLING_ALIGNED_LEAST)
            check_edges(&m, 10.0, 18.0, 1e-12, "eight: the power law");
        else /* p^2 is a line up to the middle */
            check_edges(&m, 10.0 - 0.0076, 19.0 + 0.0076, 1e-12, "nine: the parabola");
    }
}

/* The parabola of p^2 is exact for Hertz's ellipse, wherever its peak lies. */
TEST(the_peak_is_hertzs)
{
    rb_rolling_model model = {0};
    made_up m;
    double x[N];
    make(&m);
    for (int i = 0; i < N; i++)
        x[i] = i + 0.5;
    model.bodies.f.x = x;
    for (int k = 0; k < 5; k++) {
        const double at = 18.0 + 0.2 * k;
        for (int i = 0; i < N; i++) {
            const double square = 1.0 - gsl_pow_2((i + 0.5 - at) / 12.3);
            m.p[i] = square > 0.0 ? 700.0 * sqrt(square) : 0.0;
            m.zone[i] = square > 0.0 ? RB_ZONE_STICK : RB_ZONE_SEPARATED;
        }
        model.rc = &m.rc;
        model.mesh = m.mesh;
        model.state = m.state;
        CHECK_REL(rb_rolling_peak_pressure(&model), 700.0, 1e-12, "peak at %g", at);
    }
    /* at an end of the mesh and on a plateau it is the largest one */
    memset(m.p, 0, sizeof m.p);
    memset(m.zone, 0, sizeof m.zone);
    CHECK_ABS(rb_rolling_peak_pressure(&model), 0.0, 0.0, "without contact");
    m.p[0] = 3.0;
    m.p[1] = 2.0;
    m.zone[0] = m.zone[1] = RB_ZONE_STICK;
    m.p[N - 1] = 4.0;
    m.p[N - 2] = 1.0;
    m.zone[N - 1] = m.zone[N - 2] = RB_ZONE_STICK;
    CHECK_ABS(rb_rolling_peak_pressure(&model), 4.0, 0.0, "at the ends of the mesh");
    for (int i = 10; i < 20; i++) {
        m.p[i] = 5.0;
        m.zone[i] = RB_ZONE_STICK;
    }
    m.p[9] = m.p[20] = 5.0; /* neighbours without a fall: open elements are not looked at */
    CHECK_ABS(rb_rolling_peak_pressure(&model), 5.0, 0.0, "a plateau");
}

TEST(a_vertex_is_that_of_the_parabola)
{
    /* f(x) = 3 x - 2 x^2: highest at 0.75, 1.125 */
    static const double places[][2] = {{-1.0, 1.0}, {-0.5, 2.0}, {0.3, 0.9}};
    for (int k = 0; k < 3; k++) {
        const double *d = places[k];
        const double f[2] = {3 * d[0] - 2 * d[0] * d[0], 3 * d[1] - 2 * d[1] * d[1]};
        double rise = 0.0, at = 0.0;
        assert_int_equal(rb_rolling_vertex(d, f, &rise, &at), 1);
        CHECK_REL(rise, 1.125, 1e-13, "rise %d", k);
        CHECK_REL(at, 0.75, 1e-13, "place %d", k);
    }
    const double d[2] = {-1.0, 1.0}, line[2] = {-1.0, 1.0}, valley[2] = {1.0, 1.0};
    double rise, at;
    assert_int_equal(rb_rolling_vertex(d, line, &rise, &at), 0);
    assert_int_equal(rb_rolling_vertex(d, valley, &rise, &at), 0);
}

/* ---- Powers ------------------------------------------------------------------------ */

enum { FIVE = 5 };

static double shift[FIVE] = {0.3, -0.1, 0.0, 0.2, 0.7}, q[FIVE] = {1.0, -2.0, 3.0, 0.5, 4.0},
              h[FIVE] = {0.5, 0.25, 1.0, 2.0, 0.125}, slip[FIVE] = {0.1, 0.2, -0.3, 0.4, 0.5},
              e_T[FIVE] = {2.0, 3.0, 4.0, 5.0, 6.0};

TEST(steady_slip_lies_between_two_midpoints)
{
    const rb_rolling_solution s = {
        .n = FIVE, .shift = shift, .q = q, .h = h, .slip = slip, .formulation = RB_STEADY};
    rb_rolling_case rc = rolling_case("formulation steady");
    double power[FIVE], sum = 0.0;
    rb_rolling_friction_power(&s, power);
    for (int i = 0; i < FIVE; i++) {
        const double before = i > 0 ? shift[i - 1] : 0.0;
        CHECK_REL(power[i], -0.5 * (before + shift[i]) * q[i] / h[i], 1e-15, "%d", i);
        sum += power[i] * h[i];
    }
    CHECK_REL(rb_rolling_dissipated_power(&rc, FIVE, shift, q, h, e_T), sum, 1e-14, "all");
    CHECK_REL(sum, -0.5 * (0.3 * -1.0 + -0.1 * 1.0 + 0.2 * 4.5 + 0.7 * 4.0), 1e-14,
              "sum of lambda_i (q_i + q_i+1)/2");
}

/* Beside the edges the mean friction of an element in contact and an open one is no
 * friction of anything that slips. */
TEST(what_sticks_dissipates_nothing)
{
    double opens[FIVE] = {0.3, 0.0, 0.0, 0.0, -0.1}, sticks[FIVE] = {0.0, -2.0, 3.0, 0.5, 0.0};
    const rb_rolling_solution s = {
        .n = FIVE, .shift = opens, .q = sticks, .h = h, .slip = slip, .formulation = RB_STEADY};
    rb_rolling_case rc = rolling_case("formulation steady");
    double power[FIVE];
    rb_rolling_friction_power(&s, power);
    for (int i = 0; i < FIVE; i++)
        CHECK_ABS(power[i], 0.0, 0.0, "%d", i);
    CHECK_ABS(rb_rolling_dissipated_power(&rc, FIVE, opens, sticks, h, e_T), 0.0, 0.0, "D");
    CHECK_ABS(rb_rolling_slid_pressure(&rc, FIVE, opens, sticks, h, e_T), 0.0, 0.0, "wear");
}

TEST(other_slip_belongs_to_its_element)
{
    rb_rolling_solution s = {
        .n = FIVE, .shift = shift, .q = q, .h = h, .slip = slip, .formulation = RB_STEADY};
    rb_rolling_case rc = rb_rolling_case_defaults();
    double power[FIVE], want = 0.0;
    for (int i = 0; i < FIVE; i++)
        want -= shift[i] / e_T[i] * q[i] * h[i];
    s.slip_operator = RB_SLIP_SECOND;
    for (int k = 0; k < 2; k++) {
        rc.formulation = s.formulation = k ? RB_TRANSIENT : RB_STEADY;
        rc.slip_operator = s.slip_operator = k ? RB_SLIP_UPSTREAM : RB_SLIP_SECOND;
        rb_rolling_friction_power(&s, power);
        for (int i = 0; i < FIVE; i++)
            CHECK_REL(power[i], -slip[i] * q[i], 1e-15, "%d", i);
        CHECK_REL(rb_rolling_dissipated_power(&rc, FIVE, shift, q, h, e_T), want, 1e-14, "all");
    }
    rc.formulation = s.formulation = RB_STATIC;
    rb_rolling_friction_power(&s, power);
    for (int i = 0; i < FIVE; i++)
        assert_true(isnan(power[i]));
    assert_true(isnan(rb_rolling_dissipated_power(&rc, FIVE, shift, q, h, e_T)));
}

TEST(elastic_bodies_lose_nothing)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    const rb_rolling_model model = {.rc = &rc};
    double power;
    CHECK_OK(rb_rolling_hysteresis(&model, &power));
    assert_true(isnan(power)); /* static */
    rc.formulation = RB_STEADY;
    CHECK_OK(rb_rolling_hysteresis(&model, &power));
    CHECK_ABS(power, 0.0, 0.0, "steady");
}

RUN_TESTS(NULL, NULL)
