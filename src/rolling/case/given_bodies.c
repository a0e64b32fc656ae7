/* The bodies as they are given: what B has of A, layers, memory, and the options that mean nothing
 * to bodies of this kind. */
#include "rolling/body/body.h"
#include "rolling/case/internal.h"
#include "rolling/case/words.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- Body B ------------------------------------------------------------------------ */

int rb_case_is_copied_to_b(const char *option)
{
    const rb_option *o = rb_case_option(option);
    return o && o->if_similar && !o->into;
}

/* 1: without a value of its own B has that of A. */
static int would_follow(const rb_case *c, const rb_option *o)
{
    const rb_resolved_case *s = &c->resolved;
    const int is_b = strcmp(rb_case_section(o), "body-b") == 0;
    return o->of_a && (s->similar || !o->if_similar) &&
           (!is_b || (s->rc.elastic_b && rb_option_applies(o, &s->rc.b)));
}

int rb_case_is_own_of_b(const rb_case *c, const char *option)
{
    const rb_option *o = rb_case_option(option);
    return rb_case_given(c, option) != 0 &&
           (strncmp(option, "relaxation-", 11) == 0 ? c->resolved.similar : would_follow(c, o));
}

static rb_status resolve_body_b(rb_case *c, rb_message *why)
{
    rb_resolved_case *s = &c->resolved;
    rb_rolling_case *rc = &s->rc;
    rc->elastic_b = s->similar || !isnan(s->young_b) || s->layers_file_b;
    if (!rc->elastic_b)
        s->young_b = s->poisson_b = NAN;
    for (const rb_option *o = rb_case_table; o < rb_case_table + rb_case_table_n; o++) {
        const int is_b = strcmp(rb_case_section(o), "body-b") == 0;
        /* Options of the second body mean nothing to a rigid plane. */
        if (is_b && !rc->elastic_b && c->given[o - rb_case_table] &&
            o->kind != RB_OPTION_FLAG) /* "similar = no" says so */
            return rb_case_refuse_option(c, o, "body B is rigid without --similar or --young-b",
                                         why);
        if ((is_b && !rc->elastic_b) || (!o->into && !o->of_a))
            continue;
        /* What is given of B lies in its place; the rest is A's, as the table says. */
        if (o->kind == RB_OPTION_CHOICE) {
            if (would_follow(c, o) && !c->given[o - rb_case_table])
                *(int *)(void *)((char *)rc + o->offset) =
                    *(const int *)(const void *)((char *)rc + o->of_a);
            continue;
        }
        double *to = (double *)(void *)((char *)rc + (o->into ? o->into : o->offset));
        const double *typed = (const double *)(const void *)((char *)s + o->offset);
        if (o->into && !isnan(*typed))
            *to = *typed;
        else if (would_follow(c, o) && !c->given[o - rb_case_table])
            *to = *(const double *)(const void *)((char *)rc + o->of_a);
    }
    if (!rc->elastic_b)
        return RB_OK;
    rc->b.stack = s->similar && rc->b.layer == rc->a.layer ? rc->a.stack : NULL;
    const rb_status status = rb_case_read_layers(c, 1, why);
    if (status != RB_OK)
        return status;
    if (s->similar && !rb_case_given(c, "relaxation-time-b") &&
        !rb_case_given(c, "relaxation-ratio-b"))
        s->memory_b = s->memory_a;
    s->young_b = rc->b.young;
    s->poisson_b = rc->b.poisson;
    return RB_OK;
}

/* ---- Layers, memory, supports ------------------------------------------------------- */

/* As many times as ratios. */
static rb_status resolve_memory(const rb_case_memory *typed, const char *which,
                                rb_rolling_memory *memory, rb_message *why)
{
    if (typed->times.n != typed->ratios.n)
        return rb_refuse(why,
                         *which ? "relaxation-time-b,relaxation-ratio-b"
                                : "relaxation-time,relaxation-ratio",
                         "expected as many numbers as --relaxation-ratio%s has, %d, got %d", which,
                         typed->ratios.n, typed->times.n);
    memory->n = typed->times.n;
    for (int k = 0; k < memory->n; k++) {
        memory->time[k] = typed->times.value[k];
        memory->ratio[k] = typed->ratios.value[k];
    }
    return RB_OK;
}

/* An option of one support or addition has no effect on other bodies.  In a file it may
 * stand beside a support that the command line replaces. */
static rb_status check_parameter(const rb_case *c, int is_b, const rb_rolling_body_kind *kind,
                                 const rb_rolling_parameter *parameter, rb_message *why)
{
    const rb_rolling_body *body = is_b ? &c->resolved.rc.b : &c->resolved.rc.a;
    const int support_by = rb_case_given(c, is_b ? "support-b" : "support");
    char name[40], reason[80];
    const char *word = NULL;

    if (parameter->has_meaning ? parameter->has_meaning(body) : rb_rolling_body_is(body, kind))
        return RB_OK;
    strcpy(name, parameter->option);
    if (is_b)
        strcat(name, "-b");
    if (!rb_case_given(c, name)) /* before any words: derivatives resolve a case often */
        return RB_OK;
    if (parameter->reason)
        return rb_case_refuse_given(c, name, parameter->reason, why);
    for (const rb_choice *support = rb_rolling_supports; support->name; support++)
        if (support->value == (int)rb_rolling_kind_support(kind))
            word = support->name;
    snprintf(reason, sizeof reason, "it needs the support %s", word);
    return rb_case_given(c, name) > 0 && support_by == RB_GIVEN_ARGUMENT
               ? RB_OK
               : rb_case_refuse_given(c, name, reason, why);
}

