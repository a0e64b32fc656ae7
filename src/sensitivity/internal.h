/* What the files of this folder share. */
#ifndef ROLLBEM_SENSITIVITY_INTERNAL_H
#define ROLLBEM_SENSITIVITY_INTERNAL_H

#include "rollbem/sensitivity.h"

/* The equations of a state with zones (D1), and the factors of their Jacobian. */
struct rb_sensitivity {
    const rb_rolling_model *model; /* borrowed */
    int n, degenerate;
    char *border;                 /* n: which pair of an element is degenerate; owned */
    double *slip;                 /* 2n: T_T lambda and gap as they are; owned */
    double *law_slip, *law_force; /* n x n: what bounds change by with slips and with
                                     friction; NULL: not at all; owned */
    rb_rolling_solution solution; /* of the model, where results are differentiated */
    struct rb_sensitivity_factors *factors; /* of the model's own zones; owned */
    struct rb_sensitivity *free_rolling; /* of the model that rolls freely; NULL: none */
    rb_rolling_model *freely;            /* that model; owned */
    rb_rolling_model *with_matrix; /* the model where it was solved without; NULL: it is
                                      the caller's; owned */
    int moves;                     /* rb_sensitivity_elements, fixed at first */
    rb_rolling_solution motion[2]; /* of elements stretched and shifted by 1 mm; owned */
    double creepage[2];            /* of free rolling, by its motions */
    double gain[4];                /* of these motions by half-width and centre found */
};

/* Pairs that are degenerate. */
enum { BORDER_GAP = 1, BORDER_SLIP = 2 };

/* ---- equations.c ------------------------------------------------------------------- */

/* law_slip and law_force.  RB_ENOMEM. */
rb_status rb_sensitivity_law(rb_sensitivity *s, rb_message *why);

/* ---- differentiate.c --------------------------------------------------------------- */

/* Whether and how the elements move.  RB_ENOMEM. */
rb_status rb_sensitivity_set_motion(rb_sensitivity *s);
/* The case that rolls without a force. */
rb_rolling_case rb_sensitivity_without_force(const rb_rolling_case *rc);

/* ---- jacobian.c -------------------------------------------------------------------- */

typedef struct rb_sensitivity_factors {
    int contacts, size;
    int *contact;        /* contacts: element numbers; owned */
    int *zone;           /* n: zones that they are of; owned */
    double *J, *unknown; /* size x size: LU; size: scales of the unknowns; owned */
    double *row;         /* size: scales of the equations; owned */
    int *pivot;          /* owned */
} rb_sensitivity_factors;

/* RB_SINGULAR, RB_ENOMEM. */
rb_status rb_sensitivity_factor(const rb_sensitivity *s, const int *zone,
                                rb_sensitivity_factors **factors);
void rb_sensitivity_factors_free(rb_sensitivity_factors *factors);
/* J y' = -R'. */
rb_status rb_sensitivity_forward(const rb_sensitivity *s,
                                 const rb_sensitivity_factors *factors,
                                 const rb_sensitivity_rate *rate,
                                 rb_contact_state *tangent);

#endif
