/* Shape of a crack, its elements and its flexibility: the Galerkin form (C4) of the
 * equations of continuous dislocations below a free surface (C1)-(C3). */
#include "analysis/crack/internal.h"

#include <cblas.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>
#include <lapacke.h>
#include <stdlib.h>
#include <string.h>

/* Points per element; per half of it, graded towards an end where the stress is singular. */
enum { POINTS = 10, GRADED = 24, PIECE_ELEMENTS = 3, LEAST_ELEMENTS = 4, MOST_ELEMENTS = 2000 };
/* Below this angle [degrees] the faces of so few elements would be wrong. */
enum { SHALLOW_ANGLE = 15, SHALLOW_ELEMENTS = 40 };
/* K_I of a crack of 90 degrees with its mouth in the surface, unit tension, a = 1. */
static const double EDGE_CRACK = 1.1215222552;

/* ---- Shape ------------------------------------------------------------------------- */

rb_crack_path rb_crack_straight(double mouth, double depth, double length, double angle)
{
    /* the cosine of 90 degrees to the last digit */
    const double degree = M_PI / 180.0;
    return (rb_crack_path){.pieces = 1,
                           .x = {mouth, mouth + length * sin((90.0 - angle) * degree)},
                           .y = {-depth, -depth - length * sin(angle * degree)}};
}

static double complex place(const rb_crack_path *path, int k)
{
    return path->x[k] + I * path->y[k];
}

/* Pieces, elements and material; the crack lies in the half-plane y < 0, and its mouth may touch y
 * = 0. */
static rb_status check_shape(const rb_crack_shape *shape, rb_message *why)
{
    const rb_crack_path *path = &shape->path;
    const int least = GSL_MAX(LEAST_ELEMENTS, 2 * path->pieces);

    if (path->pieces < 1 || path->pieces > RB_CRACK_PIECES)
        return rb_fail(why, RB_EINVAL, "crack: %d pieces, expected 1 ... %d", path->pieces,
                       RB_CRACK_PIECES);
    if (shape->elements < least || shape->elements > MOST_ELEMENTS)
        return rb_fail(why, RB_EINVAL,
                       "crack: %d elements on %d straight pieces, expected two a piece, "
                       "%d ... %d; give more elements",
                       shape->elements, path->pieces, least, MOST_ELEMENTS);
    if (!(shape->friction >= 0.0) || !(shape->shear > 0.0) || !(shape->poisson > -1.0) ||
        !(shape->poisson <= 0.5))
        return rb_fail(why, RB_EINVAL,
                       "crack: expected friction >= 0, a shear modulus > 0 and "
                       "Poisson's ratio in (-1, 0.5]");
    for (int k = 0; k <= path->pieces; k++) {
        const double length = k > 0 ? cabs(place(path, k) - place(path, k - 1)) : 1.0;
        if (!(length > 0.0) || !isfinite(length))
            return rb_fail(why, RB_EINVAL, "crack: piece %d has no length", k);
        if (!shape->full_plane && !(path->y[k] < 0.0 || (k == 0 && path->y[0] == 0.0)))
            return rb_fail(why, RB_EINVAL, "crack: the place (%g, %g) lies outside the body y < 0",
                           path->x[k], path->y[k]);
    }
    if (!shape->full_plane && path->y[0] == 0.0 && shape->elements < SHALLOW_ELEMENTS &&
        -path->y[1] < cabs(place(path, 1) - place(path, 0)) * sin(SHALLOW_ANGLE * M_PI / 180.0) *
                          (1.0 - 1e-12))
        return rb_fail(why, RB_EINVAL,
                       "crack: below %d degrees to the surface expected at least %d "
                       "elements, got %d",
                       SHALLOW_ANGLE, SHALLOW_ELEMENTS, shape->elements);
    return RB_OK;
}

