/* Complementarity problems that are bimatrix games.  Private to src/lcp. */
#ifndef LCP_GAME_H
#define LCP_GAME_H

#include "rollbem/lcp.h"

/* z and info as the other solvers.  RB_SINGULAR: it is no game, and nothing was done;
 * other statuses as rb_lcp_bimatrix. */
rb_status rb_lcp_game_solve(const rb_sparse *M, const double *q, const rb_lcp_options *opt,
                            double *z, rb_lcp_info *info);

#endif
