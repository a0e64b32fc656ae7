/* Solutions as JSON: schema rollbem/1. */
#include "report/internal.h"
#include "rollbem/blas.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

json_t *rb_report_json_number(double x)
{
    return isfinite(x) ? json_real(x) : json_null();
}

void rb_report_json_set(json_t **object, const char *name, json_t *value)
{
    if (json_object_set_new(*object, name, value) == 0)
        return;
    json_decref(*object);
    *object = NULL;
}

void rb_report_json_append(json_t **list, json_t *value)
{
    if (json_array_append_new(*list, value) == 0)
        return;
    json_decref(*list);
    *list = NULL;
}

json_t *rb_report_json_text(const char *text)
{
    const size_t size = 4 * strlen(text) + 1;
    char *printable = malloc(size);
    json_t *value = printable ? json_string(rb_printable(text, printable, size)) : NULL;
    free(printable);
    return value;
}

json_t *rb_report_json_numbers(int n, const double *x)
{
    json_t *list = json_array();
    for (int i = 0; i < n; i++)
        rb_report_json_append(&list, rb_report_json_number(x[i]));
    return list;
}

static json_t *whole_numbers(int n, const int *x)
{
    json_t *list = json_array();
    for (int i = 0; i < n; i++)
        rb_report_json_append(&list, json_integer(x[i]));
    return list;
}

static json_t *conventions_text(void)
{
    char text[800] = "";
    for (const char *const *line = rb_report_conventions; *line; line++) {
        strncat(text, *line, sizeof text - strlen(text) - 1);
        if (line[1])
            strncat(text, ". ", sizeof text - strlen(text) - 1);
    }
    return json_string(text);
}

json_t *rb_report_json_start(const char *command)
{
    json_t *root = json_object();
    rb_report_json_set(&root, "schema", json_string("rollbem/1"));
    rb_report_json_set(&root, "version", json_string(RB_VERSION));
    rb_report_json_set(&root, "command", rb_report_json_text(command));
    rb_report_json_set(&root, "conventions", conventions_text());
    return root;
}

/* ---- Summary ---------------------------------------------------------------------- */

typedef struct {
    const char *name;
    size_t offset;
    int whole;
} field;

#define NUMBER(name, member)                                                             \
    {                                                                                    \
        name, offsetof(rb_rolling_solution, member), 0                                   \
    }
#define WHOLE(name, member)                                                              \
    {                                                                                    \
        name, offsetof(rb_rolling_solution, member), 1                                   \
    }

static const field results[] = {
    WHOLE("iterations", iterations),
    NUMBER("residual", residual),
    NUMBER("residual_gap", residual_gap),
    NUMBER("residual_slip", residual_slip),
    NUMBER("residual_friction", residual_friction),
    NUMBER("load_error", load_error),
    NUMBER("support_balance", support_balance),
    NUMBER("normal_load", normal_load),
    NUMBER("tangential_load", tangential_load),
    NUMBER("force_ratio", force_ratio),
    NUMBER("approach", approach),
    NUMBER("tangential_shift", tangential_shift),
    NUMBER("creepage", creepage),
    NUMBER("creep_ratio", creep_ratio),
    NUMBER("free_creepage", free_creepage),
    NUMBER("hertz_half_width", hertz_half_width),
    NUMBER("half_width", half_width),
    NUMBER("contact_from", contact_from),
    NUMBER("contact_to", contact_to),
    NUMBER("max_pressure", max_pressure),
    WHOLE("contact", contact),
    WHOLE("stick", stick),
    WHOLE("slip", slipping),
    NUMBER("stick_from", stick_from),
    NUMBER("stick_to", stick_to),
    NUMBER("stick_length", stick_length),
    WHOLE("slip_violations", slip_violations),
    NUMBER("dissipation", dissipation),
};

static const field seconds[] = {
    NUMBER("assembly", seconds_assembly), NUMBER("factor", seconds_factor),
    NUMBER("condense", seconds_condense), NUMBER("lcp", seconds_lcp),
    NUMBER("total", seconds_total),
};

#undef NUMBER
#undef WHOLE
#define NUMBER(name, member)                                                             \
    {                                                                                    \
        name, offsetof(rb_rolling_patch, member), 0                                      \
    }
#define WHOLE(name, member)                                                              \
    {                                                                                    \
        name, offsetof(rb_rolling_patch, member), 1                                      \
    }

