#include "check.h"
#include "rollbem/blas.h"

#include <string.h>

static void a_better_core_is_another_one(void **state)
{
    (void)state;
    const char *core = rb_blas_core(), *better = rb_blas_better_core();
    assert_true(strlen(core) > 0);
    if (better)
        assert_string_not_equal(core, better);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_better_core_is_another_one)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
