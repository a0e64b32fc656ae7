/* The canonical SOCLCP, *Kanno* (1): y = M x + q, x and y in a product of Lorentz cones
 * and half-lines, x'y = 0; and friction brought to it by *Kanno* (10). */
#include "lcp/friction/smoothing.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LIMIT 400         /* Newton steps */
#define LEAST_PIVOT 1e-13 /* of lambda, which nothing fixes where r = 0 and eps -> 0 */
#define LEAST_SHIFT 1e-12 /* of W's own blocks, in the matrix only */

/* ---- The canonical form ------------------------------------------------------------ */

typedef struct {
    const rb_friction_soclcp_problem *p;
    double unit; /* y in units of x: the mean of M's diagonal is 1 */
    double tol, deadline;
    double *y, *s, *P; /* n; x - y; its projection */
    double *D;         /* largest cone squared */
    double *J;         /* n x n */
    int *pivots;
    double flops;
} canonical;

/* y in units of x, unit (M x + q) + eps x: eps x is the regularisation. */
static void image(canonical *c, double eps, const double *x, double *y)
{
    const int n = c->p->n;
    for (int i = 0; i < n; i++)
        y[i] = c->unit * c->p->q[i] + eps * x[i];
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            y[i] += c->unit * c->p->M[i + (size_t)j * (size_t)n] * x[j];
    c->flops += 2.0 * n * (double)n;
}

/* x - P_mu(x - y) */
static void canonical_residual(void *context, double mu, double eps, const double *x, double *H,
                               double *gap)
{
    canonical *c = context;
    image(c, eps, x, c->y);
    double least = INFINITY;
    for (int k = 0, at = 0; k < c->p->cones; at += c->p->size[k++]) {
        for (int a = at; a < at + c->p->size[k]; a++)
            c->s[a] = x[a] - c->y[a];
        least = fmin(least, rb_friction_smoothed(c->p->size[k], mu, c->s + at, c->P + at, NULL));
    }
    for (int i = 0; i < c->p->n; i++)
        H[i] = x[i] - c->P[i];
    if (gap)
        *gap = least;
}

/* The Newton step dx = -J^-1 H of the regularised problem, J = (I - D) + D (M + eps I) cone by
 * cone. */
static rb_status canonical_step(void *context, double mu, double eps, const double *x,
                                const double *H, double *dx)
{
    canonical *c = context;
    const int n = c->p->n;
    image(c, eps, x, c->y);
    for (int k = 0, at = 0; k < c->p->cones; at += c->p->size[k++]) {
        const int size = c->p->size[k];
        for (int a = at; a < at + size; a++)
            c->s[a] = x[a] - c->y[a];
        rb_friction_smoothed(size, mu, c->s + at, c->P + at, c->D);
        for (int j = 0; j < n; j++)
            for (int a = 0; a < size; a++) {
                double sum = at + a == j;
                for (int b = 0; b < size; b++) {
                    const double m = c->unit * c->p->M[at + b + (size_t)j * (size_t)n];
                    sum += c->D[a + b * size] * (m + (eps - 1.0) * (at + b == j));
                }
                c->J[at + a + (size_t)j * (size_t)n] = sum;
            }
        c->flops += 2.0 * size * (double)size * n;
    }
    for (int i = 0; i < n; i++)
        dx[i] = -H[i];
    c->flops += 2.0 / 3.0 * n * (double)n * n;
    const int info = LAPACKE_dgesv(LAPACK_COL_MAJOR, n, 1, c->J, n, c->pivots, dx, n);
    return rb_lapack_status(info);
}

static int canonical_late(void *context)
{
    const canonical *c = context;
    return c->deadline > 0.0 && rb_seconds() > c->deadline;
}

/* ||x - P(x - unit y)|| / ||unit q|| */
static double error_in(const rb_friction_soclcp_problem *p, double unit, const double *x, double *y)
{
    const int n = p->n;
    double sum = 0.0, norm = 0.0;
    for (int i = 0; i < n; i++) {
        y[i] = p->q[i];
        norm = hypot(norm, p->q[i]);
    }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            y[i] += p->M[i + (size_t)j * (size_t)n] * x[j];
    for (int k = 0, at = 0; k < p->cones; at += p->size[k++]) {
        const double s0 = x[at] - unit * y[at];
        double t = 0.0;
        for (int a = at + 1; a < at + p->size[k]; a++)
            t = hypot(t, x[a] - unit * y[a]);
        /* of s = x - unit y: P(s) = (p_0, g s_1) */
        double p0 = s0, g = 1.0;
        if (s0 <= -t) {
            p0 = g = 0.0;
        } else if (s0 < t) {
            p0 = 0.5 * (s0 + t);
            g = p0 / t;
        }
        double own = 0.0;
        for (int a = at + 1; a < at + p->size[k]; a++)
            own = hypot(own, x[a] - g * (x[a] - unit * y[a]));
        sum = hypot(sum, hypot(own, x[at] - p0));
    }
    return norm > 0.0 ? sum / (unit * norm) : sum;
}

