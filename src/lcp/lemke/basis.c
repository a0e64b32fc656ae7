/* The basis of Lemke's method on sparse matrices: LU and product form of the inverse.
 * Of w = q + M z + d t the basic variables are some w, some z (their set is F) and mostly t.  In
 * the rows R whose w is not basic, w = 0, stand equations for z_F and t alone, [M_RF d_R] x = -g_R;
 * the other w follow by products.  So the LU has the order of the z that are not zero. */
#include "lcp/lemke/basis.h"

#include <stdlib.h>
#include <string.h>

/* Exchanges before a new LU at the latest: their rounding errors add up. */
enum { MOST_EXCHANGES = 200 };

/* ---- Memory ------------------------------------------------------------------------ */

rb_status rb_lcp_basis_create(const rb_sparse *M, lcp_basis *b)
{
    const size_t n = (size_t)M->rows, nz = (size_t)M->p[M->cols];
    *b = (lcp_basis){.n = M->rows, .M = M};
    rb_arena *memory = &b->memory;
    b->d = rb_arena_doubles(memory, n, 1);
    b->g = rb_arena_doubles(memory, n, 1);
    b->rhs = rb_arena_doubles(memory, n, 1);
    b->x = rb_arena_doubles(memory, n, 1);
    b->variable = rb_arena_ints(memory, n);
    b->slot = rb_arena_ints(memory, 2 * n + 1);
    b->row = rb_arena_ints(memory, n);
    b->position = rb_arena_ints(memory, n);
    b->A.p = rb_arena_ints(memory, n + 2);
    b->A.i = rb_arena_ints(memory, nz + n + 1);
    b->A.x = rb_arena_doubles(memory, nz + n + 1, 1);
    b->pivot = rb_arena_ints(memory, MOST_EXCHANGES);
    b->scale = rb_arena_doubles(memory, MOST_EXCHANGES, 1);
    b->start = rb_arena_zeros(memory, MOST_EXCHANGES + 1, sizeof *b->start);
    return memory->failed ? RB_ENOMEM : RB_OK;
}

void rb_lcp_basis_free(lcp_basis *b)
{
    rb_sparse_lu_free(b->lu);
    free(b->index);
    free(b->value);
    rb_arena_free(&b->memory);
    *b = (lcp_basis){0};
}

/* ---- LU ---------------------------------------------------------------------------- */

rb_status rb_lcp_basis_factor(lcp_basis *b)
{
    rb_sparse_lu_free(b->lu);
    b->lu = NULL;
    b->exchanges = 0;
    b->pending = b->work = 0.0;
    /* Slot i is the place of the pair i; t takes that of the pair without a basic
     * variable. R, in the same order. */
    const int n = b->n, t = 2 * n, t_basic = b->slot[t] >= 0;
    b->A.rows = 0;
    for (int i = 0; i < n; i++) {
        const int w = b->slot[i] >= 0, z = b->slot[n + i] >= 0;
        b->variable[i] = w ? i : z || !t_basic ? n + i : t;
        b->position[i] = w ? -1 : b->A.rows;
        if (!w)
            b->row[b->A.rows++] = i;
    }
    for (int i = 0; i < n; i++)
        b->slot[b->variable[i]] = i;
    b->A.cols = b->A.rows;
    b->place_of_t = b->slot[2 * b->n];
    /* A = [M_RF d_R], the column of t in the place of the pair that it stands for. */
    rb_sparse *A = &b->A;
    const rb_sparse *M = b->M;
    int nz = 0;
    for (int c = 0; c < A->cols; c++) {
        const int j = b->row[c];
        A->p[c] = nz;
        if (j == b->place_of_t) {
            for (int r = 0; r < A->rows; r++)
                if (b->d[b->row[r]] != 0.0) {
                    A->i[nz] = r;
                    A->x[nz++] = b->d[b->row[r]];
                }
            continue;
        }
        for (int k = M->p[j]; k < M->p[j + 1]; k++)
            if (b->position[M->i[k]] >= 0) {
                A->i[nz] = b->position[M->i[k]];
                A->x[nz++] = M->x[k];
            }
    }
    A->p[A->cols] = nz;
    if (b->A.rows == 0)
        return RB_OK;
    rb_status s = rb_sparse_lu_create(&b->A, &b->lu);
    if (s == RB_OK)
        s = rb_sparse_lu_factor(b->lu, &b->A, &b->work);
    /* ordering and analysis take as long as so many operations per entry */
    if (s == RB_OK)
        b->work += 150.0 * rb_sparse_lu_entries(b->lu);
    b->operations += b->work;
    return s;
}

