/* What `verify` says of references that are not met: a bound that is missed, a solution
 * that failed. */
#include "check.h"
#include "program/verify/internal.h"

static void keep(const rb_verify_check *check, void *context)
{
    *(rb_verify_check *)context = *check;
}

TEST(bounds_are_of_differences_or_ratios)
{
    static const struct {
        int relative;
        double got, wanted, bound, error;
        int holds;
    } all[] = {{0, 2.5, 2.0, 0.5, 0.5, 1},    {0, 2.5, 2.0, 0.499, 0.5, 0},
               {0, -2.5, -2.0, 0.5, 0.5, 1},  {1, 2.5, 2.0, 0.25, 0.25, 1},
               {1, 2.5, -2.0, 2.25, 2.25, 1}, {1, 1.5, 2.0, 0.249, 0.25, 0},
               {0, NAN, 2.0, 1.0, NAN, 0},    {1, 2.0, NAN, 1.0, NAN, 0}};
    rb_verify_check check;
    rb_verify v = {.each = keep, .context = &check};
    int failed = 0;

    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        (all[k].relative ? rb_verify_relative : rb_verify_absolute)(&v, all[k].got, all[k].wanted,
                                                                    all[k].bound, "case %zu", k);
        char what[20];
        snprintf(what, sizeof what, "case %zu", k);
        assert_string_equal(check.what, what);
        assert_int_equal(check.relative, all[k].relative);
        assert_int_equal(check.holds, all[k].holds);
        failed += !all[k].holds;
        assert_int_equal(v.failed, failed);
        CHECK_ABS(check.bound, all[k].bound, 0.0, "bound");
        if (!isnan(all[k].error))
            CHECK_ABS(check.error, all[k].error, 1e-15, "error");
    }
}

/* The solver's own line, or, where it has none, what its status means. */
TEST(failures_have_a_reason)
{
    rb_verify_check check;
    rb_verify v = {.each = keep, .context = &check};
    rb_rolling_case rc = rb_verify_uncoupled();

    rb_verify_note(&v, RB_MAXITER, &(rb_message){.text = ""});
    assert_string_equal(v.why, rb_status_text(RB_MAXITER));
    rb_verify_note(&v, RB_MAXITER, &(rb_message){.text = "so it is"});
    rb_verify_absolute(&v, 0.0, 0.0, 0.0, "it");
    assert_string_equal(check.why, "so it is");
    rb_verify_note(&v, RB_OK, &(rb_message){.text = "of an earlier one"});
    assert_null(v.why);
    rc.a.poisson = 2.0;
    const rb_rolling_solution *s = rb_verify_solve(&v, &rc);
    assert_non_null(strstr(v.why, "oisson"));
    rb_verify_relative(&v, s->force_ratio, 0.64, 1.0, "Carter");
    assert_false(check.holds);
    assert_ptr_equal(check.why, v.why);
}

typedef struct {
    int all, failed, held, formulas;
} counts;

static void count(const rb_verify_check *check, void *context)
{
    counts *c = context;
    c->all++;
    c->failed += !check->holds;
    c->held += strncmp(check->what, "held approach", 13) == 0;
    if (strstr(check->what, "Young's modulus")) { /* of a hardness: nothing is solved */
        c->formulas += check->holds;
        return;
    }
    if (check->holds || !check->why)
        print_error("%s: got %g, %s\n", check->what, check->got, check->why ? check->why : "holds");
    assert_false(check->holds);
    assert_non_null(check->why);
}

/* Without memory no reference is met, and each says why. */
TEST(nothing_holds_without_a_solution)
{
    counts c = {0};

    alloc_fail_after(0);
    const int failed = rb_verify_run(count, &c);
    alloc_succeed();
    assert_int_equal(failed, c.failed);
    assert_true(c.all > 60);
    assert_int_equal(c.held, 3); /* also of a history that never ran */
    assert_int_equal(c.formulas, 4);
}

RUN_TESTS(NULL, NULL)
