/* References for the elastic body alone and for the stress below a contact. */
#include "program/verify/internal.h"

#include "rolling/case/closed_forms.h"
#include "rolling/case/rubber.h"

#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;

/* ---- A thick ring ------------------------------------------------------------------ */

enum { RING = 240 };

static const double inner = 1.0, outer = 2.0, pressure = 1.0;

/* Lame: u = A r + B/r with u(outer) = 0 and s_rr(inner) = -pressure. */
static void ring(rb_verify *v, rb_bem_plane plane)
{
    const double E = 2.6, nu = 0.3, c = E / (1.0 + nu);
    const double k =
        (1.0 + nu) / (plane == RB_PLANE_STRESS ? 1.0 - nu : (1.0 + nu) * (1.0 - 2.0 * nu));
    const char *name = plane == RB_PLANE_STRESS ? ", plane stress" : "";
    /* s_rr = c (A k - B/r^2), A = -B/outer^2 */
    const double B = pressure / c / (k / (outer * outer) + 1.0 / (inner * inner));
    const double u_inner = B / inner - B * inner / (outer * outer);
    const double s_outer = -c * B * (k + 1.0) / (outer * outer);
    /* constant elements on a polygon are of first order: 0.43/n was measured */
    const double bound = 0.6 / RING;
    double u[4 * RING], t[4 * RING];
    rb_message why = {.text = ""};
    const rb_bem_material material = rb_bem_material_in_plane(plane, E, nu);
    rb_bem_mesh mesh;
    rb_bem_system *system = NULL;
    rb_status s = rb_bem_mesh_alloc(2 * RING, &mesh);
    for (int j = 0; j < 2 * RING && s == RB_OK; j++) {
        /* The outer contour counter-clockwise and held, the inner one clockwise under
         * pressure. */
        const int is_outer = j < RING;
        const double R = is_outer ? outer : inner, turn = is_outer ? 1.0 : -1.0;
        const double a0 = turn * 2.0 * PI * (j % RING) / RING;
        const double a1 = turn * 2.0 * PI * ((j + 1) % RING) / RING;
        mesh.x0[j] = R * cos(a0);
        mesh.y0[j] = R * sin(a0);
        mesh.x1[j] = R * cos(a1);
        mesh.y1[j] = R * sin(a1);
        for (int d = 0; d < 2; d++)
            mesh.condition[2 * j + d] = is_outer ? RB_BEM_DISPLACEMENT : RB_BEM_TRACTION;
        if (!is_outer) {
            const double middle = turn * 2.0 * PI * (j % RING + 0.5) / RING;
            mesh.value[2 * j] = pressure * cos(middle);
            mesh.value[2 * j + 1] = pressure * sin(middle);
        }
    }
    if (s == RB_OK)
        s = rb_bem_system_create(&mesh, material, &system, &why);
    if (s == RB_OK)
        s = rb_bem_system_solve(system, NULL, u, t);
    rb_bem_system_free(system);
    rb_bem_mesh_free(&mesh);
    rb_verify_note(v, s, &why);
    /* the first elements of both contours lie around the x axis, half an element off */
    const double u_got = s == RB_OK ? hypot(u[2 * RING], u[2 * RING + 1]) : NAN;
    const double s_got = s == RB_OK ? -hypot(t[0], t[1]) : NAN;
    rb_verify_relative(v, u_got, u_inner, bound,
                       "ring under inner pressure (Lame)%s: displacement of the hole", name);
    rb_verify_relative(v, s_got, s_outer, bound,
                       "ring under inner pressure (Lame)%s: stress at the held rim", name);
}

/* ---- Below the surface ------------------------------------------------------------- */

/* Half-width and largest pressure of Hertz, the units of what is found below. */
typedef struct {
    double a, p0;
    rb_rolling_stress_maxima max;
} subsurface;

static subsurface below(rb_verify *v, const rb_rolling_case *rc)
{
    rb_message why = {.text = ""};
    rb_rolling_model model;
    rb_rolling_solution s = {0};
    const rb_rolling_extremum nothing = {NAN, NAN, NAN, RB_MATERIAL_BODY};
    subsurface b = {.p0 = NAN};
    for (int k = 0; rb_rolling_maximum(&b.max, k); k++)
        *rb_rolling_maximum(&b.max, k) = nothing;
    rb_status status = rb_rolling_solve_model(rc, &model, &s, &why);
    b.a = s.hertz_half_width;
    if (status == RB_OK) {
        b.p0 = rb_closed_hertz_max_pressure(s.normal_load, b.a);
        status = rb_rolling_stress_maxima_find(&model, 0.0, &b.max, &why);
        rb_rolling_stress_maxima_free(&b.max); /* its bonds */
    }
    rb_verify_note(v, status, &why);
    rb_rolling_solution_free(&s);
    rb_rolling_model_free(&model);
    return b;
}

