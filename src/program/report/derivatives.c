/* Derivatives of the results of a case, and standard deviations of the results for
 * uncertain inputs. */
#include "program/report/internal.h"
#include "analysis/sensitivity/derivatives.h"
#include "rolling/case/case.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const nothing = "this solution has no such result, or one without a derivative";

static void add_result(const rb_rolling_result *r, int is_column, rb_report_derivatives *d)
{
    if (d->n < RB_REPORT_RESULTS_MAX) {
        d->is_column[d->n] = is_column;
        d->result[d->n++] = r;
    }
}

/* names: "all", or results separated by commas, of which a name without a derivative is a
 * mistake. */
rb_status rb_report_derivatives_of(const char *names, const rb_resolved_case *c,
                                   rb_report_derivatives *d, rb_message *why)
{
    const rb_rolling_results *all = &rb_rolling_solution_scalars;

    d->n = 0;
    d->named = strcmp(names, "all") != 0;
    for (int k = 0; k < all->n && strcmp(names, "all") == 0; k++)
        if (rb_sensitivity_has(&all->row[k]))
            add_result(&all->row[k], 0, d);
    if (d->n > 0)
        return RB_OK;
    for (char name[40]; (names = rb_next_word(names, name, sizeof name));) {
        int is_column;
        const rb_rolling_result *r = rb_case_derivative_result(name, &is_column);
        if (!r && strchr(name, ':'))
            return rb_fail(why, RB_EINVAL,
                           "expected RESULT without :OPTION, got '%s': a case without steps has "
                           "the derivatives with respect to all numbers",
                           name);
        if (!r)
            return rb_case_refuse_result(name, all, NULL, why);
        if (!rb_rolling_has_result(r, &c->rc, c->program.mu != NULL))
            return rb_fail(why, RB_EINVAL, "this case has no %s", name);
        add_result(r, is_column, d);
    }
    return RB_OK;
}

/* ---- JSON -------------------------------------------------------------------------- */

/* A number, or a list of the entries of a column; null: this side does not exist. */
static json_t *one_side(const rb_rolling_result *r, int is_column, const rb_case_derivative *of,
                        int side)
{
    const rb_rolling_solution *value = &of->d.value[side];

    if (!of->d.has[side])
        return json_null();
    if (!is_column)
        return rb_report_json_number(rb_rolling_number(r, value));
    json_t *list = json_array();
    for (int i = 0; i < value->n; i++)
        rb_report_json_append(&list, rb_report_json_number(rb_rolling_entry(r, value, i)));
    return list;
}

/* 1: the case has the result, so that it has a derivative. */
static int has_result(const rb_report_derivatives *d, int k)
{
    for (int i = 0; i < d->all->n; i++)
        for (int side = 0; side < 2 && d->all->of[i].status == RB_OK; side++) {
            const rb_sensitivity_derivative *of = &d->all->of[i].d;
            if (of->has[side] &&
                (d->is_column[k] ? rb_rolling_has_column(d->result[k], &of->value[side])
                                 : !isnan(rb_rolling_number(d->result[k], &of->value[side]))))
                return 1;
        }
    return 0;
}

void rb_report_json_derivatives(json_t **root, const rb_report_derivatives *d)
{
    json_t *results = json_object(), *without = json_object(), *over_x = json_object();
    char text[160];

    for (int k = 0; k < d->n; k++)
        if (has_result(d, k)) {
            json_t *object = json_object();

            for (int i = 0; i < d->all->n; i++) {
                const rb_case_derivative *of = &d->all->of[i];
                if (of->status != RB_OK)
                    continue;
                /* A result is one number where both sides agree, [left, right] where they
                 * differ. */
                json_t *value = one_side(d->result[k], d->is_column[k], of, 0);
                const int two = of->d.sides == 2;
                json_t *right = two ? one_side(d->result[k], d->is_column[k], of, 1) : NULL;
                if (two && !right) { /* no memory: the whole has none then */
                    json_decref(value);
                    value = NULL;
                } else if (right && !json_equal(value, right)) { /* those of this result differ */
                    json_t *both = json_array();
                    rb_report_json_append(&both, value);
                    rb_report_json_append(&both, right);
                    value = both;
                } else
                    json_decref(right);
                rb_report_json_set(&object, of->name, value);
            }
            rb_report_json_set(&results, d->result[k]->name, object);
        } else if (d->named)
            rb_report_json_set(&without, d->result[k]->name, json_string(nothing));
    rb_report_json_set(root, d->all->smooth ? "smooth_derivatives" : "derivatives", results);
    for (int i = 0; i < d->all->n; i++)
        if (d->all->of[i].status != RB_OK)
            rb_report_json_set(&without, d->all->of[i].name, json_string(d->all->of[i].why.text));
    rb_report_json_set(root, "without_derivatives", without);
    /* over_x has, for each of its results in turn, n derivatives by the gap and n by mu. */
    for (int k = 0; k < RB_CASE_OVER_X_N && d->all->n_x > 0; k++) {
        const int n = d->all->n_x;
        const double *gap = d->all->over_x + 2 * k * n;
        json_t *both = json_object();
        rb_report_json_set(&both, "gap", rb_report_json_numbers(n, gap));
        rb_report_json_set(&both, "mu", rb_report_json_numbers(n, gap + n));
        rb_report_json_set(&over_x, rb_case_over_x_names[k], both);
    }
    if (d->all->smooth)
        json_decref(over_x);
    else
        rb_report_json_set(root, "derivatives_over_x", over_x);
    snprintf(text, sizeof text, "%s; [left, right] where the two sides differ",
             rb_case_derivatives_are(d->all));
    rb_report_json_set(root, "derivatives_are", json_string(text));
}

