/* Results of cracks verified without the solver: every kind is valid, every law is
 * looked at, what cannot be checked is refused in one line.  That any number which is
 * changed is found: tests/test_check.c. */
#include "cli_run.h"
#include "program/certificate/certificate.h"
#include "program/report/report.h"

#define CONTACT                                                                                    \
    "crack --similar --support halfplane --half-width 1 --radius 1000 --crack-elements "           \
    "12 --contact-elements 20 "
#define DRIVEN "--mu 0.3 --formulation steady --creep-ratio -3 "
#define STATES " --json --states --quiet > r.json"

static void make(const char *arguments)
{
    char line[600];
    snprintf(line, sizeof line, "%s" STATES, arguments);
    if (rollbem(line) != 0)
        fail_msg("%s: %s", line, err);
}

TEST(results_are_valid)
{
    static const char *const cases[] = {
        CONTACT "--mu 0 --steps 60 --crack-friction 0",
        CONTACT "--mu 0.3 --shift 1e-4 --steps 60 --remote-stress 20 --crack-angle 130",
        CONTACT DRIVEN "--steps 60 --passes 3",
        CONTACT DRIVEN "--fluid trapped --passes 2",
        CONTACT DRIVEN "--fluid trapped --closing located --passes 2",
        CONTACT DRIVEN "--fluid pressure --steps 60",
        CONTACT DRIVEN "--plane stress --crack-depth 0.4 --crack-angle 20 --steps 60",
        CONTACT DRIVEN "--mu-fall 0.1 --slip-scale 100 --friction-law exponential "
                       "--speed 1000 --steps 60",
        CONTACT "--unloaded --remote-stress 3",
        CONTACT "--unloaded --remote-stress -3",
        CONTACT "--mu 0.3 --formulation transient --distance 8 --creep 5e-4 --steps 48 "
                "--fluid trapped --closing located",
        CONTACT "--mu 0.3 --increments 4 --shift 2e-4 --crack-mouth 0.9",
        CONTACT "--mu 0 --coupled --steps 60 --passes 2",
        CONTACT "--mu 0 --coupled --steps 60 --formulation steady --crack-depth 0.3",
        "crack --example rail --steps 40"};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        make(cases[k]);
        if (shell("\"$R\" check r.json") != 0 || !strstr(out, ": valid: "))
            fail_msg("%s: %s%s", cases[k], out, err);
    }
}

/* ---- Laws -------------------------------------------------------------------------- */

/* Sets a number of a list of the faces, or of the table (step -1), and says what the
 * program says. */
static void tampered(const char *part, const char *list, int step, size_t at, double to,
                     const char *says)
{
    held_json *root = json_load_file("r.json", 0, NULL);
    json_t *lists = json_object_get(json_object_get(root, part), list);
    json_array_set_new(step < 0 ? lists : json_array_get(lists, (size_t)step), at,
                       strcmp(list, "zone") == 0 ? json_integer((int)to) : json_real(to));
    assert_int_equal(json_dump_file(root, "t.json", JSON_REAL_PRECISION(17)), 0);
    assert_int_equal(shell("\"$R\" check t.json"), 1);
    if (!strstr(out, says))
        fail_msg("%s of step %d: expected '%s', got %s", list, step, says, out);
}

TEST(the_laws_of_the_faces_are_judged)
{
    make(CONTACT DRIVEN "--fluid trapped");
    held_json *root = json_load_file("r.json", 0, NULL);
    json_t *faces = json_object_get(root, "faces");
    json_t *zones = json_object_get(faces, "zone"), *p = json_object_get(faces, "p_MPa");
    int found[4] = {0}, step[4] = {0};
    size_t node[4] = {0};
    for (size_t k = 0; k < json_array_size(zones); k++)
        for (size_t i = 0; i < 12; i++) {
            const int zone = (int)json_integer_value(json_array_get(json_array_get(zones, k), i));
            if (!found[zone]) {
                found[zone] = 1;
                step[zone] = (int)k;
                node[zone] = i;
            }
        }
    for (int zone = 0; zone < 4; zone++) {
        assert_true(found[zone]);
        const double pressure =
            json_number_value(json_array_get(json_array_get(p, (size_t)step[zone]), node[zone]));
        tampered("faces", "zone", step[zone], node[zone], (zone + 1) % 4, "faces: zone of node");
        tampered("faces", "p_MPa", step[zone], node[zone],
                 zone == 0 ? 1.0 : pressure * (1.0 + 1e-4), "faces: node");
    }
    tampered("faces", "q_MPa", step[3], node[3], 100.0, "friction force");
    tampered("faces", "opening_mm", step[0], node[0], -1e-3, "faces.opening_mm");
    tampered("table", "fluid_pressure", -1, 0, 1.0, "fluid");
    tampered("faces", "length_mm", -1, 3, 1.0, "length_mm");
}

