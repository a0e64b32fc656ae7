/* Finite elements: rigid motions, patch test, closed forms, models, condensation. */
#include "check.h"
#include "fem/fem.h"

static const rb_fem_material material = {
    .young = 7.0, .poisson = 0.3, .density = 2.5, .section = 0.4};

static unsigned seed = 1;

static double noise(void)
{
    seed = seed * 1664525u + 1013904223u;
    return seed / 4294967296.0 - 0.5;
}

static void distorted(int d, double *x)
{
    static const int corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                     {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    for (int a = 0; a < 1 << d; a++)
        for (int k = 0; k < d; k++)
            x[d * a + k] = corner[a][k] * (1.0 + 0.5 * k) + 0.3 * noise();
}

/* Translations and infinitesimal rotations; column k of the six (three in the plane). */
static void rigid_motion(int d, int nodes, const double *x, int k, double *u)
{
    for (int a = 0; a < nodes; a++) {
        const double *p = x + d * a;
        double *v = u + d * a;
        memset(v, 0, (size_t)d * sizeof *v);
        if (k < d) {
            v[k] = 1.0;
        } else {
            const int i = (k - d + 1) % d, j = d == 2 ? 0 : (k - d + 2) % d;
            v[i] = -p[j];
            v[j] = p[i];
        }
    }
}

static void check_nullity(const rb_sparse *K, int want)
{
    int rank = -1;
    CHECK_OK(rb_sparse_rank(K, &rank));
    assert_int_equal(K->cols - rank, want);
}

static double worst_product(int n, const double *K, const double *u)
{
    double worst = 0.0;
    for (int i = 0; i < n; i++) {
        double sum = 0.0;
        for (int j = 0; j < n; j++)
            sum += K[i + n * j] * u[j];
        worst = fmax(worst, fabs(sum));
    }
    return worst;
}

TEST(rigid_motions_cost_nothing)
{
    for (int d = 2; d <= 3; d++) {
        const int n = d << d;
        double x[24], K[576], u[24];
        distorted(d, x);
        const rb_status s = d == 2 ? rb_fem_quad_stiffness(x, &material, K)
                                   : rb_fem_brick_stiffness(x, &material, K);
        CHECK_OK(s);
        for (int i = 0; i < n * n; i++)
            CHECK_ABS(K[i], K[i / n + n * (i % n)], 1e-14, "symmetry, d = %d", d);
        for (int k = 0; k < (d == 2 ? 3 : 6); k++) {
            rigid_motion(d, 1 << d, x, k, u);
            CHECK_MAX(worst_product(n, K, u), 1e-13, "d = %d, motion %d", d, k);
        }
    }
}

TEST(bar_pulls_along_itself)
{
    const double x[6] = {1, 2, 3, 3, 5, 9}; /* length 7 */
    double K[36];
    CHECK_OK(rb_fem_bar_stiffness(x, &material, K));
    const double along[6] = {0, 0, 0, 2.0 / 7, 3.0 / 7, 6.0 / 7};
    for (int i = 0; i < 6; i++) {
        double force = 0.0;
        for (int j = 0; j < 6; j++)
            force += K[i + 6 * j] * along[j];
        const double e = along[3 + i % 3];
        CHECK_ABS(force, (i < 3 ? -1 : 1) * 7.0 * 0.4 / 7.0 * e, 1e-15, "row %d", i);
    }
    const double across[6] = {0, 0, 0, 3, -2, 0};
    CHECK_MAX(worst_product(6, K, across), 1e-15, "no stiffness across");
}

/* Energy of a linear displacement u = G x in a distorted cell: volume sigma : eps / 2. */
TEST(linear_displacement_is_exact)
{
    const double G[3][3] = {{0.3, -0.2, 0.5}, {0.7, 0.1, -0.4}, {0.2, 0.6, -0.9}};
    const double shear = 7.0 / 2.6, lambda = 2.0 * shear * 0.3 / 0.4;
    double x[24], K[576], M[576], u[24], volume = 0.0, energy = 0.0;
    distorted(3, x);
    CHECK_OK(rb_fem_brick_stiffness(x, &material, K));
    CHECK_OK(rb_fem_brick_mass(x, &material, M));
    for (int i = 0; i < 24; i++) {
        u[i] = 0.0;
        for (int k = 0; k < 3; k++)
            u[i] += G[i % 3][k] * x[3 * (i / 3) + k];
    }
    for (int i = 0; i < 576; i++) {
        energy += 0.5 * K[i] * u[i % 24] * u[i / 24];
        if (i % 24 % 3 == 0 && i / 24 % 3 == 0)
            volume += M[i] / material.density;
    }
    double trace = G[0][0] + G[1][1] + G[2][2], square = 0.0;
    for (int i = 0; i < 9; i++) {
        const double e = 0.5 * (G[i / 3][i % 3] + G[i % 3][i / 3]);
        square += e * e;
    }
    CHECK_REL(energy, volume * (0.5 * lambda * trace * trace + shear * square), 1e-13,
              "energy of a brick");
}

/* A 3 x 2 mesh with a distorted inside; linear displacements leave inner nodes in
 * balance. */
TEST(patch_test)
{
    OWNED(rb_fem_mesh) mesh;
    CHECK_OK(rb_fem_mesh_alloc(RB_FEM_QUAD, 12, 6, &mesh));
    for (int k = 0; k < 12; k++) {
        const int inside = k % 4 > 0 && k % 4 < 3 && k / 4 == 1;
        mesh.x[2 * k] = k % 4 + (inside ? 0.4 * noise() : 0.0);
        mesh.x[2 * k + 1] = k / 4 + (inside ? 0.4 * noise() : 0.0);
    }
    for (int e = 0; e < 6; e++) {
        const int a = e % 3 + 4 * (e / 3);
        const int corner[4] = {a, a + 1, a + 5, a + 4};
        memcpy(mesh.node + 4 * e, corner, sizeof corner);
    }
    OWNED(rb_sparse) K = {0};
    CHECK_OK(rb_fem_stiffness(&mesh, &material, &K, NULL));
    double u[24], f[24];
    for (int k = 0; k < 12; k++) {
        u[2 * k] = 0.3 * mesh.x[2 * k] - 0.7 * mesh.x[2 * k + 1];
        u[2 * k + 1] = 0.2 * mesh.x[2 * k] + 0.5 * mesh.x[2 * k + 1];
    }
    rb_sparse_apply(1.0, &K, u, 0.0, f);
    for (int k = 10; k < 14; k++)
        CHECK_ABS(f[k], 0.0, 1e-14, "inner nodes 5 and 6, entry %d", k);
    check_nullity(&K, 3);
}

TEST(truss_has_the_stated_layouts)
{
    static const struct {
        rb_fem_layout layout;
        int nodes, dofs, bars;
        double weight;
    } want[] = {{RB_FEM_UPPER_INSIDE, 265, 795, 968, 100.0},
                {RB_FEM_UPPER_OVERHANGING, 313, 939, 1152, 144.0}};
    for (int k = 0; k < 2; k++) {
        OWNED(rb_fem_model) model;
        double sum = 0.0;
        CHECK_OK(rb_fem_model_truss(want[k].layout, 12, &model, NULL));
        assert_int_equal(model.mesh.nodes, want[k].nodes);
        assert_int_equal(model.mesh.dofs, want[k].dofs);
        assert_int_equal(model.mesh.elements, want[k].bars);
        for (int i = 0; i < model.mesh.dofs; i++)
            sum += model.load[i];
        CHECK_REL(sum, -5.0 * 102900.0 * want[k].weight, 1e-14, "load, layout %d", k);
        rb_fem_condensation *c = NULL;
        CHECK_OK(rb_fem_condense(&model.structure, &c, NULL));
        check_nullity(&rb_fem_condensed(c)->K, 7);
        rb_fem_condensation_free(c);
    }
}

static double mean_diagonal(const rb_sparse *K)
{
    double sum = 0.0;
    for (int j = 0; j < K->cols; j++)
        for (int k = K->p[j]; k < K->p[j + 1]; k++)
            sum += K->i[k] == j ? K->x[k] : 0.0;
    return sum / K->cols;
}

/* The figures of tests/data/kanno/reference.json, soclcp_method. */
TEST(condensed_stiffness_is_the_reference)
{
    rb_fem_model model;
    rb_fem_condensation *c = NULL;
    CHECK_OK(rb_fem_model_bar(160, 16, &model, NULL));
    assert_int_equal(model.mesh.nodes, 2737);
    assert_int_equal(model.mesh.dofs, 5474 - 17);
    CHECK_OK(rb_fem_condense(&model.structure, &c, NULL));
    assert_int_equal(rb_fem_condensed(c)->dofs, 321);
    CHECK_REL(mean_diagonal(&rb_fem_condensed(c)->K), 138.77768, 1e-7, "bar");
    check_nullity(&rb_fem_condensed(c)->K, 1);
    rb_fem_condensation_free(c);
    rb_fem_model_free(&model);
    CHECK_OK(rb_fem_model_truss(RB_FEM_UPPER_INSIDE, 12, &model, NULL));
    CHECK_OK(rb_fem_condense(&model.structure, &c, NULL));
    CHECK_REL(mean_diagonal(&rb_fem_condensed(c)->K), 1539899.8, 1e-7, "truss");
    rb_fem_condensation_free(c);
    rb_fem_model_free(&model);
}

/* Held contact nodes: condensed and full equations agree. */
TEST(expansion_solves_the_full_system)
{
    OWNED(rb_fem_model) model;
    rb_fem_condensation *c = NULL;
    CHECK_OK(rb_fem_model_bar(12, 3, &model, NULL));
    CHECK_OK(rb_fem_condense(&model.structure, &c, NULL));
    const int n = model.mesh.dofs, nc = rb_fem_condensed(c)->dofs;
    SCRATCH double *u = rb_alloc((size_t)n, 1), *uc = rb_alloc((size_t)nc, 1);
    SCRATCH double *f = rb_alloc((size_t)n, 1), *fc = rb_alloc((size_t)nc, 1);
    for (int i = 0; i < nc; i++)
        uc[i] = noise();
    CHECK_OK(rb_fem_expand(c, model.load, uc, u));
    CHECK_OK(rb_fem_condense_load(c, model.load, fc));
    memcpy(f, model.load, (size_t)n * sizeof *f);
    rb_sparse_apply(1.0, &model.structure.K, u, -1.0, f); /* forces to hold it */
    rb_sparse_apply(1.0, &rb_fem_condensed(c)->K, uc, -1.0, fc);
    double worst = 0.0, largest = rb_norm_inf((size_t)nc, fc);
    for (int i = 0, k = 0; i < n; i++) {
        const int is_contact = k < nc && u[i] == uc[k];
        worst = fmax(worst, fabs(is_contact ? f[i] - fc[k] : f[i]));
        k += is_contact;
    }
    CHECK_MAX(worst, 1e-12 * largest, "largest force %g", largest);
    rb_fem_condensation_free(c);
}

TEST(bad_input_is_refused)
{
    double K[576], x[24], line[6] = {1, 1, 1, 1, 1, 1};
    CHECK_STATUS(rb_fem_bar_stiffness(line, &material, K), RB_EINVAL);
    const double turned[8] = {0, 0, 0, 1, 1, 1, 1, 0};
    CHECK_STATUS(rb_fem_quad_stiffness(turned, &material, K), RB_EINVAL);
    memset(x, 0, sizeof x);
    CHECK_STATUS(rb_fem_brick_mass(x, &material, K), RB_EINVAL);
    rb_fem_mesh mesh;
    rb_sparse A = {0};
    CHECK_STATUS(rb_fem_mesh_alloc(RB_FEM_QUAD, 0, 1, &mesh), RB_EINVAL);
    CHECK_OK(rb_fem_mesh_alloc(RB_FEM_QUAD, 4, 1, &mesh));
    CHECK_SAYS(rb_fem_stiffness(&mesh, &material, &A, &message), RB_EINVAL, "element 0");
    CHECK_STATUS(rb_fem_mass(&mesh, &material, &A, &message), RB_EINVAL);
    mesh.node[2] = 4;
    CHECK_SAYS(rb_fem_stiffness(&mesh, &material, &A, &message), RB_EINVAL, "node 4 of 4");
    mesh.node[2] = -1;
    CHECK_STATUS(rb_fem_stiffness(&mesh, &material, &A, &message), RB_EINVAL);
    assert_string_equal(message.text, "element 0: node -1 of 4");
    const struct {
        rb_fem_material m;
        const char *part;
    } wrong[] = {{{.young = -1.0, .poisson = 0.3, .section = 1.0}, "young = -1: expected > 0"},
                 {{.young = 0.0, .poisson = 0.3, .section = 1.0}, "young = 0: expected > 0"},
                 {{.young = INFINITY, .poisson = 0.3, .section = 1.0}, "young = inf"},
                 {{.young = 1.0, .poisson = 0.5, .section = 1.0}, "poisson = 0.5: expected in"},
                 {{.young = 1.0, .poisson = -1.0, .section = 1.0}, "poisson = -1: expected in"},
                 {{.young = 1.0, .poisson = 0.3, .section = 0.0}, "section = 0: expected > 0"}};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        CHECK_SAYS(rb_fem_stiffness(&mesh, &wrong[k].m, &A, &message), RB_EINVAL, wrong[k].part);
    }
    mesh.node[2] = 2;
    for (int k = 0; k < 8; k++)
        rb_fem_mesh_hold(&mesh, k / 2, k % 2);
    rb_fem_mesh_number(&mesh);
    CHECK_STATUS(rb_fem_stiffness(&mesh, &material, &A, &message), RB_EINVAL);
    assert_string_equal(message.text, "mesh: every node is held");
    rb_fem_mesh_free(&mesh);
    CHECK_STATUS(rb_fem_mesh_alloc(RB_FEM_BRICK, 4, -1, &mesh), RB_EINVAL);
    CHECK_OK(rb_fem_mesh_alloc(RB_FEM_BRICK, 8, 1, &mesh));
    const rb_fem_material weightless = {.young = 1.0, .poisson = 0.3};
    CHECK_STATUS(rb_fem_mass(&mesh, &weightless, &A, &message), RB_EINVAL);
    assert_string_equal(message.text, "density = 0: expected > 0");
    rb_fem_mesh_free(&mesh);
}

