/* `auto` against the friction solvers of Siconos on the friction files below
 * ROLLBEM_DATA, at 1e-4 and 1e-8 in the measure (13), which is recomputed for both.
 * Both sides are timed alike: the problem is read and stored as the solver wants it, its
 * options are made, and then every call that solves it from zero is timed, in seconds of
 * the processor, since other work on the machine would count in those of the clock.  On
 * our side that is rb_friction_setup, not timed, and rb_friction_handle_solve, timed with
 * its recomputed measure; the second figure, in brackets, is rb_friction_solve, which
 * checks and stores the problem every time.
 * Siconos stops by a measure of its own: it is run at the tolerance, then at 1e-2 and
 * 1e-4 times it, until (13) is met, and only the run that met it is timed.  Siconos runs
 * in a child process, since it may exit. Optional: only where Debian's
 * libsiconos-numerics-dev was found at build time. */
#include "lcp/friction/friction.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifndef HAVE_SICONOS

int main(void)
{
    printf("bench_friction: libsiconos-numerics-dev was not found at build time\n");
    return 0;
}

#else

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>
#include <NumericsVerbose.h>

static const char *const files[] = {
    "siconos/fc2d/FC2D_SliderCrankLagrangian00000.dat",
    "siconos/fc2d/FrictionContactProblem00394.dat",
    "siconos/fc2d/FrictionContactProblem00031.dat",
    "siconos/fc2d/FrictionContactProblem00071.dat",
    "siconos/fc2d/FrictionContactProblem00727.dat",
    "siconos/fc3d/FrictionContact3D_1c.dat",
    "siconos/fc3d/Rover11035.dat",
    "siconos/fc3d/FC3D_Example1_SBM.dat",
    "siconos/fc3d/Rover1039.dat",
    "siconos/fc3d/NESpheres_10_1.dat",
    "siconos/fc3d/OneObject-i100000-499.hdf5.dat",
    "siconos/fc3d/Capsules-i101-404.dat",
    "fclib/CubeH8.hdf5",
    "fclib/LMGC_100_PR_PerioBox-i00361-60-03000.hdf5",
    "fclib/Capsules-i125-1213.hdf5",
};
enum { FILES = sizeof files / sizeof files[0], THEIRS = 3 };
static const struct {
    const char *name;
    int id;
} theirs[2][THEIRS] = {
    {{"fc2d_nsgs", SICONOS_FRICTION_2D_NSGS},
     {"fc2d_lemke", SICONOS_FRICTION_2D_LEMKE},
     {"fc2d_cpg", SICONOS_FRICTION_2D_CPG}},
    {{"nsgs", SICONOS_FRICTION_3D_NSGS},
     {"nsn_ac", SICONOS_FRICTION_3D_NSN_AC},
     {"vi_fpp", SICONOS_FRICTION_3D_VI_FPP}},
};

#define SECONDS 20 /* for all runs of one solver on one problem */

#define LEAST_BATCH 2e-4 /* seconds that the clock of the processor tells well */

static double processor_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* The same for both sides: seconds of a run, the best of at least three batches of runs
 * unless they are long, of many where they are short; a batch is one run, or as many as
 * the clock can tell.  INFINITY: a run was no success. */
static double best_seconds(int (*run)(void *context), void *context)
{
    double best = INFINITY, total = 0.0;
    int size = 1;
    for (int batches = 0; batches < 3 ? total < 2.0 : batches < 200 && total < 0.05;) {
        const double start = processor_seconds();
        for (int k = 0; k < size; k++)
            if (!run(context))
                return INFINITY;
        const double taken = processor_seconds() - start;
        if (taken < LEAST_BATCH) {
            size *= 2;
            continue;
        }
        best = fmin(best, taken / size);
        total += taken;
        batches++;
    }
    return best;
}

/* ---- Siconos ----------------------------------------------------------------------- */

/* Text files as Siconos itself stores them; everything else, and what Lemke needs, dense
 * or sparse from our W. */
static FrictionContactProblem *their_problem(const char *path, const rb_friction_problem *p,
                                             int dense)
{
    const int m = p->dimension * p->contacts;
    if (!dense && strstr(path, ".dat"))
        return frictionContact_new_from_filename(path);
    NumericsMatrix *M = NM_create(dense ? NM_DENSE : NM_SPARSE, m, m);
    if (!dense)
        NM_triplet_alloc(M, p->Ws.p[m]);
    for (int j = 0; j < m; j++)
        if (p->form == RB_FRICTION_LOCAL_DENSE)
            for (int i = 0; i < m; i++)
                NM_zentry(M, i, j, p->W[i + (size_t)j * (size_t)m], 0.0);
        else
            for (int k = p->Ws.p[j]; k < p->Ws.p[j + 1]; k++)
                NM_zentry(M, p->Ws.i[k], j, p->Ws.x[k], 0.0);
    return frictionContactProblem_new_with_data(p->dimension, p->contacts, M, p->q, p->mu);
}

