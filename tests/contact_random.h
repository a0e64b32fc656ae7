/* Contact problems of random numbers, without a wheel, and their judge: what a solver
 * hands back is checked by loops over the matrices here. */
#ifndef ROLLBEM_TESTS_CONTACT_RANDOM_H
#define ROLLBEM_TESTS_CONTACT_RANDOM_H

#include "check.h"
#include "lcp/contact/contact.h"

#include <string.h>

/* ---- Random problems --------------------------------------------------------------- */

static uint64_t numbers;

/* Of a generator that is the same everywhere. */
static inline double uniform(double least, double most)
{
    numbers = numbers * 6364136223846793005u + 1442695040888963407u;
    return least + (most - least) * ((double)(numbers >> 11) / 9007199254740992.0);
}

enum { LARGEST = 130, PADDING = 3 };

/* Scales that are no powers of one another: a wrong one shows. */
static const double STRESS = 240.0, GAP = 0.05, SLIP = 0.0125;

/* F with rows behind those of the gaps, which nobody may read. */
static double F[(LARGEST + PADDING) * 2 * LARGEST];

static int ldf;

typedef struct {
    int n;
    double mu, coupling;
    int load_given, force_given, axle;
    int yields; /* 0: no layer; 1: it hardens, 2: neither, 3: it softens */
    int order;  /* what has yielded: 0 stays, 1 and 2 follow the material by this order */
    int smooth; /* one element, without friction */
    int rolls;  /* slips are differences upstream, kernels those of a half-plane */
} kind;

/* Displacements at a distance d from a unit pressure, and from a unit friction at right
 * angles to it. */
static inline double normal_kernel(int d)
{
    return 1.0 - 0.5 * log(0.05 + d * d);
}

static inline double cross_kernel(const kind *of, int d)
{
    return of->coupling * ((d > 0) - (d < 0));
}

static inline void set_rolling_matrices(const kind *of, double *S)
{
    const int n = of->n;

    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const int d = i - j;
            F[i + j * ldf] = GAP / STRESS * (3.0 + normal_kernel(d));
            F[i + (n + j) * ldf] = -GAP / STRESS * cross_kernel(of, d);
            S[i + j * n] = SLIP / STRESS * (cross_kernel(of, d) - cross_kernel(of, d + 1));
            S[i + (n + j) * n] = SLIP / STRESS * (normal_kernel(d) - normal_kernel(d + 1));
        }
}

/* Gaps and slips fall with the distance; pressure makes slip and friction gaps, with the
 * signs of two bodies, as far as `coupling` says. */
static inline double *random_matrices(const kind *of)
{
    const int n = of->n;
    double *S = rb_alloc((size_t)n, 2 * (size_t)n);

    ldf = n + PADDING;
    for (size_t k = 0; k < sizeof F / sizeof *F; k++)
        F[k] = NAN;
    if (of->rolls) {
        set_rolling_matrices(of, S);
        return S;
    }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const double near = exp(-0.7 * abs(i - j));
            const double odd = (i - j) * near * of->coupling * uniform(0.8, 1.2);
            F[i + j * ldf] = GAP / STRESS * near;
            F[i + (n + j) * ldf] = GAP / STRESS * odd;
            S[i + j * n] = SLIP / STRESS * -odd;
            S[i + (n + j) * n] = SLIP / STRESS * near * (i <= j ? 1.0 : 0.6);
        }
    return S;
}

static inline void set_layer(const kind *of, rb_contact_problem *p)
{
    static const double recall[3][3] = {
        {0.0, 0.0, 1.0}, {1.0, 0.0, 1.0}, {4.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0}};
    static const double hardening[] = {0.0, 0.3, 0.0, -0.1};

    CHECK_OK(rb_contact_set_yield(p, 7.0, 8.0)); /* replaced by the next */
    CHECK_OK(rb_contact_set_yield(p, 0.5 * of->mu * STRESS,
                                  hardening[of->yields] * of->mu * STRESS / SLIP));
    memcpy(p->recall, recall[of->order], sizeof p->recall);
    p->own = recall[of->order][2];
}

