/* Displacements of the surfaces under given tractions, w = w0 + F (p, q) (4.5): of both bodies
 * together, and of one of them. */
#include "rolling/body/internal.h"
#include "rolling/case/derived.h"
#include "rolling/solve/model.h"

#include <cblas.h>
#include <stdlib.h>
#include <string.h>

rb_status rb_rolling_displacement(const rb_rolling_bodies *bodies, const double *p, const double *q,
                                  double *w)
{
    const int n = bodies->f.n;
    double *r = rb_alloc(2 * (size_t)n, 1);

    if (!r)
        return RB_ENOMEM;
    memcpy(r, p, (size_t)n * sizeof *r);
    memcpy(r + n, q, (size_t)n * sizeof *r);
    rb_bem_flexibility_apply(&bodies->f, r, w);
    cblas_daxpy(2 * bodies->f.m, 1.0, bodies->f.w0, 1, w, 1);
    free(r);
    return RB_OK;
}

rb_status rb_rolling_body_displacement(const rb_rolling_model *model, int of_b, const double *r,
                                       double *w, double *x, double *h, rb_message *why)
{
    const rb_rolling_case *rc = model->rc;
    rb_rolling_body_flexibility one_body = {.system = NULL};
    rb_bem_flexibility *f = &one_body.f;
    const rb_rolling_body *body = of_b ? &rc->b : &rc->a;
    const rb_rolling_body_kind *kind = rb_rolling_kind_of(body);
    const rb_status s =
        (rb_rolling_is_large(rc, &model->mesh) ? kind->transforms : kind->flexibility)(
            rc, &model->plan, body, &model->mesh, &one_body, why);

    if (s == RB_OK) {
        rb_bem_flexibility_apply(f, r, w);
        cblas_daxpy(2 * f->m, 1.0, f->w0, 1, w, 1);
    }
    for (int i = 0; s == RB_OK && i < f->m && x; i++) {
        x[i] = f->x[i];
        h[i] = f->h[i];
    }
    rb_bem_flexibility_free(f);
    rb_bem_system_free(one_body.system);
    free(one_body.memory);
    return s;
}
