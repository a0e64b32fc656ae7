/* Mixed problems (B4).  In each direction of each element the traction is given or the displacement
 * is; the columns of what is unknown, of H for displacements and of -G for tractions, make the
 * square matrix A, what is given the right-hand side b: A x = b, factored once.  Contact tractions
 * come later: Gc keeps their columns of G. */
#include "bem/system.h"
#include "base/sizes.h"
#include "bem/assemble.h"
#include "bem/bond.h"
#include "bem/hierarchical/hierarchical.h"
#include "bem/incompressible.h"
#include "bem/internal.h"
#include "base/blas.h"
#include "bem/large.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A with the contact's columns, and what condensing adds, of 2 n unknowns and 2 n_c loads. */
static double dense_bytes(int n, int n_c)
{
    const double dofs = 2.0 * n, loads = 2.0 * n_c;
    const double system = dofs * (dofs + loads), condensation = (dofs + loads) * loads;
    return sizeof(double) * (system + condensation);
}

/* Of a boundary without its matrix.  Measured on wheels (docs/performance.md), and the contact's
 * columns twice. */
static double hierarchical_bytes(int n, int n_c)
{
    return 6000.0 * n + sizeof(double) * 8.0 * n * n_c;
}

double rb_bem_system_bytes(int n, int n_c)
{
    return n < RB_BEM_HIERARCHICAL ? dense_bytes(n, n_c) : hierarchical_bytes(n, n_c);
}

void rb_bem_system_free(rb_bem_system *system)
{
    if (!system)
        return;
    rb_bem_mesh_free(&system->mesh);
    free(system->A);
    if (system->h)
        rb_hierarchical_free(system->h);
    if (system->bond)
        rb_bond_free(system->bond);
    free(system->b);
    free(system->Gc);
    free(system->unit);
    free(system->pivot);
    free(system);
}

const rb_bem_mesh *rb_bem_system_mesh(const rb_bem_system *system)
{
    return &system->mesh;
}

double rb_bem_system_rcond(const rb_bem_system *system)
{
    return system->rcond;
}

void rb_bem_system_seconds(const rb_bem_system *system, double *assembly, double *factor)
{
    *assembly = system->seconds_assembly;
    *factor = system->seconds_factor;
}

/* A, b and Gc from the columns of H and G (B4). */
static rb_status assemble(rb_bem_system *s)
{
    const rb_bem_mesh *mesh = &s->mesh;
    rb_assembly assembly;
    rb_status status = rb_assembly_begin(mesh, s->material, &assembly);
    if (status != RB_OK)
        return status;
    /* An unknown traction is counted in mu/h, so that the columns of G are of the size of those of
     * H whatever the units: the condition of A does not depend on them. */
    for (int j = 0; j < mesh->n; j++)
        s->unit[j] = s->material.shear / rb_bem_mesh_length(mesh, j);
    int stop = 0;
#pragma omp parallel for num_threads(rb_blas_loop_threads())                                       \
    schedule(static) if ((double)mesh->n * mesh->n > rb_pairs_for_threads)
    for (int j = 0; j < mesh->n; j++) {
        /* The unknowns' columns go into A: H where the displacement is unknown, -G where the
         * traction is.  A contact element has both: its displacement in A, its traction as a load
         * in Gc. */
        const rb_bem_condition *condition = mesh->condition + 2 * j;
        double *H[2] = {NULL, NULL}, *G[2] = {NULL, NULL}, G_factor = 1.0;
        if ((!s->A && condition[0] != RB_BEM_CONTACT) || rb_interrupted_in_loop(&stop))
            continue;
        for (int k = 0; k < 2; k++) {
            if (s->A && condition[k] == RB_BEM_DISPLACEMENT) {
                G[k] = rb_bem_system_column(s, 2 * j + k);
                G_factor = -s->unit[j];
            } else if (s->A) {
                H[k] = rb_bem_system_column(s, 2 * j + k);
            }
            /* The traction of a contact element is a load: its column of G is kept apart. */
            if (condition[k] == RB_BEM_CONTACT)
                G[k] = s->Gc + (2 * (size_t)(j - mesh->contact_first) + (size_t)k) * (size_t)s->ld;
        }
        rb_assembly_columns(&assembly, j, G_factor, (double *const[4]){H[0], H[1], G[0], G[1]});
    }
    /* A bonded core and the given values, which move to the right-hand side. */
    status = stop ? RB_INTERRUPTED : s->bond ? rb_bond_add(s, &assembly) : RB_OK;
    if (status == RB_OK)
        status = rb_assembly_add_given(&assembly, s->mesh.value, s->b);
    rb_assembly_end(&assembly);
    /* Of an incompressible body inside a contour that is held everywhere a uniform pressure moves
     * nothing: a term on those columns fixes it. */
    if (status == RB_OK && s->A) {
        rb_held_contours held;
        status = rb_held_contours_find(mesh, s->material, &held);
        for (int j = 0; held.count && j < s->dofs; j++)
            for (int i = 0; held.contour[j / 2] >= 0 && i < s->dofs; i++)
                rb_bem_system_column(s, j)[i] += rb_held_contours_term(&held, i, j);
        rb_held_contours_free(&held);
    }
    return status;
}

