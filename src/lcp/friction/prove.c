/* Proof that a frictional problem u = W r + q has a solution with these zones.  As a
 * complementarity problem its coefficients W_NN - mu W_NT would be rounded; the active equations
 * have the coefficients that are given:
 *
 *     separated  r = 0                       then u_N > 0
 *     stick      u = 0                       then r_N > 0, |r_T| < mu r_N
 *     slip, 2D   u_N = 0, r_T + s mu r_N = 0     then r_N > 0, s u_T > 0
 *     slip, 3D   u_N = 0, u_T + sigma r_T = 0, r_T'r_T = mu^2 r_N^2   then r_N > 0, sigma > 0
 *     mu = 0     u_N = 0, r_T = 0            then r_N > 0
 *
 * They are linear in 2D; in 3D Krawczyk's operator maps a box into itself, in which they then have
 * exactly one zero (docs/proof.md). */
#include "lcp/friction/internal.h"
#include "lcp/proof/bounds.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Repairs of the zones, Newton steps, inflations of the box; unknowns whose matrix is inverted. */
enum { ROUNDS = 30, STEPS = 30, INFLATIONS = 8, MOST_UNKNOWNS = 4000 };
/* Steps below this part of the largest unknown that do not become smaller are rounding. */
static const double NEARLY = 1e-9;

/* Zones, as rb_friction_proof counts them; SMOOTH: closed, mu = 0. */
enum { SEPARATED, STICK, SLIP, SMOOTH };

typedef struct {
    int d, nc, m; /* m = d nc */
    const double *mu, *q;
    const rb_sparse *W;
    int *zone, *place, *slides, *idle; /* nc; m: number of the unknown, -1; nc: of sigma, -1; m */
    double *r, *e, *u, *eu, *size, *sign; /* m each, but sign: nc, of u_T (2D) */
    int n;                                /* unknowns */
    double *x, *rho;                      /* n: the unknowns and their bounds */
    double *A, *b;                        /* n x n, n: the linear part of the equations */
} prover;

/* u = W r + q in twice the precision, with its rounding errors and the terms |W| |r| + |q|. */
static rb_status velocities(const prover *p, const double *r, double *u, double *error,
                            double *terms)
{
    proof_dot *sum = calloc((size_t)p->m, sizeof *sum);
    int *count = rb_alloc_int((size_t)p->m);
    const rb_status s = sum && count ? RB_OK : RB_ENOMEM;
    for (int i = 0; s == RB_OK && i < p->m; i++)
        if (p->q[i] != 0.0) {
            sum[i] = (proof_dot){p->q[i], 0.0, fabs(p->q[i])};
            count[i] = 1;
        }
    for (int j = 0; s == RB_OK && j < p->m; j++)
        for (int k = p->W->p[j]; r[j] != 0.0 && k < p->W->p[j + 1]; k++)
            if (p->W->x[k] != 0.0) {
                proof_add(&sum[p->W->i[k]], p->W->x[k], r[j]);
                count[p->W->i[k]]++;
            }
    for (int i = 0; s == RB_OK && i < p->m; i++) {
        u[i] = error[i] = 0.0;
        terms[i] = sum[i].size;
        if (count[i])
            u[i] = proof_value(&sum[i], (size_t)count[i], &error[i]);
    }
    free(sum);
    free(count);
    return s;
}

/* What the reactions mean; separated ones and those that friction cannot be become exactly zero. */
static rb_status guess_zones(prover *p, const double *given)
{
    memcpy(p->r, given, (size_t)p->m * sizeof *p->r);
    const rb_status s = velocities(p, p->r, p->u, p->eu, p->size);
    for (int c = 0; s == RB_OK && c < p->nc; c++) {
        double *r = p->r + c * p->d;
        const double *u = p->u + c * p->d, a = fmax(rb_sparse_diagonal(p->W, c * p->d), PROOF_TINY);
        /* W_NN r_N and u_N are velocities: the larger one says whether the contact is closed, and
         * likewise whether it slips. */
        if (r[0] * a <= fmax(u[0], 0.0) || !(r[0] > 0.0))
            p->zone[c] = SEPARATED;
        else if (p->mu[c] == 0.0)
            p->zone[c] = SMOOTH;
        else
            p->zone[c] = rb_friction_tangential(p->d, u) >
                                 a * (p->mu[c] * r[0] - rb_friction_tangential(p->d, r))
                             ? SLIP
                             : STICK;
        for (int k = 0; k < p->d; k++)
            if (p->zone[c] == SEPARATED || (p->zone[c] == SMOOTH && k > 0))
                r[k] = 0.0;
    }
    return s;
}

