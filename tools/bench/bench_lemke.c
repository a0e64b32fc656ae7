/* Lemke's method: microseconds (of one processor) per pivot of the delayed-update tableau
 * against a tableau with one rank-1 update per pivot (the same pivots) and, where
 * Debian's libsiconos-numerics-dev was found at build time, against its lcp_lexicolemke.
 *
 * Problem: Kwak's form (K4) of steady rolling on a half-plane, dissimilar bodies, equal
 * elements over 1.3 times the Hertz half-width; lengths in a, stresses in E* a/R. */
#include "keep_memory.h"
#include "lcp_families.h"
#include "base/blas.h"
#include "lcp/lcp.h"

#include <gsl/gsl_sort.h>
#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef HAVE_SICONOS
#include <LCP_Solvers.h>
#include <LinearComplementarityProblem.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>
#include <lcp_cst.h>
#endif

static const double PI = 3.14159265358979323846, MU = 0.3, CREEP_RATIO = 0.9;

typedef struct {
    int n;
    double *M, *q;
} problem;

static double *need(size_t rows, size_t cols)
{
    double *x = rb_alloc(rows, cols);
    if (!x) {
        fprintf(stderr, "bench_lemke: out of memory\n");
        exit(70);
    }
    return x;
}

/* Of this thread: neither other work on the machine counts nor threads that OpenBLAS
 * keeps waiting, which spin for the first tenth of a second. */
static double cpu_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- The problem ------------------------------------------------------------------ */

static double log_term(double s)
{
    return s == 0.0 ? 0.0 : s * log(fabs(s)) - s;
}

/* Displacement at x of unit strips over [s0, s1] (kernels 5): along the load, and across
 * it (the coupling of a dissimilar pair, Dundurs beta = 0.3); datum at depth 10. */
static void strip(double x, double s0, double s1, double *along, double *across)
{
    *along = -2.0 / PI * (log_term(s1 - x) - log_term(s0 - x) - (s1 - s0) * log(10.0));
    *across = 0.3 * (fabs(x - s0) - fabs(x - s1));
}

typedef struct {
    int n;           /* contact elements */
    double h;        /* their length */
    double *Fn, *Fc; /* (n + 1) x n: along, across */
} flexibility;

static double midpoint(const flexibility *f, int i)
{
    return (i + 0.5 - 0.5 * f->n) * f->h;
}

static flexibility make_flexibility(int n)
{
    flexibility f = {n, 2.6 / n, need(n + 1, n), need(n + 1, n)};
    for (int j = 0; j < n; j++)
        for (int i = 0; i <= n; i++)
            strip(midpoint(&f, i), midpoint(&f, j) - 0.5 * f.h, midpoint(&f, j) + 0.5 * f.h,
                  f.Fn + i + (size_t)j * (n + 1), f.Fc + i + (size_t)j * (n + 1));
    return f;
}

/* X <- (A F_TT)^-1 [A F_TT stands in B; X holds A F_TN, I, d_T: n x (2n + 1)]. */
static void eliminate_tractions(const flexibility *f, double creep, double *X)
{
    const int n = f->n, m = n + 1;
    double *B = need(n, n);
    int *piv = rb_alloc_int(n);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const size_t at = i + (size_t)j * m;
            B[i + (size_t)j * n] = f->Fn[at] - f->Fn[at + 1];
            X[i + (size_t)j * n] = -(f->Fc[at] - f->Fc[at + 1]);
            X[i + (size_t)(n + j) * n] = i == j;
        }
    for (int i = 0; i < n; i++)
        X[i + (size_t)(2 * n) * n] = creep * f->h;
    LAPACKE_dgesv(LAPACK_COL_MAJOR, n, 2 * n + 1, B, n, piv, X, n);
    free(B);
    free(piv);
}

/* d_N: the gap under the approach that gives the half-width 1 without friction. */
static double normal_distance(const flexibility *f, int i)
{
    double approach = 0.0;
    for (int j = 0; j < f->n; j++) {
        const double x = midpoint(f, j), p = 0.5 * sqrt(fmax(0.0, 1.0 - x * x));
        approach += p * f->Fn[f->n / 2 + (size_t)j * (f->n + 1)];
    }
    return 0.5 * midpoint(f, i) * midpoint(f, i) - approach;
}

