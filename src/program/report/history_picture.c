/* Picture of a history: creepage or shift, force, stick over the distance or the
 * increments; half-width, load and approach over the time of static contact. */
#include "program/report/internal.h"

#include <math.h>

#define ROUNDING 1e-9 /* a band below this part of its curve is that of a given value */

/* What a panel shows. */
typedef enum { MOTION, FORCE, STICK, HALF_WIDTH, LOAD, APPROACH } quantity;

typedef struct {
    const rb_rolling_case *rc;
    const rb_rolling_history *h;
    int rolls;    /* 1: over the rolled distance, 0: over the increments or the time */
    int in_time;  /* 1: over the time */
    int points;   /* 1: few enough steps to mark each */
    int exponent; /* of the creepage or shift */
    double power; /* 10^exponent */
    double from, to;
    quantity named; /* whose band the key names: the first that has one */
} view;

/* Standard deviations are those of Q, because mu and P may be uncertain, too. */
static int shows_Q(const view *v)
{
    return v->h->deviations && !v->h->errors;
}

/* The column of the history, of its errors or of its standard deviations; NULL: not there. */
static const double *column_of(const view *v, const rb_rolling_history *h, quantity of)
{
    return of == MOTION  ? (v->rolls ? h->creepage : h->shift)
           : of == FORCE ? (shows_Q(v) ? h->tangential_load : h->force_ratio)
           : of == LOAD  ? h->normal_load
                         : h->approach;
}

static double value(const view *v, quantity of, int i)
{
    if (of != HALF_WIDTH)
        return column_of(v, v->h, of)[i] / (of == MOTION ? v->power : 1.0);
    const double width = v->h->contact_to[i] - v->h->contact_from[i];
    return isnan(width) ? 0.0 : 0.5 * width;
}

static const rb_rolling_history *bands_of(const view *v)
{
    return v->h->errors ? v->h->errors : v->h->deviations;
}

/* Half the width of its band. */
static double band(const view *v, quantity of, int i)
{
    const rb_rolling_history *h = bands_of(v);
    double half = 0.0;
    if (h && of == HALF_WIDTH) { /* edges that vary in opposite directions */
        if (h->contact_from && h->contact_to)
            half = 0.5 * (h->contact_from[i] + h->contact_to[i]);
    } else if (h && column_of(v, h, of))
        half = column_of(v, h, of)[i] / (of == MOTION ? v->power : 1.0);
    return isnan(half) ? 0.0 : half;
}

/* Steps at rest have no creepage. */
static int is_shown(const view *v, int i)
{
    return !v->rolls || v->h->distance[i] > 0.0;
}

static double place(const view *v, int i)
{
    return v->rolls ? v->h->distance[i] : v->in_time ? v->h->time[i] : i + 1;
}

static double largest_of(const view *v, quantity of)
{
    double most = 0.0;

    for (int i = 0; i < v->h->n; i++)
        most = fmax(most, is_shown(v, i) ? fabs(value(v, of, i)) : 0.0);
    return most;
}

static double widest(const view *v, quantity of)
{
    double most = 0.0;

    for (int i = 0; i < v->h->n; i++)
        most = fmax(most, is_shown(v, i) ? band(v, of, i) : 0.0);
    return most;
}

/* One of three, k from 1: its label, its range and tics for the values with their bands and for
 * what else must be seen, from `least` to `most`. */
static void let_panel(FILE *out, const view *v, int k, quantity of, const char *colour,
                      const char *label, double least, double most)
{
    char name[20];

    for (int i = 0; i < v->h->n; i++) {
        if (!is_shown(v, i))
            continue;
        least = fmin(least, value(v, of, i) - band(v, of, i));
        most = fmax(most, value(v, of, i) + band(v, of, i));
    }
    const double size = fmax(fabs(least), fabs(most));
    if (most - least <= 1e-6 * size || size == 0.0) { /* one value, but for rounding */
        const double margin = size > 0.0 ? 0.1 * size : 1.0;
        least -= margin;
        most += margin;
    }
    const double height = most - least;
    const struct {
        const char *name;
        double x;
    } range[] = {{"from%d", of == STICK ? 0.0 : least - 0.08 * height},
                 {"to%d", of == STICK ? 1.0 : most + 0.08 * height},
                 {"step%d", of == STICK ? 0.2 : rb_report_round_step(height / 5.0)}};
    for (size_t j = 0; j < sizeof range / sizeof *range; j++) {
        rb_format(name, sizeof name, range[j].name, k);
        rb_report_let(out, name, range[j].x);
    }
    rb_format(name, sizeof name, "label%d", k);
    rb_report_let_text(out, name, "%s", label);
    rb_format(name, sizeof name, "colour%d", k);
    rb_report_let_text(out, name, "%s", colour);
    rb_format(name, sizeof name, "band%d", k);
    rb_report_let_whole(out, name, of != STICK && bands_of(v) ? 1 + (of == v->named) : 0);
}

static void let_way(FILE *out, const view *v)
{
    char label[80];

    rb_format(label, sizeof label, "%s%s", v->rolls ? "ξ" : "shift",
              RB_REPORT_COUNTED_IN(v->exponent, v->rolls ? "" : rb_unit_name(v->h->units, "mm")));
    let_panel(out, v, 1, MOTION, "#6c3483", label, INFINITY, -INFINITY);
    rb_format(label, sizeof label, shows_Q(v) ? "Q  [%s]" : "Q/(μP)",
              rb_unit_name(v->h->units, "N/mm"));
    let_panel(out, v, 2, FORCE, "#c0392b", label, 0.0, 0.0); /* a force is seen against none */
    let_panel(out, v, 3, STICK, "#1f4e79", "stick / contact", 0.0, 1.0);
    rb_report_let_text(out, "x_label", "%s", v->rolls ? "rolled distance / a" : "increment");
}

