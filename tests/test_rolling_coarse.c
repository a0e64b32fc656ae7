/* The start of a fine solution from a coarse one that is made up. */
#include "check.h"
#include "study/internal.h"

#include <string.h>

enum { COARSE = 8, FINE = 24 };

typedef struct {
    rb_rolling_mesh mesh;
    rb_contact_state state;
    double ends[FINE + 2], p[FINE], q[FINE];
    int zone[FINE];
} line;

/* Elements of length h from 0 on. */
static void make(line *l, int n, double h)
{
    memset(l, 0, sizeof *l);
    for (int i = 0; i < n + 2; i++)
        l->ends[i] = i * h;
    l->mesh = (rb_rolling_mesh){.n = n, .ends = l->ends};
    l->state = (rb_contact_state){.n = n, .p = l->p, .q = l->q, .zone = l->zone};
}

static rb_rolling_case plane(void)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a.support = RB_BEM_HALFPLANE;
    return rc;
}

/* Three fine elements in each coarse one: its middle has its values, the others lie on
 * the line to its neighbour; beyond the outermost midpoints they stay. */
TEST(tractions_are_linear_between_midpoints)
{
    line coarse, fine;
    const rb_rolling_case rc = plane();
    make(&coarse, COARSE, 3.0);
    make(&fine, FINE, 1.0);
    for (int j = 0; j < COARSE; j++) {
        coarse.p[j] = 6.0 + j * j;
        coarse.q[j] = j % 2 ? 3.0 : -3.0;
        coarse.zone[j] = RB_ZONE_STICK;
    }
    coarse.state.delta = 0.4;
    coarse.state.xi = 0.05;
    rb_rolling_start_from(&rc, &coarse.mesh, &coarse.state, &fine.mesh, &fine.state);
    for (int i = 0; i < FINE; i++) {
        const int j = i / 3, other = i % 3 == 0 ? j - 1 : i % 3 == 2 ? j + 1 : j;
        const int to = other < 0 || other == COARSE ? j : other;
        CHECK_REL(fine.p[i], coarse.p[j] + (coarse.p[to] - coarse.p[j]) / 3.0, 1e-14,
                  "p of %d", i);
        CHECK_REL(fine.q[i], coarse.q[j] + (coarse.q[to] - coarse.q[j]) / 3.0, 1e-14,
                  "q of %d", i);
    }
    CHECK_ABS(fine.state.delta, 0.4, 0.0, "approach");
    CHECK_ABS(fine.state.xi, 0.05, 0.0, "creepage");
}

/* A coarse contact of elements first ... last, whose p^2 falls linearly to the edges,
 * slips left of x = 12 and sticks right of it; a fine line for its start. */
static void make_contact(line *coarse, line *fine, int first, int last,
                         const double edge[2], int slip)
{
    make(coarse, COARSE, 3.0);
    make(fine, FINE, 1.0);
    for (int j = first; j <= last; j++) {
        const double x = 3.0 * j + 1.5;
        coarse->p[j] = sqrt(x < 12.0 ? x - edge[0] : edge[1] - x);
        coarse->zone[j] = j < 4 ? slip : RB_ZONE_STICK;
    }
}

/* Zones are those of the coarse element within its edges, which lie between midpoints:
 * there an open element takes the zone of its loaded neighbour. */
TEST(zones_end_at_the_coarse_edges)
{
    line coarse, fine;
    const rb_rolling_case rc = plane();
    double from, to;
    /* open elements reach to 6 and from 18 on */
    make_contact(&coarse, &fine, 2, 5, (double[]){4.9, 20.3}, RB_ZONE_SLIP_NEGATIVE);
    coarse.p[1] = coarse.p[6] = 0.0;
    /* five elements and more have edges of their own */
    coarse.zone[6] = RB_ZONE_SEPARATED;
    rb_rolling_contact_edges(&rc, &coarse.mesh, &coarse.state, &from, &to);
    CHECK_ABS(from, 6.0, 0.0, "four elements end at their ends");
    rb_rolling_start_from(&rc, &coarse.mesh, &coarse.state, &fine.mesh, &fine.state);
    for (int i = 0; i < FINE; i++)
        assert_int_equal(fine.zone[i], i < 6    ? RB_ZONE_SEPARATED
                                       : i < 12 ? RB_ZONE_SLIP_NEGATIVE
                                       : i < 18 ? RB_ZONE_STICK
                                                : RB_ZONE_SEPARATED);
}

