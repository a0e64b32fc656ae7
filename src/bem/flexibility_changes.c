/* A flexibility applied, asked for its matrix, moved, and what is added to it. */
#include "bem/internal.h"

#include <cblas.h>
#include <math.h>
#include <string.h>

void rb_bem_flexibility_apply(const rb_bem_flexibility *f, const double *r, double *w)
{
    f->apply(f, r, w);
    for (int i = 0; f->compliance && i < f->n; i++) {
        w[i] += f->compliance[i] * r[i];
        w[f->m + i] += f->compliance[f->n + i] * r[f->n + i];
    }
}

/* The diagonals of F_NN and F_TT. */
static void add_diagonals(const rb_bem_flexibility *f, const double *normal,
                          const double *tangential, double *F, int ldf)
{
    for (int i = 0; i < f->n; i++) {
        F[i + (size_t)i * (size_t)ldf] += normal[i];
        F[f->m + i + (size_t)(f->n + i) * (size_t)ldf] += tangential[i];
    }
}

rb_status rb_bem_flexibility_matrix(const rb_bem_flexibility *f, double *F, int ldf)
{
    if (!F || ldf < 2 * f->m)
        return RB_EINVAL;
    const rb_status s = f->matrix(f, F, ldf);
    if (s == RB_OK && f->compliance)
        add_diagonals(f, f->compliance, f->compliance + f->n, F, ldf);
    return s;
}

void rb_bem_flexibility_place(const double *ends, rb_bem_flexibility *f)
{
    for (int i = 0; i < f->m; i++) {
        f->x[i] = 0.5 * (ends[i] + ends[i + 1]);
        f->h[i] = ends[i + 1] - ends[i];
    }
}

void rb_bem_flexibility_copy_points(const rb_bem_flexibility *from, rb_bem_flexibility *to)
{
    const size_t m = (size_t)from->m;
    memcpy(to->x, from->x, m * sizeof *to->x);
    memcpy(to->h, from->h, m * sizeof *to->h);
    memcpy(to->w0, from->w0, 2 * m * sizeof *to->w0);
}

rb_status rb_bem_flexibility_add_column(rb_bem_flexibility *f, int j, const double *w)
{
    const size_t rows = 2 * (size_t)f->m;
    double *own = f->data;

    if (!rb_bem_flexibility_stored(f))
        return RB_EINVAL;
    own += (size_t)j * rows;
    for (size_t i = 0; i < rows; i++)
        own[i] += w[i];
    return RB_OK;
}

rb_status rb_bem_flexibility_stretch(rb_bem_flexibility *f, const double *ends, double scale,
                                     double along)
{
    const size_t m = (size_t)f->m;
    double *F = f->data;

    if (!rb_bem_flexibility_stored(f))
        return RB_EINVAL;
    /* Under lengths times s half-planes deform in the same shape, s times as much under the same
     * traction, but for the logarithm: ln(s x) = ln s + ln x adds a constant, by the length of the
     * loaded element, to the displacements in its direction. */
    rb_bem_flexibility_place(ends, f);
    for (int j = 0; j < 2 * f->n; j++, F += 2 * m) {
        double *direct = j < f->n ? F : F + m, *coupled = j < f->n ? F + m : F;
        const double added = along * f->h[j % f->n];
        for (size_t i = 0; i < m; i++) {
            direct[i] = scale * direct[i] + added;
            coupled[i] *= scale;
        }
    }
    return RB_OK;
}

rb_status rb_bem_flexibility_as_matrix(const rb_bem_flexibility *f, rb_bem_flexibility *dense)
{
    double *F;
    rb_status s = rb_bem_flexibility_dense(f->n, dense, &F);

    if (s == RB_OK)
        s = rb_bem_flexibility_matrix(f, F, 2 * f->m);
    if (s == RB_OK)
        rb_bem_flexibility_copy_points(f, dense);
    else
        rb_bem_flexibility_free(dense);
    return s;
}

rb_status rb_bem_flexibility_store(rb_bem_flexibility *f)
{
    rb_bem_flexibility dense;

    if (rb_bem_flexibility_stored(f))
        return RB_OK;
    const rb_status s = rb_bem_flexibility_as_matrix(f, &dense);
    if (s == RB_OK) {
        rb_bem_flexibility_free(f);
        *f = dense;
    }
    return s;
}

rb_status rb_bem_flexibility_add_compliance(rb_bem_flexibility *f, const double *normal,
                                            const double *tangential)
{
    for (int i = 0; i < f->n; i++)
        if (!(normal[i] >= 0.0) || !(tangential[i] >= 0.0) || isinf(normal[i]) ||
            isinf(tangential[i]))
            return RB_EINVAL;
    if (rb_bem_flexibility_stored(f)) {
        add_diagonals(f, normal, tangential, f->data, 2 * f->m);
        return RB_OK;
    }
    if (!f->compliance && !(f->compliance = rb_alloc(2 * (size_t)f->n, 1)))
        return RB_ENOMEM;
    cblas_daxpy(f->n, 1.0, normal, 1, f->compliance, 1);
    cblas_daxpy(f->n, 1.0, tangential, 1, f->compliance + f->n, 1);
    return RB_OK;
}
