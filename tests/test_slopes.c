/* Derivatives against differences of solved problems: of histories, of single cases on
 * elements that move; those of curves against those of single cases. */
#include "case_words.h"
#include "differences.h"

#include <gsl/gsl_cdf.h>
#include <unistd.h>

/* ---- Histories --------------------------------------------------------------------- */

#define PLANES "support halfplane load 500 contact-elements 30 "
#define ROLLS "formulation transient distance 1 "
/* A wheel of which, within the usual step of some inputs, an element goes from one side to the
 * other. */
#define SIDES_CHANGE                                                                               \
    "support arc arc 60 outer-elements 300 contact-elements 15 zone 2 poisson 0.4 young-b 200000 " \
    "poisson-b 0.28 datum-b 60 approach 0.04 force-ratio -0.4 formulation steady mesh uniform "    \
    "plane stress "

#define YIELDING_WHEEL                                                                             \
    "support hub half-width 1 contact-elements 30 outer-elements 60 formulation transient "        \
    "interlayer-tangential 3e-6 hardening 20000 "

static const words histories[] = {
    {{PLANES ROLLS "similar yes creep 1e-3"}},
    {{PLANES ROLLS "young-b 70000 creep -2e-3 steps 9"}},
    {{PLANES ROLLS "similar yes force 60 interlayer-tangential 1e-6 zone 1.3"}},
    {{PLANES ROLLS "young-b 70000 force-ratio -0.5"}},
    {{PLANES "formulation static young-b 70000 increments 4 shift 1e-3"}},
    {{PLANES "formulation static similar yes increments 5 force-ratio 0.6"}},
    {{PLANES "formulation static similar yes increments 5 shift 3e-3 friction-law exponential "
             "mu-fall 0.1 memory 2e-3"}},
    {{"support hub load 500 contact-elements 20 outer-elements 60 " ROLLS "creep-ratio 0.5"}},
    {{PLANES ROLLS
      "similar yes creep 1e-3 relaxation-time 1e-3 relaxation-ratio 1 speed 1000 zone 2"}},
    {{PLANES ROLLS "similar yes creep 1e-3 conductivity 50 heat-capacity 3.5 speed 1000"}},
    {{PLANES ROLLS "creep 1e-3 layer-thickness 2 base-young 200000 base-poisson 0.3"}},
    {{"support halfplane load 20 young-b 1e4 contact-elements 30 " ROLLS
      "creep 1e-3 interlayer-normal 1e-3"}}, /* elements that follow a soft third body */
    /* no force at rest without friction: none by mu, but all others */
    {{PLANES ROLLS "young-b 70000 creep 2e-3 mu 0"}},
    /* state variables that the particles carry: the slip of what yields, laws by slip, by
     * temperature and with memory; under a force past slips shift all others */
    {{YIELDING_WHEEL "distance 0.2 creep -2e-3 yield-stress 40"}},
    {{PLANES "formulation transient distance 0.4 similar yes force-ratio -0.5 speed 3000 "
             "friction-law rational mu-fall 0.15 slip-scale 10"}},
    {{"support halfplane load 2000 contact-elements 30 " ROLLS
      "creep 1e-3 plane stress speed 3000 friction-law exponential mu-fall 0.1 slip-scale 30 "
      "memory 0.001"}},
    {{"support hub half-width 1 contact-elements 20 outer-elements 60 formulation transient "
      "distance 0.4 creep 6e-3 speed 500 conductivity 50 heat-capacity 3.7 mu-heat -0.1,0,30"}},
    /* within a step what has yielded hardly at all may yield the other way, and another element
     * may become the warmest one */
    {{YIELDING_WHEEL "distance 0.74 steps 10 force-ratio -0.5 yield-stress 100"}},
    {{"support halfplane load 2000 contact-elements 30 formulation transient distance 0.7 "
      "increments 3 force-ratio -0.5 speed 3000 conductivity 50 heat-capacity 3.7 mu-heat "
      "0.1,-5,60"}},
    /* steps of just an element, on elements that stay */
    {{"support halfplane similar yes half-width 1 zone 1.2 contact-elements 36 " ROLLS
      "creep 1e-3 steps 15"}},
    {{"support halfplane contact-elements 30 formulation transient similar yes history "
      "tests/data/slopes_history.tsv"}},
    /* bodies that relax at rest, under loads in time */
    {{"support halfplane similar yes contact-elements 22 formulation static relaxation-time 0.01 "
      "relaxation-ratio 1 time-step 0.01 history tests/data/slopes_rest.tsv"}},
    {{"support halfplane contact-elements 24 zone 2 formulation static relaxation-time 0.01 "
      "relaxation-ratio 1 interlayer-normal 2e-6 history tests/data/slopes_rest.tsv"}},
    /* on a wheel, whose elements are equal arcs of another circle when the radius is another one */
    {{"support arc contact-elements 14 outer-elements 50 formulation static relaxation-time 0.01 "
      "relaxation-ratio 1 time-step 0.01 history tests/data/slopes_rest.tsv"}},
};

