/* W in d x d blocks, block column by block column: a contact whose force changes adds its
 * own column to the velocities, and one that stays open costs nothing. */
#include "lcp/friction/internal.h"

#include <limits.h>
#include <stdlib.h>

void rb_friction_blocks_free(rb_friction_blocks *blocks)
{
    free(blocks->x);
    *blocks = (rb_friction_blocks){0};
}

/* ---- Reading W, the d columns of one contact together ------------------------------ */

typedef struct {
    const rb_friction_problem *local;
    int contact, d;
    int at[3], end[3]; /* sparse: what is left of each column */
    int diagonal;      /* sparse: its first row, INT_MAX when it has been read */
    int next;          /* dense: block row */
} reader;

static void reader_start(const rb_friction_problem *local, int contact, reader *s)
{
    const int d = local->dimension;
    *s = (reader){.local = local, .contact = contact, .d = d};
    s->diagonal = contact * d;
    for (int b = 0; local->form == RB_FRICTION_LOCAL_SPARSE && b < d; b++) {
        s->at[b] = local->Ws.p[contact * d + b];
        s->end[b] = local->Ws.p[contact * d + b + 1];
    }
}

/* The next block row that has an entry or is the diagonal, -1 after the last.  block:
 * d x d zeros to be filled, or NULL (sparse W only). */
static int next_block(reader *s, double *block)
{
    if (s->local->form != RB_FRICTION_LOCAL_DENSE) {
        const rb_sparse *w = &s->local->Ws;
        const int d = s->d;
        /* A merge of d sorted columns: the least row that one of them has left, or the diagonal,
         * which solvers ask for also where W has no entry. */
        int first = s->diagonal;
        for (int b = 0; b < d; b++)
            if (s->at[b] < s->end[b] && w->i[s->at[b]] < first)
                first = w->i[s->at[b]];
        if (first == INT_MAX)
            return -1;
        const int row = first / d, top = row * d;
        for (int b = 0; b < d; b++)
            for (; s->at[b] < s->end[b] && w->i[s->at[b]] < top + d; s->at[b]++)
                if (block)
                    block[w->i[s->at[b]] - top + b * d] = w->x[s->at[b]];
        if (row == s->contact)
            s->diagonal = INT_MAX;
        return row;
    }
    const int d = s->d;
    const size_t m = (size_t)(d * s->local->contacts);
    for (int row = s->next; row < s->local->contacts; row++) {
        const double *w = s->local->W + row * d + (size_t)(s->contact * d) * m;
        int any = row == s->contact;
        for (int b = 0; b < d; b++)
            for (int a = 0; a < d; a++) {
                block[a + b * d] = w[a + (size_t)b * m];
                any |= block[a + b * d] != 0.0;
            }
        s->next = row + 1;
        if (any)
            return row;
    }
    return -1;
}

/* ---- Blocks ------------------------------------------------------------------------ */

/* Below this, room for one block per entry costs less than counting the blocks. */
#define NOT_WORTH_COUNTING 10000

rb_status rb_friction_blocks_init(const rb_friction_problem *local, rb_friction_blocks *b)
{
    const size_t nc = (size_t)local->contacts, d = (size_t)local->dimension;
    const size_t entries =
        local->form == RB_FRICTION_LOCAL_DENSE ? nc * nc : (size_t)local->Ws.p[nc * d] + nc;
    size_t total = entries < nc * nc ? entries : nc * nc;
    if (local->form != RB_FRICTION_LOCAL_DENSE && entries > NOT_WORTH_COUNTING) {
        total = 0;
        for (int c = 0; c < local->contacts; c++) {
            reader from;
            reader_start(local, c, &from);
            while (next_block(&from, NULL) >= 0)
                total++;
        }
    }
    total++; /* the reader looks past the last */
    const size_t indices = total + 2 * nc + 1;
    *b = (rb_friction_blocks){.d = local->dimension, .contacts = local->contacts};
    b->x = rb_alloc(total * d * d + indices * sizeof *b->p / sizeof *b->x + 1, 1);
    if (!b->x)
        return RB_ENOMEM;
    b->p = (int *)(b->x + total * d * d);
    b->diag = b->p + nc + 1;
    b->i = b->diag + nc;
    for (int c = 0; c < local->contacts; c++) {
        const size_t dd = (size_t)(b->d * b->d);
        int k = b->p[c];
        reader from;
        reader_start(local, c, &from);
        while ((b->i[k] = next_block(&from, b->x + (size_t)k * dd)) >= 0) {
            if (b->i[k] == c)
                b->diag[c] = k;
            k++;
        }
        b->p[c + 1] = k;
    }
    return RB_OK;
}

void rb_friction_blocks_add(const rb_friction_blocks *b, int contact, const double *x, double *y)
{
    const int first = b->p[contact], end = b->p[contact + 1];
    const double x0 = x[0], x1 = x[1];
    if (b->d == 2) {
        /* The blocks of a column follow each other; without a loop over d. */
        const double *w = b->x + 4 * (size_t)first;
        for (int k = first; k < end; k++, w += 4) {
            double *yi = y + 2 * b->i[k];
            yi[0] += w[0] * x0 + w[2] * x1;
            yi[1] += w[1] * x0 + w[3] * x1;
        }
        return;
    }
    const double x2 = x[2], *w = b->x + 9 * (size_t)first;
    for (int k = first; k < end; k++, w += 9) {
        double *yi = y + 3 * b->i[k];
        yi[0] += w[0] * x0 + w[3] * x1 + w[6] * x2;
        yi[1] += w[1] * x0 + w[4] * x1 + w[7] * x2;
        yi[2] += w[2] * x0 + w[5] * x1 + w[8] * x2;
    }
}

int rb_friction_blocks_add_all(const rb_friction_blocks *b, const double *x, double *y)
{
    const int d = b->d;
    int touched = 0;
    for (int c = 0; c < b->contacts; c++) {
        const double *xc = x + c * d;
        if (xc[0] == 0.0 && xc[1] == 0.0 && xc[d - 1] == 0.0)
            continue;
        rb_friction_blocks_add(b, c, xc, y);
        touched += b->p[c + 1] - b->p[c];
    }
    return touched;
}

void rb_friction_blocks_apply(const rb_friction_blocks *b, const double *x, double *y)
{
    for (int i = 0; i < b->d * b->contacts; i++)
        y[i] = 0.0;
    rb_friction_blocks_add_all(b, x, y);
}
