/* The formulation of a case as a contact problem (theory.md 4.2): the kinematic operator
 * A, the motion of the surfaces, the given quantities.  The solvers are the same for all
 * formulations. */
#include "rolling/body/former_place.h"
#include "rolling/case/internal.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/kinematic.h"
#include "rolling/solve/model.h"
#include "rolling/solve/zone.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- The kinematic operator A ------------------------------------------------------ */

/* The member t of the family of second-order differences whose leading edge is not
 * shifted (theory-rolling.md 4.7): ((1-t)/4, (3+3t)/4, -(5+3t)/4, (1+t)/4).  The local part of
 * F_TT takes another member of the family: t = 1, whose leading edge is not shifted there
 * (theory-rolling.md 4.10). */
static rb_status set_kinematic(const rb_rolling_case *rc, const rb_rolling_bodies *bodies,
                               rb_rolling_kinematic *A)
{
    static const double backward[4] = {0.0, 1.5, -2.0, 0.5};
    const double t = 0.0740956;

    /* At rest and in a step A = I; rolling steadily I - S, the value of one element upstream. */
    *A = (rb_rolling_kinematic){.n = bodies->f.n, .differences = rc->formulation == RB_STEADY};
    if (!A->differences || rc->slip_operator == RB_SLIP_UPSTREAM) {
        A->stencil[1] = 1.0;
        A->stencil[2] = A->differences ? -1.0 : 0.0;
        memcpy(A->local, A->stencil, sizeof A->local);
        return RB_OK;
    }
    /* Second order needs the displacements just outside of the contact, too. */
    A->stencil[0] = (1.0 - t) / 4.0;
    A->stencil[1] = (3.0 + 3.0 * t) / 4.0;
    A->stencil[2] = -(5.0 + 3.0 * t) / 4.0;
    A->stencil[3] = (1.0 + t) / 4.0;
    memcpy(A->local, backward, sizeof A->local);
    A->outside = rb_alloc(2, 2 * (size_t)A->n);
    return A->outside ? rb_rolling_displacement_outside(rc, bodies, A->outside) : RB_ENOMEM;
}

/* ---- F and S = A [F_TN F_TT], as the solvers need them ------------------------------- */

/* The matrix, with the products at its side where these solve sooner.  F has 2 m rows, m = n + 1:
 * w_N and w_T of the n elements and of one more upstream, from which the material comes (4.2). */
static rb_status make_operator(const rb_rolling_case *rc, const rb_rolling_bodies *bodies,
                               rb_rolling_kinematic *A, rb_contact_operator **op)
{
    rb_contact_operator *products = NULL;

    if (!bodies->F)
        return rb_rolling_transform_operator(&bodies->f, rc->interlayer_tangential, A, op);
    /* S = A [F_TN F_TT] (K2). */
    const int n = A->n, m = n + 1;
    const double none[2] = {0.0, 0.0};
    double *S = rb_alloc((size_t)n, 2 * (size_t)n);

    if (!S)
        return RB_ENOMEM;
    for (int j = 0; j < 2 * n; j++) {
        const double *w_T = bodies->F + (size_t)j * 2 * (size_t)m + m;
        const double *outside = A->outside ? A->outside + 2 * (size_t)j : none;
        for (int i = 0; i < n; i++)
            S[i + (size_t)j * n] = rb_rolling_kinematic_row(A, w_T, outside, i);
    }
    /* S has A on all of F_TT so far; the interlayer's compliance, which is local, takes the other
     * differences. */
    for (int i = 0; i < n && A->outside; i++)
        for (int k = 0; k < 4; k++) {
            const int j = i - 1 + k;
            if (j >= 0 && j < n)
                S[i + (size_t)(n + j) * (size_t)n] +=
                    rc->interlayer_tangential * (A->local[k] - A->stencil[k]);
        }
    rb_status s = rb_contact_operator_dense(n, bodies->F, 2 * m, S, op);
    /* another matrix than that of the bodies, as of a worn surface, has no products */
    if (s == RB_OK && bodies->transforms.n > 0 &&
        bodies->F == rb_bem_flexibility_stored(&bodies->f)) {
        s = rb_rolling_transform_operator(&bodies->transforms, rc->interlayer_tangential, A,
                                          &products);
        if (s == RB_OK)
            rb_contact_operator_add_products(*op, products);
    }
    return s;
}

/* ---- Gaps and slips without tractions ------------------------------------------------------- */

/* d_T and e_T of (K2): what the slips are without tractions and motion, and per unit of xi, by the
 * formulation (4.2); and the yield stress of what has yielded before (Y1). */