/* By every third input, the others in the next turns. */
TEST(histories_have_derivatives)
{
    enum { EVERY = 3, HISTORIES = sizeof histories / sizeof *histories };
    int compared = 0;

    for (size_t h = 0; h < HISTORIES; h++) {
        rb_message why = {.text = ""};
        differences d;
        held_case *c = case_of(RB_CASE_SINGLE, &histories[h], NULL, 0.0);
        int first = 0;
        while (!is_in_turn(first + (int)h, EVERY))
            first++;
        const int all = is_in_turn(first + 1 + (int)h, EVERY);
        if (compare_steps(c, first, all ? 1 : EVERY, &d, &why) != RB_OK)
            fail_msg("history %d: %s", (int)h, why.text);
        if (!(d.off <= 1e-8))
            fail_msg("history %d: %.2g: %s", (int)h, d.off, d.text);
        if (all && d.compared < 3)
            fail_msg("history %d: %d numbers compared", (int)h, d.compared);
        compared += d.compared;
    }
    if (compared < HISTORIES)
        fail_msg("%d numbers of %d histories compared", compared, HISTORIES);
}

/* Those of an automatic zone under a table of the gap stay, as those of a zone given like it. */
TEST(elements_under_a_table_stay)
{
    static const words w = {
        {PLANES ROLLS "similar yes creep 1e-3 mesh uniform gap tests/data/slopes_gap.tsv"}};
    rb_case_slopes of[2] = {{0}};
    double zone = 0.0;

    for (int given = 0; given < 2; given++) {
        difference_run run = {.states = {0}};
        rb_message why = {.text = ""};
        held_case *c = case_of(RB_CASE_SINGLE, &w, given ? "zone" : NULL, zone);
        const rb_resolved_case *resolved = rb_case_resolved(c);
        CHECK_STATUS(difference_history(resolved, &resolved->rc, &run, &why), RB_OK);
        zone = run.model.mesh.ends[run.model.mesh.n];
        CHECK_STATUS(rb_case_slopes_choose(c, &rb_rolling_history_columns,
                                           "tangential_load:radius,contact_to:load,approach:young",
                                           9, &of[given], &why),
                     RB_OK);
        CHECK_STATUS(rb_case_slopes_of_steps(c, &run.states, &of[given], NULL, NULL, &why), RB_OK);
        assert_int_equal(rb_case_slopes_note(&of[given], &why), !given);
        difference_run_free(&run);
    }
    assert_int_equal(of[0].rows, of[1].rows);
    for (int row = 0; row < of[0].rows; row++)
        for (int k = 0; k < of[0].n; k++) {
            const double want = rb_case_slope_value(&of[1], row, k);
            CHECK_ABS(rb_case_slope_value(&of[0], row, k), want, 1e-9 * fabs(want),
                      "column %d, step %d", k, row + 1);
        }
    for (int given = 0; given < 2; given++)
        rb_case_slopes_free(&of[given]);
}

#define A_STEP_IS_AN_ELEMENT                                                                       \
    "support halfplane similar yes young 364 poisson 0.3 radius 100 half-width 1 mesh uniform "    \
    "zone 1.2 contact-elements 36 " ROLLS "creep 1e-3 "

/* Where the way is a whole number of given elements, a larger half-width would bring one more
 * step: the number of steps stays, as if it were given. */
TEST(the_number_of_steps_stays)
{
    static const words cases[] = {{{A_STEP_IS_AN_ELEMENT}}, {{A_STEP_IS_AN_ELEMENT "steps 15"}}};
    rb_case_slopes of[2] = {{0}};

    for (int given = 0; given < 2; given++) {
        difference_run run = {.states = {0}};
        held_case *c = case_of(RB_CASE_SINGLE, &cases[given], NULL, 0.0);
        const rb_resolved_case *resolved = rb_case_resolved(c);
        CHECK_OK(difference_history(resolved, &resolved->rc, &run, &message));
        CHECK_OK(rb_case_slopes_choose(c, &rb_rolling_history_columns,
                                       "tangential_load:half-width,creepage:mu", 9, &of[given],
                                       &message));
        CHECK_OK(rb_case_slopes_of_steps(c, &run.states, &of[given], NULL, NULL, &message));
        difference_run_free(&run);
    }
    assert_int_equal(of[0].rows, 16);
    for (int row = 0; row < of[0].rows; row++)
        CHECK_REL(rb_case_slope_value(&of[0], row, 0), rb_case_slope_value(&of[1], row, 0), 1e-12,
                  "step %d", row + 1);
    rb_case_slopes_free(&of[0]);
    rb_case_slopes_free(&of[1]);
}

