/* Wear: a sequence of steps of two contact problems, each of which includes the wear of its own
 * stage implicitly (theory-rolling.md 4.9). */
#include "rolling/body/body.h"
#include "rolling/body/mesh.h"
#include "rolling/case/internal.h"
#include "rolling/case/options.h"
#include "rolling/history/internal.h"
#include "rolling/history/worn.h"
#include "rolling/results/columns.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/law.h"
#include "rolling/solve/model.h"
#include "rolling/solve/power.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

void rb_rolling_wear_history_free(rb_rolling_wear_history *h)
{
    if (h->errors)
        rb_rolling_wear_history_free(h->errors);
    free(h->errors);
    rb_rolling_columns_free(&rb_rolling_wear_columns, h);
    memset(h, 0, sizeof *h);
}

/* ---- What is at work --------------------------------------------------------------- */

/* The longest stroke by positions, in half-widths. */
static const double LONGEST = 5.0;

static void run_free(wear_state *r)
{
    rb_rolling_model_free(&r->model);
    rb_rolling_stroke_free(&r->stroke);
    rb_arena_free(&r->memory);
}

/* The contact at rest, on equal elements that stay: those of an automatic zone, with
 * x = 0 in their middle, as a given one has. */
static rb_status press_at_rest(wear_state *r, rb_message *why)
{
    rb_rolling_case at_rest = r->rc;
    const rb_rolling_mesh *mesh = &r->model.mesh;

    at_rest.formulation = RB_STATIC;
    at_rest.increments = 1;
    at_rest.shift = at_rest.force = at_rest.force_ratio = NAN;
    at_rest.creep = at_rest.creep_ratio = NAN;
    /* What slides has full friction everywhere; what frets begins in the middle of its stroke. */
    if (r->wear->slides && rb_rolling_largest_mu(&at_rest) > 0.0)
        at_rest.force_ratio = -1.0; /* A slides towards +x */
    else
        at_rest.shift = 0.0;
    rb_status s = rb_rolling_model_create(&at_rest, &r->model, why);
    /* Again on a zone of the same elements that is symmetric to x = 0. */
    if (s == RB_OK && at_rest.zone == 0.0) {
        at_rest.zone = fmax(-mesh->ends[0], mesh->ends[mesh->n]);
        at_rest.contact_elements = mesh->n;
        rb_rolling_model_free(&r->model);
        s = rb_rolling_model_create(&at_rest, &r->model, why);
    }
    r->rc.zone = at_rest.zone;
    r->rc.contact_elements = mesh->n;
    /* Arrays for the mesh of the model. */
    if (s != RB_OK)
        return s;
    /* n per position of the stroke: pressures. n: abscissae, depths, rates, and the path of a
     * cycle. softer: F with the wear of a stage on its diagonal (W1), or the diagonal alone for
     * products. */
    const size_t n = (size_t)r->model.mesh.n, m = n + 1,
                 all = n * (size_t)rb_rolling_wear_positions(r);

    r->n = (int)n;
    r->x = rb_arena_doubles(&r->memory, n, 1);
    r->depth = rb_arena_doubles(&r->memory, n, 1);
    r->rate = rb_arena_doubles(&r->memory, n, 1);
    r->start = rb_arena_doubles(&r->memory, n, 1);
    r->pressed = rb_arena_doubles(&r->memory, all, 1);
    r->first = rb_arena_doubles(&r->memory, all, 1);
    r->now = rb_arena_doubles(&r->memory, all, 1);
    r->path = rb_arena_doubles(&r->memory, n, 1);
    r->softer = r->model.bodies.F ? rb_arena_doubles(&r->memory, 2 * m, 2 * n)
                                  : rb_arena_doubles(&r->memory, n, 2);
    if (r->memory.failed)
        return RB_ENOMEM;
    memcpy(r->x, r->model.bodies.f.x, n * sizeof *r->x);
    for (size_t i = 0; i < n; i++)
        r->depth[i] = rb_rolling_worn_depth(&r->rc, r->x[i]);
    return RB_OK;
}

/* As many more elements of the same length on either side, of a wheel of the same arc, so that the
 * others stay where they are; what is worn stays where it is. */
