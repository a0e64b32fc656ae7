/* Contact problems of random numbers, without a wheel: what every solver hands back is
 * judged by loops over the matrices here, and so are the rows of the LCP, zones that are
 * held, scales, forces and refusals. */
#include "check.h"
#include "contact/internal.h"

#include <string.h>

/* ---- Random problems --------------------------------------------------------------- */

static uint64_t numbers;

/* Of a generator that is the same everywhere. */
static double uniform(double least, double most)
{
    numbers = numbers * 6364136223846793005u + 1442695040888963407u;
    return least + (most - least) * ((double)(numbers >> 11) / 9007199254740992.0);
}

enum { LARGEST = 130, PADDING = 3 };
/* Scales that are no powers of one another: a wrong one shows. */
static const double STRESS = 240.0, GAP = 0.05, SLIP = 0.0125;

/* F with rows behind those of the gaps, which nobody may read. */
static double F[(LARGEST + PADDING) * 2 * LARGEST];
static int ldf;

typedef struct {
    int n;
    double mu, coupling;
    int load_given, force_given, axle;
    int yields; /* 0: no layer; 1: it hardens, 2: neither, 3: it softens */
    int order;  /* what has yielded: 0 stays, 1 and 2 follow the material by this order */
    int smooth; /* one element, without friction */
    int rolls;  /* slips are differences upstream, kernels those of a half-plane */
} kind;

/* Displacements at a distance d from a unit pressure, and from a unit friction at right
 * angles to it. */
static double normal_kernel(int d)
{
    return 1.0 - 0.5 * log(0.05 + d * d);
}

static double cross_kernel(const kind *of, int d)
{
    return of->coupling * ((d > 0) - (d < 0));
}

static void set_rolling_matrices(const kind *of, double *S)
{
    const int n = of->n;

    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const int d = i - j;
            F[i + j * ldf] = GAP / STRESS * (3.0 + normal_kernel(d));
            F[i + (n + j) * ldf] = -GAP / STRESS * cross_kernel(of, d);
            S[i + j * n] =
                SLIP / STRESS * (cross_kernel(of, d) - cross_kernel(of, d + 1));
            S[i + (n + j) * n] =
                SLIP / STRESS * (normal_kernel(d) - normal_kernel(d + 1));
        }
}

/* Gaps and slips fall with the distance; pressure makes slip and friction gaps, with the
 * signs of two bodies, as far as `coupling` says. */
static double *random_matrices(const kind *of)
{
    const int n = of->n;
    double *S = rb_alloc((size_t)n, 2 * (size_t)n);

    ldf = n + PADDING;
    for (size_t k = 0; k < sizeof F / sizeof *F; k++)
        F[k] = NAN;
    if (of->rolls) {
        set_rolling_matrices(of, S);
        return S;
    }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const double near = exp(-0.7 * abs(i - j));
            const double odd = (i - j) * near * of->coupling * uniform(0.8, 1.2);
            F[i + j * ldf] = GAP / STRESS * near;
            F[i + (n + j) * ldf] = GAP / STRESS * odd;
            S[i + j * n] = SLIP / STRESS * -odd;
            S[i + (n + j) * n] = SLIP / STRESS * near * (i <= j ? 1.0 : 0.6);
        }
    return S;
}

static void set_layer(const kind *of, rb_contact_problem *p)
{
    static const double recall[3][3] = {
        {0.0, 0.0, 1.0}, {1.0, 0.0, 1.0}, {4.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0}};
    static const double hardening[] = {0.0, 0.3, 0.0, -0.1};

    CHECK_STATUS(rb_contact_set_yield(p, 7.0, 8.0), RB_OK); /* replaced by the next */
    CHECK_STATUS(rb_contact_set_yield(p, 0.5 * of->mu * STRESS,
                                      hardening[of->yields] * of->mu * STRESS / SLIP),
                 RB_OK);
    memcpy(p->recall, recall[of->order], sizeof p->recall);
    p->own = recall[of->order][2];
}

static void random_problem(const kind *of, rb_contact_problem *p)
{
    const int n = of->n;
    rb_contact_operator *op;
    double *bound = rb_alloc((size_t)n, 1), total = 0.0;

    CHECK_STATUS(rb_contact_operator_dense(n, F, n + PADDING, random_matrices(of), &op),
                 RB_OK);
    CHECK_STATUS(rb_contact_problem_alloc(op, p), RB_OK);
    p->stress = STRESS;
    p->gap_length = GAP;
    p->slip_length = SLIP;
    for (int i = 0; i < n; i++) {
        const double x = n > 1 ? 2.0 * i / (n - 1) - 1.0 : 0.0;
        p->d_N[i] = GAP * (2.5 * x * x - 1.5 + uniform(-0.1, 0.1));
        p->d_T[i] = SLIP * uniform(-0.2, 0.2);
        p->e_T[i] = uniform(0.9, 1.1);
        p->load_N[i] = uniform(0.9, 1.1);
        p->load_T[i] = uniform(-0.02, 0.02);
        p->force_N[i] = uniform(-0.02, 0.02);
        p->force_T[i] = uniform(0.9, 1.1);
        p->moment_N[i] = x * p->load_N[i];
        p->moment_T[i] = uniform(-0.02, 0.02);
        bound[i] = of->mu * uniform(0.8, 1.0);
        total += p->load_N[i];
    }
    bound[n / 2] = of->mu;
    if (of->smooth)
        bound[n / 3] = 0.0;
    rb_contact_set_friction(p, of->mu, bound);
    free(bound);
    p->load_given = of->load_given;
    p->load = 0.5 * STRESS * total;
    p->delta = 0.1 * GAP;
    p->xi = SLIP * uniform(-2.0, 2.0);
    p->force_given = of->force_given > 0;
    if (of->force_given == 1)
        p->force_ratio = uniform(-0.6, 0.6);
    if (of->force_given == 2)
        p->force = 0.2 * of->mu * uniform(-1.0, 1.0) * p->load;
    if (of->axle)
        p->axle = 0.1 * of->mu;
    if (of->yields)
        set_layer(of, p);
}

static rb_contact_options options_of(rb_contact_solver solver)
{
    rb_contact_options options = rb_contact_defaults();

    options.solver = solver;
    options.tol = 1e-9;
    options.sliding = 10.0 * SLIP;
    return options;
}

/* ---- The judge --------------------------------------------------------------------- */

/* Gap and slip of element i, by a loop. */
static void move(const rb_contact_problem *p, const rb_contact_state *s, int i,
                 double *gap, double *slip)
{
    const double *S = rb_contact_operator_matrix(p->op).S;
    const int n = p->n;

    *gap = p->d_N[i] - s->delta;
    *slip = p->d_T[i] + s->xi * p->e_T[i];
    for (int j = 0; j < n; j++) {
        *gap += F[i + j * ldf] * s->p[j] + F[i + (n + j) * ldf] * s->q[j];
        *slip += S[i + j * n] * s->p[j] + S[i + (n + j) * n] * s->q[j];
    }
}

static double sum_of(int n, const double *a, const double *x, const double *b,
                     const double *y)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++)
        sum += a[i] * x[i] + b[i] * y[i];
    return sum;
}

/* Q - what was asked for, over what friction carries. */
static double force_error(const rb_contact_problem *p, const rb_contact_state *s,
                          double *most)
{
    const int n = p->n;
    const double Q = sum_of(n, p->force_N, s->p, p->force_T, s->q);
    const double M = sum_of(n, p->moment_N, s->p, p->moment_T, s->q);

    *most = 0.0;
    for (int i = 0; i < n; i++)
        *most += p->bound[i] * (p->load_N[i] * s->p[i] + p->load_T[i] * s->q[i]);
    return Q - p->force - p->force_ratio * *most + p->axle * M;
}

/* Of two that are not negative and of which one is zero. */
static double conflict(double a, double b)
{
    return fabs(fmin(a, b));
}

/* Coulomb's law of a slip under the bound of |q|: a slip goes against q. */
static double coulomb(double slip, double q, double bound)
{
    return fmax(conflict(fmax(slip, 0.0), bound + q),
                conflict(fmax(-slip, 0.0), bound - q));
}

/* Coulomb's law and the layer's, scaled, from p, q, plastic, delta and xi. */
static double friction_residual(const rb_contact_problem *p, const rb_contact_state *s)
{
    const double mu_stress = STRESS * (p->mu > 0.0 ? p->mu : 1.0);
    double worst = 0.0, next = 0.0, second = 0.0;

    for (int i = p->n - 1; i >= 0; i--) {
        double gap, slip;
        move(p, s, i, &gap, &slip);
        const double plastic = p->yield ? s->plastic[i] : 0.0;
        const double q = s->q[i] / mu_stress, bound = p->bound[i] * s->p[i] / mu_stress;
        worst = fmax(worst, coulomb((slip - plastic) / SLIP, q, bound));
        if (p->yield) {
            const double u =
                p->recall[0] * next + p->recall[1] * second + p->own * fabs(plastic);
            const double yield = fmax(p->yield[i] + p->hardening * u, 0.0);
            worst = fmax(worst, coulomb(plastic / SLIP, q, yield / mu_stress));
            second = next;
            next = u;
        }
    }
    return worst;
}

/* The natural residual of the scaled problem, from p, q, plastic, delta and xi. */
static double residual_of(const rb_contact_problem *p, const rb_contact_state *s)
{
    double worst = friction_residual(p, s), most;

    for (int i = 0; i < p->n; i++) {
        double gap, slip;
        move(p, s, i, &gap, &slip);
        worst = fmax(worst, conflict(gap / GAP, s->p[i] / STRESS));
    }
    if (p->load_given)
        worst = fmax(
            worst, fabs(sum_of(p->n, p->load_N, s->p, p->load_T, s->q) / p->load - 1.0));
    if (p->force_given) {
        const double error = force_error(p, s, &most);
        worst = fmax(worst, fabs(error) / most);
    }
    return worst;
}

