/* The wall: its geometry and contact map, one step after the other, elastic and rigid. */
#include "check.h"
#include "fem/wall.h"

#include <string.h>

static rb_fem_wall_options small_wall(int rigid)
{
    rb_fem_wall_options o = rb_fem_wall_defaults();
    const int fine[3] = {4, 3, 3}, coarse[3] = {3, 2, 3};
    memcpy(o.fine, fine, sizeof fine);
    memcpy(o.coarse, coarse, sizeof coarse);
    o.rigid = rigid;
    return o;
}

typedef struct {
    wall_layout layout;
    rb_fem_mesh mesh;
    wall_contact *contact;
    int contacts;
    wall_system system;
} parts;

static void open_parts(const rb_fem_wall_options *o, parts *p)
{
    p->layout = wall_lay_out(o);
    CHECK_STATUS(wall_build_mesh(&p->layout, &p->mesh), RB_OK);
    p->contacts = wall_find_contacts(&p->layout, NULL);
    p->contact = calloc((size_t)p->contacts, sizeof *p->contact);
    wall_find_contacts(&p->layout, p->contact);
    CHECK_STATUS(wall_elastic_system(&p->layout, &p->mesh, p->contacts, p->contact,
                                     &p->system, NULL),
                 RB_OK);
}

static void close_parts(parts *p)
{
    wall_system_free(&p->system);
    rb_fem_mesh_free(&p->mesh);
    free(p->contact);
}

TEST(blocks_weigh_what_they_should)
{
    const rb_fem_wall_options o = small_wall(0);
    parts p;
    open_parts(&o, &p);
    double weight = 0.0;
    for (int i = 0; i < p.system.dofs; i++)
        weight += p.system.weight[i];
    CHECK_REL(weight, -9.81 * 2000.0 * 0.4 * 0.1 * 0.5, 1e-13, "weight");
    /* 6 bed joints of 2 x 4 x 3 nodes; heads: courses 1, 3, 5 one of 3, 2, 4 two of 2 */
    assert_int_equal(p.contacts, 6 * 24 + 3 * 3 + 2 * 2 * 2);
    close_parts(&p);
}

TEST(contact_map_has_full_rank)
{
    const rb_fem_wall_options o = small_wall(0);
    parts p;
    int rank = -1;
    open_parts(&o, &p);
    CHECK_STATUS(rb_sparse_rank(&p.system.H, &rank), RB_OK);
    assert_int_equal(rank, 3 * p.contacts);
    close_parts(&p);
}

/* The wall moving as one rigid body opens and slides no joint between blocks. */
TEST(common_motion_leaves_the_joints_alone)
{
    const rb_fem_wall_options o = small_wall(0);
    parts p;
    open_parts(&o, &p);
    double *v = rb_alloc((size_t)p.system.dofs, 1);
    double *u = rb_alloc(3, (size_t)p.contacts);
    for (int a = 0; a < p.mesh.nodes; a++) {
        const double *x = p.mesh.x + 3 * a;
        v[3 * a] = 1.0 - 0.7 * x[1] + 0.4 * x[2];
        v[3 * a + 1] = 0.3 + 0.7 * x[0] - 0.2 * x[2];
        v[3 * a + 2] = -0.5 - 0.4 * x[0] + 0.2 * x[1];
    }
    rb_sparse_apply_transposed(1.0, &p.system.H, v, 0.0, u);
    for (int i = 0; i < p.contacts; i++) {
        const wall_contact *c = &p.contact[i];
        const double *mine = v + 3 * c->node;
        for (int k = 0; k < 3; k++) {
            const double sign = k == 0 ? c->sign : 1.0;
            const double want =
                c->other >= 0 && c->other < BLOCKS ? 0.0 : mine[wall_axis(c, k)];
            CHECK_ABS(u[3 * i + k], sign * want, 1e-14, "contact %d, component %d", i, k);
        }
    }
    free(v);
    free(u);
    close_parts(&p);
}