/* ---- The active equations ------------------------------------------------------------- */

/* 1: the row of u_i is an equation of the contact. */
static int is_active(const prover *p, int i)
{
    const int zone = p->zone[i / p->d];
    return zone == STICK || zone == SLIP || (zone == SMOOTH && i % p->d == 0);
}

/* Unknowns, their first values, and the linear part.  RB_ENOMEM; RB_EINVAL: too many. */
static rb_status pose_equations(prover *p)
{
    const int d = p->d;
    p->n = 0;
    for (int i = 0; i < p->m; i++)
        p->place[i] = is_active(p, i) ? p->n++ : -1;
    for (int c = 0; c < p->nc; c++) {
        p->slides[c] = d == 3 && p->zone[c] == SLIP ? p->n++ : -1;
        p->sign[c] = p->u[c * d + 1] > 0.0 ? 1.0 : -1.0;
    }
    const size_t n = (size_t)p->n;
    free(p->A);
    p->A = NULL;
    if (p->n > MOST_UNKNOWNS)
        return RB_EINVAL;
    p->A = rb_alloc(n, n + 3);
    if (!p->A)
        return RB_ENOMEM;
    /* Rows and columns of W that belong to active equations; the rest of r is zero. */
    p->b = p->A + n * n;
    p->x = p->b + n;
    p->rho = p->x + n;
    for (int j = 0; j < p->m; j++) {
        const int column = p->place[j];
        if (column < 0)
            continue;
        p->x[column] = p->r[j];
        p->b[column] = p->q[j];
        for (int k = p->W->p[j]; k < p->W->p[j + 1]; k++)
            if (p->place[p->W->i[k]] >= 0)
                p->A[(size_t)p->place[p->W->i[k]] + (size_t)column * n] = p->W->x[k];
    }
    for (int c = 0; c < p->nc; c++) {
        if (p->zone[c] != SLIP)
            continue;
        /* In the plane slip is linear; in space sigma is another unknown, |u_T|/|r_T| to begin
         * with. */
        const size_t N = (size_t)p->place[c * d], T = N + 1;
        if (d == 2) { /* r_T + s mu r_N = 0 in the row of u_T */
            for (size_t j = 0; j < n; j++)
                p->A[T + j * n] = 0.0;
            p->A[T + T * n] = 1.0;
            p->A[T + N * n] = p->sign[c] * p->mu[c];
            p->b[T] = 0.0;
        } else
            p->x[p->slides[c]] =
                rb_friction_tangential(d, p->u + c * d) / fmax(p->mu[c] * p->r[c * d], PROOF_TINY);
    }
    return RB_OK;
}

/* f of the active equations at x, and the sum of the moduli of its terms. */
static void active_residual(const prover *p, const double *x, double *f, double *size)
{
    const int n = p->n;
    for (int i = 0; i < n; i++) {
        f[i] = p->b[i];
        size[i] = fabs(p->b[i]);
    }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const double term = p->A[(size_t)i + (size_t)j * (size_t)n] * x[j];
            f[i] += term;
            size[i] += fabs(term);
        }
    for (int c = 0; c < p->nc; c++) {
        const int s = p->slides[c], N = p->place[c * p->d];
        if (s < 0)
            continue;
        const double bound = p->mu[c] * x[N];
        f[s] = x[N + 1] * x[N + 1] + x[N + 2] * x[N + 2] - bound * bound;
        size[s] = x[N + 1] * x[N + 1] + x[N + 2] * x[N + 2] + bound * bound;
        for (int k = 1; k < 3; k++) {
            f[N + k] += x[s] * x[N + k];
            size[N + k] += fabs(x[s] * x[N + k]);
        }
    }
}

