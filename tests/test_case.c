/* Cases by names: the table describes itself, words are set, resolved and refused, and
 * the same words give the same answer through the library and through the program. */
#include "cli_run.h"
#include "base/blas.h"
#include "rolling/case/case.h"
#include "rolling/case/closed_forms.h"

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
    rb_case *c = NOT_NULL(rb_case_create(RB_CASE_SINGLE));
    if (set_words(c, words, &message) != RB_OK || rb_case_resolve(c, &message) != RB_OK)
        fail_msg("%s: %s", words, message.text);
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
    snprintf(line, sizeof line, "%s%s%s%s --json --quiet", *file ? examples : "", *file ? "/" : "",
             file, options);
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
    OWNED(rb_case_result) r;
    held_case *c = rb_case_create(RB_CASE_SINGLE);
    snprintf(path, sizeof path, "%s/%s", examples, file);
    rb_status s = set_words(c, words, &message);
    if (s == RB_OK && *file)
        s = rb_case_read(c, path, &message);
    if (s == RB_OK)
        s = rb_case_resolve(c, &message);
    if (s != RB_OK || rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &message) != RB_OK)
        fail_msg("%s %s: %s", file, words, message.text);

    run_program(file, words);
    held_json *root = NOT_NULL(json_loads(out, 0, NULL));
    const json_t *table = json_object_get(root, "table");
    const rb_rolling_solution *got = &r.solution;
    assert_int_equal(json_array_size(json_object_get(table, "p_MPa")), got->n);
    compare_column(table, "x_mm", got->n, got->x);
    compare_column(table, "p_MPa", got->n, got->p);
    compare_column(table, "q_MPa", got->n, got->q);
    compare_column(table, "slip", got->n, got->slip);
}

/* Bit for bit: the examples as they stand, and words that leave choices to the settling. */
TEST(the_same_words_give_the_same_answer)
{
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
TEST(carter_by_names_is_on_the_fitted_mesh)
{
    OWNED(rb_case_result) r;
    held_case *c = case_of("similar=yes support=halfplane formulation=steady half-width=0.5 "
                           "creep-ratio=0.4 mu=0.3 radius=500");
    assert_int_equal(rb_case_resolved(c)->rc.mesh, RB_MESH_FITTED);
    CHECK_OK(rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &message));
    CHECK_ABS(r.solution.force_ratio, -0.64, 1e-4, "Carter: s (2 - s) at s = 0.4");
}

/* ---- The table --------------------------------------------------------------------- */

TEST(every_option_describes_itself)
{
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
TEST(a_value_survives_as_text)
{
    int n;
    const rb_option *o = rb_case_describe(&n);
    held_case *c = case_of(""), *again = case_of("");
    rb_resolved_case *words = rb_case_options(c).target;
    const rb_resolved_case *back = rb_case_options(again).target;
    for (int i = 0; i < n; i++) {
        char room[64], room2[64];
        if (o[i].kind == RB_OPTION_GROUP || o[i].unset) /* has no default value */
            continue;
        const char *text = rb_option_text(&o[i], words, room);
        CHECK_OK(rb_case_set(again, o[i].name, text, RB_GIVEN_ARGUMENT, &message));
        assert_string_equal(rb_option_text(&o[i], back, room2), text);
    }
}

TEST(numbers_are_words_too)
{
    held_case *c = case_of("load=500"), *by_number = case_of("");
    CHECK_OK(rb_case_set_number(by_number, "load", 500.0, &message));
    CHECK_OK(rb_case_set_number(by_number, "contact-elements", 40.0, &message));
    CHECK_OK(rb_case_resolve(by_number, &message));
    assert_true(rb_case_resolved(c)->rc.load == rb_case_resolved(by_number)->rc.load);
    assert_int_equal(rb_case_resolved(by_number)->rc.contact_elements, 40);
    assert_int_equal(rb_case_given(by_number, "load"), RB_GIVEN_NUMBER);
    assert_int_equal(rb_case_given(by_number, "mu"), 0);
}

/* ---- One value --------------------------------------------------------------------- */

typedef struct {
    double free, above, from, between, within, upto, below, most, word, list;
    rb_numbers all;
    int whole, choice, other, flag;
    const char *text, *file, *name;
} every_kind;

#define AT(member) offsetof(every_kind, member)

static const rb_choice fruit[] = {{"apple", 3}, {"pear", 5}, {NULL, 0}};
static const rb_option kinds[] = {
    RB_GROUP_LINE("kinds", "Kinds"),
    RB_NUMBER_LINE("free", AT(free), "", RB_ANY, ""),
    RB_NUMBER_LINE("above", AT(above), "", RB_ABOVE(1.0), ""),
    RB_NUMBER_LINE("from", AT(from), "", RB_FROM(1.0), ""),
    RB_NUMBER_LINE("between", AT(between), "", RB_BETWEEN(1.0, 2.0), ""),
    RB_NUMBER_LINE("within", AT(within), "", RB_FROM_TO(1.0, 2.0), ""),
    RB_NUMBER_LINE("upto", AT(upto), "", RB_ABOVE_UPTO(1.0, 2.0), ""),
    {.name = "below",
     .kind = RB_OPTION_NUMBER,
     .offset = AT(below),
     .unit = "",
     .range = {-INFINITY, 2.0, 1, 1}},
    {.name = "most",
     .kind = RB_OPTION_NUMBER,
     .offset = AT(most),
     .unit = "",
     .range = {-INFINITY, 2.0, 1, 0}},
    RB_NUMBER_LINE("word", AT(word), "mm", RB_FROM(0.0), "", .word = "auto", .word_value = -1.0),
    RB_NUMBER_LINE("list", AT(list), "mm", RB_FROM(0.0), "", .list = AT(all)),
    RB_INTEGER_LINE("whole", AT(whole), RB_FROM_TO(-3e9, 3e9), ""),
    RB_CHOICE_LINE("choice", AT(choice), fruit, ""),
    RB_CHOICE_LINE("other", AT(other), fruit, "", .path = AT(name), .path_value = 9,
                   .path_name = "FILE", .file = RB_FILE_READ),
    RB_FLAG_LINE("flag", AT(flag), ""),
    RB_TEXT_LINE("text", AT(text), "NAME", ""),
    RB_TEXT_LINE("file", AT(file), "FILE", "", .file = RB_FILE_WRITTEN)};

enum { KINDS = sizeof kinds / sizeof *kinds };

/* Both sides of every end, every word, and what stands for a value. */
TEST(values_are_taken_strictly)
{
    static const struct {
        const char *name, *good, *bad, *shown, *expected; /* by | */
    } all[] = {{"free", "-1e300|0|.5|1e3", "|x| 1|1 x|nan|inf|1e999|0x", "1000", "a number"},
               {"above", "1.001|9", "1|0.9", "9", "a number > 1"},
               {"from", "1|9", "0.999", "9", "a number >= 1"},
               {"between", "1.001|1.999", "1|2|3|0", "1.999", "a number in (1, 2)"},
               {"within", "1|2", "0.999|2.001", "2", "a number in [1, 2]"},
               {"upto", "1.001|2", "1|2.001", "2", "a number in (1, 2]"},
               {"below", "-5|1.999", "2|3", "1.999", "a number < 2"},
               {"most", "-5|2", "2.001", "2", "a number <= 2"},
               {"word", "3|auto", "-1|aut|auto ", "auto", "a number >= 0 or auto"},
               {"list", "0|1,2|1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16",
                "|,|1,|1,,2|-1|1,-1|1;2|1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17|"
                "1,00000000000000000000000000000000000000000000000000000000000000001",
                "1", "a number >= 0"},
               {"whole", "0|-7|2147483647|-2147483648",
                "| 1|1.0|1e3|x|2147483648|-2147483649|99999999999999999999", "-2147483648",
                "a whole number in [-3e+09, 3e+09]"},
               {"choice", "apple|pear", "|appl|apples|plum", "pear", "apple or pear"},
               {"other", "apple|plum|pear", "", "pear", "apple or pear"},
               {"flag", "no|true|false|yes", "|y|1|Yes", "yes", "yes or no"},
               {"text", "a|some words", "", "some words", "a name"}};
    every_kind values;
    int given[KINDS], plain[KINDS];
    const rb_option_set set = {kinds, KINDS, &values, given, plain};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        int at;
        char text[600], room[64], wanted[200];
        rb_message why = {.text = ""};
        rb_guess guess = {.word = all[k].name};
        assert_ptr_equal(rb_option_find(1, &set, all[k].name, strlen(all[k].name), &at, &guess),
                         &set);
        memset(&values, 0, sizeof values);
        for (int good = 1; good >= 0; good--) {
            snprintf(text, sizeof text, "%s", good ? all[k].good : all[k].bad);
            for (char *word = text, *end = word; end; word = end + 1) {
                end = strchr(word, '|');
                if (end)
                    *end = '\0';
                given[at] = plain[at] = 0;
                const rb_status s = rb_option_assign(&set, at, 7, "it", word, &why);
                if (s != (good ? RB_OK : RB_EINVAL) || given[at] != (good ? 7 : 0))
                    fail_msg("%s = '%s': status %d", all[k].name, word, s);
                if (!good && !strstr(why.text, "it: expected "))
                    fail_msg("%s = '%s': %s", all[k].name, word, why.text);
            }
            if (good) /* the last one */
                assert_string_equal(rb_option_text(&kinds[at], &values, room), all[k].shown);
        }
        assert_string_equal(rb_option_expected(&kinds[at], wanted, sizeof wanted), all[k].expected);
    }
}

