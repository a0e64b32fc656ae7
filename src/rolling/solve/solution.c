/* The solution of a model: from the tractions that the contact problem was solved for to what is
 * printed.  Zones, forces (4.6), displacements and slip (12), moment and power (4.14), energy, heat
 * (4.8), and at the end what proves it: the residual (4.4), recomputed from the tractions, and the
 * balance of the support. */
#include "rolling/body/internal.h"
#include "rolling/body/mesh.h"
#include "rolling/case/ellipse.h"
#include "rolling/case/internal.h"
#include "rolling/results/columns.h"
#include "rolling/solve/cycle.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/heat.h"
#include "rolling/solve/law_iteration.h"
#include "rolling/solve/model.h"
#include "rolling/solve/patches.h"
#include "rolling/solve/power.h"
#include "rolling/solve/solution.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

void rb_rolling_solution_free(rb_rolling_solution *s)
{
    rb_rolling_columns_free(&rb_rolling_solution_columns, s);
    free(s->patch);
    memset(s, 0, sizeof *s);
}

/* ---- Scalars of the traction distribution ------------------------------------------ */

void rb_rolling_zone_lengths(int n, const int *zone, const double *h, double *contact,
                             double *stick)
{
    *contact = *stick = 0.0;
    for (int i = 0; i < n; i++) {
        *contact += zone[i] != RB_ZONE_SEPARATED ? h[i] : 0.0;
        *stick += zone[i] == RB_ZONE_STICK ? h[i] : 0.0;
    }
}

/* Counts of elements by their zones, and the outermost ends of what sticks. */
static void set_stick_limits(const rb_rolling_mesh *mesh, rb_rolling_solution *s)
{
    double contact;

    s->yielding = s->plastic ? 0 : -1;
    rb_rolling_zone_lengths(s->n, s->zone, s->h, &contact, &s->stick_length);
    s->stick_from = s->stick_to = NAN;
    for (int i = 0; i < s->n; i++) {
        s->contact += s->zone[i] != RB_ZONE_SEPARATED;
        s->slipping += s->zone[i] > RB_ZONE_STICK;
        s->yielding += s->zone[i] > RB_ZONE_SLIP_POSITIVE;
        if (s->zone[i] != RB_ZONE_STICK)
            continue;
        s->stick++;
        if (isnan(s->stick_from))
            s->stick_from = mesh->ends[i];
        s->stick_to = mesh->ends[i + 1];
    }
}

/* ---- Forces ------------------------------------------------------------------------ */

void rb_rolling_contact_tractions(const rb_rolling_model *model, double *t)
{
    /* load_N and load_T turn the frame of the contact into vertical and horizontal parts (--normals
     * surface); t: x and y of each element. */
    for (int i = 0; i < model->problem.n; i++) {
        const double h = model->bodies.f.h[i];
        const double c = model->problem.load_N[i] / h, d = model->problem.load_T[i] / h;
        t[2 * i] = c * model->state.q[i] - d * model->state.p[i];
        t[2 * i + 1] = c * model->state.p[i] + d * model->state.q[i];
    }
}

/* Vertical reaction of the support against the load, from the tractions that hold the
 * body; NAN for a half-plane. */
static rb_status support_balance(const rb_rolling_model *model, double load, double *balance)
{
    *balance = NAN;
    if (!model->bodies.system_a || !(load > 0.0))
        return RB_OK;
    const rb_bem_mesh *mesh = rb_bem_system_mesh(model->bodies.system_a);
    rb_arena scratch = {0};
    double *u = rb_arena_doubles(&scratch, 2 * (size_t)mesh->n, 1),
           *t = rb_arena_doubles(&scratch, 2 * (size_t)mesh->n, 1),
           *t_c = rb_arena_doubles(&scratch, 2 * (size_t)model->problem.n, 1), reaction = 0.0;

    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    rb_rolling_contact_tractions(model, t_c);
    const rb_status s = rb_bem_system_solve(model->bodies.system_a, t_c, u, t);
    for (int j = 0; j < mesh->n; j++)
        if (mesh->condition[2 * j + 1] == RB_BEM_DISPLACEMENT)
            reaction += t[2 * j + 1] * rb_bem_mesh_length(mesh, j);
    if (s == RB_OK)
        *balance = (reaction + load) / load;
    return rb_arena_done(&scratch, s);
}

