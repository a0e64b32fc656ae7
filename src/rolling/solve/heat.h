/* Heat of friction, steady and step by step (T1). */
#ifndef ROLLBEM_ROLLING_SOLVE_HEAT_H
#define ROLLBEM_ROLLING_SOLVE_HEAT_H

#include "rolling/solve/temperature.h"

/* V a/(2 diffusivity); INFINITY if no heat enters the body. */
double rb_rolling_peclet(const rb_rolling_heat *body, double speed, double half_width);
/* The speed at which the surface of A (of_b: B) passes the contact, V (1 -+ xi/2), V the mean of
 * both; < 0: towards +x. */
double rb_rolling_surface_speed(const rb_rolling_case *rc, int of_b, double creepage);
/* Temperatures of both surfaces (n each) under the friction power per unit speed (n) of
 * a steady solution with tractions, slip and zones, and the heat per area that enters each (NULL:
 * not asked for).  sign (n): elements with a positive one heat, and no others; power itself, or
 * that of a solution nearby.  conduction: where what the elements make of heat is kept, from NULL
 * on; freed by the caller. */
rb_status rb_rolling_steady_temperature(const rb_rolling_case *rc, const rb_rolling_solution *s,
                                        const double *power, const double *sign,
                                        struct rb_rolling_conduction **conduction, double *t_a,
                                        double *t_b, double *heat_a, double *heat_b,
                                        rb_message *why);
/* Of transient rolling: each body takes heat as its effusivity and the root of its speed. */
void rb_rolling_heat_by_effusivity(const rb_rolling_case *rc, const double *power,
                                   rb_rolling_solution *s);
/* (T1) G(z): what heat between a point and z/P upstream of it adds to its temperature. */
double rb_rolling_moving_source(double z);

/* The heat of earlier steps, for the particles that are still in the mesh. */
typedef struct rb_rolling_heat_track {
    int n, rows, newest, known; /* rows: number of stored steps (ring buffer), of which
                                   `known` are filled */
    double h, step;             /* lengths of an element and of a step */
    double half_width;          /* [length] */
    double *heat;               /* rows x n [stress * length / time] */
} rb_rolling_heat_track;

/* Creates a track for track->n elements of length h, in memory.  RB_EINVAL: the Peclet number is
 * too small for heat conduction along the depth only. */
rb_status rb_rolling_heat_track_create(const rb_rolling_case *rc, double half_width,
                                       rb_arena *memory, rb_rolling_heat_track *track,
                                       rb_message *why);
/* RB_EINVAL: the same of either surface at a creepage. */
rb_status rb_rolling_heat_track_check(const rb_rolling_case *rc, double half_width, double creepage,
                                      rb_message *why);
/* Prepares the storage for the heat of the next rolled step. */
void rb_rolling_heat_track_advance(rb_rolling_heat_track *track);
/* Stores the heat of the newest step with the friction, slip displacement and creepage of its
 * state, and computes the temperature (n) of both surfaces at its end. */
void rb_rolling_heat_track_step(const rb_rolling_case *rc, const rb_contact_state *state,
                                rb_rolling_heat_track *track, double *temperature);

#endif
