/* Creep curves and subsurface stress as the program's users meet them. */
#include "cli_run.h"
#include "base/io/io.h"

#include <sys/stat.h>

/* Carter's case: similar bodies. */
#define SIMILAR "--support halfplane --similar --half-width 0.5 --poisson 0.3 "

/* ---- Bad input --------------------------------------------------------------------- */

static const struct {
    const char *arguments;
    int code;
    const char *part;
} bad[] = {
    {"curve --from x", 64, "--from: expected a number, got 'x'"},
    {"curve --points 1", 64, "--points: expected a whole number in [2, 1e+06]"},
    {"curve --over slip", 64, "--over: expected creep-ratio, creep or speed, got 'slip'"},
    {"curve --from 1 --to 1", 64, "--to: expected two different values"},
    {"curve --from 1e308", 64, "--from: expected a size of 1e-100 to 1e+100"},
    {"curve --to -1e200", 64, "--to: expected a size of 1e-100 to 1e+100"},
    {"curve --creep 0.1", 64, "--creep: a curve varies it from --from to --to"},
    {"curve --force 0", 64, "--force: a curve varies it"},
    {"curve --formulation static", 64, "--formulation: a curve needs steady rolling"},
    {"curve --mu 0.1,,0.3", 64, "--mu: expected a number >= 0, got '0.1,,0.3'"},
    {"curve --mu 0.1,x", 64, "--mu: expected a number >= 0, got '0.1,x'"},
    {"curve --mu 0", 64, "xi R/(mu a) has no meaning at mu = 0"},
    {"curve --support halfplane --load 9 --points 2 --mu 0.3,0 --quiet", 64,
     "mu = 0: curve: xi R/(mu a) has no meaning"},
    {"--mu 0.1,0.2", 64, "--mu: expected one number; a curve takes several"},
    {"curve --accuracy 1e-3", 64, "--accuracy: only for single cases"},
    {"curve --mu 0 --over creep --to 1e-3 --plot c.png", 64, "--plot: no curve to draw at mu = 0"},
    {"curve --mu 0.3,0 --over creep --to 1e-3 --plot c.png", 64,
     "--plot: no curve to draw at mu = 0"},
    {"stress --accuracy 0.1", 64, "--accuracy: stress has error bars"},
    {"--dimensionless --json", 64, "--dimensionless: of the table and the picture; JSON has units"},
    {"--formulation transient --distance 1 --dimensionless --history-table t", 64,
     "--dimensionless: of the tractions of the case, not together with --history-table"},
    {"--dimensionless --derivatives", 64, "not together with --derivatives"},
    {"curve --dimensionless", 64, "(it is an option of rollbem, rollbem stress)"},
    {"--approach 1e-9 --zone 5 --dimensionless", 65,
     "--dimensionless: nothing touches, so there is neither a nor p0"},
    {"curve --plot a.bmp", 64, "--plot: expected a name ending in .png, .svg, .pdf, .eps or .tex"},
    {"--fretting --formulation static", 64, "--fretting: needs --history, a table whose rows end"},
    {"--fretting --formulation steady --creep 0.001", 64, "--fretting: what rolls has no cycle"},
    {"--fretting-plot f.svg --increments 2 --formulation static", 64,
     "--fretting-plot: needs --fretting"},
    {"stress --fretting", 64, "--fretting: only of a single case with --history"},
    {"curve --fretting", 64, "--fretting: only of a single case with --history"},
    {"stress --grid 10", 64, "--grid: expected two numbers >= 2 such as 61x41, 1e8"},
    {"stress --grid 10x", 64, "got '10x'"},
    {"stress --grid 10x1", 64, "got '10x1'"},
    {"stress --grid 10x5y", 64, "got '10x5y'"},
    {"stress --grid 9x9 --points p", 64, "--points: not together with --grid"},
    {"stress --whole --support halfplane", 64, "--whole: body A is a half-plane, which has no end"},
    {"stress --whole --body b --young-b 1e4 --support-b halfplane", 64,
     "--whole: body B is a half-plane, which has no end; the whole of a wheel needs --support-b "
     "arc"},
    {"stress --whole --depth 3", 64, "--whole: not together with --depth"},
    {"stress --whole --points p", 64, "--whole: not together with --points"},
    {"stress --whole --vtk a.vti", 64, "--vtk: .vti holds regular grids"},
    {"stress --depth 0", 64, "--depth: expected a number > 0 or auto"},
    {"stress --vtk a.vts", 64, "--vtk: expected a name ending in .vti or .vtu"},
    {"stress --vtk a.vti", 64, "--vtk: .vti holds regular grids, that of a wheel"},
    {"stress --fringes a.bmp", 64, "--fringes: expected a name ending in .png"},
    {"--formulation transient --distance 1 --creep 0 --history-plot a.bmp", 64,
     "--history-plot: expected a name ending in .png"},
    {"stress --points nowhere", 66, "nowhere: No such file"},
    {"--plot a.svg --plot-size 86mm", 64, "--plot-size: expected own, 85mm, 170mm"},
    {"curve --plot-size 85mm", 64, "--plot-size: there is no picture"},
    {"--plot-script a.gp", 64, "--plot-script: expected one picture"},
    {"stress --plot a.svg --fringes b.svg --plot-script a.gp", 64, "got 2"},
    {"--plot a.gif", 64,
     "--plot: a .gif shows a history step by step (--history-plot FILE.gif); for this picture take "
     "a "
     "name ending in .png, .svg, .pdf, .eps or .tex"},
    {"stress --fringes a.gif", 64, "--fringes: a .gif shows a history step by step"},
    {"--history-plot a.gif", 64, "--history-plot: for --formulation transient, --history"},
    {"--plot a.tex --plot-script a.gp", 64,
     "--plot-script: gnuplot alone does not write the texts of a .tex picture"},
    {"--plot a.svg --plot-script a.svg", 64, "both would write 'a.svg'"},
};

TEST(bad_arguments_are_refused)
{
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++)
        if (is_in_turn((int)k, 8))
            check_refused(bad[k].arguments, bad[k].code, bad[k].part);
}

TEST(bad_points_are_named_by_their_line)
{
    static const char *const texts[][2] = {
        {"0 1\n0 1 2\n", "points:2: expected 2 numbers, got 3"},
        {"0\n", "points:1: expected 2 numbers, got 1"},
        {"0 1\nsome text\n", "points:2: expected a number, got 'some'"},
        {"# x y\n0 1\n\n0 -1\n", "points:4: the point (0, -1) mm lies outside body A"}};
    for (size_t k = 0; k < sizeof texts / sizeof texts[0]; k++) {
        write_file("points", texts[k][0]);
        check_refused("stress " SIMILAR "--points points", 65, texts[k][1]);
    }
    write_file("points", "0 50\n");
    check_refused("stress --support hub --points points", 65, "points:1: the point");
}

/* ---- Curves ------------------------------------------------------------------------ */

/* Carter (1926): Q/(mu P) = -s (2 - s). */
TEST(curve_follows_carter)
{
    held_json *root = run_json("curve " SIMILAR "--from -1.2 --to 1.2 --points 25 "
                               "--contact-elements 50");
    const json_t *curve = json_object_get(root, "curve");
    assert_int_equal(json_array_size(json_object_get(curve, "creepage")), 25);
    for (size_t i = 0; i < 25; i++) {
        const double s = -1.2 + 0.1 * (double)i, t = fmin(fabs(s), 1.0);
        CHECK_ABS(entry(curve, "creep_ratio", i), s, 1e-9, "ratio");
        CHECK_ABS(entry(curve, "force_ratio", i), -copysign(t * (2.0 - t), s), 1e-3, "s = %g", s);
        CHECK_MAX(entry(curve, "residual", i), 1e-10, "s = %g", s);
    }
    CHECK_ABS(number_in(curve, "free_creepage"), 0.0, 1e-12, "free rolling");
}

TEST(table_holds_the_numbers_of_json)
{
    static const char *const columns[][2] = {{"creepage", "creepage"},
                                             {"creep_ratio", "creep_ratio"},
                                             {"force_ratio", "force_ratio"},
                                             {"stick_ratio", "stick_ratio"}};
    const char *line = "curve " SIMILAR "--points 7 --mu 0.1,0.3 --contact-elements 20 "
                       "--over creep --to 0.01";
    OWNED(rb_io_table) t;
    held_json *root = run_json(line);
    const json_t *curves = json_object_get(root, "curves");
    assert_int_equal(rollbemf("%s --quiet --output curve.tsv", line), 0);
    assert_int_equal(rb_io_table_read("curve.tsv", &t, NULL), RB_OK);
    assert_int_equal(t.rows, 14);
    assert_int_equal(json_array_size(curves), 2);
    assert_true(json_equal(json_array_get(curves, 0), json_object_get(root, "curve")));
    for (size_t i = 0; i < 14; i++)
        CHECK_ABS(rb_io_table_column(&t, "mu")[i], i < 7 ? 0.1 : 0.3, 0.0, "mu");
    for (size_t j = 0; j < 4; j++)
        for (size_t i = 0; i < 14; i++)
            CHECK_ABS(rb_io_table_column(&t, columns[j][0])[i],
                      entry(json_array_get(curves, i / 7), columns[j][1], i % 7), 0.0, "%s",
                      columns[j][0]);
}

/* 100 points at 100 elements; a second leaves room for a busy machine. */
TEST(curve_is_fast)
{
    held_json *root = run_json("curve " SIMILAR "--points 100 --contact-elements 100");
    const json_t *curve = json_object_get(root, "curve");
    print_message("curve of 100 points at 100 elements: %g s\n", number_in(curve, "seconds"));
    assert_int_equal(json_array_size(json_object_get(curve, "creepage")), 100);
}

