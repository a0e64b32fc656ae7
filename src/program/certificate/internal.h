/* What the files of the certificate share; not installed. */
#ifndef ROLLBEM_CERTIFICATE_INTERNAL_H
#define ROLLBEM_CERTIFICATE_INTERNAL_H

#include "program/certificate/certificate.h"
#include "program/report/report.h"

#include <jansson.h>

typedef struct {
    FILE *out;
    const char *name; /* of the file */
    rb_certificate_outcome *found;
    const json_t *summary; /* NULL: of a table, which has none */
    const json_t *table;
    int step; /* step of a history that is checked, from 1 on; 0: the result */
    rb_rolling_model model;
    rb_rolling_solution again; /* computed from the state */
    int hierarchical;          /* a matrix that approximates */
    double tol;                /* of the scaled residual */
    double exact;              /* of the scaled gap and slip, as the result's own residual has it */
    double displacement;       /* rounding of displacements [length] */
    struct rb_certificate_slopes *slopes; /* while derivatives are compared; slopes.c */
    enum { RB_NO_SIDES, RB_SIDES_OF_CASE, RB_SIDES_OF_STEPS } sides; /* which may be printed */
} rb_certificate;

void rb_certificate_violated(rb_certificate *c, const char *format, ...) RB_PRINTF(2, 3);
/* NAN is equal to NAN alone. */
void rb_certificate_expect(rb_certificate *c, const char *what, int element, double printed,
                           double want, double allowed);
/* RB_EFORMAT: "<name>: cannot be checked: <what>". */
rb_status rb_certificate_refuse(const char *name, const char *what, rb_message *why);
/* "" where there is no such word. */
const char *rb_certificate_word(const json_t *object, const char *key);
double rb_certificate_number(const json_t *value);
double rb_certificate_member(const json_t *object, const char *key);

/* Refuses results of other schemas, kinds (a list of keys, NULL at its end), units or
 * versions, with error bars, or not solved. */
rb_status rb_certificate_head(const char *name, const json_t *root, const char *const *known,
                              rb_message *why);
/* Sets and resolves words by the inputs of a result, and sees that the same inputs come out. */
rb_status rb_certificate_rebuild_case(const char *name, const json_t *root, rb_case *words,
                                      rb_message *why);

/* A violation where the hash of the inputs and of the files that they name, which is taken over,
 * is not the printed one.  RB_ENOMEM: now is NULL. */
rb_status rb_certificate_hash(rb_certificate *c, const json_t *root, json_t *now);

/* n numbers that a table has under a heading. */
rb_status rb_certificate_column(const char *name, const json_t *table, const char *heading, int n,
                                double *x, rb_message *why);

/* The same of each of the steps of `of`, `apart` numbers from step to step. */
rb_status rb_certificate_lists(const char *name, const char *of, const json_t *table,
                               const char *heading, int steps, int n, size_t apart, double *x,
                               rb_message *why);

/* Typical sizes of the numbers of a result; rounding errors are compared with them. */
typedef struct {
    double half_width, load, pressure;
    double number; /* of unit 1 */
    double radius; /* the larger one, of torques */
} rb_certificate_scales;
/* What a number of this name, a row of the table, may differ by beside its own nine
 * digits; otherwise: it is none of them or has no unit. */
double rb_certificate_rounding(const rb_rolling_results *all, const char *name,
                               const rb_certificate_scales *scales, double otherwise);

/* What the number of this path, names with points between, may differ by. */
typedef double rb_certificate_slack(const rb_certificate *c, const char *path, double want);
/* The last name of a path. */
const char *rb_certificate_last(const char *path);
/* All that `again` holds against what is printed in its place: objects in objects, lists.
 * name: the path of both, of which a violation tells; element: from 1 on, in a list. */
void rb_certificate_compare(rb_certificate *c, const char *name, int element, const json_t *printed,
                            const json_t *again, rb_certificate_slack *slack);

/* From the residual that is printed for the current state. */
void rb_certificate_tolerances(rb_certificate *c, double residual);
/* The given load or approach, creepage or shift against the model's. */
void rb_certificate_given(rb_certificate *c, double load);
void rb_certificate_motion(rb_certificate *c);
/* Contact and friction, element by element. */
rb_status rb_certificate_laws(rb_certificate *c);

/* The model of a case on the n elements of its table, with the state that is printed. */
rb_status rb_certificate_rebuild(rb_certificate *c, const rb_resolved_case *resolved, int n,
                                 rb_message *why);
/* Judges the state of the model, and what is printed beside it; residual: as printed. */
rb_status rb_certificate_assess(rb_certificate *c, double residual, rb_message *why);
/* Frees, and returns s with its reason in words. */
rb_status rb_certificate_end(rb_certificate *c, rb_status s, rb_message *why);

/* ---- history.c ------------------------------------------------------------------ */

/* Follows the steps of a history by its states, checks each of them and leaves the model
 * at the last one.  states, h: overwritten; free them in any case. */
rb_status rb_certificate_follow(rb_certificate *c, const json_t *printed,
                                const rb_resolved_case *resolved, int n, rb_rolling_states *states,
                                rb_rolling_history *h, rb_message *why);
/* Its columns against those that came out. */
rb_status rb_certificate_compare_history(rb_certificate *c, const json_t *printed,
                                         const rb_rolling_history *h);

/* ---- crack.c -------------------------------------------------------------------- */

/* A crack under the passing contact, with its faces. */
rb_status rb_certificate_crack(FILE *out, const char *name, const json_t *root, rb_case *words,
                               rb_certificate_outcome *found, rb_message *why);

/* ---- power.c -------------------------------------------------------------------- */

/* Power per unit speed that the bodies lose in steady rolling, from the current state;
 * allowed: what elements of this size may make of it. */
rb_status rb_certificate_hysteresis(const rb_certificate *c, double *power, double *allowed);

/* ---- slopes.c ------------------------------------------------------------------- */

/* Derivatives and standard deviations of the result root of a case, against those that
 * the library computes from the model. */
rb_status rb_certificate_derivatives(rb_certificate *c, const json_t *root, const rb_case *words,
                                     rb_message *why);
/* The same of a history by its states, which it takes over into `again`. */
rb_status rb_certificate_step_derivatives(rb_certificate *c, const json_t *root,
                                          const rb_case *words, const rb_rolling_states *states,
                                          rb_rolling_history *again, rb_message *why);

/* ---- stress.c ------------------------------------------------------------------- */

/* Grid or points, maxima and shakedown, computed from the model's tractions. */
rb_status rb_certificate_stress(rb_certificate *c, const json_t *root, rb_message *why);

#endif
