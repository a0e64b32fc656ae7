/* The sizes of src/base/sizes.h at work.  First, those at which the method changes by itself: a
 * whole solution with fewer elements, by the one method (one less; on meshes with elements outside
 * the contact, which count, four fifths), beside one with as many as the size says, by the other; a
 * ratio of the times per element near 1 says that the size is where both cost the same.  Then those
 * that are limits of what takes seconds: the time at the limit.  Last, threads: elapsed time with
 * one over that with two.  Processor time elsewhere, the least of several runs in turns. */
#include "fast_blas.h"
#include "rows.h"
#include "words.h"
#include "base/sizes.h"
#include "lcp/friction/friction.h"

#include <fftw3.h>
#include <lapacke.h>
#include <unistd.h>

enum { TURNS = 7, SIDES = 2 };

/* ---- Where the method changes ------------------------------------------------------------ */

static const struct {
    const char *name, *options;
    int size;
} changes[] = {
    {"TRANSFORMS, similar", "similar yes mesh uniform", RB_ROLLING_TRANSFORMS},
    {"TRANSFORMS, rigid plane", "mesh uniform", RB_ROLLING_TRANSFORMS},
    {"TRANSFORMS, unlike", "young-b 30000 mesh uniform", RB_ROLLING_TRANSFORMS},
    {"TRANSFORMS_ALIGNED, similar", "similar yes mesh aligned", RB_ROLLING_TRANSFORMS_ALIGNED},
    {"TRANSFORMS_ALIGNED, rigid plane", "mesh aligned", RB_ROLLING_TRANSFORMS_ALIGNED},
    {"TRANSFORMS_ALIGNED, unlike", "young-b 30000 mesh aligned", RB_ROLLING_TRANSFORMS_ALIGNED},
    {"TRANSFORMS_FITTED, rigid plane", "mesh fitted", RB_ROLLING_TRANSFORMS_FITTED},
    {"TRANSFORMS_FITTED, unlike", "young-b 30000 mesh fitted", RB_ROLLING_TRANSFORMS_FITTED},
    {"TRANSFORMS_FITTED, interlayer", "interlayer-tangential 1e-6 mesh fitted",
     RB_ROLLING_TRANSFORMS_FITTED},
    {"TRANSFORMS_STEPS, static", "formulation static shift .0005", RB_ROLLING_TRANSFORMS_STEPS},
    {"PRODUCTS_BESIDE, static", "formulation static shift .0005", RB_ROLLING_PRODUCTS_BESIDE_FROM},
    {"PRODUCTS_BESIDE, static, unlike", "formulation static shift .0005 young-b 30000",
     RB_ROLLING_PRODUCTS_BESIDE_FROM},
    {"CONTACT_LEMKE, unlike", "young-b 30000 mesh uniform", RB_CONTACT_LEMKE_UP_TO + 1},
    {"SEARCH_WITH_FEW, similar", "similar yes mesh uniform", RB_ROLLING_SEARCH_WITH_FEW_FROM},
    {"SEARCH_WITH_FEW, rigid plane", "mesh uniform", RB_ROLLING_SEARCH_WITH_FEW_FROM}};

static double solution_seconds(const char *options, const char *name, int n)
{
    rb_message why = {.text = ""};
    rb_case_result r = {0};
    const double start = processor_seconds();
    rb_case *c = case_of_words(
        (const char *const[]){"support halfplane half-width 1",
                              strstr(options, "static") ? "" : "formulation steady creep-ratio .4",
                              options, word_of(name, n).text, NULL});
    if (rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &why) != RB_OK) {
        fprintf(stderr, "bench_sizes: %s %s %d: %s\n", options, name, n, why.text);
        exit(70);
    }
    const double spent = processor_seconds() - start;
    rb_case_result_free(&r);
    rb_case_free(c);
    return spent;
}

static void print_change(const char *name, const char *options, const char *count, int size)
{
    const int has_others = strstr(options, "aligned") || strstr(options, "fitted");
    const int n[SIDES] = {has_others ? 4 * size / 5 : size - 1, size};
    double t[SIDES] = {INFINITY, INFINITY};

    for (int turn = 0; turn < TURNS && t[0] + t[1] > (turn > 2 ? 0.5 : 0.0); turn++)
        for (int side = 0; side < SIDES; side++)
            t[side] = fmin(t[side], solution_seconds(options, count, n[side]));
    printf("| %s | %s | %s | %s | %.2g |\n", name, row_count(size).text, row_seconds(t[0]).text,
           row_seconds(t[1]).text, t[0] / n[0] / (t[1] / n[1]));
    fflush(stdout);
}

