/* What a result prints against what the writer of results writes again from the inputs and the
 * state that are stored in it.  One rule for all members:
 *
 *   - there are the same members, lists are equally long, words and whole numbers are equal;
 *   - a number differs by at most SHARE of itself, LIST of the largest number of its list, or
 *     ROUNDINGS times what it changes when all stored numbers are moved by a rounding, which is how
 *     its conditioning is measured; in a comment of a table by one of its last digit, too;
 *   - what a rounding decides (a word, a count, a member) may be as it is with moved numbers. */
#include "program/certificate/internal.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

static const double SHARE = 1e-9, LIST = 1e-12, ROUNDINGS = 50.0;
enum { SAMPLES = 3 };

/* ---- Violations -------------------------------------------------------------------- */

void rb_certificate_violated(rb_certificate *c, const char *format, ...)
{
    va_list args;
    c->found->violations++;
    if (c->quiet)
        return;
    fprintf(c->out, "%s: ", c->name);
    if (c->of[0])
        fprintf(c->out, "%s: ", c->of);
    fputs("violated: ", c->out);
    if (c->step > 0)
        fprintf(c->out, "step %d: ", c->step);
    va_start(args, format);
    vfprintf(c->out, format, args);
    va_end(args);
    fputc('\n', c->out);
}

void rb_certificate_expect(rb_certificate *c, const char *what, double printed, double want,
                           double allowed)
{
    c->found->numbers++;
    if (!(fabs(printed - want) <= allowed || (isnan(printed) && isnan(want))))
        rb_certificate_violated(
            c, "%s: printed %.17g, recomputed %.17g (difference %.2g, allowed %.2g)", what, printed,
            want, printed - want, allowed);
}

rb_status rb_certificate_refuse(const rb_certificate *c, const char *what, rb_message *why)
{
    return rb_fail(why, RB_EFORMAT, "%s: cannot be checked: %s", c->name, what);
}

rb_status rb_certificate_end(const rb_certificate *c, rb_status s, const rb_message *reason,
                             rb_message *why)
{
    if (s == RB_OK)
        return s;
    if (s == RB_ENOMEM)
        return rb_fail(why, s, "%s: out of memory", c->name);
    const int is_named = strncmp(reason->text, c->name, strlen(c->name)) == 0;
    return is_named ? rb_fail(why, RB_EFORMAT, "%s", reason->text)
                    : rb_fail(why, RB_EFORMAT, "%s: cannot be checked: %s", c->name, reason->text);
}

/* ---- Trees ------------------------------------------------------------------------- */

/* A member, as it is written again, and with moved numbers.  NULL: there is none. */
typedef struct {
    const json_t *again, *sample[SAMPLES];
} written;

typedef struct {
    rb_certificate *c;
    double most, spread; /* of the list whose entries are compared */
} comparison;

static written member_of(const written *w, const char *key)
{
    written m = {json_object_get(w->again, key), {NULL}};
    for (int k = 0; k < SAMPLES; k++)
        m.sample[k] = json_object_get(w->sample[k], key);
    return m;
}

static written entry_of(const written *w, size_t i)
{
    written m = {json_array_get(w->again, i), {NULL}};
    for (int k = 0; k < SAMPLES; k++)
        m.sample[k] = json_array_get(w->sample[k], i);
    return m;
}

/* A sample that has the member, or one of an object that has it not; NULL: there is none. */
static const json_t *sample_with(const written *member)
{
    for (int k = 0; k < SAMPLES; k++)
        if (member->sample[k])
            return member->sample[k];
    return NULL;
}

static const json_t *sample_without(const written *w, const written *member)
{
    for (int k = 0; k < SAMPLES; k++)
        if (w->sample[k] && !member->sample[k])
            return w->sample[k];
    return NULL;
}

/* What a number changes by with moved numbers. */
static double spread_of(const written *w)
{
    double most = 0.0;
    for (int k = 0; k < SAMPLES; k++)
        if (json_is_number(w->sample[k]) && json_is_number(w->again))
            most = fmax(most, fabs(json_number_value(w->sample[k]) - json_number_value(w->again)));
    return most;
}

/* The beginning of a value, in one line. */
static const char *text_of(const json_t *value, char text[64])
{
    char *whole = json_dumps(value, JSON_ENCODE_ANY | JSON_COMPACT | JSON_ENSURE_ASCII);
    snprintf(text, 64, "%.59s%s", whole ? whole : "?", whole && strlen(whole) > 59 ? "..." : "");
    free(whole);
    return text;
}

