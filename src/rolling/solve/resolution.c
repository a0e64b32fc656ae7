/* How short elements must be for the tables of a case: the gap is known to the contact at the
 * midpoints of elements alone, and what lies between them is lost (theory-solvers.md 5.1). */
#include "rolling/body/interpolant.h"
#include "rolling/body/mesh.h"
#include "rolling/case/derived.h"
#include "rolling/solve/law.h"
#include "rolling/solve/resolution.h"
#include "rolling/solve/zone.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>

/* Of what a straight line between two midpoints leaves out: the pressure E* d/h of a misfit d over
 * an element h, as a part of the mean pressure; the mean misfit of the coefficient of friction, as
 * a part of the largest one. */
static const double MOST_PRESSURE = 0.1, MOST_FRICTION = 0.01;
/* From one number of elements that is tried to the next; elements of an interval between two
 * corners; elements of a row of a table, which has no shorter waves than two rows. */
static const double FINER = 1.189207115002721; /* 2^(1/4) */
static const double OF_A_FACET = 8.0, OF_A_ROW = 2.0;
enum { MOST = 1 << 20 };

/* One table as a function of x, at rows and between them. */
typedef struct {
    double (*at)(const void *of, double x);
    const void *of;
    int rows, corners;
    const double *x, *corner;
    double from, to; /* of the rows that count */
} profile;

static double gap_at(const void *of, double x)
{
    return rb_rolling_initial_gap(of, x);
}

static double irregularity_at(const void *of, double x)
{
    return rb_rolling_interpolant_at(of, x);
}

static double friction_at(const void *of, double x)
{
    return rb_rolling_table_at(of, x);
}

/* What elements of one length miss: the largest and the mean distance of the table from straight
 * lines between midpoints, and the largest difference of their slopes. */
typedef struct {
    double most, mean, slope;
} misfit;

static int has_corner_between(const profile *p, double from, double to, int *next)
{
    while (*next < p->corners && p->corner[*next] < from)
        ++*next;
    return *next < p->corners && p->corner[*next] <= to;
}

static misfit misfit_of(const profile *p, double from, double h)
{
    misfit m = {0.0, 0.0, 0.0};
    double weight = 0.0, before = NAN, left = NAN, low = 0.0, high = 0.0;
    long element = -2; /* none */
    int corner = 0, is_broken = 0;

    /* rows and the places halfway between them, in turns */
    for (int k = 0; k + 1 < 2 * p->rows; k++) {
        const double x = k % 2 ? 0.5 * (p->x[k / 2] + p->x[k / 2 + 1]) : p->x[k / 2];
        if (x < p->from || x > p->to)
            continue;
        const long j = (long)floor((x - from) / h - 0.5);
        const double start = from + (j + 0.5) * h;
        if (j != element) {
            element = j;
            low = p->at(p->of, start);
            high = p->at(p->of, start + h);
            is_broken = has_corner_between(p, start, start + h, &corner);
        }
        const double off = p->at(p->of, x) - (low + (high - low) * (x - start) / h);
        const double step = isnan(before) ? 0.0 : x - before;
        if (!is_broken) {
            m.most = fmax(m.most, fabs(off));
            m.slope = fmax(m.slope, step > 0.0 ? fabs(off - left) / step : 0.0);
        }
        m.mean += fabs(off) * step;
        weight += step;
        before = x;
        left = off;
    }
    m.mean = weight > 0.0 ? m.mean / weight : 0.0;
    return m;
}

/* The shortest element that a table can ask for. */
static double shortest(const profile *p)
{
    int rows = 0;

    for (int i = 0; i < p->rows; i++)
        rows += p->x[i] >= p->from && p->x[i] <= p->to;
    return rows > 1 ? (p->to - p->from) / (rows - 1) / OF_A_ROW : INFINITY;
}

/* The tables of a case, of which there are three at most besides that of friction: those of the
 * gap and of what is worn, which add up, and what is irregular. */
typedef struct {
    profile table[3], friction;
    int tables;
    double from, width, level, least; /* the first potential contact; gaps at its edge and lowest */
    rb_rolling_interpolant *irregular; /* owned */
} tables;

static int has_tables(const rb_rolling_case *rc)
{
    return rc->gap == RB_GAP_TABLE || rc->worn.n > 0 || rc->irregularity.n > 0 ||
           rc->friction.law == RB_FRICTION_table;
}

