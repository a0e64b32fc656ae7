/* Proof of a solution: a sign pattern and a linear system, both in floating-point arithmetic with
 * bounds (docs/proof.md).  What is computed only guides the proof; each inequality that counts
 * fails for a NaN. */
#include "lcp/proof/farkas.h"
#include "lcp/lemke/lemke.h"
#include "lcp/proof/bounds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Repairs of the basis; pairs that may be undecided at a time; unknowns whose matrix is inverted.
 */
enum { ROUNDS = 8, MOST_UNDECIDED = 40, MOST_CORE = 4000 };
/* Where the first guess of the basis begins: parts of the terms of a row. */
static const double GUESS_ROW = 1e-7, GUESS_UNKNOWN = 1e-14;

typedef struct {
    int n;
    rb_sparse M, rows; /* without zeros, and its transpose; owned */
    const double *q, *lower, *upper;
    lcp_side *at;              /* n: what the basis says of each pair */
    int *open;                 /* n: 1: the pair is undecided, z_i = t_i >= 0 */
    double *value;             /* n: z_i that are not basic */
    double *base, *base_error; /* n: M value + q */
    /* of an attempt */
    int *reads;                     /* n: 1: z_i may be other than zero */
    int *taken, *partner;           /* n: of slack and free pairs: what, and the other index */
    int *column, *row, *core, *key; /* n: place among C, E, the core columns; else -1 */
    int *C, *E, m;                  /* m columns and rows */
    int *single;                    /* n: for row place: the column place that it solves, or -1 */
    int *zero;                      /* n: 1: w_i = 0 exactly, whatever the reading z are */
    int *strict;                    /* n: 1: the sign of w_i is proved */
    int *beta, betas;               /* the undecided pairs */
    double *X, *EX, *Y, *EY, *t;    /* m or n x (1 + MOST_UNDECIDED): of base and undecided z */
    double *work;                   /* 4 n */
} prover;

enum { NOTHING, SLACK_Z, SLACK_W, FREE_TWIN, FREE_BASIC };

/* ---- Exact zeros ----------------------------------------------------------------------- */

static int is_plain(const prover *p, int i)
{
    return rb_lcp_lower(p->lower, i) == 0.0 && isinf(rb_lcp_upper(p->upper, i));
}

/* 1: row i has no entry in a column of the set. */
static int reads_nothing(const prover *p, int i, const int *set)
{
    for (int k = p->rows.p[i]; k < p->rows.p[i + 1]; k++)
        if (set[p->rows.i[k]])
            return 0;
    return 1;
}

/* 1: rows i and j are opposite on the columns of the set, but for columns i and j where
 * `but_own`. */
static int are_opposite(const prover *p, int i, int j, const int *set, int but_own)
{
    const rb_sparse *R = &p->rows;
    int a = R->p[i], b = R->p[j];
    while (a < R->p[i + 1] || b < R->p[j + 1]) {
        const int ca = a < R->p[i + 1] ? R->i[a] : p->n, cb = b < R->p[j + 1] ? R->i[b] : p->n;
        const int c = ca < cb ? ca : cb;
        const double x = (ca == c ? R->x[a] : 0.0) + (cb == c ? R->x[b] : 0.0);
        /* x is zero only where the two are opposite: no sum of others rounds to zero */
        if (set[c] && !(but_own && (c == i || c == j)) && x != 0.0)
            return 0;
        a += ca == c;
        b += cb == c;
    }
    return 1;
}

/* By the moduli, so that opposite columns have the same hash; of long columns some entries. */
static uint64_t hash_of_column(const rb_sparse *M, int j)
{
    const int first = M->p[j], count = M->p[j + 1] - first;
    uint64_t hash = rb_hash(RB_HASH_START, &count, sizeof count);
    for (int k = 0; k < count; k += k < 4 || count < 9 ? 1 : count / 5) {
        const double x = fabs(M->x[first + k]);
        hash = rb_hash(hash, &M->i[first + k], sizeof *M->i);
        hash = rb_hash(hash, &x, sizeof x);
    }
    return hash;
}

/* 1: M_.i = sign M_.j; sign 0: their moduli are the same. */
static int are_columns_like(const rb_sparse *M, int i, int j, double sign)
{
    const int count = M->p[i + 1] - M->p[i];
    if (count != M->p[j + 1] - M->p[j])
        return 0;
    for (int k = 0; k < count; k++) {
        const double a = M->x[M->p[i] + k], b = M->x[M->p[j] + k];
        if (M->i[M->p[i] + k] != M->i[M->p[j] + k] ||
            (sign != 0.0 ? a != sign * b : fabs(a) != fabs(b)))
            return 0;
    }
    return 1;
}

