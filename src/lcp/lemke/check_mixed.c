/* Checks of problems with a sparse matrix and bounds. */
#include "lcp/lemke/lemke.h"

#include <math.h>

rb_status rb_lcp_check_boxes(int n, const double *lower, const double *upper, rb_message *why)
{
    for (int i = 0; i < n; i++) {
        const double low = rb_lcp_lower(lower, i), high = rb_lcp_upper(upper, i);
        if (!(low <= high) || low == INFINITY || high == -INFINITY)
            return rb_fail(why, RB_EINVAL,
                           "lcp: bounds %d are [%g, %g]: expected lower <= upper, with a "
                           "number in between",
                           i + 1, low, high);
    }
    return RB_OK;
}

rb_status rb_lcp_check_sparse(const rb_sparse *M, const double *q, const rb_lcp_options *opt,
                              rb_message *why)
{
    if (M->rows < 1 || M->cols != M->rows)
        return rb_fail(why, RB_EINVAL, "lcp: M is %d by %d: expected a square matrix", M->rows,
                       M->cols);
    const rb_status s = rb_lcp_check_options(opt, why);
    for (int j = 0; j < M->cols && s == RB_OK; j++)
        for (int k = M->p[j]; k < M->p[j + 1]; k++)
            if (!isfinite(M->x[k]))
                return rb_fail(why, RB_EINVAL, "lcp: M(%d, %d) = %g: expected a finite number",
                               M->i[k] + 1, j + 1, M->x[k]);
    return s == RB_OK ? rb_lcp_check_q(M->cols, q, why) : s;
}

rb_status rb_lcp_check_mixed(const rb_lcp_mixed_problem *p, const rb_lcp_options *opt,
                             rb_message *why)
{
    rb_status s = rb_lcp_check_sparse(p->M, p->q, opt, why);
    if (s == RB_OK)
        s = rb_lcp_check_boxes(p->M->rows, p->lower, p->upper, why);
    for (int i = 0; s == RB_OK && i < p->M->rows; i++) {
        const double cover = opt->cover ? opt->cover[i] : 1.0;
        const double start = opt->start ? opt->start[i] : 0.0;
        if (!(isfinite(cover) && cover >= 0.0))
            s = rb_fail(why, RB_EINVAL, "lcp: cover(%d) = %g: expected a number >= 0", i + 1,
                        cover);
        else if (!isfinite(start))
            s = rb_fail(why, RB_EINVAL, "lcp: start(%d) = %g: expected a finite number", i + 1,
                        start);
    }
    return s;
}
