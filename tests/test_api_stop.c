/* rb_api_stop from another thread: every call that takes long ends soon with RB_INTERRUPTED,
 * and the handle goes on as if the call had never been made.  Under the address sanitizer the
 * same tests find memory that a stopped call leaves behind or uses after it is freed. */
#include "check.h"
#include "rollbem/api.h"

#include <pthread.h>
#include <time.h>

static double seconds(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void rest(double duration)
{
    const struct timespec t = {(time_t)duration, (long)(1e9 * (duration - floor(duration)))};
    nanosleep(&t, NULL);
}

/* Sets options, "name value name value ...". */
static void give(rb_api *a, const char *options)
{
    char text[300], *rest_of = text;

    snprintf(text, sizeof text, "%s", options);
    for (char *name; (name = strtok_r(rest_of, " ", &rest_of));)
        if (rb_api_set(a, name, strtok_r(NULL, " ", &rest_of)) != RB_OK)
            fail_msg("%s", rb_api_message(a));
}

/* ---- Calls that take long ------------------------------------------------------------ */

static int curve(rb_api *a)
{
    return rb_api_curve(a, "creep-ratio", 0.0, 1.5, 1000, NULL, NULL);
}

static int curve_derivatives(rb_api *a)
{
    return rb_api_curve(a, "creep-ratio", 0.0, 1.5, 1000, "all", "mu=0.02");
}

static int guess(rb_api *a)
{
    int zone[400] = {0};
    for (int i = 100; i < 300; i++)
        zone[i] = 1;
    return rb_api_guess(a, 400, zone);
}

static int stress(rb_api *a)
{
    return rb_api_stress(a, 1000, 1000, 0.0);
}

static int stress_at(rb_api *a)
{
    enum { POINTS = 300000 };
    SCRATCH double *xy = NOT_NULL(rb_alloc(POINTS, 2));

    for (int k = 0; k < POINTS; k++) {
        xy[2 * k] = 0.3 * sin(k);
        xy[2 * k + 1] = 1.0 + 1e-6 * k;
    }
    return rb_api_stress_at(a, POINTS, xy);
}

static int maxima(rb_api *a)
{
    return rb_api_stress_maxima(a, 0.0);
}

static int step_derivatives(rb_api *a)
{
    return rb_api_step_derivatives(a, "all", "mu=0.02");
}

static int tolerances(rb_api *a)
{
    return rb_api_tolerances(a, "mu=0.02,radius=1%");
}

static int wear(rb_api *a)
{
    return rb_api_wear(a, "archard", 1e-9, 0.0, NAN, 1e6, 1000, 8);
}

static int crack(rb_api *a)
{
    const char *const names[] = {"crack-angle", "passes"}, *const values[] = {"30", "1000"};
    return rb_api_crack(a, 2, names, values);
}

static int growth(rb_api *a)
{
    const char *const names[] = {"crack-angle", "paris", "grow-to", "grow-steps"},
                      *const values[] = {"30", "1e-10,3", "3", "60"};
    return rb_api_crack(a, 4, names, values);
}

static int fit(rb_api *a)
{
    enum { POINTS = 200 };
    const char *const columns[] = {"creep", "force"};
    double data[2 * POINTS];

    for (int k = 0; k < POINTS; k++) {
        data[k] = 1e-5 * (k + 1);
        data[POINTS + k] = -150.0 * tanh(k / 80.0);
    }
    return rb_api_fit(a, 2, columns, POINTS, data, "mu,young", NULL, NULL, NAN, 0.95);
}

static int design(rb_api *a)
{
    return rb_api_design(a, "dissipation", 0, "radius=20:200,young=1e4:3e5", NULL, NAN, 1000);
}

/* Murty's example, whose path has 2^n pivots; w of a chain of springs, which Newton's method
 * frees one by one. */
static int lcp(rb_api *a, const char *solver, int n, int chain)
{
    SCRATCH double *M = NOT_NULL(rb_alloc((size_t)n, (size_t)n));
    SCRATCH double *q = NOT_NULL(rb_alloc((size_t)n, 1));

    for (int i = 0; i < n; i++) {
        for (int j = 0; j < i && !chain; j++)
            M[i + j * n] = 2.0;
        if (chain && i > 0)
            M[i + (i - 1) * n] = M[i - 1 + i * n] = -1.0;
        M[i + i * n] = chain ? 2.0 : 1.0;
        q[i] = chain ? -1e-3 * (1.0 + sin(1.7 * i)) : -1.0;
    }
    return rb_api_lcp(a, n, M, q, solver, 2000000000);
}

static int lcp_lemke(rb_api *a)
{
    return lcp(a, "lemke", 30, 0);
}

static int lcp_sparse(rb_api *a)
{
    return lcp(a, "lemke-sparse", 1500, 1);
}

static int lcp_newton(rb_api *a)
{
    return lcp(a, "newton", 1500, 1);
}

static int friction(rb_api *a, const char *solver)
{
    enum { CONTACTS = 60, N = 3 * CONTACTS };
    SCRATCH double *W = NOT_NULL(rb_alloc(N, N));
    double q[N], mu[CONTACTS];

    /* nearly singular, so that nobody reaches the tolerance */
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++)
            W[i + j * N] = cos(0.7 * (i - j)) + (i == j ? 1e-9 : 0.0);
        q[i] = i % 3 == 0 ? -1.0 : sin(i);
        mu[i / 3] = 0.7;
    }
    return rb_api_friction(a, 3, CONTACTS, W, q, mu, solver, 1e-15, 2000000000);
}

