/* The potential contact: the interval with elements, which must enclose the whole contact
 * (theory-solvers.md 5.1).  It is not known before the contact is solved, so it is tried: begin a
 * little wider than Hertz's contact and solve; grow it while elements at an end are pressed or
 * bodies overlap outside; narrow it where most of it is separated, because elements that carry
 * nothing are wasted. */
#include "rolling/body/far_field.h"
#include "rolling/body/mesh.h"
#include "rolling/case/internal.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/model.h"
#include "rolling/solve/patches.h"
#include "rolling/solve/zone.h"

#include <gsl/gsl_math.h>

enum {
    ROUNDS = 24,
    SEPARATED_AT_END = 3, /* elements that a chosen potential contact ends with */
    IN_CONTACT = 3,       /* elements that they leave to the contact */
    FEW = 150,            /* elements that tell how wide the line of many should be */
    ENOUGH = 40           /* elements that have room beside 0.95 of the lower half */
};

/* By what a potential contact that is too narrow grows, and by what the first one is wider than
 * Hertz's contact; what is enough about edges that were found; and what may be left as it is, since
 * another round of the search costs more than some separated elements. */
static const double WIDER = 1.3, AROUND = 1.25, NEARLY = 1.25;

typedef struct {
    double from, to; /* [length] */
} interval;

static double width(interval zone)
{
    return zone.to - zone.from;
}

/* Measured profiles have no axis of symmetry; the others have one at x = 0, and so has
 * the potential contact. */
static int is_symmetric(const rb_rolling_case *rc)
{
    return rc->gap != RB_GAP_TABLE && rc->worn.n == 0 && rb_rolling_tilt(rc) == 0.0;
}

static interval extent(const rb_rolling_case *rc)
{
    interval all;

    rb_rolling_extent(rc, &all.from, &all.to);
    return all;
}

/* About its middle. */
static interval scaled(interval zone, double factor)
{
    const double middle = 0.5 * (zone.from + zone.to), half = 0.5 * width(zone);
    return (interval){middle - factor * half, middle + factor * half};
}

static interval within(interval zone, interval limit)
{
    return (interval){fmax(zone.from, limit.from), fmin(zone.to, limit.to)};
}

/* ---- Where the elements end -------------------------------------------------------- */

static int is_loaded(const rb_contact_state *state, int i)
{
    return state->zone[i] != RB_ZONE_SEPARATED;
}

/* Elements without contact at either end; n of them if there is no contact. */
static void separated_at_ends(const rb_contact_state *state, int *left, int *right)
{
    *left = *right = 0;
    while (*left < state->n && !is_loaded(state, *left))
        ++*left;
    while (*right < state->n && !is_loaded(state, state->n - 1 - *right))
        ++*right;
}

static int is_open(const rb_rolling_model *model)
{
    int left, right;

    separated_at_ends(&model->state, &left, &right);
    return left == model->state.n;
}

/* s, or that a solution has no contact. */
static rb_status unless_open(const rb_rolling_model *model, rb_status s, rb_message *why)
{
    return s == RB_OK && is_open(model)
               ? rb_fail(why, RB_NO_CONTACT, "no contact: the bodies do not touch")
               : s;
}

/* ---- Equal elements ---------------------------------------------------------------- */

/* Patches with separated elements between them get elements as short as if they lay side
 * by side. */
static int elements_for(const rb_rolling_model *model, interval zone)
{
    static const double a_little_less = 1.0 - 1e-9; /* rounding makes 512 of 512.0000001 */
    const int n = model->plan.elements;
    rb_rolling_run run = {.last = -1};
    double covered = 0.0;
    int patches = 0;

    for (; rb_rolling_next_merged_patch(model->rc, &model->mesh, &model->state, run.last + 1, &run);
         patches++)
        covered += run.to - run.from;
    return patches < 2
               ? n
               : (int)fmin(RB_ROLLING_MOST_ELEMENTS,
                           fmax(n, ceil(a_little_less * n * width(zone) / (1.5 * covered))));
}

