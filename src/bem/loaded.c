/* A body under tractions of its contact, and how the displacement there changes where boundary
 * and material are slightly others (B13): products with their matrices and one solve with the
 * factors of the body, no factors of the others. */
#include "bem/assemble.h"
#include "bem/internal.h"
#include "bem/strip.h"
#include "bem/system.h"
#include "base/blas.h"

#include <cblas.h>
#include <stdlib.h>
#include <string.h>

struct rb_bem_loaded {
    const rb_bem_system *system; /* borrowed */
    rb_bem_normals normals;
    int subtracted;
    rb_arena memory;       /* of the arrays */
    double *r;             /* 2 contact_n */
    double *u, *t;         /* 2n each: boundary values, of the remainder if it is subtracted */
    double *left;          /* 2n: H u - G t */
    double *w;             /* 2m */
    double *value, *strip; /* 2n, 2m: scratch */
};

void rb_bem_loaded_free(rb_bem_loaded *loaded)
{
    if (loaded)
        rb_arena_done(&loaded->memory, RB_OK);
    free(loaded);
}

/* Normal and tangential displacements (2m) of the contact of a mesh: those of its elements, and
 * those of the strips. */
static void contact_displacement(const rb_bem_loaded *l, const rb_bem_mesh *mesh, const double *u,
                                 double *w)
{
    const int m = mesh->contact_n + 1;

    for (int i = 0; i < m; i++) {
        const double *own = u + 2 * (mesh->contact_first + i), *more = l->strip + 2 * i;
        double frame[2][2];
        rb_bem_contact_frame(mesh, mesh->contact_first + i, l->normals, frame);
        for (int a = 0; a < 2; a++)
            w[a * m + i] = frame[a][0] * (own[0] + more[0]) + frame[a][1] * (own[1] + more[1]);
    }
}

/* What is given on the boundary, and, if they are subtracted, what the strips leave of it, with
 * their own displacements of the contact. */
static rb_status set_values(rb_bem_loaded *l, const rb_bem_mesh *mesh, rb_bem_material material)
{
    const int n = mesh->contact_n, first = mesh->contact_first;
    const double unit = rb_bem_mesh_size(mesh);
    rb_arena scratch = {0};
    rb_strip *strip = rb_arena_zeros(&scratch, (size_t)n, sizeof *strip);
    double complex *load = rb_arena_zeros(&scratch, (size_t)n, sizeof *load);

    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    for (int c = 0; c < n; c++) {
        double frame[2][2];
        rb_bem_contact_frame(mesh, first + c, l->normals, frame);
        strip[c] = rb_strip_on(mesh, first + c, material, unit);
        load[c] = l->r[c] * (frame[0][0] + frame[0][1] * I) +
                  l->r[n + c] * (frame[1][0] + frame[1][1] * I);
    }
#pragma omp parallel for num_threads(rb_blas_loop_threads())                                       \
    schedule(static) if (l->subtracted && 10.0 * mesh->n * n > rb_pairs_for_threads)
    for (int k = 0; k < mesh->n; k++) {
        const double complex z = rb_strip_midpoint(mesh, k), normal = rb_strip_outward(mesh, k);
        const int own = k - first, is_seen = own >= 0 && own <= n;
        double complex u = 0.0, t = own >= 0 && own < n && !l->subtracted ? -load[own] : 0.0;

        for (int c = 0; l->subtracted && c < n; c++) {
            if (is_seen || mesh->condition[2 * k] == RB_BEM_DISPLACEMENT ||
                mesh->condition[2 * k + 1] == RB_BEM_DISPLACEMENT)
                u += rb_strip_under(rb_strip_displacement(&strip[c], z), load[c]);
            if (c != own) /* whose own traction the strip gives exactly */
                t += rb_strip_under(rb_strip_traction(&strip[c], z, normal), load[c]);
        }
        for (int d = 0; d < 2; d++) {
            const int held = mesh->condition[2 * k + d] == RB_BEM_DISPLACEMENT;
            const double complex less = held ? u : t;
            l->value[2 * k + d] =
                (mesh->condition[2 * k + d] == RB_BEM_CONTACT ? 0.0 : mesh->value[2 * k + d]) -
                (d ? cimag(less) : creal(less));
            if (is_seen)
                l->strip[2 * own + d] = d ? cimag(u) : creal(u);
        }
    }
    return rb_arena_done(&scratch, RB_OK);
}

