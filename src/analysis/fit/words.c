/* What a fit is asked for, in words and columns: names, starts, bounds, data. */
#include "analysis/fit/fit.h"
#include "rollbem/io.h"

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
    return rb_fail(why, RB_EINVAL,
                   "--fit: '%.60s' is not a number that can be fitted to forces%s%s", name,
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
            return rb_fail(why, RB_EINVAL, "--fit: expected different names, got '%.200s'", text);
        if (fit->n == RB_CASE_FIT_MAX)
            return rb_fail(why, RB_EINVAL, "--fit: expected at most %d names", RB_CASE_FIT_MAX);
        if (rb_case_fit_check_name(name, why) != RB_OK)
            return RB_EINVAL;
        rb_case_parameter *p = &fit->parameter[fit->n++];
        strcpy(p->name, name);
        p->start = NAN;
        p->low = -INFINITY;
        p->high = INFINITY;
    }
    return fit->n > 0 ? RB_OK : rb_fail(why, RB_EINVAL, "--fit: expected a name, got ''");
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
            return rb_fail(why, RB_EINVAL, "--%s: expected %s of a fitted number, got '%s'", option,
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

static const char *const columns[] = {"creep",           "creep_ratio", "force",
                                      "force_ratio",     "load",        "speed",
                                      "force_over_load", "temperature", "sigma"};

enum { COLUMNS = sizeof columns / sizeof *columns };

/* "creep.tsv:7", or of arrays "data, row 7". */
static const char *place_of(const rb_io_table *t, const char *path, int row, char text[300])
{
    if (t->line)
        snprintf(text, 300, "%.250s:%d", path, t->line[row]);
    else
        snprintf(text, 300, "%.250s, row %d", path, row + 1);
    return text;
}

/* The column of that name, or of that name with a unit, in mm, N, MPa; NULL: there is none. */
static const double *column(rb_io_table *t, const char *name, const char *unit, rb_units units)
{
    for (int j = 0; j < t->columns && t->name; j++) {
        const char *known;
        const size_t n = strlen(name);
        if (strncmp(t->name[j], name, n) != 0 ||
            (t->name[j][n] && rb_unit_of_column(t->name[j], unit, &known) != n))
            continue;
        rb_io_table_convert(t, j, unit, units);
        return t->x + (size_t)j * (size_t)t->rows;
    }
    return NULL;
}

/* A column that nobody reads is no matter unless it is a misspelt one. */
static rb_status check_names(const rb_io_table *t, const char *path, rb_message *why)
{
    for (int j = 0; j < t->columns && t->name; j++) {
        rb_guess guess = {.word = t->name[j]};
        int known = 0;
        for (int k = 0; k < COLUMNS; k++) {
            known |= strcmp(t->name[j], columns[k]) == 0;
            rb_guess_try(&guess, columns[k]);
        }
        const char *meant = rb_guess_text(&guess, "");
        if (!known && *meant)
            return rb_fail(why, RB_EFORMAT, "%.250s: unknown column '%.60s'%s", path, t->name[j],
                           meant);
    }
    return RB_OK;
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

static rb_status read_data(const rb_case *c, const char *path, rb_io_table *t, double sigma,
                           rb_case_data *d, rb_message *why)
{
    const rb_units units = rb_case_units(c, RB_GIVEN_ARGUMENT);
    char place[300];

    *d = (rb_case_data){.n = t->rows};
    if (t->name && !isnan(sigma) && !rb_io_table_column(t, "sigma") &&
        add_column(t, "sigma", sigma) != RB_OK)
        return rb_fail(why, RB_ENOMEM, "out of memory for %d points", d->n);
    d->creep = column(t, "creep", "-", units);
    d->is_ratio = !d->creep;
    if (!d->creep)
        d->creep = column(t, "creep_ratio", "-", units);
    d->force = column(t, "force", "N/mm", units);
    d->measure = RB_CASE_FORCE;
    if (!d->force && (d->force = column(t, "force_ratio", "-", units)) != NULL)
        d->measure = RB_CASE_FORCE_RATIO;
    if (!d->force && (d->force = column(t, "force_over_load", "-", units)) != NULL)
        d->measure = RB_CASE_FORCE_OVER_LOAD;
    const char *unit = d->measure == RB_CASE_FORCE ? "N/mm" : "-";
    d->load = column(t, "load", "N/mm", units);
    d->speed = column(t, "speed", "mm/s", units);
    d->temperature = column(t, "temperature", "K", units);
    d->sigma = column(t, "sigma", unit, units);
    const rb_status s = check_names(t, path, why);
    if (s != RB_OK)
        return s;
    if (!d->creep || !d->force)
        return rb_fail(why, RB_EFORMAT,
                       "%.250s: expected a column creep or creep_ratio, and one of force, "
                       "force_ratio, force_over_load",
                       path);
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