static const field of_patch[] = {
    NUMBER("from", from),
    NUMBER("to", to),
    NUMBER("normal_load", normal_load),
    NUMBER("tangential_load", tangential_load),
    NUMBER("max_pressure", max_pressure),
    NUMBER("peak", peak),
    WHOLE("contact", contact),
    WHOLE("stick", stick),
};

/* owner: the struct that the offsets belong to. */
static void set_fields(json_t **object, const void *owner, const field *fields, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const void *place = (const char *)owner + fields[i].offset;
        json_t *value = fields[i].whole ? json_integer(*(const int *)place)
                                        : rb_report_json_number(*(const double *)place);
        rb_report_json_set(object, fields[i].name, value);
    }
}

static json_t *patches(const rb_rolling_solution *s)
{
    json_t *list = json_array();
    for (int k = 0; k < s->patches; k++) {
        json_t *patch = json_object();
        set_fields(&patch, &s->patch[k], of_patch, sizeof of_patch / sizeof of_patch[0]);
        rb_report_json_append(&list, patch);
    }
    return list;
}

json_t *rb_report_json_summary(const rb_rolling_solution *s)
{
    json_t *summary = json_object(), *times = json_object();
    rb_report_json_set(&summary, "status", json_string(rb_status_text(s->status)));
    rb_report_json_set(&summary, "formulation",
                       json_string(rb_report_formulation(s->formulation)));
    rb_report_json_set(&summary, "solver", json_string(rb_report_solver(s)));
    rb_report_json_set(&summary, "flexibility",
                       json_string(s->large ? "transforms" : "matrix"));
    rb_report_json_set(&summary, "lcp_form",
                       json_string(rb_report_lcp_form(s->lcp_form)));
    set_fields(&summary, s, results, sizeof results / sizeof results[0]);
    if (s->patches > 1)
        rb_report_json_set(&summary, "patches", patches(s));
    if (s->equal_instead)
        rb_report_json_set(&summary, "mesh", json_string("uniform"));
    if (s->edges_bounded)
        rb_report_json_set(&summary, "edges", json_string("bounded"));
    rb_report_json_set(&summary, "datum", rb_report_json_number(s->datum));
    rb_report_json_set(&summary, "boundary_elements", json_integer(s->boundary_elements));
    if (s->boundary_elements > 0)
        rb_report_json_set(&summary, "boundary_matrix",
                           json_string(s->hierarchical ? "hierarchical" : "dense"));
    rb_report_json_set(&summary, "integrals", json_string(rb_bem_vector_name()));
    rb_report_json_set(&summary, "openblas", json_string(rb_blas_core()));
    set_fields(&times, s, seconds, sizeof seconds / sizeof seconds[0]);
    rb_report_json_set(&summary, "seconds", times);
    return summary;
}

static json_t *friction_power(const rb_rolling_solution *s)
{
    double *power = rb_alloc((size_t)s->n, 1);
    if (!power)
        return NULL;
    rb_rolling_friction_power(s, power);
    json_t *list = rb_report_json_numbers(s->n, power);
    free(power);
    return list;
}

json_t *rb_report_json_table(const rb_rolling_solution *s)
{
    json_t *table = json_object();
    for (int j = 0; j < rb_report_column_n; j++) {
        const rb_report_column *c = &rb_report_columns[j];
        rb_report_json_set(&table, c->name,
                           c->whole
                               ? whole_numbers(s->n, rb_report_ints(s, c))
                               : rb_report_json_numbers(s->n, rb_report_doubles(s, c)));
    }
    if (s->formulation != RB_STATIC)
        rb_report_json_set(&table, "friction_power_MPa", friction_power(s));
    return table;
}

void rb_report_json_series(json_t **object, int rows, int columns,
                           const rb_report_series *series)
{
    for (int j = 0; j < columns; j++)
        rb_report_json_set(object, series[j].key ? series[j].key : series[j].name,
                           series[j].x ? rb_report_json_numbers(rows, series[j].x)
                                       : whole_numbers(rows, series[j].k));
}

rb_status rb_report_json_write(FILE *out, json_t *json)
{
    if (!json)
        return RB_ENOMEM;
    const int failed =
        json_dumpf(json, out, JSON_INDENT(1) | JSON_REAL_PRECISION(17)) != 0;
    json_decref(json);
    if (failed && !ferror(out))
        return RB_ENOMEM;
    fputc('\n', out);
    return fflush(out) == 0 && !ferror(out) ? RB_OK : RB_EWRITE;
}
