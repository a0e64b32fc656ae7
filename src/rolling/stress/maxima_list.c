/* The largest stresses as a list: what each one measures, where it is kept, the names of places
 * and bonds. */
#include "rolling/stress/search.h"
#include "rolling/stress/stress.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Measures -------------------------------------------------------------------------- */

static double max_shear(const rb_rolling_stress *s)
{
    return s->max_shear;
}

static double tresca_shear(const rb_rolling_stress *s)
{
    return s->tresca_shear;
}

static double von_mises(const rb_rolling_stress *s)
{
    return s->von_mises;
}

static double orthogonal_shear(const rb_rolling_stress *s)
{
    return fabs(s->sxy);
}

static double tension(const rb_rolling_stress *s)
{
    return s->principal_1;
}

static double compression(const rb_rolling_stress *s)
{
    return -s->principal_2;
}

static double across(const rb_rolling_stress *s)
{
    return s->syy;
}

static double along(const rb_rolling_stress *s)
{
    return s->sxx;
}

typedef struct {
    rb_search_measure *of;
    size_t place; /* of the extremum in its struct */
} maximum;

#define IN_BODY(member) offsetof(rb_rolling_stress_maxima, member)
#define OF_BOND(member) offsetof(rb_rolling_bond_maxima, member)

static const maximum in_body[RB_SEARCH_IN_BODY] = {
    {max_shear, IN_BODY(max_shear)}, {tresca_shear, IN_BODY(tresca_shear)},
    {von_mises, IN_BODY(von_mises)}, {orthogonal_shear, IN_BODY(orthogonal_shear)},
    {tension, IN_BODY(tension)},     {compression, IN_BODY(compression)}};

/* In the directions of the bond. */
static const maximum of_bond[RB_SEARCH_OF_BOND] = {{across, OF_BOND(peel)},
                                                   {orthogonal_shear, OF_BOND(shear)},
                                                   {along, OF_BOND(tension_above)},
                                                   {along, OF_BOND(tension_below)}};

rb_search_measure *rb_search_measure_of(int k)
{
    return k < RB_SEARCH_IN_BODY ? in_body[k].of
                                 : of_bond[(k - RB_SEARCH_IN_BODY) % RB_SEARCH_OF_BOND].of;
}

/* ---- Where they are kept ---------------------------------------------------------------- */

rb_rolling_extremum *rb_rolling_maximum(rb_rolling_stress_maxima *m, int k)
{
    const int beyond = k - RB_SEARCH_IN_BODY, bond = beyond / RB_SEARCH_OF_BOND;

    if (beyond < 0)
        return (rb_rolling_extremum *)(void *)((char *)m + in_body[k].place);
    if (bond >= m->bonds)
        return NULL;
    return (rb_rolling_extremum *)(void *)((char *)&m->bond[bond] +
                                           of_bond[beyond % RB_SEARCH_OF_BOND].place);
}

double *rb_rolling_maximum_number(rb_rolling_stress_maxima *m, int k, int part)
{
    rb_rolling_extremum *at = rb_rolling_maximum(m, k);
    return !at ? NULL : part == 0 ? &at->value : part == 1 ? &at->x : &at->y;
}

rb_status rb_rolling_stress_maxima_alloc(int bonds, rb_rolling_stress_maxima *m)
{
    *m = (rb_rolling_stress_maxima){.bonds = bonds};
    m->bond = bonds ? calloc((size_t)bonds, sizeof *m->bond) : NULL;
    if (bonds && !m->bond) {
        m->bonds = 0;
        return RB_ENOMEM;
    }
    for (int k = 0; rb_rolling_maximum(m, k); k++)
        *rb_rolling_maximum(m, k) = (rb_rolling_extremum){
            NAN, NAN, NAN, k < RB_SEARCH_IN_BODY ? RB_MATERIAL_BODY : RB_MATERIAL_LAYER};
    return RB_OK;
}

void rb_rolling_stress_maxima_free(rb_rolling_stress_maxima *m)
{
    free(m->bond);
    m->bond = NULL;
    m->bonds = 0;
}

/* ---- Names of materials ----------------------------------------------------------------- */

static const char *const place_names[] = {"body", "layer", "base"};

const char *rb_rolling_place_name(rb_rolling_place place, char name[RB_ROLLING_PLACE])
{
    if (place < RB_MATERIAL_FIRST)
        return place_names[place];
    snprintf(name, RB_ROLLING_PLACE, "layer %d", (int)place - RB_MATERIAL_FIRST + 1);
    return name;
}

int rb_rolling_place_named(const char *name)
{
    int layer, used = 0;
    for (int k = 0; k < RB_MATERIAL_FIRST; k++)
        if (strcmp(name, place_names[k]) == 0)
            return k;
    const int is_layer = sscanf(name, "layer %d%n", &layer, &used) == 1 && !name[used] && layer > 0;
    return is_layer ? RB_MATERIAL_FIRST + layer - 1 : -1;
}

/* ---- Names of bonds ---------------------------------------------------------------- */

static const char FIRST_BOND[] = "bond_1_";

const rb_rolling_result *rb_rolling_describe_maximum(int k, int part, int of_b,
                                                     rb_rolling_maximum_result *described)
{
    const rb_rolling_results *own =
                                 of_b ? &rb_rolling_maxima_b_scalars : &rb_rolling_maxima_scalars,
                             *first = of_b ? &rb_rolling_bond_b_scalars : &rb_rolling_bond_scalars;
    const int i = 3 * k + part, beyond = i - own->n, which = beyond / first->n + 1;
    if (beyond < 0)
        return &own->row[i];
    const rb_rolling_result *r = &first->row[beyond % first->n];
    const char *digit = strstr(r->meaning, "bond 1");
    described->result = *r;
    snprintf(described->name, sizeof described->name, "bond_%d_%s", which,
             r->name + strlen(FIRST_BOND));
    snprintf(described->meaning, sizeof described->meaning, "%.*s%.0d%s",
             digit ? (int)(digit - r->meaning) + 5 : (int)strlen(r->meaning), r->meaning,
             digit ? which : 0, digit ? digit + 6 : "");
    described->result.name = described->name;
    described->result.meaning = described->meaning;
    return &described->result;
}

int rb_rolling_find_bond_number(const char *name, int *k, int *part, int *of_b)
{
    int which, used = 0;
    if (sscanf(name, "bond_%d_%n", &which, &used) != 1 || !used || which < 1 || which > 1000000)
        return 0;
    for (*of_b = 0; *of_b < 2; ++*of_b) {
        const rb_rolling_results *first =
            *of_b ? &rb_rolling_bond_b_scalars : &rb_rolling_bond_scalars;
        for (int i = 0; i < first->n; i++)
            if (strcmp(first->row[i].name + strlen(FIRST_BOND), name + used) == 0) {
                const int number = rb_rolling_maxima_scalars.n + (which - 1) * first->n + i;
                *k = number / 3;
                *part = number % 3;
                return 1;
            }
    }
    return 0;
}
