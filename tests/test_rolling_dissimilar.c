/* Rolling of dissimilar half-planes under a given force, steady and from rest, against a
 * solution that shares nothing with the program: tractions that are continuous and linear
 * between nodes, and Panagiotopoulos' alternation of a normal contact under given
 * friction and a rolling one under given pressure, each by changing zones until all hold.
 * P = R = 1. */
#include "cases.h"
#include "solved.h"

#include <gsl/gsl_math.h>
#include <lapacke.h>

enum { NODES = 201 }; /* at most */

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

/* Of half-planes (Johnson, Contact Mechanics, 2.3 and 7.1). */
typedef struct {
    double compliance; /* 1/E* */
    double k;          /* what pressure stretches A more than B */
} surface;

/* slip = side creepage + known + slip_p p + slip_q q: a velocity over the rolling one, at
 * the midpoint upstream of a node, or what a particle slides in a step, at the node. */
typedef struct {
    int n;
    surface s;
    double x[NODES], h, mu, Q, a;
    double gap_p[NODES][NODES], gap_q[NODES][NODES]; /* of unit hats of p and q */
    double slip_p[NODES][NODES], slip_q[NODES][NODES], known[NODES], side;
    double p[NODES], q[NODES], approach, creepage;
    int touches[NODES], slides[NODES]; /* slides: the sign of q, 0 in stick */
} contact;

static surface surface_of(const pair *b)
{
    return (surface){(1.0 - b->nu_a * b->nu_a) / b->E_a + (1.0 - b->nu_b * b->nu_b) / b->E_b,
                     (1.0 - 2.0 * b->nu_a) * (1.0 + b->nu_a) / b->E_a -
                         (1.0 - 2.0 * b->nu_b) * (1.0 + b->nu_b) / b->E_b};
}

/* Displacement by a hat of half-width h along itself, at u from its middle; across itself
 * it is k times the hat's integral: w_N of friction, less w_T of pressure. */
static double displacement(surface s, double u, double h)
{
    return -2.0 * s.compliance / M_PI / h * (log_2(u + h) - 2.0 * log_2(u) + log_2(u - h));
}

static double slope(surface s, double u, double h)
{
    return -2.0 * s.compliance / M_PI / h * (log_1(u + h) - 2.0 * log_1(u) + log_1(u - h));
}

static void set_up(contact *c, const pair *b, int nodes)
{
    const surface s = surface_of(b);
    memset(c, 0, sizeof *c);
    c->s = s;
    c->n = nodes;
    c->a = sqrt(4.0 * s.compliance / M_PI);
    c->h = 2.3 * c->a / (nodes - 1);
    c->mu = b->mu;
    c->Q = b->force_ratio * b->mu;
    for (int i = 0; i < nodes; i++) {
        c->x[i] = c->h * (i - (nodes - 1) / 2);
        c->touches[i] = fabs(c->x[i]) < c->a;
        c->slides[i] = c->x[i] < 0.0 ? (b->force_ratio > 0.0 ? 1 : -1) : 0;
        for (int j = 0; j < nodes; j++) {
            const double u = c->h * (i - j);
            c->gap_p[i][j] = displacement(s, u, c->h);
            c->gap_q[i][j] = s.k * hat_integral(u, c->h);
        }
    }
}

/* The slip velocity of steady rolling, xi - w_T'. */
static void roll_steadily(contact *c)
{
    c->side = 1.0;
    for (int i = 0; i < c->n; i++)
        for (int j = 0; j < c->n; j++) {
            c->slip_q[i][j] = -slope(c->s, c->h * (i - j + 0.5), c->h);
            c->slip_p[i][j] = j == i || j == i + 1 ? 0.5 * c->s.k : 0.0;
        }
}

/* What slides from no contact to this one; the creepage is the rigid shift. */
static void shift_from_rest(contact *c)
{
    c->side = 1.0;
    for (int i = 0; i < c->n; i++)
        for (int j = 0; j < c->n; j++) {
            c->slip_q[i][j] = c->gap_p[i][j]; /* log kernels are alike in x and y */
            c->slip_p[i][j] = -c->gap_q[i][j];
        }
}

/* What slides when all moves on by h, from the tractions of now. */
static void roll_on(contact *c)
{
    c->side = c->h;
    for (int i = 0; i < c->n; i++) {
        c->known[i] = 0.0;
        for (int j = 0; j < c->n; j++) {
            const double u = c->h * (i + 1 - j);
            c->known[i] -=
                displacement(c->s, u, c->h) * c->q[j] - c->s.k * hat_integral(u, c->h) * c->p[j];
        }
    }
}

/* sum of unknowns = total, matrix unknowns + side level = right, for the nodes listed. */
static double solve_nodes(contact *c, double matrix[NODES][NODES], double side, const int *nodes,
                          int m, const double *right, double total, double *unknown)
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
    assert_int_equal(LAPACKE_dgesv(LAPACK_COL_MAJOR, m + 1, 1, M, m + 1, pivots, b, m + 1), 0);
    for (int i = 0; i < m; i++)
        unknown[nodes[i]] = b[i];
    return b[m];
}

