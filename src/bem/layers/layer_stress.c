/* Stress in a layer and in its base (L5).  In the layer the difference from the
 * half-plane, whose stress is in closed form, is computed by Gauss quadrature over wave
 * numbers; below the bond the whole stress is computed in this way. */
#include "bem/internal.h"
#include "bem/layers/layer.h"
#include "bem/layers/stack.h"
#include "bem/surface.h"
#include "base/blas.h"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>

/* Beyond this product of wave number and thickness exp(-al), by which the bond feels the
 * surface, is below rounding. */
static const double LAST = 36.0;
/* Waves are Gauss points of panels of one width, but the first panel, which is halved
 * towards long waves. */
enum { GAUSS = 16, HALVINGS = 12, MOST_WAVES = 1 << 20 };

/* Waves exp(i k x), a panel of Gauss points: Airy's function over k^2 is, with eta = k y,
 *     layer: half-plane's + c eta sinh eta + d (eta cosh eta - sinh eta)
 *     base:  (a + b (eta - al)) exp(al - eta)
 * times the tractions that load it; real and imaginary parts apart. */
typedef struct {
    double k[GAUSS], c[2][GAUSS], d[2][GAUSS], a[2][GAUSS], b[2][GAUSS];
} panel;

static void keep_value(double complex value, double of[2][GAUSS], int g)
{
    of[0][g] = creal(value);
    of[1][g] = cimag(value);
}

void rb_bem_edge_load_wave(const rb_bem_edge_load *load, double k, double complex *p,
                           double complex *q)
{
    *p = *q = 0.0;
    for (int j = 0; j + 1 < load->n; j++) {
        const double h = load->x[j + 1] - load->x[j], t = 0.5 * k * h;
        /* int of 1 and of x/h exp(-i k x) over the element */
        const double even = t > 0.0 ? sin(t) / t : 1.0,
                     odd = t > 0.1 ? (even - cos(t)) / (2.0 * t)
                                   : t / 6.0 * (1.0 - t * t / 10.0 * (1.0 - t * t / 28.0));
        const double kx = k * 0.5 * (load->x[j] + load->x[j + 1]);
        const double complex shift = h * (cos(kx) - I * sin(kx));
        *p += shift * (even * 0.5 * (load->p[j] + load->p[j + 1]) -
                       I * odd * (load->p[j + 1] - load->p[j]));
        *q += shift * (even * 0.5 * (load->q[j] + load->q[j + 1]) -
                       I * odd * (load->q[j + 1] - load->q[j]));
    }
}

/* Wave g of the panel, of length al = k d and with the weight of its Gauss point. */
static void set_wave(const rb_bem_surface *body, const rb_bem_edge_load *load, double al,
                     double weight, panel *w, int g)
{
    const double sh = sinh(al), ch = cosh(al), decay = exp(-al);
    double complex p_s[2];
    rb_bem_layer_wave bond;

    const double wave_number = w->k[g] = al / body->thickness;
    rb_bem_layer_wave_at(body, al, &bond);
    /* Transforms of the tractions, times the weight. */
    const double share = weight / (M_PI * body->thickness);
    double complex p, q;
    rb_bem_edge_load_wave(load, wave_number, &p, &q);
    p_s[0] = share * p;      /* f(0): -s_yy of the surface */
    p_s[1] = -I * share * q; /* f'(0): s_xy = -i f' is -q there */
    const double complex c = p_s[0] * bond.c[0] + p_s[1] * bond.c[1],
                         d = p_s[0] * bond.d[0] + p_s[1] * bond.d[1];
    /* f and f' of the layer go on in the base */
    const double complex a =
        p_s[0] * (1.0 + al) * decay + p_s[1] * al * decay + c * al * sh + d * (al * ch - sh);
    keep_value(c, w->c, g);
    keep_value(d, w->d, g);
    keep_value(a, w->a, g);
    keep_value(a - p_s[0] * al * decay + p_s[1] * (1.0 - al) * decay + c * (sh + al * ch) +
                   d * al * sh,
               w->b, g);
}