/* (K4): z = (r_N, lambda+, lambda-), w = (y_N, gamma+, gamma-). */
static problem make_kwak(int nc, double mu, double creep_ratio)
{
    const int n = 3 * nc, m = nc + 1;
    const flexibility f = make_flexibility(nc);
    problem p = {n, need(n, n), need(n, 1)};
    double *X = need(nc, 2 * nc + 1), *Y = need(nc, 2 * nc + 1);
    eliminate_tractions(&f, creep_ratio * mu, X);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, nc, 2 * nc + 1, nc, 1.0, f.Fc, m, X, nc,
                0.0, Y, nc);
    for (int j = 0; j < nc; j++)
        for (int i = 0; i < nc; i++) {
            const size_t at = i + (size_t)j * nc, inv = at + (size_t)nc * nc;
            double *c0 = p.M + i + (size_t)j * n, *c1 = c0 + (size_t)nc * n,
                   *c2 = c1 + (size_t)nc * n;
            c0[0] = f.Fn[i + (size_t)j * m] - Y[at];
            c0[nc] = mu * (i == j) - X[at];
            c0[2 * nc] = mu * (i == j) + X[at];
            c1[0] = Y[inv], c2[0] = -Y[inv];
            c1[nc] = c2[2 * nc] = X[inv];
            c2[nc] = c1[2 * nc] = -X[inv];
        }
    const size_t d = (size_t)nc * (size_t)(2 * nc);
    for (int i = 0; i < nc; i++) {
        p.q[i] = normal_distance(&f, i) - Y[d + i];
        p.q[nc + i] = -X[d + i];
        p.q[2 * nc + i] = X[d + i];
    }
    free(X);
    free(Y);
    free(f.Fn);
    free(f.Fc);
    return p;
}

/* (K5), the same problem without an inverse: z = (r_N, gamma+, lambda-),
 * w = (y_N, lambda+, gamma-). */
static problem make_pivoted(int nc, double mu, double creep_ratio)
{
    const size_t n = 3 * (size_t)nc, m = (size_t)nc + 1, c = (size_t)nc;
    const flexibility f = make_flexibility(nc);
    problem p = {(int)n, need(n, n), need(n, 1)};
    for (size_t j = 0; j < c; j++)
        for (size_t i = 0; i < c; i++) {
            const size_t at = i + j * m;
            const double Att = f.Fn[at] - f.Fn[at + 1], Atn = -f.Fc[at] + f.Fc[at + 1];
            p.M[i + j * n] = f.Fn[at] - mu * f.Fc[at];
            p.M[i + (c + j) * n] = f.Fc[at];
            p.M[c + i + j * n] = Atn - mu * Att;
            p.M[c + i + (c + j) * n] = Att;
        }
    for (size_t i = 0; i < c; i++) {
        p.M[c + i + (2 * c + i) * n] = 1.0;
        p.M[2 * c + i + i * n] = 2.0 * mu;
        p.M[2 * c + i + (c + i) * n] = -1.0;
        p.q[i] = normal_distance(&f, (int)i);
        p.q[c + i] = creep_ratio * mu * f.h;
    }
    free(f.Fn);
    free(f.Fc);
    return p;
}

static double power_of_two(double x)
{
    return x > 0.0 ? exp2(-round(0.5 * log2(x))) : 1.0;
}

/* Unit diagonal to a factor of two where there is one, without rounding (theory.md 4.4). */
static void scale(problem *p)
{
    const size_t n = (size_t)p->n;
    double *s = need(n, 1);
    for (size_t i = 0; i < n; i++)
        s[i] = power_of_two(fabs(p->M[i + i * n]));
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < n; i++)
            p->M[i + j * n] *= s[i] * s[j];
    for (size_t i = 0; i < n; i++)
        p->q[i] *= s[i];
    free(s);
}

/* ---- One rank-1 update per pivot -------------------------------------------------- */

typedef struct {
    int count, room;
    int *row, *column, *place; /* place: row, or -1 - column, of each variable */
} path;

static void record(const rb_lcp_pivot *pivot, void *context)
{
    path *p = context;
    if (pivot->pivot >= p->room)
        return;
    p->row[pivot->pivot] = pivot->row;
    int c = 0;
    while (pivot->nonbasis[c] != pivot->leaving)
        c++;
    p->column[pivot->pivot] = c;
    p->count = pivot->pivot + 1;
}

static path make_path(int n)
{
    const int room = 10 * n;
    return (path){0, room, rb_alloc_int(room), rb_alloc_int(room), NULL};
}

