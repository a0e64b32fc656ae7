/* Anderson's acceleration of a fixed-point iteration r -> g(r) (Walker and Ni 2011): the
 * last steps f = g(r) - r are combined so that the sum is as small as possible, and the
 * same combination of the g is the next r.  For a linear iteration this is GMRES.  u is
 * combined in the same way, because it is affine in r. */
#include "base/base.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DEPTH RB_ANDERSON_DEPTH
#define REGULARISATION 1e-12 /* of the trace of the normal equations */
/* An extrapolation after which the step is this much longer led astray. */
#define WORST_GROWTH 2.0

rb_status rb_anderson_init(int m, rb_anderson *a)
{
    const size_t size = (size_t)m;
    *a = (rb_anderson){.m = m, .f = rb_alloc(size, 3 * DEPTH + 3)};
    if (!a->f)
        return RB_ENOMEM;
    a->r = a->f + size;
    a->u = a->r + size;
    a->df = a->u + size;
    a->dr = a->df + DEPTH * size;
    a->du = a->dr + DEPTH * size;
    return RB_OK;
}

void rb_anderson_free(rb_anderson *a)
{
    free(a->f);
    *a = (rb_anderson){0};
}

/* x: the solution of gram x = x, by Cholesky; 0 where it has no pivot left. */
static int solve_normal_equations(const rb_anderson *a, double *x)
{
    const int n = a->used;
    double L[DEPTH][DEPTH], trace = 0.0;
    for (int i = 0; i < n; i++)
        trace += a->gram[i][i];
    for (int i = 0; i < n; i++) {
        for (int j = 0; j <= i; j++) {
            double sum = a->gram[i][j] + (i == j) * REGULARISATION * trace;
            for (int k = 0; k < j; k++)
                sum -= L[i][k] * L[j][k];
            if (i == j && !(sum > 0.0))
                return 0;
            L[i][j] = i == j ? sqrt(sum) : sum / L[j][j];
        }
        for (int k = 0; k < i; k++)
            x[i] -= L[i][k] * x[k];
        x[i] /= L[i][i];
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++)
            x[i] -= L[k][i] * x[k];
        x[i] /= L[i][i];
    }
    return 1;
}

void rb_anderson_forget(rb_anderson *a)
{
    a->used = a->next = a->known = 0;
}

void rb_anderson_step(rb_anderson *a, const double *start, double *r, double *u)
{
    const size_t m = (size_t)a->m, bytes = m * sizeof(double);
    const double size = rb_distance(m, r, start);
    if (a->used && size > WORST_GROWTH * a->size) {
        memcpy(r, a->r, bytes);
        if (u)
            memcpy(u, a->u, bytes);
        rb_anderson_forget(a);
        return;
    }
    if (a->known) {
        /* The differences to the step before take the oldest place; gram: df' df. */
        const size_t at = (size_t)a->next * m;
        for (size_t k = 0; k < m; k++) {
            a->df[at + k] = r[k] - start[k] - a->f[k];
            a->dr[at + k] = r[k] - a->r[k];
            if (u)
                a->du[at + k] = u[k] - a->u[k];
        }
        if (a->used < DEPTH)
            a->used++;
        for (int i = 0; i < a->used; i++)
            a->gram[i][a->next] = a->gram[a->next][i] =
                rb_dot(m, a->df + (size_t)i * m, a->df + at);
        a->next = (a->next + 1) % DEPTH;
    }
    for (size_t k = 0; k < m; k++)
        a->f[k] = r[k] - start[k];
    memcpy(a->r, r, bytes);
    if (u)
        memcpy(a->u, u, bytes);
    a->size = size;
    a->known = 1;
    if (a->used) {
        double weight[DEPTH];
        for (int i = 0; i < a->used; i++)
            weight[i] = rb_dot(m, a->df + (size_t)i * m, a->f);
        if (!solve_normal_equations(a, weight)) {
            a->used = a->next = 0;
            return;
        }
        for (int i = 0; i < a->used; i++) {
            const double *dr = a->dr + (size_t)i * m, *du = a->du + (size_t)i * m;
            for (size_t k = 0; k < m; k++) {
                r[k] -= weight[i] * dr[k];
                if (u)
                    u[k] -= weight[i] * du[k];
            }
        }
    }
}
