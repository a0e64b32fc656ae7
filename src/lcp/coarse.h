/* A start for Newton's method from a coarser problem.  Private to src/lcp. */
#ifndef LCP_COARSE_H
#define LCP_COARSE_H

#include "rollbem/lcp.h"

/* Orders from which on a coarser problem comes first. */
enum { LCP_COARSE_FROM = 300 };

/* 1: diagonal entries are positive and others hardly ever, as in discretised
 * inequalities: then a start with too many basic z is mended in fewer steps than one with
 * too few. */
int rb_lcp_coarse_fits(const rb_sparse *M);
/* z (n): what the solution of a coarser problem comes to; work grows by its operations.
 * RB_SINGULAR: there is no coarser one, or it was not solved; RB_ENOMEM. */
rb_status rb_lcp_coarse_start(const rb_sparse *M, const double *q, double *z, double *work);

#endif
