/* Axes and labels that the pictures share: units, powers of ten, steps, the bodies. */
#include "program/report/internal.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* ---- Axes -------------------------------------------------------------------------- */

rb_report_unit rb_report_axis_unit(rb_units units, const char *unit, double largest)
{
    /* from the largest down to the system's own, which is 1 */
    static const struct {
        rb_units units;
        const char *of;
        double from; /* used from this value on */
        rb_report_unit unit;
    } all[] = {{RB_UNITS_MM, "MPa", 1e4, {1e3, "GPa"}},
               {RB_UNITS_SI, "MPa", 1e10, {1e9, "GPa"}},
               {RB_UNITS_SI, "MPa", 1e6, {1e6, "MPa"}},
               {RB_UNITS_SI, "MPa", 1e4, {1e3, "kPa"}},
               {RB_UNITS_INCH, "MPa", 1e4, {1e3, "ksi"}},
               {RB_UNITS_SI, "MPa.mm^0.5", 1e4, {1e6, "MPa.m^0.5"}},
               {RB_UNITS_INCH, "MPa.mm^0.5", 1e4, {1e3, "ksi.in^0.5"}}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        if (all[k].units == units && strcmp(all[k].of, unit) == 0 && largest >= all[k].from)
            return all[k].unit;
    if (units == RB_UNITS_SI && strcmp(unit, "mm") == 0 && largest < 0.1)
        return (rb_report_unit){1e-3, "mm"};
    return (rb_report_unit){1.0, rb_unit_name(units, unit)};
}

rb_report_length rb_report_length_axis(rb_units units, double a)
{
    const rb_report_unit unit = rb_report_axis_unit(units, "mm", a);
    rb_report_length axis = {a, "/ a"};
    if (!(a > 0.0 && (a / unit.size < 0.01 || a / unit.size > 1e5))) {
        axis.size = unit.size;
        snprintf(axis.label, sizeof axis.label, "[%s]", unit.name);
    }
    return axis;
}

int rb_report_exponent(double largest)
{
    return largest > 0.0 && largest < 0.1 ? (int)floor(log10(largest)) : 0;
}

double rb_report_round_step(double step)
{
    const double power = pow(10.0, floor(log10(step)));
    const double digit = step / power * (1.0 - 1e-9); /* rounding makes no longer steps */
    return power * (digit <= 1.0 ? 1.0 : digit <= 2.0 ? 2.0 : digit <= 5.0 ? 5.0 : 10.0);
}

const char *rb_report_log_format(double from, double to)
{
    return to >= 1e4 || from < 1e-3 ? "10^{%L}" : "% h";
}

double rb_report_round_down(double x)
{
    const double ten = pow(10.0, floor(log10(x))), lead = x / ten * (1.0 + 1e-12);
    return (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0) * ten;
}

const char *rb_report_raised(const char *unit, char text[40])
{
    text[0] = '\0';
    while (*unit) {
        const size_t n = strcspn(unit, ".^");
        rb_append(text, 40, "%.*s", (int)n, unit);
        unit += n;
        if (*unit == '.') {
            rb_append(text, 40, "·");
            unit++;
        } else if (*unit == '^') {
            const size_t digits = strspn(unit + 1, "-.0123456789");
            const int root = digits == 3 && strncmp(unit + 1, "0.5", 3) == 0;
            rb_append(text, 40, "^{%.*s}", root ? 3 : (int)digits, root ? "1/2" : unit + 1);
            unit += 1 + digits;
        }
    }
    return text;
}

const char *rb_report_number(double x, int digits, char text[40])
{
    snprintf(text, 40, "%.*g", digits, x);
    char *power = strchr(text, 'e');
    if (power) {
        const int exponent = atoi(power + 1);
        *power = '\0';
        if (strcmp(text, "1") == 0)
            text[0] = '\0';
        rb_append(text, 40, text[0] ? "·10^{%d}" : "10^{%d}", exponent);
    }
    return text;
}

const char *rb_report_counted_in(int exponent, const char *unit, char text[64])
{
    const char *name = strcmp(unit, "-") == 0 ? "" : unit;
    if (exponent)
        snprintf(text, 64, "  [10^{%d}%s%s]", exponent, *name ? " " : "", name);
    else
        snprintf(text, 64, *name ? "  [%s]" : "%s", name);
    return text;
}

void rb_report_let_band(FILE *script, int is_error, double most, const char *unit, int titled)
{
    const char *name = is_error ? "estimated error" : "standard deviation";

    if (titled)
        rb_report_let_text(script, "band_title", "%s, at most %s%s%s", name,
                           RB_REPORT_NUMBER(most, 2), *unit ? " " : "", unit);
    else
        rb_report_let_text(script, "band_title", "%s", name);
}

double rb_report_labels_in(double height)
{
    return fmax(2.0, 12.0 * height);
}

/* ---- The bodies -------------------------------------------------------------------- */

/* Words that are put one behind the other, as far as there is room. */
typedef struct {
    char text[512];
    size_t n;
} words;

RB_PRINTF(2, 3)
static void add_words(words *w, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(w->text + w->n, sizeof w->text - w->n, format, arguments);
    va_end(arguments);
    w->n = strlen(w->text);
}

static void add_length(words *w, const char *of, double length, rb_units units)
{
    add_words(w, ", %s%s %s", of, RB_REPORT_NUMBER(rb_unit_shown(units, "mm", length), 5),
              rb_unit_name(units, "mm"));
}

static void add_material(words *w, double young, double poisson, rb_units units)
{
    const double shown = rb_unit_shown(units, "MPa", young);
    const rb_report_unit unit = rb_report_axis_unit(units, "MPa", shown);
    add_words(w, "E = %s %s, ν = %.4g", RB_REPORT_NUMBER(shown / unit.size, 5), unit.name, poisson);
}

static void add_body(words *w, const rb_rolling_body *b, rb_units units)
{
    const double below = b->layer > 0.0 ? b->base_young : b->core_young;
    add_words(w, "%s", rb_rolling_kind_name(rb_rolling_kind_of(b)));
    if (isfinite(b->radius))
        add_length(w, "R = ", b->radius, units);
    if (b->cover > 0.0)
        add_length(w, "cover ", b->cover, units);
    if (b->stack) {
        add_words(w, ", %d layers", b->stack->n);
        add_length(w, "in all ", rb_rolling_layers_depth(b), units);
    } else if (b->layer > 0.0)
        add_length(w, "layer ", b->layer, units);
    add_words(w, ", ");
    add_material(w, b->young, b->poisson, units);
    add_words(w, "%s", b->memory.n > 0 ? ", relaxes" : "");
    if (!(b->layer > 0.0 || b->cover > 0.0))
        return;
    add_words(w, b->layer_base == RB_BASE_SMOOTH ? ", sliding on " : " on ");
    if (below > 0.0)
        add_material(w, below, b->layer > 0.0 ? b->base_poisson : b->core_poisson, units);
    else
        add_words(w, "a rigid %s", b->layer > 0.0 ? "base" : "core");
}

/* The size of letters at which they fit into a line. */
static double size_of(const words *w)
{
    enum { FITS = 92 }; /* letters of the largest size in a line */
    size_t letters = 0; /* of UTF-8 */

    for (size_t k = 0; k < w->n; k++)
        letters += ((unsigned char)w->text[k] & 0xc0) != 0x80;
    return letters > FITS ? 0.95 * FITS / (double)letters : 0.95;
}

static words words_of(const rb_rolling_case *rc, rb_units units)
{
    words w = {.n = 0};
    add_words(&w, "A: ");
    add_body(&w, &rc->a, units);
    add_words(&w, ";  B");
    if (rc->elastic_b) {
        add_words(&w, ": ");
        add_body(&w, &rc->b, units);
    } else
        add_words(&w, " rigid");
    if (rc->plane == RB_PLANE_STRESS)
        add_words(&w, ";  plane stress");
    return w;
}

void rb_report_let_bodies(FILE *script, const rb_rolling_case *rc, rb_units units)
{
    const words w = words_of(rc, units);

    rb_report_let_text(script, "bodies", "{/*%.3g %s}", size_of(&w), w.text);
}
