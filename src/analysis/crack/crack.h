/* A crack in the half-plane y <= 0 (body B) under contact tractions that move over it.
 * Opening, stick and slip of its faces are the same complementarity problem as the
 * contact of two bodies.  The load is given as tractions on the surface; the wheel does
 * not appear here.  Any consistent units; stress intensities are in stress x
 * sqrt(length).  Equation tags (C1) ... (C9): docs/crack.md.
 *
 * Frame of a straight crack: it runs from its upper end into the body along t = (cos
 * angle, -sin angle); n is t turned by +90 degrees, so that for a crack of 90 degrees the
 * + side is the side towards +x.  D = u(+ side) - u(- side) = (D_N, D_T) along (n, t):
 * D_N >= 0 is the opening. */
#ifndef ROLLBEM_CRACK_H
#define ROLLBEM_CRACK_H

#include "base/base.h"
#include "bem/bem.h"
#include "rolling/case/case.h"

/* ---- Shape ------------------------------------------------------------------------- */

enum { RB_CRACK_PIECES = 64 };

/* A path of straight pieces between pieces + 1 points, from the upper end to the tip
 * [length].  y[0] = 0 for a crack whose mouth is in the surface; all other y < 0. */
typedef struct {
    int pieces;
    double x[RB_CRACK_PIECES + 1], y[RB_CRACK_PIECES + 1];
} rb_crack_path;

/* A straight crack.  angle [degrees]: to the surface; below 90 the tip points towards +x.
 * depth: of the upper end; 0: at the surface. */
rb_crack_path rb_crack_straight(double mouth, double depth, double length, double angle);

typedef struct {
    rb_crack_path path;
    int full_plane; /* 1: infinite plane without a surface (for reference solutions); y
                       may have any value */
    int elements;
    double friction;       /* between the faces */
    double shear, poisson; /* of the body [stress], [-] */
} rb_crack_shape;

/* Shape, matrices and contact problem of a crack; one thread at a time. */
typedef struct rb_crack rb_crack;

/* RB_EINVAL: points outside the body, a piece of zero length, too few elements; why has
 * the reason; RB_SINGULAR: the elements are too coarse for the angle; RB_ENOMEM. */
rb_status rb_crack_create(const rb_crack_shape *shape, rb_crack **crack, rb_message *why);
void rb_crack_free(rb_crack *crack);

/* Number of nodes with an unknown opening: all nodes except the tips. */
int rb_crack_nodes(const rb_crack *crack);
/* Places of these nodes, integrals e_j of their hat functions (their sum is the length of
 * the crack without the halves at the tips), and the direction t, n values each; any
 * pointer may be NULL. */
void rb_crack_places(const rb_crack *crack, double *x, double *y, double *hat, double *t_x,
                     double *t_y);
/* F of (C3), 2n x 2n column-major, rows and columns (N, T): D = F r of nodal forces r.
 * Borrowed. */
const double *rb_crack_flexibility(const rb_crack *crack);

/* ---- Load -------------------------------------------------------------------------- */

/* A load is given by strips, on which its tractions are constant, or by nodes, between which
 * they are linear. */
typedef enum { RB_CRACK_STRIPS, RB_CRACK_NODES } rb_crack_load_kind;

/* Nodal forces T (2n) of the stress that the load causes in the body without a crack.
 * load: [length], with pressure p and friction q on the upper body A, moved by x; NULL: none.
 * tension: uniform stress along the surface.  RB_EINVAL: the abscissae are out of order, or a
 * crack of the full plane lies above y = 0; RB_ENOMEM. */
rb_status rb_crack_load(const rb_crack *crack, const rb_bem_edge_load *load,
                        rb_crack_load_kind kind, double x, double tension, double *T);
/* The pressure of the load at x. */
double rb_crack_pressure(const rb_bem_edge_load *load, rb_crack_load_kind kind, double x);

/* ---- One state --------------------------------------------------------------------- */

typedef struct {
    int n;
    double *D;                    /* 2n [length]; owned, like all arrays here */
    double *r;                    /* 2n: nodal forces of the contact of the faces on the + side */
    int *zone;                    /* n: rb_contact_zone of contact.h */
    double K_I, K_II;             /* at the tip [stress x sqrt(length)] */
    double K_I_upper, K_II_upper; /* at the upper end of a crack below the surface; NAN */
    double open_length, stick_length; /* [length] */
    double fluid_pressure;            /* [stress] */
    double volume;                    /* volume of the trapped fluid [length^2] */
    double residual;                  /* of the scaled problem */
    int iterations;
} rb_crack_state;

