/* Frictional contact problems on second-order cones, in two and three dimensions.
 * References: *Acary* (2017) and *Kanno*, docs/friction.md. */
#ifndef ROLLBEM_FRICTION_H
#define ROLLBEM_FRICTION_H

#include "rollbem/base.h"
#include "rollbem/contact.h"
#include "rollbem/sparse.h"

RB_PUBLIC_BEGIN

/* ---- The problem ------------------------------------------------------------------- */

/* Per contact [N, T] (d = 2) or [N, T1, T2] (d = 3), N first: m = d n_c.
 * uhat = u + mu ||u_T|| e_N;  K* contains uhat, complementary to r in the cone
 * K = {||r_T|| <= mu r_N}.
 * Global form: K v = H r + f, u = H' v + w; K symmetric, may be singular.
 * Local form: u = W r + q, W dense or sparse. */
typedef enum {
    RB_FRICTION_LOCAL_DENSE,
    RB_FRICTION_LOCAL_SPARSE,
    RB_FRICTION_GLOBAL
} rb_friction_form;

typedef struct {
    rb_friction_form form;
    int dimension;   /* d: 2 or 3 */
    int contacts;    /* n_c */
    double *mu;      /* n_c, >= 0; owned, as all arrays here */
    double *W;       /* LOCAL_DENSE: m x m column-major */
    rb_sparse Ws;    /* LOCAL_SPARSE: m x m */
    double *q;       /* local: m */
    int dofs;        /* GLOBAL: n */
    rb_sparse K;     /* n x n, both triangles */
    rb_sparse H;     /* n x m */
    double *f;       /* n */
    double *w;       /* m */
    double *lengths; /* NULL, or n_c / 2: of rb_friction_split_rolling */
} rb_friction_problem;

void rb_friction_problem_free(rb_friction_problem *problem);

/* Where a solution stands; borrowed. */
typedef struct {
    double *r, *u; /* m */
    double *v;     /* n: global form; or NULL */
} rb_friction_solution;

/* RB_EINVAL, with the place in why: dimension other than 2 or 3, no contact, sizes that
 * differ, mu < 0, NaN or infinity, unsymmetric K. */
rb_status rb_friction_problem_check(const rb_friction_problem *problem, rb_message *why);

/* Condenses the global form to W = H' K^-1 H, q = w + H' K^-1 f; W is stored sparse where
 * bodies are unconnected.  RB_SINGULAR: K has no inverse; why names its nullity. */
rb_status rb_friction_condense(const rb_friction_problem *global,
                               rb_friction_problem *local, rb_message *why);

/* Bilateral constraints, eliminated: the problem becomes one without them, of the same r
 * and u.  Global: K v = H r + G l + f, u = H' v + w, G' v + b = 0 (G: n x c, b: c); of v
 * n - rank(G) motions are left.  Local: u = W r + V l + q, V' r + R l + s = 0 (V: m x c,
 * R: c x c, s: c); W becomes sparse.  Redundant constraints drop out.  RB_EINVAL, with
 * the reason in why and the problem as it was: sizes that differ, NaN or infinity,
 * constraints that contradict each other, or that leave no motion or more than l
 * undetermined. */
rb_status rb_friction_eliminate(rb_friction_problem *global, const rb_sparse *G,
                                const double *b, rb_message *why);
rb_status rb_friction_eliminate_local(rb_friction_problem *local, const rb_sparse *V,
                                      const rb_sparse *R, const double *s,
                                      rb_message *why);

/* Rolling friction, global form, dimension 5: [N, T1, T2, M1, M2] per contact,
 * ||r_T|| <= mu r_N and ||m|| <= mu_r r_N, slip against r_T and the relative rate of turn
 * against m.  The problem becomes one of 2 n_c contacts in three dimensions and n + n_c
 * motions (src/friction/rolling.c says how), which every solver takes.  mu_r: n_c,
 * [length]. RB_EINVAL: what rb_friction_problem_check refuses, mu_r < 0; RB_ENOMEM. */
rb_status rb_friction_split_rolling(rb_friction_problem *problem, const double *mu_r,
                                    rb_message *why);
/* r and u (3 contacts) of such a problem as forces and velocities, five per rolling
 * contact, written; they may be r and u themselves. */
void rb_friction_unite_rolling(const rb_friction_problem *problem, const double *r,
                               const double *u, double *force, double *velocity);

/* What is worth knowing of a problem before solving it. */
typedef struct {
    int rank;           /* of H (global) or W (local) */
    int hyperstaticity; /* d n_c - rank */
    int nullity;        /* of K (global); 0 else */
    double asymmetry;   /* max |W - W'| / max |W|; 0 for the global form */
    int indefinite;     /* 1: the symmetric part of W has a negative eigenvalue below
                           -1e-10 of the largest entry; 0 for the global form */
} rb_friction_facts;

/* with_rank 0: ranks and nullity, which cost a QR, are left at 0. */
rb_status rb_friction_examine(const rb_friction_problem *problem, int with_rank,
                              rb_friction_facts *facts);

/* ---- Files ------------------------------------------------------------------------- */

