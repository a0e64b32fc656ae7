/* Discretisation errors from the spread over meshes (theory.md 5.1). */
#include "rolling/internal.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_ELEMENTS = 6400 };

/* What one mesh says. */
typedef struct {
    rb_rolling_solution solution;
    rb_rolling_stress_maxima stress;
} sample;

enum { STRESS_NUMBERS = sizeof(rb_rolling_stress_maxima) / sizeof(double) };

static double at(const void *base, size_t offset)
{
    double value;
    memcpy(&value, (const char *)base + offset, sizeof value);
    return value;
}

static double spread(double a, double b, double c)
{
    return fmax(a, fmax(b, c)) - fmin(a, fmin(b, c)) + 0.0 * (a + b + c); /* NAN stays */
}

/* Twice the spread held the true error where 200 elements or more stand across the
 * contact, three times below. */
double rb_rolling_error_of(int contact, double a, double b, double c)
{
    return (contact >= 200 ? 2.0 : 3.0) * spread(a, b, c);
}

static void estimate(const sample s[3], int with_stress, rb_rolling_errors *errors)
{
    const int contact = s[2].solution.contact;

    errors->scalar = rb_rolling_no_scalars(RB_OK);
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        if (!r->error_bar)
            continue;
        const double e = rb_rolling_error_of(
            contact, rb_rolling_number(r, &s[0].solution),
            rb_rolling_number(r, &s[1].solution), rb_rolling_number(r, &s[2].solution));
        memcpy((char *)&errors->scalar + r->offset, &e, sizeof e);
    }
    for (size_t k = 0; k < STRESS_NUMBERS; k++) {
        const size_t offset = k * sizeof(double);
        const double e =
            with_stress
                ? rb_rolling_error_of(contact, at(&s[0].stress, offset),
                                      at(&s[1].stress, offset), at(&s[2].stress, offset))
                : NAN;
        memcpy((char *)&errors->stress + offset, &e, sizeof e);
    }
}

rb_rolling_case rb_rolling_error_mesh(const rb_rolling_case *rc, int k)
{
    static const double part[RB_ERROR_MESHES] = {0.5, 0.7, 1.0};
    rb_rolling_case companion = *rc;

    companion.contact_elements = (int)(part[k] * rc->contact_elements);
    if (rc->steps > 0)
        companion.steps = (int)ceil(part[k] * rc->steps);
    return companion;
}

static rb_status take_sample(const rb_rolling_case *rc, int with_stress, sample *s,
                             rb_message *why)
{
    rb_rolling_model model = {0};
    rb_status status = rb_rolling_solve_model(rc, &model, &s->solution, why);
    if (status == RB_OK && with_stress)
        status = rb_rolling_stress_maxima_find(&model, 0.0, &s->stress, why);
    rb_rolling_model_free(&model);
    return status;
}

static void samples_free(sample s[3])
{
    for (int k = 0; k < 3; k++)
        rb_rolling_solution_free(&s[k].solution);
}

/* Hands the finest solution to the caller. */
static void give_finest(sample s[3], rb_rolling_solution *solution)
{
    *solution = s[2].solution;
    memset(&s[2].solution, 0, sizeof s[2].solution);
}

rb_status rb_rolling_error_check(const rb_rolling_case *rc, rb_message *why)
{
    if (rc->contact_elements < 12)
        return rb_fail(why, RB_EINVAL,
                       "error bars compare with half the elements: expected 12 contact "
                       "elements or more, got %d",
                       rc->contact_elements);
    return RB_OK;
}

rb_status rb_rolling_solve_with_errors(const rb_rolling_case *rc, int with_stress,
                                       rb_rolling_solution *solution,
                                       rb_rolling_errors *errors, rb_message *why)
{
    sample s[RB_ERROR_MESHES] = {0};
    rb_status status = rb_rolling_error_check(rc, why);

    memset(solution, 0, sizeof *solution);
    for (int k = 0; k < RB_ERROR_MESHES && status == RB_OK; k++) {
        const rb_rolling_case companion = rb_rolling_error_mesh(rc, k);
        status = take_sample(&companion, with_stress, &s[k], why);
    }
    if (status == RB_OK)
        estimate(s, with_stress, errors);
    if (status == RB_OK || s[2].solution.p)
        give_finest(s, solution);
    samples_free(s);
    return status;
}

/* Largest of the relative estimates that --accuracy asks for: forces in units of their
 * bound, creepage in units of mu a/R. */
static double worst_relative(const rb_rolling_case *rc, const rb_rolling_solution *s,
                             const rb_rolling_solution *e)
{
    double worst =
        fmax(e->normal_load / s->normal_load, e->max_pressure / s->max_pressure);

    worst = fmax(worst, e->half_width / s->half_width);
    if (rc->mu > 0.0)
        worst = fmax(worst, e->force_ratio);
    if (rc->mu > 0.0 && rc->formulation != RB_STATIC)
        worst = fmax(worst, e->creepage * rb_rolling_radius(rc) /
                                (rc->mu * s->hertz_half_width));
    return worst;
}

/* Meshes grow by the square root of 2, so that each new one finds its two coarser
 * companions already solved. */
static int next_count(int n)
{
    return (int)ceil(n * 1.41421356);
}

rb_status rb_rolling_solve_to_accuracy(const rb_rolling_case *rc, double accuracy,
                                       rb_rolling_solution *solution,
                                       rb_rolling_errors *errors, int *elements,
                                       rb_message *why)
{
    sample s[3] = {0};
    rb_rolling_case refined = *rc;
    int n = rc->contact_elements / 2;
    double worst = INFINITY;
    rb_status status = rb_rolling_error_check(rc, why);

    memset(solution, 0, sizeof *solution);
    if (status == RB_OK && !(accuracy > 0.0 && accuracy < 1.0))
        status =
            rb_fail(why, RB_EINVAL, "accuracy: expected in (0, 1), got %g", accuracy);
    for (int k = 0; status == RB_OK && n <= MOST_ELEMENTS; k++, n = next_count(n)) {
        rb_rolling_solution_free(&s[0].solution);
        memmove(s, s + 1, 2 * sizeof *s);
        memset(&s[2], 0, sizeof s[2]);
        refined.contact_elements = n;
        status = take_sample(&refined, 0, &s[2], why);
        *elements = n;
        if (status != RB_OK || k < 2)
            continue;
        estimate(s, 0, errors);
        worst = worst_relative(rc, &s[2].solution, &errors->scalar);
        if (worst <= accuracy)
            break;
    }
    if (status == RB_OK && !(worst <= accuracy))
        status = rb_fail(why, RB_INACCURATE,
                         "accuracy %g not reached with %d elements: estimated error %.2g",
                         accuracy, *elements, worst);
    give_finest(s, solution);
    samples_free(s);
    return status;
}
