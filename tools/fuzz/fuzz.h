/* Fuzz targets: each takes any bytes and ends the process where a property of the library
 * does not hold.  tools/fuzz/libfuzzer.c gives them to libFuzzer (make fuzz), tests/test_fuzz.c
 * replays the files of tests/fuzz (make test). */
#ifndef ROLLBEM_FUZZ_H
#define ROLLBEM_FUZZ_H

#include "rollbem/base.h"

#include <stddef.h>
#include <stdint.h>

typedef void fuzz_run(const uint8_t *data, size_t size);

typedef struct {
    const char *name;
    fuzz_run *run;
} fuzz_target;

/* Ends with an empty name. */
extern const fuzz_target fuzz_targets[];

/* To be called once, before the first target: a folder of its own, which is the working
 * folder from then on.  0: all went well. */
int fuzz_begin(void);
/* Removes that folder. */
void fuzz_end(void);

/* ---- For the targets --------------------------------------------------------------- */

/* Prints the text and ends the process unless the property holds. */
void fuzz_require(int holds, const char *property);
/* A status is one of rollbem/base.h, and a refusal says why in one line. */
void fuzz_require_reason(rb_status s, const rb_message *why);

/* Whoever opens the file of that name to read it, reads these bytes from memory, until
 * the next call; data: to be kept until then.  Files on a disk would take most of the
 * time. */
void fuzz_keep(const char *name, const void *data, size_t size);
/* Writes the bytes to the file of that name in the working folder, for what other
 * processes read or what is written again. */
void fuzz_write(const char *name, const void *data, size_t size);
/* The whole file and a zero behind it; owned by the caller. */
char *fuzz_read(const char *name, size_t *size);
/* The bytes with a zero behind them, as text; owned by the caller. */
char *fuzz_text(const uint8_t *data, size_t size);

/* Takes bytes one after the other; zeros where there are no more. */
typedef struct {
    const uint8_t *at, *end;
} fuzz_bytes;

int fuzz_byte(fuzz_bytes *b);
/* 0 ... n - 1 */
int fuzz_choice(fuzz_bytes *b, int n);
/* Any finite number: small whole numbers, powers of ten, ties and extremes, or the next
 * eight bytes. */
double fuzz_number(fuzz_bytes *b);

/* ---- Targets, by file -------------------------------------------------------------- */

fuzz_run fuzz_ini, fuzz_gap, fuzz_history, fuzz_table;                  /* cases.c */
fuzz_run fuzz_siconos, fuzz_matrix_market, fuzz_lcp_text, fuzz_contact; /* readers.c */
fuzz_run fuzz_fclib;                                                    /* readers.c */
fuzz_run fuzz_options, fuzz_study, fuzz_resume, fuzz_check;             /* program.c */
fuzz_run fuzz_lemke, fuzz_friction;                                     /* solvers.c */
fuzz_run fuzz_handle;                                                   /* handle.c */

#endif
