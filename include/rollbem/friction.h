/* Frictional contact problems on second-order cones, in two and three dimensions.
 * References: *Acary* (2017) and *Kanno*, docs/friction.md. */
#ifndef ROLLBEM_FRICTION_H
#define ROLLBEM_FRICTION_H

#include "rollbem/base.h"
#include "rollbem/contact.h"
#include "rollbem/sparse.h"

RB_PUBLIC_BEGIN

/* ---- The problem ------------------------------------------------------------------- */

/* Each contact has d components [N, T] (d = 2) or [N, T1, T2] (d = 3), so m = d n_c.
 * Force r in the cone K = {||r_T|| <= mu r_N}, uhat = u + mu ||u_T|| e_N in the dual cone
 * K*, r'uhat = 0. Global form: K v = H r + f, u = H' v + w; K symmetric, may be singular.
 * Local form: u = W r + q, W dense or sparse. */
typedef enum {
    RB_FRICTION_LOCAL_DENSE,
    RB_FRICTION_LOCAL_SPARSE,
    RB_FRICTION_GLOBAL
} rb_friction_form;

typedef struct {
    rb_friction_form form;
    int dimension;    /* d: 2 or 3 */
    int contacts;     /* n_c */
    double *mu;       /* n_c, >= 0; owned, like all arrays here */
    double *W;        /* LOCAL_DENSE: m x m column-major */
    rb_sparse Ws;     /* LOCAL_SPARSE: m x m */
    double *q;        /* local: m */
    int dofs;         /* GLOBAL: n */
    rb_sparse K;      /* n x n, both triangles */
    rb_sparse H;      /* n x m */
    double *f;        /* n */
    double *w;        /* m */
    double *lengths;  /* NULL; of a file's rolling friction n_c / 2 lengths mu_r */
    double asymmetry; /* of a file's K, of which K is the symmetric part: max |K - K'| / max |K|;
                         0: it is symmetric to 1e-8 */
} rb_friction_problem;

void rb_friction_problem_free(rb_friction_problem *problem);

/* The arrays of a solution; borrowed. */
typedef struct {
    double *r, *u; /* m */
    double *v;     /* n: global form; or NULL */
} rb_friction_solution;

/* Condenses the global form to W = H' K^-1 H, q = w + H' K^-1 f; W is stored as a sparse matrix if
 * there are unconnected bodies.  RB_SINGULAR: K is singular; why names its nullity. */
rb_status rb_friction_condense(const rb_friction_problem *global, rb_friction_problem *local,
                               rb_message *why);

/* ---- Files ------------------------------------------------------------------------- */

/* Reads a problem.  RB_ENOENT; RB_EFORMAT: the file holds no friction problem, or an invalid one.
 */
rb_status rb_friction_read(const char *path, rb_friction_problem *problem, rb_message *why);

/* Writes the problem as an FCLib file (HDF5), with the solution unless that is NULL.
 * RB_EWRITE; RB_EINVAL: rolling friction. */
rb_status rb_friction_write(const char *path, const rb_friction_problem *problem,
                            const rb_friction_solution *solution, const char *title,
                            rb_message *why);

/* ---- Measure of error -------------------------------------------------------------- */

/* scaled: the measure that decides whether a problem is solved.  With rho_c = 1/W_NN of the
 * diagonal block of each contact, (r_c / rho_c, u_c) is a point whose coordinates are velocities;
 * Coulomb's law allows those with r = 0 and u_N >= 0, with u = 0 and r in K, or with u_N = 0 and r
 * on the face of K opposite to u_T.  scaled is the norm over all contacts of the distances from
 * these points, over ||q||.  Before, contacts are scaled by powers of two such that no W_NN is more
 * than twice or less than half of the first one: units of single contacts do not change it.  Global
 * form: W_NN is estimated from diag(K). worst: the largest distance of one contact, its number in
 * `contact` (-1: none), as a part of its own velocities |W| |r| + |q| and |r| / rho, but at least
 * of 1e-4 ||q||; "solved" needs both.  residual: equation (13) of *Acary*, ||r - P_K(r - uhat)|| /
 * ||q|| (||F|| itself where q = 0), which adds forces to velocities and therefore depends on units,
 * and divides penetrations by mu.  floor: the size that the measures can have because of rounding
 * errors of the data. */
