/* What the references of `verify` share. */
#ifndef ROLLBEM_VERIFY_INTERNAL_H
#define ROLLBEM_VERIFY_INTERNAL_H

#include "rolling/rolling.h"
#include "program/verify/verify.h"

typedef struct {
    rb_verify_each_check *each;
    void *context;
    int failed;
    const char *why;               /* reason why there is no solution; NULL: solved */
    rb_message said;               /* what `why` points to */
    rb_rolling_solution solved[2]; /* the last two; owned */
    int last;                      /* which of them */
} rb_verify;

/* Hands on one line, whose bound is of the difference or of that over `wanted`; what:
 * printf format. */
void rb_verify_absolute(rb_verify *v, double got, double wanted, double bound, const char *what,
                        ...) RB_PRINTF(5, 6);
void rb_verify_relative(rb_verify *v, double got, double wanted, double bound, const char *what,
                        ...) RB_PRINTF(5, 6);

/* Keeps the reason of a failure for the next lines. */
void rb_verify_note(rb_verify *v, rb_status s, const rb_message *why);

/* The solution, which stays until the solve after the next; when that fails every value
 * compared is NaN and the reason is kept. */
const rb_rolling_solution *rb_verify_solve(rb_verify *v, const rb_rolling_case *rc);

/* A half-plane against a rigid plane under the load whose Hertz half-width is R/1e4, 100
 * fitted elements; with nu = 1/2 the pair has no coupling, as similar bodies. */
rb_rolling_case rb_verify_uncoupled(void);

/* Makes B a plane of A's material and support. */
void rb_verify_on_same(rb_rolling_case *rc);

/* Aluminium on steel rolling freely, R_A = R_B = 50, a = 0.1 (theory-solvers.md 6). */
rb_rolling_case rb_verify_aluminium_on_steel(double mu);

void rb_verify_contact(rb_verify *v);   /* Hertz, Carter, Cattaneo, Bentall-Johnson */
void rb_verify_bodies(rb_verify *v);    /* the elastic body alone, and below the contact */
void rb_verify_rolling(rb_verify *v);   /* transients, dissipation */
void rb_verify_interface(rb_verify *v); /* heat, wear */
void rb_verify_crack(rb_verify *v);     /* stress intensities */
/* How near fitted elements come, by their number. */
void rb_verify_accuracy(rb_verify *v);

#endif
