/* *Kanno* 3.2: half a bar pressed onto an obstacle and pushed from its end. */
#include "fem/fem.h"

static const double length = 400.0, height = 40.0, thickness = 10.0; /* mm */

enum { INCREMENTS = 5 };

static int node_at(int nx, int i, int j)
{
    return i + (nx + 1) * j;
}

/* Consistent nodal loads: half at the two ends of a face. */
static double share(int i, int n)
{
    return i == 0 || i == n ? 0.5 : 1.0;
}

rb_status rb_fem_model_bar(int nx, int ny, rb_fem_model *model, rb_message *why)
{
    const rb_fem_material material = {.young = 5.0, .poisson = 0.48, .section = thickness};
    *model = (rb_fem_model){0};
    if (nx < 1 || ny < 1 || nx > 2000 || ny > 2000)
        return rb_fail(why, RB_EINVAL, "bar: %d x %d elements", nx, ny);
    rb_status s = rb_fem_model_alloc(RB_FEM_QUAD, (nx + 1) * (ny + 1), nx * ny, nx + 1, model);
    if (s == RB_OK) {
        for (int j = 0; j <= ny; j++)
            for (int i = 0; i <= nx; i++) {
                model->mesh.x[2 * node_at(nx, i, j)] = length * i / nx;
                model->mesh.x[2 * node_at(nx, i, j) + 1] = height * j / ny;
            }
        for (int j = 0; j < ny; j++)
            for (int i = 0; i < nx; i++) {
                int *corner = model->mesh.node + 4 * (i + nx * j);
                corner[0] = node_at(nx, i, j);
                corner[1] = node_at(nx, i + 1, j);
                corner[2] = node_at(nx, i + 1, j + 1);
                corner[3] = node_at(nx, i, j + 1);
            }
        for (int j = 0; j <= ny; j++) /* the plane of symmetry */
            rb_fem_mesh_hold(&model->mesh, node_at(nx, 0, j), 0);
        for (int i = 0; i <= nx; i++)
            model->contact_node[i] = node_at(nx, i, 0);
        s = rb_fem_model_build(model, &material, RB_FEM_BAR_MU, INCREMENTS, why);
    }
    if (s == RB_OK) {
        const double top = RB_FEM_BAR_PRESSURE * thickness * length / nx;
        const double right = RB_FEM_BAR_PRESSURE * thickness * height / ny;
        for (int k = 0; k < INCREMENTS; k++) {
            for (int i = 0; i <= nx; i++)
                rb_fem_model_load(model, k, node_at(nx, i, ny), 1, -top * share(i, nx));
            for (int j = 0; j <= ny; j++)
                rb_fem_model_load(model, k, node_at(nx, nx, j), 0, -(k + 1) * right * share(j, ny));
        }
    } else
        rb_fem_model_free(model);
    return s;
}
