/* Solving a case of any formulation, the model kept. */
#ifndef ROLLBEM_CLI_RUN_H
#define ROLLBEM_CLI_RUN_H

#include "rollbem/case.h"

typedef struct {
    rb_rolling_model model;
    rb_rolling_solution solution;      /* n = 0: there is none */
    rb_rolling_history history;        /* n = 0: not a sequence of steps */
    rb_rolling_history history_errors; /* n = 0: not asked for */
    int has_errors; /* of the solution; of a history each step has them */
    rb_rolling_errors errors;
    int elements; /* that --accuracy took; 0: not asked */
} cli_run_result;

/* What a sequence of steps leaves on its way. */
typedef struct {
    int progress;          /* a line on standard error now and then */
    int terminal;          /* the line stays in its place */
    const char *snapshots; /* folder for traction tables, or NULL */
    int every;             /* steps from one to the next; the last step has one too */
} cli_steps;

/* Steady and static cases at once, transients and histories step by step; an interrupt
 * (control-C) ends the latter after the step at hand. steps NULL: nothing on
 * the way.  With error bars of a solution there is no model (model.state.p NULL).  Free
 * the result in any case. */
rb_status cli_run_case(const rb_settled_case *c, const cli_steps *steps,
                       cli_run_result *r, rb_message *why);
void cli_run_free(cli_run_result *r);

#endif
