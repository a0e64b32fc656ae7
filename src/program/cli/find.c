/* rollbem help WORD: finds commands, options, results, units, words of the glossary and
 * questions that contain it. */
#include "analysis/crack/crack_case.h"
#include "rolling/case/case.h"
#include "rolling/rolling.h"
#include "program/cli/find.h"

#include "base/units.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

enum { WORD, QUESTION };

static const struct {
    int kind;
    const char *name, *text;
} texts[] = {
#include "words.inc" /* of docs/glossary.md and docs/faq.md, by the Makefile */
};

enum { TEXTS = sizeof texts / sizeof texts[0], SETS_MAX = 64 };

/* What is looked for, and where the search stands. */
static struct {
    int n, in_name, found;
    char **word;
    const char *title; /* to be printed above the next line; NULL: it has been */
    const rb_option *searched[SETS_MAX];
    int searched_n;
} search;

/* 1: some word of text begins with it, in capitals or not. */
static int has(const char *text, const char *word)
{
    const size_t n = strlen(word);
    for (const char *at = text; *at; at++)
        if (strncasecmp(at, word, n) == 0 && (at == text || !isalnum((unsigned char)at[-1])))
            return 1;
    return 0;
}

/* All words are in the name or the text; in a first round all are in the name. */
static int matches(const char *name, const char *text)
{
    int in_name = 1;
    for (int k = 0; k < search.n; k++) {
        const int here = has(name, search.word[k]);
        in_name &= here;
        if (!here && !has(text, search.word[k]))
            return 0;
    }
    return in_name == search.in_name;
}

static void print_entry(const char *name, const char *text)
{
    if (search.title)
        printf("%s%s\n", search.found ? "\n" : "", search.title);
    search.title = NULL;
    search.found++;
    cli_print_entry(name, text);
}

static void show_if(const char *name, const char *text)
{
    if (matches(name, text))
        print_entry(name, text);
}

/* ---- Words ------------------------------------------------------------------------- */

/* What others call our options. */
const char *cli_other_name(const char *name, size_t length)
{
    static const char *const names[][2] = {{"E", "young"},
                                           {"nu", "poisson"},
                                           {"R", "radius"},
                                           {"r", "radius"},
                                           {"P", "load"},
                                           {"N", "load"},
                                           {"Q", "force"},
                                           {"xi", "creep"},
                                           {"creepage", "creep"},
                                           {"slip", "creep"},
                                           {"friction", "mu"},
                                           {"cof", "mu"},
                                           {"modulus", "young"},
                                           {"thickness", "layer-thickness"},
                                           {"elements", "contact-elements"},
                                           {"n", "contact-elements"},
                                           {"velocity", "speed"},
                                           {"v", "speed"},
                                           {"vary", "vary-1"},
                                           {"out", "output"},
                                           {"o", "output"},
                                           {"file", "output"},
                                           {"picture", "plot"},
                                           {"tolerance", "tol"},
                                           {"delta", "approach"},
                                           {"case", "example"},
                                           {"a", "half-width"},
                                           {"rolling", "formulation"},
                                           {"steady", "formulation steady"},
                                           {"static", "formulation static"},
                                           {"transient", "formulation transient"},
                                           {"halfplane", "support halfplane"},
                                           {"csv", "format csv"},
                                           {"si", "units si"}};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
        if (strlen(names[k][0]) == length && strncmp(names[k][0], name, length) == 0)
            return names[k][1];
    return NULL;
}

/* ---- Options ------------------------------------------------------------------------ */

