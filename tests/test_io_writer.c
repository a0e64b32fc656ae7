/* Output files appear whole or not at all. */
#define _GNU_SOURCE
#include "check.h"
#include "failing_call.h"
#include "base/io/io.h"

#include <dirent.h>
#include <signal.h>

static char folder[64], path[128];

static int make_folder(void **state)
{
    strcpy(folder, "/tmp/rollbem_test_XXXXXX");
    if (!mkdtemp(folder))
        return -1;
    snprintf(path, sizeof path, "%s/out", folder);
    return 0;
}

static int remove_folder(void **state)
{
    unlink(path);
    return rmdir(folder); /* fails when a temporary file was left behind */
}

static int entries(void)
{
    DIR *d = opendir(folder);
    int n = -2; /* . and .. */
    while (readdir(d))
        n++;
    closedir(d);
    return n;
}

static const char *content(void)
{
    static char text[64];
    FILE *f = NOT_NULL(fopen(path, "r"));
    text[fread(text, 1, sizeof text - 1, f)] = 0;
    fclose(f);
    return text;
}

static void write_line(const char *line)
{
    rb_io_writer w;
    CHECK_OK(rb_io_writer_open(path, &w, NULL));
    fputs(line, w.file);
    CHECK_OK(rb_io_writer_commit(&w, NULL));
}

TEST_WITH(make_folder, remove_folder, the_target_appears_on_commit)
{
    rb_io_writer w;
    CHECK_OK(rb_io_writer_open(path, &w, NULL));
    fputs("hello", w.file);
    assert_int_not_equal(access(path, F_OK), 0);
    CHECK_OK(rb_io_writer_commit(&w, NULL));
    assert_string_equal(content(), "hello");
    assert_int_equal(entries(), 1);
}

TEST_WITH(make_folder, remove_folder, abandoning_leaves_the_old_file)
{
    rb_io_writer w;
    write_line("old");
    CHECK_OK(rb_io_writer_open(path, &w, NULL));
    fputs("new", w.file);
    rb_io_writer_abandon(&w);
    rb_io_writer_abandon(&w);
    assert_string_equal(content(), "old");
    assert_int_equal(entries(), 1);
}

/* The lowest free descriptor tells how many are open. */
TEST_WITH(make_folder, remove_folder, no_descriptor_stays_open)
{
    const int before = dup(STDIN_FILENO);
    close(before);
    rb_io_writer w;
    CHECK_OK(rb_io_writer_open(path, &w, NULL));
    rb_io_writer_abandon(&w);
    write_line("whole");
    const int after = dup(STDIN_FILENO);
    close(after);
    assert_int_equal(before, after);
}

TEST_WITH(make_folder, remove_folder, an_old_file_keeps_its_mode_and_a_link_its_place)
{
    char link[160];
    struct stat st;
    snprintf(link, sizeof link, "%s/link", folder);
    write_line("old");
    chmod(path, 0640);
    assert_int_equal(symlink(path, link), 0);
    rb_io_writer w;
    CHECK_OK(rb_io_writer_open(link, &w, NULL));
    fputs("new", w.file);
    CHECK_OK(rb_io_writer_commit(&w, NULL));
    assert_string_equal(content(), "new");
    assert_int_equal(lstat(link, &st), 0);
    assert_true(S_ISLNK(st.st_mode));
    assert_int_equal(stat(path, &st), 0);
    assert_int_equal(st.st_mode & 0777, 0640);
    unlink(link);
}

/* The link stays; what it names appears. */
TEST_WITH(make_folder, remove_folder, a_link_to_a_file_yet_to_come_is_followed)
{
    char link[160];
    struct stat st;
    snprintf(link, sizeof link, "%s/link", folder);
    assert_int_equal(symlink("out", link), 0);
    rb_io_writer w;
    CHECK_OK(rb_io_writer_open(link, &w, NULL));
    fputs("new", w.file);
    CHECK_OK(rb_io_writer_commit(&w, NULL));
    assert_string_equal(content(), "new");
    assert_int_equal(lstat(link, &st), 0);
    assert_true(S_ISLNK(st.st_mode));
    unlink(link);
    assert_int_equal(symlink("link", link), 0); /* to itself */
    CHECK_STATUS(rb_io_writer_open(link, &w, NULL), RB_EWRITE);
    unlink(link);
}

