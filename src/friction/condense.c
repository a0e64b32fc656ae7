/* K v = H r + f, u = H' v + w  ->  u = W r + q, one body (connected part of K) after the
 * other: W = sum of H_b' K_b^-1 H_b over the bodies.  The bodies of a diagonal or
 * block-diagonal mass are small and are inverted densely; large ones go to CHOLMOD. */
#include "friction/internal.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>

typedef struct {
    const rb_friction_problem *p;
    int bodies;
    int *body;                 /* n: of each degree of freedom */
    int *number;               /* n: its number within the body */
    int *dof;                  /* n: degrees of freedom, body by body */
    int *column;               /* columns of H that touch a body, body by body */
    int *dofs_of, *columns_of; /* bodies + 1: where they start */
    double *f, *v;             /* n: of the present body */
    rb_triplets W;             /* so far */
    double *y;                 /* of the present small body */
    size_t y_room;
    double flops;
} condenser;

static rb_status name_the_nullity(const rb_sparse *k, rb_message *why)
{
    int rank;
    if (rb_sparse_rank(k, &rank) != RB_OK)
        return RB_ENOMEM;
    return rb_fail(why, RB_SINGULAR,
                   "K is singular to rounding (nullity %d): there is no W to condense to",
                   k->rows - rank);
}

/* The entries of a in rows of `body` and in the listed columns, renumbered to rows x
 * cols. */
static rb_status part_of(const condenser *c, const rb_sparse *a, int body, int cols,
                         const int *list, int rows, rb_sparse *part)
{
    int places = 0, n = 0;
    for (int j = 0; j < cols; j++)
        places += a->p[list[j] + 1] - a->p[list[j]];
    int *row = rb_alloc_int((size_t)places), *col = rb_alloc_int((size_t)places);
    double *x = rb_alloc((size_t)places, 1);
    rb_status s = row && col && x ? RB_OK : RB_ENOMEM;
    for (int j = 0; s == RB_OK && j < cols; j++)
        for (int k = a->p[list[j]]; k < a->p[list[j] + 1]; k++)
            if (c->body[a->i[k]] == body)
                row[n] = c->number[a->i[k]], col[n] = j, x[n++] = a->x[k];
    if (s == RB_OK)
        s = rb_sparse_from_triplets(rows, cols, n, row, col, x, part);
    free(x);
    free(col);
    free(row);
    return s;
}

static rb_status append(condenser *c, const int *column, const rb_sparse *w)
{
    rb_triplets *W = &c->W;
    if (rb_triplets_reserve(W, (size_t)w->p[w->cols]) != RB_OK)
        return RB_ENOMEM;
    for (int j = 0; j < w->cols; j++)
        for (int k = w->p[j]; k < w->p[j + 1]; k++) {
            W->row[W->nz] = column[w->i[k]];
            W->col[W->nz] = column[j];
            W->x[W->nz++] = w->x[k];
        }
    return RB_OK;
}

/* ---- A large body
 * ---------------------------------------------------------------------- */

/* q += H_b' K_b^-1 f_b and W += H_b' K_b^-1 H_b */
static rb_status add_large(condenser *c, int body, double *q)
{
    const int n = c->dofs_of[body + 1] - c->dofs_of[body];
    const int cols = c->columns_of[body + 1] - c->columns_of[body];
    const int *dof = c->dof + c->dofs_of[body], *column = c->column + c->columns_of[body];
    rb_sparse k = {0}, h = {0}, w = {0};
    rb_sparse_cholesky *factor = NULL;
    rb_status s = part_of(c, &c->p->K, body, n, dof, n, &k);
    if (s == RB_OK)
        s = part_of(c, &c->p->H, body, cols, column, n, &h);
    if (s == RB_OK)
        s = rb_sparse_cholesky_create(&k, &factor);
    for (int i = 0; i < n; i++)
        c->f[i] = c->p->f[dof[i]];
    if (s == RB_OK)
        s = rb_sparse_cholesky_solve(factor, c->f, c->v);
    for (int j = 0; s == RB_OK && j < cols; j++)
        for (int l = h.p[j]; l < h.p[j + 1]; l++)
            q[column[j]] += h.x[l] * c->v[h.i[l]];
    if (s == RB_OK)
        s = rb_sparse_cholesky_congruence(factor, &h, &w);
    if (s == RB_OK) {
        c->flops += rb_sparse_cholesky_flops(factor);
        s = append(c, column, &w);
    }
    rb_sparse_cholesky_free(factor);
    rb_sparse_free(&w);
    rb_sparse_free(&h);
    rb_sparse_free(&k);
    return s;
}

/* ---- A small body
 * ---------------------------------------------------------------------- */

