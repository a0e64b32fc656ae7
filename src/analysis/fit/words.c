/* What a fit is asked for, in words and columns: names, starts, bounds, data. */
#include "analysis/fit/fit.h"
#include "base/io/io.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char offset_[] = "creep-offset";

/* ---- Names and values -------------------------------------------------------------- */

/* What is measured, or follows from it. */
static int is_measured(const char *name)
{
    static const char *const names[] = {"creep", "creep-ratio", "force", "force-ratio", "shift"};
    int found = 0;

    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
        found |= strcmp(name, names[k]) == 0;
    return found;
}

rb_status rb_case_fit_check_name(const char *name, rb_message *why)
{
    const rb_option *o = rb_case_option(name);
    rb_guess guess = {.word = name};

    if (strcmp(name, offset_) == 0 ||
        (o && o->kind == RB_OPTION_NUMBER && !o->frozen && !is_measured(name)))
        return RB_OK;
    for (int k = 0; k < rb_case_table_n && !o; k++)
        if (rb_case_table[k].kind == RB_OPTION_NUMBER && !rb_case_table[k].frozen)
            rb_guess_try(&guess, rb_case_table[k].name);
    if (!o)
        rb_guess_try(&guess, offset_);
    return rb_refuse(why, "fit", "'%.60s' is not a number that can be fitted to forces%s%s", name,
                     is_measured(name) ? "; creep-offset is added to the measured creepage" : "",
                     rb_guess_text(&guess, ""));
}

static rb_case_parameter *parameter_of(rb_case_fit *fit, const char *name)
{
    for (int j = 0; j < fit->n; j++)
        if (strcmp(fit->parameter[j].name, name) == 0)
            return &fit->parameter[j];
    return NULL;
}

static rb_status read_names(const char *text, rb_case_fit *fit, rb_message *why)
{
    char name[120];

    fit->n = 0;
    for (const char *at = text; (at = rb_next_word(at, name, sizeof name));) {
        if (!*name || strlen(name) >= sizeof fit->parameter->name || parameter_of(fit, name))
            return rb_refuse(why, "fit", "expected different names, got '%.200s'", text);
        if (fit->n == RB_CASE_FIT_MAX)
            return rb_refuse(why, "fit", "expected at most %d names", RB_CASE_FIT_MAX);
        if (rb_case_fit_check_name(name, why) != RB_OK)
            return RB_EINVAL;
        rb_case_parameter *p = &fit->parameter[fit->n++];
        strcpy(p->name, name);
        p->start = NAN;
        p->low = -INFINITY;
        p->high = INFINITY;
    }
    return fit->n > 0 ? RB_OK : rb_refuse(why, "fit", "expected a name, got ''");
}

/* 1: it is a number of the parameter, alone or with a unit. */
static int read_number(const rb_case *c, const rb_case_parameter *p, const char *text, double *x)
{
    const rb_option *o = rb_case_option(p->name);

    return rb_case_read_number(c, text, o ? o->unit : "-", x, NULL) == RB_OK;
}

static rb_status read_values(const rb_case *c, const char *option, const char *text,
                             rb_case_fit *fit, rb_message *why)
{
    const int ranges = strcmp(option, "bounds") == 0;
    char word[120], whole[120];

    while ((text = rb_next_word(text, word, sizeof word))) {
        strcpy(whole, word);
        char *first = strchr(word, '='), *second = first ? strchr(first, ':') : NULL;
        double x = NAN, y = NAN;
        if (first)
            *first++ = '\0';
        if (second)
            *second++ = '\0';
        rb_case_parameter *p = first ? parameter_of(fit, word) : NULL;
        if (!p || !second != !ranges || !read_number(c, p, first, &x) ||
            (ranges && (!read_number(c, p, second, &y) || !(x < y))))
            return rb_refuse(why, option, "expected %s of a fitted number, got '%s'",
                             ranges ? "NAME=A:B, A < B," : "NAME=X", whole);
        if (ranges) {
            p->low = x;
            p->high = y;
        } else {
            p->start = x;
        }
    }
    return RB_OK;
}

/* ---- Data -------------------------------------------------------------------------- */

enum { CREEP, CREEP_RATIO, FORCE, FORCE_RATIO, FORCE_OVER_LOAD, LOAD, SPEED, TEMPERATURE, SIGMA };

