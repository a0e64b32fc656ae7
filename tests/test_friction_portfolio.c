/* What auto does beside its members, on the packings of examples/packings: stacks, walls
 * and heaps with more contact equations than motions. */
#define _XOPEN_SOURCE 700
#include "check.h"
#include "packing.h"
#include "lcp/friction/friction.h"

#include <unistd.h>

/* Coulomb's law contact by contact, from r alone; in units of velocity over ||q||.  W is
 * sparse. */
static double violation(const rb_friction_problem *p, const double *r)
{
    const int d = p->dimension, m = d * p->contacts;
    double *u = rb_alloc((size_t)m, 1), worst = 0.0, q = 0.0;
    for (int i = 0; i < m; i++)
        u[i] = p->q[i], q = hypot(q, p->q[i]);
    for (int j = 0; j < m; j++)
        for (int k = p->Ws.p[j]; k < p->Ws.p[j + 1]; k++)
            u[p->Ws.i[k]] += p->Ws.x[k] * r[j];
    for (int c = 0; c < p->contacts; c++) {
        const double *rc = r + c * d, *uc = u + c * d, mu = p->mu[c];
        const double rt = d == 2 ? fabs(rc[1]) : hypot(rc[1], rc[2]);
        const double ut = d == 2 ? fabs(uc[1]) : hypot(uc[1], uc[2]);
        worst = fmax(worst, fmax(-uc[0], fmin(rc[0], uc[0]))); /* W_NN is about 1 */
        worst = fmax(worst, fmax(-rc[0], rt - mu * rc[0]));
        worst = fmax(worst, fmin(ut, mu * rc[0] - rt)); /* slips only at the limit */
    }
    free(u);
    return worst / q;
}

/* Newton from zero needs few steps, or fails on these problems. */
static rb_status run(const char *solver, const rb_friction_problem *p, double *r,
                     rb_friction_info *info)
{
    SCRATCH double *u = rb_alloc((size_t)(p->dimension * p->contacts), 1);
    rb_friction_options opt = rb_friction_defaults();
    opt.max_iters = strncmp(solver, "nsn", 3) ? 0 : 25;
    const rb_status s =
        rb_friction_solve(solver, p, &opt, &(rb_friction_solution){r, u, NULL}, info);
    return s;
}

/* auto beside the solvers named: at most `most` times the operations of the best one, and
 * 1.1 times those of its first member where that needs no more than its first turn. */
static void compare(const char *name, const rb_friction_problem *p, double most)
{
    static const char *const members[] = {"nsgs-aa", "nsgs-ac", "nsn-ac", "nsn-fb", "admm"};
    const size_t m = (size_t)(p->dimension * p->contacts);
    double *r = rb_alloc(m, 1), best = INFINITY;
    rb_friction_info info, first = {0};
    for (int k = 0; k < 5; k++) {
        if (run(members[k], p, r, &info) == RB_OK)
            best = fmin(best, info.flops);
        if (k == 0)
            first = info;
    }
    CHECK_OK(run("auto", p, r, &info));
    CHECK_MAX(violation(p, r), 1e-7, "%s", name);
    CHECK_MAX(info.flops, most * best, "%s", name);
    if (first.iters <= 100 && !strcmp(info.solver, "nsgs-aa"))
        CHECK_MAX(info.flops, 1.1 * first.flops, "%s: the first turn", name);
    free(r);
}

TEST(auto_loses_little_to_its_members)
{
    static const char *const packings[] = {
        "boxes 4 0.3 1",   "boxes 30 0.5 3",  "boxes 100 0.1 4", "discs 25 0 2",
        "discs 60 0.5 3",  "discs 200 0.2 5", "bricks 3 0.5 1",  "bricks 8 0.3 2",
        "bricks 20 0.6 3", "spheres 3 0.2 1", "spheres 8 0.4 2", "spheres 40 0.5 4"};
    for (size_t k = 0; k < sizeof packings / sizeof *packings; k++) {
        if (!is_in_turn((int)k, 3))
            continue;
        OWNED(rb_friction_problem) p;
        packing(packings[k], &p);
        compare(packings[k], &p, 3.0);
    }
}

