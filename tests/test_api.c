/* Opaque handles: descriptions are complete, refusals are those of the case, and the
 * arrays satisfy the equations that they stand for. */
#include "check.h"
#include "rollbem/api.h"
#include "analysis/sensitivity/derivatives.h"
#include "rolling/case/case.h"
#include "two_threads.h"

#include <signal.h>
#include <sys/time.h>

/* Sets options, "name value name value ...", until one is refused. */
static int give(rb_api *a, const char *options)
{
    char text[600], *rest = text;
    int s = RB_OK;
    assert_true(strlen(options) < sizeof text);
    strcpy(text, options);
    for (char *name; s == RB_OK && (name = strtok_r(rest, " ", &rest));)
        s = rb_api_set(a, name, strtok_r(NULL, " ", &rest));
    return s;
}

static rb_api *solved(const char *options)
{
    rb_api *a = NOT_NULL(rb_api_create());
    if (give(a, options) != RB_OK || rb_api_solve(a) != RB_OK)
        fail_msg("%s", rb_api_message(a));
    return a;
}

static const double *array(rb_api *a, const char *name, int rows, int columns)
{
    int r, c;
    const double *x = rb_api_array(a, name, &r, &c);
    if (!x || r != rows || c != columns)
        fail_msg("%s: %d x %d, want %d x %d", name, r, c, rows, columns);
    return x;
}

/* The wheel of the example on twelve elements: small enough to step through. */
static const char wheel[] = "mu 0.3 creep 0.1 contact-elements 12 outer-elements 24 solver lemke";
#define STEADY                                                                                     \
    "formulation steady support halfplane support-b halfplane similar yes load 500 mu 0.3 "
static const char steady[] = STEADY "creep-ratio 0.5 mesh uniform";

TEST(descriptions_are_complete)
{
    static const char *const fields[] = {"name", "section", "kind", "unit",    "expected", "from",
                                         "to",   "choices", "word", "default", "excludes", "help"};
    char text[400];
    int n, k;
    rb_case_describe(&n);
    for (k = 0; k < n; k++)
        for (size_t f = 0; f < sizeof fields / sizeof *fields; f++)
            assert_non_null(rb_api_option(k, fields[f], text, sizeof text));
    assert_null(rb_api_option(n, "name", text, sizeof text));
    assert_null(rb_api_option(-1, "name", text, sizeof text));
    assert_null(rb_api_option(1, "colour", text, sizeof text));
    for (const rb_rolling_result_table *t = rb_rolling_result_tables; t->name; t++) {
        for (k = 0; rb_api_result(t->name, k, "name", text, sizeof text); k++)
            assert_true(strlen(rb_api_result(t->name, k, "meaning", text, sizeof text)) > 0);
        assert_int_equal(k, t->results->n);
    }
    assert_string_equal(rb_api_result("wear", 0, "name", text, sizeof text), "way");
    assert_null(rb_api_result("nothing", 0, "name", text, sizeof text));
}

/* A caller that does not look at the status of each call must not get another case. */
TEST(what_was_refused_is_not_solved)
{
    held_api *a = rb_api_create();
    const char *const wrong[][2] = {
        {"load", "1,5"}, {"radius", "x"}, {"mu", "-1"}, {"load", "2,5"}};
    assert_int_equal(rb_api_set(a, "contact-elements", "12"), RB_OK);
    for (int k = 0; k < 4; k++)
        assert_true(rb_api_set(a, wrong[k][0], wrong[k][1]) < 0);
    assert_true(rb_api_solve(a) < 0);
    assert_string_equal(rb_api_message(a),
                        "--load: expected a number with a decimal point, 2.5; got '2,5'");
    assert_true(rb_api_curve(a, "creep-ratio", 0.0, 1.0, 3, NULL, NULL) < 0);
    assert_string_equal(rb_api_message(a),
                        "--load: expected a number with a decimal point, 2.5; got '2,5'");
    assert_true(isnan(rb_api_number(a, "normal_load")));
    assert_int_equal(rb_api_set(a, "load", "100"), RB_OK);
    assert_true(rb_api_solve(a) < 0);
    assert_int_equal(rb_api_set(a, "mu", "0.3"), RB_OK);
    assert_true(rb_api_solve(a) < 0);
    assert_string_equal(rb_api_message(a), "--radius: expected a number > 0, got 'x'");
    assert_int_equal(rb_api_set(a, "radius", "50"), RB_OK);
    assert_int_equal(rb_api_solve(a), RB_OK);
    CHECK_REL(rb_api_number(a, "normal_load"), 100.0, 1e-9, "load");
    assert_true(rb_api_read(a, "nowhere.ini") < 0);
    assert_true(rb_api_solve(a) < 0);
    assert_non_null(strstr(rb_api_message(a), "nowhere.ini"));
    for (int k = 0; k < 40; k++) { /* more than are kept */
        char name[20];
        snprintf(name, sizeof name, "option-%d", k);
        assert_true(rb_api_set(a, name, "1") < 0);
    }
    assert_true(rb_api_solve(a) < 0);
}

TEST(refusals_are_those_of_the_case)
{
    rb_api *a = rb_api_create();
    char text[40];
    assert_true(rb_api_set(a, "mu", "-1") < 0);
    assert_string_equal(rb_api_message(a), "--mu: expected a number >= 0, got '-1'");
    assert_true(rb_api_set(a, "nu", "1") < 0);
    assert_true(rb_api_pivots(a) < 0);
    rb_api_free(a);
    a = rb_api_create();
    assert_int_equal(rb_api_set(a, "load", "500"), RB_OK);
    assert_int_equal(rb_api_set(a, "approach", "1"), RB_OK);
    assert_true(rb_api_solve(a) < 0);
    assert_non_null(strstr(rb_api_message(a), "--load"));
    assert_true(isnan(rb_api_number(a, "normal_load")));
    assert_null(rb_api_value(a, "nothing", text, sizeof text));
    rb_api_free(a);
    rb_api_free(NULL);
}

/* Refusals of the case, and of what is asked of its solution. */
TEST(refusals_are_in_the_units_of_the_case)
{
    rb_api *a = NOT_NULL(rb_api_create());
    assert_int_equal(give(a, "units inch support halfplane load 1000 mu 0.3 force 400"), RB_OK);
    assert_true(rb_api_solve(a) < 0);
    assert_non_null(strstr(rb_api_message(a), "Q = 400 lbf/in"));
    rb_api_free(a);
    a = solved("units inch support halfplane young 1000 poisson 0.3 radius 100 layer-thickness 2 "
               "max-pressure 20 mu 0");
    assert_true(rb_api_derivatives(a) < 0);
    assert_non_null(strstr(rb_api_message(a), "At a fixed one: --load 65.01"));
    assert_non_null(strstr(rb_api_message(a), " lbf/in"));
    rb_api_free(a);
}

TEST(numbers_are_the_solution)
{
    held_api *a = solved(steady);
    const int n = 60;
    double P = 0.0, Q = 0.0;
    char text[40];
    const double *p = array(a, "p", n, 1), *q = array(a, "q", n, 1), *h = array(a, "h", n, 1);
    for (int i = 0; i < n; i++) {
        P += p[i] * h[i];
        Q += q[i] * h[i];
    }
    CHECK_REL(rb_api_number(a, "normal_load"), P, 1e-12, "P");
    CHECK_REL(rb_api_number(a, "tangential_load"), Q, 1e-12, "Q");
    CHECK_REL(rb_api_number(a, "carter"), 1.0, 0.0, "Carter's law holds");
    assert_true(isnan(rb_api_number(a, "nothing")));
    assert_string_equal(rb_api_value(a, "mu", text, sizeof text), "0.3");

    assert_int_equal(rb_api_curve(a, "creep-ratio", 0.0, 1.0, 5, NULL, NULL), RB_OK);
    const double *ratio = array(a, "curve.force_ratio", 5, 1);
    CHECK_ABS(ratio[0], 0.0, 1e-6, "free rolling");
    CHECK_REL(ratio[2], rb_api_number(a, "force_ratio"), 2e-2, "the case on its curve");

    assert_int_equal(rb_api_stress(a, 9, 7, 0.0), RB_OK);
    const double *syy = array(a, "stress.syy", 9, 7);
    CHECK_REL(-syy[4], rb_api_number(a, "max_pressure"), 2e-2, "under the pressure");
}

/* What is kept from solve to solve changes no bit, and other bodies are never mixed up. */
TEST(the_next_case_is_solved_as_the_first_one)
{
    static const char *const next[][2] = {
        {"mu", "0.4"}, {"creep", "0.05"}, {"mu", "0.2"}, {"approach", "20"}, {"young", "60000"},
        {"mu", "0.3"}, {"zone", "40"},    {"mu", "0.5"}, {"approach", "21"}};
    char words[600];
    size_t n = (size_t)snprintf(words, sizeof words, "%s", wheel);
    held_api *a = solved(wheel);
    for (size_t k = 0; k < sizeof next / sizeof *next; k++) {
        n += (size_t)snprintf(words + n, sizeof words - n, " %s %s", next[k][0], next[k][1]);
        assert_int_equal(rb_api_set(a, next[k][0], next[k][1]), RB_OK);
        assert_null(rb_api_array(a, "p", &(int){0}, &(int){0}));
        assert_true(isnan(rb_api_number(a, "normal_load")));
        assert_int_equal(rb_api_solve(a), RB_OK);
        held_api *anew = solved(words);
        const double *p = array(a, "p", 12, 1), *want = array(anew, "p", 12, 1);
        for (int i = 0; i < 12; i++)
            CHECK_ABS(p[i], want[i], 0.0, "p[%d] after %s", i, next[k][0]);
        CHECK_ABS(rb_api_number(a, "force_ratio"), rb_api_number(anew, "force_ratio"), 0.0,
                  "Q after %s", next[k][0]);
    }
}

/* Before each pivot: the ratios are not negative, the row that leaves has the least of
 * them, and the step is that least ratio. */
