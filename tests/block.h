/* An elastic block pressed on a round obstacle without friction (Signorini's problem): plane
 * strain, unit squares, bilinear displacements.  nx by nx/2 squares; the upper side is held
 * and pushed down by 0.3, or floats and is pulled down by forces; the vertical displacements
 * of the lower side are bounded below, all others are free. */
#ifndef ROLLBEM_TESTS_BLOCK_H
#define ROLLBEM_TESTS_BLOCK_H

#include "base/sparse.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    int n;
    rb_sparse K;       /* owned, as q */
    double *q, *lower; /* n; lower is in the memory of q */
} block;

static void block_free(block *b)
{
    rb_sparse_free(&b->K);
    free(b->q);
}

/* Of one square; nu = 0.3, E = 1. */
static void block_square(double K[8][8])
{
    static const double nu = 0.3, sx[] = {-1, 1, 1, -1}, sy[] = {-1, -1, 1, 1};
    const double c = 1.0 / ((1.0 + nu) * (1.0 - 2.0 * nu));
    const double C[3][3] = {
        {c * (1.0 - nu), c * nu, 0.0}, {c * nu, c * (1.0 - nu), 0.0}, {0.0, 0.0, c * (0.5 - nu)}};
    memset(K, 0, 64 * sizeof(double));
    for (int g = 0; g < 4; g++) {
        double B[3][8] = {{0}};
        for (int k = 0; k < 4; k++) {
            const double x = sx[g] / sqrt(3.0), y = sy[g] / sqrt(3.0);
            B[0][2 * k] = B[2][2 * k + 1] = 0.5 * sx[k] * (1.0 + sy[k] * y);
            B[1][2 * k + 1] = B[2][2 * k] = 0.5 * sy[k] * (1.0 + sx[k] * x);
        }
        for (int i = 0; i < 8; i++)
            for (int j = 0; j < 8; j++)
                for (int a = 0; a < 3; a++)
                    for (int d = 0; d < 3; d++)
                        K[i][j] += 0.25 * B[a][i] * C[a][d] * B[d][j];
    }
}

static rb_status block_create(int nx, int floats, block *b)
{
    const int ny = nx / 2, held = floats ? 0 : nx + 1, nodes = (nx + 1) * (ny + 1) - held;
    double K[8][8];
    block_square(K);
    *b = (block){.n = 2 * nodes, .q = calloc(4 * (size_t)nodes, sizeof(double))};
    rb_triplets t = {.rows = b->n, .cols = b->n};
    b->lower = b->q + b->n;
    for (int y = 0; y < ny; y++)
        for (int x = 0; x < nx; x++) {
            const int first = x + y * (nx + 1);
            const int at[] = {first, first + 1, first + nx + 2, first + nx + 1};
            for (int i = 0; i < 8; i++)
                for (int j = 0; j < 8; j++) {
                    const int row = 2 * at[i / 2] + i % 2, col = 2 * at[j / 2] + j % 2;
                    if (row < b->n && col < b->n)
                        rb_triplets_add(&t, row, col, K[i][j]);
                    else if (row < b->n && j % 2)
                        b->q[row] -= 0.3 * K[i][j];
                }
        }
    for (int i = 0; i < b->n; i++)
        b->lower[i] = -INFINITY;
    for (int x = 0; x <= nx; x++) {
        const double s = (x - 0.5 * nx) / (0.25 * nx);
        b->lower[2 * x + 1] = -0.05 * s * s;
        if (floats)
            b->q[2 * (x + ny * (nx + 1)) + 1] = 0.01;
    }
    const rb_status s = rb_sparse_from_triplets(&t, &b->K);
    rb_triplets_free(&t);
    return s;
}

#endif
