/* Contact problems of random numbers, without a wheel: what every solver hands back is
 * judged by loops over the matrices, and so are the rows of the LCP, zones that are
 * held, scales, forces and refusals. */
#include "contact_random.h"

/* ---- Solutions --------------------------------------------------------------------- */

/* By all solvers, cold and then warm. */
static outcome check_solvers(const kind *of)
{
    static const rb_contact_solver solvers[] = {RB_SOLVER_AUTO, RB_SOLVER_LEMKE, RB_SOLVER_NEWTON};
    OWNED(rb_contact_problem) p;
    OWNED(rb_contact_state) s;
    outcome o = {0};

    random_problem(of, &p);
    CHECK_OK(rb_contact_state_alloc(of->n, &s));
    for (int k = 0; k < 6; k++) {
        const rb_contact_options options = options_of(solvers[k % 3]);
        const rb_status status = rb_contact_solve(&p, &options, k >= 3, &s, &message);
        check_outcome(&p, &s, status, &message, &o);
    }
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
        rb_contact_options options = options_of(k % 3 ? RB_SOLVER_LEMKE : RB_SOLVER_NEWTON);
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        double least = INFINITY;
        random_problem(&of, &p);
        p.sliding = k / 2 % 2 ? p.sliding : 1e-2 * SLIP;    /* too small to slide */
        memset(p.load_T, 0, sizeof(double) * (size_t)of.n); /* level: P has no friction in it */
        memset(p.force_N, 0, sizeof(double) * (size_t)of.n);
        memcpy(p.force_T, p.load_N, sizeof(double) * (size_t)of.n);
        p.force_ratio = sign;
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        CHECK_OK(rb_contact_solve(&p, &options, 0, &s, NULL));
        CHECK_MAX(residual_of(&p, &s), 1e-10, "case %d", k);
        for (int i = 0; i < of.n; i++) {
            double gap, slip;
            move(&p, &s, i, &gap, &slip);
            if (s.p[i] > 0.0)
                least = fmin(least, -sign * slip);
            CHECK_ABS(s.lambda[i], slip, 1e-9 * SLIP, "case %d: lambda %d", k, i);
        }
        CHECK_ABS(least, 0.0, 1e-9 * SLIP, "case %d: the slowest", k);
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
        const kind of = {
            .n = 7, .mu = 0.3, .coupling = 0.05, .load_given = k % 2, .yields = 1 + k % 3};
        const rb_contact_options options = options_of(RB_SOLVER_AUTO);
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        random_problem(&of, &p);
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        for (int i = 0; i < of.n; i++) {
            p.yield[i] = 1e3 * STRESS;
            s.plastic[i] = SLIP * (i + 1);
        }
        CHECK_OK(rb_contact_solve(&p, &options, k >= 6, &s, NULL));
        for (int i = 0; i < of.n; i++)
            CHECK_ABS(s.plastic[i], 0.0, 0.0, "element %d", i);
        CHECK_MAX(residual_of(&p, &s), 1e-8, "problem %d", k);
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
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        numbers = 1000 + (uint64_t)k;
        random_problem(&of, &p);
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        CHECK_OK(rb_contact_solve(&p, &options, 0, &s, NULL));
        CHECK_MAX(residual_of(&p, &s), 1e-9, "case %d", k);
        assert_int_equal(s.solver, all[c].by);
        CHECK_MAX(s.iterations, all[c].steps, "steps of case %d", k);
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
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        random_problem(&of, &p);
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        CHECK_OK(rb_contact_solve(&p, &options, 0, &s, NULL));
        assert_int_equal(s.solver, RB_SOLVER_LEMKE);
        sum[k % 3] += residual_of(&p, &s);
    }
    for (int k = 0; k < 3; k++)
        CHECK_MAX(sum[k] / 4.0, 3e-15, "layer %d", k);
}

/* ---- Zones that are held ----------------------------------------------------------- */

