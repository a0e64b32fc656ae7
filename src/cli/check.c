/* rollbem check: results verified without the solver. */
#include "cli/case.h"
#include "rollbem/io.h"
#include "rollbem/report.h"

#include <jansson.h>
#include <stdlib.h>

static const char about[] =
    "Checks results that `rollbem --json` wrote, without solving: builds the problem\n"
    "again from `inputs`, on the elements of the table, computes gaps, slip, bounds,\n"
    "load, force and every other number again from the pressures, friction, approach\n"
    "and creepage that are printed, and says valid, or what is violated and by how "
    "much.\n"
    "Histories are followed step by step where --states has printed what each of them\n"
    "found: gaps, bounds, and the slip from the step before. Not checked: "
    "free_creepage,\n"
    "iterations, seconds, and which solver it was. Refused: histories without states,\n"
    "or with friction that depends on the slip or the temperature, or an interface that\n"
    "yields; curves, error bars, units other than mm, N, MPa.\n"
    "\n"
    "Exit codes: 0 valid; 1 violated; 65 cannot be checked; 66 no such file.";

static cli_exit check_root(const char *path, const json_t *root)
{
    rb_report_certificate found;
    rb_message why = {""};
    rb_case *words = cli_case_create(RB_CASE_SINGLE);
    if (!words)
        return CLI_INTERNAL;
    const rb_status s =
        rb_report_certify_solutions(stdout, path, root, words, &found, &why);
    rb_case_free(words);
    if (s != RB_OK)
        return cli_fail(s == RB_ENOMEM ? CLI_INTERNAL : CLI_DATA, "%s", why.text);
    if (found.violations == 0)
        printf("%s: valid: %d numbers computed again, residual %.2g\n", path,
               found.numbers, found.residual);
    return found.violations ? CLI_UNSOLVED : CLI_OK;
}

static cli_exit check_file(const char *path)
{
    char *text = NULL;
    size_t size;
    rb_message why = {""};
    json_error_t error;
    const rb_status s = rb_io_read_text(path, &text, &size, &why);
    if (s != RB_OK)
        return cli_say(s, &why);
    json_t *root = json_loadb(text, size, JSON_REJECT_DUPLICATES, &error);
    free(text);
    const cli_exit code =
        json_is_object(root)
            ? check_root(path, root)
            : cli_fail(CLI_DATA, "%s:%d: expected the JSON of a result: %s", path,
                       root ? 1 : error.line, root ? "no object" : error.text);
    json_decref(root);
    return code;
}

int cli_check(int argc, char **argv)
{
    static const cli_spec spec = {.synopsis = "rollbem check RESULT.json...",
                                  .about = about};
    cli_args args = {0};
    cli_exit code = cli_parse(&spec, argc, argv, &args);
    if (code == CLI_CONTINUE && args.operands == 0)
        code = cli_fail(CLI_USAGE, "check: expected a file that `rollbem --json` wrote");
    else if (code == CLI_CONTINUE) {
        code = CLI_OK;
        for (int k = 0; k < args.operands; k++) {
            const cli_exit one = check_file(args.operand[k]);
            code = one > code ? one : code;
        }
    }
    cli_args_free(&args);
    return code;
}
