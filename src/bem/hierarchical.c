#include "bem/hierarchical.h"
#include "bem/internal.h"
#include "bem/mixed.h"
#include "bem/skeleton.h"
#include "rollbem/blas.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* LEAF: elements of the smallest clusters; TOP: the level whose skeletons are solved as
 * one dense system. */
enum { LEAF = 32, TOP = 2, PANEL = 16 };

/* Radius of the circle that separates far from near, over that of the cluster. */
static const double REACH = 2.0;

/* A cluster: m rows and columns, skeleton first.  With the others eliminated,
 *     row R - V' row S,   column R - column S Z,   X_RR = LU,
 * its part of the matrix is X_SS - lower X_RR^-1 X_RS, and upper = X_RR^-1 X_RS. */
typedef struct {
    rb_circle circle; /* about its elements */
    int m, kept;
    int *row, *column; /* owned, one allocation */
    int *order;        /* of the rows, then of the columns: skeleton first; owned */
    double *D;         /* m x m, then X_SS in its corner; owned, gone with the parent's */
    double *V, *Z;     /* kept x others; owned with the rest in one allocation */
    double *lower, *upper, *LU;
    lapack_int *pivot; /* owned */
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

static void cluster_free(cluster *c)
{
    free(c->row);
    free(c->order);
    free(c->D);
    free(c->V);
    free(c->pivot);
    *c = (cluster){0};
}

void rb_hierarchical_free(rb_hierarchical *h)
{
    if (!h)
        return;
    for (int i = 0; h->cluster && i < (2 << h->levels) - 1; i++)
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
    c->m = c->kept = m;
    c->row = rb_alloc_int(2 * size);
    c->column = c->row + size;
    c->order = rb_alloc_int(2 * size);
    c->D = rb_alloc(size, size);
    return c->row && c->order && c->D ? RB_OK : RB_ENOMEM;
}

static rb_status make_leaf(const rb_hierarchical *h, int level, int k, cluster *c)
{
    const int first = rb_cluster_first(h->matrix.n, level, k),
              last = rb_cluster_first(h->matrix.n, level, k + 1);
    rb_mixed_rows rows;

    if (cluster_alloc(2 * (last - first), c) != RB_OK)
        return RB_ENOMEM;
    for (int i = 0; i < c->m; i++)
        c->row[i] = c->column[i] = 2 * first + i;
    rb_status s = rb_mixed_rows_make(&h->matrix, c->m, c->row, NULL, 0, &rows);
    if (s == RB_OK)
        s = rb_mixed_block(&h->matrix, &rows, c->m, c->column, first, c->D, 1,
                           (size_t)c->m);
    rb_mixed_rows_free(&rows);
    return s;
}

/* A(rows of a, columns of b), to the place of D given. */
static rb_status between(const rb_hierarchical *h, const cluster *a, const cluster *b,
                         double *D, int ld)
{
    rb_mixed_rows rows;
    rb_status s = rb_mixed_rows_make(&h->matrix, a->kept, a->row, NULL, 0, &rows);

    if (s == RB_OK)
        s = rb_mixed_block(&h->matrix, &rows, b->kept, b->column, -1, D, 1, (size_t)ld);
    rb_mixed_rows_free(&rows);
    return s;
}

/* The skeletons of `count` clusters as one. */
static rb_status merge(const rb_hierarchical *h, cluster *part, int count, cluster *c)
{
    int m = 0;
    for (int i = 0; i < count; i++)
        m += part[i].kept;
    rb_status s = cluster_alloc(m, c);
    for (int j = 0, column = 0; s == RB_OK && j < count; column += part[j++].kept) {
        memcpy(c->row + column, part[j].row, (size_t)part[j].kept * sizeof *c->row);
        memcpy(c->column + column, part[j].column, (size_t)part[j].kept * sizeof *c->row);
        double *D = c->D + (size_t)column * (size_t)m;
        for (int i = 0; s == RB_OK && i < count; D += part[i++].kept)
            if (i == j)
                LAPACKE_dlacpy_work(LAPACK_COL_MAJOR, 'A', part[j].kept, part[j].kept,
                                    part[j].D, part[j].m, D, m);
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
            most += (size_t)c->m;
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
        for (int d = 0; d < c->m; d++) {
            if (reaches_into(h, c->row[d], reach))
                near->row[near->rows++] = c->row[d];
            if (reaches_into(h, c->column[d], reach))
                near->column[near->columns++] = c->column[d];
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
        status = rb_skeleton_alloc(rows.rows, c->m, s);
    if (status == RB_OK)
        status = rb_mixed_block(&h->matrix, &rows, c->m, c->column, -1, s->K, 1,
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
    rb_status status = rb_mixed_rows_make(&h->matrix, c->m, c->row, NULL, 0, &rows);

    if (status == RB_OK)
        status = rb_skeleton_alloc(near->columns + 2 * h->points, c->m, s);
    if (status == RB_OK)
        status = rb_mixed_block(&h->matrix, &rows, near->columns, near->column, -1, s->K,
                                (size_t)s->ld, 1);
    if (status == RB_OK)
        status = rb_mixed_far(&h->matrix, &rows, reach, h->points, s->K + near->columns,
                              (size_t)s->ld, 1);
    rb_mixed_rows_free(&rows);
    return status;
}

static rb_status store_alloc(cluster *c)
{
    const size_t kept = (size_t)c->kept, others = (size_t)(c->m - c->kept);
    c->V = rb_alloc(4 * kept + others + 1, others + 1);
    c->pivot = calloc(others + 1, sizeof *c->pivot);
    if (!c->V || !c->pivot)
        return RB_ENOMEM;
    c->Z = c->V + kept * others;
    c->lower = c->Z + kept * others;
    c->upper = c->lower + kept * others;
    c->LU = c->upper + kept * others;
    return RB_OK;
}

/* Both decompositions to the larger of their ranks. */
static rb_status split(const rb_hierarchical *h, cluster *c, rb_skeleton *columns,
                       rb_skeleton *rows)
{
    rb_status s = rb_skeleton_factor(columns, h->tolerance);

    if (s == RB_OK)
        s = rb_skeleton_factor(rows, h->tolerance);
    c->kept = rows->rank > columns->rank ? rows->rank : columns->rank;
    if (s == RB_OK)
        s = store_alloc(c);
    if (s == RB_OK)
        s = rb_skeleton_split(columns, c->kept, c->order + c->m, c->Z);
    if (s == RB_OK)
        s = rb_skeleton_split(rows, c->kept, c->order, c->V);
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
    const size_t m = (size_t)c->m;
    int *old = rb_alloc_int(2 * m);

    if (!old)
        return RB_ENOMEM;
    memcpy(old, c->row, 2 * m * sizeof *old);
    for (size_t j = 0; j < m; j++) {
        const double *from = c->D + (size_t)c->order[m + j] * m;
        for (size_t i = 0; i < m; i++)
            X[i + j * m] = from[c->order[i]];
        c->row[j] = old[c->order[j]];
        c->column[j] = old[m + (size_t)c->order[m + j]];
    }
    free(old);
    return RB_OK;
}

/* Leading dimension of a matrix of so many rows. */
static int lead(int rows)
{
    return rows > 0 ? rows : 1;
}

/* X_RR = LU, and what is left of the skeleton's own part. */
static rb_status eliminate_others(cluster *c, double *X)
{
    const int m = c->m, kept = c->kept, others = m - kept, ld = lead(kept);
    double *RS = X + kept, *SR = X + (size_t)kept * (size_t)m, *RR = SR + kept;

    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, m, others, kept, -1.0, X, m,
                c->Z, ld, 1.0, SR, m); /* and RR below it */
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, others, m, kept, -1.0, c->V, ld,
                X, m, 1.0, RS, m); /* and RR beside it */
    LAPACKE_dlacpy_work(LAPACK_COL_MAJOR, 'A', others, others, RR, m, c->LU, others);
    LAPACKE_dlacpy_work(LAPACK_COL_MAJOR, 'A', others, kept, RS, m, c->upper, others);
    LAPACKE_dlacpy_work(LAPACK_COL_MAJOR, 'A', kept, others, SR, m, c->lower, ld);
    if (LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, others, others, c->LU, others, c->pivot))
        return RB_SINGULAR;
    LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', others, kept, c->LU, others, c->pivot,
                        c->upper, others);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, kept, kept, others, -1.0,
                c->lower, ld, c->upper, others, 1.0, X, m);
    return RB_OK;
}

