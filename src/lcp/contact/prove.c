/* Proof that the contact problem has a solution with these zones: its pivoted form (K5), whose
 * coefficients are those of the operator, and the unknowns that the state means. */
#include "lcp/contact/contact.h"
#include "base/sizes.h"
#include "lcp/contact/internal.h"

#include <cblas.h>
#include <lapacke.h>
#include <stdlib.h>
#include <string.h>

/* Below this part of mu p a distance to the bound of friction is rounding: where the proof begins.
 */
static const double NOTHING = 1e-12;

/* The matrices of products, column by column. */
static rb_status form_matrices(const rb_contact_problem *p, double **F, rb_contact_operator **op)
{
    const int n = p->n;
    const size_t length = (size_t)n;
    rb_arena scratch = {0};
    double *unit = rb_arena_doubles(&scratch, 2 * length, 1);
    *F = rb_alloc(length, 2 * length);
    double *S = rb_alloc(length, 2 * length);
    if (scratch.failed || !*F || !S) {
        free(S);
        return rb_arena_done(&scratch, RB_ENOMEM);
    }
    for (size_t j = 0; j < 2 * length; j++) {
        unit[j] = 1.0;
        rb_contact_operator_add(p->op, unit, unit + length, *F + j * length, S + j * length);
        unit[j] = 0.0;
    }
    rb_arena_free(&scratch);
    return rb_contact_operator_dense(n, *F, n, S, op);
}

/* z of the pivoted form that the state means; its inverse is rb_contact_lcp_recover.  Where the
 * surfaces slide the friction is its bound: returns by which part the coefficients of friction
 * would have to differ for that. */
static double unknowns(const rb_contact_problem *p, const rb_contact_lcp *lcp,
                       const rb_contact_state *s, double *z)
{
    const int n = p->n, borders = (lcp->yields ? 5 : 3) * n;
    const double o = lcp->mirrored ? -1.0 : 1.0;
    double differ = 0.0;
    memset(z, 0, (size_t)lcp->size * sizeof *z);
    for (int i = 0; i < n; i++) {
        const int slides =
            s->zone[i] == RB_ZONE_SLIP_NEGATIVE || s->zone[i] == RB_ZONE_SLIP_POSITIVE;
        const double most = p->bound[i] * s->p[i], plastic = p->yield ? o * s->plastic[i] : 0.0;
        double gamma = o * s->q[i] + most, slip = o * s->lambda[i] - plastic;
        /* a slip against its zone is rounding: its row shows it, as a part of its terms */
        const int is_forward = slides && most > 0.0 && o * rb_contact_slope(s->zone[i]) < 0.0;
        if (slides && most > 0.0) {
            const double r_T = rb_contact_slope(s->zone[i]) * most;
            differ = fmax(differ, fabs(s->q[i] - r_T) / most);
            gamma = o * r_T + most;
        }
        if (s->zone[i] == RB_ZONE_SEPARATED || gamma <= NOTHING * most)
            gamma = 0.0;
        if (fabs(slip) <= NOTHING * fabs(s->lambda[i]))
            slip = 0.0; /* all of it is plastic */
        z[i] = s->p[i];
        z[n + i] = gamma;
        z[2 * n + i] = s->zone[i] == RB_ZONE_STICK || is_forward ? 0.0 : fmax(0.0, -slip);
        if (lcp->yields) {
            z[3 * n + i] = fmax(0.0, plastic);
            z[4 * n + i] = fmax(0.0, -plastic);
        }
    }
    if (p->load_given)
        z[borders] = s->delta - lcp->delta0;
    if (p->force_given)
        z[borders + p->load_given] = fabs(s->xi - lcp->xi0);
    for (int k = 0; k < lcp->size; k++)
        z[k] /= lcp->z_scale[k];
    return differ * (1.0 + 0x1p-48) + 0x1p-50;
}

