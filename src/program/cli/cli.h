/* What the commands share: exit codes, one error line, options from a table, one place
 * that writes.  The commands parse, call the library and print; they hold no mechanics.
 *
 * A new command: write `int cli_<name>(int argc, char **argv)` in src/program/cli/<name>.c
 * (argv[0] is the command's name), declare it here, add one line to the table in main.c.
 * It prints its results to stdout with stdio (main flushes and reports write errors) and
 * returns a cli_exit. */
#ifndef ROLLBEM_CLI_H
#define ROLLBEM_CLI_H

#include "base/base.h"
#include "rollbem/case.h"
#include "rolling/case/options.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>

/* ---- Commands -------------------------------------------------------------------- */

int cli_solve(int argc, char **argv); /* the default command */
int cli_curve(int argc, char **argv);
int cli_design(int argc, char **argv);
int cli_fit(int argc, char **argv);
int cli_wear(int argc, char **argv);
int cli_crack(int argc, char **argv);
int cli_sweep(int argc, char **argv);
int cli_stress(int argc, char **argv);
int cli_verify(int argc, char **argv);
int cli_check(int argc, char **argv);
int cli_lcp(int argc, char **argv);
int cli_friction(int argc, char **argv);
int cli_compare(int argc, char **argv);
int cli_example(int argc, char **argv);
int cli_page(int argc, char **argv);
int cli_contact(int argc, char **argv);
int cli_prony(int argc, char **argv);
int cli_rubber(int argc, char **argv);
int cli_examples(int argc, char **argv);
int cli_help(int argc, char **argv);

typedef struct {
    const char *name; /* "": the command without a name, the last row */
    int (*run)(int argc, char **argv);
    const char *help; /* its line in the list */
} cli_command;

/* Keeps the table and the command line; 0: no memory. */
int cli_begin(const cli_command *table, int argc, char **argv);
void cli_end(void);

/* Of command k = 0, 1, ...; NULL: there are no more. */
const char *cli_command_name(int k);
/* The line of a command in the list; "" is the one without a name; NULL: there is none. */
const char *cli_command_help(const char *name);

/* Calls the command of that name; its exit code, or CLI_USAGE when there is none. */
int cli_run(const char *name, int argc, char **argv);

/* "--example NAME" and what it is, of example k = 0, 1, ...; 0: there are no more. */
int cli_example_about(int k, char *name, size_t name_size, char *about, size_t size);
/* 1: --example takes that name. */
int cli_example_is_case(const char *name);

/* Tries every command's name. */
void cli_guess_command(rb_guess *guess);

/* The command line as typed, quoted for a shell where needed. */
const char *cli_command_line(void);
/* The words of a line that is quoted so, cut apart in place, behind "rollbem" and with
 * NULL at the end; the caller frees the list.  NULL: no memory. */
char **cli_split_line(char *line, int *argc);

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

/* RB_EINVAL is CLI_USAGE: a command that knows the value came from a file says CLI_DATA. */
cli_exit cli_exit_of(rb_status s);

/* Prints the line "rollbem: ..." on stderr and returns code. */
cli_exit cli_fail(cli_exit code, const char *format, ...) RB_PRINTF(2, 3);

/* CLI_CONTINUE where s is RB_OK, or the exit code after printing the line of why. */
cli_exit cli_say(rb_status s, const rb_message *why);
/* The same behind the name of an option. */
cli_exit cli_say_of(const char *option, rb_status s, const rb_message *why);

/* 1: from now on cli_fail keeps its line for cli_kept_failure() ("": none so far); 0: it
 * prints again.  Returns what it did before. */
int cli_keep_failures(int keep);
const char *cli_kept_failure(void);

/* ---- The terminal ---------------------------------------------------------------- */

/* --color: "auto", "always", "never"; 0: it is none of them. */
int cli_set_colour(const char *when);
/* 1: ANSI colours on that stream: a terminal without NO_COLOR, or always. */
int cli_is_coloured(FILE *stream);
/* Characters in a line of the terminal behind that descriptor, 80 where there is none;
 * lines of standard output, 24 where it is no terminal. */
int cli_terminal_width(int fd);
int cli_terminal_height(void);

/* ---- Options (rollbem/case.h) ----------------------------------------------------- */

#define CLI_MAX_SETS 5

typedef struct {
    const char *synopsis; /* "rollbem lcp [OPTION...] FILE..." */
    const char *about;    /* text of --help above the options */
    const char *notes;    /* text below them, or NULL */
    const char *refused;  /* ",NAME,...,": options that the command never takes, or NULL */
    rb_case_purpose purpose, second; /* those that neither takes are not shown, either */
    rb_option_set sets[CLI_MAX_SETS];
    int set_n;
} cli_spec;

/* Operands, in order: argument vector's own strings.  Zero it before use. */
typedef struct {
    char **operand; /* and NULL */
    int operands;
    int own; /* so many in front are the command's own, the next is a case file */
} cli_args;

/* Reads argv[1] ... into the targets: --name value, --name=value, `--` ends the options.
 * CLI_CONTINUE to go on; otherwise the exit code to return: --help, --usage and
 * --version are answered here, an error has been printed.  Free args in any case. */
cli_exit cli_parse(const cli_spec *spec, int argc, char **argv, cli_args *args);
void cli_args_free(cli_args *args);
/* The case file among the operands; NULL: there is none. */
const char *cli_case_file_of(const cli_args *args);

/* "curve" of "rollbem curve [OPTION...]"; "" for the command without a name.  Returns name. */
const char *cli_command_of(const cli_spec *spec, char name[24]);
/* 1: it is no group, and the command takes it in some case: help, completions and manual pages
 * show it. */
int cli_takes(const cli_spec *spec, const rb_option *o);
/* The options that a command takes, one after the other.  Begin with zeros. */
typedef struct {
    const rb_option *option, *group; /* group: its heading; NULL: none */
    const void *target;              /* of its set */
    int is_first;                    /* 1: the first one of its group */
    int set, next;                   /* where the following one is looked for */
} cli_option;
/* 0: there are no more. */
int cli_next_option(const cli_spec *spec, cli_option *at);
/* What every command but help says to --describe=FORM; the one without a name last, or first. */
cli_exit cli_describe_all(const char *form, int nameless_first);

/* How the value of an option is shown: " X", " arc|hub"; "" of a flag. */
void cli_option_metavar(const rb_option *o, char *text, size_t size);
/* The help line with unit, range and default. */
void cli_option_text(const rb_option *o, const void *target, char *text, size_t size);

/* A name, and the text beside it, in 80 columns. */
void cli_print_entry(const char *name, const char *text);

/* Standard output of this process through a pager, which leaves at once where a screen
 * holds everything; NULL: it is no terminal.  Closing NULL does nothing. */
FILE *cli_open_pager(void);
void cli_close_pager(FILE *pager);
/* Summaries and tables between the two calls are shown by a pager if they are longer than
 * the window of the terminal. */
void cli_page_begin(void);
void cli_page_end(void);

/* --help and --usage of a command, on stdout.  part: "all" options, those of a group, or
 * one; NULL: all, or on a terminal the common ones.  The exit code. */
int cli_print_help(const cli_spec *spec, const char *part);
void cli_print_usage(const cli_spec *spec);

#endif
