/* Pictures of the finite-element examples; statuses as in program/report/report.h. */
#ifndef ROLLBEM_FEM_PICTURES_H
#define ROLLBEM_FEM_PICTURES_H

#include "fem/fem.h"
#include "program/report/report.h"

/* The deformed mesh and the reactions after the last increment (*Kanno*, figures 5, 6). */
rb_status rb_fem_picture_bar(FILE *out, rb_report_canvas canvas, const rb_fem_model *model,
                             const rb_fem_history *history, rb_message *why);

/* Displacement increments of a quarter of the contact nodes and their displacements at
 * the end (*Kanno*, figures 3, 4). */
rb_status rb_fem_picture_truss(FILE *out, rb_report_canvas canvas, const rb_fem_model *model,
                               const rb_fem_history *history, rb_message *why);

/* The deformed wall; the shear force and the iterations of the solver over the drift. */
rb_status rb_fem_picture_wall(FILE *out, rb_report_canvas canvas, const rb_fem_wall *wall,
                              int steps, const rb_fem_wall_step *step, rb_message *why);

#endif
