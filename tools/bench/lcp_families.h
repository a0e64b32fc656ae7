/* Families of linear complementarity problems: those on which methods are known to be
 * slow, and those that applications lead to.  For bench_lemke and tests/test_lcp_auto. */
#ifndef BENCH_LCP_FAMILIES_H
#define BENCH_LCP_FAMILIES_H

#include "base/base.h"
#include "base/sparse.h"

#include <math.h>
#include <stdlib.h>

typedef struct {
    int n;
    rb_triplets t;
    rb_sparse M; /* owned, as q */
    double *q;   /* n */
    unsigned long long seed;
} lcp_family;

static double lcp_random(lcp_family *f)
{
    f->seed = f->seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(f->seed >> 11) / 9007199254740992.0;
}

static void lcp_add(lcp_family *f, int i, int j, double x)
{
    if (x != 0.0)
        rb_triplets_add(&f->t, i, j, x);
}

static void lcp_begin(lcp_family *f, int n)
{
    *f = (lcp_family){.n = n, .t = {.rows = n, .cols = n}, .seed = 1 + (unsigned)n};
    f->q = calloc((size_t)n, sizeof *f->q);
}

/* ---- Long paths --------------------------------------------------------------------- */

/* Murty (1978): Lemke's method visits 2^n bases, as do least-index exchanges. */
static void lcp_murty(lcp_family *f, int n)
{
    lcp_begin(f, n);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j <= i; j++)
            lcp_add(f, i, j, i == j ? 1.0 : 2.0);
        f->q[i] = -1.0;
    }
}

/* Its transpose: triangular the other way round, so that ties are broken in the other order. */
static void lcp_murty_upper(lcp_family *f, int n)
{
    lcp_begin(f, n);
    for (int i = 0; i < n; i++) {
        for (int j = i; j < n; j++)
            lcp_add(f, i, j, i == j ? 1.0 : 2.0);
        f->q[i] = -1.0;
    }
}

/* Fathi (1979): the product of Murty's matrix and its transpose, symmetric and positive
 * definite. */
static void lcp_fathi(lcp_family *f, int n)
{
    lcp_begin(f, n);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            const int k = i < j ? i : j;
            lcp_add(f, i, j, i == j ? 1.0 + 4.0 * k : 2.0 + 4.0 * k);
        }
        f->q[i] = -1.0;
    }
}

/* Kostreva's cyclic example (1979) n/3 times. */
static void lcp_kostreva(lcp_family *f, int n)
{
    lcp_begin(f, n - n % 3);
    for (int i = 0; i < f->n; i++) {
        const int first = i - i % 3;
        lcp_add(f, i, i, 1.0);
        lcp_add(f, i, first + (i - first + 1) % 3, 2.0);
        f->q[i] = -1.0;
    }
}

/* ---- Discretised inequalities --------------------------------------------------------- */

/* A membrane over an obstacle on side x side points: -Laplace u >= f, u >= psi. */
static void lcp_obstacle(lcp_family *f, int n)
{
    const int side = (int)floor(sqrt((double)n) + 1e-9);
    const double h = 1.0 / (side + 1);
    lcp_begin(f, side * side);
    for (int y = 0; y < side; y++)
        for (int x = 0; x < side; x++) {
            const int k = x + side * y;
            const int next[4] = {x > 0 ? k - 1 : -1, x < side - 1 ? k + 1 : -1,
                                 y > 0 ? k - side : -1, y < side - 1 ? k + side : -1};
            lcp_add(f, k, k, 4.0);
            for (int e = 0; e < 4; e++)
                if (next[e] >= 0)
                    lcp_add(f, k, next[e], -1.0);
        }
    for (int y = 0; y < side; y++)
        for (int x = 0; x < side; x++) {
            double w = 0.0;
            for (int e = 0; e < 5; e++) {
                const int dx = (e == 1) - (e == 2), dy = (e == 3) - (e == 4);
                const double X = h * (x + dx + 1), Y = h * (y + dy + 1);
                const int outside = x + dx < 0 || x + dx >= side || y + dy < 0 || y + dy >= side;
                const double r2 = (X - 0.4) * (X - 0.4) + (Y - 0.5) * (Y - 0.5);
                const double psi = outside ? 0.0 : 0.5 - 4.0 * r2;
                w += (e == 0 ? 4.0 : -1.0) * psi;
            }
            f->q[x + side * y] = w + h * h;
        }
}

