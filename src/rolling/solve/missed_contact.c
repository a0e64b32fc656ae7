/* The gap beyond the elements that could carry load: if the gap is a table, the bodies
 * may touch at places without elements (theory-solvers.md 5.1). */
#include "rolling/body/internal.h"
#include "rolling/body/mesh.h"
#include "rolling/body/surface.h"
#include "rolling/case/derived.h"
#include "rolling/solve/model.h"
#include "rolling/solve/zone.h"

#include <cblas.h>
#include <gsl/gsl_interp.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_sort.h>

enum {
    /* That stand for the loaded elements, seen from afar.  Pressure falls like a root
     * towards an edge, so that the outermost of so many strips carries 1/2000 of the
     * load: what its mean moves at its neighbours is a tenth of what is negligible. */
    MOST_STRIPS = 256,
    BETWEEN = 4, /* places from one row of the table to the next */
    MOST_PLACES = 20000
};
/* Part of the undeformed gap at the edge of Hertz's contact: a patch that overlaps less
 * would carry next to nothing. */
static const double NEGLIGIBLE = 1e-3;

/* ---- Displacement of the surfaces away from the contact ---------------------------- */

/* Elements in groups with the mean of their tractions. */
typedef struct {
    int n;
    double *ends, *p, *q; /* n + 1, n, n; in scratch memory */
} strips;

/* Where a displacement w_N is added. */
typedef struct {
    int n;
    const double *x;
    double *w;
} targets;

static int is_loaded(const rb_contact_state *state, int i)
{
    return i >= 0 && i < state->n && state->zone[i] != RB_ZONE_SEPARATED;
}

/* From the first loaded element to the last; all where none is. */
static rb_status gather_strips(const rb_rolling_mesh *mesh, const rb_contact_state *state,
                               rb_arena *scratch, strips *s)
{
    int from = 0, to = mesh->n;

    while (from < mesh->n && !is_loaded(state, from))
        from++;
    while (to > from && !is_loaded(state, to - 1))
        to--;
    if (from == to)
        from = 0, to = mesh->n;
    const int group = (to - from + MOST_STRIPS - 1) / MOST_STRIPS;
    s->n = (to - from + group - 1) / group;
    s->ends = rb_arena_doubles(scratch, (size_t)s->n + 1, 1);
    s->p = rb_arena_doubles(scratch, (size_t)s->n, 1);
    s->q = rb_arena_doubles(scratch, (size_t)s->n, 1);
    if (scratch->failed)
        return RB_ENOMEM;
    for (int k = 0; k < s->n; k++) {
        const int first = from + k * group;
        const int last = first + group < to ? first + group : to;
        s->ends[k] = mesh->ends[first];
        s->ends[k + 1] = mesh->ends[last];
        for (int i = first; i < last; i++) {
            const double share =
                (mesh->ends[i + 1] - mesh->ends[i]) / (s->ends[k + 1] - s->ends[k]);
            s->p[k] += share * state->p[i];
            s->q[k] += share * state->q[i];
        }
    }
    return RB_OK;
}

/* Of the lower half of a wheel, between the midpoints of its boundary elements, by their
 * system; of a cover, by its waves under the loads. */
static rb_status add_wheel(const rb_rolling_model *model, const rb_contact_state *state, int is_b,
                           const rb_bem_edge_load *loads, rb_arena *scratch, const targets *to)
{
    const rb_rolling_body *body = is_b ? &model->rc->b : &model->rc->a;
    rb_bem_system *system = is_b ? model->bodies.system_b : model->bodies.system_a;
    const double radius = body->radius, coupling = is_b ? -1.0 : 1.0;
    rb_bem_mesh mesh;
    rb_status s = rb_rolling_boundary_mesh(model, is_b, &mesh, NULL);
    const size_t n = (size_t)model->mesh.n, all = s == RB_OK ? (size_t)mesh.n : 0;
    double *x = rb_arena_doubles(scratch, all, 1), *w = rb_arena_doubles(scratch, all, 1);
    int *element = rb_arena_ints(scratch, all);
    size_t lower = 0;

    for (size_t j = 0; j < all && !scratch->failed; j++) {
        const double mx = 0.5 * (mesh.x0[j] + mesh.x1[j]);
        const double my = 0.5 * (mesh.y0[j] + mesh.y1[j]);
        const int is_rim = hypot(mesh.x0[j], mesh.y0[j] - radius) > (1.0 - 1e-9) * radius;
        if (is_rim && my < radius) {
            x[lower] = mx;
            element[lower++] = (int)j;
        }
    }
    rb_bem_mesh_free(&mesh);
    if (s == RB_OK && system) {
        double *t_c = rb_arena_doubles(scratch, 2 * n, 1),
               *t = rb_arena_doubles(scratch, 2 * all, 1),
               *u = rb_arena_doubles(scratch, 2 * all, 1);

        if (scratch->failed)
            return RB_ENOMEM;
        for (size_t i = 0; i < n; i++) {
            t_c[2 * i] = coupling * state->q[i];
            t_c[2 * i + 1] = state->p[i];
        }
        s = rb_bem_system_solve(system, t_c, u, t);
        for (size_t i = 0; i < lower; i++)
            w[i] = u[2 * element[i] + 1];
    } else if (s == RB_OK) {
        double length[RB_ROLLING_TERMS];
        const rb_bem_wheel wheel = rb_rolling_wheel_of(model->rc, body, length);

        s = scratch->failed ? RB_ENOMEM : rb_bem_wheel_normal(&wheel, loads, (int)lower, x, w);
    }
    if (s != RB_OK || lower < 2)
        return s;
    gsl_sort2(x, 1, w, 1, lower);
    for (int i = 0; i < to->n; i++) {
        const size_t k = gsl_interp_bsearch(x, to->x[i], 0, lower - 1);
        const double t = (to->x[i] - x[k]) / (x[k + 1] - x[k]);
        to->w[i] += w[k] + t * (w[k + 1] - w[k]);
    }
    return RB_OK;
}

