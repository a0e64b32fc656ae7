/* What varies in a study: options of numbers from the command line or the case file, and
 * from a table of cases. */
#include "program/cli/case.h"
#include "program/cli/study.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NO_MEMORY = -1 };

const rb_option *cli_study_option(const char *name)
{
    const rb_option *o = rb_case_option(name);
    for (int k = 0; k < rb_case_crack_options_n && !o; k++)
        if (rb_case_crack_options[k].kind != RB_OPTION_GROUP &&
            strcmp(rb_case_crack_options[k].name, name) == 0)
            o = &rb_case_crack_options[k];
    return o;
}

/* Columns that vary together: one of --vary, or those of --cases; bad: the exit code of
 * what is wrong with one. */
static cli_exit add_column(study *st, const char *source, cli_exit bad, const char *name,
                           const double *value)
{
    study_column *c = &st->column[st->columns];
    c->bad = bad;
    if (st->columns == COLUMNS_MAX || strlen(name) >= sizeof c->name)
        return cli_fail(bad, "%s: '%.60s' is not an option of a case", source, name);
    for (size_t k = 0; k <= strlen(name); k++) {
        c->name[k] = name[k] == '_' ? '-' : name[k];
        c->heading[k] = name[k] == '-' ? '_' : name[k];
    }
    for (int k = 0; k < st->columns; k++)
        if (strcmp(st->column[k].name, c->name) == 0)
            return cli_fail(bad, "%s: '%s' varies already", source, c->name);
    c->factor = st->factors;
    c->value = value;
    st->columns++;
    const rb_option *o = cli_study_option(c->name);
    st->has_crack |= o && o != rb_case_option(c->name);
    return o && (o->kind == RB_OPTION_NUMBER || o->kind == RB_OPTION_INTEGER)
               ? CLI_CONTINUE
               : cli_fail(bad, "%s: '%s' is not an option of a case with a number as value", source,
                          name);
}

static cli_exit add_factor(study *st, const char *source, cli_exit bad, int rows)
{
    const double cases = (double)st->cases * rows;
    if (cases > 1e8)
        return cli_fail(bad, "%s: %g cases, expected at most 1e8", source, cases);
    st->rows[st->factors++] = rows;
    st->cases = (int)cases;
    return CLI_CONTINUE;
}

/* Values of one option as they are typed, and what is wrong with them. */
typedef struct {
    const rb_option *source; /* vary-1, cases: where they stand */
    const rb_option *option;
    rb_units from, to; /* of plain numbers; of the study, which shows the values */
    rb_message why;    /* of a unit; "" otherwise */
} typed;

static typed typed_of(const study *st, const char *source, const char *name)
{
    int at;
    rb_guess none = {.word = source};
    rb_option_find(1, st->own, source, strlen(source), &at, &none);
    return (typed){.source = &st->own->options[at],
                   .option = cli_study_option(name),
                   .from = rb_case_units(st->base, st->own->given[at]),
                   .to = rb_case_units(st->base, RB_GIVEN_ARGUMENT)};
}

/* Plain numbers of the case file are in its units; the case takes all values, and the
 * study shows them, in those of the arguments. */
static double converted(const typed *t, double value)
{
    const char *unit = t->option->unit;
    return t->from == t->to ? value
                            : rb_unit_shown(t->to, unit, rb_unit_stored(t->from, unit, value));
}

/* 1: it is one; a unit may stand behind it. */
static int read_value(typed *t, const char *word, double *value)
{
    int plain;
    if (t->option->kind == RB_OPTION_INTEGER)
        return rb_option_number(word, value);
    if (rb_unit_read(word, t->option->unit, value, &plain, &t->why) != RB_OK)
        return 0;
    *value = plain ? converted(t, *value) : rb_unit_shown(t->to, t->option->unit, *value);
    return 1;
}

/* How many numbers the text has: a list, or "from:to:count", or "from:to:count:log"; 0: it is
 * none of the forms; NO_MEMORY. */
