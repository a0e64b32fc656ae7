/* Notes on materials as they were given: one constant of two, or a hardness in place of a modulus.
 */
#include "rolling/case/words.h"
#include "rolling/case/rubber.h"
#include "base/units.h"
#include "rolling/solve/notes.h"

#include <stdio.h>

enum { PARTS = 5, MODULI = RB_ROLLING_NOTES - RB_CASE_MATERIAL_NOTES - PARTS };

const char *rb_case_half_material(const rb_case *c, int k, char *text, size_t room)
{
    static const char *const part[PARTS] = {"", "base-", "core-", "base-", "core-"};
    if (k < 0 || k >= PARTS)
        return NULL;
    const rb_rolling_case *rc = &c->resolved.rc;
    const rb_rolling_body *body = k > 2 ? &rc->b : &rc->a;
    const char *b = k > 2 ? "-b" : "";
    const double young[] = {body->young, body->base_young, body->core_young};
    const double poisson[] = {body->poisson, body->base_poisson, body->core_poisson};
    const int which = k > 2 ? k - 2 : k;
    char E[40], nu[40];
    snprintf(E, sizeof E, "%syoung%s", part[k], b);
    snprintf(nu, sizeof nu, "%spoisson%s", part[k], b);
    const int has_E = rb_case_given(c, E) != 0, has_nu = rb_case_given(c, nu) != 0;
    /* a base or core without E is rigid, and what B has none of it takes from A */
    const int half = k == 0 ? has_E != has_nu : has_E && !has_nu && young[which] > 0.0;
    const rb_units units = c->resolved.units;
    *text = '\0';
    if (half && has_E && (k < 3 || !rb_case_given(c, k == 3 ? "base-poisson" : "core-poisson")))
        rb_format(text, room,
                  "--%s without --%s: nu = %g is that of the built-in example; give both", E, nu,
                  poisson[which]);
    else if (half && !has_E)
        rb_format(text, room,
                  "--%s without --%s: E = %g %s is that of the built-in example; give both", nu, E,
                  rb_unit_shown(units, "MPa", young[which]), rb_unit_name(units, "MPa"));
    return text;
}

const char *rb_case_hardness(const rb_case *c, int k, char *text, size_t room)
{
    const rb_option *o = rb_case_table, *end = o + rb_case_table_n;
    for (int before = k; o < end && (!o->modulus || before-- > 0);)
        o++;
    if (k < 0 || o == end)
        return NULL;
    const int at = (int)(o - rb_case_table);
    *text = '\0';
    if (!c->given[at] || c->plain[at] != RB_GIVEN_HARDNESS)
        return text;
    const rb_rubber_scale *scale = &rb_rubber_scales[RB_RUBBER_SHORE_A];
    const double young = *(const double *)(const void *)((const char *)&c->words + o->offset),
                 shore = rb_rubber_shore(young);
    const rb_units units = c->resolved.units;
    double least, largest;
    rb_format(text, room, "--%s of %.4g ShoreA is E = %.4g %s by %s", o->name, shore,
              rb_unit_shown(units, "MPa", young), rb_unit_name(units, "MPa"),
              scale->relation[0].name);
    for (int j = 1; j < scale->relations; j++)
        rb_append(text, room, ", %.4g by %s",
                  rb_unit_shown(units, "MPa", scale->relation[j].young(shore)),
                  scale->relation[j].name);
    rb_rubber_band(scale, shore, &least, &largest);
    rb_append(text, room, ", a factor of %.1f, and at rest; rolling needs that of its speed",
              largest / least);
    return text;
}

/* Note k = 0, 1, ... on the materials as they were given, or ""; NULL: there are no more. */
static const char *material_note(const rb_case *c, int k, char *text, size_t room)
{
    return k < PARTS ? rb_case_half_material(c, k, text, room)
                     : rb_case_hardness(c, k - PARTS, text, room);
}

void rb_case_note_materials(const rb_case *c, rb_rolling_note_list *notes)
{
    for (int k = 0; k < PARTS + MODULI && notes->n < RB_ROLLING_NOTES; k++) {
        notes->kind[notes->n] = RB_CASE_MATERIAL_NOTES + k;
        notes->n += *material_note(c, k, notes->text[notes->n], sizeof notes->text[0]) != 0;
    }
}

void rb_case_note_materials_of_row(const rb_case *c, rb_rolling_row_notes *notes)
{
    char text[RB_ROLLING_NOTE_LENGTH];

    for (int k = 0; k < PARTS + MODULI; k++)
        if (*material_note(c, k, text, sizeof text))
            rb_rolling_add_note(notes, RB_CASE_MATERIAL_NOTES + k, text);
}
