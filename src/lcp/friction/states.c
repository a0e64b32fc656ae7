/* All solutions of a small plane problem: every state of every contact is tried. */
#include "lcp/friction/internal.h"
#include "lcp/portfolio/enumerate.h"
#include "lcp/proof/bounds.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of a contact z = (r_N, s+, u-) with s+ = r_T + mu r_N, w = (u_N, u+, s-) with u_T = u+ - u-
 * and s- = mu r_N - r_T: Coulomb's law is complementarity of z and w.  Of a contact that is
 * open nobody asks which way it slips. */
enum { SIZE = 3, STATES = 4 };

static const lcp_side sides[STATES][SIZE] = {
    [RB_FRICTION_OPEN] = {LCP_AT_LOWER, LCP_LEFT_OUT, LCP_LEFT_OUT},
    [RB_FRICTION_STICK] = {LCP_BETWEEN, LCP_BETWEEN, LCP_AT_LOWER},
    [RB_FRICTION_SLIP_PLUS] = {LCP_BETWEEN, LCP_AT_LOWER, LCP_AT_LOWER},
    [RB_FRICTION_SLIP_MINUS] = {LCP_BETWEEN, LCP_BETWEEN, LCP_BETWEEN}};

/* Without friction there is no stick: r_T = 0 whatever u_T is. */
static const lcp_side smooth_sides[2][SIZE] = {{LCP_AT_LOWER, LCP_LEFT_OUT, LCP_LEFT_OUT},
                                               {LCP_BETWEEN, LCP_LEFT_OUT, LCP_LEFT_OUT}};

typedef struct {
    const rb_friction_problem *p;
    rb_friction_solutions *all;
    rb_status status;
    int room; /* of all->states */
} names;

/* The names of the states of a solution: several where it lies on the border between them. */
static void note_states(void *context, int solution, const int *choice)
{
    names *n = context;
    const int nc = n->p->contacts;
    while (solution >= n->room && n->status == RB_OK) {
        const int room = n->room ? 2 * n->room : 4;
        unsigned *states = realloc(n->all->states, (size_t)(room * nc) * sizeof *states);
        if (!states) {
            n->status = RB_ENOMEM;
            return;
        }
        memset(states + n->room * nc, 0, (size_t)((room - n->room) * nc) * sizeof *states);
        n->all->states = states;
        n->room = room;
    }
    for (int c = 0; c < nc && n->status == RB_OK; c++)
        n->all->states[solution * nc + c] |= 1u << choice[c];
}

void rb_friction_solutions_free(rb_friction_solutions *all)
{
    if (!all)
        return;
    free(all->r);
    free(all->u);
    free(all->states);
    free(all->singular_state);
    free(all->nearby);
    *all = (rb_friction_solutions){0};
}

/* W and q of the local form, dense. */
static rb_status local_matrix(const rb_friction_problem *p, double *W, double *q, rb_message *why)
{
    const size_t m = (size_t)(p->dimension * p->contacts);
    rb_friction_problem condensed = {0};
    rb_status s = RB_OK;
    if (p->form == RB_FRICTION_GLOBAL)
        s = rb_friction_condense(p, &condensed, why);
    const rb_friction_problem *local = p->form == RB_FRICTION_GLOBAL ? &condensed : p;
    if (s == RB_OK) {
        memcpy(q, local->q, m * sizeof *q);
        if (local->form == RB_FRICTION_LOCAL_DENSE)
            memcpy(W, local->W, m * m * sizeof *W);
        for (size_t j = 0; j < m && local->form == RB_FRICTION_LOCAL_SPARSE; j++)
            for (int k = local->Ws.p[j]; k < local->Ws.p[j + 1]; k++)
                W[(size_t)local->Ws.i[k] + j * m] = local->Ws.x[k];
    }
    rb_friction_problem_free(&condensed);
    return s;
}

