/* Closed-form integrals over one element (B2, B3) and the matrices made of them (B1). */
#include "bem/column.h"
#include "bem_shapes.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <string.h>

static double uniform(double low, double high)
{
    return low + (high - low) * (rand() / (double)RAND_MAX);
}

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
    const double R = hypot(r[0], r[1]), g[2] = {r[0] / R, r[1] / R},
                 n[2] = {dy / h, -dx / h};
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
    const double foot =
        ((q->px - q->x0) * dx + (q->py - q->y0) * dy) / (dx * dx + dy * dy);
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
    const double h = pow(10.0, uniform(-3, 0)), angle = uniform(0, 2 * M_PI);
    integrand_data q = {.x1 = h * cos(angle), .y1 = h * sin(angle)};
    q.material = (rb_bem_material){pow(10.0, uniform(-2, 5)), uniform(-0.9, 0.5)};
    return q;
}

/* Points at 0.003 to 300 element lengths: half of them nearer than the far series. */
TEST(closed_form_equals_quadrature)
{
    gsl_set_error_handler_off();
    srand(1);
    for (int k = 0; k < 300; k++) {
        integrand_data q = random_element();
        const double h = hypot(q.x1 - q.x0, q.y1 - q.y0), angle = uniform(0, 2 * M_PI),
                     r = h * pow(10.0, uniform(-2.5, 2.5)), s = uniform(-0.5, 1.5);
        q.px = q.x0 + s * (q.x1 - q.x0) + r * cos(angle);
        q.py = q.y0 + s * (q.y1 - q.y0) + r * sin(angle);
        const rb_bem_blocks got = rb_bem_element_integrals(
            (rb_bem_segment){q.x0, q.y0, q.x1, q.y1}, q.px, q.py, 0, q.material);
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
        const rb_bem_blocks got = rb_bem_element_integrals(
            (rb_bem_segment){q.x0, q.y0, q.x1, q.y1}, q.px, q.py, 1, q.material);
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
            /* H11 = D [2 (1-nu) Th - dQ], H22 = D [2 (1-nu) Th + dQ], dQ = 2d/(1 + d^2)
             */
            const double D = -1.0 / (4.0 * M_PI * 0.7),
                         Th = side * (M_PI - 2.0 * atan(fabs(d)));
            const double dQ = 2.0 * d / (1.0 + d * d);
            CHECK_REL(H[0], D * (1.4 * Th - dQ), 3e-15, "H11 at %g", d);
            CHECK_REL(H[3], D * (1.4 * Th + dQ), 3e-15, "H22 at %g", d);
        }
}

/* ---- Columns: every instruction set, every range of distances --------------------- */

enum { n_seen = 1003, rounds = 40 };
typedef double columns_of_H_and_G[4][2 * n_seen]; /* of odd alignments */

/* Where the points of one column lie, seen from the element. */
enum { ANYWHERE, COLLINEAR, ABOVE, places };
static const char *const place_name[places] = {"anywhere", "collinear", "above"};

static rb_element element_in_general_position(void)
{
    const double h = pow(10.0, uniform(-3, 0)), angle = uniform(0, 2 * M_PI),
                 x = uniform(-1, 1), y = uniform(-1, 1);
    return rb_element_make(x, y, x + h * cos(angle), y + h * sin(angle), 1.0);
}

/* At 0.1 to 10^4 half-lengths, not nearer to an end; point 77 of ANYWHERE: the midpoint
 */
static void put_points(const rb_element *e, int place, double *x, double *y)
{
    for (int i = 0; i < n_seen; i++) {
        const double away = e->a * pow(10.0, uniform(-1, 4)),
                     angle = uniform(0, 2 * M_PI);
        const double along = place == ANYWHERE    ? away * cos(angle)
                             : place == COLLINEAR ? e->a + away
                                                  : 0.0;
        const double above = place == ANYWHERE    ? away * sin(angle)
                             : place == COLLINEAR ? 0.0
                                                  : away;
        x[i] = e->mx + along * e->tx - above * e->ty;
        y[i] = e->my + along * e->ty + above * e->tx;
    }
    if (place == ANYWHERE) {
        x[77] = e->mx;
        y[77] = e->my;
    }
}

