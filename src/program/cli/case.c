#include "program/cli/case.h"
#include "program/cli/wait.h"

#include "lcp/friction/friction.h"

#include <jansson.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* ---- A case from words ------------------------------------------------------------ */

rb_case *cli_case_create(rb_case_purpose purpose)
{
    rb_case *c = rb_case_create(purpose);
    if (c)
        rb_case_use_cone_solvers(c, rb_friction_cone_solver);
    else
        cli_fail(CLI_INTERNAL, "out of memory");
    return c;
}

/* A misspelt command looks like a case file that is not there. */
static cli_exit read_case_file(const cli_spec *spec, const char *path, rb_case *c)
{
    rb_message why = {.text = ""};
    rb_guess guess = {.word = path};
    double number;
    int plain;
    if (rb_unit_read(path, "-", &number, &plain, &why) == RB_OK)
        return cli_fail(CLI_USAGE,
                        "%s: expected a case file, got a number; separate several values "
                        "of an option by commas, as --mu 0.1,0.2",
                        path);
    if (strcmp(path, "solve") == 0 || strcmp(path, "run") == 0)
        return cli_fail(CLI_USAGE,
                        "there is no command '%s': rollbem [OPTION...] [CASE.ini] solves", path);
    const rb_status s = rb_case_read_with(c, path, spec->set_n - 2, spec->sets + 1, &why);
    if (s != RB_ENOENT)
        return cli_say(s, &why);
    if (rb_unit_is_known(path))
        return cli_fail(CLI_USAGE,
                        "'%s' is no case file: write a unit behind its number without a "
                        "blank, as 210GPa",
                        path);
    cli_guess_command(&guess);
    const char *hint = rb_guess_text(&guess, "");
    char command[24];
    if (!*hint && !*cli_command_of(spec, command) && !path[strcspn(path, "./")])
        hint = "; it is no command either (`rollbem help` lists them)";
    return cli_fail(cli_exit_of(s), "%s%s", why.text, hint);
}

cli_exit cli_case_read(const cli_spec *spec, int argc, char **argv, rb_case *c, cli_args *args)
{
    cli_exit code = cli_parse(spec, argc, argv, args);
    const char *file = code == CLI_CONTINUE ? cli_case_file_of(args) : NULL;
    const char *second = file ? args->operand[args->own + 1] : NULL;
    if (second && (strcmp(file, "solve") == 0 || strcmp(file, "run") == 0))
        code = read_case_file(spec, file, c);
    if (code == CLI_CONTINUE && second)
        code = cli_fail(CLI_USAGE, "one case file at a time, got '%s' and '%s'", file, second);
    if (code == CLI_CONTINUE && file)
        code = read_case_file(spec, file, c);
    return code == CLI_CONTINUE ? cli_example_read(c, file) : code;
}

cli_exit cli_case_resolve(const cli_spec *spec, rb_case *c, const cli_args *args)
{
    rb_message why = {.text = ""};
    const cli_exit code = cli_say(rb_case_resolve(c, &why), &why);
    return code == CLI_CONTINUE ? cli_check_files(spec, args) : code;
}

cli_exit cli_case_parse(const cli_spec *spec, int argc, char **argv, rb_case *c, cli_args *args)
{
    const cli_exit code = cli_case_read(spec, argc, argv, c, args);
    return code == CLI_CONTINUE ? cli_case_resolve(spec, c, args) : code;
}

cli_exit cli_check_units(const rb_case *c, const rb_option_set *set, const cli_args *args)
{
    char what[300];
    for (int k = 0; k < set->n; k++) {
        const rb_option *o = &set->options[k];
        /* the C of Paris' law has a unit that depends on its exponent */
        const int own_units =
            (o->kind == RB_OPTION_TEXT && strchr(o->unit, '=')) || strcmp(o->name, "paris") == 0;
        if (own_units && set->given[k] > 0 &&
            rb_case_units(c, set->given[k]) != rb_case_units(c, RB_GIVEN_ARGUMENT))
            return cli_fail(
                CLI_DATA,
                "%s: its numbers are in the units of the file, but --units gives "
                "others; give --%s too",
                rb_option_source(o, set->given[k], cli_case_file_of(args), what, sizeof what),
                o->name);
    }
    return CLI_CONTINUE;
}

cli_exit cli_case_refused(const rb_case *c, rb_status s, rb_message *why)
{
    return cli_say(rb_case_locate(c, s, why), why);
}

