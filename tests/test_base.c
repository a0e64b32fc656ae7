#include "check.h"
#include "base/base.h"

TEST(refusals_write_their_line)
{
    CHECK_STATUS(rb_fail(&message, RB_EINVAL, "mu = %g: expected >= 0", -1.0), RB_EINVAL);
    assert_string_equal(message.text, "mu = -1: expected >= 0");
    CHECK_STATUS(rb_fail(NULL, RB_ENOMEM, "nobody listens"), RB_ENOMEM);
}

TEST(arrays_are_zeroed_and_overflow_is_refused)
{
    SCRATCH double *a = NOT_NULL(rb_alloc(3, 5));
    for (int i = 0; i < 15; i++)
        CHECK_ABS(a[i], 0.0, 0.0, "entry %d", i);
    assert_null(rb_alloc(SIZE_MAX / 2, 3));
    alloc_fail_after(0);
    assert_null(rb_alloc(1, 1));
    alloc_succeed();
}

TEST(a_copy_is_an_array_of_its_own)
{
    const double x[] = {1.0, -2.5};
    double *copy = rb_copy(2, x);
    CHECK_ABS(copy[0], 1.0, 0.0, "entry 0");
    CHECK_ABS(copy[1], -2.5, 0.0, "entry 1");
    free(copy);
    copy = rb_copy(0, NULL); /* to be freed as any other */
    assert_non_null(copy);
    free(copy);
    alloc_fail_after(0);
    assert_null(rb_copy(2, x));
    alloc_succeed();
}

TEST(an_arena_fails_once_and_for_all_and_is_freed_at_once)
{
    rb_arena arena = {0};
    double *a = rb_arena_doubles(&arena, 3, 5);
    int *k = rb_arena_ints(&arena, 7);
    char *bytes = rb_arena_zeros(&arena, 5, 3);
    assert_true(a && k && bytes && !arena.failed);
    for (int i = 0; i < 15; i++)
        assert_true(a[i] == 0.0 && bytes[i] == 0 && k[i % 7] == 0);
    memset(a, 1, 15 * sizeof *a); /* the address sanitizer sees whether it is all ours */
    memset(k, 1, 7 * sizeof *k);
    memset(bytes, 1, 15);
    assert_int_equal((uintptr_t)a % sizeof(double), 0);
    alloc_fail_after(0);
    assert_null(rb_arena_doubles(&arena, 2, 2));
    alloc_succeed();
    assert_true(arena.failed);
    assert_null(rb_arena_ints(&arena, 1));
    CHECK_STATUS(rb_arena_done(&arena, RB_ENOMEM), RB_ENOMEM);

    assert_non_null(rb_arena_doubles(&arena, 0, 4)); /* empty again: it may be used once more */
    assert_null(rb_arena_doubles(&arena, SIZE_MAX / 2, 3));
    assert_true(arena.failed);
    CHECK_OK(rb_arena_done(&arena, RB_OK));
    assert_null(rb_arena_zeros(&arena, SIZE_MAX / 4, 4));
    CHECK_OK(rb_arena_done(&arena, RB_OK));
    CHECK_OK(rb_arena_done(&arena, RB_OK)); /* of nothing */
}

TEST(absurd_sizes_are_refused_by_name)
{
    CHECK_OK(rb_memory_check(1e3, "a small thing", &message));
    CHECK_SAYS(rb_memory_check(1e18, "a contact of 9 elements", &message), RB_EINVAL,
               "a contact of 9 elements would need 1e+09 GB");
}

TEST(the_norm_does_not_lose_a_nan)
{
    const double x[] = {1.0, -3.0, 2.0}, y[] = {1.0, NAN, 2.0};
    CHECK_ABS(rb_norm_inf(3, x), 3.0, 0.0, "norm");
    assert_true(isnan(rb_norm_inf(3, y)));
}

/* cblas_dasum of OpenBLAS on AVX-512 differs here from 64 entries or so on. */
TEST(the_sum_does_not_depend_on_the_address)
{
    enum { N = 1000 };
    double room[N + 8];
    for (int shift = 0; shift < 8; shift++) {
        double *x = room + shift, sum = 0.0, even = 0.0;
        for (int i = 0; i < N; i++)
            x[i] = sin(i + 0.5);
        for (int i = 0; i < N; i++) {
            sum += fabs(x[i]);
            even += i % 2 == 0 ? fabs(x[i]) : 0.0;
        }
        CHECK_ABS(rb_norm_1(N, x, 1), sum, 0.0, "sum");
        CHECK_ABS(rb_norm_1(N / 2, x, 2), even, 0.0, "every second entry");
    }
}

