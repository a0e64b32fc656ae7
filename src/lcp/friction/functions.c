/* The nonsmooth functions of *Acary*, section 2, and Fischer-Burmeister on the cones.  F(r, u) = 0
 * is Coulomb's law of one contact in each of them; they differ in what they are far from it, and so
 * in where Newton's method goes.  A and B are one element of the generalised Jacobian: at a kink
 * the derivative of one side. */
#include "lcp/friction/internal.h"

#include <gsl/gsl_math.h>

static void identity(int d, double x, double *M)
{
    for (int k = 0; k < d * d; k++)
        M[k] = 0.0;
    for (int a = 0; a < d; a++)
        M[a + a * d] = x;
}

/* r_N - max(0, r_N - rho u_N); returns r_N - rho u_N */
static double normal_part(const rb_friction_cone *cone, const double *r, const double *u,
                          const rb_friction_linearised *at)
{
    const double rho = cone->rho_n, z = r[0] - rho * u[0];
    identity(cone->d, 1.0, at->A);
    identity(cone->d, 0.0, at->B);
    at->F[0] = z > 0.0 ? rho * u[0] : r[0];
    if (z > 0.0) {
        at->A[0] = 0.0;
        at->B[0] = rho;
    }
    return z;
}

/* F_T = r_T - P_D(r_T - rho u_T), D the disc of the given radius; direction of the
 * projected point n, written; returns 1 where the point lies on the rim. */
static int tangential_part(const rb_friction_cone *cone, double radius, const double *r,
                           const double *u, const rb_friction_linearised *at, double *n)
{
    const int d = cone->d;
    const double rho = cone->rho_t;
    double y[3] = {0.0, 0.0, 0.0};
    for (int a = 1; a < d; a++)
        y[a] = r[a] - rho * u[a];
    const double t = rb_friction_tangential(d, y);
    if (t <= radius && radius > 0.0) {
        for (int a = 1; a < d; a++) {
            at->F[a] = rho * u[a];
            at->A[a + a * d] = 0.0;
            at->B[a + a * d] = rho;
        }
        return 0;
    }
    const double g = t > 0.0 ? radius / t : 0.0;
    for (int a = 1; a < d; a++) {
        n[a] = t > 0.0 ? y[a] / t : 0.0;
        at->F[a] = r[a] - g * y[a];
    }
    for (int a = 1; a < d; a++)
        for (int b = 1; b < d; b++) {
            const double dp = g * ((a == b) - n[a] * n[b]); /* d(radius y/t)/dy */
            at->A[a + b * d] = (a == b) - dp;
            at->B[a + b * d] = rho * dp;
        }
    return 1;
}

/* The disc has the radius of the pressure that is projected, max(0, r_N - rho u_N). */
void rb_friction_alart_curnier(const rb_friction_cone *cone, const double *r, const double *u,
                               const rb_friction_linearised *at)
{
    const double mu = cone->mu, z = normal_part(cone, r, u, at);
    double n[3];
    if (!tangential_part(cone, mu * fmax(0.0, z), r, u, at, n) || z <= 0.0)
        return;
    for (int a = 1; a < cone->d; a++) { /* the radius mu (r_N - rho u_N) moves too */
        at->A[a] = -mu * n[a];
        at->B[a] = mu * cone->rho_n * n[a];
    }
}

/* The disc has the radius of the pressure of the iterate, max(0, r_N). */
void rb_friction_jean_moreau(const rb_friction_cone *cone, const double *r, const double *u,
                             const rb_friction_linearised *at)
{
    const double mu = cone->mu;
    double n[3];
    normal_part(cone, r, u, at);
    if (!tangential_part(cone, mu * fmax(0.0, r[0]), r, u, at, n) || r[0] <= 0.0)
        return;
    for (int a = 1; a < cone->d; a++)
        at->A[a] = -mu * n[a];
}

/* C = X Y, d x d column-major */
static void multiply(int d, const double *X, const double *Y, double *C)
{
    for (int a = 0; a < d; a++)
        for (int b = 0; b < d; b++) {
            double sum = 0.0;
            for (int c = 0; c < d; c++)
                sum += X[a + c * d] * Y[c + b * d];
            C[a + b * d] = sum;
        }
}

/* uhat = u + mu ||u_T|| e_N and G = d uhat/du (0 chosen for the derivative at u_T = 0) */
static void de_saxce(int d, double mu, const double *u, double *uhat, double *G)
{
    const double t = rb_friction_tangential(d, u);
    identity(d, 1.0, G);
    for (int a = 0; a < d; a++)
        uhat[a] = u[a];
    uhat[0] += mu * t;
    for (int a = 1; a < d && t > 0.0; a++)
        G[a * d] = mu * u[a] / t;
}

/* One rho for all directions: another one would deform the cone. */
static double common_rho(const rb_friction_cone *cone)
{
    return cone->d / (1.0 / cone->rho_n + (cone->d - 1) / cone->rho_t);
}

