/* rollbem verify: references, wanted and got. */
#include "cli/output.h"

#include "rollbem/verify.h"

#include <string.h>

static void print_check(const rb_verify_check *c, void *context)
{
    int *count = context;
    ++*count;
    if (cli_reader_is_person()) { /* 80 columns */
        const int red = !c->holds && cli_is_coloured(stdout);
        printf("%s%-5s%s %-43s", red ? "\033[31m" : "", c->holds ? "ok" : "WRONG",
               red ? "\033[0m" : "", c->what);
        printf(strlen(c->what) > 43 ? "\n%49s %9.4g %9.4g %8.1e\n"
                                    : "%s %9.4g %9.4g %8.1e\n",
               "", c->wanted, c->got, c->error);
        return;
    }
    printf("%-6s %-56s wanted %-12.6g got %-12.6g %s %-8.2g bound %.2g",
           c->holds ? "ok" : "WRONG", c->what, c->wanted, c->got,
           c->relative ? "rel. error" : "error     ", c->error, c->bound);
    if (c->why)
        printf("  (%s)", c->why);
    putchar('\n');
}

int cli_verify(int argc, char **argv)
{
    static const cli_spec spec = {
        .synopsis = "rollbem verify",
        .about =
            "Computes every closed-form and published reference of docs/theory.md 6 and\n"
            "prints what was wanted, what came out, the error and its bound, one line\n"
            "each. Exit code 0 only if all hold."};
    cli_args args = {0};
    cli_exit code = cli_parse(&spec, argc, argv, &args);
    if (code == CLI_CONTINUE && args.operands > 0)
        code = cli_fail(CLI_USAGE, "verify: unexpected '%s'", args.operand[0]);
    if (code == CLI_CONTINUE) {
        int count = 0;
        if (cli_reader_is_person())
            printf("%-5s %-43s %9s %9s %8s\n", "", "", "wanted", "got", "error");
        const int failed = rb_verify_run(print_check, &count);
        printf("%d of %d references hold\n", count - failed, count);
        code = failed ? CLI_UNSOLVED : CLI_OK;
    }
    cli_args_free(&args);
    return code;
}
