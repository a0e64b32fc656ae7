/* Linear programs under an LCP, by GLPK's simplex methods. */
#include "lcp/proof/linear.h"

#include <glpk.h>

#include <math.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

/* Bounds and reduced costs hold within this part of their size. */
static const double WITHIN = 1e-9;

/* Of two programs with a row per w_i, whose value is M z, and a column per z_i: the elastic
 * one has two more columns per row, which take up what cannot be reached, at a cost of 1. */
struct lcp_linear {
    lcp_matrix M;
    const double *q, *lower, *upper;
    glp_prob *elastic, *least; /* NULL: not made yet */
    double *y, *other, *value; /* n, n, n + 1: multipliers, a row of a tableau; y owns all */
    int *index;                /* n + 1; owned */
    jmp_buf failed;            /* where GLPK gives up: no memory, or a failed assertion */
};

static void give_up(void *info)
{
    lcp_linear *l = info;
    longjmp(l->failed, 1);
}

lcp_near_one rb_lcp_bring_near_one(const lcp_posed *posed, double *memory)
{
    const size_t n = (size_t)posed->M.n;
    const double most = rb_norm_inf(n, posed->q),
                 unit = most > 0.0 ? exp2((double)ilogb(most)) : 1.0;
    double *q = memory, *lower = q + n, *upper = lower + n;
    for (size_t i = 0; i < n; i++) {
        q[i] = posed->q[i] / unit;
        lower[i] = posed->lower ? posed->lower[i] / unit : 0.0;
        upper[i] = posed->upper ? posed->upper[i] / unit : 0.0;
    }
    return (lcp_near_one){unit, q, posed->lower ? lower : NULL, posed->upper ? upper : NULL};
}

rb_status rb_lcp_linear_create(const lcp_matrix *M, const double *q, const double *lower,
                               const double *upper, lcp_linear **linear)
{
    lcp_linear *l = *linear = calloc(1, sizeof *l);
    if (!l)
        return RB_ENOMEM;
    *l = (lcp_linear){.M = *M, .q = q, .lower = lower, .upper = upper};
    const size_t n = (size_t)M->n;
    l->y = rb_alloc(3 * n + 1, 1);
    l->index = malloc((n + 1) * sizeof *l->index);
    /* 2: no memory, with which GLPK would end the program */
    if (l->y && l->index && glp_init_env() <= 1) {
        l->other = l->y + n;
        l->value = l->other + n;
        return RB_OK;
    }
    rb_lcp_linear_free(l);
    *linear = NULL;
    return RB_ENOMEM;
}

void rb_lcp_linear_free(lcp_linear *l)
{
    if (!l)
        return;
    if (l->elastic)
        glp_delete_prob(l->elastic);
    if (l->least)
        glp_delete_prob(l->least);
    free(l->y);
    free(l->index);
    free(l);
}

/* 1: z_i has a lower bound alone, and w_i >= 0; -1: an upper one alone; 0: w_i may have both
 * signs, or is zero. */
static double end_of(const lcp_linear *l, int i)
{
    const int low = isfinite(rb_lcp_lower(l->lower, i)) != 0;
    const int high = isfinite(rb_lcp_upper(l->upper, i)) != 0;
    return low - high;
}

/* The matrix and the costs; what is fixed changes from call to call. */
static glp_prob *make_program(const lcp_linear *l, int elastic)
{
    const int n = l->M.n;
    glp_prob *p = glp_create_prob();
    int *index = malloc(((size_t)n + 1) * sizeof *index);
    double *value = malloc(((size_t)n + 1) * sizeof *value);
    glp_add_rows(p, n);
    glp_add_cols(p, elastic ? 3 * n : n);
    for (int j = 0; index && value && j < n; j++) {
        const lcp_column a = rb_lcp_column(&l->M, j);
        double sum = end_of(l, j);
        int count = 0;
        for (int k = 0; k < a.count; k++)
            if (a.x[k] != 0.0) {
                index[++count] = (a.row ? a.row[k] : k) + 1;
                value[count] = a.x[k];
                sum += end_of(l, index[count] - 1) * a.x[k];
            }
        glp_set_mat_col(p, j + 1, count, index, value);
        if (!elastic)
            glp_set_obj_coef(p, j + 1, sum); /* z_j and its part of all w */
    }
    for (int i = 0; elastic && i < n; i++)
        for (int sign = 0; sign < 2; sign++) {
            const int column = n + 2 * i + sign + 1, row[] = {0, i + 1};
            const double one[] = {0.0, sign ? -1.0 : 1.0};
            glp_set_mat_col(p, column, 1, row, one);
            glp_set_col_bnds(p, column, GLP_LO, 0.0, 0.0);
            glp_set_obj_coef(p, column, 1.0);
        }
    if (!index || !value) {
        glp_delete_prob(p);
        p = NULL;
    }
    free(index);
    free(value);
    return p;
}

static int kind_of(double low, double high)
{
    return low == high      ? GLP_FX
           : !isfinite(low) ? (isfinite(high) ? GLP_UP : GLP_FR)
           : isfinite(high) ? GLP_DB
                            : GLP_LO;
}

