/* Derivatives compared with central differences of solved problems: of single cases on
 * the same elements, moved as the derivative says that they move; of histories that are
 * solved anew. */
#ifndef DIFFERENCES_H
#define DIFFERENCES_H

#include "analysis/sensitivity/derivatives.h"
#include "analysis/sensitivity/sensitivity.h"
#include "lcp/contact/contact.h"
#include "rolling/case/case.h"
#include "rolling/rolling.h"
#include "check.h"

#include <stdlib.h>
#include <string.h>

/* What a comparison found. */
typedef struct {
    double off;     /* the largest deviation, of the value or of what is usual for it */
    int compared;   /* inputs; 0: zones change near all of them */
    char text[240]; /* where that is */
} differences;

static const double difference_place[] = {-2.0, -1.0, 1.0, 2.0},
                    difference_weight[] = {1.0 / 12.0, -8.0 / 12.0, 8.0 / 12.0, -1.0 / 12.0};

static int difference_has_wheels(const rb_rolling_case *rc)
{
    return rc->a.support != RB_BEM_HALFPLANE ||
           (rc->elastic_b && rc->b.support != RB_BEM_HALFPLANE);
}

/* Parts of an input's scale, ended by 0: within a long step zones change, within a short one
 * the rounding of solutions counts.  The flexibility of a wheel, and what is solved by products,
 * are known to 1e-12 or so: steps that would divide this to more than 1e-8 tell nothing. */
static const double *difference_parts(const rb_rolling_model *model)
{
    static const double of_matrices[] = {1e-3, 1e-4, 1e-5, 0.0}, of_products[] = {1e-3, 1e-4, 0.0},
                        of_wheels[] = {4e-3, 2e-3, 1e-3, 4e-4, 2e-4, 1e-4, 0.0};

    return difference_has_wheels(model->rc) ? of_wheels
           : model->bodies.F                ? of_matrices
                                            : of_products;
}

/* Whether a step of that part is tried, off being the best so far, INFINITY before the first that
 * stays within its zones.  The last steps of wheels are near to rounding: they only show whether
 * one before was too long. */
static int difference_is_tried(const rb_rolling_model *model, double part, double off)
{
    return part > 0.0 && !(off <= 1e-8) &&
           (part >= 4e-4 || isfinite(off) || !difference_has_wheels(model->rc));
}

/* size: of the value, for a change of the input by all of its own; NAN: both NAN. */
static void difference_note(differences *d, double got, double want, double size,
                            const char *format, ...)
{
    va_list args;
    const double off = fabs(got - want) / fmax(fabs(want), size);

    if (got == want || (isnan(got) && isnan(want)) || off <= d->off)
        return;
    d->off = isnan(off) ? INFINITY : off;
    va_start(args, format);
    const int n = vsnprintf(d->text, sizeof d->text, format, args);
    va_end(args);
    snprintf(d->text + n, sizeof d->text - (size_t)n, ": %.10g, differences %.10g", got, want);
}

/* Adds what the best step of an input found. */
static void difference_take(const differences *best, differences *d)
{
    const int compared = d->compared + best->compared;
    if (best->compared && best->off > d->off)
        *d = *best;
    d->compared = compared;
}

/* ---- Single cases ------------------------------------------------------------------ */

/* Where p^2 through the second and third element in contact is 0 (theory-solvers.md D6). */
static double difference_edge(const rb_rolling_model *m, int side)
{
    const double *p = m->state.p, *x = m->mesh.ends;
    int j = side > 0 ? m->mesh.n - 1 : 0;
    while (m->state.zone[j] == RB_ZONE_SEPARATED)
        j -= side;
    j -= side;
    const int i = j - side;
    const double at = 0.5 * (x[j] + x[j + 1]), before = 0.5 * (x[i] + x[i + 1]),
                 fall = pow(p[j] / p[i], 2.0);
    return at + (at - before) * fall / (1.0 - fall);
}

/* 1: the mesh ends where the contact that is found on it does, up to this part of an
 * element: x is an end of one. */
static int difference_is_end(const rb_rolling_model *m, double x)
{
    const double at = (x - m->mesh.ends[0]) / (m->mesh.ends[1] - m->mesh.ends[0]);
    return fabs(at - round(at)) < 5e-3;
}