/* 1e16 + 1 - 1e16 and such: signs that rounded sums do not see. */
TEST(signs_of_sums_are_exact)
{
    const double a[] = {1e16, 1.0, -1e16, 0.1}, ones[] = {1.0, 1.0, 1.0, 1.0};
    assert_int_equal(rb_exact_sign(3, a, ones), 1);
    const double thirds[] = {1.0 / 3.0, -1.0 / 3.0 - 0x1p-54}, half[] = {3.0, 3.0};
    assert_int_equal(rb_exact_sign(1, thirds, half), 1);
    assert_int_equal(rb_exact_sign(2, thirds, half), thirds[0] + thirds[1] == 0.0 ? 0 : -1);
    /* x y - fl(x y) is the rounding of the product */
    const double x[] = {0.1, -0.1 * 0.3}, y[] = {0.3, 1.0};
    assert_int_equal(rb_exact_sign(2, x, y),
                     (fma(0.1, 0.3, -0.1 * 0.3) > 0.0) - (fma(0.1, 0.3, -0.1 * 0.3) < 0.0));
    unsigned long long seed = 5;
    for (int k = 0; k < 300; k++) { /* numbers and their opposites, in another order */
        enum { N = 24 };
        double p[N], q[N];
        for (int i = 0; i < N; i++) {
            seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
            p[i] = ldexp((double)(seed >> 20), (int)(seed % 90) - 70);
            q[i] = ldexp((double)(seed % 1000003), 3);
        }
        for (int i = 0; i < N / 2; i++) {
            p[N / 2 + i] = -p[(7 * i + 3) % (N / 2)];
            q[N / 2 + i] = q[(7 * i + 3) % (N / 2)];
        }
        assert_int_equal(rb_exact_sign(N, p, q), 0);
        p[k % N] = nextafter(p[k % N], INFINITY);
        assert_int_equal(rb_exact_sign(N, p, q), q[k % N] > 0.0 ? 1 : 0);
    }
    const double tiny[] = {1e-300}, less[] = {1e-200};
    assert_int_equal(rb_exact_sign(1, tiny, less), RB_SIGN_UNKNOWN);
    assert_int_equal(rb_exact_sign(0, tiny, less), 0);
}

TEST(every_status_has_its_own_words)
{
    for (int i = RB_EHELPER; i <= RB_TIME_LIMIT; i++)
        for (int j = RB_EHELPER; j < i; j++)
            assert_string_not_equal(rb_status_text((rb_status)i), rb_status_text((rb_status)j));
}

TEST(what_went_wrong_has_its_words)
{
    const rb_message said = {.text = "why"}, nothing = {.text = ""};
    char room[6];
    assert_string_equal(rb_status_text((rb_status)99), "unknown status");
    assert_string_equal(rb_status_reason(RB_ENOMEM, &nothing), "out of memory");
    assert_string_equal(rb_status_reason(RB_ENOMEM, &said), "why");
    assert_int_equal(rb_lapack_status(0), RB_OK);
    assert_int_equal(rb_lapack_status(3), RB_SINGULAR);
    assert_int_equal(rb_lapack_status(-4), RB_SINGULAR);
    assert_int_equal(rb_lapack_status(-1010), RB_ENOMEM);
    assert_string_equal(rb_printable("abc\x01zzz", room, sizeof room), "abc");
    char text[6] = "ab";
    rb_append(text, sizeof text, "%d", 34);
    assert_string_equal(text, "ab34");
    rb_append(text, sizeof text, "%s", "5678");
    assert_string_equal(text, "ab345");
    rb_append(text, sizeof text, "9");
    assert_string_equal(text, "ab345");
}

/* Anything that is no printable character of UTF-8 is shown by its bytes, and no
 * character is cut in two. */
TEST(the_words_of_a_list_stand_between_commas)
{
    static const char *const wanted[] = {"mu", "", "radiu"};
    const char *rest = "mu,,radius,";
    char word[6] = "?"; /* the last one is too long for it */
    for (int k = 0; k < 3; k++) {
        assert_non_null(rest = rb_next_word(rest, word, sizeof word));
        assert_string_equal(word, wanted[k]);
    }
    assert_null(rb_next_word(rest, word, sizeof word));
    assert_null(rb_next_word(NULL, word, sizeof word));
}

