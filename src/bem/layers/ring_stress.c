/* Stress in a cover (B20): that of the half-plane under the same tractions along
 * the arc, in closed form, and the difference between the waves of the ring and those of the
 * half-plane, whose depth is R ln(R/r). */
#include "bem/internal.h"
#include "bem/layers/ring.h"
#include "bem/layers/layer.h"
#include "base/blas.h"

#include <complex.h>
#include <gsl/gsl_math.h>
#include <stdlib.h>

typedef double complex cplx;

/* From this product of wave number and thickness on the core is out of reach of a wave. */
static const double OUT_OF_REACH = 18.0;
enum { MOST_OF_LOAD = 1 << 15, WAVES_OF_LOAD = 30, ANEW = 64 };

/* r times stresses rr, ss and rs of wave m: sum over the exponents m + 1, m - 1, 1 - m, -1 - m of
 * r/R; what the half-plane has: f = (A + B eta) exp(-eta), eta = m ln(R/r). */
typedef struct {
    double ring[4][3][2]; /* real and imaginary parts */
    cplx A, B;
} wave;

struct rb_bem_ring_field {
    rb_bem_wheel wheel;
    rb_bem_edge_load load; /* along the arc; borrowed */
    int n;                 /* waves 0 ... n - 1 */
    wave *wave;            /* owned */
    cplx state[2][4];      /* of waves 0 and 1 at the surface */
    double P, Q, centre;
};

void rb_bem_ring_field_free(rb_bem_ring_field *field)
{
    if (!field)
        return;
    free(field->wave);
    free(field);
}

/* Stresses times r of a state y = (2 G U, 2 G V, r S, r T), U cos, V sin, S cos, T sin, as factors
 * of exp(i m theta). */
static void stresses(double nu, double m, const cplx y[4], cplx s[3])
{
    s[0] = y[2];
    s[1] = (nu * y[2] + y[0] + m * y[1]) / (1.0 - nu);
    s[2] = -I * y[3];
}

/* y at the outer contour: the tractions of the load, and what the ring answers. */
static void state_at_surface(const rb_bem_wheel *w, double m, cplx S, cplx T, cplx y[4])
{
    const rb_ring_compliance K = rb_ring_of_wheel(w, m);
    y[0] = K.uu * S + K.uv * T;
    y[1] = K.vu * S + K.vv * T;
    y[2] = S;
    y[3] = T;
}

/* The part of y that changes with exponent `which`: the product of (M - L)/(L_which - L) over the
 * other exponents L. */
static void part_of(double nu, double m, int which, const cplx y[4], cplx part[4])
{
    const double exponent[4] = {m + 1.0, m - 1.0, 1.0 - m, -1.0 - m};
    double M[4][4];

    rb_ring_equations(m, nu, M);
    for (int i = 0; i < 4; i++)
        part[i] = y[i];
    for (int j = 0; j < 4; j++) {
        if (j == which)
            continue;
        cplx next[4];
        for (int i = 0; i < 4; i++) {
            next[i] = -exponent[j] * part[i];
            for (int k = 0; k < 4; k++)
                next[i] += M[i][k] * part[k];
        }
        for (int i = 0; i < 4; i++)
            part[i] = next[i] / (exponent[which] - exponent[j]);
    }
}

static void set_wave(rb_bem_ring_field *f, int m, wave *w)
{
    const double R = f->wheel.radius, share = (m ? 2.0 : 1.0) / (2.0 * M_PI * R),
                 nu = f->wheel.material.poisson;
    const int is_deep = m * log(R / f->wheel.inner) > OUT_OF_REACH;
    cplx p, q, y[4], part[4], s[3];

    rb_bem_edge_load_wave(&f->load, m / R, &p, &q);
    p *= share;
    q *= share;
    *w = (wave){.A = p, .B = p - I * q};
    state_at_surface(&f->wheel, m, -R * p, R * I * q, y);
    if (m < 2) /* exponents coincide: the state itself, carried inwards to each point */
        for (int i = 0; i < 4; i++)
            f->state[m][i] = y[i];
    for (int k = 0; k < (m < 2 ? 0 : is_deep ? 2 : 4); k++) {
        part_of(nu, m, k, y, part);
        stresses(nu, m, part, s);
        for (int i = 0; i < 3; i++) {
            w->ring[k][i][0] = creal(s[i]);
            w->ring[k][i][1] = cimag(s[i]);
        }
    }
}

