/* Rolling friction: per contact [N, T1, T2, M1, M2] with ||r_T|| <= mu r_N and a moment
 * ||m|| <= mu_r r_N; slip opposes r_T, the relative rate of turn opposes m.  The cone is
 * the intersection of two, and each rolling contact becomes two contacts that share u_N:
 *     A: (a, r_T),     velocity (u_N / 2 + xi, u_T);
 *     B: (b, m / L),   velocity (u_N / 2 - xi, L omega),
 * with one more motion xi of stiffness k, k xi = a - b.  This is the same problem
 * whatever k > 0 is.  Where both press, both velocities are 0, so that xi = 0 and a = b =
 * r_N.  Where both are open, a = b = 0 and xi = 0.  Where A alone pressed, xi = -u_N / 2
 * <= 0 but k xi = a > 0, and likewise for B.  L, a length, brings moments to forces: that
 * of equal compliance.  k makes W_AB vanish, about. */
#include "lcp/friction/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const rb_friction_problem *p;
    const double *diagonal; /* dofs: of K */
    rb_triplets H, K;
} splitter;

/* sum of h^2 / K_ii over `count` columns of H, which is about a compliance */
static double compliance(const splitter *s, int column, int count)
{
    const rb_sparse *h = &s->p->H;
    double sum = 0.0;
    for (int k = h->p[column]; k < h->p[column + count]; k++)
        if (s->diagonal[h->i[k]] > 0.0)
            sum += h->x[k] * h->x[k] / s->diagonal[h->i[k]];
    return sum;
}

static void put_column(splitter *s, int from, int to, double factor)
{
    const rb_sparse *h = &s->p->H;
    for (int k = h->p[from]; k < h->p[from + 1]; k++)
        rb_triplets_add(&s->H, h->i[k], to, factor * h->x[k]);
}

rb_status rb_friction_split_rolling(rb_friction_problem *problem, const double *mu_r,
                                    rb_message *why)
{
    rb_friction_problem *p = problem;
    if (p->form != RB_FRICTION_GLOBAL || p->dimension != 5 || p->contacts < 1 ||
        p->H.cols != 5 * p->contacts || p->H.rows != p->dofs || p->K.cols != p->dofs)
        return rb_fail(why, RB_EINVAL,
                       "rolling friction: expected the global form with five columns of H "
                       "per contact");
    for (int c = 0; c < p->contacts; c++)
        if (!(mu_r[c] >= 0.0 && isfinite(mu_r[c])))
            return rb_fail(why, RB_EINVAL, "mu_r of contact %d is %g: expected >= 0", c + 1,
                           mu_r[c]);
    const size_t nc = (size_t)p->contacts, n = (size_t)p->dofs;
    double *diagonal = rb_alloc(n, 1);
    rb_friction_problem out = {.form = RB_FRICTION_GLOBAL,
                               .dimension = 3,
                               .contacts = 2 * p->contacts,
                               .dofs = p->dofs + p->contacts,
                               .mu = rb_alloc(nc, 2),
                               .w = rb_alloc(nc, 6),
                               .f = rb_alloc(n + nc, 1),
                               .lengths = rb_alloc(nc, 1)};
    splitter s = {.p = p,
                  .diagonal = diagonal,
                  .H = {.rows = out.dofs, .cols = 3 * out.contacts},
                  .K = {.rows = out.dofs, .cols = out.dofs}};
    rb_status st = diagonal && out.mu && out.w && out.f && out.lengths ? RB_OK : RB_ENOMEM;
    if (st == RB_OK) {
        rb_triplets_add_matrix(&s.K, 1.0, &p->K);
        for (int j = 0; j < p->dofs; j++)
            diagonal[j] = rb_sparse_diagonal(&p->K, j);
        memcpy(out.f, p->f, n * sizeof *out.f);
    }
    /* Columns, velocities and coefficients of contact c as those of A and B. */
    for (int c = 0; st == RB_OK && c < p->contacts; c++) {
        const double of_slip = compliance(&s, 5 * c + 1, 2);
        const double of_turn = compliance(&s, 5 * c + 3, 2), normal = compliance(&s, 5 * c, 1);
        const double length = of_slip > 0.0 && of_turn > 0.0 ? sqrt(of_slip / of_turn) : 1.0;
        const int xi = p->dofs + c;
        rb_triplets_add(&s.K, xi, xi, normal > 0.0 ? 4.0 / normal : 1.0);
        for (int k = 0; k < 2; k++) {
            put_column(&s, 5 * c, 6 * c + 3 * k, 0.5);
            rb_triplets_add(&s.H, xi, 6 * c + 3 * k, k ? -1.0 : 1.0);
            out.w[6 * c + 3 * k] = 0.5 * p->w[5 * c];
        }
        for (int a = 1; a < 3; a++) {
            put_column(&s, 5 * c + a, 6 * c + a, 1.0);
            put_column(&s, 5 * c + a + 2, 6 * c + a + 3, length);
            out.w[6 * c + a] = p->w[5 * c + a];
            out.w[6 * c + a + 3] = length * p->w[5 * c + a + 2];
        }
        out.mu[2 * c] = p->mu[c];
        out.mu[2 * c + 1] = mu_r[c] / length;
        out.lengths[c] = length;
    }
    if (st == RB_OK)
        st = rb_sparse_from_triplets(&s.H, &out.H);
    if (st == RB_OK)
        st = rb_sparse_from_triplets(&s.K, &out.K);
    rb_triplets_free(&s.K);
    rb_triplets_free(&s.H);
    free(diagonal);
    if (st == RB_OK)
        st = rb_friction_problem_check(&out, why);
    if (st != RB_OK) {
        rb_friction_problem_free(&out);
        return st;
    }
    rb_friction_problem_free(p);
    *p = out;
    return RB_OK;
}

void rb_friction_unite_rolling(const rb_friction_problem *problem, const double *r, const double *u,
                               double *force, double *velocity)
{
    for (int c = 0; c < problem->contacts / 2; c++, force += 5, velocity += 5) {
        const double length = problem->lengths[c];
        const double *a = r + 6 * c, *b = a + 3, *ua = u + 6 * c, *ub = ua + 3;
        const double f[5] = {0.5 * (a[0] + b[0]), a[1], a[2], length * b[1], length * b[2]};
        const double v[5] = {ua[0] + ub[0], ua[1], ua[2], ub[1] / length, ub[2] / length};
        memcpy(force, f, sizeof f);
        memcpy(velocity, v, sizeof v);
    }
}
