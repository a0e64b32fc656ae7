/* All solutions of a small problem, choice by choice.  Private to src/lcp. */
#ifndef LCP_ENUMERATE_H
#define LCP_ENUMERATE_H

#include "lcp/proof/farkas.h"
#include "lcp/lemke/lemke.h"

/* What is tried of a problem whose indices fall into blocks: each choice of a
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

#endif
