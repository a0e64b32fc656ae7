/* A friction problem: checks of its arrays, and facts about it that decide which solver is tried.
 */
#include "lcp/friction/internal.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

void rb_friction_problem_free(rb_friction_problem *problem)
{
    if (!problem)
        return;
    free(problem->mu);
    free(problem->W);
    rb_sparse_free(&problem->Ws);
    free(problem->q);
    rb_sparse_free(&problem->K);
    rb_sparse_free(&problem->H);
    free(problem->f);
    free(problem->w);
    free(problem->lengths);
    *problem = (rb_friction_problem){0};
}

rb_status rb_friction_check_vector(const char *name, size_t n, const double *x, rb_message *why)
{
    if (!x)
        return rb_fail(why, RB_EINVAL, "%s is missing", name);
    int bad = 0; /* without a jump, since almost always nothing is found */
    for (size_t k = 0; k < n; k++)
        bad |= !(fabs(x[k]) <= DBL_MAX);
    if (!bad)
        return RB_OK;
    size_t k = 0;
    while (isfinite(x[k]))
        k++;
    return rb_fail(why, RB_EINVAL, "%s: entry %zu is %g", name, k + 1, x[k]);
}

rb_status rb_friction_check_sparse(const char *name, const rb_sparse *a, int rows, int cols,
                                   rb_message *why)
{
    if (!a->p || !a->i || !a->x)
        return rb_fail(why, RB_EINVAL, "%s is missing", name);
    if (a->rows != rows || a->cols != cols)
        return rb_fail(why, RB_EINVAL, "%s is %d x %d, expected %d x %d", name, a->rows, a->cols,
                       rows, cols);
    return rb_friction_check_vector(name, (size_t)a->p[cols], a->x, why);
}

rb_status rb_friction_sparse_asymmetry(const rb_sparse *a, double *difference, double *largest)
{
    rb_sparse t;
    if (rb_sparse_transpose(a, &t) != RB_OK)
        return RB_ENOMEM;
    *difference = *largest = 0.0;
    for (int j = 0; j < a->cols; j++) {
        int k = a->p[j], l = t.p[j];
        while (k < a->p[j + 1] || l < t.p[j + 1]) {
            const int ik = k < a->p[j + 1] ? a->i[k] : a->rows;
            const int il = l < t.p[j + 1] ? t.i[l] : a->rows;
            const double x = ik <= il ? a->x[k++] : 0.0;
            const double y = il <= ik ? t.x[l++] : 0.0;
            *difference = fmax(*difference, fabs(x - y));
            *largest = fmax(*largest, fabs(x));
        }
    }
    rb_sparse_free(&t);
    return RB_OK;
}

rb_status rb_friction_problem_check(const rb_friction_problem *p, rb_message *why)
{
    if (p->dimension != 2 && p->dimension != 3)
        return rb_fail(why, RB_EINVAL, "dimension %d: expected 2 or 3", p->dimension);
    if (p->contacts < 1)
        return rb_fail(why, RB_EINVAL, "%d contacts: expected at least 1", p->contacts);
    const int m = p->dimension * p->contacts;
    rb_status s = rb_friction_check_vector("mu", (size_t)p->contacts, p->mu, why);
    for (int c = 0; s == RB_OK && c < p->contacts; c++)
        if (p->mu[c] < 0.0)
            s = rb_fail(why, RB_EINVAL, "mu of contact %d is %g: expected >= 0", c + 1, p->mu[c]);
    if (s != RB_OK)
        return s;
    if (p->form == RB_FRICTION_GLOBAL) {
        if (p->dofs < 1)
            return rb_fail(why, RB_EINVAL, "%d degrees of freedom", p->dofs);
        s = rb_friction_check_sparse("K", &p->K, p->dofs, p->dofs, why);
        if (s == RB_OK)
            s = rb_friction_check_sparse("H", &p->H, p->dofs, m, why);
        if (s == RB_OK)
            s = rb_friction_check_vector("f", (size_t)p->dofs, p->f, why);
        if (s == RB_OK)
            s = rb_friction_check_vector("w", (size_t)m, p->w, why);
        double difference = 0.0, largest = 0.0;
        if (s == RB_OK)
            s = rb_friction_sparse_asymmetry(&p->K, &difference, &largest);
        if (s == RB_OK && difference > 1e-8 * largest)
            return rb_fail(why, RB_EINVAL, "K is not symmetric: |K - K'| = %.2g of |K|",
                           difference / largest);
        return s;
    }
    s = p->form == RB_FRICTION_LOCAL_DENSE
            ? rb_friction_check_vector("W", (size_t)m * (size_t)m, p->W, why)
            : rb_friction_check_sparse("W", &p->Ws, m, m, why);
    return s == RB_OK ? rb_friction_check_vector("q", (size_t)m, p->q, why) : s;
}

