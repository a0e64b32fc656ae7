/* Several steady solutions of one case, which may exist if friction depends strongly on
 * the state (theory-rolling.md F5). */
#include "rolling/case/derived.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/law.h"
#include "rolling/solve/law_iteration.h"
#include "rolling/solve/model.h"
#include "rolling/solve/solution.h"
#include "rolling/study/study.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void rb_rolling_solutions_free(rb_rolling_solutions *all)
{
    for (int k = 0; k < all->n; k++)
        rb_rolling_solution_free(&all->solution[k]);
    free(all->solution);
    memset(all, 0, sizeof *all);
}

/* Differing by more than iterations leave of the difference between two starts. */
static int is_known(const rb_rolling_solutions *all, const rb_rolling_model *model)
{
    const rb_contact_problem *p = &model->problem;
    const double small = 1e-6 * rb_contact_friction_scale(p);

    for (int k = 0; k < all->n; k++) {
        double difference = 0.0;
        for (int i = 0; i < p->n; i++)
            difference = fmax(difference, fabs(all->solution[k].q[i] - model->state.q[i]));
        if (difference <= small)
            return 1;
    }
    return 0;
}

static rb_status keep_if_new(rb_rolling_solutions *all, const rb_rolling_model *model,
                             rb_message *why)
{
    rb_rolling_solution *more = realloc(all->solution, sizeof *more * ((size_t)all->n + 1));

    if (!more)
        return rb_fail(why, RB_ENOMEM, "out of memory for %d solutions", all->n + 1);
    all->solution = more;
    const rb_status s = rb_rolling_model_solution(model, &more[all->n], why);
    if (s != RB_OK)
        return s;
    return rb_rolling_solve_strips(model, &more[all->n++].ellipse_force, why);
}

static int by_force(const void *x, const void *y)
{
    const rb_rolling_solution *a = x, *b = y;
    const double p = fabs(a->tangential_load), q = fabs(b->tangential_load);
    return (p < q) - (p > q);
}

rb_status rb_rolling_find_solutions(rb_rolling_model *model, rb_rolling_solutions *all,
                                    rb_message *why)
{
    enum { MOST = 200 };
    const rb_rolling_case *rc = model->rc;
    double from, to, free_creepage = NAN;
    int places = 0;

    memset(all, 0, sizeof *all);
    if (rc->formulation != RB_STEADY || !rb_rolling_law_depends_on_state(rc))
        return rb_fail(why, RB_EINVAL,
                       "all solutions: only for steady rolling with friction that "
                       "depends on the slip or the temperature");
    if (model->problem.force_given)
        return rb_fail(why, RB_EINVAL,
                       "all solutions: at a given creepage, not under a given force");
    rb_status s = keep_if_new(all, model, why);
    if (s == RB_OK)
        s = rb_rolling_free_creepage_if_any(model, &free_creepage, why);
    rb_rolling_contact_edges(rc, &model->mesh, &model->state, &from, &to);
    for (int i = 0; i < model->state.n && places < MOST; i++)
        places += model->state.zone[i] != RB_ZONE_SEPARATED;
    /* (F5) Starts whose slip zone ends at each element in turn: branches of one case differ by
     * where stick ends.  What fails from one start may be found from the next. */
    for (int k = 0; k <= places && s == RB_OK; k++) {
        rb_message reason = {.text = ""};
        s = rb_rolling_law_start(model, from + (to - from) * k / fmax(places, 1), why);
        if (s != RB_OK)
            break;
        const rb_status t = rb_rolling_model_resolve(model, 1, &reason);
        all->starts++;
        all->failed += t != RB_OK && t != RB_ENOMEM;
        if (t == RB_ENOMEM)
            s = rb_fail(why, t, "%s", reason.text);
        else if (t == RB_OK && !is_known(all, model))
            s = keep_if_new(all, model, why);
    }
    for (int k = 0; k < all->n; k++)
        all->solution[k].free_creepage = free_creepage;
    if (all->n > 1)
        qsort(all->solution, (size_t)all->n, sizeof *all->solution, by_force);
    return s;
}
