/* Typical mistakes: one line each, with the words that help; and the first minute:
 * examples, notes, a terminal. */
#include "cli_run.h"
#include "base/base.h"

static const struct {
    const char *arguments, *wanted;
} mistakes[] = {
    {"--vary 'mu 0.1 0.2'", "did you mean '--vary-1'"},
    {"sweep --vary 'mu 0.1 0.2'", "did you mean '--vary-1'"},
    {"curve --mu 0.1 0.2", "by commas, as --mu 0.1,0.2"},
    {"--mu 0.1 0.2", "by commas, as --mu 0.1,0.2"},
    {"--mu 0.1,0.2", "a curve takes several"},
    {"-mu 0.3", "options start with --, as --mu"},
    {"-creep=0.1", "options start with --, as --creep)"},
    {"-zorro=0.1", "options start with --; --help lists them)"},
    {"-o table.tsv", "as --output"},
    {"-q", "as --quiet)"},
    {"--conductivity 40 --temperature 20C", "in one of K; got '20C'\n"},
    {"--tolerance rad=1%", "did you mean 'radius'"},
    {"design --minimise max_pressure --over rad=20:60", "did you mean 'radius'"},
    {"--E 210000", "did you mean '--young'"},
    {"--nu 0.3", "did you mean '--poisson'"},
    {"--friction 0.3", "did you mean '--mu'"},
    {"--creepage 0.01", "did you mean '--creep'"},
    {"--steady", "did you mean '--formulation steady'"},
    {"--halfplane", "did you mean '--support halfplane'"},
    {"--csv", "did you mean '--format csv'"},
    {"--elements 50", "did you mean '--contact-elements'"},
    {"--radus 460", "did you mean '--radius'"},
    {"--support half-plane", "arc, hub or halfplane"},
    {"--formulation rolling", "static, steady or transient"},
    {"--mu abc", "expected a number >= 0, got 'abc'"},
    {"--mu -0.3", "expected a number >= 0, got '-0.3'"},
    {"--poisson 0.6", "0.5"},
    {"--mu", "expected a number >= 0, got nothing"},
    {"--young 210GPA", "did you mean 'GPa'"},
    {"--young 210 GPa", "--young: write 210GPa without a blank, or '210 GPa' in quotes"},
    {"--load 100 kN/m case.ini", "--load: write 100kN/m without a blank"},
    {"--conductivity 50 W/mK", "--conductivity: write 50W/mK without a blank"},
    {"curve --over speed --from 1 m/s", "'m/s' is no case file: write a unit behind its number"},
    {"--radius 18inchs", "did you mean 'inch'"},
    {"--layer-thickness 1,2", "one layer on its base; several: --layers FILE"},
    {"--similar --layer-thickness-b 1,2,3", "one layer on its base; several: --layers FILE"},
    {"--cover-thickness 1,2", "a stack of covers is not modelled"},
    {"--load 100kN", "a number in one of N/mm, N/m"},
    {"--load 100 --approach 1", "exclude each other"},
    {"--formulation steady --shift 1", "shift"},
    {"--formulation transient --creep 0.001", "--distance or --history"},
    {"--young-b 70000 --similar", "exclude each other"},
    {"--poisson-b 0.3", "body B is rigid without --similar or --young-b"},
    {"--support halfplane --layer-thickness 1 --base-poisson 0.3", "rigid without --base-young"},
    {"--support hub --cover-thickness 1 --core-poisson 0.3", "is rigid without --core-young"},
    {"--arc 30 --support hub", "it needs the support arc"},
    {"--plot picture.jpg", ".png, .svg, .pdf, .eps or .tex"},
    {"--plot", "expected a name, got nothing"},
    {"--output nowhere/table.tsv", "nowhere/table.tsv"},
    {"cas.ini", "No such file"},
    {"curv", "did you mean 'curve'"},
    {"wheel", "it is no command either (`rollbem help` lists them)"},
    {"result.json", "result.json: expected a case file of lines 'key = value', got JSON"},
    {"made-up.ini", "unknown section 'study'; the sections are body-a, body-b, gap, friction,"},
    {"solve --mu 0.3", "rollbem [OPTION...] [CASE.ini] solves"},
    {"run hash.ini", "rollbem [OPTION...] [CASE.ini] solves"},
    {"hash.ini", "a comment after a value begins with ';', got '460 # comment'"},
    {"typo.ini", "unknown key 'crep' (did you mean 'creep'"},
    {"section.ini", "belongs to section"},
    {"--gap one.txt --load 10", "one.txt:1: expected 2 numbers, got 1"},
    {"--example rial", "did you mean 'rail'"},
    {"--example rail good.ini", "--example rail and the case file 'good.ini': one of them"},
    {"curve --creep 0.001", "a curve varies it from --from"},
    {"curve --from 1 --to 1", "expected two different values"},
    {"sweep", "a study needs --vary-1 or --cases"},
    {"lcp", "expected at least one FILE"},
    {"--mu 0,3", "expected one number, with a decimal point, got 0 and 3; a curve takes several"},
    {"example wheel", "expected bar, truss, wall or a name"},
    {"--units metric", "mm, si or inch"},
};

