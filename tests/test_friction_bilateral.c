/* Bilateral constraints in friction problems: eliminated, they give what the whole saddle
 * point system says. */
#define _XOPEN_SOURCE 700
#include "check.h"
#include "friction_problems.h"
#include "lcp/friction/friction.h"
#include "base/io/io_fclib.h"
#include "numbers.h"

#include <unistd.h>

enum { DOFS = 14, CONTACTS = 3, ROWS = 3 * CONTACTS, JOINTS = 4 };

/* x of A x = b by elimination with row pivoting; A: n x n row-major, spoilt. */
static void solve_dense(int n, double *A, double *x)
{
    for (int k = 0; k < n; k++) {
        int best = k;
        for (int i = k + 1; i < n; i++)
            if (fabs(A[i * n + k]) > fabs(A[best * n + k]))
                best = i;
        for (int j = 0; j < n; j++) {
            const double a = A[k * n + j];
            A[k * n + j] = A[best * n + j];
            A[best * n + j] = a;
        }
        const double b = x[k];
        x[k] = x[best];
        x[best] = b;
        for (int i = 0; i < n; i++) {
            const double factor = i == k ? 0.0 : A[i * n + k] / A[k * n + k];
            for (int j = k; j < n && factor != 0.0; j++)
                A[i * n + j] -= factor * A[k * n + j];
            x[i] -= factor * x[k];
        }
    }
    for (int k = 0; k < n; k++)
        x[k] /= A[k * n + k];
}

/* A structure with joints, dense: K, H, G, f, w, b.  loose: K has no stiffness on the
 * last degree of freedom, which only the joints hold. */
typedef struct {
    double K[DOFS * DOFS], H[DOFS * ROWS], G[DOFS * JOINTS]; /* column-major */
    double f[DOFS], w[ROWS], b[JOINTS];
} structure;

static void make_structure(unsigned seed, int loose, structure *s)
{
    double A[DOFS * DOFS];
    for (int k = 0; k < DOFS * DOFS; k++)
        A[k] = uniform_from(&seed);
    for (int i = 0; i < DOFS; i++)
        for (int j = 0; j < DOFS; j++) {
            double sum = i == j;
            for (int k = 0; k < DOFS; k++)
                sum += A[i + k * DOFS] * A[j + k * DOFS];
            s->K[i + j * DOFS] = loose && (i == DOFS - 1 || j == DOFS - 1) ? 0.0 : sum;
        }
    for (int k = 0; k < DOFS * ROWS; k++)
        s->H[k] = k % DOFS == DOFS - 1 ? 0.0 : uniform_from(&seed);
    for (int k = 0; k < DOFS * JOINTS; k++) /* each joins some motions only */
        s->G[k] = (k % 5 == 0 || k % DOFS == DOFS - 1) ? uniform_from(&seed) : 0.0;
    for (int i = 0; i < DOFS; i++)
        s->f[i] = 3.0 * uniform_from(&seed);
    for (int k = 0; k < ROWS; k++)
        s->w[k] = (k % 3 ? 1.0 : -1.0) * fabs(uniform_from(&seed));
    for (int c = 0; c < JOINTS; c++)
        s->b[c] = uniform_from(&seed);
}

static void copy(size_t n, const double *from, double **to)
{
    *to = rb_alloc(n, 1);
    memcpy(*to, from, n * sizeof *from);
}

static void as_problem(const structure *s, rb_friction_problem *p, rb_sparse *G)
{
    *p = (rb_friction_problem){.form = RB_FRICTION_GLOBAL,
                               .dimension = 3,
                               .contacts = CONTACTS,
                               .dofs = DOFS,
                               .mu = rb_alloc(CONTACTS, 1)};
    for (int c = 0; c < CONTACTS; c++)
        p->mu[c] = 0.4;
    CHECK_OK(rb_sparse_from_dense(DOFS, DOFS, s->K, DOFS, &p->K));
    CHECK_OK(rb_sparse_from_dense(DOFS, ROWS, s->H, DOFS, &p->H));
    CHECK_OK(rb_sparse_from_dense(DOFS, JOINTS, s->G, DOFS, G));
    copy(DOFS, s->f, &p->f);
    copy(ROWS, s->w, &p->w);
}