/* What a proof of the LCP says of tractions: bounds as parts of the largest pressure. */
static void translate(const rb_contact_problem *p, const rb_contact_lcp *lcp,
                      const rb_contact_state *s, const rb_lcp_proof *of, rb_contact_proof *proof)
{
    const int n = p->n;
    const double o = lcp->mirrored ? -1.0 : 1.0, u = 0x1p-50;
    double most = 0.0;
    proof->isolated = of->isolated;
    proof->margin = of->margin;
    for (int i = 0; i < n; i++)
        most = fmax(most, of->z[i] * lcp->z_scale[i]);
    most = most > 0.0 ? most : p->stress;
    proof->bound_p = proof->bound_q = proof->stored_within = 0.0;
    for (int i = 0; i < n; i++) {
        /* 8 u pay for the rounding of these few operations themselves */
        const double r_N = of->z[i] * lcp->z_scale[i], gamma = of->z[n + i] * lcp->z_scale[n + i],
                     e_N = (of->error[i] * lcp->z_scale[i] + u * fabs(r_N)) * (1.0 + u),
                     r_T = o * (gamma - p->bound[i] * r_N),
                     e_T = (of->error[n + i] * lcp->z_scale[n + i] + p->bound[i] * e_N +
                            u * (fabs(gamma) + p->bound[i] * fabs(r_N))) *
                           (1.0 + u);
        proof->bound_p = fmax(proof->bound_p, e_N / most * (1.0 + u));
        proof->bound_q = fmax(proof->bound_q, e_T / most * (1.0 + u));
        proof->stored_within =
            fmax(proof->stored_within,
                 fmax(fabs(s->p[i] - r_N) + e_N, fabs(s->q[i] - r_T) + e_T) / most * (1.0 + u));
        /* A separated element has a slip of any sign, one without friction a direction that means
         * nothing: their zones are known. */
        int open = of->state[i] == RB_LCP_UNDECIDED;
        for (int k = 1; k * n + i < (lcp->yields ? 5 : 3) * n; k++)
            open |= of->state[k * n + i] == RB_LCP_UNDECIDED && of->state[i] == RB_LCP_BASIC &&
                    p->bound[i] > 0.0;
        if (open && proof->undecided++ < RB_CONTACT_UNDECIDED)
            proof->element[proof->undecided - 1] = i + 1;
    }
}

/* ---- Uniqueness ------------------------------------------------------------------------- */

/* Candidates of weights d > 0 with D A nearly symmetric: row/column, with which the unknown of a
 * border cancels, where A has one with row'dx = 0 and this column, exactly; without a border also
 * ones, and the sums of the columns of A over those of its rows.  0: there are no more. */
static int choose_weights(int n, const double *A, int ld, int border, const double *row,
                          const double *column, int kind, double *d)
{
    enum { RATIO, ONES, SUMS, KINDS };
    int cancels = 1;
    for (int i = 0; i < n && kind < KINDS; i++) {
        double of_row = 0.0, of_column = 0.0;
        for (int j = 0; kind == SUMS && j < n; j++) {
            of_row += A[i + (size_t)j * (size_t)ld];
            of_column += A[j + (size_t)i * (size_t)ld];
        }
        d[i] = kind == RATIO ? row[i] / column[i] : kind == ONES ? 1.0 : of_column / of_row;
        cancels &= fma(d[i], column[i], -row[i]) == 0.0;
    }
    return kind < (border ? ONES : KINDS) && (cancels || !border);
}

/* definite: two solutions have the same x: sum d_i dx_i dy_i <= 0 for complementary x and y = A x
 * + column b, and dx'D A dx > 0 otherwise.  x are the pressures and y the gaps, or friction and
 * slips. */
static rb_status prove_part(int n, const double *A, int ld, int border, const double *row,
                            const double *column, double *d, int *definite)
{
    rb_status s = RB_OK;
    *definite = 0;
    for (int kind = 0;
         s == RB_OK && !*definite && choose_weights(n, A, ld, border, row, column, kind, d); kind++)
        s = rb_lcp_prove_definite(n, A, ld, d, NULL, definite);
    return s;
}

/* ---- Uniqueness where pressure and friction act on each other ----------------------------- */

/* Two solutions have dp_i dy_i <= 0 and dt_i ds_i <= mu_i |dp_i| |ds_i| (p pressures, y gaps, t
 * friction, s slips = [S_N S_T] x with x = (dp, dt)), so that for all d, kappa, alpha > 0
 *
 *     x'D [F; kappa S] x <= sum kappa d mu (alpha dp^2 + ds^2/alpha)/2,
 *
 * which is not so for x other than zero where the difference of both sides is definite. */
typedef struct {
    int n;
    const rb_contact_matrix *K;
    const double *mu;
    double *H, *G, *G_size; /* 2n x 2n: D [F; S]; S'D mu S, of S and of its moduli */
    double *E, *radius;     /* 2n x 2n: the difference, and what its entries may be wrong by */
    double *factor, *ones;  /* 2n x 2n, 2n */
} energy;

/* G = T'diag(w) T, T n x 2n; work: n x 2n. */
static void gram(int n, const double *T, const double *w, double *work, double *G)
{
    for (int j = 0; j < 2 * n; j++)
        for (int i = 0; i < n; i++)
            work[i + j * n] = w[i] * T[i + j * n];
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, 2 * n, 2 * n, n, 1.0, T, n, work, n, 0.0,
                G, 2 * n);
}

