/* What the program reads beyond the library: its command line, the rows of a study, the
 * file that a study goes on from, and results of anybody that it checks.  src/program/cli is
 * linked, but for main. */
#include "program/cli/case.h"
#include "program/cli/cli.h"
#include "fuzz.h"

#include <stdlib.h>
#include <string.h>

enum { WORDS_MAX = 40 };

static const cli_command commands[] = {{"sweep", cli_sweep, ""},
                                       {"crack", cli_crack, ""},
                                       {"stress", cli_stress, ""},
                                       {"", cli_solve, ""}};

/* As main does, but results go to a file that nobody reads and failures are kept. */
static void begin(void)
{
    static char *argv[] = {"rollbem", NULL};
    static int begun;
    if (!begun)
        fuzz_require(freopen("/dev/null", "w", stdout) && cli_begin(commands, 1, argv),
                     "the program begins");
    begun = 1;
    cli_keep_failures(1);
}

static int known(int code)
{
    static const int codes[] = {CLI_CONTINUE, CLI_OK,      CLI_UNSOLVED, CLI_USAGE,
                                CLI_DATA,     CLI_NOINPUT, CLI_INTERNAL, CLI_CANTWRITE};
    for (size_t k = 0; k < sizeof codes / sizeof codes[0]; k++)
        if (code == codes[k])
            return 1;
    return 0;
}

/* A word per line: the command line up to where the case would be solved. */
void fuzz_options(const uint8_t *data, size_t size)
{
    char *text = fuzz_text(data, size), *argv[WORDS_MAX + 1] = {"rollbem"};
    int argc = 1;
    begin();
    for (char *word = strtok(text, "\n"); word && argc < WORDS_MAX; word = strtok(NULL, "\n"))
        argv[argc++] = word;
    rb_case *c = cli_case_create(RB_CASE_SINGLE);
    fuzz_require(c != NULL, "there is memory");
    const cli_spec spec = {.synopsis = "rollbem",
                           .about = "",
                           .sets = {rb_case_options(c), cli_example_set()},
                           .set_n = 2};
    cli_args args = {0};
    *(const char **)spec.sets[1].target = NULL; /* --example of the run before */
    fuzz_require(known(cli_case_parse(&spec, argc, argv, c, &args)),
                 "an exit code is a documented one");
    cli_args_free(&args);
    rb_case_free(c);
    free(text);
}

static int sweep(const char *option, const char *value)
{
    char *argv[] = {"sweep",
                    "--support",
                    "halfplane",
                    "--load",
                    "100",
                    "--similar",
                    "--jobs",
                    "1",
                    "--contact-elements",
                    "8",
                    "--quiet",
                    "--output",
                    "rows.tsv",
                    (char *)option,
                    (char *)value,
                    NULL};
    begin();
    const int code = cli_sweep(15, argv);
    fuzz_require(code == CLI_OK || code == CLI_UNSOLVED || cli_kept_failure()[0],
                 "a refusal says why");
    return code;
}

/* The table of cases: refused whole, or a row for each of its rows. */
void fuzz_study(const uint8_t *data, size_t size)
{
    /* many rows would only take long */
    size_t lines = 0;
    for (size_t k = 0; k < size; k++)
        lines += data[k] == '\n';
    if (lines > 8)
        return;
    fuzz_write("cases", data, size);
    remove("rows.tsv");
    const int code = sweep("--cases", "cases");
    fuzz_require(known(code), "an exit code is a documented one");
    FILE *rows = fopen("rows.tsv", "r");
    fuzz_require(rows || code >= CLI_USAGE, "a study that runs has rows");
    if (rows)
        fclose(rows);
}

static size_t lines_of(const char *text)
{
    size_t n = 0;
    for (; *text; text++)
        n += *text == '\n';
    return n;
}

static const char VARIED[] = "creep-ratio 0.2 0.4 0.6";

/* Two bytes say how much of a study's rows is kept, the others stand behind it: the study
 * goes on and ends with all its rows, or refuses the file and leaves it as it is. */
void fuzz_resume(const uint8_t *data, size_t size)
{
    static char *reference;
    static size_t whole;
    fuzz_bytes b = {data, data + size};
    if (!reference) {
        remove("rows.tsv");
        fuzz_require(sweep("--vary-1", VARIED) == CLI_OK, "the study is solved");
        reference = fuzz_read("rows.tsv", &whole);
    }
    size_t kept = (size_t)(fuzz_byte(&b) + 256 * fuzz_byte(&b)) % (whole + 1);
    const size_t more = (size_t)(b.end - b.at), n = kept + more;
    char *before = calloc(n + 1, 1);
    fuzz_require(before != NULL, "there is memory");
    memcpy(before, reference, kept);
    if (more > 0)
        memcpy(before + kept, b.at, more);
    fuzz_write("rows.tsv", before, n);
    const int code = sweep("--vary-1", VARIED);
    size_t now;
    char *after = fuzz_read("rows.tsv", &now);
    if (code == CLI_CANTWRITE)
        fuzz_require(now == n && memcmp(before, after, n) == 0,
                     "a file that is refused stays as it is");
    else
        fuzz_require(known(code) && lines_of(after) == lines_of(reference),
                     "a study that goes on ends with all rows");
    if (code == CLI_OK && more == 0)
        fuzz_require(now == whole && memcmp(reference, after, now) == 0,
                     "a study that was cut ends as if it had not been");
    free(after);
    free(before);
}

