/* One contact alone: u = W r + q with its own block W (d x d). */
#include "friction/internal.h"

#include <math.h>

#define NEWTON_STEPS 20
#define PROJECTIONS 100

static void contact_velocity(int d, const double *W, const double *q, const double *r,
                             double *u)
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

int rb_friction_contact_invert(int d, const double *W, double *inverse)
{
    for (int b = 0; b < d; b++) {
        const double e[3] = {b == 0, b == 1, b == 2};
        if (!solve_small(d, W, e, inverse + b * d))
            return 0;
    }
    return 1;
}

/* F at r; M = A + B W where wanted.  Returns ||F||. */
static double contact_function(const rb_friction_contact *c, const double *r, double *F,
                               double *M)
{
    const int d = c->d;
    double u[3], A[9], B[9];
    contact_velocity(d, c->W, c->q, r, u);
    rb_friction_alart_curnier(d, c->mu, c->rho_n, c->rho_t, r, u, F, A, B);
    for (int a = 0; M && a < d; a++)
        for (int b = 0; b < d; b++) {
            M[a + b * d] = A[a + b * d];
            for (int e = 0; e < d; e++)
                M[a + b * d] += B[a + e * d] * c->W[e + b * d];
        }
    return d == 2 ? hypot(F[0], F[1]) : sqrt(F[0] * F[0] + F[1] * F[1] + F[2] * F[2]);
}

static double contact_size(const rb_friction_contact *c, const double *r)
{
    double size = 0.0;
    for (int a = 0; a < c->d; a++)
        size = fmax(size, fabs(r[a]) + c->rho_n * fabs(c->q[a]));
    return size;
}

static void project_step(const rb_friction_contact *c, double rho, const double *r,
                         const double *uhat, double *p)
{
    double z[3];
    for (int a = 0; a < c->d; a++)
        z[a] = r[a] - rho * uhat[a];
    rb_friction_project(c->d, c->mu, z, p);
}

static void contact_uhat(const rb_friction_contact *c, const double *r, double *uhat)
{
    contact_velocity(c->d, c->W, c->q, r, uhat);
    uhat[0] += c->mu * rb_friction_tangential(c->d, uhat);
}

int rb_friction_contact_fixed_point(const rb_friction_contact *c, double *rho, double *r)
{
    const int d = c->d;
    double uhat[3], p[3], up[3];
    contact_uhat(c, r, uhat);
    int k = 0;
    for (; k < PROJECTIONS; k++) {
        double step = 0.0, change = 0.0, size = 0.0;
        project_step(c, *rho, r, uhat, p);
        contact_uhat(c, p, up);
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

/* ||r_T|| <= mu r_N */
static int inside(const rb_friction_contact *c, const double *r)
{
    return rb_friction_tangential(c->d, r) <= c->mu * r[0];
}

/* 2D: r_T = side mu r_N and u_N = 0, when u_T then opposes r_T */
static int slides(const rb_friction_contact *c, double side, double *r)
{
    const double slope = side * c->mu;
    const double rn = -c->q[0] / (c->W[0] + slope * c->W[2]);
    if (!(rn >= 0.0) || !isfinite(rn))
        return 0;
    const double ut = c->q[1] + (c->W[1] + slope * c->W[3]) * rn;
    if (side * ut > 0.0)
        return 0;
    r[0] = rn;
    r[1] = slope * rn;
    return 1;
}

/* Take-off, stick, and in 2D sliding have closed forms. */
static int closed_form(const rb_friction_contact *c, double *r)
{
    const int d = c->d;
    double stuck[3] = {0.0, 0.0, 0.0};
    if (c->q[0] >= 0.0) {
        for (int a = 0; a < d; a++)
            r[a] = 0.0;
        return 1;
    }
    if (c->inverse) {
        for (int a = 0; a < d; a++) {
            for (int b = 0; b < d; b++)
                stuck[a] -= c->inverse[a + b * d] * c->q[b];
        }
        if (inside(c, stuck)) {
            for (int a = 0; a < d; a++)
                r[a] = stuck[a];
            return 1;
        }
        if (r[0] <= 0.0) /* a start for Newton */
            rb_friction_project(d, c->mu, stuck, r);
    }
    return d == 2 && (slides(c, 1.0, r) || slides(c, -1.0, r));
}

/* Newton can cycle on one contact already (large mu, strong coupling of N and T): the
 * fixed point then takes over from the best point. */
int rb_friction_contact_newton(const rb_friction_contact *c, double *r)
{
    const int d = c->d;
    double F[3], M[9], dr[3], best[3] = {0.0, 0.0, 0.0};
    double least = INFINITY;
    int k = 0;
    if (closed_form(c, r))
        return 1;
    for (; k < NEWTON_STEPS; k++) {
        const double f = contact_function(c, r, F, M), size = contact_size(c, r);
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
    if (least <= 1e-10 * contact_size(c, r))
        return k + 1;
    double rho = fmin(c->rho_n, c->rho_t);
    return k + 1 + rb_friction_contact_fixed_point(c, &rho, r);
}
