/* Fading memory of a wheel in steady rolling (V8).  A particle meets the contact once per
 * turn, so that E averages along the circumference, and waves exp(im theta) of the
 * elastic answer are multiplied by 1/(1 - i m L/R) as those of the half-plane are.  The
 * answer of a wheel is split into that of the disc, which is known in closed form, and
 * what its inner contour changes of it, which only long waves feel. */
#include "bem/internal.h"

#include <complex.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_spline.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef double complex cplx;

/* ---- Waves on rings ---------------------------------------------------------------- */

/* u_r = U cos m theta, u_theta = V sin m theta, and stresses S and T of an arc alike.  In
 * ln r the equations for y = (2 G U, 2 G V, r S, r T) have constant coefficients. */

/* (u, v) = K (s, t). */
typedef struct {
    cplx uu, uv, vu, vv;
} compliance;

enum { TERMS = 20 }; /* of the exponential series, of matrices with a norm of about 2 */
/* The product of wave number and thickness ln(R/r) from which on an inner contour is out
 * of reach: its trace falls like exp(-2 x). */
static const double REACH = 20.0;

/* E = exp(M step), row by row. */
static void transfer(int m, double nu, double step, double E[4][4])
{
    const double a = nu / (1.0 - nu), c = 1.0 / (1.0 - nu);
    const double M[4][4] = {{-a, -a * m, 1.0 - a, 0.0},
                            {m, 1.0, 0.0, 2.0},
                            {c, c * m, a, -m},
                            {c * m, c * m * m, a * m, -1.0}};
    double power[4][4] = {{1.0, 0, 0, 0}, {0, 1.0, 0, 0}, {0, 0, 1.0, 0}, {0, 0, 0, 1.0}};

    memcpy(E, power, sizeof power);
    for (int k = 1; k <= TERMS; k++) {
        double next[4][4] = {{0.0}};
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++)
                for (int l = 0; l < 4; l++)
                    next[i][j] += power[i][l] * M[l][j] * step / k;
        memcpy(power, next, sizeof power);
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++)
                E[i][j] += power[i][j];
    }
}

/* From the inner contour of a ring, with compliance K, to its outer one. */
static compliance across(int m, double nu, double inner, double outer, compliance K)
{
    const double thickness = log(outer / inner);
    const int steps = (int)ceil(fmax(1.0, (m + 1) * thickness / 0.25));
    double E[4][4];

    transfer(m, nu, thickness / steps, E);
    for (int k = 0; k < steps; k++) {
        cplx D[2][2], S[2][2];
        for (int i = 0; i < 2; i++) {
            D[i][0] = E[i][0] * K.uu + E[i][1] * K.vu + E[i][2];
            D[i][1] = E[i][0] * K.uv + E[i][1] * K.vv + E[i][3];
            S[i][0] = E[i + 2][0] * K.uu + E[i + 2][1] * K.vu + E[i + 2][2];
            S[i][1] = E[i + 2][0] * K.uv + E[i + 2][1] * K.vv + E[i + 2][3];
        }
        const cplx det = S[0][0] * S[1][1] - S[0][1] * S[1][0];
        /* without the care of C11's quotients, which numbers of this size do not need */
        const cplx per_det = conj(det) / (gsl_pow_2(creal(det)) + gsl_pow_2(cimag(det)));
        K = (compliance){(D[0][0] * S[1][1] - D[0][1] * S[1][0]) * per_det,
                         (D[0][1] * S[0][0] - D[0][0] * S[0][1]) * per_det,
                         (D[1][0] * S[1][1] - D[1][1] * S[1][0]) * per_det,
                         (D[1][1] * S[0][0] - D[1][0] * S[0][1]) * per_det};
    }
    return K;
}

/* The disc, m >= 2. */
static compliance of_disc(int m, double kappa)
{
    const double outer = 0.5 * kappa / (m + 1), inner = 0.5 / (m - 1);
    return (compliance){outer + inner, outer - inner, outer - inner, outer + inner};
}

