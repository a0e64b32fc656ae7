/* What a friction law may not be: its numbers, and what they need besides (theory-rolling.md 4.11).
 */
#include "rolling/case/check.h"
#include "rolling/case/internal.h"
#include "rolling/solve/law.h"

#include <math.h>

#define NAME_OF_LAW(name, help) #name,
static const char *const names[] = {RB_ROLLING_FRICTION_LAWS(NAME_OF_LAW) "table"};

rb_status rb_rolling_law_check(const rb_rolling_case *rc, rb_message *why)
{
    const rb_rolling_friction *f = &rc->friction;

    if (f->law == RB_FRICTION_table) {
        const rb_rolling_table *t = &f->table;
        if (t->n < 1)
            return rb_refuse(why, "friction-law", "expected a row or more");
        for (int k = 0; k < t->n; k++) {
            if (!isfinite(t->x[k]) || (k > 0 && !(t->x[k] > t->x[k - 1])))
                return rb_refuse_row(why, "friction-law", k + 1, "expected x to increase, got %g",
                                     t->x[k]);
            if (!(isfinite(t->y[k]) && t->y[k] >= 0.0))
                return rb_refuse_row(why, "friction-law", k + 1, "expected mu >= 0, got %g",
                                     t->y[k]);
        }
    }
    const int slips = rb_rolling_law_depends_on_slip(f), rolls = rc->formulation != RB_STATIC,
              heats = f->heat != 0.0, remembers = f->memory != 0.0;
    const struct {
        int counts;
        const char *option;
        double value;
    } numbers[] = {{slips, "mu-fall", f->fall[0]},
                   {slips && rolls && f->fall[0] != 0.0, "slip-scale", f->slip_scale[0]},
                   {slips, "mu-fall", f->fall[1]},
                   {slips && rolls && f->fall[1] != 0.0, "slip-scale", f->slip_scale[1]},
                   {heats, "mu-heat", f->heat},
                   {heats, "mu-heat", f->heat_from},
                   {remembers, "memory", f->memory},
                   {remembers, "memory", f->memory_slip}};
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
        const rb_status s = numbers[k].counts
                                ? rb_rolling_check_number(numbers[k].option, numbers[k].value, why)
                                : RB_OK;
        if (s != RB_OK)
            return s;
    }
    if (heats && !(isfinite(f->heat_range) && f->heat_range > 0.0))
        return rb_refuse(why, "mu-heat", "expected a number > 0 as the third, got %g",
                         f->heat_range);
    /* Slip that begins at the edge spreads like a crack without toughness (F6). */
    if (slips && !rolls && !remembers && f->fall[0] + f->fall[1] > 0.0)
        return rb_refuse(why, "friction-law,mu-fall",
                         "%s: a static coefficient of %g above the kinetic one of %g "
                         "needs a sliding distance in static contact, add --memory; without it the "
                         "result on fine meshes is that of mu = %g",
                         names[f->law], rc->mu + f->fall[0] + f->fall[1], rc->mu, rc->mu);
    if (slips && rolls && rc->speed == 0.0)
        return rb_refuse(why, "friction-law", "%s: needs the speed of rolling, add --speed",
                         names[f->law]);
    if (heats && rolls && !rb_rolling_has_heat(rc))
        return rb_refuse(why, "mu-heat", "needs temperatures, add --conductivity");
    const double least = rb_rolling_least_mu(rc);
    if (least < 0.0)
        return rb_refuse(why, "friction-law,mu-heat",
                         "%s: expected mu >= 0 everywhere, got %g at least", names[f->law], least);
    return RB_OK;
}
