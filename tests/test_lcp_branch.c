/* Branching: planted problems of any matrix are solved, and where there is no solution that is
 * proved; with bounds, too; what ends the search before. */
#include "check.h"

#include "numbers.h"
#include "rollbem/lcp.h"

enum { MOST = 60 };

static unsigned seed;

static int below(int n)
{
    return (int)((uniform_from(&seed) + 1.0) * 0.5 * n) % n;
}

typedef struct {
    int n;
    double M[MOST * MOST], q[MOST], lower[MOST], upper[MOST];
} problem;

/* Entries of -3 ... 3, q of -9 ... 9; planted: q such that there is a solution.  Bounds of all
 * kinds, and rows and columns in other units, where wanted. */
static void pose(int n, unsigned number, int planted, int boxes, int units, problem *p)
{
    seed = 31u + 7919u * number;
    for (int k = 0; k < 4; k++)
        uniform_from(&seed);
    p->n = n;
    for (int i = 0; i < n * n; i++)
        p->M[i] = below(7) - 3;
    for (int i = 0; i < n; i++) {
        p->q[i] = below(19) - 9;
        const int kind = boxes ? below(5) : 0; /* a lower bound, both, an upper one, none, equal */
        p->lower[i] = kind < 2 || kind == 4 ? (boxes ? below(5) - 2 : 0.0) : -INFINITY;
        p->upper[i] = kind == 1   ? p->lower[i] + 1 + below(4)
                      : kind == 2 ? below(5) - 2
                      : kind == 4 ? p->lower[i]
                                  : INFINITY;
    }
    for (int i = 0; planted && i < n; i++)
        p->q[i] = 0.0;
    for (int j = 0; planted && j < n; j++) {
        const int basic = below(2);
        p->q[j] += basic ? 0 : below(5);
        for (int i = 0, z = 1 + below(4); basic && i < n; i++)
            p->q[i] -= p->M[i + j * n] * z;
    }
    for (int i = 0; units && i < n; i++) {
        const double row = exp2(below(81) - 40), column = exp2(below(81) - 40);
        p->q[i] *= row;
        for (int j = 0; j < n; j++) {
            p->M[i + j * n] *= row;
            p->M[j + i * n] *= column;
        }
        p->lower[i] /= column;
        p->upper[i] /= column;
    }
}

static rb_status solve_by_branching(const problem *p, int boxes, const rb_lcp_options *opt,
                                    double *z, rb_lcp_info *info)
{
    OWNED(rb_sparse) M;
    const rb_status s = rb_sparse_from_dense(p->n, p->n, p->M, p->n, &M);
    return s == RB_OK ? rb_lcp_solve("auto",
                                     &(rb_lcp_mixed_problem){.M = &M,
                                                             .q = p->q,
                                                             .lower = boxes ? p->lower : NULL,
                                                             .upper = boxes ? p->upper : NULL},
                                     opt, z, info)
                      : s;
}

/* The largest violation of a row as a part of its terms. */
static double violation(const problem *p, int boxes, const double *z)
{
    double worst = 0.0;
    for (int i = 0; i < p->n; i++) {
        double w = p->q[i], terms = fabs(w);
        for (int j = 0; j < p->n; j++) {
            w += p->M[i + j * p->n] * z[j];
            terms += fabs(p->M[i + j * p->n] * z[j]);
        }
        const double low = boxes ? p->lower[i] : 0.0, high = boxes ? p->upper[i] : INFINITY;
        const double part = w / fmax(terms, 1e-300);
        if (!(z[i] >= low && z[i] <= high))
            return INFINITY;
        worst = fmax(worst, z[i] == low    ? (z[i] == high ? 0.0 : -part)
                            : z[i] == high ? part
                                           : fabs(part));
    }
    return worst;
}

TEST(planted_integers_are_solved)
{
    int branched = 0;
    for (int k = 0; k < 80; k++) {
        problem p;
        double z[MOST];
        rb_lcp_info info;
        if (!is_in_turn(k, 2))
            continue;
        pose(8 + 4 * (k / 2 % 4), (unsigned)k, 1, 0, k / 8 % 2, &p);
        CHECK_OK(solve_by_branching(&p, 0, NULL, z, &info));
        CHECK_MAX(violation(&p, 0, z), 1e-10, "problem %d by %s", k, info.solver);
        branched += strcmp(info.solver, "branching") == 0;
    }
    assert_true(branched > 15);
}