TEST(forty_mistakes_get_a_line_that_helps)
{
    int wrong = 0;
    write_file("hash.ini", "radius = 460 # comment\n");
    write_file("good.ini", "mu = 0.2\n");
    write_file("typo.ini", "crep = 0.001\n");
    write_file("section.ini", "[friction]\nradius = 460\n");
    write_file("made-up.ini", "[study]\nmu = 0.2\n");
    write_file("result.json", "{\n  \"schema\": 1\n}\n");
    write_file("one.txt", "1\n2\n3\n");
    assert_true(sizeof mistakes / sizeof *mistakes >= 40);
    for (size_t k = 0; k < sizeof mistakes / sizeof *mistakes; k++) {
        if (!is_in_turn((int)k, 8))
            continue;
        char first[200];
        const char *wanted = mistakes[k].wanted, *other = strchr(wanted, '|');
        const int code = rollbem(mistakes[k].arguments);
        snprintf(first, sizeof first, "%.*s", (int)strcspn(wanted, "|"), wanted);
        const size_t n = strlen(err);
        if ((!strstr(err, first) && !(other && strstr(err, other + 1))) || code < 64 || n == 0 ||
            strchr(err, '\n') != err + n - 1 || out[0]) {
            print_error("rollbem %s (%d): %s", mistakes[k].arguments, code, err);
            wrong++;
        }
    }
    assert_int_equal(wrong, 0);
}

/* Of the commands' own options too a case file's line is named, and another code. */
TEST(own_options_in_a_file_are_refused_with_their_line)
{
#define HALFPLANES "support = halfplane\nsimilar = yes\nload = 100\n\n"
    static const struct {
        const char *command, *text, *said; /* text: from line 5 on */
    } all[] = {
        {"crack", "mu = 0\ncrack-angle = 180\n", "own.ini:6: crack-angle: expected more than 0"},
        {"crack", "to = 2\nfrom = 5\n", "own.ini:6: from: A rolls towards +x"},
        {"crack", "closing = located\n", "own.ini:5: closing: located only for --fluid"},
        {"crack", "unloaded = yes\n", "own.ini:5: unloaded: needs --remote-stress"},
        {"crack", "threshold = 1\n", "own.ini:5: threshold: of a crack that grows"},
        {"crack", "states = yes\n", "own.ini:5: states: with --json"},
        {"crack", "[body-b]\nlayer-thickness-b = 1\nbase-young-b = 10\nbase-poisson-b = 0.3\n",
         "own.ini:6: layer-thickness-b: below a crack"},
        {"wear", "wear-coefficient = 1e-9\nslide = 1\ncycles = 3\n",
         "own.ini:7: cycles: not together with --slide"},
        {"fit creep.tsv", "fit = mou\n", "own.ini:5: fit: 'mou' is not a number"},
        {"fit creep.tsv", "fit = mu\nstart = mu\n", "own.ini:6: start: expected NAME=X"},
        {"fit creep.tsv", "fit = mu\nbounds = mu=2:1\n", "own.ini:6: bounds: expected NAME=A:B"},
        {"fit creep.tsv", "fit = mu\nstart = mu=0.5\nbounds = mu=0.1:0.2\n",
         "own.ini:6: start: mu = 0.5 is not within"},
        {"", "tolerance = mou=1\n", "own.ini:5: tolerance: 'mou' is not a number"},
        {"", "derivatives = mou\n", "own.ini:5: derivatives: expected a result that has"},
        {"", "error = yes\n[output]\nprove = yes\n", "own.ini:7: prove: not together with error"},
        {"curve", "from = 1\nto = 1\n", "own.ini:6: to: expected two different values"},
        {"stress", "grid = 9\n", "own.ini:5: grid: expected two numbers >= 2"},
        {"stress", "grid = 9x9\npoints = at.txt\n", "own.ini:6: points: not together with --grid"},
        {"design", "minimise = max_pressure\nover = mou=1:2\n", "own.ini:6: over: 'mou' is not"},
        {"design", "over = radius=1:200\nminimise = pressure\n", "own.ini:6: minimise: expected"},
        {"design", "minimise = max_pressure\nover = radius=1:200\nsubject = contact<=3\n",
         "own.ini:7: subject: expected a result that has derivatives"},
        {"sweep", "vary-1 = mou 1 2\n", "own.ini:5: vary-1: 'mou' is not an option"},
        {"sweep", "vary-1 = mu 0.1 0.2\nresults = pressure\n", "own.ini:6: results: no result"},
        {"sweep", "vary-1 = mu 0.1 0.2\nshow = stick\n", "own.ini:6: show: there is no picture"},
        /* options of a command that stand behind those of its case, in their group */
        {"crack", "[output]\nstates = yes\n", "own.ini:6: key 'states' belongs to section [crack]"},
        {"crack", "[crack]\nstates = yes\n", "own.ini:6: states: with --json"},
    };
    write_file("creep.tsv", "creep\tforce\n0.001\t-3\n0.002\t-5\n");
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        char text[300], arguments[60];
        snprintf(text, sizeof text, HALFPLANES "%s", all[k].text);
        write_file("own.ini", text);
        snprintf(arguments, sizeof arguments, "%s own.ini", all[k].command);
        check_refused(arguments, 65, all[k].said);
    }
    /* what the rooms below refuse, which know no options */
    static const struct {
        const char *text, *said;
    } wheels[] = {
        {"zone = 60\n", "wheel.ini:2: zone: "},
        {"outer-elements = 4\n", "wheel.ini:2: outer-elements: "},
        {"support = hub\nhub-ratio = 0.99\nzone = 45\nouter-elements = 12\n",
         "wheel.ini:5: outer-elements: "},
        {"support = hub\ncover-thickness = 49\ncore-young = 1000\n",
         "wheel.ini:3: cover-thickness: hub of radius 15"},
    };
    for (size_t k = 0; k < sizeof wheels / sizeof *wheels; k++) {
        char text[300];
        snprintf(text, sizeof text, "load = 100\n%s", wheels[k].text);
        write_file("wheel.ini", text);
        check_refused("wheel.ini", 65, wheels[k].said);
    }
}