static double entry(const rb_sparse *M, int i, int j)
{
    for (int k = M->p[j]; k < M->p[j + 1]; k++)
        if (M->i[k] == i)
            return M->x[k];
    return 0.0;
}

typedef struct {
    uint64_t hash;
    int j;
} keyed;

static int by_hash(const void *a, const void *b)
{
    const keyed *x = a, *y = b;
    return x->hash != y->hash ? (x->hash < y->hash ? -1 : 1) : x->j - y->j;
}

/* Slack pairs (i, j): z_i = 0, column j has the one entry M_ij > 0, and row j reads nothing of C,
 * q_j = 0: then w_j = 0 and z_j = max(0, -x_i/M_ij) fit any x_i.  Free pairs (j, i) have opposite
 * columns and rows: z_j - z_i has any sign.  RB_ENOMEM. */
static rb_status find_structure(prover *p)
{
    const int n = p->n;
    const rb_sparse *M = &p->M;
    keyed *list = malloc((size_t)n * sizeof *list);
    int count = 0;
    if (!list)
        return RB_ENOMEM;
    for (int i = 0; i < n; i++) {
        p->taken[i] = NOTHING;
        p->reads[i] = p->at[i] == LCP_BETWEEN || p->open[i] || p->value[i] != 0.0;
    }
    for (int j = 0; j < n; j++) {
        if (M->p[j + 1] - M->p[j] != 1) {
            if (M->p[j + 1] > M->p[j] && is_plain(p, j))
                list[count++] = (keyed){hash_of_column(M, j), j};
            continue;
        }
        /* Slack pairs: column j has this one entry. */
        const int i = M->i[M->p[j]];
        if (i == j || !(M->x[M->p[j]] > 0.0) || p->q[j] != 0.0 || p->reads[i] || p->taken[i] ||
            p->taken[j] || !is_plain(p, i) || !is_plain(p, j) || !reads_nothing(p, j, p->reads))
            continue;
        p->taken[i] = SLACK_Z;
        p->taken[j] = SLACK_W;
        p->partner[i] = j;
        p->partner[j] = i;
    }
    for (int i = 0; i < n; i++)
        p->reads[i] &= !p->taken[i];
    qsort(list, (size_t)count, sizeof *list, by_hash);
    for (int k = 0; k + 1 < count; k++) {
        int twin = -1, like = 0;
        for (int l = k > 0 && list[k - 1].hash == list[k].hash ? count : k + 1;
             l < count && list[l].hash == list[k].hash; l++)
            if (are_columns_like(M, list[k].j, list[l].j, 0.0) && like++ == 0)
                twin = list[l].j;
        if (like != 1)
            continue;
        const int a = list[k].j, j = p->reads[a] || !p->reads[twin] ? a : twin,
                  i = j == a ? twin : a;
        if (p->taken[i] || p->taken[j] || p->q[i] != -p->q[j] || !are_columns_like(M, i, j, -1.0) ||
            entry(M, i, j) != -entry(M, j, j) || !are_opposite(p, i, j, p->reads, 1))
            continue;
        p->taken[i] = FREE_TWIN;
        p->taken[j] = FREE_BASIC;
        p->partner[i] = j;
        p->partner[j] = i;
    }
    free(list);
    return RB_OK;
}

/* ---- The basis ------------------------------------------------------------------------- */