/* z_i within the bounds, and M z - (-q) = w with the signs, that the sides ask for. */
static void fix_sides(const lcp_linear *l, glp_prob *p, const lcp_side *side)
{
    for (int i = 0; i < l->M.n; i++) {
        const lcp_side at = side ? side[i] : LCP_OPEN;
        const double low = rb_lcp_lower(l->lower, i), high = rb_lcp_upper(l->upper, i);
        const double from = at == LCP_AT_UPPER ? high : low;
        const double to = at == LCP_AT_LOWER || at == LCP_LEFT_OUT ? low : high;
        const int fixed = low == high || at == LCP_LEFT_OUT; /* w is any number */
        /* w may be positive where z_i can be at its lower bound, negative at the upper one */
        const int plus = fixed || at == LCP_AT_LOWER || (at == LCP_OPEN && isfinite(low));
        const int minus = fixed || at == LCP_AT_UPPER || (at == LCP_OPEN && isfinite(high));
        const double least = minus ? -INFINITY : -l->q[i], most = plus ? INFINITY : -l->q[i];
        glp_set_col_bnds(p, i + 1, kind_of(from, to), from, to);
        glp_set_row_bnds(p, i + 1, kind_of(least, most), least, most);
    }
}

/* 0: solved as far as there is anything to solve; by `method` from the last basis, and once
 * more from the first one. */
static int run_simplex(glp_prob *p, int method)
{
    glp_smcp how;
    glp_init_smcp(&how);
    how.msg_lev = GLP_MSG_OFF;
    how.meth = method;
    how.tol_bnd = how.tol_dj = WITHIN;
    how.it_lim = 2000 + 20 * glp_get_num_cols(p);
    int code = glp_simplex(p, &how);
    if (code != 0) {
        glp_std_basis(p);
        code = glp_simplex(p, &how);
    }
    return code;
}

rb_status rb_lcp_linear_decide(lcp_linear *l, const lcp_side *side, double *z)
{
    const int n = l->M.n;
    if (setjmp(l->failed)) {
        glp_error_hook(NULL, NULL);
        glp_free_env(); /* and all programs with it */
        l->elastic = l->least = NULL;
        return RB_UNDECIDED;
    }
    glp_error_hook(give_up, l);
    if (!l->elastic)
        l->elastic = make_program(l, 1);
    glp_prob *p = l->elastic;
    rb_status s = RB_UNDECIDED;
    if (p) {
        fix_sides(l, p, side);
        if (run_simplex(p, GLP_PRIMAL) == 0 && glp_get_status(p) == GLP_OPT) {
            for (int i = 0; i < n; i++) {
                z[i] = glp_get_col_prim(p, i + 1);
                l->y[i] = glp_get_row_dual(p, i + 1);
            }
            s = glp_get_obj_val(p) <= 10.0 * n * WITHIN ? RB_OK : RB_NO_SOLUTION;
        }
    }
    glp_error_hook(NULL, NULL);
    if (s == RB_NO_SOLUTION && !rb_lcp_excludes(&l->M, l->q, l->lower, l->upper, side, l->y))
        s = RB_UNDECIDED;
    return s;
}

void rb_lcp_linear_multipliers(const lcp_linear *l, double *y)
{
    memcpy(y, l->y, (size_t)l->M.n * sizeof *y);
}

/* y: the multipliers of the row that the dual simplex method has found to be infeasible, from
 * its row of the tableau.  0: it has found none. */
static int read_ray(const lcp_linear *l, glp_prob *p)
{
    const int n = l->M.n, basic = glp_get_unbnd_ray(p);
    if (basic == 0 ||
        (basic <= n ? glp_get_row_stat(p, basic) : glp_get_col_stat(p, basic - n)) != GLP_BS)
        return 0;
    const int count = glp_eval_tab_row(p, basic, l->index, l->value);
    memset(l->y, 0, (size_t)n * sizeof *l->y);
    if (basic <= n)
        l->y[basic - 1] = 1.0;
    for (int k = 1; k <= count; k++)
        if (l->index[k] <= n)
            l->y[l->index[k] - 1] = -l->value[k];
    return 1;
}

/* The multipliers of the last basis of p, of either sign, exclude all z. */
static int ray_excludes(lcp_linear *l, glp_prob *p, const lcp_side *side)
{
    const int n = l->M.n;
    if (!read_ray(l, p))
        return 0;
    memcpy(l->other, l->y, (size_t)n * sizeof *l->y);
    if (rb_lcp_excludes(&l->M, l->q, l->lower, l->upper, side, l->other))
        return 1;
    for (int i = 0; i < n; i++)
        l->other[i] = -l->y[i];
    return rb_lcp_excludes(&l->M, l->q, l->lower, l->upper, side, l->other);
}

rb_status rb_lcp_linear_least(lcp_linear *l, const lcp_side *side, double *z, double *w)
{
    const int n = l->M.n;
    if (setjmp(l->failed)) {
        glp_error_hook(NULL, NULL);
        glp_free_env();
        l->elastic = l->least = NULL;
        return RB_UNDECIDED;
    }
    glp_error_hook(give_up, l);
    if (!l->least)
        l->least = make_program(l, 0);
    glp_prob *p = l->least;
    rb_status s = RB_UNDECIDED;
    if (p) {
        fix_sides(l, p, side);
        if (run_simplex(p, GLP_DUALP) == 0) {
            const int status = glp_get_status(p);
            s = status == GLP_OPT          ? RB_OK
                : ray_excludes(l, p, side) ? RB_NO_SOLUTION
                                           : RB_UNDECIDED;
            for (int i = 0; i < n; i++) {
                z[i] = glp_get_col_prim(p, i + 1);
                w[i] = glp_get_row_prim(p, i + 1) + l->q[i];
            }
        }
    }
    glp_error_hook(NULL, NULL);
    if (s != RB_UNDECIDED)
        return s;
    /* There is a z whose sum could not be minimised: one pair is as good as another. */
    s = rb_lcp_linear_decide(l, side, z);
    memcpy(w, l->q, (size_t)n * sizeof *w);
    for (int j = 0; j < n; j++) {
        const lcp_column a = rb_lcp_column(&l->M, j);
        for (int k = 0; k < a.count; k++)
            w[a.row ? a.row[k] : k] += a.x[k] * z[j];
    }
    return s;
}