static rb_status widen_zone(wear_state *r, rb_message *why)
{
    const int n = r->n, more = n / 4 + 2;
    wear_state wider = *r;

    wider.rc.contact_elements = n + 2 * more;
    const double radius = fmin(fabs(r->rc.a.radius), fabs(r->rc.b.radius)),
                 arc = rb_rolling_body_can(&r->rc.a, RB_BODY_FLAT) ? 0.0 : r->rc.a.radius,
                 factor = (n + 2.0 * more) / n,
                 angle = arc > 0.0 ? factor * asin(r->rc.zone / arc) : 0.0;
    wider.rc.zone = !(arc > 0.0)     ? r->rc.zone * factor
                    : angle < M_PI_2 ? arc * sin(angle)
                                     : arc * angle;
    if (wider.rc.zone >= radius)
        return rb_fail(why, RB_ZONE,
                       "the contact becomes as wide as a body: it would need a zone of %g mm, and "
                       "the radius is %g mm; wear off less",
                       wider.rc.zone, radius);
    memset(&wider.model, 0, sizeof wider.model);
    wider.memory = (rb_arena){0};
    rb_status s = press_at_rest(&wider, why);
    if (s == RB_OK && r->stroke.positions > 0)
        s = rb_rolling_stroke_widen(&r->stroke, more);
    wider.stroke = r->stroke;
    r->stroke = (rb_rolling_stroke){0};
    if (s != RB_OK) {
        run_free(&wider);
        return s;
    }
    memcpy(wider.depth + more, r->depth, (size_t)n * sizeof *r->depth);
    memset(wider.pressed, 0,
           (size_t)(wider.n * rb_rolling_wear_positions(&wider)) * sizeof *wider.pressed);
    for (int j = 0; j < rb_rolling_wear_positions(&wider); j++)
        memcpy(wider.pressed + j * wider.n + more, r->pressed + j * n,
               (size_t)n * sizeof *r->pressed);
    run_free(r);
    *r = wider;
    r->rc.worn = rb_rolling_worn_so_far(r);
    return RB_OK;
}

/* ---- Sliding, fretting, rolling ---------------------------------------------------- */

/* Adds the slip of an increment of the cycle that counts, the second one. */
static int see_increment(const rb_rolling_model *model, const rb_rolling_history *h, int step,
                         int steps, void *context)
{
    wear_state *r = context;
    const int quarter = r->wear->increments;

    (void)h;
    (void)steps;
    for (int i = 0; i < r->n && step >= quarter; i++) {
        const double slip = fabs(model->state.lambda[i]);
        r->path[i] += slip;
        r->work += slip * fabs(model->state.q[i]) * model->bodies.f.h[i];
    }
    return 0;
}

/* (W3) A round wheel stays round: R = R_before - turns dz(R); B turns R/|R_B| times as
 * often, a bore grows.  *depth: per turn, at the radii found. */
static rb_status roll_stage(wear_state *r, double before, double before_b, double turns,
                            double *depth, rb_message *why)
{
    enum { ROUNDS = 30 };
    const double share = r->wear->share;
    const int turns_b = r->rc.elastic_b && isfinite(before_b) && share > 0.0;

    /* The wear of a turn depends on the radius that it leaves: a fixed point, which contracts by
     * the small part of the radius that a step wears. */
    for (int k = 0; k < ROUNDS; k++) {
        rb_rolling_model_free(&r->model);
        const rb_status s = rb_rolling_model_create(&r->rc, &r->model, why);
        if (s != RB_OK)
            return s;
        /* Depth per turn: every point of the circumference passes the contact once. */
        const rb_rolling_model *model = &r->model;
        const rb_contact_state *state = &model->state;
        const double *h = model->bodies.f.h, *e_T = model->problem.e_T;

        *depth =
            r->wear->coefficient *
            (r->wear->law == RB_WEAR_ARCHARD
                 ? rb_rolling_slid_pressure(model->rc, state->n, state->lambda, state->p, h, e_T)
                 : rb_rolling_dissipated_power(model->rc, state->n, state->lambda, state->q, h,
                                               e_T));
        /* depth is that of one turn: A wears the part 1 - share of it, and B the rest, R_A/|R_B|
         * times per turn of A. */
        const double radius = before - turns * (1.0 - share) * *depth, moved = r->rc.a.radius;
        if (turns_b)
            r->rc.b.radius = before_b - turns * share * *depth * moved / fabs(r->rc.b.radius);
        if (!(radius > 0.5 * before) || !(r->rc.b.radius / before_b > 0.5 || !turns_b))
            return rb_fail(
                why, RB_EINVAL, "wear: a step takes %g mm of the radius, %g mm; take more steps",
                fmax(before - radius, turns_b ? before_b - r->rc.b.radius : 0.0), before);
        r->rc.a.radius = radius;
        if (fabs(radius - moved) <= 1e-14 * before)
            break;
    }
    return RB_OK;
}

