/* endurance SOLVES THREADS: so many cases in one process, by handles of rollbem/api.h,
 * shared among the threads; the memory in use after a tenth of them is that at the end. */

#include "rollbem/api.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static int solves;
static atomic_int next_solve, failed;
static atomic_long early; /* resident pages after a tenth */

static long resident_pages(void)
{
    long all = 0, resident = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (file && fscanf(file, "%ld %ld", &all, &resident) != 2)
        resident = 0;
    if (file)
        fclose(file);
    return resident;
}

/* Halfplane and wheel, the formulations, elements from 9 to 32, creepage up to sliding. */
static int solve_case(int k)
{
    static const char *const formulation[] = {"static", "steady", "transient"};
    char text[40];
    rb_api *a = rb_api_create();
    int s = a ? rb_api_set(a, "support", k % 5 ? "halfplane" : "hub") : -1;
    s = s ? s : rb_api_set(a, "formulation", formulation[k % 3]);
    s = s ? s : k % 3 == 2 ? rb_api_set(a, "distance", "0.2") : 0;
    snprintf(text, sizeof text, "%d", 9 + k % 24);
    s = s ? s : rb_api_set(a, "contact-elements", text);
    s = s ? s : rb_api_set(a, "outer-elements", "40");
    s = s ? s : rb_api_set(a, "load", "100");
    snprintf(text, sizeof text, "%.4f", 0.01 * (k % 120));
    s = s ? s : k % 3 ? rb_api_set(a, "creep-ratio", text) : rb_api_set(a, "force-ratio", "0.5");
    s = s ? s : rb_api_solve(a);
    if (s != 0)
        fprintf(stderr, "case %d: %s\n", k, a ? rb_api_message(a) : "out of memory");
    rb_api_free(a);
    return s;
}

static void *work(void *nothing)
{
    for (int k; (k = atomic_fetch_add(&next_solve, 1)) < solves;) {
        if (solve_case(k) != 0)
            failed++;
        if (k == solves / 10)
            early = resident_pages();
    }
    return nothing;
}

int main(int argc, char **argv)
{
    enum { THREADS = 64 };
    pthread_t thread[THREADS];
    const int threads = argc > 2 ? atoi(argv[2]) : 1;
    solves = argc > 1 ? atoi(argv[1]) : 1000;
    if (threads < 1 || threads > THREADS || solves < 10)
        return 64;
    for (int t = 0; t < threads; t++)
        if (pthread_create(&thread[t], NULL, work, NULL) != 0)
            return 70;
    for (int t = 0; t < threads; t++)
        pthread_join(thread[t], NULL);
    const double megabyte = (double)sysconf(_SC_PAGESIZE) / 1048576.0;
    const double first = (double)early * megabyte, last = (double)resident_pages() * megabyte;
    printf("%d cases in %d threads: %.1f MB after a tenth of them, %.1f MB at the end, %d failed\n",
           solves, threads, first, last, (int)failed);
    return failed || last > 1.05 * first + 2.0;
}
