/* Tables of numbers, with or without named columns, as people and spreadsheets write them. */
#include "base/io/io.h"

#include <ctype.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char blanks[] = " \t\r\n";

/* How the cells of a file are separated. */
typedef struct {
    char cells;     /* ';', tab or ',': a cell may be empty or have blanks in it; 0: between cells
                       stand blanks, tabs and commas, as many as there are */
    int comma_line; /* the first line whose decimals have a comma; 0: they have a point */
} dialect;

typedef struct {
    const char *path;
    int line, capacity;
    int words; /* 1: cells may be words */
    /* lines before the first row: of names, of their units, the last comment, which may name the
     * columns; NULL: there is none */
    const char *names, *units, *comment;
    int names_line;
    dialect d;
    rb_io_table *t; /* x and word row by row until the end */
    rb_message *why;
} reading;

static void free_words(char **word, size_t n)
{
    for (size_t k = 0; word && k < n; k++)
        free(word[k]);
    free(word);
}

void rb_io_table_free(rb_io_table *t)
{
    free_words(t->name, (size_t)t->columns);
    free_words(t->word, (size_t)t->rows * (size_t)t->columns);
    free(t->x);
    free(t->line);
    memset(t, 0, sizeof *t);
}

const double *rb_io_table_column(const rb_io_table *t, const char *name)
{
    for (int j = 0; t->name && j < t->columns; j++)
        if (strcmp(t->name[j], name) == 0)
            return t->x + (size_t)j * (size_t)t->rows;
    return NULL;
}

static rb_status no_memory(const reading *r)
{
    return rb_fail(r->why, RB_ENOMEM, "%s: out of memory", r->path);
}

/* ---- Cells ------------------------------------------------------------------------- */

/* The next cell from *at on, without blanks around it and without the double quotes of a
 * spreadsheet; *at moves behind it and what separates it.  0: the line has no more. */
static int next_cell(const dialect *d, const char **at, const char **cell, size_t *n)
{
    const char one[] = {d->cells, '\0'}, *loose = d->comma_line ? blanks : " \t\r\n,";
    const char *separators = d->cells ? one : loose;
    *cell = *at + strspn(*at, d->cells == '\t' ? " \r\n" : d->cells ? blanks : loose);
    if (!**cell)
        return 0;
    const char *end = *cell + strcspn(*cell, separators);
    const char *quote = **cell == '"' ? strchr(*cell + 1, '"') : NULL;
    const char *behind = quote ? quote + 1 + strspn(quote + 1, " \r\n") : NULL;
    const int quoted = behind && (!*behind || strchr(separators, *behind) || !d->cells) &&
                       (d->cells || quote > *cell + 1) &&
                       (d->cells || !quote[1] || strchr(loose, quote[1]));
    if (quoted) {
        ++*cell;
        *n = (size_t)(quote - *cell);
        end = behind;
    } else {
        *n = (size_t)(end - *cell);
        while (*n > 0 && strchr(d->cells ? blanks : " \t\r\n,", (*cell)[*n - 1]))
            --*n;
    }
    *at = *end ? end + 1 : end;
    return 1;
}

static int count_cells(const dialect *d, const char *text)
{
    const char *cell;
    size_t length;
    int n = 0, last = 0; /* the last one that is not empty */
    while (next_cell(d, &text, &cell, &length)) {
        n++;
        last = length > 0 ? n : last;
    }
    return last;
}

static int is_number(const dialect *d, const char *cell, size_t n, double *value)
{
    char text[64], *end;
    const char *comma = memchr(cell, ',', n);
    if (n == 0)
        return 0;
    if (d->comma_line && n < sizeof text) {
        if (memchr(cell, '.', n))
            return 0;
        memcpy(text, cell, n);
        text[n] = '\0';
        if (comma)
            text[comma - cell] = '.';
        cell = text;
    }
    *value = rb_read_number(cell, &end);
    return end == cell + n && isfinite(*value);
}

/* 1: no cell is a number. */
static int are_words(const dialect *d, const char *text)
{
    const char *cell;
    size_t n;
    double value;
    while (next_cell(d, &text, &cell, &n))
        if (is_number(d, cell, n, &value))
            return 0;
    return 1;
}