/* (W4) of the radii. */
static rb_status roll_step(wear_state *r, double turns, rb_message *why)
{
    /* The first stage wears gamma of the step; the second one starts from what the rest of the step
     * wears by the slope of the first. */
    const double start = r->rc.a.radius, start_b = r->rc.b.radius, share = r->wear->share;
    double first = 0.0, second = 0.0;
    rb_status s = roll_stage(r, start, start_b, GAMMA * turns, &first, why);

    if (s != RB_OK)
        return s;
    const double worn = (start - r->rc.a.radius) / GAMMA,
                 worn_b = (start_b - r->rc.b.radius) / GAMMA;
    const int turns_b = r->rc.elastic_b && isfinite(start_b) && share > 0.0;
    s = roll_stage(r, start - (1.0 - GAMMA) * worn,
                   turns_b ? start_b - (1.0 - GAMMA) * worn_b : start_b, GAMMA * turns, &second,
                   why);
    r->passage = share * second;
    if (!turns_b)
        r->track += share * ((1.0 - GAMMA) * first + GAMMA * second) * turns * 2.0 * M_PI * start;
    r->work =
        rb_rolling_dissipated_power(r->model.rc, r->model.state.n, r->model.state.lambda,
                                    r->model.state.q, r->model.bodies.f.h, r->model.problem.e_T);
    return s;
}

/* ---- Records ----------------------------------------------------------------------- */

/* 1: the pressure of what sticks in all of the cycle has grown at its edge, behind which it is worn
 * off, above the one at first: it has no bound there. */
static int has_stick_edge(const wear_state *r)
{
    static const double GROWN = 1.01;
    int sticks = 0, slips = 0;

    for (int i = 0; i < r->n; i++) {
        sticks += r->model.state.p[i] > 0.0 && r->path[i] == 0.0;
        slips += r->path[i] > 0.0 && r->depth[i] > 0.0;
    }
    return sticks > 0 && slips > 0 &&
           rb_rolling_peak_pressure(&r->model) > GROWN * r->history->max_pressure[0];
}

typedef struct {
    double volume, deepest; /* [length^2], [length] */
} scar;

static scar scar_of(int n, const double *depth, double h, double part)
{
    scar of = {0.0, 0.0};

    for (int i = 0; i < n; i++) {
        of.volume += part * depth[i] * h;
        of.deepest = fmax(of.deepest, part * depth[i]);
    }
    return of;
}

/* What is worn off A and B where the gap changes; nothing where it rolls. */
static void scars(const wear_state *r, scar *a, scar *b)
{
    const rb_rolling_stroke *stroke = &r->stroke;
    const int frets = r->rc.formulation == RB_STATIC && !r->wear->slides; /* both, there */
    const double share = frets ? r->wear->share : 0.0, h = r->n > 0 ? r->model.bodies.f.h[0] : 0.0;

    if (stroke->positions > 0) {
        *a = scar_of(stroke->n, stroke->a, h, 1.0);
        *b = scar_of(stroke->n + 2 * stroke->more, stroke->b, h, 1.0);
        return;
    }
    *a = scar_of(r->n, r->depth, h, 1.0 - share);
    *b = frets ? scar_of(r->n, r->depth, h, share) : (scar){r->track, r->passage};
}

/* One row of the history, at the end of a step: what is worn so far, and the contact under the worn
 * gap. */
