/* Whether the elements resolve a layer or cover, and whether it is crushed. */
#include "bem/bem.h"
#include "rolling/body/body.h"
#include "rolling/case/internal.h"
#include "rolling/solve/model.h"
#include "rolling/solve/patches.h"
#include "rolling/solve/resolution.h"
#include "rolling/solve/zone.h"

#include <math.h>

/* A layer or cover that is nearly incompressible carries by waves as short as it is
 * thick: longer elements make the load of nu = 1/2 wrong by 2 % and more.  Others are
 * mattresses when they are thin, which any element resolves (theory-bodies.md L4). */
static const char *thickness_of(const rb_rolling_body *body, int of_b)
{
    static const char *const names[][2] = {{"cover-thickness", "cover-thickness-b"},
                                           {"layer-thickness", "layer-thickness-b"},
                                           {"layers", "layers-b"}};
    return names[body->stack ? 2 : body->layer > 0.0][of_b];
}

static rb_status check_resolved(const rb_rolling_model *model, rb_message *why)
{
    static const double nearly_incompressible = 0.49;
    const rb_rolling_case *rc = model->rc;
    const rb_rolling_body *const bodies[2] = {&rc->a, &rc->b};

    for (int b = 0; b < 1 + rc->elastic_b; b++) {
        const double thickness = fmax(rb_rolling_layers_depth(bodies[b]), bodies[b]->cover);
        double poisson = rb_rolling_material(rc, bodies[b]).poisson;
        for (int k = 0; bodies[b]->stack && k < bodies[b]->stack->n; k++)
            poisson = fmax(poisson, bodies[b]->stack->poisson[k]);
        const int n = model->mesh.n;
        const double longest = rb_rolling_longest_element(n, model->state.zone, model->bodies.f.h);
        const double h = longest > 0.0 ? longest : model->bodies.f.h[n / 2];
        if (thickness > 0.0 && poisson > nearly_incompressible && h > thickness * (1.0 + 1e-9))
            return rb_refuse(
                why, thickness_of(bodies[b], b),
                "with nu = %g the elements, %.3g mm, may not be longer than the thickness, %g mm; "
                "take %.0f contact elements or more, twice as many with error bars",
                poisson, h, thickness, ceil(rc->contact_elements * h / thickness));
    }
    return RB_OK;
}

/* Nothing is left of what is compressed by its whole thickness. */
rb_status rb_rolling_check_crushed(const rb_rolling_model *model, rb_message *why)
{
    const char *what = "";
    const double strain =
        rb_rolling_strain(model->rc, model->state.delta, rb_rolling_peak_pressure(model), &what);

    return strain >= 1.0
               ? rb_refuse(why, "approach,load,half-width,max-pressure",
                           "the %s is compressed by %.0f %% of its thickness (approach %.3g "
                           "mm): expected less than 100 %%",
                           what, 100.0 * strain, model->state.delta)
               : RB_OK;
}

rb_status rb_rolling_check_layer_resolved(const rb_rolling_model *model, rb_status s,
                                          rb_message *why)
{
    rb_message reason = {.text = ""};

    if (s == RB_OK) {
        s = check_resolved(model, why);
        return s == RB_OK ? rb_rolling_check_crushed(model, why) : s;
    }
    if (s < 0 || s == RB_ZONE || s == RB_INTERRUPTED || !model->state.zone)
        return s;
    if (check_resolved(model, &reason) == RB_OK)
        return s;
    if (why)
        *why = reason;
    return RB_EINVAL;
}
