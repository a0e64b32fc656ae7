/* The operator with products only: the linear problems for given zones are solved by
 * GMRES. On equal elements the preconditioner is the inverse for an infinite line; about
 * ten products are needed for any number of elements. */
#include "lcp/contact/gmres.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* With what is kept from solve to solve: fresh memory costs more than the arithmetic. */
typedef struct {
    rb_contact_operator base;
    rb_contact_products by;
    double *r;    /* 2n: tractions of one product; owned, as the rest */
    double *line; /* n: what is preconditioned */
    rb_contact_gmres_scratch scratch;
} products;

static products *of(const rb_contact_problem *p)
{
    return (products *)p->op;
}

static void products_free(rb_contact_operator *op)
{
    products *k = (products *)op;

    k->by.free(k->by.context);
    rb_contact_gmres_free(&k->scratch);
    free(k->r);
    free(k->line);
    free(k);
}

static void products_add(rb_contact_operator *op, const double *p, const double *q, double *gap,
                         double *slip)
{
    const products *k = (const products *)op;
    const int n = op->n;
    const double *added_gap, *added_slip;

    memcpy(k->r, p, (size_t)n * sizeof *p);
    memcpy(k->r + n, q, (size_t)n * sizeof *q);
    k->by.apply(k->by.context, k->r, &added_gap, &added_slip);
    cblas_daxpy(n, 1.0, added_gap, 1, gap, 1);
    cblas_daxpy(n, 1.0, added_slip, 1, slip, 1);
}

/* ---- The system: tractions, and delta and xi at its border ------------------------- */

typedef struct {
    const rb_contact_problem *p;
    const rb_contact_reduced *r;
    const int *zone;
} system_of;

/* Tractions of the unknowns into the memory for products. */
static void scatter(const system_of *s, const double *x)
{
    const rb_contact_problem *p = s->p;
    const rb_contact_reduced *r = s->r;
    double *r_N = of(p)->r, *r_T = r_N + p->n;

    memset(r_N, 0, 2 * (size_t)p->n * sizeof *r_N);
    for (int k = 0; k < r->contacts; k++) {
        const int i = r->contact[k];
        r_N[i] = p->stress * x[k];
        r_T[i] = rb_contact_reduced_friction(p, r, s->zone, i) * r_N[i];
    }
    for (int k = 0; k < r->sticks; k++)
        r_T[r->stick[k]] = p->stress * x[r->contacts + k];
}

/* Of the tractions that were scattered last. */
static void control_rows(const system_of *s, double *y)
{
    const rb_contact_problem *p = s->p;
    const rb_contact_reduced *r = s->r;
    const double *r_N = of(p)->r, *r_T = r_N + p->n;

    if (r->load)
        *y++ = (cblas_ddot(p->n, p->load_N, 1, r_N, 1) + cblas_ddot(p->n, p->load_T, 1, r_T, 1)) /
               p->load;
    if (r->force)
        *y = (cblas_ddot(p->n, r->control_N, 1, r_N, 1) +
              cblas_ddot(p->n, r->control_T, 1, r_T, 1)) /
             r->force_scale;
}

static void border_rows(const void *of_system, const double *x, double *y)
{
    scatter(of_system, x);
    control_rows(of_system, y);
}

/* delta opens no gap, xi makes slip. */
static void border_column(const void *of_system, int k, double *column)
{
    const system_of *s = of_system;
    const rb_contact_reduced *r = s->r;

    memset(column, 0, (size_t)r->size * sizeof *column);
    if (k == 0 && r->load)
        for (int i = 0; i < r->contacts; i++)
            column[i] = -1.0;
    else
        for (int i = 0; i < r->sticks; i++)
            column[r->contacts + i] = s->p->e_T[r->stick[i]] / s->p->e_T[0];
}

static void multiply(const void *of_system, const double *x, double *y)
{
    const system_of *s = of_system;
    const rb_contact_problem *p = s->p;
    const rb_contact_reduced *r = s->r;
    const products *k = of(p);
    const double *gap, *slip;
    const int inner = r->contacts + r->sticks;
    const double delta = r->load ? x[inner] : 0.0;
    const double xi = r->force ? x[inner + r->load] : 0.0;

    scatter(s, x);
    k->by.apply(k->by.context, k->r, &gap, &slip);
    for (int c = 0; c < r->contacts; c++)
        *y++ = gap[r->contact[c]] / p->gap_length - delta;
    for (int c = 0; c < r->sticks; c++) {
        const int i = r->stick[c];
        *y++ = slip[i] / p->slip_length + xi * p->e_T[i] / p->e_T[0];
    }
    control_rows(s, y);
}

/* The unknown tractions in one direction; the equations are in units of `length`. */
typedef struct {
    int tangential, count;
    const int *at; /* count: their elements */
    double length;
} group;

