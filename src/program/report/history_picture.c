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
    rb_report_place place;
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

/* One of three, k from above. */
typedef struct {
    int k;
    quantity of;
    const char *label, *colour;
    int column, band; /* of the data; band: half its width, or 0 */
} panel;

static void write_panel(FILE *out, const view *v, const panel *p)
{
    static const double tops[] = {0.9, 0.634, 0.368};
    /* larger tics need more between them */
    const double height = v->place.titled ? 0.235 : 0.215;
    const double top = tops[p->k] + v->place.up;
    fprintf(out,
            "set tmargin at screen %g\nset bmargin at screen %g\n"
            "set label 2 '%s' at screen 0.03, %g center rotate\nplot ",
            top, top - height, p->label, top - height / 2);
    if (p->band && bands_of(v)) {
        fprintf(out, "$data using 1:($%d-$%d):($%d+$%d) " RB_REPORT_BAND " ", p->column, p->band,
                p->column, p->band, p->colour);
        if (p->of == v->named) {
            const double most = widest(v, p->of) * (p->of == MOTION ? v->power : 1.0);
            const char *unit = p->of == FORCE || p->of == LOAD ? "N/mm" : "mm";
            const int pure = (p->of == MOTION && v->rolls) || (p->of == FORCE && !shows_Q(v));
            rb_report_band_title(out, v->h->errors != NULL, most,
                                 pure ? "" : rb_unit_name(v->h->units, unit), v->place.titled);
        } else
            fputs("notitle, ", out); /* a key for one panel */
    }
    fprintf(out,
            "$data using 1:%d with %s linecolor rgb '%s' linewidth 1.8 pointtype 7 "
            "pointsize 0.8 notitle\n",
            p->column, v->points ? "linespoints" : "lines", p->colour);
}

/* A range and tics for the values with their bands, and for what else must be seen. */
static void write_range(FILE *out, const view *v, quantity of, double least, double most)
{
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
    fprintf(out, "set yrange [%.9g:%.9g]\nset ytics %.9g\n", least - 0.08 * height,
            most + 0.08 * height, rb_report_round_step(height / 5.0));
}

static void write_last_axis(FILE *out, const char *label)
{
    fprintf(out, "set format x '%%g'\nset xlabel '%s' offset 0,0.3\n", label);
}

static void write_way(FILE *out, const view *v)
{
    char label[80];

    snprintf(label, sizeof label, "%s%s", v->rolls ? "ξ" : "shift",
             RB_REPORT_COUNTED_IN(v->exponent, v->rolls ? "" : rb_unit_name(v->h->units, "mm")));
    write_range(out, v, MOTION, INFINITY, -INFINITY);
    write_panel(out, v, &(panel){0, MOTION, label, "#6c3483", 2, 5});
    fputs("unset label 1\nunset label 9\n", out);
    write_range(out, v, FORCE, 0.0, 0.0); /* a force is seen against none */
    snprintf(label, sizeof label, shows_Q(v) ? "Q  [%s]" : "Q/(μP)",
             rb_unit_name(v->h->units, "N/mm"));
    write_panel(out, v, &(panel){1, FORCE, label, "#c0392b", 3, 6});
    write_last_axis(out, v->rolls ? "rolled distance / a" : "increment");
    fputs("set yrange [0:1]\nset ytics 0.2\n", out);
    write_panel(out, v, &(panel){2, STICK, "stick / contact", "#1f4e79", 4, 0});
}

static void write_time(FILE *out, const view *v)
{
    static const quantity shown[] = {HALF_WIDTH, LOAD, APPROACH};
    static const char *const label[] = {"half-width  [%s]", "P  [%s]", "approach  [%s]"},
                             *const unit[] = {"mm", "N/mm", "mm"},
                             *const colour[] = {"#1f4e79", "#c0392b", "#6c3483"};

    for (int k = 0; k < 3; k++) {
        char text[80];
        snprintf(text, sizeof text, label[k], rb_unit_name(v->h->units, unit[k]));
        if (k == 2)
            write_last_axis(out, "time  [s]");
        write_range(out, v, shown[k], 0.0, 0.0);
        write_panel(out, v, &(panel){k, shown[k], text, colour[k], 2 + k, 5 + k});
        fputs("unset label 1\nunset label 9\n", out);
    }
}

static void write_script(FILE *out, rb_report_canvas canvas, const void *context)
{
    const view *v = context;
    const int last = v->h->n - 1;
    const char *unit = rb_unit_name(v->h->units, "N/mm");
    fputs("$data << EOD\n", out);
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
    fprintf(out,
            "set multiplot\nset lmargin at screen %g\nset rmargin at screen "
            "0.965\n" RB_REPORT_GRID "set format x ''\n"
            "set key at screen 0.965, %g right samplen 2.2 font ',%.3g'\n",
            0.14 + v->place.right, 0.924 + v->place.up, rb_report_key_font(canvas));
    fprintf(out, "set xrange [%.9g:%.9g]\n", v->from, v->to);
    if (!v->rolls && !v->in_time) /* no half increments */
        fprintf(out, "set xtics %g\n", fmax(1.0, rb_report_round_step((v->to - v->from) / 8.0)));
    if (v->place.titled)
        fprintf(out,
                "set label 1 '{/:Bold %s}   %d steps,  at the end P = %s %s,  Q = %s "
                "%s' at screen 0.54, 0.978 center\n",
                v->rolls     ? "Transient rolling"
                : v->in_time ? "Static contact in time"
                             : "Static history",
                v->h->n, RB_REPORT_NUMBER(v->h->normal_load[last], 5), unit,
                RB_REPORT_NUMBER(
                    rb_report_tidy(v->h->tangential_load[last], v->h->normal_load[last]), 5),
                unit);
    if (v->place.titled)
        rb_report_label_bodies(out, v->rc, v->h->units, 0.54, 0.944);
    (v->in_time ? write_time : write_way)(out, v);
    fputs("unset multiplot\n", out);
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
              .power = 1.0, /* as value() reads it below */
              .place = rb_report_place_of(canvas)};
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
    return rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, write_script, &v, why);
}
