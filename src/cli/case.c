/* From options and a case file to an rb_rolling_case. */
#include "cli/case.h"

#include "rollbem/io.h"
#include "rollbem/report.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

void cli_case_defaults(cli_case *c)
{
    memset(c, 0, sizeof *c);
    c->rc = rb_rolling_case_defaults();
    c->young_b = c->poisson_b = NAN;
    c->radius_b = INFINITY;
}

void cli_case_free(cli_case *c)
{
    rb_io_table_free(&c->profile);
    rb_io_table_free(&c->history);
}

/* ---- Body B ----------------------------------------------------------------------- */

/* Options of the second body mean nothing to a rigid plane. */
static cli_exit check_rigid(const cli_set *set, const cli_case *c)
{
    char room[400];
    const char *section = "";
    for (int i = 0; i < set->n; i++) {
        const cli_option *o = &set->options[i];
        if (o->kind == CLI_GROUP)
            section = o->name;
        if (set->given[i] && strcmp(section, "body-b") == 0)
            return cli_fail(set->given[i] > 0 ? CLI_DATA : CLI_USAGE,
                            "%s: body B is rigid without --similar or --young-b",
                            cli_source(o, set->given[i], c->path, room, sizeof room));
    }
    return CLI_CONTINUE;
}

static cli_exit settle_body_b(const cli_set *set, cli_case *c)
{
    rb_rolling_case *rc = &c->rc;
    rc->elastic_b = c->similar || !isnan(c->young_b);
    if (!rc->elastic_b)
        return check_rigid(set, c);
    rc->b.young = c->similar ? rc->a.young : c->young_b;
    rc->b.poisson = c->similar || isnan(c->poisson_b) ? rc->a.poisson : c->poisson_b;
    rc->b.radius = c->radius_b;
    return CLI_CONTINUE;
}

/* ---- Gap profile ------------------------------------------------------------------ */

cli_exit cli_read_pairs(const char *path, rb_io_table *t)
{
    rb_message why;
    const rb_status s = rb_io_table_read(path, t, &why);
    if (s != RB_OK)
        return cli_fail(cli_exit_of(s), "%s", why.text);
    if (t->columns != 2)
        return cli_fail(CLI_DATA, "%s:%d: expected 2 numbers, got %d", path, t->line[0],
                        t->columns);
    return CLI_CONTINUE;
}

static cli_exit read_profile(cli_case *c)
{
    if (c->rc.gap != RB_GAP_TABLE)
        return CLI_CONTINUE;
    const cli_exit code = cli_read_pairs(c->gap_file, &c->profile);
    c->rc.profile_n = c->profile.rows;
    c->rc.profile_x = c->profile.x;
    c->rc.profile_gap = c->profile.x + c->profile.rows;
    return code;
}

/* ---- History ---------------------------------------------------------------------- */

/* Where a column of that name belongs in the program; NULL: nowhere. */
static const double **program_column(rb_rolling_program *p, const char *name,
                                     cli_guess *guess)
{
    const struct {
        const char *name;
        const double **place;
    } columns[] = {
        {"distance", &p->distance}, {"load", &p->load},
        {"approach", &p->approach}, {"shift", &p->shift},
        {"creep", &p->creep},       {"creep_ratio", &p->creep_ratio},
        {"force", &p->force},       {"force_ratio", &p->force_ratio},
    };
    for (size_t k = 0; k < sizeof columns / sizeof columns[0]; k++) {
        if (strcmp(name, columns[k].name) == 0)
            return columns[k].place;
        cli_guess_try(guess, columns[k].name);
    }
    return NULL;
}

static cli_exit read_history(cli_case *c)
{
    rb_message why;
    rb_io_table *t = &c->history;
    if (!c->history_file)
        return CLI_CONTINUE;
    const rb_status s = rb_io_table_read(c->history_file, t, &why);
    if (s != RB_OK)
        return cli_fail(cli_exit_of(s), "%s", why.text);
    if (!t->name)
        return cli_fail(CLI_DATA, "%s: expected a line that names the columns",
                        c->history_file);
    c->program.n = t->rows;
    for (int j = 0; j < t->columns; j++) {
        cli_guess guess = {.word = t->name[j]};
        const double **place = program_column(&c->program, t->name[j], &guess);
        if (!place)
            return cli_fail(CLI_DATA, "%s: unknown column '%s'%s", c->history_file,
                            t->name[j], cli_guess_text(&guess, ""));
        *place = t->x + (size_t)j * (size_t)t->rows;
    }
    return CLI_CONTINUE;
}

/* ---- What depends on other options ---------------------------------------------- */

