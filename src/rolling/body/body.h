/* The bodies A and B: their kinds, properties and materials. */
#ifndef ROLLBEM_ROLLING_BODY_BODY_H
#define ROLLBEM_ROLLING_BODY_BODY_H

#include "bem/boundary.h"
#include "rolling/case/inputs.h"

/* Properties of a body, as bits. */
typedef enum {
    RB_BODY_FLAT = 1,        /* its surface is a plane, otherwise a circle */
    RB_BODY_BOUNDARY = 2,    /* has boundary elements outside the contact, too */
    RB_BODY_HOMOGENEOUS = 4, /* of one elastic material: Hertz's half-width applies, and
                                the formulas of heat conduction, too */
    RB_BODY_ELASTIC = 8,     /* elastic: no hysteresis */
    RB_BODY_STRESS = 16,     /* the stress inside can be computed */
    RB_BODY_TURNS = 32       /* rotationally symmetric: its stiffness is the same at every angle */
} rb_rolling_ability;

/* An option that applies to some bodies only; the option of body B has the suffix
 * "-b". */
typedef struct {
    const char *option;                              /* NULL ends the list */
    int (*has_meaning)(const rb_rolling_body *body); /* NULL: every body of the row */
    const char *reason; /* end of the error message for other bodies; NULL: "of the
                           support ..." */
} rb_rolling_parameter;

/* 1: the body has all properties of the sum `abilities`. */
int rb_rolling_body_can(const rb_rolling_body *body, int abilities);
/* Whether all numbers are the same, NAN included; bytes between them do not count. */
int rb_rolling_same_body(const rb_rolling_body *x, const rb_rolling_body *y);

/* 1: A, and B if it is elastic, have all properties of `abilities`. */
int rb_rolling_can(const rb_rolling_case *rc, int abilities);

/* The elastic constants of a body for the plane problem of the case; the second function:
 * those of the base or core below its layer or cover. */
rb_bem_material rb_rolling_material(const rb_rolling_case *rc, const rb_rolling_body *body);
rb_bem_material rb_rolling_base_material(const rb_rolling_case *rc, const rb_rolling_body *body);

/* Layers of a half-plane, 0: none; layer k of them from the surface down; the depth of the bond
 * below the first `bond` of them, of the last one, and Poisson's ratio of what lies at a depth, on
 * a bond of what lies above it. */
typedef struct {
    double thickness, young, poisson; /* [length], [stress], [-] */
} rb_rolling_layer_properties;
int rb_rolling_layers(const rb_rolling_body *body);
rb_rolling_layer_properties rb_rolling_layer_of(const rb_rolling_body *body, int k);
double rb_rolling_bond_depth(const rb_rolling_body *body, int bond);
double rb_rolling_layers_depth(const rb_rolling_body *body);
double rb_rolling_poisson_at(const rb_rolling_body *body, double depth);

/* w = w0 + F (p, q), 2m values, m = n + 1.  RB_ENOMEM. */
rb_status rb_rolling_displacement(const rb_rolling_bodies *bodies, const double *p, const double *q,
                                  double *w);

/* ---- The table of bodies -------------------------------------------------------- */

/* The allowed words of the option `support`; an entry with name NULL ends the list. */
extern const rb_choice rb_rolling_supports[];

/* A row of the table of bodies (src/rolling/body/body.c).  A body has the row of its support
 * and one row for each addition (layer, cover, viscoelasticity).  It has those properties
 * that all its rows have. */
typedef struct rb_rolling_body_kind rb_rolling_body_kind;

/* Row k = 0, 1, ... of the table; NULL after the last one. */
const rb_rolling_body_kind *rb_rolling_body_kind_get(int k);
/* The row of the body's support. */
const rb_rolling_body_kind *rb_rolling_kind_of(const rb_rolling_body *body);
/* 1: it is a row of this body. */
int rb_rolling_body_is(const rb_rolling_body *body, const rb_rolling_body_kind *kind);
const char *rb_rolling_kind_name(const rb_rolling_body_kind *kind); /* in pictures */
rb_bem_support rb_rolling_kind_support(const rb_rolling_body_kind *kind);
/* The options that apply to some bodies only; an entry without a name ends the list. */
const rb_rolling_parameter *rb_rolling_kind_parameters(const rb_rolling_body_kind *kind);

#endif
