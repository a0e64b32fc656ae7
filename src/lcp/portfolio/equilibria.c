/* All extreme equilibria of a bimatrix game: pairs of vertices of the two polytopes of best
 * replies whose labels are all labels (Mangasarian, Journal of SIAM 12, 1964; von Stengel,
 * Handbook of Game Theory 3, 2002).  The others are mixtures within maximal sets. */
#include "lcp/portfolio/game.h"
#include "lcp/proof/exact.h"

#include <lapacke.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Labels, and with them bases of a polytope: 22 over 11. */
enum { MOST_LABELS = 22, MOST_BASIC = MOST_LABELS / 2, BETWEEN_LOOKS = 256 };

/* Inequalities are tight within this part of 1; a block of a smaller reciprocal condition is
 * singular, or not decided. */
static const double TIGHT = 1e-9, SINGULAR = 1e-13;

/* Maximal sets beyond this number are not listed. */
enum { MOST_SETS = 1000 };

/* Vertices of {v >= 0, C v <= 1}, C positive, count x own.  Labels: bit own_label + i of v_i =
 * 0, bit other_label + j of (C v)_j = 1; a vertex has all its tight ones, which tell it from
 * the others. */
typedef struct {
    int own, others, own_label, other_label;
    const double *C; /* others x own, column-major; borrowed */
    int count, room;
    uint32_t *labels;     /* room; owned, as v */
    double *v;            /* own x room */
    unsigned char *known; /* a bit per set of labels: it is that of a vertex; of an arena */
} polytope;

/* Adds v, unless it is known already.  RB_ENOMEM. */
static rb_status keep_vertex(polytope *p, uint32_t labels, const double *v)
{
    const unsigned char bit = (unsigned char)(1u << labels % 8);
    if (p->known[labels / 8] & bit)
        return RB_OK;
    if (p->count == p->room) {
        const int room = p->room ? 2 * p->room : 64;
        uint32_t *more_labels = realloc(p->labels, (size_t)room * sizeof *more_labels);
        p->labels = more_labels ? more_labels : p->labels;
        double *more_v =
            more_labels ? realloc(p->v, (size_t)room * (size_t)p->own * sizeof *more_v) : NULL;
        if (!more_v)
            return RB_ENOMEM;
        p->v = more_v;
        p->room = room;
    }
    p->known[labels / 8] |= bit;
    p->labels[p->count] = labels;
    memcpy(p->v + (size_t)p->count++ * (size_t)p->own, v, (size_t)p->own * sizeof *v);
    return RB_OK;
}

/* v of the basis with the v of S positive and the rows T of C v tight, equally many.  1: it is
 * a vertex; 0: it is none; -1: undecided. */
static int basic_point(const polytope *p, uint32_t S, uint32_t T, double *v)
{
    double A[MOST_BASIC * MOST_BASIC], x[MOST_BASIC], work[4 * MOST_BASIC], rcond = 0.0;
    int column[MOST_BASIC], row[MOST_BASIC], swap[MOST_BASIC], other[MOST_BASIC], m = 0, rows = 0;
    for (int i = 0; i < p->own; i++)
        if (S >> i & 1)
            column[m++] = i;
    for (int j = 0; j < p->others; j++)
        if (T >> j & 1)
            row[rows++] = j;
    for (int c = 0; c < m; c++)
        for (int r = 0; r < m; r++)
            A[r + c * m] = p->C[row[r] + column[c] * p->others];
    memset(v, 0, (size_t)p->own * sizeof *v);
    for (int r = 0; r < m; r++)
        x[r] = 1.0;
    const double norm = m ? LAPACKE_dlange(LAPACK_COL_MAJOR, '1', m, m, A, m) : 1.0;
    const int code = m ? LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, m, m, A, m, swap) : 0;
    if (m && code == 0)
        LAPACKE_dgecon_work(LAPACK_COL_MAJOR, '1', m, A, m, norm, &rcond, work, other);
    if (m && rcond < SINGULAR)
        return rb_lcp_is_regular(p->C, p->others, m, row, column) ? -1 : 0;
    /* One correction by the defect in long double: then v is exact to rounding. */
    for (int pass = 0; m && pass < 2; pass++) {
        for (int r = 0; r < m && pass; r++) {
            long double rest = 1.0L;
            for (int c = 0; c < m; c++)
                rest -= (long double)p->C[row[r] + column[c] * p->others] * v[column[c]];
            x[r] = (double)rest;
        }
        LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', m, 1, A, m, swap, x, m);
        for (int c = 0; c < m; c++)
            v[column[c]] += x[c];
    }
    const double least = -TIGHT * rb_norm_inf((size_t)p->own, v);
    for (int c = 0; c < m; c++) {
        if (v[column[c]] < least)
            return 0;
        v[column[c]] = v[column[c]] <= -least ? 0.0 : v[column[c]];
    }
    return 1;
}