static rb_status assign(const rb_option_set *set, const char *name, const char *text,
                        rb_message *why)
{
    int at;
    rb_guess guess = {.word = name};
    assert_non_null(rb_option_find(1, set, name, strlen(name), &at, &guess));
    return rb_option_assign(set, at, RB_GIVEN_ARGUMENT, "it", text, why);
}

/* Lists, units, files, and sets where nobody asks who gave what. */
TEST(values_are_kept_where_they_belong)
{
    every_kind v = {.free = NAN};
    int given[KINDS] = {0}, plain[KINDS] = {0};
    const rb_option_set set = {kinds, KINDS, &v, given, plain},
                        bare = {kinds, KINDS, &v, NULL, NULL};
    char room[64];
    const rb_option *list = kinds + 10, *other = kinds + 13, *file = kinds + 16;
    CHECK_OK(assign(&set, "list", "3,4,5", &message));
    assert_true(v.all.n == 3 && v.list == 3.0 && v.all.value[2] == 5.0);
    assert_int_equal(plain[list - kinds], 1);
    assert_int_equal(rb_option_given(&set, "list"), RB_GIVEN_ARGUMENT);
    assert_int_equal(rb_option_given(&set, "word"), 0);
    assert_int_equal(rb_option_given(&set, "kinds"), 0);
    assert_int_equal(rb_option_given(&set, "nothing"), 0);
    CHECK_OK(assign(&set, "list", "3cm,4m", &message));
    assert_true(v.all.n == 2 && v.list == 30.0 && v.all.value[1] == 4000.0);
    assert_int_equal(plain[list - kinds], 0);
    CHECK_STATUS(assign(&set, "list", "3cm,4", &message), RB_EINVAL);
    assert_string_equal(message.text, "it: expected a unit for each number or for none");
    CHECK_SAYS(assign(&set, "list", "3,4 parsec", &message), RB_EINVAL, "parsec");
    assert_true(v.all.n == 2); /* what is refused changes nothing */
    CHECK_OK(assign(&bare, "word", "2 in", &message));
    CHECK_REL(v.word, 50.8, 1e-15, "inches");
    assert_string_equal(rb_option_text(kinds + 1, &v, room), "");
    assert_string_equal(rb_option_text(file, &v, room), "");
    assert_null(rb_option_path(file, &v));
    assert_null(rb_option_path(kinds + 15, &v)); /* a text that names no file */
    CHECK_OK(assign(&set, "file", "f.txt", &message));
    assert_string_equal(rb_option_path(file, &v), "f.txt");
    CHECK_OK(assign(&set, "other", "g.txt", &message));
    assert_int_equal(v.other, 9);
    assert_string_equal(rb_option_path(other, &v), "g.txt");
    assert_string_equal(rb_option_text(other, &v, room), "g.txt");
    CHECK_STATUS(assign(&set, "other", "", &message), RB_EINVAL);
    CHECK_OK(assign(&set, "other", "apple", &message));
    assert_null(rb_option_path(other, &v));
    CHECK_STATUS(assign(&set, "text", "", &message), RB_EINVAL);
    CHECK_OK(assign(&set, "flag", "false", &message));
    assert_string_equal(rb_option_text(kinds + 14, &v, room), "no");
    assert_string_equal(rb_option_text(kinds, &v, room), "");
    v.choice = 99;
    assert_string_equal(rb_option_text(kinds + 12, &v, room), "");
    assert_string_equal(rb_option_expected(kinds, room, sizeof room), "a name");
    double x;
    assert_true(rb_option_number("-2.5e1", &x) && x == -25.0);
    assert_false(rb_option_number("", &x) || rb_option_number("\t1", &x) ||
                 rb_option_number("1x", &x) || rb_option_number("inf", &x));
}

TEST(names_that_are_none_are_said)
{
    held_case *c = case_of("");
    assert_null(rb_case_word("support", 99));
    assert_string_equal(rb_case_word("formulation", RB_STEADY), "steady");
    assert_int_equal(rb_case_given(c, "nothing"), 0);
    CHECK_SAYS(rb_case_set_number(c, "lood", 3.0, &message), RB_EINVAL, "'load'?");
}