/* wanted: over p0 and a. */
static void extremum(rb_verify *v, const subsurface *b, const rb_rolling_extremum *e,
                     rb_rolling_extremum wanted, const char *name)
{
    rb_verify_relative(v, e->value / b->p0, wanted.value, 3e-3, "%s / p0", name);
    rb_verify_absolute(v, hypot(fabs(e->x) / b->a - wanted.x, e->y / b->a - wanted.y), 0.0, 1e-2,
                       "%s: distance from its place / a", name);
}

/* Johnson, Contact Mechanics, 4.2 and 7.1; nu = 0.3. */
static void below_hertz(rb_verify *v)
{
    rb_rolling_case rc = rb_verify_uncoupled();
    rc.a.poisson = 0.3;
    rc.mu = 0.0;
    const subsurface b = below(v, &rc);
    extremum(v, &b, &b.max.max_shear,
             (rb_rolling_extremum){0.30028, 0.0, 0.78615, RB_MATERIAL_BODY},
             "Hertz: largest shear");
    extremum(v, &b, &b.max.von_mises,
             (rb_rolling_extremum){0.55752, 0.0, 0.70429, RB_MATERIAL_BODY}, "Hertz: von Mises");
    extremum(v, &b, &b.max.orthogonal_shear,
             (rb_rolling_extremum){0.25, 0.866, 0.5, RB_MATERIAL_BODY}, "Hertz: orthogonal shear");
}

/* A thick layer has the stress of its own half-plane, below a thin one lies that of the
 * base: a/d and d/a away from it, because a line load is felt like 1/distance. */
static void below_layers(rb_verify *v)
{
    static const double thickness[] = {1e4, 0.01}, bound[] = {3e-3, 1e-2};
    static const char *const name[] = {"layer of 10 000 a", "base below a layer of a/100"};
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = rb_verify_uncoupled();
        const double a = rc.half_width, stiffer = 3.0,
                     modulus = rc.a.young * (k == 0 ? 1.0 : stiffer) / (1.0 - 0.3 * 0.3);
        rc.a.poisson = rc.a.base_poisson = 0.3;
        rc.mu = 0.0;
        rc.a.layer = thickness[k] * a;
        rc.a.base_young = stiffer * rc.a.young;
        rc.half_width = NAN;
        rc.load = rb_closed_hertz_load(a, rc.a.radius, modulus);
        const subsurface b = below(v, &rc);
        const rb_rolling_extremum *e = &b.max.max_shear;
        rb_verify_relative(v, e->value / rb_closed_hertz_max_pressure(rc.load, a), 0.30028,
                           bound[k], "%s: largest shear / p0 of Hertz", name[k]);
        rb_verify_absolute(v, hypot(e->x, e->y - 0.78615 * a) / a, 0.0, 1e-2,
                           "%s: distance from its place / a", name[k]);
    }
}

/* A thin disc: szz = 0, and nowhere is von Mises' stress larger than the p0 of both
 * directions at the surface. */
static void below_hertz_disc(rb_verify *v)
{
    rb_rolling_case rc = rb_verify_uncoupled();
    rc.a.poisson = 0.3;
    rc.plane = RB_PLANE_STRESS;
    rc.mu = 0.0;
    const subsurface b = below(v, &rc);
    extremum(v, &b, &b.max.max_shear,
             (rb_rolling_extremum){0.30028, 0.0, 0.78615, RB_MATERIAL_BODY},
             "Hertz, plane stress: largest shear");
    rb_verify_relative(v, b.max.von_mises.value / b.p0, 1.0, 3e-3,
                       "Hertz, plane stress: von Mises / p0");
    rb_verify_absolute(v, b.max.von_mises.y / b.a, 0.0, 1e-6,
                       "Hertz, plane stress: von Mises: depth / a");
}