TEST(only_characters_are_printed)
{
    static const struct {
        const char *text, *shown;
        size_t room; /* 0: enough */
    } all[] = {{"a~ ", "a~ ", 0},
               {"\x1f\x7f\n", "\\x1f\\x7f\\x0a", 0},
               {"\xc2\xa0\xc3\xa9", "\xc2\xa0\xc3\xa9", 0},
               {"\xc2\x9f", "\\xc2\\x9f", 0},               /* a control character */
               {"\x80z", "\\x80z", 0},                      /* no beginning */
               {"\xc3z", "\\xc3z", 0},                      /* no end */
               {"\xc1\xbf", "\\xc1\\xbf", 0},               /* too long for its number */
               {"\xe0\xa0\x80", "\xe0\xa0\x80", 0},         /* U+0800, the first of three */
               {"\xe0\x9f\xbf", "\\xe0\\x9f\\xbf", 0},      /* too long */
               {"\xed\x9f\xbf", "\xed\x9f\xbf", 0},         /* below the surrogates */
               {"\xed\xa0\x80", "\\xed\\xa0\\x80", 0},      /* the first of them */
               {"\xed\xbf\xbf", "\\xed\\xbf\\xbf", 0},      /* the last */
               {"\xee\x80\x80", "\xee\x80\x80", 0},         /* behind them */
               {"\xf0\x90\x80\x80", "\xf0\x90\x80\x80", 0}, /* U+10000 */
               {"\xf4\x8f\xbf\xbf", "\xf4\x8f\xbf\xbf", 0}, /* U+10FFFF, the last */
               {"\xf4\x90\x80\x80", "\\xf4\\x90\\x80\\x80", 0},
               {"\xff", "\\xff", 0},
               {"abc", "ab", 3},
               {"\xe2\x82\xac", "", 3},
               {"\xe2\x82\xac", "\xe2\x82\xac", 4},
               {"\x01z", "", 4},
               {"\x01z", "\\x01", 5}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        char room[40];
        memset(room, 'x', sizeof room);
        assert_ptr_equal(rb_printable(all[k].text, room, all[k].room ? all[k].room : sizeof room),
                         room);
        if (strcmp(room, all[k].shown) != 0)
            fail_msg("row %zu: '%s', expected '%s'", k, room, all[k].shown);
        if (all[k].room)
            assert_int_equal(room[all[k].room], 'x');
    }
}

/* The first of 15, 16 and 17 digits that reads back. */
static void check_number_text(double x)
{
    char want[40], got[RB_NUMBER_TEXT];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(want, sizeof want, "%.*g", digits, x);
        if (strtod(want, NULL) == x)
            break;
    }
    assert_string_equal(rb_number_text(x, got), want);
}

TEST(numbers_have_the_fewest_digits_that_read_back)
{
    static const double ends[] = {0.0,     -0.0,    0.1,    1e15,   999999999999999.9,  1e-4,
                                  9.99e-5, 1e22,    5e-324, 1e23,   9007199254740993,   0.3,
                                  1e-11,   2.2e-16, 1e308,  123456, 0.5000000000000001, 1e16};
    uint64_t seed = 88172645463325252;
    for (size_t k = 0; k < sizeof ends / sizeof *ends; k++)
        for (int side = -1; side <= 1; side++)
            check_number_text(side ? nextafter(ends[k], side * INFINITY) : ends[k]);
    for (int e = -1074; e < 1024; e++) /* with neighbours that are not equally far */
        check_number_text(-ldexp(1.0, e));
    for (int k = 0; k < 40000; k++) {
        double x;
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        memcpy(&x, &seed, sizeof x);
        if (isfinite(x))
            check_number_text(x);
        check_number_text(ldexp((double)(seed >> 12), -(int)(seed % 64)));
        check_number_text((double)(seed >> 40) / pow(10.0, (double)(seed % 60)));
        check_number_text((double)(seed >> 12) + 0.5); /* halfway between decimals */
    }
}

/* A third of the letters may be wrong: left out, one more, another one, two swapped. */
TEST(misspelt_words_are_guessed)
{
    static const char *const names[] = {"creep", "load", "load-factor", "mu"};
    static const struct {
        const char *word, *meant;
    } all[] = {{"laod", "load"},
               {"lod", "load"},
               {"loadd", "load"},
               {"lpad", "load"},
               {"lpxx", ""},
               {"laod-factro", "load-factor"},
               {"m", "mu"},
               {"um", "mu"},
               {"x", ""},
               {"cre", "creep"}, /* a beginning */
               {"lo", ""},
               {"peerc", ""},
               {"load-facotr", "load-factor"},
               {"creeeep", "creep"},
               {"creeeeep", "creep"},
               {"creeeeeep", ""},
               {"a-word-that-is-longer-than-any-name-of-an-option", ""}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        rb_guess guess = {.word = all[k].word};
        char wanted[60] = "";
        for (size_t i = 0; i < sizeof names / sizeof *names; i++)
            rb_guess_try(&guess, names[i]);
        if (*all[k].meant)
            snprintf(wanted, sizeof wanted, " (did you mean '--%s'?)", all[k].meant);
        if (strcmp(rb_guess_text(&guess, "--"), wanted) != 0)
            fail_msg("%s: %s", all[k].word, guess.text);
    }
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzabcdefghijklmnop"; /* 42 */
    for (int off = 0; off < 4; off++) { /* more than 40 letters are compared no more */
        rb_guess guess = {.word = letters + off};
        rb_guess_try(&guess, letters);
        assert_int_equal(guess.distance, 40);
        rb_guess_try(&guess, letters + off);
        assert_int_equal(guess.distance, off < 2 ? 40 : 0);
    }
    rb_guess none = {.word = "load"};
    assert_string_equal(rb_guess_text(&none, "--"), "");
}

RUN_TESTS(NULL, NULL)