#define OPTIONAL RB_IO_COLUMN_OPTIONAL
/* Of a measurement, by the names that people give them. */
static const rb_io_column measured[] = {
    [CREEP] = {"creep", "creepage|longitudinal creepage|longitudinal creep|xi|slip ratio|schlupf",
               "-", OPTIONAL},
    [CREEP_RATIO] = {"creep_ratio", NULL, "-", OPTIONAL},
    [FORCE] = {"force",
               "tangential force|tangential load|longitudinal force|creep force|traction force|"
               "Q|Fx|kraft|tangentialkraft",
               "N/mm", OPTIONAL},
    [FORCE_RATIO] = {"force_ratio", "Q/(mu P)", "-", OPTIONAL},
    [FORCE_OVER_LOAD] = {"force_over_load",
                         "Q/P|Q/N|T/N|T/P|F/N|F/P|traction coefficient|adhesion coefficient|"
                         "coefficient of traction|coefficient of adhesion",
                         "-", OPTIONAL},
    [LOAD] = {"load", "normal load|normal force|P|Fn|Fz|last|normalkraft", "N/mm", OPTIONAL},
    [SPEED] = {"speed", "velocity|rolling speed|V|geschwindigkeit", "mm/s", OPTIONAL},
    [TEMPERATURE] = {"temperature", NULL, "K", OPTIONAL},
    [SIGMA] = {"sigma", "standard deviation|std", "-", OPTIONAL},
    /* what people count and call their points by */
    [SIGMA + 1] = {"test", "run|point|id|label|name|number|no|time", "s", RB_IO_COLUMN_UNUSED}};

enum { COLUMNS = sizeof measured / sizeof *measured };

/* Of a table of rollbem curve or sweep, which has other columns as well. */
static const rb_io_column computed[] = {
    [CREEP] = {"creepage", NULL, "-", OPTIONAL},
    [CREEP_RATIO] = {"xi R/(mu a)", NULL, "-", OPTIONAL},
    [FORCE] = {"Q", "tangential_load", "N/mm", OPTIONAL},
    [FORCE_RATIO] = {"Q/(mu P)", NULL, "-", OPTIONAL},
    [FORCE_OVER_LOAD] = {"Q/P", NULL, "-", OPTIONAL},
    [LOAD] = {"P", "normal_load", "N/mm", OPTIONAL},
    [SPEED] = {"speed", NULL, "mm/s", OPTIONAL},
    [TEMPERATURE] = {"surface temperature", NULL, "K", OPTIONAL},
    [SIGMA] = {"sigma", NULL, "N/mm", OPTIONAL},
    {NULL, NULL, "-", RB_IO_COLUMN_UNUSED}};

/* "creep.tsv:7", or of arrays "data, row 7". */
static const char *place_of(const rb_io_table *t, const char *path, int row, char text[300])
{
    if (t->line)
        snprintf(text, 300, "%.250s:%d", path, t->line[row]);
    else
        snprintf(text, 300, "%.250s, row %d", path, row + 1);
    return text;
}

/* The columns of a curve or of a study; what varies in them besides creepage, load and speed would
 * be another case in every row.  Solved again, one load differs by rounding. */
static rb_status read_computed(const rb_case *c, const char *path, rb_io_table *t, rb_units units,
                               const double **x, rb_message *why)
{
    const int has_load =
        rb_case_given(c, "load") || rb_case_given(c, "half-width") || rb_case_given(c, "approach");
    static const char followed[] = " case creep_ratio creep force force_ratio load half_width "
                                   "approach speed branch ";
    const int study = strcmp(t->name[0], "case") == 0;
    char word[80];
    for (int j = 0; j < t->columns && strcmp(t->name[j], study ? "status" : "creepage") != 0; j++) {
        const double *column = t->x + (size_t)j * (size_t)t->rows;
        const size_t n = strcspn(t->name[j], " ");
        snprintf(word, sizeof word, " %.*s", (int)n, t->name[j]);
        for (char *unit = strrchr(word, '_'); unit && rb_unit_is_known(unit + 1); unit = NULL)
            *unit = '\0';
        strcat(word, " ");
        for (int i = 1; i < t->rows; i++)
            if (column[i] != column[0] && !strstr(followed, word))
                return rb_fail(why, RB_EFORMAT,
                               "%.250s: column '%.60s' varies: expected the points of one case",
                               path, t->name[j]);
    }
    rb_status s =
        rb_io_table_assign(path, t, sizeof computed / sizeof *computed, computed, units, x, why);
    double *load = s == RB_OK && x[LOAD] ? t->x + (x[LOAD] - t->x) : NULL;
    int same = 1, rolls = 0;
    for (int i = 0; load && i < t->rows; i++)
        same &= fabs(load[i] - load[0]) <= 1e-9 * fabs(load[0]);
    for (int i = 0; load && same && i < t->rows; i++)
        load[i] = load[0];
    if (same && has_load)
        x[LOAD] = NULL;
    /* one speed in all rows is that of the case, 0 of a case without */
    for (int i = 0; s == RB_OK && x[SPEED] && i < t->rows; i++)
        rolls |= x[SPEED][i] != x[SPEED][0];
    if (!rolls)
        x[SPEED] = NULL;
    return s;
}

/* The same number in every row. */
static rb_status add_column(rb_io_table *t, const char *name, double value)
{
    const size_t n = (size_t)t->columns, rows = (size_t)t->rows;
    double *x = realloc(t->x, rows * (n + 1) * sizeof *x);
    char **names = x ? realloc(t->name, (n + 1) * sizeof *names) : NULL;

    t->x = x ? x : t->x;
    t->name = names ? names : t->name;
    if (!names || !(names[n] = malloc(strlen(name) + 1)))
        return RB_ENOMEM;
    strcpy(names[n], name);
    for (size_t i = 0; i < rows; i++)
        x[rows * n + i] = value;
    t->columns++;
    return RB_OK;
}

