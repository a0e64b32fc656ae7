/* Each attempt of Lemke's method on plane problems by itself: what one of them fails at
 * is made good by the next, so that a solve tells nothing of them. */
#include "check.h"
#include "friction_problems.h"
#include "lcp/friction/internal.h"
#include "numbers.h"

enum { NC = 7, M = 2 * NC, DOFS = M + 3 };

static unsigned long long seed = 5;

static double uniform(void)
{
    return uniform_of(&seed);
}

typedef enum { DENSE, SPARSE, FILLED, HELD, LOOSE, KINDS } kind;

/* Every third contact is open, sticks or slips; the last one is without friction. */
static void plant(rb_friction_problem *p, double *r, double *u)
{
    for (int c = 0; c < NC; c++) {
        const double sign = c % 2 ? 1.0 : -1.0;
        p->mu[c] = c == NC - 1 ? 0.0 : 0.2 + 0.05 * c;
        r[2 * c] = c % 3 == 0 ? 0.0 : 1.5 + uniform();
        u[2 * c] = c % 3 == 0 ? 1.5 + uniform() : 0.0;
        u[2 * c + 1] = c % 3 == 1 && p->mu[c] > 0.0 ? 0.0 : sign * (1.5 + uniform());
        r[2 * c + 1] = -sign * p->mu[c] * r[2 * c] * (u[2 * c + 1] == 0.0 ? 0.5 : 1.0);
    }
}

/* W in units of 1000: two of three contacts know nothing of the others where it is
 * sparse. */
static void local_problem(kind k, rb_friction_problem *p)
{
    double r[M], u[M];
    *p = zero_local(2, NC);
    for (int j = 0; j < M; j++)
        for (int i = 0; i <= j; i++)
            p->W[i + j * M] = p->W[j + i * M] = i == j ? 3000.0 + 1000.0 * uniform()
                                                : k == SPARSE && i / 2 != j / 2 ? 0.0
                                                                                : 200.0 * uniform();
    plant(p, r, u);
    for (int i = 0; i < M; i++) {
        p->q[i] = u[i];
        for (int j = 0; j < M; j++)
            p->q[i] -= p->W[i + j * M] * r[j];
    }
    if (k == DENSE)
        return;
    make_only_sparse(p);
}

/* A chain of springs, each of its ends a contact's displacement; LOOSE: held by nothing
 * but its contacts. */
static void global_problem(kind k, rb_friction_problem *p)
{
    double r[M], u[M], v[DOFS];
    rb_triplets K = {.rows = DOFS, .cols = DOFS}, H = {.rows = DOFS, .cols = M};
    *p = zero_global(2, NC, DOFS);
    plant(p, r, u);
    for (int i = 0; i < DOFS; i++) {
        v[i] = uniform();
        if (k == HELD)
            rb_triplets_add(&K, i, i, 0.3 + 0.01 * i);
        if (i + 1 == DOFS)
            continue;
        for (int a = 0; a < 4; a++)
            rb_triplets_add(&K, i + a % 2, i + a / 2, a % 3 ? -1.0 : 1.0);
    }
    for (int j = 0; j < M; j++) {
        rb_triplets_add(&H, j, j, 1.0);
        rb_triplets_add(&H, j + 2, j, 0.2 * uniform());
    }
    CHECK_OK(rb_sparse_from_triplets(&K, &p->K));
    CHECK_OK(rb_sparse_from_triplets(&H, &p->H));
    rb_triplets_free(&K);
    rb_triplets_free(&H);
    rb_sparse_apply(1.0, &p->K, v, 0.0, p->f); /* f = K v - H r, w = u - H'v */
    rb_sparse_apply(-1.0, &p->H, r, 1.0, p->f);
    memcpy(p->w, u, sizeof u);
    for (int j = 0; j < M; j++)
        for (int l = p->H.p[j]; l < p->H.p[j + 1]; l++)
            p->w[j] -= p->H.x[l] * v[p->H.i[l]];
}

static void make_problem(kind k, rb_friction_problem *p)
{
    if (k == HELD || k == LOOSE)
        global_problem(k, p);
    else
        local_problem(k, p);
}

/* u from r or v, and the imbalance of K v = H r + f; how much of Coulomb's law is broken. */
static double violation(const rb_friction_problem *p, const double *r, const double *v)
{
    double u[M], e[DOFS] = {0}, worst = 0.0;
    if (p->form == RB_FRICTION_GLOBAL) {
        memcpy(e, p->f, sizeof e);
        rb_sparse_apply(1.0, &p->H, r, 1.0, e);
        rb_sparse_apply(-1.0, &p->K, v, 1.0, e);
        worst = rb_norm_inf(DOFS, e);
        for (int j = 0; j < M; j++) {
            u[j] = p->w[j];
            for (int l = p->H.p[j]; l < p->H.p[j + 1]; l++)
                u[j] += p->H.x[l] * v[p->H.i[l]];
        }
    } else {
        memcpy(u, p->q, sizeof u);
        if (p->form == RB_FRICTION_LOCAL_SPARSE)
            rb_sparse_apply(1.0, &p->Ws, r, 1.0, u);
        for (int i = 0; i < M && p->form == RB_FRICTION_LOCAL_DENSE; i++)
            for (int j = 0; j < M; j++)
                u[i] += p->W[i + j * M] * r[j];
    }
    for (int c = 0; c < NC; c++) {
        const double rn = r[2 * c], rt = r[2 * c + 1], un = u[2 * c], ut = u[2 * c + 1];
        worst = fmax(worst, fabs(fmin(rn, un)));
        worst = fmax(worst, fabs(rt) - p->mu[c] * rn);
        if (fabs(ut) > 1e-9)
            worst = fmax(worst, fabs(rt + p->mu[c] * rn * (ut > 0.0 ? 1.0 : -1.0)));
    }
    return worst;
}

