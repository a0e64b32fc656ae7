/* Declarations shared by the files of src/lcp/friction: the state of one solve, the measure,
 * W in blocks, the functions whose roots are solutions, and the linear systems of
 * Newton's steps. */
#ifndef ROLLBEM_FRICTION_INTERNAL_H
#define ROLLBEM_FRICTION_INTERNAL_H

#include "lcp/friction/friction.h"

/* ---- Problems (problem.c) ---------------------------------------------------------- */

/* RB_EINVAL: missing, wrong size, NaN or infinity; why names the place. */
/* max |A - A'| and max |A| */
rb_status rb_friction_sparse_asymmetry(const rb_sparse *a, double *difference, double *largest);
rb_status rb_friction_check_vector(const char *name, size_t n, const double *x, rb_message *why);
rb_status rb_friction_check_sparse(const char *name, const rb_sparse *a, int rows, int cols,
                                   rb_message *why);

/* ---- Cones (cone.c) ---------------------------------------------------------------- */

/* P_K(z), K = {||z_T|| <= mu z_N}; z and p: d entries, may be the same. */
void rb_friction_project(int d, double mu, const double *z, double *p);
/* Derivative of P_K at z (one element of the generalised one): d x d column-major. */
void rb_friction_project_derivative(int d, double mu, const double *z, double *D);
/* ||x_T|| of the d entries of one contact */
double rb_friction_tangential(int d, const double *x);
/* (13) of *Acary*: || r - P_K(r - u - mu ||u_T|| e_N) || over all contacts, of the forces
 * D r and the velocities u / D; unit: contacts, D, or NULL: ones. */
double rb_friction_acary_norm(const rb_friction_problem *problem, const double *unit,
                              const double *r, const double *u);
/* How far (r / rho, u) of a contact is away from what Coulomb's law allows, a velocity;
 * and the norm of these distances.  rho: every second entry, as rb_friction_rho writes
 * it. */
double rb_friction_law_distance(int d, double mu, double rho, const double *r, const double *u);
double rb_friction_law_norm(const rb_friction_problem *problem, const double *rho, const double *r,
                            const double *u);
/* ||r_c / rho_c|| over all contacts; work: m, written where squares could
 * overflow or underflow. */
double rb_friction_size(const rb_friction_problem *problem, const double *rho, const double *r,
                        double *work);
double rb_friction_norm(size_t n, const double *x);

/* ---- Units (rho.c) ----------------------------------------------------------------- */

/* 2 per contact, of its own block: W_NN and the largest eigenvalue of W_TT.  Global form:
 * estimated from diag(K). */
rb_status rb_friction_compliances(const rb_friction_problem *problem, double *own_block);
/* Their inverses, rho_n and rho_t; where the block is zero, that of the mean of all. */
rb_status rb_friction_rho(const rb_friction_problem *problem, double *rho);

/* ---- Contacts in units of their own (scaling.c) ------------------------------------- */

/* The problem that is solved: force D r and velocity u / D of each contact, D a power of
 * two that brings W_NN over that of the first contact into [1/2, 2).  Where all D are the
 * same it is the given problem. */
typedef struct {
    rb_friction_problem problem; /* borrows all but W, q, H and w where unit is not NULL */
    double *unit;                /* contacts: D, owned; NULL: the given problem */
} rb_friction_scaling;

rb_status rb_friction_scaling_init(const rb_friction_problem *given, rb_friction_scaling *scaling);
/* After q, or f and w, have changed. */
void rb_friction_scaling_reload(const rb_friction_problem *given, rb_friction_scaling *scaling);
void rb_friction_scaling_free(rb_friction_scaling *scaling);
/* r and u (m each, u NULL: none) of the given problem become those of the one that is
 * solved, and back. */
void rb_friction_scale(const rb_friction_scaling *scaling, double *r, double *u);
void rb_friction_scale_back(const rb_friction_scaling *scaling, double *r, double *u);

