/* What src/program/report keeps to itself: units and steps of axes, dashes, and gnuplot, whatever
 * becomes of it. */
#include "check.h"
#include "program/report/internal.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

/* From each limit on the larger unit. */
TEST(axes_have_units_that_fit)
{
    static const struct {
        rb_units units;
        const char *of;
        double largest, size;
        const char *name;
    } axes[] = {
        {RB_UNITS_MM, "MPa", 9999.0, 1.0, "MPa"}, {RB_UNITS_MM, "MPa", 1e4, 1e3, "GPa"},
        {RB_UNITS_SI, "MPa", 9999.0, 1.0, "Pa"},  {RB_UNITS_SI, "MPa", 1e4, 1e3, "kPa"},
        {RB_UNITS_SI, "MPa", 1e6, 1e6, "MPa"},    {RB_UNITS_SI, "MPa", 9.9e9, 1e6, "MPa"},
        {RB_UNITS_SI, "MPa", 1e10, 1e9, "GPa"},   {RB_UNITS_INCH, "MPa", 9999.0, 1.0, "psi"},
        {RB_UNITS_INCH, "MPa", 1e4, 1e3, "ksi"},  {RB_UNITS_MM, "mm", 1e-3, 1.0, "mm"},
        {RB_UNITS_SI, "mm", 0.099, 1e-3, "mm"},   {RB_UNITS_SI, "mm", 0.1, 1.0, "m"},
        {RB_UNITS_SI, "N/mm", 0.01, 1.0, "N/m"},  {RB_UNITS_INCH, "mm", 0.01, 1.0, "in"}};
    for (size_t k = 0; k < sizeof axes / sizeof *axes; k++) {
        const rb_report_unit unit = rb_report_axis_unit(axes[k].units, axes[k].of, axes[k].largest);
        CHECK_ABS(unit.size, axes[k].size, 0.0, "axis %zu", k);
        assert_string_equal(unit.name, axes[k].name);
    }
}

/* Lengths in half-widths where the numbers would be long. */
TEST(lengths_are_shown_in_half_widths_or_units)
{
    static const struct {
        rb_units units;
        double a, size;
        const char *label;
    } axes[] = {{RB_UNITS_MM, 0.0, 1.0, "[mm]"},      {RB_UNITS_MM, 0.01, 1.0, "[mm]"},
                {RB_UNITS_MM, 0.0099, 0.0099, "/ a"}, {RB_UNITS_MM, 1e5, 1.0, "[mm]"},
                {RB_UNITS_MM, 1.1e5, 1.1e5, "/ a"},   {RB_UNITS_SI, 2e-5, 1e-3, "[mm]"},
                {RB_UNITS_SI, 0.9e-5, 0.9e-5, "/ a"}};
    for (size_t k = 0; k < sizeof axes / sizeof *axes; k++) {
        const rb_report_length axis = rb_report_length_axis(axes[k].units, axes[k].a);
        CHECK_ABS(axis.size, axes[k].size, 0.0, "axis %zu", k);
        assert_string_equal(axis.label, axes[k].label);
    }
}

TEST(steps_are_one_two_or_five)
{
    static const double steps[][2] = {{1.0, 1.0},  {1.01, 2.0},   {2.0, 2.0},  {2.1, 5.0},
                                      {5.0, 5.0},  {5.1, 10.0},   {9.9, 10.0}, {0.03, 0.05},
                                      {70.0, 1e2}, {1.2e-7, 2e-7}};
    for (size_t k = 0; k < sizeof steps / sizeof *steps; k++)
        CHECK_REL(rb_report_round_step(steps[k][0]), steps[k][1], 1e-14, "step %zu", k);
    static const double powers[][2] = {{0.0, 0.0},   {0.1, 0.0},     {0.099, -2.0},
                                       {0.01, -2.0}, {0.0099, -3.0}, {7.0, 0.0}};
    for (size_t k = 0; k < sizeof powers / sizeof *powers; k++)
        assert_int_equal(rb_report_exponent(powers[k][0]), (int)powers[k][1]);
    CHECK_ABS(rb_report_labels_in(0.1), 2.0, 0.0, "at least two");
    CHECK_REL(rb_report_labels_in(0.5), 6.0, 1e-14, "twelve in the whole height");
}

/* ---- Gnuplot ----------------------------------------------------------------------- */

TEST(gnuplot_complaint_is_handed_on)
{
    FILE *script = tmpfile(), *out = tmpfile();
    rb_message why = {.text = ""};
    fputs("plt 1\n", script);
    assert_int_equal(rb_report_gnuplot(script, RB_REPORT_SVG, 20.0, out, &why), RB_EHELPER);
    assert_non_null(strstr(why.text, "invalid command"));
    fclose(script);
    fclose(out);
}

TEST(missing_gnuplot_is_named)
{
    char path[4096];
    snprintf(path, sizeof path, "%s", getenv("PATH"));
    FILE *script = tmpfile(), *out = tmpfile();
    rb_message why = {.text = ""};
    setenv("PATH", "/nonexistent", 1);
    const rb_status s = rb_report_gnuplot(script, RB_REPORT_SVG, 20.0, out, &why);
    setenv("PATH", path, 1);
    assert_int_equal(s, RB_EHELPER);
    assert_non_null(strstr(why.text, "not installed"));
    fclose(script);
    fclose(out);
}

