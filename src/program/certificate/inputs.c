/* The case of a result again, from the inputs that the result prints: every value that was used,
 * whether it was given, a default or taken from another one. */
#include "program/certificate/internal.h"

#include <math.h>
#include <string.h>

const char *rb_certificate_word(const json_t *object, const char *key)
{
    const char *text = json_string_value(json_object_get(object, key));
    return text ? text : "";
}

double rb_certificate_member(const json_t *object, const char *key)
{
    const json_t *value = json_object_get(object, key);
    return json_is_number(value) ? json_number_value(value) : (double)NAN;
}

/* A value as an option takes it: a word, a number, numbers with commas. */
static void option_text(const json_t *value, char *text, size_t size)
{
    if (json_is_string(value))
        snprintf(text, size, "%s", json_string_value(value));
    else if (json_is_boolean(value))
        snprintf(text, size, json_is_true(value) ? "yes" : "no");
    else if (json_is_integer(value))
        snprintf(text, size, "%" JSON_INTEGER_FORMAT, json_integer_value(value));
    else if (json_is_real(value))
        rb_format(text, size, "%.17g", json_real_value(value));
    else
        text[0] = '\0';
    for (size_t k = 0; json_is_array(value) && k < json_array_size(value); k++) {
        const size_t n = strlen(text);
        rb_format(text + n, size - n, "%s%.17g", k ? "," : "",
                  json_number_value(json_array_get(value, k)));
    }
}

/* 1: `own_of_b` says that B has this value of A by itself. */
static int is_listed(const json_t *root, const char *key)
{
    const json_t *own = json_object_get(root, "own_of_b");
    size_t k;
    json_t *name;
    json_array_foreach(own, k, name)
    {
        if (json_is_string(name) && strcmp(json_string_value(name), key) == 0)
            return 1;
    }
    return 0;
}

/* What B has not although A has it: --similar would copy it. */
static int is_own_of_b(const json_t *root, const char *key)
{
    const json_t *inputs = json_object_get(root, "inputs");
    char name[80];
    const char *below = strncmp(key, "base", 4) == 0   ? "layer-thickness-b"
                        : strncmp(key, "core", 4) == 0 ? "cover-thickness-b"
                                                       : key;

    if (is_listed(root, key))
        return 1;
    if (!json_is_true(json_object_get(inputs, "similar")) || !rb_case_is_copied_to_b(key))
        return 0;
    snprintf(name, sizeof name, "%.*s", (int)strlen(key) - 2, key);
    const json_t *of_a = json_object_get(inputs, name);
    return of_a && (below == key || json_is_number(json_object_get(inputs, below))) &&
           !json_equal(json_object_get(inputs, key), of_a);
}

/* 1: B has the number from A, with which it varies, and not the same one of its own. */
static int is_copied(const json_t *root, const char *key)
{
    const json_t *inputs = json_object_get(root, "inputs");
    const int similar = json_is_true(json_object_get(inputs, "similar"));
    const rb_option *o = rb_case_option(key);
    const char *const memory[] = {"relaxation-time", "relaxation-ratio"};
    const int is_memory =
        strncmp(key, "relaxation-", 11) == 0 && strcmp(key + strlen(key) - 2, "-b") == 0;
    char name[80];

    if (!o || !(is_memory ? similar : o->of_a && (similar || !o->if_similar)) ||
        is_listed(root, key))
        return 0;
    if (!is_memory) {
        snprintf(name, sizeof name, "%.*s", (int)strlen(key) - 2, key);
        return json_equal(json_object_get(inputs, key), json_object_get(inputs, name));
    }
    for (int k = 0; k < 2; k++) { /* one with the other */
        snprintf(name, sizeof name, "%s-b", memory[k]);
        if (!json_equal(json_object_get(inputs, memory[k]), json_object_get(inputs, name)))
            return 0;
    }
    return 1;
}

/* Sets what differs from `now`; at first, what B has from A follows it. */
static rb_status set_inputs(const json_t *root, const json_t *now, int first, rb_case *words,
                            rb_message *why)
{
    const json_t *inputs = json_object_get(root, "inputs");
    rb_status s = RB_OK;
    const char *key;
    json_t *value;
    char text[4200];

    json_object_foreach((json_t *)inputs, key, value)
    {
        if (s != RB_OK || json_is_null(value) || (first && is_copied(root, key)) ||
            (json_equal(value, json_object_get(now, key)) && !(first && is_own_of_b(root, key))))
            continue;
        option_text(value, text, sizeof text);
        s = rb_case_set(words, key, text, RB_GIVEN_ARGUMENT, why);
    }
    return s == RB_OK ? rb_case_resolve(words, why) : s;
}

/* What a result may ask of this computer: a boundary of more elements takes 4 kB for each. */
enum { MOST_OUTER = 20000 };

/* What follows from others, such as the mesh of steady rolling or an option of B, is given as well
 * where it is another one: hence more rounds than one.  What follows may even be refused where
 * what was given was not, as are so few elements on the mesh that follows. */
rb_status rb_certificate_inputs(const rb_certificate *c, const json_t *root, rb_case *words,
                                rb_message *why)
{
    const json_t *inputs = json_object_get(root, "inputs");
    json_t *now = rb_report_json_inputs(words), *value;
    rb_status s = now ? RB_OK : RB_ENOMEM;
    const char *key;
    rb_message reason = {.text = ""};

    for (int round = 0; round < 3 && s != RB_ENOMEM && (s != RB_OK || !json_equal(now, inputs));
         round++) {
        s = set_inputs(root, now, round == 0, words, &reason);
        json_decref(now);
        now = rb_report_json_inputs(words);
        if (!now)
            s = RB_ENOMEM;
    }
    if (s != RB_OK && s != RB_ENOMEM)
        s = rb_fail(why, RB_EFORMAT, "%s: cannot be checked: inputs: %s", c->name, reason.text);
    json_object_foreach(now, key, value)
    {
        if (s == RB_OK && !json_equal(value, json_object_get(inputs, key)))
            s = rb_fail(why, RB_EFORMAT,
                        "%s: cannot be checked: '%s' of inputs cannot be built again", c->name,
                        key);
    }
    if (s == RB_OK && !json_equal(now, inputs))
        s = rb_certificate_refuse(c, "inputs have other names", why);
    json_decref(now);
    if (s == RB_OK && rb_case_resolved(words)->rc.outer_elements > MOST_OUTER)
        s = rb_fail(why, RB_EFORMAT,
                    "%s: cannot be checked: %d --outer-elements take too much memory, at most %d",
                    c->name, rb_case_resolved(words)->rc.outer_elements, (int)MOST_OUTER);
    return s;
}

rb_status rb_certificate_move_inputs(rb_certificate *c, const json_t *root, const rb_case *words,
                                     rb_case **other, rb_message *why)
{
    static const char *const names[] = {"load", "half-width", "approach", "max-pressure"};
    const json_t *inputs = json_object_get(root, "inputs");
    char text[40];
    rb_status s = RB_OK;

    *other = rb_case_copy(words);
    if (!*other)
        return RB_ENOMEM;
    for (size_t k = 0; k < sizeof names / sizeof *names && s == RB_OK; k++) {
        const double x = rb_certificate_member(inputs, names[k]);
        if (isnan(x))
            continue;
        rb_format(text, sizeof text, "%.17g", rb_certificate_moved(c, x));
        s = rb_case_set(*other, names[k], text, RB_GIVEN_ARGUMENT, why);
        if (s == RB_OK)
            s = rb_case_resolve(*other, why);
    }
    return s;
}
