/* Reports of a solution made by hand: Carter's closed form on 20 elements. */
#include "cases.h"
#include "check.h"
#include "rolling/case/closed_forms.h"
#include "base/io/io.h"
#include "program/report/report.h"

#include <jansson.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#define held_json HELD(json_t)
HELD_TYPE(json_t, json_decref)

enum { N = 20 };

static double arrays[9][N];
static int zones[N];

/* s = 0.5, a = 1, 16 of 20 elements in contact: stick from 0 to a. */
static rb_rolling_solution carter(void)
{
    const double mu = 0.3, p0 = 100.0;
    rb_rolling_solution s = {.n = N,
                             .x = arrays[0],
                             .h = arrays[1],
                             .gap = arrays[2],
                             .p = arrays[3],
                             .q = arrays[4],
                             .un = arrays[5],
                             .ut = arrays[6],
                             .shift = arrays[7],
                             .slip = arrays[8],
                             .zone = zones};
    for (int i = 0; i < N; i++) {
        s.h[i] = 0.125;
        s.x[i] = (i + 0.5 - N / 2) * 0.125;
        s.p[i] = rb_closed_hertz_pressure(p0, 1.0, s.x[i]);
        s.q[i] = rb_closed_carter_traction(mu, p0, 1.0, 0.5, s.x[i]);
        s.zone[i] = fabs(s.x[i]) > 1.0 ? 0 : s.x[i] > 0.0 ? 1 : 2;
        s.slip[i] = s.zone[i] == 2 ? 1e-3 / 3.0 * -s.x[i] : 0.0;
    }
    s.formulation = RB_STEADY;
    s.solver = RB_SOLVER_LEMKE;
    s.lcp_form = RB_LCP_PIVOTED;
    s.iterations = 21;
    s.contact = 16;
    s.stick = s.slipping = 8;
    s.normal_load = 157.0;
    s.datum = NAN; /* as of a wheel */
    s.tangential_load = -35.0;
    s.creep_ratio = 0.5;
    s.force_ratio = -0.75;
    s.creepage = 1.5e-3;
    s.half_width = s.contact_to = s.hertz_half_width = 1.0;
    s.contact_from = -1.0;
    s.stick_to = s.stick_length = 1.0;
    s.max_pressure = p0;
    s.load_error = s.support_balance = NAN;
    return s;
}

/* What is in a file, in static storage. */
static char *content(FILE *file)
{
    static char text[400000];
    rewind(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    return text;
}

static const rb_report_style full = {.bare = 0}, bare = {.bare = 1};

/* ---- Table ------------------------------------------------------------------------ */

TEST(table_reads_back_exactly)
{
    const rb_rolling_solution s = carter();
    FILE *file = tmpfile();
    assert_int_equal(rb_report_table(file, NULL, &s, NULL, "rollbem", &bare), RB_OK);
    rewind(file);
    char line[400];
    assert_non_null(fgets(line, sizeof line, file));
    assert_string_equal(line,
                        "x_mm\th_mm\tgap_mm\tp_MPa\tq_MPa\tun_mm\tut_mm\tshift_mm\tslip\tzone\n");
    for (int i = 0; i < N; i++) {
        double v[9];
        int zone;
        assert_int_equal(fscanf(file, "%lf\t%lf\t%lf\t%lf\t%lf\t%lf\t%lf\t%lf\t%lf\t%d\n", &v[0],
                                &v[1], &v[2], &v[3], &v[4], &v[5], &v[6], &v[7], &v[8], &zone),
                         10);
        for (int j = 0; j < 9; j++)
            CHECK_ABS(v[j], arrays[j][i], 0.0, "row %d, column %d", i, j);
        assert_int_equal(zone, zones[i]);
    }
    assert_int_equal(fgetc(file), EOF);
    fclose(file);
}

TEST(full_header_names_command_and_columns)
{
    const rb_rolling_solution s = carter();
    FILE *file = tmpfile();
    assert_int_equal(rb_report_table(file, NULL, &s, NULL, "rollbem --mu 0.3", &full), RB_OK);
    char *text = content(file);
    assert_non_null(strstr(text, "# rollbem " RB_VERSION "\n# rollbem --mu 0.3\n"));
    assert_ptr_equal(strstr(text, "x_mm\th_mm\t"), text);
    assert_non_null(strstr(text, "creepage xi > 0"));
    int headers = 0, lines = 0;
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
        headers += line[0] == '#';
        lines++;
    }
    assert_int_equal(lines - headers, N + 1);
    fclose(file);
}