/* Similar bodies sliding fully, mu = 0.2; friction on A towards +x for xi < 0. */
static void below_sliding(rb_verify *v)
{
    rb_rolling_case rc = rb_verify_uncoupled();
    rc.a.poisson = 0.3;
    rb_verify_on_same(&rc);
    rc.mu = 0.2;
    rc.formulation = RB_STEADY;
    rc.creep_ratio = -2.0;
    const subsurface b = below(v, &rc);
    extremum(v, &b, &b.max.max_shear,
             (rb_rolling_extremum){0.31899, 0.625, 0.601, RB_MATERIAL_BODY},
             "full sliding: largest shear");
    rb_verify_absolute(v, b.max.max_shear.x / b.a, 0.625, 1e-2, "full sliding: its side");
}

/* Carter's tractions of equal half-planes, s = xi R/(mu a) = 1/2, nu = 0.3: B is no mirror image of
 * A; strips in closed form (B16). */
static void below_in_b(rb_verify *v)
{
    static const double xy[] = {0.0, 0.5, 0.5, 0.25}, wanted[][3] = {{-0.37320, -0.92702, 0.07362},
                                                                     {-0.67949, -0.86176, 0.22243}};
    rb_rolling_case rc = rb_verify_uncoupled();
    rb_rolling_model model = {0};
    rb_rolling_mirror *b = NULL;
    rb_rolling_solution s = {0};
    rb_rolling_stress at[2] = {{.sxx = NAN}, {.sxx = NAN}};
    rb_rolling_stress_maxima most = {.tension = {NAN, NAN, NAN, RB_MATERIAL_BODY}};
    rb_rolling_shakedown limit = {.shear_yield = NAN};
    rb_message why = {.text = ""};
    rc.a.poisson = 0.3;
    rb_verify_on_same(&rc);
    rc.mu = 0.3;
    rc.formulation = RB_STEADY;
    rc.mesh = RB_MESH_FITTED;
    rc.contact_elements = 200;
    rc.creep_ratio = 0.5;
    rb_status status = rb_rolling_solve_model(&rc, &model, &s, &why);
    const double a = s.hertz_half_width, p0 = rb_closed_hertz_max_pressure(s.normal_load, a),
                 points[] = {a * xy[0], a * xy[1], a * xy[2], a * xy[3]};
    if (status == RB_OK)
        status = rb_rolling_mirror_create(&model, &b, &why);
    if (status == RB_OK)
        status = rb_rolling_stress_at(&b->model, 2, points, at, &why);
    if (status == RB_OK)
        status = rb_rolling_stress_maxima_find(&b->model, 0.0, &most, &why);
    if (status == RB_OK)
        status = rb_rolling_shakedown_find(&b->model, &limit, &why);
    rb_verify_note(v, status, &why);
    rb_rolling_mirror_stress(2, at, NULL);
    for (int k = 0; k < 2; k++) {
        const double got[] = {at[k].sxx, at[k].syy, at[k].sxy};
        for (int j = 0; j < 3; j++)
            rb_verify_absolute(v, got[j] / p0, wanted[k][j], 2e-4,
                               "body B under Carter's tractions: %s / p0 at (%g, -%g) a",
                               j == 0   ? "sxx"
                               : j == 1 ? "syy"
                                        : "sxy",
                               xy[2 * k], xy[2 * k + 1]);
    }
    rb_verify_relative(v, most.tension.value / p0, 0.6 * (2.0 * sqrt(0.5) - 0.5), 1e-3,
                       "body B under Carter's tractions: tension at its edge / p0");
    rb_verify_relative(v, p0 / limit.shear_yield, 1.0 / (0.3 * sqrt(1.125)), 5e-4,
                       "body B under Carter's tractions: shakedown, p0/k");
    rb_rolling_mirror_free(b);
    rb_rolling_model_free(&model);
    rb_rolling_solution_free(&s);
}

/* p0/k at the shakedown limit of a case; no finite number where there is none. */
static double shakedown_limit(rb_verify *v, const rb_rolling_case *rc)
{
    rb_rolling_model model = {0};
    rb_rolling_solution s = {0};
    rb_rolling_shakedown limit = {0};
    rb_message why = {.text = ""};
    rb_status status = rb_rolling_solve_model(rc, &model, &s, &why);
    if (status == RB_OK)
        status = rb_rolling_shakedown_find(&model, &limit, &why);
    rb_verify_note(v, status, &why);
    const double p0 = rb_closed_hertz_max_pressure(s.normal_load, s.hertz_half_width);
    rb_rolling_solution_free(&s);
    rb_rolling_model_free(&model);
    return p0 / limit.shear_yield;
}

