/* The rows of the table of bodies, and what src/rolling alone asks of a body. */
#ifndef ROLLBEM_ROLLING_BODY_INTERNAL_H
#define ROLLBEM_ROLLING_BODY_INTERNAL_H

#include "rolling/body/body.h"

/* ---- Rows of the table (body.c) ------------------------------------------------- */

/* The flexibility of one body. */
typedef struct {
    rb_bem_flexibility f;  /* owned */
    rb_bem_system *system; /* NULL without boundary elements; owned */
    int keeps_memory;      /* 1: compute `memory` for a half-plane, too */
    double *memory;        /* 2m x 2n: viscoelastic part of f, for pairs with a wheel in steady
                              rolling; otherwise NULL; owned */
    double seconds_assembly, seconds_factor, seconds_condense;
} rb_rolling_body_flexibility;

struct rb_rolling_body_kind {
    const char *name; /* in pictures */
    rb_bem_support support;
    int (*holds)(const rb_rolling_body *body); /* 1: the body has this
                                                  addition; NULL: the row of a support */
    int can;                                   /* a sum of rb_rolling_ability */
    const rb_rolling_parameter *parameters;
    /* Checks ranges of the parameters; for an addition it is called for every body, with
     * or without the addition.  which: "", or "-b" of body B.  NULL: nothing to check. */
    rb_status (*check)(const rb_rolling_case *rc, const rb_rolling_body *body, const char *which,
                       rb_message *why);

    /* Of the support only: */
    rb_status (*flexibility)(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                             const rb_rolling_body *body, const rb_rolling_mesh *mesh,
                             rb_rolling_body_flexibility *one_body, rb_message *why);
    /* That of the half-plane which answers like the body close to a load, along the same surface;
     * NULL: there is none beside the body itself. */
    rb_status (*near)(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                      const rb_rolling_body *body, const rb_rolling_mesh *mesh,
                      rb_rolling_body_flexibility *one_body, rb_message *why);
    /* The same for equal elements by Fourier transforms, without a matrix, for bodies for
     * which `transformed` returns 1 (NULL: half-planes); NULL: never. */
    int (*transformed)(const rb_rolling_case *rc, const rb_rolling_body *body);
    rb_status (*transforms)(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                            const rb_rolling_body *body, const rb_rolling_mesh *mesh,
                            rb_rolling_body_flexibility *one_body, rb_message *why);
    /* The half-plane or layer that answers like the body close to a load (surface.h). */
    rb_bem_surface (*surface)(const rb_rolling_case *rc, const rb_rolling_body *body,
                              double length[RB_ROLLING_TERMS]);
    /* Depth of zero displacement; NULL: not defined. */
    double (*datum)(const rb_rolling_case *rc, const rb_rolling_body *body);
};

/* Whether a body has these additions. */
static inline int rb_rolling_has_layer(const rb_rolling_body *body)
{
    return body->layer > 0.0;
}
static inline int rb_rolling_has_memory(const rb_rolling_body *body)
{
    return body->memory.n > 0;
}

/* All rows; NULL ends the list. */
extern const rb_rolling_body_kind *const rb_rolling_body_kinds[];

/* ---- body_wheel.c, body_halfplane.c --------------------------------------------- */

/* Poisson's ratio up to which boundary elements compute a cover on an elastic core. */
#define RB_ROLLING_COMPRESSIBLE 0.499
/* 1: a cover with an elastic core. */
static inline int rb_rolling_has_elastic_core(const rb_rolling_body *body)
{
    return body->cover > 0.0 && body->core_young > 0.0;
}
extern const rb_rolling_body_kind rb_rolling_arc, rb_rolling_hub, rb_rolling_cover;
extern const rb_rolling_body_kind rb_rolling_halfplane, rb_rolling_layer, rb_rolling_relaxation;
rb_bem_surface rb_rolling_halfplane_surface(const rb_rolling_case *rc, const rb_rolling_body *body,
                                            double length[RB_ROLLING_TERMS]);
