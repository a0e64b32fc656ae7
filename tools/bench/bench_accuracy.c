/* What elements are worth on the mesh that the program chooses.  First: errors as their number is
 * doubled, which are not to grow, beside equal elements.  Then: what --accuracy costs beside the
 * cheapest number of elements whose error bars are within it.  Processor times of one run.
 * Arguments: growth or accuracy, and a part of the name of the cases. */
#include "fast_blas.h"
#include "rows.h"
#include "words.h"

#include <gsl/gsl_math.h>

static const char *wanted = "";

/* ---- Errors of n and of 2n elements ------------------------------------------------------ */

enum { MOST_SIZES = 12 };

static const struct {
    const char *name, *options;
    int n, last; /* doubled up to the last; the errors are against four times as many */
} doubled[] = {
    {"similar, steady", "support halfplane similar yes formulation steady", 25, 6400},
    {"rigid plane, steady", "support halfplane formulation steady", 25, 6400},
    {"unlike, steady", "support halfplane young-b 30000 formulation steady", 25, 6400},
    {"layer, steady", "support halfplane layer-thickness 2 formulation steady", 25, 1600},
    {"relaxing, steady",
     "support halfplane relaxation-time .001 relaxation-ratio 1 speed 1000 formulation steady", 25,
     1600},
    {"interlayer, steady", "support halfplane interlayer-tangential 1e-6 formulation steady", 25,
     1600},
    {"friction falls, steady",
     "support halfplane friction-law exponential mu-fall .1 slip-scale 2 speed 1000 formulation "
     "steady",
     25, 1600},
    {"arc, steady", "support arc formulation steady", 25, 200},
    {"hub, steady", "support hub formulation steady", 25, 200},
    {"cover, steady",
     "support hub radius 100 young 5 poisson .48 cover-thickness 5 gap parabola formulation steady",
     25, 1600},
    {"similar, static", "support halfplane similar yes formulation static", 25, 6400},
    {"rigid plane, static", "support halfplane formulation static", 25, 1600},
    {"hub, static", "support hub formulation static", 25, 200}};

typedef struct {
    double q, p0, a, seconds;
} outcome;

static outcome solve(const char *options, const char *mesh, int n)
{
    outcome o = {0.0, 0.0, 0.0, INFINITY};
    const char *const roll = strstr(options, "static") ? "shift .0005" : "creep-ratio .4";

    for (int k = 0; k < 3 && !(k > 0 && o.seconds > 0.5); k++) {
        rb_message why = {.text = ""};
        rb_case_result r = {0};
        const double start = processor_seconds();
        rb_case *c = case_of_words((const char *const[]){
            "half-width 1", options, roll, word_of("contact-elements", n).text, mesh, NULL});
        if (rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &why) != RB_OK) {
            fprintf(stderr, "%s, %d elements: %s\n", options, n, why.text);
            exit(70);
        }
        o = (outcome){r.solution.force_ratio, r.solution.max_pressure, r.solution.half_width,
                      fmin(o.seconds, processor_seconds() - start)};
        rb_case_result_free(&r);
        rb_case_free(c);
    }
    return o;
}

/* The largest error of 2n over that of n, where that of 2n is above 1e-6. */
static void growth(int sizes, const double *error, double *most)
{
    for (int k = 0; k + 1 < sizes; k++)
        if (error[k + 1] > 1e-6)
            *most = fmax(*most, error[k + 1] / error[k]);
}

static void errors_by_elements(void)
{
    printf(
        "| | elements | error of Q/(mu P) | largest error(2n)/error(n): Q/(mu P), p0, a | time / "
        "equal |\n|---|---|---|---|---|\n");
    for (size_t row = 0; row < sizeof doubled / sizeof *doubled; row++) {
        if (!strstr(doubled[row].name, wanted))
            continue;
        const char *options = doubled[row].options;
        const outcome fine = solve(options, "", 4 * doubled[row].last);
        double q[MOST_SIZES], p0[MOST_SIZES], a[MOST_SIZES], most[3] = {0.0, 0.0, 0.0}, last = 0.0;
        int sizes = 0;
        for (int n = doubled[row].n; n <= doubled[row].last; n *= 2) {
            const outcome o = solve(options, "", n);
            q[sizes] = fabs(o.q - fine.q);
            p0[sizes] = fabs(o.p0 / fine.p0 - 1.0);
            a[sizes++] = fabs(o.a / fine.a - 1.0);
            last = o.seconds;
        }
        growth(sizes, q, &most[0]);
        growth(sizes, p0, &most[1]);
        growth(sizes, a, &most[2]);
        printf("| %s | %s, %s | %s, %s | %.2g, %.2g, %.2g | %.1f |\n", doubled[row].name,
               row_count(doubled[row].n).text, row_count(doubled[row].last).text,
               row_power(1, q[0]).text, row_power(1, q[sizes - 1]).text, most[0], most[1], most[2],
               last / solve(options, "mesh uniform", doubled[row].last).seconds);
        if (getenv("VERBOSE"))
            for (int k = 0; k < sizes; k++)
                printf("#  %d: %.2e %.2e %.2e\n", doubled[row].n << k, q[k], p0[k], a[k]);
        fflush(stdout);
    }
}

/* ---- An accuracy beside the cheapest number of elements that has it ------------------------ */

