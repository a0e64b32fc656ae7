/* What `auto` costs beside the best of its parts on each problem, and beside the best of
 * all solvers, in floating-point operations: at most 3 times as many as the best part,
 * and 1.1 where its first member succeeds at once; and in seconds of the processor, the least
 * of RUNS runs of both, of whole calls that check and store the problem.
 *
 *     bench_portfolio [FILE...]
 *
 * Without files: the packings of examples/packings/thirty.txt, to be found from the
 * working directory, and the friction files below ROLLBEM_DATA.  A solver that has used
 * as many operations and as much time as `auto` did is stopped: it is not the best. */
#include "fast_blas.h"
#include "keep_memory.h"
#include "lcp/friction/friction.h"

#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#define LIST "examples/packings/thirty.txt"
#define SECONDS 60.0 /* of auto on one problem */
/* Runs of one solver, of which the least time counts, unless the first takes longer than LONG. */
enum { RUNS = 5 };
#define LONG 1.0
/* Below so many seconds, the start of a program takes more than the solve. */
#define SHORT 2e-3

typedef struct {
    int problems, solved, beyond, first, first_beyond, beyond_seconds;
    double worst, worst_first, worst_seconds;
} tally;

static double processor_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* What a solver must not exceed both of, or it is not the best in either. */
typedef struct {
    double flops, until; /* until: on processor_seconds() */
} limits;

static int beyond(const rb_friction_progress *at, void *context)
{
    const limits *most = context;
    return at->flops > most->flops && processor_seconds() > most->until;
}

/* Solves RUNS times; the status of the last.  least: no run goes on beyond flops and least, which
 * becomes the least time of a run that has solved the problem. */
static rb_status least_seconds(const char *solver, const rb_friction_problem *p,
                               rb_friction_options opt, double flops, double *r, double *least,
                               rb_friction_info *info)
{
    const size_t m = (size_t)(p->dimension * p->contacts);
    rb_status s = RB_OK;
    double total = 0.0, best = INFINITY;
    limits most = {.flops = flops};
    opt.progress = beyond;
    opt.context = &most;
    for (int k = 0; k < RUNS && s == RB_OK && total < LONG; k++) {
        const double start = processor_seconds();
        most.until = start + *least;
        s = rb_friction_solve(solver, p, &opt, &(rb_friction_solution){r, r + m, NULL}, info);
        const double taken = processor_seconds() - start;
        total += taken;
        if (s == RB_OK)
            best = fmin(best, taken);
    }
    *least = best;
    return s;
}

/* Hybrids and fixed points are no stages of auto. */
static int is_part(const rb_friction_solver *s)
{
    return !strstr(s->name, "hybrid") && strcmp(s->name, "fixed-point") != 0;
}

typedef struct {
    double flops, seconds;
    const char *name, *fastest; /* least operations, least seconds */
} champion;

/* The best part and the best solver on the problem, if better than auto itself. */
static void find_best(const rb_friction_problem *p, const champion *of_auto, double *r,
                      champion *part, champion *any)
{
    int count;
    const rb_friction_solver *all = rb_friction_solvers(&count);
    rb_friction_options opt = rb_friction_defaults();
    opt.seconds = isfinite(of_auto->seconds) ? fmax(10.0, 2.0 * of_auto->seconds) : SECONDS;
    *part = *any = *of_auto;
    for (int k = 1; k < count; k++) {
        rb_friction_info info;
        champion *best = is_part(&all[k]) ? part : any;
        double seconds = best->seconds;
        if (least_seconds(all[k].name, p, opt, best->flops, r, &seconds, &info) != RB_OK)
            continue;
        for (int which = 0; which < 2; which++) {
            champion *c = which ? any : part;
            if (!which && !is_part(&all[k]))
                continue;
            if (info.flops < c->flops) {
                c->flops = info.flops;
                c->name = all[k].name;
            }
            if (seconds < c->seconds) {
                c->seconds = seconds;
                c->fastest = all[k].name;
            }
        }
    }
}

/* The first member as auto runs it, alone. */
static double first_member(const rb_friction_problem *p, double *r)
{
    const size_t m = (size_t)(p->dimension * p->contacts);
    rb_friction_options opt = rb_friction_defaults();
    rb_friction_info info;
    opt.max_iters = p->form == RB_FRICTION_GLOBAL ? 15 : 100;
    const rb_status s = rb_friction_solve(p->form == RB_FRICTION_GLOBAL ? "nsn-ac" : "nsgs-aa", p,
                                          &opt, &(rb_friction_solution){r, r + m, NULL}, &info);
    return s == RB_OK ? info.flops : INFINITY;
}