/* ---- Cases of CONTACT -------------------------------------------------------------- */

/* Steel on steel, rolling by CKSI under FN, 60 elements of 0.05. */
static const rb_io_contact_case steel = {.module = 3,
                                         .digit = {.P = 2, .T = 3, .N = 1, .D = 2, .C = 2, .Z = 2},
                                         .normal = 25000.0,
                                         .tangential = -4e-4,
                                         .fstat = 0.25,
                                         .fkin = 0.25,
                                         .dq = 0.05,
                                         .velocity = 1000.0,
                                         .poisson = {0.3, 0.28},
                                         .shear = {82000.0, 81000.0},
                                         .potential = 1,
                                         .mx = 60,
                                         .my = 1,
                                         .from = -1.0,
                                         .dx = 0.05,
                                         .dy = 100.0,
                                         .base = 1,
                                         .plan = 1,
                                         .b = {1.0 / 600.0}};

TEST(cases_of_contact_are_our_own)
{
    rb_case_contact c;
    rb_io_contact_case in = steel;
    rb_case_from_contact(&in, &c);
    assert_true(c.runs && !c.left_out[0] && c.sign == 1.0 && c.centre == 0.0);
    assert_true(c.rc.formulation == RB_STEADY && c.rc.creep == -4e-4);
    assert_true(isnan(c.rc.force_ratio) && isnan(c.rc.shift) && isnan(c.rc.approach));
    CHECK_REL(c.rc.load, 250.0, 1e-15, "FN/DY");
    CHECK_REL(c.rc.a.radius, 300.0, 1e-15, "1/(2 B1)");
    CHECK_REL(c.rc.a.young, 2.0 * 82000.0 * 1.3, 1e-15, "E of A");
    CHECK_REL(c.rc.b.young, 2.0 * 81000.0 * 1.28, 1e-15, "E of B");
    CHECK_REL(c.rc.a.strip, 100.0, 1e-15, "DY");
    CHECK_REL(c.from, -1.0, 1e-15, "XL");
    CHECK_REL(c.to, 2.0, 1e-15, "XL + MX DX");
    CHECK_REL(c.rc.zone, 1.5, 1e-15, "half of it");
    assert_true(c.rc.mu == 0.25 && c.rc.contact_elements == 60);

    in.b[3] = -1.0 / 300.0; /* the lowest point at 1 */
    in.chi = 180.0;         /* and the mirror image */
    rb_case_from_contact(&in, &c);
    CHECK_REL(c.centre, 1.0, 1e-15, "-B4/(2 B1)");
    assert_true(c.sign == -1.0 && c.rc.creep == 4e-4);
    CHECK_REL(c.from, -1.0, 1e-14, "-(2 - 1)");
    CHECK_REL(c.to, 2.0, 1e-14, "-(-1 - 1)");
    in.chi = 90.0;
    rb_case_from_contact(&in, &c);
    assert_true(c.sign == 1.0);
    in.chi = 450.0; /* as 90 */
    rb_case_from_contact(&in, &c);
    assert_true(c.sign == 1.0);
    in.chi = -180.0;
    rb_case_from_contact(&in, &c);
    assert_true(c.sign == -1.0);

    in = steel;
    in.chi = 180.0; /* nothing rolls: no direction */
    in.digit.T = 1;
    in.digit.F = 1;
    rb_case_from_contact(&in, &c);
    assert_true(c.runs && c.sign == 1.0 && c.rc.formulation == RB_STATIC);
    assert_true(c.rc.force_ratio == -4e-4 && isnan(c.rc.shift) && isnan(c.rc.creep));
    in.digit.F = 0;
    in.digit.N = 0;
    in.normal = 0.01;
    rb_case_from_contact(&in, &c);
    assert_true(c.rc.shift == -4e-4 && isnan(c.rc.force_ratio));
    assert_true(c.rc.approach == 0.01 && isnan(c.rc.load));
    in.digit.T = 0; /* without friction */
    in.fkin = 0.2;
    in.side = 0.1;
    rb_case_from_contact(&in, &c);
    assert_true(c.runs && !c.left_out[0] && c.rc.mu == 0.0 && c.rc.shift == 0.0);
    in.law = 2;
    rb_case_from_contact(&in, &c);
    assert_true(c.rc.mu == 0.0 && c.rc.friction.law == RB_FRICTION_constant);

    in = steel;
    in.base = 2;
    in.centre = 0.5;
    in.radius = 460.0;
    in.digit.T = 3;
    in.digit.F = 1;
    rb_case_from_contact(&in, &c);
    assert_true(c.rc.gap == RB_GAP_EXACT && c.rc.a.radius == 460.0 && c.centre == 0.5);
    assert_true(c.rc.force_ratio == -4e-4 && isnan(c.rc.creep));

    /* Hertz's line contact by its curvature, and by the half-length that it leads to. */
    const double modulus = 1.0 / (0.7 / (2.0 * 82000.0) + 0.72 / (2.0 * 81000.0));
    const double a = rb_closed_hertz_half_width(250.0, 300.0, modulus);
    in = steel;
    for (in.potential = -4; in.potential >= -5; in.potential--) {
        in.hertz[0] = in.potential == -4 ? 1.0 / 600.0 : a;
        in.hertz[1] = 50.0;
        in.hertz[2] = 1.2;
        rb_case_from_contact(&in, &c);
        CHECK_REL(c.rc.a.radius, 300.0, 1e-14, "IPOTCN = %d", in.potential);
        CHECK_REL(c.to, 1.2 * a, 1e-14, "IPOTCN = %d", in.potential);
        CHECK_REL(c.from, -1.2 * a, 1e-14, "IPOTCN = %d", in.potential);
    }
}