TEST(full_disc_is_told)
{
    const rb_rolling_solution s = carter();
    FILE *file = fopen("/dev/full", "w");
    if (!file)
        skip();
    assert_int_equal(rb_report_table(file, NULL, &s, NULL, "rollbem", &bare), RB_EWRITE);
    fclose(file);
}

/* ---- JSON ------------------------------------------------------------------------- */

TEST(json_holds_the_same_numbers)
{
    const rb_rolling_solution s = carter();
    held_json *root = rb_report_json_start("rollbem 'a b'");
    json_object_set_new(root, "summary", rb_report_json_summary(&s));
    json_object_set_new(root, "table", rb_report_json_table(&s));
    FILE *file = tmpfile();
    assert_int_equal(rb_report_json_write(file, root), RB_OK);
    rewind(file);
    root = NOT_NULL(json_loadf(file, 0, NULL));
    assert_string_equal(json_string_value(json_object_get(root, "schema")), "rollbem/1");
    assert_string_equal(json_string_value(json_object_get(root, "command")), "rollbem 'a b'");
    const json_t *table = json_object_get(root, "table");
    for (int i = 0; i < N; i++) {
        CHECK_ABS(json_number_value(json_array_get(json_object_get(table, "q_MPa"), i)), s.q[i],
                  0.0, "q[%d]", i);
        assert_int_equal(json_integer_value(json_array_get(json_object_get(table, "zone"), i)),
                         zones[i]);
    }
    const json_t *summary = json_object_get(root, "summary");
    assert_true(json_is_null(json_object_get(summary, "load_error")));
    assert_true(json_is_null(json_object_get(summary, "datum"))); /* no half-plane */
    assert_string_equal(json_string_value(json_object_get(summary, "formulation")), "steady");
    CHECK_ABS(json_number_value(json_object_get(summary, "force_ratio")), -0.75, 0.0, "ratio");
    assert_int_equal(json_integer_value(json_object_get(summary, "iterations")), 21);
    fclose(file);
}

TEST(no_number_is_null)
{
    const double bad[] = {NAN, INFINITY, -INFINITY, 1.0};
    held_json *list = rb_report_json_numbers(4, bad);
    for (int i = 0; i < 3; i++)
        assert_true(json_is_null(json_array_get(list, (size_t)i)));
    assert_true(json_is_real(json_array_get(list, 3)));
    assert_int_equal(rb_report_json_write(stdout, NULL), RB_ENOMEM);
}

TEST(command_that_is_not_utf8)
{
    held_json *root = rb_report_json_start("rollbem \xff");
    assert_string_equal(json_string_value(json_object_get(root, "command")), "rollbem \\xff");
}

/* ---- For people ------------------------------------------------------------------- */

TEST(strip_shows_the_contact)
{
    rb_rolling_solution s = carter();
    char strip[81];
    rb_report_strip(&s, 80, strip);
    assert_string_equal(strip, ".ooSSSSSSSS********oo.");
    rb_report_strip(&s, 12, strip);
    assert_string_equal(strip, ".oSSSS****o.");
    s.n = 6; /* without contact everything is shown */
    memset(zones, 0, sizeof zones);
    rb_report_strip(&s, 80, strip);
    assert_string_equal(strip, ".oooooo.");
}

TEST(summary_fits_the_terminal)
{
    const rb_rolling_solution s = carter();
    for (int width = 1; width < 300; width += 23) {
        FILE *file = tmpfile();
        rb_report_summary(file, &s, width);
        const char *text = content(file);
        assert_non_null(strstr(text, "steady: solved by Lemke (pivoted form), 21 pivots"));
        assert_non_null(strstr(text, "Q/(mu P) = -0.75"));
        assert_null(strstr(text, "nan"));
        assert_non_null(strstr(text, "\n  computed  in "));
        fclose(file);
    }
}

/* From the first to the last stuck element there may be slip. */
TEST(summary_says_how_much_of_the_stick_zone_sticks)
{
    for (int hole = 0; hole < 2; hole++) {
        rb_rolling_solution s = carter();
        FILE *file = tmpfile();
        s.stick_length = hole ? 0.75 : 1.0;
        rb_report_summary(file, &s, 80);
        const char *text = content(file);
        assert_non_null(strstr(text, "; stick 0 ... 1 mm"));
        assert_int_equal(strstr(text, "1 mm, 0.75 of these 1 mm\n") != NULL, hole);
        fclose(file);
    }
}