/* The zone of every element is what its tractions and slips do. */
static void check_zones(const rb_contact_problem *p, const rb_contact_state *s)
{
    for (int i = 0; i < p->n; i++) {
        const double limit = p->bound[i] * s->p[i], tiny = 1e-7 * STRESS;
        double gap, slip;
        move(p, s, i, &gap, &slip);
        CHECK_ABS(s->lambda[i], s->zone[i] == RB_ZONE_STICK && !p->yield ? 0.0 : slip,
                  1e-7 * SLIP, "lambda %d, zone %d", i, s->zone[i]);
        if (s->zone[i] == RB_ZONE_SEPARATED)
            CHECK_ABS(fabs(s->p[i]) + fabs(s->q[i]), 0.0, tiny, "separated %d", i);
        if (s->zone[i] == RB_ZONE_SLIP_NEGATIVE)
            CHECK_ABS(s->q[i], -limit, tiny, "slips to +x %d", i);
        if (s->zone[i] == RB_ZONE_SLIP_POSITIVE)
            CHECK_ABS(s->q[i], limit, tiny, "slips to -x %d", i);
        if (s->zone[i] <= RB_ZONE_STICK)
            CHECK_ABS(s->plastic[i], 0.0, 0.0, "%d does not yield", i);
        if (s->zone[i] >= RB_ZONE_YIELD_NEGATIVE)
            assert_true(p->yield && fabs(s->plastic[i]) > 0.0);
    }
}

/* ---- Solutions --------------------------------------------------------------------- */

/* How often a problem was solved, refused, and not solved. */
typedef struct {
    int solved, refused, failed;
    int by_newton, steps; /* solves by Newton's method, and their steps */
} outcome;

static void check_outcome(const rb_contact_problem *p, const rb_contact_state *s,
                          rb_status status, const rb_message *why, outcome *o)
{
    double Q, most;

    assert_int_equal(s->status, status == RB_EINVAL ? s->status : status);
    o->solved += status == RB_OK;
    o->refused += status == RB_EINVAL;
    o->failed += status > 0;
    o->by_newton += status == RB_OK && s->solver == RB_SOLVER_NEWTON;
    o->steps += status == RB_OK && s->solver == RB_SOLVER_NEWTON ? s->iterations : 0;
    if (status == RB_OK) {
        CHECK_MAX(residual_of(p, s), 1e-8, "n %d, mu %g, load %d, force %d", p->n, p->mu,
                  p->load_given, p->force_given);
        CHECK_ABS(s->residual, residual_of(p, s), 1e-10, "residual");
        check_zones(p, s);
    } else if (status == RB_EINVAL) {
        const char *carries = strstr(why->text, "carries at most");
        assert_non_null(carries);
        assert_int_equal(sscanf(why->text, "force Q = %lf", &Q), 1);
        assert_int_equal(sscanf(carries + strcspn(carries, "0123456789"), "%lf", &most),
                         1);
        assert_true(fabs(Q) > most);
    } else {
        assert_true(status > 0 && strstr(why->text, "scaled residual"));
    }
}

/* By all solvers, cold and then warm. */
static outcome check_solvers(const kind *of)
{
    static const rb_contact_solver solvers[] = {RB_SOLVER_AUTO, RB_SOLVER_LEMKE,
                                                RB_SOLVER_NEWTON};
    rb_contact_problem p;
    rb_contact_state s;
    outcome o = {0};

    random_problem(of, &p);
    CHECK_STATUS(rb_contact_state_alloc(of->n, &s), RB_OK);
    for (int k = 0; k < 6; k++) {
        const rb_contact_options options = options_of(solvers[k % 3]);
        rb_message why = {""};
        const rb_status status = rb_contact_solve(&p, &options, k >= 3, &s, &why);
        check_outcome(&p, &s, status, &why, &o);
    }
    rb_contact_state_free(&s);
    rb_contact_problem_free(&p);
    return o;
}

TEST(every_solver_solves_random_problems)
{
    int by_newton = 0, steps = 0;

    numbers = 1;
    for (int k = 0; k < 120; k++) {
        const kind of = {.n = 1 + k % 9,
                         .mu = k % 5 ? 0.3 : 0.0,
                         .coupling = k % 3 ? 0.05 : 0.0,
                         .load_given = k / 2 % 2,
                         .force_given = k % 5 ? k / 4 % 3 : 0,
                         .axle = k % 5 && k / 4 % 3 && k % 7 == 0};
        const outcome one = check_solvers(&of);
        assert_int_equal(one.solved, 6);
        by_newton += one.by_newton;
        steps += one.steps;
    }
    assert_true(by_newton > 340);
    CHECK_MAX((double)steps / by_newton, 3.6, "Newton's steps");
}

/* Where pressure and friction do not meet, Newton's method solves for one after the
 * other, the given force with what slides already carries. */
TEST(uncoupled_problems_are_solved_in_turn)
{
    int sticks = 0, slides = 0;

    numbers = 19;
    for (int k = 0; k < 16; k++) {
        const kind of = {.n = 9, .mu = 0.3, .force_given = 1, .axle = k / 8};
        rb_contact_problem p;
        rb_contact_state s;
        random_problem(&of, &p);
        p.force_ratio = k % 2 ? -0.7 : 0.6;
        if (k / 4 % 2) {
            p.force = p.force_ratio * 0.1 * of.mu * p.load;
            p.force_ratio = 0.0;
        }
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        CHECK_STATUS(rb_contact_newton(&p, 0, &s), RB_OK);
        CHECK_MAX(residual_of(&p, &s), 1e-11, "case %d", k);
        for (int i = 0; i < of.n; i++) {
            sticks += s.zone[i] == RB_ZONE_STICK;
            slides += s.zone[i] > RB_ZONE_STICK;
        }
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
    }
    assert_true(sticks > 10 && slides > 10);
}

/* All that friction carries: every creepage beyond a least one would do, and this is the
 * least one, at which the slowest element is about to stick. */
TEST(full_sliding_has_the_least_creepage)
{
    numbers = 20;
    for (int k = 0; k < 8; k++) {
        const kind of = {.n = 7,
                         .mu = 0.3,
                         .coupling = k % 4 < 2 ? 0.05 : 0.0,
                         .load_given = k / 4,
                         .force_given = 1};
        const double sign = k % 2 ? 1.0 : -1.0;
        rb_contact_options options =
            options_of(k % 3 ? RB_SOLVER_LEMKE : RB_SOLVER_NEWTON);
        rb_contact_problem p;
        rb_contact_state s;
        double least = INFINITY;
        options.sliding =
            k / 2 % 2 ? options.sliding : 1e-2 * SLIP; /* too small to slide */
        random_problem(&of, &p);
        memset(p.load_T, 0,
               sizeof(double) * (size_t)of.n); /* level: P has no friction in it */
        memset(p.force_N, 0, sizeof(double) * (size_t)of.n);
        memcpy(p.force_T, p.load_N, sizeof(double) * (size_t)of.n);
        p.force_ratio = sign;
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        CHECK_STATUS(rb_contact_solve(&p, &options, 0, &s, NULL), RB_OK);
        CHECK_MAX(residual_of(&p, &s), 1e-10, "case %d", k);
        for (int i = 0; i < of.n; i++) {
            double gap, slip;
            move(&p, &s, i, &gap, &slip);
            if (s.p[i] > 0.0)
                least = fmin(least, -sign * slip);
            CHECK_ABS(s.lambda[i], slip, 1e-9 * SLIP, "case %d: lambda %d", k, i);
        }
        CHECK_ABS(least, 0.0, 1e-9 * SLIP, "case %d: the slowest", k);
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
    }
}

/* A small contact that yields cannot carry every force, and says so whoever solves it. */
TEST(every_solver_solves_layers_that_yield)
{
    outcome all = {0};

    numbers = 2;
    for (int k = 0; k < 144; k++) {
        const kind of = {.n = 1 + k % 7,
                         .mu = 0.3,
                         .coupling = k % 3 ? 0.05 : 0.0,
                         .load_given = k / 2 % 2,
                         .force_given = k / 4 % 3,
                         .axle = k / 4 % 3 && k % 11 == 0,
                         .yields = 1 + k / 12 % 3,
                         .order = k / 36 % 3,
                         .smooth = k % 8 == 3 && k % 7 > 2};
        const outcome one = check_solvers(&of);
        assert_true(one.solved == 6 || one.solved == 0);
        all.solved += one.solved > 0;
        all.refused += one.refused > 0;
        all.failed += one.failed > 0;
        all.by_newton += one.by_newton;
        all.steps += one.steps;
    }
    assert_true(all.by_newton > 460);
    CHECK_MAX((double)all.steps / all.by_newton, 5.5, "Newton's steps");
    assert_true(all.refused > 3 && all.refused < 15);
    CHECK_MAX(all.failed, 1, "neither solved nor refused");
}

/* A layer whose yield stress has been raised above all friction keeps nothing of what has
 * yielded before. */
TEST(strong_layers_forget_what_has_yielded)
{
    numbers = 6;
    for (int k = 0; k < 12; k++) {
        const kind of = {.n = 7,
                         .mu = 0.3,
                         .coupling = 0.05,
                         .load_given = k % 2,
                         .yields = 1 + k % 3};
        const rb_contact_options options = options_of(RB_SOLVER_AUTO);
        rb_contact_problem p;
        rb_contact_state s;
        random_problem(&of, &p);
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        for (int i = 0; i < of.n; i++) {
            p.yield[i] = 1e3 * STRESS;
            s.plastic[i] = SLIP * (i + 1);
        }
        CHECK_STATUS(rb_contact_solve(&p, &options, k >= 6, &s, NULL), RB_OK);
        for (int i = 0; i < of.n; i++)
            CHECK_ABS(s.plastic[i], 0.0, 0.0, "element %d", i);
        CHECK_MAX(residual_of(&p, &s), 1e-8, "problem %d", k);
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
    }
}

/* Laws that come back are corrected one by one from then on, where all would slide under
 * a given force the element sticks that wants to slide least, and a layer is followed
 * down from a higher yield stress: without one of these, some take twice the steps or
 * need Lemke. */
