/* Lemke's method for boxes on sparse matrices: against enumeration, against the dense
 * tableau, with free variables, from a given point, on large problems and on bad input. */
#include "check.h"

#include "block.h"
#include "lcp/lcp.h"
#include "numbers.h"

static unsigned long long state_of_random = 4;

/* Uniform in [-1, 1). */
static double uniform(void)
{
    return uniform_of(&state_of_random);
}

enum { N = 60 };

typedef struct {
    int n;
    double M[N * N], q[N], lower[N], upper[N];
} problem;

/* max |z - mid(lower, z - w, upper)|, written out independently of the library. */
static double natural_residual(const problem *p, const double *z)
{
    double worst = 0.0;
    for (int i = 0; i < p->n; i++) {
        double x = z[i] - p->q[i];
        for (int j = 0; j < p->n; j++)
            x -= p->M[i + j * p->n] * z[j];
        x = x < p->lower[i] ? p->lower[i] : x > p->upper[i] ? p->upper[i] : x;
        const double r = fabs(z[i] - x);
        if (!(r <= worst))
            worst = r;
    }
    return worst;
}

static rb_status solve_mixed(const problem *p, const rb_lcp_options *opt, double *z,
                             rb_lcp_info *info)
{
    OWNED(rb_sparse) M;
    CHECK_OK(rb_sparse_from_dense(p->n, p->n, p->M, p->n, &M));
    const rb_status s =
        rb_lcp_mixed(&(rb_lcp_mixed_problem){&M, p->q, p->lower, p->upper}, opt, z, info);
    return s;
}

static void no_boxes(problem *p)
{
    for (int i = 0; i < p->n; i++) {
        p->lower[i] = 0.0;
        p->upper[i] = INFINITY;
    }
}

/* Every pair has a positive part, a third of the entries is not zero. */
static void positive_definite(int n, problem *p)
{
    p->n = n;
    memset(p->M, 0, sizeof p->M);
    for (int i = 0; i < n; i++) {
        p->q[i] = 2.0 * uniform();
        p->M[i + i * n] = 1.0 + fabs(uniform());
        for (int j = 0; j < i; j++) {
            const double skew = uniform() > 0.3 ? 2.0 * uniform() : 0.0;
            p->M[i + j * n] = skew;
            p->M[j + i * n] = -skew;
        }
    }
    no_boxes(p);
}

/* Boxes of all kinds: finite, open on one side, fixed, free. */
static void random_boxes(problem *p, int kinds)
{
    for (int i = 0; i < p->n; i++) {
        const int kind = (int)((uniform() + 1.0) / 2.0 * kinds);
        p->lower[i] = kind == 2 || kind == 4 ? -INFINITY : uniform();
        p->upper[i] = kind == 0   ? p->lower[i] + 1.0 + uniform()
                      : kind == 2 ? uniform()
                      : kind == 3 ? p->lower[i]
                                  : INFINITY;
    }
}

TEST(without_boxes_it_is_the_lcp)
{
    static problem p;
    double z[N], want[N];
    rb_lcp_info info;
    for (int k = 0; k < 300; k++) {
        positive_definite(1 + k % N, &p);
        CHECK_OK(rb_lcp_lemke(&(rb_lcp_problem){p.n, p.M, p.n, p.q}, NULL, want, NULL));
        CHECK_OK(solve_mixed(&p, NULL, z, &info));
        const double size = 1.0 + rb_norm_inf((size_t)p.n, want);
        CHECK_MAX(natural_residual(&p, z), 1e-12 * size, "problem %d", k);
        CHECK_MAX(info.res, 1e-12 * size, "problem %d", k);
        for (int i = 0; i < p.n; i++)
            CHECK_ABS(z[i], want[i], 1e-9 * size, "problem %d, z(%d)", k, i + 1);
    }
}

/* Also of negative unknowns, as boxes have. */
TEST(the_floor_is_of_magnitudes)
{
    const double M[4] = {3.0, -1.0, 2.0, 0.5}, q[2] = {6.0, -8.0}, z[2] = {-2.0, 1.0};
    double room[2];
    OWNED(rb_sparse) sparse;
    CHECK_OK(rb_sparse_from_dense(2, 2, M, 2, &sparse));
    CHECK_REL(rb_lcp_rounding_floor(&(rb_lcp_mixed_problem){&sparse, q, NULL, NULL}, z, room),
              14e-14, 1e-12, "|3 (-2)| + |2| + 6");
}

TEST(boxes_of_all_kinds_are_solved)
{
    static problem p;
    double z[N];
    rb_lcp_info info;
    for (int k = 0; k < 600; k++) {
        positive_definite(1 + k % N, &p);
        random_boxes(&p, 5);
        CHECK_OK(solve_mixed(&p, NULL, z, &info));
        CHECK_MAX(natural_residual(&p, z), 1e-11 * (1.0 + rb_norm_inf((size_t)p.n, z)),
                  "problem %d", k);
        for (int i = 0; i < p.n; i++)
            assert_true(p.lower[i] <= z[i] && z[i] <= p.upper[i]);
    }
}

/* ---- Enumeration ------------------------------------------------------------------- */

