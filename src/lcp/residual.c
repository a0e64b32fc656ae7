#include "rollbem/lcp.h"

#include <cblas.h>
#include <math.h>

enum { PANEL = 64 }; /* rows of w formed at a time: no memory is asked for */

/* The larger of worst and max |min(z, w)|; a NaN stays. */
static double natural(int n, const double *z, const double *w, double worst)
{
    for (int i = 0; i < n; i++) {
        const double m = z[i] < w[i] ? z[i] : w[i];
        if (isnan(z[i]) || isnan(w[i]) || isnan(worst))
            return NAN;
        worst = fmax(worst, fabs(m));
    }
    return worst;
}

double rb_lcp_residual(int n, const double *M, int ldm, const double *q, const double *z,
                       double *w)
{
    double panel[PANEL], worst = 0.0;
    for (int first = 0; first < n; first += PANEL) {
        const int rows = n - first < PANEL ? n - first : PANEL;
        double *part = w ? w + first : panel;
        cblas_dcopy(rows, q + first, 1, part, 1);
        cblas_dgemv(CblasColMajor, CblasNoTrans, rows, n, 1.0, M + first, ldm, z, 1, 1.0,
                    part, 1);
        worst = natural(rows, z + first, part, worst);
    }
    return worst;
}
