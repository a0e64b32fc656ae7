/* Condensing beside solving: global problems with a sparse mass, W = H' M^-1 H formed and
 * the local problem solved by `auto` at 1e-8.  Walls and heaps of examples/packings,
 * among them 356 contacts on 12 000 unknowns, of which most belong to bodies that touch
 * nothing. Seconds, the best of several runs; condensing / solving is to be below 1. */
#include "fast_blas.h"
#include "rows.h"
#include "lcp/friction/friction.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *name, *arguments;
} packings[] = {{"98 boxes, 3902 loose bodies", "boxes 98 0.5 4 global 3902"},
                {"300 boxes", "boxes 300 0.7 6 global"},
                {"330 discs", "discs 330 0.5 6 global"},
                {"20 bricks", "bricks 20 0.6 3 global"},
                {"100 bricks", "bricks 100 1 5 global"},
                {"40 spheres", "spheres 40 0.5 4 global"},
                {"360 spheres", "spheres 360 0.7 9 global"}};

static int generate(const char *arguments, rb_friction_problem *p)
{
    const char *build = getenv("B") ? getenv("B") : "build";
    char name[] = "/tmp/rollbem-condense-XXXXXX", command[400];
    rb_message why = {.text = ""};
    const int file = mkstemp(name);
    if (file < 0)
        return 0;
    close(file);
    snprintf(command, sizeof command, "%s/packings %s >%s", build, arguments, name);
    const int made = system(command) == 0 && rb_friction_read(name, p, &why) == RB_OK;
    if (!made)
        printf("%s: %s\n", arguments, why.text);
    unlink(name);
    return made;
}

int main(int argc, char **argv)
{
    (void)argc;
    fast_blas(argv);
    double worst = 0.0;
    printf("| packing | contacts | unknowns | condense | solve | ratio "
           "|\n|---|---|---|---|---|---|\n");
    for (size_t k = 0; k < sizeof packings / sizeof *packings; k++) {
        rb_friction_problem global, local = {0};
        double condense = INFINITY, solve = INFINITY;
        if (!generate(packings[k].arguments, &global))
            return 1;
        const size_t m = (size_t)(global.dimension * global.contacts);
        double *r = rb_alloc(m, 2);
        for (int run = 0; run < 20; run++) {
            double start = processor_seconds();
            rb_friction_problem_free(&local);
            if (rb_friction_condense(&global, &local, NULL) != RB_OK)
                return 1;
            condense = fmin(condense, processor_seconds() - start);
            if (run > 2 && solve > 0.1)
                continue;
            start = processor_seconds();
            if (rb_friction_solve("auto", &local, NULL, &(rb_friction_solution){r, r + m, NULL},
                                  NULL) != RB_OK)
                return 1;
            solve = fmin(solve, processor_seconds() - start);
        }
        printf("| %s | %d | %d | %s | %s | %.2g |\n", packings[k].name, global.contacts,
               global.dofs, row_seconds(condense).text, row_seconds(solve).text, condense / solve);
        fflush(stdout);
        worst = fmax(worst, condense / solve);
        free(r);
        rb_friction_problem_free(&local);
        rb_friction_problem_free(&global);
    }
    printf("condensing / solving, the largest: %.2f\n", worst);
    return 0;
}
