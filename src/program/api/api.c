/* A case, its results and the steps of its solution as numbers, text and arrays by name. */
#include "analysis/crack/crack.h"
#include "analysis/crack/crack_case.h"
#include "program/api/internal.h"

#include "base/blas.h"
#include "rolling/case/closed_forms.h"
#include "lcp/contact/contact.h"
#include "lcp/friction/friction.h"

#include <gsl/gsl_errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ---- Arrays ------------------------------------------------------------------------ */

api_array *rb_api_find_array(rb_api *a, const char *name)
{
    for (int k = 0; k < a->arrays; k++)
        if (strcmp(a->made[k]->name, name) == 0)
            return a->made[k];
    return NULL;
}

void rb_api_forget_arrays(rb_api *a, const char *beginning)
{
    int kept = 0;
    for (int k = 0; k < a->arrays; k++)
        if (strncmp(a->made[k]->name, beginning, strlen(beginning)) == 0) {
            free(a->made[k]->at);
            free(a->made[k]);
        } else
            a->made[kept++] = a->made[k];
    a->arrays = kept;
    if (kept == 0) {
        free(a->made);
        a->made = NULL;
    }
}

api_array *rb_api_make_array(rb_api *a, const char *name, int rows, int columns)
{
    api_array **more = realloc(a->made, ((size_t)a->arrays + 1) * sizeof *more);
    api_array *made = more ? calloc(1, sizeof *made) : NULL;
    a->made = more ? more : a->made;
    if (!made || !(made->at = rb_alloc((size_t)rows, (size_t)columns))) {
        free(made);
        return NULL;
    }
    snprintf(made->name, sizeof made->name, "%s", name);
    made->rows = rows;
    made->columns = columns;
    memset(made->at, 0, sizeof(double) * (size_t)rows * (size_t)columns);
    return a->made[a->arrays++] = made;
}

api_array *rb_api_copy_array(rb_api *a, const char *name, int rows, int columns, const double *x)
{
    api_array *made = x ? rb_api_make_array(a, name, rows, columns) : NULL;
    if (made)
        memcpy(made->at, x, sizeof(double) * (size_t)rows * (size_t)columns);
    return made;
}

/* ---- Units ------------------------------------------------------------------------- */

/* The part of the name behind a beginning; NULL: it begins otherwise. */
static const char *behind(const char *name, const char *beginning)
{
    const size_t n = strlen(beginning);
    return strncmp(name, beginning, n) == 0 ? name + n : NULL;
}

/* The unit in mm, N, MPa of all numbers of an array; NULL: they have none, or are those of a
 * problem that was handed over, of an LCP, or in the units of the case already. */
static const char *unit_of_array(const rb_api *a, const char *name)
{
    static const struct {
        const char *beginning;
        const rb_rolling_results *results;
    } tables[] = {{"history.error.", &rb_rolling_history_columns},
                  {"history.tolerance.", &rb_rolling_history_columns},
                  {"history.", &rb_rolling_history_columns},
                  {"curve.tolerance.", &rb_rolling_curve_columns},
                  {"curve.error.", &rb_rolling_curve_columns},
                  {"curve.", &rb_rolling_curve_columns},
                  {"wear.", &rb_rolling_wear_columns},
                  {"patch.", &rb_rolling_patch_scalars},
                  {"stress.", &rb_rolling_stress_scalars},
                  {"crack.summary.", &rb_case_crack_scalars},
                  {"crack.growth.", &rb_case_crack_growth_columns},
                  {"crack.", &rb_case_crack_columns},
                  {"sweep.tolerance.", &rb_rolling_solution_scalars},
                  {"sweep.", &rb_rolling_solution_scalars},
                  {"sweep.", &rb_case_crack_scalars},
                  {"tolerance.", &rb_rolling_solution_scalars},
                  {"", &rb_rolling_solution_columns}};
    /* what no table has; a beginning ends with a point */
    static const char *const others[][2] = {
        {"friction_power", "MPa"}, {"ends", "mm"},          {"gap0", "mm"},
        {"F", "mm/MPa"},           {"G", "mm/MPa"},         {"mesh.", "mm"},
        {"closed.", "MPa"},        {"wear.profile.", "mm"}, {"crack.path.", "mm"},
        {"crack.node.x", "mm"},    {"crack.node.y", "mm"},  {"crack.node.length", "mm"},
        {"crack.opening", "mm"},   {"crack.sliding", "mm"}, {"crack.pressure", "MPa"},
        {"crack.friction", "MPa"}, {"step.x", "mm"},        {"step.p", "MPa"},
        {"step.q", "MPa"},         {"pivot.p", "MPa"},      {"pivot.q", "MPa"},
        {"newton.p", "MPa"},       {"newton.q", "MPa"},     {"guess.p", "MPa"},
        {"guess.q", "MPa"},        {"guess.gap", "mm"},     {"guess.shift", "mm"}};
    if (strcmp(name, "wear.way") == 0)
        return a->wear.slides ? "mm" : NULL;
    if (strcmp(name, "wear.work") == 0)
        return a->wear.slides || a->wear.rolls ? "N/mm" : "N";
    for (size_t k = 0; k < sizeof others / sizeof *others; k++) {
        const char *rest = behind(name, others[k][0]);
        if (rest && (!*rest || rest[-1] == '.'))
            return others[k][1];
    }
    for (size_t k = 0; k < sizeof tables / sizeof *tables; k++) {
        const char *rest = behind(name, tables[k].beginning);
        const rb_rolling_result *r = rest ? rb_rolling_find_result(tables[k].results, rest) : NULL;
        if (r)
            return r->unit;
    }
    return NULL;
}

static rb_units units_of(const rb_api *a, const char *name)
{
    return behind(name, "sweep.") ? a->study_units : rb_case_resolved(a->words)->units;
}

/* From mm, N, MPa to the units of the case: n numbers of an array from the first on. */
static void show(const rb_api *a, api_array *made, int first, int n)
{
    rb_unit_factor f;
    const rb_units units = units_of(a, made->name);
    if (rb_unit_of_system(units, unit_of_array(a, made->name), &f))
        for (int i = first; i < first + n; i++)
            made->at[i] = rb_unit_over(&f, made->at[i]);
    else if (behind(made->name, "maxima."))
        for (int i = first; i < first + n; i++)
            made->at[i] = rb_unit_shown(units, i == 0 ? "MPa" : i < 3 ? "mm" : NULL, made->at[i]);
}

/* A number that is handed over, in mm, N, MPa. */
static double stored(const rb_api *a, const char *unit, double x)
{
    return rb_unit_stored(rb_case_units(a->words, RB_GIVEN_ARGUMENT), unit, x);
}

static double shown(const rb_api *a, const char *unit, double x)
{
    return rb_unit_shown(rb_case_resolved(a->words)->units, unit, x);
}

/* Adds one column to an array that grows step by step. */
static rb_status add_column(rb_api *a, const char *name, int rows, const double *x)
{
    api_array *to = rb_api_find_array(a, name);
    if (!to)
        return rb_api_copy_array(a, name, rows, 1, x) ? RB_OK : RB_ENOMEM;
    const size_t size = sizeof(double) * (size_t)rows * ((size_t)to->columns + 1);
    double *longer = realloc(to->at, size);
    if (!longer)
        return RB_ENOMEM;
    to->at = longer;
    memcpy(&longer[(size_t)rows * (size_t)to->columns], x, sizeof(double) * (size_t)rows);
    to->columns++;
    if (to->shown) /* somebody has looked at it */
        show(a, to, rows * (to->columns - 1), rows);
    return RB_OK;
}

/* Adds zones and tractions of a step to its arrays. */
static rb_status add_state(rb_api *a, const char *beginning, const rb_contact_state *state)
{
    double *zone = rb_alloc((size_t)state->n, 1);
    const struct {
        const char *name;
        const double *x;
    } parts[] = {{"zone", zone}, {"p", state->p}, {"q", state->q}};
    rb_status s = zone ? RB_OK : RB_ENOMEM;

    for (int i = 0; zone && i < state->n; i++)
        zone[i] = state->zone[i];
    for (int k = 0; k < 3 && s == RB_OK; k++) {
        char name[40];
        snprintf(name, sizeof name, "%s.%s", beginning, parts[k].name);
        s = add_column(a, name, state->n, parts[k].x);
    }
    free(zone);
    return s;
}