/* The contact that feels its crack: gaps by Betti's theorem, load, largest pressure. */
TEST(the_coupled_contact_is_judged)
{
    make(CONTACT "--mu 0 --coupled --steps 60");
    held_json *root = json_load_file("r.json", 0, NULL);
    const json_t *p =
        json_array_get(json_object_get(json_object_get(root, "faces"), "contact_p_MPa"), 30);
    size_t most = 0;
    for (size_t i = 0; i < json_array_size(p); i++)
        if (json_number_value(json_array_get(p, i)) > json_number_value(json_array_get(p, most)))
            most = i;
    const double pressure = json_number_value(json_array_get(p, most));
    tampered("faces", "contact_p_MPa", 30, most, pressure * (1.0 + 1e-4), "its load");
    tampered("faces", "contact_p_MPa", 30, most, pressure * (1.0 + 1e-4), "contact: element");
    tampered("faces", "contact_p_MPa", 30, most, -1.0, "contact: element");
    tampered("faces", "contact_p_MPa", 30, 0, 1.0, "reaches an end");
    tampered("table", "max_pressure", -1, 30, pressure * (1.0 + 1e-4), "max_pressure");
}

/* ---- Refusals ---------------------------------------------------------------------- */

TEST(what_cannot_be_checked_is_refused)
{
    static const char *const refused[][2] = {{"--mu 0 --paris 1e-12,3", "a crack that grows"},
                                             {"--mu 0 --error", "error bars"}};
    for (size_t k = 0; k < sizeof refused / sizeof *refused; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        char line[400];
        snprintf(line, sizeof line, CONTACT "%s --steps 60", refused[k][0]);
        make(line);
        check_refused("check r.json", 65, refused[k][1]);
    }
    assert_int_equal(rollbem(CONTACT "--mu 0 --steps 60 --json --quiet > r.json"), 0);
    check_refused("check r.json", 65, "take --states");
    assert_int_equal(rollbem(CONTACT "--mu 0 --steps 60 --units inch --json --quiet > r.json"), 0);
    check_refused("check r.json", 65, "take --states");
    check_refused(CONTACT "--mu 0 --states", 64, "--states: with --json");
    check_refused(CONTACT "--mu 0 --states --json --units inch", 64, "--states: with --json");
    assert_int_equal(rollbem(CONTACT "--mu 0 --steps 60 > r.tsv"), 0);
    check_refused("check r.tsv", 65, "a table of rollbem crack");
    make(CONTACT "--mu 0 --steps 60");
    assert_int_equal(shell("sed 's/\"contact_table\"/\"other\"/' r.json > o.json"), 0);
    check_refused("check o.json", 65, "contact_table has no elements");
    assert_int_equal(
        shell("sed 's/\"crack-angle\": 30.0/\"crack-angle\": \"up\"/' r.json > o.json"), 0);
    check_refused("check o.json", 65, "crack-angle");
    assert_int_equal(shell("sed 's/\"crack-angle\": 30.0/\"crack-angle\": 190.0/' r.json > o.json"),
                     0);
    check_refused("check o.json", 65, "crack-angle");
    assert_int_equal(shell("sed 's/\"fluid_volume_mm2\"/\"else\"/' r.json > o.json"), 0);
    assert_int_equal(shell("\"$R\" check o.json"), 1);
    assert_non_null(strstr(out, "violated: faces.fluid_volume_mm2 is missing"));
    assert_non_null(strstr(out, "violated: faces.else is no result of this case"));
    held_json *root = json_load_file("r.json", 0, NULL);
    json_object_del(root, "contact_table");
    assert_int_equal(json_dump_file(root, "o.json", JSON_REAL_PRECISION(17)), 0);
    check_refused("check o.json", 65, "contact_table has no elements");
    /* the command line is compared with the inputs */
    assert_int_equal(shell("sed 's/\\(\"command\": .*\\)--steps 60/\\1--steps 61/' r.json "
                           "> o.json; \"$R\" check o.json"),
                     1);
    assert_non_null(strstr(out, "command: it has other inputs"));
}

static rb_status certify(void *context)
{
    rb_certificate_outcome found = {.prove = 0};
    FILE *lines = tmpfile();
    held_case *words = rb_case_create(RB_CASE_CRACK);
    const rb_status s =
        words ? rb_certificate_check(lines, "r", context, words, &found, &(rb_message){.text = ""})
              : RB_ENOMEM;
    fclose(lines);
    return s;
}

TEST(no_memory)
{
    make(CONTACT "--mu 0 --unloaded --remote-stress 3");
    held_json *root = json_load_file("r.json", 0, NULL);
    assert_true(alloc_fail_each(certify, root) > 10);
}

RUN_TESTS(enter_folder, leave_folder)