static rb_status record_step(wear_state *r, double way, rb_message *why)
{
    rb_rolling_wear_history *h = r->history;
    const int k = h->n, rolls = h->rolls;
    rb_rolling_solution s;
    rb_status status = rb_rolling_model_solution(&r->model, &s, why);

    if (status != RB_OK)
        return status;
    h->way[k] = way;
    h->radius[k] = r->rc.a.radius;
    h->max_depth[k] = rolls ? h->radius_before - r->rc.a.radius : 0.0;
    h->worn[k] = rolls ? M_PI * (gsl_pow_2(h->radius_before) - gsl_pow_2(h->radius[k])) : 0.0;
    scar of_a, of_b;
    scars(r, &of_a, &of_b);
    h->worn[k] += of_a.volume;
    h->max_depth[k] = fmax(h->max_depth[k], of_a.deepest);
    if (h->worn_b) {
        h->worn_b[k] = of_b.volume;
        h->max_depth_b[k] = of_b.deepest;
    }
    if (h->stroke) {
        h->stroke[k] = r->slid;
        h->stroke[0] = h->stroke[k > 0];
        h->positions = r->stroke.positions;
    }
    if (h->radius_b) {
        h->radius_b[k] = r->rc.b.radius;
        if (rolls) {
            h->worn_b[k] = M_PI * fabs(gsl_pow_2(h->radius_b_before) - gsl_pow_2(h->radius_b[k]));
            h->max_depth_b[k] = h->radius_b_before - h->radius_b[k];
        }
    }
    h->work[k] = r->wear->slides ? fabs(s.tangential_load) : r->work;
    h->approach[k] = s.approach;
    h->normal_load[k] = s.normal_load;
    h->max_pressure[k] = s.max_pressure;
    h->contact_from[k] = s.contact_from;
    h->contact_to[k] = s.contact_to;
    h->residual[k] = s.residual;
    h->n++;
    h->stick_edge = s.stick_edge = !rolls && !r->wear->slides && way > 0.0 && has_stick_edge(r);
    rb_rolling_solution_free(r->last);
    *r->last = s;
    return r->observer && r->observer->step(r->last, h, k, r->wear->steps, r->observer->context)
               ? rb_fail(why, RB_INTERRUPTED, "interrupted after step %d of %d", k, r->wear->steps)
               : RB_OK;
}

/* What a cycle slides everywhere, under the worn gap: loading, and one closed cycle to the other
 * side and back, in static increments. */
static rb_status fret_cycle(wear_state *r, rb_message *why)
{
    const int quarter = r->wear->increments, rows = 5 * quarter;
    const rb_rolling_case *rc = &r->rc;
    const double last = !isnan(rc->force)         ? rc->force
                        : !isnan(rc->force_ratio) ? rc->force_ratio
                                                  : rb_rolling_wanted_shift(rc);
    rb_arena scratch = {0};
    double *column = rb_arena_doubles(&scratch, (size_t)rows, 1);
    rb_rolling_program program = {.n = rows};
    rb_rolling_history history = {0};
    rb_rolling_model model = {0};

    *(!isnan(rc->force)         ? &program.force
      : !isnan(rc->force_ratio) ? &program.force_ratio
                                : &program.shift) = column;
    for (int j = 0; j < rows && column; j++) {
        /* 0 to last, on to -last, and back to last: the first quarter loads, the other four are the
         * cycle that counts. */
        const double t = (j + 1.0) / quarter; /* quarters of a cycle */
        column[j] = last * (t <= 1.0 ? t : t <= 3.0 ? 2.0 - t : t - 4.0);
    }
    r->work = 0.0;
    memset(r->path, 0, (size_t)r->n * sizeof *r->path);
    const rb_status s =
        column ? rb_rolling_history_run(rc, &program, &(rb_rolling_observer){see_increment, r},
                                        &model, &history, why)
               : RB_ENOMEM;
    rb_rolling_model_free(&model);
    rb_rolling_history_free(&history);
    return rb_arena_done(&scratch, s);
}

/* ---- Elements about what sticks ---------------------------------------------------- */

/* The edge of what sticks in all of the cycle, on one side (-1 left, +1 right): beyond it a cycle
 * slides as (x - c)^(3/2), so that the parabola of path^(2/3) through the second, third and fourth
 * element that slides is zero there.  outer: the last one that sticks.  NaN: too few slide. */
static double edge_of_stick(const wear_state *r, int outer, int side)
{
    const double h = r->model.bodies.f.h[0];
    double y[3];

    for (int k = 0; k < 3; k++) {
        const int i = outer + side * (k + 2);
        if (i < 0 || i >= r->n || !(r->model.state.p[i] > 0.0) || !(r->path[i] > 0.0))
            return NAN;
        y[k] = cbrt(gsl_pow_2(r->path[i]));
    }
    /* Slope and curvature of the parabola through y at 0, 1, 2; its nearer zero lies towards the
     * stick zone. */
    const double b = 0.5 * (4.0 * y[1] - 3.0 * y[0] - y[2]), c = 0.5 * (y[0] - 2.0 * y[1] + y[2]);
    const double square = b * b - 4.0 * c * y[0];
    /* in elements from the second one that slides, towards what sticks */
    const double inwards = square >= 0.0 ? 2.0 * y[0] / (sqrt(square) + b) : NAN;
    return r->x[outer] + side * h * (2.0 - inwards);
}

