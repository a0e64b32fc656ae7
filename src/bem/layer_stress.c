/* Stress in a layer and in its base (L5).  In the layer the difference from the
 * half-plane, whose stress is in closed form, is computed by Gauss quadrature over wave
 * numbers; below the bond the whole stress is computed in this way. */
#include "bem/internal.h"
#include "bem/layer.h"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>

/* Beyond this product of wave number and thickness exp(-al), by which the bond feels the
 * surface, is below rounding. */
static const double LAST = 40.0;
/* Waves are Gauss points of panels of one width, but the first panel, which is halved
 * towards long waves. */
enum { GAUSS = 16, HALVINGS = 12, MOST_WAVES = 1 << 16 };

/* A wave exp(i k x): Airy's function over k^2 is, with eta = k y,
 *     layer: half-plane's + c eta sinh eta + d (eta cosh eta - sinh eta)
 *     base:  (a + b (eta - al)) exp(al - eta)
 * times the tractions that load it. */
typedef struct {
    double k;
    double complex c, d, a, b;
} wave;

static void set_wave(const rb_bem_surface *body, const rb_bem_edge_load *load, double al,
                     double weight, wave *w)
{
    const double sh = sinh(al), ch = cosh(al), decay = exp(-al);
    double complex p_s[2];
    rb_bem_layer_wave bond;

    w->k = al / body->thickness;
    rb_bem_layer_wave_at(body, al, &bond);
    /* Transforms of the tractions, which are linear between the nodes, times the weight. */
    const double share = weight / (M_PI * body->thickness);
    double complex p = 0.0, q = 0.0;
    for (int j = 0; j + 1 < load->n; j++) {
        const double h = load->x[j + 1] - load->x[j], t = 0.5 * w->k * h;
        /* int of 1 and of x/h exp(-i k x) over the element */
        const double even = t > 0.0 ? sin(t) / t : 1.0,
                     odd = t > 0.1 ? (even - cos(t)) / (2.0 * t)
                                   : t / 6.0 * (1.0 - t * t / 10.0 * (1.0 - t * t / 28.0));
        const double kx = w->k * 0.5 * (load->x[j] + load->x[j + 1]);
        const double complex shift = h * (cos(kx) - I * sin(kx));
        p += shift *
             (even * 0.5 * (load->p[j] + load->p[j + 1]) - I * odd * (load->p[j + 1] - load->p[j]));
        q += shift *
             (even * 0.5 * (load->q[j] + load->q[j + 1]) - I * odd * (load->q[j + 1] - load->q[j]));
    }
    p_s[0] = share * p;      /* f(0): -s_yy of the surface */
    p_s[1] = -I * share * q; /* f'(0): s_xy = -i f' is -q there */
    w->c = p_s[0] * bond.c[0] + p_s[1] * bond.c[1];
    w->d = p_s[0] * bond.d[0] + p_s[1] * bond.d[1];
    /* f and f' of the layer go on in the base */
    w->a =
        p_s[0] * (1.0 + al) * decay + p_s[1] * al * decay + w->c * al * sh + w->d * (al * ch - sh);
    w->b = w->a - p_s[0] * al * decay + p_s[1] * (1.0 - al) * decay + w->c * (sh + al * ch) +
           w->d * al * sh;
}

struct rb_bem_layer_field {
    rb_bem_surface body;   /* what it and the load borrow stays the caller's */
    rb_bem_edge_load load; /* of nodes */
    double reach;          /* of the present waves */
    int n;
    wave *wave; /* n, k increasing; owned */
};

/* s_xx = f'', s_yy = -f, s_xy = -i f', each times exp(i k x).  Waves that fade on their
 * way down, and up again from the bond, are left out.  From panel to panel exp(i k x) and
 * exp(k y) change by a factor, by which they are multiplied ANEW times at the most. */
static void add_waves(const rb_bem_layer_field *field, const double xy[2], double *stress)
{
    enum { EQUAL = GAUSS * HALVINGS, ANEW = 32 };
    const wave *w = field->wave;
    const double thickness = field->body.thickness,
                 fades = LAST / fmax(2.0 * thickness - xy[1], xy[1]);
    const int in_layer = xy[1] <= thickness;
    const double rate = in_layer ? xy[1] : thickness - xy[1],
                 width = w[EQUAL + GAUSS].k - w[EQUAL].k, factor = exp(width * rate);
    const double complex turn = cos(width * xy[0]) + I * sin(width * xy[0]);
    double complex along[GAUSS];
    double into[GAUSS];

    for (int k = 0; k < field->n && w[k].k <= fades; k++) {
        double complex *e = &along[k % GAUSS];
        double *up = &into[k % GAUSS];
        if (k < EQUAL || (k - EQUAL) / GAUSS % ANEW == 0) {
            *e = cos(w[k].k * xy[0]) + I * sin(w[k].k * xy[0]);
            *up = exp(w[k].k * rate);
        } else {
            *e *= turn;
            *up *= factor;
        }
        double complex f[3]; /* f, f' and f'' */
        const double eta = fabs(w[k].k * rate);
        if (in_layer) {
            const double complex c = w[k].c, d = w[k].d;
            const double sh = eta < 1e-3 ? sinh(eta) : 0.5 * (*up - 1.0 / *up),
                         ch = 0.5 * (*up + 1.0 / *up);
            f[0] = c * eta * sh + d * (eta * ch - sh);
            f[1] = c * (sh + eta * ch) + d * eta * sh;
            f[2] = c * (2.0 * ch + eta * sh) + d * (sh + eta * ch);
        } else {
            const double complex a = w[k].a, b = w[k].b;
            f[0] = (a + b * eta) * *up;
            f[1] = (b - a - b * eta) * *up;
            f[2] = (a - 2.0 * b + b * eta) * *up;
        }
        stress[0] += creal(*e) * creal(f[2]) - cimag(*e) * cimag(f[2]);
        stress[1] -= creal(*e) * creal(f[0]) - cimag(*e) * cimag(f[0]);
        stress[2] += creal(*e) * cimag(f[1]) + cimag(*e) * creal(f[1]);
    }
}