/* A program called gnuplot, of that shell script, comes first in PATH. */
static rb_status draw_by(const char *lines, double seconds, rb_report_picture_kind kind, FILE *out,
                         rb_message *why)
{
    char folder[] = "/tmp/rollbem-gnuplot-XXXXXX", name[64], path[4200], before[4096];
    assert_non_null(mkdtemp(folder));
    snprintf(name, sizeof name, "%s/gnuplot", folder);
    FILE *program = fopen(name, "w"), *script = tmpfile();
    fprintf(program, "#!/bin/sh\n%s\n", lines);
    fclose(program);
    chmod(name, 0755);
    snprintf(before, sizeof before, "%s", getenv("PATH"));
    snprintf(path, sizeof path, "%s:%s", folder, before);
    setenv("PATH", path, 1);
    fputs("plot x\n", script);
    const rb_status s = rb_report_gnuplot(script, kind, seconds, out, why);
    setenv("PATH", before, 1);
    fclose(script);
    unlink(name);
    rmdir(folder);
    return s;
}

/* Full disks leave a part, or nothing, and exit code 0. */
TEST(a_part_of_a_picture_is_none)
{
    static const struct {
        rb_report_picture_kind kind;
        const char *part, *all;
    } pictures[] = {
        {RB_REPORT_SVG, "printf '<?xml <svg>'", "printf '<?xml <svg> more </svg>\\n\\n'"},
        {RB_REPORT_PDF, "printf '%%PDF-1.5 and so on'", "printf '%%PDF-1.5 and so on %%%%EOF\\n'"},
        {RB_REPORT_PNG, "printf '\\211PNG\\r\\n\\032\\n and so on'",
         "printf '\\211PNG\\r\\n\\032\\n and so on IEND\\256B`\\202'"},
        {RB_REPORT_GIF, "printf 'GIF89a and so on and on and on'",
         "printf 'GIF89a and so on and on and on;'"},
        {RB_REPORT_TEX, "printf '\\\\begin{tikzpicture} and so on'",
         "printf '\\\\begin{tikzpicture} and so on\\n%%%%%%%% gnuplot variables\\n'"},
        {RB_REPORT_SVG, ":", "printf '<?xml <svg> more </svg>'"}};
    for (size_t k = 0; k < sizeof pictures / sizeof *pictures; k++) {
        FILE *out = tmpfile();
        CHECK_SAYS(draw_by(pictures[k].part, 20.0, pictures[k].kind, out, &message), RB_EWRITE,
                   "a part of the picture only");
        assert_int_equal(ftell(out), 0);
        CHECK_OK(draw_by(pictures[k].all, 20.0, pictures[k].kind, out, &message));
        assert_true(ftell(out) > 20);
        fclose(out);
    }
}

/* The texts of gnuplot as LaTeX reads them, and nothing else of the picture but its date. */
TEST(texts_of_a_tex_picture)
{
    static const char of_gnuplot[] =
        "\\begin{tikzpicture}[gnuplot]\n"
        "%% generated with GNUPLOT 5.4p4\n"
        "%% Mon Nov 30 10:39:38 2026\n"
        "\\gpcolor{rgb color={0.1,0.2,0.3}}\n"
        "\\node[gp node right] at (1.012,0.985) {$-1$};\n"
        "\\node[gp node left,rotate=-270,font={\\fontsize{9pt}{10pt}\\selectfont}] at (4.5,3.2) "
        "{a_b "
        "[10^{-4}]};\n"
        "\\node[gp node center] at (1,2) {{/*0.85 {/:Bold T}  ξR/(μa_H) = -2.5·10^{6}, p_0 ≤ 3 % "
        "}};\n"
        "\\node[gp node center] at (1,2) {a\\_b & c-d #1 -x};\n"
        "\\node[gp node center] at (1,2) {slip → }odd{ end};\n"
        "\\node[gp node center] at (1,2) {};\n"
        "\\end{tikzpicture}\n";
    static const char of_latex[] =
        "% Needs \\usepackage{gnuplot-lua-tikz}, which comes with gnuplot.\n"
        "\\begin{tikzpicture}[gnuplot]\n"
        "%% generated with GNUPLOT 5.4p4\n"
        "\\gpcolor{rgb color={0.1,0.2,0.3}}\n"
        "\\node[gp node right] at (1.012,0.985) {$-1$};\n"
        "\\node[gp node left,rotate=-270,font={\\fontsize{9pt}{10pt}\\selectfont}] at (4.5,3.2) "
        "{a\\textsubscript{b} [10\\textsuperscript{{$-$4}}]};\n"
        "\\node[gp node center] at (1,2) {\\scalebox{0.85}{\\textbf{T}  "
        "$\\xi$R/($\\mu$a\\textsubscript{H}) = $-$2.5$\\cdot$10\\textsuperscript{{6}}, "
        "p\\textsubscript{0} $\\le$ 3 \\% }};\n"
        "\\node[gp node center] at (1,2) {a\\_b \\& c-d \\#1 -x};\n"
        "\\node[gp node center] at (1,2) {slip $\\to$ odd{ end}};\n"
        "\\node[gp node center] at (1,2) {};\n"
        "\\end{tikzpicture}\n";
    char got[2000] = "";
    FILE *picture = tmpfile(), *out = tmpfile(), *full = fopen("/dev/full", "w");
    fputs(of_gnuplot, picture);
    rewind(picture);
    assert_int_equal(rb_report_tex(picture, out), RB_OK);
    rewind(out);
    got[fread(got, 1, sizeof got - 1, out)] = '\0';
    assert_string_equal(got, of_latex);
    if (full) {
        setbuf(full, NULL);
        rewind(picture);
        assert_int_equal(rb_report_tex(picture, full), RB_EWRITE);
        fclose(full);
    }
    fclose(picture);
    fclose(out);
}

