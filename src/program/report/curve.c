/* Creep curves: table, JSON, lines for people, picture with Carter's law. */
#include "program/report/internal.h"

#include "rolling/case/closed_forms.h"

#include <jansson.h>
#include <math.h>

/* ---- Table and JSON ---------------------------------------------------------------- */

static rb_report_columns columns_of(const rb_rolling_curve *c, int kind)
{
    return (rb_report_columns){
        .columns = &rb_rolling_curve_columns, .owner = c, .kind = kind, .units = c->units};
}

/* The coefficient that Q/(mu P) of a curve refers to: of a law that falls, that of rest. */
static double reference_mu(const rb_rolling_case *rc, double mu)
{
    if (!rc)
        return mu;
    rb_rolling_case of_curve = *rc;
    of_curve.mu = mu;
    return rb_rolling_largest_mu(&of_curve);
}

rb_status rb_report_curve_table(FILE *out, const rb_report_curves *curves,
                                const rb_rolling_note_list *notes, const char *command,
                                const rb_report_style *style)
{
    rb_report_cells c = rb_report_cells_begin(out, style, "");
    rb_status s = RB_OK;
    for (int k = 0; k < curves->n && s == RB_OK; k++) {
        /* The coefficient of friction stands before the columns of its curve. */
        const double mu = reference_mu(curves->rc, curves->mu[k]);
        const rb_rolling_curve *d = curves->curve[k].deviations;
        const rb_report_columns part[2] = {columns_of(&curves->curve[k], RB_REPORT_VALUES),
                                           d ? columns_of(d, RB_REPORT_DEVIATIONS)
                                             : columns_of(&curves->error[k], RB_REPORT_ERRORS)};
        const int parts = curves->has_errors || d ? 2 : 1;

        if (k == 0) {
            rb_report_cell_text(&c, "mu");
            rb_report_cell_headings(&c, parts, part);
            rb_report_cell_slope_headings(&c, &curves->slopes[k]);
            rb_report_cells_end_row(&c);
            rb_report_comment_head(&c, command);
            rb_report_comment_slopes(&c, curves->n, curves->slopes, curves->mu);
            if (mu != curves->mu[k])
                rb_report_comment(&c, "mu: of the law at rest, mu(0), which force_ratio refers to");
            s = rb_report_comment_notes(&c, notes);
        }
        for (int i = 0; i < curves->curve[k].n; i++) {
            rb_report_cell_number(&c, mu);
            rb_report_cell_entries(&c, i, parts, part);
            rb_report_cell_slopes(&c, &curves->slopes[k], i);
            rb_report_cells_end_row(&c);
        }
    }
    return s == RB_OK ? rb_report_flush(out) : s;
}

void rb_report_json_curves(json_t **root, const rb_report_curves *curves)
{
    json_t *all = json_array();
    for (int k = 0; k < curves->n; k++) {
        const rb_rolling_curve *c = &curves->curve[k];
        const rb_report_columns columns = columns_of(c, 0);
        json_t *curve = json_object();

        rb_report_json_set(&curve, "mu",
                           rb_report_json_number(reference_mu(curves->rc, curves->mu[k])));
        rb_report_json_columns(&curve, c->n, &columns, 0);
        rb_report_json_slopes(&curve, &curves->slopes[k]);
        if (c->deviations) {
            const rb_report_columns of = columns_of(c->deviations, RB_REPORT_DEVIATIONS);
            json_t *tolerances = json_object();
            rb_report_json_columns(&tolerances, c->n, &of, 0);
            rb_report_json_set(&curve, "tolerances", tolerances);
        }
        rb_report_json_set(&curve, "free_creepage", rb_report_json_number(c->free_creepage));
        rb_report_json_set(&curve, "hertz_half_width", rb_report_json_number(c->half_width));
        rb_report_json_set(&curve, "iterations", json_integer(c->iterations));
        rb_report_json_set(&curve, "seconds", rb_report_json_number(c->seconds));
        if (curves->has_errors) {
            const rb_rolling_curve *error = &curves->error[k];
            const rb_report_columns bars = columns_of(error, 1);
            json_t *errors = json_object();
            rb_report_json_columns(&errors, error->n, &bars, 0);
            rb_report_json_set(&errors, "free_creepage",
                               rb_report_json_number(error->free_creepage));
            rb_report_json_set(&curve, "errors", errors);
        }
        rb_report_json_append(&all, curve);
    }
    if (curves->n > 0 && curves->slopes[0].tolerance)
        rb_report_json_uncertain_text(root, curves->slopes[0].tolerance);
    rb_report_json_set(root, "curve", json_incref(json_array_get(all, 0)));
    if (curves->n > 1)
        rb_report_json_set(root, "curves", json_incref(all));
    json_decref(all);
}

