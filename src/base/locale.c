/* Reads and writes numbers in the C locale, whatever locale the calling program has
 * set. */
#include "base/base.h"

#include <locale.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

void *rb_locale_begin(void)
{
    /* Made once; two threads that come first both make one, which costs a few bytes. */
    static _Atomic(locale_t) made;
    if (!made)
        made = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    const locale_t own = made;
    return own ? (void *)uselocale(own) : NULL;
}

void rb_locale_end(void *before)
{
    if (before)
        uselocale((locale_t)before);
}

double rb_read_number(const char *text, char **end)
{
    void *before = rb_locale_begin();
    const double x = strtod(text, end);
    rb_locale_end(before);
    return x;
}

int rb_format(char *text, size_t size, const char *format, ...)
{
    va_list args;
    void *before = rb_locale_begin();
    va_start(args, format);
    const int n = vsnprintf(text, size, format, args);
    va_end(args);
    rb_locale_end(before);
    return n;
}