/* What is smaller is rounding, or what the solver leaves: zero, as by symmetry. */
static double unless_tiny(double x, double tiny)
{
    return fabs(x) <= tiny ? 0.0 : x;
}

/* (L9) What half of the friction stretches a layer on a smooth base, per friction. */
static double half_stretch(const rb_rolling_case *rc, const rb_rolling_body *body)
{
    const rb_bem_material m = rb_rolling_material(rc, body);
    return body->layer_base == RB_BASE_SMOOTH && body->layer > 0.0
               ? (1.0 - m.poisson) / (4.0 * m.shear * body->layer)
               : 0.0;
}

/* P, Q, delta and xi, and the ratios of them that users compare with formulas. */
static void set_forces(const rb_rolling_model *model, rb_rolling_solution *s)
{
    const rb_contact_problem *p = &model->problem;

    s->normal_load = rb_rolling_model_load(model);
    s->tangential_load = rb_rolling_model_force(model);
    s->load_error = p->load_given ? fabs(s->normal_load - p->load) / p->load : NAN;
    s->hertz_half_width = rb_rolling_has_radius(model->rc) ? model->half_width : NAN;
    s->bulk_strain = rb_rolling_bulk_strain(model->rc);
    s->largest_bulk_strain = rb_rolling_largest_bulk_strain(model->rc);
    s->mean_pressure = model->rc->period > 0.0 ? s->normal_load / model->rc->period : NAN;
    s->datum = rb_rolling_datum(model->rc, &model->rc->a);
    s->approach = model->state.delta;
    s->ellipse = model->rc->ellipse.radius > 0.0 ? model->rc->ellipse
                                                 : (rb_rolling_ellipse){NAN, NAN, NAN, NAN, NAN};
    if (s->formulation == RB_STATIC) {
        const rb_rolling_case *rc = model->rc;
        /* At rest xi is the shift of this step; a creepage only enters the slip (12). */
        s->tangential_shift = model->shift + model->state.xi;
        s->tilt = rb_rolling_is_tilted(rc) ? rb_rolling_tilt(rc) : NAN;
        s->creepage = !isnan(rc->creep) ? rc->creep
                      : !isnan(rc->creep_ratio)
                          ? rb_rolling_creepage_of_ratio(model, rc->creep_ratio)
                          : 0.0;
    } else {
        s->tangential_shift = s->tilt = NAN;
        s->creepage = model->state.xi;
    }
    s->force_ratio = rb_rolling_force_ratio(model);
    s->creep_ratio = rb_rolling_ratio_of_creepage(model, s->creepage);
    const rb_rolling_case *rc = model->rc;
    const double stretch =
        s->formulation == RB_STATIC || !rb_rolling_slides_on_base(rc)
            ? NAN
            : s->tangential_load *
                  (half_stretch(rc, &rc->a) + (rc->elastic_b ? half_stretch(rc, &rc->b) : 0.0));
    /* (L9) A layer that is unstrained ahead of the contact, or behind it. */
    s->creepage_ahead = s->creepage + stretch;
    s->creepage_behind = s->creepage - stretch;
    rb_rolling_set_ellipse_forces(rc, s->creep_ratio, &s->ellipse_force, &s->ellipse_force_kalker);
}

/* ---- All together ------------------------------------------------------------------ */

/* What is read from the state alone. */
static void set_tractions(const rb_rolling_model *model, rb_rolling_solution *s)
{
    const int n = s->n;
    const rb_contact_state *state = &model->state;
    const double *x = model->bodies.f.x;

    memcpy(s->x, model->bodies.f.x, (size_t)n * sizeof(double));
    memcpy(s->h, model->bodies.f.h, (size_t)n * sizeof(double));
    memcpy(s->p, state->p, (size_t)n * sizeof(double));
    memcpy(s->q, state->q, (size_t)n * sizeof(double));
    memcpy(s->shift, state->lambda, (size_t)n * sizeof(double));
    memcpy(s->zone, state->zone, (size_t)n * sizeof(int));
    for (int i = 0; i < n && s->worn; i++)
        s->worn[i] = rb_rolling_worn_depth(model->rc, s->x[i]);
    if (s->mu)
        memcpy(s->mu, model->problem.bound, (size_t)n * sizeof(double));
    if (s->plastic)
        rb_rolling_yielded(model, s->plastic);
    for (int i = 0; i < n; i++)
        s->slip[i] = s->formulation == RB_STATIC   ? (double)NAN
                     : s->formulation == RB_STEADY ? s->shift[i] / (x[i + 1] - x[i])
                                                   : s->shift[i] / model->problem.e_T[i];
}

