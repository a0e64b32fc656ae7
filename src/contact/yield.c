/* A layer between the surfaces that yields (theory.md, Y1): beside Coulomb's bound mu p
 * the friction has a second one, which follows what the layer has yielded.  With every
 * element's law known the problem is linear, as in newton.c; here it is assembled anew in
 * each step, because the rows of elements that yield hold those of all upstream. */
#include "contact/internal.h"

#include <cblas.h>
#include <lapacke.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Rounds of all elements at once, and of one element at a time. */
enum { ROUNDS = 60, SINGLE_ROUNDS = 100 };
/* Of the way down to the yield stress from that which nothing reaches. */
static const double LEAST_STEP = 1e-3;

/* Which equation an element has; friction has the sign `sign` but in stick.
 * SLIP_AND_YIELD: both bounds are reached, so that the layer hardens as mu p grows.
 * SOFTENED: nothing is left of the yield stress. */
typedef enum { SEPARATED, STICK, SLIP, YIELD, SLIP_AND_YIELD, SOFTENED } law;

typedef struct {
    const rb_contact_problem *p;
    law *law;              /* n; owned, as the rest */
    double *sign;          /* n */
    int *at_p, *at_q;      /* n: number of the unknown, or -1 */
    int contacts, size;    /* unknowns: pressures, frictions, delta, xi */
    double *gap, *yielded; /* n */
} laws;

static void laws_free(laws *k)
{
    free(k->law);
    free(k->sign);
    free(k->at_p);
    free(k->gap);
}

static rb_status laws_alloc(const rb_contact_problem *p, laws *k)
{
    const size_t n = (size_t)p->n;

    *k = (laws){.p = p,
                .law = calloc(n, sizeof(law)),
                .sign = rb_alloc(n, 1),
                .at_p = calloc(2 * n, sizeof(int)),
                .gap = rb_alloc(n, 2)};
    if (!k->law || !k->sign || !k->at_p || !k->gap) {
        laws_free(k);
        return RB_ENOMEM;
    }
    k->at_q = k->at_p + n;
    k->yielded = k->gap + n;
    return RB_OK;
}

/* ---- Laws and states --------------------------------------------------------------- */

static double against(double slip)
{
    return slip > 0.0 ? -1.0 : 1.0;
}

/* From tractions and slips: what exceeds rounding against its bound decides. */
static void laws_of_state(const rb_contact_state *state, laws *k)
{
    const rb_contact_problem *p = k->p;
    const double stress = rb_contact_friction_scale(p);

    rb_contact_yielded(p, state->plastic, k->yielded);
    for (int i = 0; i < p->n; i++) {
        const double yield = rb_contact_yield_stress(p, i, k->yielded[i]);
        const double plastic = fabs(state->plastic[i]) / p->slip_length,
                     slip = fabs(state->lambda[i] - state->plastic[i]) / p->slip_length;
        const int slips =
            slip > (p->bound[i] * state->p[i] - fabs(state->q[i])) / stress && slip > 0.0;
        const int yields = plastic > (yield - fabs(state->q[i])) / stress;
        k->sign[i] = slips || yields ? against(state->lambda[i]) : 0.0;
        k->law[i] = state->zone[i] == RB_ZONE_SEPARATED ? SEPARATED
                    : slips && yields && plastic > 0.0  ? SLIP_AND_YIELD
                    : slips                             ? SLIP
                    : !(yields && plastic > 0.0)        ? STICK
                    : yield > 0.0                       ? YIELD
                                                        : SOFTENED;
    }
}

/* From zones alone, such as an elastic solution or a neighbouring one has them. */
static void laws_of_zones(const rb_contact_state *state, laws *k)
{
    static const law of[] = {SEPARATED, STICK, SLIP, SLIP, YIELD, YIELD};
    static const double sign[] = {0.0, 0.0, -1.0, 1.0, -1.0, 1.0};

    for (int i = 0; i < k->p->n; i++) {
        k->law[i] = of[state->zone[i]];
        k->sign[i] = sign[state->zone[i]];
    }
}

