/* The line in which every refusal of the program ends, and its exit codes. */
#define _GNU_SOURCE /* RTLD_NEXT */
#include "check.h"
#include "program/cli/cli.h"
#include "program/cli/wait.h"

#include <dlfcn.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

TEST(every_status_has_its_exit_code)
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
               {RB_INTERRUPTED, CLI_UNSOLVED},
               {RB_NO_SOLUTION, CLI_UNSOLVED},
               {RB_UNDECIDED, CLI_UNSOLVED},
               {RB_NUMERICAL, CLI_UNSOLVED},
               {RB_TIME_LIMIT, CLI_UNSOLVED}};
    static const int numbers[] = {0, 64, 65, 66, 73, 70};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
        assert_int_equal(cli_exit_of(all[k].status), all[k].code);
        if (k < 6)
            assert_int_equal(all[k].code, numbers[k]);
    }
    assert_int_equal(CLI_UNSOLVED, 1);
}

/* cli_fail's line: on standard error, which goes to a file here. */
static const char *printed(cli_exit (*print)(void), cli_exit wanted)
{
    static char text[10000];
    FILE *file = NOT_NULL(tmpfile());
    fflush(stderr);
    FILE *old = stderr;
    stderr = file;
    const cli_exit code = print();
    stderr = old;
    rewind(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    assert_int_equal(code, wanted);
    return text;
}

static const rb_message reason = {.text = "mu = -1: expected >= 0"}, none = {.text = ""};

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

TEST(a_refusal_is_one_line_in_print)
{
    assert_string_equal(printed(fail_with_number, CLI_DATA),
                        "rollbem: case.ini:7: a\\x0ab\\x09\\x1b\n");
    assert_int_equal(strlen(printed(fail_long, CLI_USAGE)), 9 + 3999 + 1);
    assert_string_equal(printed(say_nothing, CLI_CONTINUE), "");
    assert_string_equal(printed(say_reason, CLI_USAGE), "rollbem: mu = -1: expected >= 0\n");
    assert_string_equal(printed(say_of_option, CLI_NOINPUT),
                        "rollbem: --gap: mu = -1: expected >= 0\n");
    char wanted[200];
    snprintf(wanted, sizeof wanted, "rollbem: %s\n", rb_status_text(RB_ENOMEM));
    assert_string_equal(printed(say_without_reason, CLI_INTERNAL), wanted);
}

/* ---- Command lines ----------------------------------------------------------------- */

static int run_nothing(int argc, char **argv)
{
    (void)argc, (void)argv;
    return CLI_OK;
}

static const cli_command two[] = {{"lcp", run_nothing, "problems"}, {"", run_nothing, "cases"}};

/* What is printed as the command gives the same words again. */
TEST(a_command_line_is_quoted_and_split)
{
    static const struct {
        const char *words[5], *line;
    } all[] = {{{"--mu=0.3", "a.ini"}, "rollbem --mu=0.3 a.ini"},
               {{"load 1 2", ""}, "rollbem 'load 1 2' ''"},
               {{"it's", "'", "a b"}, "rollbem 'it'\\''s' ''\\''' 'a b'"},
               {{"x_y-z+1,2:/@%^"}, "rollbem x_y-z+1,2:/@%^"},
               {{"$HOME", "*", "a;b", "#"}, "rollbem '$HOME' '*' 'a;b' '#'"}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        char program[] = "rollbem", *argv[6] = {program}, line[200];
        int argc = 1, n;
        for (; argc < 6 && all[k].words[argc - 1]; argc++)
            argv[argc] = (char *)(uintptr_t)all[k].words[argc - 1];
        assert_true(cli_begin(two, argc, argv));
        assert_string_equal(cli_command_line(), all[k].line);
        snprintf(line, sizeof line, "%s", all[k].line + strlen("rollbem "));
        char **words = cli_split_line(line, &n);
        assert_int_equal(n, argc);
        for (int i = 0; i < n; i++)
            assert_string_equal(words[i], argv[i]);
        free(words);
        cli_end();
        assert_string_equal(cli_command_line(), "rollbem");
    }
}

TEST(lines_are_split_as_a_shell_does)
{
    static const struct {
        const char *line;
        int n;
        const char *words[4];
    } all[] = {{"", 1, {""}},
               {"  a   b ", 3, {"a", "b"}},
               {"a\\ b c", 3, {"a b", "c"}},
               {"a'b c'd", 2, {"ab cd"}},
               {"'a\\b' \\\\", 3, {"a\\b", "\\"}},
               {"a\\", 2, {"a"}},
               {"'' x", 3, {"", "x"}}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        char line[40];
        int n;
        snprintf(line, sizeof line, "%s", all[k].line);
        char **words = cli_split_line(line, &n);
        assert_int_equal(n, all[k].n);
        assert_string_equal(words[0], "rollbem");
        for (int i = 1; i < n; i++)
            assert_string_equal(words[i], all[k].words[i - 1]);
        free(words);
    }
}

TEST(commands_are_found_by_name)
{
    assert_true(cli_begin(two, 1, (char *[]){NULL}));
    assert_string_equal(cli_command_name(0), "lcp");
    assert_null(cli_command_name(1));
    assert_string_equal(cli_command_help("lcp"), "problems");
    assert_string_equal(cli_command_help(""), "cases");
    assert_null(cli_command_help("lc"));
    rb_guess guess = {.word = "lpc"};
    cli_guess_command(&guess);
    assert_string_equal(rb_guess_text(&guess, ""), " (did you mean 'lcp'?)");
    cli_end();
}

static int worked; /* seconds of the processor, for those that ask */

int clock_gettime(clockid_t clock, struct timespec *now)
{
    int (*real)(clockid_t, struct timespec *);
    *(void **)&real = dlsym(RTLD_NEXT, "clock_gettime");
    const int code = real(clock, now);
    if (clock == CLOCK_PROCESS_CPUTIME_ID)
        now->tv_sec = worked;
    return code;
}

/* A signal at each of these seconds: the line comes after 20 s of work, then after twice as many.
 */
TEST(long_work_is_said_by_the_seconds_of_the_processor)
{
    static const int ticks[] = {2, 19, 20, 39, 41, 79, 170, 171, 320};
    char text[400] = "";
    FILE *file = NOT_NULL(tmpfile());
    const int old = dup(STDERR_FILENO);
    dup2(fileno(file), STDERR_FILENO);
    rb_phase("matrices");
    cli_wait_begin();
    for (size_t k = 0; k < sizeof ticks / sizeof *ticks; k++) {
        worked = ticks[k];
        raise(SIGALRM);
    }
    cli_wait_end();
    dup2(old, STDERR_FILENO);
    close(old);
    rewind(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    assert_string_equal(text, "rollbem: 20 s of the processor so far: matrices\n"
                              "rollbem: 41 s of the processor so far: matrices\n"
                              "rollbem: 170 s of the processor so far: matrices\n"
                              "rollbem: 320 s of the processor so far: matrices\n");
}

/* Last: it cannot be taken back. */
TEST(kept_failures_are_not_printed)
{
    assert_string_equal(cli_kept_failure(), "");
    cli_keep_failures(1);
    assert_string_equal(printed(say_reason, CLI_USAGE), "");
    assert_string_equal(cli_kept_failure(), "mu = -1: expected >= 0");
    assert_string_equal(printed(fail_long, CLI_USAGE), "");
    assert_int_equal(strlen(cli_kept_failure()), 399);
}

RUN_TESTS(NULL, NULL)
