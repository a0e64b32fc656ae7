/* Equation (13) of *Acary* on both forms, and the scaled measure that decides: with
 * rho_c = 1/W_NN of each contact's own block,
 *     || (r_c - P_K(r_c - rho_c uhat_c)) / rho_c || / ||q||,
 * a ratio of velocities.  (13) adds forces to velocities and changes with the units; this
 * is (13) where every W_NN is 1.
 *
 * Global form with regular K: v = K^-1 (H r + f), u = H' v + w, q = w + H' K^-1 f: (13)
 * as printed.  Where K is singular there is no q and r alone does not fix u: the contacts
 * are given springs k, K_k = K + k H H', which changes no solution, K_k v = H (r + k (u -
 * w)) + f, q is what u would be with the contacts held by the springs alone (r = -k u),
 * and the imbalance K v - H r - f of a given v counts with the displacement it causes. */
#include "lcp/friction/internal.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

static double norm_or_one(size_t n, const double *q)
{
    const double norm = rb_friction_norm(n, q);
    return norm > 0.0 ? norm : 1.0;
}

rb_status rb_friction_measure_displacement(rb_friction_measure *measure, const double *r,
                                           const double *u, double *v)
{
    const rb_friction_problem *p = measure->problem;
    const int m = p->dimension * p->contacts;
    double *force = rb_alloc((size_t)m, 1);
    if (!force)
        return RB_ENOMEM;
    for (int k = 0; k < m; k++)
        force[k] = r[k] + measure->spring * (u[k] - p->w[k]);
    for (int i = 0; i < p->dofs; i++)
        measure->e[i] = p->f[i];
    rb_sparse_apply(1.0, &p->H, force, 1.0, measure->e);
    free(force);
    return rb_sparse_cholesky_solve(measure->factor, measure->e, v);
}

rb_status rb_friction_measure_spring_load(rb_friction_measure *measure, double *q)
{
    const rb_friction_problem *p = measure->problem;
    const int m = p->dimension * p->contacts;
    double *none = rb_alloc((size_t)m, 1), *v = rb_alloc((size_t)p->dofs, 1);
    rb_status s = none && v ? RB_OK : RB_ENOMEM;
    if (s == RB_OK) /* no forces beyond those of springs that pull towards u = 0 */
        s = rb_friction_measure_displacement(measure, none, none, v);
    for (int k = 0; s == RB_OK && k < m; k++)
        q[k] = p->w[k];
    if (s == RB_OK)
        rb_sparse_apply_transposed(1.0, &p->H, v, 1.0, q);
    free(v);
    free(none);
    return s;
}

rb_status rb_friction_measure_reload(rb_friction_measure *measure)
{
    const rb_friction_problem *p = measure->problem;
    if (p->form == RB_FRICTION_GLOBAL) {
        /* ||q||, q of the structure held by the springs where K is singular */
        const size_t m = (size_t)(p->dimension * p->contacts);
        double *q = rb_alloc(m, 1);
        const rb_status s = q ? rb_friction_measure_spring_load(measure, q) : RB_ENOMEM;
        if (s == RB_OK)
            measure->scale = norm_or_one(m, q);
        free(q);
        return s;
    }
    measure->scale = norm_or_one((size_t)(p->dimension * p->contacts), p->q);
    return RB_OK;
}

rb_status rb_friction_measure_init(const rb_friction_problem *p, rb_friction_measure *measure)
{
    const size_t m = (size_t)(p->dimension * p->contacts);
    const size_t n = p->form == RB_FRICTION_GLOBAL ? (size_t)p->dofs : 0;
    const size_t nc = (size_t)p->contacts;
    *measure = (rb_friction_measure){
        .problem = p, .scale = 1.0, .y = malloc((m + 2 * n + 4 * nc) * sizeof(double))};
    if (!measure->y)
        return RB_ENOMEM;
    measure->e = measure->y + m;
    measure->dv = measure->e + n;
    measure->rho = measure->dv + n;
    measure->deciding = measure->rho;
    measure->ones = measure->rho + 2 * nc;
    for (size_t k = 0; k < 2 * nc; k++)
        measure->ones[k] = 1.0;
    rb_status s = rb_friction_rho(p, measure->rho);
    if (s == RB_OK && n) {
        s = rb_sparse_cholesky_create(&p->K, &measure->factor);
        if (s == RB_SINGULAR) { /* K + k H H' */
            const rb_sparse *h = &p->H;
            rb_triplets t = {.rows = p->K.rows, .cols = p->K.cols};
            rb_sparse held = {0};
            double sum = 0.0;
            for (int j = 0; j < p->K.cols; j++)
                sum += fabs(rb_sparse_diagonal(&p->K, j));
            measure->spring = sum > 0.0 ? sum / p->K.cols : 1.0;
            rb_triplets_add_matrix(&t, 1.0, &p->K);
            for (int j = 0; j < h->cols; j++)
                for (int a = h->p[j]; a < h->p[j + 1]; a++)
                    for (int b = h->p[j]; b < h->p[j + 1]; b++)
                        rb_triplets_add(&t, h->i[a], h->i[b], measure->spring * h->x[a] * h->x[b]);
            s = rb_sparse_from_triplets(&t, &held);
            rb_triplets_free(&t);
            if (s == RB_OK)
                s = rb_sparse_cholesky_create(&held, &measure->factor);
            rb_sparse_free(&held);
        }
    }
    if (s == RB_OK)
        s = rb_friction_measure_reload(measure);
    if (s != RB_OK)
        rb_friction_measure_free(measure);
    return s;
}

void rb_friction_measure_free(rb_friction_measure *measure)
{
    rb_sparse_cholesky_free(measure->factor);
    free(measure->y);
    *measure = (rb_friction_measure){0};
}

