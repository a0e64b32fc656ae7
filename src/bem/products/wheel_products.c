/* Products with the flexibility of a wheel or of a flat body by Fourier transforms, on arcs and
 * elements of any lengths:
 * the precorrected method (Phillips and White 1997).  Uniform tractions are charges at
 * the ends of their arcs under the primitive G of the kernel.  Charges and answers go to
 * and from equal steps of the angle by Lagrange's polynomials; what these do not resolve,
 * G close to a charge, is added pair by pair. */
#include "bem/products/fourier.h" /* before complex.h: pairs of doubles */

#include "bem/internal.h"
#include "bem/layers/layer.h"
#include "bem/surface.h"
#include "bem/wheel.h"

#include <cblas.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the polynomials; distance in steps within which pairs are exact: further away the
 * derivatives of x ln x leave 1e-11 of a step. */
enum { ORDER = 10, NEAR = 20, MOST_STEPS = 1 << 21 };

typedef struct {
    int first; /* of ORDER steps */
    double weight[ORDER];
} spread;

typedef struct {
    int n, m, steps;
    rb_bem_wheel wheel;   /* elastic: borrows nothing; radius 0: a flat body */
    rb_bem_surface plane; /* its memory lies in `memory` */
    rb_bem_surface other; /* of the flat body that was added to this one */
    int has_other;
    rb_bem_normals normals;
    int parts;       /* kernels: N, T and C; N alone of an elastic half-plane, whose T is N and
                        whose C sums */
    double coupling; /* of a flat body: the part of C that is a multiple of abs(x) */
    double sheared;  /* of a flat body: what a tangential datum adds to T */
    double *ends;    /* n + 2, as given */
    double *place;   /* cosines and sines of m midpoints, for the obstacle's normals */
    spread *from;    /* n + 1 ends */
    spread *to;      /* m midpoints */
    int *near_first; /* m + 1: pairs of a midpoint in `near` */
    int *near_end;   /* m: the first end of them */
    double *near;    /* parts x pairs */
    rb_fourier fourier;
    fftw_complex *kernel[3];
    double *work[2], *charge; /* charge: 2 (n + 1) */
    double *turned;           /* 2n: tractions in the surface's frame */
    rb_arena memory;          /* of all arrays but kernel and work */
} products;

static void products_free(void *data)
{
    products *o = data;

    if (!o)
        return;
    rb_fourier_free(&o->fourier);
    for (int k = 0; k < 3; k++)
        fftw_free(o->kernel[k]);
    for (int k = 0; k < 2; k++)
        fftw_free(o->work[k]);
    rb_arena_free(&o->memory);
    free(o);
}

/* ---- Products ---------------------------------------------------------------------- */

static fftw_complex *transform_of(const products *o, const double *charge, double *work)
{
    memset(work, 0, (size_t)(o->fourier.size + 2) * sizeof *work);
    for (int j = 0; j <= o->n; j++)
        for (int k = 0; k < ORDER; k++)
            work[o->from[j].first + k] += o->from[j].weight[k] * charge[j];
    return rb_fourier_forward(&o->fourier, o->steps, work, work);
}

/* What friction does to gaps of a half-plane and pressure to slips: C is abs(x), so that
 * an element counts by the side on which it lies. */
static void add_coupling(const products *o, const double *r, double *w)
{
    for (int d = 0; d < 2; d++) {
        const double *from = r + (d ? 0 : o->n), c = d ? -o->coupling : o->coupling;
        double all = 0.0, behind = 0.0, *to = w + (d ? o->m : 0);

        for (int j = 0; j < o->n; j++)
            all += from[j] * (o->ends[j + 1] - o->ends[j]);
        for (int i = 0; i < o->m; i++) {
            const double own = i < o->n ? from[i] * (o->ends[i + 1] - o->ends[i]) : 0.0;
            to[i] += c * (2.0 * behind + own - all);
            behind += own;
        }
    }
}

