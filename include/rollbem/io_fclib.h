/* The FCLib format (HDF5): frictional contact problems as numbers; no mechanics here.
 * HDF5 runs in a process of its own (fork): where it crashes, for want of memory or on a
 * damaged file, these calls return RB_ENOMEM.  Of other files nothing is read: external
 * and symbolic links, raw data and virtual arrays are refused, and no filter is loaded.
 * Reading takes at most 16 * 1032 times the memory of the file (1032: what deflate packs
 * into a byte). */
#ifndef ROLLBEM_IO_FCLIB_H
#define ROLLBEM_IO_FCLIB_H

#include "rollbem/base.h"
#include "rollbem/sparse.h"

RB_PUBLIC_BEGIN

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
    int constraints; /* 0: none; else the columns of G, or of V and R */
    rb_sparse W;     /* all owned */
    rb_sparse M, H;
    rb_sparse G, V, R;
    double *q, *f, *w, *mu;
    double *b, *s;     /* constraints, or NULL */
    double *mu_r;      /* contacts, or NULL */
    double *r, *u, *v; /* what the file holds as solution, or NULL: check it before use */
} rb_io_fclib;

/* The three layouts of a matrix. */
typedef enum { RB_IO_FCLIB_TRIPLET, RB_IO_FCLIB_CSC, RB_IO_FCLIB_CSR } rb_io_fclib_layout;

void rb_io_fclib_free(rb_io_fclib *problem);

/* 1: the file begins like HDF5. */
int rb_io_is_hdf5(const char *path);

/* An M or R of which only one triangle is stored is completed.  RB_ENOENT; RB_EFORMAT,
 * with the place in why: not HDF5, truncated, no FCLib problem in it, sizes that
 * disagree, indices out of range, rolling friction in the local form. */
rb_status rb_io_fclib_read(const char *path, rb_io_fclib *problem, rb_message *why);

/* title and description may be NULL.  The file appears whole or not at all (io.h).
 * RB_EWRITE, RB_ENOMEM. */
rb_status rb_io_fclib_write(const char *path, const rb_io_fclib *problem,
                            rb_io_fclib_layout layout, const char *title,
                            const char *description, rb_message *why);

RB_PUBLIC_END

#endif
