/* Designs: a case as a function of some of its numbers, with its gradient, for NLopt. */
#include "analysis/sensitivity/derivatives.h"
#include "analysis/sensitivity/sensitivity.h"
#include "analysis/design/design.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifndef RB_NLOPT /* builds by hand */
#define RB_NLOPT 0
#endif
#if RB_NLOPT
#include <nlopt.h>
#endif

enum { EVALUATIONS = 200, PROFILES = 12, SEARCHES = 5 };
/* Constraints may be missed by this part of their bounds. */
static const double MISSED = 1e-6;

int rb_design_available(void)
{
    return RB_NLOPT;
}

void rb_design_free(rb_design *d)
{
    free(d->variable);
    d->variable = NULL;
}

/* ---- What is asked for ------------------------------------------------------------- */

static const char ripple_[] = "pressure_ripple";

const char *rb_design_result_name(const rb_rolling_result *result)
{
    return result ? result->name : ripple_;
}

/* *result NULL: the ripple of the pressure, which no table of results has. */
static rb_status find_result(const char *option, const char *name, const rb_rolling_result **result,
                             rb_message *why)
{
    int is_column = 0;

    *result = NULL;
    if (strcmp(name, ripple_) == 0)
        return RB_OK;
    *result = rb_case_derivative_result(name, &is_column);
    if (*result && !is_column)
        return RB_OK;
    rb_message reason;
    rb_case_refuse_result(name, &rb_rolling_solution_scalars, ripple_, &reason);
    return rb_refuse(why, option, "%s", reason.text);
}

const char *rb_design_name(const rb_design *d)
{
    return d->input ? d->input->name : rb_design_result_name(d->result);
}

const char *rb_design_unit(const rb_design *d)
{
    return d->input ? d->input->unit : d->result ? d->result->unit : NULL;
}

rb_status rb_design_objective(const char *name, rb_design *d, rb_message *why)
{
    const rb_status s = find_result("minimise,maximise", name, &d->result, why);
    const rb_option *o = rb_case_option(name);

    d->input = s != RB_OK && o && o->kind == RB_OPTION_NUMBER ? o : NULL;
    return d->input ? RB_OK : s;
}

/* The input that is the objective has to be one of the variables. */
static rb_status find_input(rb_design *d, rb_message *why)
{
    for (d->input_at = 0; d->input && d->input_at < d->n; d->input_at++)
        if (strcmp(d->variable[d->input_at].name, d->input->name) == 0)
            return RB_OK;
    return !d->input ? RB_OK
                     : rb_refuse(why, "minimise,maximise",
                                 "%s is no result, and an input has to be varied: add %s=A:B "
                                 "to --over",
                                 d->input->name, d->input->name);
}

rb_status rb_design_constraints(const rb_case *c, const char *text, rb_design *d, rb_message *why)
{
    char word[120];

    while ((text = rb_next_word(text, word, sizeof word))) {
        char *sign = strpbrk(word, "<>");
        if (!sign)
            return rb_refuse(why, "subject", "expected RESULT<=X or RESULT>=X, got '%s'", word);
        if (d->constraints == RB_DESIGN_CONSTRAINTS)
            return rb_refuse(why, "subject", "expected at most %d constraints",
                             RB_DESIGN_CONSTRAINTS);
        rb_design_constraint *k = &d->constraint[d->constraints++];
        *k = (rb_design_constraint){.at_least = *sign == '>'};
        const char *number = sign + 1 + (sign[1] == '=');
        number += strspn(number, " ");
        do
            *sign = '\0'; /* and blanks before it */
        while (sign > word && *--sign == ' ');
        if (find_result("subject", word, &k->result, why) != RB_OK)
            return RB_EINVAL;
        const char *unit = k->result && k->result->unit ? k->result->unit : "-";
        rb_message of_unit = {.text = ""};
        if (rb_case_read_number(c, number, unit, &k->bound, &of_unit) != RB_OK)
            return of_unit.text[0]
                       ? rb_refuse(why, "subject", "%s: expected %.200s", word, of_unit.text)
                       : rb_refuse(why, "subject", "%s: expected a number, got '%.40s'", word,
                                   number);
    }
    return RB_OK;
}

