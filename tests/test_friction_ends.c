/* What every friction solver does at its limits: with no time, with numbers beyond the
 * largest, with arguments that are none, and without memory. */
#include "check.h"
#include "friction_problems.h"
#include "lcp/friction/friction.h"
#include "numbers.h"

#include <float.h>

enum { NC = 4, LARGEST = 3 * NC };

static unsigned long long seed = 31;

static double uniform(void)
{
    return uniform_of(&seed);
}

/* Coupled contacts that are pressed and dragged; W times `unit`. */
static void make_local(int d, double unit, rb_friction_problem *p)
{
    const int m = d * NC;
    *p = zero_local(d, NC);
    for (int j = 0; j < m; j++)
        for (int i = 0; i <= j; i++)
            p->W[i + j * m] = p->W[j + i * m] = unit * (i == j ? 3.0 : 0.4 * uniform());
    for (int i = 0; i < m; i++)
        p->q[i] = i % d ? 0.8 * uniform() : -1.0;
    for (int c = 0; c < NC; c++)
        p->mu[c] = 0.3;
}

/* The same W as that of a structure: K is its inverse's place, H = 1, so that W = K^-1. */
static void make_global(int d, rb_friction_problem *p)
{
    const int m = d * NC;
    OWNED(rb_friction_problem) local;
    OWNED(rb_triplets) H = {.rows = m, .cols = m};
    make_local(d, 1.0, &local);
    *p = zero_global(d, NC, m);
    memcpy(p->mu, local.mu, NC * sizeof *p->mu);
    memcpy(p->w, local.q, (size_t)m * sizeof *p->w);
    for (int i = 0; i < m; i++)
        rb_triplets_add(&H, i, i, 1.0);
    CHECK_OK(rb_sparse_from_triplets(&H, &p->H));
    CHECK_OK(rb_sparse_from_dense(m, m, local.W, m, &p->K));
}

static rb_status solve_named(const char *name, const rb_friction_problem *p,
                             const rb_friction_options *opt, rb_friction_info *info)
{
    static double r[LARGEST], u[LARGEST], v[LARGEST];
    return rb_friction_solve(name, p, opt, &(rb_friction_solution){r, u, v}, info);
}

/* What takes a problem of this dimension, by name. */
static int takes(const rb_friction_solver *solver, int d)
{
    return d == 2 || !(solver->needs & RB_FRICTION_ONLY_2D);
}

TEST(without_time_every_solver_says_so)
{
    int count;
    const rb_friction_solver *all = rb_friction_solvers(&count);
    rb_friction_options opt = rb_friction_defaults();
    opt.seconds = 1e-9;
    opt.tol = 1e-13;
    for (int d = 2; d <= 3; d++) {
        OWNED(rb_friction_problem) p;
        make_local(d, 1.0, &p);
        for (int k = 0; k < count; k++) {
            rb_friction_info info;
            if (!takes(&all[k], d))
                continue;
            const rb_status s = solve_named(all[k].name, &p, &opt, &info);
            if (s != RB_INTERRUPTED)
                fail_msg("%s, d = %d: %s", all[k].name, d, rb_status_text(s));
            assert_true(info.iters <= 1);
        }
    }
}

/* Velocities whose squares and sums overflow are not solved, and not called solved. */
TEST(numbers_beyond_the_largest_are_not_solved)
{
    int count;
    const rb_friction_solver *all = rb_friction_solvers(&count);
    rb_friction_options opt = rb_friction_defaults();
    opt.max_iters = 300;
    for (int d = 2; d <= 3; d++) {
        OWNED(rb_friction_problem) p;
        make_local(d, 0.3 * DBL_MAX, &p);
        for (int i = 0; i < d * NC; i++)
            p.q[i] *= DBL_MAX;
        for (int k = 0; k < count; k++) {
            rb_friction_info info;
            const double guess[LARGEST] = {9.0, 0.0, 0.0, 9.0, 9.0, 0.0, 9.0};
            if (!takes(&all[k], d))
                continue;
            opt.r0 = guess;
            if (solve_named(all[k].name, &p, &opt, &info) == RB_OK)
                fail_msg("%s, d = %d: solved, %g", all[k].name, d, info.scaled);
        }
    }
}

