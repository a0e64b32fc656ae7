/* What the rest of a wheel adds to the half-plane that answers like it close to a load (B10): a
 * smooth function of both places, so that few points of one mesh tell it on any other.  The
 * search for the edges of the contact then solves the boundary of the wheel only once. */
#include "rolling/body/far_field.h"
#include "rolling/body/mesh.h"
#include "rolling/case/derived.h"

#include <cblas.h>
#include <stdlib.h>
#include <string.h>

/* At most so many points along the mesh: between them the polynomials of fourth order are exact to
 * 1e-8 of the displacement where the contact is as wide as a third of the radius. */
enum { POINTS = 24, ORDER = 4 };

struct rb_rolling_far_field {
    int n;
    double *x;  /* n: places [length] */
    double *w0; /* 2n: displacements without loads [length] */
    double *F;  /* 2n x 2n: displacements for unit forces along the normal and along the surface */
    int elements; /* 0, or of meshes to which `more` is added */
    double *more; /* 2 (elements + 1): displacements [length] */
    rb_arena memory;
};

void rb_rolling_far_field_free(rb_rolling_far_field *far)
{
    if (!far)
        return;
    rb_arena_free(&far->memory);
    free(far);
}

static int has_far_field(const rb_rolling_case *rc, const rb_rolling_body *body)
{
    return rb_rolling_kind_of(body)->near && rb_rolling_body_can(body, RB_BODY_HOMOGENEOUS) &&
           rb_rolling_body_can(body, RB_BODY_ELASTIC) &&
           rb_rolling_subtracts(rc, &(rb_rolling_plan){.near_field = rc->near_field}, body);
}

int rb_rolling_has_far_field(const rb_rolling_case *rc)
{
    const int of_a = has_far_field(rc, &rc->a), of_b = rc->elastic_b && has_far_field(rc, &rc->b);

    return (of_a || of_b) && (of_a || rb_rolling_body_can(&rc->a, RB_BODY_FLAT)) &&
           (!rc->elastic_b || of_b || rb_rolling_body_can(&rc->b, RB_BODY_FLAT)) &&
           !rb_rolling_relaxes(rc) && rb_rolling_is_convex(rc) &&
           rc->normals == RB_BEM_NORMALS_OBSTACLE;
}

/* Elements of the mesh, about equally far from each other, the same ones from either end, the first
 * and the last among them. */
static int choose_points(const rb_bem_flexibility *f, int chosen[POINTS + 2])
{
    const int last = f->n - 1;
    const double step = (f->x[last] - f->x[0]) / POINTS, middle = 0.5 * (f->x[0] + f->x[last]);
    int n = 1;

    chosen[0] = 0;
    for (int i = 1; 2 * i < last && n < POINTS / 2; i++)
        if (f->x[i] >= f->x[chosen[n - 1]] + step && f->x[i] <= middle - 0.5 * step)
            chosen[n++] = i;
    for (int k = n - 1; k >= 0; k--)
        chosen[n++] = last - chosen[k];
    return n;
}

/* r (2n): the pressures of the model and its frictions. */
static void copy_tractions(const rb_rolling_model *model, double *r)
{
    const size_t n = (size_t)model->bodies.f.n;

    memcpy(r, model->state.p, n * sizeof *r);
    memcpy(r + n, model->state.q, n * sizeof *r);
}

/* D (2m x loads): what the boundaries of the model displace more under loads r (2n x loads) than
 * half-planes do, from its matrix. */
static rb_status displaced_more(const rb_rolling_model *model, int loads, const double *r,
                                double *D, rb_message *why)
{
    const int n = model->bodies.f.n, rows = 2 * (n + 1);
    rb_rolling_bodies near = {.F = NULL};
    const rb_status s = rb_rolling_bodies_near(model->rc, NULL, &model->mesh, &near, why);

    if (s == RB_OK) {
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, rows, loads, 2 * n, 1.0,
                    model->bodies.F, rows, r, 2 * n, 0.0, D, rows);
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, rows, loads, 2 * n, -1.0, near.F,
                    rows, r, 2 * n, 1.0, D, rows);
    }
    rb_rolling_bodies_free(&near);
    return s;
}

/* Lagrange's polynomial through the four points around x: where they begin, and their weights. */
static int weights_at(const rb_rolling_far_field *far, double x, double weight[ORDER])
{
    int first = 0;

    while (first < far->n - ORDER && far->x[first + ORDER / 2] < x)
        first++;
    for (int k = 0; k < ORDER; k++) {
        weight[k] = 1.0;
        for (int l = 0; l < ORDER; l++)
            if (l != k)
                weight[k] *= (x - far->x[first + l]) / (far->x[first + k] - far->x[first + l]);
    }
    return first;
}

