/* One value of one option: from text, strictly, and back. */
#include "rolling/case/case.h"
#include "rolling/case/rubber.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int rb_option_number(const char *text, double *value)
{
    char *end;
    if (strchr(" \t\n", *text)) /* or empty */
        return 0;
    *value = rb_read_number(text, &end);
    return *end == '\0' && isfinite(*value);
}

/* What is read, and what comes of it. */
typedef struct {
    int plain;      /* 1: a number came without a unit; RB_GIVEN_HARDNESS */
    rb_message why; /* what is wrong with a unit; "" otherwise */
} reading;

static int set_number(const rb_option *o, double *place, const char *value, reading *r)
{
    double v;
    int plain = 0;
    if (o->word && strcmp(value, o->word) == 0)
        v = o->word_value;
    else if (o->modulus && rb_rubber_read(value, 0, &v, &r->why)) {
        if (isnan(v))
            return 0;
        v = rb_rubber_scales[RB_RUBBER_SHORE_A].relation[0].young(v);
        plain = RB_GIVEN_HARDNESS;
    } else if (rb_unit_read(value, o->unit, &v, &plain, &r->why) != RB_OK ||
               !rb_option_in_range(o, v))
        return 0;
    r->plain |= plain;
    *place = v;
    return 1;
}

static int set_list(const rb_option *o, char *target, const char *value, reading *r)
{
    rb_numbers list = {0};
    char word[64];
    int plain = 0;
    for (size_t n; list.n < RB_NUMBERS_MAX; value += n + 1) {
        n = strcspn(value, ",");
        if (n >= sizeof word)
            return 0;
        memcpy(word, value, n);
        word[n] = '\0';
        reading one = {0, {.text = ""}};
        if (!set_number(o, &list.value[list.n++], word, &one)) {
            r->why = one.why;
            return 0;
        }
        plain += one.plain;
        if (value[n] == '\0' && plain > 0 && plain < list.n) {
            rb_fail(&r->why, RB_EINVAL, "a unit for each number or for none");
            return 0;
        }
        r->plain = plain > 0;
        if (value[n] == '\0') {
            *(rb_numbers *)(target + o->list) = list;
            *(double *)(target + o->offset) = list.value[0];
            return 1;
        }
    }
    rb_fail(&r->why, RB_EINVAL, "at most %d numbers", RB_NUMBERS_MAX);
    return 0;
}

static int set_any(const rb_option *o, char *target, const char *value, reading *r)
{
    void *place = target + o->offset;
    switch (o->kind) {
    case RB_OPTION_NUMBER: {
        int *const lengths = o->lengths ? (int *)(void *)(target + o->lengths) : NULL;
        double length;
        int plain;
        if (lengths && rb_unit_read(value, "mm", &length, &plain, NULL) == RB_OK && !plain) {
            if (!rb_option_in_range(o, length))
                return 0;
            *(double *)place = length;
            *lengths |= o->length_bit;
            return 1;
        }
        if (!(o->list ? set_list(o, target, value, r) : set_number(o, place, value, r)))
            return 0;
        if (lengths)
            *lengths &= ~o->length_bit;
        return 1;
    }
    case RB_OPTION_INTEGER: {
        char *end;
        errno = 0;
        const long v = strtol(value, &end, 10);
        if (strchr(" \t\n", *value) || *end != '\0') /* or empty */
            return 0;
        if (v > INT_MAX && isinf(o->range.to))
            rb_fail(&r->why, RB_EINVAL, "a whole number of at most %d, got '%.100s'", INT_MAX,
                    value);
        if (v < INT_MIN || v > INT_MAX || !rb_option_in_range(o, (double)v))
            return 0;
        *(int *)place = (int)v;
        return 1;
    }
    case RB_OPTION_CHOICE:
        for (const rb_choice *c = o->choices; c->name; c++)
            if (strcmp(value, c->name) == 0) {
                *(int *)place = c->value;
                return 1;
            }
        if (!o->path || *value == '\0')
            return 0;
        *(const char **)(target + o->path) = value;
        *(int *)place = o->path_value;
        return 1;
    case RB_OPTION_FLAG:
        *(int *)place = strcmp(value, "yes") == 0 || strcmp(value, "true") == 0;
        return *(int *)place || strcmp(value, "no") == 0 || strcmp(value, "false") == 0;
    case RB_OPTION_TEXT:
        *(const char **)place = value;
        return *value != '\0';
    case RB_OPTION_GROUP:
        break;
    }
    return 0;
}

rb_status rb_option_assign(const rb_option_set *set, int k, int by, const char *what,
                           const char *text, rb_message *why)
{
    const rb_option *option = &set->options[k];
    reading r = {0, {.text = ""}};
    char expected[200];

    const int stated = set_any(option, set->target, text, &r);
    if (!stated && option->one_only && strchr(text, ','))
        return rb_fail(why, RB_EINVAL, "%s: %s; expected %s, got '%s'", what, option->one_only,
                       rb_option_expected(option, expected, sizeof expected), text);
    if (!stated)
        return r.why.text[0] ? rb_fail(why, RB_EINVAL, "%.300s: expected %s", what, r.why.text)
                             : rb_fail(why, RB_EINVAL, "%s: expected %s, got '%s'", what,
                                       rb_option_expected(option, expected, sizeof expected), text);
    if (set->given)
        set->given[k] = by;
    if (set->plain)
        set->plain[k] = r.plain;
    return RB_OK;
}

int rb_option_is_length(const rb_option *o, const void *target)
{
    return o->lengths &&
           (*(const int *)(const void *)((const char *)target + o->lengths) & o->length_bit) != 0;
}

const char *rb_option_text(const rb_option *o, const void *target, char buffer[64])
{
    const void *place = (const char *)target + o->offset;
    switch (o->kind) {
    case RB_OPTION_NUMBER: {
        const double v = *(const double *)place;
        if (o->word && v == o->word_value)
            return o->word;
        if (isnan(v))
            return "";
        rb_format(buffer, 64, rb_option_is_length(o, target) ? "%.15gmm" : "%.15g", v);
        return buffer;
    }
    case RB_OPTION_INTEGER:
        snprintf(buffer, 64, "%d", *(const int *)place);
        return buffer;
    case RB_OPTION_CHOICE:
        for (const rb_choice *c = o->choices; c->name; c++)
            if (c->value == *(const int *)place)
                return c->name;
        return o->path ? *(const char *const *)(const void *)((const char *)target + o->path) : "";
    case RB_OPTION_FLAG:
        return *(const int *)place ? "yes" : "no";
    case RB_OPTION_TEXT: {
        const char *text = *(const char *const *)place;
        return text ? text : "";
    }
    case RB_OPTION_GROUP:
        break;
    }
    return "";
}

const char *rb_option_path(const rb_option *o, const void *target)
{
    const char *values = target;
    if (o->file == RB_FILE_NONE)
        return NULL;
    if (o->kind == RB_OPTION_CHOICE && *(const int *)(values + o->offset) != o->path_value)
        return NULL;
    return *(const char *const *)(values + (o->kind == RB_OPTION_CHOICE ? o->path : o->offset));
}
