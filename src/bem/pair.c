/* The flexibility of two bodies in contact (4.5). */
#include "bem/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* B's own frame is the mirror image: its tangential tractions and displacements are those
 * of the pair with the sign changed, which changes the sign of its coupling blocks.
 * Two operators of one kind become one; others stay side by side.
 * r, w: room for one product, so that such a pair serves one thread at a time. */
typedef struct {
    rb_bem_flexibility a, b;
    double *r, *w;
} body_pair;

static void pair_free(void *data)
{
    body_pair *pair = data;
    rb_bem_flexibility_free(&pair->a);
    rb_bem_flexibility_free(&pair->b);
    free(pair->r);
    free(pair->w);
    free(pair);
}

static void add_mirrored(int m, const double *w, double *sum)
{
    for (int i = 0; i < m; i++) {
        sum[i] += w[i];
        sum[m + i] -= w[m + i];
    }
}

static void pair_apply(const rb_bem_flexibility *f, const double *r, double *w)
{
    const body_pair *pair = f->data;
    for (int i = 0; i < f->n; i++) {
        pair->r[i] = r[i];
        pair->r[f->n + i] = -r[f->n + i];
    }
    rb_bem_flexibility_apply(&pair->a, r, w);
    rb_bem_flexibility_apply(&pair->b, pair->r, pair->w);
    add_mirrored(f->m, pair->w, w);
}

static rb_status pair_matrix(const rb_bem_flexibility *f, double *F, int ldf)
{
    const body_pair *pair = f->data;
    const int n = f->n, m = f->m;
    double *B = rb_alloc(2 * (size_t)m, 2 * (size_t)n);
    rb_status s = B ? rb_bem_flexibility_matrix(&pair->a, F, ldf) : RB_ENOMEM;

    if (s == RB_OK)
        s = rb_bem_flexibility_matrix(&pair->b, B, 2 * m);
    if (s == RB_OK)
        rb_bem_add_mirrored_columns(n, m, B, F, ldf);
    free(B);
    return s;
}

rb_status rb_bem_flexibility_pair(rb_bem_flexibility *a, rb_bem_flexibility *b,
                                  rb_bem_flexibility *f, rb_message *why)
{
    const size_t n = (size_t)a->n, m = (size_t)a->m;
    rb_status s = RB_OK;

    memset(f, 0, sizeof *f);
    if (a->n < 1 || a->n != b->n)
        s = rb_fail(why, RB_EINVAL, "bodies in contact: %d elements on A, %d on B", a->n, b->n);
    /* F_A + F_B makes sense only at the same points. */
    for (int i = 0; s == RB_OK && i < a->m; i++)
        if (!(fabs(a->x[i] - b->x[i]) <= 1e-9 * a->h[i]))
            s = rb_fail(why, RB_EINVAL, "bodies in contact: point %d at x = %g on A, %g on B", i,
                        a->x[i], b->x[i]);
    /* Two matrices, or two operators of one kind, are added once; else each product takes two. */
    if (s == RB_OK && a->add_mirrored && a->add_mirrored(a, b)) {
        add_mirrored(a->m, b->w0, a->w0);
        *f = *a;
        memset(a, 0, sizeof *a);
        rb_bem_flexibility_free(b);
        return RB_OK;
    }
    body_pair *pair = s == RB_OK ? calloc(1, sizeof *pair) : NULL;
    if (!pair) {
        rb_bem_flexibility_free(a);
        rb_bem_flexibility_free(b);
        return s == RB_OK ? rb_fail(why, RB_ENOMEM, "bodies in contact: out of memory") : s;
    }
    *pair = (body_pair){.a = *a, .b = *b, .r = rb_alloc(2 * n, 1), .w = rb_alloc(2 * m, 1)};
    memset(a, 0, sizeof *a);
    memset(b, 0, sizeof *b);
    s = rb_bem_flexibility_points((int)n, f);
    f->apply = pair_apply;
    f->matrix = pair_matrix;
    f->free_data = pair_free;
    f->data = pair;
    if (s == RB_OK && pair->r && pair->w) {
        rb_bem_flexibility_copy_points(&pair->a, f);
        add_mirrored(pair->a.m, pair->b.w0, f->w0);
        return RB_OK;
    }
    rb_bem_flexibility_free(f);
    return rb_fail(why, RB_ENOMEM, "bodies in contact: out of memory for %d elements", (int)n);
}
