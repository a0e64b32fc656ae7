/* One cluster of a hierarchical matrix with all but its skeleton eliminated. */
#ifndef ROLLBEM_BEM_HIERARCHICAL_ELIMINATION_H
#define ROLLBEM_BEM_HIERARCHICAL_ELIMINATION_H

#include "base/base.h"

#include <lapacke.h>

/* m rows and columns, the skeleton's first (S, `kept` of them), then the others (R).
 * With far rows R = V' rows S and far columns R = columns S Z, the others' own part X,
 *
 *     X_SR = D_SR - D_SS Z,  X_RS = D_RS - V' D_SS,  X_RR = D_RR - D_RS Z - V' X_SR,
 *
 * stands alone, and D_SS - X_SR X_RR^-1 X_RS is left of the skeleton's. */
typedef struct {
    int m, kept;
    int *row, *column;     /* m dofs */
    double *V, *Z;         /* kept x others */
    double *lower, *upper; /* X_SR; X_RR^-1 X_RS */
    double *LU;            /* of X_RR */
    lapack_int *pivot;
    rb_arena memory; /* of the arrays */
} rb_elimination;

/* Rows and columns, everything kept. */
rb_status rb_elimination_begin(int m, rb_elimination *e);
/* V and Z for so many kept, zeroed. */
rb_status rb_elimination_keep(int kept, rb_elimination *e);
/* D: m x m in the order of row and column, with V and Z set; its corner becomes the
 * skeleton's part.  RB_SINGULAR. */
rb_status rb_elimination_run(rb_elimination *e, double *D);

/* From the leaves to the root: b by rows, y by columns, n x q; scratch: m x q. */
void rb_elimination_up(const rb_elimination *e, size_t n, int q, double *b, double *y,
                       double *scratch);
/* And back: y becomes the unknowns. */
void rb_elimination_down(const rb_elimination *e, size_t n, int q, double *y, double *scratch);

#endif