/* ---- For people -------------------------------------------------------------------- */

static double largest(int n, const double *x)
{
    double most = 0.0;
    for (int i = 0; i < n; i++)
        most = fmax(most, x[i]);
    return most;
}

/* From which creepage on nothing sticks, where there is such a point. */
static void write_sliding(FILE *out, const rb_rolling_curve *c)
{
    /* The first of the points at the end of the curve at which nothing sticks. */
    const int rising = c->n < c->rising ? c->n : c->rising;
    int sliding = rising;
    while (sliding > 0 && c->stick_ratio[sliding - 1] == 0.0)
        sliding--;
    if (sliding == rising)
        return;
    int held = sliding - 1; /* the last point before that has a solution */
    while (held > 0 && isnan(c->stick_ratio[held]))
        held--;
    /* where it yields it need not slide */
    double yields = 0.0;
    for (int i = sliding; i < rising && c->yield_ratio; i++)
        yields = fmax(yields, c->yield_ratio[i]);
    if (yields > 0.0 && sliding > 0)
        fprintf(out,
                "  nothing sticks from a creepage between xi = %.5g and %.5g on: up to %.3g %% of "
                "the interface yields\n",
                c->creepage[held], c->creepage[sliding], 100.0 * yields);
    else if (yields > 0.0)
        fprintf(out, "  nothing sticks at any point: up to %.3g %% of the interface yields\n",
                100.0 * yields);
    else if (sliding > 0) {
        fprintf(out, "  full sliding begins between xi = %.5g and %.5g", c->creepage[held],
                c->creepage[sliding]);
        if (!isnan(c->creep_ratio[sliding]))
            fprintf(out, ", xi R/(mu a) = %.4g and %.4g", c->creep_ratio[held],
                    c->creep_ratio[sliding]);
        fputc('\n', out);
    } else
        fprintf(out, "  full sliding at every point\n");
}

void rb_report_curve_summary(FILE *out, const rb_report_curves *curves)
{
    void *before = rb_locale_begin();
    for (int k = 0; k < curves->n; k++) {
        const rb_rolling_curve *c = &curves->curve[k];
        const int speeds = c->n > 1 && c->speed[0] != c->speed[1],
                  resists = speeds && rb_rolling_relaxes(curves->rc);
        const double mu = reference_mu(curves->rc, curves->mu[k]);
        fprintf(out, "curve, mu%s = %g: %d points in %.2g s, ", mu != curves->mu[k] ? "(0)" : "",
                mu, c->n, c->seconds);
        if (c->unsolved > 0)
            fprintf(out, "%d without a solution, ", c->unsolved);
        fprintf(out, "residual <= %.2g\n", largest(c->n, c->residual));
        if (isfinite(c->free_creepage))
            fprintf(out, "  free rolling (Q = 0) at xi = %.5g\n",
                    c->free_creepage + 0.0); /* -0 is 0 */
        if (resists) {
            int most = 0; /* points without a solution, and bodies without a radius, have none */
            for (int i = 1; i < c->n; i++)
                if (c->resistance_ratio[i] > c->resistance_ratio[most] ||
                    isnan(c->resistance_ratio[most]))
                    most = i;
            if (!isnan(c->resistance_ratio[most]))
                fprintf(out, "  largest resistance to rolling M/(P R) = %.5g at %.5g %s\n",
                        c->resistance_ratio[most], c->speed[most], rb_unit_name(c->units, "mm/s"));
        } else if (c->branch && !speeds) {
            /* How far apart rising and falling creepage are. */
            int most = 0;
            double widest = 0.0;
            for (int i = 0; i < c->rising && c->n == 2 * c->rising; i++) {
                const double width = fabs(c->force_ratio[i] - c->force_ratio[c->n - 1 - i]);
                if (width > widest) {
                    widest = width;
                    most = i;
                }
            }
            if (c->n == 2 * c->rising)
                fprintf(out,
                        "  there and back Q/(mu P) differs by %.2g at most, at xi = %.5g; kappa = "
                        "%.3g\n",
                        widest, c->creepage[most], largest(c->n, c->kappa));
        }
        if (curves->has_errors && resists)
            fprintf(out, "  error of M/(P R) <= %.1g (estimated from coarser meshes)\n",
                    largest(c->n, curves->error[k].resistance_ratio));
        else if (curves->has_errors)
            fprintf(
                out,
                "  error of Q/(mu P) <= %.1g, of P <= %.1g %s (estimated from coarser meshes)\n",
                largest(c->n, curves->error[k].force_ratio),
                largest(c->n, curves->error[k].normal_load), rb_unit_name(c->units, "N/mm"));
        if (c->deviations && resists)
            fprintf(out,
                    "  standard deviation of M/(P R) at most %.2g, from those of --tolerance\n",
                    largest(c->n, c->deviations->resistance_ratio));
        else if (c->deviations)
            fprintf(out, "  standard deviation of Q at most %.2g %s, from those of --tolerance\n",
                    largest(c->n, c->deviations->tangential_load), rb_unit_name(c->units, "N/mm"));
        int points = 0, least = 0;
        for (int i = 0; i < c->n; i++) {
            points += rb_rolling_is_below_zero(c->dissipation[i], c->normal_load[i]);
            if (c->dissipation[i] < c->dissipation[least])
                least = i;
        }
        if (points > 0)
            fprintf(out, "  dissipation below zero at %d point%s, %.2g %s at xi = %.5g: %s\n",
                    points, points > 1 ? "s" : "", c->dissipation[least],
                    rb_unit_name(c->units, "N/mm"), c->creepage[least],
                    rb_rolling_below_zero(curves->rc, &c->last));
        if (!speeds && curves->mu[k] > 0.0)
            write_sliding(out, c);
    }
    rb_locale_end(before);
}

