/* What all derivatives of a case cost against its solve: 200 fitted elements across a
 * contact of half-planes. */
#include "base/blas.h"
#include "analysis/sensitivity/derivatives.h"
#include "rolling/case/case.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* Of the processor: other programs do not count. */
static double seconds(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

static int measure(const char *name, const char *young_b)
{
    static const char *const words[][2] = {{"support", "halfplane"},    {"load", "500"},
                                           {"formulation", "steady"},   {"mesh", "fitted"},
                                           {"contact-elements", "200"}, {"creep-ratio", "0.5"}};
    double solve = 1e30, derive = 1e30;
    int inputs = 0;
    rb_message why = {.text = ""};

    for (int round = 0; round < 5; round++) {
        rb_case *c = rb_case_create(RB_CASE_SINGLE);
        rb_case_result r;
        rb_case_derivatives all;
        if (!c)
            return 1;
        for (size_t k = 0; k < sizeof words / sizeof *words; k++)
            rb_case_set(c, words[k][0], words[k][1], RB_GIVEN_ARGUMENT, &why);
        rb_case_set(c, young_b ? "young-b" : "similar", young_b ? young_b : "yes",
                    RB_GIVEN_ARGUMENT, &why);
        rb_status s = rb_case_resolve(c, &why);
        const double start = seconds();
        if (s == RB_OK)
            s = rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &why);
        const double middle = seconds();
        if (s == RB_OK)
            s = rb_case_differentiate(c, &r.model, 0, NULL, &all, &why);
        const double end = seconds();
        if (s != RB_OK) {
            fprintf(stderr, "bench_derivatives: %s\n", why.text);
            return 1;
        }
        solve = middle - start < solve ? middle - start : solve;
        derive = end - middle < derive ? end - middle : derive;
        inputs = all.n;
        rb_case_derivatives_free(&all);
        rb_case_result_free(&r);
        rb_case_free(c);
    }
    printf("%s\t%d\t%.4f\t%.4f\t%.2f\n", name, inputs, solve, derive, derive / solve);
    return 0;
}

int main(void)
{
    rb_blas_threads(1); /* as the program does for so few elements */
    puts("bodies\tinputs\tsolve_s\tderivatives_s\tratio");
    return measure("similar", NULL) || measure("unlike", "70000");
}
