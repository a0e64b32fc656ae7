/* Cases at the ends of what is accepted, made at random from a fixed seed, judged by
 * tests/checker.c, which shares no code with the library: a case is refused in one line,
 * not solved for a reason that it names, or right; after 20 s of the processor it says
 * what takes so long.  HOSTILE: how many (make hostile); HOSTILE_FROM: the first one, to
 * run some again. */
#include "cli_run.h"

#include <signal.h>
#include <sys/resource.h>

static char checker[700];

/* ---- Numbers ----------------------------------------------------------------------- */

static uint64_t bits;

/* The k-th case is the same whichever others are run. */
static void begin_case(int k)
{
    bits = (uint64_t)(k + 1) * 0x9e3779b97f4a7c15u;
}

static uint64_t next_random(void)
{
    uint64_t z = bits += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

static double between(double low, double high)
{
    return low + (high - low) * (double)(next_random() >> 11) / 9007199254740992.0;
}

static int choice(int n)
{
    return (int)(next_random() % (uint64_t)n);
}

static double power_of_ten(double low, double high)
{
    return pow(10.0, between(low, high));
}

static double either_sign(double x)
{
    return choice(2) ? x : -x;
}

/* ---- A case ------------------------------------------------------------------------ */

static char line[1200];

#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
static void
add(const char *format, ...)
{
    const size_t at = strlen(line);
    va_list args;
    va_start(args, format);
    vsnprintf(line + at, sizeof line - at, format, args);
    va_end(args);
}

static double poisson(void)
{
    static const double ends[] = {-0.99, 0.0, 0.3, 0.4999, 0.5};
    return choice(3) ? ends[choice(5)] : between(-0.99, 0.5);
}

/* Thin rims have thousands of elements: seconds each, which make test has not. */
static double hub_ratio(void)
{
    const double thick = between(0.05, 0.9), thin = choice(2) ? 0.995 : between(0.9, 0.995);
    return choice(3) || !getenv("HOSTILE") ? thick : thin;
}

/* A's support and material, and half of the time an elastic body B, up to Dundurs'
 * limits. */
static void add_bodies(double radius)
{
    const int support = choice(10);
    const double young = power_of_ten(-3.0, 9.0);
    add(" --radius %.17g --young %.17g --poisson %.4g", radius, young, poisson());
    if (support < 6)
        add(" --support halfplane");
    else if (support < 9)
        add(" --support hub --hub-ratio %.4g", hub_ratio());
    else
        add(" --support arc --arc %.3g", between(5.0, 80.0));
    if (choice(2))
        return;
    if (choice(3) == 0)
        add(" --similar");
    else
        add(" --young-b %.17g --poisson-b %.4g", young * power_of_ten(-6.0, 6.0), poisson());
    if (choice(3) == 0)
        add(" --radius-b %.17g", radius * power_of_ten(-1.0, 3.0));
}

/* A parabola with a step, and noise. */
static void add_gap(double radius, double a)
{
    if (choice(6)) {
        add(choice(3) ? " --gap parabola" : " --gap exact");
        return;
    }
    const double height = a * a / (2.0 * radius), noise = height * power_of_ten(-6.0, -2.0);
    const double step = choice(2) ? height * power_of_ten(-4.0, -1.0) : 0.0;
    FILE *file = NOT_NULL(fopen("gap.txt", "w"));
    for (int k = -40; k <= 40; k++) {
        const double x = 0.1 * k * a;
        fprintf(file, "%.17g %.17g\n", x,
                x * x / (2.0 * radius) + (k > 3 ? step : 0.0) + noise * between(0.0, 1.0));
    }
    fclose(file);
    add(" --gap gap.txt");
    if (choice(2))
        add(" --gap-smoothing %.17g", noise);
}

static void add_tangential(int is_static)
{
    switch (choice(is_static ? 5 : 4)) {
    case 0:
        add(" --creep %.17g", choice(4) ? either_sign(power_of_ten(-15.0, 1.0)) : 0.0);
        break;
    case 1:
        add(" --creep-ratio %.17g", either_sign(power_of_ten(-6.0, 1.0)));
        break;
    case 2:
        add(" --force-ratio %.6g", either_sign(choice(2) ? between(0.0, 0.99) : 0.9999));
        break;
    case 3:
        break;
    default:
        add(" --shift %.17g", either_sign(power_of_ten(-12.0, 0.0)));
    }
}

/* 0: the cases are those that were found before there was more to choose. */
static int with_more = 1;

/* Layers from far thinner than the contact to far thicker ones, covers, thin discs,
 * memory and bores. */
static void add_more(double radius, double a, int is_steady)
{
    const int on_halfplane = strstr(line, "--support halfplane") != NULL,
              on_hub = strstr(line, "--support hub") != NULL;
    if (!with_more || choice(2))
        return;
    const double young = atof(strstr(line, "--young ") + strlen("--young "));
    if (on_halfplane && choice(2))
        add(" --layer-thickness %.17g", a * power_of_ten(-4.0, 3.0));
    if (strstr(line, "--layer-thickness") && choice(2))
        add(" --base-young %.17g --base-poisson %.4g", young * power_of_ten(-3.0, 6.0),
            between(-0.9, 0.5));
    if (on_hub && choice(2)) /* the hub is that of an elastic core */
        add(" --cover-thickness %.17g --core-young %.17g --core-poisson 0.3",
            radius * between(getenv("HOSTILE") ? 1e-4 : 0.02, 0.4),
            young * power_of_ten(-1.0, 6.0));
    if (choice(4) == 0)
        add(" --plane stress");
    if (on_halfplane && is_steady && choice(4) == 0)
        add(" --relaxation-time 1 --relaxation-ratio %.17g --speed %.17g", power_of_ten(-2.0, 2.0),
            a * power_of_ten(-3.0, 3.0));
    if (strstr(line, "--similar") && !strstr(line, "--radius-b") && choice(2))
        add(" --radius-b %.17g", -radius * (1.0 + power_of_ten(-3.0, 1.0)));
}

static void make_case(int k)
{
    static const char *const meshes[] = {"", " --mesh uniform", " --mesh fitted",
                                         " --mesh aligned"};
    static const char *const solvers[] = {"", "", "", " --solver lemke", " --solver newton"};
    begin_case(k);
    line[0] = '\0';
    const double radius = power_of_ten(-2.0, 4.0);
    const double a = radius * power_of_ten(-8.0, log10(0.5));
    const int formulation = choice(8); /* 0 static, 7 transient */
    add_bodies(radius);
    add_gap(radius, a);
    if (choice(3))
        add(" --half-width %.17g", a);
    else
        add(" --approach %.17g", a * a / radius * between(0.3, 2.0));
    add(" --mu %.17g", choice(3) ? power_of_ten(-12.0, 3.0) : choice(4) ? between(0.05, 0.6) : 0.0);
    add(formulation == 0   ? " --formulation static"
        : formulation == 7 ? " --formulation transient --distance 0.3 --steps 3"
                           : " --formulation steady");
    add_tangential(formulation == 0);
    add(" --contact-elements %d", 5 + choice(46));
    add("%s%s", meshes[choice(4)], solvers[choice(5)]);
    add_more(radius, a, formulation != 0 && formulation != 7);
}

/* ---- Judgement --------------------------------------------------------------------- */

enum { SOLVED, REFUSED, BEYOND, UNSOLVED, WRONG, ENDS };
static const char *const ends[ENDS] = {"right", "refused", "beyond the given gap", "not solved",
                                       "wrong"};

enum { REASONS = 60, SECONDS_AIM = 5, SECONDS_TOLD = 20, SECONDS_MAX = 60 };
static struct {
    char text[200];
    int count;
} reasons[REASONS];

/* Lines that differ in their numbers alone are one reason. */
static void count_reason(const char *kind, const char *text)
{
    char key[200];
    size_t n = (size_t)snprintf(key, sizeof key, "%s: ", kind);
    int in_number = 0;
    for (; *text && *text != '\n' && n + 2 < sizeof key; text++) {
        const int digit =
            (*text >= '0' && *text <= '9') || (in_number && strchr(".e+-", *text) != NULL);
        if (!digit || !in_number)
            key[n++] = digit ? '#' : *text;
        in_number = digit;
    }
    key[n] = '\0';
    for (int k = 0; k < REASONS; k++)
        if (!reasons[k].count || strcmp(reasons[k].text, key) == 0) {
            memcpy(reasons[k].text, key, n + 1);
            reasons[k].count++;
            return;
        }
}

/* Of the processor, by all children so far. */
static double seconds_so_far(void)
{
    struct rusage used;
    getrusage(RUSAGE_CHILDREN, &used);
    return (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

/* What became of the case; the seconds of the processor it took. */
static int run_case(int k, double *seconds)
{
    char command[2000];
    make_case(k);
    /* who runs the tests may allow less already */
    snprintf(command, sizeof command,
             "(ulimit -t %d) 2>/dev/null && ulimit -t %d; \"$R\"%s --json >json", SECONDS_MAX,
             SECONDS_MAX, line);
    const double start = seconds_so_far();
    const int code = shell(command);
    *seconds = seconds_so_far() - start;
    if (*seconds > SECONDS_TOLD + 2 && !strstr(err, " s of the processor so far")) {
        print_error("case %d takes %.0f s without a word:%s\n", k, *seconds, line);
        return WRONG;
    }
    if (code == 64 || code == 65) {
        const int one_line =
            strncmp(err, "rollbem: ", 9) == 0 && strchr(err, '\n') && !strchr(err, '\n')[1];
        count_reason("refused", err + 9);
        return one_line ? REFUSED : WRONG;
    }
    if (code == 1) {
        const char *last = strstr(err, "rollbem: ");
        for (const char *more; last && (more = strstr(last + 9, "rollbem: ")); last = more)
            ;
        /* high friction between unlike bodies widens the contact: such a case has no
         * answer where its table of the gap says nothing any more */
        if (last && strstr(last, "the gap table or the wheel has x") &&
            strstr(line, "--gap gap.txt")) {
            count_reason("beyond the given gap", last + 9);
            return BEYOND;
        }
        count_reason("not solved", last ? last + 9 : err);
        if (getenv("HOSTILE"))
            print_message("case %d is not solved:%s\n", k, line);
        return last ? UNSOLVED : WRONG;
    }
    if (code == 128 + SIGKILL) {
        count_reason("not solved", "not within the seconds of the processor allowed");
        print_message("case %d takes more than %d s:%s\n", k, SECONDS_MAX, line);
        return UNSOLVED;
    }
    if (code != 0) {
        print_error("case %d:%s\n    ends with %d: %.300s\n", k, line, code, err);
        return WRONG;
    }
    if (shellf("%s json", checker) == 0)
        return SOLVED;
    print_error("case %d:%s\n    %.600s\n", k, line, out);
    count_reason("wrong", out);
    return WRONG;
}

static int asked(const char *name, int otherwise)
{
    return getenv(name) ? atoi(getenv(name)) : otherwise;
}

TEST(hostile_cases_are_right_or_say_why_not)
{
    const char *turn = getenv("ROLLBEM_TEST_TURN");
    const int from = asked("HOSTILE_FROM", turn ? atoi(turn) % 4 * 30 : 0),
              n = asked("HOSTILE", 30);
    int count[ENDS] = {0}, slowest = 0;
    double most = 0.0, seconds;
    for (int k = from; k < from + n; k++) {
        count[run_case(k, &seconds)]++;
        if (seconds > SECONDS_AIM && getenv("HOSTILE"))
            print_message("case %d takes %.1f s:%s\n", k, seconds, line);
        if (seconds > most) {
            most = seconds;
            slowest = k;
        }
    }
    if (getenv("HOSTILE")) {
        for (int e = 0; e < ENDS; e++)
            print_message("%s: %d\n", ends[e], count[e]);
        make_case(slowest);
        print_message("slowest: case %d, %.2f s:%s\n", slowest, most, line);
        for (int k = 0; k < REASONS && reasons[k].count; k++)
            print_message("%6d %s\n", reasons[k].count, reasons[k].text);
    }
    assert_int_equal(count[WRONG], 0);
}

/* Large friction between unlike bodies, where every other element opens: of these one was
 * not solved in 11 s of the processor, the other took 22 s. */
TEST(winding_paths_are_left_for_others)
{
    static const int cases[] = {9100, 17680};
    double seconds;
    with_more = 0;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        if (!is_in_turn((int)k, 2))
            continue;
        assert_int_equal(run_case(cases[k], &seconds), SOLVED);
        assert_true(seconds < SECONDS_AIM);
    }
    with_more = 1;
}

int main(void)
{
    const char *build = getenv("B") ? getenv("B") : "build";
    char here[400];
    if (!getcwd(here, sizeof here))
        return 1;
    snprintf(checker, sizeof checker,
             build[0] == '/' ? "%.0s%s/tests/checker" : "%s/%s/tests/checker", here, build);
    return run_all_tests(enter_folder, leave_folder);
}