typedef struct {
    double residual, scaled, floor, worst;
    int contact;
} rb_friction_errors;

/* Computes the errors of a solution.  u is recomputed from r (in the global form by K v =
 * H r + f, or from the given v if K is singular; see docs/friction.md).  v: n, global
 * form only, otherwise NULL; u: m, written, or NULL. */
rb_status rb_friction_error(const rb_friction_problem *problem, const double *r, const double *v,
                            double *u, rb_friction_errors *error);

/* ---- Solvers ----------------------------------------------------------------------- */

/* An iterate and its error, as passed to the progress callback. */
typedef struct {
    const char *solver;
    int iters;           /* of this solver so far; in "auto" of the method that runs */
    double flops, error; /* operations so far; error in the chosen measure */
} rb_friction_progress;

/* Which of the two residuals decides. */
typedef enum {
    RB_FRICTION_BY_SCALED, /* the distance from Coulomb's law */
    RB_FRICTION_BY_ACARY   /* (13), rho = 1 */
} rb_friction_measure_name;

typedef struct {
    double tol; /* tolerance for the chosen measure; default 1e-8 */
    rb_friction_measure_name measure;
    int max_iters;    /* of the whole call; a solver that runs other solvers counts the
                         iterations of all; 0: the default limit of the solver */
    double seconds;   /* time limit; 0: none */
    const double *r0; /* m: start; NULL: zero; borrowed */
    const double *v0; /* n: start of the global form with singular K; NULL: zero */
    /* NULL, or a function called for every iterate whose error is computed; if it does
     * not return 0, the solver stops with RB_INTERRUPTED. */
    int (*progress)(const rb_friction_progress *at, void *context);
    void *context;
} rb_friction_options;

typedef struct {
    const char *solver; /* the solver that found the answer; static text */
    int iters;          /* Newton steps, sweeps, pivots */
    double residual;    /* as in rb_friction_errors, recomputed from r (and v) alone */
    double scaled;      /* likewise; decides unless RB_FRICTION_BY_ACARY was chosen */
    double worst;       /* likewise, with scaled */
    int contact;        /* of `worst`, or -1 */
    rb_friction_measure_name measure; /* which of them decides */
    double floor;
    double flops; /* floating-point operations, counted as in docs/friction.md */
    double seconds;
    rb_message msg;
} rb_friction_info;

typedef enum {
    RB_FRICTION_NEEDS_W = 1, /* refuses the global form with singular K */
    RB_FRICTION_ONLY_2D = 2
} rb_friction_needs;

typedef struct {
    const char *name, *method;            /* method: the family it belongs to */
    const char *summary;                  /* one line of help */
    int needs;                            /* sum of rb_friction_needs */
    const struct rb_friction_method *run; /* private, like variant */
    int variant;
} rb_friction_solver;

/* The solvers, auto first; count: written. */
const rb_friction_solver *rb_friction_solvers(int *count);

rb_friction_options rb_friction_defaults(void);

/* solver NULL: "auto".  opt NULL: defaults.  solution: r, u and (unless NULL) v are written; if the
 * problem is not solved, they are the best iterate.  RB_OK: the residual in the chosen measure is
 * at most max(tol, floor), and below tol, in the scaled measure, so is that of every contact.
 * RB_MAXITER, RB_RAY, RB_SINGULAR, RB_INACCURATE, RB_INTERRUPTED (time limit): not solved.
 * RB_EINVAL: unknown solver, or the problem is invalid (sizes, mu < 0, NaN or infinity, K not
 * symmetric) or refused by the solver; info->msg has the reason. info: written, or NULL. */
