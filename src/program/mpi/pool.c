/* The worker pool of rollbem-mpi: the processes of mpirun, each with solvers of its own
 * (rb_rolling_pool_start).  Rank 0 hands out the cases and sees the rows, its own solvers
 * are part of the pool; the others pass on cases to theirs and rows back.  A solver never
 * calls MPI, so it may be forked and die at any time. */
#define _GNU_SOURCE /* sched_getaffinity */
#include "program/cli/pool.h"

#include <mpi.h>
#include <sched.h>
#include <stdlib.h>
#include <unistd.h>

enum { CASE, ROW }; /* tags; case number STOP: no more, and the last row */
enum { STOP = -1 };

typedef struct {
    int k;
    rb_rolling_row row;
} message;

static int active, rank, size, stopped;

/* ---- Begin, agree, end ------------------------------------------------------------- */

cli_exit cli_pool_begin(int argc, char **argv)
{
    (void)argc, (void)argv;
    if (!cli_pool_is_launched())
        return CLI_CONTINUE;
    MPI_Init(NULL, NULL);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    active = 1;
    if (rank > 0) { /* what they all have to say, rank 0 says */
        cli_keep_failures(1);
        if (!freopen("/dev/null", "w", stdout))
            MPI_Abort(MPI_COMM_WORLD, CLI_INTERNAL);
    }
    return CLI_CONTINUE;
}

int cli_pool_is_worker(void)
{
    return rank > 0;
}

typedef struct {
    int code;
    uint64_t study;
    char machine[64], line[400];
} verdict;

cli_exit cli_pool_agree(cli_exit code, uint64_t study)
{
    if (!active)
        return code;
    verdict own = {.code = code, .study = study};
    verdict *all = calloc((size_t)size, sizeof *all);
    int common = CLI_INTERNAL;

    gethostname(own.machine, sizeof own.machine - 1);
    snprintf(own.line, sizeof own.line, "%s", cli_kept_failure());
    if (!all)
        MPI_Abort(MPI_COMM_WORLD, CLI_INTERNAL);
    MPI_Gather(&own, sizeof own, MPI_BYTE, all, sizeof own, MPI_BYTE, 0, MPI_COMM_WORLD);
    for (int r = 1; r < size && rank == 0 && all[0].code == CLI_CONTINUE; r++) {
        /* The first of them that cannot go on with rank 0. */
        if (all[r].code != CLI_CONTINUE)
            all[0].code = cli_fail((cli_exit)all[r].code, "process %d on %s: %s", r, all[r].machine,
                                   all[r].line);
        else if (all[r].study != all[0].study)
            all[0].code =
                cli_fail(CLI_DATA, "process %d on %s reads another study, or is another version", r,
                         all[r].machine);
    }
    if (rank == 0)
        common = all[0].code;
    MPI_Bcast(&common, 1, MPI_INT, 0, MPI_COMM_WORLD);
    free(all);
    return (cli_exit)common;
}

