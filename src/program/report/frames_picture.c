/* A history frame by frame: the tractions over x, and below them the force over the steps. */
#include "program/report/internal.h"

#include <math.h>

enum { FRAMES = 60 }; /* at most; at four in a second, a quarter of a minute */

typedef struct {
    const rb_rolling_case *rc;
    const rb_rolling_history *h;
    const rb_rolling_states *states;
    rb_report_length length; /* of one unit of the x axis */
    rb_report_unit stress;
    int frames;
    double from, to;       /* x axis, in its units */
    double largest, least; /* of p, q and the bounds of q, in units of stress */
} view;

/* The step that frame k shows: the first one, the last one, and between them equal distances. */
static int step_of(const view *v, int k)
{
    return v->frames > 1 ? (int)lround((double)k * (v->h->n - 1) / (v->frames - 1)) : 0;
}

static double shown(const view *v, double stress)
{
    return rb_unit_shown(v->h->units, "MPa", stress) / v->stress.size;
}

static double shown_x(const view *v, double x)
{
    return rb_unit_shown(v->h->units, "mm", x) / v->length.size;
}

/* Friction is mu p at most, but where mu is not the same in the whole contact, or the interface
 * yields. */
static int has_bound(const view *v)
{
    return v->rc->friction.law == RB_FRICTION_constant && v->rc->friction.heat == 0.0 &&
           v->rc->yield_stress == 0.0 && rb_rolling_largest_mu(v->rc) > 0.0;
}

static double mu_of(const view *v, int step)
{
    return v->h->mu ? v->h->mu[step] : rb_rolling_largest_mu(v->rc);
}

/* What touches in any of the steps, with a margin, and the range of the tractions. */
static void find_ranges(view *v)
{
    const rb_rolling_states *s = v->states;
    double left = INFINITY, right = -INFINITY;

    for (int k = 0; k < v->frames; k++)
        for (int i = 0; i < s->n; i++) {
            const int step = step_of(v, k), at = step * s->n + i;
            if (s->zone[at] == RB_ZONE_SEPARATED)
                continue;
            left = fmin(left, s->x[i] - s->h[i] / 2);
            right = fmax(right, s->x[i] + s->h[i] / 2);
            v->largest = fmax(v->largest, fmax(s->p[at], s->q[at]));
            v->least = fmin(v->least, s->q[at]);
            if (has_bound(v))
                v->least = fmin(v->least, -mu_of(v, step) * s->p[at]);
        }
    const double margin = 0.1 * (right - left);
    v->from = fmax(left - margin, s->x[0] - s->h[0] / 2);
    v->to = fmin(right + margin, s->x[s->n - 1] + s->h[s->n - 1] / 2);
}

static double place(const view *v, int i)
{
    return v->h->step > 0.0 ? v->h->distance[i] : v->h->time ? v->h->time[i] : i + 1;
}

/* Q/(mu P), or P where no friction acts. */
static double force(const view *v, int i)
{
    return isfinite(v->h->force_ratio[i]) ? v->h->force_ratio[i] : v->h->normal_load[i];
}

static void let_frames(FILE *out, const view *v)
{
    const rb_rolling_states *s = v->states;
    const char *load = rb_unit_name(v->h->units, "N/mm");
    char name[20], force_text[80];

    fputs("$drawn << EOD\nx p q bound\n", out);
    for (int k = 0; k < v->frames; k++)
        for (int i = 0; i < s->n; i++) {
            const int at = step_of(v, k) * s->n + i;
            fprintf(out, "%.6g %.6g %.6g %.6g\n", shown_x(v, s->x[i]), shown(v, s->p[at]),
                    shown(v, s->q[at]), shown(v, mu_of(v, step_of(v, k)) * s->p[at]));
        }
    fputs("EOD\n$zones << EOD\nframe from to zone\n", out);
    for (int k = 0; k < v->frames; k++)
        for (int i = 0, end = 0; i < s->n; i = end) { /* runs of equal zones */
            const int *zone = s->zone + (size_t)step_of(v, k) * (size_t)s->n;
            for (end = i; end < s->n && zone[end] == zone[i]; end++)
                ;
            if (zone[i] != RB_ZONE_SEPARATED && rb_rolling_largest_mu(v->rc) > 0.0)
                fprintf(out, "%d %.6g %.6g %d\n", k + 1, shown_x(v, s->x[i] - s->h[i] / 2),
                        shown_x(v, s->x[end - 1] + s->h[end - 1] / 2), zone[i]);
        }
    fputs("EOD\n$frames << EOD\nx force\n", out);
    for (int k = 0; k < v->frames; k++)
        fprintf(out, "%.6g %.6g\n", place(v, step_of(v, k)), force(v, step_of(v, k)));
    fputs("EOD\n$steps << EOD\nx force\n", out);
    for (int i = 0; i < v->h->n; i++)
        fprintf(out, "%.6g %.6g\n", place(v, i), force(v, i));
    fputs("EOD\n", out);
    for (int k = 0; k < v->frames; k++) {
        const int i = step_of(v, k);
        force_text[0] = '\0';
        if (isfinite(v->h->force_ratio[i]))
            rb_append(force_text, sizeof force_text, ",  Q/(μP) = %.3f", v->h->force_ratio[i]);
        rb_format(name, sizeof name, "title%d", k + 1);
        rb_report_let_text(out, name, "{/:Bold %s}   step %d of %d,  P = %s %s%s",
                           v->h->step > 0.0 ? "Transient rolling" : "Static history", i + 1,
                           v->h->n, RB_REPORT_NUMBER(v->h->normal_load[i], 4), load, force_text);
    }
}