static rb_status add_bodies(const rb_rolling_model *model, const rb_contact_state *state,
                            const strips *s, rb_arena *scratch, const targets *to)
{
    double *q = rb_arena_doubles(scratch, (size_t)s->n, 1);

    if (scratch->failed)
        return RB_ENOMEM;
    for (int b = 0; b < 1 + model->rc->elastic_b; b++) {
        const rb_rolling_body *body = b ? &model->rc->b : &model->rc->a;
        const rb_bem_edge_load loads = {s->n, s->ends, s->p, q};
        rb_status status;

        for (int k = 0; k < s->n; k++)
            q[k] = (b ? -1.0 : 1.0) * s->q[k]; /* B is mirrored */
        if (rb_rolling_body_can(body, RB_BODY_FLAT)) {
            double length[RB_ROLLING_TERMS];
            const rb_bem_surface surface = rb_rolling_surface_of(model->rc, body, length);
            status = rb_bem_surface_add_normal(&surface, &loads, to->n, to->x, to->w);
        } else
            status = add_wheel(model, state, b, &loads, scratch, to);
        if (status != RB_OK)
            return status;
    }
    return RB_OK;
}

/* w: w_N at the places x, whose last two are the outermost midpoints of the mesh.  There
 * the flexibility is known, from which the boundary elements of a wheel differ a little:
 * the difference is taken off all along. */
static rb_status displacement(const rb_rolling_model *model, const rb_contact_state *state,
                              const strips *s, rb_arena *scratch, const targets *to)
{
    const int n = model->mesh.n, left = to->n - 2, right = to->n - 1;
    const double *x = to->x;
    double *w = to->w, *own = rb_arena_doubles(scratch, 2 * (size_t)n + 2, 1);
    rb_status status = own ? add_bodies(model, state, s, scratch, to) : RB_ENOMEM;

    if (status == RB_OK)
        status = rb_rolling_displacement(&model->bodies, state->p, state->q, own);
    if (status != RB_OK)
        return status;
    const double off[2] = {own[0] - w[left], own[n - 1] - w[right]};
    for (int i = 0; i < to->n; i++) {
        const double t = (x[i] - x[left]) / (x[right] - x[left]);
        w[i] += off[0] + fmin(1.0, fmax(0.0, t)) * (off[1] - off[0]);
    }
    return RB_OK;
}

/* ---- Overlaps between the elements ------------------------------------------------- */

static double shortest(const rb_rolling_mesh *mesh)
{
    double h = INFINITY;
    for (int i = 0; i < mesh->n; i++)
        h = fmin(h, mesh->ends[i + 1] - mesh->ends[i]);
    return h;
}

/* 1 beyond the mesh and in open elements much longer than the shortest, which see the gap
 * at their midpoints only. */
static int is_unseen(const rb_rolling_mesh *mesh, const rb_contact_state *state, double h, double x)
{
    if (x < mesh->ends[0] || x >= mesh->ends[mesh->n])
        return 1;
    const int i = (int)gsl_interp_bsearch(mesh->ends, x, 0, (size_t)mesh->n);
    return !is_loaded(state, i - 1) && !is_loaded(state, i) && !is_loaded(state, i + 1) &&
           mesh->ends[i + 1] - mesh->ends[i] > 2.0 * h;
}

/* A table that moves: its n rows stood at x before it has passed so far. */
typedef struct {
    int n;
    const double *x;
    double passed;
} table;

/* Appends the rows of a table and places between them, thinned out where they are very
 * many; returns how many places there are now. */
static int add_places(const rb_rolling_model *model, const rb_contact_state *state, const table *t,
                      double *x, int n)
{
    const double h = shortest(&model->mesh);
    const int all = BETWEEN * (t->n - 1), stride = 1 + all / MOST_PLACES;
    double from, to;

    rb_rolling_extent(model->rc, &from, &to);
    for (int k = 0; k <= all; k += stride) {
        const int r = k < all ? k / BETWEEN : t->n - 2;
        const double share = (double)(k - BETWEEN * r) / BETWEEN;
        const double place = t->x[r] + share * (t->x[r + 1] - t->x[r]) - t->passed;
        if (place >= from && place <= to && is_unseen(&model->mesh, state, h, place))
            x[n++] = place;
    }
    return n;
}

