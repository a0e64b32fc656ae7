/* The numbers of a case with respect to which its results can be differentiated. */
#include "analysis/sensitivity/derivatives.h"
#include "analysis/sensitivity/sensitivity.h"
#include "rolling/case/words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What stands for a number that is 0, where steps are taken over a part of it. */
static double natural_scale(const rb_case *c, const rb_option *o)
{
    const rb_rolling_derived *d = &c->resolved.derived;
    const double P = isnan(d->load) ? d->stress * d->half_width : d->load;

    return strcmp(o->unit, "mm") == 0       ? 1e-3 * d->half_width
           : strcmp(o->unit, "N/mm") == 0   ? P
           : strcmp(o->unit, "MPa") == 0    ? d->stress
           : strcmp(o->unit, "mm/MPa") == 0 ? 1e-2 * d->half_width / d->modulus
           : strcmp(o->unit, "MPa/mm") == 0 ? 1e-2 * d->modulus / d->half_width
           : strcmp(o->unit, "K") == 0      ? 1.0
           : strcmp(o->name, "creep") == 0  ? 1e-2 * d->half_width / d->radius
                                            : 1e-2;
}

/* The number in the case as it was given: an entry of a list, or the single value. */
static double *place_of(const rb_option *o, int entry, rb_resolved_case *words)
{
    rb_numbers *list = (rb_numbers *)(void *)((char *)words + o->list);

    return o->list && (entry > 0 || list->n > 0) ? &list->value[entry]
                                                 : (double *)(void *)((char *)words + o->offset);
}

/* Gives the number in a copy of the case another value in mm, N, MPa. */
static void give(const rb_case *c, const rb_option *o, int entry, double value, rb_case *copy)
{
    const int k = (int)(o - rb_case_table);
    rb_resolved_case *words = &copy->words;
    if (o->list) { /* its other numbers as they are resolved, in the same units */
        const rb_numbers *list =
            (const rb_numbers *)(const void *)((const char *)&c->resolved + o->list);
        *(rb_numbers *)(void *)((char *)words + o->list) = *list;
        if (list->n > 0)
            *(double *)(void *)((char *)words + o->offset) = list->value[0];
    }
    *place_of(o, entry, words) = value;
    if (entry == 0)
        *(double *)(void *)((char *)words + o->offset) = value;
    copy->plain[k] = 0;
    copy->given[k] = copy->given[k] ? copy->given[k] : RB_GIVEN_NUMBER;
}

/* A copy of the case in which the number is given.  A radius that the table of a gap has is a
 * number by itself, as in the inputs of a result, and stays when others change. */
static rb_case *varied(const rb_case *c, const rb_option *o, int entry, double value)
{
    rb_case *copy = rb_case_copy(c);

    if (copy && c->resolved.rc.gap == RB_GAP_TABLE && !rb_case_given(c, "radius") &&
        isfinite(c->resolved.rc.a.radius))
        give(c, rb_case_option("radius"), 0, c->resolved.rc.a.radius, copy);
    if (copy)
        give(c, o, entry, value, copy);
    return copy;
}

static rb_status vary_number(void *context, double value, rb_rolling_case *rc, rb_message *why)
{
    const rb_case_number *number = context;
    rb_case *copy = varied(number->c, number->option, number->entry, value);
    rb_status s =
        copy ? rb_case_resolve(copy, why) : rb_fail(why, RB_ENOMEM, "out of memory for a case");

    /* a load that was searched for does not continue that of Hertz's formula */
    if (s == RB_OK && !isnan(copy->resolved.rc.pressed_by) &&
        isnan(number->c->resolved.rc.pressed_by))
        s = rb_fail(why, RB_EINVAL,
                    "derivatives: under --max-pressure Hertz's formula says the load at this value "
                    "only; give --load");
    if (s == RB_OK)
        *rc = copy->resolved.rc;
    rb_case_free(copy);
    return s;
}

