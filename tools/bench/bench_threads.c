#define _DEFAULT_SOURCE /* wait4 */
/* Whole processes of the program with the threads that OpenMP takes by itself and with one:
 * processor time and elapsed time, medians of turns.  B: the build directory. */
#include "rows.h"

#include <gsl/gsl_sort.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

enum { TURNS = 7, WORDS = 32, SIDES = 2, CLOCKS = 2 };

static double seconds_of(struct timeval t)
{
    return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

/* Processor and elapsed seconds of one run. */
static void run(const char *program, const char *options, int threads, double took[CLOCKS])
{
    struct timeval before, after;
    struct rusage used;
    int status;

    gettimeofday(&before, NULL);
    const pid_t child = fork();
    if (child == 0) {
        char text[300], *words[WORDS] = {(char *)program};
        snprintf(text, sizeof text, "%s --quiet --output /dev/null", options);
        int n = 1;
        for (char *w = strtok(text, " "); w && n + 1 < WORDS; w = strtok(NULL, " "))
            words[n++] = w;
        if (threads > 0)
            setenv("OMP_NUM_THREADS", "1", 1);
        else
            unsetenv("OMP_NUM_THREADS");
        execv(program, words);
        _exit(127);
    }
    if (child < 0 || wait4(child, &status, 0, &used) != child || status != 0) {
        fprintf(stderr, "bench_threads: %s %s failed\n", program, options);
        exit(1);
    }
    gettimeofday(&after, NULL);
    took[0] = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
    took[1] = seconds_of(after) - seconds_of(before);
}

int main(void)
{
    static const char *const cases[][2] = {
        {"half-plane, 60 elements", "--support halfplane --half-width 1 --formulation steady"},
        {"arc, 60 elements", "--support arc --half-width 1 --formulation steady"},
        {"hub, 100 elements", "--support hub --hub-ratio 0.3 --half-width 1 --formulation steady "
                              "--contact-elements 100"},
        {"roll", "--support hub --cover-thickness 5 --young 5 --poisson 0.48 --radius 100 "
                 "--gap parabola --load 5 --formulation steady --creep 0"}};
    char program[400];

    snprintf(program, sizeof program, "%s/rollbem", getenv("B") ? getenv("B") : "build");
    printf("| | processor: default | one thread | ratio | elapsed: default | one thread | ratio |\n"
           "|---|---|---|---|---|---|---|\n");
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        double t[SIDES][CLOCKS][TURNS], took[CLOCKS];
        for (int turn = 0; turn < TURNS; turn++)
            for (int one = 0; one < SIDES; one++) {
                run(program, cases[k][1], one, took);
                for (int c = 0; c < CLOCKS; c++)
                    t[one][c][turn] = took[c];
            }
        printf("| %s", cases[k][0]);
        for (int c = 0; c < CLOCKS; c++) {
            for (int one = 0; one < SIDES; one++)
                gsl_sort(t[one][c], 1, TURNS);
            const double all = t[0][c][TURNS / 2], one = t[1][c][TURNS / 2];
            printf(" | %s | %s | %.2f", row_seconds(all).text, row_seconds(one).text, all / one);
        }
        printf(" |\n");
    }
    return 0;
}
