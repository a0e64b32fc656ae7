/* The largest stresses along bonds, on both sides of them, and in layers far from the contact. */
#include "rolling/stress/search.h"

#include <gsl/gsl_sort.h>
#include <math.h>

enum { MOST_OUTWARDS = 400 };

/* Places along the bond: the candidates, as far from each other as fits what changes at this depth,
 * and outwards to 5 half-widths and 5 depths from the middle.  Returns how many; s: room for them.
 */
static int along_the_bond(const rb_search *f, double depth, double *s)
{
    const double half = 0.5 * (f->high - f->low),
                 most = f->radius > 0.0 ? f->reach : fmax(f->reach, 4.0 * half + 5.0 * depth);
    int n = 0;
    for (int k = 0; k < f->candidates; k++)
        if (n == 0 || f->s[k] - s[n - 1] >= 0.1 * depth)
            s[n++] = f->s[k];
    double step = fmax(half / 50.0, 0.3 * depth);
    for (double away = f->reach; away < most && n + 2 <= f->candidates + MOST_OUTWARDS;) {
        away = fmin(away + step, most);
        s[n++] = f->low - away;
        s[n++] = f->high + away;
        step = fmin(1.2 * step, 0.05 * most);
    }
    gsl_sort(s, 1, (size_t)n);
    return n;
}

/* The highest peak of one measure among n places along a side of the bond.  What only falls off to
 * the end of the places is no peak. */
static rb_status peak_of_bond(const rb_search *f, const rb_search_strip *in, double depth,
                              rb_search_measure *of, int n, const double *s,
                              const rb_rolling_stress *at, rb_rolling_extremum *best,
                              rb_message *why)
{
    double most = 0.0, largest = 0.0, highest = 0.0;
    *best = (rb_rolling_extremum){0.0, NAN, NAN, in->material};
    for (int i = 0; i < n; i++)
        largest = fmax(largest, fmax(at[i].von_mises, fabs(at[i].hydrostatic)));
    for (int i = 1; i + 1 < n; i++)
        if (of(&at[i]) >= of(&at[i - 1]) && of(&at[i]) > of(&at[i + 1]))
            most = fmax(most, of(&at[i]));
    if (!(most > 1e-7 * largest)) /* less is what waves leave of each other */
        return RB_OK;
    for (int i = 1; i + 1 < n; i++) {
        double top = of(&at[i]), place[2] = {s[i], depth};
        if (!(top >= of(&at[i - 1]) && top > of(&at[i + 1]) && top > 0.9 * most))
            continue;
        const rb_status status =
            rb_search_climb(f, of, in, 0.5 * fmax(s[i] - s[i - 1], s[i + 1] - s[i]), 0.0,
                            (1.0 - 1e-3) * best->value, place, &top, why);
        if (status != RB_OK)
            return status;
        rb_search_keep(f, in, place, top, &highest, best);
    }
    return RB_OK;
}

rb_status rb_search_bond(rb_search *f, int which, double searched, rb_rolling_stress_maxima *maxima,
                         rb_message *why)
{
    const rb_rolling_body *a = &f->model->rc->a;
    const int layers = rb_rolling_layers(a);
    const double bond = layers > 0 ? rb_rolling_bond_depth(a, which + 1) : a->cover;
    if (searched > 0.0 && searched < bond)
        return RB_OK;
    const int sides = which + 1 < layers || (layers > 0 && a->base_young > 0.0) ? 2 : 1;
    const rb_search_strip side[2] = {layers > 0 ? rb_search_strip_of(a, which, INFINITY)
                                                : (rb_search_strip){RB_MATERIAL_LAYER, 0.0, bond},
                                     layers > 0 ? rb_search_strip_of(a, which + 1, INFINITY)
                                                : (rb_search_strip){0}};
    const size_t most = (size_t)f->candidates + MOST_OUTWARDS;
    rb_arena scratch = {0};
    double *s = rb_arena_doubles(&scratch, most, 2);
    rb_rolling_stress *at = rb_arena_zeros(&scratch, most, sizeof *at);
    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    double *depth = s + most;
    const int n = along_the_bond(f, bond, s);
    for (int k = 0; k < n; k++)
        depth[k] = bond;
    rb_status status = RB_OK;
    const int first = RB_SEARCH_IN_BODY + which * RB_SEARCH_OF_BOND;
    f->along_bond = 1;
    for (int k = 0; k < sides && status == RB_OK; k++) {
        status = rb_search_stress(f, &side[k], n, s, depth, at, why);
        for (int i = 0; i < RB_SEARCH_OF_BOND && status == RB_OK; i++)
            if ((i == RB_SEARCH_BELOW_BOND) == k)
                status = peak_of_bond(f, &side[k], bond, rb_search_measure_of(first + i), n, s, at,
                                      rb_rolling_maximum(maxima, first + i), why);
    }
    f->along_bond = 0;
    return rb_arena_done(&scratch, status);
}

