/* Cases as the commands that solve take them: from the command line and a case file. */
#ifndef ROLLBEM_CLI_CASE_H
#define ROLLBEM_CLI_CASE_H

#include "program/cli/output.h"

/* For --help of every command that takes a case. */
#define CLI_CASE_SIGNS                                                                             \
    "Signs: x to the right, y up; A is above and rolls towards +x, so the leading\n"               \
    "edge is at +x. Creepage xi = (V_A - V_B)/|V| > 0, V the mean speed of both\n"                 \
    "surfaces: A's surface slides towards +x over the ground (a braked wheel) and the\n"           \
    "friction q on A points to -x, Q < 0. Q and --force are the friction on A.\n"                  \
    "Pressure p >= 0. Loads per unit length. Units: mm, N, MPa, unless --units says\n"             \
    "others or a value its own (--young 210GPa); columns name theirs.\n"                           \
    "\n"                                                                                           \
    "    y, n                   .---.         P, approach: A moves down\n"                         \
    "     |                   /       \\\n"                                                        \
    "     |                  |    A    |  -->  rolls towards +x\n"                                 \
    "     +--- x, t           \\       /\n"                                                        \
    "                           '-^-'         p >= 0 pushes A up\n"                                \
    "    ==============================================================\n"                         \
    "     B                      -->          q > 0, Q > 0: friction on A"

#define CLI_CASE_NOTES                                                                             \
    "A case file holds the same names as keys, in the sections named in brackets or\n"             \
    "in none; the command line wins over the file.\n"

/* ---- A case from words ------------------------------------------------------------ */

/* A case of defaults, or NULL after saying that there is no memory. */
rb_case *cli_case_create(rb_case_purpose purpose);

/* Parses the arguments, reads the case file (the only operand allowed), resolves the
 * case, which is the first set of spec, and checks the files that the options name.
 * CLI_CONTINUE or an exit code, its line printed. */
cli_exit cli_case_parse(const cli_spec *spec, int argc, char **argv, rb_case *c, cli_args *args);
/* The same in two parts: what is given, and what it means. */
cli_exit cli_case_read(const cli_spec *spec, int argc, char **argv, rb_case *c, cli_args *args);
cli_exit cli_case_resolve(const cli_spec *spec, rb_case *c, const cli_args *args);

/* --example NAME, the last set of every spec of a case, and what it asks for; file: the case
 * file, which excludes it. */
rb_option_set cli_example_set(void);
cli_exit cli_example_read(rb_case *c, const char *file);

/* Refuses a text with numbers, such as NAME=X, that a case file has in other units than the
 * case. */
cli_exit cli_check_units(const rb_case *c, const rb_option_set *set, const cli_args *args);

/* Prints why the library refused the case; the exit code tells command line from file. */
cli_exit cli_case_refused(const rb_case *c, rb_status s, rb_message *why);
/* Refuses an option, the first given one of about (as rb_refuse), where it stands. */
cli_exit cli_case_refuse(const rb_case *c, const char *about, const char *format, ...)
    RB_PRINTF(3, 4);

/* ---- Commands that solve one ------------------------------------------------------ */

typedef struct cli_case_command cli_case_command;

/* A run of such a command, which all its functions see. */
typedef struct {
    const cli_case_command *command;
    void *own;         /* the command's struct: its options and its results */
    rb_option_set set; /* of its options */
    rb_case *words;
    const rb_resolved_case *c; /* what they mean */
    cli_output o;
    cli_args args;
    const rb_rolling_solution *solution; /* for notes, citations, JSON; NULL: none */
    const rb_rolling_note_list *of_rows; /* notes on the rows of a curve; NULL: on the solution */
    const rb_rolling_study_notes *of_steps; /* notes on steps before the solution's; or NULL */
    const rb_rolling_note_list *notes; /* all notes, the same for standard error, tables, JSON */
    int printable;                     /* 1: there are results, if not all that were asked for */
    int incomplete;                    /* 1: not all of them, although nothing has failed */
} cli_case_run;

/* A file that an option of the command asks for, written or drawn by one of the two
 * functions; their context is the cli_case_run. */
typedef struct {
    const char *option;
    cli_write *write;
    cli_draw *draw;
} cli_case_file;

/* An option of the command that means nothing without another one. */
typedef struct {
    const char *option, *with;
} cli_case_need;

enum { CLI_COMMAND_OPTIONS_MAX = 28 };

/* What is the command's own.  Functions may be NULL, but for solve, table, summarise. */
struct cli_case_command {
    const char *synopsis, *about, *notes, *refused; /* of its cli_spec */
    rb_case_purpose purpose, second; /* second: what it may become; RB_CASE_SINGLE: nothing else */
    const rb_option *options;
    int option_n;               /* CLI_COMMAND_OPTIONS_MAX at most */
    int options_last;           /* 1: they continue the section [output] */
    int has_scales;             /* 1: its table and picture may be dimensionless */
    int takes_crack;            /* 1: the case takes the options of a crack */
    int operands;               /* its own, in front of the case file */
    const cli_case_file *files; /* the last row has no option; NULL: none */
    const cli_case_need *needs; /* likewise */

    /* before the case is resolved, and before it is solved: CLI_CONTINUE, or an exit code after
     * saying what is wrong */
    cli_exit (*prepare)(cli_case_run *run);
    cli_exit (*check)(cli_case_run *run);
    /* sets solution and printable, in the units that are shown */
    rb_status (*solve)(cli_case_run *run, rb_message *why);
    /* what may still refuse before the table is written */
    cli_exit (*before_table)(const cli_case_run *run);
    rb_status (*table)(FILE *out, const cli_case_run *run);
    /* the JSON: what it shows of a case; what it adds to `inputs`, and beside them */
    void (*document)(const cli_case_run *run, rb_report_document *document);
    void (*inputs)(const cli_case_run *run, struct json_t **inputs);
    void (*json)(const cli_case_run *run, struct json_t **root);
    /* what its options ask for of the JSON, see cli_case_asks */
    void (*asked)(const cli_case_run *run, struct json_t **members);
    /* the summary */
    void (*summarise)(FILE *out, const cli_case_run *run);
};

/* Reads, resolves, solves and prints: the whole command.  Its exit code. */
cli_exit cli_case_run_command(const cli_case_command *command, void *own, int argc, char **argv);

/* What a command line of `rollbem` itself asks for: the resolved case, and members of the JSON:
 * true, false or a value; of an object, some of its own members.  What it would write is neither
 * looked at nor written; files: written, how many case files it names.  CLI_CONTINUE, or the exit
 * code after the line of why.  asked: NULL on error, or without memory. */
cli_exit cli_solve_asks(int argc, char **argv, rb_case *words, int *files, struct json_t **asked);
/* The same of `rollbem stress` and `rollbem crack`. */
cli_exit cli_stress_asks(int argc, char **argv, rb_case *words, int *files, struct json_t **asked);
cli_exit cli_crack_asks(int argc, char **argv, rb_case *words, int *files, struct json_t **asked);
/* The same of any such command. */
cli_exit cli_case_asks(const cli_case_command *command, void *own, int argc, char **argv,
                       rb_case *words, int *files, struct json_t **asked);

#endif
