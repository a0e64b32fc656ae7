/* A history on its way: what its rows and their steps share. */
#ifndef ROLLBEM_ROLLING_HISTORY_ROW_H
#define ROLLBEM_ROLLING_HISTORY_ROW_H

#include "rolling/history/history.h"
#include "rolling/history/internal.h"

/* A row is an entry of the history.  It is computed in one step or more, of which the last one
 * is recorded. */
typedef struct {
    rb_rolling_case base;                /* the case with equal elements, for the steps */
    rb_rolling_program own;              /* of the case, where none is given */
    rb_arena columns;                    /* of own */
    const rb_rolling_case *rc;           /* base */
    const rb_rolling_program *program;   /* own, or the given one */
    const rb_rolling_observer *observer; /* or NULL */
    const rb_rolling_states *found;      /* of the rows, to follow without solving; or NULL */
    const rb_rolling_model *like;        /* whose bodies may be borrowed; or NULL */
    const rb_rolling_mesh *elements;     /* that `scale` moves the ends of; or NULL */
    double compression;                  /* of boundaries, where states are found */
    double scale;                        /* of `elements` */
    int is_variant;                      /* 1: of the history that has found them */
    rb_rolling_model *model;
    rb_rolling_history *history;
    int rows;     /* in all */
    int at_rest;  /* of them, before the bodies roll */
    int rolled;   /* steps of a row that rolls */
    double shift; /* rigid shift so far [length] */
    rb_rolling_particles particles;
    rb_rolling_steady steady;
    int frets_from, frets_to; /* row after which the cycle of --fretting begins, and its last */
    int row, part;            /* of the program: rows towards this one that are done */
    int step, steps;          /* of the present row: done, and in all */
    int not_unique;           /* 1: in the present row the motion of a step before its end is not */
    rb_rolling_stride stride; /* the current step */
    double to;                /* [half-widths]: where it ends */
    struct {
        double of_P;         /* how far Q falls, as a part of mu P */
        double shift, force; /* before */
    } fall;                  /* the largest in a step of the row to full sliding (F6) */
} history_state;

/* ---- row.c ---------------------------------------------------------------------- */

/* The next row is one at rest. */
int rb_rolling_row_is_at_rest(const history_state *r);
/* Steps of the next row at rest where they do not depend on the answer; 0: they do. */
int rb_rolling_row_steps_at_rest(const history_state *r);
/* The problem of the next step: at rest, where the rigid shift or the given force moves
 * the contact towards a row of the program, or on the way. */
rb_status rb_rolling_row_begin_step(history_state *r, rb_message *why);
/* Solves it from the state that the model has. */
rb_status rb_rolling_row_solve_step(const history_state *r, rb_message *why);
/* Takes the state that the model has, which a solve with status s has left, as that of the step;
 * records the row behind its last one. */
void rb_rolling_row_end_step(history_state *r, rb_status s);
/* 1: a force is given, and what sticks is at the bound of its friction while the others slide
 * towards both sides. */
int rb_rolling_row_is_not_unique(const history_state *r);
/* A row in this number of steps. */
rb_status rb_rolling_row_compute(history_state *r, int steps, rb_message *why);

/* ---- row_at_rest.c -------------------------------------------------------------- */

/* Steps are halved until the state at the end of the row no longer depends on them. */
rb_status rb_rolling_row_compute_at_rest(history_state *r, rb_message *why);
/* The last row is the first one in which the contact has jumped. */
void rb_rolling_row_note_jump(const history_state *r);

#endif
