/* How the distance at which displacements are zero, the datum, shifts those of the contact. */
#include "bem/bem.h"
#include "rolling/body/body.h"
#include "rolling/body/internal.h"
#include "rolling/case/internal.h"
#include "rolling/notes/note.h"

#include <gsl/gsl_math.h>
#include <math.h>

/* Beyond the length over which a stiff layer stretches or bends the base moves alone. */
double rb_rolling_mean_compliance(const rb_rolling_case *rc, const rb_rolling_body *body, double a,
                                  int along)
{
    const double mean = 2.0 * exp(-1.5) * a; /* of the distances within the strip */
    const double given = rb_rolling_datum(rc, body), radius = fabs(body->radius);
    const double datum =
        isfinite(given) ? given : 2.0 / exp(1.0) * (isfinite(radius) ? radius : rc->a.radius);
    const rb_bem_material own = rb_rolling_material(rc, body);
    const double of_own = (1.0 - own.poisson) / own.shear;

    if (!(body->layer > 0.0)) {
        /* what relaxes does so within V tau, with ln(sqrt(x^2 + d^2)/x), which is positive */
        double all = of_own * log(datum / mean);
        for (int k = 0; k < body->memory.n && rc->formulation == RB_STEADY; k++) {
            const double reach = fmax(mean, rc->speed * body->memory.time[k]);
            all += of_own * body->memory.ratio[k] * log(hypot(1.0, datum / reach));
        }
        return all;
    }
    const rb_bem_material base = rb_rolling_base_material(rc, body);
    const double of_base = (1.0 - base.poisson) / base.shear;
    double of_layers = 0.0, stiffness = 0.0, depth = 0.0; /* against stretching or bending */
    for (int k = 0; k < rb_rolling_layers(body); k++) {
        const double above = depth;
        const rb_rolling_layer_properties layer = rb_rolling_layer_of(body, k);
        const rb_bem_material m =
            body->stack ? rb_bem_material_from_young(layer.young, layer.poisson) : own;
        const double of_layer = (1.0 - m.poisson) / m.shear, ratio = of_base / of_layer;
        depth += layer.thickness;
        of_layers += of_layer * log(fmax(depth, mean) / fmax(above, mean));
        stiffness += ratio * (along ? depth - above : gsl_pow_3(depth) - gsl_pow_3(above));
    }
    if (!(body->base_young > 0.0))
        return of_layers;
    return of_layers +
           of_base * log(datum / fmax(fmax(depth, mean), along ? stiffness : cbrt(stiffness)));
}
