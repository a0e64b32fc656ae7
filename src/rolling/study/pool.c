/* A pool of worker processes on this machine that solve the cases of a parameter study,
 * one at a time. */
#include "rolling/solve/solution.h"
#include "rolling/stress/stress.h"
#include "rolling/study/study.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef _OPENMP
#include <omp.h>
#endif

enum { WORKERS_MAX = 256 };

typedef struct {
    pid_t pid;
    int socket; /* case numbers go out, rows come in; -1: not started */
    int k;      /* the case that it solves; -1: none */
    int again;  /* 1: another worker has died of the case already */
} worker;

typedef struct {
    rb_rolling_pool pool; /* first: processes_of turns it back */
    const rb_rolling_sweep *sweep;
    int workers, next; /* next: whom to look at first, in turn */
    worker worker[WORKERS_MAX];
} processes;

static processes *processes_of(rb_rolling_pool *pool)
{
    return (processes *)(void *)pool;
}

/* ---- One worker -------------------------------------------------------------------- */

/* Numbers of bonds that are not there stay NAN. */
static void keep_stress(const rb_rolling_sweep *sweep, rb_rolling_stress_maxima stress[2],
                        rb_rolling_errors *errors, rb_rolling_row *row)
{
    rb_rolling_stress_maxima *const bars[] = {&errors->stress, &errors->stress_b};
    for (int i = 0; i < sweep->bonds; i++) {
        const rb_rolling_bond_number *b = &sweep->bond[i];
        const double *x = rb_rolling_maximum_number(&stress[b->of_b], b->k, b->part),
                     *bar = rb_rolling_maximum_number(bars[b->of_b], b->k, b->part);
        row->bond[i] = x ? *x : NAN;
        row->bond_error[i] = bar ? *bar : NAN;
    }
    row->errors = *errors;
    if (sweep->also & RB_ROW_STRESS)
        row->stress = stress[0];
    if (sweep->also & RB_ROW_STRESS_B)
        row->stress_b = stress[1];
    rb_rolling_stress_maxima *const own[] = {&row->stress, &row->stress_b, &row->errors.stress,
                                             &row->errors.stress_b};
    for (int i = 0; i < 4; i++) { /* a row is sent as it stands */
        own[i]->bonds = 0;
        own[i]->bond = NULL;
    }
}

/* A case with a history brings its own errors along. */
static rb_status solve_history(const rb_rolling_sweep *sweep, const rb_rolling_case *rc,
                               const rb_rolling_program *program, rb_rolling_model *model,
                               rb_rolling_solution *solution, rb_rolling_errors *errors,
                               rb_message *why)
{
    const double start = rb_seconds();
    rb_rolling_history history = {0};
    const rb_status s = (sweep->also & RB_ROW_ERRORS
                             ? rb_rolling_history_with_errors
                             : rb_rolling_history_run)(rc, program, NULL, model, &history, why);
    if (s == RB_OK)
        rb_rolling_errors_of_cycle(&history, errors);
    rb_rolling_history_free(&history);
    return rb_rolling_end_solve(model, s, start, solution, why);
}

void rb_rolling_sweep_case(const rb_rolling_sweep *sweep, int k, rb_rolling_row *row,
                           rb_message *why)
{
    rb_rolling_case rc;
    rb_rolling_model model = {0};
    rb_rolling_solution solution = {0};
    rb_rolling_stress_maxima stress[2] = {{.bonds = 0}, {.bonds = 0}};
    rb_rolling_errors errors;

    *row = rb_rolling_no_row(RB_OK);
    if (sweep->solve) {
        row->solution.status = sweep->solve(k, row, sweep->context, why);
        return;
    }
    errors = row->errors;
    rb_status s = sweep->make(k, &rc, sweep->context);
    const rb_rolling_program *program =
        s == RB_OK && sweep->program ? sweep->program(sweep->context) : NULL;
    if (s == RB_OK)
        s = program ? solve_history(sweep, &rc, program, &model, &solution, &errors, why)
                    : rb_rolling_solve_model(&rc, &model, &solution, why);
    if (s >= 0 && solution.p)
        row->solution = rb_rolling_scalars_of(&solution);
    /* What a row has besides the solution. */
    const int with_stress = (sweep->also & RB_ROW_STRESS) != 0;
    const int with_stress_b = (sweep->also & RB_ROW_STRESS_B) != 0;
    if (s == RB_OK && with_stress)
        s = rb_rolling_stress_maxima_find(&model, 0.0, &stress[0], why);
    if (s == RB_OK && with_stress_b)
        s = rb_rolling_stress_maxima_of_b(&model, 0.0, &stress[1], why);
    const int has_all = s == RB_OK;
    if (s == RB_OK && sweep->measure && !program)
        s = sweep->measure(&model, row->own, sweep->context, why);
    if (s == RB_OK && sweep->also & RB_ROW_ERRORS && !program)
        s = rb_rolling_estimate_errors(&rc, &solution, with_stress ? &stress[0] : NULL,
                                       with_stress_b ? &stress[1] : NULL, &errors, why);
    if (has_all)
        keep_stress(sweep, stress, &errors, row);
    rb_rolling_errors_free(&errors);
    for (int body = 0; body < 2; body++)
        rb_rolling_stress_maxima_free(&stress[body]);
    row->solution.status = s;
    if (s >= 0 && solution.p) {
        rb_rolling_solution_convert(&solution, sweep->units);
        row->notes = rb_rolling_find_row_notes(&rc, &solution);
        if (row->notes.status != RB_OK)
            row->solution.status = rb_fail(why, row->notes.status, "out of memory");
    }
    rb_rolling_solution_free(&solution);
    rb_rolling_model_free(&model);
}

