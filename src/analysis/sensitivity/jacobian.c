/* The Jacobian of a contact whose zones are known (theory-solvers.md, D1), and its solves. */
#include "analysis/sensitivity/internal.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void rb_sensitivity_factors_free(rb_sensitivity_factors *f)
{
    if (!f)
        return;
    free(f->contact);
    free(f->zone);
    free(f->J);
    free(f->unknown);
    free(f->row);
    free(f->pivot);
    free(f);
}

static int slides(int zone)
{
    return zone == RB_ZONE_SLIP_NEGATIVE || zone == RB_ZONE_SLIP_POSITIVE;
}

static int yields(int zone)
{
    return zone > RB_ZONE_SLIP_POSITIVE;
}

/* r_T = sign bound r_N, or sign times the yield stress. */
static double sign_of(int zone)
{
    return zone == RB_ZONE_SLIP_NEGATIVE || zone == RB_ZONE_YIELD_NEGATIVE ? -1.0 : 1.0;
}

/* J is size x size, column-major, size = 2 m + 2 for m elements in contact. Unknowns: p of them,
 * delta, q of them, xi. Rows: gaps, P or delta, stick, slip or yield, Q or xi. */
static rb_sensitivity_factors *factors_alloc(int n, const int *zone)
{
    rb_sensitivity_factors *f = calloc(1, sizeof *f);

    if (!f)
        return NULL;
    f->contact = rb_alloc_int((size_t)n);
    f->zone = rb_alloc_int((size_t)n);
    for (int i = 0; i < n && f->contact && f->zone; i++) {
        f->zone[i] = zone[i];
        if (zone[i] != RB_ZONE_SEPARATED)
            f->contact[f->contacts++] = i;
    }
    f->size = 2 * f->contacts + 2;
    const size_t size = (size_t)f->size;
    f->J = rb_alloc(size, size);
    f->unknown = rb_alloc(size, 1);
    f->row = rb_alloc(size, 1);
    f->pivot = rb_alloc_int(size);
    if (f->contact && f->zone && f->J && f->unknown && f->row && f->pivot)
        return f;
    rb_sensitivity_factors_free(f);
    return NULL;
}

/* How the tangential unknowns of element i depend on those of others: the friction of an element
 * that slides on the slips that the law asks, that of one that yields on what has yielded upstream,
 * which where the surfaces slip, too, is what mu p asks. weight: n, of the slips; force: n, of the
 * friction; pressure: n. */
static void dependence(const rb_sensitivity *s, const int *zone, int i, double *weight,
                       double *force, double *pressure)
{
    const rb_contact_problem *p = &s->model->problem;
    const size_t n = (size_t)s->n;
    /* r_T = sign bound(v) r_N: its derivative by a slip is sign r_N dbound/dv, on the left side
     * with a minus (D1, F1). */
    const double friction = sign_of(zone[i]) * s->model->state.p[i];

    memset(weight, 0, n * sizeof *weight);
    memset(force, 0, n * sizeof *force);
    memset(pressure, 0, n * sizeof *pressure);
    if (slides(zone[i]) && s->law_slip)
        for (size_t j = 0; j < n; j++) {
            weight[j] = zone[j] != RB_ZONE_STICK ? -friction * s->law_slip[(size_t)i + j * n] : 0.0;
            force[j] = s->law_force && zone[j] != RB_ZONE_SEPARATED
                           ? -friction * s->law_force[(size_t)i + j * n]
                           : 0.0;
        }
    /* what has softened away carries nothing, whatever it yields further */
    const int carries = fabs(s->model->state.q[i]) > 1e-9 * rb_contact_friction_scale(p);
    if (!yields(zone[i]) || p->hardening == 0.0 || !carries)
        return;
    double now = -sign_of(zone[i]) * p->hardening, next = 0.0;
    for (int j = i; j < s->n; j++) { /* u_i in those upstream of it */
        /* u is transported from element to element by `recall` (Y1); where the surfaces slip, too,
         * mu p fixes u, and the chain ends. */
        const int ends = slides(zone[j]) && rb_contact_slips_and_yields(p, &s->model->state, j);
        const double after = (ends ? 0.0 : p->recall[0] * now) + next;
        if (ends)
            pressure[j] = now * p->bound[j] / p->hardening;
        else if (yields(zone[j]))
            weight[j] = -sign_of(zone[j]) * p->own * now;
        next = ends ? 0.0 : p->recall[1] * now;
        now = after;
    }
}

