/* Every call that leads to an allocation sees it refused once, in small cases of all
 * kinds: it is told, and nothing is lost. */
#include "cases.h"
#include "rolling/rolling.h"
#include "solved.h"

#include <gsl/gsl_math.h>

static rb_rolling_case plane(int elements)
{
    rb_rolling_case rc = half_plane(RB_STEADY, elements);
    set(&rc, "half-width 1 creep-ratio 0.5 speed 1000");
    return rc;
}

static const rb_rolling_heat warm = {.conductivity = 40.0, .heat_capacity = 3.5};

/* ---- What is done ------------------------------------------------------------------ */

static rb_status solve_in_context(void *context)
{
    OWNED(rb_rolling_solution) s;
    return rb_rolling_solve(context, &s, NULL);
}

static rb_status find_all(void *context)
{
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_solutions) all = {0};
    rb_status s = rb_rolling_model_create(context, &model, NULL);
    if (s == RB_OK)
        s = rb_rolling_find_solutions(&model, &all, NULL);
    return s;
}

static rb_status find_shakedown(void *context)
{
    OWNED(rb_rolling_model) model;
    rb_rolling_shakedown limit;
    OWNED(rb_rolling_stress_maxima) maxima = {.bonds = 0};
    rb_status s = rb_rolling_model_create(context, &model, NULL);
    if (s == RB_OK)
        s = rb_rolling_shakedown_find(&model, &limit, NULL);
    if (s == RB_OK)
        s = rb_rolling_stress_maxima_find(&model, 0.0, &maxima, NULL);
    return s;
}

static rb_status wear(void *context)
{
    const rb_rolling_case *rc = context;
    const rb_rolling_wear w = {
        .law = RB_WEAR_ARCHARD, .coefficient = 1e-9, .way = 1.0, .steps = 1, .increments = 1};
    OWNED(rb_rolling_wear_history) h;
    OWNED(rb_rolling_solution) last;
    return rb_rolling_wear_run(rc, &w, NULL, &h, &last, NULL);
}

static rb_status draw(void *context)
{
    OWNED(rb_rolling_curve) curve, errors;
    const rb_status s =
        rb_rolling_curve_with_errors(context, &(rb_rolling_range){0, 0.1, 0.2, 2, RB_UNITS_MM},
                                     NULL, NULL, &curve, &errors, NULL);
    return s;
}

/* Without a matrix; nothing is solved. */
static rb_status pose_large(void *context)
{
    const rb_rolling_case *rc = context;
    OWNED(rb_rolling_mesh) mesh = {0};
    OWNED(rb_rolling_bodies) bodies = {0};
    OWNED(rb_contact_problem) p = {0};
    rb_status s = rb_rolling_mesh_uniform(rc, NULL, -1.3, 1.3, &mesh, NULL);
    if (s == RB_OK)
        s = rb_rolling_bodies_create(rc, NULL, &mesh, &bodies, NULL);
    if (s == RB_OK)
        s = rb_rolling_problem_create(rc, &mesh, &bodies, NULL, &p, NULL);
    return s;
}

/* The calls that an earlier one has not come to. */
static void refuse(const char *what, rb_status (*work)(void *), rb_rolling_case *rc)
{
    print_message("# %s: %d\n", what, alloc_fail_every_call(work, rc));
}

/* ---- Cases ------------------------------------------------------------------------- */

TEST(laws_and_heat)
{
    rb_rolling_case rc = with(plane(6), "friction-law exponential mu-fall 0.2 slip-scale 0.2");
    refuse("a steep law", solve_in_context, &rc);
    rc.friction.slip_scale[0] = 200.0;
    refuse("all solutions", find_all, &rc);
    set(&rc, "creep-ratio nan force-ratio 0.2");
    refuse("a force", solve_in_context, &rc);
    rc = plane(6);
    rc.heat_a = rc.heat_b = warm;
    rc.heat_b.conductivity *= 2.0;
    rc.friction.heat = -0.1;
    rc.friction.heat_from = 1.0;
    rc.friction.heat_range = 100.0;
    refuse("warm friction", solve_in_context, &rc);
    set(&rc, "formulation transient distance 0.5 steps 2");
    rc.friction.heat = 0.0;
    rc.heat_b = rc.heat_a;
    refuse("warm steps", solve_in_context, &rc);
}

TEST(stress_wear_and_curves)
{
    rb_rolling_case rc = plane(6);
    refuse("shakedown", find_shakedown, &rc);
    refuse("a wheel that wears", wear, &rc);
    rc.contact_elements = 12;
    refuse("curves and their bars", draw, &rc);
    set(&rc, "formulation static creep-ratio nan force-ratio 0.5");
    refuse("fretting", wear, &rc);
}

TEST(steps_that_yield)
{
    rb_rolling_case rc = with(
        plane(6),
        "formulation transient distance 0.5 steps 2 interlayer-tangential 1e-5 yield-stress 10");
    refuse("yielding", solve_in_context, &rc);
}

/* Two lobes, on a wheel: places that no element sees. */
TEST(patches_of_wheels)
{
    enum { ROWS = 41 };
    double x[ROWS], gap[ROWS];
    rb_rolling_profile *profile;
    for (int i = 0; i < ROWS; i++) {
        x[i] = 0.2 * (i - ROWS / 2);
        gap[i] = fmin(gsl_pow_2(x[i] - 2.0), gsl_pow_2(x[i] + 2.0) + 0.01) / 20.0;
    }
    CHECK_OK(rb_rolling_profile_create(ROWS, x, gap, 0.0, &profile, NULL));
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = plane(10);
        set(&rc, "support hub outer-elements 24 half-width nan load 20 mesh %s",
            k ? "fitted" : "uniform");
        rc.gap = RB_GAP_TABLE;
        rc.profile = profile;
        rc.elastic_b = k;
        refuse("patches", solve_in_context, &rc);
    }
    rb_rolling_profile_free(profile);
}

TEST(products_of_large_contacts)
{
    rb_rolling_case rc = plane(RB_ROLLING_LARGE);
    refuse("products", pose_large, &rc);
}

RUN_TESTS(NULL, NULL)
