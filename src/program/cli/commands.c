/* The commands by name, and the command line.  The table is in main.c; this file does not
 * depend on the single commands. */
#include "rolling/case/case.h"
#include "program/cli/cli.h"

#include <stdlib.h>
#include <string.h>

static const cli_command *commands;
static char *command_line;

char **cli_split_line(char *line, int *argc)
{
    static char program[] = "rollbem";
    char **words = calloc(strlen(line) / 2 + 3, sizeof *words), *to = line;
    int n = 1, quoted = 0, inside = 0;

    for (const char *c = line; words && *c; c++) {
        if (*c == ' ' && !quoted) {
            *to++ = '\0';
            inside = 0;
            continue;
        }
        if (!inside)
            words[n++] = to;
        inside = 1;
        if (*c == '\'')
            quoted = !quoted;
        else if (*c != '\\' || quoted)
            *to++ = *c;
        else if (c[1])
            *to++ = *++c;
    }
    *to = '\0';
    if (words)
        words[0] = program;
    *argc = n;
    return words;
}

int cli_begin(const cli_command *table, int argc, char **argv)
{
    commands = table;
    /* Room for every character quoted ('\''), a pair of quotes and a space each; then 4
     * bytes for each of them in print. */
    size_t size = sizeof "rollbem";
    for (int i = 1; i < argc; i++)
        size += 4 * strlen(argv[i]) + 3;
    char *line = malloc(size);
    if (!line)
        return 0;
    char *to = stpcpy(line, "rollbem");
    for (int i = 1; i < argc; i++) {
        static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                    "-_=+.,:/@%^";
        const int quoted = !argv[i][0] || argv[i][strspn(argv[i], plain)];
        to = stpcpy(to, quoted ? " '" : " ");
        for (const char *c = argv[i]; *c; c++) {
            if (*c == '\'')
                to = stpcpy(to, "'\\'");
            *to++ = *c;
        }
        to = stpcpy(to, quoted ? "'" : "");
    }
    *to = '\0';
    command_line = malloc(4 * strlen(line) + 1);
    if (command_line)
        rb_printable(line, command_line, 4 * strlen(line) + 1);
    free(line);
    return command_line != NULL;
}

void cli_end(void)
{
    free(command_line);
    command_line = NULL;
}

const char *cli_command_of(const cli_spec *spec, char name[24])
{
    if (sscanf(spec->synopsis, "rollbem %23[a-z]", name) != 1)
        name[0] = '\0';
    return name;
}

int cli_takes(const cli_spec *spec, const rb_option *o)
{
    char word[80];
    snprintf(word, sizeof word, ",%s,", o->name);
    return o->kind != RB_OPTION_GROUP && !(spec->refused && strstr(spec->refused, word)) &&
           (rb_case_takes(spec->purpose, o->name) || rb_case_takes(spec->second, o->name));
}

int cli_next_option(const cli_spec *spec, cli_option *at)
{
    at->is_first = 0;
    for (; at->set < spec->set_n; at->set++, at->next = 0)
        while (at->next < spec->sets[at->set].n) {
            const rb_option *o = &spec->sets[at->set].options[at->next++];
            if (o->kind == RB_OPTION_GROUP) {
                at->group = o;
                at->is_first = 1;
            } else if (cli_takes(spec, o)) {
                at->option = o;
                at->target = spec->sets[at->set].target;
                return 1;
            }
        }
    return 0;
}

cli_exit cli_describe_all(const char *form, int nameless_first)
{
    char describe[40];
    char *words[] = {"", describe, NULL};
    int code = CLI_OK;
    snprintf(describe, sizeof describe, "--describe=%s", form);
    if (nameless_first)
        code = cli_run("", 2, words);
    for (int k = 0; code == CLI_OK && cli_command_name(k); k++)
        if (strcmp(cli_command_name(k), "help") != 0)
            code = cli_run(cli_command_name(k), 2, words);
    if (code == CLI_OK && !nameless_first)
        code = cli_run("", 2, words);
    return code;
}

const char *cli_command_line(void)
{
    return command_line ? command_line : "rollbem";
}

static const cli_command *find_command(const char *name)
{
    const cli_command *c = commands;
    while (c->name[0] && strcmp(c->name, name) != 0)
        c++;
    return strcmp(c->name, name) == 0 ? c : NULL;
}

const char *cli_command_name(int k)
{
    return commands[k].name[0] ? commands[k].name : NULL;
}

const char *cli_command_help(const char *name)
{
    const cli_command *c = find_command(name);
    return c ? c->help : NULL;
}

void cli_guess_command(rb_guess *guess)
{
    for (const cli_command *c = commands; c->name[0]; c++)
        rb_guess_try(guess, c->name);
}

int cli_run(const char *name, int argc, char **argv)
{
    rb_guess guess = {.word = name};
    const cli_command *c = find_command(name);
    if (c)
        return c->run(argc, argv);
    cli_guess_command(&guess);
    return cli_fail(CLI_USAGE, "unknown command '%s'%s", name, rb_guess_text(&guess, ""));
}
