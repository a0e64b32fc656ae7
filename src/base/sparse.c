/* Sparse matrices by columns, as in CSparse: p[j] ... p[j + 1] - 1 are the entries of column j, i
 * their rows, increasing, x their values. */
#include "base/sparse.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

void rb_sparse_free(rb_sparse *a)
{
    if (!a)
        return;
    free(a->p);
    free(a->i);
    free(a->x);
    *a = (rb_sparse){0};
}

static rb_status sparse_alloc(int rows, int cols, int nz, rb_sparse *a)
{
    *a = (rb_sparse){.rows = rows,
                     .cols = cols,
                     .p = rb_alloc_int((size_t)cols + 1),
                     .i = rb_alloc_int((size_t)nz),
                     .x = rb_alloc((size_t)nz, 1)};
    if (a->p && a->i && a->x)
        return RB_OK;
    rb_sparse_free(a);
    return RB_ENOMEM;
}

/* counts[1 ... n] entries per bin -> counts[0 ... n] where each bin starts */
static void running_sum(int n, int *counts)
{
    for (int k = 0; k < n; k++)
        counts[k + 1] += counts[k];
}

/* The entries, in an order of increasing rows, go to their columns one after the other (a counting
 * sort), so that each column has its rows in order; equal ones are then added. */
static rb_status place_entries(const rb_triplets *t, const int *order, rb_sparse *a)
{
    int *next = rb_alloc_int((size_t)a->cols);

    if (!next)
        return RB_ENOMEM;
    for (int k = 0; k < t->nz; k++)
        a->p[t->col[k] + 1]++;
    running_sum(a->cols, a->p);
    memcpy(next, a->p, (size_t)a->cols * sizeof *next);
    for (int k = 0; k < t->nz; k++) {
        const int from = order[k], to = next[t->col[from]]++;
        a->i[to] = t->row[from];
        a->x[to] = t->x[from];
    }
    free(next);
    /* Entries of one column arrive by increasing row: equal rows are neighbours. */
    int kept = 0;
    for (int j = 0, begin = 0; j < a->cols; j++) {
        const int end = a->p[j + 1], first = kept;
        for (int k = begin; k < end; k++) {
            if (kept > first && a->i[kept - 1] == a->i[k]) {
                a->x[kept - 1] += a->x[k];
            } else {
                a->i[kept] = a->i[k];
                a->x[kept++] = a->x[k];
            }
        }
        begin = end;
        a->p[j + 1] = kept;
    }
    return RB_OK;
}

rb_status rb_sparse_from_triplets(const rb_triplets *t, rb_sparse *a)
{
    *a = (rb_sparse){0};
    if (t->status != RB_OK)
        return t->status;
    if (t->rows < 0 || t->cols < 0)
        return RB_EINVAL;
    for (int k = 0; k < t->nz; k++)
        if (t->row[k] < 0 || t->row[k] >= t->rows || t->col[k] < 0 || t->col[k] >= t->cols)
            return RB_EINVAL;

    rb_arena scratch = {0};
    int *order = rb_arena_ints(&scratch, (size_t)t->nz),
        *start = rb_arena_ints(&scratch, (size_t)t->rows + 1);
    rb_status s = scratch.failed ? RB_ENOMEM : sparse_alloc(t->rows, t->cols, t->nz, a);
    if (s != RB_OK)
        return rb_arena_done(&scratch, s);
    /* order: the entries by rows, also by a counting sort */
    for (int k = 0; k < t->nz; k++)
        start[t->row[k] + 1]++;
    running_sum(t->rows, start);
    for (int k = 0; k < t->nz; k++)
        order[start[t->row[k]]++] = k;
    s = place_entries(t, order, a);
    if (s != RB_OK)
        rb_sparse_free(a);
    return rb_arena_done(&scratch, s);
}

/* The status is set for good when there is no room: entries would be missing. */
rb_status rb_triplets_reserve(rb_triplets *t, size_t more)
{
    const size_t wanted = (size_t)t->nz + more, twice = 2 * (size_t)t->capacity;
    if (t->status != RB_OK || wanted <= (size_t)t->capacity)
        return t->status;
    if (wanted > INT_MAX)
        return t->status = RB_ENOMEM;
    const size_t capacity = wanted > twice ? wanted : twice < INT_MAX ? twice : INT_MAX;
    int *row = realloc(t->row, capacity * sizeof *row);
    if (row)
        t->row = row;
    int *col = realloc(t->col, capacity * sizeof *col);
    if (col)
        t->col = col;
    double *x = realloc(t->x, capacity * sizeof *x);
    if (x)
        t->x = x;
    if (!row || !col || !x)
        return t->status = RB_ENOMEM;
    t->capacity = (int)capacity;
    return RB_OK;
}