static int read_values(typed *t, char *text, double **value)
{
    int n = 0;
    const size_t most = strlen(text) + 1;
    char *rest, *word = strtok_r(text, " \t,", &rest);
    if (!word)
        return 0;
    if (strchr(word, ':')) {
        double from, to, count;
        char a[64], b[64], how_many[64], kind[8] = "";
        const int parts = sscanf(word, "%63[^:]:%63[^:]:%63[^:]:%7s", a, b, how_many, kind);
        const int logarithmic = parts == 4 && strcmp(kind, "log") == 0;

        if (strtok_r(NULL, " \t,", &rest) || parts < 3 || (parts == 4 && !logarithmic) ||
            !read_value(t, a, &from) || !read_value(t, b, &to) ||
            !rb_option_number(how_many, &count) || !rb_option_in_range(t->source, count) ||
            count != floor(count) || (logarithmic && !(from > 0.0 && to > 0.0)))
            return 0;
        *value = rb_alloc((size_t)count, 1);
        for (int k = 0; *value && k < count; k++) {
            const double part = k / (count - 1.0);
            (*value)[k] = logarithmic ? from * pow(to / from, part) : from + (to - from) * part;
        }
        if (*value)
            (*value)[(int)count - 1] = to;
        return *value ? (int)count : NO_MEMORY;
    }
    *value = rb_alloc(most, 1);
    for (; *value && word; word = strtok_r(NULL, " \t,", &rest))
        if (!read_value(t, word, &(*value)[n++]))
            return 0;
    return *value ? n : NO_MEMORY;
}

static cli_exit add_varied(study *st, int k)
{
    char source[24], name[64];
    int at = 0;

    snprintf(source, sizeof source, "--vary-%d", k + 1);
    /* It stands in the case file or on the command line. */
    const cli_exit bad = rb_option_given(st->own, source + 2) > 0 ? CLI_DATA : CLI_USAGE;
    if (sscanf(st->o->vary[k], "%63s%n", name, &at) != 1)
        return cli_fail(bad, "%s: expected an option and numbers, got '%s'", source,
                        st->o->vary[k]);
    const cli_exit code = add_column(st, source, bad, name, NULL);
    if (code != CLI_CONTINUE)
        return code;
    /* The values behind the name of the column that has just been added. */
    study_column *c = &st->column[st->columns - 1];
    typed t = typed_of(st, source + 2, c->name);
    char *copy = strdup(st->o->vary[k] + at);
    const int rows = copy ? read_values(&t, copy, &st->owned[k]) : NO_MEMORY;
    free(copy);
    if (rows == NO_MEMORY)
        return cli_fail(CLI_INTERNAL, "%s: out of memory", source);
    if (rows == 0 && t.why.text[0])
        return cli_fail(c->bad, "%s: %s: expected %s", source, c->name, t.why.text);
    if (rows == 0)
        return cli_fail(c->bad, "%s: expected an option and numbers, or first:last:count, got '%s'",
                        source, st->o->vary[k]);
    c->value = st->owned[k];
    return add_factor(st, source, c->bad, rows);
}

static cli_exit add_table(study *st)
{
    const char *path = st->o->cases;
    rb_message why = {""};
    const rb_status s = rb_io_table_read(path, &st->table, &why);
    cli_exit code = CLI_CONTINUE;

    if (s != RB_OK)
        return cli_say(s, &why);
    if (!st->table.name)
        return cli_fail(CLI_DATA, "%s: expected a line that names the columns", path);
    for (int j = 0; j < st->table.columns && code == CLI_CONTINUE; j++) {
        double *value = st->table.x + (size_t)j * (size_t)st->table.rows;
        code = add_column(st, path, CLI_DATA, st->table.name[j], value);
        if (code == CLI_CONTINUE) {
            /* The numbers of the table, as typed numbers. */
            const typed t = typed_of(st, "cases", st->column[st->columns - 1].name);
            for (int k = 0; k < st->table.rows; k++)
                value[k] = converted(&t, value[k]);
        }
    }
    return code == CLI_CONTINUE ? add_factor(st, path, CLI_DATA, st->table.rows) : code;
}

cli_exit cli_study_read(study *st)
{
    cli_exit code = CLI_CONTINUE;

    st->cases = 1;
    for (int k = 0; k < st->cracks->n; k++)
        st->has_crack |= st->cracks->given[k] != 0;
    if (st->o->cases)
        code = add_table(st);
    for (int k = 0; k < VARIED_MAX && code == CLI_CONTINUE; k++)
        if (st->o->vary[k])
            code = add_varied(st, k);
    if (code == CLI_CONTINUE && st->factors == 0 && st->o->sample == 0)
        code = cli_fail(CLI_USAGE, "a study needs --vary-1 or --cases, or --sample");
    return code;
}

