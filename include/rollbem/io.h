/* File formats: names and numbers only, nothing of mechanics.  Messages name the file and
 * the line. */
#ifndef ROLLBEM_IO_H
#define ROLLBEM_IO_H

#include "rollbem/base.h"
#include "rollbem/sparse.h"
#include "rollbem/units.h"

#include <stdio.h>

RB_PUBLIC_BEGIN

/* ---- Output written whole or not at all ------------------------------------------- */

/* Everything goes to a file beside the target that has no name; commit names it.  So
 * nothing is left behind, whatever ends the program. */
typedef struct {
    FILE *file;   /* write here; NULL when closed */
    char *target; /* of a file; owned */
    char *device; /* its name, written directly; owned.  Both NULL: stdout */
} rb_io_writer;

/* path NULL or "-": stdout.  An existing target keeps its mode; a link is followed; a
 * device or pipe is written directly.  RB_EWRITE with the reason, RB_ENOMEM. */
rb_status rb_io_writer_open(const char *path, rb_io_writer *w, rb_message *why);

/* What rb_io_writer_open would say; the path stays as it is. */
rb_status rb_io_writer_check(const char *path, rb_message *why);

/* The target appears with its whole content.  On RB_EWRITE (disk full, ...) nothing is
 * left behind and an old target is untouched.  Either way w is closed. */
rb_status rb_io_writer_commit(rb_io_writer *w, rb_message *why);

/* Nothing appears; w may be closed already. */
void rb_io_writer_abandon(rb_io_writer *w);

/* The path of `name` in a folder; owned by the caller, NULL: no memory. */
char *rb_io_join(const char *folder, const char *name);
/* Makes the folder unless it is there.  RB_EWRITE, RB_ENOMEM. */
rb_status rb_io_make_folder(const char *path, rb_message *why);
/* What rb_io_make_folder and a file in the folder would say; nothing is made. */
rb_status rb_io_folder_check(const char *path, rb_message *why);

/* The text of an input file and a zero behind it; owned by the caller.  RB_ENOENT;
 * RB_EFORMAT: UTF-16, or a zero byte in it; a device other than a terminal or /dev/null;
 * more than 2 GB, of a pipe 256 MB; RB_ENOMEM. */
rb_status rb_io_read_text(const char *path, char **text, size_t *size, rb_message *why);

/* For paths that come from somebody else's file.  RB_EFORMAT unless path is a regular
 * file of at most 64 MB and lies, links followed, below the folder (NULL: anywhere);
 * RB_ENOENT.  Not against somebody who changes files meanwhile. */
rb_status rb_io_check_harmless(const char *path, const char *folder, rb_message *why);

/* ---- Tables of numbers ------------------------------------------------------------- */

/* Numbers between blanks or commas, a row per line; # starts a comment.  The columns are
 * named by a first line of words or by the last comment before the first row. */
typedef struct {
    int rows, columns;
    char **name; /* columns; NULL: the file does not name them; owned, as all here */
    double *x;   /* rows x columns, column-major */
    int *line;   /* rows: where each stands in the file */
} rb_io_table;

/* RB_ENOENT; RB_EFORMAT with file, line and what was wanted: another count of numbers
 * than in the first row or than names, not a number, a name twice, no row; RB_ENOMEM.
 * t: overwritten, empty after a failure. */
rb_status rb_io_table_read(const char *path, rb_io_table *t, rb_message *why);
/* The same of a text that was read from path already; its lines are cut apart. */
rb_status rb_io_table_parse(const char *path, char *text, rb_io_table *t,
                            rb_message *why);
/* The same for a table of exactly that many columns. */
rb_status rb_io_table_expect_columns(const char *path, int columns, rb_io_table *t,
                                     rb_message *why);
rb_status rb_io_table_read_columns(const char *path, int columns, rb_io_table *t,
                                   rb_message *why);
/* rows numbers; NULL when there is no such column. */
const double *rb_io_table_column(const rb_io_table *t, const char *name);
/* Column j, a quantity of that unit (rollbem/units.h), to mm, N, MPa: from the unit that
 * its name ends with, which is cut off, else from those of the system. */
void rb_io_table_convert(rb_io_table *t, int j, const char *unit, rb_units system);
void rb_io_table_free(rb_io_table *t);

/* ---- Matrices ---------------------------------------------------------------------- */

/* As a file has it: dense, or in coordinate form. */
typedef struct {
    int rows, cols;
    double *dense; /* rows x cols column-major, or NULL; owned */
    rb_triplets entries;
} rb_io_matrix;

void rb_io_matrix_free(rb_io_matrix *m);
/* Afterwards m->dense is there and the entries are gone.  RB_ENOMEM. */
rb_status rb_io_matrix_to_dense(rb_io_matrix *m);
/* A copy in compressed columns; zeros of a dense matrix are left out.  RB_ENOMEM. */
rb_status rb_io_matrix_to_sparse(const rb_io_matrix *m, rb_sparse *a);

