/* Declarations shared by the files of this folder. */
#ifndef ROLLBEM_HISTORY_INTERNAL_H
#define ROLLBEM_HISTORY_INTERNAL_H

#include "rolling/body/former_place.h"
#include "rolling/history/history.h"
#include "rolling/history/wear.h"
#include "rolling/solve/cycle.h"
#include "rolling/solve/heat.h"

/* ---- relax.c ----------------------------------------------------------------------- */

/* A viscoelastic body and the filtered tractions of each of its relaxation terms (V6). */
typedef struct {
    const rb_rolling_memory *memory; /* borrowed from the case */
    double sign;                     /* 1: body A, -1: B, whose tangent is mirrored */
    rb_bem_flexibility f;            /* of the glassy body under all elements; owned */
    double *past;                    /* terms x 2 all */
    /* Of a half-plane that rolls: depth of its datum, displacement per force (0: none), and by
     * how much loads that have moved on raise it in both directions, now and one step ago (V2). */
    double datum, raises, raised[2], raised_before[2];
} rb_rolling_relaxing;

/* Stored tractions of both bodies: on the n elements of the mesh, and on `tail` elements
 * behind them, for the material that has left the mesh. */
typedef struct {
    int n, tail, all, bodies;
    rb_rolling_relaxing body[2];
    double h;         /* of the elements */
    double *traction; /* 2 all: on A at the end of the last step */
    double *force;    /* 2 x (tail + 1): P and Q of the steps before, the last one first */
    int rolled;       /* steps so far that have moved the material */
    double *scratch;  /* (2 all + 2) x 4 */
    double lost;      /* energy that the bodies have dissipated so far [force] */
} rb_rolling_memory_track;

/* Creates a track for bodies at rest without earlier loads; its arrays are memory's.  tail >
 * 0: equal elements. */
rb_status rb_rolling_memory_track_create(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                         int tail, rb_arena *memory, rb_rolling_memory_track *r,
                                         rb_message *why);
/* Before a step is solved: the displacement w0 (2m) that its bodies bring along.  rolls:
 * 1: the material moves by one element towards -x. */
void rb_rolling_memory_track_begin(rb_rolling_memory_track *r, double step, int rolls, double *w0);
/* After it, with the tractions on A that were found. */
void rb_rolling_memory_track_end(rb_rolling_memory_track *r, double step, const double *p,
                                 const double *q);
/* At rest: what the track remembers, as so many numbers, and back. */
size_t rb_rolling_memory_track_size(const rb_rolling_memory_track *r);
void rb_rolling_memory_track_save(const rb_rolling_memory_track *r, double *numbers);
void rb_rolling_memory_track_restore(rb_rolling_memory_track *r, double *numbers);
void rb_rolling_memory_track_free(rb_rolling_memory_track *r);

/* ---- carried.c --------------------------------------------------------------------- */

/* State variables that the particles bring into a step of a history.  The caller sets the
 * first five members. */
typedef struct {
    const rb_rolling_case *rc;     /* of the history; borrowed */
    rb_rolling_model *model;       /* after the last step; borrowed */
    double step;                   /* length of a rolled step; 0: no rolling */
    int steps;                     /* in all */
    int keeps_elements;            /* 1: keep the elements of the given states */
    rb_arena memory;               /* of all arrays that follow */
    double *w_T;                   /* n: tangential displacement that the next step starts from */
    double strain;                 /* of bulk stresses in the step before (U1) */
    double *mu;                    /* n: coefficients before the step */
    double mu_given;               /* the coefficient of the case in the step before */
    double *yielded;               /* n + 1: plastic slip of the interface, to be moved with the
                                      particles */
    double *w;                     /* 2 (n + 1): displacements of the last step */
    rb_rolling_former_place ahead; /* for steps whose length is not that of an element */
    rb_rolling_heat_track heat;
    rb_rolling_memory_track past; /* of viscoelastic bodies */
    double interval; /* step length [s] for which the present bodies were built; -1: none */
} rb_rolling_particles;

/* A step: rolled distance c (0: at rest) and duration in seconds. */
typedef struct {
    double c, interval;
    int is_first; /* 1: at rest, the first step */
} rb_rolling_stride;

/* Length of the middle element; all elements have the same length. */
double rb_rolling_middle_length(const rb_rolling_model *model);
/* This call may change the mesh of the model. */
rb_status rb_rolling_particles_create(rb_rolling_particles *r, rb_message *why);
/* Before a step is solved: moves the state variables to the places of the particles. */
rb_status rb_rolling_particles_bring(rb_rolling_particles *r, const rb_rolling_stride *stride,
                                     rb_message *why);
/* The bodies that relax as elastic ones over a step of this interval [s]. */
rb_status rb_rolling_particles_bodies(rb_rolling_particles *r, double interval, rb_message *why);
/* After a step: stores the state variables. */
void rb_rolling_particles_leave(rb_rolling_particles *r, const rb_rolling_stride *stride);
void rb_rolling_particles_free(rb_rolling_particles *r);

/* ---- fretting.c -------------------------------------------------------------------- */

/* Gives the model a cycle that starts from its state; RB_EINVAL: the stress of a body is not known.
 */
rb_status rb_rolling_cycle_begin(rb_rolling_model *model, rb_message *why);
/* A row begins, perhaps once more in other steps; the model has gone one step of it; the row ends
 * with the state of the model. */
