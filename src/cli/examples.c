/* The case files of examples/, which the program carries along: --example NAME, and
 * rollbem examples. */
#include "cli/case.h"

#include <string.h>

static const struct {
    const char *name, *text;
} examples[] = {
#include "examples.inc" /* by the Makefile */
};

enum { EXAMPLES = sizeof examples / sizeof examples[0] };

static const char *chosen; /* by --example */

static const rb_option options[] = {
    RB_GROUP_LINE("example", "A built-in case"),
    RB_TEXT_LINE("example", 0, "NAME",
                 "start from that case instead of the defaults; `rollbem examples` lists "
                 "the names",
                 .unset = "none", .common = 1),
};

rb_option_set cli_example_set(void)
{
    return (rb_option_set){options, sizeof options / sizeof options[0], &chosen, NULL,
                           NULL};
}

cli_exit cli_example_read(rb_case *c, const cli_args *args)
{
    rb_message why = {""};
    rb_guess guess = {.word = chosen};
    char title[80];
    if (!chosen)
        return CLI_CONTINUE;
    if (args->operands > 0)
        return cli_fail(CLI_USAGE, "--example %s and the case file '%s': one of them",
                        chosen, args->operand[0]);
    for (int k = 0; k < EXAMPLES; k++) {
        snprintf(title, sizeof title, "examples/%s", examples[k].name);
        if (strcmp(examples[k].name, chosen) == 0)
            return cli_say(rb_case_read_text(c, title, examples[k].text, &why), &why);
        rb_guess_try(&guess, examples[k].name);
    }
    return cli_fail(CLI_USAGE,
                    "--example: no example '%s'%s; `rollbem examples` lists them", chosen,
                    rb_guess_text(&guess, ""));
}

/* The comment that it begins with says what it is. */
static void print_title(int k)
{
    char name[60], about[1000] = "";
    snprintf(name, sizeof name, "--example %s", examples[k].name);
    for (const char *line = examples[k].text; *line == ';'; line++) {
        line += 1 + (line[1] == ' ');
        rb_append(about, sizeof about, "%.*s ", (int)strcspn(line, "\n"), line);
        line = strchr(line, '\n');
    }
    cli_print_entry(name, about);
}

int cli_example_is_case(const char *name)
{
    for (int k = 0; k < EXAMPLES; k++)
        if (strcmp(examples[k].name, name) == 0)
            return 1;
    return 0;
}

int cli_examples(int argc, char **argv)
{
    static const cli_spec spec = {
        .synopsis = "rollbem examples",
        .about = "Lists the cases that --example NAME starts from, and what they are."};
    cli_args args = {0};
    cli_exit code = cli_parse(&spec, argc, argv, &args);
    if (code == CLI_CONTINUE && args.operands > 0)
        code = cli_fail(CLI_USAGE, "examples: unexpected '%s'", args.operand[0]);
    if (code == CLI_CONTINUE) {
        FILE *pager = cli_open_pager();
        puts("rollbem --example NAME solves one; every command that takes a case takes "
             "it.");
        for (int k = 0; k < EXAMPLES; k++)
            print_title(k);
        puts("rollbem example NAME solves finite elements with friction.");
        cli_print_entry(
            "example bar",
            "an elastic bar on an obstacle, pushed from its end (Kanno, example 3.2)");
        cli_print_entry(
            "example truss",
            "a double-layer grid of bars, loaded, then unloaded (Kanno, 3.1)");
        cli_print_entry(
            "example wall",
            "12 elastic blocks in running bond, pressed and sheared (after Acary 2017)");
        cli_close_pager(pager);
        code = CLI_OK;
    }
    cli_args_free(&args);
    return code;
}
