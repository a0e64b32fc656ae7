/* Linear complementarity problems: z >= 0, w = M z + q >= 0, z'w = 0.
 * Knows nothing of contact.  Reference: Cottle, Pang, Stone, The Linear
 * Complementarity Problem (1992), chapter 4. */
#ifndef ROLLBEM_LCP_H
#define ROLLBEM_LCP_H

#include "rollbem/base.h"
#include "rollbem/sparse.h"

RB_PUBLIC_BEGIN

/* w = M z + q with a dense M.  Borrowed, as every problem here. */
typedef struct {
    int n;
    const double *M; /* n x n, column-major */
    int ldm;         /* >= n */
    const double *q; /* n */
} rb_lcp_problem;

/* The same with a sparse M, and boxes: lower <= z <= upper, and each w_i is >= 0 where
 * z_i = lower_i, <= 0 where z_i = upper_i, 0 in between, any number where lower_i =
 * upper_i. */
typedef struct {
    const rb_sparse *M;
    const double *q;             /* n */
    const double *lower, *upper; /* n each, infinite where there is no bound; NULL: 0 and
                                    infinity, which is the LCP */
} rb_lcp_mixed_problem;

/* A bimatrix game: the row player, who mixes his m strategies by x, gets x'A y and the
 * column player, who mixes n by y, gets x'B y. */
typedef struct {
    int m, n;
    const double *A, *B; /* m x n, column-major */
    int ld;              /* >= m, of both */
} rb_lcp_game;

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
    int attempt;           /* options.attempt */
    int n;                 /* order of the problem */
    const int *basis;      /* n: basic variable of each row, after the pivot; borrowed,
                              as all here; NULL of bimatrix games */
    const double *value;   /* n: the value of each of them */
    const int *nonbasis; /* n + 1: variable of each column; NULL: mixed has no tableau */
    const double *tableau; /* n x (n + 2) column-major after the pivot: basic = last
                              column + columns times nonbasic; NULL unless
                              options.trace_tableau */
} rb_lcp_pivot;

typedef void rb_lcp_trace(const rb_lcp_pivot *pivot, void *context);

typedef struct {
    int max_iters;       /* 0: 50 n + 1000 pivots; newton: 10 n + 100 steps */
    double seconds;      /* time limit; 0: none */
    const double *cover; /* n: covering vector d >= 0, > 0 where q < 0; NULL: ones;
                            borrowed */
    const double *start; /* newton and mixed, n: z_i is basic at first where this is
                            between its bounds (the z of a similar problem); NULL: newton
                            where q < 0, mixed nowhere; borrowed */
    rb_lcp_rule rule;
    rb_lcp_trace *trace; /* NULL: none */
    void *trace_context;
    int attempt;       /* handed to trace: which of the caller's problems this is */
    int trace_tableau; /* 1: hand the whole tableau to trace (slow) */
} rb_lcp_options;

/* A function with an info argument takes NULL as well. */
typedef struct {
    const char *solver; /* that found z: static text, NULL if no solver ran */
    int iters;          /* pivots; newton: linear systems; auto: of all methods */
    double res;         /* max |min(z, Mz + q)|, recomputed from z alone */
    double scaled;      /* the same with each row in its own scale; decides */
    int row;            /* the row of `scaled`; -1: none */
    int ray_variable;   /* RB_RAY: the entering variable that no row blocks; else -1 */
    rb_message msg;
} rb_lcp_info;

rb_lcp_options rb_lcp_defaults(void);

/* Lemke's method.  z: n, written (the last basic point when not solved).  opt NULL:
 * defaults.  Where the largest entries of rows or columns differ by more than 1024, this
 * and the other solvers work on R M C, R q with powers of two R, C (Ruiz); a cover of
 * ones stays a cover of ones there.  The trace gets values in the caller's units.
 * RB_OK, RB_RAY, RB_MAXITER, RB_INTERRUPTED (time limit); RB_INACCURATE: rounding has
 * spoilt the solution, info->scaled above 1e-10; RB_EINVAL: n < 1, ldm < n, NaN or
 * infinity, no cover; RB_ENOMEM.
 */
rb_status rb_lcp_lemke(const rb_lcp_problem *p, const rb_lcp_options *opt, double *z,
                       rb_lcp_info *info);

/* Block principal pivoting for sparse M: Newton's method on min(z, M z + q) = 0 with a
 * rule that ends for every P-matrix.  It uses the options max_iters and start.  RB_OK,
 * RB_MAXITER, RB_INACCURATE; RB_SINGULAR: a principal submatrix is singular, so that M is
 * not a P-matrix;
 * RB_EINVAL: M not square, NaN or infinity; RB_ENOMEM. */
