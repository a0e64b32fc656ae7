/* A layer between the surfaces that yields (theory-rolling.md, Y1): beside Coulomb's bound mu p
 * the friction has a second one, which follows what the layer has yielded.  With every
 * element's law known the problem is linear, as in newton.c: solved by GMRES where there
 * are products, else by a matrix that is assembled again in each step, because the rows
 * of elements that yield hold those of all upstream. */
#include "lcp/contact/gmres.h"

#include <cblas.h>
#include <lapacke.h>
#include <stdint.h>
#include <string.h>

/* Rounds of all elements at once, and of one element at a time. */
enum { ROUNDS = 60, SINGLE_ROUNDS = 100 };
/* Of the way down to the yield stress from that which nothing reaches. */
static const double LEAST_STEP = 1e-3;

/* Which equation an element has; friction has the sign `sign` but in stick.
 * SLIP_AND_YIELD: both bounds are reached, so that the layer hardens as mu p grows.
 * SOFTENED: nothing is left of the yield stress. */
typedef enum { SEPARATED, STICK, SLIP, YIELD, SLIP_AND_YIELD, SOFTENED } law;

/* Tractions, and the gaps and slips that they and the motion of the bodies make; n each,
 * one after the other. */
typedef struct {
    double *p, *q, *gap, *lambda;
} motion;

typedef struct {
    const rb_contact_problem *p;
    law *law, *next;                 /* n: as they are, and corrected */
    double *sign, *next_sign;        /* n */
    int *at_p, *at_q;                /* n: number of the unknown, or -1 */
    int inner, size;                 /* unknowns: pressures and frictions; delta, xi */
    double *gap, *yielded, *control; /* n, n, 2n: the row of the given force */
    motion scratch;
    rb_contact_operator *by; /* whose products solve; NULL: the matrices; borrowed */
    rb_arena memory;         /* of the arrays */
} laws;

/* Free k->memory in any case. n: elements; the motion has four arrays of n in one block. */
static rb_status laws_alloc(const rb_contact_problem *p, laws *k)
{
    const size_t n = (size_t)p->n;

    *k = (laws){.p = p};
    k->law = rb_arena_zeros(&k->memory, n, sizeof *k->law);
    k->next = rb_arena_zeros(&k->memory, n, sizeof *k->next);
    k->sign = rb_arena_doubles(&k->memory, n, 1);
    k->next_sign = rb_arena_doubles(&k->memory, n, 1);
    k->at_p = rb_arena_ints(&k->memory, n);
    k->at_q = rb_arena_ints(&k->memory, n);
    k->gap = rb_arena_doubles(&k->memory, n, 1);
    k->yielded = rb_arena_doubles(&k->memory, n, 1);
    k->control = rb_arena_doubles(&k->memory, n, 2);
    k->scratch.p = rb_arena_doubles(&k->memory, n, 4);
    if (k->memory.failed)
        return RB_ENOMEM;
    k->scratch.q = k->scratch.p + n;
    k->scratch.gap = k->scratch.q + n;
    k->scratch.lambda = k->scratch.gap + n;
    if (p->force_given)
        rb_contact_force_row(p, k->control, k->control + n);
    return RB_OK;
}

/* ---- Laws and states --------------------------------------------------------------- */

/* The sign of friction against a slip (K3). */
static double against(double slip)
{
    return slip > 0.0 ? -1.0 : 1.0;
}

static void zones_of_laws(const laws *k, rb_contact_state *state)
{
    for (int i = 0; i < k->p->n; i++) {
        const int backwards = k->sign[i] < 0.0;
        state->zone[i] = k->law[i] == SEPARATED ? RB_ZONE_SEPARATED
                         : k->law[i] == STICK   ? RB_ZONE_STICK
                         : k->law[i] == SLIP || k->law[i] == SLIP_AND_YIELD
                             ? (backwards ? RB_ZONE_SLIP_NEGATIVE : RB_ZONE_SLIP_POSITIVE)
                             : (backwards ? RB_ZONE_YIELD_NEGATIVE : RB_ZONE_YIELD_POSITIVE);
    }
}

/* ---- The linear problem of the laws ------------------------------------------------ */

/* Friction of element i per unit of its pressure. */
static double friction_of(const laws *k, int i)
{
    const int slides = k->law[i] == SLIP || k->law[i] == SLIP_AND_YIELD;
    return slides ? k->sign[i] * k->p->bound[i] : 0.0;
}

/* What the equations of contacts, sticks and yielding elements lack, scaled, for these
 * tractions and motions; constants: 0 leaves out what no unknown moves. */