static double relative(const rb_friction_measure *measure, double size)
{
    const double error = size / measure->scale;
    return isnan(error) ? INFINITY : error;
}

rb_status rb_friction_measure_error(rb_friction_measure *measure, const double *r, double *v,
                                    double *u, double *scaled, double *paper)
{
    const rb_friction_problem *p = measure->problem;
    double correction = 0.0, with_rho_1;
    rb_status s = RB_OK;
    *scaled = INFINITY;
    if (paper)
        *paper = INFINITY;
    if (p->form == RB_FRICTION_GLOBAL) {
        /* v -= K_k^-1 (K v - H r - f); correction: ||H' (what was subtracted)||.  Where K
         * is regular v itself does not matter: twice, so that rounding of a bad start
         * does not. */
        const int n = p->dofs, m = p->dimension * p->contacts;
        double *dv = measure->dv;
        for (int pass = 0; s == RB_OK && pass < (measure->spring > 0.0 ? 1 : 2); pass++) {
            for (int i = 0; i < n; i++)
                measure->e[i] = p->f[i];
            rb_sparse_apply(1.0, &p->H, r, 1.0, measure->e);
            rb_sparse_apply(-1.0, &p->K, v, 1.0, measure->e);
            s = rb_sparse_cholesky_solve(measure->factor, measure->e, dv);
            for (int i = 0; s == RB_OK && i < n; i++)
                v[i] += dv[i];
        }
        if (s == RB_OK && measure->spring > 0.0) {
            rb_sparse_apply_transposed(1.0, &p->H, dv, 0.0, u);
            correction = rb_friction_norm((size_t)m, u);
        }
        if (s == RB_OK) {
            for (int k = 0; k < m; k++)
                u[k] = p->w[k];
            rb_sparse_apply_transposed(1.0, &p->H, v, 1.0, u);
        }
    } else {
        /* Contacts that are open have no force, and cost nothing. */
        const int m = p->dimension * p->contacts, dense = p->form == RB_FRICTION_LOCAL_DENSE;
        const rb_sparse *w = &p->Ws;
        for (int k = 0; k < m; k++)
            u[k] = p->q[k];
        for (int j = 0; j < m; j++) {
            if (r[j] == 0.0)
                continue;
            for (int i = 0; dense && i < m; i++)
                u[i] += p->W[i + (size_t)j * (size_t)m] * r[j];
            for (int k = dense ? 0 : w->p[j], end = dense ? 0 : w->p[j + 1]; k < end; k++)
                u[w->i[k]] += w->x[k] * r[j];
        }
    }
    if (s != RB_OK)
        return s;
    const double norm = rb_friction_natural_norm(p, paper ? measure->rho : measure->deciding, r, u,
                                                 paper ? &with_rho_1 : NULL);
    *scaled = relative(measure, correction + norm);
    if (paper)
        *paper = relative(measure, correction + with_rho_1);
    return RB_OK;
}

double rb_friction_measure_resolution(const rb_friction_measure *measure, const double *r)
{
    return DBL_EPSILON * rb_friction_size(measure->problem, measure->deciding, r, measure->y) /
           measure->scale;
}

/* 1e-14 || |W| |r| + |q| || / ||q||; global: |H'| |v| + |w| */
double rb_friction_measure_floor(const rb_friction_measure *measure, const double *r,
                                 const double *v)
{
    const rb_friction_problem *p = measure->problem;
    const int m = p->dimension * p->contacts;
    double *y = measure->y;
    const double *constant = p->form == RB_FRICTION_GLOBAL ? p->w : p->q;
    for (int i = 0; i < m; i++)
        y[i] = fabs(constant[i]);
    if (p->form == RB_FRICTION_LOCAL_DENSE)
        for (int j = 0; j < m; j++)
            for (int i = 0; i < m; i++)
                y[i] += fabs(p->W[i + (size_t)j * (size_t)m] * r[j]);
    for (int j = 0; p->form == RB_FRICTION_LOCAL_SPARSE && j < m; j++)
        for (int k = p->Ws.p[j]; r[j] != 0.0 && k < p->Ws.p[j + 1]; k++)
            y[p->Ws.i[k]] += fabs(p->Ws.x[k] * r[j]);
    for (int j = 0; p->form == RB_FRICTION_GLOBAL && j < m; j++)
        for (int k = p->H.p[j]; k < p->H.p[j + 1]; k++)
            y[j] += fabs(p->H.x[k] * v[p->H.i[k]]);
    return 1e-14 * rb_friction_norm((size_t)m, y) / measure->scale;
}

double rb_friction_deciding(const rb_friction_info *info)
{
    return info->measure == RB_FRICTION_BY_ACARY ? info->residual : info->scaled;
}

rb_status rb_friction_error(const rb_friction_problem *problem, const double *r, const double *v,
                            double *u, rb_friction_errors *error)
{
    const size_t m = (size_t)(problem->dimension * problem->contacts);
    const size_t n = problem->form == RB_FRICTION_GLOBAL ? (size_t)problem->dofs : 0;
    rb_friction_measure measure = {0};
    double *own = rb_alloc(m, 1), *at = rb_alloc(n, 1);
    rb_status s = own && at ? rb_friction_measure_init(problem, &measure) : RB_ENOMEM;
    if (s == RB_OK) {
        for (size_t i = 0; v && i < n; i++)
            at[i] = v[i];
        s = rb_friction_measure_error(&measure, r, at, u ? u : own, &error->scaled,
                                      &error->residual);
    }
    if (s == RB_OK)
        error->floor = rb_friction_measure_floor(&measure, r, at);
    rb_friction_measure_free(&measure);
    free(at);
    free(own);
    return s;
}