TEST(pivots_keep_the_ratio_test)
{
    held_api *a = solved(wheel);
    int size, pivots, r;
    char name[32];
    assert_int_equal(rb_api_pivots(a), RB_OK);
    const double *value = NOT_NULL(rb_api_array(a, "pivot.value", &size, &pivots));
    const double *before = array(a, "pivot.before", size, pivots),
                 *column = array(a, "pivot.column", size, pivots),
                 *row = array(a, "pivot.row", 1, pivots),
                 *ratio = array(a, "pivot.ratio", 1, pivots),
                 *entering = array(a, "pivot.entering", 1, pivots),
                 *z0 = array(a, "pivot.z0", 1, pivots);
    assert_int_equal(size, 36);
    assert_string_equal(rb_api_variable(a, (int)entering[0], name, sizeof name), "z0");
    assert_string_equal(rb_api_variable(a, size, name, sizeof name), "p[1]");
    assert_null(rb_api_variable(a, 2 * size + 1, name, sizeof name));
    for (int k = 1; k < pivots; k++) {
        const double *v = &before[k * size], *c = &column[k * size];
        r = (int)row[k];
        CHECK_REL(ratio[k], -v[r] / c[r], 1e-9, "pivot %d", k);
        for (int i = 0; i < size; i++)
            if (c[i] < -1e-9)
                CHECK_MAX(ratio[k], -v[i] / c[i] + 1e-9, "pivot %d row %d", k, i);
        for (int i = 0; i < size; i++)
            CHECK_ABS(v[i], value[(k - 1) * size + i], 0.0, "what was is kept");
    }
    CHECK_ABS(z0[pivots - 1], 0.0, 1e-12, "z0 at the end");
    static const char *const tractions[][2] = {{"pivot.p", "p"}, {"pivot.q", "q"}};
    for (int c = 0; c < 2; c++) {
        const double *last = array(a, tractions[c][0], 12, pivots) + 12 * (pivots - 1),
                     *own = array(a, tractions[c][1], 12, 1);
        for (int i = 0; i < 12; i++)
            CHECK_ABS(last[i], own[i], 1e-9 * rb_api_number(a, "max_pressure"), "%s[%d]",
                      tractions[c][1], i);
    }
}

/* The last step of Newton's method has the tractions of the solution, and each one those
 * of the zones that it assumes. */
TEST(newton_ends_in_the_solution)
{
    held_api *a = solved(wheel);
    int rows, steps;
    assert_int_equal(rb_api_newton(a), RB_OK);
    const double *zone = NOT_NULL(rb_api_array(a, "newton.zone", &rows, &steps));
    assert_int_equal(rows, 12);
    assert_true(steps > 2);
    const double *p = array(a, "newton.p", 12, steps), *q = array(a, "newton.q", 12, steps);
    const double *want_p = array(a, "p", 12, 1), *want_q = array(a, "q", 12, 1);
    for (int i = 0; i < 12; i++) {
        const int last = i + 12 * (steps - 1);
        CHECK_ABS(p[last], want_p[i], 1e-8 * rb_api_number(a, "max_pressure"), "p[%d]", i);
        CHECK_ABS(q[last], want_q[i], 1e-8 * rb_api_number(a, "max_pressure"), "q[%d]", i);
        for (int k = 0; k < steps; k++)
            if (zone[i + 12 * k] == 0.0)
                CHECK_ABS(p[i + 12 * k], 0.0, 0.0, "element %d apart in step %d", i, k);
    }
}

TEST(matrices_satisfy_their_equations)
{
    held_api *a = solved(wheel);
    int m, columns;
    const double *H = NOT_NULL(rb_api_array(a, "H", &m, &columns));
    assert_int_equal(m, columns);
    assert_non_null(array(a, "G", m, m));
    assert_non_null(array(a, "mesh.x0", m / 2, 1));
    for (int i = 0; i < m; i++) { /* rigid motion along x */
        double sum = 0.0;
        for (int j = 0; j < m; j += 2)
            sum += H[i + m * j];
        CHECK_ABS(sum, 0.0, 1e-9, "row %d", i);
    }
    /* w = F r: the gap of the solution (K1) */
    const double *F = array(a, "F", 26, 24), *p = array(a, "p", 12, 1), *q = array(a, "q", 12, 1),
                 *gap = array(a, "gap", 12, 1), *gap0 = array(a, "gap0", 12, 1);
    for (int i = 0; i < 12; i++) {
        double w = gap0[i] - rb_api_number(a, "approach");
        for (int j = 0; j < 12; j++)
            w += F[i + 26 * j] * p[j] + F[i + 26 * (12 + j)] * q[j];
        CHECK_ABS(gap[i], w, 1e-9 * rb_api_number(a, "approach"), "gap %d", i);
    }
}

TEST(guesses_are_judged)
{
    held_api *a = solved(wheel);
    int zone[12];
    const double *is = array(a, "zone", 12, 1);
    for (int i = 0; i < 12; i++)
        zone[i] = (int)is[i];
    assert_int_equal(rb_api_guess(a, 12, zone), RB_OK);
    static const char *const guessed[] = {"guess.p", "guess.q", "guess.gap"}, *const found[] = {
                                                                                  "p", "q", "gap"};
    const double most[] = {rb_api_number(a, "max_pressure"), rb_api_number(a, "max_pressure"),
                           rb_api_number(a, "approach")};
    for (int k = 0; k < 3; k++) {
        const double *guess = array(a, guessed[k], 12, 1), *is_so = array(a, found[k], 12, 1);
        for (int i = 0; i < 12; i++)
            CHECK_ABS(guess[i], is_so[i], 1e-9 * most[k], "%s[%d]", found[k], i);
    }
    const double *ends = array(a, "ends", 14, 1), *x = array(a, "x", 12, 1);
    for (int i = 0; i < 12; i++)
        CHECK_ABS(0.5 * (ends[i] + ends[i + 1]), x[i], 1e-3 * (ends[i + 1] - ends[i]),
                  "midpoint %d", i);

    for (int i = 0; i < 12; i++) /* everything pressed: the ends would have to pull */
        zone[i] = RB_ZONE_STICK;
    assert_int_equal(rb_api_guess(a, 12, zone), RB_OK);
    assert_true(array(a, "guess.p", 12, 1)[0] < 0.0);
    assert_true(rb_api_guess(a, 11, zone) < 0);
}

TEST(steps_are_kept)
{
    static const char words[] = "support halfplane similar yes load 500 mu 0.3 creep-ratio 0.5 "
                                "formulation transient distance 1 contact-elements 20";
    held_api *a = solved(words);
    int n, steps;
    const double *p = NOT_NULL(rb_api_array(a, "step.p", &n, &steps));
    const double *load = array(a, "history.normal_load", steps, 1), *h = array(a, "h", n, 1),
                 *x = array(a, "step.x", n, 1), *last = array(a, "x", n, 1);
    for (int i = 0; i < n; i++)
        CHECK_ABS(x[i], last[i], 1e-12, "element %d", i);
    for (int k = 0; k < steps; k++) {
        double P = 0.0;
        for (int i = 0; i < n; i++)
            P += p[k * n + i] * h[i];
        CHECK_REL(load[k], P, 1e-9, "step %d", k);
    }
}

/* Runs for error bars are steps that nobody sees. */
TEST(steps_have_error_bars)
{
    static const char words[] = "support halfplane similar yes load 500 mu 0.3 creep-ratio 0.5 "
                                "formulation transient distance 0.5 contact-elements 16 error yes";
    held_api *a = solved(words);
    int n, steps;
    assert_non_null(rb_api_array(a, "step.p", &n, &steps));
    const double *bar = array(a, "history.error.tangential_load", steps, 1);
    assert_true(bar[steps - 1] > 0.0);
    assert_true(rb_api_stress(a, 5, 5, 0.0) == RB_OK);
}

/* The notes of the program, one by one, and Carter's tractions where his law holds. */
TEST(notes_and_closed_forms)
{
    char text[200];
    int rows, columns;
    held_api *a = rb_api_create();
    assert_null(rb_api_note(a, 0, text, sizeof text));
    assert_int_equal(give(a, "support halfplane support-b halfplane similar yes formulation steady "
                             "load 500 mu 0.3"),
                     RB_OK);
    assert_int_equal(rb_api_solve(a), RB_OK);
    assert_non_null(strstr(rb_api_note(a, 0, text, sizeof text), "rolls at creepage 0"));
    assert_null(rb_api_note(a, 1, text, sizeof text));
    assert_null(rb_api_note(a, -1, text, sizeof text));
    assert_int_equal(rb_api_set(a, "creep-ratio", "0.5"), RB_OK);
    assert_int_equal(rb_api_solve(a), RB_OK);
    assert_null(rb_api_note(a, 0, text, sizeof text));
    const double highest = rb_api_number(a, "max_pressure");
    for (int k = 0; k < 2; k++) {
        double worst = 0.0;
        const double *closed = rb_api_array(a, k ? "closed.q" : "closed.p", &rows, &columns);
        const double *solved = rb_api_array(a, k ? "q" : "p", &rows, &columns);
        assert_non_null(closed);
        for (int i = 0; i < rows; i++)
            worst = fmax(worst, fabs(closed[i] - solved[i]));
        if (worst > 0.01 * highest) /* at an element of the edge or beside stick */
            fail_msg("closed form %d: off by %g of %g", k, worst, highest);
    }
    assert_null(rb_api_array(a, "closed.x", &rows, &columns));
}

TEST(results_of_every_table_are_there)
{
    held_api *a = rb_api_create_for("solve");
    assert_null(rb_api_create_for("nothing"));
    assert_string_equal(rb_version(), RB_VERSION);
    assert_int_equal(give(a, steady), RB_OK);
    assert_int_equal(rb_api_set(a, "error", "yes"), RB_OK);
    assert_null(rb_api_word(a, "formulation"));
    assert_int_equal(rb_api_solve(a), RB_OK);
    assert_string_equal(rb_api_word(a, "formulation"), "steady");
    assert_string_equal(rb_api_word(a, "status"), "solved");
    assert_non_null(rb_api_word(a, "solver"));
    assert_true(rb_api_number(a, "error.tangential_load") > 0.0);
    assert_true(isnan(rb_api_number(a, "error.iterations")));
    CHECK_REL(array(a, "patch.normal_load", 1, 1)[0], rb_api_number(a, "normal_load"), 1e-12,
              "one patch has it all");
    assert_non_null(array(a, "friction_power", 60, 1));
    assert_true(rb_api_stress(a, 5, 5, 0.0) < 0);
    assert_non_null(strstr(rb_api_message(a), "without error bars"));

    assert_int_equal(rb_api_curve(a, "creep", 0.0, 1e-3, 4, NULL, NULL), RB_OK);
    CHECK_REL(array(a, "curve.creepage", 4, 1)[3], 1e-3, 1e-15, "over creepages");
    assert_true(array(a, "curve.error.force_ratio", 4, 1)[1] > 0.0);
    CHECK_ABS(rb_api_number(a, "curve.free_creepage"), 0.0, 1e-9, "similar bodies");
    assert_true(rb_api_curve(a, "slip", 0.0, 1.0, 3, NULL, NULL) < 0);
}

