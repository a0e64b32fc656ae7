/* The inputs of a case as JSON: every value used, defaults included; null where a column
 * of the history is used instead. */
#include "program/report/internal.h"
#include "rolling/case/case.h"

#include <inttypes.h>
#include <jansson.h>
#include <stdlib.h>

json_t *rb_report_json_option(const rb_option *o, const void *values, rb_units units)
{
    char buffer[64];
    const char *place = (const char *)values + o->offset;
    switch (o->kind) {
    case RB_OPTION_NUMBER: {
        const double v = *(const double *)(const void *)place;
        const rb_numbers *list = (const void *)((const char *)values + o->list);
        if (o->list && list->n > 1) {
            rb_numbers shown = *list;
            for (int i = 0; i < list->n; i++)
                shown.value[i] = rb_unit_shown(units, o->unit, list->value[i]);
            return rb_report_json_numbers(shown.n, shown.value);
        }
        return o->word && v == o->word_value ? json_string(o->word)
               : rb_option_is_length(o, values)
                   ? rb_report_json_text(rb_option_text(o, values, buffer))
                   : rb_report_json_number(rb_unit_shown(units, o->unit, v));
    }
    case RB_OPTION_INTEGER:
        return json_integer(*(const int *)(const void *)place);
    case RB_OPTION_FLAG:
        return json_boolean(*(const int *)(const void *)place);
    default:
        return rb_report_json_text(rb_option_text(o, values, buffer));
    }
}

void rb_report_json_options(json_t **inputs, int n, const rb_option *options, const void *values,
                            rb_units units)
{
    for (const rb_option *o = options; o < options + n; o++)
        if (o->kind != RB_OPTION_GROUP)
            rb_report_json_set(inputs, o->name, rb_report_json_option(o, values, units));
}

json_t *rb_report_json_inputs(const rb_case *c)
{
    int n;
    const rb_option *o = rb_case_describe(&n);
    const rb_resolved_case *resolved = rb_case_resolved(c);
    json_t *inputs = json_object();
    for (int i = 0; i < n; i++)
        if (o[i].kind != RB_OPTION_GROUP)
            rb_report_json_set(&inputs, o[i].name,
                               rb_case_is_replaced(c, &o[i])
                                   ? json_null()
                                   : rb_report_json_option(&o[i], resolved, resolved->units));
    if (rb_case_crack_of(c))
        rb_report_json_options(&inputs, rb_case_crack_options_n, rb_case_crack_options,
                               rb_case_crack_of(c), resolved->units);
    return inputs;
}

/* ---- Hash -------------------------------------------------------------------------- */

static int add_text(const char *text, size_t size, void *hash)
{
    *(uint64_t *)hash = rb_hash(*(uint64_t *)hash, text, size);
    return 0;
}

rb_status rb_report_input_hash(const rb_case *c, uint64_t *hash, rb_message *why)
{
    json_t *inputs = rb_report_json_inputs(c);
    *hash = RB_HASH_START;
    /* json_dumps loses pieces where its text cannot grow */
    const int failed = json_dump_callback(inputs, add_text, hash, JSON_COMPACT) != 0;
    json_decref(inputs);
    if (failed)
        return rb_fail(why, RB_ENOMEM, "out of memory");
    int n;
    const rb_option *o = rb_case_describe(&n);
    for (int i = 0; i < n; i++) {
        const char *path = rb_option_path(&o[i], rb_case_resolved(c));
        char *text;
        size_t size;
        if (!path || o[i].file != RB_FILE_READ)
            continue;
        const rb_status s = rb_case_read_input(c, path, &text, &size, why);
        if (s != RB_OK)
            return s;
        *hash = rb_hash(*hash, text, size);
        free(text);
    }
    return RB_OK;
}

json_t *rb_report_json_input_hash(const rb_case *c)
{
    char text[17];
    uint64_t hash;
    const rb_status s = rb_report_input_hash(c, &hash, NULL);
    if (s != RB_OK)
        return s == RB_ENOMEM ? NULL : json_null();
    snprintf(text, sizeof text, "%016" PRIx64, hash);
    return json_string(text);
}