static rb_status read_bounds(const rb_case *c, const char *name, const char *unit, char *text,
                             double bound[2], rb_message *why)
{
    char *colon = text ? strchr(text, ':') : NULL;

    if (colon)
        *colon = '\0';
    for (int k = 0; k < 2; k++) {
        rb_message of_unit = {.text = ""};
        if (!colon ||
            rb_case_read_number(c, k ? colon + 1 : text, unit, &bound[k], &of_unit) != RB_OK)
            return of_unit.text[0]
                       ? rb_refuse(why, "over", "%s: expected %.200s", name, of_unit.text)
                       : rb_refuse(why, "over", "expected %s=A:B", name);
    }
    return bound[0] < bound[1] ? RB_OK : rb_refuse(why, "over", "%s: expected A < B", name);
}

/* In mm, N, MPa; the search starts from the value that the case has. */
static rb_status add_variable(rb_design *d, const char *name, const char *unit, double low,
                              double high, double start, rb_message *why)
{
    rb_design_variable *all = realloc(d->variable, (size_t)(d->n + 1) * sizeof *all);
    if (!all)
        return rb_fail(why, RB_ENOMEM, "out of memory for a design");
    d->variable = all;
    all[d->n] = (rb_design_variable){
        .unit = unit, .low = low, .high = high, .start = start, .value = start};
    snprintf(all[d->n].name, sizeof all->name, "%.39s", name);
    d->n++;
    return RB_OK;
}

/* The number of that name, or every value of the table of the gap; range: "A:B". */
static rb_status add_variables(const rb_case *c, int numbers, const rb_case_number *number,
                               const char *name, char *range, rb_design *d, rb_message *why)
{
    rb_guess guess = {.word = name};
    const int is_gap = strcmp(name, "gap") == 0;
    const double *gap = NULL;
    double bound[2];
    int k = 0;

    for (; !is_gap && k < numbers && strcmp(number[k].name, name) != 0; k++)
        rb_guess_try(&guess, number[k].name);
    if (!is_gap && (k == numbers || number[k].entry > 0))
        return rb_refuse(why, "over", "'%.40s' is not a number of this case%s", name,
                         rb_guess_text(&guess, ""));
    const char *unit = is_gap ? "mm" : number[k].option->unit;
    if (read_bounds(c, name, unit, range, bound, why) != RB_OK)
        return RB_EINVAL;
    if (!is_gap) {
        const double value = number[k].input.value;
        const rb_units units = rb_case_resolved(c)->units;
        if (!(bound[0] <= value && value <= bound[1]))
            return rb_refuse(why, "over", "%s begins at %g %s, which is not within its bounds",
                             name, rb_unit_shown(units, unit, value), rb_unit_name(units, unit));
        return add_variable(d, name, unit, bound[0], bound[1], value, why);
    }
    d->gap_from = d->n;
    d->gap_n = rb_case_gap_rows(c, &d->gap_x, &gap);
    if (d->gap_n == 0)
        return rb_refuse(why, "over", "gap needs a gap from a table (--gap FILE)");
    rb_status s = RB_OK;
    for (int i = 0; i < d->gap_n && s == RB_OK; i++) {
        char row[40];
        snprintf(row, sizeof row, "gap-%d", i + 1);
        s = add_variable(d, row, unit, gap[i] + bound[0], gap[i] + bound[1], gap[i], why);
    }
    return s;
}

rb_status rb_design_variables(const rb_case *c, const char *text, rb_design *d, rb_message *why)
{
    rb_case_number *number = calloc(RB_CASE_NUMBERS_MAX, sizeof *number);
    int numbers = 0;
    rb_status s = number ? rb_case_numbers(c, number, &numbers, why)
                         : rb_fail(why, RB_ENOMEM, "out of memory for a design");
    char word[120];

    while (s == RB_OK && (text = rb_next_word(text, word, sizeof word))) {
        char *range = strchr(word, '=');
        if (range)
            *range++ = '\0';
        for (int k = 0; k < d->n && s == RB_OK; k++)
            if (strcmp(d->variable[k].name, word) == 0)
                s = rb_refuse(why, "over", "%s stands there twice", word);
        if (s == RB_OK)
            s = add_variables(c, numbers, number, word, range, d, why);
    }
    free(number);
    if (s == RB_OK && d->n == 0)
        s = rb_fail(why, RB_EINVAL, "design: needs --over NAME=A:B");
    return s == RB_OK ? find_input(d, why) : s;
}

