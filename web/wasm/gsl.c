/* GSL for WebAssembly: the functions that rollbem's core calls, behind GSL's own headers.
 */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_interp.h>
#include <gsl/gsl_spline.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_multimin.h>
#include <gsl/gsl_sf_bessel.h>
#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_expint.h>
#include <gsl/gsl_sort.h>
#include <stdlib.h>
#include <string.h>

gsl_error_handler_t *gsl_set_error_handler_off(void)
{
    return NULL;
}

double gsl_pow_2(const double x)
{
    return x * x;
}

double gsl_pow_3(const double x)
{
    return x * x * x;
}

double gsl_pow_4(const double x)
{
    return gsl_pow_2(x * x);
}

double gsl_pow_int(double x, int n)
{
    double y = 1.0;
    for (int k = 0; k < abs(n); k++)
        y *= x;
    return n < 0 ? 1.0 / y : y;
}

/* ---- Vectors
 * --------------------------------------------------------------------------- */

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* rollbem sorts arrays without gaps. */
void gsl_sort(double *data, const size_t stride, const size_t n)
{
    if (stride == 1)
        qsort(data, n, sizeof *data, ascending);
}

/* By insertion: the places of a surface, which come nearly in order. */
void gsl_sort2(double *data1, const size_t stride1, double *data2, const size_t stride2,
               const size_t n)
{
    for (size_t i = 1; stride1 == 1 && stride2 == 1 && i < n; i++) {
        const double x = data1[i], y = data2[i];
        size_t k = i;
        for (; k > 0 && data1[k - 1] > x; k--) {
            data1[k] = data1[k - 1];
            data2[k] = data2[k - 1];
        }
        data1[k] = x;
        data2[k] = y;
    }
}

gsl_vector *gsl_vector_alloc(const size_t n)
{
    gsl_vector *v = calloc(1, sizeof *v);
    if (!v || !(v->data = calloc(n, sizeof *v->data))) {
        free(v);
        return NULL;
    }
    v->size = n;
    v->stride = 1;
    return v;
}

void gsl_vector_free(gsl_vector *v)
{
    if (v)
        free(v->data);
    free(v);
}

double gsl_vector_get(const gsl_vector *v, const size_t i)
{
    return v->data[i];
}

void gsl_vector_set(gsl_vector *v, const size_t i, double x)
{
    v->data[i] = x;
}

void gsl_vector_set_all(gsl_vector *v, double x)
{
    for (size_t i = 0; i < v->size; i++)
        v->data[i] = x;
}

/* ---- Minima: the simplex of Nelder and Mead, in two dimensions
 * ------------------------- */

static const gsl_multimin_fminimizer_type simplex2 = {"nmsimplex2", 0, NULL, NULL, NULL, NULL};
const gsl_multimin_fminimizer_type *gsl_multimin_fminimizer_nmsimplex2 = &simplex2;

typedef struct {
    double x[3][2], f[3];
    gsl_vector *trial;
} simplex;

void gsl_multimin_fminimizer_free(gsl_multimin_fminimizer *s)
{
    if (!s)
        return;
    if (s->state)
        gsl_vector_free(((simplex *)s->state)->trial);
    free(s->state);
    gsl_vector_free(s->x);
    free(s);
}

gsl_multimin_fminimizer *gsl_multimin_fminimizer_alloc(const gsl_multimin_fminimizer_type *T,
                                                       size_t n)
{
    gsl_multimin_fminimizer *s = calloc(1, sizeof *s);
    if (!s || n != 2)
        return free(s), NULL;
    simplex *m = calloc(1, sizeof *m);
    s->type = T;
    s->state = m;
    s->x = gsl_vector_alloc(2);
    if (m)
        m->trial = gsl_vector_alloc(2);
    if (m && m->trial && s->x)
        return s;
    gsl_multimin_fminimizer_free(s);
    return NULL;
}

static double value_at(gsl_multimin_fminimizer *s, const double x[2])
{
    simplex *m = s->state;
    m->trial->data[0] = x[0];
    m->trial->data[1] = x[1];
    return GSL_MULTIMIN_FN_EVAL(s->f, m->trial);
}

