/* The wall: one step after the other, elastic and rigid. */
#include "check.h"
#include "small_wall.h"

TEST(selection_is_by_difficulty)
{
    rb_fem_wall_options o = small_wall(0);
    rb_fem_wall *wall;
    rb_fem_wall_step step[6];
    int chosen[5], times[6] = {0};
    o.press = 2;
    o.shear = 3;
    CHECK_OK(rb_fem_wall_create(&o, &wall, NULL));
    for (int k = 0; k < 6; k++)
        CHECK_OK(rb_fem_wall_advance(wall, "nsn-ac", 1e-8, &step[k], NULL));
    CHECK_STATUS(rb_fem_wall_select(wall, 6, chosen), RB_EINVAL);
    CHECK_OK(rb_fem_wall_select(wall, 5, chosen));
    for (int k = 0; k < 5; k++) {
        assert_true(chosen[k] > 0 && !times[chosen[k]]++);
        assert_true(k == 0 || step[chosen[k]].iterations >= step[chosen[k - 1]].iterations);
    }
    rb_fem_wall_free(wall);
}

/* The table of examples/fem/README.md; Acary's wall has 2064 contacts and 7212 unknowns. */
TEST(walls_have_their_size)
{
    static const struct {
        int fine[3], coarse[3], contacts, unknowns, rank;
    } rows[] = {{{4, 3, 3}, {3, 2, 3}, 161, 901, 483},
                {{8, 6, 3}, {4, 3, 3}, 606, 3133, 1818},
                {{14, 10, 3}, {5, 3, 3}, 1722, 8155, 5166}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        rb_fem_wall_options o = rb_fem_wall_defaults();
        rb_fem_wall *wall;
        int rank = 0;
        memcpy(o.fine, rows[k].fine, sizeof o.fine);
        memcpy(o.coarse, rows[k].coarse, sizeof o.coarse);
        CHECK_OK(rb_fem_wall_create(&o, &wall, NULL));
        assert_int_equal(rb_fem_wall_contacts(wall), rows[k].contacts);
        assert_int_equal(rb_fem_wall_dofs(wall), rows[k].unknowns);
        assert_int_equal(3 * rows[k].contacts, rows[k].rank);
        if (k == 0 || getenv("ROLLBEM_TEST_ALL")) {
            CHECK_OK(rb_fem_wall_rank(wall, &rank));
            assert_int_equal(rank, rows[k].rank);
        }
        rb_fem_wall_free(wall);
    }
}

/* Rigid blocks: 73 freedoms, H of rank 73, hundreds of times hyperstatic; pressed only,
 * the contacts of the upper support carry the force. */
TEST(rigid_wall_carries_its_load)
{
    rb_fem_wall_options o = small_wall(1);
    rb_fem_wall *wall;
    rb_fem_wall_step step;
    int rank = 0;
    o.press = 2;
    o.shear = 0;
    CHECK_OK(rb_fem_wall_create(&o, &wall, NULL));
    assert_int_equal(rb_fem_wall_dofs(wall), 73);
    CHECK_OK(rb_fem_wall_rank(wall, &rank));
    assert_int_equal(rank, 73);
    for (int k = 0; k < 3; k++)
        CHECK_OK(rb_fem_wall_advance(wall, "nsn-ac", 1e-9, &step, NULL));
    const rb_fem_mesh *mesh = rb_fem_wall_mesh(wall);
    SCRATCH double *u = rb_alloc(3, (size_t)mesh->nodes);
    CHECK_OK(rb_fem_wall_displacements(wall, u));
    CHECK_MAX(rb_norm_inf(3 * (size_t)mesh->nodes, u), 1e-8, "rigid blocks do not sink [m]");
    rb_fem_wall_free(wall);
}