typedef struct {
    const rb_rolling_model *base;
    rb_sensitivity_elements elements;
    int is_aligned;      /* 1: the edges are those that the solver aligns elements with */
    double half, centre; /* of the contact on the elements of the base */
    double gain[4];      /* of the motion by what is found; of fitted elements */
} difference_frame;

static void difference_edges(const difference_frame *f, const rb_rolling_model *m, double *from,
                             double *to)
{
    rb_rolling_contact_edges(m->rc, &m->mesh, &m->state, from, to);
    if (!f->is_aligned) {
        *from = difference_edge(m, -1);
        *to = difference_edge(m, 1);
    }
}

/* Products are iterated until the residual is 2e-11, which over a step of 1e-4 leaves seven digits
 * of a difference: what is left of it is solved for again, enlarged (the zones stay, so all is
 * linear). */
static rb_status difference_refine(rb_rolling_model *v)
{
    const double larger = 1e6;
    rb_contact_problem p = v->problem;
    rb_contact_state *x = &v->state;
    const size_t n = (size_t)p.n;
    double *scratch = calloc(5 * n, sizeof *scratch);

    if (!scratch)
        return RB_ENOMEM;
    double *gap = scratch, *was = scratch + 3 * n;
    const double delta = x->delta, xi = x->xi;
    p.d_N = scratch + n;
    p.d_T = scratch + 2 * n;
    rb_contact_kinematics(&v->problem, x, gap, x->lambda);
    for (size_t i = 0; i < n; i++) {
        p.d_N[i] = v->problem.d_N[i] + larger * (x->zone[i] != RB_ZONE_SEPARATED ? gap[i] : 0.0);
        p.d_T[i] = v->problem.d_T[i] + larger * (x->zone[i] == RB_ZONE_STICK ? x->lambda[i] : 0.0);
        was[i] = x->p[i];
        was[n + i] = x->q[i];
    }
    p.load += larger * (p.load - rb_contact_load(&p, x));
    p.force += larger * (p.force + p.force_ratio * rb_contact_capacity(&p, x) -
                         p.axle * rb_contact_moment(&p, x) - rb_contact_force(&p, x));
    const rb_status s = rb_contact_try_zones(&p, x, gap);
    for (size_t i = 0; i < n && s == RB_OK; i++) {
        x->p[i] = was[i] + (x->p[i] - was[i]) / (1.0 + larger);
        x->q[i] = was[n + i] + (x->q[i] - was[n + i]) / (1.0 + larger);
    }
    x->delta = delta + (x->delta - delta) / (1.0 + larger);
    x->xi = xi + (x->xi - xi) / (1.0 + larger);
    rb_contact_kinematics(&v->problem, x, gap, x->lambda);
    free(scratch);
    return s;
}

/* Solves rc on elements that are stretched to the half-width half + by[0] about a centre
 * shifted by by[1]; found: what these are afterwards less what they were. */
static rb_status difference_solve(const difference_frame *f, const rb_rolling_case *rc,
                                  const double by[2], rb_rolling_model *v, double found[2],
                                  rb_message *why)
{
    const double scale = 1.0 + by[0] / f->half;
    rb_rolling_case at = *rc;

    at.mesh = f->base->rc->mesh;
    at.slip_operator = f->base->rc->slip_operator;
    at.outer_refinement = f->base->rc->outer_refinement;
    at.outer_elements = f->base->rc->outer_elements;
    at.contact_elements =
        at.mesh == RB_MESH_UNIFORM ? f->base->mesh.n : f->base->rc->contact_elements;
    rb_status s =
        rb_rolling_variant_place(f->base, &at, by[1] + f->centre * (1.0 - scale), scale, v, why);
    if (s == RB_OK && !rb_rolling_same_sides(f->base, v))
        s = RB_INACCURATE;
    if (s == RB_OK)
        s = rb_rolling_model_control(v, why);
    if (s == RB_OK &&
        memcmp(v->state.zone, f->base->state.zone, (size_t)v->mesh.n * sizeof *v->state.zone) != 0)
        s = RB_ZONE;
    if (s == RB_OK && !v->bodies.F)
        s = difference_refine(v);
    if (s == RB_OK && f->elements == RB_SENSITIVITY_EDGES) {
        double from, to;
        difference_edges(f, v, &from, &to);
        found[0] = 0.5 * (to - from) - f->half;
        found[1] = 0.5 * (to + from) - f->centre;
    }
    return s;
}