/* J (n x n) at x; its entries are rounded where there are slides. */
static void active_jacobian(const prover *p, const double *x, double *J)
{
    const size_t n = (size_t)p->n;
    memcpy(J, p->A, n * n * sizeof *J);
    for (int c = 0; c < p->nc; c++) {
        if (p->slides[c] < 0)
            continue;
        const size_t s = (size_t)p->slides[c], N = (size_t)p->place[c * p->d];
        for (size_t k = N + 1; k < N + 3; k++) {
            J[k + k * n] += x[s];
            J[k + s * n] = x[k];
            J[s + k * n] = 2.0 * x[k];
        }
        J[s + N * n] = -2.0 * p->mu[c] * p->mu[c] * x[N];
    }
}

/* Newton's steps to rounding; f, size: n each.  0: a singular matrix, or no numbers. */
static int refine_by_newton(prover *p, double *J, int *pivot, double *f, double *size)
{
    const int n = p->n;
    double before = INFINITY;
    for (int step = 0; step < STEPS; step++) {
        active_residual(p, p->x, f, size);
        active_jacobian(p, p->x, J);
        if (LAPACKE_dgesv_work(LAPACK_COL_MAJOR, n, 1, J, n, pivot, f, n) != 0)
            return 0;
        for (int i = 0; i < n; i++)
            p->x[i] -= f[i];
        const double moved = rb_norm_inf((size_t)n, f), largest = rb_norm_inf((size_t)n, p->x);
        if (!isfinite(largest))
            return 0;
        if (moved <= 4.0 * PROOF_U * largest || (moved >= 0.5 * before && moved < NEARLY * largest))
            break; /* rounding alone moves it */
        before = moved;
    }
    return 1;
}

/* Terms of second order of the equations in a box of half-widths h around x. */
static void second_order(const prover *p, const double *h, double *quad)
{
    memset(quad, 0, (size_t)p->n * sizeof *quad);
    for (int c = 0; c < p->nc; c++) {
        const int s = p->slides[c], N = p->place[c * p->d];
        if (s < 0)
            continue;
        for (int k = 1; k < 3; k++) {
            quad[N + k] = 2.0 * h[s] * h[N + k];
            quad[s] += 2.0 * h[N + k] * h[N + k];
        }
        quad[s] += 2.0 * (p->mu[c] * h[N]) * (p->mu[c] * h[N]);
    }
}

/* K = y + g max(rho) + |R| quad(rho) < rho: there is one zero within rho of x.  work: 4 n. */
static int krawczyk(prover *p, const proof_inverse *v, const double *f, double *work)
{
    const size_t n = (size_t)p->n;
    double *y = work, *h = y + n, *quad = h + n, *K = quad + n, *rho = p->rho;
    /* h: the residual with its rounding, in the scaled rows of the inverse; y = |R| h. */
    for (size_t i = 0; i < n; i++)
        h[i] = ldexp(f[i], v->row[i]) + PROOF_TINY;
    rb_proof_abs_product(p->n, p->n, v->R, p->n, h, y);
    /* Each turn tries 1.5 times the last K, until K lies inside what it was made from. */
    memset(rho, 0, n * sizeof *rho);
    for (int turn = 0; turn < INFLATIONS; turn++) {
        const double most = rb_norm_inf(n, rho);
        int inside = turn > 0;
        for (size_t i = 0; i < n; i++)
            h[i] = proof_up(4, ldexp(rho[i], v->column[i])) + PROOF_TINY;
        second_order(p, h, quad);
        for (size_t i = 0; i < n; i++)
            quad[i] = ldexp(proof_up(8, quad[i]), v->row[i]) + PROOF_TINY;
        rb_proof_abs_product(p->n, p->n, v->R, p->n, quad, K);
        for (size_t i = 0; i < n; i++) {
            K[i] = proof_up(n + 8, proof_up(n, y[i]) + v->g[i] * most + proof_up(n, K[i])) +
                   PROOF_TINY;
            inside &= K[i] < rho[i];
        }
        if (inside) {
            for (size_t i = 0; i < n; i++)
                rho[i] = proof_up(4, ldexp(rho[i], v->column[i])) + PROOF_TINY;
            return 1;
        }
        for (size_t i = 0; i < n; i++)
            rho[i] = 1.5 * K[i] + PROOF_TINY;
    }
    return 0;
}

