/* A solution on fewer elements is the start on more, so that the number of Newton steps
 * does not grow: the elements of the problem itself in pairs. */
#include "lcp/contact/dense.h"

/* y += sums over pairs; an odd last element stays alone. */
static void add_pairs(int n, const double *x, double *y)
{
    for (int k = 0; k < n / 2; k++)
        y[k] += x[2 * k] + x[2 * k + 1];
    if (n % 2)
        y[n / 2] += x[n - 1];
}

/* How pairs see what varies over elements: shares of the two and of the next one. */
typedef struct {
    double first, second, next;
} shares;

static const shares MEAN = {0.5, 0.5, 0.0};
/* The difference between the mean displacement of a pair and that of the pair upstream is
 * twice this mean of the slips.  That of two slips alone would be the difference between
 * the ends of a pair, to which its own traction adds nothing. */
static const shares UPSTREAM_MEAN = {0.25, 0.5, 0.25};

static shares of_slips(int differences)
{
    return differences ? UPSTREAM_MEAN : MEAN;
}

/* y += means over pairs. */
static void add_means(int n, shares of, const double *x, double *y)
{
    const int last = (n - 1) / 2;

    for (int k = 0; k < last; k++)
        y[k] += of.first * x[2 * k] + of.second * x[2 * k + 1] + of.next * x[2 * k + 2];
    if (n % 2)
        y[last] += x[n - 1];
    else
        y[last] += (of.first * x[n - 2] + of.second * x[n - 1]) / (1.0 - of.next);
}

/* Answers of the pairs to tractions constant over each pair: 2n columns of A. */
static void halve_matrix(int n, shares of, const double *A, int lda, double *C)
{
    const size_t m = (size_t)(n + 1) / 2;

    for (int half = 0; half < 2; half++, A += (size_t)n * (size_t)lda, C += m * m)
        for (int j = 0; j < n; j++)
            add_means(n, of, A + (size_t)j * (size_t)lda, C + (size_t)(j / 2) * m);
}

rb_status rb_contact_dense_halve(const rb_contact_operator *fine, int differences,
                                 rb_contact_operator **half)
{
    const rb_contact_matrix *K = &fine->matrix;
    const int n = fine->n, m = (n + 1) / 2;
    double *S = rb_alloc((size_t)m, 4 * (size_t)m); /* S, then F in the same memory */
    double *F = S + 2 * (size_t)m * (size_t)m;

    *half = NULL;
    if (!S)
        return RB_ENOMEM;
    halve_matrix(n, MEAN, K->F, K->ldf, F);
    halve_matrix(n, of_slips(differences), K->S, n, S);
    return rb_contact_operator_dense(m, F, m, S, half);
}

rb_status rb_contact_halve(const rb_contact_problem *fine, rb_contact_problem *half)
{
    const int n = fine->n;
    const shares slip = of_slips(fine->differences);
    rb_contact_operator *op = NULL;
    rb_status s = fine->op->kind->halve ? fine->op->kind->halve(fine->op, fine->differences, &op)
                                        : RB_MAXITER;

    if (s != RB_OK)
        return s;
    *half = *fine; /* controls and scales are those of the fine problem */
    half->op = op;
    half->n = op->n;
    half->yield = NULL; /* elastic problems alone start from pairs */
    s = rb_contact_problem_alloc_rows(half);
    if (s != RB_OK)
        return s;
    add_means(n, MEAN, fine->bound, half->bound);
    add_means(n, MEAN, fine->d_N, half->d_N);
    add_means(n, slip, fine->d_T, half->d_T);
    add_means(n, slip, fine->e_T, half->e_T);
    add_pairs(n, fine->load_N, half->load_N);
    add_pairs(n, fine->load_T, half->load_T);
    add_pairs(n, fine->force_N, half->force_N);
    add_pairs(n, fine->force_T, half->force_T);
    add_pairs(n, fine->moment_N, half->moment_N);
    add_pairs(n, fine->moment_T, half->moment_T);
    return RB_OK;
}

void rb_contact_start_from_half(const rb_contact_state *half, rb_contact_state *state)
{
    for (int i = 0; i < state->n; i++) {
        state->p[i] = half->p[i / 2];
        state->q[i] = half->q[i / 2];
        state->zone[i] = half->zone[i / 2];
    }
    state->delta = half->delta;
    state->xi = half->xi;
}