/* The half-width that an automatic zone follows. */
static double difference_zone(const rb_rolling_case *rc)
{
    return rb_rolling_zone_half_width(rc, rb_rolling_derive(rc).load);
}

static rb_status difference_begin(const rb_rolling_model *base, rb_sensitivity_elements elements,
                                  difference_frame *f, rb_message *why)
{
    double from, to;
    rb_rolling_contact_edges(base->rc, &base->mesh, &base->state, &from, &to);
    *f = (difference_frame){base,
                            elements,
                            base->rc->mesh == RB_MESH_ALIGNED && difference_is_end(base, from) &&
                                difference_is_end(base, to),
                            difference_zone(base->rc),
                            0.0,
                            {0}};
    if (elements != RB_SENSITIVITY_EDGES)
        return RB_OK;
    difference_edges(f, base, &from, &to);
    f->half = 0.5 * (to - from);
    f->centre = 0.5 * (to + from);
    double J[4]; /* 1 - found_e */
    for (int k = 0; k < 2; k++) {
        const double step = 1e-6 * f->half, by[2] = {k ? 0.0 : step, k ? step : 0.0};
        rb_rolling_model v;
        double found[2];
        const rb_status s = difference_solve(f, base->rc, by, &v, found, why);
        rb_rolling_variant_free(base, &v);
        if (s != RB_OK)
            return s;
        J[k] = (k == 0) - found[0] / step;
        J[2 + k] = (k == 1) - found[1] / step;
    }
    const double det = J[0] * J[3] - J[1] * J[2];
    f->gain[0] = J[3] / det;
    f->gain[1] = -J[1] / det;
    f->gain[2] = -J[2] / det;
    f->gain[3] = J[0] / det;
    return RB_OK;
}

static int difference_is_edge(const rb_rolling_result *r)
{
    static const char *const edges[] = {"contact_from", "contact_to", "half_width", "nip_width"};
    for (size_t k = 0; k < sizeof edges / sizeof *edges; k++)
        if (strcmp(r->name, edges[k]) == 0)
            return 1;
    return 0;
}

/* The solution of rc, on elements that move as those of the base do, and with them the
 * edges that they are fitted to; at: of the base. */
static rb_status difference_at(const difference_frame *f, const rb_rolling_case *rc,
                               const rb_rolling_solution *at, rb_rolling_solution *solution,
                               rb_message *why)
{
    const double strain = 0.5 * at->half_width / rb_rolling_derive(f->base->rc).radius;
    double by[2] = {f->elements == RB_SENSITIVITY_ZONE ? difference_zone(rc) - f->half : 0.0, 0.0},
           found[2];
    rb_rolling_model v;
    rb_status s;

    for (int round = 0;; round++) {
        s = difference_solve(f, rc, by, &v, found, why);
        if (s != RB_OK || f->elements != RB_SENSITIVITY_EDGES || round == 12)
            break;
        const double left[2] = {found[0] - by[0], found[1] - by[1]};
        if (fabs(left[0]) + fabs(left[1]) < 1e-15 * f->half)
            break;
        by[0] += f->gain[0] * left[0] + f->gain[1] * left[1];
        by[1] += f->gain[2] * left[0] + f->gain[3] * left[1];
        rb_rolling_variant_free(f->base, &v);
    }
    if (s == RB_OK)
        s = rb_rolling_model_solution(&v, solution, why);
    if (s == RB_OK && f->elements == RB_SENSITIVITY_EDGES) {
        solution->contact_from =
            at->contact_from + by[1] + by[0] * (at->contact_from - f->centre) / f->half;
        solution->contact_to =
            at->contact_to + by[1] + by[0] * (at->contact_to - f->centre) / f->half;
        solution->nip_width = solution->contact_to - solution->contact_from;
        const double found_half = solution->half_width;
        solution->half_width = at->half_width + 0.5 * (solution->nip_width - at->nip_width);
        solution->peclet *= solution->half_width / found_half;
    }
    if (s == RB_OK && at->max_strain == strain) /* no layer: a/(2R) */
        solution->max_strain = 0.5 * solution->half_width / rb_rolling_derive(rc).radius;
    rb_rolling_variant_free(f->base, &v);
    return s;
}

