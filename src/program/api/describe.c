/* Options, results, words and numbers of a case by their names, as text and numbers. */
#include "analysis/crack/crack_case.h"
#include "program/api/internal.h"

#include <stdio.h>
#include <string.h>

const char *rb_api_written(const char *what, char *text, int size)
{
    snprintf(text, (size_t)size, "%s", what ? what : "");
    return text;
}

/* NULL: there is no such field. */
const char *rb_api_field_of(size_t n, const api_field *of, const char *field, char *text, int size)
{
    for (size_t k = 0; k < n; k++)
        if (strcmp(field, of[k].field) == 0)
            return rb_api_written(of[k].text, text, size);
    return NULL;
}

/* Option k of n, whose defaults stand in `values`; NULL: those of a case. */
static const char *describe_option(int n, const rb_option *all, const void *values, int k,
                                   const char *field, char *text, int size)
{
    static const char *const kinds[] = {
        [RB_OPTION_GROUP] = "group",     [RB_OPTION_NUMBER] = "number",
        [RB_OPTION_INTEGER] = "integer", [RB_OPTION_CHOICE] = "choice",
        [RB_OPTION_FLAG] = "flag",       [RB_OPTION_TEXT] = "text"};
    if (k < 0 || k >= n || size < 1)
        return NULL;
    const rb_option *o = &all[k];
    const int is_group = o->kind == RB_OPTION_GROUP;

    const api_field texts[] = {
        {"name", o->name},        {"section", is_group ? o->name : rb_case_section(o)},
        {"kind", kinds[o->kind]}, {"unit", o->unit},
        {"help", o->help},        {"word", o->word}};
    const struct {
        const char *field;
        double value;
    } numbers[] = {{"from", o->range.from}, {"to", o->range.to}, {"excludes", o->excludes}};

    if (rb_api_field_of(sizeof texts / sizeof *texts, texts, field, text, size))
        return text;
    for (size_t j = 0; j < sizeof numbers / sizeof *numbers; j++)
        if (strcmp(field, numbers[j].field) == 0) {
            rb_format(text, (size_t)size, "%.17g", numbers[j].value);
            return text;
        }
    if (strcmp(field, "choices") == 0) {
        int used = 0;
        text[0] = '\0';
        for (const rb_choice *c = o->choices; c && c->name && used < size; c++)
            used += snprintf(text + used, (size_t)(size - used), "%s%s", used ? " " : "", c->name);
        return text;
    }
    if (strcmp(field, "expected") == 0)
        return is_group ? rb_api_written("", text, size)
                        : rb_option_expected(o, text, (size_t)size);
    if (strcmp(field, "default") == 0 && is_group)
        return rb_api_written("", text, size);
    if (strcmp(field, "default") == 0) {
        rb_case *c = values ? NULL : rb_case_create(RB_CASE_SINGLE);
        char buffer[64];
        if (!values && !c)
            return NULL;
        rb_api_written(o->unset ? o->unset
                                : rb_option_text(o, values ? values : rb_case_resolved(c), buffer),
                       text, size);
        rb_case_free(c);
        return text;
    }
    return NULL;
}

const char *rb_api_option(int k, const char *field, char *text, int size)
{
    int n;
    const rb_option *all = rb_case_describe(&n);
    return describe_option(n, all, NULL, k, field, text, size);
}

const char *rb_api_crack_option(int k, const char *field, char *text, int size)
{
    const rb_case_crack defaults = rb_case_crack_defaults();
    return describe_option(rb_case_crack_options_n, rb_case_crack_options, &defaults, k, field,
                           text, size);
}

const char *rb_api_result(const char *table, int k, const char *field, char *text, int size)
{
    static const char *const kinds[] = {[RB_RESULT_NUMBER] = "number",
                                        [RB_RESULT_WHOLE] = "whole",
                                        [RB_RESULT_SECONDS] = "seconds"};
    const rb_rolling_result_table *t;
    for (int j = 0; (t = rb_case_result_table(j)); j++) {
        if (strcmp(table, t->name) != 0 || k < 0 || k >= t->results->n)
            continue;
        const rb_rolling_result *r = &t->results->row[k];
        const api_field texts[] = {{"name", r->name},
                                   {"unit", r->unit},
                                   {"kind", kinds[r->kind]},
                                   {"meaning", r->meaning}};
        return rb_api_field_of(4, texts, field, text, size);
    }
    return NULL;
}

const char *rb_api_value(const rb_api *a, const char *name, char *text, int size)
{
    const rb_option *o = rb_case_option(name);
    char buffer[64];
    if (!o)
        return NULL;
    const char *value = rb_option_text(o, rb_case_resolved(a->words), buffer);
    double x;
    if (o->kind == RB_OPTION_NUMBER && rb_option_number(value, &x) &&
        rb_case_resolved(a->words)->units != RB_UNITS_MM)
        rb_format(buffer, sizeof buffer, "%.15g", rb_api_shown(a, o->unit, x));
    return rb_api_written(value, text, size);
}

const char *rb_api_unit(const char *system, const char *unit, char *text, int size)
{
    const rb_choice *of = rb_case_option("units")->choices;
    while (of->name && strcmp(of->name, system) != 0)
        of++;
    return of->name ? rb_api_written(rb_unit_name((rb_units)of->value, unit), text, size) : NULL;
}

