/* Steady rolling of dissimilar half-planes under a given force, against a solution that
 * shares nothing with the program: tractions that are continuous and linear between
 * nodes, the slip at midpoints, and Panagiotopoulos' alternation of a normal contact
 * under given friction and a rolling one under given pressure, each by changing zones
 * until all hold. E* = P = R = 1. */
#include "solved.h"

#include <gsl/gsl_math.h>
#include <lapacke.h>
#include <string.h>

enum { NODES = 201 };

typedef struct {
    double E_a, nu_a, E_b, nu_b, mu, force_ratio;
} pair;

/* u ln|u| and its integral, 0 at 0 */
static double log_1(double u)
{
    return u == 0.0 ? 0.0 : u * log(fabs(u));
}

static double log_2(double u)
{
    return u == 0.0 ? 0.0 : 0.5 * u * u * log(fabs(u)) - 0.75 * u * u;
}

/* Integral of a hat of half-width h, from its middle to u. */
static double hat_integral(double u, double h)
{
    const double t = GSL_MIN(1.0, fabs(u) / h);
    return copysign(h * (t - 0.5 * t * t), u);
}

typedef struct {
    double x[NODES], h, mu, Q;
    double gap_p[NODES][NODES], gap_q[NODES][NODES]; /* of unit hats of p and q */
    double slip_p[NODES][NODES], slip_q[NODES][NODES];
    double p[NODES], q[NODES], approach, creepage;
    int touches[NODES], slides[NODES]; /* slides: the sign of q, 0 in stick */
} contact;

/* Johnson, Contact Mechanics, 2.3 and 7.1: the half-planes' surface displacements; k is
 * what the pressure stretches A more than B. */
static void set_up(contact *c, const pair *b)
{
    const double compliance = (1.0 - b->nu_a * b->nu_a) / b->E_a +
                              (1.0 - b->nu_b * b->nu_b) / b->E_b,
                 k = (1.0 - 2.0 * b->nu_a) * (1.0 + b->nu_a) / b->E_a -
                     (1.0 - 2.0 * b->nu_b) * (1.0 + b->nu_b) / b->E_b,
                 a = sqrt(4.0 * compliance / M_PI), h = 2.3 * a / (NODES - 1);
    memset(c, 0, sizeof *c);
    c->h = h;
    c->mu = b->mu;
    c->Q = b->force_ratio * b->mu;
    for (int i = 0; i < NODES; i++) {
        c->x[i] = h * (i - (NODES - 1) / 2);
        c->touches[i] = fabs(c->x[i]) < a;
        c->slides[i] = c->x[i] < 0.0 ? (b->force_ratio > 0.0 ? 1 : -1) : 0;
        for (int j = 0; j < NODES; j++) {
            const double u = h * (i - j), v = u + 0.5 * h;
            c->gap_p[i][j] = -2.0 * compliance / M_PI / h *
                             (log_2(u + h) - 2.0 * log_2(u) + log_2(u - h));
            c->gap_q[i][j] = k * hat_integral(u, h);
            c->slip_q[i][j] = 2.0 * compliance / M_PI / h *
                              (log_1(v + h) - 2.0 * log_1(v) + log_1(v - h));
            c->slip_p[i][j] = j == i || j == i + 1 ? 0.5 * k : 0.0;
        }
    }
}

/* sum of unknowns = total, matrix unknowns + side level = right, for the nodes listed. */
static double solve_nodes(contact *c, double matrix[NODES][NODES], double side,
                          const int *nodes, int m, const double *right, double total,
                          double *unknown)
{
    static double M[(NODES + 1) * (NODES + 1)], b[NODES + 1];
    lapack_int pivots[NODES + 1];
    for (int i = 0; i < m; i++) {
        for (int j = 0; j < m; j++)
            M[j * (m + 1) + i] = matrix[nodes[i]][nodes[j]];
        M[m * (m + 1) + i] = side;
        M[i * (m + 1) + m] = c->h;
        b[i] = right[nodes[i]];
    }
    M[m * (m + 1) + m] = 0.0;
    b[m] = total;
    assert_int_equal(
        LAPACKE_dgesv(LAPACK_COL_MAJOR, m + 1, 1, M, m + 1, pivots, b, m + 1), 0);
    for (int i = 0; i < m; i++)
        unknown[nodes[i]] = b[i];
    return b[m];
}

static double row(double matrix[NODES][NODES], int i, const double *traction)
{
    double sum = 0.0;
    for (int j = 0; j < NODES; j++)
        sum += matrix[i][j] * traction[j];
    return sum;
}

/* p and the approach under the friction that is given */
static void press(contact *c)
{
    for (int round = 0, changed = 1; changed; round++) {
        int nodes[NODES], m = 0;
        double right[NODES];
        assert_true(round < 100);
        for (int i = 0; i < NODES; i++) {
            right[i] = -0.5 * c->x[i] * c->x[i] - row(c->gap_q, i, c->q);
            c->p[i] = 0.0;
            if (c->touches[i])
                nodes[m++] = i;
        }
        c->approach = solve_nodes(c, c->gap_p, -1.0, nodes, m, right, 1.0, c->p);
        changed = 0;
        for (int i = 0; i < NODES; i++) {
            const double gap = row(c->gap_p, i, c->p) - right[i] - c->approach;
            const int touches =
                c->touches[i] ? c->p[i] > 0.0 : gap < -1e-12 * fabs(c->approach);
            changed += touches != c->touches[i];
            c->touches[i] = touches;
        }
    }
}

