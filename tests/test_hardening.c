/* The program and the shared library as the Makefile hardens them: what the linker wrote
 * into them says so. */
#include "cli_run.h"

static void check_lines_of(const char *readelf, const char *part)
{
    assert_int_equal(shellf("readelf %s", readelf), 0);
    if (!strstr(out, part))
        fail_msg("readelf %s: no '%s'", readelf, part);
}

static void skip_where_nothing_is_hardened(void)
{
#if SANITIZED
    print_message("skipped: sanitizers replace the hardening\n");
    skip();
#endif
    if (shell("readelf --version") == 0)
        return;
    print_message("skipped: readelf is not installed\n");
    skip();
}

TEST(the_program_is_hardened)
{
    skip_where_nothing_is_hardened();
    check_lines_of("-hW \"$R\"", "DYN");
    check_lines_of("-lW \"$R\"", "GNU_RELRO");
    check_lines_of("-dW \"$R\"", "BIND_NOW");
    check_lines_of("-dW \"$R\"", "PIE");
    check_lines_of("--dyn-syms -W \"$R\"", "__stack_chk_fail");
    check_lines_of("--dyn-syms -W \"$R\"", "printf_chk");
}

TEST(the_library_is_hardened)
{
    skip_where_nothing_is_hardened();
    check_lines_of("-lW \"${R%/*}/librollbem.so\"", "GNU_RELRO");
    check_lines_of("-dW \"${R%/*}/librollbem.so\"", "BIND_NOW");
    check_lines_of("--dyn-syms -W \"${R%/*}/librollbem.so\"", "__stack_chk_fail");
    check_lines_of("--dyn-syms -W \"${R%/*}/librollbem.so\"", "printf_chk");
}

RUN_TESTS(enter_folder, leave_folder)
