/* The case files of examples/, which are built into the program: --example NAME, also
 * `rollbem example NAME`. */
#include "program/cli/case.h"

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
                 "start from that case instead of the defaults; `rollbem examples` lists the names",
                 .unset = "none", .common = 1),
};

rb_option_set cli_example_set(void)
{
    return (rb_option_set){options, sizeof options / sizeof options[0], &chosen, NULL, NULL};
}

cli_exit cli_example_read(rb_case *c, const char *file)
{
    rb_message why = {.text = ""};
    rb_guess guess = {.word = chosen};
    char title[80];
    if (!chosen)
        return CLI_CONTINUE;
    if (file)
        return cli_fail(CLI_USAGE, "--example %s and the case file '%s': one of them", chosen,
                        file);
    for (int k = 0; k < EXAMPLES; k++) {
        snprintf(title, sizeof title, "examples/%s", examples[k].name);
        if (strcmp(examples[k].name, chosen) == 0)
            return cli_say(rb_case_read_text(c, title, examples[k].text, &why), &why);
        rb_guess_try(&guess, examples[k].name);
    }
    return cli_fail(CLI_USAGE, "--example: no example '%s'%s; `rollbem examples` lists them",
                    chosen, rb_guess_text(&guess, ""));
}

/* The comment that it begins with says what it is. */
int cli_example_about(int k, char *name, size_t name_size, char *about, size_t size)
{
    if (k >= EXAMPLES)
        return 0;
    snprintf(name, name_size, "--example %s", examples[k].name);
    about[0] = '\0';
    for (const char *line = examples[k].text; *line == ';'; line++) {
        line += 1 + (line[1] == ' ');
        rb_append(about, size, "%.*s ", (int)strcspn(line, "\n"), line);
        line = strchr(line, '\n');
    }
    return 1;
}

int cli_example_is_case(const char *name)
{
    for (int k = 0; k < EXAMPLES; k++)
        if (strcmp(examples[k].name, name) == 0)
            return 1;
    return 0;
}