static int friction_auto(rb_api *a)
{
    return friction(a, "auto");
}

static int friction_sweeps(rb_api *a)
{
    return friction(a, "nsgs-ac");
}

static int friction_newton(rb_api *a)
{
    return friction(a, "extragradient");
}

/* So many cases, which the study borrows. */
static int sweep(rb_api *a, int cracks, const char *derivatives)
{
    enum { CASES = 60 };
    rb_api *cases[CASES];
    const char *const names[] = {"crack-angle"}, *values[CASES];

    for (int k = 0; k < CASES; k++) {
        cases[k] = NOT_NULL(rb_api_create_for(cracks ? "crack" : "sweep"));
        give(cases[k], "support halfplane similar yes formulation steady load 500 creep-ratio 0.5 "
                       "contact-elements 400");
        values[k] = "30";
    }
    const int s = cracks        ? rb_api_sweep_cracks(a, CASES, cases, 1, names, values, 2)
                  : derivatives ? rb_api_sweep(a, CASES, cases, derivatives, NULL, 2)
                                : rb_api_sweep(a, CASES, cases, NULL, NULL, 2);
    for (int k = 0; k < CASES; k++)
        rb_api_free(cases[k]);
    return s;
}

static int sweep_alone(rb_api *a)
{
    return sweep(a, 0, NULL);
}

static int sweep_derivatives(rb_api *a)
{
    return sweep(a, 0, "tangential_load");
}

static int sweep_cracks(rb_api *a)
{
    return sweep(a, 1, NULL);
}

static int matrix(rb_api *a)
{
    int rows, columns;
    return rb_api_array(a, "H", &rows, &columns) ? RB_OK : RB_INTERRUPTED;
}

/* ---- The same calls, short ------------------------------------------------------------ */

static int small_curve(rb_api *a)
{
    return rb_api_curve(a, "creep-ratio", 0.0, 1.5, 3, NULL, NULL);
}

static int small_curve_derivatives(rb_api *a)
{
    return rb_api_curve(a, "creep-ratio", 0.1, 0.9, 2, "tangential_load", "mu=0.02");
}

static int small_stress(rb_api *a)
{
    return rb_api_stress(a, 5, 4, 0.0);
}

static int small_wear(rb_api *a)
{
    return rb_api_wear(a, "archard", 1e-9, 0.0, NAN, 1e4, 2, 2);
}

static int small_crack(rb_api *a)
{
    const char *const names[] = {"crack-angle", "crack-elements"}, *const values[] = {"30", "6"};
    return rb_api_crack(a, 2, names, values);
}

static int small_growth(rb_api *a)
{
    const char *const names[] = {"crack-angle", "crack-elements", "paris", "grow-to", "grow-steps"},
                      *const values[] = {"30", "6", "1e-10,3", "2", "2"};
    return rb_api_crack(a, 5, names, values);
}

static int small_fit(rb_api *a)
{
    const double data[] = {1e-4, 3e-4, 6e-4, 1e-3, -40.0, -85.0, -120.0, -140.0};
    return rb_api_fit(a, 2, (const char *const[]){"creep", "force"}, 4, data, "mu,young", NULL,
                      NULL, NAN, 0.95);
}

static int small_design(rb_api *a)
{
    return rb_api_design(a, "max_pressure", 0, "radius=40:60", NULL, NAN, 20);
}

