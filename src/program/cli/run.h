/* Solving a case with a terminal to look at. */
#ifndef ROLLBEM_CLI_RUN_H
#define ROLLBEM_CLI_RUN_H

#include "rolling/case/case.h"
#include "program/report/report.h"

/* What a sequence of steps leaves on its way. */
typedef struct {
    int progress;              /* print progress on standard error */
    int terminal;              /* the line stays in its place */
    const rb_case *words;      /* the case, for the notes of the snapshots */
    const char *snapshots;     /* folder for traction tables, or NULL */
    rb_report_style style;     /* of the snapshots */
    int every;                 /* steps from one to the next; the last step has one too */
    rb_rolling_states *states; /* of all steps, overwritten; or NULL */
    rb_contact_proof *proof;   /* of the last step, with the number of steps that are proved; or
                                  NULL */
} cli_steps;

/* The tractions after that step as a file of the folder: step_000012.tsv, or .csv.  rc,
 * notes: as of rb_report_table. */
rb_status cli_write_snapshot(const char *folder, int step, const rb_rolling_case *rc,
                             const rb_rolling_solution *solution, const rb_rolling_note_list *notes,
                             const rb_report_style *style, rb_message *why);

/* rb_case_solve, where an interrupt (control-C, SIGTERM, SIGHUP) ends a sequence of steps
 * after the current one.  steps NULL: nothing on the way.  Free the result in any
 * case. */
rb_status cli_run_case(const rb_resolved_case *c, const cli_steps *steps, rb_case_result *r,
                       rb_message *why);

#endif
