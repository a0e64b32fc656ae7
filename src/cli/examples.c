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
    RB_GROUP_LINE("example", "A case that is at hand"),
    RB_TEXT_LINE("example", 0, "NAME",
                 "start from that case instead of the defaults; `rollbem examples` lists "
                 "the names",
                 .unset = "none"),
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

/* Its first line is a comment that says what it is. */
static void print_title(int k)
{
    const char *text = examples[k].text + strspn(examples[k].text, "; ");
    printf("rollbem --example %-20s %.*s\n", examples[k].name, (int)strcspn(text, "\n"),
           text);
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
        for (int k = 0; k < EXAMPLES; k++)
            print_title(k);
        puts("rollbem example bar|truss|wall         finite elements");
        code = CLI_OK;
    }
    cli_args_free(&args);
    return code;
}
