/* Numbers of files, options, messages and results have points, also in a host program
 * whose locale writes commas. */
#define _XOPEN_SOURCE 700 /* setenv */
#include "check.h"
#include "rollbem/api.h"
#include "rolling/case/case.h"
#include "base/io/io.h"
#include "program/report/report.h"

#include <jansson.h>
#include <locale.h>
#include <unistd.h>

static char folder[] = "/tmp/rollbem-locale-XXXXXX";

/* Made here where the machine has none: 0 without any. */
static int have_commas(void)
{
    static const char *const names[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE.utf8"};
    char line[200];
    for (int round = 0; round < 2; round++) {
        for (size_t k = 0; k < sizeof names / sizeof *names; k++)
            if (setlocale(LC_ALL, names[k]))
                return localeconv()->decimal_point[0] == ',';
        snprintf(line, sizeof line, "localedef -c -i de_DE -f UTF-8 %s/de_DE.UTF-8 >/dev/null 2>&1",
                 folder);
        setenv("LOCPATH", folder, 1);
        if (round == 0 && system(line) != 0)
            return 0;
    }
    return 0;
}

static int enter(void **state)
{
    return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int leave(void **state)
{
    char line[60];
    snprintf(line, sizeof line, "rm -rf %s", folder);
    return chdir("/") == 0 && system(line) == 0 ? 0 : -1;
}

/* All that is written of one case and read again, as text. */
static void write_all(char *text, size_t size)
{
    held_api *a = rb_api_create();
    held_case *words = rb_case_create(RB_CASE_SINGLE);
    OWNED(rb_case_result) result = {0};
    char value[64];
    FILE *out = NOT_NULL(fmemopen(text, size, "w"));
    FILE *gap = fopen("gap.txt", "w");
    fputs("-3 0.09\n0.5 0.0025\n3 0.09\n", gap);
    fclose(gap);

    assert_true(rb_api_set(a, "load", "0,5") < 0);
    fprintf(out, "%s\n", rb_api_message(a));
    assert_int_equal(rb_api_set(a, "load", "10.5"), RB_OK);
    assert_int_equal(rb_api_set(a, "mu", "0.3"), RB_OK);
    assert_int_equal(rb_api_set(a, "support", "halfplane"), RB_OK);
    assert_int_equal(rb_api_set(a, "units", "si"), RB_OK);
    assert_int_equal(rb_api_set(a, "young", "210.5GPa"), RB_OK);
    assert_int_equal(rb_api_set(a, "contact-elements", "12"), RB_OK);
    assert_int_equal(rb_api_solve(a), RB_OK);
    CHECK_REL(rb_api_number(a, "normal_load"), 10.5, 1e-9, "load [N/m]");
    fprintf(out, "%s %s\n", rb_api_value(a, "load", value, sizeof value),
            rb_api_value(a, "young", value, sizeof value));

    static const char *const given[][2] = {
        {"support", "halfplane"},         {"formulation", "steady"},
        {"creep-ratio", "0.4"},           {"mu", "0.25"},
        {"contact-elements", "12"},       {"relaxation-time", "0.01,0.1"},
        {"relaxation-ratio", "0.5,0.25"}, {"speed", "12.5"}};
    for (size_t k = 0; k < sizeof given / sizeof *given; k++)
        CHECK_OK(rb_case_set(words, given[k][0], given[k][1], RB_GIVEN_ARGUMENT, &message));
    CHECK_OK(rb_case_set_number(words, "load", 123.456, &message));
    CHECK_OK(rb_case_resolve(words, &message));
    const rb_resolved_case *c = rb_case_resolved(words);
    CHECK_REL(c->rc.load, 123.456, 1e-15, "load");
    CHECK_OK(rb_case_solve(c, NULL, NULL, &result, &message));
    const rb_rolling_solution *s = &result.solution;
    const rb_report_style style = {0};
    const rb_rolling_note_list notes = rb_case_find_notes(words, s, NULL);
    CHECK_OK(rb_report_table(out, &c->rc, s, &notes, "rollbem", &style));
    json_t *inputs = rb_report_json_inputs(words);
    CHECK_OK(rb_report_json_write(out, inputs));
    rb_report_notes(out, &notes, 0);
    assert_int_equal(fclose(out), 0);

    OWNED(rb_io_table) t;
    CHECK_OK(rb_io_table_read("gap.txt", &t, &message));
    CHECK_REL(t.x[1], 0.5, 1e-15, "x");
}

TEST(numbers_have_points)
{
    static char plain[100000], german[100000];
    write_all(plain, sizeof plain);
    if (!have_commas()) {
        print_message("no locale with commas here, and none that can be made\n");
        skip();
    }
    char text[20];
    snprintf(text, sizeof text, "%g", 1.5);
    assert_string_equal(text, "1,5"); /* the host's own */
    write_all(german, sizeof german);
    assert_string_equal(german, plain);
    snprintf(text, sizeof text, "%g", 2.5);
    assert_string_equal(text, "2,5"); /* and it is left as it was */
    setlocale(LC_ALL, "C");
}

RUN_TESTS(enter, leave)
