/* The commands described for other programs, from the option tables. */
#ifndef ROLLBEM_CLI_DESCRIBE_H
#define ROLLBEM_CLI_DESCRIBE_H

#include "program/cli/cli.h"

/* The command of spec on stdout as "man" (troff), "markdown", or its part of the
 * completion of "bash", "zsh" or "fish"; "results": the tables of results
 * in markdown; "schema": what --json prints.  CLI_CONTINUE: no such form. */
cli_exit cli_describe(const cli_spec *spec, const char *form);
/* The whole completion of a shell.  CLI_CONTINUE: no such shell. */
cli_exit cli_complete(const char *shell);

#endif
