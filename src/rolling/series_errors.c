/* Error bars of curves and histories: every entry of a column has one, as a scalar of a
 * solution has (theory.md 5.1). */
#include "rolling/internal.h"

#include <stdlib.h>
#include <string.h>

/* Of what was found on the meshes, the last one's in own, over the same points. */
static void error_columns(const rb_rolling_results *columns, int rows, int contact,
                          const void *coarse, const void *middle, const void *own,
                          void *errors)
{
    for (int k = 0; k < columns->n; k++) {
        const rb_rolling_result *r = &columns->row[k];
        if (!r->error_bar)
            continue;
        const double *a = rb_rolling_column(r, coarse), *b = rb_rolling_column(r, middle);
        const double *c = rb_rolling_column(r, own);
        double *e = rb_rolling_column(r, errors);
        for (int i = 0; i < rows; i++)
            e[i] = rb_rolling_error_of(contact, a[i], b[i], c[i]);
    }
}

/* ---- Curves ------------------------------------------------------------------------ */

rb_status rb_rolling_curve_with_errors(const rb_rolling_case *rc, int over_creep,
                                       double from, double to, int points,
                                       rb_rolling_curve *curve, rb_rolling_curve *errors,
                                       rb_message *why)
{
    rb_rolling_curve found[RB_ERROR_MESHES] = {0};
    rb_status s = rb_rolling_error_check(rc, why);

    memset(curve, 0, sizeof *curve);
    memset(errors, 0, sizeof *errors);
    for (int k = 0; k < RB_ERROR_MESHES && s == RB_OK; k++) {
        const rb_rolling_case mesh = rb_rolling_error_mesh(rc, k);
        s = rb_rolling_curve_solve(&mesh, over_creep, from, to, points, &found[k], why);
    }
    if (s == RB_OK)
        s = rb_rolling_columns_alloc(&rb_rolling_curve_columns, points, errors);
    *curve = found[2];
    if (s == RB_OK) {
        errors->n = curve->n;
        errors->free_creepage =
            rb_rolling_error_of(curve->contact, found[0].free_creepage,
                                found[1].free_creepage, curve->free_creepage);
        error_columns(&rb_rolling_curve_columns, curve->n, curve->contact, &found[0],
                      &found[1], curve, errors);
    }
    curve->seconds += found[0].seconds + found[1].seconds;
    for (int k = 0; k < 2; k++)
        rb_rolling_curve_free(&found[k]);
    return s;
}

/* ---- Histories ----------------------------------------------------------------------
 */

static int steps_at_rest(const rb_rolling_history *h)
{
    int k = 0;
    while (k < h->n && h->distance[k] == 0.0)
        k++;
    return k;
}

/* Where the entry of a rolled step belongs. */
static double place(const rb_rolling_history *h, int is_mean, int k, int rest)
{
    const double before = k > rest ? h->distance[k - 1] : 0.0;

    return is_mean ? 0.5 * (before + h->distance[k]) : h->distance[k];
}

/* Linear between entries k and k + 1 of a column; beyond the last one that. */
static double between(const rb_rolling_history *h, const double *column, int is_mean,
                      int k, int rest, double x)
{
    if (k + 1 >= h->n)
        return column[h->n - 1];
    const double x0 = place(h, is_mean, k, rest), x1 = place(h, is_mean, k + 1, rest);
    return column[k] + (column[k + 1] - column[k]) * (x - x0) / (x1 - x0);
}

/* A column at the steps of another history.  Rolling starts from the last state at rest,
 * but not a mean over a rolled step. */
static void place_column(const rb_rolling_history *from, const double *column,
                         int is_mean, const rb_rolling_history *to, double *out)
{
    const int rest = steps_at_rest(from);
    int k = is_mean || rest == 0 ? rest : rest - 1;

    for (int i = 0; i < to->n; i++) {
        if (to->distance[i] == 0.0) {
            out[i] = column[i];
            continue;
        }
        const double x = place(to, is_mean, i, rest);
        while (k + 2 < from->n && place(from, is_mean, k + 1, rest) < x)
            k++;
        out[i] = between(from, column, is_mean, k, rest, x);
    }
}