/* What must be known to read the columns, from one step or point on. */
TEST(one_step_is_told)
{
    rb_case_slopes of = {.rows = 7};
    rb_message note;

    assert_int_equal(rb_case_slopes_note(&of, &note), 0);
    assert_string_equal(note.text, "");
    of.degenerate = 1;
    assert_int_equal(rb_case_slopes_note(&of, &note), 1);
    assert_non_null(strstr(note.text, "in 1 of 7 steps an element stands between two zones"));
    of.without = 1;
    snprintf(of.reason.text, sizeof of.reason.text, "reason");
    assert_int_equal(rb_case_slopes_note(&of, &note), 1);
    assert_string_equal(note.text, "1 of 7 points have no derivatives: reason");
    of.stay = 1;
    assert_int_equal(rb_case_slopes_note(&of, &note), 1);
    assert_string_equal(note.text, "derivatives are those on elements that do not move; 1 of 7 "
                                   "points have no derivatives: reason");
    /* a derivative that does not exist in the history of 7 steps, each with a pair */
    double value[14] = {0.0};
    value[4] = value[5] = NAN;
    of = (rb_case_slopes){.table = &rb_rolling_history_columns, .n = 1, .rows = 7, .value = value};
    assert_int_equal(rb_case_slopes_note(&of, &note), 1);
    assert_non_null(strstr(note.text, "in 1 of 7 rows some derivatives do not exist (NaN)"));
    value[5] = 1.0;
    assert_int_equal(rb_case_slopes_note(&of, &note), 0);
}

/* A standard deviation of a number by which nobody has differentiated. */
TEST(tolerances_need_derivatives)
{
    const rb_case_tolerances t = {.n = 1, .name = {"radius"}, .deviation = {0.1}};
    rb_case_derivative other = {.name = "young"};
    const rb_case_derivatives all = {.n = 1, .of = &other};
    rb_rolling_solution deviation;

    CHECK_STATUS(rb_case_propagate(&t, &all, &deviation, &message), RB_EINVAL);
    assert_string_equal(message.text, "tolerance: radius: no derivatives");
}

/* A boundary that is compressed: variants are so closely that steps do not show it. */
TEST(compressed_boundaries_have_derivatives)
{
    static const words w = {{"support hub load 500 contact-elements 16 outer-elements 1150 "
                             "formulation steady mesh uniform creep-ratio 0.4 poisson 0.3"}};
    rb_message why = {.text = ""};
    differences d;
    rb_case_number number[RB_CASE_NUMBERS_MAX];
    int n, poisson = 0;

    (void)state;
    IN_TURN(0, 4);
    held_case *c = case_of(RB_CASE_SINGLE, &w, "tol", 1e-13);
    CHECK_STATUS(rb_case_numbers(c, number, &n, &why), RB_OK);
    while (strcmp(number[poisson].name, "poisson") != 0)
        poisson++;
    CHECK_STATUS(compare_single(c, poisson, n, &d, &why), RB_OK);
    assert_int_equal(d.compared, 1);
    CHECK_MAX(d.off, 1e-8, "%s", d.text);
}

static rb_status with_poisson(void *context, double value, rb_rolling_case *rc, rb_message *why)
{
    (void)why;
    *rc = *(const rb_rolling_case *)context;
    rc->a.poisson = value;
    return RB_OK;
}

/* At an end of the range one place of the stencil is the case itself, whose model has a
 * boundary that is compressed less. */