/* What every command refuses: the exit code, and one line. */
TEST(refusals_have_their_code_and_reason)
{
    static const struct {
        int code;
        const char *arguments, *said;
    } all[] = {
        {64, "b.ini --relaxation-time 0.1,1 --relaxation-ratio 1 --speed 10",
         "--relaxation-time: expected as many numbers as --relaxation-ratio has, 1, got 2"},
        {64, "b.ini --friction-law exponential --mu-fall 0.1,0.2 --slip-scale 1 --speed 1",
         "--mu-fall: expected as many numbers as --slip-scale has, 1, got 2"},
        {64,
         "b.ini --friction-law exponential --mu-fall 0.1 --slip-scale 1 --speed 1 --memory 1,2,3",
         "--memory: expected 1 or 2 numbers, got 3"},
        {64, "b.ini --friction-law exponential", "needs --mu-fall and --slip-scale"},
        {64, "b.ini --mu-fall 0.1 --slip-scale 1", "only for velocity-dependent friction"},
        {64, "b.ini --mu-heat 0.1,2", "--mu-heat: expected 3 numbers, got 2"},
        {66, "b.ini --friction-law nothing.txt", "nothing.txt: No such file"},
        {64, "b.ini --relaxation-time 1s,2 --relaxation-ratio 1,1 --speed 1",
         "expected a unit for each number or for none"},
        {64, "b.ini --hub-ratio 2", "expected a number in (0, 1), got '2'"},
        {64, "b.ini --contact-elements 1", "expected a whole number in [3, 16777216], got '1'"},
        {64, "b.ini --contact-elements 3.5", "got '3.5'"},
        {64, "b.ini --plot-script p.gp", "got 0"},
        {65, "size.ini", "size.ini:3: plot-size: there is no picture; --plot FILE asks for one"},
        {65, "design size.ini --minimise max_pressure", "size.ini:3: unknown key 'plot-size'"},
        {64, "design b.ini --plot p.svg", "unknown option '--plot'"},
        {64, "b.ini --tolerance mou=0.1",
         "'mou' is not a number of this case (did you mean 'mu'?)"},
        {64, "b.ini --tolerance mu=inf", "mu: expected a standard deviation >= 0"},
        {65, "si.ini --units mm", "si.ini:4: tolerance: its numbers are in the units of the file"},
        {65, "sweep si.ini --units mm --vary-1 'mu 0.1 0.2'", "si.ini:4: tolerance: its numbers"},
        {65, "arc.ini", "arc.ini:2: arc: it needs the support arc"},
        {64, "help --nothing", "nothing about '--nothing'"},
        {64, "b.ini --friction-law exponential --mu-fall 1,2,3 --slip-scale 1,2,3 --speed 1",
         "--mu-fall: expected 1 or 2 numbers, got 3"},
        {64, "sweep s.ini --results nothing,contact", "no result 'nothing'"},
        {73, "sweep s.ini --quiet --output /dev/full", "/dev/full: cannot write: No space left"},
        {64, "sweep v.ini --vary-1 'creep 0.1 0.2'",
         "creep and v.ini:4: creep-ratio exclude each other"},
        {64, "sweep w.ini --vary-1 'creep-ratio 0.1 0.2'",
         "w.ini:4: creep and creep-ratio exclude each other"},
        {65, "every.ini", "every.ini:2: every: for --formulation transient, --history"},
        {65, "script.ini", "script.ini:3: plot-script: expected one picture (such as --plot FILE)"},
        {66, "''", ": No such file"},
        {64, "--an-option-of-a-name-that-is-longer-than-any-other-name 3",
         "--an-option-of-a-name-that-is-longer-than"},
        {64, "solve b.ini", "there is no command 'solve'"},
        {64, "run b.ini", "there is no command 'run'"},
        {64, "b.ini s.ini", "one case file at a time, got 'b.ini' and 's.ini'"},
        {66, "compare nothing.dat", "nothing.dat: No such file"},
        {64, "help friction lcp", "nothing about 'friction lcp'"},
        {64, "sweep s.ini --results a_result_of_a_name_that_is_longer_than_any_heading_is",
         "--results: no result 'a_result_of_a_name"},
        {64, "sweep s.ini --map p.svg --vary-2 'mu 0.1'",
         "a map needs two options with two values or more"},
        {64, "sweep b.ini --map p.svg --cases just.txt", "--map: no option varies"},
        {64, "contact", "FILE.inp"},
        {64, "prony", "prony: expected one FILE, got 0 files"},
        {64, "example", "example: expected one of bar, truss, wall"},
        {64, "compare", "compare: expected at least one FILE"},
        {64, "compare one.txt --solvers nsn-ac,nsn-ac", "'nsn-ac' is given twice"},
        {64, "compare one.txt --solvers nsn-ac,", "no friction solver is called ''"},
        {64, "friction", "FILE"},
        {64,
         "b.ini --plot-script p.gp --plot p.svg --history-plot q.svg --formulation "
         "transient --distance 1",
         "expected one picture (such as --plot FILE), got 2"},
        {64, "b.ini --plot-size slide", "there is no picture; --plot FILE asks for one"},
        {64, "b.ini --all-solutions", "only for steady rolling without error bars"},
        {64,
         "b.ini --all-solutions --trace --formulation steady --creep-ratio 0.5 "
         "--friction-law linear --mu-fall .1 --slip-scale 1 --speed 1",
         "not together with --dump, --fclib, --trace"},
        {64,
         "b.ini --all-solutions --formulation steady --creep-ratio 0.5 --friction-law "
         "linear --mu-fall .1 --slip-scale 1 --speed 1 --dump d",
         "not together with --dump, --fclib, --trace"},
        {64,
         "b.ini --all-solutions --formulation steady --creep-ratio 0.5 --friction-law "
         "linear --mu-fall .1 --slip-scale 1 --speed 1 --fclib f.hdf5",
         "not together with --dump, --fclib, --trace"},
        {64,
         "b.ini --all-solutions --formulation steady --friction-law linear --mu-fall .1 "
         "--slip-scale 1 --speed 1 --force 1",
         "at a given creepage, not under a given force"},
        {64,
         "b.ini --all-solutions --formulation steady --friction-law linear --mu-fall .1 "
         "--slip-scale 1 --speed 1 --force-ratio 0.1",
         "at a given creepage, not under a given force"},
        {64,
         "b.ini --all-solutions --formulation steady --friction-law linear --mu-fall .1 "
         "--slip-scale 1 --speed 1 --free-axle",
         "at a given creepage, not under a given force"},
        {64,
         "b.ini --all-solutions --formulation steady --creep-ratio 0.5 --friction-law "
         "linear --mu-fall .1 --slip-scale 1 --speed 1 --error",
         "only for steady rolling without error bars"},
        {64, "b.ini --all-solutions --formulation steady --creep-ratio 0.5",
         "only for steady rolling without error bars"},
        {64,
         "b.ini --all-solutions --shift 0.001 --memory 1 --friction-law linear --mu-fall .1 "
         "--slip-scale 1 --speed 1",
         "only for steady rolling"},
        {64, "b.ini --shift 0.001 --error --dump d", ": not together with error bars"},
        {64, "b.ini --shift 0.001 --error --fclib f.hdf5", ": not together with error bars"},
        {64, "b.ini --shift 0.001 --error --trace", ": not together with error bars"},
        {64, "b.ini --shift 0.001 --accuracy 0.1 --trace", "not together with error bars"},
        {64, "b.ini --shift 0.001 --trace --solver newton", "--trace: only --solver lemke pivots"},
        {64, "b.ini --formulation transient --distance 0.3 --steps 2 --states",
         "--states: with --json and in mm, N, MPa only"},
        {64, "b.ini --formulation transient --distance 0.3 --steps 2 --states --json --units si",
         "--states: with --json and in mm, N, MPa only"},
        {73, "b.ini --output .", ".: cannot write: Is a directory"},
        {73, "b.ini --dump b.ini", "b.ini: cannot write: Not a directory"},
        {73, "b.ini --snapshots b.ini --formulation transient --distance 0.3",
         "b.ini: cannot write: Not a directory"},
        {73, "b.ini --plot /nothing/p.svg", "/nothing/p.svg: cannot write"},
        {73, "b.ini --fclib /nothing/f.hdf5", "/nothing/f.hdf5: cannot write"},
        {64, "--describe=nothing", "expected man, markdown, results or schema, got 'nothing'"},
        {64, "--completion=tcsh", "expected bash, zsh or fish, got 'tcsh'"},
        {64, "help xyzzy", "help: nothing about 'xyzzy'"},
        {64, "examples more", "examples: unexpected 'more'"},
        {64, "verify more", "verify: unexpected 'more'"},
        {66, "check nothing", "nothing: No such file"},
        {64, "check", "expected a file that"},
        {65, "check b.ini", "expected the JSON of a result, or a table with its comments"},
        {65, "check list.json", "no object"},
        {65, "check cut.json", "cut.json:2: expected the JSON of a result"},
        {64, "curve b.ini --mu 0 --plot p.svg", "--plot: no curve to draw at mu = 0"},
        {64, "curve b.ini --mu 0.1,x", "expected a number >= 0, got '0.1,x'"},
        {65, "curve list.ini", "list.ini:1"},
        {64, "wear b.ini --slide 1", "wear needs --wear-coefficient"},
        {64, "wear b.ini --wear-coefficient 1", "wear needs --slide or --cycles"},
        {64, "wear b.ini --wear-coefficient 1 --slide 1 --cycles 1",
         "--cycles: not together with --slide"},
        {64, "wear b.ini --wear-coefficient 1e-7 --slide 1 --formulation steady --creep-ratio 0.5",
         "--slide needs --formulation static"},
        {64,
         "wear b.ini --wear-coefficient 1e-7 --cycles 1 --formulation steady "
         "--creep-ratio 0.5 --profile w.tsv",
         "--profile"},
        {64, "stress b.ini --grid 3x1", "expected two numbers >= 2 such as 61x41"},
        {64, "stress b.ini --grid 1x3", "expected two numbers >= 2 such as 61x41"},
        {64, "stress b.ini --grid 3x3x3", "expected two numbers >= 2 such as 61x41"},
        {64, "stress b.ini --grid 3", "such as 61x41, 1e8 points in all at most, got '3'"},
        {64, "stress b.ini --grid 100000x100000", "1e8 points in all at most, got '100000x100000'"},
        {64, "stress b.ini --grid 3x3 --points at.txt", "--points: not together with --grid"},
        {64, "stress b.ini --grid 3x3 --vtk v.txt",
         "expected a name ending in .vti or .vtu, got 'v.txt'"},
        {64, "stress b.ini --points at.txt --vtk v.vti",
         ".vti holds regular grids; for points use .vtu"},
        {64, "stress --grid 3x3 --load 100 --contact-elements 8 --vtk v.vti",
         "that of a wheel follows its surface"},
        {65, "stress b.ini --points one.txt", "one.txt:1: expected 2 numbers, got 1"},
        {65, "stress b.ini --points below.txt", "the point (0, -0.1) mm lies outside body A"},
        {64, "sweep b.ini", "a study needs --vary-1 or --cases"},
        {64, "sweep b.ini --show load --vary-1 'load 100 200'", "--show: there is no picture"},
        {64, "sweep b.ini --over load --vary-1 'load 100 200'", "--over: there is no picture"},
        {64, "sweep b.ini --family load --vary-1 'load 100 200'", "--family: there is no picture"},
        {64, "sweep s.ini --show nothing --plot p.svg", "--show: no result 'nothing'"},
        {64, "sweep s.ini --show load --plot p.svg", "load varies; expected a result"},
        {64, "sweep s.ini --results nothing", "--results: no result 'nothing'"},
        {64, "sweep s.ini --results error_tangential_load",
         "'error_tangential_load' needs --error"},
        {64, "sweep s.ini --error --results error_iterations", "iterations has no error bar"},
        {64, "sweep s.ini --plot p.svg --over young",
         "expected an option that varies, got 'young'"},
        {64, "sweep s.ini --plot p.svg --over load --family load",
         "expected another option that varies, got 'load'"},
        {64, "sweep b.ini --plot p.svg --vary-1 'mu 0.1' --vary-2 'creep-ratio 0.1 0.2' --over mu",
         "a curve needs two values of mu; creep-ratio = 0.1 has one"},
        {64, "sweep b.ini --map p.svg --vary-1 'support arc halfplane' --vary-2 'mu 0.1 0.2'",
         "a map needs two options with numbers, support has words"},
        {64, "sweep b.ini --plot p.svg --cases just.txt", "--plot: no option varies"},
        {64, "sweep b.ini --map p.svg --cases two.txt",
         "a map needs two options with two values or more"},
        {64, "sweep b.ini --map p.svg --cases holes.txt",
         "those with load = 200 are others than those with load = 100"},
        {64, "sweep b.ini --vary-1 'shape 1 2'", "'shape' is not an option of a case"},
        {64, "sweep b.ini --vary-1 'load 1 2' --vary-2 'load 3 4'", "'load' varies already"},
        {64, "sweep b.ini --vary-1 load",
         "expected an option and numbers, or first:last:count, got 'load'"},
        {64, "sweep b.ini --vary-1 'load 1:2:x'", "expected"},
        {64, "sweep b.ini --vary-1 'load 0:2:3:log'", "expected"},
        {64, "sweep b.ini --vary-1 'load 1:2:0'", "expected"},
        {64, "sweep b.ini --vary-1 'load 1parsec 2'", "parsec"},
        {64, "sweep b.ini --vary-1 'load 1:2:20000' --vary-2 'mu 0:1:20000'",
         "cases, expected at most 1e8"},
        {65, "sweep b.ini --cases names.txt", "names.txt: no numbers"},
        {65, "sweep b.ini --cases colour.txt",
         "'colour' is not an option of a case with a number as value"},
        {65, "sweep b.ini --cases layers.txt",
         "'layers' is not an option of a case with a number as value, or with words\n"},
        {65, "sweep b.ini --cases twice.txt", "column 'mu' is named twice"},
        {65, "sweep b.ini --cases negative.txt --vary-1 'load 1 2'",
         "negative.txt:5: mu: expected a number >= 0, got '-1'"},
        {64, "sweep b.ini --cases just.txt --vary-1 'contact-elements 8 3.5'",
         "case 2: contact-elements: expected a whole number in [3, 16777216], got '3.5'"},
        {65, "sweep b.ini --cases long.txt",
         "'abcdefghijklmnopqrstuvwxyzabcdefghijklmn' is not an option of a case"},
        {65, "sweep b.ini --cases unit.txt",
         "unit.txt: column 'load_foo': expected load in one of N/mm, N/m,"},
        {64, "sweep b.ini --vary-1 ' '", "expected an option and numbers, got ' '"},
        {64, "sweep b.ini --vary-1 'load 1:2:3:lin'", "got 'load 1:2:3:lin'"},
        {64, "sweep b.ini --vary-1 'load 1:2'", "got 'load 1:2'"},
        {64, "sweep b.ini --vary-1 'load x:2:3'", "got 'load x:2:3'"},
        {64, "sweep b.ini --vary-1 'load 1:x:3'", "got 'load 1:x:3'"},
        {64, "sweep b.ini --vary-1 'load 1:2:1'", "got 'load 1:2:1'"},
        {64, "sweep b.ini --vary-1 'load 1:2:2.5'", "got 'load 1:2:2.5'"},
        {64, "sweep b.ini --vary-1 'load 1:2:1e8'", "got 'load 1:2:1e8'"},
        {64, "sweep b.ini --vary-1 'load 1:0:3:log'", "got 'load 1:0:3:log'"},
        {64, "sweep b.ini --vary-1 'load 1:2:3 4'", "got 'load 1:2:3 4'"},
        {64, "sweep b.ini --vary-1 'load 1 x'", "got 'load 1 x'"},
        {64, "sweep b.ini --vary-1 'contact-elements 8 x'", "got 'contact-elements"},
        {65, "sweep b.ini --cases one.txt", "expected a line that names the columns"},
        {73, "sweep s.ini --output /nothing/w.tsv", "/nothing/w.tsv: cannot write"},
        {73, "sweep s.ini --output .", ".: cannot write: Is a directory"},
        {65, "page b.ini --page b.ini --output p.html", "expected the page of `make page`"},
        {66, "page b.ini --page nothing.html --output p.html", "nothing.html"},
        {64, "lcp game.txt --q game.txt --game", "--q"},
        {66, "lcp nothing.txt --output t.tsv", "nothing.txt: No such file"},
        {64, "lcp", "lcp: expected at least one FILE"},
        {64, "lcp one.txt one.txt --q one.txt", "lcp: --q goes with one FILE, got 2"},
        {64, "lcp one.txt --solver newton --trace", "not with --solver newton"},
        {64, "lcp one.txt --solver newton --cover one.txt", "not with --solver newton"},
        {64, "lcp one.txt --solver newton --rule first-index", "not with --solver newton"},
        {64, "lcp one.txt --trace --solution", "are two tables: one of them"},
        {64, "lcp one.txt --all --trace", "--all tries every basis"},
        {64, "lcp one.txt --all --start one.txt", "--all tries every basis"},
        {64, "lcp one.txt --all --solver lemke", "--all tries every basis"},
        {64, "lcp one.txt --all --max-pivots 3", "--all tries every basis"},
        {64, "lcp game.txt --game --lower one.txt", "--game reads A and B alone"},
        {64, "lcp game.txt --game --upper one.txt", "--game reads A and B alone"},
        {64, "lcp game.txt --game --start one.txt", "--game reads A and B alone"},
        {64, "lcp game.txt --game --cover one.txt", "--game reads A and B alone"},
        {64, "lcp game.txt --game --q one.txt", "--game reads A and B alone"},
        {64, "lcp game.txt --game --solver lemke", "--game reads A and B alone"},
        {64, "lcp game.txt --game --rule first-index", "--game reads A and B alone"},
        {64, "lcp game.txt --label 1", "only with --game and without --all"},
        {64, "lcp game.txt --game --all --label 1", "only with --game and without --all"},
        {65, "lcp colour.txt --output t.tsv", "colour.txt:1: n: expected an integer >= 0"},
        {65, "lcp cut.json --output t.tsv", "cut.json:1: expected numbers as text, got JSON"},
        {65, "friction cut.json --output t.tsv", "cut.json:1: expected numbers as text, got JSON"},
        {64, "compare --solvers nothing one.txt", "no friction solver is called 'nothing'"},
        {65, "friction one.txt --output t.tsv",
         "one.txt:4: size at the head: expected an integer >= 0"},
        {64, "friction one.txt --solver nothing", "no friction solver is called 'nothing'"},
        {65, "contact b.ini", "no line such as '3 MODULE': not an input file of CONTACT"},
        {66, "contact nothing.inp", "nothing.inp: No such file"},
        {64, "example tower", "a name that `rollbem examples` lists, got 'tower'"},
        {64, "example truss --plot p.xyz",
         "expected a name ending in .png, .svg, .pdf, .eps or .tex (of a history also .gif), got "
         "'p.xyz'"},
        {64, "example truss --nodes 2 --solver lemke", "lemke solves problems in 2D only"},
        {73, "example wall --mesh coarse --output b.ini", "b.ini: cannot write: Not a directory"},
        {73, "example truss --nodes 2 --output /nothing/t.tsv", "/nothing/t.tsv: cannot write"},
    };
    write_file("b.ini", "support = halfplane\nload = 100\ncontact-elements = 8\nzone = 1\n");
    write_file("s.ini", "support = halfplane\nload = 100\ncontact-elements = 12\nzone = 1\n"
                        "formulation = steady\n[sweep]\nvary-1 = load 100 200\n"
                        "vary-2 = creep-ratio 0 0.5\n");
    write_file("arc.ini", "support = halfplane\narc = 30\nload = 100\n");
    write_file("v.ini", "formulation = steady\nsupport = halfplane\nload = 100\n"
                        "creep-ratio = 0.1\n");
    write_file("w.ini", "formulation = steady\nsupport = halfplane\nload = 100\n"
                        "creep = 0.1\n");
    write_file("every.ini", "load = 100\nevery = 2\n");
    write_file("si.ini", "units = si\nsupport = halfplane\nload = 100000\ntolerance = load=1000\n");
    write_file("size.ini", "load = 100\n[output]\nplot-size = slide\n");
    write_file("script.ini", "load = 100\n[output]\nplot-script = p.gp\n");
    write_file("list.json", "[1]\n");
    write_file("cut.json", "{\"schema\": \n");
    write_file("list.ini", "mu = 0.1,x\n");
    write_file("one.txt", "1\n2\n3\n");
    write_file("at.txt", "0 0.1\n");
    write_file("below.txt", "0 -0.1\n");
    write_file("two.txt", "creep-ratio mu\n0.2 0.1\n0.5 0.3\n");
    write_file("just.txt", "mu\n0.1\n");
    write_file("holes.txt", "load mu\n100 0.1\n100 0.2\n200 0.1\n");
    write_file("names.txt", "mu\n");
    write_file("colour.txt", "colour\n1\n");
    write_file("layers.txt", "layers\ncoating.csv\n");
    write_file("twice.txt", "mu mu\n1 2\n");
    write_file("negative.txt", "mu\n0.1\n# a comment\n\n-1\n");
    write_file("long.txt", "abcdefghijklmnopqrstuvwxyzabcdefghijklmn\n1\n");
    write_file("unit.txt", "mu load_foo\n0.1 1\n");
    write_file("game.txt", "2 2\n1 2\n3 4\n1 2\n3 4\n");
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        if (is_in_turn((int)k, 8))
            check_refused(all[k].arguments, all[k].code, all[k].said);
}

