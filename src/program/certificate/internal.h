/* What the files of the certificate share; not installed. */
#ifndef ROLLBEM_CERTIFICATE_INTERNAL_H
#define ROLLBEM_CERTIFICATE_INTERNAL_H

#include "program/certificate/certificate.h"
#include "program/report/report.h"

#include <jansson.h>
#include <stdint.h>

/* One reading of a result. */
typedef struct {
    FILE *out;
    const char *name; /* of the file */
    rb_certificate_outcome *found;
    int quiet;       /* 1: violations are counted and not told */
    int judges;      /* 1: the laws are judged while the states are read */
    uint64_t moving; /* 0: numbers are taken as they are; otherwise each is moved by a rounding */
    rb_resolved_case of_mesh; /* the case on the elements that --accuracy has chosen */
    int proves;               /* 1: solutions are proved while they are judged */
    int step;                 /* of a sequence that is judged, from 1 on; 0: the result */
    const char *of;           /* what is judged, before every violation, such as "solution 2: " */
    /* of the contact whose laws are judged */
    const rb_rolling_model *model;
    double tol;          /* of the scaled residual */
    double exact;        /* of the scaled slip, as the result's own residual has it */
    double displacement; /* rounding of displacements [length] */
} rb_certificate;

void rb_certificate_violated(rb_certificate *c, const char *format, ...) RB_PRINTF(2, 3);
/* NAN is equal to NAN alone. */
void rb_certificate_expect(rb_certificate *c, const char *what, double printed, double want,
                           double allowed);
/* RB_EFORMAT: "<name>: cannot be checked: <what>". */
rb_status rb_certificate_refuse(const rb_certificate *c, const char *what, rb_message *why);

/* Tells why a result cannot be checked, or that there is no memory.  Returns RB_EFORMAT, RB_ENOMEM
 * or RB_OK. */
rb_status rb_certificate_end(const rb_certificate *c, rb_status s, const rb_message *reason,
                             rb_message *why);

/* ---- inputs.c: the case again ----------------------------------------------------- */

/* "" where there is no such word; NAN where there is no such number. */
const char *rb_certificate_word(const json_t *object, const char *key);
double rb_certificate_member(const json_t *object, const char *key);
/* Sets and resolves words by the inputs of a result, and sees that the same inputs come out. */
rb_status rb_certificate_inputs(const rb_certificate *c, const json_t *root, rb_case *words,
                                rb_message *why);

/* A copy of the case whose load, or what is given instead, is moved by a rounding, for what is
 * solved; NULL on error. */
rb_status rb_certificate_move_inputs(rb_certificate *c, const json_t *root, const rb_case *words,
                                     rb_case **other, rb_message *why);

/* ---- state.c: what is stored in a result -------------------------------------------- */

/* n numbers of a list that the object has under a key; each of `steps` lists, `apart` numbers from
 * one to the next.  All finite. */
rb_status rb_certificate_list(rb_certificate *c, const json_t *object, const char *key, int n,
                              double *x, rb_message *why);
rb_status rb_certificate_lists(rb_certificate *c, const json_t *object, const char *key, int steps,
                               int n, size_t apart, double *x, rb_message *why);
/* The same of zones, 0 to `most`. */
rb_status rb_certificate_zones(rb_certificate *c, const json_t *object, const char *key, int steps,
                               int n, int most, int *zone, rb_message *why);
/* x, or x moved by a rounding, each time by another one. */
double rb_certificate_moved(rb_certificate *c, double x);
double rb_certificate_stored(rb_certificate *c, const json_t *object, const char *key);

/* Where the parts of a contact stand in a result. */
typedef struct {
    const json_t *summary; /* NULL: of a table, which has none */
    const json_t *table;
    const json_t *history;     /* NULL: one step */
    double residual;           /* that is printed for the last state */
    double elements, boundary; /* of --accuracy: accuracy_elements, accuracy_boundary */
} rb_certificate_contact;

