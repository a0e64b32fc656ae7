/* What src/program/api and src/rolling/case keep to themselves: the calls that run, the names of
 * arrays, values from elsewhere against a table. */
#include "program/api/internal.h"
#include "rolling/case/words.h"
#include "check.h"
#include "two_threads.h"

static void end_calls(int forced)
{
    rb_api first = {0}, second = {0};
    rb_api_call_begins(&first);
    rb_api_call_begins(&second);
    assert_int_equal(rb_api_call_ends(&second, RB_OK), RB_OK);
    assert_int_equal(rb_blas_threads(forced ? 2 : 1), forced ? 2 : 1);
    assert_int_equal(rb_api_call_ends(&first, RB_RAY), RB_RAY);
    assert_int_equal(rb_blas_threads(1), 2);
}

/* Two at a time: the last one that ends gives the threads back. */
TEST(the_last_call_gives_the_threads_back)
{
    with_two_threads(end_calls);
}

/* As many arrays as are asked for: all derivatives of a history are more than a thousand. */
TEST(any_number_of_arrays_fits)
{
    held_api *a = rb_api_create();
    char name[20];
    api_array *first = NULL;
    for (int k = 0; k < 1500; k++) {
        snprintf(name, sizeof name, "a%d", k);
        api_array *made = NOT_NULL(rb_api_make_array(a, name, 1, 1));
        first = first ? first : made;
    }
    assert_ptr_equal(rb_api_find_array(a, "a0"), first); /* none has moved */
    rb_api_forget_arrays(a, "a1");
    assert_null(rb_api_find_array(a, "a17"));
    assert_non_null(rb_api_find_array(a, "a27"));
    assert_int_equal(rb_api_lcp(a, 1, (double[]){1.0}, (double[]){-1.0}, "lemke", 0), RB_OK);
}

/* A value from elsewhere against a table of two options, which share no bit: what the
 * file has gives way, what an argument has does not, and nothing behind the table is
 * read. */
TEST(values_from_elsewhere_resolve_a_table)
{
    struct {
        double a, b;
    } target = {1.0, 2.0};
    const struct {
        double a, b;
    } defaults = {10.0, 20.0};
    rb_option options[] = {{.name = "a", .offset = 0, .excludes = 1},
                           {.name = "b", .offset = sizeof(double), .excludes = 2}};
    int given[] = {RB_GIVEN_ARGUMENT, 3};
    const rb_option_set set = {.options = options, .n = 2, .target = &target, .given = given};
    const rb_option_precedence how = {.defaults = &defaults, .path = "case.ini"};
    rb_option other = {.name = "c", .excludes = 4};

    options[0].kind = options[1].kind = RB_OPTION_NUMBER;
    CHECK_OK(rb_option_resolve(&set, &how, &message));
    CHECK_OK(rb_option_resolve_against(&set, &how, &other, RB_GIVEN_ARGUMENT, "no", &message));
    assert_true(target.a == 1.0 && target.b == 2.0);
    other.excludes = 2;
    CHECK_OK(rb_option_resolve_against(&set, &how, &other, RB_GIVEN_ARGUMENT, "no", &message));
    assert_true(target.a == 1.0 && target.b == 20.0 && given[1] == 0);
    other.excludes = 1;
    CHECK_STATUS(rb_option_resolve_against(&set, &how, &other, RB_GIVEN_ARGUMENT, "no", &message),
                 RB_EINVAL);
    assert_string_equal(message.text, "--a: no");
}

RUN_TESTS(NULL, NULL)
