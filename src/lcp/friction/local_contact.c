/* The problem of one contact: u = W r + q with its diagonal block W (d x d).
 *
 * Where W_NN > 0 the normal is eliminated: u_N = 0 gives r_N = -(q_N + W_NT r_T) / W_NN,
 * and sliding, u_T = -lambda r_T with lambda > 0, becomes
 *     (S + lambda) r_T = -b,   ||r_T|| = mu r_N,   S = W_TT - W_TN W_NT / W_NN,
 *                                                  b = q_T - W_TN q_N / W_NN,
 * one equation for lambda; lambda = 0 is stick.  With S positive definite and q_N < 0 it
 * has a root wherever the stuck contact leaves the cone. */
#include "lcp/friction/internal.h"

#include <math.h>

#define NEWTON_STEPS 20
#define PROJECTIONS 100

static void contact_velocity(int d, const double *W, const double *q, const double *r, double *u)
{
    for (int a = 0; a < d; a++) {
        u[a] = q[a];
        for (int b = 0; b < d; b++)
            u[a] += W[a + b * d] * r[b];
    }
}

/* Cramer's rule; 0 where the determinant vanishes. */
static int solve_small(int d, const double *M, const double *b, double *x)
{
    if (d == 2) {
        const double det = M[0] * M[3] - M[1] * M[2];
        x[0] = (b[0] * M[3] - b[1] * M[2]) / det;
        x[1] = (M[0] * b[1] - M[1] * b[0]) / det;
        return det != 0.0 && isfinite(x[0]) && isfinite(x[1]);
    }
    const double c0 = M[4] * M[8] - M[5] * M[7], c1 = M[5] * M[6] - M[3] * M[8];
    const double c2 = M[3] * M[7] - M[4] * M[6];
    const double det = M[0] * c0 + M[1] * c1 + M[2] * c2;
    x[0] = (b[0] * c0 + b[1] * c1 + b[2] * c2) / det;
    x[1] = (b[0] * (M[2] * M[7] - M[1] * M[8]) + b[1] * (M[0] * M[8] - M[2] * M[6]) +
            b[2] * (M[1] * M[6] - M[0] * M[7])) /
           det;
    x[2] = (b[0] * (M[1] * M[5] - M[2] * M[4]) + b[1] * (M[2] * M[3] - M[0] * M[5]) +
            b[2] * (M[0] * M[4] - M[1] * M[3])) /
           det;
    return det != 0.0 && isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]);
}

/* ---- The normal eliminated --------------------------------------------------------- */

#define LEAST_DETERMINANT 1e-13 /* of S, below which it counts as singular */
#define ROOT_STEPS 60
#define LAST_STEP 1e-7 /* of lambda + trace S: the next one would be below rounding */

void rb_friction_contact_init(int d, double mu, const double *W, rb_friction_contact *c)
{
    *c = (rb_friction_contact){.d = d, .mu = mu, .W = W};
    if (!(W[0] > 0.0))
        return;
    c->normal = 1.0 / W[0];
    for (int a = 1; a < d; a++) {
        c->row[a - 1] = W[a * d] * c->normal;
        c->column[a - 1] = W[a] * c->normal;
    }
    for (int b = 1; b < d; b++)
        for (int a = 1; a < d; a++)
            c->S[a - 1 + 2 * (b - 1)] = W[a + b * d] - W[a] * c->row[b - 1];
    if (d == 2) /* a second direction in which nothing happens */
        c->S[3] = c->S[0];
    const double trace = c->S[0] + c->S[3];
    const double det = c->S[0] * c->S[3] - c->S[1] * c->S[2];
    c->regular = trace > 0.0 && det > LEAST_DETERMINANT * trace * trace;
}

/* t = -(S + lambda)^-1 b */
static void tangential_force(const rb_friction_contact *c, double lambda, const double *b,
                             double *t)
{
    const double s0 = c->S[0] + lambda, s3 = c->S[3] + lambda;
    const double factor = -1.0 / (s0 * s3 - c->S[1] * c->S[2]);
    const double b0 = b[0], b1 = b[1];
    t[0] = factor * (s3 * b0 - c->S[2] * b1);
    t[1] = factor * (s0 * b1 - c->S[1] * b0);
}

