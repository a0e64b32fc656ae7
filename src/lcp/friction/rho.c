/* rho: the inverse of each contact's own compliance, [force/velocity].  It brings
 * velocities to forces, so that neither the solvers nor what they accept depend on units. */
#include "lcp/friction/internal.h"

#include <math.h>
#include <stdlib.h>

/* Of finite-element structures diag(K)^-1 is about a tenth of a node's compliance. */
#define DIAGONAL_SHARE 0.1

rb_status rb_friction_compliances(const rb_friction_problem *p, double *own_block)
{
    double w[9];
    for (int k = 0; k < 2 * p->contacts; k++)
        own_block[k] = 0.0;
    if (p->form == RB_FRICTION_GLOBAL) { /* from the diagonal of H' diag(K)^-1 H */
        const rb_sparse *h = &p->H;
        const int d = p->dimension;
        double *diagonal = rb_alloc((size_t)p->dofs, 1);
        if (!diagonal)
            return RB_ENOMEM;
        for (int j = 0; j < p->dofs; j++)
            diagonal[j] = rb_sparse_diagonal(&p->K, j);
        for (int j = 0; j < h->cols; j++) {
            double own = 0.0, *at = &own_block[2 * (j / d) + (j % d > 0)];
            for (int k = h->p[j]; k < h->p[j + 1]; k++)
                if (diagonal[h->i[k]] > 0.0)
                    own += h->x[k] * h->x[k] / (DIAGONAL_SHARE * diagonal[h->i[k]]);
            *at = fmax(*at, own);
        }
        free(diagonal);
    }
    for (int c = 0; p->form != RB_FRICTION_GLOBAL && c < p->contacts; c++) {
        /* W's own block of a contact: d x d column-major */
        const int d = p->dimension, top = c * d;
        const size_t m = (size_t)(d * p->contacts);
        for (int k = 0; k < d * d; k++)
            w[k] = 0.0;
        for (int b = 0; b < d; b++) {
            if (p->form == RB_FRICTION_LOCAL_DENSE) {
                for (int a = 0; a < d; a++)
                    w[a + b * d] = p->W[(size_t)(top + a) + (size_t)(top + b) * m];
                continue;
            }
            for (int k = p->Ws.p[top + b]; k < p->Ws.p[top + b + 1]; k++)
                if (p->Ws.i[k] >= top && p->Ws.i[k] < top + d)
                    w[p->Ws.i[k] - top + b * d] = p->Ws.x[k];
        }
        own_block[2 * c] = fabs(w[0]);
        /* the largest eigenvalue of the tangential part */
        own_block[2 * c + 1] =
            d == 2 ? fabs(w[3])
                   : fabs(0.5 * (w[4] + w[8])) + hypot(0.5 * (w[4] - w[8]), 0.5 * (w[5] + w[7]));
    }
    return RB_OK;
}

rb_status rb_friction_rho(const rb_friction_problem *p, double *rho)
{
    const int both = 2 * p->contacts;
    double sum = 0.0;
    int count = 0;
    const rb_status s = rb_friction_compliances(p, rho);
    if (s != RB_OK)
        return s;
    for (int k = 0; k < both; k++)
        if (rho[k] > 0.0)
            sum += rho[k], count++;
    const double mean = count ? sum / count : 1.0;
    /* A contact that gives way nowhere takes part with the mean of the others. */
    for (int k = 0; k < both; k++)
        rho[k] = 1.0 / (rho[k] > 1e-12 * mean ? rho[k] : mean);
    return RB_OK;
}
