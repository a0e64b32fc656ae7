/* Shape of a crack, its elements and its flexibility: the Galerkin form (C4) of the
 * equations of continuous dislocations below a free surface (C1)-(C3). */
#include "crack/internal.h"

#include <cblas.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>
#include <lapacke.h>
#include <stdlib.h>
#include <string.h>

/* Points per element; HALF of them, graded towards an end where the stress is singular.
 */
enum {
    POINTS = 10,
    GRADED = 24,
    PIECE_ELEMENTS = 3,
    LEAST_ELEMENTS = 4,
    MOST_ELEMENTS = 2000
};
/* Below this angle [degrees] the faces of so few elements would be wrong. */
enum { SHALLOW_ANGLE = 15, SHALLOW_ELEMENTS = 40 };
/* K_I of a crack of 90 degrees with its mouth in the surface, unit tension, a = 1. */
static const double EDGE_CRACK = 1.1215222552;

/* ---- Shape ------------------------------------------------------------------------- */

rb_crack_path rb_crack_straight(double mouth, double depth, double length, double angle)
{
    const double w = angle * (M_PI / 180.0);
    return (rb_crack_path){.pieces = 1,
                           .x = {mouth, mouth + length * cos(w)},
                           .y = {-depth, -depth - length * sin(w)}};
}

static double complex place(const rb_crack_path *path, int k)
{
    return path->x[k] + I * path->y[k];
}

static rb_status check_shape(const rb_crack_shape *shape, rb_message *why)
{
    const rb_crack_path *path = &shape->path;

    if (path->pieces < 1 || path->pieces > RB_CRACK_PIECES)
        return rb_fail(why, RB_EINVAL, "crack: %d pieces, expected 1 ... %d",
                       path->pieces, RB_CRACK_PIECES);
    if (shape->elements < GSL_MAX(LEAST_ELEMENTS, 2 * path->pieces) ||
        shape->elements > MOST_ELEMENTS)
        return rb_fail(why, RB_EINVAL,
                       "crack: %d elements on %d straight pieces, expected two a piece, "
                       "%d ... %d; give more elements",
                       shape->elements, path->pieces,
                       GSL_MAX(LEAST_ELEMENTS, 2 * path->pieces), MOST_ELEMENTS);
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
            return rb_fail(why, RB_EINVAL,
                           "crack: the place (%g, %g) lies outside the body y < 0",
                           path->x[k], path->y[k]);
        const double fall = k > 0 ? path->y[k - 1] - path->y[k] : 0.0;
        if (k == 1 && !shape->full_plane && path->y[0] == 0.0 &&
            shape->elements < SHALLOW_ELEMENTS &&
            fall < length * sin(SHALLOW_ANGLE * M_PI / 180.0) * (1.0 - 1e-12))
            return rb_fail(why, RB_EINVAL,
                           "crack: below %d degrees to the surface expected at least %d "
                           "elements, got %d",
                           SHALLOW_ANGLE, SHALLOW_ELEMENTS, shape->elements);
    }
    return RB_OK;
}

/* Ends s of the elements, a sin^2(phi), phi = 0 ... 90 degrees, graded towards both ends
 * of the crack.  phi is stretched so that each kink of the path falls on an end. */
static void grade(const rb_crack_path *path, int n, double *s)
{
    double length = 0.0, before = 0.0, phi_before = 0.0;
    int from = 0;
    const int least = GSL_MIN(PIECE_ELEMENTS, n / path->pieces);

    for (int k = 0; k < path->pieces; k++)
        length += cabs(place(path, k + 1) - place(path, k));
    for (int k = 0; k < path->pieces; k++) {
        const double end = before + cabs(place(path, k + 1) - place(path, k));
        const double phi =
            k + 1 == path->pieces ? 1.0 : asin(sqrt(fmin(end / length, 1.0))) / M_PI_2;
        /* so many at least for this piece and for each one that is left */
        const int to = k + 1 == path->pieces
                           ? n
                           : GSL_MIN(GSL_MAX((int)lround(n * phi), from + least),
                                     n - least * (path->pieces - 1 - k));
        for (int j = from; j <= to; j++) {
            const double u = phi_before + (phi - phi_before) * (j - from) / (to - from);
            const double sine = sin(M_PI_2 * u);
            s[j] = length * sine * sine;
        }
        s[from] = before;
        s[to] = end;
        before = end;
        phi_before = phi;
        from = to;
    }
}