/* A curve over the speed refuses options that one over the creepage takes, and the handle
 * goes on. */
TEST(a_refused_curve_leaves_the_solution)
{
    static const char words[] = "support halfplane similar yes load 500 formulation steady "
                                "relaxation-time 1e-3 relaxation-ratio 1 speed 100";
    held_api *a = rb_api_create_for("curve");
    assert_int_equal(give(a, words), RB_OK);
    assert_int_equal(rb_api_solve(a), RB_OK);
    assert_true(rb_api_curve(a, "speed", 1.0, 1e3, 3, NULL, NULL) < 0);
    assert_int_equal(rb_api_derivatives(a), RB_OK);
    assert_true(isfinite(rb_api_number(a, "max_pressure")));
    int rows, columns;
    assert_non_null(rb_api_array(a, "derivative.max_pressure", &rows, &columns));
    assert_int_equal(rb_api_tolerances(a, "load=1%"), RB_OK);
    assert_int_equal(rb_api_solve(a), RB_OK);
}

/* Place of an input among those of rb_api_derivatives. */
static int place_of(const rb_api *a, const char *input)
{
    char name[40];
    int k = 0;
    while (rb_api_input(a, k, "name", name, sizeof name) && strcmp(name, input) != 0)
        k++;
    return k;
}

/* Tolerances do not depend on the derivatives that were asked for before. */
TEST(tolerances_take_smooth_derivatives)
{
    held_api *a = rb_api_create_for("solve");
    assert_int_equal(give(a, steady), RB_OK);
    assert_int_equal(rb_api_set(a, "mesh", "aligned"), RB_OK);
    assert_int_equal(rb_api_solve(a), RB_OK);
    assert_int_equal(rb_api_tolerances(a, "mu=1%"), RB_OK);
    const double first = array(a, "tolerance.tangential_load", 1, 1)[0];
    assert_int_equal(rb_api_derivatives(a), RB_OK);
    assert_int_equal(rb_api_tolerances(a, "mu=1%"), RB_OK);
    assert_true(array(a, "tolerance.tangential_load", 1, 1)[0] == first);
    assert_int_equal(rb_api_smooth_derivatives(a), RB_OK);
    assert_int_equal(rb_api_tolerances(a, "mu=1%"), RB_OK);
    assert_true(array(a, "tolerance.tangential_load", 1, 1)[0] == first);
    int rows, columns;
    assert_int_equal(rb_api_smooth_derivatives(a), RB_OK);
    const double *by = NOT_NULL(rb_api_array(a, "derivative.tangential_load", &rows, &columns));
    CHECK_REL(first, 0.01 * 0.3 * fabs(by[2 * place_of(a, "mu")]), 1e-12, "smooth");
}

/* First order: with the input's deviation, however large or small. */
TEST(tolerances_grow_with_the_deviation)
{
    held_api *a = solved(steady);
    assert_int_equal(rb_api_tolerances(a, "load=1"), RB_OK);
    const double of_one = array(a, "tolerance.max_pressure", 1, 1)[0];
    assert_true(of_one > 0.0);
    assert_int_equal(rb_api_tolerances(a, "load=1e300"), RB_OK);
    CHECK_REL(array(a, "tolerance.max_pressure", 1, 1)[0], 1e300 * of_one, 1e-12, "large");
    assert_int_equal(rb_api_tolerances(a, "load=1e-300"), RB_OK);
    CHECK_REL(array(a, "tolerance.max_pressure", 1, 1)[0], 1e-300 * of_one, 1e-12, "small");
}

/* What the models, the curve, the history and a problem alone are asked by name. */
TEST(every_name_has_its_value)
{
    static const char rolls[] = "support halfplane load 500 creep-ratio 0.5 formulation transient "
                                "distance 0.5 contact-elements 12 lcp-form kwak solver lemke";
    static const double M = 2.0, q = -4.0, W = 1.0, v = -1.0, mu = 0.3;
    held_api *a = solved(rolls);
    const double R = 50.0, E = 94500.0 / (1.0 - 0.1 * 0.1), P = 500.0;
    const double width = sqrt(4.0 * P * R / (3.14159265358979323846 * E));
    CHECK_REL(rb_api_number(a, "radius"), R, 1e-14, "radius");
    CHECK_REL(rb_api_number(a, "modulus"), E, 1e-12, "modulus");
    CHECK_REL(rb_api_number(a, "hertz_load"), P, 1e-12, "load");
    CHECK_REL(rb_api_number(a, "history.half_width"), width, 1e-9, "unit of distances");
    assert_true(isnan(rb_api_number(a, "curve.half_width")));
    assert_string_equal(rb_api_word(a, "lcp-form"), "kwak");
    assert_string_equal(rb_api_word(a, "solver"), "lemke");
    assert_null(rb_api_word(a, "colour"));
    assert_null(rb_api_array(a, "mesh.x0", &(int){0}, &(int){0})); /* a half-plane */
    assert_true(rb_api_stress_at(a, 0, &M) < 0);
    assert_non_null(strstr(rb_api_message(a), "at least one point, got 0"));
    assert_int_equal(rb_api_curve(a, "creep-ratio", 0.0, 1.0, 3, NULL, NULL), RB_OK);
    CHECK_REL(rb_api_number(a, "curve.half_width"), width, 1e-9, "of the curve");

    assert_int_equal(rb_api_lcp(a, 1, &M, &q, "lemke", 0), RB_OK);
    assert_string_equal(rb_api_word(a, "task.solver"), "lemke");
    CHECK_ABS(rb_api_number(a, "task.iterations"), 2.0, 0.0, "z0, then z");
    CHECK_ABS(rb_api_number(a, "task.residual"), 0.0, 1e-15, "2 z = 4");
    assert_true(rb_api_lcp(a, -1, &M, &q, "lemke", 0) < 0);
    assert_int_equal(rb_api_lcp(a, 1, &M, &q, "lemke", 0), RB_OK);
    assert_int_equal(rb_api_friction(a, 1, 1, &W, &v, &mu, "auto", 1e-10, 0), RB_EINVAL);
    CHECK_ABS(rb_api_number(a, "task.iterations"), 0.0, 0.0, "none of the problem before");
    assert_true(rb_api_read(a, "nothing.ini") < 0);
    assert_non_null(strstr(rb_api_message(a), "nothing.ini"));
}

TEST(zones_of_a_yielding_interface_are_no_guess)
{
    static const char words[] = "support halfplane load 500 formulation steady creep-ratio 0.5 "
                                "yield-stress 10 contact-elements 12 zone 2";
    held_api *a = solved(words);
    const int zone[12] = {0};
    assert_true(rb_api_guess(a, 12, zone) < 0);
    assert_non_null(strstr(rb_api_message(a), "--yield-stress"));
    assert_int_equal(rb_api_set(a, "mu", "0.1"), RB_OK);
    assert_true(rb_api_guess(a, 12, zone) < 0); /* not solved since */
}

TEST(stress_is_known_at_points)
{
    held_api *a = solved(steady);
    assert_int_equal(rb_api_stress(a, 9, 7, 0.0), RB_OK);
    const double x = array(a, "stress.x", 9, 7)[30], y = array(a, "stress.y", 9, 7)[30],
                 shear = array(a, "stress.max_shear", 9, 7)[30], xy[] = {x, y};
    assert_int_equal(rb_api_stress_at(a, 1, xy), RB_OK);
    CHECK_REL(array(a, "stress.max_shear", 1, 1)[0], shear, 1e-12, "point of the grid");
    assert_int_equal(rb_api_stress_maxima(a, 0.0), RB_OK);
    const double *most = array(a, "maxima.max_shear", 4, 1);
    assert_true(most[0] >= shear);
    assert_int_equal(rb_api_stress_at(a, 1, most + 1), RB_OK);
    CHECK_REL(array(a, "stress.max_shear", 1, 1)[0], most[0], 1e-9, "at its place");
}

TEST(problems_by_themselves_are_solved)
{
    static const double M[] = {2, 1, 1, 2}, q[] = {-5, -6};
    static const double W[] = {2, 0, 0, 0, 1, 0, 0, 0, 1}, v[] = {-1, 0.1, 0.4}, mu = 0.3;
    held_api *a = rb_api_create();
    for (int k = 0; k < 2; k++) {
        assert_int_equal(rb_api_lcp(a, 2, M, q, k ? "newton" : "lemke", 0), RB_OK);
        const double *z = array(a, "lcp.z", 2, 1), *w = array(a, "lcp.w", 2, 1);
        for (int i = 0; i < 2; i++) {
            CHECK_REL(w[i] + 1.0, M[i] * z[0] + M[i + 2] * z[1] + q[i] + 1.0, 1e-14, "w");
            CHECK_ABS(fmin(z[i], w[i]), 0.0, 1e-14, "complementary");
        }
    }
    assert_true(rb_api_lcp(a, 2, M, q, "gauss", 0) < 0);
    assert_int_equal(rb_api_lcp(a, 2, M, q, "lemke", 1), RB_MAXITER);

    assert_int_equal(rb_api_friction(a, 3, 1, W, v, &mu, "auto", 1e-10, 0), RB_OK);
    const double *r = array(a, "friction.r", 3, 1), *u = array(a, "friction.u", 3, 1);
    const double slip = hypot(u[1], u[2]);
    CHECK_REL(r[0], 0.5, 1e-9, "pressed");
    for (int i = 1; i < 3; i++) /* friction opposes the slip */
        CHECK_ABS(r[i], -mu * r[0] * u[i] / slip, 1e-9, "r[%d]", i);
    assert_true(rb_api_friction(a, 4, 1, W, v, &mu, "auto", 1e-8, 0) < 0);
    assert_true(rb_api_friction_file(a, "nothing.hdf5", "auto", 1e-8, 0) == RB_ENOENT);
    assert_int_equal(rb_api_friction_file(a, "tests/fuzz/fclib/local", "auto", 1e-8, 0), RB_OK);
    CHECK_MAX(rb_api_number(a, "task.scaled_residual"), 1e-8, "of a file");
}

