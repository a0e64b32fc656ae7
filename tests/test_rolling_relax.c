/* Bodies that relax, step by step: static contact in time and transient rolling. */
#include "cases.h"
#include "check.h"
#include "check.h"
#include "rolling/rolling.h"

#include <gsl/gsl_math.h>

/* ---- Cases ------------------------------------------------------------------------- */

static const double F = 3.0, TAU = 1.0; /* of the bodies with one term */

static rb_rolling_case relaxing(int n)
{
    return rolling_case("support halfplane support-b halfplane radius 50 young 1000 poisson 0.3 "
                        "relaxation-time %g relaxation-ratio %g gap parabola mu 0 "
                        "contact-elements %d",
                        TAU, F, n);
}

static double modulus(const rb_rolling_case *rc)
{
    return rb_rolling_derive(rc).modulus;
}

/* p, gap, friction and its bound, from the printed columns; the gap from the
 * displacements. */
static void check_laws(const rb_rolling_case *rc, const rb_rolling_model *model)
{
    OWNED(rb_rolling_solution) s;
    CHECK_OK(rb_rolling_model_solution(model, &s, NULL));
    const double length = rb_rolling_derive(rc).half_width * s.max_pressure / modulus(rc);
    for (int i = 0; i < s.n; i++) {
        const double g = s.x[i] * s.x[i] / (2.0 * 50.0) + s.un[i] - s.approach;
        CHECK_ABS(s.gap[i], g, 1e-9 * length + 1e-13 * s.approach, "gap %d", i);
        CHECK_MAX(-s.p[i], 0.0, "pressure %d", i);
        CHECK_MAX(-g, 1e-8 * length, "overlap %d", i);
        CHECK_ABS(s.p[i] * g, 0.0, 1e-8 * length * s.max_pressure, "p y %d", i);
        CHECK_MAX(fabs(s.q[i]), rc->mu * s.p[i] + 1e-8 * s.max_pressure, "bound %d", i);
        CHECK_MAX(s.shift[i] * s.q[i], 1e-8 * length * s.max_pressure, "against %d", i);
    }
}

/* Returns the length of an element. */
static double run(const rb_rolling_case *rc, const rb_rolling_program *program,
                  rb_rolling_history *h)
{
    OWNED(rb_rolling_model) model;
    CHECK_OK(rb_rolling_history_run(rc, program, NULL, &model, h, &message));
    for (int k = 0; k < h->n; k++)
        CHECK_MAX(h->residual[k], 1e-9, "step %d", k);
    if (rc->elastic_b == 0)
        check_laws(rc, &model);
    return model.mesh.ends[1] - model.mesh.ends[0];
}

/* ---- Held approach ----------------------------------------------------------------- */

/* The contact stays, and every traction follows the relaxation modulus: that of one term
 * in closed form, of more by small steps of p + sum f_k v_k = 1, tau_k v_k' = p - v_k. */
static double relaxation_modulus(const rb_rolling_memory *memory, double t)
{
    enum { STEPS = 200000 };
    const double dt = t / STEPS;
    double v[RB_ROLLING_TERMS] = {0.0}, p = 1.0;
    if (memory->n == 1)
        return (1.0 + memory->ratio[0] * exp(-(1.0 + memory->ratio[0]) * t / memory->time[0])) /
               (1.0 + memory->ratio[0]);
    for (int k = 0; k < STEPS; k++)
        for (int half = 0; half < 2; half++) { /* Heun's half of a step, twice */
            double before = p;
            p = 1.0;
            for (int j = 0; j < memory->n; j++) {
                v[j] += 0.5 * dt * (before - v[j]) / memory->time[j];
                p -= memory->ratio[j] * v[j];
            }
        }
    return p;
}

