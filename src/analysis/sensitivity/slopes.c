/* Derivatives in columns: at every point of a curve, in every case of a study (theory-solvers.md,
 * D2).  A column is a result by a number of the case.  A derivative may have two sides, where an
 * element stands between two zones (D1): each value is stored as a pair, left and right, and a
 * column shows the right one, that for a growing number. */
#include "analysis/sensitivity/derivatives.h"
#include "analysis/sensitivity/sensitivity.h"
#include "rolling/case/words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Which columns ----------------------------------------------------------------- */

static rb_status add_slope(rb_case_slopes *s, const rb_rolling_result *result,
                           const rb_case_number *number, int most, rb_message *why)
{
    for (int k = 0; k < s->n; k++)
        if (s->of[k].result == result && strcmp(s->of[k].input, number->name) == 0)
            return RB_OK;
    if (s->n == most)
        return rb_fail(why, RB_EINVAL,
                       "more than %d columns; name results, or RESULT:OPTION for one of "
                       "them",
                       most);
    rb_case_slope *of = &s->of[s->n++];
    of->result = result;
    of->unit = number->option->unit;
    memcpy(of->input, number->name, sizeof of->input);
    return RB_OK;
}

/* "RESULT", by all numbers, or "RESULT:OPTION"; "all" in the place of RESULT. */
static rb_status add_word(const rb_resolved_case *c, rb_case_slopes *s, char *word, int numbers,
                          const rb_case_number *number, int most, rb_message *why)
{
    char *input = strchr(word, ':');
    int found = 0;

    if (input)
        *input++ = '\0';
    /* a name that no row has is a mistake; one that this case has not, too; "all" takes what there
     * is */
    const int all = strcmp(word, "all") == 0;
    const unsigned varies = rb_rolling_program_varies(&c->program);
    const rb_rolling_result *only = rb_rolling_find_result(s->table, word);
    if (!all && !(only && rb_sensitivity_has(only)))
        return rb_case_refuse_result(word, s->table, NULL, why);
    if (!all && !rb_rolling_has_result(only, &c->rc, varies))
        return rb_fail(why, RB_EINVAL, "this case has no %s", word);
    for (int r = 0; r < s->table->n; r++) {
        const rb_rolling_result *result = &s->table->row[r];
        if (!rb_sensitivity_has(result) || (!all && strcmp(result->name, word) != 0) ||
            !rb_rolling_has_result(result, &c->rc, varies))
            continue;
        for (int k = 0; k < numbers; k++) {
            if (input && strcmp(number[k].name, input) != 0)
                continue;
            found = 1;
            const rb_status status = add_slope(s, result, &number[k], most, why);
            if (status != RB_OK)
                return status;
        }
    }
    return found ? RB_OK : rb_fail(why, RB_EINVAL, "'%s' is not a number of this case", input);
}

/* words: results, or RESULT:OPTION, separated by commas; `most` columns at most. */
rb_status rb_case_slopes_choose(const rb_case *c, const rb_rolling_results *table,
                                const char *words, int most, rb_case_slopes *s, rb_message *why)
{
    rb_case_number *number = calloc(RB_CASE_NUMBERS_MAX, sizeof *number);
    char word[100];
    int numbers = 0;
    rb_status status;

    *s = (rb_case_slopes){.table = table, .of = calloc((size_t)most, sizeof *s->of)};
    status = number && s->of ? rb_case_numbers(c, number, &numbers, why)
                             : rb_fail(why, RB_ENOMEM, "out of memory for derivatives");
    if (status == RB_OK && !*words)
        status = rb_fail(why, RB_EINVAL, "expected a name, got ''");
    while (status == RB_OK && (words = rb_next_word(words, word, sizeof word)))
        status = add_word(&c->resolved, s, word, numbers, number, most, why);
    free(number);
    return status == RB_EINVAL ? rb_case_name_option("derivatives", status, why) : status;
}

rb_status rb_case_slopes_add_deviations(const rb_case *c, const char *tolerance, int n,
                                        const rb_rolling_result *const *result, rb_case_slopes *s,
                                        rb_message *why)
{
    rb_case_tolerances t;
    const rb_status status = rb_case_read_tolerances(c, tolerance, &t, why);

    s->tolerance = tolerance;
    for (int k = 0; k < n && status == RB_OK; k++) {
        if (!rb_sensitivity_has(result[k]))
            continue;
        if (s->n + s->deviations == RB_ROW_OWN)
            return rb_refuse(why, "tolerance",
                             "more than %d columns with those of the derivatives; name "
                             "fewer of them",
                             RB_ROW_OWN);
        s->deviation[s->deviations++] = result[k];
    }
    return status;
}

