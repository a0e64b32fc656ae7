/* Random results over all options, right by tests/checker.c, which shares no code with
 * the library, and what rollbem check says of them: none is rejected.  CERTIFICATES: how
 * many; CERTIFICATES_FROM: the first one, to run some again.  Each turn takes others. */
#include "cli_run.h"
#include "random_case.h"

static char checker[700];

static int enter(void **state)
{
    const int entered = enter_folder(state);
    snprintf(checker, sizeof checker, "%.*s/tests/checker", (int)(strrchr(program, '/') - program),
             program);
    return entered;
}

static int asked(const char *name, int otherwise)
{
    return getenv(name) ? atoi(getenv(name)) : otherwise;
}

/* What is printed of the k-th case: most of them results as JSON, some with derivatives
 * (DERIVATIVES=1: all that can have them), some tables, stress. */
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
    if ((kind == 2 || (kind > 2 && getenv("DERIVATIVES"))) && !strstr(c->line, "--mu 0 "))
        random_add(c, has_steps    ? " --derivatives --tolerance radius=1%%,mu=0.01"
                      : k % 3 == 0 ? " --smooth-derivatives"
                      : k % 3 == 1 ? " --derivatives p,q,slip --tolerance radius=1%%,mu=0.01"
                                   : " --derivatives --tolerance radius=1%%,mu=0.01");
    if (kind == 1 && !has_steps && !strstr(c->line, "--conductivity")) {
        random_add(c, " --grid 4x3");
        return "stress";
    }
    return "";
}

typedef struct {
    int valid, rejected, refused, unsolved, unchecked, wrong;
} verdicts;

static void judge(int k, verdicts *v)
{
    static random_case c;
    char command[1700];

    const char *name = command_of(&c, k);
    snprintf(command, sizeof command, "%s%s --quiet --output r", name, c.line);
    int code = rollbem(command);
    char *last = strstr(c.line, " --derivatives");
    last = last ? last : strstr(c.line, " --smooth-derivatives");
    if (code != 0 && last && strstr(err, "derivatives")) { /* it has none: the result alone */
        *last = '\0';
        snprintf(command, sizeof command, "%s%s --quiet --output r", name, c.line);
        code = rollbem(command);
    }
    v->refused += code == 64;
    v->unsolved += code == 1;
    if (code != 0 && code != 64 && code != 1)
        print_error("case %d: exit %d: rollbem %s\n%s", k, code, command, err);
    assert_true(code == 0 || code == 64 || code == 1);
    if (code != 0)
        return;
    if (strstr(c.line, "--json")) {
        v->wrong += shellf("%s r", checker) != 0;
        if (out[0])
            print_error("case %d: rollbem %.1400s\n    %.400s", k, command, out);
    }
    const int said = rollbem("check r");
    v->valid += said == 0;
    v->rejected += said == 1;
    v->unchecked += said != 0 && said != 1;
    if (said != 0)
        print_error("case %d: rollbem %s\n    %.800s%.300s", k, command, out, err);
}

TEST(right_results_are_valid)
{
    const char *turn = getenv("ROLLBEM_TEST_TURN");
    const int all = getenv("ROLLBEM_TEST_ALL") != NULL, n = asked("CERTIFICATES", all ? 5000 : 25);
    const int from = asked("CERTIFICATES_FROM", all || !turn ? 0 : atoi(turn) % 50 * 130);
    verdicts v = {0};

    for (int k = from, said = 0; v.valid + v.rejected + v.unchecked < n; k++) {
        judge(k, &v);
        if (v.valid >= said + 500) /* a long study that is stopped has said so much */
            print_message("... case %d: %d valid\n", k, said = v.valid);
    }
    print_message("%d results: %d valid, %d rejected, %d not checked; %d cases refused, %d "
                  "not solved\n",
                  n, v.valid, v.rejected, v.unchecked, v.refused, v.unsolved);
    assert_int_equal(v.wrong, 0);
    assert_int_equal(v.rejected, 0);
    assert_int_equal(v.unchecked, 0);
    assert_true(v.refused < n);
}

/* Of 6000: thin layers whose displacements cancel, a base softer than its layer, coarse
 * contacts whose differences miss a part of the hysteresis, a contact that opens, three
 * elements in contact, heat beside the trailing edge; an arc whose number of elements
 * rounding decided; and (7593, with DERIVATIVES=1) two sides that differ by rounding. */
TEST(results_that_were_once_rejected_are_valid)
{
    static const int once[] = {1290, 3511, 3563, 5224, 5401, 5896, 5968, 7500, 7593, 8273, 204570};
    const int n = (int)(sizeof once / sizeof *once);
    verdicts v = {0};

    for (int i = 0; i < n; i++)
        judge(once[i], &v);
    assert_int_equal(v.valid, n);
    assert_int_equal(v.wrong, 0);
}

RUN_TESTS(enter, leave_folder)