/* What takes products. */
static rb_status set_displacements(const rb_rolling_model *model, rb_rolling_solution *s)
{
    const int n = s->n, m = n + 1;
    const rb_contact_state *state = &model->state;
    const double *x = model->bodies.f.x, strain = rb_rolling_bulk_strain(model->rc);
    double *w = rb_alloc(2 * (size_t)m, 2);
    rb_status status = w ? RB_OK : RB_ENOMEM;

    if (status == RB_OK)
        status = rb_rolling_displacement(&model->bodies, state->p, state->q, w);
    if (status == RB_OK) {
        const double *w_T = w + m;
        rb_contact_kinematics(&model->problem, state, s->gap, w + 2 * m);
        memcpy(s->un, w, (size_t)n * sizeof(double));
        memcpy(s->ut, w_T, (size_t)n * sizeof(double));
        /* static: (12) with sgn(V) = -1, from the creepage of the case and the strain upstream;
         * otherwise the slip of the solution itself */
        for (int i = 0; i < n && s->formulation == RB_STATIC; i++)
            s->slip[i] = s->creepage - strain - (w_T[i + 1] - w_T[i]) / (x[i + 1] - x[i]);
    }
    free(w);
    return status;
}

static void add_boundary(const rb_bem_system *system, rb_rolling_solution *s)
{
    if (!system)
        return;
    s->boundary_elements += rb_bem_system_mesh(system)->n;
    s->hierarchical |= isnan(rb_bem_system_rcond(system));
}

/* Who has found the solution, and in what time. */
static void set_counts(const rb_rolling_model *model, rb_rolling_solution *s)
{
    const rb_contact_state *state = &model->state;

    s->status = state->status;
    s->solver = state->solver;
    s->cone_solver = model->rc->contact.cone_solver.name;
    s->large = !model->bodies.F;
    add_boundary(model->bodies.system_a, s);
    add_boundary(model->bodies.system_b, s);
    s->lcp_form = state->lcp_form;
    s->iterations = model->iterations;
    s->seconds_assembly = model->bodies.seconds_assembly;
    s->seconds_factor = model->bodies.seconds_factor;
    s->seconds_condense = model->bodies.seconds_condense;
    s->seconds_lcp = model->seconds_lcp;
}

rb_status rb_rolling_solution_heat(const rb_rolling_case *rc, const rb_rolling_solution *s,
                                   const rb_rolling_solution *heats,
                                   struct rb_rolling_conduction **conduction, double *t_a,
                                   double *t_b, double *heat_a, double *heat_b, rb_message *why)
{
    double *power = rb_alloc((size_t)s->n, 2);

    if (!power)
        return RB_ENOMEM;
    rb_rolling_friction_power(s, power);
    rb_rolling_friction_power(heats, power + s->n);
    const rb_status status = rb_rolling_steady_temperature(rc, s, power, power + s->n, conduction,
                                                           t_a, t_b, heat_a, heat_b, why);
    free(power);
    return status;
}

/* The sums of the heat of the elements. */
static void set_heat(const rb_rolling_case *rc, rb_rolling_solution *s)
{
    s->heat_into_a = s->heat_into_b = 0.0;
    for (int i = 0; i < s->n; i++) {
        s->heat_into_a += s->h[i] * s->heat_a[i];
        s->heat_into_b += s->h[i] * s->heat_b[i];
    }
    const double both = s->heat_into_a + s->heat_into_b;
    if (rc->heat_a.temperature == rc->heat_b.temperature && both > 0.0)
        s->heat_share_a = s->heat_into_a / both;
}