/* support, body B, layer or cover, terms */
static const struct {
    const char *name;
    rb_bem_support support;
    int similar, terms;
    double layer, cover, bound;
} held[] = {{"half-plane", RB_BEM_HALFPLANE, 0, 1, 0.0, 0.0, 5e-4},
            {"two terms", RB_BEM_HALFPLANE, 0, 2, 0.0, 0.0, 5e-4},
            {"similar", RB_BEM_HALFPLANE, 1, 1, 0.0, 0.0, 5e-4},
            {"layer", RB_BEM_HALFPLANE, 0, 1, 4.0, 0.0, 5e-4},
            {"hub", RB_BEM_HUB, 0, 1, 0.0, 0.0, 5e-4},
            {"cover", RB_BEM_HUB, 0, 2, 0.0, 5.0, 5e-4}};

TEST(a_held_approach_relaxes)
{
    static const double time[2] = {0.0, 1.5}, approach[2] = {0.5, 0.5}, shift[2] = {0.02, 0.02};
    const rb_rolling_program program = {.n = 2, .time = time, .approach = approach, .shift = shift};
    for (size_t c = 0; c < sizeof held / sizeof *held; c++) {
        double error[2];
        for (int j = 0; j < 2; j++) {
            OWNED(rb_rolling_history) h;
            rb_rolling_case rc = relaxing(24);
            set(&rc, "layer-thickness %g cover-thickness %g", held[c].layer, held[c].cover);
            rc.a.support = held[c].support;
            if (held[c].terms == 2)
                rc.a.memory = (rb_rolling_memory){2, {0.3, 2.0}, {0.5, 1.5}};
            set(&rc, "mu 0.3 outer-elements %d time-step %g",
                held[c].support == RB_BEM_HALFPLANE ? 0 : 60, 1.5 / (20 << j));
            if (held[c].similar) {
                rc.elastic_b = 1;
                rc.b = rc.a;
            }
            const double element = run(&rc, &program, &h);
            assert_int_equal(h.n, 1 + (20 << j));
            error[j] = 0.0;
            for (int k = 0; k < h.n; k++) {
                const double want = relaxation_modulus(&rc.a.memory, h.time[k]);
                error[j] = fmax(error[j], fabs(h.normal_load[k] / h.normal_load[0] - want));
                CHECK_REL(h.tangential_load[k] / h.tangential_load[0],
                          h.normal_load[k] / h.normal_load[0], 1e-7, "%s: Q, step %d", held[c].name,
                          k);
                CHECK_ABS(h.contact_to[k], h.contact_to[0], element, "%s: edge", held[c].name);
            }
        }
        CHECK_MAX(error[1], 4.0 * held[c].bound, "%s: P(t)", held[c].name);
        CHECK_MAX(error[1], error[0] / 3.6, "%s: second order in time", held[c].name);
    }
}

/* ---- Lee and Radok: the contact grows ---------------------------------------------- */

/* a^2 = (4R/pi) int J dP of a load that rises to P at once, J E* = 1 + f (1 -
 * exp(-t/tau)). */
static double held_width(double E, double P, double t)
{
    return sqrt(4.0 * 50.0 * P / (M_PI * E) * (1.0 - F * expm1(-t / TAU)));
}

/* p(0, t) = 1/(2R) int E(t - s) da(s), E(t) = E_g/(1+f) [1 + f exp(-(1+f) t/tau)]. */
static double held_pressure(double E, double P, double t)
{
    enum { STEPS = 1000 };
    const double dt = t / STEPS;
    double p = 0.0;
    for (int k = 0; k <= STEPS; k++) {
        const double s = (k - 0.5) * dt, age = k > 0 ? t - s : t;
        const double grown = k > 0 ? held_width(E, P, s + 0.5 * dt) - held_width(E, P, s - 0.5 * dt)
                                   : held_width(E, P, 0.0);
        p += E / (1.0 + F) * (1.0 + F * exp(-(1.0 + F) * age / TAU)) * grown;
    }
    return p / (2.0 * 50.0);
}

/* int_0^P delta dP of an elastic half-plane, delta = P/(pi E) (2 ln(2d/a) + 1). */
static double complementary_energy(const rb_rolling_case *rc, double softer, double P)
{
    const double E = modulus(rc) / softer, d = 2.0 * 50.0 / M_E;
    return (0.5 * P * P * (log(d * d * M_PI * E / (50.0 * P)) + 1.0) + 0.25 * P * P) / (M_PI * E);
}

