/* Rows of the table of options by name, and what of them is given: whether, where, in which units.
 */
#include "rolling/case/words.h"
#include "base/units.h"

#include <string.h>

/* ---- The table --------------------------------------------------------------------- */

const rb_option_set *rb_option_find(int n, const rb_option_set *sets, const char *name,
                                    size_t length, int *index, rb_guess *guess)
{
    for (int k = 0; k < n; k++)
        for (int i = 0; i < sets[k].n; i++) {
            const rb_option *o = &sets[k].options[i];
            if (o->kind != RB_OPTION_GROUP && /* headings share names with options */
                strncmp(o->name, name, length) == 0 && !o->name[length]) {
                *index = i;
                return &sets[k];
            }
        }
    for (int k = 0; k < n; k++)
        for (int i = 0; i < sets[k].n; i++)
            if (sets[k].options[i].kind != RB_OPTION_GROUP)
                rb_guess_try(guess, sets[k].options[i].name);
    return NULL;
}

int rb_option_given(const rb_option_set *set, const char *name)
{
    for (int i = 0; i < set->n; i++)
        if (set->options[i].kind != RB_OPTION_GROUP && strcmp(set->options[i].name, name) == 0)
            return set->given[i];
    return 0;
}

rb_option_set rb_case_options(rb_case *c)
{
    return (rb_option_set){rb_case_table, rb_case_table_n, &c->words, c->given, c->plain};
}

const rb_option *rb_case_describe(int *n)
{
    *n = rb_case_table_n;
    return rb_case_table;
}

const rb_option *rb_case_option(const char *name)
{
    /* asked thousands of times per case: most names differ in their first letter */
    for (const rb_option *o = rb_case_table; o < rb_case_table + rb_case_table_n; o++)
        if (o->name[0] == name[0] && o->kind != RB_OPTION_GROUP && strcmp(o->name, name) == 0)
            return o;
    return NULL;
}

const char *rb_case_word(const char *name, int value)
{
    for (const rb_choice *c = rb_case_option(name)->choices; c->name; c++)
        if (c->value == value)
            return c->name;
    return NULL;
}

const char *rb_case_section(const rb_option *option)
{
    while (option->kind != RB_OPTION_GROUP)
        option--;
    return option->name;
}

/* ---- What is given ----------------------------------------------------------------- */

int rb_case_given(const rb_case *c, const char *name)
{
    const rb_option *o = rb_case_option(name);
    return o ? c->given[o - rb_case_table] : 0;
}

rb_units rb_case_units(const rb_case *c, int by)
{
    return by > 0 ? c->file_units : c->words.units;
}

rb_status rb_case_read_number(const rb_case *c, const char *text, const char *unit, double *x,
                              rb_message *why)
{
    int plain;
    const rb_status s = rb_unit_read(text, unit, x, &plain, why);
    if (s == RB_OK && plain)
        *x = rb_unit_stored(rb_case_units(c, RB_GIVEN_ARGUMENT), unit, *x);
    return s;
}

void rb_case_store(const rb_case *c, const rb_option_set *set, void *target)
{
    for (int k = 0; k < set->n; k++) {
        const rb_option *o = &set->options[k];
        double *place = (double *)(void *)((char *)target + o->offset);
        rb_numbers *list = (rb_numbers *)(void *)((char *)target + o->list);
        const rb_units units = rb_case_units(c, set->given[k]);
        if (o->kind != RB_OPTION_NUMBER || !set->given[k] || set->plain[k] != 1)
            continue;
        *place = rb_unit_stored(units, o->unit, *place);
        for (int i = 0; o->list && i < list->n; i++)
            list->value[i] = rb_unit_stored(units, o->unit, list->value[i]);
    }
}
