/* Strains that follow from the inputs: how much a layer, cover or rim is compressed, and what
 * stress along the surfaces stretches them by (U1). */
#include "bem/bem.h"
#include "rolling/body/body.h"
#include "rolling/case/internal.h"

#include <math.h>

/* ---- Compression of thin bodies ------------------------------------------------------ */

static double thickness_of(const rb_rolling_body *body, const char **what)
{
    const int layer = body->layer > 0.0, cover = body->cover > 0.0;

    *what = layer ? "layer" : cover ? "cover" : "rim";
    return layer                         ? rb_rolling_layers_depth(body)
           : cover                       ? body->cover
           : body->support == RB_BEM_HUB ? (1.0 - body->hub_ratio) * body->radius
                                         : INFINITY;
}

void rb_rolling_strains(const rb_rolling_case *rc, double approach, double pressure,
                        double strain[4])
{
    const rb_rolling_body *const bodies[] = {&rc->a, &rc->b};

    for (int b = 0; b < 2; b++) {
        const char *what;
        const double thickness = thickness_of(bodies[b], &what);
        double slow = 1.0;
        strain[2 * b] = strain[2 * b + 1] = NAN;
        if (isinf(thickness) || (b == 1 && !rc->elastic_b))
            continue;
        for (int k = 0; k < bodies[b]->memory.n; k++)
            slow += bodies[b]->memory.ratio[k];
        strain[2 * b] = approach * rb_rolling_compliance(rb_rolling_material(rc, bodies[b])) *
                        rb_rolling_modulus(rc) / thickness;
        const rb_bem_stack *stack = bodies[b]->stack;
        double softness = stack ? 0.0 : slow / bodies[b]->young; /* the mean of all layers */
        for (int k = 0; stack && k < stack->n; k++)
            softness += stack->thickness[k] / (stack->young[k] * thickness);
        strain[2 * b + 1] = 2.0 * pressure * softness;
    }
}

double rb_rolling_strain(const rb_rolling_case *rc, double approach, double pressure,
                         const char **what)
{
    double all[4], most = NAN;

    rb_rolling_strains(rc, approach, pressure, all);
    for (int b = 0; b < 2; b++) {
        const double strain = fmin(all[2 * b], all[2 * b + 1]);
        const char *of_body;
        if (isnan(strain) || strain <= most)
            continue;
        most = strain;
        thickness_of(b ? &rc->b : &rc->a, &of_body);
        if (what)
            *what = of_body;
    }
    return most;
}

int rb_rolling_has_thickness(const rb_rolling_case *rc)
{
    return !isnan(rb_rolling_strain(rc, 0.0, 0.0, NULL));
}

/* ---- Stress along the surfaces (U1) --------------------------------------------------- */

/* The strain of A, and that of B, by its bulk stress. */
static void bulk_strains(const rb_rolling_case *rc, double strain[2])
{
    const int any = rb_rolling_is_strained(rc);
    strain[0] =
        any ? rc->bulk_stress * rb_rolling_compliance(rb_rolling_material(rc, &rc->a)) : 0.0;
    strain[1] = any && rc->elastic_b
                    ? rc->bulk_stress_b * rb_rolling_compliance(rb_rolling_material(rc, &rc->b))
                    : 0.0;
}

double rb_rolling_bulk_strain(const rb_rolling_case *rc)
{
    double strain[2];
    bulk_strains(rc, strain);
    return strain[0] - strain[1];
}

double rb_rolling_largest_bulk_strain(const rb_rolling_case *rc)
{
    double strain[2];
    bulk_strains(rc, strain);
    return fmax(fabs(strain[0]), fabs(strain[1]));
}