/* ---- Separators -------------------------------------------------------------------- */

/* 1: one of the characters, or some of them, between a digit and a number. */
static int is_between_digits(const char *line, const char *characters)
{
    for (const char *at = line; *at; at++) {
        if (!strchr(characters, *at) || at == line || !isdigit((unsigned char)at[-1]))
            continue;
        const char *next = at + strspn(at, characters);
        next += *next == '-' || *next == '+';
        if (isdigit((unsigned char)*next))
            return 1;
    }
    return 0;
}

/* Looks at all lines: one semicolon makes semicolons the separators.  A comma between digits is
 * that of a decimal where semicolons, tabs or blanks separate the numbers. */
static dialect find_dialect(const char *text, int words)
{
    dialect d = {0};
    int tabs = 0, commas = 0, line_number = 0, decimal_in_tabs = 0, decimal = 0;
    char line[400];
    for (const char *next; *text; text = next) {
        size_t n = strcspn(text, "\n");
        next = text + n + (text[n] != '\0');
        line_number++;
        const char *comment = memchr(text, '#', n);
        n = comment ? (size_t)(comment - text) : n;
        d.cells = memchr(text, ';', n) ? ';' : d.cells;
        tabs |= memchr(text, '\t', n) != NULL;
        commas |= memchr(text, ',', n) != NULL;
        /* the beginning of a line says how its decimals are written */
        n = n < sizeof line ? n : sizeof line - 1;
        memcpy(line, text, n);
        line[n] = '\0';
        if (!is_between_digits(line, ","))
            continue;
        decimal = decimal ? decimal : line_number;
        if (!decimal_in_tabs && (is_between_digits(line, " \t") || (words && strchr(line, '\t'))))
            decimal_in_tabs = line_number;
    }
    d.comma_line = d.cells ? decimal : decimal_in_tabs;
    if (words && !d.cells)
        d.cells = tabs ? '\t' : commas ? ',' : '\0';
    return d;
}

/* ---- Names ------------------------------------------------------------------------- */

/* How the line of names is separated: as it looks, since the numbers below may be otherwise. */
static dialect of_names(const reading *r, const char *text)
{
    dialect d = {.cells = strchr(text, ';')    ? ';'
                          : strchr(text, '\t') ? '\t'
                          : strchr(text, ',')  ? ','
                                               : '\0'};
    d.cells = r->d.cells ? r->d.cells : d.cells;
    d.comma_line = r->d.comma_line;
    return d;
}

/* A name that is cut at blanks goes on in brackets, around a slash, and behind an "in" before a
 * unit: these blanks are held by a mark while the line is cut. */
static const char held = '\1';

static int is_unit(const char *word, size_t n)
{
    char name[40];
    if (n == 0 || n >= sizeof name)
        return 0;
    memcpy(name, word, n);
    name[n] = '\0';
    return rb_unit_is_known(name);
}

static void hold_units(char *text)
{
    int depth = 0, behind_in = 0;
    for (char *at = text; *at; at++) {
        depth += strchr("([{", *at) != NULL;
        depth -= depth > 0 && strchr(")]}", *at);
        if (*at != ' ')
            continue;
        const char *next = at + strspn(at, " ");
        const char *unit = next + 2 + (strncmp(next, "in ", 3) == 0 ? strspn(next + 2, " ") : 0);
        const int in = unit > next + 2 && is_unit(unit, strcspn(unit, blanks));
        if (depth > 0 || behind_in || in || *next == '/' || (at > text && at[-1] == '/') ||
            (*next && strchr("([{", *next)))
            *at = held;
        behind_in = in && *at == held;
        if (behind_in) /* the blank behind "in" follows */
            at = (char *)next + 1;
    }
}