/* C, E and the columns that are solved last; NULL, or why the structure gives no proof. */
static const char *choose_basis(prover *p)
{
    const int n = p->n;
    p->m = p->betas = 0;
    /* What a slack pair takes is no part of the basis. */
    for (int i = 0; i < n; i++) {
        const int basic = p->taken[i] == FREE_BASIC || (!p->taken[i] && p->at[i] == LCP_BETWEEN);
        p->column[i] = p->row[i] = p->core[i] = p->single[i] = -1;
        p->strict[i] = 0;
        if (basic) {
            p->column[i] = p->m;
            p->C[p->m++] = i;
        } else if (p->open[i] && !p->taken[i]) {
            if (p->betas == MOST_UNDECIDED)
                return "more than 40 undecided pairs";
            p->beta[p->betas++] = i;
        }
        p->reads[i] = basic || (p->open[i] && !p->taken[i]) || p->value[i] != 0.0;
    }
    /* Adding the columns of free pairs may have broken what another pair needs. */
    for (int i = 0; i < n; i++) {
        p->zero[i] = p->q[i] == 0.0 && reads_nothing(p, i, p->reads);
        if (p->taken[i] == SLACK_W && !p->zero[i])
            return "dependent pairs";
        if (p->taken[i] == FREE_TWIN && !are_opposite(p, i, p->partner[i], p->reads, 0))
            return "dependent pairs";
    }
    /* Rows of the basis: those of its columns, unless the row is exactly zero anyway. */
    int m = 0;
    for (int c = 0; c < p->m; c++)
        if (!p->zero[p->C[c]]) {
            p->row[p->C[c]] = m;
            p->E[m++] = p->C[c];
        }
    /* A column whose own row is exactly zero takes another row that holds with equality. */
    for (int c = 0; c < p->m; c++) {
        const int j = p->C[c];
        for (int k = p->M.p[j]; p->zero[j] && p->row[j] < 0 && k < p->M.p[j + 1]; k++) {
            const int i = p->M.i[k];
            if (p->row[i] < 0 && p->column[i] < 0 && !p->taken[i] && !p->open[i] && !p->zero[i]) {
                p->row[i] = m;
                p->E[m++] = i;
                break;
            }
        }
    }
    for (int i = 0; i < n; i++)
        p->zero[i] |= p->taken[i] == FREE_TWIN;
    if (m != p->m)
        return "a structurally singular basis";
    /* columns with one entry in the rows E */
    for (int c = 0; c < m; c++) {
        const int j = p->C[c];
        int at = -1, count = 0;
        for (int k = p->M.p[j]; k < p->M.p[j + 1]; k++)
            if (p->row[p->M.i[k]] >= 0 && count++ == 0)
                at = p->row[p->M.i[k]];
        if (count == 0 || (count == 1 && p->single[at] >= 0))
            return "a structurally singular basis";
        if (count == 1)
            p->single[at] = c;
        else
            p->core[c] = 1;
    }
    return NULL;
}

/* Row i of M x + b over the columns of C, in column `rhs`; b has the error `own`. */
static double row_sum(const prover *p, int i, int rhs, double b, double own, int core_only,
                      int fine, double *error)
{
    const size_t m = (size_t)p->m, k = m + 1;
    const double *x = p->X + (size_t)rhs * m, *ex = p->EX + (size_t)rhs * m;
    double value = b, size = fabs(b), through = 0.0, rounding;
    proof_dot exact = {b, 0.0, fabs(b)};
    for (int e = p->rows.p[i]; e < p->rows.p[i + 1]; e++) {
        const int c = p->column[p->rows.i[e]];
        const double a = p->rows.x[e];
        if (c < 0 || (core_only && p->core[c] < 0))
            continue;
        through += fabs(a) * ex[c];
        if (fine)
            proof_add(&exact, a, x[c]);
        else {
            value += a * x[c];
            size += fabs(a) * fabs(x[c]);
        }
    }
    if (fine)
        value = proof_value(&exact, k, &rounding);
    else
        rounding = proof_error(k, size);
    *error = proof_up(4, rounding + proof_up(k, through) + own);
    return value;
}

