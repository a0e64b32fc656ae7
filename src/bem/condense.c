/* Condensation of a mixed system to its contact (B5): the displacements of the contact elements,
 * and of the upstream one, under a unit traction on each contact element in turn are the columns of
 * the flexibility F, w = w0 + F r.  The singular part of each load is in closed form if required
 * (B10). */
#include "bem/system.h"
#include "base/sizes.h"
#include "bem/internal.h"
#include "bem/large.h"
#include "bem/subtracted.h"
#include "base/blas.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Displacements of the contact and of the upstream element, the last 2m unknowns, for so many
 * contact tractions and (last column) for the given values: all of L, but of U only the last
 * corner. */
static rb_status solve_contact(const rb_bem_system *s, int loads, double *X)
{
    if (!s->A)
        return rb_bem_system_solve_columns(s, loads + 1, X);
    if (s->is_assembled)
        return rb_bem_system_iterate(s, loads + 1, X);
    const int n = s->dofs, ld = s->ld, kept = 2 * (s->mesh.contact_n + 1);
    const size_t rows = (size_t)ld, corner = (size_t)(n - kept);
    const int threads = rb_blas_threads(n >= RB_BEM_LU_THREADS_FROM ? 0 : 1);

    LAPACKE_dlaswp_work(LAPACK_COL_MAJOR, loads + 1, X, ld, 1, n, s->pivot, 1);
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasUnit, n, loads + 1, 1.0,
                s->A, ld, X, ld);
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasUpper, CblasNoTrans, CblasNonUnit, kept, loads + 1,
                1.0, s->A + corner * (rows + 1), ld, X + corner, ld);
    rb_blas_threads(threads);
    return RB_OK;
}

void rb_bem_contact_frame(const rb_bem_mesh *mesh, int j, rb_bem_normals normals,
                          double frame[2][2])
{
    const double dx = mesh->x1[j] - mesh->x0[j], dy = mesh->y1[j] - mesh->y0[j], h = hypot(dx, dy);
    const int flat = normals == RB_BEM_NORMALS_OBSTACLE;
    frame[1][0] = frame[0][1] = flat ? 1.0 : dx / h;
    frame[1][1] = flat ? 0.0 : dy / h;
    frame[0][0] = -frame[1][1];
}

/* Loads of the contact, given values in the last column: the right-hand sides, solved.  (B10) Where
 * singularities are subtracted each contact element has the half-plane's solution of its load,
 * whose logarithm at the ends of the element constant elements resolve badly; then R may combine
 * the unit tractions, otherwise NULL. */
static rb_status solve_loads(const rb_bem_system *s, int subtract, int loads, const double *R,
                             double *X)
{
    const size_t rows = (size_t)s->ld;
    rb_subtracted *p = NULL;
    rb_status status = subtract ? rb_subtracted_create(s, &p) : RB_OK;

    memcpy(X + rows * (size_t)loads, s->b, (size_t)s->dofs * sizeof *X);
    if (status == RB_OK && p)
        status = rb_subtracted_loads(p, loads, R, X);
    else if (status == RB_OK)
        memcpy(X, s->Gc, rows * (size_t)loads * sizeof *X);
    if (status == RB_OK)
        status = solve_contact(s, loads, X);
    if (status == RB_OK && p)
        status = rb_subtracted_add_strips(p, loads, R, X);
    if (p)
        rb_subtracted_free(p);
    return status;
}

static rb_status not_condensed(rb_status s, int n, rb_message *why)
{
    return s == RB_INTERRUPTED
               ? rb_fail(why, s, "condensation: interrupted")
               : rb_fail(why, s, "condensation: out of memory for %d contact elements", n);
}

