/* A wheel on a hub, from the mesh to the flexibility of 40 contact elements: hierarchical
 * matrix against dense LU on the same mesh, how it grows, and what both leave of the
 * flexibility.  Arguments: elements up to which the dense one is timed (default 4000),
 * the most elements (default 64000), processors for both (default: all). */
#define _DEFAULT_SOURCE /* wait4 */
#include "bem/system.h"
#include "fast_blas.h"
#include "rows.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef _OPENMP
#include <omp.h>
#endif

enum { CONTACT = 40, SIZE = 2 * (CONTACT + 1) * 2 * CONTACT };

static const rb_bem_material steel = {82000.0, 0.28};

typedef struct {
    double seconds;   /* of all processors together */
    double megabytes; /* peak of its process */
    double F[SIZE];
} result;

static void stop(const rb_message *why)
{
    fprintf(stderr, "bench_hierarchical: %s\n", why->text);
    exit(70);
}

/* Contact elements of 1/n of the circumference, so that no others are smaller. */
static rb_bem_mesh wheel(int n)
{
    const rb_bem_cylinder cylinder = {
        .radius = 50.0, .support = RB_BEM_HUB, .hub_ratio = 0.3, .outer_elements = 3 * n / 4};
    double ends[CONTACT + 2];
    rb_bem_mesh mesh;
    rb_message why;
    for (int i = 0; i < CONTACT + 2; i++)
        ends[i] = (i - CONTACT / 2) * 300.0 / n;
    if (rb_bem_mesh_cylinder(&cylinder, CONTACT, ends, &mesh, &why) != RB_OK)
        stop(&why);
    return mesh;
}

static void condense_wheel(int n, int dense, result *r)
{
    rb_bem_mesh mesh = wheel(n);
    rb_bem_system *system;
    rb_bem_flexibility f;
    rb_message why;

    if (rb_bem_system_create_as(&mesh, steel, dense, &system, &why) != RB_OK ||
        rb_bem_condense(system, RB_BEM_NORMALS_OBSTACLE, &f, &why) != RB_OK)
        stop(&why);
    rb_bem_flexibility_matrix(&f, r->F, 2 * (CONTACT + 1));
    rb_bem_flexibility_free(&f);
    rb_bem_system_free(system);
    rb_bem_mesh_free(&mesh);
}

/* In a process of its own, whose memory is counted alone. */
static void run(int n, int dense, result *r)
{
    int ends[2], status;
    struct rusage usage;
    if (pipe(ends) != 0)
        exit(70);
    const pid_t child = fork();
    if (child == 0) {
        condense_wheel(n, dense, r);
        _exit(write(ends[1], r, sizeof *r) == (ssize_t)sizeof *r ? 0 : 70);
    }
    close(ends[1]); /* else a child that dies is waited for in vain */
    FILE *from = fdopen(ends[0], "r");
    if (child < 0 || !from || fread(r, sizeof *r, 1, from) != 1 ||
        wait4(child, &status, 0, &usage) != child || status != 0)
        exit(70);
    fclose(from);
    r->megabytes = (double)usage.ru_maxrss / 1024.0;
    r->seconds = (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                 1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

static double difference(const result *a, const result *b)
{
    double most = 0.0, scale = 0.0;
    for (int i = 0; i < SIZE; i++) {
        most = fmax(most, fabs(a->F[i] - b->F[i]));
        scale = fmax(scale, fabs(b->F[i]));
    }
    return most / scale;
}

int main(int argc, char **argv)
{
    fast_blas(argv);
    const int dense_to = argc > 1 ? atoi(argv[1]) : 4000;
    const int most = argc > 2 ? atoi(argv[2]) : 64000;
    const int threads = argc > 3 ? atoi(argv[3]) : 0;
    static result h, dense;

    rb_blas_threads(threads);
#ifdef _OPENMP
    if (threads)
        omp_set_num_threads(threads);
    printf("%d processors for both\n\n", omp_get_max_threads());
#endif
    printf("| elements | dense | hierarchical | ratio | difference of F | "
           "memory: hierarchical, dense |\n|---|---|---|---|---|---|\n");
    for (int n = 4000; n <= most; n *= 2) {
        rb_bem_mesh mesh = wheel(n);
        run(n, 0, &h);
        printf("| %s | ", row_count(mesh.n).text);
        rb_bem_mesh_free(&mesh);
        if (n <= dense_to) {
            run(n, 1, &dense);
            printf("%s | %s | %.0f | %s | %.0f MB, %.0f MB |\n", row_seconds(dense.seconds).text,
                   row_seconds(h.seconds).text, dense.seconds / h.seconds,
                   row_power(1, difference(&h, &dense)).text, h.megabytes, dense.megabytes);
        } else {
            printf("| %s | | | %.0f MB |\n", row_seconds(h.seconds).text, h.megabytes);
        }
        fflush(stdout);
    }
    return 0;
}