/* ---- The case as a function -------------------------------------------------------- */

/* One evaluation: all functions (the result, then the constraints) and their gradients. */
typedef struct {
    const rb_case *c;
    rb_design *d;
    const rb_design_observer *observer;
    double *x;        /* n: where; owned, as all here */
    double *value;    /* 1 + constraints */
    double *gradient; /* (1 + constraints) x n, row by row */
    double *best;     /* n: of the evaluation with the least value that meets all */
    double best_value;
    int known;         /* 1: of x */
    int failed;        /* 1: at x there is no solution */
    rb_message reason; /* why not; "": no evaluation has failed */
    rb_rolling_profile *profile[PROFILES];
    int profiles;
    rb_status status;
    rb_message *why;
} problem;

static void forget_profiles(problem *p, int but)
{
    while (p->profiles > but)
        rb_rolling_profile_free(p->profile[--p->profiles]);
}

/* The gap with these values; entry `varied` (-1: none) has another one. */
static rb_status set_profile(problem *p, const double *x, int varied, double value,
                             rb_rolling_case *rc, rb_message *why)
{
    const rb_design *d = p->d;
    double *gap = rb_alloc((size_t)d->gap_n, 1);
    rb_status s = gap && p->profiles < PROFILES
                      ? RB_OK
                      : rb_fail(why, RB_ENOMEM, "out of memory for a design");

    for (int k = 0; k < d->gap_n && s == RB_OK; k++)
        gap[k] = k == varied ? value : x[d->gap_from + k];
    if (s == RB_OK)
        s = rb_rolling_profile_smooth(d->gap_n, d->gap_x, gap, &p->profile[p->profiles], why);
    if (s == RB_OK)
        rc->profile = p->profile[p->profiles++];
    free(gap);
    return s;
}

typedef struct {
    problem *p;
    const rb_rolling_case *rc;         /* at x */
    const rb_sensitivity_input *input; /* of a number; NULL: entry of the gap */
    int entry;
} variation;

/* The case with one variable changed, for the derivative by it. All variations keep the table of
 * the gap at x, which rb_case_resolve would read from its file. */
static rb_status vary_variable(void *context, double value, rb_rolling_case *rc, rb_message *why)
{
    const variation *v = context;

    if (!v->input) {
        *rc = *v->rc;
        return set_profile(v->p, v->p->x, v->entry, value, rc, why);
    }
    const rb_status s = v->input->vary(v->input->context, value, rc, why);
    if (s == RB_OK && v->p->d->gap_n > 0)
        rc->profile = v->rc->profile;
    return s;
}

/* Length of element i within the span. */
static double weight_of(const rb_rolling_solution *s, double span, int i)
{
    return span == 0.0 || fabs(s->x[i]) < span ? s->h[i] : 0.0;
}

/* Values of all functions; along a derivative: their rates. */
static void read_functions(const rb_design *d, const rb_rolling_solution *s,
                           const rb_rolling_solution *along, double *f, int stride)
{
    /* ripple^2 = mean of (p/p_mean - 1)^2 over the span; its rate follows from those of p and
     * p_mean. */
    double length = 0.0, mean = 0.0, sum = 0.0, mean_rate = 0.0, sum_rate = 0.0;

    /* The ripple, and its derivative. */
    for (int i = 0; i < s->n; i++) {
        const double h = weight_of(s, d->span, i);
        length += h;
        mean += h * s->p[i];
        mean_rate += along ? h * along->p[i] : 0.0;
    }
    mean /= length;
    mean_rate /= length;
    for (int i = 0; i < s->n; i++) {
        const double off = s->p[i] / mean - 1.0, h = weight_of(s, d->span, i);
        sum += h / length * off * off;
        sum_rate += along
                        ? 2.0 * h / length * off * (along->p[i] - s->p[i] * mean_rate / mean) / mean
                        : 0.0;
    }
    const double ripple = sqrt(sum), rate = ripple > 0.0 ? 0.5 * sum_rate / ripple : 0.0;
    for (int k = 0; k <= d->constraints; k++) {
        const rb_rolling_result *r = k == 0 ? d->result : d->constraint[k - 1].result;
        f[(size_t)k * (size_t)stride] = r       ? rb_rolling_number(r, along ? along : s)
                                        : along ? rate
                                                : ripple;
    }
}

