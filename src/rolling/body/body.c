/* The table of bodies, and functions for all bodies. */
#include "rolling/body/internal.h"
#include "rolling/case/derived.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

const rb_choice rb_rolling_supports[] = {
    {"arc", RB_BEM_ARC}, {"hub", RB_BEM_HUB}, {"halfplane", RB_BEM_HALFPLANE}, {NULL, 0}};

const rb_rolling_body_kind *const rb_rolling_body_kinds[] = {&rb_rolling_arc,
                                                             &rb_rolling_hub,
                                                             &rb_rolling_halfplane,
                                                             &rb_rolling_layer,
                                                             &rb_rolling_relaxation,
                                                             &rb_rolling_cover,
                                                             NULL};

int rb_rolling_body_is(const rb_rolling_body *body, const rb_rolling_body_kind *kind)
{
    return kind->holds ? kind->holds(body) : kind->support == body->support;
}

const rb_rolling_body_kind *rb_rolling_kind_of(const rb_rolling_body *body)
{
    const rb_rolling_body_kind *const *kind = rb_rolling_body_kinds;
    while (*kind && ((*kind)->holds || (*kind)->support != body->support))
        kind++;
    return *kind;
}

const rb_rolling_body_kind *rb_rolling_body_kind_get(int k)
{
    for (int i = 0; i < k; i++)
        if (!rb_rolling_body_kinds[i])
            return NULL;
    return rb_rolling_body_kinds[k];
}

const char *rb_rolling_kind_name(const rb_rolling_body_kind *kind)
{
    return kind->name;
}

rb_bem_support rb_rolling_kind_support(const rb_rolling_body_kind *kind)
{
    return kind->support;
}

const rb_rolling_parameter *rb_rolling_kind_parameters(const rb_rolling_body_kind *kind)
{
    return kind->parameters;
}

int rb_rolling_body_can(const rb_rolling_body *body, int abilities)
{
    int can = abilities;
    for (const rb_rolling_body_kind *const *kind = rb_rolling_body_kinds; *kind; kind++)
        if (rb_rolling_body_is(body, *kind))
            can &= (*kind)->can;
    return can == abilities;
}

int rb_rolling_same_body(const rb_rolling_body *x, const rb_rolling_body *y)
{
    enum {
        YOUNG = offsetof(rb_rolling_body, young),
        SUPPORT = offsetof(rb_rolling_body, support),
        ARC = offsetof(rb_rolling_body, arc),
        MEMORY = offsetof(rb_rolling_body, memory)
    };
    const char *a = (const char *)x, *b = (const char *)y;

    return memcmp(a + YOUNG, b + YOUNG, SUPPORT - YOUNG) == 0 && x->support == y->support &&
           x->layer_base == y->layer_base && memcmp(a + ARC, b + ARC, MEMORY - ARC) == 0 &&
           x->memory.n == y->memory.n &&
           memcmp(x->memory.time, y->memory.time, sizeof x->memory.time) == 0 &&
           memcmp(x->memory.ratio, y->memory.ratio, sizeof x->memory.ratio) == 0;
}

int rb_rolling_can(const rb_rolling_case *rc, int abilities)
{
    return rb_rolling_body_can(&rc->a, abilities) &&
           (!rc->elastic_b || rb_rolling_body_can(&rc->b, abilities));
}

int rb_rolling_relaxes(const rb_rolling_case *rc)
{
    return !rb_rolling_can(rc, RB_BODY_ELASTIC);
}

double rb_rolling_datum(const rb_rolling_case *rc, const rb_rolling_body *body)
{
    const rb_rolling_body_kind *kind = rb_rolling_kind_of(body);
    return kind->datum ? kind->datum(rc, body) : NAN;
}
