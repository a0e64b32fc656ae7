#include "bem/cluster.h"

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

/* The `middle` elements that come first along the axis to the front (Hoare). */
static void select_front(const rb_element *element, int axis, int *order, int count, int middle)
{
    int low = 0, high = count - 1;
    while (low < high) {
        const double pivot = along(&element[order[(low + high) / 2]], axis);
        int i = low, j = high;
        while (i <= j) {
            while (along(&element[order[i]], axis) < pivot)
                i++;
            while (along(&element[order[j]], axis) > pivot)
                j--;
            if (i <= j) {
                const int kept = order[i];
                order[i++] = order[j];
                order[j--] = kept;
            }
        }
        if (middle <= j)
            high = j;
        else if (middle >= i)
            low = i;
        else
            return;
    }
}

void rb_cluster_order(int n, const rb_element *element, int levels, int *order)
{
    for (int i = 0; i < n; i++)
        order[i] = i;
    for (int level = 0; level < levels; level++)
        for (int k = 0; k < 1 << level; k++) {
            const int first = rb_cluster_first(n, level, k),
                      count = rb_cluster_first(n, level, k + 1) - first,
                      half = rb_cluster_first(n, level + 1, 2 * k + 1) - first;
            box b = nothing;
            for (int i = 0; i < count; i++)
                enclose(&element[order[first + i]], &b);
            const int axis = b.high[1] - b.low[1] > b.high[0] - b.low[0];
            select_front(element, axis, order + first, count, half);
        }
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