typedef struct {
    rb_friction_shared shared;
    rb_friction_record record;
    rb_friction_info info;
    rb_friction_task task;
    double r[M], u[M], v[DOFS], best[M + DOFS];
} bench;

static void prepare(const rb_friction_problem *p, bench *b)
{
    *b = (bench){.record = {.r = b->best, .error = INFINITY}};
    CHECK_OK(rb_friction_shared_init(p, &b->shared, NULL));
    b->task = (rb_friction_task){.shared = &b->shared,
                                 .problem = b->shared.problem,
                                 .measure = &b->shared.measure,
                                 .best = &b->record,
                                 .opt = rb_friction_defaults(),
                                 .info = &b->info,
                                 .d = 2,
                                 .contacts = NC,
                                 .m = M,
                                 .n = p->form == RB_FRICTION_GLOBAL ? DOFS : 0,
                                 .budget = INFINITY,
                                 .r = b->r,
                                 .u = b->u,
                                 .v = b->v};
}

/* Whether an attempt takes the problem: the first the tableau of a W that is dense, the
 * second any W, the third any W on a tableau, the others anything. */
static int is_taken(kind k, int attempt)
{
    const int with_w = k == DENSE || k == SPARSE || k == FILLED;
    return attempt == 1 ? k == DENSE || k == FILLED : attempt > 3 || with_w;
}

/* Operations of so many pivots and of the one measure that is taken: from the sizes. */
static double operations(kind k, int attempt, const rb_friction_problem *p, int pivots)
{
    const double n = 3.0 * NC, m = M;
    const double entries = p->form == RB_FRICTION_LOCAL_SPARSE ? p->Ws.p[M] : m * m;
    const double of_measure =
        25.0 * m + (k == HELD || k == LOOSE ? 4.0 * p->H.p[M] + 2.0 * p->K.p[DOFS] : 2.0 * entries);
    if (attempt == 2)
        return pivots * (4.5 * entries + 100.0 * m) + of_measure;
    return pivots * 2.0 * n * n + (attempt > 3 ? 8.0 / 3.0 * n * n * n : 0.0) + of_measure;
}

/* Paths in the displacement basis may end on a ray, and few do. */
TEST(every_attempt_solves_by_itself)
{
    enum { TRIALS = 10 };
    int solved[KINDS][RB_FRICTION_LEMKE_ATTEMPTS + 1] = {{0}};
    for (int trial = 0; trial < TRIALS * KINDS; trial++) {
        const kind k = (kind)(trial % KINDS);
        OWNED(rb_friction_problem) p;
        make_problem(k, &p);
        for (int a = 1; a <= RB_FRICTION_LEMKE_ATTEMPTS; a++) {
            static bench b;
            prepare(&p, &b);
            const rb_status s = rb_friction_run(&b.task, &rb_friction_lemke_method, a, 0);
            solved[k][a] += s == RB_OK;
            if (!is_taken(k, a))
                CHECK_STATUS(s, RB_SINGULAR);
            else if (s != RB_OK && s != RB_RAY)
                fail_msg("kind %d, attempt %d: %s", (int)k, a, rb_status_text(s));
            rb_friction_scale_back(&b.shared.scaling, b.r, NULL);
            if (s == RB_OK) {
                CHECK_MAX(violation(&p, b.r, b.v), 1e-9, "kind %d, attempt %d", (int)k, a);
                CHECK_REL(b.info.flops, operations(k, a, &p, b.info.iters), 1e-12,
                          "operations, kind %d, attempt %d", (int)k, a);
            }
            rb_friction_shared_free(&b.shared);
        }
    }
    for (kind k = 0; k < KINDS; k++)
        for (int a = 1; a <= RB_FRICTION_LEMKE_ATTEMPTS; a++)
            if (solved[k][a] < (is_taken(k, a) ? a <= 3 ? TRIALS : TRIALS / 2 : 0))
                fail_msg("kind %d, attempt %d: solved %d", (int)k, a, solved[k][a]);
}

/* Limits end an attempt; what went wrong first is what all of them together tell.  The
 * first three have no rays. */
TEST(limits_hold_for_every_attempt)
{
    OWNED(rb_friction_problem) p;
    make_problem(DENSE, &p);
    for (int a = 0; a <= 3; a++) {
        static bench b;
        prepare(&p, &b);
        b.task.opt.max_iters = 3;
        CHECK_STATUS(rb_friction_run(&b.task, &rb_friction_lemke_method, a, 0), RB_MAXITER);
        assert_int_equal(b.info.iters, 3);
        CHECK_STATUS(rb_friction_run(&b.task, &rb_friction_lemke_method, a, 0), RB_MAXITER);
        assert_int_equal(b.info.iters, 3);
        b.task.opt.max_iters = 0;
        b.task.deadline = rb_seconds() - 1.0;
        CHECK_STATUS(rb_friction_run(&b.task, &rb_friction_lemke_method, a, 0), RB_INTERRUPTED);
        rb_friction_shared_free(&b.shared);
    }
}

static rb_status solve_anew(void *context)
{
    static double r[M], u[M], v[DOFS];
    return rb_friction_solve("lemke", context, NULL, &(rb_friction_solution){r, u, v}, NULL);
}

TEST(short_memory_is_reported)
{
    int calls = 0; /* of all kinds together: a call fails once */
    for (kind k = 0; k < KINDS; k++) {
        OWNED(rb_friction_problem) p;
        make_problem(k, &p);
        calls += alloc_fail_each(solve_anew, &p);
    }
    assert_true(calls > 10);
}

RUN_TESTS(NULL, NULL)
