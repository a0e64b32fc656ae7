/* The contact of a wheel that is alike at every angle, from its waves around the
 * circumference (B12), and its fading memory in steady rolling (V8): a particle meets the
 * contact once per turn, so that E averages along the circumference, and waves exp(im
 * theta) of the elastic answer are multiplied by 1/(1 - i m L/R) as those of the
 * half-plane are.  The answer of a wheel is split into that of the half-plane, that of
 * the disc over it, both in closed form, and what the inner contour of the wheel changes,
 * which only long waves feel. */
#include "bem/internal.h"
#include "bem/layers/ring.h"
#include "bem/wheel.h"
#include "base/blas.h"

#include <complex.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_spline.h>
#include <math.h>
#include <stdlib.h>

typedef double complex cplx;

/* ---- Waves ------------------------------------------------------------------------- */

/* Of the whole wheel, at its outer contour. */
static rb_ring_compliance wheel_waves(const rb_bem_wheel *w, double m, cplx softer)
{
    const rb_ring_compliance rigid = {0.0, 0.0, 0.0, 0.0};
    /* What the inner contour rests on, over its own 2 G: an elastic core, or nothing that
     * yields.  Memory makes the wheel's material `softer` than the glassy one, but not
     * its core. */
    rb_ring_compliance K =
        w->hub > 0.0 ? rb_ring_across(m, w->core.poisson, w->hub, w->inner, rigid) : rigid;
    const cplx over = w->hub > 0.0 ? w->material.shear / w->core.shear / softer : 0.0;

    K = (rb_ring_compliance){over * K.uu, over * K.uv, over * K.vu, over * K.vv};
    return rb_ring_across(m, w->material.poisson, w->inner, w->radius, K);
}

rb_ring_compliance rb_ring_of_wheel(const rb_bem_wheel *w, double m)
{
    return wheel_waves(w, m, 1.0);
}

/* What the inner contour changes of the disc, and the waves 0 and 1, which the disc in
 * closed form does not have. */
static void inner_waves(const rb_bem_wheel *w, double m, cplx softer, cplx c[3])
{
    /* c: normal, tangential and coupling coefficient of cos m x, cos m x and sin m x; wave m > 0
     * stands for m and -m. */
    const rb_ring_compliance wheel = wheel_waves(w, m, softer);
    rb_ring_compliance disc = {0.0, 0.0, 0.0, 0.0};
    const double twice = m > 0.0 ? 2.0 : 1.0;

    if (m >= 2.0)
        disc = rb_ring_of_disc(m, 3.0 - 4.0 * w->material.poisson);
    c[0] = twice * (wheel.uu - disc.uu);
    c[1] = twice * (wheel.vv - disc.vv);
    c[2] = twice * (wheel.uv - disc.uv);
}

static void glassy_waves(const rb_bem_wheel *w, double m, cplx c[3])
{
    inner_waves(w, m, 1.0, c);
}

/* What memory adds to them.  On a rigid core all is softer alike. */
static void memory_waves(const rb_bem_wheel *w, double m, cplx c[3])
{
    cplx softer = 1.0, glassy[3];

    for (int k = 0; k < w->terms; k++) /* 1 + sum f_k/(1 - i m L_k/R) */
        softer += w->ratio[k] / (1.0 - I * (m * w->length[k] / w->radius));
    inner_waves(w, m, 1.0, glassy);
    inner_waves(w, m, w->hub > 0.0 ? softer : 1.0, c);
    for (int k = 0; k < 3; k++)
        c[k] = softer * c[k] - glassy[k];
}

/* The last wave of either. The inner contour feels wave m by (inner/radius)^m: beyond RB_RING_REACH
 * over the logarithm nothing. */
static int last_wave(const rb_bem_wheel *w)
{
    return 2 + (int)ceil(fmin(RB_RING_REACH / log(w->radius / w->inner), 1e9));
}

/* ---- The disc ---------------------------------------------------------------------- */

/* Primitive over x of what the disc, its waves m >= 2, has over the half-plane whose
 * datum is R. */
