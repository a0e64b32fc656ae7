/* Parameter studies: cases handed out one by one to processes, results seen in order. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS, kill */
#include "rolling/internal.h"

#include <errno.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#ifdef _OPENMP
#include <omp.h>
#endif

enum { WORKERS_MAX = 256 };

/* What the processes share. */
typedef struct {
    atomic_int next;               /* first case that nobody has taken */
    atomic_int taken[WORKERS_MAX]; /* by each worker; -1: none */
    rb_rolling_sweep_row row[];    /* count */
} board;

typedef struct {
    const rb_rolling_sweep *sweep;
    pid_t parent;
    int workers, finished; /* finished: cases seen so far */
    board *shared;
    size_t bytes;
    atomic_int *done;          /* count; behind the rows */
    pid_t worker[WORKERS_MAX]; /* 0: gone */
} run;

/* ---- One process ----------------------------------------------------------------------
 */

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
    rb_status s = sweep->make(sweep->first + k, &rc, sweep->context);

    if (s == RB_OK)
        s = rb_rolling_solve(&rc, &solution, NULL);
    if (s >= 0 && solution.p)
        fill_row(&solution, row);
    row->status = s;
    rb_rolling_solution_free(&solution);
}

static void work(const run *r, int worker)
{
    const rb_rolling_sweep *sweep = r->sweep;
    int k;

#ifdef _OPENMP
    omp_set_num_threads(1); /* the processes fill the processors */
#endif
    signal(SIGINT, SIG_IGN);         /* the parent decides */
    while (getppid() == r->parent && /* nobody would see the rest */
           (k = atomic_fetch_add(&r->shared->next, 1)) < sweep->count) {
        atomic_store(&r->shared->taken[worker], k);
        solve_case(sweep, k, &r->shared->row[k]);
        atomic_store(&r->done[k], 1);
    }
    atomic_store(&r->shared->taken[worker], -1);
    _exit(0);
}

/* ---- The parent -----------------------------------------------------------------------
 */

static void clear_row(rb_rolling_sweep_row *row)
{
    *row = (rb_rolling_sweep_row){.status = RB_MAXITER};
    row->normal_load = row->tangential_load = row->force_ratio = row->approach = NAN;
    row->creepage = row->creep_ratio = row->free_creepage = row->half_width = NAN;
    row->max_pressure = row->dissipation = row->residual = NAN;
}

static rb_status share(run *r)
{
    const size_t count = (size_t)r->sweep->count;

    r->bytes = sizeof *r->shared + count * (sizeof *r->shared->row + sizeof *r->done);
    r->shared =
        mmap(NULL, r->bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (r->shared == MAP_FAILED)
        return RB_ENOMEM;
    r->done = (atomic_int *)(void *)(r->shared->row + count);
    for (size_t k = 0; k < count; k++)
        clear_row(&r->shared->row[k]);
    for (int w = 0; w < WORKERS_MAX; w++)
        atomic_init(&r->shared->taken[w], -1);
    return RB_OK;
}

static rb_status start_worker(run *r, int w)
{
    const pid_t pid = fork();

    if (pid < 0)
        return RB_ENOMEM;
    if (pid == 0)
        work(r, w);
    r->worker[w] = pid;
    return RB_OK;
}

/* A worker that died takes its case with it; another one goes on with the rest. */
static rb_status bury(run *r, int w)
{
    const int k = atomic_exchange(&r->shared->taken[w], -1);

    r->worker[w] = 0;
    if (k < 0)
        return RB_OK;
    if (!atomic_load(&r->done[k])) {
        clear_row(&r->shared->row[k]);
        r->shared->row[k].status = RB_ENOMEM;
        atomic_store(&r->done[k], 1);
    }
    return start_worker(r, w);
}

static rb_status collect_dead(run *r)
{
    rb_status s = RB_OK;

    for (int w = 0; w < r->workers; w++)
        if (r->worker[w] && waitpid(r->worker[w], NULL, WNOHANG) == r->worker[w])
            s = s == RB_OK ? bury(r, w) : s;
    return s;
}

/* Hands on the rows that are next in order. */
static rb_status see_finished(run *r)
{
    const rb_rolling_sweep *sweep = r->sweep;

    while (r->finished < sweep->count && atomic_load(&r->done[r->finished])) {
        const int k = r->finished++;
        if (sweep->see(sweep->first + k, &r->shared->row[k], sweep->context))
            return RB_INTERRUPTED;
    }
    return RB_OK;
}

static void end_workers(run *r)
{
    for (int w = 0; w < r->workers; w++)
        if (r->worker[w]) {
            kill(r->worker[w], SIGKILL);
            waitpid(r->worker[w], NULL, 0);
        }
}

static rb_status supervise(run *r)
{
    const struct timespec pause = {0, 5000000};
    rb_status s = RB_OK;

    for (int w = 0; w < r->workers && s == RB_OK; w++)
        s = start_worker(r, w);
    while (s == RB_OK && r->finished < r->sweep->count) {
        nanosleep(&pause, NULL);
        s = collect_dead(r);
        if (s == RB_OK)
            s = see_finished(r);
        if (s == RB_OK && r->sweep->tick &&
            r->sweep->tick(r->finished, r->sweep->context))
            s = RB_INTERRUPTED;
    }
    end_workers(r);
    return s;
}

rb_status rb_rolling_sweep_run(const rb_rolling_sweep *sweep, rb_message *why)
{
    run r = {.sweep = sweep, .parent = getpid()};
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);

    if (sweep->count < 0 || sweep->workers < 0 || sweep->workers > WORKERS_MAX)
        return rb_fail(why, RB_EINVAL,
                       "sweep: %d cases by %d processes, expected 0 ... %d", sweep->count,
                       sweep->workers, WORKERS_MAX);
    if (sweep->count == 0)
        return RB_OK;
    r.workers = sweep->workers             ? sweep->workers
                : processors < 1           ? 1
                : processors > WORKERS_MAX ? WORKERS_MAX
                                           : (int)processors;
    if (r.workers > sweep->count)
        r.workers = sweep->count;
    if (share(&r) != RB_OK)
        return rb_fail(why, RB_ENOMEM, "sweep: no memory for %d cases", sweep->count);
    const rb_status s = supervise(&r);
    munmap(r.shared, r.bytes);
    if (s == RB_INTERRUPTED)
        return rb_fail(why, s, "interrupted after case %d", sweep->first + r.finished);
    return s == RB_OK
               ? s
               : rb_fail(why, s, "sweep: cannot start a process: %s", strerror(errno));
}
