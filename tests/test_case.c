/* Cases by names: the table describes itself, words are set, settled and refused, and the
 * same words give the same answer through the library and through the program. */
#include "cli_run.h"
#include "rollbem/blas.h"
#include "rollbem/case.h"

#include <gsl/gsl_math.h>

static char examples[600]; /* the program's tests leave the project's root */

static int enter(void **state)
{
    char here[500];
    assert_non_null(getcwd(here, sizeof here));
    snprintf(examples, sizeof examples, "%s/examples", here);
    return enter_folder(state);
}

/* "name=value name=value ..." */
static rb_status set_words(rb_case *c, const char *words, rb_message *why)
{
    char text[500];
    rb_status s = RB_OK;
    snprintf(text, sizeof text, "%s", words);
    for (char *word = strtok(text, " "); word && s == RB_OK; word = strtok(NULL, " ")) {
        char *value = strchr(word, '=');
        *value++ = '\0';
        s = rb_case_set(c, word, value, RB_GIVEN_ARGUMENT, why);
    }
    return s;
}

static rb_case *case_of(const char *words)
{
    rb_message why = {""};
    rb_case *c = rb_case_create(RB_CASE_SINGLE);
    assert_non_null(c);
    if (set_words(c, words, &why) != RB_OK || rb_case_settle(c, &why) != RB_OK)
        fail_msg("%s: %s", words, why.text);
    return c;
}

/* ---- Library and program ----------------------------------------------------------- */

/* The same as a command line. */
static void run_program(const char *file, const char *words)
{
    char line[2400], options[1000] = "";
    const char *word = words;
    while (*word) {
        const int n = (int)strcspn(word, " ");
        const size_t used = strlen(options);
        snprintf(options + used, sizeof options - used, " --%.*s", n, word);
        word += n + (word[n] == ' ');
    }
    snprintf(line, sizeof line, "%s%s%s%s --json --quiet", *file ? examples : "",
             *file ? "/" : "", file, options);
    if (rollbem(line) != 0)
        fail_msg("rollbem %s: %s", line, err);
}

static void compare_column(const json_t *table, const char *name, int n, const double *x)
{
    for (int i = 0; i < n; i++)
        if (!(entry(table, name, (size_t)i) == x[i]))
            fail_msg("%s, element %d: program %.17g, library %.17g", name, i + 1,
                     entry(table, name, (size_t)i), x[i]);
}

static void compare(const char *file, const char *words)
{
    char path[700];
    rb_message why = {""};
    rb_case_result r;
    rb_case *c = rb_case_create(RB_CASE_SINGLE);
    snprintf(path, sizeof path, "%s/%s", examples, file);
    rb_status s = set_words(c, words, &why);
    if (s == RB_OK && *file)
        s = rb_case_read(c, path, 0, NULL, &why);
    if (s == RB_OK)
        s = rb_case_settle(c, &why);
    if (s != RB_OK || rb_case_solve(rb_case_settled(c), NULL, NULL, &r, &why) != RB_OK)
        fail_msg("%s %s: %s", file, words, why.text);

    run_program(file, words);
    json_t *root = json_loads(out, 0, NULL);
    assert_non_null(root);
    const json_t *table = json_object_get(root, "table");
    const rb_rolling_solution *got = &r.solution;
    assert_int_equal(json_array_size(json_object_get(table, "p_MPa")), got->n);
    compare_column(table, "x_mm", got->n, got->x);
    compare_column(table, "p_MPa", got->n, got->p);
    compare_column(table, "q_MPa", got->n, got->q);
    compare_column(table, "slip_1", got->n, got->slip);
    json_decref(root);
    rb_case_result_free(&r);
    rb_case_free(c);
}

/* Bit for bit: the examples as they stand, and words that leave choices to the settling.
 */
