/* A case, its results and the steps of its solution as numbers, text and arrays by name.
 */
#include "rollbem/api.h"

#include "rollbem/case.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* An array that was asked for. */
typedef struct {
    char name[32];
    int rows, columns;
    double *at; /* owned */
} array;

enum { ARRAYS = 96 };

struct rb_api {
    rb_case *words;
    rb_case_result result;
    rb_rolling_model kept; /* of the last case, where only what drives it has changed */
    rb_rolling_curve curve;
    rb_rolling_lcp lcp;
    int pivots; /* seen so far */
    double *tableau;
    int *nonbasis; /* the last pivot's, both owned */
    rb_status status;
    rb_message why;
    array made[ARRAYS];
    int arrays;
};

/* ---- Arrays -------------------------------------------------------------------------
 */

static array *find_array(rb_api *a, const char *name)
{
    for (int k = 0; k < a->arrays; k++)
        if (strcmp(a->made[k].name, name) == 0)
            return &a->made[k];
    return NULL;
}

static void forget_arrays(rb_api *a, const char *beginning)
{
    int kept = 0;
    for (int k = 0; k < a->arrays; k++)
        if (strncmp(a->made[k].name, beginning, strlen(beginning)) == 0)
            free(a->made[k].at);
        else
            a->made[kept++] = a->made[k];
    a->arrays = kept;
}

/* A new array of zeros.  NULL: no memory. */
static array *make_array(rb_api *a, const char *name, int rows, int columns)
{
    if (a->arrays == ARRAYS)
        return NULL;
    array *made = &a->made[a->arrays];
    snprintf(made->name, sizeof made->name, "%s", name);
    made->rows = rows;
    made->columns = columns;
    made->at = rb_alloc((size_t)rows, (size_t)columns);
    if (!made->at)
        return NULL;
    memset(made->at, 0, sizeof(double) * (size_t)rows * (size_t)columns);
    a->arrays++;
    return made;
}

static array *copy_of(rb_api *a, const char *name, int rows, int columns, const double *x)
{
    array *made = x ? make_array(a, name, rows, columns) : NULL;
    if (made)
        memcpy(made->at, x, sizeof(double) * (size_t)rows * (size_t)columns);
    return made;
}

/* Adds one column to an array that grows step by step. */
static rb_status add_column(rb_api *a, const char *name, int rows, const double *x)
{
    array *to = find_array(a, name);
    if (!to)
        return copy_of(a, name, rows, 1, x) ? RB_OK : RB_ENOMEM;
    const size_t size = sizeof(double) * (size_t)rows * ((size_t)to->columns + 1);
    double *longer = realloc(to->at, size);
    if (!longer)
        return RB_ENOMEM;
    to->at = longer;
    memcpy(&longer[(size_t)rows * (size_t)to->columns], x, sizeof(double) * (size_t)rows);
    to->columns++;
    return RB_OK;
}

static array *table_column(rb_api *a, const rb_rolling_results *table, const void *owner,
                           int rows, const char *name, const char *column)
{
    for (int k = 0; k < table->n && rows > 0; k++)
        if (strcmp(table->row[k].name, column) == 0) {
            array *made = make_array(a, name, rows, 1);
            for (int i = 0; made && i < rows; i++)
                made->at[i] = rb_rolling_entry(&table->row[k], owner, i);
            return made;
        }
    return NULL;
}

/* ---- A case -------------------------------------------------------------------------
 */

static int ended(rb_api *a, rb_status s)
{
    a->status = s;
    if (s >= 0)
        snprintf(a->why.text, sizeof a->why.text, "%s",
                 s == RB_OK ? "" : rb_status_text(s));
    return s;
}

/* Options that change neither bodies nor mesh: the flexibility may serve again. */
static int drives(const char *name)
{
    static const char *const driving[] = {"mu",          "load",  "approach",
                                          "half-width",  "shift", "creep",
                                          "creep-ratio", "force", "force-ratio"};
    for (size_t k = 0; k < sizeof driving / sizeof *driving; k++)
        if (strcmp(name, driving[k]) == 0)
            return 1;
    return 0;
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
    forget_arrays(a, "");
    rb_rolling_curve_free(&a->curve);
    rb_rolling_lcp_free(&a->lcp);
    rb_case_result_free(&a->result);
    memset(&a->curve, 0, sizeof a->curve);
    memset(&a->lcp, 0, sizeof a->lcp);
    memset(&a->result, 0, sizeof a->result);
}

