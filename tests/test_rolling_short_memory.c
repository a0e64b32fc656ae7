/* Each call that leads to an allocation sees one fail, in every task of the folder: the
 * answer is RB_ENOMEM, or the task does without; nothing is lost or freed twice (make
 * asan). */
#include "cases.h"
#include "check.h"
#include "rolling/rolling.h"

typedef struct {
    rb_rolling_case rc;
    rb_rolling_model model;
    rb_message why;
} task;

/* A wheel R = 50 of similar half-planes, of few elements, with these words besides. */
static rb_rolling_case few(rb_rolling_formulation formulation, int elements, const char *words)
{
    rb_rolling_case rc = half_plane(formulation, elements);
    if (formulation != RB_STATIC)
        rc.creep_ratio = 0.5;
    set(&rc, "load 500 zone %g speed 1000 distance 0.3", elements < 12 ? 1.0 : 0.0);
    return with(rc, "%s", words);
}

#define FALLING "friction-law exponential mu-fall 0.1 slip-scale 1 "
#define WARM "conductivity 40 heat-capacity 3.5 conductivity-b 20 heat-capacity-b 3.5 "
#define RELAXING "relaxation-time 1e-4,1e-3 relaxation-ratio 0.5,0.5 zone 3 "
#define YIELDING "interlayer-tangential 1e-5 yield-stress 50 "
#define WHEEL "support hub outer-elements 24 "

/* ---- Tasks ------------------------------------------------------------------------- */

static rb_status solve_in_context(void *context)
{
    task *t = context;
    OWNED(rb_rolling_solution) s;
    return rb_rolling_solve(&t->rc, &s, &t->why);
}

static rb_status curve_over(rb_rolling_variable over, double from, double to, task *t)
{
    const rb_rolling_range range = {.over = over, .from = from, .to = to, .points = 2};
    rb_rolling_curve curve, errors;
    const rb_status s =
        t->rc.contact_elements < 12
            ? rb_rolling_curve_solve(&t->rc, &range, &curve, &t->why)
            : rb_rolling_curve_with_errors(&t->rc, &range, NULL, NULL, &curve, &errors, &t->why);
    rb_rolling_curve_free(&curve);
    if (t->rc.contact_elements >= 12)
        rb_rolling_curve_free(&errors);
    return s;
}

static rb_status curve(void *context)
{
    return curve_over(RB_OVER_CREEP_RATIO, 0.1, 0.8, context);
}

static rb_status curve_of_speeds(void *context)
{
    return curve_over(RB_OVER_SPEED, 1000.0, 2000.0, context);
}

static rb_status history(void *context)
{
    task *t = context;
    OWNED(rb_rolling_history) h;
    const rb_status s = rb_rolling_history_with_errors(&t->rc, NULL, NULL, &t->model, &h, &t->why);
    rb_rolling_model_free(&t->model);
    return s;
}

static rb_status history_in_time(void *context)
{
    static const double time[] = {0.0, 1e-3}, load[] = {300.0, 500.0};
    static const rb_rolling_program program = {.n = 2, .time = time, .load = load};
    task *t = context;
    OWNED(rb_rolling_history) h;
    const rb_status s = rb_rolling_history_run(&t->rc, &program, NULL, &t->model, &h, &t->why);
    rb_rolling_model_free(&t->model);
    return s;
}

static rb_status wear_by(const rb_rolling_wear *wear, task *t)
{
    OWNED(rb_rolling_wear_history) h;
    OWNED(rb_rolling_solution) last;
    return rb_rolling_wear_run(&t->rc, wear, NULL, &h, &last, &t->why);
}

static rb_status slide(void *context)
{
    const rb_rolling_wear wear = {.slides = 1, .coefficient = 1e-8, .way = 1e4, .steps = 2};
    return wear_by(&wear, context);
}

static rb_status fret(void *context)
{
    const rb_rolling_wear wear = {.coefficient = 1e-8, .way = 10.0, .steps = 1, .increments = 1};
    return wear_by(&wear, context);
}

static rb_status turn(void *context)
{
    const rb_rolling_wear wear = {
        .law = RB_WEAR_DISSIPATION, .coefficient = 1e-9, .way = 1e4, .steps = 1};
    return wear_by(&wear, context);
}

static rb_status with_model(task *t, rb_status (*use)(task *t))
{
    rb_status s = rb_rolling_model_create(&t->rc, &t->model, &t->why);
    if (s == RB_OK)
        s = use(t);
    rb_rolling_model_free(&t->model);
    return s;
}

static rb_status use_solutions(task *t)
{
    OWNED(rb_rolling_solutions) all;
    return rb_rolling_find_solutions(&t->model, &all, &t->why);
}