static double normal_force(const rb_friction_contact *c, double qn, const double *t)
{
    return -(qn * c->normal + c->row[0] * t[0] + c->row[1] * t[1]);
}

/* lambda, the root of mu r_N / ||r_T|| - 1, which is nearly linear in lambda: Newton
 * within brackets, from the root of the last time.  root, and t there: written. */
static int slide(const rb_friction_contact *c, double qn, const double *b, double *root, double *t)
{
    double low = 0.0, high = INFINITY, lambda = *root;
    int k = 1;
    for (; k <= ROOT_STEPS; k++) {
        double dt[2];
        tangential_force(c, lambda, b, t);
        tangential_force(c, lambda, t, dt); /* dt / d lambda */
        const double size2 = t[0] * t[0] + t[1] * t[1], size = sqrt(size2);
        const double n = c->mu * normal_force(c, qn, t);
        const double dn = -c->mu * (c->row[0] * dt[0] + c->row[1] * dt[1]);
        const double f = n - size; /* of the sign of the function */
        const double slope = dn * size2 - n * (t[0] * dt[0] + t[1] * dt[1]);
        if (f < 0.0)
            low = lambda;
        else
            high = lambda;
        double next = lambda - f * size2 / slope;
        if (!(next >= low && next <= high))
            next = isfinite(high) ? 0.5 * (low + high) : 2.0 * lambda + c->S[0] + c->S[3];
        const double step = fabs(next - lambda);
        lambda = next;
        if (step <= LAST_STEP * (lambda + c->S[0] + c->S[3]))
            break;
    }
    tangential_force(c, lambda, b, t);
    *root = lambda;
    return k;
}

int rb_friction_contact_exact(const rb_friction_contact *c, double *lambda, const double *q,
                              double *r)
{
    const int d = c->d;
    double t[2] = {0.0, 0.0};
    if (q[0] >= 0.0) {
        for (int a = 0; a < d; a++)
            r[a] = 0.0;
        return 1;
    }
    if (!c->regular)
        return 0;
    int steps = 1;
    if (c->mu > 0.0) {
        const double b[2] = {q[1] - c->column[0] * q[0], d == 3 ? q[2] - c->column[1] * q[0] : 0.0};
        tangential_force(c, 0.0, b, t);
        const double most = c->mu * normal_force(c, q[0], t);
        if (!(most >= 0.0 && t[0] * t[0] + t[1] * t[1] <= most * most)) {
            if (d == 2) {
                /* In 2D the force keeps the side of the stuck one, t on entry, and ||t||
                 * = mu r_N is linear in ||t||: positive at 0 and negative for the stuck
                 * force. */
                const double qn = q[0];
                const double slope = t[0] < 0.0 ? -c->mu : c->mu;
                t[0] = -slope * qn * c->normal / (1.0 + slope * c->row[0]);
            } else
                steps += slide(c, q[0], b, lambda, t);
        }
    }
    r[0] = normal_force(c, q[0], t);
    r[1] = t[0];
    if (d == 3)
        r[2] = t[1];
    return steps;
}

/* ---- Without elimination: any W ---------------------------------------------------- */

static double contact_size(const rb_friction_contact *c, double rho, const double *q,
                           const double *r)
{
    double size = 0.0;
    for (int a = 0; a < c->d; a++)
        size = fmax(size, fabs(r[a]) + rho * fabs(q[a]));
    return size;
}

static void contact_uhat(const rb_friction_contact *c, const double *q, const double *r,
                         double *uhat)
{
    contact_velocity(c->d, c->W, q, r, uhat);
    uhat[0] += c->mu * rb_friction_tangential(c->d, uhat);
}