void rb_report_json_tolerances(json_t **root, const rb_report_derivatives *d)
{
    json_t *results = json_object();

    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        if (rb_sensitivity_has(r) && !isnan(rb_rolling_number(r, &d->deviation)))
            rb_report_json_set(&results, r->name,
                               rb_report_json_number(rb_rolling_number(r, &d->deviation)));
    }
    rb_report_json_set(root, "tolerances", results);
}

void rb_report_json_asked(json_t **root, const char *names, const rb_case *c)
{
    json_t *inputs = rb_report_json_inputs(c), *own = json_array(), *value;
    const char *key;

    if (names)
        rb_report_json_set(root, "derivatives_of", rb_report_json_text(names));
    /* Numbers of B that were given, and equal A's: without this list, whoever varies A's would vary
     * B's, too. */
    json_object_foreach(inputs, key, value)
    {
        char of_a[80];
        snprintf(of_a, sizeof of_a, "%.*s", (int)strlen(key) - 2, key);
        if (rb_case_is_own_of_b(c, key) && json_equal(value, json_object_get(inputs, of_a)))
            rb_report_json_append(&own, json_string(key));
    }
    json_decref(inputs);
    if (own && json_array_size(own) == 0)
        json_decref(own);
    else
        rb_report_json_set(root, "own_of_b", own);
}

void rb_report_json_uncertain(json_t **root, const rb_case_tolerances *t, rb_units units)
{
    json_t *inputs = json_object();

    for (int k = 0; k < t->n; k++)
        rb_report_json_set(&inputs, t->name[k],
                           json_real(rb_unit_shown(units, t->unit[k], t->deviation[k])));
    rb_report_json_set(root, "uncertain_inputs", inputs);
}

void rb_report_json_uncertain_text(json_t **root, const char *text)
{
    json_t *inputs = json_object();

    for (char word[100]; (text = rb_next_word(text, word, sizeof word));) {
        char name[40] = "", value[60] = "", *end;
        if (sscanf(word, " %39[^=, ] = %59[^,]", name, value) != 2)
            continue;
        const double x = rb_read_number(value, &end);
        end += strspn(end, " ");
        rb_report_json_set(&inputs, name,
                           *end ? rb_report_json_text(value) : rb_report_json_number(x));
    }
    rb_report_json_set(root, "uncertain_inputs", inputs);
}

/* ---- Tables ------------------------------------------------------------------------ */

/* A derivative in its row; one: what one per cent of the input changes. */
typedef struct {
    const rb_rolling_result *result;
    const rb_case_derivative *of;
    double side[2], one;
} derivative;

static int by_size(const void *a, const void *b)
{
    const derivative *x = a, *y = b;
    return fabs(x->one) > fabs(y->one)   ? -1
           : fabs(x->one) < fabs(y->one) ? 1
                                         : (x->of > y->of) - (x->of < y->of);
}

/* Those of result k (entry of a column, from 0; -1: a number) with respect to all inputs, the
 * largest first. */