/* The gradients of all functions at x, by one factorisation of J (D2); column j of `gradient` is
 * that of variable j. */
static rb_status differentiate_functions(problem *p, const rb_case *at, const rb_rolling_case *rc,
                                         const rb_rolling_model *model,
                                         const rb_rolling_solution *solution)
{
    const rb_design *d = p->d;
    rb_case_number *number = calloc(RB_CASE_NUMBERS_MAX, sizeof *number);
    rb_sensitivity *s = NULL;
    int numbers = 0;
    rb_status status = number ? rb_case_numbers(at, number, &numbers, p->why) : RB_ENOMEM;

    if (status == RB_OK)
        status = rb_sensitivity_create(model, 1, &s, p->why);
    for (int j = 0; j < d->n && status == RB_OK; j++) {
        const rb_design_variable *v = &d->variable[j];
        const int is_gap = j >= d->gap_from && j < d->gap_from + d->gap_n;
        rb_sensitivity_derivative by;
        variation varied = {.p = p, .rc = rc, .entry = j - d->gap_from};
        rb_sensitivity_input input = {p->x[j],  v->high - v->low, -INFINITY,
                                      INFINITY, vary_variable,    &varied};
        for (int k = 0; k < numbers && !is_gap; k++)
            if (strcmp(number[k].name, v->name) == 0) {
                varied.input = &number[k].input;
                input = number[k].input;
                input.vary = vary_variable;
                input.context = &varied;
            }
        status = rb_sensitivity_differentiate(s, &input, &by, p->why);
        if (status == RB_OK)
            read_functions(d, solution, &by.value[by.has[0] ? 0 : 1], &p->gradient[j], d->n);
        p->gradient[j] = d->input ? j == d->input_at : p->gradient[j];
        rb_sensitivity_derivative_free(&by);
        forget_profiles(p, d->gap_n > 0 ? 1 : 0); /* the first one is that of x */
    }
    rb_sensitivity_free(s);
    free(number);
    return status;
}

/* A result that the case has not, or that has no derivative, is no function to search with. */
static rb_status check_known(problem *p, rb_rolling_formulation formulation)
{
    const rb_design *d = p->d;

    for (int k = 0; k <= d->constraints; k++) {
        const char *name =
            k == 0 ? rb_design_name(d) : rb_design_result_name(d->constraint[k - 1].result);
        if (isnan(p->value[k]))
            return rb_fail(p->why, RB_EINVAL, "design: this %scase has no %s%s",
                           formulation == RB_STATIC ? "static " : "", name,
                           formulation == RB_STATIC ? "; see --formulation steady" : "");
        for (int j = 0; j < d->n; j++)
            if (isnan(p->gradient[k * d->n + j]))
                return rb_fail(p->why, RB_EINVAL, "design: %s has no derivative by %s here", name,
                               d->variable[j].name);
    }
    return RB_OK;
}

/* Solves the case at x: values of all functions, their gradients, and whether x is the best so
 * far. */