double rb_friction_soclcp_error(const rb_friction_soclcp_problem *p, const double *x, double *y)
{
    return error_in(p, 1.0, x, y);
}

static int canonical_accepts(void *context, const double *x)
{
    canonical *c = context;
    return error_in(c->p, c->unit, x, c->y) <= c->tol;
}

rb_status rb_friction_solve_soclcp(const rb_friction_soclcp_problem *p,
                                   const rb_friction_options *opt, double *x, double *y,
                                   rb_friction_info *info)
{
    /* 1. The cones have to be a partition of the n entries, and all numbers finite. */
    const double start = rb_seconds();
    const rb_friction_options used = opt ? *opt : rb_friction_defaults();
    int largest = 0, sum = 0;
    rb_friction_info unwanted;
    if (!info)
        info = &unwanted;
    *info = (rb_friction_info){
        .solver = "soclcp-smoothing", .residual = INFINITY, .scaled = INFINITY, .contact = -1};
    rb_message *why = &info->msg;
    for (int k = 0; k < p->cones; k++) {
        if (p->size[k] < 1 || p->size[k] > p->n - sum)
            return rb_fail(why, RB_EINVAL,
                           "cone %d has dimension %d: expected 1 ... %d, what is left", k + 1,
                           p->size[k], p->n - sum);
        sum += p->size[k];
        if (p->size[k] > largest)
            largest = p->size[k];
    }
    if (p->n < 1 || sum != p->n)
        return rb_fail(why, RB_EINVAL, "cones hold %d of %d entries", sum, p->n);
    for (size_t k = 0; k < (size_t)p->n * (size_t)p->n; k++)
        if (!isfinite(p->M[k]))
            return rb_fail(why, RB_EINVAL, "M: entry %zu is %g", k + 1, p->M[k]);
    for (int i = 0; i < p->n; i++)
        if (!isfinite(p->q[i]))
            return rb_fail(why, RB_EINVAL, "q: entry %d is %g", i + 1, p->q[i]);
    /* 2. A unit for y: the inverse of the mean of M's diagonal; Acary's measure keeps the given
     * one. */
    double trace = 0.0;
    for (size_t i = 0; i < (size_t)p->n; i++)
        trace += fabs(p->M[i + i * (size_t)p->n]);
    const double unit = trace > 0.0 ? p->n / trace : 1.0;
    const int acary = used.measure == RB_FRICTION_BY_ACARY;
    const size_t n = (size_t)p->n;
    rb_arena scratch = {0};
    canonical c = {.p = p,
                   .unit = acary ? 1.0 : unit,
                   .tol = used.tol,
                   .deadline = used.seconds > 0.0 ? start + used.seconds : 0.0,
                   .y = rb_arena_doubles(&scratch, n, 1),
                   .s = rb_arena_doubles(&scratch, n, 1),
                   .P = rb_arena_doubles(&scratch, n, 1),
                   .D = rb_arena_doubles(&scratch, (size_t)largest, (size_t)largest),
                   .J = rb_arena_doubles(&scratch, n, n),
                   .pivots = rb_arena_ints(&scratch, n)};
    const rb_friction_smooth_problem smooth = {.n = p->n,
                                               .context = &c,
                                               .residual = canonical_residual,
                                               .step = canonical_step,
                                               .accepts = canonical_accepts,
                                               .late = canonical_late};
    /* 3. Smoothing from the start, then the errors from x alone. */
    for (int i = 0; i < p->n; i++)
        x[i] = used.r0 ? used.r0[i] : 0.0;
    rb_status s = RB_ENOMEM;
    if (!scratch.failed)
        s = rb_friction_smooth(&smooth, used.max_iters ? used.max_iters : LIMIT, x, &info->iters);
    rb_arena_free(&scratch);
    info->measure = used.measure;
    info->scaled = error_in(p, unit, x, y);
    info->residual = rb_friction_soclcp_error(p, x, y);
    info->flops = c.flops;
    info->seconds = rb_seconds() - start;
    if (s >= 0)
        s = rb_friction_deciding(info) <= used.tol ? RB_OK : s == RB_OK ? RB_INACCURATE : s;
    return s;
}

