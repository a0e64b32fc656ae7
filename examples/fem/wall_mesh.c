/* Blocks in running bond, their meshes and their contact points. */
#include "fem/wall.h"

#include <math.h>

static const double block_size[3] = {0.2, 0.1, 0.1}; /* m */

/* Beginnings and lengths along the wall, in whole blocks: odd courses two whole ones,
 * even courses half, whole, half. */
static const double run[2][3][2] = {{{0.0, 1.0}, {1.0, 1.0}}, {{0.0, 0.5}, {0.5, 1.0}, {1.5, 0.5}}};

wall_layout wall_lay_out(const rb_fem_wall_options *o)
{
    wall_layout layout = {.nodes = 0};
    for (int course = 0, at = 0; course < COURSES; course++)
        for (int k = 0; k < 2 + course % 2; k++) {
            const int *n = course % 2 ? o->coarse : o->fine;
            const double *piece = run[course % 2][k];
            wall_block *b = &layout.block[at++];
            b->course = course;
            for (int d = 0; d < 3; d++) {
                b->size[d] = block_size[d];
                b->n[d] = n[d];
            }
            b->low[0] = piece[0] * block_size[0];
            b->low[2] = course * block_size[2];
            b->size[0] *= piece[1];
            if (piece[1] < 1.0)
                b->n[0] = n[0] / 2 + 1;
            b->first = layout.nodes;
            layout.nodes += b->n[0] * b->n[1] * b->n[2];
            layout.elements += (b->n[0] - 1) * (b->n[1] - 1) * (b->n[2] - 1);
        }
    return layout;
}

static int wall_node(const wall_block *b, int i, int j, int k)
{
    return b->first + i + b->n[0] * (j + b->n[1] * k);
}

rb_status wall_build_mesh(const wall_layout *layout, rb_fem_mesh *mesh)
{
    const rb_status s = rb_fem_mesh_alloc(RB_FEM_BRICK, layout->nodes, layout->elements, mesh);
    if (s != RB_OK)
        return s;
    int *node = mesh->node;
    for (const wall_block *b = layout->block; b < layout->block + BLOCKS; b++) {
        static const int corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                         {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
        for (int k = 0; k < b->n[2]; k++)
            for (int j = 0; j < b->n[1]; j++)
                for (int i = 0; i < b->n[0]; i++) {
                    const int at[3] = {i, j, k};
                    double *p = mesh->x + 3 * wall_node(b, i, j, k);
                    for (int c = 0; c < 3; c++)
                        p[c] = b->low[c] + b->size[c] * at[c] / (b->n[c] - 1);
                }
        for (int k = 0; k + 1 < b->n[2]; k++)
            for (int j = 0; j + 1 < b->n[1]; j++)
                for (int i = 0; i + 1 < b->n[0]; i++)
                    for (int a = 0; a < 8; a++)
                        *node++ =
                            wall_node(b, i + corner[a][0], j + corner[a][1], k + corner[a][2]);
    }
    return RB_OK;
}

/* ---- Joints ------------------------------------------------------------------------ */

typedef struct {
    wall_contact *contact; /* NULL: only count */
    int n;
} contact_list;

static void add(contact_list *list, int node, int other, int axis, double sign)
{
    if (list->contact)
        list->contact[list->n] = (wall_contact){node, other, axis, sign};
    list->n++;
}

/* All nodes of a finely meshed block's lower or upper face meet the neighbouring course
 * or support. */
static void bed_joint(const wall_layout *layout, const wall_block *b, int upper, contact_list *list)
{
    const int k = upper ? b->n[2] - 1 : 0, course = b->course + (upper ? 1 : -1);
    for (int j = 0; j < b->n[1]; j++)
        for (int i = 0; i < b->n[0]; i++) {
            const double x = b->low[0] + b->size[0] * i / (b->n[0] - 1);
            int other = upper ? UPPER_SUPPORT : LOWER_SUPPORT;
            if (course >= 0 && course < COURSES) {
                /* The block of a course that holds the abscissa x. */
                other = 0;
                while (layout->block[other].course != course ||
                       x > layout->block[other].low[0] + layout->block[other].size[0] + 1e-9)
                    other++;
            }
            add(list, wall_node(b, i, j, k), other, 2, upper ? -1.0 : 1.0);
        }
}

int wall_find_contacts(const wall_layout *layout, wall_contact *contacts)
{
    contact_list list = {contacts, 0};
    for (int b = 0; b < BLOCKS; b++) {
        const wall_block *block = &layout->block[b];
        if (block->course % 2 == 0) {
            bed_joint(layout, block, 0, &list);
            bed_joint(layout, block, 1, &list);
        }
        if (b > 0 && layout->block[b - 1].course == block->course) {
            /* The left face of a block meets its left neighbour, at the heights between
             * the bed joints: an edge node with contacts in two joints would be held
             * twice. */
            const int neighbour = b - 1;
            for (int k = 1; k + 1 < block->n[2]; k++)
                for (int j = 0; j < block->n[1]; j++)
                    add(&list, wall_node(block, 0, j, k), neighbour, 0, 1.0);
        }
    }
    return list.n;
}

int wall_axis(const wall_contact *c, int k)
{
    return (c->axis + k) % 3;
}

/* The up to eight nodes of b around p and their trilinear weights; how many. */
static int interpolate(const wall_block *b, const double *p, int node[8], double weight[8])
{
    int cell[3], n = 0;
    double part[3];
    for (int c = 0; c < 3; c++) {
        const double s = (p[c] - b->low[c]) / b->size[c] * (b->n[c] - 1);
        cell[c] = (int)fmin(fmax(floor(s), 0.0), b->n[c] - 2);
        part[c] = s - cell[c];
    }
    for (int a = 0; a < 8; a++) {
        double w = 1.0;
        for (int c = 0; c < 3; c++)
            w *= a >> c & 1 ? part[c] : 1.0 - part[c];
        if (fabs(w) < 1e-9)
            continue;
        node[n] = wall_node(b, cell[0] + (a & 1), cell[1] + (a >> 1 & 1), cell[2] + (a >> 2 & 1));
        weight[n++] = w;
    }
    return n;
}

rb_status wall_contact_map(const wall_layout *layout, const rb_fem_mesh *mesh, int contacts,
                           const wall_contact *contact, rb_sparse *H)
{
    rb_triplets t = {.rows = mesh->dofs + 1, .cols = 3 * contacts};
    for (int i = 0; i < contacts; i++) {
        /* The entries of one contact's three columns of H. */
        const int column = 3 * i;
        const wall_contact *c = contact + i;
        int node[9] = {c->node}, n = 1;
        double weight[9] = {-1.0};
        if (c->other >= 0 && c->other < BLOCKS)
            n += interpolate(&layout->block[c->other], mesh->x + 3 * c->node, node + 1, weight + 1);
        for (int k = 0; k < 3; k++) {
            const double sign = k == 0 ? c->sign : 1.0;
            for (int a = 0; a < n; a++)
                rb_triplets_add(&t, mesh->dof[3 * node[a] + wall_axis(c, k)], column + k,
                                -sign * weight[a]);
        }
        if (c->other == UPPER_SUPPORT)
            rb_triplets_add(&t, mesh->dofs, column, -c->sign);
    }
    const rb_status s = rb_sparse_from_triplets(&t, H);
    rb_triplets_free(&t);
    return s;
}
