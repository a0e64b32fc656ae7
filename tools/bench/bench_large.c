/* Large contacts: steady Carter on half-planes (similar bodies, s = 0.4, equal elements)
 * from input to solution, without a matrix, against the dense path on the same problem;
 * how the cost grows; one product of the Toeplitz operator against one of the
 * matrix. Arguments: the numbers of elements (default 1000 ... 100000; 1300000 is a
 * million in contact). */
#include "carter.h"
#include "fast_blas.h"
#include "rows.h"
#include "rolling/rolling.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { REPEATS = 5 };

static void stop(const char *what)
{
    fprintf(stderr, "bench_large: %s\n", what);
    exit(70);
}

static int by_size(const void *a, const void *b)
{
    const double d = *(const double *)a - *(const double *)b;
    return (d > 0) - (d < 0);
}

static double median(int n, double *t)
{
    qsort(t, (size_t)n, sizeof *t, by_size);
    return t[n / 2];
}

/* ---- Growth ------------------------------------------------------------------------ */

static double solution_seconds(const rb_rolling_case *rc, rb_rolling_solution *s)
{
    const int repeats = rc->contact_elements > 200000 ? 1 : REPEATS;
    double t[REPEATS];

    for (int k = 0; k < repeats; k++) {
        rb_message why;
        const double start = processor_seconds();
        if (rb_rolling_solve(rc, s, &why) != RB_OK)
            stop(why.text);
        t[k] = processor_seconds() - start;
        if (k + 1 < repeats)
            rb_rolling_solution_free(s);
    }
    return median(repeats, t);
}

static double solve_seconds(int n, int shown)
{
    const rb_rolling_case rc = carter(n);
    rb_rolling_solution s;
    const double seconds = solution_seconds(&rc, &s);

    if (shown)
        printf("| %s%s | %s | %d | %s | %s | %s |\n", row_count(n).text, s.large ? "" : " (matrix)",
               row_count(s.contact).text, s.iterations, row_seconds(seconds).text,
               row_power(1, s.residual).text, row_power(2, fabs(-s.force_ratio / 0.64 - 1.0)).text);
    fflush(stdout);
    rb_rolling_solution_free(&s);
    return seconds;
}

/* The mesh that the program chooses by itself, aligned with the contact, beside equal
 * elements anywhere. */
static void both_meshes(int count, const int *n)
{
    printf("\n| elements | aligned | equal | ratio | error of Q, aligned |\n"
           "|---|---|---|---|---|\n");
    for (int k = 0; k < count; k++) {
        double seconds[2], error = 0.0;
        for (int aligned = 0; aligned < 2; aligned++) {
            rb_rolling_case rc = carter(n[k]);
            rb_rolling_solution s;
            rc.mesh = aligned ? RB_MESH_ALIGNED : RB_MESH_UNIFORM;
            rc.slip_operator = aligned ? RB_SLIP_SECOND : RB_SLIP_UPSTREAM;
            seconds[aligned] = solution_seconds(&rc, &s);
            error = fabs(-s.force_ratio / 0.64 - 1.0);
            if (s.equal_instead)
                stop("the edges did not come to rest");
            rb_rolling_solution_free(&s);
        }
        printf("| %s | %s | %s | %.1f | %s |\n", row_count(n[k]).text, row_seconds(seconds[1]).text,
               row_seconds(seconds[0]).text, seconds[1] / seconds[0], row_power(1, error).text);
        fflush(stdout);
    }
}

static void growth(int count, const int *n)
{
    double first = 0.0, last = 0.0;

    printf("| elements | in contact | steps | seconds | residual | error of Q |\n"
           "|---|---|---|---|---|---|\n");
    for (int k = 0; k < count; k++) {
        last = solve_seconds(n[k], 1);
        first = k == 0 ? last : first;
    }
    if (count > 1)
        printf("cost grows like n^%.2f from n = %d to %d (wanted: at most 1.3)\n",
               log(last / first) / log((double)n[count - 1] / n[0]), n[0], n[count - 1]);
}

/* ---- Against the matrix ------------------------------------------------------------ */