static int small_lemke(rb_api *a)
{
    return lcp(a, "lemke", 5, 0);
}

static int small_sparse(rb_api *a)
{
    return lcp(a, "lemke-sparse", 5, 0);
}

static int small_newton(rb_api *a)
{
    return lcp(a, "newton", 20, 1);
}

static int small_auto(rb_api *a)
{
    return lcp(a, "auto", 5, 0);
}

static int small_friction(rb_api *a)
{
    const double W[] = {2, 0, 1, 0, 0, 2, 0, 1, 1, 0, 2, 0, 0, 1, 0, 2}, q[] = {-1, 2, -1, -0.1},
                 mu[] = {0.5, 0.5};
    return rb_api_friction(a, 2, 2, W, q, mu, "auto", 1e-10, 0);
}

#define HALFPLANE "support halfplane load 500 similar yes "
#define ROLLING HALFPLANE "formulation steady "
#define STEADY ROLLING "creep-ratio 0.5 "
#define TRANSIENT HALFPLANE "formulation transient creep-ratio 0.5 mesh uniform "

typedef struct {
    const char *name, *purpose, *options;
    int is_asked_of_a_solution; /* the call needs the solved case */
    int may_end;                /* it may be too short to be stopped */
    int (*call)(rb_api *a);
} job;

static const job jobs[] = {
    {"wheel", "solve", "support arc contact-elements 1000 outer-elements 4000", 0, 0, rb_api_solve},
    {"sleeve", "solve", "support hub cover-thickness 5 contact-elements 1900 load 500", 0, 0,
     rb_api_solve},
    {"Lemke", "solve", STEADY "contact-elements 900 mesh uniform solver lemke", 0, 0, rb_api_solve},
    {"Newton", "solve", STEADY "contact-elements 1500 mesh fitted", 0, 0, rb_api_solve},
    {"cone", "solve",
     "support halfplane load 500 contact-elements 400 force-ratio 0.5 solver nsgs-ac", 0, 0,
     rb_api_solve},
    {"transforms", "solve", STEADY "contact-elements 60000 mesh uniform", 0, 0, rb_api_solve},
    {"yield", "solve", STEADY "contact-elements 900 mesh uniform yield-stress 30", 0, 1,
     rb_api_solve},
    {"law", "solve",
     STEADY "contact-elements 900 friction-law exponential mu-fall 0.2 slip-scale 1 speed 1000", 0,
     0, rb_api_solve},
    {"error bars", "solve", STEADY "contact-elements 1000 mesh fitted error yes", 0, 0,
     rb_api_solve},
    {"history", "solve", TRANSIENT "contact-elements 200 distance 500", 0, 0, rb_api_solve},
    {"curve", "curve", ROLLING "contact-elements 300", 0, 0, curve},
    {"curve's derivatives", "curve", ROLLING "contact-elements 100", 0, 0, curve_derivatives},
    {"pivots", "solve", STEADY "contact-elements 400 mesh uniform solver newton", 1, 0,
     rb_api_pivots},
    {"Newton's steps", "solve", STEADY "contact-elements 400 mesh uniform", 1, 1, rb_api_newton},
    {"guess", "solve", STEADY "contact-elements 400 mesh uniform", 1, 1, guess},
    {"boundary elements", "solve", "contact-elements 40 outer-elements 1500", 1, 1, matrix},
    {"stress", "stress", HALFPLANE, 1, 0, stress},
    {"stress of a wheel", "stress", "support hub load 500", 1, 0, stress},
    {"stress below a layer", "stress", "support halfplane load 500 layer-thickness 5", 1, 0,
     stress},
    {"stress at points", "stress", "support hub load 500", 1, 0, stress_at},
    {"maxima", "stress", "support hub load 500 contact-elements 400", 1, 0, maxima},
    {"derivatives", "solve", "support hub contact-elements 100 outer-elements 400 load 500", 1, 0,
     rb_api_derivatives},
    {"smooth derivatives", "solve", STEADY "contact-elements 400", 1, 0, rb_api_smooth_derivatives},
    {"tolerances", "solve", STEADY "contact-elements 400", 1, 0, tolerances},
    {"derivatives of steps", "solve", TRANSIENT "contact-elements 60 distance 3", 1, 0,
     step_derivatives},
    {"wear", "wear", HALFPLANE "force-ratio 0.5 contact-elements 100", 0, 0, wear},
    {"crack", "crack", STEADY, 0, 0, crack},
    {"crack of a large contact", "crack", STEADY "contact-elements 1500", 0, 0, crack},
    {"growth", "crack", STEADY, 0, 0, growth},
    {"fit", "solve", ROLLING "contact-elements 200", 0, 0, fit},
    {"design", "solve", STEADY "contact-elements 600", 0, 0, design},
    {"LCP, Lemke", "solve", "", 0, 0, lcp_lemke},
    {"LCP, sparse", "solve", "", 0, 0, lcp_sparse},
    {"LCP, Newton", "solve", "", 0, 0, lcp_newton},
    {"friction, auto", "solve", "", 0, 0, friction_auto},
    {"friction, sweeps", "solve", "", 0, 0, friction_sweeps},
    {"friction, projection", "solve", "", 0, 0, friction_newton},
    {"sweep", "sweep", "", 0, 0, sweep_alone},
    {"sweep with derivatives", "sweep", "", 0, 0, sweep_derivatives},
    {"sweep of cracks", "sweep", "", 0, 0, sweep_cracks},
};

