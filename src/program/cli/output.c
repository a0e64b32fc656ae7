#include "program/cli/output.h"

#include "base/io/io.h"

#include <errno.h>
#include <jansson.h>
#include <stddef.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* --json is a flag in the place of the format: it sets 1. */
_Static_assert(RB_REPORT_JSON == 1, "--json");

const rb_choice cli_formats[] = {{"tsv", RB_REPORT_TSV},
                                 {"csv", RB_REPORT_CSV},
                                 {"json", RB_REPORT_JSON},
                                 {"brief", RB_REPORT_TSV},
                                 {NULL, 0}};
const rb_choice cli_headers[] = {{"full", 0}, {"bare", 1}, {NULL, 0}};

const rb_choice cli_picture_sizes[] = {{"own", RB_REPORT_OWN_SIZE},
                                       {"85mm", RB_REPORT_85MM},
                                       {"170mm", RB_REPORT_170MM},
                                       {"slide", RB_REPORT_SLIDE},
                                       {NULL, 0}};

#define PLACE(member) offsetof(cli_output, member)

#define FIRST_LINES                                                                                \
    RB_GROUP_LINE("output", "Output"), CLI_STYLE_LINES(PLACE(style)), CLI_OUTPUT_LINE(PLACE(output))
#define LAST_LINES                                                                                 \
    RB_FLAG_LINE("quiet", PLACE(quiet), "no summary and no notes on standard error"),              \
        RB_FLAG_LINE("cite", PLACE(cite),                                                          \
                     "print references to the methods used to standard "                           \
                     "error")

static const rb_option options[] = {
    FIRST_LINES, CLI_PLOT_LINES(PLACE(plot), PLACE(pictures)), LAST_LINES,
    RB_FLAG_LINE("dimensionless", PLACE(style) + offsetof(rb_report_style, dimensionless),
                 "table and picture in x/a, p/p0, q/(mu p0), "
                 "depth/a, stress/p0, a and p0 those of the "
                 "contact; without friction q/p0")};
static const rb_option without_pictures[] = {FIRST_LINES, LAST_LINES};

enum { OPTIONS = sizeof options / sizeof options[0] };

_Static_assert((int)OPTIONS <= (int)CLI_OUTPUT_OPTIONS_MAX, "CLI_OUTPUT_OPTIONS_MAX is too small");

rb_option_set cli_output_set(cli_output *o, int draws, int has_scales)
{
    const int n =
        draws ? OPTIONS - !has_scales : (int)(sizeof without_pictures / sizeof *without_pictures);
    return (rb_option_set){draws ? options : without_pictures, n, o, o->given, NULL};
}

/* ---- Terminals --------------------------------------------------------------------- */

int cli_reader_is_person(void)
{
    const char *line = cli_command_line();
    if (strstr(line, " --format=brief") || strstr(line, " --format brief"))
        return 1;
    return isatty(STDOUT_FILENO) && !strstr(line, " --header") && !strstr(line, " --format");
}

static int lines_above; /* of a table on the terminal */

/* Summary and table of a terminal: what is longer than the window is read page by page. */
static struct {
    FILE *text; /* NULL: everything goes straight to the terminal */
    char *at;
    size_t size;
} page;

void cli_page_begin(void)
{
    if (isatty(STDOUT_FILENO) && isatty(STDERR_FILENO))
        page.text = open_memstream(&page.at, &page.size);
}

void cli_page_end(void)
{
    if (!page.text)
        return;
    if (fclose(page.text) == 0) {
        int lines = 1; /* of the prompt */
        for (const char *c = page.at; *c; c++)
            lines += *c == '\n';
        FILE *pager = lines > cli_terminal_height() ? cli_open_pager() : NULL;
        fputs(page.at, stdout);
        cli_close_pager(pager);
    }
    free(page.at);
    page.text = NULL;
}

rb_status cli_show_table(char *text, int summary)
{
    const rb_report_window window = {cli_terminal_height() - summary,
                                     cli_terminal_width(STDOUT_FILENO), cli_is_coloured(stdout),
                                     " h gap un ut shift principal_1 principal_2 hydrostatic "};
    return rb_report_terminal(page.text ? page.text : stdout, text, &window);
}