static int count_looks(const rb_friction_progress *at, void *context)
{
    (void)at;
    ++*(int *)context;
    return 0;
}

/* The measure costs as much as a sweep: it is looked at after 1, 2, 4 ... 128 sweeps and
 * every 200, and else only where the change of a sweep says that it may be met. */
TEST(sweeps_seldom_look_at_the_measure)
{
    for (int d = 2; d <= 3; d++) {
        OWNED(rb_friction_problem) p;
        rb_friction_info info;
        rb_friction_options opt = rb_friction_defaults();
        int looks = 0;
        make_local(d, 1.0, &p);
        for (int j = 0; j < NC; j++) /* contacts that nearly do the same */
            for (int i = 0; i < NC; i++)
                p.W[i * d + j * d * d * NC] = i == j ? 3.0 : 2.97;
        for (int c = 0; c < NC; c++)
            p.q[c * d] = -1.0 - 0.001 * c;
        opt.progress = count_looks;
        opt.context = &looks;
        CHECK_OK(solve_named("nsgs-ac", &p, &opt, &info));
        assert_true(info.iters > 300);
        CHECK_MAX(looks, 12 + info.iters / 200, "d = %d, %d sweeps", d, info.iters);
        looks = 0;
        opt.max_iters = 35;
        solve_named("admm", &p, &opt, &info); /* every tenth, and at both ends */
        CHECK_MAX(looks, 3 + info.iters / 10, "d = %d, %d iterations", d, info.iters);
        opt.max_iters = 0;
    }
}

TEST(options_that_are_none_are_refused)
{
    static const rb_friction_options bad[] = {{.tol = 0.0},
                                              {.tol = NAN},
                                              {.tol = 1e-8, .max_iters = -1},
                                              {.tol = 1e-8, .seconds = -1.0},
                                              {.tol = 1e-8, .seconds = NAN}};
    OWNED(rb_friction_problem) p;
    rb_friction_handle *handle;
    rb_friction_info info;
    make_local(3, 1.0, &p);
    CHECK_OK(rb_friction_setup(&p, &handle, NULL));
    double r[LARGEST], u[LARGEST];
    const rb_friction_solution at = {r, u, NULL};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        CHECK_STATUS(solve_named("nsgs-ac", &p, &bad[k], &info), RB_EINVAL);
        assert_non_null(strstr(info.msg.text, "max_iters ="));
        CHECK_STATUS(rb_friction_handle_solve(handle, NULL, &bad[k], &at, NULL), RB_EINVAL);
    }
    CHECK_STATUS(solve_named("lemke", &p, NULL, &info), RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "in 2D only"));
    CHECK_STATUS(solve_named("nobody", &p, NULL, &info), RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "nobody"));
    rb_friction_handle_free(handle);
}

/* A handle starts from its last solution, unless it is given another start, and forgets
 * nothing where a call fails. */
TEST(a_handle_keeps_its_last_solution)
{
    for (int global = 0; global < 2; global++) {
        OWNED(rb_friction_problem) p;
        rb_friction_handle *handle;
        rb_friction_info info;
        rb_friction_options opt = rb_friction_defaults();
        double r[LARGEST], u[LARGEST], v[LARGEST], zero[LARGEST] = {0.0};
        if (global)
            make_global(3, &p);
        else
            make_local(3, 1.0, &p);
        CHECK_OK(rb_friction_setup(&p, &handle, NULL));
        const rb_friction_solution at = {r, u, global ? v : NULL};
        opt.max_iters = 1;
        CHECK_STATUS(rb_friction_handle_solve(handle, "nsgs-ac", &opt, &at, &info),
                     RB_MAXITER); /* which is no solution to start from */
        opt.max_iters = 0;
        CHECK_OK(rb_friction_handle_solve(handle, "nsgs-ac", &opt, &at, &info));
        const int cold = info.iters;
        assert_true(cold > 1);
        CHECK_OK(rb_friction_handle_solve(handle, "nsgs-ac", &opt, &at, &info));
        assert_int_equal(info.iters, 0);
        opt.r0 = zero;
        opt.v0 = zero;
        CHECK_OK(rb_friction_handle_solve(handle, "nsgs-ac", &opt, &at, &info));
        assert_int_equal(info.iters, cold);
        rb_friction_handle_free(handle);
    }
}

