/* The integrals over one element seen from one point (B3). */
#include "bem/kernels.h"

rb_bem_blocks rb_bem_element_integrals(rb_bem_segment element, double px, double py, int self,
                                       rb_bem_material material)
{
    const rb_element e = rb_element_make(element.x0, element.y0, element.x1, element.y1, 1.0);
    const rb_constants k = rb_constants_make(&e, material);
    rb_influence v;

    if (self) {
        rb_integrate_self(&k, e.a, &v);
    } else {
        const rb_view_angles seen = rb_view_angles_of(&e, px, py);
        rb_integrate_H(&k, &seen, &v);
        rb_integrate_G(&k, e.a, &seen, &v);
    }
    return (rb_bem_blocks){.H = {v.Hxx, v.Hyx, v.Hxy, v.Hyy}, .G = {v.Gxx, v.Gxy, v.Gxy, v.Gyy}};
}
