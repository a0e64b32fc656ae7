/* A line of help: a name and the text beside it, of options by their tables; the pager. */
#include "rolling/case/case.h"
#include "rolling/case/options.h"
#include "program/cli/cli.h"

#include <fcntl.h>
#include <string.h>
#include <unistd.h>

enum { NAME_COLUMN = 28, WIDTH = 80 };

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

void cli_option_text(const rb_option *o, const void *target, char *text, size_t size)
{
    char buffer[64], expected[200];
    const int numeric = o->kind == RB_OPTION_NUMBER || o->kind == RB_OPTION_INTEGER;
    const char *shown = o->unset ? o->unset : rb_option_text(o, target, buffer);
    const char *range = "";
    if (numeric) {
        const char *whole = rb_option_expected(o, expected, sizeof expected);
        range = whole + strlen(o->kind == RB_OPTION_NUMBER ? "a number" : "a whole number");
    }
    if (o->kind == RB_OPTION_FLAG || (o->kind == RB_OPTION_TEXT && !o->unset))
        shown = "";
    snprintf(text, size, "%s%s%s%s%s%s%s%s%s", o->help, numeric && *o->unit ? " [" : "",
             numeric ? o->unit : "", numeric && *o->unit ? "]" : "", *range ? "," : "", range,
             *shown ? " (" : "", shown, *shown ? ")" : "");
}

void cli_print_entry(const char *name, const char *text)
{
    const int n = printf("  %s", name);
    if (n + 1 >= NAME_COLUMN)
        printf("\n%*s", NAME_COLUMN, "");
    else
        printf("%*s", NAME_COLUMN - n, "");
    /* Words of text from column on, broken before WIDTH. */
    int at = NAME_COLUMN;
    while (*text) {
        const int length = (int)strcspn(text, " \n");
        if (at > NAME_COLUMN && at + 1 + length > WIDTH) {
            printf("\n%*s", NAME_COLUMN, "");
            at = NAME_COLUMN;
        } else if (at > NAME_COLUMN) {
            putchar(' ');
            at++;
        }
        printf("%.*s", length, text);
        at += length;
        text += length;
        text += strspn(text, " \n");
    }
    putchar('\n');
}

FILE *cli_open_pager(void)
{
    FILE *pager = NULL;
    if (isatty(STDOUT_FILENO)) /* what does not start has read nothing */
        pager = popen("if [ -n \"$PAGER\" ]; then eval \"$PAGER\"; case $? in 126|127) exec cat;; "
                      "esac; elif command -v less >/dev/null; then exec less -FRX; else exec cat; "
                      "fi",
                      "w");
    if (pager)
        dup2(fileno(pager), STDOUT_FILENO);
    return pager;
}

/* The pager reads until the last copy of its pipe is closed. */
void cli_close_pager(FILE *pager)
{
    if (!pager)
        return;
    fflush(stdout);
    close(STDOUT_FILENO);
    open("/dev/null", O_WRONLY);
    pclose(pager);
}
