/* Displacement and stress inside the body from its boundary values (B8).
 *
 * u is linear between midpoints, along the contour; t is constant on each element.  Then
 * Somigliana's field is that of forces t ds and, after integration by parts, of
 * dislocations -u_s ds, and in Muskhelishvili's potentials (kap = 3 - 4 nu)
 *     phi' = A/(z-z0),   psi' = B/(z-z0) - A conj(z0)/(z-z0)^2
 *     A = a_t + a_s,   B = -kap conj(a_t) + conj(a_s)
 *     a_t = -t/(2 pi (1+kap)),   a_s = i G u_s/(pi (1+kap))
 * per unit length, t and u_s complex.  Over a straight piece of length l and direction e,
 * with the letters of kernels.h (w = z - z0, d its distance on the left):
 *     I0 = int ds/w         = -conj(e) (Lam + i Th)
 *     I1 = int conj(w)/w^2  = conj(e)^2 I0 - 2i d conj(e) l/(w1 w2)
 *     J1 = int conj(w)/w    = conj(e)^2 l - 2i d conj(e) I0
 *     sxx + syy = 4 Re sum A I0,   syy - sxx + 2i sxy = 2 sum (B I0 - A I1)
 *     2G u = sum [2 kap a_t L - conj(a_t J1)]
 *          + sum [kap Q(alpha) - conj(Q(conj alpha)) - conj(a_s J1)]
 * where alpha = i G u/(pi (1+kap)) and Q(f) = int f dz0/w for f linear along the piece,
 * by parts -(f continued to z)(Lam + i Th) - f_s l. */
#include "bem/complex.h"
#include "bem/interior.h"
#include "bem/internal.h"
#include "bem/kernels.h"
#include "base/blas.h"

#include <complex.h>
#include <gsl/gsl_math.h>
#include <stdlib.h>

typedef double complex cplx;

/* Half an element, on which t and u_s are constant. */
typedef struct {
    rb_element e;
    cplx z1, direction;   /* first end */
    cplx a_t, a_s, alpha; /* alpha: at the first end */
} rb_piece;

struct rb_interior {
    const rb_bem_mesh *mesh;
    const double *u, *t; /* borrowed */
    int n;               /* pieces: 2 mesh.n */
    rb_piece *piece;
    int *next, *previous;
    rb_arena memory; /* of the three */
    double shear, nu, kap;
};

static cplx pair_of(const double *values, int j)
{
    return complex_of(values[2 * j], values[2 * j + 1]);
}

/* du/ds between the midpoints of j and of the element after it */
static cplx slope_after(const rb_interior *in, int j)
{
    const int k = in->next[j];
    return (pair_of(in->u, k) - pair_of(in->u, j)) /
           (0.5 * (rb_bem_mesh_length(in->mesh, j) + rb_bem_mesh_length(in->mesh, k)));
}

void rb_interior_free(rb_interior *interior)
{
    if (!interior)
        return;
    rb_arena_done(&interior->memory, RB_OK);
    free(interior);
}

rb_status rb_interior_create(const rb_bem_boundary *body, rb_interior **interior)
{
    const rb_bem_mesh *mesh = body->mesh;
    const size_t n = (size_t)mesh->n;
    rb_interior *in = *interior = calloc(1, sizeof *in);
    if (!in)
        return RB_ENOMEM;
    in->mesh = mesh;
    in->u = body->u;
    in->t = body->t;
    in->n = 2 * mesh->n;
    in->shear = body->material.shear;
    in->nu = body->material.poisson;
    in->kap = 3.0 - 4.0 * in->nu;
    in->piece = rb_arena_zeros(&in->memory, 2 * n, sizeof *in->piece);
    in->next = rb_arena_ints(&in->memory, n);
    in->previous = rb_arena_ints(&in->memory, n);
    if (in->memory.failed) {
        rb_interior_free(in);
        *interior = NULL;
        return RB_ENOMEM;
    }
    rb_bem_mesh_next(mesh, in->next);
    for (int j = 0; j < mesh->n; j++)
        in->previous[in->next[j]] = j;
    const double r0 = rb_bem_mesh_size(mesh);
    const cplx per_t = -1.0 / (2.0 * M_PI * (1.0 + in->kap)),
               per_s = I * in->shear / (M_PI * (1.0 + in->kap));
    for (int j = 0; j < mesh->n; j++) {
        const double mx = 0.5 * (mesh->x0[j] + mesh->x1[j]), my = 0.5 * (mesh->y0[j] + mesh->y1[j]),
                     half = 0.5 * rb_bem_mesh_length(mesh, j);
        const cplx before = slope_after(in, in->previous[j]), after = slope_after(in, j);
        rb_piece *p = in->piece + 2 * j;
        p[0].e = rb_element_make(mesh->x0[j], mesh->y0[j], mx, my, r0);
        p[1].e = rb_element_make(mx, my, mesh->x1[j], mesh->y1[j], r0);
        p[0].z1 = complex_of(mesh->x0[j], mesh->y0[j]);
        p[1].z1 = complex_of(mx, my);
        p[0].direction = p[1].direction = complex_of(p[0].e.tx, p[0].e.ty);
        p[0].a_t = p[1].a_t = per_t * pair_of(in->t, j);
        p[0].a_s = per_s * before;
        p[1].a_s = per_s * after;
        p[0].alpha = per_s * (pair_of(in->u, j) - half * before);
        p[1].alpha = per_s * pair_of(in->u, j);
    }
    return RB_OK;
}

