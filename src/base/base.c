/* Messages with numbers, status words, text in the locale of programs, memory, the clock. */
#include "base/base.h"

#include <lapacke.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* about NULL: of no input */
static rb_status write_message(rb_message *why, rb_status s, const char *about, int row,
                               const char *format, va_list args)
{
    if (!why)
        return s;
    void *before = rb_locale_begin();
    char text[sizeof why->text], name[sizeof why->about];
    /* into another place first: the arguments may be of the same message */
    vsnprintf(text, sizeof text, format, args);
    rb_next_word(about ? about : "", name, sizeof name);
    *why = (rb_message){.row = row};
    if (about) {
        snprintf(why->about, sizeof why->about, "%s", about);
        rb_append(why->text, sizeof why->text, row > 0 ? "%s: row %d: " : "%s: ", name, row);
        why->rest = (int)strlen(why->text);
    }
    rb_append(why->text, sizeof why->text, "%s", text);
    rb_locale_end(before);
    return s;
}

rb_status rb_fail(rb_message *why, rb_status s, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    write_message(why, s, NULL, 0, format, args);
    va_end(args);
    return s;
}

rb_status rb_refuse(rb_message *why, const char *about, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    write_message(why, RB_EINVAL, about, 0, format, args);
    va_end(args);
    return RB_EINVAL;
}

rb_status rb_refuse_row(rb_message *why, const char *about, int row, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    write_message(why, RB_EINVAL, about, row, format, args);
    va_end(args);
    return RB_EINVAL;
}

double rb_largest_shown(double x)
{
    if (x == 0.0 || !isfinite(x))
        return x;
    const double unit = pow(10.0, floor(log10(fabs(x))) - 5.0);
    /* what differs from a number of six digits by rounding is that number */
    return copysign(floor(fabs(x) / unit * (1.0 + 1e-14)) * unit, x);
}

void rb_append(char *text, size_t size, const char *format, ...)
{
    const size_t used = strlen(text);
    va_list args;
    void *before = rb_locale_begin();
    va_start(args, format);
    vsnprintf(text + used, size - used, format, args);
    va_end(args);
    rb_locale_end(before);
}

const char *rb_next_word(const char *list, char *word, size_t size)
{
    if (!list || !*list)
        return NULL;
    const size_t n = strcspn(list, ","), from = strspn(list, " ");
    size_t to = n;
    while (to > from && list[to - 1] == ' ')
        to--;
    snprintf(word, size, "%.*s", to > from ? (int)(to - from) : 0, list + from);
    return list + n + (list[n] == ',');
}

const char *rb_version(void)
{
    return RB_VERSION;
}

const char *rb_status_text(rb_status s)
{
    switch (s) {
    case RB_OK:
        return "solved";
    case RB_EINVAL:
        return "invalid input";
    case RB_ENOMEM:
        return "out of memory";
    case RB_ENOENT:
        return "no such file";
    case RB_EFORMAT:
        return "malformed file";
    case RB_EWRITE:
        return "cannot write";
    case RB_EHELPER:
        return "a helper program failed";
    case RB_MAXITER:
        return "iteration limit";
    case RB_RAY:
        return "secondary ray";
    case RB_SINGULAR:
        return "singular matrix";
    case RB_NO_CONTACT:
        return "no contact";
    case RB_ZONE:
        return "potential contact too small";
    case RB_INACCURATE:
        return "residual above tolerance";
    case RB_INTERRUPTED:
        return "interrupted";
    case RB_NO_SOLUTION:
        return "no solution";
    case RB_UNDECIDED:
        return "undecided";
    case RB_NUMERICAL:
        return "numerical failure";
    case RB_TIME_LIMIT:
        return "time limit";
    }
    return "unknown status";
}

const char *rb_status_reason(rb_status s, const rb_message *why)
{
    return why->text[0] ? why->text : rb_status_text(s);
}

rb_status rb_lapack_status(int info)
{
    if (info == 0)
        return RB_OK;
    return info == LAPACK_WORK_MEMORY_ERROR || info == LAPACK_TRANSPOSE_MEMORY_ERROR ? RB_ENOMEM
                                                                                     : RB_SINGULAR;
}

