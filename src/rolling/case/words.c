/* A case made from options: set by name, resolved, checked. */
#include "rolling/case/check.h"
#include "rolling/case/words.h"
#include "rolling/case/rubber.h"
#include "base/units.h"
#include "lcp/contact/contact.h"
#include "rolling/body/body.h"
#include "rolling/body/gap.h"
#include "rolling/case/internal.h"
#include "rolling/history/history.h"
#include "rolling/solve/notes.h"
#include "rolling/solve/pressed.h"
#include "rolling/solve/resolution.h"
#include "rolling/solve/zone.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Making one -------------------------------------------------------------------- */

static rb_resolved_case default_words(rb_case_purpose purpose)
{
    rb_resolved_case words = {.rc = rb_rolling_case_defaults(),
                              .young_b = NAN,
                              .poisson_b = NAN,
                              .radius_b = INFINITY,
                              .conductivity_b = NAN,
                              .heat_capacity_b = NAN,
                              .temperature_b = NAN,
                              .memory_a = {.time = NAN, .ratio = NAN},
                              .memory_b = {.time = NAN, .ratio = NAN},
                              .law = {NAN, NAN, NAN, NAN, {0}, {0}, {0}, {0}},
                              .cycle = NAN};
    if (purpose == RB_CASE_CURVE || purpose == RB_CASE_SPEEDS)
        words.rc.formulation = RB_STEADY;
    return words;
}

rb_case *rb_case_create(rb_case_purpose purpose)
{
    rb_case *c = calloc(1, sizeof *c);
    if (!c)
        return NULL;
    c->purpose = purpose;
    c->words = c->defaults = default_words(purpose);
    rb_case_resolve(c, NULL);
    return c;
}

void rb_case_set_purpose(rb_case *c, rb_case_purpose purpose)
{
    c->purpose = purpose;
    c->defaults = default_words(purpose);
    if (!rb_case_given(c, "formulation"))
        c->words.rc.formulation = c->defaults.rc.formulation;
}

void rb_case_use_cone_solvers(rb_case *c, rb_contact_cone_finder *find)
{
    c->find_cone_solver = find;
}

rb_case *rb_case_copy(const rb_case *c)
{
    rb_case *copy = malloc(sizeof *copy);
    if (!copy)
        return NULL;
    *copy = *c;
    for (int k = 0; k < CASE_TABLES; k++)
        copy->table[k].borrowed = 1;
    copy->profile.borrowed = 1;
    copy->text = NULL;
    copy->texts = 0;
    return copy;
}

void rb_case_free(rb_case *c)
{
    if (!c)
        return;
    rb_case_free_files(c);
    for (int i = 0; i < c->texts; i++)
        free(c->text[i]);
    free(c->text);
    free(c);
}

const char *rb_case_keep(rb_case *c, const char *text)
{
    char **kept = realloc(c->text, sizeof *kept * (size_t)(c->texts + 1));
    char *copy = malloc(strlen(text) + 1);
    if (kept)
        c->text = kept;
    if (!kept || !copy) {
        free(copy);
        return NULL;
    }
    strcpy(copy, text);
    return c->text[c->texts++] = copy;
}

const rb_choice rb_case_curve_variables[] = {{"creep-ratio", RB_OVER_CREEP_RATIO},
                                             {"creep", RB_OVER_CREEP},
                                             {"speed", RB_OVER_SPEED},
                                             {NULL, 0}};

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

/* ---- Setting ----------------------------------------------------------------------- */

/* The set that has the option, its place in *k; n = 0, with a line in why: none has. */
static rb_option_set find(rb_case *c, const char *name, int *k, rb_message *why)
{
    rb_guess guess = {.word = name};
    const rb_option_set sets[] = {rb_case_options(c),
                                  c->crack.is_taken ? rb_case_crack_set(c) : (rb_option_set){0}};
    const rb_option_set *set = rb_option_find(2, sets, name, strlen(name), k, &guess);
    if (set)
        return *set;
    rb_fail(why, RB_EINVAL, "unknown option '%s'%s", name, rb_guess_text(&guess, ""));
    return (rb_option_set){0};
}

static rb_status set(const rb_case *c, const rb_option_set *all, int k, const char *text, int by,
                     rb_message *why)
{
    char what[400];
    rb_option_source(&all->options[k], by, c->path, what, sizeof what);
    const rb_status s = rb_option_assign(all, k, by, what, text, why);
    return s != RB_OK && by > 0 ? RB_EFORMAT : s;
}

