/* The program's files: whole or not there, inputs never written over, nothing left behind
 * by a signal, memory and disks that end. */
#include "cli_run.h"

#include <dirent.h>
#include <signal.h>
#include <sys/stat.h>

#define CASE "--support halfplane --load 100 --contact-elements 24 --quiet "

static int is_there(const char *name)
{
    struct stat st;
    return lstat(name, &st) == 0;
}

/* Files in the folder, hidden ones too, apart from out and err. */
static int files(void)
{
    DIR *d = NOT_NULL(opendir("."));
    int n = -4; /* ., .., out, err */
    while (readdir(d))
        n++;
    closedir(d);
    return n;
}

static void clear(void)
{
    assert_int_equal(system("rm -rf ./* .r*; : >out; : >err"), 0);
}

/* ---- Inputs ------------------------------------------------------------------------ */

static const struct {
    const char *arguments, *part;
} clashes[] = {
    {"m.ini --output m.ini", "--output: 'm.ini' is an input"},
    {"m.ini --output ./m.ini", "--output: './m.ini' is an input"},
    {"m.ini --output link", "--output: 'link' is an input"},
    {"m.ini --history-table m.ini --history h.tsv", "--history-table: 'm.ini' is an input"},
    {"m.ini --history h.tsv --history-table h.tsv", "'h.tsv' is an input file (--history)"},
    {"m.ini --fclib m.ini", "--fclib: 'm.ini' is an input"},
    {CASE "--gap gap.tsv --output gap.tsv", "'gap.tsv' is an input file (--gap)"},
    {"m.ini --output same.svg --plot same.svg", "both would write 'same.svg'"},
    {"stress m.ini --points p.tsv --vtk p.tsv", "'p.tsv' is an input file (--points)"},
    {"curve m.ini --output m.ini", "--output: 'm.ini' is an input"},
    {"sweep m.ini --vary-1 'mu 0.1 0.2' --output m.ini", "--output: 'm.ini' is an input"},
    {"sweep m.ini --cases c.tsv --output c.tsv", "'c.tsv' is an input file (--cases)"},
    {"lcp m.ini --output m.ini", "--output: 'm.ini' is an input"},
    {"friction m.ini --output m.ini", "--output: 'm.ini' is an input"},
    {"compare m.ini --output m.ini", "--output: 'm.ini' is an input"},
};

TEST(inputs_are_not_written_over)
{
    write_file("m.ini", "support = halfplane\nload = 100\ncontact-elements = 24\n");
    write_file("gap.tsv", "-1 0.01\n0 0\n1 0.01\n");
    write_file("h.tsv", "load\n100\n");
    write_file("p.tsv", "0 0.1\n");
    write_file("c.tsv", "mu\n0.1\n");
    assert_int_equal(symlink("m.ini", "link"), 0);
    for (size_t k = 0; k < sizeof clashes / sizeof clashes[0]; k++)
        if (is_in_turn((int)k, 8))
            check_refused(clashes[k].arguments, 64, clashes[k].part);
    char text[200];
    slurp("m.ini", text, sizeof text);
    assert_non_null(strstr(text, "support = halfplane"));
    slurp("h.tsv", text, sizeof text);
    assert_string_equal(text, "load\n100\n");
    clear();
}

/* ---- What cannot be written -------------------------------------------------------- */

static const char *const unwritable[] = {
    CASE "--output /no/file",         CASE "--plot /no/file.svg",
    CASE "--fclib /no/file",          CASE "--dump /no/folder",
    "curve " CASE "--plot /no/a.svg", "stress " CASE "--vtk /no/a.vtu",
    "example bar --output /no/file",  "example wall --output /no/folder",
};

TEST(what_cannot_be_written_is_not_solved)
{
    for (size_t k = 0; k < sizeof unwritable / sizeof unwritable[0]; k++)
        if (is_in_turn((int)k, 4))
            check_refused(unwritable[k], 73, "cannot write: No such file or directory");
}

/* A limit of file sizes is what a full disk looks like. */
TEST(full_disks_leave_nothing)
{
    static const char *const lines[] = {CASE "--contact-elements 300 --output a.tsv",
                                        CASE "--fclib a.hdf5",
                                        CASE "--plot a.png",
                                        CASE "--plot a.tex",
                                        CASE "--increments 6 --history-plot a.gif",
                                        "stress " CASE "--grid 40x40 --fringes a.png",
                                        "stress " CASE "--grid 40x40 --vtk a.vtu"};
    clear();
    for (size_t k = 0; k < sizeof lines / sizeof lines[0]; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        char line[400];
        snprintf(line, sizeof line,
                 "(ulimit -f 8; \"$R\" %s | cat >/dev/null; exit ${PIPESTATUS[0]})", lines[k]);
        write_file("job", line);
        const int code = shell("bash -c \"R='$R'; $(cat job)\"");
        unlink("job");
        if (code != 73 || files() != 0)
            fail_msg("%s: exit %d, %d files, %s", lines[k], code, files(), err);
    }
}