/* ---- Facts and refusals of problems ------------------------------------------------ */

TEST(facts_do_not_depend_on_the_form)
{
    for (int with_rank = 0; with_rank < 2; with_rank++) {
        rb_friction_problem p;
        rb_friction_facts dense, sparse, global;
        make_local(3, 1.0, &p);
        p.W[1] += 0.3; /* not symmetric any more */
        CHECK_OK(rb_friction_examine(&p, with_rank, &dense));
        make_only_sparse(&p);
        CHECK_OK(rb_friction_examine(&p, with_rank, &sparse));
        CHECK_REL(dense.asymmetry, 0.3 / 3.0, 1e-14, "asymmetry");
        CHECK_ABS(sparse.asymmetry, dense.asymmetry, 0.0, "asymmetry");
        assert_int_equal(dense.rank, with_rank ? LARGEST : 0);
        assert_int_equal(sparse.rank, dense.rank);
        assert_int_equal(dense.hyperstaticity, 0);
        assert_int_equal(dense.indefinite, 0);
        p.Ws.x[0] = -1.0;
        CHECK_OK(rb_friction_examine(&p, with_rank, &sparse));
        assert_int_equal(sparse.indefinite, 1);
        rb_friction_problem_free(&p);
        make_global(3, &p);
        CHECK_OK(rb_friction_examine(&p, with_rank, &global));
        assert_int_equal(global.rank, with_rank ? LARGEST : 0);
        assert_int_equal(global.nullity, 0);
        rb_friction_problem_free(&p);
    }
}

typedef enum { NO_P, NO_I, NO_X, NO_ROWS, NO_COLS, INFINITE, DEFECTS } defect;

TEST(damaged_matrices_are_named)
{
    static const char *const words[DEFECTS] = {"H is missing", "H is missing", "H is missing",
                                               "H is 11 x 12", "H is 12 x 11", "H: entry 1 is inf"};
    for (defect k = 0; k < DEFECTS; k++) {
        OWNED(rb_friction_problem) p;
        make_global(3, &p);
        rb_sparse whole = p.H;
        const double first = whole.x[0];
        switch (k) {
        case NO_P:
            p.H.p = NULL;
            break;
        case NO_I:
            p.H.i = NULL;
            break;
        case NO_X:
            p.H.x = NULL;
            break;
        case NO_ROWS:
            p.H.rows--;
            break;
        case NO_COLS:
            p.H.cols--;
            break;
        default:
            whole.x[0] = INFINITY;
        }
        CHECK_SAYS(rb_friction_problem_check(&p, &message), RB_EINVAL, words[k]);
        p.H = whole;
        p.H.x[0] = first;
        CHECK_OK(rb_friction_problem_check(&p, &message));
        p.dofs = 0;
        CHECK_SAYS(rb_friction_problem_check(&p, &message), RB_EINVAL, "0 degrees of freedom");
        p.dofs = LARGEST;
    }
    rb_friction_problem_free(NULL);
}

TEST(damaged_vectors_are_named)
{
    for (int global = 0; global < 2; global++) {
        OWNED(rb_friction_problem) p;
        if (global)
            make_global(3, &p);
        else
            make_local(3, 1.0, &p);
        struct {
            const char *name;
            double **x;
        } all[] = {{"mu", &p.mu},
                   {global ? "f" : "q", global ? &p.f : &p.q},
                   {global ? "w" : "W", global ? &p.w : &p.W}};
        for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
            char words[40];
            double *const whole = *all[k].x, right = whole[2];
            whole[2] = NAN;
            CHECK_STATUS(rb_friction_problem_check(&p, &message), RB_EINVAL);
            snprintf(words, sizeof words, "%s: entry 3 is", all[k].name);
            if (!strstr(message.text, words))
                fail_msg("%s, expected %s", message.text, words);
            whole[2] = right;
            *all[k].x = NULL;
            CHECK_STATUS(rb_friction_problem_check(&p, &message), RB_EINVAL);
            snprintf(words, sizeof words, "%s is missing", all[k].name);
            if (!strstr(message.text, words))
                fail_msg("%s, expected %s", message.text, words);
            *all[k].x = whole;
        }
        CHECK_OK(rb_friction_problem_check(&p, &message));
    }
}

