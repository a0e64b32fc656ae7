/* Linear programs under an LCP (GLPK).  Private to src/lcp/portfolio. */
#ifndef LCP_LINEAR_H
#define LCP_LINEAR_H

#include "lcp/proof/farkas.h"
#include "lcp/lemke/lemke.h"

/* The inequalities that remain of a problem when of some pairs it is fixed which of z_i and
 * w_i is at its end (lcp_side).  Starts from the last basis, so that similar choices take
 * few steps. */
typedef struct lcp_linear lcp_linear;

/* A posed problem with q and z in a unit, a power of two, in which the largest |q| is near 1. */
typedef struct {
    double unit;
    const double *q, *lower,
        *upper; /* n each, in the memory given; bounds NULL where posed's are */
} lcp_near_one;

/* memory: 3 n */
lcp_near_one rb_lcp_bring_near_one(const lcp_posed *posed, double *memory);

/* Borrows M, q (whose largest entry should be near 1) and the bounds.  RB_ENOMEM. */
rb_status rb_lcp_linear_create(const lcp_matrix *M, const double *q, const double *lower,
                               const double *upper, lcp_linear **linear);
void rb_lcp_linear_free(lcp_linear *linear);

/* Looks for z within its bounds with w = M z + q of the signs that `side` (n) asks for.
 * RB_OK: z (n) has them but for rounding; RB_NO_SOLUTION: there is none, which was checked
 * (rb_lcp_excludes); RB_UNDECIDED. */
rb_status rb_lcp_linear_decide(lcp_linear *linear, const lcp_side *side, double *z);

/* y: n, the multipliers with which the last call has ended, of the rows of the posed problem. */
void rb_lcp_linear_multipliers(const lcp_linear *linear, double *y);

/* The z among them whose distances from their bounds and |w| have the least sum, over the i
 * with one bound.  Statuses as above. */
rb_status rb_lcp_linear_least(lcp_linear *linear, const lcp_side *side, double *z, double *w);

/* enumerate.c: 1: the bounds allow z_i to be there. */
int rb_lcp_is_place(const double *lower, const double *upper, int i, lcp_side at);

/* enumerate.c: what is tried of a problem whose indices fall into blocks: each choice of a
 * block gives a side to each of its indices. */
typedef struct {
    int blocks;
    const int *size, *count;     /* of each block: its indices, which follow each other, and how
                                    many choices there are */
    const lcp_side *const *side; /* of each block: count x size */
    const int *compared;         /* n: 0 where z_i does not tell solutions apart; NULL: all do */
    /* Hears of each choice that has the solution of this number, new or known; NULL. */
    void (*found)(void *context, int solution, const int *choice);
    void *context;
} lcp_choices;

/* As rb_lcp_enumerate, of a problem that has been checked. */
rb_status rb_lcp_try_all(const rb_lcp_problem *p, const double *lower, const double *upper,
                         const lcp_choices *choices, double seconds, rb_lcp_solutions *all,
                         rb_message *why);

/* regular.c: 1: the determinant of these m rows and columns (32 at most) is not zero, because
 * it is not zero modulo one of two primes near 2^61.  0: it is zero modulo both, and would
 * have to have both as factors otherwise. */
int rb_lcp_is_regular(const double *M, int ld, int m, const int *row, const int *column);

/* A problem, the m rows of w = M z + q and columns of z that are solved for, and the z. */
typedef struct {
    const rb_lcp_problem *p;
    const double *lower, *upper; /* n or NULL */
    int m;
    const int *row, *column;
    double *z; /* n; z_j that is not solved for has this value, the others are near it */
} lcp_point;

/* What is exactly so of the solution of w_row = 0. */
enum { LCP_Z_IS_LOWER = 1, LCP_Z_IS_UPPER = 2, LCP_W_IS_ZERO = 4 };

/* regular.c: which of them hold (n), by residues as in rb_lcp_is_regular; none where the order
 * is more than 32 or the system is singular. */
void rb_lcp_zeros(const lcp_point *point, unsigned char *zeros);

/* regular.c: 1: w_row = 0 has no solution, by residues modulo both primes. */
int rb_lcp_has_no_point(const lcp_point *point);

/* exact.c: whether the solution of w_row = 0 solves the problem as the numbers stand, w with the
 * signs of `side`.  RB_OK: it does, which is proved, z is it and zeros (n) are all that it has;
 * RB_NO_SOLUTION: it is proved that it does not; RB_UNDECIDED: some number is too near zero,
 * or the system too near a singular one; RB_ENOMEM. */
rb_status rb_lcp_is_exact(const lcp_point *point, const lcp_side *side, unsigned char *zeros);

#endif