TEST(materials_and_laws_of_contact)
{
    static const rb_rolling_friction_law laws[] = {RB_FRICTION_linear, RB_FRICTION_rational,
                                                   RB_FRICTION_exponential};
    rb_case_contact c;
    rb_io_contact_case in = steel;
    for (int law = 2; law <= 4; law++) {
        in = steel;
        in.law = law;
        in.fstat = 0.45;
        in.fall[0] = 0.2;
        in.slip_scale[1] = 7.0;
        in.memory = law == 3 ? 0.1 : 0.0;
        in.memory_slip = 0.5;
        rb_case_from_contact(&in, &c);
        assert_true(c.runs && !c.left_out[0]);
        assert_true(c.rc.mu == 0.25 && c.rc.speed == 1000.0);
        assert_int_equal(c.rc.friction.law, laws[law - 2]);
        assert_true(c.rc.friction.fall[0] == 0.2 && c.rc.friction.slip_scale[1] == 7.0);
        assert_true(c.rc.friction.memory_slip == (law == 3 ? 0.5 : 0.0));
    }
    in = steel;
    in.digit.M = 1;
    in.ratio[0] = 0.5;
    in.time[0] = 0.2;
    in.ratio[1] = 0.5;
    rb_case_from_contact(&in, &c);
    assert_true(c.rc.a.memory.n == 1 && c.rc.a.memory.time[0] == 0.2);
    assert_true(c.rc.a.memory.ratio[0] == 0.5 && c.rc.speed == 1000.0);
    CHECK_REL(c.rc.b.young, 2.0 * 81000.0 * 1.28 / 1.5, 1e-15, "relaxed at once");
    assert_int_equal(c.rc.b.memory.n, 0);
    in.ratio[0] = 0.0;
    rb_case_from_contact(&in, &c);
    assert_int_equal(c.rc.a.memory.n, 0);
    in = steel;
    in.digit.M = 4;
    in.layer = 0.02;
    in.layer_shear = 800.0;
    in.hardening = 5.0;
    rb_case_from_contact(&in, &c);
    CHECK_REL(c.rc.interlayer_tangential, 0.02 / 800.0, 1e-15, "LAYTHK/GG3");
    assert_true(c.rc.yield_stress == 0.0 && c.rc.hardening == 0.0);
    in.yield = 30.0;
    rb_case_from_contact(&in, &c);
    assert_true(c.rc.yield_stress == 30.0 && c.rc.hardening == 5.0);
    in.layer = in.layer_shear = 0.0;
    rb_case_from_contact(&in, &c);
    assert_true(c.rc.interlayer_tangential == 0.0);
}

/* Every clause in turn, and all that a case that is run can have at once. */
TEST(what_contact_has_besides_is_listed)
{
    rb_case_contact c;
    rb_io_contact_case in = steel;
    in.fstat = 0.3;
    in.law = 5;
    in.spin = 1e-3;
    in.dq = 0.0506;
    in.plan = 2;
    in.digit.H = 1;
    in.digit.E = 2;
    rb_case_from_contact(&in, &c);
    assert_true(c.runs);
    assert_string_equal(
        c.left_out,
        "another friction law (L = 5): mu = 0.3, its value at rest; CETA, FY and "
        "CPHI; the step DQ = 0.0506: slip is that over an element, DX = 0.05; the planform "
        "(IPLAN = 2); temperatures (H = 1); the rigid slip per element (E = 2)");
    in = steel;
    in.dq = 0.0504; /* within a hundredth */
    in.digit.E = 1;
    in.law = 2;
    in.fstat = 0.3;
    rb_case_from_contact(&in, &c);
    assert_string_equal(c.left_out, "");
    in.law = 1;
    in.side = 1e-9;
    rb_case_from_contact(&in, &c);
    assert_string_equal(c.left_out, "another friction law (L = 1): mu = 0.3, its value "
                                    "at rest; CETA, FY and CPHI");
    in = steel;
    in.from = 1e300;
    rb_case_from_contact(&in, &c);
    assert_false(c.runs);
    assert_string_equal(c.left_out, "a potential contact at 1e+300 without width beside 0");
}

/* -sum |q| (|shift| - what the third body takes) over DY V; the element behind the last
 * has not yielded. */
TEST(friction_power_is_that_of_contact)
{
    double q[] = {2.0, -3.0, 4.0}, shift[] = {0.1, -0.2, 0.3}, plastic[] = {0.05, 0.03, 0.02};
    double x[] = {0.0, 0.1, 0.2}, h[] = {0.1, 0.1, 0.1}, former[] = {0.01, 0.02, 0.015};
    rb_io_contact_case in = steel;
    rb_case_contact c;
    rb_case_from_contact(&in, &c);
    rb_rolling_solution s = {.n = 3, .x = x, .h = h, .q = q, .shift = shift};
    CHECK_REL(rb_case_contact_power(&in, &c, NULL, &s), -(0.2 + 0.6 + 1.2) * 100.0, 1e-14, "W");
    s.plastic = plastic;
    CHECK_REL(rb_case_contact_power(&in, &c, NULL, &s),
              -(2.0 * 0.08 + 3.0 * 0.19 + 4.0 * 0.28) * 100.0, 1e-14, "yielding");
    /* a step of half an element: what had yielded comes from between the midpoints */
    const rb_rolling_solution before = {
        .n = 3, .x = x, .h = h, .q = q, .shift = shift, .plastic = former};
    in.digit.T = 2;
    c.goes_on = 1;
    c.step = 0.05;
    CHECK_REL(rb_case_contact_power(&in, &c, &before, &s),
              -2.0 *
                  (2.0 * (0.1 - 0.05 + 0.015) + 3.0 * (0.2 - 0.03 + 0.0175) +
                   4.0 * (0.3 - 0.02 + 0.0075)) *
                  100.0,
              1e-13, "a step");
    in.digit.T = 1;
    assert_true(isnan(rb_case_contact_power(&in, &c, NULL, &s)));
}

/* ---- Refusals ---------------------------------------------------------------------- */

static void check_word(rb_status s, const rb_message *why, const char *part)
{
    if (s != RB_EINVAL || !strstr(why->text, part))
        fail_msg("status %d, '%s', wanted '%s'", (int)s, why->text, part);
}

TEST(wrong_words_are_refused)
{
    held_case *c = case_of("");
    check_word(rb_case_set(c, "lood", "3", RB_GIVEN_ARGUMENT, &message), &message, "'load'?");
    check_word(rb_case_set(c, "load", "-3", RB_GIVEN_ARGUMENT, &message), &message,
               "--load: expected a number > 0, got '-3'");
    check_word(rb_case_set(c, "body-a", "3", RB_GIVEN_ARGUMENT, &message), &message, "body-a");
    check_word(rb_case_set_number(c, "load", NAN, &message), &message, "load: expected");
    check_word(rb_case_set_number(c, "support", 1.0, &message), &message, "takes no number");
    check_word(rb_case_set_number(c, "steps", 1.5, &message), &message, "whole number");
    CHECK_STATUS(rb_case_set(c, "load", "x", 7, NULL), RB_EFORMAT);
    assert_int_equal(rb_case_given(c, "load"), 0);
}