/* Two elements share the largest pressure: what asks which one it is has a kink. */
static int difference_has_tie(const rb_rolling_solution *at)
{
    double most = 0.0, second = 0.0;
    for (int i = 0; i < at->n; i++) {
        second = fmax(second, fmin(most, at->p[i]));
        most = fmax(most, at->p[i]);
    }
    return second > 0.99 * most;
}

/* Edges of elements that do not follow them end at midpoints, which has kinks; the
 * creepage of free rolling is a solution of its own. */
static int difference_is_left_out(const rb_rolling_result *r, const rb_rolling_solution *at,
                                  rb_sensitivity_elements elements)
{
    const int strain = strcmp(r->name, "max_strain") == 0,
              peak = strcmp(r->name, "max_pressure") == 0 || strcmp(r->name, "kappa") == 0;
    /* the length that sticks is one of elements, its derivative is not */
    return !rb_sensitivity_has(r) || strcmp(r->name, "free_creepage") == 0 ||
           strcmp(r->name, "stick_length") == 0 ||
           (elements != RB_SENSITIVITY_EDGES && (difference_is_edge(r) || strain)) ||
           ((peak || strain) && difference_has_tie(at));
}

/* 1: what is found at elements has a kink between the places, where other elements come first:
 * two differences do not agree as those of what is smooth do. */
static int difference_has_kink(const rb_rolling_result *r, double part, const double x[4])
{
    const double off = (x[3] - x[0]) / 4.0 - (x[2] - x[1]) / 2.0;
    return (difference_is_edge(r) || strcmp(r->name, "max_pressure") == 0 ||
            strcmp(r->name, "max_temperature") == 0) &&
           fabs(off) > (30.0 * pow(part, 3.0) + 1e-12) * fabs(x[0]);
}

/* All results by one input, with steps of that part of its scale. */
static void difference_of_input(const difference_frame *f, const rb_case_number *number,
                                const rb_case_derivative *of, const rb_rolling_solution *at,
                                double part, differences *d)
{
    rb_rolling_solution near[4] = {{0}};
    const double step = part * number->input.scale;
    rb_status s = RB_OK;

    for (int j = 0; j < 4 && s == RB_OK; j++) {
        rb_message why = {.text = ""};
        rb_rolling_case rc;
        s = number->input.vary(number->input.context,
                               number->input.value + difference_place[j] * step, &rc, &why);
        if (s == RB_OK)
            s = difference_at(f, &rc, at, &near[j], &why);
    }
    d->compared += s == RB_OK;
    for (int k = 0; k < rb_rolling_solution_scalars.n && s == RB_OK; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        double x[4], want = 0.0;
        if (difference_is_left_out(r, at, f->elements))
            continue;
        for (int j = 0; j < 4; j++) {
            x[j] = rb_rolling_number(r, &near[j]);
            want += difference_weight[j] / step * x[j];
        }
        if (strcmp(r->name, "max_temperature") == 0 && difference_has_kink(r, part, x))
            continue;
        const double usual =
            1e11 * rb_sensitivity_rounding(f->base->rc, r, rb_rolling_number(r, at));
        difference_note(d, rb_rolling_number(r, &of->d.value[0]), want, usual / number->input.scale,
                        "%s by %s", r->name, number->name);
    }
    for (int i = 0; i < at->n && s == RB_OK; i++) {
        double p = 0.0, q = 0.0;
        const double usual = at->max_pressure / number->input.scale;
        for (int j = 0; j < 4; j++) {
            p += difference_weight[j] / step * near[j].p[i];
            q += difference_weight[j] / step * near[j].q[i];
        }
        difference_note(d, of->d.value[0].p[i], p, usual, "p[%d] by %s", i, number->name);
        difference_note(d, of->d.value[0].q[i], q, usual, "q[%d] by %s", i, number->name);
    }
    for (int j = 0; j < 4; j++)
        rb_rolling_solution_free(&near[j]);
}

/* The derivatives of a case that is solved without a matrix against those of the same
 * state with one: differences of such solutions are known only to the tolerance of their
 * iteration over the step. */
