/* rollbem prony: series of relaxation times from moduli over the frequency. */
#include "cli_run.h"
#include "analysis/prony/prony.h"

#include <complex.h>

enum { MOST = 100 };

typedef struct {
    double omega[MOST], storage[MOST], loss[MOST];
    rb_prony_data d;
} moduli;

typedef double complex material(double omega);

static double complex three_terms(double omega)
{
    return 10.0 / (1.0 + 0.5 / (1.0 + 1e-3 * I * omega) + 1.5 / (1.0 + 0.1 * I * omega) +
                   0.8 / (1.0 + 5.0 * I * omega));
}

static double complex fractional_half(double omega)
{
    const double complex z = csqrt(1e-3 * I * omega);
    return 1.0 + 99.0 * z / (1.0 + z);
}

static double complex fractional(double omega)
{
    const double complex z = cpow(0.01 * I * omega, 0.6);
    return 2.0 + 10.0 * z / (1.0 + z);
}

/* Five frequencies per decade from 10^from on. */
static void sample(material *of, double from, int n, moduli *m)
{
    for (int i = 0; i < n; i++) {
        m->omega[i] = pow(10.0, from + 0.2 * i);
        const double complex E = of(m->omega[i]);
        m->storage[i] = creal(E);
        m->loss[i] = cimag(E);
    }
    m->d = (rb_prony_data){n, m->omega, m->storage, m->loss};
}

static void check_ok(rb_status s, const rb_message *why)
{
    if (s != RB_OK)
        fail_msg("status %d: %s", (int)s, why->text);
}

/* A number to the digits that are printed. */
#define CHECK_DIGITS(got, want, last) CHECK_ABS(got, want, 0.5000001 * (last), "%s", #got)

/* ---- Figures of independent computations ------------------------------------------------- */

/* What was measured is printed as it was given, whatever its units. */
TEST(measured_numbers_come_back)
{
    write_file("as-given.tsv", "frequency_Hz storage_modulus_MPa tan_delta\n0.01 8.657 0.019\n"
                               "0.0261 8.771 0.0419\n0.11 9.396 0.0525\n1 10.2 0.07\n"
                               "10 11.5 0.09\n100 13.1 0.12\n");
    assert_int_equal(rollbem("prony as-given.tsv --quiet"), 0);
    assert_non_null(strstr(out, "\t0.0261\t8.771\t"));
    assert_non_null(strstr(out, "\t0.0419\t"));
    assert_int_equal(rollbem("prony as-given.tsv --quiet --units si"), 0);
    assert_non_null(strstr(out, "\t0.0261\t8771000\t"));
}

TEST(three_terms_at_three_spacings)
{
    static const struct {
        int per_decade;
        double rms, rms_last, young, young_last, sum;
    } wanted[] = {{1, 6.9e-2, 1e-3, 10.54, 1e-2, 3.071},
                  {2, 5.4e-3, 1e-4, 10.002, 1e-3, 2.821},
                  {4, 9.5e-4, 1e-5, 10.0003, 1e-4, 2.804}};
    static moduli m;
    rb_prony_series s;
    rb_message why = {.text = ""};
    sample(three_terms, -2.0, 31, &m);
    for (int k = 0; k < 3; k++) {
        check_ok(rb_prony_fit(&m.d, wanted[k].per_decade, &s, &why), &why);
        CHECK_DIGITS(s.rms, wanted[k].rms, wanted[k].rms_last);
        CHECK_DIGITS(s.young, wanted[k].young, wanted[k].young_last);
        CHECK_DIGITS(s.young / rb_prony_slow(&s) - 1.0, wanted[k].sum, 1e-3);
        assert_int_equal(s.terms, 6);
    }
}

TEST(pairs_of_neighbours_are_one_term)
{
    static moduli m;
    rb_prony_series s;
    rb_message why = {.text = ""};
    sample(three_terms, -2.0, 31, &m);
    check_ok(rb_prony_fit(&m.d, 2.0, &s, &why), &why);
    check_ok(rb_prony_join(&m.d, &s, &why), &why);
    assert_int_equal(s.terms, 3);
    assert_int_equal(s.joined, 3);
    CHECK_DIGITS(s.ratio[0], 0.499, 1e-3);
    CHECK_DIGITS(s.ratio[1], 1.500, 1e-3);
    CHECK_DIGITS(s.ratio[2], 0.804, 1e-3);
    CHECK_ABS(s.time[0], 1e-3, 5e-6, "tau 1");
    CHECK_DIGITS(s.time[1], 0.0992, 1e-4);
    CHECK_DIGITS(s.time[2], 5.079, 1e-3);
    CHECK_DIGITS(s.rms, 1.2e-3, 1e-4);

    check_ok(rb_prony_solve(&m.d, 4.0, 16, &s, &why), &why);
    CHECK_DIGITS(s.ratio[0], 0.49979, 1e-5);
    CHECK_DIGITS(s.ratio[1], 1.49975, 1e-5);
    CHECK_DIGITS(s.ratio[2], 0.80088, 1e-5);
    CHECK_DIGITS(s.rms, 2.4e-4, 1e-5);
    /* without a spacing each of them is tried */
    check_ok(rb_prony_solve(&m.d, 0.0, 16, &s, &why), &why);
    assert_true(s.rms < 1.2e-4 && s.terms == 3);
}