/* ---- Stopped by another thread ------------------------------------------------------- */

typedef struct {
    rb_api *a;
    int (*call)(rb_api *a);
    int is_over;
    int status;
} running;

static void *run(void *context)
{
    running *r = context;
    r->status = r->call(r->a);
    __atomic_store_n(&r->is_over, 1, __ATOMIC_RELEASE);
    return NULL;
}

/* The status of the call, which is stopped after so many seconds; how long it went on, in
 * *late: of the processor, where other programs wait for it too. */
static int stopped_after(rb_api *a, int (*call)(rb_api *), double delay, double *late)
{
    running r = {.a = a, .call = call};
    pthread_t thread;

    assert_int_equal(pthread_create(&thread, NULL, run, &r), 0);
    rest(delay);
    const double began = seconds(CLOCK_MONOTONIC), used = seconds(CLOCK_PROCESS_CPUTIME_ID);
    rb_api_stop_until(a, &r.is_over);
    *late = fmin(seconds(CLOCK_MONOTONIC) - began, seconds(CLOCK_PROCESS_CPUTIME_ID) - used);
    pthread_join(thread, NULL);
    return r.status;
}

/* All of them took longer than this before they looked at rb_api_stop. */
static const double SOON = 8.0;

static double load_of(rb_api *a, const char *options)
{
    give(a, options);
    if (rb_api_solve(a) != RB_OK)
        fail_msg("%s", rb_api_message(a));
    return rb_api_number(a, "tangential_load");
}

TEST(every_long_call_can_be_stopped)
{
    static const char small[] = "support halfplane formulation steady load 300 creep-ratio 0.4 "
                                "contact-elements 20 mesh uniform";
    const char *only = getenv("ROLLBEM_STOP");

    for (size_t k = 0; k < sizeof jobs / sizeof *jobs; k++) {
        const job *j = &jobs[k];
        if (only ? !strstr(j->name, only) : !is_in_turn((int)k, 8))
            continue;
        held_api *a = NOT_NULL(rb_api_create_for(j->purpose));
        give(a, j->options);
        if (j->is_asked_of_a_solution && rb_api_solve(a) != RB_OK)
            fail_msg("%s: %s", j->name, rb_api_message(a));
        double late;
        int s = stopped_after(a, j->call, k % 2 ? 0.0 : 0.02, &late);
        /* on a busy machine a call of a tenth of a second may be over before the stop comes */
        for (int again = 0; again < 8 && s == RB_OK && !j->may_end; again++)
            s = stopped_after(a, j->call, 0.0, &late);
        if (only)
            print_message("%s: %d, %.3f s, %s\n", j->name, s, late, rb_api_message(a));
        if (s != RB_INTERRUPTED && !(s == RB_OK && j->may_end))
            fail_msg("%s: status %d: %s", j->name, s, rb_api_message(a));
        if (s == RB_INTERRUPTED && j->call != matrix && !strstr(rb_api_message(a), "interrupted"))
            fail_msg("%s: '%s'", j->name, rb_api_message(a));
        CHECK_MAX(late, SOON, "%s: seconds after the stop", j->name);
        /* the same call, which a stop must not have spoilt, and another case */
        stopped_after(a, j->call, 0.0, &late);
        CHECK_MAX(late, SOON, "%s again: seconds after the stop", j->name);
        if (strcmp(j->purpose, "solve") == 0 && *j->options == '\0') {
            held_api *fresh = NOT_NULL(rb_api_create());
            const double got = load_of(a, small), want = load_of(fresh, small);
            CHECK_ABS(got, want, 0.0, "%s: the next case", j->name);
        }
    }
}

