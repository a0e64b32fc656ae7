#include "lcp/lemke.h"

#include <cblas.h>
#include <math.h>

enum { PANEL = 512 }; /* rows of w formed at a time: no memory is asked for */

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

/* Half of z and more is zero: only runs of other entries are gone through. */
void rb_lcp_add_product(int rows, int columns, const double *M, int ldm, const double *z,
                        double *w)
{
    for (int from = 0, to; from < columns; from = to + 1) {
        for (to = from; to < columns && z[to] != 0.0;)
            to++;
        if (to > from)
            cblas_dgemv(CblasColMajor, CblasNoTrans, rows, to - from, 1.0,
                        M + (size_t)from * (size_t)ldm, ldm, z + from, 1, 1.0, w, 1);
    }
}

double rb_lcp_residual(int n, const double *M, int ldm, const double *q, const double *z,
                       double *w)
{
    double panel[PANEL], worst = 0.0;
    for (int first = 0; first < n; first += PANEL) {
        const int rows = n - first < PANEL ? n - first : PANEL;
        double *part = w ? w + first : panel;
        cblas_dcopy(rows, q + first, 1, part, 1);
        rb_lcp_add_product(rows, n, M + first, ldm, z, part);
        worst = natural(rows, z + first, part, worst);
    }
    return worst;
}