void rb_rolling_set_past(const rb_rolling_case *rc, const rb_rolling_bodies *bodies,
                         const rb_rolling_past *past, rb_contact_problem *p)
{
    const int n = p->n, m = n + 1;
    const double *x = bodies->f.x, *w0_T = bodies->f.w0 + m;
    const double strain = rb_rolling_is_strained(rc) ? rb_rolling_bulk_strain(rc) : 0.0;

    for (int i = 0; i < n; i++) {
        p->d_T[i] = p->differences ? w0_T[i] - w0_T[i + 1] : w0_T[i];
        if (strain != 0.0) /* (U1) */
            p->d_T[i] += strain * (p->differences ? x[i] - x[i + 1] : x[i]);
        if (past)
            p->d_T[i] -= past->w_T[i];
        if (p->yield)
            p->yield[i] =
                rc->yield_stress + rc->hardening * (past && past->yielded ? past->yielded[i] : 0.0);
        p->e_T[i] = rc->formulation == RB_STEADY      ? x[i + 1] - x[i]
                    : rc->formulation == RB_TRANSIENT ? past ? past->step : 0.0
                                                      : 1.0;
    }
}

void rb_rolling_set_gap(const rb_rolling_mesh *mesh, const rb_rolling_bodies *bodies,
                        rb_contact_problem *p)
{
    for (int i = 0; i < p->n; i++)
        p->d_N[i] = mesh->gap[i] + bodies->f.w0[i];
}

double rb_rolling_wanted_shift(const rb_rolling_case *rc)
{
    if (!isnan(rc->shift))
        return rc->shift;
    const rb_rolling_derived d = rb_rolling_derive(rc);
    return isnan(d.load) ? 0.1 * d.approach : 0.0;
}

/* Given values of theory.md 4.6.  The creepage ratio refers to the Hertz half-width of
 * the load: under approach control an estimate, which build.c corrects after a solve. */
void rb_rolling_set_control(const rb_rolling_case *rc, rb_contact_problem *p)
{
    const rb_rolling_derived d = rb_rolling_derive(rc);

    p->load_given = !isnan(d.load);
    p->load = d.load;
    p->delta = d.approach;
    p->force = p->force_ratio = p->xi = 0.0;
    p->force_given = p->mu > 0.0 && rb_rolling_force_is_given(rc);
    p->axle = rc->free_axle ? 1.0 / rc->a.radius : 0.0;
    if (p->axle > 0.0)
        return;
    if (p->force_given && !isnan(rc->force_ratio))
        p->force_ratio = rc->force_ratio;
    else if (p->force_given && p->load_given && rc->friction.law == RB_FRICTION_constant &&
             rc->friction.heat == 0.0)
        p->force_ratio = rc->force / (p->mu * d.load);
    else if (p->force_given)
        p->force = rc->force;
    else if (rc->formulation == RB_STATIC)
        p->xi = rb_rolling_wanted_shift(rc);
    else if (!isnan(rc->creep_ratio))
        p->xi = rc->creep_ratio * p->mu * d.half_width / d.radius;
    else
        p->xi = isnan(rc->creep) ? 0.0 : rc->creep;
}

/* Scales: stress by Hertz, lengths so that the diagonals of F_NN and of A F_TT become
 * about 1; where mu is small, the slip of dissimilar bodies comes from the pressure. */
void rb_rolling_set_given(const rb_rolling_case *rc, const rb_rolling_bodies *bodies,
                          rb_contact_problem *p)
{
    const rb_contact_response unit = rb_contact_operator_response(p->op);

    rb_rolling_start_bounds(rc, NULL, bodies, p);
    rb_rolling_set_control(rc, p);
    const double friction = (p->mu > 0.0 ? p->mu : 1.0) * unit.slip;
    const rb_rolling_derived d = rb_rolling_derive(rc);
    p->stress = d.stress > 0.0 ? d.stress : 1e-3 * d.modulus; /* bodies that are apart */
    p->gap_length = p->stress * unit.gap;
    p->slip_length = p->stress * fmax(friction, unit.coupled_slip);
    p->rounding = 64.0 * DBL_EPSILON * unit.reach;
}

/* The arrays of (K1) to (K3), of a problem that is allocated. */
static rb_status fill_problem(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                              const rb_rolling_bodies *bodies, const rb_rolling_past *past,
                              rb_contact_problem *p, rb_message *why)
{
    if (rc->yield_stress > 0.0) {
        const rb_status s = rb_rolling_set_yield(rc, bodies, p, why);
        if (s != RB_OK)
            return s;
    }
    /* The coefficients of friction (K3), what is given (4.6) and the scales (4.4). */
    rb_rolling_set_given(rc, bodies, p);
    p->differences = rc->formulation == RB_STEADY;
    p->force_unit = " N/mm";
    /* d_N of the gaps (K1), d_T and e_T of the slips (K2). */
    rb_rolling_set_gap(mesh, bodies, p);
    rb_rolling_set_past(rc, bodies, past, p);
    /* P, Q and M: vertical and horizontal force of unit tractions along n and t. */
    for (int i = 0; i < p->n; i++) {
        const double h = bodies->f.h[i];
        const double sine =
            rc->normals == RB_BEM_NORMALS_SURFACE ? bodies->f.x[i] / rc->a.radius : 0.0;
        const double cosine = sqrt(1.0 - sine * sine);
        p->load_N[i] = h * cosine;
        p->load_T[i] = h * sine;
        p->force_N[i] = -h * sine;
        p->force_T[i] = h * cosine;
        p->moment_N[i] = bodies->f.x[i] * p->load_N[i];
        p->moment_T[i] = bodies->f.x[i] * p->load_T[i];
    }
    return RB_OK;
}

