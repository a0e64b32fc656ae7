/* The kernel of a layer (L3) as a table: smooth on the scale of max(1, X), because its
 * singularities lie where images of the load would, two thicknesses and more away.  So it
 * is approximated by polynomials on pieces a quarter as long, integrals over strips are
 * integrals of polynomials, and a table to any distance has a few pieces per octave. */
#include "bem/layers/layer.h"
#include "bem/layers/panels.h"
#include "bem/layers/stack.h"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_sf_expint.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum {
    DEGREE = 11, /* a piece's half-length is an eighth of the way to a singularity */
    SAMPLES = DEGREE + 1,
    NEAR = 4 * RB_PANELS_PER_OCTAVE /* pieces by waves of real numbers, up to X = 8 */
};

/* Polynomials of t, -1 ... 1, of pressure, friction, coupling and of nothing. */
typedef struct {
    double c[SAMPLES][4];
    double before[4]; /* the integral from X = 0 to the middle of the piece */
} piece;

struct rb_bem_layer_table {
    /* what the kernel depends on; the pieces of X > 0, then those of X < 0 where memory
     * tells the sides apart */
    rb_bem_surface body; /* of thickness 1, with arrays of its own */
    rb_bem_stack stack;  /* of the body, likewise */
    int pieces;          /* of a side */
    piece *side[2];
    int users;
};

/* ---- Waves ------------------------------------------------------------------------- */

/* int_0^inf (Z exp(i sigma X/x_0) - Z(0) exp(-sigma)) dsigma/sigma, al = sigma/x_0, along
 * a ray of the complex plane, by Gauss's rule on panels.  Far away, on the ray of 30
 * degrees, the exponential fades within a few radians; the poles of Z are at least 60
 * degrees up (a stiff plate on a soft base). */
typedef struct {
    int n, capacity;
    double unit;                /* x_0 */
    double complex *sigma;      /* n */
    double complex (*Z)[3];     /* n: times the weight over sigma */
    double complex constant[3]; /* the same of Z(0) exp(-sigma), with what x_0 adds */
} waves;

enum { GAUSS = 20 };

static void add_panel(const rb_bem_surface *body, double from, double to, double complex ray,
                      const double Z_0[3], const gsl_integration_glfixed_table *rule, waves *w)
{
    for (size_t g = 0; g < GAUSS; g++) {
        double at, weight;
        gsl_integration_glfixed_point(from, to, g, &at, &weight, rule);
        const double complex sigma = at * ray, fade = cexp(-sigma);
        double complex *Z = w->Z[w->n];
        rb_bem_layer_remainder_at(body, sigma / w->unit, Z);
        for (int c = 0; c < 3; c++) {
            Z[c] *= weight / at;
            w->constant[c] -= Z_0[c] * weight / at * fade;
        }
        w->sigma[w->n++] = sigma;
    }
}

/* For X in x_0 ... 2 x_0; x_0 = 1: from 0 to 8, on the real axis, where Z fades. */
static rb_status make_waves(const rb_bem_surface *body, double x_0, waves *w)
{
    const int near = x_0 == 1.0;
    const double last = near ? 24.0 : 72.0, width = near ? 1.5 : 6.0;
    /* The smallest wave number, over that of the thickness, at which Z changes. */
    double smallest = 1.0 / fmax(1.0, rb_bem_layer_base_compliance(body));
    for (int k = 0; k < body->terms; k++)
        smallest = fmin(smallest, 1.0 / fmax(1.0, fabs(body->length[k])));
    smallest *= x_0;
    const int halvings = (int)fmax(0.0, ceil(log2(width / smallest)) + 1.0);
    const double complex ray = near ? 1.0 : 0.5 * (sqrt(3.0) + I);
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(GAUSS);
    double Z_0[3], to = ldexp(width, -halvings);

    *w = (waves){.capacity = GAUSS * (halvings + (int)(last / width)), .unit = x_0};
    w->sigma = malloc((size_t)w->capacity * sizeof *w->sigma);
    w->Z = malloc((size_t)w->capacity * sizeof *w->Z);
    const rb_status s = rule && w->sigma && w->Z ? RB_OK : RB_ENOMEM;
    if (s == RB_OK) {
        rb_bem_layer_longest_waves(body, Z_0);
        add_panel(body, 0.0, to, ray, Z_0, rule, w);
        while (w->n < w->capacity) {
            const double from = to;
            to += fmin(from, width);
            add_panel(body, from, to, ray, Z_0, rule, w);
        }
        gsl_sf_result cut = {0.0, 0.0}; /* of exp(-al), which falls more slowly than Z */
        if (near)
            gsl_sf_expint_E1_scaled_e(last, &cut);
        for (int c = 0; c < 2; c++) /* refers the logarithm to X = 1 */
            w->constant[c] -= Z_0[c] * (log(x_0) + exp(-last) * cut.val);
    }
    if (rule)
        gsl_integration_glfixed_table_free(rule);
    return s;
}