/* The load of a largest pressure: a layer of 2 mm on a rigid base under R = 100, Chebyshev
 * polynomials (B17). */
static void loads_of_pressures(rb_verify *v)
{
    static const struct {
        double poisson, pressure, load;
    } rows[] = {{0.3, 20.0, 65.02324}, {0.5, 20.0, 51.99160}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        rb_rolling_case rc = rb_verify_uncoupled();
        rb_message why = {.text = ""};
        rc.a.radius = 100.0;
        rc.a.young = 1000.0;
        rc.a.poisson = rows[k].poisson;
        rc.a.layer = 2.0;
        rc.elastic_b = 0;
        rc.mu = 0.0;
        rc.approach = rc.load = rc.half_width = NAN;
        rc.max_pressure = rows[k].pressure;
        rc.mesh = RB_MESH_FITTED;
        rc.contact_elements = 100;
        rb_verify_note(v, rb_rolling_find_load(&rc, &why), &why);
        rb_verify_relative(v, rc.pressed_by, rows[k].load, 3e-4,
                           "layer, nu = %g: load of a largest pressure of %g E/1000",
                           rows[k].poisson, rows[k].pressure);
    }
}

/* A disc between two opposite forces (Hertz 1883): along the diameter across them, rho = 2 x/D, the
 * shear is (2 P/(pi D)) (4/(1 + rho^2)^2 - 1 + (1 - rho^2)^2/(1 + rho^2)^2)/2. */
static void inside_disc(rb_verify *v)
{
    static const struct {
        double rho, wanted;
    } places[] = {{0.0, 2.0}, {0.5, 0.96}};
    rb_rolling_case rc = rb_rolling_case_defaults();
    rb_rolling_model model;
    rb_rolling_solution s = {0};
    rb_message why = {.text = ""};
    rc.a.poisson = 0.5;
    rc.a.arc = 0.3;
    rc.b = rc.a;
    rc.elastic_b = 1;
    rc.load = 1000.0;
    rc.mu = 0.0;
    rc.outer_elements = 400;
    const double D = 2.0 * rc.a.radius;
    rb_status status = rb_rolling_solve_model(&rc, &model, &s, &why);
    for (size_t k = 0; k < sizeof places / sizeof *places; k++) {
        const double place[] = {0.5 * places[k].rho * D, 0.5 * D};
        rb_rolling_stress at = {.max_shear = NAN};
        if (status == RB_OK)
            status = rb_rolling_stress_at(&model, 1, place, &at, &why);
        rb_verify_relative(v, at.max_shear * PI * D / (2.0 * rc.load), places[k].wanted, 2e-3,
                           "disc between two forces: shear over 2 P/(pi D), x = %g R",
                           places[k].rho);
    }
    rb_verify_note(v, status, &why);
    rb_rolling_solution_free(&s);
    rb_rolling_model_free(&model);
}

/* Below strips of uniform and of triangular friction, by quadrature (B18; Johnson 2.5, 2.6). */
static void below_strips(rb_verify *v)
{
    static const double x[] = {-1.0, 0.0, 1.0}, none[] = {0.0, 0.0, 0.0},
                        uniform[] = {1.0, 1.0, 1.0}, triangle[] = {0.0, 1.0, 0.0},
                        place[] = {1.0, 0.1};
    static const struct {
        const char *name;
        const double *p, *q;
        double wanted[3];
    } rows[] = {{"uniform pressure", uniform, none, {-0.468222, -0.499974, -0.317516}},
                {"uniform friction", none, uniform, {-1.590421, -0.317516, -0.468222}},
                {"triangle of pressure", triangle, none, {-0.134661, -0.031647, -0.045245}},
                {"triangle of friction", none, triangle, {-0.742062, -0.045245, -0.134661}}};
    rb_rolling_case rc = rb_verify_uncoupled();
    rb_verify_on_same(&rc);
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        rb_rolling_model model = {0};
        rb_rolling_solution s;
        rb_rolling_stress at = {.sxx = NAN};
        rb_message why = {.text = ""};
        rb_status status =
            rb_rolling_model_of_nodes(&rc, 3, x, rows[k].p, rows[k].q, &model, &s, &why);
        if (status == RB_OK)
            status = rb_rolling_stress_at(&model, 1, place, &at, &why);
        rb_verify_note(v, status, &why);
        const double got[] = {at.sxx, at.syy, at.sxy};
        for (int j = 0; j < 3; j++)
            rb_verify_absolute(v, got[j], rows[k].wanted[j], 1e-6, "%s, a = 1: %s at (1, 0.1) a",
                               rows[k].name,
                               j == 0   ? "sxx"
                               : j == 1 ? "syy"
                                        : "sxy");
        rb_rolling_model_free(&model);
    }
}

