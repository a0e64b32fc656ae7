/* Memory at the peak of a solution: the formulas of docs/performance.md, "Memory". */
#include "rolling/body/body.h"
#include "rolling/case/derived.h"
#include "rolling/solve/model.h"

#include <math.h>

/* Numbers per element of the path on which Newton's method goes on where its steps go
 * round in circles. */
enum { PATH = 12 };

double rb_rolling_bytes(const rb_rolling_case *rc, int n, int boundary, int unknowns)
{
    const rb_rolling_mesh mesh = {.n = n};
    const double square = (double)n * n, lu = (double)unknowns * unknowns;

    /* similar bodies: one group of unknowns at once */
    if (rb_rolling_is_large(rc, &mesh))
        return ((rb_rolling_derive(rc).dundurs == 0.0 ? 520.0 : 720.0) +
                (double)sizeof(double) * PATH) *
               n;
    /* Numbers per n^2 of Lemke's method on an LCP of order 3n: its matrix and the
     * tableau. In Kwak's form also the inverse, and a tableau rebuilt for accuracy: 3n
     * rows of the at most 2n variables in the basis.  Newton's method: the kept LU of all
     * tractions, or those of the normal and of the tangential ones, which are less
     * together; before it the problem of half as many elements and its LU. */
    const double lcp =
        rc->contact.solver == RB_SOLVER_LEMKE
            ? (rc->contact.lcp_form == RB_LCP_KWAK ? 9.0 + 9.0 + 1.0 + 6.0 : 9.0 + 9.0) * square
            : fmax(lu, square + 0.25 * lu) + PATH * (double)n;
    /* What the memory of a body adds to its flexibility is kept for the hysteresis of
     * pairs with a wheel. */
    const int bodies = (rc->a.memory.n > 0) + (rc->elastic_b && rc->b.memory.n > 0);
    const double solution = sizeof(double) * (6.0 * square + lcp),
                 kept = (rc->formulation == RB_STEADY && !rb_rolling_can(rc, RB_BODY_FLAT)
                             ? sizeof(double) * 4.0 * bodies * square
                             : 0.0);
    if (!boundary)
        return kept + fmax(sizeof(double) * 4.0 * (1 + rc->elastic_b) * square, solution);
    const double both = rb_bem_system_bytes(boundary, n),
                 condensation = sizeof(double) * (4.0 * (double)boundary * n + 4.0 * square);
    return kept + both + fmax(0.0, solution - condensation);
}
