/* The JSON Schema of what --json prints, from the tables that print it. */
#include "program/report/internal.h"
#include "rolling/case/case.h"

#include <jansson.h>

static json_t *typed(const char *type, const char *description)
{
    json_t *schema = json_object();
    rb_report_json_set(&schema, "type", json_string(type));
    if (description)
        rb_report_json_set(&schema, "description", rb_report_json_text(description));
    return schema;
}

/* A number, or null where there is none. */
static json_t *number(const char *description)
{
    json_t *schema = typed("number", description);
    rb_report_json_set(&schema, "type", json_pack("[s, s]", "number", "null"));
    return schema;
}

static json_t *list_of(json_t *items, const char *description)
{
    json_t *schema = typed("array", description);
    rb_report_json_set(&schema, "items", items);
    return schema;
}

static json_t *object_of(json_t *properties, const char *description)
{
    json_t *schema = typed("object", description);
    rb_report_json_set(&schema, "properties", properties);
    return schema;
}

static json_t *with_required(json_t *schema, json_t *required)
{
    rb_report_json_set(&schema, "required", required);
    return schema;
}

static json_t *result(const rb_rolling_result *r)
{
    char text[300];
    snprintf(text, sizeof text, "%s%s%s%s", r->meaning, r->unit ? " [" : "", r->unit ? r->unit : "",
             r->unit ? "]" : "");
    return r->kind == RB_RESULT_WHOLE ? typed("integer", text) : number(text);
}

/* Those of time, or all the others; as numbers, or as lists under their headings. */
static json_t *results(const rb_rolling_results *table, int seconds)
{
    json_t *properties = json_object();
    for (int k = 0; k < table->n; k++)
        if ((table->row[k].kind == RB_RESULT_SECONDS) == seconds)
            rb_report_json_set(&properties, table->row[k].name, result(&table->row[k]));
    return properties;
}

/* Of those that every case has. */
static json_t *names(const rb_rolling_results *table)
{
    json_t *list = json_array();
    for (int k = 0; k < table->n; k++)
        if (table->row[k].kind != RB_RESULT_SECONDS && table->row[k].condition == RB_FOR_ALL)
            rb_report_json_append(&list, json_string(table->row[k].name));
    return list;
}

/* Lists by name; of a table with headings, by the name and any unit behind it. */
static json_t *columns(const rb_rolling_results *table, int headed, const char *about)
{
    json_t *properties = json_object();
    char name[80];
    for (int k = 0; k < table->n; k++) {
        const rb_rolling_result *r = &table->row[k];
        snprintf(name, sizeof name, headed ? "^%s(_[^_]+)?$" : "^%s$",
                 headed && r->symbol ? r->symbol : r->name);
        rb_report_json_set(&properties, name, list_of(result(r), r->meaning));
    }
    json_t *schema = typed("object", about);
    rb_report_json_set(&schema, "patternProperties", properties);
    return schema;
}

static json_t *summary(void)
{
    static const char *const words[] = {"status", "formulation", "solver", "lcp_form"};
    json_t *properties = results(&rb_rolling_solution_scalars, 0);
    json_t *required = names(&rb_rolling_solution_scalars);
    for (size_t k = 0; k < sizeof words / sizeof *words; k++) {
        rb_report_json_set(&properties, words[k], typed("string", NULL));
        rb_report_json_append(&required, json_string(words[k]));
    }
    rb_report_json_set(&properties, "seconds",
                       object_of(results(&rb_rolling_solution_scalars, 1), "time spent"));
    rb_report_json_set(&properties, "patches",
                       list_of(with_required(object_of(results(&rb_rolling_patch_scalars, 0), NULL),
                                             names(&rb_rolling_patch_scalars)),
                               "the parts of the contact, where it has several"));
    rb_report_json_set(&properties, "errors",
                       object_of(results(&rb_rolling_solution_scalars, 0),
                                 "estimated errors of the discretisation"));
    rb_report_json_set(&properties, "proof",
                       typed("object", "of --prove: what is proved of the zones and tractions"));
    return with_required(object_of(properties, "the numbers of the solution"), required);
}

static json_t *inputs(void)
{
    int n;
    const rb_option *o = rb_case_describe(&n);
    json_t *properties = json_object();
    for (int i = 0; i < n; i++) {
        const int numeric = o[i].kind == RB_OPTION_NUMBER;
        if (o[i].kind == RB_OPTION_GROUP)
            continue;
        json_t *schema = typed(o[i].kind == RB_OPTION_FLAG      ? "boolean"
                               : o[i].kind == RB_OPTION_INTEGER ? "integer"
                                                                : "string",
                               o[i].help);
        if (numeric)
            rb_report_json_set(&schema, "type",
                               json_pack("[s, s, s, s]", "number", "null", "string", "array"));
        rb_report_json_set(&properties, o[i].name, schema);
    }
    return object_of(properties, "every value used, defaults included");
}

