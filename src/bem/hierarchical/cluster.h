/* Elements in clusters: halved along the longer side of their box, again and again. */
#ifndef ROLLBEM_BEM_HIERARCHICAL_CLUSTER_H
#define ROLLBEM_BEM_HIERARCHICAL_CLUSTER_H

#include "bem/kernels.h"

typedef struct {
    double x, y, r;
} rb_circle;

/* Elements of cluster k of the 2^level on its level: first ... of the next - 1. */
static inline int rb_cluster_first(int n, int level, int k)
{
    return (int)(((size_t)k * (size_t)n) >> level);
}

/* Place of cluster k where all levels stand one after the other. */
static inline size_t rb_cluster_place(int level, int k)
{
    return ((size_t)1 << level) - 1 + (size_t)k;
}

/* Levels below the root until no cluster has more than `most` elements. */
int rb_cluster_levels(int n, int most);

/* order (n, written): the elements' numbers so that every cluster is a range. */
void rb_cluster_order(int n, const rb_element *element, int levels, int *order);

/* Runs a function on all clusters of a level, in parallel where they are many; the status
 * is that of one that failed. */
typedef rb_status rb_cluster_stage(const void *tree, int level, int k);
rb_status rb_cluster_run(const void *tree, int level, rb_cluster_stage *run);

/* About elements first ... last - 1, with their ends. */
rb_circle rb_cluster_circle(const rb_element *element, int first, int last);

#endif
