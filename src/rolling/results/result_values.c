/* Results by the rows of their tables: which cases have them, their values, their memory. */
#include "rolling/case/ellipse.h"
#include "rolling/case/internal.h"
#include "rolling/results/columns.h"
#include "rolling/results/results.h"
#include "rolling/stress/stress.h"
#include "rolling/study/study.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Numbers and columns ------------------------------------------------------------ */

static void *place(const rb_rolling_result *r, const void *owner)
{
    return (char *)owner + r->offset;
}

const rb_rolling_result *rb_rolling_find_result(const rb_rolling_results *table, const char *name)
{
    for (int k = 0; k < table->n; k++)
        if (strcmp(table->row[k].name, name) == 0)
            return &table->row[k];
    return NULL;
}

/* Counts that the case has not are -1. */
double rb_rolling_number(const rb_rolling_result *r, const void *owner)
{
    const void *at = place(r, owner);
    if (r->kind != RB_RESULT_WHOLE)
        return *(const double *)at;
    const int count = *(const int *)at;
    return count < 0 ? (double)NAN : count; /* NAN is a float */
}

void rb_rolling_set_number(const rb_rolling_result *r, void *owner, double value)
{
    memcpy(place(r, owner), &value, sizeof value);
}

double *rb_rolling_column(const rb_rolling_result *r, const void *owner)
{
    double *column;
    memcpy(&column, place(r, owner), sizeof column);
    return column;
}

int rb_rolling_has_column(const rb_rolling_result *r, const void *owner)
{
    return rb_rolling_column(r, owner) != NULL;
}

double rb_rolling_entry(const rb_rolling_result *r, const void *owner, int i)
{
    const void *column = rb_rolling_column(r, owner);
    return r->kind == RB_RESULT_WHOLE ? ((const int *)column)[i] : ((const double *)column)[i];
}

const char *rb_rolling_heading(const rb_rolling_result *r, rb_units units,
                               char heading[RB_ROLLING_HEADING])
{
    const int has_unit = r->unit && strcmp(r->unit, "1") != 0;
    snprintf(heading, RB_ROLLING_HEADING, "%s%s%s", r->symbol ? r->symbol : r->name,
             has_unit ? "_" : "", has_unit ? rb_unit_name(units, r->unit) : "");
    return heading;
}

const rb_rolling_result *rb_rolling_study_column(int k)
{
    for (int i = 0; i < rb_rolling_solution_scalars.n; i++)
        if (rb_rolling_solution_scalars.row[i].study == k)
            return &rb_rolling_solution_scalars.row[i];
    return NULL;
}

/* ---- Which cases have a result ------------------------------------------------------ */

int rb_rolling_has_result(const rb_rolling_result *r, const rb_rolling_case *rc, unsigned varies)
{
    switch (r->condition) {
    case RB_FOR_HEAT:
        return rb_rolling_has_heat(rc);
    case RB_FOR_HEAT_INSIDE:
        return rb_rolling_has_heat(rc) && rc->formulation == RB_STEADY;
    case RB_FOR_WORN:
        return rc->worn.n > 0;
    case RB_FOR_LAW:
        return rc->friction.law != RB_FRICTION_constant || rc->friction.heat != 0.0 ||
               varies & RB_VARIES_MU;
    case RB_FOR_MOVING_LAW:
        return rb_rolling_law_depends_on_state(rc) && rc->formulation != RB_STATIC;
    case RB_FOR_WAY:
        return (varies & RB_VARIES_MU) != 0;
    case RB_FOR_BULK_WAY:
        return (varies & RB_VARIES_BULK) != 0;
    case RB_FOR_BULK_B_WAY:
        return (varies & RB_VARIES_BULK_B) != 0;
    case RB_FOR_TILT_WAY:
        return (varies & RB_VARIES_TILT) != 0;
    case RB_FOR_PERIOD:
        return rc->period > 0.0;
    case RB_FOR_MEMORY:
        return rb_rolling_relaxes(rc);
    case RB_FOR_YIELD:
        return rc->yield_stress > 0.0;
    case RB_FOR_CYLINDER_B:
        return isfinite(rc->b.radius);
    case RB_FOR_TILT:
        return rb_rolling_is_tilted(rc);
    case RB_FOR_ELLIPSE:
        return rc->ellipse.radius > 0.0;
    case RB_FOR_ELLIPSE_FORCE:
        return rc->strips > 0 || rb_rolling_ellipse_slides_alike(rc);
    case RB_FOR_SMOOTH_BASE:
        return rc->formulation != RB_STATIC && rb_rolling_slides_on_base(rc);
    case RB_FOR_FRETTING:
        return rc->fretting;
    case RB_FOR_FRETTING_B:
        return rc->fretting && rc->elastic_b;
    case RB_FOR_ACCURACY:
        return 0;
    case RB_FOR_ALL:
        break;
    }
    return 1;
}

/* ---- Owners ------------------------------------------------------------------------ */

static rb_rolling_solution no_scalars(rb_status status)
{
    rb_rolling_solution s = {.status = status};
    for (int i = 0; i < rb_rolling_solution_scalars.n; i++)
        if (rb_rolling_solution_scalars.row[i].kind != RB_RESULT_WHOLE)
            rb_rolling_set_number(&rb_rolling_solution_scalars.row[i], &s, NAN);
    return s;
}

rb_rolling_row rb_rolling_no_row(rb_status status)
{
    rb_rolling_row row = {.solution = no_scalars(status), .errors.scalar = no_scalars(RB_OK)};
    rb_rolling_stress_maxima *const stress[] = {&row.stress, &row.stress_b, &row.errors.stress,
                                                &row.errors.stress_b};
    for (int i = 0; i < rb_rolling_maxima_scalars.n; i++)
        for (int k = 0; k < 4; k++)
            rb_rolling_set_number(&rb_rolling_maxima_scalars.row[i], stress[k], NAN);
    for (int i = 0; i < RB_ROW_OWN; i++)
        row.own[i] = NAN;
    for (int i = 0; i < RB_ROW_BONDS; i++)
        row.bond[i] = row.bond_error[i] = NAN;
    return row;
}

rb_rolling_solution rb_rolling_scalars_of(const rb_rolling_solution *from)
{
    static const void *const nothing = NULL;
    rb_rolling_solution s = *from;
    s.n = 0;
    s.cone_solver = NULL;
    s.patches = 0;
    s.patch = NULL;
    for (int i = 0; i < rb_rolling_solution_columns.n; i++)
        memcpy(place(&rb_rolling_solution_columns.row[i], &s), &nothing, sizeof nothing);
    return s;
}

rb_status rb_rolling_columns_alloc(const rb_rolling_results *table, const rb_rolling_case *rc,
                                   unsigned varies, int rows, void *owner)
{
    rb_status s = RB_OK;
    for (int k = 0; k < table->n; k++) {
        const rb_rolling_result *r = &table->row[k];
        if (!rb_rolling_has_result(r, rc, varies))
            continue;
        void *column = r->kind == RB_RESULT_WHOLE ? (void *)rb_alloc_int((size_t)rows)
                                                  : rb_alloc((size_t)rows, 1);
        memcpy(place(r, owner), &column, sizeof column);
        if (!column)
            s = RB_ENOMEM;
    }
    return s;
}

void rb_rolling_columns_free(const rb_rolling_results *table, void *owner)
{
    for (int k = 0; k < table->n; k++)
        free(rb_rolling_column(&table->row[k], owner));
}