rb_status rb_lcp_newton(const rb_sparse *M, const double *q, const rb_lcp_options *opt,
                        double *z, rb_lcp_info *info);

/* Lemke's method on a sparse LU, for boxes.  Ties are broken by a generic perturbation,
 * with RB_LCP_FIRST_INDEX by the row; trace_tableau has no effect.  A variable
 * without any bound is split: the other half of the k-th of them is variable n + k for
 * the trace, which sees a larger n then.  With opt->start the path begins at the basis of
 * that point; if it does not lead to a solution, a second path begins at the bounds.
 * Statuses as rb_lcp_lemke, and RB_SINGULAR: a basis is singular up to rounding;
 * RB_EINVAL: crossed bounds, too. */
rb_status rb_lcp_mixed(const rb_lcp_mixed_problem *p, const rb_lcp_options *opt,
                       double *z, rb_lcp_info *info);

/* What rb_lcp_solve knows, auto first. */
typedef struct {
    const char *name, *summary;
} rb_lcp_solver;
const rb_lcp_solver *rb_lcp_solvers(int *count);

/* By name; solver NULL: "auto", a portfolio.  It reads the structure of M, lets the
 * method begin that fits it, and where that does not end soon all methods go on in turns;
 * info->solver says which of them gave the answer, iters sums all, max_iters is each
 * one's.  Where all fail it hands out the end of Lemke's path.  A trace, a cover, a rule
 * and boxes ask for Lemke's method.  Statuses as the others; RB_EINVAL: unknown solver,
 * boxes for newton, too. */
rb_status rb_lcp_solve(const char *solver, const rb_lcp_mixed_problem *p,
                       const rb_lcp_options *opt, double *z, rb_lcp_info *info);

/* All solutions that complementary bases give, each once. */
typedef struct {
    int n, count;
    double *z;           /* n x count; owned */
    int bases, singular; /* tried; of these without inverse: solutions in them alone are
                            not found */
} rb_lcp_solutions;

/* lower, upper as in rb_lcp_mixed_problem.  RB_EINVAL: more than 2^22 bases (order 22
 * without boxes), crossed bounds, NaN or infinity in M or q; RB_ENOMEM. */
rb_status rb_lcp_enumerate(const rb_lcp_problem *p, const double *lower,
                           const double *upper, rb_lcp_solutions *all, rb_message *why);
void rb_lcp_solutions_free(rb_lcp_solutions *all);

/* An equilibrium of a game by the method of Lemke and Howson with a lexicographic rule.
 * label, 0 ... m + n - 1: the strategy dropped first (rows, then columns); other labels
 * may lead to other equilibria.  Of the options max_iters, seconds and trace count; to
 * the trace z_k is the probability, w_k the regret of strategy k.  z = (x, y): m + n,
 * written.  RB_OK, RB_MAXITER, RB_INACCURATE, RB_EINVAL, RB_ENOMEM. */
rb_status rb_lcp_bimatrix(const rb_lcp_game *game, int label, const rb_lcp_options *opt,
                          double *z, rb_lcp_info *info);
/* All equilibria that complementary bases give, as rb_lcp_enumerate: m + n is at most
 * 22. */
rb_status rb_lcp_bimatrix_enumerate(const rb_lcp_game *game, rb_lcp_solutions *all,
                                    rb_message *why);
/* What each strategy loses against the best reply to the other player's mixture (m + n,
 * >= 0), the payoffs of the best replies, and max min(probability, regret). */
double rb_lcp_bimatrix_regret(const rb_lcp_game *game, const double *z, double *regret,
                              double payoff[2]);

/* w = M z + q and max_i |min(z_i, w_i)|; w: n or NULL. */
double rb_lcp_residual(const rb_lcp_problem *p, const double *z, double *w);
/* The same for sparse M and boxes: max_i |max(min(z_i - lower_i, w_i), z_i - upper_i)|;
 * w: n. */
double rb_lcp_residual_mixed(const rb_lcp_mixed_problem *p, const double *z, double *w);
/* The residual with each row in its own scale: max_i |min(z_i, w_i)|, of R M C, as a part
 * of (|M| |z| + |q|)_i there; a row that may hold nothing but the rounding of larger
 * rows which share its unknowns is judged by 1e-4 of theirs.  Does not depend on the
 * units of rows and columns.  row (NULL: not wanted): where, or -1.  RB_ENOMEM. */
rb_status rb_lcp_scaled_residual(const rb_lcp_mixed_problem *p, const double *z,
                                 double *scaled, int *row);
/* The residual that rounding of the data allows: 1e-14 max_i (|M| |z| + |q|)_i; room: n.
 */
double rb_lcp_rounding_floor(const rb_lcp_mixed_problem *p, const double *z,
                             double *room);

RB_PUBLIC_END

#endif
