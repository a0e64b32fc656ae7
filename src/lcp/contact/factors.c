/* The reduced problem with a matrix: the LU of the tractions' block A is kept from solve
 * to solve.  What has changed since then, and delta and xi, stand at its border:
 *     [A V; W T] (x, y) = (f, g),  (T - W A^-1 V) y = g - W A^-1 f,
 * so that a Newton step costs some products instead of an LU. */
#include "lcp/contact/dense.h"

#include <cblas.h>
#include <float.h>
#include <lapacke.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Tractions at an element per unit of an unknown. */
typedef struct {
    int at;
    double N, T;
} traction;

/* The LU for the zones of an earlier solve: unknowns (and their equations, gap or slip at
 * the same element) in the order of rb_contact_reduced. */
typedef struct {
    int contacts, size, capacity;
    traction *unknown;
    double *LU;
    double along; /* as in rb_contact_dense */
    lapack_int *pivots;
} kept_lu;

/* A change of friction per pressure that the LU need not know: solved again, what it
 * leaves falls by about as much each time.  Coefficients that depend on the state change
 * at every element from round to round, ever less. */
static const double SLIGHT = 0.01;

/* One for each of RB_NORMAL, RB_TANGENTIAL, RB_BOTH. */
struct rb_contact_factors {
    kept_lu kept[3];
};

/* One equation and one unknown at the border of A. */
typedef struct {
    enum {
        LAPSED,      /* unknown `place` of A is zero; its equation has slack */
        TURNED,      /* friction of unknown `place` follows its pressure otherwise */
        NEW_CONTACT, /* gap zero; tractions */
        NEW_STICK,   /* slip zero; traction */
        APPROACH,    /* given load; delta */
        CREEPAGE     /* given force; xi */
    } kind;
    int place;
    traction unknown;
} border;

typedef struct {
    traction *unknown; /* present ones, without delta and xi; in scratch memory, as all here */
    int *source;       /* of r->x among (x, y) */
    border *border;
    int count, changes; /* borders; those that stand for zones */
    int slight;         /* unknowns that have turned, and so little that none stands for it */
} plan;

void rb_contact_factors_clear(rb_contact_factors *factors)
{
    for (int k = 0; k < 3; k++) {
        free(factors->kept[k].unknown);
        free(factors->kept[k].LU);
        free(factors->kept[k].pivots);
        factors->kept[k] = (kept_lu){0};
    }
}

void rb_contact_factors_move(rb_contact_factors *factors, double from, double to)
{
    for (int k = 0; k < 3; k++) {
        kept_lu *kept = &factors->kept[k];
        if (kept->along != from)
            kept->size = kept->contacts = 0;
        kept->along = to;
    }
}

void rb_contact_factors_free(rb_contact_factors *factors)
{
    rb_contact_factors_clear(factors);
    free(factors);
}

rb_status rb_contact_factors_create(rb_contact_factors **factors)
{
    *factors = calloc(1, sizeof **factors);
    return *factors ? RB_OK : RB_ENOMEM;
}

/* ---- Entries, scaled to numbers of order one --------------------------------------- */

/* Where a load is given, together with what its LU adds to all gaps alike. */
static double along_of(const rb_contact_problem *p)
{
    return p->load_given ? ((const rb_contact_dense *)p->op)->along : 0.0;
}

static double gap_of(const rb_contact_problem *p, int i, traction t)
{
    const rb_contact_matrix *K = &p->op->matrix;
    const double *F = K->F + i + (size_t)t.at * (size_t)K->ldf;
    const double N = t.N != 0.0 ? t.N * (F[0] + along_of(p) * p->load_N[t.at]) : 0.0;
    const double T = t.T != 0.0 ? t.T * F[(size_t)p->n * (size_t)K->ldf] : 0.0;
    return (N + T) * (p->stress / p->gap_length);
}

static double slip_of(const rb_contact_problem *p, int i, traction t)
{
    const size_t n = (size_t)p->n;
    const double *S = p->op->matrix.S + i + (size_t)t.at * n;
    const double N = t.N != 0.0 ? t.N * S[0] : 0.0;
    const double T = t.T != 0.0 ? t.T * S[n * n] : 0.0;
    return (N + T) * (p->stress / p->slip_length);
}

