/* The table of units with their factors to mm, N, MPa, s. */
#include "rollbem/units.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Exact by definition: the inch is 25.4 mm, the pound-force 4.4482216152605 N. */
#define INCH 25.4
#define POUND 4.4482216152605
/* Of a millimetre per metre and per inch, in stress intensities. */
#define ROOT_OF_1000 31.622776601683793
#define ROOT_OF_INCH 5.0398412673416611

/* One of it is factor 10^power of the unit that it is a kind of. */
typedef struct {
    const char *name, *kind;
    int power;
    double factor;
} unit_row;

static const unit_row table[] = {
    {"mm", "mm", 0, 1.0},
    {"m", "mm", 3, 1.0},
    {"cm", "mm", 1, 1.0},
    {"um", "mm", -3, 1.0},
    {"nm", "mm", -6, 1.0},
    {"in", "mm", 0, INCH},
    {"inch", "mm", 0, INCH},
    {"ft", "mm", 0, 12.0 * INCH},
    {"mil", "mm", -3, INCH},
    {"mm2", "mm2", 0, 1.0},
    {"m2", "mm2", 6, 1.0},
    {"in2", "mm2", 0, INCH *INCH},
    {"MPa", "MPa", 0, 1.0},
    {"Pa", "MPa", -6, 1.0},
    {"kPa", "MPa", -3, 1.0},
    {"GPa", "MPa", 3, 1.0},
    {"bar", "MPa", -1, 1.0},
    {"N/mm2", "MPa", 0, 1.0},
    {"psi", "MPa", 0, POUND / (INCH * INCH)},
    {"ksi", "MPa", 3, POUND / (INCH * INCH)},
    {"N/mm", "N/mm", 0, 1.0},
    {"N/m", "N/mm", -3, 1.0},
    {"kN/m", "N/mm", 0, 1.0},
    {"kN/mm", "N/mm", 3, 1.0},
    {"MN/m", "N/mm", 3, 1.0},
    {"lbf/in", "N/mm", 0, POUND / INCH},
    {"lbf/ft", "N/mm", 0, POUND / (12.0 * INCH)},
    {"N", "N", 0, 1.0},
    {"kN", "N", 3, 1.0},
    {"lbf", "N", 0, POUND},
    {"mm/s", "mm/s", 0, 1.0},
    {"m/s", "mm/s", 3, 1.0},
    {"km/h", "mm/s", 6, 1.0 / 3600.0},
    {"in/s", "mm/s", 0, INCH},
    {"ft/s", "mm/s", 0, 12.0 * INCH},
    {"mph", "mm/s", 0, 447.04},
    {"mm/MPa", "mm/MPa", 0, 1.0},
    {"um/MPa", "mm/MPa", -3, 1.0},
    {"m/Pa", "mm/MPa", 9, 1.0},
    {"in/psi", "mm/MPa", 0, INCH *INCH *INCH / POUND},
    {"MPa/mm", "MPa/mm", 0, 1.0},
    {"N/mm3", "MPa/mm", 0, 1.0},
    {"MPa/um", "MPa/mm", 3, 1.0},
    {"GPa/mm", "MPa/mm", 3, 1.0},
    {"Pa/m", "MPa/mm", -9, 1.0},
    {"GPa/m", "MPa/mm", 0, 1.0},
    {"psi/in", "MPa/mm", 0, POUND / (INCH * INCH * INCH)},
    {"1/MPa", "1/MPa", 0, 1.0},
    {"1/Pa", "1/MPa", 6, 1.0},
    {"1/psi", "1/MPa", 0, INCH *INCH / POUND},
    {"MPa.mm^0.5", "MPa.mm^0.5", 0, 1.0},
    {"N/mm^1.5", "MPa.mm^0.5", 0, 1.0},
    {"MPa.m^0.5", "MPa.mm^0.5", 0, ROOT_OF_1000},
    {"Pa.m^0.5", "MPa.mm^0.5", -6, ROOT_OF_1000},
    {"psi.in^0.5", "MPa.mm^0.5", 0, POUND / (INCH * INCH) * ROOT_OF_INCH},
    {"ksi.in^0.5", "MPa.mm^0.5", 3, POUND / (INCH * INCH) * ROOT_OF_INCH},
    {"s", "s", 0, 1.0},
    {"ms", "s", -3, 1.0},
    {"us", "s", -6, 1.0},
    {"min", "s", 0, 60.0},
    {"h", "s", 0, 3600.0},
    {"degrees", "degrees", 0, 1.0},
    {"deg", "degrees", 0, 1.0},
    {"rad", "degrees", 0, 180.0 / 3.14159265358979323846},
    {"%", "-", -2, 1.0},
    {"W/(m K)", "W/(m K)", 0, 1.0},
    {"kW/(m K)", "W/(m K)", 3, 1.0},
    {"W/(mm K)", "W/(m K)", 3, 1.0},
    {"W/(cm K)", "W/(m K)", 2, 1.0},
    {"N/(s K)", "W/(m K)", 0, 1.0},
    {"MJ/(m3 K)", "MJ/(m3 K)", 0, 1.0},
    {"kJ/(m3 K)", "MJ/(m3 K)", -3, 1.0},
    {"J/(m3 K)", "MJ/(m3 K)", -6, 1.0},
    {"J/(cm3 K)", "MJ/(m3 K)", 0, 1.0},
    {"MPa/K", "MJ/(m3 K)", 0, 1.0},
    {"K", "K", 0, 1.0},
};

