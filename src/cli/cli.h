/* What the commands share: exit codes, one error line, options from a table, one place
 * that writes.  The commands parse, call the library and print; they hold no mechanics.
 *
 * A new command: write `int cli_<name>(int argc, char **argv)` in src/cli/<name>.c
 * (argv[0] is the command's name), declare it here, add one line to the table in main.c.
 * It prints its results to stdout with stdio (main flushes and reports write errors) and
 * returns a cli_exit. */
#ifndef ROLLBEM_CLI_H
#define ROLLBEM_CLI_H

#include "rollbem/rollbem.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>

/* ---- Commands -------------------------------------------------------------------- */

int cli_solve(int argc, char **argv); /* the default command */
int cli_curve(int argc, char **argv);
int cli_sweep(int argc, char **argv);
int cli_stress(int argc, char **argv);
int cli_verify(int argc, char **argv);
int cli_lcp(int argc, char **argv);
int cli_friction(int argc, char **argv);
int cli_compare(int argc, char **argv);
int cli_example(int argc, char **argv);
int cli_help(int argc, char **argv);

/* Calls the command of that name; its exit code, or CLI_USAGE when there is none. */
int cli_run(const char *name, int argc, char **argv);

/* Tries every command's name. */
struct cli_guess;
void cli_guess_command(struct cli_guess *guess);

/* The command line as typed, quoted for a shell where needed. */
const char *cli_command_line(void);

/* ---- Ends ------------------------------------------------------------------------ */

typedef enum {
    CLI_CONTINUE = -1, /* of cli_parse: nothing went wrong, go on */
    CLI_OK = 0,
    CLI_UNSOLVED = 1,  /* not converged, no contact, zone too small, inaccurate */
    CLI_USAGE = 64,    /* wrong values on the command line */
    CLI_DATA = 65,     /* the same in a file */
    CLI_NOINPUT = 66,  /* no such input file */
    CLI_INTERNAL = 70, /* memory, a missing helper program */
    CLI_CANTWRITE = 73
} cli_exit;

/* RB_EINVAL is CLI_USAGE: a command that knows the value came from a file says CLI_DATA.
 */
cli_exit cli_exit_of(rb_status s);

/* Prints the line "rollbem: ..." on stderr and returns code. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
cli_exit
cli_fail(cli_exit code, const char *format, ...);

/* From now on cli_fail keeps its line for cli_kept_failure() ("": none so far). */
void cli_keep_failures(void);
const char *cli_kept_failure(void);

/* The candidate nearest to a misspelt word.  Start with {.word = word}. */
typedef struct cli_guess {
    const char *word, *best;
    int distance;
} cli_guess;

void cli_guess_try(cli_guess *guess, const char *candidate);
/* " (did you mean '...'?)", or "" when nothing is near; prefix is put before the word.
 * Static storage. */
const char *cli_guess_text(const cli_guess *guess, const char *prefix);

/* ---- Options --------------------------------------------------------------------- */

typedef enum {
    CLI_GROUP,   /* no option: a heading; name is the INI section, help the title */
    CLI_NUMBER,  /* double */
    CLI_INTEGER, /* int */
    CLI_CHOICE,  /* int (an enum) */
    CLI_FLAG,    /* int: 1 by --name, --name=no takes it back */
    CLI_TEXT     /* const char * */
} cli_kind;

typedef struct {
    const char *name;
    int value;
} cli_choice;

typedef struct {
    double from, to;
    int from_open, to_open; /* 1: the end itself is not allowed */
} cli_range;

#define CLI_ANY                                                                          \
    {                                                                                    \
        -INFINITY, INFINITY, 1, 1                                                        \
    }
#define CLI_ABOVE(x)                                                                     \
    {                                                                                    \
        x, INFINITY, 1, 1                                                                \
    }
#define CLI_FROM(x)                                                                      \
    {                                                                                    \
        x, INFINITY, 0, 1                                                                \
    }
#define CLI_BETWEEN(x, y)                                                                \
    {                                                                                    \
        x, y, 1, 1                                                                       \
    } /* (x, y) */
#define CLI_FROM_TO(x, y)                                                                \
    {                                                                                    \
        x, y, 0, 0                                                                       \
    } /* [x, y] */
#define CLI_ABOVE_UPTO(x, y)                                                             \
    {                                                                                    \
        x, y, 1, 0                                                                       \
    } /* (x, y] */

/* Numbers separated by commas. */
enum { CLI_LIST_MAX = 16 };

typedef struct {
    int n;
    double value[CLI_LIST_MAX];
} cli_list;

/* Every option once: parser, INI reader, JSON `inputs`, help and range errors are all
 * made from this. */
