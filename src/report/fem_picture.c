#include "report/fem_internal.h"

#include <math.h>

double rb_report_fem_round(double x)
{
    const double ten = pow(10.0, floor(log10(x))), lead = x / ten * (1.0 + 1e-12);
    return (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0) * ten;
}
