/* How many solutions there are: every complementary basis is proved to have none, or to have one
 * at most, or nothing is proved of it; and the bases that a proved solution belongs to have that
 * one alone. */
#include "lcp/proof/absent.h"
#include "lcp/proof/bounds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Bases between two looks at the clock; bases at most. */
enum { BETWEEN_LOOKS = 64, MOST_BASES = 1 << 22 };

/* What is proved of the solutions of a basis.  COUNTED: it has none besides those of a proved
 * solution. */
typedef enum { ANY_NUMBER, NONE, ONE_AT_MOST, COUNTED } basis_verdict;

typedef struct {
    int n;
    const rb_lcp_mixed_problem *p;
    double *M;                                   /* n x n */
    int *places, *digit;                         /* n: how many places z_i has; the present one */
    int *stride;                                 /* n: of z_i in the number of a basis */
    lcp_side *at, *place;                        /* n; 3 x n: the places of each */
    int *C, m;                                   /* n, m: the z between their bounds */
    double *base, *base_error, *b, *own, *x, *e; /* n each */
    unsigned char *verdict;                      /* of each basis */
} counter;

/* ---- A basis ----------------------------------------------------------------------------- */

/* q and the z on their bounds. */
static void set_base(counter *s)
{
    const int n = s->n;
    s->m = 0;
    for (int j = 0; j < n; j++)
        if (s->at[j] == LCP_BETWEEN)
            s->C[s->m++] = j;
    for (int i = 0; i < n; i++) {
        proof_dot sum = {s->p->q[i], 0.0, fabs(s->p->q[i])};
        size_t terms = 0;
        for (int j = 0; j < n; j++) {
            const double z = s->at[j] == LCP_AT_UPPER   ? rb_lcp_upper(s->p->upper, j)
                             : s->at[j] == LCP_AT_LOWER ? rb_lcp_lower(s->p->lower, j)
                                                        : 0.0,
                         a = s->M[(size_t)i + (size_t)j * (size_t)n];
            if (z != 0.0 && a != 0.0) {
                proof_add(&sum, a, z);
                terms++;
            }
        }
        s->base[i] = s->p->q[i];
        s->base_error[i] = 0.0;
        if (terms)
            s->base[i] = proof_value(&sum, terms + 1, &s->base_error[i]);
    }
}

/* 1: a z or w of the point x, e is proved to have the wrong sign; *open: of one it is not known. */
static int is_wrong(const counter *s, int *open)
{
    const int n = s->n;
    *open = 0;
    for (int c = 0; c < s->m; c++) {
        const double low = rb_lcp_lower(s->p->lower, s->C[c]),
                     high = rb_lcp_upper(s->p->upper, s->C[c]);
        if (s->x[c] + s->e[c] < low || s->x[c] - s->e[c] > high)
            return 1;
        *open |= !(s->x[c] - s->e[c] > low && s->x[c] + s->e[c] < high);
    }
    for (int i = 0; i < n; i++) {
        if (s->at[i] == LCP_BETWEEN || rb_lcp_lower(s->p->lower, i) == rb_lcp_upper(s->p->upper, i))
            continue;
        double w = s->base[i], size = fabs(w), through = s->base_error[i];
        for (int c = 0; c < s->m; c++) {
            const double a = s->M[(size_t)i + (size_t)s->C[c] * (size_t)n];
            w += a * s->x[c];
            size += fabs(a * s->x[c]);
            through += fabs(a) * s->e[c];
        }
        const double sign = s->at[i] == LCP_AT_UPPER ? -1.0 : 1.0,
                     error = proof_up((size_t)n + 4, through) + proof_error((size_t)s->m + 2, size);
        if (sign * w + error < 0.0)
            return 1;
        *open |= !(sign * w - error > 0.0);
    }
    return 0;
}

/* Steps 2 to 4 of docs/proof.md for the regular point of a basis; of any other one whether Farkas'
 * lemma excludes it. */