rb_status rb_case_set(rb_case *c, const char *name, const char *text, int by, rb_message *why)
{
    int k;
    const rb_option_set all = find(c, name, &k, why);
    if (all.n == 0)
        return RB_EINVAL;
    const char *kept = rb_case_keep(c, text);
    return kept ? set(c, &all, k, kept, by, why) : rb_fail(why, RB_ENOMEM, "out of memory");
}

rb_status rb_case_set_number(rb_case *c, const char *name, double value, rb_message *why)
{
    char text[32];
    int k;
    const rb_option_set all = find(c, name, &k, why);
    if (all.n == 0)
        return RB_EINVAL;
    if (all.options[k].kind != RB_OPTION_NUMBER && all.options[k].kind != RB_OPTION_INTEGER)
        return rb_refuse(why, name, "takes no number");
    rb_format(text, sizeof text, "%.17g", value);
    return set(c, &all, k, text, RB_GIVEN_NUMBER, why);
}

rb_status rb_case_set_word(rb_case *c, const char *name, const char *word, rb_message *why)
{
    int k;
    const rb_option_set all = find(c, name, &k, why);
    return all.n == 0 ? RB_EINVAL : set(c, &all, k, word, RB_GIVEN_NUMBER, why);
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

/* ---- Where an error stands --------------------------------------------------------- */

int rb_case_given(const rb_case *c, const char *name)
{
    const rb_option *o = rb_case_option(name);
    return o ? c->given[o - rb_case_table] : 0;
}

static rb_status refuse(const rb_case *c, const rb_option *o, const char *reason, rb_message *why)
{
    char buffer[400];
    const int by = c->given[o - rb_case_table];
    return rb_fail(why, by > 0 ? RB_EFORMAT : RB_EINVAL, "%s: %s",
                   rb_option_source(o, by, c->path, buffer, sizeof buffer), reason);
}

rb_status rb_case_refuse_given(const rb_case *c, const char *name, const char *reason,
                               rb_message *why)
{
    return rb_case_given(c, name) ? refuse(c, rb_case_option(name), reason, why) : RB_OK;
}

/* An option that means nothing to a case, where that is so. */
typedef struct {
    int has_no_meaning;
    const char *option, *reason;
} rule;

static rb_status refuse_by(const rb_case *c, size_t n, const rule *rules, rb_message *why)
{
    for (size_t k = 0; k < n; k++) {
        const rb_status s = rules[k].has_no_meaning
                                ? rb_case_refuse_given(c, rules[k].option, rules[k].reason, why)
                                : RB_OK;
        if (s != RB_OK)
            return s;
    }
    return RB_OK;
}

/* An option and where its value comes from; of NULL: none. */
typedef struct {
    const rb_option *of;
    int given;
} source;

static source given_in(const rb_option_set *set, const char *name)
{
    for (int k = 0; k < set->n; k++)
        if (set->given && set->given[k] && strcmp(set->options[k].name, name) == 0)
            return (source){&set->options[k], set->given[k]};
    return (source){NULL, 0};
}

/* Where an option of the case, of its crack or of the command is given. */
static source source_of(const rb_case *c, const char *name)
{
    const rb_option_set crack = {rb_case_crack_options, rb_case_crack_options_n, NULL,
                                 (int *)c->crack.given, NULL};
    source found = {rb_case_option(name), rb_case_given(c, name)};
    if (!found.given)
        found = given_in(&crack, name);
    for (int k = 0; k < c->commands && !found.given; k++)
        found = given_in(&c->command[k], name);
    return found;
}

void rb_case_also_locate(rb_case *c, const rb_option_set *set)
{
    if (!set)
        c->commands = 0;
    else if (c->commands < (int)(sizeof c->command / sizeof *c->command))
        c->command[c->commands++] = *set;
}

/* The first given one of the options that a refusal is about, or that of A which an option of B
 * follows. */
static source blamed(const rb_case *c, const rb_message *why)
{
    char name[sizeof why->about];
    for (int of_a = 0; of_a < 2; of_a++)
        for (const char *list = why->about; (list = rb_next_word(list, name, sizeof name));) {
            const size_t n = strlen(name);
            if (of_a && n > 2 && strcmp(name + n - 2, "-b") == 0)
                name[n - 2] = '\0';
            const source found = source_of(c, name);
            if (found.given)
                return found;
        }
    return (source){NULL, 0};
}

/* The table that the value of this option is read from; NULL: none is. */
static const case_table *table_of(const rb_case *c, const rb_option *o)
{
    static const char *const names[CASE_TABLES] = {
        [CASE_HISTORY] = "history",           [CASE_GAP] = "gap",
        [CASE_IRREGULARITY] = "irregularity", [CASE_WORN] = "worn",
        [CASE_FRICTION] = "friction-law",     [CASE_LAYERS] = "layers",
        [CASE_LAYERS_B] = "layers-b"};
    for (int k = 0; k < CASE_TABLES; k++)
        if (c->table[k].path && strcmp(o->name, names[k]) == 0)
            return &c->table[k];
    return NULL;
}

rb_status rb_case_locate(const rb_case *c, rb_status s, rb_message *why)
{
    if (s == RB_OK || !why) /* what succeeds leaves no text, nor need one have been set */
        return s;
    rb_unit_translate(c->words.units, why->text, sizeof why->text);
    if (s != RB_EINVAL)
        return s;
    const rb_message said = *why;
    const source by = blamed(c, &said);
    const case_table *t = by.of ? table_of(c, by.of) : NULL;
    char place[400];
    if (t && said.row >= 1 && said.row <= t->table.rows)
        return rb_fail(why, RB_EFORMAT, "%s:%d: %s", t->path, t->table.line[said.row - 1],
                       said.text + said.rest);
    if (t)
        return rb_fail(why, RB_EFORMAT, "%s: %s", t->path, said.text);
    if (by.of)
        return rb_fail(why, by.given > 0 ? RB_EFORMAT : s, "%s: %s",
                       rb_option_source(by.of, by.given, c->path, place, sizeof place),
                       said.text + said.rest);
    if (!*c->path)
        return s;
    for (int i = 0; i < rb_case_table_n; i++)
        if (c->given[i] < 0) /* of the command line: the error need not stand in the file */
            return s;
    return rb_fail(why, RB_EFORMAT, "%s: %s", c->path, said.text);
}

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
            return refuse(c, o, "body B is rigid without --similar or --young-b", why);
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

/* ---- Layers and memory ------------------------------------------------------------- */

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
    const rule rules[] = {
        {a->base_young == 0.0 && !rb_case_given(c, "base-young"), "base-poisson", base},
        {a->core_young == 0.0 && !rb_case_given(c, "core-young"), "core-poisson", core},
        {b->base_young == 0.0 && !rb_case_given(c, "base-young-b"), "base-poisson-b", base_b},
        {b->core_young == 0.0 && !rb_case_given(c, "core-young-b"), "core-poisson-b", core_b}};

    return refuse_by(c, sizeof rules / sizeof *rules, rules, why);
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
    rule rules[] = {{is_flat && rc->outer_elements > 0, "outer-elements", no_wheel},
                    {is_flat && rc->near_field != RB_NEAR_FIELD_AUTO, "near-field", no_wheel}};

    for (size_t k = 0; k < sizeof rules / sizeof *rules; k++)
        rules[k].has_no_meaning &= !(rb_case_given(c, rules[k].option) > 0 && gives_way);
    return refuse_by(c, sizeof rules / sizeof *rules, rules, why);
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
    rule rules[REPLACED + 2] = {
        [REPLACED] = {b && s->similar, "similar",
                      "B has the layers of --layers-b; leave one of them out"},
        {a && s->similar, "layer-thickness-b", similar}};
    for (int k = 0; k < REPLACED; k++) {
        const int of = k / CASE_OF_LAYERS;
        rules[k] = (rule){of ? b : a, rb_case_of_layers[of][k % CASE_OF_LAYERS], of ? of_b : of_a};
    }
    /* what stands in the case file gives way to layers of the command line */
    for (size_t k = 0; k < sizeof rules / sizeof *rules; k++)
        rules[k].has_no_meaning &=
            rb_case_given(c, rules[k].option) < 0 ||
            rb_case_given(c, rules[k].reason == of_a ? "layers" : "layers-b") > 0;
    return refuse_by(c, sizeof rules / sizeof *rules, rules, why);
}