/* x and rho: the zero of the active equations.  RB_UNDECIDED: proof->reason. */
static rb_status solve_active_equations(prover *p, rb_friction_proof *proof)
{
    const size_t n = (size_t)p->n;
    rb_arena scratch = {0};
    int quadratic = 0;
    double *f = rb_arena_doubles(&scratch, n, 6);
    int *pivot = rb_arena_ints(&scratch, n);
    double *J = rb_alloc(n, n);
    for (int c = 0; c < p->nc; c++)
        quadratic |= p->slides[c] >= 0;
    if (scratch.failed || !J) {
        free(J);
        return rb_arena_done(&scratch, RB_ENOMEM);
    }
    /* An approximate inverse R with a proved bound of |I - R A|: below one, A is regular. */
    proof_inverse inverse;
    proof->reason = "the matrix of the active equations is not proved to be regular";
    if (quadratic && !refine_by_newton(p, J, pivot, f, f + n)) {
        free(J);
        return rb_arena_done(&scratch, RB_UNDECIDED);
    }
    if (quadratic)
        active_jacobian(p, p->x, J);
    else
        memcpy(J, p->A, n * n * sizeof *J);
    /* the entries with x are rounded, by 4 units at most */
    rb_status s =
        rb_proof_inverse(p->n, J, quadratic ? 8.0 * PROOF_U : 0.0, &inverse) ? RB_OK : RB_ENOMEM;
    proof->norm = inverse.norm;
    if (s == RB_OK && !(inverse.norm < 0.99))
        s = RB_UNDECIDED;
    else if (s == RB_OK && !quadratic)
        rb_proof_solve(&inverse, p->b, NULL, 1, p->x, p->rho);
    else if (s == RB_OK) {
        active_residual(p, p->x, f, f + n);
        for (size_t i = 0; i < n; i++)
            f[i] = fabs(f[i]) + proof_error(n + 8, f[n + i]);
        if (!krawczyk(p, &inverse, f, f + 2 * n)) {
            proof->reason = "the box around the solution is not mapped into itself";
            s = RB_UNDECIDED;
        }
    }
    rb_proof_inverse_free(&inverse);
    return rb_arena_done(&scratch, s);
}

/* ---- Signs ---------------------------------------------------------------------------- */

static void require(rb_friction_proof *proof, double value, double error, int *holds)
{
    *holds &= value - error > 0.0;
    if (value > 0.0)
        proof->margin = fmin(proof->margin, value / fmax(error, PROOF_TINY));
}

/* 1: the row of u_i reads no reaction, and q_i = 0: it is zero exactly. */
static void find_idle(prover *p)
{
    for (int i = 0; i < p->m; i++)
        p->idle[i] = p->q[i] == 0.0;
    for (int j = 0; j < p->m; j++)
        for (int k = p->W->p[j]; p->place[j] >= 0 && k < p->W->p[j + 1]; k++)
            p->idle[p->W->i[k]] &= p->W->x[k] == 0.0;
}

/* The inequalities of all zones; where one does not hold the zone becomes another.  RB_UNDECIDED:
 * some were changed. */