/* A table as a terminal shows it, in a window of so many rows and columns. */
static void show(const char *text, int rows, int columns, int colour, char *shown, size_t size)
{
    const rb_report_window window = {rows, columns, colour, " gap "};
    char copy[4000];
    FILE *file = tmpfile();
    snprintf(copy, sizeof copy, "%s", text);
    CHECK_OK(rb_report_terminal(file, copy, &window));
    snprintf(shown, size, "%.*s", (int)size - 1, content(file));
    fclose(file);
}

TEST(a_terminal_gets_five_digits_and_units_below_the_names)
{
    char shown[4000];
    show("x_mm\tp_MPa\tspeed_mm/s\tslip\tzone\tnothing\n"
         "# a comment\n"
         "-0.123456789\t0\t5\t1e-30\t0\tNaN\n"
         "0.5\t123456.78901\t5\t0.25\t1\tNaN\n"
         "1\t-2\t5\t-1\t2\tNaN\n",
         24, 80, 0, shown, sizeof shown);
    assert_string_equal(shown, "         x           p  slip  zone\n"
                               "        mm         MPa            \n"
                               "  -0.12346           0     0     0\n"
                               "       0.5  1.2346e+05  0.25     1\n"
                               "         1          -2    -1     2\n"
                               "in every row: speed = 5 mm/s\n");
}

/* No line is wider than the window, no more rows than it has, first and last among them;
 * the columns that matter less go first. */
TEST(a_terminal_gets_what_fits)
{
    char text[4000] = "x_mm\tgap\tp\tq\tr\ts\n", shown[4000], *line = shown;
    int lines = 0;
    for (int i = 0; i < 100; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "%d\t%d.5\t%d\t%d\t%d\t%d\n", i,
                 i, 2 * i, 3 * i, 4 * i, 12345 * i);
    show(text, 20, 26, 0, shown, sizeof shown);
    assert_non_null(strstr(shown, "\n   0  "));
    assert_non_null(strstr(shown, "\n  99  "));
    assert_non_null(strstr(shown, "\nnot shown: 7 in 8 rows,\n  gap, s;\n  all: rollbem"));
    for (char *end; (end = strchr(line, '\n')) != NULL; line = end + 1, lines++)
        assert_true(end - line <= 26);
    assert_in_range(lines, 15, 20);
}

/* Files and solvers: the middle is left out; a wide single row stands upright. */
TEST(a_terminal_gets_words_whole)
{
    char text[4000] = "solver\tscaled_MPa\n", shown[4000];
    for (int i = 0; i < 30; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "s%d\t%d\n", i, i);
    show(text, 15, 40, 0, shown, sizeof shown);
    assert_non_null(strstr(shown, "\n      s4       4\n  ...\n     s26      26\n"));
    assert_non_null(strstr(shown, "\nnot shown: 21 rows in the middle;"));
    show("solver\tP_MPa\tq\nlemke\t0.25\tnan\n", 15, 14, 0, shown, sizeof shown);
    assert_string_equal(shown, "  solver  lemke\n  P       0.25 MPa\n");
}

/* Continued below the text of a label; colours have no width. */
TEST(lines_are_broken_between_words)
{
    FILE *file = tmpfile();
    const char *text = "  load      P = 1 N/mm, Q = 2 N/mm\n\033[33mnote:\033[0m µ µ µ µ\n"
                       "\n    unbreakable-word\n";
    assert_int_equal(rb_report_wrapped(file, text, 20), 6);
    assert_string_equal(content(file),
                        "  load      P = 1\n            N/mm, Q\n            = 2 N/mm\n"
                        "\033[33mnote:\033[0m µ µ µ µ\n\n    unbreakable-word\n");
    fclose(file);
}

TEST(a_terminal_shows_zones_in_colour)
{
    char shown[4000];
    const char *table = "x\tzone\tstatus\n0\t0\tsolved\n1\t1\tray\n2\t3\tsolved\n";
    show(table, 24, 80, 1, shown, sizeof shown);
    assert_non_null(strstr(shown, "\033[90m0\033[0m"));
    assert_non_null(strstr(shown, "\033[32m1\033[0m"));
    assert_non_null(strstr(shown, "\033[33m3\033[0m"));
    assert_non_null(strstr(shown, "\033[31mray\033[0m"));
    show(table, 24, 80, 0, shown, sizeof shown);
    assert_null(strchr(shown, '\033'));
}