static rb_status resolve_bodies(rb_case *c, rb_message *why)
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

static rb_status check_heat(const rb_case *c, rb_message *why)
{
    static const char for_heat[] = "only where friction heats the bodies: give --conductivity, too";
    const rb_resolved_case *s = &c->resolved;
    const int cold = !(s->rc.heat_a.conductivity > 0.0),
              stands = cold && rb_rolling_can(&s->rc, RB_BODY_ELASTIC) && s->law.falls.n == 0;
    const rule rules[] = {{cold, "mu-heat", "needs temperatures, add --conductivity"},
                          {cold, "heat-capacity", for_heat},
                          {cold, "temperature", for_heat},
                          {cold, "conductivity-b", for_heat},
                          {cold, "heat-capacity-b", for_heat},
                          {cold, "temperature-b", for_heat},
                          {stands, "speed",
                           "only for viscoelastic bodies, temperatures and velocity-dependent "
                           "friction; see --relaxation-time, --conductivity and --mu-fall"}};

    return refuse_by(c, sizeof rules / sizeof *rules, rules, why);
}

/* ---- Friction laws ----------------------------------------------------------------- */

/* As many numbers as the option takes. */
static rb_status count_numbers(const rb_case *c, const char *name, const rb_numbers *list,
                               int least, int most, rb_message *why)
{
    char reason[80];
    if (!rb_case_given(c, name) || (list->n >= least && list->n <= most))
        return RB_OK;
    if (most > least)
        snprintf(reason, sizeof reason, "expected %d or %d numbers, got %d", least, most, list->n);
    else
        snprintf(reason, sizeof reason, "expected %d numbers, got %d", least, list->n);
    return rb_case_refuse_given(c, name, reason, why);
}