/* The best corner first; size: mean distance of the corners from their middle. */
static void order(gsl_multimin_fminimizer *s)
{
    simplex *m = s->state;
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2 - i; k++)
            if (m->f[k] > m->f[k + 1]) {
                const double f = m->f[k];
                double x[2];
                memcpy(x, m->x[k], sizeof x);
                m->f[k] = m->f[k + 1];
                memcpy(m->x[k], m->x[k + 1], sizeof x);
                m->f[k + 1] = f;
                memcpy(m->x[k + 1], x, sizeof x);
            }
    const double cx = (m->x[0][0] + m->x[1][0] + m->x[2][0]) / 3.0,
                 cy = (m->x[0][1] + m->x[1][1] + m->x[2][1]) / 3.0;
    s->size = 0.0;
    for (int k = 0; k < 3; k++)
        s->size += hypot(m->x[k][0] - cx, m->x[k][1] - cy) / 3.0;
    s->x->data[0] = m->x[0][0];
    s->x->data[1] = m->x[0][1];
    s->fval = m->f[0];
}

int gsl_multimin_fminimizer_set(gsl_multimin_fminimizer *s, gsl_multimin_function *f,
                                const gsl_vector *x, const gsl_vector *step)
{
    simplex *m = s->state;
    s->f = f;
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 2; i++)
            m->x[k][i] = x->data[i] + (k == i + 1 ? step->data[i] : 0.0);
        m->f[k] = value_at(s, m->x[k]);
    }
    order(s);
    return GSL_SUCCESS;
}

/* The worst corner moved along its line through the middle of the others. */
static double move_worst(gsl_multimin_fminimizer *s, double by, double x[2])
{
    simplex *m = s->state;
    for (int i = 0; i < 2; i++) {
        const double middle = 0.5 * (m->x[0][i] + m->x[1][i]);
        x[i] = middle + by * (middle - m->x[2][i]);
    }
    return value_at(s, x);
}

static void take(simplex *m, int k, const double x[2], double f)
{
    memcpy(m->x[k], x, 2 * sizeof *x);
    m->f[k] = f;
}

int gsl_multimin_fminimizer_iterate(gsl_multimin_fminimizer *s)
{
    simplex *m = s->state;
    double x[2], far[2];
    const double f = move_worst(s, 1.0, x);
    if (f < m->f[0]) {
        const double g = move_worst(s, 2.0, far);
        take(m, 2, g < f ? far : x, g < f ? g : f);
    } else if (f < m->f[1]) {
        take(m, 2, x, f);
    } else {
        const double g = move_worst(s, f < m->f[2] ? 0.5 : -0.5, far);
        if (g < fmin(f, m->f[2])) {
            take(m, 2, far, g);
        } else {
            for (int k = 1; k < 3; k++) {
                for (int i = 0; i < 2; i++)
                    m->x[k][i] = 0.5 * (m->x[k][i] + m->x[0][i]);
                m->f[k] = value_at(s, m->x[k]);
            }
        }
    }
    order(s);
    return GSL_SUCCESS;
}

double gsl_multimin_fminimizer_size(const gsl_multimin_fminimizer *s)
{
    return s->size;
}

gsl_vector *gsl_multimin_fminimizer_x(const gsl_multimin_fminimizer *s)
{
    return s->x;
}

double gsl_multimin_fminimizer_minimum(const gsl_multimin_fminimizer *s)
{
    return s->fval;
}

/* ---- Modified Bessel functions --------------------------------------------------------
 */

/* exp(x) K_order(x) = int_0^inf exp(-x (cosh t - 1)) cosh(order t) dt by the trapezoidal
 * rule, which is exact to rounding at this step: the integrand is analytic for |Im t| <
 * pi/2. */
static double scaled_k(double x, double order)
{
    const double step = 0.125 / sqrt(1.0 + x / 16.0); /* the integrand gets as narrow */
    double sum = 0.5, growth = 0.0;

    for (int k = 1; growth < 60.0 && k < 8000; k++) {
        growth = 2.0 * x * gsl_pow_2(sinh(0.5 * step * k));
        sum += exp(-growth) * cosh(order * step * k);
    }
    return step * sum;
}

double gsl_sf_bessel_K0_scaled(const double x)
{
    return scaled_k(x, 0.0);
}

double gsl_sf_bessel_K1_scaled(const double x)
{
    return scaled_k(x, 1.0);
}

/* ---- Complete elliptic integrals ------------------------------------------------------ */

/* By the arithmetic-geometric mean of 1 and sqrt(1 - k^2). */
double gsl_sf_ellint_Kcomp(double k, gsl_mode_t mode)
{
    (void)mode;
    double a = 1.0, b = sqrt((1.0 - k) * (1.0 + k));
    while (fabs(a - b) > 1e-15 * a) {
        const double mean = 0.5 * (a + b);
        b = sqrt(a * b);
        a = mean;
    }
    return M_PI / (2.0 * a);
}

/* Carlson's R_D: each duplication brings x, y, z four times closer together, and a series in
 * their differences, whose first missing term is of the sixth power, gives the rest. */
