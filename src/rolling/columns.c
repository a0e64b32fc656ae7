#include "rolling/internal.h"

#include <stdlib.h>

#define CURVE(member) offsetof(rb_rolling_curve, member)
#define HISTORY(member) offsetof(rb_rolling_history, member)

static const size_t curve[] = {
    CURVE(creepage),    CURVE(creep_ratio), CURVE(force_ratio), CURVE(tangential_load),
    CURVE(normal_load), CURVE(stick_ratio), CURVE(dissipation), CURVE(residual)};

static const size_t history[] = {
    HISTORY(distance),     HISTORY(creepage),    HISTORY(shift),
    HISTORY(approach),     HISTORY(normal_load), HISTORY(tangential_load),
    HISTORY(force_ratio),  HISTORY(residual),    HISTORY(max_pressure),
    HISTORY(contact_from), HISTORY(contact_to),  HISTORY(dissipation),
    HISTORY(moment)};

const rb_rolling_columns rb_rolling_curve_columns = {sizeof curve / sizeof *curve, curve};
const rb_rolling_columns rb_rolling_history_columns = {sizeof history / sizeof *history,
                                                       history};

static double **pointer(const void *owner, size_t offset)
{
    return (double **)((char *)owner + offset);
}

double *rb_rolling_column(const void *owner, size_t offset)
{
    return *pointer(owner, offset);
}

rb_status rb_rolling_columns_alloc(const rb_rolling_columns *columns, int rows,
                                   void *owner)
{
    rb_status s = RB_OK;

    for (int k = 0; k < columns->n; k++) {
        *pointer(owner, columns->offset[k]) = rb_alloc((size_t)rows, 1);
        if (!rb_rolling_column(owner, columns->offset[k]))
            s = RB_ENOMEM;
    }
    return s;
}

void rb_rolling_columns_free(const rb_rolling_columns *columns, void *owner)
{
    for (int k = 0; k < columns->n; k++)
        free(rb_rolling_column(owner, columns->offset[k]));
}