TEST(continuous_spectra_stay_as_they_are)
{
    static const struct {
        material *of;
        int per_decade, terms;
        double rms, rms_last, largest, largest_last;
    } wanted[] = {{fractional_half, 1, 11, 2.1e-2, 1e-3, 3.5e-2, 1e-3},
                  {fractional_half, 2, 21, 2.8e-4, 1e-5, 5.3e-4, 1e-5},
                  {fractional, 1, 11, 1.6e-2, 1e-3, 4.3e-2, 1e-3},
                  {fractional, 2, 21, 2.3e-4, 1e-5, 7.4e-4, 1e-5}};
    static moduli m;
    rb_prony_series s;
    rb_message why = {.text = ""};
    for (int k = 0; k < 4; k++) {
        sample(wanted[k].of, -3.0, 46, &m);
        check_ok(rb_prony_fit(&m.d, wanted[k].per_decade, &s, &why), &why);
        check_ok(rb_prony_join(&m.d, &s, &why), &why);
        assert_int_equal(s.joined, 0);
        assert_int_equal(s.terms, wanted[k].terms);
        CHECK_DIGITS(s.rms, wanted[k].rms, wanted[k].rms_last);
        CHECK_DIGITS(s.largest, wanted[k].largest, wanted[k].largest_last);
    }
    /* no more terms than a body has */
    check_ok(rb_prony_solve(&m.d, 2.0, 16, &s, &why), &why);
    assert_int_equal(s.terms, 16);
    assert_int_equal(s.limited, 1);
    CHECK_REL(s.per_decade, 1.5, 1e-12, "spacing");
    assert_true(s.rms < 2e-3);
}

/* ---- The least squares --------------------------------------------------------------------- */

static double noise(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 9007199254740992.0 - 0.5;
}

/* The slope of half the sum of squares by J_g f of a term at tau, over the length of its column. */
static double slope(const rb_prony_data *d, const rb_prony_series *s, double tau)
{
    double sum = 0.0, length = 0.0;
    for (int i = 0; i < d->n; i++) {
        const double complex E = d->storage[i] + I * d->loss[i];
        const double complex column = cabs(E) / (1.0 + I * d->omega[i] * tau);
        double complex J = 1.0;
        for (int k = 0; k < s->terms; k++)
            J += s->ratio[k] / (1.0 + I * d->omega[i] * s->time[k]);
        sum += creal(conj(column) * (J / s->young - 1.0 / E) * cabs(E));
        length += creal(conj(column) * column);
    }
    return sum / sqrt(length);
}

TEST(ratios_and_slopes_are_complementary)
{
    static moduli m;
    rb_prony_series s;
    rb_message why = {.text = ""};
    uint64_t seed = 3;
    for (int round = 0; round < 20; round++) {
        sample(round % 2 ? three_terms : fractional, -2.0, 31, &m);
        for (int i = 0; i < 31 && round > 1; i++) {
            m.storage[i] *= 1.0 + 0.1 * noise(&seed);
            m.loss[i] *= 1.0 + 0.1 * noise(&seed);
        }
        check_ok(rb_prony_fit(&m.d, 2.0, &s, &why), &why);
        CHECK_ABS(slope(&m.d, &s, 0.0), 0.0, 1e-9, "J_g of round %d", round);
        int terms = 0;
        for (int k = 0; k < 15; k++) {
            const double tau = pow(10.0, -4.5 + 0.5 * k), w = slope(&m.d, &s, tau);
            const int is_term = terms < s.terms && fabs(s.time[terms] / tau - 1.0) < 1e-9;
            assert_true(w > -1e-9);
            if (is_term) {
                assert_true(s.ratio[terms] > 0.0);
                CHECK_ABS(w, 0.0, 1e-9, "term %d of round %d", k, round);
            }
            terms += is_term;
        }
        assert_int_equal(terms, s.terms); /* each is one of the times */
    }
}