/* An option of the wall out of its range is named, the last one within is taken. */
TEST(bad_input_is_refused)
{
    static const struct {
        const char *part; /* of the message; NULL: it is a wall */
        int fine[3], coarse[3];
        double dt;
        int press, shear;
    } walls[] = {
        {NULL, {4, 2, 3}, {3, 2, 3}, 1e-2, 1, 0},
        {"2 and 3 nodes in direction 0", {2, 2, 3}, {3, 2, 3}, 1e-2, 1, 0},
        {"1 and 2 nodes in direction 1", {4, 1, 3}, {3, 2, 3}, 1e-2, 1, 0},
        {"3 and 2 nodes in direction 2", {4, 2, 3}, {3, 2, 2}, 1e-2, 1, 0},
        {"201 and 3 nodes in direction 0", {201, 2, 3}, {3, 2, 3}, 1e-2, 1, 0},
        {"2 and 201 nodes in direction 1", {4, 2, 3}, {3, 201, 3}, 1e-2, 1, 0},
        {"dt = 0, 1 + 0 steps", {4, 2, 3}, {3, 2, 3}, 0.0, 1, 0},
        {"dt = 0.01, 0 + 1 steps", {4, 2, 3}, {3, 2, 3}, 1e-2, 0, 1},
        {"dt = 0.01, 1 + -1 steps", {4, 2, 3}, {3, 2, 3}, 1e-2, 1, -1},
    };
    for (size_t k = 0; k < sizeof walls / sizeof *walls; k++) {
        rb_fem_wall *wall;
        rb_fem_wall_options o = {
            .dt = walls[k].dt, .press = walls[k].press, .shear = walls[k].shear};
        memcpy(o.fine, walls[k].fine, sizeof o.fine);
        memcpy(o.coarse, walls[k].coarse, sizeof o.coarse);
        CHECK_STATUS(rb_fem_wall_create(&o, &wall, &message), walls[k].part ? RB_EINVAL : RB_OK);
        if (walls[k].part)
            assert_non_null(strstr(message.text, walls[k].part));
        assert_int_equal(wall == NULL, walls[k].part != NULL);
        rb_fem_wall_free(wall);
    }
}

/* Solvers that are none or do not come to an end say so with the step, and short memory;
 * steps that are not solved have no problem. */
static int stop_at_the_third(void *context)
{
    int *asked = context;
    return ++*asked == 3;
}

/* Not only between the steps, and with sweeps as well as with Newton's method. */
TEST(a_step_can_be_stopped)
{
    static const char *const solvers[] = {"nsn-ac", "nsgs-ac", "admm", "auto"};
    for (size_t k = 0; k < sizeof solvers / sizeof *solvers; k++) {
        int asked = 0;
        rb_fem_wall_options o = small_wall(0);
        rb_fem_wall *wall;
        rb_fem_wall_step step;
        rb_friction_problem problem;
        o.stopped = stop_at_the_third;
        o.context = &asked;
        CHECK_OK(rb_fem_wall_create(&o, &wall, NULL));
        CHECK_STATUS(rb_fem_wall_advance(wall, solvers[k], 1e-13, &step, &message), RB_INTERRUPTED);
        assert_string_equal(message.text, "interrupted after step 0");
        assert_true(asked >= 3 && asked <= 4); /* the last iterate is measured once more */
        CHECK_STATUS(rb_fem_wall_problem(wall, 0, &problem), RB_EINVAL);
        rb_fem_wall_free(wall);
    }
}

