/* Options from the command line and from case files, by the tables of a cli_spec. */
#include "cli/cli.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include <ini.h>

typedef struct {
    const cli_set *set; /* NULL: no such option */
    int index;
} found_option;

static const cli_option *option_of(found_option f)
{
    return &f.set->options[f.index];
}

/* The option of that name (length characters of it); guess learns the others' names. */
static found_option find_option(const cli_spec *spec, const char *name, size_t length,
                                cli_guess *guess)
{
    for (int s = 0; s < spec->set_n; s++)
        for (int i = 0; i < spec->sets[s].n; i++) {
            const cli_option *o = &spec->sets[s].options[i];
            if (o->kind == CLI_GROUP)
                continue;
            if (strlen(o->name) == length && strncmp(o->name, name, length) == 0)
                return (found_option){&spec->sets[s], i};
            cli_guess_try(guess, o->name);
        }
    return (found_option){NULL, 0};
}

static void note_given(found_option f, int by)
{
    if (f.set->given)
        f.set->given[f.index] = by;
}

/* ---- Command line ---------------------------------------------------------------- */

static cli_exit unknown_option(const char *name, size_t length, cli_guess *guess)
{
    static const char *const common[] = {"help", "usage", "version"};
    for (int i = 0; i < 3; i++)
        cli_guess_try(guess, common[i]);
    return cli_fail(CLI_USAGE, "unknown option '--%.*s'%s", (int)length, name,
                    cli_guess_text(guess, "--"));
}

/* The value after '=', the next argument, or "yes" for a flag.  NULL: there is none. */
static const char *value_of(const cli_option *o, const char *equals, int *i, int argc,
                            char **argv)
{
    if (equals)
        return equals + 1;
    if (o->kind == CLI_FLAG)
        return "yes";
    if (*i + 1 >= argc)
        return NULL;
    /* a text value that looks like an option is a forgotten value */
    if (o->kind == CLI_TEXT && strncmp(argv[*i + 1], "--", 2) == 0)
        return NULL;
    return argv[++*i];
}

static cli_exit parse_option(const cli_spec *spec, int *i, int argc, char **argv)
{
    const char *name = argv[*i] + 2, *equals = strchr(name, '=');
    const size_t length = equals ? (size_t)(equals - name) : strlen(name);
    char word[42];
    snprintf(word, sizeof word, "%.*s", (int)(length < 41 ? length : 41), name);
    cli_guess guess = {.word = word};
    const found_option f = find_option(spec, name, length, &guess);
    if (!f.set)
        return unknown_option(name, length, &guess);
    const cli_option *o = option_of(f);
    char what[64];
    snprintf(what, sizeof what, "--%s", o->name);
    const char *value = value_of(o, equals, i, argc, argv);
    if (!value) {
        char expected[200];
        return cli_fail(CLI_USAGE, "%s: expected %s, got nothing", what,
                        cli_expected(o, expected, sizeof expected));
    }
    note_given(f, CLI_GIVEN_ARGUMENT);
    return cli_set_value(o, f.set->target, what, value, CLI_USAGE);
}

static cli_exit answer_common(const cli_spec *spec, const char *argument)
{
    if (strcmp(argument, "--help") == 0)
        cli_print_help(spec);
    else if (strcmp(argument, "--usage") == 0)
        cli_print_usage(spec);
    else if (strcmp(argument, "--version") == 0)
        puts("rollbem " RB_VERSION);
    else
        return CLI_CONTINUE;
    return CLI_OK;
}

static cli_exit parse_argument(const cli_spec *spec, int *i, int argc, char **argv,
                               cli_args *args, int *operands_only)
{
    char *argument = argv[*i];
    if (*operands_only || argument[0] != '-' || argument[1] == '\0') {
        args->operand[args->operands++] = argument;
        return CLI_CONTINUE;
    }
    if (strcmp(argument, "--") == 0) {
        *operands_only = 1;
        return CLI_CONTINUE;
    }
    if (argument[1] != '-')
        return cli_fail(CLI_USAGE, "unknown option '%s' (options start with --)",
                        argument);
    const cli_exit code = answer_common(spec, argument);
    return code == CLI_CONTINUE ? parse_option(spec, i, argc, argv) : code;
}

cli_exit cli_parse(const cli_spec *spec, int argc, char **argv, cli_args *args)
{
    int operands_only = 0;
    args->operand = malloc(sizeof(char *) * (size_t)(argc + 1));
    if (!args->operand)
        return cli_fail(CLI_INTERNAL, "out of memory");
    for (int i = 1; i < argc; i++) {
        const cli_exit code = parse_argument(spec, &i, argc, argv, args, &operands_only);
        if (code != CLI_CONTINUE)
            return code;
    }
    return CLI_CONTINUE;
}

void cli_args_free(cli_args *args)
{
    for (int i = 0; i < args->kept_n; i++)
        free(args->kept[i]);
    free(args->kept);
    free(args->operand);
    *args = (cli_args){0};
}

/* ---- Case files ------------------------------------------------------------------ */

typedef struct {
    const cli_spec *spec;
    const char *path;
    FILE *file;
    int line;
    cli_args *args;
    cli_exit code; /* of the first error */
} ini_state;