/* In compressed columns, with bounds, a start and a time limit; all solutions; games. */
TEST(sparse_problems_and_games_are_solved)
{
    static const int p[] = {0, 2, 4}, rows[] = {0, 1, 0, 1}, wrong[] = {0, 2, 0, 1};
    static const double x[] = {2.0, 1.0, 1.0, 2.0}, q[] = {-5.0, -6.0}, upper[] = {1.0, INFINITY},
                        lower[] = {0.0, 0.0}, M[] = {1.0, 3.0, 3.0, 1.0}, two[] = {-2.0, -3.0},
                        A[] = {3.0, 5.0, 0.0, 1.0}, B[] = {3.0, 0.0, 5.0, 1.0}, zeros[4] = {0.0};
    static const int columns[] = {0, 1, 2}, diagonal[] = {0, 1};
    static const double ones[] = {1.0, 1.0}, push[] = {-1.0, 0.5}, mu = 0.3;
    held_api *a = rb_api_create();
    int n, count;

    assert_int_equal(rb_api_lcp_sparse(a, 2, p, rows, x, q, lower, upper, ones, "auto", 0, 5.0),
                     RB_OK);
    CHECK_ABS(array(a, "lcp.z", 2, 1)[0], 1.0, 1e-12, "at its upper bound");
    CHECK_ABS(array(a, "lcp.z", 2, 1)[1], 2.5, 1e-12, "between");
    assert_int_equal(rb_api_lcp_sparse(a, 2, p, wrong, x, q, NULL, NULL, NULL, "auto", 0, 0.0),
                     RB_EINVAL);
    assert_non_null(strstr(rb_api_message(a), "column 1: row 2"));
    assert_int_equal(rb_api_lcp_sparse(a, 2, p, rows, x, q, NULL, NULL, NULL, "x", 0, 0.0),
                     RB_EINVAL);
    assert_int_equal(rb_api_lcp_all(a, 2, M, two, NULL, NULL, 0.0), RB_OK);
    assert_non_null(rb_api_array(a, "lcp.all", &n, &count));
    assert_int_equal(count, 3);
    assert_int_equal(rb_api_lcp_all(a, 2, zeros, two, NULL, NULL, 0.0), RB_NO_SOLUTION);
    assert_string_equal(rb_api_word(a, "status"), "no solution");
    assert_int_equal(rb_api_game(a, 2, 2, A, B, -1, 0, 0, 0.0), RB_OK);
    CHECK_ABS(array(a, "game.z", 4, 1)[1], 1.0, 1e-12, "both confess");
    CHECK_ABS(array(a, "game.payoff", 2, 1)[0], 1.0, 1e-12, "payoff");
    assert_int_equal(rb_api_game(a, 2, 2, A, B, -1, 1, 0, 0.0), RB_OK);
    assert_non_null(rb_api_array(a, "game.all", &n, &count));
    assert_int_equal(count, 1);
    assert_int_equal(rb_api_game(a, 0, 2, A, B, -1, 0, 0, 0.0), RB_EINVAL);
    enum { LARGE = 11 };
    double payoffs[LARGE * LARGE];
    for (int k = 0; k < LARGE * LARGE; k++)
        payoffs[k] = sin(k * k);
    assert_int_equal(rb_api_game(a, LARGE, LARGE, payoffs, payoffs, -1, 1, 0, 1e-4), RB_TIME_LIMIT);
    assert_int_equal(
        rb_api_friction_sparse(a, 2, 1, columns, diagonal, ones, push, &mu, "auto", 1e-8, 0),
        RB_OK);
    CHECK_ABS(array(a, "friction.r", 2, 1)[1], -0.3, 1e-9, "it slides");
}

TEST(a_sweep_is_its_cases)
{
    static const char *const mu[] = {"0.1", "0.2", "0.4"};
    rb_api *study = rb_api_create_for("sweep"), *one[3];
    for (int k = 0; k < 3; k++) {
        one[k] = rb_api_create_for("sweep");
        assert_int_equal(give(one[k], steady), RB_OK);
        assert_int_equal(rb_api_set(one[k], "mu", mu[k]), RB_OK);
    }
    assert_int_equal(rb_api_sweep(study, 3, one, NULL, NULL, 2), RB_OK);
    const double *Q = array(study, "sweep.tangential_load", 3, 1);
    for (int k = 0; k < 3; k++) {
        assert_int_equal(rb_api_solve(one[k]), RB_OK);
        CHECK_ABS(Q[k], rb_api_number(one[k], "tangential_load"), 0.0, "case %d", k);
        CHECK_ABS(array(study, "sweep.status", 3, 1)[k], RB_OK, 0.0, "case %d", k);
    }
    char name[100];
    assert_int_equal(
        rb_api_sweep(study, 3, one, "tangential_load:mu,max_pressure:load", "mu=10%,load=5", 2),
        RB_OK);
    assert_string_equal(rb_api_derivative(study, "sweep", 1, "name", name, sizeof name),
                        "max_pressure:load");
    assert_string_equal(rb_api_derivative(study, "sweep", 1, "unit", name, sizeof name), "N/mm");
    assert_null(rb_api_derivative(study, "sweep", 2, "name", name, sizeof name));
    assert_null(rb_api_derivative(study, "sweep", 1, "colour", name, sizeof name));
    assert_null(rb_api_derivative(study, "wear", 0, "name", name, sizeof name));
    const double *slope = array(study, "sweep.derivative.tangential_load:mu", 3, 1);
    for (int k = 0; k < 3; k++) {
        int rows, inputs, of_mu = 0;
        assert_int_equal(rb_api_solve(one[k]), RB_OK);
        assert_int_equal(rb_api_derivatives(one[k]), RB_OK);
        while (strcmp(rb_api_input(one[k], of_mu, "name", name, sizeof name), "mu") != 0)
            of_mu++;
        const double *d = rb_api_array(one[k], "derivative.tangential_load", &rows, &inputs);
        CHECK_ABS(slope[k], d[2 * of_mu + 1], 1e-12 * fabs(slope[k]), "case %d", k);
        assert_int_equal(rb_api_tolerances(one[k], "mu=10%,load=5"), RB_OK);
        CHECK_REL(array(study, "sweep.tolerance.tangential_load", 3, 1)[k],
                  *array(one[k], "tolerance.tangential_load", 1, 1), 1e-12, "case %d", k);
    }
    const double alone = 0.004 * fabs(slope[2]);
    assert_int_equal(rb_api_sweep(study, 3, one, NULL, "mu=1%", 2), RB_OK);
    CHECK_REL(array(study, "sweep.tolerance.tangential_load", 3, 1)[2], alone, 1e-12,
              "by mu alone");
    int rows, columns;
    assert_null(rb_api_array(study, "sweep.tolerance.iterations", &rows, &columns));
    assert_null(rb_api_derivative(study, "sweep", 0, "name", name, sizeof name));
    assert_int_equal(rb_api_sweep(study, 3, one, "nonsense", NULL, 2), RB_EINVAL);
    assert_int_equal(rb_api_sweep(study, 3, one, NULL, "zone=1", 2), RB_EINVAL);
    assert_int_equal(rb_api_sweep(study, 3, one,
                                  "all:mu,all:load,all:radius,all:young,"
                                  "all:poisson",
                                  "mu=1%", 2),
                     RB_EINVAL);
    assert_non_null(strstr(rb_api_message(study), "128 columns"));
    assert_int_equal(rb_api_set(one[1], "approach", "1"), RB_OK);
    assert_true(rb_api_sweep(study, 3, one, NULL, NULL, 2) < 0);
    assert_non_null(strstr(rb_api_message(study), "case 2: --approach and --load"));
    assert_int_equal(rb_api_set(one[0], "error", "yes"), RB_OK);
    assert_true(rb_api_sweep(study, 3, one, NULL, NULL, 2) < 0);
    assert_non_null(strstr(rb_api_message(study), "case 1: error: these studies have no"));
    for (int k = 0; k < 3; k++)
        rb_api_free(one[k]);
    rb_api_free(study);
}

/* Data of Carter's law at mu = 0.25 with an offset. */
TEST(fits_by_handle)
{
    enum { N = 12 };
    static const char *const columns[] = {"creep", "force_over_load", "test"};
    static const char *const wrong[] = {"creep", "forse", "test"};
    static const char plane[] = "support halfplane support-b halfplane similar yes load 500";
    double data[3 * N] = {0};
    held_api *a = rb_api_create();
    assert_int_equal(give(a, plane), RB_OK);
    assert_int_equal(rb_api_solve(a), RB_OK);
    const double half = rb_api_number(a, "hertz_half_width");
    for (int k = 0; k < N; k++) {
        data[k] = -0.5e-3 * (k + 1);
        const double s = fmin((-data[k] - 1e-4) * rb_api_number(a, "radius") / (0.25 * half), 1.0);
        data[k + N] = 0.25 * s * (2.0 - s);
    }
    const char *unknown = "mou", *names = "mu,creep-offset";
    assert_int_equal(rb_api_fit(a, 3, columns, N, data, unknown, NULL, NULL, NAN, 0.95), RB_EINVAL);
    assert_non_null(strstr(rb_api_message(a), "(did you mean 'mu'?)"));
    assert_int_equal(rb_api_fit(a, 3, wrong, N, data, names, NULL, NULL, NAN, 0.95), RB_EFORMAT);
    assert_non_null(strstr(rb_api_message(a), "unknown column 'forse' (did you mean 'force'?)"));
    assert_int_equal(rb_api_fit(a, 3, columns, N, data, names, "mu=0.3", "mu=0.1:0.6", NAN, 0.95),
                     RB_OK);
    CHECK_REL(array(a, "fit.value", 2, 1)[0], 0.25, 5e-3, "mu");
    CHECK_REL(array(a, "fit.value", 2, 1)[1], 1e-4, 0.1, "offset");
    for (int k = 0; k < N; k++)
        CHECK_ABS(array(a, "fit.fitted", N, 1)[k], data[k + N], 5e-3, "point %d", k);
    CHECK_ABS(array(a, "fit.force_over_load", N, 1)[3], data[3 + N], 0.0, "as given");
    CHECK_ABS(array(a, "fit.correlation", 2, 2)[1], array(a, "fit.correlation", 2, 2)[2], 1e-12,
              "symmetric");
    CHECK_ABS(*array(a, "fit.degrees_of_freedom", 1, 1), N - 2, 0.0, "degrees of freedom");
    assert_string_equal(rb_api_word(a, "fit.sentences"), "");
    assert_null(rb_api_word(a, "design.variables"));
    /* it stays the case that was solved */
    CHECK_REL(rb_api_number(a, "hertz_half_width"), half, 1e-12, "solved case");
    data[4 + N] = NAN;
    assert_int_equal(rb_api_fit(a, 3, columns, N, data, names, NULL, NULL, NAN, 0.95), RB_EFORMAT);
    assert_string_equal(rb_api_message(a), "data, row 5: force: expected a finite number, got nan");
    int rows, n;
    assert_null(rb_api_array(a, "fit.value", &rows, &n));
    assert_int_equal(rb_api_fit(a, 3, columns, 1, data, "mu", NULL, NULL, NAN, 0.95), RB_EINVAL);
    assert_non_null(strstr(rb_api_message(a), "expected at least 2 points for 1 number, got 1"));
    assert_int_equal(rb_api_fit(a, 3, columns, 0, data, "mu", NULL, NULL, NAN, 0.95), RB_EINVAL);
    assert_int_equal(rb_api_fit(a, 1, columns, N, data, "mu", NULL, NULL, NAN, 0.95), RB_EFORMAT);
    assert_int_equal(rb_api_fit(a, 3, columns, N, data, "mu", NULL, NULL, NAN, 1.0), RB_EINVAL);
    assert_string_equal(rb_api_message(a), "--level: expected a number in (0, 1), got 1");
    assert_int_equal(rb_api_fit(a, 3, columns, N, data, "mu", NULL, NULL, 0.0, 0.9), RB_EINVAL);
    assert_int_equal(rb_api_fit_file(a, "/no/such", "mu", NULL, NULL, NAN, 0.95), RB_ENOENT);
    /* twice the standard deviation of each force, twice that of the number, in any unit */
    double deviation[3];
    for (int k = 0; k < 3; k++) {
        held_api *of = rb_api_create();
        const char *const words[] = {"units",     k == 2 ? "si" : "mm",
                                     "support",   "halfplane",
                                     "similar",   "yes",
                                     "support-b", "halfplane",
                                     "radius",    k == 2 ? "0.3" : "300",
                                     "load",      k == 2 ? "500000" : "500",
                                     "young",     k == 2 ? "2.1e11" : "2.1e5"};
        for (size_t w = 0; w < sizeof words / sizeof *words; w += 2)
            assert_int_equal(rb_api_set(of, words[w], words[w + 1]), RB_OK);
        data[4 + N] = 0.2;
        const char *const force[] = {"creep", "force", "test"};
        const double sigma = k == 0 ? 1.0 : k == 1 ? 2.0 : 1000.0;
        double in[3 * N];
        for (int i = 0; i < 3 * N; i++)
            in[i] = i / N == 1 ? data[i] * (k == 2 ? 500000.0 : 500.0) : data[i];
        assert_int_equal(rb_api_fit(of, 3, force, N, in, "load", NULL,
                                    k == 2 ? "load=300000:700000" : "load=300:700", sigma, 0.95),
                         RB_OK);
        deviation[k] = array(of, "fit.deviation", 1, 1)[0];
    }
    CHECK_REL(deviation[1], 2.0 * deviation[0], 1e-9, "sigma");
    CHECK_REL(deviation[2], 1000.0 * deviation[0], 1e-6, "in SI");
}