TEST(compressed_boundaries_have_rates)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rb_message why = {.text = ""};
    rb_rolling_model model, closely;
    rb_sensitivity_rate rate[2];
    double off = 0.0, largest = 0.0;

    (void)state;
    IN_TURN(2, 4);
    rc.formulation = RB_STEADY;
    rc.mesh = RB_MESH_UNIFORM;
    rc.a.support = RB_BEM_HUB;
    rc.a.poisson = 0.5;
    rc.load = 500.0;
    rc.contact_elements = 16;
    rc.outer_elements = 1150;
    rc.creep_ratio = 0.4;
    const rb_sensitivity_input poisson = {rc.a.poisson, 0.3, -1.0, 0.5, with_poisson, &rc};
    CHECK_STATUS(rb_rolling_model_create(&rc, &model, &why), RB_OK);
    assert_true(rb_rolling_is_compressed(&model));
    CHECK_STATUS(rb_rolling_variant_closely(&model, &closely, &why), RB_OK);
    for (int k = 0; k < 2; k++) {
        rb_sensitivity *s;
        double mu;
        CHECK_STATUS(rb_sensitivity_create(k ? &closely : &model, 0, &s, &why), RB_OK);
        CHECK_STATUS(rb_sensitivity_rates(s, &poisson, &rate[k], &mu, &why), RB_OK);
        rb_sensitivity_free(s);
    }
    for (int i = 0; i < model.mesh.n; i++)
        if (model.state.zone[i] == RB_ZONE_STICK) {
            off = fmax(off, fabs(rate[0].slip[i] - rate[1].slip[i]));
            largest = fmax(largest, fabs(rate[1].slip[i]));
        }
    CHECK_MAX(off, 1e-6 * largest, "slip by poisson");
    for (int k = 0; k < 2; k++)
        rb_sensitivity_rate_free(&rate[k]);
    rb_rolling_variant_free(&model, &closely);
    rb_rolling_model_free(&model);
}

/* Rates of fits, too, take a smaller step where an element goes from one side of the wheel to
 * the other within the usual one. */
TEST(rates_of_wheels_are_those_of_derivatives)
{
    static const words w = {{SIDES_CHANGE}};
    rb_message why = {.text = ""};
    rb_case_number number[RB_CASE_NUMBERS_MAX];
    rb_case_result r;
    rb_sensitivity *s;
    int n;
    held_case *c = case_of(RB_CASE_SINGLE, &w, "tol", 1e-13);
    CHECK_STATUS(rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &why), RB_OK);
    CHECK_STATUS(rb_sensitivity_create(&r.model, 1, &s, &why), RB_OK);
    CHECK_STATUS(rb_case_numbers(c, number, &n, &why), RB_OK);
    for (int k = 0; k < n; k++) {
        rb_sensitivity_derivative d;
        rb_sensitivity_rate rate;
        double mu, off = 0.0, largest = 0.0;
        const rb_status exact = rb_sensitivity_differentiate(s, &number[k].input, &d, &why),
                        status = rb_sensitivity_rates(s, &number[k].input, &rate, &mu, &why);
        CHECK_STATUS(status, exact);
        for (int i = 0; i < r.solution.n && exact == RB_OK; i++)
            if (r.solution.zone[i] != RB_ZONE_SEPARATED) {
                off = fmax(off, fabs(rate.gap[i] - d.rate.gap[i]));
                largest = fmax(largest, fabs(d.rate.gap[i]));
            }
        CHECK_MAX(off, 1e-5 * largest + 1e-9 * r.model.problem.gap_length / number[k].input.scale,
                  "gap by %s", number[k].name);
        rb_sensitivity_rate_free(&rate);
        rb_sensitivity_derivative_free(&d);
    }
    rb_sensitivity_free(s);
    rb_case_result_free(&r);
}

/* Nor do the elements that follow its edges: not even by rounding. */
TEST(the_pressure_of_similar_bodies_does_not_depend_on_friction)
{
    static const words w = {
        {PLANES "similar yes formulation steady mesh fitted radius 460 creep-ratio 0.5"}};
    static const char *const name[] = {"mu"};
    held_case *c = case_of(RB_CASE_SINGLE, &w, NULL, 0.0);
    rb_case_derivatives all;
    rb_case_result r;

    CHECK_OK(rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &message));
    CHECK_OK(rb_case_differentiate(c, &r.model, 1, name, &all, &message));
    const rb_rolling_solution *d = &all.of[0].d.value[0];
    for (int i = 0; i < d->n; i++)
        CHECK_ABS(d->p[i], 0.0, 0.0, "p of element %d", i);
    CHECK_ABS(d->contact_to, 0.0, 0.0, "edge");
    rb_case_derivatives_free(&all);
    rb_case_result_free(&r);
}

/* An element between two zones in free rolling, where those beside it are not found, leaves the
 * other results as they are: forces that grow together make all forces grow as they do. */