TEST(cycles_of_laws_end_soon)
{
    static const struct {
        int k, steps;
        rb_contact_solver by;
    } all[] = {{34, 240, RB_SOLVER_NEWTON}, {54, 45, RB_SOLVER_NEWTON},
               {272, 16, RB_SOLVER_NEWTON}, {449, 150, RB_SOLVER_LEMKE},
               {887, 26, RB_SOLVER_NEWTON}, {969, 240, RB_SOLVER_NEWTON}};

    for (int c = 0; c < 6; c++) {
        const int k = all[c].k;
        const kind of = {.n = 4 + k % 17,
                         .mu = 0.3,
                         .coupling = k % 3 ? 0.05 : 0.2,
                         .load_given = k / 2 % 2,
                         .force_given = k / 4 % 3,
                         .yields = 1 + k / 12 % 3,
                         .order = k / 36 % 3,
                         .rolls = k / 108 % 2};
        const rb_contact_options options = options_of(RB_SOLVER_NEWTON);
        rb_contact_problem p;
        rb_contact_state s;
        numbers = 1000 + (uint64_t)k;
        random_problem(&of, &p);
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        CHECK_STATUS(rb_contact_solve(&p, &options, 0, &s, NULL), RB_OK);
        CHECK_MAX(residual_of(&p, &s), 1e-9, "case %d", k);
        assert_int_equal(s.solver, all[c].by);
        CHECK_MAX(s.iterations, all[c].steps, "steps of case %d", k);
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
    }
}

/* Lemke's solution is solved once more with its zones, which takes the rounding of its
 * pivots away: without that the means are 5e-15. */
TEST(pivots_leave_no_rounding)
{
    double sum[3] = {0.0};

    numbers = 16;
    for (int k = 0; k < 12; k++) {
        const kind of = {.n = 50,
                         .mu = 0.3,
                         .coupling = 0.2,
                         .load_given = k / 3 % 2,
                         .force_given = k / 6,
                         .yields = k % 3,
                         .order = 1};
        const rb_contact_options options = options_of(RB_SOLVER_LEMKE);
        rb_contact_problem p;
        rb_contact_state s;
        random_problem(&of, &p);
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        CHECK_STATUS(rb_contact_solve(&p, &options, 0, &s, NULL), RB_OK);
        assert_int_equal(s.solver, RB_SOLVER_LEMKE);
        sum[k % 3] += residual_of(&p, &s);
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
    }
    for (int k = 0; k < 3; k++)
        CHECK_MAX(sum[k] / 4.0, 3e-15, "layer %d", k);
}

/* Pairs of elements have one traction each, and the mean gap and slip of the two. */
TEST(pairs_move_as_their_elements)
{
    numbers = 18;
    const kind of = {
        .n = 8, .mu = 0.3, .coupling = 0.1, .load_given = 1, .force_given = 2};
    rb_contact_problem p, half;
    rb_contact_state fine, coarse;
    double gap[4], slip[4], most;

    random_problem(&of, &p);
    CHECK_STATUS(rb_contact_halve(&p, &half), RB_OK);
    assert_int_equal(half.n, 4);
    CHECK_STATUS(rb_contact_state_alloc(8, &fine), RB_OK);
    CHECK_STATUS(rb_contact_state_alloc(4, &coarse), RB_OK);
    for (int i = 0; i < 4; i++) {
        coarse.p[i] = STRESS * uniform(0.0, 1.0);
        coarse.q[i] = STRESS * uniform(-0.3, 0.3);
    }
    coarse.delta = 0.3 * GAP;
    coarse.xi = 0.7 * SLIP;
    rb_contact_start_from_half(&coarse, &fine);
    rb_contact_kinematics(&half, &coarse, gap, slip);
    for (int i = 0; i < 4; i++) {
        double g[2], l[2];
        for (int k = 0; k < 2; k++)
            move(&p, &fine, 2 * i + k, &g[k], &l[k]);
        CHECK_ABS(gap[i], 0.5 * (g[0] + g[1]), 1e-12 * GAP, "gap %d", i);
        CHECK_ABS(slip[i], 0.5 * (l[0] + l[1]), 1e-12 * SLIP, "slip %d", i);
        CHECK_REL(half.bound[i], 0.5 * (p.bound[2 * i] + p.bound[2 * i + 1]), 1e-14,
                  "bound");
    }
    CHECK_REL(rb_contact_load(&half, &coarse), rb_contact_load(&p, &fine), 1e-13, "P");
    CHECK_REL(rb_contact_force(&half, &coarse), rb_contact_force(&p, &fine), 1e-12, "Q");
    CHECK_REL(rb_contact_moment(&half, &coarse), rb_contact_moment(&p, &fine), 1e-12,
              "M");
    CHECK_ABS(force_error(&half, &coarse, &most) - rb_contact_force(&half, &coarse),
              -p.force, 1e-12 * STRESS, "the force that is given");
    rb_contact_state_free(&fine);
    rb_contact_state_free(&coarse);
    rb_contact_problem_free(&half);
    rb_contact_problem_free(&p);
}

/* ---- Zones that are held ----------------------------------------------------------- */

/* The linear problem of the zones, by its equations. */
static void check_held(const rb_contact_problem *p, const rb_contact_state *s,
                       const double *gaps, int round)
{
    static const double slope[] = {0.0, 0.0, -1.0, 1.0};
    double most;

    for (int i = 0; i < p->n; i++) {
        double gap, slip;
        move(p, s, i, &gap, &slip);
        CHECK_ABS(gaps[i], gap, 1e-9 * GAP, "round %d: gap %d", round, i);
        CHECK_ABS(s->lambda[i], slip, 1e-9 * SLIP, "round %d: slip %d", round, i);
        if (s->zone[i] == RB_ZONE_SEPARATED)
            assert_true(s->p[i] == 0.0 && s->q[i] == 0.0);
        else
            CHECK_ABS(gap, 0.0, 1e-9 * GAP, "round %d: contact %d", round, i);
        if (s->zone[i] == RB_ZONE_STICK)
            CHECK_ABS(slip, 0.0, 1e-9 * SLIP, "round %d: stick %d", round, i);
        else
            CHECK_ABS(s->q[i], slope[s->zone[i]] * p->bound[i] * s->p[i], 1e-9 * STRESS,
                      "round %d: friction %d", round, i);
    }
    if (p->load_given)
        CHECK_REL(sum_of(p->n, p->load_N, s->p, p->load_T, s->q), p->load, 1e-9, "load");
    else
        CHECK_ABS(s->delta, p->delta, 0.0, "approach");
    if (p->force_given)
        CHECK_ABS(force_error(p, s, &most), 0.0, 1e-9 * fabs(p->mu * p->load), "force");
    else
        CHECK_ABS(s->xi, p->xi, 0.0, "creepage");
}

/* One element after the other changes its zone: solves with an LU that is kept and what
 * has changed since at its border, and, after larger changes, with a new one. */
TEST(zones_may_change_one_by_one)
{
    numbers = 3;
    for (int k = 0; k < 8; k++) {
        const kind of = {.n = 24,
                         .mu = 0.3,
                         .coupling = 0.05,
                         .load_given = k % 2,
                         .force_given = k / 2 % 2,
                         .axle = k / 4};
        rb_contact_problem p;
        rb_contact_state s;
        double gap[24];
        random_problem(&of, &p);
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        for (int i = 0; i < of.n; i++)
            s.zone[i] = i % 3 ? RB_ZONE_STICK : RB_ZONE_SLIP_NEGATIVE;
        for (int round = 0; round < 40; round++) {
            for (int c = round % 10 ? 1 : of.n / 2; c > 0; c--)
                s.zone[1 + (int)uniform(0.0, of.n - 1.0)] = (int)uniform(0.0, 4.0);
            s.zone[0] = RB_ZONE_STICK; /* a given force moves what sticks */
            if (round == 20)
                rb_contact_set_friction(&p, 0.2, NULL);
            CHECK_STATUS(rb_contact_try_zones(&p, &s, gap), RB_OK);
            check_held(&p, &s, gap, round);
        }
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
    }
}

/* From zones of which one or two elements are wrong, a path leads to the solution within
 * a few bends: at its start every element obeys the law of its zone. */
TEST(paths_lead_back_to_the_solution)
{
    const rb_contact_options options = options_of(RB_SOLVER_NEWTON);
    int solves = 0, solved = 0;

    numbers = 22;
    for (int k = 0; k < 64; k++) {
        const kind of = {.n = 4 + k % 6,
                         .mu = 0.3,
                         .coupling = 0.05,
                         .load_given = k % 2,
                         .force_given = k / 2 % 3};
        rb_contact_problem p;
        rb_contact_state s;
        random_problem(&of, &p);
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        CHECK_STATUS(rb_contact_solve(&p, &options, 0, &s, NULL), RB_OK);
        const int first = (int)uniform(0.0, of.n), second = (int)uniform(0.0, of.n);
        s.zone[first] = k % 4 ? (s.zone[first] + 1) % 4 : RB_ZONE_SEPARATED;
        s.zone[second] = (s.zone[second] + k / 4) % 4;
        s.iterations = 0;
        const rb_status status = rb_contact_follow_path(&p, &s);
        assert_true(status == RB_OK ||
                    (status == RB_SINGULAR && s.iterations == 1)); /* none sticks */
        solved += status == RB_OK;
        solves += s.iterations;
        if (status == RB_OK)
            CHECK_MAX(residual_of(&p, &s), 1e-10, "case %d", k);
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
    }
    assert_int_equal(solved, 61);
    assert_in_range(solves, 460, 468); /* three, and two for every bend */
}

/* Allocations of a solve with the zones of the state. */
static int allocations(rb_contact_problem *p, rb_contact_state *s)
{
    double gap[24];

    for (int count = 0;; count++) {
        alloc_fail_after(count);
        const rb_status status = rb_contact_try_zones(p, s, gap);
        const int failed = alloc_failed();
        alloc_succeed();
        CHECK_STATUS(status, failed ? RB_ENOMEM : RB_OK);
        if (!failed)
            return count;
    }
}

