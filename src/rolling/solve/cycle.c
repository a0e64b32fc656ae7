/* What fretting has done to each element of the surfaces in a cycle, as results (Q1). */
#include "base/base.h"
#include "rolling/solve/cycle.h"

#include <math.h>
#include <stdlib.h>

/* Two peaks that differ by less than this part are equal. */
static const double SAME = 1e-9;

void rb_rolling_cycle_free(rb_rolling_cycle *c)
{
    if (!c)
        return;
    rb_arena_free(&c->memory);
    free(c);
}

static double *sum_of(const rb_rolling_cycle *c, int which)
{
    return c->sums + (size_t)which * (size_t)c->n;
}

double *rb_rolling_cycle_extreme(const rb_rolling_cycle *c, int body, int which)
{
    return c->extreme + (size_t)(body * RB_CYCLE_EXTREMES + which) * ((size_t)c->n + 2);
}

/* Of two that rounding alone tells apart, as in a symmetric contact, that on the right; a place
 * only where there is something. */
static rb_rolling_peak peak_of(int n, const double *x, const double *value)
{
    rb_rolling_peak best = {value ? 0.0 : NAN, NAN};

    for (int i = 0; value && i < n; i++)
        if (value[i] > 0.0 && value[i] >= best.value * (1.0 - SAME))
            best = (rb_rolling_peak){fmax(value[i], best.value), x[i]};
    return best;
}

/* Smith, Watson and Topper's parameter at a place of a body: largest tension times amplitude of the
 * strain along the surface. */
static double swt_at(const rb_rolling_cycle *c, int body, int k)
{
    return fmax(rb_rolling_cycle_extreme(c, body, RB_CYCLE_TENSION)[k], 0.0) * 0.5 *
           (rb_rolling_cycle_extreme(c, body, RB_CYCLE_MOST_STRAIN)[k] -
            rb_rolling_cycle_extreme(c, body, RB_CYCLE_LEAST_STRAIN)[k]);
}

/* The columns that depend on the stress of a body. */
static void set_body(const rb_rolling_cycle *c, int body, const double *ruiz_1, double *tension,
                     double *ruiz_2, double *swt, double *shear)
{
    for (int i = 0; i < c->n; i++) {
        tension[i] = rb_rolling_cycle_extreme(c, body, RB_CYCLE_TENSION)[i];
        ruiz_2[i] = fmax(tension[i], 0.0) * ruiz_1[i];
        swt[i] = swt_at(c, body, i);
        shear[i] = rb_rolling_cycle_extreme(c, body, RB_CYCLE_SHEAR)[i];
    }
}

/* Also at the edges of the contact, where the tension behind it peaks between midpoints. */
static rb_rolling_peak swt_peak(const rb_rolling_cycle *c, int body, const rb_rolling_solution *s)
{
    rb_rolling_peak best = peak_of(s->n, s->x, body ? s->swt_b : s->swt);

    for (int side = 0; side < 2; side++)
        if (swt_at(c, body, c->n + side) > best.value * (1.0 - SAME))
            best = (rb_rolling_peak){swt_at(c, body, c->n + side), c->edge[side]};
    return best;
}

void rb_rolling_cycle_results(const rb_rolling_model *model, rb_rolling_solution *s)
{
    const rb_rolling_cycle *c = model->cycle;
    const rb_rolling_peak none = {NAN, NAN};
    rb_rolling_fretting *f = &s->fretting;

    *f = (rb_rolling_fretting){NAN, none, none, none, none, none, none, none, none, none};
    if (!s->fretting_work)
        return;
    if (!c) { /* the cycle has not begun */
        double *const column[] = {s->fretting_work, s->slip_range, s->ruiz_1,        s->tension,
                                  s->ruiz_2,        s->swt,        s->tresca_shear,  s->tension_b,
                                  s->ruiz_2_b,      s->swt_b,      s->tresca_shear_b};
        for (size_t k = 0; k < sizeof column / sizeof *column; k++)
            for (int i = 0; i < s->n && column[k]; i++)
                column[k][i] = NAN;
        return;
    }
    f->work = 0.0;
    for (int i = 0; i < s->n; i++) {
        s->fretting_work[i] = sum_of(c, RB_CYCLE_WORK)[i];
        s->slip_range[i] = sum_of(c, RB_CYCLE_MOST_SLIP)[i] - sum_of(c, RB_CYCLE_LEAST_SLIP)[i];
        s->ruiz_1[i] = sum_of(c, RB_CYCLE_FRICTION)[i] * s->slip_range[i];
        f->work += s->fretting_work[i] * s->h[i];
    }
    set_body(c, 0, s->ruiz_1, s->tension, s->ruiz_2, s->swt, s->tresca_shear);
    if (s->tension_b)
        set_body(c, 1, s->ruiz_1, s->tension_b, s->ruiz_2_b, s->swt_b, s->tresca_shear_b);
    const struct {
        rb_rolling_peak *peak;
        const double *of;
    } peaks[] = {{&f->fretting_work, s->fretting_work},
                 {&f->slip_range, s->slip_range},
                 {&f->ruiz_1, s->ruiz_1},
                 {&f->ruiz_2, s->ruiz_2},
                 {&f->tresca_shear, s->tresca_shear},
                 {&f->ruiz_2_b, s->ruiz_2_b},
                 {&f->tresca_shear_b, s->tresca_shear_b}};
    for (size_t k = 0; k < sizeof peaks / sizeof *peaks; k++)
        *peaks[k].peak = peak_of(s->n, s->x, peaks[k].of);
    f->swt = swt_peak(c, 0, s);
    if (s->tension_b)
        f->swt_b = swt_peak(c, 1, s);
}
