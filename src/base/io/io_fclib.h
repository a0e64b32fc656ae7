/* The FCLib format (HDF5): frictional contact problems as numbers; no mechanics here.
 * HDF5 runs in a child process (fork); if it crashes for lack of memory or because of a
 * damaged file, these calls return RB_ENOMEM.  A file cannot make HDF5 read other files:
 * external and symbolic links, raw data and virtual arrays are refused, and no filter is
 * loaded.  Reading needs at most 16 * 1032 times the size of the file (deflate compresses
 * by a factor of at most 1032). */
#ifndef ROLLBEM_IO_FCLIB_H
#define ROLLBEM_IO_FCLIB_H

#include "base/base.h"
#include "base/sparse.h"

/* local:  u = W r + q.   global:  M v = H r + f,  u = H' v + w.
 * [N, T] or [N, T1, T2] per contact.  With bilateral constraints of forces l:
 * local:  u = W r + V l + q,  V' r + R l + s = 0.   global:  M v = H r + G l + f,
 * G' v + b = 0.  Rolling friction, global only: spacedim 5, [N, T1, T2, M1, M2] per
 * contact, ||m|| <= mu_r r_N. */
typedef struct {
    int global;   /* 0: W, q;  1: M, H, f, w */
    int rolling;  /* 1: with mu_r */
    int spacedim; /* 2 or 3; 5 where rolling */
    int contacts;
    int constraints; /* number of columns of G, or of V and R; 0: none */
    rb_sparse W;     /* all owned */
    rb_sparse M, H;
    rb_sparse G, V, R;
    double *q, *f, *w, *mu;
    double *b, *s;     /* constraints, or NULL */
    double *mu_r;      /* contacts, or NULL */
    double *r, *u, *v; /* the solution stored in the file, not checked; or NULL */
} rb_io_fclib;

/* The three layouts of a matrix. */
typedef enum { RB_IO_FCLIB_TRIPLET, RB_IO_FCLIB_CSC, RB_IO_FCLIB_CSR } rb_io_fclib_layout;

void rb_io_fclib_free(rb_io_fclib *problem);

/* 1: the file begins with the signature of HDF5. */
int rb_io_is_hdf5(const char *path);

/* If only one triangle of M or R is stored, the other one is added.  RB_ENOENT;
 * RB_EFORMAT: not HDF5, truncated, no FCLib problem, inconsistent sizes, indices out of
 * range, or rolling friction in the local form; why names the place. */
rb_status rb_io_fclib_read(const char *path, rb_io_fclib *problem, rb_message *why);

/* title and description may be NULL.  The file is written completely or not at all
 * (io.h). RB_EWRITE, RB_ENOMEM. */
rb_status rb_io_fclib_write(const char *path, const rb_io_fclib *problem, rb_io_fclib_layout layout,
                            const char *title, const char *description, rb_message *why);

#endif
