/* *Kanno* 3.1: a double-layer grid of bars on an obstacle, loaded once, unloaded slowly. */
#include "fem/fem.h"

static const double spacing[3] = {2000.0, 3000.0, 2000.0}; /* mm */
static const double gamma_of[] = {5.0, 4.05, 3.1, 2.15, 1.2, 0.25};

enum { INCREMENTS = sizeof gamma_of / sizeof gamma_of[0] };

/* n x n lower nodes come first, then m x m upper ones. */
typedef struct {
    int n, m;
} grid;

static void place_layer(int n, int first, double z, rb_fem_mesh *mesh)
{
    for (int k = 0; k < n * n; k++) {
        double *x = mesh->x + 3 * (first + k);
        x[0] = (k % n - 0.5 * (n - 1)) * spacing[0];
        x[1] = (k / n - 0.5 * (n - 1)) * spacing[1];
        x[2] = z;
    }
}

static int *join(int *bar, int a, int b)
{
    bar[0] = a;
    bar[1] = b;
    return bar + 2;
}

static int *join_layer(int n, int first, int *bar)
{
    for (int j = 0; j < n; j++)
        for (int i = 0; i + 1 < n; i++) {
            bar = join(bar, first + i + n * j, first + i + 1 + n * j);
            bar = join(bar, first + j + n * i, first + j + n * (i + 1));
        }
    return bar;
}

static double share(int i, int n)
{
    return i == 0 || i == n - 1 ? 0.5 : 1.0;
}

rb_status rb_fem_model_truss(rb_fem_layout layout, int n, rb_fem_model *model, rb_message *why)
{
    const rb_fem_material material = {.young = 205800.0, .section = 10000.0};
    const grid g = {n, layout == RB_FEM_UPPER_INSIDE ? n - 1 : n + 1};
    *model = (rb_fem_model){0};
    if (n < 2 || n > 200)
        return rb_fail(why, RB_EINVAL, "truss: %d contact nodes per side", n);
    const int inclined = g.m < g.n ? g.m * g.m : g.n * g.n;
    rb_status s = rb_fem_model_alloc(RB_FEM_BAR, n * n + g.m * g.m,
                                     (2 * g.n * (g.n - 1) + 2 * g.m * (g.m - 1) + 4 * inclined),
                                     n * n, model);
    if (s == RB_OK) {
        place_layer(n, 0, 0.0, &model->mesh);
        place_layer(g.m, n * n, spacing[2], &model->mesh);
        /* Every upper node to the lower ones half a cell away. */
        int *bar = join_layer(g.m, n * n, join_layer(n, 0, model->mesh.node));
        const int shift = g.m < g.n ? 0 : -1; /* lower neighbours of upper i: i + shift, + 1 */
        for (int k = 0; k < 4 * g.m * g.m; k++) {
            const int upper = k / 4, i = upper % g.m + shift + k % 2;
            const int j = upper / g.m + shift + k / 2 % 2;
            if (i >= 0 && j >= 0 && i < g.n && j < g.n)
                bar = join(bar, g.n * g.n + upper, i + g.n * j);
        }
        for (int k = 0; k < n * n; k++)
            model->contact_node[k] = k;
        s = rb_fem_model_build(model, &material, RB_FEM_TRUSS_MU, INCREMENTS, why);
    }
    if (s == RB_OK) {
        for (int step = 0; step < INCREMENTS; step++)
            for (int j = 0; j < g.m; j++)
                for (int i = 0; i < g.m; i++)
                    rb_fem_model_load(model, step, g.n * g.n + i + g.m * j, 2,
                                      -gamma_of[step] * RB_FEM_TRUSS_LOAD * share(i, g.m) *
                                          share(j, g.m));
    } else
        rb_fem_model_free(model);
    return s;
}