/* Row of the least ratio: what a plain Lemke does before it updates. */
static int least_ratio(int n, const double *a, const double *q)
{
    int r = -1;
    double least = INFINITY;
    for (int i = 0; i < n; i++)
        if (a[i] < -1e-12 && fmax(q[i], 0.0) / -a[i] < least) {
            least = fmax(q[i], 0.0) / -a[i];
            r = i;
        }
    return r;
}

/* Follows the recorded path; returns seconds, counts rows that the plain ratio test would
 * have chosen otherwise. */
static double rank_one(const problem *p, const path *way, int *other)
{
    const int n = p->n;
    double *T = need(n, n + 2), *u = need(n, 1), *v = need(n + 2, 1);
    memcpy(T, p->M, (size_t)n * n * sizeof *T);
    for (int i = 0; i < n; i++) {
        T[i + (size_t)n * n] = 1.0;
        T[i + (size_t)(n + 1) * n] = p->q[i];
    }
    *other = 0;
    const double start = cpu_seconds();
    for (int k = 0; k < way->count; k++) {
        const int r = way->row[k], c = way->column[k];
        const double *a = T + (size_t)c * n, pivot = a[r];
        *other += k > 0 && least_ratio(n, a, T + (size_t)(n + 1) * n) != r;
        cblas_dcopy(n, a, 1, u, 1);
        cblas_dcopy(n + 2, T + r, n, v, 1);
        cblas_dscal(n + 2, 1.0 / pivot, v, 1);
        u[r] += 1.0;
        v[c] -= 1.0 / pivot;
        cblas_dger(CblasColMajor, n, n + 2, -1.0, u, 1, v, 1, T, n);
    }
    const double seconds = cpu_seconds() - start;
    free(T);
    free(u);
    free(v);
    return seconds;
}

/* ---- Siconos ----------------------------------------------------------------------- */

#ifdef HAVE_SICONOS
static double siconos(const problem *p, int *pivots, double *residual)
{
    double *M = need(p->n, p->n), *z = need(p->n, 1), *w = need(p->n, 1);
    memcpy(M, p->M, (size_t)p->n * (size_t)p->n * sizeof *M);
    LinearComplementarityProblem lcp = {p->n, NM_create_from_data(NM_DENSE, p->n, p->n, M), p->q};
    SolverOptions *options = solver_options_create(SICONOS_LCP_LEMKE);
    options->iparam[SICONOS_IPARAM_MAX_ITER] = 100 * p->n;
    int info = 0;
    const double start = cpu_seconds();
    lcp_lexicolemke(&lcp, z, w, &info, options);
    const double seconds = cpu_seconds() - start;
    *pivots = options->iparam[SICONOS_IPARAM_ITER_DONE];
    *residual = rb_lcp_residual(&(rb_lcp_problem){p->n, p->M, p->n, p->q}, z, NULL);
    solver_options_delete(options);
    NM_clear(lcp.M); /* frees M */
    free(z);
    free(w);
    return seconds;
}
#endif

/* ---- Table ------------------------------------------------------------------------- */

static double delayed(const problem *p, int runs, rb_lcp_info *info)
{
    double *z = need(p->n, 1), *seconds = need(runs, 1);
    for (int k = 0; k < runs; k++) {
        const double start = cpu_seconds();
        const rb_status s = rb_lcp_lemke(&(rb_lcp_problem){p->n, p->M, p->n, p->q}, NULL, z, info);
        seconds[k] = cpu_seconds() - start;
        if (s != RB_OK)
            fprintf(stderr, "bench_lemke: %s: %s\n", rb_status_text(s), info->msg.text);
    }
    gsl_sort(seconds, 1, runs);
    const double median = seconds[runs / 2];
    free(z);
    free(seconds);
    return median;
}

static void line(const char *name, double seconds, int pivots, double reference)
{
    printf("  %-26s %6d pivots %9.1f us/pivot  ratio %6.1f\n", name, pivots, 1e6 * seconds / pivots,
           seconds / pivots / reference);
}

static double without_inverse(int nc, int runs)
{
    problem p = make_pivoted(nc, MU, CREEP_RATIO);
    rb_lcp_info info;
    scale(&p);
    const double seconds = delayed(&p, runs, &info);
    printf("Pivoted form, n_c = %d: solved in %.3f s, %d pivots, %.1f us/pivot, residual "
           "%.1e\n",
           nc, seconds, info.iters, 1e6 * seconds / info.iters, info.res);
    free(p.M);
    free(p.q);
    return seconds;
}

