/* Hysteresis computed independently (theory-bodies.md V4, V8): the tractions are decomposed into
 * waves, and the loss of each wave follows from the imaginary part of its compliance.
 * The library computes the loss from matrices and from differences along the contact,
 * which are not used here. */
#include "program/certificate/internal.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>

typedef double complex cplx;

/* Whose loss it is. */
typedef struct {
    const rb_rolling_model *model;
    const rb_rolling_solution *s;
} contact;

/* Displacements (w_N, w_T) under waves exp(im theta) of (p, q), R/(2 G) times
 * (N p - i C q, T q + i C p). */
typedef struct {
    cplx N, C, T;
} compliance;

/* Its derivative by ln r in a ring of Poisson's ratio nu, over 1/(2 G): equilibrium and
 * Hooke's law in polar coordinates, a Riccati equation. */
static compliance slope(double m, double nu, compliance K)
{
    const double a = nu / (1.0 - nu), c = 1.0 / (1.0 - nu);
    const cplx radial = K.N + m * K.C, hoop = K.C + m * K.T;

    return (compliance){1.0 - a - (2.0 * a + c * radial) * radial,
                        K.C + m * K.N - (a + c * radial) * hoop,
                        2.0 + 2.0 * K.T + 2.0 * m * K.C - c * hoop * hoop};
}

static compliance plus(compliance K, double step, compliance d)
{
    return (compliance){K.N + step * d.N, K.C + step * d.C, K.T + step * d.T};
}

/* What a ring makes of the compliance K of its inner contour (Runge and Kutta), by steps
 * of a quarter of 1/rate: the softer the core, the faster K changes above it. */
static compliance across(double m, double nu, double thickness, compliance K)
{
    double left = thickness;

    while (left > 0.0) {
        const double rate =
            (m + 1.0) * (1.0 + (cabs(K.N + m * K.C) + cabs(K.C + m * K.T)) / (1.0 - nu));
        const double h = fmin(left, 0.25 / rate);
        const compliance k1 = slope(m, nu, K), k2 = slope(m, nu, plus(K, 0.5 * h, k1)),
                         k3 = slope(m, nu, plus(K, 0.5 * h, k2)), k4 = slope(m, nu, plus(K, h, k3));
        K = plus(plus(plus(plus(K, h / 6.0, k1), h / 3.0, k2), h / 3.0, k3), h / 6.0, k4);
        left = h < left ? left - h : 0.0;
    }
    return K;
}

/* Of a whole disc, m > 1. */
static compliance of_disc(double m, double nu)
{
    const double outer = 0.5 * (3.0 - 4.0 * nu) / (m + 1.0), inner = 0.5 / (m - 1.0);
    return (compliance){outer + inner, outer - inner, outer + inner};
}

/* ln(outer/inner) of the rings of a body; a depth that no wave reaches where there is no
 * inner contour.  A half-plane is a disc of so large a radius that it is flat. */
typedef struct {
    double radius;
    rb_bem_material material, core;
    double own, below; /* below = 0: a rigid core */
    const rb_rolling_memory *memory;
    double speed;
} body;

static compliance answer(const body *b, double m)
{
    static const double reach = 20.0; /* exp(-2 reach) is left of what lies deeper */
    compliance K = {0.0, 0.0, 0.0};
    cplx softer = 1.0;

    for (int k = 0; k < b->memory->n; k++)
        softer += b->memory->ratio[k] / (1.0 - I * (m / b->radius * b->speed * b->memory->time[k]));
    if (m * b->own > reach) {
        K = of_disc(m, b->material.poisson);
    } else {
        if (b->below > 0.0) {
            const double depth = fmin(b->below, reach / m);
            if (depth < b->below)
                K = of_disc(m, b->core.poisson);
            K = across(m, b->core.poisson, depth, K);
        }
        const cplx stiffer = b->material.shear / (b->core.shear * softer);
        if (b->below > 0.0)
            K = (compliance){stiffer * K.N, stiffer * K.C, stiffer * K.T};
        K = across(m, b->material.poisson, b->own, K);
    }
    return (compliance){softer * K.N, softer * K.C, softer * K.T};
}

/* width: of the table, which no wave that matters is longer than a million times. */
static body body_of(const rb_rolling_case *rc, const rb_rolling_body *of, double width)
{
    static const double flat = 1e8, deep = 100.0;
    body b = {.material = rb_rolling_material(rc, of),
              .memory = &of->memory,
              .speed = rc->speed,
              .core = rb_bem_material_in_plane(
                  rc->plane, of->cover > 0.0 ? of->core_young : of->base_young,
                  of->cover > 0.0 ? of->core_poisson : of->base_poisson)};
    if (of->support == RB_BEM_HUB) {
        b.radius = of->radius;
        b.own = of->cover > 0.0 ? -log1p(-of->cover / of->radius) : -log(of->hub_ratio);
        if (of->cover > 0.0 && of->core_young > 0.0)
            b.below = -log(of->hub_ratio) - b.own;
    } else {
        b.radius = flat * fmax(of->layer, width);
        b.own = of->layer > 0.0 ? of->layer / b.radius : deep;
        b.below = of->layer > 0.0 && of->base_young > 0.0 ? deep : 0.0;
    }
    return b;
}