/* R' M R of a box: m and m (b^2 + c^2)/12, exactly integrated. */
TEST(rigid_blocks_have_their_inertia)
{
    const rb_fem_wall_options o = small_wall(1);
    parts p;
    wall_system rigid;
    rb_sparse R = {0};
    open_parts(&o, &p);
    CHECK_STATUS(wall_rigid_system(&p.layout, &p.mesh, &p.system, &R, &rigid), RB_OK);
    const double m = 4.0; /* the first block: 0.2 x 0.1 x 0.1 m */
    const double want[6] = {m, m, m, m * 0.02 / 12, m * 0.05 / 12, m * 0.05 / 12};
    for (int j = 0; j < 6; j++) {
        double column[6] = {0};
        for (int k = rigid.M.p[j]; k < rigid.M.p[j + 1]; k++) {
            CHECK_ABS(rigid.M.i[k] < 6 ? 0.0 : rigid.M.x[k], 0.0, 1e-14,
                      "between blocks");
            if (rigid.M.i[k] < 6)
                column[rigid.M.i[k]] = rigid.M.x[k];
        }
        for (int i = 0; i < 6; i++)
            CHECK_ABS(column[i], i == j ? want[i] : 0.0, 1e-14, "inertia %d, %d", i, j);
    }
    CHECK_REL(rigid.M.x[rigid.M.p[rigid.dofs] - 1], 300.0, 1e-14, "upper support");
    double weight = 0.0, press = 0.0;
    for (int i = 0; i < rigid.dofs; i++) {
        weight += i % 6 == 2 ? rigid.weight[i] : 0.0; /* the others turn */
        press += rigid.press[i];
    }
    CHECK_REL(weight, -9.81 * 2000.0 * 0.4 * 0.1 * 0.5, 1e-13, "weight");
    CHECK_REL(press, -1.0, 1e-14, "of a unit force on the upper support");
    wall_system_free(&rigid);
    rb_sparse_free(&R);
    close_parts(&p);
}

/* Three steps of pressing and three of driving: every recorded problem is solved by
 * another solver too, with the same velocities (H has full rank and M + dt^2 K is
 * regular). */
TEST(steps_are_problems_for_every_solver)
{
    rb_fem_wall_options o = small_wall(0);
    rb_fem_wall *wall;
    rb_fem_wall_step step;
    rb_message why = {""};
    o.press = 3;
    o.shear = 3;
    CHECK_STATUS(rb_fem_wall_create(&o, &wall, &why), RB_OK);
    assert_int_equal(rb_fem_wall_steps(wall), 7);
    for (int k = 0; k < 7; k++) {
        CHECK_STATUS(rb_fem_wall_advance(wall, "nsn-ac", 1e-10, &step, &why), RB_OK);
        CHECK_REL(step.compression, 10e3 * fmin(k, 3), 1e-14, "step %d", k);
        assert_int_equal(step.stick + step.slip + step.separated,
                         rb_fem_wall_contacts(wall));
    }
    CHECK_REL(step.drift, 3e-5, 1e-12, "drift");
    assert_true(step.shear > 500.0 && step.shear < 0.53 * 30e3);
    CHECK_STATUS(rb_fem_wall_advance(wall, "nsn-ac", 1e-10, &step, &why), RB_EINVAL);
    const size_t m = 3 * (size_t)rb_fem_wall_contacts(wall);
    double *r = rb_alloc(m, 2), *u = rb_alloc(m, 2);
    for (int k = 2; k < 7; k += 4) {
        static const char *const solvers[] = {"nsn-ac", "nsn-jm"};
        rb_friction_problem problem;
        rb_friction_info info;
        rb_friction_options options = rb_friction_defaults();
        options.tol = 1e-11;
        CHECK_STATUS(rb_fem_wall_problem(wall, k, &problem), RB_OK);
        for (size_t l = 0; l < 2; l++)
            CHECK_STATUS(rb_friction_solve(
                             solvers[l], &problem, &options,
                             &(rb_friction_solution){r + l * m, u + l * m, NULL}, &info),
                         RB_OK);
        for (size_t i = 0; i < m; i++)
            CHECK_ABS(u[i], u[i + m], 1e-7 * 1e-3, "step %d, entry %zu", k, i);
        if (k == 6) { /* the impulses on the upper support, along the wall */
            parts p;
            double shear = 0.0;
            open_parts(&o, &p);
            for (int i = 0; i < p.contacts; i++)
                shear += p.contact[i].other == UPPER_SUPPORT ? r[3 * i + 1] / o.dt : 0.0;
            CHECK_REL(step.shear, shear, 1e-5, "shear");
            close_parts(&p);
        }
        rb_friction_problem_free(&problem);
    }
    free(r);
    free(u);
    rb_fem_wall_free(wall);
}

