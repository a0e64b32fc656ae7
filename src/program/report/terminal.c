/* A table with tabs, abbreviated for a terminal: few digits, few rows, few columns. */
#include "program/report/report.h"
#include "base/units.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 40, GAP = 2, LEAST_ROWS = 2 };

typedef struct {
    int rows, columns;
    const char **cell; /* rows x columns, borrowed from the text; row 0: the names */
} grid;

typedef struct {
    char name[WIDTH], unit[WIDTH];
    int width, is_shown, is_constant;
    double scale; /* the largest number; below rounding of it everything is zero */
    double units; /* the largest number of any column with this unit */
} column;

/* Lines of text are cut at tabs and ends in place; comments are left out.  0: it is no
 * table with tabs; -1: no memory. */
static int cut(char *text, grid *g)
{
    int lines = 1;
    char *end = strchr(text, '\n');
    *g = (grid){0, 1, NULL};
    if (!end || !memchr(text, '\t', (size_t)(end - text)))
        return 0;
    for (const char *c = text; c < end; c++)
        g->columns += *c == '\t';
    for (const char *c = text; *c; c++)
        lines += *c == '\n';
    g->cell = calloc((size_t)lines * (size_t)g->columns, sizeof *g->cell);
    if (!g->cell)
        return -1;
    for (char *line = text, *next; *line; line = next) {
        next = line + strcspn(line, "\n");
        if (*next)
            *next++ = '\0';
        if (*line == '#' || !*line)
            continue;
        const char **row = g->cell + (size_t)g->rows++ * (size_t)g->columns;
        for (int j = 0; j < g->columns; j++) {
            row[j] = line;
            line += strcspn(line, "\t");
            if (*line)
                *line++ = '\0';
        }
    }
    return 1;
}

static const char *entry(const grid *g, int i, int j)
{
    const char *text = g->cell[(size_t)i * (size_t)g->columns + (size_t)j];
    return text ? text : "";
}

static int read_number(const char *text, double *x)
{
    char *end;
    *x = rb_read_number(text, &end);
    return *text && !*end;
}

/* A cell with five digits, 0 where it is rounding of the largest number of its column, of
 * its unit or, without one, of 1. */
static const char *shown(const grid *g, int i, int j, const column *c, char text[WIDTH])
{
    double x;
    if (!read_number(entry(g, i, j), &x))
        snprintf(text, WIDTH, "%.*s", WIDTH - 1, entry(g, i, j));
    else if (isnan(x))
        snprintf(text, WIDTH, "-");
    else {
        const double least = c->unit[0] ? 0.0 : 1e-15,
                     rounding = fmax(fmax(1e-12 * c->scale, 1e-13 * c->units), least);
        snprintf(text, WIDTH, "%.5g", fabs(x) <= rounding ? 0.0 : x);
    }
    return text;
}

/* Which rows are shown: every so many and the last one where the first column is a number
 * (profiles, curves); otherwise (files, solvers) all but the middle. */
typedef struct {
    int step;     /* 1: all but the middle */
    int from, to; /* the middle, left out: empty where from > to */
} choice;

static int next_row(const grid *g, int i, const choice *c)
{
    const int next = i + c->step;
    if (c->from <= next && next <= c->to)
        return c->to + 1;
    return i < g->rows - 1 && next > g->rows - 1 ? g->rows - 1 : next;
}

/* Widths for the rows that are shown, and columns that say the same everywhere. */
static void measure_columns(const grid *g, const choice *rows, column *all)
{
    char text[WIDTH];
    for (int j = 0; j < g->columns; j++) {
        column *c = &all[j];
        double x;
        /* The unit behind the last "_" of a heading such as p_MPa stands below the name. */
        const char *heading = entry(g, 0, j), *unit = strrchr(heading, '_');
        const int known = unit && rb_unit_is_known(unit + 1);
        snprintf(c->name, WIDTH, "%.*s", known ? (int)(unit - heading) : WIDTH - 1, heading);
        snprintf(c->unit, WIDTH, "%s", known ? unit + 1 : "");
        for (int i = 1; i < g->rows; i++)
            if (read_number(entry(g, i, j), &x) && isfinite(x))
                c->scale = fmax(c->scale, fabs(x));
    }
    for (int j = 0; j < g->columns; j++) {
        column *c = &all[j];
        for (int k = 0; k < g->columns; k++)
            if (c->unit[0] && strcmp(c->unit, all[k].unit) == 0)
                c->units = fmax(c->units, all[k].scale);
        c->is_constant = g->rows > 2;
        for (int i = 2; i < g->rows && c->is_constant; i++)
            c->is_constant = strcmp(entry(g, i, j), entry(g, 1, j)) == 0;
        const size_t name = strlen(c->name), unit = strlen(c->unit);
        c->width = (int)(name > unit ? name : unit);
        for (int i = 1; i < g->rows; i = next_row(g, i, rows)) {
            const int width = (int)strlen(shown(g, i, j, c, text));
            c->width = width > c->width ? width : c->width;
        }
    }
}

