/* The commands described for other programs, from the option tables. */
#ifndef ROLLBEM_CLI_DESCRIBE_H
#define ROLLBEM_CLI_DESCRIBE_H

#include "cli/cli.h"

/* The command of spec on stdout as "man" (troff), "markdown", or its part of the
 * completion of "bash", "zsh" or "fish"; "results": the tables of results
 * in markdown; "schema": what --json prints.  0: no such form. */
int cli_describe(const cli_spec *spec, const char *form);
/* The whole completion of a shell.  0: no such shell. */
int cli_complete(const char *shell);

#endif