TEST(failures_name_the_step)
{
    const rb_fem_wall_options o = small_wall(1);
    rb_fem_wall *wall;
    rb_fem_wall_step step;
    rb_friction_problem problem;
    rb_message why = {.text = ""};
    int chosen;
    CHECK_OK(rb_fem_wall_create(&o, &wall, NULL));
    CHECK_STATUS(rb_fem_wall_problem(wall, 0, &problem), RB_EINVAL);
    CHECK_STATUS(rb_fem_wall_select(wall, 1, &chosen), RB_EINVAL);
    CHECK_STATUS(rb_fem_wall_advance(wall, "none", 1e-8, &step, &why), RB_EINVAL);
    assert_non_null(strstr(why.text, "wall, step 1: "));
    assert_non_null(strstr(why.text, "'none'"));
    for (int k = 0; k < 3; k++) {
        alloc_fail_after(k);
        const rb_status s = rb_fem_wall_advance(wall, "nsn-ac", 1e-8, &step, &why);
        alloc_succeed();
        CHECK_STATUS(s, RB_ENOMEM);
        assert_string_equal(why.text, "wall, step 1: out of memory");
    }
    CHECK_STATUS(rb_fem_wall_advance(wall, "nsn-ac", 1e-300, &step, &why), RB_MAXITER);
    assert_int_equal(strncmp(why.text, "wall, step 1: iteration limit, residual ", 40), 0);
    CHECK_STATUS(rb_fem_wall_problem(wall, -1, &problem), RB_EINVAL);
    CHECK_STATUS(rb_fem_wall_problem(wall, 1, &problem), RB_EINVAL);
    CHECK_OK(rb_fem_wall_advance(wall, "nsn-ac", 1e-8, &step, &why));
    CHECK_STATUS(rb_fem_wall_select(wall, 0, &chosen), RB_EINVAL);
    CHECK_OK(rb_fem_wall_select(wall, 1, &chosen));
    assert_int_equal(chosen, 1);
    alloc_fail_after(0);
    const rb_status selected = rb_fem_wall_select(wall, 1, &chosen);
    alloc_succeed();
    CHECK_STATUS(selected, RB_ENOMEM);
    for (int k = 0, refused = 1; refused; k++) {
        refused = REFUSED_FROM(k, rb_fem_wall_problem(wall, 0, &problem));
        rb_friction_problem_free(&problem);
    }
    rb_fem_wall_free(wall);
}

/* Pressed until nothing moves any more it is as short as a column of its section; blocks
 * that are rigid only move and turn. */
TEST(displacements_are_those_of_the_blocks)
{
    for (int rigid = 0; rigid < 2; rigid++) {
        rb_fem_wall_options o = small_wall(rigid);
        rb_fem_wall *wall;
        rb_fem_wall_step step;
        o.press = 4;
        o.shear = 0;
        CHECK_OK(rb_fem_wall_create(&o, &wall, NULL));
        for (int k = 0; k < (rigid ? 1 : 5); k++)
            CHECK_OK(rb_fem_wall_advance(wall, "nsn-ac", 1e-9, &step, NULL));
        const rb_fem_mesh *mesh = rb_fem_wall_mesh(wall);
        double *u = rb_alloc(3, (size_t)mesh->nodes), top = 0.0, largest = 0.0;
        int nodes = 0;
        CHECK_OK(rb_fem_wall_displacements(wall, u));
        for (int a = 0; a < mesh->nodes; a++) {
            largest = fmax(largest, fabs(u[3 * a + 2]));
            if (mesh->x[3 * a + 2] > 0.5 - 1e-9) {
                top += u[3 * a + 2];
                nodes++;
            }
        }
        const double whole = 30e3 * 0.5 / (2.2e9 * 0.4 * 0.1);
        if (!rigid)
            CHECK_REL(top / nodes, -whole, 0.1, "height of the wall");
        for (int e = 0; e < mesh->elements && rigid; e++)
            for (int k = 1; k < 8; k++) { /* no distance changes, to first order */
                const int a = 3 * mesh->node[8 * e], b = 3 * mesh->node[8 * e + k];
                double stretch = 0.0;
                for (int d = 0; d < 3; d++)
                    stretch += (u[b + d] - u[a + d]) * (mesh->x[b + d] - mesh->x[a + d]);
                CHECK_ABS(stretch, 0.0, 1e-12 * largest, "element %d", e);
            }
        assert_true(largest > 0.0);
        alloc_fail_after(0);
        const rb_status s = rb_fem_wall_displacements(wall, u);
        alloc_succeed();
        CHECK_STATUS(s, RB_ENOMEM);
        free(u);
        rb_fem_wall_free(wall);
    }
}

