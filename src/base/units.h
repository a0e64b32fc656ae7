/* Units.  All computations use mm, N, MPa and s, and options and results name their units
 * in this system.  Values in other units are converted on input and output by one
 * table. */
#ifndef ROLLBEM_SRC_BASE_UNITS_H
#define ROLLBEM_SRC_BASE_UNITS_H

#include "base/base.h"

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

/* The factor of a unit: one of it is 10^power up/down of the unit that it is converted
 * to. */
typedef struct {
    int power;
    double up, down;
} rb_unit_factor;

/* x times the factor, and x over it. */
double rb_unit_times(const rb_unit_factor *f, double x);
double rb_unit_over(const rb_unit_factor *f, double x);
/* The factor of the system's unit for `unit` to mm, N, MPa, for many numbers: rb_unit_shown
 * divides by it.  Returns 0, and a factor of 1, if nothing is to be converted. */
int rb_unit_of_system(rb_units system, const char *unit, rb_unit_factor *f);

/* A line for people in which numbers have units, "x = 3 mm", "from 1 to 2 mm", "(0, 3) mm",
 * "Q = 4 N/mm": in those of the system.  What stands in single quotes was typed and stays. */
void rb_unit_translate(rb_units system, char *line, size_t size);

/* Units are products of powers of words with prefixes, as people type them: "MPa",
 * "kN/m", "N/mm^2", "mm3/(N m)", "mm3/Nm", "W/mK", "MPa.m^0.5", "ft/min".  Returns 1 if
 * `name` is one. */
int rb_unit_is_known(const char *name);

/* The units of a quantity that messages list: "mm, m, cm, ..."; NULL: it has none but its
 * own. */
const char *rb_unit_list(const char *unit);

/* Reads a number with or without a unit: "210GPa", "0.3", "18 in", "100kN/12mm",
 * "1e-10/MPa".  With a unit *plain is 0 and *value is in mm, N, MPa.  Without one *plain is
 * 1 and *value is the number as written.  RB_EINVAL: no finite number, or (with a line in
 * why that lists known ones) an unknown unit or a unit of another quantity. */
rb_status rb_unit_read(const char *text, const char *unit, double *value, int *plain,
                       rb_message *why);
/* Compares the heading of a column with a name, and reads the unit behind it: "load",
 * "load_kN/m", "Load [kN/m]", "load (kN/m)", "load / kN/m", "load in kN/m".  Capitals,
 * blanks, points, "_" and "-" in the name do not matter; nor do capitals in a unit that is
 * written in letters of one size and clear.  RB_OK: it is this name; *plain is 1 if it has
 * no unit, else *factor is that of its unit to `unit`.  RB_EFORMAT: it is this name, with
 * what is no unit of the quantity.  RB_EINVAL: it is another name. */
rb_status rb_unit_of_heading(const char *heading, const char *name, const char *unit,
                             rb_unit_factor *factor, int *plain);

#endif
