/* Stress in a half-plane below tractions that are linear between nodes: no jump of q, so
 * sxx stays finite on the surface. */
#include "bem/complex.h"
#include "bem/internal.h"
#include "rollbem/blas.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>

#include <gsl/gsl_math.h>

typedef double complex cplx;

/* With g = -p + i q on y = 0 and Phi = (1/2 pi i) int g(t)/(t - z) dt (Muskhelishvili):
 *     sxx + syy = 4 Re Phi(z),
 *     syy - i sxy = Phi(z) - Phi(z*) + (z - z*) Phi'(z)*.
 * For g linear between nodes t_j and 0 at both ends, integration leaves one term for each
 * node, with the change of slope k_j there:
 *     2 pi i Phi = sum k_j (z - t_j) ln(t_j - z),   2 pi i Phi' = sum k_j ln(t_j - z). */
static void stress_at(int n, const double *t, const cplx *k, double x, double y, double *stress)
{
    cplx above = 0.0, below = 0.0, slope = 0.0;
    for (int j = 0; j < n; j++) {
        const double dx = x - t[j];
        if (dx == 0.0 && y == 0.0)
            continue;                             /* w ln w -> 0 */
        const cplx l = clog(complex_of(-dx, -y)); /* -0: the limit from inside */
        above += k[j] * complex_of(dx, y) * l;
        below += k[j] * complex_of(dx, -y) * conj(l);
        slope += k[j] * l;
    }
    const cplx c = 1.0 / (2.0 * M_PI * I);
    const cplx normal = c * above - c * below + 2.0 * I * y * conj(c * slope);
    stress[1] = creal(normal);
    stress[0] = 4.0 * creal(c * above) - stress[1];
    stress[2] = -cimag(normal);
}

rb_status rb_bem_halfplane_stress_linear(const rb_bem_edge_load *load, rb_bem_points points,
                                         double *stress)
{
    const int n = load->n;
    const double *nodes = load->x, *p = load->p, *q = load->q;
    if (n < 2 || !rb_bem_edge_load_is_valid(load, n, points))
        return RB_EINVAL;
    cplx *k = malloc((size_t)n * sizeof *k);
    if (!k)
        return RB_ENOMEM;
    cplx before = 0.0;
    for (int j = 0; j < n; j++) {
        const cplx after =
            j + 1 < n ? complex_of(p[j] - p[j + 1], q[j + 1] - q[j]) / (nodes[j + 1] - nodes[j])
                      : 0.0;
        k[j] = before - after;
        before = after;
    }
#pragma omp parallel for num_threads(rb_blas_loop_threads())                                       \
    schedule(static) if ((double)points.n * n > 1e5)
    for (int i = 0; i < points.n; i++)
        stress_at(n, nodes, k, points.xy[2 * i], points.xy[2 * i + 1], stress + 3 * i);
    free(k);
    return RB_OK;
}
