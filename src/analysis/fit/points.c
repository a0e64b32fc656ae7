/* The measured points of a fit: their elements, solutions and derivatives (theory-solvers.md, D5).
 * Elements stay those of the first solution of each point while the numbers move, so that
 * the sum of squares is continuous. */
#include "analysis/fit/fit.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* Elements that differ by rounding, in lengths of the mesh. */
static const double SAME_PLACE = 1e-9;
/* A derivative that is none where elements move, of the one where they stay. */
static const double NONE = 1e-4;

/* ---- One point ----------------------------------------------------------------------- */

/* A point with its parameters; number `varied` (-1: none) has another value. */
typedef struct {
    fit_problem *p;
    const double *theta;
    int point, varied;
} place;

/* 1: both points differ by the creepage alone. */
static int are_alike(const rb_case_data *d, int i, int j)
{
    return (!d->load || d->load[i] == d->load[j]) && (!d->speed || d->speed[i] == d->speed[j]) &&
           (!d->temperature || d->temperature[i] == d->temperature[j]);
}

/* The options of a point are those of the case, with the numbers theta, and with what the row of
 * the data says of the point itself. */
static rb_status resolve_point(const place *at, double value, rb_rolling_case *rc, rb_message *why)
{
    const fit_problem *p = at->p;
    const rb_case_data *d = p->data;
    rb_case *copy = rb_case_copy(p->c);

    if (!copy)
        return rb_fail(why, RB_ENOMEM, "out of memory for a case");
    copy->purpose = RB_CASE_SINGLE;
    for (int j = 0; j < p->n; j++)
        if (j != p->offset)
            rb_case_assign(copy, p->option[j], j == at->varied ? value : at->theta[j]);
    rb_case_assign(copy, p->creep, d->creep[at->point]);
    if (d->load)
        rb_case_assign(copy, p->load, d->load[at->point]);
    if (d->speed)
        rb_case_assign(copy, p->speed, d->speed[at->point]);
    if (d->temperature)
        rb_case_assign(copy, p->temperature, d->temperature[at->point]);
    const rb_status s = rb_case_resolve(copy, why);
    if (s == RB_OK)
        *rc = copy->resolved.rc;
    rb_case_free(copy);
    return s;
}

/* The case of a point: options are resolved once for all that are alike. */
static rb_status case_at(void *context, double value, rb_rolling_case *rc, rb_message *why)
{
    const place *at = context;
    fit_problem *p = at->p;
    const int of_creep = at->varied == p->offset, varied = of_creep ? -1 : at->varied;
    const double x = varied < 0 ? 0.0 : value;
    const size_t bytes = (size_t)p->n * sizeof *at->theta;

    /* Cases are kept as long as theta stays; a creepage changes no other option and is set in the
     * copy. */
    if (memcmp(p->known_for, at->theta, bytes) != 0)
        p->known_n = 0;
    memcpy(p->known_for, at->theta, bytes);
    const fit_case *known = p->known;
    rb_status s = RB_OK;

    while (known < p->known + p->known_n && !(known->varied == varied && known->value == x &&
                                              are_alike(p->data, known->point, at->point)))
        known++;
    if (known < p->known + p->known_n) {
        *rc = known->rc;
    } else {
        s = resolve_point(at, value, rc, why);
        if (s == RB_OK && p->known_n < FIT_CASES)
            p->known[p->known_n++] = (fit_case){varied, at->point, x, *rc};
    }
    const double offset = p->offset < 0 ? 0.0 : of_creep ? value : at->theta[p->offset];
    *(double *)(void *)((char *)rc + p->creep->offset - offsetof(rb_resolved_case, rc)) =
        p->data->creep[at->point] + offset;
    return s;
}

/* The model whose elements those of a solution are. */
static const rb_rolling_model *model_below(const fit_problem *p, int k, int which)
{
    const int first = p->at[k].first;
    return first == k ? &p->at[k].base : &p->at[first].solved[which];
}

/* The force in the measure of the data. */
static double measured_force(const fit_problem *p, const rb_rolling_model *model)
{
    const double Q = rb_contact_force(&model->problem, &model->state),
                 P = rb_contact_load(&model->problem, &model->state);

    return p->data->measure == RB_CASE_FORCE             ? Q
           : p->data->measure == RB_CASE_FORCE_OVER_LOAD ? Q / P
                                                         : Q / (model->problem.mu * P);
}

