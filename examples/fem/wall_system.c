/* Mass, stiffness, contact map and loads of the wall: elastic blocks, or the same blocks
 * rigid by Galerkin's projection on their rigid motions. */
#include "fem/wall.h"

#include <stdlib.h>
#include <string.h>

static const rb_fem_material masonry = {.young = 2.2e9, .poisson = 0.2, .density = 2000.0};
static const double gravity = 9.81, support_mass = 300.0; /* m/s2, kg */

void wall_system_free(wall_system *s)
{
    rb_sparse_free(&s->M);
    rb_sparse_free(&s->K);
    rb_sparse_free(&s->H);
    free(s->weight);
    free(s->press);
    memset(s, 0, sizeof *s);
}

/* a with one more row and column, which hold only their diagonal entry; takes over a. */
static rb_status append(rb_sparse *a, double diagonal)
{
    const int n = a->cols;
    rb_triplets t = {.rows = n + 1, .cols = n + 1};
    rb_sparse larger;
    rb_triplets_add_matrix(&t, 1.0, a);
    rb_triplets_add(&t, n, n, diagonal);
    const rb_status s = rb_sparse_from_triplets(&t, &larger);
    rb_triplets_free(&t);
    if (s != RB_OK)
        return s;
    rb_sparse_free(a);
    *a = larger;
    return RB_OK;
}

rb_status wall_elastic_system(const wall_layout *layout, const rb_fem_mesh *mesh, int contacts,
                              const wall_contact *contact, wall_system *s, rb_message *why)
{
    memset(s, 0, sizeof *s);
    s->dofs = mesh->dofs + 1;
    rb_status status = rb_fem_stiffness(mesh, &masonry, &s->K, why);
    if (status == RB_OK)
        status = rb_fem_mass(mesh, &masonry, &s->M, why);
    if (status == RB_OK)
        status = append(&s->K, 0.0);
    if (status == RB_OK)
        status = append(&s->M, support_mass);
    if (status == RB_OK) {
        /* The support's own weight is borne by the jack. */
        double *down = rb_alloc((size_t)s->dofs, 1);
        s->weight = rb_alloc((size_t)s->dofs, 1);
        s->press = rb_alloc((size_t)s->dofs, 1);
        if (down && s->weight && s->press) {
            for (int a = 0; a < mesh->nodes; a++)
                down[mesh->dof[3 * a + 2]] = -gravity;
            rb_sparse_apply(1.0, &s->M, down, 0.0, s->weight);
            s->press[s->dofs - 1] = -1.0;
        }
        free(down);
        status = s->weight && s->press && down ? RB_OK : RB_ENOMEM;
    }
    if (status == RB_OK)
        status = wall_contact_map(layout, mesh, contacts, contact, &s->H);
    if (status != RB_OK)
        wall_system_free(s);
    return status;
}

/* ---- Rigid blocks ------------------------------------------------------------------ */

rb_status wall_rigid_system(const wall_layout *layout, const rb_fem_mesh *mesh,
                            const wall_system *elastic, rb_sparse *R, wall_system *s)
{
    rb_sparse Rt = {0}, MR = {0};
    memset(s, 0, sizeof *s);
    s->dofs = 6 * BLOCKS + 1;
    const rb_triplets none = {.rows = s->dofs, .cols = s->dofs};
    rb_triplets t = {.rows = mesh->dofs + 1, .cols = 6 * BLOCKS + 1};
    for (int b = 0; b < BLOCKS; b++) {
        const wall_block *block = &layout->block[b];
        double centre[3];
        for (int c = 0; c < 3; c++)
            centre[c] = block->low[c] + 0.5 * block->size[c];
        for (int a = 0; a < block->n[0] * block->n[1] * block->n[2]; a++) {
            /* Velocities of a node at arm from the block's centre under the block's six
             * freedoms. */
            const int node = block->first + a;
            for (int c = 0; c < 3; c++) {
                const int row = mesh->dof[3 * node + c], d = (c + 1) % 3, e = (c + 2) % 3;
                rb_triplets_add(&t, row, 6 * b + c, 1.0);
                /* (omega x arm)_c = omega_d arm_e - omega_e arm_d */
                rb_triplets_add(&t, row, 6 * b + 3 + d, mesh->x[3 * node + e] - centre[e]);
                rb_triplets_add(&t, row, 6 * b + 3 + e, centre[d] - mesh->x[3 * node + d]);
            }
        }
    }
    rb_triplets_add(&t, mesh->dofs, 6 * BLOCKS, 1.0);
    rb_status status = rb_sparse_from_triplets(&t, R);
    rb_triplets_free(&t);
    if (status == RB_OK)
        status = rb_sparse_transpose(R, &Rt);
    if (status == RB_OK)
        status = rb_sparse_multiply(&elastic->M, R, &MR);
    if (status == RB_OK)
        status = rb_sparse_multiply(&Rt, &MR, &s->M);
    if (status == RB_OK)
        status = rb_sparse_multiply(&Rt, &elastic->H, &s->H);
    if (status == RB_OK)
        status = rb_sparse_from_triplets(&none, &s->K);
    s->weight = rb_alloc((size_t)s->dofs, 1);
    s->press = rb_alloc((size_t)s->dofs, 1);
    if (!s->weight || !s->press)
        status = RB_ENOMEM;
    if (status == RB_OK) {
        rb_sparse_apply(1.0, &Rt, elastic->weight, 0.0, s->weight);
        rb_sparse_apply(1.0, &Rt, elastic->press, 0.0, s->press);
    }
    rb_sparse_free(&Rt);
    rb_sparse_free(&MR);
    if (status != RB_OK)
        wall_system_free(s);
    return status;
}