static rb_status resolve_law(rb_case *c, rb_message *why)
{
    const rb_case_law *typed = &c->resolved.law;
    rb_rolling_friction *f = &c->resolved.rc.friction;
    const int falls = f->law != RB_FRICTION_constant && f->law != RB_FRICTION_table;
    static const char for_falls[] = "only for velocity-dependent friction, see --friction-law";
    const rule rules[] = {
        {falls && typed->falls.n == 0, "friction-law", "needs --mu-fall and --slip-scale"},
        {!falls, "mu-fall", for_falls},
        {!falls, "slip-scale", for_falls},
        {!falls && typed->heats.n == 0, "memory",
         "only for friction that changes, see --mu-fall and --mu-heat"}};
    rb_status s = count_numbers(c, "mu-fall", &typed->falls, 1, 2, why);

    /* at rest the slip takes no time, and has no scale */
    const int scaled = c->resolved.rc.formulation != RB_STATIC || typed->slip_scales.n > 0;
    if (s == RB_OK && falls && scaled && typed->falls.n != typed->slip_scales.n)
        s = rb_refuse(why, "mu-fall,slip-scale",
                      "expected as many numbers as --slip-scale has, %d, got %d",
                      typed->slip_scales.n, typed->falls.n);
    if (s == RB_OK)
        s = count_numbers(c, "memory", &typed->memories, 1, 2, why);
    if (s == RB_OK)
        s = count_numbers(c, "mu-heat", &typed->heats, 3, 3, why);
    if (s == RB_OK)
        s = refuse_by(c, sizeof rules / sizeof *rules, rules, why);
    if (s != RB_OK)
        return s;
    for (int k = 0; k < 2; k++) {
        f->fall[k] = k < typed->falls.n ? typed->falls.value[k] : 0.0;
        f->slip_scale[k] = k < typed->slip_scales.n ? typed->slip_scales.value[k] : 0.0;
    }
    if (typed->memories.n > 0) {
        f->memory = typed->memory;
        f->memory_slip = typed->memories.n > 1 ? typed->memories.value[1] : 1.0;
    }
    if (typed->heats.n == 3) {
        f->heat = typed->heat;
        f->heat_from = typed->heats.value[1];
        f->heat_range = typed->heats.value[2];
    }
    return RB_OK;
}

/* ---- What depends on other options ------------------------------------------------- */

/* half as many, by which error bars are found, are still aligned elements */
enum { LEAST_REFINED = 24 };
int rb_case_has_steps(const rb_resolved_case *resolved)
{
    return resolved->program.n > 0 || rb_rolling_has_steps(&resolved->rc);
}

/* Half-planes under a gap from a file have the radius of the gap, or none. */
static void set_radius(rb_case *c)
{
    rb_rolling_case *rc = &c->resolved.rc;

    if (rc->gap == RB_GAP_WAVE)
        rc->a.radius = INFINITY;
    if (rc->gap != RB_GAP_TABLE || rb_case_given(c, "radius") || !rb_rolling_can(rc, RB_BODY_FLAT))
        return;
    const double own = 1.0 / rb_rolling_profile_radius(rc->profile) - 1.0 / rc->b.radius;
    rc->a.radius = own > 0.0 ? 1.0 / own : INFINITY;
}