TEST(selection_is_by_difficulty)
{
    rb_fem_wall_options o = small_wall(0);
    rb_fem_wall *wall;
    rb_fem_wall_step step[6];
    int chosen[5], seen[6] = {0};
    o.press = 2;
    o.shear = 3;
    CHECK_STATUS(rb_fem_wall_create(&o, &wall, NULL), RB_OK);
    for (int k = 0; k < 6; k++)
        CHECK_STATUS(rb_fem_wall_advance(wall, "nsn-ac", 1e-8, &step[k], NULL), RB_OK);
    CHECK_STATUS(rb_fem_wall_select(wall, 6, chosen), RB_EINVAL);
    CHECK_STATUS(rb_fem_wall_select(wall, 5, chosen), RB_OK);
    for (int k = 0; k < 5; k++) {
        assert_true(chosen[k] > 0 && !seen[chosen[k]]++);
        assert_true(k == 0 ||
                    step[chosen[k]].iterations >= step[chosen[k - 1]].iterations);
    }
    rb_fem_wall_free(wall);
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
    CHECK_STATUS(rb_fem_wall_create(&o, &wall, NULL), RB_OK);
    assert_int_equal(rb_fem_wall_dofs(wall), 73);
    CHECK_STATUS(rb_fem_wall_rank(wall, &rank), RB_OK);
    assert_int_equal(rank, 73);
    for (int k = 0; k < 3; k++)
        CHECK_STATUS(rb_fem_wall_advance(wall, "nsn-ac", 1e-9, &step, NULL), RB_OK);
    const rb_fem_mesh *mesh = rb_fem_wall_mesh(wall);
    double *u = rb_alloc(3, (size_t)mesh->nodes);
    CHECK_STATUS(rb_fem_wall_displacements(wall, u), RB_OK);
    CHECK_MAX(rb_norm_inf(3 * (size_t)mesh->nodes, u), 1e-8,
              "rigid blocks do not sink [m]");
    free(u);
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
        rb_message why = {""};
        rb_fem_wall_options o = {
            .dt = walls[k].dt, .press = walls[k].press, .shear = walls[k].shear};
        memcpy(o.fine, walls[k].fine, sizeof o.fine);
        memcpy(o.coarse, walls[k].coarse, sizeof o.coarse);
        CHECK_STATUS(rb_fem_wall_create(&o, &wall, &why),
                     walls[k].part ? RB_EINVAL : RB_OK);
        if (walls[k].part)
            assert_non_null(strstr(why.text, walls[k].part));
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
        rb_message why = {""};
        rb_friction_problem problem;
        o.stopped = stop_at_the_third;
        o.context = &asked;
        CHECK_STATUS(rb_fem_wall_create(&o, &wall, NULL), RB_OK);
        CHECK_STATUS(rb_fem_wall_advance(wall, solvers[k], 1e-13, &step, &why),
                     RB_INTERRUPTED);
        assert_string_equal(why.text, "interrupted after step 0");
        assert_true(asked >= 3 &&
                    asked <= 4); /* the last iterate is measured once more */
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
    rb_message why = {""};
    int chosen;
    CHECK_STATUS(rb_fem_wall_create(&o, &wall, NULL), RB_OK);
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
    assert_int_equal(strncmp(why.text, "wall, step 1: iteration limit, residual ", 40),
                     0);
    CHECK_STATUS(rb_fem_wall_problem(wall, -1, &problem), RB_EINVAL);
    CHECK_STATUS(rb_fem_wall_problem(wall, 1, &problem), RB_EINVAL);
    CHECK_STATUS(rb_fem_wall_advance(wall, "nsn-ac", 1e-8, &step, &why), RB_OK);
    CHECK_STATUS(rb_fem_wall_select(wall, 0, &chosen), RB_EINVAL);
    CHECK_STATUS(rb_fem_wall_select(wall, 1, &chosen), RB_OK);
    assert_int_equal(chosen, 1);
    alloc_fail_after(0);
    const rb_status selected = rb_fem_wall_select(wall, 1, &chosen);
    alloc_succeed();
    CHECK_STATUS(selected, RB_ENOMEM);
    for (int k = 0;; k++) {
        alloc_fail_after(k);
        const rb_status s = rb_fem_wall_problem(wall, 0, &problem);
        const int refused = alloc_failed();
        alloc_succeed();
        CHECK_STATUS(s, refused ? RB_ENOMEM : RB_OK);
        rb_friction_problem_free(&problem);
        if (!refused)
            break;
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
        CHECK_STATUS(rb_fem_wall_create(&o, &wall, NULL), RB_OK);
        for (int k = 0; k < (rigid ? 1 : 5); k++)
            CHECK_STATUS(rb_fem_wall_advance(wall, "nsn-ac", 1e-9, &step, NULL), RB_OK);
        const rb_fem_mesh *mesh = rb_fem_wall_mesh(wall);
        double *u = rb_alloc(3, (size_t)mesh->nodes), top = 0.0, largest = 0.0;
        int nodes = 0;
        CHECK_STATUS(rb_fem_wall_displacements(wall, u), RB_OK);
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
        for (int k = 0;; k++) {
            rb_fem_wall *wall;
            alloc_fail_after(k);
            const rb_status s = rb_fem_wall_create(&o, &wall, NULL);
            const int refused = alloc_failed();
            alloc_succeed();
            rb_fem_wall_free(wall);
            if (!refused) {
                CHECK_STATUS(s, RB_OK);
                break;
            }
            CHECK_STATUS(s, RB_ENOMEM);
        }
    }
}