/* What is no error, and perhaps not what was meant. */
TEST(doubtful_values_are_noted)
{
    static const char *const all[][2] = {
        {"", "far beyond linear elasticity"},
        {"--mu 0.3 --creep 0.1", "does not change the tractions"},
        {"--example rail", "rolls at creepage 0"},
        {"--example rail --creep 0.4", "meant in per cent, write --creep"},
        {"--arc 0.5", "in radians, write --arc"},
        {"--example rail --radius 0.46", "far beyond linear elasticity"}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        rollbem(all[k][0]);
        const char *note = strstr(err, all[k][1]), *summary = strstr(err, "  load ");
        if (!note || !summary)
            fail_msg("rollbem %s: %s", all[k][0], err);
        assert_true(note < summary); /* before the numbers */
        const char *line_of_table = strstr(out, all[k][1]);
        assert_non_null(line_of_table);
        rollbemf("%s --json --quiet", all[k][0]);
        assert_string_equal(err, "");
        held_json *root = json_loads(out, 0, NULL);
        int found = 0;
        size_t i;
        json_t *text;
        json_array_foreach(json_object_get(root, "notes"), i, text) found |=
            strstr(json_string_value(text), all[k][1]) != NULL;
        assert_true(found);
    }
}

/* A creepage that the program found is not what somebody typed. */
TEST(found_creepage_is_not_doubted)
{
    assert_int_equal(rollbem("--formulation steady --support hub --mu 1e-3 --free-axle "
                             "--approach 0.04 --contact-elements 40"),
                     0);
    assert_null(strstr(err, "meant in per cent"));
}