/* All arrays are scratch memory; the caller frees it. */
static rb_status find_overlap(const rb_rolling_model *model, const rb_contact_state *state,
                              rb_arena *scratch, rb_rolling_overlap *o)
{
    enum { TABLES = 3 };
    const rb_rolling_case *rc = model->rc;
    const rb_rolling_mesh *mesh = &model->mesh;
    /* A part of the undeformed gap at the edge of Hertz's contact under the state's load. */
    const double P = cblas_ddot(state->n, model->problem.load_N, 1, state->p, 1);
    const double tolerance =
        NEGLIGIBLE * 2.0 * fmax(P, 0.0) / (M_PI * rb_rolling_derive(rc).modulus);
    const double h = shortest(mesh);
    double limit[2], least = -INFINITY;
    strips s = {0};
    /* The profile, what is irregular and what is worn; n < 2: it says nothing. */
    table t[TABLES] = {{0, NULL, 0.0},
                       {rc->irregularity.n, rc->irregularity.x, mesh->passed},
                       {rc->worn.n, rc->worn.x, 0.0}};
    size_t most = 2;

    if (rc->gap == RB_GAP_TABLE)
        t[0].n = rb_rolling_profile_rows(rc->profile, &t[0].x);
    for (int k = 0; k < TABLES; k++)
        most += (size_t)fmin(BETWEEN * (double)t[k].n, MOST_PLACES) + BETWEEN;
    double *x = rb_arena_doubles(scratch, most, 1), *w = rb_arena_doubles(scratch, most, 1),
           *gap = rb_arena_doubles(scratch, most, 1);
    rb_status status = scratch->failed ? RB_ENOMEM : gather_strips(mesh, state, scratch, &s);
    if (status != RB_OK)
        return status;
    /* Places of all tables in order, and the undeformed gap there. */
    int places = 0;
    for (int k = 0; k < TABLES; k++)
        if (t[k].n > 1)
            places = add_places(model, state, &t[k], x, places);
    gsl_sort(x, 1, (size_t)places);
    status = rb_rolling_gap_along(rc, mesh->passed, places, x, gap);
    if (status != RB_OK || places == 0)
        return status;
    if (rb_rolling_can(rc, RB_BODY_FLAT | RB_BODY_HOMOGENEOUS) && rc->period == 0.0) {
        /* Pressed half-planes are displaced the less the further away: between these ends
         * nowhere less than at that length from either.  A bound for wheels is not needed:
         * all their places cost one solve. */
        const double from = fmin(x[0], mesh->ends[0]),
                     to = fmax(x[places - 1], mesh->ends[mesh->n]),
                     beyond[2] = {2.0 * from - to, 2.0 * to - from};
        double there[2] = {0.0, 0.0};
        status = add_bodies(model, state, &s, scratch, &(targets){2, beyond, there});
        if (status != RB_OK)
            return status;
        least = fmin(there[0], there[1]);
    }
    /* The places that the displacements may close. */
    int n = 0;

    for (int i = 0; i < places; i++)
        if (gap[i] < state->delta - least) {
            x[n] = x[i];
            gap[n++] = gap[i];
        }
    if (n == 0)
        return RB_OK;
    x[n] = model->bodies.f.x[0];
    x[n + 1] = model->bodies.f.x[mesh->n - 1];
    status = displacement(model, state, &s, scratch, &(targets){n + 2, x, w});
    if (status != RB_OK)
        return status;
    for (int i = 0; i < n; i++)
        if (gap[i] - state->delta + w[i] < -tolerance) {
            /* Neighbouring places of overlap are one stretch, which reaches to the next
             * places without, or by h where there is none. */
            const double from = i > 0 ? x[i - 1] : x[i] - h;
            const double to = i + 1 < n ? x[i + 1] : x[i] + h;
            if (o->count == 0 || (from > o->to[o->count - 1] && o->count < RB_MOST_OVERLAPS))
                o->from[o->count++] = from;
            o->to[o->count - 1] = to;
        }
    rb_rolling_extent(rc, &limit[0], &limit[1]);
    for (int k = 0; k < o->count; k++) {
        o->from[k] = fmax(o->from[k], limit[0]);
        o->to[k] = fmin(o->to[k], limit[1]);
    }
    return RB_OK;
}

rb_status rb_rolling_find_overlap(const rb_rolling_model *model, const rb_contact_state *state,
                                  rb_rolling_overlap *o)
{
    rb_arena scratch = {0};

    o->count = 0;
    if (model->mesh.n < 2)
        return RB_OK;
    return rb_arena_done(&scratch, find_overlap(model, state, &scratch, o));
}
