/* A proof that a problem has no solution: no reactions of any size prevent penetration at
 * all contacts. */
#include "lcp/friction/internal.h"
#include "lcp/proof/absent.h"
#include "lcp/proof/bounds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Steps of the search at most, operations at most, and the relative change at which it
 * has ended. */
enum { STEPS = 5000 };
static const double OPERATIONS = 2e9, SMALL = 1e-15;

/* A solution needs r in K with u_N = (W r + q)_N >= 0.  With forces in units of velocity,
 * r = x / W_NN, and A = (W / W_NN)_N, the least of |min(0, A x + q_N)|^2 over x in K is
 * positive where there is none, and y = -min(0, A x + q_N) >= 0 then proves it: -A'y is
 * in K*, so that y'(A x + q_N) <= y'q_N = -|y|^2 < 0 for every x in K (a theorem of the
 * alternative). */
typedef struct {
    const rb_friction_problem *local;
    rb_friction_blocks blocks;
    double *rho;                /* 2 per contact: the first is 1/W_NN */
    double *x, *z, *before, *w; /* m each: iterate, extrapolated, last one, velocity */
    double *gradient;           /* m */
    double length;              /* of a gradient step */
} search;

/* gradient = -A'y: block (c, e) of W takes the forces of e to the velocities of c. */
static void transposed(search *s, const double *y)
{
    const rb_friction_blocks *b = &s->blocks;
    const int d = b->d;
    for (int e = 0; e < b->contacts; e++) {
        double *g = s->gradient + e * d;
        memset(g, 0, (size_t)d * sizeof *g);
        for (int k = b->p[e]; k < b->p[e + 1]; k++)
            for (int a = 0; a < d; a++)
                g[a] -= s->rho[2 * e] * y[b->i[k]] *
                        b->x[(size_t)k * (size_t)(d * d) + (size_t)(a * d)];
    }
}

/* The sum of the moduli of the terms of its entries of one contact. */
static double moduli(const search *s, int contact, const double *y)
{
    const rb_friction_blocks *b = &s->blocks;
    const size_t size = (size_t)(b->d * b->d);
    double sum = 0.0;
    for (int k = b->p[contact]; k < b->p[contact + 1]; k++)
        for (int a = 0; a < b->d; a++)
            sum += fabs(s->rho[2 * contact] * y[b->i[k]] *
                        b->x[(size_t)k * size + (size_t)(a * b->d)]);
    return sum;
}

/* 1 / |A|^2 by the power method, a little shorter to be safe; 0: A is zero. */
static double step_length(search *s, double *y)
{
    const size_t n = (size_t)s->local->contacts;
    double most = 0.0;
    for (size_t c = 0; c < n; c++)
        y[c] = 1.0 + 0.1 * (double)(c % 7);
    for (int k = 0; k < 30; k++) {
        const double size = rb_friction_norm(n, y);
        if (!(size > 0.0))
            return 0.0;
        for (size_t c = 0; c < n; c++)
            y[c] /= size;
        transposed(s, y);
        most = 0.0;
        for (int i = 0; i < s->blocks.d * (int)n; i++)
            most += s->gradient[i] * s->gradient[i];
        for (int i = 0; i < s->blocks.d * (int)n; i++)
            s->z[i] = s->rho[2 * (i / s->blocks.d)] * s->gradient[i];
        rb_friction_blocks_apply(&s->blocks, s->z, s->w);
        for (size_t c = 0; c < n; c++)
            y[c] = s->w[c * (size_t)s->blocks.d];
    }
    return most > 0.0 ? 0.8 / most : 0.0;
}

double rb_friction_descend(rb_friction_descent *s, double value)
{
    const int d = s->p->dimension, nc = s->p->contacts, grows = value > s->last;
    const double next = 0.5 * (1.0 + sqrt(1.0 + 4.0 * s->t * s->t));
    double change = 0.0, size = 0.0;
    for (int c = 0; c < nc; c++) {
        double *x = s->x + c * d;
        for (int a = 0; a < d; a++)
            x[a] = s->ahead[c * d + a] - s->length * s->gradient[c * d + a];
        rb_friction_project(d, s->wider * s->p->mu[c], x, x);
    }
    for (int i = 0; i < d * nc; i++) {
        const double step = s->x[i] - s->before[i];
        change = fmax(change, fabs(s->x[i] - s->ahead[i]));
        size = fmax(size, fabs(s->x[i]));
        s->ahead[i] = s->x[i] + (grows ? 0.0 : (s->t - 1.0) / next * step);
        s->before[i] = s->x[i];
    }
    s->t = grows ? 1.0 : next;
    s->last = value;
    return change == 0.0 ? 0.0 : change / size;
}

