/* Waves in a layer bonded to a rigid or elastic base (L1), (L2). */
#include "bem/layers/layer.h"

#include <math.h>

/* 1 + sum f_k/(1 - i k L_k): compliance of the layer's material over its glassy one. */
static double complex creep(const rb_bem_surface *body, double complex k)
{
    double complex c = 1.0;
    for (int j = 0; j < body->terms; j++)
        c += body->ratio[j] / (1.0 - I * k * body->length[j]);
    return c;
}

/* The layer 0 <= eta <= al and its bond. */
typedef struct {
    double nu;
    double complex rho; /* compliance of the base over 1/(2 G) (0: rigid) */
    double beta;
    int slides; /* on a smooth base, which bears no friction (L9) */
} bonded_layer;

/* What a function f with the derivatives f[1], f[2], f[3] at eta = al lacks of following
 * the base, along the surface and across it. */
static void miss_bond(const bonded_layer *layer, const double complex f[4], double complex *v,
                      double complex *u)
{
    const double nu = layer->nu, beta = layer->beta;
    *v = (1.0 - nu) * f[3] - (2.0 - nu) * f[1] - layer->rho * (f[0] + beta * f[1]);
    *u = layer->slides ? f[1] : (1.0 - nu) * f[2] + nu * f[0] + layer->rho * (f[1] + beta * f[0]);
}

/* The half-plane's own function misses the bond by what comes down to it; the two that
 * grow make up for that.  All are multiplied by 2 exp(-al). */
void rb_bem_layer_wave_at(const rb_bem_surface *body, double complex al, rb_bem_layer_wave *wave)
{
    bonded_layer layer = {.nu = body->material.poisson, .slides = body->smooth_base};
    const double complex fade = cexp(-al), decay = fade * fade, c = 1.0 + decay,
                         h = 2.0 * fade * csinh(al);
    const double complex falls[2][4] = {{2.0 * decay * (1.0 + al), -2.0 * decay * al,
                                         2.0 * decay * (al - 1.0), 2.0 * decay * (2.0 - al)},
                                        {2.0 * decay * al, 2.0 * decay * (1.0 - al),
                                         2.0 * decay * (al - 2.0), 2.0 * decay * (3.0 - al)}};
    const double complex grows[2][4] = {{al * h, h + al * c, 2.0 * c + al * h, 3.0 * h + al * c},
                                        {al * c - h, al * h, h + al * c, 2.0 * c + al * h}};
    double complex v[2], u[2], falling_v, falling_u;

    if (body->elastic_base) {
        const double nu_2 = body->base.poisson;
        layer.rho = 2.0 * (1.0 - nu_2) * body->material.shear / body->base.shear /
                    creep(body, al / body->thickness);
        layer.beta = (1.0 - 2.0 * nu_2) / (2.0 * (1.0 - nu_2));
    }
    for (int j = 0; j < 2; j++)
        miss_bond(&layer, grows[j], &v[j], &u[j]);
    const double complex per_det = 1.0 / (v[0] * u[1] - v[1] * u[0]);
    for (int j = 0; j < 2; j++) {
        miss_bond(&layer, falls[j], &falling_v, &falling_u);
        wave->c[j] = (v[1] * falling_u - falling_v * u[1]) * per_det;
        wave->d[j] = (falling_v * u[0] - v[0] * falling_u) * per_det;
    }
}

void rb_bem_layer_remainder_at(const rb_bem_surface *body, double complex al, double complex Z[3])
{
    const double complex softer = creep(body, al / body->thickness);
    rb_bem_layer_wave w;
    rb_bem_layer_wave_at(body, al, &w);
    Z[0] = softer * w.d[0];
    Z[1] = -softer * w.c[1];
    Z[2] = -softer * w.c[0];
    if (body->smooth_base)
        Z[1] -= 0.5 * (1.0 / al + 2.0) * cexp(-2.0 * al);
}

/* int_0^inf (1 + 2 al) exp(-2 al) (cos(al X) - 1)/(2 al^2) dal */
double rb_bem_layer_membrane(const rb_bem_surface *body, double X)
{
    return body->smooth_base ? -0.5 * X * atan(0.5 * X) : 0.0;
}

double rb_bem_layer_base_compliance(const rb_bem_surface *body)
{
    const rb_bem_material a = body->material, b = body->base;
    return body->elastic_base ? (1.0 - b.poisson) * a.shear / ((1.0 - a.poisson) * b.shear) : 0.0;
}

static double coupling_of(rb_bem_material m)
{
    return (1.0 - 2.0 * m.poisson) / (2.0 * (1.0 - m.poisson));
}

void rb_bem_layer_longest_waves(const rb_bem_surface *body, double Z[3])
{
    const double base = rb_bem_layer_base_compliance(body);
    double softer = 1.0;

    for (int k = 0; k < body->terms; k++)
        softer += body->ratio[k];
    Z[0] = Z[1] = base - softer;
    Z[2] = base * coupling_of(body->base) - softer * coupling_of(body->material);
    if (body->smooth_base) {
        Z[1] = -1.0; /* besides that of the membrane */
        Z[2] = -0.5;
    }
}
