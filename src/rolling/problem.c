#include "rolling/reduced.h"

#include <cblas.h>

#include <float.h>
#include <stdlib.h>
#include <string.h>

void rb_rolling_problem_free(rb_rolling_problem *p)
{
    free(p->S);
    free(p->outside);
    free(p->product);
    rb_rolling_krylov_free(p->krylov);
    rb_rolling_factors_free(p->factors);
    free(p->d_N);
    free(p->d_T);
    free(p->e_T);
    free(p->load_N);
    free(p->load_T);
    free(p->force_N);
    free(p->force_T);
    free(p->moment_N);
    free(p->moment_T);
    memset(p, 0, sizeof *p);
}

static rb_status problem_alloc(int n, int dense, rb_rolling_problem *p)
{
    double **const vectors[] = {&p->d_N,    &p->d_T,     &p->e_T,    &p->load_N,
                                &p->load_T, &p->force_N, &p->force_T,
                                &p->moment_N, &p->moment_T};
    int complete = 1;

    memset(p, 0, sizeof *p);
    p->n = n;
    if (dense)
        p->S = rb_alloc((size_t)n, 2 * (size_t)n);
    else
        p->product = rb_alloc(4 * (size_t)n + 2, 1);
    for (size_t k = 0; k < sizeof vectors / sizeof *vectors; k++) {
        *vectors[k] = rb_alloc((size_t)n, 1);
        complete = complete && *vectors[k];
    }
    if ((p->S || p->product) && complete)
        return RB_OK;
    rb_rolling_problem_free(p);
    return RB_ENOMEM;
}

/* Row i of A w for the tangential displacement w of the n elements and the one upstream;
 * outside: of one element downstream and the second one upstream. */
static double kinematic(const rb_rolling_problem *p, const double *w,
                        const double outside[2], int i)
{
    const double *a = p->stencil;
    if (!p->outside)
        return p->steady ? w[i] - w[i + 1] : w[i];
    const double before = i > 0 ? w[i - 1] : outside[0],
                 second = i + 1 < p->n ? w[i + 2] : outside[1];
    return a[0] * before + a[1] * w[i] + a[2] * w[i + 1] + a[3] * second;
}

void rb_rolling_add_slip(const rb_rolling_problem *p, const double *r, const double *w_T,
                         double *slip)
{
    double outside[2] = {0.0, 0.0};
    for (int j = 0; p->outside && j < 2 * p->n; j++)
        for (int k = 0; k < 2; k++)
            outside[k] += p->outside[2 * (size_t)j + (size_t)k] * r[j];
    for (int i = 0; i < p->n; i++)
        slip[i] += kinematic(p, w_T, outside, i);
}

/* S = A [F_TN F_TT] (K2). */
static void set_kinematic_operator(const rb_rolling_bodies *bodies, rb_rolling_problem *p)
{
    const int n = p->n, m = n + 1;
    const double none[2] = {0.0, 0.0};

    for (int j = 0; j < 2 * n; j++) {
        const double *w_T = bodies->F + (size_t)j * 2 * (size_t)m + m;
        const double *outside = p->outside ? p->outside + 2 * (size_t)j : none;
        for (int i = 0; i < n; i++)
            p->S[i + (size_t)j * n] = kinematic(p, w_T, outside, i);
    }
}

/* The member t of the family of second-order differences whose leading edge is not
 * shifted (theory.md 4.7): ((1-t)/4, (3+3t)/4, -(5+3t)/4, (1+t)/4). */
static rb_status set_stencil(const rb_rolling_case *rc, const rb_rolling_bodies *bodies,
                             rb_rolling_problem *p)
{
    const double t = 0.0740956;

    p->steady = rc->formulation == RB_STEADY;
    if (!p->steady || rc->slip_operator == RB_SLIP_UPSTREAM) {
        p->stencil[1] = 1.0;
        p->stencil[2] = p->steady ? -1.0 : 0.0;
        return RB_OK;
    }
    p->stencil[0] = (1.0 - t) / 4.0;
    p->stencil[1] = (3.0 + 3.0 * t) / 4.0;
    p->stencil[2] = -(5.0 + 3.0 * t) / 4.0;
    p->stencil[3] = (1.0 + t) / 4.0;
    p->outside = rb_alloc(2, 2 * (size_t)p->n);
    return p->outside ? rb_rolling_displacement_outside(rc, bodies, p->outside)
                      : RB_ENOMEM;
}