/* y = H u - G t, in the same order of the sum whenever as many threads compute it. */
static rb_status boundary_residual(const rb_bem_mesh *mesh, rb_bem_material material,
                                   const double *u, const double *t, double *y)
{
    const int n = mesh->n, dofs = 2 * n,
              threads = (double)n * n > rb_pairs_for_threads ? rb_blas_loop_threads() : 1;
    const size_t rows = (size_t)dofs;
    double *all = rb_alloc(rows, 5 * (size_t)threads);
    rb_assembly assembly;
    const rb_status s = all ? rb_assembly_begin(mesh, material, &assembly) : RB_ENOMEM;

    if (s != RB_OK) {
        free(all);
        return s;
    }
#pragma omp parallel for num_threads(threads) schedule(static) if (threads > 1)
    for (int part = 0; part < threads; part++) {
        double *sum = all + 5 * (size_t)part * rows, *column = sum + rows;
        for (int j = (int)((long)n * part / threads); j < (int)((long)n * (part + 1) / threads);
             j++) {
            const double by[4] = {u[2 * j], u[2 * j + 1], -t[2 * j], -t[2 * j + 1]};
            double *out[4];
            for (int k = 0; k < 4; k++)
                out[k] = by[k] != 0.0 ? column + (size_t)k * rows : NULL;
            rb_assembly_columns(&assembly, j, 1.0, out);
            for (int k = 0; k < 4; k++)
                if (out[k])
                    cblas_daxpy(dofs, by[k], out[k], 1, sum, 1);
        }
    }
    rb_assembly_end(&assembly);
    memset(y, 0, rows * sizeof *y);
    for (int part = 0; part < threads; part++)
        cblas_daxpy(dofs, 1.0, all + 5 * (size_t)part * rows, 1, y, 1);
    free(all);
    return RB_OK;
}

rb_status rb_bem_loaded_create(const rb_bem_system *system, rb_bem_normals normals, int subtracted,
                               const double *r, rb_bem_loaded **loaded, rb_message *why)
{
    const rb_bem_mesh *mesh = &system->mesh;
    const size_t dofs = (size_t)system->dofs, m = (size_t)mesh->contact_n + 1;

    *loaded = NULL;
    if (system->bond)
        return rb_fail(why, RB_EINVAL, "loaded body: on a rigid core only");
    rb_bem_loaded *l = calloc(1, sizeof *l);
    if (!l)
        return RB_ENOMEM;
    l->system = system;
    l->normals = normals;
    l->subtracted = subtracted;
    l->r = rb_arena_doubles(&l->memory, m, 2);
    l->u = rb_arena_doubles(&l->memory, dofs, 1);
    l->t = rb_arena_doubles(&l->memory, dofs, 1);
    l->left = rb_arena_doubles(&l->memory, dofs, 1);
    l->value = rb_arena_doubles(&l->memory, dofs, 1);
    l->w = rb_arena_doubles(&l->memory, m, 2);
    l->strip = rb_arena_doubles(&l->memory, m, 2);
    rb_status s = l->memory.failed ? RB_ENOMEM : RB_OK;
    if (s == RB_OK) {
        memcpy(l->r, r, 2 * (m - 1) * sizeof *r);
        s = set_values(l, mesh, system->material);
    }
    if (s == RB_OK)
        s = rb_bem_system_solve_values(system, l->value, l->u, l->t);
    if (s == RB_OK)
        s = boundary_residual(mesh, system->material, l->u, l->t, l->left);
    if (s == RB_OK) {
        contact_displacement(l, mesh, l->u, l->w);
        *loaded = l;
    } else {
        rb_bem_loaded_free(l);
    }
    return s;
}

rb_status rb_bem_loaded_change(rb_bem_loaded *l, const rb_bem_mesh *mesh, rb_bem_material material,
                               double *change)
{
    const rb_bem_system *system = l->system;
    const int n = system->dofs, m = mesh->contact_n + 1;
    rb_arena scratch = {0};
    double *u = rb_arena_doubles(&scratch, (size_t)n, 1),
           *t = rb_arena_doubles(&scratch, (size_t)n, 1),
           *left = rb_arena_doubles(&scratch, (size_t)n, 1);
    rb_status s = scratch.failed ? RB_ENOMEM : set_values(l, mesh, material);

    if (s != RB_OK)
        return rb_arena_done(&scratch, s);
    for (int dof = 0; dof < n; dof++) {
        const int held = mesh->condition[dof] == RB_BEM_DISPLACEMENT;
        u[dof] = held ? l->value[dof] : l->u[dof];
        t[dof] = held ? l->t[dof] : l->value[dof];
    }
    s = boundary_residual(mesh, material, u, t, left);
    for (int dof = 0; dof < n; dof++)
        left[dof] = l->left[dof] - left[dof];
    if (s == RB_OK)
        s = rb_bem_system_solve_columns(system, 1, left);
    if (s == RB_OK) {
        for (int dof = 0; dof < n; dof++)
            u[dof] += left[(dof - system->offset + n) % n];
        contact_displacement(l, mesh, u, change);
        cblas_daxpy(2 * m, -1.0, l->w, 1, change, 1);
    }
    return rb_arena_done(&scratch, s);
}