/* What the inner contour rests on, over its own 2 G: an elastic core, or nothing that
 * yields. */
static compliance of_core(const rb_bem_wheel *w, int m)
{
    const compliance rigid = {0.0, 0.0, 0.0, 0.0};

    return w->hub > 0.0 ? across(m, w->core.poisson, w->hub, w->inner, rigid) : rigid;
}

/* What memory, which makes the material `softer` than the glassy one, adds to the wheel,
 * over the glassy 2 G.  On a rigid core all of it is softer by that. */
static compliance added_by_memory(const rb_bem_wheel *w, int m, cplx softer)
{
    const double nu = w->material.poisson;
    const compliance core = of_core(w, m);
    compliance own = {0.0, 0.0, 0.0, 0.0}, slow = own;

    if (w->hub > 0.0) {
        const double over = w->material.shear / w->core.shear;
        const cplx r = over / softer;
        own =
            (compliance){over * core.uu, over * core.uv, over * core.vu, over * core.vv};
        slow = (compliance){r * core.uu, r * core.uv, r * core.vu, r * core.vv};
    }
    own = across(m, nu, w->inner, w->radius, own);
    slow = w->hub > 0.0 ? across(m, nu, w->inner, w->radius, slow) : own;
    return (compliance){softer * slow.uu - own.uu, softer * slow.uv - own.uv,
                        softer * slow.vu - own.vu, softer * slow.vv - own.vv};
}

/* 1 + sum f_k/(1 - i m L_k/R). */
static cplx creep(const rb_bem_wheel *w, int m)
{
    cplx c = 1.0;
    for (int k = 0; k < w->terms; k++)
        c += w->ratio[k] / (1.0 - I * (m * w->length[k] / w->radius));
    return c;
}

/* ---- The kernel -------------------------------------------------------------------- */

/* A unit load at angle 0 seen at angle x, over R/(4 pi G): normal and tangential answer,
 * and the normal one of friction, which is minus the tangential one of pressure. */

typedef struct {
    double N, T, C;
} answer;

/* What the disc, its waves m >= 2, has over the half-plane whose datum is R:
 * with l = -ln(1 - exp(ix)) the disc's answers are N = Re(kappa A + B) and
 * C = Im(kappa A - B), A = exp(-ix) l - 1 - exp(ix)/2, B = exp(ix) l. */
static answer disc_over_halfplane(double kappa, double x)
{
    if (x == 0.0)
        return (answer){-1.5 * kappa, -1.5 * kappa, 0.0};
    const double sign = copysign(1.0, x), chord = 2.0 * sin(0.5 * fabs(x)),
                 turn = 0.5 * (M_PI * sign - x);       /* Im l */
    const double less = 2.0 * gsl_pow_2(sin(0.5 * x)); /* 1 - cos x */
    const double N = (kappa + 1.0) * (log(fabs(x) / chord) + less * log(chord)) +
                     (kappa - 1.0) * sin(x) * turn - kappa * (1.0 + 0.5 * cos(x));
    const double C = -(kappa - 1.0) * (less * turn + 0.5 * x) +
                     sin(x) * ((kappa + 1.0) * log(chord) - 0.5 * kappa);
    return (answer){N, N, C};
}

/* The elastic half-plane's average over what lies upstream of angle x, one term. */
static answer halfplane_average(const rb_bem_wheel *w, int term, double x)
{
    static const double one = 1.0;
    const double h = 1e-2 * w->radius, at = x * w->radius, ends[2] = {-0.5 * h, 0.5 * h};
    rb_bem_surface plane = rb_bem_halfplane(w->material, w->radius);
    double own[4], slow[4];

    rb_bem_surface_displacement(&plane, 1, ends, 1, &at, own);
    plane.terms = 1;
    plane.ratio = &one;
    plane.length = w->length + term;
    rb_bem_surface_displacement(&plane, 1, ends, 1, &at, slow);
    const double scale = 4.0 * M_PI * w->material.shear / h;
    return (answer){scale * (slow[0] - own[0]), scale * (slow[3] - own[3]),
                    scale * (slow[2] - own[2])};
}

