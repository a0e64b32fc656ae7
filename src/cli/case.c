#include "cli/case.h"
#include "cli/output.h"
#include "rollbem/friction.h"

#include <jansson.h>
#include <string.h>

rb_case *cli_case_create(rb_case_purpose purpose)
{
    rb_case *c = rb_case_create(purpose);
    if (c)
        rb_case_use_cone_solvers(c, rb_friction_cone_solvers());
    else
        cli_fail(CLI_INTERNAL, "out of memory");
    return c;
}

/* A misspelt command looks like a case file that is not there. */
static cli_exit read_case_file(const cli_spec *spec, const char *path, rb_case *c)
{
    rb_message why;
    rb_guess guess = {.word = path};
    double number;
    int plain;
    if (rb_unit_read(path, "-", &number, &plain, &why) == RB_OK)
        return cli_fail(
            CLI_USAGE,
            "%s: a number stands where a case file is expected; several values "
            "of an option have commas between, as --mu 0.1,0.2",
            path);
    if (strcmp(path, "solve") == 0 || strcmp(path, "run") == 0)
        return cli_fail(CLI_USAGE,
                        "there is no command '%s': rollbem [OPTION...] [CASE.ini] solves",
                        path);
    const rb_status s = rb_case_read(c, path, spec->set_n - 2, spec->sets + 1, &why);
    if (s != RB_ENOENT)
        return cli_say(s, &why);
    cli_guess_command(&guess);
    return cli_fail(cli_exit_of(s), "%s%s", why.text, rb_guess_text(&guess, ""));
}

cli_exit cli_case_read(const cli_spec *spec, int argc, char **argv, rb_case *c,
                       cli_args *args)
{
    cli_exit code = cli_parse(spec, argc, argv, args);
    if (code == CLI_CONTINUE && args->operands > 1 &&
        (strcmp(args->operand[0], "solve") == 0 || strcmp(args->operand[0], "run") == 0))
        code = read_case_file(spec, args->operand[0], c);
    if (code == CLI_CONTINUE && args->operands > 1)
        code = cli_fail(CLI_USAGE, "one case file at a time, got '%s' and '%s'",
                        args->operand[0], args->operand[1]);
    if (code == CLI_CONTINUE && args->operands == 1)
        code = read_case_file(spec, args->operand[0], c);
    return code == CLI_CONTINUE ? cli_example_read(c, args) : code;
}

cli_exit cli_case_settle(const cli_spec *spec, rb_case *c, const cli_args *args)
{
    rb_message why = {""};
    const cli_exit code = cli_say(rb_case_settle(c, &why), &why);
    return code == CLI_CONTINUE ? cli_check_files(spec, args) : code;
}

cli_exit cli_case_parse(const cli_spec *spec, int argc, char **argv, rb_case *c,
                        cli_args *args)
{
    const cli_exit code = cli_case_read(spec, argc, argv, c, args);
    return code == CLI_CONTINUE ? cli_case_settle(spec, c, args) : code;
}

cli_exit cli_case_refused(const rb_case *c, rb_status s, rb_message *why)
{
    return cli_say(rb_case_blame(c, s, why), why);
}

rb_units cli_units_of(const rb_case *c, const rb_option *options, int n, const int *given,
                      const char *name)
{
    for (int k = 0; k < n; k++)
        if (strcmp(options[k].name, name) == 0 && given[k] > 0)
            return rb_case_file_units(c);
    return rb_case_units(c);
}

json_t *cli_case_json(const rb_case *c, const rb_rolling_solution *s, json_t *inputs)
{
    const rb_settled_case *settled = rb_case_settled(c);
    json_t *root = rb_report_json_start(cli_command_line());
    if (s)
        rb_report_json_set(&root, "notes", rb_report_json_notes(&settled->rc, s));
    rb_report_json_set(&root, "units", rb_report_json_units(settled->units));
    rb_report_json_set(&root, "inputs", inputs);
    return root;
}