static rb_status evaluate_at(problem *p, const double *x)
{
    rb_design *d = p->d;
    rb_case *at = rb_case_copy(p->c);
    rb_rolling_model model = {.mesh = {.n = 0}};
    rb_rolling_solution solution = {.n = 0};
    rb_rolling_case rc;
    rb_status s = at ? RB_OK : rb_fail(p->why, RB_ENOMEM, "out of memory for a case");

    memcpy(p->x, x, (size_t)d->n * sizeof *x);
    for (int j = 0; j < d->n && s == RB_OK; j++) /* x is in mm, N, MPa, whatever the case is in */
        if (j < d->gap_from || j >= d->gap_from + d->gap_n)
            s = rb_case_set_number(
                at, d->variable[j].name,
                rb_unit_shown(rb_case_units(at, RB_GIVEN_ARGUMENT), d->variable[j].unit, x[j]),
                p->why);
    if (s == RB_OK)
        s = rb_case_resolve(at, p->why);
    if (s == RB_OK)
        rc = rb_case_resolved(at)->rc;
    if (s == RB_OK && d->gap_n > 0)
        s = set_profile(p, x, -1, 0.0, &rc, p->why);
    if (s == RB_OK)
        s = rb_rolling_solve_model(&rc, &model, &solution, p->why);
    if (s == RB_OK) {
        read_functions(d, &solution, NULL, p->value, 1);
        p->value[0] = d->input ? x[d->input_at] : p->value[0];
        s = differentiate_functions(p, at, &rc, &model, &solution);
        s = s == RB_OK ? check_known(p, rc.formulation) : s;
    }
    if (s == RB_OK) {
        if (d->evaluations++ == 0)
            d->start = p->value[0];
        /* It is the best so far if it meets all constraints. */
        const double f = d->largest ? -p->value[0] : p->value[0];
        int meets = 1;
        for (int k = 0; k < d->constraints; k++) {
            const rb_design_constraint *c = &d->constraint[k];
            const double over = (c->at_least ? -1.0 : 1.0) * (p->value[1 + k] - c->bound);
            meets &= over <= MISSED * fmax(fabs(c->bound), 1e-300);
        }
        if (meets && f < p->best_value) {
            p->best_value = f;
            memcpy(p->best, x, (size_t)d->n * sizeof *p->best);
            d->value = p->value[0];
            for (int k = 0; k < d->constraints; k++)
                d->constraint[k].value = p->value[1 + k];
        }
        if (p->observer && p->observer->step &&
            p->observer->step(d->evaluations, p->value[0], x, p->observer->context))
            s = rb_fail(p->why, RB_INTERRUPTED, "design: interrupted after %d evaluations",
                        d->evaluations);
    }
    rb_rolling_solution_free(&solution);
    rb_rolling_model_free(&model);
    forget_profiles(p, 0);
    rb_case_free(at);
    return s;
}

/* ---- NLopt ------------------------------------------------------------------------- */

#if RB_NLOPT

/* Function k of the problem, as NLopt wants it; u: 0 ... 1 between the bounds. */
typedef struct {
    problem *p;
    nlopt_opt opt;
    int k;
    double scale; /* f = scale (value - bound) */
    double bound;
} function;

/* NLopt asks for each function separately, at the same point: the case is solved once for all of
 * them. */
static double function_value(unsigned n, const double *u, double *gradient, void *context)
{
    function *f = context;
    problem *p = f->p;
    rb_design_variable *v = p->d->variable;
    double *x = rb_alloc(n, 1);
    int same = p->known;

    if (!x)
        p->status = RB_ENOMEM;
    for (unsigned j = 0; j < n && x; j++) {
        x[j] = v[j].low + u[j] * (v[j].high - v[j].low);
        same = same && x[j] == p->x[j];
    }
    if (!same && p->status == RB_OK) {
        const rb_status s = evaluate_at(p, x);
        p->failed = s != RB_OK;
        p->reason = p->failed ? *p->why : p->reason;
        p->status = s == RB_ENOMEM || s == RB_INTERRUPTED ? s : RB_OK;
    }
    free(x);
    p->known = p->status == RB_OK;
    if (p->status != RB_OK)
        nlopt_force_stop(f->opt);
    if (p->status != RB_OK || p->failed) { /* the line search takes a shorter step */
        for (unsigned j = 0; j < n && gradient; j++)
            gradient[j] = 0.0;
        return HUGE_VAL;
    }
    for (unsigned j = 0; j < n && gradient; j++)
        gradient[j] = f->scale * p->gradient[(size_t)f->k * n + j] * (v[j].high - v[j].low);
    return f->scale * (p->value[f->k] - f->bound);
}