/* ---- Measure (measure.c) ----------------------------------------------------------- */

typedef struct {
    const rb_friction_problem *problem;
    const double *unit;         /* of its scaling, or NULL; borrowed */
    double scale;               /* ||q||, or 1 if q = 0 */
    double given_scale;         /* the same in the given units */
    rb_sparse_cholesky *factor; /* GLOBAL: factorisation of K, or of K + k H H' if K is singular */
    double spring;              /* k in the given units; 0 if K is regular */
    double *y;                  /* m, workspace; its memory also contains e, dv and rho */
    double *e, *dv;             /* n each, workspace */
    double *rho;                /* 2 per contact */
    double noise;               /* GLOBAL, K regular: the largest velocity of a contact that
                                   rounding has left in v, seen in its last correction */
    int acary;                  /* 1: (13) decides */
} rb_friction_measure;

rb_status rb_friction_measure_init(const rb_friction_scaling *scaling,
                                   rb_friction_measure *measure);
/* Call it after q, or f and w, have changed. */
rb_status rb_friction_measure_reload(rb_friction_measure *measure);
/* v: n, in the global form corrected to equilibrium with r, otherwise unused.  u: m,
 * written. paper NULL: scaled is the chosen measure; otherwise scaled and *paper are both
 * measures, the second being (13). */
rb_status rb_friction_measure_error(rb_friction_measure *measure, const double *r, double *v,
                                    double *u, double *scaled, double *paper);
/* The chosen measure of forces and velocities that belong together. */
double rb_friction_measure_of(const rb_friction_measure *measure, const double *r, const double *u);
/* The resolution of the measure for forces of the size of r: smaller values are
 * meaningless (for very large r the measure is exactly 0). */
double rb_friction_measure_resolution(const rb_friction_measure *measure, const double *r);
double rb_friction_measure_floor(const rb_friction_measure *measure, const double *r,
                                 const double *v);
/* The largest distance of one contact from its law, as a part of its own velocities: the
 * terms of its rows |W| |r| + |q| (global: |H'| |v| + |w|), its own |r| / rho, and at
 * least 1e-4 of ||q||; those that are noise count as zero.  contact: its number, or -1; may be
 * NULL. */
double rb_friction_measure_worst(const rb_friction_measure *measure, const double *r,
                                 const double *u, const double *v, int *contact);
/* Global form.  k of a row in the units of the problem that is solved. */
double rb_friction_measure_spring(const rb_friction_measure *measure, int row);
/* Global form.  v = K_k^-1 (H (r + k (u - w)) + f): the displacements that go with r and
 * u. */
rb_status rb_friction_measure_displacement(rb_friction_measure *measure, const double *r,
                                           const double *u, double *v);
/* Global form.  q = w + H' K_k^-1 (f - k H w) */
rb_status rb_friction_measure_spring_load(rb_friction_measure *measure, double *q);
void rb_friction_measure_free(rb_friction_measure *measure);

/* ---- W in d x d blocks (blocks.c) -------------------------------------------------- */

typedef struct {
    int d, contacts;
    int *p;    /* contacts + 1: where a block column starts */
    int *i;    /* block row, increasing within a column; the diagonal is always there */
    int *diag; /* contacts: number of the diagonal block */
    double *x; /* d x d column-major each; owns the memory of all */
} rb_friction_blocks;

rb_status rb_friction_blocks_init(const rb_friction_problem *local, rb_friction_blocks *blocks);
void rb_friction_blocks_free(rb_friction_blocks *blocks);
/* y += the velocities that the force x (d entries) of one contact causes */
void rb_friction_blocks_add(const rb_friction_blocks *blocks, int contact, const double *x,
                            double *y);
/* y += W x, y = W x; add_all returns how many blocks that took. */
int rb_friction_blocks_add_all(const rb_friction_blocks *blocks, const double *x, double *y);
void rb_friction_blocks_apply(const rb_friction_blocks *blocks, const double *x, double *y);

