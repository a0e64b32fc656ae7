/* Friction laws (theory-rolling.md 4.11): the coefficient of an element from its state. */
#include "rolling/case/internal.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/law.h"

#include <gsl/gsl_interp.h>
#include <math.h>

/* ---- The laws --------------------------------------------------------------------- */

static double constant_mu(const rb_rolling_case *rc, double x, double v)
{
    (void)x;
    (void)v;
    return rc->mu;
}

static double table_mu(const rb_rolling_case *rc, double x, double v)
{
    (void)v;
    return rb_rolling_table_at(&rc->friction.table, x);
}

/* v in units of the slip scale of term k; without a fall, and at rest, the scale means nothing. */
static double scaled(const rb_rolling_friction *f, int k, double v)
{
    return f->fall[k] != 0.0 && v != 0.0 ? v / f->slip_scale[k] : 0.0;
}

static double exponential_mu(const rb_rolling_case *rc, double x, double v)
{
    const rb_rolling_friction *f = &rc->friction;
    double mu = rc->mu;
    (void)x;
    for (int k = 0; k < 2; k++)
        mu += f->fall[k] != 0.0 ? f->fall[k] * exp2(-scaled(f, k, v)) : 0.0;
    return mu;
}

static double rational_mu(const rb_rolling_case *rc, double x, double v)
{
    const rb_rolling_friction *f = &rc->friction;
    const double first = scaled(f, 0, v), second = scaled(f, 1, v);
    (void)x;
    return rc->mu + f->fall[0] / (1.0 + first) + f->fall[1] / (1.0 + second * second);
}

static double linear_mu(const rb_rolling_case *rc, double x, double v)
{
    const rb_rolling_friction *f = &rc->friction;
    (void)x;
    return rc->mu + f->fall[0] * fmax(0.0, 1.0 - 0.5 * scaled(f, 0, v)) +
           f->fall[1] * fmax(0.0, 1.0 - 0.5 * scaled(f, 1, v));
}

/* steepest: largest -dmu/dv of either term with fall and slip scale 1; 0: the law does
 * not depend on the slip velocity.  with_memory: largest mu(0) - mu(v) - v dmu/dv of it.
 * The macro takes all of them, so that a law that lacks one does not compile. */
#define LAW(name, steepest_1, steepest_2, memory_1, memory_2)                                      \
    [RB_FRICTION_##name] = {name##_mu, {steepest_1, steepest_2}, {memory_1, memory_2}}
static const struct {
    double (*mu)(const rb_rolling_case *rc, double x, double v);
    double steepest[2], with_memory[2];
} laws[RB_FRICTION_LAWS] = {
    LAW(constant, 0.0, 0.0, 0.0, 0.0),
    /* log 2, and 1 + exp(-2) */
    LAW(exponential, 0.6931471805599453, 0.6931471805599453, 1.1353352832366127,
        1.1353352832366127),
    /* 1, 3 sqrt(3)/8 */
    LAW(rational, 1.0, 0.6495190528383290, 1.0, 1.125),
    LAW(linear, 0.5, 0.5, 2.0, 2.0),
    LAW(table, 0.0, 0.0, 0.0, 0.0),
};

double rb_rolling_table_at(const rb_rolling_table *table, double x)
{
    const int last = table->n - 1;

    if (x <= table->x[0])
        return table->y[0];
    if (x >= table->x[last])
        return table->y[last];
    const size_t k = gsl_interp_bsearch(table->x, x, 0, (size_t)last);
    const double share = (x - table->x[k]) / (table->x[k + 1] - table->x[k]);
    return table->y[k] + share * (table->y[k + 1] - table->y[k]);
}

/* ---- What is known of a law beforehand --------------------------------------------- */

int rb_rolling_law_depends_on_slip(const rb_rolling_friction *f)
{
    return laws[f->law].steepest[0] > 0.0 && (f->fall[0] != 0.0 || f->fall[1] != 0.0);
}

int rb_rolling_law_depends_on_state(const rb_rolling_case *rc)
{
    const rb_rolling_friction *f = &rc->friction;
    const int slips = rb_rolling_law_depends_on_slip(f);
    return rc->formulation != RB_STATIC ? slips || f->heat != 0.0 : slips && f->memory > 0.0;
}

/* The end of the coefficients' range on that side: 1 the largest, -1 the least. */
static double end_of_range(const rb_rolling_case *rc, double side)
{
    const rb_rolling_friction *f = &rc->friction;
    double most = side * rc->mu;

    for (int k = 0; k < f->table.n && f->law == RB_FRICTION_table; k++)
        most = k == 0 ? side * f->table.y[0] : fmax(most, side * f->table.y[k]);
    for (int k = 0; k < 2 && rb_rolling_law_depends_on_slip(f); k++)
        most += fmax(0.0, side * f->fall[k]);
    return side * (most + fmax(0.0, side * f->heat));
}

double rb_rolling_largest_mu(const rb_rolling_case *rc)
{
    return end_of_range(rc, 1.0);
}

double rb_rolling_least_mu(const rb_rolling_case *rc)
{
    return end_of_range(rc, -1.0);
}

/* ---- The coefficients of a state --------------------------------------------------- */

double rb_rolling_law_mu(const rb_rolling_case *rc, double x, double v, double temperature)
{
    return laws[rc->friction.law].mu(rc, x, v) +
           (rc->friction.heat != 0.0
                ? rc->friction.heat * fmin(1.0, fmax(0.0, (temperature - rc->friction.heat_from) /
                                                              rc->friction.heat_range))
                : 0.0);
}

double rb_rolling_law_at_rest(const rb_rolling_case *rc, double x)
{
    const rb_rolling_heat *a = &rc->heat_a, *b = &rc->heat_b;
    const double e_a = sqrt(a->conductivity * a->heat_capacity),
                 e_b = sqrt(b->conductivity * b->heat_capacity);
    /* of two bodies that touch */
    const double temperature = e_a > 0.0 && e_b > 0.0
                                   ? (e_a * a->temperature + e_b * b->temperature) / (e_a + e_b)
                                   : a->temperature;

    return rb_rolling_law_mu(rc, x, 0.0, temperature);
}

double rb_rolling_law_steepest(const rb_rolling_case *rc, double length)
{
    const rb_rolling_friction *f = &rc->friction;
    double steepest = 0.0, with_memory = 0.0;

    for (int k = 0; k < 2; k++)
        if (f->fall[k] > 0.0) {
            steepest += f->fall[k] * laws[f->law].steepest[k] / f->slip_scale[k];
            with_memory += f->fall[k] * laws[f->law].with_memory[k];
        }
    return f->memory > 0.0 ? fmin(steepest, length / (rc->speed * f->memory) *
                                                fmax(with_memory, steepest * f->memory_slip))
                           : steepest;
}

void rb_rolling_start_bounds(const rb_rolling_case *rc, const rb_rolling_table *start,
                             const rb_rolling_bodies *bodies, rb_contact_problem *p)
{
    for (int i = 0; i < p->n; i++)
        p->bound[i] = start && rc->formulation != RB_STATIC
                          ? rb_rolling_table_at(start, bodies->f.x[i])
                          : rb_rolling_law_at_rest(rc, bodies->f.x[i]);
    rb_contact_set_friction(p, rb_rolling_largest_mu(rc), p->bound);
}
