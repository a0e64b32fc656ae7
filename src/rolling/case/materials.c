/* Notes on materials as they were given: one constant of two, or a hardness in place of a modulus.
 */
#include "rolling/case/words.h"
#include "rolling/case/rubber.h"
#include "base/units.h"
#include "rolling/notes/notes.h"

#include <stdio.h>
#include <string.h>

enum { PARTS = 5, MODULI = RB_ROLLING_NOTES - RB_CASE_MATERIAL_NOTES - PARTS };

/* Part k of the bodies: its options and values. */
typedef struct {
    char E[40], nu[40];
    double young, poisson;
} half_material;

static half_material half_of(const rb_case *c, int k)
{
    static const char *const part[PARTS] = {"", "base-", "core-", "base-", "core-"};
    const rb_rolling_case *rc = &c->resolved.rc;
    const rb_rolling_body *body = k > 2 ? &rc->b : &rc->a;
    const char *b = k > 2 ? "-b" : "";
    const double young[] = {body->young, body->base_young, body->core_young};
    const double poisson[] = {body->poisson, body->base_poisson, body->core_poisson};
    const int which = k > 2 ? k - 2 : k;
    half_material of = {.young = young[which], .poisson = poisson[which]};
    snprintf(of.E, sizeof of.E, "%syoung%s", part[k], b);
    snprintf(of.nu, sizeof of.nu, "%spoisson%s", part[k], b);
    return of;
}

static void say_half(const rb_case *c, const half_material *of, int has_E, char *text, size_t room)
{
    const rb_units units = c->resolved.units;
    if (has_E)
        rb_format(text, room,
                  "--%s without --%s: nu = %g is that of the built-in example; give both", of->E,
                  of->nu, of->poisson);
    else
        rb_format(text, room,
                  "--%s without --%s: E = %g %s is that of the built-in example; give both", of->nu,
                  of->E, rb_unit_shown(units, "MPa", of->young), rb_unit_name(units, "MPa"));
}

const char *rb_case_half_material(const rb_case *c, int k, char *text, size_t room)
{
    if (k < 0 || k >= PARTS)
        return NULL;
    const half_material of = half_of(c, k);
    const int has_E = rb_case_given(c, of.E) != 0, has_nu = rb_case_given(c, of.nu) != 0;
    /* a base or core without E is rigid, and what B has none of it takes from A */
    const int half = k == 0 ? has_E != has_nu : has_E && !has_nu && of.young > 0.0;
    *text = '\0';
    if (half && (!has_E || k < 3 || !rb_case_given(c, k == 3 ? "base-poisson" : "core-poisson")))
        say_half(c, &of, has_E, text, room);
    return text;
}

/* Modulus k = 0, 1, ... among the options; NULL: there are no more. */
static const rb_option *modulus(int k)
{
    const rb_option *o = rb_case_table, *end = o + rb_case_table_n;
    for (int before = k; o < end && (!o->modulus || before-- > 0);)
        o++;
    return k < 0 || o == end ? NULL : o;
}

static void say_hardness(const rb_case *c, const rb_option *o, char *text, size_t room)
{
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
}

const char *rb_case_hardness(const rb_case *c, int k, char *text, size_t room)
{
    const rb_option *o = modulus(k);
    if (!o)
        return NULL;
    const int at = (int)(o - rb_case_table);
    *text = '\0';
    if (c->given[at] && c->plain[at] == RB_GIVEN_HARDNESS)
        say_hardness(c, o, text, room);
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

rb_rolling_note_list rb_case_find_notes(const rb_case *c, const rb_rolling_solution *s,
                                        const rb_rolling_study_notes *of_steps)
{
    rb_rolling_note_list notes = {.n = 0};

    if (s)
        notes = rb_rolling_find_notes(&c->resolved.rc, s);
    rb_rolling_list_step_notes(of_steps, c->purpose == RB_CASE_WEAR ? "row" : "step", &notes);
    rb_case_note_materials(c, &notes);
    return notes;
}

void rb_case_confirm_materials(const rb_case *c, const char *said, rb_rolling_note_list *notes)
{
    char *text = notes->text[notes->n < RB_ROLLING_NOTES ? notes->n : 0];
    const size_t room = sizeof notes->text[0];

    for (int k = 0; k < 2 * PARTS + MODULI && notes->n < RB_ROLLING_NOTES; k++) {
        const int part = k / 2;
        *text = '\0';
        if (part >= PARTS) {
            const rb_option *o = modulus(k - 2 * PARTS);
            if (rb_case_given(c, o->name))
                say_hardness(c, o, text, room);
        } else if (k % 2 == 0 || part == 0) { /* only the body itself has nu without E */
            const half_material of = half_of(c, part);
            say_half(c, &of, k % 2 == 0, text, room);
        }
        if (strcmp(text, said) == 0) {
            notes->kind[notes->n++] = RB_CASE_MATERIAL_NOTES + (part < PARTS ? part : k - PARTS);
            return;
        }
    }
}

void rb_case_note_materials_of_row(const rb_case *c, rb_rolling_row_notes *notes)
{
    char text[RB_ROLLING_NOTE_LENGTH];

    for (int k = 0; k < PARTS + MODULI; k++)
        if (*material_note(c, k, text, sizeof text))
            rb_rolling_add_note(notes, RB_CASE_MATERIAL_NOTES + k, text);
}
