/* rollbem sweep: parameter studies over all processors. */
#include "program/cli/case.h"
#include "program/cli/interrupt.h"
#include "program/cli/pool.h"
#include "program/cli/study.h"
#include "program/report/report.h"

#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define PLACE(member) offsetof(study_options, member)
/* The range is that of the count of first:last:count. */
#define VARY_LINE(name, place, help)                                                               \
    RB_TEXT_LINE(name, place, "SPEC", help, .unset = "none", .range = RB_FROM_TO(2, 1e7))

static const rb_option options[] = {
    RB_GROUP_LINE("sweep", "Study"),
    VARY_LINE("vary-1", PLACE(vary[0]),
              "an option and its values: 'mu 0.1 0.2 0.3', 'creep-ratio 0:1.5:31' (first, last, "
              "how many), 'load 1:1e4:9:log', 'support halfplane arc'"),
    VARY_LINE("vary-2", PLACE(vary[1]), "a second one: every combination is a case"),
    VARY_LINE("vary-3", PLACE(vary[2]), "a third one"),
    VARY_LINE("vary-4", PLACE(vary[3]), "a fourth one"),
    RB_TEXT_LINE("cases", PLACE(cases), "FILE",
                 "a case per row; the columns are named like the options, as 'load' or 'load "
                 "[kN/m]'; columns of other words are labels",
                 .unset = "none", .file = RB_FILE_READ),
    RB_INTEGER_LINE("sample", PLACE(sample), RB_FROM_TO(0, 1000000),
                    "number of random cases whose inputs scatter by --tolerance (a Latin hypercube "
                    "of normal distributions); prints mean and standard deviation of each result "
                    "to standard error; a sample with invalid inputs counts as not solved"),
    RB_TEXT_LINE(
        "tolerance", PLACE(tolerance), "NAME=X,...",
        "standard deviations of inputs, as mu=0.02,radius=1%: of those of --sample; without "
        "--sample a column deviation_... with that of each result in every case, to first "
        "order",
        .unset = "none"),
    RB_INTEGER_LINE("seed", PLACE(seed), RB_FROM_TO(0, 1000000000),
                    "of the sample: the same seed gives the same cases"),
    RB_TEXT_LINE(
        "results", PLACE(results), "A,B,...",
        "further results, by their names in JSON's `summary` or `maxima`: stick_length, "
        "contact_from, max_shear, von_mises, max_shear_y, ...; those of cracks, and of --history "
        "with --fretting, come by themselves",
        .unset = "none"),
    RB_TEXT_LINE("derivatives", PLACE(derivatives), "RESULT,...",
                 "columns with the derivatives of these results in every case, with respect to all "
                 "numbers, or RESULT:OPTION to one",
                 .unset = "none", .alone = "all"),
    CLI_PICTURE_LINE("plot", PLACE(plot), "picture of a result over an option that varies"),
    RB_TEXT_LINE("map", PLACE(map), "FILE",
                 "picture of a result over two options; every pair of their values must be a case",
                 .unset = "none", .file = RB_FILE_PICTURE),
    RB_TEXT_LINE("show", PLACE(show), "RESULT", "the result of the pictures, by its name",
                 .unset = "force_ratio; of cracks delta_K_II"),
    RB_TEXT_LINE("over", PLACE(over), "OPTION", "the option along x of the pictures",
                 .unset = "the one that varies fastest"),
    RB_TEXT_LINE("family", PLACE(family), "OPTION",
                 "--plot: a curve for each value of this one; --map: y",
                 .unset = "another one that varies"),
    CLI_PICTURE_LINES(PLACE(pictures)),
    CLI_STYLE_LINES(PLACE(style)),
    RB_TEXT_LINE("output", PLACE(output), "FILE",
                 "file for the rows, written as they are computed; if it already has the first "
                 "rows of this study, the study continues from there (a table with tabs; other "
                 "formats are written completely at the end)",
                 .unset = "standard output", .file = RB_FILE_WRITTEN),
    RB_FLAG_LINE("restart", PLACE(restart), "start again and overwrite the output file"),
    RB_INTEGER_LINE("jobs", PLACE(jobs), RB_FROM_TO(0, 256),
                    "processes; 0: as many as there are processors"),
    RB_FLAG_LINE("progress", PLACE(progress),
                 "print the time left even when standard error is not a terminal"),
    RB_FLAG_LINE("quiet", PLACE(quiet), "no summary on standard error"),
    RB_FLAG_LINE("cite", PLACE(cite), "print references to the methods used to standard error"),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

_Static_assert(OPTIONS <= 32, "given");

static const char about[] =
    "Solves many cases that differ in some options, one process per processor, and\n"
    "prints a row per case, in order. STUDY.ini is a case file with a section [sweep].\n"
    "The cases are all combinations of the values of vary-1 ... vary-4 and of the\n"
    "rows of --cases; the last one varies fastest. Under mpirun its processes share\n"
    "the work, each with a part of the processors of its machine. If an option of a\n"
    "crack is given or varies, the contact of each case moves over the crack as in\n"
    "`rollbem crack`, and the results are those of the crack.\n"
    "\n" CLI_CASE_SIGNS;

static const char notes[] = CLI_CASE_NOTES
    "Columns: case, the varied options, status (0 solved), then results and, with --error,\n"
    "their error bars.\n"
    "Example: rollbem sweep --similar --support halfplane --formulation steady \\\n"
    "           --load 500 --vary-1 'mu 0.1 0.3' --vary-2 'creep-ratio 0:1.5:31'\n"
    "         rollbem sweep examples/rail/case.ini --vary-1 'load 2000:20000:10' \\\n"
    "           --vary-2 'creep 0:0.008:21' --map force.png\n"
    "         rollbem sweep --similar --support halfplane --half-width 1 --mu 0 \\\n"
    "           --vary-1 'crack-length 0.5:2:7' --vary-2 'crack-angle 20:70:11' \\\n"
    "           --map K.png --show K_II_max\n";

/* ---- Rows -------------------------------------------------------------------------- */

/* Of every input and of the columns: tells whether a file holds rows of this study. */
static cli_exit find_fingerprint(study *st)
{
    rb_message why = {.text = ""};
    uint64_t hash;
    const rb_status s = rb_report_input_hash(st->base, &hash, &why);
    if (s != RB_OK)
        return cli_say(s, &why);
    hash = rb_hash(hash, RB_VERSION, sizeof RB_VERSION);
    if (st->slopes.tolerance)
        hash = rb_hash(hash, st->slopes.tolerance, strlen(st->slopes.tolerance));
    for (int k = 0; k < st->columns; k++) {
        const study_column *c = &st->column[k];
        hash = rb_hash(hash, c->name, strlen(c->name));
        hash = rb_hash(hash, c->value, (size_t)st->rows[c->factor] * sizeof(double));
        for (int i = 0; c->word && i < st->rows[c->factor]; i++)
            hash = c->word[i] ? rb_hash(hash, c->word[i], strlen(c->word[i]) + 1) : hash;
    }
    st->fingerprint = hash;
    return CLI_CONTINUE;
}

/* Columns: the number of the case, what varies, the status, the results, derivatives,
 * standard deviations. */
static int column_count(const study *st)
{
    return 1 + st->columns + 1 + st->results + st->slopes.n + st->slopes.deviations;
}

static const char *column_name(const study *st, int j, char text[STUDY_HEADING])
{
    char heading[RB_ROLLING_HEADING];
    const rb_units units = rb_case_resolved(st->base)->units;
    const int slope = j - st->columns - 2 - st->results;
    if (slope >= st->slopes.n) {
        const rb_rolling_result *r = st->slopes.deviation[slope - st->slopes.n];
        snprintf(text, STUDY_HEADING, "deviation_%s", rb_rolling_heading(r, units, heading));
        return text;
    }
    if (slope >= 0)
        return rb_case_slope_heading(&st->slopes.of[slope], units, text);
    if (j == 0)
        return "case";
    if (j <= st->columns)
        return st->column[j - 1].heading;
    if (j == st->columns + 1)
        return "status";
    const study_result *result = &st->result[j - st->columns - 2];
    snprintf(text, STUDY_HEADING, "%s%s", result->is_error ? "error_" : "",
             rb_rolling_heading(result->r, units, heading));
    return text;
}

/* row NULL: what is known before the case is solved. */
static double cell_value(const study *st, int j, int k, const rb_rolling_row *row)
{
    if (j == 0)
        return k + 1;
    if (j <= st->columns)
        return cli_study_value(st, &st->column[j - 1], k);
    if (j == st->columns + 1)
        return (double)row->solution.status;
    const int slope = j - st->columns - 2 - st->results;
    const rb_units units = rb_case_resolved(st->base)->units;
    if (slope >= st->slopes.n) {
        const rb_rolling_result *r = st->slopes.deviation[slope - st->slopes.n];
        return rb_unit_shown(units, r->unit, row->own[slope]);
    }
    if (slope >= 0)
        return rb_case_slope_shown(&st->slopes.of[slope], units, row->own[slope]);
    const study_result *result = &st->result[j - st->columns - 2];
    if (result->of == OF_CRACK)
        return rb_unit_shown(units, result->r->unit,
                             rb_case_crack_of_row(result->r, result->is_error, row));
    if (result->of == OF_BOND)
        return rb_unit_shown(units, result->r->unit,
                             (result->is_error ? row->bond_error : row->bond)[result->bond]);
    const rb_rolling_errors *e = &row->errors;
    const void *const owners[2][3] = {{&row->solution, &row->stress, &row->stress_b},
                                      {&e->scalar, &e->stress, &e->stress_b}};
    const void *owner = owners[result->is_error != 0][result->of];
    return rb_rolling_number(result->r, owner);
}

/* NULL: the cell has a number. */
static const char *cell_word(const study *st, int j, int k)
{
    return j > 0 && j <= st->columns ? cli_study_word(st, &st->column[j - 1], k) : NULL;
}

enum { HEAD_LINES = 5, COMMAND_LINE = 2 };

static void write_head(const study *st, FILE *out)
{
    char heading[STUDY_HEADING];
    rb_report_cells c = rb_report_cells_begin(out, &st->o->style, "");
    for (int j = 0; j < column_count(st); j++)
        rb_report_cell_text(&c, column_name(st, j, heading));
    rb_report_cells_end_row(&c);
    rb_report_comment_origin(&c, cli_command_line());
    rb_report_comment(&c, "study %016" PRIx64 " of %d case%s%s%s", st->fingerprint, st->cases,
                      rb_plural(st->cases),
                      st->o->tolerance ? ", standard deviations of inputs: " : "",
                      st->o->tolerance ? st->o->tolerance : "");
    rb_report_comment(&c, "status 0: solved. xi > 0: A's surface slides towards +x, the friction "
                          "on A points to -x, Q < 0");
}

/* A case that was not solved shows in the exit code. */
static void count_status(study *st, int k, rb_status status)
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

static void write_notes(study *st, int k, const rb_rolling_row_notes *said)
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

/* 1: the line is such a note, of a row that follows. */
static int is_note(study *st, const char *line)
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

static int see_row(int k, const rb_rolling_row *row, void *context)
{
    study *st = context;
    rb_report_cells c = {.out = st->out, .style = st->o->style};
    rb_rolling_row shown = *row;

    rb_rolling_row_convert(&shown, rb_case_resolved(st->base)->units);
    rb_case_note_materials_of_row(st->base, &shown.notes); /* which are given is one for all */
    write_notes(st, k, &shown.notes);
    for (int j = 0; j < column_count(st); j++) {
        const double x = cell_value(st, j, k, &shown);
        const char *word = cell_word(st, j, k);
        cli_study_keep(st, j, k, shown.solution.status == RB_OK ? x : NAN);
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
    /* Means and deviations of a sample: of what has come in this run. */
    if (st->o->sample != 0 && shown.solution.status == RB_OK) {
        for (int j = 0; j < st->results; j++) {
            const double x = cell_value(st, st->columns + 2 + j, k, &shown);
            if (st->summed == 0)
                st->first_result[j] = x;
            st->sum[j] += x - st->first_result[j];
            st->square[j] += (x - st->first_result[j]) * (x - st->first_result[j]);
        }
        st->summed++;
    }
    count_status(st, k, row->solution.status);
    return ferror(st->out);
}

static rb_status make_case(int k, rb_rolling_case *rc, void *context)
{
    study *st = context;
    rb_message why = {.text = ""};
    const rb_status s = cli_study_try_one(st, k, &why);
    if (s == RB_OK)
        *rc = rb_case_resolved(st->one)->rc;
    return s;
}

static const rb_rolling_program *program_of_case(void *context)
{
    const study *st = context;
    const rb_resolved_case *one = rb_case_resolved(st->one);
    return one->program.n > 0 ? &one->program : NULL;
}

/* A case without derivatives has its results. */
static rb_status measure_slopes(const rb_rolling_model *model, double *own, void *context,
                                rb_message *why)
{
    const study *st = context;
    return rb_case_slopes_row(st->one, model, &st->slopes, own, why);
}

static rb_status solve_crack(int k, rb_rolling_row *row, void *context, rb_message *why)
{
    study *st = context;
    const rb_status s = cli_study_try_one(st, k, why);
    return s == RB_OK
               ? rb_case_crack_row(rb_case_resolved(st->one), rb_case_crack_of(st->one), row, why)
               : s;
}

/* ---- Progress ---------------------------------------------------------------------- */

/* 1: all rows so far are in the file. */
static int flush_rows(study *st)
{
    if (fflush(st->out) != 0)
        return 0;
    if (st->path)
        st->whole = ftell(st->out);
    return 1;
}

/* Rows reach the file at least twice a second.  Where nobody looks on, a line after ten
 * seconds and whenever these have doubled says how far the study is. */
static int tick(int finished, void *context)
{
    study *st = context;
    const double now = rb_seconds(), spent = now - st->start;
    const int left = st->cases - st->first - finished;

    if (cli_interrupted())
        return 1;
    if (now - st->shown < 0.5)
        return 0;
    st->shown = now;
    const int terminal = isatty(STDERR_FILENO);
    const int is_due = spent >= st->told_next;
    while (st->told_next <= spent)
        st->told_next *= 2.0;
    if (!st->o->quiet && (is_due || (finished > 0 && (terminal || st->o->progress)))) {
        fprintf(stderr, "%scase %d of %d, ", terminal ? "\r" : "", st->first + finished, st->cases);
        fprintf(stderr, finished > 0 ? "%.0f s left%s" : "%.0f s so far%s",
                finished > 0 ? spent / finished * left : spent,
                terminal && left > 0 ? "\033[K" : "\n");
    }
    return !flush_rows(st);
}

/* ---- The output file --------------------------------------------------------------- */

static cli_exit cannot_write(const char *path)
{
    return errno == ENOMEM ? cli_fail(CLI_INTERNAL, "%s: out of memory", path)
                           : cli_fail(CLI_CANTWRITE, "%s: cannot write: %s", path, strerror(errno));
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
static int is_row(study *st, int k, const char *line, size_t length)
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
    for (int j = st->columns + 2; good && j < column_count(st); j++) {
        good = next_number(&at, &value);
        if (good)
            cli_study_keep(st, j, k, status == RB_OK ? value : NAN);
    }
    if (good && *at == '\n')
        count_status(st, k, (rb_status)status);
    return good && *at == '\n';
}

/* Reads the rows that are there; what was cut at the end is written over. */
static cli_exit resume(study *st)
{
    char *line = NULL, *head = NULL;
    size_t capacity = 0, size;
    ssize_t n;
    cli_exit code = CLI_CONTINUE;
    /* The head of this study, but for the command line, which may name another count of
     * jobs. */
    FILE *memory = open_memstream(&head, &size);
    int same = memory != NULL;
    if (memory) {
        write_head(st, memory);
        same = fclose(memory) == 0;
    }
    const char *wanted = head;
    for (int k = 0; same && k < HEAD_LINES; k++) {
        const size_t length = strcspn(wanted, "\n") + 1;
        n = getline(&line, &capacity, st->out);
        same =
            k == COMMAND_LINE ? n > 0 : n == (ssize_t)length && memcmp(line, wanted, length) == 0;
        wanted += length;
    }
    free(head);
    if (!same)
        code = cli_fail(CLI_CANTWRITE, "%s: has other contents; --restart would overwrite it",
                        st->path);
    st->whole = ftell(st->out);
    while (code == CLI_CONTINUE && (n = getline(&line, &capacity, st->out)) > 0 &&
           line[n - 1] == '\n') {
        if (is_note(st, line))
            continue;
        if (st->first == st->cases || !is_row(st, st->first, line, (size_t)n))
            code = cli_fail(
                CLI_CANTWRITE,
                "%s:%d: not the row of case %d of this study; --restart would overwrite the file",
                st->path, HEAD_LINES + st->first + 1, st->first + 1);
        st->first++;
        st->noted = st->found;
        st->whole = ftell(st->out);
    }
    st->found = 0;
    free(line);
    if (code != CLI_CONTINUE)
        st->path = NULL; /* it is another's: nothing of it is taken back */
    if (code == CLI_CONTINUE &&
        (ftruncate(fileno(st->out), st->whole) != 0 || fseek(st->out, st->whole, SEEK_SET) != 0))
        code = cannot_write(st->path);
    if (code == CLI_CONTINUE && !st->o->quiet && st->first > 0)
        fprintf(stderr, "rollbem: %s holds %d of %d case%s\n", st->path, st->first, st->cases,
                rb_plural(st->cases));
    return code;
}

static cli_exit close_output(study *st, cli_exit code)
{
    if (st->w.file) {
        rb_message why = {.text = ""};
        rb_status s = RB_OK;
        if (!st->complete || st->lost) {
            rb_io_writer_abandon(&st->w);
            return st->lost ? cli_fail(CLI_INTERNAL, "out of memory") : code;
        }
        if (st->list) {
            const rb_units units = rb_case_resolved(st->base)->units;
            char heading[STUDY_HEADING];
            json_t *root = rb_report_json_start(cli_command_line()), *table = json_object();
            const rb_rolling_note_list said = rb_rolling_list_study_notes(&st->notes, "case");
            rb_report_json_set(&root, "notes", rb_report_json_notes(&said));
            for (int j = 0; j < column_count(st); j++)
                rb_report_json_set(&table, column_name(st, j, heading),
                                   json_incref(json_array_get(st->list, (size_t)j)));
            rb_report_json_set(&root, "units", rb_report_json_units(units));
            rb_report_json_set(&root, "inputs", rb_report_json_inputs(st->base)); /* first case */
            if (st->o->tolerance)
                rb_report_json_uncertain_text(&root, st->o->tolerance);
            rb_report_json_set(&root, "table", table);
            s = rb_report_json_write(st->out, root);
        }
        if (s == RB_OK)
            s = rb_io_writer_commit(&st->w, &why);
        else {
            if (s == RB_EWRITE)
                rb_fail(&why, s, "%s: cannot write: %s",
                        st->o->output ? st->o->output : "standard output", strerror(errno));
            const int e = errno;
            rb_io_writer_abandon(&st->w);
            errno = e;
        }
        if (s == RB_EWRITE && !st->o->output && errno == EPIPE)
            return CLI_CANTWRITE; /* | head has seen enough */
        return s == RB_OK ? code : cli_say(s, &why);
    }
    int failed = ferror(st->out) || !flush_rows(st), e = errno;
    if (st->out != stdout && fclose(st->out) != 0 && !failed) {
        failed = 1;
        e = errno;
    }
    st->out = NULL;
    if (st->text && !failed) {
        failed = cli_show_table(st->text, 4) != RB_OK;
        e = errno;
    }
    free(st->text);
    st->text = NULL;
    if (failed && st->path) {
        /* What was not written whole is taken back: half a row, half a head. */
        struct stat now;
        if (st->created && st->whole == 0)
            unlink(st->path);
        else if (stat(st->path, &now) == 0 && now.st_size > st->whole)
            (void)!truncate(st->path, st->whole);
    }
    if (!failed || code == CLI_CANTWRITE || (!st->path && e == EPIPE))
        return failed ? CLI_CANTWRITE : code;
    errno = e;
    return cannot_write(st->o->output ? st->o->output : "standard output");
}

static cli_exit open_output(study *st)
{
    struct stat old;
    const char *path = st->o->output;
    const int exists = path && stat(path, &old) == 0;

    if (st->o->style.format != RB_REPORT_TSV || st->o->style.bare) {
        /* What cannot be resumed appears at the end, whole. */
        rb_message why = {.text = ""};
        const rb_status s = rb_io_writer_open(st->o->output, &st->w, &why);
        if (s != RB_OK)
            return cli_say(s, &why);
        st->out = st->w.file;
        if (st->o->style.format == RB_REPORT_JSON) {
            /* The lists that see_row fills. */
            st->list = json_array();
            for (int j = 0; j < column_count(st); j++)
                rb_report_json_append(&st->list, json_array());
            return st->list ? CLI_CONTINUE : cli_fail(CLI_INTERNAL, "out of memory");
        }
        write_head(st, st->out);
        return CLI_CONTINUE;
    }
    st->out = stdout;
    if (!path && cli_reader_is_person()) {
        st->out = open_memstream(&st->text, &st->size);
        if (!st->out)
            return cli_fail(CLI_INTERNAL, "out of memory");
        write_head(st, st->out);
        return CLI_CONTINUE;
    }
    if (!path || strcmp(path, "-") == 0 || (exists && !S_ISREG(old.st_mode))) {
        if (exists)
            st->out = fopen(path, "w");
        if (!st->out)
            return cannot_write(path);
        write_head(st, st->out);
        return CLI_CONTINUE;
    }
    const int fd = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    st->out = fd >= 0 ? fdopen(fd, "r+") : NULL;
    if (!st->out) {
        const cli_exit code = cannot_write(path);
        if (fd >= 0)
            close(fd);
        return code;
    }
    st->path = path;
    st->created = !exists;
    /* Two processes on one file would mix their rows; some file systems have no locks. */
    struct flock all = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    struct stat now;
    cli_exit code = CLI_CONTINUE;
    if (fcntl(fd, F_SETLK, &all) != 0 && (errno == EACCES || errno == EAGAIN))
        code = cli_fail(CLI_CANTWRITE, "%s: another process is writing it", path);
    else if (st->o->restart && ftruncate(fd, 0) != 0)
        code = cannot_write(path);
    else if (fstat(fd, &now) == 0 && now.st_size > 0)
        code = resume(st);
    else {
        write_head(st, st->out);
        code = flush_rows(st) ? CLI_CONTINUE : cannot_write(path);
    }
    return code == CLI_CONTINUE ? code : close_output(st, code);
}

/* ---- Command ----------------------------------------------------------------------- */

static rb_rolling_sweep sweep_of(study *st)
{
    unsigned also = rb_case_resolved(st->base)->error ? RB_ROW_ERRORS : 0;
    for (int k = 0; k < st->results; k++)
        also |= cli_study_stress_of(st, &st->result[k]);
    return (rb_rolling_sweep){.first = st->first,
                              .also = also,
                              .bonds = st->bonds,
                              .bond = st->bond,
                              .units = rb_case_resolved(st->base)->units,
                              .count = st->cases - st->first,
                              .workers = st->o->jobs,
                              .make = make_case,
                              .program = program_of_case,
                              .measure =
                                  st->slopes.n + st->slopes.deviations > 0 ? measure_slopes : NULL,
                              .solve = st->has_crack ? solve_crack : NULL,
                              .see = see_row,
                              .tick = tick,
                              .context = st};
}

static void print_summary(FILE *out, const void *context)
{
    const study *st = context;
    const rb_rolling_note_list said = rb_rolling_list_study_notes(&st->notes, "case");
    char heading[STUDY_HEADING];
    const double n = st->summed;

    rb_report_notes(out, &said, cli_is_coloured(stderr));
    fprintf(out, "study: %d case%s in %.3g s; not solved: %d of %d\n", st->ran, rb_plural(st->ran),
            st->spent, st->unsolved, st->cases);
    for (int j = 0; j < st->results && st->summed > 1; j++) {
        const double mean = st->sum[j] / n;
        const double variance = (st->square[j] - n * mean * mean) / (n - 1.0);
        const rb_rolling_result *r = st->result[j].r;
        const double rounding =
            rb_sensitivity_rounding(&rb_case_resolved(st->base)->rc, r, st->first_result[j] + mean);
        if (rb_sensitivity_has(r) && sqrt(fmax(variance, 0.0)) > rounding)
            fprintf(out, "  %-28s %.6g +- %.2g\n", column_name(st, st->columns + 2 + j, heading),
                    st->first_result[j] + mean, sqrt(variance));
    }
}

static cli_exit run(study *st)
{
    rb_message why = {.text = ""};
    const rb_rolling_sweep sweep = sweep_of(st);

    cli_interrupts_catch();
    st->start = st->shown = rb_seconds();
    st->told_next = isatty(STDERR_FILENO) ? 2.0 : 10.0;
    const rb_status s = cli_pool_run(&sweep, &why);
    cli_interrupts_leave();
    const double spent = rb_seconds() - st->start;
    if (s == RB_INTERRUPTED && ferror(st->out))
        return CLI_OK; /* close_output says it */
    if (s != RB_OK)
        return cli_fail(cli_exit_of(s), "%s%s", why.text,
                        st->path ? "; the same command continues from there" : "");
    st->complete = 1;
    st->ran = sweep.count;
    st->spent = spent;
    if (!st->o->quiet)
        cli_print_lines(print_summary, st);
    if (st->unsolved_case) {
        /* Rows have no place for words: the first that was not solved is solved once more. */
        rb_rolling_row row;
        rb_message reason = {.text = ""};
        rb_rolling_sweep_case(&sweep, st->unsolved_case - 1, &row, &reason);
        if (row.solution.status == RB_EINVAL && !reason.text[0]) /* a sample that is no case */
            cli_study_try_one(st, st->unsolved_case - 1, &reason);
        if (row.solution.status != RB_OK)
            cli_fail(CLI_UNSOLVED, "case %d is not solved: %s", st->unsolved_case,
                     reason.text[0] ? reason.text : rb_status_text(row.solution.status));
    }
    if (st->o->cite)
        cli_print_citations(&rb_case_resolved(st->base)->rc, NULL);
    if (st->no_memory > 0)
        cli_fail(CLI_INTERNAL, "out of memory in %d case%s, of status %d", st->no_memory,
                 rb_plural(st->no_memory), RB_ENOMEM);
    return (cli_exit)st->worst;
}

/* All that can be refused, and the output file. */
static cli_exit prepare(const cli_spec *spec, int argc, char **argv, rb_case *c, cli_args *args,
                        study *st)
{
    cli_exit code = cli_case_read(spec, argc, argv, c, args);

    st->file = cli_case_file_of(args);
    if (code == CLI_CONTINUE)
        code = cli_study_read(st);
    if (code == CLI_CONTINUE && st->o->sample > 0) {
        rb_message why = {.text = ""};
        code = cli_say(rb_case_resolve(c, &why), &why);
        if (code == CLI_CONTINUE)
            code = cli_study_sample(st, c);
    }
    /* with values, because other options may stand only beside one that varies */
    if (st->has_crack) /* its contact may be any that passes */
        rb_case_set_purpose(c, RB_CASE_CRACK);
    if (code == CLI_CONTINUE)
        code = cli_study_set_values(st, c, cli_study_first(st, c));
    if (code == CLI_CONTINUE)
        code = cli_case_resolve(spec, c, args);
    if (code == CLI_CONTINUE)
        code = cli_check_units(c, st->own, args);
    if (code == CLI_CONTINUE)
        code = cli_study_check(st);
    if (code == CLI_CONTINUE)
        code = cli_study_choose_results(st);
    if (code == CLI_CONTINUE)
        code = cli_study_prepare_pictures(st);
    if (code == CLI_CONTINUE)
        code = find_fingerprint(st);
    if (code == CLI_CONTINUE && !cli_pool_is_worker())
        code = open_output(st);
    return code;
}

int cli_sweep(int argc, char **argv)
{
    study_options o = {0};
    cli_args args = {0};
    rb_case *c = cli_case_create(RB_CASE_STUDY);
    study st = {.base = c, .o = &o, .over = -1, .family = -1};
    if (!c)
        return CLI_INTERNAL;
    const cli_spec spec = {.synopsis = "rollbem sweep [OPTION...] [STUDY.ini]",
                           .about = about,
                           .notes = notes,
                           .refused = ",paris,paris-range,threshold,growth,grow-to,grow-steps,",
                           .purpose = RB_CASE_STUDY,
                           .second = RB_CASE_CRACK,
                           .sets = {rb_case_options(c),
                                    {options, OPTIONS, &o, o.given, NULL},
                                    rb_case_crack_set(c),
                                    cli_example_set()},
                           .set_n = 4};
    st.own = &spec.sets[1];
    rb_case_also_locate(c, st.own);
    st.cracks = &spec.sets[2];
    cli_exit code = cli_pool_begin(argc, argv);
    if (code != CLI_CONTINUE) {
        rb_case_free(c);
        return code;
    }
    code = prepare(&spec, argc, argv, c, &args, &st);
    code = cli_pool_agree(code, code == CLI_CONTINUE ? st.fingerprint : 0);
    if (cli_pool_is_worker()) {
        const rb_rolling_sweep sweep = sweep_of(&st);
        rb_message why = {.text = ""};
        if (code == CLI_CONTINUE)
            cli_pool_run(&sweep, &why);
        code = CLI_OK; /* rank 0 has the exit code */
    } else {
        if (code == CLI_CONTINUE)
            code = run(&st);
        if (st.out)
            code = close_output(&st, code);
        if (st.complete)
            code = cli_study_draw(&st, code);
    }
    cli_pool_end();
    cli_study_free_columns(&st);
    free(st.drawn);
    free(st.band);
    rb_case_slopes_free(&st.slopes);
    json_decref(st.list);
    rb_case_free(st.one);
    cli_args_free(&args);
    rb_case_free(c);
    return code;
}
