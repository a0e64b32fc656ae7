/* The tables of every command in the programs that people open tables with: the lines of
 * docs/tables.md as they stand, and every table in every program that is installed. */
#include "cli_run.h"

static char docs[20000];

static int set_up(void **state)
{
    slurp("docs/tables.md", docs, sizeof docs);
    if (enter_folder(state) != 0)
        return -1;
    write_file("two.txt", "2\n2 1  1 2  -5 -6\n");
    write_file("ray.txt", "1\n-1\n-1\n");
    return shell("\"$R\" --contact-elements 24 --quiet >tractions.tsv; \"$R\" --similar --support "
                 "halfplane --load 500 --formulation transient --creep-ratio .5 --distance 1 "
                 "--contact-elements 24 --error --quiet --history-table history.tsv >/dev/null; "
                 "\"$R\" curve --points 3 --mu 0.1,0.3 --quiet >curve.tsv; \"$R\" stress --support "
                 "halfplane --load 500 --grid 5x4 --quiet >stress.tsv; \"$R\" sweep --support "
                 "halfplane --load 500 --vary-1 'mu 0.1 0.3' --quiet >study.tsv; \"$R\" sweep "
                 "--support halfplane --load 500 --vary-1 'mu 0.1 0.3' --quiet --format csv "
                 ">study.csv; \"$R\" --contact-elements 24 --fclib problem.hdf5 --quiet "
                 "--format csv >tractions.csv; \"$R\" lcp two.txt ray.txt >files.tsv; \"$R\" lcp "
                 "--solution two.txt >unknowns.tsv; \"$R\" lcp --trace two.txt >pivots.tsv; \"$R\" "
                 "friction --facts problem.hdf5 >friction.tsv; \"$R\" friction "
                 "--trace problem.hdf5 >friction-trace.tsv; \"$R\" friction "
                 "--solution problem.hdf5 >reactions.tsv; \"$R\" compare "
                 "--solvers nsn-ac,lemke problem.hdf5 --profiles profiles.tsv >compare.tsv; "
                 "\"$R\" example truss --nodes 4 "
                 ">truss.tsv; cp tractions.tsv table.tsv; ls *.tsv *.csv | wc -l");
}

/* The lines of the k-th block of docs/tables.md in that language. */
static const char *block_of(const char *language, int k)
{
    static char text[2000];
    char fence[40];
    const char *at = docs;
    snprintf(fence, sizeof fence, "```%s\n", language);
    for (; k >= 0; k--) {
        at = NOT_NULL(strstr(at, fence));
        at += strlen(fence);
    }
    snprintf(text, sizeof text, "%.*s", (int)(strstr(at, "```") - at), at);
    return text;
}

static double largest_pressure(void)
{
    assert_int_equal(shell("cut -f4 tractions.tsv | grep '^[0-9]' | sort -g | tail -1"), 0);
    return strtod(out, NULL);
}

/* The lines of the docs print the largest pressure . */
static void check_lines(const char *command, const char *language, int k)
{
    const double wanted = largest_pressure();
    write_file("lines", block_of(language, k));
    if (shell(command) != 0)
        print_error("%s: %s\n", command, err);
    const double got = strtod(out, NULL);
    CHECK_REL(got, wanted, 1e-5, "%s", command);
}

/* Every table has as many columns and rows as its lines say, and the program sees them. */
static void check_tables(const char *command, const char *script)
{
    write_file("script", script);
    if (shell(command) != 0)
        fail_msg("%s: %s\n%s", command, out, err);
    assert_int_equal(shell("grep -c . listed >/dev/null && for f in *.tsv; do "
                           "n=$(grep -v '^#' $f | tail -n +2 | wc -l); "
                           "m=$(head -1 $f | awk -F '\\t' '{print NF}'); "
                           "grep -qx \"$f $n $m\" listed || { echo \"$f $n $m\"; exit 1; }; done"),
                     0);
}

/* whether it is there, without loading it */
#define PYTHON_HAS(module)                                                                         \
    "/usr/bin/python3 -c 'import importlib.util, sys; "                                            \
    "sys.exit(not importlib.util.find_spec(\"" module "\"))'"

static void skip_without(const char *probe, const char *program_name)
{
    if (shell(probe) == 0)
        return;
    print_message("skipped: %s is not installed\n", program_name);
    skip();
}