static inline void random_problem(const kind *of, rb_contact_problem *p)
{
    const int n = of->n;
    rb_contact_operator *op;
    double *bound = rb_alloc((size_t)n, 1), total = 0.0;

    CHECK_OK(rb_contact_operator_dense(n, F, n + PADDING, random_matrices(of), &op));
    CHECK_OK(rb_contact_problem_alloc(op, p));
    p->stress = STRESS;
    p->gap_length = GAP;
    p->slip_length = SLIP;
    for (int i = 0; i < n; i++) {
        const double x = n > 1 ? 2.0 * i / (n - 1) - 1.0 : 0.0;
        p->d_N[i] = GAP * (2.5 * x * x - 1.5 + uniform(-0.1, 0.1));
        p->d_T[i] = SLIP * uniform(-0.2, 0.2);
        p->e_T[i] = uniform(0.9, 1.1);
        p->load_N[i] = uniform(0.9, 1.1);
        p->load_T[i] = uniform(-0.02, 0.02);
        p->force_N[i] = uniform(-0.02, 0.02);
        p->force_T[i] = uniform(0.9, 1.1);
        p->moment_N[i] = x * p->load_N[i];
        p->moment_T[i] = uniform(-0.02, 0.02);
        bound[i] = of->mu * uniform(0.8, 1.0);
        total += p->load_N[i];
    }
    bound[n / 2] = of->mu;
    if (of->smooth)
        bound[n / 3] = 0.0;
    rb_contact_set_friction(p, of->mu, bound);
    free(bound);
    p->load_given = of->load_given;
    p->load = 0.5 * STRESS * total;
    p->delta = 0.1 * GAP;
    p->xi = SLIP * uniform(-2.0, 2.0);
    p->sliding = 10.0 * SLIP;
    p->force_given = of->force_given > 0;
    if (of->force_given == 1)
        p->force_ratio = uniform(-0.6, 0.6);
    if (of->force_given == 2)
        p->force = 0.2 * of->mu * uniform(-1.0, 1.0) * p->load;
    if (of->axle)
        p->axle = 0.1 * of->mu;
    if (of->yields)
        set_layer(of, p);
}

static inline rb_contact_options options_of(rb_contact_solver solver)
{
    rb_contact_options options = rb_contact_defaults();

    options.solver = solver;
    options.tol = 1e-9;
    return options;
}

/* Gap and slip of element i, by a loop. */
static inline void move(const rb_contact_problem *p, const rb_contact_state *s, int i, double *gap,
                        double *slip)
{
    const double *S = rb_contact_operator_matrix(p->op).S;
    const int n = p->n;

    *gap = p->d_N[i] - s->delta;
    *slip = p->d_T[i] + s->xi * p->e_T[i];
    for (int j = 0; j < n; j++) {
        *gap += F[i + j * ldf] * s->p[j] + F[i + (n + j) * ldf] * s->q[j];
        *slip += S[i + j * n] * s->p[j] + S[i + (n + j) * n] * s->q[j];
    }
}

static inline double sum_of(int n, const double *a, const double *x, const double *b,
                            const double *y)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++)
        sum += a[i] * x[i] + b[i] * y[i];
    return sum;
}

/* Q - what was asked for, over what friction carries. */
static inline double force_error(const rb_contact_problem *p, const rb_contact_state *s,
                                 double *most)
{
    const int n = p->n;
    const double Q = sum_of(n, p->force_N, s->p, p->force_T, s->q);
    const double M = sum_of(n, p->moment_N, s->p, p->moment_T, s->q);

    *most = 0.0;
    for (int i = 0; i < n; i++)
        *most += p->bound[i] * (p->load_N[i] * s->p[i] + p->load_T[i] * s->q[i]);
    return Q - p->force - p->force_ratio * *most + p->axle * M;
}

/* Of two that are not negative and of which one is zero. */
static inline double conflict(double a, double b)
{
    return fabs(fmin(a, b));
}

/* Coulomb's law of a slip under the bound of |q|: a slip goes against q. */
static inline double coulomb(double slip, double q, double bound)
{
    return fmax(conflict(fmax(slip, 0.0), bound + q), conflict(fmax(-slip, 0.0), bound - q));
}

/* Coulomb's law and the layer's, scaled, from p, q, plastic, delta and xi. */
static inline double friction_residual(const rb_contact_problem *p, const rb_contact_state *s)
{
    const double mu_stress = STRESS * (p->mu > 0.0 ? p->mu : 1.0);
    double worst = 0.0, next = 0.0, second = 0.0;

    for (int i = p->n - 1; i >= 0; i--) {
        double gap, slip;
        move(p, s, i, &gap, &slip);
        const double plastic = p->yield ? s->plastic[i] : 0.0;
        const double q = s->q[i] / mu_stress, bound = p->bound[i] * s->p[i] / mu_stress;
        worst = fmax(worst, coulomb((slip - plastic) / SLIP, q, bound));
        if (p->yield) {
            const double u = p->recall[0] * next + p->recall[1] * second + p->own * fabs(plastic);
            const double yield = fmax(p->yield[i] + p->hardening * u, 0.0);
            worst = fmax(worst, coulomb(plastic / SLIP, q, yield / mu_stress));
            second = next;
            next = u;
        }
    }
    return worst;
}

/* The natural residual of the scaled problem, from p, q, plastic, delta and xi. */
static inline double residual_of(const rb_contact_problem *p, const rb_contact_state *s)
{
    double worst = friction_residual(p, s), most;

    for (int i = 0; i < p->n; i++) {
        double gap, slip;
        move(p, s, i, &gap, &slip);
        worst = fmax(worst, conflict(gap / GAP, s->p[i] / STRESS));
    }
    if (p->load_given)
        worst = fmax(worst, fabs(sum_of(p->n, p->load_N, s->p, p->load_T, s->q) / p->load - 1.0));
    if (p->force_given) {
        const double error = force_error(p, s, &most);
        worst = fmax(worst, fabs(error) / most);
    }
    return worst;
}

