/* Cracks under a stress that cycles: alone by Paris's law in closed form, and together with a
 * contact by a history of both. */
#include "cli_run.h"

#include <math.h>

#define ALONE                                                                                      \
    "crack --support halfplane --young 210000 --poisson 0.3 --mu 0 --unloaded --crack-angle 90 "

static double of_summary(const json_t *root, const char *name)
{
    return number_in(json_object_get(root, "summary"), name);
}

static double edge_K(double stress, double length)
{
    return 1.1215222552 * stress * sqrt(acos(-1.0) * length);
}

/* From 1 to 2 mm, int da/(C (1.1215 S sqrt(pi a))^m); compression does not open. */
TEST(paris_alone)
{
    static const struct {
        double C, m, low, high, cycles;
    } rows[] = {{1e-12, 3.0, 0.0, 100.0, 74579.02},  {1e-14, 4.0, 0.0, 100.0, 32023.82},
                {1e-9, 2.0, 0.0, 100.0, 17541.92},   {1e-12, 3.0, -70.0, 100.0, 74579.02},
                {1e-12, 3.0, 50.0, 100.0, 596632.2}, {1e-12, 3.0, -70.0, -10.0, INFINITY}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        held_json *root = run_jsonf(ALONE "--crack-length 1mm --grow-to 2mm --grow-steps 60 "
                                          "--remote-stress %g,%g --paris %g,%g",
                                    rows[k].low, rows[k].high, rows[k].C, rows[k].m);
        const double range = fmax(rows[k].high, 0.0) - fmax(rows[k].low, 0.0);
        CHECK_ABS(of_summary(root, "delta_K_I"), edge_K(range, 1.0), 1e-3, "row %zu", k);
        const json_t *cycles = json_object_get(json_object_get(root, "growth"), "cycles");
        if (isinf(rows[k].cycles)) {
            assert_int_equal(json_array_size(cycles), 1); /* it rests */
            continue;
        }
        CHECK_REL(json_number_value(json_array_get(cycles, 60)), rows[k].cycles, 2e-4, "row %zu",
                  k);
    }
}

/* A crack that leans to the surface and is closed slides to and fro: its second cycle repeats
 * itself. */
TEST(closed_crack)
{
    held_json *root = run_json("crack --support halfplane --mu 0 --unloaded --crack-angle 45 "
                               "--crack-friction 0.2 --crack-length 1mm --remote-stress -90,-10 "
                               "--passes 3");
    CHECK_ABS(of_summary(root, "delta_K_I"), 0.0, 1e-9, "closed");
    assert_true(of_summary(root, "delta_K_II") > 1.0);
    CHECK_ABS(of_summary(root, "pass_change"), 0.0, 1e-6, "repeats");
    held_json *stuck = run_json("crack --support halfplane --mu 0 --unloaded --crack-angle 45 "
                                "--crack-friction 2 --crack-length 1mm --remote-stress -90,-10");
    CHECK_ABS(of_summary(stuck, "delta_K_II"), 0.0, 1e-6, "sticks");
}

/* Without friction the tractions do not feel the bulk stress: each step is a remote stress that
 * stays.  The range is that of the sum. */
TEST(joint_cycle)
{
#define CONTACT                                                                                    \
    "crack --similar --support halfplane --gap parabola --radius 100 --young 210000 --poisson "    \
    "0.3 --mu 0 --crack-angle 90 --crack-length 0.5 --crack-mouth 1.3 --crack-friction 0 "
    static const double load[] = {200.0, 200.0, 400.0, 100.0}, bulk[] = {50.0, 150.0, 80.0, 120.0};
    write_file("both.txt", "load bulk_stress_b\n200 50\n200 150\n400 80\n100 120\n");
    held_json *root = run_json(CONTACT "--history both.txt --from 0 --states");
    const json_t *K = json_object_get(json_object_get(root, "table"), "K_I");
    double most = -INFINITY, least = INFINITY;
    assert_int_equal(json_array_size(K), 4);
    for (size_t k = 0; k < 4; k++) {
        char history[80];
        snprintf(history, sizeof history, "load\n400\n%g\n", load[k]);
        write_file("one.txt", history);
        held_json *one = run_jsonf(CONTACT "--history one.txt --from 0 "
                                           "--remote-stress %g",
                                   bulk[k]);
        const json_t *alone = json_object_get(json_object_get(one, "table"), "K_I");
        const double want = json_number_value(json_array_get(alone, 1));
        CHECK_REL(json_number_value(json_array_get(K, k)), want, 1e-6, "step %zu", k);
        most = fmax(most, want);
        least = fmin(least, want);
    }
    CHECK_REL(of_summary(root, "delta_K_I"), most - least, 1e-6, "range of the sum");
    const json_t *column = json_object_get(json_object_get(root, "history"), "bulk_stress_b");
    for (size_t k = 0; k < 4; k++)
        CHECK_REL(json_number_value(json_array_get(column, k)), bulk[k], 1e-12, "column");
}

TEST(checked)
{
    assert_int_equal(rollbem(ALONE "--crack-length 1mm --remote-stress -20,80 --passes 2 "
                                   "--crack-friction 0.3 --json --states > cycle.json"),
                     0);
    assert_int_equal(rollbem("check cycle.json"), 0);
    write_file("both.txt", "load bulk_stress_b\n200 50\n200 150\n400 80\n");
    assert_int_equal(rollbem(CONTACT "--history both.txt --from 0 --json --states > joint.json"),
                     0);
    assert_int_equal(rollbem("check joint.json"), 0);
}

TEST(what_is_refused)
{
    check_refused(ALONE "--crack-length 1mm --remote-stress 5,5", 64, "low,high of a cycle");
    check_refused(ALONE "--crack-length 1mm --remote-stress 5,1", 64, "low,high of a cycle");
    check_refused(ALONE "--crack-length 1mm --remote-stress 1,2,3", 64, "low,high of a cycle");
    check_refused(CONTACT "--load 100 --remote-stress 0,5", 64, "a cycle acts alone");
    check_refused(ALONE "--crack-length 1mm --remote-stress 0,5 --fluid trapped", 64,
                  "not under a cycle");
    check_refused(ALONE "--crack-length 1mm --remote-stress 5 --paris 1e-9,3", 64,
                  "--remote-stress low,high");
}

RUN_TESTS(enter_folder, leave_folder)