static rb_status judge_signs(prover *p, rb_friction_proof *proof)
{
    const int d = p->d;
    for (int i = 0; i < p->m; i++) {
        p->r[i] = p->place[i] >= 0 ? p->x[p->place[i]] : 0.0;
        p->e[i] = p->place[i] >= 0 ? p->rho[p->place[i]] : 0.0;
    }
    rb_status s = velocities(p, p->r, p->u, p->eu, p->size);
    /* u of r within its bounds: the errors e go through |W|. */
    double *through = p->size;
    memset(through, 0, (size_t)p->m * sizeof *through);
    for (int j = 0; s == RB_OK && j < p->m; j++)
        for (int k = p->W->p[j]; p->e[j] != 0.0 && k < p->W->p[j + 1]; k++)
            through[p->W->i[k]] += fabs(p->W->x[k]) * p->e[j];
    for (int i = 0; i < p->m; i++)
        p->eu[i] = proof_up(4, p->eu[i] + proof_up((size_t)p->m, through[i]));
    find_idle(p);
    proof->margin = INFINITY;
    proof->contact = -1;
    memset(proof->zones, 0, sizeof proof->zones);
    proof->touching = 0;
    for (int c = 0; s >= 0 && c < p->nc; c++) {
        const double *r = p->r + c * d, *e = p->e + c * d, *u = p->u + c * d, *eu = p->eu + c * d;
        int normal = 1, tangential = 1;
        const int before = p->zone[c];
        proof->zones[before]++;
        if (before == SEPARATED && p->idle[c * d])
            proof->touching++;
        else if (before == SEPARATED)
            require(proof, u[0], eu[0], &normal);
        else
            require(proof, r[0], e[0], &normal);
        if (before == STICK) {
            /* |r_T| + its error against mu (r_N - its error), with the rounding of both sides. */
            double squares = 0.0;
            for (int k = 1; k < d; k++)
                squares += (fabs(r[k]) + e[k]) * (fabs(r[k]) + e[k]);
            tangential = p->mu[c] * (r[0] - e[0]) * (1.0 - 8.0 * PROOF_U) >
                         sqrt(squares) * (1.0 + 16.0 * PROOF_U) + 0x1p-500;
        } else if (before == SLIP && d == 2)
            require(proof, p->sign[c] * u[1], eu[1], &tangential);
        else if (before == SLIP)
            require(proof, p->x[p->slides[c]], p->rho[p->slides[c]], &tangential);
        if (normal && tangential)
            continue;
        /* The zone that the wrong sign points to, for the next attempt. */
        p->zone[c] = before == SEPARATED ? (p->mu[c] > 0.0 ? STICK : SMOOTH)
                     : !normal           ? SEPARATED
                     : before == STICK   ? SLIP
                                         : STICK;
        proof->reason = "a sign that is wrong, or that rounding decides";
        if (proof->contact < 0)
            proof->contact = c;
        s = RB_UNDECIDED;
    }
    return s;
}

/* eps: r, with zeros where contacts are separated, solves exactly a problem whose q, relative to
 * the terms |W| |r| + |q| of its row, and mu differ by at most eps. */
static rb_status nearby(prover *p, double *eps)
{
    const rb_status s = velocities(p, p->r, p->u, p->eu, p->size);
    *eps = 0.0;
    for (int c = 0; s == RB_OK && c < p->nc; c++) {
        const int at = c * p->d;
        const double *r = p->r + at, *u = p->u + at, bound = p->mu[c] * r[0],
                     t = rb_friction_tangential(p->d, r);
        double need[3] = {0.0}, sigma = 0.0;
        /* By how much u_N, and u_T along its direction, miss the condition of the zone. */
        need[0] = p->zone[c] == SEPARATED ? fmax(0.0, p->eu[at] - u[0]) : fabs(u[0]) + p->eu[at];
        if (p->zone[c] == SLIP ||
            (p->zone[c] == STICK && t * (1.0 + 8.0 * PROOF_U) > bound * (1.0 - 8.0 * PROOF_U)))
            *eps = fmax(*eps, fabs(t - bound) / bound + 8.0 * PROOF_U);
        for (int k = 1; p->zone[c] == SLIP && k < p->d; k++)
            sigma -= t > 0.0 ? u[k] / t * (r[k] / t) : 0.0;
        for (int k = 1; k < p->d && (p->zone[c] == STICK || p->zone[c] == SLIP); k++) {
            const double part = fmax(0.0, sigma) * r[k];
            need[k] = fabs(u[k] + part) + p->eu[at + k] + 8.0 * PROOF_U * fabs(part);
        }
        for (int k = 0; k < p->d; k++)
            if (need[k] > 0.0)
                *eps = p->size[at + k] > 0x1p-900
                           ? fmax(*eps, proof_up((size_t)p->m + 8, need[k] / p->size[at + k]))
                           : INFINITY;
    }
    return s;
}

/* ---- All together --------------------------------------------------------------------- */

/* W of the local form, or of the condensed global one. */
static rb_status take_matrix(const rb_friction_problem *given, rb_friction_problem *condensed,
                             rb_sparse *own, prover *p, rb_message *why)
{
    const rb_friction_problem *local = given;
    rb_status s = RB_OK;
    if (given->form == RB_FRICTION_GLOBAL) {
        s = rb_friction_condense(given, condensed, why);
        local = condensed;
    }
    if (s == RB_OK && local->form == RB_FRICTION_LOCAL_DENSE)
        s = rb_sparse_from_dense(p->m, p->m, local->W, p->m, own);
    p->W = local->form == RB_FRICTION_LOCAL_DENSE ? own : &local->Ws;
    p->q = local->q;
    return s;
}

