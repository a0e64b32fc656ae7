/* The scale of a problem (4.4): whether rows and columns of M differ so much that R M C is solved
 * instead, with the residual in the scale of each row.  The scaled problem is the same one: Lemke's
 * path on it with the covering vector d is the path of the given one with R^-1 d. */
#include "lcp/lemke/lemke.h"
#include "lcp/lemke/scale.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The largest entries of two rows, or of two columns, may differ by this factor: the
 * thresholds of the ratio tests, 1e-10 and less, leave room for it. */
static const double BALANCED = 1024.0;

/* The largest |r_i M_ij c_j| of each row and column; r, c NULL: ones. */
void rb_lcp_largest_entries(const lcp_matrix *M, const double *r, const double *c, double *row,
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

/* The extremes of the entries that are not zero: *least and *most are widened to them. */
void rb_lcp_extremes(int n, const double *x, double *least, double *most)
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
    rb_lcp_extremes(n, x, &least, &most);
    return most > factor * least;
}

rb_status rb_lcp_scale_create(const lcp_matrix *M, const double *q, int always, lcp_scale *s)
{
    const int n = M->n;
    *s = (lcp_scale){.row = rb_alloc((size_t)n, 4)};
    if (!s->row)
        return RB_ENOMEM;
    double *r = s->row, *c = s->col = r + n, *row = c + n, *col = row + n;
    rb_lcp_largest_entries(M, NULL, NULL, row, col);
    s->largest = rb_norm_inf((size_t)n, col);
    /* The covering vector is of ones, so that M as a whole must be near 1 too. */
    const int apart = s->largest > BALANCED || s->largest * BALANCED < 1.0;
    s->needed = always || (apart && s->largest > 0.0) || differ_by(n, row, BALANCED) ||
                differ_by(n, col, BALANCED);
    for (int i = 0; i < n; i++) {
        r[i] = 1.0;
        c[i] = s->largest == 0.0 ? 1.0 : exp2(-round(log2(s->largest)));
    }
    if (s->needed)
        rb_lcp_equilibrate(M, q, always, r, c, row, col);
    return RB_OK;
}

void rb_lcp_scale_free(lcp_scale *s)
{
    free(s->row);
    *s = (lcp_scale){0};
}

rb_status rb_lcp_pose(const lcp_matrix *M, const double *q, const double *lower,
                      const double *upper, const rb_lcp_options *opt, int always, lcp_posed *s)
{
    *s = (lcp_posed){.M = *M, .q = q, .lower = lower, .upper = upper, .opt = *opt, .caller = *opt};
    /* The scale follows the entries that are not zero, where these are known. */
    const lcp_matrix entries = {
        .n = M->n, .dense = M->sparse ? NULL : M->dense, .ld = M->ld, .sparse = M->sparse};
    const rb_status status = rb_lcp_scale_create(&entries, q, always, &s->scale);
    s->largest = s->scale.largest;
    return status == RB_OK && s->scale.needed ? rb_lcp_pose_scaled(s) : status;
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
