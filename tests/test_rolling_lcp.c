/* The matrices of (K4), (K5) and (K6) against the equations they stand for: for any z, Mz
 * + b must be the gap, the slip, the friction margins and the missing forces of the
 * tractions that z means. */
#include "cases.h"
#include "check.h"
#include "rolling/rolling.h"

/* Dissimilar bodies, so that every block is there. */
static rb_rolling_model dissimilar_model(int load_given, int force_given)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rb_rolling_model model;
    set(&rc, "poisson 0.2 support halfplane formulation steady contact-elements 14");
    if (load_given)
        rc.half_width = 1e-2 * rc.a.radius;
    else
        rc.approach = 1e-2;
    if (force_given)
        rc.force_ratio = 0.3;
    else
        rc.creep = 1e-3;
    CHECK_OK(rb_rolling_model_create(&rc, &model, NULL));
    return model;
}

static double weighted(int n, const double *a, const double *x, const double *b, const double *y)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++)
        sum += a[i] * x[i] + b[i] * y[i];
    return sum;
}

/* Rows of a given load and a given force. */
static void check_controls(const rb_contact_problem *p, const rb_contact_lcp *lcp,
                           const rb_contact_state *s, const double *w)
{
    const int n = p->n, force = 3 * n + p->load_given;
    const double P = weighted(n, p->load_N, s->p, p->load_T, s->q);
    const double Q = weighted(n, p->force_N, s->p, p->force_T, s->q);
    const double sign = lcp->xi0 > 0.0 ? -1.0 : 1.0;

    if (p->load_given)
        CHECK_ABS(w[3 * n] * lcp->w_scale[3 * n], P - p->load, 1e-10 * p->load, "load");
    if (p->force_given)
        CHECK_ABS(w[force] * lcp->w_scale[force], sign * (p->force_ratio * p->mu * P - Q),
                  1e-10 * P, "force");
}

static void check_rows(const rb_contact_problem *p, const rb_contact_lcp *lcp, const double *z,
                       const double *w)
{
    const int n = p->n;
    const double o = lcp->mirrored ? -1.0 : 1.0;
    double *gap = rb_alloc((size_t)n, 2), *slip = gap + n;
    OWNED(rb_contact_state) s;

    CHECK_OK(rb_contact_state_alloc(n, &s));
    rb_contact_lcp_recover(p, lcp, z, &s);
    rb_contact_kinematics(p, &s, gap, slip);
    for (int i = 0; i < n; i++) {
        const double plus = p->mu * s.p[i] + s.q[i], minus = p->mu * s.p[i] - s.q[i];
        CHECK_ABS(w[i] * lcp->w_scale[i], gap[i], 1e-9 * p->gap_length, "gap %d", i);
        if (lcp->form == RB_LCP_PIVOTED) {
            const double nu = z[2 * n + i] * lcp->z_scale[2 * n + i];
            CHECK_ABS(w[n + i] * lcp->w_scale[n + i], o * slip[i] + nu, 1e-9 * p->slip_length,
                      "slip %d", i);
            CHECK_ABS(w[2 * n + i] * lcp->w_scale[2 * n + i], o > 0 ? minus : plus,
                      1e-10 * p->stress, "margin %d", i);
            CHECK_ABS(z[n + i] * lcp->z_scale[n + i], o > 0 ? plus : minus, 1e-10 * p->stress,
                      "other margin %d", i);
        } else {
            const int k = n + 2 * i;
            CHECK_ABS(p->slip_length * (z[k] - z[k + 1]), slip[i], 1e-8 * p->slip_length, "slip %d",
                      i);
            CHECK_ABS(w[k] * lcp->w_scale[k], plus, 1e-9 * p->stress, "margin + %d", i);
            CHECK_ABS(w[k + 1] * lcp->w_scale[k + 1], minus, 1e-9 * p->stress, "margin - %d", i);
        }
    }
    check_controls(p, lcp, &s, w);
    free(gap);
}

static void check_form(const rb_rolling_model *model, rb_contact_lcp_form form, int mirrored)
{
    OWNED(rb_contact_lcp) lcp;
    CHECK_OK(rb_contact_lcp_create(&model->problem, form, mirrored, mirrored ? 1e-3 : -1e-3, &lcp,
                                   NULL));
    double *z = rb_alloc((size_t)lcp.size, 2), *w = z + lcp.size;
    for (int i = 0; i < lcp.size; i++)
        z[i] = rand() / (double)RAND_MAX;
    rb_lcp_residual(&(rb_lcp_problem){lcp.size, lcp.M, lcp.size, lcp.b}, z, w);
    check_rows(&model->problem, &lcp, z, w);
    free(z);
}

TEST(every_row_is_its_equation)
{
    srand(8);
    for (int control = 0; control < 4; control++) {
        OWNED(rb_rolling_model) model = dissimilar_model(control & 1, control & 2);
        check_form(&model, RB_LCP_PIVOTED, 0);
        check_form(&model, RB_LCP_PIVOTED, 1);
        check_form(&model, RB_LCP_KWAK, 0);
    }
}

/* The order of attempts is for hard cases: the first one solves these. */
TEST(lemke_needs_its_first_attempt_only)
{
    for (int control = 0; control < 4; control++) {
        OWNED(rb_rolling_model) model = dissimilar_model(control & 1, control & 2);
        assert_int_equal(model.state.solver, RB_SOLVER_LEMKE);
        assert_int_equal(model.state.lcp_form, RB_LCP_PIVOTED);
    }
}

static void keep_attempt(const rb_lcp_pivot *pivot, void *context)
{
    *(int *)context = pivot->attempt;
}

/* The trace says which form of the problem a pivot belongs to. */
TEST(pivots_tell_their_attempt)
{
    for (int kwak = 0; kwak < 2; kwak++) {
        OWNED(rb_rolling_model) model = dissimilar_model(0, 0);
        rb_rolling_case rc = *model.rc;
        int attempt = -1;
        set(&rc, "solver lemke lcp-form %s", kwak ? "kwak" : "pivoted");
        model.problem.pivot_trace = keep_attempt;
        model.problem.trace_context = &attempt;
        CHECK_OK(rb_rolling_problem_solve(&model.problem, &rc, 0, &model.state, NULL));
        assert_int_equal(attempt, kwak ? 2 : 0);
    }
}

RUN_TESTS(NULL, NULL)
