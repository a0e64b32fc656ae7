/* SuiteSparse behind rollbem/sparse.h: rank (SPQR), LU (UMFPACK), Cholesky (CHOLMOD). */
#include "base/sparse.h"

#include <suitesparse/SuiteSparseQR_C.h>
#include <suitesparse/cholmod.h>
#include <suitesparse/umfpack.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Rank ------------------------------------------------------------------------- */

/* SuiteSparseQR knows long indices only. */
static cholmod_sparse *long_copy(const rb_sparse *a, cholmod_common *c)
{
    const size_t nz = (size_t)a->p[a->cols];
    cholmod_sparse *l =
        cholmod_l_allocate_sparse((size_t)a->rows, (size_t)a->cols, nz, 1, 1, 0, CHOLMOD_REAL, c);
    if (!l)
        return NULL;
    SuiteSparse_long *p = l->p, *i = l->i;
    for (int j = 0; j <= a->cols; j++)
        p[j] = a->p[j];
    for (size_t k = 0; k < nz; k++)
        i[k] = a->i[k];
    memcpy(l->x, a->x, nz * sizeof(double));
    return l;
}

rb_status rb_sparse_rank(const rb_sparse *a, int *rank)
{
    cholmod_common c;
    cholmod_l_start(&c);
    c.print = 0;
    cholmod_sparse *l = long_copy(a, &c), *r = NULL;
    SuiteSparse_long *e = NULL;
    SuiteSparse_long found = -1;
    if (l)
        found = SuiteSparseQR_C(SPQR_ORDERING_DEFAULT, SPQR_DEFAULT_TOL, 0, 0, l, NULL, NULL, NULL,
                                NULL, &r, &e, NULL, NULL, NULL, &c);
    cholmod_l_free_sparse(&r, &c);
    cholmod_l_free((size_t)a->cols, sizeof *e, e, &c);
    cholmod_l_free_sparse(&l, &c);
    cholmod_l_finish(&c);
    *rank = (int)found;
    return found < 0 ? RB_ENOMEM : RB_OK;
}

/* ---- LU --------------------------------------------------------------------------- */

struct rb_sparse_lu {
    void *symbolic, *numeric;
    const rb_sparse *a;        /* borrowed: UMFPACK refines with the matrix itself */
    const rb_sparse *analysed; /* whose pattern the analysis has seen; borrowed */
    double entries;            /* of both factors */
    double control[UMFPACK_CONTROL];
};

static rb_status umfpack_status(int code)
{
    return code == UMFPACK_OK                        ? RB_OK
           : code == UMFPACK_ERROR_out_of_memory     ? RB_ENOMEM
           : code == UMFPACK_WARNING_singular_matrix ? RB_SINGULAR
                                                     : RB_EINVAL;
}

rb_status rb_sparse_lu_create(const rb_sparse *a, rb_sparse_lu **lu)
{
    *lu = NULL;
    if (a->rows != a->cols)
        return RB_EINVAL;
    rb_sparse_lu *f = calloc(1, sizeof *f);
    if (!f)
        return RB_ENOMEM;
    umfpack_di_defaults(f->control);
    f->control[UMFPACK_PRL] = 0;
    /* patterns here are symmetric, which UMFPACK does not see before it has the numbers:
     * four times fewer operations on the wall of the examples */
    f->control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    const rb_status s = umfpack_status(
        umfpack_di_symbolic(a->rows, a->cols, a->p, a->i, NULL, &f->symbolic, f->control, NULL));
    f->analysed = a;
    if (s == RB_OK)
        *lu = f;
    else
        rb_sparse_lu_free(f);
    return s;
}

rb_status rb_sparse_lu_factor(rb_sparse_lu *lu, const rb_sparse *a, double *flops)
{
    double info[UMFPACK_INFO];
    umfpack_di_free_numeric(&lu->numeric);
    lu->a = a;
    const int code =
        umfpack_di_numeric(a->p, a->i, a->x, lu->symbolic, &lu->numeric, lu->control, info);
    lu->entries = info[UMFPACK_LNZ] + info[UMFPACK_UNZ];
    if (flops && info[UMFPACK_FLOPS] > 0)
        *flops += info[UMFPACK_FLOPS];
    /* UMFPACK says so, too, of some patterns that are singular whatever the numbers are. */
    if (code == UMFPACK_ERROR_different_pattern && a == lu->analysed)
        return RB_SINGULAR;
    return umfpack_status(code);
}