void cli_print_lines(cli_lines *print, const void *context)
{
    char *text = NULL;
    size_t size;
    FILE *memory = isatty(STDERR_FILENO) ? open_memstream(&text, &size) : NULL;
    print(memory ? memory : stderr, context);
    if (memory && fclose(memory) == 0)
        lines_above += rb_report_wrapped(page.text ? page.text : stderr, text,
                                         cli_terminal_width(STDERR_FILENO));
    free(text);
}

typedef struct {
    const rb_rolling_case *rc;
    const rb_rolling_solution *solution;
} cited;

static void write_citations(FILE *out, const void *context)
{
    const cited *of = context;
    rb_report_citations(out, of->rc, of->solution);
}

void cli_print_citations(const rb_rolling_case *rc, const rb_rolling_solution *solution)
{
    const cited of = {rc, solution};
    cli_print_lines(write_citations, &of);
}

/* ---- Files that options name ------------------------------------------------------- */

const char *cli_option_path(const cli_spec *spec, const char *name)
{
    int i;
    rb_guess guess = {.word = name};
    const rb_option_set *set =
        rb_option_find(spec->set_n, spec->sets, name, strlen(name), &i, &guess);
    return set ? rb_option_path(&set->options[i], set->target) : NULL;
}

/* The same file, by whatever names.  Devices may be input and output. */
static int same_file(const char *a, const char *b)
{
    struct stat x, y;
    if (stat(a, &x) != 0 || stat(b, &y) != 0)
        return strcmp(a, b) == 0;
    return x.st_dev == y.st_dev && x.st_ino == y.st_ino && !S_ISCHR(x.st_mode);
}

/* The next option from (*set, *i) on that names a file; its path, or NULL. */
static const char *next_path(const cli_spec *spec, int *set, int *i, const rb_option **o)
{
    for (; *set < spec->set_n; ++*set, *i = 0)
        for (; *i < spec->sets[*set].n; ++*i) {
            *o = &spec->sets[*set].options[*i];
            const char *path = rb_option_path(*o, spec->sets[*set].target);
            if (path) {
                ++*i;
                return path;
            }
        }
    return NULL;
}

static int is_output(const rb_option *o)
{
    return o->file == RB_FILE_WRITTEN || o->file == RB_FILE_PICTURE;
}

/* The output `path` of option `o` against all other files. */
static cli_exit check_clash(const cli_spec *spec, const cli_args *args, const rb_option *o,
                            const char *path)
{
    const rb_option *other;
    const char *name;
    int set = 0, i = 0;
    for (int k = 0; k < args->operands; k++)
        if (same_file(path, args->operand[k]))
            return cli_fail(CLI_USAGE, "--%s: '%s' is an input file and would be overwritten",
                            o->name, path);
    while ((name = next_path(spec, &set, &i, &other)) != NULL) {
        if (other == o || other->file == RB_FILE_FOLDER || !same_file(path, name))
            continue;
        if (is_output(other))
            return cli_fail(CLI_USAGE, "--%s and --%s: both would write '%s'", o->name, other->name,
                            path);
        return cli_fail(CLI_USAGE, "--%s: '%s' is an input file (--%s) and would be overwritten",
                        o->name, path, other->name);
    }
    return CLI_CONTINUE;
}

/* The kind of the picture that --option asks for, with its gnuplot script or without. */
static rb_status check_picture(const char *option, const char *path, int with_script,
                               rb_message *why)
{
    rb_report_picture_kind kind;
    rb_message reason = {.text = ""};

    if (rb_report_picture_kind_of(path, &kind, &reason) != RB_OK)
        return rb_fail(why, RB_EINVAL, "--%s: %s", option, reason.text);
    if (kind == RB_REPORT_GIF && strcmp(option, "history-plot") != 0)
        return rb_fail(why, RB_EINVAL,
                       "--%s: a .gif shows a history step by step (--history-plot FILE.gif); for "
                       "this picture take a name ending in " RB_REPORT_KINDS,
                       option);
    if (kind == RB_REPORT_TEX && with_script)
        return rb_fail(why, RB_EINVAL,
                       "--plot-script: gnuplot alone does not write the texts of a .tex picture as "
                       "LaTeX reads them; give --%s a file of another kind",
                       option);
    return RB_OK;
}

