/* What the files of this folder share: the discretised crack. */
#ifndef ROLLBEM_CRACK_INTERNAL_H
#define ROLLBEM_CRACK_INTERNAL_H

#include "rollbem/contact.h"
#include "rollbem/crack.h"

#include <complex.h>

/* One straight element with a linear D: a constant density of dislocations. */
typedef struct {
    double complex from, t; /* its upper end, and its direction */
    double length, s;       /* s: of its upper end along the crack */
    int piece;
} rb_crack_element;

/* A place where the stress is wanted, its weight times the length it stands for, and the
 * two hats there. */
typedef struct {
    double complex z;
    double weight, hat[2];
} rb_crack_point;

struct rb_crack {
    rb_crack_shape shape;
    int n;                     /* unknown nodes: first, first + 1, ... */
    int first;                 /* 0: the mouth is a node; 1: the upper end is a tip */
    rb_crack_element *element; /* shape.elements; owned, as all here */
    double complex *t;         /* n: direction of the frame of each node */
    double *hat;               /* n: e_j */
    double *scale;  /* n: 1/sqrt(F_jj), by which the contact problem is scaled */
    double *F;      /* 2n x 2n */
    double *scaled; /* the same scaled, of the contact problem */
    double asymmetry;
    double per_D; /* K over D of the node next to a tip */
    rb_contact_problem problem;
    rb_contact_state contact;
    rb_contact_state wheel; /* of the last coupled step; n = 0: none */
    double approach;        /* in it */
    int warm;               /* 1: the zones of `contact` are a start */
};

/* Names a solved step: gaps, slips and state of its problem, whose scales are `scale`,
 * from entry `at` on. */
void rb_crack_read_state(const rb_crack *crack, const double *gap, const double *slip,
                         const double *scale, const rb_contact_state *of, int at,
                         rb_crack_state *state);
/* The same step with the wheel's contact elements in the problem (C9). */
rb_status rb_crack_step_coupled(rb_crack *crack, const rb_crack_wheel *wheel, double x,
                                const double *T, double stress, rb_crack_state *state,
                                double *max_pressure, rb_message *why);
/* Of the scaled natural residual. */
#define RB_CRACK_TOLERANCE 1e-10

enum { RB_CRACK_LOAD_POINTS = 6 };
/* Gauss points of element k for the stress of a load. */
void rb_crack_load_points(const rb_crack_element *e, rb_crack_point *point);

#endif
