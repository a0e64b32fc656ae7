/* Meshes of one kind of element, and the assembly of their matrices. */
#include "fem/fem.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

rb_status rb_fem_mesh_alloc(rb_fem_kind kind, int nodes, int elements, rb_fem_mesh *mesh)
{
    static const int corners[] = {2, 4, 8};
    memset(mesh, 0, sizeof *mesh);
    if (nodes < 1 || elements < 0)
        return RB_EINVAL;
    mesh->kind = kind;
    mesh->dimension = kind == RB_FEM_QUAD ? 2 : 3;
    mesh->element_nodes = corners[kind];
    mesh->nodes = nodes;
    mesh->elements = elements;
    mesh->x = rb_alloc((size_t)nodes, (size_t)mesh->dimension);
    mesh->dof = rb_alloc_int((size_t)nodes * (size_t)mesh->dimension);
    mesh->node = rb_alloc_int((size_t)elements * (size_t)mesh->element_nodes);
    if (mesh->x && mesh->dof && mesh->node) {
        rb_fem_mesh_number(mesh);
        return RB_OK;
    }
    rb_fem_mesh_free(mesh);
    return RB_ENOMEM;
}

void rb_fem_mesh_free(rb_fem_mesh *mesh)
{
    if (!mesh)
        return;
    free(mesh->x);
    free(mesh->dof);
    free(mesh->node);
    memset(mesh, 0, sizeof *mesh);
}

void rb_fem_mesh_hold(rb_fem_mesh *mesh, int node, int direction)
{
    mesh->dof[mesh->dimension * node + direction] = -1;
}

void rb_fem_mesh_number(rb_fem_mesh *mesh)
{
    mesh->dofs = 0;
    for (int i = 0; i < mesh->dimension * mesh->nodes; i++)
        if (mesh->dof[i] >= 0)
            mesh->dof[i] = mesh->dofs++;
}

typedef rb_status element_matrix(const double *x, const rb_fem_material *m, double *A);

static rb_status assemble(const rb_fem_mesh *mesh, const rb_fem_material *material,
                          element_matrix *matrix, rb_sparse *A, rb_message *why)
{
    const int d = mesh->dimension, corners = mesh->element_nodes, n = d * corners;
    rb_triplets t = {.rows = mesh->dofs, .cols = mesh->dofs};
    rb_status s = RB_OK;
    for (int k = 0; k < corners * mesh->elements; k++)
        if (mesh->node[k] < 0 || mesh->node[k] >= mesh->nodes)
            return rb_fail(why, RB_EINVAL, "element %d: node %d of %d", k / corners, mesh->node[k],
                           mesh->nodes);
    if (mesh->dofs < 1)
        return rb_fail(why, RB_EINVAL, "mesh: every node is held");
    for (int e = 0; e < mesh->elements && s == RB_OK; e++) {
        double x[24], element[576];
        int dof[24];
        for (int k = 0; k < n; k++) {
            const int at = d * mesh->node[corners * e + k / d] + k % d;
            x[k] = mesh->x[at];
            dof[k] = mesh->dof[at];
        }
        if (matrix(x, material, element) != RB_OK)
            s = rb_fail(why, RB_EINVAL, "element %d is degenerate or turned over", e);
        for (int k = 0; k < n * n && s == RB_OK; k++)
            if (dof[k % n] >= 0 && dof[k / n] >= 0)
                rb_triplets_add(&t, dof[k % n], dof[k / n], element[k]);
    }
    if (s == RB_OK)
        s = rb_sparse_from_triplets(&t, A);
    rb_triplets_free(&t);
    return s;
}

rb_status rb_fem_stiffness(const rb_fem_mesh *mesh, const rb_fem_material *material, rb_sparse *K,
                           rb_message *why)
{
    static element_matrix *const matrix[] = {rb_fem_bar_stiffness, rb_fem_quad_stiffness,
                                             rb_fem_brick_stiffness};
    const rb_fem_material *m = material;
    if (!(m->young > 0.0) || !isfinite(m->young))
        return rb_fail(why, RB_EINVAL, "young = %g: expected > 0", m->young);
    if (mesh->kind != RB_FEM_BAR && !(m->poisson > -1.0 && m->poisson < 0.5))
        return rb_fail(why, RB_EINVAL, "poisson = %g: expected in (-1, 0.5)", m->poisson);
    if (mesh->kind != RB_FEM_BRICK && !(m->section > 0.0))
        return rb_fail(why, RB_EINVAL, "section = %g: expected > 0", m->section);
    return assemble(mesh, m, matrix[mesh->kind], K, why);
}

rb_status rb_fem_mass(const rb_fem_mesh *mesh, const rb_fem_material *material, rb_sparse *M,
                      rb_message *why)
{
    if (mesh->kind != RB_FEM_BRICK)
        return rb_fail(why, RB_EINVAL, "mass: bricks only");
    if (!(material->density > 0.0))
        return rb_fail(why, RB_EINVAL, "density = %g: expected > 0", material->density);
    return assemble(mesh, material, rb_fem_brick_mass, M, why);
}
