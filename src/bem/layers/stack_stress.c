/* Stress in a stack of layers and its base (L8).  In the first layer the difference from the
 * half-plane, whose stress is in closed form, is computed by Gauss quadrature over wave numbers;
 * below the first bond the whole stress is. */
#include "bem/internal.h"
#include "bem/layers/layer.h"
#include "bem/layers/stack.h"
#include "base/blas.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdlib.h>

/* Beyond this product of wave number and depth a wave is below rounding. */
static const double FADED = 40.0;
/* A panel of Gauss points is as long as this part of where it begins, and an oscillation may turn
 * by so many radians in it. */
enum { GAUSS = 16 };
static const double GROWTH = 1.0, RADIANS = 10.0;
/* The first panel, over the least wave number at which something changes. */
static const double FIRST = 0.05;
enum { MOST_STATES = 1 << 21 };

/* State of a lower face, or of the upper one of the base, times the exponential of what lies
 * between the surface and the upper face of its row. */
typedef struct {
    double re[4], im[4];
} state;

/* sxx, syy and X of the waves of a panel at a depth, real parts and then imaginary ones. */
typedef struct {
    double part[2][3][GAUSS];
} amplitudes;

/* The last depths that were asked for: a search for a maximum comes back to three of them. */
enum { KEPT = 4 };
typedef struct {
    double depth;
    int n, row; /* panels that do not fade, row of the depth; n = 0: none */
    amplitudes *panel;
} layer_of_waves;

struct rb_bem_stack_field {
    rb_bem_stack_rows *rows;
    rb_bem_edge_load load; /* of nodes; what it borrows stays the caller's */
    double reach;          /* of the present waves */
    int n;                 /* waves */
    double *k;             /* n, increasing; owned, as what follows */
    state *top;            /* n: of the half-plane of the first layer under the same tractions */
    state *at;             /* n for each row */
    layer_of_waves kept[KEPT];
    int oldest; /* of them */
};

static void forget_amplitudes(rb_bem_stack_field *f)
{
    for (int k = 0; k < KEPT; k++) {
        free(f->kept[k].panel);
        f->kept[k] = (layer_of_waves){.panel = NULL};
    }
}

void rb_bem_stack_field_free(rb_bem_stack_field *f)
{
    if (!f)
        return;
    forget_amplitudes(f);
    rb_bem_stack_rows_free(f->rows);
    free(f->k);
    free(f->top);
    free(f->at);
    free(f);
}

/* ---- Waves ------------------------------------------------------------------------- */

static void set_state(const double C[2][2], const double complex t[2], state *s)
{
    for (int i = 0; i < 2; i++) {
        const double complex u = -(C[i][0] * t[0] + C[i][1] * t[1]);
        s->re[i] = creal(u);
        s->im[i] = cimag(u);
        s->re[2 + i] = creal(t[i]);
        s->im[2 + i] = cimag(t[i]);
    }
}

/* The states of wave g under its share of the tractions, from the surface down. */
static void set_wave(rb_bem_stack_field *f, double weight, double (*C)[2][2], double (*down)[2][2],
                     int g)
{
    const rb_bem_stack_rows *rows = f->rows;
    const double k = f->k[g];
    double complex p, q;

    rb_bem_edge_load_wave(&f->load, k, &p, &q);
    double complex t[2] = {I * q * weight / M_PI, -p * weight / M_PI};
    rb_bem_stack_compliances(rows, k, C, down);
    set_state((const double(*)[2])rows->row[0].half, t, &f->top[g]);
    for (int j = 0; j <= rows->n; j++) {
        state *at = &f->at[(size_t)j * (size_t)f->n + (size_t)g];
        if (j == rows->n) {
            set_state((const double(*)[2])C[j], t, at);
            break;
        }
        const double complex below[2] = {down[j][0][0] * t[0] + down[j][0][1] * t[1],
                                         down[j][1][0] * t[0] + down[j][1][1] * t[1]};
        set_state((const double(*)[2])C[j + 1], below, at);
        const double fade = exp(-k * rows->row[j].thickness);
        t[0] = fade * below[0];
        t[1] = fade * below[1];
    }
}

/* Ends of the panels from zero to where the first layer lets nothing through; NULL: their number.
 */
static int set_panels(const rb_bem_stack_rows *rows, double reach, double *end)
{
    double softest = 0.0, stiffest = INFINITY;
    for (int j = 0; j < rows->n + rows->elastic_base; j++) {
        softest = fmax(softest, rows->row[j].half[0][0]);
        stiffest = fmin(stiffest, rows->row[j].half[0][0]);
    }
    const double last = FADED / rows->row[0].thickness, widest = RADIANS / reach;
    double to = FIRST * fmin(1.0 / reach, stiffest / softest / rows->height);
    int n = 1;
    if (end)
        end[0] = 0.0;
    for (; to < last; n++) {
        if (end)
            end[n] = to;
        to += fmin(GROWTH * to, widest);
        if (n > MOST_STATES / GAUSS)
            return n;
    }
    if (end)
        end[n] = last;
    return n;
}