void rb_triplets_add(rb_triplets *t, int row, int col, double x)
{
    if (t->nz == t->capacity && rb_triplets_reserve(t, t->nz ? 1 : 16) != RB_OK)
        return;
    t->row[t->nz] = row;
    t->col[t->nz] = col;
    t->x[t->nz++] = x;
}

void rb_triplets_add_matrix(rb_triplets *t, double factor, const rb_sparse *a)
{
    rb_triplets_reserve(t, (size_t)a->p[a->cols]);
    for (int j = 0; j < a->cols; j++)
        for (int k = a->p[j]; k < a->p[j + 1]; k++)
            rb_triplets_add(t, a->i[k], j, factor * a->x[k]);
}

void rb_triplets_free(rb_triplets *t)
{
    free(t->row);
    free(t->col);
    free(t->x);
    *t = (rb_triplets){0};
}

rb_status rb_sparse_from_dense(int rows, int cols, const double *dense, int lda, rb_sparse *a)
{
    *a = (rb_sparse){0};
    if (rows < 0 || cols < 0 || lda < rows)
        return RB_EINVAL;
    size_t entries = 0;
    for (int j = 0; j < cols; j++)
        for (int i = 0; i < rows; i++)
            entries += dense[i + (size_t)j * (size_t)lda] != 0.0;
    if (entries > INT_MAX || sparse_alloc(rows, cols, (int)entries, a) != RB_OK)
        return RB_ENOMEM;
    int nz = 0;
    for (int j = 0; j < cols; j++) {
        for (int i = 0; i < rows; i++) {
            const double x = dense[i + (size_t)j * (size_t)lda];
            if (x != 0.0) {
                a->i[nz] = i;
                a->x[nz++] = x;
            }
        }
        a->p[j + 1] = nz;
    }
    return RB_OK;
}

rb_status rb_sparse_multiply(const rb_sparse *a, const rb_sparse *b, rb_sparse *c)
{
    *c = (rb_sparse){0};
    if (a->cols != b->rows)
        return RB_EINVAL;
    rb_triplets t = {.rows = a->rows, .cols = b->cols};
    rb_arena scratch = {0};
    double *sum = rb_arena_doubles(&scratch, (size_t)a->rows, 1);
    int *column_of_row = rb_arena_ints(&scratch, (size_t)a->rows),
        *touched = rb_arena_ints(&scratch, (size_t)a->rows);
    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    for (int j = 0; j < b->cols; j++) {
        /* Column j of the product: sum, over the entries of B's column, of columns of A;
         * touched: its rows, each once, marked by column_of_row = j + 1. */
        int count = 0;
        for (int l = b->p[j]; l < b->p[j + 1]; l++)
            for (int k = a->p[b->i[l]]; k < a->p[b->i[l] + 1]; k++) {
                const int i = a->i[k];
                if (column_of_row[i] != j + 1) {
                    column_of_row[i] = j + 1;
                    sum[i] = 0.0;
                    touched[count++] = i;
                }
                sum[i] += a->x[k] * b->x[l];
            }
        for (int k = 0; k < count; k++)
            rb_triplets_add(&t, touched[k], j, sum[touched[k]]);
    }
    const rb_status s = rb_sparse_from_triplets(&t, c); /* that of t, where it has failed */
    rb_triplets_free(&t);
    return rb_arena_done(&scratch, s);
}

rb_status rb_sparse_copy(const rb_sparse *a, rb_sparse *b)
{
    const int nz = a->p[a->cols];
    if (sparse_alloc(a->rows, a->cols, nz, b) != RB_OK)
        return RB_ENOMEM;
    memcpy(b->p, a->p, ((size_t)a->cols + 1) * sizeof *b->p);
    memcpy(b->i, a->i, (size_t)nz * sizeof *b->i);
    memcpy(b->x, a->x, (size_t)nz * sizeof *b->x);
    return RB_OK;
}