static double sigma_of(const fit_problem *p, int k)
{
    return p->data->sigma ? p->data->sigma[k] : 1.0;
}

/* Number j as an input of derivatives, whose steps are parts of the scale: of the number that
 * has been reached, which may be far from the start. */
static rb_sensitivity_input input_of(const fit_problem *p, int j, double value, place *at)
{
    const rb_case_parameter *of = &p->fit->parameter[j];

    return (rb_sensitivity_input){.value = value,
                                  .scale = of->positive && value > 0.0 ? value : of->scale,
                                  .from = of->from,
                                  .to = of->to,
                                  .vary = case_at,
                                  .context = at};
}

/* The derivatives of the force at a solved point with respect to all parameters: one
 * adjoint solve. */
static rb_status differentiate_force(fit_problem *p, const double *theta, int k,
                                     const rb_rolling_model *model, const rb_sensitivity *s,
                                     double *row, rb_message *why)
{
    /* The force is a linear form of p and q, divided by P where the data are: d(Q/P) = (dQ - Q/P
     * dP)/P. */
    const rb_contact_problem *q = &model->problem;
    const double P = rb_contact_load(q, &model->state), f = measured_force(p, model);
    const int ratio = p->data->measure == RB_CASE_FORCE_RATIO;
    const double scale = p->data->measure == RB_CASE_FORCE ? 1.0
                         : ratio                           ? 1.0 / (q->mu * P)
                                                           : 1.0 / P;
    rb_contact_state weight = {0};
    rb_sensitivity_rate adjoint = {0}, rate = {0};
    rb_status status = rb_contact_state_alloc(q->n, &weight);

    if (status == RB_OK)
        status = rb_sensitivity_rate_alloc(q->n, &adjoint);
    for (int i = 0; i < q->n && status == RB_OK; i++) {
        const double share = p->data->measure == RB_CASE_FORCE ? 0.0 : f / P;
        weight.p[i] = scale * q->force_N[i] - share * q->load_N[i];
        weight.q[i] = scale * q->force_T[i] - share * q->load_T[i];
    }
    if (status == RB_OK)
        status = rb_sensitivity_adjoint(s, &weight, &adjoint, why);
    for (int j = 0; j < p->n && status == RB_OK; j++) {
        place at = {p, theta, k, j};
        const rb_sensitivity_input input = input_of(p, j, theta[j], &at);
        double mu_rate = 0.0;
        status = rb_sensitivity_rates(s, &input, &rate, &mu_rate, why);
        if (status == RB_OK)
            /* Adjoint times the rates of the data (D3); mu itself also scales Q/(mu P). */
            row[j] = rb_sensitivity_dot(&adjoint, &rate) - (ratio ? f / q->mu * mu_rate : 0.0);
        rb_sensitivity_rate_free(&rate);
    }
    rb_sensitivity_rate_free(&adjoint);
    rb_contact_state_free(&weight);
    return status;
}

double rb_case_fit_residual(const fit_problem *p, int k, double model)
{
    return (model - p->data->force[k]) / sigma_of(p, k);
}

void rb_case_fit_release(fit_problem *p, int which)
{
    for (int k = p->points - 1; p->at && k >= 0 && which >= 0; k--) {
        rb_sensitivity_free(p->at[k].factors[which]);
        p->at[k].factors[which] = NULL;
        rb_rolling_variant_free(model_below(p, k, which), &p->at[k].solved[which]);
    }
}

/* The factors of a solved point: with those of the first point with its elements. */
static rb_status factorise(fit_problem *p, int k, int which, rb_message *why)
{
    rb_sensitivity **own = &p->at[k].factors[which], *like = p->at[p->at[k].first].factors[which];

    return *own ? RB_OK : rb_sensitivity_create_like(&p->at[k].solved[which], like, own, why);
}

/* Solves a point for a trial; the first of those that share elements makes the
 * flexibility.  It follows its solution with the accepted numbers or, if there is none,
 * the solution of the point before it. */