/* Answer of a border's equation to tractions. */
static double border_row(const rb_contact_problem *p, const rb_contact_reduced *r, const border *b,
                         traction t)
{
    switch (b->kind) {
    case NEW_CONTACT:
        return gap_of(p, b->unknown.at, t);
    case NEW_STICK:
        return slip_of(p, b->unknown.at, t);
    case APPROACH:
        return (t.N * p->load_N[t.at] + t.T * p->load_T[t.at]) * (p->stress / p->load);
    case CREEPAGE:
        return (t.N * r->control_N[t.at] + t.T * r->control_T[t.at]) * (p->stress / r->force_scale);
    default:
        return 0.0;
    }
}

/* Answer of one border's equation to another one's unknown, or to its own. */
static double corner(const rb_contact_problem *p, const rb_contact_reduced *r, const border *row,
                     const border *column)
{
    switch (column->kind) {
    case LAPSED:
        return 0.0;
    case APPROACH:
        return row->kind == NEW_CONTACT ? -1.0 : 0.0;
    case CREEPAGE:
        return row->kind == NEW_STICK ? p->e_T[row->unknown.at] / p->e_T[0] : 0.0;
    default:
        return row->kind != TURNED ? border_row(p, r, row, column->unknown)
               : row == column     ? -1.0
                                   : 0.0;
    }
}

/* ---- What has changed since the LU ------------------------------------------------- */

static int add_border(plan *pl, border b)
{
    pl->border[pl->count] = b;
    return pl->count++;
}

/* Compares kept unknowns from ... to - 1 with the present ones now ... end - 1, both in
 * the order of their elements. */
static void compare_zones(const kept_lu *k, int from, int to, int now, int end, plan *pl)
{
    while (from < to || now < end) {
        const int was = from < to ? k->unknown[from].at : INT_MAX;
        const int is = now < end ? pl->unknown[now].at : INT_MAX;
        if (was < is) {
            add_border(pl, (border){LAPSED, from++, {0}});
        } else if (is < was) {
            const traction t = pl->unknown[now];
            const border b = {t.N == 0.0 ? NEW_STICK : NEW_CONTACT, 0, t};
            pl->source[now++] = k->size + add_border(pl, b);
        } else {
            const double turn = pl->unknown[now].T - k->unknown[from].T;
            if (fabs(turn) > SLIGHT)
                add_border(pl, (border){TURNED, from, {is, 0.0, turn}});
            else
                pl->slight += turn != 0.0;
            pl->source[now++] = from++;
        }
    }
}

static void make_plan(const rb_contact_problem *p, const int *zone, const rb_contact_reduced *r,
                      const kept_lu *k, plan *pl)
{
    const int tractions = r->contacts + r->sticks;

    /* Where both groups are unknown, friction of a slipping element follows its pressure. */
    traction *unknown = pl->unknown;
    for (int c = 0; c < r->contacts; c++) {
        const int i = r->contact[c];
        *unknown++ = (traction){i, 1.0, rb_contact_reduced_friction(p, r, zone, i)};
    }
    for (int c = 0; c < r->sticks; c++)
        *unknown++ = (traction){r->stick[c], 0.0, 1.0};
    pl->count = pl->slight = 0;
    compare_zones(k, 0, k->contacts, 0, r->contacts, pl);
    compare_zones(k, k->contacts, k->size, r->contacts, tractions, pl);
    pl->changes = pl->count;
    if (r->load)
        pl->source[tractions] = k->size + add_border(pl, (border){APPROACH, 0, {0}});
    if (r->force)
        pl->source[tractions + r->load] = k->size + add_border(pl, (border){CREEPAGE, 0, {0}});
}

/* ---- The LU ------------------------------------------------------------------------ */

