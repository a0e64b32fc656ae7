/* What the rooms use of src/base besides rollbem/base.h: memory, text, time, steps that may be
 * interrupted. */
#ifndef ROLLBEM_SRC_BASE_BASE_H
#define ROLLBEM_SRC_BASE_BASE_H

#include "rollbem/base.h"

/* Behind a declaration: argument f is a format of printf, those from number a on are what it
 * formats. */
#ifdef __GNUC__
#define RB_PRINTF(f, a) __attribute__((format(printf, f, a)))
#else
#define RB_PRINTF(f, a)
#endif

/* Writes the formatted line into why (unless it is NULL) and returns s.  An error return
 * is then one statement: return rb_fail(why, RB_EINVAL, "mu = %g: expected >= 0", mu); */
rb_status rb_fail(rb_message *why, rb_status s, const char *format, ...) RB_PRINTF(3, 4);
/* The same of a wrong input, with RB_EINVAL: about is the name of its option, and the text begins
 * with it, "zone: ...".  Behind a comma stand others of which it is wrong together with, and of
 * which the first one that was given is blamed. */
rb_status rb_refuse(rb_message *why, const char *about, const char *format, ...) RB_PRINTF(3, 4);
/* The same of a row of a table, from 1: "history: row 3: ...". */
rb_status rb_refuse_row(rb_message *why, const char *about, int row, const char *format, ...)
    RB_PRINTF(4, 5);
/* The text of why, or that of s if why is NULL or empty. */
const char *rb_status_reason(rb_status s, const rb_message *why);
/* x with six digits, towards zero: of the largest value that is accepted a message must not
 * print more. */
double rb_largest_shown(double x);

/* Appends to text, a buffer of size bytes in all; whatever does not fit is cut off. */
void rb_append(char *text, size_t size, const char *format, ...) RB_PRINTF(3, 4);

/* The end of a noun behind the number n: "%d step%s". */
static inline const char *rb_plural(long long n)
{
    return n == 1 ? "" : "s";
}

/* One allowed word of an option, and the value (of an enum) that the word stands for. */
typedef struct {
    const char *name;
    int value;
} rb_choice;

/* Copies the next word of a list with commas, as far as it fits.  Returns the rest of the list;
 * NULL: it is empty, or NULL. */
const char *rb_next_word(const char *list, char *word, size_t size);

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

/* Records the name of the computation that now runs (static text), for rb_phase_now. */
void rb_phase(const char *what);
/* For progress displays: the name of the computation that runs, as any thread of the process
 * has recorded it last (static text); NULL: none. */
const char *rb_phase_now(void);

/* What this thread was told to ask (rb_interrupt_by) answers; 0 where nothing is asked.  A loop
 * that may take long asks in every turn, on the thread of its caller. */
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

/* rb_arena, scratch memory: arrays that a function needs for itself.  It allocates all of them,
 * asks once whether there was memory, and returns rb_arena_done(...) at each exit, which frees them
 * and returns the status:
 *
 *     rb_arena scratch = {0};
 *     double *M = rb_arena_doubles(&scratch, n, n), *q = rb_arena_doubles(&scratch, n, 1);
 *     if (scratch.failed)
 *         return rb_arena_done(&scratch, RB_ENOMEM);
 *
 * A function that is handed an arena adds arrays to it and leaves freeing to the owner.
 * Once an allocation has failed, all later ones do.  Each array is a block of its own, so
 * that tools that watch memory see its ends.  One thread at a time. */

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

#endif
