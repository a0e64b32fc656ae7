/* The laws that tractions, zones, approach and motion must obey, whatever the result says of them:
 * what was given, complementarity of pressure and gap, Coulomb's law between friction and slip, the
 * power that is lost.  Nothing is solved. */
#include "program/certificate/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double CONTROLS = 1e-9; /* a given value against the one that was met */
static const double RATIO = 1e-13;   /* rounding of the creepage ratio of a table */
static const double LOOSEST = 1e-6;  /* residual that is believed, whatever was asked for */
enum { UNRESOLVED = 4 };             /* slip zones at the trailing edge of fewer elements */

/* ---- Tolerances -------------------------------------------------------------------- */

/* The residual that the result prints is believed where it is below what was asked for.
 * Hierarchical matrices approximate: other ends of elements, by a rounding, other digits. */
void rb_certificate_tolerances(rb_certificate *c, double residual)
{
    const rb_rolling_model *m = c->model;
    const rb_rolling_case *rc = m->rc;
    const rb_contact_problem *p = &m->problem;
    const int hierarchical = rb_rolling_is_compressed(m);
    const double asked = fmin(fmax(rc->contact.tol, p->rounding), LOOSEST);

    c->exact = 10.0 * fmax(residual < asked ? residual : asked, p->rounding);
    /* A share of the largest displacement: that of a wheel comes from solving the system of
     * its boundary again, on ends of elements that differ by a rounding. */
    const double share = hierarchical ? 1e-10 : rb_rolling_can(rc, RB_BODY_FLAT) ? 1e-13 : 2e-12;
    /* Of the half-planes that thin layers would be without their bases: what these take away is
     * subtracted from it. */
    const rb_rolling_body *const bodies[] = {&rc->a, &rc->b};
    double tractions = 0.0, compliance = 0.0;
    for (int i = 0; i < p->n; i++)
        tractions += (fabs(m->state.p[i]) + fabs(m->state.q[i])) * m->bodies.f.h[i];
    for (int b = 0; b < 1 + rc->elastic_b; b++) {
        const rb_bem_material material = rb_rolling_material(rc, bodies[b]);
        if (bodies[b]->layer > 0.0)
            compliance += (1.0 - material.poisson) / material.shear;
    }
    c->displacement = share * tractions * compliance;
    const size_t elements = (size_t)m->bodies.f.m;
    double *w = rb_alloc(elements, 2);
    if (w && rb_rolling_displacement(&m->bodies, m->state.p, m->state.q, w) == RB_OK)
        c->displacement += share * (rb_norm_inf(elements, w) + rb_norm_inf(elements, w + elements));
    free(w);
    /* That from which a step begins; of bodies that have come apart it is all there is. */
    c->displacement += share * rb_norm_inf((size_t)p->n, p->d_T);
    c->tol = (hierarchical ? 100.0 : 10.0) * asked +
             c->displacement / fmin(p->gap_length, p->slip_length);
}

/* ---- What was given ---------------------------------------------------------------- */

static void judge_controls(rb_certificate *c)
{
    const rb_contact_problem *p = &c->model->problem;
    const rb_rolling_case *rc = c->model->rc;
    const double delta = c->model->state.delta;

    if (p->load_given)
        rb_certificate_expect(c, "the given load", rb_rolling_model_load(c->model), p->load,
                              CONTROLS * p->load);
    else
        rb_certificate_expect(c, "the given approach", delta, p->delta, CONTROLS * fabs(p->delta));
    /* the residual has a force, the solution a ratio */
    if (!p->force_given && !(rc->formulation == RB_STEADY && !isnan(rc->creep_ratio)))
        rb_certificate_expect(c, "the given shift or creepage", c->model->state.xi, p->xi,
                              CONTROLS * fabs(p->xi));
}

/* ---- Element by element ------------------------------------------------------------ */

