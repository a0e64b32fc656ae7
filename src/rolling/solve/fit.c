/* Elements fitted to the patches of the contact, whose edges are known only from a
 * solution (theory-solvers.md 5.1). */
#include "rolling/body/far_field.h"
#include "rolling/body/mesh.h"
#include "rolling/case/internal.h"
#include "rolling/solve/fit.h"
#include "rolling/solve/model.h"
#include "rolling/solve/patches.h"
#include "rolling/solve/zone.h"

#include <math.h>
#include <string.h>

enum {
    FIRST = 30, /* elements at least that the first edges are found with */
    ROUNDS = 10,
    MOST_PATCHES = 16
};
/* Edges that have come to rest, or near enough after all rounds, for more elements to go on from,
 * or for the far field to be matched: in lengths of the outermost elements, which are the smallest
 * of the mesh. */
static const double AT_REST = 0.1, NEAR_REST = 3.0, TO_GO_ON = 1.0, TO_MATCH = 4.0;
/* Elements of a wheel outside the contact, as a part of those asked for, that its first far field
 * is found with: a sixth of the time. */
static const double COARSE_BOUNDARY = 0.5;
/* From this mu beta on Newton's steps come to rest only from edges that are known to a few of the
 * outermost elements: the elements are halved as far as the second number, each size goes on from
 * the one before, and the far field is matched on the first.  mu = 2 on a rigid half-plane, 400
 * elements and error bars: 3 s without, .3 s so. */
static const double STRONG = 0.4;
enum { COARSEST_STRONG = 100 };
/* Patches nearer than this part of the wider one are fitted as one. */
static const double NARROW = 0.02;

/* Patches to fit elements to. */
typedef struct {
    int count;
    rb_rolling_span span[MOST_PATCHES];
} patches;

static double length_of(const rb_rolling_mesh *mesh, int i)
{
    return mesh->ends[i + 1] - mesh->ends[i];
}

/* An edge is known to the distance of the two midpoints around it; where no open element
 * stands beyond it, to a part of the patch. */
static double margin_beyond(const rb_rolling_mesh *mesh, const rb_rolling_run *run, int outer,
                            int open)
{
    if (open < 0 || open >= mesh->n)
        return 0.1 * (run->to - run->from);
    return 0.5 * (length_of(mesh, outer) + length_of(mesh, open));
}

/* Into the order of x, together with those that it touches.  0: there is no room. */
static int add_patch(const rb_rolling_span *span, patches *found)
{
    if (found->count == MOST_PATCHES)
        return 0;
    int k = found->count++;
    for (; k > 0 && found->span[k - 1].from > span->from; k--)
        found->span[k] = found->span[k - 1];
    found->span[k] = *span;
    for (k = found->count - 1; k > 0; k--) {
        /* Elements between the patches k - 1 and k may be of no use. */
        const rb_rolling_span *a = &found->span[k - 1], *b = &found->span[k];
        const double wider = fmax(a->to - a->from, b->to - b->from);

        if (b->from - a->to < NARROW * wider) {
            const size_t behind = (size_t)(--found->count - k);

            found->span[k - 1].to = fmax(found->span[k - 1].to, found->span[k].to);
            found->span[k - 1].margin_right = found->span[k].margin_right;
            found->span[k - 1].h_right = found->span[k].h_right;
            memmove(found->span + k, found->span + k + 1, behind * sizeof *found->span);
        }
    }
    return 1;
}

/* The patches of the model's state and, where its mesh does not hold the contact, the
 * places where it should; none where they are more than elements are fitted to. */
