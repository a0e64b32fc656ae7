/* Finite elements for small displacements; their nodes may touch obstacles with Coulomb
 * friction: space trusses, plane-strain quads, bricks; condensation to the contact; the
 * incremental quasi-static problem of *Kanno* (5)-(10); his two examples and the wall of
 * *Acary*. Any consistent units. */
#ifndef ROLLBEM_FEM_H
#define ROLLBEM_FEM_H

#include "base/base.h"
#include "lcp/friction/friction.h"
#include "base/sparse.h"

/* ---- Elements -------------------------------------------------------------------- */

typedef struct {
    double young;   /* E > 0 [stress] */
    double poisson; /* nu in (-1, 0.5); not used for bars */
    double density; /* rho > 0, used for the mass only */
    double section; /* area of bars, thickness of quads; not used for bricks */
} rb_fem_material;

/* Stiffness of one element, column-major, dofs node by node.  Solids integrate with two
 * Gauss points per direction.  x: coordinates node by node; quads counter-clockwise,
 * bricks bottom counter-clockwise, then top.  RB_EINVAL: zero length, or a Jacobian that
 * is not positive at a Gauss point. */
rb_status rb_fem_bar_stiffness(const double x[6], const rb_fem_material *m, double K[36]);
rb_status rb_fem_quad_stiffness(const double x[8], const rb_fem_material *m, double K[64]);
rb_status rb_fem_brick_stiffness(const double x[24], const rb_fem_material *m, double K[576]);
/* Consistent mass of a brick. */
rb_status rb_fem_brick_mass(const double x[24], const rb_fem_material *m, double M[576]);

/* ---- Meshes ---------------------------------------------------------------------- */

typedef enum { RB_FEM_BAR, RB_FEM_QUAD, RB_FEM_BRICK } rb_fem_kind;

typedef struct {
    rb_fem_kind kind;
    int dimension;       /* 3, 2, 3 */
    int element_nodes;   /* 2, 4, 8 */
    int nodes, elements; /* counts */
    double *x;           /* dimension x nodes; owned */
    int *node;           /* element_nodes x elements; owned */
    int *dof;            /* dimension x nodes: number of the unknown, -1 if fixed; owned */
    int dofs;            /* unknowns; valid after rb_fem_mesh_number */
} rb_fem_mesh;

/* Allocates a mesh with all nodes at the origin and no fixed displacements.  RB_EINVAL:
 * nodes < 1, elements < 0. */
rb_status rb_fem_mesh_alloc(rb_fem_kind kind, int nodes, int elements, rb_fem_mesh *mesh);
void rb_fem_mesh_free(rb_fem_mesh *mesh);
/* Fixes one direction of a node; call rb_fem_mesh_number afterwards. */
void rb_fem_mesh_hold(rb_fem_mesh *mesh, int node, int direction);
void rb_fem_mesh_number(rb_fem_mesh *mesh);

/* dofs x dofs, both triangles.  RB_EINVAL with the element's number in why. */
rb_status rb_fem_stiffness(const rb_fem_mesh *mesh, const rb_fem_material *material, rb_sparse *K,
                           rb_message *why);
/* Bricks only. */
rb_status rb_fem_mass(const rb_fem_mesh *mesh, const rb_fem_material *material, rb_sparse *M,
                      rb_message *why);

/* ---- Structures that may touch obstacles ------------------------------------------- */

/* K u = F + H r with r = (N, T...) per contact, as in rollbem/friction.h; the relative
 * displacement of contact i is H' u, its initial gap counts along N.  K is symmetric; it
 * may be singular if only the contacts hold the structure. */
typedef struct {
    int dofs, dimension, contacts;
    rb_sparse K; /* dofs x dofs, both triangles; owned, like all arrays here */
    rb_sparse H; /* dofs x dimension contacts */
    double *mu;  /* contacts */
    double *gap; /* contacts */
} rb_fem_structure;

void rb_fem_structure_free(rb_fem_structure *s);

/* Displacements u (dofs) and reactions r (dimension contacts) after an increment. */
typedef struct {
    double *u, *r; /* owned */
} rb_fem_state;

rb_status rb_fem_state_alloc(const rb_fem_structure *s, rb_fem_state *state);
void rb_fem_state_free(rb_fem_state *state);

/* Units inside a friction problem: physical = unit x number. */
typedef struct {
    double force, length;
} rb_fem_units;

/* The increment from state to the total load F (dofs), *Kanno* (9)-(10), in global form:
 * K v = H r + f with f = F - K u, v = increment of u; w = (current gap, 0, 0).  State and
 * reactions of the previous increment enter through f (equilibrium) and the gap. units:
 * written; the function chooses them such that forces and K are of order one, because the
 * error measure of the friction solvers adds quantities of different units. */
rb_status rb_fem_problem(const rb_fem_structure *s, const double *load, const rb_fem_state *state,
                         rb_friction_problem *problem, rb_fem_units *units);

