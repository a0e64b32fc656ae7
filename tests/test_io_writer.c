/* Output files appear whole or not at all. */
#define _XOPEN_SOURCE 700
#include "check.h"
#include "rollbem/io.h"

#include <dirent.h>
#include <signal.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static char folder[64], path[128];

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/rollbem_test_XXXXXX");
    if (!mkdtemp(folder))
        return -1;
    snprintf(path, sizeof path, "%s/out", folder);
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
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
    FILE *f = fopen(path, "r");
    assert_non_null(f);
    text[fread(text, 1, sizeof text - 1, f)] = 0;
    fclose(f);
    return text;
}

static void write_line(const char *line)
{
    rb_io_writer w;
    CHECK_STATUS(rb_io_writer_open(path, &w, NULL), RB_OK);
    fputs(line, w.file);
    CHECK_STATUS(rb_io_writer_commit(&w, NULL), RB_OK);
}

static void the_target_appears_on_commit(void **state)
{
    (void)state;
    rb_io_writer w;
    CHECK_STATUS(rb_io_writer_open(path, &w, NULL), RB_OK);
    fputs("hello", w.file);
    assert_int_not_equal(access(path, F_OK), 0);
    CHECK_STATUS(rb_io_writer_commit(&w, NULL), RB_OK);
    assert_string_equal(content(), "hello");
    assert_int_equal(entries(), 1);
}

static void abandoning_leaves_the_old_file(void **state)
{
    (void)state;
    rb_io_writer w;
    write_line("old");
    CHECK_STATUS(rb_io_writer_open(path, &w, NULL), RB_OK);
    fputs("new", w.file);
    rb_io_writer_abandon(&w);
    rb_io_writer_abandon(&w);
    assert_string_equal(content(), "old");
    assert_int_equal(entries(), 1);
}

static void an_old_file_keeps_its_mode_and_a_link_its_place(void **state)
{
    (void)state;
    char link[160];
    struct stat st;
    snprintf(link, sizeof link, "%s/link", folder);
    write_line("old");
    chmod(path, 0640);
    assert_int_equal(symlink(path, link), 0);
    rb_io_writer w;
    CHECK_STATUS(rb_io_writer_open(link, &w, NULL), RB_OK);
    fputs("new", w.file);
    CHECK_STATUS(rb_io_writer_commit(&w, NULL), RB_OK);
    assert_string_equal(content(), "new");
    assert_int_equal(lstat(link, &st), 0);
    assert_true(S_ISLNK(st.st_mode));
    assert_int_equal(stat(path, &st), 0);
    assert_int_equal(st.st_mode & 0777, 0640);
    unlink(link);
}

/* The link stays; what it names appears. */
static void a_link_to_a_file_yet_to_come_is_followed(void **state)
{
    (void)state;
    char link[160];
    struct stat st;
    snprintf(link, sizeof link, "%s/link", folder);
    assert_int_equal(symlink("out", link), 0);
    rb_io_writer w;
    CHECK_STATUS(rb_io_writer_open(link, &w, NULL), RB_OK);
    fputs("new", w.file);
    CHECK_STATUS(rb_io_writer_commit(&w, NULL), RB_OK);
    assert_string_equal(content(), "new");
    assert_int_equal(lstat(link, &st), 0);
    assert_true(S_ISLNK(st.st_mode));
    unlink(link);
    assert_int_equal(symlink("link", link), 0); /* to itself */
    CHECK_STATUS(rb_io_writer_open(link, &w, NULL), RB_EWRITE);
    unlink(link);
}

static void a_new_file_has_the_mode_that_the_umask_leaves(void **state)
{
    (void)state;
    struct stat st;
    const mode_t before = umask(027);
    write_line("new");
    umask(before);
    assert_int_equal(stat(path, &st), 0);
    assert_int_equal(st.st_mode & 07777, 0640);
}

/* Temporary names must not be longer than the target's. */
static void the_longest_name_is_taken(void **state)
{
    (void)state;
    char name[400];
    rb_io_writer w;
    const int n = snprintf(name, sizeof name, "%s/", folder);
    memset(name + n, 'a', 255);
    name[n + 255] = '\0';
    CHECK_STATUS(rb_io_writer_open(name, &w, NULL), RB_OK);
    fputs("new", w.file);
    CHECK_STATUS(rb_io_writer_commit(&w, NULL), RB_OK);
    assert_int_equal(unlink(name), 0);
}

static void a_program_that_is_killed_leaves_nothing(void **state)
{
    (void)state;
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

static void checking_changes_nothing(void **state)
{
    (void)state;
    CHECK_STATUS(rb_io_writer_check(path, NULL), RB_OK);
    assert_int_equal(entries(), 0);
    write_line("old");
    CHECK_STATUS(rb_io_writer_check(path, NULL), RB_OK);
    assert_string_equal(content(), "old");
    CHECK_STATUS(rb_io_writer_check(folder, NULL), RB_EWRITE);
    CHECK_STATUS(rb_io_writer_check("/dev/null", NULL), RB_OK);
}

static void what_cannot_be_written_is_refused(void **state)
{
    (void)state;
    rb_io_writer w;
    rb_message why;
    char inside[160];
    snprintf(inside, sizeof inside, "%s/no/such", folder);
    CHECK_STATUS(rb_io_writer_open(inside, &w, &why), RB_EWRITE);
    assert_non_null(strstr(why.text, inside));
    CHECK_STATUS(rb_io_writer_open(folder, &w, &why), RB_EWRITE);
    assert_int_equal(entries(), 0);
}

static void a_full_device_is_noticed(void **state)
{
    (void)state;
    rb_io_writer w;
    rb_message why = {""};
    if (access("/dev/full", W_OK) != 0)
        skip();
    CHECK_STATUS(rb_io_writer_open("/dev/full", &w, &why), RB_OK);
    fputs("lost", w.file);
    CHECK_STATUS(rb_io_writer_commit(&w, &why), RB_EWRITE);
    assert_true(strlen(why.text) > 0);
}

static void stdout_is_not_closed(void **state)
{
    (void)state;
    rb_io_writer w;
    CHECK_STATUS(rb_io_writer_open("-", &w, NULL), RB_OK);
    assert_ptr_equal(w.file, stdout);
    CHECK_STATUS(rb_io_writer_commit(&w, NULL), RB_OK);
    CHECK_STATUS(rb_io_writer_open(NULL, &w, NULL), RB_OK);
    rb_io_writer_abandon(&w);
    assert_true(printf("# stdout is still open\n") > 0);
}

static void short_memory_is_reported(void **state)
{
    (void)state;
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

#define IN_FOLDER(f) cmocka_unit_test_setup_teardown(f, make_folder, remove_folder)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(the_target_appears_on_commit),
        IN_FOLDER(abandoning_leaves_the_old_file),
        IN_FOLDER(an_old_file_keeps_its_mode_and_a_link_its_place),
        IN_FOLDER(a_link_to_a_file_yet_to_come_is_followed),
        IN_FOLDER(a_new_file_has_the_mode_that_the_umask_leaves),
        IN_FOLDER(the_longest_name_is_taken),
        IN_FOLDER(a_program_that_is_killed_leaves_nothing),
        IN_FOLDER(checking_changes_nothing),
        IN_FOLDER(what_cannot_be_written_is_refused),
        cmocka_unit_test(a_full_device_is_noticed),
        cmocka_unit_test(stdout_is_not_closed),
        IN_FOLDER(short_memory_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
