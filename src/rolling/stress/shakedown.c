/* Shakedown of a body under repeated rolling (theory-bodies.md S1), from the elastic stress
 * below the contact. */
#include "rolling/body/body.h"
#include "rolling/stress/field.h"

#include <float.h>
#include <math.h>

enum { ACROSS = 161, DEPTHS = 40, HALVINGS = 40 };
static const double golden = 0.6180339887498949; /* (sqrt(5) - 1)/2 */

/* Places of one depth, from a half-width before the contact to one behind it; on the surface also
 * the nodes of the tractions, because the stress has corners and infinite slopes there, at edges
 * and at the ends of stick. */
typedef struct {
    const rb_rolling_field *field;
    rb_bem_plane plane;
    double bulk[2]; /* the stress far away: along x, and along the axis */
    double from, to;
    int n;      /* of this depth */
    double *xy; /* room for all, in memory */
    rb_rolling_stress *at;
} row;

/* The shear at a place with the residual stress 2 c along x: the radius of Mohr's circle in
 * the plane.  A thin disc has no stress along its axis, and none is left there. */
static double shear_with(const rb_rolling_stress *s, double c, rb_bem_plane plane)
{
    const double radius = hypot(0.5 * (s->sxx - s->syy) + c, s->sxy),
                 mean = 0.5 * (s->sxx + s->syy) + c;
    return plane == RB_PLANE_STRESS ? fmax(radius, 0.5 * (fabs(mean) + radius)) : radius;
}

/* What Tresca's body needs at this depth with it, and the place that decides.  Along the axis
 * a residual stress of any size may be left too, but the same at all places of the depth: it
 * has to keep the stress there less than 2 k below the largest principal stress of one place
 * and less than 2 k above the smallest of another. */
static double needed_with(const row *r, double c, double *x)
{
    /* far away the load has no stress, but the bulk of the body may have */
    const double far = 0.5 * r->bulk[0] + c;
    double most = fabs(far), above = far + fabs(far) - r->bulk[1],
           below = far - fabs(far) - r->bulk[1];
    /* The residual stress that makes the largest least leaves two places equal, or the two
     * conditions: of what only rounding tells apart the first counts. */
    const double beyond = 1.0 + 1e-9;
    double at = most, at_above = above, at_below = below;
    double x_above = r->from, x_below = r->from;

    *x = r->from;
    for (int i = 0; i < r->n; i++) {
        const rb_rolling_stress *s = &r->at[i];
        const double shear = shear_with(s, c, r->plane), radius = shear_with(s, c, RB_PLANE_STRAIN),
                     mean = 0.5 * (s->sxx + s->syy) + c;
        most = fmax(most, shear);
        above = fmax(above, mean + radius - s->szz);
        below = fmin(below, mean - radius - s->szz);
        if (shear > at * beyond) {
            at = shear;
            *x = s->x;
        }
        if (mean + radius - s->szz > at_above * beyond) {
            at_above = mean + radius - s->szz;
            x_above = s->x;
        }
        if (mean - radius - s->szz < at_below * beyond) {
            at_below = mean - radius - s->szz;
            x_below = s->x;
        }
    }
    const double along = r->plane == RB_PLANE_STRESS ? 0.0 : 0.25 * (above - below);
    if (along <= most * beyond)
        return fmax(most, along);
    /* of the two places the one with the larger part */
    *x = above >= -below / beyond ? x_above : x_below;
    return along;
}

static rb_status look_at(row *r, double y)
{
    const rb_bem_edge_load *load = rb_rolling_field_load(r->field);
    r->n = 0;
    for (int i = 0; i < ACROSS; i++)
        r->xy[2 * r->n++] = r->from + (r->to - r->from) * i / (ACROSS - 1);
    for (int i = 0; i < load->n && y == 0.0; i++)
        r->xy[2 * r->n++] = load->x[i];
    for (int i = 0; i < r->n; i++)
        r->xy[2 * i + 1] = y;
    return rb_rolling_field_at(r->field, r->n, r->xy, r->at, NULL);
}

/* The yield stress in shear that the depth y needs, with the residual stress that makes
 * it least: golden section of a convex function. */
static rb_status needed_at(row *r, double y, rb_rolling_shakedown *k)
{
    double largest = 0.0;
    const rb_status s = look_at(r, y);
    if (s != RB_OK)
        return s;
    for (int i = 0; i < r->n; i++)
        largest = fmax(largest, fabs(r->at[i].sxx) + fabs(r->at[i].syy));
    double low = -largest, high = largest;
    for (int i = 0; i < 2 * HALVINGS; i++) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        if (needed_with(r, a, &k->x) <= needed_with(r, b, &k->x))
            high = b;
        else
            low = a;
    }
    k->y = y;
    k->residual = low + high;
    k->shear_yield = needed_with(r, 0.5 * k->residual, &k->x);
    return RB_OK;
}