/* The elements of a coarse solution, or as many as leave room within the lower half of round bodies
 * for one more beside the zone: a mesh has one there. */
static int elements_with_room(const rb_rolling_case *rc, interval zone, int elements)
{
    static const double a_little_more = 1.01;
    const double room = rb_rolling_lower_half(rc) - fmax(-zone.from, zone.to);

    return (int)fmax(elements, fmin(ENOUGH, ceil(a_little_more * width(zone) / room)));
}

static rb_status equal_elements(const rb_rolling_model *model, interval zone, int elements,
                                rb_rolling_mesh *mesh, rb_message *why)
{
    rb_rolling_plan plan = model->plan;

    plan.elements = elements;
    return rb_rolling_mesh_uniform(model->rc, &plan, zone.from, zone.to, mesh, why);
}

/* ---- The first potential contact --------------------------------------------------- */

/* Where the undeformed gap is less than at the edge of Hertz's contact, a^2/(2R): this is
 * 2P/(pi E*) and does not depend on the radius, so it also serves for measured profiles.  WIDER
 * than that. */
void rb_rolling_first_zone(const rb_rolling_case *rc, double *from, double *to, double *least,
                           double *level)
{
    const rb_rolling_derived d = rb_rolling_derive(rc);
    const double a = rb_rolling_zone_half_width(rc, d.load);
    const interval limit = extent(rc);
    /* without a radius: what Hertz's gap at the edge would be */
    const double rise = rb_rolling_has_radius(rc) ? 0.5 * a * a / d.radius
                        : isnan(d.load)
                            ? d.approach
                            : 2.0 * d.load / (M_PI * d.modulus) + rc->interlayer_normal * d.stress;
    interval zone = {-a, a};

    if (is_symmetric(rc)) {
        *least = 0.0;
        *level = rise;
    } else {
        rb_rolling_low_gap(rc, limit.from, limit.to, rise, &zone.from, &zone.to, least, level);
        zone = within(zone, limit);
    }
    zone = within(scaled(zone, WIDER), limit);
    *from = zone.from;
    *to = zone.to;
}

static interval first_zone(const rb_rolling_case *rc)
{
    double least, level;
    interval zone;

    rb_rolling_first_zone(rc, &zone.from, &zone.to, &least, &level);
    return zone;
}

/* ---- The automatic one ------------------------------------------------------------- */

/* The same, and over all places where the bodies overlap outside it; the state of a
 * solution says that they do so nowhere. */
static rb_status grown(const rb_rolling_model *model, interval zone, interval *wider)
{
    rb_rolling_overlap overlap = {0};
    const rb_status s = model->state.status == RB_OK || rb_rolling_is_convex(model->rc)
                            ? RB_OK
                            : rb_rolling_find_overlap(model, &model->state, &overlap);

    /* The zone grows where fewer separated elements than wanted stand at its end: three,
     * or what few elements have beside three in contact: a potential contact that
     * is grown until all elements are separated no longer sees the contact between their
     * midpoints. */
    const int spare = (model->state.n - IN_CONTACT) / 2;
    const int wanted = spare > SEPARATED_AT_END ? SEPARATED_AT_END : spare > 1 ? spare : 1;
    int left, right;

    separated_at_ends(&model->state, &left, &right);
    const int at_left = left < wanted, at_right = right < wanted;
    const int both = is_symmetric(model->rc) && (at_left || at_right);
    const interval more = within(scaled(zone, WIDER), extent(model->rc));
    if (at_left || both)
        zone.from = fmin(zone.from, more.from);
    if (at_right || both)
        zone.to = fmax(zone.to, more.to);
    *wider = zone;
    for (int k = 0; k < overlap.count; k++) {
        const interval there = scaled((interval){overlap.from[k], overlap.to[k]}, WIDER);
        wider->from = fmin(wider->from, there.from);
        wider->to = fmax(wider->to, there.to);
    }
    *wider = within(*wider, extent(model->rc));
    return s;
}

