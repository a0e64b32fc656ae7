/* The power dissipated by friction and by viscoelastic bodies. */
#include "rolling/body/internal.h"
#include "rolling/case/derived.h"
#include "rolling/solve/model.h"
#include "rolling/solve/power.h"
#include "rolling/solve/solution.h"

#include <cblas.h>
#include <math.h>

/* 0: no element with friction slips.  What opens between an element in contact and an
 * open one is then no slip, although their mean friction is not 0. */
static int slides(int n, const double *lambda, const double *traction)
{
    for (int i = 0; i < n; i++)
        if (lambda[i] != 0.0 && traction[i] != 0.0)
            return 1;
    return 0;
}

void rb_rolling_friction_power(const rb_rolling_solution *s, double *power)
{
    const int none = s->formulation != RB_STATIC && s->n > 0 && !slides(s->n, s->shift, s->q);

    for (int i = 0; i < s->n; i++) {
        const double before = i > 0 ? s->shift[i - 1] : 0.0;
        if (none)
            power[i] = 0.0;
        else if (s->formulation == RB_STEADY && s->slip_operator == RB_SLIP_UPSTREAM)
            power[i] = -0.5 * (s->shift[i] + before) * s->q[i] / s->h[i];
        else
            power[i] = s->formulation == RB_STATIC ? NAN : -s->slip[i] * s->q[i];
    }
}

/* Slip i times a traction, per rolled way.  The upstream difference of steady rolling is
 * the slip between two midpoints, so it is paired with the mean of their tractions
 * (theory-solvers.md 6); otherwise slip and traction belong to the same point. */
static double slip_times(const rb_rolling_case *rc, int n, const double *lambda,
                         const double *traction, const double *h, const double *e_T, int i)
{
    const double next = i + 1 < n ? traction[i + 1] : 0.0;
    return rc->formulation == RB_STEADY && rc->slip_operator == RB_SLIP_UPSTREAM
               ? lambda[i] * 0.5 * (traction[i] + next)
               : lambda[i] / e_T[i] * traction[i] * h[i];
}

static double paired_power(const rb_rolling_case *rc, int n, const double *lambda, const double *q,
                           const double *h, const double *e_T)
{
    double power = 0.0;

    for (int i = 0; i < n; i++)
        power -= slip_times(rc, n, lambda, q, h, e_T, i);
    return power;
}

double rb_rolling_dissipated_power(const rb_rolling_case *rc, int n, const double *lambda,
                                   const double *q, const double *h, const double *e_T)
{
    if (rc->formulation == RB_STATIC)
        return NAN;
    return slides(n, lambda, q) ? paired_power(rc, n, lambda, q, h, e_T) : 0.0;
}

double rb_rolling_slid_pressure(const rb_rolling_case *rc, int n, const double *lambda,
                                const double *p, const double *h, const double *e_T)
{
    double sum = 0.0;

    for (int i = 0; i < n && slides(n, lambda, p); i++)
        sum += fabs(slip_times(rc, n, lambda, p, h, e_T, i));
    return sum;
}

/* -int p w_N' dx by differences over the neighbours' unequal distances, exact for a
 * parabola, which the surface in contact is. */
static double normal_work(int n, const double *x, const double *w, const double *p, const double *h)
{
    double work = 0.0;
    for (int i = 1; i < n; i++) {
        const double left = x[i] - x[i - 1], right = x[i + 1] - x[i];
        const double before = (w[i] - w[i - 1]) / left, after = (w[i + 1] - w[i]) / right;
        work -= p[i] * h[i] * (right * before + left * after) / (left + right);
    }
    return work;
}

/* Equilibrium about the axles: pressure p at x and friction q at the distance R. */
void rb_rolling_torques(const rb_rolling_case *rc, double moment, double force, double *torque_a,
                        double *torque_b)
{
    *torque_a = isfinite(rc->a.radius) ? moment + force * rc->a.radius : NAN;
    /* a bore turns about the other side, the way A does */
    *torque_b = isfinite(rc->b.radius)
                    ? copysign(1.0, rc->b.radius) * (moment - force * rc->b.radius)
                    : NAN;
}

/* -int (p w_N' + q w_T') dx of the bodies together (V4).  The surface's own part of the slip is
 * paired with friction as all of it is.  w: 2 (n + 1), r: n, both scratch. */
