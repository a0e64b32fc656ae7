/* Numbers fitted to a measured creep curve: JSON, table, sentences, picture. */
#include "program/report/internal.h"
#include "analysis/fit/fit_case.h"
#include "rolling/case/case.h"

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
        rb_report_json_set(
            &object, "mesh",
            rb_report_json_number(p->identified ? in_units(f, p->unit, p->mesh) : NAN));
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

/* What the intervals hold. */
static const char *hold(const rb_report_fit *f)
{
    int known = 0;
    for (int j = 0; j < f->fit->n; j++)
        known |= !isnan(f->fit->parameter[j].mesh);
    return known ? "intervals hold the noise in the data; +- is what the mesh leaves"
                 : "intervals hold the noise in the data, not the error of the mesh (--error "
                   "adds it)";
}

static void write_parameter(char *text, size_t size, const rb_report_fit *f, int j)
{
    const rb_case_parameter *p = &f->fit->parameter[j];
    char unit[20], mesh[40] = "";

    if (!isnan(p->mesh))
        snprintf(mesh, sizeof mesh, ", +- %.2g by the mesh", in_units(f, p->unit, p->mesh));
    if (p->identified)
        snprintf(text, size, "%-22s %12.6g   %.6g ... %.6g%s%s", p->name,
                 in_units(f, p->unit, p->value), in_units(f, p->unit, p->interval[0]),
                 in_units(f, p->unit, p->interval[1]), unit_behind(f, p->unit, unit), mesh);
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
    rb_report_comment(&c, "intervals and band of %g %%; %s", 100.0 * f->fit->level, hold(f));
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

    fprintf(out, "fit of %d points, %d step%s, %d degrees of freedom, intervals of %g %%\n",
            f->data->n, f->fit->iterations, rb_plural(f->fit->iterations),
            f->fit->degrees_of_freedom, 100.0 * f->fit->level);
    fprintf(out, "  %s\n", hold(f));
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

/* A row of the data; rows under the same conditions are one test, with one curve. */
typedef struct {
    int test, row;
    double creep;
} point;

typedef struct {
    const rb_report_fit *fit;
    point *point; /* by test, then by creepage */
    int tests, exponent;
    double widest; /* half-width of the band; NAN: some number is not identified */
} view;

enum { NAMED = 8 }; /* tests that have a line in the key */

static int by_test(const void *a, const void *b)
{
    const point *p = a, *q = b;
    return p->test != q->test ? p->test - q->test : (p->creep > q->creep) - (p->creep < q->creep);
}

/* Measured conditions scatter. */
static int is_near(const double *column, int i, int k)
{
    return !column || fabs(column[i] - column[k]) <= 0.02 * fmax(fabs(column[i]), fabs(column[k]));
}

/* Appends "P = 500 N/mm": what tells this test from the others. */
static void append_conditions(char *text, size_t size, const view *v, int test)
{
    const rb_case_data *d = v->fit->data;
    const struct {
        const double *column;
        const char *name, *unit;
    } all[] = {{d->load, "P", "N/mm"}, {d->speed, "V", "mm/s"}, {d->temperature, "T", "K"}};
    const char *between = "";

    for (size_t c = 0; c < sizeof all / sizeof *all; c++) {
        double sum = 0.0;
        int n = 0, varies = 0;
        for (int k = 0; all[c].column && k < d->n; k++) {
            varies |= !is_near(all[c].column, 0, k);
            if (v->point[k].test == test) {
                sum += all[c].column[v->point[k].row];
                n++;
            }
        }
        if (!varies)
            continue;
        rb_append(text, size, "%s%s = %s %s", between, all[c].name,
                  RB_REPORT_NUMBER(in_units(v->fit, all[c].unit, sum / n), 4),
                  rb_unit_name(v->fit->units, all[c].unit));
        between = ", ";
    }
}

/* Names, values and intervals, as far as they are identified; without the intervals where the
 * line would be too long. */
static void write_numbers(FILE *out, const rb_report_fit *f)
{
    enum { FITS = 90, LONG = 125 }; /* characters in a line, and in one of smaller letters */
    char text[RB_CASE_FIT_MAX * 120], unit[20];

    for (int intervals = 1; intervals >= 0; intervals--) {
        text[0] = '\0';
        for (int j = 0; j < f->fit->n; j++) {
            const rb_case_parameter *p = &f->fit->parameter[j];
            rb_append(text, sizeof text, "%s%s %s", j ? ";  " : "", p->name,
                      p->identified ? RB_REPORT_NUMBER(in_units(f, p->unit, p->value), 4)
                                    : "not identified");
            if (p->identified && intervals)
                rb_append(text, sizeof text, " (%s … %s)",
                          RB_REPORT_NUMBER(in_units(f, p->unit, p->interval[0]), 3),
                          RB_REPORT_NUMBER(in_units(f, p->unit, p->interval[1]), 3));
            if (p->identified)
                rb_append(text, sizeof text, "%s", unit_behind(f, p->unit, unit));
        }
        if (strlen(text) <= LONG)
            break;
    }
    const size_t n = strlen(text);
    rb_report_let_text(out, "numbers", "{/*%.3g %s}", n > FITS ? 0.95 * FITS / (double)n : 0.95,
                       text);
}

/* A list of the tests: their first rows among the points, their last ones, or which tests have
 * several points or one. */
typedef enum { FIRST, LAST, JOINED, SINGLE } list_kind;

static void write_list(FILE *out, const char *name, const view *v, list_kind kind)
{
    const int n = v->fit->data->n;

    fprintf(out, "%s = '", name);
    for (int k = 0, begin = 0; k < n; k++) {
        if (k + 1 < n && v->point[k + 1].test == v->point[k].test)
            continue;
        if (kind == FIRST || kind == LAST)
            fprintf(out, " %d", kind == FIRST ? begin : k);
        else if ((kind == SINGLE) == (k == begin))
            fprintf(out, " %d", v->point[k].test + 1);
        begin = k + 1;
    }
    fputs("'\n", out);
}

/* Forces as in the picture of a curve: those that brake, -Q, upwards. */
static void write_points(FILE *out, const view *v)
{
    const rb_report_fit *f = v->fit;
    const char *unit = force_unit(f);

    fputs("$points << EOD\nx measured fitted band\n", out);
    for (int k = 0; k < f->data->n; k++) {
        const point *at = &v->point[k];
        fprintf(out, "%.9g %.9g %.9g %.9g\n", at->creep / pow(10.0, v->exponent),
                -in_units(f, unit, f->data->force[at->row]),
                -in_units(f, unit, f->fit->model[at->row]),
                isnan(v->widest) ? 0.0 : in_units(f, unit, f->fit->band[at->row]));
    }
    fputs("EOD\n", out);
    write_list(out, "first", v, FIRST);
    write_list(out, "last", v, LAST);
    write_list(out, "joined", v, JOINED);
    write_list(out, "single", v, SINGLE);
}

static rb_status write_table(FILE *out, const void *of, const rb_report_style *style)
{
    return rb_report_fit_table(out, of, "", style);
}

static void write_inputs(FILE *out, rb_report_canvas canvas, const void *context)
{
    const view *v = context;
    const rb_report_fit *f = v->fit;
    const rb_case_data *d = f->data;
    const int titled = rb_report_place_of(canvas).titled;
    const int named = v->tests > 1 && v->tests <= NAMED;
    const char *unit = force_unit(f);
    char text[200], name[20];
    double sum = 0.0;
    int drives = 0, pushes = 0; /* creepage and -Q below zero */

    for (int k = 0; k < d->n; k++) {
        sum += d->creep[k];
        drives |= d->creep[k] < 0.0;
        pushes |= d->force[k] > 0.0;
    }
    rb_report_let_table(out, "table", write_table, f);
    rb_report_let_units(out, f->units);
    write_points(out, v);
    rb_report_let_whole(out, "named", named);
    for (int t = 0; named && t < v->tests; t++) {
        text[0] = '\0';
        append_conditions(text, sizeof text, v, t);
        snprintf(name, sizeof name, "name%d", t + 1);
        rb_report_let_text(out, name, "%s", text);
    }
    rb_report_let_whole(out, "drives", drives);
    rb_report_let_whole(out, "pushes", pushes);
    rb_report_let_whole(out, "brakes", sum >= 0.0);
    rb_report_let_text(out, "title", "{/:Bold Fitted creep curve}   %d points", d->n);
    write_numbers(out, f);
    rb_report_let_text(out, "x_label", "creepage %s%s", d->is_ratio ? "ratio  ξR/(μa)" : "ξ",
                       RB_REPORT_COUNTED_IN(v->exponent, ""));
    rb_report_let_text(out, "y_label", "braking force  −Q%s",
                       d->measure == RB_CASE_FORCE
                           ? RB_REPORT_COUNTED_IN(0, rb_unit_name(f->units, unit))
                       : d->measure == RB_CASE_FORCE_RATIO ? "/(μP)"
                                                           : "/P");
    rb_report_let_whole(out, "banded", !isnan(v->widest));
    /* at most so much where there is room: a thin band hides behind its curve */
    snprintf(text, sizeof text, "%g %% %sband", 100.0 * f->fit->level, titled ? "confidence " : "");
    if (titled && !isnan(v->widest))
        rb_append(text, sizeof text, ", at most ±%s%s",
                  RB_REPORT_NUMBER(in_units(f, unit, v->widest), 2), unit_behind(f, unit, name));
    rb_report_let_text(out, "band_title", "%s", text);
}

rb_status rb_report_fit_picture(FILE *out, rb_report_canvas canvas, const rb_report_fit *f,
                                rb_message *why)
{
    const rb_case_data *d = f->data;
    const size_t n = (size_t)d->n;
    rb_arena scratch = {0};
    int *first = rb_arena_ints(&scratch, n); /* points of the tests */
    view v = {.fit = f, .point = rb_arena_zeros(&scratch, n, sizeof *v.point)};
    double most = 0.0;
    int banded = 1;

    if (scratch.failed)
        return rb_fail(why, rb_arena_done(&scratch, RB_ENOMEM), "out of memory");
    for (int k = 0; k < d->n; k++) {
        int t = 0;
        while (t < v.tests && !(is_near(d->load, first[t], k) && is_near(d->speed, first[t], k) &&
                                is_near(d->temperature, first[t], k)))
            t++;
        if (t == v.tests)
            first[v.tests++] = k;
        v.point[k] = (point){t, k, d->creep[k]};
        most = fmax(most, fabs(d->creep[k]));
        banded &= isfinite(f->fit->band[k]) != 0;
        v.widest = fmax(v.widest, f->fit->band[k]);
    }
    if (!banded)
        v.widest = NAN;
    v.exponent = rb_report_exponent(most);
    qsort(v.point, n, sizeof *v.point, by_test);
    return rb_arena_done(
        &scratch, rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, "fit", write_inputs, &v, why));
}