/* Half-width, pressure and, when all has relaxed, the work that the dashpots have taken:
 * P times the further approach less what is stored, int_0^P (delta_r - delta_g) dP. */
TEST(a_held_load_creeps)
{
    static const double time[3] = {0.0, 2.0, 11.0}, load[3] = {100.0, 100.0, 100.0};
    const rb_rolling_program program = {.n = 3, .time = time, .load = load};
    for (int j = 0; j < 2; j++) {
        const int n = 60 << j;
        if (!is_in_turn(j, 2))
            continue;
        OWNED(rb_rolling_history) h;
        rb_rolling_case rc = with(relaxing(n), "time-step 0.05");
        const double element = run(&rc, &program, &h);
        for (int k = 0; k < h.n; k++) {
            const double want = held_width(modulus(&rc), 100.0, h.time[k]);
            CHECK_ABS(0.5 * (h.contact_to[k] - h.contact_from[k]), want, 1.25 * element,
                      "n %d: half-width at %g s", n, h.time[k]);
            CHECK_REL(h.max_pressure[k], held_pressure(modulus(&rc), 100.0, h.time[k]), 2e-3,
                      "n %d: p0 at %g s", n, h.time[k]);
            CHECK_REL(h.normal_load[k], 100.0, 1e-10, "load");
        }
        const double lost =
            complementary_energy(&rc, 1.0 + F, 100.0) - complementary_energy(&rc, 1.0, 100.0);
        CHECK_REL(h.lost_work[h.n - 1], lost, 1e-3 / (1 << j), "n %d: lost work", n);
        CHECK_REL(100.0 * (h.approach[h.n - 1] - h.approach[0]) - lost,
                  (100.0 * h.approach[h.n - 1] - complementary_energy(&rc, 1 + F, 100)) -
                      (100.0 * h.approach[0] - complementary_energy(&rc, 1.0, 100)),
                  1e-9, "the same said twice");
        CHECK_REL(h.approach[0],
                  100.0 / (M_PI * modulus(&rc)) *
                      (2.0 * log(4.0 * 50.0 / M_E / held_width(modulus(&rc), 100, 0)) + 1),
                  1e-3, "approach at once");
    }
}

/* ---- Ting: the contact shrinks ----------------------------------------------------- */

/* (4R/(pi E)) P_1 times int_0^t J E ds: a^2 of a load that grows by P_1 a second. */
static double ramp(double t)
{
    return t > 0.0 ? (1.0 + F) * t + F * TAU * expm1(-t / TAU) : 0.0;
}

/* a^2 over (4R/(pi E)) P_1 where the load turns round after a second, while a grows. */
static double grown(double t)
{
    return ramp(t) - 2.0 * ramp(t - 1.0);
}

/* Load at time t over P_1 where the contact is as wide as it was at t_1 < t. */
static double load_of(double t, double t1)
{
    enum { STEPS = 2000 };
    double P = 0.0;
    for (int k = 0; k < STEPS; k++) {
        const double from = t1 * k / STEPS, to = t1 * (k + 1) / STEPS;
        const double age = t - 0.5 * (from + to);
        P += (1.0 + F * exp(-(1.0 + F) * age / TAU)) / (1.0 + F) * (grown(to) - grown(from));
    }
    return P;
}

static double bisected(double (*f)(double, double), double t, double want, double from, double to)
{
    for (int k = 0; k < 60; k++) {
        const double middle = 0.5 * (from + to);
        *(f(t, middle) < want ? &from : &to) = middle;
    }
    return 0.5 * (from + to);
}

static double minus_growth(double unused, double t)
{
    (void)unused;
    return (grown(t) - grown(t + 1e-6)) / 1e-6;
}

/* The load rises and falls again in a second each.  Beyond the widest contact the past
 * counts only as far as the contact was narrower (Ting 1966, Graham 1967). */