/* ---- The problem of one contact (local_contact.c) ---------------------------------- */

typedef struct {
    int d;
    double mu;
    const double *W; /* d x d column-major; borrowed */
    int regular;     /* 1: the normal direction can be eliminated, and the rest is positive
                        definite */
    double normal, row[2], column[2]; /* 1/W_NN; W_NT and W_TN over W_NN */
    double S[4];                      /* W_TT - W_TN W_NT / W_NN */
} rb_friction_contact;

void rb_friction_contact_init(int d, double mu, const double *W, rb_friction_contact *contact);
/* All return the number of steps.  q: velocity without the force of this contact; rho:
 * two values for the functions below.  exact: returns 0 and leaves r unchanged if the
 * contact is closed and not regular; lambda: -u_T / r_T of the last time it slid, or 0.
 * newton and fixed_point start at r; fixed_point adapts rho. */
int rb_friction_contact_exact(const rb_friction_contact *contact, double *lambda, const double *q,
                              double *r);
int rb_friction_contact_newton(const rb_friction_contact *contact, const double *rho,
                               const double *q, double *r);
int rb_friction_contact_fixed_point(const rb_friction_contact *contact, double *rho,
                                    const double *q, double *r);

/* The rule for rho (UPK): a step r -> p is taken when
 * rho ||uhat(p) - uhat(r)|| <= MOST ||p - r||; rho grows when even LEAST held. */
#define RB_FRICTION_UPK_MOST 0.9
#define RB_FRICTION_UPK_LEAST 0.3
#define RB_FRICTION_UPK_SHRINK (2.0 / 3.0)

/* ---- The state of one solve (task.c) ------------------------------------------------ */

/* Data shared by all methods that solve one problem. */
typedef struct {
    const rb_friction_problem *given; /* borrowed */
    rb_friction_scaling scaling;
    const rb_friction_problem *problem; /* the one that is solved: of scaling */
    const rb_friction_problem *local;   /* its local form; NULL: not condensed */
    rb_friction_problem condensed;      /* `local` points to it if W was not given */
    rb_friction_blocks blocks;          /* of local, computed at first use */
    rb_friction_contact *contact;       /* likewise; W NULL: this contact is not prepared yet */
    rb_friction_measure measure;        /* of problem */
    double *memory; /* m + 2 n: workspace for the record of a solve, and for v if the
                       caller passes NULL */
    int stop;       /* 1: the caller wants to stop */
} rb_friction_shared;

rb_status rb_friction_shared_init(const rb_friction_problem *problem, rb_friction_shared *shared,
                                  rb_message *why);
/* After q, or f and w, or mu have changed. */
rb_status rb_friction_shared_reload(rb_friction_shared *shared);
void rb_friction_shared_free(rb_friction_shared *shared);

/* The best iterate of all methods so far. */
typedef struct {
    double *r; /* m + n: r and v */
    double error;
    const char *solver;
} rb_friction_record;

typedef struct {
    rb_friction_shared *shared;
    const rb_friction_problem *problem; /* of shared, like the next one */
    rb_friction_measure *measure;
    rb_friction_record *best;
    rb_friction_options opt; /* r0 NULL: zero */
    rb_friction_info *info;
    int d, contacts, m, n; /* n: 0 for the local form */
    double deadline;       /* on rb_seconds(); 0: none */
    double beside;         /* of the systems, as rb_friction_system has it, in operations */
    double budget;         /* value of info->flops + beside at which a method pauses; INFINITY:
                              never */
    int proved;            /* 1: rb_friction_prove has accepted r */
    int tries;             /* so often a method pauses where the norm over all contacts is met, but
                              not that of a contact */
    int nearly;            /* 1: it has paused for that */
    rb_status measured;    /* status of the last computation of the error (RB_ENOMEM) */
    double *r, *u;         /* m: the iterate; start on entry */
    double *v;             /* n */
} rb_friction_task;

