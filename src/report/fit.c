/* Numbers fitted to a measured creep curve: JSON, table, sentences, picture. */
#include "report/internal.h"
#include "rollbem/case.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static double in_units(const rb_report_fit *f, const char *unit, double x)
{
    return rb_unit_shown(f->units, unit, x);
}

/* Of the measured force. */
static const char *force_unit(const rb_report_fit *f)
{
    return f->data->measure == RB_CASE_FORCE ? "N/mm" : "-";
}

static const char *force_name(const rb_report_fit *f)
{
    return f->data->measure == RB_CASE_FORCE         ? "force"
           : f->data->measure == RB_CASE_FORCE_RATIO ? "force_ratio"
                                                     : "force_over_load";
}

/* ---- JSON ---------------------------------------------------------------------------- */

static json_t *column(const rb_report_fit *f, const double *x, const double *less, const char *unit)
{
    json_t *list = json_array();

    for (int k = 0; k < f->data->n; k++)
        rb_report_json_append(
            &list, rb_report_json_number(in_units(f, unit, x[k] - (less ? less[k] : 0.0))));
    return list;
}

void rb_report_json_fit(json_t **root, const rb_report_fit *f)
{
    const rb_case_fit *fit = f->fit;
    const char *unit = force_unit(f);
    json_t *parameters = json_object(), *curve = json_object(), *sentences = json_array();

    for (int j = 0; j < fit->n; j++) {
        /* A number that the data do not tell is null. */
        const rb_case_parameter *p = &f->fit->parameter[j];
        json_t *object = json_object(), *interval = json_array(), *correlation = json_object();

        rb_report_json_set(
            &object, "value",
            rb_report_json_number(p->identified ? in_units(f, p->unit, p->value) : NAN));
        for (int k = 0; k < 2; k++)
            rb_report_json_append(
                &interval,
                rb_report_json_number(p->identified ? in_units(f, p->unit, p->interval[k]) : NAN));
        rb_report_json_set(&object, "interval", interval);
        for (int i = 0; i < f->fit->n; i++)
            if (i != j)
                rb_report_json_set(&correlation, f->fit->parameter[i].name,
                                   rb_report_json_number(p->correlation[i]));
        rb_report_json_set(&object, "correlation", correlation);
        rb_report_json_set(
            &object, "deviation",
            rb_report_json_number(p->identified ? in_units(f, p->unit, p->deviation) : NAN));
        rb_report_json_set(&object, "unit", json_string(rb_report_unit_name(f->units, p->unit)));
        rb_report_json_set(&object, "identified", json_boolean(p->identified));
        rb_report_json_set(&object, "at_bound", json_boolean(p->at_bound));
        rb_report_json_set(&parameters, fit->parameter[j].name, object);
    }
    rb_report_json_set(root, "parameters", parameters);
    for (const char *at = fit->sentences; *at;) { /* line by line */
        const size_t n = strcspn(at, "\n");
        rb_report_json_append(&sentences, json_stringn(at, n));
        at += n + (at[n] == '\n');
    }
    rb_report_json_set(root, "sentences", sentences);
    rb_report_json_set(root, "level", json_real(fit->level));
    rb_report_json_set(root, "chi_square", rb_report_json_number(fit->chi_square));
    rb_report_json_set(root, "degrees_of_freedom", json_integer(fit->degrees_of_freedom));
    rb_report_json_set(
        root, "noise",
        rb_report_json_number(f->data->sigma ? fit->noise : in_units(f, unit, fit->noise)));
    rb_report_json_set(root, "kappa", rb_report_json_number(fit->kappa));
    rb_report_json_set(root, "iterations", json_integer(fit->iterations));
    rb_report_json_set(&curve, f->data->is_ratio ? "creep_ratio" : "creep",
                       column(f, f->data->creep, NULL, "-"));
    rb_report_json_set(&curve, force_name(f), column(f, f->data->force, NULL, unit));
    rb_report_json_set(&curve, "fitted", column(f, fit->model, NULL, unit));
    rb_report_json_set(&curve, "band", column(f, fit->band, NULL, unit));
    rb_report_json_set(root, "residuals", column(f, f->data->force, fit->model, unit));
    rb_report_json_set(root, "fit", curve);
}

/* ---- Words --------------------------------------------------------------------------- */

/* Behind a number: a blank and its unit, or nothing. */
static const char *unit_behind(const rb_report_fit *f, const char *unit, char text[20])
{
    const int has = strcmp(unit, "-") != 0;

    snprintf(text, 20, "%s%s", has ? " " : "", has ? rb_unit_name(f->units, unit) : "");
    return text;
}

static void write_parameter(char *text, size_t size, const rb_report_fit *f, int j)
{
    const rb_case_parameter *p = &f->fit->parameter[j];
    char unit[20];

    if (p->identified)
        snprintf(text, size, "%-22s %12.6g   %.4g ... %.4g%s", p->name,
                 in_units(f, p->unit, p->value), in_units(f, p->unit, p->interval[0]),
                 in_units(f, p->unit, p->interval[1]), unit_behind(f, p->unit, unit));
    else
        snprintf(text, size, "%-22s not identified", p->name);
}

