/* Operands that can be read once, by commands that read a file more than once. */
#ifndef ROLLBEM_CLI_SPOOL_H
#define ROLLBEM_CLI_SPOOL_H

#include "rollbem/base.h"

typedef struct {
    const char *name; /* the operand; borrowed */
    char path[300];   /* its copy; "": the operand is a file */
    int fd;           /* of the copy; -1: none */
    int is_named;     /* 1: the copy has a name, for HDF5, which opens no other */
} cli_spool;

/* Copies what a pipe or standard input ("-") gives, so that it can be read again.  A file is left
 * alone.  RB_ENOENT, RB_EWRITE; end it in any case. */
rb_status cli_spool_begin(const char *name, cli_spool *s, rb_message *why);
/* What is to be opened. */
const char *cli_spool_path(const cli_spool *s);
/* Puts the operand's name in the place of its copy's at the beginning of a message. */
void cli_spool_rename(const cli_spool *s, rb_message *why);
void cli_spool_end(cli_spool *s);

#endif