static void apply_both(int n)
{
    const rb_rolling_case rc = carter(n);
    rb_rolling_mesh mesh;
    rb_rolling_bodies bodies;
    double t[2][REPEATS], *r = rb_alloc(2 * (size_t)n, 1), *w = rb_alloc(2 * (size_t)n + 2, 1);

    if (!r || !w || rb_rolling_mesh_uniform(&rc, NULL, -1.3, 1.3, &mesh, NULL) != RB_OK)
        stop("no memory");
    for (int i = 0; i < 2 * n; i++)
        r[i] = sin(i);
    for (int dense = 0; dense < 2; dense++) {
        rb_rolling_case by = rc;
        by.contact.solver = dense ? RB_SOLVER_LEMKE : RB_SOLVER_NEWTON;
        if (rb_rolling_bodies_create(&by, NULL, &mesh, &bodies, NULL) != RB_OK)
            stop("no memory");
        for (int k = 0; k < REPEATS; k++) {
            const double start = processor_seconds();
            rb_bem_flexibility_apply(&bodies.f, r, w);
            t[dense][k] = processor_seconds() - start;
        }
        rb_rolling_bodies_free(&bodies);
    }
    const double fast = median(REPEATS, t[0]), slow = median(REPEATS, t[1]);
    printf("\n| | matrix | transforms | ratio | difference of q/p0 "
           "|\n|---|---|---|---|---|\n"
           "| one product, %s elements | %s | %s | %.0f | |\n",
           row_count(n).text, row_seconds(slow).text, row_seconds(fast).text, slow / fast);
    free(r);
    free(w);
    rb_rolling_mesh_free(&mesh);
}

/* The same problem by Newton with the matrix, cold, flexibility and all. */
typedef enum { SIMILAR, UNLIKE, STRIPS, PAIRS } bodies_kind;
static const char *const pair_name[PAIRS] = {"similar bodies", "unlike bodies",
                                             "strips of half-spaces (CONTACT)"};

static void solve_both(int n, bodies_kind kind)
{
    rb_rolling_case rc = carter(n);
    rc.b.young *= kind == UNLIKE ? 0.3 : 1.0;
    rc.a.strip = rc.b.strip = kind == STRIPS ? 100.0 : 0.0;
    rb_rolling_case dense = rc;
    rb_rolling_model model;
    rb_rolling_bodies bodies;
    rb_contact_problem problem;
    rb_contact_state state;

    if (rb_rolling_model_create(&rc, &model, NULL) != RB_OK) /* warm */
        stop("no solution");
    rb_rolling_model_free(&model);
    double start = processor_seconds();
    if (rb_rolling_model_create(&rc, &model, NULL) != RB_OK)
        stop("no solution");
    const double fast = processor_seconds() - start;
    dense.contact.solver = RB_SOLVER_LEMKE; /* which needs the matrix */
    start = processor_seconds();
    if (rb_rolling_bodies_create(&dense, NULL, &model.mesh, &bodies, NULL) != RB_OK ||
        rb_rolling_problem_create(&dense, &model.mesh, &bodies, NULL, &problem, NULL) != RB_OK ||
        rb_contact_state_alloc(n, &state) != RB_OK)
        stop("no memory");
    dense.contact.solver = RB_SOLVER_NEWTON;
    if (rb_rolling_problem_solve(&problem, &dense, 0, &state, NULL) != RB_OK)
        stop("no solution with the matrix");
    const double slow = processor_seconds() - start;
    double difference = 0.0;
    for (int i = 0; i < n; i++)
        difference = fmax(difference, fabs(state.q[i] - model.state.q[i]) / problem.stress);
    printf("| one solution, %s, %s elements | %s | %s | %.0f | %s |\n", pair_name[kind],
           row_count(n).text, row_seconds(slow).text, row_seconds(fast).text, slow / fast,
           row_power(1, difference).text);
    rb_contact_state_free(&state);
    rb_contact_problem_free(&problem);
    rb_rolling_bodies_free(&bodies);
    rb_rolling_model_free(&model);
}

int main(int argc, char **argv)
{
    static const int standard[] = {1000, 3200, 10000, 32000, 100000};
    static const int both[] = {320, 1200, 2000};
    static const int meshes[] = {400, 1600, 10000, 100000, 300000, 1000000};
    int n[32], count = argc - 1;

    fast_blas(argv);
    if (count > 32)
        stop("too many arguments");
    for (int k = 0; k < count; k++)
        if ((n[k] = atoi(argv[k + 1])) < 3)
            stop("expected numbers of elements");
    solve_seconds(2000, 0); /* warm */
    if (count > 0) {
        growth(count, n);
        return 0;
    }
    growth(5, standard);
    apply_both(4000);
    for (int kind = 0; kind < PAIRS; kind++)
        for (int k = 0; k < 3; k++)
            solve_both(both[k], (bodies_kind)kind);
    both_meshes(6, meshes);
    return 0;
}