static const struct {
    const char *name, *options;
    double least; /* the least accuracy that is asked for */
} cases[] = {{"similar", "support halfplane similar yes formulation steady", 1e-6},
             {"rigid plane", "support halfplane formulation steady", 1e-6},
             {"unlike", "support halfplane young-b 30000 formulation steady", 1e-6},
             {"layer", "support halfplane layer-thickness 2 formulation steady", 1e-5},
             {"arc", "support arc formulation steady", 1e-4},
             {"hub", "support hub formulation steady", 1e-4},
             {"similar, static", "support halfplane similar yes formulation static", 1e-3},
             {"rigid plane, static", "support halfplane formulation static", 1e-3}};

/* The largest bar in the units of --accuracy (src/rolling/study/errors.c). */
static double largest_bar(const rb_rolling_case *rc, const rb_rolling_solution *s,
                          const rb_rolling_solution *e)
{
    double worst = fmax(e->normal_load / s->normal_load, e->max_pressure / s->max_pressure);

    worst = fmax(fmax(worst, e->half_width / s->half_width), e->force_ratio);
    return rc->formulation == RB_STATIC ? worst : fmax(worst, e->creepage / fabs(s->creepage));
}

/* Processor seconds of a solution with error bars, or to an accuracy.  within: whether it is
 * reached; NULL: do not look. */
static double seconds_of_bars(const rb_rolling_case *rc, double accuracy, int *within)
{
    rb_rolling_solution s;
    rb_rolling_errors e;
    const double start = processor_seconds();
    const rb_status status = rb_rolling_solve_with_errors(rc, &s, &e, NULL);
    const double spent = processor_seconds() - start;

    *within = status == RB_OK && largest_bar(rc, &s, &e.scalar) <= accuracy;
    rb_rolling_solution_free(&s);
    return spent;
}

static double seconds_to_accuracy(const rb_rolling_case *rc, double accuracy, int *elements)
{
    rb_message why = {.text = ""};
    rb_rolling_solution s;
    rb_rolling_errors e;
    const double start = processor_seconds();
    const rb_status status = rb_rolling_solve_to_accuracy(rc, accuracy, &s, &e, elements, &why);
    const double spent = processor_seconds() - start;

    if (status != RB_OK)
        printf("%s\n", why.text);
    rb_rolling_solution_free(&s);
    return status == RB_OK ? spent : INFINITY;
}

/* The cheapest of 12 and more elements, up to those that --accuracy took, on the mesh of
 * so many elements and on that of --accuracy. */
static double cheapest_of(const char *options, const char *roll, double accuracy, int most,
                          const rb_rolling_case *asked, rb_rolling_case *best)
{
    double least = INFINITY;

    for (double x = 12.0, n = 12.0; n < most; x *= M_SQRT2) {
        n = fmin(floor(x), most);
        rb_case *c =
            case_of_words((const char *const[]){"half-width 1 error yes", options, roll,
                                                word_of("contact-elements", (int)n).text, NULL});
        rb_rolling_case rc = rb_case_resolved(c)->rc;
        const int other = rc.mesh != asked->mesh;
        for (int k = 0; k <= other; k++) {
            int within;
            rc.outer_refinement = asked->outer_refinement;
            rc.mesh = k ? asked->mesh : rc.mesh;
            rc.slip_operator = k ? asked->slip_operator : rc.slip_operator;
            const double spent = seconds_of_bars(&rc, accuracy, &within);
            if (within && spent < least) {
                least = spent;
                *best = rc;
            }
        }
        rb_case_free(c); /* files are none, so that rc borrows nothing */
    }
    return least;
}

static void accuracy_row(const char *name, const char *options, double accuracy)
{
    const char *const roll = strstr(options, "static") ? "shift .0005" : "creep-ratio .4";
    char word[40];
    snprintf(word, sizeof word, "accuracy %g", accuracy);
    rb_case *c = case_of_words((const char *const[]){"half-width 1", options, roll, word, NULL});
    const rb_rolling_case *asked = &rb_case_resolved(c)->rc;
    rb_rolling_case best = *asked;
    int elements = 0, within;
    double spent = seconds_to_accuracy(asked, accuracy, &elements);
    double least =
        isfinite(spent) ? cheapest_of(options, roll, accuracy, elements, asked, &best) : NAN;

    for (int turn = 0; turn < 4 && spent < 1.0; turn++) {
        spent = fmin(spent, seconds_to_accuracy(asked, accuracy, &elements));
        least = fmin(least, seconds_of_bars(&best, accuracy, &within));
    }
    printf("| %s | %.0e | %s | %s | %.1f |\n", name, accuracy, row_count(elements).text,
           row_count(best.contact_elements).text, spent / least);
    fflush(stdout);
    rb_case_free(c);
}

static void accuracies(void)
{
    printf("| | accuracy | elements | cheapest | time / cheapest |\n|---|---|---|---|---|\n");
    for (size_t row = 0; row < sizeof cases / sizeof *cases; row++)
        for (double x = 1e-2; strstr(cases[row].name, wanted) && x > 0.9 * cases[row].least;
             x *= 0.1)
            accuracy_row(cases[row].name, cases[row].options, x);
}

int main(int argc, char **argv)
{
    fast_blas(argv);
    wanted = argc > 2 ? argv[2] : "";
    if (argc < 2 || strcmp(argv[1], "growth") == 0)
        errors_by_elements();
    if (argc < 2 || strcmp(argv[1], "accuracy") == 0)
        accuracies();
    return 0;
}
