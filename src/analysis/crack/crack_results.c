/* The results of a crack by name: numbers of a pass, positions, lengths; in other units,
 * and as a row of a study. */
#include "analysis/crack/crack.h"
#include "analysis/crack/crack_case.h"
#include "rolling/case/words.h"

#include <gsl/gsl_math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* ---- Tables ------------------------------------------------------------------------ */

#define OF(type, name_, member, ...)                                                               \
    {                                                                                              \
        .name = name_, .offset = offsetof(type, member), __VA_ARGS__                               \
    }
#define NUMBER(name, ...) OF(rb_case_crack_summary, #name, name, __VA_ARGS__)
#define COLUMN(name, ...) OF(rb_crack_history, #name, name, __VA_ARGS__)
#define PLACE_OF(name) offsetof(rb_case_crack_summary, name)
#define IS_K .unit = "MPa.mm^0.5", .error_bar = RB_SCALE_PRESSURE

static const rb_rolling_result scalars[] = {
    NUMBER(K_I_max, IS_K, .meaning = "largest K_I at the tip in the last pass"),
    NUMBER(K_I_min, IS_K, .meaning = "smallest K_I"),
    NUMBER(K_II_max, IS_K,
           .meaning = "largest K_II; > 0: the face on the side of +x slides towards the tip"),
    NUMBER(K_II_min, IS_K, .meaning = "smallest K_II"),
    NUMBER(delta_K_I, IS_K, .meaning = "K_I_max - K_I_min"),
    NUMBER(delta_K_II, IS_K, .meaning = "K_II_max - K_II_min"),
    NUMBER(K_I_max_at, .unit = "mm", .meaning = "position of the contact"),
    NUMBER(K_II_max_at, .unit = "mm", .meaning = "position of the contact"),
    NUMBER(K_II_min_at, .unit = "mm", .meaning = "position of the contact"),
    NUMBER(K_II_at_K_I_max, IS_K, .meaning = "K_II where K_I is largest: the phase"),
    NUMBER(K_theta_max, IS_K,
           .meaning = "largest tension across any direction ahead of the tip times "
                      "sqrt(2 pi r), over the pass (Erdogan and Sih)"),
    NUMBER(kink_angle, .unit = "degrees",
           .meaning = "that direction, from the crack's own, counter-clockwise"),
    NUMBER(K_I_max_upper, IS_K,
           .meaning = "largest K_I at the upper end of a crack below the surface"),
    NUMBER(K_I_min_upper, IS_K, .meaning = "smallest K_I there"),
    NUMBER(K_II_max_upper, IS_K, .meaning = "largest K_II there"),
    NUMBER(K_II_min_upper, IS_K, .meaning = "smallest K_II there"),
    NUMBER(open_max, .unit = "mm", .meaning = "largest open length"),
    NUMBER(fluid_pressure_max, .unit = "MPa", .meaning = "of the fluid in the crack"),
    NUMBER(pass_change, IS_K,
           .meaning = "largest change of K_I or K_II since the pass before: shakedown"),
    NUMBER(max_pressure, .unit = "MPa",
           .meaning = "of the contact if it depends on the crack; at the mouth it is "
                      "singular and grows with the number of elements"),
    NUMBER(residual, .meaning = "natural residual of the scaled problem of a step"),
};

static const rb_rolling_result columns[] = {
    COLUMN(x, .unit = "mm", .meaning = "position of the contact"),
    COLUMN(K_I, IS_K, .meaning = "opening, at the tip"),
    COLUMN(K_II, IS_K, .meaning = "sliding, at the tip"),
    COLUMN(K_I_upper, IS_K, .meaning = "at the upper end below the surface"),
    COLUMN(K_II_upper, IS_K, .meaning = "at the upper end below the surface"),
    COLUMN(open_length, .unit = "mm", .meaning = "of the faces that are apart"),
    COLUMN(stick_length, .unit = "mm", .meaning = "of the faces that do not slide"),
    COLUMN(fluid_pressure, .unit = "MPa", .meaning = "in the crack"),
    COLUMN(max_pressure, .unit = "MPa", .meaning = "of a contact that depends on the crack"),
};