rb_api *rb_api_create(void)
{
    rb_api *a = calloc(1, sizeof *a);
    if (a && !(a->words = rb_case_create(RB_CASE_SINGLE))) {
        free(a);
        a = NULL;
    }
    return a;
}

void rb_api_free(rb_api *a)
{
    if (!a)
        return;
    forget(a, 0);
    rb_case_free(a->words);
    free(a);
}

int rb_api_set(rb_api *a, const char *name, const char *text)
{
    forget(a, drives(name));
    return ended(a, rb_case_set(a->words, name, text, RB_GIVEN_ARGUMENT, &a->why));
}

int rb_api_settle(rb_api *a)
{
    forget(a, 1);
    return ended(a, rb_case_settle(a->words, &a->why));
}

static int keep_step(const rb_rolling_model *model, const rb_rolling_history *history,
                     int step, int steps, void *context)
{
    (void)history;
    (void)steps;
    rb_api *a = context;
    const int n = model->mesh.n;
    if (!model->state.p)
        return 0;
    if (step == 0) /* a run may begin anew on a wider zone */
        forget_arrays(a, "step.");
    double *row = rb_alloc((size_t)n, 1);
    rb_status s = row ? RB_OK : RB_ENOMEM;
    for (int i = 0; row && i < n; i++)
        row[i] = model->state.zone[i];
    if (s == RB_OK)
        s = add_column(a, "step.zone", n, row);
    for (int i = 0; row && i < n; i++)
        row[i] = 0.5 * (model->mesh.ends[i] + model->mesh.ends[i + 1]);
    if (s == RB_OK && !find_array(a, "step.x"))
        s = add_column(a, "step.x", n, row);
    if (s == RB_OK)
        s = add_column(a, "step.p", n, model->state.p);
    if (s == RB_OK)
        s = add_column(a, "step.q", n, model->state.q);
    free(row);
    return s != RB_OK;
}

int rb_api_solve(rb_api *a)
{
    if (rb_api_settle(a) < 0)
        return a->status;
    a->result.model = a->kept;
    memset(&a->kept, 0, sizeof a->kept);
    const rb_status s =
        rb_case_solve_again(rb_case_settled(a->words), keep_step, a, &a->result, &a->why);
    return ended(a, s < 0 ? rb_case_blame(a->words, s, &a->why) : s);
}

int rb_api_status(const rb_api *a)
{
    return a->status;
}

const char *rb_api_message(const rb_api *a)
{
    return a->why.text;
}

/* ---- Descriptions -------------------------------------------------------------------
 */

static const char *write_choices(const rb_option *o, char *text, int size)
{
    int used = 0;
    text[0] = '\0';
    for (const rb_choice *c = o->choices; c && c->name && used < size; c++)
        used += snprintf(text + used, (size_t)(size - used), "%s%s", used ? " " : "",
                         c->name);
    return text;
}

static const char *write_default(const rb_option *o, char *text, int size)
{
    rb_case *c = rb_case_create(RB_CASE_SINGLE);
    char room[64];
    if (!c)
        return NULL;
    const char *value = o->unset ? o->unset : rb_option_text(o, rb_case_settled(c), room);
    snprintf(text, (size_t)size, "%s", value ? value : "");
    rb_case_free(c);
    return text;
}

static const char *written(const char *what, char *text, int size)
{
    snprintf(text, (size_t)size, "%s", what ? what : "");
    return text;
}

static const char *written_number(double x, char *text, int size)
{
    snprintf(text, (size_t)size, "%.17g", x);
    return text;
}

