/* Cases that must be refused, each with its reason, and the quantities derived from good
 * ones. */
#include "check.h"
#include "rolling/internal.h"

#include <gsl/gsl_math.h>
#include <string.h>

typedef struct {
    const char *word; /* that the refusal must contain */
    size_t field;     /* of the double that is wrong */
    double value;
} bad_value;

#define FIELD(name) offsetof(rb_rolling_case, name)

static const bad_value bad_values[] = {
    {"mu", FIELD(mu), -0.1},
    {"mu", FIELD(mu), NAN},
    {"mu", FIELD(mu), INFINITY},
    {"Young", FIELD(a.young), 0.0},
    {"Young", FIELD(a.young), NAN},
    {"Poisson", FIELD(a.poisson), 0.51},
    {"Poisson", FIELD(a.poisson), -1.0},
    {"radius", FIELD(a.radius), -1.0},
    {"radius", FIELD(a.radius), INFINITY},
    {"arc", FIELD(a.arc), 91.0},
    {"approach", FIELD(approach), -1.0},
    {"load", FIELD(load), 0.0},
    {"half-width", FIELD(half_width), -2.0},
    {"shift", FIELD(shift), INFINITY},
    {"zone", FIELD(zone), -1.0},
    {"zone", FIELD(zone), 50.0},
    {"tol", FIELD(tol), 0.0},
    {"force ratio", FIELD(force_ratio), 1.1},
};

static void bad_values_are_refused_by_name(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof bad_values / sizeof *bad_values; k++) {
        rb_rolling_case rc = rb_rolling_case_defaults();
        rb_message why = {""};
        memcpy((char *)&rc + bad_values[k].field, &bad_values[k].value, sizeof(double));
        CHECK_STATUS(rb_rolling_case_check(&rc, &why), RB_EINVAL);
        if (!strstr(why.text, bad_values[k].word))
            fail_msg("'%s' does not name '%s'", why.text, bad_values[k].word);
    }
}

static void check_refused(const rb_rolling_case *rc, const char *first,
                          const char *second)
{
    rb_message why = {""};
    CHECK_STATUS(rb_rolling_case_check(rc, &why), RB_EINVAL);
    if (!strstr(why.text, first) || !strstr(why.text, second))
        fail_msg("'%s' does not name '%s' and '%s'", why.text, first, second);
}

static void contradictions_name_both_sides(void **state)
{
    (void)state;
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.approach = rc.load = 1.0;
    check_refused(&rc, "approach", "load");

    rc = rb_rolling_case_defaults();
    rc.creep = rc.creep_ratio = 0.1;
    check_refused(&rc, "creep", "creep-ratio");

    rc = rb_rolling_case_defaults();
    rc.formulation = RB_STEADY;
    rc.shift = 0.1;
    check_refused(&rc, "shift", "creep");

    rc = rb_rolling_case_defaults();
    rc.formulation = RB_STEADY;
    rc.creep = rc.force = 0.1;
    check_refused(&rc, "creep", "force");

    rc = rb_rolling_case_defaults();
    rc.load = 10.0;
    rc.force = 3.1; /* mu P = 3 */
    check_refused(&rc, "force", "mu P");

    rc = rb_rolling_case_defaults();
    rc.a.support = RB_BEM_HALFPLANE;
    rc.normals = RB_BEM_NORMALS_SURFACE;
    check_refused(&rc, "normals", "half-plane");
}

static void a_table_gap_needs_its_table(void **state)
{
    (void)state;
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.gap = RB_GAP_TABLE;
    check_refused(&rc, "gap", "none is given");
}

static void hertz_closes_the_circle(void **state)
{
    (void)state;
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.elastic_b = 1;
    rc.b.radius = 25.0;
    CHECK_REL(rb_rolling_radius(&rc), 50.0 / 3.0, 1e-15, "1/R = 1/50 + 1/25");
    CHECK_REL(rb_rolling_derive(&rc).modulus, 94500.0 / (2 * 0.99), 1e-15, "E*");
    CHECK_ABS(rb_rolling_derive(&rc).dundurs, 0.0, 1e-16, "beta of similar bodies");
    const double P = rb_rolling_hertz_load(&rc, 0.3);
    CHECK_REL(rb_rolling_hertz_half_width(&rc, P), 0.3, 1e-15, "half-width of its load");
    rc.elastic_b = 0;
    CHECK_REL(rb_rolling_derive(&rc).dundurs, 0.8 / 1.8, 1e-14,
              "beta on a rigid plane, nu = 0.1");
}

static void the_half_width_of_an_approach_inverts_the_compression(void **state)
{
    (void)state;
    rb_rolling_case rc = rb_rolling_case_defaults();
    const double a = 0.01 * rc.a.radius;
    rc.approach = a * a / (4 * rc.a.radius) * (2 * log(4 * rc.a.radius / a) - 1);
    CHECK_REL(rb_rolling_derive(&rc).half_width, a, 1e-14, "delta = %g", rc.approach);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bad_values_are_refused_by_name),
        cmocka_unit_test(contradictions_name_both_sides),
        cmocka_unit_test(a_table_gap_needs_its_table),
        cmocka_unit_test(hertz_closes_the_circle),
        cmocka_unit_test(the_half_width_of_an_approach_inverts_the_compression),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