cli_exit cli_check_files(const cli_spec *spec, const cli_args *args)
{
    /* What is said about pictures needs one, or one alone. */
    struct {
        const char *name;
        int alone, given;
        const rb_option *of;
    } about[] = {
        {"plot-size", 0, 0, NULL}, {"plot-script", 1, 0, NULL}, {"plot-template", 1, 0, NULL}};
    const rb_option *o;
    const char *path, *file = cli_case_file_of(args);
    char name[300];
    cli_exit code = CLI_CONTINUE;
    int set = 0, i = 0, pictures = 0;
    for (int k = 0; k < spec->set_n; k++)
        for (int j = 0; j < spec->sets[k].n; j++) {
            const rb_option_set *of = &spec->sets[k];
            o = &of->options[j];
            pictures += o->file == RB_FILE_PICTURE && rb_option_path(o, of->target);
            for (size_t m = 0; m < sizeof about / sizeof *about; m++)
                if (strcmp(o->name, about[m].name) == 0 && of->given[j]) {
                    about[m].given = of->given[j];
                    about[m].of = o;
                }
        }
    for (size_t m = 0; m < sizeof about / sizeof *about; m++) {
        if (!about[m].given || pictures == 1 || (pictures > 1 && !about[m].alone))
            continue;
        const char *source = rb_option_source(about[m].of, about[m].given, file, name, sizeof name);
        code = about[m].given > 0 ? CLI_DATA : CLI_USAGE;
        return about[m].alone
                   ? cli_fail(code, "%s: expected one picture (such as --plot FILE), got %d",
                              source, pictures)
                   : cli_fail(code, "%s: there is no picture; --plot FILE asks for one", source);
    }
    while (code == CLI_CONTINUE && (path = next_path(spec, &set, &i, &o)) != NULL) {
        if (o == about[2].of && access(path, R_OK) != 0) /* before anything is solved */
            return cli_fail(CLI_NOINPUT, "%s: %s", path, strerror(errno));
        if (is_output(o) && strcmp(path, "-") != 0)
            code = check_clash(spec, args, o, path);
        if (code == CLI_CONTINUE && o->file != RB_FILE_READ) {
            rb_message why = {.text = ""};
            if (o->file == RB_FILE_PICTURE &&
                check_picture(o->name, path, about[1].given != 0, &why) != RB_OK)
                code = cli_fail(CLI_USAGE, "%s", why.text);
            else
                code = cli_say(o->file == RB_FILE_FOLDER ? rb_io_folder_check(path, &why)
                                                         : rb_io_writer_check(path, &why),
                               &why);
        }
    }
    return code;
}

/* ---- Open, write, commit ----------------------------------------------------------- */

rb_status cli_write_to(const char *path, cli_write *write, const void *context, rb_message *why)
{
    rb_io_writer w;
    if (!path && cli_reader_is_person()) {
        /* What would go to a terminal, abbreviated there. */
        char *text = NULL;
        size_t size;
        FILE *memory = open_memstream(&text, &size);
        if (!memory)
            return rb_fail(why, RB_ENOMEM, "out of memory");
        rb_status s = write(memory, context, why);
        if (fclose(memory) != 0 && s == RB_OK)
            s = RB_ENOMEM;
        if (s == RB_OK)
            s = cli_show_table(text, lines_above + 1); /* and the command */
        free(text);
        return s;
    }
    rb_status s = rb_io_writer_open(path, &w, why);
    if (s != RB_OK)
        return s;
    s = write(w.file, context, why);
    if (s == RB_OK)
        return rb_io_writer_commit(&w, why);
    if (s == RB_EWRITE && ferror(w.file))
        rb_fail(why, s, "%s: cannot write: %s", path ? path : "standard output", strerror(errno));
    const int e = errno;
    rb_io_writer_abandon(&w);
    errno = e;
    return s;
}

cli_exit cli_write_file(const char *path, cli_write *write, const void *context)
{
    rb_message why = {.text = ""};
    const rb_status s = cli_write_to(path, write, context, &why);
    if (s == RB_EWRITE && !path && errno == EPIPE)
        return CLI_CANTWRITE; /* | head has seen enough */
    return s == RB_OK ? CLI_OK : cli_say(s, &why);
}

