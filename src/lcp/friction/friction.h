/* What programs use of the friction solvers besides rollbem/friction.h. */
#ifndef ROLLBEM_SRC_LCP_FRICTION_FRICTION_H
#define ROLLBEM_SRC_LCP_FRICTION_FRICTION_H

#include "lcp/contact/contact.h"
#include "base/sizes.h"
#include "base/sparse.h"
#include "rollbem/friction.h"

/* ---- The problem ------------------------------------------------------------------- */

/* Checks a problem.  RB_EINVAL: dimension other than 2 or 3, no contact, inconsistent
 * sizes, mu < 0, NaN or infinity, or K not symmetric; why names the place. */
rb_status rb_friction_problem_check(const rb_friction_problem *problem, rb_message *why);

/* Properties of a problem that help to choose a solver. */
typedef struct {
    int rank;           /* of H (global) or W (local) */
    int hyperstaticity; /* d n_c - rank */
    int nullity;        /* of K (global form); 0 otherwise */
    double asymmetry;   /* max |W - W'| / max |W|; 0 for the global form */
    int indefinite;     /* 1: the symmetric part of W has a negative eigenvalue below
                           -1e-10 of the largest entry; 0 for the global form */
} rb_friction_facts;

/* with_rank 0: ranks and nullity are not computed (they need a QR factorisation) and are
 * 0. */
rb_status rb_friction_examine(const rb_friction_problem *problem, int with_rank,
                              rb_friction_facts *facts);

/* Eliminates bilateral constraints: the new problem has none, and the same r and u.
 * Global: K v = H r + G l + f, u = H' v + w, G' v + b = 0 (G: n x c, b: c); n - rank(G)
 * unknowns v remain.  Local: u = W r + V l + q, V' r + R l + s = 0 (V: m x c, R: c x c,
 * s: c); W becomes sparse.  Redundant constraints are dropped.  RB_EINVAL leaves the
 * problem unchanged: inconsistent sizes, NaN or infinity, contradictory constraints, no
 * motion left, or more than l undetermined; why names the reason. */
rb_status rb_friction_eliminate(rb_friction_problem *global, const rb_sparse *G, const double *b,
                                rb_message *why);
rb_status rb_friction_eliminate_local(rb_friction_problem *local, const rb_sparse *V,
                                      const rb_sparse *R, const double *s, rb_message *why);

/* Rolling friction, global form, dimension 5: [N, T1, T2, M1, M2] per contact, ||r_T|| <=
 * mu r_N and ||m|| <= mu_r r_N, the slip is opposite to r_T and the relative angular
 * velocity opposite to m.  The problem is transformed into one with 2 n_c contacts in
 * three dimensions and n + n_c unknowns v (see src/lcp/friction/rolling.c), which every
 * solver accepts.  mu_r: n_c, [length].  RB_EINVAL: mu_r < 0, or an error of
 * rb_friction_problem_check; RB_ENOMEM. */
rb_status rb_friction_split_rolling(rb_friction_problem *problem, const double *mu_r,
                                    rb_message *why);
/* Converts r and u (3 contacts) of the transformed problem to forces and velocities, five
 * per rolling contact.  force and velocity may be the same arrays as r and u. */
void rb_friction_unite_rolling(const rb_friction_problem *problem, const double *r, const double *u,
                               double *force, double *velocity);

/* ---- Files ------------------------------------------------------------------------- */

typedef enum {
    RB_FRICTION_FILE_ANY,            /* determined from the beginning of the file */
    RB_FRICTION_FILE_FCLIB,          /* HDF5 */
    RB_FRICTION_FILE_SICONOS,        /* text: d, n_c, W, q, mu; read as SICONOS_GLOBAL if only
                                        that format fits the whole file */
    RB_FRICTION_FILE_SICONOS_SOCLCP, /* text: n, n_c, M, q, cones, slopes */
    RB_FRICTION_FILE_SICONOS_GLOBAL  /* text: d, n_c, M, H, q, b, mu */
} rb_friction_file;

/* Determines the format from the beginning of the file.  RB_ENOENT; RB_EFORMAT: none of
 * these formats. */
rb_status rb_friction_file_kind(const char *path, rb_friction_file *kind, rb_message *why);

/* Reads the file in the format `kind`, whatever its beginning looks like (ANY: as
 * rb_friction_read). */
rb_status rb_friction_read_as(const char *path, rb_friction_file kind, rb_friction_problem *problem,
                              rb_message *why);

/* ---- Solvers ----------------------------------------------------------------------- */

/* The solver of this name, or NULL. */
const rb_friction_solver *rb_friction_solver_named(const char *name);

/* The residual in the chosen measure. */
double rb_friction_deciding(const rb_friction_info *info);

/* Returns 1 and writes a note if the problem is solved in the scaled measure while (13)
 * is above the tolerance and the floor. */
int rb_friction_note(double tol, const rb_friction_info *info, rb_message *note);

/* "solved", "solved-to-rounding" (above tol, at or below the floor), or
 * rb_status_text(s). */
const char *rb_friction_status_text(rb_status s, double tol, const rb_friction_info *info);

/* The solver of this name for rolling contact (rb_rolling_case, rb_case_use_cone_solvers);
 * borrows the name. */
rb_contact_cone_solver rb_friction_cone_solver(const char *name);
/* Converts a contact problem to a problem of this header; borrows the arrays of the
 * cone. */
