/* The operator as matrices: products by BLAS, zones solved by an LU that is kept. */
#include "lcp/contact/dense.h"
#include "base/sizes.h"

#include <cblas.h>
#include <stdlib.h>

/* Solves with one LU before it is given up, and the relative correction that is the last
 * one: the next would be rounding.  Where friction has turned slightly each falls by the
 * same factor only. */
enum { PASSES = 3, PASSES_SLIGHT = 8 };
static const double SMALL = 1e-6, SMALL_SLIGHT = 1e-12;
/* Of the tractions before delta and xi take part: three digits cancel. */
static const double MOST_GROWTH = 1e3;
/* Of the largest force that friction carries: what a given force may lack of itself. */
static const double FORCE_LACKS = 1e-13;

static void dense_free(rb_contact_operator *op)
{
    rb_contact_dense *dense = (rb_contact_dense *)op;

    rb_contact_factors_free(dense->factors);
    rb_contact_operator_free(dense->products);
    free(dense->S);
    free(dense);
}

static void dense_forget(rb_contact_operator *op)
{
    rb_contact_factors_clear(((rb_contact_dense *)op)->factors);
}

/* ---- Products ---------------------------------------------------------------------- */

/* y += A x; separated elements at the ends cost nothing. */
static void add_product(int n, const double *A, int lda, const double *x, double *y)
{
    int from = 0, to = n;

    while (from < to && x[from] == 0.0)
        from++;
    while (from < to && x[to - 1] == 0.0)
        to--;
    if (from < to)
        cblas_dgemv(CblasColMajor, CblasNoTrans, n, to - from, 1.0, A + (size_t)from * (size_t)lda,
                    lda, x + from, 1, 1.0, y, 1);
}

/* gap += F_NN p + F_NT q (K1), slip += S_N p + S_T q (K2); half of it without coupling. */
static void dense_add(rb_contact_operator *op, const double *p, const double *q, double *gap,
                      double *slip)
{
    const rb_contact_matrix *K = &op->matrix;
    const int n = op->n;
    const size_t half = (size_t)n;

    add_product(n, K->F, K->ldf, p, gap);
    add_product(n, K->S + half * half, n, q, slip);
    if (op->response.coupled) {
        add_product(n, K->F + half * (size_t)K->ldf, K->ldf, q, gap);
        add_product(n, K->S, n, p, slip);
    }
}

static double mean_diagonal(int n, const double *M, size_t ld)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++)
        sum += fabs(M[i + (size_t)i * ld]);
    return sum / n;
}

static int any_nonzero(int n, const double *M, int ld)
{
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            if (M[i + (size_t)j * (size_t)ld] != 0.0)
                return 1;
    return 0;
}

/* ---- Zones held fixed -------------------------------------------------------------- */

/* Solves, and where a kept LU served or digits were lost, solves again for what the
 * equations still lack, until a correction is small; where none is, with another LU. */
static rb_status dense_solve(const rb_contact_problem *p, rb_contact_state *state,
                             rb_contact_reduced *r)
{
    rb_contact_problem by_products = *p;
    rb_status s = RB_OK;
    int converged = 0;

    /* Large systems by GMRES, where the elements also have products. */
    by_products.op = rb_contact_operator_by_products(p->op, r->size);
    if (by_products.op && by_products.op->kind->solve(&by_products, state, r) == RB_OK)
        return RB_OK;
    for (int lu = RB_LU_KEPT; lu < RB_LU_KINDS && s >= 0 && !converged; lu++) {
        rb_contact_elimination *elimination;
        double size = 0.0;
        int passes = PASSES;

        rb_contact_reduced_clear(p, r, state);
        s = rb_contact_elimination_begin(p, state->zone, (rb_contact_lu)lu, r, &elimination);
        for (int pass = 0; pass < passes && s == RB_OK && !converged; pass++) {
            rb_contact_reduced_right_side(p, state, r);
            rb_contact_elimination_solve(elimination, r);
            s = rb_contact_reduced_add(p, r, state);
            if (s != RB_OK)
                break;
            const double change = rb_norm_inf((size_t)r->size, r->x);
            const double small = r->slight > 0 ? SMALL_SLIGHT : SMALL;
            converged = (r->changes == 0 && r->slight == 0 && r->growth < MOST_GROWTH) ||
                        (pass > 0 && change <= small * size);
            /* A stick zone's friction comes out of numbers as large as the pressure, which leaves
             * no digit of it where mu is small: the next pass has them. */
            converged = converged && rb_contact_reduced_force_lacks(p, state, r) <= FORCE_LACKS;
            passes = r->slight > 0 ? PASSES_SLIGHT : PASSES;
            size = fmax(size, change);
        }
        rb_contact_elimination_end(elimination);
    }
    return s;
}

/* ---- The kind ---------------------------------------------------------------------- */

rb_status rb_contact_operator_dense(int n, const double *F, int ldf, double *S,
                                    rb_contact_operator **op)
{
    static const rb_contact_kind kind = {.add = dense_add,
                                         .solve = dense_solve,
                                         .forget = dense_forget,
                                         .halve = rb_contact_dense_halve,
                                         .free = dense_free};
    rb_contact_dense *dense = calloc(1, sizeof *dense);
    rb_status s = dense ? rb_contact_factors_create(&dense->factors) : RB_ENOMEM;

    *op = NULL;
    if (s != RB_OK) {
        free(dense);
        free(S);
        return s;
    }
    dense->S = S;
    dense->base = (rb_contact_operator){.kind = &kind, .n = n, .matrix = {F, ldf, S}};
    const size_t length = (size_t)n, columns = length * (size_t)ldf; /* of F_NN */
    dense->base.response =
        (rb_contact_response){.gap = mean_diagonal(n, F, (size_t)ldf),
                              .slip = mean_diagonal(n, S + length * length, length),
                              .coupled_slip = rb_norm_1(length, S + length / 2, length),
                              .coupled = any_nonzero(n, S, n) || any_nonzero(n, F + columns, ldf)};
    *op = &dense->base;
    return RB_OK;
}

rb_status rb_contact_operator_stretch(rb_contact_operator *op, double scale, double along)
{
    rb_contact_dense *dense = (rb_contact_dense *)op;
    const size_t n = (size_t)op->n;

    if (!op->matrix.F || dense->products)
        return RB_EINVAL;
    cblas_dscal((int)(2 * n * n), scale, dense->S, 1);
    op->response.gap *= scale;
    op->response.slip *= scale;
    op->response.coupled_slip *= scale;
    rb_contact_factors_move(dense->factors, dense->along, dense->along - along);
    dense->along -= along;
    return RB_OK;
}

void rb_contact_operator_add_products(rb_contact_operator *dense, rb_contact_operator *products)
{
    rb_contact_dense *of = (rb_contact_dense *)dense;

    rb_contact_operator_free(of->products);
    of->products = products;
}

int rb_contact_dense_has_products(const rb_contact_operator *op)
{
    return op->matrix.F && ((const rb_contact_dense *)op)->products;
}

rb_contact_operator *rb_contact_operator_by_products(rb_contact_operator *op, int unknowns)
{
    if (!op->matrix.F)
        return op;
    return unknowns >= RB_CONTACT_PRODUCTS_FROM ? ((const rb_contact_dense *)op)->products : NULL;
}