rb_status rb_report_fit_table(FILE *out, const rb_report_fit *f, const char *command,
                              const rb_report_style *style)
{
    char names[100], line[200];

    snprintf(names, sizeof names, "%s %s fitted residual band",
             f->data->is_ratio ? "creep_ratio" : "creep", force_name(f));
    rb_report_cells c = rb_report_cells_begin(out, style, names);
    rb_report_comment_origin(&c, command);
    for (int j = 0; j < f->fit->n; j++) {
        write_parameter(line, sizeof line, f, j);
        rb_report_comment(&c, "%s", line);
    }
    for (const char *at = f->fit->sentences; *at;) {
        const size_t n = strcspn(at, "\n");
        rb_report_comment(&c, "%.*s", (int)n, at);
        at += n + (at[n] == '\n');
    }
    if (f->data->measure == RB_CASE_FORCE)
        rb_report_comment(&c, "forces in %s", rb_report_unit_name(f->units, "N/mm"));
    rb_report_comment(&c, "intervals and band of %g %%", 100.0 * f->fit->level);
    for (int k = 0; k < f->data->n; k++) {
        const char *unit = force_unit(f);
        rb_report_cell_number(&c, f->data->creep[k]);
        rb_report_cell_number(&c, in_units(f, unit, f->data->force[k]));
        rb_report_cell_number(&c, in_units(f, unit, f->fit->model[k]));
        rb_report_cell_number(&c, in_units(f, unit, f->data->force[k] - f->fit->model[k]));
        rb_report_cell_number(&c, in_units(f, unit, f->fit->band[k]));
        rb_report_cells_end_row(&c);
    }
    return rb_report_flush(out);
}

void rb_report_fit_summary(FILE *out, const rb_report_fit *f)
{
    char line[200], unit[20];

    fprintf(out, "fit of %d points, %d steps, %d degrees of freedom, intervals of %g %%\n",
            f->data->n, f->fit->iterations, f->fit->degrees_of_freedom, 100.0 * f->fit->level);
    for (int j = 0; j < f->fit->n; j++) {
        write_parameter(line, sizeof line, f, j);
        fprintf(out, "  %s\n", line);
    }
    if (f->data->sigma)
        fprintf(out, "  residuals are %.3g of their standard deviations\n", f->fit->noise);
    else
        fprintf(out, "  residuals have a standard deviation of %.3g%s\n",
                in_units(f, force_unit(f), f->fit->noise), unit_behind(f, force_unit(f), unit));
    fputs(f->fit->sentences, out);
}

/* ---- Picture ------------------------------------------------------------------------- */

static int by_creepage(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void write_script(FILE *out, rb_report_canvas canvas, const void *context)
{
    const rb_report_fit *f = context;
    const rb_report_place place = rb_report_place_of(canvas);
    const int n = f->data->n;
    const char *unit = force_unit(f);
    double(*row)[4] = calloc((size_t)n, sizeof *row), most = 0.0;
    for (int k = 0; k < n; k++)
        most = fmax(most, fabs(f->data->creep[k]));
    const int power = rb_report_exponent(most);

    for (int k = 0; row && k < n; k++) {
        row[k][0] = f->data->creep[k] / pow(10.0, power);
        row[k][1] = in_units(f, unit, f->data->force[k]);
        row[k][2] = in_units(f, unit, f->fit->model[k]);
        row[k][3] = in_units(f, unit, f->fit->band[k]);
    }
    if (row)
        qsort(row, (size_t)n, sizeof *row, by_creepage);
    fputs("$fit << EOD\n", out);
    for (int k = 0; row && k < n; k++)
        fprintf(out, "%.9g %.9g %.9g %.9g\n", row[k][0], row[k][1], row[k][2], row[k][3]);
    fputs("EOD\n", out);
    free(row);
    rb_report_room(out, 0.15 + place.right, 0.965, 0.14 + place.up, 0.9 + place.up);
    fputs(RB_REPORT_GRID "set offsets graph 0.03,graph 0.03,graph 0.05,graph 0.05\n"
                         "set zeroaxis linecolor rgb '#999999' linewidth 0.6\n",
          out);
    fprintf(out, "set key at screen %g, %g center top horizontal samplen 2.2 font ',%.3g'\n", 0.55,
            0.935, rb_report_key_font(canvas));
    if (place.titled)
        fputs("set label 1 '{/:Bold Fitted creep curve}' at screen 0.55, 0.965 center\n", out);
    fprintf(out, "set xlabel 'creepage %s", f->data->is_ratio ? "ratio  ξR/(μa)" : "ξ");
    if (power)
        fprintf(out, "  [10^{%d}]", power);
    fprintf(out, "'\nset ylabel 'force on A  %s%s%s'\n",
            f->data->measure == RB_CASE_FORCE         ? "Q  ["
            : f->data->measure == RB_CASE_FORCE_RATIO ? "Q/(μP)"
                                                      : "Q/P",
            f->data->measure == RB_CASE_FORCE ? rb_report_unit_name(f->units, unit) : "",
            f->data->measure == RB_CASE_FORCE ? "]" : "");
    fprintf(out,
            "plot $fit using 1:($3-$4):($3+$4) with filledcurves linecolor rgb '%s' fillstyle "
            "transparent solid 0.25 noborder title '%g %% of the fit', $fit using 1:3 with lines "
            "linecolor rgb '%s' linewidth 2.2 title 'fit', $fit using 1:2 with points pointtype 6 "
            "linecolor rgb '#111111' title 'measured'\n",
            rb_report_colour(0), 100.0 * f->fit->level, rb_report_colour(0));
}

rb_status rb_report_fit_picture(FILE *out, rb_report_canvas canvas, const rb_report_fit *f,
                                rb_message *why)
{
    for (int k = 0; k < f->data->n; k++)
        if (!isfinite(f->fit->band[k]))
            return rb_fail(why, RB_EINVAL,
                           "no band to draw: the data do not determine all of these numbers");
    return rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, write_script, f, why);
}
