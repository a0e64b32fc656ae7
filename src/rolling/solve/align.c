/* Equal elements aligned with the contact: both edges are ends of elements, so that the
 * second-order slip operator has its second order (theory-rolling.md 4.7). */
#include "base/sizes.h"
#include "rolling/body/mesh.h"
#include "rolling/solve/fit.h"
#include "rolling/solve/model.h"
#include "rolling/solve/patches.h"
#include "rolling/solve/zone.h"

#include <math.h>

enum {
    FIRST = 30, /* elements at least that the first edges are found with */
    LEVEL = 2,  /* binary digits fewer than on the next level: a quarter of it */
    ROUNDS = 10,
    COARSE_ROUNDS = 3, /* to know an edge to a part of an element */
    BEYOND = 4         /* separated elements kept beyond either edge */
};
/* Edges that have come to rest, and edges that never will, in elements. */
static const double AT_REST = 1e-4, NEAR_REST = 5e-2;
/* Change, as a part of the one before, of an edge that keeps drifting with the mesh by a
 * part of an element too small to matter: it would not come to rest. */
static const double DRIFT = 0.05;
/* Elements by which a mesh may miss its own edge on the outer side of a jump: less
 * changes the force by less than a hundredth of its error. */
static const double MISSED = 0.25;
/* Elements to which a jump is bracketed before it is known to miss more on either side. */
static const double BRACKETED = 0.1;

/* The edges of the only patch.  RB_EINVAL: there are several; *known: 0 where it has too
 * few elements to tell. */
static rb_status find_edges(const rb_rolling_model *model, double *from, double *to, int *known,
                            rb_message *why)
{
    rb_rolling_run run = {.last = -1}, other;

    rb_rolling_next_patch(model->rc, &model->mesh, &model->state, 0, &run);
    *known = run.last - run.first + 1 >= RB_ROLLING_ALIGNED_LEAST;
    if (rb_rolling_next_patch(model->rc, &model->mesh, &model->state, run.last + 1, &other) &&
        !rb_rolling_is_convex(model->rc))
        return rb_refuse(why, "mesh",
                         "aligned: the contact has several patches, and equal elements cannot end "
                         "at all their edges; use fitted or uniform");
    *from = run.from;
    *to = run.to;
    return RB_OK;
}

/* `across` elements between the edges and some beyond them. */
static rb_status solve_on(rb_rolling_model *model, int across, int beyond, double from, double to,
                          rb_message *why)
{
    const double h = (to - from) / across;
    rb_rolling_plan plan = model->plan;
    rb_rolling_mesh mesh;

    plan.elements = across + 2 * beyond;
    const rb_status s =
        rb_rolling_mesh_uniform(model->rc, &plan, from - beyond * h, to + beyond * h, &mesh, why);
    return s == RB_OK ? rb_rolling_model_build(model, &mesh, why) : s;
}

/* One edge, in outward positions: where the next mesh has it; between which positions it
 * is, and by how much the contact was found to reach beyond either, in lengths; and where
 * the mesh before had it. */
typedef struct {
    double at, inner, outer, beyond_inner, beyond_outer;
    double before, beyond_before;
    int is_lost; /* no mesh will have its own edge */
} edge;

static edge edge_at(double x)
{
    return (edge){x, -INFINITY, INFINITY, 0.0, 0.0, NAN, NAN, 0};
}

/* By how much the edge is beyond that of the mesh, from the last two meshes: the edge
 * found moves a little against that of the mesh.  Between few elements another round costs
 * nothing. */
static double by_secant(const edge *e, double beyond, int across)
{
    const double slope = (beyond - e->beyond_before) / (e->at - e->before);
    const int pays = across >= RB_ROLLING_TRANSFORMS && slope > -1.2 && slope < -0.8;
    return pays ? -beyond / slope : beyond;
}

/* Where the mesh should have its edge next.  The edge found hardly depends on that of the
 * mesh, except where another element becomes the last in contact: there it jumps, by half
 * an element between unlike bodies, and no mesh may find its own edge.  Such a jump is
 * bracketed, and the edge stays on its outer side.  Returns how far from rest it is, in
 * elements. */
