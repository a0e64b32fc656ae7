/* `auto` against the friction solvers of Siconos on the friction files below
 * ROLLBEM_DATA, at 1e-4 and 1e-8 in the measure (13), which is recomputed for both.
 * Siconos stops by a measure of its own: it is run at the tolerance, then at 1e-2 and
 * 1e-4 times it, until (13) is met, and only the run that met it is timed.  Siconos runs
 * in a child process, since it may exit. Optional: only where Debian's
 * libsiconos-numerics-dev was found at build time. */
#include "rollbem/friction.h"

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

/* The same for both sides: the best of at least three runs unless they are long, of many
 * where they are short. */
static int once_more(int runs, double total)
{
    return runs < 3 ? total < 2.0 : runs < 200 && total < 0.05;
}

/* ---- Siconos -------------------------------------------------------------------------
 */

/* Text files as Siconos itself stores them; everything else, and what Lemke needs, dense
 * or sparse from our W. */
static FrictionContactProblem *their_problem(const char *path,
                                             const rb_friction_problem *p, int dense)
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
    return frictionContactProblem_new_with_data(p->dimension, p->contacts, M, p->q,
                                                p->mu);
}

/* In the child: one run from zero; seconds and r go to the pipe. */
static void child(const char *path, const rb_friction_problem *p, int id, double tol,
                  int out)
{
    const size_t m = (size_t)(p->dimension * p->contacts);
    double *r = rb_alloc(m, 1), *u = rb_alloc(m, 1);
    FrictionContactProblem *f = their_problem(path, p, id == SICONOS_FRICTION_2D_LEMKE);
    SolverOptions *options = solver_options_create(id);
    options->dparam[SICONOS_DPARAM_TOL] = tol;
    options->iparam[SICONOS_IPARAM_MAX_ITER] =
        id == SICONOS_FRICTION_3D_NSN_AC ? 200 : 100000;
    if (id == SICONOS_FRICTION_3D_NSN_AC)
        options->iparam[SICONOS_FRICTION_3D_NSN_LINESEARCH] =
            SICONOS_FRICTION_3D_NSN_LINESEARCH_GOLDSTEINPRICE;
    double best = INFINITY, total = 0.0;
    for (int run = 0; once_more(run, total); run++) {
        memset(r, 0, m * sizeof *r);
        memset(u, 0, m * sizeof *u);
        const double start = rb_seconds();
        if (p->dimension == 2)
            fc2d_driver(f, r, u, options);
        else
            fc3d_driver(f, r, u, options);
        const double taken = rb_seconds() - start;
        best = fmin(best, taken);
        total += taken;
    }
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
static double their_seconds(const char *path, const rb_friction_problem *p, int id,
                            double tol)
{
    const size_t m = (size_t)(p->dimension * p->contacts);
    double *r = rb_alloc(m, 1), seconds = INFINITY, error;
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
        const int answered = read_all(ends[0], &taken, sizeof taken) &&
                             read_all(ends[0], r, m * sizeof *r);
        close(ends[0]);
        waitpid(pid, NULL, 0);
        if (!answered)
            break;
        if (rb_friction_error(p, r, NULL, NULL, &error, NULL) == RB_OK && error <= tol) {
            seconds = taken;
            break;
        }
    }
    free(r);
    return seconds;
}

/* ---- rollbem
 * --------------------------------------------------------------------------- */

static double our_seconds(const rb_friction_problem *p, double tol,
                          rb_friction_info *info)
{
    const size_t m = (size_t)(p->dimension * p->contacts);
    double *r = rb_alloc(m, 1), *u = rb_alloc(m, 1), best = INFINITY, total = 0.0;
    rb_friction_options opt = rb_friction_defaults();
    opt.tol = tol;
    for (int run = 0; once_more(run, total); run++) {
        if (rb_friction_solve("auto", p, &opt, r, u, NULL, info) != RB_OK ||
            info->residual > tol) {
            best = INFINITY;
            break;
        }
        best = fmin(best, info->seconds);
        total += info->seconds;
    }
    free(u);
    free(r);
    return best;
}

/* ---- Tables
 * ----------------------------------------------------------------------------- */

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(int n, double *x)
{
    qsort(x, (size_t)n, sizeof *x, by_size);
    return n ? 0.5 * (x[(n - 1) / 2] + x[n / 2]) : NAN;
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
    const double ours = our_seconds(p, tol, &info);
    double fastest = INFINITY;
    t->ours += isfinite(ours);
    printf("%-36.36s %9.2e (%s)", name, ours, info.solver);
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
    printf("solved: rollbem auto %d of %d, any Siconos solver %d\n", t->ours, FILES,
           t->any);
    for (int flat = 0; flat < 2; flat++)
        for (int s = 0; s < THEIRS; s++)
            printf("%-11s solves %2d; Siconos / rollbem, median over files both solve: "
                   "%.1f\n",
                   theirs[flat][s].name, t->solved[flat][s],
                   median(t->n[flat][s], t->ratio[flat][s]));
    printf("the fastest Siconos solver of each file / rollbem auto, median: %.1f\n\n",
           median(t->best_n, t->best));
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