/* Where one sweep is the answer the proof of it is made once: it cost 1.5 times as much. */
TEST(the_first_member_costs_auto_nothing)
{
    static const char *const files[] = {"siconos/fc2d/FrictionContactProblem00394.dat",
                                        "siconos/fc2d/FrictionContactProblem00031.dat",
                                        "siconos/fc3d/FrictionContact3D_1c.dat",
                                        "siconos/fc3d/FC3D_Example1_SBM.dat",
                                        "siconos/fc3d/Rover11035.dat",
                                        "siconos/fc3d/NESpheres_10_1.dat"};
    for (size_t k = 0; k < sizeof files / sizeof *files; k++) {
        OWNED(rb_friction_problem) p;
        rb_friction_info first, whole;
        CHECK_OK(rb_friction_read(outside_data(files[k]), &p, &message));
        SCRATCH double *r = rb_alloc((size_t)(p.dimension * p.contacts), 1);
        CHECK_OK(run("nsgs-aa", &p, r, &first));
        CHECK_OK(run("auto", &p, r, &whole));
        CHECK_MAX(whole.flops, 1.1 * first.flops, "%s", files[k]);
        CHECK_ABS(whole.scaled, first.scaled, 0.0, "%s: what is proved", files[k]);
        CHECK_ABS(whole.floor, first.floor, 0.0, "%s: its floor", files[k]);
    }
}

/* The sweeps stall at a small allowance, from where Newton's method needs more than its share of
 * it: 5.5 times its operations from zero, for the other members went on until its turn came. */
TEST(newton_goes_on_where_the_sweeps_have_stalled)
{
    OWNED(rb_friction_problem) p;
    rb_friction_info newton, whole;
    CHECK_OK(rb_friction_read(outside_data("siconos/fc3d/OneObject-i100000-499.hdf5.dat"), &p,
                              &message));
    SCRATCH double *r = rb_alloc((size_t)(3 * p.contacts), 1);
    CHECK_OK(run("nsn-ac", &p, r, &newton));
    CHECK_OK(run("auto", &p, r, &whole));
    CHECK_MAX(whole.flops, 3.0 * newton.flops, "operations");
}

/* Rigid bodies are condensed first, since that costs little: auto needs what it needs on
 * the condensed problem, where Newton on the global form went first and failed. */
TEST(auto_condenses_rigid_bodies_first)
{
    OWNED(rb_friction_problem) global, local;
    rb_friction_info of_global, of_local;
    packing("spheres 150 1 6 global", &global);
    CHECK_OK(rb_friction_condense(&global, &local, &message));
    SCRATCH double *r = rb_alloc((size_t)(3 * global.contacts), 1);
    CHECK_OK(run("auto", &global, r, &of_global));
    CHECK_OK(run("auto", &local, r, &of_local));
    assert_string_equal(of_global.solver, of_local.solver);
    CHECK_MAX(of_global.flops, 1.5 * of_local.flops, "operations");
}

/* 24 s and 18.7 s where plain sweeps took 0.03 and 0.13. */
TEST(auto_on_the_packings_it_lost_on)
{
    static const char *const files[] = {"packings/boxes2d_300_mu2.0.dat",
                                        "packings/disks2d_300_mu0.5.dat"};
    for (int k = 0; k < 2; k++) {
        if (!is_in_turn(k, 2))
            continue;
        OWNED(rb_friction_problem) p;
        rb_friction_info plain, fast;
        CHECK_OK(rb_friction_read(outside_data(files[k]), &p, &message));
        compare(files[k], &p, 3.0);
        SCRATCH double *r = rb_alloc((size_t)(2 * p.contacts), 1);
        CHECK_OK(run("nsgs-ac", &p, r, &plain));
        CHECK_OK(run("nsgs-aa", &p, r, &fast));
        CHECK_MAX(fast.iters, plain.iters, "%s: acceleration", files[k]);
    }
}

/* Newton's methods came to 1e-10 of the whole within 60 steps, and went on for hundreds because of
 * contacts that carry 1e-4 of the others: 484 and 284 iterations of all members. */
