/* --help and --usage, made from the option tables. */
#include "cli/cli.h"

#include <fcntl.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

enum { NAME_COLUMN = 28, WIDTH = 88 };

void cli_option_metavar(const rb_option *o, char *text, size_t size)
{
    text[0] = '\0';
    switch (o->kind) {
    case RB_OPTION_NUMBER:
        snprintf(text, size, " X%s%s", o->word ? "|" : "", o->word ? o->word : "");
        break;
    case RB_OPTION_INTEGER:
        snprintf(text, size, " N");
        break;
    case RB_OPTION_CHOICE:
        for (const rb_choice *c = o->choices; c->name; c++)
            rb_append(text, size, "%s%s", c == o->choices ? " " : "|", c->name);
        if (o->path)
            rb_append(text, size, "|%s", o->path_name);
        break;
    case RB_OPTION_TEXT:
        snprintf(text, size, " %s", o->unit);
        break;
    default:
        break;
    }
}

/* Words of text from column on, broken before WIDTH. */
static void print_wrapped(const char *text, int column, int indent)
{
    int at = column;
    while (*text) {
        const int n = (int)strcspn(text, " \n");
        if (at > indent && at + 1 + n > WIDTH) {
            printf("\n%*s", indent, "");
            at = indent;
        } else if (at > column) {
            putchar(' ');
            at++;
        }
        printf("%.*s", n, text);
        at += n;
        text += n;
        text += strspn(text, " \n");
    }
    putchar('\n');
}

void cli_option_text(const rb_option *o, const void *target, char *text, size_t size)
{
    char room[64], expected[200];
    const int numeric = o->kind == RB_OPTION_NUMBER || o->kind == RB_OPTION_INTEGER;
    const char *shown = o->unset ? o->unset : rb_option_text(o, target, room);
    const char *range = "";
    if (numeric) {
        const char *whole = rb_option_expected(o, expected, sizeof expected);
        range =
            whole + strlen(o->kind == RB_OPTION_NUMBER ? "a number" : "a whole number");
    }
    if (o->kind == RB_OPTION_FLAG || (o->kind == RB_OPTION_TEXT && !o->unset))
        shown = "";
    snprintf(text, size, "%s%s%s%s%s%s%s%s%s", o->help, numeric && *o->unit ? " [" : "",
             numeric ? o->unit : "", numeric && *o->unit ? "]" : "", *range ? "," : "",
             range, *shown ? " (" : "", shown, *shown ? ")" : "");
}

static void print_option(const rb_option *o, const void *target)
{
    char values[120], text[600];
    cli_option_metavar(o, values, sizeof values);
    cli_option_text(o, target, text, sizeof text);
    const int n = printf("  --%s%s", o->name, values);
    if (n + 1 >= NAME_COLUMN)
        printf("\n%*s", NAME_COLUMN, "");
    else
        printf("%*s", NAME_COLUMN - n, "");
    print_wrapped(text, NAME_COLUMN, NAME_COLUMN);
}

/* Standard output of this process through a pager, which leaves at once where a screen
 * holds everything; NULL: it is no terminal. */
static FILE *open_pager(void)
{
    FILE *pager = NULL;
    if (isatty(STDOUT_FILENO))
        pager = popen("if [ -n \"$PAGER\" ]; then exec $PAGER; elif command -v less "
                      ">/dev/null; then exec less -FRX; else exec cat; fi",
                      "w");
    if (pager)
        dup2(fileno(pager), STDOUT_FILENO);
    return pager;
}

/* The pager reads until the last copy of its pipe is closed. */
static void close_pager(FILE *pager)
{
    if (!pager)
        return;
    fflush(stdout);
    close(STDOUT_FILENO);
    open("/dev/null", O_WRONLY);
    pclose(pager);
}

void cli_print_help(const cli_spec *spec)
{
    FILE *pager = open_pager();
    printf("Usage: %s\n\n%s\n", spec->synopsis, spec->about);
    for (int s = 0; s < spec->set_n; s++)
        for (int i = 0; i < spec->sets[s].n; i++) {
            const rb_option *o = &spec->sets[s].options[i];
            if (o->kind == RB_OPTION_GROUP)
                printf("\n%s [%s]\n", o->help, o->name);
            else
                print_option(o, spec->sets[s].target);
        }
    puts("\nCommon\n"
         "  --help                    this text\n"
         "  --usage                   the options on a few lines\n"
         "  --version\n"
         "  --color=auto|always|never  colours on a terminal (auto: without NO_COLOR)\n"
         "  --describe=man|markdown   this text as a manual page or for a page;\n"
         "                            =schema: the JSON Schema of --json\n"
         "  --completion=bash|zsh|fish  the completion of a shell");
    if (spec->notes)
        printf("\n%s", spec->notes);
    close_pager(pager);
}

void cli_print_usage(const cli_spec *spec)
{
    char values[120];
    int at = 0;
    printf("Usage: %s\n", spec->synopsis);
    for (int s = 0; s < spec->set_n; s++)
        for (int i = 0; i < spec->sets[s].n; i++) {
            const rb_option *o = &spec->sets[s].options[i];
            if (o->kind == RB_OPTION_GROUP)
                continue;
            cli_option_metavar(o, values, sizeof values);
            const int n = (int)(strlen(o->name) + strlen(values)) + 5;
            if (at > 0 && at + n > WIDTH) {
                putchar('\n');
                at = 0;
            }
            at += printf("%s[--%s%s]", at ? " " : "  ", o->name, values);
        }
    puts(at ? "\n  [--help] [--usage] [--version]" : "  [--help] [--usage] [--version]");
}