/* ---- Friction, *Kanno* (10) -------------------------------------------------------- */

/* Per contact, with rho bringing velocities to forces,
 *     x1 = (lambda, rho u_T),  y1 = (mu r_N + eps lambda, r_T + eps rho u_T)  in L^d,
 *     xn = rho u_N,            yn = r_N + eps rho u_N                         in R+,
 * and u + eps r / rho in the place of u, from r (local form) or from v with the balance
 * K v = H r + f (global form): one eps where the stiffness, the other where W is
 * singular. Unknowns z = (r, lambda, v). */
typedef struct {
    rb_friction_task *task;
    rb_friction_system system;
    double *u, *du;            /* m */
    rb_friction_linearised at; /* the step with lambda eliminated */
    double *solve_for;         /* 2 + 2 d per contact: lambda's row, see friction_step() */
} friction;

static double rho_of(const friction *f, int c)
{
    return fmin(f->system.rho[2 * c], f->system.rho[2 * c + 1]);
}

/* u (or its change: constant 0) with the regularisation of W */
static void regular_velocity(friction *f, double constant, double eps, const double *r,
                             const double *v, double *u)
{
    const rb_friction_task *t = f->task;
    rb_friction_system_velocity(&f->system, constant, r, v, u);
    for (int k = 0; k < t->m; k++)
        u[k] += eps / rho_of(f, k / t->d) * r[k];
}

/* x1, y1 (d each) of a contact */
static void first_cone(const friction *f, int c, double eps, const double *z, double *x, double *y)
{
    const rb_friction_task *t = f->task;
    const int d = t->d;
    const double rho = rho_of(f, c), *r = z + c * d;
    x[0] = z[t->m + c];
    y[0] = t->problem->mu[c] * r[0] + eps * x[0];
    for (int a = 1; a < d; a++) {
        x[a] = rho * f->u[c * d + a];
        y[a] = r[a] + eps * x[a];
    }
}

/* H: per contact d rows of the first cone and one of the half-line, then the n rows of the balance
 * of the global form. */
static void friction_residual(void *context, double mu, double eps, const double *z, double *H,
                              double *gap)
{
    friction *f = context;
    const rb_friction_task *t = f->task;
    const int d = t->d;
    const double *v = z + t->m + t->contacts;
    double least = INFINITY;
    regular_velocity(f, 1.0, eps, z, v, f->u);
    for (int c = 0; c < t->contacts; c++) {
        double x[3], y[3], s[3], P[3], *h = H + c * (d + 1);
        first_cone(f, c, eps, z, x, y);
        for (int a = 0; a < d; a++)
            s[a] = x[a] - y[a];
        least = fmin(least, rb_friction_smoothed(d, mu, s, P, NULL));
        for (int a = 0; a < d; a++)
            h[a] = x[a] - P[a];
        x[0] = rho_of(f, c) * f->u[c * d];
        s[0] = x[0] - (z[c * d] + eps * x[0]);
        least = fmin(least, rb_friction_smoothed(1, mu, s, P, NULL));
        h[d] = x[0] - P[0];
    }
    rb_friction_system_imbalance(&f->system, z, v, H + t->m + t->contacts);
    f->system.flops += 60.0 * t->contacts;
    if (gap)
        *gap = least;
}