enum { ROWS = sizeof table / sizeof table[0] };

/* The units of a system, by what they stand for. */
static const struct {
    const char *kind, *name[3];
} systems[] = {{"mm", {"mm", "m", "in"}},
               {"mm2", {"mm2", "m2", "in2"}},
               {"MPa", {"MPa", "Pa", "psi"}},
               {"N/mm", {"N/mm", "N/m", "lbf/in"}},
               {"N", {"N", "N", "lbf"}},
               {"mm/s", {"mm/s", "m/s", "in/s"}},
               {"mm/MPa", {"mm/MPa", "m/Pa", "in/psi"}},
               {"MPa/mm", {"MPa/mm", "Pa/m", "psi/in"}},
               {"1/MPa", {"1/MPa", "1/Pa", "1/psi"}},
               {"MPa.mm^0.5", {"MPa.mm^0.5", "Pa.m^0.5", "psi.in^0.5"}}};

enum { KINDS = sizeof systems / sizeof systems[0] };

/* One spelling of those that people type: N/mm^2 and N/mm² are N/mm2; W/mK, W/m/K and
 * W/(m*K) are W/(m K). */
static void respell(const char *name, size_t length, char *to, size_t size)
{
    static const char *const powers[][2] = {
        {"²", "2"}, {"³", "3"}, {"·", ""}, {"μ", "u"}, {"µ", "u"}};
    const char *end = name + length;
    size_t n = 0;
    int over = 0;
    while (name < end && n + 1 < size) {
        size_t k = 0;
        while (k < 5 && strncmp(name, powers[k][0], strlen(powers[k][0])) != 0)
            k++;
        if (k < 5 && name + strlen(powers[k][0]) <= end) {
            if (powers[k][1][0])
                to[n++] = powers[k][1][0];
            name += strlen(powers[k][0]);
            continue;
        }
        if (!strchr(" ()^*", *name) && !(*name == '/' && over))
            to[n++] = *name;
        over |= *name++ == '/';
    }
    to[n] = '\0';
}

static const unit_row *find(const char *name, size_t length, const char *kind)
{
    char wanted[40], own[40];
    if (length == 0 || length >= sizeof wanted)
        return NULL;
    respell(name, length, wanted, sizeof wanted);
    for (int k = 0; k < ROWS; k++) {
        respell(table[k].name, strlen(table[k].name), own, sizeof own);
        if (strcmp(own, wanted) == 0 && (!kind || strcmp(table[k].kind, kind) == 0))
            return &table[k];
    }
    return NULL;
}

int rb_unit_is_known(const char *name)
{
    return find(name, strlen(name), NULL) != NULL;
}

const char *rb_unit_name(rb_units system, const char *unit)
{
    for (int k = 0; k < KINDS; k++)
        if (strcmp(systems[k].kind, unit) == 0)
            return systems[k].name[system];
    return unit;
}