/* Whether an option of the text asks for more than so much, which would only take long.
 */
static int asks_for_more(const char *text, const char *option, double most)
{
    for (const char *at = text; (at = strstr(at, option)) != NULL;) {
        at += strlen(option);
        at += strspn(at, "\": =");
        if (!(strtod(at, NULL) <= most))
            return 1;
    }
    return 0;
}

/* What the program writes of each kind of result, made once; ANY_BYTES is no kind. */
enum { KINDS = 6, ANY_BYTES = 4, STRESS = 2, CRACK = 5 };
static const char *result_of_kind(int kind, size_t *size)
{
    static char *text[KINDS];
    static size_t length[KINDS];
    static char *const lines[KINDS][24] = {
        {"--creep-ratio", "0.4", "--formulation", "steady", "--json"},
        {"--shift", "1e-4", "--increments", "2", "--states", "--json"},
        {"stress", "--shift", "1e-4", "--grid", "2x2", "--shakedown", "--json"},
        {"--creep-ratio", "0.4", "--formulation", "steady", "--mesh", "uniform"},
        {NULL},
        {"crack", "--crack-elements", "4", "--steps", "24", "--fluid", "trapped", "--states",
         "--json"}};
    static char *const common[] = {"--support", "halfplane", "--load",   "100",
                                   "--mu",      "0.3",       "--quiet",  "--contact-elements",
                                   "5",         "--output",  "reference"};
    if (!text[kind]) {
        char *argv[40] = {"rollbem"};
        int argc = 1;
        for (int k = 0; lines[kind][k]; k++)
            argv[argc++] = lines[kind][k];
        for (size_t k = 0; k < sizeof common / sizeof *common; k++)
            argv[argc++] = common[k];
        argv[argc] = NULL;
        cli_end(); /* results quote this command line */
        fuzz_require(cli_begin(commands, argc, argv) &&
                         (kind == STRESS  ? cli_stress(argc - 1, argv + 1)
                          : kind == CRACK ? cli_crack(argc - 1, argv + 1)
                                          : cli_solve(argc, argv)) == CLI_OK,
                     "the result is there");
        text[kind] = fuzz_read("reference", &length[kind]);
    }
    *size = length[kind];
    return text[kind];
}

/* Edits of a result: where, how many bytes go, how many others come. */
static char *edited(fuzz_bytes *b, const char *text, size_t *size)
{
    char *now = calloc(*size + (size_t)(b->end - b->at) + 1, 1);
    fuzz_require(now != NULL, "there is memory");
    memcpy(now, text, *size);
    while (b->at < b->end) {
        const size_t where = (size_t)(fuzz_byte(b) + 256 * fuzz_byte(b)) % (*size + 1);
        const size_t left = *size - where, wanted = (size_t)fuzz_choice(b, 32);
        const size_t gone = wanted < left ? wanted : left;
        size_t come = (size_t)fuzz_choice(b, 32);
        if (come > (size_t)(b->end - b->at))
            come = (size_t)(b->end - b->at);
        memmove(now + where + come, now + where + gone, left - gone);
        memcpy(now + where, b->at, come);
        b->at += come;
        *size += come - gone;
        now[*size] = '\0';
    }
    return now;
}

/* A result or a table, edited (first byte: which), or any bytes behind ANY_BYTES: valid,
 * violated or refused with a reason. */
void fuzz_check(const uint8_t *data, size_t size)
{
    fuzz_bytes b = {data, data + size};
    char *argv[] = {"check", "result", NULL};
    begin();
    const int kind = fuzz_choice(&b, KINDS);
    size_t n = (size_t)(b.end - b.at);
    char *text;
    if (kind == ANY_BYTES)
        text = fuzz_text(b.at, n);
    else {
        const char *whole = result_of_kind(kind, &n);
        text = edited(&b, whole, &n);
    }
    if (!asks_for_more(text, "outer-elements", 200.0) && !asks_for_more(text, "hub-ratio", 0.9) &&
        !asks_for_more(text, "crack-elements", 100.0)) {
        fuzz_keep("result", text, n);
        const int code = cli_check(2, argv);
        fuzz_require(code == CLI_OK || code == CLI_UNSOLVED || code == CLI_DATA,
                     "an exit code is a documented one");
        fuzz_require(code < CLI_USAGE || cli_kept_failure()[0], "a refusal says why");
        fuzz_require(code == CLI_OK || kind == ANY_BYTES || size > 1,
                     "what nobody edited is valid");
    }
    free(text);
}