static void let_time(FILE *out, const view *v)
{
    static const quantity shown[] = {HALF_WIDTH, LOAD, APPROACH};
    static const char *const label[] = {"half-width  [%s]", "P  [%s]", "approach  [%s]"},
                             *const unit[] = {"mm", "N/mm", "mm"},
                             *const colour[] = {"#1f4e79", "#c0392b", "#6c3483"};

    for (int k = 0; k < 3; k++) {
        char text[80];
        rb_format(text, sizeof text, label[k], rb_unit_name(v->h->units, unit[k]));
        let_panel(out, v, k + 1, shown[k], colour[k], text, 0.0, 0.0);
    }
    rb_report_let_text(out, "x_label", "time  [s]");
}

static rb_status write_table(FILE *out, const void *of, const rb_report_style *style)
{
    return rb_report_history(out, of, NULL, "", style);
}

static void write_inputs(FILE *out, rb_report_canvas canvas, const void *context)
{
    const view *v = context;
    const int last = v->h->n - 1;
    const char *unit = rb_unit_name(v->h->units, "N/mm");

    rb_report_let_table(out, "table", write_table, v->h);
    rb_report_let_units(out, v->h->units);
    fprintf(out, "$drawn << EOD\n%s\n",
            v->in_time ? "time half_width load approach band band_load band_approach"
                       : "x motion force stick band band_force");
    for (int i = 0; i < v->h->n; i++) {
        const int contact = v->h->stick[i] + v->h->slipping[i];
        if (v->in_time)
            fprintf(out, "%.9g %.9g %.9g %.9g %.9g %.9g %.9g\n", place(v, i),
                    value(v, HALF_WIDTH, i), value(v, LOAD, i), value(v, APPROACH, i),
                    band(v, HALF_WIDTH, i), band(v, LOAD, i), band(v, APPROACH, i));
        else if (is_shown(v, i))
            fprintf(out, "%.9g %.9g %.9g %.9g %.9g %.9g\n", place(v, i), value(v, MOTION, i),
                    value(v, FORCE, i), contact ? (double)v->h->stick[i] / contact : 0,
                    band(v, MOTION, i), band(v, FORCE, i));
    }
    fputs("EOD\n", out);
    rb_report_let(out, "x_from", v->from);
    rb_report_let(out, "x_to", v->to);
    /* no half increments */
    rb_report_let(
        out, "x_step",
        v->rolls || v->in_time ? 0.0 : fmax(1.0, rb_report_round_step((v->to - v->from) / 8.0)));
    rb_report_let_whole(out, "few", v->points);
    rb_report_let_text(
        out, "title", "{/:Bold %s}   %d steps,  at the end P = %s %s,  Q = %s %s",
        v->rolls     ? "Transient rolling"
        : v->in_time ? "Static contact in time"
                     : "Static history",
        v->h->n, RB_REPORT_NUMBER(v->h->normal_load[last], 5), unit,
        RB_REPORT_NUMBER(rb_report_tidy(v->h->tangential_load[last], v->h->normal_load[last]), 5),
        unit);
    rb_report_let_bodies(out, v->rc, v->h->units);
    if (bands_of(v)) { /* a key for one panel */
        const quantity of = v->named;
        const char *name = of == FORCE || of == LOAD ? "N/mm" : "mm";
        const int pure = (of == MOTION && v->rolls) || (of == FORCE && !shows_Q(v));
        rb_report_let_band(
            out, v->h->errors != NULL, widest(v, of) * (of == MOTION ? v->power : 1.0),
            pure ? "" : rb_unit_name(v->h->units, name), rb_report_place_of(canvas).titled);
    }
    (v->in_time ? let_time : let_way)(out, v);
}

rb_status rb_report_history_picture(FILE *out, rb_report_canvas canvas, const rb_rolling_case *rc,
                                    const rb_rolling_history *history, rb_message *why)
{
    if (history->n < 1)
        return rb_fail(why, RB_EINVAL, "no steps to draw");
    view v = {.h = history,
              .rolls = history->step > 0.0,
              .in_time = history->step == 0.0 && history->time,
              .points = history->n <= 40,
              .power = 1.0}; /* as value() reads it below */
    v.exponent = rb_report_exponent(largest_of(&v, MOTION));
    v.power = pow(10.0, v.exponent);
    static const quantity ways[] = {MOTION, FORCE}, times[] = {HALF_WIDTH, LOAD, APPROACH};
    const quantity *shown = v.in_time ? times : ways;
    const int panels = v.in_time ? 3 : 2;
    v.named = shown[0];
    for (int k = panels - 1; k >= 0; k--)
        v.named = widest(&v, shown[k]) > ROUNDING * largest_of(&v, shown[k]) ? shown[k] : v.named;
    v.from = v.rolls || v.in_time ? 0.0 : 1.0;
    v.to = place(&v, history->n - 1);
    if (!(v.to > v.from)) /* a single step */
        v.to = v.from + 1e-6;
    v.rc = rc;
    return rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, "history", write_inputs, &v, why);
}
