/* Coverage of the intervals and time of a fit: sixty sets of 24 points with noise, 40
 * elements, a falling law, a third body and an offset of creepage (docs/derivatives.md).
 * bench_fit [SETS [SEED [ELEMENTS [MEMORY]]]]: the memory of friction in mm. */
#include "base/blas.h"
#include "analysis/fit/fit_case.h"
#include "rolling/case/case.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { POINTS = 24, NUMBERS = 5 };
static const char *const names[NUMBERS] = {"mu", "mu-fall", "slip-scale", "interlayer-tangential",
                                           "creep-offset"};
static const double truth[NUMBERS] = {0.24, 0.16, 1.5, 0.1, 2e-5}, NOISE = 0.004;
static const char *elements = "40", *memory;
static rb_message why;

static void must(rb_status s)
{
    if (s == RB_OK)
        return;
    fprintf(stderr, "bench_fit: %s\n", why.text);
    exit(1);
}

static rb_case *new_case(rb_case_purpose purpose)
{
    static const char *const words[][2] = {{"support", "halfplane"},
                                           {"similar", "yes"},
                                           {"half-width", "1"},
                                           {"radius", "500"},
                                           {"poisson", "0.3"},
                                           {"young", "1.82"},
                                           {"gap", "parabola"},
                                           {"mesh", "uniform"},
                                           {"formulation", "steady"},
                                           {"speed", "1000"},
                                           {"friction-law", "exponential"}};
    rb_case *c = rb_case_create(purpose);
    for (size_t k = 0; c && k < sizeof words / sizeof *words; k++)
        must(rb_case_set(c, words[k][0], words[k][1], RB_GIVEN_ARGUMENT, &why));
    must(rb_case_set(c, "contact-elements", elements, RB_GIVEN_ARGUMENT, &why));
    if (memory)
        must(rb_case_set(c, "memory", memory, RB_GIVEN_ARGUMENT, &why));
    return c;
}

static double force_at(double creep)
{
    rb_case *c = new_case(RB_CASE_SINGLE);
    rb_case_result r;
    for (int j = 0; j < NUMBERS - 1; j++)
        must(rb_case_set_number(c, names[j], truth[j], &why));
    must(rb_case_set_number(c, "creep", creep, &why));
    must(rb_case_resolve(c, &why));
    must(rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &why));
    const double f = r.solution.tangential_load / r.solution.normal_load;
    rb_case_result_free(&r);
    rb_case_free(c);
    return f;
}

static unsigned long long state = 88172645463325252ULL;

/* Box and Muller on a generator that is the same everywhere. */
static double normal(void)
{
    double u[2];
    for (int k = 0; k < 2; k++) {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        u[k] = ((double)(state >> 11) + 0.5) / 9007199254740992.0;
    }
    return sqrt(-2.0 * log(u[0])) * cos(6.283185307179586 * u[1]);
}

int main(int argc, char **argv)
{
    const int sets = argc > 1 ? atoi(argv[1]) : 60;
    double creep[POINTS], exact[POINTS], force[POINTS], least = INFINITY, all = 0.0;
    int covered[NUMBERS] = {0}, fitted = 0, steps = 0;
    elements = argc > 3 ? argv[3] : elements;
    memory = argc > 4 ? argv[4] : NULL;
    rb_blas_threads(1);
    if (argc > 2)
        state ^= strtoull(argv[2], NULL, 10) * 0x9E3779B97F4A7C15ULL;
    for (int k = 0; argc > 2 && k < 100; k++) /* the first numbers follow the seed closely */
        normal();
    for (int k = 0; k < POINTS; k++) {
        creep[k] = 1e-3 * (k < 12 ? -0.05 * (k + 1) : -0.7 - 5.3 * (k - 12) / 11.0);
        exact[k] = force_at(creep[k] + truth[NUMBERS - 1]);
    }
    for (int set = 0; set < sets; set++) {
        const rb_case_data data = {POINTS, 0,   RB_CASE_FORCE_OVER_LOAD, creep, force, NULL, NULL,
                                   NULL,   NULL};
        rb_case_fit fit = {.n = NUMBERS, .level = 0.95};
        rb_case *c = new_case(RB_CASE_CURVE);
        for (int k = 0; k < POINTS; k++)
            force[k] = exact[k] + NOISE * normal();
        for (int j = 0; j < NUMBERS; j++) {
            snprintf(fit.parameter[j].name, sizeof fit.parameter[j].name, "%s", names[j]);
            fit.parameter[j].start = NAN;
            fit.parameter[j].low = -INFINITY;
            fit.parameter[j].high = INFINITY;
        }
        must(rb_case_prepare_fit(c, &data, &fit, &why));
        must(rb_case_resolve(c, &why));
        const clock_t start = clock();
        const rb_status s = rb_case_fit_solve(c, &data, NULL, &fit, &why);
        const double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
        if (s == RB_OK) {
            fitted++;
            steps += fit.iterations;
            all += seconds;
            least = fmin(least, seconds);
            for (int j = 0; j < NUMBERS; j++)
                covered[j] += fit.parameter[j].interval[0] <= truth[j] &&
                              truth[j] <= fit.parameter[j].interval[1];
        } else {
            printf("# set %d: %s\n", set + 1, why.text);
        }
        rb_case_fit_free(&fit);
        rb_case_free(c);
    }
    printf("%d of %d sets fitted; %.1f steps, %.4f s a fit, least %.4f s\n", fitted, sets,
           (double)steps / fitted, all / fitted, least);
    for (int j = 0; j < NUMBERS; j++)
        printf("%s\tcovered %.3f\n", names[j], (double)covered[j] / fitted);
    return fitted == sets ? 0 : 1;
}
