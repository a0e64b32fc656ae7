/* Sums of waves exp(imx) on rings, tabulated by Chebyshev's polynomials on panels that
 * grow with the distance from the load. */
#include "bem/internal.h"
#include "bem/layers/panels.h"
#include "bem/layers/ring.h"
#include "base/blas.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef double complex cplx;

/* ---- Sums of waves ----------------------------------------------------------------- */

/* What a thin cover adds to the disc has waves up to 20 radii over its thickness, which
 * may be millions.  The first ones are summed one by one.  From there on coefficients are
 * smooth: 8 panels of waves to an octave, on each of which they are a polynomial through
 * NODES of its places, so that a panel's sum is that of few coefficients times sums over
 * polynomials, which a panel of twice the length has from those of its two halves. */
enum { NODES = 16, SINGLE = rb_ring_smooth_from, TO_OCTAVE = 8, SHORT = SINGLE / TO_OCTAVE };

typedef struct {
    double linear[3]; /* the primitive of wave 0 over x */
    int real;         /* all coefficients are: N and T are odd in x, C is even */
    int singles;
    cplx (*single)[3]; /* of waves 1 ... singles */
    int octaves;
    cplx (*panel)[NODES][3];       /* octaves x TO_OCTAVE */
    double on_short[SHORT][NODES]; /* Lagrange's polynomials at the waves of a short panel */
    double half[2][NODES][NODES];  /* [h][i][k]: polynomial k of a panel at node i of its
                                      half h */
} wave_sum;

static double node(int k)
{
    return -cos(M_PI * (k + 0.5) / NODES);
}

/* Of the NODES places in (-1, 1), at t. */
static void lagrange(double t, double value[NODES])
{
    double sum = 0.0;
    for (int k = 0; k < NODES; k++) {
        const double apart = t - node(k);
        if (apart == 0.0) {
            memset(value, 0, NODES * sizeof *value);
            value[k] = 1.0;
            return;
        }
        value[k] = (k % 2 ? -1.0 : 1.0) * sin(M_PI * (k + 0.5) / NODES) / apart;
        sum += value[k];
    }
    for (int k = 0; k < NODES; k++)
        value[k] /= sum;
}

/* Coefficients of the primitive over x. */
static void primitive_of(const rb_bem_wheel *wheel, rb_ring_waves *waves, double m, wave_sum *s,
                         cplx c[3])
{
    waves(wheel, m, c);
    for (int k = 0; k < 3; k++) {
        s->real = s->real && cimag(c[k]) == 0.0;
        c[k] *= -I / m;
    }
}

static void wave_sum_free(wave_sum *s)
{
    if (s) {
        free(s->single);
        free(s->panel);
    }
    free(s);
}

static wave_sum *wave_sum_make(const rb_bem_wheel *wheel, rb_ring_waves *waves, int last)
{
    wave_sum *s = calloc(1, sizeof *s);
    cplx zero[3];

    if (!s)
        return NULL;
    s->real = 1;
    s->singles = last < SINGLE ? last : SINGLE - 1;
    for (double m = SINGLE; m <= last; m *= 2.0)
        s->octaves++;
    s->single = calloc((size_t)s->singles + 1, sizeof *s->single);
    s->panel = calloc((size_t)s->octaves * TO_OCTAVE + 1, sizeof *s->panel);
    if (!s->single || !s->panel) {
        wave_sum_free(s);
        return NULL;
    }
    waves(wheel, 0.0, zero);
    s->linear[0] = creal(zero[0]);
    s->linear[1] = creal(zero[1]);
    s->linear[2] = cimag(zero[2]);
    for (int m = 1; m <= s->singles; m++)
        primitive_of(wheel, waves, m, s, s->single[m - 1]);
    for (int p = 0; p < s->octaves * TO_OCTAVE; p++) {
        const double length = ldexp(SHORT, p / TO_OCTAVE),
                     first = (TO_OCTAVE + p % TO_OCTAVE) * length;
        for (int k = 0; k < NODES; k++)
            primitive_of(wheel, waves, first - 0.5 + 0.5 * length * (1.0 + node(k)), s,
                         s->panel[p][k]);
    }
    for (int r = 0; r < SHORT; r++)
        lagrange((2 * r + 1.0) / SHORT - 1.0, s->on_short[r]);
    for (int h = 0; h < 2; h++)
        for (int i = 0; i < NODES; i++)
            lagrange(0.5 * (node(i) + 2 * h - 1), s->half[h][i]);
    return s;
}

