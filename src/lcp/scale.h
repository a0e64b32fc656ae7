/* Equilibration, and the residual relative to each row.  Private to src/lcp. */
#ifndef LCP_SCALE_H
#define LCP_SCALE_H

#include "rollbem/lcp.h"

/* M, dense or sparse; borrowed. */
typedef struct {
    int n;
    const double *dense; /* column-major, or NULL */
    int ld;
    const rb_sparse *sparse; /* where dense is NULL */
} lcp_matrix;

/* R M C with the largest entry of each row and column near 1: z = C z', w = R^-1 w'. */
typedef struct {
    double *row, *col; /* n each, powers of two; row owns both */
    double largest;    /* max |M| */
    int needed;        /* 1: rows or columns of M differ so much that M is not solved as
                          it stands */
} lcp_scale;

/* Ruiz' equilibration, which begins from scales that balance [M q]; always: also where M
 * is balanced, because q is not.  RB_ENOMEM. */
rb_status rb_lcp_scale_create(const lcp_matrix *M, const double *q, int always, lcp_scale *s);
void rb_lcp_scale_free(lcp_scale *s);

/* A problem in the scale: R M C, R q, and what the options and boxes hold.  Members that
 * are NULL for the caller are NULL here. */
typedef struct {
    const lcp_scale *scale; /* borrowed */
    double *dense;          /* n x n; owned, as sparse and q, which owns the vectors */
    rb_sparse sparse;
    double *q, *lower, *upper; /* n each */
    rb_lcp_options opt;        /* its cover, start and trace are those of this problem */
    rb_lcp_options caller;     /* as they were given */
    double *value, *tableau;   /* for the caller's trace */
} lcp_scaled;

/* opt: the caller's, borrowed as long as the problem.  RB_ENOMEM; RB_EINVAL: the scaled
 * numbers overflow, solve the problem as it stands. */
rb_status rb_lcp_scaled_create(const lcp_matrix *M, const lcp_scale *scale, const double *q,
                               const double *lower, const double *upper, const rb_lcp_options *opt,
                               lcp_scaled *s);
void rb_lcp_scaled_free(lcp_scaled *s);
/* z of the scaled problem becomes that of the caller's. */
void rb_lcp_scale_back(const lcp_scale *scale, int n, double *z);

/* info->res, info->scaled and info->row of z, as rb_lcp_scaled_residual has them.
 * RB_ENOMEM. */
rb_status rb_lcp_measure(const lcp_matrix *M, const lcp_scale *scale, const double *q,
                         const double *lower, const double *upper, const double *z,
                         rb_lcp_info *info);

#endif