static rb_status not_made(rb_status s, int n, rb_message *why)
{
    return s == RB_INTERRUPTED
               ? rb_fail(why, s, "interrupted")
               : rb_fail(why, s, "out of memory for a contact problem of %d elements", n);
}

rb_status rb_rolling_problem_share(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                   const rb_rolling_bodies *bodies, rb_contact_operator *op,
                                   rb_contact_problem *p, rb_message *why)
{
    const rb_status s = rb_contact_problem_borrow(op, p);

    return s == RB_OK ? fill_problem(rc, mesh, bodies, NULL, p, why) : not_made(s, mesh->n, why);
}

rb_status rb_rolling_problem_create(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                    const rb_rolling_bodies *bodies, const rb_rolling_past *past,
                                    rb_contact_problem *p, rb_message *why)
{
    rb_rolling_kinematic A;
    rb_contact_operator *op = NULL;
    rb_status s = set_kinematic(rc, bodies, &A);

    memset(p, 0, sizeof *p);
    if (s == RB_OK)
        s = make_operator(rc, bodies, &A, &op);
    free(A.outside);
    if (s == RB_OK)
        s = rb_contact_problem_alloc(op, p);
    if (s != RB_OK)
        return not_made(s, mesh->n, why);
    return fill_problem(rc, mesh, bodies, past, p, why);
}

rb_status rb_rolling_problem_stretch(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                     const rb_rolling_bodies *bodies, double scale, double along,
                                     rb_contact_problem *p, rb_message *why)
{
    const rb_status s = rb_contact_operator_stretch(p->op, scale, along);

    return s == RB_OK ? fill_problem(rc, mesh, bodies, NULL, p, why) : s;
}

rb_status rb_rolling_problem_renew_operator(const rb_rolling_case *rc,
                                            const rb_rolling_bodies *bodies, rb_contact_problem *p,
                                            rb_message *why)
{
    rb_rolling_kinematic A;
    rb_status s = set_kinematic(rc, bodies, &A);

    rb_contact_operator *op = NULL;
    if (s == RB_OK)
        s = make_operator(rc, bodies, &A, &op);
    free(A.outside);
    if (s != RB_OK)
        return not_made(s, p->n, why);
    rb_contact_operator_free(p->op);
    p->op = op;
    p->rounding = 0.0; /* of products */
    return s;
}

/* ---- How it is solved -------------------------------------------------------------- */

double rb_rolling_sliding_creepage(const rb_rolling_case *rc, const rb_contact_problem *p)
{
    const rb_rolling_derived d = rb_rolling_derive(rc);
    const double a = d.half_width, beta = fabs(d.dundurs);
    const double mu = p->mu;
    const double ratio = (mu + 2.0 * beta * (1.0 + mu * mu)) * d.strain;
    double moved = 0.0; /* a strain moves the creepages, or the shifts, of full sliding */

    for (int i = 0; i < p->n && rb_rolling_is_strained(rc); i++)
        moved = fmax(moved, fabs(p->d_T[i] / p->e_T[i]));
    return moved + (rc->formulation == RB_STEADY ? 2.0 * ratio : 4.0 * ratio * a / p->e_T[0]);
}

/* Where mu beta >= 1: Newton's steps without a matrix times elements, some seconds of them. */
static const double MOST_WORK = 1e5;

enum { LEAST_STEPS = 40 };

rb_status rb_rolling_problem_solve(rb_contact_problem *problem, const rb_rolling_case *rc, int warm,
                                   rb_contact_state *state, rb_message *why)
{
    const double coupling = rb_rolling_mu_beta(rc);
    const int many = coupling >= 1.0 && !rb_contact_operator_matrix(problem->op).F;

    problem->sliding = rb_rolling_sliding_creepage(rc, problem);
    problem->step_limit = many ? LEAST_STEPS + (int)(MOST_WORK / problem->n) : 0;
    const rb_status s = rb_contact_solve(problem, &rc->contact, warm, state, why);
    if (s > 0 && many)
        rb_fail(why, s,
                "mu beta = %.3g: from 1 on Newton's method may fail on many elements, as it did on "
                "%d; give at most %d --contact-elements, or --solver lemke",
                coupling, problem->n, RB_ROLLING_STRONG_ADVISED_UP_TO);
    return s == RB_OK ? rb_rolling_take_middle(rc, problem, state) : s;
}