rb_status rb_bem_ring_field_create(const rb_bem_wheel *wheel, const rb_bem_edge_load *load,
                                   rb_bem_ring_field **field, rb_message *why)
{
    /* The shorter waves of a narrow load differ from the half-plane's by its width over R. */
    const double width = load->x[load->n - 1] - load->x[0], R = wheel->radius;
    const double waves = 2.0 + fmax(OUT_OF_REACH / log(R / wheel->inner),
                                    fmin(2.0 * WAVES_OF_LOAD * R / width, MOST_OF_LOAD));
    *field = NULL;
    if (!(wheel->inner <= (1.0 - RB_BEM_RING_THINNEST) * R))
        return rb_fail(why, RB_EINVAL, "stress: a cover of %g on a radius of %g is too thin",
                       R - wheel->inner, R);
    rb_bem_ring_field *f = calloc(1, sizeof *f);
    if (!f)
        return RB_ENOMEM;
    f->wheel = *wheel;
    f->load = *load;
    f->n = (int)waves;
    f->wave = malloc((size_t)f->n * sizeof *f->wave);
    if (!f->wave) {
        rb_bem_ring_field_free(f);
        return RB_ENOMEM;
    }
    for (int j = 0; j + 1 < load->n; j++) {
        const double half = 0.5 * (load->x[j + 1] - load->x[j]), p = load->p[j] + load->p[j + 1];
        f->P += half * p;
        f->Q += half * (load->q[j] + load->q[j + 1]);
        f->centre += half * p * 0.5 * (load->x[j] + load->x[j + 1]);
    }
    f->centre = f->P > 0.0 ? f->centre / f->P : 0.0;
    int stop = 0;
#pragma omp parallel for num_threads(rb_blas_loop_threads())                                       \
    schedule(static) if ((double)f->n * load->n > rb_pairs_for_threads)
    for (int m = 0; m < f->n; m++)
        if (!rb_interrupted_in_loop(&stop))
            set_wave(f, m, &f->wave[m]);
    if (stop) {
        rb_bem_ring_field_free(f);
        return RB_INTERRUPTED;
    }
    *field = f;
    return RB_OK;
}

/* The waves of the half-plane are those of a load that repeats itself at each turn: what all its
 * other images make at s and depth y, rr, ss, rs.  Sums of 1/(z - n L) and of its square. */
static void images(const rb_bem_ring_field *f, double s, double y, double sigma[3])
{
    const double c = 0.5 / f->wheel.radius;
    const cplx z = s - f->centre + y * I, u = c * z, u2 = u * u, sine = csin(u);
    const cplx first = cabs(u) < 0.05 ? -c * u * (1.0 / 3.0 + u2 / 45.0 * (1.0 + u2 * 2.0 / 21.0))
                                      : c * (ccos(u) / sine - 1.0 / u),
               second = cabs(u) < 0.05 ? c * c * (1.0 / 3.0 + u2 / 15.0 * (1.0 + u2 * 10.0 / 63.0))
                                       : c * c * (1.0 / (sine * sine) - 1.0 / u2);
    const cplx F = f->Q + f->P * I;
    const double sum = -2.0 / M_PI * creal(F * first);
    const cplx apart = (F * (first - 2.0 * I * y * second) + conj(F) * first) / M_PI;
    sigma[0] = 0.5 * (sum + creal(apart));
    sigma[1] = 0.5 * (sum - creal(apart));
    sigma[2] = -0.5 * cimag(apart);
}

/* rr, ss, rs of waves 0 and 1, whose exponents coincide. */
static void long_wave(const rb_bem_ring_field *f, int m, double tau, cplx s[3])
{
    const cplx *y = f->state[m];
    cplx inside[4];
    double E[4][4];
    rb_ring_transfer(m, f->wheel.material.poisson, -tau, E);
    for (int i = 0; i < 4; i++) {
        inside[i] = 0.0;
        for (int k = 0; k < 4; k++)
            inside[i] += E[i][k] * y[k];
    }
    stresses(f->wheel.material.poisson, m, inside, s);
}

/* exp(i x) times the difference of both at eta = m tau. */
static void add_wave(const wave *w, double eta, double in, double out, double fade, double grow,
                     double per_r, const double x[2], double sigma[3])
{
    const double A[2] = {creal(w->A), cimag(w->A)}, B[2] = {creal(w->B), cimag(w->B)};
    double f[2], slope[2], bend[2];

    for (int k = 0; k < 2; k++) {
        f[k] = (A[k] + B[k] * eta) * fade;
        slope[k] = (B[k] - A[k] - B[k] * eta) * fade;
        bend[k] = (A[k] - 2.0 * B[k] + B[k] * eta) * fade;
    }
    const double plane[3][2] = {{-f[0], -f[1]}, {bend[0], bend[1]}, {-slope[1], slope[0]}};
    for (int i = 0; i < 3; i++) {
        double s[2];
        for (int k = 0; k < 2; k++)
            s[k] = per_r * (fade * (in * w->ring[0][i][k] + out * w->ring[1][i][k]) +
                            grow * (in * w->ring[2][i][k] + out * w->ring[3][i][k])) -
                   plane[i][k];
        sigma[i] += s[0] * x[0] - s[1] * x[1];
    }
}

