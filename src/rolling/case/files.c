/* The tables that a case names: gap, irregularity, wear, friction over x, history. */
#include "rolling/case/words.h"

#include <math.h>
#include <stdio.h>

#include <stdlib.h>
#include <string.h>

/* A confined case (a certificate's) reads only harmless files in its folder, and no message quotes
 * their content. */
void rb_case_confine(rb_case *c, const char *folder)
{
    c->confined = 1;
    c->folder = folder;
}

rb_status rb_case_without_content(const rb_case *c, const char *path, rb_status s, rb_message *why)
{
    return c->confined && s == RB_EFORMAT
               ? rb_fail(why, s, "%s: not what is expected of this file", path)
               : s;
}

rb_status rb_case_read_input(const rb_case *c, const char *path, char **text, size_t *size,
                             rb_message *why)
{
    const rb_status s = c->confined ? rb_io_check_harmless(path, c->folder, why) : RB_OK;
    *text = NULL;
    return s == RB_OK ? rb_io_read_text(path, text, size, why) : s;
}

/* Where the bodies are apart, a table that --history-table has written has no ratio of forces and
 * no edges of the contact: they are not read, and 0 stands for them. */
static void fill_apart(char *text)
{
    if (!strstr(text, "force_ratio") || !strstr(text, "residual"))
        return;
    for (char *at = text; (at = strstr(at, "NaN")); at += 3)
        memcpy(at, "0  ", 3);
}

/* Text or spreadsheet, in whatever form; the table owns its numbers. */
static rb_status read_table(const rb_case *c, const char *path, int is_history, rb_io_table *t,
                            rb_message *why)
{
    char *text = NULL;
    size_t size;
    rb_status s = c->confined ? rb_io_check_harmless(path, c->folder, why) : RB_OK;
    if (s == RB_OK)
        s = rb_io_read_spreadsheet(path, &text, &size, why);
    if (s != RB_OK)
        return s;
    if (is_history)
        fill_apart(text);
    s = rb_io_table_parse(path, text, t, why);
    free(text);
    return rb_case_without_content(c, path, s, why);
}

static void free_table(case_table *t)
{
    if (!t->borrowed) {
        rb_io_table_free(&t->table);
        free(t->stack);
    }
    *t = (case_table){.path = NULL};
}

static void free_profile(case_profile *p)
{
    if (!p->borrowed)
        rb_rolling_profile_free(p->curve);
    *p = (case_profile){.curve = NULL};
}

/* 1: the same file has been read in the same units, so that its numbers are kept. */
static int is_read(const case_table *t, const char *path, rb_units units)
{
    return t->path && strcmp(t->path, path) == 0 && t->units == units;
}

/* Of the numbers in the file that an option names. */
static rb_units units_of_file(const rb_case *c, const char *option)
{
    return rb_case_units(c, rb_case_given(c, option));
}

#define OF_X(name, also, unit)                                                                     \
    {                                                                                              \
        {"x", "position|pos|coordinate", "mm", RB_IO_COLUMN_NEEDED},                               \
        {                                                                                          \
            name, also, unit, RB_IO_COLUMN_NEEDED                                                  \
        }                                                                                          \
    }

/* What stands over x in each of the tables.  A height is none of the gap's names: of a profile it
 * grows where the gap falls. */
static const rb_io_column over_x[CASE_TABLES][2] = {
    [CASE_GAP] = OF_X("gap", "gap0|g|g0|y|z|clearance|separation|initial gap", "mm"),
    [CASE_IRREGULARITY] = OF_X("gap", "depth|irregularity", "mm"),
    [CASE_WORN] = OF_X("depth", "worn|worn depth|wear depth|gap", "mm"),
    [CASE_FRICTION] =
        OF_X("mu", "friction|friction coefficient|coefficient of friction|cof|f", "-")};

/* over borrows the numbers of the table, which is read only where it has changed. */
static rb_status read_over_x(const rb_case *c, case_table *t, const char *path, rb_units units,
                             rb_rolling_table *over, rb_message *why)
{
    if (!is_read(t, path, units)) {
        const double *x[2];
        free_table(t);
        rb_status s = read_table(c, path, 0, &t->table, why);
        if (s == RB_OK)
            s = rb_case_without_content(
                c, path,
                rb_io_table_assign(path, &t->table, 2, over_x[t - c->table], units, x, why), why);
        if (s != RB_OK) {
            free_table(t);
            return s;
        }
        *t = (case_table){.table = t->table, .path = path, .units = units, .x = x[0], .y = x[1]};
    }
    *over = (rb_rolling_table){t->table.rows, t->x, t->y};
    return RB_OK;
}