static rb_status eliminate(const rb_hierarchical *h, int level, int k)
{
    cluster *c = cluster_at(h, level, k);
    const size_t m = (size_t)c->m;
    double *X = rb_alloc(m, m);
    rb_status s = X ? reorder(c, X) : RB_ENOMEM;

    if (s == RB_OK && c->kept < c->m)
        s = eliminate_others(c, X);
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
    top->kept = 0;
    if (s == RB_OK)
        s = store_alloc(top);
    if (s == RB_OK)
        s = eliminate_others(top, top->D);
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
    rb_blas_threads(threads);
    *out = s == RB_OK ? h : NULL;
    if (s != RB_OK)
        rb_hierarchical_free(h);
    return s;
}

/* ---- Solutions ----------------------------------------------------------------------
 */

/* Rows list of X (n x columns) to or from the rows of a small matrix. */
static void gather(const double *X, size_t n, int columns, const int *list, int count,
                   double *to)
{
    for (int c = 0; c < columns; c++)
        for (int i = 0; i < count; i++)
            to[i + (size_t)c * (size_t)count] = X[(size_t)list[i] + (size_t)c * n];
}

static void put_back(const double *from, int columns, const int *list, int count,
                     double *X, size_t n)
{
    for (int c = 0; c < columns; c++)
        for (int i = 0; i < count; i++)
            X[(size_t)list[i] + (size_t)c * n] = from[i + (size_t)c * (size_t)count];
}