typedef struct {
    rb_element e;
    rb_bem_material material;
    int self;
    double x[n_seen], y[n_seen];
} column_case;

static void make_column_case(int place, column_case *c)
{
    c->e = element_in_general_position();
    c->material = (rb_bem_material){pow(10.0, uniform(-2, 5)), uniform(0.0, 0.4)};
    c->self = place == ANYWHERE ? 77 : -1;
    put_points(&c->e, place, c->x, c->y);
}

static void fill_columns(const column_case *c, const rb_column_variant *variant,
                         int with_G, columns_of_H_and_G to)
{
    const rb_constants k = rb_constants_make(&c->e, c->material);
    rb_points points;
    CHECK_STATUS(rb_points_make(n_seen, c->x, c->y, &points), RB_OK);
    variant->fill(
        &k, &c->e, c->self, &points,
        (double *const[4]){to[0], to[1], with_G ? to[2] : NULL, with_G ? to[3] : NULL});
    rb_points_free(&points);
}

static void put_blocks(const double H[4], const double G[4], int i, columns_of_H_and_G to)
{
    for (int c = 0; c < 2; c++)
        for (int r = 0; r < 2; r++) {
            to[c][2 * i + r] = H[2 * c + r];
            to[2 + c][2 * i + r] = G[2 * c + r];
        }
}

/* The same points one by one, as single points are integrated. */
static void fill_scalar(const column_case *c, columns_of_H_and_G to)
{
    const rb_constants k = rb_constants_make(&c->e, c->material);
    for (int i = 0; i < n_seen; i++) {
        rb_influence f;
        if (i == c->self) {
            rb_integrate_self(&k, c->e.a, &f);
        } else {
            const rb_view_angles v = rb_view_angles_of(&c->e, c->x[i], c->y[i]);
            rb_integrate_H(&k, &v, &f);
            rb_integrate_G(&k, c->e.a, &v, &f);
        }
        put_blocks((double[]){f.Hxx, f.Hyx, f.Hxy, f.Hyy},
                   (double[]){f.Gxx, f.Gxy, f.Gxy, f.Gyy}, i, to);
    }
}

/* (B3) as it stands in kernels.h, in the element's axes, from long double functions. */
static void integrate_long(const column_case *c, int i, double H[4], double G[4])
{
    const long double pi = acosl(-1.0L), t = hypotl(c->e.tx, c->e.ty), tx = c->e.tx / t,
                      ty = c->e.ty / t, a = c->e.a, nu = c->material.poisson,
                      C = 1 / (8 * pi * c->material.shear * (1 - nu)),
                      D = -1 / (4 * pi * (1 - nu)), kap = 3 - 4 * nu;
    const long double dx = (long double)c->e.mx - c->x[i],
                      dy = (long double)c->e.my - c->y[i], X = dx * tx + dy * ty,
                      d = dx * ty - dy * tx, r1 = hypotl(X - a, d), r2 = hypotl(X + a, d);
    const long double Th = i == c->self ? 0 : atan2l(2 * a * d, X * X + d * d - a * a),
                      Lam = 0.5L * log1pl(4 * a * X / (r1 * r1)),
                      L = X * Lam + a * logl(r1 * r2) - 2 * a + d * Th,
                      q = 2 * a * d / (r1 * r1 * r2 * r2);
    const long double dev = q * (X * X - d * d - a * a), shear = q * 2 * X * d,
                      g = a - d * Th, g12 = d * Lam, cc = tx * tx - ty * ty,
                      ss = 2 * tx * ty, mean = 2 * (1 - nu) * Th,
                      skew = (1 - 2 * nu) * Lam;
    const double own = i == c->self ? 0.5 : 0.0;
    H[0] = own + (double)(D * (mean + cc * dev + ss * shear));
    H[3] = own + (double)(D * (mean - cc * dev - ss * shear));
    H[1] = (double)(D * (ss * dev - cc * shear - skew));
    H[2] = (double)(D * (ss * dev - cc * shear + skew));
    G[0] = (double)(C * (a - kap * L + cc * g + ss * g12));
    G[3] = (double)(C * (a - kap * L - cc * g - ss * g12));
    G[1] = G[2] = (double)(C * (ss * g - cc * g12));
}