TEST(noise_is_what_remains)
{
    static moduli m;
    rb_prony_series s;
    rb_message why = {.text = ""};
    uint64_t seed = 5;
    sample(three_terms, -2.0, 31, &m);
    for (int i = 0; i < 31; i++) { /* 1 % */
        m.storage[i] *= 1.0 + 0.01 * sqrt(12.0) * noise(&seed);
        m.loss[i] *= 1.0 + 0.01 * sqrt(12.0) * noise(&seed);
    }
    check_ok(rb_prony_solve(&m.d, 0.0, 16, &s, &why), &why);
    assert_true(s.rms > 0.004 && s.rms < 0.013);
    assert_true(s.per_decade < 2.01); /* closer ones would follow the noise */
    CHECK_REL(s.young, 10.0, 0.02, "E_g");
    CHECK_REL(rb_prony_slow(&s), 10.0 / 3.8, 0.02, "slow loads");
}

/* ---- The command ----------------------------------------------------------------------------- */

static void write_moduli(const char *name, const char *heading, const moduli *m, double frequency,
                         int tangent)
{
    FILE *file = NOT_NULL(fopen(name, "w"));
    fprintf(file, "%s\n", heading);
    for (int i = 0; i < m->d.n; i++)
        fprintf(file, "%.17g\t%.17g\t%.17g\n", m->omega[i] * frequency, m->storage[i],
                tangent ? m->loss[i] / m->storage[i] : m->loss[i]);
    assert_int_equal(fclose(file), 0);
}

static double number_of(const json_t *root, const char *name)
{
    return json_number_value(json_object_get(root, name));
}

TEST(headings_and_units_lead_to_the_same_series)
{
    static const struct {
        const char *heading, *options;
        double frequency;
        int tangent;
    } files[] = {
        {"omega_rad/s\tstorage_modulus_MPa\ttan_delta", "", 1.0, 1},
        {"Frequency [Hz]\tE'\tE''", "", 0.15915494309189535, 0},
        {"frequency (rad/s)\tStorage modulus [MPa]\tLoss modulus [MPa]", "", 1.0, 0},
        {"f_kHz\tstorage_modulus_N/mm2\ttan delta", " --units si", 0.00015915494309189535, 1}};
    static moduli m;
    sample(three_terms, -2.0, 31, &m);
    for (int k = 0; k < 4; k++) {
        write_moduli("moduli.tsv", files[k].heading, &m, files[k].frequency, files[k].tangent);
        assert_int_equal(
            rollbemf("prony moduli.tsv --per-decade 2 --json --quiet%s", files[k].options), 0);
        held_json *root = NOT_NULL(json_loads(out, 0, NULL));
        CHECK_REL(number_of(root, "young"), k == 3 ? 10.0006e6 : 10.0006, 1e-5, "young");
        CHECK_ABS(number_of(root, "rms"), 1.2e-3, 5e-5, "rms");
        assert_int_equal(json_array_size(json_object_get(root, "points")), 31);
        /* the options are those of a case in all units */
        char words[800];
        snprintf(words, sizeof words, "%s", json_string_value(json_object_get(root, "options")));
        assert_int_equal(
            rollbemf("--support halfplane --load 50 --poisson 0.5 --formulation steady "
                     "--speed 100 --creep-ratio 0.1 %s --json --quiet",
                     words),
            0);
        held_json *rolled = NOT_NULL(json_loads(out, 0, NULL));
        const json_t *inputs = NOT_NULL(json_object_get(rolled, "inputs"));
        CHECK_REL(number_of(inputs, "young"), 10.0006, 1e-5, "young of the case");
    }
}

TEST(table_notes_and_picture)
{
    static moduli m;
    sample(three_terms, -2.0, 23, &m); /* to 10^2.4 rad/s */
    write_moduli("short.tsv", "omega_rad/s\tstorage_modulus_MPa\ttan_delta", &m, 1.0, 1);
    CHECK_RUN(rollbem("prony short.tsv"), 0, err, "E_g = ");
    assert_non_null(strstr(err, "is extrapolated: E' of the highest frequency, 251.2 rad/s"));
    assert_non_null(strstr(out, "\n# --young "));
    assert_non_null(strstr(out, "storage_modulus_MPa\tstorage_fitted_MPa\t"));
    CHECK_RUN(rollbem("prony short.tsv --per-decade 0.5"), 0, err,
              "note: the largest deviation is ");
    assert_int_equal(rollbem("prony short.tsv --quiet --plot p.svg --plot-script p.gp"), 0);
    assert_string_equal(err, "");
    assert_int_equal(shell("grep -q measured p.gp && test -s p.svg"), 0);

    write_file("elastic.tsv", "f_Hz E'_MPa tan_delta\n1 5 0\n10 5 0\n100 5 0\n");
    CHECK_RUN(rollbem("prony elastic.tsv"), 0, err, "the material is elastic");
    assert_non_null(strstr(err, "\n--young 5MPa\n"));
}