/* ---- Facts ------------------------------------------------------------------------- */

static rb_status examine_local(const rb_sparse *w, int with_rank, rb_friction_facts *facts)
{
    double difference, largest;
    rb_status s = with_rank ? rb_sparse_rank(w, &facts->rank) : RB_OK;
    if (s == RB_OK)
        s = rb_friction_sparse_asymmetry(w, &difference, &largest);
    if (s == RB_OK) {
        /* Indefinite: the symmetric part + 1e-10 max |W| has no Cholesky factor.  The shift keeps
         * rounding of a W that is only semidefinite, as of redundant contacts, from counting. */
        int *indefinite = &facts->indefinite;
        rb_triplets t = {.rows = w->rows, .cols = w->cols};
        rb_sparse sum = {0};
        rb_sparse_cholesky *factor = NULL;
        for (int j = 0; j < w->cols; j++) {
            rb_triplets_add(&t, j, j, 1e-10 * largest);
            for (int k = w->p[j]; k < w->p[j + 1]; k++) {
                rb_triplets_add(&t, w->i[k], j, 0.5 * w->x[k]);
                rb_triplets_add(&t, j, w->i[k], 0.5 * w->x[k]);
            }
        }
        s = rb_sparse_from_triplets(&t, &sum);
        if (s == RB_OK)
            s = rb_sparse_cholesky_create(&sum, &factor);
        *indefinite = s == RB_SINGULAR;
        rb_sparse_cholesky_free(factor);
        rb_sparse_free(&sum);
        rb_triplets_free(&t);
        s = s == RB_SINGULAR ? RB_OK : s;
    }
    if (s == RB_OK)
        facts->asymmetry = largest > 0.0 ? difference / largest : 0.0;
    return s;
}

rb_status rb_friction_examine(const rb_friction_problem *problem, int with_rank,
                              rb_friction_facts *facts)
{
    const int m = problem->dimension * problem->contacts;
    rb_sparse w = {0};
    rb_status s;
    *facts = (rb_friction_facts){0};
    switch (problem->form) {
    case RB_FRICTION_GLOBAL: { /* W = H' K^-1 H is not formed: the ranks of H and K tell */
        int rank = problem->dofs;
        if (!with_rank)
            s = RB_OK;
        else {
            s = rb_sparse_rank(&problem->H, &facts->rank);
            if (s == RB_OK)
                s = rb_sparse_rank(&problem->K, &rank);
            facts->nullity = problem->dofs - rank;
        }
    } break;
    case RB_FRICTION_LOCAL_SPARSE:
        s = examine_local(&problem->Ws, with_rank, facts);
        break;
    default:
        s = rb_sparse_from_dense(m, m, problem->W, m, &w);
        if (s == RB_OK)
            s = examine_local(&w, with_rank, facts);
        rb_sparse_free(&w);
    }
    if (with_rank)
        facts->hyperstaticity = m - facts->rank;
    return s;
}

rb_friction_options rb_friction_defaults(void)
{
    return (rb_friction_options){.tol = 1e-8};
}