int rb_case_gap_rows(const rb_case *c, const double **x, const double **gap)
{
    const case_table *t = &c->table[CASE_GAP];

    if (c->resolved.rc.gap != RB_GAP_TABLE || !t->x)
        return 0;
    *x = t->x;
    *gap = t->y;
    return t->table.rows;
}

static rb_status read_profile(rb_case *c, rb_message *why)
{
    rb_resolved_case *resolved = &c->resolved;
    const rb_units units = units_of_file(c, "gap");
    const double noise = resolved->gap_smoothing;
    const int is_punch = resolved->rc.mesh == RB_MESH_PUNCH;
    rb_rolling_table gap;
    if (resolved->rc.gap != RB_GAP_TABLE)
        return rb_case_refuse_given(c, "gap-smoothing", "it needs a gap from a file", why);
    /* The spline depends on the points, on their noise and on whether the table is a punch. */
    if (!is_read(&c->table[CASE_GAP], resolved->gap_file, units) || c->profile.noise != noise ||
        c->profile.is_punch != is_punch)
        free_profile(&c->profile);
    rb_status s = read_over_x(c, &c->table[CASE_GAP], resolved->gap_file, units, &gap, why);
    if (s == RB_OK && !c->profile.curve) {
        c->profile = (case_profile){.noise = noise, .is_punch = is_punch};
        s = (is_punch ? rb_rolling_profile_punch : rb_rolling_profile_create)(
            gap.n, gap.x, gap.y, noise, &c->profile.curve, why);
        s = rb_case_locate(c, s, why);
    }
    resolved->rc.profile = c->profile.curve;
    return s;
}

static rb_status read_friction(rb_case *c, rb_message *why)
{
    rb_resolved_case *resolved = &c->resolved;
    if (resolved->rc.friction.law != RB_FRICTION_table)
        return RB_OK;
    const rb_status s =
        read_over_x(c, &c->table[CASE_FRICTION], resolved->friction_file,
                    units_of_file(c, "friction-law"), &resolved->rc.friction.table, why);
    if (s != RB_OK)
        return s;
    /* The table stands in the place of --mu: on the command line it wins over mu of the
     * case file. */
    const rb_option_set set = rb_case_options(c);
    const rb_option_precedence how = rb_case_precedence(c);
    const rb_status status = rb_option_resolve_against(
        &set, &how, rb_case_option("mu"), rb_case_given(c, "friction-law"),
        "the table of --friction-law has the coefficients", why);
    c->resolved.rc.mu = c->words.rc.mu;
    return status;
}

/* ---- The history ------------------------------------------------------------------- */

/* The option whose value a column replaces: creep-ratio by creep_ratio; NULL: none. */
static const rb_option *replaced_option(const char *column)
{
    char name[32];
    snprintf(name, sizeof name, "%s", column);
    for (char *c = name; *c; c++)
        *c = *c == '_' ? '-' : *c;
    return strcmp(column, "distance") == 0 ? NULL : rb_case_option(name);
}

/* The columns that a table of a program may have.  One that --history-table has written has all
 * states of its steps: its controls are the load, and the shift at rest, or the force of rolling,
 * or the creepage where a step slides fully.  Returns how many. */
static int known_columns(const rb_io_table *t, int rolls, rb_io_column *known)
{
    const double *ratio = rb_io_table_column(t, "force_ratio");
    const int has_states = ratio && rb_io_table_column(t, "residual");
    int slides = 0, n = 0;
    for (int i = 0; has_states && i < t->rows; i++)
        slides |= !(fabs(ratio[i]) < 1.0 - 1e-9);
    const char *loads = !rolls ? "shift" : slides ? "creep" : "force";
    for (int k = 0; k < RB_ROLLING_PROGRAM_COLUMNS; k++) {
        const rb_rolling_program_column *c = &rb_rolling_program_columns[k];
        const int is_control = strcmp(c->name, rolls ? "distance" : "time") == 0 ||
                               strcmp(c->name, "load") == 0 || strcmp(c->name, loads) == 0;
        known[n++] =
            (rb_io_column){c->name, c->also, c->unit,
                           has_states && !is_control ? RB_IO_COLUMN_UNUSED : RB_IO_COLUMN_OPTIONAL};
    }
    if (has_states)
        known[n++] = (rb_io_column){NULL, NULL, "-", RB_IO_COLUMN_UNUSED};
    return n;
}