/* ---- Stress ------------------------------------------------------------------------ */

static void check_maximum(const json_t *root, const char *name, double value, double x, double y)
{
    const json_t *m = json_object_get(json_object_get(root, "maxima"), name);
    const double p0 = number_in(json_object_get(root, "summary"), "max_pressure");
    CHECK_REL(number_in(m, "value") / p0, value, 3e-3, "%s / p0", name);
    CHECK_ABS(fabs(number_in(m, "x")) / 0.5, fabs(x), 0.01, "x / a of %s", name);
    CHECK_ABS(number_in(m, "y") / 0.5, y, 0.01, "y / a of %s", name);
}

/* Closed forms for nu = 0.3 (theory-solvers.md 6). */
TEST(maxima_are_those_of_hertz_and_full_sliding)
{
    json_t *root = run_json("stress " SIMILAR "--shift 0 --mesh fitted --grid 3x3");
    check_maximum(root, "max_shear", 0.30028, 0.0, 0.78615);
    check_maximum(root, "von_mises", 0.55752, 0.0, 0.70429);
    check_maximum(root, "orthogonal_shear", 0.25, 0.866, 0.5);
    json_decref(root);
    root = run_json("stress " SIMILAR "--mu 0.2 --formulation steady --creep-ratio 2 --grid 3x3");
    check_maximum(root, "max_shear", 0.31899, -0.625, 0.601);
    const json_t *tension = json_object_get(json_object_get(root, "maxima"), "tension");
    CHECK_REL(number_in(tension, "value"),
              0.4 * number_in(json_object_get(root, "summary"), "max_pressure"), 0.03, "2 mu p0");
    CHECK_ABS(number_in(tension, "x"), 0.5, 0.01, "at the pulled edge");
    assert_true(number_in(json_object_get(json_object_get(root, "maxima"), "max_shear"), "x") <
                0.0); /* braked: friction on A towards -x */
    json_decref(root);
}

/* The first row of the grid lies on the surface: its tractions are those of the table. */
TEST(surface_row_shows_the_tractions)
{
    held_json *root = run_json("stress " SIMILAR "--formulation steady --creep-ratio 0.5 "
                               "--grid 41x2 --contact-elements 200");
    const json_t *grid = json_object_get(root, "grid"), *summary = json_object_get(root, "summary");
    const double p0 = number_in(summary, "max_pressure"), a = 0.5;
    assert_int_equal(number_in(grid, "nx"), 41);
    for (size_t i = 0; i < 41; i++) {
        const double x = entry(grid, "x_mm", i) / a;
        const double p = fabs(x) < 1.0 ? p0 * sqrt(1.0 - x * x) : 0.0;
        /* linear between midpoints: half of the first one's pressure at an edge */
        const double bound = fabs(fabs(x) - 1.0) < 0.005 ? 0.05 : 0.02;
        CHECK_ABS(-entry(grid, "syy_MPa", i), p, bound * p0, "x = %g a", x);
        CHECK_ABS(entry(grid, "y_mm", i), 0.0, 0.0, "surface");
    }
}

TEST(table_of_points)
{
    OWNED(rb_io_table) t;
    write_file("points", "# x y\n0 0.39308\n0.1, 0\n");
    assert_int_equal(rollbem("stress " SIMILAR "--shift 0 --mesh fitted --points points"), 0);
    assert_non_null(strstr(out, "# in-plane shear "));
    assert_non_null(strstr(err, "von Mises"));
    assert_int_equal(rb_io_table_read("out", &t, NULL), RB_OK);
    assert_int_equal(t.rows, 2);
    CHECK_ABS(rb_io_table_column(&t, "x_mm")[1], 0.1, 0.0, "x");
    const double sxx = rb_io_table_column(&t, "sxx_MPa")[0];
    const double syy = rb_io_table_column(&t, "syy_MPa")[0];
    CHECK_REL(rb_io_table_column(&t, "max_shear_MPa")[0], (sxx - syy) / 2, 1e-6, "tau");
    CHECK_REL(rb_io_table_column(&t, "szz_MPa")[0], 0.3 * (sxx + syy), 1e-12, "szz");
}

/* ---- ParaView files ---------------------------------------------------------------- */

static int digit(char c)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *at = strchr(digits, c);
    return c && at ? (int)(at - digits) : -1;
}

/* Decodes base64 up to the first other character; the bytes. */
static size_t decode(const char *text, unsigned char *bytes, size_t size)
{
    size_t n = 0;
    for (; digit(text[0]) >= 0; text += 4) {
        const int d[4] = {digit(text[0]), digit(text[1]), digit(text[2]), digit(text[3])};
        assert_true(n + 3 <= size);
        bytes[n++] = (unsigned char)(d[0] << 2 | d[1] >> 4);
        if (d[2] >= 0)
            bytes[n++] = (unsigned char)(d[1] << 4 | d[2] >> 2);
        if (d[3] >= 0)
            bytes[n++] = (unsigned char)(d[2] << 6 | d[3]);
        if (d[3] < 0)
            break;
    }
    return n;
}

/* The array of that name: first its size in bytes, then itself (VTK file formats, "XML
 * file formats": inline, base64, header and data encoded apart). */
static size_t read_array(const char *name, double *x, size_t size)
{
    char mark[60];
    unsigned char head[12];
    uint64_t bytes;
    snprintf(mark, sizeof mark, "Name=\"%s\"", name);
    const char *at = NOT_NULL(strstr(out, mark));
    at = strchr(at, '>') + 1;
    decode(at, head, sizeof head);
    memcpy(&bytes, head, sizeof bytes);
    assert_true(bytes <= size);
    at = strchr(at, '=') + 1; /* 8 bytes end with one = */
    assert_int_equal(decode(at, (unsigned char *)x, size), bytes);
    return bytes;
}

/* Corners of the cells of out, which follow each other around the cell: points that there
 * are, as many cells as have all of them inside. */
static void check_cells(int points, const json_t *grid, int nx, int ny)
{
    static double room[8000];
    const int *corner = (const int *)room;
    const int cells = (int)(read_array("connectivity", room, sizeof room) / (4 * sizeof *corner));
    int whole = 0, number[1000], n = 0;
    for (int k = 0; k < nx * ny; k++)
        number[k] = isnan(entry(grid, "sxx_MPa", (size_t)k)) ? -1 : n++;
    assert_int_equal(n, points);
    for (int k = 0; k + nx < nx * ny; k++) {
        const int around[] = {number[k], number[k + 1], number[k + nx + 1], number[k + nx]};
        if (k % nx == nx - 1 || around[0] < 0 || around[1] < 0 || around[2] < 0 || around[3] < 0)
            continue;
        assert_true(whole < cells);
        assert_memory_equal(corner + 4 * whole++, around, sizeof around);
    }
    assert_int_equal(whole, cells);
}

/* A wheel's grid follows its surface; places in the hub are left out. */
TEST(grid_of_a_wheel)
{
    const char *wheel = "stress --support hub --approach 5 --outer-elements 60 "
                        "--contact-elements 30 --grid 21x31 --depth 90";
    char line[300];
    OWNED(rb_io_table) t;
    held_json *root = run_json(wheel);
    const json_t *grid = json_object_get(root, "grid");
    int inside = 0;
    for (size_t k = 0; k < 21 * 31; k++) {
        const double x = entry(grid, "x_mm", k), y = entry(grid, "y_mm", k);
        const double r = hypot(x, y - 50.0);
        const int there = !isnan(entry(grid, "sxx_MPa", k));
        inside += there;
        if (k < 21) /* the surface itself */
            assert_true(there);
        if (r < 0.98 * 15.0 || r > 50.0 + 1e-9)
            assert_false(there);
        if (r > 1.02 * 15.0 && r < 0.98 * 50.0)
            assert_true(there);
    }
    assert_true(inside < 21 * 31);
    assert_int_equal(rollbemf("%s --quiet --output wheel.tsv --vtk wheel.vtu", wheel), 0);
    assert_int_equal(rb_io_table_read("wheel.tsv", &t, NULL), RB_OK);
    assert_int_equal(t.rows, inside);
    slurp("wheel.vtu", out, sizeof out);
    snprintf(line, sizeof line, "NumberOfPoints=\"%d\"", inside);
    assert_non_null(strstr(out, line));
    check_cells(inside, grid, 21, 31);
}

TEST(vtk_holds_the_numbers_of_the_table)
{
    enum { NX = 7, NY = 5, N = NX * NY };
    double x[6 * N + 3];
    OWNED(rb_io_table) t;
    assert_int_equal(rollbem("stress " SIMILAR "--contact-elements 20 --grid 7x5 "
                             "--quiet --output s.tsv --vtk s.vti"),
                     0);
    assert_int_equal(rb_io_table_read("s.tsv", &t, NULL), RB_OK);
    slurp("s.vti", out, sizeof out);
    assert_non_null(strstr(out, "<VTKFile type=\"ImageData\" version=\"1.0\""));
    assert_non_null(strstr(out, "WholeExtent=\"0 6 0 4 0 0\""));
    assert_int_equal(read_array("von_mises", x, sizeof x), N * sizeof(double));
    for (int k = 0; k < N; k++)
        CHECK_ABS(x[k], rb_io_table_column(&t, "von_mises_MPa")[k], 0.0, "von Mises");
    assert_int_equal(read_array("stress", x, sizeof x), 6 * N * sizeof(double));
    for (int k = 0; k < N; k++) {
        CHECK_ABS(x[6 * k + 1], rb_io_table_column(&t, "syy_MPa")[k], 0.0, "syy");
        CHECK_ABS(x[6 * k + 3], rb_io_table_column(&t, "sxy_MPa")[k], 0.0, "sxy");
    }
    assert_int_equal(rollbem("stress " SIMILAR "--contact-elements 20 --grid 7x5 "
                             "--quiet --vtk s.vtu"),
                     0);
    slurp("s.vtu", out, sizeof out);
    assert_non_null(strstr(out, "NumberOfPoints=\"35\" NumberOfCells=\"24\""));
    assert_int_equal(read_array("Points", x, sizeof x), 3 * N * sizeof(double));
    for (int k = 0; k < N; k++)
        CHECK_ABS(x[3 * k + 1], rb_io_table_column(&t, "y_mm")[k], 0.0, "y");
    assert_int_equal(rollbem("stress " SIMILAR "--contact-elements 20 --quiet "
                             "--vtk /nonexistent/s.vtu"),
                     73);
}

