/* The bar and both trusses against tests/data/kanno/reference.json, each by two solvers;
 * equilibrium and the contact laws recomputed from the states alone. */
#include "check.h"
#include "fem/fem.h"

#include <jansson.h>

static json_t *reference;

static int load_reference(void **state)
{
    reference = json_load_file("tests/data/kanno/reference.json", 0, NULL);
    return reference ? 0 : -1;
}

static int drop_reference(void **state)
{
    json_decref(reference);
    return 0;
}

static double number(const json_t *o, const char *key)
{
    const json_t *x = json_object_get(o, key);
    assert_true(json_is_number(x));
    return json_number_value(x);
}

static double entry(const json_t *o, const char *key, size_t k)
{
    return json_number_value(json_array_get(json_object_get(o, key), k));
}

static double tangential(int d, const double *x)
{
    return d == 2 ? fabs(x[1]) : hypot(x[1], x[2]);
}

/* Coulomb's law and Signorini's for every contact, and K u = F + H r on the full mesh. */
static void laws_hold(const rb_fem_model *model, const rb_fem_history *h, double tol)
{
    const int d = model->mesh.dimension, n = model->structure.dofs;
    SCRATCH double *u = rb_alloc((size_t)n, 1), *f = rb_alloc((size_t)n, 1);
    double far = 0.0;
    for (int k = 0; k < h->steps; k++)
        for (int i = 0; i < model->structure.contacts; i++)
            far = fmax(far, tangential(d, h->step[k].du + d * i));
    for (int k = 0; k < h->steps; k++) {
        const rb_fem_step *s = &h->step[k];
        double most = 0.0;
        for (int i = 0; i < model->structure.contacts; i++)
            most = fmax(most, s->r[d * i]);
        for (int i = 0; i < model->structure.contacts; i++) {
            const double *r = s->r + d * i, *du = s->du + d * i;
            const double limit = model->structure.mu[i] * r[0], t = tangential(d, r);
            double work = 0.0;
            for (int a = 1; a < d; a++)
                work += r[a] * du[a];
            CHECK_MAX(-r[0], tol * most, "step %d, contact %d pulls", k, i);
            CHECK_MAX(-s->gap[i], tol, "step %d, contact %d penetrates", k, i);
            CHECK_MAX(fmin(r[0] / most, s->gap[i]), tol, "step %d, contact %d", k, i);
            CHECK_MAX(t - limit, tol * most, "step %d, contact %d outside its cone", k, i);
            CHECK_ABS(work, -limit * tangential(d, du), tol * most * far,
                      "step %d, contact %d: dissipation", k, i);
        }
        for (int i = 0; i < d * model->mesh.nodes; i++)
            if (model->mesh.dof[i] >= 0)
                u[model->mesh.dof[i]] = s->u[i];
        memcpy(f, model->load + (size_t)k * (size_t)n, (size_t)n * sizeof *f);
        rb_sparse_apply(1.0, &model->structure.H, s->r, 1.0, f);
        rb_sparse_apply(-1.0, &model->structure.K, u, 1.0, f);
        CHECK_MAX(rb_norm_inf((size_t)n, f), tol * most, "step %d: balance", k);
    }
}

/* ---- Bar --------------------------------------------------------------------------- */

static void check_bar_state(const json_t *want, const rb_fem_model *model, const rb_fem_step *got)
{
    const double *top = got->u + 2 * (model->mesh.nodes - 1), *bottom = got->u + 2 * 160;
    double rn = 0.0, rt = 0.0, rn_max = 0.0;
    int at = 0;
    for (int i = 0; i < 161; i++) {
        rn += got->r[2 * i];
        rt += got->r[2 * i + 1];
        if (got->r[2 * i] > rn_max)
            rn_max = got->r[2 * (at = i)];
    }
    assert_int_equal(got->stick, (int)number(want, "stick"));
    assert_int_equal(got->slip, (int)number(want, "slip_left"));
    assert_int_equal(got->separated, (int)number(want, "separated"));
    for (size_t k = 0; k < 2; k++) {
        CHECK_REL(top[k], entry(want, "u_top_right_mm", k), 1e-9, "corner %zu", k);
        CHECK_ABS(bottom[k], entry(want, "u_bottom_right_mm", k), 1e-10, "bottom %zu", k);
    }
    CHECK_REL(rn, 40.0, 1e-10, "sum of normal reactions");
    CHECK_REL(rt, number(want, "sum_rt_N"), 1e-9, "sum of friction");
    CHECK_REL(rn_max, number(want, "rn_max_N"), 1e-9, "largest reaction");
    assert_int_equal(at, (int)number(want, "rn_max_node"));
}