TEST(examples_are_at_hand)
{
    CHECK_RUN(rollbem("examples"), 0, out, "--example rail ");
    assert_non_null(strstr(out, "--example paper "));
    json_t *root = run_json("--example rail --creep-ratio 0.4");
    CHECK_REL(number_in(json_object_get(root, "summary"), "force_ratio"), -0.64, 1e-4, "Carter");
    json_decref(root);
    root = run_json("curve --example rail --points 3");
    json_decref(root);
    assert_int_equal(rollbem("sweep --example rail --vary-1 'mu 0.1 0.2' --quiet"), 0);
    assert_int_equal(rollbem("-h"), 0);
    assert_ptr_equal(strstr(out, "Usage: rollbem"), out);
    check_refused("examples rail", 64, "examples: unexpected 'rail'");
    check_refused("wear --support halfplane --load 9 --slide 9 --wear-coefficient 1e-9 --every 2",
                  64, "--every: only with --snapshots");
    check_refused("wear --support halfplane --load 9 --slide 9 --wear-coefficient 1e-9 --quarter 2",
                  64, "--quarter: only with --cycles");
    check_refused("wear --support halfplane --load 9 --formulation steady --creep-ratio 0.5 "
                  "--cycles 9 --wear-coefficient 1e-9 --quarter 2",
                  64, "--quarter: of fretting");
    check_refused("--support halfplane --load 9 --increments 2 --every 2", 64,
                  "--every: only with --snapshots");
    check_refused("stress --support halfplane --load 9 --fringe 3", 64,
                  "--fringe: only with --fringes");
    check_refused("stress --support halfplane --plane stress --shakedown-map m.svg", 64,
                  "--shakedown-map: its limits are those of plane strain");
}

