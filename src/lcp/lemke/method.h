/* Methods that can pause, so that others take turns with them (auto.c).  Private to
 * src/lcp. */
#ifndef LCP_METHOD_H
#define LCP_METHOD_H

#include "lcp/lemke/scale.h"

/* A generic covering vector is one on which ties and the long paths of Murty and Fathi do not
 * depend; but other paths are shortest with ones. */
typedef enum { LCP_ONES, LCP_GENERIC_FOR_TIES, LCP_GENERIC } lcp_cover;

/* What a method is given: checked and borrowed. */
typedef struct {
    lcp_matrix M;
    const double *q, *lower, *upper;
    const rb_lcp_options *opt;
    lcp_cover generic; /* where opt has no covering vector (tableau) */
    int split;         /* 1: free variables as differences of two (mixed) */
    int hopes;         /* 1: ends where single exchanges would be next (newton) */
    double began;      /* on rb_seconds() */
} lcp_task;

/* Operations by formulas, about a nanosecond each, so that the same problem always takes
 * the same path.  The first member of every state. */
typedef struct {
    double used, allowed;
    int paused; /* 1: the method has used what it is allowed, and can go on */
    int ones;   /* 1: the path of a covering vector of ones, where the caller has given none */
} lcp_work;

typedef struct {
    const char *name;
    size_t size; /* of its state */
    /* balance_q: scales that balance q as well. */
    rb_status (*begin)(const lcp_task *task, int balance_q, rb_lcp_info *info, void *state);
    /* Until it ends or pauses: RB_OK, and work.paused says which. */
    rb_status (*go_on)(void *state);
    /* After begin or go_on: z and what is measured of it; s: what they returned.  Frees
     * what the state owns. */
    rb_status (*end)(void *state, rb_status s, double *z);
} lcp_method;

extern const lcp_method rb_lcp_tableau_method, rb_lcp_sparse_method, rb_lcp_newton_method;

/* From its beginning to its end, and once more in other scales where the end does not
 * solve; state: room for the method's. */
rb_status rb_lcp_run(const lcp_method *method, const lcp_task *task, void *state, double *z,
                     rb_lcp_info *info);

/* Of a pivot on a tableau, with what brings columns up to date. */
static inline double rb_lcp_work_of_pivot(int n)
{
    return 300.0 + 8.0 * n + 0.045 * (double)n * n;
}

/* 1 where the method is to pause. */
static inline int rb_lcp_pauses(lcp_work *work)
{
    return work->paused = work->used >= work->allowed;
}

/* In [1/2, 3/2), the same in every run. */
static inline double rb_lcp_random(unsigned long long *seed)
{
    *seed = *seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return 0.5 + (double)(*seed >> 11) / 9007199254740992.0;
}

#endif
