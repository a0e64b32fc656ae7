/* What the friction solvers are made of, each from its definition: cones and norms, the
 * functions whose roots are solutions and their derivatives, the units of a contact. */
#include "check.h"
#include "lcp/friction/internal.h"
#include "numbers.h"

static unsigned long long seed = 21;

static double uniform(void)
{
    return uniform_of(&seed);
}

static double tangential(int d, const double *x)
{
    return d == 2 ? fabs(x[1]) : hypot(x[1], x[2]);
}

static double dot(int d, const double *x, const double *y)
{
    double sum = 0.0;
    for (int a = 0; a < d; a++)
        sum += x[a] * y[a];
    return sum;
}

/* p in K, p - z in K* = {mu ||x_T|| <= x_N}, and p'(p - z) = 0: the three say that p is
 * nearest to z. */
TEST(projections_are_nearest_points)
{
    static const double mus[] = {0.0, 0.3, 2.0};
    for (int k = 0; k < 600; k++) {
        const int d = 2 + k % 2;
        const double mu = mus[k % 3];
        double z[3], p[3], gap[3], D[9], up[3], down[3];
        for (int a = 0; a < d; a++)
            z[a] = uniform();
        if (k % 50 == 0)
            z[1] = z[d - 1] = 0.0;
        rb_friction_project(d, mu, z, p);
        for (int a = 0; a < d; a++)
            gap[a] = p[a] - z[a];
        CHECK_MAX(tangential(d, p), mu * p[0] + 1e-15, "in K");
        CHECK_MAX(mu * tangential(d, gap), gap[0] + 1e-15, "gap in K*");
        CHECK_ABS(dot(d, p, gap), 0.0, 1e-15, "orthogonal");
        rb_friction_project_derivative(d, mu, z, D);
        for (int b = 0; b < d && k % 50; b++) {
            const double h = 1e-6;
            double at[3] = {z[0], z[1], d == 3 ? z[2] : 0.0};
            at[b] += h;
            rb_friction_project(d, mu, at, up);
            at[b] -= 2.0 * h;
            rb_friction_project(d, mu, at, down);
            for (int a = 0; a < d; a++)
                CHECK_ABS(D[a + b * d], (up[a] - down[a]) / (2.0 * h), 1e-4, "mu = %g, D(%d, %d)",
                          mu, a, b);
        }
        memcpy(gap, z, sizeof gap);
        rb_friction_project(d, mu, gap, gap); /* in place */
        assert_memory_equal(gap, p, (size_t)d * sizeof *p);
    }
}

TEST(norms_hold_over_all_sizes)
{
    for (size_t n = 1; n < 12; n++) {
        double x[12], y[12], squares = 0.0, product = 0.0, apart = 0.0;
        for (size_t k = 0; k < n; k++) {
            x[k] = uniform();
            y[k] = uniform();
            squares += x[k] * x[k];
            product += x[k] * y[k];
            apart += (x[k] - y[k]) * (x[k] - y[k]);
        }
        CHECK_REL(rb_friction_norm(n, x), sqrt(squares), 1e-15, "norm of %zu", n);
        CHECK_ABS(rb_dot(n, x, y), product, 1e-15, "product of %zu", n);
        CHECK_REL(rb_distance(n, x, y), sqrt(apart), 1e-15, "distance of %zu", n);
        for (int large = 0; large < 2; large++) {
            const double unit = large ? 1e200 : 1e-200;
            for (size_t k = 0; k < n; k++)
                y[k] = unit * x[k];
            CHECK_REL(rb_friction_norm(n, y), unit * sqrt(squares), 1e-14, "times %g", unit);
        }
    }
    const double wide[] = {3e200, 0.0, -4e200}, thin[] = {0.0, 3e-200, 4e-200};
    const double none[] = {0.0, 0.0}, endless[] = {1.0, INFINITY}, nan[] = {1.0, NAN};
    CHECK_REL(rb_friction_norm(3, wide), 5e200, 1e-15, "squares overflow");
    CHECK_REL(rb_friction_tangential(3, thin), 5e-200, 1e-15, "squares underflow");
    CHECK_REL(rb_friction_tangential(2, thin), 3e-200, 0.0, "in the plane");
    CHECK_ABS(rb_friction_norm(2, none), 0.0, 0.0, "zero");
    assert_true(rb_friction_norm(2, endless) == INFINITY);
    assert_true(isnan(rb_friction_norm(2, nan)));
}