/* Steps 2 and 3: z_C = X_0 + X_beta t with the bounds EX.  NULL, or why not; *memory: RB_ENOMEM. */
static const char *solve_basis(prover *p, int fine, double *norm, rb_status *memory)
{
    const int m = p->m;
    int k = 0, rows = 0;
    for (int c = 0; c < m; c++)
        p->core[c] = p->core[c] > 0 ? k++ : -1;
    if (k > MOST_CORE)
        return "too many unknowns for a dense matrix";
    /* The core: rows and columns without a single entry of their own, solved by an inverse with
     * bounds; the rest follows by substitution. */
    int *of_row = p->key;
    for (int r = 0; r < m; r++)
        of_row[r] = p->single[r] < 0 ? rows++ : -1;
    double *A = rb_alloc((size_t)k, (size_t)k), *b = p->work, *x = b + p->n, *e = x + p->n,
           *own = e + p->n;
    proof_inverse inverse;
    for (int c = 0; A && c < m; c++)
        for (int q = p->M.p[p->C[c]]; p->core[c] >= 0 && q < p->M.p[p->C[c] + 1]; q++) {
            const int r = p->row[p->M.i[q]];
            if (r >= 0 && of_row[r] >= 0)
                A[(size_t)of_row[r] + (size_t)p->core[c] * (size_t)k] = p->M.x[q];
        }
    const char *why = NULL;
    if (!rb_proof_inverse(k, A, 0.0, &inverse)) {
        *memory = RB_ENOMEM;
        why = "out of memory";
    }
    *norm = inverse.norm;
    if (!why && !(inverse.norm < 0.99))
        why = "the matrix of the basis is not proved to be regular";
    /* rhs 0: the values at bounds; rhs b: column b of the undecided pairs. */
    for (int rhs = 0; !why && rhs <= p->betas; rhs++) {
        double *X = p->X + (size_t)rhs * (size_t)m, *EX = p->EX + (size_t)rhs * (size_t)m;
        /* A regular system K x = -side, of the core first. */
        double *side = p->Y + (size_t)rhs * (size_t)p->n; /* right-hand side, of all rows */
        memset(side, 0, (size_t)p->n * sizeof *side);
        if (rhs == 0)
            memcpy(side, p->base, (size_t)p->n * sizeof *side);
        else
            for (int q = p->M.p[p->beta[rhs - 1]]; q < p->M.p[p->beta[rhs - 1] + 1]; q++)
                side[p->M.i[q]] = p->M.x[q];
        for (int r = 0; r < m; r++)
            if (of_row[r] >= 0) {
                b[of_row[r]] = side[p->E[r]];
                own[of_row[r]] = rhs ? 0.0 : p->base_error[p->E[r]];
            }
        rb_proof_solve(&inverse, b, own, fine, x, e);
        for (int c = 0; c < m; c++)
            if (p->core[c] >= 0) {
                X[c] = x[p->core[c]];
                EX[c] = e[p->core[c]];
            }
        /* Then the columns with one entry, row by row. */
        for (int r = 0; r < m; r++) {
            const int c = p->single[r], i = p->E[r];
            if (c < 0)
                continue;
            double error;
            const double pivot = entry(&p->M, i, p->C[c]),
                         value = row_sum(p, i, rhs, side[i], rhs ? 0.0 : p->base_error[i], 1, fine,
                                         &error);
            X[c] = -value / pivot;
            EX[c] = proof_up(8, fabs(error / pivot) + 4.0 * PROOF_U * fabs(X[c])) + PROOF_TINY;
        }
    }
    /* Y: w = M z + q of all rows, with bounds EY. */
    for (int rhs = 0; !why && rhs <= p->betas; rhs++)
        for (int i = 0; i < p->n; i++) {
            double *y = p->Y + (size_t)rhs * (size_t)p->n + i;
            *y = row_sum(p, i, rhs, *y, rhs ? 0.0 : p->base_error[i], 0, fine,
                         p->EY + (size_t)rhs * (size_t)p->n + i);
        }
    rb_proof_inverse_free(&inverse);
    return why;
}

/* Step 5, t >= 0 of the undecided pairs: w_beta = y + S t, and <S> v >= c > 0 with a v > 0 makes S
 * an H-matrix, so that there is one t, 0 <= t <= v max max(0, -y)/c.  RB_UNDECIDED: S is not shown
 * to be one; RB_ENOMEM. */
static rb_status bound_undecided(prover *p)
{
    const int b = p->betas, n = p->n;
    const size_t order = (size_t)b;
    if (b == 0)
        return RB_OK;
    /* <S>: the comparison matrix of S, |S_ii| on the diagonal and -|S_ij| beside it, each at the
     * worst end of its bounds. */
    double *A = rb_alloc(order, order), *v = rb_alloc(order, 3), *least = v + order,
           *size = least + order;
    proof_inverse inverse = {0};
    int room = A && v;
    for (int i = 0; room && i < b; i++)
        for (int j = 0; j < b; j++) {
            const size_t at = (size_t)(j + 1) * (size_t)n + (size_t)p->beta[i];
            A[(size_t)i + (size_t)j * order] =
                i == j ? p->Y[at] - p->EY[at] : -(fabs(p->Y[at]) + p->EY[at]);
        }
    room = room && rb_proof_inverse(b, rb_copy(order * order, A), 0.0, &inverse);
    int yes = room && isfinite(inverse.norm);
    for (int i = 0; yes && i < b; i++)
        least[i] = -1.0;
    if (yes)
        rb_proof_solve(&inverse, least, NULL, 0, v, size);
    for (int i = 0; yes && i < b; i++)
        yes = v[i] > 0.0;
    double ratio = 0.0;
    if (yes) {
        rb_proof_abs_product(b, b, A, b, v, size);
        for (int i = 0; i < b && yes; i++) {
            double sum = 0.0;
            for (int j = 0; j < b; j++)
                sum += A[(size_t)i + (size_t)j * order] * v[j];
            sum -= proof_error(order + 2, size[i]);
            yes = sum > 0.0;
            const double need = -(p->Y[p->beta[i]] - p->EY[p->beta[i]]);
            if (need > 0.0 && !(need / sum <= ratio))
                ratio = need / sum;
        }
    }
    for (int i = 0; yes && i < b; i++)
        p->t[i] = proof_up(8, ratio * v[i]);
    rb_proof_inverse_free(&inverse);
    free(A);
    free(v);
    return !room ? RB_ENOMEM : yes ? RB_OK : RB_UNDECIDED;
}