/* u that goes with r: v and l of K v - G l = H r + f, G'v = -b, then u = H'v + w. */
static void velocities(const structure *s, const double *r, double *u)
{
    enum { N = DOFS + JOINTS };
    static double A[N * N];
    double x[N] = {0.0};
    memset(A, 0, sizeof A);
    for (int i = 0; i < DOFS; i++) {
        for (int j = 0; j < DOFS; j++)
            A[i * N + j] = s->K[i + j * DOFS];
        for (int c = 0; c < JOINTS; c++) {
            A[i * N + DOFS + c] = -s->G[i + c * DOFS];
            A[(DOFS + c) * N + i] = s->G[i + c * DOFS];
        }
        x[i] = s->f[i];
        for (int k = 0; k < ROWS; k++)
            x[i] += s->H[i + k * DOFS] * r[k];
    }
    for (int c = 0; c < JOINTS; c++)
        x[DOFS + c] = -s->b[c];
    solve_dense(N, A, x);
    for (int k = 0; k < ROWS; k++) {
        u[k] = s->w[k];
        for (int i = 0; i < DOFS; i++)
            u[k] += s->H[i + k * DOFS] * x[i];
    }
}

/* Coulomb's law contact by contact; largest violation. */
static double violation(double mu, const double *r, const double *u)
{
    double worst = 0.0;
    for (int c = 0; c < CONTACTS; c++) {
        const double *rc = r + 3 * c, *uc = u + 3 * c;
        const double rt = hypot(rc[1], rc[2]), ut = hypot(uc[1], uc[2]);
        worst = fmax(worst, fmax(-rc[0], -uc[0]));
        worst = fmax(worst, fmax(rt - mu * rc[0], fabs(rc[0] * uc[0])));
        worst = fmax(worst, fabs(mu * rc[0] * ut + rc[1] * uc[1] + rc[2] * uc[2]));
    }
    return worst;
}

static void solve_and_assess(const structure *s, const rb_friction_problem *p, double *r)
{
    double u[ROWS], want[ROWS];
    rb_friction_options opt = rb_friction_defaults();
    rb_friction_info info;
    opt.tol = 1e-11;
    CHECK_OK(rb_friction_solve("auto", p, &opt, &(rb_friction_solution){r, u, NULL}, &info));
    velocities(s, r, want);
    for (int k = 0; k < ROWS; k++)
        CHECK_ABS(u[k], want[k], 1e-9, "u[%d]", k);
    CHECK_MAX(violation(0.4, r, want), 1e-8, "Coulomb's law on the saddle point system");
}

TEST(eliminated_constraints_are_those_of_the_saddle_point)
{
    int loaded = 0;
    for (unsigned seed = 1; seed <= 40; seed++) {
        structure s;
        OWNED(rb_friction_problem) p;
        OWNED(rb_sparse) G;
        double r[ROWS];
        make_structure(seed, seed % 2, &s);
        as_problem(&s, &p, &G);
        CHECK_OK(rb_friction_eliminate(&p, &G, s.b, &message));
        assert_int_equal(p.dofs, DOFS - JOINTS);
        solve_and_assess(&s, &p, r);
        loaded += r[0] > 0.0 || r[3] > 0.0 || r[6] > 0.0;
    }
    assert_true(loaded > 20);
}