/* b_R -= V' b_S,  y_R = X_RR^-1 b_R,  b_S -= lower y_R */
static void solve_up(const cluster *c, size_t n, int q, double *b, double *y,
                     double *room)
{
    const int kept = c->kept, others = c->m - kept, ld = lead(kept);
    double *S = room, *R = room + (size_t)kept * (size_t)q;

    if (others == 0)
        return;
    gather(b, n, q, c->row, kept, S);
    gather(b, n, q, c->row + kept, others, R);
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, others, q, kept, -1.0, c->V, ld,
                S, ld, 1.0, R, others);
    LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', others, q, c->LU, others, c->pivot, R,
                        others);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, kept, q, others, -1.0,
                c->lower, ld, R, others, 1.0, S, ld);
    put_back(S, q, c->row, kept, b, n);
    put_back(R, q, c->column + kept, others, y, n);
}

/* y_R -= upper y_S,  x_R = y_R,  x_S = y_S - Z y_R */
static void solve_down(const cluster *c, size_t n, int q, double *y, double *room)
{
    const int kept = c->kept, others = c->m - kept, ld = lead(kept);
    double *S = room, *R = room + (size_t)kept * (size_t)q;

    if (others == 0)
        return;
    gather(y, n, q, c->column, kept, S);
    gather(y, n, q, c->column + kept, others, R);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, others, q, kept, -1.0,
                c->upper, others, S, ld, 1.0, R, others);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, kept, q, others, -1.0, c->Z,
                ld, R, others, 1.0, S, ld);
    put_back(S, q, c->column, kept, y, n);
    put_back(R, q, c->column + kept, others, y, n);
}

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

/* room: 2 dofs x q, then the largest cluster's m x q. */
static void solve_panel(const rb_hierarchical *h, int q, double *X, double *room)
{
    const size_t dofs = 2 * (size_t)h->matrix.n;
    const int all = (2 << h->levels) - 1;
    double *b = room, *y = b + dofs * (size_t)q, *small = y + dofs * (size_t)q;

    permute(h, q, X, b, 0);
    for (int i = all - 1; i >= 0; i--)
        solve_up(&h->cluster[i], dofs, q, b, y, small);
    for (int i = 1; i < all; i++)
        solve_down(&h->cluster[i], dofs, q, y, small);
    permute(h, q, y, X, 1);
}

rb_status rb_hierarchical_solve(const rb_hierarchical *h, int columns, double *X)
{
    const size_t dofs = 2 * (size_t)h->matrix.n;
    const int panels = (columns + PANEL - 1) / PANEL;
    const int threads = rb_blas_threads(1);
    rb_status s = RB_OK;
    size_t most = 0;

    for (int i = 0; i < (2 << h->levels) - 1; i++)
        most = (size_t)h->cluster[i].m > most ? (size_t)h->cluster[i].m : most;
#pragma omp parallel for schedule(dynamic) if (panels > 1)
    for (int p = 0; p < panels; p++) {
        const int first = p * PANEL,
                  q = columns - first < PANEL ? columns - first : PANEL;
        double *room = rb_alloc(2 * dofs + most, (size_t)q);
        if (room)
            solve_panel(h, q, X + (size_t)first * dofs, room);
#pragma omp critical
        s = room ? s : RB_ENOMEM;
        free(room);
    }
    rb_blas_threads(threads);
    return s;
}

double rb_hierarchical_ratio(const rb_hierarchical *h)
{
    const double dofs = 2.0 * h->matrix.n;
    double stored = 0.0;
    for (int i = 0; i < (2 << h->levels) - 1; i++) {
        const double kept = h->cluster[i].kept, others = h->cluster[i].m - kept;
        stored += (4.0 * kept + others) * others;
    }
    return stored / (dofs * dofs);
}