/* A zone that is wide enough.  Where the first one is symmetric and follows a load it is a
 * multiple of that one, so that it grows with a formula and not with the elements that were
 * found in contact (theory-solvers.md D6); under a given approach the first one is an estimate. */
static interval tightened(const rb_rolling_case *rc, interval wanted)
{
    static const double steps = 16.0; /* to a factor of two */
    const interval first = first_zone(rc);

    return is_symmetric(rc) && !isnan(rb_rolling_derive(rc).load)
               ? scaled(first, exp2(ceil(steps * log2(width(wanted) / width(first))) / steps))
               : wanted;
}

/* ---- A given one ------------------------------------------------------------------- */

/* A potential contact that does not hold the contact: says how wide it should be. */
static rb_status solve_given(rb_rolling_model *model, rb_message *why)
{
    const double zone = model->rc->zone;
    const interval limit = extent(model->rc);
    rb_rolling_mesh mesh;
    rb_status s = equal_elements(model, within((interval){-zone, zone}, limit),
                                 model->plan.elements, &mesh, why);

    if (s == RB_OK)
        s = rb_rolling_model_build(model, &mesh, why);
    if (s != RB_ZONE)
        return s;
    rb_rolling_case automatic = *model->rc;
    rb_rolling_model wider;
    double wanted = WIDER * zone;
    automatic.zone = 0.0;
    if (rb_rolling_model_begin(&automatic, &model->plan, &wider, NULL) == RB_OK &&
        rb_rolling_solve_zone(&wider, 0, NULL) == RB_OK)
        wanted = fmax(fabs(wider.mesh.ends[0]), wider.mesh.ends[wider.mesh.n]);
    rb_rolling_model_free(&wider);
    return rb_fail(why, RB_ZONE,
                   "zone: the contact is not within the potential contact of half-width "
                   "%g mm; widen it to %.4g mm or leave it out",
                   zone, wanted);
}

/* ---- The search -------------------------------------------------------------------- */

/* Where fitted elements are searched for by the far field of wheels, it also finds the contact on
 * the next zone, whose places are hardly farther from each other: the boundaries need not be solved
 * again.  On the zone after that it would be extrapolated too far. */
static rb_status go_on_by_far_field(rb_rolling_model *model, rb_message *why)
{
    const int had = model->far != NULL;

    rb_rolling_far_field_free(model->far);
    model->far = NULL;
    return !had && model->rc->mesh == RB_MESH_FITTED && model->bodies.F && model->mesh.n >= 8 &&
                   rb_rolling_has_far_field(model->rc)
               ? rb_rolling_far_field_create(model, 0, &model->far, why)
               : RB_OK;
}

/* Grows the potential contact until enough separated elements stand at each end, or no
 * material is left; tightens it when the contact turns out to fill less than two thirds
 * of it; and takes more elements where they are too long for separate patches, unless a
 * coarse solution will do. */
