/* Options that exclude each other. */
#include "rolling/case/words.h"

#include <stdio.h>
#include <string.h>

rb_option_precedence rb_case_precedence(const rb_case *c)
{
    /* In rolling a force stands in the place of a creepage; static contact knows no rolling. */
    const unsigned alike =
        c->words.rc.formulation == RB_STATIC ? 0 : RB_ONE_CREEPAGE | RB_ONE_LOADING;
    return (rb_option_precedence){&c->defaults, alike, c->path};
}

const char *rb_option_source(const rb_option *option, int given, const char *path, char *text,
                             size_t size)
{
    if (given > 0)
        snprintf(text, size, "%s:%d: %s", path, given, option->name);
    else
        snprintf(text, size, "%s%s", given == RB_GIVEN_ARGUMENT ? "--" : "", option->name);
    return text;
}

static void take_back(const rb_option_set *set, int i, const void *defaults)
{
    const rb_option *o = &set->options[i];
    const size_t size = o->kind == RB_OPTION_NUMBER ? sizeof(double)
                        : o->kind == RB_OPTION_TEXT ? sizeof(const char *)
                                                    : sizeof(int);
    memcpy((char *)set->target + o->offset, (const char *)defaults + o->offset, size);
    if (o->lengths)
        *(int *)(void *)((char *)set->target + o->lengths) &= ~o->length_bit;
    set->given[i] = 0;
}

static int exclude_each_other(unsigned a, unsigned b, unsigned alike)
{
    a |= a & alike ? alike : 0;
    b |= b & alike ? alike : 0;
    return (a & b) != 0;
}

static int is_argument_over_file(int by, int other)
{
    return by == RB_GIVEN_ARGUMENT && other > 0;
}

rb_status rb_option_resolve(const rb_option_set *set, const rb_option_precedence *how,
                            rb_message *why)
{
    for (int i = 0; i < set->n; i++)
        for (int j = i + 1; j < set->n && set->given[i]; j++) {
            const rb_option *a = &set->options[i], *b = &set->options[j];
            const int by_a = set->given[i], by_b = set->given[j];
            char first[400], second[400];
            if (!by_b || !exclude_each_other(a->excludes, b->excludes, how->alike))
                continue;
            if (!is_argument_over_file(by_a, by_b) && !is_argument_over_file(by_b, by_a))
                return rb_fail(why, by_a > 0 && by_b > 0 ? RB_EFORMAT : RB_EINVAL,
                               "%s and %s exclude each other",
                               rb_option_source(a, by_a, how->path, first, sizeof first),
                               rb_option_source(b, by_b, how->path, second, sizeof second));
            take_back(set, by_a > 0 ? i : j, how->defaults);
        }
    return RB_OK;
}

rb_status rb_option_resolve_against(const rb_option_set *set, const rb_option_precedence *how,
                                    const rb_option *option, int by, const char *reason,
                                    rb_message *why)
{
    char text[400];
    for (int i = 0; i < set->n; i++) {
        const int given = set->given[i];
        if (!given || !exclude_each_other(option->excludes, set->options[i].excludes, how->alike))
            continue;
        if (!is_argument_over_file(by, given))
            return rb_fail(why, given > 0 ? RB_EFORMAT : RB_EINVAL, "%s: %s",
                           rb_option_source(&set->options[i], given, how->path, text, sizeof text),
                           reason);
        take_back(set, i, how->defaults);
    }
    return RB_OK;
}
