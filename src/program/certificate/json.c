/* The certificate of a result in JSON. */
#include "program/certificate/internal.h"

#include <math.h>
#include <string.h>

/* ---- What can be checked ----------------------------------------------------------- */

rb_status rb_certificate_head(const char *name, const json_t *root, const char *const *known,
                              rb_message *why)
{
    const json_t *inputs = json_object_get(root, "inputs");
    const json_t *summary = json_object_get(root, "summary");
    const char *key;
    json_t *value;

    if (strcmp(rb_certificate_word(root, "schema"), "rollbem/1") != 0)
        return rb_certificate_refuse(name, "not a result of schema rollbem/1", why);
    json_object_foreach((json_t *)root, key, value)
    {
        size_t k = 0;
        while (known[k] && strcmp(key, known[k]) != 0)
            k++;
        if (!known[k])
            return rb_fail(why, RB_EFORMAT,
                           "%s: cannot be checked: results with '%s' (only single cases, "
                           "histories, stress and cracks without error bars can be)",
                           name, key);
    }
    if (!json_is_object(inputs) || !json_is_object(summary) ||
        !json_is_object(json_object_get(root, "table")))
        return rb_certificate_refuse(name,
                                     "inputs, summary or table is missing (only single cases, "
                                     "histories, stress and cracks without error bars can be)",
                                     why);
    if (json_is_true(json_object_get(inputs, "error")) || json_object_get(summary, "errors") ||
        json_is_number(json_object_get(inputs, "accuracy")))
        return rb_certificate_refuse(name, "error bars take solutions on other meshes", why);
    if (strcmp(rb_certificate_word(inputs, "units"), "mm") != 0 ||
        strcmp(rb_certificate_word(json_object_get(root, "units"), "system"), "mm") != 0)
        return rb_certificate_refuse(name, "units other than mm, N, MPa", why);
    if (strcmp(rb_certificate_word(summary, "status"), "solved") != 0)
        return rb_certificate_refuse(name, "its status is not solved", why);
    if (strcmp(rb_certificate_word(root, "version"), RB_VERSION) != 0)
        return rb_certificate_refuse(name, "it is of another version of rollbem", why);
    return RB_OK;
}

/* Results of `rollbem` itself. */
static rb_status check_kind(const char *name, const json_t *root, rb_message *why)
{
    static const char *const known[] = {"schema",
                                        "version",
                                        "command",
                                        "conventions",
                                        "notes",
                                        "units",
                                        "input_hash",
                                        "inputs",
                                        "summary",
                                        "table",
                                        "history",
                                        "depth",
                                        "maxima",
                                        "grid",
                                        "points",
                                        "shakedown",
                                        "derivatives",
                                        "smooth_derivatives",
                                        "without_derivatives",
                                        "derivatives_over_x",
                                        "derivatives_are",
                                        "derivatives_of",
                                        "own_of_b",
                                        "tolerances",
                                        "uncertain_inputs",
                                        NULL};
    const json_t *history = json_object_get(root, "history");
    const json_t *inputs = json_object_get(root, "inputs");
    const rb_status s = rb_certificate_head(name, root, known, why);

    if (s != RB_OK)
        return s;
    const int has_steps = strcmp(rb_certificate_word(inputs, "formulation"), "transient") == 0 ||
                          rb_certificate_word(inputs, "history")[0] ||
                          rb_certificate_member(inputs, "increments") > 1.0;
    if (has_steps != json_is_object(history))
        return rb_certificate_refuse(name, "its inputs and its history do not belong together",
                                     why);
    if (has_steps && !json_is_object(json_object_get(history, "states")))
        return rb_certificate_refuse(
            name,
            json_object_get(root, "maxima")
                ? "its last state depends on the steps before it, which `rollbem stress` does not "
                  "print: check the contact alone, by the same case without `stress`, with --json "
                  "--states"
                : "its last state depends on the steps before it: take --states",
            why);
    return RB_OK;
}

/* ---- The case again ---------------------------------------------------------------- */

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
                  rb_certificate_number(json_array_get(value, k)));
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

/* Sets what differs from `now`. */
static rb_status set_inputs(const json_t *root, const json_t *now, rb_case *words, rb_message *why)
{
    const json_t *inputs = json_object_get(root, "inputs");
    rb_status s = RB_OK;
    const char *key;
    json_t *value;
    char text[4200];

    json_object_foreach((json_t *)inputs, key, value)
    {
        if (s != RB_OK || json_is_null(value) || is_copied(root, key) ||
            (json_equal(value, json_object_get(now, key)) && !is_own_of_b(root, key)))
            continue;
        option_text(value, text, sizeof text);
        s = rb_case_set(words, key, text, RB_GIVEN_ARGUMENT, why);
    }
    return s == RB_OK ? rb_case_resolve(words, why) : s;
}

/* What follows from others, such as the mesh of
 * steady rolling, is given as well where it is another one: hence the second round. */