/* ---- Functions whose roots are solutions ------------------------------------------- */

static const struct {
    const char *name;
    rb_friction_function *f;
} functions[] = {{"Alart-Curnier", rb_friction_alart_curnier},
                 {"Jean-Moreau", rb_friction_jean_moreau},
                 {"natural map", rb_friction_natural_map},
                 {"Fischer-Burmeister", rb_friction_fischer_burmeister}};
enum { FUNCTIONS = sizeof functions / sizeof *functions };

static double evaluate(int k, const rb_friction_cone *cone, const double *r, const double *u,
                       double *F, double *A, double *B)
{
    double room_a[9], room_b[9], size = 0.0;
    functions[k].f(cone, r, u, &(rb_friction_linearised){F, A ? A : room_a, B ? B : room_b});
    for (int a = 0; a < cone->d; a++)
        size = fmax(size, fabs(F[a]));
    return size;
}

/* A contact that is open, sticks or slips, by Coulomb's law. */
static void obey_coulomb(const rb_friction_cone *cone, int how, double *r, double *u)
{
    const int d = cone->d;
    for (int a = 0; a < d; a++)
        r[a] = u[a] = 0.0;
    if (how == 0) {
        for (int a = 0; a < d; a++)
            u[a] = a ? uniform() : 1.5 + uniform();
        return;
    }
    r[0] = 1.5 + uniform();
    double t[3] = {0.0, uniform(), d == 3 ? uniform() : 0.0};
    for (int a = 1; a < d; a++) {
        r[a] = cone->mu * r[0] * t[a] / tangential(d, t) * (how == 1 ? 0.6 : 1.0);
        u[a] = how == 1 ? 0.0 : -3.0 * t[a];
    }
}

TEST(solutions_are_the_roots)
{
    for (int trial = 0; trial < 300; trial++) {
        const rb_friction_cone cone = {2 + trial % 2, trial % 5 ? 0.6 : 0.0, 1.5 + uniform(),
                                       1.5 + uniform()};
        double r[3], u[3], F[3];
        obey_coulomb(&cone, trial % 3, r, u);
        for (int k = 0; k < FUNCTIONS; k++)
            CHECK_MAX(evaluate(k, &cone, r, u, F, NULL, NULL), 1e-12, "%s, trial %d",
                      functions[k].name, trial);
        /* a law that is broken is no root: pull, penetration, slip below the limit */
        double wrong_r[3] = {r[0], r[1], r[2]}, wrong_u[3] = {u[0], u[1], u[2]};
        switch (trial % 3) {
        case 0:
            wrong_r[0] = trial % 2 ? 0.5 : -0.5;
            break;
        case 1:
            wrong_u[trial % 2] = -0.5;
            break;
        default:
            wrong_r[1] += r[1] > 0.0 ? 0.5 : -0.5;
        }
        if (cone.mu > 0.0 || trial % 3 != 1 || trial % 2 == 0)
            for (int k = 0; k < FUNCTIONS; k++)
                if (evaluate(k, &cone, wrong_r, wrong_u, F, NULL, NULL) < 1e-3)
                    fail_msg("%s, trial %d: a root", functions[k].name, trial);
    }
}

/* Against differences, away from the kinks: where those of two steps agree. */
TEST(derivatives_are_those_of_the_functions)
{
    int compared = 0, all = 0;
    for (int trial = 0; trial < 400; trial++) {
        const int d = 2 + trial % 2;
        const rb_friction_cone cone = {d, trial % 5 ? 0.6 : 0.0, 1.5 + uniform(), 1.5 + uniform()};
        double x[6], F[3], A[9], B[9];
        for (int k = 0; k < 2 * d; k++)
            x[k] = uniform();
        if (trial % 3 == 0)
            x[0] = 1.0 + fabs(x[0]);
        for (int k = 0; k < FUNCTIONS; k++) {
            evaluate(k, &cone, x, x + d, F, A, B);
            for (int b = 0; b < 2 * d; b++)
                for (int a = 0; a < d; a++) {
                    double by[2], of = b < d ? A[a + b * d] : B[a + (b - d) * d];
                    for (int s = 0; s < 2; s++) {
                        const double h = s ? 1e-6 : 3e-6, at = x[b];
                        double up[3], down[3];
                        x[b] = at + h;
                        evaluate(k, &cone, x, x + d, up, NULL, NULL);
                        x[b] = at - h;
                        evaluate(k, &cone, x, x + d, down, NULL, NULL);
                        x[b] = at;
                        by[s] = (up[a] - down[a]) / (2.0 * h);
                    }
                    all++;
                    if (fabs(by[0] - by[1]) > 1e-6)
                        continue;
                    compared++;
                    CHECK_ABS(of, by[1], 1e-5, "%s, trial %d, (%d, %d)", functions[k].name, trial,
                              a, b);
                }
        }
    }
    assert_true(compared > 0.98 * all);
}