struct rb_bem_layer_field {
    rb_bem_stack_field *stack; /* of several layers: instead of all that follows; owned */
    rb_bem_surface body;       /* what it and the load borrow stays the caller's */
    rb_bem_edge_load load;     /* of nodes */
    double reach;              /* of the present waves */
    int n;
    panel *panel; /* n, k increasing; owned */
};

/* f and its derivatives in the layer, at eta = k y: of the waves of a panel. */
static void in_layer(const panel *w, const double *eta, const double *sh, const double *ch,
                     double f[3][2][GAUSS])
{
    for (int i = 0; i < 2; i++)
        for (int g = 0; g < GAUSS; g++) {
            const double c = w->c[i][g], d = w->d[i][g];
            f[0][i][g] = c * eta[g] * sh[g] + d * (eta[g] * ch[g] - sh[g]);
            f[1][i][g] = c * (sh[g] + eta[g] * ch[g]) + d * eta[g] * sh[g];
            f[2][i][g] = c * (2.0 * ch[g] + eta[g] * sh[g]) + d * (sh[g] + eta[g] * ch[g]);
        }
}

static void in_base(const panel *w, const double *eta, const double *decay, double f[3][2][GAUSS])
{
    for (int i = 0; i < 2; i++)
        for (int g = 0; g < GAUSS; g++) {
            const double a = w->a[i][g], b = w->b[i][g];
            f[0][i][g] = (a + b * eta[g]) * decay[g];
            f[1][i][g] = (b - a - b * eta[g]) * decay[g];
            f[2][i][g] = (a - 2.0 * b + b * eta[g]) * decay[g];
        }
}

/* Panels after whose first exp(i k x) and exp(k y) are computed anew: from panel to panel
 * they change by a factor.  Their waves stay in the cache for all points. */
enum { ANEW = 32 };

/* s_xx = f'', s_yy = -f, s_xy = -i f', each times exp(i k x), of the panels first ... last - 1.
 * Waves that fade on their way down, and up again from the bond, are left out. */
static void add_panels(const rb_bem_layer_field *field, int first, int last, const double xy[2],
                       double *stress)
{
    const double thickness = field->body.thickness,
                 fades = LAST / fmax(2.0 * thickness - xy[1], xy[1]);
    const int is_layer = xy[1] <= thickness;
    const double rate = is_layer ? xy[1] : thickness - xy[1];
    double re[GAUSS], im[GAUSS], up[GAUSS], sum[3] = {0.0, 0.0, 0.0};

    for (int j = first; j < last && field->panel[j].k[0] <= fades; j++) {
        const panel *w = &field->panel[j];
        double eta[GAUSS], sh[GAUSS], ch[GAUSS], f[3][2][GAUSS];
        if (j == first || j <= HALVINGS) {
            for (int g = 0; g < GAUSS; g++) {
                re[g] = cos(w->k[g] * xy[0]);
                im[g] = sin(w->k[g] * xy[0]);
                up[g] = exp(w->k[g] * rate);
            }
        } else {
            const double width = w->k[0] - w[-1].k[0], factor = exp(width * rate),
                         turn = cos(width * xy[0]), around = sin(width * xy[0]);
            for (int g = 0; g < GAUSS; g++) {
                const double x = re[g];
                re[g] = x * turn - im[g] * around;
                im[g] = x * around + im[g] * turn;
                up[g] *= factor;
            }
        }
        if (is_layer && rate == 0.0) { /* on the surface only sxx is not given */
            for (int g = 0; g < GAUSS; g++)
                sum[0] += 2.0 * (re[g] * w->c[0][g] - im[g] * w->c[1][g]);
            continue;
        }
        for (int g = 0; g < GAUSS; g++)
            eta[g] = fabs(w->k[g] * rate);
        if (is_layer) {
            for (int g = 0; g < GAUSS; g++) {
                sh[g] = 0.5 * (up[g] - 1.0 / up[g]);
                ch[g] = 0.5 * (up[g] + 1.0 / up[g]);
            }
            for (int g = 0; g < GAUSS && eta[g] < 1e-3; g++)
                sh[g] = sinh(eta[g]);
            in_layer(w, eta, sh, ch, f);
        } else
            in_base(w, eta, up, f);
        for (int g = 0; g < GAUSS; g++) {
            sum[0] += re[g] * f[2][0][g] - im[g] * f[2][1][g];
            sum[1] -= re[g] * f[0][0][g] - im[g] * f[0][1][g];
            sum[2] += re[g] * f[1][1][g] + im[g] * f[1][0][g];
        }
    }
    for (int c = 0; c < 3; c++)
        stress[c] += sum[c];
}

