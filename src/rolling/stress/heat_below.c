/* Temperature below the surfaces in steady rolling (T4): Carslaw and Jaeger's moving line sources
 * along the contact. */
#include "rolling/body/body.h"
#include "rolling/case/internal.h"
#include "rolling/solve/heat.h"
#include "rolling/stress/stress.h"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_sf_bessel.h>
#include <string.h>

enum { NODES = 24, FEW = 8 };

/* exp(u) K_0(sqrt(u^2 + w^2)), neither of which has a double of its own for large u. */
static double kernel(double u, double w)
{
    const double r = hypot(u, w);

    return exp(u - r) * gsl_sf_bessel_K0_scaled(r);
}

/* nodes[0]: NODES of them, nodes[1]: FEW. */
static double panel(double from, double to, double w, gsl_integration_glfixed_table *const nodes[2],
                    int few)
{
    double sum = 0.0;

    for (size_t k = 0; k < (few ? FEW : NODES); k++) {
        double u, weight;
        gsl_integration_glfixed_point(from, to, k, &u, &weight, nodes[few]);
        sum += weight * kernel(u, w);
    }
    return sum;
}

/* The integral from `from` to `to` on one side of u = 0, where the kernel is steep: panels that
 * grow with the distance from it, w > 0 the first. */
static double one_side(double from, double to, double w,
                       gsl_integration_glfixed_table *const nodes[2])
{
    enum { NOTHING = -40 }; /* exponent of what counts no more */
    const double side = from < 0.0 ? -1.0 : 1.0;
    const double near = fmin(fabs(from), fabs(to)), far = fmax(fabs(from), fabs(to));
    double sum = 0.0, length = w, at = 0.0;

    while (at < far && !(side < 0.0 && -at - hypot(at, w) < NOTHING)) {
        const double begin = fmax(at, near), end = fmin(at + length, far);
        if (end > begin)
            sum += panel(side * begin, side * end, w, nodes, end - begin < 0.5 * length);
        at += length;
        length *= 1.7;
    }
    return side * sum;
}

static double below(double from, double to, double w, gsl_integration_glfixed_table *const nodes[2])
{
    if (w < 1e-12)
        return rb_rolling_moving_source(to) - rb_rolling_moving_source(from);
    if (from < 0.0 && to > 0.0)
        return one_side(0.0, to, w, nodes) + one_side(from, 0.0, w, nodes);
    return one_side(from, to, w, nodes);
}

/* Depth below the surface; the circle of a wheel is not part of the formula. */
static double depth_of(const rb_rolling_body *b, double x, double y)
{
    const double surface =
        rb_rolling_body_can(b, RB_BODY_FLAT) ? 0.0 : rb_bem_circle_height(b->radius, x);

    return fmax(fabs(y) - surface, 0.0);
}

rb_status rb_rolling_temperature_inside(const rb_rolling_case *rc, const rb_rolling_solution *s,
                                        int of_b, int n, rb_rolling_stress *at, rb_message *why)
{
    const rb_rolling_heat *heat = of_b ? &rc->heat_b : &rc->heat_a;
    const double V = rb_rolling_surface_speed(rc, of_b, s->creepage),
                 *into = of_b ? s->heat_b : s->heat_a;
    const int is_known = rb_rolling_has_heat(rc) && rc->formulation == RB_STEADY && into,
              conducts = heat->conductivity > 0.0 && V != 0.0;

    for (int k = 0; k < n; k++)
        at[k].temperature = is_known && isfinite(at[k].sxx) ? heat->temperature : NAN;
    if (!is_known || !conducts)
        return RB_OK;
    gsl_integration_glfixed_table *const nodes[2] = {gsl_integration_glfixed_table_alloc(NODES),
                                                     gsl_integration_glfixed_table_alloc(FEW)};
    const double P = fabs(V) * heat->heat_capacity / (2.0 * heat->conductivity),
                 up = V > 0.0 ? P : -P; /* where the surface comes from */
    rb_status status = nodes[0] && nodes[1] ? RB_OK : RB_ENOMEM;

    for (int k = 0; k < n && status == RB_OK; k++) {
        const double x = at[k].x, w = P * depth_of(of_b ? &rc->b : &rc->a, x, at[k].y);
        double sum = 0.0;
        for (int i = 0; i < s->n && isfinite(at[k].sxx); i++) {
            const double ends[2] = {up * (s->x[i] - 0.5 * s->h[i] - x),
                                    up * (s->x[i] + 0.5 * s->h[i] - x)};
            if (into[i] != 0.0)
                sum += into[i] * below(fmin(ends[0], ends[1]), fmax(ends[0], ends[1]), w, nodes);
        }
        at[k].temperature += sum / (M_PI * heat->conductivity * P);
    }
    for (int k = 0; k < 2; k++)
        if (nodes[k])
            gsl_integration_glfixed_table_free(nodes[k]);
    return status == RB_OK ? RB_OK : rb_fail(why, status, "out of memory for temperatures");
}