static void fill_long(const column_case *c, columns_of_H_and_G to)
{
    for (int i = 0; i < n_seen; i++) {
        double H[4], G[4];
        integrate_long(c, i, H, G);
        put_blocks(H, G, i, to);
    }
}

/* Of blocks: largest difference of entries over the largest entry. */
typedef struct {
    double largest, squares;
    int n;
} differences;

static void compare(columns_of_H_and_G got, columns_of_H_and_G want, int matrix,
                    differences *to)
{
    for (int i = 0; i < n_seen; i++) {
        double size = 0.0, error = 0.0;
        for (int k = 0; k < 4; k++) {
            const double is = got[2 * matrix + k / 2][2 * i + k % 2],
                         should = want[2 * matrix + k / 2][2 * i + k % 2];
            size = fmax(size, fabs(should));
            error = isnan(is) ? HUGE_VAL : fmax(error, fabs(is - should));
        }
        to->largest = fmax(to->largest, error / size);
        to->squares += error / size * (error / size);
        to->n++;
    }
}

/* In the mean below one rounding.  One block may have more: where one of its parts
 * changes sign it is small against what it was made of. */
static void check_differences(const differences *of, double mean, double largest,
                              const char *who, const char *whom, int place, char matrix)
{
    CHECK_MAX(sqrt(of->squares / of->n), mean, "%c, %s against %s, %s, root mean square",
              matrix, who, whom, place_name[place]);
    CHECK_MAX(of->largest, largest, "%c, %s against %s, %s", matrix, who, whom,
              place_name[place]);
}

TEST(every_instruction_set_gives_the_same)
{
    static columns_of_H_and_G single, exact, got;
    static column_case c;
    const rb_column_variant *variant;
    srand(3);
    for (int place = 0; place < places; place++)
        for (int v = 0; (variant = rb_column_variant_get(v)); v++) {
            differences from_single[2] = {{0}}, from_exact[2] = {{0}};
            for (int round = 0; round < rounds; round++) {
                make_column_case(place, &c);
                fill_scalar(&c, single);
                fill_long(&c, exact);
                fill_columns(&c, variant, 1, got);
                for (int m = 0; m < 2; m++) {
                    compare(got, single, m, &from_single[m]);
                    compare(got, exact, m, &from_exact[m]);
                }
            }
            for (int m = 0; m < 2; m++) {
                check_differences(&from_single[m], 2e-16, 5e-15, variant->name,
                                  "single points", place, "HG"[m]);
                check_differences(&from_exact[m], 3e-16, 1e-14, variant->name,
                                  "long double", place, "HG"[m]);
            }
        }
    assert_null(rb_column_variant_get(-1));
    assert_string_equal(rb_bem_vector_name(), rb_column_variant_get(0)->name);
}

TEST(the_series_meet_at_the_ends_of_their_ranges)
{
    const rb_far_range *const range[] = {&rb_far, &rb_farther, &rb_farthest};
    const rb_element e = rb_element_make(-1.0, 0.0, 1.0, 0.0, 1.0);
    for (int k = 0; k < 3; k++)
        for (int angle = 0; angle < 90; angle++) {
            const double r = range[k]->reach, c = r * cos(angle * M_PI / 45),
                         s = r * sin(angle * M_PI / 45);
            rb_view_angles v = rb_see(&e, -c, s);
            rb_turn_far(1.0, range[k]->terms, 2.0 / v.rho, &v);
            const long double Lam = 0.5L * log1pl(4.0L * v.X /
                                                  ((v.X - 1.0L) * (v.X - 1.0L) +
                                                   (long double)v.d * v.d)),
                              Th = atan2l(2.0L * v.d, (long double)v.X * v.X +
                                                          (long double)v.d * v.d - 1.0L);
            CHECK_ABS(v.Lam, (double)Lam, 1e-15 / r, "Lam, %d terms", range[k]->terms);
            CHECK_ABS(v.Th, (double)Th, 1e-15 / r, "Th, %d terms", range[k]->terms);
        }
}

