/* Functions for all references of `verify`: compare, solve, make a common case. */
#include "program/verify/internal.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

static void hand_on(rb_verify *v, rb_verify_check *c, const char *what, va_list args)
{
    vsnprintf(c->what, sizeof c->what, what, args);
    c->error = fabs(c->got - c->wanted) / (c->relative ? fabs(c->wanted) : 1.0);
    c->holds = c->error <= c->bound; /* false for NaN */
    c->why = v->why;
    v->failed += !c->holds;
    v->each(c, v->context);
}

void rb_verify_absolute(rb_verify *v, double got, double wanted, double bound, const char *what,
                        ...)
{
    rb_verify_check c = {.wanted = wanted, .got = got, .bound = bound};
    va_list args;
    va_start(args, what);
    hand_on(v, &c, what, args);
    va_end(args);
}

void rb_verify_relative(rb_verify *v, double got, double wanted, double bound, const char *what,
                        ...)
{
    rb_verify_check c = {.wanted = wanted, .got = got, .bound = bound, .relative = 1};
    va_list args;
    va_start(args, what);
    hand_on(v, &c, what, args);
    va_end(args);
}

void rb_verify_note(rb_verify *v, rb_status s, const rb_message *why)
{
    v->said = *why;
    v->why = s == RB_OK ? NULL : why->text[0] ? v->said.text : rb_status_text(s);
}

const rb_rolling_solution *rb_verify_solve(rb_verify *v, const rb_rolling_case *rc)
{
    rb_rolling_solution *s = &v->solved[v->last = !v->last];
    rb_message why = {.text = ""};
    rb_rolling_solution_free(s);
    *s = (rb_rolling_solution){0};
    const rb_status status = rb_rolling_solve(rc, s, &why);
    rb_verify_note(v, status, &why);
    if (status != RB_OK) {
        s->normal_load = s->force_ratio = s->max_pressure = s->half_width = NAN;
        s->approach = s->creepage = s->stick_from = s->stick_to = s->dissipation = NAN;
        s->max_temperature = s->ellipse_force = NAN;
    }
    return s;
}

rb_rolling_case rb_verify_uncoupled(void)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a.support = RB_BEM_HALFPLANE;
    rc.a.poisson = 0.5;
    rc.gap = RB_GAP_PARABOLA;
    rc.half_width = rc.a.radius * 1e-4;
    rc.mesh = RB_MESH_FITTED;
    rc.contact_elements = 100;
    return rc;
}

void rb_verify_on_same(rb_rolling_case *rc)
{
    rc->b = rc->a;
    rc->b.radius = INFINITY;
    rc->elastic_b = 1;
}

/* Aluminium on steel rolling freely, R_A = R_B = 50, a = 0.1. */
rb_rolling_case rb_verify_aluminium_on_steel(double mu)
{
    rb_rolling_case rc = rb_verify_uncoupled();
    rc.a.young = 2.0 * 23000.0 * 1.31;
    rc.a.poisson = 0.31;
    rc.b = rc.a;
    rc.b.young = 2.0 * 82000.0 * 1.28;
    rc.b.poisson = 0.28;
    rc.elastic_b = 1;
    rc.half_width = 0.1;
    rc.mu = mu;
    rc.formulation = RB_STEADY;
    rc.force = 0.0;
    return rc;
}