static int option_index(const cli_set *set, const char *name)
{
    int i = 0;
    while (i < set->n && (set->options[i].kind == CLI_GROUP || /* headings share names */
                          strcmp(set->options[i].name, name) != 0))
        i++;
    return i;
}

int cli_case_given(const cli_case *c, const char *name)
{
    cli_case any;
    const cli_set set = cli_case_set(&any);
    return c->given[option_index(&set, name)];
}

cli_exit cli_case_refuse(const cli_case *c, const char *name, const char *reason)
{
    cli_case any;
    const cli_set set = cli_case_set(&any);
    const int i = option_index(&set, name);
    char room[400];
    if (!c->given[i])
        return CLI_CONTINUE;
    return cli_fail(c->given[i] > 0 ? CLI_DATA : CLI_USAGE, "%s: %s",
                    cli_source(&set.options[i], c->given[i], c->path, room, sizeof room),
                    reason);
}

/* The paper's own example stays on its equal elements, as do large contacts, which need
 * them. */
static void choose_mesh(cli_case *c)
{
    rb_rolling_case *rc = &c->rc;
    const int paper = isnan(rc->approach) && isnan(rc->load) && isnan(rc->half_width);
    if (!cli_case_given(c, "mesh") && rc->formulation == RB_STEADY && !paper &&
        rc->zone == 0.0 && rc->gap != RB_GAP_TABLE &&
        rc->contact_elements < RB_ROLLING_LARGE)
        rc->mesh = RB_MESH_FITTED;
    if (!cli_case_given(c, "contact-elements") && rc->mesh == RB_MESH_FITTED)
        rc->contact_elements = 100;
}

static cli_exit check_lists(const cli_case *c)
{
    return c->mus.n > 1 && !c->lists
               ? cli_case_refuse(c, "mu", "expected one number; a curve takes several")
               : CLI_CONTINUE;
}

int cli_case_has_steps(const cli_case *c)
{
    return c->rc.formulation == RB_TRANSIENT || c->program.n > 0;
}

static cli_exit check_accuracy(const cli_case *c)
{
    return cli_case_has_steps(c)
               ? cli_case_refuse(c, "accuracy",
                                 "of static and steady cases without history only")
               : CLI_CONTINUE;
}

/* Options of one formulation mean nothing to the others. */
static cli_exit check_formulation(const cli_case *c)
{
    const int transient = c->rc.formulation == RB_TRANSIENT;
    cli_exit code = CLI_CONTINUE;
    if (!transient)
        code = cli_case_refuse(c, "distance", "of transient rolling only");
    else if (c->history_file)
        code = cli_case_refuse(c, "distance", "the history says how far");
    if (code == CLI_CONTINUE && !transient)
        code = cli_case_refuse(c, "steps", "of transient rolling only");
    if (code == CLI_CONTINUE && c->rc.formulation == RB_STEADY)
        code = cli_case_refuse(c, "history", "steady rolling has no history");
    if (code == CLI_CONTINUE && (c->history_file || transient) &&
        c->rc.mesh == RB_MESH_FITTED)
        code = cli_case_refuse(c, "mesh", "step by step the elements are equal");
    if (code == CLI_CONTINUE && transient && !c->history_file && !(c->rc.distance > 0.0))
        code = cli_fail(CLI_USAGE, "transient rolling needs --distance or --history");
    return code;
}

/* ---- All together ----------------------------------------------------------------- */

/* 1: the case file is to blame, since the command line gives nothing of the case. */
static int all_from_file(const cli_case *c)
{
    for (int i = 0; i < CLI_CASE_OPTIONS_MAX; i++)
        if (c->given[i] == CLI_GIVEN_ARGUMENT)
            return 0;
    return c->path[0] != '\0';
}

/* "history: row 3: ..." of the library, by the file and its line. */
static cli_exit blame_row(const char *path, const int *line, int rows, const char *name,
                          const char *text)
{
    int row = 0, rest = 0;
    const size_t n = strlen(name);
    if (!path || strncmp(text, name, n) != 0)
        return CLI_CONTINUE;
    if (sscanf(text + n, ": row %d: %n", &row, &rest) < 1 || row < 1 || row > rows)
        return cli_fail(CLI_DATA, "%s: %s", path, text);
    return cli_fail(CLI_DATA, "%s:%d: %s", path, line[row - 1], text + n + rest);
}

cli_exit cli_case_refused(const cli_case *c, rb_status s, const rb_message *why)
{
    cli_exit code = CLI_CONTINUE;
    if (s == RB_EINVAL)
        code = blame_row(c->history_file, c->history.line, c->history.rows, "history",
                         why->text);
    if (s == RB_EINVAL && code == CLI_CONTINUE)
        code = blame_row(c->gap_file, c->profile.line, c->profile.rows, "gap", why->text);
    if (code != CLI_CONTINUE)
        return code;
    if (s == RB_EINVAL && all_from_file(c))
        return cli_fail(CLI_DATA, "%s: %s", c->path, why->text);
    return cli_fail(cli_exit_of(s), "%s", why->text);
}