/* Reynolds' equation in a journal bearing that is long, with cavitation (Christopherson):
 * -(H^3 p')' >= -H', p >= 0. */
static void lcp_bearing(lcp_family *f, int n)
{
    const double h = 2.0 * 3.14159265358979323846 / (n + 1);
    lcp_begin(f, n);
    for (int i = 0; i < n; i++) {
        const double at = h * (i + 1);
        const double left = pow(1.0 + 0.8 * cos(at - 0.5 * h), 3.0);
        const double right = pow(1.0 + 0.8 * cos(at + 0.5 * h), 3.0);
        lcp_add(f, i, i, (left + right) / h);
        if (i > 0)
            lcp_add(f, i, i - 1, -left / h);
        if (i < n - 1)
            lcp_add(f, i, i + 1, -right / h);
        f->q[i] = 0.8 * (cos(at + 0.5 * h) - cos(at - 0.5 * h));
    }
}

/* One implicit step of an American put (Black and Scholes): not symmetric. */
static void lcp_option(lcp_family *f, int n)
{
    const double sigma = 0.3, rate = 0.05, dt = 0.1, ds = 3.0 / (n + 1);
    lcp_begin(f, n);
    for (int i = 0; i < n; i++) {
        const double s = ds * (i + 1), a = 0.5 * sigma * sigma * s * s / (ds * ds);
        const double b = rate * s / ds;
        const double down = -dt * a, up = -dt * (a + b);
        const double own = 1.0 + dt * (2.0 * a + b + rate);
        const double pay = fmax(1.0 - s, 0.0);
        lcp_add(f, i, i, own);
        if (i > 0)
            lcp_add(f, i, i - 1, down);
        if (i < n - 1)
            lcp_add(f, i, i + 1, up);
        f->q[i] =
            own * pay + down * fmax(1.0 - (s - ds), 0.0) + up * fmax(1.0 - (s + ds), 0.0) - pay;
    }
}

/* ---- Equilibria
 * ------------------------------------------------------------------------ */

/* Linear market: activities x with costs c, A x >= demand d - D p that falls with prices,
 * c >= A'p.  Half of n are goods. */
static void lcp_market(lcp_family *f, int n)
{
    const int goods = n / 2, activities = n - goods;
    lcp_begin(f, n);
    for (int j = 0; j < activities; j++) {
        f->q[j] = 1.0 + lcp_random(f);
        for (int e = 0; e < 4; e++) {
            const int i = (j + (int)(lcp_random(f) * goods * e)) % goods;
            const double x = 0.5 + lcp_random(f);
            lcp_add(f, activities + i, j, x);
            lcp_add(f, j, activities + i, -x);
        }
    }
    for (int i = 0; i < goods; i++) {
        lcp_add(f, activities + i, activities + i, 1.0 + lcp_random(f));
        if (i + 1 < goods) { /* not symmetric */
            lcp_add(f, activities + i, activities + i + 1, 0.4 * lcp_random(f));
            lcp_add(f, activities + i + 1, activities + i, -0.2 * lcp_random(f));
        }
        f->q[activities + i] = -5.0 - 5.0 * lcp_random(f);
    }
}

/* Wardrop's equilibrium: pairs with four paths each over links with affine, unsymmetric
 * costs; flows of paths and costs of pairs. */