static rb_status use_stress(task *t)
{
    const double xy[] = {0.0, 0.5, 0.3, 0.2};
    rb_rolling_stress at[2];
    rb_rolling_stress_grid grid;
    OWNED(rb_rolling_stress_maxima) maxima = {.bonds = 0};
    rb_rolling_shakedown shakedown;
    rb_status s = rb_rolling_stress_at(&t->model, 2, xy, at, &t->why);
    if (s == RB_OK)
        s = rb_rolling_stress_on_grid(&t->model, 2, 3, 0.0, &grid, &t->why);
    if (s == RB_OK)
        rb_rolling_stress_grid_free(&grid);
    if (s == RB_OK)
        s = rb_rolling_stress_maxima_find(&t->model, 0.0, &maxima, &t->why);
    return s == RB_OK && t->rc.a.support == RB_BEM_HALFPLANE
               ? rb_rolling_shakedown_find(&t->model, &shakedown, &t->why)
               : s;
}

static rb_status use_again(task *t)
{
    rb_rolling_case rc = t->rc;
    rb_contact_lcp lcp;
    rb_status s = rb_rolling_model_lcp(&t->model, &lcp, &t->why);
    if (s == RB_OK)
        rb_contact_lcp_free(&lcp);
    if (s == RB_OK)
        s = rb_rolling_model_friction(&t->model, &t->why);
    rc.load *= 1.1;
    return s == RB_OK ? rb_rolling_model_reuse(&rc, NULL, &t->model, &t->why) : s;
}

static rb_status solutions(void *context)
{
    return with_model(context, use_solutions);
}

static rb_status stress(void *context)
{
    return with_model(context, use_stress);
}

static rb_status again(void *context)
{
    return with_model(context, use_again);
}

static rb_status to_accuracy(void *context)
{
    task *t = context;
    OWNED(rb_rolling_solution) s;
    rb_rolling_errors errors;
    int elements;
    const rb_status status =
        rb_rolling_solve_to_accuracy(&t->rc, 0.4, &s, &errors, &elements, &t->why);
    return status;
}

/* A study whose rows come at once, by a pool that is no process. */
static int one_is_idle(rb_rolling_pool *pool)
{
    (void)pool;
    return 1;
}

static rb_status take(rb_rolling_pool *pool, int k)
{
    (void)pool;
    (void)k;
    return RB_OK;
}

static int give(rb_rolling_pool *pool, int milliseconds, int *k, rb_rolling_row *row)
{
    (void)pool;
    (void)milliseconds;
    *k = 0;
    *row = (rb_rolling_row){.solution.status = RB_OK};
    return 1;
}

static void rest(rb_rolling_pool *pool)
{
    (void)pool;
}

static int see(int k, const rb_rolling_row *row, void *context)
{
    (void)k;
    (void)row;
    (void)context;
    return 0;
}

static rb_status study(void *context)
{
    task *t = context;
    rb_rolling_pool pool = {one_is_idle, take, give, rest};
    const rb_rolling_sweep sweep = {.count = 1, .workers = 1, .see = see};
    return rb_rolling_sweep_by(&sweep, &pool, &t->why);
}

/* ---- All of them ------------------------------------------------------------------- */

static void fail_all(const char *name, rb_status (*work)(void *),
                     rb_rolling_formulation formulation, int elements, const char *words)
{
    static task t; /* it outlives a failure */
    t = (task){.rc = few(formulation, elements, words)};
    if (work(&t) != RB_OK)
        fail_msg("%s: %s", name, t.why.text);
    print_message("# %s: %d more failures of memory\n", name, alloc_fail_every_call(work, &t));
}

#define FAIL(work, ...) fail_all(#work ", " #__VA_ARGS__, work, __VA_ARGS__)

TEST(solutions_are_short_of_memory)
{
    FAIL(solve_in_context, RB_STEADY, 8, "poisson 0.3");
    FAIL(solve_in_context, RB_STEADY, 8, "slip-operator second");
    FAIL(solve_in_context, RB_STEADY, 8, YIELDING);
    FAIL(solve_in_context, RB_STEADY, 8, "mesh fitted poisson 0.3");
    FAIL(solve_in_context, RB_STEADY, 12, "mesh aligned");
    FAIL(solve_in_context, RB_STEADY, 8, WARM);
    FAIL(solve_in_context, RB_STEADY, 8, RELAXING);
    FAIL(solve_in_context, RB_STEADY, 8, WHEEL);
    FAIL(again, RB_STEADY, 8, "");
    FAIL(again, RB_STEADY, 8, FALLING WARM);
}