static rb_status judge_basis(counter *s, proof_absence *absence, basis_verdict *verdict)
{
    const size_t n = (size_t)s->n;
    proof_inverse inverse;
    set_base(s);
    const size_t m = (size_t)s->m;
    double *A = rb_alloc(m, m);
    for (size_t c = 0; A && c < m; c++)
        for (size_t r = 0; r < m; r++)
            A[r + c * m] = s->M[(size_t)s->C[r] + (size_t)s->C[c] * n];
    if (!rb_proof_inverse(s->m, A, 0.0, &inverse)) {
        rb_proof_inverse_free(&inverse);
        return RB_ENOMEM;
    }
    *verdict = inverse.norm < 0.99 ? ONE_AT_MOST : ANY_NUMBER;
    for (size_t r = 0; r < m; r++) {
        s->b[r] = s->base[s->C[r]];
        s->own[r] = s->base_error[s->C[r]];
    }
    for (int fine = 0, open = 1; *verdict == ONE_AT_MOST && open && fine < 2; fine++) {
        rb_proof_solve(&inverse, s->b, s->own, fine, s->x, s->e);
        if (is_wrong(s, &open))
            *verdict = NONE;
    }
    rb_proof_inverse_free(&inverse);
    if (*verdict == ANY_NUMBER && isinf(rb_proof_absence_least_sum(absence, s->at)))
        *verdict = NONE;
    return RB_OK;
}

/* ---- Solutions that are proved ------------------------------------------------------------ */

/* 1: the two are different, whatever they are within their bounds. */
static int are_apart(const rb_lcp_proof *a, const rb_lcp_proof *b)
{
    for (int i = 0; i < a->n; i++)
        if (fabs(a->z[i] - b->z[i]) * (1.0 - 8.0 * PROOF_U) >
            proof_up(4, a->error[i] + b->error[i]))
            return 1;
    return 0;
}

/* The bases that agree with the proof, undecided pairs with either choice.  Where each of them is
 * regular, the undecided t solve an LCP whose matrix is an H-matrix with a positive diagonal: one
 * solution lies in all of them together.  1: so it is, and none of them was counted before. */
static int count_group(counter *s, const rb_lcp_proof *proof, int set)
{
    int first = 0, open[32], opens = 0;
    for (int i = 0; i < s->n; i++) {
        const lcp_side at =
            proof->state[i] == RB_LCP_BASIC ? LCP_BETWEEN
            : proof->state[i] == RB_LCP_AT_BOUND && proof->z[i] != rb_lcp_lower(s->p->lower, i)
                ? LCP_AT_UPPER
                : LCP_AT_LOWER;
        int digit = 0;
        while (digit < s->places[i] && s->place[3 * i + digit] != at)
            digit++;
        if (digit == s->places[i])
            return 0;
        first += digit * s->stride[i];
        if (proof->state[i] == RB_LCP_UNDECIDED) {
            if (s->places[i] != 2)
                return 0;
            open[opens++] = s->stride[i]; /* from the lower bound, which comes first, to between */
        }
    }
    for (int subset = 0; subset < 1 << opens; subset++) {
        int basis = first;
        for (int k = 0; k < opens; k++)
            basis += subset >> k & 1 ? open[k] : 0;
        if (set)
            s->verdict[basis] = COUNTED;
        else if (s->verdict[basis] == ANY_NUMBER || s->verdict[basis] == COUNTED)
            return 0;
    }
    return 1;
}

static rb_status prove_each(counter *s, int count, const double *z, rb_lcp_number *number)
{
    rb_status status = RB_OK;
    int groups = 0;
    number->proof = calloc(count ? (size_t)count : 1, sizeof *number->proof);
    if (!number->proof)
        return RB_ENOMEM;
    int *apart = rb_alloc_int((size_t)count);
    for (int k = 0; apart && k < count && status >= 0 && status != RB_INTERRUPTED; k++) {
        rb_lcp_proof *own = &number->proof[k];
        status = rb_lcp_prove(s->p, z + (size_t)k * (size_t)s->n, own);
        number->proofs = k + (status >= 0);
        if (status != RB_OK)
            continue;
        number->proved++;
        apart[k] = 1;
        for (int l = 0; l < k && apart[k]; l++)
            apart[k] = !apart[l] || are_apart(own, &number->proof[l]);
        number->least += apart[k];
        if (count_group(s, own, 0))
            groups += count_group(s, own, 1);
    }
    number->most = groups;
    if (!apart)
        status = RB_ENOMEM;
    free(apart);
    return status < 0 || status == RB_INTERRUPTED ? status : RB_OK;
}

