/* Edges, peaks and starts from the pressures of a state that is made up: what a power law
 * or a parabola gives exactly. */
#include "check.h"
#include "study/internal.h"

#include <gsl/gsl_math.h>
#include <string.h>

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
    m->state =
        (rb_contact_state){.n = N, .p = m->p, .q = m->q, .zone = m->zone, .delta = 1.0};
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

static void check_edges(const made_up *m, double from, double to, double tol,
                        const char *what)
{
    double got[2];
    rb_rolling_contact_edges(&m->rc, &m->mesh, &m->state, &got[0], &got[1]);
    CHECK_ABS(got[0], from, tol, "%s: left edge", what);
    CHECK_ABS(got[1], to, tol, "%s: right edge", what);
}

/* ---- Edges ------------------------------------------------------------------------- */

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
        /* where it is steep, the neighbour of the outermost element counts as disturbed
         */
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
    assert_int_equal(run.bounded, 1); /* misses the elements by more than one */
}

TEST(few_elements_end_at_their_ends)
{
    for (int n = 4; n <= 5; n++) {
        made_up m;
        make(&m);
        rb_rolling_run run;
        press(&m, 10.0, 10.0 + n, 0.5, 0.5, RB_ZONE_STICK);
        assert_true(rb_rolling_next_patch(&m.rc, &m.mesh, &m.state, 0, &run));
        assert_int_equal(run.bounded, n < 5);
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
    assert_int_equal(run.bounded, 1);
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

/* ---- Edges of aligned elements ----------------------------------------------------- */

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
        double p[3]; /* of the third, fourth and fifth element from the edge */
        double off;  /* of the edge, from the midpoint of the third */
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

/* ---- Peaks ------------------------------------------------------------------------- */

/* The parabola of p^2 is exact for Hertz's ellipse, wherever its peak lies. */
TEST(the_peak_is_hertzs)
{
    rb_rolling_model model = {0};
    made_up m;
    make(&m);
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
    m.p[9] = m.p[20] =
        5.0; /* neighbours without a fall: open elements are not looked at */
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

RUN_TESTS(NULL, NULL)