static void measure(const char *name, const rb_friction_problem *p, tally *t)
{
    const size_t m = (size_t)(p->dimension * p->contacts);
    double *r = rb_alloc(m, 2), seconds = INFINITY;
    rb_friction_options opt = rb_friction_defaults();
    rb_friction_info info;
    champion part, any;
    opt.seconds = SECONDS;
    const rb_status s = least_seconds("auto", p, opt, INFINITY, r, &seconds, &info);
    const champion of_auto = {info.flops, seconds, "auto", "auto"};
    find_best(p, &of_auto, r, &part, &any);
    /* Again, so that work of others on the machine meets both sides. */
    if (s == RB_OK) {
        double again = INFINITY;
        least_seconds("auto", p, opt, INFINITY, r, &again, &info);
        seconds = fmin(seconds, again);
    }
    const double flops = info.flops, ratio = flops / part.flops;
    const double first = first_member(p, r), slower = seconds / part.seconds;
    t->problems++;
    t->solved += s == RB_OK;
    t->beyond += ratio > 3.0;
    t->worst = fmax(t->worst, ratio);
    if (seconds > SHORT) {
        t->beyond_seconds += slower > 3.0;
        t->worst_seconds = fmax(t->worst_seconds, slower);
    }
    printf("%-40.40s %8d %10.3g %-16s %6.2f %-16s %6.2f %9.2f %-16s %6.2f %-16s %6.2f", name,
           p->contacts, flops, part.name, ratio, any.name, flops / any.flops, 1e3 * seconds,
           part.fastest, slower, any.fastest, seconds / any.seconds);
    if (isfinite(first)) {
        t->first++;
        t->first_beyond += flops > 1.1 * first;
        t->worst_first = fmax(t->worst_first, flops / first);
        printf(" %6.2f", flops / first);
    }
    printf("%s\n", s == RB_OK ? "" : "  (not solved)");
    fflush(stdout);
    free(r);
}

static void measure_file(const char *path, const char *name, tally *t)
{
    rb_friction_problem p;
    rb_message why = {.text = ""};
    if (rb_friction_read(path, &p, &why) != RB_OK) {
        printf("%s\n", why.text);
        return;
    }
    measure(name, &p, t);
    rb_friction_problem_free(&p);
}

static void measure_packings(tally *t)
{
    const char *build = getenv("B") ? getenv("B") : "build";
    char line[80], path[] = "/tmp/rollbem-portfolio-XXXXXX", command[400];
    FILE *list = fopen(LIST, "r");
    const int file = mkstemp(path);
    if (!list || file < 0)
        printf("%s: not found from here\n", LIST);
    while (list && file >= 0 && fgets(line, sizeof line, list)) {
        line[strcspn(line, "\n")] = '\0';
        snprintf(command, sizeof command, "%s/packings %s >%s", build, line, path);
        if (system(command) == 0)
            measure_file(path, line, t);
    }
    if (list)
        fclose(list);
    if (file >= 0) {
        close(file);
        unlink(path);
    }
}

static void measure_published(const char *root, tally *t)
{
    static const char *const patterns[] = {"siconos/fc2d/*.dat",   "siconos/fc3d/*.dat",
                                           "fclib/*.hdf5",         "packings/spheres4*.dat",
                                           "packings/*_300_*.dat", "packings/scale*.dat"};
    for (int k = 0; root && k < (int)(sizeof patterns / sizeof *patterns); k++) {
        char pattern[1024];
        glob_t found;
        snprintf(pattern, sizeof pattern, "%s/%s", root, patterns[k]);
        if (glob(pattern, 0, NULL, &found) != 0)
            continue;
        for (size_t i = 0; i < found.gl_pathc; i++)
            measure_file(found.gl_pathv[i], strrchr(found.gl_pathv[i], '/') + 1, t);
        globfree(&found);
    }
}

int main(int argc, char **argv)
{
    fast_blas(argv);
    keep_memory();
    tally t = {0};
    printf("%-40s %8s %10s %-16s %6s %-16s %6s %9s %-16s %6s %-16s %6s %6s\n", "problem",
           "contacts", "flops", "best part", "ratio", "best solver", "ratio", "auto ms",
           "fastest part", "ratio", "fastest", "ratio", "first");
    for (int k = 1; k < argc; k++)
        measure_file(argv[k], argv[k], &t);
    if (argc == 1) {
        measure_packings(&t);
        measure_published(getenv("ROLLBEM_DATA"), &t);
    }
    printf("%d problems, %d solved; auto / best part at most %.2f, above 3 on %d; auto / "
           "first member at most %.2f, above 1.1 on %d of %d\n"
           "seconds, where auto takes more than 2 ms: auto / fastest part at most %.2f, above 3 on "
           "%d\n",
           t.problems, t.solved, t.worst, t.beyond, t.worst_first, t.first_beyond, t.first,
           t.worst_seconds, t.beyond_seconds);
    return 0;
}
