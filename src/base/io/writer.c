/* Files that are written whole or not at all: a file without a name, or with another one, gets its
 * own when all is written. */
#define _GNU_SOURCE /* O_TMPFILE, realpath */
#include "base/io/io.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* errno says why; 0: a write failed whose reason is forgotten. */
static rb_status cannot_write(const char *path, rb_message *why)
{
    if (errno == ENOMEM)
        return rb_fail(why, RB_ENOMEM, "%s: out of memory", path);
    return rb_fail(why, RB_EWRITE, "%s: cannot write: %s", path,
                   errno ? strerror(errno) : "write error");
}

/* ---- Names ------------------------------------------------------------------------- */

/* The path of `name` in the folder of `target`; owned by the caller. */
static char *beside(const char *target, const char *name)
{
    const char *slash = strrchr(target, '/');
    const size_t n = slash ? (size_t)(slash + 1 - target) : 0;
    char *path = malloc(n + strlen(name) + 1);
    if (path) {
        memcpy(path, target, n);
        strcpy(path + n, name);
    }
    return path;
}

/* The file behind all links, which need not exist yet; owned by the caller. */
static char *resolve_path(const char *path)
{
    char to[PATH_MAX];
    char *real = realpath(path, NULL);
    if (real || errno != ENOENT)
        return real;
    const ssize_t n = readlink(path, to, sizeof to - 1);
    if (n < 0)
        return strdup(path);
    to[n] = '\0';
    char *next = to[0] == '/' ? strdup(to) : beside(path, to);
    real = next ? resolve_path(next) : NULL;
    free(next);
    return real;
}

/* Calls make with unused names beside the target until one is taken. */
static char *take_name(const char *target, int (*make)(const char *name, int fd), int *fd)
{
    for (int k = 0;; k++) {
        char name[40];
        snprintf(name, sizeof name, ".rollbem-%ld-%d", (long)getpid(), k);
        char *path = beside(target, name);
        const int made = path ? make(path, *fd) : -1;
        if (made >= 0) {
            *fd = made;
            return path;
        }
        free(path);
        if (errno != EEXIST)
            return NULL;
    }
}

static int create_file(const char *name, int fd)
{
    (void)fd;
    return open(name, O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0666);
}

static int link_nameless(const char *name, int fd)
{
    char self[40];
    snprintf(self, sizeof self, "/proc/self/fd/%d", fd);
    return linkat(AT_FDCWD, self, AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0 ? fd : -1;
}

/* ---- Open -------------------------------------------------------------------------- */

/* A file in the target's folder that has no name until it is committed: whatever ends the
 * program, nothing is left behind. */
static int open_nameless(const char *target)
{
    int fd = -1;
#ifdef O_TMPFILE
    char *folder = beside(target, ".");
    if (!folder)
        return -1;
    fd = open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
    free(folder);
    if (fd >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL))
        return fd;
#endif
    char *name = take_name(target, create_file, &fd);
    if (name)
        unlink(name);
    free(name);
    return fd;
}

rb_status rb_io_writer_open(const char *path, rb_io_writer *w, rb_message *why)
{
    struct stat old;
    *w = (rb_io_writer){0};
    if (!path || !strcmp(path, "-")) {
        w->file = stdout;
        return RB_OK;
    }
    const int exists = stat(path, &old) == 0, is_device = exists && !S_ISREG(old.st_mode);
    int fd = -1;
    if (is_device) {
        w->device = strdup(path);
        w->file = w->device ? fopen(path, "w") : NULL;
    } else if (!exists || access(path, W_OK) == 0) {
        w->target = resolve_path(path);
        fd = w->target ? open_nameless(w->target) : -1;
        if (fd >= 0 && (!exists || fchmod(fd, old.st_mode & 07777) == 0))
            w->file = fdopen(fd, "w+");
    }
    if (w->file)
        return RB_OK;
    const rb_status s = cannot_write(path, why);
    if (fd >= 0)
        close(fd);
    rb_io_writer_abandon(w);
    return s;
}

rb_status rb_io_writer_check(const char *path, rb_message *why)
{
    rb_io_writer w;
    struct stat st;
    if (stat(path, &st) == 0 && !S_ISREG(st.st_mode) && !S_ISDIR(st.st_mode))
        return access(path, W_OK) == 0 ? RB_OK : cannot_write(path, why);
    const rb_status s = rb_io_writer_open(path, &w, why);
    if (s == RB_OK)
        rb_io_writer_abandon(&w);
    return s;
}