static void the_same_words_give_the_same_answer(void **state)
{
    (void)state;
    static const struct {
        const char *file, *words;
    } cases[] = {
        {"paper/case.ini", ""},
        {"paper/case-mu01.ini", ""},
        {"by-hand/case.ini", ""},
        {"hertz/case.ini", ""},
        {"carter/case.ini", ""},
        {"two-bodies/case.ini", ""},
        {"cattaneo-to-carter/case.ini", "contact-elements=50"},
        {"rail/case.ini", "creep-ratio=0.4"},
        {"rail/case.ini", "formulation=static load=500"},
        {"", "similar=yes support=halfplane formulation=steady load=500 creep-ratio=0.2"},
        {"", "support=hub formulation=steady half-width=0.5 mu=0.2 young-b=70000"},
        {"", "formulation=steady creep=0.1 contact-elements=25"},
    };
    /* of the same kernels and as many threads, the digits are the same */
    assert_int_equal(setenv("OPENBLAS_CORETYPE", rb_blas_core(), 1), 0);
    assert_int_equal(setenv("OPENBLAS_NUM_THREADS", "1", 1), 0);
    rb_blas_threads(1);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        compare(cases[k].file, cases[k].words);
}

/* -0.6438 where nobody chooses the fitted mesh; the exact ratio is -0.64. */
static void carter_by_names_is_on_the_fitted_mesh(void **state)
{
    (void)state;
    rb_message why = {""};
    rb_case_result r;
    rb_case *c =
        case_of("similar=yes support=halfplane formulation=steady half-width=0.5 "
                "creep-ratio=0.4 mu=0.3 radius=500");
    assert_int_equal(rb_case_settled(c)->rc.mesh, RB_MESH_FITTED);
    CHECK_STATUS(rb_case_solve(rb_case_settled(c), NULL, NULL, &r, &why), RB_OK);
    CHECK_ABS(r.solution.force_ratio, -0.64, 1e-4, "Carter: s (2 - s) at s = 0.4");
    rb_case_result_free(&r);
    rb_case_free(c);
}

/* ---- The table --------------------------------------------------------------------- */

static void every_option_describes_itself(void **state)
{
    (void)state;
    int n, options = 0;
    const rb_option *o = rb_case_describe(&n);
    assert_int_equal(o[0].kind, RB_OPTION_GROUP);
    for (int i = 0; i < n; i++) {
        assert_true(o[i].name && *o[i].name && o[i].help && *o[i].help);
        if (o[i].kind == RB_OPTION_GROUP)
            continue;
        options++;
        assert_ptr_equal(rb_case_option(o[i].name), &o[i]);
        assert_true(*rb_case_section(&o[i]) != '\0');
        assert_non_null(o[i].unit);
        assert_int_equal(o[i].kind == RB_OPTION_CHOICE, o[i].choices != NULL);
    }
    assert_true(options > 30);
    assert_null(rb_case_option("mesh-size"));
}

/* What the library prints of a value it takes back. */
static void a_value_survives_as_text(void **state)
{
    (void)state;
    rb_message why = {""};
    int n;
    const rb_option *o = rb_case_describe(&n);
    rb_case *c = case_of(""), *again = case_of("");
    rb_settled_case *words = rb_case_options(c).target;
    const rb_settled_case *back = rb_case_options(again).target;
    for (int i = 0; i < n; i++) {
        char room[64], room2[64];
        if (o[i].kind == RB_OPTION_GROUP || o[i].unset) /* has no default value */
            continue;
        const char *text = rb_option_text(&o[i], words, room);
        if (rb_case_set(again, o[i].name, text, RB_GIVEN_ARGUMENT, &why) != RB_OK)
            fail_msg("%s", why.text);
        assert_string_equal(rb_option_text(&o[i], back, room2), text);
    }
    rb_case_free(c);
    rb_case_free(again);
}

