#define _XOPEN_SOURCE 700 /* realpath */
#include "rollbem/io.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static rb_status cannot_write(const char *path, rb_message *why)
{
    return rb_fail(why, RB_EWRITE, "%s: cannot write: %s", path, strerror(errno));
}

static void forget(rb_io_writer *w)
{
    free(w->temporary);
    free(w->target);
    *w = (rb_io_writer){0};
}

static char *copy(const char *path, const char *suffix)
{
    char *text = malloc(strlen(path) + strlen(suffix) + 1);
    if (text)
        strcat(strcpy(text, path), suffix);
    return text;
}

/* The mode of a new file: that of the old one, or what the umask leaves. */
static mode_t mode_for(const struct stat *old)
{
    if (old)
        return old->st_mode & 07777;
    const mode_t mask = umask(0);
    umask(mask);
    return 0666 & ~mask;
}

/* mkstemp makes files that nobody else may read: old (or NULL) says what it shall be. */
static rb_status open_temporary(const struct stat *old, rb_io_writer *w, rb_message *why)
{
    const int fd = mkstemp(w->temporary);
    if (fd >= 0) {
        fchmod(fd, mode_for(old));
        w->file = fdopen(fd, "w");
        if (w->file)
            return RB_OK;
        close(fd);
        unlink(w->temporary);
    }
    return cannot_write(w->target, why);
}

static rb_status open_directly(const char *path, rb_io_writer *w, rb_message *why)
{
    w->file = fopen(path, "w");
    return w->file ? RB_OK : cannot_write(path, why);
}

rb_status rb_io_writer_open(const char *path, rb_io_writer *w, rb_message *why)
{
    struct stat old;
    *w = (rb_io_writer){0};
    if (!path || !strcmp(path, "-")) {
        w->file = stdout;
        return RB_OK;
    }
    const int exists = stat(path, &old) == 0;
    if (exists && !S_ISREG(old.st_mode))
        return open_directly(path, w, why);
    if (exists && access(path, W_OK) != 0)
        return cannot_write(path, why);
    w->target = exists ? realpath(path, NULL) : copy(path, "");
    w->temporary = w->target ? copy(w->target, ".XXXXXX") : NULL;
    rb_status s = w->temporary ? open_temporary(exists ? &old : NULL, w, why)
                               : rb_fail(why, RB_ENOMEM, "%s: out of memory", path);
    if (s != RB_OK)
        forget(w);
    return s;
}

/* Flushes, and closes what is not stdout; errno tells the first error. */
static int finish(FILE *file)
{
    int bad = fflush(file) != 0 || ferror(file);
    if (file != stdout && fclose(file) != 0)
        bad = 1;
    return bad;
}

rb_status rb_io_writer_commit(rb_io_writer *w, rb_message *why)
{
    rb_status s = RB_OK;
    errno = 0;
    const int bad = finish(w->file);
    if (bad || (w->target && rename(w->temporary, w->target) != 0)) {
        s = cannot_write(w->target ? w->target : "output", why);
        if (w->temporary)
            unlink(w->temporary);
    }
    forget(w);
    return s;
}

void rb_io_writer_abandon(rb_io_writer *w)
{
    if (w->file && w->file != stdout)
        fclose(w->file);
    if (w->temporary)
        unlink(w->temporary);
    forget(w);
}