/* Angles x from -pi to pi; those from `first` on, `count` of them, are equally far from
 * each other and reach over the contact. */
typedef struct {
    int nodes, first, count;
    double *x;
    double *N, *T, *C; /* count each: what memory adds beside the half-plane's part */
    gsl_spline *spline[3];
    gsl_interp_accel *near;
} table;

static void table_free(table *t)
{
    free(t->x);
    free(t->N);
    for (int k = 0; k < 3; k++)
        gsl_spline_free(t->spline[k]);
    gsl_interp_accel_free(t->near);
}

/* Equal steps to +-reach, growing ones from there to +-pi. */
static rb_status table_alloc(double reach, double step, table *t)
{
    enum { OUTSIDE = 1500, LEAST = 400, MOST = 20000 };
    const int half = (int)fmin(fmax(ceil(reach / step), LEAST), MOST);

    memset(t, 0, sizeof *t);
    t->first = OUTSIDE;
    t->count = 2 * half + 1;
    t->nodes = t->count + 2 * OUTSIDE;
    t->x = rb_alloc((size_t)t->nodes, 1);
    t->N = rb_alloc((size_t)t->count, 3);
    t->near = gsl_interp_accel_alloc();
    if (!t->x || !t->N || !t->near)
        return RB_ENOMEM;
    t->T = t->N + t->count;
    t->C = t->T + t->count;
    const int middle = OUTSIDE + half;
    for (int i = 0; i <= half + OUTSIDE; i++) {
        const double x = i <= half
                             ? reach * i / half
                             : reach * pow(M_PI / reach, (i - half) / (double)OUTSIDE);
        t->x[middle + i] = x;
        t->x[middle - i] = -x;
    }
    return RB_OK;
}

/* Adds one term of the disc's memory.  From x to pi upstream the disc's answer is the
 * half-plane's and a rest that is linear between the nodes; what lies beyond pi fades as
 * a whole, and one turn brings it back. */
static void add_disc(const rb_bem_wheel *w, int term, table *t)
{
    const double kappa = 3.0 - 4.0 * w->material.poisson, f = w->ratio[term],
                 length = w->length[term] / w->radius;
    const answer ahead = halfplane_average(w, term, M_PI),
                 behind = halfplane_average(w, term, -M_PI);
    const double turn = exp(-2.0 * M_PI / length), rest = -expm1(-2.0 * M_PI / length);
    answer sum = {0.0, 0.0, 0.0}, beyond = sum;

    for (int round = 0; round < 2; round++) {
        answer next = disc_over_halfplane(kappa, M_PI);
        sum = beyond;
        for (int i = t->nodes - 2; i >= 0; i--) {
            const rb_bem_fading step = rb_bem_fading_over(length, t->x[i + 1] - t->x[i]);
            const answer own = disc_over_halfplane(kappa, t->x[i]);
            sum.N = step.kept * sum.N + step.before * next.N + step.after * own.N;
            sum.C = step.kept * sum.C + step.before * next.C + step.after * own.C;
            next = own;
            const int at = i - t->first;
            if (round == 1 && at >= 0 && at < t->count) {
                t->N[at] += f * sum.N;
                t->T[at] += f * sum.N;
                t->C[at] += f * sum.C;
            }
        }
        if (round == 0) /* the average at pi is that at -pi */
            beyond = (answer){.N = (behind.N - turn * ahead.N + sum.N) / rest - ahead.N,
                              .C = (behind.C - turn * ahead.C + sum.C) / rest - ahead.C};
    }
}

/* Adds what memory makes of the inner contour's part, and of the waves 0 and 1: a
 * polynomial in exp(ix), by Horner's scheme. */