/* The second solve has the room of the first one, until that is forgotten; bounds that
 * stay what they are change nothing. */
TEST(what_is_kept_can_be_forgotten)
{
    for (int k = 0; k < 4; k++) {
        const kind of = {
            .n = 24, .mu = 0.3, .coupling = k % 2 ? 0.05 : 0.0, .force_given = k / 2};
        rb_contact_problem p;
        rb_contact_state s;
        double gap[24];
        numbers = 25;
        random_problem(&of, &p);
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        for (int i = 0; i < of.n; i++)
            s.zone[i] = i % 3 ? RB_ZONE_STICK : RB_ZONE_SLIP_NEGATIVE;
        CHECK_STATUS(rb_contact_try_zones(&p, &s, gap), RB_OK);
        const int again = allocations(&p, &s);
        p.op->kind->forget(p.op);
        CHECK_STATUS(rb_contact_try_zones(&p, &s, gap), RB_OK);
        assert_int_equal(allocations(&p, &s), again);
        rb_contact_set_friction(&p, p.mu, p.bound); /* the same */
        alloc_fail_after(again);
        CHECK_STATUS(rb_contact_try_zones(&p, &s, gap), RB_OK);
        alloc_succeed();
        p.op->kind->forget(p.op);
        alloc_fail_after(again);
        CHECK_STATUS(rb_contact_try_zones(&p, &s, gap), RB_ENOMEM);
        alloc_succeed();
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
    }
}

/* Without a contact nothing can carry a load, without stick the creepage does not change
 * a force. */
TEST(zones_that_determine_nothing_are_singular)
{
    numbers = 4;
    for (int k = 0; k < 2; k++) {
        const kind of = {.n = 3, .mu = 0.3, .load_given = !k, .force_given = k};
        rb_contact_problem p;
        rb_contact_state s;
        double gap[3];
        random_problem(&of, &p);
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        for (int i = 0; i < of.n; i++)
            s.zone[i] = k ? RB_ZONE_SLIP_POSITIVE : RB_ZONE_SEPARATED;
        CHECK_STATUS(rb_contact_try_zones(&p, &s, gap), RB_SINGULAR);
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
    }
}

/* ---- Products alone ---------------------------------------------------------------- */

/* The same matrices behind products; the inverse is that of a diagonal. */
typedef struct {
    int n;
    double *S, *gap, *slip;
    int freed, products;
} by_products;

static void apply(void *context, const double *r, const double **gap, const double **slip)
{
    by_products *k = context;
    const int n = k->n;

    k->products++;
    for (int i = 0; i < n; i++) {
        k->gap[i] = k->slip[i] = 0.0;
        for (int j = 0; j < 2 * n; j++) {
            k->gap[i] += F[i + j * ldf] * r[j];
            k->slip[i] += k->S[i + j * n] * r[j];
        }
    }
    *gap = k->gap;
    *slip = k->slip;
}

static void divide(void *context, int tangential, double *line)
{
    const by_products *k = context;

    for (int i = 0; i < k->n; i++)
        line[i] *= STRESS / (tangential ? SLIP : GAP);
}

static void forget(void *context)
{
    by_products *k = context;
    free(k->S);
    free(k->gap);
    k->freed++;
}

/* p, its operator replaced by products of the same matrices. */
static void use_products(rb_contact_problem *p, by_products *k)
{
    const size_t n = (size_t)p->n;
    rb_contact_operator *op;

    *k = (by_products){p->n, rb_alloc(n, 2 * n), rb_alloc(n, 2), NULL, 0, 0};
    k->slip = k->gap + n;
    memcpy(k->S, rb_contact_operator_matrix(p->op).S, 2 * n * n * sizeof(double));
    const rb_contact_products by = {apply, divide, forget, k, NULL};
    CHECK_STATUS(rb_contact_operator_products(p->n, &by, &op), RB_OK);
    rb_contact_operator_free(p->op);
    p->op = op;
    p->rounding = 1e-9;
}

/* Loops need a matrix: the judge looks at a problem that has it. */
TEST(products_give_what_matrices_do)
{
    int refused = 0, products = 0;

    for (int k = 0; k < 144; k++) {
        const int layer = k >= 48;
        const kind of = {.n = 1 + k % 11,
                         .mu = k % 7 || layer ? 0.3 : 0.0,
                         .coupling = k % 3 ? 0.1 : 0.0,
                         .load_given = k % 2,
                         .force_given = k % 7 ? k / 2 % 3 : 0,
                         .yields = layer ? 1 + k % 3 : 0,
                         .order = k / 3 % 3};
        const rb_contact_options options = options_of(RB_SOLVER_AUTO);
        rb_contact_problem p, with;
        rb_contact_state s;
        by_products by;
        outcome o = {0};
        rb_message why = {""};
        numbers = 100 + (uint64_t)k;
        random_problem(&of, &with);
        numbers = 100 + (uint64_t)k;
        random_problem(&of, &p);
        use_products(&p, &by);
        assert_null(rb_contact_operator_matrix(p.op).F);
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        for (int warm = 0; warm < 2; warm++) {
            const rb_status status = rb_contact_solve(&p, &options, warm, &s, &why);
            check_outcome(&with, &s, status, &why, &o);
        }
        assert_int_equal(o.failed, 0);
        refused += !layer && o.refused > 0;
        const rb_contact_response unit = rb_contact_operator_response(p.op);
        CHECK_REL(unit.gap, GAP / STRESS, 1e-14, "gap");
        CHECK_REL(unit.slip, SLIP / STRESS, 1e-14, "slip");
        assert_int_equal(unit.coupled, of.coupling > 0.0 && of.n > 1);
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
        rb_contact_problem_free(&with);
        assert_int_equal(by.freed, 1);
        products += layer ? 0 : by.products;
    }
    CHECK_MAX(products, 3625, "products of all solves");
    CHECK_MAX(refused, 1, "forces that nothing carries");
}

/* F_N and S become diagonals, of which `divide` is the inverse. */
static void make_diagonal(by_products *k)
{
    const int n = k->n;

    for (int j = 0; j < 2 * n; j++)
        for (int i = 0; i < n; i++) {
            F[i + j * ldf] *= i == j;
            k->S[i + j * n] *= i + n == j;
        }
}

/* Where the preconditioner is the exact inverse, GMRES needs one step whatever is at the
 * border and whatever the unit of the creepage: five products, two of which are for the
 * right-hand side and the slips, one for the step, and two for its residual before and
 * after. */
TEST(an_exact_preconditioner_needs_one_step)
{
    for (int k = 0; k < 8; k++) {
        const kind of = {
            .n = 9, .mu = 0.3, .load_given = k % 2, .force_given = k / 2 % 2};
        rb_contact_problem p;
        rb_contact_state s;
        by_products by;
        double gap[9], P, Q;
        numbers = 21;
        random_problem(&of, &p);
        use_products(&p, &by);
        make_diagonal(&by);
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        for (int i = 0; i < of.n; i++) {
            s.zone[i] = i < 2             ? RB_ZONE_SEPARATED
                        : i == 4 && k < 4 ? RB_ZONE_SLIP_NEGATIVE
                                          : RB_ZONE_STICK;
            p.e_T[i] *= 0.01;
        }
        by.products = 0;
        CHECK_STATUS(rb_contact_try_zones(&p, &s, gap), RB_OK);
        CHECK_MAX(by.products, 5, "case %d", k);
        for (int i = 2; i < of.n; i++) {
            CHECK_REL(s.p[i], STRESS / GAP * (s.delta - p.d_N[i]), 1e-9, "pressure %d",
                      i);
            if (s.zone[i] == RB_ZONE_STICK)
                CHECK_REL(s.q[i], -STRESS / SLIP * (p.d_T[i] + s.xi * p.e_T[i]), 1e-9,
                          "friction %d", i);
        }
        P = sum_of(of.n, p.load_N, s.p, p.load_T, s.q);
        Q = sum_of(of.n, p.force_N, s.p, p.force_T, s.q);
        if (of.load_given)
            CHECK_REL(P, p.load, 1e-9, "load");
        if (of.force_given)
            CHECK_REL(Q, p.force_ratio * rb_contact_capacity(&p, &s), 1e-9, "force");
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
    }
}

/* Answers that differ by four digits from element to element need more steps than the
 * basis has room for: a second cycle goes on from where the first one has ended. */
TEST(a_full_basis_begins_anew)
{
    enum { n = 130 };
    const kind of = {.n = n, .mu = 0.3, .load_given = 1, .force_given = 1};
    rb_contact_problem p;
    rb_contact_state s;
    by_products by;
    double gap[n];

    numbers = 27;
    random_problem(&of, &p);
    use_products(&p, &by);
    make_diagonal(&by);
    for (int i = 0; i < n; i++) {
        F[i + i * ldf] *= 1.0 + 100.0 * i;
        by.S[i + (n + i) * n] *= 1.0 + 100.0 * (n - i);
    }
    CHECK_STATUS(rb_contact_state_alloc(n, &s), RB_OK);
    for (int i = 0; i < n; i++)
        s.zone[i] = RB_ZONE_STICK;
    by.products = 0;
    CHECK_STATUS(rb_contact_try_zones(&p, &s, gap), RB_OK);
    assert_in_range(by.products, 200, 400);
    for (int i = 0; i < n; i++) {
        CHECK_ABS(gap[i], 0.0, 1e-9 * GAP, "gap %d", i);
        CHECK_ABS(s.lambda[i], 0.0, 1e-9 * SLIP, "slip %d", i);
    }
    CHECK_REL(sum_of(n, p.load_N, s.p, p.load_T, s.q), p.load, 1e-9, "load");
    rb_contact_state_free(&s);
    rb_contact_problem_free(&p);
}

/* Large friction, where Newton's steps end from nearly the same friction only; the scales
 * and bounds of the problem stay what they were. */
