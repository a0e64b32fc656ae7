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

/* Behind a declaration: argument f is a format of printf, those from number a on are what it
 * formats. */
#ifdef __GNUC__
#define RB_PRINTF(f, a) __attribute__((format(printf, f, a)))
#else
#define RB_PRINTF(f, a)
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
} rb_message;

/* One allowed word of an option, and the value (of an enum) that the word stands for. */
typedef struct {
    const char *name;
    int value;
} rb_choice;

/* Writes the formatted line into why (unless it is NULL) and returns s.  An error return
 * is then one statement: return rb_fail(why, RB_EINVAL, "mu = %g: expected >= 0", mu); */
rb_status rb_fail(rb_message *why, rb_status s, const char *format, ...) RB_PRINTF(3, 4);
/* x with six digits, towards zero: of the largest value that is accepted a message must not
 * print more. */
double rb_largest_shown(double x);

/* Appends to text, a buffer of size bytes in all; whatever does not fit is cut off. */
void rb_append(char *text, size_t size, const char *format, ...) RB_PRINTF(3, 4);

/* Copies the next word of a list with commas, as far as it fits.  Returns the rest of the list;
 * NULL: it is empty, or NULL. */
const char *rb_next_word(const char *list, char *word, size_t size);

/* "solved", "secondary ray", ...: static text. */
const char *rb_status_text(rb_status s);
/* The text of why, or that of s if why is NULL or empty. */
const char *rb_status_reason(rb_status s, const rb_message *why);
/* The status for LAPACK's info: RB_OK, RB_ENOMEM or RB_SINGULAR.  (LAPACKE refuses NaN
 * with a small negative number.) */
rb_status rb_lapack_status(int info);

/* Searches for the candidate nearest to a misspelt word.  Start with {.word = word} and
 * pass each candidate to rb_guess_try. */
typedef struct {
    const char *word, *best;
    int distance;
    char text[80];
} rb_guess;

void rb_guess_try(rb_guess *guess, const char *candidate);
/* " (did you mean '...'?)", or "" if no candidate is similar; prefix is put before the
 * word. Returns guess->text. */
const char *rb_guess_text(rb_guess *guess, const char *prefix);

/* Makes a file name or an argument safe to print: bytes that are not UTF-8 and control
 * characters become \xHH.  Writes at most size - 1 bytes and never a part of a character;
 * 4 strlen(text) + 1 bytes are always enough.  Returns to. */
char *rb_printable(const char *text, char *to, size_t size);

/* Writes a finite number with the fewest digits from which the same double is read again:
 * 0.3, 1e-09.  Returns text. */
enum { RB_NUMBER_TEXT = 32 };
char *rb_number_text(double x, char text[RB_NUMBER_TEXT]);
/* Between the two calls this thread reads and writes numbers in the C locale, with a
 * decimal point, whatever locale the calling program has set.  before: the value that
 * rb_locale_begin returned. */
void *rb_locale_begin(void);
void rb_locale_end(void *before);
/* strtod and snprintf in the C locale. */
double rb_read_number(const char *text, char **end);
int rb_format(char *text, size_t size, const char *format, ...) RB_PRINTF(3, 4);

/* For progress displays: rb_phase records the name of the computation that now runs
 * (static text), rb_phase_now returns the name recorded last by any thread of the
 * process, or NULL if there is none. */
void rb_phase(const char *what);
const char *rb_phase_now(void);

/* What long computations ask every few milliseconds; once it does not return 0 they end with
 * RB_INTERRUPTED.  It must be quick.  asked NULL: nothing is asked. */
typedef struct {
    int (*asked)(void *context);
    void *context;
} rb_interrupt;
/* From now on the computations of this thread ask `next`.  Returns what they have asked so
 * far; at first that is nothing. */
rb_interrupt rb_interrupt_by(rb_interrupt next);
/* The answer; 0 where nothing is asked.  A loop that may take long asks in every turn, on the
 * thread of its caller. */
int rb_interrupted(void);
/* The same in a parallel loop, whose threads share `stop`, 0 at first: 1 for all of them once
 * the caller's thread has got the answer. */
int rb_interrupted_in_loop(int *stop);