/* steps: of refinement, at most. */
static rb_status lu_solve(const rb_sparse_lu *lu, int system, double steps, const double *b,
                          double *x)
{
    double control[UMFPACK_CONTROL];
    const rb_sparse *a = lu->a;
    if (!lu->numeric)
        return RB_EINVAL;
    memcpy(control, lu->control, sizeof control);
    control[UMFPACK_IRSTEP] = steps;
    return umfpack_status(
        umfpack_di_solve(system, a->p, a->i, a->x, x, b, lu->numeric, control, NULL));
}

rb_status rb_sparse_lu_solve(const rb_sparse_lu *lu, const double *b, double *x)
{
    return lu_solve(lu, UMFPACK_A, lu->control[UMFPACK_IRSTEP], b, x);
}

rb_status rb_sparse_lu_solve_once(const rb_sparse_lu *lu, const double *b, double *x)
{
    return lu_solve(lu, UMFPACK_A, 0.0, b, x);
}

rb_status rb_sparse_lu_solve_transposed(const rb_sparse_lu *lu, const double *b, double *x)
{
    return lu_solve(lu, UMFPACK_At, lu->control[UMFPACK_IRSTEP], b, x);
}

double rb_sparse_lu_entries(const rb_sparse_lu *lu)
{
    return lu->entries;
}

void rb_sparse_lu_free(rb_sparse_lu *lu)
{
    if (!lu)
        return;
    umfpack_di_free_numeric(&lu->numeric);
    umfpack_di_free_symbolic(&lu->symbolic);
    free(lu);
}

/* ---- Cholesky ---------------------------------------------------------------------- */

struct rb_sparse_cholesky {
    cholmod_common c;
    int n;
    cholmod_factor *l; /* L L' = P (S K S) P'; NULL: K is diagonal, S K S = 1 */
    double *scale;     /* S = diag(K)^-1/2: pivots then tell rank whatever the units */
    double flops;
};

/* A view: shares the arrays. */
static cholmod_sparse view_of(const rb_sparse *a, int stype)
{
    return (cholmod_sparse){.nrow = (size_t)a->rows,
                            .ncol = (size_t)a->cols,
                            .nzmax = (size_t)a->p[a->cols],
                            .p = a->p,
                            .i = a->i,
                            .x = a->x,
                            .stype = stype,
                            .itype = CHOLMOD_INT,
                            .xtype = CHOLMOD_REAL,
                            .dtype = CHOLMOD_DOUBLE,
                            .sorted = 1,
                            .packed = 1};
}

static cholmod_dense dense_view(int n, double *x)
{
    return (cholmod_dense){.nrow = (size_t)n,
                           .ncol = 1,
                           .nzmax = (size_t)n,
                           .d = (size_t)n,
                           .x = x,
                           .xtype = CHOLMOD_REAL,
                           .dtype = CHOLMOD_DOUBLE};
}

/* S K S; a zero or negative diagonal entry is left for the factorisation to refuse. */
static rb_status equilibrate(const rb_sparse *k, double *scale, rb_sparse *sks)
{
    if (!scale || rb_sparse_copy(k, sks) != RB_OK)
        return RB_ENOMEM;
    for (int j = 0; j < k->cols; j++) {
        const double own = rb_sparse_diagonal(k, j);
        scale[j] = own > 0.0 ? 1.0 / sqrt(own) : 1.0;
    }
    for (int j = 0; j < k->cols; j++)
        for (int l = k->p[j]; l < k->p[j + 1]; l++)
            sks->x[l] *= scale[j] * scale[k->i[l]];
    return RB_OK;
}

