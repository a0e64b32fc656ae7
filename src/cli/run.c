#include "cli/run.h"

#include "cli/cli.h"
#include "rollbem/io.h"
#include "rollbem/report.h"

#include <errno.h>
#include <signal.h>
#include <string.h>
#include <sys/stat.h>

/* ---- Steps ------------------------------------------------------------------------- */

static volatile sig_atomic_t interrupted;

static void note_interrupt(int signal_number)
{
    (void)signal_number;
    interrupted = 1;
}

typedef struct {
    const cli_steps *steps;
    double start, shown; /* when the run began, when the last line was printed [s] */
    rb_status failed;    /* of a snapshot */
    rb_message *why;
} watch;

/* Runs of a second or less are over before anyone has read it. */
static void show_progress(watch *w, const rb_rolling_history *h, int step, int steps)
{
    const double now = rb_seconds(), pause = w->steps->terminal ? 0.1 : 0.5;
    const int last = step + 1 == steps;
    if (now - w->start < 1.0 && !w->steps->progress)
        return;
    if (now - w->shown < pause && !last)
        return;
    fprintf(stderr,
            "%sstep %d of %d: distance %.4g a, xi = %.4g, Q = %.4g N/mm, %.0f s left%s",
            w->steps->terminal ? "\r" : "", step + 1, steps, h->distance[step],
            h->creepage[step], h->tangential_load[step],
            (now - w->start) / (step + 1) * (steps - step - 1),
            w->steps->terminal && !last ? "\033[K" : "\n");
    w->shown = now;
}

static rb_status write_snapshot(const char *folder, const rb_rolling_model *model,
                                int step, rb_message *why)
{
    char path[1100];
    rb_rolling_solution solution = {0};
    rb_io_writer w;
    snprintf(path, sizeof path, "%.1000s/step_%06d.tsv", folder, step + 1);
    rb_status s = rb_rolling_model_solution(model, &solution, why);
    if (s == RB_OK)
        s = rb_io_writer_open(path, &w, why);
    if (s == RB_OK &&
        rb_report_table(w.file, &solution, cli_command_line(), 0) != RB_OK) {
        s = rb_fail(why, RB_EWRITE, "%.200s: %s", path, strerror(errno));
        rb_io_writer_abandon(&w);
    } else if (s == RB_OK)
        s = rb_io_writer_commit(&w, why);
    rb_rolling_solution_free(&solution);
    return s;
}

static int after_step(const rb_rolling_model *model, const rb_rolling_history *history,
                      int step, int steps, void *context)
{
    watch *w = context;
    const cli_steps *asked = w->steps;
    if (!model) /* a coarser run, for the error bars */
        return interrupted;
    if (asked->progress || asked->terminal)
        show_progress(w, history, step, steps);
    if (asked->snapshots && ((step + 1) % asked->every == 0 || step + 1 == steps))
        w->failed = write_snapshot(asked->snapshots, model, step, w->why);
    return interrupted || w->failed != RB_OK;
}

static rb_status make_folder(const char *path, rb_message *why)
{
    struct stat st;
    if (!path || mkdir(path, 0777) == 0)
        return RB_OK;
    const int e = errno;
    if (e == EEXIST && stat(path, &st) == 0 && S_ISDIR(st.st_mode))
        return RB_OK;
    return rb_fail(why, RB_EWRITE, "%.200s: %s", path, strerror(e));
}

static rb_status run_steps(const rb_settled_case *c, const cli_steps *steps,
                           cli_run_result *r, rb_message *why)
{
    static const cli_steps silent = {0};
    rb_message snapshot = {""};
    watch w = {.steps = steps ? steps : &silent, .start = rb_seconds(), .why = &snapshot};
    struct sigaction act = {.sa_handler = note_interrupt}, before;
    rb_status s = make_folder(w.steps->snapshots, why);
    if (s != RB_OK)
        return s;
    interrupted = 0;
    sigaction(SIGINT, &act, &before);
    const rb_rolling_program *program = c->program.n > 0 ? &c->program : NULL;
    s = c->error
            ? rb_rolling_history_with_errors(&c->rc, program, after_step, &w, &r->model,
                                             &r->history, &r->history_errors, why)
            : rb_rolling_history_run(&c->rc, program, after_step, &w, &r->model,
                                     &r->history, why);
    sigaction(SIGINT, &before, NULL);
    if (w.failed == RB_OK)
        return s;
    if (why)
        *why = snapshot;
    return w.failed;
}

/* ---- All --------------------------------------------------------------------------- */

static rb_status run_and_finish_steps(const rb_settled_case *c, const cli_steps *steps,
                                      cli_run_result *r, rb_message *why)
{
    const double start = rb_seconds();
    rb_status s = run_steps(c, steps, r, why);
    if (s >= 0 && r->model.state.p) {
        const rb_status t = rb_rolling_model_solution(&r->model, &r->solution, why);
        s = t == RB_OK ? s : t;
    }
    if (s >= 0)
        r->solution.status = s;
    r->solution.seconds_total = rb_seconds() - start;
    return s;
}

rb_status cli_run_case(const rb_settled_case *c, const cli_steps *steps,
                       cli_run_result *r, rb_message *why)
{
    memset(r, 0, sizeof *r);
    if (rb_case_has_steps(c))
        return run_and_finish_steps(c, steps, r, why);
    r->has_errors = c->error || c->accuracy > 0.0;
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
    rb_rolling_history_free(&r->history_errors);
    rb_rolling_model_free(&r->model);
}