static double slip(contact *c, int i)
{
    return c->creepage + row(c->slip_p, i, c->p) + row(c->slip_q, i, c->q);
}

/* q and the creepage under the pressure that is given */
static void roll(contact *c)
{
    for (int round = 0, changed = 1; changed; round++) {
        int nodes[NODES], m = 0;
        double right[NODES], total = c->Q;
        assert_true(round < 200);
        for (int i = 0; i < NODES; i++) {
            c->q[i] = c->touches[i] ? c->mu * c->p[i] * c->slides[i] : 0.0;
            total -= c->q[i] * c->h;
            if (c->touches[i] && !c->slides[i])
                nodes[m++] = i;
        }
        for (int i = 0; i < NODES; i++)
            right[i] = -row(c->slip_p, i, c->p) - row(c->slip_q, i, c->q);
        c->creepage = solve_nodes(c, c->slip_q, 1.0, nodes, m, right, total, c->q);
        changed = 0;
        for (int i = 0; i < NODES; i++) {
            int slides = c->slides[i];
            if (!c->touches[i])
                continue;
            if (!slides && fabs(c->q[i]) > c->mu * c->p[i])
                slides = c->q[i] > 0.0 ? 1 : -1;
            else if (slides && slip(c, i) * slides > 1e-14)
                slides = 0;
            changed += slides != c->slides[i];
            c->slides[i] = slides;
        }
    }
}

static void alternate(contact *c)
{
    for (double before = INFINITY; fabs(c->creepage - before) > 1e-12;) {
        before = c->creepage;
        press(c);
        roll(c);
    }
}

static rb_rolling_case the_same(const pair *b)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.formulation = RB_STEADY;
    rc.a.support = rc.b.support = RB_BEM_HALFPLANE;
    rc.a.radius = rc.load = 1.0;
    rc.a.young = b->E_a;
    rc.a.poisson = b->nu_a;
    rc.elastic_b = 1;
    rc.b.young = b->E_b;
    rc.b.poisson = b->nu_b;
    rc.gap = RB_GAP_PARABOLA;
    rc.mu = b->mu;
    rc.force_ratio = b->force_ratio;
    rc.mesh = RB_MESH_FITTED;
    rc.contact_elements = 120;
    return rc;
}

static void compare(const pair *b, int k)
{
    static contact c;
    rb_rolling_case rc = the_same(b);
    rb_rolling_solution s = solved(&rc);
    const double a = s.hertz_half_width, small = 2e-3 * fmax(b->mu, 0.1) * a;
    double moment = 0.0, power = 0.0, from = INFINITY, to = -INFINITY;
    set_up(&c, b);
    alternate(&c);
    for (int i = 0; i < NODES; i++) {
        moment += c.p[i] * c.x[i] * c.h;
        if (i + 1 < NODES)
            power -= 0.5 * (c.q[i] + c.q[i + 1]) * slip(&c, i) * c.h;
        if (c.touches[i] && !c.slides[i]) {
            from = fmin(from, c.x[i]);
            to = fmax(to, c.x[i]);
        }
    }
    CHECK_REL(s.force_ratio, b->force_ratio, 1e-9, "force of pair %d", k);
    CHECK_ABS(s.creepage, c.creepage, small, "creepage of pair %d", k);
    CHECK_ABS(s.dissipation, power, 0.01 * power, "dissipation of pair %d", k);
    CHECK_ABS(s.resistance_moment, moment, 1e-4 * a, "moment of pair %d", k);
    CHECK_ABS(s.stick_from, from, 0.03 * a, "stick of pair %d begins", k);
    CHECK_ABS(s.stick_to, to, 0.03 * a, "stick of pair %d ends", k);
    rb_rolling_solution_free(&s);
}

static void given_forces_on_dissimilar_bodies(void **state)
{
    static const pair pairs[] = {
        {900.0, 0.1, 1e9, 0.3, 0.3, -0.5},    {900.0, 0.1, 1e9, 0.3, 0.3, 0.5},
        {900.0, 0.1, 1e9, 0.3, 0.05, -0.5},   {900.0, 0.1, 1e9, 0.3, 0.3, 1e-6},
        {700.0, 0.33, 2100., 0.28, 0.3, 0.9}, {2100., 0.28, 700.0, 0.0, 0.3, -0.2},
        {300.0, 0.45, 2e4, 0.1, 0.6, 0.99}};
    (void)state;
    for (size_t k = 0; k < sizeof pairs / sizeof *pairs; k++)
        compare(&pairs[k], (int)k);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_forces_on_dissimilar_bodies)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