/* ---- Picture ----------------------------------------------------------------------- */

/* y: those of several mu are compared by Q/P; standard deviations are those of Q, because
 * mu and P may be uncertain, too. */
typedef enum { FORCE_RATIO, FORCE_OVER_LOAD, FORCE, RESISTANCE, CREEPAGE } ordinate;

typedef struct {
    const rb_rolling_case *rc;
    const rb_report_curves *curves;
    rb_rolling_variable over; /* x */
    ordinate y;
    int exponent; /* of the axis of xi, x or y, or of M/(P R); 0: of neither */
    double from, to;
    int corner;  /* of the key: 2 right top, 1 left top, 0 right bottom */
    int above_0; /* nothing is below 0 but a sliver of a band */
} view;

static double scale_of(const view *v, int k)
{
    return reference_mu(v->rc, v->curves->mu[k]);
}

static double x_of(const view *v, const rb_rolling_curve *c, int i)
{
    return v->over == RB_OVER_SPEED   ? c->speed[i]
           : v->over == RB_OVER_CREEP ? c->creepage[i] / pow(10.0, v->exponent)
                                      : c->creep_ratio[i];
}

/* 1: the ordinate is counted in powers of ten. */
static int counts_in_powers(const view *v)
{
    return v->y == RESISTANCE || v->y == CREEPAGE;
}

static double y_unit(const view *v)
{
    return counts_in_powers(v) ? pow(10.0, v->exponent) : 1.0;
}

static double y_of(const view *v, const rb_rolling_curve *c, int i, double mu)
{
    return v->y == RESISTANCE        ? c->resistance_ratio[i] / y_unit(v)
           : v->y == CREEPAGE        ? c->creepage[i] / y_unit(v)
           : v->y == FORCE           ? -c->tangential_load[i]
           : v->y == FORCE_OVER_LOAD ? -c->force_ratio[i] * mu
                                     : -c->force_ratio[i];
}

/* The curve of half-widths of a band; NULL: none, as of creepages. */
static const rb_rolling_curve *band_of(const view *v, int k)
{
    return v->y == CREEPAGE        ? NULL
           : v->curves->has_errors ? &v->curves->error[k]
                                   : v->curves->curve[k].deviations;
}

static double half_width(const view *v, int k, int i)
{
    const rb_rolling_curve *band = band_of(v, k);
    return band ? fabs(y_of(v, band, i, scale_of(v, k))) : 0.0;
}

static int has_heat(const view *v)
{
    return v->curves->curve[0].max_temperature != NULL;
}

enum { FEW = 16 }; /* points: markers show where the curve was computed */

static int draws_carter(const view *v)
{
    return v->over != RB_OVER_SPEED && rb_rolling_carter_holds(v->rc);
}