/* Cuts a line of n names; NULL: it has another number of them. */
static char **cut_names(const reading *r, const char *line, int n, rb_status *s)
{
    const dialect ways[] = {of_names(r, line), {0}};
    char *text = malloc(strlen(line) + 1), **names = NULL;
    *s = text ? RB_OK : no_memory(r);
    for (int way = 0; text && way < (ways[0].cells == ';' ? 1 : 2) && !names; way++) {
        const char *at = strcpy(text, line), *cell;
        size_t length;
        if (!ways[way].cells)
            hold_units(text);
        if (count_cells(&ways[way], text) != n)
            continue;
        names = calloc((size_t)n, sizeof *names);
        for (int j = 0; names && j < n && next_cell(&ways[way], &at, &cell, &length); j++) {
            names[j] = calloc(length + 1, 1);
            for (size_t i = 0; names[j] && i < length; i++)
                names[j][i] = cell[i];
            for (char *c = names[j]; c && (c = strchr(c, held));)
                *c = ' ';
            *s = names[j] ? *s : RB_ENOMEM;
        }
        if (!names || *s != RB_OK)
            *s = no_memory(r);
    }
    free(text);
    if (*s != RB_OK) {
        free_words(names, (size_t)n);
        return NULL;
    }
    return names;
}

/* The unit of a line below the names, "mm", "[mm]" or "-", behind its name. */
static rb_status add_units(reading *r, char **unit)
{
    for (int j = 0; j < r->t->columns; j++) {
        const size_t n = strlen(r->t->name[j]) + strlen(unit[j]) + 4;
        char *both = calloc(n, 1);
        if (!both)
            return no_memory(r);
        rb_append(both, n, strchr("[({-", unit[j][0]) ? "%s %s" : "%s [%s]", r->t->name[j],
                  unit[j]);
        free(r->t->name[j]);
        r->t->name[j] = both;
    }
    return RB_OK;
}

static int is_line_of_units(const reading *r, const char *line)
{
    const dialect d = of_names(r, line);
    const char *cell;
    size_t n;
    while (next_cell(&d, &line, &cell, &n)) {
        const int bracket = n > 1 && strchr("[({", *cell) && strchr("])}", cell[n - 1]);
        if (n > 0 && !(n == 1 && *cell == '-') && !is_unit(cell + bracket, n - 2 * (size_t)bracket))
            return 0;
    }
    return 1;
}

/* Before the first row, of n cells. */
static rb_status name_columns(reading *r, int n)
{
    rb_io_table *t = r->t;
    const char *line = r->names ? r->names : r->comment;
    rb_status s = RB_OK;
    t->columns = n;
    if (!line)
        return RB_OK;
    t->name = cut_names(r, line, n, &s);
    if (s == RB_OK && !t->name && r->names) { /* the row says what does not fit */
        const dialect d = of_names(r, line);
        t->columns = count_cells(&d, line);
        t->name = cut_names(r, line, t->columns, &s);
    }
    if (s != RB_OK || !t->name)
        return s;
    t->named_by_comment = !r->names;
    char **units = r->units ? cut_names(r, r->units, t->columns, &s) : NULL;
    if (units)
        s = add_units(r, units);
    free_words(units, (size_t)t->columns);
    for (int j = 0; j < t->columns && s == RB_OK; j++)
        for (int i = 0; i < j && s == RB_OK; i++)
            if (strcmp(t->name[i], t->name[j]) == 0)
                s = rb_fail(r->why, RB_EFORMAT, "%s:%d: column '%s' is named twice", r->path,
                            r->names ? r->names_line : r->line, t->name[j]);
    return s;
}

/* ---- Rows -------------------------------------------------------------------------- */

static rb_status make_space(reading *r)
{
    rb_io_table *t = r->t;
    if (t->rows < r->capacity)
        return RB_OK;
    if (r->capacity > INT_MAX / 2)
        return rb_fail(r->why, RB_EFORMAT, "%s:%d: more than %d rows", r->path, r->line,
                       r->capacity);
    r->capacity = r->capacity ? 2 * r->capacity : 64;
    const size_t cells = (size_t)r->capacity * (size_t)(t->columns + 1);
    double *x = realloc(t->x, sizeof *x * cells);
    t->x = x ? x : t->x;
    int *line = x ? realloc(t->line, sizeof *line * (size_t)r->capacity) : NULL;
    t->line = line ? line : t->line;
    char **word = line && r->words ? realloc(t->word, sizeof *word * cells) : NULL;
    t->word = word ? word : t->word;
    return line && (word || !r->words) ? RB_OK : no_memory(r);
}

