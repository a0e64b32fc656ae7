/* Models: a mesh over a flat obstacle with loads, built piece by piece. */
#include "fem/fem.h"

#include <stdlib.h>
#include <string.h>

rb_status rb_fem_model_alloc(rb_fem_kind kind, int nodes, int elements, int contacts,
                             rb_fem_model *model)
{
    rb_fem_structure *s = &model->structure;
    memset(model, 0, sizeof *model);
    s->contacts = contacts;
    s->mu = rb_alloc((size_t)contacts, 1);
    s->gap = rb_alloc((size_t)contacts, 1);
    model->contact_node = rb_alloc_int((size_t)contacts);
    const rb_status status = rb_fem_mesh_alloc(kind, nodes, elements, &model->mesh);
    s->dimension = model->mesh.dimension;
    return s->mu && s->gap && model->contact_node ? status : RB_ENOMEM;
}

rb_status rb_fem_model_build(rb_fem_model *model, const rb_fem_material *material, double mu,
                             int steps, rb_message *why)
{
    rb_fem_structure *s = &model->structure;
    rb_fem_mesh_number(&model->mesh);
    s->dofs = model->mesh.dofs;
    for (int i = 0; i < s->contacts; i++) { /* a node that is held along the obstacle has none */
        const int d = model->mesh.dimension, *dof = model->mesh.dof + d * model->contact_node[i];
        s->mu[i] = dof[0] >= 0 && dof[d - 2] >= 0 ? mu : 0.0;
    }
    model->steps = steps;
    model->load = rb_alloc((size_t)s->dofs, (size_t)steps);
    if (!model->load)
        return RB_ENOMEM;
    const rb_status status = rb_fem_stiffness(&model->mesh, material, &s->K, why);
    if (status != RB_OK)
        return status;
    const int d = model->mesh.dimension, m = d * s->contacts;
    rb_triplets t = {.rows = model->mesh.dofs, .cols = m};
    for (int k = 0; k < m; k++) {
        /* Axis of component k of the contact frame (N, T1, T2). */
        const int dof =
            model->mesh.dof[d * model->contact_node[k / d] + ((k % d) == 0 ? d - 1 : (k % d) - 1)];
        if (dof >= 0)
            rb_triplets_add(&t, dof, k, 1.0);
    }
    const rb_status st = rb_sparse_from_triplets(&t, &s->H);
    rb_triplets_free(&t);
    return st;
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

void rb_fem_model_change(rb_fem_model *model, double mu, double factor)
{
    const size_t loads = (size_t)model->mesh.dofs * (size_t)model->steps;
    for (int i = 0; i < model->structure.contacts; i++)
        if (model->structure.mu[i] > 0.0)
            model->structure.mu[i] = mu;
    for (size_t k = 0; k < loads; k++)
        model->load[k] *= factor;
}

void rb_fem_model_load(rb_fem_model *model, int step, int node, int direction, double force)
{
    const int dof = model->mesh.dof[model->mesh.dimension * node + direction];
    if (dof >= 0)
        model->load[dof + (size_t)model->mesh.dofs * (size_t)step] += force;
}