/* Whatever allocation fails, the call says so and the handle goes on. */
TEST(fits_and_designs_without_memory)
{
    static const char *const columns[] = {"creep", "force_over_load"};
    static const double data[] = {-1e-3, -2e-3, -3e-3, -4e-3, 0.1, 0.17, 0.22, 0.25};
    int failures[2] = {0};
    for (int of = 0; of < 2; of++)
        for (int count = 0;; count += count < 60 ? 1 : 37) {
            rb_api *a = rb_api_create();
            assert_int_equal(give(a, of ? steady : STEADY), RB_OK);
            assert_int_equal(rb_api_set(a, "contact-elements", "12"), RB_OK);
            alloc_fail_after(count);
            const int s =
                of == 0
                    ? rb_api_fit(a, 2, columns, 4, data, "mu", "mu=0.3", "mu=0.1:1", 0.01, 0.9)
                    : rb_api_design(a, "max_pressure", 0, "radius=20:400", "half_width<=2", NAN, 3);
            const int failed = alloc_failed();
            alloc_succeed();
            char said[700];
            snprintf(said, sizeof said, "%s", rb_api_message(a));
            const int unavailable = s == RB_EINVAL && strstr(rb_api_message(a), "without NLopt");
            rb_api_free(a);
            if (!failed || unavailable)
                break;
            if (s != RB_ENOMEM && s != RB_OK && s != RB_MAXITER)
                fail_msg("call %d, allocation %d: %d: %s", of, count, s, said);
            failures[of] += s == RB_ENOMEM;
        }
    assert_true(failures[0] > 20 && (failures[1] == 0 || failures[1] > 40));
}

TEST(designs_by_handle)
{
    rb_api *a = rb_api_create();
    int rows, columns;
    assert_int_equal(give(a, steady), RB_OK);
    const int found =
        rb_api_design(a, "max_pressure", 0, "radius=20:400", "half_width<=1.2", NAN, 100);
    if (found == RB_EINVAL && strstr(rb_api_message(a), "without NLopt")) {
        rb_api_free(a);
        skip();
    }
    assert_int_equal(found, RB_OK);
    assert_string_equal(rb_api_word(a, "design.variables"), "radius");
    assert_string_equal(rb_api_word(a, "design.constraints"), "half_width");
    const double *subject = array(a, "design.constraint", 1, 3);
    CHECK_ABS(subject[0], 0.0, 0.0, "<=");
    CHECK_ABS(subject[1], 1.2, 0.0, "bound");
    CHECK_REL(subject[2], 1.2, 1e-5, "at its bound");
    char radius[40];
    snprintf(radius, sizeof radius, "%.17g", array(a, "design.value", 1, 1)[0]);
    const double pressure = *array(a, "design.result", 1, 1);
    assert_int_equal(rb_api_set(a, "radius", radius), RB_OK);
    assert_null(rb_api_word(a, "design.variables")); /* of another case */
    assert_int_equal(rb_api_solve(a), RB_OK);
    CHECK_REL(rb_api_number(a, "max_pressure"), pressure, 1e-9, "of the case found");
    assert_int_equal(rb_api_design(a, "max_presure", 0, "radius=20:400", NULL, NAN, 9), RB_EINVAL);
    assert_non_null(strstr(rb_api_message(a), "did you mean 'max_pressure'?"));
    assert_int_equal(rb_api_design(a, "max_pressure", 0, "radius=20:30", NULL, NAN, 9), RB_EINVAL);
    assert_int_equal(rb_api_design(a, "max_pressure", 1, "radius=20:400", NULL, NAN, 0), RB_EINVAL);
    assert_int_equal(rb_api_design(a, "max_pressure", 1, "radius=20:400", NULL, NAN, 100001),
                     RB_EINVAL);
    assert_string_equal(rb_api_message(a),
                        "--evaluations: expected a whole number in [1, 100000], got 100001");
    assert_int_equal(rb_api_design(a, "max_pressure", 1, "radius=20:400", NULL, 0.0, 9), RB_EINVAL);
    assert_int_equal(rb_api_design(a, "max_pressure", 0, "radius=20:400",
                                   "half_width<=0.5,half_width>=1", NAN, 50),
                     RB_INACCURATE);
    assert_null(rb_api_array(a, "design.value", &rows, &columns));
    assert_int_equal(rb_api_set(a, "radius", "-1"), RB_EINVAL);
    assert_int_equal(rb_api_design(a, "max_pressure", 0, "radius=20:400", NULL, NAN, 9), RB_EINVAL);
    rb_api_free(a);
}

/* Descriptions of options and results that are none, and texts cut to their room. */
TEST(descriptions_have_their_ends)
{
    char text[400];
    int n, group = 0, k = 0;
    const rb_option *o = rb_case_describe(&n);
    while (o[group].kind != RB_OPTION_GROUP)
        group++;
    assert_null(rb_api_option(group, "name", text, 0));
    assert_string_equal(rb_api_option(group, "kind", text, sizeof text), "group");
    assert_string_equal(rb_api_option(group, "expected", text, sizeof text), "");
    assert_string_equal(rb_api_option(group, "default", text, sizeof text), "");
    assert_string_equal(rb_api_option(group, "choices", text, sizeof text), "");
    while (strcmp(o[k].name, "formulation") != 0)
        k++;
    assert_string_equal(rb_api_option(k, "choices", text, sizeof text), "static steady transient");
    assert_string_equal(rb_api_option(k, "choices", text, 11), "static ste");
    assert_string_equal(rb_api_option(k, "choices", text, 7), "static");
    assert_string_equal(rb_api_option(k, "default", text, sizeof text), "static");
    assert_string_equal(rb_api_option(k, "kind", text, sizeof text), "choice");

    const char *table = rb_rolling_result_tables[0].name;
    assert_null(rb_api_result(table, -1, "name", text, sizeof text));
    assert_null(rb_api_result(table, 0, "colour", text, sizeof text));
    for (k = 0; k < rb_rolling_result_tables[0].results->n; k++) {
        const rb_rolling_result *r = &rb_rolling_result_tables[0].results->row[k];
        assert_string_equal(rb_api_result(table, k, "unit", text, sizeof text),
                            r->unit ? r->unit : "");
        assert_string_equal(rb_api_result(table, k, "kind", text, sizeof text),
                            r->kind == RB_RESULT_WHOLE     ? "whole"
                            : r->kind == RB_RESULT_SECONDS ? "seconds"
                                                           : "number");
    }
    held_api *a = rb_api_create();
    assert_null(rb_api_value(a, "colour", text, sizeof text));
    assert_null(rb_api_value(a, o[group].name, text, sizeof text));
    assert_string_equal(rb_api_value(a, "mu", text, sizeof text), "0.3");
    rb_api_free(NULL);
}

