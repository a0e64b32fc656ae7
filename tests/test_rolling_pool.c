/* The processes of a study, as the one sees them that hands out cases. */
#define _GNU_SOURCE
#include "cases.h"
#include "rolling/rolling.h"
#include "solved.h"

#include <errno.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* Case 3 is refused by its maker, case 4 by the solver; the process that solves case 6
 * dies, each time or as often as the context says, in memory that all share; case 7 takes
 * its time. */
static rb_status make(int k, rb_rolling_case *rc, void *context)
{
    int *deaths = context;
    if (k == 6 && (!deaths || (*deaths)-- > 0))
        raise(SIGKILL);
    if (k == 7)
        nanosleep(&(struct timespec){.tv_nsec = 60000000}, NULL);
    *rc = rolling_case("support halfplane load %g contact-elements 16 formulation steady "
                       "creep-ratio 0.5",
                       100.0 * (k + 1));
    if (k == 4)
        rc->contact_elements = 1;
    return k == 3 ? RB_INACCURATE : RB_OK;
}

static int see_nothing(int k, const rb_rolling_row *row, void *context)
{
    (void)k;
    (void)row;
    (void)context;
    return 0;
}

static rb_rolling_sweep of(int count, int workers, unsigned also)
{
    return (rb_rolling_sweep){
        .count = count, .workers = workers, .also = also, .make = make, .see = see_nothing};
}

static rb_rolling_row row_of(rb_rolling_pool *pool, int k)
{
    rb_rolling_row row;
    int which = -1, arrived = 0;
    CHECK_OK(pool->submit(pool, k));
    for (int i = 0; i < 10000 && arrived == 0; i++)
        arrived = pool->collect(pool, 20, &which, &row);
    assert_int_equal(arrived, 1);
    assert_int_equal(which, k);
    return row;
}

/* What is asked for, and NAN otherwise. */
TEST(rows_have_what_is_asked_for)
{
    for (unsigned also = 0; also < 4; also++) {
        const rb_rolling_sweep sweep = of(1, 1, also);
        rb_rolling_pool *pool;
        rb_rolling_case rc;
        OWNED(rb_rolling_errors) errors;
        OWNED(rb_rolling_stress_maxima) stress = {.bonds = 0};
        CHECK_OK(rb_rolling_pool_start(&sweep, &pool, NULL));
        const rb_rolling_row row = row_of(pool, 0);
        pool->stop(pool);
        CHECK_OK(make(0, &rc, NULL));
        OWNED(rb_rolling_model) model;
        OWNED(rb_rolling_solution) s;
        CHECK_OK(rb_rolling_solve_model(&rc, &model, &s, NULL));
        CHECK_OK(rb_rolling_stress_maxima_find(&model, 0.0, &stress, NULL));
        CHECK_OK(rb_rolling_estimate_errors(&rc, &s, &stress, NULL, &errors, NULL));
        CHECK_OK(row.solution.status);
        CHECK_ABS(row.solution.tangential_load, s.tangential_load, 0.0, "Q");
        CHECK_ABS(row.solution.free_creepage, s.free_creepage, 0.0, "free creepage");
        assert_int_equal(row.solution.contact, s.contact);
        assert_int_equal(row.solution.n, 0);
        assert_int_equal(row.solution.patches, 0);
        assert_null(row.solution.patch);
        assert_null(row.solution.p);
        assert_null(row.solution.zone);
        assert_null(row.solution.cone_solver);
        if (also & RB_ROW_STRESS)
            CHECK_REL(row.stress.von_mises.value, stress.von_mises.value, 1e-12, "Mises");
        else
            assert_true(isnan(row.stress.von_mises.value));
        if (also & RB_ROW_ERRORS)
            CHECK_REL(row.errors.scalar.approach, errors.scalar.approach, 1e-9, "bar");
        else
            assert_true(isnan(row.errors.scalar.approach));
        if (also == 3)
            CHECK_REL(row.errors.stress.von_mises.value, errors.stress.von_mises.value, 1e-9,
                      "bar of Mises");
        else
            assert_true(isnan(row.errors.stress.von_mises.value));
    }
}