rb_status rb_friction_all(const rb_friction_problem *p, double seconds, rb_friction_solutions *all,
                          rb_message *why)
{
    *all = (rb_friction_solutions){0};
    rb_status s = rb_friction_problem_check(p, why);
    if (s == RB_OK && p->dimension != 2)
        s = rb_fail(why, RB_EINVAL,
                    "all solutions: dimension %d: their number is finite in two dimensions only",
                    p->dimension);
    if (s == RB_OK && p->contacts > RB_FRICTION_ALL_UP_TO)
        s = rb_fail(why, RB_EINVAL, "all solutions: %d contacts: expected at most %d", p->contacts,
                    RB_FRICTION_ALL_UP_TO);
    if (s != RB_OK)
        return s;
    /* M and q (3 n_c) of the LCP of all contacts, whose blocks have the states as their choices of
     * sides. */
    const int nc = p->contacts, n = SIZE * nc, m = 2 * nc;
    const size_t order = (size_t)n;
    rb_arena scratch = {0};
    double *W = rb_arena_doubles(&scratch, (size_t)m, (size_t)m),
           *own = rb_arena_doubles(&scratch, (size_t)m, 1),
           *M = rb_arena_doubles(&scratch, order, order), *q = rb_arena_doubles(&scratch, order, 1);
    int *size = rb_arena_ints(&scratch, (size_t)nc), *count = rb_arena_ints(&scratch, (size_t)nc),
        *compared = rb_arena_ints(&scratch, order);
    const lcp_side **side = rb_arena_zeros(&scratch, (size_t)nc, sizeof *side);
    rb_lcp_solutions found = {0};
    names states = {.p = p, .all = all, .status = RB_OK};
    s = scratch.failed ? RB_ENOMEM : local_matrix(p, W, own, why);
    if (s == RB_OK) {
        for (int e = 0; e < nc; e++) {
            const double mu = p->mu[e];
            for (int c = 0; c < nc; c++)
                for (int a = 0; a < 2; a++) { /* r_T = s+ - mu r_N */
                    const double *row = W + 2 * c + a;
                    const double wn = row[2 * e * m], wt = row[(2 * e + 1) * m];
                    M[SIZE * c + a + (size_t)(SIZE * e) * order] = wn - mu * wt;
                    M[SIZE * c + a + (size_t)(SIZE * e + 1) * order] = wt;
                }
            M[SIZE * e + 1 + (size_t)(SIZE * e + 2) * order] = 1.0;
            M[SIZE * e + 2 + (size_t)(SIZE * e) * order] = 2.0 * mu;
            M[SIZE * e + 2 + (size_t)(SIZE * e + 1) * order] = -1.0;
            q[SIZE * e] = own[2 * e];
            q[SIZE * e + 1] = own[2 * e + 1];
            size[e] = SIZE;
            count[e] = mu > 0.0 ? STATES : 2;
            side[e] = mu > 0.0 ? &sides[0][0] : &smooth_sides[0][0];
            compared[SIZE * e] = compared[SIZE * e + 1] = 1;
        }
        const lcp_choices choices = {.blocks = nc,
                                     .size = size,
                                     .count = count,
                                     .side = side,
                                     .compared = compared,
                                     .found = note_states,
                                     .context = &states};
        s = rb_lcp_try_all(&(rb_lcp_problem){n, M, n, q}, NULL, NULL, &choices, seconds, &found,
                           why);
    }
    /* What has been found is handed over, also where time ran out. */
    const rb_status end = s;
    if (s >= 0) {
        all->contacts = nc;
        all->count = found.count;
        all->tried = found.bases;
        all->singular = found.singular;
        all->undecided = found.undecided;
        all->singular_state = found.singular_basis;
        all->nearby = found.nearby;
        found.singular_basis = found.nearby = NULL;
        all->r = rb_alloc((size_t)m, (size_t)found.count);
        all->u = rb_alloc((size_t)m, (size_t)found.count);
        s = states.status == RB_OK && all->r && all->u ? RB_OK : RB_ENOMEM;
    }
    for (int k = 0; s == RB_OK && k < found.count; k++) {
        /* From z to reactions, and u = W r + q from them. */
        const double *z = found.z + (size_t)k * order;
        double *r = all->r + (size_t)k * (size_t)m, *u = all->u + (size_t)k * (size_t)m;
        for (int c = 0; c < nc; c++) {
            r[2 * c] = z[SIZE * c];
            r[2 * c + 1] = p->mu[c] > 0.0 ? z[SIZE * c + 1] - p->mu[c] * z[SIZE * c] : 0.0;
        }
        for (int i = 0; i < m; i++) {
            u[i] = own[i];
            for (int j = 0; j < m; j++)
                u[i] += W[i + j * m] * r[j];
        }
    }
    rb_lcp_solutions_free(&found);
    rb_arena_free(&scratch);
    if (s == RB_OK)
        return end;
    rb_friction_solutions_free(all);
    return s == RB_ENOMEM ? rb_fail(why, s, "out of memory for all solutions of %d contacts", nc)
                          : s;
}