static rb_ring_answer wave_sum_at(const wave_sum *s, double x)
{
    const cplx z = cos(x) + I * sin(x);
    cplx sum[3] = {0.0};
    cplx over[NODES] = {0.0}; /* sum over the waves of a panel of polynomial k exp(irx) */

    for (int m = s->singles; m >= 1; m--)
        for (int d = 0; d < 3; d++)
            sum[d] = (sum[d] + s->single[m - 1][d]) * z;
    /* The long waves, panel by panel. */
    for (int r = 0; r < SHORT && s->octaves > 0; r++)
        for (int k = 0; k < NODES; k++)
            over[k] += s->on_short[r][k] * (cos(r * x) + I * sin(r * x));
    for (int o = 0; o < s->octaves; o++) {
        const double length = ldexp(SHORT, o);
        for (int q = 0; q < TO_OCTAVE; q++) {
            const double phase = (TO_OCTAVE + q) * length * x;
            const cplx turn = cos(phase) + I * sin(phase);
            cplx(*const c)[3] = s->panel[o * TO_OCTAVE + q];
            for (int d = 0; d < 3; d++) {
                cplx own = 0.0;
                for (int k = 0; k < NODES; k++)
                    own += c[k][d] * over[k];
                sum[d] += turn * own;
            }
        }
        const cplx turn = cos(length * x) + I * sin(length * x);
        cplx longer[NODES] = {0.0};
        for (int i = 0; i < NODES; i++)
            for (int k = 0; k < NODES; k++)
                longer[k] += over[i] * (s->half[0][i][k] + turn * s->half[1][i][k]);
        memcpy(over, longer, sizeof over);
    }
    return (rb_ring_answer){creal(sum[0]) + s->linear[0] * x, creal(sum[1]) + s->linear[1] * x,
                            cimag(sum[2]) + s->linear[2] * x};
}

/* ---- Panels of x ------------------------------------------------------------------- */

/* The waves fall like exp(-2 m ln(R/inner)): their sum is analytic within twice that
 * around the load, and what is left further away varies over lengths of the distance. */
enum { ORDER = 16 };

typedef double chebyshev[ORDER][3];

static inline chebyshev *panel_of(const rb_ring_table *t, int side, int k)
{
    return (chebyshev *)(void *)t->chebyshev + (side * t->panels + k);
}

static void fill_panel(const rb_bem_wheel *wheel, const wave_sum *sum, rb_ring_primitive *rest,
                       const rb_ring_table *table, int side, int k)
{
    const int octave = k / RB_PANELS_PER_OCTAVE;
    double value[ORDER][3];

    for (int i = 0; i < ORDER; i++) {
        const double part = (k % RB_PANELS_PER_OCTAVE + rb_panel_point(ORDER, i)) /
                            RB_PANELS_PER_OCTAVE,
                     y = octave == 0 ? part : ldexp(0.5 * (1.0 + part), octave),
                     x = (side ? -1.0 : 1.0) * table->smallest * y;
        const rb_ring_answer s = wave_sum_at(sum, x),
                             r = rest ? rest(wheel, x) : (rb_ring_answer){0.0, 0.0, 0.0};
        value[i][0] = s.N + r.N;
        value[i][1] = s.T + r.T;
        value[i][2] = s.C + r.C;
    }
    rb_panel_chebyshev(ORDER, (const double(*)[3])value, *panel_of(table, side, k));
}

void rb_ring_table_free(rb_ring_table *table)
{
    free(table->chebyshev);
    memset(table, 0, sizeof *table);
}

rb_status rb_ring_table_create(const rb_bem_wheel *wheel, rb_ring_waves *waves, int last,
                               rb_ring_primitive *rest, double smallest, double reach,
                               rb_ring_table *table)
{
    double t;
    const int panels = rb_panel_of(1.001 * reach / smallest, &t) + 1;
    wave_sum *sum = wave_sum_make(wheel, waves, last);

    *table = (rb_ring_table){smallest, panels, sum && sum->real ? 1 : 2,
                             rb_alloc((size_t)panels * 2, sizeof(chebyshev) / sizeof(double))};
    const rb_status s = sum && table->chebyshev ? RB_OK : RB_ENOMEM;
#pragma omp parallel for num_threads(rb_blas_loop_threads()) schedule(static) if (panels > 32)
    for (int k = 0; k < table->sides * panels; k++)
        if (s == RB_OK)
            fill_panel(wheel, sum, rest, table, k / panels, k % panels);
    wave_sum_free(sum);
    return s;
}

rb_ring_answer rb_ring_table_at(const rb_ring_table *table, double x)
{
    double t, b[3] = {0.0}, before[3] = {0.0};
    const int k = rb_panel_of(fabs(x) / table->smallest, &t);
    const int mirrored = x < 0.0 && table->sides == 1;
    chebyshev *const c = panel_of(table, x < 0.0 && !mirrored, k);

    for (int j = ORDER - 1; j > 0; j--) /* Clenshaw */
        for (int d = 0; d < 3; d++) {
            const double next = 2.0 * t * b[d] - before[d] + (*c)[j][d];
            before[d] = b[d];
            b[d] = next;
        }
    for (int d = 0; d < 3; d++)
        b[d] = t * b[d] - before[d] + (*c)[0][d];
    return mirrored ? (rb_ring_answer){-b[0], -b[1], b[2]} : (rb_ring_answer){b[0], b[1], b[2]};
}