static void lcp_traffic(lcp_family *f, int n)
{
    const int pairs = n / 5, paths = 4 * pairs, links = 2 * pairs + 4;
    enum { LENGTH = 3 };
    int(*on)[LENGTH] = malloc((size_t)paths * sizeof *on);
    lcp_begin(f, 5 * pairs);
    for (int p = 0; p < paths; p++)
        for (int k = 0; k < LENGTH; k++)
            on[p][k] = (int)(lcp_random(f) * links);
    for (int p = 0; p < paths; p++) {
        for (int r = 0; r < paths; r++)
            for (int a = 0; a < LENGTH; a++)
                for (int b = 0; b < LENGTH; b++) {
                    const int from = on[p][a], to = on[r][b];
                    lcp_add(f, p, r,
                            from == to         ? 1.0 + 0.5 * (from % 3)
                            : to == (from ^ 1) ? 0.3 * (from & 1)
                                               : 0.0);
                }
        for (int a = 0; a < LENGTH; a++)
            f->q[p] += 1.0 + on[p][a] % 5;
        lcp_add(f, p, paths + p / 4, -1.0);
        lcp_add(f, paths + p / 4, p, 1.0);
    }
    for (int k = 0; k < pairs; k++)
        f->q[paths + k] = -1.0 - lcp_random(f);
    free(on);
}

/* Followers of Stackelberg's leader: Cournot firms with capacities, outputs and
 * multipliers. */
static void lcp_stackelberg(lcp_family *f, int n)
{
    const int firms = n / 2;
    lcp_begin(f, 2 * firms);
    for (int i = 0; i < firms; i++) {
        const double capacity = 0.2 + 2.0 * lcp_random(f) / firms;
        for (int j = 0; j < firms; j++)
            lcp_add(f, i, j, i == j ? 2.1 : 1.0);
        lcp_add(f, i, firms + i, 1.0);
        lcp_add(f, firms + i, i, -1.0);
        f->q[i] = 1.0 + lcp_random(f) - (10.0 + 0.1 * firms);
        f->q[firms + i] = capacity;
    }
}

/* ---- Matrices without much structure
 * ---------------------------------------------------- */

/* Monotone of low rank and full of ties: B'B + S with few rows of small integers, S skew;
 * a solution with zeros in both z and w is planted. */
static void lcp_degenerate(lcp_family *f, int n)
{
    const int rank = n / 3 + 1;
    double *B = calloc((size_t)rank * (size_t)n, sizeof *B);
    double *S = calloc((size_t)n * (size_t)n, sizeof *S);
    double *z = calloc((size_t)n, sizeof *z);
    lcp_begin(f, n);
    for (int k = 0; k < rank * n; k++)
        B[k] = lcp_random(f) < 0.3 ? floor(3.0 * lcp_random(f)) - 1.0 : 0.0;
    for (int j = 0; j < n; j++) {
        z[j] = j % 3 == 0 ? 1.0 : 0.0;
        for (int i = 0; i < j; i++)
            S[i + j * n] = lcp_random(f) < 0.1 ? 1.0 : 0.0;
    }
    for (int i = 0; i < n; i++) {
        f->q[i] = i % 3 == 1 ? 1.0 : 0.0;
        for (int j = 0; j < n; j++) {
            double x = S[i + j * n] - S[j + i * n];
            for (int k = 0; k < rank; k++)
                x += B[k + i * rank] * B[k + j * rank];
            lcp_add(f, i, j, x);
            f->q[i] -= x * z[j];
        }
    }
    free(B);
    free(S);
    free(z);
}

/* Strictly copositive: no negative entries, a positive diagonal; no P-matrix. */
static void lcp_copositive(lcp_family *f, int n)
{
    lcp_begin(f, n);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            lcp_add(f, i, j, i == j ? 1.0 : floor(4.0 * lcp_random(f)));
    for (int i = 0; i < n; i++)
        f->q[i] = floor(20.0 * lcp_random(f)) - 15.0;
}

/* P0 and no better: triangular without negative entries, zeros on a third of the diagonal, so that
 * principal minors vanish, in a random order of the unknowns; a solution with zeros in both z and w
 * is planted. */
static void lcp_p0(lcp_family *f, int n)
{
    int *at = malloc((size_t)n * sizeof *at);
    lcp_begin(f, n);
    for (int i = 0; i < n; i++)
        at[i] = i;
    for (int i = n - 1; i > 0; i--) {
        const int k = (int)(lcp_random(f) * (i + 1)), other = at[k];
        at[k] = at[i];
        at[i] = other;
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) {
            const double x = i == j                ? (i % 3 == 2 ? 0.0 : 1.0)
                             : lcp_random(f) < 0.2 ? floor(3.0 * lcp_random(f))
                                                   : 0.0;
            lcp_add(f, at[i], at[j], x);
            if (i % 3 != 2 && j % 3 == 0) /* w = M z + q with z = 1 there, 0 elsewhere */
                f->q[at[i]] -= x;
        }
    for (int i = 0; i < n; i++)
        f->q[at[i]] += i % 3 == 1 ? floor(2.0 * lcp_random(f)) : 0.0;
    free(at);
}