/* x = A^-1 b by Gauss-Jordan elimination, 0 when A is singular. */
static int eliminate(int n, double *A, double *b)
{
    for (int c = 0; c < n; c++) {
        int r = c;
        for (int i = c + 1; i < n; i++)
            if (fabs(A[i + c * n]) > fabs(A[r + c * n]))
                r = i;
        if (fabs(A[r + c * n]) < 1e-10)
            return 0;
        for (int j = 0; j < n; j++) {
            const double x = A[r + j * n];
            A[r + j * n] = A[c + j * n];
            A[c + j * n] = x;
        }
        const double x = b[r];
        b[r] = b[c];
        b[c] = x;
        for (int i = 0; i < n; i++) {
            const double factor = i == c ? 0.0 : A[i + c * n] / A[c + c * n];
            for (int j = c; factor != 0.0 && j < n; j++)
                A[i + j * n] -= factor * A[c + j * n];
            b[i] -= factor * b[c];
        }
    }
    for (int c = 0; c < n; c++)
        b[c] /= A[c + c * n];
    return 1;
}

/* Each z(i) at its lower bound, at its upper one or in between (digits of `choice` to the
 * base 3); 1 when there is such a point. */
static int point_of_choice(const problem *p, int choice, double *z)
{
    enum { MOST = 6 };
    double A[MOST * MOST] = {0};
    const int n = p->n;
    for (int i = 0, c = choice; i < n; i++, c /= 3) {
        z[i] = c % 3 == 0 ? p->lower[i] : c % 3 == 1 ? p->upper[i] : -p->q[i];
        for (int j = 0; j < n; j++)
            A[i + j * n] = c % 3 == 2 ? p->M[i + j * n] : i == j;
        if (!isfinite(z[i]))
            return 0;
    }
    return eliminate(n, A, z);
}

/* Whether z is among the solutions that some choice gives, and how many there are. */
static int is_enumerated(const problem *p, const double *z, int *solutions)
{
    int choices = 1, found = 0;
    *solutions = 0;
    for (int i = 0; i < p->n; i++)
        choices *= 3;
    for (int c = 0; c < choices; c++) {
        double x[N], apart = 0.0;
        if (!point_of_choice(p, c, x) || natural_residual(p, x) > 1e-9)
            continue;
        for (int i = 0; i < p->n; i++)
            apart = fmax(apart, fabs(x[i] - z[i]));
        found |= apart < 1e-7;
        ++*solutions;
    }
    return found;
}

/* A compact box always holds a solution, whatever M is, and the path finds one. */
TEST(finite_boxes_are_solved_for_every_matrix)
{
    static problem p;
    double z[N];
    rb_lcp_info info;
    int several = 0;
    for (int k = 0; k < 300; k++) {
        int solutions;
        p.n = 1 + k % 6;
        for (int i = 0; i < p.n * p.n; i++)
            p.M[i] = uniform();
        for (int i = 0; i < p.n; i++)
            p.q[i] = uniform();
        random_boxes(&p, 1);
        CHECK_OK(solve_mixed(&p, NULL, z, &info));
        CHECK_MAX(natural_residual(&p, z), 1e-11 * (1.0 + rb_norm_inf((size_t)p.n, z)),
                  "problem %d", k);
        assert_true(is_enumerated(&p, z, &solutions));
        several += solutions > 1;
    }
    assert_true(several > 20);
}

TEST(open_boxes_have_the_enumerated_solution)
{
    static problem p;
    double z[N];
    rb_lcp_info info;
    for (int k = 0; k < 300; k++) {
        int solutions;
        positive_definite(1 + k % 6, &p);
        random_boxes(&p, 5);
        CHECK_OK(solve_mixed(&p, NULL, z, &info));
        assert_true(is_enumerated(&p, z, &solutions));
    }
}

/* ---- Ties -------------------------------------------------------------------------- */

/* Small integers tie at nearly every pivot; the box keeps every problem solvable. */
TEST(integers_full_of_ties_do_not_cycle)
{
    static problem p;
    double z[N];
    rb_lcp_info info;
    for (int k = 0; k < 500; k++) {
        p.n = 2 + k % 20;
        for (int i = 0; i < p.n * p.n; i++)
            p.M[i] = floor(1.5 * uniform() + 0.5);
        for (int i = 0; i < p.n; i++) {
            p.q[i] = -(uniform() > 0.0);
            p.lower[i] = 0.0;
            p.upper[i] = 1.0 + (uniform() > 0.0);
        }
        CHECK_OK(solve_mixed(&p, NULL, z, &info));
        CHECK_MAX(natural_residual(&p, z), 1e-11, "problem %d", k);
    }
}

/* Kostreva's example, on which the first index cycles until a new LU orders the slots
 * anew. */
TEST(the_rule_decides_whether_kostreva_cycles)
{
    static problem p = {3, {1, 0, 2, 2, 1, 0, 0, 2, 1}, {-1, -1, -1}, {0}, {0}};
    double z[3];
    rb_lcp_info info;
    no_boxes(&p);
    CHECK_OK(solve_mixed(&p, NULL, z, &info));
    for (int i = 0; i < 3; i++)
        CHECK_REL(z[i], 1.0 / 3.0, 1e-15, "z(%d)", i + 1);
    rb_lcp_options opt = rb_lcp_defaults();
    opt.max_iters = 20;
    CHECK_OK(solve_mixed(&p, &opt, z, &info));
    opt.rule = RB_LCP_FIRST_INDEX;
    CHECK_STATUS(solve_mixed(&p, &opt, z, &info), RB_MAXITER);
}

