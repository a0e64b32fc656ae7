/* The contact problem (K1)-(K3): its arrays, and forces and moment of tractions by sums (4.6). */
#include "lcp/contact/internal.h"

#include <cblas.h>
#include <stdlib.h>
#include <string.h>

enum { ROWS = 10 };

/* The arrays of a problem, n numbers each. */
static void list_rows(rb_contact_problem *p, double **row[ROWS])
{
    double **const rows[ROWS] = {&p->bound,  &p->d_N,     &p->d_T,     &p->e_T,      &p->load_N,
                                 &p->load_T, &p->force_N, &p->force_T, &p->moment_N, &p->moment_T};
    memcpy(row, rows, sizeof rows);
}

void rb_contact_problem_free(rb_contact_problem *p)
{
    double **row[ROWS];

    list_rows(p, row);
    for (int k = 0; k < ROWS; k++)
        free(*row[k]);
    rb_contact_operator_free(p->op);
    free(p->yield);
    memset(p, 0, sizeof *p);
}

rb_status rb_contact_problem_alloc_rows(rb_contact_problem *p)
{
    double **row[ROWS];
    int complete = 1;

    list_rows(p, row);
    for (int k = 0; k < ROWS; k++) {
        *row[k] = rb_alloc((size_t)p->n, 1);
        complete = complete && *row[k];
    }
    if (complete)
        return RB_OK;
    rb_contact_problem_free(p);
    return RB_ENOMEM;
}

rb_status rb_contact_problem_alloc(rb_contact_operator *op, rb_contact_problem *p)
{
    *p = (rb_contact_problem){.op = op, .n = op->n};
    return rb_contact_problem_alloc_rows(p);
}

rb_status rb_contact_problem_borrow(rb_contact_operator *op, rb_contact_problem *p)
{
    *p = (rb_contact_problem){.n = op->n};
    const rb_status s = rb_contact_problem_alloc_rows(p);
    p->op = s == RB_OK ? op : NULL;
    return s;
}

void rb_contact_set_friction(rb_contact_problem *p, double mu, const double *bound)
{
    p->mu = mu;
    for (int i = 0; i < p->n; i++)
        p->bound[i] = bound ? bound[i] : mu;
}

double rb_contact_friction_scale(const rb_contact_problem *p)
{
    return p->mu > 0.0 ? p->mu * p->stress : p->stress;
}

double rb_contact_force_scale(const rb_contact_problem *p)
{
    return p->mu * p->stress * rb_norm_1((size_t)p->n, p->load_N, 1);
}

static double weighted(const rb_contact_state *state, const double *a_N, const double *a_T)
{
    return cblas_ddot(state->n, a_N, 1, state->p, 1) + cblas_ddot(state->n, a_T, 1, state->q, 1);
}

double rb_contact_load(const rb_contact_problem *p, const rb_contact_state *state)
{
    return weighted(state, p->load_N, p->load_T); /* load_T: 0 unless normals are the surface's */
}

double rb_contact_force(const rb_contact_problem *p, const rb_contact_state *state)
{
    return weighted(state, p->force_N, p->force_T);
}

double rb_contact_moment(const rb_contact_problem *p, const rb_contact_state *state)
{
    return weighted(state, p->moment_N, p->moment_T);
}

/* mu P less what elements with a smaller bound carry less than mu: the sum of bound r_N would not
 * be mu P to the last digit where all bounds are mu, and a ratio of 1 is full sliding. */
double rb_contact_capacity(const rb_contact_problem *p, const rb_contact_state *state)
{
    const double P = rb_contact_load(p, state);
    double less = 0.0;

    for (int i = 0; i < p->n; i++)
        less += (p->mu - p->bound[i]) * (p->load_N[i] * state->p[i] + p->load_T[i] * state->q[i]);
    return p->mu * P - less;
}

/* All that can be given is one equation (4.6), Q = force + force_ratio (sum of bound_i P_i) - axle
 * M: a force, a part of what friction carries, or the moment on a free axle.  Terms with unknown
 * tractions stand on the left. */
void rb_contact_force_row(const rb_contact_problem *p, double *control_N, double *control_T)
{
    for (int i = 0; i < p->n; i++) {
        const double share = p->force_ratio * p->bound[i];
        control_N[i] = p->force_N[i] - share * p->load_N[i] + p->axle * p->moment_N[i];
        control_T[i] = p->force_T[i] - share * p->load_T[i] + p->axle * p->moment_T[i];
    }
}

int rb_contact_has_steps_left(const rb_contact_problem *problem, const rb_contact_state *state)
{
    return problem->step_limit == 0 || state->iterations < problem->step_limit ||
           rb_contact_operator_matrix(problem->op).F;
}

/* Then no element sticks, so that no equation fixes xi: force.c has a way of its own. */
int rb_contact_slides_fully(const rb_contact_problem *problem)
{
    return problem->force_given && problem->force == 0.0 && problem->axle == 0.0 &&
           fabs(problem->force_ratio) >= 1.0 - 1e-12;
}