/* Where both are zero there are many derivatives: any element of the generalised one
 * keeps A and B between 0 and 1 in units of rho, and together regular. */
TEST(at_zero_the_derivatives_are_regular)
{
    static const double zero[3];
    for (int d = 2; d <= 3; d++)
        for (int k = 0; k < FUNCTIONS; k++)
            for (int sliding = 0; sliding < 2; sliding++) {
                const rb_friction_cone cone = {d, 0.6 * sliding, 2.0, 2.0};
                double F[3], A[9], B[9];
                CHECK_MAX(evaluate(k, &cone, zero, zero, F, A, B), 0.0, "%s", functions[k].name);
                for (int a = 0; a < d; a++) {
                    const double both = A[a + a * d] + B[a + a * d] / 2.0;
                    assert_true(A[a + a * d] >= 0.0 && B[a + a * d] >= 0.0);
                    if (!(both > 0.3 && both < 2.5))
                        fail_msg("%s, d = %d, %d: %g", functions[k].name, d, a, both);
                }
            }
}

/* A block is kept for any entry of it, whatever stands in the others. */
TEST(single_entries_make_blocks)
{
    for (int d = 2; d <= 3; d++)
        for (int entry = 0; entry < 4 * d * d; entry++) {
            const int m = 2 * d;
            double W[36] = {0.0}, x[6], y[6];
            rb_friction_problem p = {
                .form = RB_FRICTION_LOCAL_DENSE, .dimension = d, .contacts = 2, .W = W};
            W[entry] = 2.0;
            for (int k = 0; k < m; k++)
                x[k] = 1.0 + k;
            for (int sparse = 0; sparse < 2; sparse++) {
                OWNED(rb_friction_blocks) b;
                if (sparse)
                    CHECK_OK(rb_sparse_from_dense(m, m, W, m, &p.Ws));
                p.form = sparse ? RB_FRICTION_LOCAL_SPARSE : RB_FRICTION_LOCAL_DENSE;
                CHECK_OK(rb_friction_blocks_init(&p, &b));
                rb_friction_blocks_apply(&b, x, y);
                for (int k = 0; k < m; k++)
                    CHECK_ABS(y[k], k == entry % m ? 2.0 * x[entry / m] : 0.0, 0.0,
                              "entry %d, y(%d)", entry, k);
                for (int k = 0; k < m; k++) {
                    const double one[6] = {k == 0, k == 1, k == 2, k == 3, k == 4, k == 5};
                    rb_friction_blocks_apply(&b, one, y);
                    CHECK_ABS(y[entry % m], k == entry / m ? 2.0 : 0.0, 0.0, "entry %d, column %d",
                              entry, k);
                }
            }
            rb_sparse_free(&p.Ws);
        }
}

/* ---- The units of a contact -------------------------------------------------------- */

enum { NC = 5 };

/* Symmetric W, dense, with a contact (the fourth) that has no compliance of its own. */
static void make_w(int d, rb_friction_problem *p, double *W)
{
    const int m = d * NC;
    for (int j = 0; j < m; j++)
        for (int i = 0; i <= j; i++)
            W[i + j * m] = W[j + i * m] =
                i / d == 3 || j / d == 3 ? 0.0 : uniform() + (i == j ? 4.0 : 0.0);
    *p = (rb_friction_problem){
        .form = RB_FRICTION_LOCAL_DENSE, .dimension = d, .contacts = NC, .W = W};
}