/* Columns named like options, in the units of those or in their own: load_kN/m. */
static rb_status read_program_table(const rb_case *c, case_table *t, const char *path,
                                    rb_units units, rb_message *why)
{
    rb_io_column known[RB_ROLLING_PROGRAM_COLUMNS + 1];
    const double *x[RB_ROLLING_PROGRAM_COLUMNS + 1];
    if (is_read(t, path, units))
        return RB_OK;
    free_table(t);
    rb_io_table *table = &t->table;
    rb_status s = read_table(c, path, 1, table, why);
    if (s != RB_OK)
        return s;
    const int n = known_columns(table, c->words.rc.formulation == RB_TRANSIENT, known);
    s = table->name ? rb_io_table_assign(path, table, n, known, units, x, why)
                    : rb_fail(why, RB_EFORMAT, "%s: expected a line that names the columns", path);
    if (s != RB_OK) {
        free_table(t);
        return rb_case_without_content(c, path, s, why);
    }
    *t = (case_table){.table = *table, .path = path, .units = units, .program = {.n = table->rows}};
    /* Each column goes to its member of the program; NULL where the table has none. */
    for (int k = 0; k < RB_ROLLING_PROGRAM_COLUMNS; k++)
        memcpy((char *)&t->program + rb_rolling_program_columns[k].column, &x[k], sizeof x[k]);
    /* The creepage of states is the mean of the step that ends there; none is of those at rest. */
    if (n > RB_ROLLING_PROGRAM_COLUMNS && t->program.creep) {
        double *creep = t->table.x + (t->program.creep - t->table.x);
        for (int i = t->table.rows - 2; i >= 0; i--)
            if (t->program.distance && t->program.distance[i] == 0.0)
                creep[i] = creep[i + 1];
    }
    return RB_OK;
}

static int has_column(const rb_rolling_program *program, int k)
{
    const double *column;
    memcpy(&column, (const char *)program + rb_rolling_program_columns[k].column, sizeof column);
    return program->n > 0 && column;
}

const char *const rb_case_of_layers[2][CASE_OF_LAYERS] = {
    {"young", "poisson", "layer-thickness"}, {"young-b", "poisson-b", "layer-thickness-b"}};

/* 1: the layers of a body, or of A where B is similar, stand in place of this option. */
static int is_of_layers(const rb_case *c, const char *name)
{
    const rb_resolved_case *r = &c->resolved;
    const int has[2] = {r->layers_file != NULL, r->layers_file_b || (r->layers_file && r->similar)};
    for (int k = 0; k < 2 * CASE_OF_LAYERS; k++)
        if (has[k % 2] && strcmp(name, rb_case_of_layers[k % 2][k / 2]) == 0)
            return 1;
    return 0;
}

int rb_case_is_replaced(const rb_case *c, const rb_option *option)
{
    if (is_of_layers(c, option->name))
        return 1;
    for (int k = 0; k < RB_ROLLING_PROGRAM_COLUMNS; k++)
        if (has_column(&c->resolved.program, k) &&
            replaced_option(rb_rolling_program_columns[k].name) == option)
            return 1;
    return 0;
}

/* 1: the option says once more what all rows of column k say, as where a table that
 * --history-table wrote is read under the same command. */
static int repeats_column(const rb_case *c, const rb_option_set *set, const rb_option *option,
                          int k)
{
    static const double SAME = 1e-9;
    const rb_rolling_program *program = &c->words.program;
    const rb_rolling_program_column *of = &rb_rolling_program_columns[k];
    const double *column;
    double value;

    if (option->kind != RB_OPTION_NUMBER || of->value == SIZE_MAX ||
        !rb_case_given(c, option->name))
        return 0;
    rb_resolved_case given = c->words;
    rb_case_store(c, set, &given); /* in mm, N, MPa as the column is */
    memcpy(&value, (const char *)&given.rc + of->value, sizeof value);
    memcpy(&column, (const char *)program + of->column, sizeof column);
    for (int i = 0; i < program->n; i++)
        if (!(fabs(column[i] - value) <= SAME * fabs(value)))
            return 0;
    return 1;
}

rb_status rb_case_read_history(rb_case *c, rb_message *why)
{
    case_table *t = &c->table[CASE_HISTORY];
    const char *path = c->words.history_file;
    if (!path || c->words.rc.formulation == RB_STEADY) /* check_formulation refuses it */
        return RB_OK;
    rb_status s = read_program_table(c, t, path, units_of_file(c, "history"), why);
    if (s != RB_OK)
        return s;
    c->words.program = t->program;
    /* A column stands in the place of an option: as between two options the command line
     * wins over the file, and otherwise both at once are refused. */
    const rb_option_precedence how = rb_case_precedence(c);
    const rb_option_set set = rb_case_options(c);

    for (int k = 0; k < RB_ROLLING_PROGRAM_COLUMNS && s == RB_OK; k++) {
        const char *name = rb_rolling_program_columns[k].name;
        const rb_option *option = replaced_option(name);
        char reason[80];
        snprintf(reason, sizeof reason, "the history has a column %s", name);
        if (option && has_column(&t->program, k) && !repeats_column(c, &set, option, k))
            s = rb_option_resolve_against(&set, &how, option, rb_case_given(c, "history"), reason,
                                          why);
    }
    return s;
}