TEST(pandas_opens_all)
{
    IN_TURN(0, 3);
    skip_without(PYTHON_HAS("pandas"), "pandas");
    check_lines("/usr/bin/python3 lines", "python", 0);
    check_tables("/usr/bin/python3 script >listed",
                 "import glob, pandas\n"
                 "for f in glob.glob('*.tsv'):\n"
                 "    t = pandas.read_csv(f, sep='\\t', comment='#')\n"
                 "    print(f, *t.shape)\n"
                 "for f in glob.glob('*.csv'):\n"
                 "    t, u = pandas.read_csv(f), pandas.read_csv(f[:-3] + 'tsv', "
                 "sep='\\t', comment='#')\n"
                 "    assert t.equals(u), f\n"
                 "assert set(t.dtypes.astype(str)) <= {'int64', 'float64'}\n");
}

TEST(numpy_opens_all)
{
    IN_TURN(1, 3);
    skip_without(PYTHON_HAS("numpy"), "numpy");
    check_lines("/usr/bin/python3 lines", "python", 1);
    check_tables("/usr/bin/python3 script >listed",
                 "import glob, numpy\n"
                 "for f in glob.glob('*.tsv'):\n"
                 "    t = numpy.atleast_1d(numpy.genfromtxt(f, names=True))\n"
                 "    print(f, len(t), len(t.dtype.names))\n");
}

TEST(r_opens_all)
{
    IN_TURN(0, 3);
    skip_without("Rscript --version", "R");
    check_lines("Rscript --vanilla lines", "r", 0);
    check_tables("Rscript --vanilla script >listed",
                 "for (f in Sys.glob('*.tsv')) {\n"
                 "  t <- read.table(f, header = TRUE)\n"
                 "  if (f == 'history.tsv') stopifnot(all(sapply(t, is.numeric)))\n"
                 "  cat(paste(f, nrow(t), ncol(t)), sep = '\\n')\n"
                 "}\n");
}

TEST(octave_opens_all)
{
    IN_TURN(1, 3);
    skip_without("octave-cli --version", "Octave");
    check_lines("octave-cli --no-init-file --quiet lines", "octave", 0);
    write_file("script",
               "t = importdata('history.tsv', \"\\t\"); u = importdata('curve.tsv', \"\\t\");\n"
               "printf('%d %d %d', columns(t.data), columns(u.data), rows(u.data));\n");
    if (shell("octave-cli --no-init-file --quiet script") != 0)
        print_error("%s\n", err);
    int counted[3] = {0}, wanted[2] = {0};
    assert_int_equal(sscanf(out, "%d %d %d", &counted[0], &counted[1], &counted[2]), 3);
    assert_int_equal(shell("for f in history curve; do head -1 $f.tsv | awk -F '\\t' "
                           "'{print NF}'; done"),
                     0);
    assert_int_equal(sscanf(out, "%d %d", &wanted[0], &wanted[1]), 2);
    assert_int_equal(counted[0], wanted[0]);
    assert_int_equal(counted[1], wanted[1]);
    assert_int_equal(counted[2], 6);
}

TEST(gnuplot_opens_all)
{
    IN_TURN(2, 3);
    skip_without("gnuplot --version", "gnuplot");
    check_lines("{ echo 'set terminal unknown'; cat lines; } | gnuplot 2>&1 | tail -1", "gnuplot",
                0);
    assert_int_equal(shell("echo \"set terminal unknown; set key autotitle columnhead; "
                           "plot 'study.tsv' using 'mu':'max_pressure_MPa'\" | gnuplot"),
                     0);
}

/* One form: names first, as many cells in every row, no NaN but "NaN". */
TEST(all_have_one_form)
{
    assert_int_equal(shell("for f in *.tsv; do awk -F '\\t' -v f=$f '/^#/ {next} !n {n = NF} "
                           "NF != n {print f \": \" $0; bad = 1} "
                           "FNR == 1 && /^#/ {bad = 1} END {exit bad}' $f || exit 1; done; "
                           "! grep -w -e nan -e inf *.tsv; grep -q 'no-solution' files.tsv && "
                           "test $(ls *.tsv | wc -l) = 15 && ! grep -q '^#' *.csv"),
                     0);
}

RUN_TESTS(set_up, leave_folder)