static void inner_rows(const laws *k, const motion *m, int constants, double *y)
{
    const rb_contact_problem *p = k->p;
    const double friction = rb_contact_friction_scale(p);
    /* From upstream (+x) to downstream: u_i takes over from the two elements before it (Y1). */
    double next = 0.0, second = 0.0;

    for (int i = p->n - 1; i >= 0; i--) {
        const double yield = constants ? p->yield[i] : 0.0;
        double u = p->recall[0] * next + p->recall[1] * second;
        if (k->law[i] == YIELD || k->law[i] == SOFTENED)
            u -= p->own * k->sign[i] * m->lambda[i];
        else if (k->law[i] == SLIP_AND_YIELD)
            u = (p->bound[i] * m->p[i] - yield) / p->hardening;
        if (k->at_p[i] >= 0)
            y[k->at_p[i]] = m->gap[i] / p->gap_length;
        if (k->law[i] == STICK)
            y[k->at_q[i]] = m->lambda[i] / p->slip_length;
        else if (k->law[i] == YIELD)
            y[k->at_q[i]] = (k->sign[i] * m->q[i] - yield - p->hardening * u) / friction;
        second = next;
        next = u;
    }
}

/* (K6): P over the given load less 1, Q less its given value over the largest force. */
static void control_rows(const laws *k, const motion *m, int constants, double *y)
{
    const rb_contact_problem *p = k->p;
    const double *control_T = k->control + p->n;

    if (p->load_given)
        *y++ = (cblas_ddot(p->n, p->load_N, 1, m->p, 1) + cblas_ddot(p->n, p->load_T, 1, m->q, 1)) /
                   p->load -
               constants;
    if (p->force_given)
        *y = (cblas_ddot(p->n, k->control, 1, m->p, 1) + cblas_ddot(p->n, control_T, 1, m->q, 1) -
              constants * p->force) /
             rb_contact_force_scale(p);
}

/* Tractions of the unknowns x, for which the motion has memory; no motion. */
static void set_tractions(const laws *k, const double *x, motion *m)
{
    const rb_contact_problem *p = k->p;

    for (int i = 0; i < p->n; i++) {
        m->p[i] = k->at_p[i] >= 0 ? p->stress * x[k->at_p[i]] : 0.0;
        m->q[i] = k->at_q[i] >= 0 ? p->stress * x[k->at_q[i]] : friction_of(k, i) * m->p[i];
        m->gap[i] = m->lambda[i] = 0.0;
    }
}

/* delta opens no gap, xi makes slip: adds both, in their scales. */
static void add_borders(const laws *k, const double *border, motion *m)
{
    const rb_contact_problem *p = k->p;
    const double delta = p->load_given ? border[0] * p->gap_length : 0.0;
    const double xi = p->force_given ? border[p->load_given] * p->slip_length / p->e_T[0] : 0.0;

    for (int i = 0; i < p->n; i++) {
        m->gap[i] -= delta;
        m->lambda[i] += xi * p->e_T[i];
    }
}

/* y = A x of the linear problem, by products; the bodies' displacements and the borders, without
 * constants. */
static void multiply(const void *of_laws, const double *x, double *y)
{
    const laws *k = of_laws;
    motion m = k->scratch;

    set_tractions(k, x, &m);
    rb_contact_operator_add(k->by, m.p, m.q, m.gap, m.lambda);
    add_borders(k, x + k->inner, &m);
    inner_rows(k, &m, 0, y);
    control_rows(k, &m, 0, y + k->inner);
}

/* The control rows alone: what the tractions of x carry. */
static void border_rows(const void *of_laws, const double *x, double *y)
{
    const laws *k = of_laws;
    motion m = k->scratch;

    set_tractions(k, x, &m);
    control_rows(k, &m, 0, y);
}

/* Column delta or xi: the rows of the elements for a unit of it. */
static void border_column(const void *of_laws, int column, double *y)
{
    const laws *k = of_laws;
    const size_t bytes = (size_t)k->p->n * sizeof(double);
    double border[2] = {0.0, 0.0};
    motion m = k->scratch;

    border[column] = 1.0;
    memset(m.p, 0, 4 * bytes);
    add_borders(k, border, &m);
    inner_rows(k, &m, 0, y);
}

/* The unknowns one group after another, as if it were alone; elements that yield have
 * their own friction as the equation, and hardening moves it. */