static rb_status solve_point(fit_problem *p, const double *theta, int k, int trial, rb_message *why)
{
    const fit_point *at = &p->at[k];
    const rb_rolling_model *of = model_below(p, k, trial);
    const int is_first = p->accepted < 0,
              follows = !is_first || (k > 0 && at->first == p->at[k - 1].first),
              from = is_first ? k - 1 : k, which = is_first ? trial : p->accepted;
    rb_rolling_model *v = &p->at[k].solved[trial];
    place here = {p, theta, k, -1};
    rb_rolling_case rc;
    rb_status s = case_at(&here, 0.0, &rc, why);

    if (s == RB_OK)
        s = at->first == k ? rb_rolling_variant_place(of, &rc, 0.0, 1.0, v, why)
                           : rb_rolling_variant_create(of, &rc, 0, 0, NULL, v, why);
    if (s == RB_OK)
        s = rb_rolling_model_add_matrix(v, why);
    if (s != RB_OK)
        return s;
    /* First along the tangents of the solution that is followed; if its zones have changed too
     * much, by Newton's method from its zones. */
    s = follows ? factorise(p, from, which, why) : RB_MAXITER;
    if (s == RB_OK)
        s = rb_sensitivity_follow(p->at[from].factors[which], v, why);
    if (s > 0) {
        rb_rolling_variant_set(follows ? &p->at[from].solved[which].state : &of->state, NULL, 0.0,
                               &v->state);
        s = rb_rolling_variant_complete(v, NULL, NULL, why);
        s = s == RB_OK ? rb_rolling_model_resolve(v, 1, why) : s;
    }
    return s;
}

rb_status rb_case_fit_try(fit_problem *p, const double *theta, double *chi2, rb_message *why)
{
    /* Two sets of solutions: the accepted one and that of the present trial. */
    const int trial = p->accepted == 0;
    rb_status s = RB_OK;

    rb_case_fit_release(p, trial);
    for (int k = 0; k < p->points && s == RB_OK; k++) {
        s = solve_point(p, theta, k, trial, why);
        if (s == RB_OK)
            p->f[k] = rb_case_fit_residual(p, k, measured_force(p, &p->at[k].solved[trial]));
    }
    *chi2 = s == RB_OK ? fit_dot(p->points, p->f, p->f) : INFINITY;
    return s;
}

rb_status rb_case_fit_accept(fit_problem *p, const double *theta, rb_message *why)
{
    /* The trial becomes the accepted set, and gets its Jacobian: points x n, over sigma. */
    const int trial = p->accepted == 0;
    rb_status s = RB_OK;

    rb_case_fit_release(p, p->accepted);
    p->accepted = trial;
    p->kappa = 0.0;
    for (int k = 0; k < p->points && s == RB_OK; k++) {
        const rb_rolling_model *model = &p->at[k].solved[trial];
        double row[RB_CASE_FIT_MAX], kappa = NAN;
        s = factorise(p, k, trial, why);
        if (s == RB_OK && rb_rolling_law_depends_on_state(model->rc))
            s = rb_rolling_law_kappa(model, &kappa);
        if (s == RB_OK)
            s = differentiate_force(p, theta, k, model, p->at[k].factors[trial], row, why);
        if (s != RB_OK)
            break;
        p->kappa = fmax(p->kappa, kappa);
        p->fit->model[k] = measured_force(p, model);
        for (int j = 0; j < p->n; j++)
            p->J[(size_t)k + (size_t)j * (size_t)p->points] = row[j] / sigma_of(p, k);
    }
    for (int j = 0; j < p->n && s == RB_OK; j++)
        p->staying[j] = rb_norm_inf((size_t)p->points, fit_column(p, j));
    return s;
}

rb_status rb_case_fit_extend(fit_problem *p, const double *theta, int k, int element, int zone,
                             double *f, double *row, rb_message *why)
{
    const rb_rolling_model *model = &p->at[k].solved[p->accepted];
    rb_rolling_model v = {.mesh = {.n = 0}};
    rb_sensitivity *s = NULL;
    rb_status status =
        rb_sensitivity_extend(p->at[k].factors[p->accepted], element, zone, &v, &s, why);

    if (status == RB_OK)
        status = differentiate_force(p, theta, k, &v, s, row, why);
    for (int j = 0; j < p->n && status == RB_OK; j++)
        row[j] /= sigma_of(p, k);
    if (status == RB_OK)
        *f = rb_case_fit_residual(p, k, measured_force(p, &v));
    rb_sensitivity_free(s);
    rb_rolling_variant_free(model, &v);
    return status;
}