TEST_WITH(make_folder, remove_folder, a_new_file_has_the_mode_that_the_umask_leaves)
{
    struct stat st;
    const mode_t before = umask(027);
    write_line("new");
    umask(before);
    assert_int_equal(stat(path, &st), 0);
    assert_int_equal(st.st_mode & 07777, 0640);
}

/* Temporary names must not be longer than the target's. */
TEST_WITH(make_folder, remove_folder, the_longest_name_is_taken)
{
    char name[400];
    rb_io_writer w;
    const int n = snprintf(name, sizeof name, "%s/", folder);
    memset(name + n, 'a', 255);
    name[n + 255] = '\0';
    CHECK_OK(rb_io_writer_open(name, &w, NULL));
    fputs("new", w.file);
    CHECK_OK(rb_io_writer_commit(&w, NULL));
    assert_int_equal(unlink(name), 0);
}

TEST_WITH(make_folder, remove_folder, a_program_that_is_killed_leaves_nothing)
{
    int status;
    const pid_t pid = fork();
    if (pid == 0) {
        rb_io_writer w;
        rb_io_writer_open(path, &w, NULL);
        fputs("half of it", w.file);
        fflush(w.file);
        raise(SIGKILL);
    }
    assert_int_equal(waitpid(pid, &status, 0), pid);
    assert_true(WIFSIGNALED(status));
    assert_int_equal(entries(), 0);
}

TEST_WITH(make_folder, remove_folder, checking_changes_nothing)
{
    CHECK_OK(rb_io_writer_check(path, NULL));
    assert_int_equal(entries(), 0);
    write_line("old");
    CHECK_OK(rb_io_writer_check(path, NULL));
    assert_string_equal(content(), "old");
    CHECK_STATUS(rb_io_writer_check(folder, NULL), RB_EWRITE);
    CHECK_OK(rb_io_writer_check("/dev/null", NULL));
}

TEST_WITH(make_folder, remove_folder, what_cannot_be_written_is_refused)
{
    rb_io_writer w;
    char inside[160];
    snprintf(inside, sizeof inside, "%s/no/such", folder);
    CHECK_SAYS(rb_io_writer_open(inside, &w, &message), RB_EWRITE, inside);
    CHECK_STATUS(rb_io_writer_open(folder, &w, &message), RB_EWRITE);
    assert_int_equal(entries(), 0);
}

TEST(a_full_device_is_noticed)
{
    rb_io_writer w;
    if (access("/dev/full", W_OK) != 0)
        skip();
    CHECK_OK(rb_io_writer_open("/dev/full", &w, &message));
    fputs("lost", w.file);
    CHECK_STATUS(rb_io_writer_commit(&w, &message), RB_EWRITE);
    assert_true(strlen(message.text) > 0);
}

TEST(stdout_is_not_closed)
{
    rb_io_writer w;
    CHECK_OK(rb_io_writer_open("-", &w, NULL));
    assert_ptr_equal(w.file, stdout);
    CHECK_OK(rb_io_writer_commit(&w, NULL));
    CHECK_OK(rb_io_writer_open(NULL, &w, NULL));
    rb_io_writer_abandon(&w);
    assert_true(printf("# stdout is still open\n") > 0);
}

TEST_WITH(make_folder, remove_folder, short_memory_is_reported)
{
    for (int i = 0;; i++) {
        rb_io_writer w;
        alloc_fail_after(i);
        const rb_status s = rb_io_writer_open(path, &w, NULL);
        const int refused = alloc_failed();
        alloc_succeed();
        if (s == RB_OK) {
            rb_io_writer_abandon(&w);
            if (!refused)
                break;
        } else {
            CHECK_STATUS(s, RB_ENOMEM);
        }
        assert_int_equal(entries(), 0);
    }
}

/* With a link on the way, a device, and a folder that is asked about. */
TEST_WITH(make_folder, remove_folder, short_memory_is_reported_on_every_way)
{
    char link[160], below[160];
    snprintf(link, sizeof link, "%s/link", folder);
    snprintf(below, sizeof below, "%s/below", folder);
    assert_int_equal(symlink("out", link), 0);
    const char *const names[] = {link, "/dev/null", below};
    for (int k = 0; k < 3; k++)
        for (int i = 0, refused = 1; refused; i++) {
            rb_message why = {.text = ""};
            alloc_fail_after(i);
            const rb_status s =
                k < 2 ? rb_io_writer_check(names[k], &why) : rb_io_folder_check(names[k], &why);
            rb_io_writer w = {0};
            const rb_status opened = k == 1 ? rb_io_writer_open(names[k], &w, &why) : RB_OK;
            refused = alloc_failed();
            alloc_succeed();
            rb_io_writer_abandon(&w);
            if (s != RB_OK || opened != RB_OK) {
                CHECK_STATUS(s != RB_OK ? s : opened, RB_ENOMEM);
                assert_non_null(strstr(why.text, "out of memory"));
            }
        }
    unlink(link);
}