cli_exit cli_study_sample(study *st, const rb_case *c)
{
    const int n = st->o->sample;
    rb_case_tolerances t;
    rb_message why = {""};
    cli_exit code = CLI_CONTINUE;

    if (!st->o->tolerance)
        return cli_fail(CLI_USAGE, "--sample needs --tolerance NAME=X,...");
    if (rb_case_read_tolerances(c, st->o->tolerance, &t, &why) != RB_OK)
        return cli_fail(CLI_USAGE, "%s", why.text);
    st->sampled = rb_alloc((size_t)n, (size_t)t.n);
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    if (!st->sampled || !rng) {
        gsl_rng_free(rng);
        return cli_fail(CLI_INTERNAL, "out of memory");
    }
    gsl_rng_set(rng, (unsigned long)st->o->seed);
    for (int j = 0; j < t.n && code == CLI_CONTINUE; j++) {
        double *value = st->sampled + (size_t)j * (size_t)n;
        const rb_option *o = rb_case_option(t.name[j]);
        /* n numbers of a standard normal distribution, one from each of n equal parts of
         * its probability, in random order. */
        for (int k = 0; k < n; k++)
            value[k] = gsl_cdf_ugaussian_Pinv((k + gsl_rng_uniform_pos(rng)) / n);
        gsl_ran_shuffle(rng, value, (size_t)n, sizeof *value);
        for (int k = 0; k < n && o; k++)
            value[k] = rb_unit_shown(rb_case_resolved(c)->units, o->unit,
                                     t.value[j] + t.deviation[j] * value[k]);
        code = add_column(st, "--tolerance", CLI_USAGE, t.name[j], value);
    }
    gsl_rng_free(rng);
    return code == CLI_CONTINUE ? add_factor(st, "--sample", CLI_USAGE, n) : code;
}

/* The row of its factor that case k has. */
static int row_of(const study *st, const study_column *c, int k)
{
    for (int f = st->factors - 1; f > c->factor; f--)
        k /= st->rows[f];
    return k % st->rows[c->factor];
}

double cli_study_value(const study *st, const study_column *c, int k)
{
    return c->value[row_of(st, c, k)];
}

/* *bad: the column whose value is no value of its option; NULL: none. */
static rb_status try_values(const study *st, rb_case *c, int k, const study_column **bad,
                            rb_message *why)
{
    *bad = NULL;
    for (int j = 0; j < st->columns; j++) {
        const study_column *column = &st->column[j];
        const rb_status s =
            rb_case_set_number(c, column->name, cli_study_value(st, column, k), why);
        if (s != RB_OK) {
            *bad = column;
            return s;
        }
    }
    return RB_OK;
}

cli_exit cli_study_set_values(const study *st, rb_case *c, int k)
{
    rb_message why = {""};
    const study_column *bad;

    if (try_values(st, c, k, &bad, &why) == RB_OK)
        return CLI_CONTINUE;
    /* The table of cases is the first factor, and is located by its line. */
    return st->o->cases && bad->factor == 0 ? cli_fail(bad->bad, "%s:%d: %s", st->o->cases,
                                                       st->table.line[row_of(st, bad, k)], why.text)
                                            : cli_fail(bad->bad, "case %d: %s", k + 1, why.text);
}

/* The crack of the current case. */
static rb_status check_crack(const study *st, rb_message *why)
{
    const rb_case_crack *crack = rb_case_crack_of(st->one);
    if (!crack)
        return RB_OK;
    if (!isnan(crack->paris))
        return rb_fail(why, RB_EINVAL,
                       "--paris: a study has the K of cracks of given lengths; rollbem "
                       "crack lets one grow");
    return rb_case_crack_check(rb_case_resolved(st->one), crack, why);
}

rb_status cli_study_try_one(study *st, int k, rb_message *why)
{
    const study_column *bad;
    rb_status s = try_values(st, st->one, k, &bad, why);

    if (s == RB_OK)
        s = rb_case_resolve(st->one, why);
    return s == RB_OK ? check_crack(st, why) : s;
}

int cli_study_first(study *st, const rb_case *c)
{
    int k = 0;

    while (st->o->sample > 0 && k < st->cases) {
        rb_message why;
        const study_column *bad;
        rb_case *copy = rb_case_copy(c);
        const int is_case = copy && try_values(st, copy, k, &bad, &why) == RB_OK &&
                            rb_case_resolve(copy, &why) == RB_OK;
        rb_case_free(copy);
        if (is_case)
            return k;
        k++;
    }
    return 0;
}

cli_exit cli_study_check(study *st)
{
    cli_exit code = CLI_CONTINUE;

    st->one = rb_case_copy(st->base);
    if (!st->one)
        return cli_fail(CLI_INTERNAL, "out of memory");
    for (int k = 0; k < st->cases && code == CLI_CONTINUE && st->o->sample == 0; k++) {
        rb_message why = {""};
        code = cli_study_set_values(st, st->one, k);
        if (code == CLI_CONTINUE)
            code = cli_say(rb_case_resolve(st->one, &why), &why);
        const rb_status s = code == CLI_CONTINUE ? check_crack(st, &why) : RB_OK;
        if (s != RB_OK)
            code = cli_fail(cli_exit_of(s), "case %d: %s", k + 1, why.text);
    }
    return code;
}
