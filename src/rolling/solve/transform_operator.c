/* The contact operator of equal elements by Fourier transforms, without a matrix. */
#include "bem/bem.h"
#include "lcp/contact/contact.h"
#include "rolling/solve/kinematic.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Products by Fourier transforms. */
typedef struct {
    rb_bem_flexibility f;   /* its arrays borrowed from the bodies */
    rb_rolling_kinematic A; /* owned, as the rest */
    double local[4];        /* what is added to A q for the interlayer: zeros where there is none
                             */
    rb_bem_circulant *inverse;
    double *density; /* n: lengths of elements over that of the middle one; NULL: all are equal */
    double *w;       /* 2m: displacements of one product */
    double *slip;    /* n: A w_T */
} transforms;

static void transforms_free(void *context)
{
    transforms *t = context;

    rb_bem_circulant_free(t->inverse);
    free(t->A.outside);
    free(t->density);
    free(t->w);
    free(t->slip);
    free(t);
}

static void transforms_apply(void *context, const double *r, const double **gap,
                             const double **slip)
{
    const transforms *t = context;
    const rb_rolling_kinematic A = t->A; /* no store to slip changes it: the loop has no branches */
    const double *w_T = t->w + A.n + 1;
    double outside[2] = {0.0, 0.0};

    rb_bem_flexibility_apply(&t->f, r, t->w);
    for (int j = 0; A.outside && j < 2 * A.n; j++)
        for (int k = 0; k < 2; k++)
            outside[k] += A.outside[2 * (size_t)j + (size_t)k] * r[j];
    for (int i = 0; i < A.n; i++)
        t->slip[i] = rb_rolling_kinematic_row(&A, w_T, outside, i);
    for (int k = 0; k < 4; k++)
        for (int i = k < 1; t->local[k] != 0.0 && i < A.n && i - 1 + k < A.n; i++)
            t->slip[i] += t->local[k] * r[A.n + i - 1 + k];
    *gap = t->w;
    *slip = t->slip;
}

static void transforms_precondition(void *context, int tangential, double *line)
{
    const transforms *t = context;

    if (tangential && t->A.differences)
        rb_bem_circulant_apply_difference(t->inverse, line, line);
    else
        rb_bem_circulant_apply(t->inverse, line, line);
    /* Elements that change their lengths slowly answer, over their numbers, like equal ones that
     * carry p h: ln|x_i - x_j| is ln|i - j| and something smooth. */
    for (int i = 0; t->density && i < t->A.n; i++)
        line[i] /= t->density[i];
}

static void transforms_precondition_yielding(void *context, double hardening, double *line)
{
    const transforms *t = context;

    rb_bem_circulant_apply_yielding(t->inverse, hardening, line, line);
}

rb_status rb_rolling_transform_operator(const rb_bem_flexibility *f, double compliance,
                                        rb_rolling_kinematic *A, rb_contact_operator **op)
{
    transforms *t = calloc(1, sizeof *t);

    if (!t)
        return RB_ENOMEM;
    t->f = *f;
    t->A = *A;
    A->outside = NULL;
    for (int k = 0; k < 4; k++)
        t->local[k] = compliance * (A->local[k] - A->stencil[k]);
    t->w = rb_alloc(2 * (size_t)f->m, 1);
    t->slip = rb_alloc((size_t)A->n, 1);
    rb_status s = t->w && t->slip
                      ? rb_bem_circulant_create(&t->f, t->A.stencil, t->A.local, &t->inverse)
                      : RB_ENOMEM;
    const double middle = f->h[A->n / 2];
    if (s == RB_OK && !(fabs(f->h[0] / middle - 1.0) < 0.1)) {
        t->density = rb_alloc((size_t)A->n, 1);
        s = t->density ? RB_OK : RB_ENOMEM;
        for (int i = 0; i < A->n && t->density; i++)
            t->density[i] = f->h[i] / middle;
    }
    if (s != RB_OK) {
        transforms_free(t);
        return s;
    }
    const rb_contact_products by = {transforms_apply, transforms_precondition, transforms_free, t,
                                    transforms_precondition_yielding};
    return rb_contact_operator_products(A->n, &by, op);
}
