/* Every write, rename, close and allocation fails once, in eight jobs: the exit code is a
 * documented one, never a signal, and every file is whole or not there.  A part of them
 * in `make test`, all in `make test-all`. */
#include "cli_run.h"
#include "fault_call.h"

#include <dirent.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/stat.h>

extern char **environ;

static char preload[700]; /* what lets allocations fail */

/* Words apart by blanks, behind the program's name. */
typedef struct {
    const char *name, *arguments;
    int old;  /* 1: the files hold something before */
    int rows; /* 1: a study, whose rows reach the file as they come */
} job;

static const job jobs[] = {
    {"table", "--support hub --load 100 --contact-elements 12 --output t.tsv", 1, 0},
    {"JSON and picture", "case.ini --json --output t.json --plot p.svg", 0, 0},
    {"matrices", "case.ini --fclib f.hdf5 --dump d --trace", 1, 0},
    {"history",
     "case.ini --formulation transient --distance 0.5 --steps 3 --history-table h.tsv "
     "--snapshots s --quiet --output t.tsv",
     0, 0},
    {"curve", "curve case.ini --points 4 --json --output c.json", 0, 0},
    {"stress", "stress case.ini --grid 5x4 --vtk v.vtu --output s.tsv", 0, 0},
    {"study", "sweep study.ini --jobs 1 --output w.tsv", 0, 1},
    {"friction", "friction input.hdf5 --json --solution --output r.json", 0, 0},
};

enum { JOBS = sizeof jobs / sizeof jobs[0] };

static const char *const inputs[] = {"case.ini", "study.ini", "input.hdf5", "reference",
                                     "out",      "err",       "count",      NULL};

/* ---- Files ------------------------------------------------------------------------- */

static int is_input(const char *name)
{
    for (const char *const *input = inputs; *input; input++)
        if (strcmp(name, *input) == 0)
            return 1;
    return name[0] == '.' && (name[1] == '\0' || strcmp(name, "..") == 0);
}

typedef void each_file(const char *path, void *context);

/* All files of the folder and of the folders in it that a job has made. */
static void for_files(const char *in, each_file *each, void *context)
{
    DIR *d = opendir(in);
    struct stat st;
    char path[1200];
    assert_non_null(d);
    for (const struct dirent *e; (e = readdir(d)) != NULL;) {
        snprintf(path, sizeof path, "%.600s%s%.300s", strcmp(in, ".") ? in : "",
                 strcmp(in, ".") ? "/" : "", e->d_name);
        if (is_input(e->d_name) || stat(path, &st) != 0)
            continue;
        if (S_ISDIR(st.st_mode))
            for_files(path, each, context);
        else
            each(path, context);
    }
    closedir(d);
}

static void remove_file(const char *path, void *context)
{
    (void)context;
    assert_int_equal(unlink(path), 0);
}

static char *read_all(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    fseek(file, 0, SEEK_END);
    *size = (size_t)ftell(file);
    rewind(file);
    char *text = calloc(*size + 1, 1);
    assert_int_equal(fread(text, 1, *size, file), *size);
    fclose(file);
    return text;
}

/* Times are other ones in every run. */
static void drop_times(json_t *value)
{
    const char *key;
    json_t *member;
    void *next;
    size_t i;
    json_object_foreach_safe(value, next, key, member)
    {
        if (strcmp(key, "seconds") == 0)
            json_object_del(value, key);
        else
            drop_times(member);
    }
    json_array_foreach(value, i, member) drop_times(member);
}

static int same_json(const char *a, const char *b)
{
    json_t *x = json_loads(a, 0, NULL), *y = json_loads(b, 0, NULL);
    drop_times(x);
    drop_times(y);
    const int same = x && json_equal(x, y);
    json_decref(x);
    json_decref(y);
    return same;
}

/* The results of many files say of one that there was no memory for it. */
static int says_so(const char *text)
{
    json_t *root = json_loads(text, 0, NULL);
    const json_t *problem = json_array_get(json_object_get(root, "problems"), 0);
    const char *status = json_string_value(json_object_get(problem, "status"));
    const int said = status && strcmp(status, "out of memory") == 0;
    json_decref(root);
    return said;
}

typedef struct {
    const job *j;
    int code, files, bad;
} inspection;

