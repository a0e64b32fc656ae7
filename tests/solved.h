/* Rolling cases that must be solved; the reason where one is not. */
#ifndef SOLVED_H
#define SOLVED_H

#include "check.h"
#include "rolling/rolling.h"

/* To be freed by the caller, as the next. */
static inline rb_rolling_solution solved(const rb_rolling_case *rc)
{
    rb_rolling_solution s;
    const double start = rb_seconds();
    CHECK_OK(rb_rolling_solve(rc, &s, &message));
    CHECK_MAX(s.seconds_total, rb_seconds() - start, "no more seconds than have passed");
    return s;
}

/* The case of a model, of which a test wants to know what it does under another one. */
static inline rb_rolling_case *case_of_model(rb_rolling_model *model)
{
    return (rb_rolling_case *)model->rc;
}

static inline rb_rolling_model solved_model(const rb_rolling_case *rc)
{
    rb_rolling_model model;
    CHECK_OK(rb_rolling_model_create(rc, &model, &message));
    return model;
}

static inline rb_rolling_solution solution_of(const rb_rolling_model *model)
{
    rb_rolling_solution s;
    CHECK_OK(rb_rolling_model_solution(model, &s, &message));
    return s;
}

#endif
