/* A contact that depends on the crack below it (C9): one problem for the pressures of the
 * wheel and the faces of the crack. */
#include "analysis/crack/internal.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TRIALS = 60 };
static const double LOAD_TOLERANCE = 1e-10;

/* Place of node k of the crack, N for k < n, else T, behind m elements of the wheel. */
static size_t place_of(const rb_crack_contact *both, int n, int k)
{
    return (size_t)(both->m + (k < n ? k : both->n + k - n));
}

/* Unknowns: forces h p of the n_c contact elements, then nodal forces r of the crack.
 * With C the stress on the crack of unit forces and F its flexibility, the surface of B
 * moves by -C'D (Betti), and [ F_c/h + C'F C   C'F ] [ F C             F   ] gives gaps
 * and slips of both; the contact has no friction, its tangential unknowns are there to be
 * zero. */
static rb_status assemble(const rb_crack *c, const rb_crack_wheel *w, double x,
                          rb_crack_contact *both)
{
    const int n = c->n, n2 = 2 * n, m = w->n;
    const size_t ld = 2 * (size_t)both->n;
    double *F = both->F, *C = rb_alloc((size_t)n2, (size_t)m),
           *FC = rb_alloc((size_t)n2, (size_t)m);
    rb_status s = C && FC ? RB_OK : RB_ENOMEM;

    for (int j = 0; j < m && s == RB_OK; j++) {
        const double unit = 1.0 / (w->ends[j + 1] - w->ends[j]), none = 0.0;
        const rb_bem_edge_load strip = {1, w->ends + j, &unit, &none};
        s = rb_crack_load(c, &strip, RB_CRACK_STRIPS, x, 0.0, C + (size_t)n2 * (size_t)j);
    }
    if (s == RB_OK) {
        memset(F, 0, ld * ld * sizeof *F);
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, n2, m, n2, 1.0, c->F, n2, C, n2, 0.0,
                    FC, n2);
        for (int j = 0; j < m; j++) {
            const double h = w->ends[j + 1] - w->ends[j];
            for (int i = 0; i < m; i++)
                F[i + (size_t)j * ld] = w->F[i + (size_t)j * (size_t)w->ldf] / h;
            for (int k = 0; k < n2; k++)
                F[place_of(both, n, k) + (size_t)j * ld] =
                    F[(size_t)j + place_of(both, n, k) * ld] = FC[k + (size_t)j * n2];
        }
        cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, m, m, n2, 1.0, C, n2, FC, n2, 1.0, F,
                    (int)ld);
        for (int j = 0; j < m; j++) /* the friction that is zero */
            memcpy(F + (size_t)both->n + ((size_t)both->n + j) * ld, F + (size_t)j * ld,
                   (size_t)m * sizeof *F);
        for (int l = 0; l < n2; l++)
            for (int k = 0; k < n2; k++)
                F[place_of(both, n, k) + place_of(both, n, l) * ld] = c->F[k + (size_t)l * n2];
        s = rb_crack_contact_pose(c, both);
    }
    free(C);
    free(FC);
    return s;
}

/* The approach under which the contact carries the load: by secants. */
static rb_status find_approach(const rb_crack_wheel *w, rb_crack_contact *both, rb_message *why)
{
    double before = 0.0, load_before = 0.0, at = 0.0; /* d_N are those of approach 0 */
    double next = both->warm ? both->approach : w->approach;

    for (int k = 0; k < TRIALS; k++) {
        for (int i = 0; i < w->n; i++)
            both->problem.d_N[i] -= (next - at) * both->scale[i];
        both->approach = at = next;
        const rb_status s = rb_crack_contact_solve(both, why);
        const double load = cblas_ddot(w->n, both->state.p, 1, both->scale, 1);
        if (s != RB_OK || fabs(load - w->load) <= LOAD_TOLERANCE * w->load)
            return s;
        const double slope =
            k > 0 && load != load_before ? (load - load_before) / (at - before) : 0.0;
        before = at;
        load_before = load;
        next = slope > 0.0 ? at + (w->load - load) / slope : at * (1.0 + 1e-3);
    }
    return rb_fail(why, RB_MAXITER, "the load was not found");
}

rb_status rb_crack_step_coupled(rb_crack *c, const rb_crack_wheel *w, double x, const double *T,
                                double stress, rb_crack_state *state, double *pressure,
                                rb_message *why)
{
    const int m = w->n;
    rb_crack_contact *both = &c->coupled;
    rb_status s = RB_OK;

    if (both->m != m) {
        rb_crack_contact_free(both);
        s = rb_crack_contact_alloc(c, m, both);
    }
    if (s == RB_OK)
        s = assemble(c, w, x, both);
    if (s == RB_OK) {
        const double size = stress * (w->ends[m] - w->ends[0]) / m / both->scale[m / 2];
        rb_crack_contact_load(c, T, 0.0, size, state, both);
        for (int i = 0; i < m; i++) {
            both->problem.d_N[i] += w->gap[i] * both->scale[i];
            both->problem.d_T[i] = both->problem.slip_length; /* it slides in any case */
        }
        s = find_approach(w, both, why);
    }
    if (s == RB_OK && (both->state.p[0] > 0.0 || both->state.p[m - 1] > 0.0))
        s = rb_fail(why, RB_ZONE, "the contact fills its elements: expected a wider zone");
    if (s == RB_OK)
        rb_crack_contact_read(c, both, state);
    for (int i = 0; i < m && s == RB_OK; i++)
        pressure[i] = both->state.p[i] * both->scale[i] / (w->ends[i + 1] - w->ends[i]);
    return s;
}