/* (B5), main steps: right-hand sides, solve, rotate into the contact frame. */
static rb_status condense(const rb_bem_system *system, rb_bem_normals normals, int subtract,
                          rb_bem_flexibility *f, rb_message *why)
{
    const rb_bem_mesh *mesh = &system->mesh;
    const int n = mesh->contact_n, m = n + 1, first = mesh->contact_first;
    const size_t ld = (size_t)system->ld;
    double *F = NULL, *X = NULL;

    *f = (rb_bem_flexibility){0};
    if (n < 1)
        return rb_fail(why, RB_EINVAL, "condensation: the mesh has no contact elements");
    rb_phase("flexibility of the contact");
    /* A X = [Gc, b]: two unit tractions on each contact element, and the given values. */
    X = rb_large_alloc(ld, 2 * (size_t)n + 1);
    rb_status s = X ? solve_loads(system, subtract, 2 * n, NULL, X) : RB_ENOMEM;
    if (s == RB_OK)
        s = rb_bem_flexibility_dense(n, f, &F);
    if (s != RB_OK)
        not_condensed(s, n, why);
    /* U(i, j), 2 x 2, is the displacement of element i due to the tractions on element j in x and
     * y, the last 2 m rows of X.  In the contact frame of section 2, whose axes e_N and e_T belong
     * to each element, F_ab(i, j) = e_a(i)' U(i, j) e_b(j), a, b in {N, T}; the last column of X
     * gives w0, the displacement due to what is given elsewhere. */
    for (int i = 0; s == RB_OK && i < m; i++) {
        const double *U = X + system->dofs - 2 * m + 2 * i, *w0 = U + 2 * (size_t)n * ld;
        const int element = first + i;
        double to[2][2], from[2][2];
        rb_bem_contact_frame(mesh, element, normals, to);
        f->x[i] = 0.5 * (mesh->x0[element] + mesh->x1[element]);
        f->h[i] = rb_bem_mesh_length(mesh, element);
        for (int a = 0; a < 2; a++)
            f->w0[a * m + i] = to[a][0] * w0[0] + to[a][1] * w0[1];
        for (int j = 0; j < n; j++) {
            const double *x = U + 2 * (size_t)j * ld, *y = x + ld;
            rb_bem_contact_frame(mesh, first + j, normals, from);
            for (int a = 0; a < 2; a++)
                for (int b = 0; b < 2; b++)
                    F[(size_t)(a * m + i) + (size_t)(b * n + j) * 2 * (size_t)m] =
                        to[a][0] * (x[0] * from[b][0] + y[0] * from[b][1]) +
                        to[a][1] * (x[1] * from[b][0] + y[1] * from[b][1]);
        }
    }
    free(X);
    return s;
}

rb_status rb_bem_condense(const rb_bem_system *system, rb_bem_normals normals,
                          rb_bem_flexibility *f, rb_message *why)
{
    return condense(system, normals, 0, f, why);
}

rb_status rb_bem_condense_subtracted(const rb_bem_system *system, rb_bem_normals normals,
                                     rb_bem_flexibility *f, rb_message *why)
{
    const rb_status s = rb_bem_check_convex(system, why);

    if (s == RB_OK)
        return condense(system, normals, 1, f, why);
    *f = (rb_bem_flexibility){0};
    return s;
}

rb_status rb_bem_displacement_subtracted(rb_bem_system *system, rb_bem_normals normals, int loads,
                                         const double *r, double *w, double *w0, rb_message *why)
{
    const rb_bem_mesh *mesh = &system->mesh;
    const int n = mesh->contact_n, m = n + 1, first = mesh->contact_first;
    const size_t ld = (size_t)system->ld, units = 2 * (size_t)n;
    rb_status s = rb_bem_check_convex(system, why);

    if (s != RB_OK)
        return s;
    double *R = rb_alloc(units, (size_t)loads), *X = rb_large_alloc(ld, (size_t)loads + 1),
           to[2][2];
    s = R && X ? RB_OK : RB_ENOMEM;
    /* From normal and tangential tractions to x and y. */
    for (int i = 0; i < n && s == RB_OK; i++) {
        rb_bem_contact_frame(mesh, first + i, normals, to);
        for (size_t l = 0; l < (size_t)loads; l++)
            for (int d = 0; d < 2; d++)
                R[2 * i + d + l * units] =
                    to[0][d] * r[i + l * units] + to[1][d] * r[n + i + l * units];
    }
    if (s == RB_OK)
        s = solve_loads(system, 1, loads, R, X);
    /* A few loads are solved by GMRES without an LU; where it does not converge, with one. */
    if (s == RB_MAXITER) {
        s = rb_bem_system_factor(system, why);
        if (s == RB_OK)
            s = solve_loads(system, 1, loads, R, X);
    }
    /* And back: w of the loads, w0 of the given values, the last column. */
    for (int i = 0; i < m && s == RB_OK; i++) {
        const double *U = X + system->dofs - 2 * m + 2 * i;
        rb_bem_contact_frame(mesh, first + i, normals, to);
        for (size_t l = 0; l <= (size_t)loads; l++)
            for (int a = 0; a < 2; a++)
                (l < (size_t)loads ? w + l * 2 * (size_t)m : w0)[a * m + i] =
                    to[a][0] * U[l * ld] + to[a][1] * U[l * ld + 1];
    }
    free(R);
    free(X);
    return s == RB_OK ? s : not_condensed(s, n, why);
}