/* The linear problem of the zones, by its equations. */
static void check_held(const rb_contact_problem *p, const rb_contact_state *s, const double *gaps,
                       int round)
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
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        double gap[24];
        random_problem(&of, &p);
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        for (int i = 0; i < of.n; i++)
            s.zone[i] = i % 3 ? RB_ZONE_STICK : RB_ZONE_SLIP_NEGATIVE;
        for (int round = 0; round < 40; round++) {
            for (int c = round % 10 ? 1 : of.n / 2; c > 0; c--)
                s.zone[1 + (int)uniform(0.0, of.n - 1.0)] = (int)uniform(0.0, 4.0);
            s.zone[0] = RB_ZONE_STICK; /* a given force moves what sticks */
            if (round == 20)
                rb_contact_set_friction(&p, 0.2, NULL);
            CHECK_OK(rb_contact_try_zones(&p, &s, gap));
            check_held(&p, &s, gap, round);
        }
    }
}

/* Without a contact nothing can carry a load, without stick the creepage does not change
 * a force. */
TEST(zones_that_determine_nothing_are_singular)
{
    numbers = 4;
    for (int k = 0; k < 2; k++) {
        const kind of = {.n = 3, .mu = 0.3, .load_given = !k, .force_given = k};
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        double gap[3];
        random_problem(&of, &p);
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        for (int i = 0; i < of.n; i++)
            s.zone[i] = k ? RB_ZONE_SLIP_POSITIVE : RB_ZONE_SEPARATED;
        CHECK_STATUS(rb_contact_try_zones(&p, &s, gap), RB_SINGULAR);
    }
}

/* ---- Products alone ---------------------------------------------------------------- */

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
        OWNED(rb_contact_problem) with;
        OWNED(rb_contact_state) s;
        rb_contact_problem p;
        by_products by;
        outcome o = {0};
        numbers = 100 + (uint64_t)k;
        random_problem(&of, &with);
        numbers = 100 + (uint64_t)k;
        random_problem(&of, &p);
        use_products(&p, &by);
        assert_null(rb_contact_operator_matrix(p.op).F);
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        for (int warm = 0; warm < 2; warm++) {
            const rb_status status = rb_contact_solve(&p, &options, warm, &s, &message);
            check_outcome(&with, &s, status, &message, &o);
        }
        assert_int_equal(o.failed, 0);
        refused += !layer && o.refused > 0;
        const rb_contact_response unit = rb_contact_operator_response(p.op);
        CHECK_REL(unit.gap, GAP / STRESS, 1e-14, "gap");
        CHECK_REL(unit.slip, SLIP / STRESS, 1e-14, "slip");
        assert_int_equal(unit.coupled, of.coupling > 0.0 && of.n > 1);
        rb_contact_problem_free(&p);
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
        const kind of = {.n = 9, .mu = 0.3, .load_given = k % 2, .force_given = k / 2 % 2};
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        by_products by;
        double gap[9], P, Q;
        numbers = 21;
        random_problem(&of, &p);
        use_products(&p, &by);
        make_diagonal(&by);
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        for (int i = 0; i < of.n; i++) {
            s.zone[i] = i < 2             ? RB_ZONE_SEPARATED
                        : i == 4 && k < 4 ? RB_ZONE_SLIP_NEGATIVE
                                          : RB_ZONE_STICK;
            p.e_T[i] *= 0.01;
        }
        by.products = 0;
        CHECK_OK(rb_contact_try_zones(&p, &s, gap));
        CHECK_MAX(by.products, 5, "case %d", k);
        for (int i = 2; i < of.n; i++) {
            CHECK_REL(s.p[i], STRESS / GAP * (s.delta - p.d_N[i]), 1e-9, "pressure %d", i);
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
    }
}

/* Answers that differ by four digits from element to element need more steps than the
 * basis has room for: a second cycle goes on from where the first one has ended. */