/* d_T and e_T (K2).  Here, in kinematic and in `upstream` lives the formulation. */
void rb_rolling_set_past(const rb_rolling_case *rc, const rb_rolling_bodies *bodies,
                         const rb_rolling_past *past, double step, rb_rolling_problem *p)
{
    const int n = p->n, m = n + 1;
    const double *x = bodies->f.x, *w0_T = bodies->f.w0 + m;

    for (int i = 0; i < n; i++) {
        p->d_T[i] = p->steady ? w0_T[i] - w0_T[i + 1] : w0_T[i];
        if (past)
            p->d_T[i] -= past->w_T[i];
        p->e_T[i] = rc->formulation == RB_STEADY      ? x[i + 1] - x[i]
                    : rc->formulation == RB_TRANSIENT ? step
                                                      : 1.0;
    }
}

void rb_rolling_set_gap(const rb_rolling_mesh *mesh, const rb_rolling_bodies *bodies,
                        rb_rolling_problem *p)
{
    for (int i = 0; i < p->n; i++)
        p->d_N[i] = mesh->gap[i] + bodies->f.w0[i];
}

/* Vertical and horizontal force of unit tractions along n and t. */
static void set_weights(const rb_rolling_case *rc, const rb_rolling_bodies *bodies,
                        rb_rolling_problem *p)
{
    for (int i = 0; i < p->n; i++) {
        const double h = bodies->f.h[i];
        const double sine =
            rc->normals == RB_BEM_NORMALS_SURFACE ? bodies->f.x[i] / rc->a.radius : 0.0;
        const double cosine = sqrt(1.0 - sine * sine);
        p->load_N[i] = h * cosine;
        p->load_T[i] = h * sine;
        p->force_N[i] = -h * sine;
        p->force_T[i] = h * cosine;
        p->moment_N[i] = bodies->f.x[i] * p->load_N[i];
        p->moment_T[i] = bodies->f.x[i] * p->load_T[i];
    }
}

double rb_rolling_wanted_shift(const rb_rolling_case *rc)
{
    if (!isnan(rc->shift))
        return rc->shift;
    const rb_rolling_derived d = rb_rolling_derive(rc);
    return isnan(d.load) ? 0.1 * d.approach : 0.0;
}

/* Given values of theory.md 4.6.  The creepage ratio refers to the Hertz half-width of
 * the load: under approach control an estimate, which model.c corrects after a solve. */
void rb_rolling_set_control(const rb_rolling_case *rc, rb_rolling_problem *p)
{
    const rb_rolling_derived d = rb_rolling_derive(rc);

    p->load_given = !isnan(d.load);
    p->load = d.load;
    p->delta = d.approach;
    p->force = p->force_ratio = p->xi = 0.0;
    p->force_given = rc->mu > 0.0 && rb_rolling_force_is_given(rc);
    p->axle = rc->free_axle ? 1.0 / rb_rolling_radius(rc) : 0.0;
    if (p->axle > 0.0)
        return;
    if (p->force_given && !isnan(rc->force_ratio))
        p->force_ratio = rc->force_ratio;
    else if (p->force_given && p->load_given)
        p->force_ratio = rc->force / (rc->mu * d.load);
    else if (p->force_given)
        p->force = rc->force;
    else if (rc->formulation == RB_STATIC)
        p->xi = rb_rolling_wanted_shift(rc);
    else if (!isnan(rc->creep_ratio))
        p->xi = rc->creep_ratio * rc->mu * d.half_width / d.radius;
    else
        p->xi = isnan(rc->creep) ? 0.0 : rc->creep;
}

void rb_rolling_force_row(const rb_rolling_problem *p, double *control_N,
                          double *control_T)
{
    for (int i = 0; i < p->n; i++) {
        const double share = p->force_ratio * p->mu;
        control_N[i] = p->force_N[i] - share * p->load_N[i] + p->axle * p->moment_N[i];
        control_T[i] = p->force_T[i] - share * p->load_T[i] + p->axle * p->moment_T[i];
    }
}

/* ---- Products, and what the scales need of them ---------------------------------------
 */

/* y += A x; separated elements at the ends cost nothing. */
static void add_product(int n, const double *A, int lda, const double *x, double *y)
{
    int from = 0, to = n;

    while (from < to && x[from] == 0.0)
        from++;
    while (from < to && x[to - 1] == 0.0)
        to--;
    if (from < to)
        cblas_dgemv(CblasColMajor, CblasNoTrans, n, to - from, 1.0,
                    A + (size_t)from * (size_t)lda, lda, x + from, 1, 1.0, y, 1);
}

void rb_rolling_add_products(const rb_rolling_problem *problem, const double *p,
                             const double *q, double *gap, double *slip)
{
    const int n = problem->n;
    const size_t half = (size_t)n;

    if (!problem->F) {
        double *r = problem->product, *w = r + 2 * half;
        memcpy(r, p, half * sizeof *r);
        memcpy(r + half, q, half * sizeof *r);
        rb_bem_flexibility_apply(&problem->f, r, w);
        for (int i = 0; i < n; i++)
            gap[i] += w[i];
        rb_rolling_add_slip(problem, r, w + half + 1, slip);
        return;
    }
    add_product(n, problem->F, problem->ldf, p, gap);
    add_product(n, problem->S + half * half, n, q, slip);
    if (problem->coupled) {
        add_product(n, problem->F + half * (size_t)problem->ldf, problem->ldf, q, gap);
        add_product(n, problem->S, n, p, slip);
    }
}