/* ---- Condensation to the contact nodes --------------------------------------------- */

/* The unknowns C that H touches are kept, the others F eliminated by a sparse Cholesky
 * factorisation of K_FF: K_c = K_CC - K_CF K_FF^-1 K_FC; opaque. */
typedef struct rb_fem_condensation rb_fem_condensation;

/* RB_SINGULAR: a part can move although all contact nodes are fixed. */
rb_status rb_fem_condense(const rb_fem_structure *full, rb_fem_condensation **c, rb_message *why);
void rb_fem_condensation_free(rb_fem_condensation *c);
/* Borrowed. */
const rb_fem_structure *rb_fem_condensed(const rb_fem_condensation *c);
/* F_c = F_C - K_CF K_FF^-1 F_F. */
rb_status rb_fem_condense_load(const rb_fem_condensation *c, const double *load, double *load_c);
/* u from u_C: u_F = K_FF^-1 (F_F - K_FC u_C). */
rb_status rb_fem_expand(const rb_fem_condensation *c, const double *load, const double *u_c,
                        double *u);

/* ---- Models with a history of loads ------------------------------------------------ */

/* A mesh on a flat obstacle, below along its last axis, and the total loads of every
 * increment. */
typedef struct {
    rb_fem_mesh mesh;
    rb_fem_structure structure;
    int *contact_node; /* contacts; owned */
    int steps;
    double *load; /* dofs x steps, totals; owned */
} rb_fem_model;

/* Allocates a mesh as rb_fem_mesh_alloc does, and the array of contact nodes; the caller
 * fills them in.  Free the model with rb_fem_model_free, also on failure. */
rb_status rb_fem_model_alloc(rb_fem_kind kind, int nodes, int elements, int contacts,
                             rb_fem_model *model);
/* Builds the structure of a model whose mesh and contact nodes are filled in; all loads
 * are zero.  In every contact N is along the last axis and T along the others.  A contact
 * whose tangential direction is fixed gets mu = 0, because its friction would be
 * undetermined. */
rb_status rb_fem_model_build(rb_fem_model *model, const rb_fem_material *material, double mu,
                             int steps, rb_message *why);
void rb_fem_model_free(rb_fem_model *model);
/* Another coefficient mu >= 0 of all contacts that can slide, and all loads times factor. */
void rb_fem_model_change(rb_fem_model *model, double mu, double factor);
/* Adds a force on one direction of a node in increment step; forces on fixed directions
 * are ignored. */
void rb_fem_model_load(rb_fem_model *model, int step, int node, int direction, double force);

/* *Kanno* 3.2: half a bar of 400 x 40 x 10 mm, E = 5 MPa, nu = 0.48, mu = 1.3, plane
 * strain, nx x ny Q1 elements, ux = 0 on x = 0; 0.01 MPa on top and 0.01 k MPa on the
 * right face, k = 1 ... 5.  Published: nx = 160, ny = 16.  N, mm. */
rb_status rb_fem_model_bar(int nx, int ny, rb_fem_model *model, rb_message *why);
#define RB_FEM_BAR_MU 1.3
#define RB_FEM_BAR_PRESSURE 0.01 /* MPa per increment */

/* *Kanno* 3.1: double-layer grid of bars on n x n contact nodes, 2000 x 3000 mm apart,
 * the upper layer 2000 mm above, offset by half a cell, E = 205800 MPa, A = 10000 mm2, mu
 * = 0.12; gamma 102900 N down on inner upper nodes, half on edges, a quarter at corners,
 * gamma = 5, 4.05 ... 0.25.  The paper shows the layout only in a figure; both layouts
 * here agree with its text. */
typedef enum {
    RB_FEM_UPPER_INSIDE,     /* (n-1) x (n-1) upper nodes over the lower cells */
    RB_FEM_UPPER_OVERHANGING /* (n+1) x (n+1) upper nodes, lower ones under upper cells */
} rb_fem_layout;

/* Published: n = 12.  RB_EINVAL: n < 2. */
rb_status rb_fem_model_truss(rb_fem_layout layout, int n, rb_fem_model *model, rb_message *why);
#define RB_FEM_TRUSS_MU 0.12
#define RB_FEM_TRUSS_LOAD 102900.0 /* N, on inner nodes, at gamma = 1 */

typedef enum { RB_FEM_SEPARATED, RB_FEM_STICK, RB_FEM_SLIP } rb_fem_contact;

/* The end of one increment.  dimension and counts as in the model; all owned. */
typedef struct {
    rb_status status;
    int iterations;
    double residual; /* *Acary* (13) of the condensed, scaled problem */
    int stick, slip, separated;
    rb_fem_contact *contact; /* contacts */
    double *u;               /* dimension x nodes: displacements so far */
    double *r;               /* dimension x contacts: (N, T) reactions */
    double *du;              /* dimension x contacts: (N, T) increments of displacement */
    double *gap;             /* contacts */
} rb_fem_step;