/* rows x cols doubles, or n ints, all zero; NULL when memory is short or the product
 * overflows.  Released with free(). */
double *rb_alloc(size_t rows, size_t cols);
int *rb_alloc_int(size_t n);
/* n doubles with the values of x; NULL when memory is short.  Released with free(). */
double *rb_copy(size_t n, const double *x);

/* The sign -1, 0 or 1 of sum a_i b_i, without rounding; RB_SIGN_UNKNOWN: a product is too
 * small or too large for that, or memory is short. */
enum { RB_SIGN_UNKNOWN = 2 };
int rb_exact_sign(size_t n, const double *a, const double *b);

/* Scratch memory: arrays that a function needs for itself.  It allocates all of them, asks
 * once whether there was memory, and returns rb_arena_done(...) at each exit, which frees
 * them and returns the status:
 *
 *     rb_arena scratch = {0};
 *     double *M = rb_arena_doubles(&scratch, n, n), *q = rb_arena_doubles(&scratch, n, 1);
 *     if (scratch.failed)
 *         return rb_arena_done(&scratch, RB_ENOMEM);
 *
 * A function that is handed an arena adds arrays to it and leaves freeing to the owner.
 * Once an allocation has failed, all later ones do.  Each array is a block of its own, so
 * that tools that watch memory see its ends.  One thread at a time. */
typedef struct {
    int failed;                 /* 1: an array could not be allocated */
    union rb_arena_block *last; /* of a list of all arrays; owned */
} rb_arena;

/* rows x cols doubles, n ints, or count things of a size, all zero; owned by the arena.
 * NULL when memory is short or the product overflows. */
double *rb_arena_doubles(rb_arena *arena, size_t rows, size_t cols);
int *rb_arena_ints(rb_arena *arena, size_t n);
void *rb_arena_zeros(rb_arena *arena, size_t count, size_t size);
/* Frees all arrays; the arena is empty again. */
void rb_arena_free(rb_arena *arena);
/* The same; returns s. */
rb_status rb_arena_done(rb_arena *arena, rb_status s);

/* Call it before a large allocation.  RB_EINVAL: the machine has less memory than bytes;
 * why then says how much `what` needs and how much there is. */
rb_status rb_memory_check(double bytes, const char *what, rb_message *why);

/* Seconds on a clock that only moves forward. */
double rb_seconds(void);

/* FNV-1a hash: start with RB_HASH_START and pass the returned value to the next call. */
#define RB_HASH_START UINT64_C(14695981039346656037)
uint64_t rb_hash(uint64_t hash, const void *data, size_t size);

/* max |x_i| over n; NaN if any entry is NaN. */
double rb_norm_inf(size_t n, const double *x);

/* sum |x_i| over n entries, each stride places after the one before.  cblas_dasum is not
 * used: with AVX-512 its last digits depend on the address of x, so that two runs would
 * differ. */
double rb_norm_1(size_t n, const double *x, size_t stride);

/* sum x_i y_i over n, in an order that does not depend on addresses. */
double rb_dot(size_t n, const double *x, const double *y);
/* ||x - y|| */
double rb_distance(size_t n, const double *x, const double *y);

/* Anderson's acceleration of a fixed-point iteration.  init: memory for m numbers, RB_ENOMEM; free
 * it in any case. */
#define RB_ANDERSON_DEPTH 5

typedef struct {
    int m, used, next;    /* number of stored differences, place of the next one */
    int known;            /* 1: there was a step before */
    double *f, *r, *u;    /* m: this step and its result; in the memory of f, like the
                             following arrays */
    double *df, *dr, *du; /* m x DEPTH */
    double size;          /* ||f|| */
    double gram[RB_ANDERSON_DEPTH][RB_ANDERSON_DEPTH];
} rb_anderson;

rb_status rb_anderson_init(int m, rb_anderson *a);
void rb_anderson_free(rb_anderson *a);
void rb_anderson_forget(rb_anderson *a);
/* An iteration has led from start to r, and to u, which is affine in r (NULL: there is no
 * such vector); the function replaces r and u by the values from which the next iteration
 * starts. */
void rb_anderson_step(rb_anderson *a, const double *start, double *r, double *u);

RB_PUBLIC_END

#endif
