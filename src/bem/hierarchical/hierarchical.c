/* Level by level from the leaves: clusters are made of the skeletons of two, what they exchange
 * with afar is reduced to a skeleton, all others are eliminated; the last cluster is factored
 * whole. */
#include "bem/hierarchical/hierarchical.h"
#include "bem/hierarchical/hierarchical_parts.h"
#include "base/blas.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* LEAF: elements of the smallest clusters; TOP: the level whose skeletons are solved as
 * one dense system. */
enum { LEAF = 32, TOP = 2 };

void rb_hierarchical_free(rb_hierarchical *h)
{
    if (!h)
        return;
    for (int i = 0; h->cluster && i < rb_hierarchical_clusters(h); i++) {
        rb_arena_free(&h->cluster[i].e.memory);
        free(h->cluster[i].D);
    }
    free(h->cluster);
    free(h->order);
    rb_mixed_free(&h->matrix);
    free(h);
}

/* ---- A cluster's own part of the matrix -------------------------------------------- */

static rb_status cluster_alloc(int m, rb_hierarchical_cluster *c)
{
    const size_t size = (size_t)m;
    const rb_status s = rb_elimination_begin(m, &c->e);

    c->order = rb_arena_ints(&c->e.memory, 2 * size);
    c->D = rb_alloc(size, size);
    return s == RB_OK && c->order && c->D ? RB_OK : RB_ENOMEM;
}

static rb_status make_leaf(const rb_hierarchical *h, int level, int k, rb_hierarchical_cluster *c)
{
    const int first = rb_cluster_first(h->matrix.n, level, k),
              last = rb_cluster_first(h->matrix.n, level, k + 1);

    if (cluster_alloc(2 * (last - first), c) != RB_OK)
        return RB_ENOMEM;
    for (int i = 0; i < c->e.m; i++)
        c->e.row[i] = c->e.column[i] = 2 * first + i;
    return rb_mixed_entries(&h->matrix, c->e.m, c->e.row, c->e.m, c->e.column,
                            (rb_matrix_view){c->D, 1, (size_t)c->e.m});
}

/* The skeletons of `count` clusters as one. */
static rb_status merge(const rb_hierarchical *h, rb_hierarchical_cluster *part, int count,
                       rb_hierarchical_cluster *c)
{
    int m = 0;
    for (int i = 0; i < count; i++)
        m += part[i].e.kept;
    rb_status s = cluster_alloc(m, c);
    for (int j = 0, column = 0; s == RB_OK && j < count; column += part[j++].e.kept) {
        const size_t list = (size_t)part[j].e.kept * sizeof *c->e.row;
        memcpy(c->e.row + column, part[j].e.row, list);
        memcpy(c->e.column + column, part[j].e.column, list);
        double *D = c->D + (size_t)column * (size_t)m;
        for (int i = 0; s == RB_OK && i < count; D += part[i++].e.kept)
            if (i == j)
                LAPACKE_dlacpy_work(LAPACK_COL_MAJOR, 'A', part[j].e.kept, part[j].e.kept,
                                    part[j].D, part[j].e.m, D, m);
            else
                s = rb_mixed_entries(&h->matrix, part[i].e.kept, part[i].e.row, part[j].e.kept,
                                     part[j].e.column, (rb_matrix_view){D, 1, (size_t)m});
    }
    for (int i = 0; i < count; i++) {
        free(part[i].D);
        part[i].D = NULL;
    }
    return s;
}

/* ---- All levels -------------------------------------------------------------------- */

static rb_status make_cluster(const void *tree, int level, int k)
{
    const rb_hierarchical *h = tree;
    rb_hierarchical_cluster *c = rb_hierarchical_cluster_at(h, level, k);

    c->circle = rb_cluster_circle(h->matrix.element, rb_cluster_first(h->matrix.n, level, k),
                                  rb_cluster_first(h->matrix.n, level, k + 1));
    return level == h->levels ? make_leaf(h, level, k, c)
                              : merge(h, rb_hierarchical_cluster_at(h, level + 1, 2 * k), 2, c);
}

/* Rows and columns in the new order, and all but the skeleton eliminated. */
static rb_status eliminate(const void *tree, int level, int k)
{
    rb_hierarchical_cluster *c = rb_hierarchical_cluster_at(tree, level, k);
    const size_t m = (size_t)c->e.m;
    int *old = rb_alloc_int(2 * m);
    double *X = rb_alloc(m, m);
    rb_status s = old && X ? RB_OK : RB_ENOMEM;

    if (s == RB_OK) {
        memcpy(old, c->e.row, 2 * m * sizeof *old);
        for (size_t j = 0; j < m; j++) {
            const double *from = c->D + (size_t)c->order[m + j] * m;
            for (size_t i = 0; i < m; i++)
                X[i + j * m] = from[c->order[i]];
            c->e.row[j] = old[c->order[j]];
            c->e.column[j] = old[m + (size_t)c->order[m + j]];
        }
        if (c->e.kept < c->e.m)
            s = rb_elimination_run(&c->e, X);
    }
    free(old);
    free(c->D);
    c->D = X;
    return s;
}

rb_status rb_hierarchical_create(const rb_bem_mesh *mesh, rb_bem_material material,
                                 const double *unit, double tolerance, rb_hierarchical **out)
{
    const int n = mesh->n, levels = rb_cluster_levels(n, LEAF);
    rb_hierarchical *h = calloc(1, sizeof *h);

    *out = NULL;
    if (!h)
        return RB_ENOMEM;
    h->levels = levels < TOP ? 0 : levels;
    h->tolerance = tolerance;
    h->points = 2 * (int)ceil(-log(tolerance) / log(RB_HIERARCHICAL_REACH));
    h->order = rb_alloc_int((size_t)n);
    h->cluster = calloc((size_t)rb_hierarchical_clusters(h), sizeof *h->cluster);
    rb_status s = h->order && h->cluster
                      ? rb_mixed_make(mesh, material, unit, h->levels, h->order, &h->matrix)
                      : RB_ENOMEM;
    const int threads = rb_blas_threads(1);

    for (int level = h->levels; s == RB_OK && level >= TOP; level--) {
        /* One stage after the other: a cluster looks at its neighbours' lists before any
         * is put into a new order. */
        s = rb_cluster_run(h, level, make_cluster);
        if (s == RB_OK)
            s = rb_cluster_run(h, level, rb_hierarchical_skeletonise);
        if (s == RB_OK)
            s = rb_cluster_run(h, level, eliminate);
    }
    if (s == RB_OK) {
        /* What is left at the top, dense. */
        rb_hierarchical_cluster *top = rb_hierarchical_cluster_at(h, 0, 0);
        s = h->levels == 0 ? make_leaf(h, 0, 0, top)
                           : merge(h, rb_hierarchical_cluster_at(h, TOP, 0), 1 << TOP, top);
        if (s == RB_OK)
            s = rb_elimination_keep(0, &top->e);
        if (s == RB_OK)
            s = rb_elimination_run(&top->e, top->D);
        free(top->D);
        top->D = NULL;
    }
    if (s == RB_OK)
        s = rb_hierarchical_verify(h);
    rb_blas_threads(threads);
    if (s == RB_OK)
        *out = h;
    else
        rb_hierarchical_free(h);
    return s;
}