typedef struct {
    FrictionContactProblem *problem;
    SolverOptions *options;
    double *r, *u;
} their_call;

/* Whether it has succeeded the measure (13) of r will tell. */
static int their_run(void *context)
{
    const their_call *c = context;
    const size_t m = (size_t)(c->problem->dimension * c->problem->numberOfContacts);
    memset(c->r, 0, m * sizeof *c->r);
    memset(c->u, 0, m * sizeof *c->u);
    if (c->problem->dimension == 2)
        fc2d_driver(c->problem, c->r, c->u, c->options);
    else
        fc3d_driver(c->problem, c->r, c->u, c->options);
    return 1;
}

/* In the child: seconds and r go to the pipe. */
static void child(const char *path, const rb_friction_problem *p, int id, double tol, int out)
{
    const size_t m = (size_t)(p->dimension * p->contacts);
    double *r = rb_alloc(m, 1), *u = rb_alloc(m, 1);
    FrictionContactProblem *f = their_problem(path, p, id == SICONOS_FRICTION_2D_LEMKE);
    SolverOptions *options = solver_options_create(id);
    options->dparam[SICONOS_DPARAM_TOL] = tol;
    options->iparam[SICONOS_IPARAM_MAX_ITER] = id == SICONOS_FRICTION_3D_NSN_AC ? 200 : 100000;
    if (id == SICONOS_FRICTION_3D_NSN_AC)
        options->iparam[SICONOS_FRICTION_3D_NSN_LINESEARCH] =
            SICONOS_FRICTION_3D_NSN_LINESEARCH_GOLDSTEINPRICE;
    their_call call = {f, options, r, u};
    const double best = best_seconds(their_run, &call);
    if (write(out, &best, sizeof best) != sizeof best ||
        write(out, r, m * sizeof *r) != (ssize_t)(m * sizeof *r))
        _exit(1);
    _exit(0);
}

static int read_all(int in, void *to, size_t size)
{
    for (size_t got = 0; got < size;) {
        const ssize_t n = read(in, (char *)to + got, size - got);
        if (n <= 0)
            return 0;
        got += (size_t)n;
    }
    return 1;
}

/* Seconds of a run that meets (13) at tol, else INFINITY. */
static double their_seconds(const char *path, const rb_friction_problem *p, int id, double tol)
{
    const size_t m = (size_t)(p->dimension * p->contacts);
    double *r = rb_alloc(m, 1), seconds = INFINITY;
    rb_friction_errors error;
    for (double at = tol; at >= 0.9e-4 * tol; at *= 1e-2) {
        int ends[2];
        fflush(stdout);
        if (!r || pipe(ends))
            break;
        const pid_t pid = fork();
        if (pid == 0) {
            const int null = open("/dev/null", O_WRONLY);
            dup2(null, 1);
            dup2(null, 2);
            alarm(SECONDS);
            child(path, p, id, at, ends[1]);
        }
        close(ends[1]);
        double taken;
        const int answered =
            read_all(ends[0], &taken, sizeof taken) && read_all(ends[0], r, m * sizeof *r);
        close(ends[0]);
        waitpid(pid, NULL, 0);
        if (!answered)
            break;
        if (rb_friction_error(p, r, NULL, NULL, &error) == RB_OK && error.residual <= tol) {
            seconds = taken;
            break;
        }
    }
    free(r);
    return seconds;
}

/* ---- rollbem ----------------------------------------------------------------------- */

typedef struct {
    const rb_friction_problem *problem;
    rb_friction_handle *handle; /* NULL: the whole of rb_friction_solve */
    rb_friction_options options;
    rb_friction_solution at;
} our_call;

static int our_run(void *context)
{
    const our_call *c = context;
    return (c->handle ? rb_friction_handle_solve(c->handle, "auto", &c->options, &c->at, NULL)
                      : rb_friction_solve("auto", c->problem, &c->options, &c->at, NULL)) == RB_OK;
}

