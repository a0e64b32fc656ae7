/* Checks of the input; of sparse matrices and bounds: check_mixed.c. */
#include "lcp/lemke/lemke.h"

#include <cblas.h>
#include <math.h>

rb_status rb_lcp_check_options(const rb_lcp_options *opt, rb_message *why)
{
    if (opt->max_iters < 0)
        return rb_fail(why, RB_EINVAL, "lcp: max_iters = %d: expected >= 0", opt->max_iters);
    return RB_OK;
}

rb_status rb_lcp_check_q(int n, const double *q, rb_message *why)
{
    for (int i = 0; i < n; i++)
        if (!isfinite(q[i]))
            return rb_fail(why, RB_EINVAL, "lcp: q(%d) = %g: expected a finite number", i + 1,
                           q[i]);
    return RB_OK;
}

rb_status rb_lcp_check_dense(const rb_lcp_problem *p, const rb_lcp_options *opt, rb_message *why)
{
    const int n = p->n;
    if (n < 1)
        return rb_fail(why, RB_EINVAL, "lcp: n = %d: expected at least 1", n);
    if (p->ldm < n)
        return rb_fail(why, RB_EINVAL, "lcp: ldm = %d: expected at least n = %d", p->ldm, n);
    rb_status s = rb_lcp_check_options(opt, why);
    for (int j = 0; j < n && s == RB_OK; j++) {
        const double *x = p->M + (size_t)j * (size_t)p->ldm;
        /* The sum of absolute values tells at once that a column is finite. */
        const int finite = isfinite(cblas_dasum(n, x, 1));
        for (int i = 0; !finite && s == RB_OK && i < n; i++)
            if (!isfinite(x[i]))
                s = rb_fail(why, RB_EINVAL, "lcp: M(%d, %d) = %g: expected a finite number", i + 1,
                            j + 1, x[i]);
    }
    if (s == RB_OK)
        s = rb_lcp_check_q(n, p->q, why);
    if (s != RB_OK)
        return s;
    for (int i = 0; i < n && opt->cover; i++) {
        if (!(isfinite(opt->cover[i]) && opt->cover[i] >= 0.0))
            return rb_fail(why, RB_EINVAL, "lcp: cover(%d) = %g: expected a number >= 0", i + 1,
                           opt->cover[i]);
        if (opt->cover[i] == 0.0 && p->q[i] < 0.0)
            return rb_fail(why, RB_EINVAL,
                           "lcp: cover(%d) = 0: expected a number > 0, because q(%d) = %g "
                           "is negative",
                           i + 1, i + 1, p->q[i]);
    }
    return RB_OK;
}
