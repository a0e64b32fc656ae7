#define _DEFAULT_SOURCE /* wait4 */
/* Whole processes of the program, processor time and elapsed time, medians of turns: with the
 * threads that OpenMP takes by itself and with one; CONTACT's input file beside the same elements
 * by options; the numbers of all elements printed, beside the solution alone.  B: the build
 * directory. */
#include "keep_memory.h"
#include "rows.h"
#include "words.h"

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
static void run(const char *program, const char *options, int threads, double seconds[CLOCKS])
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
    seconds[0] = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
    seconds[1] = seconds_of(after) - seconds_of(before);
}

static char program[400];

/* Medians of the processor and of the elapsed seconds of both sides, which take turns. */
static void measure(const char *const options[SIDES], const int threads[SIDES],
                    double median[SIDES][CLOCKS])
{
    double t[SIDES][CLOCKS][TURNS], seconds[CLOCKS];

    for (int turn = 0; turn < TURNS; turn++)
        for (int side = 0; side < SIDES; side++) {
            run(program, options[side], threads[side], seconds);
            for (int c = 0; c < CLOCKS; c++)
                t[side][c][turn] = seconds[c];
        }
    for (int side = 0; side < SIDES; side++)
        for (int c = 0; c < CLOCKS; c++) {
            gsl_sort(t[side][c], 1, TURNS);
            median[side][c] = t[side][c][TURNS / 2];
        }
}

static void threads_beside_one(void)
{
    static const char *const cases[][2] = {
        {"half-plane, 60 elements", "--support halfplane --half-width 1 --formulation steady"},
        {"arc, 60 elements", "--support arc --half-width 1 --formulation steady"},
        {"hub, 100 elements", "--support hub --hub-ratio 0.3 --half-width 1 --formulation steady "
                              "--contact-elements 100"},
        {"roll", "--support hub --cover-thickness 5 --young 5 --poisson 0.48 --radius 100 "
                 "--gap parabola --load 5 --formulation steady --creep 0"}};

    printf("| | processor: default | one thread | ratio | elapsed: default | one thread | ratio |\n"
           "|---|---|---|---|---|---|---|\n");
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        double t[SIDES][CLOCKS];
        measure((const char *const[SIDES]){cases[k][1], cases[k][1]}, (const int[SIDES]){0, 1}, t);
        printf("| %s", cases[k][0]);
        for (int c = 0; c < CLOCKS; c++)
            printf(" | %s | %s | %.2f", row_seconds(t[0][c]).text, row_seconds(t[1][c]).text,
                   t[0][c] / t[1][c]);
        printf(" |\n");
    }
}

/* A row of two sides with one thread, by processor time. */
static void compare(const char *name, int elements, const char *first, const char *second)
{
    double t[SIDES][CLOCKS];

    measure((const char *const[SIDES]){first, second}, (const int[SIDES]){1, 1}, t);
    printf("| %s | %s | %s | %s | %.2f |\n", name, row_count(elements).text,
           row_seconds(t[0][0]).text, row_seconds(t[1][0]).text, t[0][0] / t[1][0]);
}

/* Carter's problem as an input file of CONTACT: n elements over 1.3 half-widths of 1. */
static void write_contact(FILE *f, int n)
{
    const double h = 2.6 / n;

    fprintf(f,
            " 3  MODULE\n  203100\n  022020\n10001541\n 1000005\n   999 100 30 1 1e-5\n"
            " 35780. -0.00024 0.0 0.0\n 0.3 0.3\n 0.0 %.10g 30000.\n 0.28 0.28 82000. 82000.\n"
            " 3\n %d 1 -1.3 0.0 %.10g 200.0\n 1 1\n 0.001 0.0 0.0 0.0 0.0 0.0\n 0  MODULE\n",
            h, n, h);
}

static void contact_beside_options(void)
{
    static const int elements[] = {800, 3200, 12800};

    printf("\n| | elements | input file | options | ratio |\n|---|---|---|---|---|\n");
    for (size_t k = 0; k < sizeof elements / sizeof *elements; k++) {
        char path[] = "/tmp/rollbem-bench-XXXXXX", file[100], options[200];
        const int n = elements[k], descriptor = mkstemp(path);
        FILE *f = descriptor < 0 ? NULL : fdopen(descriptor, "w");
        if (!f) {
            fprintf(stderr, "bench_threads: no file in /tmp\n");
            exit(1);
        }
        write_contact(f, n);
        fclose(f);
        snprintf(file, sizeof file, "contact %s", path);
        snprintf(
            options, sizeof options,
            "--support halfplane --similar --half-width 1 --formulation steady --creep-ratio .4 "
            "--mesh uniform --contact-elements %d",
            n);
        compare("CONTACT's input file beside options", n, file, options);
        unlink(path);
    }
}

/* Whole processes that print every element, beside the solution alone, in this process. */
static void numbers_beside_none(void)
{
    static const int elements[] = {1000, 10000, 100000};
    static const char *const forms[] = {"tsv", "json"};

    printf("\n| | elements | printed | solved | ratio |\n|---|---|---|---|---|\n");
    for (size_t k = 0; k < sizeof forms / sizeof *forms; k++)
        for (size_t j = 0; j < sizeof elements / sizeof *elements; j++) {
            char options[200], name[40];
            double printed = INFINITY, solved = INFINITY;
            snprintf(options, sizeof options,
                     "--support halfplane --similar --half-width 1 --formulation steady "
                     "--creep-ratio .4 --contact-elements %d --format %s",
                     elements[j], forms[k]);
            for (int turn = 0; turn < TURNS; turn++) {
                double seconds[CLOCKS];
                rb_case_result r = {0};
                run(program, options, 1, seconds);
                printed = fmin(printed, seconds[0]);
                const double start = processor_seconds();
                rb_case *c = case_of_words((const char *const[]){
                    "support halfplane similar yes half-width 1 formulation steady creep-ratio .4",
                    word_of("contact-elements", elements[j]).text, NULL});
                if (rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, NULL) != RB_OK)
                    exit(70);
                solved = fmin(solved, processor_seconds() - start);
                rb_case_result_free(&r);
                rb_case_free(c);
            }
            snprintf(name, sizeof name, "numbers of all elements, %s", forms[k]);
            printf("| %s | %s | %s | %s | %.2f |\n", name, row_count(elements[j]).text,
                   row_seconds(printed).text, row_seconds(solved).text, printed / solved);
            fflush(stdout);
        }
}

int main(void)
{
    keep_memory();
    snprintf(program, sizeof program, "%s/rollbem", getenv("B") ? getenv("B") : "build");
    threads_beside_one();
    contact_beside_options();
    numbers_beside_none();
    return 0;
}
