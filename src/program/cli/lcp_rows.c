/* What `rollbem lcp` prints of a file: pivots, unknowns, members of its JSON. */
#include "program/cli/lcp_run.h"

#include <jansson.h>
#include <math.h>

static const char *variable(int n, int v, char buffer[24])
{
    if (v == 2 * n)
        return "z0";
    snprintf(buffer, 24, "%c(%d)", v < n ? 'w' : 'z', v % n + 1);
    return buffer;
}

void cli_lcp_trace(const rb_lcp_pivot *p, void *context)
{
    lcp_run *run = context;
    char in[24], out[24];
    const cli_value values[] = {CLI_TEXT(NULL, "file", run->file),
                                CLI_WHOLE(NULL, "pivot", p->pivot + 1),
                                CLI_TEXT("entering", "entering", variable(p->n, p->entering, in)),
                                CLI_TEXT("leaving", "leaving", variable(p->n, p->leaving, out)),
                                CLI_WHOLE("row", "row", p->row + 1),
                                CLI_NUMBER("ratio", "ratio", p->ratio),
                                CLI_NUMBER("z0", "z0", p->z0)};
    cli_rows_add(run->files.rows.is_json ? &run->pivots : &run->files.rows,
                 sizeof values / sizeof *values, values);
}

static json_t *vector(int n, const double *x)
{
    return x ? rb_report_json_numbers(n, x) : json_null();
}

/* 0: nothing is known of the problem, which was not read. */
int cli_lcp_is_known(const lcp_result *r)
{
    return r->n > 0 || r->is_empty;
}

/* What --game, --all, --solution, --prove and --trace add to the object of the file. */
void cli_lcp_add_members(const lcp_run *run, cli_rows *rows, const lcp_result *r)
{
    const lcp_options *o = run->o;
    const int known = cli_lcp_is_known(r);
    if (o->game) {
        cli_rows_set(rows, "payoffs", known ? rb_report_json_numbers(2, r->payoff) : json_null());
        cli_rows_set(rows, "label",
                     r->info.label >= 0 ? json_integer(r->info.label + 1) : json_null());
    }
    if (o->all) {
        json_t *list = json_array(), *sets = r->sets ? json_array() : json_null();
        for (int k = 0; k < r->solutions; k++) {
            json_t *one =
                json_pack("{s:o, s:o, s:b, s:b}", "z", vector(r->n, r->z + (size_t)k * r->n), "w",
                          vector(r->n, r->w + (size_t)k * r->n), "singular_basis",
                          r->singular_basis ? r->singular_basis[k] : 0, "nearby",
                          r->nearby ? r->nearby[k] : 0);
            if (k < r->number.proofs)
                rb_report_json_set(&one, "proof", rb_report_json_proof(&r->number.proof[k]));
            rb_report_json_append(&list, one);
        }
        for (int k = 0; k < r->sets; k++) {
            json_t *members = json_array();
            for (int l = r->set[k]; l < r->set[k + 1]; l++)
                rb_report_json_append(&members, json_integer(r->member[l] + 1));
            rb_report_json_append(&sets, members);
        }
        cli_rows_set(rows, "solutions", list);
        cli_rows_set(rows, "singular", known ? json_integer(r->singular) : json_null());
        cli_rows_set(rows, "undecided", known ? json_integer(r->undecided) : json_null());
        if (o->game)
            cli_rows_set(rows, "sets", sets);
        else
            json_decref(sets);
    } else if (o->solution) {
        cli_rows_set(rows, "z", vector(r->n, r->z));
        cli_rows_set(rows, "w", vector(r->n, r->w));
    }
    if (o->prove && o->all)
        cli_rows_set(rows, "number",
                     r->is_counted ? rb_report_json_number_of_solutions(&r->number) : json_null());
    else if (o->prove)
        cli_rows_set(rows, "proof", r->proof.n ? rb_report_json_proof(&r->proof) : json_null());
    if (o->trace)
        cli_rows_set(rows, "pivots", json_incref(run->pivots.list));
}

/* A # line of the file, and a row per unknown of each solution. */
void cli_lcp_list_unknowns(const lcp_run *run, cli_rows *rows, const lcp_result *r)
{
    char residual[40] = "", label[40] = ""; /* without a solution there is none */
    const char *counted = run->o->all          ? r->info.iters == 1 ? "basis" : "bases"
                          : r->info.iters == 1 ? "pivot"
                                               : "pivots";
    if (isfinite(r->info.res))
        snprintf(residual, sizeof residual, ", scaled residual %.3g", r->info.scaled);
    if (r->info.label >= 0)
        snprintf(label, sizeof label, " from label %d", r->info.label + 1);
    rb_report_comment(&rows->cells, "%s: %s by %s%s, n = %d, %d %s%s, %.3g s", r->file, r->status,
                      r->solver, label, r->n, r->info.iters, counted, residual, r->seconds);
    for (int k = 0; k < r->sets; k++) {
        char text[400] = "";
        for (int l = r->set[k]; l < r->set[k + 1]; l++)
            rb_append(text, sizeof text, " %d", r->member[l] + 1);
        rb_report_comment(&rows->cells, "maximal set %d: solutions%s", k + 1, text);
    }
    for (int k = 0; k < r->solutions && !run->o->trace && r->z; k++)
        for (int i = 0; i < r->n; i++) {
            const size_t at = (size_t)k * (size_t)r->n + (size_t)i;
            const rb_lcp_proof *proof = k < r->number.proofs ? &r->number.proof[k] : &r->proof;
            const double within =
                proof->proved ? fabs(r->z[at] - proof->z[i]) + proof->error[i] : NAN;
            const cli_value unknown[] = {
                CLI_TEXT(NULL, "file", r->file), CLI_WHOLE(NULL, "solution", k + 1),
                CLI_WHOLE(NULL, "i", i + 1),     CLI_NUMBER(NULL, "z", r->z[at]),
                CLI_NUMBER(NULL, "w", r->w[at]), CLI_NUMBER(NULL, "within", within)};
            cli_rows_add(rows, sizeof unknown / sizeof *unknown, unknown);
        }
}