rb_status rb_rolling_set_temperature(const rb_rolling_model *model, rb_rolling_solution *s,
                                     rb_message *why)
{
    const rb_rolling_case *rc = model->rc;
    const size_t size = (size_t)s->n * sizeof(double);
    rb_status status = RB_OK;

    if (!s->temperature)
        return RB_OK;
    /* of a transient the steps have followed the heat */
    if (rc->formulation == RB_STEADY) {
        struct rb_rolling_conduction *conduction = NULL;
        status = rb_rolling_solution_heat(rc, s, s, &conduction, s->temperature, s->temperature_b,
                                          s->heat_a, s->heat_b, why);
        rb_rolling_conduction_free(conduction);
    } else if (model->carried.temperature) {
        double *power = rb_alloc((size_t)s->n, 1);
        if (!power)
            return RB_ENOMEM;
        memcpy(s->temperature, model->carried.temperature, size);
        memcpy(s->temperature_b, model->carried.temperature, size);
        rb_rolling_friction_power(s, power);
        rb_rolling_heat_by_effusivity(rc, power, s);
        free(power);
    }
    set_heat(rc, s);
    rb_rolling_peak_temperature(s->n, s->x, s->zone, s->temperature, &s->max_temperature,
                                &s->max_temperature_at);
    return status;
}

/* Coulomb's law between the printed slip and the printed tractions: in stick no slip,
 * in slip the friction against it. */
static int slip_violations(const rb_rolling_model *model, const rb_rolling_solution *s)
{
    const double small = 1e-9 * model->problem.slip_length / s->h[s->n / 2];
    int violations = 0;

    for (int i = 0; i < s->n; i++) {
        const double slip = fabs(s->slip[i]) > small ? s->slip[i] : 0.0;
        const int zone = s->zone[i];
        violations += zone == RB_ZONE_STICK ? slip != 0.0
                      : zone == RB_ZONE_SLIP_NEGATIVE || zone == RB_ZONE_YIELD_NEGATIVE ? slip < 0.0
                      : zone == RB_ZONE_SLIP_POSITIVE || zone == RB_ZONE_YIELD_POSITIVE ? slip > 0.0
                                                                                        : 0;
    }
    return violations;
}

/* with_products: 1: displacements and what follows from them, too. */
static rb_status summarise_model(const rb_rolling_model *model, int with_products,
                                 rb_rolling_solution *s, rb_message *why)
{
    memset(s, 0, sizeof *s);
    s->n = model->mesh.n;
    rb_status status = rb_rolling_columns_alloc(&rb_rolling_solution_columns, model->rc,
                                                model->varies, model->mesh.n, s);

    if (status == RB_OK) {
        /* Forces by sums over the elements; the table of tractions, displacements, gap and slip. */
        s->formulation = model->rc->formulation;
        set_counts(model, s);
        s->free_creepage = s->accuracy_elements = s->accuracy_boundary = NAN;
        set_forces(model, s);
        set_tractions(model, s);
        if (with_products)
            status = set_displacements(model, s);
    }
    if (status == RB_OK) {
        /* M, its coefficient and where the power goes that neither Q nor M/R leave to
         * friction. */
        s->resistance_moment = s->resistance_ratio = s->hysteresis = s->lever_power = NAN;
        s->torque_a = s->torque_b = NAN;
        if (s->formulation != RB_STATIC || rb_rolling_is_tilted(model->rc))
            s->resistance_moment = unless_tiny(rb_contact_moment(&model->problem, &model->state),
                                               1e-14 * s->normal_load * model->half_width);
        if (s->formulation != RB_STATIC) {
            s->resistance_ratio =
                s->normal_load > 0.0 && rb_rolling_has_radius(model->rc)
                    ? s->resistance_moment / (s->normal_load * rb_rolling_radius(model->rc))
                    : NAN;
            rb_rolling_torques(model->rc, s->resistance_moment, s->tangential_load, &s->torque_a,
                               &s->torque_b);
            if (with_products)
                status = rb_rolling_hysteresis(model, &s->hysteresis);
            if (with_products && status == RB_OK)
                status = rb_rolling_lever_power(model, s->hysteresis, &s->lever_power);
        }
    }
    /* Patches of the contact, their edges and the largest pressure; what sticks. */
    s->support_balance = NAN;
    if (status == RB_OK)
        status = rb_rolling_set_patches(model, s);
    if (status != RB_OK) {
        rb_rolling_solution_free(s);
        return rb_fail(why, status, "out of memory for a solution of %d elements", model->mesh.n);
    }
    set_stick_limits(&model->mesh, s);
    s->nip_width = s->contact_to - s->contact_from;
    /* Tabor's alpha = (3 pi/2) M/(P a). */
    s->hysteresis_factor =
        s->formulation == RB_STEADY && rb_rolling_relaxes(model->rc) && s->normal_load > 0.0
            ? 1.5 * M_PI * s->resistance_moment / (s->normal_load * s->half_width)
            : NAN;
    /* Clapeyron's: half the work of the tractions, which are linear in the displacements
     * unless a body relaxes or the interface yields. */
    double twice = 0.0;
    if (!with_products || !rb_rolling_can(model->rc, RB_BODY_ELASTIC) || s->yielding >= 0)
        s->strain_energy = NAN;
    else {
        for (int i = 0; i < s->n; i++)
            twice += s->h[i] * (s->p[i] * s->un[i] + s->q[i] * s->ut[i]);
        s->strain_energy = 0.5 * twice;
    }
    s->max_strain = rb_rolling_strain(model->rc, s->approach, s->max_pressure, NULL);
    /* Hertz's strains are a/(2R) = p0/E*; a third body that gives way strains neither body, and
     * a gap without a radius has no a/R. */
    if (isnan(s->max_strain))
        s->max_strain = model->rc->interlayer_normal > 0.0 || !rb_rolling_has_radius(model->rc)
                            ? s->max_pressure / rb_rolling_derive(model->rc).modulus
                            : 0.5 * s->half_width / rb_rolling_radius(model->rc);
    s->equal_instead = model->equal_instead;
    s->rows = model->rows;
    s->slip_operator = model->rc->slip_operator;
    s->kappa = NAN;
    if (rb_rolling_law_depends_on_state(model->rc))
        status = rb_rolling_law_kappa(model, &s->kappa);
    s->slip_violations = slip_violations(model, s);
    /* What friction turns into heat, from slip and friction alone. */
    s->dissipation =
        rb_rolling_dissipated_power(model->rc, s->n, s->shift, s->q, s->h, model->problem.e_T);
    if (s->formulation != RB_STATIC)
        s->dissipation =
            unless_tiny(s->dissipation, 1e-11 * rb_rolling_largest_mu(model->rc) * s->normal_load *
                                            rb_rolling_derive(model->rc).strain);
    rb_rolling_cycle_results(model, s);
    s->max_temperature = s->max_temperature_at = NAN;
    s->heat_into_a = s->heat_into_b = s->heat_share_a = NAN;
    s->peclet = s->temperature
                    ? rb_rolling_peclet(&model->rc->heat_a, model->rc->speed, s->half_width)
                    : NAN;
    if (status != RB_OK)
        rb_rolling_solution_free(s);
    return status;
}