/* What is said is what all complementary bases say; boxes have up to three sides each. */
TEST(no_solution_is_what_all_bases_say)
{
    int none = 0, solved = 0;
    for (int k = 0; k < 400; k++) {
        problem p;
        double z[MOST];
        rb_lcp_info info;
        if (!is_in_turn(k, 4))
            continue;
        OWNED(rb_lcp_solutions) all;
        const int boxes = k / 4 % 2, n = boxes ? 2 + k / 8 % 5 : 3 + k / 8 % 7;
        pose(n, 1000u + (unsigned)k, 0, boxes, k / 64 % 2, &p);
        const rb_status s = solve_by_branching(&p, boxes, NULL, z, &info);
        CHECK_OK(rb_lcp_enumerate(&(rb_lcp_problem){n, p.M, n, p.q}, boxes ? p.lower : NULL,
                                  boxes ? p.upper : NULL, 0.0, &all, &message));
        if (s != (all.count > 0 ? RB_OK : all.undecided ? RB_UNDECIDED : RB_NO_SOLUTION))
            fail_msg("problem %d: %s (%s), %d solutions, %d undecided", k, rb_status_text(s),
                     info.msg.text, all.count, all.undecided);
        if (s == RB_OK)
            CHECK_MAX(violation(&p, boxes, z), 1e-9, "problem %d by %s", k, info.solver);
        solved += s == RB_OK;
        none += s == RB_NO_SOLUTION;
    }
    print_message("%d solved, %d without solution\n", solved, none);
    assert_true(none > 10 && solved > 10);
}

TEST(larger_ones_are_decided)
{
    static const int orders[] = {16, 24, 32, 16, 24, 32, 40, 16};
    for (int k = 0; k < 8; k++) {
        problem p;
        double z[MOST];
        rb_lcp_info info;
        if (!is_in_turn(k, 4))
            continue;
        pose(orders[k], 50u + (unsigned)k, 0, 0, 0, &p);
        const rb_status s = solve_by_branching(&p, 0, NULL, z, &info);
        if (s == RB_OK)
            CHECK_MAX(violation(&p, 0, z), 1e-10, "problem %d", k);
        else
            CHECK_STATUS(s, RB_NO_SOLUTION);
    }
}

/* (second difference)^k, computed exactly: definite, so that there is one solution for every q;
 * near enough to singular that rounding hides it from k = 8 on, and rays look like proofs. */
TEST(no_solution_is_never_said_of_definite_matrices)
{
    int solved = 0;
    for (int n = 10; n <= MOST; n += 25)
        for (int k = 2; k <= 8; k += 2) {
            problem p = {.n = n};
            double z[MOST], before[MOST];
            rb_lcp_info info;
            for (int j = 0; j < n; j++) {
                memset(before, 0, sizeof before);
                before[j] = 1.0;
                for (int turn = 0; turn < k; turn++) {
                    for (int i = 0; i < n; i++)
                        p.M[i + j * n] = 2.0 * before[i] - (i > 0 ? before[i - 1] : 0.0) -
                                         (i + 1 < n ? before[i + 1] : 0.0);
                    memcpy(before, p.M + j * n, (size_t)n * sizeof *before);
                }
                p.q[j] = j * 37 % 101 - 50;
            }
            const rb_status s = solve_by_branching(&p, 0, NULL, z, &info);
            if (s != RB_OK && s != RB_UNDECIDED && s != RB_NUMERICAL)
                fail_msg("n = %d, k = %d: %s", n, k, info.msg.text);
            solved += s == RB_OK;
        }
    assert_true(solved >= 6);
}

/* Limits: what the methods before have said remains, or that the time is over. */
TEST(limits_end_the_search)
{
    problem p;
    double z[MOST];
    rb_lcp_info info;
    rb_lcp_options opt = rb_lcp_defaults();
    pose(60, 3u, 1, 0, 0, &p);
    opt.seconds = 0.02;
    const double began = rb_seconds();
    const rb_status s = solve_by_branching(&p, 0, &opt, z, &info);
    CHECK_MAX(rb_seconds() - began, 1.0, "seconds");
    if (s != RB_OK) {
        CHECK_STATUS(s, RB_TIME_LIMIT);
        assert_non_null(strstr(info.msg.text, "0.02 s"));
    }
    opt = rb_lcp_defaults();
    opt.max_iters = 3;
    pose(20, 12u, 1, 0, 0, &p);
    CHECK_STATUS(solve_by_branching(&p, 0, &opt, z, &info), RB_MAXITER);
    assert_int_equal(strncmp(info.solver, "lemke", 5), 0);
}

static rb_status solve_with_little(void *context)
{
    double z[MOST];
    rb_lcp_info info;
    const rb_status s = solve_by_branching(context, 0, NULL, z, &info);
    /* without memory for branching the end of Lemke's path is told */
    return s == RB_RAY || s == RB_SINGULAR || s == RB_MAXITER ? RB_ENOMEM : s;
}

TEST(short_memory_leaves_what_is_known)
{
    problem p;
    pose(12, 5u, 1, 0, 0, &p);
    assert_true(alloc_fail_each(solve_with_little, &p) > 20);
}

RUN_TESTS(NULL, NULL)
