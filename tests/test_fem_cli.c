/* rollbem example: recorded outputs, JSON, pictures, problem files, refusals.  Run from
 * the project's root; B: the build directory. */
#include "check.h"
#include "lcp/friction/friction.h"
#include "base/io/io.h"

#include <jansson.h>
#include <sys/wait.h>
#include <unistd.h>

#define held_json HELD(json_t)
HELD_TYPE(json_t, json_decref)

static char folder[] = "/tmp/rollbem-fem-XXXXXX";

static int make_folder(void **state)
{
    return mkdtemp(folder) ? 0 : -1;
}

static int run(const char *format, ...)
{
    char command[1000] = "", arguments[800];
    const char *build = getenv("B");
    va_list args;
    va_start(args, format);
    vsnprintf(arguments, sizeof arguments, format, args);
    va_end(args);
    snprintf(command, sizeof command, "%s/rollbem example %s", build ? build : "build", arguments);
    const int status = system(command);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static int drop_folder(void **state)
{
    char command[200];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command);
}

static const char *inside(const char *name)
{
    static char path[300];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

/* How the solver came there may differ from machine to machine. */
static int is_result(const char *name)
{
    return strcmp(name, "iterations") != 0 && strcmp(name, "residual") != 0 &&
           strcmp(name, "seconds") != 0;
}

static void matches(const char *recorded)
{
    OWNED(rb_io_table) got, want;
    CHECK_OK(rb_io_table_read(inside("out.tsv"), &got, &message));
    CHECK_OK(rb_io_table_read(recorded, &want, &message));
    assert_int_equal(got.rows, want.rows);
    assert_int_equal(got.columns, want.columns);
    for (int j = 0; j < want.columns; j++) {
        const double *x = want.x + j * want.rows, *y = got.x + j * want.rows;
        const double scale = rb_norm_inf((size_t)want.rows, x);
        assert_string_equal(got.name[j], want.name[j]);
        for (int i = 0; i < want.rows && is_result(want.name[j]); i++)
            CHECK_ABS(y[i], x[i], 1e-8 * scale, "%s: row %d, %s", recorded, i, want.name[j]);
    }
}

TEST(recorded_outputs_are_todays)
{
    static const char *const rows[][2] = {
        {"bar --solver lemke", "examples/bar/output.tsv"},
        {"truss", "examples/truss/upper-inside.tsv"},
        {"truss --layout upper-overhanging", "examples/truss/upper-overhanging.tsv"}};
    for (int k = 0; k < 3; k++) {
        if (!is_in_turn(k, 3))
            continue;
        assert_int_equal(run("%s --output %s", rows[k][0], inside("out.tsv")), 0);
        matches(rows[k][1]);
    }
}

/* Each column of the table is a member of the steps in JSON, but for their number. */
static void json_matches_the_table(const char *arguments, int code)
{
    OWNED(rb_io_table) table;
    char table_of[400], json_of[400];
    snprintf(table_of, sizeof table_of, "%s >%s/out.tsv 2>/dev/null", arguments, folder);
    snprintf(json_of, sizeof json_of, "%s --json >%s/out.json 2>/dev/null", arguments, folder);
    assert_int_equal(run("%s", table_of), code);
    assert_int_equal(run("%s", json_of), code);
    CHECK_OK(rb_io_table_read(inside("out.tsv"), &table, &message));
    held_json *root = json_load_file(inside("out.json"), 0, NULL);
    const json_t *steps = json_object_get(root, "steps");
    assert_int_equal(json_array_size(steps), table.rows);
    for (int j = 0; j < table.columns; j++)
        for (int i = 0; i < table.rows && strcmp(table.name[j], "step") != 0; i++) {
            const json_t *x = json_object_get(json_array_get(steps, (size_t)i), table.name[j]);
            assert_true(json_is_number(x));
            if (strcmp(table.name[j], "seconds") != 0)
                CHECK_ABS(json_number_value(x), table.x[i + j * table.rows], 0.0, "%s: step %d, %s",
                          arguments, i, table.name[j]);
        }
}

TEST(json_has_the_columns_of_the_table)
{
    json_matches_the_table("truss --nodes 3", 0);
    if (is_in_turn(0, 3))
        json_matches_the_table("bar --solver lemke", 0);
    if (is_in_turn(1, 3))
        json_matches_the_table("wall --mesh coarse --rigid --quiet", 1); /* step 12 fails */
}

TEST(json_and_picture_are_written)
{
    assert_int_equal(
        run("truss --nodes 4 --json --output %s --plot %s.png", inside("out.json"), folder), 0);
    held_json *root = json_load_file(inside("out.json"), 0, NULL);
    const json_t *steps = json_object_get(root, "steps");
    static const int stick[] = {0, 16, 4, 0, 0, 0};
    assert_string_equal(json_string_value(json_object_get(root, "schema")), "rollbem/1");
    assert_int_equal(json_array_size(steps), 6);
    for (size_t k = 0; k < 6; k++)
        assert_int_equal(json_integer_value(json_object_get(json_array_get(steps, k), "stick")),
                         stick[k]);
    char picture[300];
    snprintf(picture, sizeof picture, "%s.png", folder);
    FILE *file = NOT_NULL(fopen(picture, "rb"));
    char head[5] = "";
    assert_int_equal(fread(head, 1, 4, file), 4);
    fclose(file);
    remove(picture);
    assert_string_equal(head, "\x89PNG");
}

TEST(the_wall_writes_its_problems)
{
    if (!is_in_turn(0, 4))
        skip();
    assert_int_equal(run("wall --mesh coarse --problems 3 --quiet --output %s >%s/wall.tsv",
                         inside("wall"), folder),
                     0);
    rb_io_table table; /* as many numbers in a row as it has names */
    CHECK_OK(rb_io_table_read(inside("wall.tsv"), &table, NULL));
    assert_int_equal(table.rows, 76);
    for (int k = 0; k < table.rows; k++)
        CHECK_ABS(rb_io_table_column(&table, "stick")[k] + rb_io_table_column(&table, "slip")[k] +
                      rb_io_table_column(&table, "separated")[k],
                  161.0, 0.0, "contacts of step %d", k + 1);
    rb_io_table_free(&table);
    for (int k = 1; k <= 3; k++) {
        char name[40];
        OWNED(rb_friction_problem) problem;
        snprintf(name, sizeof name, "wall/wall-%02d.hdf5", k);
        CHECK_OK(rb_friction_read(inside(name), &problem, &message));
        assert_int_equal(problem.form, RB_FRICTION_GLOBAL);
        assert_int_equal(problem.contacts, 161);
        assert_int_equal(problem.dofs, 901);
    }
}

static void read_steps(rb_io_table *table, const char *arguments)
{
    rb_io_table_free(table);
    assert_int_equal(run("%s --quiet --output %s", arguments, inside("out.tsv")), 0);
    CHECK_OK(rb_io_table_read(inside("out.tsv"), table, &message));
}

/* Without friction the bar is in uniform plane strain; no gap is open in the beginning, so
 * that twice the load doubles displacements and reactions. */
TEST(friction_and_loads_may_be_others)
{
    const double E = 5.0, nu = 0.48, p = 0.03;
    OWNED(rb_io_table) table = {0}, other = {0};
    read_steps(&table, "bar --mu 0 --load 0.03");
    for (int k = 0; k < table.rows; k++) {
        const double s = -p * (k + 1), plane = (1.0 - nu * nu) / E;
        const double strain = plane * (s + nu / (1.0 - nu) * p);
        const double upward = plane * (-p - nu / (1.0 - nu) * s);
        CHECK_REL(rb_io_table_column(&table, "corner_ux_mm")[k], 400.0 * strain, 1e-9, "step %d",
                  k + 1);
        CHECK_REL(rb_io_table_column(&table, "corner_uy_mm")[k], 40.0 * upward, 1e-9, "step %d",
                  k + 1);
        CHECK_REL(rb_io_table_column(&table, "normal_sum_N")[k], 4000.0 * p, 1e-9, "step %d",
                  k + 1);
    }
    read_steps(&table, "truss --nodes 4 --mu 0.3 --load 70000");
    read_steps(&other, "truss --nodes 4 --mu 0.3 --load 140000");
    CHECK_REL(rb_io_table_column(&table, "normal_sum_N")[0], 5.0 * 4.0 * 70000.0, 1e-12, "sum");
    for (int k = 0; k < table.rows; k++) {
        const double *small = rb_io_table_column(&table, "max_increment_mm");
        CHECK_ABS(rb_io_table_column(&other, "max_increment_mm")[k], 2.0 * small[k],
                  1e-9 * small[0], "step %d", k + 1);
        CHECK_ABS(rb_io_table_column(&other, "slip")[k], rb_io_table_column(&table, "slip")[k], 0.0,
                  "step %d", k + 1);
    }
}

TEST(refusals_have_their_exit_codes)
{
    assert_int_equal(run("wall --mu 0.5 2>/dev/null"), 64);
    assert_int_equal(run("wall --load 1 2>/dev/null"), 64);
    assert_int_equal(run("bar --mu -1 2>/dev/null"), 64);
    assert_int_equal(run("truss --load 0 2>/dev/null"), 64);
    assert_int_equal(run("2>/dev/null"), 64);
    assert_int_equal(run("bra 2>/dev/null"), 64);
    assert_int_equal(run("bar truss 2>/dev/null"), 64);
    assert_int_equal(run("bar --solver nosuch 2>/dev/null"), 64);
    assert_int_equal(run("bar --plot picture.gif 2>/dev/null"), 64);
    assert_int_equal(run("truss --nodes 1 2>/dev/null"), 64);
    assert_int_equal(run("truss --layout other 2>/dev/null"), 64);
    assert_int_equal(run("wall --step 0 2>/dev/null"), 64);
    assert_int_equal(
        run("truss --nodes 2 --solver extragradient --output %s 2>/dev/null", inside("none.tsv")),
        1);
    assert_int_equal(access(inside("none.tsv"), F_OK), -1); /* no increment, no table */
    assert_int_equal(run("truss --nodes 4 --output /no/such/folder/x 2>/dev/null"), 73);
}

RUN_TESTS(make_folder, drop_folder)