/* Whether no other solution lies near, apart from z_j of slack pairs and equal parts of free
 * pairs: every z that may move is an unknown of a regular system with a strict sign, or kept at
 * zero by row j of its slack pair, whose entries are <= 0. */
static int is_isolated(const prover *p)
{
    int *near = p->key;
    for (int i = 0; i < p->n; i++)
        near[i] = !p->strict[i] && p->taken[i] != FREE_TWIN;
    for (int i = 0; i < p->n; i++) {
        const int j = p->partner[i];
        if (p->taken[i] == FREE_BASIC && !are_opposite(p, i, j, near, 0))
            return 0;
        if (p->column[i] >= 0 && p->row[i] < 0)
            return 0; /* C and E are not the same */
        if (p->taken[i] != SLACK_Z) {
            if (near[i] && p->taken[i] != SLACK_W && p->column[i] < 0 && !p->open[i])
                return 0;
            continue;
        }
        int locked = 0;
        for (int k = p->rows.p[j]; k < p->rows.p[j + 1]; k++) {
            if (near[p->rows.i[k]] && p->rows.x[k] > 0.0)
                return 0;
            locked |= p->rows.i[k] == i && p->rows.x[k] < 0.0;
        }
        if (!locked)
            return 0;
    }
    return 1;
}

/* ---- One attempt ------------------------------------------------------------------------ */

/* What an attempt has found of a sign: proved, proved to be the other one, or neither. */
typedef enum { RIGHT, WRONG, OPEN } verdict;

/* Step 4 for one number. */
static verdict above(double x, double e, double bound)
{
    return x - e > bound ? RIGHT : x + e < bound ? WRONG : OPEN;
}

/* z_i of column c between its bounds. */
static verdict of_unknown(const prover *p, int i, double x, double e)
{
    const double low = rb_lcp_lower(p->lower, i), high = rb_lcp_upper(p->upper, i);
    const verdict a = p->taken[i] == FREE_BASIC || isinf(low) ? RIGHT : above(x, e, low),
                  b = isinf(high) ? RIGHT : above(-x, e, -high);
    return a == RIGHT ? b : a == WRONG || b == WRONG ? WRONG : OPEN;
}

/* Values of the z that are not basic, and what they make of M z + q. */
static void set_base(prover *p)
{
    for (int i = 0; i < p->n; i++)
        p->value[i] = p->at[i] == LCP_AT_LOWER   ? rb_lcp_lower(p->lower, i)
                      : p->at[i] == LCP_AT_UPPER ? rb_lcp_upper(p->upper, i)
                                                 : 0.0;
    for (int i = 0; i < p->n; i++) {
        proof_dot sum = {p->q[i], 0.0, fabs(p->q[i])};
        int terms = 0;
        for (int k = p->rows.p[i]; k < p->rows.p[i + 1]; k++)
            if (p->value[p->rows.i[k]] != 0.0) {
                proof_add(&sum, p->rows.x[k], p->value[p->rows.i[k]]);
                terms++;
            }
        p->base[i] = p->q[i];
        p->base_error[i] = 0.0;
        if (terms)
            p->base[i] = proof_value(&sum, (size_t)terms + 1, &p->base_error[i]);
    }
}

/* The undecided t >= 0 widen the bounds E of n numbers X_0 + X_beta t: |z - X_0| <= E_0 + (|X_beta|
 * + E_beta) t. */
static void widen_bounds(const prover *p, int n, const double *X, double *E)
{
    for (int i = 0; p->betas && i < n; i++) {
        double sum = 0.0;
        for (int b = 0; b < p->betas; b++) {
            const size_t at = (size_t)(b + 1) * (size_t)n + (size_t)i;
            sum += (fabs(X[at]) + E[at]) * p->t[b];
        }
        E[i] = proof_up(4, E[i] + proof_up(MOST_UNDECIDED, sum));
    }
}

/* Steps 4 and 5.  RB_OK: proved; RB_UNDECIDED: proof->reason, and the basis is changed where *again
 * is 1. */
