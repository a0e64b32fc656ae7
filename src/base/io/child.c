#include "base/io/child.h"

#include "base/io/tokens.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* Stands behind the bytes: a child that crashed does not come so far. */
typedef struct {
    rb_status status;
    rb_message why;
} ending;

rb_status rb_io_in_child(const char *name, io_work *work, const void *context, char **bytes,
                         size_t *size, rb_message *why)
{
    int end[2], status = 0;
    ending e;
    *bytes = NULL;
    *size = 0;
    if (pipe(end) != 0)
        return rb_fail(why, RB_ENOMEM, "%s: out of memory: %s", name, strerror(errno));
    const pid_t pid = fork();
    if (pid == 0) {
        ending mine = {.status = RB_ENOMEM};
        /* What a crash would print, and the core it would leave, helps nobody. */
        const struct rlimit none = {0, 0};
        const int null = open("/dev/null", O_WRONLY);
        close(end[0]);
        FILE *out = fdopen(end[1], "wb");
        setrlimit(RLIMIT_CORE, &none);
        dup2(null, STDERR_FILENO);
        if (out) {
            mine.status = work(out, context, &mine.why);
            fwrite(&mine, sizeof mine, 1, out);
            fflush(out);
        }
        _exit(0); /* the library's own end may crash too */
    }
    close(end[1]);
    FILE *from = pid > 0 ? fdopen(end[0], "rb") : NULL;
    char *all = from ? rb_io_read_all(from, SIZE_MAX, size) : NULL;
    if (from)
        fclose(from);
    else
        close(end[0]);
    while (pid > 0 && waitpid(pid, &status, 0) < 0 && errno == EINTR)
        ;
    if (!all || *size < sizeof e) {
        free(all);
        if (WIFSIGNALED(status) && WTERMSIG(status) != SIGKILL)
            return rb_fail(why, RB_ENOMEM, "%s: HDF5 crashed: out of memory, or a damaged file",
                           name);
        return rb_fail(why, RB_ENOMEM, "%s: out of memory", name);
    }
    *size -= sizeof e;
    memcpy(&e, all + *size, sizeof e);
    if (e.status == RB_OK) {
        *bytes = all;
        return RB_OK;
    }
    free(all);
    return rb_fail(why, e.status, "%s", e.why.text);
}