/* Diagonal and positive: nothing needs factoring. */
static int is_diagonal(const rb_sparse *k)
{
    if (k->p[k->cols] != k->cols)
        return 0;
    for (int j = 0; j < k->cols; j++)
        if (k->p[j] != j || k->i[j] != j || !(k->x[j] > 0.0))
            return 0;
    return 1;
}

static rb_status factorize(const rb_sparse *k, rb_sparse_cholesky *f)
{
    rb_sparse sks = {0};
    f->n = k->rows;
    f->scale = rb_alloc((size_t)k->rows, 1);
    if (f->scale && is_diagonal(k)) {
        for (int i = 0; i < f->n; i++)
            f->scale[i] = 1.0 / sqrt(k->x[i]);
        f->flops = f->n;
        return RB_OK;
    }
    if (equilibrate(k, f->scale, &sks) != RB_OK)
        return RB_ENOMEM;
    cholmod_sparse view = view_of(&sks, 1);
    f->l = cholmod_analyze(&view, &f->c);
    if (f->l)
        cholmod_factorize(&view, f->l, &f->c);
    f->flops = f->c.fl;
    rb_sparse_free(&sks);
    if (!f->l)
        return RB_ENOMEM;
    if (f->c.status < 0) /* no memory, or more entries than its indices count */
        return RB_ENOMEM;
    /* cholmod_rcond: (smallest/largest diagonal of L)^2.  A structure condensed to its
     * contacts (a bar of 321 unknowns, free to float) leaves 6e-13 of a pivot that is 0. */
    if (f->l->minor < f->l->n || cholmod_rcond(f->l, &f->c) < 1e-11)
        return RB_SINGULAR;
    return RB_OK;
}

rb_status rb_sparse_cholesky_create(const rb_sparse *k, rb_sparse_cholesky **factor)
{
    *factor = NULL;
    if (k->rows != k->cols || k->rows < 1)
        return RB_EINVAL;
    rb_sparse_cholesky *f = calloc(1, sizeof *f);
    if (!f)
        return RB_ENOMEM;
    cholmod_start(&f->c);
    f->c.print = 0;
    f->c.final_ll = 1;
    const rb_status s = factorize(k, f);
    if (s == RB_OK)
        *factor = f;
    else
        rb_sparse_cholesky_free(f);
    return s;
}

rb_status rb_sparse_cholesky_solve(rb_sparse_cholesky *factor, const double *b, double *x)
{
    const int n = factor->n;
    for (int i = 0; i < n; i++)
        x[i] = (factor->l ? 1.0 : factor->scale[i]) * factor->scale[i] * b[i];
    if (!factor->l)
        return RB_OK;
    cholmod_dense rhs = dense_view(n, x);
    cholmod_dense *y = cholmod_solve(CHOLMOD_A, factor->l, &rhs, &factor->c);
    if (!y)
        return RB_ENOMEM;
    for (int i = 0; i < n; i++)
        x[i] = factor->scale[i] * ((double *)y->x)[i];
    cholmod_free_dense(&y, &factor->c);
    return RB_OK;
}

#define PANEL 32 /* columns solved at once */

/* One panel of W = H' S (S K S)^-1 S H: columns from ... from + n - 1, dense, h->cols
 * rows each. */
static rb_status congruence_panel(rb_sparse_cholesky *f, const rb_sparse *h, int from, int n,
                                  double *rhs, double *w)
{
    const int rows = h->rows;
    memset(rhs, 0, (size_t)rows * (size_t)n * sizeof *rhs);
    for (int j = 0; j < n; j++)
        for (int k = h->p[from + j]; k < h->p[from + j + 1]; k++)
            rhs[(size_t)j * (size_t)rows + (size_t)h->i[k]] = f->scale[h->i[k]] * h->x[k];
    cholmod_dense b = dense_view(rows, rhs);
    b.ncol = (size_t)n;
    b.nzmax = (size_t)rows * (size_t)n;
    cholmod_dense *x = f->l ? cholmod_solve(CHOLMOD_A, f->l, &b, &f->c) : NULL;
    if (f->l && !x)
        return RB_ENOMEM;
    double *v = f->l ? x->x : rhs;
    for (int j = 0; j < n; j++, v += rows) {
        for (int i = 0; i < rows; i++)
            v[i] *= f->scale[i];
        rb_sparse_apply_transposed(1.0, h, v, 0.0, w + (size_t)j * (size_t)h->cols);
    }
    if (x)
        cholmod_free_dense(&x, &f->c);
    f->flops += 4.0 * n * ((f->l ? f->c.lnz : rows) + h->p[h->cols]);
    return RB_OK;
}