/* The smallest models are there, those beside the range are not. */
TEST(models_have_their_range)
{
    static const struct {
        int truss, nx, ny, is_there;
    } sizes[] = {{0, 0, 3, 0}, {0, 3, 0, 0}, {0, 2001, 1, 0}, {0, 1, 2001, 0},
                 {0, 1, 1, 1}, {1, 1, 0, 0}, {1, 201, 0, 0},  {1, 2, 0, 1}};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        OWNED(rb_fem_model) model;
        rb_message why = {.text = ""};
        const rb_status s = sizes[k].truss
                                ? rb_fem_model_truss(RB_FEM_UPPER_INSIDE, sizes[k].nx, &model, &why)
                                : rb_fem_model_bar(sizes[k].nx, sizes[k].ny, &model, &why);
        CHECK_STATUS(s, sizes[k].is_there ? RB_OK : RB_EINVAL);
        assert_int_equal(why.text[0] == '\0', sizes[k].is_there);
    }
}

/* A structure by hand: all unknowns touch a contact, one is left over, one is loose, or
 * nothing touches anything. */
TEST(condensation_of_every_kind)
{
    static const double K[9] = {2.0, 1.0, 0.5, 1.0, 3.0, 0.0, 0.5, 0.0, 4.0};
    static const double load[3] = {1.0, -2.0, 3.0};
    for (int kind = 0; kind < 4; kind++) {
        const int n = kind == 0 ? 2 : 3;
        double mu = 0.3, gap = 0.1, load_c[2], u[3], unit[6] = {0};
        double stiffness[9];
        rb_fem_structure s = {.dofs = n, .dimension = 2, .contacts = 1, .mu = &mu, .gap = &gap};
        rb_fem_condensation *c;
        rb_message why = {.text = ""};
        for (int i = 0; i < n * n; i++)
            stiffness[i] = K[i % n + 3 * (i / n)];
        if (kind == 2)
            stiffness[2] = stiffness[6] = stiffness[8] = 0.0;
        unit[0] = unit[n + 1] = kind < 3;
        CHECK_OK(rb_sparse_from_dense(n, n, stiffness, n, &s.K));
        CHECK_OK(rb_sparse_from_dense(n, 2, unit, n, &s.H));
        const rb_status status = rb_fem_condense(&s, &c, &why);
        CHECK_STATUS(status, kind < 2 ? RB_OK : kind == 2 ? RB_SINGULAR : RB_EINVAL);
        if (kind == 2)
            assert_non_null(strstr(why.text, "parts of the structure move even when"));
        if (kind == 3)
            assert_non_null(strstr(why.text, "no contact touches the structure"));
        if (kind < 2) { /* u_C = e_1: K_c e_1 balances the reduced load */
            const double alone[2] = {1.0, -0.5};
            const rb_fem_structure *d = rb_fem_condensed(c);
            assert_int_equal(d->dofs, 2);
            CHECK_ABS(d->gap[0], 0.1, 0.0, "gap");
            CHECK_ABS(d->mu[0], 0.3, 0.0, "mu");
            double reaction[2] = {0.0, 0.0};
            rb_sparse_apply(1.0, &d->K, alone, 0.0, reaction);
            CHECK_OK(rb_fem_condense_load(c, load, load_c));
            CHECK_OK(rb_fem_expand(c, load, alone, u));
            for (int i = 0; i < n; i++) {
                double force = -load[i];
                for (int j = 0; j < n; j++)
                    force += stiffness[i + n * j] * u[j];
                CHECK_ABS(force, i < 2 ? reaction[i] - load_c[i] : 0.0, 1e-14, "kind %d, row %d",
                          kind, i);
            }
        } else
            assert_null(c);
        rb_fem_condensation_free(c);
        rb_sparse_free(&s.K);
        rb_sparse_free(&s.H);
    }
}

