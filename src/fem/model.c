/* Models: a mesh over a flat obstacle with loads, built piece by piece. */
#include "rollbem/fem.h"

#include <stdlib.h>
#include <string.h>

/* Axis of component k of the contact frame (N, T1, T2). */
static int axis_of(int dimension, int k)
{
    return k == 0 ? dimension - 1 : k - 1;
}

static rb_status contact_map(const rb_fem_mesh *mesh, int contacts, const int *node,
                             rb_sparse *H)
{
    const int d = mesh->dimension, m = d * contacts;
    rb_triplets t = {.rows = mesh->dofs, .cols = m};
    for (int k = 0; k < m; k++) {
        const int dof = mesh->dof[d * node[k / d] + axis_of(d, k % d)];
        if (dof >= 0)
            rb_triplets_add(&t, dof, k, 1.0);
    }
    const rb_status s = rb_sparse_from_triplets(&t, H);
    rb_triplets_free(&t);
    return s;
}

static int slides(const rb_fem_mesh *mesh, int node)
{
    for (int k = 0; k < mesh->dimension - 1; k++)
        if (mesh->dof[mesh->dimension * node + k] < 0)
            return 0;
    return 1;
}

static rb_status build_structure(const rb_fem_material *material, int contacts, double mu,
                                 rb_fem_model *model, rb_message *why)
{
    rb_fem_structure *s = &model->structure;
    s->dofs = model->mesh.dofs;
    s->dimension = model->mesh.dimension;
    s->contacts = contacts;
    s->mu = rb_alloc((size_t)contacts, 1);
    s->gap = rb_alloc((size_t)contacts, 1);
    if (!s->mu || !s->gap)
        return RB_ENOMEM;
    for (int i = 0; i < contacts; i++)
        s->mu[i] = slides(&model->mesh, model->contact_node[i]) ? mu : 0.0;
    const rb_status status = rb_fem_stiffness(&model->mesh, material, &s->K, why);
    return status == RB_OK
               ? contact_map(&model->mesh, contacts, model->contact_node, &s->H)
               : status;
}

rb_status rb_fem_model_create(rb_fem_mesh *mesh, const rb_fem_material *material,
                              int contacts, int *nodes, double mu, int steps,
                              rb_fem_model *model, rb_message *why)
{
    memset(model, 0, sizeof *model);
    model->mesh = *mesh;
    memset(mesh, 0, sizeof *mesh);
    model->contact_node = nodes;
    model->steps = steps;
    rb_fem_mesh_number(&model->mesh);
    model->load = rb_alloc((size_t)model->mesh.dofs, (size_t)steps);
    rb_status s = model->load ? RB_OK : RB_ENOMEM;
    if (s == RB_OK)
        s = build_structure(material, contacts, mu, model, why);
    if (s != RB_OK)
        rb_fem_model_free(model);
    return s;
}

void rb_fem_model_free(rb_fem_model *model)
{
    if (!model)
        return;
    rb_fem_mesh_free(&model->mesh);
    rb_fem_structure_free(&model->structure);
    free(model->contact_node);
    free(model->load);
    memset(model, 0, sizeof *model);
}

void rb_fem_model_load(rb_fem_model *model, int step, int node, int direction,
                       double force)
{
    const int dof = model->mesh.dof[model->mesh.dimension * node + direction];
    if (dof >= 0)
        model->load[dof + (size_t)model->mesh.dofs * (size_t)step] += force;
}