/* The model of a contact with the state that is stored, its solution and its steps, of which all
 * states are kept; judged, where c judges.  r, states: free them in any case. */
rb_status rb_certificate_restore(rb_certificate *c, const rb_resolved_case *resolved,
                                 const rb_certificate_contact *stored, rb_case_result *r,
                                 rb_rolling_states *states, rb_message *why);

/* ---- laws.c: contact and friction --------------------------------------------------- */

/* Sets the tolerances from the residual that is printed for the state of c->model. */
void rb_certificate_tolerances(rb_certificate *c, double residual);
/* Of the state of c->model: load and force, and what was given of them and of the motion; the laws
 * of contact and friction element by element; RB_ENOMEM. */
rb_status rb_certificate_laws(rb_certificate *c);
/* Proves the state of c->model where c proves: found->proof.  RB_ENOMEM. */
rb_status rb_certificate_prove(rb_certificate *c);
/* The lost power of a steady solution, and its mesh. */
rb_status rb_certificate_balances(rb_certificate *c, const rb_rolling_solution *s);

/* ---- power.c ------------------------------------------------------------------------ */

/* Power per unit speed that the bodies lose in steady rolling, from the state of the model;
 * allowed: what elements of this size may make of it. */
rb_status rb_certificate_hysteresis(const rb_rolling_model *model, const rb_rolling_solution *s,
                                    double *power, double *allowed);

/* ---- stress.c ----------------------------------------------------------------------- */

typedef struct {
    rb_rolling_stress_grid grid;
    rb_rolling_stress_maxima maxima;
    rb_rolling_shakedown limit;
    rb_report_stress shown;
} rb_certificate_stress;

/* Grid or points, maxima and shakedown from the model's tractions, at the places that are stored.
 */
rb_status rb_certificate_restore_stress(rb_certificate *c, const json_t *root,
                                        const rb_case_result *r, rb_certificate_stress *s,
                                        rb_message *why);

/* Tractions that were given, as they are stored. */
typedef struct {
    rb_rolling_traction_rows rows;
    double *numbers; /* all of them; owned */
} rb_certificate_given;

/* The model of given tractions.  r, given: free them in any case. */
rb_status rb_certificate_restore_given(rb_certificate *c, const json_t *root,
                                       const rb_resolved_case *resolved, rb_case_result *r,
                                       rb_certificate_given *given, rb_message *why);

/* ---- slopes.c ----------------------------------------------------------------------- */

/* Derivatives and standard deviations that are asked for. */
typedef struct {
    const char *names; /* NULL: no derivatives */
    int deviates;      /* 1: standard deviations */
    rb_case_tolerances uncertain;
    rb_case_derivatives all;
    rb_report_derivatives shown;
    rb_case_slopes of_steps;
} rb_certificate_slopes;

/* As the command computes them, at the stored state; those of steps are set in r->history, too. */
rb_status rb_certificate_restore_slopes(rb_certificate *c, const json_t *root, const rb_case *words,
                                        rb_case_result *r, rb_rolling_states *states,
                                        rb_certificate_slopes *s, rb_message *why);
void rb_certificate_slopes_free(rb_certificate_slopes *s);

/* ---- crack.c ------------------------------------------------------------------------ */

/* A crack under the passing contact, with its faces.  r: free it in any case. */
rb_status rb_certificate_restore_crack(rb_certificate *c, const json_t *root, rb_case *words,
                                       rb_case_crack_result *r, rb_message *why);

/* ---- compare.c: what is printed and what is written again --------------------------- */

/* Writes the result again from what it stores, with the numbers moved as c says; RB_EFORMAT: why it
 * cannot be. */
typedef rb_status rb_certificate_writer(rb_certificate *c, void *context, json_t **again,
                                        rb_message *why);
/* Judges and compares: tells of every violation.  RB_EFORMAT, RB_ENOMEM. */
rb_status rb_certificate_compare(rb_certificate *c, const json_t *printed,
                                 rb_certificate_writer *write, void *context, rb_message *why);

#endif
