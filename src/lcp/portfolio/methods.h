/* The methods besides Lemke's, as the portfolio and each other call them.  Private to
 * src/lcp/portfolio. */
#ifndef LCP_METHODS_H
#define LCP_METHODS_H

#include "lcp/lemke/lemke.h"

/* ---- newton.c ------------------------------------------------------------------------ */

/* rb_lcp_newton with bounds.  hopes: RB_MAXITER where the steps make no progress any more. */
rb_status rb_lcp_newton_in_boxes(const rb_lcp_mixed_problem *p, int hopes,
                                 const rb_lcp_options *opt, double *z, rb_lcp_info *info);

/* ---- contraction.c ------------------------------------------------------------------- */

/* Projected Gauss-Seidel where every row is dominated by its positive diagonal by a factor
 * of 0.95 at least: then each sweep brings z nearer to the one solution by this factor.
 * RB_SINGULAR: M is not so, and nothing was done; other statuses as rb_lcp_mixed. */
rb_status rb_lcp_contraction(const rb_lcp_mixed_problem *p, const rb_lcp_options *opt, double began,
                             double *z, rb_lcp_info *info);

/* ---- bimatrix.c ---------------------------------------------------------------------- */

/* rb_lcp_bimatrix without a label, of a game that has been checked; began: on
 * rb_seconds(). */
rb_status rb_lcp_bimatrix_rounds(const rb_lcp_game *g, const rb_lcp_options *opt, double began,
                                 double *z, rb_lcp_info *info);

/* ---- game.c: problems that are bimatrix games ---------------------------------------- */

/* z and info as the other solvers.  RB_SINGULAR: it is no game, and nothing was done;
 * other statuses as rb_lcp_bimatrix. */
rb_status rb_lcp_game_solve(const rb_sparse *M, const double *q, const rb_lcp_options *opt,
                            double *z, rb_lcp_info *info);

/* ---- branch.c ------------------------------------------------------------------------ */

/* A solution of any M, or the proof that there is none, by branching on pairs z_i, w_i over
 * linear programs.  RB_OK: z and info; other statuses leave both but for the number of choices,
 * which info->iters grows by: RB_NO_SOLUTION: there is none; RB_UNDECIDED: none was found, and
 * of some choices it is not known; RB_MAXITER: max_iters choices, or without it 2e6 or 10 s;
 * RB_TIME_LIMIT, RB_INTERRUPTED, RB_ENOMEM. */
rb_status rb_lcp_branch(const rb_lcp_mixed_problem *p, const rb_lcp_options *opt, double began,
                        double *z, rb_lcp_info *info);

/* ---- coarse.c: a start of discretised inequalities from coarser ones ------------------ */

/* 1: diagonal entries are positive and others hardly ever, as in discretised
 * inequalities: then a start with too many basic z is mended in fewer steps than one with
 * too few. */
int rb_lcp_coarse_fits(const rb_sparse *M);
/* z (n): what the solution of a coarser problem comes to; work grows by its operations.
 * RB_SINGULAR: there is no coarser one, or it was not solved; RB_ENOMEM. */
rb_status rb_lcp_coarse_start(const rb_sparse *M, const double *q, double *z, double *work);

#endif