/* Zones and failures stand out; what a colour says the text says too. */
static const char *colour_of(const column *c, const char *text)
{
    if (strcmp(c->name, "zone") == 0)
        return *text == '0' ? "\033[90m" : *text == '1' ? "\033[32m" : "\033[33m";
    if (strcmp(c->name, "status") == 0 && strncmp(text, "solved", 6) != 0)
        return "\033[31m";
    return "";
}

/* Items of a list behind a heading, in lines of the window's width. */
typedef struct {
    FILE *out;
    const char *heading;
    int width, at; /* characters in the line so far; 0: no item yet */
} list;

static void print_item(list *l, const char *item)
{
    const int n = (int)strlen(item);
    if (l->at == 0)
        l->at = fprintf(l->out, "%s", l->heading);
    else if (l->at + 3 + n > l->width)
        l->at = fprintf(l->out, ",\n ") - 2;
    else
        l->at += fprintf(l->out, ",");
    l->at += fprintf(l->out, " %s", item);
}

/* What the rows above do not say. */
static void print_rest(FILE *out, const grid *g, const column *all, const choice *rows, int width)
{
    char text[WIDTH], item[4 * WIDTH];
    list same = {out, "in every row:", width, 0}, missing = {out, "not shown:", width, 0};
    for (int j = 0; j < g->columns; j++) {
        const column *c = &all[j];
        if (!c->is_constant || strcmp(shown(g, 1, j, c, text), "-") == 0 || !*text)
            continue;
        snprintf(item, sizeof item, "%s = %s%s%s", c->name, text, c->unit[0] ? " " : "", c->unit);
        print_item(&same, item);
    }
    fputs(same.at ? "\n" : "", out);
    if (rows->step > 1) {
        snprintf(item, sizeof item, "%d in %d rows", rows->step - 1, rows->step);
        print_item(&missing, item);
    } else if (rows->from <= rows->to) {
        snprintf(item, sizeof item, "%d rows in the middle", rows->to - rows->from + 1);
        print_item(&missing, item);
    }
    for (int j = 0; j < g->columns; j++)
        if (!all[j].is_shown && !all[j].is_constant)
            print_item(&missing, all[j].name);
    if (missing.at)
        fprintf(out, "%s all: rollbem ... > FILE\n", missing.at + 26 > width ? ";\n " : ";");
}

/* A single row that is wider than the window: a line for each column. */
static void print_one_row(FILE *out, const grid *g, const column *all, int colour)
{
    char text[WIDTH];
    int names = 0;
    for (int j = 0; j < g->columns; j++)
        names = (int)strlen(all[j].name) > names ? (int)strlen(all[j].name) : names;
    for (int j = 0; j < g->columns; j++) {
        if (strcmp(shown(g, 1, j, &all[j], text), "-") == 0 || !*text)
            continue;
        const char *start = colour ? colour_of(&all[j], text) : "";
        fprintf(out, "  %-*s  %s%s%s%s%s\n", names, all[j].name, start, text,
                *start ? "\033[0m" : "", all[j].unit[0] ? " " : "", all[j].unit);
    }
}

