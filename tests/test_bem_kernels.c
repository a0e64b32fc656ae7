/* Closed-form integrals over one element (B2, B3) and the matrices made of them (B1). */
#include "bem_shapes.h"
#include "numbers.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

/* ---- Against quadrature ------------------------------------------------------------ */

typedef struct {
    double x0, y0, x1, y1, px, py;
    rb_bem_material material;
    int kernel, i, j; /* 0: T, 1: U */
} integrand_data;

/* (B2) at s in [0, 1] along the element, times its length */
static double integrand(double s, void *data)
{
    const integrand_data *q = data;
    const double dx = q->x1 - q->x0, dy = q->y1 - q->y0, h = hypot(dx, dy);
    const double r[2] = {q->x0 + s * dx - q->px, q->y0 + s * dy - q->py};
    const double R = hypot(r[0], r[1]), g[2] = {r[0] / R, r[1] / R}, n[2] = {dy / h, -dx / h};
    const double nu = q->material.poisson, rn = g[0] * n[0] + g[1] * n[1];
    const int i = q->i, j = q->j;
    if (q->kernel == 1)
        return h * ((i == j) * -(3.0 - 4.0 * nu) * log(R) + g[i] * g[j]) /
               (8.0 * M_PI * q->material.shear * (1.0 - nu));
    return -h *
           (rn * ((1.0 - 2.0 * nu) * (i == j) + 2.0 * g[i] * g[j]) -
            (1.0 - 2.0 * nu) * (g[i] * n[j] - g[j] * n[i])) /
           (4.0 * M_PI * (1.0 - nu) * R);
}

/* Split at the foot of the perpendicular from p, where the integrand peaks. */
static double quadrature(integrand_data *q)
{
    static gsl_integration_workspace *ws;
    if (!ws)
        ws = gsl_integration_workspace_alloc(1000);
    const double dx = q->x1 - q->x0, dy = q->y1 - q->y0;
    const double foot = ((q->px - q->x0) * dx + (q->py - q->y0) * dy) / (dx * dx + dy * dy);
    const double cut = fmin(fmax(foot, 0.0), 1.0);
    gsl_function f = {integrand, q};
    double left = 0.0, right = 0.0, error;
    if (cut > 0.0)
        gsl_integration_qags(&f, 0.0, cut, 0.0, 3e-14, 1000, ws, &left, &error);
    if (cut < 1.0)
        gsl_integration_qags(&f, cut, 1.0, 0.0, 3e-14, 1000, ws, &right, &error);
    return left + right;
}

/* Largest difference over largest entry of the block of one kernel. */
static double block_error(integrand_data *q, const double *block, int self)
{
    double error = 0.0, largest = 0.0;
    for (q->i = 0; q->i < 2; q->i++)
        for (q->j = 0; q->j < 2; q->j++) {
            const double got = block[q->i + 2 * q->j];
            const double free_term = self && q->kernel == 0 ? 0.5 * (q->i == q->j) : 0.0;
            const double want = free_term ? free_term : quadrature(q);
            error = fmax(error, fabs(got - want));
            largest = fmax(largest, fabs(want));
        }
    return error / largest;
}

/* From the origin, so that no digit of the distance to a close point is lost. */
static integrand_data random_element(void)
{
    const double h = pow(10.0, between(-3, 0)), angle = between(0, 2 * M_PI);
    integrand_data q = {.x1 = h * cos(angle), .y1 = h * sin(angle)};
    q.material = (rb_bem_material){pow(10.0, between(-2, 5)), between(-0.9, 0.5)};
    return q;
}