rb_status rb_rolling_bare_solution(const rb_rolling_model *model, rb_rolling_solution *s,
                                   rb_message *why)
{
    return summarise_model(model, 1, s, why);
}

rb_status rb_rolling_tractions_solution(const rb_rolling_model *model, rb_rolling_solution *s,
                                        rb_message *why)
{
    return summarise_model(model, 0, s, why);
}

rb_status rb_rolling_model_solution(const rb_rolling_model *model, rb_rolling_solution *s,
                                    rb_message *why)
{
    rb_contact_violation violation;
    rb_status status = rb_rolling_bare_solution(model, s, why);

    if (status != RB_OK)
        return status;
    status = rb_rolling_set_temperature(model, s, why);
    if (status != RB_OK) {
        rb_rolling_solution_free(s);
        return status;
    }
    status = rb_contact_residual(&model->problem, &model->state, &violation);
    if (status == RB_OK)
        status = support_balance(model, s->normal_load, &s->support_balance);
    s->residual = violation.scaled;
    s->residual_gap = violation.gap;
    s->residual_slip = violation.slip;
    s->residual_friction = violation.friction;
    if (status != RB_OK) {
        rb_rolling_solution_free(s);
        rb_fail(why, status, "out of memory for the residuals of %d elements", model->mesh.n);
    }
    return status;
}

rb_status rb_rolling_model_prove(const rb_rolling_model *model, rb_contact_proof *proof,
                                 rb_message *why)
{
    const rb_status s = rb_contact_prove(&model->problem, &model->state, proof, why);
    if (s == RB_OK && proof->unique && rb_rolling_law_depends_on_state(model->rc)) {
        if (strcmp(proof->unique, "uncoupled") == 0 || strcmp(proof->unique, "energy") == 0)
            proof->unique = "fixed friction";
        else if (strcmp(proof->unique, "at its creepage") == 0)
            proof->unique = "not shown";
    }
    return s;
}