/* Bytes of the UTF-8 character at text; 0: none, or a control character. */
static size_t character_size(const unsigned char *text)
{
    static const unsigned least[] = {0, 0, 0x80, 0x800, 0x10000};
    const unsigned char first = text[0];
    const size_t n = first < 0x80 ? 1 : first < 0xc0 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    if (n < 2)
        return n == 1 && first >= ' ' && first != 127;
    unsigned code = first & (0x7fu >> n);
    for (size_t i = 1; i < n; i++) {
        if ((text[i] & 0xc0) != 0x80)
            return 0;
        code = code << 6 | (text[i] & 0x3fu);
    }
    return code >= least[n] && code <= 0x10ffff && (code < 0xd800 || code > 0xdfff) && code >= 0xa0
               ? n
               : 0;
}

char *rb_printable(const char *text, char *to, size_t size)
{
    char *at = to;
    while (*text) {
        const size_t n = character_size((const unsigned char *)text);
        if (at + (n ? n : 4) >= to + size)
            break;
        if (n)
            memcpy(at, text, n);
        else
            snprintf(at, 5, "\\x%02x", (unsigned)(unsigned char)*text);
        at += n ? n : 4;
        text += n ? n : 1;
    }
    *at = '\0';
    return to;
}

static void *alloc_array(size_t rows, size_t cols, size_t size)
{
    if (cols && rows > SIZE_MAX / cols)
        return NULL;
    const size_t n = rows * cols;
    return calloc(n ? n : 1, size);
}

double *rb_alloc(size_t rows, size_t cols)
{
    return alloc_array(rows, cols, sizeof(double));
}

int *rb_alloc_int(size_t n)
{
    return alloc_array(n, 1, sizeof(int));
}

double *rb_copy(size_t n, const double *x)
{
    double *copy = rb_alloc(n, 1);
    if (copy && n)
        memcpy(copy, x, n * sizeof *copy);
    return copy;
}

rb_status rb_memory_check(double bytes, const char *what, rb_message *why)
{
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    const double machine = (double)pages * (double)page;

    /* -1 where the system does not tell: then the allocation itself decides */
    if (pages <= 0 || page <= 0 || bytes <= machine)
        return RB_OK;
    return rb_fail(why, RB_EINVAL, "%s would need %.3g GB of memory; this machine has %.3g GB",
                   what, bytes / 1e9, machine / 1e9);
}

double rb_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double rb_norm_inf(size_t n, const double *x)
{
    double norm = 0.0;
    for (size_t i = 0; i < n; i++) {
        if (isnan(x[i]))
            return x[i];
        norm = fmax(norm, fabs(x[i]));
    }
    return norm;
}

double rb_norm_1(size_t n, const double *x, size_t stride)
{
    double norm = 0.0;
    for (size_t i = 0; i < n; i++)
        norm += fabs(x[i * stride]);
    return norm;
}

/* Four sums at a time: one would wait for each addition before it starts the next. */
double rb_dot(size_t n, const double *x, const double *y)
{
    double sum[4] = {0.0, 0.0, 0.0, 0.0};
    size_t k = 0;
    for (; k + 4 <= n; k += 4)
        for (size_t i = 0; i < 4; i++)
            sum[i] += x[k + i] * y[k + i];
    for (; k < n; k++)
        sum[0] += x[k] * y[k];
    return sum[0] + sum[1] + (sum[2] + sum[3]);
}

double rb_distance(size_t n, const double *x, const double *y)
{
    double sum = 0.0;
    for (size_t k = 0; k < n; k++)
        sum += (x[k] - y[k]) * (x[k] - y[k]);
    return sqrt(sum);
}

uint64_t rb_hash(uint64_t hash, const void *data, size_t size)
{
    const unsigned char *byte = data;
    for (size_t k = 0; k < size; k++)
        hash = (hash ^ byte[k]) * UINT64_C(1099511628211);
    return hash;
}