/* ---- The field --------------------------------------------------------------------- */

void rb_bem_layer_field_free(rb_bem_layer_field *field)
{
    if (!field)
        return;
    free(field->wave);
    free(field);
}

/* For points and strips that are `reach` apart at most: the rule integrates ten radians
 * to rounding. */
static rb_status make_waves(rb_bem_layer_field *f, double reach, rb_message *why)
{
    const double d = f->body.thickness;
    const double panels = ceil(LAST * fmax(1.0, 0.1 * reach / d)), width = LAST / panels;
    if (!(GAUSS * (panels + HALVINGS) < MOST_WAVES))
        return rb_fail(why, RB_EINVAL,
                       "stress: the layer, %.3g mm, is too thin for points that are %.3g "
                       "mm apart; choose points closer together, or leave out the layer",
                       d, reach);
    const int n = GAUSS * ((int)panels - 1 + HALVINGS);
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(GAUSS);
    wave *w = malloc((size_t)n * sizeof *w);
    rb_status s = rule && w ? RB_OK : RB_ENOMEM;

    for (int k = 0; k < n && s == RB_OK; k++) {
        if (rb_interrupted())
            s = RB_INTERRUPTED;
        const int panel = k / GAUSS, whole = panel - HALVINGS + 1;
        const double to = whole > 0 ? (whole + 1) * width : ldexp(width, whole);
        const double from = whole > 0 ? whole * width : panel > 0 ? 0.5 * to : 0.0;
        double al, weight;
        gsl_integration_glfixed_point(from, to, (size_t)(k % GAUSS), &al, &weight, rule);
        set_wave(&f->body, &f->load, al, weight, &w[k]);
    }
    if (rule)
        gsl_integration_glfixed_table_free(rule);
    if (s == RB_OK) {
        free(f->wave);
        f->wave = w;
        f->n = n;
        f->reach = reach;
    } else {
        free(w);
    }
    return s;
}

rb_status rb_bem_layer_field_create(const rb_bem_surface *body, const rb_bem_edge_load *load,
                                    rb_bem_layer_field **field, rb_message *why)
{
    *field = NULL;
    if (rb_bem_surface_check(body, why) != RB_OK)
        return RB_EINVAL;
    if (!(body->thickness > 0.0) ||
        !rb_bem_edge_load_is_valid(load, load->n, (rb_bem_points){0, NULL}))
        return rb_fail(why, RB_EINVAL, "stress: expected a layer with tractions at nodes");
    rb_bem_layer_field *f = calloc(1, sizeof *f);
    if (!f)
        return RB_ENOMEM;
    f->body = *body;
    f->load = *load;
    const rb_status s = make_waves(f, 3.0 * (load->x[load->n - 1] - load->x[0]), why);
    if (s == RB_OK)
        *field = f;
    else
        rb_bem_layer_field_free(f);
    return s;
}

rb_status rb_bem_layer_field_add(rb_bem_layer_field *field, rb_bem_points points, double *stress,
                                 rb_message *why)
{
    const double d = field->body.thickness, *x = field->load.x;
    double low = x[0], high = x[field->load.n - 1];

    for (int k = 0; k < points.n; k++) {
        const double at = points.xy[2 * k], depth = points.xy[2 * k + 1];
        low = fmin(low, at);
        high = fmax(high, at);
        if (!(depth >= 0.0 && (depth <= d || field->body.elastic_base)))
            return rb_fail(why, RB_EINVAL, "point %d at (%g, %g) lies outside the body", k, at,
                           depth);
    }
    const rb_status s = high - low > field->reach ? make_waves(field, high - low, why) : RB_OK;
    if (s != RB_OK)
        return s;
    int stop = 0;
#pragma omp parallel for schedule(static) if ((double)points.n * field->n > rb_pairs_for_threads)
    for (int k = 0; k < points.n; k++) {
        const double *xy = points.xy + 2 * k;
        if (rb_interrupted_in_loop(&stop))
            continue;
        for (int c = 0; c < 3 && xy[1] > d; c++)
            stress[3 * k + c] = 0.0;
        add_waves(field, xy, stress + 3 * k);
    }
    return stop ? RB_INTERRUPTED : RB_OK;
}