/* On a terminal: the summary, then a short table; whoever asks for a form gets it. */
TEST(terminals_get_a_short_table)
{
    if (shell("command -v script") != 0)
        skip();
    assert_int_equal(shell("script -qec \"'$R' --example rail --creep-ratio 0.4\" typescript"), 0);
    const char *summary = strstr(out, "  load "), *table = strstr(out, "  zone");
    assert_non_null(summary);
    assert_non_null(table);
    assert_true(summary < table);
    assert_null(strstr(out, "# rollbem"));
    int lines = 0;
    for (const char *c = out; *c; c++)
        lines += *c == '\n';
    assert_true(lines <= 24);
    assert_int_equal(shell("script -qec \"'$R' --example rail --format tsv\" typescript"), 0);
    assert_non_null(strstr(out, "# rollbem"));
    /* a pager that does not start loses nothing */
    static const char *const pagers[] = {"no-such-pager", "/", "cat"};
    for (size_t k = 0; k < sizeof pagers / sizeof *pagers; k++) {
        assert_int_equal(shellf("PAGER=%s script -qec \"'$R' help rolling\" typescript", pagers[k]),
                         0);
        assert_non_null(strstr(out, "free rolling"));
    }
}

/* Help on a terminal: the command's own options, then common ones without their groups. */
TEST(terminals_get_short_help)
{
    static const struct {
        const char *command, *group;
    } all[] = {{"curve", "[curve]"}, {"sweep", "[sweep]"}, {"wear", "[wear]"}};
    if (shell("command -v script") != 0)
        skip();
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        assert_int_equal(
            shellf("PAGER=cat script -qec \"'$R' %s --help\" typescript", all[k].command), 0);
        const char *own = strstr(out, all[k].group), *common = strstr(out, "The most used options");
        assert_non_null(own);
        assert_non_null(common);
        assert_true(own < common);
        static const char *const shared[] = {"  --mu X", "  --example NAME"};
        for (size_t j = 0; j < sizeof shared / sizeof *shared; j++)
            assert_non_null(strstr(common, shared[j]));
        assert_null(strstr(out, "[example]"));
        assert_null(strstr(out, "[output]"));
    }
}