/* ---- Stopped at every question -------------------------------------------------------- */

/* The same calls on small cases: the interruption comes when it is asked for so often. */
static const job small[] = {
    {"wheel", "solve", "support arc contact-elements 16 outer-elements 40", 0, 0, rb_api_solve},
    {"hub", "solve",
     "support hub load 300 formulation steady creep-ratio 0.4 contact-elements 20 mesh fitted", 0,
     0, rb_api_solve},
    {"sleeve", "solve",
     "support hub cover-thickness 5 contact-elements 20 load 300 core-young 2e4 core-poisson 0.3",
     0, 0, rb_api_solve},
    {"long wheel", "solve", "support arc contact-elements 10 outer-elements 2200", 0, 0,
     rb_api_solve},
    {"Lemke", "solve", STEADY "contact-elements 30 mesh uniform solver lemke", 0, 0, rb_api_solve},
    {"Newton", "solve", STEADY "contact-elements 130 mesh fitted", 0, 0, rb_api_solve},
    {"aligned", "solve", STEADY "contact-elements 130 mesh aligned", 0, 0, rb_api_solve},
    {"force", "solve", ROLLING "force-ratio -0.5 contact-elements 40", 0, 0, rb_api_solve},
    {"cone", "solve",
     "support halfplane load 500 contact-elements 12 force-ratio 0.5 solver nsgs-ac", 0, 0,
     rb_api_solve},
    {"transforms", "solve", STEADY "contact-elements 2500 mesh uniform", 0, 0, rb_api_solve},
    {"unlike bodies", "solve",
     "support halfplane load 500 formulation steady creep-ratio 0.5 contact-elements 40", 0, 0,
     rb_api_solve},
    {"layer", "solve", "support halfplane load 500 layer-thickness 2 contact-elements 20", 0, 0,
     rb_api_solve},
    {"memory", "solve",
     "support halfplane load 5 formulation steady creep-ratio 0.5 relaxation-time 0.01 "
     "relaxation-ratio 2 speed 1000 contact-elements 20",
     0, 0, rb_api_solve},
    {"yield", "solve", STEADY "contact-elements 30 mesh uniform yield-stress 30", 0, 0,
     rb_api_solve},
    {"law", "solve",
     STEADY "contact-elements 20 friction-law exponential mu-fall 0.2 slip-scale 1 speed 1000", 0,
     0, rb_api_solve},
    {"error bars", "solve", STEADY "contact-elements 20 error yes", 0, 0, rb_api_solve},
    {"accuracy", "solve", STEADY "contact-elements 20 accuracy 0.01", 0, 0, rb_api_solve},
    {"history", "solve", TRANSIENT "contact-elements 12 distance 1", 0, 0, rb_api_solve},
    {"relaxing history", "solve",
     "support halfplane formulation transient load 5 creep-ratio 0.5 mesh uniform contact-elements "
     "10 distance 1 relaxation-time 0.01 relaxation-ratio 2 speed 100",
     0, 0, rb_api_solve},
    {"history with error bars", "solve", TRANSIENT "contact-elements 12 distance 0.5 error yes", 0,
     0, rb_api_solve},
    {"curve", "curve", ROLLING "contact-elements 20", 0, 0, small_curve},
    {"curve's derivatives", "curve", ROLLING "contact-elements 20", 0, 0, small_curve_derivatives},
    {"pivots", "solve", STEADY "contact-elements 12 mesh uniform", 1, 0, rb_api_pivots},
    {"Newton's steps", "solve", STEADY "contact-elements 40 mesh uniform", 1, 0, rb_api_newton},
    {"boundary elements", "solve", "contact-elements 10 outer-elements 30", 1, 0, matrix},
    {"stress", "stress", HALFPLANE "contact-elements 20", 1, 0, small_stress},
    {"stress of a wheel", "stress", "support hub load 500 contact-elements 20", 1, 0, small_stress},
    {"stress below a layer", "stress",
     "support halfplane load 500 layer-thickness 5 contact-elements 20", 1, 0, small_stress},
    {"maxima", "stress", "support hub load 500 contact-elements 12 outer-elements 30", 1, 0,
     maxima},
    {"derivatives", "solve", STEADY "contact-elements 20", 1, 0, rb_api_derivatives},
    {"derivatives of a wheel", "solve",
     "support hub load 500 contact-elements 10 outer-elements 30", 1, 0, rb_api_derivatives},
    {"smooth derivatives", "solve", STEADY "contact-elements 20", 1, 0, rb_api_smooth_derivatives},
    {"tolerances", "solve", STEADY "contact-elements 20", 1, 0, tolerances},
    {"derivatives of steps", "solve", TRANSIENT "contact-elements 10 distance 0.5", 1, 0,
     step_derivatives},
    {"wear", "wear", HALFPLANE "force-ratio 0.5 contact-elements 12", 0, 0, small_wear},
    {"wear of a wheel", "wear", STEADY "contact-elements 12", 0, 0, small_wear},
    {"crack", "crack", STEADY "contact-elements 20", 0, 0, small_crack},
    {"growth", "crack", STEADY "contact-elements 20", 0, 0, small_growth},
    {"fit", "solve", ROLLING "contact-elements 20", 0, 0, small_fit},
    {"design", "solve", STEADY "contact-elements 20", 0, 0, small_design},
    {"LCP, Lemke", "solve", "", 0, 0, small_lemke},
    {"LCP, sparse", "solve", "", 0, 0, small_sparse},
    {"LCP, Newton", "solve", "", 0, 0, small_newton},
    {"LCP, auto", "solve", "", 0, 0, small_auto},
    {"friction", "solve", "", 0, 0, small_friction},
};