static rb_status find_patches(const rb_rolling_model *model, patches *found)
{
    const rb_rolling_mesh *mesh = &model->mesh;
    rb_rolling_run run = {.last = -1};
    rb_rolling_overlap overlap = {0};
    rb_status s = RB_OK;
    int complete = 1;

    found->count = 0;
    while (complete &&
           rb_rolling_next_merged_patch(model->rc, mesh, &model->state, run.last + 1, &run)) {
        const rb_rolling_span span = {
            .from = run.from,
            .to = run.to,
            .margin_left = margin_beyond(mesh, &run, run.first, run.first - 1),
            .margin_right = margin_beyond(mesh, &run, run.last, run.last + 1),
            .h_left = length_of(mesh, run.first),
            .h_right = length_of(mesh, run.last)};
        complete = add_patch(&span, found);
    }
    if (model->state.status == RB_ZONE && !rb_rolling_is_convex(model->rc))
        s = rb_rolling_find_overlap(model, &model->state, &overlap);
    for (int k = 0; complete && k < overlap.count; k++) {
        const double room = 0.1 * (overlap.to[k] - overlap.from[k]);
        const rb_rolling_span span = {overlap.from[k], overlap.to[k], room, room, room, room};
        complete = add_patch(&span, found);
    }
    found->count = complete ? found->count : 0;
    return s;
}

/* ---- One edge ---------------------------------------------------------------------- */

/* Outward positions of fitted edges beyond which the contact was found to go, and those
 * that it was found not to reach. */
typedef struct {
    double inner, outer;
} bracket;

/* The edge that a mesh should be fitted to, as a function of the one that it was fitted
 * to, jumps where another element becomes the last in contact, and mostly it crosses the
 * identity there: so the fixed point is bracketed.  Results are best on the outer side of
 * the jump.  fitted, found: outward positions; h: element beside the edge.  Returns how
 * far from rest the edge is, in elements, and where to fit next. */
static double refine_fitted_edge(double found, double h, double *fitted, bracket *b)
{
    const double moved = fabs(found - *fitted) / h;

    if (moved > 2.0)
        *b = (bracket){-INFINITY, INFINITY};
    if (found > *fitted) {
        b->inner = fmax(b->inner, *fitted);
        b->outer = b->outer > *fitted ? b->outer : INFINITY;
    } else {
        b->outer = fmin(b->outer, *fitted);
        b->inner = b->inner < *fitted ? b->inner : -INFINITY;
    }
    if (moved < AT_REST)
        return moved;
    if (b->outer - b->inner < AT_REST * h) {
        const int rests = *fitted == b->outer;
        *fitted = b->outer;
        return rests ? 0.0 : moved;
    }
    const int is_inside = found > b->inner && found < b->outer;
    *fitted = is_inside ? found : 0.5 * (b->inner + b->outer);
    return moved;
}

typedef struct {
    bracket left, right;
} brackets;

static void forget_brackets(brackets *known)
{
    const bracket open = {-INFINITY, INFINITY};

    for (int k = 0; k < MOST_PATCHES; k++)
        known[k] = (brackets){open, open};
}

/* ---- All of them ------------------------------------------------------------------- */

int rb_rolling_equal_elements_instead(int elements)
{
    return (int)ceil(1.3 * elements);
}

static void drop_far_field(rb_rolling_model *model)
{
    rb_rolling_far_field_free(model->far);
    model->far = NULL;
}

rb_status rb_rolling_solve_equal_instead(rb_rolling_model *model, rb_message *why)
{
    const int wanted = model->plan.elements;

    drop_far_field(model);

    model->plan.elements = rb_rolling_equal_elements_instead(wanted);
    const rb_status s = rb_rolling_solve_zone(model, 0, why);
    model->plan.elements = wanted;
    return s;
}

/* 1: fitted elements, which differ in length. */
static int is_graded(const rb_rolling_mesh *mesh)
{
    return length_of(mesh, mesh->n / 2) > 2.0 * length_of(mesh, mesh->n / 8);
}

/* 1: both have the same edges, to what counts as rest. */
static int same_edges(const patches *a, const patches *b)
{
    int same = a->count == b->count;

    for (int k = 0; same && k < a->count; k++)
        same = fabs(a->span[k].from - b->span[k].from) < AT_REST * b->span[k].h_left &&
               fabs(a->span[k].to - b->span[k].to) < AT_REST * b->span[k].h_right;
    return same;
}