typedef struct {
    const char *option, *template_file;
    rb_report_canvas canvas;
    cli_draw *draw;
    const void *context;
} drawing;

static rb_status draw_picture(FILE *out, const void *context, rb_message *why)
{
    const drawing *d = context;
    rb_message reason = {.text = ""};
    if (d->canvas.script)
        fprintf(out, "# %s\n# gnuplot -d writes the picture to standard output.\n",
                cli_command_line());
    const rb_status s = d->draw(out, d->canvas, d->context, &reason);
    if (s == RB_OK || (s == RB_EWRITE && ferror(out)))
        return s;
    if (s == RB_EFORMAT)
        return rb_fail(why, s, "%s: %s", d->template_file, rb_status_reason(s, &reason));
    return rb_fail(why, s, "--%s: %s", d->option, rb_status_reason(s, &reason));
}

cli_exit cli_draw_file(const cli_pictures *pictures, const char *option, const char *path,
                       cli_draw *draw, const void *context)
{
    drawing d = {
        .option = option, .template_file = pictures->own, .draw = draw, .context = context};
    rb_message why = {.text = ""};
    char *own = NULL;
    size_t size;
    if (!path)
        return CLI_OK;
    if (pictures->own) {
        const rb_status s = rb_io_read_text(pictures->own, &own, &size, &why);
        if (s != RB_OK)
            return cli_say(s, &why);
        d.canvas.own = own;
    }
    d.canvas.size = (rb_report_picture_size)pictures->size;
    rb_report_picture_kind_of(path, &d.canvas.kind, NULL); /* cli_check_files knows it */
    drawing script = d;
    script.canvas.script = 1;
    /* first the script, which does not need gnuplot */
    cli_exit code =
        pictures->script ? cli_write_file(pictures->script, draw_picture, &script) : CLI_OK;
    if (code == CLI_OK)
        code = cli_write_file(path, draw_picture, &d);
    free(own);
    return code;
}

typedef struct {
    cli_problems *problems;
    const cli_args *args;
    cli_exit *worst;
} problem_run;

static rb_status write_problems(FILE *out, const void *context, rb_message *why)
{
    const problem_run *run = context;
    cli_problems *p = run->problems;

    (void)why;
    p->rows = cli_rows_begin(out, p->style, p->columns);
    for (int i = 0; i < run->args->operands; i++) {
        const cli_exit code = p->solve(p->context, run->args->operand[i]);
        *run->worst = code > *run->worst ? code : *run->worst;
    }
    if (!p->rows.is_json)
        return RB_OK;
    json_t *root = rb_report_json_start(cli_command_line());
    rb_report_json_set(&root, "conventions", json_string(p->conventions));
    rb_report_json_set(&root, "problems", p->rows.list);
    return rb_report_json_write(out, root);
}

void cli_note(const char *file, const char *format, ...)
{
    va_list args;
    fprintf(stderr, "rollbem: %s: note: ", file);
    va_start(args, format);
    vfprintf(stderr, format, args);
    va_end(args);
    fputc('\n', stderr);
}

void cli_note_enumeration(const char *file, const char *what, int solutions, int nearby,
                          int singular_only, int undecided, int tried)
{
    if (nearby)
        cli_note(file,
                 "%d of %d solutions hold%s within rounding only: of these "
                 "numbers exactly there may be none",
                 nearby, solutions, nearby == 1 ? "s" : "");
    if (singular_only)
        cli_note(file,
                 "%d of %d solutions belong%s to singular %s only: others may "
                 "lie next to %s",
                 singular_only, solutions, singular_only == 1 ? "s" : "", what,
                 singular_only == 1 ? "it" : "them");
    if (solutions && undecided)
        cli_note(file, "at least %d solution%s: %d of %d %s %s undecided", solutions - nearby,
                 rb_plural(solutions - nearby), undecided, tried, what,
                 undecided == 1 ? "is" : "are");
}

cli_exit cli_solve_problems(cli_problems *p, const cli_args *args, const char *output)
{
    cli_exit worst = CLI_OK;
    const problem_run run = {p, args, &worst};
    const cli_exit code = cli_write_file(output, write_problems, &run);
    return code == CLI_OK ? worst : code;
}