static cli_exit read_case_file(const cli_spec *spec, cli_case *c, cli_args *args)
{
    if (args->operands > 1)
        return cli_fail(CLI_USAGE, "one case file at a time, got '%s' and '%s'",
                        args->operand[0], args->operand[1]);
    if (args->operands == 0)
        return CLI_CONTINUE;
    snprintf(c->path, sizeof c->path, "%s", args->operand[0]);
    return cli_read_ini(spec, args->operand[0], args);
}

cli_exit cli_case_finish(const cli_spec *spec, cli_case *c, cli_args *args)
{
    cli_case defaults;
    rb_message why;
    const cli_set set = cli_case_set(c);
    cli_case_defaults(&defaults);
    cli_exit code = read_case_file(spec, c, args);
    if (code == CLI_CONTINUE)
        code = cli_settle(&set, &defaults, cli_case_alike(c), c->path);
    if (code == CLI_CONTINUE)
        code = settle_body_b(&set, c);
    if (code == CLI_CONTINUE)
        code = check_formulation(c);
    if (code == CLI_CONTINUE)
        code = read_profile(c);
    if (code == CLI_CONTINUE)
        code = read_history(c);
    if (code == CLI_CONTINUE)
        code = check_lists(c);
    if (code == CLI_CONTINUE)
        code = check_accuracy(c);
    if (code != CLI_CONTINUE)
        return code;
    choose_mesh(c);
    const rb_status s = rb_rolling_case_check(&c->rc, &why);
    return s == RB_OK ? CLI_CONTINUE : cli_case_refused(c, s, &why);
}

/* ---- Studies ---------------------------------------------------------------------- */

int cli_case_is_number(const cli_case *c, const char *name)
{
    cli_case any = *c;
    const cli_set set = cli_case_set(&any);
    const int i = option_index(&set, name);
    return i < set.n &&
           (set.options[i].kind == CLI_NUMBER || set.options[i].kind == CLI_INTEGER);
}

cli_exit cli_case_vary(cli_case *c, int number, const char *name, double value)
{
    char text[32], what[80];
    const cli_set set = cli_case_set(c);
    const int i = option_index(&set, name);

    snprintf(text, sizeof text, "%.17g", value);
    snprintf(what, sizeof what, "case %d: %.50s", number, name);
    c->given[i] = CLI_GIVEN_ARGUMENT;
    return cli_set_value(&set.options[i], c, what, text, CLI_DATA);
}

cli_exit cli_case_settle_again(cli_case *c)
{
    rb_message why;
    const cli_set set = cli_case_set(c);
    const cli_exit code = settle_body_b(&set, c);

    if (code != CLI_CONTINUE)
        return code;
    if (!cli_case_given(c, "mesh"))
        c->rc.mesh = RB_MESH_UNIFORM;
    choose_mesh(c);
    const rb_status s = rb_rolling_case_check(&c->rc, &why);
    return s == RB_OK ? CLI_CONTINUE : cli_case_refused(c, s, &why);
}

/* ---- Inputs ----------------------------------------------------------------------- */

static json_t *input(const cli_option *o, const cli_case *c)
{
    char room[64];
    const char *place = (const char *)c + o->offset;
    switch (o->kind) {
    case CLI_NUMBER: {
        const double v = *(const double *)place;
        const cli_list *list = (const cli_list *)((const char *)c + o->list);
        if (o->list && list->n > 1)
            return rb_report_json_numbers(list->n, list->value);
        return o->word && v == o->word_value ? json_string(o->word)
                                             : rb_report_json_number(v);
    }
    case CLI_INTEGER:
        return json_integer(*(const int *)place);
    case CLI_FLAG:
        return json_boolean(*(const int *)place);
    default:
        return json_string(cli_value_text(o, c, room));
    }
}

json_t *cli_case_inputs(const cli_case *c)
{
    /* what B became counts, not what was typed */
    cli_case used = *c;
    used.young_b = c->rc.elastic_b ? c->rc.b.young : NAN;
    used.poisson_b = c->rc.elastic_b ? c->rc.b.poisson : NAN;
    const cli_set set = cli_case_set(&used);
    json_t *inputs = json_object();
    for (int i = 0; i < set.n; i++)
        if (set.options[i].kind != CLI_GROUP)
            json_object_set_new(inputs, set.options[i].name,
                                input(&set.options[i], &used));
    return inputs;
}