/* Before anything is solved, and of the wrong kind of case. */
TEST(what_is_not_there_is_none)
{
    static const char *const names[] = {
        "x",     "p",     "patch.normal_load", "patch.colour", "friction_power", "H",
        "lcp.M", "lcp.z", "history.distance",  "curve.",       "curve.colour",   "F",
        "colour"};
    static const char *const numbers[] = {
        "normal_load",   "curve.free_creepage", "curve.half_width", "history.half_width",
        "task.residual", "error.normal_load",   "error.colour",     "colour"};
    rb_api *a = rb_api_create();
    const int zone[1] = {0};
    char text[40];
    int r, c;
    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
        assert_null(rb_api_array(a, names[k], &r, &c));
    assert_true(rb_api_lcp(a, -1, NULL, NULL, "lemke", 0) < 0);
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
        assert_true(isnan(rb_api_number(a, numbers[k])));
    assert_null(rb_api_word(a, "solver"));
    assert_null(rb_api_variable(a, 0, text, sizeof text));
    const int refused[] = {rb_api_pivots(a),
                           rb_api_newton(a),
                           rb_api_guess(a, 1, zone),
                           rb_api_stress(a, 3, 3, 0.0),
                           rb_api_stress_at(a, 1, (double[]){0.0, 1.0}),
                           rb_api_stress_maxima(a, 0.0)};
    for (size_t k = 0; k < sizeof refused / sizeof *refused; k++)
        assert_int_equal(refused[k], RB_EINVAL);
    assert_string_equal(rb_api_message(a), "nothing is solved");
    rb_api_free(a);

    a = solved(wheel);
    assert_int_equal(rb_api_pivots(a), RB_OK);
    array(a, "lcp.q", 36, 1); /* below: its last variable */
    assert_null(rb_api_variable(a, -1, text, sizeof text));
    assert_string_equal(rb_api_variable(a, 2 * 36, text, sizeof text), "z0");
    assert_null(rb_api_variable(a, 2 * 36 + 1, text, sizeof text));
    assert_null(rb_api_array(a, "mesh.z0", &r, &c));
    assert_null(rb_api_array(a, "plastic", &r, &c)); /* nothing yields */
    assert_null(rb_api_array(a, "patch.colour", &r, &c));
    assert_true(isnan(rb_api_number(a, "error.normal_load"))); /* not asked for */
    rb_api_free(a);
}

/* The solver that `solver` names, of the cones' too, and what a friction problem leaves. */
TEST(solvers_have_their_names)
{
    static const char cone[] = "support halfplane load 500 mu 0.3 zone 2 solver nsn-ac";
    static const double W[] = {2, 0, 0, 1}, v[] = {-1, 0.1}, mu = 0.3;
    held_api *a = solved(cone);
    assert_string_equal(rb_api_word(a, "solver"), "nsn-ac");
    assert_int_equal(rb_api_friction(a, 2, 1, W, v, &mu, "auto", 1e-10, 0), RB_OK);
    assert_string_not_equal(rb_api_word(a, "task.solver"), "auto"); /* but who solved it */
    CHECK_MAX(rb_api_number(a, "task.scaled_residual"), 1e-10, "scaled");
    CHECK_MAX(0.0, rb_api_number(a, "task.scaled_residual"), "a number");
    assert_int_equal(rb_api_friction(a, 2, -1, W, v, &mu, "nsn-ac", 1e-10, 0), RB_EINVAL);
    assert_non_null(strstr(rb_api_message(a), "-1 contacts of dimension 2"));
    /* Nothing is unknown. */
    assert_int_equal(rb_api_friction(a, 2, 0, NULL, NULL, NULL, "nsn-ac", 1e-10, 0), RB_OK);
    assert_int_equal(rb_api_lcp(a, 0, NULL, NULL, "lemke", 0), RB_OK);
    CHECK_ABS(rb_api_number(a, "task.residual"), 0.0, 0.0, "of nothing");
    assert_int_equal(rb_api_friction(a, 3, 1 << 30, W, v, &mu, "nsn-ac", 1e-10, 0), RB_EINVAL);
    assert_int_equal(rb_api_friction(a, 2, 1, W, v, &(double){-1.0}, "nsn-ac", 1e-10, 0),
                     RB_EINVAL);
}

static void call_everything(int forced)
{
    rb_api *a = solved(wheel);
    const double one = 1.0, minus[] = {-1.0, 0.1}, W[] = {2, 0, 0, 1}, xy[] = {0.0, 1.0};
    for (int k = 0; k < 10; k++) {
        assert_int_equal(rb_blas_threads(2), 2);
        CHECK_OK(k == 0   ? rb_api_stress(a, 2, 2, 0.0)
                 : k == 1 ? rb_api_stress_at(a, 1, xy)
                 : k == 2 ? rb_api_stress_maxima(a, 0.0)
                 : k == 3 ? rb_api_pivots(a)
                 : k == 4 ? rb_api_newton(a)
                 : k == 5 ? rb_api_lcp(a, 1, &one, minus, "lemke", 0)
                 : k == 6 ? rb_api_friction(a, 2, 1, W, minus, &one, "auto", 1e-9, 0)
                 : k == 7 ? rb_api_prove(a)
                 : k == 8 ? rb_api_sweep(a, 1, &a, NULL, NULL, 1)
                          : rb_api_solve(a));
    }
    rb_api_free(a);
    a = solved(steady);
    rb_blas_threads(2);
    CHECK_OK(rb_api_curve(a, "creep-ratio", 0.0, 1.0, 2, NULL, NULL));
    assert_int_equal(rb_blas_threads(1), 2);
    rb_api_free(a);
}

/* Whoever uses BLAS beside has his threads again when the call is over. */
TEST(calls_leave_the_threads_alone)
{
    with_two_threads(call_everything);
}

/* Bodies whose flexibility is no matrix, matrices that are asked for in another order. */
TEST(matrices_are_at_hand_or_refused)
{
    static const char large[] =
        "support halfplane load 500 mesh uniform contact-elements 1500 zone 2 mu 0";
    int r, c;
    rb_api *a = solved(large);
    assert_int_equal(rb_api_pivots(a), RB_EINVAL);
    assert_string_equal(rb_api_message(a), "there is no solved case whose matrices are available");
    assert_null(rb_api_array(a, "G", &r, &c));
    assert_int_equal(rb_api_stress_at(a, 0, NULL), RB_EINVAL);
    assert_string_equal(rb_api_message(a), "stress: expected at least one point, got 0");
    rb_api_free(a);
    a = solved(wheel);
    held_api *b = solved(wheel);
    const double *G = rb_api_array(a, "G", &r, &c), *H = rb_api_array(b, "H", &r, &c);
    const size_t bytes = sizeof *G * (size_t)r * (size_t)c;
    assert_memory_equal(H, array(a, "H", r, c), bytes);
    assert_memory_equal(G, array(b, "G", r, c), bytes);
    rb_api_free(a);
}

static rb_api *stopped;

/* Once the steps are counted. */
static void stop(int number)
{
    (void)number;
    int done, total;
    rb_api_progress(stopped, &done, &total);
    if (total > 0)
        rb_api_stop(stopped);
}

/* From a handler of signals, as docs say: the run ends after the step at hand. */
TEST(a_stopped_run_is_interrupted)
{
    static const char words[] = "support halfplane load 500 creep-ratio 0.5 formulation transient "
                                "distance 1000 contact-elements 8 zone 2";
    const struct itimerval soon = {{0, 1000}, {0, 1000}}, never = {{0, 0}, {0, 0}};
    /* stays when called; signal() may go back to the default, which ends the test */
    const struct sigaction stops = {.sa_handler = stop};
    stopped = rb_api_create();
    assert_int_equal(give(stopped, words), RB_OK);
    sigaction(SIGALRM, &stops, NULL);
    setitimer(ITIMER_REAL, &soon, NULL);
    const int s = rb_api_solve(stopped);
    setitimer(ITIMER_REAL, &never, NULL);
    assert_int_equal(s, RB_INTERRUPTED);
    assert_string_equal(rb_api_word(stopped, "status"), "interrupted");
    int done, total, rows, columns;
    rb_api_progress(stopped, &done, &total);
    assert_non_null(rb_api_array(stopped, "history.distance", &rows, &columns));
    CHECK_ABS(done, rows, 0.0, "the steps that are done, of %d", total);
    assert_true(done >= 1 && total > 1000);
    rb_api_free(stopped);
    stopped = rb_api_create();
    assert_int_equal(rb_api_set(stopped, "support", "halfplane"), RB_OK);
    assert_int_equal(rb_api_set(stopped, "load", "500"), RB_OK);
    setitimer(ITIMER_REAL, &soon, NULL);
    const int passing =
        rb_api_crack(stopped, 1, (const char *const[]){"passes"}, (const char *const[]){"1000"});
    setitimer(ITIMER_REAL, &never, NULL);
    signal(SIGALRM, SIG_DFL);
    assert_int_equal(passing, RB_INTERRUPTED);
    rb_api_progress(stopped, &done, &total);
    /* as many positions in each pass; 0: before the first one, while the crack was made */
    assert_true(total == 0 || (total % 1000 == 0 && total > 1000 * 100));
    assert_null(rb_api_array(stopped, "crack.K_I", &rows, &columns));
    rb_api_free(stopped);
}

/* ---- Short memory ------------------------------------------------------------------ */

static rb_status have_arrays(rb_api *a, const char *const *name)
{
    for (int r, c; *name; name++)
        if (!rb_api_array(a, *name, &r, &c))
            return RB_ENOMEM;
    return RB_OK;
}

static rb_status step_through(rb_api *a)
{
    static const char *const arrays[] = {
        "p",     "H",       "mesh.x0",     "mesh.y0",     "mesh.x1", "mesh.y1", "F",
        "lcp.M", "lcp.q",   "pivot.value", "newton.p",    "guess.p", "guess.q", "gap0",
        "ends",  "pivot.p", "pivot.z0",    "newton.zone", NULL};
    int zone[12], s = rb_api_pivots(a);
    for (int i = 0; i < 12; i++)
        zone[i] = RB_ZONE_STICK;
    if (s == RB_OK)
        s = rb_api_newton(a);
    if (s == RB_OK)
        s = rb_api_guess(a, 12, zone);
    return s == RB_OK ? have_arrays(a, arrays) : (rb_status)s;
}

static rb_status look_around(rb_api *a)
{
    static const char *const arrays[] = {"patch.normal_load", "friction_power", "curve.creepage",
                                         "curve.error.force_ratio", NULL};
    const int s = rb_api_curve(a, "creep", 0.0, 1e-3, 3, NULL, NULL);
    return s == RB_OK ? have_arrays(a, arrays) : (rb_status)s;
}

static rb_status look_below(rb_api *a)
{
    static const char *const arrays[] = {"step.p",           "step.x",     "history.normal_load",
                                         "maxima.max_shear", "stress.syy", NULL};
    const double xy[] = {0.0, 0.1};
    int s = rb_api_stress(a, 3, 3, 0.0);
    if (s == RB_OK)
        s = rb_api_stress_maxima(a, 0.0);
    if (s == RB_OK)
        s = rb_api_stress_at(a, 1, xy);
    return s == RB_OK ? have_arrays(a, arrays) : (rb_status)s;
}