/* Why a cell is no number. */
static rb_status refuse_cell(const reading *r, const char *row, int j, const char *cell, size_t n)
{
    const rb_io_table *t = r->t;
    char column[80] = "", hint[120] = "";
    if (t->name && j < t->columns)
        snprintf(column, sizeof column, " in column '%.50s'", t->name[j]);
    if (memchr(cell, ',', n) && memchr(cell, '.', n))
        snprintf(hint, sizeof hint, "; thousands are not separated");
    else if (r->d.comma_line && memchr(cell, '.', n))
        snprintf(hint, sizeof hint, "; decimals have a comma in line %d and a point here",
                 r->d.comma_line);
    else if (!r->d.comma_line && memchr(cell, ',', n) && strpbrk(row, "; \t"))
        snprintf(hint, sizeof hint,
                 "; decimals have a point or, between semicolons, tabs or "
                 "blanks, a comma");
    return rb_fail(r->why, RB_EFORMAT, "%s:%d: expected a number, got '%.*s'%s%s", r->path, r->line,
                   n < 60 ? (int)n : 60, cell, column, hint);
}

/* A cell of a named column without a number, as the program writes it in its tables and in CSV. */
static int is_missing(const rb_io_table *t, const char *cell, size_t n)
{
    return t->name && (n == 0 || (n == 3 && strncmp(cell, "NaN", 3) == 0));
}

static rb_status read_row(reading *r, const char *text)
{
    rb_io_table *t = r->t;
    dialect d = r->d;
    const dialect strict = {.cells = ','};
    const char *cell, *row = text;
    size_t length;
    int n = 0;
    rb_status s = make_space(r);
    if (s != RB_OK)
        return s;
    const size_t first = (size_t)t->rows * (size_t)t->columns;
    for (int j = 0; t->word && j < t->columns; j++)
        t->word[first + (size_t)j] = NULL;
    t->line[t->rows++] = r->line;
    /* commas with nothing between them */
    if (!d.cells && !d.comma_line && count_cells(&d, text) < t->columns &&
        count_cells(&strict, text) <= t->columns &&
        (strstr(text, ",,") || *text == ',' || text[strlen(text) - 1] == ','))
        d = strict;
    for (; next_cell(&d, &text, &cell, &length); n++) {
        double value = NAN;
        const int number =
            is_number(&d, cell, length, &value) || (!r->words && is_missing(t, cell, length));
        if (n >= t->columns && length == 0) { /* of a spreadsheet, behind the last column */
            n--;
            continue;
        }
        if (!number && !r->words)
            return refuse_cell(r, row, n, cell, length);
        if (n >= t->columns)
            continue;
        t->x[first + (size_t)n] = number ? value : NAN;
        char *word = number ? NULL : calloc(length + 1, 1);
        if (!number && !word)
            return no_memory(r);
        if (word)
            t->word[first + (size_t)n] = memcpy(word, cell, length);
    }
    if (d.cells == ',' && !r->words) /* behind the last comma */
        for (; n < t->columns && row[strlen(row) - 1] == ','; n++)
            t->x[first + (size_t)n] = NAN;
    if (n == t->columns)
        return RB_OK;
    char names[160] = "";
    for (int j = 0; t->name && j < t->columns; j++)
        rb_append(names, sizeof names, "%s%s", j ? ", " : " (", t->name[j]);
    return rb_fail(r->why, RB_EFORMAT, "%s:%d: expected %d number%s%s%s, got %d", r->path, r->line,
                   t->columns, rb_plural(t->columns), names, *names ? ")" : "", n);
}

/* From rows to columns. */
static rb_status transpose(reading *r)
{
    rb_io_table *t = r->t;
    const size_t rows = (size_t)t->rows, columns = (size_t)t->columns;
    double *x = rb_alloc(rows, columns);
    char **word = t->word ? calloc(rows * columns, sizeof *word) : NULL;
    if (!x || (t->word && !word)) {
        free(x);
        free(word);
        return no_memory(r);
    }
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++) {
            x[i + j * rows] = t->x[i * columns + j];
            if (word)
                word[i + j * rows] = t->word[i * columns + j];
        }
    free(t->x);
    free(t->word);
    t->x = x;
    t->word = word;
    return RB_OK;
}

