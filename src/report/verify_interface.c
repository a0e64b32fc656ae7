/* What happens between the bodies: heat. */
#include "report/verify.h"

#include "rollbem/closed_forms.h"

#include <math.h>

enum { RELATIVE = RB_VERIFY_RELATIVE };

/* Similar bodies that slide so fast that the heat is that of Hertz's pressure. */
static void flash_temperature(rb_verify *v, int elements, double bound)
{
    const rb_rolling_heat steel = {50.0, 3.5, 0.0};
    rb_rolling_case rc = rb_verify_uncoupled();
    rb_rolling_solution s;
    rc.formulation = RB_STEADY;
    rc.mesh = RB_MESH_ALIGNED;
    rc.slip_operator = RB_SLIP_SECOND;
    rc.contact_elements = elements;
    rc.mu = 1e-3;
    rc.creep = 0.1;
    rc.heat_a = rc.heat_b = steel;
    rc.speed = 1e6 * 2.0 * steel.conductivity / steel.heat_capacity / rc.half_width;
    rb_verify_solve(v, &rc, &s);
    const double p0 = rb_closed_hertz_max_pressure(s.normal_load, rc.half_width);
    rb_verify_compare(v, s.max_temperature,
                      rb_closed_flash_temperature(
                          rc.mu * p0 * rc.creep * rc.speed, rc.half_width, rc.speed,
                          2.0 * sqrt(steel.conductivity * steel.heat_capacity)),
                      bound, RELATIVE, "flash temperature, %d elements", elements);
    rb_rolling_solution_free(&s);
}

void rb_verify_interface(rb_verify *v)
{
    flash_temperature(v, 50, 5e-4);
    flash_temperature(v, 200, 6.3e-5);
}