static void numbers_are_words_too(void **state)
{
    (void)state;
    rb_message why = {""};
    rb_case *c = case_of("load=500"), *by_number = case_of("");
    CHECK_STATUS(rb_case_set_number(by_number, "load", 500.0, &why), RB_OK);
    CHECK_STATUS(rb_case_set_number(by_number, "contact-elements", 40.0, &why), RB_OK);
    CHECK_STATUS(rb_case_settle(by_number, &why), RB_OK);
    assert_true(rb_case_settled(c)->rc.load == rb_case_settled(by_number)->rc.load);
    assert_int_equal(rb_case_settled(by_number)->rc.contact_elements, 40);
    assert_int_equal(rb_case_given(by_number, "load"), RB_GIVEN_NUMBER);
    assert_int_equal(rb_case_given(by_number, "mu"), 0);
    rb_case_free(c);
    rb_case_free(by_number);
}

/* ---- Refusals ---------------------------------------------------------------------- */

static void check_word(rb_status s, const rb_message *why, const char *part)
{
    if (s != RB_EINVAL || !strstr(why->text, part))
        fail_msg("status %d, '%s', wanted '%s'", (int)s, why->text, part);
}

static void wrong_words_are_refused(void **state)
{
    (void)state;
    rb_message why = {""};
    rb_case *c = case_of("");
    check_word(rb_case_set(c, "lood", "3", RB_GIVEN_ARGUMENT, &why), &why, "'load'?");
    check_word(rb_case_set(c, "load", "-3", RB_GIVEN_ARGUMENT, &why), &why,
               "--load: expected a number > 0, got '-3'");
    check_word(rb_case_set(c, "body-a", "3", RB_GIVEN_ARGUMENT, &why), &why, "body-a");
    check_word(rb_case_set_number(c, "load", NAN, &why), &why, "load: expected");
    check_word(rb_case_set_number(c, "support", 1.0, &why), &why, "takes no number");
    check_word(rb_case_set_number(c, "steps", 1.5, &why), &why, "whole number");
    CHECK_STATUS(rb_case_set(c, "load", "x", 7, NULL), RB_EFORMAT);
    assert_int_equal(rb_case_given(c, "load"), 0);
    rb_case_free(c);
}

static void contradictions_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *words, *part;
    } bad[] = {
        {"load=3 approach=1", "--approach and --load exclude each other"},
        {"poisson-b=0.2", "body B is rigid"},
        {"formulation=transient", "needs --distance or --history"},
        {"steps=4", "of transient rolling only"},
        {"mu=0.1,0.2", "a curve takes several"},
        {"accuracy=1e-3 formulation=transient distance=1", "without steps only"},
        {"force-ratio=1.5", "at most 1"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        rb_message why = {""};
        rb_case *c = rb_case_create(RB_CASE_SINGLE);
        CHECK_STATUS(set_words(c, bad[k].words, &why), RB_OK);
        check_word(rb_case_settle(c, &why), &why, bad[k].part);
        CHECK_STATUS(rb_case_settle(c, NULL), RB_EINVAL);
        rb_case_free(c);
    }
}

