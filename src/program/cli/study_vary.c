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

/* Options that differ from case to case: numbers, and words, but those that all rows of a table
 * have in common. */
static int may_vary(const rb_option *o)
{
    static const char *const common[] = {"units", "error", "solver", "lcp-form"};
    int may = o->kind != RB_OPTION_GROUP && o->kind != RB_OPTION_TEXT;
    for (size_t k = 0; k < sizeof common / sizeof *common; k++)
        may &= strcmp(o->name, common[k]) != 0;
    return may;
}

/* Columns that vary together: one of --vary, or those of --cases; bad: the exit code of
 * what is wrong with one; o NULL: a label. */
static cli_exit add_column(study *st, const char *source, cli_exit bad, const char *name,
                           const rb_option *o)
{
    study_column *c = &st->column[st->columns];
    c->bad = bad;
    c->option = o;
    if (o && o->file == RB_FILE_READ && !may_vary(o))
        return cli_fail(bad,
                        "%s: '%s' is the name of a file, and a study varies numbers and words; "
                        "run one case for each file",
                        source, o->name);
    if (st->columns == COLUMNS_MAX || strlen(name) >= sizeof c->name || (o && !may_vary(o)))
        return cli_fail(bad,
                        "%s: '%.60s' is not an option of a case with a number as value, or "
                        "with words that vary",
                        source, name);
    for (size_t k = 0; k <= strlen(name); k++) {
        c->name[k] = o && name[k] == '_' ? '-' : name[k];
        c->heading[k] = o && name[k] == '-' ? '_' : name[k];
    }
    if (!o && (strcmp(name, "case") == 0 || strcmp(name, "status") == 0))
        strcpy(c->heading, "label"); /* the table has columns of these names */
    for (int k = 0; k < st->columns; k++)
        if (strcmp(st->column[k].name, c->name) == 0 ||
            strcmp(st->column[k].heading, c->heading) == 0)
            return cli_fail(bad, "%s: '%s' varies already", source, c->name);
    c->factor = st->factors;
    st->columns++;
    st->has_crack |= o && o != rb_case_option(c->name);
    return CLI_CONTINUE;
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

static typed typed_of(const study *st, const char *source, const rb_option *option)
{
    int at;
    rb_guess none = {.word = source};
    rb_option_find(1, st->own, source, strlen(source), &at, &none);
    return (typed){.source = &st->own->options[at],
                   .option = option,
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

static int is_choice(const rb_option *o, const char *word)
{
    static const rb_choice flags[] = {{"yes", 1}, {"no", 0}, {"true", 1}, {"false", 0}, {NULL, 0}};
    const rb_choice *c = o->kind == RB_OPTION_CHOICE ? o->choices
                         : o->kind == RB_OPTION_FLAG ? flags
                                                     : NULL;
    for (; c && c->name; c++)
        if (strcmp(c->name, word) == 0)
            return 1;
    return (o->word && strcmp(o->word, word) == 0) || (o->path && *word);
}

/* 1: it is a value of the option: a number, behind which a unit may stand, or a word, with the
 * number NAN. */
static int read_value(typed *t, const char *word, double *value)
{
    int plain;
    *value = NAN;
    if (is_choice(t->option, word))
        return 1;
    if (t->option->kind == RB_OPTION_INTEGER)
        return rb_option_number(word, value);
    if (t->option->kind != RB_OPTION_NUMBER ||
        rb_unit_read(word, t->option->unit, value, &plain, &t->why) != RB_OK)
        return 0;
    *value = plain ? converted(t, *value) : rb_unit_shown(t->to, t->option->unit, *value);
    return 1;
}

/* A list "from:to:count", or "from:to:count:log": how many values; 0: it is none; NO_MEMORY. */
static int read_range(typed *t, const char *word, double **value)
{
    double from, to, count;
    char a[64], b[64], how_many[64], kind[8] = "";
    const int parts = sscanf(word, "%63[^:]:%63[^:]:%63[^:]:%7s", a, b, how_many, kind);
    const int logarithmic = parts == 4 && strcmp(kind, "log") == 0;

    if (parts < 3 || (parts == 4 && !logarithmic) || !read_value(t, a, &from) ||
        !read_value(t, b, &to) || isnan(from) || isnan(to) || !rb_option_number(how_many, &count) ||
        !rb_option_in_range(t->source, count) || count != floor(count) ||
        (logarithmic && !(from > 0.0 && to > 0.0)))
        return 0;
    *value = rb_alloc((size_t)count, 1);
    if (!*value)
        return NO_MEMORY;
    for (int k = 0; k < count; k++) {
        const double part = k / (count - 1.0);
        (*value)[k] = logarithmic ? from * pow(to / from, part) : from + (to - from) * part;
    }
    (*value)[(int)count - 1] = to;
    return (int)count;
}

/* How many values the text has: a list, or a range; 0: it is none of the forms; NO_MEMORY.
 * words: of values that are words; NULL: none is. */
static int read_values(typed *t, char *text, double **value, char ***words)
{
    int n = 0, some = 0, bad = 0;
    const size_t most = strlen(text) + 1;
    char *rest, *word = strtok_r(text, " \t,", &rest);
    if (!word)
        return 0;
    if (strchr(word, ':'))
        return strtok_r(NULL, " \t,", &rest) ? 0 : read_range(t, word, value);
    *value = rb_alloc(most, 1);
    *words = calloc(most, sizeof **words);
    if (!*value || !*words)
        return NO_MEMORY;
    for (; word && !bad; word = strtok_r(NULL, " \t,", &rest), n++) {
        bad = !read_value(t, word, &(*value)[n]);
        if (bad || !isnan((*value)[n]))
            continue;
        some = 1;
        if (((*words)[n] = strdup(word)) == NULL)
            return NO_MEMORY;
    }
    if (!some) {
        free(*words);
        *words = NULL;
    }
    return bad ? 0 : n;
}

/* An option by its name, with _ for - or not. */
static const rb_option *option_of(const char *name)
{
    char own[64];
    snprintf(own, sizeof own, "%s", name);
    for (char *c = own; *c; c++)
        *c = *c == '_' ? '-' : *c;
    return cli_study_option(own);
}

static cli_exit unknown(cli_exit bad, const char *source, const char *name)
{
    rb_guess guess = {.word = name};
    for (const rb_option *o = rb_case_table; o < rb_case_table + rb_case_table_n; o++)
        if (may_vary(o))
            rb_guess_try(&guess, o->name);
    return cli_fail(
        bad, "%s: '%.60s' is not an option of a case with a number as value, or with words%s",
        source, name, rb_guess_text(&guess, ""));
}

static cli_exit add_varied(study *st, int k)
{
    char option[16], source[400], name[64];
    int at = 0, place = 0;

    snprintf(option, sizeof option, "vary-%d", k + 1);
    while (strcmp(st->own->options[place].name, option) != 0)
        place++;
    const int by = st->own->given[place];
    const cli_exit bad = by > 0 ? CLI_DATA : CLI_USAGE;
    rb_option_source(&st->own->options[place], by, st->file, source, sizeof source);
    if (sscanf(st->o->vary[k], "%63s%n", name, &at) != 1)
        return cli_fail(bad, "%s: expected an option and numbers, got '%s'", source,
                        st->o->vary[k]);
    const rb_option *o = option_of(name);
    if (!o)
        return unknown(bad, source, name);
    const cli_exit code = add_column(st, source, bad, name, o);
    if (code != CLI_CONTINUE)
        return code;
    /* The values behind the name of the column that has just been added. */
    study_column *c = &st->column[st->columns - 1];
    typed t = typed_of(st, option, o);
    char *copy = strdup(st->o->vary[k] + at);
    st->owned_n[k] = strlen(st->o->vary[k] + at) + 1;
    const int rows = copy ? read_values(&t, copy, &st->owned[k], &st->owned_words[k]) : NO_MEMORY;
    free(copy);
    if (rows == NO_MEMORY)
        return cli_fail(CLI_INTERNAL, "%s: out of memory", source);
    if (rows == 0 && t.why.text[0])
        return cli_fail(c->bad, "%s: %s: expected %s", source, c->name, t.why.text);
    char expected[200] = "numbers, or first:last:count";
    if (rows == 0 && o->kind == RB_OPTION_CHOICE)
        rb_option_expected(o, expected, sizeof expected);
    if (rows == 0)
        return cli_fail(c->bad, "%s: expected an option and %s, got '%s'", source,
                        o->kind == RB_OPTION_FLAG ? "yes or no" : expected, st->o->vary[k]);
    c->value = st->owned[k];
    c->word = st->owned_words[k];
    return add_factor(st, source, c->bad, rows);
}

/* The option of a heading, with the factor of the unit in it; NULL: none.  *is_unit: what stands
 * behind the name of an option is no unit. */
static const rb_option *option_of_heading(const char *heading, const typed *t,
                                          rb_unit_factor *factor, const rb_option **not_unit)
{
    const rb_option *const tables[] = {rb_case_table, rb_case_crack_options};
    const int n[] = {rb_case_table_n, rb_case_crack_options_n};
    int plain;
    *not_unit = NULL;
    for (int k = 0; k < 2; k++)
        for (const rb_option *o = tables[k]; o < tables[k] + n[k]; o++) {
            const char *unit = o->kind == RB_OPTION_NUMBER ? o->unit : "-";
            const rb_status s = o->kind == RB_OPTION_GROUP || o->kind == RB_OPTION_TEXT
                                    ? RB_EINVAL
                                    : rb_unit_of_heading(heading, o->name, unit, factor, &plain);
            if (s == RB_OK && plain)
                rb_unit_of_system(t->from, unit, factor);
            if (s == RB_OK)
                return o;
            *not_unit = s == RB_EFORMAT && !*not_unit ? o : *not_unit;
        }
    return NULL;
}

/* 1: a column of labels, such as names of the cases. */
static int is_label(const char *heading, int has_words)
{
    static const char *const names[] = {"label", "name", "case", "id", "run", "comment", "note"};
    rb_guess guess = {.word = heading};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
        if (strcmp(heading, names[k]) == 0)
            return 1;
    for (const rb_option *o = rb_case_table; o < rb_case_table + rb_case_table_n; o++)
        if (o->kind != RB_OPTION_GROUP)
            rb_guess_try(&guess, o->name);
    return has_words && !*rb_guess_text(&guess, "");
}

/* The numbers of a column in the units that the study shows. */
static cli_exit read_column(study *st, int j, const rb_unit_factor *factor, typed *t)
{
    const rb_io_table *table = &st->table;
    study_column *c = &st->column[st->columns - 1];
    char expected[200];
    double *value = table->x + (size_t)j * (size_t)table->rows;
    char **word = table->word + (size_t)j * (size_t)table->rows;
    rb_unit_factor shown;
    const char *unit = c->option->kind == RB_OPTION_NUMBER ? c->option->unit : "-";
    rb_unit_of_system(t->to, unit, &shown);
    const int same =
        factor->power == shown.power && factor->up == shown.up && factor->down == shown.down;
    for (int i = 0; i < table->rows; i++) {
        const int is_number =
            c->option->kind == RB_OPTION_NUMBER || c->option->kind == RB_OPTION_INTEGER;
        if (!word[i] && !same)
            value[i] = rb_unit_over(&shown, rb_unit_times(factor, value[i]));
        if ((!word[i] && is_number) || (word[i] && read_value(t, word[i], &value[i]))) {
            if (word[i] && !isnan(value[i])) {
                free(word[i]); /* a number with a unit */
                word[i] = NULL;
            }
            continue;
        }
        char number[RB_NUMBER_TEXT];
        return cli_fail(CLI_DATA, "%s:%d: %s: expected %s, got '%.60s'", st->o->cases,
                        table->line[i], c->option->name,
                        t->why.text[0] ? t->why.text
                                       : rb_option_expected(c->option, expected, sizeof expected),
                        word[i] ? word[i] : rb_number_text(value[i], number));
    }
    c->value = value;
    c->word = word;
    return CLI_CONTINUE;
}

static cli_exit add_table(study *st)
{
    const char *path = st->o->cases;
    rb_io_table *table = &st->table;
    rb_message why = {.text = ""};
    const rb_status s = rb_io_table_read_words(path, table, &why);
    cli_exit code = CLI_CONTINUE;

    if (s != RB_OK)
        return cli_say(s, &why);
    if (!table->name)
        return cli_fail(CLI_DATA, "%s: expected a line that names the columns", path);
    for (int j = 0; j < table->columns && code == CLI_CONTINUE; j++) {
        const char *heading = table->name[j];
        rb_unit_factor factor;
        const rb_option *not_unit;
        typed t = typed_of(st, "cases", NULL);
        t.option = option_of_heading(heading, &t, &factor, &not_unit);
        int has_words = 0;
        for (int i = 0; i < table->rows; i++)
            has_words |= table->word[i + (size_t)j * (size_t)table->rows] != NULL;
        if (!t.option && not_unit)
            return cli_fail(CLI_DATA, "%s: column '%.60s': expected %s in one of %s", path, heading,
                            not_unit->name,
                            rb_unit_list(not_unit->unit) ? rb_unit_list(not_unit->unit) : "-");
        if (!t.option && !is_label(heading, has_words))
            return unknown(CLI_DATA, path, heading);
        code = add_column(st, path, CLI_DATA, t.option ? t.option->name : heading, t.option);
        if (code == CLI_CONTINUE && t.option)
            code = read_column(st, j, &factor, &t);
        else if (code == CLI_CONTINUE) {
            st->column[st->columns - 1].value = table->x + (size_t)j * (size_t)table->rows;
            st->column[st->columns - 1].word = table->word + (size_t)j * (size_t)table->rows;
        }
    }
    return code == CLI_CONTINUE ? add_factor(st, path, CLI_DATA, table->rows) : code;
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
    if (code == CLI_CONTINUE && st->o->sample == 0 && rb_option_given(st->own, "seed"))
        code = cli_case_refuse(st->base, "seed", "only with --sample");
    return code;
}

cli_exit cli_study_sample(study *st, const rb_case *c)
{
    const int n = st->o->sample;
    rb_case_tolerances t;
    rb_message why = {.text = ""};
    cli_exit code = CLI_CONTINUE;

    if (!st->o->tolerance)
        return cli_fail(CLI_USAGE, "--sample needs --tolerance NAME=X,...");
    const rb_status s = rb_case_read_tolerances(c, st->o->tolerance, &t, &why);
    if (s != RB_OK)
        return cli_case_refused(c, s, &why);
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
        code = o ? add_column(st, "--tolerance", CLI_USAGE, t.name[j], o)
                 : unknown(CLI_USAGE, "--tolerance", t.name[j]);
        if (code == CLI_CONTINUE)
            st->column[st->columns - 1].value = value;
    }
    gsl_rng_free(rng);
    return code == CLI_CONTINUE ? add_factor(st, "--sample", CLI_USAGE, n) : code;
}

int cli_study_row(const study *st, const study_column *c, int k)
{
    for (int f = st->factors - 1; f > c->factor; f--)
        k /= st->rows[f];
    return k % st->rows[c->factor];
}

double cli_study_value(const study *st, const study_column *c, int k)
{
    return c->value[cli_study_row(st, c, k)];
}

const char *cli_study_word(const study *st, const study_column *c, int k)
{
    return c->word ? c->word[cli_study_row(st, c, k)] : NULL;
}

void cli_study_free_columns(study *st)
{
    for (int k = 0; k < VARIED_MAX; k++) {
        for (size_t i = 0; st->owned_words[k] && i < st->owned_n[k]; i++)
            free(st->owned_words[k][i]);
        free(st->owned_words[k]);
        free(st->owned[k]);
    }
    rb_io_table_free(&st->table);
    free(st->sampled);
}

/* *bad: the column whose value is no value of its option; NULL: none. */
static rb_status try_values(const study *st, rb_case *c, int k, const study_column **bad,
                            rb_message *why)
{
    *bad = NULL;
    for (int j = 0; j < st->columns; j++) {
        const study_column *column = &st->column[j];
        const char *word = cli_study_word(st, column, k);
        const rb_status s =
            !column->option ? RB_OK
            : word          ? rb_case_set_word(c, column->name, word, why)
                   : rb_case_set_number(c, column->name, cli_study_value(st, column, k), why);
        if (s != RB_OK) {
            *bad = column;
            return s;
        }
    }
    return RB_OK;
}

cli_exit cli_study_set_values(const study *st, rb_case *c, int k)
{
    rb_message why = {.text = ""};
    const study_column *bad;

    if (try_values(st, c, k, &bad, &why) == RB_OK)
        return CLI_CONTINUE;
    /* The table of cases is the first factor, and is located by its line. */
    return st->o->cases && bad->factor == 0
               ? cli_fail(bad->bad, "%s:%d: %s", st->o->cases,
                          st->table.line[cli_study_row(st, bad, k)], why.text)
               : cli_fail(bad->bad, "case %d: %s", k + 1, why.text);
}

/* The crack of the current case. */
static rb_status check_crack(const study *st, rb_message *why)
{
    const rb_case_crack *crack = rb_case_crack_of(st->one);
    if (!crack)
        return RB_OK;
    if (!isnan(crack->paris))
        return rb_refuse(why, "paris",
                         "a study has the K of cracks of given lengths; rollbem "
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
        rb_message why = {.text = ""};
        code = cli_study_set_values(st, st->one, k);
        if (code == CLI_CONTINUE)
            code = cli_say(rb_case_resolve(st->one, &why), &why);
        const rb_status s =
            code == CLI_CONTINUE ? rb_case_locate(st->one, check_crack(st, &why), &why) : RB_OK;
        if (s != RB_OK)
            code = cli_fail(cli_exit_of(s), "case %d: %s", k + 1, why.text);
    }
    return code;
}