void rb_rolling_cycle_begin_row(rb_rolling_cycle *cycle);
void rb_rolling_cycle_step(const rb_rolling_model *model);
rb_status rb_rolling_cycle_end_row(const rb_rolling_model *model, rb_message *why);
/* What comes after it is no part of the cycle. */
void rb_rolling_cycle_end(rb_rolling_model *model);
/* The largest difference between the friction now and where it began, as a part of mu p0. */
double rb_rolling_cycle_misses(const rb_rolling_model *model);

/* ---- stroke.c ---------------------------------------------------------------------- */

/* Worn profiles of A and B that move over each other by a stroke, in elements of equal length, and
 * the positions of A at which the contact is solved. */
typedef struct {
    int positions; /* 0: the stroke is small, both wear in the same contact */
    int n, more;   /* elements of A; those of B on either side besides */
    double h;      /* length of the elements */
    double reach;  /* the longest stroke [length] */
    double stroke; /* the present one: A is at -stroke ... stroke over B [length] */
    rb_arena memory;
    double *at;     /* positions: place of A over B, in strokes */
    double *weight; /* positions: of the time that A is there, sum 1 */
    double *sense;  /* positions: sign of q, -1 where A slides towards +x; 0: p does not feel it */
    double *a, *b;  /* n and n + 2 more: worn off A and B, in the frame of each [length] */
    double *start;  /* both, as kept */
} rb_rolling_stroke;

/* reach: the longest stroke; couples: 1: the pressure depends on the sense of sliding.  RB_ENOMEM;
 * free in any case. */
rb_status rb_rolling_stroke_create(int n, int couples, double reach, double half_width, double h,
                                   rb_rolling_stroke *stroke);
void rb_rolling_stroke_free(rb_rolling_stroke *stroke);
/* So many more elements on either side. */
rb_status rb_rolling_stroke_widen(rb_rolling_stroke *stroke, int more);
/* (W5) depth (n): what both have lost below the elements of A, which is at `at` strokes. */
void rb_rolling_stroke_depth(const rb_rolling_stroke *stroke, double at, double *depth);
/* (W5) Wears rate times the pressures off (n x positions), B by its share. */
void rb_rolling_stroke_wear(rb_rolling_stroke *stroke, double rate, double share, const double *p);
/* Keeps the profiles, and restores those kept last. */
void rb_rolling_stroke_keep(rb_rolling_stroke *stroke);
void rb_rolling_stroke_restore(rb_rolling_stroke *stroke);

/* ---- steady.c ---------------------------------------------------------------------- */

/* The state that those behind it have not left so far. */
enum { RB_ROLLING_STEADY_VALUES = 7 };
typedef struct {
    int row;         /* of the history; -1: none */
    double from, to; /* way at that state and at the last one [length] */
    double most;     /* how far those behind it have been, in their own scales */
    double *p, *q;   /* its tractions */
    double value[RB_ROLLING_STEADY_VALUES], largest[RB_ROLLING_STEADY_VALUES];
} rb_rolling_steady;

rb_status rb_rolling_steady_create(int n, rb_arena *memory, rb_rolling_steady *steady);
/* A rolled step of the row h->n of the history, after `way` [length] so far. */
void rb_rolling_steady_see(rb_rolling_steady *steady, const rb_rolling_model *model,
                           const rb_rolling_history *h, double way);
/* The row from which on nothing has changed, or -1. */
int rb_rolling_steady_from(const rb_rolling_steady *steady, const rb_rolling_case *rc,
                           const rb_rolling_history *h);

/* ---- program.c --------------------------------------------------------------------- */

/* 1: two rows prescribe the same, whatever their times. */
int rb_rolling_program_is_same(const rb_rolling_program *program, int a, int b);
/* Number of rows at rest at the beginning of the program. */
int rb_rolling_program_at_rest(const rb_rolling_program *program);
/* Number of steps at rest from row r - 1 to row r. */
int rb_rolling_program_parts(const rb_rolling_program *program, const rb_rolling_case *rc, int r);
/* The case of row r at rest, or at the fraction part/parts between row r - 1 and row
 * r. */
rb_rolling_case rb_rolling_program_row(const rb_rolling_program *program, const rb_rolling_case *rc,
                                       int r, int part, int parts);
/* Steps of row r at rest in so many increments: the first row presses and then loads. */
int rb_rolling_program_steps(const rb_rolling_program *program, const rb_rolling_case *rc, int r,
                             int increments);
/* The case of a step rolled from one distance to another. */
rb_rolling_case rb_rolling_program_step(const rb_rolling_program *program,
                                        const rb_rolling_case *rc, double from, double to);
/* Checks a row, which may be without contact: a load of 0 or an approach of at most 0. */
rb_status rb_rolling_program_check_case(const rb_rolling_case *rc, rb_message *why);
/* Checks that each row is a valid case. */
rb_status rb_rolling_program_check(const rb_rolling_program *program, const rb_rolling_case *rc,
                                   rb_message *why);
/* The program of a case without a history: increments of pressing and of loading, then
 * rolling.  Its columns are memory's.  RB_ENOMEM. */
rb_status rb_rolling_program_of_case(const rb_rolling_case *rc, rb_arena *memory,
                                     rb_rolling_program *program);

#endif
