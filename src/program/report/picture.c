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
    rb_report_length length;           /* of one unit of the x axis */
    double stress_unit, friction_unit; /* of the axis of p and of q */
    rb_report_unit stress;             /* of the title */
    int dimensionless;
    double from, to; /* x axis, in its units */
    axis slip, heat;
    int carter;     /* 1: draw Carter's curve */
    int column;     /* 1: letters are larger */
    double smaller; /* letters of a longer line */
} view;

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
    fputs("$drawn << EOD\nx p q bound slip temperature temperature_b\n", out);
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
            fprintf(out, " %.9g %.9g %.9g", s->p[i] / v->stress_unit, s->q[i] / v->friction_unit,
                    bound / v->friction_unit);
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

/* How the name of a zone stands: upright, and without the arrow, where the zone is narrow; left out
 * where it is a line. */
enum { OUT, LEVEL, UPRIGHT };

static int stands(const view *v, double width, int zone)
{
    static const int letters[] = {
        [RB_ZONE_SEPARATED] = 9,     [RB_ZONE_STICK] = 5,          [RB_ZONE_SLIP_NEGATIVE] = 6,
        [RB_ZONE_SLIP_POSITIVE] = 6, [RB_ZONE_YIELD_NEGATIVE] = 7, [RB_ZONE_YIELD_POSITIVE] = 7,
        [RB_REPORT_FRICTIONLESS] = 7};
    const double share = width / (v->to - v->from);

    /* what the letters and the arrow take of the axis: they are larger in a column */
    return share < 0.025                                        ? OUT
           : share > (v->column ? 0.02 : 0.013) * letters[zone] ? LEVEL
                                                                : UPRIGHT;
}

/* Runs of equal zones, cut to the axis. */
static void write_zones(FILE *out, const view *v)
{
    const rb_rolling_solution *s = v->s;

    fputs("$zones << EOD\nfrom to zone name\n", out);
    for (int i = 0; i < s->n;) {
        const int first = i, zone = rb_report_zone(s, first);
        while (i < s->n && rb_report_zone(s, i) == zone)
            ++i;
        const double from = fmax((s->x[first] - s->h[first] / 2) / v->length.size, v->from);
        const double to = fmin((s->x[i - 1] + s->h[i - 1] / 2) / v->length.size, v->to);
        fprintf(out, "%.9g %.9g %d %d\n", from, to, zone, stands(v, to - from, zone));
    }
    fputs("EOD\n", out);
}

/* ---- Titles and axes ----------------------------------------------------------------------- */

static int other_a(const view *v)
{
    return fabs(v->s->hertz_half_width / v->s->half_width - 1.0) > 0.005;
}

static int other_radius(const view *v)
{
    return fabs(rb_rolling_derive(v->rc).radius / v->rc->a.radius - 1.0) > 1e-6;
}

/* What the case came to. */
static void let_results(FILE *out, const view *v)
{
    const rb_rolling_solution *s = v->s;
    const int moves = s->formulation != RB_STATIC || s->creepage != 0.0;
    char text[300] = "";

    if (s->contact == 0) {
        rb_append(text, sizeof text, "no contact");
    } else {
        const rb_report_unit length = rb_report_axis_unit(s->units, "mm", s->half_width);
        rb_append(text, sizeof text, "a = %s %s,  p_0 = %s %s",
                  RB_REPORT_NUMBER(s->half_width / length.size, 4), length.name,
                  RB_REPORT_NUMBER(s->max_pressure / v->stress.size, 5), v->stress.name);
        if (!isnan(s->creepage) && moves)
            rb_append(text, sizeof text, ",  ξ = %s", RB_REPORT_NUMBER(rb_report_creepage(s), 4));
        if (!isnan(s->creep_ratio) && moves) {
            /* With the a and R of its formula where they are not those that the title shows. */
            const double radius = rb_unit_shown(s->units, "mm", rb_rolling_derive(v->rc).radius);
            rb_append(text, sizeof text, ",  ξR/(μa%s) = %s", other_a(v) ? "_H" : "",
                      RB_REPORT_NUMBER(rb_report_creepage(s) == 0.0 ? 0.0 : s->creep_ratio, 3));
            if (other_a(v) || other_radius(v))
                rb_append(text, sizeof text, ":");
            if (other_radius(v))
                rb_append(text, sizeof text, " R = %s %s%s",
                          RB_REPORT_NUMBER(radius / length.size, 4), length.name,
                          other_a(v) ? "," : "");
            if (other_a(v))
                rb_append(text, sizeof text, " a_H = %s %s",
                          RB_REPORT_NUMBER(s->hertz_half_width / length.size, 4), length.name);
        }
        if (!isnan(s->force_ratio) && s->tangential_load != 0.0)
            rb_append(text, sizeof text, ",  Q/(μP) = %s",
                      RB_REPORT_NUMBER(rb_report_tidy(s->force_ratio, 1.0), 4));
    }
    /* a longer line in smaller letters */
    const int longer = s->contact > 0 ? other_a(v) + other_radius(v) : 0;
    rb_report_let_text(out, "results", "{/*%g %s}", 0.95 - v->smaller * longer, text);
}

