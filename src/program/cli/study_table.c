/* The table of a study: its columns, its head, its rows and their notes; and the same read back
 * from a file, where a study goes on. */
#include "program/cli/study.h"

#include "program/cli/case.h"
#include "program/report/report.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Columns --------------------------------------------------------------------------- */

int cli_study_columns(const study *st)
{
    return 1 + st->columns + 1 + st->results + st->slopes.n + st->slopes.deviations;
}

/* Column j, by what it shows and its number among those of its kind. */
typedef struct {
    enum { CASE_NUMBER, VARIED, STATUS, RESULT, SLOPE, DEVIATION } is;
    int k;
} column;

static column column_of(const study *st, int j)
{
    const int kinds[] = {1, st->columns, 1, st->results, st->slopes.n};
    int is = CASE_NUMBER;

    for (; is < DEVIATION && j >= kinds[is]; is++)
        j -= kinds[is];
    return (column){is, j};
}

const char *cli_study_column_name(const study *st, int j, char text[STUDY_HEADING])
{
    char heading[RB_ROLLING_HEADING];
    const rb_units units = rb_case_resolved(st->base)->units;
    const column c = column_of(st, j);

    switch (c.is) {
    case CASE_NUMBER:
        return "case";
    case VARIED:
        return st->column[c.k].heading;
    case STATUS:
        return "status";
    case RESULT:
        snprintf(text, STUDY_HEADING, "%s%s", st->result[c.k].is_error ? "error_" : "",
                 rb_rolling_heading(st->result[c.k].r, units, heading));
        break;
    case SLOPE:
        return rb_case_slope_heading(&st->slopes.of[c.k], units, text);
    case DEVIATION:
        snprintf(text, STUDY_HEADING, "deviation_%s",
                 rb_rolling_heading(st->slopes.deviation[c.k], units, heading));
        break;
    }
    return text;
}

/* Of a result or its error bar, in the units of the study. */
static double result_value(const study *st, const study_result *result, const rb_rolling_row *row)
{
    const rb_units units = rb_case_resolved(st->base)->units;
    const rb_rolling_errors *e = &row->errors;

    if (result->of == OF_CRACK)
        return rb_unit_shown(units, result->r->unit,
                             rb_case_crack_of_row(result->r, result->is_error, row));
    if (result->of == OF_BOND)
        return rb_unit_shown(units, result->r->unit,
                             (result->is_error ? row->bond_error : row->bond)[result->bond]);
    const void *const owners[2][3] = {{&row->solution, &row->stress, &row->stress_b},
                                      {&e->scalar, &e->stress, &e->stress_b}};
    return rb_rolling_number(result->r, owners[result->is_error != 0][result->of]);
}

/* row NULL: what is known before the case is solved. */
static double cell_value(const study *st, int j, int k, const rb_rolling_row *row)
{
    const rb_units units = rb_case_resolved(st->base)->units;
    const column c = column_of(st, j);

    switch (c.is) {
    case CASE_NUMBER:
        return k + 1;
    case VARIED:
        return cli_study_value(st, &st->column[c.k], k);
    case STATUS:
        return (double)row->solution.status;
    case RESULT:
        return result_value(st, &st->result[c.k], row);
    case SLOPE:
        return rb_case_slope_shown(&st->slopes.of[c.k], units, row->own[c.k]);
    case DEVIATION:
        return rb_unit_shown(units, st->slopes.deviation[c.k]->unit, row->own[st->slopes.n + c.k]);
    }
    return NAN;
}

/* NULL: the cell has a number. */
static const char *cell_word(const study *st, int j, int k)
{
    const column c = column_of(st, j);
    return c.is == VARIED ? cli_study_word(st, &st->column[c.k], k) : NULL;
}

double cli_study_result_value(const study *st, int j, const rb_rolling_row *row)
{
    return result_value(st, &st->result[j], row);
}

const char *cli_study_result_name(const study *st, int j, char text[STUDY_HEADING])
{
    return cli_study_column_name(st, st->columns + 2 + j, text);
}

/* ---- Written ----------------------------------------------------------------------------- */

void cli_study_write_head(const study *st, FILE *out)
{
    char heading[STUDY_HEADING];
    rb_report_cells c = rb_report_cells_begin(out, &st->o->style, "");
    for (int j = 0; j < cli_study_columns(st); j++)
        rb_report_cell_text(&c, cli_study_column_name(st, j, heading));
    rb_report_cells_end_row(&c);
    rb_report_comment_origin(&c, cli_command_line());
    rb_report_comment(&c, "study %016" PRIx64 " of %d case%s%s%s", st->fingerprint, st->cases,
                      rb_plural(st->cases),
                      st->o->tolerance ? ", standard deviations of inputs: " : "",
                      st->o->tolerance ? st->o->tolerance : "");
    rb_report_comment(&c, "status 0: solved. xi > 0: A's surface slides towards +x, the friction "
                          "on A points to -x, Q < 0");
}

