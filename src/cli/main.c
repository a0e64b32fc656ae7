/* rollbem: finds the command and sees that what it printed was written. */
#include "cli/cli.h"
#include "rollbem/blas.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <gsl/gsl_errno.h>

static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *help;
} commands[] = {
    {"curve", cli_curve, "creep curve: the tangential force over the creepage"},
    {"sweep", cli_sweep,
     "parameter studies over all processors and, under mpirun, machines"},
    {"stress", cli_stress, "the stress below the surface: table, pictures, ParaView"},
    {"wear", cli_wear, "what sliding, fretting or rolling takes off"},
    {"verify", cli_verify,
     "every reference that the program should meet, and how it does"},
    {"check", cli_check,
     "checks a result in JSON without solving: valid, or what is wrong"},
    {"lcp", cli_lcp, "solves complementarity problems and bimatrix games from files"},
    {"friction", cli_friction, "solves frictional contact problems from files"},
    {"compare", cli_compare, "performance profiles of friction solvers over files"},
    {"contact", cli_contact, "runs two-dimensional input files of CONTACT"},
    {"examples", cli_examples, "cases that are at hand: --example NAME"},
    {"example", cli_example, "finite elements: bar, truss, wall"},
    {"page", cli_page, "the page for browsers, with a case that it opens with"},
    {"help", cli_help, "this list, or the options of one command"},
};

enum { COMMANDS = sizeof commands / sizeof commands[0] };

static char *command_line;

const char *cli_command_line(void)
{
    return command_line ? command_line : "rollbem";
}

const char *cli_command_name(int k)
{
    return k < COMMANDS ? commands[k].name : NULL;
}

const char *cli_command_help(const char *name)
{
    for (int i = 0; i < COMMANDS; i++)
        if (strcmp(name, commands[i].name) == 0)
            return commands[i].help;
    return "solves one case of rolling contact with friction, prints its table";
}

void cli_guess_command(rb_guess *guess)
{
    for (int i = 0; i < COMMANDS; i++)
        rb_guess_try(guess, commands[i].name);
}

int cli_run(const char *name, int argc, char **argv)
{
    rb_guess guess = {.word = name};
    for (int i = 0; i < COMMANDS; i++)
        if (strcmp(name, commands[i].name) == 0)
            return commands[i].run(argc, argv);
    cli_guess_command(&guess);
    return cli_fail(CLI_USAGE, "unknown command '%s'%s", name, rb_guess_text(&guess, ""));
}

static int is_command(const char *name)
{
    for (int i = 0; i < COMMANDS; i++)
        if (strcmp(name, commands[i].name) == 0)
            return 1;
    return 0;
}

int cli_help(int argc, char **argv)
{
    if (argc > 1 && argv[1][0] != '-') {
        char *args[] = {argv[1], "--help", NULL};
        return cli_run(argv[1], 2, args);
    }
    puts("rollbem [OPTION...] [CASE.ini]   solve one case of rolling contact, print its "
         "table");
    for (int i = 0; i < COMMANDS; i++)
        printf("rollbem %-24s %s\n", commands[i].name, commands[i].help);
    puts("\n`rollbem --help` lists the options of a case, `rollbem help COMMAND` those "
         "of a "
         "command.");
    return CLI_OK;
}

/* Room for every character quoted ('\''), a pair of quotes and a space each; then 4 bytes
 * for each of them in print. */
static size_t quoted_size(int argc, char **argv)
{
    size_t size = sizeof "rollbem";
    for (int i = 1; i < argc; i++)
        size += 4 * strlen(argv[i]) + 3;
    return size;
}

static char *append_quoted(char *to, const char *word)
{
    const char *plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                        "-_=+.,:/@%^";
    const size_t n = strlen(word);
    if (n > 0 && strspn(word, plain) == n) {
        memcpy(to, word, n);
        return to + n;
    }
    *to++ = '\'';
    for (const char *c = word; *c; c++) {
        if (*c == '\'') {
            memcpy(to, "'\\'", 3);
            to += 3;
        }
        *to++ = *c;
    }
    *to++ = '\'';
    return to;
}

static char *quote(int argc, char **argv)
{
    char *line = malloc(quoted_size(argc, argv));
    if (!line)
        return NULL;
    memcpy(line, "rollbem", 7);
    char *to = line + 7;
    for (int i = 1; i < argc; i++) {
        *to++ = ' ';
        to = append_quoted(to, argv[i]);
    }
    *to = '\0';
    char *printable = malloc(4 * strlen(line) + 1);
    if (printable)
        rb_printable(line, printable, 4 * strlen(line) + 1);
    free(line);
    return printable;
}

/* A full disc or a closed pipe shows here at the latest.  Where standard output was
 * closed from the beginning and nothing went there, nothing is lost. */
static int close_output(int code)
{
    errno = 0;
    int failed = fflush(stdout) != 0 || ferror(stdout);
    failed = (fclose(stdout) != 0 && errno != EBADF) || failed;
    if (failed && code != CLI_CANTWRITE) /* not said yet */
        return cli_fail(CLI_CANTWRITE, "standard output: %s",
                        errno ? strerror(errno) : "write error");
    return code;
}

/* Files must not get the numbers of standard input, output and error: a closed one is
 * opened the wrong way round, so that using it is the error that it was. */
static void fill_descriptors(void)
{
    for (int fd = 0; fd <= 2; fd++)
        if (fcntl(fd, F_GETFD) < 0)
            open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY);
}

/* OpenBLAS reads its environment only while it is loaded: hence a second start. */
static void start_again_with(const char *name, const char *value, char **argv)
{
    if (!getenv(name) && setenv(name, value, 1) == 0)
        execv("/proc/self/exe", argv);
}

/* Where the second start fails, the kernels that OpenBLAS chose do as well. */
static void prepare_blas(char **argv)
{
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
}

/* Some libraries end the program where memory is short (OpenMP, with exit code 1). */
static int came_to_the_end;

static void say_who_ended_it(void)
{
    if (!came_to_the_end)
        _exit(cli_fail(CLI_INTERNAL, "out of memory"));
}

int main(int argc, char **argv)
{
    atexit(say_who_ended_it);
    fill_descriptors();
    prepare_blas(argv);
    gsl_set_error_handler_off();
    signal(SIGPIPE, SIG_IGN); /* a closed pipe becomes a write error, */
    signal(SIGXFSZ, SIG_IGN); /* and so does a limit of file sizes */
    command_line = quote(argc, argv);
    int code;
    if (!command_line)
        code = cli_fail(CLI_INTERNAL, "out of memory");
    else if (argc > 1 && is_command(argv[1]))
        code = cli_run(argv[1], argc - 1, argv + 1);
    else
        code = cli_solve(argc, argv);
    code = close_output(code);
    free(command_line);
    came_to_the_end = 1;
    return code;
}
