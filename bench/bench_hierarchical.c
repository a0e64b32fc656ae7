/* A wheel on a hub, from the mesh to the flexibility of 40 contact elements: hierarchical
 * matrices against the dense matrix on the same mesh (an incompressible body, for which
 * the library keeps the dense one), and how they grow. Arguments: elements up to which
 * the dense one is timed (default 4000), and the most elements (default 64000). */
#include "fast_blas.h"
#include "rollbem/bem.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>

enum { CONTACT = 40 };

static void stop(const rb_message *why)
{
    fprintf(stderr, "bench_hierarchical: %s\n", why->text);
    exit(70);
}

/* Contact elements of 1/n of the circumference, so that no others are smaller. */
static rb_bem_mesh wheel(int n)
{
    const rb_bem_cylinder cylinder = {.radius = 50.0,
                                      .support = RB_BEM_HUB,
                                      .hub_ratio = 0.3,
                                      .outer_elements = 3 * n / 4};
    double ends[CONTACT + 2];
    rb_bem_mesh mesh;
    rb_message why;
    for (int i = 0; i < CONTACT + 2; i++)
        ends[i] = (i - CONTACT / 2) * 300.0 / n;
    if (rb_bem_mesh_cylinder(&cylinder, CONTACT, ends, &mesh, &why) != RB_OK)
        stop(&why);
    return mesh;
}

static double seconds(const rb_bem_mesh *mesh, double poisson)
{
    const rb_bem_material material = {82000.0, poisson};
    rb_bem_system *system;
    rb_bem_flexibility f;
    rb_message why;
    const double start = rb_seconds();

    if (rb_bem_system_create(mesh, material, &system, &why) != RB_OK ||
        rb_bem_condense(system, RB_BEM_NORMALS_OBSTACLE, &f, &why) != RB_OK)
        stop(&why);
    const double spent = rb_seconds() - start;
    rb_bem_flexibility_free(&f);
    rb_bem_system_free(system);
    return spent;
}

static double peak_megabytes(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024.0;
}

int main(int argc, char **argv)
{
    fast_blas(argv);
    const int dense_to = argc > 1 ? atoi(argv[1]) : 4000;
    const int most = argc > 2 ? atoi(argv[2]) : 64000;
    double spent[16];
    int elements[16], count = 0;

    /* small first: the peak is that of the hierarchical runs as long as nothing is dense
     */
    for (int n = 4000; n <= most && count < 16; n *= 2, count++) {
        rb_bem_mesh mesh = wheel(n);
        elements[count] = mesh.n;
        spent[count] = seconds(&mesh, 0.28);
        printf("%6d elements: hierarchical %.2f s, peak memory so far %.0f MB\n", mesh.n,
               spent[count], peak_megabytes());
        fflush(stdout);
        rb_bem_mesh_free(&mesh);
    }
    for (int k = 0; k < count && 4000 << k <= dense_to; k++) {
        rb_bem_mesh mesh = wheel(4000 << k);
        const double dense = seconds(&mesh, 0.5);
        printf("%6d elements: dense %.2f s, hierarchical %.2f s: %.0f times faster\n",
               elements[k], dense, spent[k], dense / spent[k]);
        rb_bem_mesh_free(&mesh);
    }
    return 0;
}