#define GROWTH(name, ...) OF(rb_case_crack_growth, #name, name, __VA_ARGS__)
static const rb_rolling_result growth_columns[] = {
    GROWTH(length, .unit = "mm", .meaning = "along the crack"),
    GROWTH(tip_x, .unit = "mm", .meaning = "of the tip"),
    GROWTH(tip_y, .unit = "mm", .meaning = "of the tip"),
    GROWTH(angle, .unit = "degrees", .meaning = "to the surface, of its last piece"),
    GROWTH(K_I_max, IS_K, .meaning = "in a pass at this length"),
    GROWTH(delta_K_II, IS_K, .meaning = "in a pass at this length"),
    GROWTH(delta_K, IS_K, .meaning = "that makes it grow"),
    GROWTH(rate, .unit = "mm", .meaning = "da/dN, a pass"),
    GROWTH(cycles, .meaning = "passes until it has this length"),
};

#define TABLE(rows)                                                                                \
    {                                                                                              \
        sizeof(rows) / sizeof *(rows), rows                                                        \
    }
const rb_rolling_results rb_case_crack_scalars = TABLE(scalars);
const rb_rolling_results rb_case_crack_columns = TABLE(columns);
const rb_rolling_results rb_case_crack_growth_columns = TABLE(growth_columns);

const rb_rolling_result_table *rb_case_result_table(int k)
{
    static const rb_rolling_result_table of_cracks[] = {
        {"crack", "Numbers of a pass over a crack", &rb_case_crack_scalars},
        {"position", "Positions of a contact over a crack", &rb_case_crack_columns},
        {"growth", "Lengths of a crack that grows", &rb_case_crack_growth_columns}};
    const rb_rolling_result_table *t = rb_rolling_result_tables;
    for (; t->name && k > 0; t++)
        k--;
    return t->name ? t : k < (int)(sizeof of_cracks / sizeof *of_cracks) ? &of_cracks[k] : NULL;
}

/* As bars of contacts: where the mouth and the edges lie in their elements changes from mesh to
 * mesh, and two of them agree by chance. */
void rb_case_crack_set_errors(const rb_case_crack_summary contact[2],
                              const rb_case_crack_summary *crack, rb_case_crack_result *r)
{
    for (const rb_rolling_result *row = scalars; row < scalars + rb_case_crack_scalars.n; row++) {
        const double own = rb_rolling_number(row, &r->summary),
                     one = rb_rolling_number(row, &contact[0]),
                     another = rb_rolling_number(row, &contact[1]);
        const double spread = fmax(own, fmax(one, another)) - fmin(own, fmin(one, another));
        rb_rolling_set_number(row, &r->errors,
                              isnan(one + another)
                                  ? NAN
                                  : 3.0 * spread + 2.0 * fabs(own - rb_rolling_number(row, crack)));
    }
}

int rb_case_crack_has_result(const rb_rolling_result *r, const rb_case_crack *k)
{
    return strstr(r->name, "_upper")                   ? k->depth > 0.0
           : r->offset == PLACE_OF(fluid_pressure_max) ? k->fluid != RB_CRACK_DRY
           : r->offset == PLACE_OF(pass_change)        ? k->passes > 1
           : r->offset == PLACE_OF(max_pressure)       ? k->coupled
                                                       : 1;
}

void rb_case_crack_convert(rb_case_crack_result *r, rb_units units)
{
    rb_case_result_convert(&r->contact, units);
    r->units = units;
    if (units == RB_UNITS_MM)
        return;
    r->half_width = rb_unit_shown(units, "mm", r->half_width);
    rb_rolling_numbers_convert(&rb_case_crack_scalars, &r->summary, units);
    rb_rolling_numbers_convert(&rb_case_crack_scalars, &r->errors, units);
    rb_rolling_columns_convert(&rb_case_crack_columns, r->history.n, &r->history, units);
    rb_rolling_columns_convert(&rb_case_crack_growth_columns, r->growth.n, &r->growth, units);
    for (int i = 0; i < 2 * r->history.n * r->history.nodes; i++)
        r->history.D[i] = rb_unit_shown(units, "mm", r->history.D[i]);
}

void rb_case_crack_free(rb_case_crack_result *r)
{
    rb_case_result_free(&r->contact);
    rb_rolling_states_free(&r->states);
    rb_crack_history_free(&r->history);
    free(r->position);
    r->position = NULL;
    r->positions = 0;
    free(r->growth.length);
    r->growth.length = NULL;
}

