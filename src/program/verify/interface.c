/* References for the interface between the bodies: falling friction, a third body, heat,
 * wear, fretting. */
#include "program/verify/internal.h"

#include "rolling/case/closed_forms.h"

#include <math.h>

/* Similar bodies that slide so fast that the heat is that of Hertz's pressure; each surface takes
 * it at its own speed (Blok), and one that rests, at a creepage of 2, takes none. */
static void flash_temperature(rb_verify *v, int elements, double creep, double bound)
{
    const rb_rolling_heat steel = {50.0, 3.5, 0.0};
    rb_rolling_case rc = rb_verify_uncoupled();
    rc.formulation = RB_STEADY;
    rc.mesh = RB_MESH_ALIGNED;
    rc.slip_operator = RB_SLIP_SECOND;
    rc.contact_elements = elements;
    rc.mu = 1e-3;
    rc.creep = creep;
    rc.heat_a = rc.heat_b = steel;
    rc.speed = 1e6 * 2.0 * steel.conductivity / steel.heat_capacity / rc.half_width;
    const rb_rolling_solution *s = rb_verify_solve(v, &rc);
    const double p0 = rb_closed_hertz_max_pressure(s->normal_load, rc.half_width);
    rb_verify_relative(
        v, s->max_temperature,
        rb_closed_flash_temperature(rc.mu * p0 * rc.creep * rc.speed, rc.half_width, rc.speed,
                                    sqrt(steel.conductivity * steel.heat_capacity) *
                                        (sqrt(1.0 - 0.5 * creep) + sqrt(1.0 + 0.5 * creep))),
        bound, "flash temperature, creepage %g, %d elements", creep, elements);
}

/* Steel on aluminium that slides so slowly that heat runs ahead of the contact: who takes it, and
 * how warm both are below (references of numpy, elliptic heat on 200 cosine elements). */
static void heat_share(rb_verify *v)
{
    static const struct {
        double speed, share, rise, inside[2]; /* inside: at (-0.5, +-0.1) */
    } wanted[] = {{10.0, 0.315895, 4.5723, {4.15379, 4.21775}},
                  {100.0, 0.375319, 2.0490, {1.71116, 1.86068}}};
    rb_rolling_case rc = rb_verify_uncoupled();
    rc.formulation = RB_STEADY;
    rc.mesh = RB_MESH_ALIGNED;
    rc.contact_elements = 200;
    rc.half_width = 1.0;
    rc.mu = 1e-7; /* slides everywhere, at speeds that are nearly the same */
    rc.creep = 1e-4;
    rc.heat_a = (rb_rolling_heat){50.0, 3.77, 0.0};
    rc.heat_b = (rb_rolling_heat){200.0, 2.43, 0.0};
    for (size_t k = 0; k < sizeof wanted / sizeof *wanted; k++) {
        static rb_message why;
        rc.speed = wanted[k].speed;
        const rb_rolling_solution *s = rb_verify_solve(v, &rc);
        const double heat = 1e-3 * (s->heat_into_a + s->heat_into_b); /* [W/mm] */
        rb_verify_relative(v, s->heat_share_a, wanted[k].share, 3e-4,
                           "heat share of steel on aluminium, V = %g mm/s", rc.speed);
        rb_verify_relative(v, s->max_temperature / heat, wanted[k].rise, 3e-4,
                           "its largest rise per W/mm, V = %g mm/s", rc.speed);
        for (int of_b = 0; of_b < 2; of_b++) {
            rb_rolling_stress at = {.x = -0.5, .y = of_b ? -0.1 : 0.1};
            if (s->n) /* or the reason is known already */
                rb_verify_note(v, rb_rolling_temperature_inside(&rc, s, of_b, 1, &at, &why), &why);
            rb_verify_relative(v, at.temperature / heat, wanted[k].inside[of_b], 3e-4,
                               "rise 0.1 a below the surface of %s, V = %g mm/s", of_b ? "B" : "A",
                               rc.speed);
        }
    }
}

/* A cylinder that slides until it has lost 400 times the gap at the edge of Hertz's
 * contact: V = K P S, and p = P/(2b) with V = 2 b^3/(3R). */
static void wear(rb_verify *v, int steps)
{
    static rb_message why;
    rb_rolling_case rc = rb_verify_uncoupled();
    rb_rolling_wear_history h;
    rb_rolling_solution last;
    const double R = rc.a.radius, a = rc.half_width;
    const double P = rb_closed_hertz_load(a, R, rb_rolling_derive(&rc).modulus);
    rb_rolling_wear w = {.slides = 1, .coefficient = 1e-9, .steps = steps};
    w.way = 200.0 * a * a / R / (w.coefficient * rb_closed_hertz_max_pressure(P, a));
    rc.mesh = RB_MESH_UNIFORM;
    rc.contact_elements = 60;
    why.text[0] = '\0';
    const rb_status s = rb_rolling_wear_run(&rc, &w, NULL, &h, &last, &why);
    rb_verify_note(v, s, &why);
    const double volume = w.coefficient * P * w.way;
    rb_verify_relative(v, s == RB_OK ? h.worn[h.n - 1] : NAN, volume, 1e-12,
                       "wear of a cylinder, %d steps: volume K P S", steps);
    rb_verify_relative(v, s == RB_OK ? last.half_width : NAN, cbrt(1.5 * R * volume), 0.03,
                       "wear of a cylinder, %d steps: uniform pressure, b", steps);
    rb_rolling_wear_history_free(&h);
    rb_rolling_solution_free(&last);
}

