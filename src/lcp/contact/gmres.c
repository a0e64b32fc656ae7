/* GMRES (Saad and Schultz), preconditioned from the right, for linear problems that are
 * known by products: unknowns inside, and delta and xi at the border.  The preconditioner
 * of all is P = [A~ B; C 0], A~ that of the inner unknowns. */
#include "lcp/contact/gmres.h"
#include "base/gmres.h"

#include <cblas.h>
#include <float.h>
#include <stdlib.h>
#include <string.h>

enum { BASIS = RB_CONTACT_BASIS, CYCLES = 6, BORDERS = 2 };

/* ---- The preconditioner ------------------------------------------------------------ */

typedef struct {
    const rb_contact_linear *l;
    int size;
    double *image[BORDERS];          /* A~^-1 B; owned */
    double schur[BORDERS * BORDERS]; /* -C A~^-1 B */
    double **basis;                  /* in the scratch memory, as work */
    double *work;
    size_t length; /* of a vector */
} solver;

static rb_status make_solver(const rb_contact_linear *l, rb_contact_gmres_scratch *scratch,
                             solver *s)
{
    if (!scratch->work)
        scratch->work = rb_alloc(scratch->size, 1);
    *s = (solver){.l = l,
                  .size = l->inner + l->borders,
                  .basis = scratch->basis,
                  .work = scratch->work,
                  .length = scratch->size};
    if (!scratch->work)
        return RB_ENOMEM;
    for (int k = 0; k < l->borders; k++) {
        s->image[k] = rb_alloc((size_t)s->size, 1);
        if (!s->image[k])
            return RB_ENOMEM;
        l->border_column(l->of, k, s->work);
        l->precondition(l->of, s->work, s->image[k]);
        l->border_rows(l->of, s->image[k], s->schur + BORDERS * k);
    }
    for (int k = 0; k < BORDERS * BORDERS; k++)
        s->schur[k] = -s->schur[k];
    return RB_OK;
}

static void precondition(const solver *s, const double *b, double *x)
{
    const rb_contact_linear *l = s->l;
    double g[BORDERS], z[BORDERS];

    l->precondition(l->of, b, x);
    if (l->borders == 0)
        return;
    l->border_rows(l->of, x, g);
    for (int k = 0; k < l->borders; k++)
        g[k] = b[l->inner + k] - g[k];
    const double *S = s->schur;
    if (l->borders == 1) {
        z[0] = g[0] / S[0];
    } else { /* by Cramer's rule */
        const double det = S[0] * S[3] - S[1] * S[2];
        z[0] = (S[3] * g[0] - S[2] * g[1]) / det;
        z[1] = (S[0] * g[1] - S[1] * g[0]) / det;
    }
    for (int k = 0; k < l->borders; k++) {
        cblas_daxpy(l->inner, -z[k], s->image[k], 1, x, 1);
        x[l->inner + k] = z[k];
    }
}

/* ---- Cycles ------------------------------------------------------------------------ */

static double *basis_vector(const solver *s, int j)
{
    double **v = &s->basis[j];
    if (!*v)
        *v = malloc(s->length * sizeof **v);
    return *v;
}

/* One cycle from x, none where the residual is `enough`; *residual: of x before it;
 * *estimate: of x afterwards, but for rounding.  small: as rb_gmres wants it. */
static rb_status cycle(const solver *s, const double *b, double tolerance, double enough,
                       double *small, double *x, double *residual, double *estimate)
{
    rb_gmres g = {.n = s->size, .most = BASIS, .v = s->basis, .small = small};
    double *v = basis_vector(s, 0);

    if (!v)
        return RB_ENOMEM;
    s->l->multiply(s->l->of, x, v);
    for (int i = 0; i < s->size; i++)
        v[i] = b[i] - v[i];
    *residual = *estimate = rb_gmres_begin(&g);
    const int iterates = *residual > enough;
    while (iterates && *estimate > tolerance && g.used < BASIS) {
        double *next = basis_vector(s, g.used + 1);
        if (!next)
            return RB_ENOMEM;
        if (rb_interrupted())
            return RB_INTERRUPTED;
        precondition(s, s->basis[g.used], s->work);
        s->l->multiply(s->l->of, s->work, next);
        *estimate = rb_gmres_step(&g);
    }
    if (g.used > 0) {
        /* x += P^-1 V y; the vector behind the basis is scratch. */
        double *sum = s->basis[g.used];

        rb_gmres_combine(&g, sum);
        precondition(s, sum, s->work);
        cblas_daxpy(s->size, 1.0, s->work, 1, x, 1);
    }
    return RB_OK;
}

rb_status rb_contact_gmres(const rb_contact_linear *linear, rb_contact_gmres_scratch *scratch,
                           const double *b, double *x)
{
    solver s;
    double *small = rb_alloc(RB_GMRES_SMALL(BASIS), 1);
    rb_status status = make_solver(linear, scratch, &s);
    const double rounding = 2.0 * DBL_EPSILON * cblas_dnrm2(s.size, b, 1);
    const double tolerance = fmax(RB_CONTACT_GMRES_TOLERANCE, rounding);
    /* what the rounding of products leaves, in a 2-norm */
    const double floor = fmax(tolerance, DBL_EPSILON * s.size * sqrt(s.size));
    double enough = tolerance, before = INFINITY, residual = INFINITY, estimate = INFINITY;

    if (!small)
        status = RB_ENOMEM;
    for (int k = 0; k < CYCLES && status == RB_OK; k++) {
        status = cycle(&s, b, tolerance, enough, small, x, &residual, &estimate);
        if (!(residual > enough) || residual > 0.1 * before)
            break;
        /* more than the estimate is rounding, which no cycle lessens */
        enough = estimate <= tolerance ? fmax(floor, 0.1 * residual) : tolerance;
        before = residual;
    }
    for (int k = 0; k < BORDERS; k++)
        free(s.image[k]);
    free(small);
    return status;
}

void rb_contact_gmres_free(rb_contact_gmres_scratch *scratch)
{
    for (int j = 0; j <= BASIS; j++)
        free(scratch->basis[j]);
    free(scratch->work);
}