/* The reference gives ten digits: 1e-9 of each value, or of the largest in its column. */
static void check_bar_nodes(const json_t *final, const rb_fem_step *s)
{
    static const char *const keys[] = {"rn_N", "rt_N", "ut_mm", "un_mm"};
    const json_t *nodes = json_object_get(final, "nodes");
    for (size_t c = 0; c < 4; c++) {
        double largest = 0.0;
        for (size_t k = 0; k < json_array_size(nodes); k++)
            largest = fmax(largest, fabs(entry(final, keys[c], k)));
        for (size_t k = 0; k < json_array_size(nodes); k++) {
            const int i = (int)json_integer_value(json_array_get(nodes, k));
            const double got[4] = {s->r[2 * i], s->r[2 * i + 1], s->u[2 * i], s->gap[i]};
            CHECK_ABS(got[c], entry(final, keys[c], k), 1e-9 * largest, "%s of node %d", keys[c],
                      i);
        }
    }
}

static void bar_by(const char *solver, double tol)
{
    const json_t *bar = json_object_get(reference, "bar");
    const json_t *increments = json_object_get(bar, "increments");
    OWNED(rb_fem_model) model;
    OWNED(rb_fem_history) h;
    CHECK_OK(rb_fem_model_bar(160, 16, &model, &message));
    CHECK_OK(rb_fem_run(&model, solver, tol, &h, &message));
    assert_int_equal(h.steps, 5);
    for (int k = 0; k < 5; k++)
        check_bar_state(json_array_get(increments, (size_t)k), &model, &h.step[k]);
    check_bar_nodes(json_object_get(bar, "final"), &h.step[4]);
    laws_hold(&model, &h, 1e-9);
}

/* Pivots leave 6e-13 to 1.2e-12, by the kernels of the processor. */
TEST(bar_by_lemke)
{
    bar_by("lemke", 1e-11);
}

TEST(bar_by_newton)
{
    bar_by("nsn-nm", 1e-12);
}

/* ---- Truss ------------------------------------------------------------------------- */

static void check_truss_state(const json_t *want, const rb_fem_model *model, const rb_fem_step *got)
{
    double du = 0.0, total = 0.0, least = 1e300, most = 0.0, rt = 0.0;
    for (int i = 0; i < model->structure.contacts; i++) {
        du = fmax(du, tangential(3, got->du + 3 * i));
        total = fmax(total, hypot(got->u[3 * i], got->u[3 * i + 1]));
        least = fmin(least, got->r[3 * i]);
        most = fmax(most, got->r[3 * i]);
        rt = fmax(rt, tangential(3, got->r + 3 * i));
    }
    assert_int_equal(got->stick, (int)number(want, "stick"));
    assert_int_equal(got->slip, (int)number(want, "slip"));
    assert_int_equal(got->separated, (int)number(want, "separated"));
    CHECK_ABS(du, number(want, "max_increment_mm"), 1e-8 * fmax(du, 1e-3), "increment");
    CHECK_REL(total, number(want, "max_total_mm"), 1e-8, "displacement");
    CHECK_REL(least, number(want, "rn_min_N"), 1e-8, "least reaction");
    CHECK_REL(most, number(want, "rn_max_N"), 1e-8, "largest reaction");
    CHECK_REL(rt, number(want, "rt_max_N"), 1e-8, "largest friction");
}

static int node_near(const rb_fem_model *model, double x, double y)
{
    for (int i = 0; i < model->structure.contacts; i++)
        if (hypot(model->mesh.x[3 * i] - x, model->mesh.x[3 * i + 1] - y) < 1.0)
            return i;
    fail_msg("no node at %g, %g", x, y);
    return -1;
}

static void check_truss_node(const json_t *want, const rb_fem_model *model, const rb_fem_history *h)
{
    const rb_fem_step *s = &h->step[(int)number(want, "m") - 1];
    const int i = node_near(model, number(want, "x_mm"), number(want, "y_mm"));
    const double size = fmax(hypot(s->u[3 * i], s->u[3 * i + 1]), 1e-2);
    CHECK_REL(s->r[3 * i], number(want, "rn_N"), 1e-8, "node %d, rn", i);
    for (size_t k = 0; k < 2; k++) {
        CHECK_ABS(s->u[3 * i + (int)k], entry(want, "ut_mm", k), 1e-8 * size, "node %d", i);
        CHECK_ABS(s->r[3 * i + 1 + (int)k], entry(want, "rt_N", k), 1e-8 * s->r[3 * i],
                  "node %d, rt", i);
    }
}

/* u(-x, y) = -u_x, u_y and so on, against the largest increment of the step. */
static void mirror_symmetry(const rb_fem_model *model, const rb_fem_history *h)
{
    for (int k = 0; k < h->steps; k++) {
        const double *du = h->step[k].du;
        double largest = 1e-6;
        for (int i = 0; i < model->structure.contacts; i++)
            largest = fmax(largest, tangential(3, du + 3 * i));
        for (int i = 0; i < model->structure.contacts; i++) {
            const double *x = model->mesh.x + 3 * i;
            const double *a = du + 3 * node_near(model, -x[0], x[1]);
            const double *b = du + 3 * node_near(model, x[0], -x[1]);
            CHECK_ABS(a[1], -du[3 * i + 1], 1e-9 * largest, "step %d, node %d", k, i);
            CHECK_ABS(a[2], du[3 * i + 2], 1e-9 * largest, "step %d, node %d", k, i);
            CHECK_ABS(b[1], du[3 * i + 1], 1e-9 * largest, "step %d, node %d", k, i);
            CHECK_ABS(b[2], -du[3 * i + 2], 1e-9 * largest, "step %d, node %d", k, i);
        }
    }
}

