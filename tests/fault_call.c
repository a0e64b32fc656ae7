/* Runs a program and lets one of its system calls fail: the kernel's own answer is
 * replaced, so that the calls of the C library and of all others are met. */
#define _GNU_SOURCE
#include "fault_call.h"

#include <elf.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined(__linux__) && (defined(__x86_64__) || defined(__aarch64__))

typedef struct user_regs_struct registers;

static int get_registers(pid_t pid, registers *r)
{
    struct iovec io = {r, sizeof *r};
    return ptrace(PTRACE_GETREGSET, pid, (void *)NT_PRSTATUS, &io) == 0;
}

static void set_registers(pid_t pid, registers *r)
{
    struct iovec io = {r, sizeof *r};
    ptrace(PTRACE_SETREGSET, pid, (void *)NT_PRSTATUS, &io);
}

#if defined(__x86_64__)
static long call_of(const registers *r)
{
    return (long)r->orig_rax;
}

static long first_argument(const registers *r)
{
    return (long)r->rdi;
}

/* At the entry: no call is made. */
static void skip_call(pid_t pid, registers *r)
{
    r->orig_rax = (unsigned long long)-1;
    set_registers(pid, r);
}

static void set_result(registers *r, long value)
{
    r->rax = (unsigned long long)value;
}
#else
static long call_of(const registers *r)
{
    return (long)r->regs[8];
}

static long first_argument(const registers *r)
{
    return (long)r->regs[0];
}

static void skip_call(pid_t pid, registers *r)
{
    int none = -1;
    struct iovec io = {&none, sizeof none};
    (void)r;
    ptrace(PTRACE_SETREGSET, pid, (void *)NT_ARM_SYSTEM_CALL, &io);
}

static void set_result(registers *r, long value)
{
    r->regs[0] = (unsigned long long)value;
}
#endif

/* Where a build with --coverage keeps its counters. */
static int is_profile(pid_t pid, long fd)
{
    char link[60], path[600];
    snprintf(link, sizeof link, "/proc/%d/fd/%ld", (int)pid, fd);
    const ssize_t n = readlink(link, path, sizeof path);
    return n > 5 && memcmp(path + n - 5, ".gcda", 5) == 0;
}

static int is_of_kind(pid_t pid, const registers *r, fault_kind kind)
{
    switch (kind) {
    case FAULT_WRITE: /* not the lines for people */
        return (call_of(r) == SYS_write || call_of(r) == SYS_pwrite64 ||
                call_of(r) == SYS_writev) &&
               first_argument(r) != STDERR_FILENO && !is_profile(pid, first_argument(r));
    case FAULT_RENAME:
#ifdef SYS_rename
        if (call_of(r) == SYS_rename)
            return 1;
#endif
        return call_of(r) == SYS_renameat || call_of(r) == SYS_renameat2 ||
               call_of(r) == SYS_linkat;
    case FAULT_CLOSE:
        return call_of(r) == SYS_close && !is_profile(pid, first_argument(r));
    }
    return 0;
}

static const int errors[] = {ENOSPC, EPERM, EIO};

/* Stops of the program, at the entry of a call and at its exit in turn. */
static int follow(pid_t pid, fault_kind kind, int k, int *count)
{
    int status, entry = 1, failing = 0, deliver = 0;
    registers r;
    *count = 0;
    for (;;) {
        if (ptrace(PTRACE_SYSCALL, pid, NULL, (void *)(long)deliver) != 0 ||
            waitpid(pid, &status, 0) != pid)
            return -1;
        deliver = 0;
        if (WIFEXITED(status) || WIFSIGNALED(status))
            return status;
        if (WSTOPSIG(status) != (SIGTRAP | 0x80)) {
            deliver = WSTOPSIG(status) == SIGTRAP ? 0 : WSTOPSIG(status);
            continue;
        }
        if (!get_registers(pid, &r))
            continue;
        if (entry) {
            failing = is_of_kind(pid, &r, kind) && ++*count == k;
            if (failing && kind != FAULT_CLOSE) /* a failing close closes all the same */
                skip_call(pid, &r);
        } else if (failing) {
            set_result(&r, -errors[kind]);
            set_registers(pid, &r);
        }
        entry = !entry;
    }
}

static void start(char *const argv[], const char *out, const char *err)
{
    const int to = open(out, O_WRONLY | O_CREAT | O_TRUNC, 0666),
              errors_to = open(err, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    dup2(to, STDOUT_FILENO);
    dup2(errors_to, STDERR_FILENO);
    close(to);
    close(errors_to);
    if (ptrace(PTRACE_TRACEME, 0, NULL, NULL) != 0)
        _exit(FAULT_UNTRACED);
    raise(SIGSTOP);
    execv(argv[0], argv);
    _exit(127);
}

int fault_run(char *const argv[], const char *out, const char *err, fault_kind kind, int k,
              int *count)
{
    int status;
    const pid_t pid = fork();
    if (pid == 0)
        start(argv, out, err);
    if (pid < 0 || waitpid(pid, &status, 0) != pid)
        return -1;
    if (!WIFSTOPPED(status))
        return status;
    ptrace(PTRACE_SETOPTIONS, pid, NULL,
           (void *)(long)(PTRACE_O_TRACESYSGOOD | PTRACE_O_TRACEEXEC | PTRACE_O_EXITKILL));
    return follow(pid, kind, k, count);
}

#else

int fault_run(char *const argv[], const char *out, const char *err, fault_kind kind, int k,
              int *count)
{
    (void)argv, (void)out, (void)err, (void)kind, (void)k;
    *count = 0;
    return FAULT_UNTRACED << 8;
}

#endif