/* A closed crack that has not slipped.  RB_ENOMEM. */
rb_status rb_crack_state_alloc(const rb_crack *crack, rb_crack_state *state);
void rb_crack_state_free(rb_crack_state *state);

/* Computes the next state of a history from D_T and the fluid volume in `state`.
 * pressure: of the fluid, used with RB_CRACK_PRESSURE only; scale: typical stress, for
 * the residual. */
rb_status rb_crack_step(rb_crack *crack, const double *T, rb_crack_fluid fluid, double pressure,
                        double scale, rb_crack_state *state, rb_message *why);

/* ---- A passing load ---------------------------------------------------------------- */

/* A frictionless contact whose pressure depends on the crack (C9): n elements between n +
 * 1 ends about x = 0, the normal flexibility F of both bodies (n x n, of tractions)
 * [length/stress], and the gap without approach.  The approach follows from the load; its
 * first value is `approach`.  Pointers are borrowed. */
typedef struct {
    int n;
    const double *ends, *F, *gap;
    int ldf;
    double load, approach;
} rb_crack_wheel;

/* Called before each of so many steps of all passes; not 0 ends them. */
typedef struct {
    int (*stopped)(int step, int steps, void *context);
    void *context;
} rb_crack_observer;

typedef struct {
    int steps;
    const double *x; /* steps: position of the load [length] */
    int loads;       /* 0: none, 1: the same load in each step, or steps: one load per step */
    const rb_bem_edge_load *load; /* borrowed, as x */
    rb_crack_load_kind kind;      /* of all loads */
    const double *forces;         /* steps x 2n: the nodal forces of rb_crack_load at the positions;
                                     NULL: they are computed */
    int passes;                   /* >= 1: how often the steps are repeated */
    rb_crack_fluid fluid;
    int locate_closing; /* trapped fluid: 0: the volume of the last step with an open
                           mouth (Bower); 1: the volume where the mouth closes between two
                           steps */
    double tension;
    const double *tensions;      /* steps: one for each step; NULL: tension in all */
    const rb_crack_wheel *wheel; /* NULL: the tractions are those of `load`; otherwise they are
                                    computed together with the crack, and `load` gives the scale */
    const rb_crack_observer *observer; /* or NULL */
} rb_crack_passage;

/* One entry per step of all passes; owned. */
typedef struct {
    int n, nodes;
    double *x, *K_I, *K_II;
    double *K_I_upper, *K_II_upper; /* NULL if the upper end is a mouth */
    double *open_length, *stick_length, *fluid_pressure;
    double *fluid_volume; /* volume of the fluid, as in rb_crack_state */
    double *residual;
    double *max_pressure; /* of the contact, if it depends on the crack; otherwise NULL */
    double *D, *r;        /* n x 2 nodes, step by step */
    int elements;         /* of a coupled wheel; otherwise 0 */
    double *wheel;        /* n x elements: its pressures, step by step; otherwise NULL */
    int *zone;            /* n x nodes */
} rb_crack_history;

/* The history holds the finished steps also on a positive status; free it in any case.
 * RB_INTERRUPTED: the observer ended it; the history holds the passes that were complete.
 * RB_EINVAL: no steps; RB_RAY, RB_INACCURATE: a step was not solved; why names it. */
rb_status rb_crack_pass(rb_crack *crack, const rb_crack_passage *passage, rb_crack_history *history,
                        rb_message *why);
/* Trapped fluid has the volume of the place where the mouth closes: `state`, that of step k - 1 of
 * a pass with an open mouth, becomes that just before this place, if the mouth closes on the way to
 * step k and the passage asks for it; otherwise it stays as it is.  T: scratch for 4 nodes. */
rb_status rb_crack_close(rb_crack *crack, const rb_crack_passage *passage, int k, double scale,
                         double *T, rb_crack_state *state, rb_message *why);
/* Zeros for so many steps, n = 0; elements: of a coupled wheel, or 0.  RB_ENOMEM. */
rb_status rb_crack_history_alloc(const rb_crack *crack, int steps, int elements,
                                 rb_crack_history *history);
void rb_crack_history_free(rb_crack_history *history);

/* The largest tension across any direction ahead of a tip, times sqrt(2 pi r) (Erdogan
 * and Sih): approximately K_I of a kink in this direction.  *angle: from t towards n. */
double rb_crack_largest_tension(double K_I, double K_II, double *angle);

#endif
