/* Solutions as JSON: schema rollbem/1. */
#include "program/report/internal.h"
#include "rolling/case/case.h"
#include "base/blas.h"

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

json_t *rb_report_json_lists(int steps, int n, size_t apart, const double *x, const int *whole,
                             const double *by)
{
    json_t *lists = json_array();
    for (int k = 0; k < steps; k++) {
        const size_t from = (size_t)k * apart;
        json_t *list = json_array();
        for (int i = 0; i < n; i++)
            rb_report_json_append(
                &list, whole ? json_integer(whole[from + (size_t)i])
                             : rb_report_json_number(x[from + (size_t)i] / (by ? by[i] : 1.0)));
        rb_report_json_append(&lists, list);
    }
    return lists;
}

json_t *rb_report_json_named(int n, const rb_report_named *number)
{
    json_t *object = json_object();
    for (int k = 0; k < n; k++)
        rb_report_json_set(&object, number[k].name, rb_report_json_number(number[k].x));
    return object;
}

json_t *rb_report_json_start(const char *command)
{
    json_t *root = json_object();
    rb_report_json_set(&root, "schema", json_string("rollbem/1"));
    rb_report_json_set(&root, "version", json_string(RB_VERSION));
    rb_report_json_set(&root, "command", rb_report_json_text(command));
    char text[800] = "";
    for (const char *const *line = rb_report_conventions; *line; line++) {
        strncat(text, *line, sizeof text - strlen(text) - 1);
        if (line[1])
            strncat(text, ". ", sizeof text - strlen(text) - 1);
    }
    rb_report_json_set(&root, "conventions", json_string(text));
    return root;
}

json_t *rb_report_json_units(rb_units units)
{
    static const struct {
        const char *quantity, *unit;
    } all[] = {{"length", "mm"}, {"stress", "MPa"}, {"load", "N/mm"},
               {"moment", "N"},  {"speed", "mm/s"}, {"compliance", "mm/MPa"}};
    json_t *object = json_object();
    rb_report_json_set(&object, "system", json_string(rb_case_word("units", (int)units)));
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        rb_report_json_set(&object, all[k].quantity, json_string(rb_unit_name(units, all[k].unit)));
    return object;
}

/* ---- Summary ---------------------------------------------------------------------- */

static json_t *json_value(const rb_rolling_result *r, double x)
{
    return r->kind == RB_RESULT_WHOLE ? json_integer((json_int_t)x) : rb_report_json_number(x);
}

/* Those of time, or all the others. */
static void set_results(json_t **object, const rb_rolling_results *table, const void *owner,
                        int seconds)
{
    for (int k = 0; k < table->n; k++) {
        const rb_rolling_result *r = &table->row[k];
        const double value = rb_rolling_number(r, owner);
        if ((r->kind == RB_RESULT_SECONDS) == seconds &&
            (r->condition == RB_FOR_ALL || !isnan(value)))
            rb_report_json_set(object, r->name, json_value(r, value));
    }
}

json_t *rb_report_json_summary(const rb_rolling_solution *s)
{
    json_t *summary = json_object(), *times = json_object();
    rb_report_json_set(&summary, "status", json_string(rb_status_text(s->status)));
    rb_report_json_set(&summary, "formulation",
                       json_string(rb_case_word("formulation", (int)s->formulation)));
    rb_report_json_set(&summary, "solver", json_string(rb_report_solver(s)));
    rb_report_json_set(&summary, "flexibility", json_string(s->large ? "transforms" : "matrix"));
    rb_report_json_set(&summary, "lcp_form",
                       json_string(rb_case_word("lcp-form", (int)s->lcp_form)));
    set_results(&summary, &rb_rolling_solution_scalars, s, 0);
    if (s->patches > 1) {
        json_t *patches = json_array();
        for (int k = 0; k < s->patches; k++) {
            json_t *patch = json_object();
            set_results(&patch, &rb_rolling_patch_scalars, &s->patch[k], 0);
            rb_report_json_append(&patches, patch);
        }
        rb_report_json_set(&summary, "patches", patches);
    }
    if (s->equal_instead)
        rb_report_json_set(&summary, "mesh", json_string("uniform"));
    if (s->edges_bounded)
        rb_report_json_set(&summary, "edges", json_string("bounded"));
    if (s->boundary_elements > 0)
        rb_report_json_set(&summary, "boundary_matrix",
                           json_string(s->hierarchical ? "hierarchical" : "dense"));
    if (s->proof.asked)
        rb_report_json_set(&summary, "proof", rb_report_json_contact_proof(&s->proof));
    rb_report_json_set(&summary, "integrals", json_string(rb_bem_vector_name()));
    rb_report_json_set(&summary, "openblas", json_string(rb_blas_core()));
    set_results(&times, &rb_rolling_solution_scalars, s, 1);
    rb_report_json_set(&summary, "seconds", times);
    return summary;
}

