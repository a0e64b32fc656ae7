/* Each contact in a unit of its own, so that neither methods nor what they accept depend on
 * the units of the file: r = D r', u = D^-1 u', W' = D W D, q' = D q, H' = H D, w' = D w, with one
 * number D per contact, because a cone keeps its shape only under one factor for all its
 * directions. D is a power of two: scaling makes no rounding errors. */
#include "lcp/friction/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A number per entry of contacts. */
static void scale_vector(const rb_friction_problem *p, const double *unit, const double *from,
                         double *to)
{
    for (int i = 0; i < p->dimension * p->contacts; i++)
        to[i] = from[i] * unit[i / p->dimension];
}

void rb_friction_scaling_reload(const rb_friction_problem *given, rb_friction_scaling *scaling)
{
    const double *unit = scaling->unit;
    rb_friction_problem *p = &scaling->problem;
    if (!unit) {
        *p = *given;
        return;
    }
    p->mu = given->mu;
    p->f = given->f;
    if (p->form == RB_FRICTION_GLOBAL)
        scale_vector(p, unit, given->w, p->w);
    else
        scale_vector(p, unit, given->q, p->q);
}

/* W, q, H and w of the scaled problem. */
static rb_status copy_scaled(const rb_friction_problem *given, rb_friction_scaling *scaling)
{
    rb_friction_problem *p = &scaling->problem;
    const double *unit = scaling->unit;
    const int d = p->dimension, m = d * p->contacts;
    rb_status s = RB_OK;
    double *vector = malloc((size_t)m * sizeof *vector);
    p->W = NULL;
    p->Ws = (rb_sparse){0};
    p->H = (rb_sparse){0};
    p->q = p->form == RB_FRICTION_GLOBAL ? NULL : vector;
    p->w = p->form == RB_FRICTION_GLOBAL ? vector : NULL;
    if (p->form == RB_FRICTION_LOCAL_DENSE) {
        const size_t order = (size_t)m;
        p->W = malloc(order * order * sizeof *p->W);
        for (size_t j = 0; p->W && j < order; j++) {
            const double *from = given->W + j * order, own = unit[j / (size_t)d];
            double *to = p->W + j * order;
            for (int c = 0; c < p->contacts; c++) {
                const double by = unit[c] * own;
                for (int a = 0; a < d; a++)
                    to[c * d + a] = from[c * d + a] * by;
            }
        }
        s = p->W ? RB_OK : RB_ENOMEM;
    } else if (p->form == RB_FRICTION_LOCAL_SPARSE) {
        s = rb_sparse_copy(&given->Ws, &p->Ws);
        for (int j = 0; s == RB_OK && j < m; j++)
            for (int k = p->Ws.p[j]; k < p->Ws.p[j + 1]; k++)
                p->Ws.x[k] *= unit[p->Ws.i[k] / d] * unit[j / d];
    } else {
        s = rb_sparse_copy(&given->H, &p->H);
        for (int j = 0; s == RB_OK && j < m; j++)
            for (int k = p->H.p[j]; k < p->H.p[j + 1]; k++)
                p->H.x[k] *= unit[j / d];
    }
    if (s == RB_OK && vector)
        rb_friction_scaling_reload(given, scaling);
    return vector ? s : RB_ENOMEM;
}

rb_status rb_friction_scaling_init(const rb_friction_problem *given, rb_friction_scaling *scaling)
{
    const size_t nc = (size_t)given->contacts;
    *scaling = (rb_friction_scaling){.problem = *given};
    double *w = malloc(3 * nc * sizeof *w);
    rb_status s = w ? rb_friction_compliances(given, w) : RB_ENOMEM;
    if (s == RB_OK) {
        double *unit = w + 2 * nc, first = 0.0;
        int differ = 0;
        for (size_t c = 0; c < nc; c++) {
            /* W_NN over that of the first contact, so that a unit of all does not matter, is
             * f 2^e with 1 <= f < 2: D^2 = 2^-e or 2^-(e+1).  Without W_NN W_TT has to do, and
             * what gives way nowhere has any unit. */
            const double own = w[2 * c] > 1e-12 * w[2 * c + 1] ? w[2 * c] : w[2 * c + 1];
            first = first > 0.0 ? first : own;
            const int e = own > 0.0 ? ilogb(own / first) : -1;
            unit[c] = ldexp(1.0, -(e + 1 - ((e + 1) & 1)) / 2);
            differ |= unit[c] != unit[0];
        }
        if (differ) {
            memmove(w, unit, nc * sizeof *w);
            scaling->unit = w;
            return copy_scaled(given, scaling);
        }
    }
    free(w);
    return s;
}

void rb_friction_scaling_free(rb_friction_scaling *scaling)
{
    rb_friction_problem *p = &scaling->problem;
    if (scaling->unit) {
        free(p->W);
        free(p->q);
        free(p->w);
        rb_sparse_free(&p->Ws);
        rb_sparse_free(&p->H);
    }
    free(scaling->unit);
    *scaling = (rb_friction_scaling){0};
}

void rb_friction_scale(const rb_friction_scaling *scaling, double *r, double *u)
{
    const rb_friction_problem *p = &scaling->problem;
    for (int i = 0; scaling->unit && i < p->dimension * p->contacts; i++) {
        r[i] /= scaling->unit[i / p->dimension];
        if (u)
            u[i] *= scaling->unit[i / p->dimension];
    }
}

void rb_friction_scale_back(const rb_friction_scaling *scaling, double *r, double *u)
{
    const rb_friction_problem *p = &scaling->problem;
    for (int i = 0; scaling->unit && i < p->dimension * p->contacts; i++) {
        r[i] *= scaling->unit[i / p->dimension];
        if (u)
            u[i] /= scaling->unit[i / p->dimension];
    }
}