static void precondition(const void *of_laws, const double *b, double *x)
{
    const laws *k = of_laws;
    const rb_contact_problem *p = k->p;
    const rb_contact_kind *kind = k->by->kind;
    const double friction = rb_contact_friction_scale(p);
    double *line = k->scratch.p;
    const size_t bytes = (size_t)p->n * sizeof *line;

    /* Pressures by an inverse of F_NN, then what sticks by one of A F_TT, then what yields. */
    memset(line, 0, bytes);
    for (int i = 0; i < p->n; i++)
        if (k->at_p[i] >= 0)
            line[i] = b[k->at_p[i]] * p->gap_length / p->stress;
    kind->precondition(k->by, RB_INVERSE_NORMAL, 0.0, line);
    for (int i = 0; i < p->n; i++)
        if (k->at_p[i] >= 0)
            x[k->at_p[i]] = line[i];
    for (int yields = 0; yields < 2; yields++) {
        const law of = yields ? YIELD : STICK;
        int count = 0;
        memset(line, 0, bytes);
        for (int i = 0; i < p->n; i++)
            if (k->law[i] == of && ++count)
                line[i] =
                    b[k->at_q[i]] / p->stress * (yields ? k->sign[i] * friction : p->slip_length);
        if (count > 0 && !(yields && p->hardening <= 0.0))
            kind->precondition(k->by, yields ? RB_INVERSE_YIELDING : RB_INVERSE_TANGENTIAL,
                               p->hardening, line);
        for (int i = 0; i < p->n; i++)
            if (k->law[i] == of)
                x[k->at_q[i]] = line[i];
    }
}

/* x: the right side, then the solution. */
static rb_status solve_by_matrix(const laws *k, rb_arena *scratch, double *x)
{
    const size_t size = (size_t)k->size;
    double *A = rb_arena_doubles(scratch, size, size);
    lapack_int *pivots = rb_arena_zeros(scratch, size, sizeof *pivots);

    if (scratch->failed)
        return RB_ENOMEM;
    /* Column by column from the matrices. */
    const rb_contact_problem *p = k->p;
    const rb_contact_matrix K = rb_contact_operator_matrix(p->op);
    const size_t n = (size_t)p->n, bytes = n * sizeof(double);
    const int length = p->n;
    motion m = k->scratch;

    memset(m.p, 0, 2 * bytes);
    for (int i = 0; i < length; i++)
        for (int tangential = 0; tangential < 2; tangential++) {
            const int column = tangential ? k->at_q[i] : k->at_p[i];
            const size_t from = (size_t)i + (size_t)tangential * n;
            const double share = tangential ? 0.0 : friction_of(k, i);
            if (column < 0)
                continue;
            /* A unit of one unknown: the columns of F and S that belong to it; pressure of what
             * slides brings its friction along. */
            (tangential ? m.q : m.p)[i] = p->stress;
            memset(m.gap, 0, 2 * bytes);
            cblas_daxpy(length, p->stress, K.F + from * (size_t)K.ldf, 1, m.gap, 1);
            cblas_daxpy(length, p->stress, K.S + from * n, 1, m.lambda, 1);
            if (share != 0.0) {
                m.q[i] = share * p->stress;
                cblas_daxpy(length, m.q[i], K.F + (from + n) * (size_t)K.ldf, 1, m.gap, 1);
                cblas_daxpy(length, m.q[i], K.S + (from + n) * n, 1, m.lambda, 1);
            }
            inner_rows(k, &m, 0, A + (size_t)column * size);
            control_rows(k, &m, 0, A + (size_t)column * size + k->inner);
            m.p[i] = m.q[i] = 0.0;
        }
    for (size_t c = (size_t)k->inner; c < size; c++) {
        memset(A + c * size, 0, size * sizeof *A);
        border_column(k, (int)c - k->inner, A + c * size);
    }
    const int fault =
        LAPACKE_dgesv_work(LAPACK_COL_MAJOR, k->size, 1, A, k->size, pivots, x, k->size);
    return fault == 0 ? RB_OK : RB_SINGULAR;
}

