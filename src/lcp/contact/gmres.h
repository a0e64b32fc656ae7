/* GMRES with borders; private to this folder. */
#ifndef ROLLBEM_CONTACT_GMRES_H
#define ROLLBEM_CONTACT_GMRES_H

#include "lcp/contact/internal.h"

/* A linear system [A B; C 0] with inner unknowns and at most two border unknowns.  `of`
 * is passed to the functions. */
struct rb_contact_linear {
    int inner, borders;
    void (*multiply)(const void *of, const double *x, double *y);
    void (*precondition)(const void *of, const double *b, double *x); /* x ~ A^-1 b */
    void (*border_column)(const void *of, int k, double *column);     /* of B */
    void (*border_rows)(const void *of, const double *x, double *y);  /* y = C x */
    const void *of;
};

/* 2-norm of the scaled residual at which a solve ends. */
#define RB_CONTACT_GMRES_TOLERANCE 2e-11

/* Workspace that is kept from solve to solve, because allocating memory costs more than
 * the arithmetic.  Initially zero except for size. */
enum { RB_CONTACT_BASIS = 100 };
typedef struct {
    size_t size;                         /* largest number of unknowns */
    double *basis[RB_CONTACT_BASIS + 1]; /* allocated on demand; owned, like work */
    double *work;
} rb_contact_gmres_scratch;
void rb_contact_gmres_free(rb_contact_gmres_scratch *scratch);

/* GMRES with start x.  RB_OK also if the residual no longer decreases: either it is at
 * rounding level, or the residual of the whole problem shows the error.  RB_ENOMEM. */
rb_status rb_contact_gmres(const rb_contact_linear *linear, rb_contact_gmres_scratch *scratch,
                           const double *b, double *x);

#endif
