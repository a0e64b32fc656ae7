/* The integrals over one element seen from one point (B3). */
#include "bem/kernels.h"

void rb_bem_element_integrals(double x0, double y0, double x1, double y1, double px,
                              double py, int self, rb_bem_material material, double H[4],
                              double G[4])
{
    const rb_element e = rb_element_make(x0, y0, x1, y1, 1.0);
    const rb_constants k = rb_constants_make(&e, material);
    rb_influence out;

    if (self) {
        rb_integrate_self(&k, e.a, &out);
    } else {
        const rb_seen v = rb_look(&e, px, py);
        rb_integrate_H(&k, &v, &out);
        rb_integrate_G(&k, e.a, &v, &out);
    }
    H[0] = out.Hxx;
    H[1] = out.Hyx;
    H[2] = out.Hxy;
    H[3] = out.Hyy;
    G[0] = out.Gxx;
    G[1] = G[2] = out.Gxy;
    G[3] = out.Gyy;
}