static void let_title(FILE *out, const view *v)
{
    static const char *const kinds[] = {"Static contact", "Steady rolling", "Transient rolling"};
    const rb_rolling_solution *s = v->s;
    const char *load = rb_unit_name(s->units, "N/mm");

    rb_report_let_text(
        out, "title", "{/:Bold %s}   μ %s %g,  P = %s %s,  Q = %s %s", kinds[s->formulation],
        s->mu ? "≤" : "=", rb_rolling_largest_mu(v->rc), RB_REPORT_NUMBER(s->normal_load, 5), load,
        RB_REPORT_NUMBER(rb_report_tidy(s->tangential_load, s->normal_load), 5), load);
    let_results(out, v);
    rb_report_let_bodies(out, v->rc, s->units);
}

/* Room for p, q and the bounds; at mu > 1 the bounds may leave it. */
static void let_tractions(FILE *out, const view *v)
{
    const rb_rolling_solution *s = v->s;
    double p = 0.0, q = 0.0;

    for (int i = 0; i < s->n; i++) {
        p = fmax(p, s->p[i] / v->stress_unit);
        q = fmax(q, fabs(s->q[i]) / v->friction_unit);
    }
    const double scale = p > 0.0 ? p : 1.0;
    const double bound =
        fmax(q, fmin(rb_rolling_largest_mu(v->rc), 1.0) * p * v->stress_unit / v->friction_unit);
    const double below = fmax(1.2 * bound, 0.08 * scale);
    /* a ninth of the height is left to the names of the zones */
    const double above = (fmax(scale, bound) + below / 9.0) * 9.0 / 8.0;
    rb_report_let(out, "p_from", -below);
    rb_report_let(out, "p_to", above);
    const int has_friction = rb_rolling_largest_mu(v->rc) > 0.0;
    if (!v->dimensionless)
        rb_report_let_text(out, "p_label", "%s%s", has_friction ? "traction" : "pressure",
                           RB_REPORT_COUNTED_IN(0, v->stress.name));
    else if (!has_friction)
        rb_report_let_text(out, "p_label", "%s", "p / p_0");
    else
        rb_report_let_text(out, "p_label", "p / p_0,  q / %s",
                           v->friction_unit < v->stress_unit ? "(μ p_0)" : "p_0");
    rb_report_let_text(out, "bound_title", "%s",
                       !has_friction ? ""
                       : s->plastic  ? "bounds"
                                     : "±μp");
}

/* The axis of the panel of this name, with so many steps. */
static void let_axis(FILE *out, const char *panel, const axis *y, int steps, const char *label,
                     const char *unit)
{
    const double height = y->to - y->from;
    const struct {
        const char *end;
        double x;
    } numbers[] = {
        {"from", y->from}, {"to", y->to}, {"step", rb_report_round_step(height / steps)}};
    char name[20];

    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
        rb_format(name, sizeof name, "%s_%s", panel, numbers[k].end);
        rb_report_let(out, name, numbers[k].x);
    }
    rb_format(name, sizeof name, "%s_label", panel);
    rb_report_let_text(out, name, "%s%s", label, RB_REPORT_COUNTED_IN(y->exponent, unit));
}