/* JSON, sentences, a table of commas, nothing at all. */
TEST(a_terminal_gets_other_text_as_it_is)
{
    static const char *const texts[] = {"{\n \"a\": 1\n}\n", "x,y\n1,2\n", "one line", "", "\n"};
    char shown[4000];
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        show(texts[k], 24, 80, 0, shown, sizeof shown);
        assert_string_equal(shown, texts[k]);
    }
    show("a\tb\n", 24, 80, 0, shown, sizeof shown);
    assert_string_equal(shown, "  a  b\n");
}

TEST(notes_warn_where_due)
{
    rb_rolling_solution s = carter();
    rb_rolling_case rc = rolling_case("formulation steady support halfplane creep 1e-3");
    FILE *file = tmpfile();
    rb_rolling_note_list notes = rb_rolling_find_notes(&rc, &s);
    rb_report_notes(file, &notes, 0);
    assert_string_equal(content(file), "");
    rc.a.support = RB_BEM_ARC;
    s.approach = rc.a.radius / 2.0;
    notes = rb_rolling_find_notes(&rc, &s);
    rb_report_notes(file, &notes, 0);
    assert_non_null(strstr(content(file), "hub and halfplane"));
    assert_non_null(strstr(content(file), "far beyond linear elasticity"));
    fclose(file);
    file = tmpfile();
    rc.formulation = s.formulation = RB_STATIC;
    rc.creep = 0.1;
    notes = rb_rolling_find_notes(&rc, &s);
    rb_report_notes(file, &notes, 0);
    assert_non_null(strstr(content(file), "--formulation steady"));
    fclose(file);
}

/* ---- Pictures --------------------------------------------------------------------- */

TEST(pictures_of_every_kind)
{
    static const char *const names[] = {"a.png", "b.svg", "c.pdf", "d.eps", "e.tex"};
    static const char *const starts[] = {"\x89PNG", "<?xml", "%PDF", "%!PS",
                                         "% Needs \\usepackage{gnuplot-lua-tikz}"};
    const rb_rolling_solution s = carter();
    const rb_rolling_case rc = rb_rolling_case_defaults();
    for (int k = 0; k < 5; k++) {
        rb_report_picture_kind kind;
        FILE *file = tmpfile();
        assert_int_equal(rb_report_picture_kind_of(names[k], &kind, &message), RB_OK);
        assert_int_equal(
            rb_report_picture(file, (rb_report_canvas){.kind = kind}, &rc, &s, &message), RB_OK);
        assert_int_equal(strncmp(content(file), starts[k], strlen(starts[k])), 0);
        fclose(file);
    }
}

TEST(picture_of_another_kind)
{
    rb_report_picture_kind kind;
    rb_message why = {.text = ""};
    assert_int_equal(rb_report_picture_kind_of("a.bmp", &kind, &why), RB_EINVAL);
    assert_non_null(strstr(why.text, "a.bmp"));
    assert_non_null(strstr(why.text, ".png, .svg, .pdf, .eps or .tex (of a history also .gif)"));
    assert_int_equal(rb_report_picture_kind_of(".png", &kind, &why), RB_EINVAL);
    assert_int_equal(rb_report_picture_kind_of("a.gif", &kind, &why), RB_OK);
    assert_int_equal(kind, RB_REPORT_GIF);
}

/* Of several curves each says which of its points have no derivatives, in both forms. */
TEST(curves_say_what_has_no_derivatives)
{
    double load[2] = {500.0, 500.0}, slope[2][2 * 2] = {{1.0, 1.0, NAN, NAN}, {2.0, 2.0, 3.0, 3.0}};
    rb_case_slope of = {.result = &rb_rolling_solution_scalars.row[0], .input = "mu", .unit = "-"};
    rb_report_curves curves = {.n = 3, .mu = {0.1, 0.2, 0.3}};
    const rb_report_style style = {.format = RB_REPORT_TSV};
    char text[4000] = "";
    FILE *out = fmemopen(text, sizeof text, "w");
    for (int k = 0; k < 3; k++) {
        curves.curve[k] = (rb_rolling_curve){.n = 2, .rising = 2, .normal_load = load};
        curves.slopes[k] = (rb_case_slopes){.table = &rb_rolling_solution_scalars,
                                            .n = 1,
                                            .rows = 2,
                                            .of = &of,
                                            .value = slope[k == 1],
                                            .without = k != 1};
        rb_fail(&curves.slopes[k].reason, RB_EINVAL, "reason %d", k);
    }
    CHECK_OK(rb_report_curve_table(out, &curves, NULL, "curve", &style));
    fclose(out);
    assert_non_null(strstr(text, "# mu = 0.1: 1 of 2 points have no derivatives: reason 0\n"));
    assert_non_null(strstr(text, "# mu = 0.3: 1 of 2 points have no derivatives: reason 2\n"));
    assert_null(strstr(text, "# mu = 0.2:"));
    held_json *root = json_object();
    rb_report_json_curves(&root, &curves);
    const json_t *all = json_object_get(root, "curves");
    for (size_t k = 0; k < 3; k++) {
        const json_t *note = json_object_get(json_array_get(all, k), "derivatives_note");
        assert_true(k == 1 ? !note
                           : strstr(json_string_value(note), "no derivatives: reason") != NULL);
    }
    out = fmemopen(text, sizeof text, "w");
    curves.n = 1;
    CHECK_OK(rb_report_curve_table(out, &curves, NULL, "curve", &style));
    fclose(out);
    assert_non_null(strstr(text, "# 1 of 2 points have no derivatives: reason 0\n"));
}