/* From a solution to elements fitted to its edges, until these rest; where they do not, or
 * where no solution is found on them, to equal ones.
 * Wheels are searched by a far field.  with_systems: where its edges rest the boundary elements of
 * the same mesh are solved, at first for the tractions found, which match the far field to them;
 * then wholly, and if these put the edges elsewhere, the search goes on by their far field. room:
 * kept beyond the edges at first, as a part of the patch.  enough: how nearly they rest. */
static rb_status refit(rb_rolling_model *model, double room, int with_systems, double enough,
                       rb_message *why)
{
    patches fitted, found, expected = {.count = 0};
    brackets known[MOST_PATCHES];
    const int has_far = rb_rolling_has_far_field(model->rc) && model->mesh.n >= 8,
              rounds = has_far ? 2 * ROUNDS : ROUNDS;
    rb_status s = find_patches(model, &fitted);
    int rest = 0, by_far_field = 0;

    forget_brackets(known);
    for (int k = 0; k < fitted.count; k++) {
        rb_rolling_span *span = &fitted.span[k];
        span->margin_left = fmax(span->margin_left, room * (span->to - span->from));
        span->margin_right = fmax(span->margin_right, room * (span->to - span->from));
    }
    for (int round = 0; round < rounds && !rest && fitted.count > 0 && (s == RB_OK || s == RB_ZONE);
         round++) {
        rb_rolling_mesh mesh;
        const int is_checked = by_far_field && !model->far;
        if (has_far && !model->far && !is_checked && model->bodies.F)
            s = rb_rolling_far_field_create(model, is_graded(&model->mesh), &model->far, why);
        by_far_field = model->far != NULL;
        if (s == RB_OK || s == RB_ZONE)
            s = rb_rolling_mesh_spans(model->rc, model->plan.elements, fitted.count, fitted.span,
                                      &mesh, why);
        /* which starts from the solution before: on a mesh that ends somewhere a corner of a punch
         * can be a solution as well */
        if (s == RB_OK)
            s = rb_rolling_model_build(model, &mesh, why);
        const rb_status t = s < 0 ? s : find_patches(model, &found);
        if (t != RB_OK) {
            model->equal_instead = 0;
            return t;
        }
        if (s == RB_OK && found.count == fitted.count) {
            /* The next edges to fit to. */
            double moved = 0.0;

            for (int k = 0; k < fitted.count; k++) {
                const rb_rolling_span *now = &found.span[k];
                rb_rolling_span *span = &fitted.span[k];
                double left = -span->from;
                moved =
                    fmax(moved, refine_fitted_edge(-now->from, now->h_left, &left, &known[k].left));
                moved = fmax(moved,
                             refine_fitted_edge(now->to, now->h_right, &span->to, &known[k].right));
                span->from = -left;
                span->margin_left = now->margin_left;
                span->margin_right = now->margin_right;
            }
            /* The far field of another mesh is matched to this one; edges that rest by its far
             * field are checked by the boundaries. */
            const int by_systems = with_systems && by_far_field, is_last = round + 2 >= rounds,
                      will_match = by_systems && !is_last && model->plan.elements >= FIRST &&
                                   !rb_rolling_far_field_matches(model->far, model->mesh.n);
            rest = moved < (round + 1 == rounds ? NEAR_REST
                            : will_match        ? TO_MATCH
                                                : enough) ||
                   (is_checked && same_edges(&expected, &found));
            if (will_match && rest) {
                s = rb_rolling_far_field_match(model, model->far, why);
                forget_brackets(known);
                rest = 0;
            } else if (by_systems && (rest || is_last)) {
                expected = rest ? found : (patches){.count = 0};
                drop_far_field(model);
                rest = 0;
            }
            if (has_far && !model->far)
                forget_brackets(known);
        } else {
            forget_brackets(known);
            fitted = found;
        }
    }
    model->equal_instead = s >= 0 && !rest;
    return model->equal_instead ? rb_rolling_solve_equal_instead(model, why)
           : s == RB_ZONE       ? RB_OK
                                : s;
}