TEST(a_full_basis_begins_anew)
{
    enum { n = 130 };
    const kind of = {.n = n, .mu = 0.3, .load_given = 1, .force_given = 1};
    OWNED(rb_contact_problem) p;
    OWNED(rb_contact_state) s;
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
    CHECK_OK(rb_contact_state_alloc(n, &s));
    for (int i = 0; i < n; i++)
        s.zone[i] = RB_ZONE_STICK;
    by.products = 0;
    CHECK_OK(rb_contact_try_zones(&p, &s, gap));
    assert_in_range(by.products, 200, 400);
    for (int i = 0; i < n; i++) {
        CHECK_ABS(gap[i], 0.0, 1e-9 * GAP, "gap %d", i);
        CHECK_ABS(s.lambda[i], 0.0, 1e-9 * SLIP, "slip %d", i);
    }
    CHECK_REL(sum_of(n, p.load_N, s.p, p.load_T, s.q), p.load, 1e-9, "load");
}

/* The answer to unit tractions at the middle element: by products, and by matrices, whose
 * diagonals are a mean over all. */
TEST(responses_are_those_to_unit_tractions)
{
    numbers = 24;
    for (int k = 0; k < 6; k++) {
        const kind of = {.n = 3 + k, .mu = 0.3, .coupling = 0.1, .rolls = k % 2};
        const int n = of.n, j = n / 2;
        OWNED(rb_contact_problem) p;
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
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        int steps = 0;
        random_problem(&of, &p);
        p.trace = count_steps;
        p.trace_context = &steps;
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        CHECK_OK(rb_contact_solve(&p, &options, 0, &s, NULL));
        assert_true(steps > 1);
        assert_int_equal(s.iterations, steps);
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

static void check_lcp_rows(const rb_contact_problem *p, const rb_contact_lcp *lcp, const double *z,
                           const double *w)
{
    const int n = p->n, kwak = lcp->form == RB_LCP_KWAK;
    const double o = lcp->mirrored ? -1.0 : 1.0;
    double next = 0.0, second = 0.0, most;
    OWNED(rb_contact_state) s;

    CHECK_OK(rb_contact_state_alloc(n, &s));
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
            CHECK_ABS(s.plastic[i], o * (s_plus - s_minus), 1e-12 * SLIP, "plastic %d", i);
            const double u =
                p->recall[0] * next + p->recall[1] * second + p->own * (s_plus + s_minus);
            const double yield = p->yield[i] + p->hardening * u;
            second = next;
            next = u;
            CHECK_ABS(w[plus] * lcp->w_scale[plus], yield + o * s.q[i], 1e-9 * STRESS, "+ %d", i);
            CHECK_ABS(w[minus] * lcp->w_scale[minus], yield - o * s.q[i], 1e-9 * STRESS, "- %d", i);
        }
        const int first = place(lcp, n, 0, i, 0), other = place(lcp, n, 0, i, 1);
        const double plus = p->bound[i] * s.p[i] + o * s.q[i],
                     minus = p->bound[i] * s.p[i] - o * s.q[i];
        slip -= s.plastic[i];
        if (kwak) {
            CHECK_ABS(SLIP * (z[first] - z[other]), slip, 1e-9 * SLIP, "slip %d", i);
            CHECK_ABS(w[first] * lcp->w_scale[first], plus, 1e-9 * STRESS, "gamma+ %d", i);
        } else {
            CHECK_ABS(w[first] * lcp->w_scale[first] - SLIP * z[other], o * slip, 1e-9 * SLIP,
                      "slip %d", i);
            CHECK_ABS(z[first] * lcp->z_scale[first], plus, 1e-9 * STRESS, "gamma+ %d", i);
        }
        CHECK_ABS(w[other] * lcp->w_scale[other], minus, 1e-9 * STRESS, "gamma- %d", i);
    }
    if (p->load_given)
        CHECK_ABS(w[lcp->size - 1 - p->force_given] * lcp->w_scale[lcp->size - 1 - p->force_given],
                  sum_of(n, p->load_N, s.p, p->load_T, s.q) - p->load, 1e-9 * p->load, "load");
    if (p->force_given)
        CHECK_ABS(w[lcp->size - 1] * lcp->w_scale[lcp->size - 1],
                  (lcp->xi0 > 0.0 ? 1.0 : -1.0) * force_error(p, &s, &most), 1e-9 * p->load,
                  "force");
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
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_lcp) lcp;
        random_problem(&of, &p);
        CHECK_OK(rb_contact_lcp_create(&p, form, k / 4 % 3, k % 5 ? SLIP : -SLIP, &lcp, NULL));
        assert_int_equal(lcp.size, (of.yields ? 5 : 3) * of.n + k % 2 + k / 2 % 2);
        assert_int_equal(lcp.mirrored, k / 4 % 3 == 1);
        for (int i = 0; i < lcp.size; i++)
            z[i] = uniform(0.0, 1.0);
        rb_lcp_residual(&(rb_lcp_problem){lcp.size, lcp.M, lcp.size, lcp.b}, z, w);
        check_lcp_rows(&p, &lcp, z, w);
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
        const kind of = {.n = 2, .mu = 0.3, .load_given = 1, .force_given = 1, .yields = k / 3};
        char name[RB_CONTACT_VARIABLE];
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_lcp) lcp;
        random_problem(&of, &p);
        CHECK_OK(rb_contact_lcp_create(&p, k % 3 == 2 ? RB_LCP_KWAK : RB_LCP_PIVOTED, k % 3, SLIP,
                                       &lcp, NULL));
        for (int v = 0; v <= 2 * lcp.size; v++) {
            const int half = v / lcp.size * 12, at = v % lcp.size;
            const int skipped = !of.yields && at >= 6 ? 4 : 0; /* the layer's */
            assert_string_equal(rb_contact_lcp_variable(&lcp, of.n, v, name),
                                names[k % 3][half + at + skipped * (half < 24)]);
        }
    }
}

