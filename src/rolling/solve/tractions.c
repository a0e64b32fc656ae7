/* Tractions between the midpoints of the contact elements, for the stress below them (B14). */
#include "lcp/contact/contact.h"
#include "rolling/case/derived.h"
#include "rolling/solve/patches.h"
#include "rolling/stress/stress.h"

#include <gsl/gsl_math.h>
#include <string.h>

/* Parts of the interval between the next midpoints, and how many elements at an edge are
 * replaced. */
enum { PARTS = 4, LEAST_REPLACED = 2, MOST_REPLACED = 5 };

/* How much the load of the elements beside an edge may differ from that put in its place, over that
 * of one. */
static const double SAME_LOAD = 0.1;

/* One run of elements in contact.  x: midpoints. */
typedef struct {
    const rb_rolling_case *rc;
    const rb_contact_state *state;
    const double *x, *ends, *p, *q;
    int first, last;
    int nodes; /* between an edge and the outermost midpoint that is trusted */
} patch;

/* Where the pressure goes near an edge: t being the distance outwards from the outermost
 * trusted midpoint `from`, p(t) = p(0) shape(t)^exponent, zero at t = reach.  With
 * reach = 0 nothing is known, and the tractions stay linear between the midpoints. */
typedef struct {
    int from, side;
    double exponent, reach;
    rb_rolling_parabola shape;
} edge;

static double pressure_beyond(const edge *e, double t)
{
    return pow(fmax(rb_rolling_parabola_at(&e->shape, t), 0.0), e->exponent);
}

/* From the outermost trusted midpoint to the edge, less what the elements carry there, over the
 * load of that element. */
static double more_load(const patch *r, const edge *e, double reach)
{
    enum { PARTS_OF_REACH = 64 };
    const int outer = e->side > 0 ? r->last : r->first;
    double carried = 0.5 * r->p[e->from] * (r->ends[e->from + 1] - r->ends[e->from]), load = 0.0;
    for (int j = e->from; j != outer; j += e->side)
        carried += r->p[j + e->side] * (r->ends[j + e->side + 1] - r->ends[j + e->side]);
    for (int i = 0; i < PARTS_OF_REACH; i++)
        load += r->p[e->from] * pressure_beyond(e, reach * (i + 0.5) / PARTS_OF_REACH) * reach /
                PARTS_OF_REACH;
    return (load - carried) / (r->p[e->from] * (r->ends[e->from + 1] - r->ends[e->from]));
}

/* In one zone, or at its bound: an element between stick and slip is in either one by rounding. */
static int slip_alike(const patch *r, int i, int j)
{
    const double of_i = r->q[i] / r->p[i], of_j = r->q[j] / r->p[j];

    return r->state->zone[i] == r->state->zone[j] || fabs(of_i - of_j) <= 1e-9 * fabs(of_j);
}

/* With so many elements replaced, by the parabola through three that lie so many apart. */
static edge edge_with(const patch *r, int side, int replaced, int apart)
{
    const double beta = rb_rolling_derive(r->rc).dundurs;
    const int *zone = r->state->zone, outer = side > 0 ? r->last : r->first, n = r->state->n;
    edge e = {.from = outer - side * replaced, .side = side};
    double d[3], y[3];

    e.exponent = rb_rolling_edge_exponent(r->rc, r->ends[e.from + 1] - r->ends[e.from], r->state,
                                          e.from, side);
    for (int i = 0; i < 3; i++) {
        const int j = e.from - side * i * apart;
        /* Where the friction feeds back on it, the pressure bends at the end of a slip zone. */
        if (beta != 0.0 && !slip_alike(r, j, e.from))
            return e;
        d[i] = side * (r->x[j] - r->x[e.from]);
        y[i] = pow(r->p[j] / r->p[e.from], 1.0 / e.exponent);
    }
    const double reach = rb_rolling_set_parabola(d, y, &e.shape);
    /* An edge lies in the last loaded or in the first open element, not beyond the middle
     * of one that stands between two patches, and the elements that are replaced have about
     * the pressure that is put in their place. */
    const int open = outer + side, beyond = open + side;
    const double inner_end = r->ends[side > 0 ? outer : outer + 1];
    const double outer_end = open < 0 || open >= n ? r->ends[side > 0 ? n : 0]
                             : beyond < 0 || beyond >= n || zone[beyond] == RB_ZONE_SEPARATED
                                 ? r->ends[side > 0 ? open + 1 : open]
                                 : r->x[open];
    for (int j = e.from + side; j != outer; j += side) {
        const double there = pressure_beyond(&e, side * (r->x[j] - r->x[e.from]));
        if (!(fabs(r->p[j] / r->p[e.from] - there) < 0.2 * there))
            return e;
    }
    /* Nor is there more or less of a load: below a sleeve that bends the pressure rises towards an
     * edge, and falls off within fewer elements than the parabola. */
    if (reach > side * (inner_end - r->x[e.from]) && reach < side * (outer_end - r->x[e.from]) &&
        fabs(more_load(r, &e, reach)) < SAME_LOAD)
        e.reach = reach;
    return e;
}