/* The local form with V = H'K^-1 G, R = G'K^-1 G, s = b + G'K^-1 f. */
static void make_local(const structure *s, rb_io_fclib *file)
{
    enum { M = ROWS + JOINTS };
    double B[DOFS * M], X[DOFS * M], A[DOFS * DOFS], free_v[DOFS];
    double W[ROWS * ROWS], V[ROWS * JOINTS], R[JOINTS * JOINTS];
    memcpy(B, s->H, sizeof s->H);
    memcpy(B + DOFS * ROWS, s->G, sizeof s->G);
    for (int k = 0; k <= M; k++) {
        double *x = k < M ? X + k * DOFS : free_v;
        memcpy(x, k < M ? B + k * DOFS : s->f, DOFS * sizeof *x);
        for (int i = 0; i < DOFS * DOFS; i++)
            A[i] = s->K[i];
        solve_dense(DOFS, A, x);
    }
    *file = (rb_io_fclib){.spacedim = 3, .contacts = CONTACTS, .constraints = JOINTS};
    copy(ROWS, s->w, &file->q);
    copy(JOINTS, s->b, &file->s);
    file->mu = rb_alloc(CONTACTS, 1);
    for (int c = 0; c < CONTACTS; c++)
        file->mu[c] = 0.4;
    for (int j = 0; j < M; j++)
        for (int i = 0; i < M; i++) {
            double x = 0.0;
            for (int k = 0; k < DOFS; k++)
                x += B[k + i * DOFS] * X[k + j * DOFS];
            if (i < ROWS && j < ROWS)
                W[i + j * ROWS] = x;
            else if (i < ROWS)
                V[i + (j - ROWS) * ROWS] = x;
            else if (j >= ROWS)
                R[i - ROWS + (j - ROWS) * JOINTS] = x;
        }
    for (int i = 0; i < M; i++)
        for (int k = 0; k < DOFS; k++)
            *(i < ROWS ? file->q + i : file->s + i - ROWS) += B[k + i * DOFS] * free_v[k];
    CHECK_OK(rb_sparse_from_dense(ROWS, ROWS, W, ROWS, &file->W));
    CHECK_OK(rb_sparse_from_dense(ROWS, JOINTS, V, ROWS, &file->V));
    CHECK_OK(rb_sparse_from_dense(JOINTS, JOINTS, R, JOINTS, &file->R));
}

/* With the arrays of the file. */
static rb_friction_problem local_of(const rb_io_fclib *file)
{
    return (rb_friction_problem){.form = RB_FRICTION_LOCAL_SPARSE,
                                 .dimension = 3,
                                 .contacts = CONTACTS,
                                 .mu = file->mu,
                                 .q = file->q,
                                 .Ws = file->W};
}

TEST(both_forms_come_from_files)
{
    char path[] = "/tmp/rollbem-bilateral-XXXXXX";
    close(mkstemp(path));
    for (unsigned seed = 50; seed < 56; seed++) {
        structure s;
        rb_friction_problem p;
        rb_io_fclib file[2];
        double r[2][ROWS];
        make_structure(seed, 0, &s);
        make_local(&s, &file[0]);
        file[1] =
            (rb_io_fclib){.global = 1, .spacedim = 3, .contacts = CONTACTS, .constraints = JOINTS};
        as_problem(&s, &p, &file[1].G);
        file[1].M = p.K, file[1].H = p.H, file[1].mu = p.mu;
        file[1].f = p.f, file[1].w = p.w;
        copy(JOINTS, s.b, &file[1].b);
        for (int k = 0; k < 2; k++) {
            CHECK_OK(rb_io_fclib_write(path, &file[k], (rb_io_fclib_layout)(seed % 3), "", "",
                                       &message));
            CHECK_OK(rb_friction_read(path, &p, &message));
            solve_and_assess(&s, &p, r[k]);
            rb_friction_problem_free(&p);
            rb_io_fclib_free(&file[k]);
        }
        for (int i = 0; i < ROWS; i++)
            CHECK_ABS(r[0][i], r[1][i], 1e-8, "r[%d] of both forms", i);
    }
    unlink(path);
}

TEST(redundant_constraints_drop_out)
{
    structure s;
    OWNED(rb_friction_problem) p, q;
    rb_sparse G, more = {0};
    double r[ROWS], again[ROWS], wide[DOFS * (JOINTS + 2)], b[JOINTS + 2];
    make_structure(7, 0, &s);
    as_problem(&s, &p, &G);
    as_problem(&s, &q, &more);
    rb_sparse_free(&more);
    memcpy(wide, s.G, sizeof s.G);
    memcpy(b, s.b, sizeof s.b);
    for (int i = 0; i < DOFS; i++) { /* the sum of two, and one in other units */
        wide[i + JOINTS * DOFS] = s.G[i] - 2.0 * s.G[i + DOFS];
        wide[i + (JOINTS + 1) * DOFS] = 1e7 * s.G[i + 2 * DOFS];
    }
    b[JOINTS] = b[0] - 2.0 * b[1];
    b[JOINTS + 1] = 1e7 * b[2];
    CHECK_OK(rb_sparse_from_dense(DOFS, JOINTS + 2, wide, DOFS, &more));
    CHECK_OK(rb_friction_eliminate(&p, &G, s.b, &message));
    CHECK_OK(rb_friction_eliminate(&q, &more, b, &message));
    assert_int_equal(q.dofs, DOFS - JOINTS);
    solve_and_assess(&s, &p, r);
    solve_and_assess(&s, &q, again);
    for (int k = 0; k < ROWS; k++)
        CHECK_ABS(again[k], r[k], 1e-8, "r[%d]", k);
    rb_sparse_free(&more);
    rb_sparse_free(&G);
}