/* The largest eigenvalue of W_TT by iteration. */
static double largest_eigenvalue(int d, const double *W, int m, int top)
{
    double x[2] = {1.0, 0.7}, size = 0.0;
    for (int k = 0; k < 2000; k++) {
        double y[2] = {0.0, 0.0};
        for (int b = 1; b < d; b++)
            for (int a = 1; a < d; a++)
                y[a - 1] += W[top + a + (top + b) * m] * x[b - 1];
        size = hypot(y[0], y[1]) / hypot(x[0], x[1]);
        memcpy(x, y, sizeof x);
        for (int a = 0; a < 2; a++)
            x[a] /= size;
    }
    return size;
}

TEST(rho_is_the_inverse_of_a_contacts_own_compliance)
{
    for (int d = 2; d <= 3; d++) {
        const int m = d * NC;
        double W[9 * NC * NC], rho[2 * NC], same[2 * NC], mean = 0.0;
        rb_friction_problem p;
        make_w(d, &p, W);
        CHECK_OK(rb_friction_rho(&p, rho));
        for (int c = 0; c < NC; c++) {
            if (c == 3)
                continue;
            const double n = W[c * d + c * d * m], t = largest_eigenvalue(d, W, m, c * d);
            CHECK_REL(rho[2 * c], 1.0 / n, 1e-14, "normal %d", c);
            CHECK_REL(rho[2 * c + 1], 1.0 / t, 1e-9, "tangential %d", c);
            mean += (n + t) / (2.0 * (NC - 1));
        }
        CHECK_REL(rho[6], 1.0 / mean, 1e-9, "without compliance, normal");
        CHECK_REL(rho[7], 1.0 / mean, 1e-9, "without compliance, tangential");
        p.form = RB_FRICTION_LOCAL_SPARSE;
        CHECK_OK(rb_sparse_from_dense(m, m, W, m, &p.Ws));
        CHECK_OK(rb_friction_rho(&p, same));
        for (int k = 0; k < 2 * NC; k++)
            CHECK_REL(same[k], rho[k], 1e-15, "sparse, %d", k);
        rb_sparse_free(&p.Ws);
        memset(W, 0, sizeof W); /* nothing is known at all */
        p.form = RB_FRICTION_LOCAL_DENSE;
        CHECK_OK(rb_friction_rho(&p, rho));
        for (int k = 0; k < 2 * NC; k++)
            CHECK_ABS(rho[k], 1.0, 0.0, "W = 0");
    }
}

/* Of the global form: a tenth of diag(K) in the place of K; of the tangents the softer. */
TEST(rho_of_a_structure_comes_from_its_diagonal)
{
    int rows[] = {0, 1, 2, 0, 1}, cols[] = {0, 1, 2, 1, 0};
    double k[] = {2.0, 4.0, 5.0, -1.0, -1.0}, h[] = {1.0, 3.0, 2.0, 0.5, 0.0}, rho[2];
    rb_friction_problem p = {.form = RB_FRICTION_GLOBAL, .dimension = 3, .contacts = 1, .dofs = 3};
    CHECK_OK(rb_sparse_from_triplets(
        &(rb_triplets){.rows = 3, .cols = 3, .nz = 5, .row = rows, .col = cols, .x = k}, &p.K));
    CHECK_OK(rb_sparse_from_triplets(
        &(rb_triplets){.rows = 3, .cols = 3, .nz = 5, .row = rows, .col = cols, .x = h}, &p.H));
    CHECK_OK(rb_friction_rho(&p, rho));
    /* columns (1, 0, 0), (0.5, 3, 0), (0, 0, 2) */
    CHECK_REL(rho[0], 0.1 / (1.0 / 2.0), 1e-15, "normal");
    CHECK_REL(rho[1], 0.1 / (0.25 / 2.0 + 9.0 / 4.0), 1e-15, "tangential");
    rb_sparse_free(&p.K);
    rb_sparse_free(&p.H);
}