/* The option must have a meaning in the case, so that it could be given.  RB_ENOMEM. */
static rb_status has_meaning(const rb_case *c, const rb_option *o, int entry, double value,
                             int *means)
{
    /* The case is resolved again with the number changed to either side: a refusal on both sides
     * means that the number cannot be given here. */
    const double step = 1e-3 * (value != 0.0 ? fabs(value) : natural_scale(c, o));

    *means = 0;
    for (int side = -1; side <= 1 && !*means; side += 2) {
        rb_message why = {.text = ""};
        const double x = value + side * step;
        rb_case *copy = varied(c, o, entry, x);
        const rb_status s = copy ? rb_case_resolve(copy, &why) : RB_ENOMEM;
        rb_case_free(copy);
        if (s == RB_ENOMEM)
            return s;
        *means = s == RB_OK && x >= o->range.from && x <= o->range.to;
    }
    return RB_OK;
}

rb_status rb_case_numbers(const rb_case *c, rb_case_number *number, int *n, rb_message *why)
{
    *n = 0;
    /* Each number of the table of options that the case uses and that may vary. */
    for (const rb_option *o = rb_case_table; o < rb_case_table + rb_case_table_n; o++) {
        const rb_numbers *list =
            (const rb_numbers *)(const void *)((const char *)&c->resolved + o->list);
        if (o->kind != RB_OPTION_NUMBER || o->frozen)
            continue;
        for (int entry = 0; entry < (o->list && list->n > 1 ? list->n : 1); entry++) {
            rb_resolved_case resolved = c->resolved, words = c->words;
            const double value = *place_of(o, entry, &resolved);

            int means = 0;
            /* What a case has made of other numbers, as a load of a half-width, is none of its own;
             * but Q = 0 is, where nothing else is given. */
            const int is_own = entry > 0 ||
                               !isnan(*(double *)(void *)((char *)&words + o->offset)) ||
                               strcmp(o->name, "force") == 0;
            /* A word such as `none` stands for a value at which there is nothing to
             * differentiate. */
            if (*n == RB_CASE_NUMBERS_MAX || !isfinite(value) || !is_own ||
                (o->word && value == o->word_value && o->word_value != 0.0) ||
                (o->word && value == o->word_value && value == 0.0) || rb_case_is_replaced(c, o))
                continue;
            if (has_meaning(c, o, entry, value, &means) != RB_OK)
                return rb_fail(why, RB_ENOMEM, "out of memory for the numbers of a case");
            if (!means)
                continue;
            rb_case_number *it = &number[(*n)++];
            *it = (rb_case_number){.option = o, .entry = entry, .c = c};
            snprintf(it->name, sizeof it->name, entry ? "%.32s-%d" : "%.32s", o->name, entry + 1);
            it->input =
                (rb_sensitivity_input){.value = value,
                                       .scale = value != 0.0 ? fabs(value) : natural_scale(c, o),
                                       .from = o->range.from,
                                       .to = o->range.to,
                                       .vary = vary_number,
                                       .context = it};
        }
    }
    return RB_OK;
}

/* ---- By gap and mu over x ---------------------------------------------------------- */

const char *const rb_case_over_x_names[RB_CASE_OVER_X_N] = {[RB_CASE_OVER_X_LOAD] = "normal_load",
                                                            [RB_CASE_OVER_X_FORCE] =
                                                                "tangential_load",
                                                            [RB_CASE_OVER_X_APPROACH] = "approach",
                                                            [RB_CASE_OVER_X_CREEPAGE] = "creepage"};

/* One adjoint solve each (D3), by the matrix of the model or, if it was solved without
 * one, of a copy.  Derivatives of P, Q, delta and xi by the gap and by the coefficient of friction
 * of each element; over_x holds n of each kind, by gap, then by mu, for each of the four results.
 */
