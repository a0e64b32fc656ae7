/* The operator as products alone: zones are solved by GMRES.  On equal elements the
 * inverse of an endless line preconditions it: about ten products for any number of
 * elements. */
#include "contact/internal.h"

#include <cblas.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BASIS = 100, CYCLES = 6, BORDERS = 2 };
/* 2-norm of the scaled residual at which a solve ends. */
static const double TOLERANCE = 2e-11;

/* With what is kept from solve to solve: fresh memory costs more than the arithmetic. */
typedef struct {
    rb_contact_operator base;
    rb_contact_products by;
    double *r;                /* 2n: tractions of one product; owned, as the rest */
    double *line;             /* n: what is preconditioned */
    double *basis[BASIS + 1]; /* 2n + 2 each, on demand */
    double *work;             /* 2n + 2 */
} products;

static products *of(const rb_contact_problem *p)
{
    return (products *)p->op;
}

static void products_free(rb_contact_operator *op)
{
    products *k = (products *)op;

    k->by.free(k->by.context);
    for (int j = 0; j <= BASIS; j++)
        free(k->basis[j]);
    free(k->work);
    free(k->r);
    free(k->line);
    free(k);
}

static void products_add(rb_contact_operator *op, const double *p, const double *q,
                         double *gap, double *slip)
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

/* On equal elements the middle one stands for all; k->r is zero to begin with. */
static void set_response(products *k)
{
    const int n = k->base.n, j = n / 2;
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
}

/* ---- The system  [A B; C 0]: tractions, and delta and xi at its border ------------- */

typedef struct {
    const rb_contact_problem *p;
    const rb_contact_reduced *r;
    const int *zone;
    int inner;                       /* tractions; the border comes after them */
    int borders;                     /* 0, 1 or 2 */
    double *image[BORDERS];          /* P^-1 B; owned */
    double schur[BORDERS * BORDERS]; /* -C P^-1 B */
} system_of;

/* Tractions of the unknowns into the room for products. */
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

/* C x for the tractions that were scattered last. */
static void border_rows(const system_of *s, double *y)
{
    const rb_contact_problem *p = s->p;
    const rb_contact_reduced *r = s->r;
    const double *r_N = of(p)->r, *r_T = r_N + p->n;

    if (r->load)
        *y++ = (cblas_ddot(p->n, p->load_N, 1, r_N, 1) +
                cblas_ddot(p->n, p->load_T, 1, r_T, 1)) /
               p->load;
    if (r->force)
        *y = (cblas_ddot(p->n, r->control_N, 1, r_N, 1) +
              cblas_ddot(p->n, r->control_T, 1, r_T, 1)) /
             r->force_scale;
}

/* Column k of B: delta opens no gap, xi makes slip. */
static void border_column(const system_of *s, int k, double *column)
{
    const rb_contact_reduced *r = s->r;

    memset(column, 0, (size_t)r->size * sizeof *column);
    if (k == 0 && r->load)
        for (int i = 0; i < r->contacts; i++)
            column[i] = -1.0;
    else
        for (int i = 0; i < r->sticks; i++)
            column[r->contacts + i] = s->p->e_T[r->stick[i]] / s->p->e_T[0];
}

static void multiply(const system_of *s, const double *x, double *y)
{
    const rb_contact_problem *p = s->p;
    const rb_contact_reduced *r = s->r;
    const products *k = of(p);
    const double *gap, *slip;
    const double delta = r->load ? x[s->inner] : 0.0;
    const double xi = r->force ? x[s->inner + r->load] : 0.0;

    scatter(s, x);
    k->by.apply(k->by.context, k->r, &gap, &slip);
    for (int c = 0; c < r->contacts; c++)
        *y++ = gap[r->contact[c]] / p->gap_length - delta;
    for (int c = 0; c < r->sticks; c++) {
        const int i = r->stick[c];
        *y++ = slip[i] / p->slip_length + xi * p->e_T[i] / p->e_T[0];
    }
    border_rows(s, y);
}

/* ---- The preconditioner  P = [A~ B; C 0] ------------------------------------------- */

/* The unknown tractions in one direction; the equations are in units of `length`. */
typedef struct {
    int tangential, count;
    const int *at; /* count: their elements */
    double length;
} group;