static void compare(int nc, int runs)
{
    problem p = make_kwak(nc, MU, CREEP_RATIO);
    scale(&p);
    path way = make_path(p.n);
    rb_lcp_options opt = rb_lcp_defaults();
    rb_lcp_info info;
    double *z = need(p.n, 1);
    opt.trace = record;
    opt.trace_context = &way;
    rb_lcp_lemke(&(rb_lcp_problem){p.n, p.M, p.n, p.q}, &opt, z, &info);

    int other;
    const double ours = delayed(&p, runs, &info), plain = rank_one(&p, &way, &other);
    const double per_pivot = ours / info.iters;
    printf("Kwak's form, n_c = %d, order %d: solved in %.3f s, residual %.1e\n", nc, p.n, ours,
           info.res);
    line("delayed update (rollbem)", ours, info.iters, per_pivot);
    line("rank-1 update, same pivots", plain, way.count, per_pivot);
    if (other)
        printf("  (a plain ratio test would have chosen %d other rows)\n", other);
#ifdef HAVE_SICONOS
    int pivots;
    double residual;
    const double pivoted = without_inverse(nc, runs), theirs = siconos(&p, &pivots, &residual);
    line("Siconos lcp_lexicolemke", theirs, pivots, per_pivot);
    printf("  whole solve: rollbem %.4g s, its pivoted form %.4g s, Siconos %.4g s: %.1f "
           "and "
           "%.1f times as long; residual of Siconos %.1e\n",
           ours, pivoted, theirs, theirs / ours, theirs / pivoted, residual);
#else
    without_inverse(nc, runs);
    printf("  (libsiconos-numerics-dev was not found at build time)\n");
#endif
    free(z);
    free(way.row);
    free(way.column);
    free(p.M);
    free(p.q);
}

/* ---- Families ---------------------------------------------------------------------- */

/* Methods of others can go on for ever: each has a process of its own and so many
 * seconds. */
enum { MOST_SECONDS = 10 };

typedef struct {
    double seconds; /* least of the runs; INFINITY: not solved */
    const char *solver;
} timing;

static double *dense_of(const lcp_family *f)
{
    double *D = need((size_t)f->n, (size_t)f->n);
    for (int j = 0; j < f->n; j++)
        for (int k = f->M.p[j]; k < f->M.p[j + 1]; k++)
            D[f->M.i[k] + (size_t)j * (size_t)f->n] = f->M.x[k];
    return D;
}

/* The residual of each row against its terms, recomputed here.  z: of the scaled problem. */
static int solves(const lcp_family *f, const double *z, const double *column)
{
    long double *w = calloc((size_t)f->n, 2 * sizeof *w), *terms = w + f->n;
    int right = w != NULL;
    for (int i = 0; right && i < f->n; i++) {
        w[i] = f->q[i];
        terms[i] = fabs(f->q[i]);
    }
    for (int j = 0; right && j < f->n; j++)
        for (int k = f->M.p[j]; k < f->M.p[j + 1]; k++) {
            const long double x = (long double)f->M.x[k] * z[j] * (column ? column[j] : 1.0);
            w[f->M.i[k]] += x;
            terms[f->M.i[k]] += fabsl(x);
        }
    for (int i = 0; right && i < f->n; i++) {
        const long double x = (long double)z[i] * (column ? column[i] : 1.0);
        right = x >= 0.0L && fabsl(x < w[i] ? x : w[i]) <= 1e-8L * terms[i];
    }
    free(w);
    return right;
}

/* One of our own by name; dense: for the tableau, whose matrix is made before, or NULL. */
typedef struct {
    const char *name;
    const double *dense;
    timing least; /* INFINITY: not solved, and not tried again */
} own_method;

static void run_once(own_method *m, const lcp_family *f, double *z)
{
    rb_lcp_options opt = rb_lcp_defaults();
    rb_lcp_info info = {0};
    opt.seconds = MOST_SECONDS;
    const double start = cpu_seconds();
    const rb_status s =
        m->dense
            ? rb_lcp_lemke(&(rb_lcp_problem){f->n, m->dense, f->n, f->q}, &opt, z, &info)
            : rb_lcp_solve(m->name, &(rb_lcp_mixed_problem){.M = &f->M, .q = f->q}, &opt, z, &info);
    const double seconds = cpu_seconds() - start;
    m->least = s == RB_OK ? (timing){fmin(m->least.seconds, seconds), info.solver}
                          : (timing){INFINITY, NULL};
}

/* The least times of methods that take turns, so that what else the machine does meets all of
 * them.  z: n x methods, what each has found. */