static void waves_free(waves *w)
{
    free(w->sigma);
    free(w->Z);
}

/* ---- Polynomials ------------------------------------------------------------------- */

/* From values at Chebyshev's points to powers of t. */
static void interpolate(const double value[SAMPLES][3], piece *p)
{
    double T[SAMPLES][SAMPLES] = {{1.0}, {0.0, 1.0}}; /* coefficients of T_k */
    double a[SAMPLES][3];

    for (int k = 2; k < SAMPLES; k++)
        for (int i = 0; i < SAMPLES; i++)
            T[k][i] = (i > 0 ? 2.0 * T[k - 1][i - 1] : 0.0) - T[k - 2][i];
    memset(p->c, 0, sizeof p->c);
    rb_panel_chebyshev(SAMPLES, value, a);
    for (int k = 0; k < SAMPLES; k++)
        for (int c = 0; c < 3; c++)
            for (int i = 0; i <= k; i++)
                p->c[i][c] += a[k][c] * T[k][i];
}

/* From the middle of a piece with this half-length to t. */
static rb_bem_layer_kernel integral_of(const piece *p, double t, double half)
{
    rb_bem_layer_kernel v = {{0.0}};
    for (int k = DEGREE; k >= 0; k--)
        for (int c = 0; c < 4; c++)
            v.of[c] = (v.of[c] + half * p->c[k][c] / (k + 1)) * t;
    return v;
}

/* The kernel at X, in the units of the waves. */
static void sum_waves(const waves *w, double X, double of[3])
{
    double complex sum[3] = {w->constant[0], w->constant[1], w->constant[2]};

    for (int i = 0; i < w->n; i++) {
        const double complex e = cexp(I * w->sigma[i] * (X / w->unit));
        for (int c = 0; c < 3; c++)
            sum[c] += w->Z[i][c] * e;
    }
    of[0] = creal(sum[0]);
    of[1] = creal(sum[1]);
    of[2] = cimag(sum[2]);
}

/* Pieces from .. pieces - 1 of one side; the waves of X < 0 are those of memory that
 * comes from the other side, and of the opposite coupling. */
static rb_status fill_side(const rb_bem_layer_table *table, int side, int from)
{
    rb_bem_surface body = table->body;
    rb_status s = RB_OK;
    waves w = {.unit = 0.0};
    double low, width;
    rb_panel_place(table->pieces, &low, &width);
    rb_bem_stack_kernel *stack = body.stack ? rb_bem_stack_kernel_create(&body, low) : NULL;

    if (body.stack && !stack)
        return RB_ENOMEM;
    if (side == 1)
        body.length += body.terms;
    for (int k = from; k < table->pieces && s == RB_OK; k++) {
        piece *p = table->side[side] + k;
        double value[SAMPLES][3];
        rb_panel_place(k, &low, &width);
        const double unit = low < 8.0 ? 1.0 : ldexp(1.0, ilogb(low));
        if (unit != w.unit && !stack) {
            waves_free(&w);
            s = make_waves(&body, unit, &w);
        }
        if (s == RB_OK && rb_interrupted())
            s = RB_INTERRUPTED;
        for (int j = 0; j < SAMPLES && s == RB_OK; j++) {
            const double X = low + width * rb_panel_point(SAMPLES, j);
            if (stack)
                rb_bem_stack_kernel_at(stack, X, value[j]);
            else
                sum_waves(&w, X, value[j]);
            value[j][1] += rb_bem_layer_membrane(&body, X);
            value[j][2] *= side ? -1.0 : 1.0;
        }
        if (s == RB_OK)
            interpolate((const double(*)[3])value, p);
    }
    rb_bem_stack_kernel_free(stack);
    waves_free(&w);
    for (int k = 0; k < table->pieces && s == RB_OK; k++) {
        piece *p = table->side[side] + k;
        double low_before, width_before;
        rb_panel_place(k, &low, &width);
        rb_panel_place(k > 0 ? k - 1 : 0, &low_before, &width_before);
        const rb_bem_layer_kernel own = integral_of(p, -1.0, 0.5 * width),
                                  other = k > 0 ? integral_of(p - 1, 1.0, 0.5 * width_before)
                                                : (rb_bem_layer_kernel){{0.0}};
        for (int c = 0; c < 4; c++)
            p->before[c] = (k > 0 ? p[-1].before[c] : 0.0) + other.of[c] - own.of[c];
    }
    return s;
}

