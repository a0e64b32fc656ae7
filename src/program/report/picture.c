/* The traction picture: pressure, friction and its bounds, slip, zones. */
#include "program/report/internal.h"

#include "rolling/case/closed_forms.h"

#include <math.h>
#include <string.h>

/* A y axis in units of a power of ten. */
typedef struct {
    int exponent;
    double unit, from, to;
} axis;

/* What the axes show. */
typedef struct {
    const rb_rolling_case *rc;
    const rb_rolling_solution *s;
    rb_report_length length; /* of one unit of the x axis */
    double stress_unit;
    const char *stress_label;
    double from, to; /* x axis, in its units */
    axis slip, heat;
    int carter; /* 1: draw Carter's curve */
    rb_report_place place;
} view;

/* Where the panels lie on the screen: tractions, slip, temperature. */
typedef struct {
    double top, bottom;
} panel;

enum { TRACTIONS, SLIP, TEMPERATURE };

static panel panel_of(const view *v, int which)
{
    static const panel two[] = {{0.83, 0.40}, {0.36, 0.115}};
    static const panel three[] = {{0.83, 0.48}, {0.45, 0.305}, {0.275, 0.115}};
    const panel at = v->s->temperature ? three[which] : two[which];
    return (panel){at.top + v->place.up, at.bottom + v->place.up};
}

/* Opens a panel; the lowest one carries the numbers of the x axis. */
static void open_panel(FILE *out, const view *v, int which, int lowest)
{
    const panel at = panel_of(v, which);
    fprintf(out, "set tmargin at screen %g\nset bmargin at screen %g\nset format x '%s'\n", at.top,
            at.bottom, lowest ? "%g" : "");
}

static double middle_of(const view *v, int which)
{
    const panel at = panel_of(v, which);
    return 0.5 * (at.top + at.bottom);
}

/* Of the y axis of a panel about this height of the screen. */
static void write_name(FILE *out, const char *name, const char *counted_in, double middle)
{
    fprintf(out, "set label 3 '%s%s' at screen 0.028, %g center rotate\n", name, counted_in,
            middle);
}

static int is_shown(const view *v, int i)
{
    const double x = v->s->x[i] / v->length.size;
    return x >= v->from && x <= v->to;
}

/* Slip is that of surfaces which touch. */
static int has_slip(const view *v, int i)
{
    return v->s->zone[i] != RB_ZONE_SEPARATED || v->s->contact == 0;
}

/* Small numbers are shown in a power of ten, which the title names: their labels would
 * run into it. */
static axis axis_between(double least, double most)
{
    const double largest = fmax(most, -least);
    axis y = {.exponent = rb_report_exponent(largest)};
    y.unit = pow(10.0, y.exponent);
    const double margin = most > least ? 0.12 * (most - least) : y.unit;
    y.from = (least - margin) / y.unit;
    y.to = (most + margin) / y.unit;
    return y;
}

/* Without rounding errors, which are compared with the strains under the pressure: in
 * free rolling nothing else would be drawn. */
static double slip_of(const view *v, int i)
{
    const double p0 = rb_unit_stored(v->s->units, "MPa", v->s->max_pressure);
    return rb_report_tidy(v->s->slip[i], p0 / v->rc->a.young);
}

/* ---- Data ------------------------------------------------------------------------- */

enum { STEPS_UP_TO = 16 };