static double last_of(const char *path, const char *column)
{
    OWNED(rb_io_table) t;
    assert_int_equal(rb_io_table_read(path, &t, NULL), RB_OK);
    const double *x = NOT_NULL(rb_io_table_column(&t, column));
    return x[t.rows - 1];
}

/* Carter at s = 0.4, the end of a curve and of a long way. */
TEST(curves_and_steps_have_error_bars)
{
    assert_int_equal(rollbem("curve " SIMILAR "--to 0.4 --points 3 --error --plot c.svg "
                             "--output c.tsv"),
                     0);
    assert_non_null(strstr(err, "error of Q/(mu P) <= "));
    CHECK_ABS(last_of("c.tsv", "force_ratio"), -0.64, last_of("c.tsv", "error_force_ratio"),
              "curve");
    assert_int_equal(rollbem(SIMILAR "--formulation transient --creep-ratio 0.4 "
                                     "--contact-elements 20 --distance 60 --error "
                                     "--history-table h.tsv --quiet > last.tsv"),
                     0);
    CHECK_ABS(last_of("h.tsv", "force_ratio"), -0.64, last_of("h.tsv", "error_force_ratio"),
              "history");
}

/* ---- Steps ------------------------------------------------------------------------- */

#define ROLLING SIMILAR "--formulation transient --creep-ratio 0.5 --contact-elements 20 "

TEST(steps_leave_snapshots_and_a_picture)
{
    OWNED(rb_io_table) first, last;
    assert_int_equal(rollbem(ROLLING "--distance 0.5 --quiet --output last.tsv "
                                     "--snapshots snap --every 2 --history-plot h.svg "
                                     "--history-table h.tsv --progress"),
                     0);
    assert_non_null(strstr(err, ", 0 s left\n")); /* after the last one */
    assert_int_equal(rb_io_table_read("snap/step_000002.tsv", &first, NULL), RB_OK);
    assert_int_equal(shell("cmp \"$(ls snap/*.tsv | tail -1)\" last.tsv"), 0);
    assert_int_equal(rb_io_table_read("h.tsv", &last, NULL), RB_OK);
    const int n = last.rows;
    CHECK_REL(rb_io_table_column(&last, "distance_a")[n - 1], 0.5, 0.15, "distance");
    slurp("h.svg", out, sizeof out);
    assert_non_null(strstr(out, "Transient rolling"));
    write_file("plain", "");
    check_refused(ROLLING "--distance 0.2 --quiet --snapshots plain", 73,
                  "plain: cannot write: Not a directory");
    check_refused(SIMILAR "--every 2", 64, "--every: for --formulation transient");
}

TEST(bad_rows_are_named_by_their_line)
{
    static const char *const histories[][2] = {
        {"distance load creep\n0 50 0\n\n2 50 1e-3\n1 50 1e-3\n",
         "h.txt:5: distance 1 is less than in the row before"},
        {"# all\ndistance load creep\n0 50 0\n2 -50 0\n", "h.txt:4: load"},
        {"distance load approach\n0 50 1\n", "h.txt:2: approach, load"},
        {"distance load creep\n0 50\n",
         "h.txt:2: expected 3 numbers (distance, load, creep), got 2"},
        {"load creep\n50 0\n", "h.txt: history: transient rolling needs a column"}};
    for (size_t k = 0; k < sizeof histories / sizeof histories[0]; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        write_file("h.txt", histories[k][0]);
        check_refused("--support halfplane --similar --formulation transient --history h.txt", 65,
                      histories[k][1]);
    }
    write_file("gap.txt", "0 0\n1 1\n\n1 2\n");
    check_refused("--load 10 --gap gap.txt", 65, "gap.txt:4: expected an x larger");
    write_file("gap.txt", "0 0\n");
    check_refused("--load 10 --gap gap.txt", 65, "needs 3 points or more, got 1");
    write_file("gap.txt", "# x gap\n-1 -.5\n0 0\n1 -.5\n");
    check_refused("--load 10 --gap gap.txt", 65, "gap.txt:4: the smallest gap, -0.5");
    check_refused("--load 10 --gap-smoothing 1e-3", 64,
                  "--gap-smoothing: it needs a gap from a file");
    check_refused("--load 10 --gap gap.txt --gap-smoothing -1", 64, "--gap-smoothing");
}

/* ---- Slip -------------------------------------------------------------------------- */

/* The friction power along the contact adds up to the dissipation, which is -xi Q. */
TEST(friction_power_adds_up)
{
    held_json *root =
        run_json(SIMILAR "--formulation steady --creep-ratio 0.5 --contact-elements 100");
    const json_t *table = json_object_get(root, "table"),
                 *summary = json_object_get(root, "summary");
    double power = 0.0;
    for (size_t i = 0; i < json_array_size(json_object_get(table, "h_mm")); i++) {
        assert_true(entry(table, "friction_power_MPa", i) >= -1e-12);
        power += entry(table, "friction_power_MPa", i) * entry(table, "h_mm", i);
    }
    CHECK_REL(power, number_in(summary, "dissipation"), 1e-12, "sum");
    CHECK_REL(power, -number_in(summary, "creepage") * number_in(summary, "tangential_load"), 1e-3,
              "balance");
}

/* Friction so steep that no solution is found in the middle, from 0.23 to 0.46 on 100 elements:
 * points well within keep their places, with creepage and kappa, and the curve goes on. */
TEST(curves_go_on_behind_points_without_a_solution)
{
#define STEEP                                                                                      \
    "curve --similar --support halfplane --gap parabola --young 210000 --poisson 0.28 "            \
    "--radius 460 --load 1000 --mu 0.02 --friction-law linear --mu-fall 0.3 --slip-scale 8 "       \
    "--speed 20000 --points 5 --contact-elements 100 --mesh uniform --to 0.56 "
    assert_int_equal(rollbem(STEEP "--json"), 1);
    held_json *root = NOT_NULL(json_loads(out, 0, NULL));
    const json_t *curve = json_object_get(root, "curve");
    assert_non_null(strstr(err, ": 10 points in"));
    assert_non_null(strstr(err, "4 without a solution"));
    assert_non_null(strstr(err, "rollbem: the point at xi R/(mu a) = 0.28 has no solution: "));
    for (size_t i = 0; i < 10; i++) {
        const int middle = i == 2 || i == 3 || i == 6 || i == 7;
        CHECK_ABS(entry(curve, "creep_ratio", i), 0.14 * (double)(i < 5 ? i : 9 - i), 1e-9, "s");
        CHECK_REL(entry(curve, "kappa", i), 0.96950, 1e-4, "kappa");
        assert_int_equal(isnan(entry(curve, "force_ratio", i)), middle);
        assert_int_equal(isnan(entry(curve, "normal_load", i)), middle);
    }
    CHECK_REL(entry(curve, "force_ratio", 4), -0.0627359, 1e-5, "beyond");
    /* and a second curve */
    CHECK_RUN(rollbem(STEEP "--mu 0.02,0.3"), 1, err, "curve, mu(0) = 0.6: 10 points in");
    assert_non_null(strstr(out, "\n0.6\t"));
#undef STEEP
}

static double slope(const json_t *root, const char *of, const char *by, size_t row)
{
    const json_t *all = json_object_get(json_object_get(root, "history"), "derivatives");
    const json_t *value = json_array_get(json_object_get(json_object_get(all, of), by), row);
    return json_is_number(value) ? json_number_value(value) : NAN;
}

/* A row in which everything slides under its force has no derivatives, and those behind it have
 * none; the rows before it have theirs.  Of a given part of mu P all but the motion has. */
TEST(rows_before_full_sliding_have_derivatives)
{
#define STEPS                                                                                      \
    "--support halfplane --similar --load 500 --mu 0.3 --contact-elements 20 --history rows.txt "  \
    "--json --derivatives "
    char line[500];
    write_file("rows.txt", "force\n50\n149\n");
    held_json *before = run_json(STEPS "shift:mu,approach:load");
    write_file("rows.txt", "force\n50\n149\n150\n100\n");
    held_json *all = run_json(STEPS "shift:mu,approach:load");
    for (size_t row = 0; row < 2; row++) {
        CHECK_REL(slope(all, "shift", "mu", row), slope(before, "shift", "mu", row), 1e-9, "mu");
        CHECK_REL(slope(all, "approach", "load", row), slope(before, "approach", "load", row), 1e-9,
                  "load");
        assert_true(isnan(slope(all, "shift", "mu", row + 2)));
        assert_true(isnan(slope(all, "approach", "load", row + 2)));
    }
    const char *note =
        json_string_value(json_object_get(json_object_get(all, "history"), "derivatives_note"));
    assert_non_null(strstr(note, "2 of 4 rows have no derivatives: from row 3 on: the whole "
                                 "contact slides under the given force"));
    write_file("rows.txt", "force\n150\n100\n");
    snprintf(line, sizeof line, "%s", STEPS "shift:mu");
    CHECK_RUN(rollbem(line), 1, err,
              "row 1 of the history: the whole contact slides under the given force");
    held_json *part = run_json(
        "--support halfplane --similar --load 500 --mu 0.3 --contact-elements 20 --formulation "
        "transient --force-ratio -1 --distance 0.5 --json "
        "--derivatives tangential_load:mu,creepage:mu");
    for (size_t row = 0; row < 3; row++) {
        CHECK_REL(slope(part, "tangential_load", "mu", row), -500.0, 1e-9, "-P");
        assert_true(isnan(slope(part, "creepage", "mu", row)));
    }
#undef STEPS
}