/* What is still on its way must have arrived. */
void cli_pool_end(void)
{
    message m;

    if (!active)
        return;
    for (int left = stopped; left > 0; left -= m.k == STOP)
        MPI_Recv(&m, sizeof m, MPI_BYTE, MPI_ANY_SOURCE, ROW, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    MPI_Finalize();
    active = 0;
}

/* ---- Rank 0 ------------------------------------------------------------------------ */

typedef struct {
    rb_rolling_pool pool; /* first */
    rb_rolling_pool *own;
    int *left; /* size: how many more cases each takes; of rank 0 not used */
} ranks;

static ranks *ranks_of(rb_rolling_pool *pool)
{
    return (ranks *)(void *)pool;
}

static int idle(rb_rolling_pool *pool)
{
    const ranks *all = ranks_of(pool);
    int sum = all->own->idle(all->own);

    for (int r = 1; r < size; r++)
        sum += all->left[r];
    return sum;
}

/* To the own solvers, or to those with the least to do. */
static rb_status submit(rb_rolling_pool *pool, int k)
{
    ranks *all = ranks_of(pool);
    int to = 1;

    if (all->own->idle(all->own))
        return all->own->submit(all->own, k);
    for (int r = 2; r < size; r++)
        if (all->left[r] > all->left[to])
            to = r;
    all->left[to]--;
    MPI_Send(&k, 1, MPI_INT, to, CASE, MPI_COMM_WORLD);
    return RB_OK;
}

static int collect(rb_rolling_pool *pool, int milliseconds, int *k, rb_rolling_row *row)
{
    ranks *all = ranks_of(pool);
    MPI_Status from;
    message m;
    int here;

    MPI_Iprobe(MPI_ANY_SOURCE, ROW, MPI_COMM_WORLD, &here, &from);
    if (!here) /* nobody wakes us for a message */
        return all->own->collect(all->own, milliseconds > 0, k, row);
    MPI_Recv(&m, sizeof m, MPI_BYTE, from.MPI_SOURCE, ROW, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    all->left[from.MPI_SOURCE]++;
    *k = m.k;
    *row = m.row;
    return 1;
}

/* Does not wait: some may be gone, and mpirun about to end the others. */
static void stop(rb_rolling_pool *pool)
{
    static const int no_more = STOP;
    ranks *all = ranks_of(pool);
    MPI_Request request;

    for (int r = 1; r < size; r++) {
        MPI_Isend(&no_more, 1, MPI_INT, r, CASE, MPI_COMM_WORLD, &request);
        MPI_Request_free(&request);
    }
    stopped = size - 1;
    all->own->stop(all->own);
    free(all->left);
    free(all);
}

/* ---- The others -------------------------------------------------------------------- */

enum { QUEUE = 512 }; /* two cases for each of 256 solvers: rank 0 gives no more */

typedef struct {
    int k[QUEUE]; /* cases that wait for a solver */
    int first, n;
} queue;

/* Cases that rank 0 has sent; STOP, or 0. */
static int accept_cases(queue *waiting)
{
    int here, k;

    for (;;) {
        MPI_Iprobe(0, CASE, MPI_COMM_WORLD, &here, MPI_STATUS_IGNORE);
        if (!here)
            return 0;
        MPI_Recv(&k, 1, MPI_INT, 0, CASE, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        if (k == STOP)
            return STOP;
        waiting->k[(waiting->first + waiting->n++) % QUEUE] = k;
    }
}

static void send_row(const message *m)
{
    MPI_Send(m, sizeof *m, MPI_BYTE, 0, ROW, MPI_COMM_WORLD);
}

static int run_rank(rb_rolling_pool *own)
{
    queue waiting = {.n = 0};
    message m;
    int came = 0;

    while (came >= 0 && accept_cases(&waiting) != STOP) {
        for (; waiting.n > 0 && own->idle(own); waiting.n--) {
            own->submit(own, waiting.k[waiting.first]);
            waiting.first = (waiting.first + 1) % QUEUE;
        }
        came = own->collect(own, 1, &m.k, &m.row);
        if (came > 0)
            send_row(&m);
    }
    own->stop(own);
    m = (message){.k = STOP};
    send_row(&m);
    return came;
}

/* ---- All --------------------------------------------------------------------------- */

/* A process's share of its machine, at most the processors that mpirun bound it to. */
static int share(void)
{
    const char *here = getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
    const int beside = here ? atoi(here) : 1;
    const long processors = sysconf(_SC_NPROCESSORS_ONLN) / (beside > 0 ? beside : 1);
    cpu_set_t bound;
    int most = sched_getaffinity(0, sizeof bound, &bound) == 0 ? CPU_COUNT(&bound) : 256;

    most = processors < most ? (int)processors : most;
    return most < 1 ? 1 : most > 256 ? 256 : most;
}

/* mpirun ends all of them. */
static void give_up(const char *line)
{
    fprintf(stderr, "rollbem: process %d: %s\n", rank, line);
    MPI_Abort(MPI_COMM_WORLD, CLI_INTERNAL);
}

rb_status cli_pool_run(const rb_rolling_sweep *sweep, rb_message *why)
{
    if (!active)
        return rb_rolling_sweep_run(sweep, why);
    rb_rolling_sweep here = *sweep;
    rb_rolling_pool *own;
    int *left = calloc((size_t)size, sizeof *left);

    here.workers = sweep->workers ? sweep->workers : share();
    if (!left || rb_rolling_pool_start(&here, &own, why) != RB_OK)
        give_up(left ? why->text : "out of memory");
    /* a second case waits at each solver, so that none waits for a message */
    const int most = 2 * own->idle(own);
    MPI_Gather(&most, 1, MPI_INT, left, 1, MPI_INT, 0, MPI_COMM_WORLD);
    if (rank == 0) {
        ranks *all = calloc(1, sizeof *all);
        if (!all)
            MPI_Abort(MPI_COMM_WORLD, CLI_INTERNAL);
        *all = (ranks){{idle, submit, collect, stop}, own, left};
        return rb_rolling_sweep_by(&here, &all->pool, why);
    }
    free(left);
    if (run_rank(own) < 0)
        give_up("cannot replace a lost solver");
    return RB_OK;
}
