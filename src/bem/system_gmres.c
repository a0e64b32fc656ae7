/* GMRES (Saad and Schultz) for a matrix that is assembled and not factored. On a free boundary the
 * equations are of the second kind, I/2 and a smooth kernel, and with the columns divided by the
 * diagonal those of a held one are not worse: 30 to 60 products for any number of elements, where
 * an LU costs as much as a third of so many products as there are unknowns. */
#include "bem/system.h"

#include <cblas.h>
#include <math.h>
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

rb_status rb_bem_system_iterate(const rb_bem_system *s, int columns, double *X)
{
    const int n = s->dofs;
    const size_t size = (size_t)n;
    double *V = rb_alloc(size, MOST + 1), *R = rb_alloc(MOST + 1, MOST),
           *product = rb_alloc(size, 1), cosine[MOST], sine[MOST], y[MOST + 1];
    rb_status status = V && R && product ? RB_OK : RB_ENOMEM;

    for (int c = 0; c < columns && status == RB_OK; c++) {
        double *x = X + (size_t)c * (size_t)s->ld;
        turn_rows(s, x, V);
        const double norm = cblas_dnrm2(n, V, 1);
        int k = 0;

        if (norm == 0.0) /* and so is x */
            continue;
        y[0] = norm;
        cblas_dscal(n, 1.0 / norm, V, 1);
        for (; k < MOST && fabs(y[k]) > TOLERANCE * norm; k++) {
            /* The next basis vector: A D^-1 v, orthogonal to those before. */
            double *v = V + (size_t)k * size, *next = v + size,
                   *column = R + (size_t)k * (MOST + 1);
            for (size_t i = 0; i < size; i++)
                next[i] = v[i] / s->A[(i + (size_t)s->offset) % size + i * (size_t)s->ld];
            cblas_dgemv(CblasColMajor, CblasNoTrans, n, n, 1.0, s->A, s->ld, next, 1, 0.0, product,
                        1);
            turn_rows(s, product, next);
            for (int j = 0; j <= k; j++) {
                column[j] = cblas_ddot(n, V + (size_t)j * size, 1, next, 1);
                cblas_daxpy(n, -column[j], V + (size_t)j * size, 1, next, 1);
            }
            const double below = cblas_dnrm2(n, next, 1);
            cblas_dscal(n, below > 0.0 ? 1.0 / below : 0.0, next, 1);
            /* Hessenberg's matrix to a triangle by rotations; y: the right-hand side, whose last
             * entry is what is left. */
            for (int j = 0; j < k; j++)
                cblas_drot(1, column + j, 1, column + j + 1, 1, cosine[j], sine[j]);
            const double length = hypot(column[k], below);
            cosine[k] = column[k] / length;
            sine[k] = below / length;
            column[k] = length;
            y[k + 1] = -sine[k] * y[k];
            y[k] *= cosine[k];
        }
        if (!(fabs(y[k]) <= TOLERANCE * norm)) {
            status = RB_MAXITER;
            break;
        }
        cblas_dtrsv(CblasColMajor, CblasUpper, CblasNoTrans, CblasNonUnit, k, R, MOST + 1, y, 1);
        cblas_dgemv(CblasColMajor, CblasNoTrans, n, k, 1.0, V, n, y, 1, 0.0, product, 1);
        for (size_t i = 0; i < size; i++)
            x[i] = product[i] / s->A[(i + (size_t)s->offset) % size + i * (size_t)s->ld];
    }
    free(V);
    free(R);
    free(product);
    return status;
}