/* A dense matrix of somebody else: column-major, ld >= rows. */
typedef struct {
    int rows, cols;
    const double *x;
    int ld;
} rb_io_dense;

/* Matrix Market, "array real general": 17 digits, so that reading gives the same numbers.
 * comment (NULL: none): one line.  RB_EINVAL, RB_EWRITE, RB_ENOMEM. */
rb_status rb_io_matrix_market_write(const char *path, rb_io_dense m, const char *comment,
                                    rb_message *why);
/* "array" or "coordinate", "real" or "integer", "general" or "symmetric" (both triangles
 * are in m).  RB_ENOENT, RB_EFORMAT, RB_ENOMEM. */
rb_status rb_io_matrix_market_read(const char *path, rb_io_matrix *m, rb_message *why);

/* ---- Text format of Siconos ------------------------------------------------------- */

/* Tokens separated by white space; matrices dense, by blocks, or as CSparse prints them.
 * All readers: RB_ENOENT; RB_EFORMAT with file, line, what was expected and what is there
 * (also NaN, infinity, and counts that the file has no room for); RB_ENOMEM.  After a
 * failure the problem is empty. */

typedef enum {
    RB_IO_SICONOS_LCP,
    RB_IO_SICONOS_FRICTION,
    RB_IO_SICONOS_SOCLCP,
    RB_IO_SICONOS_FRICTION_GLOBAL
} rb_io_siconos_kind;

/* The kind, from the sizes at the head.  A single contact of d rows looks like a single
 * cone of d rows: it is taken for friction.  A global friction problem with as many
 * degrees of freedom as rows of contacts is taken for a local one, with d of them for
 * cones. */
rb_status rb_io_siconos_guess(const char *path, rb_io_siconos_kind *kind,
                              rb_message *why);

/* w = M z + q.  What follows q in the file is a comment. */
typedef struct {
    int n;
    rb_io_matrix M;
    double *q; /* n */
} rb_io_lcp;

rb_status rb_io_siconos_read_lcp(const char *path, rb_io_lcp *p, rb_message *why);
void rb_io_lcp_free(rb_io_lcp *p);

/* ---- Linear complementarity problems of any kind ----------------------------------- */

/* The text format of Siconos; plain text: n, the rows of M, q; or M in Matrix Market with
 * q in a file of its own, which is NULL otherwise.  Behind a # stands a comment.  "-":
 * standard input.  RB_ENOENT, RB_EFORMAT, RB_ENOMEM. */
rb_status rb_io_lcp_read(const char *path, const char *q_path, rb_io_lcp *p,
                         rb_message *why);
/* n numbers in plain text or a Matrix Market matrix of n by 1; `what` names them in
 * messages.  x: owned by the caller, NULL after a failure.  Errors as above. */
rb_status rb_io_vector_read(const char *path, int n, const char *what, double **x,
                            rb_message *why);

/* The same for bounds: inf and -inf are numbers, too. */
rb_status rb_io_bounds_read(const char *path, int n, const char *what, double **x,
                            rb_message *why);

/* A bimatrix game: m, n, the m rows of A, the m rows of B.  Behind a # stands a comment.
 */
typedef struct {
    int m, n;
    double *A, *B; /* m x n column-major: payoffs of the row and of the column player */
} rb_io_bimatrix;

/* As rb_io_lcp_read. */
rb_status rb_io_bimatrix_read(const char *path, rb_io_bimatrix *p, rb_message *why);
void rb_io_bimatrix_free(rb_io_bimatrix *p);

/* u = W r + q, per contact [N, T] or [N, T1, T2]. */
typedef struct {
    int dimension, contacts;
    rb_io_matrix W;
    double *q;  /* dimension * contacts */
    double *mu; /* contacts */
} rb_io_friction;

rb_status rb_io_siconos_read_friction(const char *path, rb_io_friction *p,
                                      rb_message *why);
void rb_io_friction_free(rb_io_friction *p);

/* M v = H r + f, u = H' v + w; the file calls f q and w b. */
typedef struct {
    int dimension, contacts;
    rb_io_matrix M, H; /* n x n; n x dimension * contacts */
    double *f, *w, *mu;
} rb_io_friction_global;

rb_status rb_io_siconos_read_friction_global(const char *path, rb_io_friction_global *p,
                                             rb_message *why);
void rb_io_friction_global_free(rb_io_friction_global *p);

/* Cone k: rows start[k] ... start[k + 1] - 1, slope tau[k]. */
typedef struct {
    int n, cones;
    rb_io_matrix M;
    double *q;   /* n */
    int *start;  /* cones + 1 */
    double *tau; /* cones */
} rb_io_soclcp;

rb_status rb_io_siconos_read_soclcp(const char *path, rb_io_soclcp *p, rb_message *why);
void rb_io_soclcp_free(rb_io_soclcp *p);

RB_PUBLIC_END

#endif
