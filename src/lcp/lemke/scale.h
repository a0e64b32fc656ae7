/* Equilibration, and the residual relative to each row.  Private to src/lcp. */
#ifndef LCP_SCALE_H
#define LCP_SCALE_H

#include "lcp/lcp.h"

/* M, dense or sparse; borrowed. */
typedef struct {
    int n;
    const double *dense; /* column-major, or NULL */
    int ld;
    const rb_sparse *sparse; /* where dense is NULL */
} lcp_matrix;

typedef struct {
    int count;
    const int *row; /* NULL: 0, 1, ... */
    const double *x;
} lcp_column;

static inline lcp_column rb_lcp_column(const lcp_matrix *M, int j)
{
    if (M->dense)
        return (lcp_column){M->n, NULL, M->dense + (size_t)j * (size_t)M->ld};
    const rb_sparse *a = M->sparse;
    return (lcp_column){a->p[j + 1] - a->p[j], a->i + a->p[j], a->x + a->p[j]};
}

/* R M C with the largest entry of each row and column near 1: z = C z', w = R^-1 w'. */
typedef struct {
    double *row, *col; /* n each, powers of two; row owns both */
    double largest;    /* max |M| */
    int needed;        /* 1: rows or columns of M differ so much that M is not solved as
                          it stands */
} lcp_scale;

/* Ones where the largest entries of rows and columns are alike, otherwise by equilibration; always:
 * also where M is balanced, because q is not.  RB_ENOMEM. */
rb_status rb_lcp_scale_create(const lcp_matrix *M, const double *q, int always, lcp_scale *s);
void rb_lcp_scale_free(lcp_scale *s);

/* The largest |r_i M_ij c_j| of each row and column, n each; r, c NULL: ones. */
void rb_lcp_largest_entries(const lcp_matrix *M, const double *r, const double *c, double *row,
                            double *col);
void rb_lcp_extremes(int n, const double *x, double *least, double *most);
/* equilibrate.c: r and c (n each); row, col: scratch, n each.  always: q is balanced to rest. */
void rb_lcp_equilibrate(const lcp_matrix *M, const double *q, int always, double *r, double *c,
                        double *row, double *col);

/* The problem that a method solves: the given one, or in the scale R M C, R q and what
 * options and boxes hold, where that is needed.  Members that are NULL for the caller are
 * NULL here. */
typedef struct {
    lcp_scale scale;
    int scaled; /* 1: in the scale */
    lcp_matrix M;
    double largest;                  /* max |M| */
    const double *q, *lower, *upper; /* n each */
    rb_lcp_options opt;              /* its cover, start and trace are those of this problem */
    double *dense;                   /* n x n; owned, as the two below */
    rb_sparse sparse;
    double *vectors;         /* 6 n */
    rb_lcp_options caller;   /* as they were given */
    double *value, *tableau; /* for the caller's trace; tableau is owned */
} lcp_posed;

/* What it is given is borrowed as long as the problem; always: as above.  Of numbers that
 * would overflow in the scale the largest one remains, and a start with such a number is
 * left out; the residual is that of the given problem.  RB_ENOMEM; free in any case. */
rb_status rb_lcp_pose(const lcp_matrix *M, const double *q, const double *lower,
                      const double *upper, const rb_lcp_options *opt, int always, lcp_posed *s);
/* posed.c: where the scale is needed, which is known.  RB_ENOMEM. */
rb_status rb_lcp_pose_scaled(lcp_posed *s);
void rb_lcp_posed_free(lcp_posed *s);
/* z of the problem becomes that of the caller's. */
void rb_lcp_scale_back(const lcp_posed *s, double *z);

/* residual.c: info->res, info->scaled and info->row of z, as rb_lcp_scaled_residual has them.
 * RB_ENOMEM. */
rb_status rb_lcp_measure(const lcp_matrix *M, const lcp_scale *scale, const double *q,
                         const double *lower, const double *upper, const double *z,
                         rb_lcp_info *info);

#endif