static void products_apply(const rb_bem_flexibility *f, const double *r, double *w)
{
    const products *o = f->data;
    const double *cosine = o->place, *sine = o->place + o->m;
    const int turned = o->normals == RB_BEM_NORMALS_OBSTACLE;
    double *N = o->charge, *T = o->charge + o->n + 1;

    if (turned) {
        rb_wheel_turn(cosine, sine, 1, o->n, r, o->turned);
        r = o->turned;
    }
    for (int j = 0; j <= o->n; j++) {
        N[j] = (j < o->n ? r[j] : 0.0) - (j > 0 ? r[j - 1] : 0.0);
        T[j] = (j < o->n ? r[o->n + j] : 0.0) - (j > 0 ? r[o->n + j - 1] : 0.0);
    }
    fftw_complex *a = transform_of(o, N, o->work[0]), *b = transform_of(o, T, o->work[1]);
    if (o->parts == 1) {
        rb_fourier_times(&o->fourier, o->kernel[0][0], a);
        rb_fourier_times(&o->fourier, o->kernel[0][0], b);
    } else
        rb_fourier_times_coupled(&o->fourier, o->kernel[0][0], o->kernel[1][0], o->kernel[2][0], a,
                                 b);
    rb_fourier_backward(&o->fourier, o->work[0]);
    rb_fourier_backward(&o->fourier, o->work[1]);
    const size_t pairs = (size_t)o->near_first[o->m];
    for (int i = 0; i < o->m; i++) {
        const double *n = o->near + o->near_first[i], *at_N = N + o->near_end[i],
                     *at_T = T + o->near_end[i];
        const int count = o->near_first[i + 1] - o->near_first[i];
        double u = 0.0, v = 0.0;
        for (int k = 0; k < ORDER; k++) {
            u += o->to[i].weight[k] * o->work[0][o->to[i].first + k];
            v += o->to[i].weight[k] * o->work[1][o->to[i].first + k];
        }
        if (o->parts == 1)
            for (int k = 0; k < count; k++) {
                u += n[k] * at_N[k];
                v += n[k] * at_T[k];
            }
        else
            for (int k = 0; k < count; k++) {
                const double *t = n + pairs, *c = t + pairs;
                u += n[k] * at_N[k] + c[k] * at_T[k];
                v += t[k] * at_T[k] - c[k] * at_N[k];
            }
        w[i] = u;
        w[o->m + i] = v;
    }
    if (turned)
        rb_wheel_turn(cosine, sine, -1, o->m, w, w);
    if (o->coupling != 0.0)
        add_coupling(o, r, w);
    double force = 0.0;
    for (int j = 0; j < o->n && o->sheared != 0.0; j++)
        force += r[o->n + j] * (o->ends[j + 1] - o->ends[j]);
    for (int i = 0; i < o->m && o->sheared != 0.0; i++)
        w[o->m + i] += o->sheared * force;
}

/* The relaxation of a body, which is borrowed, into memory of one's own.  0: there is none. */
static int own_memory(rb_arena *memory, rb_bem_surface *body)
{
    const size_t terms = (size_t)body->terms;
    double *own = terms > 0 ? rb_arena_doubles(memory, terms, 2) : NULL;

    if (!own)
        return terms == 0;
    memcpy(own, body->ratio, terms * sizeof *own);
    memcpy(own + terms, body->length, terms * sizeof *own);
    body->ratio = own;
    body->length = own + terms;
    return 1;
}

/* Of a body in its own frame. */
static rb_status body_matrix(const products *o, const rb_bem_surface *plane,
                             rb_bem_flexibility *dense)
{
    return o->wheel.radius > 0.0
               ? rb_bem_flexibility_wheel(o->n, o->ends, &o->wheel, o->normals, dense, NULL)
               : rb_bem_flexibility_surface(o->n, o->ends, plane, dense, NULL);
}

