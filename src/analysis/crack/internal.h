/* What the files of this folder share: the discretised crack. */
#ifndef ROLLBEM_CRACK_INTERNAL_H
#define ROLLBEM_CRACK_INTERNAL_H

#include "lcp/contact/contact.h"
#include "analysis/crack/crack.h"

#include <complex.h>
#include <gsl/gsl_integration.h>

/* One straight element with a linear D: a constant density of dislocations. */
typedef struct {
    double complex from, t; /* its upper end, and its direction */
    double length, s;       /* s: of its upper end along the crack */
    int piece;
} rb_crack_element;

/* Ends s of n elements along the path, n + 1 values, from 0: a sin^2(phi), phi = 0 ... 90 degrees,
 * graded towards both ends of the crack.  phi is stretched so that each kink falls on an end.  n:
 * at least two a piece. */
void rb_crack_grade(const rb_crack_path *path, int n, double *s);
/* The n elements between these ends. */
void rb_crack_place(const rb_crack_path *path, int n, const double *s, rb_crack_element *element);

/* A place where the stress is wanted, its weight times the length it stands for, and the
 * two hats there. */
typedef struct {
    double complex z;
    double weight, hat[2];
} rb_crack_point;

/* Gauss points of an element by rule[0], or in two halves of which those that are graded
 * towards their end have rule[1].  Returns how many. */
int rb_crack_points(const rb_crack_element *e, int graded_from, int graded_to,
                    gsl_integration_glfixed_table *const rule[2], rb_crack_point *point);

/* The contact of the faces, behind the m elements of a wheel if it is computed with them,
 * scaled so that the diagonal of F_NN is 1. */
typedef struct {
    int n, m;                     /* m + the nodes of the crack; m */
    double *F;                    /* 2n x 2n; owned, as all here */
    double *scale;                /* n: 1/sqrt(F_jj) */
    double *gap, *slip, *scratch; /* n, n, 2n; gap and slip of the last solution */
    rb_contact_problem problem;
    rb_contact_state state;
    int warm;        /* 1: the zones of the state are a start */
    double approach; /* of the wheel, in the last solution */
} rb_crack_contact;

struct rb_crack {
    rb_crack_shape shape;
    int n;                     /* unknown nodes: first, first + 1, ... */
    int first;                 /* 0: the mouth is a node; 1: the upper end is a tip */
    rb_crack_element *element; /* shape.elements */
    double complex *t;         /* n: direction of the frame of each node */
    double *hat;               /* n: e_j */
    double *F;                 /* 2n x 2n */
    double per_D;              /* K over D of the node next to a tip */
    rb_crack_contact faces, coupled;
    rb_arena memory; /* of the arrays */
};

/* ---- contact.c --------------------------------------------------------------------- */

rb_status rb_crack_contact_alloc(const rb_crack *crack, int m, rb_crack_contact *contact);
void rb_crack_contact_free(rb_crack_contact *contact);
/* Scales contact->F, which the caller has filled, and poses the problem. */
rb_status rb_crack_contact_pose(const rb_crack *crack, rb_crack_contact *contact);
/* d = F (T + p_f e), scaled; slips count from those of the state.  size: of the scaled
 * forces. */
void rb_crack_contact_load(const rb_crack *crack, const double *T, double pressure, double size,
                           const rb_crack_state *before, rb_crack_contact *contact);
rb_status rb_crack_contact_solve(rb_crack_contact *contact, rb_message *why);
/* The solution in the units of the crack. */
void rb_crack_contact_read(const rb_crack *crack, const rb_crack_contact *contact,
                           rb_crack_state *state);

/* ---- coupled.c --------------------------------------------------------------------- */

/* A step with the wheel's contact elements in the problem (C9); pressure: of each. */
rb_status rb_crack_step_coupled(rb_crack *crack, const rb_crack_wheel *wheel, double x,
                                const double *T, double stress, rb_crack_state *state,
                                double *pressure, rb_message *why);

#endif