static int rows_of(const rb_report_derivatives *d, int k, int entry, derivative *row)
{
    int n = 0;

    for (int i = 0; i < d->all->n; i++) {
        const rb_case_derivative *of = &d->all->of[i];
        derivative r = {d->result[k], of, {NAN, NAN}, NAN};
        for (int side = 0; side < 2 && of->status == RB_OK; side++)
            if (of->d.has[side])
                r.side[side] = entry < 0 ? rb_rolling_number(r.result, &of->d.value[side])
                                         : rb_rolling_entry(r.result, &of->d.value[side], entry);
        if (of->d.sides == 1)
            r.side[1] = r.side[0];
        if (isnan(r.side[0]) && isnan(r.side[1]))
            continue;
        /* For a growing input; 0.0 + x is never -0. */
        r.one = 0.0 + 0.01 * of->value * (isnan(r.side[1]) ? r.side[0] : r.side[1]);
        row[n++] = r;
    }
    qsort(row, (size_t)n, sizeof *row, by_size);
    return n;
}

rb_status rb_report_derivative_table(FILE *out, const rb_rolling_solution *s,
                                     const rb_report_derivatives *d,
                                     const rb_rolling_note_list *notes, const char *command,
                                     const rb_report_style *style)
{
    rb_report_cells c =
        rb_report_cells_begin(out, style,
                              "result input unit_of_result unit_of_input value_of_result "
                              "value_of_input left right change_by_1_percent");
    derivative row[RB_CASE_NUMBERS_MAX];
    char name[64];

    rb_report_comment_origin(&c, command);
    rb_report_comment(&c, "%sderivatives %s; left, right: for a falling and a growing input",
                      d->all->smooth ? "smooth " : "", rb_case_derivatives_are(d->all));
    for (int i = 0; i < d->all->n; i++)
        if (d->all->of[i].status != RB_OK)
            rb_report_comment(&c, "none by %s: %s", d->all->of[i].name, d->all->of[i].why.text);
    for (int k = 0; k < d->n && d->named; k++)
        if (!has_result(d, k))
            rb_report_comment(&c, "none of %s: %s", d->result[k]->name, nothing);
    const rb_status noted = rb_report_comment_notes(&c, notes);
    if (noted != RB_OK)
        return noted;
    for (int k = 0; k < d->n; k++)
        /* A row per input, and of columns per element and input; the largest change stands
         * first. */
        for (int e = 0; has_result(d, k) && e < (d->is_column[k] ? s->n : 1); e++) {
            const int entry = d->is_column[k] ? e : -1;
            const int n = rows_of(d, k, entry, row);
            snprintf(name, sizeof name, entry < 0 ? "%s" : "%s[%d]", d->result[k]->name, e);
            for (int i = 0; i < n; i++) {
                rb_report_cell_text(&c, name);
                rb_report_cell_text(&c, row[i].of->name);
                rb_report_cell_text(&c, rb_report_unit_name(d->all->units, d->result[k]->unit));
                rb_report_cell_text(&c, rb_report_unit_name(d->all->units, row[i].of->unit));
                rb_report_cell_number(&c, entry < 0 ? rb_rolling_number(d->result[k], s)
                                                    : rb_rolling_entry(d->result[k], s, e));
                rb_report_cell_number(&c, row[i].of->value);
                rb_report_cell_number(&c, row[i].side[0]);
                rb_report_cell_number(&c, row[i].side[1]);
                rb_report_cell_number(&c, row[i].one);
                rb_report_cells_end_row(&c);
            }
        }
    return rb_report_flush(out);
}

rb_status rb_report_brief_derivatives(FILE *out, const rb_rolling_solution *s,
                                      const rb_report_derivatives *d)
{
    enum { MOST = 5 };
    derivative row[RB_CASE_NUMBERS_MAX];

    for (int k = 0; k < d->n; k++) {
        if (d->is_column[k] || !has_result(d, k))
            continue;
        fprintf(out, "%s = %.5g %s\n", d->result[k]->name, rb_rolling_number(d->result[k], s),
                rb_report_unit_name(d->all->units, d->result[k]->unit));
        const int n = rows_of(d, k, -1, row);
        for (int i = 0; i < n && i < MOST && row[i].one != 0.0; i++)
            fprintf(out, "  %-24s %12.5g  1 %% of it changes the result by %.3g\n", row[i].of->name,
                    isnan(row[i].side[1]) ? row[i].side[0] : row[i].side[1], row[i].one);
    }
    return rb_report_flush(out);
}

