/* Condensation to the unknowns that the contacts touch. */
#include "fem/fem.h"

#include <stdlib.h>

struct rb_fem_condensation {
    int dofs, nf;               /* all unknowns, eliminated ones */
    int *place;                 /* of each unknown: k >= 0 among C, -1 - k among F */
    rb_sparse KFC;              /* nf x nc */
    rb_sparse_cholesky *factor; /* of K_FF; NULL when nf = 0 */
    rb_fem_structure condensed;
};

/* Rows and columns of a: kept where wanted C (1) or F (0); 2 keeps all columns. */
static rb_status block(const rb_fem_condensation *c, const rb_sparse *a, int row_c, int col_c,
                       rb_sparse *b)
{
    const int nc = c->condensed.dofs;
    rb_triplets t = {.rows = row_c ? nc : c->nf,
                     .cols = col_c == 2 ? a->cols : (col_c ? nc : c->nf)};
    for (int j = 0; j < a->cols; j++) {
        const int pj = col_c == 2 ? j : c->place[j];
        if (col_c != 2 && (pj >= 0) != col_c)
            continue;
        for (int k = a->p[j]; k < a->p[j + 1]; k++) {
            const int pi = c->place[a->i[k]];
            if ((pi >= 0) == row_c)
                rb_triplets_add(&t, pi >= 0 ? pi : -1 - pi, pj >= 0 ? pj : -1 - pj, a->x[k]);
        }
    }
    const rb_status s = rb_sparse_from_triplets(&t, b);
    rb_triplets_free(&t);
    return s;
}

rb_status rb_fem_condense(const rb_fem_structure *full, rb_fem_condensation **result,
                          rb_message *why)
{
    *result = NULL;
    rb_fem_condensation *c = calloc(1, sizeof *c);
    if (!c)
        return RB_ENOMEM;
    c->dofs = full->dofs;
    c->place = rb_alloc_int((size_t)full->dofs);
    rb_status s = c->place ? RB_OK : RB_ENOMEM;
    if (s == RB_OK) {
        /* C: the rows of H that hold anything, in their order. */
        const int entries = full->H.p[full->H.cols];
        int nc = 0;
        for (int k = 0; k < entries; k++)
            c->place[full->H.i[k]] = 1;
        for (int i = 0; i < full->dofs; i++)
            c->place[i] = c->place[i] ? nc++ : -1 - c->nf++;
        c->condensed.dofs = nc;
        if (nc == 0)
            s = rb_fail(why, RB_EINVAL, "condensation: no contact touches the structure");
    }
    /* K_c = K_CC - K_FC' K_FF^-1 K_FC */
    rb_sparse KFF = {0}, KCC = {0}, W = {0};
    if (s == RB_OK)
        s = block(c, &full->K, 1, 1, &KCC);
    if (s == RB_OK)
        s = block(c, &full->K, 0, 1, &c->KFC);
    if (s == RB_OK)
        s = block(c, &full->K, 0, 0, &KFF);
    if (s == RB_OK && c->nf > 0)
        s = rb_sparse_cholesky_create(&KFF, &c->factor);
    if (s == RB_SINGULAR)
        rb_fail(why, s,
                "condensation: parts of the structure move even when every contact "
                "node is held");
    if (s == RB_OK && c->nf > 0)
        s = rb_sparse_cholesky_congruence(c->factor, &c->KFC, &W);
    if (s == RB_OK && c->nf == 0)
        s = rb_sparse_copy(&KCC, &c->condensed.K);
    else if (s == RB_OK) {
        rb_triplets t = {.rows = KCC.rows, .cols = KCC.cols};
        rb_triplets_add_matrix(&t, 1.0, &KCC);
        rb_triplets_add_matrix(&t, -1.0, &W);
        s = rb_sparse_from_triplets(&t, &c->condensed.K);
        rb_triplets_free(&t);
    }
    rb_sparse_free(&W);
    rb_sparse_free(&KFF);
    rb_sparse_free(&KCC);
    if (s == RB_OK)
        s = block(c, &full->H, 1, 2, &c->condensed.H);
    if (s == RB_OK) {
        c->condensed.dimension = full->dimension;
        c->condensed.contacts = full->contacts;
        c->condensed.mu = rb_copy((size_t)full->contacts, full->mu);
        c->condensed.gap = rb_copy((size_t)full->contacts, full->gap);
        s = c->condensed.mu && c->condensed.gap ? RB_OK : RB_ENOMEM;
    }
    if (s == RB_OK)
        *result = c;
    else
        rb_fem_condensation_free(c);
    return s;
}

void rb_fem_condensation_free(rb_fem_condensation *c)
{
    if (!c)
        return;
    rb_sparse_cholesky_free(c->factor);
    rb_sparse_free(&c->KFC);
    rb_fem_structure_free(&c->condensed);
    free(c->place);
    free(c);
}

const rb_fem_structure *rb_fem_condensed(const rb_fem_condensation *c)
{
    return &c->condensed;
}

/* x = K_FF^-1 (load_F - K_FC u_C); u_C NULL: zero.  x: nf. */
static rb_status interior(const rb_fem_condensation *c, const double *load, const double *u_c,
                          double *x)
{
    for (int i = 0; i < c->dofs; i++)
        if (c->place[i] < 0)
            x[-1 - c->place[i]] = load[i];
    if (u_c)
        rb_sparse_apply(-1.0, &c->KFC, u_c, 1.0, x);
    return c->nf > 0 ? rb_sparse_cholesky_solve(c->factor, x, x) : RB_OK;
}

rb_status rb_fem_condense_load(const rb_fem_condensation *c, const double *load, double *load_c)
{
    double *x = rb_alloc((size_t)c->nf, 1);
    rb_status s = x ? interior(c, load, NULL, x) : RB_ENOMEM;
    if (s == RB_OK) {
        for (int i = 0; i < c->dofs; i++)
            if (c->place[i] >= 0)
                load_c[c->place[i]] = load[i];
        rb_sparse_apply_transposed(-1.0, &c->KFC, x, 1.0, load_c);
    }
    free(x);
    return s;
}

rb_status rb_fem_expand(const rb_fem_condensation *c, const double *load, const double *u_c,
                        double *u)
{
    double *x = rb_alloc((size_t)c->nf, 1);
    rb_status s = x ? interior(c, load, u_c, x) : RB_ENOMEM;
    for (int i = 0; s == RB_OK && i < c->dofs; i++)
        u[i] = c->place[i] >= 0 ? u_c[c->place[i]] : x[-1 - c->place[i]];
    free(x);
    return s;
}
