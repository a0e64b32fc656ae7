/* Absence by Farkas' lemma: 0 <= y'w = y'(M z + q) for all z and w of the sides, and a bound of the
 * right-hand side that is negative.  A coefficient (M'y)_j of a z_j without an upper bound must
 * not be positive: outward rounding never shows that of one that is zero, as they are for Lemke's
 * rays of copositive matrices, so that such signs are computed without rounding. */
#include "lcp/proof/absent.h"

#include "lcp/proof/bounds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Unknowns of the linear program at most. */
enum { MOST_UNKNOWNS = 400 };

/* A sum that is to be bounded: of so many terms, with what their own errors come to. */
typedef struct {
    double value, size, error;
    size_t terms;
} upper_sum;

static void add_product(upper_sum *s, double a, double b, double error)
{
    s->value += a * b;
    s->size += fabs(a * b);
    s->error = proof_up(4, s->error + error);
    s->terms++;
}

/* (M'y)_j with its error; 0: it has no terms.  a, b: the terms, n each. */
static size_t coefficient(const lcp_matrix *M, int j, const double *y, double *a, double *b,
                          double *value, double *error)
{
    const lcp_column column = rb_lcp_column(M, j);
    size_t count = 0;
    proof_dot sum = {0};
    for (int k = 0; k < column.count; k++) {
        const double of = y[column.row ? column.row[k] : k];
        if (column.x[k] == 0.0 || of == 0.0)
            continue;
        a[count] = column.x[k];
        b[count++] = of;
        proof_add(&sum, column.x[k], of);
    }
    *value = *error = 0.0;
    if (count)
        *value = proof_value(&sum, count, error);
    return count;
}

double rb_proof_least_sum(const lcp_matrix *M, const double *q, const double *lower,
                          const double *upper, const lcp_side *side, const double *most,
                          const double *y)
{
    const int n = M->n;
    const size_t order = (size_t)n;
    double *own = rb_alloc(order, 3), *a = own + order, *b = a + order, steepest = 0.0;
    upper_sum sum = {0};
    int useful = own != NULL;
    for (int i = 0; useful && i < n; i++) { /* y_i w_i >= 0 */
        const double low = rb_lcp_lower(lower, i), high = rb_lcp_upper(upper, i);
        own[i] = rb_lcp_multiplier(side ? side[i] : LCP_OPEN, low, high, y[i]);
        if (own[i] != 0.0)
            add_product(&sum, own[i], q[i], 0.0);
    }
    for (int j = 0; useful && j < n; j++) {
        const lcp_side at = side ? side[j] : LCP_OPEN;
        double low = at == LCP_AT_UPPER ? rb_lcp_upper(upper, j) : rb_lcp_lower(lower, j),
               high = at == LCP_AT_LOWER || at == LCP_LEFT_OUT ? low : rb_lcp_upper(upper, j), c,
               error;
        if (most) {
            low = fmax(low, -most[j]);
            high = fmin(high, most[j]);
        }
        const size_t terms = coefficient(M, j, own, a, b, &c, &error);
        if (terms == 0)
            continue;
        if (isfinite(low) && isfinite(high)) /* at the end that makes the sum larger */
            add_product(&sum, c, c > 0.0 ? high : low, error * fmax(fabs(low), fabs(high)));
        else {
            const int sign = c - error > 0.0   ? 1
                             : c + error < 0.0 ? -1
                                               : rb_exact_sign(terms, a, b);
            if (isinf(low))
                useful = sign == 0 || (isfinite(high) && sign == 1);
            else if (sign != 0 && sign != -1)
                steepest = fmax(steepest, proof_up(4, c + error));
            if (sign != 0 && isfinite(isinf(low) ? high : low))
                add_product(&sum, c, isinf(low) ? high : low,
                            error * fabs(isinf(low) ? high : low));
        }
    }
    /* 0 <= value + steepest sum (z - lower) */
    const double gain =
        -(sum.value + proof_up(8, sum.error) + proof_error(sum.terms + 4, sum.size));
    free(own);
    if (!useful || !(gain > 0.0) || isnan(steepest))
        return 0.0;
    return steepest > 0.0 ? gain / steepest * (1.0 - 8.0 * PROOF_U) : INFINITY;
}

