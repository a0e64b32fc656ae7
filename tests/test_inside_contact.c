/* What src/lcp/contact keeps to itself, on random problems: Newton's search, pairs of
 * elements, paths, zones of tractions and slips, residuals, cones, layers that yield. */
#include "lcp/contact/internal.h"
#include "contact_random.h"

/* Where pressure and friction do not meet, Newton's method solves for one after the
 * other, the given force with what slides already carries. */
TEST(uncoupled_problems_are_solved_in_turn)
{
    int sticks = 0, slides = 0;

    numbers = 19;
    for (int k = 0; k < 16; k++) {
        const kind of = {.n = 9, .mu = 0.3, .force_given = 1, .axle = k / 8};
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        random_problem(&of, &p);
        p.force_ratio = k % 2 ? -0.7 : 0.6;
        if (k / 4 % 2) {
            p.force = p.force_ratio * 0.1 * of.mu * p.load;
            p.force_ratio = 0.0;
        }
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        CHECK_OK(rb_contact_newton(&p, 0, &s));
        CHECK_MAX(residual_of(&p, &s), 1e-11, "case %d", k);
        for (int i = 0; i < of.n; i++) {
            sticks += s.zone[i] == RB_ZONE_STICK;
            slides += s.zone[i] > RB_ZONE_STICK;
        }
    }
    assert_true(sticks > 10 && slides > 10);
}

/* Pairs of elements have one traction each, and the mean gap and slip of the two. */
TEST(pairs_move_as_their_elements)
{
    numbers = 18;
    const kind of = {.n = 8, .mu = 0.3, .coupling = 0.1, .load_given = 1, .force_given = 2};
    OWNED(rb_contact_problem) p, half;
    OWNED(rb_contact_state) fine, coarse;
    double gap[4], slip[4], most;

    random_problem(&of, &p);
    CHECK_OK(rb_contact_halve(&p, &half));
    assert_int_equal(half.n, 4);
    CHECK_OK(rb_contact_state_alloc(8, &fine));
    CHECK_OK(rb_contact_state_alloc(4, &coarse));
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
        CHECK_REL(half.bound[i], 0.5 * (p.bound[2 * i] + p.bound[2 * i + 1]), 1e-14, "bound");
    }
    CHECK_REL(rb_contact_load(&half, &coarse), rb_contact_load(&p, &fine), 1e-13, "P");
    CHECK_REL(rb_contact_force(&half, &coarse), rb_contact_force(&p, &fine), 1e-12, "Q");
    CHECK_REL(rb_contact_moment(&half, &coarse), rb_contact_moment(&p, &fine), 1e-12, "M");
    CHECK_ABS(force_error(&half, &coarse, &most) - rb_contact_force(&half, &coarse), -p.force,
              1e-12 * STRESS, "the force that is given");
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
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        random_problem(&of, &p);
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        CHECK_OK(rb_contact_solve(&p, &options, 0, &s, NULL));
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
    }
    assert_int_equal(solved, 61);
    assert_in_range(solves, 460, 468); /* three, and two for every bend */
}

/* Large friction, where Newton's steps end from nearly the same friction only; the scales
 * and bounds of the problem stay what they were. */
TEST(products_follow_friction)
{
    static const struct {
        int n, load, force;
        double mu, coupling;
        uint64_t seed;
    } all[] = {{32, 0, 1, 100.0, 0.3, 102}, {47, 1, 0, 10.0, 0.6, 117}, {33, 1, 1, 1e3, 0.4, 103}};

    for (int k = 0; k < 3; k++) {
        const kind of = {.n = all[k].n,
                         .mu = all[k].mu,
                         .coupling = all[k].coupling,
                         .load_given = all[k].load,
                         .force_given = all[k].force,
                         .rolls = 1};
        const rb_contact_options options = options_of(RB_SOLVER_AUTO);
        OWNED(rb_contact_problem) p, with;
        OWNED(rb_contact_state) s;
        by_products by;
        outcome o = {0};
        numbers = all[k].seed;
        random_problem(&of, &with);
        numbers = all[k].seed;
        random_problem(&of, &p);
        use_products(&p, &by);
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        assert_true(rb_contact_newton(&p, 0, &s) > 0);
        const rb_status status = rb_contact_solve(&p, &options, 0, &s, &message);
        check_outcome(&with, &s, status, &message, &o);
        assert_true(o.solved == 1 || (k == 2 && status == RB_MAXITER));
        CHECK_ABS(p.mu, of.mu, 0.0, "friction");
        for (int i = 0; i < of.n; i++)
            CHECK_ABS(p.bound[i], with.bound[i], 0.0, "bound %d", i);
    }
}