/* The difference of ring and half-plane at angle theta and tau = ln(R/r): rr, ss, rs. */
static void add_waves(const rb_bem_ring_field *f, double theta, double tau, double sigma[3])
{
    const double per_r = exp(tau) / f->wheel.radius,
                 thickness = log(f->wheel.radius / f->wheel.inner), in = exp(-tau), out = exp(tau),
                 turn[2] = {cos(theta), sin(theta)};
    double fade = 1.0, grow = 1.0, x[2] = {1.0, 0.0};

    for (int m = 0; m < f->n; m++) {
        const wave *w = &f->wave[m];
        const double eta = m * tau;
        const int is_deep = m * thickness > OUT_OF_REACH;
        if (is_deep && eta > 2.0 * OUT_OF_REACH)
            break;
        if (m % ANEW == 0) {
            fade = exp(-eta);
            grow = is_deep ? 0.0 : exp(eta);
            x[0] = cos(m * theta);
            x[1] = sin(m * theta);
        }
        if (m < 2) { /* the ring's is a state, the half-plane's is that of any wave */
            cplx s[3];
            long_wave(f, m, tau, s);
            for (int i = 0; i < 3; i++)
                sigma[i] += per_r * (creal(s[i]) * x[0] - cimag(s[i]) * x[1]);
        }
        add_wave(w, eta, in, out, fade, grow, per_r, x, sigma);
        fade *= in;
        grow *= out;
        const double c = x[0] * turn[0] - x[1] * turn[1];
        x[1] = x[0] * turn[1] + x[1] * turn[0];
        x[0] = c;
    }
}

static rb_status stress_at(const rb_bem_ring_field *f, double x, double y, double *stress)
{
    const double R = f->wheel.radius, theta = atan2(x, R - y), r = hypot(x, R - y);
    const double depth = fmax((2.0 * R * y - x * x - y * y) / (R + r), 0.0),
                 tau = -log1p(-depth / R);
    const double at[2] = {R * theta, R * tau};
    double flat[3], sigma[3], more[3];
    const rb_status s = rb_bem_halfplane_stress_linear(&f->load, (rb_bem_points){1, at}, flat);
    if (s != RB_OK)
        return s;
    images(f, at[0], at[1], more);
    sigma[0] = flat[1] + more[0];
    sigma[1] = flat[0] + more[1];
    sigma[2] = -flat[2] + more[2];
    add_waves(f, theta, tau, sigma);
    /* from the directions outwards (sin, -cos) and along the circle (cos, sin) */
    const double c = cos(theta), d = sin(theta);
    stress[0] = sigma[0] * d * d + sigma[1] * c * c + 2.0 * sigma[2] * c * d;
    stress[1] = sigma[0] * c * c + sigma[1] * d * d - 2.0 * sigma[2] * c * d;
    stress[2] = (sigma[1] - sigma[0]) * c * d + sigma[2] * (d - c) * (d + c);
    return RB_OK;
}

rb_status rb_bem_ring_field_stress(const rb_bem_ring_field *field, rb_bem_points points,
                                   double *stress, rb_message *why)
{
    const double R = field->wheel.radius, rounding = 1e-6 * (R - field->wheel.inner);
    rb_status s = RB_OK;
    int stop = 0;

    for (int k = 0; k < points.n; k++) {
        const double x = points.xy[2 * k], y = points.xy[2 * k + 1], r = hypot(x, R - y),
                     depth = (2.0 * R * y - x * x - y * y) / (R + r);
        if (!(depth >= -rounding && depth <= R - field->wheel.inner + rounding))
            return rb_fail(why, RB_EINVAL, "point %d at (%g, %g) lies outside the cover", k, x, y);
    }
#pragma omp parallel for num_threads(rb_blas_loop_threads())                                       \
    schedule(static) if ((double)points.n * field->n > rb_pairs_for_threads)
    for (int k = 0; k < points.n; k++) {
        if (rb_interrupted_in_loop(&stop))
            continue;
        if (stress_at(field, points.xy[2 * k], points.xy[2 * k + 1], stress + 3 * k) != RB_OK)
#pragma omp atomic write
            s = RB_ENOMEM;
    }
    return stop ? RB_INTERRUPTED : s;
}