int rb_proof_nearly_whole(size_t n, const double *y, int by, double *rounded)
{
    const double most = rb_norm_inf(n, y);
    double off = most > 0.0 ? 0.0 : INFINITY;
    for (size_t i = 0; i < n; i++) {
        const double x = y[i] / most * (by ? by : 1.0), whole = by ? round(x) : x;
        off = fmax(off, fabs(x - whole));
        rounded[i] = whole;
    }
    return off <= 1e-5;
}

rb_status rb_proof_absence_create(const lcp_matrix *M, const double *q, const double *lower,
                                  const double *upper, const double *most, proof_absence *a)
{
    const rb_lcp_options plain = rb_lcp_defaults();
    const size_t n = (size_t)M->n;
    *a = (proof_absence){.M = M, .q = q, .lower = lower, .upper = upper, .most = most};
    a->memory = rb_alloc(n, 5);
    rb_status s = a->memory ? rb_lcp_pose(M, q, lower, upper, &plain, 1, &a->posed) : RB_ENOMEM;
    if (s != RB_OK)
        return s;
    const lcp_near_one near = rb_lcp_bring_near_one(&a->posed, a->memory);
    return rb_lcp_linear_create(&a->posed.M, near.q, near.lower, near.upper, &a->linear);
}

void rb_proof_absence_free(proof_absence *a)
{
    rb_lcp_linear_free(a->linear);
    if (a->memory)
        rb_lcp_posed_free(&a->posed);
    free(a->memory);
    *a = (proof_absence){0};
}

double rb_proof_absence_least_sum(proof_absence *a, const lcp_side *side)
{
    const size_t n = (size_t)a->M->n;
    double *y = a->memory + 3 * n, *rounded = y + n, least = 0.0;
    if (rb_lcp_linear_decide(a->linear, side, rounded) == RB_OK)
        return 0.0;
    rb_lcp_linear_multipliers(a->linear, y);
    for (size_t i = 0; i < n && a->posed.scaled; i++)
        y[i] *= a->posed.scale.row[i];
    for (int by = 0; by <= PROOF_MULTIPLES && least < INFINITY; by++)
        if (rb_proof_nearly_whole(n, y, by, rounded))
            least = fmax(
                least, rb_proof_least_sum(a->M, a->q, a->lower, a->upper, side, a->most, rounded));
    return least;
}

rb_status rb_lcp_prove_absence(const rb_lcp_mixed_problem *p, rb_lcp_proof *proof)
{
    const lcp_matrix M = {.n = p->M->rows, .sparse = p->M};
    const rb_lcp_options plain = rb_lcp_defaults();
    proof_absence absence;
    rb_status s = rb_lcp_check_mixed(p, &plain, NULL);
    proof->least_sum = 0.0;
    if (s != RB_OK || M.n > MOST_UNKNOWNS || !rb_proof_arithmetic())
        return s;
    s = rb_proof_absence_create(&M, p->q, p->lower, p->upper, NULL, &absence);
    if (s == RB_OK)
        proof->least_sum = rb_proof_absence_least_sum(&absence, NULL);
    rb_proof_absence_free(&absence);
    return s;
}

rb_status rb_lcp_prove_or_exclude(const rb_lcp_mixed_problem *p, const double *z,
                                  rb_lcp_proof *proof)
{
    const rb_status s = rb_lcp_prove(p, z, proof);
    const rb_status absence = s == RB_UNDECIDED ? rb_lcp_prove_absence(p, proof) : RB_OK;
    return absence == RB_OK ? s : absence;
}