/* What sticks again after full sliding under a given shift: against solutions for other mu. */
TEST(rows_that_stick_again_have_derivatives)
{
    enum { ROWS = 4 };
    static const char line[] =
        "--similar --support halfplane --young 210000 --poisson 0.3 --radius 100 --gap parabola "
        "--history back.txt --json --derivatives tangential_load:mu --mu %s";
    static const char *const mu[] = {"0.3", "0.2998", "0.3002"};
    double got[ROWS], Q[2][ROWS];
    write_file("back.txt", "load shift\n100 0.001\n100 0.01\n100 0.009\n100 0.005\n");
    for (size_t k = 0; k < 3; k++) {
        held_json *root = run_jsonf(line, mu[k]);
        const json_t *history = json_object_get(root, "history");
        for (size_t row = 0; row < ROWS; row++)
            if (k == 0)
                got[row] = slope(root, "tangential_load", "mu", row);
            else
                Q[k - 1][row] = json_number_value(
                    json_array_get(json_object_get(history, "tangential_load"), row));
        const json_t *stick = json_object_get(history, "stick");
        assert_int_equal(json_integer_value(json_array_get(stick, 1)), 0);
        assert_true(json_integer_value(json_array_get(stick, 2)) > 0);
    }
    for (size_t row = 0; row < ROWS; row++)
        CHECK_REL(got[row], (Q[1][row] - Q[0][row]) / 4e-4, 1e-4, "row %zu", row + 1);
}

/* The balance of power (V4) from the JSON alone: for every support, both bodies, every way to
 * drive.  Of a wheel that turns the lever arms' part is also int (p u_T - q u_N) dx / R, by the
 * printed displacements of A on a rigid plane. */
TEST(powers_balance)
{
    static const struct {
        const char *options;
        double bound; /* of the balance, as a part of its terms: the slip operator's error */
        int turns;    /* 1: A alone deforms and turns */
    } all[] = {
        {"--support halfplane --creep-ratio 0.5", 2e-3, 0},
        {"--support halfplane --layer-thickness 0.5 --creep-ratio 0.5", 2e-3, 0},
        {"--similar --support halfplane --radius-b 30 --force-ratio -0.3", 2e-3, 0},
        {"--support hub --creep-ratio 0.5", 2e-3, 1},
        {"--support hub --creep-ratio 0.5 --mesh aligned", 2e-3, 1},
        {"--support hub --force-ratio 0.4 --hub-ratio 0.6", 2e-3, 1},
        {"--support hub --free-axle", 2e-3, 0},
        {"--support hub --creep 0.1", 2e-3, 1},
        {"--support hub --half-width 5 --creep-ratio -0.5 --mu 1", 2e-3, 1},
        {"--support hub --gap exact --creep-ratio 0.5", 2e-3, 1},
        {"--support hub --normals surface --creep-ratio 0.5", 2e-3, 0},
        {"--support hub --cover-thickness 3 --young 100 --half-width 2 --creep-ratio 0.5", 2e-3, 1},
        {"--support arc --creep-ratio 0.5", 2e-3, 0},
        {"--support arc --arc 60 --young 1000 --half-width 5 --creep-ratio 0.5", 2e-3, 0},
        {"--support hub --young-b 70000 --radius-b 30 --creep-ratio 0.5", 2e-3, 0},
        {"--support hub --similar --radius-b 80 --support-b hub --creep-ratio 0.5", 2e-3, 0},
        {"--support halfplane --young-b 70000 --radius-b 30 --support-b arc --creep-ratio 0.5",
         2e-3, 0},
        {"--support hub --young 2100 --relaxation-time 0.01 --relaxation-ratio 1 --speed 100 "
         "--creep-ratio 0.5",
         2e-3, 0},
        {"--support hub --young 2100 --relaxation-time 0.01 --relaxation-ratio 1 --speed 100 "
         "--free-axle",
         2e-3, 0},
        {"--support hub --interlayer-tangential 1e-6 --creep-ratio 0.5", 2e-3, 0},
    };

    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        char line[500];
        if (!is_in_turn((int)k, 8))
            continue;
        snprintf(line, sizeof line,
                 "--young 210000 --poisson 0.3 --radius 50 --half-width 1 --mu 0.3 --gap parabola "
                 "--formulation steady --contact-elements 100 %s",
                 all[k].options);
        held_json *root = run_json(line);
        const json_t *s = json_object_get(root, "summary"), *t = json_object_get(root, "table"),
                     *inputs = json_object_get(root, "inputs");
        const double R_A = number_in(inputs, "radius"), R_B = number_in(inputs, "radius-b");
        const double R = isfinite(R_B) ? 1.0 / (1.0 / R_A + 1.0 / R_B) : R_A;
        const double creepage = -number_in(s, "creepage") * number_in(s, "tangential_load"),
                     load = number_in(s, "resistance_moment") / R, L = number_in(s, "lever_power"),
                     D = number_in(s, "dissipation"), H = number_in(s, "hysteresis");
        double levers = 0.0;
        /* where nothing is driven a little of what full sliding would supply */
        const double slides = 0.3 * number_in(s, "normal_load") * number_in(s, "half_width") / R;
        CHECK_ABS(creepage + load + L, D + H,
                  all[k].bound * (fabs(creepage) + fabs(load) + fabs(L) + 0.05 * slides), "%s",
                  all[k].options);
        for (size_t i = 0; i < json_array_size(json_object_get(t, "h_mm")); i++)
            levers += (entry(t, "p_MPa", i) * entry(t, "ut_mm", i) -
                       entry(t, "q_MPa", i) * entry(t, "un_mm", i)) *
                      entry(t, "h_mm", i) / R_A;
        if (all[k].turns)
            CHECK_ABS(levers, L, 0.01 * fabs(L) + 1e-3 * D, "lever arms: %s", all[k].options);
    }
}

/* Where hardly anything is dissipated, the mean of the tractions on both sides of a slip
 * can be of the wrong sign: the balance holds, and the error bar too. */
TEST(power_below_zero_is_named)
{
    static const char *const unlike =
        "--support halfplane --layer-thickness 2 --young-b 2e5 --interlayer-normal 2e-6 "
        "--interlayer-tangential 1e-6 --half-width 1 --contact-elements 24 ";
    char line[500];
    assert_int_equal(rollbemf("curve %s --mesh uniform --from -0.25 --to 0.25 --points 3", unlike),
                     0);
    assert_non_null(strstr(err, "below zero at 1 point, -0.00032 N/mm at xi = 0:"));
    for (int aligned = 0; aligned < 2; aligned++) {
        snprintf(line, sizeof line, "%s --formulation steady --creep 0 --error --mesh %s", unlike,
                 aligned ? "aligned" : "uniform");
        held_json *root = run_json(line);
        const json_t *summary = json_object_get(root, "summary");
        const double bar = number_in(json_object_get(summary, "errors"), "dissipation");
        CHECK_ABS(number_in(summary, "dissipation"), 2.1e-4, bar, "aligned %d", aligned);
        assert_int_equal(number_in(summary, "dissipation") < 0.0, !aligned);
    }
}

/* A load held for 2 s in one step, while the stress relaxes within 0.25 s: by Lee and
 * Radok, pressure 1/(2R) int E*(t - s) d sqrt(a(s)^2 - x^2), p0 = 2.66927 MPa. */
TEST(steps_too_long_for_relaxation_are_named)
{
    static const struct {
        const char *step, *says;
        double bound;
    } cases[] = {{"", "relaxes within 0.25 s of such a step: --time-step 0.05", 0.06},
                 {"--time-step 0.05", NULL, 5e-4},
                 {"--time-step 0.1", NULL, 2e-3}};
    char line[500];
    write_file("held.txt", "time load\n0 20\n2 20\n");
    for (int k = 0; k < 3; k++) {
        snprintf(line, sizeof line,
                 "--formulation static --support halfplane --radius 40 --young 100 --poisson 0.4 "
                 "--young-b 300 --poisson-b 0.2 --mu 0 --gap parabola --contact-elements 61 "
                 "--relaxation-time 0.5,5 --relaxation-ratio 1,0.7 --history held.txt --json %s",
                 cases[k].step);
        assert_int_equal(rollbem(line), 0);
        assert_int_equal(strstr(err, "the stress relaxes") != NULL, cases[k].says != NULL);
        assert_true(!cases[k].says || strstr(err, cases[k].says));
        held_json *root = json_loads(out, 0, NULL);
        CHECK_REL(number_in(json_object_get(root, "summary"), "max_pressure"), 2.66927,
                  cases[k].bound, "p0, %s", cases[k].step);
    }
}

/* On standard error, in the table and in JSON, as those of a single case. */
TEST(curves_have_notes)
{
    static const char note[] = "note: The strains are far beyond";
    held_json *root = run_json("curve --support hub --contact-elements 12 --points 3");
    json_t *notes = json_object_get(root, "notes");
    assert_true(json_array_size(notes) >= 1);
    assert_int_equal(strncmp(json_string_value(json_array_get(notes, 0)), note + 6, 26), 0);
    CHECK_RUN(rollbem("curve --support hub --contact-elements 12 --points 3"), 0, err, note);
    assert_non_null(strstr(out, note));
}