void rb_crack_grade(const rb_crack_path *path, int n, double *s)
{
    const int pieces = path->pieces, least = GSL_MIN(PIECE_ELEMENTS, n / pieces);
    double length = 0.0, before = 0.0, phi_before = 0.0;
    int from = 0;

    for (int k = 0; k < pieces; k++)
        length += cabs(place(path, k + 1) - place(path, k));
    for (int k = 0; k < pieces; k++) {
        /* s = L sin^2 phi, phi from 0 to pi/2: elements become shorter towards the mouth and the
         * tip, as the square root of the distance from there.  Kinks are ends of elements. */
        const double end = before + cabs(place(path, k + 1) - place(path, k)),
                     phi = k + 1 < pieces ? asin(sqrt(fmin(end / length, 1.0))) : M_PI_2;
        /* so many at least for this piece and for each one that is left */
        const int most = n - least * (pieces - 1 - k),
                  wanted = GSL_MAX((int)lround(n * phi / M_PI_2), from + least),
                  to = k + 1 < pieces ? GSL_MIN(wanted, most) : n;
        for (int j = from; j <= to; j++)
            s[j] =
                length * gsl_pow_2(sin(phi_before + (phi - phi_before) * (j - from) / (to - from)));
        s[from] = before;
        s[to] = end;
        before = end;
        phi_before = phi;
        from = to;
    }
}

void rb_crack_place(const rb_crack_path *path, int n, const double *s, rb_crack_element *element)
{
    double before = 0.0; /* s of the beginning of the piece */

    for (int k = 0, piece = 0; k < n; k++) {
        double complex along = place(path, piece + 1) - place(path, piece);
        if (0.5 * (s[k] + s[k + 1]) > before + cabs(along)) {
            before += cabs(along);
            piece++;
            along = place(path, piece + 1) - place(path, piece);
        }
        const double complex t = along / cabs(along);
        element[k] = (rb_crack_element){place(path, piece) + (s[k] - before) * t, t,
                                        s[k + 1] - s[k], s[k], piece};
    }
}

/* ---- Kernels (C2) ------------------------------------------------------------------ */

static inline double complex inverse(double complex c)
{
    return conj(c) / (creal(c) * creal(c) + cimag(c) * cimag(c));
}

/* Traction sigma n at z on a plane of direction t. */
static inline double complex traction_of(double complex z, double complex t, double complex Phi,
                                         double complex slope, double complex Psi)
{
    return I * t * conj(2.0 * creal(Phi) + t * t * (conj(z) * slope + Psi));
}

/* Adds the tractions from a density 1 (first) and i (second) of b on an element, gamma =
 * -i b: direct part of the full plane, image part of the surface. */
static void add_direct(const rb_crack_element *e, double complex z, double complex t_z,
                       double complex traction[2])
{
    /* J1, J2: the integrals of 1/(z - s) and 1/(z - s)^2 over the element; Phi, Psi are
     * Muskhelishvili's potentials of the density. */
    const double complex z1 = z - e->from, z2 = z1 - e->length * e->t, r = 1.0 / e->t;
    const double complex J1 = clog(z1 * inverse(z2)) * r;
    const double complex J2 = (inverse(z2) - inverse(z1)) * r;
    const double complex turn = conj(e->t) * r;
    const double complex lever = conj(e->from) + turn * z1;
    for (int k = 0; k < 2; k++) {
        const double complex g = k == 0 ? -I : 1.0;
        const double complex Phi = g * J1, slope = -g * J2;
        const double complex Psi = conj(g) * J1 + g * (lever * J2 - turn * J1);
        traction[k] += traction_of(z, t_z, Phi, slope, Psi);
    }
}

static void add_image(const rb_crack_element *e, double complex z, double complex t_z,
                      double complex traction[2])
{
    /* The image of the element in the surface, at conj(s): with it the surface y = 0 is free of
     * traction. */
    const double complex t = conj(e->t), r = 1.0 / t, turn = e->t * r;
    const double complex c1 = z - conj(e->from), c2 = c1 - t * e->length;
    const double complex v1 = inverse(c1), v2 = inverse(c2);
    /* both c lie in the lower half: no cut between them */
    const double complex I1 = -clog(c2 * v1) * r, I2 = (v2 - v1) * r,
                         I3 = 0.5 * (v2 * v2 - v1 * v1) * r;
    const double complex lever = e->from + turn * c1 - z; /* B - z */
    for (int k = 0; k < 2; k++) {
        const double complex g = k == 0 ? -I : 1.0, h = conj(g);
        const double complex Phi = -((h + g - h * turn) * I1 + h * lever * I2);
        const double complex slope = (2.0 * h + g - 2.0 * h * turn) * I2 + 2.0 * h * lever * I3;
        traction[k] += traction_of(z, t_z, Phi, slope, -h * I1 - Phi - z * slope);
    }
}