/* The elements follow tables that are finer than the usual ones. */
static rb_status follow_tables(rb_case *c, rb_message *why)
{
    rb_rolling_case *rc = &c->resolved.rc;
    int n = rc->contact_elements;

    if (rb_case_given(c, "contact-elements"))
        return RB_OK;
    rb_status s = rb_rolling_elements_for_tables(rc, n, &n);
    rb_rolling_case equal = *rc;
    equal.mesh = RB_MESH_ALIGNED;
    if (s == RB_OK && rc->mesh == RB_MESH_FITTED && !rb_case_given(c, "mesh") &&
        n > RB_ROLLING_GRADED_UP_TO && rb_rolling_suits_large(&equal, &(rb_rolling_mesh){.n = n})) {
        rc->mesh = RB_MESH_ALIGNED;
        s = rb_rolling_elements_for_tables(rc, rc->contact_elements, &n);
    }
    const int cheap = rb_rolling_suits_large(rc, &(rb_rolling_mesh){.n = n}) &&
                      !rb_case_has_steps(&c->resolved) && c->purpose != RB_CASE_WEAR;
    const int most = cheap ? RB_ROLLING_FOLLOWING_UP_TO : RB_ROLLING_FOLLOWING_DEARLY_UP_TO;
    rc->contact_elements = n < most ? n : most;
    return s == RB_OK ? s : rb_fail(why, s, "out of memory for the tables of a case");
}

/* Options of one formulation mean nothing to the others. */
static rb_status check_formulation(const rb_case *c, rb_message *why)
{
    const rb_resolved_case *resolved = &c->resolved;
    const rb_rolling_case *rc = &resolved->rc;
    const int transient = rc->formulation == RB_TRANSIENT, steady = rc->formulation == RB_STEADY,
              history = resolved->history_file != NULL;
    const int relaxes_at_rest = rc->formulation == RB_STATIC && rb_rolling_relaxes(rc);
    const rule rules[] = {
        {!transient, "distance", "it needs transient rolling"},
        {transient && history, "distance", "the history says how far"},
        /* of a crack: positions of the contact */
        {!transient && c->purpose != RB_CASE_CRACK, "steps", "it needs transient rolling"},
        {!transient, "irregularity",
         "only for transient rolling, in which it moves through the contact"},
        {steady, "history", "steady rolling has no history"},
        {steady && rc->increments > 1, "increments",
         "steady rolling does not depend on how the bodies were pressed"},
        {rc->formulation == RB_STATIC && !history, "fretting",
         "needs --history, a table whose rows end with a cycle"},
        {!rc->fretting, "cycle", "only with --fretting"},
        {!relaxes_at_rest, "time-step", "only for static contact of viscoelastic bodies"},
        {relaxes_at_rest && history, "speed", "static contact does not roll"},
        {rb_case_has_steps(resolved) && rc->mesh != RB_MESH_UNIFORM, "mesh",
         "a computation with steps needs equal elements"}};
    rb_status s = refuse_by(c, sizeof rules / sizeof *rules, rules, why);
    if (s == RB_OK)
        s = count_numbers(c, "cycle", &resolved->cycles, 2, 2, why);
    for (int k = 0; k < resolved->cycles.n && s == RB_OK; k++)
        if (resolved->cycles.value[k] != floor(resolved->cycles.value[k]) ||
            resolved->cycles.value[k] > resolved->program.n)
            s = rb_refuse(why, "cycle", "expected two rows of the history, 1 to %d, got %g",
                          resolved->program.n, resolved->cycles.value[k]);
    if (s != RB_OK)
        return s;
    if (relaxes_at_rest && !history)
        return rb_refuse(
            why, "relaxation-time,relaxation-time-b",
            "static contact of viscoelastic bodies needs --history, a table with a column time");
    if (transient && !history && !(rc->distance > 0.0))
        return rb_refuse(why, "formulation", "transient rolling needs --distance or --history");
    return RB_OK;
}

/* ---- What depends on the purpose --------------------------------------------------- */

static const char steady_only[] = "a curve needs steady rolling, and so does a fit",
                  no_steps[] = "a design takes cases of one step without error bars";

enum {
    CURVE = 1 << RB_CASE_CURVE,
    SPEEDS = 1 << RB_CASE_SPEEDS,
    STRESS = 1 << RB_CASE_STRESS,
    WEAR = 1 << RB_CASE_WEAR,
    CRACK = 1 << RB_CASE_CRACK,
    STUDY = 1 << RB_CASE_STUDY,
    DESIGN = 1 << RB_CASE_DESIGN
};

