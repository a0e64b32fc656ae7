/* Tables of numbers, with or without named columns. */
#include "rollbem/io.h"

#include <ctype.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char blanks[] = " \t\r\n,";

typedef struct {
    const char *path;
    int line, capacity;
    const char *comment; /* last one before the first row: it may name the columns */
    rb_io_table *t;      /* x row by row until the end */
    rb_message *why;
} reading;

void rb_io_table_convert(rb_io_table *t, int j, const char *unit, rb_units system)
{
    const char *name;
    double *x = t->x + (size_t)j * (size_t)t->rows;
    const size_t n = t->name ? rb_unit_of_column(t->name[j], unit, &name) : 0;
    for (int i = 0; i < t->rows; i++)
        x[i] = n > 0 ? rb_unit_of(name, unit, x[i]) : rb_unit_stored(system, unit, x[i]);
    if (n > 0)
        t->name[j][n] = '\0';
}

void rb_io_table_free(rb_io_table *t)
{
    for (int j = 0; t->name && j < t->columns; j++)
        free(t->name[j]);
    free(t->name);
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

/* ---- Words ------------------------------------------------------------------------- */

/* The next word from *at on, without the double quotes of a spreadsheet; *at moves behind it; 0
 * at the end of the line. */
static size_t next_word(const char **at, const char **word)
{
    *word = *at + strspn(*at, blanks);
    const char *quote = **word == '"' ? strchr(*word + 1, '"') : NULL;
    if (quote && quote > *word + 1 && (!quote[1] || strchr(blanks, quote[1]))) {
        *at = quote + 1;
        return (size_t)(quote - ++*word);
    }
    const size_t n = strcspn(*word, blanks);
    *at = *word + n;
    return n;
}

static int count_words(const char *text)
{
    const char *word;
    int n = 0;
    while (next_word(&text, &word) > 0)
        n++;
    return n;
}

static int is_number(const char *word, size_t n, double *value)
{
    char *end;
    *value = rb_read_number(word, &end);
    return end == word + n && isfinite(*value);
}

/* ---- Names ------------------------------------------------------------------------- */

static rb_status no_memory(const reading *r)
{
    return rb_fail(r->why, RB_ENOMEM, "%s: out of memory", r->path);
}

static rb_status keep_names(reading *r, const char *text)
{
    rb_io_table *t = r->t;
    const char *word;
    rb_status s = RB_OK;
    t->columns = count_words(text);
    t->name = calloc((size_t)t->columns, sizeof *t->name);
    if (!t->name)
        return no_memory(r);
    for (int j = 0; j < t->columns && s == RB_OK; j++) {
        const size_t n = next_word(&text, &word);
        t->name[j] = calloc(n + 1, 1);
        if (!t->name[j])
            return no_memory(r);
        memcpy(t->name[j], word, n);
        for (int i = 0; i < j && s == RB_OK; i++)
            if (strcmp(t->name[i], t->name[j]) == 0)
                s = rb_fail(r->why, RB_EFORMAT, "%s:%d: column '%s' is named twice", r->path,
                            r->line, t->name[j]);
    }
    return s;
}

/* ---- Rows -------------------------------------------------------------------------- */

/* Of files from where a decimal has a comma; "": the line is not one of them. */
static const char *about_commas(const char *line)
{
    const size_t n = strcspn(line, "\n");
    const char *comma = memchr(line, ',', n);
    const int decimal = comma && isdigit((unsigned char)comma[1]);
    return memchr(line, ';', n) || (decimal && (memchr(line, '\t', n) || memchr(line, ' ', n)))
               ? "; decimals have a point, and columns are separated by tabs, blanks or commas"
               : "";
}

static rb_status read_row(reading *r, const char *text)
{
    rb_io_table *t = r->t;
    const char *word, *whole = text;
    int n = 0;
    if (t->rows == r->capacity) {
        if (r->capacity > INT_MAX / 2)
            return rb_fail(r->why, RB_EFORMAT, "%s:%d: more than %d rows", r->path, r->line,
                           r->capacity);
        r->capacity = r->capacity ? 2 * r->capacity : 64;
        double *x = realloc(t->x, sizeof *x * (size_t)r->capacity * (size_t)(t->columns + 1));
        t->x = x ? x : t->x;
        int *line = x ? realloc(t->line, sizeof *line * (size_t)r->capacity) : NULL;
        if (!line)
            return no_memory(r);
        t->line = line;
    }
    for (size_t length; (length = next_word(&text, &word)) > 0; n++) {
        double value;
        if (!is_number(word, length, &value))
            return rb_fail(r->why, RB_EFORMAT, "%s:%d: expected a number, got '%.*s'%s", r->path,
                           r->line, length < 60 ? (int)length : 60, word, about_commas(whole));
        if (n < t->columns)
            t->x[(size_t)t->rows * (size_t)t->columns + (size_t)n] = value;
    }
    if (n != t->columns) {
        char names[160] = "";
        for (int j = 0; r->t->name && j < r->t->columns; j++)
            rb_append(names, sizeof names, "%s%s", j ? ", " : " (", r->t->name[j]);
        return rb_fail(r->why, RB_EFORMAT, "%s:%d: expected %d number%s%s%s, got %d%s", r->path,
                       r->line, r->t->columns, r->t->columns == 1 ? "" : "s", names,
                       *names ? ")" : "", n, about_commas(whole));
    }
    t->line[t->rows++] = r->line;
    return RB_OK;
}

rb_status rb_io_table_parse(const char *path, char *text, rb_io_table *t, rb_message *why)
{
    reading r = {.path = path, .comment = "", .t = t, .why = why};
    memset(t, 0, sizeof *t);
    rb_status s = RB_OK;
    for (char *next; s == RB_OK && *text; text = next) {
        next = text + strcspn(text, "\n");
        if (*next)
            *next++ = '\0';
        r.line++;
        char *comment = strchr(text, '#');
        if (comment) {
            *comment++ = '\0';
            if (t->rows == 0)
                r.comment = comment;
        }
        const int n = count_words(text);
        if (n == 0)
            continue;
        /* A first line of words, none of them a number, names the columns; so does a comment
         * of as many words as the first row has numbers. */
        const char *at = text, *word;
        double value;
        int is_names = t->rows == 0 && !t->name;
        for (size_t length; is_names && (length = next_word(&at, &word)) > 0;)
            is_names = !is_number(word, length, &value);
        if (is_names || (t->columns == 0 && count_words(r.comment) == n))
            s = keep_names(&r, is_names ? text : r.comment);
        t->columns = t->columns ? t->columns : n;
        if (s == RB_OK && !is_names)
            s = read_row(&r, text);
    }
    if (s == RB_OK && t->rows == 0)
        s = rb_fail(why, RB_EFORMAT, "%s: no numbers", path);
    if (s == RB_OK) { /* from rows to columns */
        const size_t rows = (size_t)t->rows, columns = (size_t)t->columns;
        double *x = rb_alloc(rows, columns);
        s = x ? RB_OK : no_memory(&r);
        for (size_t i = 0; x && i < rows; i++)
            for (size_t j = 0; j < columns; j++)
                x[i + j * rows] = t->x[i * columns + j];
        if (x) {
            free(t->x);
            t->x = x;
        }
    }
    if (s != RB_OK)
        rb_io_table_free(t);
    return s;
}

rb_status rb_io_table_read(const char *path, rb_io_table *t, rb_message *why)
{
    char *text;
    size_t size;
    rb_status s = rb_io_read_text(path, &text, &size, why);
    memset(t, 0, sizeof *t);
    if (s == RB_OK)
        s = rb_io_table_parse(path, text, t, why);
    free(text);
    return s;
}

rb_status rb_io_table_expect_columns(const char *path, int columns, rb_io_table *t, rb_message *why)
{
    if (t->columns == columns)
        return RB_OK;
    const rb_status s = rb_fail(why, RB_EFORMAT, "%s:%d: expected %d numbers, got %d", path,
                                t->line[0], columns, t->columns);
    rb_io_table_free(t);
    return s;
}

rb_status rb_io_table_read_columns(const char *path, int columns, rb_io_table *t, rb_message *why)
{
    const rb_status s = rb_io_table_read(path, t, why);
    return s == RB_OK ? rb_io_table_expect_columns(path, columns, t, why) : s;
}