static rb_status solve_problems(rb_api *a)
{
    static const double M[] = {2, 1, 1, 2}, q[] = {-5, -6};
    static const double W[] = {2, 0, 0, 0, 1, 0, 0, 0, 1}, v[] = {-1, 0.1, 0.4}, mu = 0.3;
    static const char *const of_lcp[] = {"lcp.z", "lcp.w", NULL},
                             *const of_friction[] = {"friction.r", "friction.u", NULL},
                             *const of_sweep[] = {"sweep.status", "sweep.force_ratio", NULL};
    rb_api *const cases[] = {a};
    char text[40];
    int s = rb_api_option(1, "default", text, sizeof text) ? RB_OK : RB_ENOMEM;
    if (s == RB_OK)
        s = rb_api_lcp(a, 2, M, q, "lemke", 0);
    if (s == RB_OK)
        s = rb_api_lcp(a, 2, M, q, "newton", 0);
    if (s == RB_OK)
        s = have_arrays(a, of_lcp);
    if (s == RB_OK)
        s = rb_api_friction(a, 3, 1, W, v, &mu, "auto", 1e-10, 0);
    if (s == RB_OK)
        s = have_arrays(a, of_friction);
    if (s == RB_OK)
        s = rb_api_sweep(a, 1, cases, NULL, NULL, 1);
    return s == RB_OK ? have_arrays(a, of_sweep) : (rb_status)s;
}

typedef struct {
    const char *options;
    rb_status (*then)(rb_api *a);
} handle_job;

static rb_status by_handle(void *context)
{
    const handle_job *j = context;
    held_api *a = rb_api_create();
    int s = a ? RB_OK : RB_ENOMEM;
    if (s == RB_OK)
        s = give(a, j->options);
    if (s == RB_OK)
        s = rb_api_solve(a);
    if (s == RB_OK)
        s = j->then(a);
    if (a && s == RB_ENOMEM && rb_api_status(a) == RB_ENOMEM)
        assert_non_null(strstr(rb_api_message(a), "memory"));
    return (rb_status)s;
}

TEST(short_memory_is_reported)
{
    static const char bars[] = "formulation steady support halfplane load 500 creep-ratio 0.5 mesh "
                               "uniform error yes zone 2 contact-elements 12";
    static const char rolls[] = "support halfplane load 500 creep-ratio 0.5 formulation transient "
                                "distance 0.2 contact-elements 8 zone 2";
    static const char small[] = "support halfplane load 500 contact-elements 8 zone 2";
    const handle_job jobs[] = {
        {wheel, step_through}, {bars, look_around}, {rolls, look_below}, {small, solve_problems}};
    for (size_t k = 0; k < sizeof jobs / sizeof *jobs; k++) {
        const int n = alloc_fail_every_call(by_handle, (void *)&jobs[k]);
        print_message("# job %d: %d failures of memory\n", (int)k, n);
        assert_true(n > 5);
    }
}

/* Archard: K P per slid length, whatever the shape; the pressure flattens. */
TEST(wear)
{
    int rows = 0, columns = 0, n = 0;
    held_api *a = rb_api_create_for("wear");
    rb_api_set(a, "support", "halfplane");
    rb_api_set(a, "similar", "yes");
    rb_api_set(a, "gap", "parabola");
    rb_api_set(a, "load", "200");
    assert_int_equal(rb_api_wear(a, "archard", 1e-10, 0.0, 1e6, NAN, 5, 8), RB_OK);
    const double *worn = rb_api_array(a, "wear.worn", &rows, &columns);
    assert_int_equal(rows, 6);
    CHECK_REL(worn[5], 1e-10 * 200.0 * 1e6, 1e-9, "K P s");
    assert_non_null(rb_api_array(a, "wear.profile.x", &n, &columns));
    assert_non_null(rb_api_array(a, "wear.profile.depth", &rows, &columns));
    assert_int_equal(rows, n);
    assert_null(rb_api_array(a, "wear.worn_b", &rows, &columns));
    assert_true(rb_api_wear(a, "abrasion", 1e-10, 0.0, 1e6, NAN, 5, 8) < 0);
    assert_non_null(strstr(rb_api_message(a), "archard or dissipation"));
    assert_true(rb_api_wear(a, "archard", 1e-10, 0.0, 1e6, 10.0, 5, 8) < 0);
    assert_non_null(strstr(rb_api_message(a), "exclude each other"));
    assert_true(rb_api_wear(a, "archard", 1e-10, 0.0, NAN, NAN, 5, 8) < 0);
    assert_null(rb_api_array(a, "wear.worn", &rows, &columns)); /* refused: nothing old */
    rb_api_set(a, "load", "1,5");
    assert_true(rb_api_wear(a, "archard", 1e-10, 0.0, 1e6, NAN, 5, 8) < 0);
}

/* A crack by names gives what the program does; units are the handle's. */
TEST(cracks)
{
    static const char *const names[] = {"crack-angle", "unloaded", "remote-stress"},
                             *const values[] = {"45", "yes", "2"};
    int rows = 0, columns = 0;
    held_api *a = rb_api_create_for("crack");
    rb_api_set(a, "half-width", "1");
    assert_int_equal(rb_api_crack(a, 3, names, values), RB_OK);
    const double *K = NOT_NULL(rb_api_array(a, "crack.summary.K_I_max", &rows, &columns));
    CHECK_ABS(*K / (2.0 * sqrt(3.14159265358979)), 0.70491, 2e-4, "45 degrees");
    assert_non_null(rb_api_array(a, "crack.K_II", &rows, &columns));
    assert_int_equal(rows, 1);
    /* K_I of the last node's opening, which the picture shows; whatever the units */
    const double *D = rb_api_array(a, "crack.opening", &rows, &columns);
    assert_int_equal(rows, 40);
    assert_int_equal(columns, 1);
    assert_true(D[rows - 1] > 0.0 && D[0] > D[rows - 1]);
    const double tip = rb_api_array(a, "crack.path.x", &rows, &columns)[1], K_mm = *K;
    CHECK_REL(tip, sqrt(0.5), 1e-14, "tip");
    CHECK_REL(rb_api_array(a, "crack.node.t_y", &rows, &columns)[0], -sqrt(0.5), 1e-14,
              "direction");
    const double *length = rb_api_array(a, "crack.node.length", &rows, &columns);
    double sum = 0.0;
    for (int j = 0; j < rows; j++)
        sum += length[j];
    CHECK_ABS(sum, 1.0, 2e-3, "lengths of the nodes but for half an element at the tip");
    assert_int_equal(rb_api_crack(a, 3, names, (const char *const[]){"90", "yes", "-2"}), RB_OK);
    for (int k = 0; k < 2; k++) { /* closed: the faces carry what lies across them */
        const double *traction =
            rb_api_array(a, k ? "crack.friction" : "crack.pressure", &rows, &columns);
        assert_non_null(traction);
        for (int j = 0; j < rows; j++)
            CHECK_ABS(traction[j], k ? 0.0 : 2.0, 1e-10, "node %d", j);
    }
    rb_api_set(a, "units", "si");
    rb_api_set(a, "half-width", "0.001");
    assert_int_equal(rb_api_crack(a, 3, names, (const char *const[]){"45", "yes", "2e6"}), RB_OK);
    CHECK_REL(*rb_api_array(a, "crack.summary.K_I_max", &rows, &columns),
              rb_unit_shown(RB_UNITS_SI, "MPa.mm^0.5", K_mm), 1e-9, "in m, N and Pa");
    assert_true(rb_api_crack(a, 2, names, (const char *const[]){"0", "yes"}) < 0);
    assert_true(rb_api_crack(a, 1, (const char *const[]){"crack-lenght"}, values) < 0);
    assert_non_null(strstr(rb_api_message(a), "crack-length"));
}

/* By handle as by rb_case_differentiate; both sides of a border, one of an end. */
TEST(derivatives)
{
    rb_api *a = rb_api_create();
    char name[40], unit[20], why[200];
    int rows, columns, mu = -1, layer = -1;
    assert_true(rb_api_derivatives(a) < 0);
    assert_null(rb_api_array(a, "derivative.tangential_load", &rows, &columns));

    rb_api_free(a);
    a = solved("support halfplane similar yes load 500 formulation steady creep-ratio 3 "
               "contact-elements 30");
    assert_null(rb_api_input(a, 0, "name", name, sizeof name));
    assert_null(rb_api_word(a, "elements"));
    assert_int_equal(rb_api_derivatives(a), RB_OK);
    assert_string_equal(
        rb_api_word(a, "elements"),
        "on elements that move with the edges of the contact, to which they are fitted");
    for (int k = 0; rb_api_input(a, k, "name", name, sizeof name); k++) {
        mu = strcmp(name, "mu") == 0 ? k : mu;
        layer = strcmp(name, "interlayer-normal") == 0 ? k : layer;
        assert_string_equal(rb_api_input(a, k, "refusal", why, sizeof why), "");
        assert_non_null(rb_api_input(a, k, "unit", unit, sizeof unit));
    }
    assert_true(mu >= 0 && layer >= 0);
    const double *x = NOT_NULL(rb_api_array(a, "derivative.tangential_load", &rows, &columns));
    assert_int_equal(rows, 1);
    CHECK_REL(x[2 * mu], -500.0, 1e-10, "it slides: Q = -mu P");
    CHECK_REL(x[2 * mu + 1], -500.0, 1e-10, "on both sides");
    assert_true(isnan(x[2 * layer]) && !isnan(x[2 * layer + 1]));
    const double *q = rb_api_array(a, "derivative.q", &rows, &columns);
    const double *p = rb_api_array(a, "p", &rows, &columns);
    for (int i = 0; i < rows; i++)
        CHECK_ABS(q[i + rows * 2 * mu], -p[i], 1e-9 * fabs(p[rows / 2]), "q of %d", i);
    assert_non_null(rb_api_array(a, "derivative.value", &rows, &columns));
    assert_null(rb_api_array(a, "derivative.solver", &rows, &columns));
    assert_null(rb_api_array(a, "tolerance.tangential_load", &rows, &columns));
    assert_int_equal(rb_api_tolerances(a, "zone=1"), RB_EINVAL);
    assert_int_equal(rb_api_tolerances(a, "mu=0.02"), RB_OK);
    x = NOT_NULL(rb_api_array(a, "tolerance.tangential_load", &rows, &columns));
    CHECK_REL(*x, 10.0, 1e-10, "of Q = -mu P");
    assert_null(rb_api_array(a, "tolerance.contact", &rows, &columns));
    assert_int_equal(rb_api_smooth_derivatives(a), RB_OK);
    x = rb_api_array(a, "derivative.tangential_load", &rows, &columns);
    CHECK_REL(x[2 * mu], -500.0, 1e-10, "no zone changes");
    assert_null(rb_api_array(a, "derivative.tangential_load.gap", &rows, &columns));
    rb_api_set(a, "mu", "0.2"); /* forgets them */
    assert_null(rb_api_array(a, "tolerance.tangential_load", &rows, &columns));
    assert_null(rb_api_array(a, "derivative.q", &rows, &columns));
    rb_api_free(a);
}