/* RB_TIME_LIMIT, RB_INTERRUPTED: not all of them. */
static rb_status find_vertices(polytope *p, double until, rb_lcp_solutions *all)
{
    rb_status s = RB_OK;
    for (uint32_t S = 0; s == RB_OK && S < 1u << p->own; S++)
        for (uint32_t T = 0; s == RB_OK && T < 1u << p->others; T++) {
            double v[MOST_LABELS];
            if (__builtin_popcount(S) != __builtin_popcount(T))
                continue;
            all->bases++;
            const int is = basic_point(p, S, T, v);
            uint32_t labels = 0;
            int feasible = is == 1;
            all->undecided += is < 0;
            for (int i = 0; i < p->own; i++)
                labels |= v[i] == 0.0 ? 1u << (p->own_label + i) : 0;
            for (int j = 0; j < p->others && feasible; j++) {
                double sum = 0.0;
                for (int i = 0; i < p->own; i++)
                    sum += p->C[j + i * p->others] * v[i];
                feasible = sum <= 1.0 + TIGHT;
                labels |= sum >= 1.0 - TIGHT ? 1u << (p->other_label + j) : 0;
            }
            if (feasible && S) /* zero is no strategy */
                s = keep_vertex(p, labels, v);
            if (all->bases % BETWEEN_LOOKS == 0) {
                if (rb_interrupted())
                    s = RB_INTERRUPTED;
                else if (until > 0.0 && rb_seconds() > until)
                    s = RB_TIME_LIMIT;
            }
        }
    return s;
}

/* ---- Maximal sets ---------------------------------------------------------------------- */

/* Of the equilibria (x, y), numbers of vertices: each maximal set X x Y of them is the meeting
 * of the y that belong to some x.  Adds the numbers of its equilibria to all->member. */
static rb_status find_sets(const int *pair, rb_lcp_solutions *all)
{
    const int count = all->count;
    rb_arena scratch = {0};
    int *x = rb_arena_ints(&scratch, (size_t)count), *y = rb_arena_ints(&scratch, (size_t)count);
    int nx = 0, ny = 0; /* different ones */
    int *of_x = rb_arena_ints(&scratch, (size_t)count),
        *of_y = rb_arena_ints(&scratch, (size_t)count);
    for (int k = 0; k < count && !scratch.failed; k++) {
        int a = 0, b = 0;
        while (a < nx && x[a] != pair[2 * k])
            a++;
        while (b < ny && y[b] != pair[2 * k + 1])
            b++;
        x[a] = pair[2 * k];
        y[b] = pair[2 * k + 1];
        nx += a == nx;
        ny += b == ny;
        of_x[k] = a;
        of_y[k] = b;
    }
    const size_t words = ((size_t)ny + 63) / 64;
    uint64_t *near = rb_arena_zeros(&scratch, (size_t)nx * words + 1, sizeof *near);
    uint64_t *set = rb_arena_zeros(&scratch, (size_t)MOST_SETS * words + 1, sizeof *set);
    int sets = 0;
    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    for (int k = 0; k < count; k++)
        near[(size_t)of_x[k] * words + (size_t)(of_y[k] / 64)] |= 1ULL << (of_y[k] % 64);
    for (int a = 0; a < nx && sets < MOST_SETS; a++)
        for (int b = sets; b >= 0 && sets < MOST_SETS; b--) { /* itself, and with those before */
            uint64_t *next = set + (size_t)sets * words, any = 0;
            for (size_t w = 0; w < words; w++) {
                next[w] = near[(size_t)a * words + w];
                next[w] &= b < sets ? set[(size_t)b * words + w] : ~0ULL;
                any |= next[w];
            }
            int known = !any;
            for (int c = 0; c < sets && !known; c++)
                known = memcmp(set + (size_t)c * words, next, words * sizeof *next) == 0;
            sets += !known;
        }
    if (sets == MOST_SETS)
        return rb_arena_done(&scratch, RB_OK);
    int members = 0;
    for (int pass = 0; pass < 2; pass++) {
        members = 0;
        for (int c = 0; c < sets; c++) {
            for (int k = 0; k < count; k++) {
                int in = set[(size_t)c * words + (size_t)(of_y[k] / 64)] >> (of_y[k] % 64) & 1;
                for (size_t w = 0; w < words && in; w++)
                    in = !(set[(size_t)c * words + w] & ~near[(size_t)of_x[k] * words + w]);
                if (in && pass)
                    all->member[members] = k;
                members += in;
            }
            if (pass)
                all->set[c + 1] = members;
        }
        if (pass == 0) {
            all->set = rb_alloc_int((size_t)sets + 1);
            all->member = rb_alloc_int((size_t)members);
            if (!all->set || !all->member)
                return rb_arena_done(&scratch, RB_ENOMEM);
        }
    }
    all->sets = sets;
    return rb_arena_done(&scratch, RB_OK);
}

