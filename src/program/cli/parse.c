/* Options from the command line, by the tables of a cli_spec. */
#include "base/units.h"
#include "rolling/case/case.h"
#include "rolling/case/rubber.h"
#include "rolling/case/options.h"
#include "program/cli/describe.h"
#include "program/cli/find.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- Command line ---------------------------------------------------------------- */

/* The value after '=', the next argument, or "yes" for a flag.  NULL: there is none. */
static const char *value_of(const rb_option *o, const char *equals, int *i, int argc, char **argv)
{
    if (equals)
        return equals + 1;
    if (o->kind == RB_OPTION_FLAG)
        return "yes";
    if (o->alone && (*i + 1 >= argc || argv[*i + 1][0] == '-' || strpbrk(argv[*i + 1], "./") ||
                     access(argv[*i + 1], R_OK) == 0))
        return o->alone;
    if (*i + 1 >= argc)
        return NULL;
    /* a text value that looks like an option is a forgotten value */
    if (o->kind == RB_OPTION_TEXT && strncmp(argv[*i + 1], "--", 2) == 0)
        return NULL;
    return argv[++*i];
}

/* What stands behind `option` in the argument; NULL: it is another one. */
static const char *value_behind(const char *option, const char *argument)
{
    const size_t n = strlen(option);
    return strncmp(argument, option, n) == 0 ? argument + n : NULL;
}

static int answer_common(const cli_spec *spec, const char *argument)
{
    const char *part = value_behind("--help=", argument);
    if (part || strcmp(argument, "--help") == 0)
        return cli_print_help(spec, part);
    if (strcmp(argument, "--usage") == 0)
        cli_print_usage(spec);
    else if (strcmp(argument, "--version") == 0)
        puts("rollbem " RB_VERSION);
    else {
        /* --describe=FORM and --completion=SHELL, for the building of packages. */
        const char *form = value_behind("--describe=", argument);
        const char *shell = value_behind("--completion=", argument);
        cli_exit code = CLI_CONTINUE;
        if (form && (code = cli_describe(spec, form)) == CLI_CONTINUE)
            return cli_fail(
                CLI_USAGE, "--describe: expected man, markdown, results or schema, got '%s'", form);
        if (shell && (code = cli_complete(shell)) == CLI_CONTINUE)
            return cli_fail(CLI_USAGE, "--completion: expected bash, zsh or fish, got '%s'", shell);
        return code;
    }
    return CLI_OK;
}

static cli_exit unknown_option(const char *name, int length, rb_guess *guess)
{
    static const char *const common[] = {"help", "usage", "version"};
    const char *commands = cli_commands_with(name, (size_t)length);
    const char *other = cli_other_name(name, (size_t)length);
    if (*commands)
        return cli_fail(CLI_USAGE, "unknown option '--%.*s' (it is an option of %s)", length, name,
                        commands);
    if (other)
        return cli_fail(CLI_USAGE, "unknown option '--%.*s' (did you mean '--%s'?)", length, name,
                        other);
    for (int j = 0; j < 3; j++)
        rb_guess_try(guess, common[j]);
    return cli_fail(CLI_USAGE, "unknown option '--%.*s'%s", length, name,
                    rb_guess_text(guess, "--"));
}

/* The last one of the command's, because its own and those of the output stand at the end;
 * or NULL. */
static const char *option_that_begins(const cli_spec *spec, const char *letters, size_t n)
{
    const char *found = NULL;
    for (cli_option at = {0}; cli_next_option(spec, &at);) {
        if (strncmp(at.option->name, letters, n) != 0)
            continue;
        found = at.option->name;
        if (!found[n])
            return found;
    }
    return found;
}

/* 1: the next argument is the unit of a number, behind a blank: --young 210 GPa. */
static int has_unit_apart(const rb_option *o, const char *value, const char *next)
{
    char both[120];
    double x;
    int plain = 1;
    if (o->kind != RB_OPTION_NUMBER || !next || *next == '-' || !rb_option_number(value, &x) ||
        access(next, F_OK) == 0 ||
        snprintf(both, sizeof both, "%s %s", value, next) >= (int)sizeof both)
        return 0;
    return (o->modulus && rb_rubber_read(both, 0, &x, NULL)) ||
           (rb_unit_read(both, o->unit, &x, &plain, NULL) == RB_OK && !plain);
}

cli_exit cli_parse(const cli_spec *spec, int argc, char **argv, cli_args *args)
{
    int operands_only = 0;
    args->operand = calloc((size_t)argc + 1, sizeof(char *));
    if (!args->operand)
        return cli_fail(CLI_INTERNAL, "out of memory");
    for (int i = 1; i < argc; i++) {
        char *argument = argv[i];
        if (operands_only || argument[0] != '-' || argument[1] == '\0') {
            args->operand[args->operands++] = argument;
            continue;
        }
        if (strcmp(argument, "--") == 0) {
            operands_only = 1;
            continue;
        }
        if (strcmp(argument, "-h") == 0)
            return cli_print_help(spec, NULL);
        if (argument[1] != '-') {
            const size_t n = strcspn(argument + 1, "=");
            const char *other = cli_other_name(argument + 1, n);
            if (!other && n > 0)
                other = option_that_begins(spec, argument + 1, n);
            return cli_fail(CLI_USAGE, "unknown option '%s' (options start with --%s%s)", argument,
                            other ? ", as --" : "; --help lists them", other ? other : "");
        }
        const char *when = value_behind("--color=", argument);
        if (when && cli_set_colour(when))
            continue;
        if (when)
            return cli_fail(CLI_USAGE, "--color: expected auto, always or never, got '%s'", when);
        const cli_exit code = answer_common(spec, argument);
        if (code != CLI_CONTINUE)
            return code;
        const char *name = argument + 2, *equals = strchr(name, '=');
        const size_t length = equals ? (size_t)(equals - name) : strlen(name);
        char word[42], what[64], expected[200];
        snprintf(word, sizeof word, "%.*s", (int)length, name);
        rb_guess guess = {.word = word};
        rb_message why = {.text = ""};
        int k;
        const rb_option_set *set =
            rb_option_find(spec->set_n, spec->sets, name, length, &k, &guess);
        if (!set)
            return unknown_option(name, (int)length, &guess);
        snprintf(what, sizeof what, "--%s", set->options[k].name);
        const char *value = value_of(&set->options[k], equals, &i, argc, argv);
        if (!value)
            return cli_fail(CLI_USAGE, "%s: expected %s, got nothing", what,
                            rb_option_expected(&set->options[k], expected, sizeof expected));
        if (has_unit_apart(&set->options[k], value, argv[i + 1]))
            return cli_fail(CLI_USAGE, "%s: write %s%s without a blank, or '%s %s' in quotes", what,
                            value, argv[i + 1], value, argv[i + 1]);
        if (rb_option_assign(set, k, RB_GIVEN_ARGUMENT, what, value, &why) != RB_OK)
            return cli_fail(CLI_USAGE, "%s", why.text);
    }
    return CLI_CONTINUE;
}

const char *cli_case_file_of(const cli_args *args)
{
    return args->operands > args->own ? args->operand[args->own] : NULL;
}

void cli_args_free(cli_args *args)
{
    free(args->operand);
    *args = (cli_args){0};
}