/* What the last of several steps began with, its heat too, is gone when they are solved. */
TEST(derivatives_of_several_steps_are_refused)
{
    held_api *a = solved(
        "support hub similar yes load 500 formulation transient distance 0.6 steps 3 creep 1e-3 "
        "speed 1000 mu-heat -0.1,0,300 conductivity 50 heat-capacity 3.8 contact-elements 20");

    assert_int_equal(rb_api_derivatives(a), RB_EINVAL);
    assert_non_null(strstr(rb_api_message(a), "ask for those of its history, step by step"));
    assert_int_equal(rb_api_smooth_derivatives(a), RB_EINVAL);
    /* standard deviations are those of its history */
    int rows, columns;
    assert_int_equal(rb_api_tolerances(a, "mu=0.02"), RB_OK);
    assert_non_null(rb_api_array(a, "history.tolerance.max_temperature", &rows, &columns));
}

/* Every point of a curve has both sides of the single case that it is, for every result and
 * input; a refusal leaves nothing of the curve before, and the handle goes on. */
TEST(derivatives_of_a_curve_are_those_of_its_points)
{
    static const char curve_words[] = "support halfplane support-b halfplane similar yes load 500 "
                                      "mesh uniform zone 1.2 contact-elements 30";
    held_api *a = rb_api_create_for("curve"), *point = rb_api_create();
    char name[120], result[60], input[60], column[140];
    int rows, columns, compared = 0, one_sided = 0;
    assert_int_equal(give(a, curve_words), RB_OK);
    assert_int_equal(give(point, curve_words), RB_OK);
    assert_int_equal(rb_api_resolve(a), RB_OK);
    assert_null(rb_api_derivative(a, "curve", 0, "name", name, sizeof name));
    assert_int_equal(rb_api_curve(a, "creep-ratio", 0.25, 1.0, 4, "all", NULL), RB_OK);
    const double *Q = array(a, "curve.tangential_load", 4, 1);
    assert_int_equal(rb_api_set(point, "formulation", "steady"), RB_OK);
    for (int k = 0; k < 4; k += 3) {
        snprintf(name, sizeof name, "%g", 0.25 * (k + 1));
        assert_int_equal(rb_api_set(point, "creep-ratio", name), RB_OK);
        assert_int_equal(rb_api_solve(point), RB_OK);
        assert_int_equal(rb_api_derivatives(point), RB_OK);
        CHECK_REL(Q[k], rb_api_number(point, "tangential_load"), 1e-9, "point %d", k);
        for (int j = 0; rb_api_derivative(a, "curve", j, "name", name, sizeof name); j++) {
            rb_api_derivative(a, "curve", j, "result", result, sizeof result);
            rb_api_derivative(a, "curve", j, "input", input, sizeof input);
            snprintf(column, sizeof column, "curve.derivative.%s", name);
            const double *d = array(a, column, 4, 2);
            snprintf(column, sizeof column, "derivative.%s", result);
            const double *all = NOT_NULL(rb_api_array(point, column, &rows, &columns));
            for (int side = 0; side < 2; side++) {
                const double x = d[k + 4 * side], y = all[2 * place_of(point, input) + side],
                             scale = array(point, "derivative.value", 1,
                                           columns / 2)[place_of(point, input)];
                assert_int_equal(isnan(x), isnan(y));
                one_sided += side && isnan(x) != isnan(d[k]);
                if (isnan(x))
                    continue;
                CHECK_ABS(x, y,
                          1e-7 * (fabs(y) + fabs(rb_api_number(point, result) /
                                                 (scale != 0.0 ? scale : 1e-3))),
                          "%s, point %d", name, k);
                compared++;
            }
        }
    }
    if (compared < 500 || one_sided < 10)
        fail_msg("%d compared, %d one-sided", compared, one_sided);

    assert_int_equal(rb_api_curve(a, "creep-ratio", 0.2, 1.0, 5, "nonsense", NULL), RB_EINVAL);
    assert_null(rb_api_array(a, "curve.derivative.tangential_load:mu", &rows, &columns));
    assert_null(rb_api_array(a, "curve.tangential_load", &rows, &columns));
    assert_int_equal(rb_api_curve(a, "creep-ratio", 0.2, 1.0, 5, "approach:zone", NULL), RB_EINVAL);
    /* per cent are those of each point's own creep ratio */
    assert_int_equal(rb_api_curve(a, "creep-ratio", 0.2, 1.0, 3, "tangential_load:mu",
                                  "mu=0.02,creep-ratio=10%"),
                     RB_OK);
    const double *deviation = array(a, "curve.tolerance.tangential_load", 3, 1);
    for (int k = 0; k < 3; k++) {
        snprintf(name, sizeof name, "%g", 0.2 + 0.4 * k);
        assert_int_equal(rb_api_set(point, "creep-ratio", name), RB_OK);
        assert_int_equal(rb_api_solve(point), RB_OK);
        assert_int_equal(rb_api_tolerances(point, "mu=0.02,creep-ratio=10%"), RB_OK);
        CHECK_REL(deviation[k], *array(point, "tolerance.tangential_load", 1, 1), 1e-7,
                  "deviation at point %d", k);
    }
    assert_null(rb_api_array(a, "curve.tolerance.stick_ratio", &rows, &columns));
    assert_int_equal(rb_api_curve(a, "creep-ratio", 0.2, 1.0, 3, NULL, "zone=1"), RB_EINVAL);
    assert_null(rb_api_array(a, "curve.tolerance.tangential_load", &rows, &columns));
    assert_int_equal(rb_api_curve(a, "creep-ratio", 0.2, 1.0, -3, NULL, "mu=1%"), RB_EINVAL);
    assert_non_null(strstr(rb_api_message(a), "points: expected"));
    assert_int_equal(rb_api_curve(a, "creep-ratio", 0.2, 1.0, 3, NULL, NULL), RB_OK);
    assert_null(rb_api_derivative(a, "curve", 0, "name", name, sizeof name));
    assert_int_equal(rb_api_set(a, "error", "yes"), RB_OK);
    assert_int_equal(rb_api_resolve(a), RB_OK);
    assert_int_equal(rb_api_curve(a, "creep-ratio", 0.2, 1.0, 5, "all:mu", NULL), RB_EINVAL);
    assert_non_null(strstr(rb_api_message(a), "not together with error bars"));
    assert_int_equal(rb_api_set(point, "formulation", "static"), RB_OK);
    assert_int_equal(rb_api_resolve(point), RB_OK);
    assert_int_equal(rb_api_curve(point, "creep-ratio", 0.2, 1.0, 5, "all:mu", NULL), RB_EINVAL);
    assert_non_null(strstr(rb_api_message(point), "give --formulation steady"));
}

/* By handle the tangent of a history is what two histories nearby say, and one uncertain
 * input gives its size; what is refused leaves the steps alone. */
TEST(derivatives_of_steps)
{
    static const char words[] = "support halfplane similar yes load 500 mu 0.3 creep-ratio 0.5 "
                                "formulation transient distance 1 contact-elements 16";
    held_api *a = solved(words), *b = solved(words);
    char name[120];
    int steps, columns;
    const double *Q = rb_api_array(a, "history.tangential_load", &steps, &columns);
    double before[400];
    assert_true(steps > 3 && steps <= 400);
    memcpy(before, Q, sizeof *before * (size_t)steps);
    assert_int_equal(rb_api_step_derivatives(a, "tangential_load:moo", NULL), RB_EINVAL);
    assert_int_equal(rb_api_step_derivatives(a, "p0", NULL), RB_EINVAL);
    assert_int_equal(rb_api_step_derivatives(a, "tangential_load,normal_load:load", NULL), RB_OK);
    assert_string_equal(rb_api_derivative(a, "history", 0, "result", name, sizeof name),
                        "tangential_load");
    const double *d = array(a, "history.derivative.tangential_load:mu", steps, 1),
                 *by_load = array(a, "history.derivative.normal_load:load", steps, 1);
    assert_null(rb_api_array(a, "history.derivative.normal_load:mu", &steps, &columns));
    assert_int_equal(rb_api_set(b, "mu", "0.30003"), RB_OK);
    assert_int_equal(rb_api_solve(b), RB_OK);
    Q = rb_api_array(b, "history.tangential_load", &steps, &columns);
    for (int k = 0; k < steps; k++) {
        CHECK_ABS(d[k], (Q[k] - before[k]) / 3e-5, 0.02 * fabs(before[steps - 1]), "step %d", k);
        CHECK_REL(by_load[k], 1.0, 1e-9, "step %d", k);
    }
    assert_int_equal(rb_api_tolerances(a, "mu=0.02"), RB_OK);
    const double *deviation = array(a, "history.tolerance.tangential_load", steps, 1);
    for (int k = 0; k < steps; k++)
        CHECK_ABS(deviation[k], 0.02 * fabs(d[k]), 1e-12 * fabs(before[steps - 1]), "step %d", k);
    /* both in one run over the steps */
    assert_int_equal(rb_api_step_derivatives(a, "tangential_load:mu", "mu=0.04"), RB_OK);
    d = array(a, "history.derivative.tangential_load:mu", steps, 1);
    deviation = array(a, "history.tolerance.tangential_load", steps, 1);
    for (int k = 0; k < steps; k++)
        CHECK_ABS(deviation[k], 0.04 * fabs(d[k]), 1e-12 * fabs(before[steps - 1]), "step %d", k);
    assert_int_equal(rb_api_step_derivatives(a, "tangential_load", "moo=1"), RB_EINVAL);
    assert_non_null(strstr(rb_api_message(a), "--tolerance: 'moo' is not a number of this case"));
    assert_int_equal(rb_api_set(a, "mu", "0.2"), RB_OK);
    assert_int_equal(rb_api_step_derivatives(a, "tangential_load", NULL), RB_EINVAL);
    assert_non_null(strstr(rb_api_message(a), "need a case with steps that has been solved"));
    assert_int_equal(rb_api_set(a, "error", "yes"), RB_OK);
    assert_int_equal(rb_api_solve(a), RB_OK);
    assert_int_equal(rb_api_step_derivatives(a, "tangential_load", NULL), RB_EINVAL);
    assert_int_equal(rb_api_tolerances(a, "mu=0.02"), RB_EINVAL);
    assert_non_null(strstr(rb_api_message(a), "not together with error bars"));
}

RUN_TESTS(NULL, NULL)
