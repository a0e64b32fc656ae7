/* Equilibration of a matrix whose rows and columns differ: the exponents of [M q] are balanced
 * (Curtis and Reid, IMA Journal of Applied Mathematics 10, 1972), then the largest entries of all
 * rows and columns are brought near 1 (Ruiz, RAL-TR-2001-034, 2001). */
#include "lcp/lemke/scale.h"

#include <math.h>
#include <string.h>

/* The sweeps end where the largest entries of all rows and columns are within this factor of 1. */
static const double CLOSE = 1.5;
enum { SWEEPS = 30, BALANCING = 20, TO_REST = 500 };
/* A change of all exponents that ends the balancing. */
static const double AT_REST = 1e-9;

/* The exponents of rows may grow and those of columns fall by the same number, in each part of
 * [M q] that hangs together: by one that makes the exponent of its first row whole, so
 * that no fraction depends on the units that M was given in.  label: n. */
static void anchor(const lcp_matrix *M, const double *q, double *r, double *c, double *label)
{
    const int n = M->n;
    int first = -1, changes = 1;
    for (int i = 0; i < n; i++) {
        first = first < 0 && q[i] != 0.0 ? i : first;
        label[i] = q[i] != 0.0 ? first : i;
    }
    for (int pass = 0; changes && pass < n; pass++) {
        changes = 0;
        for (int j = 0; j < n; j++) {
            const lcp_column a = rb_lcp_column(M, j);
            double least = n;
            for (int k = 0; k < a.count; k++)
                if (a.x[k] != 0.0)
                    least = fmin(least, label[a.row ? a.row[k] : k]);
            for (int k = 0; k < a.count; k++) {
                double *own = &label[a.row ? a.row[k] : k];
                if (a.x[k] != 0.0 && *own != least) {
                    *own = least;
                    changes = 1;
                }
            }
        }
        /* what q joins stays together */
        for (int i = 0; i < n && first >= 0; i++)
            label[first] = q[i] != 0.0 ? fmin(label[first], label[i]) : label[first];
        for (int i = 0; i < n && first >= 0; i++)
            label[i] = q[i] != 0.0 ? label[first] : label[i];
    }
    for (int j = 0; j < n; j++) {
        const lcp_column a = rb_lcp_column(M, j);
        for (int k = 0; k < a.count; k++)
            if (a.x[k] != 0.0) {
                const double own = r[(int)label[a.row ? a.row[k] : k]];
                c[j] -= round(own) - own;
                break;
            }
    }
    for (int i = n - 1; i >= 0; i--) { /* a label is not above its row */
        const double own = r[(int)label[i]];
        r[i] += round(own) - own;
    }
}

/* The mean exponents of rows and columns of [M q] become zero in turns, which leaves
 * little of any scaling of a problem (Curtis and Reid).  Ruiz' sweeps alone do not look at q, and
 * can leave 2^80 between the q of rows that share no unknowns.  sum, count: n each. */
static void balance_exponents(const lcp_matrix *M, const double *q, int sweeps, double *r,
                              double *c, double *sum, double *count)
{
    const int n = M->n;
    double of_q = 0.0, change = 0.0;
    memset(r, 0, (size_t)n * sizeof *r);
    memset(c, 0, (size_t)n * sizeof *c);
    for (int sweep = 0; sweep < sweeps; sweep++) {
        double sum_q = 0.0, count_q = 0.0;
        for (int i = 0; i < n; i++) {
            count[i] = q[i] != 0.0;
            sum[i] = q[i] != 0.0 ? ilogb(q[i]) + of_q : 0.0;
        }
        for (int j = 0; j < n; j++) {
            const lcp_column a = rb_lcp_column(M, j);
            double own = 0.0, entries = 0.0;
            for (int k = 0; k < a.count; k++)
                if (a.x[k] != 0.0) {
                    const int i = a.row ? a.row[k] : k;
                    const double e = ilogb(a.x[k]);
                    sum[i] += e + c[j];
                    count[i] += 1.0;
                    own += e + r[i];
                    entries += 1.0;
                }
            if (sweep % 2 && entries > 0.0) {
                change = fmax(change, fabs(c[j] + own / entries));
                c[j] = -own / entries;
            }
        }
        for (int i = 0; i < n; i++) {
            if (sweep % 2 == 0 && count[i] > 0.0) {
                change = fmax(change, fabs(r[i] + sum[i] / count[i]));
                r[i] = -sum[i] / count[i];
            }
            if (q[i] != 0.0) {
                sum_q += ilogb(q[i]) + r[i];
                count_q += 1.0;
            }
        }
        if (sweep % 2 && count_q > 0.0) {
            change = fmax(change, fabs(of_q + sum_q / count_q));
            of_q = -sum_q / count_q;
        }
        if (sweep % 2) {
            if (change <= AT_REST)
                break;
            change = 0.0;
        }
    }
    if (sweeps == TO_REST)
        anchor(M, q, r, c, sum);
    for (int i = 0; i < n; i++) {
        r[i] = exp2(r[i]);
        c[i] = exp2(c[i]);
    }
}

/* A near one whose products with the numbers of a problem neither vanish nor overflow where
 * these are near 1.  Exponents are often halves, and do not change there. */
static double power_of_two(double x)
{
    const double most = 1000.0;
    return exp2(fmin(fmax(floor(log2(x) + 0.3), -most), most));
}

void rb_lcp_equilibrate(const lcp_matrix *M, const double *q, int always, double *r, double *c,
                        double *row, double *col)
{
    const int n = M->n;
    balance_exponents(M, q, always ? TO_REST : BALANCING, r, c, row, col);
    rb_lcp_largest_entries(M, r, c, row, col);
    for (int k = 0; k < SWEEPS; k++) {
        double least = INFINITY, most = 0.0;
        for (int i = 0; i < n; i++) {
            r[i] /= row[i] > 0.0 ? sqrt(row[i]) : 1.0;
            c[i] /= col[i] > 0.0 ? sqrt(col[i]) : 1.0;
        }
        rb_lcp_largest_entries(M, r, c, row, col);
        rb_lcp_extremes(n, row, &least, &most);
        rb_lcp_extremes(n, col, &least, &most);
        if (most <= CLOSE && least * CLOSE >= 1.0)
            break;
    }
    /* Powers of two scale without rounding. */
    for (int i = 0; i < n; i++) {
        r[i] = power_of_two(r[i]);
        c[i] = power_of_two(c[i]);
    }
}