rb_status rb_rolling_solve_zone(rb_rolling_model *model, int coarse, rb_message *why)
{
    const interval before = {model->first_from, model->first_to};
    interval zone = before;
    int elements = model->plan.elements;
    double too_narrow = 0.0; /* the widest one that was */
    rb_status s;

    if (model->rc->zone > 0.0)
        return unless_open(model, solve_given(model, why), why);
    /* Begin with the potential contact of the last search, or with that of Hertz's width. */
    if (coarse || !(width(before) > 0.0)) {
        zone = first_zone(model->rc);
        rb_rolling_plan few = model->plan;
        if (few.elements >= RB_ROLLING_SEARCH_WITH_FEW_FROM || rb_rolling_has_fine_boundary(&few)) {
            /* Few elements tell as well how wide the potential contact of many should be. */
            rb_rolling_case equal = *model->rc;
            rb_rolling_model first;
            few.elements = few.elements >= RB_ROLLING_SEARCH_WITH_FEW_FROM ? FEW : few.elements;
            rb_rolling_coarsen_boundary(&few);
            equal.mesh = RB_MESH_UNIFORM;
            if (rb_rolling_model_begin(&equal, &few, &first, NULL) == RB_OK &&
                rb_rolling_solve_zone(&first, 0, NULL) == RB_OK) {
                /* the zone, not the edges: between edges it would not grow like Hertz's
                 * half-width (D6); as many elements have tried what is tighter */
                zone = (interval){first.mesh.ends[0], first.mesh.ends[first.mesh.n]};
                too_narrow = few.elements == elements ? width(zone) : 0.0;
            }
            rb_rolling_model_free(&first);
        }
    }
    for (int round = 0;; round++) {
        rb_rolling_mesh mesh;
        interval wider;
        if (round == ROUNDS)
            return rb_fail(why, RB_ZONE,
                           "no potential contact was found that encloses the contact: "
                           "the last one tried reaches from %g to %g mm",
                           zone.from, zone.to);
        /* Solve on equal elements in it. */
        s = equal_elements(model, zone,
                           coarse ? elements_with_room(model->rc, zone, elements) : elements, &mesh,
                           why);
        if (s == RB_OK)
            s = rb_rolling_model_build(model, &mesh, why);
        if (s < 0 || !model->state.p || (s != RB_ZONE && rb_rolling_gave_up(model)))
            return s;
        /* Too narrow: WIDER where the contact is near an end, and about all places where the bodies
         * overlap outside. */
        const rb_status t = grown(model, zone, &wider);
        if (t != RB_OK)
            return t;
        if (wider.from < zone.from || wider.to > zone.to) {
            too_narrow = fmax(too_narrow, width(zone));
            zone = wider;
            const rb_status of_far = coarse ? go_on_by_far_field(model, why) : RB_OK;
            if (of_far != RB_OK)
                return of_far;
            continue;
        }
        if (is_open(model))
            break;
        /* The contact that was found. */
        interval edge;

        rb_rolling_contact_edges(model->rc, &model->mesh, &model->state, &edge.from, &edge.to);
        if (isnan(rb_rolling_derive(model->rc).load)) {
            /* those of elements, which move with the first zone alone and not with the
             * pressure: derivatives know how (theory-solvers.md D6) */
            int left, right;
            separated_at_ends(&model->state, &left, &right);
            edge = (interval){model->mesh.ends[left], model->mesh.ends[model->mesh.n - right]};
        }
        if (is_symmetric(model->rc)) {
            edge.to = fmax(fabs(edge.from), fabs(edge.to));
            edge.from = -edge.to;
        }
        /* Too wide: the contact fills less than two thirds of it, and it is not known that what is
         * tighter is too narrow.  Too coarse: patches need shorter elements. */
        const interval wanted = within(scaled(edge, AROUND), extent(model->rc));
        const int more = coarse ? elements : elements_for(model, zone);
        const int keeps_zone =
            width(zone) < NEARLY * width(wanted) || width(wanted) <= 1.05 * too_narrow;
        if (keeps_zone && more <= NEARLY * elements)
            break;
        zone = keeps_zone ? zone : tightened(model->rc, wanted);
        elements = coarse ? elements : elements_for(model, zone);
        if (elements > model->plan.elements && elements > RB_ROLLING_PATCHES_UP_TO &&
            !rb_rolling_is_large(model->rc, &(rb_rolling_mesh){.n = elements}))
            return rb_fail(why, RB_ZONE,
                           "the patches of the contact are so far apart that %d equal "
                           "elements would be needed; use mesh fitted, or fewer elements",
                           elements);
    }
    if (s == RB_OK && coarse) {
        model->first_from = model->mesh.ends[0];
        model->first_to = model->mesh.ends[model->mesh.n];
    }
    return unless_open(model, s, why);
}

rb_status rb_rolling_solve_punch(rb_rolling_model *model, rb_message *why)
{
    rb_rolling_mesh mesh;
    rb_status s = rb_rolling_mesh_punch(model->rc, &model->plan, &mesh, why);

    if (s == RB_OK)
        s = rb_rolling_model_build(model, &mesh, why);
    return unless_open(model, s, why);
}