static rb_status products_matrix(const rb_bem_flexibility *f, double *F, int ldf)
{
    const products *o = f->data;
    rb_bem_flexibility one, other = {0}, dense = {0};
    rb_status s = body_matrix(o, &o->plane, &one);

    if (s == RB_OK && o->has_other) {
        s = body_matrix(o, &o->other, &other);
        if (s == RB_OK)
            s = rb_bem_flexibility_pair(&one, &other, &dense, NULL);
    } else if (s == RB_OK) {
        dense = one;
        memset(&one, 0, sizeof one);
    }
    if (s == RB_OK)
        s = rb_bem_flexibility_matrix(&dense, F, ldf);
    rb_bem_flexibility_free(&one);
    rb_bem_flexibility_free(&dense);
    return s;
}

/* Of y: the part that is added to part c of another one; -1: none. */
static int part_for(const products *y, int c)
{
    return y->parts == 3 ? c : c < 2 ? 0 : -1;
}

/* From one part to three.  0: out of memory. */
static int part_into_three(products *x)
{
    const size_t pairs = (size_t)x->near_first[x->m],
                 modes = ((size_t)x->fourier.size / 2 + 1) * sizeof *x->kernel[0];
    double *near = rb_arena_doubles(&x->memory, 3 * pairs + 1, 1);

    if (!near)
        return 0;
    memcpy(near, x->near, pairs * sizeof *near);
    memcpy(near + pairs, x->near, pairs * sizeof *near);
    memset(near + 2 * pairs, 0, pairs * sizeof *near);
    memcpy(x->kernel[1], x->kernel[0], modes);
    memset(x->kernel[2], 0, modes);
    x->near = near;
    x->parts = 3;
    return 1;
}

/* Two flat bodies on the same elements: one kernel, and couplings of opposite signs. */
static int products_add(rb_bem_flexibility *a, const rb_bem_flexibility *b)
{
    products *x = a->data;
    const products *y = b->data;

    if (b->add_mirrored != products_add || x->has_other || y->has_other || x->n != y->n ||
        x->steps != y->steps || memcmp(x->ends, y->ends, ((size_t)x->m + 1) * sizeof *x->ends) != 0)
        return 0;
    rb_bem_surface other = y->plane;
    if (!own_memory(&x->memory, &other) || (x->parts < y->parts && !part_into_three(x)))
        return 0;
    const size_t pairs = (size_t)x->near_first[x->m];
    for (int c = 0; c < x->parts; c++) {
        const int from = part_for(y, c);
        const double sign = c == 2 ? -1.0 : 1.0;
        if (from < 0)
            continue;
        cblas_daxpy((int)pairs, sign, y->near + (size_t)from * pairs, 1,
                    x->near + (size_t)c * pairs, 1);
        cblas_daxpy(x->fourier.size + 2, sign, y->kernel[from][0], 1, x->kernel[c][0], 1);
    }
    x->coupling -= y->coupling;
    x->sheared += y->sheared;
    x->other = other;
    x->has_other = 1;
    return 1;
}

/* ---- Their tables ------------------------------------------------------------------ */

static spread spread_at(double place)
{
    spread at = {.first = (int)floor(place) - ORDER / 2 + 1};
    const double t = place - at.first;

    /* products of t - l before and after k, over those of k - l */
    double before = 1.0, after = 1.0, over = 1.0;
    for (int k = 0; k < ORDER; k++) {
        at.weight[k] = before;
        before *= t - k;
        over *= fmax(k, 1.0);
    }
    over = 1.0 / over; /* of the last one */
    for (int k = ORDER - 1; k >= 0; k--) {
        at.weight[k] *= after * over;
        after *= t - k;
        over *= -(double)k / (ORDER - k);
    }
    return at;
}

/* The primitive G of a body: what uniform traction displaces, from 0 to x.  C of a flat body is
 * that beyond its multiple of abs(x). */
typedef struct {
    rb_wheel_kernel wheel;
    rb_bem_strip_kernel flat;     /* body NULL: it is a wheel */
    rb_bem_layer_remainder layer; /* table NULL: there is none */
} primitive;

