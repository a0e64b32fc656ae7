/* Status codes, messages, memory and time: what every room of rollbem shares. */
#ifndef ROLLBEM_BASE_H
#define ROLLBEM_BASE_H

#include <stddef.h>
#include <stdint.h>

/* Around the declarations of every public header: for C++ too, and the only names that
 * the shared library exports. */
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
/* Of the library that runs, which need not be that of the header. */
const char *rb_version(void);

/* Negative: the call did not run (misuse, memory, files).
 * Positive: it ran and ended without a full answer; the last iterate is kept. */
typedef enum {
    RB_OK = 0,
    RB_EINVAL = -1,  /* an argument out of its range */
    RB_ENOMEM = -2,  /* no memory */
    RB_ENOENT = -3,  /* no such input file */
    RB_EFORMAT = -4, /* a file that does not say what it should */
    RB_EWRITE = -5,  /* an output that cannot be written */
    RB_EHELPER = -6, /* another program that is missing or fails */
    RB_MAXITER = 1,  /* iteration limit */
    RB_RAY = 2,      /* Lemke: secondary ray */
    RB_SINGULAR = 3, /* a matrix without inverse */
    RB_NO_CONTACT = 4,
    RB_ZONE = 5,       /* potential contact too small: it fills completely */
    RB_INACCURATE = 6, /* residual above the tolerance */
    RB_INTERRUPTED = 7
} rb_status;

/* One line for people: what, where, what was wanted.  Callers may pass NULL. */
typedef struct {
    char text[640];
} rb_message;

/* A word and what it stands for, of an option with a list of them. */
typedef struct {
    const char *name;
    int value;
} rb_choice;

/* Writes the formatted line into why (if any) and returns s, so that a refusal is
 * one statement: return rb_fail(why, RB_EINVAL, "mu = %g: expected >= 0", mu); */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
rb_status
rb_fail(rb_message *why, rb_status s, const char *format, ...);

/* Writes behind the text, which has room for size bytes in all; what is more is cut. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
void
rb_append(char *text, size_t size, const char *format, ...);

/* "solved", "secondary ray", ...: static text. */
const char *rb_status_text(rb_status s);
/* What why says, or the text of s where it says nothing. */
const char *rb_status_reason(rb_status s, const rb_message *why);
/* What LAPACK's info means where it can be only three things: solved, no memory, or a
 * matrix without inverse.  (LAPACKE refuses NaN with a small negative number.) */
rb_status rb_lapack_status(int info);

/* The candidate nearest to a misspelt word.  Start with {.word = word}. */
typedef struct {
    const char *word, *best;
    int distance;
    char text[80];
} rb_guess;

void rb_guess_try(rb_guess *guess, const char *candidate);
/* " (did you mean '...'?)", or "" when nothing is near; prefix is put before the word.
 * Returns guess->text. */
const char *rb_guess_text(rb_guess *guess, const char *prefix);

/* What a file name or an argument looks like in print: bytes that are not UTF-8 and
 * control characters become \xHH.  At most size - 1 bytes, whole characters; returns to.
 * 4 times the length holds any text. */
char *rb_printable(const char *text, char *to, size_t size);

/* A finite number in the fewest digits that read back equal: 0.3, 1e-09.  Returns text.
 */
enum { RB_NUMBER_TEXT = 32 };
char *rb_number_text(double x, char text[RB_NUMBER_TEXT]);
/* Between the two calls this thread reads and writes numbers in the C locale, with
 * points, whatever the host program has set; before: what rb_locale_begin returned. */
void *rb_locale_begin(void);
void rb_locale_end(void *before);
/* strtod and snprintf in the C locale. */
double rb_read_number(const char *text, char **end);
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
int
rb_format(char *text, size_t size, const char *format, ...);

/* What takes long, for people who wait: static text, the last that a thread of this
 * process has said; NULL: nothing yet. */
void rb_phase(const char *what);
const char *rb_phase_now(void);

/* rows x cols doubles (or ints, or n bytes), zeroed; NULL when memory is short or the
 * product overflows.  Released with free(). */
double *rb_alloc(size_t rows, size_t cols);
int *rb_alloc_int(size_t n);
/* n doubles with the values of x; NULL when memory is short.  Released with free(). */
double *rb_copy(size_t n, const double *x);

/* RB_EINVAL, with the memory that `what` needs and the machine's in why, where it has not
 * that much: to be asked before allocating. */
rb_status rb_memory_check(double bytes, const char *what, rb_message *why);

/* Seconds on a clock that only moves forward. */
double rb_seconds(void);

/* FNV-1a: begin with RB_HASH_START, go on with what came out. */
#define RB_HASH_START UINT64_C(14695981039346656037)
uint64_t rb_hash(uint64_t hash, const void *data, size_t size);

/* max |x_i| over n; NaN if any entry is NaN. */
double rb_norm_inf(size_t n, const double *x);

/* sum |x_i| over n entries, stride apart.  cblas_dasum is not used: with AVX-512 its last
 * digits depend on the address of x, so that two runs would differ. */
double rb_norm_1(size_t n, const double *x, size_t stride);

RB_PUBLIC_END

#endif
