/* The influence matrices H and G of constant boundary elements (B1): Somigliana's identity at the
 * midpoint of each element, with the displacement and the traction constant on each element, is
 * H u = G t.  A column of blocks belongs to an element, a row to a midpoint. */
#include "bem/assemble.h"
#include "bem/internal.h"
#include "base/blas.h"

#include <cblas.h>
#include <stdlib.h>

/* The 2 x 2 blocks of one element seen from the point p (B3): the integrals of Kelvin's kernels T
 * (H) and U (G) of (B2) over the straight element.  They are elementary functions of the angle
 * under which p sees the element and of the distances of its ends. */
rb_bem_blocks rb_bem_element_integrals(rb_bem_segment element, double px, double py, int self,
                                       rb_bem_material material)
{
    const rb_element e = rb_element_make(element.x0, element.y0, element.x1, element.y1, 1.0);
    const rb_constants k = rb_constants_make(&e, material);
    rb_influence v;

    if (self) {
        /* From its own midpoint: the principal value of T vanishes, which leaves the free term 1/2
         * of (B1); the logarithm of U is integrated over both halves. */
        rb_integrate_self(&k, e.a, &v);
    } else {
        /* From anywhere else: both kernels by the angles and distances of the two ends. */
        const rb_view_angles angles = rb_view_angles_of(&e, px, py);
        rb_integrate_H(&k, &angles, &v);
        rb_integrate_G(&k, e.a, &angles, &v);
    }
    return (rb_bem_blocks){.H = {v.Hxx, v.Hyx, v.Hxy, v.Hyy}, .G = {v.Gxx, v.Gxy, v.Gxy, v.Gyy}};
}

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

rb_status rb_bem_assemble(const rb_bem_mesh *mesh, rb_bem_material material, double *H, double *G,
                          int ld, rb_message *why)
{
    rb_assembly assembly;
    rb_status s = rb_bem_mesh_check(mesh, why);
    if (s == RB_OK)
        s = rb_bem_material_check(material, why);
    if (s == RB_OK && ld < 2 * mesh->n)
        s = rb_fail(why, RB_EINVAL, "leading dimension %d: expected at least %d", ld, 2 * mesh->n);
    if (s != RB_OK)
        return s;
    /* The columns of one element depend on no other element: each thread takes some elements. */
    s = rb_assembly_begin(mesh, material, &assembly);
    if (s != RB_OK)
        return rb_fail(why, s, "influence: out of memory for %d points", mesh->n);
    int stop = 0;
#pragma omp parallel for num_threads(rb_blas_loop_threads())                                       \
    schedule(static) if ((double)mesh->n * mesh->n > rb_pairs_for_threads)
    for (int j = 0; j < mesh->n; j++) {
        const size_t at = 2 * (size_t)j * (size_t)ld, next = at + (size_t)ld;
        double *const out[4] = {H + at, H + next, G ? G + at : NULL, G ? G + next : NULL};
        if (!rb_interrupted_in_loop(&stop))
            rb_assembly_columns(&assembly, j, 1.0, out);
    }
    rb_assembly_end(&assembly);
    return stop ? RB_INTERRUPTED : RB_OK;
}

const char *rb_bem_vector_name(void)
{
    return rb_column_variant_get(0)->name;
}