/* Friction of similar bodies does not change the pressure: then the edges of the contact
 * do not depend on the creepage. */
static int shares_elements(const fit_problem *p, int k, int with)
{
    const fit_point *first = &p->at[with];
    const rb_contact_problem *q = &first->base.problem;

    return first->first == with && are_alike(p->data, k, with) &&
           !rb_contact_operator_response(q->op).coupled &&
           rb_norm_inf((size_t)q->n, q->load_T) == 0.0;
}

rb_status rb_case_fit_place(fit_problem *p, const double *theta, int *moved, rb_message *why)
{
    rb_status s = RB_OK;

    /* Elements for theta, made anew; *moved: 1 if any differ from the present ones by more than
     * rounding. */
    *moved = 0;
    rb_case_fit_release(p, p->accepted == 0);
    rb_case_fit_release(p, p->accepted);
    p->accepted = -1;
    for (int k = 0; k < p->points && s == RB_OK; k++) {
        fit_point *of = &p->at[k];
        place at = {p, theta, k, -1};
        rb_rolling_case rc;
        rb_rolling_model fresh = {.mesh = {.n = 0}};

        of->first = 0;
        while (of->first < k && !shares_elements(p, k, of->first))
            of->first++;
        s = of->first < k ? RB_OK : case_at(&at, 0.0, &rc, why);
        if (s == RB_OK && of->first == k)
            s = rb_rolling_model_create(&rc, &fresh, why);
        if (s == RB_OK && fresh.mesh.n >= RB_ROLLING_LARGE)
            s = rb_refuse(why, "contact-elements,zone",
                          "expected fewer than %d elements, got %d; give fewer by "
                          "--contact-elements or a smaller --zone",
                          RB_ROLLING_LARGE, fresh.mesh.n);
        if (s == RB_OK && of->first == k) /* an adjoint takes its factors */
            s = rb_rolling_model_add_matrix(&fresh, why);
        const rb_rolling_mesh *old = &of->base.mesh, *mesh = &fresh.mesh;
        *moved |= old->n != mesh->n;
        for (int i = 0; i <= mesh->n && mesh->n > 0 && !*moved; i++)
            *moved = fabs(mesh->ends[i] - old->ends[i]) >
                     SAME_PLACE * (mesh->ends[mesh->n] - mesh->ends[0]);
        rb_rolling_model_free(&of->base);
        of->base = fresh;
    }
    return s;
}

rb_status rb_case_fit_sum(fit_problem *p, const double *theta, double limit, double *f, double *sum,
                          rb_message *why)
{
    const int stays = !p->moves && p->accepted >= 0, trial = p->accepted == 0;
    rb_status s = RB_OK;

    /* The sum with fresh elements where they move, else on those that stay. It ends early beyond
     * the limit, so that points which have exceeded it come first. */
    *sum = 0.0;
    if (stays)
        rb_case_fit_release(p, trial);
    for (int i = 0; i < p->points && s == RB_OK && *sum <= limit; i++) {
        const int k = p->order[i], first = p->at[k].first;
        place at = {p, theta, k, -1};
        rb_rolling_case rc;
        rb_rolling_model own = {.mesh = {.n = 0}};
        const rb_rolling_model *model = stays ? &p->at[k].solved[trial] : &own;
        if (!stays) {
            s = case_at(&at, 0.0, &rc, why);
            if (s == RB_OK)
                s = rb_rolling_model_create(&rc, &own, why);
        } else {
            if (!p->at[first].solved[trial].state.p) /* it makes the flexibility */
                s = solve_point(p, theta, first, trial, why);
            if (s == RB_OK && !model->state.p)
                s = solve_point(p, theta, k, trial, why);
        }
        const double residual =
            s == RB_OK ? rb_case_fit_residual(p, k, measured_force(p, model)) : NAN;
        *sum += residual * residual;
        if (f)
            f[k] = residual;
        if (*sum > limit) { /* the next sum asks this point first */
            memmove(p->order + 1, p->order, (size_t)i * sizeof *p->order);
            p->order[0] = k;
        }
        rb_rolling_model_free(&own);
    }
    if (s == RB_OK || s == RB_ENOMEM || s == RB_INTERRUPTED)
        return s;
    *sum = INFINITY;
    return RB_OK;
}

