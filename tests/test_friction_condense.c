/* W = H' K^-1 H and q = w + H' K^-1 f against elimination on the whole K: bodies with
 * diagonal and with full matrices, inverted densely and by CHOLMOD, of which any two meet
 * at several contacts. */
#include "check.h"
#include "friction_problems.h"
#include "lcp/friction/friction.h"
#include "numbers.h"

static unsigned long long seed = 9;

static double uniform(void)
{
    return uniform_of(&seed);
}

static int below(int n)
{
    return (int)(0.5 * (1.0 + uniform()) * n);
}

enum { BODIES = 8, NC = 9, M = 3 * NC, DOFS = 1 + 3 + 3 + 5 + 12 + 13 + 6 + 2 };

/* Sizes up to 12 are inverted densely; from the body FULL on the matrix is diagonal. */
static const int sizes[BODIES] = {1, 3, 3, 5, 12, 13, 6, 2};
enum { FULL = 6 };

static int dof_of(int body, int k)
{
    int first = 0;
    for (int b = 0; b < body; b++)
        first += sizes[b];
    return (first + k) * 7 % DOFS; /* bodies mixed: 7 and DOFS have no common factor */
}

static void make_bodies(rb_friction_problem *p)
{
    OWNED(rb_triplets) K = {.rows = DOFS, .cols = DOFS}, H = {.rows = DOFS, .cols = M};
    *p = zero_global(3, NC, DOFS);
    for (int b = 0; b < BODIES; b++)
        for (int i = 0; i < sizes[b]; i++)
            for (int j = 0; j <= i; j++) {
                const int row = dof_of(b, i), col = dof_of(b, j);
                const double x = i == j ? sizes[b] + 1.0 + uniform() : uniform();
                if (i == j)
                    rb_triplets_add(&K, row, row, x);
                else if (b < FULL) {
                    rb_triplets_add(&K, row, col, x);
                    rb_triplets_add(&K, col, row, x);
                }
            }
    for (int c = 0; c < NC; c++) {
        const int one = below(BODIES), other = c % 4 ? below(BODIES) : one;
        p->mu[c] = 0.1 * c;
        for (int a = 0; a < 3; a++) {
            p->w[3 * c + a] = uniform();
            for (int k = 0; k < sizes[one]; k++)
                rb_triplets_add(&H, dof_of(one, k), 3 * c + a, uniform());
            for (int k = 0; other != one && k < sizes[other]; k++)
                rb_triplets_add(&H, dof_of(other, k), 3 * c + a, uniform());
        }
    }
    for (int i = 0; i < DOFS; i++)
        p->f[i] = uniform();
    CHECK_OK(rb_sparse_from_triplets(&K, &p->K));
    CHECK_OK(rb_sparse_from_triplets(&H, &p->H));
}

/* X = K^-1 X without pivoting: K is positive definite. */
static void eliminate(double *K, int columns, double *X)
{
    for (int c = 0; c < DOFS; c++)
        for (int i = 0; i < DOFS; i++) {
            const double factor = K[i + c * DOFS] / K[c + c * DOFS];
            if (i == c || factor == 0.0)
                continue;
            for (int j = c; j < DOFS; j++)
                K[i + j * DOFS] -= factor * K[c + j * DOFS];
            for (int j = 0; j < columns; j++)
                X[i + j * DOFS] -= factor * X[c + j * DOFS];
        }
    for (int j = 0; j < columns; j++)
        for (int i = 0; i < DOFS; i++)
            X[i + j * DOFS] /= K[i + i * DOFS];
}

static void to_dense(const rb_sparse *a, double *x)
{
    memset(x, 0, (size_t)a->rows * (size_t)a->cols * sizeof *x);
    for (int j = 0; j < a->cols; j++)
        for (int k = a->p[j]; k < a->p[j + 1]; k++) {
            assert_true(k == a->p[j] || a->i[k] > a->i[k - 1]);
            x[a->i[k] + j * a->rows] = a->x[k];
        }
}

TEST(bodies_that_meet_anywhere_are_condensed)
{
    static double K[DOFS * DOFS], X[DOFS * (M + 1)], H[DOFS * M], W[M * M];
    for (int trial = 0; trial < 10; trial++) {
        OWNED(rb_friction_problem) p, local;
        make_bodies(&p);
        CHECK_OK(rb_friction_condense(&p, &local, &message));
        to_dense(&p.K, K);
        to_dense(&p.H, H);
        to_dense(&local.Ws, W);
        memcpy(X, H, sizeof H);
        memcpy(X + DOFS * M, p.f, DOFS * sizeof *X);
        eliminate(K, M + 1, X);
        for (int j = 0; j <= M; j++)
            for (int i = 0; i < M; i++) {
                double want = j == M ? p.w[i] : 0.0;
                for (int k = 0; k < DOFS; k++)
                    want += H[k + i * DOFS] * X[k + j * DOFS];
                if (j == M)
                    CHECK_ABS(local.q[i], want, 1e-12, "trial %d, q(%d)", trial, i);
                else
                    CHECK_ABS(W[i + j * M], want, 1e-12, "trial %d, W(%d, %d)", trial, i, j);
            }
        for (int c = 0; c < NC; c++)
            CHECK_ABS(local.mu[c], p.mu[c], 0.0, "mu(%d)", c);
    }
}

/* One of the bodies has a matrix of ones, which is of rank 1, or no stiffness at all. */
TEST(a_loose_body_is_told)
{
    for (int b = 0; b < BODIES; b++) {
        const int full = b < FULL && sizes[b] > 1;
        rb_friction_problem p, local;
        char words[40];
        make_bodies(&p);
        for (int i = 0; i < sizes[b]; i++)
            for (int k = p.K.p[dof_of(b, i)]; k < p.K.p[dof_of(b, i) + 1]; k++)
                p.K.x[k] = full;
        CHECK_STATUS(rb_friction_condense(&p, &local, &message), RB_SINGULAR);
        snprintf(words, sizeof words, "(nullity %d)", full ? sizes[b] - 1 : sizes[b]);
        if (!strstr(message.text, words))
            fail_msg("body %d: %s, expected %s", b, message.text, words);
        rb_friction_problem_free(&p);
    }
}

static rb_status condense(void *context)
{
    rb_friction_problem local;
    const rb_status s = rb_friction_condense(context, &local, NULL);
    if (s == RB_OK)
        rb_friction_problem_free(&local);
    return s;
}

TEST(short_memory_is_reported)
{
    OWNED(rb_friction_problem) p;
    make_bodies(&p);
    assert_true(alloc_fail_each(condense, &p) > 5);
}

RUN_TESTS(NULL, NULL)