/* As rb_friction_condense; adds the operations to *flops. */
rb_status rb_friction_condense_counted(const rb_friction_problem *global,
                                       rb_friction_problem *local, double *flops, rb_message *why);
/* Approximate number of operations for condensing a global problem whose K has this
 * factorisation. */
rb_status rb_friction_condense_estimate(const rb_friction_problem *global,
                                        const rb_sparse_cholesky *factor, double *flops);
/* Condenses the task's problem at first use.  RB_SINGULAR: W does not exist. */
rb_status rb_friction_task_condense(rb_friction_task *task);
/* The blocks of the task's W; borrowed. */
rb_status rb_friction_task_blocks(rb_friction_task *task, const rb_friction_blocks **blocks);
/* Resets info.  Of the message only the first byte is set to zero, because it is long. */
void rb_friction_info_clear(rb_friction_info *info, const char *solver);
/* Sets r and v to the start given in the options. */
void rb_friction_task_start(rb_friction_task *task);
/* The single contacts of these blocks; each is prepared at first use, because many
 * contacts never close. */
rb_status rb_friction_task_contacts(rb_friction_task *task, rb_friction_contact **contacts);
/* Computes the measure at the task's r and v, updates u (and v), and stores the iterate
 * if it is the best so far; counts flops. */
double rb_friction_task_error(rb_friction_task *task);
/* Iterations that remain of the task's max_iters; with max_iters = 0 the method's limit
 * `own`. */
int rb_friction_task_left(const rb_friction_task *task, int own);
/* error at or below the tolerance or the floor */
int rb_friction_task_accepts(const rb_friction_task *task, double error);
/* 1: neither the budget nor the limit of iterations is used up. */
int rb_friction_task_goes_on(const rb_friction_task *task);
/* 1: the time limit has passed, or the caller wants to stop. */
int rb_friction_task_late(const rb_friction_task *task);
/* Status of the task's iterate with this error.  RB_OK: accepted; RB_MAXITER: not accepted
 * yet; RB_SINGULAR: not a finite number; RB_INACCURATE: not accepted, and `stands`: the
 * method changes it no more. */
rb_status rb_friction_task_status(rb_friction_task *task, double error, int stands);
/* The same after computing the error; RB_INTERRUPTED: time limit or stop. */
rb_status rb_friction_task_assess(rb_friction_task *task);
/* The relative change of an iterate at which the measure is worth another look, after one
 * with this change and error. */
double rb_friction_task_next_look(const rb_friction_task *task, double change, double error);
/* Records that the task's iterate has this error: stores the iterate if it is the best,
 * and calls the progress function. */
void rb_friction_task_seen(rb_friction_task *task, double error);
/* Recomputes the measures from r (and v) alone, and their floor, and stores them in info;
 * returns 1 if r is accepted. */
int rb_friction_prove(rb_friction_task *task);
/* Restores r, v and info->solver of the best iterate, if there is one. */
void rb_friction_task_recall(rb_friction_task *task);

/* ---- Functions whose roots are solutions (functions.c) ----------------------------- */

/* Cone and scaling of one contact: rho_n, rho_t > 0 [force/velocity]. */
typedef struct {
    int d;
    double mu, rho_n, rho_t;
} rb_friction_cone;

/* F(r, u) in units of force, A = dF/dr, B = dF/du (d x d column-major), all written. */
typedef struct {
    double *F, *A, *B;
} rb_friction_linearised;

typedef void rb_friction_function(const rb_friction_cone *cone, const double *r, const double *u,
                                  const rb_friction_linearised *at);

rb_friction_function rb_friction_alart_curnier; /* (8) of *Acary* */
rb_friction_function rb_friction_jean_moreau;   /* (9) */
rb_friction_function rb_friction_natural_map;   /* (10) */
rb_friction_function rb_friction_fischer_burmeister;