static int last_solved(const rb_rolling_curve *c)
{
    int k = c->n - 1;

    while (k > 0 && isnan(c->normal_load[k]))
        k--;
    return k;
}

/* Speeds are spaced so; an axis without two powers of ten would have fewer than two numbers. */
static int is_logarithmic(const view *v)
{
    return v->over == RB_OVER_SPEED && floor(log10(v->to)) > ceil(log10(v->from));
}

static void write_labels(FILE *out, const view *v)
{
    const rb_rolling_curve *c = &v->curves->curve[0];
    /* Where Hertz's half-width is not that of the contact, that of the last point; of bodies
     * that relax those at the first and the last speed. */
    const int is_own = rb_rolling_has_thickness(v->rc) || !rb_rolling_has_radius(v->rc);
    const double half = is_own ? c->last.half_width : c->half_width;
    char at_first[40] = "";

    if (v->over == RB_OVER_SPEED && rb_rolling_relaxes(v->rc) && !is_own) {
        rb_rolling_case first = *v->rc;
        first.speed = c->speed[0];
        const double load = rb_unit_stored(c->units, "N/mm", c->normal_load[0]);
        rb_format(
            at_first, sizeof at_first, "%s ... ",
            RB_REPORT_NUMBER(
                rb_unit_shown(c->units, "mm", rb_rolling_contact_half_width(&first, load)), 4));
    }
    rb_report_let_text(out, "title", "{/:Bold %s}   P = %s %s,  a = %s%s %s",
                       v->y == RESISTANCE         ? "Rolling resistance"
                       : v->over == RB_OVER_SPEED ? "Rolling friction"
                                                  : "Creep curve",
                       RB_REPORT_NUMBER(c->normal_load[last_solved(c)], 5),
                       rb_unit_name(c->units, "N/mm"), at_first, RB_REPORT_NUMBER(half, 4),
                       rb_unit_name(c->units, "mm"));
    rb_report_let_bodies(out, v->rc, c->units);
    if (counts_in_powers(v))
        rb_report_let_text(out, "y_label", "%s%s",
                           v->y == CREEPAGE ? "creepage ξ" : "resistance to rolling  M/(PR)",
                           RB_REPORT_COUNTED_IN(v->exponent, ""));
    else
        rb_report_let_text(out, "y_label", "braking force  −Q%s",
                           v->y == FORCE ? RB_REPORT_COUNTED_IN(0, rb_unit_name(c->units, "N/mm"))
                           : v->y == FORCE_OVER_LOAD ? "/P"
                                                     : "/(μP)");
    rb_report_let_text(
        out, "x_label", "%s%s",
        v->over == RB_OVER_SPEED   ? "speed"
        : v->over == RB_OVER_CREEP ? "creepage ξ"
                                   : "creepage ratio  ξR/(μa)",
        RB_REPORT_COUNTED_IN(v->over == RB_OVER_CREEP ? v->exponent : 0,
                             v->over == RB_OVER_SPEED ? rb_unit_name(c->units, "mm/s") : ""));
    rb_report_let_text(out, "x_format", "%s",
                       is_logarithmic(v) ? rb_report_log_format(v->from, v->to) : "% h");
}

/* Of the panel below: how hot the surfaces become at each point. */
static double heat_step(const view *v)
{
    double least = INFINITY, most = -INFINITY;

    for (int k = 0; k < v->curves->n; k++)
        for (int i = 0; i < v->curves->curve[k].n; i++) {
            least = fmin(least, v->curves->curve[k].max_temperature[i]);
            most = fmax(most, v->curves->curve[k].max_temperature[i]);
        }
    return most > least ? rb_report_round_step((most - least) / 4.0) : 0.0;
}

/* The way back, where it is another one to the eye. */
static int comes_back_otherwise(const view *v)
{
    for (int k = 0; k < v->curves->n; k++) {
        const rb_rolling_curve *c = &v->curves->curve[k];
        for (int i = c->rising; c->branch && i < c->n; i++) {
            double nearest = INFINITY, there = NAN;
            for (int j = 0; j < c->rising; j++)
                if (fabs(c->creepage[j] - c->creepage[i]) < nearest) {
                    nearest = fabs(c->creepage[j] - c->creepage[i]);
                    there = c->force_ratio[j];
                }
            if (nearest <= 1e-9 * fabs(c->creepage[i]) && fabs(there - c->force_ratio[i]) > 2e-3)
                return 1;
        }
    }
    return 0;
}