/* 1: the whole of it; 0: the other end is gone. */
static int receive_all(int from, void *data, size_t size)
{
    ssize_t n;

    do
        n = recv(from, data, size, MSG_WAITALL);
    while (n < 0 && errno == EINTR);
    return n == (ssize_t)size;
}

static int send_all(int to, const void *data, size_t size)
{
    return send(to, data, size, MSG_NOSIGNAL) == (ssize_t)size;
}

/* ---- The parent -------------------------------------------------------------------- */

static rb_status start_worker(processes *p, worker *w)
{
    int end[2];

    w->k = w->socket = -1;
    w->pid = 0;
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, end) != 0)
        return RB_ENOMEM;
    w->pid = fork();
    if (w->pid == 0) {
        close(end[0]);
        /* or idle workers would see the parent die only when the youngest has ended */
        for (int i = 0; i < p->workers; i++)
            if (p->worker[i].socket >= 0)
                close(p->worker[i].socket);
        rb_rolling_row row;
        int k;

#ifdef _OPENMP
        omp_set_num_threads(1); /* the processes fill the processors */
#endif
        signal(SIGINT, SIG_IGN); /* the parent decides */
        signal(SIGTERM, SIG_DFL);
        do {
            if (!receive_all(end[1], &k, sizeof k))
                break;
            rb_rolling_sweep_case(p->sweep, k, &row, NULL);
        } while (send_all(end[1], &row, sizeof row));
        _exit(0);
    }
    close(end[1]);
    if (w->pid < 0) {
        close(end[0]);
        return RB_ENOMEM;
    }
    w->socket = end[0];
    return RB_OK;
}

static void end_worker(worker *w)
{
    if (w->socket < 0)
        return;
    close(w->socket);
    w->socket = -1;
    kill(w->pid, SIGKILL);
    waitpid(w->pid, NULL, 0);
}

static int idle(rb_rolling_pool *pool)
{
    const processes *p = processes_of(pool);
    int n = 0;

    for (int i = 0; i < p->workers; i++)
        n += p->worker[i].k < 0;
    return n;
}

/* A worker that cannot be reached is dead: collect sees it. */
static void assign(worker *w, int k)
{
    w->k = k;
    send_all(w->socket, &k, sizeof k);
}

static rb_status submit(rb_rolling_pool *pool, int k)
{
    worker *w = processes_of(pool)->worker;

    while (w->k >= 0)
        w++;
    w->again = 0;
    assign(w, k);
    return RB_OK;
}

static int collect(rb_rolling_pool *pool, int milliseconds, int *k, rb_rolling_row *row)
{
    processes *p = processes_of(pool);
    struct pollfd line[WORKERS_MAX];

    for (int i = 0; i < p->workers; i++)
        line[i] = (struct pollfd){.fd = p->worker[i].socket, .events = POLLIN};
    if (poll(line, (nfds_t)p->workers, milliseconds) <= 0)
        return 0;
    while (!line[p->next].revents)
        p->next = (p->next + 1) % p->workers;
    worker *w = &p->worker[p->next];
    p->next = (p->next + 1) % p->workers;
    /* The row of a worker that has something to say, or has died. */
    if (!receive_all(w->socket, row, sizeof *row)) {
        /* Another worker takes the place of one that died, and its case; where that is
         * its second death, the case is given up. */
        const int lost = w->k, again = w->again;
        end_worker(w);
        const rb_status s = start_worker(p, w);
        if (s != RB_OK)
            return (int)s;
        if (lost < 0)
            return 0;
        if (!again) {
            w->again = 1;
            assign(w, lost);
            return 0;
        }
        *k = lost;
        *row = rb_rolling_no_row(RB_ENOMEM);
        return 1;
    }
    *k = w->k;
    w->k = -1;
    return 1;
}

static void stop(rb_rolling_pool *pool)
{
    processes *p = processes_of(pool);

    for (int i = 0; i < p->workers; i++)
        end_worker(&p->worker[i]);
    free(p);
}

rb_status rb_rolling_pool_start(const rb_rolling_sweep *sweep, rb_rolling_pool **pool,
                                rb_message *why)
{
    *pool = NULL;
    if (sweep->count < 0 || sweep->workers < 0 || sweep->workers > WORKERS_MAX)
        return rb_fail(why, RB_EINVAL, "sweep: %d cases by %d processes, expected 0 ... %d",
                       sweep->count, sweep->workers, WORKERS_MAX);
    processes *p = calloc(1, sizeof *p);
    rb_status s = p ? RB_OK : RB_ENOMEM;

    if (p)
        *p = (processes){.pool = {idle, submit, collect, stop}, .sweep = sweep};
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    const int wanted = sweep->workers             ? sweep->workers
                       : processors < 1           ? 1
                       : processors > WORKERS_MAX ? WORKERS_MAX
                                                  : (int)processors;
    while (s == RB_OK && p->workers < wanted && p->workers < sweep->count)
        if ((s = start_worker(p, &p->worker[p->workers])) == RB_OK)
            p->workers++;
    if (s == RB_OK) {
        *pool = &p->pool;
        return s;
    }
    const int e = errno;
    if (p)
        stop(&p->pool);
    return rb_fail(why, s, "sweep: cannot start a process: %s",
                   e == ENOMEM || e == EAGAIN ? "out of memory" : strerror(e));
}