/* Each way in which a program called gnuplot may end without a picture. */
TEST(gnuplot_that_fails_is_told)
{
    static const struct {
        const char *lines;
        rb_status status;
        const char *part;
    } ends[] = {{"exit 127", RB_EHELPER, "gnuplot is not installed"},
                {"exit 2", RB_EHELPER, "gnuplot failed: no message"},
                {"echo '  wrong' >&2; echo '  ^' >&2; echo >&2; exit 1", RB_EHELPER,
                 "gnuplot failed:   wrong"},
                {"kill -9 $$", RB_EHELPER, "gnuplot failed: no message"},
                {"printf '<!xml> <svg> more and more </svg>'", RB_EWRITE, "a part of the picture"},
                {"printf '<?xml'", RB_EWRITE, "a part of the picture"},
                {"printf '<?xml <svg> more </svg\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n'", RB_EWRITE,
                 "a part of the picture"}};
    for (size_t k = 0; k < sizeof ends / sizeof *ends; k++) {
        FILE *out = tmpfile();
        CHECK_SAYS(draw_by(ends[k].lines, 20.0, RB_REPORT_SVG, out, &message), ends[k].status,
                   ends[k].part);
        assert_int_equal(ftell(out), 0);
        fclose(out);
    }
}

/* A file that is no program, a caller who does not wait for children, a full disk. */
TEST(gnuplot_and_its_surroundings)
{
    static const char picture[] = "printf '<?xml <svg> more </svg>'";
    char folder[] = "/tmp/rollbem-gnuplot-XXXXXX", name[64], before[4096];
    rb_message why = {.text = ""};
    FILE *script = tmpfile(), *out = tmpfile(), *disk = fopen("/dev/full", "w");
    assert_non_null(mkdtemp(folder));
    snprintf(name, sizeof name, "%s/gnuplot", folder);
    fclose(fopen(name, "w"));
    snprintf(before, sizeof before, "%s", getenv("PATH"));
    setenv("PATH", folder, 1);
    const rb_status s = rb_report_gnuplot(script, RB_REPORT_SVG, 20.0, out, &why);
    setenv("PATH", before, 1);
    unlink(name);
    rmdir(folder);
    fclose(script);
    CHECK_STATUS(s, RB_EHELPER);
    assert_string_equal(why.text, "gnuplot does not start: Permission denied");

    signal(SIGCHLD, SIG_IGN);
    CHECK_STATUS(draw_by(picture, 20.0, RB_REPORT_SVG, out, &why), RB_EHELPER);
    signal(SIGCHLD, SIG_DFL);
    assert_string_equal(why.text, "gnuplot: No child processes");
    assert_int_equal(ftell(out), 0);
    fclose(out);
    if (disk) {
        setbuf(disk, NULL);
        CHECK_STATUS(draw_by(picture, 20.0, RB_REPORT_SVG, disk, &why), RB_EWRITE);
        assert_string_equal(why.text, "cannot write: No space left on device");
        fclose(disk);
    }
}

TEST(gnuplot_has_a_time_limit)
{
    FILE *out = tmpfile();
    const double start = rb_seconds();
    CHECK_SAYS(draw_by("exec sleep 20", 0.2, RB_REPORT_SVG, out, &message), RB_EHELPER,
               "longer than 0.2 s");
    CHECK_MAX(rb_seconds() - start, 5.0, "seconds");
    fclose(out);
}

/* A descriptor that a caller has open, and would hand on to every child. */
TEST(gnuplot_inherits_no_descriptor)
{
    FILE *out = tmpfile();
    const int foreign = fcntl(fileno(out), F_DUPFD, 200);
    assert_true(foreign >= 200);
    CHECK_OK(draw_by("for fd in /proc/self/fd/2??; do\n"
                     "    if [ -e $fd ]; then echo inherited $fd >&2; exit 1; fi\n"
                     "done\n"
                     "printf '<?xml <svg> more </svg>'",
                     20.0, RB_REPORT_SVG, out, &message));
    close(foreign);
    fclose(out);
}

RUN_TESTS(NULL, NULL)