static rb_status open_tables(const rb_rolling_case *rc, tables *t)
{
    double to;
    const double *bend;

    *t = (tables){.tables = 0};
    rb_rolling_first_zone(rc, &t->from, &to, &t->least, &t->level);
    t->width = to - t->from;
    const profile gap = {.at = gap_at, .of = rc, .from = t->from, .to = to};
    if (rc->gap == RB_GAP_TABLE) {
        profile *p = &t->table[t->tables++];
        *p = gap;
        p->rows = rb_rolling_profile_rows(rc->profile, &p->x);
        p->corners = rb_rolling_profile_corners(rc->profile, &p->corner, &bend);
    }
    if (rc->worn.n > 1) {
        profile *p = &t->table[t->tables++];
        *p = gap;
        p->rows = rc->worn.n;
        p->x = rc->worn.x;
    }
    if (rc->irregularity.n > 0) {
        const rb_rolling_table *of = &rc->irregularity;
        const rb_status s = rb_rolling_interpolant_create(of->n, of->x, of->y, 0, &t->irregular);
        profile *p = &t->table[t->tables];
        if (s != RB_OK)
            return s;
        *p = (profile){.at = irregularity_at, .of = t->irregular, .rows = of->n, .x = of->x};
        p->from = of->x[0];
        p->to = of->x[of->n - 1];
        p->corners = rb_rolling_interpolant_corners(t->irregular, &p->corner, &bend);
        t->tables++;
    }
    if (rc->friction.law == RB_FRICTION_table) {
        const rb_rolling_table *of = &rc->friction.table;
        t->friction = (profile){.at = friction_at, .of = of, .rows = of->n, .x = of->x};
        t->friction.from = t->from;
        t->friction.to = to;
    }
    return RB_OK;
}

/* 1: elements of length h see what the tables of the gap say.  Between two corners below the gap
 * at the edge of the contact lies a facet that is pressed. */
static int sees_gap(const tables *t, double h)
{
    const double most = MOST_PRESSURE * 2.0 * (t->level - t->least) / t->width * h;

    for (int k = 0; k < t->tables; k++) {
        const profile *p = &t->table[k];
        if (h <= shortest(p))
            continue;
        if (misfit_of(p, t->from, h).most > most)
            return 0;
        for (int i = 0; i + 1 < p->corners; i++) {
            const double a = p->corner[i], b = p->corner[i + 1];
            if (a >= p->from && b <= p->to && OF_A_FACET * h > b - a &&
                (p->at != gap_at || fmax(p->at(p->of, a), p->at(p->of, b)) <= t->level))
                return 0;
        }
    }
    return 1;
}

static int sees_friction(const rb_rolling_case *rc, const tables *t, double h)
{
    const profile *p = &t->friction;

    return p->rows < 2 || h <= shortest(p) ||
           misfit_of(p, t->from, h).mean <= MOST_FRICTION * rb_rolling_largest_mu(rc);
}

/* The longest element of n: equal ones are in the first potential contact, which is 1.3 times as
 * wide as the contact; those in the middle of a fitted mesh are pi/2 times as long as others. */
static double longest_of(const rb_rolling_case *rc, double width, double n)
{
    return rc->mesh == RB_MESH_UNIFORM   ? width / n
           : rc->mesh == RB_MESH_ALIGNED ? width / 1.3 / n
                                         : M_PI_2 * width / 1.3 / n;
}

rb_status rb_rolling_elements_for_tables(const rb_rolling_case *rc, int least, int *elements)
{
    tables t;
    double n = least;

    *elements = least;
    if (!has_tables(rc))
        return RB_OK;
    const rb_status s = open_tables(rc, &t);
    const double width = rc->zone > 0.0 ? 2.0 * rc->zone : t.width;
    while (s == RB_OK && width > 0.0 && isfinite(width) && n < MOST &&
           !(sees_gap(&t, longest_of(rc, width, n)) &&
             sees_friction(rc, &t, longest_of(rc, width, n))))
        n *= FINER;
    *elements = (int)ceil(n);
    rb_rolling_interpolant_free(t.irregular);
    return s;
}

rb_status rb_rolling_missed_by_elements(const rb_rolling_case *rc, double *pressure, double *mu)
{
    int wanted;
    tables t;
    rb_status s = rb_rolling_elements_for_tables(rc, rc->contact_elements, &wanted);

    *pressure = *mu = 0.0;
    if (s != RB_OK || wanted == rc->contact_elements)
        return s;
    s = open_tables(rc, &t);
    const double width = rc->zone > 0.0 ? 2.0 * rc->zone : t.width,
                 h = longest_of(rc, width, rc->contact_elements);
    for (int k = 0; k < t.tables && s == RB_OK; k++)
        *pressure += 0.5 * rb_rolling_derive(rc).modulus * misfit_of(&t.table[k], t.from, h).slope;
    if (s == RB_OK && t.friction.rows > 1)
        *mu = misfit_of(&t.friction, t.from, h).mean;
    rb_rolling_interpolant_free(t.irregular);
    return s;
}
