/* The sizes at which the program changes its method: one table for all rooms.  Numbers alone: what
 * they count is said by those who use them.  A size is that from which on both ways were measured
 * to cost the same, or up to which the slower but surer one takes seconds; each names the bench
 * or the test that repeats the measurement.  Limits of what a user may ask for are not
 * here. */
#ifndef ROLLBEM_SRC_BASE_SIZES_H
#define ROLLBEM_SRC_BASE_SIZES_H

/* ---- src/bem ----------------------------------------------------------------------- */

enum {
    /* Boundary elements from which on no matrix is built: 14 times faster at 4000, and F is the
     * same to 3e-8.  bench_hierarchical. */
    RB_BEM_HIERARCHICAL = 1500,
    /* Order from which on an LU is worth more than one thread.  bench_sizes threads. */
    RB_BEM_LU_THREADS_FROM = 1500,
    /* Length of a transform below which it is over before a second thread has begun.  bench_sizes
     * threads. */
    RB_FOURIER_THREADS_FROM = 1 << 17
};

/* ---- src/lcp/lemke, portfolio: orders of an LCP.  bench_lemke families ------------------ */

enum {
    /* The largest tableau of a portfolio, which takes 8 n^2 bytes twice. */
    RB_LCP_TABLEAU_UP_TO = 5000,
    /* A pivot by sparse factors is cheaper than one on a tableau (market, order 1000). */
    RB_LCP_SPARSE_PIVOTS_FROM = 300,
    /* --solver lemke takes sparse factors where few entries are not zero. */
    RB_LCP_LEMKE_SPARSE_FROM = 500,
    /* Newton's method goes first on discretised inequalities, which it solves always, and on other
     * sparse matrices with a positive diagonal (kostreva 27: 16 us, Lemke's 24; 21: 13 and 16). */
    RB_LCP_NEWTON_SURE_FROM = 200,
    RB_LCP_NEWTON_HOPE_FROM = 24,
    /* It is looked whether rows are dominated by their diagonal. */
    RB_LCP_DOMINATED_FROM = 200,
    /* A coarser problem comes before Newton's method (obstacle, bearing, option). */
    RB_LCP_COARSE_FROM = 300,
    /* Conjugate gradients instead of an LU whose factors would be full. */
    RB_LCP_GRADIENTS_FROM = 5000,
    /* A search by branching ends in seconds.  test_lcp_branch with ROLLBEM_TEST_ALL. */
    RB_LCP_BRANCH_UP_TO = 200
};

/* ---- src/lcp/contact: elements ------------------------------------------------------ */

enum {
    /* `auto` gives a contact to Lemke's method: 2.3 times Newton's at 100, 5.9 at 200, but it does
     * not fail.  bench_rolling. */
    RB_CONTACT_LEMKE_UP_TO = 120,
    /* Unknowns that GMRES finds sooner than an LU.  bench_sizes changes, PRODUCTS_BESIDE. */
    RB_CONTACT_PRODUCTS_FROM = 200,
    /* A proof forms the matrices of an operator without any, and tries the energy test, which takes
     * up to 77 factors of twice as many rows.  bench_sizes limits: 6 s and .5 s. */
    RB_CONTACT_PROOF_FORMS_UP_TO = 1500,
    RB_CONTACT_PROOF_COUPLED_UP_TO = 300
};

/* ---- src/lcp/friction: contacts ----------------------------------------------------- */

enum {
    /* All states of all contacts are tried, 4^8 of them.  test_friction_all. */
    RB_FRICTION_ALL_UP_TO = 8,
    /* Beyond it a dense tableau of Lemke's method takes longer than the members of `auto` that come
     * after it: bench_sizes friction, 7 times `auto` at 940 contacts of a wall. */
    RB_FRICTION_LEMKE_UP_TO = 1000
};

/* ---- src/rolling: elements of the contact --------------------------------------------- */

enum {
    /* Solved by Fourier transforms, without a matrix: steady rolling with every friction law, on
     * equal elements (3 to 6 times faster there already) and on aligned ones (4 to 15 times faster
     * from 48 to 150); fitted elements with those outside the contact; static contact, steps and
     * wear (as fast at 300, twice as fast at 600, 2 to 5 times at 1200).  bench_sizes changes,
     * bench_large, bench_abilities. */
    RB_ROLLING_TRANSFORMS = 150,
    RB_ROLLING_TRANSFORMS_ALIGNED = 48,
    RB_ROLLING_TRANSFORMS_FITTED = 240,
    RB_ROLLING_TRANSFORMS_STEPS = 400,
    /* A matrix beside which products solve the systems of many unknowns; fewer are solved sooner by
     * an LU.  bench_sizes changes: equal there. */
    RB_ROLLING_PRODUCTS_BESIDE_FROM = 250,
    /* Below it a matrix can be added where something needs one (rb_rolling_model_add_matrix); from
     * there on it would take seconds.  bench_large: .43 s at 2000. */
    RB_ROLLING_LARGE = 1500,
    /* Where mu beta >= 1: Lemke's method on a matrix solves in seconds, and what a refusal says of
     * it.  bench_sizes limits: .2 s. */
    RB_ROLLING_STRONG_BY_MATRIX_UP_TO = 300,
    RB_ROLLING_STRONG_ADVISED_UP_TO = 200,
    /* Elements that are graded to the edges: on any support below the first; where equal elements
     * are of first order (coupling, layers, bodies that relax) up to the second, with products up
     * to the third, where mu beta >= 1 up to the fourth.  bench_defaults. */
    RB_ROLLING_EQUAL_FROM = 1500,
    RB_ROLLING_GRADED_UP_TO = 400,
    RB_ROLLING_GRADED_BY_PRODUCTS_UP_TO = 100000,
    RB_ROLLING_GRADED_STRONG_UP_TO = 240,
    /* Taken for tables by themselves: by transforms in one step, and with a matrix or in many
     * steps.  bench_sizes limits: .3 s and 4 s for a solution. */
    RB_ROLLING_FOLLOWING_UP_TO = 20000,
    RB_ROLLING_FOLLOWING_DEARLY_UP_TO = 1000,
    /* The line of so many elements is first searched for with few; equal elements with a matrix, to
     * resolve patches far apart.  bench_sizes changes (.9 of the time) and limits. */
    RB_ROLLING_SEARCH_WITH_FEW_FROM = 1500,
    RB_ROLLING_PATCHES_UP_TO = 3000,
    /* Elements outside the contact that are many for finding it.  bench_sizes changes: five times
     * faster there on fitted elements, as fast on equal ones. */
    RB_ROLLING_FINE_BOUNDARY_FROM = 601,
    /* Of a mesh that starts cold; of the first level of aligned ones at most; fitted at once, and
     * of the first of more.  bench_large, bench_defaults. */
    RB_ROLLING_COARSEST = 40,
    RB_ROLLING_COARSEST_ALIGNED = 400,
    RB_ROLLING_FITTED_AT_ONCE = 400,
    RB_ROLLING_COARSEST_FITTED = 200
};

#endif