static void run_in_turns(int methods, own_method *method, const lcp_family *f, double *z)
{
    const double since = cpu_seconds();
    for (int runs = 0; runs < 3 || (runs < 100 && cpu_seconds() - since < 0.05 * methods); runs++)
        for (int k = 0; k < methods; k++)
            if (runs == 0 || isfinite(method[k].least.seconds))
                run_once(&method[k], f, z + (size_t)k * (size_t)f->n);
}

#ifdef HAVE_SICONOS
typedef void siconos_solver(LinearComplementarityProblem *, double *, double *, int *,
                            SolverOptions *);

static const struct {
    int id;
    siconos_solver *solve;
} theirs[] = {{SICONOS_LCP_LEMKE, lcp_lexicolemke},
              {SICONOS_LCP_PATHSEARCH, lcp_pathsearch},
              {SICONOS_LCP_NEWTONMIN, lcp_newton_min},
              {SICONOS_LCP_NEWTON_FB_FBLSA, lcp_newton_FB}};

static int goes_on(int runs, double since)
{
    return runs < 3 || (runs < 100 && cpu_seconds() - since < 0.05);
}

/* Solved: to 1e-8 of the largest terms. */
static double run_theirs(int k, const lcp_family *f, const double *dense)
{
    const size_t n = (size_t)f->n;
    double best = INFINITY;
    double *M = malloc(n * n * sizeof *M), *z = need(n, 1), *w = need(n, 1);
    double *q = need(n, 1);
    const double since = cpu_seconds();
    for (int runs = 0; goes_on(runs, since); runs++) {
        memcpy(M, dense, n * n * sizeof *M);
        memcpy(q, f->q, n * sizeof *q);
        memset(z, 0, n * sizeof *z);
        LinearComplementarityProblem lcp = {f->n, NM_create_from_data(NM_DENSE, f->n, f->n, M), q};
        SolverOptions *options = solver_options_create(theirs[k].id);
        options->iparam[SICONOS_IPARAM_MAX_ITER] = 100 * f->n;
        options->dparam[SICONOS_DPARAM_TOL] = 1e-10;
        int info = 0;
        const double start = cpu_seconds();
        theirs[k].solve(&lcp, z, w, &info, options);
        const double seconds = cpu_seconds() - start;
        const rb_lcp_mixed_problem p = {.M = &f->M, .q = f->q};
        const double floor = rb_lcp_rounding_floor(&p, z, w);
        if (!(rb_lcp_residual_mixed(&p, z, w) <= 1e6 * floor))
            return INFINITY;
        best = fmin(best, seconds);
    }
    return best;
}

static double other(int k, const lcp_family *f, const double *dense)
{
    int ends[2];
    double seconds = INFINITY;
    fflush(stdout);
    if (pipe(ends) != 0)
        return INFINITY;
    const pid_t child = fork();
    if (child == 0) {
        alarm(MOST_SECONDS);
        if (freopen("/dev/null", "w", stdout) && freopen("/dev/null", "w", stderr))
            seconds = run_theirs(k, f, dense);
        _exit(write(ends[1], &seconds, sizeof seconds) != sizeof seconds);
    }
    close(ends[1]);
    if (read(ends[0], &seconds, sizeof seconds) != sizeof seconds)
        seconds = INFINITY;
    close(ends[0]);
    waitpid(child, NULL, 0);
    return seconds;
}
#endif

static void cell(double seconds)
{
    if (isfinite(seconds))
        printf(" %9.4g |", 1e6 * seconds);
    else
        printf("         . |");
}

/* Claimed solutions of our own solvers, and those of them that are wrong. */
static int claims, wrong_claims;

enum { LARGEST_DENSE = 3300, LARGEST_OTHER = 1700 };

/* A row: our own, auto over the best of them, and Siconos'.  The column of Lemke's tableau is with
 * its matrix at hand, as Siconos has it; in the ratio it makes it from the sparse one, as auto
 * does. unscaled: the problem before rows and columns were multiplied, column: by what (NULL: by
 * nothing).
 */