rb_status rb_friction_infeasible(const rb_friction_problem *local, double *y, double *least)
{
    const size_t m = (size_t)(local->dimension * local->contacts);
    search s = {.local = local};
    *least = 0.0;
    if (local->form == RB_FRICTION_GLOBAL)
        return RB_EINVAL;
    rb_status st = rb_friction_blocks_init(local, &s.blocks);
    s.x = rb_alloc(m, 5);
    s.rho = rb_alloc(2 * (size_t)local->contacts, 1);
    if (st == RB_OK)
        st = s.x && s.rho ? rb_friction_rho(local, s.rho) : RB_ENOMEM;
    if (st == RB_OK) {
        s.z = s.x + m;
        s.before = s.z + m;
        s.w = s.before + m;
        s.gradient = s.w + m;
        s.length = step_length(&s, y);
        memset(s.z, 0, m * sizeof *s.z);
        const int d = local->dimension, nc = local->contacts;
        const double work = 4.0 * s.blocks.p[nc] * d * d;
        rb_friction_descent descent = {.p = local,
                                       .wider = 1.0,
                                       .length = s.length,
                                       .x = s.x,
                                       .ahead = s.z,
                                       .before = s.before,
                                       .gradient = s.gradient,
                                       .t = 1.0,
                                       .last = INFINITY};
        for (int k = 0; k < STEPS && k * work < OPERATIONS; k++) {
            /* y and half of |y|^2 at x. */
            double value = 0.0;
            for (int c = 0; c < nc; c++)
                for (int a = 0; a < d; a++)
                    s.gradient[c * d + a] = s.rho[2 * c] * s.z[c * d + a];
            rb_friction_blocks_apply(&s.blocks, s.gradient, s.w);
            for (int c = 0; c < nc; c++) {
                y[c] = fmax(0.0, -(s.w[c * d] + local->q[c * d]));
                value += 0.5 * y[c] * y[c];
            }
            transposed(&s, y);
            if (rb_friction_descend(&descent, value) <= SMALL || value == 0.0)
                break;
        }
        /* What any solution must have of sum W_NN r_N, proved by y: -A'y misses K* by at
         * most `miss`, so that 0 <= y'(A x + q_N) <= y'q_N + miss sum x_N.  0: y proves
         * nothing. */
        double load = 0.0, terms = 0.0, miss = 0.0;
        transposed(&s, y);
        for (int c = 0; c < nc; c++) {
            const double *h = s.gradient + c * d;
            const double noise =
                proof_error((size_t)nc + 16, (1.0 + local->mu[c]) * moduli(&s, c, y));
            load += y[c] * local->q[c * d];
            terms += fabs(y[c] * local->q[c * d]);
            miss = fmax(miss, local->mu[c] * rb_friction_tangential(d, h) - h[0] + noise);
        }
        load += proof_error((size_t)nc + 4, terms);
        if (!(load < 0.0))
            *least = 0.0;
        else
            *least = miss > 0.0 ? -load / miss * (1.0 - 8.0 * PROOF_U) : INFINITY;
    }
    rb_friction_blocks_free(&s.blocks);
    free(s.x);
    free(s.rho);
    return st;
}

/* ---- Whether it is one without rounding --------------------------------------------- */

/* The sign of y' of the column `row` of W_N, the rows of the normal velocities (global:
 * of the row of H'_N): a and b have room for the entries; *size: the sum of their
 * moduli. */
static int sign_of_column(const rb_friction_problem *p, const double *y, int row, double *a,
                          double *b, double *value, double *size)
{
    const int d = p->dimension, nc = p->contacts;
    int count = 0;
    *value = *size = 0.0;
    if (p->form == RB_FRICTION_LOCAL_SPARSE) {
        for (int k = p->Ws.p[row]; k < p->Ws.p[row + 1]; k++)
            if (p->Ws.i[k] % d == 0) {
                a[count] = p->Ws.x[k];
                b[count++] = y[p->Ws.i[k] / d];
            }
    } else
        for (int c = 0; c < nc; c++) {
            a[count] = p->W[(size_t)(c * d) + (size_t)row * (size_t)(d * nc)];
            b[count++] = y[c];
        }
    for (int k = 0; k < count; k++) {
        *value += a[k] * b[k];
        *size += fabs(a[k] * b[k]);
    }
    return rb_exact_sign((size_t)count, a, b);
}