/* Adds to row r, which is J + r, the slips of the elements from..to-1 times `weight`. */
static void add_slips(const rb_sensitivity *s, const rb_sensitivity_factors *f, int from, int to,
                      const double *weight, double *r)
{
    const rb_contact_problem *p = &s->model->problem;
    const rb_contact_matrix K = rb_contact_operator_matrix(p->op);
    const size_t n = (size_t)s->n, ld = (size_t)f->size;
    const int some = to - from;

    /* S = A F_T of (K2), whose first n columns belong to p and whose last n to q; e_T to xi. */
    for (int c = 0; c < f->contacts; c++) {
        const double *by_p = K.S + from + (size_t)f->contact[c] * n, *by_q = by_p + n * n;
        double *of_p = r + (size_t)c * ld, *of_q = r + (size_t)(f->contacts + 1 + c) * ld;
        *of_p += some == 1 ? *weight * *by_p : cblas_ddot(some, weight, 1, by_p, 1);
        *of_q += some == 1 ? *weight * *by_q : cblas_ddot(some, weight, 1, by_q, 1);
    }
    for (int k = 0; k < some; k++)
        r[(size_t)(f->size - 1) * ld] += weight[k] * p->e_T[from + k];
}

/* (D1) stick, slip or yield of element contact[c]. */
static void fill_element(const rb_sensitivity *s, rb_sensitivity_factors *f, int c, double *weight)
{
    const rb_contact_problem *p = &s->model->problem;
    const int m = f->contacts, i = f->contact[c], zone = f->zone[i];
    const size_t n = (size_t)s->n, ld = (size_t)f->size;
    double *tangential = f->J + m + 1 + c, *force = weight + n, *pressure = force + n;

    f->row[m + 1 + c] = 1.0 / (zone == RB_ZONE_STICK ? p->slip_length : p->stress);
    if (zone == RB_ZONE_STICK) {
        add_slips(s, f, i, i + 1, &(double){1.0}, tangential);
        return;
    }
    /* q - sign bound p = 0 of an element that slides. */
    tangential[(size_t)(m + 1 + c) * ld] = 1.0;
    if (slides(zone))
        tangential[(size_t)c * ld] = -sign_of(zone) * p->bound[i];
    if (slides(zone) && s->law_xi)
        tangential[(size_t)(f->size - 1) * ld] =
            -sign_of(zone) * s->model->state.p[i] * s->law_xi[i];
    dependence(s, f->zone, i, weight, force, pressure);
    int from = 0, to = s->n;
    while (from < to && weight[from] == 0.0)
        from++;
    while (to > from && weight[to - 1] == 0.0)
        to--;
    if (from < to)
        add_slips(s, f, from, to, weight + from, tangential);
    for (int k = 0; k < m; k++) {
        tangential[(size_t)k * ld] += pressure[f->contact[k]];
        tangential[(size_t)(m + 1 + k) * ld] += force[f->contact[k]];
    }
}

/* xi is in proportion to the half-width by formula, Hertz's or that with a third body or memory:
 * d ln a/d ln P by differences of fourth order. */
double rb_sensitivity_xi_by_load(const rb_rolling_model *model)
{
    static const double STEP = 1e-3;
    const rb_rolling_case *rc = model->rc;
    const rb_contact_problem *p = &model->problem;
    const double P = rb_contact_load(p, &model->state);
    double half[2];

    if (p->force_given || p->load_given || rc->formulation == RB_STATIC || isnan(rc->creep_ratio) ||
        !(P > 0.0))
        return 0.0;
    for (int k = 0; k < 2; k++) {
        const double step = (k + 1) * STEP;
        half[k] = log(rb_rolling_contact_half_width(rc, P * exp(step)) /
                      rb_rolling_contact_half_width(rc, P * exp(-step)));
    }
    return p->xi / P * (8.0 * half[0] - half[1]) / (12.0 * STEP);
}