/* F = r - P_K(r - rho uhat), the projection on the whole cone at once; A = I - D, B = rho D G. */
void rb_friction_natural_map(const rb_friction_cone *cone, const double *r, const double *u,
                             const rb_friction_linearised *at)
{
    const int d = cone->d;
    const double mu = cone->mu, rho = common_rho(cone);
    double *F = at->F, *A = at->A, *B = at->B;
    double uhat[3], G[9], D[9], z[3], p[3];
    de_saxce(d, mu, u, uhat, G);
    for (int a = 0; a < d; a++)
        z[a] = r[a] - rho * uhat[a];
    rb_friction_project(d, mu, z, p);
    rb_friction_project_derivative(d, mu, z, D);
    multiply(d, D, G, B);
    for (int a = 0; a < d; a++)
        F[a] = r[a] - p[a];
    for (int k = 0; k < d * d; k++) {
        A[k] = -D[k];
        B[k] *= rho;
    }
    for (int a = 0; a < d; a++)
        A[a + a * d] += 1.0;
}

/* ---- Fischer-Burmeister ------------------------------------------------------------ */

/* L_x of the Jordan product x o y: [x0 x1'; x1 x0 I] */
static void arrow(int d, const double *x, double *L)
{
    identity(d, x[0], L);
    for (int a = 1; a < d; a++)
        L[a] = L[a * d] = x[a];
}

/* x + y - (x^2 + y^2)^(1/2), x = (mu r_N, r_T), y = rho (uhat_N, mu u_T), both in the
 * Lorentz cone */
void rb_friction_fischer_burmeister(const rb_friction_cone *cone, const double *r, const double *u,
                                    const rb_friction_linearised *at)
{
    const int d = cone->d;
    const double mu = cone->mu, rho = common_rho(cone);
    double *F = at->F, *A = at->A, *B = at->B;
    if (mu == 0.0) { /* the Lorentz cone loses r_N */
        const double y = rho * u[0], w = hypot(r[0], y);
        identity(d, 1.0, at->A);
        identity(d, 0.0, at->B);
        for (int a = 1; a < d; a++)
            at->F[a] = r[a];
        at->F[0] = r[0] + y - w;
        at->A[0] = 1.0 - (w > 0.0 ? r[0] / w : M_SQRT1_2);
        at->B[0] = rho * (1.0 - (w > 0.0 ? y / w : M_SQRT1_2));
        return;
    }
    double uhat[3], G[9], x[3], y[3], w[3], s[3] = {0}, L[9] = {0}, P[9], inverse[9], size = 0.0;
    de_saxce(d, mu, u, uhat, G);
    for (int a = 0; a < d; a++) {
        x[a] = a ? r[a] : mu * r[a];
        y[a] = rho * (a ? mu * uhat[a] : uhat[a]);
        size += fabs(x[a]) + fabs(y[a]);
    }
    /* w = (x^2 + y^2)^(1/2) by the eigenvalues lo, hi, and w0 across, of L_w; their inverses,
     * kept finite, are those of L_w^-1 on the same eigenvectors. */
    const double least = size > 0.0 ? 1e-12 * size : 1.0;
    double s0 = 0.0, t = 0.0;
    for (int a = 0; a < d; a++)
        s0 += x[a] * x[a] + y[a] * y[a];
    for (int a = 1; a < d; a++) {
        s[a] = 2.0 * (x[0] * x[a] + y[0] * y[a]);
        t = hypot(t, s[a]);
    }
    const double lo = sqrt(fmax(0.0, s0 - t)), hi = sqrt(s0 + t);
    for (int a = 1; a < d; a++) {
        s[a] = t > 0.0 ? s[a] / t : 0.0;
        w[a] = 0.5 * (hi - lo) * s[a];
    }
    w[0] = 0.5 * (hi + lo);
    const double il = 1.0 / fmax(lo, least), ih = 1.0 / fmax(hi, least);
    const double across = 1.0 / fmax(w[0], least);
    identity(d, across, inverse);
    inverse[0] = 0.5 * (il + ih);
    for (int a = 1; a < d; a++) {
        inverse[a] = inverse[a * d] = 0.5 * (ih - il) * s[a];
        for (int b = 1; b < d; b++)
            inverse[a + b * d] += (0.5 * (il + ih) - across) * s[a] * s[b];
    }
    for (int a = 0; a < d; a++)
        F[a] = x[a] + y[a] - w[a];
    arrow(d, x, L);
    multiply(d, inverse, L, A); /* then A = (I - L_w^-1 L_x) dx/dr */
    arrow(d, y, L);
    multiply(d, inverse, L, P);
    for (int k = 0; k < d * d; k++) {
        A[k] = ((k % (d + 1) == 0) - A[k]) * (k < d ? mu : 1.0);
        P[k] = ((k % (d + 1) == 0) - P[k]) * rho * (k < d ? 1.0 : mu);
    }
    multiply(d, P, G, B);
}