/* Links, pipes and devices stay what they are; modes too. */
TEST(fclib_files_are_written_as_all_others)
{
    struct stat st;
    clear();
    write_file("real", "old");
    assert_int_equal(chmod("real", 0640), 0);
    assert_int_equal(symlink("real", "link"), 0);
    assert_int_equal(symlink("real", "new.part"), 0); /* was followed once */
    assert_int_equal(rollbem(CASE "--fclib new"), 0);
    char text[20];
    slurp("real", text, sizeof text);
    assert_string_equal(text, "old");
    assert_int_equal(rollbem(CASE "--fclib link"), 0);
    assert_int_equal(lstat("link", &st), 0);
    assert_true(S_ISLNK(st.st_mode));
    assert_int_equal(stat("real", &st), 0);
    assert_true(st.st_size > 1000 && (st.st_mode & 0777) == 0640);
    assert_int_equal(shell("mkfifo pipe; cat pipe >copy & \"$R\" " CASE
                           "--fclib pipe && wait && cmp copy new && test -p pipe"),
                     0);
    assert_int_equal(rollbem(CASE "--fclib /dev/full"), 73);
    assert_int_equal(stat("/dev/full", &st), 0);
    assert_true(S_ISCHR(st.st_mode));
    clear();
}

/* A dump of one case beside the matrices of another would be of neither. */
TEST(a_dump_replaces_the_one_before)
{
    clear();
    assert_int_equal(rollbem("--support hub --load 100 --contact-elements 12 --quiet --dump d "
                             "--trace --solver lemke"),
                     0);
    assert_true(is_there("d/H.mtx") && is_there("d/tableau_3.mtx"));
    write_file("d/mine.mtx", "mine");
    assert_int_equal(rollbem(CASE "--dump d"), 0);
    assert_true(is_there("d/M.mtx") && is_there("d/mine.mtx"));
    assert_false(is_there("d/H.mtx") || is_there("d/mesh.mtx"));
    assert_false(is_there("d/tableau_1.mtx") || is_there("d/basis_1.txt"));
    /* none rather than some */
    assert_int_equal(shell("bash -c 'ulimit -f 4; \"'\"$R\"'\" " CASE "--dump e | "
                           "cat >/dev/null; exit ${PIPESTATUS[0]}'"),
                     73);
    assert_false(is_there("e"));
    clear();
}

/* ---- Signals ----------------------------------------------------------------------- */

/* The signal comes once the run has used a tenth of a second of processor time: it is at
 * work then, however busy the machine is, and none of these ends so soon. */
TEST(signals_leave_nothing_behind)
{
    static const char *const jobs[] = {
        CASE "--support hub --contact-elements 1200 --error --output a.tsv",
        CASE "--formulation transient --distance 1e5 --creep 1e-3 --output a.tsv",
        "curve " CASE "--points 100000 --output a.tsv",
        "example wall --mesh medium --quiet",
    };
    clear();
    signal(SIGHUP, SIG_DFL); /* ignored where the tests were started by nohup */
    signal(SIGTERM, SIG_DFL);
    for (size_t k = 0; k < sizeof jobs / sizeof jobs[0]; k++)
        for (int s = 0; s < 2; s++) {
            char line[600];
            if (!is_in_turn(2 * (int)k + s, 4))
                continue;
            snprintf(line, sizeof line,
                     "\"$R\" %s >/dev/null & p=$!; used=0; for k in $(seq 1000); do "
                     "used=$(cut -d ' ' -f 14 /proc/$p/stat); [ $used -lt 10 ] || break; "
                     "sleep 0.02; done; kill -%s $p; wait $p",
                     jobs[k], s ? "HUP" : "TERM");
            const int code = shell(line);
            if (code == 0)
                print_error("%s: it came to its end\n", jobs[k]);
            assert_int_not_equal(code, 0);
            /* steps that were finished may be there, whole */
            const int steps = is_there("a.tsv") && strstr(err, "interrupted after step");
            if (files() != steps)
                fail_msg("%s: %d files, %s", jobs[k], files(), err);
            clear();
        }
}

/* ---- Descriptors and names --------------------------------------------------------- */