static rb_status missing(const rb_io_table *t, const char *path, rb_message *why)
{
    char listed[200] = "";
    for (int j = 0; t->name && j < t->columns; j++)
        rb_append(listed, sizeof listed, "%s%.60s", j ? ", " : "; got ", t->name[j]);
    return rb_fail(why, RB_EFORMAT,
                   "%.250s: expected a column creep or creep_ratio, and one of force, "
                   "force_ratio, force_over_load%s",
                   path, listed);
}

static rb_status read_data(const rb_case *c, const char *path, rb_io_table *t, double sigma,
                           rb_case_data *d, rb_message *why)
{
    const rb_units units = rb_case_units(c, RB_GIVEN_ARGUMENT);
    char place[300];

    *d = (rb_case_data){.n = t->rows};
    rb_io_column known[COLUMNS];
    const double *x[COLUMNS + 1];
    const int has_creep =
        rb_io_table_has(t, &measured[CREEP]) || rb_io_table_has(t, &measured[CREEP_RATIO]);
    const int has_force = rb_io_table_has(t, &measured[FORCE]) ||
                          rb_io_table_has(t, &measured[FORCE_RATIO]) ||
                          rb_io_table_has(t, &measured[FORCE_OVER_LOAD]);
    rb_message misspelt = {.text = ""};
    if ((!has_creep || !has_force) &&
        rb_io_table_assign(path, t, COLUMNS, measured, units, x, &misspelt) != RB_OK &&
        strstr(misspelt.text, "did you mean"))
        return rb_fail(why, RB_EFORMAT, "%s", misspelt.text);
    if (!has_creep || !has_force)
        return missing(t, path, why);
    const int is_computed = rb_io_table_column(t, "residual") && rb_io_table_column(t, "creepage");
    memcpy(known, measured, sizeof known);
    if (rb_io_table_has(t, &measured[FORCE]))
        known[SIGMA].unit = "N/mm";
    if (!isnan(sigma) && !rb_io_table_has(t, &measured[SIGMA]) &&
        add_column(t, "sigma", sigma) != RB_OK)
        return rb_fail(why, RB_ENOMEM, "out of memory for %d points", d->n);
    const rb_status s = is_computed ? read_computed(c, path, t, units, x, why)
                                    : rb_io_table_assign(path, t, COLUMNS, known, units, x, why);
    if (s != RB_OK)
        return s;
    d->creep = x[CREEP] ? x[CREEP] : x[CREEP_RATIO];
    d->is_ratio = !x[CREEP];
    d->force = x[FORCE] ? x[FORCE] : x[FORCE_RATIO] ? x[FORCE_RATIO] : x[FORCE_OVER_LOAD];
    d->measure = x[FORCE]         ? RB_CASE_FORCE
                 : x[FORCE_RATIO] ? RB_CASE_FORCE_RATIO
                                  : RB_CASE_FORCE_OVER_LOAD;
    d->load = x[LOAD];
    d->speed = x[SPEED];
    d->temperature = x[TEMPERATURE];
    d->sigma = x[SIGMA];
    if (!d->creep || !d->force)
        return missing(t, path, why);
    const struct {
        const char *name;
        const double *x;
        int positive;
    } used[] = {{d->is_ratio ? "creep_ratio" : "creep", d->creep, 0},
                {"force", d->force, 0},
                {"load", d->load, 1},
                {"speed", d->speed, 1},
                {"temperature", d->temperature, 0},
                {"sigma", d->sigma, 1}};
    for (int k = 0; k < d->n; k++)
        for (size_t j = 0; j < sizeof used / sizeof *used; j++)
            if (used[j].x &&
                (!isfinite(used[j].x[k]) || (used[j].positive && !(used[j].x[k] > 0.0))))
                return rb_fail(why, RB_EFORMAT, "%s: %s: expected %s, got %g",
                               place_of(t, path, k, place), used[j].name,
                               used[j].positive ? "> 0" : "a finite number", used[j].x[k]);
    return RB_OK;
}

rb_status rb_case_fit_read(rb_case *c, const rb_case_fit_words *words, const char *path,
                           rb_io_table *table, rb_case_data *data, rb_case_fit *fit,
                           rb_message *why)
{
    rb_status s = read_names(words->names, fit, why);

    if (s == RB_OK)
        s = read_values(c, "start", words->start, fit, why);
    if (s == RB_OK)
        s = read_values(c, "bounds", words->bounds, fit, why);
    if (s == RB_OK && table->rows == 0)
        s = rb_io_table_read(path, table, why);
    if (s == RB_OK)
        s = read_data(c, path, table, words->sigma, data, why);
    return s == RB_OK ? rb_case_prepare_fit(c, data, fit, why) : s;
}