/* For points and strips that are `reach` apart at most. */
static rb_status make_waves(rb_bem_stack_field *f, double reach, rb_message *why)
{
    const rb_bem_stack_rows *rows = f->rows;
    const int panels = set_panels(rows, reach, NULL), n = panels * GAUSS;
    if ((double)n * (rows->n + 1) > MOST_STATES)
        return rb_fail(why, RB_EINVAL,
                       "stress: contact and points extend over %.3g mm, too far for a first layer "
                       "of %.3g mm and %d layers",
                       reach, rows->row[0].thickness, rows->n);
    const size_t states = (size_t)n * ((size_t)rows->n + 1);
    rb_arena scratch = {0};
    double *end = rb_arena_doubles(&scratch, (size_t)panels + 1, 1),
           *weight = rb_arena_doubles(&scratch, (size_t)n, 1);
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(GAUSS);
    forget_amplitudes(f);
    free(f->k);
    free(f->top);
    free(f->at);
    f->k = rb_alloc((size_t)n, 1);
    f->top = malloc((size_t)n * sizeof *f->top);
    f->at = malloc(states * sizeof *f->at);
    f->n = 0;
    rb_status s = !scratch.failed && rule && f->k && f->top && f->at ? RB_OK : RB_ENOMEM;
    if (s == RB_OK) {
        f->n = n;
        f->reach = reach;
        set_panels(rows, reach, end);
        for (int j = 0; j < n; j++)
            gsl_integration_glfixed_point(end[j / GAUSS], end[j / GAUSS + 1], (size_t)(j % GAUSS),
                                          &f->k[j], &weight[j], rule);
    }
    int stop = 0, failed = 0;
#pragma omp parallel num_threads(                                                                  \
    rb_blas_loop_threads()) if (s == RB_OK && (double)n * f->load.n > rb_pairs_for_threads)
    {
        double(*C)[2][2] = malloc(((size_t)rows->n + 1) * 2 * sizeof *C);
#pragma omp for schedule(static)
        for (int j = 0; j < (s == RB_OK ? n : 0); j++) {
            if (!C)
                failed = 1;
            else if (!rb_interrupted_in_loop(&stop))
                set_wave(f, weight[j], C, C + rows->n + 1, j);
        }
        free(C);
    }
    if (rule)
        gsl_integration_glfixed_table_free(rule);
    return rb_arena_done(&scratch, failed ? RB_ENOMEM : stop ? RB_INTERRUPTED : s);
}

rb_status rb_bem_stack_field_create(const rb_bem_surface *body, const rb_bem_edge_load *load,
                                    rb_bem_stack_field **field, rb_message *why)
{
    rb_bem_stack_field *f = calloc(1, sizeof *f);
    *field = f;
    if (!f)
        return RB_ENOMEM;
    f->rows = rb_bem_stack_rows_of(body);
    f->load = *load;
    const rb_status s =
        f->rows ? make_waves(f, 2.0 * (load->x[load->n - 1] - load->x[0]), why) : RB_ENOMEM;
    if (s != RB_OK) {
        rb_bem_stack_field_free(f);
        *field = NULL;
    }
    return s;
}

/* ---- Points ------------------------------------------------------------------------ */

/* sxx, syy and X of a state. */
static void stress_of(const rb_bem_stack_row *row, const double s[4], double of[3])
{
    of[0] = -(row->A[RB_STACK_X][RB_STACK_U] * s[RB_STACK_U] +
              row->A[RB_STACK_X][RB_STACK_Y] * s[RB_STACK_Y]);
    of[1] = s[RB_STACK_Y];
    of[2] = s[RB_STACK_X];
}

/* What is left of a half-plane's state at eta below it: fade (1 + eta (A + 1)), fade exp(-eta). */
static void sink(const rb_bem_stack_row *row, double eta, double fade, const double s[4],
                 double to[4])
{
    for (int i = 0; i < 4; i++) {
        double rate = s[i];
        for (int j = 0; j < 4; j++)
            rate += row->A[i][j] * s[j];
        to[i] = fade * (s[i] + eta * rate);
    }
}

/* Of wave g of the field, in row j, `below` its upper face. */
static void set_amplitude(const rb_bem_stack_field *f, int j, int g, double below, amplitudes *w)
{
    const rb_bem_stack_row *row = &f->rows->row[j];
    const state *at = &f->at[(size_t)j * (size_t)f->n + (size_t)g];
    const double k = f->k[g], fade = exp(-k * below);
    double a[4];

    if (j < f->rows->n)
        rb_bem_stack_factors(k * (row->thickness - below), a);
    for (int i = 0; i < 2; i++) {
        const double *s = i ? at->im : at->re;
        double here[4], whole[3], half[3] = {0.0, 0.0, 0.0}, factor = fade;
        if (j == f->rows->n) {
            sink(row, k * below, fade, s, here);
            factor = 1.0;
        } else {
            rb_bem_stack_lift(row, a, s, here);
        }
        stress_of(row, here, whole);
        if (j == 0) {
            sink(row, k * below, fade, i ? f->top[g].im : f->top[g].re, here);
            stress_of(row, here, half);
        }
        for (int c = 0; c < 3; c++)
            w->part[i][c][g % GAUSS] = factor * whole[c] - half[c];
    }
}

