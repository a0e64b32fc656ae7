/* The results of tests/recorded with --prove, and the proofs of rollbem check --prove, which reads
 * the result alone: the zones are proved, and the printed tractions are near. */
#include "pages.h"

#include <glob.h>

enum { PARTS = 5 };

static char folder[] = "/tmp/rollbem-cli-proof-XXXXXX";

/* The options of a record that begins with the program; "": of others. */
static const char *options_of(const char *record, char text[MAX_TEXT])
{
    static const char begin[] = "\"$R\" ";
    slurp(record, text);
    text[strcspn(text, "\n")] = '\0';
    if (strncmp(text, begin, sizeof begin - 1) != 0)
        return "";
    char *options = text + sizeof begin - 1;
    options[strcspn(options, ">|&;")] = '\0';
    return options;
}

/* In turns; those without tractions as JSON, or whose elements are too many for a proof in seconds,
 * are none that the command below solves. */
TEST(recorded_results_are_proved)
{
    const char *build = getenv("B") ? getenv("B") : "build";
    glob_t records;
    static char text[MAX_TEXT];
    int proved = 0, tried = 0, refused = 0;
    assert_int_equal(glob("tests/recorded/s*-*", 0, NULL, &records) +
                         glob("tests/recorded/history*", GLOB_APPEND, NULL, &records),
                     0);
    assert_non_null(mkdtemp(folder));
    for (size_t k = 0; k < records.gl_pathc; k++) {
        const char *options = options_of(records.gl_pathv[k], text);
        if (!*options || !is_in_turn((int)k, PARTS) || strstr(options, "--cite"))
            continue;
        const int code = run("%s/rollbem %s --json --prove --output %s/j.json >%s/out 2>%s/err",
                             build, options, folder, folder, folder);
        if (code == 64) { /* refused beside --json or --prove, or another command */
            refused++;
            continue;
        }
        if (code != 0)
            fail_msg("%s ends with %d", options, code);
        const int checked = run("%s/rollbem check --prove %s/j.json >%s/out 2>%s/err", build,
                                folder, folder, folder);
        if (checked == 65) /* its steps or error bars cannot be checked from it alone */
            continue;
        if (checked != 0)
            fail_msg("%s: check --prove ends with %d", options, checked);
        tried++;
        proved += run("grep -q '\"status\": \"proved\"' %s/j.json", folder) == 0;
    }
    globfree(&records);
    run("rm -r %s", folder);
    if (proved != tried || tried < refused)
        fail_msg("%d of %d results proved, %d refused", proved, tried, refused);
}

RUN_TESTS(NULL, NULL)