/* Curves of the tractions fall to zero where the contact ends; slip just ends. */
static void write_data(FILE *out, const view *v)
{
    const rb_rolling_solution *s = v->s;
    const int steps = s->n <= STEPS_UP_TO || s->contact == 0;
    fputs("set datafile missing '?'\n$data << EOD\n", out);
    for (int i = 0; i < s->n; i++) {
        const int ends = i > 0 && has_slip(v, i) != has_slip(v, i - 1);
        if (!steps && ends)
            fprintf(out, "%.9g 0 0 0 ? ? ?\n", (s->x[i] - s->h[i] / 2) / v->length.size);
        fprintf(out, "%.9g", s->x[i] / v->length.size);
        /* What friction may be: mu p, or the yield stress of the interface. */
        double bound = (s->mu ? s->mu[i] : rb_rolling_largest_mu(v->rc)) * s->p[i];
        if (s->plastic) {
            const double u = rb_unit_stored(s->units, "mm", s->plastic[i]);
            const double yield = fmax(v->rc->yield_stress + v->rc->hardening * u, 0.0);
            bound = fmin(bound, rb_unit_shown(s->units, "MPa", yield));
        }
        if (steps || has_slip(v, i))
            fprintf(out, " %.9g %.9g %.9g", s->p[i] / v->stress_unit, s->q[i] / v->stress_unit,
                    bound / v->stress_unit);
        else
            fputs(" ? ? ?", out);
        if (has_slip(v, i))
            fprintf(out, " %.9g", slip_of(v, i) / v->slip.unit);
        else
            fputs(" ?", out);
        fprintf(out, " %.9g %.9g\n", s->temperature ? s->temperature[i] / v->heat.unit : 0.0,
                s->temperature ? s->temperature_b[i] / v->heat.unit : 0.0);
    }
    fputs("EOD\n", out);
}

/* ---- Zones ------------------------------------------------------------------------ */

typedef struct {
    double from, to; /* in units of the axis */
    int zone;
} stretch;

/* Upright, and without the arrow, where the zone is narrow; left out where it is a line. */
static void write_zone_label(FILE *out, const view *v, const stretch *st)
{
    const double share = (st->to - st->from) / (v->to - v->from);
    static const char *const flat[] = {"separated", "stick",   "slip →", "← slip",
                                       "yield →",   "← yield", "contact"},
                             *const upright[] = {"separated", "stick", "slip",   "slip",
                                                 "yield",     "yield", "contact"};
    /* what the letters and the arrow take of the axis: they are larger in a column */
    const double letter = v->place.titled ? 0.013 : 0.02;
    const double length =
        letter * (double)(strlen(upright[st->zone]) +
                          (strlen(flat[st->zone]) > strlen(upright[st->zone]) ? 2 : 0));
    if (share < 0.025)
        return;
    fprintf(out, "set label '{/*0.85 %s}' at first %.9g, graph %s textcolor rgb '#555555' front\n",
            share > length ? flat[st->zone] : upright[st->zone], (st->from + st->to) / 2,
            share > length ? "0.95 center" : "0.97 right rotate by 90");
}

static void write_zones(FILE *out, const view *v, int labelled)
{
    for (int i = 0; i < v->s->n;) {
        /* The next run of equal zones from element *i on, cut to the axis; *i moves
         * behind it. */
        const rb_rolling_solution *s = v->s;
        const int first = i;
        while (i < s->n && rb_report_zone(s, i) == rb_report_zone(s, first))
            ++i;
        const double from = (s->x[first] - s->h[first] / 2) / v->length.size;
        const double to = (s->x[i - 1] + s->h[i - 1] / 2) / v->length.size;
        const stretch st =
            (stretch){fmax(from, v->from), fmin(to, v->to), rb_report_zone(s, first)};
        fprintf(out,
                "set object rectangle from first %.9g, graph 0 to first %.9g, graph 1 fillcolor "
                "rgb '%s' fillstyle solid noborder behind\n",
                st.from, st.to, rb_report_zone_colour(st.zone, 1));
        if (labelled)
            write_zone_label(out, v, &st);
    }
}

/* ---- Panels ----------------------------------------------------------------------- */

static int other_a(const view *v)
{
    return fabs(v->s->hertz_half_width / v->s->half_width - 1.0) > 0.005;
}

static int other_radius(const view *v)
{
    return fabs(rb_rolling_derive(v->rc).radius / v->rc->a.radius - 1.0) > 1e-6;
}