const char *rb_api_option(int k, const char *field, char *text, int size)
{
    static const char *const kinds[] = {
        [RB_OPTION_GROUP] = "group",     [RB_OPTION_NUMBER] = "number",
        [RB_OPTION_INTEGER] = "integer", [RB_OPTION_CHOICE] = "choice",
        [RB_OPTION_FLAG] = "flag",       [RB_OPTION_TEXT] = "text"};
    int n;
    const rb_option *all = rb_case_describe(&n);
    if (k < 0 || k >= n || size < 1)
        return NULL;
    const rb_option *o = &all[k];
    const int is_group = o->kind == RB_OPTION_GROUP;

    if (strcmp(field, "name") == 0)
        return written(o->name, text, size);
    if (strcmp(field, "section") == 0)
        return written(is_group ? o->name : rb_case_section(o), text, size);
    if (strcmp(field, "kind") == 0)
        return written(kinds[o->kind], text, size);
    if (strcmp(field, "unit") == 0)
        return written(o->unit, text, size);
    if (strcmp(field, "help") == 0)
        return written(o->help, text, size);
    if (strcmp(field, "word") == 0)
        return written(o->word, text, size);
    if (strcmp(field, "choices") == 0)
        return write_choices(o, text, size);
    if (strcmp(field, "expected") == 0)
        return is_group ? written("", text, size)
                        : rb_option_expected(o, text, (size_t)size);
    if (strcmp(field, "from") == 0)
        return written_number(o->range.from, text, size);
    if (strcmp(field, "to") == 0)
        return written_number(o->range.to, text, size);
    if (strcmp(field, "excludes") == 0)
        return written_number(o->excludes, text, size);
    if (strcmp(field, "default") == 0)
        return is_group ? written("", text, size) : write_default(o, text, size);
    return NULL;
}

const char *rb_api_result(const char *table, int k, const char *field, char *text,
                          int size)
{
    static const char *const kinds[] = {[RB_RESULT_NUMBER] = "number",
                                        [RB_RESULT_WHOLE] = "whole",
                                        [RB_RESULT_SECONDS] = "seconds"};
    const struct {
        const char *name;
        const rb_rolling_results *rows;
    } tables[] = {{"number", &rb_rolling_solution_scalars},
                  {"column", &rb_rolling_solution_columns},
                  {"step", &rb_rolling_history_columns},
                  {"point", &rb_rolling_curve_columns}};

    for (size_t t = 0; t < sizeof tables / sizeof *tables; t++) {
        if (strcmp(table, tables[t].name) != 0 || k < 0 || k >= tables[t].rows->n)
            continue;
        const rb_rolling_result *r = &tables[t].rows->row[k];
        const char *what = strcmp(field, "name") == 0      ? r->name
                           : strcmp(field, "unit") == 0    ? (r->unit ? r->unit : "")
                           : strcmp(field, "kind") == 0    ? kinds[r->kind]
                           : strcmp(field, "meaning") == 0 ? r->meaning
                                                           : NULL;
        return what ? written(what, text, size) : NULL;
    }
    return NULL;
}

const char *rb_api_value(const rb_api *a, const char *name, char *text, int size)
{
    const rb_option *o = rb_case_option(name);
    char room[64];
    if (!o || o->kind == RB_OPTION_GROUP)
        return NULL;
    return written(rb_option_text(o, rb_case_settled(a->words), room), text, size);
}

double rb_api_number(const rb_api *a, const char *name)
{
    const rb_settled_case *c = rb_case_settled(a->words);
    const rb_rolling_results *table = &rb_rolling_solution_scalars;
    if (strcmp(name, "carter") == 0)
        return rb_rolling_carter_holds(&c->rc);
    if (strcmp(name, "radius") == 0)
        return c->derived.radius;
    if (strcmp(name, "modulus") == 0)
        return c->derived.modulus;
    if (strcmp(name, "hertz_load") == 0)
        return c->derived.load;
    for (int k = 0; k < table->n && a->result.solution.n > 0; k++)
        if (strcmp(table->row[k].name, name) == 0)
            return rb_rolling_number(&table->row[k], &a->result.solution);
    return NAN;
}

/* ---- Matrices -----------------------------------------------------------------------
 */

