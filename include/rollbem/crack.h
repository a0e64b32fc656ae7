/* A crack in the half-plane y <= 0 (body B) under contact tractions that pass over it:
 * its faces open, stick and slip by the same complementarity problem as the contact of
 * two bodies.  This header knows tractions on the surface, but no wheel.  Any consistent
 * units; stress intensities are in stress x sqrt(length).  Equation tags (C1) ... (C9):
 * docs/crack.md.
 *
 * Frame of a straight crack: it runs from its upper end into the body along
 * t = (cos angle, -sin angle); n = t turned by +90 degrees, so that the + side lies
 * towards +x of a crack of 90 degrees.  D = u(+ side) - u(- side) = (D_N, D_T) along (n,
 * t): D_N >= 0 is the opening. */
#ifndef ROLLBEM_CRACK_H
#define ROLLBEM_CRACK_H

#include "rollbem/base.h"
#include "rollbem/bem.h"

RB_PUBLIC_BEGIN

/* ---- Shape ------------------------------------------------------------------------- */

enum { RB_CRACK_PIECES = 64 };

/* Straight pieces between pieces + 1 places, from the upper end to the tip [length].
 * y[0] = 0: a crack with its mouth in the surface; all other y < 0. */
typedef struct {
    int pieces;
    double x[RB_CRACK_PIECES + 1], y[RB_CRACK_PIECES + 1];
} rb_crack_path;

/* angle [degrees] to the surface, below 90 the tip points to +x; depth of the upper end,
 * 0: at the surface. */
rb_crack_path rb_crack_straight(double mouth, double depth, double length, double angle);

typedef struct {
    rb_crack_path path;
    int full_plane; /* 1: there is no surface (a reference), and y is any number */
    int elements;
    double friction;       /* between the faces */
    double shear, poisson; /* of the body [stress], [-] */
} rb_crack_shape;

/* Shape, matrices and contact problem of a crack; one thread at a time. */
typedef struct rb_crack rb_crack;

/* RB_EINVAL with one line: places outside the body, a piece of no length, too few
 * elements; RB_SINGULAR: the elements are too coarse for the angle; RB_ENOMEM. */
rb_status rb_crack_create(const rb_crack_shape *shape, rb_crack **crack, rb_message *why);
void rb_crack_free(rb_crack *crack);

/* Nodes with an opening of their own: all but the tips. */
int rb_crack_nodes(const rb_crack *crack);
/* Their places (n each), the integrals e_j of their hats, whose sum is the length less
 * the halves at the tips, and the direction t (n each); any of them may be NULL. */
void rb_crack_places(const rb_crack *crack, double *x, double *y, double *hat,
                     double *t_x, double *t_y);
/* F of (C3), 2n x 2n column-major, rows and columns (N, T): D = F r of nodal forces r.
 * Borrowed. */
const double *rb_crack_flexibility(const rb_crack *crack);
/* Largest difference between K and its transpose before they were made equal, of the
 * largest entry: what the quadrature leaves. */
double rb_crack_asymmetry(const rb_crack *crack);

/* ---- Load -------------------------------------------------------------------------- */

/* Nodal forces T (2n) of the stress that tractions cause where there is no crack: load
 * holds strips [length] with pressure p and friction q on the body above (body A); it is
 * moved by x.  NULL: none.  tension: uniform stress along the surface. */
rb_status rb_crack_load(const rb_crack *crack, const rb_bem_edge_load *load, double x,
                        double tension, double *T);

/* ---- One state --------------------------------------------------------------------- */

typedef enum {
    RB_CRACK_DRY,
    RB_CRACK_TRAPPED, /* incompressible fluid is trapped where the mouth closes */
    RB_CRACK_PRESSURE /* the contact pressure at the mouth acts on the faces */
} rb_crack_fluid;