static rb_status attempt(prover *p, int *fine, int *again, rb_lcp_proof *proof)
{
    const int n = p->n;
    rb_status memory = RB_OK;
    *again = 0;
    set_base(p);
    if (find_structure(p) != RB_OK)
        return RB_ENOMEM;
    proof->reason = choose_basis(p);
    if (!proof->reason)
        proof->reason = solve_basis(p, *fine, &proof->norm, &memory);
    if (memory != RB_OK)
        return memory;
    if (proof->reason)
        return RB_UNDECIDED;
    const rb_status bounded = bound_undecided(p);
    if (bounded != RB_OK) {
        proof->reason = "undecided pairs that depend on each other";
        proof->row = p->beta[0];
        return bounded;
    }
    widen_bounds(p, p->m, p->X, p->EX);
    widen_bounds(p, n, p->Y, p->EY);
    /* The signs.  Where one is wrong the pair is exchanged; where none is, but one is open, the
     * residual is computed again with more digits; then the pair is left undecided. */
    int wrong = 0, open = 0;
    int *of = p->key; /* n: verdicts */
    proof->margin = INFINITY;
    proof->row = -1;
    for (int i = 0; i < n; i++) {
        /* An unknown of the basis lies between its bounds, any other w_i has the sign of its
         * side. */
        const int c = p->column[i];
        const double low = rb_lcp_lower(p->lower, i), high = rb_lcp_upper(p->upper, i);
        of[i] = RIGHT;
        if (c >= 0) {
            of[i] = of_unknown(p, i, p->X[c], p->EX[c]);
            if (p->taken[i] != FREE_BASIC && isfinite(low))
                proof->margin = fmin(proof->margin, (p->X[c] - low) / p->EX[c]);
            if (isfinite(high))
                proof->margin = fmin(proof->margin, (high - p->X[c]) / p->EX[c]);
        } else if (p->row[i] < 0 && !p->zero[i] && !p->taken[i] && !p->open[i] && low < high) {
            const double w = p->at[i] == LCP_AT_UPPER ? -p->Y[i] : p->Y[i];
            of[i] = above(w, p->EY[i], 0.0);
            p->strict[i] = of[i] == RIGHT;
            if (w > 0.0) /* proved, or not proved below */
                proof->margin = fmin(proof->margin, w / fmax(p->EY[i], PROOF_TINY));
        } else if (low == high)
            p->strict[i] = 1; /* cannot move */
        wrong += of[i] == WRONG;
        open += of[i] == OPEN;
        if (of[i] != RIGHT && proof->row < 0)
            proof->row = i;
    }
    if (!wrong && !open)
        return RB_OK;
    proof->reason = wrong ? "a wrong sign" : "a sign that rounding decides";
    *again = 1;
    if (!wrong && !*fine) {
        *fine = 1;
        return RB_UNDECIDED;
    }
    for (int i = 0; i < n; i++) {
        const int c = p->column[i];
        const double low = rb_lcp_lower(p->lower, i), high = rb_lcp_upper(p->upper, i);
        if (of[i] != (wrong ? WRONG : OPEN))
            continue;
        /* An exchange as in block pivoting: into the basis, or out of it to the bound that was
         * passed. */
        if (wrong) {
            const int is_above = isinf(low) || (isfinite(high) && c >= 0 && p->X[c] > high);
            p->at[i] = c < 0 ? LCP_BETWEEN : is_above ? LCP_AT_UPPER : LCP_AT_LOWER;
            p->open[i] = 0;
        } else if (isfinite(low) && isinf(high)) {
            p->open[i] = 1;
            p->at[i] = LCP_AT_LOWER;
        } else
            *again = 0; /* undecided at an upper bound */
    }
    return RB_UNDECIDED;
}

/* ---- Results ---------------------------------------------------------------------------- */

