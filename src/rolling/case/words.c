/* A case made from options: set by name, resolved, checked. */
#include "rolling/case/check.h"
#include "rolling/case/words.h"
#include "rolling/body/body.h"
#include "rolling/body/gap.h"
#include "rolling/case/internal.h"
#include "rolling/solve/pressed.h"
#include "rolling/solve/resolution.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Making one -------------------------------------------------------------------- */

/* The case without any option: numbers that follow from others are NAN, "not given". */
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

/* A copy borrows the tables that have been read from files, and the texts. */
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

/* Options of kind text point to what the caller gave: a copy that lives as long as the case. */
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

/* ---- Setting ----------------------------------------------------------------------- */

/* The set that has the option, its place in *k; n = 0, with a line in why: none has. */
static rb_option_set find_option(rb_case *c, const char *name, int *k, rb_message *why)
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
    const rb_option_set all = find_option(c, name, &k, why);
    if (all.n == 0)
        return RB_EINVAL;
    const char *kept = rb_case_keep(c, text);
    return kept ? set(c, &all, k, kept, by, why) : rb_fail(why, RB_ENOMEM, "out of memory");
}

rb_status rb_case_set_number(rb_case *c, const char *name, double value, rb_message *why)
{
    char text[32];
    int k;
    const rb_option_set all = find_option(c, name, &k, why);
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
    const rb_option_set all = find_option(c, name, &k, why);
    return all.n == 0 ? RB_EINVAL : set(c, &all, k, word, RB_GIVEN_NUMBER, why);
}

static rb_status check_heat(const rb_case *c, rb_message *why)
{
    static const char for_heat[] = "only where friction heats the bodies: give --conductivity, too";
    const rb_resolved_case *s = &c->resolved;
    const int cold = !(s->rc.heat_a.conductivity > 0.0),
              stands = cold && rb_rolling_can(&s->rc, RB_BODY_ELASTIC) && s->law.falls.n == 0;
    const rb_case_rule rules[] = {
        {cold, "mu-heat", "needs temperatures, add --conductivity"},
        {cold, "heat-capacity", for_heat},
        {cold, "temperature", for_heat},
        {cold, "conductivity-b", for_heat},
        {cold, "heat-capacity-b", for_heat},
        {cold, "temperature-b", for_heat},
        {stands, "speed",
         "only for viscoelastic bodies, temperatures and velocity-dependent "
         "friction; see --relaxation-time, --conductivity and --mu-fall"}};

    return rb_case_refuse_by(c, sizeof rules / sizeof *rules, rules, why);
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

/* The numbers of a friction law, from the lists of its options into rc.friction (F1, F2). */
static rb_status resolve_law(rb_case *c, rb_message *why)
{
    const rb_case_law *typed = &c->resolved.law;
    rb_rolling_friction *f = &c->resolved.rc.friction;
    const int falls = f->law != RB_FRICTION_constant && f->law != RB_FRICTION_table;
    static const char for_falls[] = "only for velocity-dependent friction, see --friction-law";
    const rb_case_rule rules[] = {
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
        s = rb_case_refuse_by(c, sizeof rules / sizeof *rules, rules, why);
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
/* An accuracy that half of the usual fitted elements have mostly. */
static const double ROUGH = 4e-3;

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
    /* Fitted elements would need a dense matrix: where aligned ones go with transforms, these
     * follow finer tables. */
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
    const rb_case_rule rules[] = {
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
    rb_status s = rb_case_refuse_by(c, sizeof rules / sizeof *rules, rules, why);
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

/* The default mesh and how many elements it has, unless they are given.  The paper's own example
 * stays on its equal elements, as do large contacts, which need them. */
static void set_mesh(rb_case *c)
{
    rb_rolling_case *rc = &c->resolved.rc;
    const int paper = !rb_rolling_pressing_is_given(rc);
    const rb_rolling_mesh equal = {.n = rc->contact_elements};
    const int graded = rb_rolling_couples(rc) || !rb_rolling_can(rc, RB_BODY_HOMOGENEOUS);
    rb_rolling_case fitted = *rc;
    fitted.mesh = RB_MESH_FITTED;
    const int strong = rb_rolling_mu_beta(rc) >= 1.0;
    /* Fitted and growing elements need matrices, so that there are at most `most` of them; equal
     * ones have transforms. */
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
    const int to_accuracy = c->resolved.accuracy > 0.0;
    /* of second order between similar half-planes, and the cheapest where there will be many */
    const int refined = to_accuracy &&
                        (rb_rolling_carter_holds(rc) || rb_rolling_cattaneo_holds(rc)) &&
                        rc->contact_elements >= LEAST_REFINED && !rb_case_given(c, "mesh");
    /* at rest equal elements are of first order: an accuracy asks for fewer of other ones */
    const int refined_at_rest =
        to_accuracy && rc->formulation == RB_STATIC && !many && !rb_case_has_steps(&c->resolved);
    if (!rb_case_given(c, "mesh") &&
        (rc->formulation == RB_STEADY || scales || refined_at_rest || refined) && !paper &&
        !(strong && many && !scales) && rc->zone == 0.0 && rc->gap != RB_GAP_TABLE &&
        !c->resolved.worn_file && rc->period == 0.0)
        rc->mesh = !many && !refined && rc->slip_operator == RB_SLIP_UPSTREAM ? RB_MESH_FITTED
                                                                              : RB_MESH_ALIGNED;
    if (!rb_case_given(c, "contact-elements") &&
        (rc->mesh == RB_MESH_FITTED || (refined && rc->mesh == RB_MESH_ALIGNED)))
        rc->contact_elements = refined && rc->formulation == RB_STATIC                      ? 30
                               : c->resolved.accuracy > ROUGH && rc->mesh == RB_MESH_FITTED ? 50
                                                                                            : 100;
}

/* From words to a case, always from the given values: 1. which of two values counts; 2. bodies,
 * laws, formulation; 3. files; 4. what follows from all of them, mesh and elements; 5. the check;
 * 6. loads and tilts that a search has to find. */
rb_status rb_case_resolve(rb_case *c, rb_message *why)
{
    const rb_option_precedence how = rb_case_precedence(c);
    const rb_option_set set = rb_case_options(c);
    rb_status s = rb_option_resolve(&set, &how, why);
    if (s == RB_OK)
        s = rb_case_check_never_taken(c, why);
    if (s == RB_OK)
        s = rb_case_read_history(c, why);
    /* words: as given; resolved: with what follows from it. */
    c->resolved = c->words;
    rb_case_store(c, &set, &c->resolved);
    if (c->crack.is_taken) {
        const rb_option_set crack = rb_case_crack_set(c);
        c->crack.resolved = c->crack.words;
        rb_case_store(c, &crack, &c->crack.resolved);
    }
    if (s == RB_OK)
        s = rb_case_resolve_bodies(c, why);
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
        s = rb_case_check_purpose(c, why);
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
    set_mesh(c);
    rb_rolling_case *rc = &c->resolved.rc;
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
