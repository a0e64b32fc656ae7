/* Parameter study of different cases at 100 elements (half-planes; mu, creepage and load
 * vary), by one process and by one per processor: how much of the processors is
 * used.
 * Argument: the number of cases (default 10000). */
#include "fast_blas.h"
#include "rolling/rolling.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

static rb_status make(int k, rb_rolling_case *rc, void *context)
{
    (void)context;
    *rc = rb_rolling_case_defaults();
    rc->a.support = RB_BEM_HALFPLANE;
    rc->formulation = RB_STEADY;
    rc->contact_elements = 100;
    rc->mu = 0.05 + 0.001 * (k % 400);
    rc->half_width = 0.1 + 1e-4 * (k % 977);
    rc->creep_ratio = 1.5 * (k % 61) / 60.0;
    return RB_OK;
}

static int see(int k, const rb_rolling_row *row, void *context)
{
    int *unsolved = context;
    (void)k;
    *unsolved += row->solution.status != RB_OK;
    return 0;
}

/* Of processes that have ended. */
static double processor_seconds(void)
{
    struct rusage u;
    getrusage(RUSAGE_CHILDREN, &u);
    return (double)(u.ru_utime.tv_sec + u.ru_stime.tv_sec) +
           1e-6 * (double)(u.ru_utime.tv_usec + u.ru_stime.tv_usec);
}

static double seconds(int count, int workers, double *processor)
{
    int unsolved = 0;
    rb_message why;
    const rb_rolling_sweep sweep = {
        .count = count, .workers = workers, .make = make, .see = see, .context = &unsolved};
    const double start = rb_seconds(), before = processor_seconds();

    if (rb_rolling_sweep_run(&sweep, &why) != RB_OK) {
        fprintf(stderr, "bench_sweep: %s\n", why.text);
        exit(70);
    }
    if (unsolved > 0)
        printf("%d cases not solved\n", unsolved);
    *processor = processor_seconds() - before;
    return rb_seconds() - start;
}

int main(int argc, char **argv)
{
    fast_blas(argv);
    const int count = argc > 1 ? atoi(argv[1]) : 10000;
    const int processors = (int)sysconf(_SC_NPROCESSORS_ONLN);
    double used_alone, used;
    const double alone = seconds(count, 1, &used_alone);
    const double together = seconds(count, processors, &used);

    printf("%d cases at 100 elements: 1 process %.2f s (%.2f s of processor time), "
           "%d processes %.2f s (%.2f s)\n",
           count, alone, used_alone, processors, together, used);
    printf("%.2f times faster, %.0f %% of the processors in use; the processes got what "
           "amounts to %.2f processors from the machine\n",
           alone / together, 100.0 * used / (together * processors), used / together);
    return 0;
}
