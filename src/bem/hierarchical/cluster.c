/* A binary tree of clusters: elements are ordered by halving boxes at their median.  Halves have
 * equally many elements, however graded the mesh is, so that the tree is balanced and a cluster is
 * a range of the order; halving the longer side keeps boxes round, so that clusters are soon far
 * from each other compared with their size. */
#include "bem/hierarchical/cluster.h"
#include "base/blas.h"

int rb_cluster_levels(int n, int most)
{
    int levels = 0;
    while ((n >> levels) + 1 > most && levels < 24)
        levels++;
    return levels;
}

typedef struct {
    double low[2], high[2];
} box;

static const box nothing = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};

static double along(const rb_element *e, int axis)
{
    return axis ? e->my : e->mx;
}

static void enclose(const rb_element *e, box *b)
{
    for (int k = 0; k < 2; k++) {
        b->low[k] = fmin(b->low[k], along(e, k));
        b->high[k] = fmax(b->high[k], along(e, k));
    }
}

void rb_cluster_order(int n, const rb_element *element, int levels, int *order)
{
    for (int i = 0; i < n; i++)
        order[i] = i;
    for (int level = 0; level < levels; level++)
        for (int k = 0; k < 1 << level; k++) {
            int *own = order + rb_cluster_first(n, level, k);
            const int count = (int)(order + rb_cluster_first(n, level, k + 1) - own),
                      middle = (int)(order + rb_cluster_first(n, level + 1, 2 * k + 1) - own);
            box b = nothing;
            for (int i = 0; i < count; i++)
                enclose(&element[own[i]], &b);
            const int axis = b.high[1] - b.low[1] > b.high[0] - b.low[0];
            /* The `middle` elements that come first along the axis to the front (Hoare). */
            for (int low = 0, high = count - 1; low < high;) {
                const double pivot = along(&element[own[(low + high) / 2]], axis);
                int i = low, j = high;
                while (i <= j) {
                    while (along(&element[own[i]], axis) < pivot)
                        i++;
                    while (along(&element[own[j]], axis) > pivot)
                        j--;
                    if (i <= j) {
                        const int kept = own[i];
                        own[i++] = own[j];
                        own[j--] = kept;
                    }
                }
                if (middle > j && middle < i)
                    break;
                if (middle <= j)
                    high = j;
                else
                    low = i;
            }
        }
}

rb_status rb_cluster_run(const void *tree, int level, rb_cluster_stage *run)
{
    rb_status s = rb_interrupted() ? RB_INTERRUPTED : RB_OK;

#pragma omp parallel for num_threads(rb_blas_loop_threads()) schedule(dynamic) if (level > 3)
    for (int k = 0; k < 1 << level; k++) {
        const rb_status own = run(tree, level, k);
        if (own != RB_OK)
#pragma omp critical
            s = own;
    }
    return s;
}

rb_circle rb_cluster_circle(const rb_element *element, int first, int last)
{
    box b = nothing;
    for (int j = first; j < last; j++)
        enclose(&element[j], &b);
    rb_circle c = {0.5 * (b.low[0] + b.high[0]), 0.5 * (b.low[1] + b.high[1]), 0.0};
    for (int j = first; j < last; j++)
        c.r = fmax(c.r, hypot(element[j].mx - c.x, element[j].my - c.y) + element[j].a);
    return c;
}