/* Points at 0.003 to 300 element lengths: half of them nearer than the far series. */
TEST(closed_form_equals_quadrature)
{
    gsl_set_error_handler_off();
    srand(1);
    for (int k = 0; k < 300; k++) {
        integrand_data q = random_element();
        const double h = hypot(q.x1 - q.x0, q.y1 - q.y0), angle = between(0, 2 * M_PI),
                     r = h * pow(10.0, between(-2.5, 2.5)), s = between(-0.5, 1.5);
        q.px = q.x0 + s * (q.x1 - q.x0) + r * cos(angle);
        q.py = q.y0 + s * (q.y1 - q.y0) + r * sin(angle);
        const rb_bem_blocks got = rb_bem_element_integrals((rb_bem_segment){q.x0, q.y0, q.x1, q.y1},
                                                           q.px, q.py, 0, q.material);
        q.kernel = 0;
        CHECK_MAX(block_error(&q, got.H, 0), 1e-12, "H, pair %d, r/h = %g", k, r / h);
        q.kernel = 1;
        CHECK_MAX(block_error(&q, got.G, 0), 1e-12, "G, pair %d, r/h = %g", k, r / h);
    }
}

/* The principal value of T vanishes: its even part by symmetry, r,n by r.n = 0. */
TEST(self_terms_equal_quadrature)
{
    gsl_set_error_handler_off();
    srand(2);
    for (int k = 0; k < 50; k++) {
        integrand_data q = random_element();
        q.px = 0.5 * (q.x0 + q.x1);
        q.py = 0.5 * (q.y0 + q.y1);
        q.kernel = 1;
        const rb_bem_blocks got = rb_bem_element_integrals((rb_bem_segment){q.x0, q.y0, q.x1, q.y1},
                                                           q.px, q.py, 1, q.material);
        const double *H = got.H;
        CHECK_MAX(block_error(&q, got.G, 1), 1e-12, "G, element %d", k);
        CHECK_ABS(fabs(H[0] - 0.5) + fabs(H[3] - 0.5) + fabs(H[1]) + fabs(H[2]), 0.0, 0.0,
                  "H, element %d", k);
    }
}

/* p approaching an element from inside sees it under the angle pi: T integrates to -1/2
 * of the identity, and to +1/2 from outside; to rounding at any distance. */
TEST(nearly_singular_points_are_right)
{
    for (int k = 1; k < 15; k++)
        for (int side = -1; side <= 1; side += 2) {
            const double d = side * pow(10.0, -k);
            const rb_bem_material m = {1.0, 0.3};
            const rb_bem_segment e = {-1.0, 0.0, 1.0, 0.0};
            const rb_bem_blocks got = rb_bem_element_integrals(e, 0.0, d, 0, m);
            const double *H = got.H;
            /* H11 = D [2 (1-nu) Th - dQ], H22 = D [2 (1-nu) Th + dQ], dQ = 2d/(1 + d^2) */
            const double D = -1.0 / (4.0 * M_PI * 0.7), Th = side * (M_PI - 2.0 * atan(fabs(d)));
            const double dQ = 2.0 * d / (1.0 + d * d);
            CHECK_REL(H[0], D * (1.4 * Th - dQ), 3e-15, "H11 at %g", d);
            CHECK_REL(H[3], D * (1.4 * Th + dQ), 3e-15, "H22 at %g", d);
        }
}

/* ---- The matrices ------------------------------------------------------------------ */

/* max |sum_j H_ij u_j| over max |u| */
static double rows_times(const rb_bem_mesh *mesh, const double *u)
{
    const int dofs = 2 * mesh->n, ld = dofs + 3;
    double *H = rb_alloc((size_t)ld, (size_t)dofs), worst = 0.0, largest = 0.0;
    const rb_bem_material m = {80.0, 0.3};
    CHECK_OK(rb_bem_assemble(mesh, m, H, NULL, ld, NULL));
    for (int i = 0; i < dofs; i++) {
        double sum = 0.0;
        for (int j = 0; j < dofs; j++)
            sum += H[i + (size_t)j * (size_t)ld] * u[j];
        worst = fmax(worst, fabs(sum));
        largest = fmax(largest, fabs(u[i]));
    }
    free(H);
    return worst / largest;
}