void cli_find_options(const cli_spec *spec)
{
    char command[24], values[120], name[200], text[700];
    cli_command_of(spec, command);
    for (const rb_option_set *set = spec->sets; set < spec->sets + spec->set_n; set++) {
        int k = 0;
        while (k < search.searched_n && search.searched[k] != set->options)
            k++;
        if (k < search.searched_n ||
            (set->options == rb_case_crack_options && strcmp(command, "crack") != 0))
            continue; /* a study takes those of a crack, too */
        if (k < SETS_MAX)
            search.searched[search.searched_n++] = set->options;
        for (const rb_option *o = set->options; o < set->options + set->n; o++) {
            if (!cli_takes(spec, o))
                continue;
            cli_option_metavar(o, values, sizeof values);
            snprintf(name, sizeof name, "--%s%s", o->name, values);
            cli_option_text(o, set->target, text, sizeof text);
            if (!matches(name, text))
                continue;
            if (*command)
                rb_append(text, sizeof text, " [rollbem %s]", command);
            print_entry(name, text);
        }
    }
}

/* ---- Commands that have an option -------------------------------------------------- */

enum { SHOWN = 3 };

static struct {
    const char *name;
    size_t length;
    int n;
    char commands[200]; /* the first SHOWN */
} wanted;

void cli_find_holder(const cli_spec *spec)
{
    char command[24];
    cli_command_of(spec, command);
    for (cli_option at = {0}; cli_next_option(spec, &at);)
        if (strlen(at.option->name) == wanted.length &&
            strncmp(at.option->name, wanted.name, wanted.length) == 0 && wanted.n++ < SHOWN)
            rb_append(wanted.commands, sizeof wanted.commands, "%srollbem%s%s",
                      wanted.n > 1 ? ", " : "", *command ? " " : "", command);
}

const char *cli_commands_with(const char *name, size_t length)
{
    wanted.name = name;
    wanted.length = length;
    wanted.n = 0;
    *wanted.commands = '\0';
    cli_describe_all("holder", 1);
    if (wanted.n > SHOWN)
        rb_append(wanted.commands, sizeof wanted.commands, " and others");
    return wanted.commands;
}

/* ---- Everything else ---------------------------------------------------------------- */

/* Part by part; what has the words in its name comes first. */
static void find_everything(const rb_option_set *options)
{
    enum { COMMANDS, OPTIONS, UNITS, RESULTS, EXAMPLES, GLOSSARY, QUESTIONS, PARTS };
    static const char *const titles[PARTS] = {
        "Commands", "Options",
        "Units",    "Results: columns, names in JSON, of --results and of Python",
        "Examples", "Glossary",
        "Questions"};
    char name[80], text[1000];
    for (int part = 0; part < PARTS; part++) {
        search.title = titles[part];
        for (search.in_name = 1; search.in_name >= 0; search.in_name--) {
            search.searched_n = 0;
            for (int k = 0; part == COMMANDS && cli_command_name(k); k++) {
                snprintf(name, sizeof name, "rollbem %s", cli_command_name(k));
                show_if(name, cli_command_help(cli_command_name(k)));
            }
            if (part == OPTIONS) /* each command shows its own, those of several once */
                cli_describe_all("search", 1);
            if (part == UNITS && search.n == 1 && !search.in_name) {
                /* What the one word may be a unit of. */
                char one[60], of[2000] = "";
                double value;
                int plain;
                snprintf(one, sizeof one, "1%.50s", search.word[0]);
                for (int i = 0; i < options->n; i++) {
                    const rb_option *o = &options->options[i];
                    if (o->kind == RB_OPTION_NUMBER && *o->unit && strcmp(o->unit, "-") != 0 &&
                        rb_unit_read(one, o->unit, &value, &plain, NULL) == RB_OK && !plain)
                        rb_append(of, sizeof of, "%s--%s", *of ? ", " : "a unit of ", o->name);
                }
                if (*of)
                    print_entry(search.word[0], of);
            }
            const rb_rolling_result_table *t;
            for (int j = 0; part == RESULTS && (t = rb_case_result_table(j)); j++)
                for (int k = 0; k < t->results->n; k++) {
                    const rb_rolling_result *r = &t->results->row[k];
                    const int has_unit = r->unit && *r->unit && strcmp(r->unit, "-") != 0;
                    snprintf(name, sizeof name, "%s%s%s%s", r->name, has_unit ? " [" : "",
                             has_unit ? r->unit : "", has_unit ? "]" : "");
                    snprintf(text, sizeof text, "%s (%s)", r->meaning, t->title);
                    show_if(name, text);
                }
            for (int k = 0;
                 part == EXAMPLES && cli_example_about(k, name, sizeof name, text, sizeof text);
                 k++)
                show_if(name, text);
            for (int k = 0; k < TEXTS; k++)
                if (part == (texts[k].kind == WORD ? GLOSSARY : QUESTIONS))
                    show_if(texts[k].name, texts[k].text);
        }
    }
}