/* Partial slip after so many cycles that the slip zone is unloaded; c/a = 0.6 lies between two
 * elements.  The deepest and the most strained place is at c, where p is singular: errors of first
 * order. */
static void worn_limit(rb_verify *v, int elements, double bound)
{
    static rb_message why;
    static const double stick = 0.6;
    rb_rolling_case rc = rb_verify_uncoupled();
    rb_rolling_wear_history h;
    rb_rolling_solution last;
    const double R = rc.a.radius, a = rc.half_width;
    const rb_rolling_wear w = {.coefficient = 1e-8, .way = 1e10, .steps = 2, .increments = 2};
    const rb_closed_worn limit = rb_closed_worn_limit(stick);
    rc.mesh = RB_MESH_UNIFORM;
    rc.mu = 0.5;
    rc.force_ratio = 1.0 - stick * stick;
    rc.zone = 1.35 * a;
    rc.contact_elements = elements;
    why.text[0] = '\0';
    const rb_status s = rb_rolling_wear_run(&rc, &w, NULL, &h, &last, &why);
    rb_verify_note(v, s, &why);
    rb_verify_relative(v, s == RB_OK ? h.worn[h.n - 1] : NAN, limit.volume * a * a * a / R, bound,
                       "wear in partial slip, %d elements: volume of the limit", elements);
    rb_verify_relative(v, s == RB_OK ? h.max_depth[h.n - 1] : NAN, limit.depth * a * a / R, bound,
                       "wear in partial slip, %d elements: depth of the limit", elements);
    rb_rolling_wear_history_free(&h);
    rb_rolling_solution_free(&last);
}

/* Bodies so stiff that only the third body deforms. */
static rb_rolling_case stiff_bodies(int elements)
{
    rb_rolling_case rc = rb_verify_uncoupled();
    rc.a.young = 1e13;
    rc.interlayer_normal = 1e-6;
    rc.interlayer_tangential = 2e-6;
    rc.half_width = NAN; /* P = 2 a^3/(3 R L_N), a = 1 */
    rc.load = 2.0 / (3.0 * rc.a.radius * rc.interlayer_normal);
    rc.formulation = RB_STEADY;
    rc.mesh = RB_MESH_ALIGNED;
    rc.slip_operator = RB_SLIP_SECOND;
    rc.contact_elements = elements;
    return rc;
}

static void brushes(rb_verify *v, int elements, double bound)
{
    const double s = 0.5;
    rb_rolling_case rc = stiff_bodies(elements);
    rc.creep = s * rc.mu * rc.interlayer_tangential / (rc.a.radius * rc.interlayer_normal);
    const rb_rolling_solution *it = rb_verify_solve(v, &rc);
    rb_verify_absolute(v, it->force_ratio, -(1.0 - (1.0 - s) * (1.0 - s) * (1.0 - s)), bound,
                       "brushes, %d elements: Q/(mu P)", elements);
}

/* Wheel and rail of CONTACT's veldep_fric, whose friction falls with the slip. */
static void falling_friction(rb_verify *v)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a = (rb_rolling_body){.young = 2.0 * 82000.0 * 1.28,
                             .poisson = 0.28,
                             .radius = 460.0,
                             .support = RB_BEM_HALFPLANE};
    rb_verify_on_same(&rc);
    rc.load = 3111.08;
    rc.formulation = RB_STEADY;
    rc.creep = 0.0009999;
    rc.speed = 45000.0;
    rc.contact_elements = 93;
    rc.zone = 4.65;
    rc.mu = 0.18;
    rc.friction = (rb_rolling_friction){
        .law = RB_FRICTION_exponential, .fall = {0.12, 0.0}, .slip_scale = {100.0, 100.0}};
    const rb_rolling_solution *s = rb_verify_solve(v, &rc);
    rb_verify_absolute(v, s->force_ratio, -0.5941, 5e-4,
                       "falling friction, %d elements: Q/(mu P) of CONTACT", 93);
    rb_verify_absolute(v, s->stick, 45, 0.0, "falling friction, %d elements: elements that stick",
                       93);
}

/* Brushes that yield: q grows by xi/L_T per length from the leading edge to the yield
 * stress, by xi/(L_T + 1/k) to mu p, and is mu p then (theory-rolling.md Y2). */