rb_status rb_rolling_model_refit(rb_rolling_model *model, rb_message *why)
{
    return refit(model, 0.0, 1, AT_REST, why);
}

rb_status rb_rolling_fit_beside(const rb_rolling_model *beside, rb_rolling_model *model,
                                rb_message *why)
{
    static const double ROOM = 0.1, SHORT = 2e-3; /* of the radius: the error of a far field */
    const rb_bem_flexibility *f = &beside->bodies.f;
    const rb_rolling_elements elements = {.n = f->n, .x = f->x, .h = f->h};
    const double longest = rb_rolling_longest_element(f->n, beside->state.zone, f->h);
    rb_status s = rb_rolling_mesh_of_result(model->rc, &elements, &model->mesh, why);

    if (s == RB_OK)
        s = rb_contact_state_alloc(model->mesh.n, &model->state);
    if (s == RB_OK)
        s = rb_rolling_far_field_create(beside, 0, &model->far, why);
    if (s != RB_OK)
        return s;
    rb_contact_copy_start(&beside->state, &model->state);
    return refit(model, ROOM, longest > SHORT * rb_rolling_radius(model->rc), AT_REST, why);
}

rb_status rb_rolling_solve_fitted(rb_rolling_model *model, rb_message *why)
{
    const rb_rolling_plan asked = model->plan;
    const int fine = rb_rolling_has_fine_boundary(&asked),
              has_far = rb_rolling_has_far_field(model->rc),
              by_far_field = has_far && asked.elements >= FIRST;
    const int strong = rb_rolling_mu_beta(model->rc) >= STRONG;
    /* with a matrix half of the elements cost little */
    int halvings = asked.elements >= 2 * FIRST && asked.elements < RB_ROLLING_TRANSFORMS_FITTED;

    while (strong && asked.elements >> halvings > COARSEST_STRONG)
        halvings++;
    while (asked.elements > RB_ROLLING_FITTED_AT_ONCE &&
           asked.elements >> halvings > RB_ROLLING_COARSEST_FITTED)
        halvings++;
    /* A coarse solution to fit to, where the rest of a wheel has few elements. */
    if (model->rc->zone == 0.0) {
        model->plan.elements = (int)fmax(FIRST, (asked.elements >> halvings) / 2);
        if (!has_far)
            model->plan.near_field = RB_NEAR_FIELD_PLAIN;
    }
    if (fine || by_far_field)
        rb_rolling_coarsen_boundary(&model->plan);
    if (by_far_field)
        model->plan.outer_refinement = COARSE_BOUNDARY;
    rb_status s = rb_rolling_solve_zone(model, 1, why);
    model->plan = asked;
    if (fine)
        rb_rolling_coarsen_boundary(&model->plan);
    model->iterations = 0; /* those on fitted elements count */
    /* Many elements start from the edges and the zones of few. */
    for (int k = halvings; k > 0 && s == RB_OK; k -= strong ? 1 : 2) {
        model->plan.elements = asked.elements >> k;
        s = refit(model, 0.0, 0, TO_GO_ON, why);
        if (s == RB_OK && strong && k == halvings && model->far) {
            s = rb_rolling_far_field_match(model, model->far, why);
            if (s == RB_OK)
                s = refit(model, 0.0, 0, TO_GO_ON, why);
        }
        model->iterations = 0;
    }
    model->plan.elements = asked.elements;
    if (s == RB_OK)
        s = rb_rolling_model_refit(model, why);
    if (s == RB_OK && fine) {
        model->plan = asked;
        s = model->equal_instead ? rb_rolling_solve_equal_instead(model, why)
                                 : rb_rolling_model_refit(model, why);
    }
    return s;
}