#define KINDS_OF_WEAR "wear is of sliding, fretting or steady rolling"
#define VARIES "a curve varies it from --from to --to, a fit takes it from its data"
#define HEAT                                                                                       \
    " mu-heat conductivity heat-capacity temperature conductivity-b heat-capacity-b "              \
    "temperature-b "

/* Options that no case of these purposes takes. */
static const struct {
    int purposes;
    const char *options, *reason; /* options: a blank before and behind each */
} never_taken[] = {
    {CURVE, " shift creep creep-ratio force force-ratio free-axle history ", VARIES},
    {SPEEDS, " speed ", VARIES},
    {CURVE | SPEEDS, " history distance steps irregularity increments time-step ", steady_only},
    {CURVE | SPEEDS, " accuracy ",
     "only for single cases; a curve has --error, and a fit has intervals"},
    {STRESS, " accuracy ", "stress has error bars (--error), but no refinement"},
    {CRACK, " accuracy ", "a crack has error bars (--error), but no refinement"},
    {STUDY, " accuracy ", "a study has error bars (--error), but no refinement"},
    {CURVE | SPEEDS | STRESS | WEAR | CRACK | DESIGN, " fretting cycle ",
     "only of a single case with --history, as `rollbem --history FILE --fretting`, or of a study"},
    {WEAR, " accuracy ", "wear has error bars (--error), but no refinement"},
    {WEAR, " history ", "the cycles have their own"},
    {WEAR, " increments ", "the cycles have their own, --quarter"},
    {WEAR, " distance ", KINDS_OF_WEAR},
    {WEAR, " steps ", KINDS_OF_WEAR "; see --wear-steps"},
    {WEAR, " irregularity ", KINDS_OF_WEAR},
    {WEAR, " time-step relaxation-time relaxation-ratio relaxation-time-b relaxation-ratio-b ",
     "wear is of elastic bodies only"},
    {WEAR, " yield-stress hardening ", "wear has no third body that yields"},
    {WEAR, HEAT, "wear has no temperatures"},
    {DESIGN, " error accuracy history distance steps irregularity increments time-step ",
     no_steps}};

enum { NEVER_TAKEN = sizeof never_taken / sizeof *never_taken };

int rb_case_takes(rb_case_purpose purpose, const char *option)
{
    char word[80];
    snprintf(word, sizeof word, " %s ", option);
    for (size_t k = 0; k < NEVER_TAKEN; k++)
        if (never_taken[k].purposes >> purpose & 1 && strstr(never_taken[k].options, word))
            return 0;
    return 1;
}

int rb_case_is_of_tractions(const char *option)
{
    static const char *const kept[] = {
        "layers",    "layers-b",        "young",        "poisson",           "support",
        "similar",   "layer-thickness", "base-young",   "base-poisson",      "young-b",
        "poisson-b", "support-b",       "base-young-b", "base-poisson-b",    "plane",
        "units",     "radius",          "radius-b",     "layer-thickness-b", "gap"};
    for (size_t k = 0; k < sizeof kept / sizeof *kept; k++)
        if (strcmp(option, kept[k]) == 0)
            return 1;
    return 0;
}

static rb_status check_never_taken(const rb_case *c, rb_message *why)
{
    for (size_t k = 0; k < NEVER_TAKEN; k++)
        for (const char *at = never_taken[k].options + 1;
             *at && never_taken[k].purposes >> c->purpose & 1; at = strchr(at, ' ') + 1) {
            char name[40];
            snprintf(name, sizeof name, "%.*s", (int)strcspn(at, " "), at);
            const rb_status s = rb_case_refuse_given(c, name, never_taken[k].reason, why);
            if (s != RB_OK)
                return s;
        }
    return RB_OK;
}