/* rows x n pairs (left, right), all unknown. */
rb_status rb_case_slopes_alloc(int rows, rb_case_slopes *s)
{
    const size_t all = 2 * (size_t)rows * (size_t)s->n;

    free(s->value);
    s->value = rb_alloc(all, 1);
    s->rows = s->value ? rows : 0;
    for (size_t k = 0; s->value && k < all; k++)
        s->value[k] = NAN;
    return s->value ? RB_OK : RB_ENOMEM;
}

void rb_case_slopes_free(rb_case_slopes *s)
{
    free(s->of);
    free(s->value);
    *s = (rb_case_slopes){0};
}

double rb_case_slope_value(const rb_case_slopes *s, int row, int k)
{
    const double *both = s->value + 2 * ((size_t)row * (size_t)s->n + (size_t)k);
    return isnan(both[1]) ? both[0] : both[1];
}

/* The unit of the result over that of the number. */
double rb_case_slope_shown(const rb_case_slope *of, rb_units units, double x)
{
    const char *unit = of->result->unit ? of->result->unit : "1";

    return rb_unit_shown(units, unit, x) / rb_unit_shown(units, of->unit, 1.0);
}

void rb_case_slopes_convert(rb_case_slopes *s, rb_units units)
{
    s->units = units;
    for (size_t i = 0; i < 2 * (size_t)s->rows * (size_t)s->n; i++)
        s->value[i] = rb_case_slope_shown(&s->of[i / 2 % (size_t)s->n], units, s->value[i]);
}

/* Steps of a history after which a number has no derivative. */
static int steps_without(const rb_case_slopes *s)
{
    int steps = 0;

    for (int row = 0; s->table == &rb_rolling_history_columns && row < s->rows; row++) {
        int n = 0;
        while (n < s->n && !isnan(rb_case_slope_value(s, row, n)))
            n++;
        steps += n < s->n;
    }
    return steps;
}

int rb_case_slopes_note(const rb_case_slopes *s, rb_message *note)
{
    const size_t size = sizeof note->text;
    const int without = steps_without(s);

    note->text[0] = '\0';
    /* One sentence for all rows: on which elements, how many rows have none, and why. */
    if (s->stay)
        rb_append(note->text, size, "derivatives are those on elements that do not move");
    if (s->without > 0)
        rb_append(note->text, size, "%s%d of %d %s have no derivatives: %.500s",
                  s->stay ? "; " : "", s->without, s->rows,
                  s->table == &rb_rolling_history_columns ? "rows" : "points", s->reason.text);
    else if (s->degenerate > 0)
        rb_append(note->text, size,
                  "%sin %d of %d steps an element stands between two zones: derivatives from "
                  "there on are those for growing numbers",
                  s->stay ? "; " : "", s->degenerate, s->rows);
    if (without > s->without)
        rb_append(
            note->text, size,
            "%sin %d of %d rows some derivatives do not exist (NaN): those of the motion where "
            "everything slides under a given part of mu P, those by mu where surfaces "
            "without friction slide under a given force",
            note->text[0] ? "; " : "", without - s->without, s->rows);
    return note->text[0] != '\0';
}

static void append_word(const char *word, char text[RB_CASE_SLOPE_HEADING])
{
    size_t n = strlen(text);
    for (; *word && n + 1 < RB_CASE_SLOPE_HEADING; word++)
        text[n++] = *word == '-' ? '_' : *word;
    text[n] = '\0';
}

const char *rb_case_slope_heading(const rb_case_slope *of, rb_units units,
                                  char text[RB_CASE_SLOPE_HEADING])
{
    char heading[RB_ROLLING_HEADING];

    snprintf(text, RB_CASE_SLOPE_HEADING, "d_%s_by_",
             rb_rolling_heading(of->result, units, heading));
    append_word(of->input, text);
    if (strcmp(of->unit, "-") != 0 && *of->unit) {
        append_word("_", text);
        append_word(rb_unit_name(units, of->unit), text);
    }
    return text;
}

/* ---- Of single solutions ----------------------------------------------------------- */

int rb_case_add_name(const char *name[RB_CASE_NUMBERS_MAX], int n, const char *one)
{
    int k = 0;

    while (k < n && strcmp(name[k], one) != 0)
        k++;
    if (k == n && n < RB_CASE_NUMBERS_MAX)
        name[n++] = one;
    return n;
}

int rb_case_slope_inputs(const rb_case_slopes *s, const char *name[RB_CASE_NUMBERS_MAX])
{
    int n = 0;

    for (int k = 0; k < s->n; k++)
        n = rb_case_add_name(name, n, s->of[k].input);
    return n;
}