static void set_elements(rb_crack *c, const double *s)
{
    const rb_crack_path *path = &c->shape.path;
    double before = 0.0, length = cabs(place(path, 1) - place(path, 0));

    for (int k = 0, piece = 0; k < c->shape.elements; k++) {
        if (0.5 * (s[k] + s[k + 1]) > before + length) {
            before += length;
            piece++;
            length = cabs(place(path, piece + 1) - place(path, piece));
        }
        const double complex t = (place(path, piece + 1) - place(path, piece)) / length;
        c->element[k] =
            (rb_crack_element){.from = place(path, piece) + (s[k] - before) * t,
                               .t = t,
                               .length = s[k + 1] - s[k],
                               .s = s[k],
                               .piece = piece};
    }
    for (int j = 0; j < c->n; j++) { /* at a kink: the mean direction of both sides */
        const int k = c->first + j;
        const double complex sum = c->element[k].t + c->element[GSL_MAX(k - 1, 0)].t;
        c->t[j] = sum / cabs(sum);
        c->hat[j] = 0.5 * (c->element[k].length + (k > 0 ? c->element[k - 1].length : 0));
    }
}

/* ---- Kernels (C2) ------------------------------------------------------------------ */

static inline double complex inverse(double complex c)
{
    return conj(c) / (creal(c) * creal(c) + cimag(c) * cimag(c));
}

/* Tractions sigma n at z on a plane of direction t_z, from a density g i (first) and g
 * (second) of gamma on an element, g = 1: direct part of the full plane, image part of
 * the surface. */
static void add_direct(const rb_crack_element *e, double complex z, double complex t_z,
                       double complex traction[2])
{
    const double complex z1 = z - e->from, z2 = z1 - e->length * e->t, r = 1.0 / e->t;
    const double complex J1 = clog(z1 * inverse(z2)) * r;
    const double complex J2 = (inverse(z2) - inverse(z1)) * r;
    const double complex turn = conj(e->t) * r;
    const double complex lever = conj(e->from) + turn * z1;
    for (int k = 0; k < 2; k++) {
        const double complex g = k == 0 ? -I : 1.0;
        const double complex Phi = g * J1, slope = -g * J2;
        const double complex Psi = conj(g) * J1 + g * (lever * J2 - turn * J1);
        const double complex s = 2.0 * creal(Phi) + t_z * t_z * (conj(z) * slope + Psi);
        traction[k] += I * t_z * conj(s);
    }
}

static void add_image(const rb_crack_element *e, double complex z, double complex t_z,
                      double complex traction[2])
{
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
        const double complex slope =
            (2.0 * h + g - 2.0 * h * turn) * I2 + 2.0 * h * lever * I3;
        const double complex Psi = -h * I1 - Phi - z * slope;
        const double complex s = 2.0 * creal(Phi) + t_z * t_z * (conj(z) * slope + Psi);
        traction[k] += I * t_z * conj(s);
    }
}

/* Second antiderivative of ln|x|. */
static double twice(double x)
{
    return x == 0.0 ? 0.0 : x * x * (0.5 * log(fabs(x)) - 0.75);
}

/* int int ln|s - s'| over [a, a + k] x [c, c + l]. */
static double log_mean(double a, double k, double c, double l)
{
    static const double x[] = {-0.77459666924148338, 0.0, 0.77459666924148338},
                        w[] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    const double apart = fabs(a + 0.5 * k - c - 0.5 * l);
    double sum = 0.0;

    if (apart < 30.0 * fmax(k, l))
        return -(twice(a + k - c - l) - twice(a + k - c) - twice(a - c - l) +
                 twice(a - c));
    for (int i = 0; i < 3; i++) /* the four terms would cancel */
        for (int j = 0; j < 3; j++)
            sum += w[i] * w[j] *
                   log(fabs(a + 0.5 * k * (1 + x[i]) - c - 0.5 * l * (1 + x[j])));
    return k * l * sum;
}

/* int ln|s - s'| ds' over [c, c + l]. */
static double log_integral(double s, double c, double l)
{
    const double x = s - c, y = x - l;
    return (x == 0.0 ? 0.0 : x * log(fabs(x))) - (y == 0.0 ? 0.0 : y * log(fabs(y))) - l;
}

/* ---- Matrix (C4) ------------------------------------------------------------------- */