static rb_status write_table(FILE *out, const void *of, const rb_report_style *style)
{
    return rb_report_history(out, of, NULL, "", style);
}

static void write_inputs(FILE *out, rb_report_canvas canvas, const void *context)
{
    const view *v = context;
    const int moves = isfinite(v->h->force_ratio[v->h->n - 1]);
    const double largest = shown(v, v->largest), least = shown(v, v->least);
    double low = 0.0, high = 0.0;

    (void)canvas;
    rb_report_let_table(out, "table", write_table, v->h);
    rb_report_let_units(out, v->h->units);
    let_frames(out, v);
    for (int i = 0; i < v->h->n; i++) {
        low = fmin(low, force(v, i));
        high = fmax(high, force(v, i));
    }
    const struct {
        const char *name;
        double x;
    } ranges[] = {{"x_from", shown_x(v, v->from)},
                  {"x_to", shown_x(v, v->to)},
                  {"x_step", rb_report_round_step(shown_x(v, v->to - v->from) / 6.0)},
                  /* no half increments */
                  {"place_step", v->h->step > 0.0 || v->h->time
                                     ? 0.0
                                     : fmax(1.0, rb_report_round_step((v->h->n - 1) / 8.0))},
                  {"p_from", least - 0.06 * (largest - least)},
                  {"p_to", largest + 0.06 * (largest - least)},
                  {"force_from", low - 0.1 * (high - low)},
                  {"force_to", high + 0.1 * (high - low) + (high == low)},
                  {"force_step", rb_report_round_step((high - low + (high == low)) / 4.0)}};
    for (size_t k = 0; k < sizeof ranges / sizeof *ranges; k++)
        rb_report_let(out, ranges[k].name, ranges[k].x);
    rb_report_let_whole(out, "frames", v->frames);
    rb_report_let_whole(out, "rows", v->states->n);
    rb_report_let_whole(out, "bounded", has_bound(v));
    rb_report_let_whole(out, "has_friction", rb_rolling_largest_mu(v->rc) > 0.0);
    rb_report_let_text(out, "x_label", "x %s%s", v->length.label,
                       v->h->step > 0.0 ? "   (rolling towards +x →)" : "");
    rb_report_let_text(out, "p_label", "traction%s", RB_REPORT_COUNTED_IN(0, v->stress.name));
    rb_report_let_text(out, "force_label", moves ? "Q/(μP)" : "P  [%s]",
                       rb_unit_name(v->h->units, "N/mm"));
    rb_report_let_text(out, "step_label", "%s",
                       v->h->step > 0.0 ? "rolled distance / a"
                       : v->h->time     ? "time  [s]"
                                        : "increment");
    rb_report_let_bodies(out, v->rc, v->h->units);
}

rb_status rb_report_frames(FILE *out, rb_report_canvas canvas, const rb_rolling_case *rc,
                           const rb_rolling_history *history, const rb_rolling_states *states,
                           rb_message *why)
{
    if (history->n < 1 || states->steps < history->n)
        return rb_fail(why, RB_EINVAL, "no steps to draw");
    view v = {.rc = rc,
              .h = history,
              .states = states,
              .frames = history->n < FRAMES ? history->n : FRAMES};
    find_ranges(&v);
    if (!(v.from < v.to))
        return rb_fail(why, RB_EINVAL, "nothing touches in any step");
    v.length = rb_report_length_axis(history->units,
                                     rb_unit_shown(history->units, "mm", 0.5 * (v.to - v.from)));
    v.stress =
        rb_report_axis_unit(history->units, "MPa", rb_unit_shown(history->units, "MPa", v.largest));
    return rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, "frames", write_inputs, &v, why);
}