TEST(an_unloaded_contact_shrinks)
{
    static const double time[3] = {0.0, 1.0, 2.0}, load[3] = {1e-3, 100.0, 1e-3};
    const rb_rolling_program program = {.n = 3, .time = time, .load = load};
    const double widest = bisected(minus_growth, 0.0, 0.0, 1.0, 2.0);
    assert_true(widest > 1.01 && widest < 1.9);
    for (int j = 0; j < 2; j++) {
        const int n = 100 << j;
        OWNED(rb_rolling_history) h;
        rb_rolling_case rc = relaxing(n);
        const double scale = 4.0 * 50.0 * 100.0 / (M_PI * modulus(&rc)),
                     a = sqrt(scale * grown(widest));
        rc.time_step = 0.04;
        const double element = run(&rc, &program, &h);
        for (int k = 1; k < h.n - 1; k++) {
            const double t = h.time[k];
            const double t1 = t < widest ? t : bisected(load_of, t, 2.0 - t, 0.0, widest);
            const double got = 0.5 * (h.contact_to[k] - h.contact_from[k]);
            CHECK_ABS(got, sqrt(scale * grown(t1)), element, "n %d: half-width at %g s", n, t);
            CHECK_MAX(got, a + element, "n %d: no wider than at %g s", n, widest);
        }
        assert_true(h.lost_work[h.n - 1] > 0.0);
        for (int k = 1; k < h.n; k++)
            CHECK_MAX(h.lost_work[k - 1] - h.lost_work[k], 0.0, "lost at step %d", k);
    }
}

/* ---- Limits ------------------------------------------------------------------------ */

/* Very slow and very fast relaxation are elastic bodies, glassy and rubbery, under the
 * same loads and shifts; a ratio of 0 too. */
TEST(limits_are_elastic)
{
    static const double time[5] = {0.0, 1.0, 1.0, 2.0, 3.0},
                        load[5] = {50.0, 100.0, 120.0, 80.0, 60.0},
                        shift[5] = {0.0, 0.02, 0.03, 0.01, -0.04};
    for (int kind = 0; kind < 3; kind++) {
        rb_rolling_history h[2];
        rb_rolling_program program = {.n = 5, .time = time, .load = load, .shift = shift};
        rb_rolling_case rc = with(relaxing(40), "mu 0.3");
        rc.a.poisson = kind == 1 ? 0.5 : 0.3; /* friction remembers its way */
        rc.zone = 12.0;
        rc.a.memory.time[0] = kind == 0 ? 1e12 : 1e-12;
        rc.a.memory.ratio[0] = kind == 2 ? 0.0 : F;
        run(&rc, &program, &h[0]);
        assert_non_null(h[0].time);
        rc.a.memory.n = 0;
        rc.a.young /= kind == 1 ? 1.0 + F : 1.0;
        program.time = NULL;
        run(&rc, &program, &h[1]);
        assert_null(h[1].time);
        /* at the first row and at a jump the rubbery body is still a glassy one */
        for (int k = 0; k < 5; k++) {
            if (kind == 1 && (k == 0 || k == 2))
                continue;
            CHECK_REL(h[0].approach[k], h[1].approach[k], 1e-9, "kind %d, step %d", kind, k);
            if (kind != 1)
                CHECK_ABS(h[0].tangential_load[k], h[1].tangential_load[k], 1e-8 * 30.0,
                          "kind %d, step %d", kind, k);
        }
        rb_rolling_history_free(&h[0]);
        rb_rolling_history_free(&h[1]);
    }
}