/* ---- The field --------------------------------------------------------------------- */

void rb_bem_layer_field_free(rb_bem_layer_field *field)
{
    if (!field)
        return;
    rb_bem_stack_field_free(field->stack);
    free(field->panel);
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
                       "stress: contact and points extend over %.3g mm, for which the layer "
                       "needs a thickness of %.3g mm at least, got %.3g mm",
                       reach, 0.1 * LAST * GAUSS * reach / (MOST_WAVES - GAUSS * HALVINGS), d);
    const int n = (int)panels - 1 + HALVINGS;
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(GAUSS);
    panel *w = malloc((size_t)n * sizeof *w);
    rb_status s = rule && w ? RB_OK : RB_ENOMEM;
    int stop = 0;

#pragma omp parallel for num_threads(rb_blas_loop_threads())                                       \
    schedule(static) if (s == RB_OK && (double)n * GAUSS * f->load.n > rb_pairs_for_threads)
    for (int k = 0; k < (s == RB_OK ? n : 0); k++) {
        if (rb_interrupted_in_loop(&stop))
            continue;
        const int whole = k - HALVINGS + 1;
        const double to = whole > 0 ? (whole + 1) * width : ldexp(width, whole);
        const double from = whole > 0 ? whole * width : k > 0 ? 0.5 * to : 0.0;
        for (int g = 0; g < GAUSS; g++) {
            double al, weight;
            gsl_integration_glfixed_point(from, to, (size_t)g, &al, &weight, rule);
            set_wave(&f->body, &f->load, al, weight, &w[k], g);
        }
    }
    if (stop)
        s = RB_INTERRUPTED;
    if (rule)
        gsl_integration_glfixed_table_free(rule);
    if (s == RB_OK) {
        free(f->panel);
        f->panel = w;
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
    const rb_status s = body->stack ? rb_bem_stack_field_create(body, load, &f->stack, why) : RB_OK;
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

    if (field->stack)
        return rb_bem_stack_field_add(field->stack, points, stress, why);
    for (int k = 0; k < points.n; k++) {
        const double at = points.xy[2 * k], depth = points.xy[2 * k + 1];
        low = fmin(low, at);
        high = fmax(high, at);
        if (!(depth >= 0.0 && (depth <= d || field->body.elastic_base)))
            return rb_fail(why, RB_EINVAL, "point %d at (%g, %g) lies outside the body", k, at,
                           depth);
    }
    const double reach = fmax(high - low, 2.0 * (x[field->load.n - 1] - x[0]));
    const rb_status s = reach > field->reach ? make_waves(field, reach, why) : RB_OK;
    if (s != RB_OK)
        return s;
    for (int k = 0; k < points.n; k++)
        for (int c = 0; c < 3 && points.xy[2 * k + 1] > d; c++)
            stress[3 * k + c] = 0.0;
    for (int first = 0; first < field->n; first += ANEW) {
        const int last = first + ANEW < field->n ? first + ANEW : field->n;
        if (rb_interrupted())
            return RB_INTERRUPTED;
#pragma omp parallel for num_threads(rb_blas_loop_threads())                                       \
    schedule(static) if ((double)points.n * GAUSS * ANEW > rb_pairs_for_threads)
        for (int k = 0; k < points.n; k++)
            add_panels(field, first, last, points.xy + 2 * k, stress + 3 * k);
    }
    return RB_OK;
}
