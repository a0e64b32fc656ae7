/* Error bars of wear: from other meshes, as those of histories, and from other steps
 * (theory-solvers.md 5.1). */
#include "rolling/results/columns.h"
#include "rolling/solve/law.h"
#include "rolling/solve/patches.h"
#include "rolling/study/internal.h"
#include "rolling/study/study.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The error of the steps, from a run with others: so many times the larger of what it deviates by
 * at its own entries on either side, as a stick zone that begins to slip in one of them does not do
 * so gradually. */
static rb_status add_step_errors(const rb_rolling_wear_history *own,
                                 const rb_rolling_wear_history *other, double times,
                                 rb_rolling_wear_history *errors)
{
    const rb_rolling_results *columns = &rb_rolling_wear_columns;
    double *off = rb_alloc((size_t)other->n, 1);

    if (!off)
        return RB_ENOMEM;
    for (int k = 0; k < columns->n; k++) {
        const rb_rolling_result *c = &columns->row[k];
        if (!c->error_bar || !rb_rolling_has_column(c, own))
            continue;
        const rb_rolling_table mine = {own->n, own->way, rb_rolling_column(c, own)};
        const double *theirs = rb_rolling_column(c, other);
        double *e = rb_rolling_column(c, errors);
        for (int j = 0; j < other->n; j++)
            off[j] = fabs(theirs[j] - rb_rolling_table_at(&mine, other->way[j]));
        for (int i = 0, j = 0; i < own->n; i++) {
            while (j + 1 < other->n && other->way[j + 1] <= own->way[i])
                j++;
            const int is_there = j + 1 == other->n || other->way[j] == own->way[i];
            e[i] += times * (is_there ? off[j] : fmax(off[j], off[j + 1]));
        }
    }
    free(off);
    return RB_OK;
}

/* The runs beside the meshes: in other steps of wear, and in others of a fretting cycle. */
enum { OTHER_STEPS = RB_ERROR_MESHES, OTHER_INCREMENTS, WEAR_RUNS };

/* run: the coarser ones; then, where it was solved (n > 0), one between them and the run itself;
 * then those in other steps.  element: the longest one in contact. */
static rb_status wear_errors(const rb_rolling_case *rc, const rb_rolling_wear_history run[],
                             double element, rb_rolling_wear_history *own)
{
    const int runs = rb_rolling_error_runs(rc);
    const void *found[RB_ERROR_RUNS];
    rb_rolling_wear_history *errors = own->errors = calloc(1, sizeof *errors);
    rb_status s = errors ? rb_rolling_columns_alloc(&rb_rolling_wear_columns, rc, 0, own->n, errors)
                         : RB_ENOMEM;

    if (s != RB_OK)
        return s;
    /* Columns that the run itself has not. */
    double **const absent[][2] = {{&errors->worn_b, &own->worn_b},
                                  {&errors->max_depth_b, &own->max_depth_b},
                                  {&errors->radius_b, &own->radius_b},
                                  {&errors->stroke, &own->stroke}};
    for (size_t k = 0; k < sizeof absent / sizeof *absent; k++)
        if (!*absent[k][1]) {
            free(*absent[k][0]);
            *absent[k][0] = NULL;
        }
    errors->n = own->n;
    errors->slides = own->slides;
    errors->rolls = own->rolls;
    memcpy(errors->way, own->way, (size_t)own->n * sizeof *own->way);
    for (int k = 0; k < runs; k++)
        found[k] = &run[k];
    rb_rolling_error_columns(&rb_rolling_wear_columns, own->n, runs, found,
                             run[RB_ERROR_ANOTHER_RUN].n > 0 ? &run[RB_ERROR_ANOTHER_RUN] : NULL,
                             own, errors);
    /* Half as many implicit steps deviate by the error at least; half as many increments of a cycle
     * by about the error, which is of first order. */
    if (s == RB_OK)
        s = add_step_errors(own, &run[OTHER_STEPS], 1.0, errors);
    if (s == RB_OK && run[OTHER_INCREMENTS].n > 0)
        s = add_step_errors(own, &run[OTHER_INCREMENTS], 2.0, errors);
    /* A worn contact does not end with (E1): its edge is known to lie in an element. */
    for (int i = 0; i < own->n && s == RB_OK; i++) {
        errors->contact_from[i] += 0.5 * element;
        errors->contact_to[i] += 0.5 * element;
    }
    for (int i = 0; i < own->n && own->stick_edge; i++)
        errors->max_pressure[i] = NAN;
    return s;
}

rb_status rb_rolling_wear_with_errors(const rb_rolling_case *rc, const rb_rolling_wear *wear,
                                      const rb_rolling_wear_observer *observer,
                                      rb_rolling_wear_history *history, rb_rolling_solution *last,
                                      rb_message *why)
{
    rb_rolling_wear_history run[WEAR_RUNS] = {{0}};
    const int runs = rb_rolling_error_runs(rc);
    rb_status s = rb_rolling_error_check(rc, why);

    memset(history, 0, sizeof *history);
    memset(last, 0, sizeof *last);
    if (s == RB_OK)
        s = rb_rolling_wear_run(rc, wear, observer, history, last, why);
    for (int k = 0; k < WEAR_RUNS && s == RB_OK; k++) {
        const int is_left_out =
            (k >= runs && k < RB_ERROR_ANOTHER_RUN) || (k == OTHER_INCREMENTS && !history->stroke);
        if (is_left_out)
            continue;
        rb_rolling_wear other = *wear;
        const rb_rolling_case mesh = k < RB_ERROR_MESHES ? rb_rolling_error_run(rc, k) : *rc;
        rb_rolling_solution end = {0};
        if (k == OTHER_STEPS) /* half as many, or two for one */
            other.steps = wear->steps > 1 ? wear->steps / 2 : 2;
        if (k == OTHER_INCREMENTS)
            other.increments = wear->increments > 1 ? wear->increments / 2 : 2;
        s = rb_rolling_wear_run(&mesh, &other, NULL, &run[k], &end, why);
        rb_rolling_solution_free(&end);
        if (k == RB_ERROR_ANOTHER_RUN && s > 0 && s != RB_INTERRUPTED) {
            rb_rolling_wear_history_free(&run[k]); /* the bars do without it */
            s = RB_OK;
        }
    }
    if (s == RB_OK)
        s = wear_errors(rc, run, rb_rolling_longest_element(last->n, last->zone, last->h), history);
    for (int k = 0; k < WEAR_RUNS; k++)
        rb_rolling_wear_history_free(&run[k]);
    return s;
}