/* Lines that the whole study has, and those of cases that found no memory. */
static int is_part_of_study(const char *text, const char *whole)
{
    const size_t n = strlen(text);
    char line[4000];
    for (size_t length; *text; text += length) {
        length = strcspn(text, "\n") + 1;
        snprintf(line, sizeof line, "%.*s", (int)length, text);
        if (text + length > text + n || (!strstr(whole, line) && !strstr(line, "\t-2\t")))
            return 0;
    }
    return 1;
}

static void inspect(const char *path, void *context)
{
    inspection *in = context;
    char name[1300];
    size_t size, wanted_size;
    snprintf(name, sizeof name, "reference/%.1200s", path);
    char *text = read_all(path, &size), *wanted = read_all(name, &wanted_size);
    int good = wanted && size == wanted_size && memcmp(text, wanted, size) == 0;
    if (!good && wanted && wanted[0] == '{')
        good = same_json(text, wanted);
    if (!good && in->code == 70)
        good = says_so(text);
    if (!good && in->code && in->j->old)
        good = strcmp(text, "old\n") == 0;
    if (!good && wanted && in->code && in->j->rows)
        good = is_part_of_study(text, wanted);
    if (!good)
        print_error("%s: %s, exit code %d: %zu bytes that are not the whole file\n",
                    in->j->name, path, in->code, size);
    in->bad += !good;
    in->files++;
    free(text);
    free(wanted);
}

/* ---- Runs -------------------------------------------------------------------------- */

static char words[1000], *arguments[40];

static void split(const job *j)
{
    int n = 0;
    snprintf(words, sizeof words, "%s", j->arguments);
    arguments[n++] = program;
    for (char *word = strtok(words, " "); word; word = strtok(NULL, " "))
        arguments[n++] = word;
    arguments[n] = NULL;
}

static void write_old(const char *path, void *context)
{
    (void)context;
    write_file(path + strlen("reference/"), "old\n");
}

static void prepare(const job *j)
{
    for_files(".", remove_file, NULL);
    if (j->old)
        for_files("reference", write_old, NULL);
}

/* Of an undisturbed run. */
static char *reference_out;
static int reference_files;

static void count_file(const char *path, void *context)
{
    (void)path;
    ++*(int *)context;
}

static void make_reference(const job *j)
{
    size_t size;
    char line[1200];
    assert_int_equal(shell("rm -rf reference d s; mkdir reference"), 0);
    prepare(&(job){0});
    snprintf(line, sizeof line, "%s", j->arguments);
    const int code = rollbem(line);
    if (code)
        print_error("%s: %s\n", j->name, err);
    assert_int_equal(code, 0);
    free(reference_out);
    reference_out = read_all("out", &size);
    reference_files = 0;
    for_files(".", count_file, &reference_files);
    assert_int_equal(
        shell("for f in *.* d s; do case $f in case.ini|study.ini|input.*) "
              ";; *) [ ! -e \"$f\" ] || cp -r \"$f\" reference;; esac; done"),
        0);
    split(j);
}

/* What came of it.  said: part of the line that goes with the code. */
static void judge(const job *j, const char *fault, int k, int status, int code,
                  const char *said)
{
    inspection in = {.j = j, .code = WIFEXITED(status) ? WEXITSTATUS(status) : -1};
    size_t size;
    for_files(".", inspect, &in);
    char *text = read_all("err", &size), *printed = read_all("out", &size);
    int good = in.bad == 0 && (in.code == 0 || in.code == code);
    if (in.code == 0) /* the fault did no harm */
        good = good && in.files == reference_files &&
               (strcmp(printed, reference_out) == 0 || same_json(printed, reference_out));
    else
        good = good && strstr(text, said);
    if (!good)
        print_error("%s: %s %d: status %x, %d of %d files, stderr: %s\n", j->name, fault,
                    k, (unsigned)status, in.files, reference_files, text);
    assert_true(good);
    free(text);
    free(printed);
}

/* All of n, or so many of them. */
static int stride(int n, int samples)
{
    return getenv("ROLLBEM_TEST_ALL") || n <= samples ? 1 : n / samples;
}

/* Calls of the loader, before the program has a word. */
static int loader_calls(fault_kind kind)
{
    char *const version[] = {program, "--version", NULL};
    int n;
    const int status = fault_run(version, "out", "err", kind, 0, &n);
    if (WIFEXITED(status) && WEXITSTATUS(status) == FAULT_UNTRACED)
        skip();
    return kind == FAULT_CLOSE ? n : 0;
}