typedef enum {
    RB_FRICTION_FILE_ANY,     /* told by the head of the file */
    RB_FRICTION_FILE_FCLIB,   /* HDF5 */
    RB_FRICTION_FILE_SICONOS, /* text: d, n_c, W, q, mu; or, where only that fits to
                                 the end of the file, as SICONOS_GLOBAL */
    RB_FRICTION_FILE_SICONOS_SOCLCP, /* text: n, n_c, M, q, cones, slopes */
    RB_FRICTION_FILE_SICONOS_GLOBAL  /* text: d, n_c, M, H, q, b, mu */
} rb_friction_file;

/* What the head of a file tells.  RB_ENOENT; RB_EFORMAT: none of them. */
rb_status rb_friction_file_kind(const char *path, rb_friction_file *kind,
                                rb_message *why);

/* RB_ENOENT; RB_EFORMAT: not a friction problem, or one that rb_friction_problem_check
 * refuses. */
rb_status rb_friction_read(const char *path, rb_friction_problem *problem,
                           rb_message *why);
/* As `kind` whatever the head tells (ANY: as rb_friction_read). */
rb_status rb_friction_read_as(const char *path, rb_friction_file kind,
                              rb_friction_problem *problem, rb_message *why);

/* As FCLib (HDF5); solution: to go with it, where it is not NULL.  RB_EWRITE;
 * RB_EINVAL: rolling friction. */
rb_status rb_friction_write(const char *path, const rb_friction_problem *problem,
                            const rb_friction_solution *solution, const char *title,
                            rb_message *why);

/* ---- Measure of error -------------------------------------------------------------- */

/* residual: equation (13) of *Acary*, rho = 1: ||r - P_K(r - uhat)|| / ||q|| (||F||
 * itself where q = 0), which adds forces to velocities and so depends on units. scaled:
 * what decides whether a problem is solved, (13) with rho_c = 1/W_NN of each contact's
 * own block, in units of velocity: || (r - P_K(r - rho_c uhat)) / rho_c || /
 * ||q||.  Multiplying W, q, lengths or masses by constants does not change it.  Global
 * form: W_NN is estimated from diag(K).
 * floor: what rounding of the data allows of both. */
typedef struct {
    double residual, scaled, floor;
} rb_friction_errors;

/* u is recomputed from r; global form: from K v = H r + f; where K is singular, from v,
 * see docs/friction.md.  v: n, global form only, else NULL; u: m, written, or NULL. */
rb_status rb_friction_error(const rb_friction_problem *problem, const double *r,
                            const double *v, double *u, rb_friction_errors *error);

/* ---- Solvers ----------------------------------------------------------------------- */

/* An iterate whose error was measured. */
typedef struct {
    const char *solver;
    int iters;           /* of this solver so far; of auto: of this member */
    double flops, error; /* likewise; scaled measure */
    const double *r;     /* m */
} rb_friction_progress;

/* Which of the two residuals decides. */
typedef enum {
    RB_FRICTION_BY_SCALED, /* rho = 1/W_NN of each contact */
    RB_FRICTION_BY_ACARY   /* (13), rho = 1 */
} rb_friction_measure_name;

typedef struct {
    double tol; /* on the measure that decides; default 1e-8 */
    rb_friction_measure_name measure;
    int max_iters;    /* of the whole call, every part of a solver that runs others
                         counted; 0: the solver's own limit */
    double seconds;   /* time limit; 0: none */
    const double *r0; /* m: start; NULL: zero; borrowed */
    const double *v0; /* n: start of the global form with singular K; NULL: zero */
    /* NULL, or called with every iterate measured; other than 0: the call ends with
     * RB_INTERRUPTED. */
    int (*progress)(const rb_friction_progress *at, void *context);
    void *context;
} rb_friction_options;

typedef struct {
    const char *solver; /* that gave the answer; static text */
    int iters;          /* Newton steps, sweeps, pivots */
    double residual;    /* as in rb_friction_errors, recomputed from r (and v) alone */
    double scaled;      /* likewise; decides unless (13) was asked for */
    rb_friction_measure_name measure; /* which of them decides */
    double floor;
    double flops; /* floating-point operations, docs/friction.md says how counted */
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
    int needs;                            /* rb_friction_needs, or-ed */
    const struct rb_friction_method *run; /* how it is run: private, as the variant */
    int variant;
} rb_friction_solver;

/* The solvers, auto first; count: written. */
const rb_friction_solver *rb_friction_solvers(int *count);
/* NULL: there is none of that name. */
const rb_friction_solver *rb_friction_solver_named(const char *name);

rb_friction_options rb_friction_defaults(void);

/* The residual that decides. */
double rb_friction_deciding(const rb_friction_info *info);
/* 1, with a sentence, where a problem is solved in the scaled measure and (13) is above
 * the tolerance and the floor. */
int rb_friction_note(double tol, const rb_friction_info *info, rb_message *note);