/* 1: the elements that stick in all of the cycle are one run with edges that are known. */
static int stick_run(const wear_state *r, double *from, double *to)
{
    int first = -1, last = -1, count = 0;

    for (int i = 0; i < r->n; i++)
        if (r->model.state.p[i] > 0.0 && r->path[i] == 0.0) {
            first = first < 0 ? i : first;
            last = i;
            count++;
        }
    if (count == 0 || last - first + 1 != count)
        return 0;
    *from = edge_of_stick(r, first, -1);
    *to = edge_of_stick(r, last, 1);
    return isfinite(*from) && isfinite(*to);
}

/* (W6) Elements of such a length that the edges of what sticks lie a quarter of an element within
 * the last ones that do.  Edges elsewhere move the edge of the worn scar by up to half an element.
 */
static rb_status align_with_stick(wear_state *r, rb_message *why)
{
    enum { ROUNDS = 4, LEAST = 3 };
    static const double WITHIN = 0.25, AT_REST = 0.01, OFF_CENTRE = 0.1, LEAST_FACTOR = 0.9,
                        MOST_FACTOR = 1.5;
    rb_status s = RB_OK;
    double from = NAN, to = NAN;

    /* A round: a cycle, the length that its stick edges ask for, and a mesh of that length, on
     * which the edges lie a little elsewhere. */
    for (int k = 0; k < ROUNDS && s == RB_OK; k++) {
        s = fret_cycle(r, why);
        if (s != RB_OK || !stick_run(r, &from, &to))
            break;
        const double h = r->model.bodies.f.h[0];
        const int odd = r->n % 2;
        const double across = (to - from) / h;
        /* As many elements as stick now, even or odd like the mesh, whose middle is x = 0. */
        int count = 2 * (int)round(0.5 * (across + 2.0 * WITHIN - odd)) + odd;
        if (across < LEAST_FACTOR * (count - 2.0 * WITHIN)) /* the zone has to hold the contact */
            count -= 2;
        const double factor = across / (count - 2.0 * WITHIN);
        if (count < LEAST || fabs(from + to) > OFF_CENTRE * h || factor > MOST_FACTOR ||
            fabs(factor - 1.0) * count < AT_REST)
            break;
        r->rc.zone *= factor;
        rb_rolling_model_free(&r->model);
        s = press_at_rest(r, why);
    }
    if (s != RB_OK)
        return s;
    r->work = 0.0; /* nothing has been worn so far */
    memset(r->path, 0, (size_t)r->n * sizeof *r->path);
    return RB_OK;
}

/* From now on by positions along the stroke: what is worn off so far belongs to A and B by their
 * shares. */
static rb_status begin_positions(wear_state *r, double reach, double half_width, rb_message *why)
{
    if (isfinite(r->rc.b.radius))
        return rb_fail(why, RB_EINVAL,
                       "wear: two cylinders with a stroke of +-%.3g of the half-width: their "
                       "contact moves over both; at most 0.1, or B as a plane",
                       reach / half_width);
    if (reach > LONGEST * half_width)
        return rb_fail(why, RB_EINVAL,
                       "wear: a stroke of +-%.3g half-widths, at most %g; where A slides far "
                       "over B, give --slide, 4 shift a cycle, for --cycles",
                       reach / half_width, LONGEST);
    if (r->was_worn)
        return rb_fail(why, RB_EINVAL,
                       "wear: --worn is of both bodies in one place, and a stroke of +-%.3g of "
                       "the half-width moves them; start from the shapes before",
                       reach / half_width);
    /* From here on pressures are kept at every position; the depths of A and B take over what is
     * worn, each its share. */
    const size_t n = (size_t)r->n;
    rb_status s = rb_rolling_stroke_create(r->n, rb_rolling_couples(&r->rc), reach, half_width,
                                           r->model.bodies.f.h[0], &r->stroke);
    const size_t all = n * (size_t)rb_rolling_wear_positions(r);
    double *p = rb_arena_doubles(&r->memory, all, 3);
    if (s != RB_OK || !p)
        return RB_ENOMEM;
    r->pressed = p;
    r->first = p + all;
    r->now = p + 2 * all;
    for (int i = 0; i < r->n; i++) {
        r->stroke.a[i] = (1.0 - r->wear->share) * r->depth[i];
        r->stroke.b[i + r->stroke.more] = r->wear->share * r->depth[i];
        r->rate[i] = 0.0;
    }
    rb_rolling_stroke_keep(&r->stroke);
    r->stroke.stroke = fmin(r->slid, reach);
    s = rb_rolling_press_worn(r, 0.0, r->pressed, why);
    memcpy(r->pressed, r->now, all * sizeof *r->pressed);
    if (s != RB_OK) /* begins again, on a wider zone */
        rb_rolling_stroke_free(&r->stroke);
    return s;
}