/* What the case came to, behind its name. */
static void write_results(FILE *out, const view *v)
{
    const rb_rolling_solution *s = v->s;
    const int moves = s->formulation != RB_STATIC || s->creepage != 0.0;
    if (s->contact == 0) {
        fputs("no contact", out);
        return;
    }
    const rb_report_unit length = rb_report_axis_unit(s->units, "mm", s->half_width);
    fprintf(out, "a = %s %s,  p_0 = %s %s", RB_REPORT_NUMBER(s->half_width / length.size, 4),
            length.name, RB_REPORT_NUMBER(s->max_pressure / v->stress_unit, 5), v->stress_label);
    if (!isnan(s->creepage) && moves)
        fprintf(out, ",  ξ = %s", RB_REPORT_NUMBER(s->creepage, 4));
    if (!isnan(s->creep_ratio) && moves) {
        /* With the a and R of its formula where they are not those that the title shows. */
        const double radius = rb_unit_shown(s->units, "mm", rb_rolling_derive(v->rc).radius);
        fprintf(out, ",  ξR/(μa%s) = %s", other_a(v) ? "_H" : "",
                RB_REPORT_NUMBER(s->creep_ratio, 3));
        if (other_a(v) || other_radius(v)) {
            fputs(":", out);
            if (other_radius(v))
                fprintf(out, " R = %s %s%s", RB_REPORT_NUMBER(radius / length.size, 4), length.name,
                        other_a(v) ? "," : "");
            if (other_a(v))
                fprintf(out, " a_H = %s %s", RB_REPORT_NUMBER(s->hertz_half_width / length.size, 4),
                        length.name);
        }
    }
    if (!isnan(s->force_ratio) && s->tangential_load != 0.0)
        fprintf(out, ",  Q/(μP) = %s", RB_REPORT_NUMBER(rb_report_tidy(s->force_ratio, 1.0), 4));
}

static void write_tractions(FILE *out, const view *v, double key_font, double marker)
{
    /* Room for p, q and the bounds; at mu > 1 the bounds may leave it. */
    const rb_rolling_solution *s = v->s;
    double p = 0.0, q = 0.0;
    for (int i = 0; i < s->n; i++) {
        p = fmax(p, s->p[i]);
        q = fmax(q, fabs(s->q[i]));
    }
    const double scale = p > 0.0 ? p : v->stress_unit;
    const double bound = fmax(q, fmin(rb_rolling_largest_mu(v->rc), 1.0) * p);
    const double below = fmax(1.2 * bound, 0.08 * scale);
    /* a ninth of the height is left to the names of the zones */
    const double above = (fmax(scale, bound) + below / 9.0) * 9.0 / 8.0;
    fprintf(out, "set yrange [%.9g:%.9g]\n", -below / v->stress_unit, above / v->stress_unit);
    open_panel(out, v, TRACTIONS, 0);
    write_name(out, "traction", RB_REPORT_COUNTED_IN(0, v->stress_label), middle_of(v, TRACTIONS));
    fprintf(out,
            "set key at screen 0.53, %g center horizontal maxrows 1 samplen 1.2 width %d font "
            "',%.3g'\n",
            0.866 + v->place.up + (v->place.titled ? 0.0 : 0.02),
            v->carter && v->place.titled ? -2 : 0, key_font);
    write_zones(out, v, 1);
    /* few elements: what each of them carries; many: a curve */
    const char *style = v->s->n <= STEPS_UP_TO ? "histeps" : "lines";
    fprintf(out,
            "plot 0 with lines linecolor rgb '#999999' linewidth 0.6 notitle, $data using 1:4 with "
            "%s dashtype (6,4) linecolor rgb '#7a7a7a' linewidth 0.9 title '%s', $data using "
            "1:(-$4) with %s dashtype (6,4) linecolor rgb '#7a7a7a' linewidth 0.9 notitle, $data "
            "using 1:2 with %s linecolor rgb '#1f4e79' linewidth 1.8 title 'pressure p', $data "
            "using 1:3 with %s linecolor rgb '#c0392b' linewidth 2.2 title 'friction q'",
            style, v->s->plastic ? "bounds" : "±μp", style, style, style);
    if (v->carter)
        fprintf(out,
                ", $carter using 1:3 with points pointtype 6 pointsize %g linecolor rgb '#111111' "
                "linewidth 1.2 notitle, $carter using 1:2 with points pointtype 6 pointsize %g "
                "linecolor rgb '#111111' linewidth 1.2 title 'Hertz, Carter'",
                marker, marker);
    fputs("\n", out);
}