json_t *rb_report_json_schema(void)
{
    json_t *of = json_object();
    rb_report_json_set(&of, "schema", json_pack("{s:s}", "const", "rollbem/1"));
    rb_report_json_set(&of, "version", typed("string", "of the program"));
    rb_report_json_set(&of, "command", typed("string", "the command line"));
    rb_report_json_set(&of, "conventions", typed("string", "signs and zones"));
    rb_report_json_set(&of, "notes",
                       list_of(typed("string", NULL),
                               "notes on how to read the result; of a history: on its last "
                               "state, or the row they name"));
    rb_report_json_set(&of, "units", typed("object", "of the numbers, by quantity"));
    rb_report_json_set(&of, "input_hash",
                       typed("string", "of all inputs and the contents of the files they name"));
    rb_report_json_set(&of, "inputs", inputs());
    rb_report_json_set(&of, "summary", summary());
    rb_report_json_set(&of, "table",
                       columns(&rb_rolling_solution_columns, 1, "an entry per contact element"));
    rb_report_json_set(
        &of, "solutions",
        list_of(typed("object", NULL), "summary and table of each, of --all-solutions"));
    rb_report_json_set(&of, "history",
                       columns(&rb_rolling_history_columns, 0,
                               "an entry per step; states: of --states, a list per step; "
                               "tolerances: standard deviations; derivatives_note: how the "
                               "derivatives must be read; steady_from: the first step from which "
                               "nothing changes to the end of the way; cycle_work [N]: of friction "
                               "in the last cycle, of cycle_rows rows; row_changes: by how much "
                               "row_changed still depends on its steps; jump_row: in which the "
                               "contact jumps to full sliding, from jump_shift, jump_force"));
    json_t *curve = columns(&rb_rolling_curve_columns, 0,
                            "an entry per creepage; tolerances: standard deviations; "
                            "derivatives_note: how many points have none, and why");
    rb_report_json_set(&of, "curve", curve);
    rb_report_json_set(&of, "curves", list_of(json_incref(curve), "of several coefficients"));
    rb_report_json_set(&of, "wear",
                       columns(&rb_rolling_wear_columns, 0,
                               "an entry per step of wear; errors: estimated errors, of --error"));
    rb_report_json_set(&of, "body", typed("string", "whose stress: a or b"));
    rb_report_json_set(&of, "tractions",
                       typed("object", "of --tractions: their totals; largest: of |p|, or of |q| "
                                       "where p is zero; their rows x, p, q, of elements h, zone"));
    rb_report_json_set(&of, "grid",
                       columns(&rb_rolling_stress_scalars, 1, "stress, an entry per point"));
    rb_report_json_set(&of, "points",
                       columns(&rb_rolling_stress_scalars, 1, "the same at given points"));
    rb_report_json_set(
        &of, "depth",
        number("of grid and maxima; null: a grid of 2.5 half-widths, maxima in all of the body"));
    rb_report_json_set(&of, "whole", typed("boolean", "true: the grid is that of the whole wheel"));
    rb_report_json_set(&of, "maxima", typed("object", "largest stresses, their places"));
    rb_report_json_set(&of, "derivatives",
                       typed("object", "of --derivatives: of each result with respect to each "
                                       "input; [left, right] if the sides differ"));
    rb_report_json_set(&of, "smooth_derivatives",
                       typed("object", "of --smooth-derivatives: the same without jumps where an "
                                       "element changes between stick and slip"));
    rb_report_json_set(&of, "without_derivatives",
                       typed("object", "inputs, and results asked for by name, without, and why"));
    rb_report_json_set(&of, "derivatives_over_x",
                       typed("object", "of loads, approach and creepage with respect to the gap "
                                       "and mu of every element, with fixed elements"));
    rb_report_json_set(&of, "derivatives_are", typed("string", "what stays as it is"));
    rb_report_json_set(&of, "tolerances",
                       typed("object", "of --tolerance: standard deviations of results"));
    rb_report_json_set(&of, "derivatives_of", typed("string", "the results that were asked for"));
    rb_report_json_set(&of, "own_of_b",
                       list_of(typed("string", NULL),
                               "options of body B that were given A's value and do not vary "
                               "with A"));
    rb_report_json_set(&of, "uncertain_inputs",
                       typed("object",
                             "of --tolerance: standard deviations of inputs; of curves and "
                             "studies a text where they are per cent of each value"));
    rb_report_json_set(&of, "parameters",
                       typed("object", "of fit: value, interval and correlations of each"));
    rb_report_json_set(&of, "fit", typed("object", "points, fitted curve and its band"));
    rb_report_json_set(&of, "residuals", list_of(number("measured less fitted"), "of fit"));
    rb_report_json_set(&of, "sentences",
                       list_of(typed("string", NULL), "of fit: what the data do not determine"));
    rb_report_json_set(&of, "problems",
                       list_of(typed("object", NULL), "of lcp and friction, one per file"));
    rb_report_json_set(&of, "cases", list_of(typed("object", NULL), "of contact"));
    rb_report_json_set(&of, "steps", list_of(typed("object", NULL), "of example"));

    json_t *schema =
        with_required(object_of(of, "What rollbem prints with --json"),
                      json_pack("[s, s, s, s]", "schema", "version", "command", "conventions"));
    rb_report_json_set(&schema, "$schema",
                       json_string("https://json-schema.org/draft/2020-12/schema"));
    rb_report_json_set(&schema, "title", json_string("rollbem/1"));
    return schema;
}