/* Two ends of one body that move together to 1e-12: no matrix to condense with. */
TEST(nearly_loose_bodies_are_not_condensed)
{
    const double K[] = {1.0, 1.0 - 1e-13, 1.0 - 1e-13, 1.0}, H[] = {1.0, 0.0, 0.0, 1.0};
    double mu[] = {0.5}, f[] = {1.0, 1.0}, w[] = {0.0, 0.0};
    rb_friction_problem p = {.form = RB_FRICTION_GLOBAL,
                             .dimension = 2,
                             .contacts = 1,
                             .dofs = 2,
                             .mu = mu,
                             .f = f,
                             .w = w};
    rb_friction_problem local;
    CHECK_OK(rb_sparse_from_dense(2, 2, K, 2, &p.K));
    CHECK_OK(rb_sparse_from_dense(2, 2, H, 2, &p.H));
    CHECK_SAYS(rb_friction_condense(&p, &local, &message), RB_SINGULAR,
               "K is singular to rounding");
    rb_sparse_free(&p.K);
    rb_sparse_free(&p.H);
}

/* A constraint that follows from the others but for rounding drops out; one that says
 * otherwise is refused. */
TEST(constraints_are_redundant_but_for_rounding)
{
    for (int trial = 0; trial < 20; trial++)
        for (int contradicts = 0; contradicts < 2; contradicts++) {
            double G[3 * LARGEST], b[3] = {uniform(), uniform(), 0.0};
            OWNED(rb_friction_problem) p;
            OWNED(rb_sparse) rows;
            make_global(3, &p);
            for (int i = 0; i < LARGEST; i++) {
                G[i] = uniform();
                G[i + LARGEST] = uniform();
                G[i + 2 * LARGEST] = 0.7 * G[i] - 1.3 * G[i + LARGEST];
            }
            b[2] = 0.7 * b[0] - 1.3 * b[1] + 0.01 * contradicts;
            CHECK_OK(rb_sparse_from_dense(LARGEST, 3, G, LARGEST, &rows));
            CHECK_STATUS(rb_friction_eliminate(&p, &rows, b, &message),
                         contradicts ? RB_EINVAL : RB_OK);
            assert_int_equal(p.dofs, contradicts ? LARGEST : LARGEST - 2);
        }
}

/* ---- Cones ------------------------------------------------------------------------- */