/* What of the history has error bars, at the steps of another one. */
static rb_status place_history(const rb_rolling_history *from,
                               const rb_rolling_history *to, rb_rolling_history *out)
{
    const rb_rolling_results *columns = &rb_rolling_history_columns;
    const rb_status s = rb_rolling_columns_alloc(columns, to->n, out);

    for (int k = 0; k < columns->n && s == RB_OK; k++) {
        const rb_rolling_result *r = &columns->row[k];
        if (r->error_bar)
            place_column(from, rb_rolling_column(r, from), r->is_mean, to,
                         rb_rolling_column(r, out));
    }
    return s;
}

/* An error changes its sign wherever an edge passes an element: each rolled step takes
 * the largest of its own and its neighbours'. */
static rb_status widen(const rb_rolling_history *h, double *error)
{
    const int rest = steps_at_rest(h), rolled = h->n - rest;
    double *own = rb_alloc((size_t)h->n, 1);

    if (!own)
        return RB_ENOMEM;
    memcpy(own, error, (size_t)h->n * sizeof *own);
    for (int i = 0; i < rolled; i++)
        for (int k = i > 0 ? i - 1 : 0; k <= i + 1 && k < rolled; k++)
            error[rest + i] = fmax(error[rest + i], own[rest + k]);
    free(own);
    return RB_OK;
}

static rb_status history_errors(const rb_rolling_history *coarse,
                                const rb_rolling_history *middle,
                                const rb_rolling_history *own, rb_rolling_history *errors)
{
    const rb_rolling_results *columns = &rb_rolling_history_columns;
    const int last = own->n - 1, contact = own->stick[last] + own->slipping[last];
    rb_status s = rb_rolling_columns_alloc(columns, own->n, errors);

    if (s != RB_OK)
        return s;
    errors->n = own->n;
    error_columns(columns, own->n, contact, coarse, middle, own, errors);
    for (int k = 0; k < columns->n && s == RB_OK; k++)
        if (columns->row[k].error_bar)
            s = widen(own, rb_rolling_column(&columns->row[k], errors));
    return s;
}

typedef struct {
    rb_rolling_step *see;
    void *context;
} watcher;

static int see_companion(const rb_rolling_model *model, const rb_rolling_history *history,
                         int step, int steps, void *context)
{
    const watcher *w = context;

    (void)model;
    (void)history;
    return w->see ? w->see(NULL, NULL, step, steps, w->context) : 0;
}

/* The same way on the k-th mesh, at the steps of `own`. */
static rb_status companion(const rb_rolling_case *rc, const rb_rolling_program *program,
                           int k, watcher *w, const rb_rolling_history *own,
                           rb_rolling_history *placed, rb_message *why)
{
    const rb_rolling_case mesh = rb_rolling_error_mesh(rc, k);
    rb_rolling_model model = {0};
    rb_rolling_history history = {0};
    rb_status s =
        rb_rolling_history_run(&mesh, program, see_companion, w, &model, &history, why);

    if (s == RB_OK)
        s = place_history(&history, own, placed);
    rb_rolling_model_free(&model);
    rb_rolling_history_free(&history);
    return s;
}

rb_status rb_rolling_history_with_errors(const rb_rolling_case *rc,
                                         const rb_rolling_program *program,
                                         rb_rolling_step *step, void *context,
                                         rb_rolling_model *model,
                                         rb_rolling_history *history,
                                         rb_rolling_history *errors, rb_message *why)
{
    rb_rolling_history placed[2] = {0};
    watcher w = {step, context};
    rb_status s = rb_rolling_error_check(rc, why);

    memset(model, 0, sizeof *model);
    memset(history, 0, sizeof *history);
    memset(errors, 0, sizeof *errors);
    if (s == RB_OK)
        s = rb_rolling_history_run(rc, program, step, context, model, history, why);
    for (int k = 0; k < 2 && s == RB_OK; k++)
        s = companion(rc, program, k, &w, history, &placed[k], why);
    if (s == RB_OK)
        s = history_errors(&placed[0], &placed[1], history, errors);
    for (int k = 0; k < 2; k++)
        rb_rolling_history_free(&placed[k]);
    return s;
}
