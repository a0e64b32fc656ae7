/* How a case is solved: pivots of Lemke's method, steps of Newton's, zones that are guessed,
 * proofs. */
#include "program/api/internal.h"

#include <stdlib.h>
#include <string.h>

/* 1: the matrices are there; otherwise the call has ended. */
static int has_model(rb_api *a)
{
    rb_rolling_model *model = &a->result.model;
    rb_api_call_begins(a);
    rb_status s = model->state.p ? rb_rolling_model_add_matrix(model, &a->why) : RB_OK;
    s = rb_api_call_ends(a, s);

    if (s != RB_OK)
        rb_api_ended(a, s);
    else if (!model->state.p || !model->bodies.F)
        rb_api_refuse(a, "there is no solved case whose matrices are available");
    else
        return 1;
    return 0;
}

static rb_status keep_tractions(rb_api *a, const rb_lcp_pivot *p, const double *value)
{
    const int n = a->result.model.mesh.n;
    double *z = rb_alloc((size_t)p->n, 1);
    rb_contact_state state = {0};
    rb_status s = z ? rb_contact_state_alloc(n, &state) : RB_ENOMEM;
    for (int i = 0; s == RB_OK && i < p->n; i++)
        if (p->basis[i] >= p->n && p->basis[i] < 2 * p->n)
            z[p->basis[i] - p->n] = value[i];
    if (s == RB_OK) {
        rb_contact_lcp_recover(&a->result.model.problem, &a->lcp, z, &state);
        s = rb_api_add_column(a, "pivot.p", n, state.p);
    }
    if (s == RB_OK)
        s = rb_api_add_column(a, "pivot.q", n, state.q);
    rb_contact_state_free(&state);
    free(z);
    return s;
}

static void each_pivot(const rb_lcp_pivot *p, void *context)
{
    rb_api *a = context;
    const size_t n = (size_t)p->n;
    double *value = rb_alloc(3 * n, 1), *column = value ? value + n : NULL,
           *basis = value ? value + 2 * n : NULL;
    const double entering = p->entering, leaving = p->leaving, row = p->row;
    const struct {
        const char *name;
        const double *x;
        int rows;
    } kept[] = {{"pivot.before", value, p->n},    {"pivot.column", column, p->n},
                {"pivot.basis", basis, p->n},     {"pivot.value", &p->tableau[n * (n + 1)], p->n},
                {"pivot.entering", &entering, 1}, {"pivot.leaving", &leaving, 1},
                {"pivot.row", &row, 1},           {"pivot.ratio", &p->ratio, 1},
                {"pivot.z0", &p->z0, 1}};

    if (a->status == RB_OK && !value)
        a->status = RB_ENOMEM;
    /* The column of the entering variable and the values of the basic ones, before the
     * pivot: of the last pivot's tableau, or of z0, which enters first with a column of
     * ones. */
    for (size_t i = 0; i < n && value; i++) {
        value[i] = a->pivots > 0 ? a->tableau[n * (n + 1) + i] : a->lcp.b[i];
        column[i] = 1.0;
        basis[i] = p->basis[i];
    }
    for (size_t j = 0; j <= n && value && a->pivots > 0; j++)
        if (a->nonbasis[j] == p->entering)
            memcpy(column, &a->tableau[n * j], n * sizeof *column);
    for (size_t k = 0; a->status == RB_OK && k < sizeof kept / sizeof *kept; k++)
        a->status = rb_api_add_column(a, kept[k].name, kept[k].rows, kept[k].x);
    if (a->status == RB_OK)
        a->status = keep_tractions(a, p, &p->tableau[n * (n + 1)]);
    free(value);
    memcpy(a->tableau, p->tableau, n * (n + 2) * sizeof *a->tableau);
    memcpy(a->nonbasis, p->nonbasis, (n + 1) * sizeof *a->nonbasis);
    a->pivots++;
}