static rb_status add_inner(const rb_bem_wheel *w, table *t)
{
    const double kappa = 3.0 - 4.0 * w->material.poisson;
    const int last = 2 + (int)ceil(REACH / log(w->radius / w->inner));
    cplx(*factor)[3] = calloc((size_t)last + 1, sizeof *factor);

    if (!factor)
        return RB_ENOMEM;
    for (int m = 0; m <= last; m++) {
        const cplx softer = creep(w, m);
        const compliance added = added_by_memory(w, m, softer),
                         disc =
                             m < 2 ? (compliance){0.0, 0.0, 0.0, 0.0} : of_disc(m, kappa);
        const double twice = m > 0 ? 2.0 : 1.0;
        factor[m][0] = twice * (added.uu - (softer - 1.0) * disc.uu);
        factor[m][1] = twice * (added.vv - (softer - 1.0) * disc.vv);
        factor[m][2] = twice * (added.uv - (softer - 1.0) * disc.uv);
    }
    for (int i = 0; i < t->count; i++) {
        const cplx z = cexp(I * t->x[t->first + i]);
        cplx N = 0.0, T = 0.0, C = 0.0;
        for (int m = last; m >= 0; m--) {
            N = N * z + factor[m][0];
            T = T * z + factor[m][1];
            C = C * z + factor[m][2];
        }
        t->N[i] += creal(N);
        t->T[i] += creal(T);
        t->C[i] += cimag(C);
    }
    free(factor);
    return RB_OK;
}

static rb_status make_table(const rb_bem_wheel *w, double reach, table *t)
{
    rb_status s = table_alloc(reach, 0.05 * log(w->radius / w->inner), t);

    for (int k = 0; k < w->terms && s == RB_OK; k++)
        add_disc(w, k, t);
    if (s == RB_OK)
        s = add_inner(w, t);
    for (int k = 0; k < 3 && s == RB_OK; k++) {
        t->spline[k] = gsl_spline_alloc(gsl_interp_cspline, (size_t)t->count);
        if (!t->spline[k])
            s = RB_ENOMEM;
        else
            gsl_spline_init(t->spline[k], t->x + t->first, t->N + k * t->count,
                            (size_t)t->count);
    }
    return s;
}

/* The mean over a load of half-angle b. */
static double mean(const gsl_spline *spline, gsl_interp_accel *near, double x, double b)
{
    return gsl_spline_eval_integ(spline, x - b, x + b, near) / (2.0 * b);
}

/* ---- The matrix -------------------------------------------------------------------- */

/* The angles of m = n + 1 midpoints and m + 1 ends, and what the half-plane's memory adds
 * along the circumference (2m x 2n). */
typedef struct {
    int n;
    double *arc, *end, *W;
} circumference;

static void circumference_free(circumference *c)
{
    free(c->arc);
    free(c->W);
}

static rb_status make_circumference(const rb_bem_wheel *w, const rb_bem_flexibility *f,
                                    const double *ends, circumference *c)
{
    const size_t m = (size_t)f->m, size = 2 * m * 2 * (size_t)f->n;
    rb_bem_surface plane = rb_bem_halfplane(w->material, w->radius);

    *c =
        (circumference){.n = f->n, .arc = rb_alloc(2 * m + 1, 1), .W = rb_alloc(size, 2)};
    if (!c->arc || !c->W)
        return RB_ENOMEM;
    c->end = c->arc + m;
    for (size_t i = 0; i <= m; i++)
        c->end[i] = w->radius * asin(ends[i] / w->radius);
    for (size_t i = 0; i < m; i++)
        c->arc[i] = 0.5 * (c->end[i] + c->end[i + 1]);
    rb_status s =
        rb_bem_surface_displacement(&plane, f->n, c->end, f->m, c->arc, c->W + size);
    plane.terms = w->terms;
    plane.ratio = w->ratio;
    plane.length = w->length;
    if (s == RB_OK)
        s = rb_bem_surface_displacement(&plane, f->n, c->end, f->m, c->arc, c->W);
    for (size_t k = 0; k < size && s == RB_OK; k++)
        c->W[k] -= c->W[size + k];
    return s;
}

