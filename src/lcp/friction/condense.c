/* K v = H r + f, u = H' v + w  ->  u = W r + q, body (connected part of K) by body: W =
 * sum of H_b' K_b^-1 H_b over the bodies.  The bodies of a diagonal or block-diagonal
 * mass are small: K_b = L L', and W gets Y_b' Y_b with Y_b = L^-1 H_b.  Large ones are
 * factorised by CHOLMOD.  W is then computed column by column from the few bodies that a
 * column belongs to. */
#include "lcp/friction/internal.h"

#include <lapacke.h>
#include <limits.h>
#include <math.h>
#include <string.h>

typedef struct {
    const rb_friction_problem *p;
    int bodies;
    int *body;                 /* n: of each degree of freedom */
    int *number;               /* n: its number within the body */
    int *dof;                  /* n: degrees of freedom, body by body */
    int *column;               /* columns of H that touch a body, body by body */
    int *dofs_of, *columns_of; /* bodies + 1: where they start */
    double *f, *v;             /* n: of the present body */
    double **Y;                /* bodies: Y_b of a small one by rows, or NULL */
    rb_sparse *W;              /* bodies: H_b' K_b^-1 H_b of a large one */
    double flops;
    rb_arena memory; /* of all arrays */
} condenser;

/* The entries of a in rows of `body` and in the listed columns, renumbered. */
static rb_status part_of(const condenser *c, const rb_sparse *a, int body, int cols,
                         const int *list, rb_sparse *part)
{
    rb_triplets t = {.rows = c->dofs_of[body + 1] - c->dofs_of[body], .cols = cols};
    for (int j = 0; j < cols; j++)
        for (int k = a->p[list[j]]; k < a->p[list[j] + 1]; k++)
            if (c->body[a->i[k]] == body)
                rb_triplets_add(&t, c->number[a->i[k]], j, a->x[k]);
    const rb_status s = rb_sparse_from_triplets(&t, part);
    rb_triplets_free(&t);
    return s;
}

/* ---- A large body ------------------------------------------------------------------ */

/* q += H_b' K_b^-1 f_b, and W_b with its rows numbered as those of W */
static rb_status condense_large(condenser *c, int body, double *q)
{
    const int n = c->dofs_of[body + 1] - c->dofs_of[body];
    const int cols = c->columns_of[body + 1] - c->columns_of[body];
    const int *dof = c->dof + c->dofs_of[body], *column = c->column + c->columns_of[body];
    rb_sparse k = {0}, h = {0}, *w = &c->W[body];
    rb_sparse_cholesky *factor = NULL;
    rb_status s = part_of(c, &c->p->K, body, n, dof, &k);
    if (s == RB_OK)
        s = part_of(c, &c->p->H, body, cols, column, &h);
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
        s = rb_sparse_cholesky_congruence(factor, &h, w);
    for (int l = 0; s == RB_OK && l < w->p[cols]; l++)
        w->i[l] = column[w->i[l]];
    if (s == RB_OK)
        c->flops += rb_sparse_cholesky_flops(factor);
    rb_sparse_cholesky_free(factor);
    rb_sparse_free(&h);
    rb_sparse_free(&k);
    return s;
}

/* ---- A small body ------------------------------------------------------------------ */

#define MOST_DOFS 12     /* of a body that is inverted densely */
#define LEAST_PIVOT 3e-6 /* sqrt(1e-11): of a factor of unit diagonal, as in CHOLMOD's case */

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

/* The same by Y_b = L^-1 S H_b, K_b = S L L' S with S = diag(K_b)^1/2, so that the pivots
 * tell the rank.  L: the lower triangle of k, column-major. */