int rb_api_pivots(rb_api *a)
{
    const rb_rolling_model *model = &a->result.model;
    rb_api_forget_call(a);
    if (!has_model(a))
        return a->status;
    rb_api_forget_arrays(a, "pivot.");
    rb_api_forget_arrays(a, "lcp.");
    rb_contact_lcp_free(&a->lcp);
    memset(&a->lcp, 0, sizeof a->lcp);
    rb_status s = rb_rolling_model_lcp(model, &a->lcp, &a->why);
    if (s != RB_OK)
        return rb_api_ended(a, s);
    const size_t n = (size_t)a->lcp.size;
    const rb_lcp_problem p = {a->lcp.size, a->lcp.M, a->lcp.size, a->lcp.b};
    rb_lcp_options options = rb_lcp_defaults();
    rb_lcp_info info = {0};
    double *z = rb_alloc(n, 1);
    a->tableau = rb_alloc(n, n + 2);
    a->nonbasis = rb_alloc_int(n + 1);
    a->pivots = 0;
    a->status = RB_OK;
    options.trace = each_pivot;
    options.trace_context = a;
    options.trace_tableau = 1;
    rb_api_call_begins(a);
    s = z && a->tableau && a->nonbasis ? rb_lcp_lemke(&p, &options, z, &info) : RB_ENOMEM;
    if (s < 0)
        a->why = info.msg;
    else if (a->status != RB_OK)
        s = a->status;
    s = rb_api_call_ends(a, s);
    free(z);
    free(a->tableau);
    free(a->nonbasis);
    a->tableau = NULL;
    a->nonbasis = NULL;
    return rb_api_ended(a, s);
}

/* A step of Newton's method on the elements of the case; it may begin on half as many. */
static void keep_newton_step(const rb_contact_state *state, void *context)
{
    rb_api *a = context;

    if (a->status == RB_OK && state->n == a->result.model.mesh.n)
        a->status = rb_api_add_state(a, "newton", state);
}

int rb_api_prove(rb_api *a)
{
    const rb_rolling_model *model = &a->result.model;
    rb_api_forget_call(a);
    if (!has_model(a))
        return a->status;
    rb_api_call_begins(a);
    rb_status s = rb_rolling_model_prove(model, &a->result.solution.proof, &a->why);
    return rb_api_ended(a, rb_api_call_ends(a, s));
}

int rb_api_newton(rb_api *a)
{
    rb_contact_state state = {0};
    rb_api_forget_call(a);
    if (!has_model(a))
        return a->status;
    rb_contact_problem problem = a->result.model.problem; /* arrays stay the model's */
    rb_rolling_case rc = *a->result.model.rc;
    rc.contact.solver = RB_SOLVER_NEWTON;
    problem.trace = keep_newton_step;
    problem.trace_context = a;
    rb_api_forget_arrays(a, "newton.");
    a->status = RB_OK;
    rb_api_call_begins(a);
    rb_status s = rb_contact_state_alloc(problem.n, &state);
    if (s == RB_OK)
        s = rb_rolling_problem_solve(&problem, &rc, 0, &state, &a->why);
    if (s >= 0 && a->status != RB_OK)
        s = rb_fail(&a->why, a->status, "out of memory");
    s = rb_api_call_ends(a, s);
    rb_contact_state_free(&state);
    return rb_api_ended(a, s);
}

const char *rb_api_variable(const rb_api *a, int variable, char *text, int size)
{
    char name[RB_CONTACT_VARIABLE];
    if (variable < 0 || variable > 2 * a->lcp.size || a->lcp.size == 0)
        return NULL;
    return rb_api_written(rb_contact_lcp_variable(&a->lcp, a->result.model.mesh.n, variable, name),
                          text, size);
}

int rb_api_guess(rb_api *a, int n, const int *zone)
{
    rb_rolling_model *model = &a->result.model;
    rb_api_forget_call(a);
    if (!has_model(a))
        return a->status;
    if (n != model->mesh.n)
        return rb_api_refuse(a, "%d zones: expected %d", n, model->mesh.n);
    if (model->problem.yield)
        return rb_api_refuse(
            a, "zones do not determine the plastic slip of an interface (--yield-stress)");
    rb_contact_state state = {0};
    double *gap = rb_alloc((size_t)n, 1);
    rb_status s = gap ? rb_contact_state_alloc(n, &state) : RB_ENOMEM;
    rb_api_forget_arrays(a, "guess.");
    rb_api_call_begins(a);
    if (s == RB_OK) {
        memcpy(state.zone, zone, (size_t)n * sizeof *zone);
        s = rb_contact_try_zones(&model->problem, &state, gap);
    }
    s = rb_api_call_ends(a, s);
    if (s == RB_OK && !(rb_api_copy_array(a, "guess.p", n, 1, state.p) &&
                        rb_api_copy_array(a, "guess.q", n, 1, state.q) &&
                        rb_api_copy_array(a, "guess.gap", n, 1, gap) &&
                        rb_api_copy_array(a, "guess.shift", n, 1, state.lambda)))
        s = RB_ENOMEM;
    rb_contact_state_free(&state);
    free(gap);
    return rb_api_ended(a, s);
}