/* ---- What a pass comes to ---------------------------------------------------------- */

/* Steps of the smallest and the largest of n values, from `from` on. */
static void extremes(const double *value, int from, int n, int *least, int *most)
{
    *least = *most = from;
    for (int k = from + 1; k < n; k++) {
        if (value[k] < value[*least])
            *least = k;
        if (value[k] > value[*most])
            *most = k;
    }
}

/* Of faces that stick many steps have the same K but for rounding: the first of those like k. */
static int first_like(const double *value, int from, int n, int k)
{
    const double rounding = 1e-9 * rb_norm_inf((size_t)(n - from), value + from);
    int i = from;
    while (fabs(value[i] - value[k]) > rounding)
        i++;
    return i;
}

rb_case_crack_summary rb_case_crack_summarise(const rb_crack_history *h, int passes)
{
    const int n = h->n, steps = n / GSL_MAX(passes, 1), from = n - steps;
    rb_case_crack_summary s = {.from = from, .pass_change = NAN};
    int least, most;

    extremes(h->K_I, from, n, &least, &most);
    s.K_I_min = h->K_I[least];
    s.K_I_max = h->K_I[most];
    most = first_like(h->K_I, from, n, most);
    s.K_I_max_at = h->x[most];
    s.K_II_at_K_I_max = h->K_II[most];
    extremes(h->K_II, from, n, &least, &most);
    s.K_II_min = h->K_II[least];
    s.K_II_max = h->K_II[most];
    s.K_II_min_at = h->x[first_like(h->K_II, from, n, least)];
    s.K_II_max_at = h->x[first_like(h->K_II, from, n, most)];
    s.delta_K_I = s.K_I_max - s.K_I_min;
    s.delta_K_II = s.K_II_max - s.K_II_min;
    s.K_I_max_upper = s.K_I_min_upper = s.K_II_max_upper = s.K_II_min_upper = NAN;
    if (h->K_I_upper) {
        extremes(h->K_I_upper, from, n, &least, &most);
        s.K_I_min_upper = h->K_I_upper[least];
        s.K_I_max_upper = h->K_I_upper[most];
        extremes(h->K_II_upper, from, n, &least, &most);
        s.K_II_min_upper = h->K_II_upper[least];
        s.K_II_max_upper = h->K_II_upper[most];
    }
    for (int k = from; k < n; k++) {
        double theta;
        const double tension = rb_crack_largest_tension(h->K_I[k], h->K_II[k], &theta);
        if (k == from || tension > s.K_theta_max) {
            s.K_theta_max = tension;
            s.kink_angle = theta * (180.0 / M_PI);
        }
        if (passes > 1) /* fmax takes the other one of a NAN */
            s.pass_change = fmax(s.pass_change, fmax(fabs(h->K_I[k] - h->K_I[k - steps]),
                                                     fabs(h->K_II[k] - h->K_II[k - steps])));
    }
    s.open_max = rb_norm_inf((size_t)steps, h->open_length + from);
    s.fluid_pressure_max = rb_norm_inf((size_t)steps, h->fluid_pressure + from);
    s.max_pressure = h->max_pressure ? rb_norm_inf((size_t)n, h->max_pressure) : NAN;
    s.residual = rb_norm_inf((size_t)n, h->residual);
    return s;
}

/* ---- A row of a study -------------------------------------------------------------- */

enum { NUMBERS = sizeof scalars / sizeof *scalars };
_Static_assert(2 * NUMBERS <= RB_ROW_OWN, "numbers and their error bars");

void rb_case_crack_set_row(rb_case_crack_result *r, rb_rolling_row *row)
{
    for (int i = 0; i < NUMBERS; i++) {
        row->own[i] = rb_rolling_number(&scalars[i], &r->summary);
        row->own[NUMBERS + i] = r->has_errors ? rb_rolling_number(&scalars[i], &r->errors) : NAN;
    }
}

double rb_case_crack_of_row(const rb_rolling_result *r, int is_error, const rb_rolling_row *row)
{
    return row->own[(is_error ? NUMBERS : 0) + (r - scalars)];
}