/* The lower triangle of a panel, with its mirror image, column by column. */
static void append_panel(int from, int n, const double *w, rb_triplets *t)
{
    for (int j = 0; j < n; j++) {
        const double *column = w + (size_t)j * (size_t)t->rows;
        for (int i = from + j; i < t->rows; i++) {
            if (column[i] == 0.0)
                continue;
            rb_triplets_add(t, i, from + j, column[i]);
            if (i != from + j)
                rb_triplets_add(t, from + j, i, column[i]);
        }
    }
}

rb_status rb_sparse_cholesky_congruence(rb_sparse_cholesky *factor, const rb_sparse *h,
                                        rb_sparse *w)
{
    *w = (rb_sparse){0};
    const size_t m = (size_t)h->cols;
    rb_arena scratch = {0};
    double *rhs = rb_arena_doubles(&scratch, (size_t)h->rows, PANEL),
           *panel = rb_arena_doubles(&scratch, m, PANEL);
    rb_triplets t = {.rows = h->cols, .cols = h->cols};
    rb_status s = scratch.failed ? RB_ENOMEM : RB_OK;
    for (int j = 0; s == RB_OK && j < h->cols; j += PANEL) {
        const int n = h->cols - j < PANEL ? h->cols - j : PANEL;
        s = congruence_panel(factor, h, j, n, rhs, panel);
        if (s == RB_OK)
            append_panel(j, n, panel, &t);
    }
    if (s == RB_OK)
        s = rb_sparse_from_triplets(&t, w);
    rb_triplets_free(&t);
    return rb_arena_done(&scratch, s);
}

/* UMFPACK's own estimate is an upper bound that is ten to sixty times too large; the
 * analysis of a Cholesky factor of the pattern is exact, and LU takes twice as much. */
rb_status rb_sparse_lu_estimate(const rb_sparse *a, double *flops)
{
    cholmod_common c;
    cholmod_start(&c);
    c.print = 0;
    cholmod_sparse view = view_of(a, 1);
    cholmod_factor *l = cholmod_analyze(&view, &c);
    const rb_status s = l ? RB_OK : RB_ENOMEM;
    *flops = 2.0 * c.fl;
    cholmod_free_factor(&l, &c);
    cholmod_finish(&c);
    return s;
}

rb_status rb_sparse_cholesky_estimate(const rb_sparse *k, double *entries)
{
    cholmod_common c;
    cholmod_start(&c);
    c.print = 0;
    /* one ordering, and no relaxed supernodes: an estimate */
    c.nmethods = 1;
    c.method[0].ordering = CHOLMOD_AMD;
    c.postorder = 1;
    c.supernodal = CHOLMOD_SIMPLICIAL;
    cholmod_sparse view = view_of(k, 1);
    cholmod_factor *l = cholmod_analyze(&view, &c);
    *entries = c.lnz;
    cholmod_free_factor(&l, &c);
    cholmod_finish(&c);
    return *entries > 0.0 ? RB_OK : RB_ENOMEM;
}

double rb_sparse_cholesky_flops(const rb_sparse_cholesky *factor)
{
    return factor->flops;
}

double rb_sparse_cholesky_entries(const rb_sparse_cholesky *factor)
{
    return factor->l ? factor->c.lnz : factor->n;
}

void rb_sparse_cholesky_free(rb_sparse_cholesky *factor)
{
    if (!factor)
        return;
    free(factor->scale);
    cholmod_free_factor(&factor->l, &factor->c);
    cholmod_finish(&factor->c);
    free(factor);
}