/* ---- A case ------------------------------------------------------------------------ */

void rb_api_name_option(rb_message *why)
{
    const rb_message said = *why;

    if (said.about[0])
        rb_fail(why, RB_EINVAL, "--%s", said.text);
}

int rb_api_ended(rb_api *a, rb_status s)
{
    a->status = s;
    if (s == RB_EINVAL)
        rb_api_name_option(&a->why);
    if (s == RB_OK || !a->why.text[0])
        snprintf(a->why.text, sizeof a->why.text, "%s", s == RB_OK ? "" : rb_status_text(s));
    return s;
}

int rb_api_refuse(rb_api *a, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    a->why.about[0] = '\0';
    vsnprintf(a->why.text, sizeof a->why.text, format, args);
    va_end(args);
    return rb_api_ended(a, RB_EINVAL);
}

/* Threads of BLAS cost small problems more than they bring, as in the program; whoever
 * else uses BLAS in this process has his own again when the last call is over. */
static _Atomic int calls;
static int threads_outside;

static int is_stopped(void *context)
{
    rb_api *a = context;
    const rb_interrupt *outside = &a->outside;
    a->interrupted =
        a->interrupted || a->stopped || (outside->asked && outside->asked(outside->context));
    return a->interrupted;
}

void rb_api_call_begins(rb_api *a)
{
    if (calls++ == 0)
        threads_outside = getenv("OPENBLAS_NUM_THREADS") ? 0 : rb_blas_threads(1);
    a->outside = rb_interrupt_by((rb_interrupt){is_stopped, a});
}

/* Whatever made of a step that was stopped, or went on without it. */
rb_status rb_api_call_ends(rb_api *a, rb_status s)
{
    rb_interrupt_by(a->outside);
    if (--calls == 0)
        rb_blas_threads(threads_outside); /* 0: as the variable says */
    return !a->interrupted || s == RB_INTERRUPTED ? s
                                                  : rb_fail(&a->why, RB_INTERRUPTED, "interrupted");
}

void rb_api_forget_call(rb_api *a)
{
    a->why.text[0] = '\0';
    a->stopped = 0;
    a->interrupted = 0;
    a->done = 0;
    a->total = 0;
}

/* All results; the model stays aside where its bodies remain those of the case. */
static void forget(rb_api *a, int same_bodies)
{
    if (!same_bodies || a->result.model.mesh.ends) {
        rb_rolling_model_free(&a->kept);
        a->kept = a->result.model;
        memset(&a->result.model, 0, sizeof a->result.model);
    }
    if (!same_bodies)
        rb_rolling_model_free(&a->kept);
    rb_api_forget_arrays(a, "");
    for (int k = 0; k < API_SAID_N; k++) {
        free(a->said[k]);
        a->said[k] = NULL;
    }
    rb_rolling_curve_free(&a->curve);
    rb_rolling_curve_free(&a->curve_errors);
    rb_contact_lcp_free(&a->lcp);
    rb_case_derivatives_free(&a->derivatives);
    for (int of = 0; of < API_SLOPES_N; of++)
        rb_case_slopes_free(&a->slopes[of]);
    rb_rolling_states_free(&a->states);
    a->has_deviation = 0;
    rb_rolling_wear_history_free(&a->wear);
    rb_case_result_free(&a->result);
    memset(&a->lcp, 0, sizeof a->lcp);
    memset(&a->result, 0, sizeof a->result);
    rb_api_forget_call(a);
}

rb_api *rb_api_create_for(const char *purpose)
{
    static const struct {
        const char *name;
        rb_case_purpose purpose;
    } known[] = {{"solve", RB_CASE_SINGLE}, {"curve", RB_CASE_CURVE}, {"stress", RB_CASE_STRESS},
                 {"crack", RB_CASE_CRACK},  {"wear", RB_CASE_WEAR},   {"sweep", RB_CASE_STUDY}};
    rb_api *a = calloc(1, sizeof *a);

    gsl_set_error_handler_off(); /* GSL's own one ends the program */
    for (size_t k = 0; a && k < sizeof known / sizeof *known; k++)
        if (strcmp(known[k].name, purpose) == 0)
            a->words = rb_case_create(known[k].purpose);
    if (a && !a->words) {
        free(a);
        a = NULL;
    }
    if (!a)
        return NULL;
    a->is_curve = strcmp(purpose, "curve") == 0;
    rb_case_use_cone_solvers(a->words, rb_friction_cone_solver);
    return a;
}

rb_api *rb_api_create(void)
{
    return rb_api_create_for("solve");
}

void rb_api_free(rb_api *a)
{
    if (!a)
        return;
    forget(a, 0);
    rb_case_free(a->words);
    free(a);
}

/* Who does not look at the status of rb_api_set must not get the solution of another
 * case: what was refused last stands in the way until the same name is accepted. */
static int note_refusal(rb_api *a, const char *name, rb_status s)
{
    int k = 0;
    while (k < a->refusals && strncmp(a->refused[k].name, name, sizeof a->refused[k].name - 1) != 0)
        k++;
    if (k < a->refusals && s == RB_OK)
        a->refused[k] = a->refused[--a->refusals];
    rb_api_ended(a, s);
    if (s != RB_OK) {
        a->refusals += k == a->refusals && k < API_REFUSALS;
        api_refusal *here = &a->refused[k < API_REFUSALS ? k : API_REFUSALS - 1];
        snprintf(here->name, sizeof here->name, "%s", name);
        here->why = a->why;
    }
    return s;
}

int rb_api_set(rb_api *a, const char *name, const char *text)
{
    /* Options that change neither bodies nor mesh: the flexibility may serve again. */
    static const char *const driving[] = {"mu",    "load",        "approach", "half-width", "shift",
                                          "creep", "creep-ratio", "force",    "force-ratio"};
    int drives = 0;
    for (size_t k = 0; k < sizeof driving / sizeof *driving; k++)
        drives |= strcmp(name, driving[k]) == 0;
    forget(a, drives);
    return note_refusal(a, name, rb_case_set(a->words, name, text, RB_GIVEN_ARGUMENT, &a->why));
}

int rb_api_read(rb_api *a, const char *path)
{
    forget(a, 0);
    return note_refusal(a, path, rb_case_read(a->words, path, &a->why));
}

rb_status rb_api_check_refusals(const rb_api *a, rb_message *why)
{
    return a->refusals > 0 ? rb_fail(why, RB_EINVAL, "%s", a->refused[0].why.text) : RB_OK;
}

int rb_api_resolve(rb_api *a)
{
    forget(a, 1);
    rb_status s = rb_api_check_refusals(a, &a->why);
    if (s == RB_OK)
        s = rb_case_resolve(a->words, &a->why);
    return rb_api_ended(a, s);
}

static int keep_step(const rb_rolling_model *model, const rb_rolling_history *history, int step,
                     int steps, void *context)
{
    rb_api *a = context;
    a->total = steps;
    a->done = step + 1;
    if (a->stopped || !model) /* no model: a run for error bars */
        return a->stopped;
    if (step == 0) { /* a run may start again on a wider zone */
        rb_api_forget_arrays(a, "step.");
        api_array *x = rb_api_make_array(a, "step.x", model->mesh.n, 1);
        for (int i = 0; x && i < x->rows; i++)
            x->at[i] = 0.5 * (model->mesh.ends[i] + model->mesh.ends[i + 1]);
        a->status = x ? RB_OK : RB_ENOMEM;
    }
    if (a->status == RB_OK)
        a->status = rb_rolling_states_keep(model, history, step, steps, &a->states);
    if (a->status == RB_OK)
        a->status = add_state(a, "step", &model->state);
    return a->status != RB_OK;
}

void rb_api_forget_notes(rb_api *a)
{
    a->note.text[0] = '\0';
    memset(&a->rows, 0, sizeof a->rows);
}

int rb_api_solve(rb_api *a)
{
    rb_api_forget_notes(a);
    a->done = a->total = 0;
    if (rb_api_resolve(a) < 0)
        return a->status;
    a->result.model = a->kept;
    memset(&a->kept, 0, sizeof a->kept);
    rb_api_call_begins(a);
    rb_status s =
        rb_case_solve_again(rb_case_resolved(a->words), keep_step, a, &a->result, &a->why);
    s = rb_api_call_ends(a, s);
    if (s == RB_INTERRUPTED && a->status == RB_ENOMEM) /* a step could not be kept */
        s = rb_fail(&a->why, RB_ENOMEM, "out of memory");
    return rb_api_ended(a, s != RB_OK ? rb_case_locate(a->words, s, &a->why) : s);
}