static array *boundary_matrices(rb_api *a, const char *name)
{
    const rb_bem_mesh *mesh = rb_bem_system_mesh(a->result.model.bodies.system_a);
    const rb_rolling_body *body = &a->result.model.rc.a;
    array *H = make_array(a, "H", 2 * mesh->n, 2 * mesh->n);
    array *G = make_array(a, "G", 2 * mesh->n, 2 * mesh->n);
    if (!H || !G ||
        rb_bem_assemble(mesh, rb_bem_material_from_young(body->young, body->poisson),
                        H->at, G->at, 2 * mesh->n, &a->why) != RB_OK) {
        forget_arrays(a, "H");
        forget_arrays(a, "G");
        return NULL;
    }
    return strcmp(name, "H") == 0 ? H : G;
}

static array *boundary_array(rb_api *a, const char *name)
{
    const rb_bem_system *system = a->result.model.bodies.system_a;
    if (!system)
        return NULL;
    const rb_bem_mesh *mesh = rb_bem_system_mesh(system);
    if (strcmp(name, "mesh.x0") == 0)
        return copy_of(a, name, mesh->n, 1, mesh->x0);
    if (strcmp(name, "mesh.y0") == 0)
        return copy_of(a, name, mesh->n, 1, mesh->y0);
    if (strcmp(name, "mesh.x1") == 0)
        return copy_of(a, name, mesh->n, 1, mesh->x1);
    if (strcmp(name, "mesh.y1") == 0)
        return copy_of(a, name, mesh->n, 1, mesh->y1);
    if (strcmp(name, "H") == 0 || strcmp(name, "G") == 0)
        return boundary_matrices(a, name);
    return NULL;
}

static array *model_array(rb_api *a, const char *name)
{
    const rb_rolling_model *model = &a->result.model;
    const int n = model->mesh.n, size = a->lcp.size;
    if (strcmp(name, "ends") == 0)
        return copy_of(a, name, n + 2, 1, model->mesh.ends);
    if (strcmp(name, "gap0") == 0)
        return copy_of(a, name, n, 1, model->mesh.gap);
    if (strcmp(name, "F") == 0)
        return copy_of(a, name, 2 * n + 2, 2 * n, model->bodies.F);
    if (strcmp(name, "lcp.M") == 0)
        return copy_of(a, name, size, size, a->lcp.M);
    if (strcmp(name, "lcp.q") == 0)
        return copy_of(a, name, size, 1, a->lcp.b);
    return boundary_array(a, name);
}

const double *rb_api_array(rb_api *a, const char *name, int *rows, int *columns)
{
    const rb_case_result *r = &a->result;
    array *made = find_array(a, name);
    if (!made && strncmp(name, "history.", 8) == 0)
        made = table_column(a, &rb_rolling_history_columns, &r->history, r->history.n,
                            name, name + 8);
    if (!made && strncmp(name, "curve.", 6) == 0)
        made = table_column(a, &rb_rolling_curve_columns, &a->curve, a->curve.n, name,
                            name + 6);
    if (!made)
        made = table_column(a, &rb_rolling_solution_columns, &r->solution, r->solution.n,
                            name, name);
    if (!made && r->model.mesh.n > 0)
        made = model_array(a, name);
    *rows = made ? made->rows : 0;
    *columns = made ? made->columns : 0;
    return made ? made->at : NULL;
}

/* ---- Further questions --------------------------------------------------------------
 */

int rb_api_curve(rb_api *a, double from, double to, int points)
{
    forget_arrays(a, "curve.");
    rb_rolling_curve_free(&a->curve);
    memset(&a->curve, 0, sizeof a->curve);
    return ended(a, rb_rolling_curve_solve(&rb_case_settled(a->words)->rc, 0, from, to,
                                           points, &a->curve, &a->why));
}

static int has_model(rb_api *a)
{
    if (a->result.model.state.p && a->result.model.bodies.F)
        return 1;
    ended(a, rb_fail(&a->why, RB_EINVAL, "nothing is solved whose matrices are at hand"));
    return 0;
}

/* The column of the entering variable and the values of the basic ones, before the pivot:
 * of the last pivot's tableau, or of z0, which enters first with a column of ones. */
