/* Runs gnuplot: script on its stdin, picture from its stdout, so that no file name ever
 * enters a script or a shell. */
#include "rollbem/report.h"

#include <errno.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>

extern char **environ;

static int spawn(FILE *script, FILE *out, FILE *errors, pid_t *pid)
{
    char *const argv[] = {"gnuplot", NULL};
    posix_spawn_file_actions_t actions;
    int e = posix_spawn_file_actions_init(&actions);
    if (e)
        return e;
    e = posix_spawn_file_actions_adddup2(&actions, fileno(script), 0);
    if (!e)
        e = posix_spawn_file_actions_adddup2(&actions, fileno(out), 1);
    if (!e)
        e = posix_spawn_file_actions_adddup2(&actions, fileno(errors), 2);
    if (!e)
        e = posix_spawnp(pid, argv[0], &actions, NULL, argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    return e;
}

static rb_status missing(int e, rb_message *why)
{
    if (e == ENOENT)
        return rb_fail(
            why, RB_EFORMAT,
            "gnuplot is not installed; pictures need it (package gnuplot-nox)");
    return rb_fail(why, RB_EFORMAT, "gnuplot does not start: %s", strerror(e));
}

/* The line that says what was wrong comes last, after the lines it points at. */
static rb_status complaint(FILE *errors, rb_message *why)
{
    char line[200], last[200] = "no message";
    rewind(errors);
    while (fgets(line, sizeof line, errors)) {
        line[strcspn(line, "\n")] = '\0';
        if (line[strspn(line, " ^")])
            memcpy(last, line, sizeof last);
    }
    return rb_fail(why, RB_EFORMAT, "gnuplot failed: %s", last);
}

static rb_status wait_for(pid_t pid, FILE *errors, rb_message *why)
{
    int status;
    while (waitpid(pid, &status, 0) < 0)
        if (errno != EINTR)
            return rb_fail(why, RB_EFORMAT, "gnuplot: %s", strerror(errno));
    /* posix_spawn may report a missing program only by this exit status */
    if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
        return missing(ENOENT, why);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        return complaint(errors, why);
    return RB_OK;
}

rb_status rb_report_gnuplot(FILE *script, FILE *out, rb_message *why)
{
    pid_t pid;
    FILE *errors = tmpfile();
    if (!errors)
        return rb_fail(why, RB_EWRITE, "temporary file: %s", strerror(errno));
    fflush(script);
    rewind(script);
    fflush(out);
    const int e = spawn(script, out, errors, &pid);
    const rb_status s = e ? missing(e, why) : wait_for(pid, errors, why);
    fclose(errors);
    return s;
}