static rb_status differentiate_over_x(const rb_sensitivity *s, const rb_rolling_model *model,
                                      rb_case_derivatives *all, rb_message *why)
{
    const rb_contact_problem *p = &model->problem;
    const rb_contact_state *state = &model->state;
    const int n = p->n, has_matrix = model->bodies.F != NULL;
    rb_rolling_model copy = {.mesh = {.n = 0}};
    rb_sensitivity *of_copy = NULL;
    rb_contact_state weight = {0};
    rb_sensitivity_rate adjoint = {0};
    rb_status status = RB_OK;

    if ((!has_matrix && n >= RB_ROLLING_LARGE) || rb_rolling_law_depends_on_state(model->rc) ||
        all->degenerate)
        return RB_OK;
    /* The adjoint needs J', and so the matrix; products give only J. */
    if (!has_matrix) {
        status = rb_rolling_variant_with_matrix(model, &copy, why);
        if (status == RB_OK)
            status = rb_sensitivity_create(&copy, 0, &of_copy, why);
        s = of_copy;
    }
    if (status == RB_OK && !(all->over_x = rb_alloc((size_t)n, 2 * RB_CASE_OVER_X_N)))
        status = RB_ENOMEM;
    if (status == RB_OK)
        status = rb_contact_state_alloc(n, &weight);
    if (status == RB_OK)
        status = rb_sensitivity_rate_alloc(n, &adjoint);
    /* The result is a linear form of p, q, delta and xi: its weights are the right side of J'
     * (D3). */
    for (int k = 0; k < RB_CASE_OVER_X_N && status == RB_OK; k++) {
        double *by_gap = all->over_x + (size_t)(2 * k) * (size_t)n, *by_mu = by_gap + n;
        for (int i = 0; i < n; i++) {
            weight.p[i] = k == RB_CASE_OVER_X_LOAD    ? p->load_N[i]
                          : k == RB_CASE_OVER_X_FORCE ? p->force_N[i]
                                                      : 0.0;
            weight.q[i] = k == RB_CASE_OVER_X_LOAD    ? p->load_T[i]
                          : k == RB_CASE_OVER_X_FORCE ? p->force_T[i]
                                                      : 0.0;
        }
        weight.delta = k == RB_CASE_OVER_X_APPROACH;
        weight.xi = k == RB_CASE_OVER_X_CREEPAGE;
        status = rb_sensitivity_adjoint(s, &weight, &adjoint, why);
        /* a given part of what friction carries changes with it */
        const double part = p->force_given ? adjoint.tangential * p->force_ratio /
                                                 (p->mu * p->stress * model->bodies.f.h[0])
                                           : 0.0;
        for (int i = 0; i < n && status == RB_OK; i++) {
            by_gap[i] = adjoint.gap[i];
            by_mu[i] =
                adjoint.bound[i] -
                (part != 0.0 ? part * (p->load_N[i] * state->p[i] + p->load_T[i] * state->q[i])
                             : 0.0);
        }
    }
    all->n_x = status == RB_OK ? n : 0;
    rb_sensitivity_rate_free(&adjoint);
    rb_contact_state_free(&weight);
    rb_sensitivity_free(of_copy);
    rb_rolling_model_free(&copy);
    return status == RB_ENOMEM ? rb_fail(why, status, "out of memory for derivatives") : RB_OK;
}

/* What is computed: derivatives by numbers; those over x, too; smooth ones by numbers, or these
 * where there are any. */
typedef enum { BY_NUMBERS, AND_OVER_X, SMOOTH, SMOOTH_WHERE_POSSIBLE } kind_of_derivatives;

/* Derivatives with respect to one number: it->d has both sides (D1), and where jumps of zones are
 * known the smooth value (D8) takes their place. */
static void differentiate_by(const rb_sensitivity *s, const rb_sensitivity_jumps *jumps,
                             kind_of_derivatives kind, const rb_case_number *number,
                             rb_case_derivative *it)
{
    memcpy(it->name, number->name, sizeof it->name);
    it->unit = number->option->unit;
    it->value = number->input.value;
    it->status = rb_sensitivity_differentiate(s, &number->input, &it->d, &it->why);
    if (it->status != RB_OK || !jumps)
        return;
    /* (D8) has no free creepage where no edge moves; (D2) has. */
    double free_creepage[2];
    for (int side = 0; side < 2; side++)
        free_creepage[side] = it->d.value[side].free_creepage;
    it->status = rb_sensitivity_smooth(jumps, &number->input, &it->d, &it->why);
    if (kind == SMOOTH || it->status == RB_ENOMEM)
        return;
    for (int side = 0; side < 2 && it->status == RB_OK; side++)
        if (isnan(it->d.value[side].free_creepage))
            it->d.value[side].free_creepage = free_creepage[side];
    if (it->status != RB_OK) {
        rb_sensitivity_derivative_free(&it->d);
        it->status = rb_sensitivity_differentiate(s, &number->input, &it->d, &it->why);
    }
}