/* Second antiderivative of ln|x|. */
static double twice(double x)
{
    return x == 0.0 ? 0.0 : x * x * (0.5 * log(fabs(x)) - 0.75);
}

/* int int ln|s - s'| over two elements of one piece. */
static double log_mean(const rb_crack_element *e, const rb_crack_element *f)
{
    static const double x[] = {-0.77459666924148338, 0.0, 0.77459666924148338},
                        w[] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    /* Near elements by the exact second antiderivative, far ones by three Gauss points. */
    const double a = e->s, k = e->length, c = f->s, l = f->length;
    double sum = 0.0;

    if (fabs(a + 0.5 * k - c - 0.5 * l) < 30.0 * fmax(k, l))
        return -(twice(a + k - c - l) - twice(a + k - c) - twice(a - c - l) + twice(a - c));
    for (int i = 0; i < 3; i++) /* the four terms would cancel */
        for (int j = 0; j < 3; j++)
            sum += w[i] * w[j] * log(fabs(a + 0.5 * k * (1 + x[i]) - c - 0.5 * l * (1 + x[j])));
    return k * l * sum;
}

/* int ln|s - s'| ds' over an element. */
static double log_integral(double s, const rb_crack_element *e)
{
    const double x = s - e->s, y = x - e->length;
    return (x == 0.0 ? 0.0 : x * log(fabs(x))) - (y == 0.0 ? 0.0 : y * log(fabs(y))) - e->length;
}

/* ---- Matrix (C4) ------------------------------------------------------------------- */

int rb_crack_points(const rb_crack_element *e, int graded_from, int graded_to,
                    gsl_integration_glfixed_table *const rule[2], rb_crack_point *point)
{
    /* A substitution u^4 at a graded end takes the singularity out of the integrand. */
    const int parts = graded_from || graded_to ? 2 : 1;
    int count = 0;

    for (int part = 0; part < parts; part++) {
        const int graded = part == 0 ? graded_from : graded_to;
        for (size_t i = 0; i < rule[graded]->n; i++) {
            double u, w;
            gsl_integration_glfixed_point(0.0, 1.0, i, &u, &w, rule[graded]);
            if (graded) {
                w *= 4.0 * gsl_pow_3(u);
                u = gsl_pow_4(u);
            }
            u = part == 0 ? u / parts : 1.0 - u / parts;
            point[count++] = (rb_crack_point){
                e->from + u * e->length * e->t, w / parts * e->length, {1.0 - u, u}};
        }
    }
    return count;
}

/* Adds a traction at row node j that a density b = 1 or i (direction 0, 1) of element l
 * causes to the columns of its two nodes.  Rows and columns of F, which holds K until it
 * is inverted: x of all nodes, then y. */
static void add_entry(rb_crack *c, int j, int l, int direction, double complex traction)
{
    const int n = c->n;
    if (j < 0 || j >= n)
        return;
    for (int end = 0; end < 2; end++) {
        const int node = l + end - c->first;
        /* b = -dD/ds: along the element the hat of its first node falls, that of its second one
         * rises. */
        const double slope = (end ? -1.0 : 1.0) / c->element[l].length;
        if (node < 0 || node >= n)
            continue;
        double *column = c->F + (size_t)(node + direction * n) * 2 * (size_t)n;
        column[j] += slope * creal(traction);
        column[j + n] += slope * cimag(traction);
    }
}

/* The straight pieces by themselves, integrated by parts: logarithms, and what stands at
 * the ends of a piece where a hat is not zero. */
static rb_status add_collinear(rb_crack *c, double C)
{
    const rb_crack_element *e = c->element;

    for (int i = 0; i < c->shape.elements; i++) {
        if (rb_interrupted())
            return RB_INTERRUPTED;
        for (int l = 0; l < c->shape.elements; l++) {
            if (e[i].piece != e[l].piece)
                continue;
            /* Where a piece begins or ends the hat is not zero, and the integration by parts leaves
             * the value there. */
            const int starts = i == 0 || e[i - 1].piece != e[i].piece;
            const int ends = i + 1 == c->shape.elements || e[i + 1].piece != e[i].piece;
            double from = log_mean(&e[i], &e[l]) / e[i].length, to = from;
            if (starts)
                from -= log_integral(e[i].s, &e[l]);
            if (ends)
                to -= log_integral(e[i].s + e[i].length, &e[l]);
            for (int k = 0; k < 2; k++) {
                const double complex unit = k == 0 ? C : C * I;
                add_entry(c, i - c->first, l, k, unit * from);
                add_entry(c, i + 1 - c->first, l, k, -unit * to);
            }
        }
    }
    return RB_OK;
}

