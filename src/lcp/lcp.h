/* What the rooms use of LCPs besides rollbem/lcp.h. */
#ifndef ROLLBEM_SRC_LCP_LCP_H
#define ROLLBEM_SRC_LCP_LCP_H

#include "base/base.h"
#include "base/sparse.h"
#include "rollbem/lcp.h"

/* The solvers that rb_lcp_solve accepts, auto first. */
typedef struct {
    const char *name, *summary;
} rb_lcp_solver;
const rb_lcp_solver *rb_lcp_solvers(int *count);

/* Lemke's method with a sparse LU factorisation, for the mixed problem.  Ties are broken
 * by a generic perturbation, with RB_LCP_FIRST_INDEX by the row number; trace_tableau has
 * no effect.  Variables without bounds are basic from the beginning.  If their matrix is
 * singular, or the path does not lead to a solution, a second path begins in which each
 * of them is a difference of two; the second one of the k-th split variable has number n
 * + k in the trace, whose n is then larger.  With
 * opt->start the path begins at the basis of that point; if it does not lead to a
 * solution, a second path begins at the bounds. Statuses as rb_lcp_lemke, and
 * RB_SINGULAR: a basis is singular up to rounding; RB_EINVAL: crossed bounds, too. */
rb_status rb_lcp_mixed(const rb_lcp_mixed_problem *p, const rb_lcp_options *opt, double *z,
                       rb_lcp_info *info);

/* A bimatrix game.  The row player chooses among m strategies with probabilities x and
 * receives x'A y; the column player chooses among n strategies with probabilities y and
 * receives x'B y. */
typedef struct {
    int m, n;
    const double *A, *B; /* m x n, column-major */
    int ld;              /* >= m, of both */
} rb_lcp_game;

/* An equilibrium of a game by the method of Lemke and Howson with a lexicographic rule.
 * label, 0 ... m + n - 1: the strategy dropped first (rows, then columns); other labels
 * may lead to other equilibria.  -1: the paths of up to 16 labels in rounds, with limits
 * that double from round to round, until one has ended (info->label); paths can be longer
 * than 1.6^m.  It uses the options max_iters (0: as many as take about half a minute),
 * seconds and trace; in the trace z_k is the probability and w_k the regret of strategy
 * k.  z = (x, y): m + n, written.  RB_OK, RB_MAXITER, RB_TIME_LIMIT, RB_INACCURATE,
 * RB_NUMERICAL: rounding errors have ended the path (every game has an equilibrium);
 * RB_EINVAL, RB_ENOMEM. */
rb_status rb_lcp_bimatrix(const rb_lcp_game *game, int label, const rb_lcp_options *opt, double *z,
                          rb_lcp_info *info);

/* All extreme equilibria: pairs of vertices of the two polytopes of best replies; z = (x, y).
 * All others are mixtures: in a maximal set, whose equilibria are all pairs of some x and
 * some y, any mixture of these x with any mixture of these y is one.  `bases` counts bases
 * of the polytopes, sets is 0 where there are more than 1000.  m + n is at most 22.
 * seconds and statuses as rb_lcp_enumerate. */
rb_status rb_lcp_bimatrix_enumerate(const rb_lcp_game *game, double seconds, rb_lcp_solutions *all,
                                    rb_message *why);

/* regret: m + n values >= 0, what each strategy pays less than the best reply to the
 * other player's mixed strategy; payoff: the payoffs of the best replies.  Returns max
 * min(probability, regret). */
double rb_lcp_bimatrix_regret(const rb_lcp_game *game, const double *z, double *regret,
                              double payoff[2]);

/* The relative residual row by row: max_i |min(z_i, w_i)| / (|M| |z| + |q|)_i, of the
 * equilibrated matrix R M C.  A row that may contain only rounding errors of larger rows
 * with the same unknowns is divided by 1e-4 of their scale instead.  The residual does
 * not depend on the units of rows and columns.  row: the row of the maximum, or -1; may
 * be NULL.  RB_ENOMEM. */
rb_status rb_lcp_scaled_residual(const rb_lcp_mixed_problem *p, const double *z, double *scaled,
                                 int *row);
/* The residual that rounding errors of the data can cause: 1e-14 max_i (|M| |z| + |q|)_i;
 * work: n. */
double rb_lcp_rounding_floor(const rb_lcp_mixed_problem *p, const double *z, double *work);

/* A game as a problem with the unknowns (x, y, u, v), u and v free, the payoffs: M, and q,
 * lower of m + n + 2; no upper bounds.  RB_ENOMEM. */
rb_status rb_lcp_of_game(const rb_lcp_game *game, rb_sparse *M, double *q, double *lower);
/* As rb_lcp_prove, of that problem; z = (x, y). */
rb_status rb_lcp_prove_game(const rb_lcp_game *game, const double *z, rb_lcp_proof *proof);

/* How many solutions are proved to exist, and how many at most. */
typedef struct {
    int least, most;     /* most -1: not bounded */
    int open;            /* complementary bases that leave the number open */
    int proved;          /* of the z given, each by itself */
    int proofs;          /* as many as there are z; owned */
    rb_lcp_proof *proof; /* of each z given */
} rb_lcp_number;
/* z: n x count, the solutions that are known, as rb_lcp_enumerate has them.  most: n, |z_i| <=
 * most_i is known of each solution; NULL: nothing is.  seconds: time limit, 0: none.  RB_OK;
 * RB_TIME_LIMIT: bases are left open; RB_EINVAL: more than 2^22 bases, NaN or infinity;
 * RB_INTERRUPTED, RB_ENOMEM. */
rb_status rb_lcp_prove_number(const rb_lcp_mixed_problem *p, const double *most, int count,
                              const double *z, double seconds, rb_lcp_number *number);
/* The same of a game, z: (m + n) x count. */
rb_status rb_lcp_prove_game_number(const rb_lcp_game *game, int count, const double *z,
                                   double seconds, rb_lcp_number *number);
void rb_lcp_number_free(rb_lcp_number *number);

/* proof->least_sum by Farkas' lemma, of a problem that is not proved to have a solution; of more
 * than 400 unknowns, for which a linear program takes long, it stays 0.  RB_ENOMEM, RB_EINVAL: NaN
 * or infinity. */
rb_status rb_lcp_prove_absence(const rb_lcp_mixed_problem *p, rb_lcp_proof *proof);
/* rb_lcp_prove, and rb_lcp_prove_absence of what it leaves open.  RB_UNDECIDED: no solution is
 * proved to exist; proof->least_sum. */
rb_status rb_lcp_prove_or_exclude(const rb_lcp_mixed_problem *p, const double *z,
                                  rb_lcp_proof *proof);
/* The same of the answer of a solver, which ended with *ended and z, so that both say the same:
 * where the solver found no solution and the proof, which exchanges wrong signs, has found one from
 * its last iterate, z becomes that one and *ended RB_OK; where a solution is excluded *ended
 * becomes RB_NO_SOLUTION, and why says so.  A z that solves the problem to the solver's tolerance
 * stays RB_OK in any case. */
rb_status rb_lcp_prove_answer(const rb_lcp_mixed_problem *p, double *z, rb_status *ended,
                              rb_lcp_proof *proof, rb_message *why);

/* definite: 1: x'D A x > 0 is proved for all x other than zero, D = diag(d), for A (n x n,
 * column-major) and all matrices whose entries differ from it by at most 8 units of rounding, and
 * those of D A by radius besides (n x n; NULL: zeros); 0: it is not.  RB_ENOMEM. */
rb_status rb_lcp_prove_definite(int n, const double *A, int ld, const double *d,
                                const double *radius, int *definite);

#endif
