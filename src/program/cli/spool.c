#define _XOPEN_SOURCE 700 /* pread, mkstemp */
#include "program/cli/spool.h"

#include "base/base.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int copy_all(int from, int to)
{
    char part[1 << 16];
    for (ssize_t n; (n = read(from, part, sizeof part)) != 0;) {
        if (n < 0 && errno == EINTR)
            continue;
        if (n < 0)
            return 0;
        for (ssize_t done = 0, one; done < n; done += one)
            if ((one = write(to, part + done, (size_t)(n - done))) < 0)
                return 0;
    }
    return 1;
}

rb_status cli_spool_begin(const char *name, cli_spool *s, rb_message *why)
{
    struct stat st;
    char copy[300];
    const int is_input = strcmp(name, "-") == 0;
    *s = (cli_spool){.name = name, .fd = -1};
    if (!is_input && (stat(name, &st) != 0 || !S_ISFIFO(st.st_mode)))
        return RB_OK;
    const int from = is_input ? STDIN_FILENO : open(name, O_RDONLY);
    if (from < 0)
        return rb_fail(why, RB_ENOENT, "%s: %s", name, strerror(errno));
    char begins[4] = "";
    const char *folder = getenv("TMPDIR");
    snprintf(copy, sizeof copy, "%s/rollbem-XXXXXX", folder && *folder ? folder : "/tmp");
    s->fd = mkstemp(copy);
    const int copied = s->fd >= 0 && copy_all(from, s->fd);
    const int error = errno;
    s->is_named = copied && pread(s->fd, begins, sizeof begins, 0) == (ssize_t)sizeof begins &&
                  memcmp(begins, "\x89HDF", sizeof begins) == 0;
    if (s->fd >= 0 && !s->is_named)
        unlink(copy); /* nothing is left of it, whatever ends the program */
    if (!is_input)
        close(from);
    if (!copied)
        return rb_fail(why, RB_EWRITE, "%s: cannot be copied to %s: %s",
                       is_input ? "standard input" : name, copy, strerror(error));
    if (s->is_named)
        memcpy(s->path, copy, sizeof copy);
    else
        snprintf(s->path, sizeof s->path, "/dev/fd/%d", s->fd);
    return RB_OK;
}

const char *cli_spool_path(const cli_spool *s)
{
    return s->path[0] ? s->path : s->name;
}

void cli_spool_rename(const cli_spool *s, rb_message *why)
{
    const size_t n = strlen(s->path);
    const rb_message said = *why;
    if (n > 0 && strncmp(said.text, s->path, n) == 0)
        rb_fail(why, RB_OK, "%s%s", strcmp(s->name, "-") == 0 ? "standard input" : s->name,
                said.text + n);
}

void cli_spool_end(cli_spool *s)
{
    if (s->fd >= 0)
        close(s->fd);
    if (s->is_named)
        unlink(s->path);
    *s = (cli_spool){.name = s->name, .fd = -1};
}