static void before_pivot(const rb_api *a, const rb_lcp_pivot *p, double *value,
                         double *column)
{
    const size_t n = (size_t)p->n;
    for (size_t i = 0; i < n; i++) {
        value[i] = a->lcp.b[i];
        column[i] = 1.0;
    }
    if (a->pivots == 0)
        return;
    memcpy(value, &a->tableau[n * (n + 1)], n * sizeof *value);
    for (size_t j = 0; j <= n; j++)
        if (a->nonbasis[j] == p->entering)
            memcpy(column, &a->tableau[n * j], n * sizeof *column);
}

static rb_status keep_tractions(rb_api *a, const rb_lcp_pivot *p, const double *value)
{
    const int n = a->result.model.mesh.n;
    double *z = rb_alloc((size_t)p->n, 1);
    rb_rolling_state state = {0};
    rb_status s = z ? rb_rolling_state_alloc(n, &state) : RB_ENOMEM;
    for (int i = 0; z && i < p->n; i++)
        z[i] = 0.0;
    for (int i = 0; s == RB_OK && i < p->n; i++)
        if (p->basis[i] >= p->n && p->basis[i] < 2 * p->n)
            z[p->basis[i] - p->n] = value[i];
    if (s == RB_OK) {
        rb_rolling_lcp_recover(&a->result.model.problem, &a->lcp, z, &state);
        s = add_column(a, "pivot.p", n, state.p);
    }
    if (s == RB_OK)
        s = add_column(a, "pivot.q", n, state.q);
    rb_rolling_state_free(&state);
    free(z);
    return s;
}

static rb_status keep_columns(rb_api *a, const rb_lcp_pivot *p, double *work)
{
    const size_t n = (size_t)p->n;
    double *value = work, *column = work + n, *basis = work + 2 * n;
    const double entering = p->entering, leaving = p->leaving, row = p->row;
    const struct {
        const char *name;
        const double *x;
        int rows;
    } kept[] = {
        {"pivot.before", value, p->n},    {"pivot.column", column, p->n},
        {"pivot.basis", basis, p->n},     {"pivot.value", &p->tableau[n * (n + 1)], p->n},
        {"pivot.entering", &entering, 1}, {"pivot.leaving", &leaving, 1},
        {"pivot.row", &row, 1},           {"pivot.ratio", &p->ratio, 1},
        {"pivot.z0", &p->z0, 1}};
    rb_status s = RB_OK;

    before_pivot(a, p, value, column);
    for (size_t i = 0; i < n; i++)
        basis[i] = p->basis[i];
    for (size_t k = 0; s == RB_OK && k < sizeof kept / sizeof *kept; k++)
        s = add_column(a, kept[k].name, kept[k].rows, kept[k].x);
    return s == RB_OK ? keep_tractions(a, p, &p->tableau[n * (n + 1)]) : s;
}

static void each_pivot(const rb_lcp_pivot *p, void *context)
{
    rb_api *a = context;
    const size_t n = (size_t)p->n;
    double *work = rb_alloc(3 * n, 1);

    if (a->status == RB_OK)
        a->status = work ? keep_columns(a, p, work) : RB_ENOMEM;
    free(work);
    memcpy(a->tableau, p->tableau, n * (n + 2) * sizeof *a->tableau);
    memcpy(a->nonbasis, p->nonbasis, (n + 1) * sizeof *a->nonbasis);
    a->pivots++;
}

static rb_status follow_pivots(rb_api *a)
{
    const size_t n = (size_t)a->lcp.size;
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

    rb_status s = RB_ENOMEM;
    if (z && a->tableau && a->nonbasis)
        s = rb_lcp_lemke(a->lcp.size, a->lcp.M, a->lcp.size, a->lcp.b, &options, z,
                         &info);
    if (s < 0)
        rb_fail(&a->why, s, "%s", s == RB_ENOMEM ? "out of memory" : info.msg.text);
    if (s >= 0 && a->status != RB_OK)
        s = rb_fail(&a->why, a->status, "out of memory");
    free(z);
    free(a->tableau);
    free(a->nonbasis);
    a->tableau = NULL;
    a->nonbasis = NULL;
    return s;
}

