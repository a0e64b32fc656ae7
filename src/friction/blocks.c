#include "friction/internal.h"

#include <math.h>
#include <stdlib.h>

void rb_friction_blocks_free(rb_friction_blocks *blocks)
{
    if (!blocks)
        return;
    free(blocks->p);
    free(blocks->j);
    free(blocks->diag);
    free(blocks->x);
    *blocks = (rb_friction_blocks){0};
}

/* Marks the block columns of block row i; returns how many.  wt: W'. */
static int mark_row(const rb_sparse *wt, int d, int i, int *seen, int *columns)
{
    int n = 0;
    seen[i] = i, columns[n++] = i;
    for (int a = i * d; a < (i + 1) * d; a++)
        for (int k = wt->p[a]; k < wt->p[a + 1]; k++) {
            const int j = wt->i[k] / d;
            if (seen[j] != i)
                seen[j] = i, columns[n++] = j;
        }
    return n;
}

static int by_value(const void *a, const void *b)
{
    return *(const int *)a - *(const int *)b;
}

static rb_status find_pattern(const rb_sparse *wt, int *seen, int *columns,
                              rb_friction_blocks *b)
{
    const int nc = b->contacts;
    for (int i = 0; i < nc; i++)
        seen[i] = -1;
    for (int i = 0; i < nc; i++)
        b->p[i + 1] = b->p[i] + mark_row(wt, b->d, i, seen, columns);
    b->j = rb_alloc_int((size_t)b->p[nc]);
    b->x = rb_alloc((size_t)b->p[nc], (size_t)(b->d * b->d));
    if (!b->j || !b->x)
        return RB_ENOMEM;
    for (int i = 0; i < nc; i++)
        seen[i] = -1;
    for (int i = 0; i < nc; i++) {
        const int n = mark_row(wt, b->d, i, seen, b->j + b->p[i]);
        qsort(b->j + b->p[i], (size_t)n, sizeof *b->j, by_value);
        for (int k = b->p[i]; k < b->p[i + 1]; k++)
            if (b->j[k] == i)
                b->diag[i] = k;
    }
    return RB_OK;
}

/* place[j]: number of block (i, j) while row i is filled */
static void fill(const rb_sparse *wt, int *place, rb_friction_blocks *b)
{
    const int d = b->d;
    for (int i = 0; i < b->contacts; i++) {
        for (int k = b->p[i]; k < b->p[i + 1]; k++)
            place[b->j[k]] = k;
        for (int a = 0; a < d; a++)
            for (int k = wt->p[i * d + a]; k < wt->p[i * d + a + 1]; k++) {
                double *block = b->x + (size_t)place[wt->i[k] / d] * (size_t)(d * d);
                block[a + wt->i[k] % d * d] = wt->x[k];
            }
    }
}

static rb_status blocks_from_rows(const rb_sparse *wt, rb_friction_blocks *b)
{
    const size_t nc = (size_t)b->contacts;
    int *seen = rb_alloc_int(nc), *columns = rb_alloc_int(nc);
    b->p = rb_alloc_int(nc + 1);
    b->diag = rb_alloc_int(nc);
    rb_status s = seen && columns && b->p && b->diag ? RB_OK : RB_ENOMEM;
    if (s == RB_OK)
        s = find_pattern(wt, seen, columns, b);
    if (s == RB_OK)
        fill(wt, seen, b);
    free(columns);
    free(seen);
    return s;
}

rb_status rb_friction_blocks_init(const rb_friction_problem *local,
                                  rb_friction_blocks *blocks)
{
    const int m = local->dimension * local->contacts;
    *blocks = (rb_friction_blocks){.d = local->dimension, .contacts = local->contacts};
    rb_sparse w = {0}, wt = {0};
    rb_status s = RB_OK;
    if (local->form == RB_FRICTION_LOCAL_DENSE)
        s = rb_sparse_from_dense(m, m, local->W, m, &w);
    if (s == RB_OK)
        s = rb_sparse_transpose(local->form == RB_FRICTION_LOCAL_DENSE ? &w : &local->Ws,
                                &wt);
    if (s == RB_OK)
        s = blocks_from_rows(&wt, blocks);
    rb_sparse_free(&wt);
    rb_sparse_free(&w);
    if (s != RB_OK)
        rb_friction_blocks_free(blocks);
    return s;
}

void rb_friction_blocks_row(const rb_friction_blocks *b, int contact, const double *x,
                            double *y)
{
    const int d = b->d;
    double sum[3] = {0.0, 0.0, 0.0};
    for (int k = b->p[contact]; k < b->p[contact + 1]; k++) {
        const double *w = b->x + (size_t)k * (size_t)(d * d), *xj = x + b->j[k] * d;
        if (d == 3) {
            sum[0] += w[0] * xj[0] + w[3] * xj[1] + w[6] * xj[2];
            sum[1] += w[1] * xj[0] + w[4] * xj[1] + w[7] * xj[2];
            sum[2] += w[2] * xj[0] + w[5] * xj[1] + w[8] * xj[2];
        } else {
            sum[0] += w[0] * xj[0] + w[2] * xj[1];
            sum[1] += w[1] * xj[0] + w[3] * xj[1];
        }
    }
    for (int a = 0; a < d; a++)
        y[a] = sum[a];
}

void rb_friction_blocks_apply(const rb_friction_blocks *b, const double *x, double *y)
{
    for (int i = 0; i < b->contacts; i++)
        rb_friction_blocks_row(b, i, x, y + i * b->d);
}

static double largest_tangential(int d, const double *w)
{
    if (d == 2)
        return fabs(w[3]);
    const double mean = 0.5 * (w[4] + w[8]), b = 0.5 * (w[5] + w[7]);
    return fabs(mean) + hypot(0.5 * (w[4] - w[8]), b);
}

void rb_friction_invert_compliances(int contacts, double *rho)
{
    double sum = 0.0;
    int count = 0;
    for (int k = 0; k < 2 * contacts; k++)
        if (rho[k] > 0.0)
            sum += rho[k], count++;
    const double mean = count ? sum / count : 1.0;
    for (int k = 0; k < 2 * contacts; k++)
        rho[k] = 1.0 / (rho[k] > 1e-12 * mean ? rho[k] : mean);
}

void rb_friction_blocks_rho(const rb_friction_blocks *b, double *rho)
{
    for (int c = 0; c < b->contacts; c++) {
        const double *w = b->x + (size_t)b->diag[c] * (size_t)(b->d * b->d);
        rho[2 * c] = fabs(w[0]);
        rho[2 * c + 1] = largest_tangential(b->d, w);
    }
    rb_friction_invert_compliances(b->contacts, rho);
}