TEST(full_sliding_says_that_creepage_is_open)
{
    assert_int_equal(rollbem(SIMILAR "--formulation steady --force-ratio -1"), 0);
    assert_non_null(strstr(err, "the creepage is not unique"));
    assert_int_equal(rollbem(SIMILAR "--formulation steady --force-ratio -0.9"), 0);
    assert_null(strstr(err, "not unique"));
}

TEST(fitted_is_the_default_for_steady)
{
    static const struct {
        const char *arguments, *mesh;
        int elements;
    } cases[] = {{SIMILAR "--formulation steady", "fitted", 100},
                 {SIMILAR "--formulation steady --mesh uniform", "uniform", 60},
                 {SIMILAR "--formulation steady --zone 0.7", "uniform", 60},
                 {SIMILAR, "uniform", 60},
                 {"--formulation steady --creep 0.1", "uniform", 60}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        held_json *root = run_json(cases[k].arguments);
        const json_t *inputs = json_object_get(root, "inputs");
        assert_string_equal(json_string_value(json_object_get(inputs, "mesh")), cases[k].mesh);
        assert_int_equal(number_in(inputs, "contact-elements"), cases[k].elements);
    }
}

/* ---- Pictures ---------------------------------------------------------------------- */

TEST(pictures_are_drawn)
{
    IN_TURN(0, 4);
    struct stat st;
    assert_int_equal(rollbem("curve " SIMILAR "--points 9 --contact-elements 20 --mu "
                             "0.1,0.3 --quiet --plot curve.svg"),
                     0);
    slurp("curve.svg", out, sizeof out);
    assert_non_null(strstr(out, "Carter"));
    assert_int_equal(rollbem("stress " SIMILAR "--contact-elements 20 --quiet "
                             "--plot stress.png --fringes fringes.png"),
                     0);
    assert_int_equal(stat("stress.png", &st), 0);
    assert_true(st.st_size > 20000);
    assert_int_equal(stat("fringes.png", &st), 0);
    assert_true(st.st_size > 20000);
}

/* The titles of the y axes of sized.svg, which run upwards: their letters, three quarters
 * of the size above the line they stand on, must begin on the canvas. */
static void check_titles_of_axes(const char *line)
{
    static char drawing[1 << 20];
    double from, size;
    slurp("sized.svg", drawing, sizeof drawing);
    for (char *at = drawing; (at = strstr(at, "<g transform=\"translate(")) != NULL; at++) {
        const char *end = strchr(at, '>'), *turned = strstr(at, "rotate(270)");
        const char *letters = strstr(at, "font-size=\"");
        if (!turned || turned > end || !letters || letters > end)
            continue;
        assert_int_equal(sscanf(at, "<g transform=\"translate(%lf", &from), 1);
        assert_int_equal(sscanf(letters, "font-size=\"%lf", &size), 1);
        if (from < 0.75 * size)
            print_error("%s: the title of an axis is cut\n", line);
        assert_true(from >= 0.75 * size);
    }
}

/* Each command in the sizes of pages: width and height as asked for, at 96 pixels an
 * inch. A slide, whose size is the same for all and the widest, is asked of each third.
 * What the script draws is the picture, which is seen in one size of each. A third of the commands
 * per run. */
TEST(pictures_in_sizes)
{
    static const struct {
        const char *line, *option;
        int height, column; /* at 170mm, at 85mm */
    } pictures[] = {
        {"--approach 0.5 --contact-elements 20", "plot", 481, 321},
        {"--approach 0.5 --contact-elements 20 --increments 2", "history-plot", 481, 321},
        {"curve " SIMILAR "--points 9 --contact-elements 20", "plot", 481, 321},
        {"stress " SIMILAR "--contact-elements 20 --grid 15x9", "plot", 267, 391},
        {"stress --support halfplane --half-width 0.05 --contact-elements 20 --grid 15x9",
         "fringes", 481, 321},
        {"stress " SIMILAR "--contact-elements 8 --grid 5x3 --shakedown", "shakedown-map", 481,
         321},
        {"wear " SIMILAR "--gap parabola --slide 1e5 --wear-coefficient 1e-10 "
         "--wear-steps 2 --contact-elements 20",
         "plot", 481, 321},
        {"sweep --restart " SIMILAR "--contact-elements 20 --vary-1 'mu .1 .2' "
         "--vary-2 'radius 9 20'",
         "plot", 481, 321},
        {"sweep --restart " SIMILAR "--contact-elements 20 --vary-1 'mu .1 .2' "
         "--vary-2 'radius 9 20' --show max_pressure",
         "map", 481, 321},
        {"example truss --nodes 4", "plot", 361, 535},
        {"example bar", "plot", 361, 321}};
    for (size_t k = 0; k < sizeof pictures / sizeof *pictures; k++) {
        if (!is_in_turn((int)k, 8))
            continue;
        const struct {
            const char *name;
            int width, height;
        } sizes[] = {{"170mm", 642, pictures[k].height},
                     {"slide", 1280, 720},
                     {"85mm", 321, pictures[k].column}};
        for (int i = 0; i < 3; i++) {
            if (i == 1 && k % 3 != 1 && !getenv("ROLLBEM_TEST_ALL"))
                continue;
            char line[400], want[60];
            snprintf(line, sizeof line,
                     "%s --quiet --output out.tsv --%s sized.svg --plot-size %s "
                     "--plot-script sized.gp",
                     pictures[k].line, pictures[k].option, sizes[i].name);
            assert_int_equal(rollbem(line), 0);
            slurp("sized.svg", out, sizeof out);
            snprintf(want, sizeof want, "width=\"%d\" height=\"%d\"", sizes[i].width,
                     sizes[i].height);
            if (!strstr(out, want))
                fail_msg("%s: not %s", line, want);
            check_titles_of_axes(line);
            if (i == (int)k % 3)
                assert_int_equal(shell("gnuplot -d sized.gp | cmp - sized.svg"), 0);
        }
    }
    assert_int_equal(shell("PATH=/nonexistent \"$R\" --approach 0.5 --contact-elements 20 "
                           "--quiet --plot none.svg --plot-script alone.gp"),
                     70);
    slurp("alone.gp", out, sizeof out);
    assert_non_null(strstr(out, "$drawn << EOD"));
}

/* Every picture in every kind of file, in turn; as TeX it holds no cells of fields and no markup of
 * gnuplot. */
TEST(pictures_in_every_kind)
{
    static const char *const pictures[] = {
        "--approach 0.5 --contact-elements 20 --plot a",
        "--approach 0.5 --contact-elements 20 --increments 2 --history-plot a",
        "--history cycle.txt --fretting --support halfplane --similar --mu 0.5 --contact-elements "
        "20 "
        "--fretting-plot a",
        "curve " SIMILAR "--points 5 --contact-elements 20 --plot a",
        "stress " SIMILAR "--contact-elements 8 --grid 5x3 --plot a",
        "stress " SIMILAR "--contact-elements 8 --grid 5x3 --fringes a",
        "stress " SIMILAR "--contact-elements 8 --grid 5x3 --shakedown --shakedown-map a",
        "stress --whole --approach 0.5 --contact-elements 8 --outer-elements 24 --grid 5x3 --plot "
        "a",
        "stress --whole --approach 0.5 --contact-elements 8 --outer-elements 24 --grid 5x3 "
        "--dimensionless --fringes a",
        "wear " SIMILAR "--gap parabola --slide 1e5 --wear-coefficient 1e-10 --wear-steps 2 "
        "--contact-elements 20 --plot a",
        "sweep --restart " SIMILAR
        "--contact-elements 20 --vary-1 'mu .1 .2' --vary-2 'radius 9 20' "
        "--plot a",
        "sweep --restart " SIMILAR
        "--contact-elements 20 --vary-1 'mu .1 .2' --vary-2 'radius 9 20' "
        "--show max_pressure --map a",
        "example truss --nodes 2 --plot a",
        "example bar --plot a"};
    static const struct {
        const char *ending, *begin;
    } kinds[] = {{"tex", "% Needs \\usepackage{gnuplot-lua-tikz}"},
                 {"png", "\x89PNG"},
                 {"svg", "<?xml"},
                 {"pdf", "%PDF-"},
                 {"eps", "%!PS-Adobe-"}};
    enum { KINDS = sizeof kinds / sizeof *kinds };
    write_file("cycle.txt", "load force_ratio\n100 0\n100 0.6\n100 -0.6\n100 0.6\n");
    for (size_t k = 0; k < sizeof pictures / sizeof *pictures; k++)
        for (int i = 0; i < KINDS; i++) {
            char line[500], name[20];
            if (!is_in_turn((int)k, 7) || (i > 0 && !is_in_turn((int)k / 7 + i, KINDS - 1)))
                continue;
            snprintf(line, sizeof line, "%s.%s --output out.tsv", pictures[k], kinds[i].ending);
            snprintf(name, sizeof name, "a.%s", kinds[i].ending);
            assert_int_equal(rollbem(line), 0);
            slurp(name, out, sizeof out);
            if (strncmp(out, kinds[i].begin, strlen(kinds[i].begin)) != 0)
                fail_msg("%s: begins with %.20s", line, out);
            if (i == 0 &&
                shell("grep '{/[:*]\\|[^ -~]' a.tex || test $(stat -c %s a.tex) -gt 150000") == 0)
                fail_msg("%s: %s", line, out);
            unlink(name);
        }
}

