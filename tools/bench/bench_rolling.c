/* Where the time of one solution goes, against the numbers of boundary and of contact
 * elements; and Lemke beside Newton on the same problems. */
#include "fast_blas.h"
#include "rows.h"
#include "rolling/rolling.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { RUNS = 5 };

/* A steel wheel on a hub over a rigid plane, steady, equal elements. */
static rb_rolling_case wheel(int elements)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a.young = 210000.0;
    rc.a.poisson = 0.28;
    rc.a.support = RB_BEM_HUB;
    rc.formulation = RB_STEADY;
    rc.load = 1000.0;
    rc.creep_ratio = 0.4;
    rc.contact_elements = elements;
    return rc;
}

/* Median run by total time. */
static rb_rolling_solution median_solution(const rb_rolling_case *rc)
{
    rb_rolling_solution best = {0};
    double total[RUNS];

    for (int k = 0; k < RUNS; k++) {
        rb_rolling_solution_free(&best);
        rb_rolling_solve(rc, &best, NULL);
        total[k] = best.seconds_total;
    }
    gsl_sort(total, 1, RUNS);
    best.seconds_total = total[RUNS / 2];
    return best;
}

static int boundary_elements(const rb_rolling_case *rc)
{
    rb_rolling_model model;
    int n = 0;
    if (rb_rolling_model_create(rc, &model, NULL) == RB_OK && model.bodies.system_a)
        n = rb_bem_system_mesh(model.bodies.system_a)->n;
    rb_rolling_model_free(&model);
    return n;
}

static void stages(void)
{
    static const int contact[] = {50, 100, 200, 400, 800};

    printf("one solution of a wheel on a hub (the zone found, free rolling too)\n\n"
           "| n | n_c | assembly | LU | condensation | LCP | residual |\n"
           "|---|---|---|---|---|---|---|\n");
    for (size_t k = 0; k < sizeof contact / sizeof *contact; k++) {
        const rb_rolling_case rc = wheel(contact[k]);
        rb_rolling_solution s = median_solution(&rc);
        const double percent = 100.0 / s.seconds_total;
        printf("| %d | %d | %.0f %% | %.0f %% | %.0f %% | %.0f %% | %s |\n", boundary_elements(&rc),
               contact[k], percent * s.seconds_assembly, percent * s.seconds_factor,
               percent * s.seconds_condense, percent * s.seconds_lcp,
               row_power(1, s.residual).text);
        rb_rolling_solution_free(&s);
    }
}

/* Processor seconds of the complementarity problem alone, by one solver on one model. */
static double solve_seconds(rb_rolling_model *model, rb_contact_solver solver, int runs)
{
    rb_rolling_case rc = *model->rc;
    rb_contact_state state;
    double best = INFINITY;

    rc.contact.solver = solver;
    if (rb_contact_state_alloc(model->mesh.n, &state) != RB_OK)
        return NAN;
    for (int k = 0; k < runs; k++) {
        const double start = processor_seconds();
        if (rb_rolling_problem_solve(&model->problem, &rc, 0, &state, NULL) != RB_OK)
            best = NAN;
        best = fmin(best, processor_seconds() - start);
    }
    rb_contact_state_free(&state);
    return best;
}

static void lemke_beside_newton(void)
{
    static const int contact[] = {100, 200, 800, 3200};

    printf("\nthe same dense problem by both solvers, dissimilar half-planes, s = 0.4\n\n"
           "| n_c | Lemke | Newton | ratio |\n|---|---|---|---|\n");
    for (size_t k = 0; k < sizeof contact / sizeof *contact; k++) {
        rb_rolling_case rc = wheel(contact[k]);
        rb_rolling_model model;
        rc.a.support = RB_BEM_HALFPLANE;
        rc.gap = RB_GAP_PARABOLA;
        rc.contact.solver = RB_SOLVER_LEMKE; /* keeps the matrix at any size */
        if (rb_rolling_model_create(&rc, &model, NULL) == RB_OK) {
            const int runs = contact[k] > 1000 ? 1 : 3;
            const double lemke = solve_seconds(&model, RB_SOLVER_LEMKE, runs);
            const double newton = solve_seconds(&model, RB_SOLVER_NEWTON, RUNS);
            printf("| %d | %s | %s | %.2g |\n", contact[k], row_seconds(lemke).text,
                   row_seconds(newton).text, lemke / newton);
        }
        rb_rolling_model_free(&model);
    }
}

int main(int argc, char **argv)
{
    (void)argc;
    fast_blas(argv);
    stages();
    lemke_beside_newton();
    return 0;
}