static rb_status write_table(FILE *out, const void *of, const rb_report_style *style)
{
    const view *v = of;
    return rb_report_curve_table(out, v->curves, NULL, "", style);
}

/* A list of a number for each curve. */
typedef double number_of_curve(const view *v, int k);

static void let_list(FILE *out, const char *name, const view *v, number_of_curve *number)
{
    char text[RB_REPORT_CURVES * (RB_NUMBER_TEXT + 1)] = "", one[RB_NUMBER_TEXT];

    for (int k = 0; k < v->curves->n; k++)
        rb_append(text, sizeof text, "%s%s", k ? " " : "", rb_number_text(number(v, k), one));
    rb_report_let_text(out, name, "%s", text);
}

static double first_row(const view *v, int k)
{
    double row = 0.0;
    for (int j = 0; j < k; j++)
        row += v->curves->curve[j].n;
    return row;
}

static double rising_row(const view *v, int k)
{
    const rb_rolling_curve *c = &v->curves->curve[k];
    return first_row(v, k) + (c->rising < c->n ? c->rising : c->n) - 1;
}

static double last_row(const view *v, int k)
{
    return first_row(v, k) + v->curves->curve[k].n - 1;
}

static double y_scale(const view *v, int k)
{
    return counts_in_powers(v)       ? pow(10.0, -v->exponent)
           : v->y == FORCE_OVER_LOAD ? -scale_of(v, k)
                                     : -1.0;
}

static double carter_scale(const view *v, int k)
{
    const rb_rolling_curve *c = &v->curves->curve[k];
    return (v->y == FORCE_RATIO ? 1.0 : v->curves->mu[k]) *
           (v->y == FORCE ? c->normal_load[last_solved(c)] : 1.0);
}

static double first_x(const view *v, int k)
{
    return x_of(v, &v->curves->curve[k], 0);
}

static double last_x(const view *v, int k)
{
    return x_of(v, &v->curves->curve[k], v->curves->curve[k].n - 1);
}

static double first_s(const view *v, int k)
{
    return v->curves->curve[k].creep_ratio[0];
}

static double last_s(const view *v, int k)
{
    return v->curves->curve[k].creep_ratio[v->curves->curve[k].n - 1];
}

static void write_inputs(FILE *out, rb_report_canvas canvas, const void *context)
{
    const view *v = context;
    const rb_rolling_curve *c = &v->curves->curve[0];
    const int has_band = band_of(v, 0) != NULL, titled = rb_report_place_of(canvas).titled;
    char x[40], y[40];
    double most = 0.0;

    rb_report_let_table(out, "table", write_table, v);
    rb_report_let_units(out, c->units);
    rb_format(x, sizeof x, v->over == RB_OVER_SPEED ? "speed_%s" : "%s",
              v->over == RB_OVER_SPEED   ? rb_unit_name(c->units, "mm/s")
              : v->over == RB_OVER_CREEP ? "creepage"
                                         : "creep_ratio");
    rb_format(y, sizeof y, v->y == FORCE ? "Q_%s" : "%s",
              v->y == FORCE        ? rb_unit_name(c->units, "N/mm")
              : v->y == RESISTANCE ? "resistance_ratio"
              : v->y == CREEPAGE   ? "creepage"
                                   : "force_ratio");
    rb_report_let_text(out, "x_name", "%s", x);
    rb_report_let_text(out, "y_name", "%s", y);
    rb_report_let_text(out, "band", "%s%s",
                       !has_band               ? ""
                       : v->curves->has_errors ? "error_"
                                               : "deviation_",
                       has_band ? y : "");
    rb_report_let(out, "x_unit", v->over == RB_OVER_CREEP ? pow(10.0, v->exponent) : 1.0);
    rb_report_let(out, "x_from", v->from);
    rb_report_let(out, "x_to", v->to);
    let_list(out, "mu", v, scale_of);
    let_list(out, "first", v, first_row);
    let_list(out, "rising", v, rising_row);
    let_list(out, "last", v, last_row);
    let_list(out, "y_scale", v, y_scale);
    rb_report_let_text(out, "mu_title", "μ %s ", c->branch ? "≤" : "=");
    for (int k = 0; k < v->curves->n; k++)
        for (int i = 0; i < v->curves->curve[k].n; i++)
            most = fmax(most, half_width(v, k, i));
    rb_report_let_band(out, v->curves->has_errors, most * y_unit(v),
                       v->y == FORCE ? rb_unit_name(c->units, "N/mm") : "", titled);
    /* Carter's law; ratio and creepage are proportional */
    rb_report_let_whole(out, "is_carter", draws_carter(v));
    let_list(out, "s_first", v, first_s);
    let_list(out, "s_last", v, last_s);
    let_list(out, "x_first", v, first_x);
    let_list(out, "x_last", v, last_x);
    let_list(out, "carter_scale", v, carter_scale);
    rb_report_let_whole(out, "back", v->over != RB_OVER_SPEED && comes_back_otherwise(v));
    rb_report_let_whole(out, "few", c->rising <= FEW);
    rb_report_let_whole(out, "key_above", v->corner);
    rb_report_let_whole(out, "above_0", v->above_0);
    rb_report_let_whole(out, "logarithmic", is_logarithmic(v));
    rb_report_let_whole(out, "heat", has_heat(v));
    if (has_heat(v))
        rb_report_let(out, "heat_step", heat_step(v));
    write_labels(out, v);
}

