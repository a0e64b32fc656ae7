/* Equilibration of rows and columns (Ruiz, RAL-TR-2001-034, 2001), and the residual in
 * the scale of each row.  The scaled problem is the same one: Lemke's path on it with the
 * covering vector d is the path of the given one with R^-1 d. */
#include "lcp/lemke/lemke.h"
#include "lcp/lemke/scale.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The largest entries of two rows, or of two columns, may differ by this factor: the
 * thresholds of the ratio tests, 1e-10 and less, leave room for it. */
static const double BALANCED = 1024.0;

/* Where the largest entries of all rows and columns are within this factor of 1, and
 * sweeps at most. */
static const double CLOSE = 1.5;
enum { SWEEPS = 30, BALANCING = 20, TO_REST = 500 };
/* A change of all exponents that ends the balancing. */
static const double AT_REST = 1e-9;

/* A row whose terms are smaller than this part of those of the rows that share unknowns
 * with it is divided by this part of them, because it may contain only their rounding
 * errors. */
static const double FAINT = 1e-4;
/* A residual above this part of max |q| is no rounding of rows whose entries are
 * negligible here. */
static const double PLAIN = 1e-6;

/* Rounding of the terms of z beyond this part of q, or of what bounds come to, hides them. */
static const double HIDDEN = 0.1;

/* A residual that needs no closer look. */
static const double EXACT = 1e-13;

/* ---- Scales ------------------------------------------------------------------------ */

/* The largest |r_i M_ij c_j| of each row and column; r, c NULL: ones. */
static void largest_entries(const lcp_matrix *M, const double *r, const double *c, double *row,
                            double *col)
{
    memset(row, 0, (size_t)M->n * sizeof *row);
    for (int j = 0; j < M->n; j++) {
        const lcp_column a = rb_lcp_column(M, j);
        double most = 0.0;
        for (int k = 0; k < a.count; k++) {
            const int i = a.row ? a.row[k] : k;
            const double x = fabs(r ? a.x[k] * r[i] * c[j] : a.x[k]);
            row[i] = x > row[i] ? x : row[i];
            most = x > most ? x : most;
        }
        col[j] = most;
    }
}

/* The extremes of those that are not zero. */
static void widen(int n, const double *x, double *least, double *most)
{
    for (int i = 0; i < n; i++)
        if (x[i] > 0.0) {
            *least = fmin(*least, x[i]);
            *most = fmax(*most, x[i]);
        }
}

static int differ_by(int n, const double *x, double factor)
{
    double least = INFINITY, most = 0.0;
    widen(n, x, &least, &most);
    return most > factor * least;
}

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
 * little of any scaling of a problem (Curtis and Reid, IMA Journal of Applied Mathematics
 * 10, 1972).  Ruiz' sweeps alone do not look at q, and can leave 2^80 between the q of
 * rows that share no unknowns.  sum, count: n each. */
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

rb_status rb_lcp_scale_create(const lcp_matrix *M, const double *q, int always, lcp_scale *s)
{
    const int n = M->n;
    *s = (lcp_scale){.row = rb_alloc((size_t)n, 4)};
    if (!s->row)
        return RB_ENOMEM;
    double *r = s->row, *c = s->col = r + n, *row = c + n, *col = row + n;
    largest_entries(M, NULL, NULL, row, col);
    s->largest = rb_norm_inf((size_t)n, col);
    /* beside the covering vector of ones M as a whole must be near 1 too */
    const int apart = s->largest > BALANCED || s->largest * BALANCED < 1.0;
    s->needed = always || (apart && s->largest > 0.0) || differ_by(n, row, BALANCED) ||
                differ_by(n, col, BALANCED);
    for (int i = 0; i < n; i++) {
        r[i] = 1.0;
        c[i] = s->largest == 0.0 ? 1.0 : exp2(-round(log2(s->largest)));
    }
    if (s->needed) {
        balance_exponents(M, q, always ? TO_REST : BALANCING, r, c, row, col);
        largest_entries(M, r, c, row, col);
    }
    for (int k = 0; s->needed && k < SWEEPS; k++) {
        double least = INFINITY, most = 0.0;
        for (int i = 0; i < n; i++) {
            r[i] /= row[i] > 0.0 ? sqrt(row[i]) : 1.0;
            c[i] /= col[i] > 0.0 ? sqrt(col[i]) : 1.0;
        }
        largest_entries(M, r, c, row, col);
        widen(n, row, &least, &most);
        widen(n, col, &least, &most);
        if (most <= CLOSE && least * CLOSE >= 1.0)
            break;
    }
    for (int i = 0; s->needed && i < n; i++) {
        r[i] = power_of_two(r[i]);
        c[i] = power_of_two(c[i]);
    }
    return RB_OK;
}