/* The state tells which LCP it came from. */
TEST(the_lcp_of_a_state_is_the_one_that_gave_it)
{
    numbers = 8;
    for (int k = 0; k < 3; k++) {
        const kind of = {.n = 4, .mu = 0.3, .coupling = 0.05, .force_given = 2};
        rb_contact_options options = options_of(k ? RB_SOLVER_LEMKE : RB_SOLVER_NEWTON);
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        rb_contact_lcp lcp;
        options.lcp_form = k == 2 ? RB_LCP_KWAK : RB_LCP_PIVOTED;
        random_problem(&of, &p);
        p.force = 0.1 * of.mu * STRESS;
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        CHECK_OK(rb_contact_solve(&p, &options, 0, &s, NULL));
        assert_int_equal(s.solver, k ? RB_SOLVER_LEMKE : RB_SOLVER_NEWTON);
        for (int with = 0; with < 2; with++) {
            CHECK_OK(rb_contact_lcp_first(&p, &options, with ? &s : NULL, &lcp, NULL));
            assert_int_equal(lcp.form, options.lcp_form);
            CHECK_ABS(lcp.xi0, -p.sliding, 0.0, "against a positive force");
            assert_int_equal(lcp.mirrored, k < 2);
            rb_contact_lcp_free(&lcp);
        }
        s.solver = RB_SOLVER_LEMKE;
        s.lcp_form = RB_LCP_PIVOTED;
        s.mirrored = 0;
        s.xi0 = 3.0;
        CHECK_OK(rb_contact_lcp_first(&p, &options, &s, &lcp, NULL));
        assert_int_equal(lcp.mirrored, 0);
        CHECK_ABS(lcp.xi0, 3.0, 0.0, "of the state");
        rb_contact_lcp_free(&lcp);
    }
}

/* ---- Cones ------------------------------------------------------------------------- */

static rb_contact_state known;
static rb_status says;
static double noise;

