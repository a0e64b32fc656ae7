/* What the files of this folder share, with those of rolling and of results. */
#ifndef ROLLBEM_HISTORY_INTERNAL_H
#define ROLLBEM_HISTORY_INTERNAL_H

#include "results/internal.h"

/* ---- relax.c ----------------------------------------------------------------------- */

/* A body that relaxes, and the filtered tractions of each of its terms (V6). */
typedef struct {
    const rb_rolling_memory *memory; /* borrowed from the case */
    double sign;                     /* 1: body A, -1: B, whose tangent is mirrored */
    rb_bem_flexibility f;            /* of the glassy body under all elements; owned */
    double *past;                    /* terms x 2 all; owned */
} rb_rolling_relaxing;

/* The past of both bodies: of the n elements of the mesh, and of `tail` elements behind
 * them, where the material is that has rolled out of the mesh. */
typedef struct {
    int n, tail, all, bodies;
    rb_rolling_relaxing body[2];
    double *traction; /* 2 all: on A at the end of the last step; owned */
    double *scratch;  /* owned */
    double lost;      /* work that the bodies have lost so far [force] */
} rb_rolling_memory_track;

/* What the bodies are in a step of so many seconds: elastic ones.  INFINITY: rubbery. */
rb_rolling_case rb_rolling_memory_case(const rb_rolling_case *rc, double step);
/* Bodies at rest without a past.  tail > 0: equal elements. */
rb_status rb_rolling_memory_track_create(const rb_rolling_case *rc,
                                         const rb_rolling_mesh *mesh, int tail,
                                         rb_rolling_memory_track *r, rb_message *why);
/* Before a step is solved: the displacement w0 (2m) that its bodies bring along.  rolls:
 * 1: the material moves by one element towards -x. */
void rb_rolling_memory_track_begin(rb_rolling_memory_track *r, double step, int rolls,
                                   double *w0);
/* After it, with the tractions on A that were found. */
void rb_rolling_memory_track_end(rb_rolling_memory_track *r, double step, const double *p,
                                 const double *q);
void rb_rolling_memory_track_free(rb_rolling_memory_track *r);

/* ---- carried.c --------------------------------------------------------------------- */

/* What particles carry into a step of a history.  The caller sets the first five. */
typedef struct {
    const rb_rolling_case *rc; /* of the history; borrowed */
    rb_rolling_model *model;   /* after the last step; borrowed */
    double step;               /* length of a rolled step; 0: none rolls */
    int steps;                 /* in all */
    int keeps_elements;        /* 1: those of states that are known */
    double *w_T;     /* n: tangential displacement that the next step starts from */
    double *mu;      /* n: coefficients before the step */
    double *yielded; /* n + 1: what the interface has yielded, to be brought on */
    rb_rolling_former_place ahead; /* for steps of another length than an element's */
    rb_rolling_heat_track heat;
    rb_rolling_memory_track past; /* of bodies that relax */
    double interval; /* [s] that the bodies at hand are those of; -1: of none */
} rb_rolling_particles;

/* A step: rolled by c, 0: at rest, in so many seconds. */
typedef struct {
    double c, interval;
    int is_first; /* 1: at rest, with nothing before it */
} rb_rolling_stride;

/* Length of the element in the middle, which all have. */
double rb_rolling_middle_length(const rb_rolling_model *model);
/* May change the mesh of the model. */
rb_status rb_rolling_particles_create(rb_rolling_particles *r, rb_message *why);
/* Before a step is solved: what is carried comes to where its particles are then. */
rb_status rb_rolling_particles_bring(rb_rolling_particles *r,
                                     const rb_rolling_stride *stride, rb_message *why);
/* After it. */
void rb_rolling_particles_leave(rb_rolling_particles *r, const rb_rolling_stride *stride);
void rb_rolling_particles_free(rb_rolling_particles *r);

/* ---- program.c --------------------------------------------------------------------- */

/* Rows at rest that the program begins with. */
int rb_rolling_program_at_rest(const rb_rolling_program *program);
/* Steps at rest from the row before to row r. */
int rb_rolling_program_parts(const rb_rolling_program *program, const rb_rolling_case *rc,
                             int r);
/* The case of row r at rest, or part/parts of the way there from the row before. */
rb_rolling_case rb_rolling_program_row(const rb_rolling_program *program,
                                       const rb_rolling_case *rc, int r, int part,
                                       int parts);
/* The case of a step rolled from one distance to another. */
rb_rolling_case rb_rolling_program_step(const rb_rolling_program *program,
                                        const rb_rolling_case *rc, double from,
                                        double to);
/* Each row must be a case that could be solved. */
rb_status rb_rolling_program_check(const rb_rolling_program *program,
                                   const rb_rolling_case *rc, rb_message *why);
/* The case's own: increments of pressing and of loading, then the way.  room: its
 * columns, for free(); NULL: no memory. */
double *rb_rolling_program_of_case(const rb_rolling_case *rc,
                                   rb_rolling_program *program);

#endif