/* Points of element e: POINTS, or in two halves GRADED ones towards an end where the
 * stress of its neighbours is singular.  Returns how many. */
static int spread_points(const rb_crack_element *e, int graded_from, int graded_to,
                         gsl_integration_glfixed_table *const rule[2],
                         rb_crack_point *point)
{
    const int parts = graded_from || graded_to ? 2 : 1;
    int count = 0;

    for (int part = 0; part < parts; part++) {
        const int graded = part == 0 ? graded_from : graded_to;
        const size_t points = graded ? GRADED : POINTS;
        for (size_t i = 0; i < points; i++) {
            double u, w;
            gsl_integration_glfixed_point(0.0, 1.0, i, &u, &w, rule[graded]);
            if (graded) {
                w *= 4.0 * gsl_pow_3(u);
                u = gsl_pow_4(u);
            }
            w /= parts;
            u = part == 0 ? u / parts : 1.0 - u / parts;
            point[count++] = (rb_crack_point){
                e->from + u * e->length * e->t, w * e->length, {1.0 - u, u}};
        }
    }
    return count;
}

void rb_crack_load_points(const rb_crack_element *e, rb_crack_point *point)
{
    static const double x[] = {0.23861918608319691, 0.66120938646626451,
                               0.93246951420315203},
                        w[] = {0.46791393457269105, 0.36076157304813861,
                               0.17132449237917036};
    for (int i = 0; i < RB_CRACK_LOAD_POINTS; i++) {
        const double u = 0.5 * (i % 2 ? 1.0 + x[i / 2] : 1.0 - x[i / 2]);
        point[i] = (rb_crack_point){
            e->from + u * e->length * e->t, 0.5 * w[i / 2] * e->length, {1.0 - u, u}};
    }
}

/* Nodal forces of unit D, and of densities: columns (x, y) of each element's density
 * become those of its two nodes.  rows, ld = 2n: x of all nodes, then y. */
typedef struct {
    const rb_crack *c;
    double *K;
} assembly;

/* Adds a traction that a density b = 1 or i (0, 1) of element l causes at row node j. */
static void add_entry(const assembly *a, int j, int l, int direction,
                      double complex traction)
{
    const rb_crack *c = a->c;
    const int n = c->n;
    const double slope = 1.0 / c->element[l].length;
    if (j < 0 || j >= n)
        return;
    for (int end = 0; end < 2; end++) {
        const int node = l + end - c->first;
        if (node < 0 || node >= n)
            continue;
        double *column = a->K + (size_t)(node + direction * n) * 2 * (size_t)n;
        column[j] += (end ? -slope : slope) * creal(traction);
        column[j + n] += (end ? -slope : slope) * cimag(traction);
    }
}

/* The straight pieces by themselves, integrated by parts: logarithms, and what stands at
 * the ends of a piece where a hat is not zero. */
static void add_collinear(const assembly *a, double C)
{
    const rb_crack *c = a->c;
    const rb_crack_element *e = c->element;

    for (int i = 0; i < c->shape.elements; i++)
        for (int l = 0; l < c->shape.elements; l++) {
            if (e[i].piece != e[l].piece)
                continue;
            const double mean =
                C * log_mean(e[i].s, e[i].length, e[l].s, e[l].length) / e[i].length;
            const int starts = i == 0 || e[i - 1].piece != e[i].piece;
            const int ends = i + 1 == c->shape.elements || e[i + 1].piece != e[i].piece;
            const double from =
                starts ? C * log_integral(e[i].s, e[l].s, e[l].length) : 0.0;
            const double to =
                ends ? C * log_integral(e[i].s + e[i].length, e[l].s, e[l].length) : 0.0;
            for (int k = 0; k < 2; k++) {
                const double complex unit = k == 0 ? 1.0 : I;
                add_entry(a, i - c->first, l, k, unit * (mean - from));
                add_entry(a, i + 1 - c->first, l, k, unit * (to - mean));
            }
        }
}

