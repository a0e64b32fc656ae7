/* File formats.  These functions read and write names and numbers; mechanics does not
 * appear here.  Messages name the file and the line. */
#ifndef ROLLBEM_IO_H
#define ROLLBEM_IO_H

#include "rollbem/base.h"
#include "rollbem/sparse.h"

RB_PUBLIC_BEGIN

/* ---- Matrices ---------------------------------------------------------------------- */

/* A matrix as stored in a file: dense, or in coordinate form. */
typedef struct {
    int rows, cols;
    double *dense; /* rows x cols column-major, or NULL; owned */
    rb_triplets entries;
} rb_io_matrix;

void rb_io_matrix_free(rb_io_matrix *m);
/* Converts m to dense form; its coordinate entries are freed.  RB_ENOMEM. */
rb_status rb_io_matrix_to_dense(rb_io_matrix *m);
/* A copy in compressed columns; zeros of a dense matrix are left out.  RB_ENOMEM. */
rb_status rb_io_matrix_to_sparse(const rb_io_matrix *m, rb_sparse *a);

/* A borrowed dense matrix, column-major, ld >= rows. */
typedef struct {
    int rows, cols;
    const double *x;
    int ld;
} rb_io_dense;

/* Writes Matrix Market "array real general" with 17 digits, so that the same numbers are
 * read again. comment (NULL: none): one line.  RB_EINVAL, RB_EWRITE, RB_ENOMEM. */
rb_status rb_io_matrix_market_write(const char *path, rb_io_dense m, const char *comment,
                                    rb_message *why);
/* Reads "array" or "coordinate", "real" or "integer", "general" or "symmetric" (m then
 * has both triangles).  RB_ENOENT, RB_EFORMAT, RB_ENOMEM. */
rb_status rb_io_matrix_market_read(const char *path, rb_io_matrix *m, rb_message *why);

/* ---- Text format of Siconos ------------------------------------------------------- */

/* w = M z + q.  Words after q in the file are a comment; numbers are refused. */
typedef struct {
    int n;
    rb_io_matrix M;
    double *q; /* n */
} rb_io_lcp;

void rb_io_lcp_free(rb_io_lcp *p);

/* ---- Linear complementarity problems of any kind ----------------------------------- */

/* Reads the text format of Siconos, or plain text (n, the rows of M, q), or M in Matrix
 * Market with q in the file q_path; for the other formats q_path is NULL.  # starts a
 * comment.  "-": standard input.  RB_ENOENT, RB_EFORMAT, RB_ENOMEM. */
rb_status rb_io_lcp_read(const char *path, const char *q_path, rb_io_lcp *p, rb_message *why);

RB_PUBLIC_END

#endif