TEST(friction_laws_are_short_of_memory)
{
    FAIL(solve_in_context, RB_STEADY, 8, FALLING);
    FAIL(solve_in_context, RB_TRANSIENT, 8, FALLING);
    FAIL(solve_in_context, RB_STEADY, 8, FALLING "creep-ratio nan force-ratio -0.4");
    FAIL(solve_in_context, RB_STEADY, 8, FALLING WARM);
    FAIL(curve, RB_STEADY, 8, FALLING);
    FAIL(solutions, RB_STEADY, 6, FALLING);
}

TEST(tasks_are_short_of_memory)
{
    FAIL(curve, RB_STEADY, 12, "poisson 0.3");
    FAIL(curve, RB_STEADY, 8, WARM);
    FAIL(curve, RB_STEADY, 24, "mesh aligned");
    FAIL(curve_of_speeds, RB_STEADY, 8, RELAXING);
    FAIL(history, RB_TRANSIENT, 12, "");
    FAIL(solve_in_context, RB_TRANSIENT, 8, YIELDING);
    FAIL(solve_in_context, RB_TRANSIENT, 8, WARM);
    FAIL(solve_in_context, RB_TRANSIENT, 8, RELAXING);
    FAIL(history_in_time, RB_STATIC, 8, RELAXING);
    FAIL(slide, RB_STATIC, 8, "");
    FAIL(fret, RB_STATIC, 8, "creep-ratio nan force-ratio 0.5");
    FAIL(turn, RB_STEADY, 8, "");
    FAIL(stress, RB_STATIC, 8, "");
    FAIL(stress, RB_STATIC, 8, WHEEL);
    FAIL(to_accuracy, RB_STATIC, 12, "");
    FAIL(study, RB_STATIC, 12, "");
}

/* ---- How much it will be ----------------------------------------------------------- */

/* The table of docs/performance.md, "Memory"; c + s = 60 unknowns of 40 elements. */
TEST(bytes_are_those_of_the_documentation)
{
    rb_rolling_case rc = few(RB_STEADY, 40, "");
    const double n = 40.0;
    CHECK_REL(rb_rolling_bytes(&rc, 40, 0, 60), 8.0 * (6.0 * n * n + 3600.0 + 12.0 * n), 1e-15,
              "Newton, all tractions");
    CHECK_REL(rb_rolling_bytes(&rc, 40, 0, 20), 8.0 * (6.0 * n * n + n * n + 100.0 + 12.0 * n),
              1e-15, "Newton, half as many elements");
    rc.elastic_b = 1;
    CHECK_REL(rb_rolling_bytes(&rc, 40, 0, 0), 64.0 * n * n, 1e-15,
              "two bodies while they are added");
    rb_rolling_case rolls = with(rc, WHEEL);
    const double before = rb_rolling_bytes(&rolls, 40, 90, 60);
    rolls.a.memory = (rb_rolling_memory){1, {1.0}, {1.0}};
    CHECK_REL(rb_rolling_bytes(&rolls, 40, 90, 60) - before, 32.0 * n * n, 1e-12,
              "what a memory adds to a wheel");
    rolls.b.memory = rolls.a.memory;
    CHECK_REL(rb_rolling_bytes(&rolls, 40, 90, 60) - before, 64.0 * n * n, 1e-12, "to two bodies");
    rc.contact.solver = RB_SOLVER_LEMKE;
    CHECK_REL(rb_rolling_bytes(&rc, 40, 0, 60), 8.0 * 24.0 * n * n, 1e-15, "Lemke");
    rc.contact.lcp_form = RB_LCP_KWAK;
    CHECK_REL(rb_rolling_bytes(&rc, 40, 0, 60), 8.0 * 31.0 * n * n, 1e-15, "Kwak");
    set(&rc, "solver auto poisson 0.3");
    CHECK_REL(rb_rolling_bytes(&rc, RB_ROLLING_LARGE, 0, 0), 816.0 * RB_ROLLING_LARGE, 1e-15,
              "unlike bodies without a matrix");
    rc.b = rc.a;
    rc.b.radius = INFINITY;
    CHECK_REL(rb_rolling_bytes(&rc, RB_ROLLING_LARGE, 0, 0), 616.0 * RB_ROLLING_LARGE, 1e-15,
              "similar ones");
    rc = few(RB_STATIC, 40, "");
    rc.a.support = RB_BEM_HUB;
    const double both = rb_bem_system_bytes(200, 40);
    CHECK_REL(rb_rolling_bytes(&rc, 40, 200, 0), both, 1e-15, "a wheel");
    CHECK_REL(rb_rolling_bytes(&rc, 40, 200, 400),
              both + 8.0 * (6.0 * n * n + 160000.0 + 12.0 * n - 4.0 * 200.0 * n - 4.0 * n * n),
              1e-15, "where the contact needs more");
}

RUN_TESTS(NULL, NULL)