/* Without a load and without stiffness forces and lengths keep their units. */
TEST(units_without_a_load)
{
    static const double none[4] = {0.0}, half[4] = {0.0, 0.5, 0.5, 8.0};
    for (int stiff = 0; stiff < 2; stiff++)
        for (int loaded = 0; loaded < 2; loaded++) {
            double mu = 0.3, gap = 0.1, load[2] = {0.0, loaded ? -4.0 : 0.0};
            const double unit[4] = {1.0, 0.0, 0.0, 1.0};
            rb_fem_structure s = {.dofs = 2, .dimension = 2, .contacts = 1, .mu = &mu, .gap = &gap};
            OWNED(rb_fem_state) at;
            rb_fem_units units;
            OWNED(rb_friction_problem) p;
            CHECK_OK(rb_sparse_from_dense(2, 2, stiff ? half : none, 2, &s.K));
            CHECK_OK(rb_sparse_from_dense(2, 2, unit, 2, &s.H));
            CHECK_OK(rb_fem_state_alloc(&s, &at));
            CHECK_OK(rb_fem_problem(&s, load, &at, &p, &units));
            CHECK_ABS(units.force, loaded ? 4.0 : 1.0, 0.0, "force");
            CHECK_ABS(units.length, stiff ? units.force * 2.0 / 8.0 : 1.0, 0.0, "length");
            CHECK_ABS(p.f[1], loaded ? -1.0 : 0.0, 0.0, "f");
            CHECK_ABS(p.w[0], 0.1 / units.length, 1e-15, "w");
            CHECK_ABS(p.w[1], 0.0, 0.0, "w");
            rb_sparse_free(&s.K);
            rb_sparse_free(&s.H);
        }
}

static rb_status build_and_condense(void)
{
    OWNED(rb_fem_model) model;
    rb_fem_condensation *c = NULL;
    OWNED(rb_fem_state) at = {0};
    rb_status s = rb_fem_model_bar(4, 2, &model, NULL);
    if (s == RB_OK)
        s = rb_fem_condense(&model.structure, &c, NULL);
    if (s == RB_OK)
        s = rb_fem_state_alloc(&model.structure, &at);
    rb_fem_condensation_free(c);
    return s;
}

TEST(memory_runs_out)
{
    for (int k = 0, refused = 1; refused; k++) {
        refused = REFUSED_FROM(k, build_and_condense());
    }
}

RUN_TESTS(NULL, NULL)
