/* The tables that a case names: gap, irregularity, wear, friction over x, history. */
#include "rolling/case/words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void rb_case_confine(rb_case *c, const char *folder)
{
    c->confined = 1;
    c->folder = folder;
}

rb_status rb_case_without_content(const rb_case *c, const char *path, rb_status s, rb_message *why)
{
    return c->confined && s == RB_EFORMAT
               ? rb_fail(why, s, "%s: not what is expected of this file", path)
               : s;
}

rb_status rb_case_read_input(const rb_case *c, const char *path, char **text, size_t *size,
                             rb_message *why)
{
    const rb_status s = c->confined ? rb_io_check_harmless(path, c->folder, why) : RB_OK;
    *text = NULL;
    return s == RB_OK ? rb_io_read_text(path, text, size, why) : s;
}

/* columns: how many there must be; 0: any. */
static rb_status read_table(const rb_case *c, const char *path, int columns, rb_io_table *t,
                            rb_message *why)
{
    char *text;
    size_t size;
    rb_status s = rb_case_read_input(c, path, &text, &size, why);
    if (s != RB_OK)
        return s;
    s = rb_io_table_parse(path, text, t, why);
    if (s == RB_OK && columns > 0)
        s = rb_io_table_expect_columns(path, columns, t, why);
    free(text);
    return rb_case_without_content(c, path, s, why);
}

static void free_table(case_table *t)
{
    if (!t->borrowed)
        rb_io_table_free(&t->table);
    *t = (case_table){.path = NULL};
}

static void free_profile(case_profile *p)
{
    if (!p->borrowed)
        rb_rolling_profile_free(p->curve);
    *p = (case_profile){.curve = NULL};
}

static int is_read(const case_table *t, const char *path, rb_units units)
{
    return t->path && strcmp(t->path, path) == 0 && t->units == units;
}

/* Of the numbers in the file that an option names. */
static rb_units units_of_file(const rb_case *c, const char *option)
{
    return rb_case_units(c, rb_case_given(c, option));
}

/* Two columns, of which the first `lengths` are in mm: the second over the first. */
static rb_status read_over_x(const rb_case *c, case_table *t, const char *path, rb_units units,
                             int lengths, rb_rolling_table *over_x, rb_message *why)
{
    if (!is_read(t, path, units)) {
        free_table(t);
        const rb_status s = read_table(c, path, 2, &t->table, why);
        if (s != RB_OK)
            return s;
        t->path = path;
        t->units = units;
        for (int j = 0; j < lengths; j++)
            rb_io_table_convert(&t->table, j, "mm", units);
    }
    *over_x = (rb_rolling_table){t->table.rows, t->table.x, t->table.x + t->table.rows};
    return RB_OK;
}

int rb_case_gap_rows(const rb_case *c, const double **x, const double **gap)
{
    const rb_io_table *t = &c->table[CASE_GAP].table;

    if (c->resolved.rc.gap != RB_GAP_TABLE || !t->x)
        return 0;
    *x = t->x;
    *gap = t->x + t->rows;
    return t->rows;
}

static rb_status read_profile(rb_case *c, rb_message *why)
{
    rb_resolved_case *resolved = &c->resolved;
    const rb_units units = units_of_file(c, "gap");
    const double noise = resolved->gap_smoothing;
    rb_rolling_table gap;
    if (resolved->rc.gap != RB_GAP_TABLE)
        return rb_case_refuse_given(c, "gap-smoothing", "of a gap from a file only", why);
    if (!is_read(&c->table[CASE_GAP], resolved->gap_file, units) || c->profile.noise != noise)
        free_profile(&c->profile);
    rb_status s = read_over_x(c, &c->table[CASE_GAP], resolved->gap_file, units, 2, &gap, why);
    if (s == RB_OK && !c->profile.curve) {
        c->profile = (case_profile){.noise = noise};
        s = rb_rolling_profile_create(gap.n, gap.x, gap.y, noise, &c->profile.curve, why);
        s = rb_case_locate(c, s, why);
    }
    resolved->rc.profile = c->profile.curve;
    return s;
}

static rb_status read_friction(rb_case *c, rb_message *why)
{
    rb_resolved_case *resolved = &c->resolved;
    if (resolved->rc.friction.law != RB_FRICTION_table)
        return RB_OK;
    const rb_status s =
        read_over_x(c, &c->table[CASE_FRICTION], resolved->friction_file,
                    units_of_file(c, "friction-law"), 1, &resolved->rc.friction.table, why);
    if (s != RB_OK)
        return s;
    /* The table stands in the place of --mu: on the command line it wins over mu of the
     * case file. */
    const rb_option_set set = rb_case_options(c);
    const rb_option_precedence how = rb_case_precedence(c);
    const rb_status status = rb_option_resolve_against(
        &set, &how, rb_case_option("mu"), rb_case_given(c, "friction-law"),
        "the table of --friction-law has the coefficients", why);
    c->resolved.rc.mu = c->words.rc.mu;
    return status;
}

/* ---- The history ------------------------------------------------------------------- */

