/* The measure that decides, and equation (13) of *Acary*, on both forms.  With rho_c =
 * 1/W_NN of each contact's own block the measure is the norm of the distances of (r_c /
 * rho_c, u_c) from Coulomb's law over ||q||, a ratio of velocities.  (13),
 *     || r_c - P_K(r_c - uhat_c) || / ||q||,
 * adds forces to velocities and changes with the units; and it divides penetrations by
 * mu.
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

/* y = x in the given units. */
static const double *in_given_units(const rb_friction_measure *measure, const double *x, double *y)
{
    const int d = measure->problem->dimension;
    for (int i = 0; measure->unit && i < d * measure->problem->contacts; i++)
        y[i] = x[i] / measure->unit[i / d];
    return measure->unit ? y : x;
}

static void set_scales(rb_friction_measure *measure, const double *q)
{
    const size_t m = (size_t)(measure->problem->dimension * measure->problem->contacts);
    measure->scale = norm_or_one(m, q);
    measure->given_scale = norm_or_one(m, in_given_units(measure, q, measure->y));
}

double rb_friction_measure_spring(const rb_friction_measure *measure, int row)
{
    const double D = measure->unit ? measure->unit[row / measure->problem->dimension] : 1.0;
    return measure->spring / (D * D);
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
        force[k] = r[k] + rb_friction_measure_spring(measure, k) * (u[k] - p->w[k]);
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
            set_scales(measure, q);
        free(q);
        return s;
    }
    set_scales(measure, p->q);
    return RB_OK;
}

