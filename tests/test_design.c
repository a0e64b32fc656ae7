/* Designs: against Hertz's formulas, a punch whose pressure is uniform, active and loose
 * constraints, what is refused. */
#include "check.h"

#include "analysis/design/design.h"

#include <unistd.h>

static rb_case *case_of(const char *const *word)
{
    rb_case *c = NOT_NULL(rb_case_create(RB_CASE_SINGLE));
    for (int k = 0; word[k]; k += 2)
        CHECK_OK(rb_case_set(c, word[k], word[k + 1], RB_GIVEN_ARGUMENT, &message));
    CHECK_OK(rb_case_resolve(c, &message));
    return c;
}

static const char *const hertz[] = {"support", "halfplane", "similar", "yes", "load",
                                    "500",     "mu",        "0",       "gap", "parabola",
                                    "mesh",    "uniform",   NULL};

static rb_status design(const rb_case *c, const char *result, const char *over, const char *subject,
                        rb_design *d, rb_message *why)
{
    why->text[0] = '\0';
    rb_status s = rb_design_objective(result, d, why);
    if (s == RB_OK)
        s = rb_design_variables(c, over, d, why);
    if (s == RB_OK)
        s = rb_design_constraints(c, subject, d, why);
    return s == RB_OK ? rb_design_solve(c, NULL, d, why) : s;
}

/* p0 = sqrt(P E-star/(pi R)): the least one has the largest radius that a bound or a
 * constraint leaves; the load is proportional to p0^2 R. */
TEST(contacts_of_hertz)
{
    OWNED(rb_case_result) r;
    held_case *c = case_of(hertz);
    assert_int_equal(rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &message), RB_OK);
    const double p0 = r.solution.max_pressure, a = r.solution.half_width;

    OWNED(rb_design) bound = {.n = 0};
    CHECK_OK(design(c, "max_pressure", "radius=20:200", NULL, &bound, &message));
    CHECK_REL(bound.variable[0].value, 200.0, 1e-6, "the bound holds it");
    CHECK_REL(bound.value, p0 * sqrt(50.0 / 200.0), 1e-6, "p0 by R");

    /* differences stay where the input may be, far below the width of its bounds */
    OWNED(rb_design) light = {.n = 0};
    CHECK_OK(design(c, "max_pressure", "load=0.1:9000", NULL, &light, &message));
    CHECK_REL(light.value, p0 * sqrt(0.1 / 500.0), 1e-6, "p0 by P");

    OWNED(rb_design) wide = {.n = 0};
    CHECK_OK(design(c, "max_pressure", "radius=20:200", "half_width<=1.2", &wide, &message));
    CHECK_REL(wide.variable[0].value, 50.0 * (1.2 / a) * (1.2 / a), 1e-5, "a by R");
    CHECK_REL(wide.constraint[0].value, 1.2, 2e-6, "active");

    OWNED(rb_design) heavy = {.n = 0, .largest = 1};
    CHECK_OK(design(c, "normal_load", "radius=20:80,load=100:9000",
                    "max_pressure<=600,half_width>=0.1", &heavy, &message));
    CHECK_REL(heavy.value, 500.0 * 600.0 * 600.0 / (p0 * p0) * 80.0 / 50.0, 1e-5, "P");
    assert_true(heavy.constraint[1].value > 0.1);
}

/* The least radius, and the largest load, that a pressure allows; each has to be varied. */
TEST(an_input_is_the_objective)
{
    OWNED(rb_case_result) r;
    held_case *c = case_of(hertz);
    assert_int_equal(rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &message), RB_OK);
    const double p0 = r.solution.max_pressure;
    char most[60];
    snprintf(most, sizeof most, "max_pressure<=%.17g", 1.25 * p0);

    OWNED(rb_design) least = {.n = 0};
    CHECK_OK(design(c, "radius", "radius=20:200", most, &least, &message));
    CHECK_REL(least.value, 50.0 / (1.25 * 1.25), 1e-5, "R by p0");
    CHECK_REL(least.variable[0].value, least.value, 1e-15, "the input itself");
    CHECK_REL(least.start, 50.0, 1e-15, "where it began");
    assert_string_equal(rb_design_name(&least), "radius");
    assert_string_equal(rb_design_unit(&least), "mm");

    OWNED(rb_design) heavy = {.n = 0, .largest = 1};
    CHECK_OK(design(c, "load", "radius=20:80,load=100:9000", most, &heavy, &message));
    CHECK_REL(heavy.value, 500.0 * 1.25 * 1.25 * 80.0 / 50.0, 1e-5, "P by p0 and R");

    OWNED(rb_design) other = {.n = 0};
    rb_message why;
    CHECK_STATUS(design(c, "radius", "load=100:9000", most, &other, &why), RB_EINVAL);
    assert_non_null(strstr(why.text, "add radius=A:B to --over"));
}