rb_status rb_case_slopes_at(const rb_case *c, const rb_rolling_model *model,
                            const rb_case_slopes *s, double *row, rb_rolling_solution *deviation,
                            rb_message *why)
{
    const char *name[RB_CASE_NUMBERS_MAX];
    rb_case_tolerances t;
    rb_case_derivatives all = {.n = 0};
    const int n = rb_case_slope_inputs(s, name);
    const rb_status known = deviation ? rb_case_read_tolerances(c, s->tolerance, &t, why) : RB_OK;

    /* one tangent per input (D2) has the derivatives of all results */
    rb_status status =
        n > 0 ? rb_case_differentiate_by_numbers(c, model, n, name, &all, why) : RB_OK;
    for (int k = 0; k < s->n && status == RB_OK; k++)
        for (int j = 0; j < all.n; j++) {
            const rb_case_derivative *of = &all.of[j];
            if (of->status != RB_OK || strcmp(of->name, s->of[k].input) != 0)
                continue;
            for (int side = 0; side < 2; side++) {
                /* One side, where no element stands between two zones: both entries of the pair are
                 * the same. */
                const int from = of->d.sides == 1 ? 0 : side;
                if (of->d.has[from])
                    row[2 * k + side] = rb_rolling_number(s->of[k].result, &of->d.value[from]);
            }
        }
    if (status == RB_OK)
        status = known;
    if (status == RB_OK && deviation)
        status = rb_case_deviations(c, model, &t, deviation, why);
    rb_case_derivatives_free(&all);
    return status;
}

/* One row of a study: the derivatives, then the standard deviations; NAN where there are none. */
rb_status rb_case_slopes_row(const rb_case *c, const rb_rolling_model *model,
                             const rb_case_slopes *s, double *row, rb_message *why)
{
    double both[2 * RB_ROW_OWN];
    rb_rolling_solution deviation;

    for (int k = 0; k < 2 * RB_ROW_OWN; k++)
        both[k] = NAN;
    const rb_status status =
        rb_case_slopes_at(c, model, s, both, s->deviations > 0 ? &deviation : NULL, why);
    for (int k = 0; k < s->n; k++)
        row[k] = isnan(both[2 * k + 1]) ? both[2 * k] : both[2 * k + 1];
    for (int k = 0; k < s->deviations; k++)
        row[s->n + k] = status == RB_OK ? rb_rolling_number(s->deviation[k], &deviation) : NAN;
    return status == RB_ENOMEM ? status : RB_OK;
}

/* ---- Along a curve ----------------------------------------------------------------- */

void rb_case_assign(rb_case *c, const rb_option *o, double value)
{
    const int k = (int)(o - rb_case_table);
    char *words = (char *)&c->words;

    *(double *)(void *)(words + o->offset) = value;
    if (o->list) {
        rb_numbers *list = (rb_numbers *)(void *)(words + o->list);
        list->n = list->n > 1 ? list->n : 1;
        list->value[0] = value;
    }
    c->plain[k] = 0;
    c->given[k] = RB_GIVEN_NUMBER;
}

/* The single case that a point of a curve is. */
typedef struct {
    const rb_case *c;
    const rb_rolling_range *range;
    double mu;
    rb_case_slopes *s;
    rb_rolling_curve *deviations; /* NULL: not asked for */
    rb_rolling_point *point;      /* of who observes the curve; NULL: nobody */
    void *context;
} curve_slopes;

static rb_status case_of_point(const curve_slopes *of, const rb_rolling_model *model,
                               rb_case **made, rb_message *why)
{
    static const char *const name[] = {[RB_OVER_CREEP_RATIO] = "creep-ratio",
                                       [RB_OVER_CREEP] = "creep",
                                       [RB_OVER_SPEED] = "speed"};
    rb_case *point = *made = rb_case_copy(of->c);

    if (!point)
        return rb_fail(why, RB_ENOMEM, "out of memory for a case");
    /* one solution with one mu, at the point's place on the curve as the model was solved there */
    point->purpose = RB_CASE_SINGLE;
    point->words.mus.n = 1;
    rb_case_assign(point, rb_case_option("mu"), of->mu);
    const double value = !model                             ? of->range->from
                         : of->range->over == RB_OVER_CREEP ? model->rc->creep
                         : of->range->over == RB_OVER_SPEED ? model->rc->speed
                                                            : model->rc->creep_ratio;
    rb_case_assign(point, rb_case_option(name[of->range->over]), value);
    const rb_status s = rb_case_resolve(point, why);
    if (s != RB_OK) {
        rb_case_free(point);
        *made = NULL;
    }
    return s;
}