/* In the axes of textbooks: Carter's q is -mu p0 sqrt(1 - x^2/a^2) where it slides, and the table
 * says what its numbers are divided by. */
TEST(dimensionless_table)
{
    rb_rolling_solution s = carter();
    rb_rolling_case rc = {.mu = 0.35, .a.radius = 10.0};
    FILE *file = tmpfile();
    assert_non_null(file);
    s.half_width = 2.0; /* not 1, which divides nothing */
    assert_int_equal(
        rb_report_table(file, &rc, &s, NULL, "rollbem", &(rb_report_style){.dimensionless = 1}),
        RB_OK);
    const char *text = content(file);
    assert_ptr_equal(strstr(text, "x/a\th/a\tgap/a\tp/p0\tq/(mu*p0)\tun/a\t"), text);
    assert_non_null(strstr(text, "# a = 2 mm, p0 = 100 MPa, mu = 0.35\n"));
    int rows = 0;
    for (const char *line = strchr(text, '\n'); line && line[1]; line = strchr(line + 1, '\n')) {
        double x, h, gap, p, q;
        if (sscanf(line + 1, "%lf %lf %lf %lf %lf", &x, &h, &gap, &p, &q) != 5)
            continue;
        CHECK_ABS(x, s.x[rows] / 2.0, 1e-15, "x/a");
        CHECK_ABS(p, s.p[rows] / s.max_pressure, 1e-15, "p/p0");
        CHECK_ABS(q, s.q[rows] / (0.35 * s.max_pressure), 1e-15, "q/(mu p0)");
        rows++;
    }
    assert_int_equal(rows, s.n);
    fclose(file);
}

/* What has no steps, no grid, no contact is no picture, and no file is written. */
TEST(pictures_need_something_to_draw)
{
    const rb_report_canvas canvas = {.kind = RB_REPORT_SVG, .script = 1};
    const rb_rolling_case rc = rb_rolling_case_defaults();
    rb_rolling_solution none = carter(), pressed = carter();
    const rb_rolling_history no_steps = {0};
    const rb_report_curves curves = {.n = 1, .mu = {0.3}, .curve = {{.n = 1, .rising = 1}}};
    const rb_report_wear no_wear = {0};
    const rb_rolling_shakedown shakedown = {0};
    rb_report_stress row = {.nx = 5, .ny = 1, .s = &pressed, .rc = &rc};
    rb_report_stress column = {.nx = 1, .ny = 5, .s = &pressed, .rc = &rc};
    rb_report_stress no_load = {.s = &none, .rc = &rc, .shakedown = &shakedown};
    const double x[] = {1.0, 2.0}, no_value[] = {NAN, NAN};
    const rb_report_study study = {.n = 2,
                                   .x = {.name = "mu", .unit = "", .value = x},
                                   .shown = {.name = "force_ratio", .unit = "", .value = no_value}};
    enum { PICTURES = 11 };
    rb_message why[PICTURES];
    FILE *out = tmpfile();
    none.n = 0;
    none.normal_load = 0.0;
    const rb_status status[PICTURES] = {
        rb_report_picture(out, canvas, &rc, &none, &why[0]),
        rb_report_history_picture(out, canvas, &rc, &no_steps, &why[1]),
        rb_report_curve_picture(out, canvas, &rc, &curves, RB_OVER_CREEP, &why[2]),
        rb_report_wear_picture(out, canvas, &no_wear, &why[3]),
        rb_report_stress_picture(out, canvas, &row, &why[4]),
        rb_report_stress_picture(out, canvas, &column, &why[5]),
        rb_report_fringes(out, canvas, &row, 0.0, &why[6]),
        rb_report_shakedown_map(out, canvas, &row, &why[7]),
        rb_report_shakedown_map(out, canvas, &no_load, &why[8]),
        rb_report_study_picture(out, canvas, &study, 0, &why[9]),
        rb_report_study_picture(out, canvas, &study, 1, &why[10])};
    static const char *const wanted[PICTURES] = {"nothing to draw",
                                                 "no steps to draw",
                                                 "no curve to draw at mu = 0.3",
                                                 "nothing to draw",
                                                 "a picture of the stress needs a grid",
                                                 "a picture of the stress needs a grid",
                                                 "a picture of the stress needs a grid",
                                                 "no contact to draw",
                                                 "no contact to draw",
                                                 "no case has a force_ratio",
                                                 "a map needs two options with two values or more"};
    for (int k = 0; k < PICTURES; k++) {
        CHECK_STATUS(status[k], RB_EINVAL);
        assert_string_equal(why[k].text, wanted[k]);
    }
    assert_int_equal(ftell(out), 0);
    fclose(out);
}

