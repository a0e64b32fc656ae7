/* Projected Gauss-Seidel sweeps where rows are dominated by their diagonal: a contraction in the
 * largest norm, which also proves that there is one solution. */
#include "lcp/portfolio/methods.h"

#include <float.h>
#include <math.h>

/* The largest sum |off| / diagonal of a row; beyond it other methods are faster. */
static const double DOMINATED = 0.95;

/* A sweep that changes no z by more than this part of the largest is the last one. */
static const double STILL = 4.0 * DBL_EPSILON;

/* Looks for units of z in which rows are dominated. */
enum { TRIALS = 12 };
/* ... as long as the ratio changes by this part of it. */
static const double STALLS = 1e-3;
/* A ratio beyond this that would not fall far enough in the trials that are left, if it went on
 * falling as in the last one, is given up: these steps become smaller, not larger. */
static const double FAR = 10.0;

/* others: sum_j |M_ij| unit_j over the others j of each row; becomes the mean of unit and of these
 * sums over M_ii: towards those units in which the largest sum is the least (Perron).  own: the
 * diagonal, positive.  Returns the largest sum / (M_ii unit_i). */
static double towards_units(int n, const double *own, const double *unit, double *others)
{
    double ratio = 0.0;
    for (int i = 0; i < n; i++) {
        ratio = fmax(ratio, others[i] / (own[i] * unit[i]));
        others[i] = 0.5 * (unit[i] + others[i] / own[i]);
    }
    return ratio;
}

/* The same, of which the sums are formed here; next: as others. */
static double domination(const rb_sparse *M, const double *own, const double *unit, double *next)
{
    for (int i = 0; i < M->rows; i++)
        next[i] = 0.0;
    for (int j = 0; j < M->cols; j++) {
        const double one = unit[j];
        const int end = M->p[j + 1];
        int k = M->p[j]; /* rows increase: those before j, then those behind */
        for (; k < end && M->i[k] < j; k++)
            next[M->i[k]] += fabs(M->x[k]) * one;
        if (k < end && M->i[k] == j)
            k++;
        for (; k < end; k++)
            next[M->i[k]] += fabs(M->x[k]) * one;
    }
    return towards_units(M->rows, own, unit, next);
}

/* own: n, the diagonal; others: n, sum |M_ij| of each row over the others j.  1: the diagonal is
 * not positive, or in no units are the rows dominated: the least ratio that units can give is the
 * spectral radius of the matrix of |M_ij| / M_jj, j other than i, and that is not below the least
 * sum of a column (Collatz and Wielandt).  equal: all diagonal entries are. */
static int is_hopeless(const rb_sparse *M, double *own, double *others, int *equal)
{
    double least = INFINITY;
    *equal = 1;
    for (int i = 0; i < M->rows; i++)
        others[i] = 0.0;
    for (int j = 0; j < M->cols; j++) {
        double sum = 0.0;
        own[j] = 0.0;
        for (int k = M->p[j]; k < M->p[j + 1]; k++) {
            const double x = fabs(M->x[k]);
            if (M->i[k] == j)
                own[j] = M->x[k];
            else {
                sum += x;
                others[M->i[k]] += x;
            }
        }
        if (!(own[j] > 0.0))
            return 1;
        *equal &= own[j] == own[0];
        least = fmin(least, sum / own[j]);
    }
    return least > DOMINATED;
}

rb_status rb_lcp_contraction(const rb_lcp_mixed_problem *p, const rb_lcp_options *opt, double began,
                             double *z, rb_lcp_info *info)
{
    const lcp_matrix given = {.n = p->M->rows, .sparse = p->M};
    const int n = given.n;
    rb_arena scratch = {0};
    lcp_scale scale = {0};
    rb_sparse rows = {0}; /* M', whose columns are M's rows */
    double *unit = rb_arena_doubles(&scratch, (size_t)n, 1),
           *next = rb_arena_doubles(&scratch, (size_t)n, 1),
           *own = rb_arena_doubles(&scratch, (size_t)n, 1);
    int equal = 0;
    rb_status s = scratch.failed                         ? RB_ENOMEM
                  : is_hopeless(p->M, own, next, &equal) ? RB_SINGULAR
                                                         : RB_OK;
    double ratio = INFINITY;
    for (int i = 0; s == RB_OK && i < n; i++)
        unit[i] = 1.0;
    /* Ones come first; then, since columns may have units of their own, those of the diagonal,
     * unless they are ones, too; from there on each trial follows the one before. */
    const int follows = equal ? 1 : 2;
    for (int k = 0; s == RB_OK && k < TRIALS && !(ratio <= DOMINATED); k++) {
        for (int i = 0; k && i < n; i++)
            unit[i] = k < follows ? 1.0 / own[i] : next[i];
        const double last = ratio;
        ratio = k ? domination(p->M, own, unit, next) : towards_units(n, own, unit, next);
        if (!isfinite(ratio) || (k >= follows && fabs(ratio - last) <= STALLS * last))
            break;
        if (k >= follows && ratio > FAR && ratio * pow(ratio / last, TRIALS - 1 - k) > DOMINATED)
            break;
    }
    if (s == RB_OK && !(ratio <= DOMINATED))
        s = RB_SINGULAR;
    if (s == RB_OK)
        s = rb_sparse_transpose(p->M, &rows);
    if (s == RB_OK) {
        const int sweeps = ratio > 0.0 ? 4 + (int)(log(DBL_EPSILON) / log(ratio)) : 4;
        const int most = opt->max_iters && opt->max_iters < sweeps ? opt->max_iters : sweeps;
        double change = INFINITY, size = 0.0;
        *info = RB_LCP_INFO_NONE;
        info->solver = "gauss-seidel";
        for (int i = 0; i < n; i++)
            z[i] = fmin(fmax(opt->start ? opt->start[i] : 0.0, rb_lcp_lower(p->lower, i)),
                        rb_lcp_upper(p->upper, i));
        while (s == RB_OK && change > STILL * size && info->iters < most) {
            change = size = 0.0;
            for (int i = 0; i < n; i++) {
                double w = p->q[i];
                for (int k = rows.p[i]; k < rows.p[i + 1]; k++)
                    w += rows.x[k] * z[rows.i[k]];
                const double x = fmin(fmax(z[i] - w / own[i], rb_lcp_lower(p->lower, i)),
                                      rb_lcp_upper(p->upper, i));
                change = fmax(change, fabs(x - z[i]) / unit[i]);
                size = fmax(size, fabs(x) / unit[i]);
                z[i] = x;
            }
            info->iters++;
            if (rb_interrupted())
                s = rb_fail(&info->msg, RB_INTERRUPTED, "lcp: interrupted after %d sweep%s",
                            info->iters, rb_plural(info->iters));
            else if (opt->seconds > 0.0 && rb_seconds() - began > opt->seconds)
                s = rb_fail(&info->msg, RB_TIME_LIMIT, "lcp: no solution after %d sweep%s in %g s",
                            info->iters, rb_plural(info->iters), opt->seconds);
        }
        if (rb_lcp_scale_create(&given, p->q, 0, &scale) != RB_OK ||
            rb_lcp_measure(&given, &scale, p->q, p->lower, p->upper, z, info) != RB_OK)
            s = RB_ENOMEM;
        if (s == RB_OK)
            s = rb_lcp_assess(info);
    }
    if (s == RB_ENOMEM)
        rb_fail(&info->msg, s, "lcp: out of memory for order %d", n);
    rb_lcp_scale_free(&scale);
    rb_sparse_free(&rows);
    return rb_arena_done(&scratch, s);
}