/* 1: y >= 0 proves that the problem as it is given has no solution.  Local form: -W_N'y in
 * K* and y'q_N < 0; global form: H_N y = 0 and y'w_N < 0.  Sums that are zero have no
 * rounding; others count where they are beyond it. */
static int proves(const rb_friction_problem *p, const double *y)
{
    const int d = p->dimension, nc = p->contacts, global = p->form == RB_FRICTION_GLOBAL;
    rb_sparse rows = {0}; /* H': a column per degree of freedom */
    double *a = rb_alloc((size_t)nc, 2), *b = a + nc;
    int yes = a && (!global || rb_sparse_transpose(&p->H, &rows) == RB_OK);
    for (int i = 0; yes && global && i < p->dofs; i++) {
        int count = 0;
        for (int k = rows.p[i]; k < rows.p[i + 1]; k++)
            if (rows.i[k] % d == 0) {
                a[count] = rows.x[k];
                b[count++] = y[rows.i[k] / d];
            }
        yes = rb_exact_sign((size_t)count, a, b) == 0;
    }
    for (int c = 0; yes && !global && c < nc; c++) {
        double h[3] = {0.0}, size, sum = 0.0;
        int zero = 1;
        for (int k = d - 1; k >= 0; k--) {
            const int sign = sign_of_column(p, y, c * d + k, a, b, &h[k], &size);
            sum += size;
            zero &= k == 0 ? sign == 0 || sign == -1 : sign == 0 || p->mu[c] == 0.0;
        }
        const double rounding = proof_error((size_t)nc + 16, (1.0 + p->mu[c]) * sum);
        yes = zero || -h[0] - p->mu[c] * rb_friction_tangential(d, h) > rounding;
    }
    for (int c = 0; yes && c < nc; c++) {
        a[c] = (global ? p->w : p->q)[c * d];
        b[c] = y[c];
    }
    yes = yes && rb_exact_sign((size_t)nc, a, b) == -1;
    rb_sparse_free(&rows);
    free(a);
    return yes;
}

/* The same of y as the search has left it, and of the multiples of it that are nearly whole
 * numbers: walls and stacks that cannot all hold leave sums of the same few normals. */
static int proves_nearly(const rb_friction_problem *p, const double *unit, const double *y,
                         double *rounded)
{
    for (int by = 0; by <= PROOF_MULTIPLES; by++) {
        if (!rb_proof_nearly_whole((size_t)p->contacts, y, by, rounded))
            continue;
        for (int c = 0; unit && c < p->contacts; c++)
            rounded[c] *= unit[c];
        if (proves(p, rounded))
            return 1;
    }
    return 0;
}

int rb_friction_has_no_solution(const rb_friction_problem *problem, double *least, double *given)
{
    const int global = problem->form == RB_FRICTION_GLOBAL;
    rb_friction_scaling scaling;
    double *y = rb_alloc((size_t)problem->contacts, 2);
    rb_status s = rb_friction_scaling_init(problem, &scaling);
    int yes = 0;

    *least = *given = 0.0;
    s = y ? s : RB_ENOMEM;
    /* As it is given, and with contacts in units of their own. */
    for (int own = 0; s == RB_OK && !yes && own < (scaling.unit ? 2 : 1); own++) {
        rb_friction_problem condensed = {0};
        const rb_friction_problem *p = own ? &scaling.problem : problem;
        const rb_friction_problem *local = global ? &condensed : p;
        double bound = 0.0;
        if (global)
            s = rb_friction_condense(p, &condensed, NULL);
        if (s == RB_OK)
            s = rb_friction_infeasible(local, y, &bound);
        for (int i = 0; s == RB_OK && !own && i < p->dimension * p->contacts; i++)
            *given += fabs(local->q[i]);
        if (!own)
            *least = bound;
        /* u = D u of the problem with units of its own: y'u = (D y)'u. */
        yes = s == RB_OK &&
              proves_nearly(problem, own ? scaling.unit : NULL, y, y + problem->contacts);
        rb_friction_problem_free(&condensed);
    }
    rb_friction_scaling_free(&scaling);
    free(y);
    return yes;
}