/* The stroke of the last cycle, the mean of its pressure; where all of the contact slides so far
 * that B's wear does not stay below A's, positions begin. */
static rb_status see_stroke(wear_state *r, rb_message *why)
{
    static const double SMALL = 0.1, COUNTS = 1e-3;
    const double *p = r->model.state.p, p0 = rb_norm_inf((size_t)r->n, p);
    const double half_width = 0.5 * (r->history->contact_to[0] - r->history->contact_from[0]);
    double load = 0.0, sum = 0.0;
    int sticks = 0;

    /* Four strokes make a cycle: a quarter of the path, weighted by the pressure. */
    for (int i = 0; i < r->n; i++) {
        load += p[i];
        sum += p[i] * 0.25 * r->path[i];
        sticks += p[i] > COUNTS * p0 && r->path[i] == 0.0;
    }
    r->slid = load > 0.0 ? sum / load : 0.0;
    const double reach = fabs(r->rc.shift);
    if (r->stroke.positions == 0 && !sticks && r->slid > SMALL * half_width && isfinite(reach) &&
        (r->wear->share > 0.0 || isfinite(r->rc.b.radius))) {
        const rb_status s = begin_positions(r, reach, half_width, why);
        if (s != RB_OK)
            return s;
    }
    r->stroke.stroke = fmin(r->slid, r->stroke.reach);
    return RB_OK;
}

/* The depth that a step wears per pressure, of the path there is in its middle: of that under the
 * gap which half a step with the path at its start wears. */
static rb_status set_rate(wear_state *r, double depth, rb_message *why)
{
    rb_status s = fret_cycle(r, why);

    if (s == RB_OK)
        s = see_stroke(r, why);
    if (s != RB_OK)
        return s;
    if (r->stroke.positions > 0) {
        for (int i = 0; i < r->n; i++)
            r->rate[i] = depth * 4.0 * r->stroke.stroke;
        return RB_OK;
    }
    for (int i = 0; i < r->n; i++)
        r->rate[i] = depth * r->path[i];
    /* The midpoint rule: half a step with the path of its start, then the path of that gap for all
     * of the step. */
    s = rb_rolling_press_worn(r, 0.5, r->pressed, why);
    if (s == RB_OK) {
        rb_rolling_wear_off(r, 0.5, r->now);
        s = fret_cycle(r, why);
    }
    memcpy(r->depth, r->start, (size_t)r->n * sizeof *r->depth);
    for (int i = 0; i < r->n; i++)
        r->rate[i] = depth * r->path[i];
    return s;
}

/* The contact under the gap at the end of a step, in the middle of a stroke. */
static rb_status end_step(wear_state *r, rb_message *why)
{
    if (r->stroke.positions > 0)
        rb_rolling_stroke_depth(&r->stroke, 0.0, r->depth);
    const rb_status s = rb_rolling_set_worn_problem(r, &r->model.bodies, 0.0, why);
    return s == RB_OK && r->stroke.positions > 0 ? rb_rolling_model_resolve(&r->model, 1, why) : s;
}

/* One step of wear. If the contact outgrows its zone, the step is undone and repeated on a wider
 * one. */