/* ---- Off the surface --------------------------------------------------------------- */

typedef struct {
    cplx twoGu, normal, deviator; /* sum A I0; sum (B I0 - A I1) */
    double angle;                 /* 2 pi inside the body, 0 outside */
} rb_field;

static cplx cauchy(cplx f, cplx f_s, const rb_piece *p, cplx z, double l, cplx turn)
{
    return -(f + f_s * conj(p->direction) * (z - p->z1)) * turn - f_s * l;
}

/* 0: the point lies outside the body */
static int evaluate_inside(const rb_interior *in, double x, double y, double *displacement,
                           double *stress)
{
    rb_field field = {0};
    for (int k = 0; k < in->n; k++) {
        /* displaced: the sums of the displacement too, which cost more than those of the
         * stress. */
        const rb_piece *p = &in->piece[k];
        const rb_view_angles v = rb_view_angles_of(&p->e, x, y);
        const cplx z = complex_of(x, y), turn = complex_of(v.Lam, v.Th), back = conj(p->direction);
        const double l = 2.0 * p->e.a;
        const cplx shift = -2.0 * I * v.d * back;
        const cplx I0 = -back * turn,
                   I1 = back * back * I0 + shift * l / complex_of(v.Z_re, v.Z_im);
        const cplx A = p->a_t + p->a_s, B = conj(p->a_s - in->kap * p->a_t);

        field.angle += v.Th;
        field.normal += A * I0;
        field.deviator += B * I0 - A * I1;
        if (displacement != NULL) {
            const double L =
                v.X * v.Lam + 0.5 * p->e.a * v.log_W + v.d * v.Th - l * (1.0 + p->e.log_r0);
            const cplx J1 = back * back * l + shift * I0;
            field.twoGu += 2.0 * in->kap * L * p->a_t - conj(A * J1) +
                           in->kap * cauchy(p->alpha, p->a_s, p, z, l, turn) -
                           conj(cauchy(conj(p->alpha), conj(p->a_s), p, z, l, turn));
        }
    }
    const double mean = 2.0 * creal(field.normal);
    if (displacement) {
        displacement[0] = creal(field.twoGu) / (2.0 * in->shear);
        displacement[1] = cimag(field.twoGu) / (2.0 * in->shear);
    }
    if (stress) {
        stress[0] = mean - creal(field.deviator);
        stress[1] = mean + creal(field.deviator);
        stress[2] = cimag(field.deviator);
    }
    return field.angle > M_PI;
}

/* ---- On the surface ---------------------------------------------------------------- */

/* The element nearest to (x, y); *s: of its nearest point from its midpoint along it; *depth:
 * how far (x, y) lies from there, inwards. */
