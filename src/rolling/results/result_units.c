/* Results in other units, by the rows of their tables. */
#include "base/units.h"
#include "rolling/results/results.h"
#include "rolling/stress/stress.h"
#include "rolling/study/study.h"

/* What the table has no row for stands in no unit, or is named by the caller. */
void rb_rolling_numbers_convert(const rb_rolling_results *t, void *owner, rb_units units)
{
    for (int k = 0; k < t->n; k++) {
        const rb_rolling_result *r = &t->row[k];
        if (r->unit && r->kind == RB_RESULT_NUMBER)
            rb_rolling_set_number(r, owner,
                                  rb_unit_shown(units, r->unit, rb_rolling_number(r, owner)));
    }
}

void rb_rolling_columns_convert(const rb_rolling_results *t, int rows, void *owner, rb_units units)
{
    for (int k = 0; k < t->n; k++) {
        const rb_rolling_result *r = &t->row[k];
        double *x = rb_rolling_column(r, owner);
        for (int i = 0; i < rows && x && r->unit && r->kind == RB_RESULT_NUMBER; i++)
            x[i] = rb_unit_shown(units, r->unit, x[i]);
    }
}

void rb_rolling_solution_convert(rb_rolling_solution *s, rb_units units)
{
    s->units = units;
    if (units == RB_UNITS_MM)
        return;
    rb_rolling_numbers_convert(&rb_rolling_solution_scalars, s, units);
    rb_rolling_columns_convert(&rb_rolling_solution_columns, s->n, s, units);
    s->rows.jump_shift = rb_unit_shown(units, "mm", s->rows.jump_shift);
    s->rows.jump_force = rb_unit_shown(units, "N/mm", s->rows.jump_force);
    for (int k = 0; k < s->patches; k++)
        rb_rolling_numbers_convert(&rb_rolling_patch_scalars, &s->patch[k], units);
}

void rb_rolling_history_convert(rb_rolling_history *h, rb_units units)
{
    if (h->errors)
        rb_rolling_history_convert(h->errors, units);
    if (h->deviations)
        rb_rolling_history_convert(h->deviations, units);
    h->units = units;
    if (units == RB_UNITS_MM)
        return;
    rb_rolling_columns_convert(&rb_rolling_history_columns, h->n, h, units);
    h->half_width = rb_unit_shown(units, "mm", h->half_width);
    h->step = rb_unit_shown(units, "mm", h->step);
    h->cycle_work = rb_unit_shown(units, "N", h->cycle_work);
    h->rows.jump_shift = rb_unit_shown(units, "mm", h->rows.jump_shift);
    h->rows.jump_force = rb_unit_shown(units, "N/mm", h->rows.jump_force);
}

void rb_rolling_wear_history_convert(rb_rolling_wear_history *h, rb_units units)
{
    const char *work = h->slides || h->rolls ? "N/mm" : "N";

    h->units = units;
    if (units == RB_UNITS_MM)
        return;
    rb_rolling_columns_convert(&rb_rolling_wear_columns, h->n, h, units);
    for (int k = 0; k < h->n; k++) {
        h->work[k] = rb_unit_shown(units, work, h->work[k]);
        if (h->slides)
            h->way[k] = rb_unit_shown(units, "mm", h->way[k]);
    }
    h->radius_before = rb_unit_shown(units, "mm", h->radius_before);
    h->radius_b_before = rb_unit_shown(units, "mm", h->radius_b_before);
    if (h->errors)
        rb_rolling_wear_history_convert(h->errors, units);
}

void rb_rolling_curve_convert(rb_rolling_curve *c, rb_units units)
{
    if (c->deviations)
        rb_rolling_curve_convert(c->deviations, units);
    rb_rolling_solution_convert(&c->last, units);
    c->units = units;
    if (units == RB_UNITS_MM)
        return;
    rb_rolling_columns_convert(&rb_rolling_curve_columns, c->n, c, units);
    c->half_width = rb_unit_shown(units, "mm", c->half_width);
}

void rb_rolling_stress_convert(int n, rb_rolling_stress *at, rb_rolling_stress_maxima *largest,
                               rb_units units)
{
    for (int k = 0; k < n && units != RB_UNITS_MM; k++)
        rb_rolling_numbers_convert(&rb_rolling_stress_scalars, &at[k], units);
    rb_rolling_numbers_convert(&rb_rolling_maxima_scalars, largest, units);
    for (int k = 0; k < largest->bonds; k++)
        rb_rolling_numbers_convert(&rb_rolling_bond_scalars, &largest->bond[k], units);
}

void rb_rolling_row_convert(rb_rolling_row *row, rb_units units)
{
    rb_rolling_solution_convert(&row->solution, units);
    rb_rolling_solution_convert(&row->errors.scalar, units);
    rb_rolling_stress_maxima *const stress[] = {&row->errors.stress, &row->errors.stress_b,
                                                &row->stress, &row->stress_b};
    for (int k = 0; k < 4; k++)
        rb_rolling_stress_convert(0, NULL, stress[k], units);
}