void cli_study_write_row(study *st, int k, const rb_rolling_row *row)
{
    rb_report_cells c = {.out = st->out, .style = st->o->style};

    for (int j = 0; j < cli_study_columns(st); j++) {
        const double x = cell_value(st, j, k, row);
        const char *word = cell_word(st, j, k);
        cli_study_keep(st, j, k, row->solution.status == RB_OK ? x : NAN);
        if (st->o->style.format == RB_REPORT_JSON)
            st->lost |= json_array_append_new(json_array_get(st->list, (size_t)j),
                                              word ? rb_report_json_text(word)
                                                   : rb_report_json_number(x)) != 0;
        else if (word)
            rb_report_cell_text(&c, word);
        else
            rb_report_cell_number(&c, x);
    }
    if (st->o->style.format != RB_REPORT_JSON)
        rb_report_cells_end_row(&c);
}

/* A case that was not solved shows in the exit code. */
void cli_study_count(study *st, int k, rb_status status)
{
    const int fails = st->o->sample > 0 && status == RB_EINVAL; /* no case */
    const int code = fails ? CLI_UNSOLVED : cli_exit_of(status);
    st->unsolved += status != RB_OK;
    st->no_memory += status == RB_ENOMEM;
    st->worst = code > st->worst ? code : st->worst;
    if (status != RB_OK && status != RB_ENOMEM && !st->unsolved_case)
        st->unsolved_case = k + 1;
}

/* The first case of a kind of notes has its line in the table before it, so that a study that
 * continues knows which kinds its file has. */
static const char note_before[] = "note, case ";

static const char *name_of_note(int kind, char text[24])
{
    const char *name = rb_rolling_note_name(kind);
    const int of_material = kind >= RB_CASE_MATERIAL_NOTES;
    snprintf(text, 24, "%s-%d", of_material ? "material" : "crack",
             kind - (of_material ? (int)RB_CASE_MATERIAL_NOTES : (int)RB_ROLLING_OWN_NOTES) + 1);
    return name ? name : text;
}

void cli_study_write_notes(study *st, int k, const rb_rolling_row_notes *said)
{
    const rb_report_cells c = {.out = st->out, .style = st->o->style};
    char name[24];

    for (int i = 0; i < said->n; i++) {
        const uint64_t bit = UINT64_C(1) << said->kind[i];
        if (!(st->noted & bit) && !st->list)
            rb_report_comment(&c, "%s%d, %s: %s", note_before, k + 1,
                              name_of_note(said->kind[i], name), said->text[i]);
        st->noted |= bit;
    }
    rb_rolling_add_row_notes(&st->notes, k, said);
}

/* ---- Read back ----------------------------------------------------------------------------- */

/* 1: the line is such a note, of a row that follows. */
int cli_study_is_note(study *st, const char *line)
{
    char name[24];
    int from = 0;

    if (strncmp(line, "# ", 2) != 0 || strncmp(line + 2, note_before, strlen(note_before)) != 0 ||
        sscanf(line + 2 + strlen(note_before), "%*d, %n", &from) != 0 || from == 0)
        return 0;
    line += 2 + strlen(note_before) + from;
    for (int kind = 0; kind < RB_ROLLING_NOTES; kind++) {
        const char *known = name_of_note(kind, name);
        const size_t n = strlen(known);
        if (strncmp(line, known, n) == 0 && line[n] == ':')
            st->found |= UINT64_C(1) << kind;
    }
    return 1;
}

/* The number behind a tab at *at; 1: there is one, and *at stands behind it. */
static int next_number(const char **at, double *value)
{
    char *end;
    if (**at != '\t')
        return 0;
    *value = strtod(*at + 1, &end);
    const int good = end > *at + 1;
    *at = end;
    return good;
}

/* The row of case k, as this study writes it: number and inputs to the digit, then its
 * status and as many numbers as there are results. */
int cli_study_is_row(study *st, int k, const char *line, size_t length)
{
    char *wanted = NULL;
    size_t size = 0;
    double status = 0.0, value;
    FILE *memory = open_memstream(&wanted, &size);
    if (memory) {
        /* Its first cells alone, as far as they are known before the case is solved. */
        rb_report_cells c = {.out = memory, .style = st->o->style};
        for (int j = 0; j <= st->columns; j++) {
            if (cell_word(st, j, k))
                rb_report_cell_text(&c, cell_word(st, j, k));
            else
                rb_report_cell_number(&c, cell_value(st, j, k, NULL));
        }
        fclose(memory);
    }
    int good = wanted && length == strlen(line) && strncmp(line, wanted, size) == 0;
    const char *at = line + size;
    free(wanted);
    good = good && next_number(&at, &status);
    for (int j = st->columns + 2; good && j < cli_study_columns(st); j++) {
        good = next_number(&at, &value);
        if (good)
            cli_study_keep(st, j, k, status == RB_OK ? value : NAN);
    }
    if (good && *at == '\n')
        cli_study_count(st, k, (rb_status)status);
    return good && *at == '\n';
}
