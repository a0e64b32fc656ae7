/* Calls of the system that fail on demand: a program's own function of a name comes
 * before the C library's, to which all others go on. */
#ifndef ROLLBEM_TESTS_FAILING_CALL_H
#define ROLLBEM_TESTS_FAILING_CALL_H

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { EVERY_CALL = -1, MOST_FAILING = 2 };

static struct {
    const char *name;
    int error, in; /* in so many calls, once */
} failing[MOST_FAILING];

/* The in-th call of that name fails from now on, or EVERY_CALL. */
static inline void fail_call(const char *name, int error, int in)
{
    int k = 0;
    while (k < MOST_FAILING - 1 && failing[k].name)
        k++;
    failing[k].name = name;
    failing[k].error = error;
    failing[k].in = in;
}

/* 1: all that were to fail once have failed. */
static inline int calls_succeed(void)
{
    int left = 0;
    for (int k = 0; k < MOST_FAILING; k++) {
        left += failing[k].name && failing[k].in > 0;
        failing[k].name = NULL;
    }
    return left == 0;
}

static inline int call_fails(const char *name)
{
    for (int k = 0; k < MOST_FAILING; k++) {
        if (!failing[k].name || strcmp(failing[k].name, name) != 0)
            continue;
        if (failing[k].in != EVERY_CALL && --failing[k].in != 0)
            continue;
        errno = failing[k].error;
        return 1;
    }
    return 0;
}

/* The C library's function of that name. */
#define REAL_CALL(type, name, ...)                                                                 \
    type (*real)(__VA_ARGS__);                                                                     \
    *(void **)&real = dlsym(RTLD_NEXT, name)

int open(const char *path, int flags, ...)
{
    va_list rest;
    va_start(rest, flags);
    const int mode = va_arg(rest, int);
    va_end(rest);
    REAL_CALL(int, "open", const char *, int, ...);
#ifdef O_TMPFILE
    if ((flags & O_TMPFILE) == O_TMPFILE && call_fails("O_TMPFILE"))
        return -1;
#endif
    return call_fails("open") ? -1 : real(path, flags, mode);
}

int close(int fd)
{
    REAL_CALL(int, "close", int);
    return call_fails("close") ? (real(fd), -1) : real(fd);
}

ssize_t read(int fd, void *to, size_t size)
{
    REAL_CALL(ssize_t, "read", int, void *, size_t);
    return call_fails("read") ? -1 : real(fd, to, size);
}

ssize_t write(int fd, const void *from, size_t size)
{
    REAL_CALL(ssize_t, "write", int, const void *, size_t);
    return call_fails("write") ? -1 : real(fd, from, size);
}

off_t lseek(int fd, off_t at, int from)
{
    REAL_CALL(off_t, "lseek", int, off_t, int);
    return call_fails("lseek") ? -1 : real(fd, at, from);
}

int fchmod(int fd, mode_t mode)
{
    REAL_CALL(int, "fchmod", int, mode_t);
    return call_fails("fchmod") ? -1 : real(fd, mode);
}

int access(const char *path, int mode)
{
    REAL_CALL(int, "access", const char *, int);
    return call_fails("access") ? -1 : real(path, mode);
}

int rename(const char *from, const char *to)
{
    REAL_CALL(int, "rename", const char *, const char *);
    return call_fails("rename") ? -1 : real(from, to);
}

int linkat(int from, const char *old, int to, const char *new, int flags)
{
    REAL_CALL(int, "linkat", int, const char *, int, const char *, int);
    return call_fails("linkat") ? -1 : real(from, old, to, new, flags);
}

int fclose(FILE *file)
{
    REAL_CALL(int, "fclose", FILE *);
    return call_fails("fclose") ? (real(file), -1) : real(file);
}

FILE *fdopen(int fd, const char *mode)
{
    REAL_CALL(FILE *, "fdopen", int, const char *);
    return call_fails("fdopen") ? NULL : real(fd, mode);
}

int pipe(int end[2])
{
    REAL_CALL(int, "pipe", int[2]);
    return call_fails("pipe") ? -1 : real(end);
}

pid_t fork(void)
{
    REAL_CALL(pid_t, "fork", void);
    return call_fails("fork") ? -1 : real();
}

pid_t waitpid(pid_t pid, int *status, int options)
{
    REAL_CALL(pid_t, "waitpid", pid_t, int *, int);
    return call_fails("waitpid") ? -1 : real(pid, status, options);
}

#endif