rb_status rb_report_terminal(FILE *out, char *text, const rb_report_window *window)
{
    grid g;
    const int is_table = cut(text, &g);
    column *all = is_table > 0 ? calloc((size_t)g.columns, sizeof *all) : NULL;
    if (is_table <= 0)
        fputs(text, out);
    if (!all) {
        free(g.cell);
        return is_table ? RB_ENOMEM : rb_report_flush(out);
    }
    /* names, units, two lines about the rest, and the prompt */
    const int most = window->rows - 5 > LEAST_ROWS ? window->rows - 5 : LEAST_ROWS, n = g.rows - 1;
    double x;
    const choice rows = n <= most ? (choice){1, 1, 0}
                        : read_number(entry(&g, 1, 0), &x)
                            ? (choice){(n - 1 + most - 2) / (most - 1), 1, 0}
                            : (choice){1, most / 2 + 1, n - (most - most / 2 - 1)};
    int width = 0, wanted = 0, used = 0, units = 0;
    measure_columns(&g, &rows, all);
    for (int j = 0; j < g.columns; j++) {
        width += GAP + all[j].width;
        wanted += all[j].is_constant ? 0 : GAP + all[j].width;
    }
    /* Columns that differ, from the left, as many as fit; those of `minor` only where all do. */
    for (column *c = all; c < all + g.columns; c++) {
        char word[WIDTH + 2];
        snprintf(word, sizeof word, " %s ", c->name);
        const int minor = window->minor && strstr(window->minor, word) && wanted > window->columns;
        c->is_shown = !c->is_constant && !minor && used + GAP + c->width <= window->columns;
        used += c->is_shown ? GAP + c->width : 0;
        units |= c->is_shown && c->unit[0];
    }
    if (g.rows == 2 && width > window->columns) {
        print_one_row(out, &g, all, window->colour);
    } else {
        for (int line = 0; line <= units; line++) {
            fputs(window->colour ? "\033[1m" : "", out);
            for (int j = 0; j < g.columns; j++)
                if (all[j].is_shown)
                    fprintf(out, "%*s", GAP + all[j].width, line ? all[j].unit : all[j].name);
            fputs(window->colour ? "\033[0m\n" : "\n", out);
        }
        for (int i = 1; i < g.rows; i = next_row(&g, i, &rows)) {
            if (rows.from <= rows.to && i == rows.to + 1)
                fprintf(out, "%*s...\n", GAP, "");
            for (int j = 0; j < g.columns; j++) {
                char cell[WIDTH];
                if (!all[j].is_shown)
                    continue;
                shown(&g, i, j, &all[j], cell);
                const char *start = window->colour ? colour_of(&all[j], cell) : "";
                fprintf(out, "%*s%s%s%s", GAP + all[j].width - (int)strlen(cell), "", start, cell,
                        *start ? "\033[0m" : "");
            }
            fputc('\n', out);
        }
        print_rest(out, &g, all, &rows, window->columns);
    }
    free(all);
    free(g.cell);
    return rb_report_flush(out);
}

/* ---- Lines ------------------------------------------------------------------------- */

/* Characters that a terminal shows of the first n bytes: none of a colour's, one of
 * those that make a letter of UTF-8. */
static int width_shown(const char *text, size_t n)
{
    int count = 0;
    for (size_t k = 0; k < n; k++) {
        if (text[k] == '\033')
            while (k < n && text[k] != 'm')
                k++;
        else
            count += ((unsigned char)text[k] & 0xc0) != 0x80;
    }
    return count;
}

int rb_report_wrapped(FILE *out, const char *text, int width)
{
    int lines = 0;
    while (*text) {
        const size_t n = strcspn(text, "\n");
        /* Where the rest of a line goes on: below the text behind "  label     ", or two
         * further than its start. */
        enum { LABEL = 12 };
        const size_t blanks = strspn(text, " ");
        const int indent = blanks == 2 && n > LABEL && text[LABEL - 1] == ' ' && text[LABEL] != ' '
                               ? LABEL
                               : (int)blanks + 2;
        const char *end = text + n;
        size_t gap = strspn(text, " ");
        int at = 0;
        lines++;
        while (text < end) {
            const size_t word = strcspn(text + gap, " \n");
            const int wide = width_shown(text + gap, word);
            if (at > indent && at + (int)gap + wide > width) {
                at = fprintf(out, "\n%*s", indent, "") - 1;
                lines++;
            } else {
                at += fprintf(out, "%*s", (int)gap, "");
            }
            fprintf(out, "%.*s", (int)word, text + gap);
            at += wide;
            text += gap + word;
            gap = strspn(text, " ");
        }
        fputc('\n', out);
        text = end + (*end == '\n');
    }
    return lines;
}