/* At the bond of a layer of the base's own material at a depth of a/2: Hertz's stress, and behind
 * full sliding its peel (B19). */
static void at_bonds(rb_verify *v)
{
    for (int slides = 0; slides < 2; slides++) {
        rb_rolling_case rc = rb_verify_uncoupled();
        rb_rolling_model model = {0};
        rb_rolling_solution s = {0};
        rb_rolling_stress_maxima most = {.bonds = 0};
        double shear = NAN, peel = NAN;
        rb_message why = {.text = ""};
        rc.a.poisson = 0.3;
        rb_verify_on_same(&rc);
        rc.a.layer = 0.5 * rb_rolling_derive(&rc).half_width;
        rc.a.base_young = rc.a.young;
        rc.a.base_poisson = rc.a.poisson;
        rc.mu = slides ? 0.3 : 0.0;
        rc.formulation = slides ? RB_STEADY : RB_STATIC;
        rc.creep = slides ? -1.0 : 0.0;
        rc.mesh = RB_MESH_FITTED;
        rc.contact_elements = 200;
        rb_status status = rb_rolling_solve_model(&rc, &model, &s, &why);
        if (status == RB_OK)
            status = rb_rolling_stress_maxima_find(&model, 0.0, &most, &why);
        if (status == RB_OK) {
            shear = most.bond[0].shear.value;
            peel = most.bond[0].peel.value;
        }
        rb_verify_note(v, status, &why);
        rb_verify_relative(v, shear / s.max_pressure, slides ? 0.33971 : 0.25, 2e-3,
                           "bond at 0.5 a, mu = %g: shear / p0", rc.mu);
        if (slides)
            rb_verify_relative(v, peel / s.max_pressure, 0.00125, 0.01,
                               "bond at 0.5 a, mu = %g: peel / p0", rc.mu);
        rb_rolling_stress_maxima_free(&most);
        rb_rolling_solution_free(&s);
        rb_rolling_model_free(&model);
    }
}

/* As thick as the contact is half wide, by Chebyshev's polynomials (L9). */
static void on_smooth_base(rb_verify *v)
{
    rb_rolling_case rc = rb_verify_uncoupled();
    const rb_rolling_derived hertz = rb_rolling_derive(&rc);
    rc.half_width = NAN;
    rc.load = 1.4226461 * hertz.load;
    rc.mu = 0.0;
    rc.formulation = RB_STATIC;
    rc.mesh = RB_MESH_FITTED;
    rc.contact_elements = 100;
    rc.a.layer = hertz.half_width;
    rc.a.layer_base = RB_BASE_SMOOTH;
    const rb_rolling_solution *s = rb_verify_solve(v, &rc);
    rb_verify_relative(v, s->half_width, hertz.half_width, 2e-4, "layer on a smooth base: a");
    rb_verify_relative(v, s->max_pressure / hertz.stress, 1.4569765, 5e-4,
                       "layer on a smooth base: p0");
}

/* Moduli of hardnesses as published (docs/cookbook.md): the relations of 60 ShoreA, and ISO 48's
 * law at 100 P&J. */
static void hardness(rb_verify *v)
{
    static const struct {
        int scale;
        double reading, young[3];
    } rows[] = {{RB_RUBBER_SHORE_A, 60.0, {3.605, 3.489, 5.884}}, {RB_RUBBER_PJ, 100.0, {3.77}}};

    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        const rb_rubber_scale *scale = &rb_rubber_scales[rows[k].scale];
        for (int j = 0; j < 3 && rows[k].young[j] > 0.0; j++)
            rb_verify_relative(v, scale->relation[j].young(rows[k].reading), rows[k].young[j], 1e-3,
                               "%g %s by %s: Young's modulus / MPa", rows[k].reading, scale->name,
                               scale->relation[j].name);
    }
}

/* R 50, P 500 on layers of .1 mm, 400 GPa, .05 mm, 3 GPa, and .3 mm, 70 GPa, by Chebyshev's
 * polynomials; the stress below an ellipse of pressure and friction by 400 Gauss points (L6, L8).
 */