int cli_find(int n, char **words)
{
    enum { MOST = 20 };
    /* Words that a question has besides those that it is about. */
    static const char *const stop_words[] = {
        "a",  "an", "and", "are", "can", "do", "does", "for",  "how",   "i",     "in",   "is",
        "it", "my", "of",  "on",  "the", "to", "what", "when", "where", "which", "with", "why"};
    enum { STOP_WORDS = sizeof stop_words / sizeof *stop_words };
    rb_case *c = rb_case_create(RB_CASE_SINGLE);
    if (!c)
        return cli_fail(CLI_INTERNAL, "out of memory");
    const rb_option_set options = rb_case_options(c);
    rb_guess near = {.word = words[0]};
    char all[200] = "", split[200], *asked[MOST], *rest = split;
    for (int k = 0; k < n; k++)
        rb_append(all, sizeof all, "%s%s", k ? " " : "", words[k]);
    memset(&search, 0, sizeof search);
    strcpy(split, all);
    for (char *word; search.n < MOST && (word = strtok_r(rest, " ?", &rest)) != NULL;) {
        int k = 0;
        while (k < STOP_WORDS && strcasecmp(word, stop_words[k]) != 0)
            k++;
        if (k == STOP_WORDS)
            asked[search.n++] = word;
    }
    search.word = asked;
    if (search.n == 0) { /* stop words alone, such as: it */
        search.n = n;
        search.word = words;
    }
    FILE *pager = cli_open_pager();
    find_everything(&options);
    const char *other = cli_other_name(words[0], strlen(words[0]));
    if (!search.found && n == 1 && other) {
        char *instead[] = {strcpy((char[80]){""}, other), NULL};
        search.word = instead;
        find_everything(&options);
    }
    cli_close_pager(pager);
    cli_guess_command(&near);
    for (int i = 0; i < options.n; i++)
        rb_guess_try(&near, options.options[i].name);
    for (int k = 0; k < TEXTS; k++)
        if (texts[k].kind == WORD)
            rb_guess_try(&near, texts[k].name);
    rb_case_free(c);
    return search.found ? CLI_OK
                        : cli_fail(CLI_USAGE, "help: nothing about '%s'%s", all,
                                   n == 1 ? rb_guess_text(&near, "") : "");
}

int cli_help(int argc, char **argv)
{
    char name[40];
    if (argc == 2 && *argv[1] && cli_command_help(argv[1])) {
        char *args[] = {argv[1], "--help", NULL};
        return cli_run(argv[1], 2, args);
    }
    if (argc > 1 && strcmp(argv[1], "--help") != 0)
        return cli_find(argc - 1, argv + 1);
    FILE *pager = cli_open_pager();
    cli_print_entry("rollbem [OPTION...] [CASE.ini]",
                    "solve one case of rolling contact, print its table");
    for (int k = 0; cli_command_name(k); k++) {
        snprintf(name, sizeof name, "rollbem %s", cli_command_name(k));
        cli_print_entry(name, cli_command_help(cli_command_name(k)));
    }
    puts("");
    cli_print_entry("rollbem --help", "the options of a case");
    cli_print_entry("rollbem help COMMAND", "those of a command");
    cli_print_entry("rollbem help WORD", "search options, results, glossary and FAQ for "
                                         "a word, such as: rollbem help rubber");
    cli_close_pager(pager);
    return CLI_OK;
}
