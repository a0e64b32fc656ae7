/* Readers that go on from an open text: for files whose kind is told by their head.
 * Failures are in the text's status.  Private to the folder io. */
#ifndef IO_READERS_H
#define IO_READERS_H

#include "base/io/tokens.h"
#include "base/io/io.h"

/* A whole Matrix Market file. */
void rb_io_read_matrix_market(io_tokens *t, rb_io_matrix *m);

/* The format of Siconos: n, matrix, q.  Words behind q are a comment, numbers are not: those of a
 * relay problem are named. */
void rb_io_read_siconos_lcp(io_tokens *t, rb_io_lcp *p);
/* The kind of problem that the sizes at the head are of, or -1. */
int rb_io_siconos_kind_at(io_tokens *t);

#endif
