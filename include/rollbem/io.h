/* File formats: names and numbers only, nothing of mechanics.  Messages name the file and
 * the line. */
#ifndef ROLLBEM_IO_H
#define ROLLBEM_IO_H

#include "rollbem/base.h"

#include <stdio.h>

/* ---- Output written whole or not at all ------------------------------------------- */

/* Everything goes to a temporary file beside the target; commit renames it. */
typedef struct {
    FILE *file;               /* write here; NULL when closed */
    char *temporary, *target; /* owned; NULL for stdout and for devices */
} rb_io_writer;

/* path NULL or "-": stdout.  An existing target keeps its mode; a link is followed; a
 * device or pipe is written directly.  RB_EWRITE with the reason, RB_ENOMEM. */
rb_status rb_io_writer_open(const char *path, rb_io_writer *w, rb_message *why);

/* The target appears with its whole content.  On RB_EWRITE (disk full, ...) nothing is
 * left behind and an old target is untouched.  Either way w is closed. */
rb_status rb_io_writer_commit(rb_io_writer *w, rb_message *why);

/* Removes what was written; w may be closed already. */
void rb_io_writer_abandon(rb_io_writer *w);

/* ---- Tables of numbers ------------------------------------------------------------- */

/* Rows of `columns` numbers between blanks or commas; # starts a comment.  x: *rows values of
 * the first column, then of the second, ...; owned by the caller.  RB_ENOENT; RB_EFORMAT:
 * another count of numbers, not a number, no row; RB_ENOMEM. */
rb_status rb_io_read_columns(const char *path, int columns, int *rows, double **x,
                             rb_message *why);

#endif