typedef struct {
    const char *name; /* --name, and the key in a case file */
    cli_kind kind;
    size_t offset;    /* of the value in the set's target */
    const char *unit; /* "mm"; "" for none */
    cli_range range;  /* numbers and integers */
    const char *word; /* numbers: a word that stands for word_value, or NULL */
    double word_value;
    size_t list; /* numbers: when not 0, more of them may follow after commas; all are
                    stored here (cli_list), the first one as the value */
    const cli_choice *choices; /* ends with a NULL name */
    size_t path; /* choices: when not 0, any other word is a name, stored here
                    (const char *), and the value is path_value */
    int path_value;
    const char *path_name; /* of that other word in the help: FILE, NAME */
    unsigned excludes;     /* of options that share a bit only one may be given */
    const char *unset;     /* help: what stands for the default; NULL: the value itself */
    const char *help;
} cli_option;

/* A table and the struct its values go to.  given: n entries, 0 default, -1 command line,
 * k > 0 line k of the case file; NULL for commands without case files. */
typedef struct {
    const cli_option *options;
    int n;
    void *target;
    int *given;
} cli_set;

/* Option tables, a line each: */
#define CLI_GROUP_LINE(section, title)                                                   \
    {                                                                                    \
        .name = section, .kind = CLI_GROUP, .help = title                                \
    }
#define CLI_NUMBER_LINE(name_, place, unit_, range_, ...)                                \
    {                                                                                    \
        .name = name_, .kind = CLI_NUMBER, .offset = place, .unit = unit_,               \
        .range = range_, .help = __VA_ARGS__                                             \
    }
#define CLI_INTEGER_LINE(name_, place, range_, ...)                                      \
    {                                                                                    \
        .name = name_, .kind = CLI_INTEGER, .offset = place, .unit = "",                 \
        .range = range_, .help = __VA_ARGS__                                             \
    }
#define CLI_CHOICE_LINE(name_, place, choices_, ...)                                     \
    {                                                                                    \
        .name = name_, .kind = CLI_CHOICE, .offset = place, .unit = "",                  \
        .choices = choices_, .help = __VA_ARGS__                                         \
    }
#define CLI_FLAG_LINE(name_, place, ...)                                                 \
    {                                                                                    \
        .name = name_, .kind = CLI_FLAG, .offset = place, .unit = "",                    \
        .help = __VA_ARGS__                                                              \
    }
#define CLI_TEXT_LINE(name_, place, metavar, ...)                                        \
    {                                                                                    \
        .name = name_, .kind = CLI_TEXT, .offset = place, .unit = metavar,               \
        .help = __VA_ARGS__                                                              \
    }

#define CLI_GIVEN_ARGUMENT (-1)
#define CLI_MAX_SETS 3

typedef struct {
    const char *synopsis; /* "rollbem lcp [OPTION...] FILE..." */
    const char *about;    /* text of --help above the options */
    const char *notes;    /* text below them, or NULL */
    cli_set sets[CLI_MAX_SETS];
    int set_n;
} cli_spec;

/* Operands, in order: argument vector's own strings.  Zero it before use. */
typedef struct {
    char **operand;
    int operands;
    char **kept; /* copies of text values read from files */
    int kept_n;
} cli_args;

/* Reads argv[1] ... into the targets: --name value, --name=value, `--` ends the options.
 * CLI_CONTINUE to go on; otherwise the exit code to return: --help, --usage and
 * --version are answered here, an error has been printed.  Free args in any case. */
cli_exit cli_parse(const cli_spec *spec, int argc, char **argv, cli_args *args);
void cli_args_free(cli_args *args);

/* Reads a case file into the targets; keys given on the command line keep their value.
 * CLI_CONTINUE or an exit code, its line printed. */
cli_exit cli_read_ini(const cli_spec *spec, const char *path, cli_args *args);

/* One value, strictly; what: how messages call it ("--mu", "case.ini:3: mu").  Text is
 * borrowed.  CLI_CONTINUE, or code after printing the line. */
cli_exit cli_set_value(const cli_option *option, void *target, const char *what,
                       const char *value, cli_exit code);

/* "a number >= 0", "lemke, newton or auto": what the option wants.  Returns text. */
const char *cli_expected(const cli_option *option, char *text, size_t size);

/* The value as text of a case file; room for 64 bytes or the text itself. */
const char *cli_value_text(const cli_option *option, const void *target, char room[64]);

/* 1: the whole of text is one finite number. */
int cli_number(const char *text, double *value);

/* Where an option came from in a message: "--load", "case.ini:3: load".  Returns room. */
const char *cli_source(const cli_option *option, int given, const char *path, char *room,
                       size_t size);

/* Two given options that share a bit of `excludes` are refused, naming both, when both
 * come from the command line or both from the file; otherwise the one on the command line
 * wins: the other returns to its value in defaults (a struct like the set's target). Bits
 * in `alike` count as one bit. */
cli_exit cli_settle(const cli_set *set, const void *defaults, unsigned alike,
                    const char *path);

/* --help and --usage of a command, on stdout. */
void cli_print_help(const cli_spec *spec);
void cli_print_usage(const cli_spec *spec);

#endif
