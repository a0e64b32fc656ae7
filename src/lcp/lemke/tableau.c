/* The tableau of Lemke's method: basic variables = q + T (nonbasic variables), at first
 * w = q + M z + d z0.  A pivot on T_rc exchanges a basic and a nonbasic variable and changes all of
 * T by a product of rank one.  Most columns are not looked at between two pivots; so the pivots are
 * collected in blocks, and a column x is brought up to date when it is needed: its entries in the
 * rows of a block's pivots give s by the triangular system L s = x(rows), and behind the block it
 * is x - U s.  The whole tableau can be computed again from the data and the basis. */
#include "lcp/lemke/tableau.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A constant that a step brings to this part of itself was to vanish: kept, its rounding
 * error would break ties that are to be broken lexicographically. */
static const double SNAP = 1e-11;

/* Columns that stand nowhere in T. */
enum {
    UNTOUCHED = -1, /* as in the data: not copied before it changes */
    BORN = -2       /* pivot number `level` was on it, and what it was before is gone */
};

/* Pivots to a block, and columns that pass through the blocks together: products wide
 * enough to be fast, memory that small problems do not notice. */
enum { LARGEST_GROUP = 64 };

/* A column that fewer pivots than NEARBY have passed is formed on the spot.  Where it is
 * more than FAR pivots behind, the path is long enough for the largest group. */
enum { NEARBY = 20, FAR = 64 };

static int depth_of(int n)
{
    return n < 16 ? n : n < 512 ? 16 : 32;
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

static double *column_of(const lcp_tableau *t, int c)
{
    return t->T + (size_t)t->slot[c] * (size_t)t->n;
}

void rb_lcp_tableau_free(lcp_tableau *t)
{
    free(t->T);
    free(t->L);
    free(t->basis);
    free(t->row);
    memset(t, 0, sizeof *t);
}

void rb_lcp_tableau_no_pivots(lcp_tableau *t)
{
    for (int i = 0; i < t->n; i++)
        t->last[i] = -1;
    for (int c = 0; c <= t->n; c++)
        t->level[c] = 0;
    t->k = 0;
}

rb_status rb_lcp_tableau_create(const lcp_data *data, lcp_tableau *t)
{
    const int n = data->p.n, depth = depth_of(n), blocks = (n + depth - 1) / depth;
    memset(t, 0, sizeof *t);
    *t = (lcp_tableau){.n = n,
                       .data = data,
                       .depth = depth,
                       .capacity = blocks * depth,
                       .group = (n < 16     ? n + 1
                                 : n < 1024 ? depth_of(n)
                                            : LARGEST_GROUP)};
    const size_t rows = (size_t)n, capacity = (size_t)t->capacity, group = (size_t)t->group;
    t->T = rb_alloc(rows, rows + 2 + capacity + group);
    t->L = rb_alloc((size_t)depth, capacity + group);
    t->basis = rb_alloc_int(9 * rows + 6);
    t->row = rb_alloc_int(2 * capacity);
    if (!t->T || !t->L || !t->basis || !t->row) {
        rb_lcp_tableau_free(t);
        return RB_ENOMEM;
    }
    /* Few arrays: the system then keeps their memory for the next small problem. */
    t->q = t->T + (size_t)t->n * ((size_t)t->n + 1);
    t->U = t->q + t->n;
    t->X = t->U + (size_t)t->n * (size_t)t->capacity;
    t->S = t->L + (size_t)t->depth * (size_t)t->capacity;
    t->nonbasis = t->basis + t->n;
    t->place = t->nonbasis + t->n + 1;
    t->level = t->place + 2 * t->n + 1;
    t->slot = t->level + t->n + 1;
    t->spare = t->slot + t->n + 1;
    t->last = t->spare + t->n + 1;
    t->wanted = t->last + t->n;
    t->before = t->row + t->capacity;
    memcpy(t->q, t->data->p.q, (size_t)t->n * sizeof *t->q);
    for (int i = 0; i < t->n; i++)
        t->basis[i] = t->place[i] = i;
    for (int c = 0; c <= t->n; c++) {
        t->nonbasis[c] = t->n + c;
        t->place[t->n + c] = -1 - c;
        t->slot[c] = UNTOUCHED;
        t->spare[c] = t->n - c;
    }
    t->spares = t->n + 1;
    rb_lcp_tableau_no_pivots(t);
    return RB_OK;
}

/* ---- Columns ---------------------------------------------------------------------- */

/* x = T_:c after `level` pivots. */
static void load(const lcp_tableau *t, int c, double *x)
{
    const size_t n = (size_t)t->n;
    if (t->slot[c] >= 0) {
        memcpy(x, column_of(t, c), n * sizeof *x);
    } else if (t->slot[c] == BORN) {
        memset(x, 0, n * sizeof *x);
    } else if (c < t->n) {
        memcpy(x, t->data->p.M + (size_t)c * (size_t)t->data->p.ldm, n * sizeof *x);
    } else {
        for (int i = 0; i < t->n; i++)
            x[i] = rb_lcp_cover(t->data, i);
    }
}

/* Takes the rows of the pivots from `from` to before `to`, of one block, out of x: they
 * are the right-hand side for s. */
static void take_rows(const lcp_tableau *t, int from, int to, double *x, double *rhs)
{
    for (int j = from; j < to; j++)
        rhs[j - from] = t->before[j] < from ? x[t->row[j]] : 0.0;
    for (int j = from; j < to; j++)
        x[t->row[j]] = 0.0;
}

/* The same for column c, loaded into x. */
static void take_rows_of(const lcp_tableau *t, int c, int to, double *x, double *rhs)
{
    take_rows(t, t->level[c], to, x, rhs);
    if (t->slot[c] == BORN && to > t->level[c])
        rhs[0] = -1.0;
}

/* s from rhs, x -= U s; pivots from `from` to before `to`, of one block. */
static void apply(const lcp_tableau *t, int from, int to, double *s, double *x)
{
    const size_t depth = (size_t)t->depth, first = (size_t)(from - from % t->depth);
    const double *L = t->L + first * depth + ((size_t)from - first) * (depth + 1);
    cblas_dtrsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, to - from, L, t->depth, s,
                1);
    cblas_dgemv(CblasColMajor, CblasNoTrans, t->n, to - from, -1.0,
                t->U + (size_t)from * (size_t)t->n, t->n, s, 1, 1.0, x, 1);
}