/* The row of a model; its field is the caller's. */
static rb_status row_of(const rb_rolling_model *model, rb_arena *scratch, rb_rolling_field **field,
                        row **r, rb_message *why)
{
    double from, to;

    *field = NULL;
    rb_rolling_loaded_between(model, &from, &to);
    rb_status s = rb_rolling_stress_check(model->rc, why);
    if (s != RB_OK)
        return s;
    if (!rb_rolling_body_can(&model->rc->a, RB_BODY_FLAT))
        return rb_fail(why, RB_EINVAL,
                       "shakedown: of a half-plane, whose every place sees the same");
    if (model->rc->a.layer > 0.0)
        return rb_fail(why, RB_EINVAL,
                       "shakedown: of one material; a layer and its base yield differently");
    int jump = 0;
    if (!isnan(rb_rolling_next_friction_jump(model, &jump)))
        return rb_fail(why, RB_EINVAL,
                       "shakedown: the friction jumps, and no body keeps elastic where it does");
    if (!(from < to))
        return rb_fail(why, RB_NO_CONTACT, "no contact, no stress");
    s = rb_rolling_field_create(model, field, why);
    if (s != RB_OK)
        return s;
    const double a = 0.5 * (to - from);
    const int nodes = rb_rolling_field_load(*field)->n;
    *r = rb_arena_zeros(scratch, 1, sizeof **r);
    double *xy = rb_arena_doubles(scratch, (size_t)nodes + ACROSS, 2);
    rb_rolling_stress *at = rb_arena_zeros(scratch, (size_t)nodes + ACROSS, sizeof *at);
    if (scratch->failed)
        return RB_ENOMEM;
    (*r)->xy = xy;
    (*r)->at = at;
    (*r)->field = *field;
    (*r)->plane = model->rc->plane;
    (*r)->bulk[0] = model->rc->bulk_stress;
    (*r)->bulk[1] =
        (*r)->plane == RB_PLANE_STRESS ? 0.0 : model->rc->a.poisson * model->rc->bulk_stress;
    (*r)->from = from - a;
    (*r)->to = to + a;
    return RB_OK;
}

rb_status rb_rolling_shakedown_find(const rb_rolling_model *model, rb_rolling_shakedown *shakedown,
                                    rb_message *why)
{
    rb_arena scratch = {0};
    rb_rolling_field *field;
    row *r = NULL;

    *shakedown = (rb_rolling_shakedown){0};
    rb_status s = row_of(model, &scratch, &field, &r, why);
    const double step = s == RB_OK ? 0.25 * (r->to - r->from) * 2.0 / DEPTHS : 0.0;
    for (int k = 0; k <= DEPTHS && s == RB_OK; k++) {
        rb_rolling_shakedown here;
        s = needed_at(r, k * step, &here);
        if (s == RB_OK && here.shear_yield > shakedown->shear_yield)
            *shakedown = here;
    }
    /* Between the depths beside the best one, again by golden section. */
    double low = fmax(0.0, shakedown->y - step), high = shakedown->y + step;
    for (int k = 0; k < HALVINGS / 2 && s == RB_OK; k++) {
        rb_rolling_shakedown upper, lower;
        s = needed_at(r, high - golden * (high - low), &upper);
        if (s == RB_OK)
            s = needed_at(r, low + golden * (high - low), &lower);
        if (s != RB_OK)
            break;
        const int goes_up = upper.shear_yield >= lower.shear_yield;
        const rb_rolling_shakedown *here = goes_up ? &upper : &lower;
        *(goes_up ? &high : &low) = goes_up ? lower.y : upper.y;
        /* what rounding adds is no gain: near a flat best place it would decide the
         * place */
        if (here->shear_yield > (1.0 + 8.0 * DBL_EPSILON) * shakedown->shear_yield)
            *shakedown = *here;
    }
    rb_rolling_field_free(field);
    rb_arena_free(&scratch);
    return s == RB_ENOMEM ? rb_fail(why, s, "out of memory for the shakedown limit") : s;
}

rb_status rb_rolling_shakedown_at(const rb_rolling_model *model, rb_rolling_shakedown *shakedown,
                                  rb_message *why)
{
    rb_arena scratch = {0};
    rb_rolling_field *field;
    row *r = NULL;
    rb_status s = row_of(model, &scratch, &field, &r, why);

    if (s == RB_OK && !(shakedown->y >= 0.0))
        s = rb_fail(why, RB_EINVAL, "shakedown: y = %g lies outside the body", shakedown->y);
    if (s == RB_OK)
        s = look_at(r, shakedown->y);
    if (s == RB_OK) {
        const double c = 0.5 * shakedown->residual;
        double x = shakedown->x;
        shakedown->shear_yield = needed_with(r, c, &x);
        /* the residual stress that makes the largest least lets several places decide */
        for (int i = 0; i < r->n; i++)
            if (fabs(r->at[i].x - shakedown->x) <= 1e-9 * (r->to - r->from) &&
                shear_with(&r->at[i], c, r->plane) >= shakedown->shear_yield * (1.0 - 1e-9))
                x = shakedown->x;
        shakedown->x = x;
    }
    rb_rolling_field_free(field);
    rb_arena_free(&scratch);
    return s;
}