void rb_report_tolerances(FILE *out, const rb_rolling_solution *s, const rb_report_derivatives *d)
{
    void *before = rb_locale_begin();
    fputs("standard deviations from those of --tolerance, to first order\n", out);
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        const double deviation = rb_rolling_number(r, &d->deviation);
        const char *unit = rb_report_unit_name(s->units, r->unit);
        const int plain = strcmp(unit, "1") == 0;
        /* What the uncertain inputs do not change is left out. */
        if (rb_sensitivity_has(r) && deviation > 0.0)
            fprintf(out, "  %-20s %.6g +- %.2g%s%s\n", r->name, rb_rolling_number(r, s) + 0.0,
                    deviation, /* + 0.0: no -0 */
                    plain ? "" : " ", plain ? "" : unit);
    }
    rb_locale_end(before);
}

/* ---- In columns -------------------------------------------------------------------- */

void rb_report_cell_slope_headings(rb_report_cells *c, const rb_case_slopes *s)
{
    char heading[RB_CASE_SLOPE_HEADING];

    for (int k = 0; k < s->n; k++)
        rb_report_cell_text(c, rb_case_slope_heading(&s->of[k], s->units, heading));
}

void rb_report_cell_slopes(rb_report_cells *c, const rb_case_slopes *s, int row)
{
    for (int k = 0; k < s->n; k++)
        rb_report_cell_number(c, rb_case_slope_value(s, row, k));
}

void rb_report_comment_slopes(const rb_report_cells *c, int n, const rb_case_slopes *s,
                              const double *mu)
{
    rb_message note;

    if (s->tolerance)
        rb_report_comment(c, "deviation_A: of A, from standard deviations of %s", s->tolerance);
    if (s->n > 0)
        rb_report_comment(c, "d_A_by_B: derivative of A with respect to B, for a growing "
                             "B where the two sides differ");
    for (int k = 0; k < n; k++) {
        if (!rb_case_slopes_note(&s[k], &note))
            continue;
        if (n > 1)
            rb_report_comment(c, "mu = %g: %s", mu[k], note.text);
        else
            rb_report_comment(c, "%s", note.text);
    }
}

rb_status rb_report_step_slopes(FILE *out, const rb_rolling_history *h, const rb_case_slopes *s,
                                const rb_rolling_note_list *notes, const char *command,
                                const rb_report_style *style)
{
    rb_report_cells c = rb_report_cells_begin(out, style, "");

    rb_report_cell_text(&c, "step");
    rb_report_cell_text(&c, "distance_a");
    rb_report_cell_slope_headings(&c, s);
    rb_report_cells_end_row(&c);
    rb_report_comment_origin(&c, command);
    rb_report_comment_slopes(&c, 1, s, NULL);
    const rb_status noted = rb_report_comment_notes(&c, notes);
    if (noted != RB_OK)
        return noted;
    for (int row = 0; row < s->rows; row++) {
        rb_report_cell_whole(&c, row + 1);
        rb_report_cell_number(&c, h->distance[row]);
        rb_report_cell_slopes(&c, s, row);
        rb_report_cells_end_row(&c);
    }
    return rb_report_flush(out);
}

void rb_report_json_slopes(json_t **owner, const rb_case_slopes *s)
{
    json_t *results = json_object();
    rb_message note;

    for (int k = 0; k < s->n; k++)
        if (!json_object_get(results, s->of[k].result->name)) {
            /* Of the result of column first, whose inputs stand behind it. */
            json_t *inputs = json_object();

            for (int i = k; i < s->n; i++) {
                json_t *list = json_array();
                /* Pairs (left, right) of each row; one number where both are equal. */
                for (int row = 0; row < s->rows && s->of[i].result == s->of[k].result; row++) {
                    const double *both = s->value + 2 * ((size_t)row * (size_t)s->n + (size_t)i);
                    const int same = both[0] == both[1] || (isnan(both[0]) && isnan(both[1]));
                    rb_report_json_append(&list, same ? rb_report_json_number(both[0])
                                                      : rb_report_json_numbers(2, both));
                }
                if (s->of[i].result == s->of[k].result)
                    rb_report_json_set(&inputs, s->of[i].input, list);
                else
                    json_decref(list);
            }
            rb_report_json_set(&results, s->of[k].result->name, inputs);
        }
    if (s->n > 0)
        rb_report_json_set(owner, "derivatives", results);
    else
        json_decref(results);
    if (rb_case_slopes_note(s, &note))
        rb_report_json_set(owner, "derivatives_note", json_string(note.text));
}
