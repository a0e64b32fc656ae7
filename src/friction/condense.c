/* K v = H r + f, u = H' v + w  ->  u = W r + q, one body (connected part of K) after the
 * other: W = sum of H_b' K_b^-1 H_b over the bodies. */
#include "rollbem/friction.h"

#include <stdlib.h>

typedef struct {
    const rb_friction_problem *p;
    int bodies;
    int *body;     /* n: of each degree of freedom */
    int *number;   /* n: its number within the body */
    int *column;   /* m: columns of H that touch the present body */
    double *f, *v; /* n: of the present body */
    rb_triplets W; /* so far */
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

static int touches(const condenser *c, int column, int body)
{
    const rb_sparse *h = &c->p->H;
    for (int k = h->p[column]; k < h->p[column + 1]; k++)
        if (c->body[h->i[k]] == body)
            return 1;
    return 0;
}

static rb_status append(condenser *c, const rb_sparse *w)
{
    rb_triplets *W = &c->W;
    if (rb_triplets_reserve(W, (size_t)w->p[w->cols]) != RB_OK)
        return RB_ENOMEM;
    for (int j = 0; j < w->cols; j++)
        for (int k = w->p[j]; k < w->p[j + 1]; k++) {
            W->row[W->nz] = c->column[w->i[k]];
            W->col[W->nz] = c->column[j];
            W->x[W->nz++] = w->x[k];
        }
    return RB_OK;
}

/* q += H_b' K_b^-1 f_b and W += H_b' K_b^-1 H_b; dof: the body's own, n of them */
static rb_status add_body(condenser *c, int body, int n, const int *dof, double *q)
{
    rb_sparse k = {0}, h = {0}, w = {0};
    rb_sparse_cholesky *factor = NULL;
    int cols = 0;
    for (int j = 0; j < c->p->H.cols; j++)
        if (touches(c, j, body))
            c->column[cols++] = j;
    rb_status s = part_of(c, &c->p->K, body, n, dof, n, &k);
    if (s == RB_OK)
        s = part_of(c, &c->p->H, body, cols, c->column, n, &h);
    if (s == RB_OK)
        s = rb_sparse_cholesky_create(&k, &factor);
    for (int i = 0; i < n; i++)
        c->f[i] = c->p->f[dof[i]];
    if (s == RB_OK)
        s = rb_sparse_cholesky_solve(factor, c->f, c->v);
    for (int j = 0; s == RB_OK && j < cols; j++)
        for (int l = h.p[j]; l < h.p[j + 1]; l++)
            q[c->column[j]] += h.x[l] * c->v[h.i[l]];
    if (s == RB_OK)
        s = rb_sparse_cholesky_congruence(factor, &h, &w);
    if (s == RB_OK)
        s = append(c, &w);
    rb_sparse_cholesky_free(factor);
    rb_sparse_free(&w);
    rb_sparse_free(&h);
    rb_sparse_free(&k);
    return s;
}

static rb_status add_bodies(condenser *c, double *q)
{
    const int n = c->p->dofs;
    int *dof = rb_alloc_int((size_t)n);
    rb_status s = dof ? RB_OK : RB_ENOMEM;
    for (int body = 0; s == RB_OK && body < c->bodies; body++) {
        int count = 0;
        for (int i = 0; i < n; i++)
            if (c->body[i] == body) {
                c->number[i] = count;
                dof[count++] = i;
            }
        s = add_body(c, body, count, dof, q);
    }
    free(dof);
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
    c->column = rb_alloc_int(m);
    c->f = rb_alloc(n, 1);
    c->v = rb_alloc(n, 1);
    rb_status s = c->body && c->number && c->column && c->f && c->v ? RB_OK : RB_ENOMEM;
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
    free(c->column);
    free(c->number);
    free(c->body);
    return s;
}

rb_status rb_friction_condense(const rb_friction_problem *global,
                               rb_friction_problem *local, rb_message *why)
{
    condenser c = {.p = global};
    *local = (rb_friction_problem){.form = RB_FRICTION_LOCAL_SPARSE,
                                   .dimension = global->dimension,
                                   .contacts = global->contacts};
    rb_status s = copy_rest(global, local);
    if (s == RB_OK)
        s = condense(&c, local);
    if (s != RB_OK)
        rb_friction_problem_free(local);
    return s == RB_SINGULAR ? name_the_nullity(&global->K, why) : s;
}