TEST(faint_contacts_do_not_hold_auto_up)
{
    static const struct {
        const char *file;
        int most;
        double flops;
    } rows[] = {{"siconos/fc3d/Capsules-i101-404.dat", 260, 2.3e7},
                {"fclib/Capsules-i125-1213.hdf5", 90, 1.25e7}};
    /* Newton's path depends on the rounding of OpenBLAS's kernels: the second file took at
     * most 1.1e7 with those of Haswell, 1.13e7 Sandybridge, 1.22e7 SkylakeX and Cooperlake */
    for (int k = 0; k < 2; k++) {
        OWNED(rb_friction_problem) p;
        rb_friction_info info;
        CHECK_OK(rb_friction_read(outside_data(rows[k].file), &p, &message));
        SCRATCH double *r = rb_alloc((size_t)(3 * p.contacts), 1);
        CHECK_OK(run("auto", &p, r, &info));
        assert_true(info.iters <= rows[k].most);
        CHECK_MAX(info.flops, rows[k].flops, "%s: operations", rows[k].file);
        CHECK_MAX(info.worst, 1e-8, "%s: contact", rows[k].file);
    }
}

/* W and q that the generator prints, and those condensed from its mass and H; condensing
 * takes less time than solving. */
TEST(global_packings_condense_to_the_local_ones)
{
    static const char *const packings[] = {"boxes 30 0.5 3", "discs 60 0.5 3", "bricks 20 0.6 3",
                                           "spheres 360 0.7 9"};
    for (size_t k = 0; k < sizeof packings / sizeof *packings; k++) {
        rb_friction_problem local, global, p = {0};
        rb_friction_info info;
        char arguments[80];
        double condense = INFINITY, solve = INFINITY;
        if (!is_in_turn((int)k, 4))
            continue;
        snprintf(arguments, sizeof arguments, "%s global 5", packings[k]);
        packing(packings[k], &local);
        packing(arguments, &global);
        const size_t m = (size_t)(local.dimension * local.contacts);
        SCRATCH double *r = rb_alloc(m, 1);
        for (int again = 0; again < 3; again++) {
            const double start = rb_seconds();
            rb_friction_problem_free(&p);
            CHECK_OK(rb_friction_condense(&global, &p, &message));
            condense = fmin(condense, rb_seconds() - start);
            CHECK_OK(run("auto", &p, r, &info));
            solve = fmin(solve, info.seconds);
        }
        assert_int_equal(p.Ws.cols, m);
        for (int j = 0; j < (int)m; j++) {
            int l = local.Ws.p[j];
            for (int i = p.Ws.p[j]; i < p.Ws.p[j + 1]; i++) {
                assert_true(i == p.Ws.p[j] || p.Ws.i[i] > p.Ws.i[i - 1]);
                while (l < local.Ws.p[j + 1] && local.Ws.i[l] < p.Ws.i[i])
                    CHECK_ABS(local.Ws.x[l++], 0.0, 1e-15, "left out of column %d", j);
                const int there = l < local.Ws.p[j + 1] && local.Ws.i[l] == p.Ws.i[i];
                CHECK_ABS(p.Ws.x[i], there ? local.Ws.x[l++] : 0.0, 1e-14, "W(%d, %d)", p.Ws.i[i],
                          j);
            }
            CHECK_ABS(p.q[j], local.q[j], 1e-14, "q[%d]", j);
        }
        CHECK_MAX(condense, solve, "%s: seconds", packings[k]);
        rb_friction_problem_free(&p);
        rb_friction_problem_free(&global);
        rb_friction_problem_free(&local);
    }
}

/* Redundant bricks: sweeps need 13 566, Newton fails, ADMM takes 130 iterations.  What auto takes
 * beside it: test_inside_friction. */
TEST(splitting_solves_redundant_contacts)
{
    OWNED(rb_friction_problem) p;
    rb_friction_info info;
    packing("bricks 100 1 5", &p);
    SCRATCH double *r = rb_alloc((size_t)(3 * p.contacts), 1);
    CHECK_OK(run("admm", &p, r, &info));
    CHECK_MAX(info.iters, 200, "ADMM");
    CHECK_MAX(violation(&p, r), 1e-7, "ADMM");
}