/* The surface, and the other pieces of a crack with kinks, by quadrature. */
static rb_status add_quadrature(rb_crack *c, double g)
{
    const rb_crack_element *e = c->element;
    const int n = c->shape.elements;
    gsl_integration_glfixed_table *const rule[2] = {gsl_integration_glfixed_table_alloc(POINTS),
                                                    gsl_integration_glfixed_table_alloc(GRADED)};

    rb_status status = rule[0] && rule[1] ? RB_OK : RB_ENOMEM;
    /* Row by row: tractions of all elements l at the points of element i, weighted by the hats of
     * its two nodes. */
    for (int i = 0; i < n && status == RB_OK; i++) {
        status = rb_interrupted() ? RB_INTERRUPTED : RB_OK;
        rb_crack_point point[2 * GRADED];
        const int points =
            rb_crack_points(&e[i], i == 0 ? c->first == 0 : e[i - 1].piece != e[i].piece,
                            i + 1 < n && e[i + 1].piece != e[i].piece, rule, point);
        for (int q = 0; q < points; q++)
            for (int l = 0; l < n; l++) {
                double complex traction[2] = {0.0, 0.0};
                if (!c->shape.full_plane)
                    add_image(&e[l], point[q].z, e[i].t, traction);
                if (e[i].piece != e[l].piece)
                    add_direct(&e[l], point[q].z, e[i].t, traction);
                for (int k = 0; k < 2; k++)
                    for (int end = 0; end < 2; end++)
                        add_entry(c, i + end - c->first, l, k,
                                  g * point[q].weight * point[q].hat[end] * traction[k]);
            }
    }
    for (int k = 0; k < 2; k++)
        if (rule[k])
            gsl_integration_glfixed_table_free(rule[k]);
    return status;
}

/* F = -K^-1 of the symmetric part; the quadrature alone makes K unsymmetric. */
static rb_status invert(rb_crack *c, rb_message *why)
{
    const size_t m = 2 * (size_t)c->n;
    double *F = c->F;

    for (size_t j = 0; j < m; j++)
        for (size_t i = 0; i <= j; i++)
            F[i + j * m] = -0.5 * (F[i + j * m] + F[j + i * m]);
    lapack_int fault = LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'U', (lapack_int)m, F, (lapack_int)m);
    if (fault == 0)
        fault = LAPACKE_dpotri(LAPACK_COL_MAJOR, 'U', (lapack_int)m, F, (lapack_int)m);
    for (size_t j = 0; j < m; j++)
        for (size_t i = 0; i < j; i++)
            F[j + i * m] = F[i + j * m];
    return fault == 0 ? RB_OK
                      : rb_fail(why, RB_SINGULAR,
                                "crack: the matrix of %d elements is not definite; "
                                "expected more elements or a larger angle",
                                c->shape.elements);
}

/* ---- The crack --------------------------------------------------------------------- */

void rb_crack_free(rb_crack *c)
{
    if (!c)
        return;
    rb_crack_contact_free(&c->faces);
    rb_crack_contact_free(&c->coupled);
    rb_arena_free(&c->memory);
    free(c);
}