/* Waves computed at once, each the next one of its own: one alone would wait for every product. */
enum { WAVES = 5 };

/* Per length of wave number k = m/R: Im of conj(p, q) times m/R (w_N, w_T), over pi.  On what
 * is flat, an element as wide as the one before has that one's wave, turned on. */
static void losses(const contact *c, const body *b, int is_b, const double m[WAVES],
                   double loss[WAVES])
{
    const rb_rolling_model *model = c->model;
    const double *x = c->s->x, *h = c->s->h, mirror = is_b ? -1.0 : 1.0;
    const int turns = (is_b ? model->rc->b : model->rc->a).support == RB_BEM_HUB;
    enum { AFRESH = 32 }; /* elements, behind which roundings no longer add up */
    double wave[2][WAVES], turn[2][WAVES], p[2][WAVES] = {{0}}, q[2][WAVES] = {{0}};
    int run = 0; /* elements since the waves were computed; 0: the one before carries nothing */

    for (int i = 0; i < c->s->n; i++) {
        const double P = model->state.p[i], Q = mirror * model->state.q[i];
        if (P == 0.0 && Q == 0.0) {
            run = 0;
            continue;
        }
        const double sine = turns ? x[i] / b->radius : 0.0;
        const double at = turns ? b->radius * asin(sine) : x[i];
        const int given = model->rc->normals == RB_BEM_NORMALS_SURFACE;
        const double cosine = given ? 1.0 : sqrt(1.0 - sine * sine), turned = given ? 0.0 : sine;
        const double radial = P * cosine - Q * turned, tangential = Q * cosine + P * turned;
        const int turns_on =
            !turns && run > 0 && run < AFRESH && fabs(h[i] - h[i - 1]) < 1e-12 * h[i];
        for (int j = 0; j < WAVES && !(turns_on && run > 1); j++) {
            const double k = m[j] / b->radius, half = 0.5 * k * h[i],
                         mean = h[i] * (half > 1e-8 ? sin(half) / half : 1.0);
            if (turns_on) {
                turn[0][j] = cos(k * h[i]);
                turn[1][j] = -sin(k * h[i]);
            } else {
                wave[0][j] = mean * cos(k * at);
                wave[1][j] = -mean * sin(k * at);
            }
        }
        for (int j = 0; j < WAVES && turns_on; j++) {
            const double re = wave[0][j];
            wave[0][j] = re * turn[0][j] - wave[1][j] * turn[1][j];
            wave[1][j] = re * turn[1][j] + wave[1][j] * turn[0][j];
        }
        run = turns_on ? run + 1 : 1;
        for (int part = 0; part < 2; part++)
            for (int j = 0; j < WAVES; j++) {
                p[part][j] += radial * wave[part][j];
                q[part][j] += tangential * wave[part][j];
            }
    }
    for (int j = 0; j < WAVES; j++) {
        const compliance K = answer(b, m[j]);
        loss[j] = m[j] / (2.0 * acos(-1.0) * b->material.shear) *
                  (cimag(K.N) * (p[0][j] * p[0][j] + p[1][j] * p[1][j]) +
                   cimag(K.T) * (q[0][j] * q[0][j] + q[1][j] * q[1][j]) +
                   2.0 * cimag(K.C) * (p[0][j] * q[1][j] - p[1][j] * q[0][j]));
    }
}

/* unresolved: the part of the waves that are shorter than four elements, where a traction
 * that is constant over each of them is no longer that of the contact. */
static double lost_in(const contact *c, const body *b, int is_b, double longest, double *unresolved)
{
    /* Gauss and Legendre, five points */
    static const double at[3] = {0.0, 0.5384693101056831, 0.9061798459386640},
                        weight[3] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
    const int n = c->s->n;
    const double width = c->s->x[n - 1] - c->s->x[0], widest = acos(-1.0) / width;
    const double last = 16.0 * acos(-1.0) * n / width;
    const int is_wheel = (is_b ? c->model->rc->b : c->model->rc->a).support == RB_BEM_HUB;
    const double shortest = 0.5 * acos(-1.0) / longest;
    double sum = 0.0, from = 1e-6 / width, m[WAVES], loss[WAVES];

    if (is_wheel) { /* long waves one by one, short ones as a whole */
        enum { LONG = 8 * WAVES };
        for (int first = 1; first <= LONG; first += WAVES) {
            for (int j = 0; j < WAVES; j++)
                m[j] = first + j;
            losses(c, b, is_b, m, loss);
            for (int j = 0; j < WAVES; j++)
                sum += loss[j] / b->radius;
        }
        from = (LONG + 0.5) / b->radius;
    }
    while (from < last) {
        const double step = fmin(widest, from), middle = from + 0.5 * step;
        for (int i = -2; i <= 2; i++)
            m[i + 2] = b->radius * (middle + copysign(at[abs(i)], i) * 0.5 * step);
        losses(c, b, is_b, m, loss);
        for (int i = -2; i <= 2; i++) {
            const double one = 0.5 * step * weight[abs(i)] * loss[i + 2];
            sum += one;
            *unresolved += m[i + 2] / b->radius > shortest ? fabs(one) : 0.0;
        }
        from += step;
    }
    return sum;
}

