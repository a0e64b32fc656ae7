/* A creep curve of 1000 creepages at 100 elements (half-planes, similar and dissimilar
 * bodies) against as many separate solutions, of which every tenth is timed. */
#include "fast_blas.h"
#include "rows.h"
#include "rolling/rolling.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { POINTS = 1000, SAMPLES = 100, REPEATS = 3 };

static rb_rolling_case steady(int similar, rb_rolling_mesh_kind mesh)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a = (rb_rolling_body){
        .young = 210000.0, .poisson = 0.28, .radius = 500.0, .support = RB_BEM_HALFPLANE};
    rc.b = rc.a;
    rc.b.radius = INFINITY;
    rc.elastic_b = similar;
    rc.formulation = RB_STEADY;
    rc.half_width = 1.0;
    rc.contact_elements = 100;
    rc.mesh = mesh;
    return rc;
}

static void stop(const rb_message *why)
{
    fprintf(stderr, "bench_curve: %s\n", why->text);
    exit(70);
}

static double curve_seconds(const rb_rolling_case *rc, double *force)
{
    double best = INFINITY;
    for (int k = 0; k < REPEATS; k++) {
        rb_rolling_curve curve;
        rb_message why;
        const double start = processor_seconds();
        if (rb_rolling_curve_solve(rc, &(rb_rolling_range){0, 0.0015, 1.5, POINTS, RB_UNITS_MM},
                                   &curve, &why) != RB_OK)
            stop(&why);
        best = fmin(best, processor_seconds() - start);
        for (int i = 0; i < SAMPLES; i++)
            force[i] = curve.force_ratio[i * (POINTS / SAMPLES)];
        rb_rolling_curve_free(&curve);
    }
    return best;
}

static double separate_seconds(const rb_rolling_case *rc, const double *force, double *difference)
{
    const double start = processor_seconds();
    *difference = 0.0;
    for (int i = 0; i < SAMPLES; i++) {
        rb_rolling_case one = *rc;
        rb_rolling_solution s;
        rb_message why;
        one.creep_ratio = 0.0015 + (1.5 - 0.0015) * i * (POINTS / SAMPLES) / (POINTS - 1);
        if (rb_rolling_solve(&one, &s, &why) != RB_OK)
            stop(&why);
        *difference = fmax(*difference, fabs(s.force_ratio - force[i]));
        rb_rolling_solution_free(&s);
    }
    return (processor_seconds() - start) * POINTS / SAMPLES;
}

int main(int argc, char **argv)
{
    (void)argc;
    fast_blas(argv);
    printf("%d creepages\n\n| bodies, elements | one curve | separately | ratio | "
           "difference of Q/(mu P) |\n"
           "|---|---|---|---|---|\n",
           POINTS);
    for (int k = 0; k < 4; k++) {
        const int similar = k % 2 == 0, fitted = k / 2;
        const rb_rolling_case rc = steady(similar, fitted ? RB_MESH_FITTED : RB_MESH_UNIFORM);
        double force[SAMPLES], difference;
        const double together = curve_seconds(&rc, force);
        const double apart = separate_seconds(&rc, force, &difference);
        printf("| %s, %s | %s | %s | %.0f | %s |\n", similar ? "similar" : "dissimilar",
               fitted ? "fitted" : "equal", row_seconds(together).text, row_seconds(apart).text,
               apart / together, row_power(1, difference).text);
    }
    return 0;
}