/* Whatever fails between opening and the new name: the reason is told, the old file stays
 * as it was, and nothing lies beside it. */
TEST_WITH(make_folder, remove_folder, every_call_that_fails_leaves_the_old_file)
{
    static const struct {
        const char *first, *call;
        int error, opened; /* 1: the call is made on commit */
    } all[] = {{NULL, "access", EACCES, 0},     {NULL, "O_TMPFILE", ENOSPC, 0},
               {NULL, "fchmod", EPERM, 0},      {NULL, "fdopen", EMFILE, 0},
               {"O_TMPFILE", "open", EROFS, 0}, {NULL, "fclose", EIO, 1},
               {NULL, "rename", EXDEV, 1},      {"linkat", "open", EDQUOT, 1},
               {"linkat", "fchmod", EPERM, 1},  {"linkat", "lseek", EIO, 1},
               {"linkat", "read", EIO, 1},      {"linkat", "write", ENOSPC, 1},
               {"linkat", "close", EDQUOT, 1},  {"linkat", "rename", EXDEV, 1}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        rb_io_writer w;
        rb_message why = {.text = ""};
        rb_status s = RB_OK;
        write_line("old");
        if (all[k].first)
            fail_call(all[k].first, EOPNOTSUPP, EVERY_CALL);
        if (!all[k].opened)
            fail_call(all[k].call, all[k].error, 1);
        s = rb_io_writer_open(path, &w, &why);
        if (all[k].opened) {
            CHECK_OK(s);
            fputs("new", w.file);
            fail_call(all[k].call, all[k].error, 1);
            s = rb_io_writer_commit(&w, &why);
        }
        if (!calls_succeed() || s != RB_EWRITE || !strstr(why.text, path) ||
            !strstr(why.text, strerror(all[k].error)))
            fail_msg("%s: status %d, '%s'", all[k].call, s, why.text);
        assert_null(w.file);
        assert_string_equal(content(), "old");
        assert_int_equal(entries(), 1);
    }
}

/* Where the file system has no nameless files, or gives them no name: the same file. */
TEST_WITH(make_folder, remove_folder, files_are_written_without_the_help_of_the_system)
{
    static const struct {
        const char *call;
        int error;
    } all[] = {
        {"O_TMPFILE", EOPNOTSUPP}, {"O_TMPFILE", EISDIR}, {"O_TMPFILE", EINVAL}, {"linkat", EPERM}};
    enum { LONG = 100000 }; /* several buffers */
    static char text[LONG + 1], got[LONG + 1];
    struct stat st;
    for (int i = 0; i < LONG; i++)
        text[i] = (char)('a' + i % 23);
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        write_line("old");
        chmod(path, 0604);
        fail_call(all[k].call, all[k].error, EVERY_CALL);
        write_line(text);
        calls_succeed();
        FILE *f = fopen(path, "r");
        assert_int_equal(fread(got, 1, LONG + 1, f), LONG);
        fclose(f);
        assert_memory_equal(got, text, LONG);
        assert_int_equal(stat(path, &st), 0);
        assert_int_equal(st.st_mode & 07777, 0604);
        assert_int_equal(entries(), 1);
    }
}

/* A name that an interrupted run of the same number left behind is passed over. */
TEST_WITH(make_folder, remove_folder, names_in_use_are_passed_over)
{
    char used[2][160];
    for (int k = 0; k < 2; k++) {
        snprintf(used[k], sizeof used[k], "%s/.rollbem-%ld-%d", folder, (long)getpid(), k);
        FILE *f = fopen(used[k], "w");
        fputs("of another", f);
        fclose(f);
    }
    write_line("new");
    assert_string_equal(content(), "new");
    assert_int_equal(entries(), 3);
    for (int k = 0; k < 2; k++) {
        struct stat st;
        assert_int_equal(stat(used[k], &st), 0);
        assert_int_equal(st.st_size, (off_t)strlen("of another"));
        unlink(used[k]);
    }
}