/* Turns B = (NN, TN, NT, TT), from a load at angle `from` to a point at angle `to`, from
 * the frames of the surface into the obstacle's. */
static void turn(double to, double from, double B[4])
{
    const double c = cos(to), s = sin(to), cf = cos(from), sf = sin(from);
    const double P[4] = {cf * B[0] + sf * B[2], cf * B[1] + sf * B[3],
                         cf * B[2] - sf * B[0], cf * B[3] - sf * B[1]};
    B[0] = c * P[0] + s * P[1];
    B[1] = c * P[1] - s * P[0];
    B[2] = c * P[2] + s * P[3];
    B[3] = c * P[3] - s * P[2];
}

static void add_memory(const rb_bem_wheel *w, rb_bem_normals normals, const table *t,
                       const circumference *c, double *F)
{
    const size_t n = (size_t)c->n, m = n + 1;
    const double scale = 1.0 / (4.0 * M_PI * w->material.shear);

    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < m; i++) {
            const double h = c->end[j + 1] - c->end[j], b = 0.5 * h / w->radius,
                         to = c->arc[i] / w->radius, from = c->arc[j] / w->radius;
            const double coupling = scale * h * mean(t->spline[2], t->near, to - from, b);
            const size_t N = i + j * 2 * m, T = i + (j + n) * 2 * m;
            double B[4] = {
                c->W[N] + scale * h * mean(t->spline[0], t->near, to - from, b),
                c->W[N + m] - coupling, c->W[T] + coupling,
                c->W[T + m] + scale * h * mean(t->spline[1], t->near, to - from, b)};
            if (normals == RB_BEM_NORMALS_OBSTACLE)
                turn(to, from, B);
            F[N] += B[0];
            F[N + m] += B[1];
            F[T] += B[2];
            F[T + m] += B[3];
        }
}

static rb_status check_wheel(const rb_bem_wheel *w, rb_message *why)
{
    rb_status s = rb_bem_material_check(w->material, why);

    if (s == RB_OK && w->hub > 0.0)
        s = rb_bem_material_check(w->core, why);
    if (s == RB_OK && !(w->hub >= 0.0 && w->hub < w->inner && w->inner < w->radius &&
                        isfinite(w->radius)))
        s = rb_fail(why, RB_EINVAL, "wheel: radii %g, %g, %g: expected to increase",
                    w->hub, w->inner, w->radius);
    for (int k = 0; k < w->terms && s == RB_OK; k++)
        if (!(w->ratio[k] >= 0.0 && isfinite(w->ratio[k]) && w->length[k] > 0.0 &&
              isfinite(w->length[k])))
            s = rb_fail(
                why, RB_EINVAL,
                "memory term %d: ratio %g, length %g: expected numbers >= 0 and > 0",
                k + 1, w->ratio[k], w->length[k]);
    return s;
}

rb_status rb_bem_flexibility_add_memory(const rb_bem_wheel *wheel, rb_bem_normals normals,
                                        const double *ends, rb_bem_flexibility *f,
                                        rb_message *why)
{
    table t = {0};
    circumference c = {0};
    rb_status s = check_wheel(wheel, why);

    if (s != RB_OK)
        return s;
    s = rb_bem_flexibility_store(f);
    if (s == RB_OK)
        s = make_circumference(wheel, f, ends, &c);
    if (s == RB_OK)
        s = make_table(wheel, (c.end[f->m] - c.end[0]) / wheel->radius, &t);
    if (s == RB_OK)
        add_memory(wheel, normals, &t, &c, f->data);
    table_free(&t);
    circumference_free(&c);
    return s == RB_OK ? s
                      : rb_fail(why, s,
                                "out of memory for the memory of a wheel under %d "
                                "contact elements",
                                f->n);
}