const char *rb_api_word(const rb_api *a, const char *name)
{
    static const char *const said[API_SAID_N] = {[API_FIT_SENTENCES] = "fit.sentences",
                                                 [API_DESIGN_VARIABLES] = "design.variables",
                                                 [API_DESIGN_CONSTRAINTS] = "design.constraints"};
    const rb_rolling_solution *s = &a->result.solution;
    if (strcmp(name, "status") == 0)
        return rb_status_text(a->status);
    if (strcmp(name, "task.solver") == 0)
        return a->solver;
    if (strcmp(name, "task.proof.reason") == 0)
        return a->proof_reason;
    for (int k = 0; k < API_SAID_N; k++)
        if (strcmp(name, said[k]) == 0)
            return a->said[k];
    if (strcmp(name, "elements") == 0)
        return a->derivatives.n > 0 ? rb_case_derivatives_are(&a->derivatives) : NULL;
    if (s->n == 0)
        return NULL;
    if (strcmp(name, "formulation") == 0)
        return rb_case_word(name, (int)s->formulation);
    if (strcmp(name, "lcp-form") == 0)
        return rb_case_word(name, (int)s->lcp_form);
    if (strcmp(name, "proof.reason") == 0)
        return s->proof.asked ? s->proof.reason : NULL;
    if (strcmp(name, "proof.unique") == 0)
        return s->proof.asked ? s->proof.unique : NULL;
    if (strcmp(name, "solver") == 0)
        return s->solver == RB_SOLVER_CONE ? s->cone_solver : rb_case_word(name, (int)s->solver);
    return NULL;
}

const char *rb_api_note(const rb_api *a, int k, char *text, int size)
{
    const rb_rolling_solution *s = &a->result.solution;
    const int own = a->note.text[0] != '\0'; /* on the last call */
    if (k == 0 && own) {
        snprintf(text, (size_t)size, "%s", a->note.text);
        return text;
    }
    k -= own;
    if ((s->n == 0 && a->rows.rows == 0) || k < 0)
        return NULL;
    rb_rolling_note_list list = a->rows.rows > 0
                                    ? rb_rolling_list_study_notes(&a->rows, a->row)
                                    : rb_case_find_notes(a->words, s, a->result.of_steps);
    if (a->rows.rows > 0 && strcmp(a->row, "point") == 0) /* those of a study are its rows' */
        rb_case_note_materials(a->words, &list);
    const int missing = list.status != RB_OK;
    if (k >= list.n + missing)
        return NULL;
    snprintf(text, (size_t)size, "%s", k < list.n ? list.text[k] : rb_rolling_notes_missing);
    return text;
}

static const char error_[] = "error.";

double rb_api_number(const rb_api *a, const char *name)
{
    const rb_resolved_case *c = rb_case_resolved(a->words);
    const rb_case_result *result = &a->result;
    const rb_contact_proof *proof = &result->solution.proof;
    const rb_rolling_history *history = &result->history;
    /* Of the case, of the last curve or history, of the problem that was handed over. */
    const struct {
        const char *name;
        double value;
        int is_known;
        const char *unit; /* NULL: none */
    } numbers[] = {
        {"carter", rb_rolling_carter_holds(&c->rc), 1, NULL},
        {"radius", c->derived.radius, 1, "mm"},
        {"modulus", c->derived.modulus, 1, "MPa"},
        {"hertz_load", c->derived.load, 1, "N/mm"},
        {"curve.mu", rb_rolling_largest_mu(&c->rc), a->curve.n > 0, NULL},
        {"curve.free_creepage", a->curve.free_creepage, a->curve.n > 0, NULL},
        {"curve.half_width", a->curve.half_width, a->curve.n > 0, "mm"},
        {"history.half_width", history->half_width, history->n > 0, "mm"},
        {"history.steady_from", history->steady_from, history->n > 0 && history->steady_from >= 0,
         NULL},
        {"history.cycle_work", history->cycle_work, history->n > 0, "N"},
        {"history.cycle_rows", history->cycle_rows, history->n > 0, NULL},
        {"history.jump_row", history->rows.jumped, history->rows.jumped > 0, NULL},
        {"history.jump_shift", history->rows.jump_shift, history->rows.jumped > 0, "mm"},
        {"history.jump_force", history->rows.jump_force, history->rows.jumped > 0, "N/mm"},
        {"proof.proved", proof->proved, proof->asked, NULL},
        {"proof.undecided", proof->undecided, proof->proved, NULL},
        {"proof.isolated", proof->isolated, proof->proved, NULL},
        {"proof.bound_p", proof->bound_p, proof->proved, NULL},
        {"proof.bound_q", proof->bound_q, proof->proved, NULL},
        {"proof.stored_within", proof->stored_within, proof->proved, NULL},
        {"proof.nearby", proof->nearby, proof->asked, NULL},
        {"proof.margin", proof->margin, proof->proved, NULL},
        {"proof.norm", proof->norm, proof->asked, NULL},
        {"task.iterations", a->iterations, 1, NULL},
        {"task.residual", a->residual, 1, NULL},
        {"task.scaled_residual", a->scaled_residual, 1, NULL}};
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
        if (strcmp(name, numbers[k].name) == 0)
            return numbers[k].is_known ? rb_api_shown(a, numbers[k].unit, numbers[k].value) : NAN;
    const int is_error = strncmp(name, error_, strlen(error_)) == 0;
    const rb_rolling_result *r = rb_rolling_find_result(&rb_rolling_solution_scalars,
                                                        is_error ? name + strlen(error_) : name);
    if (!r || (result->solution.n == 0 && !result->model.given) ||
        (is_error && (!result->has_errors || !r->error_bar)))
        return NAN;
    return rb_api_shown(
        a, r->unit, rb_rolling_number(r, is_error ? &result->errors.scalar : &result->solution));
}