TEST(what_free_rolling_has_not_other_results_have)
{
    static const words w = {
        {PLANES
         "formulation steady plane stress radius 28.986355077556603 young 87276.939048569795 "
         "poisson 0.40571236782852915 young-b 69993.051422520657 poisson-b 0.24693157230221024 "
         "radius-b -164.70091947493714 contact-elements 15 mesh uniform zone 1.0135058831246722 "
         "load 474.43679874774131 mu 0.303283812935981 creep-ratio -1.1248225562948853 "
         "interlayer-tangential 1.5887741439552933e-06 interlayer-normal 2.78571852354534e-06 "
         "conductivity 50 heat-capacity 3.5 speed 3985.6112748102541 temperature "
         "303.60907274736763 mu-heat 0.0606568,303.609,101.406"}};
    static const struct {
        const char *name;
        double forces;
    } of[] = {{"young", 1.0},
              {"young-b", 1.0},
              {"load", 1.0},
              {"conductivity", 1.0},
              {"heat-capacity", 1.0},
              {"interlayer-normal", -1.0},
              {"interlayer-tangential", -1.0}};
    held_case *c = case_of(RB_CASE_SINGLE, &w, NULL, 0.0);
    rb_case_derivatives all;
    rb_case_result r;
    double grown = 0.0;
    int unknown = 0;

    CHECK_OK(rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &message));
    CHECK_OK(rb_case_differentiate(c, &r.model, 0, NULL, &all, &message));
    for (int j = 0; j < all.n; j++)
        for (size_t k = 0; k < sizeof of / sizeof *of; k++) {
            const rb_rolling_solution *d = &all.of[j].d.value[0];
            if (strcmp(all.of[j].name, of[k].name) != 0)
                continue;
            CHECK_OK(all.of[j].status);
            grown += of[k].forces * all.of[j].value * d->tangential_load;
            unknown += isnan(d->free_creepage);
        }
    CHECK_REL(grown, r.solution.tangential_load, 1e-8, "Q");
    assert_int_equal(unknown, 1);
    rb_case_derivatives_free(&all);
    rb_case_result_free(&r);
}

/* Elements fitted to the edges, aligned with them, of wheels, of a zone that is given. */
TEST(single_cases_have_derivatives)
{
    static const words cases[] = {
        {{PLANES "formulation steady young-b 70000 creep 1e-3 mesh fitted"}},
        {{PLANES "formulation steady similar yes creep-ratio 0.4 mesh aligned"}},
        /* edges that move with their elements: coupled strongly */
        {{PLANES "formulation steady mu 0.5 creep 1.5e-3 mesh aligned"}},
        {{PLANES "formulation steady creep-ratio 0.4 mesh fitted plane stress layer-thickness 2"}},
        {{"support hub load 500 contact-elements 24 formulation steady force-ratio 0.4 mesh fitted "
          "outer-elements 40"}},
        {{"support halfplane formulation steady similar yes creep-ratio -0.4 half-width 1 "
          "yield-stress 200 hardening -2000 mu 3 contact-elements 20"}},
        /* within the step an element that has yielded a little yields the other way */
        {{"support arc radius 43.8288793752594 young 86031.693619636353 poisson "
          "0.16526445309944826 contact-elements 24 outer-elements 80 mesh uniform zone "
          "1.2480744201363148 load 469.02823832666422 mu 0.43314972785413369 force-ratio "
          "0.28434611288455508 interlayer-tangential 2.2151411605529795e-06 interlayer-normal "
          "1.3458442772155702e-06 yield-stress 58.638175546896569 hardening 28820.744971838809"}},
        /* within the step another element becomes the warmest one */
        {{"support halfplane load 800 contact-elements 15 formulation steady similar yes "
          "force-ratio -0.4 mesh fitted conductivity 50 heat-capacity 3.5 speed 3000"}},
        /* within the step the power of an element beside stick changes its sign */
        {{"support arc arc 71 radius 14.9 young 171800 poisson 0.3 mu 0.132 speed 1000 "
          "conductivity 36.2 heat-capacity 10 formulation steady mesh fitted approach 0.00186 "
          "creep -6.5e-6 contact-elements 39 outer-elements 80"}},
        /* a slip beside that at which memory has a kink */
        {{"support halfplane radius 45 young 1.1 poisson -0.3 young-b 0.83 poisson-b 0.45 "
          "layer-thickness-b 1.6 base-young-b 9.3 datum-b 16 mu 0.039 speed 1000 friction-law "
          "exponential mu-fall 0.0117 slip-scale 0.273 memory 7.7e-6,0.1476 formulation steady "
          "approach 0.00417 force-ratio -0.43 contact-elements 19"}},
        {{SIDES_CHANGE}}};
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        if (!is_in_turn((int)k, 8))
            continue;
        rb_message why = {.text = ""};
        differences d;
        held_case *c = case_of(RB_CASE_SINGLE, &cases[k], "tol", 1e-13);
        if (compare_single(c, 0, 1, &d, &why) != RB_OK)
            fail_msg("case %d: %s", (int)k, why.text);
        if (!(d.off <= 1e-8))
            fail_msg("case %d: %.2g: %s", (int)k, d.off, d.text);
        if (d.compared < 4)
            fail_msg("case %d: %d numbers compared", (int)k, d.compared);
    }
}