/* ---- The path, as the trace sees it ------------------------------------------------- */

enum { PIVOTS = 400 };

typedef struct {
    const problem *p;
    const double *cover; /* n */
    int n, count;
    int entering[PIVOTS], leaving[PIVOTS];
    unsigned long long basis[PIVOTS]; /* a bit of each variable */
} path;

static void keep_pivot(const rb_lcp_pivot *pivot, void *context)
{
    path *own = context;
    assert_int_equal(pivot->pivot, own->count);
    assert_true(own->count < PIVOTS);
    own->n = pivot->n;
    own->entering[own->count] = pivot->entering;
    own->leaving[own->count] = pivot->leaving;
    own->basis[own->count] = 0;
    for (int s = 0; s < pivot->n; s++)
        own->basis[own->count] |= 1ULL << pivot->basis[s];
    own->count++;
}

/* Every point of the path of an LCP: z, w, t >= 0 are complementary, and w = M z + q + t
 * times the cover. */
static void check_point(const rb_lcp_pivot *pivot, void *context)
{
    const path *own = context;
    const problem *p = own->p;
    double x[2 * N + 1] = {0}, most = 1.0;
    keep_pivot(pivot, context);
    assert_int_equal(pivot->basis[pivot->row], pivot->entering);
    CHECK_ABS(pivot->value[pivot->row], pivot->ratio, 1e-12 * (1.0 + pivot->ratio), "step");
    for (int s = 0; s < p->n; s++) {
        x[pivot->basis[s]] = pivot->value[s];
        most = fmax(most, pivot->value[s]);
    }
    CHECK_ABS(x[2 * p->n], pivot->z0, 0.0, "t");
    for (int i = 0; i < p->n; i++) {
        double w = p->q[i] + own->cover[i] * pivot->z0;
        for (int j = 0; j < p->n; j++)
            w += p->M[i + j * p->n] * x[p->n + j];
        CHECK_ABS(x[i], w, 1e-11 * most, "pivot %d, w(%d)", pivot->pivot, i + 1);
        CHECK_MAX(fmax(-x[i], -x[p->n + i]), 1e-11 * most, "pivot %d", pivot->pivot);
        assert_true(x[i] == 0.0 || x[p->n + i] == 0.0);
    }
}

TEST(every_point_of_the_path_solves_with_a_cover)
{
    static problem p;
    static path own;
    double z[N], cover[N];
    rb_lcp_info info;
    rb_lcp_options opt = rb_lcp_defaults();
    opt.trace = check_point;
    opt.trace_context = &own;
    opt.cover = cover;
    for (int k = 0; k < 40; k++) {
        positive_definite(1 + k % 30, &p);
        for (int i = 0; i < p.n; i++)
            cover[i] = 1.5 + uniform();
        own = (path){.p = &p, .cover = cover};
        CHECK_OK(solve_mixed(&p, &opt, z, &info));
        assert_int_equal(info.iters, own.count);
        if (own.count == 0)
            continue;
        assert_int_equal(own.entering[0], 2 * p.n);
        assert_int_equal(own.leaving[own.count - 1], 2 * p.n);
        for (int i = 1; i < own.count; i++)
            assert_int_equal(own.entering[i], (own.leaving[i - 1] + p.n) % (2 * p.n));
    }
}

/* The halves of a free z have the cover of its row, so that a path ends where the one
 * that all rows cover alike does, and a row that must be covered is named as the caller
 * numbers it. */
/* Free z are basic from the beginning, so that their w are zero, and no cover is asked for;
 * of a z with bounds it is. */
TEST(a_cover_is_that_of_z_with_bounds)
{
    static problem p;
    double z[N], want[N], cover[N];
    rb_lcp_info info;
    rb_lcp_options opt = rb_lcp_defaults();
    opt.cover = cover;
    for (int k = 0; k < 40; k++) {
        positive_definite(1 + k % 30, &p);
        for (int i = 0; i < p.n; i++) {
            cover[i] = i % 3 ? 1.5 + uniform() : 0.0;
            if (i % 3 == 0)
                p.lower[i] = -INFINITY;
        }
        CHECK_OK(solve_mixed(&p, NULL, want, NULL));
        CHECK_OK(solve_mixed(&p, &opt, z, &info));
        CHECK_MAX(natural_residual(&p, z), 1e-11, "order %d", p.n);
        for (int i = 0; i < p.n; i++)
            CHECK_ABS(z[i], want[i], 1e-10, "order %d, z(%d)", p.n, i + 1);
    }
    positive_definite(4, &p);
    for (int i = 0; i < 4; i++)
        cover[i] = i != 2, p.q[i] = i == 2 ? -0.5 : 1.0;
    CHECK_STATUS(solve_mixed(&p, &opt, z, &info), RB_EINVAL);
    assert_string_equal(info.msg.text, "lcp: cover(3) = 0: expected a number > 0, because "
                                       "w(3) = -0.5 at the start has the wrong sign");
}

/* Under a generic perturbation the path is a simple curve, so no basis comes twice,
 * however many rows tie. */
