/* What the program prints and draws, against records: words exactly, numbers as numbers.
 * Most digits of a picture, of a header and of a message follow from no formula, so that
 * only a record of them shows a change that nobody wanted.
 *
 * A file of tests/recorded is a shell line, where $R is the program and $EXAMPLES the
 * folder examples, and what came of it. ROLLBEM_RECORD=1 build/tests/test_recorded writes
 * all of them anew, or those named: look at the difference and name the reason when you commit it.
 * Run from the project's root; B: the build. */
#include "cli_run.h"

#include <ctype.h>
#include <dirent.h>

enum { MOST = sizeof out + sizeof err + 2000 };
static char records[600], got[MOST], wanted[MOST];

/* A number begins here, not in a word or a colour. */
static int at_number(const char *text, const char *s)
{
    const char *digits = s + (*s == '-' || *s == '+');
    digits += *digits == '.';
    return isdigit((unsigned char)*digits) &&
           (s == text || (!isalnum((unsigned char)s[-1]) && !strchr("#_.", s[-1])));
}

/* Time and processor: no two runs have the same.  Every new option changes a hash. */
static int is_of_this_run(const char *line, const char *next)
{
    static const char *const words[] = {
        "  computed  in ",  " cases in ",   "\"seconds\": ",  "\"integrals\": ", "\"openblas\": ",
        "\"assembly\": ",   "\"factor\": ", "\"condense\": ", "\"lcp\": ",       "\"total\": ",
        "\"input_hash\": ", "# study ",     " points in "};
    for (size_t k = 0; k < sizeof words / sizeof *words; k++) {
        const char *at = strstr(line, words[k]);
        if (at && at < next)
            return 1;
    }
    return 0;
}

/* Long blocks of data: the first lines and one in forty of the others. */
static void keep(char *text)
{
    enum { WHOLE = 8, EVERY = 40 };
    char *to = text;
    int inside = -1;
    for (char *line = text, *next; *line; line = next) {
        next = line + strcspn(line, "\n");
        next += *next == '\n';
        if (line[0] == '$')
            inside = 0;
        else if (strncmp(line, "EOD", 3) == 0)
            inside = -1;
        else if (inside >= 0 && inside++ >= WHOLE && inside % EVERY != 0)
            continue;
        if (is_of_this_run(line, next))
            continue;
        memmove(to, line, (size_t)(next - line));
        to += next - line;
    }
    *to = '\0';
}

/* Long numbers with nine digits: more are rounding, different on every processor. */
static void round_numbers(char *text)
{
    char *to = text;
    for (char *s = text; *s;) {
        char *end = s + 1;
        const double x = at_number(text, s) ? strtod(s, &end) : 0.0;
        if (end - s > 11) {
            char digits[40];
            snprintf(digits, sizeof digits, "%.9g", fabs(x) < 1e-12 ? 0.0 : x);
            const size_t length = strlen(digits);
            memcpy(to, digits, length); /* never longer than what stood there */
            to += length;
            s = end;
        } else
            while (s < end)
                *to++ = *s++;
    }
    *to = '\0';
}

/* Where they part, or NULL.  Numbers agree to six digits, and where both are rounding. */
static const char *difference(const char *a, const char *b)
{
    const char *begin_a = a, *begin_b = b;
    while (*a || *b) {
        if (at_number(begin_a, a) && at_number(begin_b, b)) {
            char *end_a, *end_b;
            const double x = strtod(a, &end_a), y = strtod(b, &end_b);
            if (!(fabs(x - y) <= 1e-6 * fabs(y) + 1e-9))
                return b;
            a = end_a;
            b = end_b;
        } else if (*a++ != *b++)
            return b - 1;
    }
    return NULL;
}

static void record_is_met(void **state)
{
    const char *name = *state;
    char path[1000], line[1500];
    snprintf(path, sizeof path, "%s/%s", records, name);
    slurp(path, wanted, sizeof wanted);
    const size_t length = strcspn(wanted, "\n");
    assert_true(length > 0 && length < sizeof line);
    snprintf(line, sizeof line, "%.*s", (int)length, wanted);
    const int code = shell(line);
    keep(err);
    keep(out);
    round_numbers(out);
    snprintf(got, sizeof got, "%s\nexit %d\n%s%s%s", line, code, err, *err ? "----\n" : "", out);
    if (getenv("ROLLBEM_RECORD")) {
        write_file(path, got);
        return;
    }
    const char *at = difference(got, wanted);
    if (at) {
        int row = 1;
        for (const char *s = wanted; s < at; s++)
            row += *s == '\n';
        fail_msg("tests/recorded/%s, line %d: wanted '%.60s'; now: %s", name, row, at, line);
    }
}

static int is_record(const struct dirent *e)
{
    return e->d_name[0] != '.';
}

/* A test for every record, or for those of this name, which may have * and ?.  By their names, so
 * that those of a kind stand together, one of four in each turn, unless they are asked for. */
int main(int argc, char **argv)
{
    enum { ENOUGH = 200, TURNS = 4 };
    static struct CMUnitTest tests[ENOUGH];
    static char names[ENOUGH][100], here[500], examples[600];
    struct dirent **found = NULL;
    int n = 0;
    if (!getcwd(here, sizeof here))
        return 1;
    snprintf(records, sizeof records, "%s/tests/recorded", here);
    snprintf(examples, sizeof examples, "%s/examples", here);
    setenv("EXAMPLES", examples, 1);
    if (argc > 1)
        cmocka_set_test_filter(argv[1]);
    const int all = scandir(records, &found, is_record, alphasort);
    if (all > ENOUGH)
        return 1;
    for (int k = 0; k < all; k++) {
        if (argc > 1 || getenv("ROLLBEM_RECORD") || is_in_turn(k, TURNS)) {
            snprintf(names[n], sizeof names[n], "%.99s", found[k]->d_name);
            tests[n] = (struct CMUnitTest){names[n], record_is_met, NULL, NULL, names[n]};
            n++;
        }
        free(found[k]);
    }
    free(found);
    if (n == 0)
        return 1;
    return _cmocka_run_group_tests("records", tests, (size_t)n, enter_folder, leave_folder);
}