/* A history by hand: one step has a range too, a step without contact a width of zero. */
TEST(history_of_few_steps_is_drawn)
{
    double column[12][17] = {{0.0}};
    int stick[17] = {3, 0}, slipping[17] = {1, 0};
    rb_rolling_history h = {.n = 1,
                            .distance = column[0],
                            .creepage = column[1],
                            .shift = column[2],
                            .approach = column[3],
                            .normal_load = column[4],
                            .tangential_load = column[5],
                            .force_ratio = column[6],
                            .contact_from = column[7],
                            .contact_to = column[8],
                            .stick = stick,
                            .slipping = slipping};
    const rb_rolling_case rc = rb_rolling_case_defaults();
    const rb_report_canvas canvas = {.kind = RB_REPORT_SVG, .script = 1};
    FILE *out = tmpfile();
    h.shift[0] = 0.25;
    h.normal_load[0] = 100.0;
    h.contact_from[0] = -1.0;
    h.contact_to[0] = 3.0;
    CHECK_OK(rb_report_history_picture(out, canvas, &rc, &h, &message));
    const char *script = content(out);
    assert_non_null(strstr(script, "x_from = 1.0\nx_to = 1.000001\n"));
    assert_non_null(strstr(script, "band_force\n1 0.25 0 0.75 0 0\nEOD"));
    assert_non_null(strstr(script, "label1 = 'shift  [mm]'"));
    fclose(out);

    out = tmpfile();
    h.n = 17; /* from 1 on: eight marks of two increments */
    CHECK_OK(rb_report_history_picture(out, canvas, &rc, &h, &message));
    assert_non_null(strstr(content(out), "x_step = 2.0\n"));
    fclose(out);

    out = tmpfile();
    h.n = 2;
    h.time = column[9];
    h.time[1] = 0.5;
    h.contact_from[1] = h.contact_to[1] = NAN;
    CHECK_OK(rb_report_history_picture(out, canvas, &rc, &h, &message));
    script = content(out);
    assert_non_null(strstr(script, "Static contact in time}   2 steps"));
    assert_non_null(strstr(script, "band_approach\n0 2 100 0 0 0 0\n0.5 0 0 0 0 0 0\nEOD"));
    assert_non_null(strstr(script, "x_from = 0.0\nx_to = 0.5\n"));
    fclose(out);
}