/* w (2m) += what the far field displaces under r (2n) on the elements of f. */
static void add_displacement(const rb_rolling_far_field *far, const rb_bem_flexibility *f,
                             const double *r, double *w)
{
    const int n = far->n, m = f->m;
    double force[2 * (POINTS + 2)] = {0.0}, at_points[2 * (POINTS + 2)], weight[ORDER];

    for (int j = 0; j < f->n; j++) {
        const int first = weights_at(far, f->x[j], weight);
        for (int b = 0; b < 2; b++)
            for (int k = 0; k < ORDER; k++)
                force[b * n + first + k] += weight[k] * f->h[j] * r[b * f->n + j];
    }
    memcpy(at_points, far->w0, 2 * (size_t)n * sizeof *at_points);
    cblas_dgemv(CblasColMajor, CblasNoTrans, 2 * n, 2 * n, 1.0, far->F, 2 * n, force, 1, 1.0,
                at_points, 1);
    for (int i = 0; i < m; i++) {
        const int first = weights_at(far, f->x[i], weight);
        for (int a = 0; a < 2; a++)
            for (int k = 0; k < ORDER; k++)
                w[a * m + i] += weight[k] * at_points[a * n + first + k];
    }
}

/* The least-squares line through w over x, weighted by the lengths of the elements of f: its mean
 * and its slope at the middle of the contact. */
static void least_squares_line(const rb_bem_flexibility *f, const double *w, double *middle,
                               double *mean, double *slope)
{
    double length = 0.0, first = 0.0, second = 0.0;

    *mean = *slope = 0.0;
    for (int i = 0; i < f->n; i++) {
        length += f->h[i];
        first += f->h[i] * f->x[i];
        *mean += f->h[i] * w[i];
    }
    *middle = first / length;
    *mean /= length;
    for (int i = 0; i < f->n; i++) {
        const double x = f->x[i] - *middle;
        second += f->h[i] * x * x;
        *slope += f->h[i] * x * w[i];
    }
    *slope /= second;
}

/* From now on the field moves elements like those of f under tractions r (2n) by D (2m). */
static rb_status match(rb_rolling_far_field *far, const rb_bem_flexibility *f, const double *r,
                       const double *D)
{
    const size_t rows = 2 * (size_t)f->m;

    far->more = rb_arena_doubles(&far->memory, rows, 1);
    if (far->memory.failed)
        return RB_ENOMEM;
    far->elements = f->n;
    add_displacement(far, f, r, far->more);
    for (size_t i = 0; i < rows; i++)
        far->more[i] = D[i] - far->more[i];
    /* Most of it is a line, as far boundaries move: it goes to the points of the far field, and
     * serves for other meshes, too. */
    for (int a = 0; a < 2; a++) {
        double *w = far->more + a * f->m, *w0 = far->w0 + a * far->n, middle, mean, slope;
        least_squares_line(f, w, &middle, &mean, &slope);
        for (int i = 0; i < f->m; i++)
            w[i] -= mean + slope * (f->x[i] - middle);
        for (int k = 0; k < far->n; k++)
            w0[k] += mean + slope * (far->x[k] - middle);
    }
    return RB_OK;
}

rb_status rb_rolling_far_field_create(const rb_rolling_model *model, int matched,
                                      rb_rolling_far_field **far, rb_message *why)
{
    const rb_bem_flexibility *f = &model->bodies.f;
    const size_t rows = 2 * (size_t)f->m, tractions = 2 * (size_t)f->n;
    int chosen[POINTS + 2];
    const int n = choose_points(f, chosen), loads = 2 * n + matched;
    rb_arena scratch = {0};
    rb_rolling_far_field *made = *far = calloc(1, sizeof *made);

    if (!made)
        return rb_fail(why, RB_ENOMEM, "out of memory for a far field");
    made->n = n;
    made->x = rb_arena_doubles(&made->memory, (size_t)n, 1);
    made->w0 = rb_arena_doubles(&made->memory, 2 * (size_t)n, 1);
    made->F = rb_arena_doubles(&made->memory, 2 * (size_t)n, 2 * (size_t)n);
    double *r = rb_arena_doubles(&scratch, tractions, (size_t)loads),
           *D = rb_arena_doubles(&scratch, rows, (size_t)loads);
    rb_status s = made->memory.failed || scratch.failed ? RB_ENOMEM : RB_OK;
    for (int j = 0; j < 2 * n && s == RB_OK; j++) {
        const int element = chosen[j % n];
        r[(size_t)j * tractions + (size_t)(j / n * f->n + element)] = 1.0 / f->h[element];
    }
    double *own_r = r + 2 * (size_t)n * tractions, *own_D = D + 2 * (size_t)n * rows;
    if (matched && s == RB_OK)
        copy_tractions(model, own_r);
    if (s == RB_OK)
        s = displaced_more(model, loads, r, D, why);
    for (int i = 0; i < 2 * n && s == RB_OK; i++) {
        const size_t row = (size_t)(i / n * f->m + chosen[i % n]);
        made->x[i % n] = f->x[chosen[i % n]];
        made->w0[i] = f->w0[row];
        for (int j = 0; j < 2 * n; j++)
            made->F[i + (size_t)j * 2 * (size_t)n] = D[row + (size_t)j * rows];
    }
    if (matched && s == RB_OK) {
        cblas_daxpy((int)rows, 1.0, f->w0, 1, own_D, 1);
        s = match(made, f, own_r, own_D);
    }
    if (s == RB_ENOMEM)
        rb_fail(why, RB_ENOMEM, "out of memory for a far field of %d points", n);
    if (s != RB_OK) {
        rb_rolling_far_field_free(made);
        *far = NULL;
    }
    return rb_arena_done(&scratch, s);
}

