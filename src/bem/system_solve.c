/* Displacements and tractions of all elements, from a system that is factored: x, the unknowns, and
 * what the conditions give. */
#include "bem/assemble.h"
#include "bem/bond.h"
#include "bem/hierarchical/hierarchical.h"
#include "bem/system.h"
#include "base/blas.h"

#include <cblas.h>
#include <lapacke.h>
#include <stdlib.h>
#include <string.h>

rb_status rb_bem_system_solve_columns(const rb_bem_system *s, int columns, double *X)
{
    if (!s->A) { /* a hierarchical matrix */
        /* Solutions come in the order of the dofs, the unknowns are turned by `offset`. */
        const size_t dofs = (size_t)s->dofs, offset = (size_t)s->offset;
        double *turned = rb_alloc(dofs, 1);
        rb_status status = turned ? rb_hierarchical_solve(s->h, columns, X) : RB_ENOMEM;

        for (int k = 0; k < columns && status == RB_OK; k++) {
            double *x = X + (size_t)k * dofs;
            memcpy(turned, x + offset, (dofs - offset) * sizeof *x);
            memcpy(turned + dofs - offset, x, offset * sizeof *x);
            memcpy(x, turned, dofs * sizeof *x);
        }
        free(turned);
        return status;
    }
    LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', s->dofs, columns, s->A, s->ld, s->pivot, X, s->dofs);
    return RB_OK;
}

/* x: the right-hand side b of A x = b (B4), then the unknowns, which are displacements where the
 * traction is given and tractions, counted in `unit`, where the displacement is. */
static rb_status solve_values(const rb_bem_system *s, double *x, const double *value, double *u,
                              double *t)
{
    const rb_status status = rb_bem_system_solve_columns(s, 1, x);

    if (status == RB_OK) {
        /* x -> u and t: what was given (value), what was solved for. */
        for (int dof = 0; dof < s->dofs; dof++) {
            const double unknown = x[(dof - s->offset + s->dofs) % s->dofs];
            const int held = s->mesh.condition[dof] == RB_BEM_DISPLACEMENT;
            u[dof] = held ? value[dof] : unknown;
            t[dof] = held ? s->unit[dof / 2] * unknown : value[dof];
        }
        /* On a bonded core the interface moves by the core's own flexibility C, u = -C t. */
        if (s->bond) {
            const int from = 2 * s->bond->first, n = 2 * s->bond->n;
            cblas_dgemv(CblasColMajor, CblasNoTrans, n, n, -1.0, s->bond->C, n, t + from, 1, 1.0,
                        u + from, 1);
        }
    }
    return status;
}

rb_status rb_bem_system_solve(const rb_bem_system *system, const double *t_contact, double *u,
                              double *t)
{
    const rb_bem_system *s = system;
    const int n = s->dofs, loads = 2 * s->mesh.contact_n;
    double *x = rb_alloc((size_t)n, 2);
    if (!x)
        return RB_ENOMEM;
    double *value = x + n;
    /* b + Gc t_c: contact tractions are a load like any other (B5). */
    memcpy(x, s->b, (size_t)n * sizeof *x);
    memcpy(value, s->mesh.value, (size_t)n * sizeof *value);
    for (int k = 0; k < loads; k++)
        value[2 * s->mesh.contact_first + k] = t_contact ? t_contact[k] : 0.0;
    if (t_contact && loads)
        cblas_dgemv(CblasColMajor, CblasNoTrans, n, loads, 1.0, s->Gc, s->ld, t_contact, 1, 1.0, x,
                    1);
    const rb_status status = solve_values(s, x, value, u, t);
    free(x);
    return status;
}

rb_status rb_bem_system_solve_values(const rb_bem_system *s, const double *value, double *u,
                                     double *t)
{
    double *x = rb_alloc((size_t)s->dofs, 1);
    rb_assembly assembly;
    rb_status status = x ? rb_assembly_begin(&s->mesh, s->material, &assembly) : RB_ENOMEM;

    if (status == RB_OK) {
        status = rb_assembly_add_given(&assembly, value, x);
        rb_assembly_end(&assembly);
    }
    if (status == RB_OK)
        status = solve_values(s, x, value, u, t);
    free(x);
    return status;
}