rb_status rb_report_curve_picture(FILE *out, rb_report_canvas canvas, const rb_rolling_case *rc,
                                  const rb_report_curves *curves, rb_rolling_variable over,
                                  rb_message *why)
{
    const int uncertain = curves->n > 0 && curves->curve[0].deviations,
              speeds = over == RB_OVER_SPEED;
    view v = {.rc = rc,
              .curves = curves,
              .over = over == RB_OVER_CREEP_RATIO && curves->n > 1 ? RB_OVER_CREEP : over,
              .y = speeds && rb_rolling_relaxes(rc)                       ? RESISTANCE
                   : speeds && isnan(rc->creep) && isnan(rc->creep_ratio) ? CREEPAGE
                   : uncertain                                            ? FORCE
                   : curves->n > 1                                        ? FORCE_OVER_LOAD
                                                                          : FORCE_RATIO};
    for (int k = 0; k < curves->n; k++)
        if (curves->curve[k].n < 2 || (scale_of(&v, k) == 0.0 && v.y != RESISTANCE))
            return rb_fail(why, RB_EINVAL, "no curve to draw at mu = %g", curves->mu[k]);
    double largest = 0.0;
    for (int k = 0; k < v.curves->n; k++) {
        const rb_rolling_curve *c = &v.curves->curve[k];
        for (int i = 0; i < c->n; i++)
            largest =
                fmax(largest, fabs(v.y == RESISTANCE ? c->resistance_ratio[i] : c->creepage[i]));
    }
    v.exponent = speeds && !counts_in_powers(&v) ? 0 : rb_report_exponent(largest);
    v.from = INFINITY;
    v.to = -INFINITY;
    /* over the speed friction does not begin at 0 */
    double least = speeds && !counts_in_powers(&v) ? INFINITY : 0.0, most = -INFINITY, lowest = 0.0;
    for (int k = 0; k < v.curves->n; k++)
        for (int i = 0; i < v.curves->curve[k].n; i++) {
            const double x = x_of(&v, &v.curves->curve[k], i);
            const double y = y_of(&v, &v.curves->curve[k], i, scale_of(&v, k));
            v.from = fmin(v.from, x);
            v.to = fmax(v.to, x);
            least = fmin(least, y);
            most = fmax(most, y);
            lowest = fmin(lowest, y - half_width(&v, k, i));
        }
    v.above_0 = lowest < 0.0 && lowest > -0.02 * most;
    /* The key stands right below, left above if the curves leave it no room there; right above
     * those that fall from one of these corners to the other. */
    const double line = (canvas.size == RB_REPORT_85MM ? 0.05 : 0.035) * (has_heat(&v) ? 1.6 : 1.0);
    const double wide = 0.5, high = 0.08 + line * (curves->n + 1.0);
    int taken[3] = {0, 0, 0};
    for (int k = 0; k < curves->n; k++)
        for (int i = 0; i < curves->curve[k].n; i++) {
            const rb_rolling_curve *c = &curves->curve[k];
            const double x = (x_of(&v, c, i) - v.from) / (v.to - v.from);
            const double y = (y_of(&v, c, i, scale_of(&v, k)) - least) / (most - least);
            taken[0] += x > 1.0 - wide && y < high;
            taken[1] += x < wide && y > 1.0 - high;
            taken[2] += x > 1.0 - wide && y > 1.0 - high;
        }
    v.corner = taken[0] > 0 && taken[1] > 0 && taken[2] == 0 ? 2 : taken[0] > taken[1];
    return rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, "curve", write_inputs, &v, why);
}