static rb_status condense_small(condenser *c, int body, double *q)
{
    const int n = c->dofs_of[body + 1] - c->dofs_of[body];
    const int cols = c->columns_of[body + 1] - c->columns_of[body];
    const int *dof = c->dof + c->dofs_of[body], *column = c->column + c->columns_of[body];
    const rb_sparse *h = &c->p->H, *a = &c->p->K;
    double k[MOST_DOFS * MOST_DOFS] = {0.0}, scale[MOST_DOFS], f[MOST_DOFS];
    int diagonal = 1;
    for (int j = 0; j < n; j++)
        for (int l = a->p[dof[j]]; l < a->p[dof[j] + 1]; l++) {
            k[c->number[a->i[l]] + j * n] = a->x[l];
            diagonal &= a->i[l] == dof[j];
        }
    for (int j = 0; j < n; j++) {
        if (!(k[j + j * n] > 0.0))
            return RB_SINGULAR;
        scale[j] = 1.0 / sqrt(k[j + j * n]);
    }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            k[i + j * n] *= scale[i] * scale[j];
    for (int j = 0; diagonal && j < n; j++)
        k[j + j * n] = 1.0;
    if (!diagonal && LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'L', n, k, n) != 0)
        return RB_SINGULAR;
    for (int j = 0; j < n; j++)
        if (k[j + j * n] < LEAST_PIVOT)
            return RB_SINGULAR;
    if (cols == 0)
        return RB_OK;
    c->Y[body] = rb_arena_doubles(&c->memory, (size_t)n, (size_t)cols);
    if (!c->Y[body])
        return RB_ENOMEM;
    for (int i = 0; i < n; i++)
        f[i] = c->p->f[dof[i]];
    forward(n, k, scale, f);
    for (int j = 0; j < cols; j++) {
        double y[MOST_DOFS] = {0.0};
        for (int l = h->p[column[j]]; l < h->p[column[j] + 1]; l++)
            if (c->body[h->i[l]] == body)
                y[c->number[h->i[l]]] = h->x[l];
        forward(n, k, scale, y);
        for (int i = 0; i < n; i++) {
            q[column[j]] += y[i] * f[i];
            c->Y[body][j + i * cols] = y[i];
        }
    }
    c->flops += (double)n * cols * (n + cols) + (double)n * n * n / 3.0;
    return RB_OK;
}

/* ---- All bodies -------------------------------------------------------------------- */