rb_status rb_case_fit_kappa(fit_problem *p, const double *theta, double memory, double *kappa,
                            rb_message *why)
{
    rb_status s = RB_OK;

    *kappa = 0.0;
    for (int k = 0; k < p->points && s == RB_OK; k++) {
        place at = {p, theta, k, -1};
        rb_rolling_case rc, even;
        rb_rolling_model model = {.mesh = {.n = 0}};
        double own = 0.0;
        if (k > 0 && are_alike(p->data, k, k - 1))
            continue;
        s = case_at(&at, 0.0, &rc, why);
        if (s != RB_OK)
            break;
        /* kappa is that of the contact with constant friction, which has one solution. */
        even = rc;
        even.friction = (rb_rolling_friction){.law = RB_FRICTION_constant};
        if (!isnan(memory))
            rc.friction.memory = memory;
        s = rb_rolling_model_create(&even, &model, why);
        rb_rolling_model falling = model;
        falling.rc = &rc;
        if (s == RB_OK && rb_rolling_law_depends_on_state(&rc))
            s = rb_rolling_law_kappa(&falling, &own);
        *kappa = fmax(*kappa, own);
        rb_rolling_model_free(&model);
    }
    return s;
}

rb_status rb_case_fit_move(fit_problem *p, const double *theta, rb_message *why)
{
    const int ratio = p->data->measure == RB_CASE_FORCE_RATIO;
    rb_status status = RB_OK;

    p->kappa = 0.0;
    for (int k = 0; k < p->points && status == RB_OK; k++) {
        place at = {p, theta, k, -1};
        double kappa = NAN;
        rb_rolling_case rc;
        rb_rolling_model own = {.mesh = {.n = 0}};
        const int is_first = p->at[k].first == k; /* its base is the solution for theta */
        const rb_rolling_model *model = is_first ? &p->at[k].base : &own;
        rb_sensitivity *s = NULL;
        status = is_first ? RB_OK : case_at(&at, 0.0, &rc, why);
        if (status == RB_OK && !is_first)
            status = rb_rolling_model_create(&rc, &own, why);
        if (status == RB_OK && rb_rolling_law_depends_on_state(model->rc))
            status = rb_rolling_law_kappa(model, &kappa);
        p->kappa = fmax(p->kappa, kappa);
        if (status == RB_OK)
            status = rb_sensitivity_create(model, 1, &s, why);
        for (int j = 0; j < p->n && status == RB_OK; j++) {
            place varied = {p, theta, k, j};
            const rb_sensitivity_input input = input_of(p, j, theta[j], &varied);
            rb_sensitivity_derivative d;
            status = rb_sensitivity_differentiate(s, &input, &d, why);
            const rb_rolling_solution *by = &d.value[d.has[1]];
            const double P = rb_contact_load(&model->problem, &model->state),
                         Q = rb_contact_force(&model->problem, &model->state),
                         force = by->tangential_load;
            fit_column(p, j)[k] = (ratio ? by->force_ratio
                                   : p->data->measure == RB_CASE_FORCE_OVER_LOAD
                                       ? (force - Q / P * by->normal_load) / P
                                       : force) /
                                  sigma_of(p, k);
            rb_sensitivity_derivative_free(&d);
        }
        rb_sensitivity_free(s);
        rb_rolling_model_free(&own);
    }
    /* What moving elements leave of a derivative by rounding is no derivative. */
    for (int j = 0; j < p->n && status == RB_OK; j++)
        if (rb_norm_inf((size_t)p->points, fit_column(p, j)) < NONE * p->staying[j])
            memset(fit_column(p, j), 0, (size_t)p->points * sizeof(double));
    return status;
}