/* ---- End --------------------------------------------------------------------------- */

/* 1: something was not written; errno says why, 0 where that is forgotten. */
static int flush(FILE *file)
{
    errno = 0;
    return fflush(file) != 0 || ferror(file);
}

/* The same, and closes what is not stdout. */
static int finish(FILE *file)
{
    const int bad = flush(file), e = errno;
    if (file != stdout && fclose(file) != 0 && !bad)
        return 1;
    errno = e;
    return bad;
}

/* Where the system cannot give the nameless file a name. */
static char *copy_to_name(const char *target, int from)
{
    char buffer[1 << 14];
    struct stat st = {0};
    int to = -1;
    char *name = take_name(target, create_file, &to);
    ssize_t n = 0;
    if (!name)
        return NULL;
    fstat(from, &st);
    int bad = fchmod(to, st.st_mode & 07777) != 0 || lseek(from, 0, SEEK_SET) != 0;
    while (!bad && (n = read(from, buffer, sizeof buffer)) > 0)
        for (ssize_t at = 0, part; at < n && !bad; at += part)
            bad = (part = write(to, buffer + at, (size_t)(n - at))) <= 0;
    bad |= n < 0;
    bad |= close(to) != 0;
    if (!bad)
        return name;
    const int e = errno;
    unlink(name);
    free(name);
    errno = e;
    return NULL;
}

/* The target takes the place of an old one at once. */
static int replace(rb_io_writer *w)
{
    int fd = fileno(w->file), bad;
    if (flush(w->file)) {
        if (errno == 0 && write(fd, "", 1) >= 0) /* ask for the reason once more */
            errno = 0;
        return 1;
    }
    char *name = take_name(w->target, link_nameless, &fd);
    if (!name)
        name = copy_to_name(w->target, fd);
    if (!name)
        return 1;
    bad = finish(w->file);
    w->file = NULL;
    bad = bad || rename(name, w->target) != 0;
    if (bad) {
        const int e = errno;
        unlink(name);
        errno = e;
    }
    free(name);
    return bad;
}

rb_status rb_io_writer_commit(rb_io_writer *w, rb_message *why)
{
    int bad;
    if (w->target) {
        /* As long as the file has a name that is not its own, no signal ends the program. */
        sigset_t all, before;
        sigfillset(&all);
        pthread_sigmask(SIG_BLOCK, &all, &before);
        bad = replace(w);
        const int e = errno;
        pthread_sigmask(SIG_SETMASK, &before, NULL);
        errno = e;
    } else {
        bad = finish(w->file);
        w->file = NULL;
    }
    const char *name = w->target ? w->target : w->device ? w->device : "standard output";
    const rb_status s = bad ? cannot_write(name, why) : RB_OK;
    rb_io_writer_abandon(w);
    return s;
}

void rb_io_writer_abandon(rb_io_writer *w)
{
    if (w->file && w->file != stdout)
        fclose(w->file);
    free(w->target);
    free(w->device);
    *w = (rb_io_writer){0};
}

/* ---- Folders ----------------------------------------------------------------------- */

char *rb_io_join(const char *folder, const char *name)
{
    char *path = malloc(strlen(folder) + strlen(name) + 2);
    if (path)
        sprintf(path, "%s/%s", folder, name);
    return path;
}

rb_status rb_io_make_folder(const char *path, rb_message *why)
{
    struct stat st;
    if (mkdir(path, 0777) == 0 || (errno == EEXIST && stat(path, &st) == 0 && S_ISDIR(st.st_mode)))
        return RB_OK;
    return cannot_write(path, why);
}

rb_status rb_io_folder_check(const char *path, rb_message *why)
{
    struct stat st;
    const int exists = stat(path, &st) == 0;
    if (exists && !S_ISDIR(st.st_mode)) {
        errno = ENOTDIR;
        return cannot_write(path, why);
    }
    if (exists)
        return access(path, W_OK | X_OK) == 0 ? RB_OK : cannot_write(path, why);
    char *parent = strdup(path);
    size_t n = parent ? strlen(parent) : 0;
    while (n > 1 && parent[n - 1] == '/')
        parent[--n] = '\0';
    char *here = parent ? beside(parent, ".") : NULL;
    const rb_status s = here && access(here, W_OK | X_OK) == 0 ? RB_OK : cannot_write(path, why);
    free(here);
    free(parent);
    return s;
}