static double warmer_by(const view *v, int i)
{
    return (v->s->temperature[i] - v->s->temperature_b[i]) / v->heat.unit;
}

/* The names of the bodies at that end of the curves where these are farther apart (in the
 * contact they are one): between the two where there is room, else only that of the
 * upper. */
static void write_names(FILE *out, const view *v)
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
            fprintf(out, "%s %.9g %.9g %d\n", k ? "B" : "A", v->s->x[at] / v->length.size,
                    t[k] + (upper == room ? -up : up), left);
    }
}

static rb_status write_table(FILE *out, const void *of, const rb_report_style *style)
{
    return rb_report_table(out, NULL, of, NULL, "", style);
}

static void write_inputs(FILE *out, rb_report_canvas canvas, const void *context)
{
    const view *v = context;
    const rb_rolling_solution *s = v->s;

    (void)canvas;
    rb_report_let_table(out, "table", write_table, s);
    rb_report_let_units(out, s->units);
    write_data(out, v);
    write_zones(out, v);
    if (v->carter) {
        /* x, Hertz's pressure, Carter's friction. */
        enum { POINTS = 24 };
        const double a = s->hertz_half_width;
        const double p0 = rb_closed_hertz_max_pressure(s->normal_load, a);
        const double mu = rb_rolling_largest_mu(v->rc);
        fputs("$carter << EOD\nx q p\n", out);
        for (int k = 0; k <= POINTS; k++) {
            const double x = -a * cos(3.14159265358979 * k / POINTS);
            const double q = rb_closed_carter_traction(mu, p0, a, s->creep_ratio, x);
            fprintf(out, "%.9g %.9g %.9g\n", x / v->length.size, q / v->friction_unit,
                    p0 * sqrt(fmax(1.0 - x / a * (x / a), 0.0)) / v->stress_unit);
        }
        fputs("EOD\n", out);
    }
    rb_report_let_whole(out, "is_carter", v->carter);
    rb_report_let_whole(out, "few", s->n <= STEPS_UP_TO);
    rb_report_let(out, "x_from", v->from);
    rb_report_let(out, "x_to", v->to);
    rb_report_let_text(out, "x_label", "x %s%s", v->length.label,
                       s->formulation == RB_STATIC ? "" : "      (rolling towards +x →)");
    let_title(out, v);
    let_tractions(out, v);
    /* in a static case (12) is a velocity that the elements in stick have as well */
    let_axis(out, "slip", &v->slip, 5, s->formulation == RB_STATIC ? "slip by (12)" : "slip", "");
    if (s->temperature) {
        let_axis(out, "heat", &v->heat, 3, "T", "K");
        fputs("$names << EOD\nbody x T left\n", out);
        write_names(out, v);
        fputs("EOD\n", out);
    }
}

rb_status rb_report_picture(FILE *out, rb_report_canvas canvas, const rb_rolling_case *rc,
                            const rb_rolling_solution *s, rb_message *why)
{
    if (s->n < 1)
        return rb_fail(why, RB_EINVAL, "nothing to draw");
    view v = {.rc = rc,
              .s = s,
              .dimensionless = canvas.dimensionless && rb_report_has_scales(s),
              .column = !rb_report_place_of(canvas).titled,
              .smaller = canvas.size == RB_REPORT_SLIDE ? 0.035 : 0.075};
    double from = s->x[0] - s->h[0] / 2, to = s->x[s->n - 1] + s->h[s->n - 1] / 2;
    if (s->contact > 0) {
        const double margin = 0.15 * (s->contact_to - s->contact_from);
        from = fmax(from, s->contact_from - margin);
        to = fmin(to, s->contact_to + margin);
    }
    v.length = v.dimensionless ? (rb_report_length){s->half_width, "/ a"}
                               : rb_report_length_axis(s->units, s->half_width);
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
    v.stress = unit;
    v.stress_unit = v.friction_unit = unit.size;
    if (v.dimensionless) {
        const rb_report_scales by = rb_report_scales_of(rc, s);
        v.stress_unit = by.pressure;
        v.friction_unit = by.friction;
    }
    v.carter = rb_rolling_carter_holds(rc) && isfinite(s->creep_ratio) && s->normal_load > 0.0;
    return rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, "tractions", write_inputs, &v, why);
}
