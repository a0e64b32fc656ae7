/* File formats.  These functions read and write names and numbers; mechanics does not
 * appear here.  Messages name the file and the line. */
#ifndef ROLLBEM_IO_H
#define ROLLBEM_IO_H

#include "rollbem/base.h"
#include "rollbem/sparse.h"

#include <stdio.h>

RB_PUBLIC_BEGIN

/* ---- Tables of numbers ------------------------------------------------------------- */

/* A row per line, of numbers between blanks, tabs or commas, or as spreadsheets write them:
 * between semicolons, with decimal commas where semicolons, tabs or blanks separate the
 * numbers, in double quotes, with a byte-order mark, in UTF-16.  # starts a comment.  A
 * first line of words names the columns, and a second one may have their units; or the last
 * comment before the first row names them, if it has as many words.  A cell of a named
 * column that is empty or "NaN" has the number NAN. */
typedef struct {
    int rows, columns;
    char **name;          /* columns; NULL: the file does not name them; owned, like all arrays
                             here */
    int named_by_comment; /* 1: name is the last comment, which may be any comment */
    double *x;            /* rows x columns, column-major */
    char **word;          /* the same of cells that are words, whose number is NAN; NULL where a
                             cell is a number; NULL: all are */
    int *line;            /* rows: line number of each row in the file */
} rb_io_table;

/* RB_ENOENT; RB_EFORMAT: the count of numbers differs from the first row or from the
 * names, something is not a number, decimals have commas and points, a name occurs twice,
 * or there is no row; why names file, line and what was expected.  RB_ENOMEM.  t is
 * overwritten and is empty after an error. */
rb_status rb_io_table_read(const char *path, rb_io_table *t, rb_message *why);

void rb_io_table_free(rb_io_table *t);

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
/* n numbers in plain text or a Matrix Market matrix of n by 1; `what` names them in
 * messages.  x: owned by the caller, NULL after a failure.  Errors as above. */
rb_status rb_io_vector_read(const char *path, int n, const char *what, double **x, rb_message *why);

/* The same for bounds: inf and -inf are numbers, too. */
rb_status rb_io_bounds_read(const char *path, int n, const char *what, double **x, rb_message *why);

/* A bimatrix game: m, n, the m rows of A, the m rows of B.  # starts a comment. */
typedef struct {
    int m, n;
    double *A, *B; /* m x n column-major: payoffs of the row and of the column player */
} rb_io_bimatrix;

/* As rb_io_lcp_read. */
rb_status rb_io_bimatrix_read(const char *path, rb_io_bimatrix *p, rb_message *why);
void rb_io_bimatrix_free(rb_io_bimatrix *p);

RB_PUBLIC_END

#endif