TEST(H_alone_is_H_to_rounding)
{
    static columns_of_H_and_G both, alone;
    static column_case c;
    srand(5);
    for (int place = 0; place < places; place++) {
        differences of = {0};
        make_column_case(place, &c);
        fill_columns(&c, rb_column_variant_get(0), 1, both);
        fill_columns(&c, rb_column_variant_get(0), 0, alone);
        compare(alone, both, 0, &of);
        CHECK_MAX(of.largest, 4.5e-16, "%s", place_name[place]);
    }
}

/* ---- The matrices ------------------------------------------------------------------ */

/* max |sum_j H_ij u_j| over max |u| */
static double rows_times(const rb_bem_mesh *mesh, const double *u)
{
    const int dofs = 2 * mesh->n, ld = dofs + 3;
    double *H = rb_alloc((size_t)ld, (size_t)dofs), worst = 0.0, largest = 0.0;
    const rb_bem_material m = {80.0, 0.3};
    CHECK_STATUS(rb_bem_assemble(mesh, m, H, NULL, ld, NULL), RB_OK);
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
    double *u = rb_alloc(2 * (size_t)mesh->n, 1);
    for (int j = 0; j < mesh->n; j++)
        u[2 * j + direction] = 1.0;
    const double error = rows_times(mesh, u);
    free(u);
    return error;
}

static double rotation_error(const rb_bem_mesh *mesh)
{
    double *u = rb_alloc(2 * (size_t)mesh->n, 1);
    for (int j = 0; j < mesh->n; j++) {
        u[2 * j] = -midpoint_y(mesh, j);
        u[2 * j + 1] = midpoint_x(mesh, j);
    }
    const double error = rows_times(mesh, u);
    free(u);
    return error;
}

/* A star-shaped polygon with sides from 0.002 to 1. */
static rb_bem_mesh irregular(int n)
{
    rb_bem_mesh mesh;
    double *angle = rb_alloc((size_t)n + 1, 1), *r = rb_alloc((size_t)n + 1, 1);
    srand(4);
    for (int k = 0; k < n; k++) {
        angle[k + 1] = angle[k] + pow(10.0, uniform(-2, 0));
        r[k] = uniform(0.5, 2.0);
    }
    r[n] = r[0];
    CHECK_STATUS(rb_bem_mesh_alloc(n, &mesh), RB_OK);
    for (int k = 0; k < n; k++) {
        const double a = 2 * M_PI * angle[k] / angle[n],
                     b = k + 1 < n ? 2 * M_PI * angle[k + 1] / angle[n] : 0.0;
        mesh.x0[k] = r[k] * cos(a);
        mesh.y0[k] = r[k] * sin(a);
        mesh.x1[k] = r[k + 1] * cos(b);
        mesh.y1[k] = r[k + 1] * sin(b);
    }
    free(angle);
    free(r);
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
        rb_bem_mesh mesh = circle(100 << k, 1.0);
        error[k] = rotation_error(&mesh);
        rb_bem_mesh_free(&mesh);
    }
    CHECK_MAX(error[0], 2.5e-3, "100 elements");
    CHECK_MAX(error[2], 5.5e-4, "400 elements");
    for (int k = 0; k < 3; k++)
        CHECK_ABS(order(error[k], error[k + 1]), 1.0, 0.15, "order at %d elements",
                  50 << k);
}

/* Measured in the body's own size, the same problem in another unit has the same H, and G
 * scaled by the unit. */
TEST(the_unit_of_length_does_not_matter)
{
    enum { n = 12, dofs = 2 * n };
    static double H[2][dofs * dofs], G[2][dofs * dofs];
    const rb_bem_material m = {80.0, 0.3};
    for (int k = 0; k < 2; k++) {
        rb_bem_mesh mesh = circle(n, k ? 1024.0 : 1.0);
        CHECK_STATUS(rb_bem_assemble(&mesh, m, H[k], G[k], dofs, NULL), RB_OK);
        rb_bem_mesh_free(&mesh);
    }
    for (int i = 0; i < dofs * dofs; i++) {
        CHECK_ABS(H[1][i], H[0][i], 1e-15, "H %d", i);
        CHECK_ABS(G[1][i] / 1024.0, G[0][i], 1e-15 * fabs(G[0][0]), "G %d", i);
    }
}

RUN_TESTS(NULL, NULL)