/* r of u = 0 in the contacts of a set of bits, and r = 0 in the others; by residuals in twice the
 * precision.  0: the block is singular. */
static int stick(int d, int contacts, const double *W, const double *q, unsigned set,
                 rb_arena *memory, double *r)
{
    enum { TURNS = 10 };
    const size_t m = (size_t)(d * contacts);
    /* The rows and columns of W of the contacts that stick. */
    double *A = rb_arena_doubles(memory, m, m), *x = rb_arena_doubles(memory, m, 1);
    int *row = rb_arena_ints(memory, m), *pivot = rb_arena_ints(memory, m), n = 0;
    for (int i = 0; !memory->failed && i < d * contacts; i++) {
        r[i] = 0.0;
        if (set >> (i / d) & 1)
            row[n++] = i;
    }
    for (int c = 0; c < n; c++)
        for (int i = 0; i < n; i++)
            A[i + c * n] = W[(size_t)row[i] + (size_t)row[c] * m];
    if (memory->failed || LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, A, n, pivot) != 0)
        return 0;
    for (int turn = 0; turn < TURNS; turn++) {
        for (int i = 0; i < n; i++) {
            proof_dot sum = {q[row[i]], 0.0, fabs(q[row[i]])};
            double error;
            for (int c = 0; c < n; c++)
                proof_add(&sum, W[(size_t)row[i] + (size_t)row[c] * m], r[row[c]]);
            x[i] = -proof_value(&sum, (size_t)n + 1, &error);
        }
        LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', n, 1, A, n, pivot, x, n);
        for (int i = 0; i < n; i++)
            r[row[i]] += x[i];
    }
    return 1;
}

rb_status rb_friction_try_sticking(const rb_friction_problem *p,
                                   int (*accepts)(void *context, const double *r), void *context)
{
    const size_t m = (size_t)(p->dimension * p->contacts);
    rb_arena memory = {0};
    double *W = rb_arena_doubles(&memory, m, m), *q = rb_arena_doubles(&memory, m, 2), *r = q + m;
    rb_status s = memory.failed                         ? RB_ENOMEM
                  : p->contacts > RB_FRICTION_ALL_UP_TO ? RB_EINVAL
                                                        : local_matrix(p, W, q, NULL);
    int found = 0;
    /* Each set of sticking contacts: 2^n_c - 1 of them. */
    for (unsigned set = 1; s == RB_OK && !found && set < 1u << p->contacts; set++) {
        rb_arena own = {0};
        found = stick(p->dimension, p->contacts, W, q, set, &own, r) && accepts(context, r);
        s = own.failed ? RB_ENOMEM : s;
        rb_arena_free(&own);
    }
    return rb_arena_done(&memory, s != RB_OK || found ? s : RB_NO_SOLUTION);
}

int rb_friction_may_have_several(const rb_friction_problem *p)
{
    const int m = p->dimension * p->contacts;
    for (int c = 0; p->form != RB_FRICTION_GLOBAL && c < p->contacts; c++) {
        const int first = c * p->dimension;
        double own[3] = {0.0};
        for (int a = 0; a < p->dimension; a++) { /* W_NN, W_NT of the contact */
            const int column = first + a;
            if (p->form == RB_FRICTION_LOCAL_DENSE)
                own[a] = p->W[(size_t)first + (size_t)column * (size_t)m];
            else
                for (int k = p->Ws.p[column]; k < p->Ws.p[column + 1]; k++)
                    own[a] = p->Ws.i[k] == first ? p->Ws.x[k] : own[a];
        }
        if (own[0] - p->mu[c] * rb_friction_tangential(p->dimension, own) < 0.0)
            return c + 1;
    }
    return 0;
}