static int end_of_block(const lcp_tableau *t, int pivot)
{
    return least(t->k, pivot - pivot % t->depth + t->depth);
}

void rb_lcp_tableau_column(lcp_tableau *t, int c, double *a)
{
    load(t, c, a);
    for (int from = t->level[c], to; from < t->k; from = to) {
        to = end_of_block(t, from);
        if (from == t->level[c])
            take_rows_of(t, c, to, a, t->S);
        else
            take_rows(t, from, to, a, t->S);
        apply(t, from, to, t->S, a);
    }
}

int rb_lcp_tableau_behind(const lcp_tableau *t, int c)
{
    return t->k - t->level[c];
}

static void advance_group(lcp_tableau *t, int count, const int *columns)
{
    const size_t n = (size_t)t->n;
    for (int g = 0; g < count; g++)
        load(t, columns[g], t->X + (size_t)g * n);
    const int level = t->level[columns[0]];
    for (int first = level - level % t->depth, to; first < t->k; first = to) {
        to = end_of_block(t, first);
        /* The columns of this block's share that begin in it or before: their right-hand
         * sides, zero where a column has seen the pivot. */
        int active = 0;
        for (; active < count && t->level[columns[active]] < to; active++) {
            const int c = columns[active], own = t->level[c];
            double *x = t->X + (size_t)active * (size_t)t->n,
                   *rhs = t->S + (size_t)active * (size_t)t->depth;
            if (own < first) {
                take_rows(t, first, to, x, rhs);
            } else {
                memset(rhs, 0, (size_t)(own - first) * sizeof *rhs);
                take_rows_of(t, c, to, x, rhs + (own - first));
            }
        }
        cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, to - first,
                    active, 1.0, t->L + (size_t)first * (size_t)t->depth, t->depth, t->S, t->depth);
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, t->n, active, to - first, -1.0,
                    t->U + (size_t)first * n, t->n, t->S, t->depth, 1.0, t->X, t->n);
    }
    for (int g = 0; g < count; g++) {
        /* Places are taken up again as soon as they are free: T stays small and warm. */
        const double *x = t->X + (size_t)g * n;
        if (t->slot[columns[g]] < 0)
            t->slot[columns[g]] = t->spare[--t->spares];
        memcpy(column_of(t, columns[g]), x, (size_t)t->n * sizeof *x);
        t->level[columns[g]] = t->k;
    }
}

void rb_lcp_tableau_advance(lcp_tableau *t, int count, int *columns)
{
    for (int done = 0; done < count; done += t->group) {
        const int size = least(t->group, count - done);
        /* Those that are farthest behind first (insertion: they come nearly in order). */
        int *column = columns + done;
        for (int i = 1; i < size; i++) {
            const int c = column[i];
            int j = i;
            for (; j > 0 && t->level[column[j - 1]] > t->level[c]; j--)
                column[j] = column[j - 1];
            column[j] = c;
        }
        advance_group(t, size, columns + done);
    }
}

/* A column enters the sum in the block in which it stands; before it, nothing of it is
 * changed. */