static void on_three_layers(rb_verify *v)
{
    static const double thickness[] = {.1, .05, .3}, young[] = {400e3, 3e3, 70e3},
                        poisson[] = {.2, .4, .33}, place[] = {.3, .12},
                        wanted[] = {-277.144, -419.726, -48.503};
    static const rb_bem_stack layers = {3, thickness, young, poisson};
    enum { NODES = 401 };
    double x[NODES], p[NODES], q[NODES];
    rb_rolling_case rc = rb_verify_uncoupled();
    rb_rolling_model model = {0};
    rb_rolling_solution s = {.max_pressure = NAN, .approach = NAN}, of_ellipse;
    rb_rolling_stress at = {.sxx = NAN};
    rb_message why = {.text = ""};

    rc.a.stack = &layers;
    rc.a.layer = thickness[0];
    rc.a.young = young[0];
    rc.a.poisson = poisson[0];
    rc.a.base_young = 210e3;
    rc.a.base_poisson = 0.3;
    rc.a.radius = 50.0;
    rc.half_width = NAN;
    rc.load = 500.0;
    rc.mu = 0.0;
    rc.formulation = RB_STATIC;
    rc.mesh = RB_MESH_UNIFORM;
    rc.zone = 0.9;
    rc.contact_elements = 240;
    rb_verify_note(v, rb_rolling_solve(&rc, &s, &why), &why);
    rb_verify_relative(v, s.max_pressure, 462.9217, 1e-4, "three layers: p0");
    rb_verify_relative(v, s.approach, 0.0116444, 1e-4, "three layers: approach");
    for (int i = 0; i < NODES; i++) {
        const double t = -cos(PI * i / (NODES - 1));
        x[i] = 0.6 * t;
        p[i] = 500.0 * sqrt(fmax(0.0, 1.0 - t * t));
        q[i] = 0.3 * p[i];
    }
    rb_status status = rb_rolling_model_of_nodes(&rc, NODES, x, p, q, &model, &of_ellipse, &why);
    if (status == RB_OK)
        status = rb_rolling_stress_at(&model, 1, place, &at, &why);
    rb_verify_note(v, status, &why);
    const double got[] = {at.sxx, at.syy, at.sxy};
    for (int j = 0; j < 3; j++)
        rb_verify_relative(v, got[j], wanted[j], 1e-4, "three layers: %s at (0.3, 0.12)",
                           j == 0   ? "sxx"
                           : j == 1 ? "syy"
                                    : "sxy");
    rb_rolling_solution_free(&s);
    rb_rolling_model_free(&model);
}

void rb_verify_bodies(rb_verify *v)
{
    /* Johnson's shakedown map (S1): k/p0 without friction, and at full sliding with
     * friction on A towards +x, by McEwen's stresses on a grid of 1e-3 a; from mu = 0.367
     * on the surface, 1/mu. */
    static const double mu[] = {0.0, 0.1, 0.2, 0.3, 0.5},
                        wanted[] = {4.0, 3.564233, 3.202365, 2.899578, 2.0};
    for (int k = 0; k < 5; k++) {
        rb_rolling_case rc = rb_verify_uncoupled();
        rc.a.poisson = 0.3;
        rb_verify_on_same(&rc);
        rc.mu = mu[k];
        rc.formulation = RB_STEADY;
        rc.creep = -1.0;
        rb_verify_relative(v, shakedown_limit(v, &rc), wanted[k], 0.01,
                           "shakedown: p0/k at full sliding, mu = %g", mu[k]);
    }
    /* Of a thin disc without friction: no residual stress changes syy = -p0 at the
     * surface, and none acts across the disc. */
    rb_rolling_case rc = rb_verify_uncoupled();
    rc.a.poisson = 0.3;
    rc.plane = RB_PLANE_STRESS;
    rc.mu = 0.0;
    rb_verify_relative(v, shakedown_limit(v, &rc), 2.0, 0.01,
                       "shakedown, plane stress: p0/k, mu = 0");
    ring(v, RB_PLANE_STRAIN);
    ring(v, RB_PLANE_STRESS);
    below_hertz(v);
    below_hertz_disc(v);
    below_layers(v);
    below_sliding(v);
    below_in_b(v);
    inside_disc(v);
    below_strips(v);
    at_bonds(v);
    on_smooth_base(v);
    hardness(v);
    on_three_layers(v);
    loads_of_pressures(v);
}
