/* Runs the program in a folder of its own, as its users do.  B: the build directory,
 * default build. */
#ifndef ROLLBEM_TESTS_CLI_RUN_H
#define ROLLBEM_TESTS_CLI_RUN_H

#include "check.h"

#include <fcntl.h>
#include <jansson.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#define held_json HELD(json_t)
HELD_TYPE(json_t, json_decref)

static char program[600], folder[40] = "/tmp/rollbem-cli-XXXXXX";
static char out[4000000], err[20000];

static inline void slurp(const char *name, char *text, size_t size)
{
    FILE *file = NOT_NULL(fopen(name, "r"));
    text[fread(text, 1, size - 1, file)] = '\0';
    fclose(file);
}

static inline void write_file(const char *name, const char *text)
{
    FILE *file = NOT_NULL(fopen(name, "w"));
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

/* Splits a line into its words, in place, as a shell does; their number, or 0 where the line has
 * more of a shell's syntax than quotes around plain text. */
static inline int plain_words(char *line, char **word, int most)
{
    int count = 0;
    char *to = line, quote = 0;
    for (int within = 0;; line++) {
        const char c = *line;
        const char *syntax = quote == '\'' ? "" : quote ? "$`\\" : "|&;<>()$`\\*?[#~\n";
        if (c ? strchr(syntax, c) != NULL : quote)
            return 0;
        if (!within && c && c != ' ') {
            if (count == most)
                return 0;
            word[count++] = to;
            within = 1;
        }
        if (quote ? c == quote : c == '"' || c == '\'')
            quote = quote ? 0 : c;
        else if (quote || (c && c != ' '))
            *to++ = c;
        else if (within) {
            within = 0;
            if (!c)
                return *to = '\0', count;
            *to++ = '\0';
        } else if (!c)
            return count;
    }
}

/* The program alone, without a shell in between, which costs a tenth of a small case: the status of
 * waitpid, or -1 where the line wants a shell. */
static inline int without_shell(const char *line)
{
    extern char **environ;
    char copy[3000], *word[200] = {program};
    if (strncmp(line, "\"$R\" ", 5) != 0 || strlen(line) >= sizeof copy)
        return -1;
    strcpy(copy, line + 5);
    const int count = plain_words(copy, word + 1, 198);
    if (count == 0)
        return -1;
    posix_spawn_file_actions_t files;
    pid_t pid;
    int status;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 1, "out", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_addopen(&files, 2, "err", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    assert_int_equal(posix_spawn(&pid, program, &files, NULL, word, environ), 0);
    posix_spawn_file_actions_destroy(&files);
    assert_int_equal(waitpid(pid, &status, 0), pid);
    return status;
}

/* A shell line in the test's folder where $R is the program and $PROJECT the project's
 * root; stdout and stderr land in out and err.  The exit code. */
static inline int shell(const char *line)
{
    int status = without_shell(line);
    if (status == -1) {
        char command[4000];
        snprintf(command, sizeof command, "R='%s'; { %s ; } >out 2>err", program, line);
        status = system(command);
    }
    assert_true(WIFEXITED(status));
    slurp("out", out, sizeof out);
    slurp("err", err, sizeof err);
    return WEXITSTATUS(status);
}

static inline int rollbem(const char *arguments)
{
    char line[2500];
    snprintf(line, sizeof line, "\"$R\" %s", arguments);
    return shell(line);
}

/* The same, with a format. */
__attribute__((format(printf, 1, 2))) static inline int shellf(const char *format, ...)
{
    char line[3000];
    va_list args;
    va_start(args, format);
    vsnprintf(line, sizeof line, format, args);
    va_end(args);
    return shell(line);
}
#define rollbemf(...) shellf("\"$R\" " __VA_ARGS__)

/* The exit code of a run, and words in what it printed:
 * CHECK_RUN(rollbem("friction no"), 1, err, "no solution exists"). */
#define CHECK_RUN(run, code, printed, words)                                                       \
    do {                                                                                           \
        assert_int_equal(run, code);                                                               \
        if (!strstr(printed, words))                                                               \
            fail_msg("no '%s' in: %s", words, printed);                                            \
    } while (0)

/* Nothing on stdout, exactly one line on stderr, containing `part`. */
static inline void check_refused(const char *arguments, int code, const char *part)
{
    const int got = rollbem(arguments);
    const size_t n = strlen(err);
    if (got != code || strncmp(err, "rollbem: ", 9) != 0 || !strstr(err, part) ||
        strchr(err, '\n') != err + n - 1 || out[0])
        print_error("rollbem %s\nexit %d, want %d with '%s'; stderr: %s\n", arguments, got, code,
                    part, err);
    assert_int_equal(got, code);
    assert_int_equal(strncmp(err, "rollbem: ", 9), 0);
    assert_non_null(strstr(err, part));
    assert_null(strstr(err, "(null)"));
    assert_ptr_equal(strchr(err, '\n'), err + n - 1);
    assert_string_equal(out, "");
}

/* For a shell: waits until process $p, which is the program by now, catches a signal, by the last
 * digit of its mask, or has ended.  A shell's `&` makes the program ignore a signal that comes
 * before, and `sh -c` itself catches SIGINT: so does its copy until it becomes the program. */
#define WHEN_CAUGHT(digits)                                                                        \
    "until [ ! -e /proc/$p/status ] || grep -q '^State:.*Z' /proc/$p/status || "                   \
    "{ grep -q '^Name:.*rollbem' /proc/$p/status && "                                              \
    "grep -q 'SigCgt:.*[" digits "]$' /proc/$p/status; }; "                                        \
    "do sleep 0.01; done 2>/dev/null; "
#define INT_CAUGHT "2367abef" /* bit 1 */
#define HUP_CAUGHT "37bf"     /* bits 0 and 1: without nohup both are caught */

/* The JSON of a run that ends well. */
static inline json_t *run_json(const char *arguments)
{
    char line[1000];
    snprintf(line, sizeof line, "%s --json --quiet", arguments);
    const int code = rollbem(line);
    if (code)
        fail_msg("rollbem %s: %s", line, err);
    json_t *root = NOT_NULL(json_loads(out, 0, NULL));
    return root;
}

/* The same, with a format. */
__attribute__((format(printf, 1, 2))) static inline json_t *run_jsonf(const char *format, ...)
{
    char line[900];
    va_list args;
    va_start(args, format);
    vsnprintf(line, sizeof line, format, args);
    va_end(args);
    return run_json(line);
}

static inline double number_in(const json_t *object, const char *name)
{
    const json_t *value = json_object_get(object, name);
    return json_is_number(value) ? json_number_value(value) : NAN;
}

static inline double entry(const json_t *object, const char *list, size_t i)
{
    const json_t *value = json_array_get(json_object_get(object, list), i);
    return json_is_number(value) ? json_number_value(value) : NAN;
}

static inline int enter_folder(void **state)
{
    const char *build = getenv("B") ? getenv("B") : "build";
    char here[400];
    assert_non_null(getcwd(here, sizeof here));
    if (build[0] == '/')
        snprintf(program, sizeof program, "%s/rollbem", build);
    else
        snprintf(program, sizeof program, "%s/%s/rollbem", here, build);
    setenv("PROJECT", here, 1);
    return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static inline int leave_folder(void **state)
{
    char command[100];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return chdir("/") == 0 ? system(command) : -1;
}

#endif