/* Values that mean nothing to what the case is solved for. */
static rb_status check_purpose(const rb_case *c, rb_message *why)
{
    const int curve = (CURVE | SPEEDS) >> c->purpose & 1;
    const rb_rolling_formulation formulation = c->resolved.rc.formulation;
    const rb_numbers *mus = &c->resolved.mus;
    /* 0,3 is read as 0 and 3. */
    const int comma = mus->n == 2 && mus->value[0] == floor(mus->value[0]) &&
                      mus->value[1] == floor(mus->value[1]);
    const rule rules[] = {
        {curve && formulation != RB_STEADY, "formulation", steady_only},
        {c->purpose == RB_CASE_STUDY && formulation == RB_TRANSIENT, "formulation",
         "a study needs static or steady cases"},
        {c->purpose == RB_CASE_STUDY && !c->resolved.rc.fretting, "history",
         "a study has one only with --fretting"},
        {c->purpose == RB_CASE_WEAR && formulation == RB_TRANSIENT, "formulation", KINDS_OF_WEAR},
        {c->purpose == RB_CASE_WEAR, "period", "wear is that of one contact alone"},
        {c->resolved.rc.gap == RB_GAP_WAVE, "radius",
         "that of a wave's crest follows from --period and --amplitude"},
        {c->purpose == RB_CASE_DESIGN && formulation == RB_TRANSIENT, "formulation", no_steps},
        {!curve && mus->n > 1, "mu",
         comma ? "expected one number, with a decimal point; a curve takes several"
               : "expected one number; a curve takes several"},
        {rb_rolling_slides_on_base(&c->resolved.rc), "history",
         "not on a smooth base: nothing holds the layer from step to step"},
        {rb_case_has_steps(&c->resolved), "accuracy",
         "only for static and steady cases without steps"}};

    return refuse_by(c, sizeof rules / sizeof *rules, rules, why);
}

/* The load of a largest pressure that no formula knows: of one state, which is solved some times
 * here. */
static rb_status find_load(rb_case *c, rb_message *why)
{
    const int many = c->purpose == RB_CASE_CURVE || c->purpose == RB_CASE_SPEEDS ||
                     c->purpose == RB_CASE_WEAR || rb_case_has_steps(&c->resolved);
    if (many)
        return rb_refuse(why, "max-pressure",
                         "with more than one state only where Hertz's formula says "
                         "the load (half-planes of alike materials, gap parabola); give --load");
    /* other meshes would have other loads, and the bar of the load would be that of none */
    if (c->resolved.error || c->resolved.accuracy > 0.0)
        return rb_refuse(why, "max-pressure",
                         "error bars only where Hertz's formula says the load "
                         "(half-planes of alike materials, gap parabola); give --load");
    return rb_rolling_find_load(&c->resolved.rc, why);
}

/* The same of the tilt of a moment. */
static rb_status find_tilt(rb_case *c, rb_message *why)
{
    const rb_rolling_case *rc = &c->resolved.rc;

    if (c->purpose == RB_CASE_WEAR || rb_case_has_steps(&c->resolved))
        return rb_refuse(why, "moment",
                         "it needs a single state; with steps give --tilt, or a column tilt of the "
                         "history");
    if (c->resolved.error || c->resolved.accuracy > 0.0)
        return rb_refuse(why, "moment", "has no error bars, those of --tilt are known");
    if (!isnan(rc->max_pressure) && !rb_rolling_pressure_is_hertz(rc))
        return rb_refuse(why, "moment", "needs --load, --half-width or --approach here");
    return rb_rolling_find_tilt(&c->resolved.rc, why);
}