/* Which of the bodies relaxes: seen from the other one, friction is of the other sign. */
TEST(bodies_may_change_places)
{
    static const double time[4] = {0.0, 0.5, 1.0, 2.0}, load[4] = {50.0, 100.0, 100.0, 30.0};
    const rb_rolling_program program = {.n = 4, .time = time, .load = load};
    rb_rolling_case rc = with(relaxing(40), "mu 0.2 time-step 0.25 zone 12");
    rb_rolling_model model[2];
    rb_rolling_history h[2];
    rc.elastic_b = 1;
    rc.b = rc.a;
    rc.b.memory.n = 0;
    rc.b.young = 3000.0;
    rc.b.poisson = 0.4;
    for (int k = 0; k < 2; k++) {
        CHECK_OK(rb_rolling_history_run(&rc, &program, NULL, &model[k], &h[k], NULL));
        const rb_rolling_body a = rc.a;
        rc.a = rc.b;
        rc.b = a;
    }
    for (int i = 0; i < model[0].mesh.n; i++) {
        CHECK_ABS(model[1].state.p[i], model[0].state.p[i], 1e-8, "p %d", i);
        CHECK_ABS(model[1].state.q[i], -model[0].state.q[i], 1e-8, "q %d", i);
    }
    for (int k = 0; k < h[0].n; k++) {
        CHECK_REL(h[1].approach[k], h[0].approach[k], 1e-9, "approach %d", k);
        CHECK_ABS(h[1].lost_work[k], h[0].lost_work[k], 1e-8, "lost work %d", k);
    }
    for (int k = 0; k < 2; k++) {
        rb_rolling_model_free(&model[k]);
        rb_rolling_history_free(&h[k]);
    }
}

/* ---- Rolling ----------------------------------------------------------------------- */

static rb_rolling_case roller(int n)
{
    rb_rolling_case rc = relaxing(n);
    set(&rc, "relaxation-time 0.01,0.03 relaxation-ratio 3,0.5 similar speed 200 load 100 mu 0.3 "
             "formulation transient distance 25 zone 10.4");
    return rc;
}

/* Under creepage and under force it becomes the steady state of the same elements and the
 * upstream difference, to the product rule of the memory.  That is of second order, and
 * of order 3/2 where the pressure begins like a square root.  What is lost per way
 * becomes the hysteresis. */
TEST(rolling_becomes_steady)
{
    for (int control = 0; control < 2; control++) {
        double error[2];
        for (int j = 0; j < 2; j++) {
            rb_rolling_case rc = roller(40 << j);
            OWNED(rb_rolling_model) model;
            OWNED(rb_rolling_history) h;
            OWNED(rb_rolling_solution) s;
            *(control ? &rc.force_ratio : &rc.creep_ratio) = control ? -0.4 : 0.5;
            CHECK_OK(rb_rolling_history_run(&rc, NULL, NULL, &model, &h, &message));
            for (int k = 0; k < h.n; k++)
                CHECK_MAX(h.residual[k], 1e-9, "step %d", k);
            CHECK_REL(h.step, model.bodies.f.h[0], 1e-9, "a step is an element");
            CHECK_REL(h.distance[h.n - 1], 25.0, 1e-12, "the way");
            CHECK_REL(h.time[h.n - 1], 25.0 * h.half_width / rc.speed, 1e-12, "time");
            set(&rc, "formulation steady contact-elements %d", model.mesh.n);
            CHECK_OK(rb_rolling_solve_between(&rc, model.mesh.ends[0],
                                              model.mesh.ends[model.mesh.n], &s, &message));
            const int last = h.n - 1;
            error[j] = fabs(h.moment[last] / s.resistance_moment - 1.0);
            CHECK_REL(h.tangential_load[last], s.tangential_load, 2e-3 / (1 << 2 * j), "n %d: Q",
                      rc.contact_elements);
            CHECK_REL(h.creepage[last], s.creepage, 4e-3 / (1 << 2 * j), "n %d: xi",
                      rc.contact_elements);
            CHECK_REL(h.approach[last], s.approach, 4e-4 / (1 << 2 * j), "approach");
            CHECK_REL((h.lost_work[last] - h.lost_work[last - 1]) / h.step, s.hysteresis,
                      8e-3 / (1 << 2 * j), "hysteresis");
        }
        CHECK_MAX(error[0], 2e-3, "M");
        CHECK_MAX(error[1], error[0] / 2.8, "M is of order 3/2");
    }
}

/* Memories that are long beside the datum: the approach becomes the steady one, which the
 * loads that have moved on raise, and the bodies never give work back. */
