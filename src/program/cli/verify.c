/* rollbem verify: reference values and computed values. */
#include "program/cli/cli.h"
#include "program/cli/output.h"
#include "program/verify/verify.h"

#include <jansson.h>
#include <string.h>

static const rb_option options[] = {
    RB_GROUP_LINE("output", "Output"),
    RB_FLAG_LINE("json", 0, "every reference as JSON"),
};

typedef struct {
    int count, for_person; /* asked before standard output is a pager's */
} printed;

static void print_check(const rb_verify_check *c, void *context)
{
    printed *all = context;
    all->count++;
    if (all->for_person) { /* 80 columns */
        const int red = !c->holds && cli_is_coloured(stdout);
        printf("%s%-5s%s %-43s", red ? "\033[31m" : "", c->holds ? "ok" : "WRONG",
               red ? "\033[0m" : "", c->what);
        printf(strlen(c->what) > 43 ? "\n%49s %9.4g %9.4g %8.1e\n" : "%s %9.4g %9.4g %8.1e\n", "",
               c->wanted, c->got, c->error);
        return;
    }
    printf("%-6s %-56s wanted %-12.6g got %-12.6g %s %-8.2g bound %.2g", c->holds ? "ok" : "WRONG",
           c->what, c->wanted, c->got, c->relative ? "rel. error" : "error     ", c->error,
           c->bound);
    if (c->why)
        printf("  (%s)", c->why);
    putchar('\n');
}

static void list_check(const rb_verify_check *c, void *context)
{
    rb_report_json_append(context, json_pack("{s:s, s:o, s:o, s:o, s:o, s:b, s:b, s:s?}", "what",
                                             c->what, "wanted", rb_report_json_number(c->wanted),
                                             "got", rb_report_json_number(c->got), "error",
                                             rb_report_json_number(c->error), "bound",
                                             rb_report_json_number(c->bound), "relative",
                                             c->relative, "holds", c->holds, "why", c->why));
}

static rb_status write_json(FILE *out, const void *context, rb_message *why)
{
    json_t *root = rb_report_json_start(cli_command_line());
    (void)why;
    rb_report_json_set(&root, "references", json_incref(*(json_t *const *)context));
    return rb_report_json_write(out, root);
}

int cli_verify(int argc, char **argv)
{
    int json = 0;
    const cli_spec spec = {
        .synopsis = "rollbem verify [--json]",
        .about =
            "Computes every closed-form and published reference of docs/theory-solvers.md 6 and\n"
            "prints what was wanted, what came out, the error and its bound, one line\n"
            "each. Exit code 0 only if all hold.",
        .sets = {{options, sizeof options / sizeof options[0], &json, NULL, NULL}},
        .set_n = 1};
    cli_args args = {0};
    cli_exit code = cli_parse(&spec, argc, argv, &args);
    if (code == CLI_CONTINUE && args.operands > 0)
        code = cli_fail(CLI_USAGE, "verify: unexpected '%s'", args.operand[0]);
    if (code == CLI_CONTINUE && !json) {
        printed all = {0, cli_reader_is_person()};
        FILE *pager = cli_open_pager();
        if (all.for_person)
            printf("%-5s %-43s %9s %9s %8s\n", "", "", "wanted", "got", "error");
        const int failed = rb_verify_run(print_check, &all);
        printf("%d of %d references hold\n", all.count - failed, all.count);
        cli_close_pager(pager);
        code = failed ? CLI_UNSOLVED : CLI_OK;
    }
    if (code == CLI_CONTINUE) {
        json_t *all = json_array();
        const int failed = rb_verify_run(list_check, &all);
        code = cli_write_file(NULL, write_json, &all);
        json_decref(all);
        code = code == CLI_OK && failed ? CLI_UNSOLVED : code;
    }
    cli_args_free(&args);
    return code;
}