double gsl_sf_ellint_RD(double x, double y, double z, gsl_mode_t mode)
{
    (void)mode;
    double sum = 0.0, power = 1.0, mean = 0.2 * (x + y + 3.0 * z);
    while (fmax(fabs(mean - x), fmax(fabs(mean - y), fabs(mean - z))) > 1e-3 * mean) {
        const double l = sqrt(x * y) + sqrt(y * z) + sqrt(z * x);
        sum += power / (sqrt(z) * (z + l));
        power *= 0.25;
        x = 0.25 * (x + l);
        y = 0.25 * (y + l);
        z = 0.25 * (z + l);
        mean = 0.2 * (x + y + 3.0 * z);
    }
    const double dx = (mean - x) / mean, dy = (mean - y) / mean, dz = -(dx + dy) / 3.0;
    const double xy = dx * dy, zz = dz * dz;
    const double e2 = xy - 6.0 * zz, e3 = (3.0 * xy - 8.0 * zz) * dz, e4 = 3.0 * (xy - zz) * zz,
                 e5 = xy * dz * zz;
    const double series = 1.0 - 3.0 * e2 / 14.0 + e3 / 6.0 + 9.0 * e2 * e2 / 88.0 -
                          3.0 * e4 / 22.0 - 9.0 * e2 * e3 / 52.0 + 3.0 * e5 / 26.0;
    return 3.0 * sum + power * series / (mean * sqrt(mean));
}

/* ---- Gauss's rule: roots of Legendre's polynomial by Newton
 * ---------------------------- */

gsl_integration_glfixed_table *gsl_integration_glfixed_table_alloc(size_t n)
{
    gsl_integration_glfixed_table *t = calloc(1, sizeof *t);
    if (!t)
        return NULL;
    t->n = n;
    t->x = calloc(n, sizeof *t->x);
    t->w = calloc(n, sizeof *t->w);
    if (!t->x || !t->w) {
        gsl_integration_glfixed_table_free(t);
        return NULL;
    }
    for (size_t i = 0; i < n; i++) {
        double x = -cos(M_PI * ((double)i + 0.75) / ((double)n + 0.5)), slope = 1.0;
        for (int step = 0; step < 8; step++) {
            double p = 1.0, before = 0.0;
            for (size_t k = 1; k <= n; k++) {
                const double next =
                    ((2.0 * (double)k - 1.0) * x * p - ((double)k - 1.0) * before) / (double)k;
                before = p;
                p = next;
            }
            slope = (double)n * (x * p - before) / (x * x - 1.0);
            x -= p / slope;
        }
        t->x[i] = x;
        t->w[i] = 2.0 / ((1.0 - x * x) * slope * slope);
    }
    return t;
}

void gsl_integration_glfixed_table_free(gsl_integration_glfixed_table *t)
{
    if (!t)
        return;
    free(t->x);
    free(t->w);
    free(t);
}

int gsl_integration_glfixed_point(double a, double b, size_t i, double *xi, double *wi,
                                  const gsl_integration_glfixed_table *t)
{
    *xi = 0.5 * (a + b) + 0.5 * (b - a) * t->x[i];
    *wi = 0.5 * (b - a) * t->w[i];
    return GSL_SUCCESS;
}

/* ---- Exponential integrals
 * ------------------------------------------------------------- */

/* sum over k >= 1 of x^k/(k k!). */
static double power_series(double x)
{
    double term = 1.0, sum = 0.0;
    for (int k = 1; k < 200; k++) {
        term *= x / k;
        sum += term / k;
        if (fabs(term) < 1e-17 * fabs(sum))
            break;
    }
    return sum;
}

/* exp(x) E1(x), x > 0: the series below 1, Lentz's continued fraction beyond. */
int gsl_sf_expint_E1_scaled_e(const double x, gsl_sf_result *result)
{
    if (x <= 1.0) {
        result->val = exp(x) * (-M_EULER - log(x) - power_series(-x));
    } else {
        double b = x + 1.0, c = 1e300, d = 1.0 / b, h = d;
        for (int i = 1; i < 2000; i++) {
            const double a = -(double)i * i;
            b += 2.0;
            d = 1.0 / (a * d + b);
            c = b + a / c;
            h *= c * d;
            if (fabs(c * d - 1.0) < 1e-16)
                break;
        }
        result->val = h;
    }
    result->err = 4e-16 * fabs(result->val);
    return GSL_SUCCESS;
}