static rb_status compare_with_matrix(const rb_case *c, const rb_case_number *number, differences *d,
                                     rb_message *why)
{
    rb_rolling_case rc = rb_case_resolved(c)->rc;
    rb_case_derivatives by[2] = {{0}, {0}};
    rb_rolling_solution at = {0};
    rb_rolling_model model = {0}, dense = {0};

    rc.contact.tol = rb_contact_defaults().tol;
    rb_status s = rb_rolling_solve_model(&rc, &model, &at, why);
    const int compares = s == RB_OK && !model.bodies.F && model.mesh.n < RB_ROLLING_LARGE;
    if (compares)
        s = rb_rolling_variant_with_matrix(&model, &dense, why);
    for (int k = 0; k < 2 && compares && s == RB_OK; k++)
        s = rb_case_differentiate(c, k ? &dense : &model, 0, NULL, &by[k], why);
    for (int j = 0; j < by[0].n && compares && s == RB_OK; j++) {
        const rb_case_derivative *fast = &by[0].of[j], *exact = &by[1].of[j];
        const int side = !exact->d.has[0];
        const double scale = number[j].input.scale;
        if (fast->status != RB_OK || exact->status != RB_OK)
            continue;
        d->compared++;
        for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
            const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
            const double usual = 1e11 * rb_sensitivity_rounding(&rc, r, rb_rolling_number(r, &at));
            if (rb_sensitivity_has(r))
                difference_note(d, rb_rolling_number(r, &fast->d.value[side]),
                                rb_rolling_number(r, &exact->d.value[side]), usual / scale,
                                "%s by %s without a matrix", r->name, fast->name);
        }
        for (int i = 0; i < 2 * at.n; i++) {
            const rb_rolling_solution *x = &fast->d.value[side], *y = &exact->d.value[side];
            const int n = i % at.n;
            difference_note(d, i < at.n ? x->p[n] : x->q[n], i < at.n ? y->p[n] : y->q[n],
                            at.max_pressure / scale, "%s[%d] by %s without a matrix",
                            i < at.n ? "p" : "q", n, fast->name);
        }
    }
    rb_case_derivatives_free(&by[0]);
    rb_case_derivatives_free(&by[1]);
    rb_rolling_model_free(&dense);
    rb_rolling_solution_free(&at);
    rb_rolling_model_free(&model);
    return s;
}

/* Every `every`-th input of a solved case, beginning with number `first`. */
static rb_status compare_single(const rb_case *c, int first, int every, differences *d,
                                rb_message *why)
{
    rb_case_number *number = calloc(RB_CASE_NUMBERS_MAX, sizeof *number);
    rb_case_derivatives all = {0};
    rb_rolling_solution at = {0};
    rb_rolling_model model = {0}, closely = {0};
    difference_frame f;
    const char *names[RB_CASE_NUMBERS_MAX];
    int numbers = 0, chosen = 0;

    *d = (differences){0};
    rb_status s =
        number ? rb_rolling_solve_model(&rb_case_resolved(c)->rc, &model, &at, why) : RB_ENOMEM;
    if (s == RB_OK)
        s = rb_case_numbers(c, number, &numbers, why);
    for (int k = first; k < numbers; k += every)
        names[chosen++] = number[k].name;
    if (s == RB_OK)
        s = rb_case_differentiate(c, &model, chosen, names, &all, why);
    /* what differences borrow has to be compressed as closely as the rest */
    const int compressed = s == RB_OK && rb_rolling_is_compressed(&model);
    if (compressed)
        s = rb_rolling_variant_closely(&model, &closely, why);
    if (s == RB_OK &&
        difference_begin(compressed ? &closely : &model, all.elements, &f, why) == RB_OK)
        for (int k = first; k < numbers && chosen > 0; k += every) {
            const rb_case_derivative *of = &all.of[(k - first) / every];
            if (of->status != RB_OK || of->d.sides != 1 || number[k].input.value == 0.0)
                continue;
            /* a zone may change within the step, or the elements outside the contact have a
             * kink there: then a shorter one counts */
            differences best = {.off = INFINITY};
            for (const double *part = difference_parts(&model);
                 difference_is_tried(&model, *part, best.off); part++) {
                differences one = {0};
                difference_of_input(&f, &number[k], of, &at, *part, &one);
                if (one.compared && one.off < best.off)
                    best = one;
            }
            difference_take(&best, d);
        }
    if (number && rb_case_numbers(c, number, &numbers, why) == RB_OK) {
        const rb_status t = compare_with_matrix(c, number, d, why);
        s = s == RB_OK ? t : s;
    }
    rb_case_derivatives_free(&all);
    rb_rolling_solution_free(&at);
    rb_rolling_model_free(&closely);
    rb_rolling_model_free(&model);
    free(number);
    return s;
}