/* Two masses of 1 on the ground, mu = 1/2, joined by a rod along it; both fall at speed
 * 1, one is pushed along by `push`.  The friction is at most 1 in all. */
TEST(a_rod_slides_or_sticks_as_a_whole)
{
    for (int slides = 0; slides < 2; slides++) {
        int at[] = {0, 1, 2, 3}, rod[] = {1, 3}, first[] = {0, 0};
        double one[] = {1.0, 1.0, 1.0, 1.0}, apart[] = {1.0, -1.0}, none[] = {0.0};
        const double push = slides ? 3.0 : 0.8;
        OWNED(rb_sparse) G;
        rb_friction_info info;
        double r[4], u[4];
        OWNED(rb_friction_problem)
        p = zero_global(2, 2, 4);
        CHECK_OK(rb_sparse_from_triplets(
            &(rb_triplets){.rows = 4, .cols = 4, .nz = 4, .row = at, .col = at, .x = one}, &p.K));
        CHECK_OK(rb_sparse_from_triplets(
            &(rb_triplets){.rows = 4, .cols = 4, .nz = 4, .row = at, .col = at, .x = one}, &p.H));
        CHECK_OK(rb_sparse_from_triplets(
            &(rb_triplets){.rows = 4, .cols = 1, .nz = 2, .row = rod, .col = first, .x = apart},
            &G));
        p.mu[0] = p.mu[1] = 0.5;
        p.f[0] = p.f[2] = -1.0, p.f[1] = push;
        CHECK_OK(rb_friction_eliminate(&p, &G, none, &message));
        assert_int_equal(p.dofs, 3);
        CHECK_OK(rb_friction_solve(NULL, &p, NULL, &(rb_friction_solution){r, u, NULL}, &info));
        CHECK_ABS(r[0], 1.0, 1e-7, "r_N");
        CHECK_ABS(r[2], 1.0, 1e-7, "r_N");
        CHECK_ABS(r[1] + r[3], slides ? -1.0 : -0.8, 1e-7, "friction");
        CHECK_ABS(u[1], slides ? 1.0 : 0.0, 1e-7, "speed");
        CHECK_ABS(u[3], u[1], 1e-12, "the rod keeps its length");
    }
}

TEST(what_cannot_be_is_refused)
{
    structure s;
    rb_friction_problem p;
    rb_sparse G, bad = {0};
    const double b[] = {1.0, 1.5, NAN};
    int row[] = {0, 3, 0, 3}, col[] = {0, 0, 1, 1};
    double x[] = {1.0, -1.0, 2.0, -2.0};
    int all[DOFS];
    double ones[DOFS];
    make_structure(3, 0, &s);
    as_problem(&s, &p, &G);
    CHECK_OK(rb_sparse_from_triplets(
        &(rb_triplets){.rows = DOFS, .cols = 2, .nz = 4, .row = row, .col = col, .x = x}, &bad));
    CHECK_SAYS(rb_friction_eliminate(&p, &bad, b, &message), RB_EINVAL, "contradict");
    CHECK_SAYS(rb_friction_eliminate(&p, &bad, b + 1, &message), RB_EINVAL, "b: entry 2 is");
    CHECK_SAYS(rb_friction_eliminate_local(&p, &bad, &bad, b, &message), RB_EINVAL, "local form");
    bad.x[0] = NAN;
    CHECK_SAYS(rb_friction_eliminate(&p, &bad, b, &message), RB_EINVAL, "entry 1 is nan");
    rb_sparse_free(&bad);
    CHECK_OK(rb_sparse_from_triplets(
        &(rb_triplets){.rows = DOFS + 1, .cols = 2, .nz = 4, .row = row, .col = col, .x = x},
        &bad));
    CHECK_SAYS(rb_friction_eliminate(&p, &bad, b, &message), RB_EINVAL, "G is 15 x 2");
    rb_sparse_free(&bad);
    for (int i = 0; i < DOFS; i++)
        all[i] = i, ones[i] = 1.0;
    CHECK_OK(rb_sparse_from_triplets(
        &(rb_triplets){.rows = DOFS, .cols = DOFS, .nz = DOFS, .row = all, .col = all, .x = ones},
        &bad));
    CHECK_SAYS(rb_friction_eliminate(&p, &bad, s.f, &message), RB_EINVAL, "no motion");
    rb_sparse_free(&bad);
    assert_int_equal(p.dofs, DOFS); /* the problem is what it was */
    assert_memory_equal(p.f, s.f, sizeof s.f);
    assert_memory_equal(p.w, s.w, sizeof s.w);
    rb_sparse_free(&G);
    rb_friction_problem_free(&p);

    /* R = 0 leaves l undetermined and constrains r */
    OWNED(rb_io_fclib) file;
    make_local(&s, &file);
    p = local_of(&file);
    for (int k = 0; k < file.R.p[JOINTS]; k++)
        file.R.x[k] = 0.0;
    CHECK_SAYS(rb_friction_eliminate_local(&p, &file.V, &file.R, file.s, &message), RB_EINVAL,
               "R has rank 0 of 4");
    CHECK_SAYS(rb_friction_eliminate_local(&p, &file.R, &file.R, file.s, &message), RB_EINVAL,
               "V is 4 x 4");
    CHECK_SAYS(rb_friction_eliminate_local(&p, &file.V, &file.V, file.s, &message), RB_EINVAL,
               "R is 9 x 4");
    CHECK_SAYS(rb_friction_eliminate(&p, &file.V, file.s, &message), RB_EINVAL, "global form");
}