/* Where nothing rubs, the picture of the tractions names pressure alone. */
TEST(a_picture_without_friction_names_none)
{
    static const char *const mu[] = {"0", "0.3"};
    for (int k = 0; k < 2; k++) {
        if (!is_in_turn(k, 2))
            continue;
        char line[200];
        rb_format(line, sizeof line,
                  SIMILAR "--contact-elements 20 --mu %s --plot a.svg --output out.tsv --quiet",
                  mu[k]);
        assert_int_equal(rollbem(line), 0);
        assert_int_equal(shell("grep -q 'pressure p<' a.svg"), 0);
        assert_int_equal(shell("grep -q 'friction q<' a.svg"), !k);
        assert_int_equal(shell("grep -q 'traction ' a.svg"), !k);
        assert_int_equal(shell("grep -q 'μp<' a.svg"), !k);
    }
}

/* A frame for each step, of many steps at most sixty. */
TEST(a_history_moves)
{
    static const struct {
        const char *line;
        int frames;
    } histories[] = {
        {"--approach 0.5 --contact-elements 20 --increments 3", 6},
        {"--support halfplane --similar --load 1e5 --contact-elements 40 --formulation transient "
         "--creep-ratio 0.5 --distance 4 --units si",
         60},
        {"--history load.txt --support halfplane --relaxation-time 1 --relaxation-ratio 2 --mu 0 "
         "--contact-elements 20",
         4}};
    write_file("load.txt", "time load\n0 100\n1 100\n2 100\n4 50\n");
    for (size_t k = 0; k < sizeof histories / sizeof *histories; k++) {
        char line[400];
        if (!is_in_turn((int)k, 3))
            continue;
        snprintf(
            line, sizeof line,
            "%s --history-plot a.gif --history-table h.tsv --plot-script a.gp --output out.tsv",
            histories[k].line);
        assert_int_equal(rollbem(line), 0);
        assert_int_equal(shell("gnuplot -d a.gp 2>said | cmp - a.gif && cat said"), 0);
        if (atoi(strpbrk(out, "0123456789")) != histories[k].frames)
            fail_msg("%s: %s", line, out);
    }
}

/* What a reader needs who has the picture alone. */
TEST(pictures_name_the_case)
{
    static const struct {
        const char *line, *option, *text;
    } pictures[] = {
        {"--approach 0.5", "plot", "A: arc, R = 50 mm, E = 94.5 GPa, ν = 0.1;  B rigid"},
        {"--approach 0.5e-3 --units si", "plot", "A: arc, R = 0.05 m, E = 94.5 GPa"},
        {"--support hub --young-b 2e5 --poisson-b 0.3 --support-b halfplane --approach 0.5", "plot",
         "A: hub, R = 50 mm, E = 94.5 GPa, ν = 0.1;  B: half-plane, E = 200 GPa, ν = 0.3"},
        {"--support hub --cover-thickness 5 --relaxation-time 1e-3 --relaxation-ratio 1 "
         "--speed 1000 --load 100 --formulation steady --creep 1e-4",
         "plot",
         "A: hub, R = 50 mm, cover 5 mm, E = 94.5 GPa, ν = 0.1, relaxes on a rigid core;  B rigid"},
        {"--support halfplane --layer-thickness 2 --layer-base smooth --load 100 --force 0", "plot",
         "layer 2 mm, E = 94.5 GPa, ν = 0.1, sliding on a rigid base;  B rigid"},
        {"curve " SIMILAR "--points 5", "plot", "A: half-plane, R = 50 mm, E"},
        {"curve " SIMILAR "--points 5 --mu 0.1,0.3", "plot", "mu = '0.1 0.3'"},
        {"stress " SIMILAR "--grid 15x9", "plot", "A: half-plane, R = 50 mm, E"},
        {"stress " SIMILAR "--grid 15x9", "plot", "with labels boxed"},
        {"stress " SIMILAR "--grid 15x9", "fringes", "A: half-plane, R = 50 mm, E"},
        {SIMILAR "--increments 2 --force-ratio 0.5", "history-plot", "A: half-plane, R"},
        {SIMILAR "--increments 2 --force-ratio 0.5 --error", "history-plot",
         "band_title = 'estimated error, at most "},
        /* all of it slides: 0.02 P; the key names the force, as the creepage is given */
        {SIMILAR "--formulation transient --distance 1 --creep 0.05 --tolerance mu=0.02",
         "history-plot", "band_title = 'standard deviation, at most 4.1 N/mm'"},
        {SIMILAR "--formulation transient --distance 1 --creep 0.01 --error", "history-plot",
         "band2 = 2"}};
    for (size_t k = 0; k < sizeof pictures / sizeof *pictures; k++) {
        char line[400];
        if (!is_in_turn((int)k, 8))
            continue;
        snprintf(line, sizeof line,
                 "%s --contact-elements 20 --quiet --output out.tsv --%s named.svg "
                 "--plot-script named.gp",
                 pictures[k].line, pictures[k].option);
        assert_int_equal(rollbem(line), 0);
        if (shellf("grep -F \"%s\" named.gp", pictures[k].text) != 0)
            fail_msg("--%s: no %s", pictures[k].option, pictures[k].text);
    }
}

/* The temperature below a wheel is that below a half-plane, and says so. */
TEST(temperature_below_a_wheel_says_what_it_is)
{
    static const char *const support[] = {"halfplane", "hub"};
    for (int k = 0; k < 2; k++) {
        if (!is_in_turn(k, 2))
            continue;
        if (shellf("\"$R\" stress --support %s --load 500 --mu 0.3 --formulation steady --creep "
                   "-0.02 --speed 1000 --conductivity 50 --heat-capacity 3.6 --contact-elements 20 "
                   "--grid 3x3 > warm.tsv",
                   support[k]))
            fail_msg("%s: %s", support[k], err);
        assert_int_equal(strstr(err, "temperature: of a half-plane") != NULL, k);
        assert_int_equal(shell("grep -q '^# temperature: of a half-plane' warm.tsv") == 0, k);
    }
}

/* Of both bodies, or of A on a rigid plane, whose cycle closes the second time. */
TEST(fretting_has_a_picture)
{
    static const char *const of_b[] = {"--similar", ""}, *const band[] = {"band2 = 3", "band2 = 0"};
    for (int k = 0; k < 2; k++) {
        if (!is_in_turn(k, 2))
            continue;
        if (shellf(
                "printf 'force_ratio\\n0\\n0.6\\n-0.6\\n0.6\\n-0.6\\n0.6\\n' > frets.txt; \"$R\" "
                "--support halfplane %s --load 100 --formulation static --history frets.txt "
                "--fretting --contact-elements 20 --quiet --output out.tsv --fretting-plot "
                "frets.svg --plot-script frets.gp && grep -F 'Ruiz 2  [MPa' frets.gp && grep -F "
                "'%s' frets.gp",
                of_b[k], band[k]))
            fail_msg("%s: %s", of_b[k], err);
        assert_int_equal(shell("tail -c 20 frets.svg | grep -q svg"), 0);
    }
}

/* A lecturer's own commands read the table by the names of its columns, whatever the picture. */
TEST(own_templates_draw_the_table)
{
    static const struct {
        const char *line, *option, *x, *y;
    } pictures[] = {
        {SIMILAR, "plot", "x_mm", "p_MPa"},
        {SIMILAR "--units inch", "plot", "x_in", "p_psi"},
        {"curve " SIMILAR "--points 5 --mu 0.1,0.3", "plot", "creepage", "Q_N/mm"},
        {SIMILAR "--increments 2 --force-ratio 0.5", "history-plot", "shift_mm", "force_ratio"},
        {"wear " SIMILAR "--wear-coefficient 1e-10 --slide 1e6 --wear-steps 2", "plot", "way",
         "max_depth_mm"}};
    char text[200];
    for (size_t k = 0; k < sizeof pictures / sizeof *pictures; k++) {
        if (!is_in_turn((int)k, 5))
            continue;
        snprintf(text, sizeof text,
                 "set title title\nplot $table using '%s':'%s' with lines title 'mine'\n",
                 pictures[k].x, pictures[k].y);
        write_file("own.gp", text);
        assert_int_equal(shellf("\"$R\" %s --contact-elements 12 --quiet --output out.tsv --%s "
                                "own.svg --plot-template own.gp --plot-script whole.gp && gnuplot "
                                "-d whole.gp | cmp - own.svg && grep -q mine own.svg",
                                pictures[k].line, pictures[k].option),
                         0);
    }
    write_file("own.gp", "plot foo(\n");
    assert_int_equal(rollbem(SIMILAR "--quiet --plot own.svg --plot-template own.gp"), 65);
    assert_non_null(strstr(err, "own.gp: gnuplot failed: "));
    assert_int_equal(rollbem(SIMILAR "--quiet --plot own.svg --plot-template none.gp"), 66);
    assert_int_equal(rollbem(SIMILAR "--quiet --plot-template own.gp"), 64);
    assert_non_null(strstr(err, "--plot-template: expected one picture"));
}

/* Where an option of a body varies, no one body is that of the whole picture. */
TEST(pictures_of_varied_bodies_name_none)
{
    for (int k = 0; k < 2; k++) {
        if (!is_in_turn(k, 2))
            continue;
        char line[300];
        snprintf(line, sizeof line,
                 "sweep --restart " SIMILAR "--contact-elements 20 --vary-1 '%s' --show "
                 "max_pressure --quiet --output o.tsv --plot v.svg --plot-script v.gp",
                 k ? "radius 9 20" : "mu .1 .2");
        assert_int_equal(rollbem(line), 0);
        assert_int_equal(shell("grep -F 'A: half-plane' v.gp"), k);
    }
}

/* Free rolling slips nowhere: what rounding leaves is no curve over an axis of 10^-18. */
TEST(rounding_is_not_drawn_as_slip)
{
    assert_int_equal(rollbem("--example rail --quiet --output out.tsv --plot free.svg "
                             "--plot-script free.gp"),
                     0);
    assert_int_equal(shell("grep -F \"slip\" free.gp"), 0);
    assert_null(strstr(out, "10^{"));
}