static void zones_of_laws(const laws *k, rb_contact_state *state)
{
    for (int i = 0; i < k->p->n; i++) {
        const int backwards = k->sign[i] < 0.0;
        state->zone[i] =
            k->law[i] == SEPARATED ? RB_ZONE_SEPARATED
            : k->law[i] == STICK   ? RB_ZONE_STICK
            : k->law[i] == SLIP || k->law[i] == SLIP_AND_YIELD
                ? (backwards ? RB_ZONE_SLIP_NEGATIVE : RB_ZONE_SLIP_POSITIVE)
                : (backwards ? RB_ZONE_YIELD_NEGATIVE : RB_ZONE_YIELD_POSITIVE);
    }
}

/* ---- The linear problem of the laws ------------------------------------------------ */

static void number_unknowns(laws *k)
{
    const rb_contact_problem *p = k->p;

    k->size = 0;
    for (int i = 0; i < p->n; i++)
        k->at_p[i] = k->law[i] != SEPARATED ? k->size++ : -1;
    k->contacts = k->size;
    for (int i = 0; i < p->n; i++)
        k->at_q[i] = k->law[i] == STICK || k->law[i] == YIELD ? k->size++ : -1;
    k->size += p->load_given + p->force_given;
}

/* Friction of element i per unit of its pressure. */
static double friction_of(const laws *k, int i)
{
    const int slides = k->law[i] == SLIP || k->law[i] == SLIP_AND_YIELD;
    return slides ? k->sign[i] * k->p->bound[i] : 0.0;
}

/* Adds the form a_N'p + a_T'q of the unknowns, times factor; rows of matrices have a
 * stride. */
static void add_form(const laws *k, double factor, const double *a_N, const double *a_T,
                     size_t stride, double *form)
{
    const double unit = factor * k->p->stress;

    for (int i = 0; i < k->p->n; i++) {
        if (k->at_p[i] >= 0)
            form[k->at_p[i]] += unit * (a_N[(size_t)i * stride] +
                                        friction_of(k, i) * a_T[(size_t)i * stride]);
        if (k->at_q[i] >= 0)
            form[k->at_q[i]] += unit * a_T[(size_t)i * stride];
    }
}

/* Forms have size + 1 entries, the last one is their constant. */
static void add_slip(const laws *k, int i, double factor, double *form)
{
    const rb_contact_problem *p = k->p;
    const double *S = rb_contact_operator_matrix(p->op).S + i;
    const size_t n = (size_t)p->n;

    add_form(k, factor, S, S + n * n, n, form);
    form[k->size] += factor * p->d_T[i];
    if (p->force_given)
        form[k->size - 1] += factor * p->slip_length * p->e_T[i] / p->e_T[0];
    else
        form[k->size] += factor * p->xi * p->e_T[i];
}

static void add_gap(const laws *k, int i, double *form)
{
    const rb_contact_problem *p = k->p;
    const rb_contact_matrix K = rb_contact_operator_matrix(p->op);

    add_form(k, 1.0, K.F + i, K.F + i + (size_t)p->n * (size_t)K.ldf, (size_t)K.ldf,
             form);
    form[k->size] += p->d_N[i];
    if (p->load_given)
        form[k->size - 1 - p->force_given] -= p->gap_length;
    else
        form[k->size] -= p->delta;
}

/* What element i has yielded, from the forms of the two elements upstream of it. */
static void yielded_form(const laws *k, int i, const double *next, const double *second,
                         double *form)
{
    const rb_contact_problem *p = k->p;

    for (int j = 0; j <= k->size; j++)
        form[j] = p->recall[0] * next[j] + p->recall[1] * second[j];
    if (k->law[i] == YIELD || k->law[i] == SOFTENED)
        add_slip(k, i, -p->own * k->sign[i], form);
    if (k->law[i] == SLIP_AND_YIELD) {
        memset(form, 0, ((size_t)k->size + 1) * sizeof *form);
        form[k->at_p[i]] = p->bound[i] * p->stress / p->hardening;
        form[k->size] = -p->yield[i] / p->hardening;
    }
}

/* Row r of the system: form = 0, in units of scale. */
static void set_row(const laws *k, int r, double scale, const double *form, double *A,
                    double *b)
{
    for (int j = 0; j < k->size; j++)
        A[r + (size_t)j * (size_t)k->size] = form[j] / scale;
    b[r] = -form[k->size] / scale;
}

