/* A contact that depends on the crack below it (C9): one problem for the pressures of the
 * wheel and the faces of the crack. */
#include "crack/internal.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TRIALS = 60 };
static const double LOAD_TOLERANCE = 1e-10;

/* Unknowns: forces h p of the n_c contact elements, then nodal forces r of the crack.
 * With C the stress on the crack of unit forces and F its flexibility, the surface of B
 * moves by -C'D (Betti), and [ F_c/h + C'F C   C'F ] [ F C             F   ] gives gaps
 * and slips of both; the contact has no friction, its tangential unknowns are there to be
 * zero. */
static rb_status assemble(const rb_crack *c, const rb_crack_wheel *w, double x,
                          double *scale, double *matrix)
{
    const int n = c->n, m = w->n, all = m + n;
    const size_t ld = 2 * (size_t)all;
    double *C = rb_alloc(2 * (size_t)n, (size_t)m),
           *FC = rb_alloc(2 * (size_t)n, (size_t)m),
           *CFC = rb_alloc((size_t)m, (size_t)m);
    rb_status s = C && FC && CFC ? RB_OK : RB_ENOMEM;

    for (int j = 0; j < m && s == RB_OK; j++) {
        const double unit = 1.0 / (w->ends[j + 1] - w->ends[j]), none = 0.0;
        const rb_bem_edge_load strip = {1, w->ends + j, &unit, &none};
        s = rb_crack_load(c, &strip, x, 0.0, C + 2 * (size_t)n * (size_t)j);
    }
    if (s == RB_OK) {
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, 2 * n, m, 2 * n, 1.0, c->F,
                    2 * n, C, 2 * n, 0.0, FC, 2 * n);
        cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, m, m, 2 * n, 1.0, C, 2 * n,
                    FC, 2 * n, 0.0, CFC, m);
        for (int j = 0; j < m; j++) {
            double *pressure = matrix + (size_t)j * ld,
                   *friction = pressure + (size_t)all * ld;
            const double h = w->ends[j + 1] - w->ends[j];
            for (int i = 0; i < m; i++)
                pressure[i] =
                    w->F[i + (size_t)j * (size_t)w->ldf] / h + CFC[i + (size_t)j * m];
            friction[all + j] = pressure[j];
            for (int k = 0; k < 2 * n; k++) { /* node k, N and T, and its mirror entry */
                const size_t at = (size_t)(m + k % n + (k < n ? 0 : all));
                pressure[at] = FC[k + (size_t)j * 2 * n];
                matrix[(size_t)j + at * ld] = FC[k + (size_t)j * 2 * n];
            }
        }
        for (int l = 0; l < 2 * n; l++)
            for (int k = 0; k < 2 * n; k++)
                matrix[(size_t)(m + k % n + (k < n ? 0 : all)) +
                       (size_t)(m + l % n + (l < n ? 0 : all)) * ld] =
                    c->F[k + (size_t)l * 2 * n];
        for (int i = 0; i < all; i++)
            scale[i] = 1.0 / sqrt(matrix[i + (size_t)i * ld]);
        for (size_t j = 0; j < ld; j++)
            for (size_t i = 0; i < ld; i++)
                matrix[i + j * ld] *= scale[i % (size_t)all] * scale[j % (size_t)all];
    }
    free(C);
    free(FC);
    free(CFC);
    return s;
}

/* The contact problem of the step but for the approach. */
static rb_status pose(rb_crack *c, const rb_crack_wheel *w, const double *T,
                      double stress, const rb_crack_state *before, const double *scale,
                      double *matrix, rb_contact_problem *p)
{
    const int n = c->n, m = w->n, all = m + n;
    double *S = rb_alloc((size_t)all, 2 * (size_t)all), *r = rb_alloc(3, (size_t)all);
    rb_contact_operator *op = NULL;
    rb_status s = RB_ENOMEM;

    memset(p, 0, sizeof *p);
    if (S && r) {
        for (int j = 0; j < 2 * all; j++)
            memcpy(S + (size_t)j * all, matrix + all + (size_t)j * 2 * all,
                   (size_t)all * sizeof *S);
        s = rb_contact_operator_dense(all, matrix, 2 * all, S, &op);
        S = NULL; /* taken over */
    }
    if (s == RB_OK)
        s = rb_contact_problem_alloc(op, p);
    if (s == RB_OK) {
        for (int j = 0; j < n; j++) {
            r[m + j] = T[j] / scale[m + j];
            r[all + m + j] = T[n + j] / scale[m + j];
            r[2 * all + m + j] = c->shape.friction;
        }
        rb_contact_set_friction(p, c->shape.friction, r + 2 * all);
        p->stress = stress;
        p->gap_length = stress;
        p->slip_length = stress * (p->mu > 0.0 ? p->mu : 1.0);
        for (int i = 0; i < m; i++) {
            p->d_N[i] = w->gap[i] * scale[i];
            p->d_T[i] = p->slip_length; /* it slides, whatever the unknowns */
        }
        for (int j = 0; j < n; j++)
            p->d_T[m + j] = -before->D[n + j] * scale[m + j];
        rb_contact_operator_add(op, r, r + all, p->d_N, p->d_T);
    }
    free(S);
    free(r);
    return s;
}