/* Lemke's method on stacks and heaps with redundant contacts: the form of order 3 n_c
 * ended on a ray, after 10 n + 1000 pivots or with a residual of 0.6 on those of mu = 2.
 * The answer of a pivoting method is right to rounding. */
TEST(lemke_solves_redundant_contacts)
{
    static const struct {
        const char *packing;
        int pivots; /* n_c times this at most */
    } cases[] = {{"boxes 12 2 2", 4},    {"boxes 30 2 3", 4},   {"boxes 60 2 3", 4},
                 {"boxes 100 2 4", 4},   {"boxes 60 0.5 4", 4}, {"boxes 100 0.1 4", 4},
                 {"boxes 100 0 4", 4},   {"discs 25 2 2", 40},  {"discs 60 2 3", 10},
                 {"discs 120 0.8 4", 10}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        if (!is_in_turn((int)k, 3))
            continue;
        OWNED(rb_friction_problem) p;
        rb_friction_info info;
        packing(cases[k].packing, &p);
        SCRATCH double *r = rb_alloc((size_t)(2 * p.contacts), 1);
        CHECK_OK(run("lemke", &p, r, &info));
        CHECK_MAX(violation(&p, r), 1e-11, "%s", cases[k].packing);
        CHECK_MAX(info.iters, cases[k].pivots * p.contacts, "%s: pivots", cases[k].packing);
    }
}

TEST(lemke_ends_in_time)
{
    OWNED(rb_friction_problem) p;
    rb_friction_info info;
    packing("boxes 100 2 4", &p);
    SCRATCH double *r = rb_alloc((size_t)(2 * p.contacts), 2);
    rb_friction_options opt = rb_friction_defaults();
    opt.seconds = 1e-3;
    CHECK_STATUS(rb_friction_solve("lemke", &p, &opt,
                                   &(rb_friction_solution){r, r + 2 * p.contacts, NULL}, &info),
                 RB_INTERRUPTED);
    /* The whole solution takes 919 pivots; seconds would also count what other programs take. */
    CHECK_MAX(1, info.iters, "pivots are counted");
    CHECK_MAX(info.iters, 100, "pivots in a millisecond");
}