TEST(memory_runs_out)
{
    for (int rigid = 0; rigid < 2; rigid++) {
        const rb_fem_wall_options o = small_wall(rigid);
        for (int k = 0, refused = 1; refused; k++) {
            rb_fem_wall *wall;
            refused = REFUSED_FROM(k, rb_fem_wall_create(&o, &wall, NULL));
            rb_fem_wall_free(wall);
        }
    }
}

/* How far r, v and u are from a solution of the global form, recomputed: the imbalance
 * over the load, and Coulomb's law contact by contact over the largest velocity. */
static double violation(const rb_friction_problem *p, const double *r, const double *v)
{
    const int n = p->dofs, m = 3 * p->contacts;
    SCRATCH double *e = rb_alloc((size_t)n, 1), *u = rb_alloc((size_t)m, 1);
    double load = 0.0, worst = 0.0, fast = 0.0, hard = 0.0, law = 0.0;
    for (int j = 0; j < n; j++)
        for (int k = p->K.p[j]; k < p->K.p[j + 1]; k++)
            e[p->K.i[k]] += p->K.x[k] * v[j];
    for (int j = 0; j < m; j++)
        for (int k = p->H.p[j]; k < p->H.p[j + 1]; k++) {
            e[p->H.i[k]] -= p->H.x[k] * r[j];
            u[j] += p->H.x[k] * v[p->H.i[k]];
        }
    for (int i = 0; i < n; i++) {
        load = fmax(load, fabs(p->f[i]));
        worst = fmax(worst, fabs(e[i] - p->f[i]));
    }
    for (int j = 0; j < m; j++) {
        u[j] += p->w[j];
        fast = fmax(fast, fabs(u[j]));
        hard = fmax(hard, fabs(r[j]));
    }
    for (int c = 0; c < p->contacts; c++) {
        const double *rc = r + 3 * c, *uc = u + 3 * c, mu = p->mu[c];
        const double rt = hypot(rc[1], rc[2]), ut = hypot(uc[1], uc[2]);
        law = fmax(law, fmax(-uc[0] / fast, -rc[0] / hard));
        law = fmax(law, fmin(rc[0] / hard, uc[0] / fast));
        law = fmax(law, (rt - mu * rc[0]) / hard);
        law = fmax(law, fmin(ut / fast, (mu * rc[0] - rt) / hard));
    }
    return fmax(worst / load, law);
}

/* The wall with little friction, under its weight: Newton from zero cycles. */
TEST(auto_turns_to_smoothing_where_newton_cycles)
{
    rb_fem_wall_options o = small_wall(0);
    rb_fem_wall *wall;
    rb_fem_wall_step step;
    OWNED(rb_friction_problem) p;
    rb_friction_info smooth, info;
    CHECK_OK(rb_fem_wall_create(&o, &wall, &message));
    CHECK_OK(rb_fem_wall_advance(wall, "nsn-ac", 1e-8, &step, &message));
    CHECK_OK(rb_fem_wall_problem(wall, 0, &p));
    const size_t m = 3 * (size_t)p.contacts, n = (size_t)p.dofs;
    SCRATCH double *r = rb_alloc(m, 2), *v = rb_alloc(n, 1);
    rb_friction_options opt = rb_friction_defaults();
    for (int c = 0; c < p.contacts; c++)
        p.mu[c] *= 0.3;
    opt.tol = 1e-10;
    opt.max_iters = 60;
    CHECK_STATUS(rb_friction_solve("nsn-ac", &p, &opt, &(rb_friction_solution){r, r + m, v}, &info),
                 RB_MAXITER);
    CHECK_OK(rb_friction_solve("soclcp-smoothing", &p, &opt, &(rb_friction_solution){r, r + m, v},
                               &smooth));
    opt.max_iters = 0;
    CHECK_OK(rb_friction_solve("auto", &p, &opt, &(rb_friction_solution){r, r + m, v}, &info));
    CHECK_MAX(violation(&p, r, v), 1e-6, "%s", info.solver);
    CHECK_MAX(info.flops, 3.0 * smooth.flops, "%s beside smoothing", info.solver);
    rb_fem_wall_free(wall);
}

RUN_TESTS(NULL, NULL)