TEST(a_path_through_ties_meets_no_basis_twice)
{
    static problem p;
    static path own;
    double z[N];
    rb_lcp_info info;
    rb_lcp_options opt = rb_lcp_defaults();
    opt.trace = keep_pivot;
    opt.trace_context = &own;
    for (int k = 0; k < 300; k++) {
        p.n = 6 + k % 20;
        for (int i = 0; i < p.n * p.n; i++)
            p.M[i] = floor(1.5 * (1.0 + uniform()));
        for (int i = 0; i < p.n; i++) {
            p.M[i + i * p.n] = 1.0 + (i % 2);
            p.q[i] = -1.0;
        }
        no_boxes(&p);
        own = (path){.p = &p};
        CHECK_OK(solve_mixed(&p, &opt, z, &info));
        for (int i = 1; i < own.count; i++)
            for (int j = 0; j < i; j++)
                if (own.basis[i] == own.basis[j])
                    fail_msg("problem %d, n = %d: pivots %d and %d", k, p.n, j, i);
    }
}

static void check_same_path(const path *a, const path *b, const char *of)
{
    if (a->count != b->count)
        fail_msg("%s: %d and %d pivots", of, a->count, b->count);
    for (int i = 0; i < a->count; i++)
        if (a->entering[i] != b->entering[i] || a->leaving[i] != b->leaving[i])
            fail_msg("%s: pivot %d", of, i);
}

/* z + c in the boxes moved by c, and -z in the boxes turned round, have the same path:
 * integers, so that the same rows tie; a P-matrix, with which t never grows. */
TEST(moved_and_mirrored_boxes_have_the_same_path)
{
    static problem p, other;
    static path own, theirs;
    double z[N], at[N], from[N], there[N];
    rb_lcp_info info;
    rb_lcp_options opt = rb_lcp_defaults();
    opt.trace = keep_pivot;
    for (int k = 0; k < 200; k++) {
        p.n = 2 + k % 20;
        for (int i = 0; i < p.n; i++)
            for (int j = 0; j <= i; j++) {
                const double skew = floor(1.5 * uniform() + 0.5);
                p.M[i + j * p.n] = i == j ? 1.0 : skew;
                p.M[j + i * p.n] = i == j ? 1.0 : -skew;
            }
        for (int i = 0; i < p.n; i++) {
            p.q[i] = floor(2.0 * uniform());
            p.lower[i] = 0.0;
            p.upper[i] = 1.0 + (uniform() > 0.0);
            from[i] = uniform() > 0.5 ? p.upper[i] : 0.0;
        }
        opt.start = from;
        opt.trace_context = &own;
        own = (path){.p = &p};
        CHECK_OK(solve_mixed(&p, &opt, z, &info));

        other = p;
        for (int i = 0; i < p.n; i++) {
            const double c = 3.0 + i % 4;
            other.lower[i] += c;
            other.upper[i] += c;
            there[i] = from[i] + c;
            for (int j = 0; j < p.n; j++)
                other.q[j] -= p.M[j + i * p.n] * c;
        }
        opt.start = there;
        opt.trace_context = &theirs;
        theirs = (path){.p = &other};
        CHECK_OK(solve_mixed(&other, &opt, at, &info));
        check_same_path(&own, &theirs, "moved");
        for (int i = 0; i < p.n; i++)
            CHECK_ABS(at[i], z[i] + 3.0 + i % 4, 1e-12, "problem %d, z(%d)", k, i + 1);

        for (int i = 0; i < p.n; i++) {
            other.q[i] = -p.q[i];
            other.lower[i] = -p.upper[i];
            other.upper[i] = -p.lower[i];
            there[i] = -from[i];
        }
        theirs = (path){.p = &other};
        CHECK_OK(solve_mixed(&other, &opt, at, &info));
        check_same_path(&own, &theirs, "mirrored");
        for (int i = 0; i < p.n; i++)
            CHECK_ABS(at[i], -z[i], 1e-12, "problem %d, z(%d)", k, i + 1);
    }
}

/* ---- Free variables ---------------------------------------------------------------- */

/* min 1/2 x'Qx + c'x, A x = b, x >= 0 with free multipliers; Q = 0: a linear program,
 * whose matrix has no principal submatrix to start from. */
TEST(programs_with_equations_are_solved)
{
    static problem p;
    double z[N];
    rb_lcp_info info;
    for (int k = 0; k < 200; k++) {
        const int m = 1 + k % 7, n = 2 * m + 3, linear = k % 2;
        p.n = n + m;
        memset(p.M, 0, sizeof p.M);
        no_boxes(&p);
        for (int j = 0; j < n; j++) {
            p.M[j + j * p.n] = !linear;
            p.q[j] = linear ? 1.0 + uniform() : uniform();
        }
        for (int i = 0; i < m; i++) {
            p.q[n + i] = 0.0;
            p.lower[n + i] = -INFINITY;
            for (int j = 0; j < n; j++) {
                const double a = uniform(), x = j % 2 ? 0.0 : 1.0; /* A x = b has x >= 0 */
                p.M[n + i + j * p.n] = a;
                p.M[j + (n + i) * p.n] = -a;
                p.q[n + i] -= a * x;
            }
        }
        CHECK_OK(solve_mixed(&p, NULL, z, &info));
        CHECK_MAX(natural_residual(&p, z), 1e-11 * (1.0 + rb_norm_inf((size_t)p.n, z)),
                  "program %d", k);
    }
}