/* The two controls: P or delta, Q (less what friction carries, and the axle's moment) or
 * xi, which under a given approach may be a ratio that asks for the load. */
static void fill_controls(const rb_sensitivity *s, rb_sensitivity_factors *f)
{
    const rb_rolling_model *model = s->model;
    const rb_rolling_case *rc = model->rc;
    const rb_contact_problem *p = &model->problem;
    const int m = f->contacts, law = rb_rolling_law_depends_on_state(rc);
    const size_t ld = (size_t)f->size;
    double *normal = f->J + m, *tangential = f->J + 2 * m + 1;
    const double share = p->force_given && law && p->axle == 0.0 && !isnan(rc->force_ratio)
                             ? rc->force_ratio * p->mu
                             : rb_sensitivity_xi_by_load(model);

    for (int c = 0; c < m; c++) {
        const int i = f->contact[c];
        /* Q less the given part of what friction carries. */
        const double carried = share + p->force_ratio * p->bound[i];
        double *of_p = tangential + (size_t)c * ld, *of_q = of_p + (size_t)(m + 1) * ld;
        if (p->load_given) {
            normal[(size_t)c * ld] = p->load_N[i];
            normal[(size_t)(m + 1 + c) * ld] = p->load_T[i];
        }
        *of_p = -carried * p->load_N[i];
        *of_q = -carried * p->load_T[i];
        if (p->force_given) {
            *of_p += p->force_N[i] + p->axle * p->moment_N[i];
            *of_q += p->force_T[i] + p->axle * p->moment_T[i];
        }
    }
    if (!p->load_given)
        normal[(size_t)m * ld] = 1.0;
    if (!p->force_given)
        tangential[(size_t)(2 * m + 1) * ld] = 1.0;
    f->row[m] = 1.0 / (p->load_given ? p->load : p->gap_length);
    f->row[2 * m + 1] = p->force_given ? 1.0 / (p->mu * p->stress * model->bodies.f.h[0])
                                       : p->e_T[0] / p->slip_length;
}

/* 1: elements in contact have the same normal flexibility in both problems. */
static int same_normal_flexibility(const rb_contact_problem *x, const rb_contact_problem *y,
                                   const rb_sensitivity_factors *f)
{
    const rb_contact_matrix K = rb_contact_operator_matrix(x->op),
                            L = rb_contact_operator_matrix(y->op);

    for (int j = 0; j < f->contacts && x->op != y->op; j++) {
        const double *of_x = K.F + (size_t)K.ldf * (size_t)f->contact[j],
                     *of_y = L.F + (size_t)L.ldf * (size_t)f->contact[j];
        for (int i = 0; i < f->contacts; i++)
            if (of_x[f->contact[i]] != of_y[f->contact[i]])
                return 0;
    }
    return 1;
}

/* Equations that determine p and delta alone have the factors of `other`, if it has the
 * same flexibility and the same elements in contact. */
static int takes_first_block(const rb_sensitivity *s, const rb_sensitivity *other,
                             rb_sensitivity_factors *f)
{
    const rb_sensitivity_factors *like = other->factors;
    const size_t bytes = (size_t)f->contacts * sizeof *f->contact, size = (size_t)f->size;

    if (!like || f->first == f->size || like->first != f->first ||
        memcmp(like->contact, f->contact, bytes) != 0 ||
        memcmp(like->row, f->row, (size_t)f->first * sizeof *f->row) != 0 ||
        memcmp(like->unknown, f->unknown, (size_t)f->first * sizeof *f->unknown) != 0 ||
        !same_normal_flexibility(&s->model->problem, &other->model->problem, f))
        return 0;
    for (size_t j = 0; j < (size_t)f->first; j++)
        memcpy(f->J + j * size, like->J + j * size, (size_t)f->first * sizeof *f->J);
    memcpy(f->pivot, like->pivot, (size_t)f->first * sizeof *f->pivot);
    return 1;
}