static void all_changes(void)
{
    printf("| where the method changes | from | below | there | per element: below / there |\n"
           "|---|---|---|---|---|\n");
    for (size_t k = 0; k < sizeof changes / sizeof *changes; k++)
        print_change(changes[k].name, changes[k].options, "contact-elements", changes[k].size);
    print_change("FINE_BOUNDARY, hub", "support hub contact-elements 60", "outer-elements",
                 RB_ROLLING_FINE_BOUNDARY_FROM);
}

/* ---- Limits of what takes seconds -------------------------------------------------------- */

static void print_limit(const char *name, int size, double seconds)
{
    printf("| %s | %s | %s |\n", name, row_count(size).text, row_seconds(seconds).text);
    fflush(stdout);
}

static double proof_seconds(int n)
{
    rb_message why = {.text = ""};
    rb_rolling_model model = {0};
    rb_rolling_solution s;
    rb_contact_proof proof;
    rb_case *c = case_of_words((const char *const[]){
        "support halfplane half-width 1 formulation steady creep-ratio .4 young-b 30000 mesh "
        "uniform",
        word_of("contact-elements", n).text, NULL});
    rb_status status = rb_rolling_solve_model(&rb_case_resolved(c)->rc, &model, &s, &why);
    const double start = processor_seconds();
    if (status == RB_OK)
        status = rb_rolling_model_prove(&model, &proof, &why);
    const double spent = processor_seconds() - start;
    if (status != RB_OK) {
        fprintf(stderr, "bench_sizes: no proof of %d elements: %s\n", n, why.text);
        exit(70);
    }
    rb_rolling_solution_free(&s);
    rb_rolling_model_free(&model);
    rb_case_free(c);
    return spent;
}

static void all_limits(void)
{
    printf("\n| limits | size | time there |\n|---|---|---|\n");
    print_limit("PROOF_COUPLED, unlike", RB_CONTACT_PROOF_COUPLED_UP_TO,
                proof_seconds(RB_CONTACT_PROOF_COUPLED_UP_TO));
    print_limit("PROOF_FORMS, unlike", RB_CONTACT_PROOF_FORMS_UP_TO,
                proof_seconds(RB_CONTACT_PROOF_FORMS_UP_TO));
    print_limit("STRONG_BY_MATRIX, mu beta = 1.1", RB_ROLLING_STRONG_BY_MATRIX_UP_TO,
                solution_seconds("mu 2.5 mesh uniform solver lemke", "contact-elements",
                                 RB_ROLLING_STRONG_BY_MATRIX_UP_TO));
    print_limit("FOLLOWING, one step", RB_ROLLING_FOLLOWING_UP_TO,
                solution_seconds("mesh uniform", "contact-elements", RB_ROLLING_FOLLOWING_UP_TO));
    print_limit("FOLLOWING_DEARLY, matrix", RB_ROLLING_FOLLOWING_DEARLY_UP_TO,
                solution_seconds("mesh uniform solver lemke", "contact-elements",
                                 RB_ROLLING_FOLLOWING_DEARLY_UP_TO));
    print_limit("PATCHES, matrix", RB_ROLLING_PATCHES_UP_TO,
                solution_seconds("mesh uniform solver lemke", "contact-elements",
                                 RB_ROLLING_PATCHES_UP_TO));
}

/* ---- Friction: Lemke's method beside the others ------------------------------------------- */

static double friction_seconds(const char *solver, const rb_friction_problem *p, double *r)
{
    const size_t m = (size_t)(p->dimension * p->contacts);
    double least = INFINITY;

    for (int k = 0; k < 3 && !(k > 0 && least > 1.0); k++) {
        const double start = processor_seconds();
        if (rb_friction_solve(solver, p, NULL, &(rb_friction_solution){r, r + m, NULL}, NULL) !=
            RB_OK)
            return INFINITY;
        least = fmin(least, processor_seconds() - start);
    }
    return least;
}

