/* rollbem help WORD. */
#ifndef ROLLBEM_CLI_FIND_H
#define ROLLBEM_CLI_FIND_H

#include "program/cli/cli.h"

/* Prints what speaks of all n words; the exit code. */
int cli_find(int n, char **words);
/* What an option is called here that others call so; NULL: nothing is known. */
const char *cli_other_name(const char *name, size_t length);

/* The part of a command, which answers --describe=search by it: its options. */
void cli_find_options(const cli_spec *spec);

/* The commands that have an option of this name, as "rollbem, rollbem sweep", three at
 * most; static storage; empty: none has. */
const char *cli_commands_with(const char *name, size_t length);
/* Adds the command to them (--describe=holder). */
void cli_find_holder(const cli_spec *spec);

#endif
