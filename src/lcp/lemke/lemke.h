/* The state of Lemke's method, shared by the algorithm (lemke.c) and by the guard against
 * rounding (accuracy.c).  Private to src/lcp. */
#ifndef LCP_LEMKE_H
#define LCP_LEMKE_H

#include "lcp/lemke/method.h"
#include "lcp/lemke/tableau.h"

#include <math.h>

/* Parts of the largest entry of a column: entries below DROP are zeros, below NOISE they
 * are no pivots, below DOUBT they are pivots only in a tableau or with an LU that has
 * just been made.  Rows tie that the least ratio brings below TIE of the largest
 * constant, unless their own ratio is more than NEAR away, relative to the step or to
 * max |q| / max |a|. */
static const double DROP = 1e-13, NOISE = 1e-12, DOUBT = 1e-10, TIE = 1e-12, NEAR = 1e-10;

/* A constant that was zero, or at its bound, and comes out of a refinement or of a new LU
 * as less than this part of the largest constant is there still. */
static const double ZERO = 1e-10;

/* The path has ended where z0 is below this part of its first value. */
static const double VANISHED = 1e-13;

typedef struct {
    lcp_work work;
    const lcp_task *task;
    lcp_posed posed; /* the problem that is solved */
    int leaving;     /* what left last; -1: z0 has not entered yet */
    int n;
    lcp_data data; /* of it */
    lcp_tableau t;
    double *a;               /* n: driving column */
    double *other, *scratch; /* n each */
    double *r, *sum;         /* n each: defect and its correction */
    double *weight;          /* n + 1: of the columns */
    int *tied;               /* n: rows that tie; scratch */
    double *image;           /* n x (n + 2): the whole tableau for the trace, or NULL */
    double start, refreshed; /* z0 after the first pivot, at the last refresh */
    int checked, rebuilt;    /* pivots at the last refresh, at the last rebuild */
    int short_path; /* pivots at which the path with ones is left for a generic one; 0: never */
    rb_lcp_info *info;
} lemke;

/* z0, 0 when nonbasic. */
static inline double lemke_z0(const lemke *l)
{
    const int row = l->t.place[2 * l->n];
    return row >= 0 ? l->t.q[row] : 0.0;
}

/* Nothing is known yet. */
#define RB_LCP_INFO_NONE                                                                           \
    ((rb_lcp_info){.res = NAN, .scaled = NAN, .row = -1, .ray_variable = -1, .label = -1})

/* ---- The ends that the methods share (lemke.c, ray.c) ------------------------------ */

/* How a path ends on which nothing blocks the entering variable, with its message.
 * direction: n, of z per unit of the entering variable in the problem that is solved; it
 * is changed.  RB_NUMERICAL: no z moves, so that it is the ray on which the path has
 * begun, and to which no exact path comes back; RB_NO_SOLUTION: the ray proves it;
 * RB_RAY. */
rb_status rb_lcp_fail_ray(rb_lcp_info *info, const lcp_posed *posed, int entering, double z0,
                          double *direction);
/* RB_OK: the path of a problem of order n may go on.  RB_MAXITER, RB_TIME_LIMIT with
 * their messages; start: on rb_seconds(). */
rb_status rb_lcp_check_limits(rb_lcp_info *info, const rb_lcp_options *opt, int n, double start);
/* RB_INACCURATE where info->scaled is not below 1e-10, with a message that names the row. */
rb_status rb_lcp_assess(rb_lcp_info *info);

/* ---- check.c: RB_EINVAL for sizes, max_iters < 0, NaN, infinity -------------------- */

rb_status rb_lcp_check_options(const rb_lcp_options *opt, rb_message *why);
rb_status rb_lcp_check_q(int n, const double *q, rb_message *why);
rb_status rb_lcp_check_dense(const rb_lcp_problem *p, const rb_lcp_options *opt, rb_message *why);
rb_status rb_lcp_check_sparse(const rb_sparse *M, const double *q, const rb_lcp_options *opt,
                              rb_message *why);
/* lower, upper: n, NULL as in rb_lcp_mixed_problem.  RB_EINVAL: crossed bounds. */
rb_status rb_lcp_check_boxes(int n, const double *lower, const double *upper, rb_message *why);

/* All of these but q's cover, which the path itself looks for. */
rb_status rb_lcp_check_mixed(const rb_lcp_mixed_problem *p, const rb_lcp_options *opt,
                             rb_message *why);

static inline double rb_lcp_lower(const double *lower, int i)
{
    return lower ? lower[i] : 0.0;
}

static inline double rb_lcp_upper(const double *upper, int i)
{
    return upper ? upper[i] : INFINITY;
}

/* ---- cover.c ------------------------------------------------------------------------- */

/* cover: n, one that is generic. */
void rb_lcp_generic_cover(int n, double *cover);
/* Pivots on the path with ones before a generic cover is taken, where the least entry of q ties:
 * where that path is short it is often much the shorter one, and else so few cost little.  0: it
 * does not tie, and the path with ones is followed to its end. */
int rb_lcp_pivots_with_ones(int n, const double *q);

/* ---- accuracy.c: what the rounding errors of the pivots have done ------------------ */

/* Refreshes the constants when z0 has fallen far or many pivots have passed: one step of
 * iterative refinement, or a new tableau where it has drifted too far for that.
 * RB_ENOMEM. */
rb_status rb_lcp_lemke_keep_accurate(lemke *l);
/* The tableau from the original matrix.  RB_ENOMEM, RB_SINGULAR (the tableau as before). */
rb_status rb_lcp_lemke_rebuild(lemke *l);
/* 1 when the column of `entering` in l->a satisfies w = M z + d z0. */
int rb_lcp_lemke_column_holds(lemke *l, int entering);
/* z and info->res: the basic point, solved once more from its basis when `solved`. */
void rb_lcp_lemke_answer(lemke *l, int solved, double *z);

#endif