/* The zone of every element is what its tractions and slips do. */
static inline void check_zones(const rb_contact_problem *p, const rb_contact_state *s)
{
    for (int i = 0; i < p->n; i++) {
        const double limit = p->bound[i] * s->p[i], tiny = 1e-7 * STRESS;
        double gap, slip;
        move(p, s, i, &gap, &slip);
        CHECK_ABS(s->lambda[i], s->zone[i] == RB_ZONE_STICK && !p->yield ? 0.0 : slip, 1e-7 * SLIP,
                  "lambda %d, zone %d", i, s->zone[i]);
        if (s->zone[i] == RB_ZONE_SEPARATED)
            CHECK_ABS(fabs(s->p[i]) + fabs(s->q[i]), 0.0, tiny, "separated %d", i);
        if (s->zone[i] == RB_ZONE_SLIP_NEGATIVE)
            CHECK_ABS(s->q[i], -limit, tiny, "slips to +x %d", i);
        if (s->zone[i] == RB_ZONE_SLIP_POSITIVE)
            CHECK_ABS(s->q[i], limit, tiny, "slips to -x %d", i);
        if (s->zone[i] <= RB_ZONE_STICK)
            CHECK_ABS(s->plastic[i], 0.0, 0.0, "%d does not yield", i);
        if (s->zone[i] >= RB_ZONE_YIELD_NEGATIVE)
            assert_true(p->yield && fabs(s->plastic[i]) > 0.0);
    }
}

/* How often a problem was solved, refused, and not solved. */
typedef struct {
    int solved, refused, failed;
    int by_newton, steps; /* solves by Newton's method, and their steps */
} outcome;

static inline void check_outcome(const rb_contact_problem *p, const rb_contact_state *s,
                                 rb_status status, const rb_message *why, outcome *o)
{
    double Q, most;

    assert_int_equal(s->status, status == RB_EINVAL ? s->status : status);
    o->solved += status == RB_OK;
    o->refused += status == RB_EINVAL;
    o->failed += status > 0;
    o->by_newton += status == RB_OK && s->solver == RB_SOLVER_NEWTON;
    o->steps += status == RB_OK && s->solver == RB_SOLVER_NEWTON ? s->iterations : 0;
    if (status == RB_OK) {
        CHECK_MAX(residual_of(p, s), 1e-8, "n %d, mu %g, load %d, force %d", p->n, p->mu,
                  p->load_given, p->force_given);
        CHECK_ABS(s->residual, residual_of(p, s), 1e-10, "residual");
        check_zones(p, s);
    } else if (status == RB_EINVAL) {
        const char *carries = NOT_NULL(strstr(why->text, "carries at most"));
        assert_int_equal(sscanf(why->text, "force: Q = %lf", &Q), 1);
        assert_int_equal(sscanf(carries + strcspn(carries, "0123456789"), "%lf", &most), 1);
        assert_true(fabs(Q) > most);
    } else {
        assert_true(status > 0 && strstr(why->text, "scaled residual"));
    }
}

/* The same matrices behind products; the inverse is that of a diagonal. */
typedef struct {
    int n;
    double *S, *gap, *slip;
    int freed, products;
} by_products;

static inline void apply(void *context, const double *r, const double **gap, const double **slip)
{
    by_products *k = context;
    const int n = k->n;

    k->products++;
    for (int i = 0; i < n; i++) {
        k->gap[i] = k->slip[i] = 0.0;
        for (int j = 0; j < 2 * n; j++) {
            k->gap[i] += F[i + j * ldf] * r[j];
            k->slip[i] += k->S[i + j * n] * r[j];
        }
    }
    *gap = k->gap;
    *slip = k->slip;
}

static inline void divide(void *context, int tangential, double *line)
{
    const by_products *k = context;

    for (int i = 0; i < k->n; i++)
        line[i] *= STRESS / (tangential ? SLIP : GAP);
}

static inline void forget(void *context)
{
    by_products *k = context;
    free(k->S);
    free(k->gap);
    k->freed++;
}

/* p, its operator replaced by products of the same matrices. */
static inline void use_products(rb_contact_problem *p, by_products *k)
{
    const size_t n = (size_t)p->n;
    rb_contact_operator *op;

    *k = (by_products){p->n, rb_alloc(n, 2 * n), rb_alloc(n, 2), NULL, 0, 0};
    k->slip = k->gap + n;
    memcpy(k->S, rb_contact_operator_matrix(p->op).S, 2 * n * n * sizeof(double));
    const rb_contact_products by = {apply, divide, forget, k, NULL};
    CHECK_OK(rb_contact_operator_products(p->n, &by, &op));
    rb_contact_operator_free(p->op);
    p->op = op;
    p->rounding = 1e-9;
}

#endif
