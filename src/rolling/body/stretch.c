/* Half-planes under a mesh that is moved and made longer by one factor: their flexibility follows
 * from that of the mesh before (F1). */
#include "rolling/body/internal.h"

#include <gsl/gsl_math.h>

int rb_rolling_bodies_stretch(const rb_rolling_case *rc, const rb_rolling_mesh *from,
                              const rb_rolling_mesh *to, rb_rolling_bodies *bodies, double *scale,
                              double *along)
{
    static const double ROUNDING = 1e-12; /* of the ends */
    const int n = from->n;
    double K = 0.0;

    if (!bodies->F || bodies->transforms.n > 0 || to->n != n || rc->period > 0.0 ||
        rc->normals != RB_BEM_NORMALS_OBSTACLE || rc->interlayer_normal != 0.0 ||
        rc->interlayer_tangential != 0.0 ||
        !rb_rolling_can(rc, RB_BODY_FLAT | RB_BODY_HOMOGENEOUS | RB_BODY_ELASTIC))
        return 0;
    const double width = to->ends[n] - to->ends[0];
    *scale = width / (from->ends[n] - from->ends[0]);
    for (int i = 0; i < n + 2; i++) {
        const double end = to->ends[0] + *scale * (from->ends[i] - from->ends[0]);
        if (!(fabs(to->ends[i] - end) <= ROUNDING * width))
            return 0;
    }
    for (int b = 0; b < 1 + rc->elastic_b; b++) { /* (F1) */
        const rb_bem_material m = rb_rolling_material(rc, b ? &rc->b : &rc->a);
        K += (1.0 - m.poisson) / (M_PI * m.shear);
    }
    *along = -K * log(*scale);
    return rb_bem_flexibility_stretch(&bodies->f, to->ends, *scale, *along) == RB_OK;
}
