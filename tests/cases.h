/* Rolling cases that several tests share. */
#ifndef ROLLBEM_TESTS_CASES_H
#define ROLLBEM_TESTS_CASES_H

#include "check.h"
#include "rolling/case/case.h"

#include <math.h>
#include <string.h>

/* ---- Cases by words ---------------------------------------------------------------- */

/* One option and its value (NULL: a flag), checked by the table of the program's options. */
static inline void set_option_(rb_resolved_case *all, const char *name, const char *value)
{
    const rb_option_set set = {rb_case_table, rb_case_table_n, all, NULL, NULL};
    const rb_option *o = rb_case_option(name);
    char *place = (char *)all;

    if (!o || o->kind == RB_OPTION_TEXT || (o->kind != RB_OPTION_FLAG && !value))
        fail_msg("no words of a case: %s %s", name, value ? value : "");
    const int none = o->word && o->word_value == 0.0 && strcmp(value, "0") == 0;
    if (o->kind == RB_OPTION_NUMBER && (none || strcmp(value, "nan") == 0))
        *(double *)(void *)(place + o->offset) = atof(value);
    else
        CHECK_OK(rb_option_assign(&set, (int)(o - rb_case_table), 0, name, value ? value : "yes",
                                  &message));
    if (o->path && *(const int *)(const void *)(place + o->offset) == o->path_value)
        fail_msg("a file or a solver of another name: %s %s", name, value);
    if (o->into)
        memcpy(place + o->into, place + o->offset, sizeof(double));
    if (strcmp(name, "young-b") == 0)
        all->rc.elastic_b = 1;
}

static inline void take_numbers_(double *to, const rb_numbers *from)
{
    memcpy(to, from->value, sizeof *to * (size_t)from->n);
}

static inline void take_memory_(rb_rolling_memory *to, const rb_case_memory *from)
{
    if (from->times.n == 0)
        return;
    assert_int_equal(from->times.n, from->ratios.n);
    to->n = from->times.n;
    take_numbers_(to->time, &from->times);
    take_numbers_(to->ratio, &from->ratios);
}

static inline void take_law_(rb_rolling_friction *to, const rb_case_law *from)
{
    take_numbers_(to->fall, &from->falls);
    take_numbers_(to->slip_scale, &from->slip_scales);
    if (from->memories.n > 0) {
        to->memory = from->memory;
        to->memory_slip = from->memories.n > 1 ? from->memories.value[1] : 1.0;
    }
    if (from->heats.n == 3) {
        to->heat = from->heat;
        to->heat_from = from->heats.value[1];
        to->heat_range = from->heats.value[2];
    }
}

static inline void set_words_(rb_rolling_case *rc, const char *words, va_list values)
{
    rb_resolved_case all = {.rc = *rc};
    char format[1000], text[1000], *at = format, *rest = text;

    for (const char *w = words; *w; w++) /* %g has all digits */
        at += sprintf(at, w > words && w[-1] == '%' && *w == 'g' ? ".17%c" : "%c", *w);
    vsnprintf(text, sizeof text, format, values);
    for (char *name; (name = strtok_r(rest, " ", &rest));) {
        const rb_option *o = rb_case_option(name);
        const int is_flag = o && o->kind == RB_OPTION_FLAG;
        set_option_(&all, name, is_flag ? NULL : strtok_r(NULL, " ", &rest));
    }
    take_memory_(&all.rc.a.memory, &all.memory_a);
    take_memory_(&all.rc.b.memory, &all.memory_b);
    take_law_(&all.rc.friction, &all.law);
    *rc = all.rc;
    if (all.similar) {
        rc->b = rc->a;
        rc->b.radius = INFINITY;
        rc->elastic_b = 1;
    }
}

/* set(&rc, "load %g steps %d mesh fitted similar", load, steps): changes a case by options of
 * the program and their values; %g gives all digits of a number.  A number that is nan is not
 * given, and 0 stands for none, auto, rigid.  `similar` gives B everything that A has then but its
 * radius.  Nothing else follows from the words: the mesh stays uniform where the program would fit
 * it, and contradictions are refused where the case is solved.  Files have no words. */