int rb_api_pivots(rb_api *a)
{
    const rb_rolling_model *model = &a->result.model;
    if (!has_model(a))
        return a->status;
    forget_arrays(a, "pivot.");
    forget_arrays(a, "lcp.");
    rb_rolling_lcp_free(&a->lcp);
    memset(&a->lcp, 0, sizeof a->lcp);
    rb_status s = rb_rolling_lcp_first(&model->problem, &model->rc, &model->state,
                                       &a->lcp, &a->why);
    return ended(a, s == RB_OK ? follow_pivots(a) : s);
}

const char *rb_api_variable(const rb_api *a, int variable, char *text, int size)
{
    char name[RB_ROLLING_VARIABLE];
    if (variable < 0 || variable > 2 * a->lcp.size || a->lcp.size == 0)
        return NULL;
    return written(
        rb_rolling_lcp_variable(&a->lcp, a->result.model.mesh.n, variable, name), text,
        size);
}

int rb_api_guess(rb_api *a, int n, const int *zone)
{
    rb_rolling_model *model = &a->result.model;
    if (!has_model(a))
        return a->status;
    if (n != model->mesh.n)
        return ended(
            a, rb_fail(&a->why, RB_EINVAL, "%d zones: expected %d", n, model->mesh.n));
    rb_rolling_state state = {0};
    double *gap = rb_alloc((size_t)n, 1);
    rb_status s = gap ? rb_rolling_state_alloc(n, &state) : RB_ENOMEM;
    forget_arrays(a, "guess.");
    if (s == RB_OK) {
        memcpy(state.zone, zone, (size_t)n * sizeof *zone);
        s = rb_rolling_try_zones(&model->problem, &state, gap);
    }
    if (s == RB_OK &&
        !(copy_of(a, "guess.p", n, 1, state.p) && copy_of(a, "guess.q", n, 1, state.q) &&
          copy_of(a, "guess.gap", n, 1, gap) &&
          copy_of(a, "guess.shift", n, 1, state.lambda)))
        s = RB_ENOMEM;
    if (s < 0)
        rb_fail(&a->why, s, "%s", rb_status_text(s));
    rb_rolling_state_free(&state);
    free(gap);
    return ended(a, s);
}

static rb_status keep_stress(rb_api *a, const rb_rolling_stress_grid *grid)
{
    static const struct {
        const char *name;
        size_t at;
    } fields[] = {{"stress.x", offsetof(rb_rolling_stress, x)},
                  {"stress.y", offsetof(rb_rolling_stress, y)},
                  {"stress.sxx", offsetof(rb_rolling_stress, sxx)},
                  {"stress.syy", offsetof(rb_rolling_stress, syy)},
                  {"stress.sxy", offsetof(rb_rolling_stress, sxy)},
                  {"stress.max_shear", offsetof(rb_rolling_stress, max_shear)},
                  {"stress.von_mises", offsetof(rb_rolling_stress, von_mises)},
                  {"stress.hydrostatic", offsetof(rb_rolling_stress, hydrostatic)}};
    for (size_t k = 0; k < sizeof fields / sizeof *fields; k++) {
        array *made = make_array(a, fields[k].name, grid->nx, grid->ny);
        if (!made)
            return rb_fail(&a->why, RB_ENOMEM, "out of memory");
        for (int i = 0; i < grid->nx * grid->ny; i++)
            memcpy(&made->at[i], (const char *)&grid->at[i] + fields[k].at,
                   sizeof(double));
    }
    return RB_OK;
}

int rb_api_stress(rb_api *a, int nx, int ny, double depth)
{
    rb_rolling_stress_grid grid = {0};
    if (!a->result.model.state.p)
        return ended(a, rb_fail(&a->why, RB_EINVAL, "nothing is solved"));
    forget_arrays(a, "stress.");
    rb_status s = rb_rolling_stress_check(&a->result.model.rc, &a->why);
    if (s == RB_OK)
        s = rb_rolling_stress_on_grid(&a->result.model, nx, ny, depth, &grid, &a->why);
    if (s == RB_OK)
        s = keep_stress(a, &grid);
    rb_rolling_stress_grid_free(&grid);
    return ended(a, s);
}