/* Poisson's ratio of a base or core that is rigid: said, unless "rigid" was written, as in a study
 * that goes to this limit. */
static rb_status check_rigid_parts(const rb_case *c, rb_message *why)
{
    static const char base[] = "the base is rigid without --base-young",
                      core[] = "the core is rigid without --core-young",
                      base_b[] = "the base of B is rigid without --base-young-b",
                      core_b[] = "the core of B is rigid without --core-young-b";
    const rb_rolling_body *a = &c->resolved.rc.a, *b = &c->resolved.rc.b;
    const rb_case_rule rules[] = {
        {a->base_young == 0.0 && !rb_case_given(c, "base-young"), "base-poisson", base},
        {a->core_young == 0.0 && !rb_case_given(c, "core-young"), "core-poisson", core},
        {b->base_young == 0.0 && !rb_case_given(c, "base-young-b"), "base-poisson-b", base_b},
        {b->core_young == 0.0 && !rb_case_given(c, "core-young-b"), "core-poisson-b", core_b}};

    return rb_case_refuse_by(c, sizeof rules / sizeof *rules, rules, why);
}

/* Elements outside the contact, where a wheel has a boundary there.  As the options of a support,
 * what stands in the case file gives way to supports of the command line. */
static rb_status check_boundary(const rb_case *c, rb_message *why)
{
    static const char no_wheel[] = "it needs a wheel, half-planes have no elements around them";
    const rb_rolling_case *rc = &c->resolved.rc;
    const int is_flat = rb_rolling_can(rc, RB_BODY_FLAT),
              gives_way = rb_case_given(c, "support") == RB_GIVEN_ARGUMENT ||
                          rb_case_given(c, "support-b") == RB_GIVEN_ARGUMENT;
    rb_case_rule rules[] = {
        {is_flat && rc->outer_elements > 0, "outer-elements", no_wheel},
        {is_flat && rc->near_field != RB_NEAR_FIELD_AUTO, "near-field", no_wheel}};

    for (size_t k = 0; k < sizeof rules / sizeof *rules; k++)
        rules[k].has_no_meaning &= !(rb_case_given(c, rules[k].option) > 0 && gives_way);
    return rb_case_refuse_by(c, sizeof rules / sizeof *rules, rules, why);
}

/* What stands in a file of layers is not given a second time. */
static rb_status check_layers(const rb_case *c, rb_message *why)
{
    static const char of_a[] = "the first row of --layers says it; leave one of them out",
                      of_b[] = "the first row of --layers-b says it; leave one of them out",
                      similar[] = "B has all layers of A; leave --similar or this out";
    const rb_resolved_case *s = &c->resolved;
    const int a = s->layers_file != NULL, b = s->layers_file_b != NULL;
    enum { REPLACED = 2 * CASE_OF_LAYERS };
    rb_case_rule rules[REPLACED + 2] = {
        [REPLACED] = {b && s->similar, "similar",
                      "B has the layers of --layers-b; leave one of them out"},
        {a && s->similar, "layer-thickness-b", similar}};
    for (int k = 0; k < REPLACED; k++) {
        const int of = k / CASE_OF_LAYERS;
        rules[k] =
            (rb_case_rule){of ? b : a, rb_case_of_layers[of][k % CASE_OF_LAYERS], of ? of_b : of_a};
    }
    /* what stands in the case file gives way to layers of the command line */
    for (size_t k = 0; k < sizeof rules / sizeof *rules; k++)
        rules[k].has_no_meaning &=
            rb_case_given(c, rules[k].option) < 0 ||
            rb_case_given(c, rules[k].reason == of_a ? "layers" : "layers-b") > 0;
    return rb_case_refuse_by(c, sizeof rules / sizeof *rules, rules, why);
}

rb_status rb_case_resolve_bodies(rb_case *c, rb_message *why)
{
    rb_resolved_case *s = &c->resolved;
    rb_status status = check_layers(c, why);
    if (status == RB_OK)
        status = rb_case_read_layers(c, 0, why);
    if (status == RB_OK)
        status = resolve_body_b(c, why);
    if (status == RB_OK)
        status = resolve_memory(&s->memory_a, "", &s->rc.a.memory, why);
    if (status == RB_OK)
        status = resolve_memory(&s->memory_b, "-b", &s->rc.b.memory, why);
    for (int body = 0; body < 2; body++) {
        const rb_rolling_body_kind *kind;
        for (int k = 0; (kind = rb_rolling_body_kind_get(k)); k++)
            for (const rb_rolling_parameter *p = rb_rolling_kind_parameters(kind); p->option; p++) {
                if (status != RB_OK)
                    return status;
                status = check_parameter(c, body, kind, p, why);
            }
    }
    if (status == RB_OK)
        status = check_boundary(c, why);
    return status == RB_OK ? check_rigid_parts(c, why) : status;
}