cli_exit cli_case_refuse(const rb_case *c, const char *about, const char *format, ...)
{
    rb_message why = {.text = ""};
    char text[sizeof why.text];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return cli_case_refused(c, rb_refuse(&why, about, "%s", text), &why);
}

/* ---- Commands that solve one ------------------------------------------------------ */

/* Those on the rows of a curve, or on the solution, and on the materials as they were given. */
static rb_rolling_note_list find_notes(const cli_case_run *run)
{
    if (!run->of_rows)
        return rb_case_find_notes(run->words, run->solution, run->of_steps);
    rb_rolling_note_list notes = *run->of_rows;
    rb_case_note_materials(run->words, &notes);
    return notes;
}

static rb_status write_results(FILE *out, const void *context, rb_message *why)
{
    const cli_case_run *run = context;
    (void)why;
    if (run->o.style.format != RB_REPORT_JSON)
        return run->command->table(out, run);
    rb_report_document document = {.command = cli_command_line(),
                                   .words = run->words,
                                   .notes = run->of_rows || run->solution ? run->notes : NULL};
    if (run->command->document)
        run->command->document(run, &document);
    json_t *root = rb_report_json_document(&document);
    if (run->command->inputs) {
        json_t *inputs = json_incref(json_object_get(root, "inputs"));
        run->command->inputs(run, &inputs);
        rb_report_json_set(&root, "inputs", inputs);
    }
    if (run->command->json)
        run->command->json(run, &root);
    return rb_report_json_write(out, root);
}

/* The files of one kind that are asked for: pictures, or all others. */
static cli_exit write_files(const cli_spec *spec, const cli_case_run *run, int pictures)
{
    cli_exit code = CLI_OK;
    const cli_case_file *f = run->command->files;
    for (; f && f->option && code == CLI_OK; f++) {
        const char *path = cli_option_path(spec, f->option);
        if (path && pictures && f->draw)
            code = cli_draw_file(&run->o.pictures, f->option, path, f->draw, run);
        else if (path && !pictures && f->write)
            code = cli_write_file(path, f->write, run);
    }
    return code;
}

enum { LARGE_WINDOW = 30 }; /* lines */

static void print_summary(FILE *out, const void *context)
{
    const cli_case_run *run = context;
    rb_report_notes(out, run->notes, cli_is_coloured(stderr));
    run->command->summarise(out, run);
    /* in a small window the table needs the line more than what was typed just now */
    if (!isatty(STDERR_FILENO) || cli_terminal_height() >= LARGE_WINDOW)
        rb_report_bodies(out, &run->c->rc, run->c->units);
}

static void summarise(const cli_case_run *run)
{
    if (!run->o.quiet)
        cli_print_lines(print_summary, run);
}

/* The sets of options of a command: the case's, the command's and those of its output. */
static cli_spec spec_of(cli_case_run *run)
{
    const cli_case_command *command = run->command;
    int draws = 0;
    for (const cli_case_file *f = command->files; f && f->option; f++)
        draws |= strcmp(f->option, "plot") == 0;
    const rb_option_set output = cli_output_set(&run->o, draws, command->has_scales);
    cli_spec spec = {.synopsis = command->synopsis,
                     .about = command->about,
                     .notes = command->notes,
                     .refused = command->refused,
                     .purpose = command->purpose,
                     .second = command->second ? command->second : command->purpose,
                     .sets = {rb_case_options(run->words)},
                     .set_n = 1};
    if (command->takes_crack)
        spec.sets[spec.set_n++] = rb_case_crack_set(run->words);
    spec.sets[spec.set_n++] = command->options_last ? output : run->set;
    spec.sets[spec.set_n++] = command->options_last ? run->set : output;
    spec.sets[spec.set_n++] = cli_example_set();
    rb_case_also_locate(run->words, &run->set);
    rb_case_also_locate(run->words, &output);
    return spec;
}

static cli_exit read_words(const cli_spec *spec, cli_case_run *run, int argc, char **argv)
{
    run->args.own = run->command->operands;
    const cli_exit code = cli_case_read(spec, argc, argv, run->words, &run->args);
    return code == CLI_CONTINUE && run->command->prepare ? run->command->prepare(run) : code;
}

/* given, plain: CLI_COMMAND_OPTIONS_MAX zeros each, which the run borrows. */
static cli_case_run run_of(const cli_case_command *command, void *own, int *given, int *plain,
                           rb_case *words)
{
    return (cli_case_run){.command = command,
                          .own = own,
                          .set = {command->options, command->option_n, own, given, plain},
                          .words = words};
}