/* Who waits is told after two seconds what for; the line is taken away, and neither
 * --quiet nor a pipe has one.  The program is stopped as soon as it listens to its timer, until the
 * timer has gone off: it is seconds that count, not work. */
TEST(waiting_is_told_on_a_terminal)
{
#define ALARM ".*[2367abef][0-9a-f]\\{3\\}$' /proc/$p/status" /* bit 13 of a mask of signals */
    static const char slowly[] =
        "\"$R\" stress --support hub --half-width 1 --grid 120x120 --output /dev/null$quiet & "
        "p=$!; exec 2>/dev/null; "
        "until ! grep -q '^State:.[^Z]' /proc/$p/status; do "
        "if grep -q '^SigCgt:" ALARM "; then : >\"listens$quiet\"; kill -STOP $p; "
        "for k in $(seq 200); do grep -q '^ShdPnd:" ALARM " && break; sleep 0.05; done; "
        "kill -CONT $p; break; fi; sleep 0.02; done; "
        "wait $p";
    if (shell("command -v script") != 0)
        skip();
    write_file("slowly", slowly);
    assert_int_equal(shell("export R; quiet= script -qec '. ./slowly' told & "
                           "quiet=' --quiet' script -qec '. ./slowly' not-told; wait $!"),
                     0);
    assert_int_equal(access("listens", F_OK), 0);
    slurp("told", out, sizeof out);
    const char *told = NOT_NULL(strstr(out, " s: "));
    assert_non_null(strstr(told, "\r\033[K"));
    assert_int_not_equal(access("listens --quiet", F_OK), 0);
    slurp("not-told", out, sizeof out);
    assert_null(strstr(out, " s: "));
    assert_int_equal(shell("\"$R\" --half-width 0.1"), 0);
    assert_null(strstr(err, "processor"));
#undef ALARM
}

