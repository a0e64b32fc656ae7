/* Words used by all formats. */
#include "program/report/internal.h"
#include "rolling/case/case.h"

#include <stddef.h>
#include <string.h>

const char *const rb_report_conventions[] = {
    "x to the right, y up; A is the upper body and rolls towards +x: the leading edge is at +x",
    "p >= 0: pressure; q: friction on A, positive towards +x; loads per unit length",
    "creepage xi > 0: A's surface slides towards +x over the ground (braked wheel), Q < 0",
    "slip > 0: A's surface slides towards +x; shift likewise",
    "zone: 0 separated, 1 stick, 2 slip with q = -mu p, 3 slip with q = +mu p",
    NULL};

const char *rb_report_solver(const rb_rolling_solution *s)
{
    return s->solver == RB_SOLVER_CONE ? s->cone_solver : rb_case_word("solver", (int)s->solver);
}

const char *rb_report_unit_name(rb_units units, const char *unit)
{
    return unit && strcmp(unit, "-") != 0 ? rb_unit_name(units, unit) : "1";
}