void rb_report_json_columns(json_t **object, int rows, const rb_report_columns *c, int headed)
{
    char heading[RB_ROLLING_HEADING];
    for (int j = 0; j < c->columns->n; j++) {
        const rb_rolling_result *r = &c->columns->row[j];
        if (!rb_report_shows(c, r))
            continue;
        json_t *list = json_array();
        for (int i = 0; i < rows; i++)
            rb_report_json_append(&list, json_value(r, rb_report_entry(c, r, i)));
        rb_report_json_set(object, headed ? rb_rolling_heading(r, c->units, heading) : r->name,
                           list);
    }
}

json_t *rb_report_json_table_columns(const rb_rolling_solution *s)
{
    const rb_report_columns columns = {
        .columns = &rb_rolling_solution_columns, .owner = s, .units = s->units};
    json_t *table = json_object();
    rb_report_json_columns(&table, s->n, &columns, 1);
    return table;
}

json_t *rb_report_json_table(const rb_rolling_solution *s)
{
    json_t *table = rb_report_json_table_columns(s);
    if (s->formulation == RB_STATIC)
        return table;
    char name[40];
    double *power = rb_alloc((size_t)s->n, 1);
    if (power)
        rb_rolling_friction_power(s, power);
    snprintf(name, sizeof name, "friction_power_%s", rb_unit_name(s->units, "MPa"));
    rb_report_json_set(&table, name, power ? rb_report_json_numbers(s->n, power) : NULL);
    free(power);
    return table;
}

static void begin_line(FILE *out, int depth)
{
    fputc('\n', out);
    for (int i = 0; i < depth; i++)
        fputc(' ', out);
}

/* As jansson writes it, each member in a line of its own; but numbers have as many digits as in
 * tables, 0.3 for its 0.29999999999999999.  0: written, or the file has an error; otherwise memory
 * is short. */
static int write_value(const json_t *value, int depth, FILE *out)
{
    if (json_is_real(value)) {
        char text[RB_NUMBER_TEXT];
        rb_number_text(json_real_value(value), text);
        fputs(text, out);
        if (!strpbrk(text, ".e"))
            fputs(".0", out);
        return 0;
    }
    const int is_object = json_is_object(value), is_array = json_is_array(value);
    if (!is_object && !is_array)
        return json_dumpf(value, out, JSON_ENCODE_ANY);
    const size_t n = is_object ? json_object_size(value) : json_array_size(value);
    void *member = is_object ? json_object_iter((json_t *)value) : NULL;
    int failed = 0;
    fputc(is_object ? '{' : '[', out);
    for (size_t i = 0; i < n && !failed; i++) {
        begin_line(out, depth + 1);
        if (is_object) {
            json_t *key = json_string(json_object_iter_key(member));
            failed = !key || json_dumpf(key, out, JSON_ENCODE_ANY);
            json_decref(key);
            fputs(": ", out);
        }
        const json_t *next = is_object ? json_object_iter_value(member) : json_array_get(value, i);
        failed = failed || write_value(next, depth + 1, out);
        if (i + 1 < n)
            fputc(',', out);
        if (is_object)
            member = json_object_iter_next((json_t *)value, member);
    }
    if (n > 0)
        begin_line(out, depth);
    fputc(is_object ? '}' : ']', out);
    return failed;
}

rb_status rb_report_json_write(FILE *out, json_t *json)
{
    if (!json)
        return RB_ENOMEM;
    const int failed = write_value(json, 0, out);
    json_decref(json);
    if (failed && !ferror(out))
        return RB_ENOMEM;
    fputc('\n', out);
    return fflush(out) == 0 && !ferror(out) ? RB_OK : RB_EWRITE;
}