static double row(const contact *c, double matrix[NODES][NODES], int i, const double *traction)
{
    double sum = 0.0;
    for (int j = 0; j < c->n; j++)
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
        for (int i = 0; i < c->n; i++) {
            right[i] = -0.5 * c->x[i] * c->x[i] - row(c, c->gap_q, i, c->q);
            c->p[i] = 0.0;
            if (c->touches[i])
                nodes[m++] = i;
        }
        c->approach = solve_nodes(c, c->gap_p, -1.0, nodes, m, right, 1.0, c->p);
        changed = 0;
        for (int i = 0; i < c->n; i++) {
            const double gap = row(c, c->gap_p, i, c->p) - right[i] - c->approach;
            const int touches = c->touches[i] ? c->p[i] > 0.0 : gap < -1e-12 * fabs(c->approach);
            changed += touches != c->touches[i];
            c->touches[i] = touches;
        }
    }
}

static double slip(contact *c, int i)
{
    return c->side * c->creepage + c->known[i] + row(c, c->slip_p, i, c->p) +
           row(c, c->slip_q, i, c->q);
}

/* q and the creepage under the pressure that is given */
static void roll(contact *c)
{
    for (int round = 0, changed = 1; changed; round++) {
        int nodes[NODES], m = 0;
        double right[NODES], total = c->Q;
        assert_true(round < 200);
        for (int i = 0; i < c->n; i++) {
            c->q[i] = c->touches[i] ? c->mu * c->p[i] * c->slides[i] : 0.0;
            total -= c->q[i] * c->h;
            if (c->touches[i] && !c->slides[i])
                nodes[m++] = i;
        }
        for (int i = 0; i < c->n; i++)
            right[i] = -c->known[i] - row(c, c->slip_p, i, c->p) - row(c, c->slip_q, i, c->q);
        c->creepage = solve_nodes(c, c->slip_q, c->side, nodes, m, right, total, c->q);
        changed = 0;
        for (int i = 0; i < c->n; i++) {
            int slides = c->slides[i];
            if (!c->touches[i])
                continue;
            if (!slides && fabs(c->q[i]) > c->mu * c->p[i])
                slides = c->q[i] > 0.0 ? 1 : -1;
            else if (slides && slip(c, i) * slides > 1e-14 * c->side)
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
    return rolling_case("formulation steady support halfplane support-b halfplane radius 1 load 1 "
                        "young %g poisson %g young-b %g poisson-b %g gap parabola mu %g "
                        "force-ratio %g mesh fitted contact-elements 120",
                        b->E_a, b->nu_a, b->E_b, b->nu_b, b->mu, b->force_ratio);
}

static void compare(const pair *b, int k)
{
    static contact c;
    rb_rolling_case rc = the_same(b);
    OWNED(rb_rolling_solution) s = solved(&rc);
    const double a = s.hertz_half_width, small = 2e-3 * fmax(b->mu, 0.1) * a;
    double moment = 0.0, power = 0.0, from = INFINITY, to = -INFINITY;
    set_up(&c, b, NODES);
    roll_steadily(&c);
    alternate(&c);
    for (int i = 0; i < c.n; i++) {
        moment += c.p[i] * c.x[i] * c.h;
        if (i + 1 < c.n)
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
}

TEST(steady_rolling_of_dissimilar_bodies)
{
    static const pair pairs[] = {
        {900.0, 0.1, 1e9, 0.3, 0.3, -0.5},    {900.0, 0.1, 1e9, 0.3, 0.3, 0.5},
        {900.0, 0.1, 1e9, 0.3, 0.05, -0.5},   {900.0, 0.1, 1e9, 0.3, 0.3, 1e-6},
        {700.0, 0.33, 2100., 0.28, 0.3, 0.9}, {2100., 0.28, 700.0, 0.0, 0.3, -0.2},
        {300.0, 0.45, 2e4, 0.1, 0.6, 0.99}};
    for (size_t k = 0; k < sizeof pairs / sizeof *pairs; k++)
        compare(&pairs[k], (int)k);
}

/* Of the history, at the middle of the steps. */
static double creepage_at(const rb_rolling_history *h, double distance)
{
    for (int k = 2; k < h->n; k++) {
        const double from = 0.5 * (h->distance[k - 2] + h->distance[k - 1]),
                     to = 0.5 * (h->distance[k - 1] + h->distance[k]);
        if (from <= distance && distance <= to)
            return h->creepage[k - 1] +
                   (distance - from) / (to - from) * (h->creepage[k] - h->creepage[k - 1]);
    }
    return NAN;
}

TEST(dissimilar_bodies_roll_from_rest)
{
    static const pair pairs[] = {{900.0, 0.1, 1e9, 0.3, 0.3, -0.5},
                                 {2100., 0.28, 700.0, 0.0, 0.3, 0.6}};
    static contact c;
    for (size_t k = 0; k < sizeof pairs / sizeof *pairs; k++) {
        const pair *b = &pairs[k];
        rb_rolling_case rc = the_same(b);
        OWNED(rb_rolling_model) model;
        OWNED(rb_rolling_history) h;
        double distance = 0.0;
        set(&rc, "formulation transient mesh uniform contact-elements 240 distance 1.2");
        CHECK_OK(rb_rolling_history_run(&rc, NULL, NULL, &model, &h, NULL));
        set_up(&c, b, 121);
        shift_from_rest(&c);
        alternate(&c);
        for (int step = 1; distance < 1.1; step++) {
            roll_on(&c);
            alternate(&c);
            distance = (step - 0.5) * c.h / c.a;
            if (distance > 0.1)
                CHECK_ABS(c.creepage, creepage_at(&h, distance), 5e-3 * b->mu * c.a,
                          "pair %d after %g a", (int)k, distance);
        }
    }
}

RUN_TESTS(NULL, NULL)