static int nearest_element(const rb_interior *in, double x, double y, double *s, double *depth)
{
    double least = INFINITY;
    int nearest = 0;
    *s = 0.0;
    *depth = -INFINITY;
    for (int j = 0; j < in->mesh->n; j++) {
        const rb_element *first = &in->piece[2 * j].e;
        const double mx = 0.5 * (in->mesh->x0[j] + in->mesh->x1[j]),
                     my = 0.5 * (in->mesh->y0[j] + in->mesh->y1[j]), half = 2.0 * first->a;
        const double dx = x - mx, dy = y - my;
        const double along = dx * first->tx + dy * first->ty,
                     inwards = dy * first->tx - dx * first->ty;
        const double beyond = fmax(fabs(along) - half, 0.0),
                     square = gsl_pow_2(beyond) + gsl_pow_2(inwards);
        if (square < least) {
            least = square;
            nearest = j;
            *s = fmin(fmax(along, -half), half);
            *depth = copysign(sqrt(square), inwards);
        }
    }
    return nearest;
}

/* A vector of element j, of the element k beside it, or at their common end, in the frame
 * that turns from one to the other between their midpoints; part: 0 at that of j, 1 at the
 * end.  *along: the frame's direction. */
static cplx between(const rb_interior *in, const double *values, int j, int k, double part,
                    cplx *along)
{
    const cplx e = in->piece[2 * j].direction, f = in->piece[2 * k].direction;
    const double h = rb_bem_mesh_length(in->mesh, j), hk = rb_bem_mesh_length(in->mesh, k);
    const cplx own = pair_of(values, j) * conj(e), other = pair_of(values, k) * conj(f);
    const cplx turned = e + part * h / (h + hk) * (f - e);

    *along = turned / cabs(turned);
    return own + part * h / (h + hk) * (other - own);
}

static void evaluate_surface(const rb_interior *in, int j, double s, double *displacement,
                             double *stress)
{
    const int i = in->previous[j], k = in->next[j];
    if (displacement) {
        const cplx u = pair_of(in->u, j) + s * slope_after(in, s < 0.0 ? i : j);
        displacement[0] = creal(u);
        displacement[1] = cimag(u);
    }
    if (stress) {
        /* u_s: the quotients hold at the element's ends, the parabola's slope at its
         * midpoint; linear between them. */
        const double h = rb_bem_mesh_length(in->mesh, j), hi = rb_bem_mesh_length(in->mesh, i),
                     hk = rb_bem_mesh_length(in->mesh, k), part = fabs(s) / (0.5 * h);
        const cplx before = slope_after(in, i), after = slope_after(in, j);
        const cplx middle = (before * (h + hk) + after * (h + hi)) / (2.0 * h + hi + hk);
        const cplx slope = middle + part * ((s < 0.0 ? before : after) - middle);
        /* sigma_nn, sigma_ns from t, and sigma_ss from the plane-strain Hooke law
         * 2G eps_ss = (1-nu) sigma_ss - nu sigma_nn; turned back to x, y. */
        cplx e;
        const cplx t = between(in, in->t, j, s < 0.0 ? i : k, part, &e);
        const double ns = creal(t), nn = -cimag(t); /* outward normal = -i e */
        const double strain = creal(slope * conj(e));
        const double ss = (2.0 * in->shear * strain + in->nu * nn) / (1.0 - in->nu);
        /* in the axes (e, i e): s11 = ss, s22 = nn, s12 = -ns */
        const double mean = 0.5 * (ss + nn);
        const cplx deviator = complex_of(0.5 * (nn - ss), -ns) * conj(e) * conj(e);
        stress[0] = mean - creal(deviator);
        stress[1] = mean + creal(deviator);
        stress[2] = cimag(deviator);
    }
}

/* The element behind the point at `x, y` of the boundary, seen inwards along the unit vector
 * dx, dy; *s: of the point that is met, along it; *far: how far away.  -1: there is none. */
static int element_behind(const rb_interior *in, int from, double x, double y, double dx, double dy,
                          double *s, double *far)
{
    int behind = -1;
    *far = INFINITY;
    for (int j = 0; j < in->mesh->n; j++) {
        const rb_element *e = &in->piece[2 * j].e;
        const double ax = 0.5 * (in->mesh->x0[j] + in->mesh->x1[j]) - x,
                     ay = 0.5 * (in->mesh->y0[j] + in->mesh->y1[j]) - y;
        const double across = dx * e->ty - dy * e->tx;
        if (j == from || across == 0.0)
            continue;
        const double away = (ax * e->ty - ay * e->tx) / across,
                     along = (ax * dy - ay * dx) / across;
        /* not the neighbour that begins there */
        if (away > 1e-3 * e->a && away < *far && fabs(along) <= 2.0 * e->a * (1.0 + 1e-9)) {
            behind = j;
            *s = along;
            *far = away;
        }
    }
    return behind;
}