/* z, its bounds and how far z as given is from it, of a basis that is proved. */
static void write_proof(prover *p, const double *given, rb_lcp_proof *proof)
{
    for (int i = 0; i < p->n; i++) {
        const int c = p->column[i];
        proof->z[i] = c >= 0 ? p->X[c] : p->taken[i] ? 0.0 : p->value[i];
        proof->error[i] = c >= 0 ? p->EX[c] : 0.0;
        proof->state[i] = c >= 0 ? RB_LCP_BASIC : RB_LCP_AT_BOUND;
    }
    for (int b = 0; b < p->betas; b++) {
        proof->error[p->beta[b]] = p->t[b];
        proof->state[p->beta[b]] = RB_LCP_UNDECIDED;
        proof->undecided++;
    }
    for (int i = 0; i < p->n; i++) {
        const int j = p->partner[i];
        if (p->taken[i] == FREE_BASIC) {
            /* z_j - z_i is what the proof knows; its sign says which of the two carries it. */
            if (proof->z[i] < 0.0) {
                proof->z[j] = -proof->z[i];
                proof->z[i] = 0.0;
                proof->state[i] = RB_LCP_AT_BOUND;
                proof->state[j] = RB_LCP_BASIC;
            }
            proof->error[j] = proof->error[i];
            if (fabs(p->X[p->column[i]]) <= proof->error[i]) {
                proof->state[i] = proof->state[j] = RB_LCP_UNDECIDED;
                proof->undecided++;
            }
        } else if (p->taken[i] == SLACK_Z) {
            const double pivot = p->M.x[p->M.p[j]];
            proof->z[j] = fmax(0.0, -p->Y[i] / pivot);
            proof->error[j] =
                proof_up(8, p->EY[i] / pivot + 4.0 * PROOF_U * fabs(p->Y[i] / pivot)) + PROOF_TINY;
            if (fabs(p->Y[i]) <= p->EY[i]) {
                proof->state[j] = RB_LCP_UNDECIDED;
                proof->undecided++;
            } else
                proof->state[j] = proof->z[j] > 0.0 ? RB_LCP_BASIC : RB_LCP_AT_BOUND;
        }
    }
    const double most = fmax(rb_norm_inf((size_t)p->n, proof->z), PROOF_TINY);
    proof->isolated = is_isolated(p);
    proof->bound = proof->stored_within = 0.0;
    for (int i = 0; i < p->n; i++) {
        proof->bound = fmax(proof->bound, proof_up(8, proof->error[i] / most));
        proof->stored_within =
            fmax(proof->stored_within,
                 proof_up(8, (fabs(given[i] - proof->z[i]) + proof->error[i]) / most));
    }
}

/* eps: the z given, with what is outside of its bounds put on them, solves exactly a problem
 * whose q differs from this one by at most eps times the terms |M| |z| + |q| of its row. */
static double nearby(const prover *p, const double *given)
{
    double eps = 0.0;
    for (int i = 0; i < p->n; i++) {
        const double low = rb_lcp_lower(p->lower, i), high = rb_lcp_upper(p->upper, i);
        proof_dot sum = {p->q[i], 0.0, fabs(p->q[i])};
        size_t terms = p->q[i] != 0.0;
        for (int k = p->rows.p[i]; k < p->rows.p[i + 1]; k++) {
            const int j = p->rows.i[k];
            const double z =
                fmin(fmax(given[j], rb_lcp_lower(p->lower, j)), rb_lcp_upper(p->upper, j));
            proof_add(&sum, p->rows.x[k], z);
            terms += z != 0.0;
        }
        if (terms == 0) /* w_i is zero exactly */
            continue;
        double error;
        const double w = proof_value(&sum, terms, &error);
        const double need = low == high        ? 0.0
                            : given[i] <= low  ? fmax(0.0, -(w - error))
                            : given[i] >= high ? fmax(0.0, w + error)
                                               : fabs(w) + error;
        /* size differs from the exact terms by rounding alone, where nothing underflows */
        if (need > 0.0)
            eps = sum.size > 0x1p-900 ? fmax(eps, proof_up(terms + 8, need / sum.size)) : INFINITY;
    }
    return eps;
}

/* Step 1 of docs/proof.md, the basis that z means: C are the z between their bounds whose row is
 * nearly zero. */
static void guess(prover *p, const double *z)
{
    for (int i = 0; i < p->n; i++) {
        p->work[i] = fabs(p->q[i]);
        p->base[i] = p->q[i];
        for (int k = p->rows.p[i]; k < p->rows.p[i + 1]; k++) {
            const double term = p->rows.x[k] * z[p->rows.i[k]];
            p->base[i] += term;
            p->work[i] += fabs(term);
        }
    }
    for (int j = 0; j < p->n; j++) {
        const double low = rb_lcp_lower(p->lower, j), high = rb_lcp_upper(p->upper, j);
        double weight = 0.0; /* the largest part that z_j - bound has of a row */
        const double own = isinf(low) && isinf(high) ? fmax(fabs(z[j]), 1.0)
                                                     : fmin(fabs(z[j] - low), fabs(z[j] - high));
        for (int k = p->M.p[j]; k < p->M.p[j + 1]; k++)
            weight = fmax(weight, fabs(p->M.x[k]) * own / fmax(p->work[p->M.i[k]], PROOF_TINY));
        const int inside = (z[j] > low && z[j] < high) || (isinf(low) && isinf(high));
        if (inside &&
            (isinf(low) || (fabs(p->base[j]) <= GUESS_ROW * p->work[j] && weight > GUESS_UNKNOWN)))
            p->at[j] = LCP_BETWEEN;
        else
            p->at[j] = isinf(low) || (isfinite(high) && fabs(z[j] - high) < fabs(z[j] - low))
                           ? LCP_AT_UPPER
                           : LCP_AT_LOWER;
    }
}