static rb_status read_line(reading *r, char *text)
{
    char *comment = strchr(text, '#');
    if (comment) {
        *comment++ = '\0';
        if (r->t->rows == 0)
            r->comment = comment;
    }
    const dialect names = of_names(r, text);
    const int first = r->t->rows == 0;
    if (count_cells(&r->d, text) == 0 || (r->line == 1 && strncmp(text, "sep=", 4) == 0))
        return RB_OK;
    /* A first line of words, none of them a number, names the columns, and one of units may follow;
     * so does a comment of as many words as the first row has numbers. */
    if (first && !r->names && are_words(&names, text)) {
        r->names = text;
        r->names_line = r->line;
        return RB_OK;
    }
    if (first && r->names && !r->units && are_words(&names, text) && is_line_of_units(r, text)) {
        r->units = text;
        return RB_OK;
    }
    const rb_status s = first ? name_columns(r, count_cells(&r->d, text)) : RB_OK;
    return s == RB_OK ? read_row(r, text) : s;
}

static rb_status parse(const char *path, char *text, int words, rb_io_table *t, rb_message *why)
{
    reading r = {.path = path, .words = words, .d = find_dialect(text, words), .t = t, .why = why};
    rb_status s = RB_OK;
    memset(t, 0, sizeof *t);
    for (char *next; s == RB_OK && *text; text = next) {
        next = text + strcspn(text, "\n");
        if (next > text && next[-1] == '\r')
            next[-1] = '\0';
        if (*next)
            *next++ = '\0';
        r.line++;
        s = read_line(&r, text);
    }
    if (s == RB_OK && t->rows == 0)
        s = rb_fail(why, RB_EFORMAT, "%s: no numbers", path);
    if (s == RB_OK)
        s = transpose(&r);
    if (s != RB_OK)
        rb_io_table_free(t);
    return s;
}

rb_status rb_io_table_parse(const char *path, char *text, rb_io_table *t, rb_message *why)
{
    return parse(path, text, 0, t, why);
}

static rb_status read_file(const char *path, int words, rb_io_table *t, rb_message *why)
{
    char *text;
    size_t size;
    rb_status s = rb_io_read_spreadsheet(path, &text, &size, why);
    memset(t, 0, sizeof *t);
    if (s == RB_OK)
        s = parse(path, text, words, t, why);
    free(text);
    return s;
}

rb_status rb_io_table_read(const char *path, rb_io_table *t, rb_message *why)
{
    return read_file(path, 0, t, why);
}

rb_status rb_io_table_read_words(const char *path, rb_io_table *t, rb_message *why)
{
    return read_file(path, 1, t, why);
}

/* ---- What columns are -------------------------------------------------------------- */

/* Whether a heading is one of the names of a column. */
static rb_status compare_names(const char *heading, const rb_io_column *c, rb_unit_factor *factor,
                               int *plain)
{
    char name[60];
    *plain = 1;
    if (!c->name)
        return RB_OK;
    rb_status s = rb_unit_of_heading(heading, c->name, c->unit, factor, plain);
    for (const char *at = c->also; at && s != RB_OK; at = strchr(at, '|')) {
        at += *at == '|';
        snprintf(name, sizeof name, "%.*s", (int)strcspn(at, "|"), at);
        const rb_status one = rb_unit_of_heading(heading, name, c->unit, factor, plain);
        s = one == RB_EINVAL ? s : one;
    }
    return s;
}

int rb_io_table_has(const rb_io_table *t, const rb_io_column *known)
{
    rb_unit_factor factor;
    int plain, has = 0;
    for (int j = 0; t->name && j < t->columns && !has; j++)
        has = compare_names(t->name[j], known, &factor, &plain) != RB_EINVAL;
    return has;
}