static void control_rows(const laws *k, double *form, double *A, double *b)
{
    const rb_contact_problem *p = k->p;
    const size_t n = (size_t)p->n, bytes = ((size_t)k->size + 1) * sizeof *form;
    double *control = k->gap; /* room for two rows */
    int r = k->size - p->load_given - p->force_given;

    if (p->load_given) {
        memset(form, 0, bytes);
        add_form(k, 1.0, p->load_N, p->load_T, 1, form);
        form[k->size] = -p->load;
        set_row(k, r++, p->load, form, A, b);
    }
    if (p->force_given) {
        memset(form, 0, bytes);
        rb_contact_force_row(p, control, control + n);
        add_form(k, 1.0, control, control + n, 1, form);
        form[k->size] = -p->force;
        set_row(k, r, rb_contact_force_scale(p), form, A, b);
    }
}

static void assemble(const laws *k, double *forms, double *A, double *b)
{
    const rb_contact_problem *p = k->p;
    const size_t width = (size_t)k->size + 1, bytes = width * sizeof *forms;
    double *row = forms, *u = forms + width, *next = u + width, *second = next + width;

    memset(forms, 0, 4 * bytes);
    for (int i = p->n - 1; i >= 0; i--) {
        yielded_form(k, i, next, second, u);
        if (k->at_p[i] >= 0) {
            memset(row, 0, bytes);
            add_gap(k, i, row);
            set_row(k, k->at_p[i], p->gap_length, row, A, b);
        }
        if (k->law[i] == STICK) {
            memset(row, 0, bytes);
            add_slip(k, i, 1.0, row);
            set_row(k, k->at_q[i], p->slip_length, row, A, b);
        } else if (k->law[i] == YIELD) {
            for (int j = 0; j <= k->size; j++)
                row[j] = -p->hardening * u[j];
            row[k->at_q[i]] += k->sign[i] * p->stress;
            row[k->size] -= p->yield[i];
            set_row(k, k->at_q[i], p->stress, row, A, b);
        }
        double *const free_now = second;
        second = next;
        next = u;
        u = free_now;
    }
    control_rows(k, row, A, b);
}

/* Plastic slips from the slips, upstream first. */
static void set_plastic(const laws *k, rb_contact_state *state)
{
    const rb_contact_problem *p = k->p;
    double next = 0.0, second = 0.0;

    for (int i = p->n - 1; i >= 0; i--) {
        const double before = p->recall[0] * next + p->recall[1] * second;
        double own = 0.0;
        if (k->law[i] == YIELD || k->law[i] == SOFTENED)
            own = -k->sign[i] * state->lambda[i];
        else if (k->law[i] == SLIP_AND_YIELD)
            own = ((p->bound[i] * state->p[i] - p->yield[i]) / p->hardening - before) /
                  p->own;
        state->plastic[i] = -k->sign[i] * own;
        k->yielded[i] = before + p->own * own;
        second = next;
        next = k->yielded[i];
    }
}

