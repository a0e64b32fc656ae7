/* The search for the largest stresses of body A: places, points that are looked at first, and the
 * way from a point to the top of its peak. */
#ifndef ROLLBEM_ROLLING_STRESS_SEARCH_H
#define ROLLBEM_ROLLING_STRESS_SEARCH_H

#include "rolling/body/body.h"
#include "rolling/stress/field.h"
#include "rolling/solve/model.h"
#include "rolling/stress/stress.h"

/* Places are (s, depth): along the surface and below it, the arc of a wheel's circle; each
 * material is then a strip between two depths. */
typedef struct {
    rb_rolling_place material;
    double top, bottom; /* depths */
} rb_search_strip;

/* Points at one depth, s increasing. */
typedef struct {
    const rb_search_strip *in;
    double depth;
    int first, n;
} rb_search_row;

typedef struct {
    const rb_rolling_model *model;
    rb_rolling_field *field;
    double radius;      /* 0: flat */
    double low, high;   /* s of the outermost nodes of the tractions */
    double middle;      /* s of the middle of the widest contact */
    double reach;       /* how far on either side of them */
    double *left_out;   /* s of the two ends of a clamped arc, or of jumps of given friction */
    double around_them; /* how far the stress is left out there */
    int left_outs;
    int strips, rows, n;
    rb_search_strip *strip;
    rb_search_row *row;
    double *s, *at_s; /* candidates for s; of the points */
    int candidates;
    rb_rolling_stress *at;
    int along_bond; /* 1: stresses have the directions of the bond, not those of x and y */
} rb_search;

/* ---- search_points.c ------------------------------------------------------------------- */

/* Layer `k` of a half-plane, and behind the last one the base, which is so deep. */
rb_search_strip rb_search_strip_of(const rb_rolling_body *a, int k, double deep);
/* x and y of a place in a strip. */
void rb_search_xy(const rb_search *f, const rb_search_strip *in, double s, double depth,
                  double xy[2]);
/* 1: the place is so near to a singular point that the stress is left out. */
int rb_search_leaves_out(const rb_search *f, double s, double depth);
/* Stress at n places of a strip.  RB_ENOMEM, or as for rb_rolling_field_at. */
rb_status rb_search_stress(const rb_search *f, const rb_search_strip *in, int n, const double *s,
                           const double *depth, rb_rolling_stress *at, rb_message *why);
/* From the directions of x and y to those of a circle about A's centre. */
void rb_search_turn(double radius, rb_rolling_stress *at);
/* Sets strips and rows down to the depth (0: as deep as the stress matters), and the stress at
 * their points; all in `memory`.  f has model and field. */
rb_status rb_search_look(rb_search *f, double depth, rb_arena *memory, rb_message *why);

/* ---- search_peaks.c -------------------------------------------------------------------- */

typedef double rb_search_measure(const rb_rolling_stress *s);

/* Climbs from a place, by these steps at first, to the top of its peak: sets place and top.  A
 * peak that is below `enough` when the steps have become small is given up. */
rb_status rb_search_climb(const rb_search *f, rb_search_measure *of, const rb_search_strip *in,
                          double step_s, double step_depth, double enough, double place[2],
                          double *top, rb_message *why);
/* Takes the top of a peak as the best one if it is higher than the largest so far; of two that
 * rounding alone tells apart, as in a symmetric contact, that on the right. */
void rb_search_keep(const rb_search *f, const rb_search_strip *in, const double place[2],
                    double top, double *largest, rb_rolling_extremum *best);
/* The largest value at and near the points of all rows. */
rb_status rb_search_maximum(const rb_search *f, rb_search_measure *of, rb_rolling_extremum *best,
                            rb_message *why);

/* ---- search_bonds.c -------------------------------------------------------------------- */

/* Peel, shear and tension along a bond, the first one being 0, if the search goes down to it; a
 * rigid base and a core have no stress of their own. */
rb_status rb_search_bond(rb_search *f, int which, double searched, rb_rolling_stress_maxima *maxima,
                         rb_message *why);
/* The tension of layers farther from the contact than the search has reached. */
rb_status rb_search_far(rb_search *f, double searched, rb_rolling_stress_maxima *maxima,
                        rb_arena *memory, rb_message *why);

/* ---- maxima_list.c --------------------------------------------------------------------- */

/* The measure of rb_rolling_maximum(m, k): six of the body, one of which is tension, and then four
 * of each bond, in its own directions, the last one of the material below it. */
enum {
    RB_SEARCH_TENSION = 4,
    RB_SEARCH_IN_BODY = 6,
    RB_SEARCH_BELOW_BOND = 3,
    RB_SEARCH_OF_BOND = 4
};
rb_search_measure *rb_search_measure_of(int k);

#endif
