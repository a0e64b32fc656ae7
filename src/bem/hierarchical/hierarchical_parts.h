/* What a hierarchical matrix is made of; shared by its files. */
#ifndef ROLLBEM_BEM_HIERARCHICAL_HIERARCHICAL_PARTS_H
#define ROLLBEM_BEM_HIERARCHICAL_HIERARCHICAL_PARTS_H

#include "bem/hierarchical/elimination.h"
#include "bem/hierarchical/hierarchical.h"
#include "bem/hierarchical/mixed.h"

typedef struct {
    rb_elimination e; /* its rows and columns, and memory */
    rb_circle circle; /* about its elements */
    int *order;       /* of the rows, then of the columns: skeleton first */
    double *D;        /* its part of the matrix, m x m, then the skeleton's in its corner;
                         owned, gone with the parent's */
} rb_hierarchical_cluster;

struct rb_hierarchical {
    rb_mixed matrix;
    int *order; /* n: element j is the mesh's order[j]; owned */
    int levels; /* below the root; 0: a dense matrix */
    double tolerance;
    int points;                       /* on a circle about a cluster */
    rb_hierarchical_cluster *cluster; /* levels 0 ... levels, level by level; owned */
};

static inline rb_hierarchical_cluster *rb_hierarchical_cluster_at(const rb_hierarchical *h,
                                                                  int level, int k)
{
    return h->cluster + rb_cluster_place(level, k);
}

static inline int rb_hierarchical_clusters(const rb_hierarchical *h)
{
    return (2 << h->levels) - 1;
}

/* Radius of the circle that separates far from near, over that of the cluster. */
static const double RB_HIERARCHICAL_REACH = 2.0;

/* ---- hierarchical_skeletons.c ------------------------------------------------------ */

/* Which rows and columns of cluster k stand for the others, and how: its order, and kept,
 * V and Z of its elimination.  Reads the lists of its neighbours.  RB_ENOMEM. */
rb_cluster_stage rb_hierarchical_skeletonise;

/* ---- hierarchical_solve.c ---------------------------------------------------------- */

/* RB_SINGULAR unless solutions give their right-hand sides back; RB_ENOMEM. */
rb_status rb_hierarchical_verify(const rb_hierarchical *h);

#endif
