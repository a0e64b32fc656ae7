/* Units, by one table.  Everything is computed in mm, N, MPa and s; options and results
 * name their units so, and other units are converted where values enter and leave. */
#ifndef ROLLBEM_UNITS_H
#define ROLLBEM_UNITS_H

#include "rollbem/base.h"

RB_PUBLIC_BEGIN

typedef enum {
    RB_UNITS_MM,  /* mm, N, MPa */
    RB_UNITS_SI,  /* m, N, Pa */
    RB_UNITS_INCH /* in, lbf, psi */
} rb_units;

/* unit: as options and results name it ("mm", "MPa", "N/mm", "N", "mm/s", "mm/MPa"). What
 * has no other unit in any system ("-", "1", "s", "degrees", "elements") stays as it is.
 */

/* What stands in its place: "Pa" for "MPa" in SI. */
const char *rb_unit_name(rb_units system, const char *unit);
/* From mm, N, MPa to the system, and back.  Powers of ten move the decimal point: 0.0465
 * m is the same number as 46.5 mm to the last bit. */
double rb_unit_shown(rb_units system, const char *unit, double x);
double rb_unit_stored(rb_units system, const char *unit, double x);

/* 1: a unit of the table of any kind, such as "MPa" and "kN/m". */
int rb_unit_is_known(const char *name);

/* "210GPa", "0.3", "18 in": *value, in mm, N, MPa where *plain is 0, and as it stands
 * where *plain is 1: there was no unit.  RB_EINVAL: no finite number, or (with a line in
 * why) no such unit, or one of something else. */
rb_status rb_unit_read(const char *text, const char *unit, double *value, int *plain,
                       rb_message *why);
/* The unit at the end of a column's name, "load_kN/m": its name's length without it, and
 * the unit in *name; 0: it ends with no unit of that kind. */
size_t rb_unit_of_column(const char *column, const char *unit, const char **name);
/* A number in that unit of the table, in mm, N, MPa. */
double rb_unit_of(const char *name, const char *unit, double x);

RB_PUBLIC_END

#endif