/* Row and panels at a depth: how many have waves that do not fade. */
static int set_panel_amplitudes(const rb_bem_stack_field *f, double depth, amplitudes *panel,
                                int *row)
{
    const rb_bem_stack_rows *rows = f->rows;
    double top = 0.0;
    int j = 0, n = 0;

    while (j < rows->n && depth > top + rows->row[j].thickness)
        top += rows->row[j++].thickness;
    const double last = FADED / (j == 0 ? 2.0 * rows->row[0].thickness - depth : depth);
    while (n * GAUSS < f->n && f->k[n * GAUSS] <= last)
        n++;
    *row = j;
#pragma omp parallel for num_threads(rb_blas_loop_threads())                                       \
    schedule(static) if (n * GAUSS * 20.0 > rb_pairs_for_threads)
    for (int g = 0; g < n * GAUSS; g++)
        set_amplitude(f, j, g, depth - top, &panel[g / GAUSS]);
    return n;
}

/* The same, of one of the last depths without computing; NULL: out of memory. */
static const layer_of_waves *amplitudes_at(rb_bem_stack_field *f, double depth)
{
    for (int k = 0; k < KEPT; k++)
        if (f->kept[k].panel && f->kept[k].depth == depth)
            return &f->kept[k];
    layer_of_waves *next = &f->kept[f->oldest];
    f->oldest = (f->oldest + 1) % KEPT;
    if (!next->panel)
        next->panel = malloc((size_t)(f->n / GAUSS) * sizeof *next->panel);
    if (!next->panel)
        return NULL;
    next->depth = depth;
    next->n = set_panel_amplitudes(f, depth, next->panel, &next->row);
    return next;
}

/* From panel to panel of one width exp(ikx) changes by a factor, and is computed anew after so
 * many. */
enum { ANEW = 32 };

static void add_waves(const rb_bem_stack_field *f, int n, const amplitudes *panel, double x,
                      double stress[3])
{
    double sum[3] = {0.0, 0.0, 0.0}, re[GAUSS], im[GAUSS], width = 0.0, turn = 1.0, around = 0.0;

    for (int j = 0; j < n; j++) {
        const double *k = &f->k[j * GAUSS], step = j ? k[0] - k[-GAUSS] : 0.0;
        const int goes_on = j % ANEW && fabs(step - width) <= 1e-12 * k[0];
        if (!goes_on) {
            width = step;
            turn = cos(width * x);
            around = sin(width * x);
        }
        for (int g = 0; g < GAUSS && goes_on; g++) {
            const double before = re[g];
            re[g] = before * turn - im[g] * around;
            im[g] = before * around + im[g] * turn;
        }
        for (int g = 0; g < GAUSS && !goes_on; g++) {
            re[g] = cos(k[g] * x);
            im[g] = sin(k[g] * x);
        }
        const amplitudes *w = &panel[j];
        for (int g = 0; g < GAUSS; g++) {
            sum[0] += re[g] * w->part[0][0][g] - im[g] * w->part[1][0][g];
            sum[1] += re[g] * w->part[0][1][g] - im[g] * w->part[1][1][g];
            sum[2] -= re[g] * w->part[1][2][g] + im[g] * w->part[0][2][g]; /* sxy = i X */
        }
    }
    for (int c = 0; c < 3; c++)
        stress[c] += sum[c];
}

rb_status rb_bem_stack_field_add(rb_bem_stack_field *f, rb_bem_points points, double *stress,
                                 rb_message *why)
{
    double low = f->load.x[0], high = f->load.x[f->load.n - 1];
    int stop = 0;

    for (int i = 0; i < points.n; i++) {
        const double x = points.xy[2 * i], depth = points.xy[2 * i + 1];
        low = fmin(low, x);
        high = fmax(high, x);
        if (!(depth >= 0.0 && (depth <= f->rows->height || f->rows->elastic_base)))
            return rb_fail(why, RB_EINVAL, "point %d at (%g, %g) lies outside the body", i, x,
                           depth);
    }
    const rb_status s = high - low > f->reach ? make_waves(f, high - low, why) : RB_OK;
    if (s != RB_OK)
        return s;
    /* points of one depth have the same waves */
    for (int first = 0, next; first < points.n; first = next) {
        const double depth = points.xy[2 * first + 1];
        const layer_of_waves *waves = amplitudes_at(f, depth);
        if (!waves)
            return RB_ENOMEM;
        for (next = first; next < points.n && points.xy[2 * next + 1] == depth;)
            next++;
#pragma omp parallel for num_threads(rb_blas_loop_threads())                                       \
    schedule(static) if ((double)waves->n * GAUSS * (next - first) > rb_pairs_for_threads)
        for (int i = first; i < next; i++) {
            for (int c = 0; c < 3 && waves->row > 0; c++)
                stress[3 * i + c] = 0.0;
            if (!rb_interrupted_in_loop(&stop))
                add_waves(f, waves->n, waves->panel, points.xy[2 * i], stress + 3 * i);
        }
    }
    return stop ? RB_INTERRUPTED : RB_OK;
}