/* The edge that is found may jump with the mesh; a/(2R) has the derivative that follows from a. */
TEST(the_strain_without_a_layer_follows_the_half_width)
{
    static const words w = {
        {"support arc arc 37.787495254254864 radius 293.2308540130111 young 461.47108588842997 "
         "poisson -0.3 similar yes mu 0.3331272921451354 formulation steady load "
         "117.86737277829526 creep -0.002735447231628198 contact-elements 38"}};
    static const char *const name[] = {"radius"};
    held_case *c = case_of(RB_CASE_SINGLE, &w, NULL, 0.0);
    const double radius = rb_rolling_derive(&rb_case_resolved(c)->rc).radius;
    rb_case_derivatives all;
    rb_case_result r;

    (void)state;
    CHECK_OK(rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &message));
    CHECK_OK(rb_case_differentiate(c, &r.model, 1, name, &all, &message));
    const rb_rolling_solution *d = &all.of[0].d.value[0];
    /* similar bodies: 1/R is twice that of A */
    CHECK_REL(d->max_strain,
              0.5 * (d->half_width / radius - r.solution.half_width / (radius * all.of[0].value)),
              1e-9, "max_strain");
    rb_case_derivatives_free(&all);
    rb_case_result_free(&r);
}

TEST(refusals_of_histories)
{
    static const words by_approach = {
        {"support halfplane " ROLLS "similar yes creep 1e-3 approach 0.01 contact-elements 30"}};
    held_case *c = case_of(RB_CASE_SINGLE, &by_approach, NULL, 0.0);
    differences d;

    CHECK_SAYS(compare_steps(c, 0, 1, &d, &message), RB_EINVAL, "give a load");
}

/* Elements that move with the contact would take the midpoint to either side of the row. */
TEST(rows_of_tables_under_midpoints)
{
    static const words both[] = {
        {{PLANES, "similar", "yes", "creep", "1e-3", "mesh", "uniform", "formulation", "steady"}},
        {{PLANES, "similar", "yes", "creep", "1e-3", "mesh", "uniform", ROLLS}}};
    enum { SLIPS = 4 }; /* counted from 0 */

    for (int k = 0; k < 2; k++)
        for (int beside = 0; beside < 2; beside++) {
            char table[] = "/tmp/rollbem-slopes-XXXXXX";
            rb_case_result r = {0};
            rb_sensitivity *s = NULL;
            differences d;
            held_case *c = case_of(RB_CASE_SINGLE, &both[k], NULL, 0.0);
            CHECK_OK(rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &message));
            const double *end = r.model.mesh.ends + SLIPS, h = end[1] - end[0];
            FILE *file = fdopen(mkstemp(table), "w");
            assert_non_null(file);
            fprintf(file, "-1 0.4\n%.17g 0.3\n1 0.32\n",
                    0.5 * (end[0] + end[1]) + (beside ? 0.3 * h : 0.0));
            assert_int_equal(fclose(file), 0);
            rb_case_result_free(&r);
            CHECK_OK(rb_case_set(c, "friction-law", table, RB_GIVEN_ARGUMENT, &message));
            CHECK_OK(rb_case_resolve(c, &message));
            if (k == 1) {
                CHECK_STATUS(compare_steps(c, 0, 1000, &d, &message), beside ? RB_OK : RB_EINVAL);
                assert_true(beside || strstr(message.text, "under the midpoint of element 5"));
            } else {
                CHECK_OK(rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &message));
                assert_int_equal(r.model.state.zone[SLIPS], RB_ZONE_SLIP_NEGATIVE);
                CHECK_OK(rb_sensitivity_create(&r.model, 1, &s, &message));
                assert_int_equal(rb_sensitivity_motion(s),
                                 beside ? RB_SENSITIVITY_ZONE : RB_SENSITIVITY_FIXED);
                rb_sensitivity_free(s);
                rb_case_result_free(&r);
            }
            unlink(table);
        }
}