/* L = V tau of each term. */
void rb_rolling_memory_lengths(const rb_rolling_case *rc, const rb_rolling_body *body,
                               double length[RB_ROLLING_TERMS]);

/* The boundary elements of A or B, a wheel, again, factored or for few loads
 * (rb_bem_system_create_for_few); owned by the caller. */
rb_status rb_rolling_boundary_system(const rb_rolling_model *model, int of_b, int few,
                                     rb_bem_system **system, rb_message *why);
/* 1: the flexibility of the wheel has its near field in closed form. */
int rb_rolling_subtracts(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                         const rb_rolling_body *body);
/* A wheel on a hub or a cover; borrows length and the body. */
rb_bem_wheel rb_rolling_wheel_of(const rb_rolling_case *rc, const rb_rolling_body *body,
                                 double length[RB_ROLLING_TERMS]);

/* ---- material.c ----------------------------------------------------------------- */

/* Checks that nu, the value of an option, is in the range of plane stress, if that is the
 * problem. */
rb_status rb_rolling_check_poisson(const rb_rolling_case *rc, const char *option, double poisson,
                                   rb_message *why);

/* ---- body.c --------------------------------------------------------------------- */

/* body_check.c: checks a body.  RB_EINVAL: invalid values.  which: "", or "-b" of body B. */
rb_status rb_rolling_body_check(const rb_rolling_case *rc, const rb_rolling_body *body,
                                const char *which, int plane_allowed, rb_message *why);

/* The given datum of a half-plane, or 2R/e with R of the body (of A for a plane); NAN if
 * displacements are not relative to a datum: wheels, and layers on a rigid base. */
double rb_rolling_datum(const rb_rolling_case *rc, const rb_rolling_body *body);

/* ---- body_memory.c -------------------------------------------------------------- */

/* Computes the viscoelastic part, memory = whole - glassy, 2m x 2n, in two calls: before
 * the viscoelastic part is added to the flexibility, and after. RB_ENOMEM. */
rb_status rb_rolling_memory_before(const rb_bem_flexibility *glassy, double **memory);
void rb_rolling_memory_after(const rb_bem_flexibility *whole, double *memory);

/* ---- bodies.c, displacement.c, stretch.c ----------------------------------------- */

/* Builds the flexibility of A or B anew: w = w0 + F r (2m) of that body in its own frame, and x and
 * h of its elements (m; NULL: not wanted). */
rb_status rb_rolling_body_displacement(const rb_rolling_model *model, int of_b, const double *r,
                                       double *w, double *x, double *h, rb_message *why);

/* What the rest of wheels adds to half-planes. */
typedef struct rb_rolling_far_field rb_rolling_far_field;

/* The same bodies with their matrix, where they have none: f and transforms are new, also after
 * a failure, the rest is borrowed. */
rb_status rb_rolling_bodies_with_matrix(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                        const rb_rolling_bodies *bodies, rb_rolling_bodies *stored,
                                        rb_message *why);

/* 1: both bodies are half-planes of one material each and the mesh `to` is `from`, moved and made
 * `*scale` times as long; their matrix is then that of `to`, to which each element has added
 * `*along` [1/stress] times its length everywhere.  0: nothing has changed. */
int rb_rolling_bodies_stretch(const rb_rolling_case *rc, const rb_rolling_mesh *from,
                              const rb_rolling_mesh *to, rb_rolling_bodies *bodies, double *scale,
                              double *along);

/* Both bodies by what is near to the loads: wheels by half-planes, and by the far field, where one
 * is given (otherwise NULL); without systems of boundary elements. */
rb_status rb_rolling_bodies_near(const rb_rolling_case *rc, const rb_rolling_far_field *far,
                                 const rb_rolling_mesh *mesh, rb_rolling_bodies *bodies,
                                 rb_message *why);

/* Compression of boundaries whose flexibility is subtracted from that of others nearby: what
 * hierarchical matrices leave out by chance is divided by the step between them. */
#define RB_ROLLING_CLOSE 1e-13

#endif