/* The surface, and the other pieces of a crack with kinks, by quadrature. */
static rb_status add_quadrature(const assembly *a, double g)
{
    const rb_crack *c = a->c;
    const rb_crack_element *e = c->element;
    const int n = c->shape.elements;
    gsl_integration_glfixed_table *const rule[2] = {
        gsl_integration_glfixed_table_alloc(POINTS),
        gsl_integration_glfixed_table_alloc(GRADED)};

    for (int i = 0; i < n && rule[0] && rule[1]; i++) {
        rb_crack_point point[2 * GRADED];
        const int points =
            spread_points(&e[i], i == 0 ? c->first == 0 : e[i - 1].piece != e[i].piece,
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
                        add_entry(a, i + end - c->first, l, k,
                                  g * point[q].weight * point[q].hat[end] * traction[k]);
            }
    }
    for (int k = 0; k < 2; k++)
        if (rule[k])
            gsl_integration_glfixed_table_free(rule[k]);
    return rule[0] && rule[1] ? RB_OK : RB_ENOMEM;
}

/* From (x, y) of all nodes to the frames (n, t) of each: entries of nodes i and j. */
static void turn_into_frames(const rb_crack *c, double *K)
{
    const int n = c->n;
    const size_t ld = 2 * (size_t)n;

    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            double *at[2][2], turned[2][2];
            for (int v = 0; v < 2; v++)
                for (int u = 0; u < 2; u++)
                    at[u][v] = K + i + u * n + (size_t)(j + v * n) * ld;
            for (int v = 0; v < 2; v++) {
                const double complex in = v == 0 ? I * c->t[j] : c->t[j];
                const double complex out =
                    *at[0][0] * creal(in) + *at[0][1] * cimag(in) +
                    I * (*at[1][0] * creal(in) + *at[1][1] * cimag(in));
                turned[0][v] = creal(out * conj(I * c->t[i]));
                turned[1][v] = creal(out * conj(c->t[i]));
            }
            for (int v = 0; v < 2; v++)
                for (int u = 0; u < 2; u++)
                    *at[u][v] = turned[u][v];
        }
}

/* F = -K^-1 of the symmetric part; the quadrature alone makes K unsymmetric. */
static rb_status invert(rb_crack *c, double *K, rb_message *why)
{
    const size_t m = 2 * (size_t)c->n;
    double difference = 0.0;

    for (size_t j = 0; j < m; j++)
        for (size_t i = 0; i <= j; i++) {
            double *upper = &K[i + j * m], *lower = &K[j + i * m];
            difference = fmax(difference, fabs(*upper - *lower));
            *upper = *lower = -0.5 * (*upper + *lower);
        }
    c->asymmetry = difference / rb_norm_inf(m * m, K);
    lapack_int fault =
        LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'U', (lapack_int)m, K, (lapack_int)m);
    if (fault == 0)
        fault = LAPACKE_dpotri(LAPACK_COL_MAJOR, 'U', (lapack_int)m, K, (lapack_int)m);
    for (size_t j = 0; j < m; j++)
        for (size_t i = 0; i < j; i++)
            K[j + i * m] = K[i + j * m];
    return fault == 0 ? RB_OK
                      : rb_fail(why, RB_SINGULAR,
                                "crack: the matrix of %d elements is not definite; "
                                "expected more elements or a larger angle",
                                c->shape.elements);
}

/* Elements at s, and F in (N, T). */
static rb_status assemble(rb_crack *c, const double *s, rb_message *why)
{
    const double kappa = 3.0 - 4.0 * c->shape.poisson;
    const double g = c->shape.shear / (M_PI * (kappa + 1.0));
    const assembly a = {c, c->F};
    const int straight = c->shape.path.pieces == 1;

    set_elements(c, s);
    add_collinear(&a, 2.0 * g);
    const rb_status status =
        c->shape.full_plane && straight ? RB_OK : add_quadrature(&a, g);
    if (status != RB_OK)
        return status;
    turn_into_frames(c, c->F);
    return invert(c, c->F, why);
}

/* ---- The crack --------------------------------------------------------------------- */

void rb_crack_free(rb_crack *c)
{
    if (!c)
        return;
    rb_contact_problem_free(&c->problem);
    rb_contact_state_free(&c->contact);
    rb_contact_state_free(&c->wheel);
    free(c->element);
    free(c->t);
    free(c->hat);
    free(c->scale);
    free(c->F);
    free(c->scaled);
    free(c);
}