/* The layer of all elements has yielded upstream.  Each is at its yield stress to 1e-9,
 * and has yielded by 1e-8 of the slip's scale or more: it yields.  Not so where its
 * friction lacks 1e-6 (1), without pressure (2), without a plastic slip (4), and where
 * the friction of the surfaces is at its bound and they slide (5, 6). */
TEST(zones_are_told_by_what_is_larger)
{
    static const double yields_by[] = {-1e-8, 1e-8, 1e-8, 0.3, 0.0, 0.3, -0.3};
    static const int zone[] = {RB_ZONE_YIELD_POSITIVE, RB_ZONE_STICK, RB_ZONE_SEPARATED,
                               RB_ZONE_YIELD_NEGATIVE, RB_ZONE_STICK, RB_ZONE_SLIP_NEGATIVE,
                               RB_ZONE_SLIP_POSITIVE};

    numbers = 23;
    for (int k = 0; k < 9; k++) {
        const kind of = {.n = 7, .mu = 0.3, .yields = 1 + k % 3, .order = k / 3, .coupling = 0.05};
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        double u[7];
        random_problem(&of, &p);
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        for (int i = 0; i < of.n; i++)
            s.lambda[i] = s.plastic[i] = yields_by[i] * SLIP;
        rb_contact_yielded(&p, s.plastic, NULL, u);
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
    }
}

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
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        rb_contact_violation v;
        double most, gap = 0.0, slip, friction = 0.0;
        random_problem(&of, &p);
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
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
        CHECK_OK(rb_contact_residual(&p, &s, &v));
        CHECK_REL(v.scaled, residual_of(&p, &s), 1e-12, "residual");
        CHECK_REL(v.gap, gap, 1e-12, "gap");
        CHECK_ABS(v.slip, SLIP * friction_residual(&p, &s), 1e-12 * SLIP, "slip");
        double u[6];
        rb_contact_yielded(&p, s.plastic, NULL, u);
        for (int i = 0; i < of.n && p.yield; i++)
            friction = fmax(friction, fabs(s.q[i]) - fmax(p.yield[i] + p.hardening * u[i], 0.0));
        CHECK_REL(v.friction, friction, 1e-12, "friction");
        CHECK_REL(rb_contact_load(&p, &s), sum_of(of.n, p.load_N, s.p, p.load_T, s.q), 1e-12, "P");
        CHECK_REL(rb_contact_force(&p, &s), sum_of(of.n, p.force_N, s.p, p.force_T, s.q), 1e-12,
                  "Q");
        CHECK_REL(rb_contact_moment(&p, &s), sum_of(of.n, p.moment_N, s.p, p.moment_T, s.q), 1e-11,
                  "M");
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
            CHECK_OK(rb_contact_residual(&p, &s, &v));
            assert_true(isinf(v.scaled));
            *spoilt[bad] = kept;
        }
    }
}