void rb_lcp_tableau_combine(lcp_tableau *t, const double *weight, double *scratch, double *x)
{
    const int n = t->n;
    double *s = t->S, *own = t->S + t->depth;
    memset(x, 0, (size_t)n * sizeof *x);
    for (int first = 0, to; first < t->k; first = to) {
        to = end_of_block(t, first);
        take_rows(t, first, to, x, s);
        for (int c = 0; c <= n; c++) {
            const int level = t->level[c];
            if (weight[c] == 0.0 || level < first || level >= to)
                continue;
            load(t, c, scratch);
            take_rows_of(t, c, to, scratch, own);
            cblas_daxpy(n, weight[c], scratch, 1, x, 1);
            cblas_daxpy(to - level, weight[c], own, 1, s + (level - first), 1);
        }
        apply(t, first, to, s, x);
    }
    for (int c = 0; c <= n; c++)
        if (weight[c] != 0.0 && t->level[c] == t->k) {
            load(t, c, scratch);
            cblas_daxpy(n, weight[c], scratch, 1, x, 1);
        }
}

void rb_lcp_tableau_flush(lcp_tableau *t)
{
    int columns[LARGEST_GROUP];
    for (int c = 0; c <= t->n; c += t->group) {
        const int count = least(t->group, t->n + 1 - c);
        for (int g = 0; g < count; g++)
            columns[g] = c + g;
        rb_lcp_tableau_advance(t, count, columns);
    }
    rb_lcp_tableau_no_pivots(t);
}

/* ---- Look-ahead ------------------------------------------------------------------- */

/* Columns in the order of increasing ratios, at most `capacity` of them. */
typedef struct {
    int count, capacity;
    int *column;
    double *ratio;
} shortlist;

static void insert(shortlist *k, int column, double ratio)
{
    if (k->count == k->capacity && ratio >= k->ratio[k->count - 1])
        return;
    int j = k->count < k->capacity ? k->count++ : k->capacity - 1;
    for (; j > 0 && k->ratio[j - 1] > ratio; j--) {
        k->ratio[j] = k->ratio[j - 1];
        k->column[j] = k->column[j - 1];
    }
    k->ratio[j] = ratio;
    k->column[j] = column;
}

void rb_lcp_tableau_fetch(lcp_tableau *t, int c, const double *driving)
{
    const int behind = rb_lcp_tableau_behind(t, c);
    if (behind <= NEARBY)
        return;
    if (!driving) {
        rb_lcp_tableau_advance(t, 1, &c);
        return;
    }
    const int capacity = behind > FAR || t->group < NEARBY ? t->group : NEARBY;
    shortlist k = {0, capacity, t->wanted, t->S};
    /* When a basic variable leaves, its complement enters, and the rows with the least
     * ratios are the next to leave.  The step of the last driving column has been taken
     * since, which changes all ratios alike. */
    insert(&k, c, -1.0);
    for (int i = 0; i < t->n; i++) {
        if (driving[i] >= 0.0 || t->basis[i] == 2 * t->n)
            continue;
        const int place = t->place[rb_lcp_complement(t->n, t->basis[i])];
        if (place < 0 && -1 - place != c)
            insert(&k, -1 - place, fmax(t->q[i], 0.0) / -driving[i]);
    }
    rb_lcp_tableau_advance(t, k.count, k.column);
}

/* ---- Pivots ----------------------------------------------------------------------- */

void rb_lcp_tableau_pivot(lcp_tableau *t, int r, int c, const double *a)
{
    const double step = t->q[r] / a[r];
    for (int i = 0; i < t->n; i++) {
        const double change = step * a[i], value = t->q[i] - change;
        t->q[i] = fabs(value) <= SNAP * fabs(change) ? 0.0 : value;
    }
    t->q[r] = -step;
    /* Pivot number k enters L and U. */
    const size_t n = (size_t)t->n, depth = (size_t)t->depth;
    const int k = t->k, first = k - k % t->depth;
    double *L = t->L + (size_t)first * depth + (k - first);
    for (int j = first; j < k; j++, L += depth) {
        double *u = t->U + (size_t)j * n + r;
        *L = *u;
        *u = 0.0;
    }
    *L = a[r];
    memcpy(t->U + (size_t)k * n, a, n * sizeof *a);
    t->U[(size_t)k * n + (size_t)r] = 1.0;
    t->row[k] = r;
    t->before[k] = t->last[r];
    t->last[r] = k;
    if (t->slot[c] >= 0)
        t->spare[t->spares++] = t->slot[c];
    t->slot[c] = BORN;
    t->level[c] = t->k++;
    const int leaving = t->basis[r], entering = t->nonbasis[c];
    t->basis[r] = entering;
    t->place[entering] = r;
    t->nonbasis[c] = leaving;
    t->place[leaving] = -1 - c;
    if (t->k == t->capacity)
        rb_lcp_tableau_flush(t);
}