static rb_status work_of_surfaces(const rb_rolling_model *model, double *w, double *r,
                                  double *power)
{
    const rb_contact_problem *p = &model->problem;
    const rb_contact_state *state = &model->state;
    const rb_bem_flexibility *f = &model->bodies.f;
    const rb_status s = rb_rolling_displacement(&model->bodies, state->p, state->q, w);

    for (int i = 0; i < p->n; i++)
        r[i] = state->lambda[i] - state->xi * p->e_T[i];
    *power = s != RB_OK ? NAN
                        : normal_work(p->n, f->x, w, state->p, f->h) -
                              paired_power(model->rc, p->n, r, state->q, f->h, p->e_T);
    return s;
}

rb_status rb_rolling_lever_power(const rb_rolling_model *model, double hysteresis, double *power)
{
    const int n = model->problem.n;

    *power = model->rc->formulation == RB_STEADY ? 0.0 : NAN;
    if (model->rc->formulation != RB_STEADY || rb_rolling_can(model->rc, RB_BODY_FLAT))
        return RB_OK;
    rb_arena scratch = {0};
    double *w = rb_arena_doubles(&scratch, 2 * ((size_t)n + 1), 1),
           *r = rb_arena_doubles(&scratch, (size_t)n, 1), work;
    rb_status s = scratch.failed ? RB_ENOMEM : work_of_surfaces(model, w, r, &work);

    if (s == RB_OK)
        *power = hysteresis - work;
    /* where p and q turn along the contact, Q and M are not what the creepage and the load
     * work on */
    if (s == RB_OK && model->rc->normals == RB_BEM_NORMALS_SURFACE) {
        const double radius = rb_rolling_radius(model->rc), xi = model->state.xi;
        const rb_bem_flexibility *f = &model->bodies.f;
        *power += xi * rb_rolling_model_force(model) -
                  rb_contact_moment(&model->problem, &model->state) / radius;
        for (int i = 0; i < n; i++)
            *power += f->h[i] * (f->x[i] / radius * model->state.p[i] - xi * model->state.q[i]);
    }
    return rb_arena_done(&scratch, s);
}

rb_status rb_rolling_hysteresis(const rb_rolling_model *model, double *power)
{
    const rb_contact_problem *p = &model->problem;
    const rb_contact_state *state = &model->state;
    const rb_bem_flexibility *f = &model->bodies.f;
    const rb_rolling_body *const body[] = {&model->rc->a, &model->rc->b};
    const int n = p->n, rows = 2 * (n + 1), flat = rb_rolling_can(model->rc, RB_BODY_FLAT);

    *power = model->rc->formulation == RB_STEADY ? 0.0 : NAN;
    if (model->rc->formulation != RB_STEADY || !rb_rolling_relaxes(model->rc))
        return RB_OK;
    rb_arena scratch = {0};
    double *w = rb_arena_doubles(&scratch, (size_t)rows, 1),
           *r = rb_arena_doubles(&scratch, 2 * (size_t)n, 1),
           *along = rb_arena_doubles(&scratch, (size_t)n + 1, 1);
    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    if (flat) {
        const rb_status s = work_of_surfaces(model, w, r, power);
        if (s != RB_OK)
            return rb_arena_done(&scratch, s);
    }
    /* With wheels: of each body by itself what memory adds, because the elastic part, which
     * costs nothing, would leave the error of the mesh. */
    for (int b = 0; b < 2 && !flat; b++) {
        if (!model->bodies.memory[b])
            continue;
        const int round = !(rb_rolling_kind_of(body[b])->can & RB_BODY_FLAT),
                  turns = round && model->rc->normals == RB_BEM_NORMALS_OBSTACLE;
        const double radius = fabs(body[b]->radius);
        for (int i = 0; i <= n; i++) /* the material runs along its arc */
            along[i] = round ? radius * asin(f->x[i] / radius) : f->x[i];
        for (int i = 0; i < n; i++) {
            r[i] = state->p[i];
            r[n + i] = b ? -state->q[i] : state->q[i]; /* B's own frame */
        }
        cblas_dgemv(CblasColMajor, CblasNoTrans, rows, 2 * n, 1.0, model->bodies.memory[b], rows, r,
                    1, 0.0, w, 1);
        /* -int t Dw ds for the displacement w that the memory adds under p, q.  D w
         * follows the material: on a wheel the frame of the surface turns with it, so that
         * D (w_N, w_T) = (w_N' - w_T/R, w_T' + w_N/R); not on a half-plane, and not where
         * w is in that frame already. */
        const double *q = r + n, *w_N = w, *w_T = w + n + 1;
        double turned = 0.0;
        for (int i = 0; i < n; i++)
            turned += (r[i] * w_T[i] - q[i] * w_N[i]) * f->h[i];
        *power += normal_work(n, along, w_N, r, f->h) + normal_work(n, along, w_T, q, f->h) +
                  (turns ? turned / body[b]->radius : 0.0);
    }
    return rb_arena_done(&scratch, RB_OK);
}