/* The approach under which the contact carries the load: by secants. */
static rb_status find_approach(rb_crack *c, const rb_crack_wheel *w, const double *scale,
                               rb_contact_problem *p, rb_message *why)
{
    const rb_contact_options options = {
        .solver = RB_SOLVER_AUTO, .lcp_form = RB_LCP_PIVOTED, .tol = RB_CRACK_TOLERANCE};
    double before = 0.0, load_before = 0.0,
           at = 0.0; /* p's d_N are those of approach 0 */
    double next = c->warm ? c->approach : w->approach;
    rb_status s = RB_OK;

    for (int k = 0; k < TRIALS && s == RB_OK; k++) {
        for (int i = 0; i < w->n; i++)
            p->d_N[i] -= (next - at) * scale[i];
        at = next;
        s = rb_contact_solve(p, &options, c->warm, &c->wheel, why);
        c->warm = s == RB_OK;
        double load = 0.0;
        for (int i = 0; i < w->n; i++)
            load += c->wheel.p[i] * scale[i];
        c->approach = at;
        if (s != RB_OK || fabs(load - w->load) <= LOAD_TOLERANCE * w->load)
            return s;
        const double slope =
            k > 0 && load != load_before ? (load - load_before) / (at - before) : 0.0;
        before = at;
        load_before = load;
        next = slope > 0.0 ? at + (w->load - load) / slope : at * (1.0 + 1e-3);
    }
    return s == RB_OK ? rb_fail(why, RB_MAXITER, "the load was not found") : s;
}

rb_status rb_crack_step_coupled(rb_crack *c, const rb_crack_wheel *w, double x,
                                const double *T, double stress, rb_crack_state *state,
                                double *max_pressure, rb_message *why)
{
    const int m = w->n, all = m + c->n;
    double *scale = rb_alloc(3, (size_t)all);
    double *matrix = rb_alloc(2 * (size_t)all, 2 * (size_t)all);
    rb_contact_problem p = {0};
    rb_status s = scale && matrix ? RB_OK : RB_ENOMEM;

    if (s == RB_OK && c->wheel.n != all) {
        rb_contact_state_free(&c->wheel);
        s = rb_contact_state_alloc(all, &c->wheel);
        c->warm = 0;
    }
    if (s == RB_OK)
        s = assemble(c, w, x, scale, matrix);
    if (s == RB_OK)
        s = pose(c, w, T, stress * (w->ends[m] - w->ends[0]) / m / scale[m / 2], state,
                 scale, matrix, &p);
    if (s == RB_OK)
        s = find_approach(c, w, scale, &p, why);
    if (s == RB_OK && (c->wheel.p[0] > 0.0 || c->wheel.p[m - 1] > 0.0))
        s = rb_fail(why, RB_ZONE,
                    "the contact fills its elements: expected a wider zone");
    if (s == RB_OK) {
        double *gap = scale + all, *slip = gap + all;
        rb_contact_kinematics(&p, &c->wheel, gap, slip);
        rb_crack_read_state(c, gap, slip, scale, &c->wheel, m, state);
        *max_pressure = 0.0;
        for (int i = 0; i < m; i++)
            *max_pressure = fmax(*max_pressure, c->wheel.p[i] * scale[i] /
                                                    (w->ends[i + 1] - w->ends[i]));
    }
    rb_contact_problem_free(&p);
    free(scale);
    free(matrix);
    return s;
}