/* What slipping elements owe to the pressure is left out of A~. */
static void precondition_group(const system_of *s, const group *g, const double *b,
                               double *x)
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

static void precondition_tractions(const system_of *s, const double *b, double *x)
{
    const rb_contact_problem *p = s->p;
    const rb_contact_reduced *r = s->r;
    const group pressure = {0, r->contacts, r->contact, p->gap_length},
                friction = {1, r->sticks, r->stick, p->slip_length};

    precondition_group(s, &pressure, b, x);
    precondition_group(s, &friction, b + r->contacts, x + r->contacts);
}

static void solve_border(const system_of *s, const double *g, double *z)
{
    const double *S = s->schur;

    if (s->borders == 1) {
        z[0] = g[0] / S[0];
        return;
    }
    const double det = S[0] * S[3] - S[1] * S[2];
    z[0] = (S[3] * g[0] - S[2] * g[1]) / det;
    z[1] = (S[0] * g[1] - S[1] * g[0]) / det;
}

static void precondition(const system_of *s, const double *b, double *x)
{
    double g[BORDERS], z[BORDERS];

    precondition_tractions(s, b, x);
    if (s->borders == 0)
        return;
    scatter(s, x);
    border_rows(s, g);
    for (int l = 0; l < s->borders; l++)
        g[l] = b[s->inner + l] - g[l];
    solve_border(s, g, z);
    for (int l = 0; l < s->borders; l++) {
        cblas_daxpy(s->inner, -z[l], s->image[l], 1, x, 1);
        x[s->inner + l] = z[l];
    }
}

static void system_free(system_of *s)
{
    for (int l = 0; l < BORDERS; l++)
        free(s->image[l]);
}

static rb_status system_make(const rb_contact_problem *p, const int *zone,
                             const rb_contact_reduced *r, system_of *s)
{
    double *column = of(p)->work;

    *s = (system_of){.p = p,
                     .r = r,
                     .zone = zone,
                     .inner = r->contacts + r->sticks,
                     .borders = r->load + r->force};
    for (int l = 0; l < s->borders; l++) {
        s->image[l] = rb_alloc((size_t)r->size, 1);
        if (!s->image[l])
            return RB_ENOMEM;
        border_column(s, l, column);
        precondition_tractions(s, column, s->image[l]);
        scatter(s, s->image[l]);
        border_rows(s, s->schur + BORDERS * l);
    }
    for (int k = 0; k < BORDERS * BORDERS; k++)
        s->schur[k] = -s->schur[k];
    return RB_OK;
}

/* ---- GMRES (Saad and Schultz), preconditioned from the right ----------------------- */

typedef struct {
    double H[BASIS][BASIS + 1]; /* columns of the Hessenberg matrix, rotated */
    double c[BASIS], s[BASIS];  /* rotations */
    double g[BASIS + 1];
} least_squares;

static double *basis_vector(const rb_contact_problem *p, int j)
{
    double **v = &of(p)->basis[j];
    if (!*v)
        *v = malloc((2 * (size_t)p->n + 2) * sizeof **v);
    return *v;
}

/* Column j: orthogonalised, its length in the last row; 0 where the space is exhausted.
 */
static int orthogonalise(const rb_contact_problem *p, int size, int j, double *column)
{
    double *const *v = of(p)->basis, *last = v[j + 1];

    for (int i = 0; i <= j; i++) {
        column[i] = cblas_ddot(size, last, 1, v[i], 1);
        cblas_daxpy(size, -column[i], v[i], 1, last, 1);
    }
    column[j + 1] = cblas_dnrm2(size, last, 1);
    if (!(column[j + 1] > 0.0))
        return 0;
    cblas_dscal(size, 1.0 / column[j + 1], last, 1);
    return 1;
}

/* Rotates column j into upper triangular form; returns the new residual. */
static double rotate(least_squares *q, int j)
{
    double *column = q->H[j];

    for (int i = 0; i < j; i++) {
        const double a = column[i], b = column[i + 1];
        column[i] = q->c[i] * a + q->s[i] * b;
        column[i + 1] = -q->s[i] * a + q->c[i] * b;
    }
    const double length = hypot(column[j], column[j + 1]);
    q->c[j] = column[j] / length;
    q->s[j] = column[j + 1] / length;
    column[j] = length;
    q->g[j + 1] = -q->s[j] * q->g[j];
    q->g[j] *= q->c[j];
    return fabs(q->g[j + 1]);
}