void rb_lcp_scale_free(lcp_scale *s)
{
    free(s->row);
    *s = (lcp_scale){0};
}

/* ---- The problem that is solved ------------------------------------------------------------ */

/* The size of a variable (w 0 ... n - 1, z, z0) in units of the scaled problem. */
static double unit_of(const lcp_scale *s, int n, int variable)
{
    return variable < n ? 1.0 / s->row[variable] : variable < 2 * n ? s->col[variable - n] : 1.0;
}

/* Hands the pivot on in the caller's units.  The artificial variable of mixed problems
 * with free variables, whose halves are numbered from n on, is the only one there with a
 * number that depends on them. */
static void trace_in_units(const rb_lcp_pivot *p, void *context)
{
    lcp_posed *s = context;
    const int n = p->n;
    rb_lcp_pivot record = *p;
    for (int i = 0; i < n; i++)
        s->value[i] = p->value[i] * unit_of(&s->scale, n, p->basis[i]);
    record.value = s->value;
    record.ratio *= unit_of(&s->scale, n, p->entering);
    if (p->tableau) {
        for (int c = 0; c < n + 2; c++) {
            const double of_column = c <= n ? unit_of(&s->scale, n, p->nonbasis[c]) : 1.0;
            for (int i = 0; i < n; i++) {
                const size_t at = (size_t)i + (size_t)c * (size_t)n;
                s->tableau[at] = p->tableau[at] * unit_of(&s->scale, n, p->basis[i]) / of_column;
            }
        }
        record.tableau = s->tableau;
    }
    s->caller.trace(&record, s->caller.trace_context);
}

/* to = by times from, or over it where `inverse`.  A finite number that overflows becomes
 * the largest one, as a bound that no solution in the scale reaches; 0: there is one. */
static int scale_vector(int n, const double *by, int inverse, const double *from, double *to)
{
    int fits = 1;
    for (int i = 0; from && i < n; i++) {
        to[i] = inverse ? from[i] / by[i] : from[i] * by[i];
        if (isinf(to[i]) && !isinf(from[i])) {
            to[i] = copysign(DBL_MAX, to[i]);
            fits = 0;
        }
    }
    return fits;
}

