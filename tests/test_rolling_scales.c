/* The half-width that distances and ratios refer to is that of the contact as it is, or there is
 * none (theory-rolling.md A1). */
#include "case_words.h"
#include "cli_run.h"
#include "rolling/case/case.h"

#include <gsl/gsl_math.h>

static const char *const steel =
    "similar yes support halfplane gap parabola young 210000 poisson 0.3 radius 100 load 900";

/* Solves the words, which have an option set to a number besides (NULL: none). */
static rb_case *solve_words(const char *const part[], const char *name, double value,
                            rb_case_result *r)
{
    words w = {{NULL}};
    for (int k = 0; part[k]; k++)
        w.word[k] = part[k];
    rb_case *c = case_of(RB_CASE_SINGLE, &w, name, value);
    if (rb_case_solve(rb_case_resolved(c), NULL, NULL, r, &message) != RB_OK)
        fail_msg("%s: %s", part[0], message.text);
    return c;
}

TEST(a_third_body_has_its_half_width)
{
    const double hertz = 1.7651, modulus = 115384.6;
    static const double softness[] = {1e-4, 0.01, 0.1, 1.0, 30.0, 1e5};
    for (size_t k = 0; k < sizeof softness / sizeof *softness; k++) {
        OWNED(rb_case_result) r;
        held_case *c =
            solve_words((const char *const[]){steel, "mu 0 mesh fitted contact-elements 200", NULL},
                        "interlayer-normal", softness[k] * hertz / modulus, &r);
        assert_non_null(c);
        CHECK_REL(r.solution.hertz_half_width, r.solution.half_width, 2e-4, "L E*/a = %g",
                  softness[k]);
    }
}

TEST(bodies_that_relax_have_theirs)
{
    static const char *const rows[] = {
        "relaxation-time 0.005 relaxation-ratio 1", "relaxation-time 0.5 relaxation-ratio 1",
        "relaxation-time 1.5 relaxation-ratio 4", "relaxation-time 5 relaxation-ratio 20",
        "relaxation-time 0.1,1,10 relaxation-ratio 1,2,3"};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        OWNED(rb_case_result) r;
        held_case *c = solve_words(
            (const char *const[]){steel, "mu 0.3 formulation steady creep 0.001 speed 1.7651",
                                  "mesh uniform contact-elements 200", rows[k], NULL},
            NULL, 0.0, &r);
        assert_non_null(c);
        CHECK_REL(r.solution.hertz_half_width, r.solution.half_width, 0.02, "%s", rows[k]);
        CHECK_REL(r.solution.creep_ratio, 0.001 * 100.0 / (0.3 * r.solution.half_width), 0.02,
                  "xi R/(mu a)");
    }
}

/* Of a layer much softer than the bodies, whose own contact would be 3e-5 of it. */
TEST(a_way_is_measured_by_the_contact_that_is)
{
    OWNED(rb_case_result) r;
    held_case *c = solve_words(
        (const char *const[]){"support halfplane gap parabola young 1e11 poisson 0.3 radius 100 "
                              "load 10 mu 0.3 interlayer-normal 0.2 interlayer-tangential 0.4",
                              "formulation transient creep 0.01 distance 1.25", NULL},
        NULL, 0.0, &r);
    assert_non_null(c);
    CHECK_REL(r.history.half_width, cbrt(1.5 * 100.0 * 0.2 * 10.0), 1e-3, "unit");
    CHECK_REL(r.history.half_width, r.solution.half_width, 0.05, "of the contact");
    CHECK_REL(r.history.distance[r.history.n - 1], 1.25, 1e-12, "way");
    CHECK_REL(r.solution.max_strain, r.solution.max_pressure / (1e11 / 0.91), 1e-12,
              "strain of the bodies, not of what is between them");
}

