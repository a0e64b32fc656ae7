/* A solution on fewer elements is the start on more, so that the number of Newton steps
 * does not grow: with a matrix the elements of the problem itself in pairs, without one a
 * coarser mesh. */
#include "rolling/internal.h"

#include <cblas.h>
#include <stdlib.h>
#include <string.h>

/* Elements of the coarsest mesh, which starts cold. */
enum { COARSEST = 150 };

int rb_rolling_coarse_elements(int n)
{
    return n / 4 >= RB_ROLLING_LARGE ? n / 4 : COARSEST;
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

/* The coarse edges are known to less than an element: the outermost zones follow them. */
static int zone_at(const rb_rolling_state *coarse, int j, double x, double from,
                   double to)
{
    const int zone = coarse->zone[j];

    if (x < from || x > to)
        return RB_ZONE_SEPARATED;
    if (zone != RB_ZONE_SEPARATED)
        return zone;
    const int left = j > 0 ? coarse->zone[j - 1] : RB_ZONE_SEPARATED;
    const int right = j + 1 < coarse->n ? coarse->zone[j + 1] : RB_ZONE_SEPARATED;
    return left != RB_ZONE_SEPARATED ? left : right;
}

void rb_rolling_start_from(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                           const rb_rolling_state *coarse,
                           const rb_rolling_mesh *fine_mesh, rb_rolling_state *fine)
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
        fine->zone[i] = zone_at(coarse, j, x, from, to);
    }
    fine->delta = coarse->delta;
    fine->xi = coarse->xi;
}

/* ---- Elements in pairs --------------------------------------------------------------
 */

/* y += sums over pairs; an odd last element stays alone. */
static void add_pairs(int n, const double *x, double *y)
{
    for (int k = 0; k < n / 2; k++)
        y[k] += x[2 * k] + x[2 * k + 1];
    if (n % 2)
        y[n / 2] += x[n - 1];
}

/* How pairs see what varies over elements: shares of the two and of the next one. */
typedef struct {
    double first, second, next;
} shares;

static const shares MEAN = {0.5, 0.5, 0.0};
/* The difference between the mean displacement of a pair and that of the pair upstream is
 * twice this mean of the slips.  That of two slips alone would be the difference between
 * the ends of a pair, to which its own traction adds nothing. */
static const shares UPSTREAM_MEAN = {0.25, 0.5, 0.25};

/* y += means over pairs. */
static void add_means(int n, shares of, const double *x, double *y)
{
    const int last = (n - 1) / 2;

    for (int k = 0; k < last; k++)
        y[k] += of.first * x[2 * k] + of.second * x[2 * k + 1] + of.next * x[2 * k + 2];
    if (n % 2)
        y[last] += x[n - 1];
    else
        y[last] += (of.first * x[n - 2] + of.second * x[n - 1]) / (1.0 - of.next);
}

/* Answers of the pairs to tractions constant over each pair: n columns of A. */
static void halve_matrix(int n, shares of, const double *A, int lda, double *C)
{
    const size_t m = (size_t)(n + 1) / 2;

    for (int j = 0; j < n; j++)
        add_means(n, of, A + (size_t)j * (size_t)lda, C + (size_t)(j / 2) * m);
}

static void halve_problem(const rb_rolling_problem *fine, rb_rolling_problem *half,
                          double *F)
{
    const int n = fine->n, m = half->n;
    const size_t block = (size_t)m * (size_t)m;
    const shares slip = fine->steady ? UPSTREAM_MEAN : MEAN;

    halve_matrix(n, MEAN, fine->F, fine->ldf, F);
    halve_matrix(n, MEAN, fine->F + (size_t)n * (size_t)fine->ldf, fine->ldf, F + block);
    halve_matrix(n, slip, fine->S, n, half->S);
    halve_matrix(n, slip, fine->S + (size_t)n * (size_t)n, n, half->S + block);
    add_means(n, MEAN, fine->d_N, half->d_N);
    add_means(n, slip, fine->d_T, half->d_T);
    add_means(n, slip, fine->e_T, half->e_T);
    add_pairs(n, fine->load_N, half->load_N);
    add_pairs(n, fine->load_T, half->load_T);
    add_pairs(n, fine->force_N, half->force_N);
    add_pairs(n, fine->force_T, half->force_T);
    add_pairs(n, fine->moment_N, half->moment_N);
    add_pairs(n, fine->moment_T, half->moment_T);
}

double *rb_rolling_halve(const rb_rolling_problem *fine, rb_rolling_problem *half)
{
    const size_t m = (size_t)(fine->n + 1) / 2;
    double *room = rb_alloc(m, 4 * m + 9), *next = room;

    if (!room)
        return NULL;
    *half = *fine;
    half->factors = NULL;
    half->n = (int)m;
    half->F = next;
    half->ldf = (int)m;
    half->S = next += 2 * m * m;
    half->d_N = next += 2 * m * m;
    half->d_T = next += m;
    half->e_T = next += m;
    half->load_N = next += m;
    half->load_T = next += m;
    half->force_N = next += m;
    half->force_T = next += m;
    half->moment_N = next += m;
    half->moment_T = next += m;
    halve_problem(fine, half, room);
    return room;
}

void rb_rolling_start_from_half(const rb_rolling_state *half, rb_rolling_state *state)
{
    for (int i = 0; i < state->n; i++) {
        state->p[i] = half->p[i / 2];
        state->q[i] = half->q[i / 2];
        state->zone[i] = half->zone[i / 2];
    }
    state->delta = half->delta;
    state->xi = half->xi;
}