/* The solution but for some noise, with the status that the test wants. */
static rb_status hand_back(const char *name, const rb_contact_cone *cone, double tol, double *r,
                           int *iterations, rb_message *why)
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
    } all[] = {{RB_OK, 0.0, RB_OK},          {RB_OK, 1e-7, RB_OK},   {RB_MAXITER, 1e-7, RB_OK},
               {RB_OK, -1.0, RB_INACCURATE}, {RB_RAY, -1.0, RB_RAY}, {RB_ENOMEM, 0.0, RB_ENOMEM}};

    for (size_t k = 0; k < 4 * sizeof all / sizeof *all; k++) {
        const kind of = {
            .n = 7, .mu = 0.3, .coupling = 0.05, .load_given = k / 6 % 2, .force_given = k / 12};
        rb_contact_options options = options_of(RB_SOLVER_NEWTON);
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        numbers = 14;
        random_problem(&of, &p);
        CHECK_OK(rb_contact_state_alloc(of.n, &known));
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        CHECK_OK(rb_contact_solve(&p, &options, 0, &known, NULL));
        options.solver = RB_SOLVER_CONE;
        options.cone_solver = (rb_contact_cone_solver){"it", hand_back};
        says = all[k % 6].says;
        noise = all[k % 6].noise;
        const rb_status status = rb_contact_solve(&p, &options, 0, &s, &message);
        if (status != all[k % 6].wanted)
            fail_msg("case %zu: %d, %s", k, status, message.text);
        if (all[k % 6].wanted >= 0)
            assert_int_equal(s.solver, RB_SOLVER_CONE);
        if (all[k % 6].wanted == RB_OK) {
            CHECK_MAX(residual_of(&p, &s), 1e-13, "case %zu", k);
            CHECK_ABS(s.xi, known.xi, 1e-12 * SLIP, "xi");
            CHECK_ABS(s.delta, known.delta, 1e-12 * GAP, "delta");
            check_zones(&p, &s);
        }
        rb_contact_state_free(&known);
    }
}

/* ---- Refusals ---------------------------------------------------------------------- */

/* What needs matrices says so of products. */
TEST(products_have_no_lcp)
{
    numbers = 11;
    const kind of = {.n = 4, .mu = 0.3, .coupling = 0.05, .yields = 1};
    const rb_contact_options options = options_of(RB_SOLVER_AUTO);
    OWNED(rb_contact_problem) p;
    OWNED(rb_contact_state) s;
    rb_contact_lcp lcp;
    rb_contact_cone cone;
    by_products by;
    random_problem(&of, &p);
    use_products(&p, &by);
    CHECK_OK(rb_contact_state_alloc(of.n, &s));
    CHECK_STATUS(rb_contact_lcp_create(&p, RB_LCP_PIVOTED, 0, 1.0, &lcp, &message), RB_EINVAL);
    assert_string_equal(message.text, "4 contact elements are too many for an LCP");
    CHECK_STATUS(rb_contact_cone_create(&p, 0.0, 0.0, &cone, &message), RB_EINVAL);
    assert_string_equal(message.text, "4 elements are too many for a dense W");
    CHECK_OK(rb_contact_solve(&p, &options, 0, &s, &message));
}

