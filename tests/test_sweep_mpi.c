/* Parameter studies under mpirun; skipped where there is no Open MPI. */
#include "cli_run.h"

static const char study[] = "support = halfplane\nformulation = steady\n"
                            "[normal]\nload = 500\n[mesh]\ncontact-elements = 30\n"
                            "[sweep]\noutput = study.tsv\nvary-1 = zone 0.001 1\n"
                            "vary-2 = creep-ratio 0:1.5:400\n";

/* Three processes on however few processors; leaks are those of Open MPI. */
#define MPIRUN                                                                                     \
    "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "                                   \
    "ASAN_OPTIONS=detect_leaks=0 mpirun --oversubscribe -n 3 "

static char whole[400000], got[400000];

static void need_mpi(void)
{
    if (shell("test -x \"$R-mpi\" && command -v mpirun") != 0)
        skip();
}

/* On this machine alone; the cases of the small zone fail. */
static void solve_alone(void)
{
    write_file("study.ini", study);
    if (whole[0])
        return;
    assert_int_equal(rollbem("sweep study.ini --quiet"), 1);
    slurp("study.tsv", whole, sizeof whole);
}

static void check_study(void)
{
    slurp("study.tsv", got, sizeof got);
    assert_string_equal(got, whole);
}

TEST(writes_what_one_machine_writes)
{
    need_mpi();
    solve_alone();
    assert_int_equal(shell("rm study.tsv; " MPIRUN "\"$R\" sweep study.ini --quiet"), 1);
    check_study();
}

TEST(goes_on_after_a_process_was_killed)
{
    need_mpi();
    solve_alone();
    write_file("rank", "echo $$ >pid$OMPI_COMM_WORLD_RANK\n"
                       "exec \"$1\" sweep study.ini --quiet\n");
    assert_int_equal(shell("rm -f study.tsv; " MPIRUN "sh rank \"$R\" & "
                           "until [ -s study.tsv ] || ! kill -0 $!; do sleep 0.02; done; "
                           "kill -9 $(cat pid2); wait $!"),
                     128 + 9);
    assert_int_equal(rollbem("sweep study.ini --quiet"), 1);
    check_study();
}

TEST(says_once_what_is_wrong)
{
    need_mpi();
    solve_alone();
    assert_int_equal(shell(MPIRUN "-quiet \"$R\" sweep study.ini --load -1"), 64);
    const char *line = NOT_NULL(strstr(err, "rollbem: --load: expected"));
    assert_null(strstr(line + 1, "rollbem: "));
    assert_string_equal(out, "");
}

TEST(another_study_on_one_of_them_is_refused)
{
    need_mpi();
    solve_alone();
    write_file("rank", "exec \"$1\" sweep study.ini --output other.tsv "
                       "--mu 0.1$OMPI_COMM_WORLD_RANK\n");
    CHECK_RUN(shell(MPIRUN "-quiet sh rank \"$R\""), 65, err, "rollbem: process 1 on ");
    assert_non_null(strstr(err, "reads another study"));
}

/* Several processes that do not know of each other would write the same file. */
TEST(a_build_without_mpi_says_so)
{
    solve_alone();
    assert_int_equal(shell("cp \"$R\" alone; OMPI_COMM_WORLD_SIZE=3 ./alone sweep study.ini"), 70);
    assert_non_null(strstr(err, "built without Open MPI"));
    /* finished before: its exit code stays that of a study with failures */
    assert_int_equal(shell("OMPI_COMM_WORLD_SIZE=1 ./alone sweep study.ini --quiet"), 1);
}

RUN_TESTS(enter_folder, leave_folder)