double rb_sparse_diagonal(const rb_sparse *a, int j)
{
    int low = a->p[j], high = a->p[j + 1]; /* rows increase: it is in [low, high) if anywhere */
    while (low < high) {
        const int middle = low + (high - low) / 2;
        if (a->i[middle] < j)
            low = middle + 1;
        else
            high = middle;
    }
    return low < a->p[j + 1] && a->i[low] == j ? a->x[low] : 0.0;
}

/* Each column of A is gone through in order, and its entries are put behind those that their rows,
 * the columns of A', have already. */
rb_status rb_sparse_transpose(const rb_sparse *a, rb_sparse *t)
{
    const int nz = a->p[a->cols];
    if (sparse_alloc(a->cols, a->rows, nz, t) != RB_OK)
        return RB_ENOMEM;
    for (int k = 0; k < nz; k++)
        t->p[a->i[k] + 1]++;
    running_sum(a->rows, t->p);
    for (int j = 0; j < a->cols; j++) {
        for (int k = a->p[j]; k < a->p[j + 1]; k++) {
            const int to = t->p[a->i[k]]++;
            t->i[to] = j;
            t->x[to] = a->x[k];
        }
    }
    /* every pointer has moved to the start of the next column */
    memmove(t->p + 1, t->p, (size_t)a->rows * sizeof *t->p);
    t->p[0] = 0;
    return RB_OK;
}

void rb_sparse_apply(double alpha, const rb_sparse *a, const double *x, double beta, double *y)
{
    for (int i = 0; i < a->rows; i++)
        y[i] = beta == 0.0 ? 0.0 : beta * y[i];
    for (int j = 0; j < a->cols; j++) {
        const double xj = alpha * x[j];
        for (int k = a->p[j]; k < a->p[j + 1]; k++)
            y[a->i[k]] += a->x[k] * xj;
    }
}

void rb_sparse_apply_transposed(double alpha, const rb_sparse *a, const double *x, double beta,
                                double *y)
{
    for (int j = 0; j < a->cols; j++) {
        double sum = 0.0;
        for (int k = a->p[j]; k < a->p[j + 1]; k++)
            sum += a->x[k] * x[a->i[k]];
        y[j] = alpha * sum + (beta == 0.0 ? 0.0 : beta * y[j]);
    }
}

/* The root of a tree of connected indices; every index on the way then points to that which stood
 * two above it, so that ways become short (path halving). */
static int find_root(int *up, int i)
{
    while (up[i] != i)
        i = up[i] = up[up[i]];
    return i;
}

/* Columns are stored in one order, so that A = A' is a comparison of arrays. */
rb_status rb_sparse_is_symmetric(const rb_sparse *a, int *symmetric)
{
    rb_sparse t;
    *symmetric = 0;
    if (a->rows != a->cols)
        return RB_OK;
    if (rb_sparse_transpose(a, &t) != RB_OK)
        return RB_ENOMEM;
    const size_t nz = (size_t)a->p[a->cols];
    *symmetric = memcmp(a->p, t.p, ((size_t)a->cols + 1) * sizeof *a->p) == 0 &&
                 memcmp(a->i, t.i, nz * sizeof *a->i) == 0;
    for (size_t k = 0; *symmetric && k < nz; k++)
        *symmetric = a->x[k] == t.x[k];
    rb_sparse_free(&t);
    return RB_OK;
}

/* Union-find: each entry joins the trees of its row and its column; a tree is a component. */
rb_status rb_sparse_components(const rb_sparse *a, int *count, int *part)
{
    *count = 0;
    if (a->rows != a->cols)
        return RB_EINVAL;
    int *up = rb_alloc_int((size_t)a->cols);
    if (!up)
        return RB_ENOMEM;
    for (int j = 0; j < a->cols; j++)
        up[j] = j;
    for (int j = 0; j < a->cols; j++)
        for (int k = a->p[j]; k < a->p[j + 1]; k++) {
            const int x = find_root(up, a->i[k]), y = find_root(up, j);
            up[x > y ? x : y] = x > y ? y : x; /* the root is the smallest index */
        }
    for (int j = 0; j < a->cols; j++) {
        const int root = find_root(up, j);
        part[j] = root == j ? (*count)++ : part[root];
    }
    free(up);
    return RB_OK;
}