static void set_weights(energy *e, const double *d, double *work)
{
    const int n = e->n, m = 2 * n;
    double *w = work + (size_t)n * (size_t)m, *T = w + n;
    for (int i = 0; i < n; i++)
        w[i] = d[i] * e->mu[i];
    gram(n, e->K->S, w, work, e->G);
    for (int k = 0; k < n * m; k++)
        T[k] = fabs(e->K->S[k]);
    gram(n, T, w, work, e->G_size);
    for (int j = 0; j < m; j++)
        for (int i = 0; i < n; i++) {
            e->H[i + j * m] = d[i] * e->K->F[i + (size_t)j * (size_t)e->K->ldf];
            e->H[n + i + j * m] = d[i] * e->K->S[i + j * n];
        }
}

/* The difference is proved to be definite.  RB_ENOMEM. */
static rb_status prove_energy(energy *e, const double *d, double kappa, double alpha, int *definite)
{
    const int n = e->n, m = 2 * n;
    const double c = 0.5 * kappa / alpha;
    for (int j = 0; j < m; j++)
        for (int i = 0; i < m; i++) {
            const int k = i + j * m;
            const double h = (i < n ? 1.0 : kappa) * e->H[k],
                         own = i == j && i < n ? 0.5 * kappa * alpha * d[i] * e->mu[i] : 0.0;
            e->E[k] = h - c * e->G[k] - own;
            e->radius[k] =
                32.0 * 0x1p-53 * (fabs(h) + own) + c * (64.0 + 4.0 * n) * 0x1p-53 * e->G_size[k];
        }
    for (int j = 0; j < m; j++) /* the symmetric part has a Cholesky factor, or it ends here */
        for (int i = j; i < m; i++)
            e->factor[i + j * m] = 0.5 * (e->E[i + j * m] + e->E[j + i * m]);
    *definite = 0;
    if (LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', m, e->factor, m) != 0)
        return RB_OK;
    return rb_lcp_prove_definite(m, e->E, m, e->ones, e->radius, definite);
}

/* unique: 1: the tractions are the only ones for this creepage. */
static rb_status prove_coupled(const rb_contact_problem *p, const rb_contact_matrix *K, int *unique)
{
    const int n = p->n;
    const size_t length = (size_t)n, order = 2 * length;
    rb_arena scratch = {0};
    energy e = {.n = n, .K = K, .mu = p->bound};
    *unique = 0;
    if (n > RB_CONTACT_PROOF_COUPLED_UP_TO)
        return RB_OK;
    double **matrices[] = {&e.H, &e.G, &e.G_size, &e.E, &e.radius, &e.factor};
    for (size_t k = 0; k < sizeof matrices / sizeof *matrices; k++)
        *matrices[k] = rb_arena_doubles(&scratch, order, order);
    double *d = rb_arena_doubles(&scratch, length, 2), *column = d + length,
           *work = rb_arena_doubles(&scratch, length, 2 * order + 1);
    e.ones = rb_arena_doubles(&scratch, order, 1);
    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    double largest = 0.0;
    for (size_t i = 0; i < length; i++) {
        double sum = 0.0;
        e.ones[2 * i] = e.ones[2 * i + 1] = column[i] = 1.0;
        for (size_t j = 0; j < length; j++)
            sum += fabs(K->S[i + (length + j) * length]);
        largest = fmax(largest, sum);
    }
    rb_status s = RB_OK;
    for (int kind = 0; s == RB_OK && !*unique &&
                       choose_weights(n, K->F, K->ldf, p->load_given, p->load_N, column, kind, d);
         kind++) {
        int positive = 1;
        for (int i = 0; i < n; i++)
            positive &= d[i] > 0.0 && isfinite(d[i]);
        if (!positive)
            continue;
        set_weights(&e, d, work);
        for (int of_kappa = 0; of_kappa <= 6 && !*unique; of_kappa++)
            for (int of_alpha = -4; s == RB_OK && of_alpha <= 6 && !*unique; of_alpha++)
                s = prove_energy(&e, d, pow(10.0, -0.5 * of_kappa),
                                 largest * pow(10.0, 0.25 * of_alpha), unique);
    }
    return rb_arena_done(&scratch, s);
}

/* Of coefficients of friction as they are; force_given: the creepage belongs to a force.  First the
 * pressure, which friction does not change, then friction under that pressure (docs/proof.md). */
static rb_status prove_unique(const rb_contact_problem *p, int force_given, rb_contact_proof *proof)
{
    const int n = p->n;
    const size_t length = (size_t)n;
    const rb_contact_matrix K = rb_contact_operator_matrix(p->op);
    int coupled = 0, of_load = 0, definite = 0;
    proof->unique = "not shown";
    if (p->yield)
        return RB_OK;
    for (size_t j = 0; j < length; j++) {
        for (size_t i = 0; i < length; i++)
            coupled |= K.F[i + (length + j) * (size_t)K.ldf] != 0.0;
        of_load |= p->load_given && p->load_T[j] != 0.0;
    }
    if ((coupled || of_load) && p->mu > 0.0) {
        const rb_status s = of_load ? RB_OK : prove_coupled(p, &K, &definite);
        if (definite)
            proof->unique = force_given ? "at its creepage" : "energy";
        return s;
    }
    rb_arena scratch = {0};
    double *d = rb_arena_doubles(&scratch, length, 4), *row_N = d + length, *row_T = row_N + length,
           *ones = row_T + length;
    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    for (size_t i = 0; i < length; i++)
        ones[i] = 1.0;
    rb_status s = prove_part(n, K.F, K.ldf, p->load_given, p->load_N, ones, d, &definite);
    if (s == RB_OK && definite) {
        proof->unique = p->mu > 0.0 ? "pressure" : "frictionless";
        if (p->mu > 0.0) {
            rb_contact_force_row(p, row_N, row_T);
            s = prove_part(n, K.S + length * length, n, p->force_given, row_T, p->e_T, d,
                           &definite);
            if (s == RB_OK && definite)
                proof->unique = "uncoupled";
        }
    }
    return rb_arena_done(&scratch, s);
}

/* Whether a given force does not tell the motion: all that friction can carry, or no element that
 * sticks. */
static int force_tells_no_motion(const rb_contact_problem *p, const rb_contact_state *state)
{
    int stick = 0;

    for (int i = 0; i < p->n; i++)
        stick += state->zone[i] == RB_ZONE_STICK;
    return rb_contact_slides_fully(p) || (p->force_given && !p->yield && stick == 0);
}

rb_status rb_contact_prove(const rb_contact_problem *problem, const rb_contact_state *state,
                           rb_contact_proof *proof, rb_message *why)
{
    const int n = problem->n;
    rb_contact_problem p = *problem; /* the arrays stay the problem's */
    rb_contact_operator *formed = NULL;
    rb_contact_lcp lcp = {0};
    rb_sparse M = {0};
    rb_lcp_proof of = {0};
    double *z = NULL, *F = NULL, differ = 0.0;
    rb_status s = RB_OK;
    *proof = (rb_contact_proof){.asked = 1,
                                .reason = "",
                                .bound_p = NAN,
                                .bound_q = NAN,
                                .stored_within = NAN,
                                .nearby = NAN,
                                .margin = NAN,
                                .norm = NAN};
    if (!rb_contact_operator_matrix(p.op).F) {
        if (n > RB_CONTACT_PROOF_FORMS_UP_TO) {
            proof->reason = "too many elements for a matrix";
            return RB_OK;
        }
        s = form_matrices(problem, &F, &formed);
        p.op = formed;
    }
    /* Where a range of creepages will do it is taken as given. */
    if (force_tells_no_motion(problem, state)) {
        p.force_given = 0;
        p.xi = state->xi;
    }
    double sum = 0.0;
    for (int i = 0; i < n; i++)
        sum += state->zone[i] != RB_ZONE_SEPARATED ? state->lambda[i] : 0.0;
    /* an xi0 on the far side of xi, so that xi' > 0 */
    const double far = p.sliding + 2.0 * fabs(state->xi),
                 xi0 = (state->xi < 0.0 ? -1.0 : 1.0) *
                       (far > 0.0 ? far : p.slip_length / (rb_norm_1((size_t)n, p.e_T, 1) / n));
    if (s == RB_OK)
        s = rb_contact_lcp_create(&p, RB_LCP_PIVOTED, sum < 0.0, xi0, &lcp, why);
    if (s == RB_OK) {
        z = rb_alloc((size_t)lcp.size, 1);
        s = z ? rb_sparse_from_dense(lcp.size, lcp.size, lcp.M, lcp.size, &M) : RB_ENOMEM;
    }
    if (s == RB_OK) {
        differ = unknowns(&p, &lcp, state, z);
        s = rb_lcp_prove(&(rb_lcp_mixed_problem){.M = &M, .q = lcp.b}, z, &of);
    }
    if (s == RB_OK || s == RB_UNDECIDED) { /* it ran */
        proof->proved = of.proved;
        proof->nearby = fmax(of.nearby, differ);
        proof->norm = of.norm;
        proof->reason = of.reason;
        s = prove_unique(&p, problem->force_given, proof);
        if (of.proved)
            translate(&p, &lcp, state, &of, proof);
        else if (of.row >= 0)
            rb_contact_lcp_variable(&lcp, n, of.row, proof->where);
    }
    rb_lcp_proof_free(&of);
    rb_sparse_free(&M);
    free(z);
    rb_contact_lcp_free(&lcp);
    rb_contact_operator_free(formed);
    free(F);
    return s == RB_OK || s == RB_INTERRUPTED
               ? s
               : rb_fail(why, s, "proof of %d contact elements: %s", n, rb_status_text(s));
}
