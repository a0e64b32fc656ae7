/* Random legal commands, one of every kind with its options: each ends with a documented
 * exit code, and none takes more than 20 s of the processor without having said so.
 * COMMANDS: how many; COMMANDS_FROM: the first one, to run some again; COMMANDS_SHOW: the
 * seconds from which on a command is printed.  By default sixty that take a few seconds in all
 * (number 26 alone takes thirty), a third of them in each turn. */
#include "cli_run.h"
#include "random_case.h"

#include <sys/resource.h>

enum { PROCESSOR = 20, LIMIT = 30 }; /* seconds: said by then; stopped */

static char command[3000];

static int asked(const char *name, int otherwise)
{
    return getenv(name) ? atoi(getenv(name)) : otherwise;
}

#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
static void
add(const char *format, ...)
{
    const size_t at = strlen(command);
    va_list args;
    va_start(args, format);
    vsnprintf(command + at, sizeof command - at, format, args);
    va_end(args);
}

/* ---- What a case may be asked for -------------------------------------------------- */

/* A static, steady or transient case; up to 180 elements, 600 in one of ten, 2400 in one
 * of fifty, which only long runs have. */
static void add_case(random_case *c, int k)
{
    random_case_make(c, k, 8);
    const double most = !asked("COMMANDS", 0) || k % 10 ? 60.0 : k % 50 ? 200.0 : 800.0;
    random_case_make(c, k, (int)random_log(c, 8.0, most));
    add("%s", c->line);
}

static void single(random_case *c)
{
    static const char *const more[] = {"",
                                       " --json",
                                       " --json --states",
                                       " --error",
                                       " --accuracy 3e-3",
                                       " --derivatives tangential_load",
                                       " --derivatives --tolerance mu=0.01,young=2%",
                                       " --all-solutions",
                                       " --format csv --cite",
                                       " --plot-script picture.gp",
                                       " --dump dumped",
                                       " --fclib problem.hdf5"};
    add("%s", more[random_choice(c, (int)(sizeof more / sizeof *more))]);
}

static void stress(random_case *c)
{
    add(" --grid %dx%d%s", 2 + random_choice(c, 100), 2 + random_choice(c, 60),
        random_choice(c, 2) ? " --json" : "");
}

static void curve(random_case *c)
{
    static const char *const over[] = {"", "", " --over creep --to 0.01",
                                       " --over speed --from 1 --to 1e5"};
    add(" --points %d%s%s", 2 + random_choice(c, 60), over[random_choice(c, 4)],
        random_choice(c, 4) ? "" : " --error");
}

static void sweep(random_case *c)
{
    static const char *const varied[] = {"mu 0.05:0.5:4", "young 1000:9e4:3",
                                         "contact-elements 12,24,48", "formulation static,steady"};
    const int first = random_choice(c, 4);
    add(" --vary-1 '%s'", varied[first]);
    if (random_choice(c, 2))
        add(" --vary-2 '%s'", varied[(first + 1) % 4]);
}

static void wear(random_case *c)
{
    if (c->regime == RANDOM_STATIC || c->regime == RANDOM_STEPS)
        add(random_choice(c, 2) ? " --slide %.4g" : " --cycles %.4g", random_log(c, 1.0, 1e6));
    else
        add(" --cycles %.4g", random_log(c, 1.0, 1e6));
    add(" --wear-coefficient %.4g --wear-steps %d --wear-share %.2g", random_log(c, 1e-12, 1e-7),
        1 + random_choice(c, 20), random_choice(c, 2) ? random_between(c, 0.0, 1.0) : 0.0);
}

static void crack(random_case *c)
{
    static const char *const fluid[] = {"", " --fluid trapped", " --fluid pressure", " --coupled"};
    add(" --crack-length %.4g --crack-angle %.4g --crack-friction %.3g --crack-elements %d "
        "--passes %d%s",
        random_log(c, 0.1, 5.0), random_between(c, 10.0, 170.0), random_between(c, 0.0, 0.8),
        4 + random_choice(c, 100), 1 + random_choice(c, 3), fluid[random_choice(c, 4)]);
    if (!random_choice(c, 4))
        add(" --paris 1e-10,3 --grow-steps %d%s", 1 + random_choice(c, 5),
            random_choice(c, 2) ? " --growth tension" : "");
}

static void design(random_case *c)
{
    static const char *const result[] = {"max_pressure", "dissipation", "approach", "half_width",
                                         "max_strain"};
    add(" --minimise %s --over radius=%.5g:%.5g", result[random_choice(c, 5)], 0.5 * c->radius,
        2.0 * c->radius);
    if (random_choice(c, 2))
        add(" --over mu=0.05:0.6");
}

static void fit(random_case *c)
{
    write_file("creep.tsv", "creep_ratio\tforce_ratio\n0.2\t-0.35\n0.4\t-0.62\n0.7\t-0.88\n"
                            "1\t-0.97\n1.4\t-0.99\n");
    add(" creep.tsv --fit %s", random_choice(c, 2) ? "mu" : "mu,young");
}

static const struct {
    const char *name;
    int weight;
    void (*add)(random_case *c);
} kinds[] = {{"", 24, single},  {"stress", 5, stress}, {"curve", 4, curve},   {"sweep", 3, sweep},
             {"wear", 4, wear}, {"crack", 4, crack},   {"design", 2, design}, {"fit", 2, fit}};