/* Elements of a fine line that is wider than the coarse one are open, and have the
 * tractions of its last element on their side. */
TEST(nothing_is_known_beyond_the_coarse_line)
{
    const rb_rolling_case rc = plane();
    line *coarse = calloc(1, sizeof *coarse);
    double *ends = rb_alloc(COARSE + 2, 1), *p = rb_alloc(COARSE, 1);
    int *zone = rb_alloc_int(COARSE);
    line fine;
    assert_true(coarse && ends && p && zone);
    make(coarse, COARSE, 3.0);
    make(&fine, FINE, 2.0); /* from -12 to 36 over 0 to 24 */
    for (int i = 0; i < FINE + 2; i++)
        fine.ends[i] -= 12.0;
    for (int j = 0; j < COARSE; j++) {
        p[j] = 1.0 + j;
        zone[j] = RB_ZONE_STICK;
    }
    memcpy(ends, coarse->ends, (COARSE + 2) * sizeof *ends);
    coarse->mesh.ends = ends; /* arrays of their own end where they end */
    coarse->state.p = coarse->state.q = p;
    coarse->state.zone = zone;
    rb_rolling_start_from(&rc, &coarse->mesh, &coarse->state, &fine.mesh, &fine.state);
    for (int i = 0; i < FINE; i++) {
        if (i >= 6 && i < 18)
            continue;
        assert_int_equal(fine.zone[i], RB_ZONE_SEPARATED);
        CHECK_ABS(fine.p[i], i < 6 ? 1.0 : COARSE, 0.0, "p of %d", i);
    }
    free(zone);
    free(p);
    free(ends);
    free(coarse);
}

TEST(open_elements_inside_the_edges_join_their_neighbour)
{
    line coarse, fine;
    const rb_rolling_case rc = plane();
    double from, to;
    /* the edges lie in open elements */
    make_contact(&coarse, &fine, 1, 6, (double[]){2.2, 21.8}, RB_ZONE_SLIP_POSITIVE);
    rb_rolling_contact_edges(&rc, &coarse.mesh, &coarse.state, &from, &to);
    CHECK_ABS(from, 2.2, 1e-12, "in the open element");
    CHECK_ABS(to, 21.8, 1e-12, "in the open element");
    rb_rolling_start_from(&rc, &coarse.mesh, &coarse.state, &fine.mesh, &fine.state);
    for (int i = 0; i < FINE; i++)
        assert_int_equal(fine.zone[i], i < 2    ? RB_ZONE_SEPARATED
                                       : i < 12 ? RB_ZONE_SLIP_POSITIVE
                                       : i < 22 ? RB_ZONE_STICK
                                                : RB_ZONE_SEPARATED);
    coarse.zone[3] = RB_ZONE_SEPARATED; /* a gap inside: of both the left neighbour */
    coarse.zone[4] = RB_ZONE_SLIP_NEGATIVE;
    rb_rolling_start_from(&rc, &coarse.mesh, &coarse.state, &fine.mesh, &fine.state);
    assert_int_equal(fine.zone[10], RB_ZONE_SLIP_POSITIVE);
}

TEST(a_quarter_of_the_elements_or_40_start)
{
    assert_int_equal(rb_rolling_coarse_elements(0), 40);
    assert_int_equal(rb_rolling_coarse_elements(4 * RB_ROLLING_TRANSFORMS - 1), 40);
    assert_int_equal(rb_rolling_coarse_elements(4 * RB_ROLLING_TRANSFORMS),
                     RB_ROLLING_TRANSFORMS);
    assert_int_equal(rb_rolling_coarse_elements(40000), 10000);
}

RUN_TESTS(NULL, NULL)
