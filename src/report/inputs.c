/* The inputs of a case as JSON: every value used, defaults included; null where a column
 * of the history is used instead. */
#include "report/internal.h"
#include "rollbem/case.h"

#include <jansson.h>

static json_t *input(const rb_option *o, const void *values, rb_units units)
{
    char room[64];
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
        return o->word && v == o->word_value
                   ? json_string(o->word)
                   : rb_report_json_number(rb_unit_shown(units, o->unit, v));
    }
    case RB_OPTION_INTEGER:
        return json_integer(*(const int *)(const void *)place);
    case RB_OPTION_FLAG:
        return json_boolean(*(const int *)(const void *)place);
    default:
        return rb_report_json_text(rb_option_text(o, values, room));
    }
}

json_t *rb_report_json_inputs(const rb_case *c)
{
    int n;
    const rb_option *o = rb_case_describe(&n);
    const rb_settled_case *settled = rb_case_settled(c);
    json_t *inputs = json_object();
    for (int i = 0; i < n; i++)
        if (o[i].kind != RB_OPTION_GROUP)
            rb_report_json_set(&inputs, o[i].name,
                               rb_case_is_replaced(c, &o[i])
                                   ? json_null()
                                   : input(&o[i], settled, settled->units));
    return inputs;
}
