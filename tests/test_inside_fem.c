/* The parts of the wall: weight, joints, the map of its contacts, rigid blocks, and what
 * its steps push against. */
#include "check.h"
#include "fem/wall.h"
#include "small_wall.h"

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
    CHECK_OK(wall_build_mesh(&p->layout, &p->mesh));
    p->contacts = wall_find_contacts(&p->layout, NULL);
    p->contact = calloc((size_t)p->contacts, sizeof *p->contact);
    wall_find_contacts(&p->layout, p->contact);
    CHECK_OK(wall_elastic_system(&p->layout, &p->mesh, p->contacts, p->contact, &p->system, NULL));
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
    CHECK_OK(rb_sparse_rank(&p.system.H, &rank));
    assert_int_equal(rank, 3 * p.contacts);
    close_parts(&p);
}

/* The wall moving as one rigid body opens and slides no joint between blocks. */
TEST(common_motion_leaves_the_joints_alone)
{
    const rb_fem_wall_options o = small_wall(0);
    parts p;
    open_parts(&o, &p);
    SCRATCH double *v = rb_alloc((size_t)p.system.dofs, 1);
    SCRATCH double *u = rb_alloc(3, (size_t)p.contacts);
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
            const double want = c->other >= 0 && c->other < BLOCKS ? 0.0 : mine[wall_axis(c, k)];
            CHECK_ABS(u[3 * i + k], sign * want, 1e-14, "contact %d, component %d", i, k);
        }
    }
    close_parts(&p);
}

/* R' M R of a box: m and m (b^2 + c^2)/12, exactly integrated. */
TEST(rigid_blocks_have_their_inertia)
{
    const rb_fem_wall_options o = small_wall(1);
    parts p;
    OWNED(wall_system) rigid;
    OWNED(rb_sparse) R = {0};
    open_parts(&o, &p);
    CHECK_OK(wall_rigid_system(&p.layout, &p.mesh, &p.system, &R, &rigid));
    const double m = 4.0; /* the first block: 0.2 x 0.1 x 0.1 m */
    const double want[6] = {m, m, m, m * 0.02 / 12, m * 0.05 / 12, m * 0.05 / 12};
    for (int j = 0; j < 6; j++) {
        double column[6] = {0};
        for (int k = rigid.M.p[j]; k < rigid.M.p[j + 1]; k++) {
            CHECK_ABS(rigid.M.i[k] < 6 ? 0.0 : rigid.M.x[k], 0.0, 1e-14, "between blocks");
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
    o.press = 3;
    o.shear = 3;
    CHECK_OK(rb_fem_wall_create(&o, &wall, &message));
    assert_int_equal(rb_fem_wall_steps(wall), 7);
    for (int k = 0; k < 7; k++) {
        CHECK_OK(rb_fem_wall_advance(wall, "nsn-ac", 1e-10, &step, &message));
        CHECK_REL(step.compression, 10e3 * fmin(k, 3), 1e-14, "step %d", k);
        assert_int_equal(step.stick + step.slip + step.separated, rb_fem_wall_contacts(wall));
    }
    CHECK_REL(step.drift, 3e-5, 1e-12, "drift");
    assert_true(step.shear > 500.0 && step.shear < 0.53 * 30e3);
    CHECK_STATUS(rb_fem_wall_advance(wall, "nsn-ac", 1e-10, &step, &message), RB_EINVAL);
    const size_t m = 3 * (size_t)rb_fem_wall_contacts(wall);
    SCRATCH double *r = rb_alloc(m, 2), *u = rb_alloc(m, 2);
    for (int k = 2; k < 7; k += 4) {
        static const char *const solvers[] = {"nsn-ac", "nsn-jm"};
        OWNED(rb_friction_problem) problem;
        rb_friction_info info;
        rb_friction_options options = rb_friction_defaults();
        options.tol = 1e-11;
        CHECK_OK(rb_fem_wall_problem(wall, k, &problem));
        for (size_t l = 0; l < 2; l++)
            CHECK_OK(rb_friction_solve(solvers[l], &problem, &options,
                                       &(rb_friction_solution){r + l * m, u + l * m, NULL}, &info));
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
    }
    rb_fem_wall_free(wall);
}

RUN_TESTS(NULL, NULL)
