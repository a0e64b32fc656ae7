/* Status codes, messages, memory and time: the part that all folders of rollbem share. */
#ifndef ROLLBEM_BASE_H
#define ROLLBEM_BASE_H

#include <stddef.h>
#include <stdint.h>

/* These macros enclose the declarations of every public header.  They give the functions
 * C linkage in C++ and export them from the shared library, which exports nothing
 * else. */
#ifdef __cplusplus
#define RB_EXTERN_C_BEGIN extern "C" {
#define RB_EXTERN_C_END }
#else
#define RB_EXTERN_C_BEGIN
#define RB_EXTERN_C_END
#endif
#ifdef __GNUC__
#define RB_PUBLIC_BEGIN RB_EXTERN_C_BEGIN _Pragma("GCC visibility push(default)")
#define RB_PUBLIC_END _Pragma("GCC visibility pop") RB_EXTERN_C_END
#else
#define RB_PUBLIC_BEGIN RB_EXTERN_C_BEGIN
#define RB_PUBLIC_END RB_EXTERN_C_END
#endif

RB_PUBLIC_BEGIN

#define RB_VERSION "0.1.0"
/* Version of the library that is linked or loaded; it may differ from RB_VERSION of the
 * header. */
const char *rb_version(void);

/* Negative: the call did not run (misuse, memory, files).
 * Positive: it ran and ended without a full answer; the last iterate is kept. */
typedef enum {
    RB_OK = 0,
    RB_EINVAL = -1,  /* an argument out of its range */
    RB_ENOMEM = -2,  /* no memory */
    RB_ENOENT = -3,  /* no such input file */
    RB_EFORMAT = -4, /* a file whose content is not in the expected format */
    RB_EWRITE = -5,  /* an output that cannot be written */
    RB_EHELPER = -6, /* another program is missing or has failed */
    RB_MAXITER = 1,  /* iteration limit */
    RB_RAY = 2,      /* Lemke: secondary ray, which proves nothing */
    RB_SINGULAR = 3, /* the matrix is singular */
    RB_NO_CONTACT = 4,
    RB_ZONE = 5,       /* potential contact too small: it fills completely */
    RB_INACCURATE = 6, /* residual above the tolerance */
    RB_INTERRUPTED = 7,
    RB_NO_SOLUTION = 8, /* proved: there is none */
    RB_UNDECIDED = 9,   /* none was found, and none is excluded */
    RB_NUMERICAL = 10,  /* rounding errors: there is a solution, or may be one */
    RB_TIME_LIMIT = 11  /* the time that the caller allows is over */
} rb_status;

/* One line for people: what, where, what was wanted.  Callers may pass NULL. */
typedef struct {
    char text[640];
    char about[64]; /* options that the line speaks of, "zone" or "contact-elements,mesh", the wrong
                       one first; "": of none */
    int row;        /* of the table that this option names, from 1; 0: of none */
    int rest;       /* where in the text the words behind the name, and the row, begin */
} rb_message;

/* All computations use mm, N, MPa and s, and options and results name their units in this system;
 * other units are converted on input and output. */
typedef enum {
    RB_UNITS_MM,  /* mm, N, MPa */
    RB_UNITS_SI,  /* m, N, Pa */
    RB_UNITS_INCH /* in, lbf, psi */
} rb_units;

/* "solved", "secondary ray", ...: static text. */
const char *rb_status_text(rb_status s);

/* What long computations ask every few milliseconds; once it does not return 0 they end with
 * RB_INTERRUPTED.  It must be quick.  asked NULL: nothing is asked. */
typedef struct {
    int (*asked)(void *context);
    void *context;
} rb_interrupt;
/* From now on the computations of this thread ask `next`.  Returns what they have asked so
 * far; at first that is nothing. */
rb_interrupt rb_interrupt_by(rb_interrupt next);

/* Memory of several arrays that is freed at once: opaque. */
typedef struct {
    int failed;                 /* 1: an array could not be allocated */
    union rb_arena_block *last; /* of a list of all arrays; owned */
} rb_arena;

/* Sets the number of BLAS threads (0: one per processor, or the value of
 * OPENBLAS_NUM_THREADS) and returns the number before.  The small matrix products of
 * Lemke's and Newton's methods are faster with one thread. */
int rb_blas_threads(int threads);

/* The name of faster kernels of OpenBLAS that this processor can run although OpenBLAS did
 * not choose them; NULL: there are none.  An OpenBLAS that is older than the processor may
 * not recognise it (0.3.21 chooses kernels of 2004 on a server of 2023, which are four times
 * slower).  The name is a value for the environment variable OPENBLAS_CORETYPE, which
 * OpenBLAS reads when it is loaded. */
const char *rb_blas_better_core(void);

RB_PUBLIC_END

#endif