static inline __attribute__((format(printf, 2, 3))) void set(rb_rolling_case *rc, const char *words,
                                                             ...)
{
    va_list values;
    va_start(values, words);
    set_words_(rc, words, values);
    va_end(values);
}

/* The default case with these words. */
static inline __attribute__((format(printf, 1, 2))) rb_rolling_case rolling_case(const char *words,
                                                                                 ...)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    va_list values;
    va_start(values, words);
    set_words_(&rc, words, values);
    va_end(values);
    return rc;
}

/* A case with these words besides. */
static inline __attribute__((format(printf, 2, 3))) rb_rolling_case with(rb_rolling_case rc,
                                                                         const char *words, ...)
{
    va_list values;
    va_start(values, words);
    set_words_(&rc, words, values);
    va_end(values);
    return rc;
}

/* ---- Cases with a name ------------------------------------------------------------- */

/* A wheel, a half-plane in its contact, on a rigid plane. */
static inline rb_rolling_case half_plane(rb_rolling_formulation formulation, int elements)
{
    rb_rolling_case rc = rolling_case("support halfplane contact-elements %d", elements);
    rc.formulation = formulation;
    return rc;
}

/* B flat and of A's material, which is set before. */
static inline void on_its_like(rb_rolling_case *rc)
{
    rc->b = rc->a;
    rc->b.radius = INFINITY;
    rc->elastic_b = 1;
}

/* The same on a plane of its own material: Carter's bodies. */
static inline rb_rolling_case similar_planes(rb_rolling_formulation formulation, int elements)
{
    return with(half_plane(formulation, elements), "similar load 500");
}

/* The same at half the creepage of full sliding. */
static inline rb_rolling_case carter_case(int elements)
{
    return with(similar_planes(RB_STEADY, elements), "creep-ratio 0.5");
}

/* Similar steel bodies (theory-solvers.md 6): CONTACT's case. */
static inline rb_rolling_case steel_wheel(int across)
{
    rb_rolling_case rc = half_plane(RB_STATIC, across + 10);
    set(&rc, "poisson 0.28 young %g radius 500 similar gap parabola load 178.896",
        2.0 * 82000.0 * 1.28);
    rc.zone = rb_rolling_hertz_half_width(&rc, rc.load) * (across + 10) / across;
    return rc;
}

/* A rubber-like wheel on a steel rail: both bodies count, and they are coupled. */
static inline rb_rolling_case wheel_on_rail(rb_bem_support support, int across)
{
    rb_rolling_case rc = steel_wheel(across);
    rc.a.support = support;
    rc.a.young /= 3.0;
    rc.a.poisson = 0.4;
    rc.load *= 100.0;
    rc.zone = 1.2 * rb_rolling_hertz_half_width(&rc, rc.load);
    return rc;
}

/* Dissimilar bodies that roll, but where they are pressed together alone. */
static inline rb_rolling_case rolled_plane(rb_rolling_formulation formulation)
{
    rb_rolling_case rc = half_plane(formulation, 24);
    set(&rc, "poisson 0.3 load 500 speed 1000 distance 0.3");
    if (formulation != RB_STATIC)
        rc.creep_ratio = 0.5;
    return rc;
}

/* Twelve elements in full sliding, which warm A. */
static inline rb_rolling_case warm_sliding(rb_rolling_formulation formulation)
{
    rb_rolling_case rc = half_plane(formulation, 12);
    set(&rc, "speed 1000 half-width 1 creep-ratio 2 conductivity 40 heat-capacity 3.5");
    return rc;
}

/* Similar planes whose friction falls with the slip velocity. */
static inline rb_rolling_case falling_case(rb_rolling_formulation formulation, double fall,
                                           double scale)
{
    rb_rolling_case rc = similar_planes(formulation, 24);
    set(&rc, "speed 1000 distance 0.3 mu 0.2 friction-law exponential mu-fall %g slip-scale %g",
        fall, scale);
    return rc;
}

static inline double falling_mu(const rb_rolling_case *rc, double v)
{
    return rc->mu + rc->friction.fall[0] * exp(-log(2.0) * v / rc->friction.slip_scale[0]);
}

#endif
