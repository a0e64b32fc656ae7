/* Cracks of a case in words: options, contact, results. */
#ifndef ROLLBEM_SRC_ANALYSIS_CRACK_CRACK_CASE_H
#define ROLLBEM_SRC_ANALYSIS_CRACK_CRACK_CASE_H

#include "analysis/crack/crack.h"
#include "rolling/case/case.h"

/* ---- Cracks ------------------------------------------------------------------------ */

/* Growth of a crack at its lower tip by da/dN = C dK^m.  One entry per length; the first
 * is the given length.  Arrays are owned. */
typedef struct {
    int n; /* 0: growth was not computed */
    double *length, *tip_x, *tip_y, *angle, *K_I_max, *delta_K_II, *delta_K, *rate,
        *cycles;  /* cycles until the crack has this length */
    int rests;    /* 1: the crack stops, because dK is below the threshold at the last length
                   */
    int surfaced; /* 1: the crack has reached the surface again, so that a piece breaks
                     out */
    rb_crack_path path;
} rb_case_crack_growth;

/* Summary of the last pass, which begins at step `from`. */
typedef struct {
    int from;
    double K_I_max, K_I_min, K_II_max, K_II_min, delta_K_I, delta_K_II;
    double K_I_max_at, K_II_max_at, K_II_min_at; /* x */
    double K_II_at_K_I_max;                      /* K_II at the moment of the largest K_I */
    double K_theta_max;                          /* largest rb_crack_largest_tension of the pass */
    double kink_angle;                           /* its direction, from t towards n [degrees] */
    double K_I_max_upper, K_I_min_upper, K_II_max_upper, K_II_min_upper; /* or NAN */
    double open_max, fluid_pressure_max;
    double pass_change;  /* largest change of K from the pass before; NAN with one pass */
    double max_pressure; /* of the contact, if it depends on the crack; otherwise NAN */
    double residual;
} rb_case_crack_summary;

rb_case_crack_summary rb_case_crack_summarise(const rb_crack_history *history, int passes);

enum { RB_CASE_CRACK_NOTES = 7 };
typedef struct {
    rb_case_result contact; /* the contact; solution.n = 0: unloaded */
    double half_width;      /* unit of the lengths of the crack: that of the load, in a history of
                               the largest one (rb_rolling_contact_half_width) [length]; NAN:
                               nothing loads the crack, and no load is given */
    int positions; /* of a pass, where the program has added some to those of the track; otherwise
                      0 */
    double *position; /* [length]; owned */
    rb_status status; /* RB_INTERRUPTED: some passes or lengths are missing */
    int passes;
    rb_crack_shape shape;
    rb_rolling_states states; /* of the contact, if it has steps; otherwise n = 0 */
    rb_crack_history history;
    rb_case_crack_summary summary;
    int has_errors;
    rb_case_crack_summary errors; /* error of each number of the summary */
    rb_case_crack_growth growth;
    int notes;
    char note[RB_CASE_CRACK_NOTES][200]; /* notes on how to read the result */
    int note_kind[RB_CASE_CRACK_NOTES];  /* which of those that there may be: 0, 1, ... */
    int note_kinds;                      /* how many were thought of so far */
    rb_units units;                      /* of all values except shape and contact.model */
} rb_case_crack_result;

/* The crack with its lengths in mm, a being the unit of those without one (NAN: they are NAN), and
 * with the positions that are not given. */
rb_case_crack rb_case_crack_lengths(const rb_resolved_case *resolved, const rb_case_crack *crack,
                                    double a);

/* Checks the crack, the positions, and whether the case can load a crack. */
rb_status rb_case_crack_check(const rb_resolved_case *resolved, const rb_case_crack *crack,
                              rb_message *why);
/* Solves the contact and moves it over the crack; if the case wants error bars, this is
 * repeated with twice as many elements.  In transient rolling the position of the contact
 * is `from` plus the rolled distance; in a static history it stays at `from`. The observer,
 * or NULL, sees the steps of the contact and of the crack.  RB_INTERRUPTED: it ended them; if
 * history.n > 0 the result is that of the passes, or lengths, that were complete.  Free the
 * result in any case. */
rb_status rb_case_crack_solve(const rb_resolved_case *resolved, const rb_case_crack *crack,
                              const rb_crack_observer *observer, rb_case_crack_result *result,
                              rb_message *why);

/* Where the contact stands, and its tractions there. */
typedef struct {
    int n;
    double *x; /* n positions [length] */
    int loads; /* as in rb_crack_passage */
    rb_bem_edge_load *load;
    rb_crack_load_kind kind;
    double *ends;
    double bulk;     /* stress of B along its surface besides the remote one */
    double *tension; /* n: both together where they change from step to step; otherwise NULL */
    rb_arena memory; /* of the arrays; those of a result with positions are its own */
} rb_case_crack_track;