TEST(what_is_no_table_of_moduli_is_refused)
{
    static const struct {
        int code;
        const char *text, *said;
    } all[] = {
        {65, "frequency E'_MPa tan_delta\n1 5 .1\n2 5 .1\n3 5 .1\n",
         "column 'frequency': expected its unit, Hz or rad/s"},
        {65, "frequency_1/s E'_MPa tan_delta\n1 5 .1\n2 5 .1\n3 5 .1\n", "Hz or rad/s"},
        {65, "1 5 .1\n2 5 .1\n3 5 .1\n", "expected names of the columns"},
        {65, "f_Hz E'_MPa\n1 5\n2 5\n3 5\n", "one of tan_delta and loss_modulus, got neither"},
        {65, "f_Hz E'_MPa E''_MPa tan_delta\n1 5 1 .2\n2 5 1 .2\n3 5 1 .2\n", "got both"},
        {65, "E'_MPa tan_delta\n5 .2\n5 .2\n5 .2\n", "one column of frequencies"},
        {65, "f_Hz omega_rad/s E'_MPa tan_delta\n1 6 5 .2\n2 12 5 .2\n3 18 5 .2\n", "got 2"},
        {65, "f_Hz E'_MPa tan_delta\n0 5 .1\n2 5 .1\n3 5 .1\n", "bad.tsv:2: frequency"},
        {65, "f_Hz E'_MPa tan_delta\n1 5 .1\n2 -5 .1\n3 5 .1\n", "bad.tsv:3: storage_modulus"},
        {65, "f_Hz E'_MPa tan_delta\n1 5 .1\n2 5 .1\n3 5 -.1\n", "bad.tsv:4: tan_delta"},
        {65, "f_Hz E'_MPa tan_delta\n1 5 .1\n2 5 .1\n", "3 frequencies or more, got 2"},
        {65, "f_Hz G'_MPa tan_delta\n1 5 .1\n2 5 .1\n3 5 .1\n", "unknown column 'G'_MPa'"},
        {65, "f_Hz E'_K tan_delta\n1 5 .1\n2 5 .1\n3 5 .1\n", "in one of MPa, Pa"}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        write_file("bad.tsv", all[k].text);
        check_refused("prony bad.tsv", all[k].code, all[k].said);
    }
    check_refused("prony", 64, "prony: expected one FILE, got 0 files");
    check_refused("prony nothing.tsv", 66, "nothing.tsv: No such file");
    check_refused("prony bad.tsv --per-decade 20", 64, "[0.5, 8]");
    write_file("wide.tsv", "f_Hz E'_MPa tan_delta\n1e-20 5 .1\n2 6 .1\n1e20 7 .1\n");
    check_refused("prony wide.tsv --per-decade 8", 64, "expected 2 ... 200 relaxation times");
}

/* J_g of a liquid is 0: the shortest time takes its place. */
TEST(liquids_have_a_modulus_of_fast_loads_all_the_same)
{
    static moduli m;
    rb_prony_series s;
    rb_message why = {.text = ""};
    sample(three_terms, -2.0, 31, &m);
    for (int i = 0; i < 31; i++) {
        m.storage[i] = 1e-6 * m.omega[i];
        m.loss[i] = 1e-3 * m.omega[i];
    }
    check_ok(rb_prony_solve(&m.d, 0.0, 16, &s, &why), &why);
    assert_true(s.young > 10.0 && s.young < 1e4); /* 10: that of the last point */
    assert_true(s.terms > 0 && rb_prony_slow(&s) < 1e-5);
}

static rb_status solve_again(void *context)
{
    rb_prony_series s;
    return rb_prony_solve(context, 2.0, 16, &s, NULL);
}

TEST(without_memory_there_is_no_series)
{
    static moduli m;
    sample(three_terms, -2.0, 31, &m);
    assert_true(alloc_fail_each(solve_again, &m.d) > 3);
}

RUN_TESTS(enter_folder, leave_folder)
