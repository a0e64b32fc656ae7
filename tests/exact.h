/* Complementarity problems of small integers without rounding: fraction-free elimination in
 * integers of 128 bits. */
#ifndef ROLLBEM_TESTS_EXACT_H
#define ROLLBEM_TESTS_EXACT_H

#include <math.h>
#include <string.h>

enum { EXACT_MOST = 8 };
__extension__ typedef __int128 exact_whole;

typedef struct {
    int n, M[EXACT_MOST][EXACT_MOST], q[EXACT_MOST];
} exact_lcp;

/* The solutions that are found: z over a common denominator, by doubles. */
typedef struct {
    int count;
    double z[4096][EXACT_MOST];
} exact_list;

/* A (rows x columns and a right-hand side) by Bareiss' elimination; 1: it has exactly one
 * solution x / *over, *over > 0.  A is overwritten. */
static int exact_solve(int rows, int columns, exact_whole A[EXACT_MOST][EXACT_MOST + 1],
                       exact_whole *x, exact_whole *over)
{
    exact_whole last = 1;
    for (int c = 0; c < columns; c++) {
        int r = c;
        while (r < rows && A[r][c] == 0)
            r++;
        if (r >= rows)
            return 0;
        for (int j = 0; j <= columns; j++) {
            const exact_whole t = A[r][j];
            A[r][j] = A[c][j];
            A[c][j] = t;
        }
        for (int i = 0; i < rows; i++) {
            if (i == c)
                continue;
            for (int j = columns; j >= 0; j--)
                if (j != c)
                    A[i][j] = (A[c][c] * A[i][j] - A[i][c] * A[c][j]) / last;
            A[i][c] = 0;
        }
        for (int i = 0; i < c; i++)
            A[i][i] = A[c][c];
        last = A[c][c];
    }
    for (int i = columns; i < rows; i++)
        if (A[i][columns] != 0)
            return 0;
    *over = last;
    for (int c = 0; c < columns; c++)
        x[c] = last > 0 ? A[c][columns] : -A[c][columns];
    *over = last > 0 ? last : -last;
    return 1;
}

/* z with the z of the set S positive or zero, the w of T positive or zero, all others zero: 1
 * where there is exactly one, and it is a solution. */
static int exact_point(const exact_lcp *p, int S, int T, double *z)
{
    exact_whole A[EXACT_MOST][EXACT_MOST + 1], x[EXACT_MOST], over = 1;
    int column[EXACT_MOST], columns = 0, rows = 0;
    for (int j = 0; j < p->n; j++)
        if (S >> j & 1)
            column[columns++] = j;
    for (int i = 0; i < p->n; i++) {
        if (T >> i & 1)
            continue;
        for (int c = 0; c < columns; c++)
            A[rows][c] = p->M[i][column[c]];
        A[rows++][columns] = -p->q[i];
    }
    if (rows < columns || !exact_solve(rows, columns, A, x, &over))
        return 0;
    for (int c = 0; c < columns; c++)
        if (x[c] < 0)
            return 0;
    for (int i = 0; i < p->n; i++) {
        exact_whole w = p->q[i] * over;
        for (int c = 0; c < columns; c++)
            w += p->M[i][column[c]] * x[c];
        if (T >> i & 1 ? w < 0 : w != 0)
            return 0;
    }
    memset(z, 0, EXACT_MOST * sizeof *z);
    for (int c = 0; c < columns; c++)
        z[column[c]] = (double)((long double)x[c] / (long double)over);
    return 1;
}

static void exact_keep(int n, const double *z, exact_list *list)
{
    for (int k = 0; k < list->count; k++) {
        double apart = 0.0;
        for (int i = 0; i < n; i++)
            apart = fmax(apart, fabs(z[i] - list->z[k][i]) / fmax(1e-3, fabs(z[i])));
        if (apart < 1e-12)
            return;
    }
    memcpy(list->z[list->count++], z, EXACT_MOST * sizeof *z);
}

/* of_bases: the solutions of bases that are regular; all: those of all sets of columns that
 * do not depend on each other, which have a solution if there is any (Caratheodory). */
static inline void exact_solutions(const exact_lcp *p, exact_list *of_bases, exact_list *all)
{
    double z[EXACT_MOST];
    const int full = (1 << p->n) - 1;
    of_bases->count = all->count = 0;
    for (int S = 0; S <= full; S++) {
        if (exact_point(p, S, full & ~S, z))
            exact_keep(p->n, z, of_bases);
        for (int T = full & ~S;; T = (T - 1) & full & ~S) {
            if (exact_point(p, S, T, z))
                exact_keep(p->n, z, all);
            if (T == 0)
                break;
        }
    }
}

#endif
