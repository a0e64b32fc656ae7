/* Units.  All computations use mm, N, MPa and s, and options and results name their units
 * in this system.  Values in other units are converted on input and output by one
 * table. */
#ifndef ROLLBEM_UNITS_H
#define ROLLBEM_UNITS_H

#include "rollbem/base.h"

RB_PUBLIC_BEGIN

typedef enum {
    RB_UNITS_MM,  /* mm, N, MPa */
    RB_UNITS_SI,  /* m, N, Pa */
    RB_UNITS_INCH /* in, lbf, psi */
} rb_units;

/* unit: as options and results name it ("mm", "MPa", "N/mm", "N", "mm/s", "mm/MPa").
 * Units that are the same in every system ("-", "1", "s", "degrees", "elements") are not
 * converted. */

/* The name of the corresponding unit of the system: "Pa" for "MPa" in SI. */
const char *rb_unit_name(rb_units system, const char *unit);
/* rb_unit_shown converts a value from mm, N, MPa to the system, rb_unit_stored converts
 * it back.  Factors that are powers of ten only move the decimal point, so 0.0465 m gives
 * the same double as 46.5 mm.  unit NULL: a plain number, as of results without a unit. */
double rb_unit_shown(rb_units system, const char *unit, double x);
double rb_unit_stored(rb_units system, const char *unit, double x);

/* Returns 1 if the table has a unit of this name, for example "MPa" or "kN/m". */
int rb_unit_is_known(const char *name);

/* Reads a number with or without a unit: "210GPa", "0.3", "18 in".  With a unit *plain is
 * 0 and *value is in mm, N, MPa.  Without one *plain is 1 and *value is the number as
 * written.  RB_EINVAL: no finite number, or (with a line in why) an unknown unit or a
 * unit of another quantity. */
rb_status rb_unit_read(const char *text, const char *unit, double *value, int *plain,
                       rb_message *why);
/* Finds the unit at the end of a column's name, for example "kN/m" of "load_kN/m".
 * Returns the length of the name without the unit and sets *name to the unit.  Returns 0
 * if the name does not end with a unit of the same quantity as `unit`. */
size_t rb_unit_of_column(const char *column, const char *unit, const char **name);
/* Converts x, given in the unit `name` of the table, to mm, N, MPa. */
double rb_unit_of(const char *name, const char *unit, double x);

RB_PUBLIC_END

#endif