TEST(cones_that_are_none_are_refused)
{
    static const struct {
        int n, size[2];
        double M, q;
        const char *words;
    } all[] = {{3, {2, 1}, NAN, 1.0, "M: entry 1 is"},
               {3, {2, 1}, 1.0, NAN, "q: entry 1"},
               {3, {1, 1}, 1.0, 1.0, "cones hold 2 of 3"},
               {3, {0, 3}, 1.0, 1.0, "cone 1"},
               {3, {2, 2}, 1.0, 1.0, "cone 2"},
               {0, {0, 0}, 1.0, 1.0, ""}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        double M[9] = {all[k].M, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
        double q[3] = {all[k].q, 0.0, 0.0}, x[3], y[3];
        int size[2] = {all[k].size[0], all[k].size[1]};
        rb_friction_info info;
        const rb_friction_soclcp_problem p = {all[k].n, M, q, all[k].n ? 2 : 0, size};
        CHECK_STATUS(rb_friction_solve_soclcp(&p, NULL, x, y, &info), RB_EINVAL);
        if (!strstr(info.msg.text, all[k].words))
            fail_msg("row %zu: %s", k, info.msg.text);
    }
}

static double cone_matrix[9] = {3.0, 0.5, 0.2, 0.5, 2.0, 0.1, 0.2, 0.1, 1.0};
static double cone_q[3] = {-1.0, 0.7, -0.3};
static int cone_sizes[2] = {2, 1};
static const rb_friction_soclcp_problem on_cones = {3, cone_matrix, cone_q, 2, cone_sizes};

/* ||x - P(x - y)|| / ||q||, whatever the unit of both; absolute where q = 0. */
TEST(the_error_on_cones_is_relative)
{
    const double x[3] = {1.0, 0.2, 0.3};
    double y[3], s[3], square = 0.0;
    for (int i = 0; i < 3; i++) {
        s[i] = x[i] - cone_q[i];
        for (int j = 0; j < 3; j++)
            s[i] -= cone_matrix[i + 3 * j] * x[j];
    }
    /* onto {|p_1| <= p_0} and {p_2 >= 0} */
    const double t = fabs(s[1]), face = 0.5 * (s[0] + t);
    const double p[3] = {t <= s[0] ? s[0] : fmax(face, 0.0),
                         t <= s[0] ? s[1] : fmax(face, 0.0) * (s[1] > 0.0 ? 1.0 : -1.0),
                         fmax(s[2], 0.0)};
    for (int i = 0; i < 3; i++)
        square += (x[i] - p[i]) * (x[i] - p[i]);
    for (int k = -3; k <= 3; k++) {
        const double unit = pow(10.0, k);
        double far_x[3], far_q[3];
        for (int i = 0; i < 3; i++) {
            far_x[i] = unit * x[i];
            far_q[i] = unit * cone_q[i];
        }
        const rb_friction_soclcp_problem far = {3, cone_matrix, far_q, 2, cone_sizes};
        CHECK_REL(rb_friction_soclcp_error(&far, far_x, y), sqrt(square / (1.0 + 0.49 + 0.09)),
                  1e-12, "times %g", unit);
    }
    const double none[3] = {0.0};
    const rb_friction_soclcp_problem at_rest = {3, cone_matrix, none, 2, cone_sizes};
    CHECK_ABS(rb_friction_soclcp_error(&at_rest, none, y), 0.0, 0.0, "q = 0, x = 0");
    assert_true(rb_friction_soclcp_error(&at_rest, x, y) > 0.1);
}

TEST(limits_hold_on_cones)
{
    rb_friction_info info;
    rb_friction_options opt = rb_friction_defaults();
    double x[3], y[3], again[3];
    CHECK_OK(rb_friction_solve_soclcp(&on_cones, NULL, x, y, NULL));
    for (int i = 0; i < 3; i++) {
        double want = cone_q[i];
        for (int j = 0; j < 3; j++)
            want += cone_matrix[i + 3 * j] * x[j];
        CHECK_ABS(y[i], want, 1e-14, "y = M x + q");
    }
    CHECK_MAX(fabs(x[1]) - x[0], 1e-7, "x in its cone");
    CHECK_MAX(fabs(y[1]) - y[0], 1e-7, "y in its cone");
    CHECK_ABS(x[0] * y[0] + x[1] * y[1], 0.0, 1e-7, "orthogonal");
    CHECK_ABS(fmin(x[2], y[2]), 0.0, 1e-7, "half-line");
    opt.r0 = x;
    CHECK_OK(rb_friction_solve_soclcp(&on_cones, &opt, again, y, &info));
    CHECK_MAX(info.iters, 2, "from the solution");
    opt.r0 = NULL;
    opt.max_iters = 1;
    CHECK_STATUS(rb_friction_solve_soclcp(&on_cones, &opt, again, y, &info), RB_MAXITER);
    opt.max_iters = 0;
    opt.seconds = 1e-9;
    CHECK_STATUS(rb_friction_solve_soclcp(&on_cones, &opt, again, y, &info), RB_INTERRUPTED);
    opt.seconds = 60.0;
    CHECK_OK(rb_friction_solve_soclcp(&on_cones, &opt, again, y, &info));
    const double zero[9] = {0.0}, up[3] = {1.0, 0.5, 1.0};
    const rb_friction_soclcp_problem flat = {3, zero, up, 2, cone_sizes};
    CHECK_OK(rb_friction_solve_soclcp(&flat, NULL, x, y, NULL)); /* x = 0 */
    CHECK_ABS(fmax(fabs(x[0]), fabs(x[2])), 0.0, 1e-6, "M = 0");
}

/* ---- Rolling friction -------------------------------------------------------------- */

enum { WHEELS = 2, MOTIONS = 10 };

static void make_wheels(rb_friction_problem *p)
{
    OWNED(rb_triplets) K = {.rows = MOTIONS, .cols = MOTIONS}, H = K;
    *p = zero_global(5, WHEELS, MOTIONS);
    for (int i = 0; i < MOTIONS; i++) {
        rb_triplets_add(&K, i, i, 2.0 + 0.1 * i);
        rb_triplets_add(&H, i, i, 1.0);
    }
    CHECK_OK(rb_sparse_from_triplets(&K, &p->K));
    CHECK_OK(rb_sparse_from_triplets(&H, &p->H));
}

TEST(what_does_not_roll_is_refused)
{
    static const double fine[] = {0.1, 0.2};
    static const double bad[][2] = {{0.1, -0.1}, {NAN, 0.1}, {0.1, INFINITY}};
    for (int k = 0; k < 9; k++) {
        rb_friction_problem p, whole;
        make_wheels(&p);
        whole = p;
        p.form = k == 0 ? RB_FRICTION_LOCAL_SPARSE : p.form;
        p.dimension = k == 1 ? 3 : 5;
        p.contacts = k == 2 ? 0 : WHEELS;
        p.H.cols -= k == 3;
        p.H.rows -= k == 4;
        p.K.cols -= k == 5;
        CHECK_SAYS(rb_friction_split_rolling(&p, k < 6 ? fine : bad[k - 6], &message), RB_EINVAL,
                   k < 6 ? "five columns of H" : "mu_r of contact");
        rb_friction_problem_free(&whole);
    }
}

/* A wheel whose motions have no stiffness of their own takes the length 1. */
TEST(wheels_without_stiffness_have_the_length_one)
{
    static const double mu_r[] = {0.1, 0.2};
    for (int k = 0; k < 3; k++) {
        OWNED(rb_friction_problem) p;
        make_wheels(&p);
        for (int a = 0; a < 5; a++) /* the normal; the slip; the turn */
            if ((k == 0 && a == 0) || (k == 1 && (a == 1 || a == 2)) || (k == 2 && a > 2))
                p.K.x[a] = 0.0;
        CHECK_OK(rb_friction_split_rolling(&p, mu_r, &message));
        assert_int_equal(p.contacts, 2 * WHEELS);
        const double slip = 1.0 / 2.1 + 1.0 / 2.2, turn = 1.0 / 2.3 + 1.0 / 2.4;
        CHECK_REL(p.lengths[0], k ? 1.0 : sqrt(slip / turn), 1e-14, "length");
        CHECK_REL(p.mu[1], mu_r[0] / p.lengths[0], 1e-14, "mu of the moment");
        CHECK_REL(p.K.x[p.K.p[MOTIONS]], k == 0 ? 1.0 : 4.0 * 2.0, 1e-14, "spring");
    }
}

/* Blocks of contacts without a tangential part: what is dragged slips, W or no W. */
static void make_loose(rb_friction_problem *p)
{
    static const double q[] = {-1.0, 0.5, -2.0, -0.5, 0.3, 1.0, -1.0, 2.0};
    *p = (rb_friction_problem){.form = RB_FRICTION_LOCAL_DENSE,
                               .dimension = 2,
                               .contacts = NC,
                               .mu = rb_alloc(NC, 1),
                               .W = rb_alloc(2 * NC, 2 * NC),
                               .q = rb_copy(2 * NC, q)};
    for (int c = 0; c < NC; c++) {
        p->mu[c] = 0.5;
        p->W[2 * c * (2 * NC + 1)] = 2.0;
    }
}

TEST(contacts_without_tangential_compliance_slip)
{
    static const char *const names[] = {"nsgs-ac", "nsgs-aa", "lemke", "auto"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        OWNED(rb_friction_problem) p;
        rb_friction_info info;
        double r[2 * NC], u[2 * NC];
        make_loose(&p);
        CHECK_OK(rb_friction_solve(names[k], &p, NULL, &(rb_friction_solution){r, u, NULL}, &info));
        for (int c = 0; c < NC; c++) {
            const double rn = fmax(0.0, -p.q[2 * c] / 2.0);
            CHECK_ABS(r[2 * c], rn, 1e-7, "%s, r_N of %d", names[k], c);
            CHECK_ABS(r[2 * c + 1], p.q[2 * c + 1] > 0.0 ? -0.5 * rn : 0.5 * rn, 1e-7,
                      "%s, r_T of %d", names[k], c);
            CHECK_ABS(u[2 * c + 1], p.q[2 * c + 1], 1e-12, "%s, u_T of %d", names[k], c);
        }
        memset(p.W, 0, 4 * NC * NC * sizeof *p.W); /* nothing can be pushed: all open */
        for (int c = 0; c < NC; c++)
            p.q[2 * c] = 1.0 + c;
        CHECK_OK(rb_friction_solve(names[k], &p, NULL, &(rb_friction_solution){r, u, NULL}, &info));
        CHECK_ABS(rb_norm_inf(2 * NC, r), 0.0, 0.0, "%s, W = 0", names[k]);
    }
}

/* ---- Memory ------------------------------------------------------------------------ */

static rb_status use_handle(void *context)
{
    rb_friction_handle *handle;
    double r[LARGEST], u[LARGEST];
    rb_status s = rb_friction_setup(context, &handle, NULL);
    if (s != RB_OK)
        return s;
    s = rb_friction_handle_solve(handle, "nsgs-aa", NULL, &(rb_friction_solution){r, u, NULL},
                                 NULL);
    if (s == RB_OK)
        s = rb_friction_update(handle, NULL);
    rb_friction_handle_free(handle);
    return s;
}

static rb_status examine(void *context)
{
    rb_friction_facts facts;
    return rb_friction_examine(context, 1, &facts);
}

static rb_status measure(void *context)
{
    rb_friction_errors error;
    const double r[LARGEST] = {1.0};
    return rb_friction_error(context, r, NULL, NULL, &error);
}

static rb_status solve_on_cones(void *context)
{
    double x[3], y[3];
    return rb_friction_solve_soclcp(context, NULL, x, y, NULL);
}

/* The problem is changed only where all succeeds, in the last run. */
static rb_status roll(void *context)
{
    static const double mu_r[] = {0.1, 0.2};
    rb_friction_problem *p = context;
    return rb_friction_split_rolling(p, mu_r, NULL);
}

TEST(short_memory_is_reported)
{
    for (int k = 0; k < 3; k++) {
        OWNED(rb_friction_problem) p;
        if (k == 2)
            make_global(3, &p);
        else
            make_local(3, 1.0, &p);
        if (k == 1)
            make_only_sparse(&p);
        assert_true(alloc_fail_each(use_handle, &p) > 3);
        assert_true(alloc_fail_each(examine, &p) > (k == 2 ? -1 : 3));
        assert_true(alloc_fail_each(measure, &p) > 2);
    }
    OWNED(rb_friction_problem) loose;
    make_loose(&loose);
    assert_true(alloc_fail_each(use_handle, &loose) > 5);
    assert_true(alloc_fail_each(solve_on_cones, (void *)&on_cones) > 5);
    OWNED(rb_friction_problem) wheels;
    make_wheels(&wheels);
    assert_true(alloc_fail_each(roll, &wheels) > 5);
    assert_int_equal(wheels.contacts, 2 * WHEELS);
}

RUN_TESTS(NULL, NULL)