static double translation_error(const rb_bem_mesh *mesh, int direction)
{
    SCRATCH double *u = rb_alloc(2 * (size_t)mesh->n, 1);
    for (int j = 0; j < mesh->n; j++)
        u[2 * j + direction] = 1.0;
    return rows_times(mesh, u);
}

static double rotation_error(const rb_bem_mesh *mesh)
{
    SCRATCH double *u = rb_alloc(2 * (size_t)mesh->n, 1);
    for (int j = 0; j < mesh->n; j++) {
        u[2 * j] = -midpoint_y(mesh, j);
        u[2 * j + 1] = midpoint_x(mesh, j);
    }
    return rows_times(mesh, u);
}

/* A star-shaped polygon with sides from 0.002 to 1. */
static rb_bem_mesh irregular(int n)
{
    rb_bem_mesh mesh;
    SCRATCH double *angle = rb_alloc((size_t)n + 1, 1), *r = rb_alloc((size_t)n + 1, 1);
    srand(4);
    for (int k = 0; k < n; k++) {
        angle[k + 1] = angle[k] + pow(10.0, between(-2, 0));
        r[k] = between(0.5, 2.0);
    }
    r[n] = r[0];
    CHECK_OK(rb_bem_mesh_alloc(n, &mesh));
    for (int k = 0; k < n; k++) {
        const double a = 2 * M_PI * angle[k] / angle[n],
                     b = k + 1 < n ? 2 * M_PI * angle[k + 1] / angle[n] : 0.0;
        mesh.x0[k] = r[k] * cos(a);
        mesh.y0[k] = r[k] * sin(a);
        mesh.x1[k] = r[k + 1] * cos(b);
        mesh.y1[k] = r[k + 1] * sin(b);
    }
    return mesh;
}

TEST(translations_are_annihilated)
{
    rb_bem_mesh shapes[] = {circle(200, 3.0), ring(90, 2.0, 0.7), irregular(60)};
    for (int k = 0; k < 3; k++) {
        for (int direction = 0; direction < 2; direction++)
            CHECK_MAX(translation_error(&shapes[k], direction), 1e-12, "shape %d, %c", k,
                      "xy"[direction]);
        rb_bem_mesh_free(&shapes[k]);
    }
}

/* A rotation is not constant on an element: first order (2.3e-3 on 100 elements). */
TEST(rotations_are_annihilated_to_first_order)
{
    double error[4];
    for (int k = 0; k < 4; k++) {
        OWNED(rb_bem_mesh) mesh = circle(100 << k, 1.0);
        error[k] = rotation_error(&mesh);
    }
    CHECK_MAX(error[0], 2.5e-3, "100 elements");
    CHECK_MAX(error[2], 5.5e-4, "400 elements");
    for (int k = 0; k < 3; k++)
        CHECK_ABS(order(error[k], error[k + 1]), 1.0, 0.15, "order at %d elements", 50 << k);
}

/* Measured in the body's own size, the same problem in another unit has the same H, and G
 * scaled by the unit. */
TEST(the_unit_of_length_does_not_matter)
{
    enum { n = 12, dofs = 2 * n };
    static double H[2][dofs * dofs], G[2][dofs * dofs];
    const rb_bem_material m = {80.0, 0.3};
    for (int k = 0; k < 2; k++) {
        OWNED(rb_bem_mesh) mesh = circle(n, k ? 1024.0 : 1.0);
        CHECK_OK(rb_bem_assemble(&mesh, m, H[k], G[k], dofs, NULL));
    }
    for (int i = 0; i < dofs * dofs; i++) {
        CHECK_ABS(H[1][i], H[0][i], 1e-15, "H %d", i);
        CHECK_ABS(G[1][i] / 1024.0, G[0][i], 1e-15 * fabs(G[0][0]), "G %d", i);
    }
}

RUN_TESTS(NULL, NULL)
