/* The influence matrices H and G (B1) of a whole body, and the integrals over one element, for who
 * wants to see them; the mixed system assembles its own columns (system.c). */
#include "bem/assemble.h"
#include "bem/internal.h"
#include "base/blas.h"

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