/* The inverse for an infinite line, of the unknown places alone.  What slipping elements owe to the
 * pressure is left out: it is mu times the coupling, small beside the diagonal blocks, and the two
 * groups need one transform each without it. */
static void precondition_group(const system_of *s, const group *g, const double *b, double *x)
{
    const products *op = of(s->p);
    double *line = op->line;

    if (g->count == 0)
        return;
    memset(line, 0, (size_t)s->p->n * sizeof *line);
    for (int k = 0; k < g->count; k++)
        line[g->at[k]] = b[k] * g->length / s->p->stress;
    op->by.precondition(op->by.context, g->tangential, line);
    for (int k = 0; k < g->count; k++)
        x[k] = line[g->at[k]];
}

static void precondition(const void *of_system, const double *b, double *x)
{
    const system_of *s = of_system;
    const rb_contact_problem *p = s->p;
    const rb_contact_reduced *r = s->r;
    const group pressure = {0, r->contacts, r->contact, p->gap_length},
                friction = {1, r->sticks, r->stick, p->slip_length};

    precondition_group(s, &pressure, b, x);
    precondition_group(s, &friction, b + r->contacts, x + r->contacts);
}

static rb_status products_solve(const rb_contact_problem *p, rb_contact_state *state,
                                rb_contact_reduced *r)
{
    const system_of system = {p, r, state->zone};
    const rb_contact_linear linear = {.inner = r->contacts + r->sticks,
                                      .borders = r->load + r->force,
                                      .multiply = multiply,
                                      .precondition = precondition,
                                      .border_column = border_column,
                                      .border_rows = border_rows,
                                      .of = &system};
    enum { ROWS = 2 };
    rb_status s = RB_OK;

    rb_contact_reduced_clear(p, r, state);
    rb_contact_reduced_right_side(p, state, r);
    if (r->size > 0) {
        s = rb_contact_gmres(&linear, &of(p)->scratch, r->x, r->start);
        if (s == RB_OK && r->load) {
            /* GMRES leaves of a given load what its tolerance allows: all unknowns are
             * multiplied by so much where this changes no equation by more than that. */
            double row[ROWS];
            border_rows(&system, r->start, row);
            const double factor = r->x[r->contacts + r->sticks] / row[0];
            if (fabs(factor - 1.0) * rb_norm_inf((size_t)r->size, r->x) <
                RB_CONTACT_GMRES_TOLERANCE)
                cblas_dscal(r->size, factor, r->start, 1);
        }
        if (s == RB_OK)
            memcpy(r->x, r->start, (size_t)r->size * sizeof *r->x);
    }
    return s == RB_OK ? rb_contact_reduced_add(p, r, state) : s;
}

static rb_status products_gmres(rb_contact_operator *op, const rb_contact_linear *linear,
                                const double *b, double *x)
{
    return rb_contact_gmres(linear, &((products *)op)->scratch, b, x);
}

static void products_precondition(rb_contact_operator *op, rb_contact_inverse of, double hardening,
                                  double *line)
{
    const rb_contact_products *by = &((products *)op)->by;

    if (of != RB_INVERSE_YIELDING)
        by->precondition(by->context, of == RB_INVERSE_TANGENTIAL, line);
    else if (by->precondition_yielding)
        by->precondition_yielding(by->context, hardening, line);
}

/* ---- The kind ---------------------------------------------------------------------- */

rb_status rb_contact_operator_products(int n, const rb_contact_products *by,
                                       rb_contact_operator **op)
{
    static const rb_contact_kind kind = {.add = products_add,
                                         .solve = products_solve,
                                         .gmres = products_gmres,
                                         .precondition = products_precondition,
                                         .free = products_free};
    products *k = calloc(1, sizeof *k);

    *op = NULL;
    if (!k) {
        by->free(by->context);
        return RB_ENOMEM;
    }
    k->base = (rb_contact_operator){.kind = &kind, .n = n};
    k->by = *by;
    k->r = rb_alloc((size_t)n, 2);
    k->line = rb_alloc((size_t)n, 1);
    k->scratch.size = 2 * (size_t)n + 2;
    if (!k->r || !k->line) {
        products_free(&k->base);
        return RB_ENOMEM;
    }
    /* On equal elements the middle one stands for all; k->r is zero to begin with. */
    const int j = n / 2;
    rb_contact_response *unit = &k->base.response;
    const double *gap, *slip;

    k->r[j] = 1.0;
    k->by.apply(k->by.context, k->r, &gap, &slip);
    unit->gap = fabs(gap[j]);
    unit->coupled_slip = rb_norm_1((size_t)n, slip, 1);
    unit->coupled = unit->coupled_slip != 0.0;
    unit->reach = rb_norm_1((size_t)n, gap, 1) / unit->gap;
    k->r[j] = 0.0;
    k->r[n + j] = 1.0;
    k->by.apply(k->by.context, k->r, &gap, &slip);
    unit->slip = fabs(slip[j]);
    *op = &k->base;
    return RB_OK;
}
