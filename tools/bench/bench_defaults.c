/* The mesh that the program chooses beside equal elements of the same number, steady rolling:
 * processor time of a whole solution, the least of as many as half a second holds, three to fifty,
 * because the first ones of a process take up to four times as long; with the reading of options
 * and the search for free rolling, and Q/(mu P) on both. */
#include "fast_blas.h"
#include "keep_memory.h"
#include "rolling/case/case.h"
#include "rows.h"

#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name, *options; /* name value name value ... */
    int n;
} rows[] = {{"rigid plane", "support halfplane", 100},
            {"rigid plane", "support halfplane", 400},
            {"similar", "support halfplane similar yes", 100},
            {"aluminium on steel", "support halfplane young 70000 poisson .33 young-b 210000", 100},
            {"hub", "support hub hub-ratio .3", 60},
            {"hub", "support hub hub-ratio .3", 100},
            {"arc", "support arc", 60},
            {"arc", "support arc", 100},
            {"rigid plane, mu beta = 1.1", "support halfplane mu 2.5", 1600},
            {"rigid plane, mu beta = 4.4", "support halfplane mu 10", 1600}};

typedef struct {
    double seconds, force_ratio;
} outcome;

static rb_status set_words(rb_case *c, const char *options, rb_message *why)
{
    char text[200], *rest = text;
    rb_status s = RB_OK;

    snprintf(text, sizeof text, "%s", options);
    for (char *name; s == RB_OK && (name = strtok_r(rest, " ", &rest));) {
        const char *value = strtok_r(NULL, " ", &rest);
        s = rb_case_set(c, name, value, RB_GIVEN_ARGUMENT, why);
    }
    return s;
}

static outcome solve_row(int row, const char *mesh)
{
    enum { LEAST = 3, MOST = 50 };
    outcome o = {INFINITY, 0.0};
    double spent = 0.0;

    for (int k = 0; k < MOST && (k < LEAST || spent < 0.5) && !(k > 0 && o.seconds > 2.0); k++) {
        rb_message why = {.text = ""};
        rb_case_result result = {0};
        const double start = processor_seconds();
        rb_case *c = rb_case_create(RB_CASE_SINGLE);
        rb_status s =
            c ? set_words(c, "half-width 1 formulation steady creep-ratio .4", &why) : RB_ENOMEM;
        if (s == RB_OK)
            s = rb_case_set_number(c, "contact-elements", rows[row].n, &why);
        if (s == RB_OK)
            s = set_words(c, rows[row].options, &why);
        if (s == RB_OK)
            s = set_words(c, mesh, &why);
        if (s == RB_OK)
            s = rb_case_resolve(c, &why);
        if (s == RB_OK)
            s = rb_case_solve(rb_case_resolved(c), NULL, NULL, &result, &why);
        if (s != RB_OK) {
            fprintf(stderr, "bench_defaults: %s: %s\n", rows[row].name, why.text);
            exit(70);
        }
        const double seconds = processor_seconds() - start;
        spent += seconds;
        o.seconds = fmin(o.seconds, seconds);
        o.force_ratio = result.solution.force_ratio;
        rb_case_result_free(&result);
        rb_case_free(c);
    }
    return o;
}

int main(int argc, char **argv)
{
    (void)argc;
    fast_blas(argv);
    keep_memory();
    solve_row(0, ""); /* what the first solution of a process alone takes */
    printf("| | elements | default | equal | ratio | Q/(mu P), default | equal |\n"
           "|---|---|---|---|---|---|---|\n");
    for (int k = 0; k < (int)(sizeof rows / sizeof *rows); k++) {
        const outcome chosen = solve_row(k, ""), equal = solve_row(k, "mesh uniform");
        printf("| %s | %s | %s | %s | %.1f | %.4f | %.4f |\n", rows[k].name,
               row_count(rows[k].n).text, row_seconds(chosen.seconds).text,
               row_seconds(equal.seconds).text, chosen.seconds / equal.seconds, chosen.force_ratio,
               equal.force_ratio);
        fflush(stdout);
    }
    return 0;
}
