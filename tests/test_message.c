/* The line in which every refusal of the program ends, and its exit codes. */
#include "check.h"
#include "cli/cli.h"

#include <string.h>

static void every_status_has_its_exit_code(void **state)
{
    static const struct {
        rb_status status;
        cli_exit code;
    } all[] = {{RB_OK, CLI_OK},
               {RB_EINVAL, CLI_USAGE},
               {RB_EFORMAT, CLI_DATA},
               {RB_ENOENT, CLI_NOINPUT},
               {RB_EWRITE, CLI_CANTWRITE},
               {RB_ENOMEM, CLI_INTERNAL},
               {RB_EHELPER, CLI_INTERNAL},
               {RB_MAXITER, CLI_UNSOLVED},
               {RB_RAY, CLI_UNSOLVED},
               {RB_SINGULAR, CLI_UNSOLVED},
               {RB_NO_CONTACT, CLI_UNSOLVED},
               {RB_ZONE, CLI_UNSOLVED},
               {RB_INACCURATE, CLI_UNSOLVED},
               {RB_INTERRUPTED, CLI_UNSOLVED}};
    static const int numbers[] = {0, 64, 65, 66, 73, 70};
    (void)state;
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
        assert_int_equal(cli_exit_of(all[k].status), all[k].code);
        if (k < 6)
            assert_int_equal(all[k].code, numbers[k]);
    }
    assert_int_equal(CLI_UNSOLVED, 1);
}

/* cli_fail's line: on standard error, which goes to a file here. */
static const char *printed(cli_exit (*say)(void), cli_exit wanted)
{
    static char text[10000];
    FILE *file = tmpfile();
    assert_non_null(file);
    fflush(stderr);
    FILE *old = stderr;
    stderr = file;
    const cli_exit code = say();
    stderr = old;
    rewind(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    assert_int_equal(code, wanted);
    return text;
}

static const rb_message reason = {"mu = -1: expected >= 0"}, none = {""};

static cli_exit fail_with_number(void)
{
    return cli_fail(CLI_DATA, "%s:%d: a\nb\t\x1b", "case.ini", 7);
}

static cli_exit fail_long(void)
{
    char word[5000];
    memset(word, 'x', sizeof word - 1);
    word[sizeof word - 1] = '\0';
    return cli_fail(CLI_USAGE, "%s", word);
}

static cli_exit say_nothing(void)
{
    return cli_say(RB_OK, &reason);
}

static cli_exit say_reason(void)
{
    return cli_say(RB_EINVAL, &reason);
}

static cli_exit say_of_option(void)
{
    return cli_say_of("gap", RB_ENOENT, &reason);
}

static cli_exit say_without_reason(void)
{
    return cli_say(RB_ENOMEM, &none);
}

static void a_refusal_is_one_line_in_print(void **state)
{
    (void)state;
    assert_string_equal(printed(fail_with_number, CLI_DATA),
                        "rollbem: case.ini:7: a\\x0ab\\x09\\x1b\n");
    assert_int_equal(strlen(printed(fail_long, CLI_USAGE)), 9 + 3999 + 1);
    assert_string_equal(printed(say_nothing, CLI_CONTINUE), "");
    assert_string_equal(printed(say_reason, CLI_USAGE),
                        "rollbem: mu = -1: expected >= 0\n");
    assert_string_equal(printed(say_of_option, CLI_NOINPUT),
                        "rollbem: --gap: mu = -1: expected >= 0\n");
    char wanted[200];
    snprintf(wanted, sizeof wanted, "rollbem: %s\n", rb_status_text(RB_ENOMEM));
    assert_string_equal(printed(say_without_reason, CLI_INTERNAL), wanted);
}

/* Last: it cannot be taken back. */
static void kept_failures_are_not_printed(void **state)
{
    (void)state;
    assert_string_equal(cli_kept_failure(), "");
    cli_keep_failures(1);
    assert_string_equal(printed(say_reason, CLI_USAGE), "");
    assert_string_equal(cli_kept_failure(), "mu = -1: expected >= 0");
    assert_string_equal(printed(fail_long, CLI_USAGE), "");
    assert_int_equal(strlen(cli_kept_failure()), 399);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_status_has_its_exit_code),
        cmocka_unit_test(a_refusal_is_one_line_in_print),
        cmocka_unit_test(kept_failures_are_not_printed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