int rb_friction_contact_fixed_point(const rb_friction_contact *c, double *rho, const double *q,
                                    double *r)
{
    const int d = c->d;
    double uhat[3], p[3], up[3];
    contact_uhat(c, q, r, uhat);
    int k = 0;
    for (; k < PROJECTIONS; k++) {
        double step = 0.0, change = 0.0, size = 0.0;
        double z[3];
        for (int a = 0; a < c->d; a++)
            z[a] = r[a] - *rho * uhat[a];
        rb_friction_project(c->d, c->mu, z, p);
        contact_uhat(c, q, p, up);
        for (int a = 0; a < d; a++) {
            step += (p[a] - r[a]) * (p[a] - r[a]);
            change += (up[a] - uhat[a]) * (up[a] - uhat[a]);
            size += p[a] * p[a];
        }
        const double ratio = *rho * sqrt(change / step);
        if (step > 0.0 && ratio > RB_FRICTION_UPK_MOST) {
            *rho *= RB_FRICTION_UPK_SHRINK;
            continue;
        }
        for (int a = 0; a < d; a++)
            r[a] = p[a], uhat[a] = up[a];
        if (step <= 1e-28 * size)
            break;
        if (ratio < RB_FRICTION_UPK_LEAST)
            *rho /= RB_FRICTION_UPK_SHRINK;
    }
    return k + 1;
}

/* 2D: r_T = side mu r_N and u_N = 0, when u_T then opposes r_T */
static int slides(const rb_friction_contact *c, double side, const double *q, double *r)
{
    const double slope = side * c->mu;
    const double rn = -q[0] / (c->W[0] + slope * c->W[2]);
    if (!(rn >= 0.0) || !isfinite(rn))
        return 0;
    const double ut = q[1] + (c->W[1] + slope * c->W[3]) * rn;
    if (side * ut > 0.0)
        return 0;
    r[0] = rn;
    r[1] = slope * rn;
    return 1;
}

/* Stick, and in 2D sliding, have closed forms; take-off is known already. */
static int closed_form(const rb_friction_contact *c, const double *q, double *r)
{
    const int d = c->d;
    double stuck[3] = {0.0, 0.0, 0.0};
    if (solve_small(d, c->W, q, stuck)) {
        for (int a = 0; a < d; a++)
            stuck[a] = -stuck[a];
        /* ||r_T|| <= mu r_N */
        if (rb_friction_tangential(c->d, stuck) <= c->mu * stuck[0]) {
            for (int a = 0; a < d; a++)
                r[a] = stuck[a];
            return 1;
        }
        if (r[0] <= 0.0) /* a start for Newton */
            rb_friction_project(d, c->mu, stuck, r);
    }
    return d == 2 && (slides(c, 1.0, q, r) || slides(c, -1.0, q, r));
}

/* Newton can cycle on one contact already (large mu, strong coupling of N and T): the
 * fixed point then takes over from the best point. */
int rb_friction_contact_newton(const rb_friction_contact *c, const double *rho, const double *q,
                               double *r)
{
    const int d = c->d;
    double F[3], M[9], dr[3], best[3] = {0.0, 0.0, 0.0};
    double least = INFINITY;
    int k = 0;
    if (closed_form(c, q, r))
        return 1;
    for (; k < NEWTON_STEPS; k++) {
        /* F and M = A + B W at r */
        double u[3], A[9], B[9];
        contact_velocity(d, c->W, q, r, u);
        rb_friction_alart_curnier(&(rb_friction_cone){d, c->mu, rho[0], rho[1]}, r, u,
                                  &(rb_friction_linearised){F, A, B});
        for (int a = 0; a < d; a++)
            for (int b = 0; b < d; b++) {
                M[a + b * d] = A[a + b * d];
                for (int e = 0; e < d; e++)
                    M[a + b * d] += B[a + e * d] * c->W[e + b * d];
            }
        const double f = d == 2 ? hypot(F[0], F[1]) : sqrt(F[0] * F[0] + F[1] * F[1] + F[2] * F[2]);
        const double size = contact_size(c, rho[0], q, r);
        if (f < least) {
            least = f;
            for (int a = 0; a < d; a++)
                best[a] = r[a];
        }
        if (f <= 1e-14 * size)
            return k + 1;
        if (!solve_small(d, M, F, dr))
            break;
        for (int a = 0; a < d; a++)
            r[a] -= dr[a];
    }
    for (int a = 0; a < d; a++)
        r[a] = best[a];
    if (least <= 1e-10 * contact_size(c, rho[0], q, r))
        return k + 1;
    double both = fmin(rho[0], rho[1]);
    return k + 1 + rb_friction_contact_fixed_point(c, &both, q, r);
}
