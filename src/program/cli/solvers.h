/* The friction solvers in the commands that take them by name. */
#ifndef ROLLBEM_CLI_SOLVERS_H
#define ROLLBEM_CLI_SOLVERS_H

#include "program/cli/cli.h"
#include "lcp/friction/friction.h"

/* CLI_CONTINUE and the solver, or CLI_USAGE after a line that names the option and what
 * may have been meant. */
cli_exit cli_friction_solver(const char *option, const char *name,
                             const rb_friction_solver **solver);

/* One line per solver, for --help; text: of that size, written from its start. */
void cli_friction_solver_lines(char *text, size_t size);

/* Which error of a friction problem decides that it is solved. */
extern const rb_choice cli_friction_measures[];

#endif