static rb_status make_room(int size, kept_lu *k)
{
    if (size <= k->capacity)
        return RB_OK;
    free(k->unknown);
    free(k->LU);
    free(k->pivots);
    k->unknown = calloc((size_t)size, sizeof *k->unknown);
    k->LU = rb_alloc((size_t)size, (size_t)size);
    k->pivots = calloc((size_t)size, sizeof *k->pivots);
    k->capacity = k->unknown && k->LU && k->pivots ? size : 0;
    return k->capacity ? RB_OK : RB_ENOMEM;
}

static rb_status factor(const rb_contact_problem *p, const rb_contact_reduced *r,
                        const traction *unknown, kept_lu *k)
{
    const int size = r->contacts + r->sticks;

    k->size = k->contacts = 0; /* nothing is kept where this fails */
    const rb_status s = make_room(size, k);
    if (s != RB_OK || size == 0)
        return s;
    memcpy(k->unknown, unknown, (size_t)size * sizeof *unknown);
    k->along = along_of(p);
    for (int j = 0; j < size; j++) {
        double *column = k->LU + (size_t)j * (size_t)size;
        for (int i = 0; i < r->contacts; i++)
            column[i] = gap_of(p, unknown[i].at, unknown[j]);
        for (int i = r->contacts; i < size; i++)
            column[i] = slip_of(p, unknown[i].at, unknown[j]);
    }
    if (LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, size, size, k->LU, size, k->pivots) != 0)
        return RB_SINGULAR;
    k->size = size;
    k->contacts = r->contacts;
    return RB_OK;
}

/* ---- Solving ----------------------------------------------------------------------- */

/* Columns V, later A^-1 V, rows W and the corner T, later the LU of T - W A^-1 V. */
typedef struct {
    double *V, *W, *T;
} bordered;

struct rb_contact_elimination {
    const rb_contact_problem *p;
    const kept_lu *k;
    kept_lu none; /* all unknowns are borders then */
    plan plan;
    bordered m;
    double *f; /* with g behind it */
    lapack_int *pivots;
    rb_arena memory;
};

static void fill_border(const rb_contact_problem *p, const rb_contact_reduced *r, const kept_lu *k,
                        const plan *pl, const bordered *m)
{
    const int n = k->size, count = pl->count;

    for (int b = 0; b < count; b++) {
        const border *row = &pl->border[b];
        /* Answer of A's equations to a border's unknown. */
        double *column = m->V + (size_t)b * (size_t)n;
        const int is_traction =
            row->kind == TURNED || row->kind == NEW_CONTACT || row->kind == NEW_STICK;

        for (int i = 0; i < k->contacts; i++)
            column[i] = is_traction             ? gap_of(p, k->unknown[i].at, row->unknown)
                        : row->kind == APPROACH ? -1.0
                                                : 0.0;
        for (int i = k->contacts; i < k->size; i++)
            column[i] = is_traction             ? slip_of(p, k->unknown[i].at, row->unknown)
                        : row->kind == CREEPAGE ? p->e_T[k->unknown[i].at] / p->e_T[0]
                                                : 0.0;
        if (row->kind == LAPSED)
            column[row->place] = 1.0;
        for (int j = 0; j < n; j++)
            m->W[b + (size_t)j * (size_t)count] = border_row(p, r, row, k->unknown[j]);
        if (row->kind == LAPSED || row->kind == TURNED)
            m->W[b + (size_t)row->place * (size_t)count] = 1.0;
        for (int c = 0; c < count; c++)
            m->T[b + (size_t)c * (size_t)count] = corner(p, r, row, &pl->border[c]);
    }
}

void rb_contact_elimination_end(rb_contact_elimination *e)
{
    if (e)
        rb_arena_free(&e->memory);
    free(e);
}