/* -int p w' dx by differences between the neighbours at `reach` elements; the elements at
 * the ends carry nothing. */
static double work_by_differences(const rb_rolling_solution *s, const double *p, const double *w,
                                  int reach)
{
    double work = 0.0;

    for (int i = reach; i + reach < s->n; i++) {
        const double left = s->x[i] - s->x[i - reach], right = s->x[i + reach] - s->x[i];
        const double before = (w[i] - w[i - reach]) / left, after = (w[i + reach] - w[i]) / right;
        work -= p[i] * s->h[i] * (right * before + left * after) / (left + right);
    }
    return work;
}

/* -int q w_T' dx by the differences that the slip is made of, which look upstream. */
static double work_by_slip(const contact *c)
{
    const rb_contact_state *state = &c->model->state;
    const rb_contact_problem *problem = &c->model->problem;
    const rb_rolling_solution *s = c->s;
    double work = 0.0;

    for (int i = 0; i < s->n; i++) {
        const double strain = state->lambda[i] / problem->e_T[i] - state->xi;
        const double next = i + 1 < s->n ? state->q[i + 1] : 0.0;
        work -= s->slip_operator == RB_SLIP_UPSTREAM
                    ? strain * problem->e_T[i] * 0.5 * (state->q[i] + next)
                    : strain * s->h[i] * state->q[i];
    }
    return work;
}

/* What differences along half-planes miss.  They are taken of the whole displacement, of
 * which the elastic part costs nothing in truth.  Twice the distance between the points
 * changes them by three times their error, which is of second order.  Of friction the
 * differences that look upstream, of first order where slip begins, stand beside them. */
static rb_status missed_by_differences(const contact *c, double *missed)
{
    const rb_contact_state *state = &c->model->state;
    const int m = c->model->bodies.f.m;
    double *w = rb_alloc(2 * (size_t)m, 1);
    const rb_status s =
        w ? rb_rolling_displacement(&c->model->bodies, state->p, state->q, w) : RB_ENOMEM;

    if (s == RB_OK) {
        const double friction = work_by_differences(c->s, state->q, w + m, 1);
        *missed = fabs(work_by_differences(c->s, state->p, w, 1) -
                       work_by_differences(c->s, state->p, w, 2)) +
                  fabs(friction - work_by_differences(c->s, state->q, w + m, 2)) +
                  fabs(friction - work_by_slip(c));
    }
    free(w);
    return s;
}

/* Differences along the contact miss two squares of the longest element over half the
 * contact's width at most, and on equal elements, in one of which the contact ends, a
 * part of it; waves that the elements do not resolve up to two times what these lose
 * (tests/test_certificates.c). */
rb_status rb_certificate_hysteresis(const rb_rolling_model *model, const rb_rolling_solution *s,
                                    double *power, double *allowed)
{
    const contact whole = {model, s}, *c = &whole;
    const rb_rolling_case *rc = c->model->rc;
    const rb_rolling_body *const bodies[] = {&rc->a, &rc->b};
    const double width = s->x[s->n - 1] - s->x[0];
    double sum = 0.0, unresolved = 0.0, longest = 0.0;

    for (int i = 0; i < s->n; i++)
        if (c->model->state.p[i] > 0.0)
            longest = fmax(longest, s->h[i]);
    for (int b = 0; b < 1 + rc->elastic_b; b++) {
        if (bodies[b]->memory.n > 0) {
            const body of = body_of(rc, bodies[b], width);
            sum += lost_in(c, &of, b, longest, &unresolved);
        }
    }
    const int fitted = rb_rolling_mesh_is_graded(rc) && !c->model->equal_instead;
    const double share = longest / s->half_width;
    const double missed = 2.0 * share * share + (fitted ? 0.0 : 0.06 * share);
    double differences = 0.0;
    const rb_status status =
        rb_rolling_can(rc, RB_BODY_FLAT) ? missed_by_differences(c, &differences) : RB_OK;
    *allowed = fabs(sum) * missed + differences + 3.0 * unresolved + 1e-12 * s->normal_load;
    *power = sum;
    return status;
}