/* The names of devices are told, and so is what became of what was buffered. */
TEST(devices_that_fail_are_named)
{
    rb_io_writer w;
    fail_call("access", EACCES, 1);
    CHECK_STATUS(rb_io_writer_check("/dev/null", &message), RB_EWRITE);
    assert_string_equal(message.text, "/dev/null: cannot write: Permission denied");
    assert_true(calls_succeed());
    CHECK_OK(rb_io_writer_open("/dev/null", &w, NULL));
    fail_call("fclose", EIO, 1);
    CHECK_STATUS(rb_io_writer_commit(&w, &message), RB_EWRITE);
    assert_string_equal(message.text, "/dev/null: cannot write: Input/output error");
    assert_true(calls_succeed());
    if (access("/dev/full", W_OK) != 0)
        skip();
    CHECK_OK(rb_io_writer_open("/dev/full", &w, NULL));
    fputs("lost", w.file);
    fflush(w.file); /* its reason is forgotten by the time of the commit */
    fail_call("fclose", EIO, 1);
    CHECK_STATUS(rb_io_writer_commit(&w, &message), RB_EWRITE);
    assert_string_equal(message.text, "/dev/full: cannot write: write error");
    calls_succeed();
}

/* A write has failed before the commit, which no longer knows why: one more write tells
 * the reason where it still holds. */
TEST_WITH(make_folder, remove_folder, a_reason_that_is_forgotten_is_asked_for_again)
{
    const int full = open("/dev/full", O_WRONLY);
    if (full < 0)
        skip();
    for (int still = 0; still < 2; still++) {
        rb_io_writer w;
        CHECK_OK(rb_io_writer_open(path, &w, NULL));
        const int own = dup(fileno(w.file));
        dup2(full, fileno(w.file));
        fputs("lost", w.file);
        assert_int_not_equal(fflush(w.file), 0);
        dup2(own, fileno(w.file));
        close(own);
        assert_true(ferror(w.file));
        if (still)
            fail_call("write", ENOSPC, 1);
        CHECK_STATUS(rb_io_writer_commit(&w, &message), RB_EWRITE);
        assert_true(calls_succeed());
        assert_non_null(strstr(message.text, still ? "No space left" : "write error"));
        assert_int_equal(entries(), 0);
    }
    close(full);
}

TEST_WITH(make_folder, remove_folder, folders_are_made_or_refused)
{
    char name[4][160], *joined;
    static const char *const below[] = {"below", "below///", "dangling", "no/such"};
    for (int k = 0; k < 4; k++)
        snprintf(name[k], sizeof name[k], "%s/%s", folder, below[k]);
    CHECK_OK(rb_io_folder_check(name[0], NULL));
    CHECK_OK(rb_io_folder_check(name[1], NULL));
    CHECK_OK(rb_io_folder_check("here-there-is-none", NULL));
    CHECK_SAYS(rb_io_folder_check(name[3], &message), RB_EWRITE,
               "no/such: cannot write: No such file");
    assert_int_equal(entries(), 0);
    CHECK_OK(rb_io_make_folder(name[0], NULL));
    CHECK_OK(rb_io_make_folder(name[0], NULL));
    CHECK_OK(rb_io_folder_check(name[0], NULL));
    fail_call("access", EACCES, 1);
    CHECK_SAYS(rb_io_folder_check(name[0], &message), RB_EWRITE,
               "below: cannot write: Permission denied");
    assert_true(calls_succeed());
    write_line("a file");
    CHECK_SAYS(rb_io_folder_check(path, &message), RB_EWRITE, "out: cannot write: Not a directory");
    CHECK_STATUS(rb_io_make_folder(path, &message), RB_EWRITE);
    assert_int_equal(symlink("nowhere", name[2]), 0);
    CHECK_SAYS(rb_io_make_folder(name[2], &message), RB_EWRITE, "dangling: cannot write: ");
    CHECK_STATUS(rb_io_make_folder(name[3], &message), RB_EWRITE);
    joined = rb_io_join("a", "b.txt");
    assert_string_equal(joined, "a/b.txt");
    free(joined);
    unlink(name[2]);
    rmdir(name[0]);
}

RUN_TESTS(NULL, NULL)