/* Walls of about so many contacts. */
static void friction_lemke(void)
{
    static const char *const walls[] = {"boxes 100 0.5 6", "boxes 250 0.5 6", "boxes 500 0.5 6"};
    const char *build = getenv("B") ? getenv("B") : "build";

    printf(
        "\n| FRICTION_LEMKE %d | contacts | lemke | auto | lemke / auto |\n|---|---|---|---|---|\n",
        RB_FRICTION_LEMKE_UP_TO);
    for (size_t k = 0; k < sizeof walls / sizeof *walls; k++) {
        char path[] = "/tmp/rollbem-sizes-XXXXXX", command[400];
        rb_friction_problem p;
        rb_message why = {.text = ""};
        const int file = mkstemp(path);
        snprintf(command, sizeof command, "%s/packings %s >%s", build, walls[k], path);
        if (file < 0 || system(command) != 0 || rb_friction_read(path, &p, &why) != RB_OK) {
            fprintf(stderr, "bench_sizes: %s: %s\n", walls[k], why.text);
            exit(70);
        }
        close(file);
        unlink(path);
        double *r = rb_alloc((size_t)(p.dimension * p.contacts), 2);
        const double lemke = friction_seconds("lemke", &p, r),
                     other = friction_seconds("auto", &p, r);
        printf("| %s | %s | %s | %s | %.2g |\n", walls[k], row_count(p.contacts).text,
               row_seconds(lemke).text, row_seconds(other).text, lemke / other);
        fflush(stdout);
        free(r);
        rb_friction_problem_free(&p);
    }
}

/* ---- Threads ----------------------------------------------------------------------------- */

static double lu_seconds(int n, int threads)
{
    double *A = rb_alloc((size_t)n, (size_t)n);
    int *pivot = rb_alloc_int((size_t)n);
    if (!A || !pivot)
        exit(70);
    for (size_t k = 0; k < (size_t)n * (size_t)n; k++)
        A[k] = sin((double)k) + (k % ((size_t)n + 1) == 0 ? n : 0.0);
    rb_blas_threads(threads);
    const double start = rb_seconds();
    LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, A, n, pivot);
    const double spent = rb_seconds() - start;
    rb_blas_threads(1);
    free(pivot);
    free(A);
    return spent;
}

static double transform_seconds(int n, int threads)
{
    fftw_complex *x = fftw_alloc_complex((size_t)n);
    fftw_plan_with_nthreads(threads);
    fftw_plan plan = fftw_plan_dft_1d(n, x, x, FFTW_FORWARD, FFTW_ESTIMATE);
    for (int k = 0; k < n; k++)
        x[k][0] = x[k][1] = sin(k);
    const double start = rb_seconds();
    fftw_execute(plan);
    const double spent = rb_seconds() - start;
    fftw_destroy_plan(plan);
    fftw_free(x);
    return spent;
}

static void print_threads(const char *name, int n, double (*seconds)(int n, int threads))
{
    double t[SIDES] = {INFINITY, INFINITY};

    for (int turn = 0; turn < 3 * TURNS && !(turn > 2 && t[0] > 1.0); turn++)
        for (int side = 0; side < SIDES; side++)
            t[side] = fmin(t[side], seconds(n, 1 + side));
    printf("| %s | %s | %s | %s | %.2g |\n", name, row_count(n).text, row_seconds(t[0]).text,
           row_seconds(t[1]).text, t[0] / t[1]);
    fflush(stdout);
}

static void threads(void)
{
    printf("\n| threads, elapsed | size | one | two | one / two |\n|---|---|---|---|---|\n");
    fftw_init_threads();
    for (int k = -1; k <= 1; k++)
        print_threads("LU_THREADS", (int)(RB_BEM_LU_THREADS_FROM * pow(2.0, k)), lu_seconds);
    for (int k = -1; k <= 1; k++) /* of half the length */
        print_threads("FOURIER_THREADS", (int)(RB_FOURIER_THREADS_FROM / 2 * pow(2.0, k)),
                      transform_seconds);
}

int main(int argc, char **argv)
{
    fast_blas(argv);
    const char *part = argc > 1 ? argv[1] : "";
    if (!*part || strcmp(part, "changes") == 0)
        all_changes();
    if (!*part || strcmp(part, "limits") == 0)
        all_limits();
    if (!*part || strcmp(part, "friction") == 0)
        friction_lemke();
    if (!*part || strcmp(part, "threads") == 0)
        threads();
    return 0;
}