static void fail_calls(fault_kind kind, const char *name, int samples)
{
    int n, tried = 0;
    setenv("ASAN_OPTIONS", "detect_leaks=0", 1); /* it does not like to be followed */
    const int before = loader_calls(kind);
    for (int i = 0; i < JOBS; i++) {
        make_reference(&jobs[i]);
        prepare(&jobs[i]);
        const int status = fault_run(arguments, "out", "err", kind, 0, &n);
        judge(&jobs[i], name, 0, status, 0, "");
        const int step = stride(n - before, samples);
        for (int k = before + 1 + i % step, seen; k <= n; k += step, tried++) {
            prepare(&jobs[i]);
            judge(&jobs[i], name, k, fault_run(arguments, "out", "err", kind, k, &seen),
                  73, "rollbem: ");
        }
    }
    unsetenv("ASAN_OPTIONS");
    print_message("# %s: %d faults\n", name, tried);
}

static void every_write(void **state)
{
    (void)state;
    fail_calls(FAULT_WRITE, "write", 25);
}

static void every_rename(void **state)
{
    (void)state;
    fail_calls(FAULT_RENAME, "rename", 10);
}

static void every_close(void **state)
{
    (void)state;
    fail_calls(FAULT_CLOSE, "close", 8);
}

/* ---- Allocations ------------------------------------------------------------------- */

static int run_preloaded(const char *variable, int k)
{
    char value[20];
    int status;
    pid_t pid;
    posix_spawn_file_actions_t files;
    snprintf(value, sizeof value, "%d", k);
    setenv("LD_PRELOAD", preload, 1);
    setenv(variable, value, 1);
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 1, "out", O_WRONLY | O_CREAT | O_TRUNC,
                                     0666);
    posix_spawn_file_actions_addopen(&files, 2, "err", O_WRONLY | O_CREAT | O_TRUNC,
                                     0666);
    assert_int_equal(posix_spawn(&pid, program, &files, NULL, arguments, environ), 0);
    posix_spawn_file_actions_destroy(&files);
    unsetenv(variable);
    unsetenv("LD_PRELOAD");
    assert_int_equal(waitpid(pid, &status, 0), pid);
    return status;
}

static int allocations(const job *j)
{
    size_t size;
    setenv("FAULT_COUNT", "count", 1);
    judge(j, "malloc", 0, run_preloaded("FAULT_MALLOC", 0), 0, "");
    unsetenv("FAULT_COUNT");
    char *text = read_all("count", &size);
    const int n = text ? atoi(text) : 0;
    assert_int_equal(unlink("count"), 0);
    free(text);
    return n;
}

static void fail_allocations(const char *variable, int samples)
{
    int tried = 0;
#if SANITIZED
    skip();
#endif
    if (access(preload, R_OK) != 0)
        skip();
    for (int i = 0; i < JOBS; i++) {
        make_reference(&jobs[i]);
        prepare(&jobs[i]);
        const int n = allocations(&jobs[i]), step = stride(n, samples);
        for (int k = 1 + i % step; k <= n; k += step, tried++) {
            prepare(&jobs[i]);
            judge(&jobs[i], variable, k, run_preloaded(variable, k), 70, "out of memory");
        }
    }
    print_message("# %s: %d faults\n", variable, tried);
}

static void every_allocation(void **state)
{
    (void)state;
    fail_allocations("FAULT_MALLOC", 30);
}

static void every_allocation_from_one_on(void **state)
{
    (void)state;
    fail_allocations("FAULT_FROM", 15);
}

/* A case, a study of three of them, and a friction problem. */
static int prepare_inputs(void **state)
{
    if (enter_folder(state) != 0)
        return -1;
    snprintf(preload, sizeof preload, "%.*s/tests/fault_malloc.so",
             (int)(strlen(program) - strlen("/rollbem")), program);
    write_file("case.ini", "support = halfplane\n[normal]\nload = 100\n[friction]\n"
                           "mu = 0.3\n[mesh]\ncontact-elements = 12\nzone = 0.5\n");
    write_file("study.ini",
               "support = halfplane\nload = 100\ncontact-elements = 12\n"
               "formulation = steady\n[sweep]\nvary-1 = creep-ratio 0:1:3\n");
    return rollbem("case.ini --quiet --fclib input.hdf5");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_write),
        cmocka_unit_test(every_rename),
        cmocka_unit_test(every_close),
        cmocka_unit_test(every_allocation),
        cmocka_unit_test(every_allocation_from_one_on),
    };
    return cmocka_run_group_tests(tests, prepare_inputs, leave_folder);
}