TEST(products_follow_friction)
{
    static const struct {
        int n, load, force;
        double mu, coupling;
        uint64_t seed;
    } all[] = {{32, 0, 1, 100.0, 0.3, 102},
               {47, 1, 0, 10.0, 0.6, 117},
               {33, 1, 1, 1e3, 0.4, 103}};

    for (int k = 0; k < 3; k++) {
        const kind of = {.n = all[k].n,
                         .mu = all[k].mu,
                         .coupling = all[k].coupling,
                         .load_given = all[k].load,
                         .force_given = all[k].force,
                         .rolls = 1};
        const rb_contact_options options = options_of(RB_SOLVER_AUTO);
        rb_contact_problem p, with;
        rb_contact_state s;
        by_products by;
        outcome o = {0};
        rb_message why = {""};
        numbers = all[k].seed;
        random_problem(&of, &with);
        numbers = all[k].seed;
        random_problem(&of, &p);
        use_products(&p, &by);
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        assert_true(rb_contact_newton(&p, 0, &s) > 0);
        const rb_status status = rb_contact_solve(&p, &options, 0, &s, &why);
        check_outcome(&with, &s, status, &why, &o);
        assert_true(o.solved == 1 || (k == 2 && status == RB_MAXITER));
        CHECK_ABS(p.mu, of.mu, 0.0, "friction");
        for (int i = 0; i < of.n; i++)
            CHECK_ABS(p.bound[i], with.bound[i], 0.0, "bound %d", i);
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
        rb_contact_problem_free(&with);
    }
}

/* The answer to unit tractions at the middle element: by products, and by matrices, whose
 * diagonals are a mean over all. */
TEST(responses_are_those_to_unit_tractions)
{
    numbers = 24;
    for (int k = 0; k < 6; k++) {
        const kind of = {.n = 3 + k, .mu = 0.3, .coupling = 0.1, .rolls = k % 2};
        const int n = of.n, j = n / 2;
        rb_contact_problem p;
        by_products by;
        double gap = 0.0, slip = 0.0, coupled = 0.0, answer = 0.0, reach = 0.0;
        random_problem(&of, &p);
        const double *S = rb_contact_operator_matrix(p.op).S;
        for (int i = 0; i < n; i++) {
            gap += fabs(F[i + i * ldf]) / n;
            slip += fabs(S[i + (n + i) * n]) / n;
            coupled += fabs(S[j + i * n]); /* of the middle element to all pressures */
            answer += fabs(S[i + j * n]);  /* of all to the middle pressure */
            reach += fabs(F[i + j * ldf]);
        }
        rb_contact_response unit = rb_contact_operator_response(p.op);
        CHECK_REL(unit.gap, gap, 1e-14, "gap");
        CHECK_REL(unit.slip, slip, 1e-14, "slip");
        CHECK_REL(unit.coupled_slip, coupled, 1e-14, "slip of pressures");
        CHECK_ABS(unit.reach, 0.0, 0.0, "reach");
        const double own[] = {F[j + j * ldf], fabs(S[j + (n + j) * n])};
        use_products(&p, &by);
        unit = rb_contact_operator_response(p.op);
        CHECK_REL(unit.gap, own[0], 1e-14, "gap by a product");
        CHECK_REL(unit.slip, own[1], 1e-14, "slip by a product");
        CHECK_REL(unit.coupled_slip, answer, 1e-14, "slips of a pressure");
        CHECK_REL(unit.reach, reach / own[0], 1e-14, "reach");
        assert_true(unit.coupled);
        rb_contact_problem_free(&p);
    }
}

/* ---- Newton's trace ---------------------------------------------------------------- */

static void count_steps(const rb_contact_state *state, void *context)
{
    int *steps = context;
    for (int i = 0; i < state->n; i++)
        assert_in_range(state->zone[i], RB_ZONE_SEPARATED, RB_ZONE_YIELD_POSITIVE);
    ++*steps;
}

TEST(every_step_is_shown)
{
    numbers = 5;
    for (int yields = 0; yields < 2; yields++) {
        const kind of = {.n = 7, .mu = 0.3, .coupling = 0.05, .yields = yields};
        const rb_contact_options options = options_of(RB_SOLVER_NEWTON);
        rb_contact_problem p;
        rb_contact_state s;
        int steps = 0;
        random_problem(&of, &p);
        p.trace = count_steps;
        p.trace_context = &steps;
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        CHECK_STATUS(rb_contact_solve(&p, &options, 0, &s, NULL), RB_OK);
        assert_true(steps > 1);
        assert_int_equal(s.iterations, steps);
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
    }
}

/* ---- The LCP ----------------------------------------------------------------------- */

/* What every variable of a problem with a layer means, by its name. */
typedef struct {
    double gap, slip, plus, minus, yield_plus, yield_minus;
} meaning;

/* Places of the pairs + and - behind the pressures: by blocks, or next to each other. */
static int place(const rb_contact_lcp *lcp, int n, int group, int i, int sign)
{
    return lcp->form == RB_LCP_KWAK ? n + 2 * n * group + 2 * i + sign
                                    : n + 2 * n * group + n * sign + i;
}

static void check_lcp_rows(const rb_contact_problem *p, const rb_contact_lcp *lcp,
                           const double *z, const double *w)
{
    const int n = p->n, kwak = lcp->form == RB_LCP_KWAK;
    const double o = lcp->mirrored ? -1.0 : 1.0;
    double next = 0.0, second = 0.0, most;
    rb_contact_state s;

    CHECK_STATUS(rb_contact_state_alloc(n, &s), RB_OK);
    for (int i = 0; i < n; i++) /* of an earlier solve */
        s.p[i] = s.q[i] = s.lambda[i] = s.plastic[i] = 1e3;
    rb_contact_lcp_recover(p, lcp, z, &s);
    assert_int_equal(s.lcp_form, lcp->form);
    for (int i = n - 1; i >= 0; i--) {
        double gap, slip, s_plus = 0.0, s_minus = 0.0;
        move(p, &s, i, &gap, &slip);
        CHECK_REL(s.p[i], STRESS * z[i], 1e-14, "p %d", i);
        CHECK_ABS(w[i] * lcp->w_scale[i], gap, 1e-9 * GAP, "gap %d", i);
        if (p->yield) {
            const int plus = place(lcp, n, 1, i, 0), minus = place(lcp, n, 1, i, 1);
            s_plus = SLIP * z[plus];
            s_minus = SLIP * z[minus];
            CHECK_ABS(s.plastic[i], o * (s_plus - s_minus), 1e-12 * SLIP, "plastic %d",
                      i);
            const double u =
                p->recall[0] * next + p->recall[1] * second + p->own * (s_plus + s_minus);
            const double yield = p->yield[i] + p->hardening * u;
            second = next;
            next = u;
            CHECK_ABS(w[plus] * lcp->w_scale[plus], yield + o * s.q[i], 1e-9 * STRESS,
                      "+ %d", i);
            CHECK_ABS(w[minus] * lcp->w_scale[minus], yield - o * s.q[i], 1e-9 * STRESS,
                      "- %d", i);
        }
        const int first = place(lcp, n, 0, i, 0), other = place(lcp, n, 0, i, 1);
        const double plus = p->bound[i] * s.p[i] + o * s.q[i],
                     minus = p->bound[i] * s.p[i] - o * s.q[i];
        slip -= s.plastic[i];
        if (kwak) {
            CHECK_ABS(SLIP * (z[first] - z[other]), slip, 1e-9 * SLIP, "slip %d", i);
            CHECK_ABS(w[first] * lcp->w_scale[first], plus, 1e-9 * STRESS, "gamma+ %d",
                      i);
        } else {
            CHECK_ABS(w[first] * lcp->w_scale[first] - SLIP * z[other], o * slip,
                      1e-9 * SLIP, "slip %d", i);
            CHECK_ABS(z[first] * lcp->z_scale[first], plus, 1e-9 * STRESS, "gamma+ %d",
                      i);
        }
        CHECK_ABS(w[other] * lcp->w_scale[other], minus, 1e-9 * STRESS, "gamma- %d", i);
    }
    if (p->load_given)
        CHECK_ABS(w[lcp->size - 1 - p->force_given] *
                      lcp->w_scale[lcp->size - 1 - p->force_given],
                  sum_of(n, p->load_N, s.p, p->load_T, s.q) - p->load, 1e-9 * p->load,
                  "load");
    if (p->force_given)
        CHECK_ABS(w[lcp->size - 1] * lcp->w_scale[lcp->size - 1],
                  (lcp->xi0 > 0.0 ? 1.0 : -1.0) * force_error(p, &s, &most),
                  1e-9 * p->load, "force");
    rb_contact_state_free(&s);
}

TEST(every_row_of_the_lcp_is_its_equation)
{
    numbers = 6;
    for (int k = 0; k < 144; k++) {
        const kind of = {.n = 1 + k % 5,
                         .mu = 0.3,
                         .coupling = 0.1,
                         .load_given = k % 2,
                         .force_given = k / 2 % 2,
                         .axle = k / 2 % 2,
                         .yields = k / 12 % 4,
                         .order = k / 48};
        const rb_contact_lcp_form form = k / 4 % 3 == 2 ? RB_LCP_KWAK : RB_LCP_PIVOTED;
        double z[40], w[40];
        rb_contact_problem p;
        rb_contact_lcp lcp;
        random_problem(&of, &p);
        CHECK_STATUS(
            rb_contact_lcp_create(&p, form, k / 4 % 3, k % 5 ? SLIP : -SLIP, &lcp, NULL),
            RB_OK);
        assert_int_equal(lcp.size, (of.yields ? 5 : 3) * of.n + k % 2 + k / 2 % 2);
        assert_int_equal(lcp.mirrored, k / 4 % 3 == 1);
        for (int i = 0; i < lcp.size; i++)
            z[i] = uniform(0.0, 1.0);
        rb_lcp_residual(&(rb_lcp_problem){lcp.size, lcp.M, lcp.size, lcp.b}, z, w);
        check_lcp_rows(&p, &lcp, z, w);
        rb_contact_lcp_free(&lcp);
        rb_contact_problem_free(&p);
    }
}