/* x as above; from the unknowns that the state has. */
static rb_status solve_by_products(const laws *k, const rb_contact_state *state, rb_arena *scratch,
                                   double *x)
{
    const rb_contact_problem *p = k->p;
    const rb_contact_linear linear = {.inner = k->inner,
                                      .borders = k->size - k->inner,
                                      .multiply = multiply,
                                      .precondition = precondition,
                                      .border_column = border_column,
                                      .border_rows = border_rows,
                                      .of = k};
    double *start = rb_arena_doubles(scratch, (size_t)k->size, 1);

    if (!start)
        return RB_ENOMEM;
    /* GMRES begins with the tractions of the state, in the scales of the unknowns. */
    double *border = start + k->inner;
    for (int i = 0; i < p->n; i++) {
        if (k->at_p[i] >= 0)
            start[k->at_p[i]] = state->p[i] / p->stress;
        if (k->at_q[i] >= 0)
            start[k->at_q[i]] = state->q[i] / p->stress;
    }
    if (p->load_given)
        *border++ = isfinite(state->delta) ? state->delta / p->gap_length : 0.0;
    if (p->force_given)
        *border = state->xi * p->e_T[0] / p->slip_length;
    const rb_status s = k->by->kind->gmres(k->by, &linear, x, start);
    if (s == RB_OK)
        memcpy(x, start, (size_t)k->size * sizeof *x);
    return s;
}

/* p, q, delta, xi, lambda, zone, plastic of the state.  RB_SINGULAR, RB_ENOMEM. */
static rb_status solve_laws(laws *k, rb_contact_state *state)
{
    const rb_contact_problem *p = k->p;
    motion m = k->scratch;

    zones_of_laws(k, state);
    /* Numbers of the unknowns: pressures of all contacts, then the friction of what sticks or
     * yields. */
    k->inner = 0;
    for (int i = 0; i < p->n; i++)
        k->at_p[i] = k->law[i] != SEPARATED ? k->inner++ : -1;
    for (int i = 0; i < p->n; i++)
        k->at_q[i] = k->law[i] == STICK || k->law[i] == YIELD ? k->inner++ : -1;
    k->size = k->inner + p->load_given + p->force_given;
    rb_arena scratch = {0};
    double *x = rb_arena_doubles(&scratch, (size_t)k->size, 1);
    rb_status s = RB_OK;

    if (!x)
        return rb_arena_done(&scratch, RB_ENOMEM);
    /* The right side: what the rows have without tractions, with the opposite sign. */
    memset(m.p, 0, 2 * (size_t)p->n * sizeof *m.p);
    for (int i = 0; i < p->n; i++) {
        m.gap[i] = p->d_N[i] - (p->load_given ? 0.0 : p->delta);
        m.lambda[i] = p->d_T[i] + (p->force_given ? 0.0 : p->xi * p->e_T[i]);
    }
    inner_rows(k, &m, 1, x);
    control_rows(k, &m, 1, x + k->inner);
    cblas_dscal(k->size, -1.0, x, 1);
    k->by = rb_contact_operator_by_products(p->op, k->size);
    if (k->size > 0)
        s = k->by ? solve_by_products(k, state, &scratch, x) : solve_by_matrix(k, &scratch, x);
    if (s == RB_OK && !isfinite(rb_norm_1((size_t)k->size, x, 1)))
        s = RB_SINGULAR;
    if (s != RB_OK)
        return rb_arena_done(&scratch, s);
    /* Back to stresses and lengths; gaps and slips are computed again from the tractions. */
    const double *border = x + k->inner;
    set_tractions(k, x, &m);
    memcpy(state->p, m.p, (size_t)p->n * sizeof *m.p);
    memcpy(state->q, m.q, (size_t)p->n * sizeof *m.q);
    state->delta = p->load_given ? p->gap_length * *border++ : p->delta;
    state->xi = p->force_given ? p->slip_length / p->e_T[0] * *border : p->xi;
    rb_contact_kinematics(p, state, k->gap, state->lambda);
    for (int i = 0; i < p->n; i++)
        state->plastic[i] = k->law[i] == SLIP_AND_YIELD;
    rb_contact_set_plastic(p, state, k->yielded);
    return rb_arena_done(&scratch, RB_OK);
}

/* ---- Corrections ------------------------------------------------------------------- */

/* What the layer has yielded upstream of the element that is looked at, by the slips of
 * the solve and the laws as corrected so far: a history that follows the material does
 * not wait a round for each element. */
typedef struct {
    double next, second; /* u of the two elements upstream */
} upstream;

/* The law of an element that slides by `slip` >= 0 under the limit mu p, u before it: the
 * layer yields as long as it takes less friction than the surfaces.  Moves u on. */
static law sliding_law(const rb_contact_problem *p, int i, double slip, double limit, double *u)
{
    const double before = *u, after = before + p->own * slip;
    const double at_first = rb_contact_yield_stress(p, i, before),
                 at_last = rb_contact_yield_stress(p, i, after);

    if (at_first >= limit)
        return SLIP;
    *u = after;
    if (at_last <= limit)
        return at_last > 0.0 ? YIELD : SOFTENED;
    *u = (limit - p->yield[i]) / p->hardening;
    return SLIP_AND_YIELD;
}