/* ---- Histories --------------------------------------------------------------------- */

typedef struct {
    rb_rolling_model model;
    rb_rolling_history history;
    rb_rolling_states states;
    rb_rolling_follower *on; /* where it is solved on given elements; or NULL */
} difference_run;

static int difference_keep(const rb_rolling_model *model, const rb_rolling_history *history,
                           int step, int steps, void *context)
{
    return rb_rolling_states_keep(model, history, step, steps, context) != RB_OK;
}

static rb_status difference_history(const rb_resolved_case *c, const rb_rolling_case *rc,
                                    difference_run *run, rb_message *why)
{
    const rb_rolling_program *program = c->program.n > 0 ? &c->program : NULL;
    const rb_rolling_observer observer = {difference_keep, &run->states};
    const rb_status s =
        rb_rolling_history_run(rc, program, &observer, &run->model, &run->history, why);
    run->states.program = program;
    run->states.half_width = run->history.half_width;
    return s;
}

/* Solves the history of rc on the elements of `of`, with whose states each step begins. */
static rb_status difference_on(const rb_rolling_case *rc, const rb_rolling_states *found,
                               const rb_rolling_follower *of, difference_run *run, rb_message *why)
{
    rb_status s = rb_rolling_follower_create(rc, found, of, 1.0, &run->on, why);
    for (int k = 0; k < found->steps && s == RB_OK;) {
        rb_rolling_model *model = rb_rolling_follower_model(run->on);
        s = rb_rolling_follower_begin(run->on, why);
        const int ends_row = rb_rolling_follower_ends_row(run->on);
        if (ends_row)
            rb_rolling_states_get(found, k, &model->state);
        if (s == RB_OK)
            s = rb_rolling_follower_solve(run->on, why);
        if (s == RB_OK)
            rb_rolling_follower_end(run->on);
        if (s == RB_OK && ends_row)
            s = rb_rolling_states_keep(model, rb_rolling_follower_history(run->on), k, found->steps,
                                       &run->states);
        k += ends_row;
    }
    return s;
}

static void difference_run_free(difference_run *run)
{
    rb_rolling_follower_free(run->on);
    rb_rolling_model_free(&run->model);
    rb_rolling_history_free(&run->history);
    rb_rolling_states_free(&run->states);
}

static double difference_entry(const rb_rolling_result *r, const difference_run *run, int row)
{
    return rb_rolling_entry(r, run->on ? rb_rolling_follower_history(run->on) : &run->history, row);
}

/* The history of rc nearby: on the elements of `stay` that rests on the states of `at`, or, where
 * it is NULL, as it is found; if its boundary is compressed then, it is solved again as closely as
 * derivatives ask for: 1e-9 over a step would leave six digits of them. */
static rb_status difference_near(const rb_resolved_case *c, const rb_rolling_case *rc,
                                 const difference_run *at, const rb_rolling_follower *stay,
                                 difference_run *run, rb_message *why)
{
    if (stay)
        return difference_on(rc, &at->states, stay, run, why);
    rb_status s = difference_history(c, rc, run, why);
    if (s == RB_OK && rb_rolling_is_compressed(&run->model)) {
        difference_run closely = {.states = {0}};
        s = difference_on(rc, &run->states, NULL, &closely, why);
        difference_run_free(run);
        *run = closely;
    }
    return s;
}

/* What is usual for a column: the largest of its values, or by its unit. */
static double difference_usual(const rb_rolling_result *r, const difference_run *at)
{
    double usual = 0.0;
    for (int row = 0; row < at->history.n; row++) {
        const double x = rb_rolling_entry(r, &at->history, row);
        usual = fmax(usual, 1e11 * rb_sensitivity_rounding(at->model.rc, r, isnan(x) ? 0.0 : x));
    }
    return usual;
}

