/* One solution by Fourier transforms whose plans are kept from the case before, and the same where
 * they were pushed out by those of other lengths: processor time, medians, in turns. */
#include "bem/products/fourier.h"
#include "fast_blas.h"
#include "rolling/rolling.h"
#include "rows.h"

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics.h>
#include <stdlib.h>

enum { TIMES = 41, OTHERS = 16 };

static const struct {
    const char *name;
    int n, elastic_b;
    rb_rolling_mesh_kind mesh;
} rows[] = {{"similar, equal", 200, 1, RB_MESH_UNIFORM},
            {"similar, equal", 1600, 1, RB_MESH_UNIFORM},
            {"similar, aligned", 200, 1, RB_MESH_ALIGNED},
            {"similar, aligned", 1600, 1, RB_MESH_ALIGNED},
            {"rigid plane, equal", 200, 0, RB_MESH_UNIFORM},
            {"rigid plane, equal", 1600, 0, RB_MESH_UNIFORM}};

static void push_out(void)
{
    for (int k = 0; k < OTHERS; k++) {
        rb_fourier f;
        if (!rb_fourier_make((1 << 9) + 60 * k, &f) ||
            (rb_fourier_free(&f), !rb_fourier_make((1 << 14) + 1000 * k, &f)))
            exit(70);
        rb_fourier_free(&f);
    }
}

static double solve(int row)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rb_rolling_solution s;

    rc.a.support = RB_BEM_HALFPLANE;
    rc.formulation = RB_STEADY;
    rc.gap = RB_GAP_PARABOLA;
    rc.half_width = 1.0;
    rc.creep_ratio = 0.4;
    rc.contact_elements = rows[row].n;
    rc.mesh = rows[row].mesh;
    rc.slip_operator = rc.mesh == RB_MESH_ALIGNED ? RB_SLIP_SECOND : RB_SLIP_UPSTREAM;
    if (rows[row].elastic_b) {
        rc.elastic_b = 1;
        rc.b = rc.a;
        rc.b.radius = INFINITY;
    }
    const double start = processor_seconds();
    if (rb_rolling_solve(&rc, &s, NULL) != RB_OK)
        exit(70);
    const double seconds = processor_seconds() - start;
    rb_rolling_solution_free(&s);
    return seconds;
}

int main(int argc, char **argv)
{
    double kept[TIMES], anew[TIMES];

    (void)argc;
    fast_blas(argv);
    printf("| | elements | plans kept | made anew | ratio |\n|---|---|---|---|---|\n");
    for (int row = 0; row < (int)(sizeof rows / sizeof *rows); row++) {
        solve(row);
        for (int k = 0; k < TIMES; k++) {
            push_out();
            anew[k] = solve(row);
            kept[k] = solve(row);
        }
        gsl_sort(kept, 1, TIMES);
        gsl_sort(anew, 1, TIMES);
        const double a = gsl_stats_median_from_sorted_data(kept, 1, TIMES),
                     b = gsl_stats_median_from_sorted_data(anew, 1, TIMES);
        printf("| %s | %s | %s | %s | %.2f |\n", rows[row].name, row_count(rows[row].n).text,
               row_seconds(a).text, row_seconds(b).text, b / a);
    }
    return 0;
}
