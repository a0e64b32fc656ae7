/* rollbem: finds the command, and checks that its output was written. */
#define _DEFAULT_SOURCE /* MADV_HUGEPAGE */
#include "program/cli/cli.h"
#include "base/blas.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include <gsl/gsl_errno.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

static const cli_command commands[] = {
    {"curve", cli_curve, "creep curve: the tangential force over the creepage"},
    {"sweep", cli_sweep, "parameter studies over all processors and, under mpirun, machines"},
    {"stress", cli_stress, "the stress below the surface: table, pictures, ParaView"},
    {"design", cli_design, "minimum or maximum of a result over numbers of a case"},
    {"fit", cli_fit, "numbers of a case fitted to a measured creep curve"},
    {"prony", cli_prony, "a series of relaxation times fitted to E' and tan delta over frequency"},
    {"rubber", cli_rubber, "the modulus of a hardness: Shore A or P&J, by each relation"},
    {"wear", cli_wear, "wear by sliding, fretting or rolling"},
    {"crack", cli_crack, "stress intensities of a crack below the passing contact"},
    {"verify", cli_verify, "compares the program with closed-form and published results"},
    {"check", cli_check, "checks results without solving: valid, or what is wrong"},
    {"lcp", cli_lcp, "solves complementarity problems and bimatrix games from files"},
    {"friction", cli_friction, "solves frictional contact problems from files"},
    {"compare", cli_compare, "performance profiles of friction solvers over files"},
    {"contact", cli_contact, "runs two-dimensional input files of CONTACT"},
    {"examples", cli_examples, "the built-in examples: --example NAME"},
    {"example", cli_example, "finite elements: bar, truss, wall"},
    {"page", cli_page, "writes the page for browsers, which opens with a given case"},
    {"help", cli_help, "this list, or the options of one command"},
    {"", cli_solve, "solves one case of rolling contact with friction, prints its table"},
};

/* OpenBLAS reads its environment only while it is loaded: hence a second start. */
static void start_again_with(const char *name, const char *value, char **argv)
{
    if (!getenv(name) && setenv(name, value, 1) == 0)
        execv("/proc/self/exe", argv);
}

/* OpenMP's threads wait for work in a loop for some milliseconds each time, longer than most
 * cases take, unless the environment says otherwise when the library begins.  That is after
 * this where OpenMP is part of the program. */
__attribute__((constructor(101))) static void wait_passively(void)
{
    setenv("OMP_WAIT_POLICY", "passive", 0);
}

/* Matrices of up to some MB come and go in every solution.  glibc would give their memory back to
 * the system at first, until it has adapted itself to these values, and to ask for its pages again
 * takes up to a tenth of a case. */
static void keep_freed_memory(void)
{
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 32 << 20);
    mallopt(M_TRIM_THRESHOLD, 64 << 20);
#endif
}

/* A small case touches some hundred pages, and a virtual machine fetches each of them for what
 * thousands of multiplications cost: up to a fifth of the case.  Hence the heap begins with pages
 * of 2 MB where the system has them; what lies before the first of these is left alone. */
static void begin_with_large_pages(void)
{
#if defined(__GLIBC__) && defined(MADV_HUGEPAGE)
    static void *volatile left_alone; /* volatile: or the compiler leaves its malloc out */
    const uintptr_t page = (uintptr_t)2 << 20;
    const size_t size = 8 * page;
    char *heap = malloc(size);
    if (!heap)
        return;
    const uintptr_t begin = (uintptr_t)heap, first = (begin + page - 1) & ~(page - 1);
    madvise((void *)first, ((begin + size) & ~(page - 1)) - first, MADV_HUGEPAGE);
    free(heap);
    left_alone = malloc(first - begin);
    (void)left_alone;
#endif
}

/* Some libraries end the program where memory is short (OpenMP, with exit code 1). */
static int finished;

static void name_the_cause(void)
{
    if (!finished)
        _exit(cli_fail(CLI_INTERNAL, "out of memory"));
}

int main(int argc, char **argv)
{
    atexit(name_the_cause);
    /* Files must not get the numbers of standard input, output and error: a closed one is
     * opened the wrong way round, so that using it is the error that it was. */
    for (int fd = 0; fd <= 2; fd++)
        if (fcntl(fd, F_GETFD) < 0)
            open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY);
    /* Where the second start fails, the kernels that OpenBLAS chose do as well. */
    const char *core = rb_blas_better_core();
    if (core)
        start_again_with("OPENBLAS_CORETYPE", core, argv);
    if (!rb_blas_has_room()) {
        start_again_with("OPENBLAS_NUM_THREADS", "1", argv);
        cli_fail(CLI_INTERNAL, "out of memory: no address space for OpenBLAS's buffers");
        _exit(CLI_INTERNAL); /* its threads would never end */
    }
    if (!getenv("OPENBLAS_NUM_THREADS"))
        rb_blas_threads(1);
    keep_freed_memory();
    begin_with_large_pages();
    gsl_set_error_handler_off();
    signal(SIGPIPE, SIG_IGN); /* a closed pipe becomes a write error, */
    signal(SIGXFSZ, SIG_IGN); /* and so does a limit of file sizes */
    int code;
    if (!cli_begin(commands, argc, argv))
        code = cli_fail(CLI_INTERNAL, "out of memory");
    else if (argc > 1 && argv[1][0] && cli_command_help(argv[1]))
        code = cli_run(argv[1], argc - 1, argv + 1);
    else
        code = cli_run("", argc, argv);
    /* A full disc or a closed pipe shows here at the latest; what failed before has left its
     * reason.  Where standard output was closed from the beginning and nothing went there,
     * nothing is lost. */
    errno = ferror(stdout) ? errno : 0;
    int failed = fflush(stdout) != 0 || ferror(stdout);
    failed = (fclose(stdout) != 0 && errno != EBADF) || failed;
    if (failed && errno == EPIPE)
        code = code == CLI_OK ? CLI_CANTWRITE : code;
    else {
        if (failed && code != CLI_CANTWRITE)
            code = cli_fail(CLI_CANTWRITE, "standard output: cannot write: %s",
                            errno ? strerror(errno) : "write error");
    }
    cli_end();
    finished = 1;
    return code;
}