TEST(a_closed_output_matters_only_where_it_is_used)
{
    assert_int_equal(shell("\"$R\" " CASE "--output a.tsv >&-"), 0);
    assert_int_equal(shell("\"$R\" " CASE "--output b.tsv >&- 2>&- <&-"), 0);
    assert_int_equal(shell("cmp a.tsv b.tsv || diff a.tsv b.tsv | grep -c output"), 0);
    assert_int_equal(shell("\"$R\" " CASE ">&-"), 73);
    clear();
}

TEST(the_longest_names_are_taken)
{
    clear();
    assert_int_equal(shell("n() { printf \"$1%.0s\" $(seq $2); }; i=$(n i 251).ini; "
                           "printf 'load = 100\\n' >$i; \"$R\" $i " CASE
                           "--output $(n o 255) --plot $(n p 251).svg --fclib $(n f 255) "
                           "--dump $(n d 255)"),
                     0);
    assert_int_equal(files(), 5);
    assert_int_equal(shell("n() { printf \"$1%.0s\" $(seq $2); }; i=$(n i 251).ini; "
                           "printf 'bad = 100\\n' >$i; \"$R\" $i"),
                     65);
    assert_non_null(strstr(err, ".ini:1: unknown key 'bad'"));
    assert_int_equal(shell("\"$R\" " CASE "--output $(printf 'o%.0s' $(seq 256))"), 73);
    assert_non_null(strstr(err, "File name too long"));
    clear();
}

TEST(names_of_any_bytes_are_printed)
{
    clear();
    assert_int_equal(shell("n=$(printf 'a\\377b\\033.ini'); printf 'load = 1\\n' >\"$n\"; "
                           "\"$R\" \"$n\" " CASE "--json --output a.json"),
                     0);
    held_json *root = NOT_NULL(json_load_file("a.json", 0, NULL));
    assert_non_null(
        strstr(json_string_value(json_object_get(root, "command")), "a\\xffb\\x1b.ini"));
    assert_int_equal(shell("\"$R\" \"$(printf 'none\\377\\033')\""), 66);
    assert_non_null(strstr(err, "none\\xff\\x1b: No such file"));
    CHECK_RUN(shell("\"$R\" lcp --json \"$(printf 'none\\377')\""), 66, out, "\"none\\\\xff\"");
    clear();
}

/* ---- What is no text --------------------------------------------------------------- */

TEST(files_that_are_no_text_are_named)
{
    /* Tables are read in UTF-16 too. */
    static const struct {
        const char *words, *wide;
    } commands[] = {{"case", "case: UTF-16 text"},
                    {CASE "--gap case", "case: no numbers"},
                    {"--history case", "case: no numbers"},
                    {"sweep " CASE "--cases case", "case: no numbers"},
                    {"stress " CASE "--points case", "case: no numbers"}};
    clear();
    for (size_t k = 0; k < sizeof commands / sizeof commands[0]; k++) {
        assert_int_equal(shell("printf 'load\\n1\\0\\n' >case"), 0);
        check_refused(commands[k].words, 65, "case:2: a zero byte, expected text");
        assert_int_equal(shell("printf '\\377\\376l\\0o\\0' >case"), 0);
        check_refused(commands[k].words, 65, commands[k].wide);
    }
    CHECK_RUN(rollbem("lcp case"), 65, err, "case: UTF-16 text");
    assert_int_equal(shell("printf '\\357\\273\\277load = 100\\n' >case"), 0);
    assert_int_equal(rollbem("case " CASE), 0); /* the mark of some editors */
    clear();
}

/* ---- Memory ------------------------------------------------------------------------ */

/* OpenBLAS waits for ever for its buffer. */
TEST(a_limit_of_memory_is_said)
{
#if SANITIZED
    skip(); /* reserves terabytes */
#endif
    int said = 0;
    for (int megabytes = 100; megabytes <= 400; megabytes += 50) {
        char line[300];
        snprintf(line, sizeof line,
                 "ulimit -v %d; timeout 60 \"$R\" --support hub --contact-elements 200 --quiet",
                 1024 * megabytes);
        const int code = shell(line);
        if (code == 127) /* not even the libraries */
            continue;
        if (code != 0 && (code != 70 || !strstr(err, "out of memory")))
            print_error("%d MB: exit %d, %s\n", megabytes, code, err);
        assert_true(code == 0 || (code == 70 && strstr(err, "out of memory")));
        said += code == 70;
    }
    assert_true(said > 0);
}

RUN_TESTS(enter_folder, leave_folder)
