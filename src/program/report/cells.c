/* Tables of any kind, cell by cell, in the formats that other programs open. */
#include "program/report/report.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

static int is_csv(const rb_report_cells *c)
{
    return c->style.format == RB_REPORT_CSV;
}

static void begin_cell(rb_report_cells *c)
{
    if (c->cells++ > 0)
        fputc(is_csv(c) ? ',' : '\t', c->out);
}

void rb_report_cell_text(rb_report_cells *c, const char *text)
{
    const size_t size = 4 * strlen(text) + 1;
    char *printable = malloc(size);
    /* without memory the text stands as it is */
    const char *shown = printable ? rb_printable(text, printable, size) : text;
    begin_cell(c);
    /* As RFC 4180 wants it, which readers of tabs take as well. */
    const int quoted = strpbrk(shown, " ,\"#\t\n") || !*shown;
    fputs(quoted ? "\"" : "", c->out);
    for (const char *at = shown; *at; at++) {
        if (*at == '"')
            fputc('"', c->out);
        fputc(*at, c->out);
    }
    fputs(quoted ? "\"" : "", c->out);
    free(printable);
}

void rb_report_cell_words(rb_report_cells *c, const char *words)
{
    begin_cell(c);
    for (; *words; words++)
        fputc(*words == ' ' ? '-' : *words, c->out);
}

void rb_report_cell_number(rb_report_cells *c, double x)
{
    char text[RB_NUMBER_TEXT];
    begin_cell(c);
    if (isfinite(x))
        fputs(rb_number_text(x, text), c->out);
    else if (!is_csv(c))
        fputs("NaN", c->out); /* as R spells it; the others take any case */
}

void rb_report_cell_whole(rb_report_cells *c, int n)
{
    begin_cell(c);
    fprintf(c->out, "%d", n);
}

void rb_report_cells_end_row(rb_report_cells *c)
{
    fputc('\n', c->out);
    c->cells = 0;
}

rb_report_cells rb_report_cells_begin(FILE *out, const rb_report_style *style, const char *names)
{
    rb_report_cells c = {.out = out, .style = *style};
    for (size_t n; *names; names += n + (names[n] == ' ')) {
        n = strcspn(names, " ");
        begin_cell(&c);
        fprintf(out, "%.*s", (int)n, names);
    }
    if (c.cells > 0)
        rb_report_cells_end_row(&c);
    return c;
}

void rb_report_comment(const rb_report_cells *c, const char *format, ...)
{
    va_list args;
    if (c->style.bare || is_csv(c))
        return;
    void *before = rb_locale_begin();
    va_start(args, format);
    fputs("# ", c->out);
    vfprintf(c->out, format, args);
    fputc('\n', c->out);
    va_end(args);
    rb_locale_end(before);
}

void rb_report_comment_origin(const rb_report_cells *c, const char *command)
{
    rb_report_comment(c, "rollbem %s", RB_VERSION);
    rb_report_comment(c, "%s", command);
}

rb_status rb_report_flush(FILE *out)
{
    return fflush(out) == 0 && !ferror(out) ? RB_OK : RB_EWRITE;
}
