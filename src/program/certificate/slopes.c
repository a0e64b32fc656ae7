/* The certificate of derivatives and of the standard deviations that follow from them: the
 * library differentiates the model that was built again, at the printed state.  So what is
 * printed belongs to this state; the formulas of the derivatives are the library's own. */
#include "program/certificate/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What derivatives are compared by. */
struct rb_certificate_slopes {
    rb_case_number number[RB_CASE_NUMBERS_MAX];
    int numbers;
    rb_case_tolerances uncertain;      /* n = 0: no standard deviations are printed */
    const rb_rolling_history *history; /* NULL: of a case */
    double roundings;                  /* of the result over the input's size that are allowed */
};

/* ---- How far they may differ ------------------------------------------------------- */

/* A share of the derivative, and of the result's size over the input's so many times what the
 * library takes for rounding.  That of wheels comes from the system of the boundary, which
 * incompressible bodies make singular and thin rings, which bend, nearly so. */
static const double SHARE = 1e-7, OF_PLANES = 100.0, OF_WHEELS = 100.0, COMPRESSIBLE = 1e-2;
/* An edge follows from the few pressures beside it. */
static const double OF_EDGES = 10.0;

static double roundings_of(const rb_certificate *c)
{
    const rb_rolling_case *rc = c->model.rc;
    const rb_rolling_body *const bodies[] = {&rc->a, &rc->b};
    double most = OF_PLANES;
    for (int b = 0; b < 1 + rc->elastic_b; b++) {
        const double poisson = rb_rolling_material(rc, bodies[b]).poisson,
                     thick = bodies[b]->support == RB_BEM_HUB ? 1.0 - bodies[b]->hub_ratio : 1.0;
        if (!rb_rolling_body_can(bodies[b], RB_BODY_FLAT))
            most =
                fmax(most, OF_WHEELS / (thick * thick * fmax(1.0 - 2.0 * poisson, COMPRESSIBLE)));
    }
    return (c->hierarchical ? 100.0 : 1.0) * most;
}

/* Of a number its value, of a column its largest entry; of torques, in which large ones cancel,
 * the load's at the radius. */
static double size_of(const rb_certificate *c, const rb_rolling_result *r)
{
    const rb_rolling_history *h = c->slopes->history;
    const void *owner = h ? (const void *)h : &c->again;
    double most = 0.0;
    if (strncmp(r->name, "torque", 6) == 0)
        return c->again.normal_load * rb_rolling_larger_radius(c->model.rc);
    if (!h && rb_rolling_find_result(&rb_rolling_solution_scalars, r->name) == r)
        return fabs(rb_rolling_number(r, owner));
    for (int i = 0; rb_rolling_has_column(r, owner) && i < (h ? h->n : c->again.n); i++)
        most = fmax(most, fabs(rb_rolling_entry(r, owner, i)));
    return most;
}

static double scale_of(const struct rb_certificate_slopes *s, const char *input)
{
    for (int k = 0; k < s->numbers; k++)
        if (strcmp(s->number[k].name, input) == 0)
            return s->number[k].input.scale;
    return INFINITY;
}

/* "derivatives.RESULT.INPUT", "tolerances.RESULT", "derivatives_over_x.RESULT.gap". */
static double slack_of_slope(const rb_certificate *c, const char *path, double want)
{
    const struct rb_certificate_slopes *s = c->slopes;
    const rb_rolling_derived d = rb_rolling_derive(c->model.rc);
    const char *name = strchr(path, '.') + 1, *input = rb_certificate_last(path);
    char result[40];
    double per = 0.0; /* over the sizes of inputs */
    int unused;

    snprintf(result, sizeof result, "%.*s", (int)strcspn(name, "."), name);
    const rb_rolling_result *r = s->history
                                     ? rb_rolling_find_result(&rb_rolling_history_columns, result)
                                     : rb_case_derivative_result(result, &unused);
    if (!r)
        return 0.0;
    if (strncmp(path, "tolerances", 10) == 0)
        for (int k = 0; k < s->uncertain.n; k++)
            per += s->uncertain.deviation[k] / scale_of(s, s->uncertain.name[k]);
    else if (strncmp(path, "derivatives_over_x", 18) == 0)
        per = strcmp(input, "gap") == 0 ? d.radius / (d.half_width * d.half_width) : 1.0;
    else
        per = 1.0 / scale_of(s, input);
    if (strncmp(result, "contact_", 8) == 0 || strstr(result, "_width"))
        per *= OF_EDGES;
    return SHARE * fabs(want) +
           s->roundings * per * rb_sensitivity_rounding(c->model.rc, r, size_of(c, r));
}

/* ---- What they are of -------------------------------------------------------------- */

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
                  rb_certificate_number(deviation));
    }
    const rb_status s = rb_case_read_tolerances(words, text, t, &reason);
    return s == RB_OK ? s : rb_fail(why, s, "uncertain_inputs: %s", reason.text);
}

/* asked: derivatives or, where it deviates, standard deviations are printed. */
static rb_status begin(rb_certificate *c, const json_t *root, int asked, int deviates,
                       const rb_case *words, const rb_rolling_history *history, rb_message *why)
{
    if (!asked)
        return RB_OK;
    c->slopes = calloc(1, sizeof *c->slopes);
    if (!c->slopes)
        return rb_fail(why, RB_ENOMEM, "out of memory for derivatives");
    c->slopes->history = history;
    c->sides = history ? RB_SIDES_OF_STEPS : RB_SIDES_OF_CASE;
    c->slopes->roundings = roundings_of(c);
    const rb_status s = rb_case_numbers(words, c->slopes->number, &c->slopes->numbers, why);
    return s == RB_OK && deviates ? read_uncertain(root, words, &c->slopes->uncertain, why) : s;
}