/* ---- All together -------------------------------------------------------------------------- */

void rb_lcp_number_free(rb_lcp_number *number)
{
    for (int k = 0; k < number->proofs; k++)
        rb_lcp_proof_free(&number->proof[k]);
    free(number->proof);
    *number = (rb_lcp_number){0};
}

/* Every complementary basis. */
static rb_status judge_all(counter *s, double bases, double seconds, proof_absence *absence)
{
    const double began = rb_seconds();
    rb_status status = RB_OK;
    for (int basis = 0; status == RB_OK && basis < (int)bases; basis++) {
        for (int i = 0; i < s->n; i++)
            s->at[i] = s->place[3 * i + basis / s->stride[i] % s->places[i]];
        basis_verdict verdict = ANY_NUMBER;
        status = judge_basis(s, absence, &verdict);
        s->verdict[basis] = (unsigned char)verdict;
        if (status == RB_OK && rb_interrupted())
            status = RB_INTERRUPTED;
        if (status == RB_OK && seconds > 0.0 && basis % BETWEEN_LOOKS == 0 &&
            rb_seconds() - began > seconds)
            status = RB_TIME_LIMIT;
    }
    return status;
}

rb_status rb_lcp_prove_number(const rb_lcp_mixed_problem *p, const double *most, int count,
                              const double *z, double seconds, rb_lcp_number *number)
{
    const int n = p->M->rows;
    const size_t order = (size_t)n;
    double bases = 1.0;
    rb_arena scratch = {0};
    counter s = {.n = n, .p = p};
    *number = (rb_lcp_number){.most = -1};
    s.M = rb_arena_doubles(&scratch, order, order + 6);
    s.at = rb_arena_zeros(&scratch, order, 4 * sizeof *s.at);
    int **ints[] = {&s.places, &s.stride, &s.C};
    for (size_t k = 0; k < sizeof ints / sizeof *ints; k++)
        *ints[k] = rb_arena_ints(&scratch, order);
    for (int i = 0; i < n && !scratch.failed; i++) {
        s.place = s.at + order;
        s.stride[i] = (int)bases;
        for (int at = LCP_AT_LOWER; at <= LCP_BETWEEN; at++)
            if (rb_lcp_is_place(p->lower, p->upper, i, (lcp_side)at))
                s.place[3 * i + s.places[i]++] = (lcp_side)at;
        bases *= s.places[i];
        if (bases > MOST_BASES)
            return rb_arena_done(&scratch, RB_EINVAL);
    }
    s.verdict = rb_arena_zeros(&scratch, (size_t)bases, 1);
    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    double **vectors[] = {&s.base, &s.base_error, &s.b, &s.own, &s.x, &s.e};
    for (size_t k = 0; k < sizeof vectors / sizeof *vectors; k++)
        *vectors[k] = s.M + (order + k) * order;
    for (int j = 0; j < n; j++)
        for (int k = p->M->p[j]; k < p->M->p[j + 1]; k++)
            s.M[(size_t)p->M->i[k] + (size_t)j * order] = p->M->x[k];
    const lcp_matrix M = {.n = n, .dense = s.M, .ld = n};
    proof_absence absence;
    rb_status status = rb_proof_absence_create(&M, p->q, p->lower, p->upper, most, &absence);
    if (status == RB_OK && rb_proof_arithmetic())
        status = judge_all(&s, bases, seconds, &absence);
    rb_proof_absence_free(&absence);
    const rb_status end = status; /* what was not looked at has any number */
    if (status == RB_OK || status == RB_TIME_LIMIT)
        status = prove_each(&s, count, z, number);
    int unbounded = 0;
    for (int basis = 0; status == RB_OK && basis < (int)bases; basis++) {
        unbounded += s.verdict[basis] == ANY_NUMBER;
        number->open += s.verdict[basis] == ONE_AT_MOST;
    }
    number->most = unbounded ? -1 : number->most + number->open;
    number->open += unbounded;
    rb_arena_free(&scratch);
    if (status == RB_OK)
        return end;
    rb_lcp_number_free(number);
    return status;
}