/* What has no number is left out of the lines for people and of the title. */
TEST(what_is_not_known_is_left_out)
{
    static const struct {
        const char *in_summary, *in_title;
    } words[] = {{", Q/(mu P) = ", "Q/(μP) = "},
                 {", xi R/(mu a) = ", "ξR/(μa) = "},
                 {"creepage  xi = ", "ξ = "}};
    const rb_report_canvas canvas = {.kind = RB_REPORT_SVG, .script = 1};
    const rb_rolling_case rc = rb_rolling_case_defaults();
    for (int without = 0; without <= 3; without++) {
        rb_rolling_solution s = carter();
        if (without > 0)
            s.force_ratio = NAN;
        if (without > 1)
            s.creep_ratio = NAN;
        if (without > 2)
            s.creepage = NAN;
        for (int title = 0; title < 2; title++) {
            FILE *file = tmpfile();
            if (title)
                CHECK_OK(rb_report_picture(file, canvas, &rc, &s, &message));
            else
                rb_report_summary(file, &s, 80);
            const char *text = content(file);
            for (int k = 0; k < 3; k++) {
                const char *word = title ? words[k].in_title : words[k].in_summary;
                if ((strstr(text, word) == NULL) != (k < without))
                    fail_msg("%d of 3 left out: '%s'", without, word);
            }
            assert_null(strstr(text, "nan"));
            fclose(file);
        }
    }
    rb_rolling_solution s = carter(); /* static: the shift, and a creepage if there is */
    s.formulation = RB_STATIC;
    for (int k = 0; k < 4; k++) {
        FILE *file = tmpfile();
        s.creepage = k / 2 ? 1e-3 : 0.0;
        s.tangential_shift = k % 2 ? 0.125 : NAN;
        rb_report_summary(file, &s, 80);
        const char *text = content(file);
        assert_int_equal(strstr(text, "creepage  xi = 0.001") != NULL, k / 2);
        assert_int_equal(strstr(text, "shift     0.125 mm\n") != NULL, k % 2);
        fclose(file);
    }
}

/* What the picture of a solution says of one without contact. */
TEST(picture_without_contact_says_so)
{
    const rb_report_canvas canvas = {.kind = RB_REPORT_SVG, .script = 1};
    const rb_rolling_case rc = rb_rolling_case_defaults();
    rb_rolling_solution s = carter();
    FILE *out = tmpfile();
    memset(s.p, 0, N * sizeof *s.p);
    memset(s.q, 0, N * sizeof *s.q);
    memset(s.slip, 0, N * sizeof *s.slip);
    memset(s.zone, 0, N * sizeof *s.zone);
    s.contact = s.stick = s.slipping = 0;
    s.half_width = s.max_pressure = s.normal_load = s.tangential_load = 0.0;
    CHECK_OK(rb_report_picture(out, canvas, &rc, &s, &message));
    const char *script = content(out);
    assert_non_null(strstr(script, "results = '{/*0.95 no contact}'"));
    assert_non_null(strstr(script, "x_from = -1.25\nx_to = 1.25\n")); /* all elements */
    assert_non_null(strstr(script, "is_carter = 0\n"));
    assert_null(strstr(script, "nan"));
    fclose(out);
}

/* The first step, the last and those nearest to equal parts of the way; no more than fit. */
TEST(wear_keeps_some_profiles)
{
    enum { STEPS = 37 };
    double way[STEPS + 1], depth[STEPS + 1];
    const rb_rolling_solution s = carter();
    const rb_rolling_wear_history h = {.n = STEPS + 1, .slides = 1, .way = way, .max_depth = depth};
    rb_report_wear w = {.history = &h};
    for (int k = 0; k <= STEPS; k++) {
        way[k] = 10.0 * k;
        depth[k] = 1e-3 * k;
        CHECK_OK(rb_report_wear_keep(&w, &s, &h, k, STEPS));
    }
    const int last = RB_REPORT_WEAR_PROFILES - 1;
    assert_int_equal(w.profiles, last + 1);
    for (int k = 0; k <= last; k++) {
        const rb_report_wear_profile *p = &w.profile[k];
        const int step = (k * STEPS + last - 1) / last; /* the first that is so far */
        CHECK_ABS(p->way, way[step], 0.0, "profile %d", k);
        assert_int_equal(p->n, N);
        for (int i = 0; i < N; i++) {
            CHECK_ABS(p->x[i], s.x[i], 0.0, "x");
            CHECK_ABS(p->p[i], s.p[i], 0.0, "p");
            CHECK_ABS(p->depth[i], depth[step], 0.0, "depth");
        }
    }
    CHECK_OK(rb_report_wear_keep(&w, &s, &h, 0, STEPS));
    assert_int_equal(w.profiles, last + 1);
    rb_report_wear_free(&w);
    assert_int_equal(w.profiles, 0);
    for (int k = 0; k < 3; k++) /* few steps: each of them */
        CHECK_OK(rb_report_wear_keep(&w, &s, &h, k, 2));
    assert_int_equal(w.profiles, 3);
    alloc_fail_after(0);
    const rb_status refused = rb_report_wear_keep(&w, &s, &h, 3, 3);
    alloc_succeed();
    CHECK_STATUS(refused, RB_ENOMEM);
    rb_report_wear_free(&w);
}

/* Steps of the shares over tau, a colour for each solver; a column of print has its
 * caption instead of a title. */