static double family_row(const char *name, const lcp_family *f, const lcp_family *unscaled,
                         const double *column)
{
    enum { METHODS = 5, AUTO = 3 };
    double *dense = f->n <= LARGEST_DENSE ? dense_of(f) : NULL;
    double *z = need((size_t)f->n, METHODS), seconds[METHODS];
    own_method method[METHODS] = {
        {"lemke", dense, {INFINITY, NULL}},
        {"lemke-sparse", NULL, {INFINITY, NULL}},
        {"newton", NULL, {INFINITY, NULL}},
        {"auto", NULL, {INFINITY, NULL}},
        {"lemke", NULL, {INFINITY, NULL}} /* with the making of its matrix */};
    const int first = dense ? 0 : 1, last = dense ? METHODS : METHODS - 1;
    run_in_turns(last - first, method + first, f, z + (size_t)first * (size_t)f->n);
    for (int k = 0; k < METHODS; k++) {
        seconds[k] = method[k].least.seconds;
        if (k <= AUTO && isfinite(seconds[k])) {
            claims++;
            wrong_claims += !solves(unscaled, z + (size_t)k * (size_t)f->n, column);
        }
    }
    const timing chosen = method[AUTO].least;
    const double best = fmin(seconds[METHODS - 1], fmin(seconds[1], seconds[2]));
    printf("| %s%s | %d |", name, column ? ", scaled" : "", f->n);
    for (int k = 0; k < 4; k++)
        cell(seconds[k]);
    printf(" %s |", isfinite(chosen.seconds) ? chosen.solver : ".");
    if (isfinite(best))
        printf(" %.2g |", chosen.seconds / best);
    else
        printf(" . |");
#ifdef HAVE_SICONOS
    for (int k = 0; k < 4; k++)
        cell(dense && f->n <= LARGEST_OTHER ? other(k, f, dense) : INFINITY);
#endif
    printf("\n");
    fflush(stdout);
    free(z);
    free(dense);
    return isfinite(best) ? chosen.seconds / best : 0.0;
}

static lcp_family family_of(problem *p)
{
    lcp_family f = {.n = p->n, .q = p->q};
    if (rb_sparse_from_dense(p->n, p->n, p->M, p->n, &f.M) != RB_OK)
        exit(70);
    free(p->M);
    return f;
}

/* Microseconds of every solver on every family as it is and scaled by rows and columns,
 * and the largest ratio of auto to the best of our own.  only: one family, or NULL; order: the
 * only one of it, or 0. */
static void families(const char *only, int order)
{
    static const int contacts[] = {20, 100, 400, 1066};
    double worst = 0.0;
    printf("Families, microseconds, `.`: not solved, or not taken.\n"
           "| family | n | lemke | lemke-sparse | newton | auto | by | auto / best | "
           "lexicolemke | pathsearch | newton min | FB |\n");
    for (int kind = 0; kind <= LCP_FAMILIES; kind++) {
        const int kwak = kind == LCP_FAMILIES;
        const char *name = kwak ? "kwak" : lcp_families[kind].name;
        for (int k = 0; k < 4 && (kwak || lcp_families[kind].n[k]); k++) {
            lcp_family f[2];
            if ((only && strcmp(only, name) != 0) || (order && k))
                continue;
            for (int scaled = 0; scaled < 2; scaled++) {
                problem p = kwak ? make_kwak(order ? order / 3 : contacts[k], MU, CREEP_RATIO)
                                 : (problem){0};
                if (kwak)
                    f[scaled] = family_of(&p);
                else if (lcp_family_create(kind, order ? order : lcp_families[kind].n[k],
                                           &f[scaled]) != RB_OK)
                    exit(70);
            }
            double *column = need((size_t)f[0].n, 1);
            lcp_family_scale(&f[1], 12.0, column);
            worst = fmax(worst, family_row(name, &f[0], &f[0], NULL));
            if (f[0].n <= LARGEST_OTHER)
                worst = fmax(worst, family_row(name, &f[1], &f[0], column));
            free(column);
            lcp_family_free(&f[0]);
            lcp_family_free(&f[1]);
        }
    }
    printf("auto / best of our own: %.2f at most; claimed solutions: %d, wrong: %d\n", worst,
           claims, wrong_claims);
}

/* Alone with an argument, `families`: the families; with one more: that one; with a third: of that
 * order. */
int main(int argc, char **argv)
{
    const char *core = rb_blas_better_core();
    if (core && !getenv("OPENBLAS_CORETYPE") && setenv("OPENBLAS_CORETYPE", core, 1) == 0)
        execv("/proc/self/exe", argv); /* read only while OpenBLAS is loaded */
    rb_blas_threads(1);
    keep_memory();
    printf("Lemke's method, one thread, OpenBLAS kernels: %s\n", rb_blas_core());
    if (argc < 2) {
        compare(200, 31);
        compare(800, 3);
    }
    families(argc > 2 ? argv[2] : NULL, argc > 3 ? atoi(argv[3]) : 0);
    return 0;
}
