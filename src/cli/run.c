#include "cli/run.h"

#include <signal.h>
#include <string.h>

/* ---- Steps ------------------------------------------------------------------------- */

static volatile sig_atomic_t interrupted;

static void note_interrupt(int signal_number)
{
    (void)signal_number;
    interrupted = 1;
}

typedef struct {
    int progress;
    double shown; /* when the last line was printed [s] */
} watch;

static void show_progress(const rb_rolling_history *h, int step, int steps)
{
    fprintf(stderr,
            "step %d of %d: distance %.4g a, xi = %.6g, Q = %.6g N/mm, %d stick\n",
            step + 1, steps, h->distance[step], h->creepage[step],
            h->tangential_load[step], h->stick[step]);
}

static int after_step(const rb_rolling_model *model, const rb_rolling_history *history,
                      int step, int steps, void *context)
{
    watch *w = context;
    const double now = rb_seconds();
    (void)model;
    if (w->progress && (now - w->shown > 0.5 || step + 1 == steps)) {
        show_progress(history, step, steps);
        w->shown = now;
    }
    return interrupted;
}

static rb_status run_steps(const cli_case *c, int progress, cli_run_result *r,
                           rb_message *why)
{
    watch w = {progress, rb_seconds()};
    struct sigaction act = {.sa_handler = note_interrupt}, before;
    interrupted = 0;
    sigaction(SIGINT, &act, &before);
    const rb_rolling_program *program = c->program.n > 0 ? &c->program : NULL;
    const rb_status s = rb_rolling_history_run(&c->rc, program, after_step, &w, &r->model,
                                               &r->history, why);
    sigaction(SIGINT, &before, NULL);
    return s;
}

/* ---- All --------------------------------------------------------------------------- */

static rb_status run_and_finish_steps(const cli_case *c, int progress, cli_run_result *r,
                                      rb_message *why)
{
    const double start = rb_seconds();
    rb_status s = run_steps(c, progress, r, why);
    if (s >= 0 && r->model.state.p) {
        const rb_status t = rb_rolling_model_solution(&r->model, &r->solution, why);
        s = t == RB_OK ? s : t;
    }
    if (s >= 0)
        r->solution.status = s;
    r->solution.seconds_total = rb_seconds() - start;
    return s;
}

rb_status cli_run_case(const cli_case *c, int progress, cli_run_result *r,
                       rb_message *why)
{
    memset(r, 0, sizeof *r);
    r->has_errors = c->error || c->accuracy > 0.0;
    if (cli_case_has_steps(c))
        return run_and_finish_steps(c, progress, r, why);
    if (c->accuracy > 0.0)
        return rb_rolling_solve_to_accuracy(&c->rc, c->accuracy, &r->solution, &r->errors,
                                            &r->elements, why);
    if (c->error)
        return rb_rolling_solve_with_errors(&c->rc, 0, &r->solution, &r->errors, why);
    return rb_rolling_solve_model(&c->rc, &r->model, &r->solution, why);
}

void cli_run_free(cli_run_result *r)
{
    rb_rolling_solution_free(&r->solution);
    rb_rolling_history_free(&r->history);
    rb_rolling_model_free(&r->model);
}