/* Which bounds hold is changed until all signs are right: three to five systems. */
static int by_active_set(const block *b, double *z)
{
    const int n = b->n;
    int steps = 0, wrong = 1;
    SCRATCH int *held = calloc((size_t)n, sizeof *held);
    SCRATCH double *w = malloc((size_t)n * sizeof *w), *rhs = malloc((size_t)n * sizeof *rhs);
    for (; wrong && steps < 20; steps++) {
        OWNED(rb_sparse) A;
        rb_triplets t = {.rows = n, .cols = n};
        rb_sparse_cholesky *factor;
        for (int i = 0; i < n; i++)
            z[i] = held[i] ? b->lower[i] : 0.0, rhs[i] = -b->q[i];
        rb_sparse_apply(-1.0, &b->K, z, 1.0, rhs);
        for (int j = 0; j < n; j++)
            for (int k = b->K.p[j]; k < b->K.p[j + 1]; k++)
                if (!held[j] && !held[b->K.i[k]])
                    rb_triplets_add(&t, b->K.i[k], j, b->K.x[k]);
        for (int i = 0; i < n; i++)
            if (held[i])
                rb_triplets_add(&t, i, i, 1.0), rhs[i] = z[i];
        CHECK_OK(rb_sparse_from_triplets(&t, &A));
        rb_triplets_free(&t);
        CHECK_OK(rb_sparse_cholesky_create(&A, &factor));
        CHECK_OK(rb_sparse_cholesky_solve(factor, rhs, z));
        rb_sparse_cholesky_free(factor);
        memcpy(w, b->q, (size_t)n * sizeof *w);
        rb_sparse_apply(1.0, &b->K, z, 1.0, w);
        wrong = 0;
        for (int i = 0; i < n; i++) {
            const int now = held[i] ? w[i] > -1e-13 : z[i] < b->lower[i];
            wrong += now != held[i];
            held[i] = now;
        }
    }
    return steps;
}

/* Twin rows of split variables tie in every step: at 70 by 35 squares rounding errors led
 * the path of such a problem back to its beginning, which it called a ray. */
TEST(a_block_on_an_obstacle_takes_few_pivots)
{
    static const int sizes[] = {20, 40, 70};
    for (int k = 0; k < 3; k++) {
        OWNED(block) b;
        rb_lcp_info info;
        CHECK_OK(block_create(sizes[k], 0, &b));
        SCRATCH double *z = malloc((size_t)b.n * sizeof *z),
                       *want = malloc((size_t)b.n * sizeof *want);
        const rb_lcp_mixed_problem p = {&b.K, b.q, b.lower, NULL};
        SCRATCH double *upper = malloc((size_t)b.n * sizeof *upper);
        for (int i = 0; i < b.n; i++)
            upper[i] = INFINITY;
        const rb_lcp_mixed_problem boxed = {p.M, p.q, p.lower, upper};
        CHECK_OK(rb_lcp_mixed(&boxed, NULL, z, &info));
        CHECK_MAX(info.iters, 8, "pivots at %d", sizes[k]);
        CHECK_MAX(info.scaled, 1e-14, "residual at %d", sizes[k]);
        CHECK_MAX(by_active_set(&b, want), 8, "systems at %d", sizes[k]);
        for (int i = 0; i < b.n; i++)
            CHECK_ABS(z[i], want[i], 1e-12, "%d squares, z(%d)", sizes[k], i + 1);
    }
}

/* Nothing holds the block but the obstacle, which has no friction: the free z have a
 * singular matrix, and halves of them lead to a solution. */
TEST(a_block_that_floats_is_solved)
{
    OWNED(block) b;
    rb_lcp_info info;
    CHECK_OK(block_create(10, 1, &b));
    SCRATCH double *z = malloc((size_t)b.n * sizeof *z), *w = malloc((size_t)b.n * sizeof *w);
    const rb_lcp_mixed_problem p = {&b.K, b.q, b.lower, NULL};
    CHECK_OK(rb_lcp_mixed(&p, NULL, z, &info));
    CHECK_MAX(rb_lcp_residual_mixed(&p, z, w), 1e-13, "residual");
    double carried = 0.0;
    for (int i = 0; i < b.n; i++)
        carried += i % 2 ? w[i] : 0.0;
    CHECK_REL(carried, 0.01 * 11, 1e-12, "the obstacle carries the forces");
}

/* A free z of which no row knows anything: w is a number, which must be zero. */
TEST(a_free_z_without_a_column)
{
    static problem p = {2, {1, 0, 0, 0}, {-1, 0}, {0, -INFINITY}, {INFINITY, INFINITY}};
    double z[N];
    rb_lcp_info info;
    CHECK_OK(solve_mixed(&p, NULL, z, &info));
    CHECK_ABS(z[0], 1.0, 0.0, "z(1)");
    p.q[1] = 1.0;
    CHECK_STATUS(solve_mixed(&p, NULL, z, &info), RB_NO_SOLUTION);
}

/* ---- From a given point ------------------------------------------------------------ */