static rb_ring_answer disc_primitive(const rb_bem_wheel *w, double x)
{
    const double kappa = 3.0 - 4.0 * w->material.poisson;
    const cplx disc = rb_ring_disc_primitive(kappa, x);
    const double N = creal(disc) + (x != 0.0 ? (kappa + 1.0) * x * (log(fabs(x)) - 1.0) : 0.0);

    return (rb_ring_answer){N, N, cimag(disc) - 0.5 * M_PI * (kappa - 1.0) * fabs(x)};
}

/* What the disc, its waves m >= 2, has over the half-plane whose datum is R:
 * with l = -ln(1 - exp(ix)) the disc's answers are N = Re(kappa A + B) and
 * C = Im(kappa A - B), A = exp(-ix) l - 1 - exp(ix)/2, B = exp(ix) l. */
static rb_ring_answer disc_over_halfplane(double kappa, double x)
{
    if (x == 0.0)
        return (rb_ring_answer){-1.5 * kappa, -1.5 * kappa, 0.0};
    const double sign = copysign(1.0, x), chord = 2.0 * sin(0.5 * fabs(x)),
                 turn = 0.5 * (M_PI * sign - x);       /* Im l */
    const double less = 2.0 * gsl_pow_2(sin(0.5 * x)); /* 1 - cos x */
    const double N = (kappa + 1.0) * (log(fabs(x) / chord) + less * log(chord)) +
                     (kappa - 1.0) * sin(x) * turn - kappa * (1.0 + 0.5 * cos(x));
    const double C = -(kappa - 1.0) * (less * turn + 0.5 * x) +
                     sin(x) * ((kappa + 1.0) * log(chord) - 0.5 * kappa);
    return (rb_ring_answer){N, N, C};
}

/* The elastic half-plane's average over what lies upstream of angle x, one term. */
static rb_ring_answer halfplane_average(const rb_bem_wheel *w, int term, double x)
{
    static const double one = 1.0;
    /* A strip of R/100 at x = +-pi, so far from its own load that its mean is the value there. */
    const double h = 1e-2 * w->radius, at = x * w->radius, ends[2] = {-0.5 * h, 0.5 * h};
    rb_bem_surface plane = rb_bem_halfplane(w->material, w->radius);
    double own[4], slow[4];

    rb_bem_surface_displacement(&plane, 1, ends, 1, &at, own);
    plane.terms = 1;
    plane.ratio = &one;
    plane.length = w->length + term;
    rb_bem_surface_displacement(&plane, 1, ends, 1, &at, slow);
    const double scale = 4.0 * M_PI * w->material.shear / h;
    return (rb_ring_answer){scale * (slow[0] - own[0]), scale * (slow[3] - own[3]),
                            scale * (slow[2] - own[2])};
}

/* Angles x from -pi to pi; those from `first` on, `count` of them, are equally far from
 * each other and reach over the contact. */
typedef struct {
    int nodes, first, count;
    double *x;
    double *N, *T, *C; /* count each: what memory adds to the disc over the half-plane */
    gsl_spline *spline[3];
    gsl_interp_accel *near;
} table;

/* Adds one term of the disc's memory.  From x to pi upstream the disc's answer is
 * the half-plane's and a rest that is linear between the nodes; what lies beyond pi fades
 * as a whole, and one turn brings it back. */