/* The outermost elements carry the error of constant tractions where the true ones start
 * like a root, and the last one may be only partly in contact: those inside of them lead
 * to the edge. */
static edge edge_of(const patch *r, int side)
{
    const int length = r->last - r->first + 1;
    edge e = {.reach = 0.0};

    for (int replaced = (int)fmin(fmax(length / 8, LEAST_REPLACED), MOST_REPLACED);
         replaced >= LEAST_REPLACED && e.reach == 0.0; replaced--)
        for (int apart = 2; apart >= 1 && e.reach == 0.0; apart--)
            if (length >= 2 * (replaced + 2 * apart))
                e = edge_with(r, side, replaced, apart);
    return e;
}

/* The friction over the pressure: in slip that of the friction law, which the elements meet
 * exactly, linear between the midpoints. */
static double ratio_at(const patch *r, int j, double x)
{
    const int side = x < r->x[j] ? -1 : 1, k = j + side;
    const double here = r->q[j] / r->p[j];
    if (k < r->first || k > r->last)
        return here;
    return here + (r->q[k] / r->p[k] - here) * (x - r->x[j]) / (r->x[k] - r->x[j]);
}

static void add_node(rb_bem_edge_load *load, double *x, double *p, double *q, double at,
                     double pressure, double friction)
{
    x[load->n] = at;
    p[load->n] = pressure;
    q[load->n++] = friction;
}

/* The nodes from an edge to its trusted midpoint, or back, at distances from the edge that grow
 * with the fourth power. */
static void add_edge(const patch *r, const edge *e, rb_bem_edge_load *load, double *x, double *p,
                     double *q)
{
    const int outer = e->side > 0 ? r->last : r->first;
    for (int i = 0; i < r->nodes; i++) {
        const int k = e->side < 0 ? i : r->nodes - 1 - i;
        const double d = e->reach * gsl_pow_4((double)k / r->nodes), t = e->reach - d,
                     at = r->x[e->from] + e->side * t;
        /* Chords of a function that starts like a root hold less than it does; with so much
         * more at the nodes they hold the same. */
        const double power = e->exponent,
                     more = k > 0 ? 1.0 + power * (1.0 - power) * 4.0 / 3.0 / (k * k) : 0.0;
        int j = e->from;
        while (j != outer && e->side * (at - r->x[j + e->side]) >= 0.0)
            j += e->side;
        const double pressure = more * r->p[e->from] * pressure_beyond(e, t);
        add_node(load, x, p, q, at, pressure, pressure * ratio_at(r, j, at));
    }
}

/* From one midpoint up to the next, in parts where one of the edges is near: what is linear
 * there is the pressure to the power of 1/exponent. */
static void add_interval(const patch *r, int j, int parts, double exponent, rb_bem_edge_load *load,
                         double *x, double *p, double *q)
{
    for (int i = 0; i < parts; i++) {
        const double w = (double)i / parts, at = r->x[j] + w * (r->x[j + 1] - r->x[j]);
        const double rise = i ? pow(r->p[j + 1] / r->p[j], 1.0 / exponent) : 1.0;
        const double pressure = r->p[j] * pow(1.0 + w * (rise - 1.0), exponent);
        add_node(load, x, p, q, at, i ? pressure : r->p[j],
                 i ? pressure * ratio_at(r, j, at) : r->q[j]);
    }
}