typedef struct {
    int steps;         /* increments that were computed */
    rb_fem_step *step; /* owned */
    double seconds;
} rb_fem_history;

/* Computes all increments of the condensed model with the named friction solver; each
 * starts from the state of the one before.  It stops at the first increment that is not
 * solved to tol; history keeps the increments up to it (without it if the solver did not
 * start). */
rb_status rb_fem_run(const rb_fem_model *model, const char *solver, double tol,
                     rb_fem_history *history, rb_message *why);
void rb_fem_history_free(rb_fem_history *history);

/* Corner, sums and maxima of one increment. */
typedef struct {
    double corner[2];             /* bar: displacement of its last node [mm] */
    double normal, tangential[2]; /* sums of the reactions [N] */
    double increment;             /* largest tangential increment of a contact [mm] */
} rb_fem_sums;

rb_fem_sums rb_fem_sum(const rb_fem_model *model, const rb_fem_step *step);

/* ---- The wall ---------------------------------------------------------------------- */

/* A dry masonry wall like the one of *Acary* 3: five courses in running bond, 12 blocks
 * (six whole, 0.2 x 0.1 x 0.1 m, ... two whole or half, whole, half per course), E
 * = 2.2e9 Pa, nu = 0.2, 2000 kg/m3, mu = 0.83 between blocks and 0.53 at the supports.
 * The lower support is fixed.  The upper one is a beam of 300 kg that only moves
 * vertically under a force rising to 30 kN and is then driven sideways at 1e-3 m/s.  SI
 * units. Implicit dynamics (backward Euler, small displacements): with velocities v and
 * impulses r, (M + dt^2 K) v = M v0 + dt (F - K u0) + H r,  u = H' v + w,  w = (gap/dt,
 * -drive), so that the matrix is regular, one body a block.  Contact points are nodes of
 * the more finely meshed side of a joint; every one has its own node, so that H has full
 * rank. */
typedef struct {
    int fine[3];      /* nodes of a whole block in courses 1, 3, 5: along, across, up */
    int coarse[3];    /* the same in courses 2 and 4 (half blocks have half the elements) */
    int rigid;        /* 1: rigid blocks with six degrees of freedom and the same contact points
                       */
    double dt;        /* [s] */
    int press, shear; /* numbers of steps with growing force and of steps with sideways motion */
    /* NULL, or a function called while a step is solved; if it does not return 0, the
     * step ends with RB_INTERRUPTED. */
    int (*stopped)(void *context);
    void *context;
} rb_fem_wall_options;

/* The defaults: about 1700 contact points and 8200 unknowns; one step under the weight,
 * then 10 + 65 steps of 10 ms. */
rb_fem_wall_options rb_fem_wall_defaults(void);

/* Results of one solved step. */
typedef struct {
    double time;        /* at its end [s] */
    double compression; /* [N] */
    double shear;       /* force along the wall on the upper support's contacts [N] */
    double drift;       /* displacement of the upper support along the wall [m] */
    int stick, slip, separated;
    int iterations;  /* of the solver started from the previous r; a measure of difficulty
                      */
    double residual; /* *Acary* (13) */
    double seconds;
} rb_fem_wall_step;

typedef struct rb_fem_wall rb_fem_wall; /* opaque */

/* RB_EINVAL: fewer nodes than three along and up or two across, dt <= 0, no steps. */
rb_status rb_fem_wall_create(const rb_fem_wall_options *options, rb_fem_wall **wall,
                             rb_message *why);
void rb_fem_wall_free(rb_fem_wall *wall);
int rb_fem_wall_contacts(const rb_fem_wall *wall);
int rb_fem_wall_dofs(const rb_fem_wall *wall);
int rb_fem_wall_steps(const rb_fem_wall *wall); /* planned */
/* Rank of H; 3 x contacts minus the rank is the degree of hyperstaticity. */
rb_status rb_fem_wall_rank(const rb_fem_wall *wall, int *rank);
/* The mesh of all blocks, which share no nodes; borrowed. */
const rb_fem_mesh *rb_fem_wall_mesh(const rb_fem_wall *wall);
/* Displacements of the nodes after the last solved step (3 x nodes). */
rb_status rb_fem_wall_displacements(const rb_fem_wall *wall, double *u);

/* Computes the next step; RB_EINVAL after the last one.  RB_INTERRUPTED: the step is
 * discarded, and no further step can be computed. */
rb_status rb_fem_wall_advance(rb_fem_wall *wall, const char *solver, double tol,
                              rb_fem_wall_step *step, rb_message *why);
/* The friction problem of a solved step (from 0), in global form. */
rb_status rb_fem_wall_problem(const rb_fem_wall *wall, int step, rb_friction_problem *problem);
/* Selects `count` of the solved steps except the first, evenly distributed over their
 * difficulty (iterations, then time), the easiest first.  RB_EINVAL: count < 1, or more
 * than were solved. */
rb_status rb_fem_wall_select(const rb_fem_wall *wall, int count, int *step);

#endif
