/* The problem in its scale R M C, R q, with the caller's options in the same units; its pivots are
 * handed on in units of the given problem. */
#include "lcp/lemke/scale.h"

#include <float.h>
#include <math.h>

/* The size of a variable (w 0 ... n - 1, z, z0) in units of the scaled problem. */
static double unit_of(const lcp_scale *s, int n, int variable)
{
    return variable < n ? 1.0 / s->row[variable] : variable < 2 * n ? s->col[variable - n] : 1.0;
}

/* Hands the pivot on in the caller's units.  The artificial variable of mixed problems
 * with free variables, whose halves are numbered from n on, is the only one there with a
 * number that depends on them. */
static void trace_in_units(const rb_lcp_pivot *p, void *context)
{
    lcp_posed *s = context;
    const int n = p->n;
    rb_lcp_pivot record = *p;
    for (int i = 0; i < n; i++)
        s->value[i] = p->value[i] * unit_of(&s->scale, n, p->basis[i]);
    record.value = s->value;
    record.ratio *= unit_of(&s->scale, n, p->entering);
    if (p->tableau) {
        for (int c = 0; c < n + 2; c++) {
            const double of_column = c <= n ? unit_of(&s->scale, n, p->nonbasis[c]) : 1.0;
            for (int i = 0; i < n; i++) {
                const size_t at = (size_t)i + (size_t)c * (size_t)n;
                s->tableau[at] = p->tableau[at] * unit_of(&s->scale, n, p->basis[i]) / of_column;
            }
        }
        record.tableau = s->tableau;
    }
    s->caller.trace(&record, s->caller.trace_context);
}

/* to = by times from, or over it where `inverse`.  A finite number that overflows becomes
 * the largest one, as a bound that no solution in the scale reaches; 0: there is one. */
static int scale_vector(int n, const double *by, int inverse, const double *from, double *to)
{
    int fits = 1;
    for (int i = 0; from && i < n; i++) {
        to[i] = inverse ? from[i] / by[i] : from[i] * by[i];
        if (isinf(to[i]) && !isinf(from[i])) {
            to[i] = copysign(DBL_MAX, to[i]);
            fits = 0;
        }
    }
    return fits;
}

rb_status rb_lcp_pose_scaled(lcp_posed *s)
{
    const lcp_matrix given = s->M;
    const rb_lcp_options *opt = &s->caller;
    const double *row = s->scale.row, *col = s->scale.col;
    const int n = given.n, tableau = opt->trace && opt->trace_tableau && given.dense;
    const size_t order = (size_t)n;
    s->vectors = rb_alloc(order, 6);
    s->dense = given.dense ? rb_alloc(order, order) : NULL;
    s->tableau = tableau ? rb_alloc(order, order + 2) : NULL;
    if (!s->vectors || (given.dense && !s->dense) || (tableau && !s->tableau) ||
        (!given.dense && rb_sparse_copy(given.sparse, &s->sparse) != RB_OK))
        return RB_ENOMEM;
    for (int j = 0; j < n; j++) {
        const lcp_column a = rb_lcp_column(&given, j);
        double *to = s->dense ? s->dense + (size_t)j * order : s->sparse.x + s->sparse.p[j];
        for (int k = 0; k < a.count; k++)
            to[k] = a.x[k] * row[a.row ? a.row[k] : k] * col[j];
    }
    double *q = s->vectors, *cover = q + n, *start = cover + n, *lower = start + n,
           *upper = lower + n;
    s->value = upper + n;
    scale_vector(n, row, 0, s->q, q);
    scale_vector(n, row, 0, opt->cover, cover);
    scale_vector(n, col, 1, s->lower, lower);
    scale_vector(n, col, 1, s->upper, upper);
    const int starts = opt->start && scale_vector(n, col, 1, opt->start, start);
    s->scaled = 1;
    s->largest = 1.0;
    s->M = (lcp_matrix){n, s->dense, n, s->dense ? NULL : &s->sparse};
    s->q = q;
    s->lower = s->lower ? lower : NULL;
    s->upper = s->upper ? upper : NULL;
    s->opt.cover = opt->cover ? cover : NULL;
    s->opt.start = starts ? start : NULL;
    if (opt->trace) {
        s->opt.trace = trace_in_units;
        s->opt.trace_context = s;
    }
    return RB_OK;
}