/* Names on two elements, w then z; of a layer too. */
TEST(variables_have_names)
{
    static const char *const names[][26] = {
        {"gap[1]",      "gap[2]",      "lambda+[1]", "lambda+[2]",  "gamma-[1]",
         "gamma-[2]",   "yield+[1]",   "yield+[2]",  "yield-[1]",   "yield-[2]",
         "force[1]",    "force[2]",    "p[1]",       "p[2]",        "gamma+[1]",
         "gamma+[2]",   "lambda-[1]",  "lambda-[2]", "plastic+[1]", "plastic+[2]",
         "plastic-[1]", "plastic-[2]", "motion[1]",  "motion[2]",   "z0"},
        {"gap[1]",      "gap[2]",      "lambda-[1]", "lambda-[2]",  "gamma+[1]",
         "gamma+[2]",   "yield-[1]",   "yield-[2]",  "yield+[1]",   "yield+[2]",
         "force[1]",    "force[2]",    "p[1]",       "p[2]",        "gamma-[1]",
         "gamma-[2]",   "lambda+[1]",  "lambda+[2]", "plastic-[1]", "plastic-[2]",
         "plastic+[1]", "plastic+[2]", "motion[1]",  "motion[2]",   "z0"},
        {"gap[1]",      "gap[2]",      "gamma+[1]",  "gamma-[1]",   "gamma+[2]",
         "gamma-[2]",   "yield+[1]",   "yield-[1]",  "yield+[2]",   "yield-[2]",
         "force[1]",    "force[2]",    "p[1]",       "p[2]",        "lambda+[1]",
         "lambda-[1]",  "lambda+[2]",  "lambda-[2]", "plastic+[1]", "plastic-[1]",
         "plastic+[2]", "plastic-[2]", "motion[1]",  "motion[2]",   "z0"}};

    numbers = 7;
    for (int k = 0; k < 6; k++) {
        const kind of = {
            .n = 2, .mu = 0.3, .load_given = 1, .force_given = 1, .yields = k / 3};
        char name[RB_CONTACT_VARIABLE];
        rb_contact_problem p;
        rb_contact_lcp lcp;
        random_problem(&of, &p);
        CHECK_STATUS(rb_contact_lcp_create(&p, k % 3 == 2 ? RB_LCP_KWAK : RB_LCP_PIVOTED,
                                           k % 3, SLIP, &lcp, NULL),
                     RB_OK);
        for (int v = 0; v <= 2 * lcp.size; v++) {
            const int half = v / lcp.size * 12, at = v % lcp.size;
            const int skipped = !of.yields && at >= 6 ? 4 : 0; /* the layer's */
            assert_string_equal(rb_contact_lcp_variable(&lcp, of.n, v, name),
                                names[k % 3][half + at + skipped * (half < 24)]);
        }
        rb_contact_lcp_free(&lcp);
        rb_contact_problem_free(&p);
    }
}

/* The state tells which LCP it came from. */
TEST(the_lcp_of_a_state_is_the_one_that_gave_it)
{
    numbers = 8;
    for (int k = 0; k < 3; k++) {
        const kind of = {.n = 4, .mu = 0.3, .coupling = 0.05, .force_given = 2};
        rb_contact_options options = options_of(k ? RB_SOLVER_LEMKE : RB_SOLVER_NEWTON);
        rb_contact_problem p;
        rb_contact_state s;
        rb_contact_lcp lcp;
        options.lcp_form = k == 2 ? RB_LCP_KWAK : RB_LCP_PIVOTED;
        random_problem(&of, &p);
        p.force = 0.1 * of.mu * STRESS;
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        CHECK_STATUS(rb_contact_solve(&p, &options, 0, &s, NULL), RB_OK);
        assert_int_equal(s.solver, k ? RB_SOLVER_LEMKE : RB_SOLVER_NEWTON);
        for (int with = 0; with < 2; with++) {
            CHECK_STATUS(rb_contact_lcp_first(&p, &options, with ? &s : NULL, &lcp, NULL),
                         RB_OK);
            assert_int_equal(lcp.form, options.lcp_form);
            CHECK_ABS(lcp.xi0, -options.sliding, 0.0, "against a positive force");
            assert_int_equal(lcp.mirrored, k < 2);
            rb_contact_lcp_free(&lcp);
        }
        s.solver = RB_SOLVER_LEMKE;
        s.lcp_form = RB_LCP_PIVOTED;
        s.mirrored = 0;
        s.xi0 = 3.0;
        CHECK_STATUS(rb_contact_lcp_first(&p, &options, &s, &lcp, NULL), RB_OK);
        assert_int_equal(lcp.mirrored, 0);
        CHECK_ABS(lcp.xi0, 3.0, 0.0, "of the state");
        rb_contact_lcp_free(&lcp);
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
    }
}

/* ---- Zones of tractions and slips ---------------------------------------------------
 */

/* The layer of all elements has yielded upstream.  Each is at its yield stress to 1e-9,
 * and has yielded by 1e-8 of the slip's scale or more: it yields.  Not so where its
 * friction lacks 1e-6 (1), without pressure (2), without a plastic slip (4), and where
 * the friction of the surfaces is at its bound and they slide (5, 6). */
TEST(zones_are_told_by_what_is_larger)
{
    static const double yields_by[] = {-1e-8, 1e-8, 1e-8, 0.3, 0.0, 0.3, -0.3};
    static const int zone[] = {RB_ZONE_YIELD_POSITIVE, RB_ZONE_STICK,
                               RB_ZONE_SEPARATED,      RB_ZONE_YIELD_NEGATIVE,
                               RB_ZONE_STICK,          RB_ZONE_SLIP_NEGATIVE,
                               RB_ZONE_SLIP_POSITIVE};

    numbers = 23;
    for (int k = 0; k < 9; k++) {
        const kind of = {
            .n = 7, .mu = 0.3, .yields = 1 + k % 3, .order = k / 3, .coupling = 0.05};
        rb_contact_problem p;
        rb_contact_state s;
        double u[7];
        random_problem(&of, &p);
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        for (int i = 0; i < of.n; i++)
            s.lambda[i] = s.plastic[i] = yields_by[i] * SLIP;
        rb_contact_yielded(&p, s.plastic, u);
        for (int i = 0; i < of.n; i++) {
            const double yield = p.yield[i] + p.hardening * u[i];
            CHECK_REL(rb_contact_yield_stress(&p, i, u[i]), yield, 1e-14, "stress %d", i);
            s.p[i] = i == 2 ? 0.0 : 2.0 * yield / p.bound[i];
            s.q[i] = copysign(yield * (1.0 - 1e-9), -yields_by[i]);
        }
        s.q[1] *= 1.0 - 1e-6;
        s.lambda[5] += 0.1 * SLIP;
        s.q[5] = -p.bound[5] * s.p[5];
        s.lambda[6] -= 0.1 * SLIP;
        s.q[6] = p.bound[6] * s.p[6];
        rb_contact_classify(&p, 1e-12, &s);
        for (int i = 0; i < of.n; i++)
            if (s.zone[i] != zone[i])
                fail_msg("case %d: element %d is in zone %d", k, i, s.zone[i]);
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
    }
}

/* ---- Residuals, forces ------------------------------------------------------------- */

TEST(residuals_and_forces_are_sums_over_elements)
{
    numbers = 9;
    for (int k = 0; k < 64; k++) {
        const kind of = {.n = 1 + k % 6,
                         .mu = k % 5 ? 0.3 : 0.0,
                         .coupling = 0.1,
                         .load_given = k % 2,
                         .force_given = k % 5 ? k / 2 % 3 : 0,
                         .axle = k % 5 && k / 2 % 3,
                         .yields = k % 5 ? k / 8 % 4 : 0,
                         .order = k % 3};
        rb_contact_problem p;
        rb_contact_state s;
        rb_contact_violation v;
        double most, gap = 0.0, slip, friction = 0.0;
        random_problem(&of, &p);
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        for (int i = 0; i < of.n; i++) {
            s.p[i] = STRESS * uniform(-0.2, 1.0);
            s.q[i] = STRESS * uniform(-0.5, 0.5);
            s.plastic[i] = p.yield ? SLIP * uniform(-1.0, 1.0) : 0.0;
        }
        s.delta = GAP * uniform(-1.0, 1.0);
        s.xi = SLIP * uniform(-1.0, 1.0);
        for (int i = 0; i < of.n; i++) {
            double one;
            move(&p, &s, i, &one, &slip);
            gap = fmax(gap, GAP * conflict(one / GAP, s.p[i] / STRESS));
            friction = fmax(friction, fabs(s.q[i]) - p.bound[i] * s.p[i]);
        }
        CHECK_STATUS(rb_contact_residual(&p, &s, &v), RB_OK);
        CHECK_REL(v.scaled, residual_of(&p, &s), 1e-12, "residual");
        CHECK_REL(v.gap, gap, 1e-12, "gap");
        CHECK_ABS(v.slip, SLIP * friction_residual(&p, &s), 1e-12 * SLIP, "slip");
        double u[6];
        rb_contact_yielded(&p, s.plastic, u);
        for (int i = 0; i < of.n && p.yield; i++)
            friction =
                fmax(friction, fabs(s.q[i]) - fmax(p.yield[i] + p.hardening * u[i], 0.0));
        CHECK_REL(v.friction, friction, 1e-12, "friction");
        CHECK_REL(rb_contact_load(&p, &s), sum_of(of.n, p.load_N, s.p, p.load_T, s.q),
                  1e-12, "P");
        CHECK_REL(rb_contact_force(&p, &s), sum_of(of.n, p.force_N, s.p, p.force_T, s.q),
                  1e-12, "Q");
        CHECK_REL(rb_contact_moment(&p, &s),
                  sum_of(of.n, p.moment_N, s.p, p.moment_T, s.q), 1e-11, "M");
        force_error(&p, &s, &most);
        CHECK_ABS(rb_contact_capacity(&p, &s), most, 1e-12 * STRESS * of.n, "mu P");
        double resultant = 0.0;
        for (int i = 0; i < of.n; i++)
            resultant += STRESS * fabs(p.load_N[i]);
        CHECK_REL(rb_contact_force_scale(&p), of.mu * resultant, 1e-12, "scale of Q");
        double *const spoilt[] = {&s.p[0], &s.q[of.n - 1], &s.delta, &s.xi};
        for (int bad = 0; bad < 4; bad++) {
            const double kept = *spoilt[bad];
            *spoilt[bad] = NAN;
            CHECK_STATUS(rb_contact_residual(&p, &s, &v), RB_OK);
            assert_true(isinf(v.scaled));
            *spoilt[bad] = kept;
        }
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
    }
}