/* M without stored zeros. */
static rb_status copy_without_zeros(const rb_sparse *M, rb_sparse *to)
{
    rb_status s = rb_sparse_copy(M, to);
    int kept = 0, first = 0;
    for (int j = 0; s == RB_OK && j < to->cols; j++) {
        const int end = to->p[j + 1];
        for (int k = first; k < end; k++)
            if (to->x[k] != 0.0) {
                to->i[kept] = to->i[k];
                to->x[kept++] = to->x[k];
            }
        first = end;
        to->p[j + 1] = kept;
    }
    return s;
}

/* Steps 1 to 5, until a basis is proved or an attempt changes none. */
rb_status rb_lcp_prove(const rb_lcp_mixed_problem *given, const double *z, rb_lcp_proof *proof)
{
    const int n = given->M->rows;
    const size_t order = (size_t)(n > 0 ? n : 0);
    *proof = (rb_lcp_proof){.n = n,
                            .row = -1,
                            .bound = NAN,
                            .stored_within = NAN,
                            .nearby = NAN,
                            .margin = NAN,
                            .norm = NAN};
    if (n < 1 || given->M->cols != n ||
        !isfinite(rb_norm_inf((size_t)given->M->p[n], given->M->x)) ||
        !isfinite(rb_norm_inf(order, given->q)) || !isfinite(rb_norm_inf(order, z)))
        return RB_EINVAL;
    prover p = {.n = n, .q = given->q, .lower = given->lower, .upper = given->upper};
    rb_arena scratch = {0};
    /* n each; X, EX, Y and EY grow with the undecided pairs. */
    p.at = rb_arena_zeros(&scratch, order, sizeof *p.at);
    int **ints[] = {&p.open, &p.reads, &p.taken, &p.partner, &p.column, &p.row,   &p.core,
                    &p.key,  &p.C,     &p.E,     &p.single,  &p.zero,   &p.strict};
    for (size_t k = 0; k < sizeof ints / sizeof *ints; k++)
        *ints[k] = rb_arena_ints(&scratch, order);
    p.beta = rb_arena_ints(&scratch, MOST_UNDECIDED);
    p.value = rb_arena_doubles(&scratch, order, 3);
    p.work = rb_arena_doubles(&scratch, order, 4);
    p.t = rb_arena_doubles(&scratch, MOST_UNDECIDED, 1);
    double **large[] = {&p.X, &p.EX, &p.Y, &p.EY};
    for (size_t k = 0; k < sizeof large / sizeof *large; k++)
        *large[k] = rb_arena_doubles(&scratch, order, 1);
    proof->z = rb_alloc(order, 1);
    proof->error = rb_alloc(order, 1);
    proof->state = rb_alloc_int(order);
    rb_status s = scratch.failed || !proof->z || !proof->error || !proof->state ? RB_ENOMEM : RB_OK;
    if (s == RB_OK)
        s = copy_without_zeros(given->M, &p.M);
    if (s == RB_OK)
        s = rb_sparse_transpose(&p.M, &p.rows);
    int fine = 0, again = 1, columns = 1;
    if (s == RB_OK) {
        p.base = p.value + order;
        p.base_error = p.base + order;
        guess(&p, z);
        proof->nearby = nearby(&p, z);
        s = RB_UNDECIDED;
        if (!rb_proof_arithmetic()) {
            proof->reason = "arithmetic does not round to nearest";
            again = 0;
        }
    }
    for (int round = 0; round < ROUNDS && s == RB_UNDECIDED && again; round++) {
        int open = 0;
        for (int i = 0; i < n; i++)
            open |= p.open[i];
        if (open && columns == 1) { /* room for the undecided pairs */
            columns = MOST_UNDECIDED + 1;
            for (size_t k = 0; k < sizeof large / sizeof *large; k++)
                *large[k] = rb_arena_doubles(&scratch, order, (size_t)columns);
        }
        s = scratch.failed ? RB_ENOMEM : attempt(&p, &fine, &again, proof);
        if (s == RB_UNDECIDED && rb_interrupted())
            s = RB_INTERRUPTED;
    }
    if (s == RB_OK) {
        proof->proved = 1;
        proof->reason = "";
        write_proof(&p, z, proof);
    }
    rb_sparse_free(&p.M);
    rb_sparse_free(&p.rows);
    rb_arena_free(&scratch);
    if (s < 0)
        rb_lcp_proof_free(proof);
    return s;
}

void rb_lcp_proof_free(rb_lcp_proof *proof)
{
    free(proof->z);
    free(proof->error);
    free(proof->state);
    *proof = (rb_lcp_proof){0};
}