/* ---- Linear systems of Newton's steps (system.c) ----------------------------------- */

/* Local form:  (A + B W) dr = -F.
 * Global form: K dv - H dr = -e,  B H' dv + A dr = -F: one sparse system, no W. */
typedef struct {
    const rb_friction_problem *problem;
    const rb_friction_blocks *blocks; /* local form; borrowed from the task */
    int d, contacts, m, n;            /* n: 0 for the local form */
    double *rho;                      /* 2 per contact: rho_n, rho_t, 1/(W's own block) */
    double *rhs, *x;                  /* n + m */
    int *place;  /* contacts: number among the contacts that may be closed, -1 if open */
    rb_sparse j; /* sparse LU: the matrix (local form), or its transposed (global) */
    rb_sparse_lu *lu;
    double *dense; /* dense LU */
    int *pivots;
    size_t order; /* order for which memory is allocated */
    double flops;
    double beside; /* the operations that a sweep could make in the time that sparse LUs take
                      beside theirs: for searching pivots and moving entries */
} rb_friction_system;

/* n: the task's; 0: the local form, also if the problem is global and W has been condensed. */
rb_status rb_friction_system_init(rb_friction_task *task, int n, rb_friction_system *system);
void rb_friction_system_free(rb_friction_system *system);
/* u = W r + q, or H' v + w; constant 0 leaves q and w out (changes of u). */
void rb_friction_system_velocity(const rb_friction_system *system, double constant, const double *r,
                                 const double *v, double *u);
/* e = K v - H r - f; nothing for the local form */
void rb_friction_system_imbalance(const rb_friction_system *system, const double *r,
                                  const double *v, double *e);
/* Operations that the first step may take, with those beside, from the pattern of its matrix alone.
 */
rb_status rb_friction_system_estimate(rb_friction_system *system, double *flops);
/* Adds to the task's what the system has counted since the last time. */
void rb_friction_system_count(rb_friction_system *system, rb_friction_task *task);
/* The beginning of a method of such steps, once: assesses the start and, under a budget,
 * estimates the first step.  RB_MAXITER: it goes on. */
rb_status rb_friction_system_begin(rb_friction_system *system, rb_friction_task *task, int *begun,
                                   double *cost);
/* What the budget is compared with. */
double rb_friction_task_spent(const rb_friction_task *task);
/* 1: the budget is enough for so many operations; else the method pauses. */
int rb_friction_task_affords(rb_friction_task *task, double flops);
/* at: of all contacts, one after the other; e: n.  dr: m, dv: n, written. */
rb_status rb_friction_system_step(rb_friction_system *system, const rb_friction_linearised *at,
                                  const double *e, double *dr, double *dv);

/* Used by both forms: whether the dense LU is faster; zeroed memory for a dense matrix of
 * this order; its solution with x as the right-hand side ('T': transposed). */
int rb_friction_system_is_dense(int order, double fill);
rb_status rb_friction_system_dense(rb_friction_system *system, size_t order);
rb_status rb_friction_system_solve_dense(rb_friction_system *system, int order, char transposed);
/* Of rb_friction_system's `beside`, per entry of the matrix of a sparse LU: its time is that of 200
 * to 500 operations of a sweep beside its own (matrices of 1000 to 160000 entries). */
#define RB_FRICTION_LU_ENTRY 350.0
/* Per entry of the factors in each solve with them. */
#define RB_FRICTION_LU_SOLVE 4.0
/* Local form (system_local.c): its pattern; the step, written into x. */
rb_status rb_friction_local_pattern(rb_friction_system *system);
/* Factorises A + B W, and solves with x as the right-hand side, any number of times. */
rb_status rb_friction_local_factor(rb_friction_system *system, const double *A, const double *B);
rb_status rb_friction_local_solve(rb_friction_system *system, double *x);
rb_status rb_friction_local_step(rb_friction_system *system, const rb_friction_linearised *at);

