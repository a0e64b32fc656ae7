#include "bem/hierarchical.h"
#include "bem/elimination.h"
#include "bem/internal.h"
#include "bem/mixed.h"
#include "bem/skeleton.h"
#include "rollbem/blas.h"

#include <cblas.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* LEAF: elements of the smallest clusters; TOP: the level whose skeletons are solved as
 * one dense system. */
enum { LEAF = 32, TOP = 2, PANEL = 16 };

/* Radius of the circle that separates far from near, over that of the cluster. */
static const double REACH = 2.0;

typedef struct {
    rb_elimination e; /* its rows and columns */
    rb_circle circle; /* about its elements */
    int *order;       /* of the rows, then of the columns: skeleton first; owned */
    double *D;        /* its part of the matrix, m x m, then the skeleton's in its corner;
                         owned, gone with the parent's */
} cluster;

struct rb_hierarchical {
    rb_mixed matrix;
    int *order; /* n, owned */
    int levels;
    double tolerance;
    int points;       /* on a circle about a cluster */
    cluster *cluster; /* levels 0 ... levels, level by level; owned */
};

static cluster *cluster_at(const rb_hierarchical *h, int level, int k)
{
    return h->cluster + ((size_t)1 << level) - 1 + k;
}

static int clusters(const rb_hierarchical *h)
{
    return (2 << h->levels) - 1;
}

static void cluster_free(cluster *c)
{
    rb_elimination_free(&c->e);
    free(c->order);
    free(c->D);
    *c = (cluster){0};
}

void rb_hierarchical_free(rb_hierarchical *h)
{
    if (!h)
        return;
    for (int i = 0; h->cluster && i < clusters(h); i++)
        cluster_free(&h->cluster[i]);
    free(h->cluster);
    free(h->order);
    rb_mixed_free(&h->matrix);
    free(h);
}

/* ---- A cluster's own part of the matrix ----------------------------------------------
 */

static rb_status cluster_alloc(int m, cluster *c)
{
    const size_t size = (size_t)m;
    const rb_status s = rb_elimination_begin(m, &c->e);

    c->order = rb_alloc_int(2 * size);
    c->D = rb_alloc(size, size);
    return s == RB_OK && c->order && c->D ? RB_OK : RB_ENOMEM;
}

static rb_status make_leaf(const rb_hierarchical *h, int level, int k, cluster *c)
{
    const int first = rb_cluster_first(h->matrix.n, level, k),
              last = rb_cluster_first(h->matrix.n, level, k + 1);
    rb_mixed_rows rows;

    if (cluster_alloc(2 * (last - first), c) != RB_OK)
        return RB_ENOMEM;
    for (int i = 0; i < c->e.m; i++)
        c->e.row[i] = c->e.column[i] = 2 * first + i;
    rb_status s = rb_mixed_rows_make(&h->matrix, c->e.m, c->e.row, NULL, 0, &rows);
    if (s == RB_OK)
        s = rb_mixed_block(&h->matrix, &rows, c->e.m, c->e.column, c->D, 1,
                           (size_t)c->e.m);
    rb_mixed_rows_free(&rows);
    return s;
}

/* A(rows of a, columns of b), to the place of D given. */
static rb_status between(const rb_hierarchical *h, const cluster *a, const cluster *b,
                         double *D, int ld)
{
    rb_mixed_rows rows;
    rb_status s = rb_mixed_rows_make(&h->matrix, a->e.kept, a->e.row, NULL, 0, &rows);

    if (s == RB_OK)
        s = rb_mixed_block(&h->matrix, &rows, b->e.kept, b->e.column, D, 1, (size_t)ld);
    rb_mixed_rows_free(&rows);
    return s;
}