/* x 10^power as if x had been typed with the point elsewhere. */
static double move_point(double x, int power)
{
    char digits[40], moved[60];
    if (power == 0 || x == 0.0 || !isfinite(x))
        return x;
    rb_format(digits, sizeof digits, "%.14e", x);
    if (rb_read_number(digits, NULL) != x)
        rb_format(digits, sizeof digits, "%.16e", x);
    char *exponent = strchr(digits, 'e');
    *exponent = '\0';
    snprintf(moved, sizeof moved, "%se%d", digits, atoi(exponent + 1) + power);
    return rb_read_number(moved, NULL);
}

static double to_stored(const unit_row *u, double x)
{
    return move_point(x, u->power) * u->factor;
}

/* NULL: nothing is to be converted. */
static const unit_row *row_of(rb_units system, const char *unit)
{
    if (system == RB_UNITS_MM || !unit)
        return NULL;
    const char *name = rb_unit_name(system, unit);
    return find(name, strlen(name), unit);
}

double rb_unit_shown(rb_units system, const char *unit, double x)
{
    const unit_row *u = row_of(system, unit);
    return u ? move_point(x / u->factor, -u->power) : x;
}

double rb_unit_stored(rb_units system, const char *unit, double x)
{
    const unit_row *u = row_of(system, unit);
    return u ? to_stored(u, x) : x;
}

double rb_unit_of(const char *name, const char *unit, double x)
{
    const unit_row *u = find(name, strlen(name), unit);
    return u ? to_stored(u, x) : x;
}

rb_status rb_unit_read(const char *text, const char *unit, double *value, int *plain,
                       rb_message *why)
{
    char *end;
    if (why)
        why->text[0] = '\0';
    if (*text == '\0' || strchr(" \t\n", *text))
        return RB_EINVAL;
    *value = rb_read_number(text, &end);
    if (end == text || !isfinite(*value))
        return RB_EINVAL;
    *plain = *end == '\0';
    if (*plain)
        return RB_OK;
    /* one with a decimal comma; several numbers are a list */
    if (*end == ',' && isdigit((unsigned char)end[1]) && !strpbrk(end + 1, ",.") &&
        !memchr(text, '.', (size_t)(end - text)))
        return rb_fail(why, RB_EINVAL, "a number with a decimal point, %.*s.%.20s; got '%.60s'",
                       (int)(end - text < 20 ? end - text : 20), text, end + 1, text);
    const char *word = end + strspn(end, " ");
    const unit_row *u = find(word, strlen(word), unit);
    if (!u && strcmp(word, unit) == 0 && strcmp(unit, "-") != 0)
        return RB_OK;
    /* what does not begin like a unit is no number at all */
    if (!u && !find(word, strlen(word), NULL) && strpbrk(word, "0123456789+-., ()"))
        return RB_EINVAL;
    if (!u) {
        /* Why the unit `word` of `text` is none of that kind. */
        const int known = find(word, strlen(word), NULL) != NULL;
        rb_guess guess = {.word = word};
        char names[200] = "";
        size_t used = 0;
        for (int k = 0; k < ROWS && strcmp(unit, "-") != 0; k++)
            if (strcmp(table[k].kind, unit) == 0 && used < sizeof names) {
                used += (size_t)snprintf(names + used, sizeof names - used, "%s%s",
                                         used ? ", " : "", table[k].name);
                rb_guess_try(&guess, table[k].name);
            }
        if (names[0])
            return rb_fail(why, RB_EINVAL, "a number in one of %s; got '%.60s'%s", names, text,
                           known ? "" : rb_guess_text(&guess, ""));
        return known ? rb_fail(why, RB_EINVAL, "a number without a unit, got '%.60s'", text)
                     : RB_EINVAL;
    }
    *value = to_stored(u, *value);
    return RB_OK;
}

size_t rb_unit_of_column(const char *column, const char *unit, const char **name)
{
    const char *end = strrchr(column, '_');
    const unit_row *u = end ? find(end + 1, strlen(end + 1), unit) : NULL;
    if (!u)
        return 0;
    *name = u->name;
    return (size_t)(end - column);
}
