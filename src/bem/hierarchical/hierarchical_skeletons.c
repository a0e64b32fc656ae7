/* Skeletons: rows and columns of a cluster that represent all its rows and columns for
 * the rest of the body. */
#include "bem/hierarchical/hierarchical_parts.h"

#include <stdlib.h>

/* The rows and columns of other clusters that reach into a circle. */
typedef struct {
    int rows, columns;
    int *row, *column; /* owned, one allocation */
} neighbours;

static int reaches_into(const rb_hierarchical *h, int dof, const rb_circle *circle)
{
    const rb_element *e = &h->matrix.element[dof / 2];
    const double dx = e->mx - circle->x, dy = e->my - circle->y, r = circle->r + e->a;
    return dx * dx + dy * dy < r * r;
}

static int overlap(const rb_circle *a, const rb_circle *b)
{
    const double dx = a->x - b->x, dy = a->y - b->y, r = a->r + b->r;
    return dx * dx + dy * dy < r * r;
}

static rb_status find_neighbours(const rb_hierarchical *h, int level, int k, const rb_circle *reach,
                                 neighbours *near)
{
    size_t most = 1;

    for (int i = 0; i < 1 << level; i++) {
        const rb_hierarchical_cluster *c = rb_hierarchical_cluster_at(h, level, i);
        if (i != k && overlap(&c->circle, reach))
            most += (size_t)c->e.m;
    }
    *near = (neighbours){.row = rb_alloc_int(2 * most)};
    if (!near->row)
        return RB_ENOMEM;
    near->column = near->row + most;
    for (int i = 0; i < 1 << level; i++) {
        const rb_hierarchical_cluster *c = rb_hierarchical_cluster_at(h, level, i);
        if (i == k || !overlap(&c->circle, reach))
            continue;
        for (int d = 0; d < c->e.m; d++) {
            if (reaches_into(h, c->e.row[d], reach))
                near->row[near->rows++] = c->e.row[d];
            if (reaches_into(h, c->e.column[d], reach))
                near->column[near->columns++] = c->e.column[d];
        }
    }
    return RB_OK;
}

rb_status rb_hierarchical_skeletonise(const void *tree, int level, int k)
{
    const rb_hierarchical *h = tree;
    rb_hierarchical_cluster *c = rb_hierarchical_cluster_at(h, level, k);
    rb_elimination *e = &c->e;
    rb_circle reach = c->circle;
    rb_skeleton columns = {0}, rows = {0};
    rb_mixed_rows own = {0};
    neighbours near;

    reach.r *= RB_HIERARCHICAL_REACH;
    rb_status s = find_neighbours(h, level, k, &reach, &near);
    /* What the cluster's columns do to the others' rows, and to the far circle. */
    if (s == RB_OK)
        s = rb_mixed_see_columns(&h->matrix, near.rows, near.row, &reach, h->points, e->m,
                                 e->column, &columns);
    /* What the others' columns, and loads on the far circle, do to the cluster's rows:
     * transposed. */
    if (s == RB_OK)
        s = rb_mixed_rows_make(&h->matrix, e->m, e->row, NULL, 0, &own);
    if (s == RB_OK)
        s = rb_skeleton_alloc(near.columns + 2 * h->points, e->m, &rows);
    if (s == RB_OK)
        s = rb_mixed_block(&h->matrix, &own, near.columns, near.column,
                           (rb_matrix_view){rows.K, (size_t)rows.ld, 1});
    if (s == RB_OK)
        s = rb_mixed_far(&h->matrix, &own, reach, h->points,
                         (rb_matrix_view){rows.K + near.columns, (size_t)rows.ld, 1});
    /* Both decompositions to the larger of their ranks. */
    if (s == RB_OK)
        s = rb_skeleton_factor(&columns, h->tolerance);
    if (s == RB_OK)
        s = rb_skeleton_factor(&rows, h->tolerance);
    if (s == RB_OK)
        s = rb_elimination_keep(rows.rank > columns.rank ? rows.rank : columns.rank, e);
    if (s == RB_OK)
        s = rb_skeleton_split(&columns, e->kept, c->order + e->m, e->Z);
    if (s == RB_OK)
        s = rb_skeleton_split(&rows, e->kept, c->order, e->V);
    rb_mixed_rows_free(&own);
    rb_skeleton_free(&columns);
    rb_skeleton_free(&rows);
    free(near.row);
    return s;
}