/* p, q, delta, xi, lambda, plastic of the state.  RB_SINGULAR, RB_ENOMEM. */
static rb_status solve_laws(laws *k, rb_contact_state *state)
{
    const rb_contact_problem *p = k->p;

    number_unknowns(k);
    const size_t size = (size_t)k->size;
    double *A = rb_alloc(size + 1, size + 5), *b = A + size * (size + 1);
    lapack_int *pivots = calloc(size + 1, sizeof *pivots);
    rb_status s = A && pivots ? RB_OK : RB_ENOMEM;

    if (s == RB_OK) {
        assemble(k, b + size, A, b);
        if (size > 0 && LAPACKE_dgesv_work(LAPACK_COL_MAJOR, k->size, 1, A, k->size,
                                           pivots, b, k->size) != 0)
            s = RB_SINGULAR;
        if (s == RB_OK && !isfinite(rb_norm_1(size, b, 1)))
            s = RB_SINGULAR;
    }
    if (s == RB_OK) {
        for (int i = 0; i < p->n; i++) {
            state->p[i] = k->at_p[i] >= 0 ? p->stress * b[k->at_p[i]] : 0.0;
            state->q[i] = k->at_q[i] >= 0 ? p->stress * b[k->at_q[i]]
                                          : friction_of(k, i) * state->p[i];
        }
        state->delta = p->load_given
                           ? p->gap_length * b[size - 1 - (size_t)p->force_given]
                           : p->delta;
        state->xi = p->force_given ? p->slip_length / p->e_T[0] * b[size - 1] : p->xi;
        rb_contact_kinematics(p, state, k->gap, state->lambda);
        set_plastic(k, state);
    }
    free(pivots);
    free(A);
    return s;
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
static law sliding_law(const rb_contact_problem *p, int i, double slip, double limit,
                       double *u)
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

/* Corrects all elements, or the one furthest upstream; returns how many changed. */
static int correct(laws *k, const rb_contact_state *state, int single)
{
    const int n = k->p->n;
    upstream up = {0.0, 0.0};
    int changes = 0;
    law *next = calloc((size_t)n, sizeof *next);
    double *sign = calloc((size_t)n, sizeof *sign);

    if (!next || !sign)
        changes = -1;
    for (int i = n - 1; i >= 0 && changes == 0; i--)
        next[i] = corrected(k, state, i, &up, &sign[i]);
    if (changes == 0 && k->p->force_given)
        hold_one(k, state, next);
    for (int i = n - 1; i >= 0 && changes >= 0; i--) {
        const int slides = next[i] > STICK;
        if (next[i] == k->law[i] && (!slides || sign[i] == k->sign[i]))
            continue;
        if (single && changes > 0)
            break;
        k->law[i] = next[i];
        k->sign[i] = slides ? sign[i] : 0.0;
        changes++;
    }
    free(sign);
    free(next);
    return changes;
}

static uint64_t fingerprint(const laws *k)
{
    const size_t n = (size_t)k->p->n;
    return rb_hash(rb_hash(RB_HASH_START, k->law, n * sizeof *k->law), k->sign,
                   n * sizeof *k->sign);
}

/* Solves and corrects until the laws stay; where they come back, one element at a time.
 * RB_MAXITER, RB_SINGULAR, RB_ENOMEM. */
static rb_status iterate(laws *k, rb_contact_state *state)
{
    uint64_t seen[ROUNDS];
    int single = 0;

    for (int round = 0; round < ROUNDS + SINGLE_ROUNDS; round++) {
        const uint64_t now = fingerprint(k);
        for (int j = 0; j < round && !single; j++)
            single = seen[j] == now;
        single = single || round >= ROUNDS;
        if (!single)
            seen[round] = now;
        const rb_status s = solve_laws(k, state);
        if (s != RB_OK)
            return s;
        state->iterations++;
        if (k->p->trace) {
            zones_of_laws(k, state);
            k->p->trace(state, k->p->trace_context);
        }
        const int changes = correct(k, state, single);
        if (changes <= 0)
            return changes < 0 ? RB_ENOMEM : RB_OK;
    }
    return RB_MAXITER;
}

/* ---- The way down from a yield stress that nothing reaches ------------------------- */

/* Those of a layer with a higher yield stress come first: half the excess less in each
 * step, or a smaller part of it. */
static rb_status follow(rb_contact_problem *p, laws *k, double excess,
                        rb_contact_state *state)
{
    const size_t n = (size_t)p->n;
    law *good = malloc(n * sizeof *good);
    double *sign = rb_alloc(n, 2), *yield = sign + n, share = 1.0, step = 0.5;
    rb_status s = good && sign ? RB_OK : RB_ENOMEM;

    if (s == RB_OK)
        memcpy(yield, p->yield, n * sizeof *yield);
    while (s == RB_OK && share > 0.0 && step > LEAST_STEP) {
        const double next = share > step ? share - step : 0.0;
        memcpy(good, k->law, n * sizeof *good);
        memcpy(sign, k->sign, n * sizeof *sign);
        for (int i = 0; i < p->n; i++)
            p->yield[i] = yield[i] + next * excess;
        s = iterate(k, state);
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
    free(sign);
    free(good);
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

rb_status rb_contact_yield_newton(rb_contact_problem *p, int follows,
                                  rb_contact_state *state)
{
    const double excess = excess_of(p, state);
    laws k;
    rb_status s = laws_alloc(p, &k);

    if (s != RB_OK)
        return s;
    laws_of_zones(state, &k);
    s = follows ? follow(p, &k, excess, state) : iterate(&k, state);
    if (s >= 0)
        zones_of_laws(&k, state);
    laws_free(&k);
    return s;
}

rb_status rb_contact_yield_polish(const rb_contact_problem *p, rb_contact_state *state)
{
    laws k;
    rb_status s = laws_alloc(p, &k);

    if (s != RB_OK)
        return s;
    laws_of_state(state, &k);
    s = solve_laws(&k, state);
    if (s >= 0)
        zones_of_laws(&k, state);
    laws_free(&k);
    return s;
}