/* A = L U, or its hierarchical form without the matrix, whose condition is not known. */
rb_status rb_bem_system_factor(rb_bem_system *s, rb_message *why)
{
    s->is_assembled = 0;
    if (s->A) {
        /* The 1-norm of A, for the estimate of its condition: a system is singular if that leaves
         * no digit. */
        const lapack_int n = s->dofs;
        double norm = 0.0;
#pragma omp parallel for num_threads(rb_blas_loop_threads())                                       \
    reduction(max                                                                                  \
              : norm) if (0.25 * n * n > rb_pairs_for_threads)
        for (int j = 0; j < n; j++) {
            const double *column = s->A + (size_t)j * (size_t)s->ld;
            double sum = 0.0;
            for (int i = 0; i < n; i++)
                sum += fabs(column[i]);
            norm = fmax(norm, sum);
        }
        /* LU with partial pivoting; large ones use all threads of BLAS. */
        double *work = rb_alloc((size_t)n, 4);
        lapack_int *iwork = calloc((size_t)n, sizeof *iwork);
        rb_status status = RB_ENOMEM;

        if (work && iwork) {
            const int threads = rb_blas_threads(n >= RB_BEM_LU_THREADS_FROM ? 0 : 1);
            LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, s->A, s->ld, s->pivot);
            rb_blas_threads(threads);
            LAPACKE_dgecon_work(LAPACK_COL_MAJOR, '1', n, s->A, s->ld, norm, &s->rcond, work,
                                iwork);
            status = s->rcond > 1e-14
                         ? RB_OK
                         : rb_fail(why, RB_SINGULAR,
                                   "boundary elements: the system is singular (reciprocal "
                                   "condition %.2g)",
                                   s->rcond);
        }
        free(iwork);
        free(work);
        return status;
    }
    s->rcond = NAN;
    const rb_status status =
        rb_hierarchical_create(&s->mesh, s->material, s->unit, s->tolerance, &s->h);
    return status == RB_SINGULAR ? rb_fail(why, status, "boundary elements: the system is singular")
                                 : status;
}

static double bytes_of(const rb_bem_mesh *mesh, int dense)
{
    return (dense ? dense_bytes : hierarchical_bytes)(mesh->n, mesh->contact_n);
}

