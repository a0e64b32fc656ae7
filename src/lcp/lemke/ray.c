/* A path that ends on a ray: nothing blocks the entering variable.  What that means for the
 * problem: no solution, as the direction of z proves by Farkas' lemma, or only that this path has
 * found none. */
#include "lcp/proof/farkas.h"
#include "lcp/lemke/lemke.h"

rb_status rb_lcp_fail_ray(rb_lcp_info *info, const lcp_posed *posed, int entering, double z0,
                          double *direction)
{
    const int n = posed->M.n;
    const char letter = entering < n ? 'w' : 'z';
    if (rb_norm_inf((size_t)n, direction) == 0.0)
        return rb_fail(&info->msg, RB_NUMERICAL,
                       "lcp: rounding errors have led the path back to its beginning after %d "
                       "pivot%s",
                       info->iters, rb_plural(info->iters));
    info->ray_variable = entering;
    if (rb_lcp_excludes(&posed->M, posed->q, posed->lower, posed->upper, NULL, direction))
        return rb_fail(&info->msg, RB_NO_SOLUTION,
                       "lcp: no solution: the path ends after pivot %d on a ray of %c(%d) which "
                       "proves that no z "
                       "within its bounds has the signs of w",
                       info->iters, letter, entering % n + 1);
    return rb_fail(&info->msg, RB_RAY,
                   "lcp: secondary ray after %d pivot%s: no row blocks %c(%d); z0 = %g; this does "
                   "not prove that there is no solution",
                   info->iters, rb_plural(info->iters), letter, entering % n + 1, z0);
}