/* In the scale, which is known. */
static rb_status pose_scaled(lcp_posed *s)
{
    const lcp_matrix given = s->M;
    const rb_lcp_options *opt = &s->caller;
    const double *row = s->scale.row, *col = s->scale.col;
    const int n = given.n, tableau = opt->trace && opt->trace_tableau && given.dense;
    const size_t order = (size_t)n;
    s->vectors = rb_alloc(order, 6);
    s->dense = given.dense ? rb_alloc(order, order) : NULL;
    s->tableau = tableau ? rb_alloc(order, order + 2) : NULL;
    if (!s->vectors || (given.dense && !s->dense) || (tableau && !s->tableau) ||
        (!given.dense && rb_sparse_copy(given.sparse, &s->sparse) != RB_OK))
        return RB_ENOMEM;
    for (int j = 0; j < n; j++) {
        const lcp_column a = rb_lcp_column(&given, j);
        double *to = s->dense ? s->dense + (size_t)j * order : s->sparse.x + s->sparse.p[j];
        for (int k = 0; k < a.count; k++)
            to[k] = a.x[k] * row[a.row ? a.row[k] : k] * col[j];
    }
    double *q = s->vectors, *cover = q + n, *start = cover + n, *lower = start + n,
           *upper = lower + n;
    s->value = upper + n;
    scale_vector(n, row, 0, s->q, q);
    scale_vector(n, row, 0, opt->cover, cover);
    scale_vector(n, col, 1, s->lower, lower);
    scale_vector(n, col, 1, s->upper, upper);
    const int starts = opt->start && scale_vector(n, col, 1, opt->start, start);
    s->scaled = 1;
    s->largest = 1.0;
    s->M = (lcp_matrix){n, s->dense, n, s->dense ? NULL : &s->sparse};
    s->q = q;
    s->lower = s->lower ? lower : NULL;
    s->upper = s->upper ? upper : NULL;
    s->opt.cover = opt->cover ? cover : NULL;
    s->opt.start = starts ? start : NULL;
    if (opt->trace) {
        s->opt.trace = trace_in_units;
        s->opt.trace_context = s;
    }
    return RB_OK;
}

rb_status rb_lcp_pose(const lcp_matrix *M, const double *q, const double *lower,
                      const double *upper, const rb_lcp_options *opt, int always, lcp_posed *s)
{
    *s = (lcp_posed){.M = *M, .q = q, .lower = lower, .upper = upper, .opt = *opt, .caller = *opt};
    /* by the entries that are not zero alone, where they are known */
    const lcp_matrix entries = {
        .n = M->n, .dense = M->sparse ? NULL : M->dense, .ld = M->ld, .sparse = M->sparse};
    const rb_status status = rb_lcp_scale_create(&entries, q, always, &s->scale);
    s->largest = s->scale.largest;
    return status == RB_OK && s->scale.needed ? pose_scaled(s) : status;
}

void rb_lcp_posed_free(lcp_posed *s)
{
    rb_lcp_scale_free(&s->scale);
    free(s->dense);
    free(s->tableau);
    free(s->vectors);
    rb_sparse_free(&s->sparse);
    *s = (lcp_posed){0};
}

void rb_lcp_scale_back(const lcp_posed *s, double *z)
{
    for (int i = 0; s->scaled && i < s->M.n; i++)
        z[i] *= s->scale.col[i];
}

/* ---- The residual of each row in its own scale -------------------------------------- */

/* felt[i]: the largest terms, in the scale, of the rows that share an unknown with row i,
 * by row i's entry of that unknown: rounding errors of them come through it.  of_any: also
 * of unknowns that are zero. */
static void largest_neighbours(const lcp_matrix *M, const lcp_scale *s, const double *z,
                               const double *terms, double *of_any, double *felt)
{
    memset(of_any, 0, (size_t)M->n * sizeof *of_any);
    memset(felt, 0, (size_t)M->n * sizeof *felt);
    for (int j = 0; j < M->n; j++) {
        const lcp_column a = rb_lcp_column(M, j);
        double largest = 0.0;
        for (int k = 0; k < a.count; k++) {
            const int i = a.row ? a.row[k] : k;
            if (a.x[k] != 0.0)
                largest = fmax(largest, terms[i] * s->row[i]);
        }
        for (int k = 0; k < a.count; k++) {
            const int i = a.row ? a.row[k] : k;
            const double own = fabs(a.x[k]) * s->row[i] * s->col[j] * largest;
            of_any[i] = fmax(of_any[i], own);
            if (z[j] != 0.0)
                felt[i] = fmax(felt[i], own);
        }
    }
}

