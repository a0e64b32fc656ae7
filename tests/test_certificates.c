/* Random results over all options, right by tests/checker.c, which shares no code with
 * the library, and what rollbem check says of them: none is rejected.  CERTIFICATES: how
 * many; CERTIFICATES_FROM: the first one, to run some again. */
#include "cli_run.h"
#include "random_case.h"

static char checker[700];

static int enter(void **state)
{
    const int entered = enter_folder(state);
    snprintf(checker, sizeof checker, "%.*s/tests/checker",
             (int)(strrchr(program, '/') - program), program);
    return entered;
}

static int asked(const char *name, int otherwise)
{
    return getenv(name) ? atoi(getenv(name)) : otherwise;
}

/* What is printed of the k-th case: most of them results as JSON, some tables, stress. */
static const char *command_of(random_case *c, int k)
{
    random_case_make(c, k, 8);
    const int has_steps = c->regime == RANDOM_STEPS || c->regime == RANDOM_TRANSIENT;
    const int kind = random_choice(c, 10);
    if (kind == 0 && !has_steps)
        return "";
    if (has_steps)
        random_add(c, " --states");
    random_add(c, " --json");
    if (kind == 1 && !has_steps && !strstr(c->line, "--conductivity")) {
        random_add(c, " --grid 4x3");
        return "stress";
    }
    return "";
}

static void right_results_are_valid(void **state)
{
    (void)state;
    static random_case c;
    char command[1700], judge[800];
    const int from = asked("CERTIFICATES_FROM", 0), n = asked("CERTIFICATES", 150);
    int valid = 0, rejected = 0, refused = 0, unsolved = 0, unchecked = 0, wrong = 0;
    for (int k = from; valid + rejected + unchecked < n; k++) {
        snprintf(command, sizeof command, "%s%s --quiet --output r", command_of(&c, k),
                 c.line);
        const int code = rollbem(command);
        refused += code == 64;
        unsolved += code == 1;
        if (code != 0 && code != 64 && code != 1)
            print_error("case %d: exit %d: rollbem %s\n%s", k, code, command, err);
        assert_true(code == 0 || code == 64 || code == 1);
        if (code != 0)
            continue;
        if (strstr(c.line, "--json")) {
            snprintf(judge, sizeof judge, "%s r", checker);
            wrong += shell(judge) != 0;
            if (out[0])
                print_error("case %d: rollbem %.1400s\n    %.400s", k, command, out);
        }
        const int said = rollbem("check r");
        valid += said == 0;
        rejected += said == 1;
        unchecked += said != 0 && said != 1;
        if (said != 0)
            print_error("case %d: rollbem %s\n    %.800s%.300s", k, command, out, err);
    }
    print_message(
        "%d results: %d valid, %d rejected, %d not checked; %d cases refused, %d "
        "not solved\n",
        n, valid, rejected, unchecked, refused, unsolved);
    assert_int_equal(wrong, 0);
    assert_int_equal(rejected, 0);
    assert_int_equal(unchecked, 0);
    assert_true(refused < n);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(right_results_are_valid)};
    return cmocka_run_group_tests(tests, enter, leave_folder);
}