rb_status rb_sensitivity_factor(const rb_sensitivity *s, const int *zone,
                                const rb_sensitivity *like, rb_sensitivity_factors **factors)
{
    const rb_contact_problem *p = &s->model->problem;
    const rb_contact_matrix K = rb_contact_operator_matrix(p->op);
    rb_sensitivity_factors *f = *factors = factors_alloc(s->n, zone);
    double *scratch = rb_alloc((size_t)s->n, 3);

    if (!f || !scratch) {
        free(scratch);
        return RB_ENOMEM;
    }
    /* Rows and columns are scaled to order one: unknown and row are the units. */
    const int m = f->contacts, size = f->size;
    /* the normal equations alone determine p and delta where friction does not change
     * them */
    const int is_coupled = rb_contact_operator_response(p->op).coupled ||
                           (p->load_given && rb_norm_inf((size_t)s->n, p->load_T) > 0.0);
    const int k = f->first = is_coupled ? size : m + 1, rest = size - k;
    for (int j = 0; j < size; j++)
        f->unknown[j] = j == m          ? p->gap_length
                        : j == size - 1 ? p->slip_length / p->e_T[0]
                                        : p->stress;
    for (int c = 0; c < m; c++) {
        f->row[c] = 1.0 / p->gap_length;
        fill_element(s, f, c, scratch);
    }
    fill_controls(s, f);
    free(scratch);
    const int is_known = like && takes_first_block(s, like, f);
    /* The gap rows: F_NN, -1 for delta, F_NT; xi does not enter. */
    for (int j = 0; j < (is_known ? 0 : k); j++) {
        const int of_q = j > m;
        double *gap = f->J + (size_t)j * (size_t)size;
        const double *F = K.F + (size_t)K.ldf * (of_q ? (size_t)s->n : 0);
        for (int r = 0; r < m; r++)
            gap[r] = j == m || j == size - 1
                         ? (j == m ? -1.0 : 0.0)
                         : F[(size_t)f->contact[r] +
                             (size_t)K.ldf * (size_t)f->contact[of_q ? j - m - 1 : j]];
    }
    for (int j = 0; j < size; j++)
        for (int i = is_known || j >= k ? k : 0; i < size; i++)
            f->J[i + (size_t)j * (size_t)size] *= f->unknown[j] * f->row[i];
    rb_status status =
        is_known
            ? RB_OK
            : rb_lapack_status(LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, k, k, f->J, size, f->pivot));
    /* J is block triangular where friction does not act on the pressure: two smaller
     * factorisations. */
    if (status == RB_OK && rest > 0)
        status = rb_lapack_status(LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, rest, rest,
                                                      f->J + (size_t)k * (size_t)(size + 1), size,
                                                      f->pivot + k));
    return status;
}

/* J x = x, or J' x = x. */
static rb_status back_substitute(const rb_sensitivity_factors *f, char transposed, double *x)
{
    const int k = f->first, rest = f->size - k, ld = f->size;
    const double *of_p = f->J + k, *last = of_p + (size_t)k * (size_t)ld;
    int info = 0;

    if (transposed == 'T' && rest > 0) {
        info =
            LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'T', rest, 1, last, ld, f->pivot + k, x + k, ld);
        cblas_dgemv(CblasColMajor, CblasTrans, rest, k, -1.0, of_p, ld, x + k, 1, 1.0, x, 1);
    }
    if (info == 0)
        info = LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, transposed, k, 1, f->J, ld, f->pivot, x, ld);
    if (transposed == 'N' && rest > 0 && info == 0) {
        cblas_dgemv(CblasColMajor, CblasNoTrans, rest, k, -1.0, of_p, ld, x, 1, 1.0, x + k, 1);
        info =
            LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', rest, 1, last, ld, f->pivot + k, x + k, ld);
    }
    return rb_lapack_status(info);
}