/* Beyond 700 N/mm the contact leaves its zone: the search stays where solutions are, and
 * says why it does not go on. */
TEST(search_stays_where_solutions_are)
{
    held_case *c = case_of((const char *const[]){"support", "halfplane", "similar", "yes", "load",
                                                 "500", "mesh", "uniform", "zone", "1",
                                                 "contact-elements", "40", NULL});
    OWNED(rb_design) d = {.n = 0, .largest = 1};
    CHECK_STATUS(design(c, "max_pressure", "load=100:9000", NULL, &d, &message), RB_MAXITER);
    assert_true(d.variable[0].value > 600.0 && d.variable[0].value < 800.0);
    assert_non_null(strstr(message.text, "zone: the contact is not within"));
}

/* The values of a table of the gap: pressure that is the same all over the span. */
TEST(uniform_pressure)
{
    if (!is_in_turn(0, 6))
        skip();
    char path[] = "/tmp/rollbem-gap-XXXXXX";
    OWNED(rb_design) d = {.n = 0, .span = 5.0, .most = 900};
    FILE *f = fdopen(mkstemp(path), "w");
    fputs("x gap\n", f);
    for (int i = 0; i < 65; i++) {
        const double x = -8.0 + 0.25 * i;
        fprintf(f, "%.6f %.8f\n", x, 1e-4 * x * x + 0.1 * fmax(fabs(x) - 5.0, 0.0));
    }
    fclose(f);
    held_case *c = case_of((const char *const[]){"support", "halfplane", "similar", "yes", "load",
                                                 "5000", "mu", "0", "gap", path, "mesh", "uniform",
                                                 "zone", "6", "contact-elements", "48", NULL});
    CHECK_OK(design(c, "pressure_ripple", "gap=-0.1:0.1", NULL, &d, &message));
    print_message("# ripple %.2g of %.2g, %d evaluations\n", d.value, d.start, d.evaluations);
    assert_int_equal(d.n, 65);
    assert_true(d.start > 0.5);
    CHECK_MAX(d.value, 1e-3, "ripple");
    unlink(path);
}

TEST(what_is_refused)
{
    static const struct {
        const char *result, *over, *subject, *says;
    } bad[] = {{"max_presure", "radius=1:2", NULL, "max_pressure"},
               {"iterations", "radius=1:2", NULL, "expected a result that has derivatives"},
               {"dissipation", "radius=1:200", NULL, "this static case has no dissipation; see "},
               {"max_pressure", "", NULL, "--over"},
               {"max_pressure", "radius", NULL, "radius=A:B"},
               {"max_pressure", "radius=2:1", NULL, "A < B"},
               {"max_pressure", "radius=100:200", NULL, "within"},
               {"max_pressure", "radius=1:200,radius=1:200", NULL, "twice"},
               {"max_pressure", "contact-elements=1:200", NULL, "is not a number of this case"},
               {"max_pressure", "gap=-1:1", NULL, "table"},
               {"max_pressure", "radius=1:200", "half_width=3",
                "subject: expected RESULT<=X or RESULT>=X, got"},
               {"max_pressure", "radius=1:200", "half_width<=x", "x"},
               {"max_pressure", " radius=1:200", "load >= 1, half_width <= x", "load"},
               {"max_pressure", " radius=1:200 ", "half_width <= 1 mm, half_width >= x",
                "half_width: expected a number, got 'x'"},
               {"max_pressure", "radius=20:200", "half_width<=0.1", "constraints"}};
    rb_message why;
    held_case *c = case_of(hertz);
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        OWNED(rb_design) d = {.n = 0};
        const rb_status s = design(c, bad[k].result, bad[k].over, bad[k].subject, &d, &why);
        if (s == RB_OK || !strstr(why.text, bad[k].says))
            fail_msg("%s, %s: %s", bad[k].result, bad[k].over, why.text);
    }
}

int main(void)
{
    if (!rb_design_available()) {
        puts("[  SKIPPED ] designs: built without NLopt");
        return 0;
    }
    return run_all_tests(NULL, NULL);
}