TEST(a_solution_is_recognised_and_a_neighbour_is_near)
{
    static problem p;
    double z[N], from[N];
    rb_lcp_info info;
    int cold = 0, warm = 0;
    rb_lcp_options opt = rb_lcp_defaults();
    opt.start = from;
    for (int k = 0; k < 200; k++) {
        positive_definite(2 + k % (N - 1), &p);
        random_boxes(&p, 5);
        CHECK_OK(solve_mixed(&p, NULL, from, &info));
        CHECK_OK(solve_mixed(&p, &opt, z, &info));
        assert_int_equal(info.iters, 0);
        for (int i = 0; i < p.n; i++)
            p.q[i] += 0.05 * uniform();
        CHECK_OK(solve_mixed(&p, NULL, z, &info));
        cold += info.iters;
        CHECK_OK(solve_mixed(&p, &opt, z, &info));
        CHECK_MAX(natural_residual(&p, z), 1e-11 * (1.0 + rb_norm_inf((size_t)p.n, z)),
                  "problem %d", k);
        warm += info.iters;
    }
    CHECK_MAX(warm, 0.2 * cold, "pivots");
}

/* Every third z is inside its box, the others at their bounds; there every second w is 0. */
static void plant_at_bounds(int n, double side, problem *p, double *z)
{
    positive_definite(n, p);
    for (int i = 0; i < n; i++) {
        const double bound = uniform() / 3.0;
        z[i] = bound + (i % 3 ? 0.0 : side * (1.5 + uniform()));
        p->lower[i] = side > 0.0 ? bound : -INFINITY;
        p->upper[i] = side > 0.0 ? INFINITY : bound;
        p->q[i] = i % 3 == 1 ? side * (1.5 + uniform()) : 0.0;
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            p->q[i] -= p->M[i + j * n] * z[j];
}

/* Where z(i) is at its bound and w(i) = 0 both may be basic in the end; what the path has
 * brought to its bound is handed out as that bound and not as a number next to it.  From
 * a start a little inside, z(i) is at its bound but for rounding of either sign, and no
 * pivot is needed. */
TEST(a_degenerate_solution_is_exactly_at_its_bounds)
{
    static problem p;
    double z[N], want[N], from[N];
    rb_lcp_info info;
    rb_lcp_options opt = rb_lcp_defaults();
    opt.start = from;
    for (int k = 0; k < 100; k++) {
        const double side = k % 2 ? -1.0 : 1.0;
        plant_at_bounds(12, side, &p, want);
        CHECK_OK(solve_mixed(&p, NULL, z, &info));
        for (int i = 0; i < p.n; i++) {
            CHECK_ABS(z[i], want[i], i % 3 ? 0.0 : 1e-12, "problem %d, z(%d)", k, i + 1);
            from[i] = want[i] + (i % 3 == 2 ? 1e-3 * side : 0.0);
        }
        CHECK_OK(solve_mixed(&p, &opt, z, &info));
        assert_int_equal(info.iters, 0);
        for (int i = 0; i < p.n; i++) {
            CHECK_ABS(z[i], want[i], 1e-12, "problem %d, z(%d)", k, i + 1);
            assert_true(p.lower[i] <= z[i] && z[i] <= p.upper[i]);
        }
    }
}

typedef struct {
    double first, last;      /* t after the first pivot of a path, and now */
    int paths, pivots, gone; /* begun; of the last one; given up because t had grown */
    int n;
} heights;

static void watch_t(const rb_lcp_pivot *pivot, void *context)
{
    heights *h = context;
    if (pivot->entering == 2 * pivot->n) {
        h->gone += h->paths && h->last > h->first * (1.0 + 1e-9);
        h->paths++;
        h->pivots = 0;
        h->first = pivot->z0;
    } else if (h->paths == 1) { /* from the start: t may not be above its first value */
        assert_true(h->last <= h->first * (1.0 + 1e-9));
    }
    h->last = pivot->z0;
    h->pivots++;
}

/* Without a P-matrix t can grow: from a start that is no sign of a solution nearby, and
 * the path begins anew at the bounds. */
TEST(a_start_that_leads_away_is_given_up)
{
    static problem p;
    double z[N], from[N];
    rb_lcp_info info;
    rb_lcp_options opt = rb_lcp_defaults();
    heights h;
    int gone = 0;
    opt.start = from;
    opt.trace = watch_t;
    opt.trace_context = &h;
    for (int k = 0; k < 200; k++) {
        p.n = 2 + k % 20;
        for (int i = 0; i < p.n * p.n; i++)
            p.M[i] = uniform();
        for (int i = 0; i < p.n; i++) {
            p.q[i] = 3.0 * uniform();
            p.lower[i] = 0.0;
            p.upper[i] = 1.5 + uniform();
            from[i] = uniform() > 0.0 ? p.upper[i] : 0.5 * p.upper[i];
        }
        h = (heights){0};
        CHECK_OK(solve_mixed(&p, &opt, z, &info));
        CHECK_MAX(natural_residual(&p, z), 1e-11, "problem %d", k);
        assert_true(h.paths <= 2);
        gone += h.gone;
    }
    assert_true(gone > 10);
}

TEST(limits_end_the_path)
{
    static problem p;
    double z[N];
    rb_lcp_info info;
    rb_lcp_options opt = rb_lcp_defaults();
    positive_definite(30, &p);
    opt.max_iters = 2;
    CHECK_STATUS(solve_mixed(&p, &opt, z, &info), RB_MAXITER);
    assert_int_equal(info.iters, 2);
    assert_non_null(strstr(info.msg.text, "max_iters = 2"));
    opt.max_iters = 0;
    opt.seconds = 1e-12;
    CHECK_STATUS(solve_mixed(&p, &opt, z, &info), RB_TIME_LIMIT);
    CHECK_STATUS(rb_lcp_lemke(&(rb_lcp_problem){p.n, p.M, p.n, p.q}, &opt, z, &info),
                 RB_TIME_LIMIT);
    opt.seconds = 100.0;
    CHECK_OK(solve_mixed(&p, &opt, z, &info));
}

/* M = [0 -1; 1 0]: the submatrix of z(1) alone is singular. */
TEST(a_start_without_basis_begins_at_the_bounds)
{
    static problem p = {2, {0, 1, -1, 0}, {1, -1}, {0}, {0}};
    const double from[] = {1.0, 0.0};
    double z[2];
    rb_lcp_options opt = rb_lcp_defaults();
    opt.start = from;
    no_boxes(&p);
    CHECK_OK(solve_mixed(&p, &opt, z, NULL));
    CHECK_MAX(natural_residual(&p, z), 1e-15, "residual");
}

/* ---- Large ------------------------------------------------------------------------- */

/* The obstacle problem on m x m points, M: minus the five-point Laplacian. */
static void obstacle(int m, rb_sparse *M, double *q)
{
    OWNED(rb_triplets) t = {.rows = m * m, .cols = m * m};
    const double h = 1.0 / (m + 1);
    for (int k = 0; k < m * m; k++) {
        const int i = k % m, j = k / m;
        const int next[5] = {k, i > 0 ? k - 1 : -1, i + 1 < m ? k + 1 : -1, j > 0 ? k - m : -1,
                             j + 1 < m ? k + m : -1};
        q[k] = h * h;
        for (int s = 0; s < 5; s++) {
            if (next[s] < 0)
                q[k] -= 0.02;
            else
                rb_triplets_add(&t, k, next[s], s ? -1.0 : 4.0);
        }
    }
    CHECK_OK(rb_sparse_from_triplets(&t, M));
}

TEST(a_large_obstacle_is_solved_as_by_newton)
{
    enum { SIDE = 40 };
    static double q[SIDE * SIDE], z[SIDE * SIDE], want[SIDE * SIDE];
    OWNED(rb_sparse) M;
    rb_lcp_info info;
    obstacle(SIDE, &M, q);
    CHECK_OK(rb_lcp_newton(&M, q, NULL, want, &info));
    CHECK_OK(rb_lcp_mixed(&(rb_lcp_mixed_problem){.M = &M, .q = q}, NULL, z, &info));
    assert_true(info.iters < SIDE * SIDE);
    CHECK_MAX(info.res, 1e-15, "residual");
    for (int i = 0; i < SIDE * SIDE; i++)
        CHECK_ABS(z[i], want[i], 1e-14, "z(%d)", i + 1);
}

/* ---- Ends and bad input ------------------------------------------------------------ */

TEST(a_ray_names_its_variable)
{
    static problem p = {1, {-1}, {-1}, {0}, {0}};
    double z[1];
    rb_lcp_info info;
    no_boxes(&p);
    CHECK_STATUS(solve_mixed(&p, NULL, z, &info), RB_NO_SOLUTION);
    assert_int_equal(info.ray_variable, 1);
    assert_non_null(strstr(info.msg.text, "z(1)"));
    p.upper[0] = 3.0; /* the box stops it */
    CHECK_OK(solve_mixed(&p, NULL, z, &info));
    CHECK_REL(z[0], 3.0, 1e-15, "z(1)");
}

/* w(1) = z(2) + q(1) >= 0 and w(2) = -z(1) + q(2) >= 0 with z >= lower: solvable where the
 * bound of z(1) allows it, by however little. */
TEST(a_ray_proves_what_is_so)
{
    static problem p = {2, {0, -1, 1, 0}, {0}, {0}, {0}};
    double z[N];
    rb_lcp_info info;
    no_boxes(&p);
    for (int k = 0; k < 40; k++) {
        const double low = k % 4 - 2.0, far = pow(10.0, k % 7 - 3);
        const int open = k % 2;
        p.lower[0] = p.lower[1] = low * far;
        p.q[0] = (-low - 1.0) * far;
        p.q[1] = (low + (open ? 1e-3 : -1e-3)) * far;
        CHECK_STATUS(solve_mixed(&p, NULL, z, &info), open ? RB_OK : RB_NO_SOLUTION);
        if (open)
            CHECK_MAX(natural_residual(&p, z), 1e-12 * far, "case %d", k);
    }
    /* z <= 1 where w <= 0: w = -z - 2 < 0 there; w = 2 - z > 0 everywhere */
    static problem q = {1, {-1.0}, {-2.0}, {-INFINITY}, {1.0}};
    CHECK_OK(solve_mixed(&q, NULL, z, &info));
    CHECK_MAX(natural_residual(&q, z), 0.0, "at its upper bound or not");
    q.q[0] = 2.0;
    CHECK_STATUS(solve_mixed(&q, NULL, z, &info), RB_NO_SOLUTION);
}

TEST(bad_input_is_named)
{
    static problem p;
    double z[N];
    const double bad[] = {NAN, 0.0}, none[] = {0.0, 0.0};
    rb_lcp_info info;
    rb_lcp_options opt = rb_lcp_defaults();
    positive_definite(2, &p);
    p.q[0] = -1.0;
    p.lower[1] = 2.0;
    p.upper[1] = 1.0;
    CHECK_STATUS(solve_mixed(&p, NULL, z, &info), RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "bounds 2 are [2, 1]"));
    p.lower[1] = INFINITY;
    p.upper[1] = INFINITY;
    CHECK_STATUS(solve_mixed(&p, NULL, z, &info), RB_EINVAL);
    p.lower[1] = -INFINITY;
    p.upper[1] = -INFINITY;
    CHECK_STATUS(solve_mixed(&p, NULL, z, &info), RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "bounds 2 are [-inf, -inf]"));
    no_boxes(&p);
    opt.max_iters = -1;
    CHECK_STATUS(solve_mixed(&p, &opt, z, &info), RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "max_iters = -1"));
    opt.max_iters = 0;
    p.upper[0] = NAN;
    CHECK_STATUS(solve_mixed(&p, NULL, z, &info), RB_EINVAL);
    no_boxes(&p);
    opt.start = bad;
    CHECK_STATUS(solve_mixed(&p, &opt, z, &info), RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "start(1) = nan"));
    opt.start = NULL;
    opt.cover = bad;
    CHECK_STATUS(solve_mixed(&p, &opt, z, &info), RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "cover(1) = nan"));
    opt.cover = none;
    CHECK_STATUS(solve_mixed(&p, &opt, z, &info), RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "cover(1) = 0"));
    const double negative[] = {1.0, -1.0}, endless[] = {1.0, INFINITY};
    opt.cover = negative;
    CHECK_STATUS(solve_mixed(&p, &opt, z, &info), RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "cover(2) = -1"));
    opt.cover = endless;
    CHECK_STATUS(solve_mixed(&p, &opt, z, &info), RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "cover(2) = inf"));
    p.M[0] = NAN;
    CHECK_STATUS(solve_mixed(&p, NULL, z, &info), RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "M(1, 1) = nan"));
    rb_sparse wide, empty = {.rows = 0};
    CHECK_OK(rb_sparse_from_dense(1, 2, endless, 1, &wide));
    CHECK_STATUS(rb_lcp_mixed(&(rb_lcp_mixed_problem){.M = &wide, .q = p.q}, NULL, z, &info),
                 RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "M is 1 by 2"));
    CHECK_STATUS(rb_lcp_newton(&empty, p.q, NULL, z, &info), RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "M is 0 by 0"));
    rb_sparse_free(&wide);
    /* of what is no number the residual is none */
    const double one[] = {1.0}, no[] = {NAN};
    OWNED(rb_sparse) M;
    CHECK_OK(rb_sparse_from_dense(1, 1, one, 1, &M));
    assert_true(isnan(rb_lcp_residual_mixed(&(rb_lcp_mixed_problem){.M = &M, .q = one}, no, z)));
    assert_true(isnan(rb_lcp_residual_mixed(&(rb_lcp_mixed_problem){.M = &M, .q = no}, one, z)));
    assert_true(isnan(rb_lcp_residual(&(rb_lcp_problem){1, one, 1, no}, one, z)));
}