static rb_status friction_step(void *context, double mu, double eps, const double *z,
                               const double *H, double *dz)
{
    friction *f = context;
    const rb_friction_task *t = f->task;
    const int d = t->d, nc = t->contacts;
    double *dlambda = dz + t->m, *dv = dz + t->m + nc;
    regular_velocity(f, 1.0, eps, z, z + t->m + nc, f->u);
    const double shift = fmax(eps, LEAST_SHIFT);
    /* A contact's d + 1 equations in (dr, rho du, dlambda) become d equations in (dr, du):
     * dlambda follows from the first one, of which keep = (pivot, h0, coefficients of dr,
     * of du). */
    for (int c = 0; c < nc; c++) {
        const double rho = rho_of(f, c), friction_mu = t->problem->mu[c], *h = H + c * (d + 1);
        double x[3], y[3], s[3], P[3], D[9], Q[9] = {0.0}, Dn[1];
        double *A = f->at.A + c * d * d, *B = f->at.B + c * d * d, *F = f->at.F + c * d;
        double *keep = f->solve_for + c * (2 + 2 * d);
        first_cone(f, c, eps, z, x, y);
        for (int a = 0; a < d; a++)
            s[a] = x[a] - y[a];
        rb_friction_smoothed(d, mu, s, P, D);
        for (int k = 0; k < d * d; k++)
            Q[k] = (k % (d + 1) == 0) + (eps - 1.0) * D[k];
        Q[0] = fmax(Q[0], LEAST_PIVOT);
        keep[0] = Q[0];
        keep[1] = h[0];
        for (int b = 0; b < d; b++) {
            keep[2 + b] = D[b * d] * (b ? 1.0 : friction_mu);
            keep[2 + d + b] = b ? rho * Q[b * d] : 0.0;
        }
        for (int a = 1; a < d; a++) {
            /* Gauss elimination of dlambda from the other rows of the contact. */
            const double g = Q[a] / Q[0];
            F[a] = h[a] - g * h[0];
            for (int b = 0; b < d; b++) {
                A[a + b * d] = D[a + b * d] * (b ? 1.0 : friction_mu) - g * keep[2 + b];
                B[a + b * d] = (b ? rho * Q[a + b * d] : 0.0) - g * keep[2 + d + b];
            }
        }
        const double un = rho * f->u[c * d], sn = un - (z[c * d] + eps * un);
        rb_friction_smoothed(1, mu, &sn, P, Dn);
        F[0] = h[d];
        for (int b = 0; b < d; b++)
            A[b * d] = B[b * d] = 0.0;
        A[0] = Dn[0];
        B[0] = rho * (1.0 + (eps - 1.0) * Dn[0]);
        for (int k = 0; k < d * d; k++)
            A[k] += shift / rho * B[k];
    }
    const rb_status st = rb_friction_system_step(&f->system, &f->at, H + t->m + nc, dz, dv);
    if (st != RB_OK)
        return st;
    regular_velocity(f, 0.0, shift, dz, dv, f->du);
    for (int c = 0; c < nc; c++) {
        const double *keep = f->solve_for + c * (2 + 2 * d);
        double sum = keep[1];
        for (int b = 0; b < d; b++)
            sum += keep[2 + b] * dz[c * d + b] + keep[2 + d + b] * f->du[c * d + b];
        dlambda[c] = -sum / keep[0];
        if (!isfinite(dlambda[c]))
            return RB_SINGULAR;
    }
    f->system.flops += 150.0 * nc;
    return RB_OK;
}

static int friction_accepts(void *context, const double *z)
{
    friction *f = context;
    rb_friction_task *t = f->task;
    memcpy(t->r, z, (size_t)t->m * sizeof *z);
    memcpy(t->v, z + t->m + t->contacts, (size_t)t->n * sizeof *z);
    return rb_friction_task_accepts(t, rb_friction_task_error(t));
}

static int friction_late(void *context)
{
    return rb_friction_task_late(((friction *)context)->task);
}

static rb_status run_smoothing(rb_friction_task *task, int variant)
{
    (void)variant;
    const size_t m = (size_t)task->m, d = (size_t)task->d, nc = (size_t)task->contacts;
    friction f = {.task = task};
    f.u = rb_alloc(m * (3 + 2 * d) + nc * (2 + 2 * d), 1);
    double *z = rb_alloc(m + nc + (size_t)task->n, 1);
    rb_status st = f.u && z ? rb_friction_system_init(task, task->n, &f.system) : RB_ENOMEM;
    if (st == RB_OK) {
        f.du = f.u + m;
        f.at.F = f.du + m;
        f.at.A = f.at.F + m;
        f.at.B = f.at.A + m * d;
        f.solve_for = f.at.B + m * d;
        rb_friction_task *t = f.task;
        const rb_friction_smooth_problem smooth = {
            .n = t->m + t->contacts + t->n,
            .context = &f,
            .residual = friction_residual,
            .step = friction_step,
            .accepts = friction_accepts,
            .late = friction_late,
        };
        memcpy(z, t->r, (size_t)t->m * sizeof *z);
        memcpy(z + t->m + t->contacts, t->v, (size_t)t->n * sizeof *z);
        const int limit = rb_friction_task_left(t, LIMIT);
        st = rb_friction_smooth(&smooth, limit, z, &t->info->iters);
        friction_accepts(&f, z);
        rb_friction_system_count(&f.system, task);
        rb_friction_system_free(&f.system);
    }
    free(z);
    free(f.u);
    return st;
}

const rb_friction_method rb_friction_smoothing_method = {.run = run_smoothing};
