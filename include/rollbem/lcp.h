/* Linear complementarity problems: z >= 0, w = M z + q >= 0, z'w = 0. Contact does not appear here.
 * Reference: Cottle, Pang, Stone, The Linear Complementarity Problem (1992), chapter 4. */
#ifndef ROLLBEM_LCP_H
#define ROLLBEM_LCP_H

#include "rollbem/base.h"
#include "rollbem/sparse.h"

RB_PUBLIC_BEGIN

/* w = M z + q with a dense M.  The pointers are borrowed, as in every problem of this header. */
typedef struct {
    int n;
    const double *M; /* n x n, column-major */
    int ldm;         /* >= n */
    const double *q; /* n */
} rb_lcp_problem;

/* The mixed problem: M is sparse, and lower <= z <= upper.  Each w_i is >= 0 where z_i = lower_i,
 * <= 0 where z_i = upper_i, 0 in between, and any number where lower_i = upper_i. */
typedef struct {
    const rb_sparse *M;
    const double *q;             /* n */
    const double *lower, *upper; /* n each, infinite where there is no bound; NULL: 0 and
                                    infinity, which is the LCP */
} rb_lcp_mixed_problem;

/* Which row is chosen when several rows have the same minimum ratio. */
typedef enum {
    RB_LCP_LEXICOGRAPHIC, /* cannot cycle */
    RB_LCP_FIRST_INDEX    /* can cycle on degenerate problems: for teaching and tests */
} rb_lcp_rule;

/* One pivot, as passed to the trace callback.  Variables are numbered w_0 .. w_{n-1} =
 * 0 .. n-1, z_0 .. z_{n-1} = n .. 2n-1, the artificial z0 = 2n. */
typedef struct {
    int pivot;             /* 0, 1, ... */
    int entering, leaving; /* variable numbers */
    int row;               /* row of the pivot in the tableau */
    double ratio, z0;      /* step length; z0 after the pivot */
    int attempt;           /* options.attempt */
    int n;                 /* order of the problem */
    const int *basis;      /* n: basic variable of each row, after the pivot; NULL for bimatrix
                              games; borrowed, like all arrays of this struct */
    const double *value;   /* n: the value of each basic variable */
    const int *nonbasis;   /* n + 1: variable of each column; NULL from "lemke-sparse",
                              which has no tableau */
    const double *tableau; /* n x (n + 2) column-major after the pivot: basic = last
                              column + columns times nonbasic; NULL unless
                              options.trace_tableau */
} rb_lcp_pivot;

typedef void rb_lcp_trace(const rb_lcp_pivot *pivot, void *context);

typedef struct {
    int max_iters;       /* 0: 50 n + 1000 pivots; newton: 10 n + 100 steps; games: by work */
    double seconds;      /* time limit; 0: none */
    const double *cover; /* n: covering vector d >= 0, > 0 where q < 0; NULL: ones;
                            borrowed */
    const double *start; /* "newton" and "lemke-sparse", n: the z of a similar problem; z_i is basic
                            at the start if start_i lies between its bounds.  NULL: newton starts
                            with the z_i of q_i < 0 basic, lemke-sparse with none; borrowed */
    rb_lcp_rule rule;
    rb_lcp_trace *trace; /* NULL: none */
    void *trace_context;
    int attempt;       /* passed on to trace, so that the caller can tell several problems apart
                        */
    int trace_tableau; /* 1: pass the whole tableau to trace (slow) */
} rb_lcp_options;

/* What a solver reports.  Functions with an info argument also accept NULL. */
typedef struct {
    const char *solver; /* the solver that found z: static text, NULL if no solver ran */
    int iters;          /* pivots; newton: linear systems; auto: sum over all methods */
    double res;         /* max |min(z, Mz + q)|, recomputed from z alone */
    double scaled;      /* max of |min(z_i, w_i)| / (|M| |z| + |q|)_i of the equilibrated
                           problem; decides whether it is solved */
    int row;            /* the row of `scaled`; -1: none */
    int ray_variable;   /* RB_RAY: the entering variable that no row blocks; else -1 */
    int label;          /* games: the strategy with which the path begins; else -1 */
    rb_message msg;
} rb_lcp_info;

rb_lcp_options rb_lcp_defaults(void);

/* Lemke's method.  z: n, written (the last basic point if the problem is not solved). opt NULL:
 * defaults.  If the largest entries of rows or columns differ by a factor of more than 1024, this
 * and the other solvers work on the equilibrated R M C and R q, with diagonal R and C of powers of
 * two (Ruiz).  The default covering vector of ones is then used for the equilibrated problem.  The
 * trace receives values in the caller's units. RB_OK; RB_NO_SOLUTION: the ray at the end of the
 * path proves that M z + q >= 0 has no z >= 0; RB_RAY: a ray that proves nothing; RB_MAXITER,
 * RB_TIME_LIMIT; RB_NUMERICAL: rounding errors have led the path back to its beginning;
 * RB_INACCURATE: info->scaled is above 1e-10 because of rounding errors; RB_EINVAL: n < 1, ldm < n,
 * NaN or infinity, an invalid covering vector; RB_ENOMEM. */
rb_status rb_lcp_lemke(const rb_lcp_problem *p, const rb_lcp_options *opt, double *z,
                       rb_lcp_info *info);

/* Block principal pivoting for sparse M: Newton's method on min(z, M z + q) = 0 with a
 * rule that makes it finite for every P-matrix.  It uses the options max_iters and start.
 * RB_OK, RB_MAXITER, RB_INACCURATE; RB_SINGULAR: a principal submatrix is singular, so
 * that M is not a P-matrix; RB_EINVAL: M not square, NaN or infinity; RB_ENOMEM. */