static double our_seconds(const rb_friction_problem *p, rb_friction_handle *handle, double tol,
                          rb_friction_info *info)
{
    const size_t m = (size_t)(p->dimension * p->contacts);
    double *r = rb_alloc(m, 3);
    our_call call = {.problem = p, .handle = handle, .at = {r, r + m, NULL}};
    call.options = rb_friction_defaults();
    call.options.tol = tol;
    call.options.r0 = r + 2 * m; /* zero, not the last solution */
    const double best = best_seconds(our_run, &call);
    const rb_status s = rb_friction_solve("auto", p, &call.options, &call.at, info);
    free(r);
    return s == RB_OK && info->residual <= tol ? best : INFINITY;
}

/* ---- Tables ------------------------------------------------------------------------ */

static double median(int n, double *x)
{
    gsl_sort(x, 1, (size_t)n);
    return n ? 0.5 * (x[(n - 1) / 2] + x[n / 2]) : NAN;
}

static double geometric_mean(int n, const double *x)
{
    double sum = 0.0;
    for (int k = 0; k < n; k++)
        sum += log(x[k]);
    return n ? exp(sum / n) : NAN;
}

/* A global problem goes to Siconos condensed. */
static rb_status load(const char *path, rb_friction_problem *p, rb_message *why)
{
    rb_friction_problem global;
    rb_status s = rb_friction_read(path, p, why);
    if (s != RB_OK || p->form != RB_FRICTION_GLOBAL)
        return s;
    global = *p;
    s = rb_friction_condense(&global, p, why);
    rb_friction_problem_free(&global);
    return s;
}

typedef struct {
    int ours, any, best_n, n[2][THEIRS], solved[2][THEIRS];
    double best[FILES], ratio[2][THEIRS][FILES];
} tally;

static void compare_file(const char *name, const char *path, const rb_friction_problem *p,
                         double tol, tally *t)
{
    const int flat = p->dimension == 2 ? 0 : 1;
    rb_friction_info info;
    rb_friction_handle *handle;
    rb_message why = {.text = ""};
    if (rb_friction_setup(p, &handle, &why) != RB_OK) {
        printf("%s: %s\n", name, why.text);
        return;
    }
    const double whole = our_seconds(p, NULL, tol, &info);
    const double ours = our_seconds(p, handle, tol, &info);
    double fastest = INFINITY;
    rb_friction_handle_free(handle);
    t->ours += isfinite(ours);
    printf("%-36.36s %9.2e (%9.2e) %s:", name, ours, whole, info.solver);
    for (int s = 0; s < THEIRS; s++) {
        const double other = their_seconds(path, p, theirs[flat][s].id, tol);
        printf("  %s %9.2e", theirs[flat][s].name, other);
        fastest = fmin(fastest, other);
        t->solved[flat][s] += isfinite(other);
        if (isfinite(ours) && isfinite(other))
            t->ratio[flat][s][t->n[flat][s]++] = other / ours;
    }
    t->any += isfinite(fastest);
    if (isfinite(ours) && isfinite(fastest))
        t->best[t->best_n++] = fastest / ours;
    printf("  fastest / ours %.2f\n", fastest / ours);
}

static void conclude(tally *t)
{
    printf("solved: rollbem auto %d of %d, any Siconos solver %d\n", t->ours, FILES, t->any);
    for (int flat = 0; flat < 2; flat++)
        for (int s = 0; s < THEIRS; s++)
            printf("%-11s solves %2d; Siconos / rollbem, median over files both solve: "
                   "%.1f\n",
                   theirs[flat][s].name, t->solved[flat][s],
                   median(t->n[flat][s], t->ratio[flat][s]));
    printf("the fastest Siconos solver of each file / rollbem auto, median %.1f, geometric "
           "mean %.1f\n\n",
           median(t->best_n, t->best), geometric_mean(t->best_n, t->best));
}

/* An argument: only files whose names have it in them. */
int main(int argc, char **argv)
{
    const char *root = getenv("ROLLBEM_DATA"), *part = argc > 1 ? argv[1] : "";
    if (!root) {
        printf("bench_friction: ROLLBEM_DATA is not set\n");
        return 0;
    }
    numerics_set_verbose(0);
    for (double tol = 1e-4; tol > 1e-9; tol *= 1e-4) {
        tally t = {0};
        printf("seconds to (13) <= %g; inf: not solved\n", tol);
        for (int k = 0; k < FILES; k++) {
            char path[1024];
            rb_friction_problem p;
            rb_message why;
            if (!strstr(files[k], part))
                continue;
            snprintf(path, sizeof path, "%s/%s", root, files[k]);
            if (load(path, &p, &why) != RB_OK) {
                printf("%s\n", why.text);
                continue;
            }
            compare_file(strrchr(files[k], '/') + 1, path, &p, tol, &t);
            rb_friction_problem_free(&p);
        }
        conclude(&t);
    }
    return 0;
}

#endif