/* The skeletons of `count` clusters as one. */
static rb_status merge(const rb_hierarchical *h, cluster *part, int count, cluster *c)
{
    int m = 0;
    for (int i = 0; i < count; i++)
        m += part[i].e.kept;
    rb_status s = cluster_alloc(m, c);
    for (int j = 0, column = 0; s == RB_OK && j < count; column += part[j++].e.kept) {
        memcpy(c->e.row + column, part[j].e.row,
               (size_t)part[j].e.kept * sizeof *c->e.row);
        memcpy(c->e.column + column, part[j].e.column,
               (size_t)part[j].e.kept * sizeof *c->e.row);
        double *D = c->D + (size_t)column * (size_t)m;
        for (int i = 0; s == RB_OK && i < count; D += part[i++].e.kept)
            if (i == j)
                LAPACKE_dlacpy_work(LAPACK_COL_MAJOR, 'A', part[j].e.kept, part[j].e.kept,
                                    part[j].D, part[j].e.m, D, m);
            else
                s = between(h, &part[i], &part[j], D, m);
    }
    for (int i = 0; i < count; i++) {
        free(part[i].D);
        part[i].D = NULL;
    }
    return s;
}

/* ---- Skeletons ----------------------------------------------------------------------
 */

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

static rb_status neighbours_alloc(const rb_hierarchical *h, int level, int k,
                                  const rb_circle *reach, neighbours *near)
{
    size_t most = 1;

    for (int i = 0; i < 1 << level; i++) {
        const cluster *c = cluster_at(h, level, i);
        if (i != k && overlap(&c->circle, reach))
            most += (size_t)c->e.m;
    }
    *near = (neighbours){.row = rb_alloc_int(2 * most)};
    near->column = near->row + most;
    return near->row ? RB_OK : RB_ENOMEM;
}

