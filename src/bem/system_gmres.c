/* GMRES (Saad and Schultz) for a matrix that is assembled and not factored. On a free boundary the
 * equations are of the second kind, I/2 and a smooth kernel, and with the columns divided by the
 * diagonal those of a held one are not worse: 30 to 60 products for any number of elements, where
 * an LU costs as much as a third of so many products as there are unknowns. */
#include "bem/system.h"
#include "base/gmres.h"

#include <cblas.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 80 }; /* products */

/* Of the right-hand side: rounding, so that symmetric cases have symmetric answers. */
static const double TOLERANCE = 1e-13;

/* Rows follow the dofs, columns the unknowns, which are turned by `offset`: y becomes the rows in
 * the order of the columns. */
static void turn_rows(const rb_bem_system *s, const double *rows, double *y)
{
    const size_t offset = (size_t)s->offset, rest = (size_t)s->dofs - offset;

    memcpy(y, rows + offset, rest * sizeof *y);
    memcpy(y + rest, rows, offset * sizeof *y);
}

/* x = D^-1 v, D the entries of the columns in the rows that are turned to them. */
static void divide_by_diagonal(const rb_bem_system *s, const double *v, double *x)
{
    const size_t n = (size_t)s->dofs;

    for (size_t i = 0; i < n; i++)
        x[i] = v[i] / s->A[(i + (size_t)s->offset) % n + i * (size_t)s->ld];
}

rb_status rb_bem_system_iterate(const rb_bem_system *s, int columns, double *X)
{
    const int n = s->dofs;
    double *vectors = rb_alloc((size_t)n, MOST + 2), *product = vectors, *v[MOST + 1];
    rb_gmres g = {.n = n, .most = MOST, .v = v, .small = rb_alloc(RB_GMRES_SMALL(MOST), 1)};
    rb_status status = vectors && g.small ? RB_OK : RB_ENOMEM;

    for (int k = 0; status == RB_OK && k <= MOST; k++)
        v[k] = vectors + (size_t)(k + 1) * (size_t)n;
    for (int c = 0; c < columns && status == RB_OK; c++) {
        double *x = X + (size_t)c * (size_t)s->ld;
        turn_rows(s, x, v[0]);
        const double norm = rb_gmres_begin(&g);
        double left = norm;

        /* The next vector: A D^-1 v. */
        while (left > TOLERANCE * norm && g.used < MOST) {
            double *next = v[g.used + 1];
            divide_by_diagonal(s, v[g.used], next);
            cblas_dgemv(CblasColMajor, CblasNoTrans, n, n, 1.0, s->A, s->ld, next, 1, 0.0, product,
                        1);
            turn_rows(s, product, next);
            left = rb_gmres_step(&g);
        }
        if (!(left <= TOLERANCE * norm)) {
            status = RB_MAXITER;
            break;
        }
        rb_gmres_combine(&g, product);
        divide_by_diagonal(s, product, x);
    }
    free(vectors);
    free(g.small);
    return status;
}