static void put_dense(const rb_sparse *W, double *dense)
{
    for (int j = 0; j < W->cols; j++)
        for (int k = W->p[j]; k < W->p[j + 1]; k++)
            dense[W->i[k] + j * W->rows] = W->x[k];
}

/* A dense W becomes a sparse one, the same as from a sparse one. */
TEST(dense_problems_lose_their_constraints_alike)
{
    enum { M = 3 * CONTACTS };
    double W[2][M * M] = {{0.0}};
    rb_friction_problem p[2];

    for (int k = 0; k < 2; k++) {
        structure s;
        OWNED(rb_io_fclib) file;
        make_structure(9, 0, &s);
        make_local(&s, &file);
        p[k] = local_of(&file);
        if (k == 1) {
            p[k].form = RB_FRICTION_LOCAL_DENSE;
            p[k].W = calloc(M * M, sizeof(double));
            put_dense(&file.W, p[k].W);
            rb_sparse_free(&file.W);
            p[k].Ws = (rb_sparse){0};
        }
        file.mu = file.q = NULL, file.W = (rb_sparse){0};
        CHECK_OK(rb_friction_eliminate_local(&p[k], &file.V, &file.R, file.s, &message));
        assert_int_equal(p[k].form, RB_FRICTION_LOCAL_SPARSE);
        put_dense(&p[k].Ws, W[k]);
    }
    for (int i = 0; i < M * M; i++)
        CHECK_ABS(W[1][i], W[0][i], 1e-15, "W, entry %d", i);
    for (int i = 0; i < M; i++)
        CHECK_ABS(p[1].q[i], p[0].q[i], 0.0, "q(%d)", i);
    rb_friction_problem_free(&p[0]);
    rb_friction_problem_free(&p[1]);
}

TEST(failing_allocations_leave_the_problem)
{
    structure s;
    rb_io_fclib file;
    make_structure(9, 0, &s);
    for (int global = 0; global < 2; global++) {
        rb_status st = RB_ENOMEM;
        int count = 0;
        for (; st != RB_OK && count < 200; count++) {
            OWNED(rb_friction_problem) p;
            make_local(&s, &file);
            if (global) {
                rb_sparse_free(&file.V);
                as_problem(&s, &p, &file.V);
            } else {
                p = local_of(&file);
                file.mu = file.q = NULL, file.W = (rb_sparse){0};
            }
            alloc_fail_after(count);
            st = global ? rb_friction_eliminate(&p, &file.V, s.b, &message)
                        : rb_friction_eliminate_local(&p, &file.V, &file.R, file.s, &message);
            alloc_succeed();
            assert_true(st == RB_OK || st == RB_ENOMEM);
            CHECK_OK(rb_friction_problem_check(&p, &message));
            rb_io_fclib_free(&file);
        }
        assert_true(count > 8 && count < 200);
    }
}

RUN_TESTS(NULL, NULL)