/* Nearer to the surface than an element is long, the polygon's corners and the midpoints,
 * where u_s jumps, make logarithms: there the stress is the parabola through that on the
 * surface and one and two lengths below it, or, in a wall that is thinner, linear between
 * its surfaces.  0: no such place is in the body. */
static int evaluate_near(const rb_interior *in, int j, double s, double depth, double x, double y,
                         double *stress)
{
    const rb_element *first = &in->piece[2 * j].e;
    const double h = 4.0 * first->a, part = depth / h;
    const double mx = 0.5 * (in->mesh->x0[j] + in->mesh->x1[j]) + s * first->tx,
                 my = 0.5 * (in->mesh->y0[j] + in->mesh->y1[j]) + s * first->ty;
    const double dx = (x - mx) / depth, dy = (y - my) / depth;
    double below[2][3], there, far;

    evaluate_surface(in, j, s, NULL, stress);
    const int behind = element_behind(in, j, mx, my, dx, dy, &there, &far);
    if (behind < 0)
        return 0;
    if (far < 2.5 * h) {
        evaluate_surface(in, behind, there, NULL, below[0]);
        for (int c = 0; c < 3; c++)
            stress[c] += depth / far * (below[0][c] - stress[c]);
        return 1;
    }
    for (int k = 0; k < 2; k++)
        if (!evaluate_inside(in, mx + (k + 1) * h * dx, my + (k + 1) * h * dy, NULL, below[k]))
            return 0;
    for (int c = 0; c < 3; c++)
        stress[c] = 0.5 * (1.0 - part) * (2.0 - part) * stress[c] +
                    part * (2.0 - part) * below[0][c] - 0.5 * part * (1.0 - part) * below[1][c];
    return 1;
}

rb_status rb_interior_at(const rb_interior *in, int is_round, rb_bem_points points,
                         double *displacement, double *stress, rb_message *why)
{
    int outside = points.n, stop = 0; /* outside: the first point there */
#pragma omp parallel for num_threads(rb_blas_loop_threads()) schedule(static)                      \
    reduction(min                                                                                  \
              : outside) if ((double)points.n * in->n > rb_pairs_for_threads)
    for (int k = 0; k < points.n; k++) {
        const double x = points.xy[2 * k], y = points.xy[2 * k + 1];
        if (rb_interrupted_in_loop(&stop))
            continue;
        double *u = displacement ? displacement + 2 * k : NULL,
               *sigma = stress ? stress + 3 * k : NULL, along, depth;
        const int j = nearest_element(in, x, y, &along, &depth);
        const double h = rb_bem_mesh_length(in->mesh, j);

        if (fabs(depth) <= 1e-9 * h) {
            evaluate_surface(in, j, along, u, sigma);
            continue;
        }
        const int is_near = is_round && sigma && depth > 0.0 && depth < h &&
                            evaluate_near(in, j, along, depth, x, y, sigma);
        if ((u || !is_near) && !evaluate_inside(in, x, y, u, is_near ? NULL : sigma))
            outside = k < outside ? k : outside;
    }
    return stop ? RB_INTERRUPTED
           : outside == points.n
               ? RB_OK
               : rb_fail(why, RB_EINVAL, "point %d at (%g, %g) lies outside the body", outside,
                         points.xy[2 * outside], points.xy[2 * outside + 1]);
}

rb_status rb_bem_interior(const rb_bem_boundary *body, rb_bem_points points, double *displacement,
                          double *stress, rb_message *why)
{
    rb_interior *in;
    rb_status s = rb_bem_mesh_check(body->mesh, why);
    if (s == RB_OK)
        s = rb_bem_material_check(body->material, why);
    if (s == RB_OK && points.n < 0)
        s = rb_fail(why, RB_EINVAL, "interior points: %d", points.n);
    if (s != RB_OK)
        return s;
    if (rb_interior_create(body, &in) != RB_OK)
        return rb_fail(why, RB_ENOMEM, "interior: out of memory for %d elements", body->mesh->n);
    s = rb_interior_at(in, 0, points, displacement, stress, why);
    rb_interior_free(in);
    return s;
}
