/* What the rest of a wheel adds to the half-plane that answers like it close to a load (B10): a
 * smooth function of both places, so that few points of one mesh tell it on any other.  The
 * search for the edges of the contact then solves the boundary of the wheel only once. */
#include "rolling/body/far_field.h"
#include "rolling/body/mesh.h"
#include "rolling/case/derived.h"

#include <cblas.h>
#include <stdlib.h>

/* At most so many points along the mesh: between them the polynomials of fourth order are exact to
 * 1e-8 of the displacement where the contact is as wide as a third of the radius. */
enum { POINTS = 24, ORDER = 4 };

struct rb_rolling_far_field {
    int n;
    double *x;  /* n: places [length] */
    double *w0; /* 2n: displacements without loads [length] */
    double *F;  /* 2n x 2n: displacements for unit forces along the normal and along the surface */
    int elements; /* 0, or of meshes to which `more` is added */
    double *more; /* 2 (elements + 1) [length] */
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

rb_status rb_rolling_far_field_create(const rb_rolling_model *model, rb_rolling_far_field **far,
                                      rb_message *why)
{
    const rb_bem_flexibility *all = &model->bodies.f;
    const double *F = model->bodies.F;
    const size_t rows = 2 * (size_t)all->m;
    int chosen[POINTS + 2];
    rb_rolling_bodies near = {.F = NULL};
    rb_rolling_far_field *made = *far = calloc(1, sizeof *made);

    if (!made)
        return rb_fail(why, RB_ENOMEM, "out of memory for a far field");
    rb_status s = rb_rolling_bodies_near(model->rc, NULL, &model->mesh, &near, why);
    const int n = made->n = choose_points(all, chosen);
    made->x = rb_arena_doubles(&made->memory, (size_t)n, 1);
    made->w0 = rb_arena_doubles(&made->memory, 2 * (size_t)n, 1);
    made->F = rb_arena_doubles(&made->memory, 2 * (size_t)n, 2 * (size_t)n);
    if (s == RB_OK && made->memory.failed)
        s = rb_fail(why, RB_ENOMEM, "out of memory for a far field of %d points", n);
    for (int j = 0; j < n && s == RB_OK; j++) {
        made->x[j] = all->x[chosen[j]];
        for (int a = 0; a < 2; a++)
            made->w0[a * n + j] = all->w0[a * all->m + chosen[j]];
        for (int b = 0; b < 2; b++) {
            const size_t column = (size_t)(b * all->n + chosen[j]) * rows;
            for (int i = 0; i < 2 * n; i++) {
                const size_t at = column + (size_t)(i / n * all->m + chosen[i % n]);
                made->F[i + (size_t)(b * n + j) * 2 * (size_t)n] =
                    (F[at] - near.F[at]) / all->h[chosen[j]];
            }
        }
    }
    rb_rolling_bodies_free(&near);
    if (s != RB_OK) {
        rb_rolling_far_field_free(made);
        *far = NULL;
    }
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

rb_status rb_rolling_far_field_match(const rb_rolling_model *model, rb_rolling_far_field *far,
                                     rb_message *why)
{
    const rb_contact_state *state = &model->state;
    const int n = model->mesh.n, rows = 2 * (n + 1);
    double *more = rb_arena_doubles(&far->memory, (size_t)rows, 2), *w = more + rows;
    rb_rolling_bodies as_far = {.F = NULL};
    rb_status s = far->memory.failed ? RB_ENOMEM : RB_OK;

    if (s == RB_OK)
        s = rb_rolling_bodies_near(model->rc, far, &model->mesh, &as_far, why);
    if (s == RB_OK)
        s = rb_rolling_displacement(&as_far, state->p, state->q, w);
    if (s == RB_OK)
        s = rb_rolling_displacement(&model->bodies, state->p, state->q, more);
    for (int i = 0; i < rows && s == RB_OK; i++)
        more[i] -= w[i];
    rb_rolling_bodies_free(&as_far);
    far->more = more;
    far->elements = n;
    return s;
}

rb_status rb_rolling_far_field_add(const rb_rolling_far_field *far, rb_bem_flexibility *f)
{
    const int n = far->n, m = f->m;
    const size_t rows = 2 * (size_t)n, columns = 2 * (size_t)f->n;
    rb_arena scratch = {0};
    /* under the loads of f, at the points of far and at f's places, whose weights these are */
    double *at_points = rb_arena_doubles(&scratch, rows, columns),
           *F = rb_arena_doubles(&scratch, 2 * (size_t)m, columns),
           *weight = rb_arena_doubles(&scratch, ORDER, (size_t)m);
    int *first = rb_arena_ints(&scratch, (size_t)m);

    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    for (int i = 0; i < m; i++)
        first[i] = weights_at(far, f->x[i], weight + ORDER * i);
    for (int b = 0; b < 2; b++)
        for (int j = 0; j < f->n; j++)
            cblas_dgemv(CblasColMajor, CblasNoTrans, 2 * n, ORDER, f->h[j],
                        far->F + (size_t)(b * n + first[j]) * rows, 2 * n, weight + ORDER * j, 1,
                        0.0, at_points + (size_t)(b * f->n + j) * rows, 1);
    for (size_t j = 0; j <= columns; j++) {
        const double *from = j < columns ? at_points + j * rows : far->w0;
        double *to = j < columns ? F + j * 2 * (size_t)m : f->w0;
        for (int a = 0; a < 2; a++)
            for (int i = 0; i < m; i++)
                for (int k = 0; k < ORDER; k++)
                    to[a * m + i] += weight[ORDER * i + k] * from[a * n + first[i] + k];
    }
    for (int i = 0; i < 2 * m && f->n == far->elements; i++)
        f->w0[i] += far->more[i];
    return rb_arena_done(&scratch, rb_bem_flexibility_add_matrix(f, F));
}
