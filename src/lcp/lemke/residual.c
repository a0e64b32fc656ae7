/* The residual of each row in its own scale: whether z solves the given problem. */
#include "lcp/lemke/lemke.h"
#include "lcp/lemke/scale.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A row whose terms are smaller than this part of those of the rows that share unknowns
 * with it is divided by this part of them, because it may contain only their rounding
 * errors. */
static const double FAINT = 1e-4;
/* A residual above this part of max |q| is no rounding of rows whose entries are
 * negligible here. */
static const double PLAIN = 1e-6;

/* Rounding of the terms of z beyond this part of q, or of what bounds come to, hides them. */
static const double HIDDEN = 0.1;

/* A residual that needs no closer look. */
static const double EXACT = 1e-13;

/* felt[i]: the largest terms, in the scale, of the rows that share an unknown with row i,
 * by row i's entry of that unknown: rounding errors of them come through it.  of_any: also
 * of unknowns that are zero. */
static void largest_neighbours(const lcp_matrix *M, const lcp_scale *s, const double *z,
                               const double *terms, double *of_any, double *felt)
{
    memset(of_any, 0, (size_t)M->n * sizeof *of_any);
    memset(felt, 0, (size_t)M->n * sizeof *felt);
    for (int j = 0; j < M->n; j++) {
        const lcp_column a = rb_lcp_column(M, j);
        double largest = 0.0;
        for (int k = 0; k < a.count; k++) {
            const int i = a.row ? a.row[k] : k;
            if (a.x[k] != 0.0)
                largest = fmax(largest, terms[i] * s->row[i]);
        }
        for (int k = 0; k < a.count; k++) {
            const int i = a.row ? a.row[k] : k;
            const double own = fabs(a.x[k]) * s->row[i] * s->col[j] * largest;
            of_any[i] = fmax(of_any[i], own);
            if (z[j] != 0.0)
                felt[i] = fmax(felt[i], own);
        }
    }
}

rb_status rb_lcp_measure(const lcp_matrix *M, const lcp_scale *scale, const double *q,
                         const double *lower, const double *upper, const double *z,
                         rb_lcp_info *info)
{
    const int n = M->n;
    double *w = rb_alloc((size_t)n, 5);
    if (!w)
        return RB_ENOMEM;
    double *terms = w + n, *of_any = terms + n, *felt = of_any + n, *data = felt + n;
    const double plain = PLAIN * rb_norm_inf((size_t)n, q);
    /* w = M z + q and the terms of each row, |M| |z| + |q|. */
    for (int i = 0; i < M->n; i++) {
        w[i] = q[i];
        terms[i] = data[i] = fabs(q[i]);
    }
    for (int j = 0; j < M->n; j++) {
        const lcp_column a = rb_lcp_column(M, j);
        const double x = z[j];
        for (int k = 0; x != 0.0 && k < a.count; k++) {
            const int i = a.row ? a.row[k] : k;
            const double t = a.x[k] * x;
            w[i] += t;
            terms[i] += fabs(t);
        }
        const int given = x == rb_lcp_lower(lower, j) || x == rb_lcp_upper(upper, j);
        for (int k = 0; given && x != 0.0 && k < a.count; k++)
            data[a.row ? a.row[k] : k] += fabs(a.x[k] * x);
    }
    /* Of z that are so large that rounding of their terms hides q and the bounds nothing is
     * known: they may stand for a matrix that is singular. */
    double largest = 0.0, known = 0.0;
    for (int i = 0; i < n; i++) {
        largest = fmax(largest, terms[i] * scale->row[i]);
        known = fmax(known, data[i] * scale->row[i]);
    }
    const double hidden = known > 0.0 ? DBL_EPSILON * largest / known : 0.0;
    /* rows that share unknowns are looked for only where a row does not pass alone */
    for (int pass = 0; pass < 2; pass++) {
        info->res = info->scaled = 0.0;
        info->row = -1;
        for (int i = 0; i < n; i++) {
            const double r = scale->row[i], c = scale->col[i];
            const double low = z[i] - rb_lcp_lower(lower, i);
            const double high = z[i] - rb_lcp_upper(upper, i);
            const double own = fabs(fmax(fmin(low, w[i]), high));
            const double scaled = fabs(fmax(fmin(low / c, w[i] * r), high / c));
            const double others = pass == 0 ? 0.0 : own <= plain ? of_any[i] : felt[i];
            const double size = fmax(terms[i] * r, FAINT * others);
            const double part = scaled == 0.0 ? 0.0 : scaled / size;
            if (isnan(z[i]) || !isfinite(terms[i]) || isnan(part)) {
                info->res = info->scaled = NAN;
                info->row = i;
                break;
            }
            info->res = fmax(info->res, own);
            if (part > info->scaled) {
                info->scaled = part;
                info->row = i;
            }
        }
        if (pass == 0 && info->scaled <= EXACT && !(hidden > HIDDEN))
            break;
        if (pass == 0)
            largest_neighbours(M, scale, z, terms, of_any, felt);
    }
    if (hidden > HIDDEN && !isnan(info->scaled) && hidden > info->scaled) {
        info->scaled = hidden;
        info->row = info->row < 0 ? 0 : info->row;
    }
    free(w);
    return RB_OK;
}

rb_status rb_lcp_scaled_residual(const rb_lcp_mixed_problem *p, const double *z, double *scaled,
                                 int *row)
{
    const lcp_matrix M = {.n = p->M->rows, .sparse = p->M};
    rb_lcp_info info = {.scaled = NAN, .row = -1};
    lcp_scale s = {0};
    rb_status status = rb_lcp_scale_create(&M, p->q, 0, &s);
    if (status == RB_OK)
        status = rb_lcp_measure(&M, &s, p->q, p->lower, p->upper, z, &info);
    rb_lcp_scale_free(&s);
    *scaled = info.scaled;
    if (row)
        *row = info.row;
    return status;
}
