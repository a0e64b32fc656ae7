/* A solution on a coarser mesh is the start on a finer one, so that the number of Newton
 * steps does not grow. */
#include "rolling/internal.h"

/* Elements of the coarsest mesh, which starts cold: fewer than any that starts from
 * another one. */
enum { COARSEST = 40 };

int rb_rolling_coarse_elements(int n)
{
    return n / 4 >= RB_ROLLING_TRANSFORMS ? n / 4 : COARSEST;
}

/* Value at x of tractions at the coarse midpoints, linear in between. */
static double interpolated(const rb_rolling_mesh *mesh, const double *value, double x,
                           int j)
{
    const double here = 0.5 * (mesh->ends[j] + mesh->ends[j + 1]);
    const int other = x < here ? j - 1 : j + 1;

    if (other < 0 || other >= mesh->n)
        return value[j];
    const double there = 0.5 * (mesh->ends[other] + mesh->ends[other + 1]);
    return value[j] + (value[other] - value[j]) * (x - here) / (there - here);
}

void rb_rolling_start_from(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                           const rb_contact_state *coarse,
                           const rb_rolling_mesh *fine_mesh, rb_contact_state *fine)
{
    double from, to;
    int j = 0;

    rb_rolling_contact_edges(rc, mesh, coarse, &from, &to);
    for (int i = 0; i < fine_mesh->n; i++) {
        const double x = 0.5 * (fine_mesh->ends[i] + fine_mesh->ends[i + 1]);
        while (j < mesh->n - 1 && mesh->ends[j + 1] < x)
            j++;
        fine->p[i] = interpolated(mesh, coarse->p, x, j);
        fine->q[i] = interpolated(mesh, coarse->q, x, j);
        /* The coarse edges are known to less than an element: the outermost zones follow
         * them. */
        const int zone = coarse->zone[j];

        if (x < from || x > to)
            fine->zone[i] = RB_ZONE_SEPARATED;
        else {
            if (zone != RB_ZONE_SEPARATED)
                fine->zone[i] = zone;
            else {
                const int left = j > 0 ? coarse->zone[j - 1] : RB_ZONE_SEPARATED;
                const int right =
                    j + 1 < coarse->n ? coarse->zone[j + 1] : RB_ZONE_SEPARATED;
                fine->zone[i] = left != RB_ZONE_SEPARATED ? left : right;
            }
        }
    }
    fine->delta = coarse->delta;
    fine->xi = coarse->xi;
}