/* ---- Means ------------------------------------------------------------------------- */

/* The kernel at X, or its integral from 0 to X. */
static rb_bem_layer_kernel look_up(const rb_bem_layer_table *table, double X, int integral)
{
    const int behind = X < 0.0, mirrored = behind && table->body.terms == 0;
    double t, low, width;
    const int k = rb_panel_of(fabs(X), &t);
    const piece *p = table->side[behind && !mirrored] + k;
    rb_bem_layer_kernel v = {{0.0}};

    if (integral) {
        rb_panel_place(k, &low, &width);
        v = integral_of(p, t, 0.5 * width);
        for (int c = 0; c < 4; c++)
            v.of[c] = (v.of[c] + p->before[c]) * (behind ? -1.0 : 1.0);
    } else {
        for (int i = DEGREE; i >= 0; i--)
            for (int c = 0; c < 4; c++)
                v.of[c] = v.of[c] * t + p->c[i][c];
    }
    v.of[2] *= mirrored ? -1.0 : 1.0;
    return v;
}

rb_bem_layer_kernel rb_bem_layer_integral(const rb_bem_layer_table *table, double X)
{
    return look_up(table, X, 1);
}

/* Short strips by Gauss's rule of 2, 3 or 5 points, whose differences of integrals would
 * lose digits. */
rb_bem_layer_kernel rb_bem_layer_mean(const rb_bem_layer_table *table, double X, double b)
{
    static const double at[3][3] = {{0.57735026918962576451},
                                    {0.0, 0.77459666924148337704},
                                    {0.0, 0.53846931010568309104, 0.90617984593866399280}},
                        weight[3][3] = {
                            {0.5},
                            {4.0 / 9.0, 5.0 / 18.0},
                            {64.0 / 225.0, 0.23931433524968323402, 0.11846344252809454376}};
    const double length = b / fmax(1.0, fabs(X));
    rb_bem_layer_kernel sum = {{0.0}};

    if (length > 0.1) {
        const rb_bem_layer_kernel to = look_up(table, X + b, 1), from = look_up(table, X - b, 1);
        for (int c = 0; c < 4; c++)
            sum.of[c] = (to.of[c] - from.of[c]) / (2.0 * b);
        return sum;
    }
    const int rule = length > 1e-2 ? 2 : length > 1e-4 ? 1 : 0;
    for (int g = 0; g < 3 && weight[rule][g] > 0.0; g++)
        for (int sign = 1; sign >= (at[rule][g] > 0.0 ? -1 : 1); sign -= 2) {
            const rb_bem_layer_kernel v = look_up(table, X + sign * b * at[rule][g], 0);
            for (int c = 0; c < 4; c++)
                sum.of[c] += weight[rule][g] * v.of[c];
        }
    return sum;
}

/* ---- Tables that are kept ---------------------------------------------------------- */

enum { KEPT = 8 };

/* Those used last come first. */
static rb_bem_layer_table *kept[KEPT];
static pthread_mutex_t tables = PTHREAD_MUTEX_INITIALIZER;

static void table_free(rb_bem_layer_table *table)
{
    if (!table)
        return;
    free((double *)table->body.ratio);
    free((double *)table->stack.thickness);
    free(table->side[0]);
    free(table->side[1]);
    free(table);
}

/* `tables` is locked. */
static void leave(rb_bem_layer_table *table)
{
    if (table && --table->users == 0)
        table_free(table);
}

void rb_bem_layer_table_release(const rb_bem_layer_table *table)
{
    pthread_mutex_lock(&tables);
    leave((rb_bem_layer_table *)table);
    pthread_mutex_unlock(&tables);
}

