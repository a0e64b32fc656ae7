/* The state of Lemke's method.  Private to the room lcp. */
#ifndef LCP_LEMKE_H
#define LCP_LEMKE_H

#include "rollbem/lcp.h"
#include "lcp/tableau.h"

typedef struct {
    int n;
    lcp_data data;
    rb_lcp_options opt;
    lcp_tableau t;
    double *a;               /* n: driving column */
    double *other, *scratch; /* n each */
    double *r, *sum;         /* n each: defect and its correction */
    double *weight;          /* n + 1: of the columns */
    int *near;               /* n + 1: columns brought up to date together; scratch */
    double *image;           /* n x (n + 2) for the trace, or NULL */
    int *tied;               /* n: rows that tie; scratch */
    double start, refreshed; /* z0 after the first pivot, at the last refresh */
    int checked, rebuilt;    /* pivots at the last refresh, at the last rebuild */
    double largest;          /* max |M| */
    rb_lcp_info *info;
} lemke;

/* w += M z; residual.c. */
void rb_lcp_add_product(int rows, int columns, const double *M, int ldm, const double *z,
                        double *w);

/* z0, 0 when nonbasic. */
double rb_lcp_lemke_z0(const lemke *l);

static inline int rb_lcp_complement(int n, int variable)
{
    return variable < n ? variable + n : variable - n;
}

/* ---- ahead.c: which columns of the tableau are brought up to date ---- */

/* The column of the variable that enters now, and with it those that will be asked for
 * soon. */
void rb_lcp_lemke_prepare(lemke *l, int column);
/* A column that breaks a tie. */
void rb_lcp_lemke_prepare_alone(lemke *l, int column);

/* ---- ratio.c: which row leaves ---- */

/* l->a = the column of a nonbasic variable without the rounding errors that stand for
 * zeros: they would decide between rows that tie, and may be taken for pivots. */
void rb_lcp_lemke_column(lemke *l, int variable);
/* The row of the first pivot; -1 when q >= 0. */
int rb_lcp_lemke_first_row(const lemke *l);
/* The row that blocks the variable whose column is l->a; -1: none does. */
int rb_lcp_lemke_blocking_row(lemke *l);
/* 1 when the entry of this row of l->a cannot be a rounding error. */
int rb_lcp_lemke_pivot_holds(const lemke *l, int row);

/* ---- rounding.c: what the pivots' rounding errors have done ---- */

/* Refines the constants; rebuilds the tableau where it has drifted too far for that.
 * RB_ENOMEM. */
rb_status rb_lcp_lemke_refresh(lemke *l);
/* The tableau from the original matrix.  RB_ENOMEM, RB_SINGULAR. */
rb_status rb_lcp_lemke_rebuild(lemke *l);
/* 1 when the column of `entering` in l->a holds for the original matrix. */
int rb_lcp_lemke_column_holds(lemke *l, int entering);
/* z and info->res: the basic point, made exact when `solved`. */
void rb_lcp_lemke_answer(lemke *l, int solved, double *z);

#endif