/* Within the step that a flexibility needs, the power of an element would begin to heat it. */
TEST(inputs_that_leave_the_bodies_have_a_shorter_step)
{
    static const words w = {
        {"formulation transient distance 2.2 contact-elements 30 outer-elements 60 support arc "
         "arc 45 similar yes load 500 force-ratio -0.5 friction-law linear mu-fall 0.15,-0.05 "
         "slip-scale 10,40 memory 0.001 speed 3000 conductivity 50 heat-capacity 3.7 mu-heat "
         "-0.1,0,30 tol 1e-13"}};
    enum { STEP = 16, PARTS = 2 };
    const double by = 0.1;
    difference_run at = {.states = {0}}, beside[PARTS] = {{.states = {0}}};
    rb_case_slopes slopes;
    held_case *c = case_of(RB_CASE_SINGLE, &w, NULL, 0.0);

    CHECK_OK(difference_history(rb_case_resolved(c), &rb_case_resolved(c)->rc, &at, &message));
    CHECK_OK(rb_case_slopes_choose(c, &rb_rolling_history_columns, "creepage:speed", 1, &slopes,
                                   &message));
    CHECK_OK(rb_case_slopes_of_steps(c, &at.states, &slopes, NULL, NULL, &message));
    for (int k = 0; k < PARTS; k++) {
        held_case *other = case_of(RB_CASE_SINGLE, &w, "speed", 3000.0 + (k ? by : -by));
        CHECK_OK(difference_history(rb_case_resolved(other), &rb_case_resolved(other)->rc,
                                    &beside[k], &message));
    }
    const double want =
        (beside[1].history.creepage[STEP] - beside[0].history.creepage[STEP]) / (2.0 * by);
    CHECK_ABS(rb_case_slope_value(&slopes, STEP, 0), want, 1e-5 * fabs(want), "step 17");
    rb_case_slopes_free(&slopes);
    for (int k = 0; k < PARTS; k++)
        difference_run_free(&beside[k]);
    difference_run_free(&at);
}

/* ---- Uncertain inputs of histories ------------------------------------------------- */

/* A Latin hypercube of normal distributions, its second coordinate the first one with the
 * bits of its number reversed, scatters as the tangents say, at every step. */
TEST(samples_of_histories_scatter_as_tolerances)
{
    enum { BITS = 6, N = 1 << BITS };
    static const words w = {{PLANES ROLLS "similar yes creep 1e-3"}};
    const double load = 500.0, mu = 0.3;
    held_case *c = case_of(RB_CASE_SINGLE, &w, NULL, 0.0);
    rb_case_tolerances t;
    difference_run at = {.states = {0}}, one[N] = {{.states = {0}}};
    double quantile[N], unit = 0.0;

    (void)state;
    CHECK_STATUS(rb_case_read_tolerances(c, "load=0.3%,mu=0.002", &t, &message), RB_OK);
    CHECK_STATUS(difference_history(rb_case_resolved(c), &rb_case_resolved(c)->rc, &at, &message),
                 RB_OK);
    CHECK_STATUS(rb_case_slopes_of_steps(c, &at.states, NULL, &t, &at.history, &message), RB_OK);
    for (int k = 0; k < N; k++) {
        quantile[k] = gsl_cdf_ugaussian_Pinv((k + 0.5) / N);
        unit += quantile[k] * quantile[k] / N;
    }
    for (int k = 0; k < N; k++) {
        int reversed = 0;
        for (int bit = 0; bit < BITS; bit++)
            reversed |= (k >> bit & 1) << (BITS - 1 - bit);
        held_case *sample = case_of(RB_CASE_SINGLE, &w, "mu", mu + 0.002 * quantile[reversed]);
        CHECK_STATUS(
            rb_case_set_number(sample, "load", load * (1.0 + 0.003 * quantile[k]), &message),
            RB_OK);
        CHECK_STATUS(rb_case_resolve(sample, &message), RB_OK);
        CHECK_STATUS(difference_history(rb_case_resolved(sample), &rb_case_resolved(sample)->rc,
                                        &one[k], &message),
                     RB_OK);
        assert_int_equal(one[k].history.n, at.history.n);
    }
    int compared = 0;
    for (int j = 0; j < rb_rolling_history_columns.n; j++) {
        const rb_rolling_result *r = &rb_rolling_history_columns.row[j];
        const int has = rb_sensitivity_has(r) && rb_rolling_has_column(r, at.history.deviations);
        for (int row = 1; row < at.history.n && has; row++) {
            double sum = 0.0, squares = 0.0;
            const double least = difference_usual(r, &at) * 1e-6;
            for (int k = 0; k < N; k++) {
                const double x = rb_rolling_entry(r, &one[k].history, row) -
                                 rb_rolling_entry(r, &at.history, row);
                sum += x;
                squares += x * x;
            }
            const double scatter = sqrt((squares - sum * sum / N) / N / unit);
            CHECK_ABS(rb_rolling_entry(r, at.history.deviations, row), scatter,
                      0.04 * scatter + least, "%s, step %d", r->name, row + 1);
            compared += scatter > least;
        }
    }
    if (compared < 5 * (at.history.n - 1))
        fail_msg("%d numbers of %d steps scatter", compared, at.history.n);
    for (int k = 0; k < N; k++)
        difference_run_free(&one[k]);
    difference_run_free(&at);
}