/* ---- Cones ------------------------------------------------------------------------- */

static int knows_it(const char *name)
{
    return strcmp(name, "it") == 0;
}

/* Tractions that tell their places; what has been asked for must be u = W r + q. */
static rb_status number_tractions(const char *name, const rb_contact_cone *cone,
                                  double tol, double *r, int *iterations, rb_message *why)
{
    (void)why;
    assert_string_equal(name, "it");
    assert_true(tol > 0.0 && tol < 1e-9);
    for (int i = 0; i < 2 * cone->n; i++)
        r[i] = 0.1 * (i + 1);
    *iterations += 7;
    return RB_OK;
}

TEST(cones_move_as_the_problem_does)
{
    numbers = 10;
    const kind of = {.n = 5, .mu = 0.3, .coupling = 0.1};
    static const rb_contact_cone_solvers by = {knows_it, number_tractions};
    rb_contact_options options = options_of(RB_SOLVER_CONE);
    rb_contact_problem p;
    rb_contact_state s;
    rb_contact_cone cone;
    rb_message why = {""};
    random_problem(&of, &p);
    CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
    s.delta = p.delta;
    s.xi = p.xi;
    s.iterations = 1;
    const struct {
        const rb_contact_cone_solvers *by;
        const char *name, *said;
    } refused[] = {{NULL, "it", "'it'"}, {&by, NULL, "''"}, {&by, "that", "'that'"}};
    for (int k = 0; k < 3; k++) {
        options.cone_solvers = refused[k].by;
        options.cone_solver = refused[k].name;
        CHECK_STATUS(rb_contact_cone_solve(&p, &options, &s, &why), RB_EINVAL);
        assert_non_null(strstr(why.text, refused[k].said));
    }
    options.cone_solver = "it";
    CHECK_STATUS(rb_contact_cone_solve(&p, &options, &s, &why), RB_OK);
    assert_int_equal(s.iterations, 8);
    CHECK_STATUS(rb_contact_cone_create(&p, s.delta, s.xi, &cone, &why), RB_OK);
    for (int i = 0; i < of.n; i++) {
        double gap, slip, u[2] = {cone.q[2 * i], cone.q[2 * i + 1]};
        move(&p, &s, i, &gap, &slip);
        CHECK_REL(s.p[i], STRESS * 0.1 * (2 * i + 1), 1e-14, "p %d", i);
        CHECK_REL(s.q[i], STRESS * 0.1 * (2 * i + 2), 1e-14, "q %d", i);
        CHECK_ABS(cone.mu[i], p.bound[i], 0.0, "mu %d", i);
        for (int j = 0; j < 2 * of.n; j++)
            for (int d = 0; d < 2; d++)
                u[d] += cone.W[2 * i + d + j * 2 * of.n] * 0.1 * (j + 1);
        CHECK_REL(GAP * u[0], gap, 1e-11, "gap %d", i);
        CHECK_REL(SLIP * u[1], slip, 1e-11, "slip %d", i);
    }
    rb_contact_cone_free(&cone);
    rb_contact_state_free(&s);
    rb_contact_problem_free(&p);
}

static rb_contact_state known;
static rb_status says;
static double noise;

/* The solution but for some noise, with the status that the test wants. */
static rb_status hand_back(const char *name, const rb_contact_cone *cone, double tol,
                           double *r, int *iterations, rb_message *why)
{
    (void)name, (void)tol, (void)iterations, (void)why;
    for (int i = 0; i < cone->n; i++) {
        const int touches = known.zone[i] != RB_ZONE_SEPARATED;
        r[2 * i] = touches * known.p[i] / STRESS * (1.0 + noise);
        r[2 * i + 1] = touches * known.q[i] / STRESS * (1.0 + noise);
    }
    return says;
}

/* A solution counts whatever the cone solver says of it, and noise is taken from it; no
 * tractions at all do not count. */
TEST(the_residual_judges_cone_solvers)
{
    static const struct {
        rb_status says;
        double noise;
        rb_status wanted;
    } all[] = {{RB_OK, 0.0, RB_OK},       {RB_OK, 1e-7, RB_OK},
               {RB_MAXITER, 1e-7, RB_OK}, {RB_OK, -1.0, RB_INACCURATE},
               {RB_RAY, -1.0, RB_RAY},    {RB_ENOMEM, 0.0, RB_ENOMEM}};
    static const rb_contact_cone_solvers by = {knows_it, hand_back};

    for (size_t k = 0; k < 4 * sizeof all / sizeof *all; k++) {
        const kind of = {.n = 7,
                         .mu = 0.3,
                         .coupling = 0.05,
                         .load_given = k / 6 % 2,
                         .force_given = k / 12};
        rb_contact_options options = options_of(RB_SOLVER_NEWTON);
        rb_contact_problem p;
        rb_contact_state s;
        rb_message why = {""};
        numbers = 14;
        random_problem(&of, &p);
        CHECK_STATUS(rb_contact_state_alloc(of.n, &known), RB_OK);
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        CHECK_STATUS(rb_contact_solve(&p, &options, 0, &known, NULL), RB_OK);
        options.solver = RB_SOLVER_CONE;
        options.cone_solvers = &by;
        options.cone_solver = "it";
        says = all[k % 6].says;
        noise = all[k % 6].noise;
        const rb_status status = rb_contact_solve(&p, &options, 0, &s, &why);
        if (status != all[k % 6].wanted)
            fail_msg("case %zu: %d, %s", k, status, why.text);
        if (all[k % 6].wanted >= 0)
            assert_int_equal(s.solver, RB_SOLVER_CONE);
        if (all[k % 6].wanted == RB_OK) {
            CHECK_MAX(residual_of(&p, &s), 1e-13, "case %zu", k);
            CHECK_ABS(s.xi, known.xi, 1e-12 * SLIP, "xi");
            CHECK_ABS(s.delta, known.delta, 1e-12 * GAP, "delta");
            check_zones(&p, &s);
        }
        rb_contact_state_free(&s);
        rb_contact_state_free(&known);
        rb_contact_problem_free(&p);
    }
}

/* The same of a layer: one solve with the laws that a state nearly obeys. */
TEST(a_layer_is_solved_from_what_is_nearly_its_solution)
{
    int polished = 0;

    numbers = 15;
    for (int k = 0; k < 60; k++) {
        const kind of = {.n = 3 + k % 5,
                         .mu = 0.3,
                         .coupling = 0.05,
                         .load_given = k % 2,
                         .yields = 1 + k / 2 % 3,
                         .order = k / 6 % 3};
        const rb_contact_options options = options_of(RB_SOLVER_AUTO);
        rb_contact_problem p;
        rb_contact_state s;
        int zone[8], same = 1;
        random_problem(&of, &p);
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        if (rb_contact_solve(&p, &options, 0, &s, NULL) == RB_OK) {
            memcpy(zone, s.zone, (size_t)of.n * sizeof *zone);
            for (int i = 0; i < of.n; i++) {
                s.p[i] *= 1.0 + 1e-9;
                s.q[i] *= 1.0 + 1e-9;
                s.plastic[i] *= 1.0 - 1e-9;
            }
            CHECK_STATUS(rb_contact_yield_polish(&p, &s), RB_OK);
            CHECK_MAX(residual_of(&p, &s), 1e-12, "case %d", k);
            for (int i = 0; i < of.n; i++)
                same = same && s.zone[i] == zone[i];
            polished += same;
        }
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
    }
    assert_int_equal(polished, 60);
}

/* ---- Refusals ---------------------------------------------------------------------- */

/* What needs matrices says so of products. */
TEST(products_have_no_lcp)
{
    numbers = 11;
    const kind of = {.n = 4, .mu = 0.3, .coupling = 0.05, .yields = 1};
    const rb_contact_options options = options_of(RB_SOLVER_AUTO);
    rb_contact_problem p;
    rb_contact_state s;
    rb_contact_lcp lcp;
    rb_contact_cone cone;
    by_products by;
    rb_message why = {""};
    random_problem(&of, &p);
    use_products(&p, &by);
    CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
    CHECK_STATUS(rb_contact_lcp_create(&p, RB_LCP_PIVOTED, 0, 1.0, &lcp, &why),
                 RB_EINVAL);
    assert_string_equal(why.text, "4 contact elements are too many for an LCP");
    CHECK_STATUS(rb_contact_cone_create(&p, 0.0, 0.0, &cone, &why), RB_EINVAL);
    assert_string_equal(why.text, "4 elements are too many for a dense W");
    CHECK_STATUS(rb_contact_solve(&p, &options, 0, &s, &why), RB_OK);
    rb_contact_state_free(&s);
    rb_contact_problem_free(&p);
}

/* Kwak's form has the inverse of A F_TT. */
TEST(kwaks_form_needs_an_inverse)
{
    const int n = 2;
    double *S = rb_alloc(2, 4);
    rb_contact_operator *op;
    rb_contact_problem p;
    rb_contact_lcp lcp;
    rb_message why = {""};
    for (int k = 0; k < 8; k++)
        F[k] = k % 3 == 0 ? 1.0 : 0.0;
    S[4] = S[5] = S[6] = S[7] = 1.0;
    CHECK_STATUS(rb_contact_operator_dense(n, F, n, S, &op), RB_OK);
    CHECK_STATUS(rb_contact_problem_alloc(op, &p), RB_OK);
    CHECK_STATUS(rb_contact_lcp_create(&p, RB_LCP_KWAK, 0, 1.0, &lcp, &why), RB_SINGULAR);
    assert_non_null(strstr(why.text, "LCP of 2 contact elements: "));
    assert_null(lcp.M);
    rb_contact_problem_free(&p);
}