static rb_status differentiate_all(const rb_case *c, const rb_rolling_model *model,
                                   kind_of_derivatives kind, int n, const char *const *names,
                                   rb_case_derivatives *all, rb_message *why)
{
    int numbers;
    rb_sensitivity *s = NULL;
    rb_sensitivity_jumps *jumps = NULL;
    rb_case_number *number = calloc(RB_CASE_NUMBERS_MAX, sizeof *number);

    *all = (rb_case_derivatives){.of = calloc(RB_CASE_NUMBERS_MAX, sizeof(rb_case_derivative)),
                                 .smooth = kind == SMOOTH};
    /* One factorisation of J serves all numbers. */
    rb_status status = number && all->of ? rb_sensitivity_create(model, 1, &s, why)
                                         : rb_fail(why, RB_ENOMEM, "out of memory for derivatives");
    if (status == RB_OK && kind >= SMOOTH)
        status = rb_sensitivity_jumps_create(s, &jumps, why);
    /* Without smooth derivatives those of (D2) are taken. */
    if (status != RB_ENOMEM && s && kind == SMOOTH_WHERE_POSSIBLE)
        status = RB_OK;
    if (status == RB_OK)
        status = rb_case_numbers(c, number, &numbers, why);
    for (int k = 0; status == RB_OK && k < numbers; k++) {
        const char *name = number[k].name;
        int asked = n == 0;
        for (int i = 0; i < n; i++)
            asked |= strcmp(names[i], name) == 0;
        if (!asked)
            continue;
        rb_case_derivative *it = &all->of[all->n++];
        differentiate_by(s, jumps, kind, &number[k], it);
        if (it->status == RB_ENOMEM)
            status = rb_fail(why, RB_ENOMEM, "%s", it->why.text);
        if (status == RB_OK && rb_interrupted())
            status = rb_fail(why, RB_INTERRUPTED, "derivatives: interrupted at %s", it->name);
    }
    if (s) {
        all->degenerate = rb_sensitivity_degenerate(s);
        all->elements = rb_sensitivity_motion(s);
    }
    if (status == RB_OK && kind == AND_OVER_X)
        status = differentiate_over_x(s, model, all, why);
    rb_sensitivity_jumps_free(jumps);
    rb_sensitivity_free(s);
    free(number);
    return status;
}

rb_status rb_case_differentiate(const rb_case *c, const rb_rolling_model *model, int n,
                                const char *const *names, rb_case_derivatives *all, rb_message *why)
{
    return differentiate_all(c, model, AND_OVER_X, n, names, all, why);
}

rb_status rb_case_differentiate_by_numbers(const rb_case *c, const rb_rolling_model *model, int n,
                                           const char *const *names, rb_case_derivatives *all,
                                           rb_message *why)
{
    return differentiate_all(c, model, BY_NUMBERS, n, names, all, why);
}

rb_status rb_case_differentiate_smoothly(const rb_case *c, const rb_rolling_model *model, int n,
                                         const char *const *names, rb_case_derivatives *all,
                                         rb_message *why)
{
    return differentiate_all(c, model, SMOOTH, n, names, all, why);
}

rb_status rb_case_differentiate_by_tolerances(const rb_case *c, const rb_rolling_model *model,
                                              const rb_case_tolerances *t, rb_case_derivatives *all,
                                              rb_message *why)
{
    const char *name[RB_CASE_TOLERANCES_MAX];

    for (int k = 0; k < t->n; k++)
        name[k] = t->name[k];
    return differentiate_all(c, model, SMOOTH_WHERE_POSSIBLE, t->n, name, all, why);
}

/* A derivative has the unit of the result over that of the number; those by the gap are per length
 * of the gap, those by mu only have the unit of the result. */