TEST(profiles_are_drawn)
{
    static const char *const solver[] = {"auto", "lemke"};
    static const double tau[] = {1.0, 2.0, 10.0}, rho[] = {0.75, 0.75, 1.0, 0.25, 0.5, 0.5};
    for (int column = 0; column < 2; column++)
        for (int problems = 1; problems < 5; problems += 3) {
            const rb_report_profiles profiles = {problems, 2, 3, solver, "time", tau, rho};
            const rb_report_canvas canvas = {.kind = RB_REPORT_SVG,
                                             .size = column ? RB_REPORT_85MM : RB_REPORT_OWN_SIZE,
                                             .script = 1};
            char title[100];
            FILE *out = tmpfile();
            CHECK_OK(rb_report_profiles_picture(out, canvas, &profiles, &message));
            const char *script = content(out);
            snprintf(title, sizeof title, "Performance profiles}   %d problem%s'", problems,
                     problems > 1 ? "s" : "");
            assert_non_null(strstr(script, title));
            assert_int_equal(strstr(script, "titled = 1\n") == NULL, column);
            assert_non_null(strstr(script, "\n$table << EOD\ntau \"auto\" \"lemke\"\n1 0.75 0.25\n"
                                           "2 0.75 0.5\n10 1 0.5\nEOD\n"));
            assert_non_null(strstr(script, "n = 2\n"));
            assert_non_null(strstr(script, "x_label = 'τ: time over the least"));
            fclose(out);
        }
}

/* ---- A gnuplot that misbehaves ---- */

/* A start-up file that would end every picture. */
TEST(start_up_files_are_off)
{
    char folder[] = "/tmp/rollbem-home-XXXXXX", name[64], home[4096];
    assert_non_null(mkdtemp(folder));
    snprintf(name, sizeof name, "%s/.gnuplot", folder);
    FILE *file = fopen(name, "w"), *out = tmpfile();
    fputs("exit status 3\n", file);
    fclose(file);
    snprintf(home, sizeof home, "%s", getenv("HOME") ? getenv("HOME") : "/");
    setenv("HOME", folder, 1);
    const rb_rolling_solution s = carter();
    const rb_rolling_case rc = rb_rolling_case_defaults();
    const rb_status status =
        rb_report_picture(out, (rb_report_canvas){.kind = RB_REPORT_SVG}, &rc, &s, &message);
    setenv("HOME", home, 1);
    unlink(name);
    rmdir(folder);
    fclose(out);
    CHECK_OK(status);
}

/* ---- Citations -------------------------------------------------------------------- */

/* docs/theory.md 9 with single blanks. */
static const char *literature(void)
{
    static char text[20000];
    FILE *file = NOT_NULL(fopen("docs/theory.md", "r"));
    char *all = content(file), *from = strstr(all, "## 9 Literature"), *to = text;
    fclose(file);
    assert_non_null(from);
    for (; *from && to < text + sizeof text - 1; from++)
        if (!strchr(" \n", *from) || (to > text && to[-1] != ' '))
            *to++ = *from == '\n' ? ' ' : *from;
    return text;
}

TEST(papers_are_those_of_the_theory)
{
    static const struct {
        rb_rolling_formulation formulation;
        rb_bem_support support;
        const char *cited, *not_cited;
    } runs[] = {{RB_STATIC, RB_BEM_ARC, "[1] K. Addi", "F. W. Carter"},
                {RB_STEADY, RB_BEM_HALFPLANE, "[10] R. H. Bentall", "C. A. Brebbia"}};
    char known[700];
    for (size_t k = 0; k < sizeof runs / sizeof *runs; k++) {
        rb_rolling_case rc = rb_rolling_case_defaults();
        rc.formulation = runs[k].formulation;
        rc.a.support = runs[k].support;
        FILE *file = tmpfile();
        rb_report_citations(file, &rc, NULL);
        const char *text = content(file);
        assert_non_null(strstr(text, runs[k].cited));
        assert_null(strstr(text, runs[k].not_cited));
        int number, n, papers = 0;
        rewind(file);
        char line[700];
        while (fgets(line, sizeof line, file)) {
            line[strcspn(line, "\n")] = '\0';
            if (sscanf(line, "[%d] %n", &number, &n) != 1)
                continue;
            snprintf(known, sizeof known, " %d. %s", number, line + n);
            papers++;
            if (!strstr(literature(), known))
                fail_msg("docs/theory.md 9 has not:%s", known);
        }
        assert_true(papers >= 3);
        fclose(file);
    }
}

RUN_TESTS(NULL, NULL)