/* ---- Far from the contact -------------------------------------------------------------- */

/* A stiff layer takes up what stretches the base over a length l = d E/E_base, many times that
 * over which it bends.  Far behind the contact friction Q pulls it like l Q/x, the pressure P
 * pushes it together like (l/x)^2 P: the tension may be largest at a few l P/Q.  0: not so. */
static double far_reach(const rb_search *f)
{
    enum { AFFORDABLE = 6000 }; /* thicknesses of the first layer: the number of its waves */
    const rb_rolling_body *a = &f->model->rc->a;
    const rb_bem_edge_load *load = rb_rolling_field_load(f->field);
    double stretched = 0.0, P = 0.0, Q = 0.0;
    for (int k = 0; k < rb_rolling_layers(a) && a->base_young > 0.0; k++)
        stretched += (rb_rolling_bond_depth(a, k + 1) - rb_rolling_bond_depth(a, k)) *
                     rb_rolling_layer_of(a, k).young / a->base_young;
    for (int j = 0; j + 1 < load->n; j++) {
        const double half = 0.5 * (load->x[j + 1] - load->x[j]);
        P += half * (load->p[j] + load->p[j + 1]);
        Q += half * (load->q[j] + load->q[j + 1]);
    }
    const double most = AFFORDABLE * rb_rolling_bond_depth(a, 1),
                 reach = fabs(Q) > 1e-3 * P ? fmin(4.0 * stretched * P / fabs(Q), most) : 0.0;
    return stretched > rb_rolling_layers_depth(a) && reach > f->reach ? reach : 0.0;
}

/* The tension along the top or the bottom of a layer, beyond what has been searched: in the body,
 * and at its bond. */
static rb_status tension_far_away(rb_search *f, int layer, int at_bottom, int n, double *s,
                                  rb_rolling_stress *at, rb_rolling_stress_maxima *maxima,
                                  rb_message *why)
{
    const rb_search_strip in = rb_search_strip_of(&f->model->rc->a, layer, INFINITY);
    const double deep = at_bottom ? in.bottom : in.top;
    const int bond = layer - !at_bottom;
    rb_rolling_extremum found, *const to[2] = {&maxima->tension,
                                               bond < 0    ? NULL
                                               : at_bottom ? &maxima->bond[bond].tension_above
                                                           : &maxima->bond[bond].tension_below};
    for (int k = 0; k < n; k++)
        s[n + k] = deep;
    rb_status status = rb_search_stress(f, &in, n, s, s + n, at, why);
    for (int i = 0; i < 2 && status == RB_OK; i++) {
        if (to[i])
            status = peak_of_bond(f, &in, deep,
                                  rb_search_measure_of(i ? RB_SEARCH_IN_BODY + RB_SEARCH_BELOW_BOND
                                                         : RB_SEARCH_TENSION),
                                  n, s, at, &found, why);
        if (to[i] && status == RB_OK && !isnan(found.x) &&
            !(found.value <= to[i]->value * (1.0 + 1e-7)))
            *to[i] = found;
    }
    return status;
}

rb_status rb_search_far(rb_search *f, double searched, rb_rolling_stress_maxima *maxima,
                        rb_arena *memory, rb_message *why)
{
    enum { STEPS = 40 };
    const rb_rolling_body *a = &f->model->rc->a;
    const double reach = far_reach(f);
    double *s = rb_arena_doubles(memory, 2 * STEPS, 2);
    rb_rolling_stress *at = rb_arena_zeros(memory, 2 * STEPS, sizeof *at);
    if (memory->failed)
        return RB_ENOMEM;
    if (!(reach > 0.0))
        return RB_OK;
    /* they begin where the near search still was, that a peak between the two be one */
    const double from = 0.7 * f->reach;
    for (int k = 0; k < STEPS; k++) {
        const double away = from * pow(reach / from, (double)k / (STEPS - 1));
        s[STEPS - 1 - k] = f->low - away;
        s[STEPS + k] = f->high + away;
    }
    f->reach = reach;
    rb_status status = RB_OK;
    for (int k = 0; k < 2 * rb_rolling_layers(a) && status == RB_OK; k++)
        if (!(searched > 0.0 && searched < rb_rolling_bond_depth(a, k / 2 + k % 2)))
            status = tension_far_away(f, k / 2, k % 2, 2 * STEPS, s, at, maxima, why);
    return status;
}