rb_friction_problem rb_friction_of_cone(const rb_contact_cone *cone);

/* Searches for a proof that a problem in local form has no solution: a vector y >= 0 (one
 * entry per contact, written) with y'q_N < 0 and -W_N'y in K* (W_N: the rows of the
 * normal velocities).  If it exists, no r in K makes all u_N >= 0.  With rounding errors
 * -W_N'y lies slightly outside K*; y then proves that sum W_NN r_N of every solution is
 * at least *least (with the mean of all compliances instead of W_NN where that vanishes).
 * *least is INFINITY if there is no solution and 0 if y proves nothing. RB_EINVAL: global
 * form; RB_ENOMEM. */
rb_status rb_friction_infeasible(const rb_friction_problem *local, double *y, double *least);
/* Returns 1 if a problem of either form is proved to have no solution: such a y was found,
 * and neither the sums that must vanish nor the signs of the others owe anything to
 * rounding.  Otherwise every solution has a sum W_NN r_N of at least *least, which may be
 * 0; *given: the sum of the moduli of q. */
int rb_friction_has_no_solution(const rb_friction_problem *problem, double *least, double *given);
/* *floats = 1: a problem in global form is proved to have no equilibrium, because nothing holds
 * it: a motion z with z'K = 0 that no contact resists, (H'z)_c in K*, and that the forces drive,
 * z'f > 0, without rounding.  0: not proved.  RB_OK, RB_ENOMEM. */
rb_status rb_friction_floats(const rb_friction_problem *global, int *floats);

/* ---- Proofs (docs/proof.md) ----------------------------------------------------------- */

/* What is proved of reactions: the problem with exactly these numbers (global: the condensed one)
 * has a solution in whose zones all inequalities are strict. */
typedef struct {
    int proved;
    const char *reason; /* why not; "": proved; static text */
    int contact;        /* the first one of which an inequality is not proved; -1: none */
    int condensed;      /* 1: of the condensed problem, whose coefficients are rounded */
    int zones[4];       /* contacts that are separated, stick, slip, and closed without friction */
    int touching;       /* separated ones with u_N = 0 exactly: they are not isolated */
    int isolated;       /* 1: no other solution lies near */
    double bound;       /* of |r_i - r_i of the solution|, as a part of max |r| */
    double stored_within; /* the same of the r given */
    double nearby;        /* the r given, zero where contacts are separated, solve exactly a problem
                             whose q, as parts of (|W| |r| + |q|)_i, and mu differ by at most this */
    double margin;        /* the least r_N, u_N or slip as a multiple of its error */
    double norm;          /* of the active equations: below 0.99 they are regular */
} rb_friction_proof;

/* r: of any solver.  RB_OK: proved; RB_UNDECIDED: not proved; RB_EINVAL: no finite numbers;
 * RB_SINGULAR: K is singular; RB_INTERRUPTED, RB_ENOMEM. */
rb_status rb_friction_prove_zones(const rb_friction_problem *problem, const double *r,
                                  rb_friction_proof *proof, rb_message *why);

/* ---- All solutions in two dimensions ------------------------------------------------- */

/* States of a contact; bits of rb_friction_solutions.states.  mu = 0: a closed contact has the
 * name STICK. */
typedef enum {
    RB_FRICTION_OPEN,       /* r = 0, u_N >= 0 */
    RB_FRICTION_STICK,      /* u = 0, |r_T| <= mu r_N */
    RB_FRICTION_SLIP_PLUS,  /* u_N = 0, u_T >= 0, r_T = -mu r_N */
    RB_FRICTION_SLIP_MINUS, /* u_N = 0, u_T <= 0, r_T = mu r_N */
    RB_FRICTION_STATES
} rb_friction_state;

/* The number, from 1 on, of the first contact of a local form with W_NN < mu ||W_NT||, where
 * pushing a contact that slips opens it: there may be several solutions.  0: none. */
int rb_friction_may_have_several(const rb_friction_problem *problem);

/* ---- Performance profiles (Dolan and More) ----------------------------------------- */

/* cost[p + s * problems]: cost of solver s on problem p, INFINITY if it failed.
 * rho_s(tau), *Acary* (16): fraction of the problems that solver s solves at a cost of at
 * most tau times the smallest cost of all solvers.  Problems that no solver solves are
 * counted in the total.  rho: taus x solvers, written. */
void rb_friction_profile(int problems, int solvers, const double *cost, int taus, const double *tau,
                         double *rho);

/* ---- The canonical SOCLCP (rollbem/friction.h) from a file ------------------------- */

/* An rb_friction_soclcp_problem with its own arrays.  Cones of slope tau in a file, ||x_1|| <= tau
 * x_0, are scaled to slope 1: x_0 is tau times and y_0 1/tau times the value of the file. */
typedef struct {
    rb_friction_soclcp_problem problem;
    double *M, *q;
    int *size;
    double *tau; /* cones */
} rb_friction_soclcp_data;

rb_status rb_friction_soclcp_read(const char *path, rb_friction_soclcp_data *data, rb_message *why);
void rb_friction_soclcp_data_free(rb_friction_soclcp_data *data);

/* y = M x + q and the residual. */
double rb_friction_soclcp_error(const rb_friction_soclcp_problem *problem, const double *x,
                                double *y);

#endif
