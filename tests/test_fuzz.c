/* The files of tests/fuzz, and some changed copies of each, by every fuzz target of
 * tools/fuzz/, each in a process of its own.  make fuzz looks for more. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include "check.h"
#include "tools/fuzz/fuzz.h"

#include <dirent.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

enum { SIZE_MAX_BYTES = 1 << 16, SECONDS_MAX = 60 };

static char corpus[600];
static int *at_hand; /* which changed copy the child has come to */

static uint64_t next_random(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

/* Flips, overwrites, cuts out and doubles pieces. */
static size_t change(uint64_t *state, uint8_t *data, size_t size)
{
    for (int k = 1 + (int)(next_random(state) % 4); k > 0 && size > 0; k--) {
        const size_t at = next_random(state) % size;
        size_t length = 1 + next_random(state) % 8;
        if (length > size - at)
            length = size - at;
        switch (next_random(state) % 4) {
        case 0:
            data[at] ^= (uint8_t)(1u << next_random(state) % 8);
            break;
        case 1:
            data[at] = (uint8_t) "0-9.e\n\t#,=[]:+ni"[next_random(state) % 16];
            break;
        case 2:
            memmove(data + at, data + at + length, size - at - length);
            size -= length;
            break;
        default:
            if (size + length < SIZE_MAX_BYTES) {
                memmove(data + at + length, data + at, size - at);
                size += length;
            }
        }
    }
    return size;
}

static int copies(void)
{
    return getenv("ROLLBEM_TEST_ALL") ? 2000 : 25;
}

static void run_copies(const fuzz_target *t, const uint8_t *data, size_t size, int most)
{
    static uint8_t room[SIZE_MAX_BYTES];
    uint64_t state = 88172645463325252u;
    t->run(data, size);
    for (*at_hand = 1; *at_hand <= most; ++*at_hand) {
        memcpy(room, data, size);
        t->run(room, change(&state, room, size));
    }
}

/* The file, and so many changed copies. */
static void replay(const fuzz_target *t, const char *path, int most)
{
    static uint8_t data[SIZE_MAX_BYTES];
    int status;
    FILE *file = NOT_NULL(fopen(path, "rb"));
    const size_t size = fread(data, 1, sizeof data, file);
    fclose(file);
    *at_hand = 0;
    fflush(NULL);
    const pid_t pid = fork();
    if (pid == 0) {
        alarm(SECONDS_MAX);
        for (int k = 0; k < 4; k++) /* cmocka would go on with the next test */
            signal((int[]){SIGSEGV, SIGBUS, SIGFPE, SIGILL}[k], SIG_DFL);
        run_copies(t, data, size, most);
        _exit(0);
    }
    assert_int_equal(waitpid(pid, &status, 0), pid);
    if (status != 0)
        fail_msg("%s: changed copy %d ends with status %d", path, *at_hand, status);
}

static void every_file_is_taken_or_refused(void **state)
{
    const fuzz_target *t = *state;
    char name[700], path[1000];
    int n = 0;
    snprintf(name, sizeof name, "%s/%s", corpus, t->name);
    DIR *all = opendir(name);
    if (!all)
        fail_msg("%s has no files", name);
    for (const struct dirent *e; (e = readdir(all)) != NULL;) {
        if (e->d_name[0] == '.')
            continue;
        snprintf(path, sizeof path, "%s/%.200s", name, e->d_name);
        replay(t, path, is_in_turn(n, 2) ? copies() : 0);
        n++;
    }
    closedir(all);
    assert_true(n > 0);
}

int main(void)
{
    struct CMUnitTest tests[32];
    int n = 0, failed;
    char here[500];
    if (!getcwd(here, sizeof here) || fuzz_begin() != 0)
        return 1;
    snprintf(corpus, sizeof corpus, "%s/tests/fuzz", here);
    at_hand =
        mmap(NULL, sizeof *at_hand, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    for (const fuzz_target *t = fuzz_targets; t->run; t++)
        tests[n++] =
            (struct CMUnitTest){t->name, every_file_is_taken_or_refused, NULL, NULL, (void *)t};
    failed = _cmocka_run_group_tests("fuzz", tests, (size_t)n, NULL, NULL);
    fuzz_end();
    return failed;
}