typedef struct {
    int n;
    double *D;        /* 2n [length]; owned, as all here */
    double *r;        /* 2n: nodal forces of the contact of the faces on the + side */
    int *zone;        /* n: rb_contact_zone of contact.h */
    double K_I, K_II; /* at the tip [stress x sqrt(length)] */
    double K_I_upper, K_II_upper; /* at the upper end of a crack below the surface; NAN */
    double open_length, stick_length; /* [length] */
    double fluid_pressure;            /* [stress] */
    double volume;                    /* of fluid that is trapped [length^2] */
    double residual;                  /* of the scaled problem */
    int iterations;
} rb_crack_state;

/* A closed crack that has not slipped.  RB_ENOMEM. */
rb_status rb_crack_state_alloc(const rb_crack *crack, rb_crack_state *state);
void rb_crack_state_free(rb_crack_state *state);

/* The next state of the history: from D_T and the volume of fluid in it.  pressure: of
 * the fluid, RB_CRACK_PRESSURE alone; scale: of the stresses, for the residual. */
rb_status rb_crack_step(rb_crack *crack, const double *T, rb_crack_fluid fluid,
                        double pressure, double scale, rb_crack_state *state,
                        rb_message *why);

/* ---- A passing load ---------------------------------------------------------------- */

/* The contact of a wheel without friction, for a crack that it feels (C9): n elements
 * between n + 1 ends about x = 0, the normal flexibility F of both bodies at them (n x n,
 * of tractions) [length/stress], the gap before the approach, which is found from the
 * load and starts at `approach`.  Borrowed. */
typedef struct {
    int n;
    const double *ends, *F, *gap;
    int ldf;
    double load, approach;
} rb_crack_wheel;

typedef struct {
    int steps;
    const double *x;              /* steps: where the load stands [length] */
    int loads;                    /* 0: none, 1: the same at each step, or steps */
    const rb_bem_edge_load *load; /* borrowed, as x */
    int passes;                   /* >= 1: the same steps again */
    rb_crack_fluid fluid;
    double tension;
    const rb_crack_wheel *wheel; /* NULL: the contact does not feel the crack; else its
                                    tractions are found, and `load` gives the scale */
} rb_crack_passage;

/* One entry per step of all passes; owned. */
typedef struct {
    int n, nodes;
    double *x, *K_I, *K_II;
    double *K_I_upper, *K_II_upper; /* NULL where the upper end is a mouth */
    double *open_length, *stick_length, *fluid_pressure;
    double *residual;
    double *max_pressure; /* of the contact that feels the crack; NULL: it does not */
    double *D;            /* n x 2 nodes, step by step */
    int *zone;            /* n x nodes */
} rb_crack_history;

/* The history holds the finished steps also on a positive status; free it in any case.
 * RB_EINVAL: no steps; RB_RAY, RB_INACCURATE: a step was not solved, which one is in why.
 */
rb_status rb_crack_pass(rb_crack *crack, const rb_crack_passage *passage,
                        rb_crack_history *history, rb_message *why);
void rb_crack_history_free(rb_crack_history *history);

/* Of the last pass, which begins at step `from`. */
typedef struct {
    int from;
    double K_I_max, K_I_min, K_II_max, K_II_min, delta_K_I, delta_K_II;
    double K_I_max_at, K_II_max_at, K_II_min_at; /* x */
    double K_II_at_K_I_max;                      /* the phase of opening and sliding */
    double K_theta_max; /* largest tension across any direction ahead of the tip times
                           sqrt(2 pi r), over the pass (Erdogan and Sih): K_I of a kink
                           there, nearly */
    double kink_angle;  /* that direction, from t towards n [degrees] */
    double K_I_max_upper, K_I_min_upper, K_II_max_upper, K_II_min_upper; /* or NAN */
    double open_max, fluid_pressure_max;
    double pass_change;  /* largest change of K from the pass before; NAN with one pass */
    double max_pressure; /* of the contact, coupled; else NAN */
    double residual;
} rb_crack_summary;

rb_crack_summary rb_crack_summarise(const rb_crack_history *history, int passes);

RB_PUBLIC_END

#endif