/* Characters, not bytes, and none of the sequences that set a colour. */
static int characters(const char *line, size_t n)
{
    int count = 0;
    for (size_t k = 0; k < n; k++) {
        if (line[k] == '\033')
            while (k < n && line[k] != 'm')
                k++;
        else
            count += line[k] != '\r' && ((unsigned char)line[k] & 0xc0) != 0x80;
    }
    return count;
}

/* Every command on a terminal of 80 x 24: no line is wider, and a table with its summary
 * needs little more than the window. */
TEST(no_command_is_wider_than_a_terminal)
{
    static const struct {
        const char *command;
        int lines; /* at most; 0: any */
    } cases[] = {
        {"", 24},
        {"--example rail --creep-ratio 0.4", 24},
        {"curve --half-width 0.05 --support halfplane --poisson 0.5 --points 30", 24},
        {"stress --example rail --creep-ratio 0.4", 30},
        {"wear --support halfplane --half-width 0.5 --slide 1e6 --wear-coefficient 1e-10", 24},
        {"crack --similar --support halfplane --half-width 1 --mu 0", 24},
        {"sweep --example rail --vary-1 'mu 0.1 0.2 0.3'", 24},
        {"example truss", 24},
        {"friction $EXAMPLES/friction/block.dat", 24},
        {"lcp $EXAMPLES/lcp/two.txt", 24},
        {"help temperature", 0},
        {"help", 0},
        {"examples", 0},
        {"--help", 0},
        {"--help=all", 0}};
    if (shell("command -v script") != 0)
        skip();
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char line[700];
        if (!is_in_turn((int)k, 8))
            continue;
        snprintf(line, sizeof line,
                 "EXAMPLES='%s/examples'; PAGER=cat script -qec \"stty rows 24 cols 80; "
                 "'$R' %s\" typescript",
                 getenv("PWD"), cases[k].command);
        assert_int_equal(shell(line), 0);
        int lines = 0;
        for (const char *at = out, *end; (end = strchr(at, '\n')) != NULL; at = end + 1) {
            CHECK_MAX((double)characters(at, (size_t)(end - at)), 80.0, "rollbem %s: %.*s",
                      cases[k].command, (int)(end - at), at);
            lines++;
        }
        if (lines < 3)
            fail_msg("rollbem %s: %s", cases[k].command, out);
        if (cases[k].lines)
            CHECK_MAX((double)lines, (double)cases[k].lines, "rollbem %s", cases[k].command);
    }
    assert_int_equal(shell("NO_COLOR=1 script -qec \"'$R'\" typescript"), 0);
    assert_null(strchr(out, '\033'));
    assert_int_equal(shell("\"$R\" --color=always 2>&1 >/dev/null | grep -c note"), 0);
}

/* | head: no message. */
TEST(closed_pipes_end_in_silence)
{
    static const char *const commands[] = {
        "--help", "--contact-elements 3000 --support halfplane --mu 0 --quiet", "help mesh",
        "examples", "--help=all"};
    for (size_t k = 0; k < sizeof commands / sizeof *commands; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        assert_int_equal(shellf("\"$R\" %s | head -n 1", commands[k]), 0);
        assert_string_equal(err, "");
    }
}

RUN_TESTS(enter_folder, leave_folder)