/* column and columns_of: the columns of H that touch a body, each once. */
static void list_columns(condenser *c)
{
    const rb_sparse *h = &c->p->H;
    int *last = rb_arena_ints(&c->memory, (size_t)c->bodies);
    c->column = rb_arena_ints(&c->memory, (size_t)h->p[h->cols]);
    c->columns_of = rb_arena_ints(&c->memory, (size_t)c->bodies + 2);
    if (c->memory.failed)
        return;
    for (int pass = 0; pass < 2; pass++) {
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
}

/* The bodies, their degrees of freedom and the columns of H that touch them.  Of a
 * diagonal mass every degree of freedom is a connected part of K: those of one rigid body
 * follow each other and touch the same columns, and become one body, block-diagonal. */
static rb_status find_bodies(condenser *c)
{
    const int n = c->p->dofs;
    c->body = rb_arena_ints(&c->memory, (size_t)n);
    c->number = rb_arena_ints(&c->memory, (size_t)n);
    c->dof = rb_arena_ints(&c->memory, (size_t)n);
    const rb_status s =
        c->memory.failed ? RB_ENOMEM : rb_sparse_components(&c->p->K, &c->bodies, c->body);
    if (s != RB_OK)
        return s;
    list_columns(c);
    int *joined = rb_arena_ints(&c->memory, (size_t)c->bodies),
        *dofs = rb_arena_ints(&c->memory, (size_t)c->bodies);
    if (c->memory.failed)
        return RB_ENOMEM;
    for (int i = 0; i < n; i++)
        dofs[c->body[i]]++;
    int count = 0, size = 0; /* of the joined one that grows */
    for (int b = 0; b < c->bodies; b++) {
        const int *from = c->columns_of + b, cols = from[1] - from[0];
        const int same =
            b > 0 && cols > 0 && cols == from[0] - from[-1] && size + dofs[b] <= MOST_DOFS &&
            !memcmp(c->column + from[0], c->column + from[-1], (size_t)cols * sizeof *c->column);
        size = same ? size + dofs[b] : dofs[b];
        count += !same;
        joined[b] = count - 1;
    }
    for (int i = 0; i < n; i++)
        c->body[i] = joined[c->body[i]];
    c->bodies = count;
    list_columns(c);
    c->dofs_of = rb_arena_ints(&c->memory, (size_t)c->bodies + 2);
    if (c->memory.failed)
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

/* ---- W column by column ------------------------------------------------------------ */

/* The bodies that a column touches, by increasing number, and its place among the columns
 * of each. */
typedef struct {
    int *start;        /* m + 1 */
    int *body, *place; /* start[m] */
} touches;

/* The rows of W that a body adds to its column `place`; their number. */
static int rows_of(const condenser *c, int body, int place, const int **row)
{
    const rb_sparse *w = &c->W[body];
    *row = w->p ? w->i + w->p[place] : c->column + c->columns_of[body];
    return w->p ? w->p[place + 1] - w->p[place] : c->columns_of[body + 1] - c->columns_of[body];
}

/* The rows of column j, increasing, into row; other: scratch.  The columns of one contact
 * touch the same bodies. */
static int list_rows(const condenser *c, const touches *t, int j, const rb_sparse *W, int *other,
                     int *row)
{
    const int first = t->start[j], bodies = t->start[j + 1] - first;
    int count = 0;
    if (j > 0 && bodies > 0 && first - t->start[j - 1] == bodies && !c->W[t->body[first]].p &&
        !memcmp(t->body + first, t->body + t->start[j - 1], (size_t)bodies * sizeof(int))) {
        count = W->p[j] - W->p[j - 1];
        memcpy(row, row - count, (size_t)count * sizeof *row);
        return count;
    }
    for (int k = first; k < t->start[j + 1]; k++) {
        /* The union of two increasing lists.  The loop has no branches because which one
         * is less follows no pattern. */
        const int *more, n = rows_of(c, t->body[k], t->place[k], &more), had = count;
        memcpy(other, row, (size_t)had * sizeof *row);
        int a = 0, b = 0;
        for (count = 0; a < had && b < n; count++) {
            const int x = other[a], y = more[b];
            row[count] = x < y ? x : y;
            a += x <= y;
            b += y <= x;
        }
        memcpy(row + count, other + a, (size_t)(had - a) * sizeof *row);
        count += had - a;
        memcpy(row + count, more + b, (size_t)(n - b) * sizeof *row);
        count += n - b;
    }
    return count;
}

static rb_status assemble(const condenser *c, int m, rb_sparse *W)
{
    const int touching = c->columns_of[c->bodies];
    rb_arena scratch = {0};
    double *x = rb_arena_doubles(&scratch, (size_t)m, 2);
    int *other = rb_arena_ints(&scratch, (size_t)m);
    touches t = {.start = rb_arena_ints(&scratch, (size_t)m + 2),
                 .body = rb_arena_ints(&scratch, (size_t)touching),
                 .place = rb_arena_ints(&scratch, (size_t)touching)};
    rb_status s = scratch.failed ? RB_ENOMEM : RB_OK;
    if (s == RB_OK) {
        int *next = t.start + 1; /* as in find_bodies */
        for (int k = 0; k < touching; k++)
            next[c->column[k] + 1]++;
        for (int j = 0; j < m; j++)
            next[j + 1] += next[j];
        for (int b = 0; b < c->bodies; b++)
            for (int k = c->columns_of[b]; k < c->columns_of[b + 1]; k++) {
                const int at = next[c->column[k]]++;
                t.body[at] = b;
                t.place[at] = k - c->columns_of[b];
            }
        /* Room for what all bodies add, which is more than W has where two bodies meet
         * twice. */
        size_t most = 0;
        const int *row;
        for (int k = 0; k < t.start[m]; k++)
            most += (size_t)rows_of(c, t.body[k], t.place[k], &row);
        if (most <= INT_MAX)
            *W = (rb_sparse){.rows = m,
                             .cols = m,
                             .p = rb_alloc_int((size_t)m + 1),
                             .i = rb_alloc_int(most),
                             .x = rb_alloc(most, 1)};
        if (!W->p || !W->i || !W->x)
            s = RB_ENOMEM;
    }
    for (int j = 0; s == RB_OK && j < m; j++) {
        int *row = W->i + W->p[j];
        const int count = list_rows(c, &t, j, W, other, row);
        /* x = the sum of the bodies' columns; Y_b' Y_b is symmetric as it stands. */
        for (int k = t.start[j]; k < t.start[j + 1]; k++) {
            const int body = t.body[k], place = t.place[k];
            const int *at, rows = rows_of(c, body, place, &at);
            const rb_sparse *w = &c->W[body];
            for (int l = 0; w->p && l < rows; l++)
                x[at[l]] += w->x[w->p[place] + l];
            if (w->p)
                continue;
            double *sum = x + m;
            memset(sum, 0, (size_t)rows * sizeof *sum);
            for (int l = 0; l < c->dofs_of[body + 1] - c->dofs_of[body]; l++) {
                const double *y = c->Y[body] + (size_t)l * (size_t)rows, factor = y[place];
                for (int i = 0; i < rows; i++)
                    sum[i] += factor * y[i];
            }
            for (int i = 0; i < rows; i++)
                x[at[i]] += sum[i];
        }
        for (int k = 0; k < count; k++) {
            W->x[W->p[j] + k] = x[row[k]];
            x[row[k]] = 0.0;
        }
        W->p[j + 1] = W->p[j] + count;
    }
    return rb_arena_done(&scratch, s);
}

rb_status rb_friction_condense_counted(const rb_friction_problem *global,
                                       rb_friction_problem *local, double *flops, rb_message *why)
{
    const size_t m = (size_t)(global->dimension * global->contacts);
    condenser c = {.p = global};
    *local = (rb_friction_problem){.form = RB_FRICTION_LOCAL_SPARSE,
                                   .dimension = global->dimension,
                                   .contacts = global->contacts,
                                   .mu = rb_copy((size_t)global->contacts, global->mu),
                                   .q = rb_copy(m, global->w)};
    rb_status s = local->mu && local->q ? find_bodies(&c) : RB_ENOMEM;
    if (s == RB_OK) {
        const size_t n = (size_t)global->dofs, bodies = c.bodies > 0 ? (size_t)c.bodies : 1;
        c.f = rb_arena_doubles(&c.memory, n, 1);
        c.v = rb_arena_doubles(&c.memory, n, 1);
        c.Y = rb_arena_zeros(&c.memory, bodies, sizeof *c.Y);
        c.W = rb_arena_zeros(&c.memory, bodies, sizeof *c.W);
        if (c.memory.failed)
            s = RB_ENOMEM;
    }
    for (int body = 0; s == RB_OK && body < c.bodies; body++)
        s = c.dofs_of[body + 1] - c.dofs_of[body] <= MOST_DOFS ? condense_small(&c, body, local->q)
                                                               : condense_large(&c, body, local->q);
    if (s == RB_OK)
        s = assemble(&c, (int)m, &local->Ws);
    *flops += c.flops;
    for (int b = 0; c.W && b < c.bodies; b++)
        rb_sparse_free(&c.W[b]);
    rb_arena_free(&c.memory);
    if (s != RB_OK)
        rb_friction_problem_free(local);
    if (s != RB_SINGULAR)
        return s;
    int rank;
    if (rb_sparse_rank(&global->K, &rank) != RB_OK)
        return RB_ENOMEM;
    return rb_fail(why, RB_SINGULAR,
                   "K is singular to rounding (nullity %d): there is no W to condense to",
                   global->K.rows - rank);
}

rb_status rb_friction_condense(const rb_friction_problem *global, rb_friction_problem *local,
                               rb_message *why)
{
    double flops = 0.0;
    return rb_friction_condense_counted(global, local, &flops, why);
}

/* Per column of H one solve with the part of the factor that belongs to each body it
 * touches, and the products with the columns there. */
rb_status rb_friction_condense_estimate(const rb_friction_problem *global,
                                        const rb_sparse_cholesky *factor, double *flops)
{
    const rb_sparse *h = &global->H;
    const size_t n = (size_t)global->dofs;
    const double each = rb_sparse_cholesky_entries(factor) / global->dofs;
    rb_arena scratch = {0};
    int *body = rb_arena_ints(&scratch, n), *size = rb_arena_ints(&scratch, n),
        *last = rb_arena_ints(&scratch, n), bodies;
    const rb_status s =
        scratch.failed ? RB_ENOMEM : rb_sparse_components(&global->K, &bodies, body);
    *flops = rb_sparse_cholesky_flops(factor);
    for (size_t i = 0; s == RB_OK && i < n; i++)
        size[body[i]]++;
    for (int j = 0; s == RB_OK && j < h->cols; j++)
        for (int k = h->p[j]; k < h->p[j + 1]; k++) {
            const int b = body[h->i[k]];
            if (last[b] != j + 1)
                *flops += 4.0 * each * size[b];
            last[b] = j + 1;
        }
    return rb_arena_done(&scratch, s);
}