/* fgets for inih: counts lines, takes away the indentation (inih would read an indented
 * line as more of the last value) and refuses what does not fit. */
static char *read_line(char *line, int size, void *context)
{
    ini_state *st = context;
    if (st->code != CLI_CONTINUE || !fgets(line, size, st->file))
        return NULL;
    st->line++;
    const size_t n = strlen(line);
    if (n + 1 == (size_t)size && line[n - 1] != '\n') {
        st->code = cli_fail(CLI_DATA, "%s:%d: line too long", st->path, st->line);
        return NULL;
    }
    const size_t indent = strspn(line, " \t");
    memmove(line, line + indent, n + 1 - indent);
    return line;
}

/* inih's value lives until the next line. */
static const char *keep_text(ini_state *st, const char *value)
{
    cli_args *args = st->args;
    char **kept = realloc(args->kept, sizeof(char *) * (size_t)(args->kept_n + 1));
    char *copy = strdup(value);
    if (kept)
        args->kept = kept;
    if (!kept || !copy) {
        free(copy);
        st->code = cli_fail(CLI_INTERNAL, "out of memory");
        return NULL;
    }
    args->kept[args->kept_n++] = copy;
    return copy;
}

/* The section an option stands in: the heading above it. */
static const char *section_of(found_option f)
{
    for (int i = f.index; i >= 0; i--)
        if (f.set->options[i].kind == CLI_GROUP)
            return f.set->options[i].name;
    return "";
}

static int known_section(const cli_spec *spec, const char *name, cli_guess *guess)
{
    for (int s = 0; s < spec->set_n; s++)
        for (int i = 0; i < spec->sets[s].n; i++) {
            const cli_option *o = &spec->sets[s].options[i];
            if (o->kind != CLI_GROUP)
                continue;
            if (strcmp(o->name, name) == 0)
                return 1;
            cli_guess_try(guess, o->name);
        }
    return 0;
}

static cli_exit unknown_section(const ini_state *st, const char *section)
{
    cli_guess guess = {.word = section};
    if (*section == '\0' || known_section(st->spec, section, &guess))
        return CLI_CONTINUE;
    return cli_fail(CLI_DATA, "%s:%d: unknown section '%s'%s", st->path, st->line,
                    section, cli_guess_text(&guess, ""));
}

static cli_exit check_section(const ini_state *st, found_option f, const char *section)
{
    const char *wanted = section_of(f);
    if (*section == '\0' || strcmp(section, wanted) == 0)
        return CLI_CONTINUE;
    return cli_fail(CLI_DATA, "%s:%d: key '%s' belongs to section [%s], not [%s]",
                    st->path, st->line, option_of(f)->name, wanted, section);
}

static cli_exit set_key(ini_state *st, const char *section, const char *name,
                        const char *value)
{
    cli_guess guess = {.word = name};
    const found_option f = find_option(st->spec, name, strlen(name), &guess);
    if (unknown_section(st, section) != CLI_CONTINUE)
        return CLI_DATA;
    if (!f.set)
        return cli_fail(CLI_DATA, "%s:%d: unknown key '%s'%s", st->path, st->line, name,
                        cli_guess_text(&guess, ""));
    if (check_section(st, f, section) != CLI_CONTINUE)
        return CLI_DATA;
    const int before = f.set->given ? f.set->given[f.index] : 0;
    if (before > 0)
        return cli_fail(CLI_DATA, "%s:%d: key '%s' was given before, in line %d",
                        st->path, st->line, name, before);
    if (before == CLI_GIVEN_ARGUMENT)
        return CLI_CONTINUE;
    const char *kept = keep_text(st, value);
    if (!kept)
        return CLI_INTERNAL;
    char what[400];
    snprintf(what, sizeof what, "%s:%d: %s", st->path, st->line, name);
    note_given(f, st->line);
    return cli_set_value(option_of(f), f.set->target, what, kept, CLI_DATA);
}

static int handle_key(void *context, const char *section, const char *name,
                      const char *value)
{
    ini_state *st = context;
    if (st->code == CLI_CONTINUE)
        st->code = set_key(st, section, name, value);
    return st->code == CLI_CONTINUE;
}

cli_exit cli_read_ini(const cli_spec *spec, const char *path, cli_args *args)
{
    ini_state st = {.spec = spec, .path = path, .args = args, .code = CLI_CONTINUE};
    st.file = fopen(path, "r");
    if (!st.file) {
        cli_guess guess = {.word = path};
        cli_guess_command(&guess);
        return cli_fail(CLI_NOINPUT, "%s: %s%s", path, strerror(errno),
                        cli_guess_text(&guess, ""));
    }
    const int bad_line = ini_parse_stream(read_line, &st, handle_key, &st);
    if (ferror(st.file))
        st.code = cli_fail(CLI_NOINPUT, "%s: %s", path, strerror(errno));
    else if (st.code == CLI_CONTINUE && bad_line)
        st.code = cli_fail(CLI_DATA, "%s:%d: expected [section] or key = value", path,
                           bad_line);
    fclose(st.file);
    return st.code;
}
