/* Processes of this machine that solve the cases of a parameter study, one at a time. */
#include "rolling/internal.h"

#include <errno.h>
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
} worker;

typedef struct {
    rb_rolling_crew crew; /* first: crew_of turns it back */
    const rb_rolling_sweep *sweep;
    int workers, next; /* next: whom to look at first, in turn */
    worker worker[WORKERS_MAX];
} processes;

static processes *processes_of(rb_rolling_crew *crew)
{
    return (processes *)(void *)crew;
}

/* ---- One worker -----------------------------------------------------------------------
 */

static void no_row(rb_status status, rb_rolling_sweep_row *row)
{
    *row = (rb_rolling_sweep_row){.status = status};
    row->normal_load = row->tangential_load = row->force_ratio = row->approach = NAN;
    row->creepage = row->creep_ratio = row->free_creepage = row->half_width = NAN;
    row->max_pressure = row->dissipation = row->residual = NAN;
}

static void fill_row(const rb_rolling_solution *s, rb_rolling_sweep_row *row)
{
    row->normal_load = s->normal_load;
    row->tangential_load = s->tangential_load;
    row->force_ratio = s->force_ratio;
    row->approach = s->approach;
    row->creepage = s->creepage;
    row->creep_ratio = s->creep_ratio;
    row->free_creepage = s->free_creepage;
    row->half_width = s->half_width;
    row->max_pressure = s->max_pressure;
    row->contact = s->contact;
    row->stick = s->stick;
    row->slip = s->slipping;
    row->dissipation = s->dissipation;
    row->residual = s->residual;
    row->iterations = s->iterations;
}

static void solve_case(const rb_rolling_sweep *sweep, int k, rb_rolling_sweep_row *row)
{
    rb_rolling_case rc;
    rb_rolling_solution solution = {0};
    rb_status s = sweep->make(k, &rc, sweep->context);

    if (s == RB_OK)
        s = rb_rolling_solve(&rc, &solution, NULL);
    no_row(s, row);
    if (s >= 0 && solution.p)
        fill_row(&solution, row);
    rb_rolling_solution_free(&solution);
}

/* 1: the whole of it; 0: the other end is gone. */
static int receive(int from, void *data, size_t size)
{
    ssize_t n;

    do
        n = recv(from, data, size, MSG_WAITALL);
    while (n < 0 && errno == EINTR);
    return n == (ssize_t)size;
}

static int tell(int to, const void *data, size_t size)
{
    return send(to, data, size, MSG_NOSIGNAL) == (ssize_t)size;
}

static void work(const rb_rolling_sweep *sweep, int parent)
{
    rb_rolling_sweep_row row;
    int k;

#ifdef _OPENMP
    omp_set_num_threads(1); /* the processes fill the processors */
#endif
    signal(SIGINT, SIG_IGN); /* the parent decides */
    signal(SIGTERM, SIG_DFL);
    do {
        if (!receive(parent, &k, sizeof k))
            break;
        solve_case(sweep, k, &row);
    } while (tell(parent, &row, sizeof row));
    _exit(0);
}

/* ---- The parent -----------------------------------------------------------------------
 */

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
        for (int i = 0; i < p->workers; i++) /* or nobody would see the parent die */
            if (p->worker[i].socket >= 0)
                close(p->worker[i].socket);
        work(p->sweep, end[1]);
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

static int room(rb_rolling_crew *crew)
{
    const processes *p = processes_of(crew);
    int idle = 0;

    for (int i = 0; i < p->workers; i++)
        idle += p->worker[i].k < 0;
    return idle;
}

/* A worker that cannot be told is dead: take sees it. */
static rb_status give(rb_rolling_crew *crew, int k)
{
    worker *w = processes_of(crew)->worker;

    while (w->k >= 0)
        w++;
    w->k = k;
    tell(w->socket, &k, sizeof k);
    return RB_OK;
}

/* The row of a worker that has something to say, or of one that died: it takes its case
 * with it, another one goes on with the rest. */
static int hear(processes *p, worker *w, int *k, rb_rolling_sweep_row *row)
{
    *k = w->k;
    if (receive(w->socket, row, sizeof *row)) {
        w->k = -1;
        return 1;
    }
    end_worker(w);
    no_row(RB_ENOMEM, row);
    const rb_status s = start_worker(p, w);
    return s == RB_OK ? *k >= 0 : (int)s;
}

static int take(rb_rolling_crew *crew, int milliseconds, int *k,
                rb_rolling_sweep_row *row)
{
    processes *p = processes_of(crew);
    struct pollfd line[WORKERS_MAX];

    for (int i = 0; i < p->workers; i++)
        line[i] = (struct pollfd){.fd = p->worker[i].socket, .events = POLLIN};
    if (poll(line, (nfds_t)p->workers, milliseconds) <= 0)
        return 0;
    while (!line[p->next].revents)
        p->next = (p->next + 1) % p->workers;
    worker *w = &p->worker[p->next];
    p->next = (p->next + 1) % p->workers;
    return hear(p, w, k, row);
}

static void dismiss(rb_rolling_crew *crew)
{
    processes *p = processes_of(crew);

    for (int i = 0; i < p->workers; i++)
        end_worker(&p->worker[i]);
    free(p);
}

static int workers_of(const rb_rolling_sweep *sweep)
{
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    const int wanted = sweep->workers             ? sweep->workers
                       : processors < 1           ? 1
                       : processors > WORKERS_MAX ? WORKERS_MAX
                                                  : (int)processors;

    return wanted < sweep->count ? wanted : sweep->count;
}

rb_status rb_rolling_crew_start(const rb_rolling_sweep *sweep, rb_rolling_crew **crew,
                                rb_message *why)
{
    *crew = NULL;
    if (sweep->count < 0 || sweep->workers < 0 || sweep->workers > WORKERS_MAX)
        return rb_fail(why, RB_EINVAL,
                       "sweep: %d cases by %d processes, expected 0 ... %d", sweep->count,
                       sweep->workers, WORKERS_MAX);
    processes *p = calloc(1, sizeof *p);
    rb_status s = p ? RB_OK : RB_ENOMEM;

    if (p)
        *p = (processes){.crew = {room, give, take, dismiss}, .sweep = sweep};
    for (const int wanted = workers_of(sweep); s == RB_OK && p->workers < wanted;)
        if ((s = start_worker(p, &p->worker[p->workers])) == RB_OK)
            p->workers++;
    if (s == RB_OK) {
        *crew = &p->crew;
        return s;
    }
    const int e = errno;
    if (p)
        dismiss(&p->crew);
    return rb_fail(why, s, "sweep: cannot start a process: %s", strerror(e));
}