static rb_status solve_anew(void *context)
{
    double z[N];
    return rb_lcp_mixed(context, NULL, z, NULL);
}

TEST(short_memory_is_reported)
{
    static problem p;
    positive_definite(6, &p);
    p.lower[2] = -INFINITY;
    OWNED(rb_sparse) M;
    CHECK_OK(rb_sparse_from_dense(p.n, p.n, p.M, p.n, &M));
    for (int i = 0, refused = 1; refused; i++) {
        double z[N];
        refused = REFUSED_FROM(
            i, rb_lcp_mixed(&(rb_lcp_mixed_problem){&M, p.q, p.lower, p.upper}, NULL, z, NULL));
    }
    rb_lcp_mixed_problem one = {&M, p.q, p.lower, p.upper};
    assert_true(alloc_fail_each(solve_anew, &one) > 5);
}

/* -1.1e-4 z1 - 1e-8 z2 = 23.75 has no z >= 0; the other row is 300 decades larger and
 * once hid that by its own w. */
TEST(a_large_row_hides_no_wrong_one)
{
    int row[] = {0, 1, 0, 1}, col[] = {0, 0, 1, 1};
    double x[] = {-1.12e-4, 1e300, -1e-8, 1e154}, q[] = {-23.75, -24.5};
    const double lower[] = {0.0, 0.0}, upper[] = {INFINITY, INFINITY};
    double z[2];
    OWNED(rb_sparse) M;
    rb_lcp_info info;
    CHECK_OK(rb_sparse_from_triplets(
        &(rb_triplets){.rows = 2, .cols = 2, .nz = 4, .row = row, .col = col, .x = x}, &M));
    assert_int_not_equal(rb_lcp_mixed(&(rb_lcp_mixed_problem){.M = &M, .q = q}, NULL, z, &info),
                         RB_OK);
    assert_int_not_equal(rb_lcp_mixed(&(rb_lcp_mixed_problem){&M, q, lower, upper}, NULL, z, &info),
                         RB_OK);
}

RUN_TESTS(NULL, NULL)