static rb_status set_program(const rb_io_table *t, const char *path, rb_rolling_program *program,
                             rb_message *why)
{
    *program = (rb_rolling_program){.n = t->rows};
    for (int j = 0; j < t->columns; j++) {
        rb_guess guess = {.word = t->name[j]};
        int k = 0;
        while (k < RB_ROLLING_PROGRAM_COLUMNS &&
               strcmp(t->name[j], rb_rolling_program_columns[k].name) != 0)
            rb_guess_try(&guess, rb_rolling_program_columns[k++].name);
        if (k == RB_ROLLING_PROGRAM_COLUMNS)
            return rb_fail(why, RB_EFORMAT, "%s: unknown column '%s'%s", path, t->name[j],
                           rb_guess_text(&guess, ""));
        const double *column = t->x + (size_t)j * (size_t)t->rows;
        memcpy((char *)program + rb_rolling_program_columns[k].column, &column, sizeof column);
    }
    return RB_OK;
}

/* The option whose value a column replaces: creep-ratio by creep_ratio; NULL: none. */
static const rb_option *replaced_option(const char *column)
{
    char name[32];
    const rb_option *option = NULL;
    for (size_t n = strlen(column); n > 0 && !option; n--) {
        if (column[n] != '\0' && column[n] != '_') /* perhaps its unit stands behind */
            continue;
        snprintf(name, sizeof name, "%.*s", (int)n, column);
        for (char *c = name; *c; c++)
            *c = *c == '_' ? '-' : *c;
        option = rb_case_option(name);
    }
    return option && strcmp(option->name, "distance") != 0 ? option : NULL;
}

int rb_case_is_replaced(const rb_case *c, const rb_option *option)
{
    const rb_io_table *t = &c->table[CASE_HISTORY].table;
    for (int j = 0; j < t->columns && c->resolved.program.n > 0; j++)
        if (replaced_option(t->name[j]) == option)
            return 1;
    return 0;
}

/* Columns named like options, in the units of those or in their own: load_kN/m. */
static rb_status read_program_table(const rb_case *c, case_table *t, const char *path,
                                    rb_units units, rb_message *why)
{
    if (is_read(t, path, units))
        return RB_OK;
    free_table(t);
    const rb_status s = read_table(c, path, 0, &t->table, why);
    if (s != RB_OK)
        return s;
    if (!t->table.name)
        return rb_fail(why, RB_EFORMAT, "%s: expected a line that names the columns", path);
    t->path = path;
    t->units = units;
    for (int j = 0; j < t->table.columns; j++) {
        const rb_option *option = replaced_option(t->table.name[j]);
        if (option)
            rb_io_table_convert(&t->table, j, option->unit, units);
    }
    return RB_OK;
}

rb_status rb_case_read_history(rb_case *c, rb_message *why)
{
    const rb_io_table *t = &c->table[CASE_HISTORY].table;
    const char *path = c->words.history_file;
    if (!path || c->words.rc.formulation == RB_STEADY) /* check_formulation refuses it */
        return RB_OK;
    rb_status s =
        read_program_table(c, &c->table[CASE_HISTORY], path, units_of_file(c, "history"), why);
    if (s == RB_OK)
        s = rb_case_without_content(c, path, set_program(t, path, &c->words.program, why), why);
    if (s != RB_OK)
        return s;
    /* A column stands in the place of an option: as between two options the command line
     * wins over the file, and otherwise both at once are refused. */
    const rb_option_precedence how = rb_case_precedence(c);
    const rb_option_set set = rb_case_options(c);

    for (int j = 0; j < t->columns; j++) {
        char reason[80];
        const rb_option *option = replaced_option(t->name[j]);
        snprintf(reason, sizeof reason, "the history has a column %s", t->name[j]);
        s = option ? rb_option_resolve_against(&set, &how, option, rb_case_given(c, "history"),
                                               reason, why)
                   : RB_OK;
        if (s != RB_OK)
            return s;
    }
    return RB_OK;
}

/* ---- All others -------------------------------------------------------------------- */

rb_status rb_case_read_files(rb_case *c, rb_message *why)
{
    rb_status s = read_profile(c, why);
    if (s == RB_OK) {
        /* What is irregular about the surfaces, and what is worn off them. */
        rb_resolved_case *resolved = &c->resolved;

        if (resolved->irregularity_file)
            s = read_over_x(c, &c->table[CASE_IRREGULARITY], resolved->irregularity_file,
                            units_of_file(c, "irregularity"), 2, &resolved->rc.irregularity, why);
        if (s == RB_OK && resolved->worn_file)
            s = read_over_x(c, &c->table[CASE_WORN], resolved->worn_file, units_of_file(c, "worn"),
                            2, &resolved->rc.worn, why);
    }
    return s == RB_OK ? read_friction(c, why) : s;
}

void rb_case_free_files(rb_case *c)
{
    free_profile(&c->profile);
    for (int k = 0; k < CASE_TABLES; k++)
        free_table(&c->table[k]);
}
