/* Derivatives and the standard deviations that follow from them, again: the library differentiates
 * the model that was built again, at the stored state.  So what is printed belongs to this state;
 * the formulas of the derivatives are the library's own. */
#include "program/certificate/internal.h"

#include <math.h>
#include <string.h>

void rb_certificate_slopes_free(rb_certificate_slopes *s)
{
    rb_case_slopes_free(&s->of_steps);
    rb_case_derivatives_free(&s->all);
}

/* uncertain_inputs as the program takes them: "mu=0.02,radius=0.1". */
static rb_status read_uncertain(const json_t *root, const rb_case *words, rb_case_tolerances *t,
                                rb_message *why)
{
    char text[60 * RB_CASE_TOLERANCES_MAX] = "";
    const char *name;
    json_t *deviation;
    rb_message reason;

    json_object_foreach(json_object_get(root, "uncertain_inputs"), name, deviation)
    {
        const size_t n = strlen(text);
        rb_format(text + n, sizeof text - n, "%s%.30s=%.17g", n > 0 ? "," : "", name,
                  json_number_value(deviation));
    }
    const rb_status s = rb_case_read_tolerances(words, text, t, &reason);
    return s == RB_OK ? s : rb_fail(why, s, "uncertain_inputs: %s", reason.text);
}

/* ---- What a rounding makes of them ------------------------------------------------- */

/* What the library takes for rounding, of a result with these values, and of torques, in which
 * large ones cancel, of the load at the radius. */
static double rounding_of(const rb_case_result *r, const rb_rolling_result *result,
                          const void *owner, int rows)
{
    static const double PART = 0.1;
    double most = 0.0;

    if (strncmp(result->name, "torque", 6) == 0)
        most = r->solution.normal_load * rb_rolling_larger_radius(r->model.rc);
    for (int i = 0; i < rows && rb_rolling_has_column(result, owner); i++)
        most = fmax(most, fabs(rb_rolling_entry(result, owner, i)));
    if (rows == 0)
        most = fmax(most, fabs(rb_rolling_number(result, owner)));
    return PART * rb_sensitivity_rounding(r->model.rc, result, most);
}

/* The scale of an input; INFINITY: there is none of the name. */
static double scale_of(const rb_case_number *number, int n, const char *name)
{
    for (int k = 0; k < n; k++)
        if (strcmp(number[k].name, name) == 0)
            return number[k].input.scale;
    return INFINITY;
}

/* Each derivative moves by a part of what the library takes for rounding. */
static void move_derivatives(const rb_case_result *r, const rb_case_number *number, int n,
                             rb_case_derivatives *all)
{
    const rb_rolling_results *scalars = &rb_rolling_solution_scalars,
                             *columns = &rb_rolling_solution_columns;

    for (int i = 0; i < all->n; i++)
        for (int side = 0; side < 2 && all->of[i].status == RB_OK; side++) {
            rb_rolling_solution *d = &all->of[i].d.value[side];
            const double scale = scale_of(number, n, all->of[i].name);
            if (!all->of[i].d.has[side])
                continue;
            for (int k = 0; k < scalars->n; k++)
                if (rb_sensitivity_has(&scalars->row[k]))
                    rb_rolling_set_number(&scalars->row[k], d,
                                          rb_rolling_number(&scalars->row[k], d) +
                                              rounding_of(r, &scalars->row[k], &r->solution, 0) /
                                                  scale);
            for (int k = 0; k < columns->n; k++) {
                double *x = rb_rolling_column(&columns->row[k], d);
                if (!x || columns->row[k].kind != RB_RESULT_NUMBER)
                    continue;
                const double by = rounding_of(r, &columns->row[k], &r->solution, d->n) / scale;
                for (int j = 0; j < d->n; j++)
                    x[j] += by;
            }
        }
}

static void move_slopes(const rb_case_result *r, const rb_case_number *number, int n,
                        rb_case_slopes *s)
{
    for (int k = 0; k < s->n; k++) {
        const double by = rounding_of(r, s->of[k].result, &r->history, r->history.n) /
                          scale_of(number, n, s->of[k].input);
        for (int row = 0; row < s->rows; row++)
            for (int side = 0; side < 2; side++)
                s->value[2 * ((size_t)row * (size_t)s->n + (size_t)k) + (size_t)side] += by;
    }
}

/* ---- Again ------------------------------------------------------------------------- */

static rb_status deviate(const rb_certificate *c, const rb_case *words, const rb_case_result *r,
                         const rb_case_number *number, int n, rb_certificate_slopes *p,
                         rb_message *why)
{
    rb_case_derivatives all;

    rb_status s = rb_case_differentiate_by_tolerances(words, &r->model, &p->uncertain, &all, why);
    if (s == RB_OK && c->moving > 0)
        move_derivatives(r, number, n, &all);
    if (s == RB_OK)
        s = rb_case_propagate(&p->uncertain, &all, &p->shown.deviation, why);
    rb_case_derivatives_free(&all);
    return s;
}

rb_status rb_certificate_restore_slopes(rb_certificate *c, const json_t *root, const rb_case *words,
                                        rb_case_result *r, rb_rolling_states *states,
                                        rb_certificate_slopes *p, rb_message *why)
{
    const int smooth = json_object_get(root, "smooth_derivatives") != NULL;
    rb_case_number number[RB_CASE_NUMBERS_MAX];
    int n = 0;

    p->names = json_string_value(json_object_get(root, "derivatives_of"));
    p->deviates = json_object_get(root, "uncertain_inputs") != NULL;
    if (!p->names && !p->deviates)
        return RB_OK;
    rb_status s = rb_case_numbers(words, number, &n, why);
    if (s == RB_OK && p->deviates)
        s = read_uncertain(root, words, &p->uncertain, why);
    if (s == RB_OK && r->history.n > 0) {
        if (p->names)
            s = rb_case_slopes_choose(words, &rb_rolling_history_columns, p->names,
                                      RB_CASE_SLOPES_MAX, &p->of_steps, why);
        if (s == RB_OK)
            s = rb_case_slopes_of_steps(words, states, p->names ? &p->of_steps : NULL,
                                        p->deviates ? &p->uncertain : NULL, &r->history, why);
        if (s == RB_OK && c->moving > 0)
            move_slopes(r, number, n, &p->of_steps);
        return s;
    }
    if (s == RB_OK && p->names)
        s = rb_report_derivatives_of(p->names, rb_case_resolved(words), &p->shown, why);
    if (s == RB_OK && p->names)
        s = (smooth ? rb_case_differentiate_smoothly : rb_case_differentiate)(words, &r->model, 0,
                                                                              NULL, &p->all, why);
    if (s == RB_OK && p->names && c->moving > 0)
        move_derivatives(r, number, n, &p->all);
    if (s == RB_OK && p->deviates)
        s = deviate(c, words, r, number, n, p, why);
    p->shown.all = &p->all;
    return s;
}
