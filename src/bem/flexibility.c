/* Flexibilities of the contact (B5): their points and the dense matrix.  What else is done with
 * one is in flexibility_changes.c. */
#include "bem/internal.h"

#include <cblas.h>
#include <stdlib.h>
#include <string.h>

void rb_bem_flexibility_free(rb_bem_flexibility *f)
{
    if (!f)
        return;
    if (f->free_data)
        f->free_data(f->data);
    free(f->x);
    free(f->h);
    free(f->w0);
    free(f->compliance);
    memset(f, 0, sizeof *f);
}

rb_status rb_bem_flexibility_end(const char *what, int n_c, rb_status s, rb_bem_flexibility *f,
                                 rb_message *why)
{
    if (s == RB_OK)
        return s;
    rb_bem_flexibility_free(f);
    return s == RB_INTERRUPTED
               ? rb_fail(why, s, "%s: interrupted", what)
               : rb_fail(why, s, "%s: out of memory for %d contact elements", what, n_c);
}

rb_status rb_bem_flexibility_points(int n, rb_bem_flexibility *f)
{
    memset(f, 0, sizeof *f);
    f->n = n;
    f->m = n + 1;
    f->x = rb_alloc((size_t)f->m, 1);
    f->h = rb_alloc((size_t)f->m, 1);
    f->w0 = rb_alloc(2 * (size_t)f->m, 1);
    return f->x && f->h && f->w0 ? RB_OK : RB_ENOMEM;
}

/* ---- A dense matrix: F, 2 m x 2 n, columns [r_N, r_T], rows [w_N, w_T] ---------------- */

static void dense_apply(const rb_bem_flexibility *f, const double *r, double *w)
{
    const int rows = 2 * f->m, cols = 2 * f->n;
    cblas_dgemv(CblasColMajor, CblasNoTrans, rows, cols, 1.0, f->data, rows, r, 1, 0.0, w, 1);
}

static rb_status dense_matrix(const rb_bem_flexibility *f, double *F, int ldf)
{
    const size_t rows = 2 * (size_t)f->m, cols = 2 * (size_t)f->n;
    const double *D = f->data;
    for (size_t j = 0; j < cols; j++)
        memcpy(F + j * (size_t)ldf, D + j * rows, rows * sizeof *F);
    return RB_OK;
}

/* A + the matrix B of a body below, which is in its own, mirrored frame (pair.c). */
void rb_bem_add_mirrored_columns(int n, int m, const double *B, double *A, int lda)
{
    const size_t rows = 2 * (size_t)m;

    for (int j = 0; j < 2 * n; j++) {
        const double sign = j < n ? 1.0 : -1.0, *b = B + (size_t)j * rows;
        double *a = A + (size_t)j * (size_t)lda;
        cblas_daxpy(m, sign, b, 1, a, 1);
        cblas_daxpy(m, -sign, b + m, 1, a + m, 1);
    }
}

static int dense_add(rb_bem_flexibility *a, const rb_bem_flexibility *b)
{
    if (b->apply != dense_apply)
        return 0;
    rb_bem_add_mirrored_columns(a->n, a->m, b->data, a->data, 2 * a->m);
    return 1;
}

rb_status rb_bem_flexibility_dense(int n, rb_bem_flexibility *f, double **F)
{
    rb_status s = rb_bem_flexibility_points(n, f);
    if (s == RB_OK) {
        f->data = *F = rb_alloc(2 * (size_t)f->m, 2 * (size_t)n);
        s = *F ? RB_OK : RB_ENOMEM;
    }
    f->apply = dense_apply;
    f->matrix = dense_matrix;
    f->add_mirrored = dense_add;
    f->free_data = free;
    if (s != RB_OK)
        rb_bem_flexibility_free(f);
    return s;
}

const double *rb_bem_flexibility_stored(const rb_bem_flexibility *f)
{
    return f->apply == dense_apply ? f->data : NULL;
}