rb_status rb_rolling_far_field_match(const rb_rolling_model *model, rb_rolling_far_field *far,
                                     rb_message *why)
{
    const rb_rolling_case *rc = model->rc;
    const rb_bem_flexibility *f = &model->bodies.f;
    const int n = f->n, rows = 2 * f->m;
    rb_arena scratch = {0};
    double *r = rb_arena_doubles(&scratch, (size_t)n, 2),
           *own_r = rb_arena_doubles(&scratch, (size_t)n, 2),
           *D = rb_arena_doubles(&scratch, (size_t)rows, 1),
           *w = rb_arena_doubles(&scratch, (size_t)rows, 1),
           *w0 = rb_arena_doubles(&scratch, (size_t)rows, 1);
    rb_status s = scratch.failed ? RB_ENOMEM : RB_OK;

    if (s == RB_OK)
        copy_tractions(model, r);
    /* What the boundaries of each body displace more than half-planes do, and without loads. */
    for (int b = 0; b < 1 + rc->elastic_b && s == RB_OK; b++) {
        const rb_rolling_body *body = b ? &rc->b : &rc->a;
        const double along = b ? -1.0 : 1.0; /* B is computed as the mirror image (4.5) */
        rb_rolling_body_flexibility near = {.system = NULL};
        rb_bem_system *system = NULL;
        if (!has_far_field(rc, body))
            continue;
        for (int k = 0; k < 2 * n; k++)
            own_r[k] = k < n ? r[k] : along * r[k];
        s = rb_rolling_boundary_system(model, b, 1, &system, why);
        if (s == RB_OK)
            s = rb_bem_displacement_subtracted(system, rc->normals, 1, own_r, w, w0, why);
        if (s == RB_OK)
            s = rb_rolling_kind_of(body)->near(rc, &model->plan, body, &model->mesh, &near, why);
        if (s == RB_OK)
            cblas_dgemv(CblasColMajor, CblasNoTrans, rows, 2 * n, -1.0,
                        rb_bem_flexibility_stored(&near.f), rows, own_r, 1, 1.0, w, 1);
        for (int i = 0; i < rows && s == RB_OK; i++)
            D[i] += (i > n ? along : 1.0) * (w[i] + w0[i]);
        rb_bem_flexibility_free(&near.f);
        rb_bem_system_free(system);
    }
    if (s == RB_OK)
        s = match(far, f, r, D);
    if (s == RB_ENOMEM)
        rb_fail(why, s, "out of memory for a far field");
    return rb_arena_done(&scratch, s);
}

int rb_rolling_far_field_matches(const rb_rolling_far_field *far, int elements)
{
    return far->elements == elements;
}

rb_status rb_rolling_far_field_add(const rb_rolling_far_field *far, rb_bem_flexibility *f)
{
    const int n = far->n, m = f->m, loads = f->n;
    struct {
        int first;
        double weight[ORDER];
    } *at = calloc((size_t)m, sizeof *at); /* of the polynomials at the places of f */
    double *column = rb_alloc(2 * (size_t)m, 1), at_points[2 * (POINTS + 2)];
    rb_status s = at && column ? RB_OK : RB_ENOMEM;

    for (int i = 0; i < m && s == RB_OK; i++)
        at[i].first = weights_at(far, f->x[i], at[i].weight);
    /* A force on an element is one on the four points around it, and moves them all; each place
     * moves as the four around it do. */
    for (int j = 0; j < 2 * loads && s == RB_OK; j++) {
        const int load = j % loads;
        const double *F = far->F + (size_t)(j / loads * n + at[load].first) * 2 * (size_t)n;
        for (int i = 0; i < 2 * n; i++) {
            double sum = 0.0;
            for (int k = 0; k < ORDER; k++)
                sum += at[load].weight[k] * F[i + k * 2 * n];
            at_points[i] = f->h[load] * sum;
        }
        for (int a = 0; a < 2; a++)
            for (int i = 0; i < m; i++) {
                const double *around = at_points + a * n + at[i].first;
                double sum = 0.0;
                for (int k = 0; k < ORDER; k++)
                    sum += at[i].weight[k] * around[k];
                column[a * m + i] = sum;
            }
        s = rb_bem_flexibility_add_column(f, j, column);
    }
    for (int i = 0; i < 2 * m && s == RB_OK; i++) {
        const double *around = far->w0 + i / m * n + at[i % m].first;
        for (int k = 0; k < ORDER; k++)
            f->w0[i] += at[i % m].weight[k] * around[k];
        if (loads == far->elements)
            f->w0[i] += far->more[i];
    }
    free(column);
    free(at);
    return s;
}