rb_status rb_case_resolve(rb_case *c, rb_message *why)
{
    const rb_option_precedence how = rb_case_precedence(c);
    const rb_option_set set = rb_case_options(c);
    rb_status s = rb_option_resolve(&set, &how, why);
    if (s == RB_OK)
        s = check_never_taken(c, why);
    if (s == RB_OK)
        s = rb_case_read_history(c, why);
    c->resolved = c->words;
    rb_case_store(c, &set, &c->resolved);
    if (c->crack.is_taken) {
        const rb_option_set crack = rb_case_crack_set(c);
        c->crack.resolved = c->crack.words;
        rb_case_store(c, &crack, &c->crack.resolved);
    }
    if (s == RB_OK)
        s = resolve_bodies(c, why);
    if (s == RB_OK)
        s = resolve_law(c, why);
    if (s == RB_OK)
        s = check_heat(c, why);
    if (s == RB_OK)
        s = check_formulation(c, why);
    if (s == RB_OK && c->resolved.cycles.n == 2) {
        c->resolved.rc.cycle_from = (int)c->resolved.cycles.value[0];
        c->resolved.rc.cycle_to = (int)c->resolved.cycles.value[1];
    }
    if (s == RB_OK)
        s = rb_case_read_files(c, why);
    if (s == RB_OK)
        s = check_purpose(c, why);
    if (s != RB_OK)
        return rb_case_locate(c, s, why);
    if (c->resolved.rc.amplitude > 0.0 && !rb_case_given(c, "gap"))
        c->resolved.rc.gap = RB_GAP_WAVE;
    set_radius(c);
    if (rb_rolling_has_ellipse(&c->resolved.rc) && !rb_case_given(c, "gap"))
        c->resolved.rc.gap = RB_GAP_PARABOLA;
    s = rb_rolling_find_ellipse(&c->resolved.rc, why);
    if (s != RB_OK)
        return rb_case_locate(c, s, why);
    /* The paper's own example stays on its equal elements, as do large contacts, which
     * need them. */
    rb_rolling_case *rc = &c->resolved.rc;
    const int paper = !rb_rolling_pressing_is_given(rc);
    const rb_rolling_mesh equal = {.n = rc->contact_elements};
    const int graded = rb_rolling_couples(rc) || !rb_rolling_can(rc, RB_BODY_HOMOGENEOUS);
    rb_rolling_case fitted = *rc;
    fitted.mesh = RB_MESH_FITTED;
    const int strong = rb_rolling_mu_beta(rc) >= 1.0;
    const int most = !graded                                   ? 0
                     : rb_rolling_suits_large(&fitted, &equal) ? RB_ROLLING_GRADED_BY_PRODUCTS_UP_TO
                     : strong                                  ? RB_ROLLING_GRADED_STRONG_UP_TO
                                                               : RB_ROLLING_GRADED_UP_TO;
    const int many =
        rc->contact_elements > most &&
        (rc->contact_elements >= RB_ROLLING_EQUAL_FROM || rb_rolling_suits_large(rc, &equal));
    /* the search for a load needs a mesh that scales with the contact */
    const int scales =
        ((!isnan(rc->max_pressure) && !rb_rolling_pressure_is_hertz(rc)) || !isnan(rc->moment)) &&
        !rb_case_has_steps(&c->resolved);
    /* of second order between similar half-planes, and the cheapest where there will be many */
    const int refined = c->resolved.accuracy > 0.0 && rb_rolling_carter_holds(rc) &&
                        rc->contact_elements >= LEAST_REFINED && !rb_case_given(c, "mesh");
    if (!rb_case_given(c, "mesh") && (rc->formulation == RB_STEADY || scales) && !paper &&
        !(strong && many && !scales) && rc->zone == 0.0 && rc->gap != RB_GAP_TABLE &&
        !c->resolved.worn_file && rc->period == 0.0)
        rc->mesh = !many && !refined && rc->slip_operator == RB_SLIP_UPSTREAM ? RB_MESH_FITTED
                                                                              : RB_MESH_ALIGNED;
    if (!rb_case_given(c, "contact-elements") &&
        (rc->mesh == RB_MESH_FITTED || (refined && rc->mesh == RB_MESH_ALIGNED)))
        rc->contact_elements = 100;
    /* Q = 0, which a shift does not say where all of a period sticks, nor on a smooth base */
    if (((rc->period > 0.0 && isnan(rc->approach)) ||
         (rc->formulation == RB_STATIC && rb_rolling_slides_on_base(rc))) &&
        isnan(rc->shift) && !rb_rolling_force_is_given(rc) && !c->resolved.history_file)
        rc->force = 0.0;
    if (c->resolved.program.n > 0)
        c->resolved.rc = rb_rolling_program_base(&c->resolved.program, &c->resolved.rc);
    if (rc->contact.solver == RB_SOLVER_CONE && c->find_cone_solver)
        rc->contact.cone_solver = c->find_cone_solver(rc->contact.cone_solver.name);
    rb_rolling_case checked = c->resolved.rc;
    if (c->purpose == RB_CASE_SPEEDS)
        checked.speed = 1.0; /* the curve has its own */
    s = rb_rolling_program_check_base(&c->resolved.program, &checked, why);
    if (s == RB_OK)
        s = follow_tables(c, why);
    if (!rb_case_given(c, "slip-operator") && rc->formulation == RB_STEADY &&
        rc->mesh == RB_MESH_ALIGNED)
        rc->slip_operator = RB_SLIP_SECOND;
    if (s == RB_OK && !isnan(rc->max_pressure) && !rb_rolling_pressure_is_hertz(rc))
        s = find_load(c, why);
    if (s == RB_OK && !isnan(rc->moment))
        s = find_tilt(c, why);
    if (s == RB_OK)
        c->resolved.derived = rb_rolling_derive(&c->resolved.rc);
    return rb_case_locate(c, s, why);
}

const rb_resolved_case *rb_case_resolved(const rb_case *c)
{
    return &c->resolved;
}

const rb_rolling_case *rb_case_rolling(const rb_case *c)
{
    return &c->resolved.rc;
}