/* What is printed and what should be, member by member. */
static void compare_members(rb_certificate *c, const json_t *printed, const json_t *again,
                            const char *const *names)
{
    for (; *names; names++)
        if (json_object_get(printed, *names) || json_object_get(again, *names))
            rb_certificate_compare(c, *names, 0, json_object_get(printed, *names),
                                   json_object_get(again, *names), slack_of_slope);
}

/* Compares with what was computed again, with status s.  again: taken over. */
static rb_status end(rb_certificate *c, rb_status s, const rb_message *reason, json_t *again,
                     const json_t *printed, const char *const *names, rb_message *why)
{
    if (s == RB_OK && !again)
        s = RB_ENOMEM;
    if (s == RB_OK)
        compare_members(c, printed, again, names);
    else if (s != RB_ENOMEM)
        rb_certificate_violated(c, "%s", reason->text);
    json_decref(again);
    free(c->slopes);
    c->slopes = NULL;
    c->sides = RB_NO_SIDES;
    return s == RB_ENOMEM ? rb_fail(why, s, "%s", reason->text) : RB_OK;
}

/* ---- Of a case --------------------------------------------------------------------- */

/* Where they stand in a result. */
static const char *const places[] = {"derivatives_of",
                                     "own_of_b",
                                     "derivatives",
                                     "smooth_derivatives",
                                     "without_derivatives",
                                     "derivatives_over_x",
                                     "derivatives_are",
                                     "tolerances",
                                     NULL};

rb_status rb_certificate_derivatives(rb_certificate *c, const json_t *root, const rb_case *words,
                                     rb_message *why)
{
    const char *names = json_string_value(json_object_get(root, "derivatives_of"));
    const int smooth = json_object_get(root, "smooth_derivatives") != NULL,
              deviates = json_object_get(root, "uncertain_inputs") != NULL,
              asked = names || deviates;
    rb_case_derivatives all = {.n = 0};
    rb_report_derivatives shown = {.all = &all};
    rb_message reason = {""};
    json_t *again = json_object();

    rb_status s = begin(c, root, asked, deviates, words, NULL, &reason);
    /* The creepage of free rolling is another solution, found as the solve has found it; where it
     * is not found it has no derivatives. */
    double creepage;
    if (s == RB_OK && asked && c->model.rc->formulation == RB_STEADY &&
        rb_rolling_largest_mu(c->model.rc) > 0.0 &&
        rb_rolling_free_creepage(&c->model, &creepage, &reason) == RB_ENOMEM)
        s = RB_ENOMEM;
    if (s == RB_OK && asked)
        s = (smooth ? rb_case_differentiate_smoothly : rb_case_differentiate)(words, &c->model, 0,
                                                                              NULL, &all, &reason);
    if (s == RB_OK && deviates)
        s = rb_case_propagate(&c->slopes->uncertain, &all, &shown.deviation, &reason);
    if (s == RB_OK && names)
        s = rb_report_derivatives_of(names, rb_case_resolved(words), &shown, &reason);
    if (s == RB_OK && names)
        rb_report_json_derivatives(&again, &shown);
    if (s == RB_OK && asked)
        rb_report_json_asked(&again, names, words);
    if (s == RB_OK && deviates)
        rb_report_json_tolerances(&again, &shown);
    s = end(c, s, &reason, again, root, places, why);
    rb_case_derivatives_free(&all);
    return s;
}

/* ---- Of a history ------------------------------------------------------------------ */

rb_status rb_certificate_step_derivatives(rb_certificate *c, const json_t *root,
                                          const rb_case *words, const rb_rolling_states *states,
                                          rb_rolling_history *again, rb_message *why)
{
    static const char *const of_steps[] = {"derivatives", "derivatives_note", "tolerances", NULL};
    const json_t *history = json_object_get(root, "history");
    const char *names = json_string_value(json_object_get(root, "derivatives_of"));
    const int deviates = json_object_get(root, "uncertain_inputs") != NULL,
              asked = names || deviates;
    rb_case_slopes slopes = {.n = 0};
    rb_message reason = {""};
    json_t *wanted = json_object(), *outside = json_object();

    if (asked)
        rb_report_json_asked(&outside, names, words);
    compare_members(c, root, outside, places); /* the others are those of the history */
    json_decref(outside);
    rb_status s = begin(c, root, asked, deviates, words, again, &reason);
    if (s == RB_OK && names)
        s = rb_case_slopes_choose(words, &rb_rolling_history_columns, names, RB_CASE_SLOPES_MAX,
                                  &slopes, &reason);
    if (s == RB_OK && asked)
        s = rb_case_slopes_of_steps(words, states, names ? &slopes : NULL,
                                    deviates ? &c->slopes->uncertain : NULL, again, &reason);
    if (s == RB_OK && names)
        rb_report_json_slopes(&wanted, &slopes);
    if (s == RB_OK && deviates) {
        json_t *columns = rb_report_json_history(again);
        rb_report_json_set(&wanted, "tolerances",
                           json_incref(json_object_get(columns, "tolerances")));
        json_decref(columns);
    }
    s = end(c, s, &reason, wanted, history, of_steps, why);
    rb_case_slopes_free(&slopes);
    return s;
}