/* The number behind this text of a script. */
static double number_behind(const char *script, const char *text)
{
    slurp(script, out, sizeof out);
    return strtod(NOT_NULL(strstr(out, text)) + strlen(text), NULL);
}

/* Over equal ratios, curves of several mu end at different creepages; those of the
 * picture do not, and the table has the ratios that were asked for. */
TEST(curves_of_a_picture_share_their_range)
{
    assert_int_equal(rollbem("curve " SIMILAR "--mu 0.1,0.4 --points 7 --quiet "
                             "--contact-elements 20 --plot c.svg --plot-script c.gp "
                             "--header bare --output c.tsv"),
                     0);
    double end[2];
    slurp("c.gp", out, sizeof out);
    assert_int_equal(
        sscanf(NOT_NULL(strstr(out, "x_last = '")), "x_last = '%lf %lf'", &end[0], &end[1]), 2);
    CHECK_REL(end[0], end[1], 1e-8, "ends");
    assert_int_equal(shell("awk '$3 > 1.499999 && $3 < 1.500001' c.tsv | wc -l"), 0);
    assert_int_equal(atoi(out), 2);
}

/* Of a map of mu and load, Q/(mu P) = -s (2 - s) with s = creep R/(mu a): each level has a
 * number, inside the map, on its line as far as cases that are so far apart tell. */
TEST(numbers_of_contour_lines_keep_off_the_border)
{
    static char text[60000];
    double x, y, level, lowest = 0.0, last = 0.0;
    assert_int_equal(
        rollbem("sweep --restart --support halfplane --similar --formulation steady --load 500 "
                "--contact-elements "
                "20 --vary-1 'mu .1 .2 .3' --vary-2 'creep 1e-4 5e-4 1e-3' --show "
                "force_ratio --quiet --output o.tsv --map v.svg --plot-script v.gp"),
        0);
    slurp("v.gp", text, sizeof text);
    const char *at = NOT_NULL(strstr(text, "level_first = "));
    assert_int_equal(sscanf(at, "level_first = %lf", &lowest), 1);
    at = NOT_NULL(strstr(text, "$numbers << EOD\nx y level\n")) + strlen("$numbers << EOD\n");
    int levels = 0;
    while (at = strchr(at, '\n') + 1, sscanf(at, "%lf %lf %lf", &x, &y, &level) == 3) {
        assert_true(x > 0.13 && x < 0.97 && y > 0.105 && y < 0.295);
        const double s = fmin(x * 1e-3 / y * 50.0 / 0.8210669, 1.0);
        CHECK_ABS(level, -s * (2.0 - s), 0.1, "a line at creep = %g, mu = %g", 1e-3 * x, y);
        assert_true(levels == 0 || level >= last);
        levels += levels == 0 || level > last;
        last = level;
    }
    assert_true(lowest <= -0.8 && levels >= 7);
}

/* A pressure far beyond the limit stays below the upper edge of the map, by a tenth. */
TEST(the_shakedown_map_shows_its_case)
{
    const double yield_shear = 40.0;
    held_json *root = run_json("stress --example rail --force-ratio -0.6 --shakedown "
                               "--yield-shear 40 --shakedown-map m.svg --plot-script m.gp");
    const double own = number_in(json_object_get(root, "summary"), "max_pressure") / yield_shear;
    assert_true(own > 10.0);
    CHECK_REL(number_behind("m.gp", "limit_to = "), 1.1 * own, 1e-5, "p0 = %g k", own);
}

/* Over large mu the bound mu p is cut off at the largest pressure, which keeps the room. */
TEST(a_large_bound_leaves_room_to_the_pressure)
{
    held_json *one = run_json(SIMILAR "--mu 1 --plot 1.svg --plot-script 1.gp"),
              *three = run_json(SIMILAR "--mu 3 --plot 3.svg --plot-script 3.gp");
    (void)one, (void)three;
    CHECK_REL(number_behind("1.gp", "p_to = "), number_behind("3.gp", "p_to = "), 1e-6,
              "upper end");
}

/* The value of the largest stress stands in the title of its panel, where it covers no
 * label of a contour. */
TEST(the_largest_stress_covers_no_contour)
{
    IN_TURN(1, 4);
    held_json *root = run_json("stress " SIMILAR "--contact-elements 20 --plot s.svg "
                               "--plot-script s.gp");
    const json_t *maxima = json_object_get(root, "maxima");
    char title[80];
    snprintf(title, sizeof title, "largest_text1 = '%.4g'",
             number_in(json_object_get(maxima, "max_shear"), "value"));
    slurp("s.gp", out, sizeof out);
    assert_non_null(strstr(out, title));
}

/* The grid of a whole wheel in the units and signs of its body, checked anew; its pictures reach
 * around it, with levels below the peaks at the contact and at the support. */
TEST(a_whole_wheel_is_shown)
{
    static const char *const bodies[] = {"", "--body b "};
    static const char line[] = "stress --whole --similar --radius-b 30 --support-b hub --load 1e5 "
                               "--mu 0.3 --force-ratio 0.5 --contact-elements 16 --outer-elements "
                               "40 --grid 17x5 --quiet ";
    char text[600];
    for (int of_b = 0; of_b < 2; of_b++) {
        if (!is_in_turn(of_b, 2))
            continue;
        rb_format(text, sizeof text, "\"$R\" %s--json %s>w.json && \"$R\" check w.json", line,
                  bodies[of_b]);
        assert_int_equal(shell(text), 0);
        held_json *root = NOT_NULL(json_load_file("w.json", 0, NULL));
        const json_t *y = json_object_get(json_object_get(root, "grid"), "y_mm");
        assert_true(json_is_true(json_object_get(root, "whole")));
        CHECK_REL(json_number_value(json_array_get(y, of_b ? 4 * 17 : 0)), of_b ? -60.0 : 100.0,
                  1e-12, "the far end of the wheel");
    }
    /* the script, without a gnuplot that would draw it */
    rb_format(
        text, sizeof text,
        "PATH=/nonexistent \"$R\" %s--body b --fringes f.svg --plot-script f.gp --output o.tsv "
        "--dimensionless",
        line);
    assert_int_equal(shell(text), 70);
    assert_int_equal(shell("awk '/^y_from/ { f = $3 } /^y_to/ { t = $3 } /^x_to/ { x = $3 } "
                           "END { exit !(t == 0 && f / x > 1.99 && f / x < 2.01) }' f.gp"),
                     0);
    assert_int_equal(shell("awk '/^fringe =/ { n = $3 } /^last_fringe =/ { l = $3 } "
                           "END { exit !(l > 5 * n && l < 25 * n) }' f.gp"),
                     0);
    /* what is narrower than a cell has no fringes: light and dark are averaged */
    assert_int_equal(
        shell("awk -F '\t' '/\tcontrast/ { on = 1; next } /^EOD/ { on = 0 } "
              "on && NF == 5 && $5 != \"NaN\" { n++; faint += $5 < 0.5; bad += $5 < 0 || $5 > 1 } "
              "END { print n, faint, bad; exit !(n > 50000 && faint > 0.005 * n && faint < 0.3 * n "
              "&& bad == 0) }' f.gp"),
        0);
}

/* Stress is not divided by mu, and its table says of which contact a and p0 are. */
TEST(dimensionless_stress_names_its_contact)
{
    double half_width, p0, mu;
    char end;
    assert_int_equal(rollbem("stress " SIMILAR
                             "--mu 0.35 --contact-elements 20 --grid 3x2 --dimensionless --quiet"),
                     0);
    assert_int_equal(sscanf(NOT_NULL(strstr(out, "# a = ")),
                            "# a = %lf mm, p0 = %lf MPa, mu = %lf%c", &half_width, &p0, &mu, &end),
                     4);
    assert_int_equal(end, '\n');
    assert_true(half_width > 0.0 && p0 > 0.0);
    CHECK_REL(mu, 0.35, 1e-15, "mu");
}

TEST(a_truss_is_drawn_with_its_bars)
{
    assert_int_equal(rollbem("example truss --nodes 4 --output t.tsv --plot t.svg "
                             "--plot-script t.gp"),
                     0);
    assert_int_equal(
        shell("awk '/^.bars/ { b = 1; next } /^EOD/ { b = 0 } b && /[0-9]/' t.gp | wc -l"), 0);
    /* a quarter of 4 x 4 nodes below and 3 x 3 above: 4 bars of the lower grid, 4 of the
     * upper one, whose nodes stand on the axes too, and 9 between the layers */
    assert_int_equal(atoi(out), 2 * (4 + 4 + 9));
    /* six increments and their sum, and the picture from the side */
    assert_int_equal(
        shell("awk '/^.table/ { t = 1; next } /^EOD/ { t = 0 } t && /^[0-9]/ { print $1 "
              "}' t.gp | sort -u | wc -l"),
        0);
    assert_int_equal(atoi(out), 7);
    assert_int_equal(shell("grep -c 'm = [1-6]<\\|from the side<' t.svg"), 0);
    assert_int_equal(atoi(out), 8);
    /* its factor, 2e+06, is a number that gnuplot does not read by itself */
    assert_int_equal(rollbem("example truss --nodes 2 --output t.tsv --plot t.svg"), 0);
}

/* Friction that is rounding beside the pressure: every number is one. */
TEST(almost_no_friction)
{
    static const char *const lines[] = {
        "--support halfplane --half-width 1 --mu 1e-12 --formulation steady --creep-ratio 0.5",
        "--support halfplane --half-width 1 --mu 1e-12 --force-ratio 0.5",
        "--support hub --half-width 1 --mu 1e-14 --shift 1e-3"};
    for (size_t k = 0; k < sizeof lines / sizeof lines[0]; k++) {
        held_json *root = run_json(lines[k]);
        const json_t *summary = json_object_get(root, "summary");
        CHECK_MAX(number_in(summary, "residual"), 1e-9, "%s", lines[k]);
        assert_true(isfinite(number_in(summary, "force_ratio")));
        assert_true(isfinite(number_in(summary, "max_pressure")));
    }
}