/* A force beyond friction, a layer's stress, or the resistance to rolling beyond
 * friction. */
TEST(forces_that_nothing_carries_are_refused)
{
    static const struct {
        int yields;
        double force, ratio, axle;
        const char *said;
    } all[] = {{0, 1.1, 0.0, 0.0, "friction carries at most mu P = "},
               {0, -1.1, 0.0, 0.0, "friction carries at most mu P = "},
               {1, 0.98, 0.0, 0.0,
                NULL}, /* the more slip, the more a layer that hardens carries */
               {2, 0.98, 0.0, 0.0, "the interface yields, and carries at most "},
               {2, -0.98, 0.0, 0.0, "the interface yields, and carries at most "},
               {2, 0.0, 0.98, 0.0, "the interface yields, and carries at most "},
               {3, 0.98, 0.0, 0.0, "the interface yields, and carries at most "},
               {3, 0.0, -0.98, 0.0, "the interface yields, and carries at most "},
               {0, 0.0, 0.0, 30.0, "the resistance to rolling M/R_A = "}};

    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        const kind of = {.n = 6,
                         .mu = 0.3,
                         .coupling = 0.02,
                         .load_given = 1,
                         .force_given = 1,
                         .yields = all[k].yields};
        rb_contact_options options = options_of(RB_SOLVER_AUTO);
        rb_contact_problem p;
        rb_contact_state s;
        rb_message why = {""};
        numbers = 12;
        random_problem(&of, &p);
        for (int i = 0; i < of.n; i++) { /* the pressure leans to one side */
            p.moment_N[i] += 0.1 * p.load_N[i];
            p.bound[i] = of.mu;
        }
        p.force = all[k].force * of.mu * p.load;
        p.force_ratio = all[k].ratio;
        p.axle = all[k].axle;
        options.force_unit = " N/mm";
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        const rb_status status = rb_contact_solve(&p, &options, 0, &s, &why);
        if (all[k].said) {
            if (status != RB_EINVAL || !strstr(why.text, all[k].said) ||
                !strstr(why.text, " N/mm"))
                fail_msg("%zu: %d, %s", k, status, why.text);
        } else {
            assert_true(status >= 0);
        }
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
    }
}

/* A force that friction carries, in a problem that no solver solves to the tolerance. */
TEST(what_is_not_solved_says_so)
{
    for (int k = 0; k < 4; k++) {
        const kind of = {.n = 6,
                         .mu = 0.3,
                         .coupling = 0.02,
                         .load_given = k % 2,
                         .force_given = 2,
                         .yields = k / 2};
        rb_contact_options options = options_of(RB_SOLVER_AUTO);
        rb_contact_problem p;
        rb_contact_state s;
        rb_message why = {""};
        numbers = 19;
        random_problem(&of, &p);
        options.tol = 0.0;
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        const rb_status status = rb_contact_solve(&p, &options, 0, &s, &why);
        assert_true(status > 0 && s.status == status);
        assert_true(s.residual > 0.0 && s.residual < 1e-12);
        assert_non_null(strstr(why.text, "; scaled residual "));
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
    }
}

/* Each path of Lemke's method begins with pivot 0. */
typedef struct {
    int paths, attempt[12], pivots, tableaus;
} attempts;

static void note_attempts(const rb_lcp_pivot *pivot, void *context)
{
    attempts *a = context;
    if (pivot->pivot == 0)
        a->attempt[a->paths++] = pivot->attempt;
    a->pivots++;
    a->tableaus += pivot->tableau != NULL;
}

/* Where none is accurate enough, every form is tried once, evenly covered and unevenly,
 * in their order; Kwak's alone where it is asked for, with tableaus that are asked for.
 */
TEST(every_form_is_tried)
{
    static const int all[] = {0, 2, 2, 0, 1, 1};

    for (int kwak = 0; kwak < 2; kwak++) {
        const kind of = {.n = 5, .mu = 0.3, .coupling = 0.02};
        rb_contact_options options = options_of(RB_SOLVER_LEMKE);
        attempts tried = {0};
        rb_contact_problem p;
        rb_contact_state s;
        numbers = 26;
        random_problem(&of, &p);
        options.tol = 0.0;
        options.lcp_form = kwak ? RB_LCP_KWAK : RB_LCP_PIVOTED;
        options.trace = note_attempts;
        options.trace_context = &tried;
        options.trace_tableau = kwak;
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        assert_true(rb_contact_solve(&p, &options, 0, &s, NULL) > 0);
        assert_true(tried.paths >= (kwak ? 2 : 6));
        assert_int_equal(tried.tableaus, kwak ? tried.pivots : 0);
        for (int k = 0; k < tried.paths; k++)
            assert_int_equal(tried.attempt[k], kwak ? 2 : all[k % 6]);
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
    }
}

/* A yield stress that is followed down to a problem which has no solution: surfaces that
 * do not give way, under a load. */
TEST(a_layer_that_cannot_be_followed_is_not_solved)
{
    const kind of = {.n = 3, .mu = 0.3, .load_given = 1, .yields = 1};
    rb_contact_problem p;
    rb_contact_state s;

    numbers = 20;
    random_problem(&of, &p);
    for (int i = 0; i < of.n; i++)
        for (int j = 0; j < 2 * of.n; j++)
            F[i + j * ldf] = 0.0;
    CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
    for (int i = 0; i < of.n; i++) {
        s.zone[i] = RB_ZONE_STICK;
        s.p[i] = s.q[i] = STRESS;
    }
    CHECK_STATUS(rb_contact_yield_newton(&p, 1, &s), RB_MAXITER);
    rb_contact_state_free(&s);
    rb_contact_problem_free(&p);
}

/* Surfaces that do not touch carry no force, with and without a layer, for every solver.
 */
TEST(surfaces_apart_carry_nothing)
{
    static const rb_contact_solver solvers[] = {RB_SOLVER_LEMKE, RB_SOLVER_NEWTON};

    for (int k = 0; k < 4; k++) {
        const kind of = {.n = 3, .mu = 0.3, .force_given = 2, .yields = k / 2 * 2};
        const rb_contact_options options = options_of(solvers[k % 2]);
        rb_contact_problem p;
        rb_contact_state s;
        rb_message why = {""};
        numbers = 17;
        random_problem(&of, &p);
        p.delta = -10.0 * GAP;
        CHECK_STATUS(rb_contact_state_alloc(of.n, &s), RB_OK);
        CHECK_STATUS(rb_contact_solve(&p, &options, 0, &s, &why), RB_EINVAL);
        assert_non_null(strstr(why.text, "carries at most"));
        rb_contact_state_free(&s);
        rb_contact_problem_free(&p);
    }
}

/* ---- Memory ------------------------------------------------------------------------ */

enum { PROBLEMS = 5 };

/* Of every kind: matrices, products, layers, both forms of the LCP, a start from pairs.
 */
static kind kind_of(int k)
{
    return (kind){.n = 4,
                  .mu = 0.3,
                  .coupling = 0.05,
                  .load_given = k == 1,
                  .force_given = k == 1,
                  .yields = k == 2 || k == 4};
}

static rb_status create_operator(int by_matrix)
{
    by_products by = {.n = 2};
    const rb_contact_products products = {apply, divide, forget, &by, NULL};
    rb_contact_operator *op = NULL;
    rb_contact_problem p;

    by.S = rb_alloc(2, 4);
    by.gap = rb_alloc(2, 2);
    if (!by.S || !by.gap) {
        forget(&by);
        return RB_ENOMEM;
    }
    by.slip = by.gap + 2;
    by.S[4] = by.S[7] = 1.0;
    rb_status s = by_matrix ? rb_contact_operator_dense(2, F, ldf, by.S, &op)
                            : rb_contact_operator_products(2, &products, &op);
    if (by_matrix)
        free(by.gap);
    if (s != RB_OK)
        assert_null(op);
    if (s == RB_OK)
        s = rb_contact_problem_alloc(op, &p);
    if (s == RB_OK) {
        s = rb_contact_set_yield(&p, 1.0, 1.0);
        rb_contact_problem_free(&p);
    }
    assert_true(by_matrix || by.freed == 1);
    return s;
}

static rb_status solve_all(void *context)
{
    rb_contact_problem *p = context;
    rb_status s = create_operator(0);

    if (s == RB_OK)
        s = create_operator(1);
    for (int k = 0; k < PROBLEMS && s == RB_OK; k++) {
        rb_contact_options options =
            options_of(k == 3 || k == 4 ? RB_SOLVER_LEMKE : RB_SOLVER_AUTO);
        rb_contact_state state;
        options.lcp_form = k == 3 ? RB_LCP_KWAK : RB_LCP_PIVOTED;
        s = rb_contact_state_alloc(p[k].n, &state);
        if (s != RB_OK)
            break;
        s = rb_contact_solve(&p[k], &options, 0, &state, NULL);
        rb_contact_state_free(&state);
    }
    return s;
}

TEST(no_memory_is_said)
{
    rb_contact_problem p[PROBLEMS];
    by_products by;

    for (int k = 0; k < PROBLEMS; k++) {
        const kind of = kind_of(k);
        numbers = 13;
        random_problem(&of, &p[k]);
        if (k == 1)
            use_products(&p[k], &by);
    }
    assert_true(alloc_fail_every_call(solve_all, p) >
                10); /* one alone, then all from one on */
    for (int count = 0, refused = 1; refused; count++) {
        alloc_fail_after(count);
        const rb_status s = solve_all(p);
        refused = alloc_failed();
        alloc_succeed();
        assert_int_equal(s, refused ? RB_ENOMEM : RB_OK);
        assert_true(count < 5000);
    }
    for (int k = 0; k < PROBLEMS; k++)
        rb_contact_problem_free(&p[k]);
}

RUN_TESTS(NULL, NULL)