#define MOST_DOFS 12 /* of a body that is inverted densely */
#define LEAST_PIVOT                                                                      \
    3e-6 /* sqrt(1e-11): of a factor of unit diagonal, as in CHOLMOD's case */

/* K_b = S L L' S with S = diag(K_b)^1/2, so that the pivots tell the rank.  L: the lower
 * triangle of k, column-major. */
static rb_status factor_small(const condenser *c, int body, int n, double *k,
                              double *scale)
{
    const int *dof = c->dof + c->dofs_of[body];
    const rb_sparse *a = &c->p->K;
    for (int i = 0; i < n * n; i++)
        k[i] = 0.0;
    for (int j = 0; j < n; j++)
        for (int l = a->p[dof[j]]; l < a->p[dof[j] + 1]; l++)
            k[c->number[a->i[l]] + j * n] = a->x[l];
    for (int j = 0; j < n; j++) {
        if (!(k[j + j * n] > 0.0))
            return RB_SINGULAR;
        scale[j] = 1.0 / sqrt(k[j + j * n]);
    }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            k[i + j * n] *= scale[i] * scale[j];
    if (n > 1 && LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'L', n, k, n) != 0)
        return RB_SINGULAR;
    for (int j = 0; j < n; j++)
        if (k[j + j * n] < LEAST_PIVOT)
            return RB_SINGULAR;
    return RB_OK;
}

/* x = L^-1 S x */
static void forward(int n, const double *k, const double *scale, double *x)
{
    for (int i = 0; i < n; i++) {
        x[i] *= scale[i];
        for (int j = 0; j < i; j++)
            x[i] -= k[i + j * n] * x[j];
        x[i] /= k[i + i * n];
    }
}

/* Zeros; the memory stays for the next body. */
static double *room_for(condenser *c, size_t size)
{
    if (size > c->y_room) {
        free(c->y);
        c->y = malloc(2 * size * sizeof *c->y);
        c->y_room = c->y ? 2 * size : 0;
    }
    for (size_t k = 0; c->y && k < size; k++)
        c->y[k] = 0.0;
    return c->y;
}

/* The same as add_large, by Y = L^-1 S H_b: W += Y' Y, which is symmetric as it stands.
 */
static rb_status add_small(condenser *c, int body, double *q)
{
    const int n = c->dofs_of[body + 1] - c->dofs_of[body];
    const int cols = c->columns_of[body + 1] - c->columns_of[body];
    const int *dof = c->dof + c->dofs_of[body], *column = c->column + c->columns_of[body];
    const rb_sparse *h = &c->p->H;
    rb_triplets *W = &c->W;
    double k[MOST_DOFS * MOST_DOFS], scale[MOST_DOFS], f[MOST_DOFS];
    const rb_status s = factor_small(c, body, n, k, scale);
    if (s != RB_OK || cols == 0)
        return s;
    double *y = room_for(c, (size_t)n * (size_t)cols);
    if (!y || rb_triplets_reserve(W, (size_t)cols * (size_t)cols) != RB_OK)
        return RB_ENOMEM;
    for (int i = 0; i < n; i++)
        f[i] = c->p->f[dof[i]];
    forward(n, k, scale, f);
    for (int j = 0; j < cols; j++) {
        double *yj = y + (size_t)j * (size_t)n;
        for (int l = h->p[column[j]]; l < h->p[column[j] + 1]; l++)
            if (c->body[h->i[l]] == body)
                yj[c->number[h->i[l]]] = h->x[l];
        forward(n, k, scale, yj);
        for (int i = 0; i < n; i++)
            q[column[j]] += yj[i] * f[i];
        for (int i = 0; i <= j; i++) {
            const double *yi = y + (size_t)i * (size_t)n;
            double sum = 0.0;
            for (int l = 0; l < n; l++)
                sum += yi[l] * yj[l];
            W->row[W->nz] = column[i], W->col[W->nz] = column[j], W->x[W->nz++] = sum;
            if (i < j)
                W->row[W->nz] = column[j], W->col[W->nz] = column[i], W->x[W->nz++] = sum;
        }
    }
    c->flops += (double)n * cols * (n + cols) + (double)n * n * n / 3.0;
    return RB_OK;
}

/* ---- All bodies
 * ------------------------------------------------------------------------- */