/* Copositive, few entries: no negative ones, zeros on half of the diagonal. */
static void lcp_copositive_sparse(lcp_family *f, int n)
{
    lcp_begin(f, n);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            lcp_add(f, i, j,
                    i == j                ? (j % 2 ? 1.0 : 0.0)
                    : lcp_random(f) < 0.1 ? 1.0 + floor(3.0 * lcp_random(f))
                                          : 0.0);
    for (int i = 0; i < n; i++)
        f->q[i] = floor(20.0 * lcp_random(f)) - (i % 2 ? 15.0 : 0.0);
}

/* A bimatrix game with n/2 strategies a player: costs in [1, 2), A y - 1 >= 0, B'x - 1 >=
 * 0, up to the sums of x and y its equilibria. */
static void lcp_game(lcp_family *f, int n)
{
    const int half = n / 2;
    lcp_begin(f, 2 * half);
    for (int i = 0; i < half; i++)
        for (int j = 0; j < half; j++) {
            lcp_add(f, i, half + j, 1.0 + lcp_random(f));
            lcp_add(f, half + j, i, 1.0 + lcp_random(f));
        }
    for (int i = 0; i < f->n; i++)
        f->q[i] = -1.0;
}

/* ---- Both together
 * ----------------------------------------------------------------------- */

typedef struct {
    const char *name;
    void (*make)(lcp_family *f, int n);
    int n[4]; /* orders of the bench; 0: no more */
} lcp_family_kind;

static const lcp_family_kind lcp_families[] = {
    {"murty", lcp_murty, {11, 20, 50, 300}},
    {"fathi", lcp_fathi, {11, 50, 300}},
    {"kostreva", lcp_kostreva, {3, 30, 300}},
    {"obstacle", lcp_obstacle, {100, 1600, 10000}},
    {"bearing", lcp_bearing, {20, 400, 10000}},
    {"option", lcp_option, {20, 400, 10000}},
    {"market", lcp_market, {20, 200, 1000}},
    {"traffic", lcp_traffic, {20, 200, 1000}},
    {"stackelberg", lcp_stackelberg, {20, 200, 600}},
    {"degenerate", lcp_degenerate, {20, 100, 300}},
    {"copositive", lcp_copositive, {20, 100, 300}},
    {"game", lcp_game, {4, 20, 100, 600}},
    {"murty, upper", lcp_murty_upper, {11, 20, 50, 300}},
    {"P0", lcp_p0, {20, 100, 300}},
    {"copositive, sparse", lcp_copositive_sparse, {20, 100, 300}},
};
enum { LCP_FAMILIES = sizeof lcp_families / sizeof lcp_families[0] };

static rb_status lcp_family_create(int kind, int n, lcp_family *f)
{
    lcp_families[kind].make(f, n);
    return f->q ? rb_sparse_from_triplets(&f->t, &f->M) : RB_ENOMEM;
}

/* Rows and columns times powers of two up to 2^e, which changes no digit; c (n): what z
 * is to be multiplied by to be that of the problem before. */
static void lcp_family_scale(lcp_family *f, double e, double *c)
{
    double *r = malloc((size_t)f->n * sizeof *r);
    for (int i = 0; i < f->n; i++) {
        r[i] = exp2(round(e * (2.0 * lcp_random(f) - 1.0)));
        c[i] = exp2(round(e * (2.0 * lcp_random(f) - 1.0)));
        f->q[i] *= r[i];
    }
    for (int j = 0; j < f->n; j++)
        for (int k = f->M.p[j]; k < f->M.p[j + 1]; k++)
            f->M.x[k] *= r[f->M.i[k]] * c[j];
    free(r);
}

static void lcp_family_free(lcp_family *f)
{
    rb_triplets_free(&f->t);
    rb_sparse_free(&f->M);
    free(f->q);
}

#endif
