/* What the files of this folder share, with those of the folders below. */
#ifndef ROLLBEM_STUDY_INTERNAL_H
#define ROLLBEM_STUDY_INTERNAL_H

#include "rolling/history/internal.h"

/* ---- errors.c ---------------------------------------------------------------------- */

/* The largest number of rb_rolling_error_runs.  Histories and wear have a mesh more, between these
 * and their own: edges pass elements, and three meshes agree by chance. */
enum { RB_ERROR_RUNS = 3, RB_ERROR_ANOTHER_RUN = RB_ERROR_RUNS, RB_ERROR_MESHES };
/* The case of the k-th coarser run, or of that one. */
rb_rolling_case rb_rolling_error_run(const rb_rolling_case *rc, int k);
/* RB_EINVAL where the case has too few elements to be halved. */
rb_status rb_rolling_error_check(const rb_rolling_case *rc, rb_message *why);
/* The two parts of the error of a value, from what the coarser runs have for it: of the
 * contact's mesh and steps, and of the boundary outside (0 without wheels). */
double rb_rolling_contact_error(const double coarser[], double own);
/* The same with the value of another mesh, NAN where there is none. */
double rb_rolling_contact_error_with(const double coarser[], double own, double another,
                                     int is_finer);
/* At least twice the spread over all meshes, four times where they go to and fro. */
double rb_rolling_contact_error_of_phases(const double coarser[], double own, double another);
double rb_rolling_boundary_error(int runs, const double coarser[], double own);

/* The bars of all columns: of what the coarser runs found, another one between them and the series
 * itself (NULL: there is none), and of the series itself, over the same points. */
void rb_rolling_error_columns(const rb_rolling_results *columns, int rows, int runs,
                              const void *const run[], const void *another, const void *own,
                              void *errors);

/* a/R, the scale of strains under a contact of half-width a. */
double rb_rolling_error_strain(const rb_rolling_case *rc, double a);
/* What a result of this scale is made of, under the load P and the pressure p0: the tolerance of
 * the solver is a part of it.  0 where the scale is none of a load, a length or a slip. */
double rb_rolling_error_unit(const rb_rolling_case *rc, rb_rolling_error_scale scale, double P,
                             double p0, double a);
/* Power that slip at an edge dissipates over one element, the part `share` of a contact
 * of half-width a under the load P, and that a mesh may not see: the pressure is like a
 * square root there, and the slip that of the creepage and of dissimilar bodies. */
double rb_rolling_edge_power(const rb_rolling_case *rc, double P, double creepage, double a,
                             double share);

#endif