typedef struct {
    int asked, at; /* at: the question from which on the answer is yes; -1: none */
} questions;

static int count(void *context)
{
    questions *q = context;
    return q->asked++ >= q->at && q->at >= 0;
}

static rb_api *begun(const job *j)
{
    rb_api *a = NOT_NULL(rb_api_create_for(j->purpose));
    give(a, j->options);
    if (j->is_asked_of_a_solution && rb_api_solve(a) != RB_OK)
        fail_msg("%s: %s", j->name, rb_api_message(a));
    return a;
}

static int ask(rb_api *a, const job *j, questions *q)
{
    q->asked = 0;
    const rb_interrupt before = rb_interrupt_by((rb_interrupt){count, q});
    const int s = j->call(a);
    rb_interrupt_by(before);
    return s;
}

/* So many of the questions that a call asks are answered with yes, each in a run of its own: the
 * call is interrupted, and afterwards the same call on the same handle does what it does on a fresh
 * one, as do bodies that are kept for a case that differs in what drives it. */
TEST(a_call_may_be_stopped_at_any_question)
{
    const int tries = getenv("ROLLBEM_TEST_ALL") ? 48 : 9;
    const char *only = getenv("ROLLBEM_STOP");

    for (size_t k = 0; k < sizeof small / sizeof *small; k++) {
        const job *j = &small[k];
        questions q = {.at = -1};
        if (only ? !strstr(j->name, only) : !is_in_turn((int)k, 8))
            continue;
        held_api *first = begun(j); /* tables of layers, which the process keeps, ask once */
        ask(first, j, &q);
        held_api *whole = begun(j);
        const int want = ask(whole, j, &q), all = q.asked;
        if (only)
            print_message("%s: %d, %d questions\n", j->name, want, all);
        if (want != RB_OK)
            fail_msg("%s: %s", j->name, rb_api_message(whole));
        assert_true(all > 0);
        const double load = rb_api_number(whole, "tangential_load");
        for (int try = 0; try < tries && try < all; try++) {
            q.at = all <= tries || try < tries / 3 ?
            try:
                (int)((double)all * (try - tries / 3 + 1) / (tries - tries / 3 + 1));
            held_api *a = begun(j);
            const int s = ask(a, j, &q);
            if (s != RB_INTERRUPTED ||
                (j->call != matrix && !strstr(rb_api_message(a), "interrupted")))
                fail_msg("%s, question %d of %d: status %d, '%s'", j->name, q.at, all, s,
                         rb_api_message(a));
            if (try % 4 == 0) {
                if (j->call == rb_api_solve) /* bodies may be kept */
                    give(a, "mu 0.299 mu 0.3");
                assert_int_equal(j->call(a), RB_OK);
                const double again = rb_api_number(a, "tangential_load");
                /* the address of their buffers decides how transforms round */
                if (!isnan(load))
                    CHECK_REL(again, load, strcmp(j->name, "transforms") ? 0.0 : 1e-9,
                              "%s after question %d", j->name, q.at);
            }
        }
    }
}

RUN_TESTS(NULL, NULL)