int rb_lcp_basis_is_long(const lcp_basis *b)
{
    return b->exchanges == MOST_EXCHANGES || b->pending > b->work + 1e3;
}

/* ---- Solving ----------------------------------------------------------------------- */

rb_status rb_lcp_basis_solve(lcp_basis *b, const double *g, int refined, double *y)
{
    /* y = B^-1 g with the last LU: A x = -g_R, and w_i = g_i + M_iF z_F + d_i t elsewhere. */
    const rb_sparse *M = b->M;
    const int m = b->A.rows;
    for (int k = 0; k < m; k++)
        b->rhs[k] = -g[b->row[k]];
    const rb_status s = m == 0    ? RB_OK
                        : refined ? rb_sparse_lu_solve(b->lu, b->rhs, b->x)
                                  : rb_sparse_lu_solve_once(b->lu, b->rhs, b->x);
    if (s == RB_OK)
        memcpy(y, g, (size_t)b->n * sizeof *y);
    for (int c = 0; s == RB_OK && c < m; c++) {
        const int j = b->row[c];
        if (j == b->place_of_t)
            for (int i = 0; i < b->n; i++)
                y[i] += b->d[i] * b->x[c];
        else
            for (int k = M->p[j]; k < M->p[j + 1]; k++)
                y[M->i[k]] += M->x[k] * b->x[c];
    }
    for (int k = 0; s == RB_OK && k < m; k++)
        y[b->row[k]] = b->x[k];
    /* The exchanges since: each is one elimination step with the column that entered. */
    for (int k = 0; s == RB_OK && k < b->exchanges; k++) {
        const double x = y[b->pivot[k]] /= b->scale[k];
        if (x == 0.0)
            continue;
        for (size_t e = b->start[k]; e < b->start[k + 1]; e++)
            y[b->index[e]] -= b->value[e] * x;
    }
    b->pending += 2.0 * (double)b->start[b->exchanges];
    b->operations += 2.0 * (double)b->start[b->exchanges];
    b->operations += b->lu ? 2.0 * rb_sparse_lu_entries(b->lu) : 0.0;
    return s;
}

rb_status rb_lcp_basis_column(lcp_basis *b, int variable, double *y)
{
    const int n = b->n;
    const rb_sparse *M = b->M;
    memset(b->g, 0, (size_t)n * sizeof *b->g);
    if (variable < n)
        b->g[variable] = 1.0;
    else
        for (int k = M->p[variable - n]; k < M->p[variable - n + 1]; k++)
            b->g[M->i[k]] = -M->x[k];
    return rb_lcp_basis_solve(b, b->g, 0, y);
}

/* ---- Exchanges --------------------------------------------------------------------- */

/* Keeps the entering column y = B^-1 a: the new basis is B E, E the unit matrix with y in the place
 * of column `slot`, so that B_new^-1 g = E^-1 (B^-1 g). */
rb_status rb_lcp_basis_exchange(lcp_basis *b, int slot, int variable, const double *y)
{
    const int k = b->exchanges;
    const size_t wanted = b->start[k] + (size_t)b->n;
    if (wanted > b->capacity) {
        int *index = realloc(b->index, 2 * wanted * sizeof *index);
        b->index = index ? index : b->index;
        double *value = realloc(b->value, 2 * wanted * sizeof *value);
        b->value = value ? value : b->value;
        if (!index || !value)
            return RB_ENOMEM;
        b->capacity = 2 * wanted;
    }
    size_t at = b->start[k];
    for (int s = 0; s < b->n; s++)
        if (y[s] != 0.0 && s != slot) {
            b->index[at] = s;
            b->value[at++] = y[s];
        }
    b->pivot[k] = slot;
    b->scale[k] = y[slot];
    b->start[k + 1] = at;
    b->exchanges = k + 1;
    b->slot[b->variable[slot]] = -1;
    b->slot[variable] = slot;
    b->variable[slot] = variable;
    return RB_OK;
}