static rb_status one_step(wear_state *r, double part, rb_message *why)
{
    enum { WIDER = 12 };
    const double share = r->wear->share;
    const double depth = /* per pressure and slid length */
        r->wear->coefficient *
        (r->wear->law == RB_WEAR_ARCHARD ? 1.0 : rb_rolling_largest_mu(&r->rc));
    rb_message reason = {.text = ""};
    rb_status s = RB_ZONE;
    double mean = 0.0;

    if (r->rc.formulation == RB_STEADY)
        return roll_step(r, part, why);
    for (int k = 0; k < WIDER && s == RB_ZONE; k++) {
        reason.text[0] = '\0';
        s = k > 0 ? widen_zone(r, &reason) : RB_OK;
        memcpy(r->start, r->depth, (size_t)r->n * sizeof *r->start);
        if (r->stroke.positions > 0)
            rb_rolling_stroke_keep(&r->stroke);
        if (s == RB_OK && !r->wear->slides)
            s = set_rate(r, depth * part, &reason);
        for (int i = 0; i < r->n && r->wear->slides; i++)
            r->rate[i] = (1.0 - share) * depth * part;
        if (s == RB_OK)
            s = rb_rolling_wear_advance(r, 1.0, 0, &mean, &reason);
        if (s == RB_OK)
            s = end_step(r, &reason);
        if (s != RB_ZONE)
            continue; /* done; else again, on a wider zone */
        memcpy(r->depth, r->start, (size_t)r->n * sizeof *r->depth);
        if (r->stroke.positions > 0)
            rb_rolling_stroke_restore(&r->stroke);
    }
    if (s == RB_OK && r->wear->slides) {
        r->passage = share * depth * rb_rolling_carried_load(r);
        r->track += share * depth * mean * part;
    }
    return s == RB_OK ? s : rb_fail(why, s, "%.300s", rb_status_reason(s, &reason));
}

#define PLACE(member) offsetof(rb_rolling_wear, member)
static const rb_option rows[] = {RB_WEAR_LINES(PLACE, way, way)};

/* The case as it wears: what slides is past its static coefficient. */
static rb_rolling_case worn_case(const rb_rolling_case *rc, const rb_rolling_wear *wear)
{
    rb_rolling_case worn = *rc;

    if (wear->slides && rb_rolling_law_depends_on_slip(&rc->friction))
        worn.friction = (rb_rolling_friction){.law = RB_FRICTION_constant};
    return worn;
}

/* Which laws, motions and bodies wear is computed for, before anything is solved. */
static rb_status check_wear(const rb_rolling_case *rc, const rb_rolling_wear *wear, rb_message *why)
{
    const rb_rolling_case worn = worn_case(rc, wear);

    const int rolls = rc->formulation == RB_STEADY;

    if (rc->formulation == RB_TRANSIENT)
        return rb_refuse(why, "formulation",
                         "wear only by sliding, by fretting cycles (static) or by rolling "
                         "(steady), not in a transient");
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        const void *at = (const char *)wear + rows[k].offset;
        const double value =
            rows[k].kind == RB_OPTION_INTEGER ? *(const int *)at : *(const double *)at;
        const char *elsewhere = wear->slides ? "cycles" : "slide";
        const int frets = !rolls && !wear->slides,
                  counts = strcmp(rows[k].name, elsewhere) != 0 &&
                           (frets || strcmp(rows[k].name, "quarter") != 0);
        const rb_status s = counts ? rb_rolling_check_option(&rows[k], value, why) : RB_OK;
        if (s != RB_OK)
            return s;
    }
    if (rb_rolling_largest_mu(rc) == 0.0 && (wear->law == RB_WEAR_DISSIPATION || !wear->slides))
        return rb_refuse(why, "mu,friction-law",
                         "at mu = 0 friction dissipates nothing, and nothing wears");
    if (rc->friction.law != RB_FRICTION_constant && !rolls && wear->law == RB_WEAR_DISSIPATION)
        return rb_refuse(
            why, "friction-law",
            "the law of dissipation takes one coefficient of friction, not a friction law");
    if (!rolls && rc->mesh != RB_MESH_UNIFORM)
        return rb_refuse(why, "mesh", "the worn gap needs equal elements (--mesh uniform)");
    if (rb_rolling_has_ellipse(rc))
        return rb_refuse(why, "wheel-load", "the strip wears apart from its ellipse; give --load");
    if (!rolls && rb_rolling_is_strained(rc))
        return rb_refuse(why, rc->bulk_stress != 0.0 ? "bulk-stress" : "bulk-stress-b",
                         "wear takes bulk stress in steady rolling only, got one with %s",
                         wear->slides ? "--slide" : "fretting cycles");
    /* under a given approach the shift is a tenth of it */
    if (!rolls && !wear->slides && isnan(rc->shift) && !rb_rolling_force_is_given(rc) &&
        isnan(rc->approach) && rb_rolling_pressing_is_given(rc))
        return rb_fail(why, RB_EINVAL,
                       "wear: --cycles at rest needs --shift, --force or --force-ratio, between "
                       "which and its opposite A moves");
    if (rolls && wear->slides)
        return rb_fail(why, RB_EINVAL,
                       "wear: --slide needs --formulation static; for a rolling wheel give "
                       "--cycles N (turns)");
    if (rolls && !rb_rolling_body_can(&rc->a, RB_BODY_HOMOGENEOUS))
        return rb_refuse(why, "layer-thickness,layers,cover-thickness,relaxation-time",
                         "wear of a rolling wheel of one elastic material only, got a layer, a "
                         "cover or relaxation");
    if (rc->yield_stress > 0.0)
        return rb_refuse(why, "yield-stress",
                         "no wear, because a third body separates the surfaces");
    return rb_rolling_case_check(&worn, why);
}

