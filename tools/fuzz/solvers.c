/* Solvers on any finite numbers: what they call solved, is solved. */
#include "fuzz.h"
#include "rollbem/friction.h"
#include "lcp/lcp.h"
#include "rollbem/sparse.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ORDER_MAX = 7, CONTACTS_MAX = 3 };

/* max |min(z_i, (M z + q)_i)| beyond the rounding of the terms of its row, without the
 * library; INFINITY where it is no number. */
static double residual(int n, const double *M, const double *q, const double *z)
{
    double worst = 0.0;
    for (int i = 0; i < n; i++) {
        long double w = q[i], terms = fabsl(w);
        for (int j = 0; j < n; j++) {
            w += (long double)M[i + j * n] * z[j];
            terms += fabsl((long double)M[i + j * n] * z[j]);
        }
        const double r = (double)(fabsl(fminl(z[i], w)) - 1e-14 * terms);
        if (!(r <= worst))
            worst = isfinite(r) ? r : INFINITY;
    }
    return worst;
}

/* RB_INACCURATE begins above 1e-6 max |q| (rollbem/lcp.h).  Below DBL_MIN numbers have
 * fewer digits. */
static void require_solved(const char *what, int n, const double *M, const double *q,
                           const double *z)
{
    double size = 0.0;
    for (int i = 0; i < n; i++) {
        fuzz_require(isfinite(z[i]), "a solution is finite");
        size = fmax(size, fabs(q[i]));
    }
    fuzz_require(residual(n, M, q, z) <= 1.001e-6 * size + DBL_MIN, what);
}

/* Enumerated solutions are not judged by max |q| but by the terms of each sum. */
static void require_listed(int n, const double *M, const double *q, const double *z)
{
    long double size = 0.0;
    for (int i = 0; i < n; i++) {
        long double terms = fabsl(q[i]);
        for (int j = 0; j < n; j++)
            terms += fabsl((long double)M[i + j * n] * z[j]);
        fuzz_require(isfinite(z[i]), "an enumerated solution is finite");
        size = fmaxl(size, fmaxl(terms, fabsl(z[i])));
    }
    fuzz_require(residual(n, M, q, z) <= 1e-9 * size + DBL_MIN, "an enumerated solution solves");
}

static void require_same(const double *got, const double *kept, size_t n)
{
    fuzz_require(memcmp(got, kept, n * sizeof *got) == 0, "const input stays as it is");
}

void fuzz_lemke(const uint8_t *data, size_t size)
{
    fuzz_bytes b = {data, data + size};
    const int n = 1 + fuzz_choice(&b, ORDER_MAX);
    double M[ORDER_MAX * ORDER_MAX], q[ORDER_MAX], z[ORDER_MAX], kept[ORDER_MAX];
    double copy[ORDER_MAX * ORDER_MAX];
    rb_triplets t = {.rows = n, .cols = n};
    rb_lcp_options opt = rb_lcp_defaults();
    rb_lcp_info info;
    rb_sparse a = {0};

    opt.max_iters = 200;
    opt.rule = fuzz_choice(&b, 4) ? RB_LCP_LEXICOGRAPHIC : RB_LCP_FIRST_INDEX;
    for (int i = 0; i < n; i++)
        kept[i] = q[i] = fuzz_number(&b);
    for (int k = 0; k < n * n; k++) {
        copy[k] = M[k] = fuzz_number(&b);
        rb_triplets_add(&t, k % n, k / n, M[k]);
    }
    if (rb_lcp_lemke(&(rb_lcp_problem){n, M, n, q}, &opt, z, &info) == RB_OK)
        require_solved("Lemke's solution solves", n, M, q, z);
    fuzz_require(rb_sparse_from_triplets(&t, &a) == RB_OK, "a matrix becomes sparse");
    rb_triplets_free(&t);
    if (rb_lcp_newton(&a, q, &opt, z, &info) == RB_OK)
        require_solved("Newton's solution solves", n, M, q, z);
    if (rb_lcp_mixed(&(rb_lcp_mixed_problem){.M = &a, .q = q}, &opt, z, &info) == RB_OK)
        require_solved("the solution of the sparse method solves", n, M, q, z);
    rb_sparse_free(&a);
    rb_lcp_solutions all = {0};
    rb_message why = {.text = ""};
    const rb_status s =
        rb_lcp_enumerate(&(rb_lcp_problem){n, M, n, q}, NULL, NULL, 0.0, &all, &why);
    fuzz_require_reason(s, &why);
    for (int k = 0; s == RB_OK && k < all.count; k++)
        require_listed(n, M, q, all.z + k * n);
    rb_lcp_solutions_free(&all);
    require_same(M, copy, (size_t)(n * n));
    require_same(q, kept, (size_t)n);
}

void fuzz_friction(const uint8_t *data, size_t size)
{
    enum { ROWS_MAX = 3 * CONTACTS_MAX };
    fuzz_bytes b = {data, data + size};
    int count;
    const rb_friction_solver *solvers = rb_friction_solvers(&count);
    const char *solver = solvers[fuzz_choice(&b, count)].name;
    double mu[CONTACTS_MAX], W[ROWS_MAX * ROWS_MAX], q[ROWS_MAX], r[ROWS_MAX];
    double u[ROWS_MAX];
    rb_friction_errors error;
    rb_friction_problem p = {.form = RB_FRICTION_LOCAL_DENSE,
                             .dimension = 2 + fuzz_choice(&b, 2),
                             .contacts = 1 + fuzz_choice(&b, CONTACTS_MAX),
                             .mu = mu,
                             .W = W,
                             .q = q};
    const int m = p.dimension * p.contacts, factor = fuzz_choice(&b, 2);
    rb_friction_options opt = rb_friction_defaults();
    rb_friction_info info = {.msg = {.text = ""}};

    opt.max_iters = 60;
    for (int k = 0; k < p.contacts; k++)
        mu[k] = fabs(fuzz_number(&b));
    for (int i = 0; i < m; i++)
        q[i] = fuzz_number(&b);
    for (int k = 0; k < m * m; k++)
        W[k] = fuzz_number(&b);
    if (factor) { /* C C', as bodies give it */
        double C[ROWS_MAX * ROWS_MAX];
        memcpy(C, W, sizeof C);
        for (int i = 0; i < m; i++)
            for (int j = 0; j < m; j++) {
                W[i + j * m] = 0.0;
                for (int k = 0; k < m; k++)
                    W[i + j * m] += C[i + k * m] * C[j + k * m];
                if (!isfinite(W[i + j * m]))
                    return;
            }
    }
    const rb_status s =
        rb_friction_solve(solver, &p, &opt, &(rb_friction_solution){r, u, NULL}, &info);
    fuzz_require(s >= RB_EHELPER && s <= RB_INTERRUPTED, "a status is a known one");
    if (s != RB_OK)
        return;
    for (int i = 0; i < m; i++)
        fuzz_require(isfinite(r[i]), "a solution is finite");
    fuzz_require(rb_friction_error(&p, r, NULL, u, &error) == RB_OK,
                 "what is solved can be measured");
    fuzz_require(error.scaled <= fmax(opt.tol, info.floor) * (1.0 + 1e-9),
                 "what is called solved is below its tolerance");
}