TEST(contradictions_are_refused)
{
    static const struct {
        const char *words, *part;
    } bad[] = {
        {"load=3 approach=1", "--approach and --load exclude each other"},
        {"poisson-b=0.2", "body B is rigid"},
        {"formulation=transient", "needs --distance or --history"},
        {"steps=4", "it needs transient rolling"},
        {"mu=0.1,0.2", "a curve takes several"},
        {"accuracy=1e-3 formulation=transient distance=1", "cases without steps"},
        {"force-ratio=1.5", "at most 1"},
        {"gap-smoothing=0.1", "it needs a gap from a file"},
        {"memory=1", "--memory: only for friction that changes"},
        {"friction-law=linear mu-fall=0.1 slip-scale=9 speed=3 memory=1,2,3",
         "--memory: expected 1 or 2 numbers, got 3"},
        {"friction-law=linear mu-fall=0.1,0.1,0.1 slip-scale=9,9,9 speed=3",
         "--mu-fall: expected 1 or 2 numbers, got 3"},
        {"friction-law=linear mu-fall=0.1 slip-scale=9,9 speed=3",
         "--mu-fall: expected as many numbers as --slip-scale has, 2, got 1"},
        {"friction-law=linear speed=3", "needs --mu-fall and --slip-scale"},
        {"mu-fall=0.1", "--mu-fall: only for velocity-dependent friction"},
        {"slip-scale=1", "--slip-scale: only for velocity-dependent friction"},
        {"mu-heat=0.1,20", "--mu-heat: expected 3 numbers, got 2"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        held_case *c = rb_case_create(RB_CASE_SINGLE);
        CHECK_OK(set_words(c, bad[k].words, &message));
        check_word(rb_case_resolve(c, &message), &message, bad[k].part);
        CHECK_STATUS(rb_case_resolve(c, NULL), RB_EINVAL);
    }
}

/* Whatever reads a case for a purpose refuses the same words. */
TEST(a_purpose_refuses_what_means_nothing_to_it)
{
    static const struct {
        rb_case_purpose purpose;
        const char *words, *part;
    } bad[] = {
        {RB_CASE_CURVE, "load=500 creep=0.1", "--creep: a curve varies it"},
        {RB_CASE_CURVE, "load=500 formulation=static", "needs steady rolling"},
        {RB_CASE_CURVE, "load=500 accuracy=0.1", "a curve has --error"},
        {RB_CASE_STRESS, "load=500 accuracy=0.1", "but no refinement"},
        {RB_CASE_STUDY, "load=500 accuracy=0.01", "a study has error bars"},
        {RB_CASE_STUDY, "load=500 formulation=transient distance=1",
         "--formulation: a study needs static or steady cases"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        held_case *c = rb_case_create(bad[k].purpose);
        CHECK_OK(set_words(c, bad[k].words, &message));
        check_word(rb_case_resolve(c, &message), &message, bad[k].part);
    }
}

TEST(a_curve_takes_several_mu)
{
    held_case *c = rb_case_create(RB_CASE_CURVE);
    CHECK_OK(set_words(c, "mu=0.1,0.2 load=500", &message));
    CHECK_OK(rb_case_resolve(c, &message));
    assert_int_equal(rb_case_resolved(c)->mus.n, 2);
    assert_int_equal(rb_case_resolved(c)->rc.formulation, RB_STEADY);
}

/* ---- Files ------------------------------------------------------------------------- */

TEST(files_are_blamed_by_line)
{
    static const struct {
        const char *text, *part;
        rb_status status;
    } bad[] = {
        {"mu = 0.3\nloda = 5\n", "case.ini:2: unknown key 'loda' (did you mean 'load'?)",
         RB_EFORMAT},
        {"[normal]\nload = x\n", "case.ini:2: load: expected a number > 0, got 'x'", RB_EFORMAT},
        {"load = 4\napproach = 2\n", "case.ini:2: approach and case.ini:1: load exclude each other",
         RB_EFORMAT},
        {"load = 4\nforce = 10\n", "case.ini:2: force: Q = 10", RB_EFORMAT},
        {"support = halfplane\nload = 4\nradius = 50\nsimilar = yes\nradius-b = -30\n",
         "case.ini:5: radius-b: a bore", RB_EFORMAT},
        {"load = 4\nrelaxation-time = 2\n", "case.ini:2: relaxation-time: expected as many numbers",
         RB_EFORMAT},
        {"support = halfplane\nload = 4\nzone = 1e30\n", "case.ini:3: zone: 1e+30 mm", RB_EFORMAT},
        {"support = halfplane\nload = 4\nforce-ratio = 3\nformulation = steady\n",
         "case.ini:3: force-ratio: Q/(mu P) = 3", RB_EFORMAT},
        {"load = 4\nconductivity = 50\n", "case.ini:2: conductivity: ", RB_EFORMAT},
        {"gap = nothere.txt\nload = 4\n", "nothere.txt", RB_ENOENT},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        rb_message why = {.text = ""};
        held_case *c = rb_case_create(RB_CASE_SINGLE);
        write_file("case.ini", bad[k].text);
        rb_status s = rb_case_read(c, "case.ini", &why);
        if (s == RB_OK)
            s = rb_case_resolve(c, &why);
        if (s != bad[k].status || !strstr(why.text, bad[k].part))
            fail_msg("status %d, '%s', wanted '%s'", (int)s, why.text, bad[k].part);
    }
}

/* What the library says of a row is said of the file and its line. */
TEST(rows_are_blamed_by_file_and_line)
{
    static const struct {
        const char *words, *text, *part;
    } bad[] = {
        {"formulation=transient creep=0.1 history=", "# way\ndistance load\n0 3\n1 -2\n",
         "rows.txt:4: load: expected a number >= 0, got -2"},
        {"load=3 gap=", "-1 1\n0 0\n0 0.5\n1 1\n",
         "rows.txt:3: expected an x larger than in the row before"},
        {"load=3 gap=", "-1 1\n1 1\n", "rows.txt: "},
        {"load=3 worn=", "-5 0\n0 0.01\n-1 0.01\n5 0\n", "rows.txt:3: expected finite"},
        {"load=3 friction-law=", "-5 0.1\n0 -0.1\n5 0.3\n",
         "rows.txt:2: expected mu >= 0, got -0.1"},
        {"formulation=transient creep=0.1 distance=1 load=3 irregularity=", "0 0\n1 0.1\n\n1 0\n",
         "rows.txt:4: expected an x larger"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        char words[300];
        rb_message why = {.text = ""};
        held_case *c = rb_case_create(RB_CASE_SINGLE);
        write_file("rows.txt", bad[k].text);
        snprintf(words, sizeof words, "support=halfplane %srows.txt", bad[k].words);
        CHECK_OK(set_words(c, words, &why));
        OWNED(rb_case_result) r = {.has_errors = 0};
        rb_status s = rb_case_resolve(c, &why);
        if (s == RB_OK) /* a way is looked at when it begins */
            s = rb_case_locate(c, rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &why), &why);
        if (s != RB_EFORMAT || strncmp(why.text, bad[k].part, strlen(bad[k].part)) != 0)
            fail_msg("status %d, '%s', wanted '%s'", (int)s, why.text, bad[k].part);
    }
}

/* Lines of a case file, or words of a command line, or numbers of a program: every refusal names
 * the option that is wrong by the place where it was given, and by no other one of which it speaks.
 */
static rb_status blame(const char *words, int how, char *line_of[], rb_message *why)
{
    char text[500], file[600] = "";
    rb_status s = RB_OK;
    int n = 0;
    held_case *c = rb_case_create(RB_CASE_SINGLE);
    snprintf(text, sizeof text, "%s", words);
    for (char *word = strtok(text, " "); word && s == RB_OK; word = strtok(NULL, " ")) {
        char *value = strchr(word, '=');
        *value++ = '\0';
        if (how == 0)
            rb_append(file, sizeof file, "%s = %s\n", word, value);
        else
            s = rb_case_set(c, word, value, how, why);
        snprintf(line_of[n++], 40, "%s", word);
    }
    *line_of[n] = '\0';
    if (how == 0 && s == RB_OK) {
        write_file("case.ini", file);
        s = rb_case_read(c, "case.ini", why);
    }
    if (s == RB_OK)
        s = rb_case_resolve(c, why);
    OWNED(rb_case_result) r = {.has_errors = 0};
    if (s == RB_OK)
        s = rb_case_locate(c, rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, why), why);
    return s;
}

static void check_blame(const char *words, const char *option)
{
    char names[20][40], *line_of[20], place[100];
    for (int k = 0; k < 20; k++)
        line_of[k] = names[k];
    for (int how = 0; how < 3; how++) {
        static const int by[] = {0, RB_GIVEN_ARGUMENT, RB_GIVEN_NUMBER};
        rb_message why = {.text = ""};
        const rb_status s = blame(words, by[how], line_of, &why);
        int line = 0;
        while (*names[line] && strcmp(names[line], option) != 0)
            line++;
        if (how == 0)
            snprintf(place, sizeof place, "case.ini:%d: %s: ", line + 1, option);
        else
            snprintf(place, sizeof place, how == 1 ? "--%s: " : "%s: ", option);
        if (s != (how == 0 ? RB_EFORMAT : RB_EINVAL) ||
            strncmp(why.text, place, strlen(place)) != 0)
            fail_msg("%s: status %d, '%s', wanted '%s'", words, (int)s, why.text, place);
    }
}

TEST(every_bad_value_is_blamed_where_it_was_given)
{
    static const char *const numbers[] = {"-1", "0", "2", "91", "-1e9", "1e9", "x"};
    int options = 0;
    for (const rb_option *o = rb_case_table; o < rb_case_table + rb_case_table_n; o++) {
        const int is_number = o->kind == RB_OPTION_NUMBER || o->kind == RB_OPTION_INTEGER;
        if (!is_number && o->kind != RB_OPTION_CHOICE && o->kind != RB_OPTION_FLAG)
            continue;
        if (o->path) /* any other word is the name of a file */
            continue;
        for (size_t k = is_number ? 0 : 6; k < sizeof numbers / sizeof *numbers; k++) {
            char words[200];
            if (k < 6 && rb_option_in_range(o, strtod(numbers[k], NULL)))
                continue;
            snprintf(words, sizeof words, "%s=%s", o->name, numbers[k]);
            check_blame(words, o->name);
        }
        options++;
    }
    assert_true(options > 70);
}

/* A message is read where something failed alone: whoever asks only whether a case can be resolved
 * leaves it as it is, without an end. */
TEST(success_reads_no_message)
{
    rb_case *c = NOT_NULL(rb_case_create(RB_CASE_SINGLE));
    rb_message untouched, before;
    CHECK_OK(set_words(c, "units=inch similar=yes support=halfplane load=100", &message));
    for (size_t i = 0; i < sizeof untouched.text; i++)
        untouched.text[i] = "1 mm "[i % 5];
    before = untouched;
    CHECK_OK(rb_case_resolve(c, &untouched));
    assert_memory_equal(untouched.text, before.text, sizeof before.text);
    rb_case_free(c);
}

TEST(what_a_refusal_speaks_of_is_not_what_it_blames)
{
    static const char *const bad[][2] = {
        /* the text says --support, --formulation, --load, --speed, which are given, too */
        {"support=halfplane load=4 cover-thickness=1", "cover-thickness"},
        {"support=arc load=4 bulk-stress=1", "bulk-stress"},
        {"formulation=steady support=halfplane creep=0.01 load=4 tilt=0.01", "tilt"},
        {"formulation=steady creep=0.1 load=4 period=10 support=halfplane", "period"},
        {"mu=0.2 load=4 force=10", "force"},
        {"support=halfplane load=4 formulation=steady force-ratio=3", "force-ratio"},
        {"formulation=steady mu=0 load=4 creep-ratio=0.5", "creep-ratio"},
        {"support=halfplane load=4 zone=1e30", "zone"},
        {"support=halfplane load=4 radius=50 similar=yes radius-b=-30", "radius-b"},
        {"similar=yes support-b=hub load=4 radius-b=plane", "support-b"},
        {"plane=stress load=4 poisson=-0.7", "poisson"},
        {"young-b=900 plane=stress load=4 poisson=0.3 poisson-b=-0.7", "poisson-b"},
        {"support=halfplane plane=stress load=4 layer-thickness=1 base-young=9 base-poisson=-0.7",
         "base-poisson"},
        {"support=hub radius=50 load=4 cover-thickness=60", "cover-thickness"},
        {"support=hub load=4 layer-thickness=1", "layer-thickness"},
        {"load=4 relaxation-time=2", "relaxation-time"},
        {"load=4 relaxation-ratio=2", "relaxation-ratio"},
        {"support=halfplane creep=0.1 formulation=steady load=4 relaxation-time=1 "
         "relaxation-ratio=1",
         "relaxation-time"},
        {"creep=0.1 load=4 formulation=transient", "formulation"},
        {"load=4 support=halfplane gap=wave", "gap"},
        {"load=4 support=halfplane period=1 amplitude=0.1 radius-b=9 young-b=9", "radius-b"},
        {"mesh=aligned formulation=steady creep=0.1 load=4 support=halfplane contact-elements=10",
         "contact-elements"},
        {"support=halfplane formulation=static load=4 slip-operator=second", "slip-operator"},
        {"mesh=fitted formulation=steady creep=0.1 load=4 support=halfplane slip-operator=second",
         "slip-operator"},
        {"load=4 hardening=1", "hardening"},
        {"friction-law=linear mu-fall=0.1 slip-scale=1 speed=3 formulation=steady creep=0.1 load=4 "
         "yield-stress=1",
         "yield-stress"},
        {"friction-law=linear mu-fall=0.1 slip-scale=1 formulation=steady creep=0.1 load=4",
         "friction-law"},
        {"support=halfplane load=4 normals=surface", "normals"},
        {"support=halfplane load=4 bulk-stress-b=1", "bulk-stress-b"},
        {"formulation=steady creep=0.1 load=4 increments=4", "increments"},
        {"formulation=steady creep=0.1 load=4 conductivity=50", "conductivity"},
        {"formulation=static load=4 heat-capacity=4 speed=1 conductivity=50", "conductivity"},
        {"load=4 transverse-radius=10", "transverse-radius"},
        {"gap=exact support=halfplane transverse-radius=10 wheel-load=10", "wheel-load"},
        {"radius=50 half-width=60", "half-width"},
        {"radius=50 approach=1e-200", "approach"},
        {"radius=50 load=1e200", "load"},
        {"load=4 young=1e120", "young"},
        {"load=4 similar=yes support=halfplane radius-b=1e120", "radius-b"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
        check_blame(bad[k][0], bad[k][1]);
}

/* Files with the same layers make the same body. */
TEST(layers_are_those_that_a_file_holds)
{
    write_file("a.txt", "thickness young poisson\n0.5 900 0.3\n1 500 0.3\n");
    write_file("b.txt", "# the same\nthickness\tyoung\tpoisson\n0.5 9e2 .3\n1.0 500 0.3\n");
    write_file("other.txt", "thickness young poisson\n0.5 900 0.3\n1 501 0.3\n");
    for (int k = 0; k < 2; k++) {
        held_case *c = rb_case_create(RB_CASE_SINGLE);
        CHECK_OK(set_words(c, "support=halfplane load=5 mu=0 layers=a.txt", &message));
        CHECK_OK(
            rb_case_set(c, "layers-b", k ? "other.txt" : "b.txt", RB_GIVEN_ARGUMENT, &message));
        CHECK_OK(rb_case_resolve(c, &message));
        const rb_rolling_case *rc = &rb_case_resolved(c)->rc;
        assert_true(rc->a.stack != NULL);
        assert_int_equal(rc->a.stack == rc->b.stack, k == 0);
    }
}

/* A column in the place of an option of the command line, which is named. */
TEST(a_column_excludes_its_option)
{
    static const char *const columns[][2] = {
        {"mu", "mu"}, {"load", "load"}, {"load", "approach"}, {"creep", "creep-ratio"}};
    for (size_t k = 0; k < sizeof columns / sizeof *columns; k++) {
        char text[100], words[100], wanted[100];
        held_case *c = rb_case_create(RB_CASE_SINGLE);
        snprintf(text, sizeof text, "distance %s\n0 0.1\n1 0.2\n", columns[k][0]);
        write_file("way.txt", text);
        snprintf(words, sizeof words, "formulation=transient history=way.txt %s=0.3",
                 columns[k][1]);
        snprintf(wanted, sizeof wanted, "--%s: the history has a column %s", columns[k][1],
                 columns[k][0]);
        CHECK_OK(set_words(c, words, &message));
        CHECK_STATUS(rb_case_resolve(c, &message), RB_EINVAL);
        assert_string_equal(message.text, wanted);
    }
}

/* Solution, error bars and steps have the same units. */
TEST(all_of_a_result_is_converted)
{
    static const char *const words[] = {
        "support=halfplane load=100 contact-elements=12 error=yes",
        "support=halfplane load=100 contact-elements=10 formulation=transient "
        "creep-ratio=0.5 distance=1"};
    for (int k = 0; k < 2; k++) {
        held_case *c = case_of(words[k]);
        OWNED(rb_case_result) r;
        if (rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &message) != RB_OK)
            fail_msg("%s: %s", words[k], message.text);
        const double load = r.solution.normal_load, bar = r.errors.scalar.approach;
        const double step = k ? r.history.step : NAN, p = r.solution.p[4];
        rb_case_result_convert(&r, RB_UNITS_SI);
        CHECK_REL(r.solution.normal_load, 1e3 * load, 1e-14, "N/m");
        CHECK_REL(r.solution.p[4], 1e6 * p, 1e-14, "Pa");
        if (k == 0)
            CHECK_REL(r.errors.scalar.approach, 1e-3 * bar, 1e-14, "bar in m");
        else
            CHECK_REL(r.history.step, 1e-3 * step, 1e-14, "step in m");
    }
}

/* A caller's own options stand beside those of the case; who gave them it need not ask. */
TEST(own_options_are_read_beside_the_case)
{
    double own = 0.0;
    static const rb_option options[] = {RB_GROUP_LINE("own", "Own"),
                                        RB_NUMBER_LINE("weight", 0, "", RB_ANY, "")};
    const rb_option_set set = {options, 2, &own, NULL, NULL};
    held_case *c = rb_case_create(RB_CASE_SINGLE);
    write_file("own.ini", "mu = 0.2\n[own]\nweight = 2\n");
    CHECK_OK(rb_case_read_with(c, "own.ini", 1, &set, &message));
    CHECK_OK(rb_case_resolve(c, &message));
    CHECK_ABS(own, 2.0, 0.0, "own");
    CHECK_ABS(rb_case_resolved(c)->rc.mu, 0.2, 0.0, "mu");
    CHECK_STATUS(rb_option_assign(&set, 0, 1, "own", "1", &message), RB_EINVAL);
    write_file("own.ini", "[own]\nmu = 0.2\n");
    CHECK_SAYS(rb_case_read_with(c, "own.ini", 1, &set, &message), RB_EFORMAT,
               "own.ini:2: key 'mu' belongs to section");
}

TEST(an_argument_wins_over_the_file)
{
    held_case *c = rb_case_create(RB_CASE_SINGLE);
    write_file("case.ini", "load = 4\nmu = 0.1\nyoung-b = 1000\n");
    CHECK_OK(set_words(c, "approach=0.01 mu=0.2 similar=yes", &message));
    CHECK_OK(rb_case_read(c, "case.ini", &message));
    CHECK_OK(rb_case_resolve(c, &message));
    const rb_resolved_case *s = rb_case_resolved(c);
    assert_true(isnan(s->rc.load) && s->rc.approach == 0.01 && s->rc.mu == 0.2);
    assert_true(s->rc.b.young == s->rc.a.young);
}

/* ---- Copies ------------------------------------------------------------------------ */

/* What one case of a study resolves must not stay in the next: neither mesh nor elements
 * nor what an option took back. */
TEST(a_copy_is_settled_from_its_words)
{
    held_case *base = case_of("formulation=steady similar=yes support=halfplane load=500");
    held_case *c = rb_case_copy(base);
    assert_int_equal(rb_case_resolved(base)->rc.contact_elements, 100);
    CHECK_OK(rb_case_set_number(c, "zone", 4.0, &message));
    CHECK_OK(rb_case_resolve(c, &message));
    assert_int_equal(rb_case_resolved(c)->rc.mesh, RB_MESH_UNIFORM);
    assert_int_equal(rb_case_resolved(c)->rc.contact_elements, 60);
    CHECK_OK(rb_case_set(c, "zone", "auto", RB_GIVEN_ARGUMENT, &message));
    CHECK_OK(rb_case_resolve(c, &message));
    assert_int_equal(rb_case_resolved(c)->rc.mesh, RB_MESH_FITTED);
    assert_true(rb_case_resolved(base)->rc.zone == 0.0);
}

static double gap_at(const rb_case *c, double x)
{
    return rb_rolling_profile_gap(rb_case_resolved(c)->rc.profile, x);
}

TEST(a_copy_borrows_the_files)
{
    write_file("gap.txt", "-5 0.25\n0 0\n5 0.25\n");
    write_file("other.txt", "-5 0.5\n-1 0.1\n0 0\n5 0.5\n");
    rb_case *base = case_of("gap=gap.txt load=500"), *c = rb_case_copy(base);
    CHECK_OK(rb_case_resolve(c, &message));
    assert_ptr_equal(rb_case_resolved(c)->rc.profile, rb_case_resolved(base)->rc.profile);
    CHECK_OK(rb_case_set_number(c, "gap-smoothing", 0.5, &message));
    CHECK_OK(rb_case_resolve(c, &message));
    assert_ptr_not_equal(rb_case_resolved(c)->rc.profile, rb_case_resolved(base)->rc.profile);
    CHECK_ABS(gap_at(c, 5.0), 0.25, 1e-12, "a parabola smoothed");
    CHECK_OK(rb_case_set_number(c, "gap-smoothing", 0.0, &message));
    CHECK_OK(rb_case_set(c, "gap", "other.txt", RB_GIVEN_ARGUMENT, &message));
    CHECK_OK(rb_case_resolve(c, &message));
    CHECK_ABS(gap_at(c, 5.0), 0.5, 1e-14, "the other file");
    rb_case_free(c);
    CHECK_ABS(gap_at(base, 5.0), 0.25, 1e-14, "its own file");
    rb_case_free(base);
}

/* Whatever tables a case names are there when it is resolved, and again. */
TEST(tables_are_where_the_case_wants_them)
{
    write_file("worn.txt", "-5 0\n0 0.01\n5 0\n");
    write_file("mu.txt", "-5 0.1\n5 0.3\n");
    write_file("flat.txt", "0 0\n1 0.02\n2 0\n");
    write_file("history.txt", "distance load_N/m\n0 100000\n1 200000\n");
    rb_case *c = case_of("support=halfplane load=500 formulation=steady creep-ratio=0.1 "
                         "worn=worn.txt friction-law=mu.txt");
    for (int again = 0; again < 2; again++) {
        const rb_rolling_case *rc = &rb_case_resolved(c)->rc;
        assert_true(rc->worn.n == 3 && rc->worn.y[1] == 0.01);
        assert_true(rc->friction.table.n == 2 && rc->friction.table.y[1] == 0.3);
        assert_int_equal(rc->mesh, RB_MESH_UNIFORM); /* not fitted to what is worn */
        CHECK_OK(rb_case_resolve(c, &message));
    }
    rb_case_free(c);
    c = case_of("support=halfplane formulation=transient creep-ratio=0.1 "
                "irregularity=flat.txt history=history.txt");
    for (int again = 0; again < 2; again++) {
        const rb_resolved_case *s = rb_case_resolved(c);
        assert_true(s->rc.irregularity.n == 3 && s->rc.irregularity.y[1] == 0.02);
        assert_int_equal(s->program.n, 2);
        CHECK_REL(s->program.load[1], 200.0, 1e-14, "its own unit");
        assert_true(rb_case_is_replaced(c, rb_case_option("load")));
        assert_false(rb_case_is_replaced(c, rb_case_option("mu")));
        CHECK_OK(rb_case_resolve(c, &message));
    }
    rb_case_free(c);
    c = case_of("load=500");
    assert_false(rb_case_is_replaced(c, rb_case_option("load")));
    rb_case_free(c);
}

/* ---- Memory ------------------------------------------------------------------------ */

static rb_status use_memory(void)
{
    rb_case *c = rb_case_create(RB_CASE_SINGLE), *copy = NULL;
    rb_status s = c ? rb_case_set(c, "gap", "gap.txt", RB_GIVEN_ARGUMENT, NULL) : RB_ENOMEM;
    if (s == RB_OK)
        s = rb_case_read(c, "case.ini", NULL);
    if (s == RB_OK)
        s = rb_case_resolve(c, NULL);
    if (s == RB_OK && !(copy = rb_case_copy(c)))
        s = RB_ENOMEM;
    rb_case_free(copy);
    rb_case_free(c);
    return s;
}

TEST(every_failing_allocation_is_told)
{
    write_file("gap.txt", "-5 0.25\n0 0\n5 0.25\n");
    write_file("case.ini", "[normal]\nload = 500\n");
    int failures = 0;
    while (REFUSED_FROM(failures, use_memory()))
        failures++;
    assert_true(failures > 5);
    rb_case_free(NULL);
}

/* Half a material is said, a whole one and the example's are not. */
TEST(half_a_material_is_said)
{
    static const struct {
        const char *words, *says;
    } rows[] = {{"young=210000", "--young without --poisson: nu = 0.1 is that of the built-in"},
                {"young=210000 poisson=0.3", NULL},
                {"load=100", NULL},
                {"poisson=0.3", "--poisson without --young: E = 94500 MPa is that"},
                {"young=210000 poisson=0.3 young-b=70000", NULL}, /* B takes nu of A */
                {"young=7e4 poisson=.2 support=halfplane layer-thickness=1 base-young=2e5",
                 "--base-young without --base-poisson: nu = 0.1"},
                {"young=7e4 poisson=.2 support=halfplane layer-thickness=1 base-young=2e5 "
                 "base-poisson=0.3",
                 NULL},
                {"young=7e4 poisson=.2 support=halfplane layer-thickness=1", NULL}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        rb_case *c = case_of(rows[k].words);
        char text[200];
        int said = 0;
        for (int j = 0; rb_case_half_material(c, j, text, sizeof text); j++)
            if (*text) {
                said++;
                if (!rows[k].says || !strstr(text, rows[k].says))
                    fail_msg("%s: %s", rows[k].words, text);
            }
        assert_int_equal(said, rows[k].says != NULL);
        rb_case_free(c);
    }
}

/* What --history-table has written is read under the command that wrote it. */
TEST(an_option_may_say_what_all_rows_say)
{
    static const char words[] = "formulation=static support=halfplane similar=yes mu=0.3 "
                                "history=same.txt load=%s";
    static const struct {
        const char *load;
        int refused;
    } rows[] = {{"100", 0}, {"100kN/m", 0}, {"101", 1}};
    write_file("same.txt", "load shift\n100.00000000000001 0\n100 1e-3\n");
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        char line[200];
        rb_case *c = NOT_NULL(rb_case_create(RB_CASE_SINGLE));
        snprintf(line, sizeof line, words, rows[k].load);
        CHECK_OK(set_words(c, line, &message));
        CHECK_STATUS(rb_case_resolve(c, &message), rows[k].refused ? RB_EINVAL : RB_OK);
        rb_case_free(c);
    }
}

RUN_TESTS(enter, leave_folder)