/* x += P^-1 V y after `count` steps; the vector behind the basis is room. */
static void add_correction(const system_of *s, least_squares *q, int count, double *x)
{
    const products *k = of(s->p);
    double *sum = k->basis[count];

    for (int i = count - 1; i >= 0; i--) {
        for (int l = i + 1; l < count; l++)
            q->g[i] -= q->H[l][i] * q->g[l];
        q->g[i] /= q->H[i][i];
    }
    memset(sum, 0, (size_t)s->r->size * sizeof *sum);
    for (int i = 0; i < count; i++)
        cblas_daxpy(s->r->size, q->g[i], k->basis[i], 1, sum, 1);
    precondition(s, sum, k->work);
    cblas_daxpy(s->r->size, 1.0, k->work, 1, x, 1);
}

/* v_0 = b - A x, normalised; returns its length. */
static double begin_cycle(const system_of *s, const double *b, const double *x, double *v)
{
    const int size = s->r->size;

    multiply(s, x, v);
    for (int i = 0; i < size; i++)
        v[i] = b[i] - v[i];
    const double length = cblas_dnrm2(size, v, 1);
    if (length > 0.0)
        cblas_dscal(size, 1.0 / length, v, 1);
    return length;
}

/* One cycle from x; *residual: of x before it. */
static rb_status cycle(const system_of *s, const double *b, double tolerance,
                       least_squares *q, double *x, double *residual)
{
    const rb_contact_problem *p = s->p;
    double *v = basis_vector(p, 0);
    int count = 0;

    if (!v)
        return RB_ENOMEM;
    q->g[0] = *residual = begin_cycle(s, b, x, v);
    for (double rest = *residual; count < BASIS && rest > tolerance; count++) {
        double *next = basis_vector(p, count + 1);
        if (!next)
            return RB_ENOMEM;
        precondition(s, of(p)->basis[count], of(p)->work);
        multiply(s, of(p)->work, next);
        const int goes_on = orthogonalise(p, s->r->size, count, q->H[count]);
        rest = goes_on ? rotate(q, count) : (rotate(q, count), 0.0);
    }
    if (count > 0)
        add_correction(s, q, count, x);
    return RB_OK;
}

/* Cycles until the true residual is small, or no longer falls: then it is rounding. */
static rb_status gmres(const system_of *s, const double *b, double *x)
{
    const double rounding = 2.0 * DBL_EPSILON * cblas_dnrm2(s->r->size, b, 1);
    const double tolerance = fmax(TOLERANCE, rounding);
    least_squares *q = malloc(sizeof *q);
    rb_status status = q ? RB_OK : RB_ENOMEM;
    double before = INFINITY, residual = INFINITY;

    for (int k = 0; k < CYCLES && status == RB_OK; k++) {
        status = cycle(s, b, tolerance, q, x, &residual);
        if (!(residual > tolerance) || residual > 0.1 * before)
            break;
        before = residual;
    }
    free(q);
    return status;
}

static rb_status products_solve(const rb_contact_problem *p, rb_contact_state *state,
                                rb_contact_reduced *r)
{
    system_of system = {0};
    rb_status s = RB_OK;

    rb_contact_reduced_clear(p, r, state);
    rb_contact_reduced_right_side(p, state, r);
    if (r->size > 0) {
        s = system_make(p, state->zone, r, &system);
        if (s == RB_OK)
            s = gmres(&system, r->x, r->start);
        if (s == RB_OK)
            memcpy(r->x, r->start, (size_t)r->size * sizeof *r->x);
        system_free(&system);
    }
    return s == RB_OK ? rb_contact_reduced_add(p, r, state) : s;
}

/* ---- The kind ---------------------------------------------------------------------- */

rb_status rb_contact_operator_products(int n, const rb_contact_products *by,
                                       rb_contact_operator **op)
{
    static const rb_contact_kind kind = {
        .add = products_add, .solve = products_solve, .free = products_free};
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
    k->work = rb_alloc(2 * (size_t)n + 2, 1);
    if (!k->r || !k->line || !k->work) {
        products_free(&k->base);
        return RB_ENOMEM;
    }
    set_response(k);
    *op = &k->base;
    return RB_OK;
}