/* "x_mm, gap_mm": what the reader knows, in the units of the system. */
static const char *list_columns(int n, const rb_io_column *known, rb_units system, char *text,
                                size_t size)
{
    text[0] = '\0';
    for (int k = 0; k < n; k++) {
        const char *unit = rb_unit_name(system, known[k].unit);
        const int has_unit = strcmp(unit, "-") != 0;
        if (known[k].need != RB_IO_COLUMN_UNUSED)
            rb_append(text, size, "%s%s%s%s", text[0] ? ", " : "", known[k].name,
                      has_unit ? "_" : "", has_unit ? unit : "");
    }
    return text;
}

/* RB_EFORMAT: no column that is known, and why says so. */
static rb_status find_column(const char *path, const char *heading, int n,
                             const rb_io_column *known, rb_units system, int *k,
                             rb_unit_factor *factor, rb_message *why)
{
    const rb_io_column *named = NULL;
    int plain;
    char list[300];
    rb_guess guess = {.word = heading};
    for (*k = 0; *k < n; ++*k) {
        const rb_status s = compare_names(heading, &known[*k], factor, &plain);
        if (s == RB_OK) {
            if (plain)
                rb_unit_of_system(system, known[*k].unit, factor);
            return RB_OK;
        }
        named = s == RB_EFORMAT && !named ? &known[*k] : named;
        rb_guess_try(&guess, known[*k].name);
    }
    if (named && rb_unit_list(named->unit))
        return rb_fail(why, RB_EFORMAT, "%s: column '%.60s': expected %s in one of %s", path,
                       heading, named->name, rb_unit_list(named->unit));
    if (named)
        return rb_fail(why, RB_EFORMAT, "%s: column '%.60s': expected %s without a unit", path,
                       heading, named->name);
    return rb_fail(why, RB_EFORMAT, "%s: unknown column '%.60s'%s; expected %s", path, heading,
                   rb_guess_text(&guess, ""), list_columns(n, known, system, list, sizeof list));
}

/* A comment of as many words as there are columns may be any comment. */
static void drop_comment(rb_io_table *t, int n, const rb_io_column *known)
{
    rb_unit_factor factor;
    int plain;
    for (int j = 0; t->name && j < t->columns; j++)
        for (int k = 0; k < n; k++)
            if (!t->named_by_comment || strpbrk(t->name[j], "[(") ||
                compare_names(t->name[j], &known[k], &factor, &plain) != RB_EINVAL)
                return;
    free_words(t->name, (size_t)t->columns);
    t->name = NULL;
}

rb_status rb_io_table_assign(const char *path, rb_io_table *t, int n, const rb_io_column *known,
                             rb_units system, const double **x, rb_message *why)
{
    char list[300];
    rb_status s = RB_OK;
    for (int k = 0; k < n; k++)
        x[k] = NULL;
    drop_comment(t, n, known);
    if (!t->name && t->columns != n)
        return rb_fail(why, RB_EFORMAT, "%s:%d: expected %d number%s, got %d", path, t->line[0], n,
                       rb_plural(n), t->columns);
    for (int j = 0; j < t->columns; j++) {
        rb_unit_factor factor;
        int k = j;
        double *column = t->x + (size_t)j * (size_t)t->rows;
        if (t->name)
            s = find_column(path, t->name[j], n, known, system, &k, &factor, why);
        else
            rb_unit_of_system(system, known[k].unit, &factor);
        if (s != RB_OK)
            return s;
        if (known[k].need == RB_IO_COLUMN_UNUSED)
            continue;
        if (x[k])
            return rb_fail(why, RB_EFORMAT, "%s: columns '%.60s' and '%.60s' are both %s", path,
                           t->name[(x[k] - t->x) / t->rows], t->name[j], known[k].name);
        for (int i = 0; i < t->rows; i++) {
            if (t->line && isnan(column[i]))
                return rb_fail(why, RB_EFORMAT, "%s:%d: expected a number, got none in column '%s'",
                               path, t->line[i], t->name ? t->name[j] : "");
            column[i] = rb_unit_times(&factor, column[i]);
        }
        x[k] = column;
    }
    for (int k = 0; k < n; k++)
        if (!x[k] && known[k].need == RB_IO_COLUMN_NEEDED)
            return rb_fail(why, RB_EFORMAT, "%s: expected a column %s", path,
                           list_columns(1, &known[k], system, list, sizeof list));
    return RB_OK;
}