/* u = H'v + c w and e = K v - H r - f, of a structure written out. */
TEST(velocities_and_imbalance_are_those_of_the_structure)
{
    enum { DOFS = 4, M = 2 };
    double K[DOFS * DOFS], H[DOFS * M], f[DOFS], w[M], r[M], v[DOFS], u[M], e[DOFS];
    rb_friction_problem p = {
        .form = RB_FRICTION_GLOBAL, .dimension = 2, .contacts = 1, .dofs = DOFS, .f = f, .w = w};
    for (int i = 0; i < DOFS; i++) {
        f[i] = uniform();
        v[i] = uniform();
        for (int j = 0; j < DOFS; j++)
            K[i + j * DOFS] = uniform();
        for (int j = 0; j < M; j++)
            H[i + j * DOFS] = uniform();
    }
    for (int j = 0; j < M; j++) {
        w[j] = uniform();
        r[j] = uniform();
    }
    CHECK_OK(rb_sparse_from_dense(DOFS, DOFS, K, DOFS, &p.K));
    CHECK_OK(rb_sparse_from_dense(DOFS, M, H, DOFS, &p.H));
    const rb_friction_system s = {.problem = &p, .d = 2, .contacts = 1, .m = M, .n = DOFS};
    for (int c = 0; c < 3; c++) {
        rb_friction_system_velocity(&s, c, r, v, u);
        for (int j = 0; j < M; j++) {
            double want = c * w[j];
            for (int i = 0; i < DOFS; i++)
                want += H[i + j * DOFS] * v[i];
            CHECK_ABS(u[j], want, 1e-15, "u(%d)", j);
        }
    }
    rb_friction_system_imbalance(&s, r, v, e);
    for (int i = 0; i < DOFS; i++) {
        double want = -f[i];
        for (int j = 0; j < DOFS; j++)
            want += K[i + j * DOFS] * v[j];
        for (int j = 0; j < M; j++)
            want -= H[i + j * DOFS] * r[j];
        CHECK_ABS(e[i], want, 1e-15, "e(%d)", i);
    }
    rb_sparse_free(&p.K);
    rb_sparse_free(&p.H);
}

/* || r - P(r - uhat) || over the contacts in units of their own, and the size of r. */
TEST(acarys_norm_is_that_of_the_contacts)
{
    for (int d = 2; d <= 3; d++) {
        double mu[NC], rho[2 * NC], unit[NC], r[3 * NC], u[3 * NC], work[3 * NC];
        double sum[2] = {0.0, 0.0}, size = 0.0;
        const rb_friction_problem p = {.dimension = d, .contacts = NC, .mu = mu};
        for (int c = 0; c < NC; c++) {
            mu[c] = 0.2 * c;
            rho[2 * c] = 1.5 + uniform();
            rho[2 * c + 1] = NAN; /* of no use here */
            unit[c] = c % 2 ? 0.25 : 8.0;
            for (int a = 0; a < d; a++) {
                r[c * d + a] = c == 1 ? 0.0 : uniform();
                u[c * d + a] = c == 1 && a == 0 ? 0.5 : uniform();
            }
            if (c == 2) { /* closed, not dragged, and leaving: no solution */
                r[c * d] = u[c * d] = 0.4;
                for (int a = 1; a < d; a++)
                    r[c * d + a] = 0.0;
            }
            for (int with = 0; with < 2; with++) {
                const double by = with ? unit[c] : 1.0;
                double z[3], F[3], uc[3];
                for (int a = 0; a < d; a++)
                    uc[a] = u[c * d + a] / by;
                for (int a = 0; a < d; a++)
                    z[a] = by * r[c * d + a] - (uc[a] + (a ? 0.0 : mu[c] * tangential(d, uc)));
                rb_friction_project(d, mu[c], z, z);
                for (int a = 0; a < d; a++)
                    F[a] = by * r[c * d + a] - z[a];
                sum[with] += dot(d, F, F);
            }
            size += dot(d, r + c * d, r + c * d) / (rho[2 * c] * rho[2 * c]);
        }
        CHECK_REL(rb_friction_acary_norm(&p, NULL, r, u), sqrt(sum[0]), 1e-14, "norm");
        CHECK_REL(rb_friction_acary_norm(&p, unit, r, u), sqrt(sum[1]), 1e-14, "in other units");
        CHECK_REL(rb_friction_size(&p, rho, r, work), sqrt(size), 1e-14, "size");
        for (int k = 0; k < d * NC; k++)
            r[k] *= 1e200;
        CHECK_REL(rb_friction_size(&p, rho, r, work), 1e200 * sqrt(size), 1e-14,
                  "size beyond squares");
    }
}