/* ---- Ends of stick ------------------------------------------------------------------ */

/* Where slip begins beside stick the friction has an infinite slope: what is left of its bound,
 * g = f p - q, f the ratio in slip, starts like the root of the distance d from there.  As at an
 * edge g^2 is a parabola, through three elements of the stick zone. */
typedef struct {
    edge of;      /* of g, with its exponent 1/2 */
    int slips;    /* the first element that slips */
    double ratio; /* q/p in slip */
    double least; /* g at the trusted midpoint, with its sign */
} stick_end;

static double unused(const patch *r, int j, double ratio)
{
    return ratio * r->p[j] - r->q[j];
}

/* The stick zone ends behind its element `sticks`, towards `side`; first, last: the elements whose
 * midpoints are trusted beside the edges.  reach = 0: nothing is known. */
static stick_end stick_end_of(const patch *r, int sticks, int side, int first, int last)
{
    const int *zone = r->state->zone;
    const int slips = sticks + side, from = sticks - side * LEAST_REPLACED, inner = from - 2 * side;
    stick_end e = {.of = {.from = from, .side = side, .exponent = 0.5}, .slips = slips};

    /* friction that feeds back on the pressure ends with another power */
    if (rb_rolling_derive(r->rc).dundurs != 0.0 || slips < first || slips > last || inner < first ||
        inner > last || zone[slips] < RB_ZONE_SLIP_NEGATIVE || zone[slips] > RB_ZONE_SLIP_POSITIVE)
        return e;
    double d[3], y[3];
    e.ratio = r->q[slips] / r->p[slips];
    e.least = unused(r, from, e.ratio);
    for (int i = 0; i < 3; i++) {
        const int j = from - side * i;
        if (zone[j] != RB_ZONE_STICK)
            return e;
        d[i] = side * (r->x[j] - r->x[from]);
        y[i] = gsl_pow_2(unused(r, j, e.ratio) / e.least);
    }
    /* between the midpoints of the last element but one that sticks and of the second that slips */
    const int beyond = slips + side, before = sticks - side;
    const double reach = rb_rolling_set_parabola(d, y, &e.of.shape);
    if (beyond >= first && beyond <= last && reach > side * (r->x[before] - r->x[from]) &&
        reach < side * (r->x[beyond] - r->x[from]))
        e.of.reach = reach;
    return e;
}

/* A node on the chord between its neighbours. */
static void insert_node(rb_bem_edge_load *load, double *x, double *p, double *q, double at)
{
    int i = load->n - 1;
    while (i > 0 && x[i] > at)
        i--;
    if (x[i] >= at || i + 1 >= load->n)
        return;
    const double part = (at - x[i]) / (x[i + 1] - x[i]);
    double *const of[] = {x, p, q};
    for (int k = 0; k < 3; k++) {
        const double here = of[k][i] + part * (of[k][i + 1] - of[k][i]);
        memmove(of[k] + i + 2, of[k] + i + 1, (size_t)(load->n - i - 1) * sizeof(double));
        of[k][i + 1] = here;
    }
    load->n++;
}

/* More nodes at an end of stick, as at an edge, and the friction there; at the end itself, k = 0
 * but for rounding, nothing of the bound is left. */
static void add_stick_end(const patch *r, const stick_end *e, rb_bem_edge_load *load, double *x,
                          double *p, double *q)
{
    const int side = e->of.side, nodes = r->nodes / 2;
    const double from = r->x[e->of.from],
                 to = from + side * fmax(e->of.reach, side * (r->x[e->slips] - from));
    for (int k = 0; k < nodes; k++)
        insert_node(load, x, p, q,
                    from + side * e->of.reach * (1.0 - gsl_pow_4((double)k / nodes)));
    for (int i = 0; i < load->n; i++) {
        const double t = side * (x[i] - from),
                     k = nodes * sqrt(sqrt(fmax(1.0 - t / e->of.reach, 0.0)));
        if (t >= 0.0 && side * (to - x[i]) >= 0.0)
            q[i] = e->ratio * p[i] -
                   (k > 0.5 ? (1.0 + 1.0 / (3.0 * k * k)) * e->least * pressure_beyond(&e->of, t)
                            : 0.0);
    }
}