rb_status rb_contact_elimination_begin(const rb_contact_problem *p, const int *zone,
                                       rb_contact_lu lu, rb_contact_reduced *r,
                                       rb_contact_elimination **elimination)
{
    rb_contact_factors *factors = ((rb_contact_dense *)p->op)->factors;
    rb_contact_elimination *e = *elimination = calloc(1, sizeof *e);

    if (!e)
        return RB_ENOMEM;
    kept_lu *k = lu == RB_LU_WHOLE ? &e->none : &factors->kept[r->unknowns - 1];
    plan *pl = &e->plan;
    bordered *m = &e->m;
    /* All arrays at their largest: every kept unknown lapsed, every present one new. */
    const size_t size = (size_t)r->size + 1;
    e->p = p;
    e->k = k;
    pl->unknown = rb_arena_zeros(&e->memory, size, sizeof *pl->unknown);
    pl->source = rb_arena_ints(&e->memory, size);
    pl->border = rb_arena_zeros(&e->memory, size + (size_t)k->size, sizeof *pl->border);
    if (e->memory.failed)
        return RB_ENOMEM;
    /* Compare the kept unknowns with the present ones: what has changed becomes a border. */
    make_plan(p, zone, r, k, pl);
    /* A border of b costs 2 b size^2 operations per step and an LU 2/3 size^3 once in a few
     * steps: least in sum where b is about the root of twice the size. */
    if (lu == RB_LU_NEW || (lu == RB_LU_KEPT && k->along != along_of(p)) ||
        (lu == RB_LU_KEPT && !((double)pl->changes * pl->changes <= 2.0 * k->size))) {
        const rb_status s = factor(p, r, pl->unknown, k);
        if (s != RB_OK)
            return s;
        make_plan(p, zone, r, k, pl);
    }
    r->changes = k->size > 0 ? pl->changes : 0;
    r->slight = k->size > 0 ? pl->slight : 0;
    const int n = k->size, count = pl->count;
    m->V = rb_arena_doubles(&e->memory, (size_t)n, (size_t)count);
    m->W = rb_arena_doubles(&e->memory, (size_t)count, (size_t)n);
    m->T = rb_arena_doubles(&e->memory, (size_t)count, (size_t)count);
    e->f = rb_arena_doubles(&e->memory, (size_t)(n + count), 1);
    e->pivots = rb_arena_zeros(&e->memory, (size_t)count, sizeof *e->pivots);
    if (e->memory.failed)
        return RB_ENOMEM;
    /* The borders V, W, T, and A eliminated from them by its LU: T - W A^-1 V. */
    fill_border(p, r, k, pl, m);
    if (count == 0)
        return RB_OK;
    if (n > 0) {
        LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', n, count, k->LU, n, k->pivots, m->V, n);
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, count, count, n, -1.0, m->W, count,
                    m->V, n, 1.0, m->T, count);
    }
    return LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, count, count, m->T, count, e->pivots) == 0
               ? RB_OK
               : RB_SINGULAR;
}

void rb_contact_elimination_solve(rb_contact_elimination *e, rb_contact_reduced *r)
{
    const kept_lu *k = e->k;
    const int n = k->size, count = e->plan.count;
    double *f = e->f, *g = f + n;
    const double along = along_of(e->p),
                 missing_load = r->load ? r->x[r->contacts + r->sticks] * e->p->load : 0.0;

    /* (f, g): the right-hand side, in the order of A's unknowns and then of the borders. */
    memset(f, 0, (size_t)(n + count) * sizeof *f);
    for (int i = 0; i < r->size; i++)
        f[e->plan.source[i]] = r->x[i];
    if (n > 0)
        LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', n, 1, k->LU, n, k->pivots, f, n);
    r->growth = rb_norm_inf((size_t)n, f);
    if (count > 0) {
        if (n > 0)
            cblas_dgemv(CblasColMajor, CblasNoTrans, count, n, -1.0, e->m.W, count, f, 1, 1.0, g,
                        1);
        LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', count, 1, e->m.T, count, e->pivots, g, count);
        if (n > 0)
            cblas_dgemv(CblasColMajor, CblasNoTrans, n, count, -1.0, e->m.V, n, g, 1, 1.0, f, 1);
    }
    r->growth /= fmax(rb_norm_inf((size_t)n, f), DBL_MIN); /* the digits that cancel */
    for (int i = 0; i < r->size; i++)
        r->x[i] = f[e->plan.source[i]];
    /* The LU adds the same gap under every load (dense.h), which the approach takes off again. */
    if (r->load)
        r->x[r->contacts + r->sticks] -= along * missing_load / e->p->gap_length;
}