static void truss_by(const char *solver, rb_fem_layout layout, int n)
{
    static const char *const names[] = {"upper_inside", "upper_overhanging"};
    const json_t *truss = json_object_get(reference, "truss");
    const json_t *set = json_object_get(json_object_get(truss, "layouts"), names[layout]);
    const json_t *increments = json_object_get(set, n == 12 ? "n12_increments" : "n4_increments");
    const json_t *nodes = json_object_get(set, n == 12 ? "n12_nodes" : "n4_nodes");
    OWNED(rb_fem_model) model;
    OWNED(rb_fem_history) h;
    CHECK_OK(rb_fem_model_truss(layout, n, &model, &message));
    CHECK_OK(rb_fem_run(&model, solver, 1e-12, &h, &message));
    assert_int_equal(h.steps, 6);
    for (int k = 0; k < 6; k++)
        check_truss_state(json_array_get(increments, (size_t)k), &model, &h.step[k]);
    for (size_t k = 0; k < json_array_size(nodes); k++)
        check_truss_node(json_array_get(nodes, k), &model, &h);
    mirror_symmetry(&model, &h);
    laws_hold(&model, &h, 1e-9);
}

TEST(small_trusses_by_every_newton)
{
    static const char *const solvers[] = {"nsn-ac", "soclcp-smoothing"};
    for (int k = 0; k < 4; k++)
        truss_by(solvers[k / 2], (rb_fem_layout)(k % 2), 4);
}

TEST(trusses_by_newton_and_by_smoothing)
{
    static const char *const solvers[] = {"nsn-ac", "soclcp-smoothing"};
    for (int k = 0; k < 4; k++)
        if (is_in_turn(k, 4))
            truss_by(solvers[k / 2], (rb_fem_layout)(k % 2), 12);
}

/* The full system, without condensation, gives the same first increment. */
TEST(condensation_changes_nothing)
{
    OWNED(rb_fem_model) model;
    OWNED(rb_fem_history) h;
    OWNED(rb_fem_state) start;
    rb_fem_units units;
    OWNED(rb_friction_problem) problem;
    rb_friction_info info;
    CHECK_OK(rb_fem_model_truss(RB_FEM_UPPER_INSIDE, 4, &model, &message));
    CHECK_OK(rb_fem_run(&model, "nsn-ac", 1e-12, &h, &message));
    CHECK_OK(rb_fem_state_alloc(&model.structure, &start));
    CHECK_OK(rb_fem_problem(&model.structure, model.load, &start, &problem, &units));
    const int m = 3 * model.structure.contacts;
    SCRATCH double *r = rb_alloc((size_t)m, 1), *u = rb_alloc((size_t)m, 1);
    rb_friction_options options = rb_friction_defaults();
    options.tol = 1e-12;
    CHECK_OK(rb_friction_solve("nsn-ac", &problem, &options, &(rb_friction_solution){r, u, NULL},
                               &info));
    for (int k = 0; k < m; k++)
        CHECK_ABS(units.force * r[k], h.step[0].r[k], 1e-4, "reaction %d of 3e5 N", k);
}

TEST(an_unknown_solver_is_refused)
{
    OWNED(rb_fem_model) model;
    OWNED(rb_fem_history) h;
    CHECK_OK(rb_fem_model_bar(4, 2, &model, &message));
    CHECK_SAYS(rb_fem_run(&model, "nosuch", 1e-8, &h, &message), RB_EINVAL, "nosuch");
}

/* The whole stiffness of a truss is singular, so that a solver of the condensed problem
 * does not begin: there is no increment whose numbers anybody could take for a result. */
TEST(an_increment_that_has_not_begun_is_none)
{
    OWNED(rb_fem_model) model;
    OWNED(rb_fem_history) h;
    CHECK_OK(rb_fem_model_truss(RB_FEM_UPPER_INSIDE, 2, &model, &message));
    CHECK_SAYS(rb_fem_run(&model, "extragradient", 1e-8, &h, &message), RB_SINGULAR,
               "K is singular to rounding");
    assert_int_equal(h.steps, 0);
}

TEST(memory_runs_out)
{
    OWNED(rb_fem_model) model;
    CHECK_OK(rb_fem_model_bar(4, 2, &model, NULL));
    for (int k = 0, refused = 1; refused; k++) {
        OWNED(rb_fem_history) h;
        refused = REFUSED_FROM(k, rb_fem_run(&model, "nsn-nm", 1e-10, &h, NULL));
    }
}

RUN_TESTS(load_reference, drop_reference)