/* r, u and v of the portfolio, whoever of its members found them. */
TEST(the_winner_hands_over_all_it_has)
{
    static const struct {
        const char *packing, *winner;
    } cases[] = {{"bricks 60 1 5", "admm"},
                 {"discs 60 2 3", "nsgs-aa"},
                 {"boxes 30 2 3 global 5", "nsgs-aa"},
                 {"bricks 8 2 3 global 5", "nsgs-aa"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        OWNED(rb_friction_problem) p, condensed = {0};
        rb_friction_info info;
        packing(cases[k].packing, &p);
        const int m = p.dimension * p.contacts, n = p.dofs;
        const int global = p.form == RB_FRICTION_GLOBAL;
        double *r = rb_alloc((size_t)(2 * m + 2 * n + 1), 1), *u = r + m, *v = u + m;
        CHECK_OK(rb_friction_solve("auto", &p, NULL,
                                   &(rb_friction_solution){r, u, global ? v : NULL}, &info));
        assert_string_equal(info.solver, cases[k].winner);
        if (global) {
            double *rest = v + n;
            memcpy(rest, p.f, (size_t)n * sizeof *rest);
            rb_sparse_apply(1.0, &p.H, r, 1.0, rest);
            const double size = rb_norm_inf((size_t)n, rest);
            rb_sparse_apply(-1.0, &p.K, v, 1.0, rest);
            CHECK_MAX(rb_norm_inf((size_t)n, rest), 1e-12 * size, "forces of case %d", (int)k);
            CHECK_OK(rb_friction_condense(&p, &condensed, &message));
        }
        const rb_friction_problem *local = global ? &condensed : &p;
        CHECK_MAX(violation(local, r), 1e-7, "case %d", (int)k);
        for (int i = 0; i < m; i++)
            u[i] -= local->q[i];
        rb_sparse_apply(-1.0, &local->Ws, r, 1.0, u);
        CHECK_MAX(rb_norm_inf((size_t)m, u), 1e-12 * rb_norm_inf((size_t)m, local->q) * m,
                  "velocities of case %d", (int)k);
        free(r);
    }
}

/* The same where Newton's method wins, on a published file: u and the errors are those of its r. */
TEST(newton_hands_over_all_it_has)
{
    OWNED(rb_friction_problem) p;
    rb_friction_info info;
    rb_friction_errors errors;
    CHECK_OK(rb_friction_read(outside_data("siconos/fc3d/OneObject-i100000-499.hdf5.dat"), &p,
                              &message));
    const size_t m = (size_t)(3 * p.contacts);
    SCRATCH double *r = rb_alloc(m, 3);
    double *u = r + m, *again = u + m;
    CHECK_OK(rb_friction_solve("auto", &p, NULL, &(rb_friction_solution){r, u, NULL}, &info));
    assert_string_equal(info.solver, "nsn-jm-nls");
    CHECK_OK(rb_friction_error(&p, r, NULL, again, &errors));
    CHECK_ABS(info.scaled, errors.scaled, 1e-14, "scaled residual");
    for (size_t i = 0; i < m; i++)
        CHECK_ABS(u[i], again[i], 1e-12 * rb_norm_inf(m, again), "u[%d]", (int)i);
}

/* The same path twice, to the last digit. */
TEST(auto_repeats_itself)
{
    OWNED(rb_friction_problem) p;
    rb_friction_info one, two;
    packing("boxes 100 0.7 2", &p);
    const size_t m = (size_t)(2 * p.contacts);
    SCRATCH double *r = rb_alloc(m, 2);
    CHECK_OK(run("auto", &p, r, &one));
    CHECK_OK(run("auto", &p, r + m, &two));
    assert_int_equal(one.iters, two.iters);
    assert_true(one.flops == two.flops);
    assert_int_equal(memcmp(r, r + m, m * sizeof *r), 0);
}

typedef struct {
    int calls, last;
} listener;

static int hear(const rb_friction_progress *at, void *context)
{
    listener *l = context;
    assert_non_null(rb_friction_solver_named(at->solver));
    assert_true(at->error >= 0.0 && at->flops > 0.0);
    return ++l->calls == l->last;
}

TEST(the_caller_hears_and_may_stop)
{
    OWNED(rb_friction_problem) p;
    rb_friction_info info;
    packing("boxes 12 0.5 3", &p);
    double *r = rb_alloc((size_t)(2 * p.contacts), 2), *u = r + 2 * p.contacts;
    listener l = {0, -1};
    rb_friction_options opt = rb_friction_defaults();
    opt.progress = hear;
    opt.context = &l;
    int count;
    const rb_friction_solver *all = rb_friction_solvers(&count);
    for (int k = 0; k < count; k++) {
        l = (listener){0, -1};
        opt.max_iters = 100;
        rb_friction_solve(all[k].name, &p, &opt, &(rb_friction_solution){r, u, NULL}, &info);
        if (!l.calls)
            print_error("%s tells nothing\n", all[k].name);
        assert_true(l.calls > 0);
    }
    l = (listener){0, 2};
    CHECK_STATUS(rb_friction_solve("auto", &p, &opt, &(rb_friction_solution){r, u, NULL}, &info),
                 RB_INTERRUPTED);
    assert_int_equal(l.calls, 2);
    free(r);
}

/* No solver ends on this heap, but it has a solution: tools/scripts/follow-path found this one. */
TEST(a_heap_that_nothing_solves_has_a_solution)
{
    OWNED(rb_friction_problem) p;
    rb_friction_errors error;
    CHECK_OK(rb_friction_read(outside_data("packings/disks2d_1000_mu0.5.dat"), &p, NULL));
    SCRATCH double *r = rb_alloc((size_t)(2 * p.contacts), 1);
    FILE *file = NOT_NULL(fopen("tests/data/discs-1141.txt", "r"));
    for (int i = 0; i < 2 * p.contacts; i++)
        assert_int_equal(fscanf(file, "%lf", r + i), 1);
    fclose(file);
    CHECK_OK(rb_friction_error(&p, r, NULL, NULL, &error));
    assert_true(error.scaled < 1e-9);
    assert_true(error.residual < 1e-9);
    assert_true(violation(&p, r) < 1e-9);
}

RUN_TESTS(NULL, NULL)