/* ---- Layers ------------------------------------------------------------------------ */

/* Layers from the surface down: thickness, E and nu of each, checked one by one, because a table
 * names no options. */
static rb_status read_stack(const rb_case *c, case_table *t, const char *path, rb_units units,
                            rb_message *why)
{
    enum { MOST = 1000, COLUMNS = 3 };
    static const rb_io_column known[COLUMNS] = {
        {"thickness", "h|d|layer thickness", "mm", RB_IO_COLUMN_NEEDED},
        {"young", "e|modulus|young's modulus", "MPa", RB_IO_COLUMN_NEEDED},
        {"poisson", "nu|poisson's ratio", "-", RB_IO_COLUMN_NEEDED}};
    const double *x[COLUMNS];
    free_table(t);
    rb_status s = read_table(c, path, 0, &t->table, why);
    if (s == RB_OK)
        s = rb_case_without_content(
            c, path, rb_io_table_assign(path, &t->table, COLUMNS, known, units, x, why), why);
    const int n = s == RB_OK ? t->table.rows : 0;
    if (s == RB_OK && n > MOST)
        s = rb_fail(why, RB_EFORMAT, "%s: expected at most %d layers, got %d", path, MOST, n);
    for (int k = 0; k < n && s == RB_OK; k++) {
        const double range[] = {x[0][k], x[1][k], x[2][k]};
        for (int j = 0; j < COLUMNS; j++)
            if (!(j < 2 ? range[j] > 0.0 && isfinite(range[j])
                        : range[j] > -1.0 && range[j] <= 0.5))
                s = rb_fail(why, RB_EFORMAT, "%s:%d: %s: expected a number %s, got %g", path,
                            t->table.line[k], known[j].name,
                            j < 2 ? "> 0" : "above -1, at most 0.5", range[j]);
    }
    rb_bem_stack *stack = s == RB_OK ? malloc(sizeof *stack) : NULL;
    if (!stack) {
        free_table(t);
        return s == RB_OK ? RB_ENOMEM : rb_case_without_content(c, path, s, why);
    }
    *stack = (rb_bem_stack){n, x[0], x[1], x[2]};
    *t = (case_table){.table = t->table, .path = path, .units = units, .stack = stack};
    return RB_OK;
}

static int same_layers(const rb_bem_stack *x, const rb_bem_stack *y)
{
    const size_t bytes = (size_t)x->n * sizeof(double);
    return x->n == y->n && memcmp(x->thickness, y->thickness, bytes) == 0 &&
           memcmp(x->young, y->young, bytes) == 0 && memcmp(x->poisson, y->poisson, bytes) == 0;
}

rb_status rb_case_read_layers(rb_case *c, int of_b, rb_message *why)
{
    rb_rolling_body *body = of_b ? &c->resolved.rc.b : &c->resolved.rc.a;
    const char *path = of_b ? c->resolved.layers_file_b : c->resolved.layers_file;
    const rb_units units = units_of_file(c, of_b ? "layers-b" : "layers");
    case_table *t = &c->table[of_b ? CASE_LAYERS_B : CASE_LAYERS];
    rb_status s = RB_OK;

    if (!path)
        return s;
    if (!is_read(t, path, units))
        s = read_stack(c, t, path, units, why);
    if (s != RB_OK)
        return s;
    const rb_bem_stack *of = t->stack;
    body->layer = of->thickness[0];
    body->young = of->young[0];
    body->poisson = of->poisson[0];
    /* bodies are alike if they have one stack */
    const rb_bem_stack *of_a = of_b ? c->resolved.rc.a.stack : NULL;
    body->stack = of_a && same_layers(of_a, of) ? of_a : of->n > 1 ? of : NULL;
    return s;
}

/* ---- All others -------------------------------------------------------------------- */

rb_status rb_case_read_files(rb_case *c, rb_message *why)
{
    rb_status s = read_profile(c, why);
    if (s == RB_OK) {
        /* What is irregular about the surfaces, and what is worn off them. */
        rb_resolved_case *resolved = &c->resolved;

        if (resolved->irregularity_file)
            s = read_over_x(c, &c->table[CASE_IRREGULARITY], resolved->irregularity_file,
                            units_of_file(c, "irregularity"), &resolved->rc.irregularity, why);
        if (s == RB_OK && resolved->worn_file)
            s = read_over_x(c, &c->table[CASE_WORN], resolved->worn_file, units_of_file(c, "worn"),
                            &resolved->rc.worn, why);
    }
    return s == RB_OK ? read_friction(c, why) : s;
}

void rb_case_free_files(rb_case *c)
{
    free_profile(&c->profile);
    for (int k = 0; k < CASE_TABLES; k++)
        free_table(&c->table[k]);
}