rb_status rb_lcp_newton(const rb_sparse *M, const double *q, const rb_lcp_options *opt, double *z,
                        rb_lcp_info *info);

/* Solves with the named solver: "lemke"; "lemke-sparse", Lemke's method with a sparse LU
 * factorisation, for bounds, too; "newton"; NULL or "auto": a portfolio of methods.  "auto" chooses
 * a first method from the structure of M; if it does not finish soon, all methods continue
 * in turns.  info->solver names the method that found z, info->iters is the sum over all
 * methods, and max_iters limits each of them.  Rows that are dominated by their diagonal are
 * solved by sweeps (info->solver "gauss-seidel"), problems with bounds by newton as long as it
 * makes progress, then by Lemke's method, which "auto" also uses with a trace, a covering
 * vector or a rule.  If all fail, problems up to order 200 are decided by branching over linear
 * programs ("branching", whose choices count as iterations; 2e6 of them or 10 s at most, where
 * `seconds` is 0): it finds a solution or proves that there is none.  If that fails, too, z,
 * status and message are those of Lemke's method.  Statuses as for the single solvers;
 * RB_NO_SOLUTION: proved; RB_UNDECIDED: all choices were tried, but rounding errors leave some
 * open; RB_NUMERICAL also where M is definite or diagonally dominant, so that there is a
 * solution, but no path has found it; RB_EINVAL also for an unknown solver. */
rb_status rb_lcp_solve(const char *solver, const rb_lcp_mixed_problem *p, const rb_lcp_options *opt,
                       double *z, rb_lcp_info *info);

/* All solutions that belong to complementary bases, each once; where bases are singular,
 * and there may be infinitely many, one of each such basis at least. */
typedef struct {
    int n, count;
    double *z;           /* n x count; owned, as are the next two */
    int *singular_basis; /* count; 1: of a singular basis only, so that other solutions may lie
                            next to it */
    int *nearby;         /* count, NULL: none is; 1: a solution within rounding (1e-11 of the
                            terms), which is none of the numbers as they stand, or is not proved
                            to be one */
    int bases, singular; /* bases tried, and how many of them are singular */
    int undecided;       /* bases of which is not known whether they have a solution; where
                            it is 0 and count is 0 there is none */
    int sets;            /* games: maximal sets of equilibria; 0: not listed */
    int *set, *member;   /* sets + 1, set[sets]: set k has the solutions member[set[k]] ...
                            member[set[k + 1] - 1]; owned */
} rb_lcp_solutions;

/* lower, upper as in rb_lcp_mixed_problem.  seconds: time limit, 0: none.  Units of rows and
 * columns do not matter.  Of a singular basis B a linear program asks whether q is in the
 * cone of [I_N, -M_B]: then it has a solution, or else Farkas' lemma excludes it.
 * RB_TIME_LIMIT: `all` has what the bases so far have given; RB_EINVAL: more than 2^22
 * bases (order 22 for the LCP), crossed bounds, NaN or infinity in M or q; RB_ENOMEM. */
rb_status rb_lcp_enumerate(const rb_lcp_problem *p, const double *lower, const double *upper,
                           double seconds, rb_lcp_solutions *all, rb_message *why);
void rb_lcp_solutions_free(rb_lcp_solutions *all);

/* What is proved of a solution (docs/proof.md): the problem with exactly these numbers has a
 * solution, and each z_i of it lies within error_i of z_i. */
typedef enum { RB_LCP_AT_BOUND, RB_LCP_BASIC, RB_LCP_UNDECIDED } rb_lcp_pair;

typedef struct {
    int n, proved;
    const char *reason;   /* why not; "": proved; static text */
    int row;              /* the first row or unknown whose sign is not proved; -1: none */
    double *z, *error;    /* n; owned */
    int *state;           /* n: rb_lcp_pair; owned */
    int undecided;        /* pairs of which is open whether z_i is 0 or inside its bounds */
    int isolated;         /* 1: no other solution lies near, apart from parts of z that w does not
                             notice: w, and for contact tractions, gaps and slips, are isolated */
    double bound;         /* max error_i / max |z| */
    double stored_within; /* the z given: within this part of max |z| of that solution */
    double nearby;        /* the z given, within its bounds, solves a problem exactly whose q_i
                             differ from these by at most this part of (|M| |z| + |q|)_i */
    double margin;        /* the least unknown or w_i > 0, as a multiple of its error */
    double norm;          /* max row sum of |I - R A|; below 0.99 the basis is regular */
    double least_sum; /* what sum (z - lower), over the z without an upper bound, is proved to be
                         at least in every solution: infinite: there is no solution; 0: nothing
                         is proved, or not looked at */
} rb_lcp_proof;

/* Proves that there is a solution with the signs of z, or of a z near to it, which may come from
 * any solver.  RB_OK: proved; RB_UNDECIDED: not proved, see proof->reason; RB_INTERRUPTED;
 * RB_EINVAL: M not square, NaN or infinity; RB_ENOMEM.  No tolerance decides anything.  Needs dense
 * matrices of the unknowns inside their bounds, 4000 at most.  Free the proof. */
rb_status rb_lcp_prove(const rb_lcp_mixed_problem *p, const double *z, rb_lcp_proof *proof);
void rb_lcp_proof_free(rb_lcp_proof *proof);

/* w = M z + q and max_i |min(z_i, w_i)|; w: n or NULL. */
double rb_lcp_residual(const rb_lcp_problem *p, const double *z, double *w);
/* The same for the mixed problem: max_i |max(min(z_i - lower_i, w_i), z_i - upper_i)|; w: n. */
double rb_lcp_residual_mixed(const rb_lcp_mixed_problem *p, const double *z, double *w);

RB_PUBLIC_END

#endif