rb_status rb_certificate_rebuild_case(const char *name, const json_t *root, rb_case *words,
                                      rb_message *why)
{
    const json_t *inputs = json_object_get(root, "inputs");
    json_t *now = rb_report_json_inputs(words), *value;
    rb_status s = now ? RB_OK : RB_ENOMEM;
    const char *key;
    rb_message reason = {""};

    for (int round = 0; round < 2 && s == RB_OK && !json_equal(now, inputs); round++) {
        s = set_inputs(root, now, words, &reason);
        json_decref(now);
        now = rb_report_json_inputs(words);
        if (s == RB_OK && !now)
            s = RB_ENOMEM;
    }
    if (s != RB_OK)
        s = rb_fail(why, s == RB_ENOMEM ? s : RB_EFORMAT, "%s: cannot be checked: inputs: %s", name,
                    reason.text);
    json_object_foreach(now, key, value)
    {
        if (s == RB_OK && !json_equal(value, json_object_get(inputs, key)))
            s = rb_fail(why, RB_EFORMAT,
                        "%s: cannot be checked: '%s' of inputs cannot be built again", name, key);
    }
    if (s == RB_OK && !json_equal(now, inputs))
        s = rb_fail(why, RB_EFORMAT, "%s: cannot be checked: inputs have other names", name);
    json_decref(now);
    return s;
}

rb_status rb_certificate_hash(rb_certificate *c, const json_t *root, json_t *now)
{
    if (!now)
        return RB_ENOMEM;
    if (!json_equal(now, json_object_get(root, "input_hash")))
        rb_certificate_violated(
            c, "inputs, or a file that they name, are not those of the result (input_hash)");
    json_decref(now);
    return RB_OK;
}

/* Two texts in which numbers may differ by one in their second digit: they are rounded. */
static int is_same_note(const char *a, const char *b)
{
    while (*a && *b) {
        char *end_a, *end_b;
        const double x = rb_read_number(a, &end_a), y = rb_read_number(b, &end_b);
        if (end_a > a && end_b > b && isfinite(x) && isfinite(y)) { /* not "infinite" */
            if (!(fabs(x - y) <= 0.1 * fmax(fabs(x), fabs(y))))
                return 0;
            a = end_a;
            b = end_b;
        } else if (*a++ != *b++)
            return 0;
    }
    return *a == *b;
}

/* Texts that follow from the case and from what was computed again. */
static rb_status compare_texts(rb_certificate *c, const json_t *root,
                               const rb_resolved_case *resolved)
{
    json_t *again = rb_report_json_start(""), *units = rb_report_json_units(RB_UNITS_MM);
    const rb_rolling_note_list found = rb_rolling_find_notes(&resolved->rc, &c->again);
    json_t *notes = rb_report_json_notes(&found);
    const json_t *printed = json_object_get(root, "notes");
    const rb_status s = again && units && notes ? RB_OK : RB_ENOMEM;
    size_t same = 0;

    if (s == RB_OK &&
        !json_equal(json_object_get(again, "conventions"), json_object_get(root, "conventions")))
        rb_certificate_violated(c, "conventions are not those of rollbem");
    if (s == RB_OK && !json_equal(units, json_object_get(root, "units")))
        rb_certificate_violated(c, "units are not mm, N, MPa");
    for (size_t k = 0; k < json_array_size(notes) && s == RB_OK; k++) {
        const char *text = json_string_value(json_array_get(printed, k));
        same += text && is_same_note(text, json_string_value(json_array_get(notes, k)));
    }
    if (s == RB_OK && printed &&
        (same != json_array_size(notes) || same != json_array_size(printed)))
        rb_certificate_violated(c, "notes are not those of this result");
    json_decref(again);
    json_decref(units);
    json_decref(notes);
    return s;
}

rb_status rb_certificate_check(FILE *out, const char *name, const json_t *root, rb_case *words,
                               rb_certificate_outcome *found, rb_message *why)
{
    rb_certificate c = {.out = out,
                        .name = name,
                        .found = found,
                        .summary = json_object_get(root, "summary"),
                        .table = json_object_get(root, "table")};
    const json_t *history = json_object_get(root, "history");
    const int n = (int)json_array_size(json_object_get(c.table, "x_mm"));
    rb_rolling_states states = {0};
    rb_rolling_history again = {0};

    memset(found, 0, sizeof *found);
    rb_status s = check_kind(name, root, why);
    if (s == RB_OK && n < 3)
        s = rb_certificate_refuse(name, "its table has no elements", why);
    if (s == RB_OK)
        s = rb_certificate_rebuild_case(name, root, words, why);
    if (s == RB_OK) /* also of what the answer does not depend on */
        s = rb_certificate_hash(&c, root, rb_report_json_input_hash(words));
    if (s == RB_OK && history)
        s = rb_certificate_follow(&c, history, rb_case_resolved(words), n, &states, &again, why);
    else if (s == RB_OK)
        s = rb_certificate_rebuild(&c, rb_case_resolved(words), n, why);
    if (s == RB_OK)
        s = rb_certificate_assess(&c, rb_certificate_member(c.summary, "residual"), why);
    if (s == RB_OK)
        s = compare_texts(&c, root, rb_case_resolved(words));
    if (s == RB_OK && history)
        s = rb_certificate_compare_history(&c, history, &again);
    if (s == RB_OK && json_object_get(root, "maxima"))
        s = rb_certificate_stress(&c, root, why);
    if (s == RB_OK)
        s = history ? rb_certificate_step_derivatives(&c, root, words, &states, &again, why)
                    : rb_certificate_derivatives(&c, root, words, why);
    rb_rolling_states_free(&states);
    rb_rolling_history_free(&again);
    return rb_certificate_end(&c, s, why);
}
