/* Bimatrix games.  Private to src/lcp/portfolio. */
#ifndef LCP_GAME_H
#define LCP_GAME_H

#include "lcp/lemke/lemke.h"

/* RB_EINVAL: sizes, a label beyond m + n - 1, NaN or infinity. */
rb_status rb_lcp_game_check(const rb_lcp_game *g, int label, rb_message *why);
/* Payoffs in [0, 1], m x n column-major: less the least of a player's, over a power of two
 * (1 where all are equal), so that integers stay exact, and what ties in them; adding to
 * payoffs and multiplying them changes no equilibrium.  Returns the larger power. */
double rb_lcp_game_scale(const rb_lcp_game *g, double *a, double *b);

#endif