/* Sizes of the answers to unit tractions: the scales are made of them. */
typedef struct {
    double gap, slip;    /* diagonals of F_NN and A F_TT */
    double coupled_slip; /* that unit pressures leave at the middle element */
    double reach; /* sum of a row of F_NN over its diagonal, where F is not dense */
    int coupled;
} response;

static double mean_diagonal(int n, const double *M, size_t ld)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++)
        sum += fabs(M[i + (size_t)i * ld]);
    return sum / n;
}

static int any_nonzero(int n, const double *M, int ld)
{
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            if (M[i + (size_t)j * (size_t)ld] != 0.0)
                return 1;
    return 0;
}

static void dense_response(const rb_rolling_problem *p, response *unit)
{
    const size_t n = (size_t)p->n;

    unit->gap = mean_diagonal(p->n, p->F, (size_t)p->ldf);
    unit->slip = mean_diagonal(p->n, p->S + n * n, n);
    unit->coupled_slip = cblas_dasum(p->n, p->S + n / 2, p->n);
    unit->coupled = any_nonzero(p->n, p->S, p->n) ||
                    any_nonzero(p->n, p->F + n * (size_t)p->ldf, p->ldf);
}

/* On equal elements the middle one stands for all. */
static rb_status product_response(const rb_rolling_problem *p, response *unit)
{
    const int n = p->n, j = n / 2;
    double *r = rb_alloc((size_t)n, 6);
    if (!r)
        return RB_ENOMEM;
    double *none = r + n, *N = none + n, *T = N + 2 * (size_t)n;

    r[j] = 1.0;
    rb_rolling_add_products(p, r, none, N, N + n);
    rb_rolling_add_products(p, none, r, T, T + n);
    unit->gap = fabs(N[j]);
    unit->slip = fabs(T[n + j]);
    unit->coupled_slip = cblas_dasum(n, N + n, 1);
    unit->coupled = unit->coupled_slip != 0.0;
    unit->reach = cblas_dasum(n, N, 1) / unit->gap;
    free(r);
    return RB_OK;
}

/* Stress by Hertz, lengths so that the diagonals of F_NN and of A F_TT become about 1;
 * where mu is small, the slip of dissimilar bodies comes from the pressure. */
static void set_scales(const rb_rolling_case *rc, const response *unit,
                       rb_rolling_problem *p)
{
    const double friction = (p->mu > 0.0 ? p->mu : 1.0) * unit->slip;

    p->stress = rb_rolling_derive(rc).stress;
    p->gap_length = p->stress * unit->gap;
    p->slip_length = p->stress * fmax(friction, unit->coupled_slip);
    p->coupled = unit->coupled;
    p->rounding = 64.0 * DBL_EPSILON * unit->reach;
}

/* F and S themselves, or products with f. */
static rb_status set_operators(const rb_rolling_case *rc, const rb_rolling_bodies *bodies,
                               rb_rolling_problem *p, response *unit)
{
    p->f = bodies->f;
    p->F = bodies->F;
    p->ldf = 2 * bodies->f.m;
    const rb_status status = set_stencil(rc, bodies, p);
    if (status != RB_OK)
        return status;
    if (p->F) {
        set_kinematic_operator(bodies, p);
        dense_response(p, unit);
        return rb_rolling_factors_create(&p->factors);
    }
    const rb_status s = product_response(p, unit);
    return s == RB_OK ? rb_rolling_krylov_create(p, &p->krylov) : s;
}

rb_status rb_rolling_problem_create(const rb_rolling_case *rc,
                                    const rb_rolling_mesh *mesh,
                                    const rb_rolling_bodies *bodies,
                                    const rb_rolling_past *past, double step,
                                    rb_rolling_problem *p, rb_message *why)
{
    response unit = {0};
    rb_status s = problem_alloc(mesh->n, bodies->F != NULL, p);

    if (s == RB_OK)
        s = set_operators(rc, bodies, p, &unit);
    if (s != RB_OK) {
        rb_rolling_problem_free(p);
        return rb_fail(why, s, "out of memory for a contact problem of %d elements", mesh->n);
    }
    p->mu = rc->mu;
    rb_rolling_set_gap(mesh, bodies, p);
    rb_rolling_set_past(rc, bodies, past, step, p);
    set_weights(rc, bodies, p);
    rb_rolling_set_control(rc, p);
    set_scales(rc, &unit, p);
    return RB_OK;
}