TEST(a_long_memory_has_the_steady_approach)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc =
            with(roller(30),
                 "relaxation-time %g relaxation-ratio 2 similar datum %g datum-b %g "
                 "distance 60 force-ratio 0.3",
                 k ? 0.05 : 0.02, k ? 6.0 : 3.0, k ? 2.0 : 3.0);
        OWNED(rb_rolling_model) model;
        OWNED(rb_rolling_history) h;
        OWNED(rb_rolling_solution) s;
        CHECK_OK(rb_rolling_history_run(&rc, NULL, NULL, &model, &h, &message));
        set(&rc, "formulation steady contact-elements %d", model.mesh.n);
        CHECK_OK(rb_rolling_solve_between(&rc, model.mesh.ends[0], model.mesh.ends[model.mesh.n],
                                          &s, &message));
        CHECK_ABS(h.approach[h.n - 1], s.approach, 2e-3 * (s.approach - h.approach[0]),
                  "case %d: approach", k);
        CHECK_REL((h.lost_work[h.n - 1] - h.lost_work[h.n - 2]) / h.step, s.hysteresis, 2e-2,
                  "case %d: hysteresis", k);
        for (int i = 1; i < h.n; i++) {
            CHECK_MAX(h.approach[i - 1] - h.approach[i], 1e-4 * s.approach, "approach, step %d", i);
            CHECK_MAX(h.lost_work[i - 1] - h.lost_work[i], 0.0, "lost, step %d", i);
        }
    }
}

/* Hunter's exact M: f = 1, V tau = a_g (theory-bodies.md V3). */
TEST(rolling_from_rest_ends_at_hunters_moment)
{
    rb_rolling_case rc = with(relaxing(100), "relaxation-time 1 relaxation-ratio 1 half-width 1 "
                                             "speed 1 formulation transient creep 0 distance 16");
    OWNED(rb_rolling_history) h;
    run(&rc, NULL, &h);
    CHECK_ABS(h.moment[0] / h.normal_load[0], 0.0, 1e-9, "pressed at once");
    CHECK_ABS(h.moment[h.n - 1] / h.normal_load[h.n - 1], 0.2621595, 1e-4, "M/(P a_g)");
    CHECK_ABS(h.contact_to[h.n - 1], 1.3698037, 1e-2, "leading edge");
    CHECK_ABS(h.contact_from[h.n - 1], -1.0148946, 1e-2, "trailing edge");
}

/* A ratio of 0 is an elastic body, step by step. */
TEST(elastic_rolling_is_the_limit)
{
    rb_rolling_history h[2];
    rb_rolling_case rc = roller(40);
    rc.a.memory.ratio[0] = rc.a.memory.ratio[1] = 0.0;
    rc.b.memory.n = 0;
    rc.force_ratio = 0.5;
    rc.distance = 40.0 * 2.0 * rc.zone / 40.0 / rb_rolling_derive(&rc).half_width;
    for (int k = 0; k < 2; k++) {
        run(&rc, NULL, &h[k]);
        rc.a.memory.n = 0;
    }
    assert_int_equal(h[0].n, h[1].n);
    for (int k = 0; k < h[0].n; k++)
        CHECK_REL(h[0].creepage[k], h[1].creepage[k], 1e-8, "step %d", k);
    for (int k = 0; k < 2; k++)
        rb_rolling_history_free(&h[k]);
}

/* By transforms the same. */
TEST(many_elements_tell_the_same)
{
    static const double time[2] = {0.0, 0.4}, load[2] = {50.0, 100.0};
    const rb_rolling_program program = {.n = 2, .time = time, .load = load};
    rb_rolling_history h[2];
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = with(relaxing(k ? 1500 : 300), "time-step 0.1");
        run(&rc, &program, &h[k]);
    }
    for (int k = 0; k < h[0].n; k++) {
        CHECK_REL(h[1].approach[k], h[0].approach[k], 1e-4, "step %d", k);
        CHECK_REL(h[1].max_pressure[k], h[0].max_pressure[k], 1e-3, "step %d", k);
        CHECK_ABS(h[1].lost_work[k], h[0].lost_work[k], 1e-3 * h[0].lost_work[2] + 1e-9, "step %d",
                  k);
    }
    for (int k = 0; k < 2; k++)
        rb_rolling_history_free(&h[k]);
}