/* 1: of the same type, and lists equally long. */
static int are_alike(const json_t *a, const json_t *b)
{
    return a && b &&
           (json_is_number(a)
                ? json_is_number(b)
                : json_typeof(a) == json_typeof(b) && json_array_size(a) == json_array_size(b));
}

static int depth(const json_t *list)
{
    return json_is_array(list) + json_is_array(json_array_get(list, 0));
}

static void compare(comparison *k, const char *path, const json_t *printed, const written *w);

/* One of the last digit with which a comment states x, by three digits at least: what is stated may
 * have been rounded to either side. */
static double last_digit(double x)
{
    char text[40];
    int digits = 3;

    for (; digits < 17; digits++) {
        snprintf(text, sizeof text, "%.*e", digits - 1, x);
        if (strtod(text, NULL) == x)
            break;
    }
    return x == 0.0 ? 0.0 : pow(10.0, floor(log10(fabs(x))) - digits + 1);
}

static void compare_numbers(comparison *k, const char *path, const json_t *printed,
                            const written *w)
{
    const double x = json_number_value(printed), want = json_number_value(w->again);
    double low = want, high = want;

    if (json_is_integer(w->again)) {
        for (int i = 0; i < SAMPLES; i++)
            if (json_is_integer(w->sample[i])) {
                low = fmin(low, json_number_value(w->sample[i]));
                high = fmax(high, json_number_value(w->sample[i]));
            }
        k->c->found->numbers++;
        if (!json_is_integer(printed) || !(low <= x && x <= high))
            rb_certificate_violated(k->c, "%s: printed %.17g, should be %.17g", path, x, want);
        return;
    }
    const double stated = strncmp(path, "comments.", 9) == 0 ? 1.000001 * last_digit(want) : 0.0;
    rb_certificate_expect(k->c, path, x, want,
                          stated + SHARE * fabs(want) + LIST * k->most +
                              ROUNDINGS * fmax(k->spread, spread_of(w)));
}

static void compare_objects(comparison *k, const char *path, const json_t *printed,
                            const written *w)
{
    char own[240], text[64];
    const char *key, *dot = *path ? "." : "";
    json_t *value;

    json_object_foreach((json_t *)w->again, key, value)
    {
        const written member = member_of(w, key);
        const json_t *there = json_object_get(printed, key);
        snprintf(own, sizeof own, "%.150s%s%.80s", path, dot, key);
        if (there)
            compare(k, own, there, &member);
        else if (!sample_without(w, &member))
            rb_certificate_violated(k->c, "%s is missing, should be %s", own, text_of(value, text));
    }
    json_object_foreach((json_t *)printed, key, value)
    {
        if (json_object_get(w->again, key))
            continue;
        const written member = member_of(w, key);
        snprintf(own, sizeof own, "%.150s%s%.80s", path, dot, key);
        if (sample_with(&member))
            compare(k, own, value, &(written){sample_with(&member), {NULL}});
        else
            rb_certificate_violated(k->c, "%s is no result of this case", own);
    }
}

/* Of several entries that differ the first one is told. */
static void compare_lists(comparison *k, const char *path, const json_t *printed, const written *w)
{
    const comparison outer = *k;
    rb_certificate *c = k->c;
    const int before = c->found->violations, quiet = c->quiet;
    const size_t n = json_array_size(w->again);
    char own[240];

    k->most = k->spread = 0.0;
    for (size_t i = 0; i < n; i++) {
        const written entry = entry_of(w, i);
        if (json_is_number(entry.again))
            k->most = fmax(k->most, fabs(json_number_value(entry.again)));
        k->spread = fmax(k->spread, spread_of(&entry));
    }
    for (size_t i = 0; i < n; i++) {
        const written entry = entry_of(w, i);
        const int is_leaf = !json_is_array(entry.again) && !json_is_object(entry.again);
        snprintf(own, sizeof own, is_leaf ? "%.200s, entry %zu" : "%.200s.%zu", path, i + 1);
        compare(k, own, json_array_get(printed, i), &entry);
        c->quiet = quiet || c->found->violations > before;
    }
    c->quiet = quiet;
    if (c->found->violations > before + 1 && !quiet) {
        fprintf(c->out, "%s: %s: %d entries differ\n", c->name, path,
                c->found->violations - before);
    }
    *k = outer;
}