/* The law of element i after a solve. */
static law corrected(const laws *k, const rb_contact_state *state, int i, upstream *up,
                     double *sign)
{
    const rb_contact_problem *p = k->p;
    /* What is wrong with a law shows in one sign: a gap below 0, friction above its bound, slip
     * along the friction, a tension. */
    const double limit = p->bound[i] * fmax(state->p[i], 0.0), q = state->q[i],
                 slip = state->lambda[i];
    double u = p->recall[0] * up->next + p->recall[1] * up->second;
    law next = k->law[i];

    *sign = k->sign[i];
    if (next == SEPARATED && k->gap[i] < 0.0) {
        *sign = against(slip);
        next = sliding_law(p, i, 0.0, limit, &u);
    } else if (next == STICK && fabs(q) > fmin(limit, rb_contact_yield_stress(p, i, u))) {
        *sign = q > 0.0 ? 1.0 : -1.0;
        next = sliding_law(p, i, 0.0, limit, &u);
    } else if (next > STICK) {
        if (next == SOFTENED || p->bound[i] == 0.0)
            *sign = against(slip);
        next = *sign * slip > 0.0 ? STICK : sliding_law(p, i, fabs(slip), limit, &u);
    }
    if (k->law[i] != SEPARATED && state->p[i] < 0.0)
        next = SEPARATED;
    up->second = up->next;
    up->next = u;
    return next;
}

/* A given force fixes xi only where something sticks, or yields by as much as xi says:
 * else the element that wants to slide least sticks. */
static void hold_one(const laws *k, const rb_contact_state *state, law *next)
{
    const rb_contact_problem *p = k->p;
    double least = INFINITY;
    int held = -1;

    for (int i = 0; i < p->n; i++) {
        const double excess =
            fabs(state->q[i]) -
            fmin(p->bound[i] * state->p[i], rb_contact_yield_stress(p, i, k->yielded[i]));
        if (next[i] == STICK || (next[i] == YIELD && p->hardening != 0.0))
            return;
        if (next[i] != SEPARATED && state->p[i] > 0.0 && excess < least) {
            least = excess;
            held = i;
        }
    }
    if (held >= 0)
        next[held] = STICK;
}

/* Solves and corrects until the laws stay; where they come back, one element at a time.
 * RB_MAXITER, RB_SINGULAR, RB_ENOMEM. */
static rb_status iterate_laws(laws *k, rb_contact_state *state)
{
    uint64_t hash[ROUNDS];
    int single = 0;

    for (int round = 0; round < ROUNDS + SINGLE_ROUNDS; round++) {
        /* Laws that come again would come for ever: from then on one element at a time changes. */
        const size_t n = (size_t)k->p->n;
        const uint64_t now = rb_hash(rb_hash(RB_HASH_START, k->law, n * sizeof *k->law), k->sign,
                                     n * sizeof *k->sign);
        for (int j = 0; j < round && !single; j++)
            single = hash[j] == now;
        single = single || round >= ROUNDS;
        if (!single)
            hash[round] = now;
        const rb_status s = rb_interrupted() ? RB_INTERRUPTED : solve_laws(k, state);
        if (s != RB_OK)
            return s;
        state->iterations++;
        if (k->p->trace) {
            zones_of_laws(k, state);
            k->p->trace(state, k->p->trace_context);
        }
        /* Corrects all elements, or the one furthest upstream. */
        upstream up = {0.0, 0.0};
        int changes = 0;

        for (int i = k->p->n - 1; i >= 0; i--)
            k->next[i] = corrected(k, state, i, &up, &k->next_sign[i]);
        if (k->p->force_given)
            hold_one(k, state, k->next);
        for (int i = k->p->n - 1; i >= 0; i--) {
            const int slides = k->next[i] > STICK;
            if (k->next[i] == k->law[i] && (!slides || k->next_sign[i] == k->sign[i]))
                continue;
            if (single && changes > 0)
                break;
            k->law[i] = k->next[i];
            k->sign[i] = slides ? k->next_sign[i] : 0.0;
            changes++;
        }
        if (changes == 0)
            return RB_OK;
    }
    return RB_MAXITER;
}

/* ---- The way down from a yield stress that nothing reaches ------------------------- */