static rb_status search_best(problem *p)
{
    /* Sequential quadratic programming on variables of 0 to 1, with functions of order 1: the
     * objective over its value at the start, constraints over their bounds. */
    rb_design *d = p->d;
    function f[1 + RB_DESIGN_CONSTRAINTS];
    double *u = rb_alloc((size_t)d->n, 1), least;
    nlopt_opt opt = nlopt_create(NLOPT_LD_SLSQP, (unsigned)d->n);

    int made = u && opt;
    for (int k = 0; k <= d->constraints && made; k++) {
        const rb_design_constraint *c = k ? &d->constraint[k - 1] : NULL;
        f[k] = (function){p, opt, k, d->largest ? -1.0 : 1.0, 0.0};
        if (c) {
            f[k].scale = (c->at_least ? -1.0 : 1.0) / fmax(fabs(c->bound), 1e-12);
            f[k].bound = c->bound;
            made = nlopt_add_inequality_constraint(opt, function_value, &f[k], 0.1 * MISSED) > 0;
        }
    }
    if (!made || nlopt_set_lower_bounds1(opt, 0.0) < 0 || nlopt_set_upper_bounds1(opt, 1.0) < 0) {
        free(u);
        nlopt_destroy(opt);
        return rb_fail(p->why, RB_ENOMEM, "out of memory for a design");
    }
    nlopt_set_min_objective(opt, function_value, &f[0]);
    nlopt_set_ftol_rel(opt, 1e-9);
    nlopt_set_ftol_abs(opt, 1e-9);
    nlopt_set_xtol_rel(opt, 1e-9);
    nlopt_set_maxeval(opt, d->most > 0 ? d->most : EVALUATIONS);
    p->status = evaluate_at(p, p->best); /* the start, for its size */
    if (p->status == RB_OK) {
        p->known = 1;
        f[0].scale /=
            fmax(fabs(d->result || d->input ? p->value[0] : p->value[0] * p->value[0]), 1e-300);
        /* A step without progress may end a search early: again from the best. */
        nlopt_result r = NLOPT_FTOL_REACHED;
        double before = INFINITY;
        for (int k = 0; k < SEARCHES && p->status == RB_OK &&
                        (r == NLOPT_FTOL_REACHED || r == NLOPT_ROUNDOFF_LIMITED) &&
                        (k == 0 || p->best_value < before - 1e-7 * fabs(before));
             k++) {
            for (int j = 0; j < d->n; j++)
                u[j] =
                    (p->best[j] - d->variable[j].low) / (d->variable[j].high - d->variable[j].low);
            before = p->best_value;
            r = nlopt_optimize(opt, u, &least);
        }
        if (p->status == RB_OK && r == NLOPT_OUT_OF_MEMORY)
            p->status = rb_fail(p->why, RB_ENOMEM, "out of memory for a design");
        if (p->status == RB_OK && r == NLOPT_MAXEVAL_REACHED)
            p->status =
                rb_fail(p->why, RB_MAXITER, "design: not converged after %d evaluation%s%s%s",
                        d->evaluations, rb_plural(d->evaluations),
                        *p->reason.text ? "; some have no solution: " : "", p->reason.text);
        else if (p->status == RB_OK && r < 0 && r != NLOPT_ROUNDOFF_LIMITED)
            p->status = rb_fail(p->why, RB_INACCURATE, "design: the search failed: %s",
                                nlopt_result_to_string(r));
    }
    nlopt_destroy(opt);
    free(u);
    return p->status;
}

#else

/* Not reached: rb_design_available. */
static rb_status search_best(problem *p)
{
    return evaluate_at(p, p->best);
}

#endif

rb_status rb_design_solve(const rb_case *c, const rb_design_observer *observer, rb_design *d,
                          rb_message *why)
{
    const size_t n = (size_t)d->n, functions = 1 + (size_t)d->constraints;
    problem p = {.c = c,
                 .d = d,
                 .observer = observer,
                 .x = rb_alloc(n, 1),
                 .value = rb_alloc(functions, 1),
                 .gradient = rb_alloc(functions, n),
                 .best = rb_alloc(n, 1),
                 .best_value = INFINITY,
                 .why = why};
    rb_status s = RB_OK;

    if (!rb_design_available())
        s = rb_fail(why, RB_EINVAL, "design: this rollbem was built without NLopt (libnlopt-dev)");
    else if (rb_case_has_steps(rb_case_resolved(c)) || rb_case_resolved(c)->error)
        s = rb_refuse(why, "error,history,formulation,increments",
                      "only for cases of one step without error bars");
    else if (!p.x || !p.value || !p.gradient || !p.best)
        s = rb_fail(why, RB_ENOMEM, "out of memory for a design");
    d->evaluations = 0;
    d->start = d->value = NAN;
    for (int j = 0; j < d->n && p.best; j++)
        p.best[j] = d->variable[j].start;
    if (s == RB_OK)
        s = search_best(&p);
    for (int j = 0; j < d->n && p.best; j++)
        d->variable[j].value = p.best[j];
    if (s == RB_OK && !(p.best_value < INFINITY))
        s = rb_fail(why, RB_INACCURATE,
                    "design: no values within the bounds were found that satisfy all constraints");
    d->status = s;
    free(p.x);
    free(p.value);
    free(p.gradient);
    free(p.best);
    return s;
}