rb_status rb_friction_measure_init(const rb_friction_scaling *scaling, rb_friction_measure *measure)
{
    const rb_friction_problem *p = &scaling->problem;
    const size_t m = (size_t)(p->dimension * p->contacts);
    const size_t n = p->form == RB_FRICTION_GLOBAL ? (size_t)p->dofs : 0;
    const size_t nc = (size_t)p->contacts;
    *measure = (rb_friction_measure){.problem = p,
                                     .unit = scaling->unit,
                                     .scale = 1.0,
                                     .given_scale = 1.0,
                                     .y = malloc((m + 2 * n + 2 * nc) * sizeof(double))};
    if (!measure->y)
        return RB_ENOMEM;
    measure->e = measure->y + m;
    measure->dv = measure->e + n;
    measure->rho = measure->dv + n;
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
                        rb_triplets_add(&t, h->i[a], h->i[b],
                                        rb_friction_measure_spring(measure, j) * h->x[a] * h->x[b]);
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

static double relative(double size, double scale)
{
    const double error = size / scale;
    return isnan(error) ? INFINITY : error;
}

double rb_friction_measure_of(const rb_friction_measure *measure, const double *r, const double *u)
{
    return measure->acary ? relative(rb_friction_acary_norm(measure->problem, measure->unit, r, u),
                                     measure->given_scale)
                          : relative(rb_friction_law_norm(measure->problem, measure->rho, r, u),
                                     measure->scale);
}

rb_status rb_friction_measure_error(rb_friction_measure *measure, const double *r, double *v,
                                    double *u, double *scaled, double *paper)
{
    const rb_friction_problem *p = measure->problem;
    double correction = 0.0, given_correction = 0.0;
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
        if (s == RB_OK)
            rb_sparse_apply_transposed(1.0, &p->H, dv, 0.0, u);
        measure->noise = 0.0;
        if (s == RB_OK && measure->spring <= 0.0) /* what is left after a correction */
            measure->noise = rb_norm_inf((size_t)m, u);
        if (s == RB_OK && measure->spring > 0.0) {
            correction = rb_friction_norm((size_t)m, u);
            given_correction = rb_friction_norm((size_t)m, in_given_units(measure, u, measure->y));
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
    const double law = paper || !measure->acary ? rb_friction_law_norm(p, measure->rho, r, u) : 0.0;
    const double acary =
        paper || measure->acary ? rb_friction_acary_norm(p, measure->unit, r, u) : 0.0;
    const double of_law = relative(correction + law, measure->scale),
                 of_acary = relative(given_correction + acary, measure->given_scale);
    *scaled = paper || !measure->acary ? of_law : of_acary;
    if (paper)
        *paper = of_acary;
    return RB_OK;
}

double rb_friction_measure_resolution(const rb_friction_measure *measure, const double *r)
{
    const rb_friction_problem *p = measure->problem;
    const int d = p->dimension, m = d * p->contacts;
    if (!measure->acary)
        return DBL_EPSILON * rb_friction_size(p, measure->rho, r, measure->y) / measure->scale;
    for (int i = 0; i < m; i++)
        measure->y[i] = r[i] * (measure->unit ? measure->unit[i / d] : 1.0);
    return DBL_EPSILON * rb_friction_norm((size_t)m, measure->y) / measure->given_scale;
}

/* y = |W| |r| + |q|; global: |H'| |v| + |w| */
static void terms(const rb_friction_measure *measure, const double *r, const double *v)
{
    const rb_friction_problem *p = measure->problem;
    const int m = p->dimension * p->contacts;
    double *y = measure->y;
    const double *constant = p->form == RB_FRICTION_GLOBAL ? p->w : p->q;
    for (int i = 0; i < m; i++)
        y[i] = fabs(constant[i]);
    if (p->form == RB_FRICTION_LOCAL_DENSE)
        for (int j = 0; j < m; j++)
            for (int i = 0; r[j] != 0.0 && i < m; i++)
                y[i] += fabs(p->W[i + (size_t)j * (size_t)m] * r[j]);
    for (int j = 0; p->form == RB_FRICTION_LOCAL_SPARSE && j < m; j++)
        for (int k = p->Ws.p[j]; r[j] != 0.0 && k < p->Ws.p[j + 1]; k++)
            y[p->Ws.i[k]] += fabs(p->Ws.x[k] * r[j]);
    for (int j = 0; p->form == RB_FRICTION_GLOBAL && j < m; j++)
        for (int k = p->H.p[j]; k < p->H.p[j + 1]; k++)
            y[j] += fabs(p->H.x[k] * v[p->H.i[k]]);
}

/* 1e-14 || |W| |r| + |q| || / ||q|| */
double rb_friction_measure_floor(const rb_friction_measure *measure, const double *r,
                                 const double *v)
{
    const size_t m = (size_t)(measure->problem->dimension * measure->problem->contacts);
    terms(measure, r, v);
    if (!measure->acary)
        return 1e-14 * rb_friction_norm(m, measure->y) / measure->scale;
    in_given_units(measure, measure->y, measure->y);
    return 1e-14 * rb_friction_norm(m, measure->y) / measure->given_scale;
}

/* What contacts may be measured by at least, as a part of ||q||: some carry nothing. */
static const double FAINT = 1e-4;

double rb_friction_measure_worst(const rb_friction_measure *measure, const double *r,
                                 const double *u, const double *v, int *contact)
{
    const rb_friction_problem *p = measure->problem;
    const int d = p->dimension;
    double worst = 0.0;
    int at = -1;
    terms(measure, r, v);
    for (int c = 0; c < p->contacts; c++) {
        const double rho = measure->rho[2 * c];
        const double far = rb_friction_law_distance(d, p->mu[c], rho, r + c * d, u + c * d);
        if (!(far > measure->noise))
            continue;
        /* The global form does not see in v what cancels in the velocity of a contact: its
         * own force counts, too. */
        const double own = fmax(rb_friction_norm((size_t)d, measure->y + c * d),
                                rb_friction_norm((size_t)d, r + c * d) / rho);
        const double part = far / fmax(own, FAINT * measure->scale);
        if (part > worst) {
            worst = part;
            at = c;
        }
    }
    if (contact)
        *contact = at;
    return worst;
}

double rb_friction_deciding(const rb_friction_info *info)
{
    return info->measure == RB_FRICTION_BY_ACARY ? info->residual : info->scaled;
}

rb_status rb_friction_error(const rb_friction_problem *problem, const double *r, const double *v,
                            double *u, rb_friction_errors *error)
{
    const int d = problem->dimension;
    const size_t m = (size_t)(d * problem->contacts);
    const size_t n = problem->form == RB_FRICTION_GLOBAL ? (size_t)problem->dofs : 0;
    rb_friction_measure measure = {0};
    rb_friction_scaling scaling = {0};
    rb_arena scratch = {0};
    double *force = rb_arena_doubles(&scratch, m, 1), *own = rb_arena_doubles(&scratch, m, 1),
           *at = rb_arena_doubles(&scratch, n, 1);
    rb_status s = scratch.failed ? RB_ENOMEM : rb_friction_scaling_init(problem, &scaling);
    if (s == RB_OK)
        s = rb_friction_measure_init(&scaling, &measure);
    if (s == RB_OK) {
        for (size_t i = 0; v && i < n; i++)
            at[i] = v[i];
        for (size_t i = 0; i < m; i++)
            force[i] = scaling.unit ? r[i] / scaling.unit[i / (size_t)d] : r[i];
        s = rb_friction_measure_error(&measure, force, at, own, &error->scaled, &error->residual);
    }
    if (s == RB_OK) {
        error->floor = rb_friction_measure_floor(&measure, force, at);
        error->worst = rb_friction_measure_worst(&measure, force, own, at, &error->contact);
        rb_friction_scale_back(&scaling, force, own);
        for (size_t i = 0; u && i < m; i++)
            u[i] = own[i];
    }
    rb_friction_measure_free(&measure);
    rb_friction_scaling_free(&scaling);
    return rb_arena_done(&scratch, s);
}
