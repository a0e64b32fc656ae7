/* Columns of the influence matrices H and G of constant boundary elements (B1): Somigliana's
 * identity at the midpoint of each element, with the displacement and the traction constant on each
 * element, is H u = G t.  A column of blocks belongs to an element, a row to a midpoint. */
#include "bem/assemble.h"
#include "bem/internal.h"

#include <cblas.h>
#include <stdlib.h>

rb_status rb_assembly_begin(const rb_bem_mesh *mesh, rb_bem_material material,
                            rb_assembly *assembly)
{
    const int n = mesh->n;
    double *x = rb_alloc((size_t)n, 2), *y = x ? x + n : NULL;
    rb_status s = RB_ENOMEM;

    /* The collocation points: (B1) is asked at the midpoint of each element.  The logarithm
     * of U counts distances in r0, the size of the mesh; the tractions around a body are in
     * balance, and r0 cancels. */
    *assembly = (rb_assembly){.mesh = mesh, .material = material, .r0 = rb_bem_mesh_size(mesh)};
    for (int j = 0; j < n && x; j++) {
        x[j] = 0.5 * (mesh->x0[j] + mesh->x1[j]);
        y[j] = 0.5 * (mesh->y0[j] + mesh->y1[j]);
    }
    if (x)
        s = rb_points_make(n, x, y, &assembly->midpoints);
    free(x);
    return s;
}

void rb_assembly_end(rb_assembly *assembly)
{
    rb_points_free(&assembly->midpoints);
}

/* The columns of H (out[0], out[1]) and of G times a factor (out[2], out[3]) for the two directions
 * of element j, at all midpoints at once; the kernels run over vectors of points. */
void rb_assembly_columns(const rb_assembly *assembly, int j, double G_factor, double *const out[4])
{
    const rb_bem_mesh *mesh = assembly->mesh;
    const rb_element e =
        rb_element_make(mesh->x0[j], mesh->y0[j], mesh->x1[j], mesh->y1[j], assembly->r0);
    rb_constants k = rb_constants_make(&e, assembly->material);
    rb_constants_scale_G(&k, G_factor);
    rb_column_variant_get(0)->fill(&k, &e, j, &assembly->midpoints, out);
}

rb_status rb_assembly_add_given(const rb_assembly *assembly, const double *value, double *b)
{
    const rb_bem_mesh *mesh = assembly->mesh;
    const size_t dofs = 2 * (size_t)mesh->n;
    double *scratch = rb_alloc(dofs, 4);
    if (!scratch)
        return RB_ENOMEM;
    double *const out[4] = {scratch, scratch + dofs, scratch + 2 * dofs, scratch + 3 * dofs};
    for (int j = 0; j < mesh->n; j++) {
        const double *own = value + 2 * j;
        if (own[0] == 0.0 && own[1] == 0.0)
            continue;
        rb_assembly_columns(assembly, j, 1.0, out);
        for (int k = 0; k < 2; k++) {
            if (mesh->condition[2 * j + k] == RB_BEM_DISPLACEMENT)
                cblas_daxpy(2 * mesh->n, -own[k], out[k], 1, b, 1);
            else
                cblas_daxpy(2 * mesh->n, own[k], out[2 + k], 1, b, 1);
        }
    }
    free(scratch);
    return RB_OK;
}