/* ---- Methods ----------------------------------------------------------------------- */

/* The functions of a solver.  It runs either at once (run), or in parts: start, which
 * writes the whole state; then go_on until it no longer pauses; then finish, also if
 * start failed. */
typedef struct rb_friction_method {
    rb_status (*run)(rb_friction_task *task, int variant); /* NULL: in parts */
    size_t size;                                           /* of the state */
    rb_status (*start)(rb_friction_task *task, int variant, void *state);
    /* RB_MAXITER with the task's budget spent: paused. */
    rb_status (*go_on)(void *state);
    void (*finish)(void *state);
} rb_friction_method;

typedef enum {
    RB_FRICTION_SWEEP_PROJECTION =
        1,                          /* fixed point at each contact instead of the exact solution */
    RB_FRICTION_SWEEP_ANDERSON = 2, /* accelerated */
    RB_FRICTION_SWEEP_YIELD = 4     /* pauses when it stalls, unless it has a budget */
} rb_friction_sweep_variant;

typedef enum {
    RB_FRICTION_ALART_CURNIER,
    RB_FRICTION_JEAN_MOREAU,
    RB_FRICTION_NATURAL_MAP,
    RB_FRICTION_FISCHER_BURMEISTER,
    RB_FRICTION_LINE_SEARCH = 8 /* or-ed to one of the others */
} rb_friction_newton_variant;

typedef enum { RB_FRICTION_FIXED_POINT, RB_FRICTION_EXTRAGRADIENT } rb_friction_projection_variant;

typedef enum { RB_FRICTION_HUNDRED_SWEEPS = 1 } rb_friction_hybrid_variant;

/* For plane problems only.  Variant 0: all attempts in turn until one succeeds; k: only
 * the k-th. */
enum { RB_FRICTION_LEMKE_ATTEMPTS = 8 };

extern const rb_friction_method rb_friction_sweeps, rb_friction_newton, rb_friction_admm,
    rb_friction_projections, rb_friction_hybrid, rb_friction_smoothing_method,
    rb_friction_lemke_method, rb_friction_auto_method;

/* Lemke's method for plane problems with a given W, with a sparse LU (lemke_pairs.c), and
 * the operations of the given number of its pivots. */
rb_status rb_friction_lemke_pairs(rb_friction_task *task);
double rb_friction_lemke_pairs_flops(const rb_friction_task *task, double pivots);

/* The row of the list of solvers for a method and variant. */
const rb_friction_solver *rb_friction_solver_of(const rb_friction_method *method, int variant);

/* Projected gradients on the cones r_T <= wider mu r_N with Nesterov's extrapolation, restarted
 * where the value grows (Beck and Teboulle); m each: the iterate, zeros at the start, the
 * extrapolated one, the last one, and the gradient at the extrapolated one; t = 1, last = infinity.
 */
typedef struct {
    const rb_friction_problem *p;
    double wider, length; /* length: of a step */
    double *x, *ahead, *before, *gradient;
    double t, last;
} rb_friction_descent;
/* A step; value: at the extrapolated iterate.  Returns how far it goes over the largest |x|. */
double rb_friction_descend(rb_friction_descent *descent, double value);

/* states.c: of every choice of up to 8 contacts that stick, the others being open, the reactions,
 * until one is accepted (not 0).  RB_OK: it was; RB_NO_SOLUTION, RB_EINVAL: more contacts;
 * RB_SINGULAR, RB_ENOMEM. */
rb_status rb_friction_try_sticking(const rb_friction_problem *problem,
                                   int (*accepts)(void *context, const double *r), void *context);

/* Runs a method on the prepared task to its end, with at most `limit` iterations. */
rb_status rb_friction_run(rb_friction_task *task, const rb_friction_method *method, int variant,
                          int limit);

#endif
