/* Shakedown of a body under repeated rolling (theory.md S1), from the elastic stress
 * below the contact. */
#include "rolling/solve/results.h"

#include <float.h>

enum { ACROSS = 161, DEPTHS = 40, HALVINGS = 40 };
static const double golden = 0.6180339887498949; /* (sqrt(5) - 1)/2 */

/* Places of one depth, from a half-width before the contact to one behind it. */
typedef struct {
    const rb_rolling_model *model;
    double from, to;
    double xy[2 * ACROSS];
    rb_rolling_stress at[ACROSS];
} row;

/* Tresca's shear with the residual stress 2 c: the radius of Mohr's circle in the plane.
 * Across it a thin disc has no stress, where in plane strain a residual one keeps the
 * third principal stress between the other two. */
static double shear_with(const rb_rolling_stress *s, double c, rb_bem_plane plane)
{
    const double radius = hypot(0.5 * (s->sxx - s->syy) + c, s->sxy),
                 mean = 0.5 * (s->sxx + s->syy) + c;
    return plane == RB_PLANE_STRESS ? fmax(radius, 0.5 * (fabs(mean) + radius)) : radius;
}

/* What Tresca's body needs with it: the largest of them. */
static double needed_with(const row *r, double c, double *x)
{
    double most = 0.0;
    for (int i = 0; i < ACROSS; i++) {
        const double shear = shear_with(&r->at[i], c, r->model->rc->plane);
        if (shear > most) {
            most = shear;
            *x = r->at[i].x;
        }
    }
    return most;
}

/* The yield stress in shear that the depth y needs, with the residual stress that makes
 * it least: golden section of a convex function. */
static rb_status needed_at(row *r, double y, rb_rolling_shakedown *k)
{
    double largest = 0.0;
    for (int i = 0; i < ACROSS; i++) {
        r->xy[2 * i] = r->from + (r->to - r->from) * i / (ACROSS - 1);
        r->xy[2 * i + 1] = y;
    }
    const rb_status s = rb_rolling_stress_at(r->model, ACROSS, r->xy, r->at, NULL);
    if (s != RB_OK)
        return s;
    for (int i = 0; i < ACROSS; i++)
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

rb_status rb_rolling_shakedown_find(const rb_rolling_model *model, rb_rolling_shakedown *shakedown,
                                    rb_message *why)
{
    rb_arena scratch = {0};
    double from, to;

    *shakedown = (rb_rolling_shakedown){0};
    rb_rolling_contact_edges(model->rc, &model->mesh, &model->state, &from, &to);
    rb_status s = rb_rolling_stress_check(model->rc, why);
    if (s != RB_OK)
        return s;
    if (!rb_rolling_body_can(&model->rc->a, RB_BODY_FLAT))
        return rb_fail(why, RB_EINVAL,
                       "shakedown: of a half-plane, whose every place sees the same");
    if (model->rc->a.layer > 0.0)
        return rb_fail(why, RB_EINVAL,
                       "shakedown: of one material; a layer and its base yield differently");
    if (!(from < to))
        return rb_fail(why, RB_NO_CONTACT, "no contact, no stress");
    const double a = 0.5 * (to - from), step = 2.0 * a / DEPTHS;
    row *r = rb_arena_zeros(&scratch, 1, sizeof *r);
    if (r)
        *r = (row){.model = model, .from = from - a, .to = to + a};
    s = r ? RB_OK : RB_ENOMEM;
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
    rb_arena_free(&scratch);
    return s == RB_ENOMEM ? rb_fail(why, s, "out of memory for the shakedown limit") : s;
}

rb_status rb_rolling_shakedown_at(const rb_rolling_model *model, rb_rolling_shakedown *shakedown,
                                  rb_message *why)
{
    const double xy[] = {shakedown->x, shakedown->y};
    rb_rolling_stress at;
    const rb_status s = rb_rolling_stress_at(model, 1, xy, &at, why);
    if (s == RB_OK)
        shakedown->shear_yield = shear_with(&at, 0.5 * shakedown->residual, model->rc->plane);
    return s;
}