#define RAIL                                                                                       \
    "--support halfplane --similar --radius 460 --young 209920 --poisson 0.28 --gap "              \
    "exact --load 3111.08 --mu 0.18 --formulation steady --contact-elements 60 "
#define FALLS "--friction-law exponential --mu-fall 0.12 --slip-scale 10 --speed 45000 "

/* What a force of 0 leaves of the creepage of similar bodies is rounding. */
TEST(rounding_is_no_creepage)
{
    CHECK_RUN(rollbem("--example rail --force 0"), 0, err,
              "  creepage  xi = 0, xi R/(mu a) = 0, free rolling at 0\n");
}

/* A list of solutions says from where to where a contact sticks, and nothing where it does not. */
TEST(solutions_that_slide_have_no_stick_zone)
{
    CHECK_RUN(rollbem(RAIL FALLS "--creep 0.02 --all-solutions"), 0, err, " 0 stick, ");
    assert_non_null(strstr(err, " slip, residual "));
    assert_null(strstr(err, "nan"));
}

/* What is wrong with a friction law, in one line each. */
TEST(bad_friction_laws_are_refused)
{
    write_file("back.txt", "0 0.3\n0 0.2\n");
    write_file("less.txt", "0 0.3\n1 -0.2\n");
    write_file("mu.txt", "-1 0.3\n1 0.2\n");
    check_refused(RAIL "--mu-fall 0.1", 64, "--mu-fall: only for velocity-dependent friction");
    check_refused(RAIL "--friction-law linear", 64, "needs --mu-fall and --slip-scale");
    check_refused(RAIL FALLS "--slip-scale 1,2", 64, "as many numbers");
    check_refused(RAIL FALLS "--mu-fall -0.2", 64, "expected mu >= 0 everywhere");
    check_refused(RAIL "--friction-law linear --mu-fall 0.1 --slip-scale 9", 64, "add --speed");
    check_refused(RAIL "--memory 1", 64, "--memory: only for friction that changes");
    check_refused(RAIL "--mu-heat 0.1,20", 64, "--mu-heat: expected 3 numbers, got 2");
    check_refused(RAIL "--mu-heat 0.1,20,300", 64, "add --conductivity");
    check_refused(RAIL FALLS "--slip-scale 5mm/s,6", 64, "a unit for each number");
    check_refused("--friction-law none.txt", 66, "none.txt");
    check_refused("--friction-law back.txt", 65, "back.txt:2: expected x to increase");
    check_refused("--friction-law less.txt", 65, "less.txt:2: expected mu >= 0");
    check_refused("--friction-law mu.txt --mu 0.3", 64, "--mu: the table");
    write_file("way.txt", "shift mu\n0.001 0.3\n0.002 -0.1\n");
    check_refused("--formulation static --history way.txt --mu 0.3", 64,
                  "--mu: the history has a column mu");
    check_refused("--formulation static --history way.txt", 65,
                  "way.txt:3: mu: expected a number >= 0, got -0.1");
    check_refused("--formulation static --history way.txt --friction-law mu.txt", 65,
                  "a column mu cannot be combined with a table");
    /* the command line wins over a case file */
    assert_int_equal(shell("printf '[friction]\\nmu = 0.25\\n' > own.ini; printf "
                           "'[friction]\\nmu = 0.25\\nfriction-law = mu.txt\\n' > "
                           "both.ini"),
                     0);
    check_refused("both.ini", 65, "both.ini:2: mu: the table");
    assert_int_equal(shell("\"$R\" own.ini --friction-law mu.txt --quiet > table.tsv"), 0);
    check_refused(RAIL FALLS "--force -840", 64, "the largest is -5");
    check_refused(RAIL FALLS "--force -100 --all-solutions", 64,
                  "--all-solutions: at a given creepage");
    check_refused(RAIL "--all-solutions", 64, "friction that depends on");
}

/* Units of every number of a list, a file's own certificate, several solutions. */
TEST(friction_laws_by_words)
{
    held_json *mm = run_json(RAIL FALLS "--creep 0.001 --memory 0.001,2 --mu-fall 0.1,0.02 "
                                        "--slip-scale 100,50");
    held_json *si = run_json("--support halfplane --similar --radius 0.46 --young 209920e6 "
                             "--poisson 0.28 --gap exact --load 3111080 --mu 0.18 "
                             "--formulation steady --contact-elements 60 --friction-law "
                             "exponential --mu-fall 0.1,0.02 --slip-scale 0.1,0.05 --speed 45 "
                             "--memory 1e-6,2e-3 --creep 0.001 --units si");
    CHECK_REL(number_in(json_object_get(mm, "summary"), "force_ratio"),
              number_in(json_object_get(si, "summary"), "force_ratio"), 1e-9, "units");
    const json_t *scales = json_object_get(json_object_get(si, "inputs"), "slip-scale");
    CHECK_REL(json_number_value(json_array_get(scales, 1)), 0.05, 1e-12, "shown");

    assert_int_equal(rollbem(RAIL FALLS "--creep 0.001 --json --quiet --output r.json"), 0);
    CHECK_RUN(rollbem("check r.json"), 0, out, "r.json: valid: ");

    assert_int_equal(rollbem(RAIL FALLS "--mesh uniform --zone 4.65 --contact-elements 93 "
                                        "--creep 0.0009999 --all-solutions --json"),
                     0);
    assert_non_null(strstr(err, "2 solutions that differ from 82 starts"));
    assert_non_null(strstr(err, "\n  1   Q/(mu P) = "));
    assert_non_null(strstr(err, "\n  2   Q/(mu P) = "));
    held_json *several = json_loads(out, 0, NULL);
    json_t *list = json_object_get(several, "solutions");
    assert_int_equal(json_array_size(list), 2);
    for (size_t k = 0; k < 2; k++) {
        const json_t *s = json_object_get(json_array_get(list, k), "summary");
        CHECK_MAX(number_in(s, "residual"), 1e-10, "solution %zu", k);
    }
}

/* A stiff layer stretches over its soft base: displacements are the base's from further away
 * than the datum, and the tangential flexibility is indefinite.  A force along the shift or
 * full sliding under a tenth of what would slide is what was printed without a word. */
TEST(a_datum_that_is_too_near_is_said)
{
    static const struct {
        const char *options;
        int near;
    } all[] = {{"--base-young 1.54 --datum 14 --datum-b 14 --shift 1e-4", 1},
               {"--base-young 1.54 --datum 20 --datum-b 20 --shift 1e-4", 0},
               {"--base-young 1.54 --datum 14 --datum-b 14 --force-ratio 0.1", 0},
               {"--base-young 0.38 --datum 60 --datum-b 60 --shift 1e-4", 1},
               {"--base-young 0.38 --datum 100 --datum-b 100 --shift 1e-4", 0},
               {"--base-young 11.3 --datum 3.4 --datum-b 3.4 --shift 1e-4", 0}};
    char command[400];

    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        snprintf(command, sizeof command,
                 "--radius 5 --young 11.3 --poisson -0.1446 --support halfplane "
                 "--layer-thickness 3.373 --base-poisson 0.3 --radius-b 5 --similar --mu 3 "
                 "--half-width 0.47 --contact-elements 30 --json %s",
                 all[k].options);
        assert_int_equal(rollbem(command), 0);
        assert_int_equal(strstr(err, "The datum, the distance of zero displacement, is so near") !=
                             NULL,
                         all[k].near);
    }
    assert_int_equal(
        rollbem(
            "--support halfplane --datum 0.1 --datum-b 0.1 --similar --half-width 1 --shift 0.001"),
        0);
    assert_non_null(strstr(err, "other solutions exist for the same shift"));
    /* under a soft layer the stiff one stretches as far */
    write_file("stiff.txt", "0.01 210000 0.3\n0.02 2.1e11 0.3\n0.05 210000 0.3\n");
    static const char *const datum[] = {"auto", "1e6"};
    for (int k = 0; k < 2; k++) {
        snprintf(command, sizeof command,
                 "--support halfplane --radius 20 --layers stiff.txt --base-young 210000 "
                 "--base-poisson 0.3 --gap parabola --load 200 --mu 0.2 --datum %s",
                 datum[k]);
        assert_int_equal(rollbem(command), 0);
        assert_int_equal(strstr(err, "other solutions exist for the same shift") != NULL, k == 0);
    }
}

/* A body that relaxes moves as far as it turns in that time: beyond the datum it is the glassy
 * one, and nothing has to be said. */
TEST(relaxation_beyond_the_datum_is_glassy)
{
#define SLOW                                                                                       \
    "--radius 50 --young 2000 --poisson .4 --formulation steady --creep .003 --support halfplane " \
    "--contact-elements 20 "
#define RELAXES SLOW "--speed 100 --relaxation-ratio 1 --relaxation-time "
    held_json *glassy = run_json(SLOW "--mesh aligned --approach .05");
    held_json *slow = run_json(RELAXES "30 --mesh aligned --approach .05");
    CHECK_REL(number_in(json_object_get(slow, "summary"), "normal_load"),
              number_in(json_object_get(glassy, "summary"), "normal_load"), 0.02, "load");
    assert_int_equal(json_array_size(json_object_get(slow, "notes")), 0);
    assert_int_equal(rollbem(RELAXES "100 --load 50"), 0);
    assert_null(strstr(err, "datum"));
}

RUN_TESTS(enter_folder, leave_folder)