/* ---- Refusals ---------------------------------------------------------------------- */

TEST(bad_programs_are_refused)
{
    static const double time[3] = {0.0, 1.0, 2.0}, late[3] = {1.0, 2.0, 3.0},
                        back[3] = {0.0, 2.0, 1.0}, load[3] = {1.0, 2.0, 3.0},
                        way[3] = {0.0, 1.0, 2.0};
    static const struct {
        rb_rolling_formulation formulation;
        const double *time, *distance;
        int elastic, steps, base, hub;
        const char *word;
    } bad[] = {{RB_STATIC, NULL, NULL, 0, 0, 0, 0, "needs a column time"},
               {RB_STATIC, late, NULL, 0, 0, 0, 0, "row 1: expected time 0"},
               {RB_STATIC, back, NULL, 0, 0, 0, 0, "row 3: time 1 is before"},
               {RB_STATIC, time, NULL, 1, 0, 0, 0, "for viscoelastic bodies"},
               {RB_TRANSIENT, time, way, 0, 0, 0, 0, "for static contact"},
               {RB_TRANSIENT, NULL, way, 0, 900, 0, 0, "by one element in each step"},
               {RB_STATIC, time, NULL, 0, 0, 1, 0, "base or core"},
               {RB_TRANSIENT, NULL, way, 0, 0, 0, 1, "halfplane only"}};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        rb_rolling_case rc = relaxing(24);
        rb_rolling_program program = {
            .n = 3, .time = bad[k].time, .distance = bad[k].distance, .load = load};
        OWNED(rb_rolling_model) model;
        OWNED(rb_rolling_history) h;
        rc.formulation = bad[k].formulation;
        rc.speed = bad[k].formulation == RB_TRANSIENT ? 10.0 : 0.0;
        rc.steps = bad[k].steps;
        if (bad[k].elastic)
            rc.a.memory.n = 0;
        if (bad[k].base) {
            set(&rc, "layer-thickness 1 base-young 2e5");
        }
        if (bad[k].hub)
            rc.a.support = RB_BEM_HUB;
        CHECK_SAYS(rb_rolling_history_run(&rc, &program, NULL, &model, &h, &message), RB_EINVAL,
                   bad[k].word);
    }
}

/* Solved at once, without steps, it would be an elastic body. */
TEST(one_static_solve_is_refused)
{
    rb_rolling_case rc = with(relaxing(24), "load 100");
    rb_rolling_solution s;
    OWNED(rb_rolling_model) model;
    CHECK_SAYS(rb_rolling_solve(&rc, &s, &message), RB_EINVAL, "history");
    CHECK_STATUS(rb_rolling_model_create(&rc, &model, &message), RB_EINVAL);
    CHECK_STATUS(rb_rolling_solve_between(&rc, -5.0, 5.0, &s, &message), RB_EINVAL);
    rc.increments = 3;
    CHECK_STATUS(rb_rolling_solve(&rc, &s, &message), RB_EINVAL);
}

/* At rest and rolling; what there is is freed. */
TEST(every_failing_allocation_is_noticed)
{
    static const double time[3] = {0.0, 0.5, 0.5}, load[3] = {50.0, 100.0, 80.0};
    const rb_rolling_program program = {.n = 3, .time = time, .load = load};
    for (int rolls = 0; rolls < 2; rolls++) {
        rb_rolling_case rc = with(roller(12), "distance 2 creep 1e-3");
        if (!rolls) {
            set(&rc, "formulation static load nan creep nan");
        }
        for (int count = 0, refused = 1; refused; count++) {
            OWNED(rb_rolling_model) model;
            OWNED(rb_rolling_history) h;
            refused = REFUSED_FROM(count, rb_rolling_history_run(&rc, rolls ? NULL : &program, NULL,
                                                                 &model, &h, NULL));
        }
    }
}

