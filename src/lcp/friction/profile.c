/* Performance profiles (Dolan and More 2002). */
#include "lcp/friction/friction.h"

#include <math.h>

void rb_friction_profile(int problems, int solvers, const double *cost, int taus, const double *tau,
                         double *rho)
{
    for (int k = 0; k < taus * solvers; k++)
        rho[k] = 0.0;
    for (int p = 0; p < problems; p++) {
        double least = INFINITY;
        for (int s = 0; s < solvers; s++)
            least = fmin(least, cost[p + s * problems]);
        for (int s = 0; s < solvers; s++) {
            const double c = cost[p + s * problems];
            for (int k = 0; k < taus && isfinite(c); k++)
                rho[k + s * taus] += (c <= tau[k] * least) / (double)problems;
        }
    }
}