/* Points of the law are at distance zero, exactly where no rounding is in them, at every mu;
 * away from it by eps in one direction, at eps. */
TEST(the_distance_from_the_law)
{
    static const double all[] = {0.0, 0.3, 1.0, 4.0, 1e4, 1e9, 1e300};
    for (int k = 0; k < 400; k++) {
        const int d = 2 + k % 2;
        const double mu = all[k % 7], rho = exp2(k % 9 - 4.0), eps = 1e-6 * (2.0 + uniform());
        double r[3] = {0.0}, u[3] = {0.0}, v[3] = {0.0}, length = 0.0;
        for (int a = 1; a < d; a++)
            v[a] = uniform();
        length = tangential(d, v);
        for (int a = 1; a < d; a++)
            v[a] /= length;

        /* open */
        for (int a = 1; a < d; a++)
            u[a] = v[a];
        u[0] = 0.5 + uniform();
        u[0] = fabs(u[0]);
        CHECK_ABS(rb_friction_law_distance(d, mu, rho, r, u), 0.0, 0.0, "open, mu %g", mu);
        /* pulled at, on the slip's side of zero too */
        r[0] = -eps * rho;
        CHECK_REL(rb_friction_law_distance(d, mu, rho, r, u), eps, 1e-12, "pulled, mu %g", mu);
        /* a velocity into the other body, whatever mu is: here all states are eps away */
        for (int a = 0; a < d; a++)
            r[a] = u[a] = 0.0;
        u[0] = -eps;
        CHECK_REL(rb_friction_law_distance(d, mu, rho, r, u), eps, 1e-15, "into, mu %g", mu);

        /* stick, well within the cone */
        for (int a = 0; a < d; a++)
            u[a] = 0.0;
        r[0] = rho * (1.0 + 0.5 * uniform());
        for (int a = 1; a < d; a++)
            r[a] = 0.5 * fmin(mu, 1.0) * r[0] * v[a];
        CHECK_ABS(rb_friction_law_distance(d, mu, rho, r, u), 0.0, 0.0, "stick, mu %g", mu);
        u[0] = -eps;
        CHECK_REL(rb_friction_law_distance(d, mu, rho, r, u), eps, 1e-12, "stick, into");
        u[0] = 0.0;
        for (int a = 1; a < d && mu > 0.0; a++)
            u[a] = eps * v[a];
        if (mu > 0.0)
            CHECK_REL(rb_friction_law_distance(d, mu, rho, r, u), eps, 1e-12, "stick, dragged");

        /* slip, r_T opposite to u_T; mu beyond 1e9 leaves no r_N beside r_T */
        if (mu > 1e4)
            continue;
        for (int a = 1; a < d; a++) {
            u[a] = 2.0 * v[a];
            r[a] = -mu * r[0] * v[a];
        }
        u[0] = 0.0;
        const double L = hypot(1.0, mu);
        CHECK_MAX(rb_friction_law_distance(d, mu, rho, r, u), 1e-15 * L * r[0] / rho, "slip");
        u[0] = eps;
        CHECK_REL(rb_friction_law_distance(d, mu, rho, r, u), eps, 1e-8, "slip, leaving");
        u[0] = 0.0;
        for (int a = 1; a < d; a++)
            r[a] -= eps * rho * v[a];                                 /* out of the cone */
        const double exact = 1e-15 * L * r[0] / rho + 1e-8 * eps / L; /* of rounding r */
        CHECK_ABS(rb_friction_law_distance(d, mu, rho, r, u), eps / L, exact, "slip, mu %g", mu);
        for (int a = 1; a < d; a++)
            r[a] += 2.0 * eps * rho * v[a]; /* too little */
        if (mu > 0.0)
            CHECK_ABS(rb_friction_law_distance(d, mu, rho, r, u), eps / L, exact, "too little");
        for (int a = 1; a < d; a++) {
            r[a] = mu * r[0] * v[a]; /* along the slip instead of opposite to it */
            u[a] = eps * v[a];
        }
        if (mu > 1e-6)
            CHECK_REL(rb_friction_law_distance(d, mu, rho, r, u), eps, 1e-8, "along, mu %g", mu);
    }
}

RUN_TESTS(NULL, NULL)