static void write_x_label(FILE *out, const view *v)
{
    fprintf(out, "set xlabel 'x %s%s' offset 0,0.3\n", v->length.label,
            v->s->formulation == RB_STATIC ? "" : "      (rolling towards +x →)");
}

static double warmer_by(const view *v, int i)
{
    return (v->s->temperature[i] - v->s->temperature_b[i]) / v->heat.unit;
}

/* The names of the bodies at that end of the curves where these are farther apart (in the
 * contact they are one): between the two where there is room, else only that of the
 * upper. */
static void write_bodies(FILE *out, const view *v)
{
    const double height = v->heat.to - v->heat.from;
    int first = 0, last = v->s->n - 1;
    while (first < last && !is_shown(v, first))
        first++;
    while (last > first && !is_shown(v, last))
        last--;
    const int left = fabs(warmer_by(v, first)) > fabs(warmer_by(v, last));
    const int at = left ? first : last;
    const double apart = warmer_by(v, at), t_b = v->s->temperature_b[at] / v->heat.unit;
    if (fabs(apart) < 0.02 * height) /* one curve, to the eye */
        return;
    const int room = fabs(apart) > 0.4 * height;
    const double t[] = {t_b + apart, t_b}, up = 0.13 * height;
    for (int k = 0; k < 2; k++) {
        const int upper = (k == 0) == (apart > 0.0);
        if (upper || room)
            fprintf(out, "set label '%s' at first %.9g, first %.9g %s front\n", k ? "B" : "A",
                    v->s->x[at] / v->length.size, t[k] + (upper == room ? -up : up),
                    left ? "left offset 0.5,0" : "right offset -0.5,0");
    }
}

static void write_script(FILE *out, rb_report_canvas canvas, const void *context)
{
    const view *v = context;
    write_data(out, v);
    if (v->carter) {
        /* x, Carter's friction, Hertz's pressure. */
        enum { POINTS = 24 };
        const rb_rolling_solution *s = v->s;
        const double a = s->hertz_half_width;
        const double p0 = rb_closed_hertz_max_pressure(s->normal_load, a);
        const double mu = rb_rolling_largest_mu(v->rc);
        fputs("$carter << EOD\n", out);
        for (int k = 0; k <= POINTS; k++) {
            const double x = -a * cos(3.14159265358979 * k / POINTS);
            const double q = rb_closed_carter_traction(mu, p0, a, s->creep_ratio, x);
            fprintf(out, "%.9g %.9g %.9g\n", x / v->length.size, q / v->stress_unit,
                    p0 * sqrt(fmax(1.0 - x / a * (x / a), 0.0)) / v->stress_unit);
        }
        fputs("EOD\n", out);
    }
    fprintf(out, "set multiplot\nset lmargin at screen %g\nset rmargin at screen 0.965\n",
            0.12 + v->place.right);
    fprintf(out, "set xrange [%.9g:%.9g]\n", v->from, v->to);
    if (v->place.titled) {
        static const char *const kinds[] = {"Static contact", "Steady rolling",
                                            "Transient rolling"};
        const rb_rolling_solution *s = v->s;
        const char *load = rb_unit_name(s->units, "N/mm");
        fprintf(out, "set label 1 '{/:Bold %s}   μ %s %g,  P = %s %s,  Q = %s %s",
                kinds[s->formulation], s->mu ? "≤" : "=", rb_rolling_largest_mu(v->rc),
                RB_REPORT_NUMBER(s->normal_load, 5), load,
                RB_REPORT_NUMBER(rb_report_tidy(s->tangential_load, s->normal_load), 5), load);
        /* a longer line in smaller letters */
        const int longer = s->contact > 0 ? other_a(v) + other_radius(v) : 0;
        fprintf(out, "' at screen 0.53, 0.977 center\nset label 2 '{/*%g ",
                0.95 - (canvas.size == RB_REPORT_SLIDE ? 0.035 : 0.075) * longer);
        write_results(out, v);
        fputs("}' at screen 0.53, 0.909 center textcolor rgb '#444444'\n", out);
        rb_report_label_bodies(out, v->rc, s->units, 0.53, 0.943);
    }
    write_tractions(out, v, rb_report_key_font(canvas), 1.7 * rb_report_marker_scale(canvas));
    const int lowest = !v->s->temperature;
    fputs("unset label\nunset key\nunset object\n", out);
    open_panel(out, v, SLIP, lowest);
    fprintf(out, "set yrange [%.9g:%.9g]\nset ytics %.9g\n", v->slip.from, v->slip.to,
            rb_report_round_step((v->slip.to - v->slip.from) / 5.0));
    if (lowest)
        write_x_label(out, v);
    /* in a static case (12) is a velocity that the elements in stick have as well */
    write_name(out, v->s->formulation == RB_STATIC ? "velocity / V" : "slip",
               RB_REPORT_COUNTED_IN(v->slip.exponent, ""), middle_of(v, SLIP));
    write_zones(out, v, 0);
    fprintf(out,
            "plot 0 with lines linecolor rgb '#999999' linewidth 0.6, $data using 1:($5) with %s "
            "linecolor rgb '#6c3483' linewidth 1.8\n",
            v->s->n <= STEPS_UP_TO ? "linespoints pointtype 7" : "lines");
    if (v->s->temperature) {
        fputs("unset label\nunset object\n", out);
        open_panel(out, v, TEMPERATURE, 1);
        fprintf(out, "set yrange [%.9g:%.9g]\nset ytics %.9g\n", v->heat.from, v->heat.to,
                rb_report_round_step((v->heat.to - v->heat.from) / 3.0));
        write_x_label(out, v);
        write_name(out, "T", RB_REPORT_COUNTED_IN(v->heat.exponent, "K"),
                   middle_of(v, TEMPERATURE));
        write_zones(out, v, 0);
        write_bodies(out, v);
        fputs("plot $data using 1:7 with lines dashtype (6,4) linecolor rgb '#7a7a7a' linewidth "
              "1.2, $data using 1:6 with lines linecolor rgb '#b9770e' linewidth 1.8\n",
              out);
    }
    fputs("unset multiplot\n", out);
}