cli_exit cli_case_asks(const cli_case_command *command, void *own, int argc, char **argv,
                       rb_case *words, int *files, json_t **asked)
{
    int given[CLI_COMMAND_OPTIONS_MAX] = {0}, plain[CLI_COMMAND_OPTIONS_MAX] = {0};
    cli_case_run run = run_of(command, own, given, plain, words);
    const cli_spec spec = spec_of(&run);
    rb_message why = {.text = ""};
    cli_exit code = read_words(&spec, &run, argc, argv);
    if (code == CLI_CONTINUE)
        code = cli_say(rb_case_resolve(words, &why), &why);
    *asked = NULL;
    if (code == CLI_CONTINUE) {
        rb_case_store(words, &run.set, own);
        *asked = json_object();
        command->asked(&run, asked);
    }
    rb_case_also_locate(words, NULL);
    *files = run.args.operands;
    cli_args_free(&run.args);
    return code;
}

cli_exit cli_case_run_command(const cli_case_command *command, void *own, int argc, char **argv)
{
    int given[CLI_COMMAND_OPTIONS_MAX] = {0}, plain[CLI_COMMAND_OPTIONS_MAX] = {0};
    cli_case_run run = run_of(command, own, given, plain, cli_case_create(command->purpose));
    if (!run.words)
        return CLI_INTERNAL;
    const cli_spec spec = spec_of(&run);
    cli_exit code = read_words(&spec, &run, argc, argv);
    if (code == CLI_CONTINUE)
        code = cli_case_resolve(&spec, run.words, &run.args);
    if (code == CLI_CONTINUE)
        code = cli_check_units(run.words, &run.set, &run.args);
    if (code == CLI_CONTINUE) {
        run.c = rb_case_resolved(run.words);
        rb_case_store(run.words, &run.set, own);
        if (run.o.style.dimensionless && run.o.style.format == RB_REPORT_JSON)
            code = cli_case_refuse(run.words, "dimensionless",
                                   "of the table and the picture; JSON has units: leave one of "
                                   "them out");
    }
    if (code == CLI_CONTINUE && command->check)
        code = command->check(&run);
    for (const cli_case_need *need = command->needs; code == CLI_CONTINUE && need && need->option;
         need++)
        if (rb_option_given(&run.set, need->option) && !rb_option_given(&run.set, need->with))
            code = cli_case_refuse(run.words, need->option, "only with --%s", need->with);
    if (code == CLI_CONTINUE) {
        rb_message why = {.text = ""};
        if (!run.o.quiet)
            cli_wait_begin();
        const rb_status s = command->solve(&run, &why);
        if (!run.o.quiet)
            cli_wait_end();
        if (run.printable) {
            const rb_rolling_note_list notes = find_notes(&run);
            run.notes = &notes;
            /* a person reads the notes first */
            const int first = !run.o.output && cli_reader_is_person();
            cli_page_begin();
            code = run.command->before_table ? run.command->before_table(&run) : CLI_OK;
            if (code == CLI_OK && run.o.style.dimensionless && run.solution &&
                !rb_report_has_scales(run.solution))
                code = cli_fail(CLI_DATA, "--dimensionless: nothing touches, so there is neither a "
                                          "nor p0: leave it out");
            if (code == CLI_OK && first)
                summarise(&run);
            if (code == CLI_OK)
                code = cli_write_file(run.o.output, write_results, &run);
            if (code == CLI_OK)
                code = write_files(&spec, &run, 0);
            if (code == CLI_OK && !first)
                summarise(&run);
            if (code == CLI_OK && run.o.cite)
                cli_print_citations(&run.c->rc, run.solution);
            cli_page_end();
            const cli_exit drawn = code == CLI_OK ? write_files(&spec, &run, 1) : code;
            /* what is not solved may be too little for a picture: the reason is said below */
            const int too_little = code == CLI_OK && s != RB_OK && drawn == CLI_USAGE;
            code = too_little ? CLI_OK : drawn;
        } else
            code = CLI_OK;
        if (code == CLI_OK && s != RB_OK)
            code = cli_case_refused(run.words, s, &why);
        else if (code == CLI_OK && run.incomplete)
            code = CLI_UNSOLVED;
    }
    cli_args_free(&run.args);
    rb_case_free(run.words);
    return code;
}