/* How far r, v and u are from a solution of the global form, recomputed: the imbalance
 * over the load, and Coulomb's law contact by contact over the largest velocity. */
static double violation(const rb_friction_problem *p, const double *r, const double *v)
{
    const int n = p->dofs, m = 3 * p->contacts;
    double *e = rb_alloc((size_t)n, 1), *u = rb_alloc((size_t)m, 1);
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
    free(u);
    free(e);
    return fmax(worst / load, law);
}

/* The wall with little friction, under its weight: Newton from zero cycles. */
TEST(auto_turns_to_smoothing_where_newton_cycles)
{
    rb_fem_wall_options o = small_wall(0);
    rb_fem_wall *wall;
    rb_fem_wall_step step;
    rb_friction_problem p;
    rb_friction_info smooth, info;
    rb_message why = {""};
    CHECK_STATUS(rb_fem_wall_create(&o, &wall, &why), RB_OK);
    CHECK_STATUS(rb_fem_wall_advance(wall, "nsn-ac", 1e-8, &step, &why), RB_OK);
    CHECK_STATUS(rb_fem_wall_problem(wall, 0, &p), RB_OK);
    const size_t m = 3 * (size_t)p.contacts, n = (size_t)p.dofs;
    double *r = rb_alloc(m, 2), *v = rb_alloc(n, 1);
    rb_friction_options opt = rb_friction_defaults();
    for (int c = 0; c < p.contacts; c++)
        p.mu[c] *= 0.3;
    opt.tol = 1e-10;
    opt.max_iters = 60;
    CHECK_STATUS(rb_friction_solve("nsn-ac", &p, &opt,
                                   &(rb_friction_solution){r, r + m, v}, &info),
                 RB_MAXITER);
    CHECK_STATUS(rb_friction_solve("soclcp-smoothing", &p, &opt,
                                   &(rb_friction_solution){r, r + m, v}, &smooth),
                 RB_OK);
    opt.max_iters = 0;
    CHECK_STATUS(
        rb_friction_solve("auto", &p, &opt, &(rb_friction_solution){r, r + m, v}, &info),
        RB_OK);
    CHECK_MAX(violation(&p, r, v), 1e-6, "%s", info.solver);
    CHECK_MAX(info.flops, 3.0 * smooth.flops, "%s beside smoothing", info.solver);
    free(v);
    free(r);
    rb_friction_problem_free(&p);
    rb_fem_wall_free(wall);
}

RUN_TESTS(NULL, NULL)