void rb_api_stop(rb_api *a)
{
    a->stopped = 1;
}

void rb_api_stop_until(rb_api *a, const volatile int *over)
{
    const struct timespec little = {0, 1000000};

    while (!__atomic_load_n(over, __ATOMIC_ACQUIRE)) {
        rb_api_stop(a);
        nanosleep(&little, NULL);
    }
}

void rb_api_progress(const rb_api *a, int *done, int *total)
{
    *done = a->done;
    *total = a->total;
}

int rb_api_status(const rb_api *a)
{
    return a->status;
}

const char *rb_api_message(const rb_api *a)
{
    return a->why.text;
}

/* ---- Descriptions ------------------------------------------------------------------ */

static const char *written(const char *what, char *text, int size)
{
    snprintf(text, (size_t)size, "%s", what ? what : "");
    return text;
}

/* What is described, field by field. */
typedef struct {
    const char *field, *text; /* NULL: none, written as "" */
} described;

/* NULL: there is no such field. */
static const char *field_of(size_t n, const described *of, const char *field, char *text, int size)
{
    for (size_t k = 0; k < n; k++)
        if (strcmp(field, of[k].field) == 0)
            return written(of[k].text, text, size);
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

    const described texts[] = {
        {"name", o->name},        {"section", is_group ? o->name : rb_case_section(o)},
        {"kind", kinds[o->kind]}, {"unit", o->unit},
        {"help", o->help},        {"word", o->word}};
    const struct {
        const char *field;
        double value;
    } numbers[] = {{"from", o->range.from}, {"to", o->range.to}, {"excludes", o->excludes}};

    if (field_of(sizeof texts / sizeof *texts, texts, field, text, size))
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
        return is_group ? written("", text, size) : rb_option_expected(o, text, (size_t)size);
    if (strcmp(field, "default") == 0 && is_group)
        return written("", text, size);
    if (strcmp(field, "default") == 0) {
        rb_case *c = values ? NULL : rb_case_create(RB_CASE_SINGLE);
        char buffer[64];
        if (!values && !c)
            return NULL;
        written(o->unset ? o->unset
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
        const described texts[] = {{"name", r->name},
                                   {"unit", r->unit},
                                   {"kind", kinds[r->kind]},
                                   {"meaning", r->meaning}};
        return field_of(4, texts, field, text, size);
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
        rb_format(buffer, sizeof buffer, "%.15g", shown(a, o->unit, x));
    return written(value, text, size);
}

const char *rb_api_unit(const char *system, const char *unit, char *text, int size)
{
    const rb_choice *of = rb_case_option("units")->choices;
    while (of->name && strcmp(of->name, system) != 0)
        of++;
    return of->name ? written(rb_unit_name((rb_units)of->value, unit), text, size) : NULL;
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
                                    : rb_rolling_find_notes(&rb_case_resolved(a->words)->rc, s);
    if (a->rows.rows == 0 || strcmp(a->row, "point") == 0) /* those of a study are its rows' */
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
            return numbers[k].is_known ? shown(a, numbers[k].unit, numbers[k].value) : NAN;
    const int is_error = strncmp(name, error_, strlen(error_)) == 0;
    const rb_rolling_result *r = rb_rolling_find_result(&rb_rolling_solution_scalars,
                                                        is_error ? name + strlen(error_) : name);
    if (!r || (result->solution.n == 0 && !result->model.given) ||
        (is_error && (!result->has_errors || !r->error_bar)))
        return NAN;
    return shown(a, r->unit,
                 rb_rolling_number(r, is_error ? &result->errors.scalar : &result->solution));
}

/* ---- Matrices ---------------------------------------------------------------------- */

static api_array *model_array(rb_api *a, const char *name)
{
    rb_rolling_model *model = &a->result.model;
    const int n = model->mesh.n, size = a->lcp.size;
    if (strcmp(name, "ends") == 0)
        return rb_api_copy_array(a, name, n + 2, 1, model->mesh.ends);
    if (strcmp(name, "gap0") == 0)
        return rb_api_copy_array(a, name, n, 1, model->mesh.gap);
    if (strcmp(name, "F") == 0 && model->state.p &&
        rb_rolling_model_add_matrix(model, &a->why) != RB_OK)
        return NULL;
    if (strcmp(name, "F") == 0)
        return rb_api_copy_array(a, name, 2 * n + 2, 2 * n, model->bodies.F);
    if (strcmp(name, "lcp.M") == 0)
        return rb_api_copy_array(a, name, size, size, a->lcp.M);
    if (strcmp(name, "lcp.q") == 0)
        return rb_api_copy_array(a, name, size, 1, a->lcp.b);
    rb_bem_mesh mesh;
    api_array *made = NULL;
    if (rb_rolling_boundary_mesh(&a->result.model, 0, &mesh, &a->why) != RB_OK)
        return NULL;
    const struct {
        const char *name;
        const double *at;
    } places[] = {
        {"mesh.x0", mesh.x0}, {"mesh.y0", mesh.y0}, {"mesh.x1", mesh.x1}, {"mesh.y1", mesh.y1}};
    for (size_t k = 0; k < sizeof places / sizeof *places && mesh.n > 0; k++)
        if (strcmp(name, places[k].name) == 0)
            made = rb_api_copy_array(a, name, mesh.n, 1, places[k].at);
    if (mesh.n > 0 && (strcmp(name, "H") == 0 || strcmp(name, "G") == 0)) {
        const rb_rolling_case *rc = a->result.model.rc;
        api_array *H = rb_api_make_array(a, "H", 2 * mesh.n, 2 * mesh.n);
        api_array *G = rb_api_make_array(a, "G", 2 * mesh.n, 2 * mesh.n);
        if (!H || !G ||
            rb_bem_assemble(&mesh, rb_rolling_material(rc, &rc->a), H->at, G->at, 2 * mesh.n,
                            &a->why) != RB_OK) {
            rb_api_forget_arrays(a, "H");
            rb_api_forget_arrays(a, "G");
            made = NULL;
        } else
            made = strcmp(name, "H") == 0 ? H : G;
    }
    rb_bem_mesh_free(&mesh);
    return made;
}

/* Hertz and Carter at the elements' midpoints. */
static api_array *closed_array(rb_api *a, const char *name)
{
    const rb_resolved_case *c = rb_case_resolved(a->words);
    const rb_rolling_solution *s = &a->result.solution;
    const int friction = strcmp(name, "closed.q") == 0;
    if ((!friction && strcmp(name, "closed.p") != 0) || s->n == 0 ||
        !rb_rolling_carter_holds(&c->rc))
        return NULL;
    const double half = s->hertz_half_width, mu = rb_rolling_largest_mu(&c->rc);
    const double highest = rb_closed_hertz_max_pressure(s->normal_load, half);
    api_array *made = rb_api_make_array(a, name, s->n, 1);
    const double creep = mu > 0.0 ? s->creep_ratio : 0.0;
    for (int i = 0; made && i < s->n; i++)
        made->at[i] = friction ? rb_closed_carter_traction(mu, highest, half, creep, s->x[i])
                               : rb_closed_hertz_pressure(highest, half, s->x[i]);
    return made;
}

/* Entries of a table of results: of columns of the owner, or numbers of an array of structs. */
typedef struct {
    const char *beginning; /* of the names of the arrays */
    const rb_rolling_results *table;
    const void *owner; /* NULL: there is none */
    int rows, columns;
    size_t size; /* of each of the structs; 0: columns */
} entries;

static int has_entries(const entries *of, const rb_rolling_result *r)
{
    return of->owner && of->rows > 0 && (of->size || rb_rolling_has_column(r, of->owner));
}

/* NULL: there are none, or no memory. */
static api_array *make_entries(rb_api *a, const entries *of, const rb_rolling_result *r)
{
    char name[120];
    snprintf(name, sizeof name, "%s%s", of->beginning, r->name);
    api_array *made = has_entries(of, r) ? rb_api_make_array(a, name, of->rows, of->columns) : NULL;
    for (int i = 0; made && i < of->rows * of->columns; i++)
        made->at[i] = of->size
                          ? rb_rolling_number(r, (const char *)of->owner + (size_t)i * of->size)
                          : rb_rolling_entry(r, of->owner, i);
    return made;
}

/* An entry of the tables whose columns are arrays, by the beginning of its name: those of
 * the solution begin with nothing. */
static api_array *series_array(rb_api *a, const char *name)
{
    const rb_case_result *r = &a->result;
    const rb_rolling_solution *s = &r->solution;
    const entries series[] = {
        {"history.error.", &rb_rolling_history_columns, r->history.errors, r->history.n, 1, 0},
        {"history.tolerance.", &rb_rolling_history_columns, r->history.deviations, r->history.n, 1,
         0},
        {"history.", &rb_rolling_history_columns, &r->history, r->history.n, 1, 0},
        {"curve.tolerance.", &rb_rolling_curve_columns, a->curve.deviations, a->curve.n, 1, 0},
        {"curve.error.", &rb_rolling_curve_columns, &a->curve_errors, a->curve_errors.n, 1, 0},
        {"curve.", &rb_rolling_curve_columns, &a->curve, a->curve.n, 1, 0},
        {"wear.error.", &rb_rolling_wear_columns, a->wear.errors, a->wear.n, 1, 0},
        {"wear.", &rb_rolling_wear_columns, &a->wear, a->wear.n, 1, 0},
        {"patch.", &rb_rolling_patch_scalars, s->patch, s->patches, 1, sizeof *s->patch},
        {"", &rb_rolling_solution_columns, s, s->n, 1, 0}};
    size_t n, k = 0;
    while (strncmp(name, series[k].beginning, n = strlen(series[k].beginning)) != 0)
        k++;
    const rb_rolling_result *row = rb_rolling_find_result(series[k].table, name + n);
    return row ? make_entries(a, &series[k], row) : NULL;
}

/* Of result `name` with respect to all inputs, the two sides of each beside each other. */
static api_array *derivative_array(rb_api *a, const char *name, const char *result)
{
    const rb_case_derivatives *all = &a->derivatives;
    int is_column;
    const rb_rolling_result *r = rb_case_derivative_result(result, &is_column);
    const int values = strcmp(result, "value") == 0;
    for (int k = 0; k < 2 * RB_CASE_OVER_X_N && all->n_x > 0; k++) {
        char known[40];
        snprintf(known, sizeof known, "%s.%s", rb_case_over_x_names[k / 2], k % 2 ? "mu" : "gap");
        if (strcmp(known, result) != 0)
            continue;
        const rb_rolling_result *of =
            rb_rolling_find_result(&rb_rolling_solution_scalars, rb_case_over_x_names[k / 2]);
        const double by = k % 2 ? 1.0 : shown(a, "mm", 1.0); /* by mu, by the gap */
        api_array *made = rb_api_copy_array(a, name, all->n_x, 1, all->over_x + k * all->n_x);
        for (int i = 0; made && i < all->n_x; i++)
            made->at[i] = shown(a, of->unit, made->at[i]) / by;
        return made;
    }
    const int rows = !values && is_column ? a->result.solution.n : 1;
    api_array *made = all->n > 0 && (r || values)
                          ? rb_api_make_array(a, name, rows, values ? all->n : 2 * all->n)
                          : NULL;

    for (int k = 0; made && k < all->n; k++) {
        const rb_case_derivative *of = &all->of[k];
        const double by = shown(a, of->unit, 1.0);
        if (values)
            made->at[k] = shown(a, of->unit, of->value);
        for (int side = 0; side < 2 && !values; side++) {
            const int from = of->status == RB_OK && of->d.sides == 1 ? 0 : side;
            const rb_rolling_solution *d = &of->d.value[from];
            const int has = of->status == RB_OK && of->d.has[from] &&
                            (!is_column || rb_rolling_has_column(r, d));
            for (int i = 0; i < rows; i++)
                made->at[i + rows * (2 * k + side)] =
                    !has ? NAN
                         : shown(a, r->unit,
                                 is_column ? rb_rolling_entry(r, d, i) : rb_rolling_number(r, d)) /
                               by;
        }
    }
    return made;
}

/* ---- Derivatives in columns -------------------------------------------------------- */

static const char *const slopes_of[API_SLOPES_N] = {
    [API_SLOPES_CURVE] = "curve", [API_SLOPES_HISTORY] = "history", [API_SLOPES_SWEEP] = "sweep"};

void rb_api_forget_slopes(rb_api *a, api_slopes of)
{
    char beginning[40];

    snprintf(beginning, sizeof beginning, "%s.derivative.", slopes_of[of]);
    rb_api_forget_arrays(a, beginning);
    rb_case_slopes_free(&a->slopes[of]);
}

/* "tangential_load:mu". */
static const char *slope_name(const rb_case_slope *of, char text[100])
{
    snprintf(text, 100, "%s:%s", of->result->name, of->input);
    return text;
}

const char *rb_api_derivative(const rb_api *a, const char *of, int k, const char *field, char *text,
                              int size)
{
    char name[100];
    int j = 0;

    while (j < API_SLOPES_N && strcmp(of, slopes_of[j]) != 0)
        j++;
    if (j == API_SLOPES_N || k < 0 || k >= a->slopes[j].n || size < 1)
        return NULL;
    const rb_case_slope *slope = &a->slopes[j].of[k];
    const described texts[] = {{"name", slope_name(slope, name)},
                               {"result", slope->result->name},
                               {"input", slope->input},
                               {"unit", slope->unit}};
    return field_of(4, texts, field, text, size);
}

/* Both sides of each point of a curve; otherwise the one number of each row. */
static api_array *slope_array(rb_api *a, const char *name)
{
    static const char derivative_[] = ".derivative.";

    for (int of = 0; of < API_SLOPES_N; of++) {
        const rb_case_slopes *s = &a->slopes[of];
        const size_t n = strlen(slopes_of[of]), m = sizeof derivative_ - 1;
        const int sides = of == API_SLOPES_CURVE ? 2 : 1;
        char text[100];
        int k = 0;
        if (s->rows == 0 || strncmp(name, slopes_of[of], n) != 0 ||
            strncmp(name + n, derivative_, m) != 0)
            continue;
        while (k < s->n && strcmp(name + n + m, slope_name(&s->of[k], text)) != 0)
            k++;
        api_array *made = k < s->n ? rb_api_make_array(a, name, s->rows, sides) : NULL;
        for (int row = 0; made && row < s->rows; row++) {
            const double *both = s->value + 2 * ((size_t)row * (size_t)s->n + (size_t)k);
            const rb_units units = units_of(a, name);
            made->at[row] = rb_case_slope_shown(
                &s->of[k], units, sides == 2 ? both[0] : rb_case_slope_value(s, row, k));
            if (sides == 2)
                made->at[s->rows + row] = rb_case_slope_shown(&s->of[k], units, both[1]);
        }
        return made;
    }
    return NULL;
}

static api_array *tolerance_array(rb_api *a, const char *name, const char *result)
{
    for (int k = 0; k < rb_rolling_solution_scalars.n && a->has_deviation; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        const double x = rb_rolling_number(r, &a->deviation);
        if (rb_sensitivity_has(r) && strcmp(r->name, result) == 0)
            return rb_api_copy_array(a, name, 1, 1, &x);
    }
    return NULL;
}

const double *rb_api_array(rb_api *a, const char *name, int *rows, int *columns)
{
    api_array *made = rb_api_find_array(a, name);
    if (!made)
        made = slope_array(a, name);
    if (!made)
        made = series_array(a, name);
    if (!made && strcmp(name, "friction_power") == 0) {
        const rb_rolling_solution *s = &a->result.solution;
        made = s->n > 0 ? rb_api_make_array(a, name, s->n, 1) : NULL;
        if (made)
            rb_rolling_friction_power(s, made->at);
    }
    if (!made && strncmp(name, "closed.", 7) == 0)
        made = closed_array(a, name);
    if (!made && strncmp(name, "derivative.", 11) == 0)
        made = derivative_array(a, name, name + 11);
    if (!made && strncmp(name, "tolerance.", 10) == 0)
        made = tolerance_array(a, name, name + 10);
    if (!made && a->result.model.mesh.n > 0) {
        a->stopped = 0;
        a->interrupted = 0;
        rb_api_call_begins(a);
        made = model_array(a, name);
        rb_api_call_ends(a, RB_OK);
    }
    if (made && !made->shown)
        show(a, made, 0, made->rows * made->columns);
    if (made)
        made->shown = 1;
    *rows = made ? made->rows : 0;
    *columns = made ? made->columns : 0;
    return made ? made->at : NULL;
}

/* ---- Further questions ------------------------------------------------------------- */

/* Counts the points of a curve, and ends it where the caller has had enough. */
static rb_status count_point(const rb_rolling_model *model, int k, void *context, rb_message *why)
{
    (void)model, (void)k;
    rb_api *a = context;
    a->done++;
    return a->stopped ? rb_fail(why, RB_INTERRUPTED, "interrupted") : RB_OK;
}

int rb_api_curve_derivatives(rb_api *a, const char *over, double from, double to, int points,
                             const char *derivatives, const char *tolerance)
{
    const rb_resolved_case *c = rb_case_resolved(a->words);
    const rb_choice *variable = rb_case_curve_variables;
    while (variable->name && strcmp(variable->name, over) != 0)
        variable++;
    rb_api_forget_call(a);
    rb_api_forget_notes(a);
    rb_api_forget_slopes(a, API_SLOPES_CURVE);
    rb_api_forget_arrays(a, "curve.");
    rb_rolling_curve_free(&a->curve);
    rb_rolling_curve_free(&a->curve_errors);
    const int speeds = variable->name && variable->value == RB_OVER_SPEED;
    const char *unit = speeds ? "mm/s" : NULL;
    const rb_rolling_range range = {(rb_rolling_variable)variable->value, stored(a, unit, from),
                                    stored(a, unit, to), points, c->units};
    rb_api_call_begins(a);
    rb_status s = rb_api_check_refusals(a, &a->why);
    if (s == RB_OK) {
        /* Variables differ in the options that they refuse. */
        if (a->is_curve && range.over == RB_OVER_SPEED)
            rb_case_set_purpose(a->words, RB_CASE_SPEEDS);
        s = rb_case_resolve(a->words, &a->why);
        if (a->is_curve)
            rb_case_set_purpose(a->words, RB_CASE_CURVE);
        if (s != RB_OK) { /* the solution keeps its case */
            rb_message known;
            s = rb_case_locate(a->words, s, &a->why);
            rb_case_resolve(a->words, &known);
            return rb_api_ended(a, rb_api_call_ends(a, s));
        }
    }
    a->total = (c->error ? 1 + rb_rolling_error_runs(&c->rc) : 1) *
               (range.over != RB_OVER_SPEED && rb_rolling_law_depends_on_state(&c->rc) ? 2 * points
                                                                                       : points);
    rb_case_slopes *slopes = &a->slopes[API_SLOPES_CURVE];
    if (s == RB_OK && !variable->name)
        s = rb_fail(&a->why, RB_EINVAL,
                    "--over: expected creep-ratio, creep or speed, got '%.100s'", over);
    const int differentiated = derivatives || tolerance;
    if (s == RB_OK && differentiated && c->error)
        s = rb_fail(&a->why, RB_EINVAL, "--%s: not together with error bars",
                    derivatives ? "derivatives" : "tolerance");
    if (s == RB_OK && differentiated && c->rc.formulation != RB_STEADY)
        s = rb_fail(&a->why, RB_EINVAL,
                    "derivatives of a curve need a steady case; give --formulation steady");
    if (s == RB_OK && differentiated)
        s = rb_case_curve_choose(a->words, &range, derivatives, tolerance, slopes, &a->why);
    if (s == RB_OK)
        s = differentiated ? rb_case_curve_solve(a->words, &range, c->rc.mu, count_point, a,
                                                 &a->curve, slopes, &a->why)
            : c->error
                ? rb_rolling_curve_with_errors(&c->rc, &range, count_point, a, &a->curve,
                                               &a->curve_errors, &a->why)
                : rb_rolling_curve_observe(&c->rc, &range, count_point, a, &a->curve, &a->why);
    s = rb_api_call_ends(a, s);
    a->rows = a->curve.notes;
    a->row = "point";
    rb_case_slopes_note(slopes, &a->note);
    slopes->tolerance = NULL; /* the caller's */
    if (s != RB_OK) {
        rb_api_forget_slopes(a, API_SLOPES_CURVE);
        s = rb_case_locate(a->words, s, &a->why);
    }
    return rb_api_ended(a, s);
}

int rb_api_curve_over(rb_api *a, const char *over, double from, double to, int points)
{
    return rb_api_curve_derivatives(a, over, from, to, points, NULL, NULL);
}

int rb_api_curve(rb_api *a, double from, double to, int points)
{
    return rb_api_curve_over(a, "creep-ratio", from, to, points);
}

/* 1: the matrices are there; otherwise the call has ended. */
static int has_model(rb_api *a)
{
    rb_rolling_model *model = &a->result.model;
    rb_api_call_begins(a);
    rb_status s = model->state.p ? rb_rolling_model_add_matrix(model, &a->why) : RB_OK;
    s = rb_api_call_ends(a, s);

    if (s != RB_OK)
        rb_api_ended(a, s);
    else if (!model->state.p || !model->bodies.F)
        rb_api_refuse(a, "there is no solved case whose matrices are available");
    else
        return 1;
    return 0;
}

static rb_status keep_tractions(rb_api *a, const rb_lcp_pivot *p, const double *value)
{
    const int n = a->result.model.mesh.n;
    double *z = rb_alloc((size_t)p->n, 1);
    rb_contact_state state = {0};
    rb_status s = z ? rb_contact_state_alloc(n, &state) : RB_ENOMEM;
    for (int i = 0; s == RB_OK && i < p->n; i++)
        if (p->basis[i] >= p->n && p->basis[i] < 2 * p->n)
            z[p->basis[i] - p->n] = value[i];
    if (s == RB_OK) {
        rb_contact_lcp_recover(&a->result.model.problem, &a->lcp, z, &state);
        s = add_column(a, "pivot.p", n, state.p);
    }
    if (s == RB_OK)
        s = add_column(a, "pivot.q", n, state.q);
    rb_contact_state_free(&state);
    free(z);
    return s;
}

static void each_pivot(const rb_lcp_pivot *p, void *context)
{
    rb_api *a = context;
    const size_t n = (size_t)p->n;
    double *value = rb_alloc(3 * n, 1), *column = value ? value + n : NULL,
           *basis = value ? value + 2 * n : NULL;
    const double entering = p->entering, leaving = p->leaving, row = p->row;
    const struct {
        const char *name;
        const double *x;
        int rows;
    } kept[] = {{"pivot.before", value, p->n},    {"pivot.column", column, p->n},
                {"pivot.basis", basis, p->n},     {"pivot.value", &p->tableau[n * (n + 1)], p->n},
                {"pivot.entering", &entering, 1}, {"pivot.leaving", &leaving, 1},
                {"pivot.row", &row, 1},           {"pivot.ratio", &p->ratio, 1},
                {"pivot.z0", &p->z0, 1}};

    if (a->status == RB_OK && !value)
        a->status = RB_ENOMEM;
    /* The column of the entering variable and the values of the basic ones, before the
     * pivot: of the last pivot's tableau, or of z0, which enters first with a column of
     * ones. */
    for (size_t i = 0; i < n && value; i++) {
        value[i] = a->pivots > 0 ? a->tableau[n * (n + 1) + i] : a->lcp.b[i];
        column[i] = 1.0;
        basis[i] = p->basis[i];
    }
    for (size_t j = 0; j <= n && value && a->pivots > 0; j++)
        if (a->nonbasis[j] == p->entering)
            memcpy(column, &a->tableau[n * j], n * sizeof *column);
    for (size_t k = 0; a->status == RB_OK && k < sizeof kept / sizeof *kept; k++)
        a->status = add_column(a, kept[k].name, kept[k].rows, kept[k].x);
    if (a->status == RB_OK)
        a->status = keep_tractions(a, p, &p->tableau[n * (n + 1)]);
    free(value);
    memcpy(a->tableau, p->tableau, n * (n + 2) * sizeof *a->tableau);
    memcpy(a->nonbasis, p->nonbasis, (n + 1) * sizeof *a->nonbasis);
    a->pivots++;
}

int rb_api_pivots(rb_api *a)
{
    const rb_rolling_model *model = &a->result.model;
    rb_api_forget_call(a);
    if (!has_model(a))
        return a->status;
    rb_api_forget_arrays(a, "pivot.");
    rb_api_forget_arrays(a, "lcp.");
    rb_contact_lcp_free(&a->lcp);
    memset(&a->lcp, 0, sizeof a->lcp);
    rb_status s = rb_rolling_model_lcp(model, &a->lcp, &a->why);
    if (s != RB_OK)
        return rb_api_ended(a, s);
    const size_t n = (size_t)a->lcp.size;
    const rb_lcp_problem p = {a->lcp.size, a->lcp.M, a->lcp.size, a->lcp.b};
    rb_lcp_options options = rb_lcp_defaults();
    rb_lcp_info info = {0};
    double *z = rb_alloc(n, 1);
    a->tableau = rb_alloc(n, n + 2);
    a->nonbasis = rb_alloc_int(n + 1);
    a->pivots = 0;
    a->status = RB_OK;
    options.trace = each_pivot;
    options.trace_context = a;
    options.trace_tableau = 1;
    rb_api_call_begins(a);
    s = z && a->tableau && a->nonbasis ? rb_lcp_lemke(&p, &options, z, &info) : RB_ENOMEM;
    if (s < 0)
        a->why = info.msg;
    else if (a->status != RB_OK)
        s = a->status;
    s = rb_api_call_ends(a, s);
    free(z);
    free(a->tableau);
    free(a->nonbasis);
    a->tableau = NULL;
    a->nonbasis = NULL;
    return rb_api_ended(a, s);
}

/* A step of Newton's method on the elements of the case; it may begin on half as many. */
static void keep_newton_step(const rb_contact_state *state, void *context)
{
    rb_api *a = context;

    if (a->status == RB_OK && state->n == a->result.model.mesh.n)
        a->status = add_state(a, "newton", state);
}

int rb_api_prove(rb_api *a)
{
    const rb_rolling_model *model = &a->result.model;
    rb_api_forget_call(a);
    if (!has_model(a))
        return a->status;
    rb_api_call_begins(a);
    rb_status s = rb_rolling_model_prove(model, &a->result.solution.proof, &a->why);
    return rb_api_ended(a, rb_api_call_ends(a, s));
}

int rb_api_newton(rb_api *a)
{
    rb_contact_state state = {0};
    rb_api_forget_call(a);
    if (!has_model(a))
        return a->status;
    rb_contact_problem problem = a->result.model.problem; /* arrays stay the model's */
    rb_rolling_case rc = *a->result.model.rc;
    rc.contact.solver = RB_SOLVER_NEWTON;
    problem.trace = keep_newton_step;
    problem.trace_context = a;
    rb_api_forget_arrays(a, "newton.");
    a->status = RB_OK;
    rb_api_call_begins(a);
    rb_status s = rb_contact_state_alloc(problem.n, &state);
    if (s == RB_OK)
        s = rb_rolling_problem_solve(&problem, &rc, 0, &state, &a->why);
    if (s >= 0 && a->status != RB_OK)
        s = rb_fail(&a->why, a->status, "out of memory");
    s = rb_api_call_ends(a, s);
    rb_contact_state_free(&state);
    return rb_api_ended(a, s);
}

const char *rb_api_variable(const rb_api *a, int variable, char *text, int size)
{
    char name[RB_CONTACT_VARIABLE];
    if (variable < 0 || variable > 2 * a->lcp.size || a->lcp.size == 0)
        return NULL;
    return written(rb_contact_lcp_variable(&a->lcp, a->result.model.mesh.n, variable, name), text,
                   size);
}

int rb_api_guess(rb_api *a, int n, const int *zone)
{
    rb_rolling_model *model = &a->result.model;
    rb_api_forget_call(a);
    if (!has_model(a))
        return a->status;
    if (n != model->mesh.n)
        return rb_api_refuse(a, "%d zones: expected %d", n, model->mesh.n);
    if (model->problem.yield)
        return rb_api_refuse(
            a, "zones do not determine the plastic slip of an interface (--yield-stress)");
    rb_contact_state state = {0};
    double *gap = rb_alloc((size_t)n, 1);
    rb_status s = gap ? rb_contact_state_alloc(n, &state) : RB_ENOMEM;
    rb_api_forget_arrays(a, "guess.");
    rb_api_call_begins(a);
    if (s == RB_OK) {
        memcpy(state.zone, zone, (size_t)n * sizeof *zone);
        s = rb_contact_try_zones(&model->problem, &state, gap);
    }
    s = rb_api_call_ends(a, s);
    if (s == RB_OK && !(rb_api_copy_array(a, "guess.p", n, 1, state.p) &&
                        rb_api_copy_array(a, "guess.q", n, 1, state.q) &&
                        rb_api_copy_array(a, "guess.gap", n, 1, gap) &&
                        rb_api_copy_array(a, "guess.shift", n, 1, state.lambda)))
        s = RB_ENOMEM;
    rb_contact_state_free(&state);
    free(gap);
    return rb_api_ended(a, s);
}

/* ---- Stress ------------------------------------------------------------------------ */

static rb_status keep_stress(rb_api *a, int nx, int ny, const rb_rolling_stress *at)
{
    const rb_rolling_results *table = &rb_rolling_stress_scalars;
    const entries all = {"stress.", table, at, nx, ny, sizeof *at};
    for (int k = 0; k < table->n; k++)
        if (rb_rolling_has_result(&table->row[k], a->result.model.rc, 0) &&
            !make_entries(a, &all, &table->row[k]))
            return RB_ENOMEM;
    return RB_OK;
}

/* Temperatures under the heat of the solution, which is kept in the units that are shown. */
static rb_status add_temperature(rb_api *a, int n, rb_rolling_stress *at)
{
    rb_rolling_solution s = {0};
    if (!a->result.solution.temperature)
        return RB_OK;
    rb_status status = rb_rolling_model_solution(&a->result.model, &s, &a->why);
    if (status == RB_OK)
        status =
            rb_rolling_temperature_inside(a->result.model.rc, &s, a->stress_of_b, n, at, &a->why);
    rb_rolling_solution_free(&s);
    return status;
}

int rb_api_stress_of(rb_api *a, int of_b)
{
    a->stress_of_b = of_b != 0;
    return RB_OK;
}

int rb_api_tractions(rb_api *a, int n, const double *x, const double *p, const double *q)
{
    rb_message reason = {.text = ""};
    const rb_option_set all = rb_case_options(a->words);

    for (int k = 0; k < all.n; k++)
        if (all.given[k] && !rb_case_is_of_tractions(all.options[k].name))
            return rb_api_ended(a, rb_refuse(&a->why, all.options[k].name,
                                             "with given tractions no contact is solved; "
                                             "leave it out"));
    if (rb_api_resolve(a) < 0)
        return a->status;
    double *rows = n > 0 ? rb_alloc((size_t)n, 3) : NULL;
    if (n > 0 && !rows)
        return rb_api_ended(a, rb_fail(&a->why, RB_ENOMEM, "out of memory"));
    for (int k = 0; k < n; k++) {
        rows[k] = stored(a, "mm", x[k]);
        rows[n + k] = stored(a, "MPa", p[k]);
        rows[2 * n + k] = stored(a, "MPa", q[k]);
    }
    rb_case_result *r = &a->result;
    rb_status s = rb_rolling_model_of_nodes(&rb_case_resolved(a->words)->rc, n, rows, rows + n,
                                            rows + 2 * n, &r->model, &r->solution, &reason);
    free(rows);
    if (s != RB_OK)
        rb_rolling_model_free(&r->model);
    return rb_api_ended(a, s == RB_OK ? s : rb_fail(&a->why, s, "%s", reason.text));
}

/* The model of the body that is asked for: A, or B in a mirror, to be freed. */
static rb_status begin_stress(rb_api *a, const char *arrays, rb_rolling_mirror **mirror,
                              const rb_rolling_model **model)
{
    *mirror = NULL;
    *model = &a->result.model;
    rb_api_forget_call(a);
    rb_api_forget_arrays(a, arrays);
    if (!a->result.model.state.p)
        return rb_fail(&a->why, RB_EINVAL, "%s",
                       a->result.has_errors
                           ? "the stress needs a case that is solved without error bars"
                           : "nothing is solved");
    if (!a->stress_of_b)
        return rb_rolling_stress_check(a->result.model.rc, &a->why);
    const rb_status s = rb_rolling_mirror_create(&a->result.model, mirror, &a->why);
    *model = s == RB_OK ? &(*mirror)->model : NULL;
    return s;
}

int rb_api_stress(rb_api *a, int nx, int ny, double depth)
{
    rb_rolling_stress_grid grid = {0};
    rb_rolling_mirror *mirror;
    const rb_rolling_model *model;
    rb_status s = begin_stress(a, "stress.", &mirror, &model);
    rb_api_call_begins(a);
    if (s == RB_OK)
        s = rb_rolling_stress_on_grid(model, nx, ny, stored(a, "mm", depth), &grid, &a->why);
    s = rb_api_call_ends(a, s);
    rb_rolling_mirror_free(mirror);
    if (s == RB_OK && a->stress_of_b)
        rb_rolling_mirror_grid(&grid);
    if (s == RB_OK)
        s = add_temperature(a, nx * ny, grid.at);
    if (s == RB_OK)
        s = keep_stress(a, nx, ny, grid.at);
    rb_rolling_stress_grid_free(&grid);
    return rb_api_ended(a, s);
}

int rb_api_stress_at(rb_api *a, int n, const double *xy)
{
    rb_rolling_stress *at = NULL;
    double *place = NULL;
    rb_rolling_mirror *mirror;
    const rb_rolling_model *model;
    rb_status s = begin_stress(a, "stress.", &mirror, &model);
    if (s == RB_OK && n < 1)
        s = rb_fail(&a->why, RB_EINVAL, "stress: expected at least one point, got %d", n);
    if (s == RB_OK && (!(at = calloc((size_t)n, sizeof *at)) || !(place = rb_alloc((size_t)n, 2))))
        s = RB_ENOMEM;
    for (int k = 0; s == RB_OK && k < 2 * n; k++)
        place[k] = stored(a, "mm", a->stress_of_b && k % 2 ? 0.0 - xy[k] : xy[k]);
    rb_api_call_begins(a);
    if (s == RB_OK)
        s = rb_rolling_stress_at(model, n, place, at, &a->why);
    s = rb_api_call_ends(a, s);
    rb_rolling_mirror_free(mirror);
    if (s == RB_OK && a->stress_of_b)
        rb_rolling_mirror_stress(n, at, NULL);
    if (s == RB_OK)
        s = add_temperature(a, n, at);
    if (s == RB_OK)
        s = keep_stress(a, n, 1, at);
    free(place);
    free(at);
    return rb_api_ended(a, s);
}

/* ---- Derivatives ------------------------------------------------------------------- */

static rb_status of_one_step(rb_api *a)
{
    return a->result.solution.n > 0 && a->result.model.state.p
               ? RB_OK
               : rb_fail(&a->why, RB_EINVAL,
                         "derivatives: of a solved case of one step, without error bars");
}

static rb_status differentiate(rb_api *a, int smooth)
{
    rb_api_forget_arrays(a, "derivative.");
    rb_case_derivatives_free(&a->derivatives);
    rb_api_call_begins(a);
    rb_status s = of_one_step(a);
    if (s == RB_OK)
        s = (smooth ? rb_case_differentiate_smoothly : rb_case_differentiate)(
            a->words, &a->result.model, 0, NULL, &a->derivatives, &a->why);
    s = rb_api_call_ends(a, s);
    if (s != RB_OK)
        rb_case_derivatives_free(&a->derivatives);
    return s;
}

int rb_api_derivatives(rb_api *a)
{
    rb_api_forget_call(a);
    return rb_api_ended(a, differentiate(a, 0));
}

int rb_api_smooth_derivatives(rb_api *a)
{
    rb_api_forget_call(a);
    return rb_api_ended(a, differentiate(a, 1));
}

/* What the derivatives of steps are computed from. */
static rb_status states_of_steps(rb_api *a)
{
    const rb_resolved_case *c = rb_case_resolved(a->words);
    const rb_rolling_history *h = &a->result.history;

    a->states.program = c->program.n > 0 ? &c->program : NULL;
    a->states.half_width = h->half_width;
    return h->n == 0 ? rb_fail(&a->why, RB_EINVAL,
                               "derivatives of steps need a case with steps that has been solved")
           : c->error
               ? rb_fail(&a->why, RB_EINVAL, "derivatives of steps: not together with error bars")
           : a->states.steps != h->n
               ? rb_fail(&a->why, RB_EINVAL, "derivatives of steps: not all steps were solved")
               : RB_OK;
}

int rb_api_step_derivatives(rb_api *a, const char *derivatives, const char *tolerance)
{
    rb_case_slopes *s = derivatives ? &a->slopes[API_SLOPES_HISTORY] : NULL;
    rb_rolling_history *h = &a->result.history;
    rb_case_tolerances t;

    rb_api_forget_call(a);
    if (derivatives) {
        rb_api_forget_notes(a);
        rb_api_forget_slopes(a, API_SLOPES_HISTORY);
    }
    if (tolerance) {
        rb_api_forget_arrays(a, "history.tolerance.");
        if (h->deviations)
            rb_rolling_history_free(h->deviations);
        free(h->deviations);
        h->deviations = NULL;
    }
    rb_status status = states_of_steps(a);
    rb_api_call_begins(a);
    if (status == RB_OK && derivatives)
        status = rb_case_slopes_choose(a->words, &rb_rolling_history_columns, derivatives,
                                       RB_CASE_SLOPES_MAX, s, &a->why);
    if (status == RB_OK && tolerance)
        status = rb_case_read_tolerances(a->words, tolerance, &t, &a->why);
    if (status == RB_OK)
        status =
            rb_case_slopes_of_steps(a->words, &a->states, s, tolerance ? &t : NULL, h, &a->why);
    status = rb_api_call_ends(a, status);
    if (derivatives)
        rb_case_slopes_note(s, &a->note);
    if (status != RB_OK && derivatives)
        rb_api_forget_slopes(a, API_SLOPES_HISTORY);
    return rb_api_ended(a, status);
}

int rb_api_check_derivatives(rb_api *a, const char *derivatives, const char *tolerance)
{
    const rb_resolved_case *c = rb_case_resolved(a->words);
    rb_case_slopes slopes = {0};
    rb_case_tolerances t;

    if (rb_api_resolve(a) < 0)
        return a->status;
    rb_status s = c->error ? rb_fail(&a->why, RB_EINVAL, "%s: not together with error bars",
                                     derivatives ? "derivatives" : "tolerances")
                           : RB_OK;
    if (s == RB_OK && derivatives)
        s = rb_case_slopes_choose(a->words, &rb_rolling_history_columns, derivatives,
                                  RB_CASE_SLOPES_MAX, &slopes, &a->why);
    if (s == RB_OK && tolerance)
        s = rb_case_read_tolerances(a->words, tolerance, &t, &a->why);
    if (s == RB_OK && (derivatives || (tolerance && rb_case_has_steps(c))))
        s = rb_case_slopes_check_steps(a->words, &a->why);
    rb_case_slopes_free(&slopes);
    return rb_api_ended(a, s);
}

int rb_api_tolerances(rb_api *a, const char *inputs)
{
    rb_case_tolerances t;

    if (a->result.history.n > 0)
        return rb_api_step_derivatives(a, NULL, inputs);
    rb_api_forget_arrays(a, "tolerance.");
    a->has_deviation = 0;
    rb_api_forget_call(a);
    rb_status s = of_one_step(a);
    if (s == RB_OK)
        s = rb_case_read_tolerances(a->words, inputs, &t, &a->why);
    if (s == RB_OK) {
        rb_api_call_begins(a);
        s = rb_api_call_ends(
            a, rb_case_deviations(a->words, &a->result.model, &t, &a->deviation, &a->why));
    }
    a->has_deviation = s == RB_OK;
    return rb_api_ended(a, s);
}

const char *rb_api_input(const rb_api *a, int k, const char *field, char *text, int size)
{
    const rb_case_derivatives *all = &a->derivatives;
    if (k < 0 || k >= all->n || size < 1)
        return NULL;
    const rb_case_derivative *of = &all->of[k];
    const described texts[] = {{"name", of->name},
                               {"unit", of->unit},
                               {"refusal", of->status == RB_OK ? NULL : of->why.text}};
    return field_of(3, texts, field, text, size);
}

/* ---- Cracks ------------------------------------------------------------------------ */

/* Typed values as they are given: rb_case_store reads plain numbers in the case's units. */
rb_status rb_api_set_crack(rb_api *a, int n, const char *const *name, const char *const *value,
                           rb_case_crack *crack, rb_message *why)
{
    int given[API_CRACK_OPTIONS] = {0}, plain[API_CRACK_OPTIONS] = {0}, k;
    const rb_option_set set = {rb_case_crack_options, rb_case_crack_options_n, crack, given, plain};
    for (int i = 0; i < n; i++) {
        rb_guess guess = {.word = name[i]};
        if (!rb_option_find(1, &set, name[i], strlen(name[i]), &k, &guess))
            return rb_fail(why, RB_EINVAL, "crack: unknown option '%.60s'%s", name[i],
                           rb_guess_text(&guess, ""));
        char label[80];
        snprintf(label, sizeof label, "--%.60s", name[i]);
        const rb_status s = rb_option_assign(&set, k, RB_GIVEN_ARGUMENT, label, value[i], why);
        if (s != RB_OK)
            return s;
    }
    rb_case_store(a->words, &set, crack);
    return RB_OK;
}

/* What a picture of the open crack is drawn from. */
static rb_status keep_faces(rb_api *a, const rb_case_crack_result *r)
{
    const rb_crack_history *h = &r->history;
    const rb_crack_path *path = &r->shape.path;
    const int n = h->nodes, steps = h->n;
    rb_crack *crack = NULL;
    static const char *const names[] = {
        "crack.node.x",  "crack.node.y",  "crack.node.length", "crack.node.t_x", "crack.node.t_y",
        "crack.opening", "crack.sliding", "crack.pressure",    "crack.friction", "crack.zone"};
    enum { NODES = 5, ALL = sizeof names / sizeof *names };
    api_array *at[ALL];
    rb_status s = rb_crack_create(&r->shape, &crack, &a->why);

    for (int k = 0; k < ALL && s == RB_OK; k++) {
        at[k] = rb_api_make_array(a, names[k], n, k < NODES ? 1 : steps);
        s = at[k] ? RB_OK : RB_ENOMEM;
    }
    if (s == RB_OK)
        rb_crack_places(crack, at[0]->at, at[1]->at, at[2]->at, at[3]->at, at[4]->at);
    for (int k = 0; k < n * steps && s == RB_OK; k++) {
        const size_t N = (size_t)(k / n) * 2 * (size_t)n + (size_t)(k % n), T = N + (size_t)n;
        at[5]->at[k] = h->D[N];
        at[6]->at[k] = h->D[T];
        at[7]->at[k] = h->r[N] / at[2]->at[k % n];
        at[8]->at[k] = h->r[T] / at[2]->at[k % n];
        at[9]->at[k] = h->zone[k];
    }
    rb_crack_free(crack);
    if (s == RB_OK && (!rb_api_copy_array(a, "crack.path.x", path->pieces + 1, 1, path->x) ||
                       !rb_api_copy_array(a, "crack.path.y", path->pieces + 1, 1, path->y)))
        s = RB_ENOMEM;
    return s;
}

static int count_step(int step, int steps, void *context)
{
    rb_api *a = context;
    a->total = steps;
    a->done = step;
    return a->stopped;
}

int rb_api_crack(rb_api *a, int n, const char *const *names, const char *const *values)
{
    rb_case_crack crack = rb_case_crack_defaults();
    rb_case_crack_result result = {0};
    rb_api_forget_call(a);
    rb_api_forget_arrays(a, "crack.");
    rb_status s = rb_case_resolve(a->words, &a->why);
    if (s == RB_OK)
        s = rb_api_set_crack(a, n, names, values, &crack, &a->why);
    rb_api_call_begins(a);
    if (s == RB_OK)
        s = rb_case_crack_solve(rb_case_resolved(a->words), &crack,
                                &(rb_crack_observer){count_step, a}, &result, &a->why);
    s = rb_api_call_ends(a, s);
    /* Columns over the positions and over the lengths, and the numbers of the pass. */
    const entries kept[] = {
        {"crack.", &rb_case_crack_columns, &result.history, result.history.n, 1, 0},
        {"crack.growth.", &rb_case_crack_growth_columns, &result.growth, result.growth.n, 1, 0},
        {"crack.summary.", &rb_case_crack_scalars, &result.summary, 1, 1, sizeof result.summary}};
    for (int t = 0; t < 3; t++)
        for (int k = 0; k < kept[t].table->n && s == RB_OK; k++)
            if (has_entries(&kept[t], &kept[t].table->row[k]) &&
                !make_entries(a, &kept[t], &kept[t].table->row[k]))
                s = RB_ENOMEM;
    if (s == RB_OK)
        s = keep_faces(a, &result);
    rb_case_crack_free(&result);
    return rb_api_ended(a, s);
}

static int stop_wear(rb_rolling_solution *s, const rb_rolling_wear_history *h, int step, int steps,
                     void *context)
{
    (void)s;
    (void)h;
    rb_api *a = context;
    a->total = steps;
    a->done = step;
    return a->stopped;
}

int rb_api_wear(rb_api *a, const char *law, double coefficient, double share, double slide,
                double cycles, int steps, int quarter)
{
    const rb_rolling_wear how = {.law = strcmp(law, "archard") == 0 ? RB_WEAR_ARCHARD
                                                                    : RB_WEAR_DISSIPATION,
                                 .coefficient = stored(a, "1/MPa", coefficient),
                                 .share = share,
                                 .slides = !isnan(slide),
                                 .way = isnan(slide) ? cycles : stored(a, "mm", slide),
                                 .steps = steps,
                                 .increments = quarter};
    rb_rolling_solution last = {0};
    rb_api_forget_call(a);
    rb_api_forget_arrays(a, "wear.");
    rb_rolling_wear_history_free(&a->wear);
    rb_status s = rb_api_check_refusals(a, &a->why);
    if (s == RB_OK && how.law == RB_WEAR_DISSIPATION && strcmp(law, "dissipation") != 0)
        s = rb_fail(&a->why, RB_EINVAL, "wear law: expected archard or dissipation, got '%.100s'",
                    law);
    if (s == RB_OK && !isnan(slide) && !isnan(cycles))
        s = rb_fail(&a->why, RB_EINVAL, "slide and cycles exclude each other");
    if (s == RB_OK)
        s = rb_case_resolve(a->words, &a->why);
    rb_api_call_begins(a);
    if (s == RB_OK)
        s = (rb_case_resolved(a->words)->error ? rb_rolling_wear_with_errors : rb_rolling_wear_run)(
            &rb_case_resolved(a->words)->rc, &how, &(rb_rolling_wear_observer){stop_wear, a},
            &a->wear, &last, &a->why);
    s = rb_api_call_ends(a, s);
    if (s >= 0 && last.worn &&
        (!rb_api_copy_array(a, "wear.profile.x", last.n, 1, last.x) ||
         !rb_api_copy_array(a, "wear.profile.depth", last.n, 1, last.worn)))
        s = RB_ENOMEM;
    rb_rolling_solution_free(&last);
    return rb_api_ended(a, s);
}

int rb_api_stress_maxima(rb_api *a, double depth)
{
    rb_rolling_stress_maxima m;
    rb_rolling_mirror *mirror;
    const rb_rolling_model *model;
    rb_status s = begin_stress(a, "maxima.", &mirror, &model);
    rb_api_call_begins(a);
    if (s == RB_OK)
        s = rb_rolling_stress_maxima_find(model, stored(a, "mm", depth), &m, &a->why);
    s = rb_api_call_ends(a, s);
    rb_rolling_mirror_free(mirror);
    if (s == RB_OK && a->stress_of_b)
        rb_rolling_mirror_stress(0, NULL, &m);
    for (int k = 0; s == RB_OK && rb_rolling_maximum(&m, k); k++) {
        const rb_rolling_extremum *at = rb_rolling_maximum(&m, k);
        const double x[] = {at->value, at->x, at->y, at->material};
        char name[64];
        snprintf(name, sizeof name, "maxima.%s", rb_rolling_maxima_scalars.row[3 * k].name);
        if (!rb_api_copy_array(a, name, 4, 1, x))
            s = RB_ENOMEM;
    }
    return rb_api_ended(a, s);
}