/* A table of x^2/200 without --radius is the parabola of R = 100. */
TEST(a_table_has_the_radius_of_its_parabola)
{
    static const char *const rolls = "similar yes support halfplane young 210000 poisson 0.3 load "
                                     "100 mu 0.3 formulation steady creep-ratio 0.4 mesh uniform";
    FILE *f = NOT_NULL(fopen("parabola.txt", "w"));
    for (int i = -40; i <= 40; i++)
        fprintf(f, "%g %.17g\n", 0.05 * i, gsl_pow_2(0.05 * i) / 200.0);
    fclose(f);
    OWNED(rb_case_result) of_table, of_radius;
    held_case *table =
        solve_words((const char *const[]){rolls, "gap parabola.txt", NULL}, NULL, 0.0, &of_table);
    held_case *formula = solve_words((const char *const[]){rolls, "gap parabola radius 100", NULL},
                                     NULL, 0.0, &of_radius);
    assert_non_null(formula);
    const rb_rolling_solution *a = &of_table.solution, *b = &of_radius.solution;
    CHECK_REL(rb_case_resolved(table)->rc.a.radius, 100.0, 1e-4, "radius");
    CHECK_REL(a->hertz_half_width, b->hertz_half_width, 1e-4, "a");
    CHECK_REL(a->creepage, b->creepage, 1e-4, "xi");
    CHECK_REL(a->datum, b->datum, 1e-4, "datum");
    CHECK_REL(a->approach, b->approach, 1e-4, "approach");
    CHECK_REL(a->max_strain, b->max_strain, 1e-3, "strain");
    CHECK_REL(a->torque_a, b->torque_a, 1e-3, "torque");
}

/* A roof, a flat punch: what refers to a radius is absent, or refused where it is given. */
TEST(a_gap_without_a_radius_has_no_ratios)
{
    static const char *const base =
        "similar yes support halfplane young 210000 poisson 0.3 mu 0.3 gap roof.txt";
    static const struct {
        const char *words, *says;
    } refused[] = {
        {"load 100 formulation steady creep-ratio 0.5",
         "creep-ratio: xi R/(mu a), and the gap has"},
        {"half-width 1", "half-width: Hertz's, and the gap has no radius"},
        {"shift 0.001", "approach: R/2 unless it is given, and the gap has no radius"},
        {"load 100 formulation steady free-axle yes", "free-axle: Q = -M/R, and the gap has no"},
        {"load 100 support hub gap parabola", ""}};
    FILE *f = NOT_NULL(fopen("roof.txt", "w"));
    for (int i = -40; i <= 40; i++)
        fprintf(f, "%g %.17g\n", 0.1 * i, 2e-3 * fabs(0.1 * i));
    fclose(f);
    for (size_t k = 0; k < sizeof refused / sizeof *refused; k++) {
        const words w = {{base, refused[k].words}};
        char text[400], *rest = text;
        held_case *c = NOT_NULL(rb_case_create(RB_CASE_SINGLE));
        snprintf(text, sizeof text, "%s %s", w.word[0], w.word[1]);
        for (char *option; (option = strtok_r(rest, " ", &rest));)
            CHECK_OK(
                rb_case_set(c, option, strtok_r(NULL, " ", &rest), RB_GIVEN_ARGUMENT, &message));
        if (!*refused[k].says) {
            CHECK_OK(rb_case_resolve(c, &message));
            continue;
        }
        CHECK_SAYS(rb_case_resolve(c, &message), RB_EINVAL, refused[k].says);
    }
    OWNED(rb_case_result) rolled, given;
    held_case *c = solve_words(
        (const char *const[]){base, "load 100 formulation transient creep 0.001 distance 0.5",
                              NULL},
        NULL, 0.0, &rolled);
    const rb_rolling_solution *s = &rolled.solution;
    assert_false(isfinite(rb_case_resolved(c)->rc.a.radius));
    assert_true(isnan(s->creep_ratio) && isnan(s->hertz_half_width) && isnan(s->torque_a) &&
                isnan(s->resistance_ratio));
    CHECK_REL(rolled.history.half_width, s->half_width, 1e-9, "unit of the way");
    CHECK_REL(s->datum, 2.0 * 4.0 / M_E, 1e-12, "datum");
    CHECK_REL(s->max_strain, s->max_pressure * 2.0 * 0.91 / 210000.0, 1e-12, "strain");
    held_case *of_given = solve_words(
        (const char *const[]){base, "radius 50 load 100 formulation steady creep-ratio 0.5", NULL},
        NULL, 0.0, &given);
    CHECK_REL(rb_case_resolved(of_given)->rc.a.radius, 50.0, 0.0, "what is given stays");
    CHECK_REL(given.solution.creep_ratio, 0.5, 1e-12, "ratio");
}

RUN_TESTS(enter_folder, leave_folder)