void rb_case_derivatives_convert(rb_case_derivatives *all, rb_units units)
{
    static const char *const unit[RB_CASE_OVER_X_N] = {"N/mm", "N/mm", "mm", NULL};

    all->units = units;
    for (int i = 0; i < 2 * RB_CASE_OVER_X_N * all->n_x; i++) {
        const int k = i / all->n_x;
        if (unit[k / 2])
            all->over_x[i] = rb_unit_shown(units, unit[k / 2], all->over_x[i]);
        if (k % 2 == 0)
            all->over_x[i] /= rb_unit_shown(units, "mm", 1.0);
    }
    for (int k = 0; k < all->n; k++) {
        rb_case_derivative *it = &all->of[k];
        const double one = rb_unit_shown(units, it->unit, 1.0);
        it->value = rb_unit_shown(units, it->unit, it->value);
        for (int side = 0; side < 2 && it->status == RB_OK; side++) {
            rb_rolling_solution *s = &it->d.value[side];
            if (!it->d.has[side])
                continue;
            rb_rolling_solution_convert(s, units);
            rb_sensitivity_scale(s, 1.0 / one);
        }
    }
}

void rb_case_derivatives_free(rb_case_derivatives *all)
{
    for (int k = 0; k < all->n; k++)
        rb_sensitivity_derivative_free(&all->of[k].d);
    free(all->of);
    free(all->over_x);
    *all = (rb_case_derivatives){0};
}

const char *rb_case_derivatives_are(const rb_case_derivatives *all)
{
    static const char *const text[] = {
        [RB_SENSITIVITY_FIXED] = "on the elements of the solution, which do not move",
        [RB_SENSITIVITY_ZONE] = "on elements that grow as the automatic zone does",
        [RB_SENSITIVITY_EDGES] = ("on elements that move with the edges of the contact, "
                                  "to which they are fitted")};
    return text[all->elements];
}

/* ---- Names, and uncertain inputs ---------------------------------------------------- */

const rb_rolling_result *rb_case_derivative_result(const char *name, int *is_column)
{
    const rb_rolling_result *r = rb_rolling_find_result(&rb_rolling_solution_scalars, name);

    *is_column = !(r && rb_sensitivity_has(r));
    if (*is_column)
        r = rb_rolling_find_result(&rb_rolling_solution_columns, name);
    return r && rb_sensitivity_has(r) ? r : NULL;
}

rb_status rb_case_refuse_result(const char *name, const rb_rolling_results *table, const char *more,
                                rb_message *why)
{
    rb_guess guess = {.word = name};

    if (more)
        rb_guess_try(&guess, more);
    for (int k = 0; k < table->n; k++)
        if (rb_sensitivity_has(&table->row[k]))
            rb_guess_try(&guess, table->row[k].name);
    return rb_fail(why, RB_EINVAL, "expected a result that has derivatives%s, got '%.60s'%s",
                   table == &rb_rolling_history_columns ? " step by step" : "", name,
                   rb_guess_text(&guess, ""));
}

rb_status rb_case_name_option(const char *option, rb_status s, rb_message *why)
{
    return s != RB_EINVAL ? s : rb_refuse(why, option, "%.450s", why ? why->text : "");
}

/* "mu = 0.02, radius = 1%" */
static char *without_blanks(char *text)
{
    text += strspn(text, " ");
    size_t n = strlen(text);
    while (n > 0 && text[n - 1] == ' ')
        text[--n] = '\0';
    return text;
}

/* "0.02", "1%", "0.5mm" of the number; RB_EINVAL. */
static rb_status read_deviation(const rb_case_number *number, const char *text, double *deviation,
                                rb_message *why)
{
    char digits[64];
    const size_t n = strlen(text);

    if (n > 1 && n < sizeof digits && text[n - 1] == '%') {
        snprintf(digits, sizeof digits, "%.*s", (int)n - 1, text);
        if (!rb_option_number(without_blanks(digits), deviation))
            return RB_EINVAL;
        *deviation *= 0.01 * fabs(number->input.value);
        return RB_OK;
    }
    return rb_case_read_number(number->c, text, number->option->unit, deviation, why);
}