/* Elements at s, and F in (N, T). */
static rb_status assemble(const rb_crack_shape *shape, const double *s, rb_crack **crack,
                          rb_message *why)
{
    /* G/(4 pi (1 - nu)) = G/(pi (kappa + 1)): the factor of a dislocation's stress in plane
     * strain. */
    const double g = shape->shear / (4.0 * M_PI * (1.0 - shape->poisson));
    rb_crack *c = *crack = calloc(1, sizeof *c);
    if (!c)
        return RB_ENOMEM;
    c->shape = *shape;
    c->first = shape->full_plane || shape->path.y[0] < 0.0;
    c->n = shape->elements - c->first;
    c->element = rb_arena_zeros(&c->memory, (size_t)shape->elements, sizeof *c->element);
    c->t = rb_arena_zeros(&c->memory, (size_t)c->n, sizeof *c->t);
    c->hat = rb_arena_doubles(&c->memory, (size_t)c->n, 1);
    c->F = rb_arena_doubles(&c->memory, 2 * (size_t)c->n, 2 * (size_t)c->n);
    if (c->memory.failed)
        return RB_ENOMEM;
    rb_crack_place(&c->shape.path, c->shape.elements, s, c->element);
    for (int j = 0; j < c->n; j++) { /* at a kink: the mean direction of both sides */
        const int k = c->first + j;
        const double complex sum = c->element[k].t + c->element[GSL_MAX(k - 1, 0)].t;
        c->t[j] = sum / cabs(sum);
        c->hat[j] = 0.5 * (c->element[k].length + (k > 0 ? c->element[k - 1].length : 0));
    }
    rb_status status = add_collinear(c, 2.0 * g);
    if (status == RB_OK && (!shape->full_plane || shape->path.pieces > 1))
        status = add_quadrature(c, g);
    if (status != RB_OK)
        return rb_fail(why, status, "crack: %s",
                       status == RB_INTERRUPTED ? "interrupted" : "out of memory");
    /* Turns K from (x, y) of all nodes to the frames (n, t) of each: its columns, that are D,
     * and its rows, that are forces. */
    const int n = c->n, m = 2 * n;

    for (int rows = 0; rows < 2; rows++)
        for (int j = 0; j < n; j++) {
            const int step = rows ? m : 1;
            double *x = c->F + (size_t)j * (rows ? 1 : m), *y = x + (size_t)n * (rows ? 1 : m);
            cblas_drot(m, x, step, y, step, creal(c->t[j]), cimag(c->t[j])); /* (t, n) */
            cblas_dswap(m, x, step, y, step);
        }
    return invert(c, why);
}

/* K over D at the node next to the tip, from the same elements along a straight crack
 * that is opened by unit tension and whose K_I is known: the error of the last node
 * cancels. */
static rb_status calibrate(rb_crack *c, const double *s, rb_message *why)
{
    const double length = s[c->shape.elements];
    rb_crack_shape straight = c->shape;
    rb_crack *known = NULL;
    straight.full_plane = c->first;
    straight.path = rb_crack_straight(0.0, 0.0, length, 90.0);
    const rb_status status = assemble(&straight, s, &known, why);
    if (status == RB_OK) {
        /* D_N of the last node under unit tension on all nodes. */
        const double D = cblas_ddot(known->n, known->F + known->n - 1, 2 * known->n, known->hat, 1);
        c->per_D = (c->first ? sqrt(0.5) : EDGE_CRACK) * sqrt(M_PI * length) / D;
    }
    rb_crack_free(known);
    return status;
}

rb_status rb_crack_create(const rb_crack_shape *shape, rb_crack **crack, rb_message *why)
{
    *crack = NULL;
    rb_status status = check_shape(shape, why);
    if (status != RB_OK)
        return status;
    double *s = rb_alloc((size_t)shape->elements + 1, 1);
    status = RB_ENOMEM;
    if (s) {
        rb_crack_grade(&shape->path, shape->elements, s);
        status = assemble(shape, s, crack, why);
    }
    if (status == RB_OK)
        status = calibrate(*crack, s, why);
    if (status == RB_OK)
        status = rb_crack_contact_alloc(*crack, 0, &(*crack)->faces);
    if (status == RB_OK) {
        memcpy((*crack)->faces.F, (*crack)->F,
               4 * (size_t)(*crack)->n * (size_t)(*crack)->n * sizeof *s);
        status = rb_crack_contact_pose(*crack, &(*crack)->faces);
    }
    free(s);
    if (status != RB_OK) {
        rb_crack_free(*crack);
        *crack = NULL;
    }
    return status == RB_ENOMEM
               ? rb_fail(why, status, "crack: out of memory for %d elements", shape->elements)
               : status;
}

int rb_crack_nodes(const rb_crack *c)
{
    return c->n;
}

void rb_crack_places(const rb_crack *c, double *x, double *y, double *hat, double *t_x, double *t_y)
{
    double *const to[] = {x, y, hat, t_x, t_y};
    for (int j = 0; j < c->n; j++) {
        const double complex z = c->element[c->first + j].from;
        const double place[] = {creal(z), cimag(z), c->hat[j], creal(c->t[j]), cimag(c->t[j])};
        for (int k = 0; k < 5; k++)
            if (to[k])
                to[k][j] = place[k];
    }
}

const double *rb_crack_flexibility(const rb_crack *c)
{
    return c->F;
}