static double refine_aligned_edge(edge *e, double found, double h, int across)
{
    const double beyond = found - e->at, moved = fabs(beyond) / h,
                 next = e->at + by_secant(e, beyond, across);

    if (moved < AT_REST)
        return moved;
    e->before = e->at;
    e->beyond_before = beyond;
    if (beyond > 0.0 && e->at > e->inner) {
        e->inner = e->at;
        e->beyond_inner = beyond;
    } else if (beyond < 0.0 && e->at < e->outer) {
        e->outer = e->at;
        e->beyond_outer = beyond;
    }
    const double width = e->outer - e->inner;
    if (!(width > 0.0)) { /* the other edge has moved this one meanwhile */
        *e = edge_at(found);
        return moved;
    }
    const int jumps = e->beyond_inner - e->beyond_outer > 1.5 * width;
    if (jumps && e->beyond_outer > -MISSED * h) {
        const int rests = e->at == e->outer;
        e->at = e->outer;
        return rests ? 0.0 : moved;
    }
    e->is_lost = jumps && width < BRACKETED * h && e->beyond_inner > NEAR_REST * h;
    e->at = jumps || next < e->inner || next > e->outer ? 0.5 * (e->inner + e->outer) : next;
    return moved;
}

/* From the edges that the model has now, known to `*off`, a length; afterwards what the
 * last round moved them by.  *rest: 0 where they did not come to rest, or no solution was
 * found. */
static rb_status align(rb_rolling_model *model, int rounds, double *off, int *rest, rb_message *why)
{
    const int across = model->plan.elements;
    double from, to, moved = INFINITY, before = INFINITY;
    int known, drifts = 0;
    rb_status s = find_edges(model, &from, &to, &known, why);
    int beyond = BEYOND + (int)fmin(*off * across / (to - from), 0.25 * across);
    edge left = edge_at(-from), right = edge_at(to);

    for (int round = 0; round < rounds && known && s == RB_OK && moved > AT_REST && !drifts;
         round++) {
        const double h = (right.at + left.at) / across;
        s = solve_on(model, across, beyond, -left.at, right.at, why);
        const int filled = s == RB_ZONE && round + 1 < rounds;
        if (s == RB_OK || filled)
            s = find_edges(model, &from, &to, &known, why);
        beyond = filled ? 2 * beyond : BEYOND;
        if (filled) {
            left = edge_at(-from);
            right = edge_at(to);
        } else if (s == RB_OK) {
            moved = fmax(refine_aligned_edge(&left, -from, h, across),
                         refine_aligned_edge(&right, to, h, across));
            drifts = (moved <= NEAR_REST && fabs(moved - before) < DRIFT * before) ||
                     left.is_lost || right.is_lost;
            before = moved;
            *off = moved * h;
        }
    }
    *rest = s == RB_OK && known && moved <= NEAR_REST;
    return s == RB_ZONE ? RB_OK : s;
}

static rb_status realign(rb_rolling_model *model, double off, rb_message *why)
{
    int rest;
    const rb_status s = align(model, ROUNDS, &off, &rest, why);

    model->equal_instead = s >= 0 && !rest;
    return model->equal_instead ? rb_rolling_solve_equal_instead(model, why) : s;
}

rb_status rb_rolling_model_realign(rb_rolling_model *model, rb_message *why)
{
    return realign(model, 0.0, why);
}

/* The first elements know an edge to a part of their own length, which is many lengths of
 * the last ones: level by level an edge stays within the elements kept beyond it, and on
 * the last level few rounds are left. */
rb_status rb_rolling_solve_aligned(rb_rolling_model *model, rb_message *why)
{
    const int across = model->plan.elements;
    double off = 0.0;
    int digits = 0, rest;

    while (across >> digits > RB_ROLLING_COARSEST_ALIGNED)
        digits += LEVEL;
    if (model->rc->zone == 0.0)
        model->plan.elements = (int)fmax(FIRST, (across >> digits) / 2);
    rb_status s = rb_rolling_solve_zone(model, 1, why);
    for (; s == RB_OK && digits > 0; digits -= LEVEL) {
        model->plan.elements = across >> digits;
        s = align(model, COARSE_ROUNDS, &off, &rest, why);
        model->iterations = 0; /* those of the last level count */
    }
    model->plan.elements = across;
    return s == RB_OK ? realign(model, off, why) : s;
}