static rb_crack *alloc(const rb_crack_shape *shape)
{
    rb_crack *c = calloc(1, sizeof *c);
    if (!c)
        return NULL;
    c->shape = *shape;
    c->first = shape->full_plane || shape->path.y[0] < 0.0;
    c->n = shape->elements - c->first;
    const size_t n = (size_t)c->n;
    c->element = calloc((size_t)shape->elements, sizeof *c->element);
    c->t = calloc(n, sizeof *c->t);
    c->hat = rb_alloc(n, 1);
    c->scale = rb_alloc(n, 1);
    c->F = rb_alloc(2 * n, 2 * n);
    c->scaled = rb_alloc(2 * n, 2 * n);
    if (c->element && c->t && c->hat && c->scale && c->F && c->scaled)
        return c;
    rb_crack_free(c);
    return NULL;
}

/* K over D at the node next to the tip, from the same elements along a straight crack
 * that is opened by unit tension and whose K_I is known: the error of the last node
 * cancels. */
static rb_status calibrate(rb_crack *c, const double *s, rb_message *why)
{
    const double length = s[c->shape.elements];
    rb_crack_shape straight = c->shape;
    straight.full_plane = c->first;
    straight.path = rb_crack_straight(0.0, 0.0, length, 90.0);
    rb_crack *known = alloc(&straight);
    rb_status status = known ? assemble(known, s, why) : RB_ENOMEM;
    if (status == RB_OK) {
        const int last = known->n - 1;
        const double D =
            cblas_ddot(known->n, known->F + last, 2 * known->n, known->hat, 1);
        c->per_D = c->first ? sqrt(0.5 * M_PI * length) / D
                            : EDGE_CRACK * sqrt(M_PI * length) / D;
    }
    rb_crack_free(known);
    return status;
}

/* The contact of the faces, scaled so that the diagonal of F_NN is 1. */
static rb_status pose_contact(rb_crack *c)
{
    const size_t n = (size_t)c->n, m = 2 * n;
    for (size_t j = 0; j < n; j++)
        c->scale[j] = 1.0 / sqrt(c->F[j + j * m]);
    for (size_t j = 0; j < m; j++)
        for (size_t i = 0; i < m; i++)
            c->scaled[i + j * m] = c->F[i + j * m] * c->scale[i % n] * c->scale[j % n];
    double *S = rb_alloc(n, m);
    rb_contact_operator *op = NULL;
    if (!S)
        return RB_ENOMEM;
    for (size_t j = 0; j < m; j++)
        memcpy(S + j * n, c->scaled + n + j * m, n * sizeof *S);
    rb_status s = rb_contact_operator_dense(c->n, c->scaled, (int)m, S, &op);
    if (s == RB_OK)
        s = rb_contact_problem_alloc(op, &c->problem);
    if (s == RB_OK)
        s = rb_contact_state_alloc(c->n, &c->contact);
    if (s == RB_OK)
        rb_contact_set_friction(&c->problem, c->shape.friction, NULL);
    return s;
}

rb_status rb_crack_create(const rb_crack_shape *shape, rb_crack **crack, rb_message *why)
{
    rb_status status = check_shape(shape, why);
    *crack = NULL;
    if (status != RB_OK)
        return status;
    rb_crack *c = alloc(shape);
    double *s = rb_alloc((size_t)shape->elements + 1, 1);
    status = c && s ? RB_OK : RB_ENOMEM;
    if (status == RB_OK) {
        grade(&shape->path, shape->elements, s);
        status = assemble(c, s, why);
    }
    if (status == RB_OK)
        status = calibrate(c, s, why);
    if (status == RB_OK)
        status = pose_contact(c);
    free(s);
    if (status == RB_OK)
        *crack = c;
    else
        rb_crack_free(c);
    return status == RB_ENOMEM ? rb_fail(why, status,
                                         "crack: out of memory for %d "
                                         "elements",
                                         shape->elements)
                               : status;
}

int rb_crack_nodes(const rb_crack *c)
{
    return c->n;
}

void rb_crack_places(const rb_crack *c, double *x, double *y, double *hat, double *t_x,
                     double *t_y)
{
    for (int j = 0; j < c->n; j++) {
        const double complex z = c->element[c->first + j].from;
        if (x)
            x[j] = creal(z);
        if (y)
            y[j] = cimag(z);
        if (hat)
            hat[j] = c->hat[j];
        if (t_x)
            t_x[j] = creal(c->t[j]);
        if (t_y)
            t_y[j] = cimag(c->t[j]);
    }
}

const double *rb_crack_flexibility(const rb_crack *c)
{
    return c->F;
}

double rb_crack_asymmetry(const rb_crack *c)
{
    return c->asymmetry;
}
