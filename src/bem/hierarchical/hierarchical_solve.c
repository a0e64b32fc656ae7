/* Solutions with a hierarchical matrix, and the check that they are solutions. */
#include "bem/hierarchical/hierarchical.h"
#include "bem/hierarchical/hierarchical_parts.h"
#include "base/blas.h"

#include <cblas.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

enum { PANEL = 16 }; /* right-hand sides that are solved together */

/* Columns of X from the mesh's order to the clusters', or back. */
static void permute(const rb_hierarchical *h, int q, const double *from, double *to, int back)
{
    const size_t dofs = 2 * (size_t)h->matrix.n;
    for (int c = 0; c < q; c++, from += dofs, to += dofs)
        for (int j = 0; j < h->matrix.n; j++)
            for (int k = 0; k < 2; k++) {
                const int own = 2 * j + k, mesh = 2 * h->order[j] + k;
                to[back ? mesh : own] = from[back ? own : mesh];
            }
}

/* y = A^-1 b in the clusters' order, dofs x q; b is used up.  scratch: of largest_cluster
 * x q. */
static void solve_ordered(const rb_hierarchical *h, int q, double *b, double *y, double *scratch)
{
    const size_t dofs = 2 * (size_t)h->matrix.n;
    for (int i = rb_hierarchical_clusters(h) - 1; i >= 0; i--)
        rb_elimination_up(&h->cluster[i].e, dofs, q, b, y, scratch);
    for (int i = 1; i < rb_hierarchical_clusters(h); i++)
        rb_elimination_down(&h->cluster[i].e, dofs, q, y, scratch);
}

static size_t largest_cluster(const rb_hierarchical *h)
{
    int most = 0;
    for (int i = 0; i < rb_hierarchical_clusters(h); i++)
        most = h->cluster[i].e.m > most ? h->cluster[i].e.m : most;
    return (size_t)most;
}

rb_status rb_hierarchical_solve(const rb_hierarchical *h, int columns, double *X)
{
    const size_t dofs = 2 * (size_t)h->matrix.n, most = largest_cluster(h);
    const int panels = (columns + PANEL - 1) / PANEL;
    const int threads = rb_blas_threads(1);
    rb_status s = RB_OK;

#pragma omp parallel for num_threads(rb_blas_loop_threads()) schedule(dynamic) if (panels > 1)
    for (int p = 0; p < panels; p++) {
        const int first = p * PANEL, q = columns - first < PANEL ? columns - first : PANEL;
        const size_t all = dofs * (size_t)q;
        double *x = X + dofs * (size_t)first, *b = rb_alloc(2 * all + most * (size_t)q, 1);

        if (b) {
            double *y = b + all;
            permute(h, q, x, b, 0);
            solve_ordered(h, q, b, y, y + all);
            permute(h, q, y, x, 1);
        } else {
#pragma omp critical
            s = RB_ENOMEM;
        }
        free(b);
    }
    rb_blas_threads(threads);
    return s;
}

/* ---- Whether it is an inverse ------------------------------------------------------ */

enum { SAMPLES = 64, CHUNK = 256 };

/* b - A x at the sampled elements, the largest. */
static rb_status sample_residual(const rb_hierarchical *h, int rows, const int *row,
                                 const double *b, const double *x, double *largest)
{
    double *A = rb_alloc((size_t)rows, CHUNK), *r = rb_alloc((size_t)rows, 1);
    int column[CHUNK];
    rb_mixed_rows of_A = {0};
    rb_status s = A && r ? rb_mixed_rows_make(&h->matrix, rows, row, NULL, 0, &of_A) : RB_ENOMEM;

    for (int i = 0; s == RB_OK && i < rows; i++)
        r[i] = b[row[i]];
    for (int first = 0; s == RB_OK && first < 2 * h->matrix.n; first += CHUNK) {
        const int rest = 2 * h->matrix.n - first, count = rest < CHUNK ? rest : CHUNK;
        for (int c = 0; c < count; c++)
            column[c] = first + c;
        s = rb_mixed_block(&h->matrix, &of_A, count, column, (rb_matrix_view){A, 1, (size_t)rows});
        if (s == RB_OK)
            cblas_dgemv(CblasColMajor, CblasNoTrans, rows, count, -1.0, A, rows, x + first, 1, 1.0,
                        r, 1);
    }
    *largest = s == RB_OK ? rb_norm_inf((size_t)rows, r) : INFINITY;
    rb_mixed_rows_free(&of_A);
    free(A);
    free(r);
    return s;
}

/* A singular matrix has an inverse too where low ranks and rounding have moved it a
 * little: one that does not give b back, and a random b has something of all vectors. */
rb_status rb_hierarchical_verify(const rb_hierarchical *h)
{
    const int n = h->matrix.n, count = n < SAMPLES ? n : SAMPLES;
    const size_t dofs = 2 * (size_t)n;
    double *b = rb_alloc(dofs, 3), *scratch = rb_alloc(largest_cluster(h), 1);
    double left = INFINITY;
    int row[2 * SAMPLES];
    rb_status s = b && scratch ? RB_OK : RB_ENOMEM;

    if (s == RB_OK) {
        double *x = b + dofs, *used = x + dofs;
        uint32_t state = 1;
        for (size_t i = 0; i < dofs; i++) {
            state = 1664525 * state + 1013904223;
            used[i] = b[i] = state / 4294967296.0 - 0.5;
        }
        solve_ordered(h, 1, used, x, scratch);
        /* Elements all over the boundary, and the one whose unknowns are largest. */
        const int largest = (int)cblas_idamax(2 * n, x, 1) / 2;
        for (int i = 0; i < count; i++) {
            const int next = (int)((i + 1.0) * n / count);
            int j = (int)((double)i * n / count);
            if (largest > j && largest < next)
                j = largest;
            row[2 * i] = 2 * j;
            row[2 * i + 1] = 2 * j + 1;
        }
        s = sample_residual(h, 2 * count, row, b, x, &left);
    }
    free(b);
    free(scratch);
    const double most = fmin(fmax(1e4 * h->tolerance, 1e-4), 1e-3);
    return s == RB_OK && !(left < most) ? RB_SINGULAR : s;
}