/* reach: of x at most; smallest: abs(x) at least, or 0. */
static rb_status primitive_create(const products *o, double smallest, double reach, primitive *G)
{
    *G = (primitive){.flat = {.body = NULL}};
    if (o->wheel.radius > 0.0)
        return rb_wheel_kernel_create(&o->wheel, smallest, reach, &G->wheel);
    G->flat = rb_bem_strip_kernel_of(&o->plane);
    return o->plane.thickness > 0.0 ? rb_bem_layer_remainder_of(&o->plane, reach, &G->layer)
                                    : RB_OK;
}

static void primitive_free(primitive *G)
{
    if (!G->flat.body)
        rb_wheel_kernel_free(&G->wheel);
    if (G->layer.table)
        rb_bem_layer_table_release(G->layer.table);
}

static rb_ring_answer primitive_at(const primitive *G, double x)
{
    const rb_bem_strip_kernel *k = &G->flat;

    if (!k->body)
        return rb_wheel_kernel_at(&G->wheel, x);
    double log_part = x != 0.0 ? k->slow * x * (log(fabs(x) / k->depth) - 1.0) : 0.0, C = 0.0;
    if (k->body->terms > 0) {
        double log_memory, sign_memory;
        rb_bem_memory_integrals(k->body, 0.5 * x, 0.5 * x, &log_memory, &sign_memory);
        log_part += log_memory;
        C = k->c * sign_memory;
    }
    const double both = k->raised * x - k->K * log_part;
    if (!G->layer.table)
        return (rb_ring_answer){both, both, C};
    const rb_bem_layer_kernel more = rb_bem_layer_primitive(&G->layer, x);
    return (rb_ring_answer){both + more.of[0], both + more.of[1], C + more.of[2]};
}

enum { WINDOW = 2 * NEAR + 2 * ORDER };

/* Parts of the primitive, at steps -steps ... steps or at the steps of a window. */
typedef double *parts_of[3];

static double part_of(rb_ring_answer at, int part)
{
    return part == 0 ? at.N : part == 1 ? at.T : at.C;
}

/* The pairs closer than NEAR steps. */
static rb_status correct_near(products *o, const primitive *G, parts_of on_steps, const double *end,
                              const double *middle, double step)
{
    const double reach = NEAR * step;
    double window[3][WINDOW] = {{0.0}};
    int low = 0, high = 0;

    for (int i = 0; i < o->m; i++) {
        while (low <= o->n && end[low] < middle[i] - reach)
            low++;
        while (high <= o->n && end[high] <= middle[i] + reach)
            high++;
        o->near_end[i] = low;
        o->near_first[i + 1] = o->near_first[i] + high - low;
    }
    const size_t pairs = (size_t)o->near_first[o->m];
    o->near = rb_arena_doubles(&o->memory, pairs * (size_t)o->parts + 1, 1);
    if (!o->near)
        return RB_ENOMEM;
    for (int i = 0; i < o->m; i++) {
        const int first = o->near_end[i], count = o->near_first[i + 1] - o->near_first[i];
        /* What a charge at each step of the window makes of midpoint i; beyond all charges
         * nothing is asked for. */
        for (int k = 0; count > 0 && k < WINDOW; k++) {
            const int apart = o->to[i].first - o->from[first].first - k;
            if (apart < -o->steps || apart + ORDER > o->steps)
                continue;
            for (int c = 0; c < o->parts; c++) {
                const double *at = on_steps[c] + o->steps + apart;
                double sum = 0.0;
                for (int a = 0; a < ORDER; a++)
                    sum += o->to[i].weight[a] * at[a];
                window[c][k] = sum;
            }
        }
        for (int k = 0; k < count; k++) {
            const spread *from = &o->from[first + k];
            const int at = from->first - o->from[first].first;
            const rb_ring_answer exact = primitive_at(G, middle[i] - end[first + k]);
            for (int c = 0; c < o->parts; c++) {
                double own = part_of(exact, c);
                for (int b = 0; b < ORDER; b++)
                    own -= from->weight[b] * window[c][at + b];
                o->near[(size_t)c * pairs + (size_t)(o->near_first[i] + k)] = own;
            }
        }
    }
    return RB_OK;
}