/* Attempts with zones that change until all is proved, or zones come again. */
static rb_status attempt_all(prover *p, rb_friction_proof *proof)
{
    uint64_t hash[ROUNDS];
    rb_status s = RB_UNDECIDED;
    for (int round = 0; s == RB_UNDECIDED && round < ROUNDS; round++) {
        hash[round] = rb_hash(RB_HASH_START, p->zone, (size_t)p->nc * sizeof *p->zone);
        for (int k = 0; k < round; k++)
            if (hash[k] == hash[round])
                return RB_UNDECIDED;
        s = pose_equations(p);
        if (s == RB_EINVAL) {
            proof->reason = "too many unknowns for a dense matrix";
            return RB_UNDECIDED;
        }
        if (s == RB_OK)
            s = solve_active_equations(p, proof);
        if (s != RB_OK)
            return s;
        s = judge_signs(p, proof);
        if (s == RB_UNDECIDED && rb_interrupted())
            s = RB_INTERRUPTED;
    }
    return s;
}

rb_status rb_friction_prove_zones(const rb_friction_problem *problem, const double *r,
                                  rb_friction_proof *proof, rb_message *why)
{
    const int d = problem->dimension, nc = problem->contacts;
    const size_t m = (size_t)(d * nc);
    *proof = (rb_friction_proof){.contact = -1,
                                 .reason = "",
                                 .condensed = problem->form == RB_FRICTION_GLOBAL,
                                 .bound = NAN,
                                 .stored_within = NAN,
                                 .nearby = NAN,
                                 .margin = NAN,
                                 .norm = NAN};
    if (!isfinite(rb_norm_inf(m, r)))
        return rb_fail(why, RB_EINVAL, "proof: the reactions are no finite numbers");
    rb_arena scratch = {0};
    rb_friction_problem condensed = {0};
    rb_sparse own = {0};
    prover p = {.d = d, .nc = nc, .m = (int)m, .mu = problem->mu};
    int **ints[] = {&p.zone, &p.place, &p.slides, &p.idle};
    for (size_t k = 0; k < sizeof ints / sizeof *ints; k++)
        *ints[k] = rb_arena_ints(&scratch, m);
    double **doubles[] = {&p.r, &p.e, &p.u, &p.eu, &p.size, &p.sign};
    for (size_t k = 0; k < sizeof doubles / sizeof *doubles; k++)
        *doubles[k] = rb_arena_doubles(&scratch, m, 1);
    rb_status s = scratch.failed ? rb_fail(why, RB_ENOMEM, "proof: out of memory")
                                 : take_matrix(problem, &condensed, &own, &p, why);
    if (s == RB_OK)
        s = guess_zones(&p, r);
    if (s == RB_OK)
        s = nearby(&p, &proof->nearby);
    if (s == RB_OK && !rb_proof_arithmetic()) {
        proof->reason = "arithmetic does not round to nearest";
        s = RB_UNDECIDED;
    } else if (s == RB_OK)
        s = attempt_all(&p, proof);
    if (s == RB_OK) {
        /* not above the largest |r| of the solution */
        const double most =
            fmax((rb_norm_inf(m, p.r) - rb_norm_inf(m, p.e)) * (1.0 - 4.0 * PROOF_U), PROOF_TINY);
        proof->proved = 1;
        proof->reason = "";
        proof->isolated = proof->touching == 0;
        proof->bound = proof->stored_within = 0.0;
        for (size_t i = 0; i < m; i++) {
            proof->bound = fmax(proof->bound, proof_up(8, p.e[i] / most));
            proof->stored_within =
                fmax(proof->stored_within, proof_up(8, (fabs(r[i] - p.r[i]) + p.e[i]) / most));
        }
    }
    free(p.A);
    rb_sparse_free(&own);
    rb_friction_problem_free(&condensed);
    rb_arena_free(&scratch);
    return s;
}