rb_status rb_rolling_wear_run(const rb_rolling_case *rc, const rb_rolling_wear *wear,
                              const rb_rolling_wear_observer *observer,
                              rb_rolling_wear_history *history, rb_rolling_solution *last,
                              rb_message *why)
{
    wear_state r = {.wear = wear,
                    .rc = worn_case(rc, wear),
                    .history = history,
                    .last = last,
                    .observer = observer};
    const double part = wear->way / wear->steps;

    memset(history, 0, sizeof *history);
    memset(last, 0, sizeof *last);
    /* The load stays, whatever the worn profile does to the half-width and the approach. */
    r.rc.load = rb_rolling_derive(rc).load; /* a given half-width means this load */
    rb_rolling_press_by_load(&r.rc);
    r.rc.increments = 1; /* the cycles have their own */
    r.was_worn = rc->worn.n > 0;
    rb_status s = check_wear(rc, wear, why);
    if (s == RB_OK)
        s = rb_rolling_columns_alloc(&rb_rolling_wear_columns, rc, 0, wear->steps + 1, history);
    /* Columns that this kind of wear has not: NULL, so that no table shows them. */
    if (s == RB_OK) {
        if (wear->slides || rc->formulation == RB_STEADY) {
            free(history->stroke);
            history->stroke = NULL;
        }
        if (wear->share == 0.0) {
            free(history->worn_b);
            free(history->max_depth_b);
            history->worn_b = history->max_depth_b = NULL;
        }
        if (wear->share == 0.0 || !rc->elastic_b || !isfinite(rc->b.radius)) {
            free(history->radius_b);
            history->radius_b = NULL;
        }
    }
    history->radius_before = rc->a.radius;
    history->radius_b_before = rc->b.radius;
    history->slides = wear->slides;
    history->rolls = rc->formulation == RB_STEADY;
    if (s == RB_OK)
        s = rc->formulation == RB_STEADY ? rb_rolling_model_create(rc, &r.model, why)
                                         : press_at_rest(&r, why);
    /* Fretting: elements about the stick zone; then the worn gap and the first pressure. */
    if (s == RB_OK && rc->formulation != RB_STEADY && !wear->slides && rc->zone == 0.0)
        s = align_with_stick(&r, why);
    if (s == RB_OK && rc->formulation != RB_STEADY) {
        r.rc.worn = rb_rolling_worn_so_far(&r);
        s = rb_rolling_set_worn_problem(&r, &r.model.bodies, 0.0, why);
    }
    if (s == RB_OK && rc->formulation != RB_STEADY)
        memcpy(r.pressed, r.model.state.p, (size_t)r.n * sizeof *r.pressed);
    if (s == RB_OK)
        s = record_step(&r, 0.0, why);
    /* Equal steps; the last row is exactly at the end. */
    for (int k = 1; k <= wear->steps && s == RB_OK; k++) {
        s = one_step(&r, part, why);
        if (s == RB_OK)
            s = record_step(&r, k == wear->steps ? wear->way : k * part, why);
        else if (s == RB_INTERRUPTED)
            rb_fail(why, s, "interrupted after step %d of %d", k - 1, wear->steps);
    }
    run_free(&r);
    return s;
}