/* ---- All together ---------------------------------------------------------------------- */

static rb_status find_pairs(const polytope *P, const polytope *Q, rb_lcp_solutions *all)
{
    const uint32_t every = (uint32_t)((1ULL << all->n) - 1);
    int *pair = NULL;
    rb_status s = RB_OK;
    for (int pass = 0; s == RB_OK && pass < 2; pass++) {
        int count = 0;
        for (int a = 0; a < P->count; a++)
            for (int b = 0; b < Q->count; b++)
                if ((P->labels[a] | Q->labels[b]) == every) {
                    if (pass) {
                        pair[2 * count] = a;
                        pair[2 * count + 1] = b;
                    }
                    count++;
                }
        if (pass == 0) {
            pair = rb_alloc_int(2 * (size_t)count);
            all->z = rb_alloc((size_t)count, (size_t)all->n);
            all->singular_basis = rb_alloc_int((size_t)count);
            s = pair && all->z && all->singular_basis ? RB_OK : RB_ENOMEM;
            all->count = s == RB_OK ? count : 0;
        }
    }
    for (int k = 0; s == RB_OK && k < all->count; k++)
        for (int player = 0; player < 2; player++) { /* probabilities add up to 1 */
            const polytope *p = player ? Q : P;
            const double *v = p->v + (size_t)pair[2 * k + player] * (size_t)p->own;
            double *z = all->z + (size_t)k * (size_t)all->n + (player ? P->own : 0);
            const double sum = rb_norm_1((size_t)p->own, v, 1);
            for (int i = 0; i < p->own; i++)
                z[i] = v[i] / sum;
        }
    if (s == RB_OK)
        s = find_sets(pair, all);
    free(pair);
    return s;
}

rb_status rb_lcp_bimatrix_enumerate(const rb_lcp_game *g, double seconds, rb_lcp_solutions *all,
                                    rb_message *why)
{
    *all = (rb_lcp_solutions){0};
    rb_status s = rb_lcp_game_check(g, 0, why);
    if (s != RB_OK)
        return s;
    const int m = g->m, n = g->n;
    if (m > MOST_LABELS - 1 || n > MOST_LABELS - 1 || m + n > MOST_LABELS)
        return rb_fail(why, RB_EINVAL,
                       "lcp: all equilibria of a game of %d by %d: expected at most %d strategies",
                       m, n, MOST_LABELS);
    const double until = seconds > 0.0 ? rb_seconds() + seconds : 0.0;
    rb_arena scratch = {0};
    double *a = rb_arena_doubles(&scratch, (size_t)m, (size_t)n),
           *b = rb_arena_doubles(&scratch, (size_t)m, (size_t)n),
           *transposed = rb_arena_doubles(&scratch, (size_t)m, (size_t)n);
    /* x against B'x <= 1, y against A y <= 1. */
    polytope P = {.own = m, .others = n, .own_label = 0, .other_label = m, .C = transposed};
    polytope Q = {.own = n, .others = m, .own_label = m, .other_label = 0, .C = a};
    all->n = m + n;
    P.known = rb_arena_zeros(&scratch, ((size_t)1 << (m + n)) / 8 + 1, 1);
    Q.known = rb_arena_zeros(&scratch, ((size_t)1 << (m + n)) / 8 + 1, 1);
    s = scratch.failed ? RB_ENOMEM : RB_OK;
    if (s == RB_OK) {
        rb_lcp_game_scale(g, a, b);
        for (int j = 0; j < n; j++)
            for (int i = 0; i < m; i++) {
                a[i + j * m] += 1.0;
                transposed[j + i * n] = 1.0 + b[i + j * m];
            }
        s = find_vertices(&P, until, all);
    }
    if (s == RB_OK)
        s = find_vertices(&Q, until, all);
    const rb_status end = s;
    if (s == RB_OK || s == RB_TIME_LIMIT)
        s = find_pairs(&P, &Q, all);
    free(P.labels);
    free(P.v);
    free(Q.labels);
    free(Q.v);
    rb_arena_free(&scratch);
    if (s == RB_OK && end == RB_OK)
        return RB_OK;
    if (s == RB_OK)
        return rb_fail(why, RB_TIME_LIMIT, "lcp: %d bases of the two polytopes in %g s", all->bases,
                       seconds);
    const int bases = all->bases;
    rb_lcp_solutions_free(all);
    return s == RB_INTERRUPTED
               ? rb_fail(why, s, "lcp: interrupted after %d bases", bases)
               : rb_fail(why, s, "lcp: out of memory for all equilibria of %d by %d", m, n);
}