TEST(refused_cases_have_their_status)
{
    const rb_rolling_sweep sweep = of(8, 1, RB_ROW_STRESS);
    rb_rolling_pool *pool;
    CHECK_OK(rb_rolling_pool_start(&sweep, &pool, NULL));
    rb_rolling_row row = row_of(pool, 3);
    CHECK_STATUS(row.solution.status, RB_INACCURATE);
    assert_true(isnan(row.solution.normal_load));
    row = row_of(pool, 4);
    CHECK_STATUS(row.solution.status, RB_EINVAL);
    assert_true(isnan(row.solution.normal_load) && isnan(row.stress.von_mises.value));
    row = row_of(pool, 5);
    CHECK_OK(row.solution.status);
    CHECK_REL(row.solution.normal_load, 600.0, 1e-9, "load");
    pool->stop(pool);
}

/* A worker that dies is replaced and tries its case once more: a death is nobody's fault,
 * two are the case's. */
TEST(a_case_is_lost_with_its_second_worker)
{
    int *deaths =
        mmap(NULL, sizeof *deaths, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    assert_true(deaths != MAP_FAILED);
    for (int k = 0; k < 2; k++) {
        rb_rolling_sweep sweep = of(8, 1, 0);
        rb_rolling_pool *pool;
        sweep.context = k ? deaths : NULL;
        *deaths = 1;
        CHECK_OK(rb_rolling_pool_start(&sweep, &pool, NULL));
        rb_rolling_row row = row_of(pool, 6);
        CHECK_STATUS(row.solution.status, k ? RB_OK : RB_ENOMEM);
        if (k)
            CHECK_REL(row.solution.normal_load, 700.0, 1e-9, "load");
        else
            assert_true(isnan(row.solution.normal_load));
        row = row_of(pool, 1); /* the worker that took its place goes on */
        CHECK_OK(row.solution.status);
        assert_int_equal(pool->idle(pool), 1);
        pool->stop(pool);
    }
    munmap(deaths, sizeof *deaths);
}

TEST(workers_are_counted)
{
    static const int workers[][3] = {{5, 3, 3}, {2, 3, 2}, {0, 3, 0}}; /* count, wanted */
    rb_rolling_pool *pool;
    for (int k = 0; k < 3; k++) {
        const rb_rolling_sweep sweep = of(workers[k][0], workers[k][1], 0);
        CHECK_OK(rb_rolling_pool_start(&sweep, &pool, NULL));
        assert_int_equal(pool->idle(pool), workers[k][2]);
        for (int i = 1; i <= workers[k][2]; i++) {
            CHECK_OK(pool->submit(pool, i - 1));
            assert_int_equal(pool->idle(pool), workers[k][2] - i);
        }
        pool->stop(pool);
    }
    const rb_rolling_sweep all = of(10000, 0, 0);
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    CHECK_OK(rb_rolling_pool_start(&all, &pool, NULL));
    assert_int_equal(pool->idle(pool), processors < 256 ? processors : 256);
    pool->stop(pool);
    const rb_rolling_sweep bad[] = {of(-1, 1, 0), of(1, -1, 0), of(1, 257, 0)};
    for (int k = 0; k < 3; k++) {
        CHECK_SAYS(rb_rolling_pool_start(&bad[k], &pool, &message), RB_EINVAL,
                   "expected 0 ... 256");
        assert_null(pool);
    }
}

/* Every worker in turn: rows come whoever finishes. */
TEST(all_cases_come_back_once)
{
    enum { CASES = 12 };
    rb_rolling_sweep sweep = of(CASES, 3, 0);
    rb_rolling_pool *pool;
    int finished[CASES] = {0}, given = 0, arrived = 0, deaths = 0;
    sweep.context = &deaths;
    CHECK_OK(rb_rolling_pool_start(&sweep, &pool, NULL));
    while (arrived < CASES) {
        rb_rolling_row row;
        int k = -1;
        while (given < CASES && pool->idle(pool) > 0)
            CHECK_OK(pool->submit(pool, given++));
        if (pool->collect(pool, 20, &k, &row) == 1) {
            assert_in_range(k, 0, CASES - 1);
            assert_int_equal(finished[k]++, 0);
            arrived++;
            if (k != 3 && k != 4)
                CHECK_REL(row.solution.normal_load, 100.0 * (k + 1), 1e-9, "case %d", k);
        }
    }
    assert_int_equal(pool->idle(pool), 3);
    rb_rolling_row none;
    int k;
    assert_int_equal(pool->collect(pool, 0, &k, &none), 0); /* nobody works */
    pool->stop(pool);
}

/* The row of the second worker does not wait for the one of the first. */
TEST(a_fast_case_overtakes_a_slow_one)
{
    const rb_rolling_sweep sweep = of(8, 2, 0);
    rb_rolling_pool *pool;
    rb_rolling_row row;
    int k = -1;
    CHECK_OK(rb_rolling_pool_start(&sweep, &pool, NULL));
    CHECK_OK(pool->submit(pool, 7));
    row = row_of(pool, 0);
    CHECK_REL(row.solution.normal_load, 100.0, 1e-9, "the fast one");
    assert_int_equal(pool->collect(pool, 10000, &k, &row), 1);
    assert_int_equal(k, 7);
    CHECK_REL(row.solution.normal_load, 800.0, 1e-9, "the slow one");
    pool->stop(pool);
}

/* Without descriptors no worker can be reached. */
TEST(a_pool_that_cannot_start_says_why)
{
    const rb_rolling_sweep sweep = of(4, 4, 0);
    rb_rolling_pool *pool;
    rb_message why = {.text = ""};
    struct rlimit before, few;
    assert_int_equal(getrlimit(RLIMIT_NOFILE, &before), 0);
    for (int room = 0; room < 4; room += 3) { /* none, and enough for one worker */
        const int next = dup(0);
        close(next);
        few = before;
        few.rlim_cur = (rlim_t)(next + room);
        assert_int_equal(setrlimit(RLIMIT_NOFILE, &few), 0);
        const rb_status s = rb_rolling_pool_start(&sweep, &pool, &why);
        assert_int_equal(setrlimit(RLIMIT_NOFILE, &before), 0);
        CHECK_STATUS(s, RB_ENOMEM);
        assert_null(pool);
        assert_non_null(strstr(why.text, "sweep: cannot start a process: Too many open"));
    }
}

/* A pool of no processes: rows come at once, the last case first, until it fails. */
typedef struct {
    rb_rolling_pool pool;
    int idle, given, most, waiting[40000], submits, collects; /* fail after so many */
    int finished, stopped;
} pretended;

static int pretended_idle(rb_rolling_pool *pool)
{
    const pretended *p = (pretended *)(void *)pool;
    return p->idle;
}

static rb_status pretended_submit(rb_rolling_pool *pool, int k)
{
    pretended *p = (pretended *)(void *)pool;
    if (p->submits-- == 0)
        return RB_ENOMEM;
    p->waiting[p->given++] = k;
    p->most = p->given > p->most ? p->given : p->most;
    return RB_OK;
}

static int pretended_collect(rb_rolling_pool *pool, int milliseconds, int *k, rb_rolling_row *row)
{
    pretended *p = (pretended *)(void *)pool;
    (void)milliseconds;
    if (p->collects-- == 0)
        return RB_ENOMEM;
    *k = p->waiting[--p->given];
    *row = (rb_rolling_row){.solution.status = RB_OK};
    row->solution.normal_load = *k;
    return 1;
}

static void pretended_stop(rb_rolling_pool *pool)
{
    ((pretended *)(void *)pool)->stopped++;
}

static int see_in_order(int k, const rb_rolling_row *row, void *context)
{
    pretended *p = context;
    assert_int_equal(k, p->finished++);
    CHECK_ABS(row->solution.normal_load, k, 0.0, "row %d", k);
    return 0;
}

static pretended pretend(int idle, int submits, int collects)
{
    return (pretended){
        .pool = {pretended_idle, pretended_submit, pretended_collect, pretended_stop},
        .idle = idle,
        .submits = submits,
        .collects = collects};
}

/* Rows are seen in the order of the cases, and at most 16384 wait for an earlier one. */
TEST(a_pool_s_rows_are_seen_in_order)
{
    static pretended p;
    p = pretend(100000, -1, -1);
    rb_rolling_sweep sweep = of(40000, 1, 0);
    sweep.see = see_in_order;
    sweep.context = &p;
    message.text[0] = '\0';
    CHECK_OK(rb_rolling_sweep_by(&sweep, &p.pool, &message));
    assert_string_equal(message.text, "");
    assert_int_equal(p.finished, 40000);
    assert_int_equal(p.most, 16384);
    assert_int_equal(p.stopped, 1);
}

TEST(a_pool_that_cannot_go_on_ends_the_study)
{
    static pretended p;
    for (int k = 0; k < 2; k++) {
        p = pretend(1, k ? -1 : 2, k ? 2 : -1);
        rb_rolling_sweep sweep = of(5, 1, 0);
        sweep.see = see_in_order;
        sweep.context = &p;
        CHECK_SAYS(rb_rolling_sweep_by(&sweep, &p.pool, &message), RB_ENOMEM,
                   "cannot replace a lost process");
        assert_int_equal(p.finished, 2);
        assert_int_equal(p.stopped, 1);
    }
}

static rb_status make_covered(int k, rb_rolling_case *rc, void *context)
{
    (void)context;
    make(k, rc, NULL);
    rc->a.support = RB_BEM_HUB; /* whose stress is not known */
    set(rc,
        "cover-thickness %g core-young %g relaxation-time 1e-3 relaxation-ratio 1 "
        "formulation steady speed 1",
        0.1 * rc->a.radius, 2.0 * rc->a.young);
    return RB_OK;
}

/* Error bars wait for the stress. */
TEST(rows_without_stress_have_its_status)
{
    rb_rolling_sweep sweep = of(1, 1, RB_ROW_STRESS | RB_ROW_ERRORS);
    rb_rolling_pool *pool;
    sweep.make = make_covered;
    CHECK_OK(rb_rolling_pool_start(&sweep, &pool, NULL));
    const rb_rolling_row row = row_of(pool, 0);
    CHECK_STATUS(row.solution.status, RB_EINVAL);
    assert_true(isnan(row.errors.scalar.normal_load));
    pool->stop(pool);
}

/* A pool that has stopped leaves no process behind, not even a dead one. */
TEST(no_process_outlives_its_pool)
{
    const rb_rolling_sweep sweep = of(8, 3, 0);
    rb_rolling_pool *pool;
    CHECK_OK(rb_rolling_pool_start(&sweep, &pool, NULL));
    row_of(pool, 1);
    row_of(pool, 6); /* whose process dies, and is replaced */
    pool->stop(pool);
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
    assert_int_equal(errno, ECHILD);
}

static volatile sig_atomic_t rings;

static void ring(int number)
{
    (void)number;
    rings++;
}

/* Signals that its program handles, with a timer, say, do not disturb a study. */
TEST(a_timer_does_not_disturb_a_study)
{
    const struct itimerval often = {{0, 500}, {0, 500}}, never = {{0, 0}, {0, 0}};
    struct sigaction before, handler = {.sa_handler = ring}; /* interrupts system calls */
    const rb_rolling_sweep sweep = of(8, 2, 0);
    rb_rolling_pool *pool;
    assert_int_equal(sigaction(SIGALRM, &handler, &before), 0);
    CHECK_OK(rb_rolling_pool_start(&sweep, &pool, NULL));
    assert_int_equal(setitimer(ITIMER_REAL, &often, NULL), 0);
    for (int round = 0; round < 3; round++) {
        const rb_rolling_row slow = row_of(pool, 7);
        CHECK_REL(slow.solution.normal_load, 800.0, 1e-9, "round %d", round);
    }
    assert_int_equal(setitimer(ITIMER_REAL, &never, NULL), 0);
    pool->stop(pool);
    assert_int_equal(sigaction(SIGALRM, &before, NULL), 0);
    assert_true(rings > 10);
}

/* Whoever is killed takes the processes of its study along. */
TEST(workers_end_with_their_parent)
{
    int line[2];
    char byte;
    assert_int_equal(pipe(line), 0);
    const pid_t parent = fork();
    assert_true(parent >= 0);
    if (parent == 0) {
        const rb_rolling_sweep sweep = of(8, 3, 0);
        rb_rolling_pool *pool;
        close(line[0]);
        if (rb_rolling_pool_start(&sweep, &pool, NULL) != RB_OK)
            _exit(1);
        row_of(pool, 6); /* whose process dies, and is replaced by one that is younger */
        raise(SIGKILL);
    }
    close(line[1]);
    assert_int_equal(waitpid(parent, NULL, 0), parent);
    assert_int_equal(read(line[0], &byte, 1), 0); /* nobody holds the other end */
    close(line[0]);
}

RUN_TESTS(NULL, NULL)