/* Whatever reads a case for a purpose refuses the same words. */
static void a_purpose_refuses_what_means_nothing_to_it(void **state)
{
    (void)state;
    static const struct {
        rb_case_purpose purpose;
        const char *words, *part;
    } bad[] = {
        {RB_CASE_CURVE, "load=500 creep=0.1", "--creep: the curve runs over"},
        {RB_CASE_CURVE, "load=500 formulation=static", "one of steady rolling"},
        {RB_CASE_CURVE, "load=500 accuracy=0.1", "a curve has --error"},
        {RB_CASE_STRESS, "load=500 accuracy=0.1", "does not refine"},
        {RB_CASE_STUDY, "load=500 accuracy=0.01", "a study has --error"},
        {RB_CASE_STUDY, "load=500 formulation=transient distance=1",
         "--formulation: a study is one of static or steady cases"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        rb_message why = {""};
        rb_case *c = rb_case_create(bad[k].purpose);
        CHECK_STATUS(set_words(c, bad[k].words, &why), RB_OK);
        check_word(rb_case_settle(c, &why), &why, bad[k].part);
        rb_case_free(c);
    }
}

static void a_curve_takes_several_mu(void **state)
{
    (void)state;
    rb_message why = {""};
    rb_case *c = rb_case_create(RB_CASE_CURVE);
    CHECK_STATUS(set_words(c, "mu=0.1,0.2 load=500", &why), RB_OK);
    CHECK_STATUS(rb_case_settle(c, &why), RB_OK);
    assert_int_equal(rb_case_settled(c)->mus.n, 2);
    assert_int_equal(rb_case_settled(c)->rc.formulation, RB_STEADY);
    rb_case_free(c);
}

/* ---- Files ------------------------------------------------------------------------- */

static void files_are_blamed_by_line(void **state)
{
    (void)state;
    static const struct {
        const char *text, *part;
        rb_status status;
    } bad[] = {
        {"mu = 0.3\nloda = 5\n", "case.ini:2: unknown key 'loda' (did you mean 'load'?)",
         RB_EFORMAT},
        {"[normal]\nload = x\n", "case.ini:2: load: expected a number > 0, got 'x'",
         RB_EFORMAT},
        {"load = 4\napproach = 2\n",
         "case.ini:2: approach and case.ini:1: load exclude each other", RB_EFORMAT},
        {"load = 4\nforce = 10\n", "case.ini: force Q = 10", RB_EFORMAT},
        {"gap = nothere.txt\nload = 4\n", "nothere.txt", RB_ENOENT},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        rb_message why = {""};
        rb_case *c = rb_case_create(RB_CASE_SINGLE);
        write_file("case.ini", bad[k].text);
        rb_status s = rb_case_read(c, "case.ini", 0, NULL, &why);
        if (s == RB_OK)
            s = rb_case_settle(c, &why);
        if (s != bad[k].status || !strstr(why.text, bad[k].part))
            fail_msg("status %d, '%s', wanted '%s'", (int)s, why.text, bad[k].part);
        rb_case_free(c);
    }
}

static void an_argument_wins_over_the_file(void **state)
{
    (void)state;
    rb_message why = {""};
    rb_case *c = rb_case_create(RB_CASE_SINGLE);
    write_file("case.ini", "load = 4\nmu = 0.1\nyoung-b = 1000\n");
    CHECK_STATUS(set_words(c, "approach=0.01 mu=0.2 similar=yes", &why), RB_OK);
    CHECK_STATUS(rb_case_read(c, "case.ini", 0, NULL, &why), RB_OK);
    CHECK_STATUS(rb_case_settle(c, &why), RB_OK);
    const rb_settled_case *s = rb_case_settled(c);
    assert_true(isnan(s->rc.load) && s->rc.approach == 0.01 && s->rc.mu == 0.2);
    assert_true(s->rc.b.young == s->rc.a.young);
    rb_case_free(c);
}

/* ---- Copies ------------------------------------------------------------------------ */

/* What one case of a study settles must not stay in the next: neither mesh nor elements
 * nor what an option took back. */
static void a_copy_is_settled_from_its_words(void **state)
{
    (void)state;
    rb_message why = {""};
    rb_case *base = case_of("formulation=steady similar=yes support=halfplane load=500");
    rb_case *c = rb_case_copy(base);
    assert_int_equal(rb_case_settled(base)->rc.contact_elements, 100);
    CHECK_STATUS(rb_case_set_number(c, "zone", 4.0, &why), RB_OK);
    CHECK_STATUS(rb_case_settle(c, &why), RB_OK);
    assert_int_equal(rb_case_settled(c)->rc.mesh, RB_MESH_UNIFORM);
    assert_int_equal(rb_case_settled(c)->rc.contact_elements, 60);
    CHECK_STATUS(rb_case_set(c, "zone", "auto", RB_GIVEN_ARGUMENT, &why), RB_OK);
    CHECK_STATUS(rb_case_settle(c, &why), RB_OK);
    assert_int_equal(rb_case_settled(c)->rc.mesh, RB_MESH_FITTED);
    assert_true(rb_case_settled(base)->rc.zone == 0.0);
    rb_case_free(c);
    rb_case_free(base);
}

static double gap_at(const rb_case *c, double x)
{
    return rb_rolling_profile_gap(rb_case_settled(c)->rc.profile, x);
}

static void a_copy_borrows_the_files(void **state)
{
    (void)state;
    rb_message why = {""};
    write_file("gap.txt", "-5 0.25\n0 0\n5 0.25\n");
    write_file("other.txt", "-5 0.5\n-1 0.1\n0 0\n5 0.5\n");
    rb_case *base = case_of("gap=gap.txt load=500"), *c = rb_case_copy(base);
    CHECK_STATUS(rb_case_settle(c, &why), RB_OK);
    assert_ptr_equal(rb_case_settled(c)->rc.profile, rb_case_settled(base)->rc.profile);
    CHECK_STATUS(rb_case_set_number(c, "gap-smoothing", 0.5, &why), RB_OK);
    CHECK_STATUS(rb_case_settle(c, &why), RB_OK);
    assert_ptr_not_equal(rb_case_settled(c)->rc.profile,
                         rb_case_settled(base)->rc.profile);
    CHECK_ABS(gap_at(c, 5.0), 0.25, 1e-12, "a parabola smoothed");
    CHECK_STATUS(rb_case_set_number(c, "gap-smoothing", 0.0, &why), RB_OK);
    CHECK_STATUS(rb_case_set(c, "gap", "other.txt", RB_GIVEN_ARGUMENT, &why), RB_OK);
    CHECK_STATUS(rb_case_settle(c, &why), RB_OK);
    CHECK_ABS(gap_at(c, 5.0), 0.5, 1e-14, "the other file");
    rb_case_free(c);
    CHECK_ABS(gap_at(base, 5.0), 0.25, 1e-14, "its own file");
    rb_case_free(base);
}

/* ---- Memory ------------------------------------------------------------------------ */

static rb_status use_memory(void)
{
    rb_case *c = rb_case_create(RB_CASE_SINGLE), *copy = NULL;
    rb_status s =
        c ? rb_case_set(c, "gap", "gap.txt", RB_GIVEN_ARGUMENT, NULL) : RB_ENOMEM;
    if (s == RB_OK)
        s = rb_case_read(c, "case.ini", 0, NULL, NULL);
    if (s == RB_OK)
        s = rb_case_settle(c, NULL);
    if (s == RB_OK && !(copy = rb_case_copy(c)))
        s = RB_ENOMEM;
    rb_case_free(copy);
    rb_case_free(c);
    return s;
}

static void every_failing_allocation_is_told(void **state)
{
    (void)state;
    write_file("gap.txt", "-5 0.25\n0 0\n5 0.25\n");
    write_file("case.ini", "[normal]\nload = 500\n");
    int failures = 0;
    for (int count = 0;; count++) {
        alloc_fail_after(count);
        const rb_status s = use_memory();
        const int failed = alloc_failed();
        alloc_succeed();
        if (!failed)
            break;
        CHECK_STATUS(s, RB_ENOMEM);
        failures++;
    }
    assert_true(failures > 5);
    rb_case_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_words_give_the_same_answer),
        cmocka_unit_test(carter_by_names_is_on_the_fitted_mesh),
        cmocka_unit_test(every_option_describes_itself),
        cmocka_unit_test(a_value_survives_as_text),
        cmocka_unit_test(numbers_are_words_too),
        cmocka_unit_test(wrong_words_are_refused),
        cmocka_unit_test(contradictions_are_refused),
        cmocka_unit_test(a_purpose_refuses_what_means_nothing_to_it),
        cmocka_unit_test(a_curve_takes_several_mu),
        cmocka_unit_test(files_are_blamed_by_line),
        cmocka_unit_test(an_argument_wins_over_the_file),
        cmocka_unit_test(a_copy_is_settled_from_its_words),
        cmocka_unit_test(a_copy_borrows_the_files),
        cmocka_unit_test(every_failing_allocation_is_told),
    };
    return cmocka_run_group_tests(tests, enter, leave_folder);
}