rb_status rb_certificate_laws(rb_certificate *c)
{
    const rb_contact_problem *problem = &c->model->problem;
    const rb_contact_state *x = &c->model->state;
    const int n = problem->n;
    const double apart = c->tol * problem->gap_length + c->displacement;
    const double length = c->tol * problem->slip_length;
    const double stress = c->tol * fmax(problem->mu, 1e-3) * problem->stress;
    double *gap = rb_alloc((size_t)n, 3);
    char what[60];
    rb_contact_violation v;

    if (!gap)
        return RB_ENOMEM;
    double *yielded = gap + 2 * n;
    judge_controls(c);
    rb_contact_kinematics(problem, x, gap, gap + n);
    rb_contact_yielded(problem, x->plastic, NULL, yielded);
    for (int i = 0; i < n; i++) {
        const double p = x->p[i], q = x->q[i], slip = x->lambda[i], bound = problem->bound[i] * p;
        const double yield = rb_contact_yield_stress(problem, i, yielded[i]);
        const int zone = x->zone[i];

        snprintf(what, sizeof what, "shift of element %d", i + 1);
        rb_certificate_expect(c, what, slip, gap[n + i],
                              c->exact * problem->slip_length + c->displacement);
        if (p > 0.0 ? fabs(gap[i]) > apart : gap[i] < -apart)
            rb_certificate_violated(c,
                                    "gap of element %d: %.3g at a pressure of %.3g (allowed %.2g)",
                                    i + 1, gap[i], p, apart);
        if (p < 0.0)
            rb_certificate_violated(c, "pressure of element %d: %.3g < 0", i + 1, p);
        if ((p > 0.0) != (zone != RB_ZONE_SEPARATED))
            rb_certificate_violated(c, "zone of element %d: %d at a pressure of %.3g", i + 1, zone,
                                    p);
        if (fabs(q) > bound + stress)
            rb_certificate_violated(
                c, "Coulomb's bound of element %d: |q| exceeds mu p by %.3g (allowed %.2g)", i + 1,
                fabs(q) - bound, stress);
        if (zone == RB_ZONE_STICK && fabs(slip) > length)
            rb_certificate_violated(c, "stick of element %d: it slips by %.3g (allowed %.2g)",
                                    i + 1, fabs(slip), length);
        if (zone == RB_ZONE_SLIP_NEGATIVE && (fabs(q + bound) > stress || slip < -length))
            rb_certificate_violated(c, "slip of element %d: q + mu p = %.3g, shift %.3g", i + 1,
                                    q + bound, slip);
        if (zone == RB_ZONE_SLIP_POSITIVE && (fabs(q - bound) > stress || slip > length))
            rb_certificate_violated(c, "slip of element %d: q - mu p = %.3g, shift %.3g", i + 1,
                                    q - bound, slip);
        if (zone > RB_ZONE_SLIP_POSITIVE && fabs(fabs(q) - yield) > stress)
            rb_certificate_violated(c, "yield of element %d: |q| is off its yield stress by %.3g",
                                    i + 1, fabs(q) - yield);
        if (fabs(q) > yield + stress)
            rb_certificate_violated(
                c, "yield stress of element %d: |q| exceeds it by %.3g (allowed %.2g)", i + 1,
                fabs(q) - yield, stress);
    }
    if ((x->p[0] > 0.0 || x->p[n - 1] > 0.0) && c->model->rc->mesh != RB_MESH_PUNCH &&
        !rb_rolling_fills_period(c->model->rc, &c->model->mesh))
        rb_certificate_violated(c, "the contact reaches an end of the table");
    free(gap);
    const rb_status s = rb_contact_residual(problem, x, &v);
    if (s == RB_OK && !(v.scaled <= c->tol))
        rb_certificate_violated(c, "residual: %.3g (allowed %.2g)", v.scaled, c->tol);
    if (s == RB_OK)
        c->found->residual = fmax(c->found->residual, v.scaled);
    return s;
}

/* ---- The whole contact ------------------------------------------------------------- */

/* The library's own formula against one that shares nothing with it.  What sticks up to
 * the trailing edge is set free there, in a slip zone that the elements do not resolve:
 * differences along the contact count that work as hysteresis, waves do not. */
static rb_status judge_hysteresis(rb_certificate *c, const rb_rolling_solution *s)
{
    double waves, allowed;

    if (c->model->rc->formulation != RB_STEADY || !rb_rolling_relaxes(c->model->rc))
        return RB_OK;
    const rb_status status = rb_certificate_hysteresis(c->model, s, &waves, &allowed);
    if (status != RB_OK)
        return status;
    if (s->hysteresis > waves) {
        /* Elements that slip at the trailing edge, behind those that stick. */
        int first = 0, last;
        while (first < s->n && !(s->p[first] > 0.0))
            first++;
        for (last = first; last < s->n && s->p[last] > 0.0 && s->zone[last] != RB_ZONE_STICK;)
            last++;
        const int slipping = last - first;
        if (slipping < UNRESOLVED)
            return RB_OK;
        allowed += 0.4 * (fabs(waves) + fabs(s->dissipation)) / slipping / slipping;
    }
    rb_certificate_expect(c, "hysteresis by waves", s->hysteresis, waves, allowed);
    return RB_OK;
}

/* As many elements as the case asks for: equal ones in all, others across the contact.  Patches
 * that lie apart, as on layers, and contacts that move take more. */
static void judge_mesh(rb_certificate *c, const rb_rolling_solution *s)
{
    enum { AT_EDGES = 2 }; /* an edge may lie on either side of an end */
    const rb_rolling_case *rc = c->model->rc;
    const int asked = c->model->equal_instead
                          ? rb_rolling_equal_elements_instead(rc->contact_elements)
                          : rc->contact_elements,
              equal = rc->mesh == RB_MESH_UNIFORM || c->model->equal_instead,
              more = rc->gap == RB_GAP_TABLE || rc->worn.n > 0 || rb_rolling_has_steps(rc) ||
                     rc->a.layer > 0.0 || rc->b.layer > 0.0 || rc->a.cover > 0.0 ||
                     rc->b.cover > 0.0;

    if (s->n < asked || (!more && (equal ? s->n > asked : s->contact > asked + AT_EDGES)))
        rb_certificate_violated(c, "table: %d elements, %d of them in contact, and inputs have %d",
                                s->n, s->contact, rc->contact_elements);
}

rb_status rb_certificate_balances(rb_certificate *c, const rb_rolling_solution *s)
{
    const rb_rolling_case *rc = c->model->rc;

    judge_mesh(c, s);
    if (rc->formulation == RB_STEADY && !isnan(rc->creep_ratio) && !c->model->problem.force_given)
        rb_certificate_expect(c, "the given creep_ratio", s->creep_ratio, rc->creep_ratio,
                              CONTROLS * fabs(rc->creep_ratio) + RATIO);
    return judge_hysteresis(c, s);
}

/* ---- Proof ------------------------------------------------------------------------- */

rb_status rb_certificate_prove(rb_certificate *c)
{
    rb_contact_proof *proof = &c->found->proof;
    const int steps = c->step ? proof->steps : 0, proved = c->step ? proof->steps_proved : 0;
    rb_message why;
    if (!c->proves)
        return RB_OK;
    const rb_status s = rb_rolling_model_prove(c->model, proof, &why);
    if (c->step) {
        proof->steps = steps + 1;
        proof->steps_proved = proved + proof->proved;
    }
    return s > 0 ? RB_OK : s;
}
