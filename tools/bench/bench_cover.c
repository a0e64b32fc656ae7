/* A covered roll in steady rolling (examples/roll/case.ini, half of what friction
 * carries) by boundary elements and by waves around the circumference, against a
 * half-plane under the same elements: processor time of a whole solution, the least of
 * three. Arguments: elements; those above 960 by waves only (default 60 240 960 6400). */
#include "fast_blas.h"
#include "rolling/rolling.h"
#include "rows.h"

#include <stdlib.h>

typedef enum { BY_ELEMENTS, BY_WAVES, HALFPLANE } way;

static rb_rolling_case roll(int n, rb_rolling_mesh_kind mesh, way how)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.formulation = RB_STEADY;
    rc.a.support = how == HALFPLANE ? RB_BEM_HALFPLANE : RB_BEM_HUB;
    rc.a.radius = 150.0;
    rc.a.young = 8.0;
    rc.a.poisson = 0.48;
    if (how != HALFPLANE) {
        rc.a.cover = 12.0;
        rc.a.core_young = 210000.0;
        rc.a.core_poisson = 0.3;
        rc.a.hub_ratio = 0.6;
    }
    rc.elastic_b = 1;
    rc.b.support = RB_BEM_HALFPLANE;
    rc.b.radius = 100.0;
    rc.b.young = 210000.0;
    rc.b.poisson = 0.3;
    rc.mu = 0.25;
    rc.load = 25.0;
    rc.force_ratio = -0.5;
    rc.contact_elements = n;
    rc.mesh = mesh;
    rc.near_field = how == BY_ELEMENTS ? RB_NEAR_FIELD_EXACT : RB_NEAR_FIELD_AUTO;
    return rc;
}

static double seconds(int n, rb_rolling_mesh_kind mesh, way how, double *creepage)
{
    const rb_rolling_case rc = roll(n, mesh, how);
    double least = INFINITY;

    for (int k = 0; k < 3; k++) {
        rb_rolling_solution s = {0};
        rb_message why = {.text = ""};
        const double start = processor_seconds();
        if (rb_rolling_solve(&rc, &s, &why) != RB_OK) {
            fprintf(stderr, "bench_cover: %s\n", why.text);
            exit(70);
        }
        least = fmin(least, processor_seconds() - start);
        *creepage = s.creepage;
        rb_rolling_solution_free(&s);
        if (least > 5.0)
            break;
    }
    return least;
}

int main(int argc, char **argv)
{
    static const int usual[] = {60, 240, 960, 6400};
    static const struct {
        rb_rolling_mesh_kind mesh;
        const char *name;
    } meshes[] = {
        {RB_MESH_UNIFORM, "equal"}, {RB_MESH_ALIGNED, "aligned"}, {RB_MESH_FITTED, "fitted"}};
    const int count = argc > 1 ? argc - 1 : 4;

    fast_blas(argv);
    printf("| elements | mesh | boundary elements | waves | half-plane | waves / "
           "half-plane | elements / waves | creepage by elements | by waves |\n"
           "|---|---|---|---|---|---|---|---|---|\n");
    for (int k = 0; k < count; k++)
        for (int m = 0; m < 3; m++) {
            const int n = argc > 1 ? atoi(argv[k + 1]) : usual[k];
            double creepage[3] = {NAN, NAN, NAN}, spent[3] = {NAN, NAN, NAN};
            for (int how = n > 960 ? BY_WAVES : BY_ELEMENTS; how <= HALFPLANE; how++)
                spent[how] = seconds(n, meshes[m].mesh, (way)how, &creepage[how]);
            printf("| %s | %s | ", row_count(n).text, meshes[m].name);
            if (n > 960)
                printf("| %s | %s | %.1f | | | %.6f |\n", row_seconds(spent[BY_WAVES]).text,
                       row_seconds(spent[HALFPLANE]).text, spent[BY_WAVES] / spent[HALFPLANE],
                       creepage[BY_WAVES]);
            else
                printf("%s | %s | %s | %.1f | %.1f | %.6f | %.6f |\n",
                       row_seconds(spent[BY_ELEMENTS]).text, row_seconds(spent[BY_WAVES]).text,
                       row_seconds(spent[HALFPLANE]).text, spent[BY_WAVES] / spent[HALFPLANE],
                       spent[BY_ELEMENTS] / spent[BY_WAVES], creepage[BY_ELEMENTS],
                       creepage[BY_WAVES]);
            fflush(stdout);
        }
    return 0;
}