/* Kwak's form has the inverse of A F_TT. */
TEST(kwaks_form_needs_an_inverse)
{
    const int n = 2;
    double *S = rb_alloc(2, 4);
    rb_contact_operator *op;
    OWNED(rb_contact_problem) p;
    rb_contact_lcp lcp;
    for (int k = 0; k < 8; k++)
        F[k] = k % 3 == 0 ? 1.0 : 0.0;
    S[4] = S[5] = S[6] = S[7] = 1.0;
    CHECK_OK(rb_contact_operator_dense(n, F, n, S, &op));
    CHECK_OK(rb_contact_problem_alloc(op, &p));
    CHECK_SAYS(rb_contact_lcp_create(&p, RB_LCP_KWAK, 0, 1.0, &lcp, &message), RB_SINGULAR,
               "LCP of 2 contact elements: ");
    assert_null(lcp.M);
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
               {1, 0.98, 0.0, 0.0, NULL}, /* the more slip, the more a layer that hardens carries */
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
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        rb_message why = {.text = ""};
        numbers = 12;
        random_problem(&of, &p);
        for (int i = 0; i < of.n; i++) { /* the pressure leans to one side */
            p.moment_N[i] += 0.1 * p.load_N[i];
            p.bound[i] = of.mu;
        }
        p.force = all[k].force * of.mu * p.load;
        p.force_ratio = all[k].ratio;
        p.axle = all[k].axle;
        p.force_unit = " N/mm";
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        const rb_status status = rb_contact_solve(&p, &options, 0, &s, &why);
        if (all[k].said) {
            if (status != RB_EINVAL || !strstr(why.text, all[k].said) || !strstr(why.text, " N/mm"))
                fail_msg("%zu: %d, %s", k, status, why.text);
        } else {
            assert_true(status >= 0);
        }
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
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        rb_message why = {.text = ""};
        numbers = 19;
        random_problem(&of, &p);
        options.tol = 0.0;
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        const rb_status status = rb_contact_solve(&p, &options, 0, &s, &why);
        assert_true(status > 0 && s.status == status);
        assert_true(s.residual > 0.0 && s.residual < 1e-12);
        assert_non_null(strstr(why.text, "; scaled residual "));
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
 * in their order; Kwak's alone where it is asked for, with tableaus that are asked for. */
TEST(every_form_is_tried)
{
    static const int all[] = {0, 2, 2, 0, 1, 1};

    for (int kwak = 0; kwak < 2; kwak++) {
        const kind of = {.n = 5, .mu = 0.3, .coupling = 0.02};
        rb_contact_options options = options_of(RB_SOLVER_LEMKE);
        attempts tried = {0};
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        numbers = 26;
        random_problem(&of, &p);
        options.tol = 0.0;
        options.lcp_form = kwak ? RB_LCP_KWAK : RB_LCP_PIVOTED;
        p.pivot_trace = note_attempts;
        p.trace_context = &tried;
        p.trace_tableau = kwak;
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        assert_true(rb_contact_solve(&p, &options, 0, &s, NULL) > 0);
        assert_true(tried.paths >= (kwak ? 2 : 6));
        assert_int_equal(tried.tableaus, kwak ? tried.pivots : 0);
        for (int k = 0; k < tried.paths; k++)
            assert_int_equal(tried.attempt[k], kwak ? 2 : all[k % 6]);
    }
}

/* Surfaces that do not touch carry no force, with and without a layer, for every solver. */
TEST(surfaces_apart_carry_nothing)
{
    static const rb_contact_solver solvers[] = {RB_SOLVER_LEMKE, RB_SOLVER_NEWTON};

    for (int k = 0; k < 4; k++) {
        const kind of = {.n = 3, .mu = 0.3, .force_given = 2, .yields = k / 2 * 2};
        const rb_contact_options options = options_of(solvers[k % 2]);
        OWNED(rb_contact_problem) p;
        OWNED(rb_contact_state) s;
        numbers = 17;
        random_problem(&of, &p);
        p.delta = -10.0 * GAP;
        CHECK_OK(rb_contact_state_alloc(of.n, &s));
        CHECK_SAYS(rb_contact_solve(&p, &options, 0, &s, &message), RB_EINVAL, "carries at most");
    }
}

/* ---- Memory ------------------------------------------------------------------------ */

enum { PROBLEMS = 5 };

/* Of every kind: matrices, products, layers, both forms of the LCP, a start from pairs. */
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
        OWNED(rb_contact_state) state;
        options.lcp_form = k == 3 ? RB_LCP_KWAK : RB_LCP_PIVOTED;
        s = rb_contact_state_alloc(p[k].n, &state);
        if (s != RB_OK)
            break;
        s = rb_contact_solve(&p[k], &options, 0, &state, NULL);
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
    assert_true(alloc_fail_every_call(solve_all, p) > 10); /* one alone, then all from one on */
    for (int count = 0, refused = 1; refused; count++) {
        refused = REFUSED_FROM(count, solve_all(p));
        assert_true(count < 5000);
    }
    for (int k = 0; k < PROBLEMS; k++)
        rb_contact_problem_free(&p[k]);
}

RUN_TESTS(NULL, NULL)
