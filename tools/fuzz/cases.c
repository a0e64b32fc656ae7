/* What a case reads: its file, and the tables of gap, history and of any columns. */
#include "fuzz.h"
#include "base/io/io.h"
#include "lcp/friction/friction.h"
#include "rolling/case/options.h"
#include "rolling/case/case.h"

#include <math.h>
#include <stdlib.h>

/* A copy of a case that is made once, since to make one resolves all its options. */
static rb_case *new_case(void)
{
    static rb_case *untouched;
    if (!untouched)
        untouched = rb_case_create(RB_CASE_SINGLE);
    rb_case *c = untouched ? rb_case_copy(untouched) : NULL;
    fuzz_require(c != NULL, "there is memory");
    rb_case_use_cone_solvers(c, rb_friction_cone_solver);
    return c;
}

/* What is resolved are finite numbers, but for those that say that there is none. */
static void require_resolved(const rb_case *c)
{
    const rb_resolved_case *resolved = rb_case_resolved(c);
    fuzz_require(resolved->rc.mu >= 0.0 && isfinite(resolved->rc.mu), "0 <= mu < infinity");
    fuzz_require(resolved->rc.contact_elements > 0, "there are elements");
    fuzz_require(isfinite(resolved->derived.modulus), "E* is a number");
}

static void resolve(rb_case *c)
{
    rb_message why = {.text = ""};
    const rb_status s = rb_case_resolve(c, &why);
    fuzz_require_reason(s, &why);
    if (s == RB_OK)
        require_resolved(c);
}

void fuzz_ini(const uint8_t *data, size_t size)
{
    static const rb_case_purpose purposes[] = {RB_CASE_SINGLE, RB_CASE_CURVE, RB_CASE_WEAR};
    char *text = fuzz_text(data, size);
    rb_case *c = new_case();
    rb_message why = {.text = ""};
    const rb_status s = rb_case_read_text(c, "case.ini", text, &why);
    fuzz_require_reason(s, &why);
    for (int k = 0; s == RB_OK && k < 3; k++) {
        rb_case_set_purpose(c, purposes[k]);
        resolve(c);
    }
    rb_case_free(c);
    free(text);
}

static void resolve_with_file(const char *const (*option)[2], int n, const uint8_t *data,
                              size_t size)
{
    rb_case *c = new_case();
    rb_message why = {.text = ""};
    fuzz_keep("table", data, size);
    for (int k = 0; k < n; k++)
        fuzz_require(rb_case_set(c, option[k][0], option[k][1], RB_GIVEN_ARGUMENT, &why) == RB_OK,
                     "the options of the target are options");
    resolve(c);
    rb_case_free(c);
}

void fuzz_gap(const uint8_t *data, size_t size)
{
    static const char *const options[][2] = {{"support", "halfplane"},   {"load", "100"},
                                             {"contact-elements", "12"}, {"zone", "1"},
                                             {"gap-smoothing", "1e-5"},  {"gap", "table"}};
    resolve_with_file(options, 6, data, size);
    resolve_with_file(options + 5, 1, data, size);
    static const char *const others[][2] = {{"irregularity", "table"}};
    resolve_with_file(others, 1, data, size);
    static const char *const worn[][2] = {{"worn", "table"}};
    resolve_with_file(worn, 1, data, size);
}

void fuzz_history(const uint8_t *data, size_t size)
{
    static const char *const rolling[][2] = {
        {"formulation", "transient"}, {"support", "halfplane"}, {"history", "table"}};
    static const char *const in_place[][2] = {{"formulation", "static"}, {"history", "table"}};
    resolve_with_file(rolling, 3, data, size);
    resolve_with_file(in_place, 2, data, size);
}

void fuzz_table(const uint8_t *data, size_t size)
{
    rb_io_table t;
    rb_message why = {.text = ""};
    fuzz_keep("table", data, size);
    rb_status s = rb_io_table_read("table", &t, &why);
    fuzz_require_reason(s, &why);
    if (s == RB_OK) {
        fuzz_require(t.rows > 0 && t.columns > 0, "a table has rows and columns");
        for (int k = 0; k < t.rows * t.columns; k++)
            fuzz_require(isfinite(t.x[k]) || (isnan(t.x[k]) && t.name),
                         "the numbers of a table are finite, or missing in a named column");
        for (int j = 0; t.name && j < t.columns; j++)
            fuzz_require(rb_io_table_column(&t, t.name[j]) == t.x + (size_t)j * (size_t)t.rows,
                         "a column is found by its name");
        static const rb_io_column known[] = {{"x", "a", "mm", RB_IO_COLUMN_NEEDED},
                                             {"gap", "b|g", "mm", RB_IO_COLUMN_NEEDED}};
        const double *x[2];
        rb_message why_not = {.text = ""};
        s = rb_io_table_assign("table", &t, 2, known, RB_UNITS_SI, x, &why_not);
        fuzz_require_reason(s, &why_not);
        fuzz_require(s != RB_OK || (x[0] && x[1]), "needed columns are there");
    }
    rb_io_table_free(&t);
    rb_message why_words = {.text = ""};
    s = rb_io_table_read_words("table", &t, &why_words);
    fuzz_require_reason(s, &why_words);
    for (int k = 0; s == RB_OK && k < t.rows * t.columns; k++)
        fuzz_require(isfinite(t.x[k]) == !t.word[k], "a cell is a number or a word");
    rb_io_table_free(&t);
}