/* dof, dofs_of and number: the degrees of freedom body by body. */
static rb_status list_dofs(condenser *c)
{
    const int n = c->p->dofs;
    c->dof = rb_alloc_int((size_t)n);
    c->dofs_of = rb_alloc_int((size_t)c->bodies + 2);
    if (!c->dof || !c->dofs_of)
        return RB_ENOMEM;
    int *next = c->dofs_of + 1; /* one place ahead: filling moves the starts into place */
    for (int i = 0; i < n; i++)
        next[c->body[i] + 1]++;
    for (int b = 0; b < c->bodies; b++)
        next[b + 1] += next[b];
    for (int i = 0; i < n; i++)
        c->dof[next[c->body[i]]++] = i;
    for (int b = 0; b < c->bodies; b++)
        for (int k = c->dofs_of[b]; k < c->dofs_of[b + 1]; k++)
            c->number[c->dof[k]] = k - c->dofs_of[b];
    return RB_OK;
}

/* column and columns_of: the columns of H that touch a body, each once. */
static rb_status list_columns(condenser *c)
{
    const rb_sparse *h = &c->p->H;
    int *last = rb_alloc_int((size_t)c->bodies);
    c->column = rb_alloc_int((size_t)h->p[h->cols]);
    c->columns_of = rb_alloc_int((size_t)c->bodies + 2);
    rb_status s = last && c->column && c->columns_of ? RB_OK : RB_ENOMEM;
    for (int pass = 0; s == RB_OK && pass < 2; pass++) {
        int *next = c->columns_of + 1;
        for (int b = 0; b < c->bodies; b++)
            last[b] = -1;
        for (int j = 0; j < h->cols; j++)
            for (int l = h->p[j]; l < h->p[j + 1]; l++) {
                const int b = c->body[h->i[l]];
                if (last[b] == j)
                    continue;
                last[b] = j;
                if (pass == 0)
                    next[b + 1]++;
                else
                    c->column[next[b]++] = j;
            }
        for (int b = 0; pass == 0 && b < c->bodies; b++)
            next[b + 1] += next[b];
    }
    free(last);
    return s;
}

static rb_status add_bodies(condenser *c, double *q)
{
    rb_status s = list_dofs(c);
    if (s == RB_OK)
        s = list_columns(c);
    for (int body = 0; s == RB_OK && body < c->bodies; body++)
        s = c->dofs_of[body + 1] - c->dofs_of[body] <= MOST_DOFS ? add_small(c, body, q)
                                                                 : add_large(c, body, q);
    return s;
}

static rb_status copy_rest(const rb_friction_problem *global, rb_friction_problem *local)
{
    const int m = global->dimension * global->contacts;
    local->mu = rb_alloc((size_t)global->contacts, 1);
    local->q = rb_alloc((size_t)m, 1);
    if (!local->mu || !local->q)
        return RB_ENOMEM;
    for (int c = 0; c < global->contacts; c++)
        local->mu[c] = global->mu[c];
    for (int k = 0; k < m; k++)
        local->q[k] = global->w[k];
    return RB_OK;
}

static rb_status condense(condenser *c, rb_friction_problem *local)
{
    const size_t n = (size_t)c->p->dofs, m = (size_t)c->p->H.cols;
    c->body = rb_alloc_int(n);
    c->number = rb_alloc_int(n);
    c->f = rb_alloc(n, 1);
    c->v = rb_alloc(n, 1);
    rb_status s = c->body && c->number && c->f && c->v ? RB_OK : RB_ENOMEM;
    if (s == RB_OK)
        s = rb_sparse_components(&c->p->K, &c->bodies, c->body);
    if (s == RB_OK)
        s = add_bodies(c, local->q);
    if (s == RB_OK)
        s = rb_sparse_from_triplets((int)m, (int)m, c->W.nz, c->W.row, c->W.col, c->W.x,
                                    &local->Ws);
    rb_triplets_free(&c->W);
    free(c->v);
    free(c->f);
    free(c->y);
    free(c->columns_of);
    free(c->column);
    free(c->dofs_of);
    free(c->dof);
    free(c->number);
    free(c->body);
    return s;
}

rb_status rb_friction_condense_counted(const rb_friction_problem *global,
                                       rb_friction_problem *local, double *flops,
                                       rb_message *why)
{
    condenser c = {.p = global};
    *local = (rb_friction_problem){.form = RB_FRICTION_LOCAL_SPARSE,
                                   .dimension = global->dimension,
                                   .contacts = global->contacts};
    rb_status s = copy_rest(global, local);
    if (s == RB_OK)
        s = condense(&c, local);
    *flops += c.flops;
    if (s != RB_OK)
        rb_friction_problem_free(local);
    return s == RB_SINGULAR ? name_the_nullity(&global->K, why) : s;
}

rb_status rb_friction_condense(const rb_friction_problem *global,
                               rb_friction_problem *local, rb_message *why)
{
    double flops = 0.0;
    return rb_friction_condense_counted(global, local, &flops, why);
}
