/* Tables, folders and files as the rooms use them, besides the readers of rollbem/io.h. */
#ifndef ROLLBEM_SRC_BASE_IO_IO_H
#define ROLLBEM_SRC_BASE_IO_IO_H

#include "base/base.h"
#include "base/sparse.h"
#include "base/units.h"
#include "rollbem/io.h"

#include <stdio.h>

/* ---- Output files, written completely or not at all ----------------------------- */

/* Output goes to an unnamed file in the folder of the target; commit gives it the
 * target's name.  If the program ends before, no partial file is left. */
typedef struct {
    FILE *file;   /* write to this file; NULL when closed */
    char *target; /* path of a file; owned */
    char *device; /* path of a device, which is written directly; owned.  Both NULL:
                     stdout */
} rb_io_writer;

/* path NULL or "-": stdout.  An existing target keeps its permissions; links are
 * followed; a device or pipe is written directly.  RB_EWRITE with the reason,
 * RB_ENOMEM. */
rb_status rb_io_writer_open(const char *path, rb_io_writer *w, rb_message *why);

/* Returns what rb_io_writer_open would return, without changing anything. */
rb_status rb_io_writer_check(const char *path, rb_message *why);

/* Makes the complete target visible and closes w.  On RB_EWRITE (disk full, ...) no file
 * is left, and an old target is unchanged. */
rb_status rb_io_writer_commit(rb_io_writer *w, rb_message *why);

/* Discards the output; w may be closed already. */
void rb_io_writer_abandon(rb_io_writer *w);

/* The path of `name` in a folder; owned by the caller, NULL: no memory. */
char *rb_io_join(const char *folder, const char *name);
/* Makes the folder unless it exists.  RB_EWRITE, RB_ENOMEM. */
rb_status rb_io_make_folder(const char *path, rb_message *why);
/* Checks that rb_io_make_folder, and writing a file in the folder, would succeed; makes
 * nothing. */
rb_status rb_io_folder_check(const char *path, rb_message *why);

/* Reads an input file into a text that ends with a zero byte; owned by the caller.
 * RB_ENOENT; RB_EFORMAT: UTF-16, a zero byte in the file, a device other than a terminal
 * or /dev/null, more than 2 GB (of a pipe 256 MB); RB_ENOMEM. */
rb_status rb_io_read_text(const char *path, char **text, size_t *size, rb_message *why);
/* The same for a table that a spreadsheet may have written: UTF-16 with a byte-order mark
 * becomes UTF-8. */
rb_status rb_io_read_spreadsheet(const char *path, char **text, size_t *size, rb_message *why);

/* Checks a path that comes from an untrusted file.  RB_EFORMAT unless path is a regular
 * file of at most 64 MB and, after links are followed, lies in the folder or below it
 * (NULL: anywhere); RB_ENOENT.  It gives no protection if files are changed at the same
 * time. */
rb_status rb_io_check_harmless(const char *path, const char *folder, rb_message *why);

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

/* As rb_io_table_read, of a text that has already been read from path; the function changes the
 * text. */
rb_status rb_io_table_parse(const char *path, char *text, rb_io_table *t, rb_message *why);
/* As rb_io_table_read, of a table whose cells may be words.  Blanks are then part of a cell where
 * tabs, commas or semicolons separate the cells. */
rb_status rb_io_table_read_words(const char *path, rb_io_table *t, rb_message *why);
/* The `rows` numbers of a column of exactly this name; NULL if there is none. */
const double *rb_io_table_column(const rb_io_table *t, const char *name);

/* A column that a reader knows. */
typedef struct {
    const char *name; /* NULL: any other column; then it is the last one, and unused */
    const char *also; /* other names that people give it, "clearance|separation"; NULL */
    const char *unit; /* in mm, N, MPa (rollbem/units.h) */
    enum {
        RB_IO_COLUMN_NEEDED,
        RB_IO_COLUMN_OPTIONAL,
        RB_IO_COLUMN_UNUSED /* known, and not read */
    } need;
} rb_io_column;

/* 1: a heading is this column, with whatever unit. */
int rb_io_table_has(const rb_io_table *t, const rb_io_column *known);
/* Finds n known columns by their headings (rb_unit_of_heading) and converts them from the
 * unit in the heading, else from that of the system, to `unit`; without names the columns
 * are the n known ones in their order.  x[k]: rows numbers in t, or NULL.  RB_EFORMAT: a
 * heading that is none of them, or has no unit of its quantity; one is missing, or two are
 * the same; why names it. */
rb_status rb_io_table_assign(const char *path, rb_io_table *t, int n, const rb_io_column *known,
                             rb_units system, const double **x, rb_message *why);

/* Tokens separated by white space; matrices dense, by blocks, or as CSparse prints them.
 * Errors of all readers: RB_ENOENT; RB_EFORMAT, also for NaN, infinity and counts too
 * large for the file; why names file, line, what was expected and what was found;
 * RB_ENOMEM.  After an error the problem is empty. */

/* ---- Text format of Siconos ------------------------------------------------------- */

typedef enum {
    RB_IO_SICONOS_LCP,
    RB_IO_SICONOS_FRICTION,
    RB_IO_SICONOS_SOCLCP,
    RB_IO_SICONOS_FRICTION_GLOBAL,
    RB_IO_SICONOS_ROLLING, /* rolling friction in 3D, and a mixed LCP: there is no reader */
    RB_IO_SICONOS_MIXED
} rb_io_siconos_kind;

/* Guesses the kind from the sizes at the beginning of the file.  Some files are
 * ambiguous: one contact of d rows looks like one cone of d rows and is read as friction.
 * A global friction problem with as many degrees of freedom as contact rows is read as a
 * local one; with d degrees of freedom it is read as cones. */
rb_status rb_io_siconos_guess(const char *path, rb_io_siconos_kind *kind, rb_message *why);

/* Reads such a file.  RB_ENOENT, RB_EFORMAT, RB_ENOMEM. */
rb_status rb_io_siconos_read_lcp(const char *path, rb_io_lcp *p, rb_message *why);

/* ---- Linear complementarity problems of any kind ----------------------------------- */

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

/* local: u = W r + q.  global: M v = H r + f, u = H' v + w; in the file f is named q and w
 * is named b.  [N, T] or [N, T1, T2] per contact. */
typedef struct {
    int global;
    int dimension, contacts;
    rb_io_matrix W;    /* local */
    rb_io_matrix M, H; /* global: n x n; n x dimension * contacts */
    double *q, *f, *w; /* dimension * contacts, but f: n */
    double *mu;        /* contacts */
} rb_io_friction;

rb_status rb_io_siconos_read_friction(const char *path, int global, rb_io_friction *p,
                                      rb_message *why);
void rb_io_friction_free(rb_io_friction *p);

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

#endif