static void yielding_brushes(rb_verify *v, int elements, double bound)
{
    rb_rolling_case rc = stiff_bodies(elements);
    const double most = rc.mu / (2.0 * rc.a.radius * rc.interlayer_normal);
    const double elastic = 0.8 * most;
    rc.creep = elastic * rc.interlayer_tangential;
    rc.yield_stress = 0.3 * most;
    rc.hardening = 1.0 / rc.interlayer_tangential;
    const rb_rolling_solution *it = rb_verify_solve(v, &rc);
    /* in units of most, s from the leading edge: 0.8 s up to 3/8, then 0.15 + 0.4 s up
     * to where it meets 2 s - s^2 */
    const double s1 = 0.375, s2 = 0.8 + sqrt(0.49);
    const double Q = 0.4 * s1 * s1 + 0.15 * (s2 - s1) + 0.2 * (s2 * s2 - s1 * s1) + 4.0 / 3.0 -
                     s2 * s2 + s2 * s2 * s2 / 3.0;
    rb_verify_absolute(v, it->force_ratio, -0.75 * Q, bound,
                       "yielding brushes, %d elements: Q/(mu P)", elements);
}

/* CONTACT, testbank/examples_plast/carter_plast, DX = 0.04. */
static void yielding_half_planes(rb_verify *v, double hardening, double want)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a.support = RB_BEM_HALFPLANE;
    rc.a.young = 209920.0;
    rc.a.poisson = 0.28;
    rb_verify_on_same(&rc);
    rc.a.radius = 500.0;
    rc.gap = RB_GAP_PARABOLA;
    rc.mu = 0.5;
    rc.load = 178.9;
    rc.creep = -4e-4;
    rc.yield_stress = 35.0;
    rc.hardening = hardening;
    rc.formulation = RB_STEADY;
    rc.contact_elements = 55;
    rc.zone = 1.1;
    const rb_rolling_solution *it = rb_verify_solve(v, &rc);
    rb_verify_absolute(v, it->force_ratio, want, 1e-4,
                       "yielding interface, hardening %g: Q/(mu P) of CONTACT", hardening);
}

/* Steel on steel under a force that goes back and forth between +-0.6 mu P (Q1). */
static void fretting(rb_verify *v)
{
    static const double ratio[] = {0.0, 0.6, -0.6, 0.6};
    const rb_rolling_program program = {.n = 4, .force_ratio = ratio};
    rb_rolling_case rc = rb_verify_uncoupled();
    rb_rolling_history h;
    rb_rolling_model model;
    rb_rolling_solution s = {.n = 0};
    rb_message why = {.text = ""};

    rc.a.radius = 100.0;
    rc.a.young = 210e3;
    rc.a.poisson = 0.3;
    rb_verify_on_same(&rc);
    rc.half_width = NAN;
    rc.load = 500.0;
    rc.mu = 0.5;
    rc.formulation = RB_STATIC;
    rc.mesh = RB_MESH_UNIFORM;
    rc.contact_elements = 400;
    rc.fretting = 1;
    rb_status status = rb_rolling_history_run(&rc, &program, NULL, &model, &h, &why);
    if (status == RB_OK)
        status = rb_rolling_model_solution(&model, &s, &why);
    rb_verify_note(v, status, &why);
    const struct {
        double got, wanted, bound;
        const char *what;
    } rows[] = {{s.fretting.work, 0.0368862, 1e-4, "work per cycle"},
                {s.fretting.fretting_work.value, 0.114359, 2e-4, "largest work of an element"},
                {s.fretting.ruiz_1.value, 0.0571796, 2e-4, "largest Ruiz 1"},
                {s.fretting.ruiz_2.value, 9.60785, 3e-3, "largest Ruiz 2"},
                {s.fretting.swt.value, 0.477465, 2e-4, "SWT at the edge"},
                {s.fretting.tresca_shear.value, 165.9700, 2e-4, "largest shear"}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
        rb_verify_relative(v, status == RB_OK ? rows[k].got : (double)NAN, rows[k].wanted,
                           rows[k].bound, "fretting between +-0.6 mu P: %s", rows[k].what);
    rb_rolling_solution_free(&s);
    rb_rolling_history_free(&h);
    rb_rolling_model_free(&model);
}

void rb_verify_interface(rb_verify *v)
{
    falling_friction(v);
    brushes(v, 50, 3e-4);
    brushes(v, 200, 1.9e-5);
    yielding_brushes(v, 50, 8e-4);
    yielding_brushes(v, 200, 5e-5);
    yielding_half_planes(v, 4018000.0, 0.6478);
    yielding_half_planes(v, 123000.0, 0.6340);
    yielding_half_planes(v, 0.0, 0.5896);
    yielding_half_planes(v, -20500.0, 0.5457);
    flash_temperature(v, 50, 0.1, 5e-4);
    flash_temperature(v, 200, 0.1, 6.3e-5);
    flash_temperature(v, 200, 2.0, 1e-4);
    heat_share(v);
    wear(v, 1);
    wear(v, 5);
    worn_limit(v, 54, 0.065);
    worn_limit(v, 108, 0.034);
    fretting(v);
}
