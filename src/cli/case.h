/* A case as the command line and case files give it: shared by the commands that solve.
 */
#ifndef ROLLBEM_CLI_CASE_H
#define ROLLBEM_CLI_CASE_H

#include "cli/cli.h"

enum { CLI_CASE_OPTIONS_MAX = 48 };

typedef struct {
    rb_rolling_case rc;
    const char *gap_file; /* profile of the initial gap, or NULL */
    int similar;          /* B is of A's material */
    double young_b, poisson_b, radius_b;

    char path[320]; /* case file, "" without */
    int given[CLI_CASE_OPTIONS_MAX];
    double *profile; /* x, then gap; owned */
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

/* Prints why the library refused the case; the exit code tells command line from file. */
cli_exit cli_case_refused(const cli_case *c, rb_status s, const rb_message *why);

/* Every value used, defaults included. */
struct json_t *cli_case_inputs(const cli_case *c);

#endif