/* Of the same kernel. */
static int is_for(const rb_bem_layer_table *table, const rb_bem_surface *body)
{
    const rb_bem_surface *own = &table->body;
    int same = own->material.poisson == body->material.poisson &&
               own->elastic_base == body->elastic_base && own->smooth_base == body->smooth_base &&
               own->terms == body->terms;

    if (same && own->elastic_base)
        same = own->base.poisson == body->base.poisson &&
               own->base.shear * body->material.shear == body->base.shear * own->material.shear;
    same = same && (own->stack ? own->stack->n : 0) == (body->stack ? body->stack->n : 0);
    for (int k = 0; same && own->stack && k < own->stack->n; k++)
        same = own->stack->thickness[k] == body->stack->thickness[k] / body->thickness &&
               own->stack->poisson[k] == body->stack->poisson[k] &&
               own->stack->young[k] * body->stack->young[0] ==
                   body->stack->young[k] * own->stack->young[0];
    for (int k = 0; k < body->terms && same; k++)
        same =
            own->ratio[k] == body->ratio[k] && own->length[k] == body->length[k] / body->thickness;
    return same;
}

/* The stack of a body whose first layer is 1 thick.  0: no memory. */
static int copy_stack(const rb_bem_surface *body, rb_bem_layer_table *table)
{
    const rb_bem_stack *of = body->stack;
    if (!of)
        return 1;
    double *to = rb_alloc((size_t)of->n, 3);
    if (!to)
        return 0;
    for (int k = 0; k < of->n; k++) {
        to[k] = of->thickness[k] / body->thickness;
        to[of->n + k] = of->young[k];
        to[2 * of->n + k] = of->poisson[k];
    }
    table->stack = (rb_bem_stack){of->n, to, to + of->n, to + 2 * of->n};
    table->body.stack = &table->stack;
    return 1;
}

/* With the pieces that a shorter one has. */
static rb_bem_layer_table *make_table(const rb_bem_surface *body, int pieces,
                                      const rb_bem_layer_table *shorter)
{
    const size_t terms = (size_t)body->terms;
    rb_bem_layer_table *table = calloc(1, sizeof *table);
    double *ratio = rb_alloc(terms + 1, 3), *length = ratio ? ratio + terms : NULL;

    if (!table || !ratio) {
        free(table);
        free(ratio);
        return NULL;
    }
    for (size_t k = 0; k < terms; k++) {
        ratio[k] = body->ratio[k];
        length[k] = body->length[k] / body->thickness;
        length[k + terms] = -length[k];
    }
    table->body = *body;
    table->body.thickness = 1.0;
    table->body.ratio = ratio;
    table->body.length = length;
    table->pieces = pieces;
    rb_status s = copy_stack(body, table) ? RB_OK : RB_ENOMEM;
    for (int side = 0; side <= (terms > 0) && s == RB_OK; side++) {
        table->side[side] = calloc((size_t)pieces, sizeof(piece));
        if (table->side[side] && shorter)
            memcpy(table->side[side], shorter->side[side], (size_t)shorter->pieces * sizeof(piece));
        s = table->side[side] ? fill_side(table, side, shorter ? shorter->pieces : 0) : RB_ENOMEM;
    }
    if (s == RB_OK)
        return table;
    table_free(table);
    return NULL;
}

const rb_bem_layer_table *rb_bem_layer_table_of(const rb_bem_surface *body, double reach)
{
    /* How many reach as far. */
    double t;
    const int pieces = (int)fmax(NEAR, rb_panel_of(reach, &t) + 1);
    int k = 0;

    pthread_mutex_lock(&tables);
    while (k < KEPT && kept[k] && !is_for(kept[k], body))
        k++;
    rb_bem_layer_table *found = k < KEPT ? kept[k] : NULL;
    rb_bem_layer_table *table =
        found && found->pieces >= pieces ? found : make_table(body, pieces, found);
    if (table && table != found) {
        table->users = 1; /* the list */
        if (found)
            leave(found);
        else if (k == KEPT)
            leave(kept[--k]);
    }
    if (table) {
        memmove(kept + 1, kept, (size_t)k * sizeof *kept);
        kept[0] = table;
        table->users++;
    }
    pthread_mutex_unlock(&tables);
    return table;
}