/* few: loads; a dense matrix is then left as it is. */
static rb_status make_system(const rb_bem_mesh *mesh, rb_bem_material material, int dense, int few,
                             double compression, rb_bond *bond, rb_bem_system **system,
                             rb_message *why)
{
    *system = NULL;
    rb_status status = rb_bem_mesh_check(mesh, why);
    if (status == RB_OK)
        status = rb_bem_material_check(material, why);
    if (status == RB_OK)
        status = rb_bem_support_check(mesh, why);
    if (status == RB_OK) {
        char what[80];

        /* Refused before anything is allocated, if the machine has not so much memory. */
        snprintf(what, sizeof what, "a boundary of %d elements", mesh->n);
        status = rb_memory_check(bytes_of(mesh, dense), what, why);
    }
    if (status != RB_OK) {
        rb_bond_free(bond);
        return status;
    }
    const double start = rb_seconds();
    const size_t dofs = 2 * (size_t)mesh->n, loads = 2 * (size_t)mesh->contact_n;
    rb_bem_system *s = calloc(1, sizeof *s);
    status = RB_ENOMEM;
    if (s) {
        /* Columns begin at a cache line, and not all at the same place of the caches. */
        const int n = 2 * mesh->n, lines = (n + 7) / 8 * 8;
        *s = (rb_bem_system){.material = material,
                             .dofs = n,
                             .ld = !dense        ? n
                                   : lines % 512 ? lines
                                                 : lines + 8,
                             .offset =
                                 loads ? 2 * (mesh->contact_first + mesh->contact_n + 1) % n : 0,
                             .bond = bond,
                             .b = rb_alloc(dofs, 1),
                             .unit = rb_alloc(dofs, 1),
                             .pivot = calloc(dofs, sizeof *s->pivot)};
        s->A = dense ? rb_large_alloc((size_t)s->ld, dofs) : NULL;
        s->Gc = rb_large_alloc((size_t)s->ld, loads);
        /* Of a hierarchical matrix: 1e-9 leaves an error of the flexibility of 1e-8, far
         * below that of the elements (1e-4 at such lengths).  In a nearly incompressible
         * body the matrix hardly feels a uniform pressure on a held contour, by 1 - 2 nu:
         * this has to stand out. */
        const double volume = 1.0 - 2.0 * material.poisson;
        s->tolerance =
            rb_bem_is_incompressible(material) ? 1e-9 : fmin(1e-9, fmax(1e-12, 1e-6 * volume));
        s->tolerance = fmin(s->tolerance, compression);
        if (rb_bem_mesh_copy(mesh, &s->mesh) == RB_OK && (s->A || !dense) && s->Gc && s->b &&
            s->unit && s->pivot)
            status = RB_OK;
    } else {
        rb_bond_free(bond);
    }
    rb_phase("integrals over boundary elements");
    if (status == RB_OK)
        status = assemble(s);
    if (status == RB_OK) {
        const double assembled = rb_seconds();
        s->seconds_assembly = assembled - start;
        s->is_assembled = few && dense;
        rb_phase("elimination of the boundary outside the contact");
        if (!s->is_assembled)
            status = rb_bem_system_factor(s, why);
        s->seconds_factor = rb_seconds() - assembled;
    }
    if (status == RB_ENOMEM)
        rb_fail(why, status, "boundary elements: out of memory for %d elements (%.3g MB)", mesh->n,
                bytes_of(mesh, dense) / 1e6);
    if (status == RB_OK)
        *system = s;
    else
        rb_bem_system_free(s);
    return status;
}

rb_status rb_bem_system_make(const rb_bem_mesh *mesh, rb_bem_material material, int dense,
                             double compression, rb_bond *bond, rb_bem_system **system,
                             rb_message *why)
{
    return make_system(mesh, material, dense, 0, compression, bond, system, why);
}

rb_status rb_bem_system_create_for_few(const rb_bem_mesh *mesh, rb_bem_material material,
                                       double compression, rb_bem_system **system, rb_message *why)
{
    return make_system(mesh, material, mesh->n < RB_BEM_HIERARCHICAL, 1, compression, NULL, system,
                       why);
}

rb_status rb_bem_system_create_as(const rb_bem_mesh *mesh, rb_bem_material material, int dense,
                                  rb_bem_system **system, rb_message *why)
{
    return rb_bem_system_make(mesh, material, dense, INFINITY, NULL, system, why);
}

rb_status rb_bem_system_create_within(const rb_bem_mesh *mesh, rb_bem_material material,
                                      double compression, rb_bem_system **system, rb_message *why)
{
    return rb_bem_system_make(mesh, material, mesh->n < RB_BEM_HIERARCHICAL, compression, NULL,
                              system, why);
}

rb_status rb_bem_system_create(const rb_bem_mesh *mesh, rb_bem_material material,
                               rb_bem_system **system, rb_message *why)
{
    return rb_bem_system_create_within(mesh, material, INFINITY, system, why);
}
