/* Carter's case, which several benchmarks solve: similar half-planes, steady, s = 0.4. */
#ifndef ROLLBEM_BENCH_CARTER_H
#define ROLLBEM_BENCH_CARTER_H

#include "rolling/rolling.h"

#include <math.h>

static inline rb_rolling_case carter(int n)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a = (rb_rolling_body){
        .young = 210000.0, .poisson = 0.28, .radius = 500.0, .support = RB_BEM_HALFPLANE};
    rc.b = rc.a;
    rc.b.radius = INFINITY;
    rc.elastic_b = 1;
    rc.gap = RB_GAP_PARABOLA;
    rc.formulation = RB_STEADY;
    rc.half_width = 1.0;
    rc.creep_ratio = 0.4;
    rc.contact_elements = n;
    return rc;
}

#endif