/* Tractions that tell their places; what has been asked for must be u = W r + q. */
static rb_status number_tractions(const char *name, const rb_contact_cone *cone, double tol,
                                  double *r, int *iterations, rb_message *why)
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
    rb_contact_options options = options_of(RB_SOLVER_CONE);
    OWNED(rb_contact_problem) p;
    OWNED(rb_contact_state) s;
    OWNED(rb_contact_cone) cone;
    random_problem(&of, &p);
    CHECK_OK(rb_contact_state_alloc(of.n, &s));
    s.delta = p.delta;
    s.xi = p.xi;
    s.iterations = 1;
    const struct {
        const char *name, *said;
    } refused[] = {{"it", "'it'"}, {NULL, "''"}};
    for (int k = 0; k < 2; k++) {
        options.cone_solver = (rb_contact_cone_solver){refused[k].name, NULL};
        CHECK_SAYS(rb_contact_cone_solve(&p, &options, &s, &message), RB_EINVAL, refused[k].said);
    }
    options.cone_solver = (rb_contact_cone_solver){"it", number_tractions};
    CHECK_OK(rb_contact_cone_solve(&p, &options, &s, &message));
    assert_int_equal(s.iterations, 8);
    CHECK_OK(rb_contact_cone_create(&p, s.delta, s.xi, &cone, &message));
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
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        int zone[8], same = 1;
        random_problem(&of, &p);
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        if (rb_contact_solve(&p, &options, 0, &s, NULL) == RB_OK) {
            memcpy(zone, s.zone, (size_t)of.n * sizeof *zone);
            for (int i = 0; i < of.n; i++) {
                s.p[i] *= 1.0 + 1e-9;
                s.q[i] *= 1.0 + 1e-9;
                s.plastic[i] *= 1.0 - 1e-9;
            }
            CHECK_OK(rb_contact_yield_polish(&p, &s));
            CHECK_MAX(residual_of(&p, &s), 1e-12, "case %d", k);
            for (int i = 0; i < of.n; i++)
                same = same && s.zone[i] == zone[i];
            polished += same;
        }
    }
    assert_int_equal(polished, 60);
}

/* A yield stress that is followed down to a problem which has no solution: surfaces that
 * do not give way, under a load. */
TEST(a_layer_that_cannot_be_followed_is_not_solved)
{
    const kind of = {.n = 3, .mu = 0.3, .load_given = 1, .yields = 1};
    OWNED(rb_contact_problem) p;
    OWNED(rb_contact_state) s;

    numbers = 20;
    random_problem(&of, &p);
    for (int i = 0; i < of.n; i++)
        for (int j = 0; j < 2 * of.n; j++)
            F[i + j * ldf] = 0.0;
    CHECK_OK(rb_contact_state_alloc(of.n, &s));
    for (int i = 0; i < of.n; i++) {
        s.zone[i] = RB_ZONE_STICK;
        s.p[i] = s.q[i] = STRESS;
    }
    CHECK_STATUS(rb_contact_yield_newton(&p, 1, &s), RB_MAXITER);
}

/* Allocations of a solve with the zones of the state. */
static int allocations(rb_contact_problem *p, rb_contact_state *s)
{
    double gap[24];

    int count = 0;
    while (REFUSED_FROM(count, rb_contact_try_zones(p, s, gap)))
        count++;
    return count;
}

/* The second solve has the room of the first one, until that is forgotten; bounds that
 * stay what they are change nothing. */
TEST(what_is_kept_can_be_forgotten)
{
    for (int k = 0; k < 4; k++) {
        const kind of = {.n = 24, .mu = 0.3, .coupling = k % 2 ? 0.05 : 0.0, .force_given = k / 2};
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        double gap[24];
        numbers = 25;
        random_problem(&of, &p);
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        for (int i = 0; i < of.n; i++)
            s.zone[i] = i % 3 ? RB_ZONE_STICK : RB_ZONE_SLIP_NEGATIVE;
        CHECK_OK(rb_contact_try_zones(&p, &s, gap));
        const int again = allocations(&p, &s);
        p.op->kind->forget(p.op);
        CHECK_OK(rb_contact_try_zones(&p, &s, gap));
        assert_int_equal(allocations(&p, &s), again);
        rb_contact_set_friction(&p, p.mu, p.bound); /* the same */
        alloc_fail_after(again);
        CHECK_OK(rb_contact_try_zones(&p, &s, gap));
        alloc_succeed();
        p.op->kind->forget(p.op);
        alloc_fail_after(again);
        CHECK_STATUS(rb_contact_try_zones(&p, &s, gap), RB_ENOMEM);
        alloc_succeed();
    }
}

RUN_TESTS(NULL, NULL)
