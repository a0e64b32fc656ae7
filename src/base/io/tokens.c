#include "base/io/tokens.h"

#include "base/io/io.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Only the first mistake is kept: what comes after it may follow from it. */
void rb_io_tokens_fail(io_tokens *t, const char *format, ...)
{
    if (t->status != RB_OK)
        return;
    char text[200];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    t->status = rb_fail(t->why, RB_EFORMAT, "%s:%d: %s", t->path, t->line, text);
}

void rb_io_tokens_open(const char *path, io_tokens *t, rb_message *why)
{
    const int given = !strcmp(path, "-");
    size_t size;
    *t = (io_tokens){.path = path, .line = 1, .why = why};
    /* The whole file is in memory, so that a token never ends in the middle of a buffer. */
    t->status = rb_io_read_text(given ? "/dev/stdin" : path, &t->text, &size, why);
    if (given)
        t->path = "standard input";
    t->at = t->text;
    t->end = t->text ? t->text + size : NULL;
    /* What other programs, and our own results, are often written in. */
    if (t->text && t->text[strspn(t->text, " \t\r\n")] == '{')
        rb_io_tokens_fail(t, "expected numbers as text, got JSON");
}

void rb_io_tokens_close(io_tokens *t)
{
    free(t->text);
    t->text = NULL;
}

static int space(char c)
{
    return isspace((unsigned char)c) != 0;
}

static void skip_space(io_tokens *t)
{
    for (; t->at < t->end && space(*t->at); t->at++)
        t->line += *t->at == '\n';
}

/* The next token's length, 0 at the end of the file. */
static size_t peek(io_tokens *t)
{
    skip_space(t);
    const char *p = t->at;
    while (p < t->end && !space(*p))
        p++;
    return (size_t)(p - t->at);
}

/* length: of the token that stands there, at most 40 characters of which are shown; 0: the file
 * ends. */
static void expected(io_tokens *t, const char *what, const char *wanted, size_t length)
{
    if (length)
        rb_io_tokens_fail(t, "%s: expected %s, got '%.*s'", what, wanted,
                          length < 40 ? (int)length : 40, t->at);
    else
        rb_io_tokens_fail(t, "%s: expected %s, the file ends", what, wanted);
}

int rb_io_tokens_int(io_tokens *t, int low, int high, const char *what)
{
    if (t->status != RB_OK)
        return 0;
    const size_t length = peek(t);
    char *stop;
    errno = 0;
    const long value = strtol(t->at, &stop, 10);
    const char *after = stop + (stop > t->at && *stop == ',');
    if (length && after == t->at + length && !errno && value >= low && value <= high) {
        t->at = after;
        return (int)value;
    }
    char wanted[60];
    /* What was expected, in words: one number, a least one, or a range. */
    if (low == high)
        snprintf(wanted, sizeof wanted, "%d", low);
    else if (high == INT_MAX)
        snprintf(wanted, sizeof wanted, "an integer >= %d", low);
    else
        snprintf(wanted, sizeof wanted, "an integer from %d to %d", low, high);
    expected(t, what, wanted, length);
    return 0;
}

static int allowed(const io_tokens *t, double value)
{
    return isfinite(value) || (t->infinite && isinf(value));
}

double rb_io_tokens_real(io_tokens *t, const char *what)
{
    if (t->status != RB_OK)
        return 0.0;
    const size_t length = peek(t);
    char *stop;
    const double value = rb_read_number(t->at, &stop);
    if (length && stop == t->at + length && allowed(t, value)) {
        t->at = stop;
        return value;
    }
    expected(t, what, t->infinite ? "a number, inf or -inf" : "a finite number", length);
    return 0.0;
}

/* Most of a large file is read here: numbers are recognised in place, and only one that is not gets
 * a name for the message. */
void rb_io_tokens_reals(io_tokens *t, size_t n, double *x, const char *what)
{
    for (size_t i = 0; i < n && t->status == RB_OK; i++) {
        char *stop;
        skip_space(t);
        x[i] = rb_read_number(t->at, &stop);
        if (stop > t->at && (stop == t->end || space(*stop)) && allowed(t, x[i])) {
            t->at = stop;
        } else {
            char name[60];
            snprintf(name, sizeof name, "%.30s, number %zu", what, i + 1);
            x[i] = rb_io_tokens_real(t, name);
        }
    }
}

void rb_io_tokens_word(io_tokens *t, const char *word)
{
    if (t->status != RB_OK)
        return;
    const size_t length = peek(t);
    if (length == strlen(word) && !strncmp(t->at, word, length))
        t->at += length;
    else
        expected(t, "sparse matrix", word, length);
}

/* 1: the next token is this word, in capitals or not, and has been taken. */
int rb_io_tokens_take(io_tokens *t, const char *word)
{
    const size_t length = t->status == RB_OK ? peek(t) : 0;
    if (length != strlen(word) || strncasecmp(t->at, word, length) != 0)
        return 0;
    t->at += length;
    return 1;
}

/* A number takes at least one character and a separator; cols > 0. */
int rb_io_tokens_room_for(io_tokens *t, size_t rows, size_t cols, const char *what)
{
    if (t->status != RB_OK)
        return 0;
    /* Compared by a division, because rows times cols of a broken file may overflow. */
    const size_t most = ((size_t)(t->end - t->at) + 1) / 2;
    if (cols == 0 || rows <= most / cols)
        return 1;
    rb_io_tokens_fail(t, "%s: expected %.10g numbers, the rest of the file has room for %zu", what,
                      (double)rows * (double)cols, most);
    return 0;
}

static void *allocated(io_tokens *t, void *memory, const char *what)
{
    if (!memory)
        t->status = rb_fail(t->why, RB_ENOMEM, "%s: out of memory for %s", t->path, what);
    return memory;
}

double *rb_io_tokens_alloc(io_tokens *t, size_t rows, size_t cols, const char *what)
{
    return rb_io_tokens_room_for(t, rows, cols, what) ? allocated(t, rb_alloc(rows, cols), what)
                                                      : NULL;
}

int *rb_io_tokens_alloc_int(io_tokens *t, size_t n, const char *what)
{
    return rb_io_tokens_room_for(t, n, 1, what) ? allocated(t, rb_alloc_int(n), what) : NULL;
}

int rb_io_tokens_more(io_tokens *t)
{
    return peek(t) > 0;
}

void rb_io_tokens_skip_line(io_tokens *t)
{
    while (t->at < t->end && *t->at != '\n')
        t->at++;
}

void rb_io_tokens_rewind(io_tokens *t)
{
    if (!t->text)
        return;
    t->status = RB_OK;
    t->at = t->text;
    t->line = 1;
}

/* Blanks keep the line numbers and places of everything else. */
void rb_io_tokens_blank_comments(io_tokens *t)
{
    if (!t->text)
        return;
    char *const end = t->text + (t->end - t->text);
    for (char *c = t->text; (c = memchr(c, '#', (size_t)(end - c))) != NULL;)
        for (; c < end && *c != '\n'; c++)
            *c = ' ';
}