rb_status rb_friction_solve(const char *solver, const rb_friction_problem *problem,
                            const rb_friction_options *opt, const rb_friction_solution *solution,
                            rb_friction_info *info);

/* ---- Complementarity problems on cones, *Kanno* (1) -------------------------------- */

/* y = M x + q, x and y in a product of cones, x'y = 0.  All arrays are borrowed. */
typedef struct {
    int n;           /* sum of the sizes */
    const double *M; /* n x n column-major */
    const double *q; /* n */
    int cones;
    const int *size; /* cones: size k > 1 is the Lorentz cone {x_0 >= ||x_1 ...||}, 1 a half-line */
} rb_friction_soclcp_problem;

/* Solves it by smoothing and regularisation (Hayashi, Yamashita, Fukushima).  opt NULL: defaults;
 * r0 is the start x; v0 and progress are not used.  x, y: n, written; if the problem is not solved,
 * they are the last iterate.  info->residual: ||x - P(x - y)|| / ||q||, recomputed from x;
 * info->scaled, which decides: the same after y and q are divided by the mean of |diag(M)|, which
 * gives them the unit of x.  Statuses as of rb_friction_solve; RB_EINVAL: the sizes are not n in
 * all, NaN or infinity in M or q; x and y are then not written.  info: written, or NULL. */
rb_status rb_friction_solve_soclcp(const rb_friction_soclcp_problem *problem,
                                   const rb_friction_options *opt, double *x, double *y,
                                   rb_friction_info *info);

/* ---- All solutions in two dimensions ------------------------------------------------- */

typedef struct {
    int contacts, count;
    double *r, *u;       /* 2 contacts x count; owned, as the next three */
    unsigned *states;    /* contacts x count: 1 << state; several bits where r lies on the
                            border between states */
    int *singular_state; /* count; 1: of states with a singular matrix only, so that other
                            solutions may lie next to it */
    int *nearby;         /* count; 1: within rounding only, as of rb_lcp_solutions */
    int tried, singular, undecided; /* states of all contacts together, as of rb_lcp_solutions */
} rb_friction_solutions;

/* All solutions of a plane problem with at most 8 contacts, each once: every state of every contact
 * is tried (4^contacts).  seconds: time limit, 0: none.  The global form is condensed first.
 * RB_TIME_LIMIT: what has been found so far; RB_EINVAL: dimension 3, in which their number need not
 * be finite, more contacts, or an invalid problem; RB_SINGULAR, RB_ENOMEM. */
rb_status rb_friction_all(const rb_friction_problem *problem, double seconds,
                          rb_friction_solutions *all, rb_message *why);
void rb_friction_solutions_free(rb_friction_solutions *all);

/* ---- One structure, many loads ----------------------------------------------------- */

/* Keeps everything that depends only on W, or on K and H: the factorisation of K, the
 * condensed W and its blocks.  Borrows the problem. */
typedef struct rb_friction_handle rb_friction_handle;

/* RB_EINVAL, RB_SINGULAR as for rb_friction_solve, with the reason in why. */
rb_status rb_friction_setup(const rb_friction_problem *problem, rb_friction_handle **handle,
                            rb_message *why);
/* Call it after you changed q, or f and w, or mu of the problem; W, K and H must be unchanged. */
rb_status rb_friction_update(rb_friction_handle *handle, rb_message *why);
/* As rb_friction_solve; opt->r0 NULL: starts from the last solution, if there is one. */
rb_status rb_friction_handle_solve(rb_friction_handle *handle, const char *solver,
                                   const rb_friction_options *opt,
                                   const rb_friction_solution *solution, rb_friction_info *info);
void rb_friction_handle_free(rb_friction_handle *handle);

RB_PUBLIC_END

#endif