/* ---- Problems in files -------------------------------------------------------------- */

/* M with a dominant diagonal, or any: rays then. */
static void write_lcp(random_case *c, const char *name)
{
    const int n = (int)random_log(c, 2.0, 400.0), any = !random_choice(c, 3);
    FILE *file = NOT_NULL(fopen(name, "w"));

    fprintf(file, "%d\n", n);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            fprintf(file, "%.6g%c", (i == j && !any ? n : 0.0) + random_between(c, -1.0, 1.0),
                    j + 1 < n ? ' ' : '\n');
    for (int i = 0; i < n; i++)
        fprintf(file, "%.6g\n", random_between(c, -1.0, 1.0));
    fclose(file);
}

static void problem(random_case *c)
{
    static const char *const lcp[] = {"",        " --solver lemke", " --solver newton",
                                      " --json", " --trace",        " --all"};
    static const char *const examples[] = {"example bar",
                                           "example bar --solver nsgs-ac",
                                           "example truss --nodes 20",
                                           "example truss --layout upper-overhanging --nodes 8",
                                           "verify",
                                           "examples",
                                           "help rubber",
                                           "friction two-blocks.dat",
                                           "friction two-blocks.dat --trace --json"};
    if (random_choice(c, 3)) {
        write_lcp(c, "problem.txt");
        add("lcp problem.txt%s", lcp[random_choice(c, 6)]);
        return;
    }
    add("%s", examples[random_choice(c, (int)(sizeof examples / sizeof *examples))]);
}

/* ---- One command -------------------------------------------------------------------- */

static void command_of(int k)
{
    static random_case c, choice;
    int sum = 0, kind = 0;

    command[0] = '\0';
    choice = (random_case){.state = (uint64_t)k * 77u + 5u};
    random_bits(&choice);
    if (!random_choice(&choice, 12)) {
        problem(&choice);
        return;
    }
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        sum += kinds[i].weight;
    for (int at = random_choice(&choice, sum); at >= kinds[kind].weight; kind++)
        at -= kinds[kind].weight;
    add("%s", kinds[kind].name);
    add_case(&c, k);
    kinds[kind].add(&c);
}

static double processor_of_children(void)
{
    struct rusage usage;
    getrusage(RUSAGE_CHILDREN, &usage);
    return (double)usage.ru_utime.tv_sec + 1e-6 * (double)usage.ru_utime.tv_usec +
           (double)usage.ru_stime.tv_sec + 1e-6 * (double)usage.ru_stime.tv_usec;
}

/* 64: an option that does not fit the others; 65: a file; 1: not solved, and why. */
static int is_documented(int code)
{
    return code == 0 || code == 1 || code == 64 || code == 65;
}

TEST(long_commands_say_so)
{
    enum { FIRST = 27, ALL = 60, TURNS = 4 };
    const int given = getenv("COMMANDS") || !getenv("ROLLBEM_TEST_TURN");
    const int all = asked("COMMANDS", ALL),
              from = asked("COMMANDS_FROM", getenv("COMMANDS") ? 0 : FIRST);
    const double shown = asked("COMMANDS_SHOW", PROCESSOR);
    int ended[3] = {0}, n = 0, with_cover = 0, silent = 0, longer = 0, wrong = 0;
    double slowest = 0.0;
    char line[3200];

    shell("cp \"$PROJECT\"/examples/friction/two-blocks.dat . || true");
    for (int k = from; k < from + all; k++) {
        if (!given && !is_in_turn(k, TURNS))
            continue;
        n++;
        command_of(k);
        snprintf(line, sizeof line, "ulimit -t %d; \"$R\" %s", LIMIT, command);
        const double before = processor_of_children();
        const int code = shell(line);
        const double seconds = processor_of_children() - before;
        const int said = strstr(err, " s of the processor so far") != NULL ||
                         (strstr(err, "case ") && strstr(err, " s left"));
        const int stopped = code > 128; /* at LIMIT */

        slowest = fmax(slowest, seconds);
        with_cover += strstr(command, "--cover-thickness") != NULL;
        longer += seconds > PROCESSOR;
        silent += seconds > PROCESSOR + 2 && !said;
        wrong += !stopped && !is_documented(code);
        if (!stopped && is_documented(code))
            ended[code == 0 ? 0 : code == 1 ? 1 : 2]++;
        if (seconds > shown || (!is_documented(code) && !stopped))
            print_error("command %d: exit %d, %.1f s%s: rollbem %s\n", k, code, seconds,
                        said ? ", said so" : "", command);
        if (!is_documented(code) && !stopped)
            print_error("    %.300s\n", err);
    }
    print_message("%d commands (%d with covers): %d end well, %d not solved, %d refused; "
                  "%d take more than %d s of the processor, %d of them in silence; "
                  "slowest %.1f s\n",
                  n, with_cover, ended[0], ended[1], ended[2], longer, PROCESSOR, silent, slowest);
    assert_int_equal(wrong, 0);
    assert_int_equal(silent, 0);
    assert_true(ended[0] > n / 4);
}

RUN_TESTS(enter_folder, leave_folder)