rb_status rb_report_picture(FILE *out, rb_report_canvas canvas, const rb_rolling_case *rc,
                            const rb_rolling_solution *s, rb_message *why)
{
    if (s->n < 1)
        return rb_fail(why, RB_EINVAL, "nothing to draw");
    view v = {.rc = rc, .s = s, .place = rb_report_place_of(canvas)};
    double from = s->x[0] - s->h[0] / 2, to = s->x[s->n - 1] + s->h[s->n - 1] / 2;
    if (s->contact > 0) {
        const double margin = 0.15 * (s->contact_to - s->contact_from);
        from = fmax(from, s->contact_from - margin);
        to = fmin(to, s->contact_to + margin);
    }
    v.length = rb_report_length_axis(s->units, s->half_width);
    v.from = from / v.length.size;
    v.to = to / v.length.size;
    double least = 0.0, most = 0.0, coldest = INFINITY, hottest = -INFINITY;
    for (int i = 0; i < s->n; i++) {
        if (is_shown(&v, i) && has_slip(&v, i)) {
            least = fmin(least, slip_of(&v, i));
            most = fmax(most, slip_of(&v, i));
        }
        if (is_shown(&v, i) && s->temperature) {
            coldest = fmin(coldest, fmin(s->temperature[i], s->temperature_b[i]));
            hottest = fmax(hottest, fmax(s->temperature[i], s->temperature_b[i]));
        }
    }
    v.slip = axis_between(least, most);
    v.heat = axis_between(coldest, hottest);
    const rb_report_unit unit = rb_report_axis_unit(v.s->units, "MPa", v.s->max_pressure);
    v.stress_unit = unit.size;
    v.stress_label = unit.name;
    v.carter = rb_rolling_carter_holds(rc) && isfinite(s->creep_ratio) && s->normal_load > 0.0;
    return rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, write_script, &v, why);
}
