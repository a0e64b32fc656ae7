/* Assembly of columns of H and G, shared by the full matrices and the mixed system. */
#ifndef ROLLBEM_BEM_ASSEMBLE_H
#define ROLLBEM_BEM_ASSEMBLE_H

#include "bem/column.h"

typedef struct {
    const rb_bem_mesh *mesh; /* borrowed */
    rb_bem_material material;
    double r0; /* length inside the logarithm */
    rb_points midpoints;
} rb_assembly;

rb_status rb_assembly_begin(const rb_bem_mesh *mesh, rb_bem_material material,
                            rb_assembly *assembly);
void rb_assembly_end(rb_assembly *assembly);

/* The columns of element j: out as in column.h; those of G times G_factor. */
void rb_assembly_columns(const rb_assembly *assembly, int j, double G_factor, double *const out[4]);

/* b += G t for given tractions, b -= H u for given displacements; value: 2n, t or u as the
 * conditions of the mesh have it.  RB_ENOMEM. */
rb_status rb_assembly_add_given(const rb_assembly *assembly, const double *value, double *b);

#endif