/* ---- Parts ------------------------------------------------------------------------- */

/* Over steps of any length the three parts make one, and each is its integral, here in
 * more digits: kept exp(-r), after 1 - (1 - exp(-r))/r. */
TEST(what_fades_is_known_to_rounding)
{
    for (double r = 1e-7; r < 50.0; r *= 1.3) {
        const rb_bem_fading f = rb_bem_fading_over(4.0, 4.0 * r);
        long double after = 0.0L, term = 1.0L; /* its series, or closed */
        for (int k = 1; k < 60 && r < 1.0; k++)
            after += (term *= (k > 1 ? -1.0L : 1.0L) * r / (k + 1));
        if (r >= 1.0)
            after = 1.0L + expm1l(-(long double)r) / r;
        CHECK_REL(f.kept, exp(-r), 1e-14, "kept, r = %g", r);
        CHECK_REL(f.after, (double)after, 1e-13, "after, r = %g", r);
        CHECK_REL(f.before, (double)(-expm1l(-(long double)r) - after), 2e-13, "before, r = %g", r);
        CHECK_ABS(f.kept + f.before + f.after, 1.0, 1e-15, "sum, r = %g", r);
    }
}

/* Under a given approach a step that is long beside tau/(1 + f) leaves less pressure than
 * the relaxed bodies have, or none; that is said, with the remedy, and of no other step. */
TEST(a_step_that_relaxes_too_much_is_said)
{
    static const struct {
        rb_rolling_formulation formulation;
        double tau; /* in steps */
        const char *remedy;
    } steps[] = {{RB_TRANSIENT, 1.0, "as many --contact-elements."},
                 {RB_TRANSIENT, 2.0, "take 5 times as many --contact-elements."},
                 {RB_TRANSIENT, 10.0, NULL},
                 {RB_TRANSIENT, 100.0, NULL},
                 {RB_STATIC, 1.0, "take 0.019 s as --time-step."},
                 {RB_STATIC, 10.0, NULL}};
    static const double time[2] = {0.0, 1.0}, approach[2] = {0.5, 0.5};
    const rb_rolling_program at_rest = {.n = 2, .time = time, .approach = approach};

    for (size_t k = 0; k < sizeof steps / sizeof *steps; k++) {
        rb_rolling_case rc = relaxing(20);
        OWNED(rb_rolling_model) model;
        OWNED(rb_rolling_history) h;
        OWNED(rb_rolling_solution) s;
        const int rolls = steps[k].formulation == RB_TRANSIENT;
        set(&rc, "approach 0.5 distance 1 creep 0 speed 1 time-step 0.1");
        rc.formulation = steps[k].formulation;
        const double step = rolls ? 2.0 * rb_rolling_derive(&rc).half_width / 20.0 : 0.1;
        rc.a.memory = (rb_rolling_memory){1, {steps[k].tau * step}, {10.0}};
        CHECK_OK(rb_rolling_history_run(&rc, rolls ? NULL : &at_rest, NULL, &model, &h, NULL));
        CHECK_OK(rb_rolling_model_solution(&model, &s, NULL));
        const rb_rolling_note_list list = rb_rolling_find_notes(&rc, &s);
        const double left = h.normal_load[1] / h.normal_load[0];
        int noted = 0;
        for (int i = 0; i < list.n; i++)
            noted |= strncmp(list.text[i], "In one step (", 13) == 0 &&
                     strstr(list.text[i], steps[k].remedy ? steps[k].remedy : "") != NULL;
        if (noted != (steps[k].remedy != NULL))
            fail_msg("%d: %d notes: %s", (int)k, list.n, list.n ? list.text[0] : "");
        if (steps[k].remedy ? !(left < 1.0 / 11.0) : !(left > 1.0 / 11.0))
            fail_msg("%d: %g left", (int)k, left);
    }
}

RUN_TESTS(NULL, NULL)