static void difference_of_steps(const rb_resolved_case *c, const rb_case_number *number,
                                const difference_run *at, const rb_rolling_follower *stay,
                                const rb_case_slopes *s, double part, differences *d)
{
    const double step = part * number->input.scale;
    const size_t zones = (size_t)at->states.n * (size_t)at->states.steps;
    difference_run near[4] = {{.states = {0}}};
    int same = 1;

    for (int j = 0; j < 4 && same; j++) {
        rb_message why = {.text = ""};
        rb_rolling_case rc;
        same = number->input.vary(number->input.context,
                                  number->input.value + difference_place[j] * step, &rc,
                                  &why) == RB_OK &&
               difference_near(c, &rc, at, stay, &near[j], &why) == RB_OK &&
               near[j].states.n == at->states.n && near[j].states.steps == at->states.steps &&
               memcmp(near[j].states.zone, at->states.zone, zones * sizeof(int)) == 0;
    }
    d->compared += same;
    for (int k = 0; k < s->n && same; k++)
        for (int row = 0; row < s->rows && strcmp(s->of[k].input, number->name) == 0; row++) {
            double x[4], want = 0.0;
            for (int j = 0; j < 4; j++) {
                x[j] = difference_entry(s->of[k].result, &near[j], row);
                want += difference_weight[j] / step * x[j];
            }
            if (difference_has_kink(s->of[k].result, part, x))
                continue;
            difference_note(d, rb_case_slope_value(s, row, k), want,
                            difference_usual(s->of[k].result, at) / number->input.scale,
                            "%s by %s, step %d", s->of[k].result->name, number->name, row + 1);
        }
    for (int j = 0; j < 4; j++)
        difference_run_free(&near[j]);
}

/* 1: a row at rest is solved along its way, in parts.  Within it zones change that its end does not
 * show, at other places of the way for other inputs: there each result has a kink. */
static int difference_has_way(const rb_rolling_history *h)
{
    for (int k = 0; k < h->n; k++)
        if (h->distance[k] == 0.0 && h->substeps[k] > 1)
            return 1;
    return 0;
}

/* Steps that are too short for such a kink to be within them, but for single ones: they leave six
 * digits, of which five agree. */
static int difference_agrees_nearby(const rb_resolved_case *c, const rb_case_number *number,
                                    const difference_run *at, const rb_rolling_follower *stay,
                                    const rb_case_slopes *s)
{
    static const double parts[] = {1e-5, 1e-6, 1e-7};

    for (size_t k = 0; k < sizeof parts / sizeof *parts; k++) {
        differences one = {0};
        difference_of_steps(c, number, at, stay, s, parts[k], &one);
        if (one.compared && one.off <= 1e-5)
            return 1;
    }
    return 0;
}

/* Every `every`-th input of a case of steps, beginning with number `first`. */
static rb_status compare_steps(const rb_case *c, int first, int every, differences *d,
                               rb_message *why)
{
    const rb_resolved_case *resolved = rb_case_resolved(c);
    rb_case_number *number = calloc(RB_CASE_NUMBERS_MAX, sizeof *number);
    difference_run at = {.states = {0}};
    rb_rolling_follower *stay = NULL;
    rb_case_slopes slopes = {0};
    int numbers = 0;

    *d = (differences){0};
    rb_status s = number ? difference_history(resolved, &resolved->rc, &at, why) : RB_ENOMEM;
    if (s == RB_OK)
        s = rb_case_slopes_choose(c, &rb_rolling_history_columns, "all", RB_CASE_SLOPES_MAX,
                                  &slopes, why);
    if (s == RB_OK)
        s = rb_case_slopes_of_steps(c, &at.states, &slopes, NULL, NULL, why);
    if (s == RB_OK && slopes.stay)
        s = rb_rolling_follower_create(&resolved->rc, &at.states, NULL, 1.0, &stay, why);
    if (s == RB_OK)
        s = rb_case_numbers(c, number, &numbers, why);
    for (int k = first; k < numbers && s == RB_OK && slopes.degenerate == 0; k += every) {
        differences best = {.off = INFINITY};
        for (const double *part = difference_parts(&at.model);
             difference_is_tried(&at.model, *part, best.off) && number[k].input.value != 0.0;
             part++) {
            differences one = {0};
            difference_of_steps(resolved, &number[k], &at, stay, &slopes, *part, &one);
            if (one.compared && one.off < best.off)
                best = one;
        }
        if (best.off > 1e-8 && best.compared && difference_has_way(&at.history) &&
            difference_agrees_nearby(resolved, &number[k], &at, stay, &slopes))
            best.off = 0.0;
        difference_take(&best, d);
    }
    rb_rolling_follower_free(stay);
    rb_case_slopes_free(&slopes);
    difference_run_free(&at);
    free(number);
    return s;
}

#endif