static rb_status find_neighbours(const rb_hierarchical *h, int level, int k,
                                 const rb_circle *reach, neighbours *near)
{
    if (neighbours_alloc(h, level, k, reach, near) != RB_OK)
        return RB_ENOMEM;
    for (int i = 0; i < 1 << level; i++) {
        const cluster *c = cluster_at(h, level, i);
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

/* What the cluster's columns do to the others' rows, and to the far circle. */
static rb_status see_columns(const rb_hierarchical *h, const cluster *c,
                             const neighbours *near, rb_circle reach, rb_skeleton *s)
{
    rb_mixed_rows rows;
    rb_status status =
        rb_mixed_rows_make(&h->matrix, near->rows, near->row, &reach, h->points, &rows);
    if (status == RB_OK)
        status = rb_skeleton_alloc(rows.rows, c->e.m, s);
    if (status == RB_OK)
        status = rb_mixed_block(&h->matrix, &rows, c->e.m, c->e.column, s->K, 1,
                                (size_t)s->ld);
    rb_mixed_rows_free(&rows);
    return status;
}

/* What the others' columns, and loads on the far circle, do to the cluster's rows:
 * transposed. */
static rb_status see_rows(const rb_hierarchical *h, const cluster *c,
                          const neighbours *near, rb_circle reach, rb_skeleton *s)
{
    rb_mixed_rows rows;
    rb_status status = rb_mixed_rows_make(&h->matrix, c->e.m, c->e.row, NULL, 0, &rows);

    if (status == RB_OK)
        status = rb_skeleton_alloc(near->columns + 2 * h->points, c->e.m, s);
    if (status == RB_OK)
        status = rb_mixed_block(&h->matrix, &rows, near->columns, near->column, s->K,
                                (size_t)s->ld, 1);
    if (status == RB_OK)
        status = rb_mixed_far(&h->matrix, &rows, reach, h->points, s->K + near->columns,
                              (size_t)s->ld, 1);
    rb_mixed_rows_free(&rows);
    return status;
}

/* Both decompositions to the larger of their ranks. */
static rb_status split(const rb_hierarchical *h, cluster *c, rb_skeleton *columns,
                       rb_skeleton *rows)
{
    rb_elimination *e = &c->e;
    rb_status s = rb_skeleton_factor(columns, h->tolerance);

    if (s == RB_OK)
        s = rb_skeleton_factor(rows, h->tolerance);
    if (s == RB_OK)
        s = rb_elimination_keep(rows->rank > columns->rank ? rows->rank : columns->rank,
                                e);
    if (s == RB_OK)
        s = rb_skeleton_split(columns, e->kept, c->order + e->m, e->Z);
    if (s == RB_OK)
        s = rb_skeleton_split(rows, e->kept, c->order, e->V);
    return s;
}

static rb_status skeletonise(const rb_hierarchical *h, int level, int k)
{
    cluster *c = cluster_at(h, level, k);
    rb_circle reach = c->circle;
    rb_skeleton columns = {0}, rows = {0};
    neighbours near;

    reach.r *= REACH;
    rb_status s = find_neighbours(h, level, k, &reach, &near);
    if (s == RB_OK)
        s = see_columns(h, c, &near, reach, &columns);
    if (s == RB_OK)
        s = see_rows(h, c, &near, reach, &rows);
    if (s == RB_OK)
        s = split(h, c, &columns, &rows);
    rb_skeleton_free(&columns);
    rb_skeleton_free(&rows);
    free(near.row);
    return s;
}

/* ---- Elimination --------------------------------------------------------------------
 */

/* X = D in the new order; the lists too. */
static rb_status reorder(cluster *c, double *X)
{
    const size_t m = (size_t)c->e.m;
    int *old = rb_alloc_int(2 * m);

    if (!old)
        return RB_ENOMEM;
    memcpy(old, c->e.row, 2 * m * sizeof *old);
    for (size_t j = 0; j < m; j++) {
        const double *from = c->D + (size_t)c->order[m + j] * m;
        for (size_t i = 0; i < m; i++)
            X[i + j * m] = from[c->order[i]];
        c->e.row[j] = old[c->order[j]];
        c->e.column[j] = old[m + (size_t)c->order[m + j]];
    }
    free(old);
    return RB_OK;
}

static rb_status eliminate(const rb_hierarchical *h, int level, int k)
{
    cluster *c = cluster_at(h, level, k);
    const size_t m = (size_t)c->e.m;
    double *X = rb_alloc(m, m);
    rb_status s = X ? reorder(c, X) : RB_ENOMEM;

    if (s == RB_OK && c->e.kept < c->e.m)
        s = rb_elimination_run(&c->e, X);
    free(c->D);
    c->D = X;
    return s;
}

/* ---- All levels ---------------------------------------------------------------------
 */

static rb_status make_cluster(const rb_hierarchical *h, int level, int k)
{
    cluster *c = cluster_at(h, level, k);
    c->circle =
        rb_cluster_circle(h->matrix.element, rb_cluster_first(h->matrix.n, level, k),
                          rb_cluster_first(h->matrix.n, level, k + 1));
    return level == h->levels ? make_leaf(h, level, k, c)
                              : merge(h, cluster_at(h, level + 1, 2 * k), 2, c);
}

typedef rb_status stage(const rb_hierarchical *h, int level, int k);

static rb_status for_clusters(const rb_hierarchical *h, int level, stage *run)
{
    const int count = 1 << level;
    rb_status s = RB_OK;

#pragma omp parallel for schedule(dynamic) if (count > 8)
    for (int k = 0; k < count; k++) {
        const rb_status own = run(h, level, k);
        if (own != RB_OK)
#pragma omp critical
            s = own;
    }
    return s;
}

/* One stage after the other: a cluster looks at its neighbours' lists before any is put
 * into a new order. */
static rb_status reduce_level(const rb_hierarchical *h, int level)
{
    rb_status s = for_clusters(h, level, make_cluster);

    if (s == RB_OK)
        s = for_clusters(h, level, skeletonise);
    if (s == RB_OK)
        s = for_clusters(h, level, eliminate);
    return s;
}

/* What is left at the top, dense. */
static rb_status solve_top(const rb_hierarchical *h)
{
    cluster *top = cluster_at(h, 0, 0);
    rb_status s = h->levels == 0 ? make_leaf(h, 0, 0, top)
                                 : merge(h, cluster_at(h, TOP, 0), 1 << TOP, top);
    if (s == RB_OK)
        s = rb_elimination_keep(0, &top->e);
    if (s == RB_OK)
        s = rb_elimination_run(&top->e, top->D);
    free(top->D);
    top->D = NULL;
    return s;
}

static rb_hierarchical *hierarchical_alloc(int n, double tolerance)
{
    rb_hierarchical *h = calloc(1, sizeof *h);
    if (!h)
        return NULL;
    h->levels = rb_cluster_levels(n, LEAF);
    if (h->levels < TOP)
        h->levels = 0;
    h->tolerance = tolerance;
    h->points = 2 * (int)ceil(-log(tolerance) / log(REACH));
    h->order = rb_alloc_int((size_t)n);
    h->cluster = calloc(((size_t)2 << h->levels) - 1, sizeof *h->cluster);
    if (h->order && h->cluster)
        return h;
    rb_hierarchical_free(h);
    return NULL;
}

/* ---- Solutions ----------------------------------------------------------------------
 */

/* Columns of X from the mesh's order to the clusters', or back. */
static void permute(const rb_hierarchical *h, int q, const double *from, double *to,
                    int back)
{
    const size_t dofs = 2 * (size_t)h->matrix.n;
    for (int c = 0; c < q; c++, from += dofs, to += dofs)
        for (int j = 0; j < h->matrix.n; j++)
            for (int k = 0; k < 2; k++) {
                const int own = 2 * j + k, mesh = 2 * h->order[j] + k;
                to[back ? mesh : own] = from[back ? own : mesh];
            }
}

/* y = A^-1 b in the clusters' order, dofs x q; b is used up.  room: of largest_cluster
 * x q. */
static void solve_ordered(const rb_hierarchical *h, int q, double *b, double *y,
                          double *room)
{
    const size_t dofs = 2 * (size_t)h->matrix.n;
    for (int i = clusters(h) - 1; i >= 0; i--)
        rb_elimination_up(&h->cluster[i].e, dofs, q, b, y, room);
    for (int i = 1; i < clusters(h); i++)
        rb_elimination_down(&h->cluster[i].e, dofs, q, y, room);
}

static size_t largest_cluster(const rb_hierarchical *h)
{
    int most = 0;
    for (int i = 0; i < clusters(h); i++)
        most = h->cluster[i].e.m > most ? h->cluster[i].e.m : most;
    return (size_t)most;
}

static rb_status solve_panel(const rb_hierarchical *h, int q, double *X)
{
    const size_t all = 2 * (size_t)h->matrix.n * (size_t)q;
    double *b = rb_alloc(2 * all + largest_cluster(h) * (size_t)q, 1), *y = b + all;

    if (!b)
        return RB_ENOMEM;
    permute(h, q, X, b, 0);
    solve_ordered(h, q, b, y, y + all);
    permute(h, q, y, X, 1);
    free(b);
    return RB_OK;
}

rb_status rb_hierarchical_solve(const rb_hierarchical *h, int columns, double *X)
{
    const int panels = (columns + PANEL - 1) / PANEL;
    const int threads = rb_blas_threads(1);
    rb_status s = RB_OK;

#pragma omp parallel for schedule(dynamic) if (panels > 1)
    for (int p = 0; p < panels; p++) {
        const int first = p * PANEL, rest = columns - first;
        const rb_status own = solve_panel(h, rest < PANEL ? rest : PANEL,
                                          X + 2 * (size_t)h->matrix.n * (size_t)first);
        if (own != RB_OK)
#pragma omp critical
            s = own;
    }
    rb_blas_threads(threads);
    return s;
}

/* ---- Whether it is an inverse ---------------------------------------------------------
 */

enum { SAMPLES = 64, CHUNK = 256 };

/* b - A x at the sampled elements, the largest. */
static rb_status sample_residual(const rb_hierarchical *h, int rows, const int *row,
                                 const double *b, const double *x, double *largest)
{
    double *A = rb_alloc((size_t)rows, CHUNK), *r = rb_alloc((size_t)rows, 1);
    int column[CHUNK];
    rb_mixed_rows of_A = {0};
    rb_status s =
        A && r ? rb_mixed_rows_make(&h->matrix, rows, row, NULL, 0, &of_A) : RB_ENOMEM;

    for (int i = 0; s == RB_OK && i < rows; i++)
        r[i] = b[row[i]];
    for (int first = 0; s == RB_OK && first < 2 * h->matrix.n; first += CHUNK) {
        const int rest = 2 * h->matrix.n - first, count = rest < CHUNK ? rest : CHUNK;
        for (int c = 0; c < count; c++)
            column[c] = first + c;
        s = rb_mixed_block(&h->matrix, &of_A, count, column, A, 1, (size_t)rows);
        if (s == RB_OK)
            cblas_dgemv(CblasColMajor, CblasNoTrans, rows, count, -1.0, A, rows,
                        x + first, 1, 1.0, r, 1);
    }
    *largest = s == RB_OK ? rb_norm_inf((size_t)rows, r) : INFINITY;
    rb_mixed_rows_free(&of_A);
    free(A);
    free(r);
    return s;
}

/* Elements all over the boundary, and the one whose unknowns are largest, ascending. */
static int choose_samples(const rb_hierarchical *h, const double *x, int *row)
{
    const int n = h->matrix.n, count = n < SAMPLES ? n : SAMPLES;
    const int largest = (int)cblas_idamax(2 * n, x, 1) / 2;
    int rows = 0;

    for (int i = 0, last = -1; i < count; i++) {
        int j = (int)((double)i * n / count);
        const int next = (int)((i + 1.0) * n / count);
        if (largest > j && largest < next)
            j = largest;
        if (j != last)
            for (int k = 0; k < 2; k++)
                row[rows++] = 2 * j + k;
        last = j;
    }
    return rows;
}

/* A singular matrix has an inverse too where low ranks and rounding have moved it a
 * little: one that does not give b back, and a random b has something of all vectors. */
static rb_status verify(const rb_hierarchical *h)
{
    const size_t dofs = 2 * (size_t)h->matrix.n;
    double *b = rb_alloc(dofs, 3), *x = b + dofs, *used = x + dofs,
           *room = rb_alloc(largest_cluster(h), 1), left = INFINITY;
    int row[2 * SAMPLES];
    rb_status s = b && room ? RB_OK : RB_ENOMEM;

    if (s == RB_OK) {
        uint32_t state = 1;
        for (size_t i = 0; i < dofs; i++) {
            state = 1664525 * state + 1013904223;
            used[i] = b[i] = state / 4294967296.0 - 0.5;
        }
        solve_ordered(h, 1, used, x, room);
        s = sample_residual(h, choose_samples(h, x, row), row, b, x, &left);
    }
    free(b);
    free(room);
    const double most = fmin(fmax(1e4 * h->tolerance, 1e-4), 1e-3);
    return s == RB_OK && !(left < most) ? RB_SINGULAR : s;
}

rb_status rb_hierarchical_create(const rb_bem_mesh *mesh, rb_bem_material material,
                                 const double *unit, double tolerance,
                                 rb_hierarchical **out)
{
    rb_hierarchical *h = hierarchical_alloc(mesh->n, tolerance);
    rb_status s = h ? rb_mixed_make(mesh, material, unit, h->levels, h->order, &h->matrix)
                    : RB_ENOMEM;
    const int threads = rb_blas_threads(1);

    for (int level = h ? h->levels : 0; s == RB_OK && level >= TOP; level--)
        s = reduce_level(h, level);
    if (s == RB_OK)
        s = solve_top(h);
    if (s == RB_OK)
        s = verify(h);
    rb_blas_threads(threads);
    *out = s == RB_OK ? h : NULL;
    if (s != RB_OK)
        rb_hierarchical_free(h);
    return s;
}

double rb_hierarchical_ratio(const rb_hierarchical *h)
{
    const double dofs = 2.0 * h->matrix.n;
    double stored = 0.0;
    for (int i = 0; i < clusters(h); i++) {
        const double kept = h->cluster[i].e.kept, others = h->cluster[i].e.m - kept;
        stored += (4.0 * kept + others) * others;
    }
    return stored / (dofs * dofs);
}
