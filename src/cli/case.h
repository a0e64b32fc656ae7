/* A case as the command line and case files give it: shared by the commands that solve.
 */
#ifndef ROLLBEM_CLI_CASE_H
#define ROLLBEM_CLI_CASE_H

#include "cli/cli.h"
#include "rollbem/io.h"

enum { CLI_CASE_OPTIONS_MAX = 64 };

/* For --help of every command that takes a case. */
#define CLI_CASE_SIGNS                                                                   \
    "Signs: x to the right, y up; A is above and rolls towards +x, so the leading\n"     \
    "edge is at +x. Creepage xi = (V_A - V_B)/|V| > 0: A's surface slides towards +x\n"  \
    "over the ground (a braked wheel) and the friction q on A points to -x, Q < 0.\n"    \
    "Pressure p >= 0. Units: any consistent set; names say mm, MPa and N/mm (loads\n"    \
    "per unit length)."

#define CLI_CASE_NOTES                                                                   \
    "A case file holds the same names as keys, in the sections named in brackets or\n"   \
    "in none; the command line wins over the file.\n"

typedef struct {
    rb_rolling_case rc;
    const char *gap_file; /* profile of the initial gap, or NULL */
    int similar;          /* B is of A's material */
    double young_b, poisson_b, radius_b;
    cli_list mus;             /* more than one: for curves */
    const char *history_file; /* or NULL */

    rb_rolling_program program; /* n = 0: none; its columns stand in history */
    rb_io_table history;

    int error;       /* 1: estimate discretisation errors */
    double accuracy; /* refine until they are below this; 0: no */

    char path[320]; /* case file, "" without */
    int given[CLI_CASE_OPTIONS_MAX];
    int lists;           /* 1: the command takes several mu */
    rb_io_table profile; /* x, gap */
} cli_case;

void cli_case_defaults(cli_case *c);
void cli_case_free(cli_case *c);

/* The options of a case, their values going to c. */
cli_set cli_case_set(cli_case *c);

/* Bits of `excludes` that count as one for the formulation of c. */
unsigned cli_case_alike(const cli_case *c);

/* After cli_parse: reads the case file (the only operand allowed), settles
 * contradictions, reads the gap profile, checks.  CLI_CONTINUE or an exit code, its line
 * printed. */
cli_exit cli_case_finish(const cli_spec *spec, cli_case *c, cli_args *args);

/* 1: --name was given on the command line or in the file. */
int cli_case_given(const cli_case *c, const char *name);
/* CLI_CONTINUE, or the line "--name: reason" when that option was given. */
cli_exit cli_case_refuse(const cli_case *c, const char *name, const char *reason);

/* 1: an option of that name takes a number. */
int cli_case_is_number(const cli_case *c, const char *name);
/* Gives an option of a finished case another value (number: of the case in messages);
 * then what depends on it is settled again and checked.  CLI_CONTINUE or an exit code,
 * its line printed. */
cli_exit cli_case_vary(cli_case *c, int number, const char *name, double value);
cli_exit cli_case_settle_again(cli_case *c);

/* 1: transient rolling or a static history. */
int cli_case_has_steps(const cli_case *c);

/* A table of two columns.  CLI_CONTINUE or an exit code, its line printed. */
cli_exit cli_read_pairs(const char *path, rb_io_table *t);

/* Prints why the library refused the case; the exit code tells command line from file. */
cli_exit cli_case_refused(const cli_case *c, rb_status s, const rb_message *why);

/* Every value used, defaults included. */
struct json_t *cli_case_inputs(const cli_case *c);

#endif