/* Every change from stick to slip or back between two trusted midpoints. */
static void add_stick_ends(const patch *r, int first, int last, rb_bem_edge_load *load, double *x,
                           double *p, double *q)
{
    const int *zone = r->state->zone;
    for (int j = first; j < last; j++)
        for (int side = -1; side <= 1; side += 2) {
            const int sticks = side > 0 ? j : j + 1;
            if (zone[sticks] != RB_ZONE_STICK || zone[sticks + side] == RB_ZONE_STICK)
                continue;
            const stick_end e = stick_end_of(r, sticks, side, first, last);
            if (e.of.reach > 0.0)
                add_stick_end(r, &e, load, x, p, q);
        }
}

static void add_patch(const patch *r, rb_bem_edge_load *load, double *x, double *p, double *q)
{
    const int n = r->state->n;
    const edge left = edge_of(r, -1), right = edge_of(r, 1);
    const int from = left.reach > 0.0 ? left.from : r->first,
              to = right.reach > 0.0 ? right.from : r->last;

    if (left.reach > 0.0)
        add_edge(r, &left, load, x, p, q);
    else {
        /* Open elements carry nothing, at their midpoints too. */
        const double open = from > 0 ? r->x[from - 1] : r->ends[0];
        if (load->n == 0 || open > x[load->n - 1])
            add_node(load, x, p, q, open, 0.0, 0.0);
    }
    for (int j = from; j < to; j++) {
        const int is_left = j - from < to - 1 - j;
        const edge *near = is_left ? &left : &right;
        const int away = is_left ? j - from : to - 1 - j;
        const int parts = near->reach > 0.0 ? (PARTS + away) / (1 + away) : 1;
        add_interval(r, j, parts, near->exponent, load, x, p, q);
    }
    add_node(load, x, p, q, r->x[to], r->p[to], r->q[to]);
    if (right.reach > 0.0)
        add_edge(r, &right, load, x, p, q);
    else
        add_node(load, x, p, q, to + 1 < n ? r->x[to + 1] : r->ends[n], 0.0, 0.0);
    /* after a reversal older ends of stick lie beside this one, and three elements do not tell */
    if (r->rc->formulation == RB_STEADY)
        add_stick_ends(r, from, to, load, x, p, q);
}

rb_status rb_rolling_traction_nodes(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                    const rb_contact_state *state, const double *ends,
                                    const double *p, const double *q, int edge_nodes,
                                    rb_arena *memory, rb_bem_edge_load *load)
{
    const int n = state->n;
    rb_rolling_run run = {.last = -1};
    size_t patches = 0, ends_of_stick = 0;
    while (rb_rolling_next_patch(rc, mesh, state, run.last + 1, &run))
        patches++;
    for (int i = 0; i + 1 < n; i++)
        ends_of_stick += (state->zone[i] == RB_ZONE_STICK) != (state->zone[i + 1] == RB_ZONE_STICK);
    const size_t most = (size_t)n + 2 + patches * 2 * ((size_t)edge_nodes + 3 * PARTS) +
                        ends_of_stick * (size_t)edge_nodes;
    double *middle = rb_arena_doubles(memory, (size_t)n, 1);
    double *nodes = rb_arena_doubles(memory, most, 3);

    if (memory->failed)
        return RB_ENOMEM;
    double *at_p = nodes + most, *at_q = at_p + most;
    for (int i = 0; i < n; i++)
        middle[i] = 0.5 * (ends[i] + ends[i + 1]);
    *load = (rb_bem_edge_load){0, nodes, at_p, at_q};
    for (run.last = -1; rb_rolling_next_patch(rc, mesh, state, run.last + 1, &run);)
        add_patch(&(patch){rc, state, middle, ends, p, q, run.first, run.last, edge_nodes}, load,
                  nodes, at_p, at_q);
    if (patches == 0) {
        add_node(load, nodes, at_p, at_q, ends[0], 0.0, 0.0);
        add_node(load, nodes, at_p, at_q, ends[n], 0.0, 0.0);
    }
    return RB_OK;
}