/* Those of a layer with a higher yield stress come first: half the excess less in each
 * step, or a smaller part of it. */
static rb_status lower_yield_stress(rb_contact_problem *p, laws *k, double excess,
                                    rb_contact_state *state)
{
    const size_t n = (size_t)p->n;
    law *good = rb_arena_zeros(&k->memory, n, sizeof *good);
    double *sign = rb_arena_doubles(&k->memory, n, 1), *yield = rb_arena_doubles(&k->memory, n, 1),
           share = 1.0, step = 0.5;
    rb_status s = RB_OK;

    if (k->memory.failed)
        return RB_ENOMEM;
    memcpy(yield, p->yield, n * sizeof *yield);
    while (s == RB_OK && share > 0.0 && step > LEAST_STEP) {
        /* A smaller yield stress; where no laws are found for it, back to the last good ones and
         * half the step. */
        const double next = share > step ? share - step : 0.0;
        memcpy(good, k->law, n * sizeof *good);
        memcpy(sign, k->sign, n * sizeof *sign);
        for (int i = 0; i < p->n; i++)
            p->yield[i] = yield[i] + next * excess;
        s = iterate_laws(k, state);
        memcpy(p->yield, yield, n * sizeof *yield);
        if (s == RB_OK) {
            share = next;
        } else if (s > 0) {
            memcpy(k->law, good, n * sizeof *good);
            memcpy(k->sign, sign, n * sizeof *sign);
            step *= 0.5;
            s = RB_OK;
        }
    }
    /* without this the residual would refuse what stops halfway: rb_contact_proven */
    return s == RB_OK && share > 0.0 ? RB_MAXITER : s;
}

/* By how much the largest friction is above the yield stress. */
static double excess_of(const rb_contact_problem *p, const rb_contact_state *state)
{
    double excess = -INFINITY;

    for (int i = 0; i < p->n; i++)
        excess = fmax(excess, fabs(state->q[i]) - fmax(p->yield[i], 0.0));
    return excess;
}

int rb_contact_yields(const rb_contact_problem *p, const rb_contact_state *state)
{
    return excess_of(p, state) > 0.0;
}

rb_status rb_contact_yield_newton(rb_contact_problem *p, int follows, rb_contact_state *state)
{
    const double excess = excess_of(p, state);
    laws k;
    rb_status s = laws_alloc(p, &k);

    if (s != RB_OK)
        return rb_arena_done(&k.memory, s);
    /* From zones alone, such as an elastic solution or a neighbouring one has them. */
    static const law of[] = {SEPARATED, STICK, SLIP, SLIP, YIELD, YIELD};
    static const double sign[] = {0.0, 0.0, -1.0, 1.0, -1.0, 1.0};

    for (int i = 0; i < k.p->n; i++) {
        k.law[i] = of[state->zone[i]];
        k.sign[i] = sign[state->zone[i]];
    }
    s = follows ? lower_yield_stress(p, &k, excess, state) : iterate_laws(&k, state);
    if (s >= 0)
        zones_of_laws(&k, state);
    return rb_arena_done(&k.memory, s);
}

rb_status rb_contact_yield_polish(const rb_contact_problem *p, rb_contact_state *state)
{
    laws k;
    rb_status s = laws_alloc(p, &k);

    if (s != RB_OK)
        return rb_arena_done(&k.memory, s);
    /* From tractions and slips: what exceeds rounding against its bound decides. */
    const double stress = rb_contact_friction_scale(p);

    rb_contact_yielded(p, state->plastic, NULL, k.yielded);
    for (int i = 0; i < p->n; i++) {
        const double yield = rb_contact_yield_stress(p, i, k.yielded[i]);
        const double plastic = fabs(state->plastic[i]) / p->slip_length,
                     slip = fabs(state->lambda[i] - state->plastic[i]) / p->slip_length;
        const int slips =
            slip > (p->bound[i] * state->p[i] - fabs(state->q[i])) / stress && slip > 0.0;
        const int yields = plastic > (yield - fabs(state->q[i])) / stress;
        k.sign[i] = slips || yields ? against(state->lambda[i]) : 0.0;
        k.law[i] = state->zone[i] == RB_ZONE_SEPARATED ? SEPARATED
                   : slips && yields && plastic > 0.0  ? SLIP_AND_YIELD
                   : slips                             ? SLIP
                   : !(yields && plastic > 0.0)        ? STICK
                   : yield > 0.0                       ? YIELD
                                                       : SOFTENED;
    }
    return rb_arena_done(&k.memory, solve_laws(&k, state));
}
