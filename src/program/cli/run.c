#include "program/cli/run.h"

#include "program/cli/interrupt.h"
#include "program/cli/output.h"
#include "program/cli/wait.h"
#include "base/io/io.h"
#include "program/report/report.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
    const cli_steps *steps;
    rb_units units;
    double start, shown; /* when the run began, when the last line was printed [s] */
    int written;         /* the last step that has a snapshot, counted from 1 */
    rb_status failed;    /* of a snapshot */
    rb_message *why;
} watch;

typedef struct {
    const rb_rolling_case *rc;
    const rb_rolling_solution *solution;
    const rb_rolling_note_list *notes;
    const rb_report_style *style;
} snapshot;

static rb_status write_table(FILE *out, const void *context, rb_message *why)
{
    (void)why;
    const snapshot *it = context;
    return rb_report_table(out, it->rc, it->solution, it->notes, cli_command_line(), it->style);
}

/* Owned by the caller; NULL: no memory. */
static char *name_snapshot(const char *folder, int step, const rb_report_style *style)
{
    char name[40];
    snprintf(name, sizeof name, "step_%06d.%s", step,
             style->format == RB_REPORT_CSV ? "csv" : "tsv");
    return rb_io_join(folder, name);
}

rb_status cli_write_snapshot(const char *folder, int step, const rb_rolling_case *rc,
                             const rb_rolling_solution *solution, const rb_rolling_note_list *notes,
                             const rb_report_style *style, rb_message *why)
{
    const snapshot it = {rc, solution, notes, style};
    char *path = name_snapshot(folder, step, style);
    const rb_status s =
        path ? cli_write_to(path, write_table, &it, why) : rb_fail(why, RB_ENOMEM, "out of memory");
    free(path);
    return s;
}

static int after_step(const rb_rolling_model *model, const rb_rolling_history *history, int step,
                      int steps, void *context)
{
    watch *w = context;
    const cli_steps *asked = w->steps;
    if (!model) /* a coarser run, for the error bars */
        return cli_interrupted();
    if (asked->progress || asked->terminal) {
        /* Runs of a second or less are over before anyone has read it. */
        const double now = rb_seconds(), pause = asked->terminal ? 0.1 : 0.5;
        const int last = step + 1 == steps;
        const int is_long = now - w->start >= 1.0 || asked->progress;
        if (is_long && (now - w->shown >= pause || last)) {
            fprintf(
                stderr, "%sstep %d of %d: distance %.4g a, xi = %.4g, Q = %.4g %s, %.0f s left%s",
                asked->terminal ? "\r" : "", step + 1, steps, history->distance[step],
                history->creepage[step],
                rb_unit_shown(w->units, "N/mm", history->tangential_load[step]),
                rb_unit_name(w->units, "N/mm"), (now - w->start) / (step + 1) * (steps - step - 1),
                asked->terminal && !last ? "\033[K" : "\n");
            w->shown = now;
            cli_wait_rest();
        }
    }
    if (step == 0 && w->written > 0) {
        /* A run that starts again on a wider zone has other steps. */
        for (int k = asked->every; k <= w->written; k += asked->every) {
            char *path = name_snapshot(asked->snapshots, k, &asked->style);
            if (path)
                remove(path);
            free(path);
        }
        w->written = 0;
    }
    if (asked->snapshots && ((step + 1) % asked->every == 0 || step + 1 == steps)) {
        rb_rolling_solution solution = {0};
        rb_status s = rb_rolling_model_solution(model, &solution, w->why);
        rb_rolling_solution_convert(&solution, w->units);
        if (s == RB_OK) {
            const rb_rolling_note_list notes = rb_case_find_notes(asked->words, &solution, NULL);
            s = cli_write_snapshot(asked->snapshots, step + 1, model->rc, &solution, &notes,
                                   &asked->style, w->why);
        }
        w->written = step + 1;
        rb_rolling_solution_free(&solution);
        w->failed = s;
    }
    if (asked->states && w->failed == RB_OK &&
        rb_rolling_states_keep(model, history, step, steps, asked->states) != RB_OK)
        w->failed = rb_fail(w->why, RB_ENOMEM, "states: out of memory for %d steps", steps);
    if (asked->proof && w->failed == RB_OK) {
        const int before = step ? asked->proof->steps_proved : 0;
        w->failed = rb_rolling_model_prove(model, asked->proof, w->why);
        asked->proof->steps = step + 1;
        asked->proof->steps_proved = before + asked->proof->proved;
    }
    return cli_interrupted() || w->failed != RB_OK;
}

rb_status cli_run_case(const rb_resolved_case *c, const cli_steps *steps, rb_case_result *r,
                       rb_message *why)
{
    static const cli_steps silent = {0};
    rb_message failure = {.text = ""};
    watch w = {.steps = steps ? steps : &silent,
               .units = c->units,
               .start = rb_seconds(),
               .why = &failure};
    memset(r, 0, sizeof *r);
    if (!rb_case_has_steps(c))
        return rb_case_solve_again(c, NULL, NULL, r, why);
    rb_status s = w.steps->snapshots ? rb_io_make_folder(w.steps->snapshots, why) : RB_OK;
    if (s == RB_OK) {
        /* An interrupt ends the run after the current step. */
        cli_interrupts_catch();
        rb_interrupt_by((rb_interrupt){NULL, NULL}); /* what is printed ends with a whole step */
        s = rb_case_solve(c, after_step, &w, r, why);
        cli_interrupts_leave();
    }
    if (w.failed == RB_OK)
        return s;
    *why = failure;
    return w.failed;
}