/* ---- Curves ------------------------------------------------------------------------ */

/* Every point has the derivatives of the single case that it is. */
TEST(points_are_single_cases)
{
    static const struct {
        words w;
        rb_rolling_range range;
        const char *over;
    } curve[] = {
        {{{PLANES "mesh uniform similar yes zone 1.2"}},
         {RB_OVER_CREEP_RATIO, 0.1, 0.9, 3, RB_UNITS_MM},
         "creep-ratio"},
        {{{PLANES "mesh uniform young-b 70000 interlayer-tangential 1e-6"}},
         {RB_OVER_CREEP, -2e-3, 1e-3, 4, RB_UNITS_MM},
         "creep"},
        {{{PLANES
           "mesh uniform similar yes relaxation-time 1e-3 relaxation-ratio 1 creep 1e-3 zone 2"}},
         {RB_OVER_SPEED, 100, 10000, 3, RB_UNITS_MM},
         "speed"}};
    for (size_t k = 0; k < sizeof curve / sizeof *curve; k++) {
        rb_message why = {.text = ""};
        rb_case_slopes s, want = {0};
        rb_rolling_curve points;
        const rb_case_purpose purpose =
            curve[k].range.over == RB_OVER_SPEED ? RB_CASE_SPEEDS : RB_CASE_CURVE;
        rb_case *c = case_of(purpose, &curve[k].w, NULL, 0.0);
        if (rb_case_curve_choose(c, &curve[k].range, "all", NULL, &s, &why) != RB_OK ||
            rb_case_curve_solve(c, &curve[k].range, rb_case_resolved(c)->rc.mu, NULL, NULL, &points,
                                &s, &why) != RB_OK)
            fail_msg("curve %d: %s", (int)k, why.text);
        assert_int_equal(s.rows, curve[k].range.points);
        for (int row = 0; row < s.rows; row++) {
            words one = curve[k].w;
            OWNED(rb_case_result) r;
            int at = 0;
            while (one.word[at])
                at++;
            one.word[at] = "formulation steady";
            const double value = curve[k].range.over == RB_OVER_SPEED   ? points.speed[row]
                                 : curve[k].range.over == RB_OVER_CREEP ? points.creepage[row]
                                                                        : points.creep_ratio[row];
            held_case *single = case_of(RB_CASE_SINGLE, &one, curve[k].over, value);
            CHECK_STATUS(rb_case_solve(rb_case_resolved(single), NULL, NULL, &r, &why), RB_OK);
            CHECK_STATUS(
                rb_case_slopes_choose(single, s.table, "all", RB_CASE_SLOPES_MAX, &want, &why),
                RB_OK);
            CHECK_STATUS(rb_case_slopes_alloc(1, &want), RB_OK);
            CHECK_STATUS(rb_case_slopes_at(single, &r.model, &want, want.value, NULL, &why), RB_OK);
            assert_int_equal(want.n, s.n);
            for (int j = 0; j < s.n; j++) {
                const double x = rb_case_slope_value(&s, row, j),
                             y = rb_case_slope_value(&want, 0, j);
                const double size = fabs(rb_rolling_number(s.of[j].result, &r.solution));
                double scale = 1e300;
                rb_case_number number[RB_CASE_NUMBERS_MAX];
                int numbers;
                CHECK_STATUS(rb_case_numbers(single, number, &numbers, &why), RB_OK);
                for (int i = 0; i < numbers; i++)
                    if (strcmp(number[i].name, s.of[j].input) == 0)
                        scale = number[i].input.scale;
                if (!(isnan(x) && isnan(y)))
                    CHECK_ABS(x, y, 1e-8 * fabs(y) + 1e-8 * size / scale,
                              "curve %d, %s by %s, point %d", (int)k, s.of[j].result->name,
                              s.of[j].input, row);
            }
            rb_case_slopes_free(&want);
        }
        int at = 0;
        while (strcmp(s.of[at].result->name, "tangential_load") != 0 ||
               strcmp(s.of[at].input, "radius") != 0)
            at++;
        const double in_mm = rb_case_slope_value(&s, 1, at);
        rb_case_slopes_convert(&s, RB_UNITS_SI);
        CHECK_REL(rb_case_slope_value(&s, 1, at), 1e6 * in_mm, 1e-12, "N/m by m");
        rb_case_slopes_free(&s);
        rb_rolling_curve_free(&points);
        rb_case_free(c);
    }
}

RUN_TESTS(NULL, NULL)
