/* --help and --usage, made from the option tables. */
#include "program/cli/find.h"

#include <string.h>

enum { WIDTH = 80 };

static void print_option(const rb_option *o, const void *target)
{
    char values[120], name[200], text[600];
    cli_option_metavar(o, values, sizeof values);
    cli_option_text(o, target, text, sizeof text);
    snprintf(name, sizeof name, "--%s%s", o->name, values);
    cli_print_entry(name, text);
}

/* Paragraphs in 80 columns: lines that begin with a blank stay as they are, others are
 * joined unless the one before ends early or with a sentence. */
static void print_text(const char *text)
{
    enum { EARLY = 60 };
    int at = 0, indent = 0;
    for (const char *line = text, *next; *line; line = next) {
        const size_t n = strcspn(line, "\n"), blanks = strspn(line, " ");
        const char *before = line - 1;
        while (before > text && before[-1] != '\n')
            before--;
        const int joins = line > text && *line != ' ' && *before != ' ' && n > 0 &&
                          line - 1 - before >= EARLY && !strchr(".:", line[-2]);
        if (line > text && !joins)
            putchar('\n');
        if (!joins) {
            at = printf("%*s", (int)blanks, "");
            indent = (int)blanks + (blanks > 0 ? 2 : 0);
        }
        const char *word = line + blanks, *end = line + n;
        size_t gap = joins ? 1 : 0;
        while (word < end) {
            const int wide = (int)strcspn(word, " \n");
            if (at + (int)gap + wide > WIDTH)
                at = printf("\n%*s", indent, "") - 1;
            else
                at += printf("%*s", (int)gap, "");
            at += printf("%.*s", wide, word);
            word += wide;
            gap = strspn(word, " ");
            word += gap;
        }
        next = end + (*end == '\n');
    }
    putchar('\n');
}

/* ---- --help ------------------------------------------------------------------------- */

static void print_group_title(const rb_option *group)
{
    printf("\n%s [%s]\n", group->help, group->name);
}

/* The sets of a case, its output and its examples are abbreviated; a command's own, which
 * begins with a group of its own, never. */
static int is_abbreviated(const cli_spec *spec, int s)
{
    const rb_option *first = spec->sets[s].options;
    return s == 0 || strcmp(first->name, "output") == 0 || strcmp(first->name, "example") == 0;
}

/* All options of a set of the spec, or the common ones below one title. */
static void print_set(const cli_spec *spec, const rb_option_set *set, int common)
{
    const rb_option *group = NULL;
    for (const rb_option *o = set->options; o < set->options + set->n; o++) {
        if (o->kind == RB_OPTION_GROUP)
            group = o;
        else if ((o->common || !common) && cli_takes(spec, o)) {
            if (group && !common)
                print_group_title(group);
            print_option(o, set->target);
            group = NULL;
        }
    }
}

int cli_print_help(const cli_spec *spec, const char *part)
{
    char *words[] = {(char[80]){""}, NULL};
    const int is_part = part && strcmp(part, "all") != 0;
    int found = !is_part, common = 0;
    for (int i = 0; spec->set_n > 0 && i < spec->sets[0].n; i++)
        common |= spec->sets[0].options[i].common;
    FILE *pager = cli_open_pager();
    /* The groups that begin so, and the option of that name. */
    for (cli_option at = {0}; is_part && cli_next_option(spec, &at);) {
        const int inside = at.group && strncmp(at.group->name, part, strlen(part)) == 0;
        if (inside && at.is_first)
            print_group_title(at.group);
        if (inside || strcmp(at.option->name, part) == 0) {
            print_option(at.option, at.target);
            found = 1;
        }
    }
    if (!part && pager && common) {
        /* The command's own options, and the common ones of the case. */
        const char *paragraph = strstr(spec->about, "\n\n");
        const int n = (int)(paragraph ? paragraph - spec->about : (long)strlen(spec->about));
        char about[2000];
        snprintf(about, sizeof about, "%.*s", n, spec->about);
        printf("Usage: %s\n\n", spec->synopsis);
        print_text(about);
        for (int s = 1; s < spec->set_n; s++)
            if (!is_abbreviated(spec, s))
                print_set(spec, &spec->sets[s], 0);
        puts("\nThe most used options");
        for (int s = 0; s < spec->set_n; s++)
            if (is_abbreviated(spec, s))
                print_set(spec, &spec->sets[s], 1);
        char text[1000] = "";
        for (cli_option at = {0}; cli_next_option(spec, &at);)
            if (at.is_first)
                rb_append(text, sizeof text, "%s%s", *text ? ", " : "", at.group->name);
        puts("\nMore");
        cli_print_entry("--help=all", "every option");
        cli_print_entry("--help=GROUP", text);
        cli_print_entry("rollbem help WORD", "search options, results, glossary and FAQ for "
                                             "a word, such as: rollbem help rubber");
        cli_print_entry("rollbem help", "the other commands: curve, stress, wear, sweep, ...");
    } else if (!is_part) {
        printf("Usage: %s\n\n", spec->synopsis);
        print_text(spec->about);
        for (int s = 0; s < spec->set_n; s++)
            print_set(spec, &spec->sets[s], 0);
        puts("\nCommon");
        cli_print_entry("--help[=all|GROUP]", "this text, or the options of a group");
        cli_print_entry("--usage", "the options on a few lines");
        cli_print_entry("--version", "the version");
        cli_print_entry("--color=auto|always|never",
                        "colours on a terminal (auto: without NO_COLOR)");
        cli_print_entry("--describe=man|markdown",
                        "this text as a manual page or for a page; =schema: the JSON Schema "
                        "of --json");
        cli_print_entry("--completion=bash|zsh|fish", "the completion of a shell");
        if (spec->notes) {
            puts("");
            print_text(spec->notes);
        }
    }
    cli_close_pager(pager);
    if (found)
        return CLI_OK;
    snprintf(words[0], 80, "%s", part);
    return cli_find(1, words);
}

void cli_print_usage(const cli_spec *spec)
{
    char values[120];
    int at = 0;
    printf("Usage: %s\n", spec->synopsis);
    for (cli_option of = {0}; cli_next_option(spec, &of);) {
        cli_option_metavar(of.option, values, sizeof values);
        const int n = (int)(strlen(of.option->name) + strlen(values)) + 5;
        if (at > 0 && at + n > WIDTH) {
            putchar('\n');
            at = 0;
        }
        at += printf("%s[--%s%s]", at ? " " : "  ", of.option->name, values);
    }
    puts(at ? "\n  [--help] [--usage] [--version]" : "  [--help] [--usage] [--version]");
}