static void compare(comparison *k, const char *path, const json_t *printed, const written *w)
{
    char text[2][64];

    /* [left, right] of a derivative, which one number stands for where they are equal */
    for (int i = 0; i < 2 && strstr(path, "derivatives"); i++) {
        const json_t *two = i ? printed : w->again, *one = i ? w->again : printed;
        if (json_array_size(two) != 2 || !one || depth(two) != depth(one) + 1)
            continue;
        for (size_t side = 0; side < 2; side++) {
            const written of_again = entry_of(w, side);
            compare(k, path, i ? json_array_get(printed, side) : printed, i ? w : &of_again);
        }
        return;
    }
    for (int i = 0; i < SAMPLES && !are_alike(printed, w->again); i++)
        if (are_alike(printed, w->sample[i])) {
            compare(k, path, printed, &(written){w->sample[i], {NULL}});
            return;
        }
    if (json_is_array(printed) && json_is_array(w->again) && !are_alike(printed, w->again))
        rb_certificate_violated(k->c, "%s: %zu entries, expected %zu", path,
                                json_array_size(printed), json_array_size(w->again));
    else if (json_is_array(printed) && json_is_array(w->again))
        compare_lists(k, path, printed, w);
    else if (json_is_object(printed) && json_is_object(w->again))
        compare_objects(k, path, printed, w);
    else if (json_is_number(printed) && json_is_number(w->again))
        compare_numbers(k, path, printed, w);
    else {
        int same = json_equal(printed, w->again);
        for (int i = 0; i < SAMPLES; i++)
            same |= w->sample[i] && json_equal(printed, w->sample[i]);
        k->c->found->numbers += json_is_null(w->again);
        if (!same)
            rb_certificate_violated(
                k->c, "%s: printed %s, should be %s%s", path, text_of(printed, text[0]),
                text_of(w->again, text[1]),
                strcmp(path, "input_hash") == 0
                    ? ": inputs, or a file that they name, are not those of the result"
                    : "");
    }
}

/* ---- Both ways --------------------------------------------------------------------- */

/* Compares; with samples if the first look finds something. */
static rb_status compare_twice(rb_certificate *c, const json_t *printed, const json_t *again,
                               rb_certificate_writer *write, void *context, rb_message *why)
{
    comparison k = {.c = c};
    const rb_certificate_outcome judged = *c->found;
    json_t *sample[SAMPLES] = {NULL};
    rb_status s = RB_OK;
    int n = 0;

    c->quiet = 1;
    compare(&k, "", printed, &(written){again, {NULL}});
    if (c->found->violations > judged.violations) {
        *c->found = judged;
        c->judges = 0;
        for (int i = 0; i < SAMPLES && s != RB_ENOMEM; i++) {
            rb_message reason;
            c->moving = (uint64_t)i + 1;
            s = write(c, context, &sample[n], &reason);
            n += s == RB_OK;
            if (s == RB_ENOMEM)
                *why = reason;
        }
        c->moving = 0;
        c->quiet = 0;
        written w = {again, {NULL}};
        for (int i = 0; i < n; i++)
            w.sample[i] = sample[i];
        if (s != RB_ENOMEM)
            compare(&k, "", printed, &w);
        for (int i = 0; i < SAMPLES; i++)
            json_decref(sample[i]);
    }
    c->quiet = 0;
    return s == RB_ENOMEM ? s : RB_OK;
}

rb_status rb_certificate_compare(rb_certificate *c, const json_t *printed,
                                 rb_certificate_writer *write, void *context, rb_message *why)
{
    FILE *out = c->out;
    char *lines = NULL;
    size_t size;
    json_t *again = NULL;

    /* What the laws find is told once it is known that the result can be checked. */
    c->out = open_memstream(&lines, &size);
    if (!c->out) {
        c->out = out;
        return RB_ENOMEM;
    }
    c->quiet = 0;
    c->judges = 1;
    c->moving = 0;
    rb_status s = write(c, context, &again, why);
    if (s == RB_OK)
        s = compare_twice(c, printed, again, write, context, why);
    json_decref(again);
    if ((fclose(c->out) != 0 || !lines) && s == RB_OK) /* success without a text: no memory */
        s = RB_ENOMEM;
    c->out = out;
    if (s == RB_OK)
        fwrite(lines, 1, size, out);
    free(lines);
    return s;
}