static rb_status set_tables(products *o, const double *angles, double step)
{
    const double *middle = angles, *end = angles + o->m;
    const double first = end[0] - ORDER * step;
    primitive G = {.flat = {.body = NULL}};
    const size_t both = 2 * (size_t)o->steps + 1;
    double *all = rb_alloc(both, 3);
    parts_of on_steps = {all, all ? all + both : NULL, all ? all + 2 * both : NULL};
    rb_status s = all ? RB_OK : RB_ENOMEM;

    double smallest = 0.25 * step;
    for (int j = 0; j < o->n; j++)
        smallest = fmin(smallest, 0.25 * (end[j + 1] - end[j]));
    if (s == RB_OK)
        s = primitive_create(o, smallest, (o->steps + 1) * step, &G);
    if (s == RB_OK && G.flat.body) {
        o->parts = o->plane.terms > 0 || G.layer.table ? 3 : 1;
        o->coupling = G.flat.slow * G.flat.c;
        o->sheared = G.flat.sheared;
    }
    if (s == RB_OK) {
        for (int j = 0; j <= o->n; j++)
            o->from[j] = spread_at((end[j] - first) / step);
        for (int i = 0; i < o->m; i++) {
            o->to[i] = spread_at((middle[i] - first) / step);
            o->place[i] = cos(middle[i]);
            o->place[o->m + i] = sin(middle[i]);
        }
        for (int k = -o->steps; k <= o->steps; k++) {
            const rb_ring_answer at = primitive_at(&G, k * step);
            for (int c = 0; c < o->parts; c++)
                on_steps[c][o->steps + k] = part_of(at, c);
        }
        /* on_steps: G at steps -steps ... steps, on_steps[steps] at 0. */
        for (int c = 0; c < o->parts; c++) {
            fftw_complex *const z =
                rb_fourier_kernel(&o->fourier, o->steps, on_steps[c] + 1, o->work[0]);
            memcpy(o->kernel[c], z, ((size_t)o->fourier.size / 2 + 1) * sizeof *z);
        }
        s = correct_near(o, &G, on_steps, end, middle, step);
    }
    primitive_free(&G);
    free(all);
    return s;
}

/* x: n + 1 midpoints and n + 2 ends, of arcs as angles; taken over. */
static rb_status make_products(const products *like, double *x, double step, const double *ends,
                               rb_bem_flexibility *f)
{
    const size_t m = (size_t)f->m;
    const double *end = x + m;
    products *o = calloc(1, sizeof *o);
    int all = 0;

    f->data = o;
    f->free_data = products_free;
    f->apply = products_apply;
    f->matrix = products_matrix;
    if (o) {
        *o = (products){.n = f->n,
                        .m = f->m,
                        .steps = (int)ceil((end[m] - end[0]) / step) + 2 * ORDER,
                        .wheel = like->wheel,
                        .plane = like->plane,
                        .normals = like->normals,
                        .parts = 3};
        o->wheel.terms = 0;
        o->ends = rb_arena_doubles(&o->memory, m + 1, 1);
        o->place = rb_arena_doubles(&o->memory, m, 2);
        o->charge = rb_arena_doubles(&o->memory, m, 2);
        o->turned = rb_arena_doubles(&o->memory, m, 2);
        o->from = rb_arena_zeros(&o->memory, m, sizeof *o->from);
        o->to = rb_arena_zeros(&o->memory, m, sizeof *o->to);
        o->near_first = rb_arena_ints(&o->memory, m + 1);
        o->near_end = rb_arena_ints(&o->memory, m);
        all = own_memory(&o->memory, &o->plane) && !o->memory.failed &&
              rb_fourier_make(2 * o->steps, &o->fourier);
        for (int k = 0; all && k < 3; k++) {
            o->kernel[k] = fftw_alloc_complex((size_t)o->fourier.size / 2 + 1);
            all = o->kernel[k] != NULL;
        }
        for (int k = 0; all && k < 2; k++) {
            o->work[k] = rb_fourier_alloc(&o->fourier);
            all = o->work[k] != NULL;
        }
    }
    rb_status s = RB_ENOMEM;
    if (all) {
        memcpy(o->ends, ends, (m + 1) * sizeof *ends);
        s = set_tables(o, x, step);
    }
    free(x);
    return s;
}