/* exp(-x) Ei(x), x > 0: the series below 40, the asymptotic one beyond. */
int gsl_sf_expint_Ei_scaled_e(const double x, gsl_sf_result *result)
{
    if (x < 40.0) {
        result->val = exp(-x) * (M_EULER + log(x) + power_series(x));
    } else {
        double term = 1.0, sum = 1.0;
        for (int k = 1; k < x && term > 1e-17; k++) {
            term *= k / x;
            sum += term;
        }
        result->val = sum / x;
    }
    result->err = 4e-16 * fabs(result->val);
    return GSL_SUCCESS;
}

/* ---- Interpolation: the interval that holds x -----------------------------------------
 */

size_t gsl_interp_bsearch(const double x_array[], double x, size_t index_lo, size_t index_hi)
{
    while (index_hi > index_lo + 1) {
        const size_t middle = (index_lo + index_hi) / 2;
        if (x_array[middle] > x)
            index_hi = middle;
        else
            index_lo = middle;
    }
    return index_lo;
}

/* ---- Natural cubic splines ----------------------------------------------------------
 * The second derivatives m stand behind the n values: y has 2n numbers. */

static const gsl_interp_type natural = {.name = "cspline"};
const gsl_interp_type *gsl_interp_cspline = &natural;

gsl_spline *gsl_spline_alloc(const gsl_interp_type *type, size_t n)
{
    gsl_spline *s = malloc(sizeof *s);
    double *room = malloc(3 * n * sizeof *room);
    (void)type;
    if (!s || !room || n < 2) {
        free(room);
        free(s);
        return NULL;
    }
    *s = (gsl_spline){.x = room, .y = room + n, .size = n};
    return s;
}

/* Elimination of the tridiagonal system of m; what is left of its diagonal needs no room,
 * since it is 2 (h_before + h) less the square of h_before over the one before. */
int gsl_spline_init(gsl_spline *s, const double x[], const double y[], size_t n)
{
    double *m = s->y + n, diagonal = 0.0;
    double *factor = malloc(n * sizeof *factor);
    if (!factor)
        return GSL_ENOMEM;
    memcpy(s->x, x, n * sizeof *x);
    memcpy(s->y, y, n * sizeof *y);
    m[0] = m[n - 1] = factor[0] = 0.0;
    for (size_t i = 1; i + 1 < n; i++) {
        const double before = x[i] - x[i - 1], h = x[i + 1] - x[i];
        const double right = 6.0 * ((y[i + 1] - y[i]) / h - (y[i] - y[i - 1]) / before);
        diagonal = 2.0 * (before + h) - before * factor[i - 1];
        factor[i] = h / diagonal;
        m[i] = (right - before * m[i - 1]) / diagonal;
    }
    for (size_t i = n - 1; i-- > 1;)
        m[i] -= factor[i] * m[i + 1];
    free(factor);
    return GSL_SUCCESS;
}

double gsl_spline_eval(const gsl_spline *s, double x, gsl_interp_accel *accel)
{
    const size_t i = gsl_interp_bsearch(s->x, x, 0, s->size - 1);
    const double h = s->x[i + 1] - s->x[i], *m = s->y + s->size;
    const double b = (x - s->x[i]) / h, a = 1.0 - b;
    (void)accel;
    return a * s->y[i] + b * s->y[i + 1] +
           h * h / 6.0 * ((a * a * a - a) * m[i] + (b * b * b - b) * m[i + 1]);
}

/* From the left end of interval i to x in it. */
static double spline_area(const gsl_spline *s, size_t i, double x)
{
    const double h = s->x[i + 1] - s->x[i], *m = s->y + s->size;
    const double b = (x - s->x[i]) / h, a = 1.0 - b, bb = b * b, aa = a * a;
    return 0.5 * h * ((1.0 - aa) * s->y[i] + bb * s->y[i + 1]) -
           h * h * h / 24.0 * ((1.0 - 2.0 * aa + aa * aa) * m[i] + (2.0 * bb - bb * bb) * m[i + 1]);
}

double gsl_spline_eval_integ(const gsl_spline *s, double a, double b, gsl_interp_accel *accel)
{
    const size_t first = gsl_interp_bsearch(s->x, a, 0, s->size - 1),
                 last = gsl_interp_bsearch(s->x, b, 0, s->size - 1);
    double sum = spline_area(s, last, b) - spline_area(s, first, a);
    (void)accel;
    for (size_t i = first; i < last; i++)
        sum += spline_area(s, i, s->x[i + 1]);
    return sum;
}

void gsl_spline_free(gsl_spline *s)
{
    if (s)
        free(s->x);
    free(s);
}

/* The searches above need none; NULL would mean no memory. */
gsl_interp_accel *gsl_interp_accel_alloc(void)
{
    return malloc(sizeof(gsl_interp_accel));
}

void gsl_interp_accel_free(gsl_interp_accel *accel)
{
    free(accel);
}