static void add_disc(const rb_bem_wheel *w, int term, table *t)
{
    const double kappa = 3.0 - 4.0 * w->material.poisson, f = w->ratio[term],
                 length = w->length[term] / w->radius;
    /* Round 0 finds the average beyond pi from the condition that one turn brings it back; round 1
     * fills the table with it. */
    const rb_ring_answer ahead = halfplane_average(w, term, M_PI),
                         behind = halfplane_average(w, term, -M_PI);
    const double turn = exp(-2.0 * M_PI / length), rest = -expm1(-2.0 * M_PI / length);
    rb_ring_answer sum = {0.0, 0.0, 0.0}, beyond = sum;

    for (int round = 0; round < 2; round++) {
        rb_ring_answer next = disc_over_halfplane(kappa, M_PI);
        sum = beyond;
        for (int i = t->nodes - 2; i >= 0; i--) {
            const rb_bem_fading step = rb_bem_fading_over(length, t->x[i + 1] - t->x[i]);
            const rb_ring_answer own = disc_over_halfplane(kappa, t->x[i]);
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
            beyond = (rb_ring_answer){.N = (behind.N - turn * ahead.N + sum.N) / rest - ahead.N,
                                      .C = (behind.C - turn * ahead.C + sum.C) / rest - ahead.C};
    }
}

/* Equal steps to +-reach, growing ones from there to +-pi. */
static rb_status make_table(const rb_bem_wheel *w, double reach, table *t)
{
    /* Steps of a twentieth of the thickness of the ring, which is the length over which its answer
     * varies. */
    enum { OUTSIDE = 1500, LEAST = 400, MOST = 20000 };
    const double step = 0.05 * log(w->radius / w->inner);
    const int half = (int)fmin(fmax(ceil(reach / step), LEAST), MOST), middle = OUTSIDE + half;

    *t = (table){.first = OUTSIDE, .count = 2 * half + 1, .nodes = 2 * middle + 1};
    const size_t count = (size_t)t->count;
    t->x = rb_alloc((size_t)t->nodes, 1);
    t->N = rb_alloc(count, 3);
    t->near = gsl_interp_accel_alloc();
    if (!t->x || !t->N || !t->near)
        return RB_ENOMEM;
    t->T = t->N + count;
    t->C = t->T + count;
    for (int i = 0; i <= middle; i++) {
        const double x =
            i <= half ? reach * i / half : reach * pow(M_PI / reach, (i - half) / (double)OUTSIDE);
        t->x[middle + i] = x;
        t->x[middle - i] = -x;
    }
    for (int k = 0; k < w->terms; k++)
        add_disc(w, k, t);
    for (size_t k = 0; k < 3; k++) {
        t->spline[k] = gsl_spline_alloc(gsl_interp_cspline, count);
        if (!t->spline[k])
            return RB_ENOMEM;
        gsl_spline_init(t->spline[k], t->x + t->first, t->N + k * count, count);
    }
    return RB_OK;
}

/* Over a load of half-angle b. */
static double integral(const gsl_spline *spline, gsl_interp_accel *near, double x, double b)
{
    return gsl_spline_eval_integ(spline, x - b, x + b, near);
}

/* ---- Frames ------------------------------------------------------------------------ */

void rb_wheel_turn(const double *cosine, const double *sine, int way, int count, const double *from,
                   double *to)
{
    for (int i = 0; i < count; i++) {
        const double c = cosine[i], s = way * sine[i], N = from[i], T = from[count + i];
        to[i] = c * N - s * T;
        to[count + i] = s * N + c * T;
    }
}

void rb_wheel_turn_block(rb_direction to, rb_direction from, double B[4])
{
    const double c = to.cosine, s = to.sine, cf = from.cosine, sf = from.sine;
    /* Columns are turned by the angle of the load, rows by that of the point. */
    const double P[4] = {cf * B[0] + sf * B[2], cf * B[1] + sf * B[3], cf * B[2] - sf * B[0],
                         cf * B[3] - sf * B[1]};
    B[0] = c * P[0] + s * P[1];
    B[1] = c * P[1] - s * P[0];
    B[2] = c * P[2] + s * P[3];
    B[3] = c * P[3] - s * P[2];
}

/* ---- The kernel, glassy ------------------------------------------------------------ */

double *rb_wheel_angles(double radius, int n, const double *ends)
{
    const size_t m = (size_t)n + 1;
    double *middle = rb_alloc(2 * m + 1, 1);

    if (!middle)
        return NULL;
    double *end = middle + m;
    for (size_t i = 0; i <= m; i++)
        end[i] = asin(ends[i] / radius);
    for (size_t i = 0; i < m; i++)
        middle[i] = 0.5 * (end[i] + end[i + 1]);
    return middle;
}

void rb_wheel_chords(double radius, int n, const double *ends, double *h)
{
    for (int i = 0; i <= n; i++)
        h[i] = 2.0 * radius * sin(0.5 * (asin(ends[i + 1] / radius) - asin(ends[i] / radius)));
}

rb_status rb_wheel_kernel_create(const rb_bem_wheel *w, double smallest, double reach,
                                 rb_wheel_kernel *kernel)
{
    kernel->kappa = 3.0 - 4.0 * w->material.poisson;
    kernel->scale = w->radius / (4.0 * M_PI * w->material.shear);
    kernel->datum = 1.0;
    return rb_ring_table_create(w, glassy_waves, last_wave(w), disc_primitive,
                                fmin(smallest, log(w->radius / w->inner)), reach, &kernel->inner);
}

void rb_wheel_kernel_free(rb_wheel_kernel *kernel)
{
    rb_ring_table_free(&kernel->inner);
}

rb_ring_answer rb_wheel_kernel_at(const rb_wheel_kernel *kernel, double x)
{
    rb_ring_answer inner = {0.0, 0.0, 0.0};
    if (kernel->inner.panels > 0)
        inner = rb_ring_table_at(&kernel->inner, x);
    /* Primitives: of the half-plane's logarithm x - x ln|x|, of its sign |x|. */
    const double plane =
        x != 0.0 ? (kernel->kappa + 1.0) * x * (1.0 - log(fabs(x) / kernel->datum)) : 0.0;

    return (rb_ring_answer){kernel->scale * (inner.N + plane), kernel->scale * (inner.T + plane),
                            kernel->scale *
                                (inner.C + 0.5 * M_PI * (kernel->kappa - 1.0) * fabs(x))};
}

/* The waves that the inner contour changes are as long as the ring is thick, so that few
 * panels hold their sum; the disc is added in closed form. */
rb_status rb_wheel_response(const void *body, int n, double h, double *N, double *T, double *C)
{
    const rb_bem_wheel *w = body;
    const double scale = w->radius / (4.0 * M_PI * w->material.shear), length = h * w->radius,
                 strip[2] = {-0.5 * length, 0.5 * length};
    const rb_bem_surface plane = rb_bem_halfplane(w->material, w->radius);
    const size_t points = (size_t)n + 1;
    double *x = rb_alloc(points, 1), *W = rb_alloc(2 * points, 2);
    rb_ring_table inner = {0};
    rb_status s = x && W ? RB_OK : RB_ENOMEM;

    if (s == RB_OK) {
        for (int k = 0; k <= n; k++)
            x[k] = k * length;
        s = rb_bem_surface_displacement(&plane, 1, strip, n + 1, x, W);
    }
    if (s == RB_OK)
        s = rb_ring_table_create(w, glassy_waves, last_wave(w), NULL, log(w->radius / w->inner),
                                 (n + 1) * h, &inner);
    rb_ring_answer before = {0.0, 0.0, 0.0};
    for (int k = -1; k <= n && s == RB_OK; k++) {
        /* The integral over an element is the difference of the primitives at its ends. */
        const double end = (k + 0.5) * h;
        const rb_ring_answer disc = disc_primitive(w, end), rest = rb_ring_table_at(&inner, end);
        const rb_ring_answer at = {disc.N + rest.N, disc.T + rest.T, disc.C + rest.C};
        if (k >= 0) {
            N[k] = W[k] + scale * (at.N - before.N);
            T[k] = W[3 * points + (size_t)k] + scale * (at.T - before.T);
            C[k] = W[2 * points + (size_t)k] + scale * (at.C - before.C);
        }
        before = at;
    }
    rb_ring_table_free(&inner);
    free(W);
    free(x);
    return s;
}

/* ---- The matrix -------------------------------------------------------------------- */

/* The angles of m = n + 1 midpoints and m + 1 ends, times R, the directions of the
 * midpoints and what the half-plane adds along the circumference (2m x 2n). */
typedef struct {
    int n;
    double *arc, *end, *W;
    rb_direction *at;
} circumference;

static void circumference_free(circumference *c)
{
    free(c->arc);
    free(c->W);
    free(c->at);
}

/* On a circle, arcs take the places of abscissae: the half-plane's answer along the arc is a part
 * of the wheel's. */
static rb_status place_circumference(double radius, int n, const double *ends, int parts,
                                     circumference *c)
{
    const size_t m = (size_t)n + 1;

    *c = (circumference){.n = n,
                         .arc = rb_wheel_angles(radius, n, ends),
                         .W = rb_alloc(2 * m * 2 * (size_t)n, (size_t)parts),
                         .at = calloc(m, sizeof *c->at)};
    if (!c->arc || !c->W || !c->at)
        return RB_ENOMEM;
    c->end = c->arc + m;
    for (size_t i = 0; i < m; i++)
        c->at[i] = (rb_direction){cos(c->arc[i]), sin(c->arc[i])};
    for (size_t i = 0; i < 2 * m + 1; i++)
        c->arc[i] *= radius;
    return RB_OK;
}

/* The integrals of the inner table over the loads from end j to the midpoints. */
static void from_end(const rb_bem_wheel *w, const circumference *c, const rb_ring_table *inner,
                     size_t j, rb_ring_answer *at)
{
    for (size_t i = 0; i <= (size_t)c->n; i++)
        at[i] = rb_ring_table_at(inner, (c->arc[i] - c->end[j]) / w->radius);
}

/* Adds columns from .. to - 1; t: NULL, or the disc's memory.  work: 2m. */
static void add_columns(const rb_bem_wheel *w, rb_bem_normals normals, const circumference *c,
                        const rb_ring_table *inner, const table *t, size_t from, size_t to,
                        rb_ring_answer *work, double *F)
{
    const size_t n = (size_t)c->n, m = n + 1;
    const double scale = w->radius / (4.0 * M_PI * w->material.shear);
    rb_ring_answer *low = work, *high = work + m;

    from_end(w, c, inner, from, high);
    for (size_t j = from; j < to; j++) {
        rb_ring_answer *const last = low;
        low = high;
        high = last;
        from_end(w, c, inner, j + 1, high);
        for (size_t i = 0; i < m; i++) {
            const double x = (c->arc[i] - c->arc[j]) / w->radius,
                         b = 0.5 * (c->end[j + 1] - c->end[j]) / w->radius;
            rb_ring_answer own = {low[i].N - high[i].N, low[i].T - high[i].T, low[i].C - high[i].C};
            if (t) {
                own.N += integral(t->spline[0], t->near, x, b);
                own.T += integral(t->spline[1], t->near, x, b);
                own.C += integral(t->spline[2], t->near, x, b);
            }
            const size_t N = i + j * 2 * m, T = i + (j + n) * 2 * m;
            double B[4] = {c->W[N] + scale * own.N, c->W[N + m] - scale * own.C,
                           c->W[T] + scale * own.C, c->W[T + m] + scale * own.T};
            if (normals == RB_BEM_NORMALS_OBSTACLE)
                rb_wheel_turn_block(c->at[i], c->at[j], B);
            F[N] += B[0];
            F[N + m] += B[1];
            F[T] += B[2];
            F[T + m] += B[3];
        }
    }
}

/* Splines remember where they have looked last: one thread. */
static rb_status add_matrix(const rb_bem_wheel *w, rb_bem_normals normals, const circumference *c,
                            const rb_ring_table *inner, const table *t, double *F)
{
    const size_t n = (size_t)c->n, m = n + 1;
    const int parts = t || (double)(n * m) < rb_pairs_for_threads ? 1 : rb_blas_loop_threads();
    rb_ring_answer *work = calloc(2 * m * (size_t)parts, sizeof *work);

    if (!work)
        return RB_ENOMEM;
#pragma omp parallel for num_threads(parts) schedule(static)
    for (int k = 0; k < parts; k++)
        add_columns(w, normals, c, inner, t, n * (size_t)k / (size_t)parts,
                    n * (size_t)(k + 1) / (size_t)parts, work + 2 * m * (size_t)k, F);
    free(work);
    return RB_OK;
}

/* Panels from a quarter of the shortest element on. */
static rb_status make_inner(const rb_bem_wheel *w, const circumference *c, rb_ring_waves *waves,
                            rb_ring_primitive *rest, rb_ring_table *inner)
{
    double smallest = fmin(log(w->radius / w->inner), 1.0);

    for (int i = 0; i < c->n; i++)
        smallest = fmin(smallest, 0.25 * (c->end[i + 1] - c->end[i]) / w->radius);
    return rb_ring_table_create(w, waves, last_wave(w), rest, smallest,
                                (c->end[c->n + 1] - c->end[0]) / w->radius, inner);
}

static rb_status check_wheel(const rb_bem_wheel *w, rb_message *why)
{
    rb_status s = rb_bem_material_check(w->material, why);

    if (s == RB_OK && w->hub > 0.0)
        s = rb_bem_material_check(w->core, why);
    if (s == RB_OK && w->hub > 0.0 && w->hub >= w->inner)
        s = rb_fail(why, RB_EINVAL,
                    "hub of radius %g: expected less than the radius %g of the core "
                    "under the cover",
                    w->hub, w->inner);
    if (s == RB_OK &&
        !(w->hub >= 0.0 && w->hub < w->inner && w->inner < w->radius && isfinite(w->radius)))
        s = rb_fail(why, RB_EINVAL, "wheel: radii %g, %g, %g: expected to increase", w->hub,
                    w->inner, w->radius);
    for (int k = 0; k < w->terms && s == RB_OK; k++)
        if (!(w->ratio[k] >= 0.0 && isfinite(w->ratio[k]) && w->length[k] > 0.0 &&
              isfinite(w->length[k])))
            s = rb_fail(why, RB_EINVAL,
                        "memory term %d: ratio %g, length %g: expected numbers >= 0 and > 0", k + 1,
                        w->ratio[k], w->length[k]);
    return s;
}

rb_status rb_wheel_check(int n_c, const double *ends, const rb_bem_wheel *wheel, rb_message *why)
{
    rb_status s = check_wheel(wheel, why);
    if (s == RB_OK)
        s = rb_bem_ends_check(n_c, ends, why);
    if (s == RB_OK && !(-ends[0] < wheel->radius && ends[n_c + 1] < wheel->radius))
        s = rb_fail(why, RB_EINVAL, "wheel of radius %g: contact from %g to %g is wider",
                    wheel->radius, ends[0], ends[n_c + 1]);
    /* Waves 0 and 1, of a cover that next to nothing holds, would drown all others. */
    if (s != RB_OK)
        return s;
    for (int m = 0; m < 2; m++) {
        cplx c[3];
        glassy_waves(wheel, m, c);
        for (int k = 0; k < 3; k++)
            if (!(cabs(c[k]) < 1e12))
                return rb_fail(why, RB_SINGULAR,
                               "wheel: the flexibility is singular, the core hardly "
                               "holds the cover (shear moduli %g and %g)",
                               wheel->core.shear, wheel->material.shear);
    }
    return RB_OK;
}

/* (B12): the half-plane along the circumference, what the disc has over it and what the inner
 * contour changes, turned into the contact frame. */
rb_status rb_bem_flexibility_wheel(int n_c, const double *ends, const rb_bem_wheel *wheel,
                                   rb_bem_normals normals, rb_bem_flexibility *f, rb_message *why)
{
    const rb_bem_surface plane = rb_bem_halfplane(wheel->material, wheel->radius);
    rb_ring_table inner = {0};
    circumference c = {0};
    double *F = NULL;

    *f = (rb_bem_flexibility){0};
    rb_status s = rb_wheel_check(n_c, ends, wheel, why);
    if (s != RB_OK)
        return s;
    rb_phase("flexibility of the contact");
    s = rb_bem_flexibility_dense(n_c, f, &F);
    if (s == RB_OK)
        s = place_circumference(wheel->radius, n_c, ends, 1, &c);
    if (s == RB_OK) {
        rb_bem_flexibility_place(ends, f);
        rb_wheel_chords(wheel->radius, n_c, ends, f->h);
        s = rb_bem_surface_displacement(&plane, n_c, c.end, f->m, c.arc, c.W);
    }
    if (s == RB_OK)
        s = make_inner(wheel, &c, glassy_waves, disc_primitive, &inner);
    if (s == RB_OK)
        s = add_matrix(wheel, normals, &c, &inner, NULL, F);
    rb_ring_table_free(&inner);
    circumference_free(&c);
    return rb_bem_flexibility_end("wheel", n_c, s, f, why);
}

/* Normal displacement at `points` abscissae x under strips of p and q on the rim, without a
 * matrix. */
rb_status rb_bem_wheel_normal(const rb_bem_wheel *wheel, const rb_bem_edge_load *load, int points,
                              const double *x, double *w)
{
    const double R = wheel->radius;
    rb_wheel_kernel kernel = {0};
    double shortest = 1.0;
    rb_status s = check_wheel(wheel, NULL);

    if (s == RB_OK && (load->n < 1 || points < 1))
        s = RB_EINVAL;
    for (int i = 0; i < points && s == RB_OK; i++)
        s = fabs(x[i]) < R ? RB_OK : RB_EINVAL;
    for (int j = 0; j <= load->n && s == RB_OK; j++) {
        s = fabs(load->x[j]) < R ? RB_OK : RB_EINVAL;
        if (s == RB_OK && j > 0)
            shortest = fmin(shortest, (load->x[j] - load->x[j - 1]) / R);
    }
    if (s == RB_OK)
        s = rb_wheel_kernel_create(wheel, 1e-3 * shortest, M_PI, &kernel);
    for (int i = 0; i < points && s == RB_OK; i++) {
        const double to = asin(x[i] / R);
        w[i] = 0.0;
        for (int j = 0; j < load->n; j++) {
            const double end[2] = {asin(load->x[j] / R), asin(load->x[j + 1] / R)},
                         from = 0.5 * (end[0] + end[1]);
            const rb_ring_answer low = rb_wheel_kernel_at(&kernel, to - end[0]),
                                 high = rb_wheel_kernel_at(&kernel, to - end[1]);
            const double C = low.C - high.C;
            double B[4] = {low.N - high.N, -C, C, low.T - high.T};
            rb_wheel_turn_block((rb_direction){cos(to), sin(to)},
                                (rb_direction){cos(from), sin(from)}, B);
            w[i] += B[0] * load->p[j] + B[2] * load->q[j];
        }
    }
    rb_wheel_kernel_free(&kernel);
    return s;
}

rb_status rb_bem_flexibility_add_memory(const rb_bem_wheel *wheel, rb_bem_normals normals,
                                        const double *ends, rb_bem_flexibility *f, rb_message *why)
{
    rb_bem_surface plane = rb_bem_halfplane(wheel->material, wheel->radius);
    table t = {0};
    rb_ring_table inner = {0};
    circumference c = {0};
    rb_status s = check_wheel(wheel, why);

    if (s != RB_OK)
        return s;
    s = rb_bem_flexibility_store(f);
    if (s == RB_OK)
        s = place_circumference(wheel->radius, f->n, ends, 2, &c);
    if (s == RB_OK) {
        /* What memory adds to the half-plane. */
        const size_t size = 4 * (size_t)f->m * (size_t)f->n;
        s = rb_bem_surface_displacement(&plane, f->n, c.end, f->m, c.arc, c.W + size);
        plane.terms = wheel->terms;
        plane.ratio = wheel->ratio;
        plane.length = wheel->length;
        if (s == RB_OK)
            s = rb_bem_surface_displacement(&plane, f->n, c.end, f->m, c.arc, c.W);
        for (size_t k = 0; k < size && s == RB_OK; k++)
            c.W[k] -= c.W[size + k];
    }
    if (s == RB_OK)
        s = make_table(wheel, (c.end[f->m] - c.end[0]) / wheel->radius, &t);
    if (s == RB_OK)
        s = make_inner(wheel, &c, memory_waves, NULL, &inner);
    if (s == RB_OK)
        s = add_matrix(wheel, normals, &c, &inner, &t, f->data);
    free(t.x);
    free(t.N);
    for (int k = 0; k < 3; k++)
        gsl_spline_free(t.spline[k]);
    gsl_interp_accel_free(t.near);
    rb_ring_table_free(&inner);
    circumference_free(&c);
    return s == RB_OK ? s
                      : rb_fail(why, s,
                                "out of memory for the memory of a wheel under %d "
                                "contact elements",
                                f->n);
}