rb_status rb_sensitivity_forward(const rb_sensitivity *s, const rb_sensitivity_factors *f,
                                 const rb_sensitivity_rate *rate, rb_contact_state *tangent)
{
    const rb_contact_state *state = &s->model->state;
    const int m = f->contacts;
    double *x = rb_alloc((size_t)f->size, 1);

    if (!x)
        return RB_ENOMEM;
    /* The right side -R' of (D2). */
    for (int c = 0; c < m; c++) {
        const int i = f->contact[c], zone = f->zone[i];
        x[c] = -rate->gap[i] * f->row[c];
        x[m + 1 + c] = (zone == RB_ZONE_STICK ? -rate->slip[i]
                        : slides(zone)        ? sign_of(zone) * rate->bound[i] * state->p[i]
                                              : sign_of(zone) * rate->yield[i]) *
                       f->row[m + 1 + c];
    }
    x[m] = -rate->normal;
    x[2 * m + 1] = -rate->tangential;
    const rb_status status = back_substitute(f, 'N', x);
    for (int i = 0; i < s->n; i++)
        tangent->p[i] = tangent->q[i] = 0.0;
    for (int c = 0; c < m; c++) {
        tangent->p[f->contact[c]] = f->unknown[c] * x[c];
        tangent->q[f->contact[c]] = f->unknown[m + 1 + c] * x[m + 1 + c];
    }
    tangent->delta = f->unknown[m] * x[m];
    tangent->xi = f->unknown[2 * m + 1] * x[2 * m + 1];
    free(x);
    return status;
}

/* The rates of a linear form of the solution by each of the data: J' x = weight, and -x are the
 * factors of gap, slip, bounds and given values (D3). */
rb_status rb_sensitivity_adjoint(const rb_sensitivity *s, const rb_contact_state *weight,
                                 rb_sensitivity_rate *adjoint, rb_message *why)
{
    const rb_sensitivity_factors *f = s->factors;
    const rb_contact_state *state = &s->model->state;

    if (!f)
        return rb_fail(why, RB_EINVAL, "derivatives: an adjoint needs matrices");
    const int m = f->contacts;
    double *x = rb_alloc((size_t)f->size, 1);
    if (!x)
        return rb_fail(why, RB_ENOMEM, "out of memory for an adjoint");
    for (int c = 0; c < m; c++) {
        x[c] = f->unknown[c] * weight->p[f->contact[c]];
        x[m + 1 + c] = f->unknown[m + 1 + c] * weight->q[f->contact[c]];
    }
    x[m] = f->unknown[m] * weight->delta;
    x[2 * m + 1] = f->unknown[2 * m + 1] * weight->xi;
    const rb_status status = back_substitute(f, 'T', x);
    memset(adjoint->gap, 0, 4 * (size_t)s->n * sizeof *adjoint->gap);
    for (int c = 0; c < m; c++) {
        const int i = f->contact[c], zone = f->zone[i];
        const double tangential = x[m + 1 + c] * f->row[m + 1 + c];
        adjoint->gap[i] = -x[c] * f->row[c];
        if (zone == RB_ZONE_STICK)
            adjoint->slip[i] = -tangential;
        else if (slides(zone))
            adjoint->bound[i] = s->border && s->border[i] == BORDER_REST
                                    ? 0.0 /* alone it rests */
                                    : sign_of(zone) * state->p[i] * tangential;
        else
            adjoint->yield[i] = sign_of(zone) * tangential;
    }
    adjoint->normal = -x[m];
    adjoint->tangential = -x[2 * m + 1];
    free(x);
    return status;
}

double rb_sensitivity_dot(const rb_sensitivity_rate *a, const rb_sensitivity_rate *b)
{
    return cblas_ddot(4 * a->n, a->gap, 1, b->gap, 1) + a->normal * b->normal +
           a->tangential * b->tangential;
}