/* solver NULL: "auto".  opt NULL: defaults.  solution: r, u and, unless it is NULL, v are
 * written; the best iterate when not solved.  RB_OK: the measure that decides is at most
 * max(tol, floor). RB_MAXITER, RB_RAY, RB_SINGULAR, RB_INACCURATE, RB_INTERRUPTED (time
 * limit): not solved. RB_EINVAL: unknown solver, problem refused by
 * rb_friction_problem_check or by the solver; info->msg says which.  info: written, or
 * NULL. */
rb_status rb_friction_solve(const char *solver, const rb_friction_problem *problem,
                            const rb_friction_options *opt,
                            const rb_friction_solution *solution, rb_friction_info *info);

/* The solvers for rolling contact (rb_rolling_case, rb_case_use_cone_solvers). */
const rb_contact_cone_solvers *rb_friction_cone_solvers(void);
/* A contact problem as one of these; borrows the arrays of the cone. */
rb_friction_problem rb_friction_of_cone(const rb_contact_cone *cone);

/* A proof that a problem in local form has no solution: y (contacts, written) >= 0 with
 * y'q_N < 0 and -W_N'y in K* (W_N: the rows of the normal velocities), so that no r in K
 * leaves all u_N >= 0.  Rounding leaves -W_N'y a little outside K*; *least: what sum W_NN
 * r_N of every solution is at least therefore (the mean of
 * all compliances in place of W_NN where that vanishes).  INFINITY: there is none; 0: y
 * proves nothing. RB_EINVAL: global form; RB_ENOMEM. */
rb_status rb_friction_infeasible(const rb_friction_problem *local, double *y,
                                 double *least);
/* 1 where it is proved so of a problem of either form: what any solution needs is beyond
 * all proportion to the velocities that are given, whose sum is *given. */
int rb_friction_has_no_solution(const rb_friction_problem *problem, double *least,
                                double *given);

/* ---- One structure, many loads ----------------------------------------------------- */

/* Keeps what depends on W, or K and H, alone: the factor of K, the condensed W, its
 * blocks.  Borrows the problem. */
typedef struct rb_friction_handle rb_friction_handle;

/* As rb_friction_solve: RB_EINVAL, RB_SINGULAR with the reason in why. */
rb_status rb_friction_setup(const rb_friction_problem *problem,
                            rb_friction_handle **handle, rb_message *why);
/* To be called after the problem's q, or f and w, or mu have changed; W, K and H must be
 * what they were. */
rb_status rb_friction_update(rb_friction_handle *handle, rb_message *why);
/* As rb_friction_solve; opt->r0 NULL: starts from the last solution, if there is one. */
rb_status rb_friction_handle_solve(rb_friction_handle *handle, const char *solver,
                                   const rb_friction_options *opt,
                                   const rb_friction_solution *solution,
                                   rb_friction_info *info);
void rb_friction_handle_free(rb_friction_handle *handle);

/* ---- Performance profiles (Dolan and More) ----------------------------------------- */

/* cost[p + s * problems]: of solver s on problem p, INFINITY where it failed. rho_s(tau),
 * *Acary* (16): share of the problems on which the cost is at most tau times the least
 * one; problems that nobody solved count.  rho: taus x solvers, written. */
void rb_friction_profile(int problems, int solvers, const double *cost, int taus,
                         const double *tau, double *rho);

/* ---- The canonical SOCLCP, *Kanno* (1) --------------------------------------------- */

/* y = M x + q, x and y in a product of cones, x'y = 0.  Borrowed. */
typedef struct {
    int n;           /* sum of the sizes */
    const double *M; /* n x n column-major */
    const double *q; /* n */
    int cones;
    const int
        *size; /* cones: k > 1 the Lorentz cone {x_0 >= ||x_1 ...||}, 1 a half-line */
} rb_friction_soclcp_problem;

/* The same, owning its arrays.  Cones of slope tau in a file, ||x_1|| <= tau x_0, are
 * brought to slope 1: x_0 is tau times, y_0 1/tau times what the file means. */
typedef struct {
    rb_friction_soclcp_problem problem;
    double *M, *q;
    int *size;
    double *tau; /* cones */
} rb_friction_soclcp_data;

rb_status rb_friction_soclcp_read(const char *path, rb_friction_soclcp_data *data,
                                  rb_message *why);
void rb_friction_soclcp_data_free(rb_friction_soclcp_data *data);

/* Smoothing and regularisation (Hayashi, Yamashita, Fukushima).  opt->r0: start x.  x, y:
 * n, written.  info->residual: ||x - P(x - y)|| / ||q||, recomputed from x;
 * info->scaled, which decides: the same with y and q in units of x (over the mean of M's
 * diagonal).  info may be NULL. */
rb_status rb_friction_soclcp(const rb_friction_soclcp_problem *problem,
                             const rb_friction_options *opt, double *x, double *y,
                             rb_friction_info *info);
/* y = M x + q and the residual. */
double rb_friction_soclcp_error(const rb_friction_soclcp_problem *problem,
                                const double *x, double *y);

/* "solved", "solved-to-rounding" (above tol, at or below the floor), or the words of s.
 */
const char *rb_friction_status_text(rb_status s, double tol,
                                    const rb_friction_info *info);

RB_PUBLIC_END

#endif