rb_status rb_lcp_measure(const lcp_matrix *M, const lcp_scale *scale, const double *q,
                         const double *lower, const double *upper, const double *z,
                         rb_lcp_info *info)
{
    const int n = M->n;
    double *w = rb_alloc((size_t)n, 5);
    if (!w)
        return RB_ENOMEM;
    double *terms = w + n, *of_any = terms + n, *felt = of_any + n, *data = felt + n;
    const double plain = PLAIN * rb_norm_inf((size_t)n, q);
    /* w = M z + q and the terms of each row, |M| |z| + |q|. */
    for (int i = 0; i < M->n; i++) {
        w[i] = q[i];
        terms[i] = data[i] = fabs(q[i]);
    }
    for (int j = 0; j < M->n; j++) {
        const lcp_column a = rb_lcp_column(M, j);
        const double x = z[j];
        for (int k = 0; x != 0.0 && k < a.count; k++) {
            const int i = a.row ? a.row[k] : k;
            const double t = a.x[k] * x;
            w[i] += t;
            terms[i] += fabs(t);
        }
        const int given = x == rb_lcp_lower(lower, j) || x == rb_lcp_upper(upper, j);
        for (int k = 0; given && x != 0.0 && k < a.count; k++)
            data[a.row ? a.row[k] : k] += fabs(a.x[k] * x);
    }
    /* Of z that are so large that rounding of their terms hides q and the bounds nothing is
     * known: they may stand for a matrix that is singular. */
    double largest = 0.0, known = 0.0;
    for (int i = 0; i < n; i++) {
        largest = fmax(largest, terms[i] * scale->row[i]);
        known = fmax(known, data[i] * scale->row[i]);
    }
    const double hidden = known > 0.0 ? DBL_EPSILON * largest / known : 0.0;
    /* rows that share unknowns are looked for only where a row does not pass alone */
    for (int pass = 0; pass < 2; pass++) {
        info->res = info->scaled = 0.0;
        info->row = -1;
        for (int i = 0; i < n; i++) {
            const double r = scale->row[i], c = scale->col[i];
            const double low = z[i] - rb_lcp_lower(lower, i);
            const double high = z[i] - rb_lcp_upper(upper, i);
            const double own = fabs(fmax(fmin(low, w[i]), high));
            const double scaled = fabs(fmax(fmin(low / c, w[i] * r), high / c));
            const double others = pass == 0 ? 0.0 : own <= plain ? of_any[i] : felt[i];
            const double size = fmax(terms[i] * r, FAINT * others);
            const double part = scaled == 0.0 ? 0.0 : scaled / size;
            if (isnan(z[i]) || !isfinite(terms[i]) || isnan(part)) {
                info->res = info->scaled = NAN;
                info->row = i;
                break;
            }
            info->res = fmax(info->res, own);
            if (part > info->scaled) {
                info->scaled = part;
                info->row = i;
            }
        }
        if (pass == 0 && info->scaled <= EXACT && !(hidden > HIDDEN))
            break;
        if (pass == 0)
            largest_neighbours(M, scale, z, terms, of_any, felt);
    }
    if (hidden > HIDDEN && !isnan(info->scaled) && hidden > info->scaled) {
        info->scaled = hidden;
        info->row = info->row < 0 ? 0 : info->row;
    }
    free(w);
    return RB_OK;
}

rb_status rb_lcp_scaled_residual(const rb_lcp_mixed_problem *p, const double *z, double *scaled,
                                 int *row)
{
    const lcp_matrix M = {.n = p->M->rows, .sparse = p->M};
    rb_lcp_info info = {.scaled = NAN, .row = -1};
    lcp_scale s = {0};
    rb_status status = rb_lcp_scale_create(&M, p->q, 0, &s);
    if (status == RB_OK)
        status = rb_lcp_measure(&M, &s, p->q, p->lower, p->upper, z, &info);
    rb_lcp_scale_free(&s);
    *scaled = info.scaled;
    if (row)
        *row = info.row;
    return status;
}
