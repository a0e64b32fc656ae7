/* Linear complementarity problems: z >= 0, w = M z + q >= 0, z'w = 0.
 * Knows nothing of contact.  Reference: Cottle, Pang, Stone, The Linear
 * Complementarity Problem (1992), chapter 4. */
#ifndef ROLLBEM_LCP_H
#define ROLLBEM_LCP_H

#include "rollbem/base.h"
#include "rollbem/sparse.h"

/* Which row leaves when several ratios tie. */
typedef enum {
    RB_LCP_LEXICOGRAPHIC, /* cannot cycle */
    RB_LCP_FIRST_INDEX    /* can cycle on degenerate problems: for teaching and tests */
} rb_lcp_rule;

/* One pivot as the trace callback sees it.  Variables are numbered w_0 .. w_{n-1} =
 * 0 .. n-1, z_0 .. z_{n-1} = n .. 2n-1, the artificial z0 = 2n. */
typedef struct {
    int pivot;             /* 0, 1, ... */
    int entering, leaving; /* variable numbers */
    int row;               /* row of the pivot in the tableau */
    double ratio, z0;      /* step length; z0 after the pivot */
    int n;                 /* order of the problem */
    const int *basis;      /* n: basic variable of each row, after the pivot; borrowed */
    const int *nonbasis;   /* n + 1: variable of each column */
    const double *tableau; /* n x (n + 2) column-major after the pivot: basic = last
                              column + columns times nonbasic; borrowed; NULL unless
                              options.trace_tableau */
} rb_lcp_pivot;

typedef void rb_lcp_trace(const rb_lcp_pivot *pivot, void *context);

typedef struct {
    int max_iters;       /* 0: 50 n + 1000 pivots; newton: 10 n + 100 steps */
    double tol;          /* relative size below which z0 counts as zero, default 1e-13 */
    const double *cover; /* n: covering vector d >= 0, > 0 where q < 0; NULL: ones;
                            borrowed */
    const double *start; /* newton, n: z_i is basic at first where this is > 0 (the z of a
                            similar problem); NULL: where q < 0; borrowed */
    rb_lcp_rule rule;
    rb_lcp_trace *trace; /* NULL: none */
    void *trace_context;
    int trace_tableau; /* 1: hand the whole tableau to trace (slow) */
} rb_lcp_options;

typedef struct {
    int iters;        /* pivots; newton: linear systems */
    double res;       /* max |min(z, Mz + q)|, recomputed from z alone */
    int ray_variable; /* RB_RAY: the entering variable that no row blocks; else -1 */
    rb_message msg;
} rb_lcp_info;

rb_lcp_options rb_lcp_defaults(void);

/* Lemke's method.  M: n x n, column-major, ldm >= n; q: n; z: n, written (the last
 * basic point when not solved).  opt NULL: defaults.
 * RB_OK, RB_RAY, RB_MAXITER; RB_INACCURATE: rounding has spoilt the solution, residual
 * above 1e-6 max |q|; RB_EINVAL: n < 1, ldm < n, NaN or infinity, no cover; RB_ENOMEM.
 */
rb_status rb_lcp_lemke(int n, const double *M, int ldm, const double *q,
                       const rb_lcp_options *opt, double *z, rb_lcp_info *info);

/* Block principal pivoting for sparse M: Newton's method on min(z, M z + q) = 0 with a rule
 * that ends for every P-matrix.  Of the options max_iters and start count.  RB_OK,
 * RB_MAXITER, RB_INACCURATE; RB_SINGULAR: a principal submatrix is, so M is no P-matrix;
 * RB_EINVAL: M not square, NaN or infinity; RB_ENOMEM. */
rb_status rb_lcp_newton(const rb_sparse *M, const double *q, const rb_lcp_options *opt,
                        double *z, rb_lcp_info *info);

/* w = M z + q and max_i |min(z_i, w_i)|; w: n or NULL. */
double rb_lcp_residual(int n, const double *M, int ldm, const double *q, const double *z,
                       double *w);
/* The same for sparse M; w: n. */
double rb_lcp_residual_sparse(const rb_sparse *M, const double *q, const double *z,
                              double *w);

#endif