rb_status rb_case_read_tolerances(const rb_case *c, const char *text, rb_case_tolerances *t,
                                  rb_message *why)
{
    rb_case_number *number = calloc(RB_CASE_NUMBERS_MAX, sizeof *number);
    rb_status s = number ? RB_OK : rb_fail(why, RB_ENOMEM, "out of memory for tolerances");
    char word[100];
    int numbers = 0;

    t->n = 0;
    if (s == RB_OK)
        s = rb_case_numbers(c, number, &numbers, why);
    if (s == RB_OK && !*text)
        s = rb_fail(why, RB_EINVAL, "expected NAME=X, got ''");
    while (s == RB_OK && (text = rb_next_word(text, word, sizeof word))) {
        char *value = strchr(word, '=');
        int k = 0;
        if (value)
            *value++ = '\0';
        char *name = without_blanks(word);
        rb_guess guess = {.word = name};
        int twice = 0;
        value = value ? without_blanks(value) : NULL;
        for (int i = 0; i < t->n; i++)
            twice |= strcmp(t->name[i], name) == 0;
        for (; k < numbers && strcmp(number[k].name, name) != 0; k++)
            rb_guess_try(&guess, number[k].name);
        if (k == numbers || t->n == RB_CASE_TOLERANCES_MAX)
            s = rb_fail(why, RB_EINVAL, "'%s' is not a number of this case%s", name,
                        rb_guess_text(&guess, ""));
        else if (twice)
            s = rb_fail(why, RB_EINVAL, "%s: given twice", name);
        else if (!value)
            s = rb_fail(why, RB_EINVAL, "%s: expected %s=X, X its standard deviation", name, name);
        else if (read_deviation(&number[k], value, &t->deviation[t->n], why) != RB_OK ||
                 !(t->deviation[t->n] >= 0.0 && isfinite(t->deviation[t->n])))
            s = rb_fail(why, RB_EINVAL,
                        "%s: expected a standard deviation >= 0 or per cent, got '%s'", name,
                        value);
        else {
            t->unit[t->n] = number[k].option->unit;
            t->value[t->n] = number[k].input.value;
            memcpy(t->name[t->n++], number[k].name, sizeof number[k].name);
        }
    }
    free(number);
    return s == RB_EINVAL ? rb_case_name_option("tolerance", s, why) : s;
}

/* Standard deviation of each result for independent inputs: the root of the sum of (slope times
 * deviation)^2, with the mean magnitude of both sides where they differ. */
rb_status rb_case_propagate(const rb_case_tolerances *t, const rb_case_derivatives *all,
                            rb_rolling_solution *deviation, rb_message *why)
{
    *deviation = (rb_rolling_solution){.units = all->units};
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        double deviates = 0.0;
        for (int i = 0; i < t->n; i++) {
            const rb_case_derivative *of = all->of;
            while (of < all->of + all->n && strcmp(of->name, t->name[i]) != 0)
                of++;
            if (of == all->of + all->n || of->status != RB_OK)
                return rb_fail(why, RB_EINVAL, "tolerance: %s: %s", t->name[i],
                               of == all->of + all->n ? "no derivatives" : of->why.text);
            const double left = of->d.has[0] ? rb_rolling_number(r, &of->d.value[0]) : NAN,
                         right = of->d.sides == 1 ? left
                                 : of->d.has[1]   ? rb_rolling_number(r, &of->d.value[1])
                                                  : NAN;
            const double slope = isnan(left)    ? right
                                 : isnan(right) ? left
                                                : 0.5 * (fabs(left) + fabs(right));
            deviates = hypot(deviates, slope * t->deviation[i]); /* a square may overflow */
        }
        if (r->kind != RB_RESULT_WHOLE)
            rb_rolling_set_number(r, deviation, rb_sensitivity_has(r) ? deviates : NAN);
    }
    return RB_OK;
}

rb_status rb_case_deviations(const rb_case *c, const rb_rolling_model *model,
                             const rb_case_tolerances *t, rb_rolling_solution *deviation,
                             rb_message *why)
{
    rb_case_derivatives all;

    rb_status s = rb_case_differentiate_by_tolerances(c, model, t, &all, why);
    if (s == RB_OK)
        s = rb_case_propagate(t, &all, deviation, why);
    rb_case_derivatives_free(&all);
    return s;
}