/* The case of the contact that loads the crack: of a coupled one on equal elements that reach
 * beyond the contact. */
rb_resolved_case rb_case_crack_contact(const rb_resolved_case *resolved,
                                       const rb_case_crack *crack);

/* So many times as many elements of the contact, positions that the program chooses, elements of
 * the crack, and steps of a history or equal ones as the case says. */
typedef struct {
    double contact, positions;
    int crack, steps;
} rb_case_crack_mesh;
extern const rb_case_crack_mesh rb_case_crack_own_mesh; /* once as many */

/* The track of result->contact and result->states, whose arrays it borrows; also sets
 * half_width, shape, passes and notes of the result.  Where the program chooses the positions,
 * those of the result are taken if there are any.  RB_EINVAL: a step of the contact jumps over the
 * crack; a length is out of range. */
rb_status rb_case_crack_follow(const rb_resolved_case *resolved, const rb_case_crack *crack,
                               const rb_case_crack_mesh *finer, rb_case_crack_result *result,
                               rb_case_crack_track *track, rb_message *why);
void rb_case_crack_track_free(rb_case_crack_track *track);
/* The stress along the surface in a step of a pass, the remote one and that of B. */
double rb_case_crack_tension(const rb_case_crack *crack, const rb_case_crack_track *track,
                             int step);
/* 1: a cycle of the remote stress. */
int rb_case_crack_cycles(const rb_case_crack *crack);
/* The passage of such a track without a wheel. */
rb_crack_passage rb_case_crack_passage(const rb_case_crack *crack,
                                       const rb_case_crack_track *track);

void rb_case_crack_convert(rb_case_crack_result *result, rb_units units);
void rb_case_crack_free(rb_case_crack_result *result);
/* 1: the number of the summary has a meaning for such a crack. */
int rb_case_crack_has_result(const rb_rolling_result *result, const rb_case_crack *crack);
/* A row of a parameter study (rb_rolling_sweep): numbers of the contact in row->solution,
 * of the summary in row->own. */
rb_status rb_case_crack_row(const rb_resolved_case *resolved, const rb_case_crack *crack,
                            rb_rolling_row *row, rb_message *why);
/* A number of rb_case_crack_scalars in such a row, or its error bar. */
double rb_case_crack_of_row(const rb_rolling_result *result, int is_error,
                            const rb_rolling_row *row);
/* Table k of all results, those of rb_rolling_result_tables and of cracks; NULL: there
 * are no more. */
const rb_rolling_result_table *rb_case_result_table(int k);

/* ---- crack_results.c --------------------------------------------------------------- */

/* Error bars: three times the spread over this mesh and two others of the contact, and twice the
 * difference to a finer one of the crack, where of second order a third of it is left. */
void rb_case_crack_set_errors(const rb_case_crack_summary contact[2],
                              const rb_case_crack_summary *crack, rb_case_crack_result *result);
/* The summary and its error bars as the own numbers of a row. */
void rb_case_crack_set_row(rb_case_crack_result *result, rb_rolling_row *row);

/* ---- crack_case.c ------------------------------------------------------------------ */

/* The passes of the track over a crack, of these lengths in mm, into r->history: where the program
 * chooses the positions, with more of them where K is largest and smallest; they are r's then.
 * wheel: of a coupled crack, or NULL. */
rb_status rb_case_crack_pass(const rb_resolved_case *c, const rb_case_crack *lengths,
                             const rb_case_crack_track *track, const rb_crack_wheel *wheel,
                             const rb_crack_observer *observer, rb_crack *crack,
                             rb_case_crack_result *r, rb_message *why);

/* The stress of the contact changes over the half-width a, or, deeper, over the depth: elements
 * much longer than that do not see it.  RB_EINVAL: one of n elements is; RB_ENOMEM. */
rb_status rb_case_crack_check_elements(const rb_crack_path *path, int n, double a, rb_message *why);

/* ---- growth.c ---------------------------------------------------------------------- */

/* Checks the options of crack growth. */
rb_status rb_case_check_growth(const rb_case_crack *crack, rb_message *why);
/* Computes r->growth under the same load, starting from the first length, whose summary
 * is in r. */
rb_status rb_case_grow_crack(const rb_resolved_case *c, const rb_case_crack *crack,
                             const rb_case_crack_track *track, const rb_crack_observer *observer,
                             rb_case_crack_result *r, rb_message *why);

#endif