rb_status rb_bem_flexibility_wheel_products(int n_c, const double *ends, const rb_bem_wheel *wheel,
                                            rb_bem_normals normals, rb_bem_flexibility *f,
                                            rb_message *why)
{
    const products like = {.wheel = *wheel, .normals = normals};

    *f = (rb_bem_flexibility){0};
    rb_status s = rb_wheel_check(n_c, ends, wheel, why);
    if (s != RB_OK)
        return s;
    if (rb_wheel_has_equal_arcs(n_c, ends, wheel->radius)) {
        s = rb_wheel_on_equal_arcs(n_c, ends, wheel->radius, rb_wheel_response, wheel, normals, f);
        if (s == RB_OK) /* as the matrix has them, not arcs */
            rb_wheel_chords(wheel->radius, n_c, ends, f->h);
        return rb_bem_flexibility_end("wheel", n_c, s, f, why);
    }
    double *angles = rb_wheel_angles(wheel->radius, n_c, ends);
    if (!angles)
        return rb_bem_flexibility_end("wheel", n_c, RB_ENOMEM, f, why);
    const double length = angles[2 * n_c + 2] - angles[n_c + 1],
                 step = fmin(length / (n_c + 1), log(wheel->radius / wheel->inner) / 8.0);
    if (!(length < MOST_STEPS * step)) { /* very thin */
        free(angles);
        return rb_bem_flexibility_wheel(n_c, ends, wheel, normals, f, why);
    }
    s = rb_bem_flexibility_points(n_c, f);
    if (s == RB_OK) {
        rb_bem_flexibility_place(ends, f);
        rb_wheel_chords(wheel->radius, n_c, ends, f->h);
        s = make_products(&like, angles, step, ends, f);
    } else {
        free(angles);
    }
    return rb_bem_flexibility_end("wheel", n_c, s, f, why);
}

rb_status rb_bem_flexibility_surface_products(int n_c, const double *ends,
                                              const rb_bem_surface *body, rb_bem_flexibility *f,
                                              rb_message *why)
{
    const products like = {.plane = *body, .normals = RB_BEM_NORMALS_SURFACE};
    double *x = NULL;

    *f = (rb_bem_flexibility){0};
    rb_status s = rb_bem_surface_check(body, why);
    if (s == RB_OK)
        s = rb_bem_ends_check(n_c, ends, why);
    if (s != RB_OK)
        return s;
    const double length = ends[n_c + 1] - ends[0];
    double step = length / (n_c + 1);
    if (body->thickness > 0.0) /* its waves are as long as it is thick */
        step = fmin(step, body->thickness / 8.0);
    if (!(length < MOST_STEPS * step))
        return rb_bem_flexibility_surface(n_c, ends, body, f, why);
    s = rb_bem_flexibility_points(n_c, f);
    if (s == RB_OK && !(x = rb_alloc(2 * (size_t)n_c + 3, 1)))
        s = RB_ENOMEM;
    if (s == RB_OK) {
        rb_bem_flexibility_place(ends, f);
        memcpy(x, f->x, (size_t)f->m * sizeof *x);
        memcpy(x + f->m, ends, ((size_t)f->m + 1) * sizeof *x);
        s = make_products(&like, x, step, ends, f);
        f->add_mirrored = products_add;
    }
    return rb_bem_flexibility_end("half-plane", n_c, s, f, why);
}