rb_status rb_case_curve_choose(const rb_case *c, const rb_rolling_range *range, const char *words,
                               const char *tolerance, rb_case_slopes *s, rb_message *why)
{
    rb_case_tolerances t;
    const curve_slopes of = {.c = c, .range = range, .mu = c->resolved.rc.mu};
    rb_case *point;
    rb_status status = case_of_point(&of, NULL, &point, why);

    *s = (rb_case_slopes){0};
    if (status != RB_OK)
        return status;
    if (words)
        status = rb_case_slopes_choose(point, &rb_rolling_solution_scalars, words,
                                       RB_CASE_SLOPES_MAX, s, why);
    if (status == RB_OK && tolerance)
        status = rb_case_read_tolerances(point, tolerance, &t, why);
    s->tolerance = tolerance;
    rb_case_free(point);
    return status;
}

/* Columns of NAN for the standard deviations of what the points of a curve have. */
static rb_status deviations_alloc(const rb_case *c, int points, rb_rolling_curve **deviations)
{
    rb_rolling_curve *d = *deviations = calloc(1, sizeof *d);

    if (!d)
        return RB_ENOMEM;
    d->n = points;
    for (int j = 0; j < rb_rolling_curve_columns.n; j++) {
        const rb_rolling_result *column = &rb_rolling_curve_columns.row[j],
                                *of_case = rb_rolling_find_result(&rb_rolling_solution_scalars,
                                                                  column->name);
        double **to = (double **)(void *)((char *)d + column->offset);
        if (!of_case || !rb_sensitivity_has(of_case) ||
            !rb_rolling_has_result(of_case, &c->resolved.rc, 0))
            continue;
        if (!(*to = rb_alloc((size_t)points, 1)))
            return RB_ENOMEM;
        for (int k = 0; k < points; k++)
            (*to)[k] = NAN;
    }
    return RB_OK;
}

/* The observer of a curve: derivatives and deviations of point k, by the model that has just been
 * solved there. */
static rb_status see_point(const rb_rolling_model *model, int k, void *context, rb_message *why)
{
    const curve_slopes *of = context;
    double *row = of->s->value + 2 * (size_t)k * (size_t)of->s->n;
    rb_message *reason = &of->s->reason;
    rb_rolling_solution deviation;
    rb_case *point;
    rb_status s = case_of_point(of, model, &point, reason);

    if (s == RB_OK)
        s = rb_case_slopes_at(point, model, of->s, row, of->deviations ? &deviation : NULL, reason);
    for (int j = 0; j < rb_rolling_curve_columns.n && s == RB_OK && of->deviations; j++) {
        const rb_rolling_result *column = &rb_rolling_curve_columns.row[j],
                                *of_case = rb_rolling_find_result(&rb_rolling_solution_scalars,
                                                                  column->name);
        double *to = rb_rolling_column(column, of->deviations);
        if (to && of_case)
            to[k] = rb_rolling_number(of_case, &deviation);
    }
    rb_case_free(point);
    /* a point without derivatives stays in the curve, with a note; only memory ends it */
    if (s == RB_ENOMEM)
        return rb_fail(why, s, "%s", reason->text);
    of->s->without += s != RB_OK;
    return of->point ? of->point(model, k, of->context, why) : RB_OK;
}

rb_status rb_case_curve_solve(const rb_case *c, const rb_rolling_range *range, double mu,
                              rb_rolling_point *point, void *context, rb_rolling_curve *curve,
                              rb_case_slopes *s, rb_message *why)
{
    rb_rolling_case rc = c->resolved.rc;
    curve_slopes of = {c, range, mu, s, NULL, point, context};
    /* room for a curve that returns; other numbers of points are refused below */
    const int rows =
        range->points >= 1 && range->points <= RB_ROLLING_MOST_POINTS ? 2 * range->points : 1;
    rb_status status = rb_case_slopes_alloc(rows, s);

    rc.mu = mu;
    *curve = (rb_rolling_curve){0};
    if (status == RB_OK && s->tolerance)
        status = deviations_alloc(c, rows, &of.deviations);
    status = status == RB_OK ? rb_rolling_curve_observe(&rc, range, see_point, &of, curve, why)
                             : rb_fail(why, status, "out of memory for derivatives");
    /* the curve may have fewer points than there was room for */
    s->rows = curve->n;
    curve->deviations = of.deviations;
    if (of.deviations)
        of.deviations->n = curve->n;
    if (status != RB_OK || s->without < s->rows)
        return status;
    if (why)
        *why = s->reason;
    return RB_EINVAL;
}
