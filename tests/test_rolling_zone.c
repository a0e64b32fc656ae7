/* The potential contact, the edges of the contact and elements fitted to them. */
#include "cases.h"
#include "rolling/rolling.h"
#include "solved.h"
#include "numbers.h"

#include <gsl/gsl_math.h>

static rb_rolling_case halfplane(double poisson, double mu, int elements)
{
    rb_rolling_case rc = half_plane(RB_STEADY, elements);

    set(&rc, "young 1000 poisson %g gap parabola mu %g", poisson, mu);
    return rc;
}

/* What every solution owes, whatever its mesh: separated elements at both ends, and edges
 * between the midpoints of the last loaded and of the first open element. */
static void check_ends(const rb_rolling_solution *s, const char *what)
{
    int first = 0, last = s->n - 1;

    assert_int_equal(s->zone[0], RB_ZONE_SEPARATED);
    assert_int_equal(s->zone[last], RB_ZONE_SEPARATED);
    while (!(s->p[first] > 0.0))
        first++;
    while (!(s->p[last] > 0.0))
        last--;
    CHECK_MAX(s->x[first - 1], s->contact_from, "%s: left edge, outer bound", what);
    CHECK_MAX(s->contact_from, s->x[first], "%s: left edge, inner bound", what);
    CHECK_MAX(s->x[last], s->contact_to, "%s: right edge, inner bound", what);
    CHECK_MAX(s->contact_to, s->x[last + 1], "%s: right edge, outer bound", what);
}

/* ---- Edges ------------------------------------------------------------------------- */

/* Full sliding: p falls like a power other than 1/2 (theory-solvers.md E1), which extrapolation
 * of p^2 misses by up to some elements. */
TEST(edges_of_sliding_contacts_are_those_of_fine_meshes)
{
    static const double poisson[] = {0.0, 0.3, -0.2}, mu[] = {1.0, 3.0, 2.0};
    for (int k = 0; k < 3; k++) {
        double edge[2] = {0.0, 0.0};
        for (int n = 400; n >= 25; n /= 2) {
            rb_rolling_case rc = halfplane(poisson[k], mu[k], n);
            set(&rc, "half-width 2 creep-ratio 4 solver newton");
            OWNED(rb_rolling_solution) s = solved(&rc);
            check_ends(&s, "sliding");
            assert_int_equal(s.stick, 0);
            if (n == 400) {
                edge[0] = s.contact_from;
                edge[1] = s.contact_to;
            }
            CHECK_ABS(s.contact_from, edge[0], 0.2 * s.h[n / 2], "left, case %d, %d", k, n);
            CHECK_ABS(s.contact_to, edge[1], s.h[n / 2], "right, case %d, %d", k, n);
        }
    }
}

/* Even the fewest elements hold the contact and see it: neither grown until it lies
 * between midpoints, nor taken for open.  The edges are those of Hertz to an element. */
TEST(few_elements_see_the_contact)
{
    for (int n = 3; n <= 12; n++)
        for (int k = 0; k < 3; k++) {
            rb_rolling_case rc = halfplane(0.3, 0.3, n);
            set(&rc, "mesh uniform formulation %s creep-ratio %g", k == 0 ? "static" : "steady",
                k == 0 ? NAN : 0.5);
            if (k == 2)
                rc.approach = 1e-16 * rc.a.radius;
            else
                rc.half_width = 1.0;
            const double a = rb_rolling_derive(&rc).half_width;
            OWNED(rb_rolling_solution) s = solved(&rc);
            check_ends(&s, "few elements");
            CHECK_ABS(s.half_width, a, 1.01 * s.h[0], "%d elements, case %d", n, k);
            CHECK_MAX(s.x[s.n - 1], 3.0 * a, "%d elements, case %d: zone", n, k);
        }
}

/* ---- Fitted elements --------------------------------------------------------------- */

static double sum(int n, const double *a, const double *h)
{
    double total = 0.0;
    for (int i = 0; i < n; i++)
        total += a[i] * h[i];
    return total;
}

/* Cases whose mesh ended inside the contact, where a corner of a punch was called solved
 * (p0 115.9 and 108, Q -0.922), and one whose edges jump to and fro by some elements. */
TEST(fitted_elements_hold_the_contact)
{
    static const struct {
        double poisson, mu, creep_ratio, load;
        int elements;
        double p0, force_ratio;
    } cases[] = {{0.1, 0.8, 0.1, 3.966655, 400, 6.309, -0.6344},
                 {-0.2, 1.0, 0.0, 12.0, 100, 12.928, -0.5566},
                 {-0.2, 2.0, -0.3, 12.0, 60, NAN, 0.0}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        rb_rolling_case rc = halfplane(cases[k].poisson, cases[k].mu, cases[k].elements);
        set(&rc, "mesh fitted load %g creep-ratio %g", cases[k].load, cases[k].creep_ratio);
        OWNED(rb_rolling_solution) s = solved(&rc);
        check_ends(&s, "fitted");
        assert_int_equal(s.equal_instead, 0);
        CHECK_REL(sum(s.n, s.p, s.h), rc.load, 1e-9, "load, case %zu", k);
        double p0 = cases[k].p0, force_ratio = cases[k].force_ratio;
        if (isnan(p0)) { /* equal elements converge to the same */
            rb_rolling_case fine = rc;
            set(&fine, "mesh uniform contact-elements 400");
            OWNED(rb_rolling_solution) f = solved(&fine);
            p0 = f.max_pressure;
            force_ratio = f.force_ratio;
        }
        CHECK_REL(s.max_pressure, p0, 1e-3, "p0, case %zu", k);
        CHECK_ABS(s.force_ratio, force_ratio, 2e-3, "Q, case %zu", k);
    }
}

/* Fitted against fine equal elements for bodies of any kind. */
TEST(fitted_and_equal_elements_agree)
{
    srand(9);
    for (int k = 0; k < 15; k++) {
        rb_rolling_case rc = halfplane(between(-0.3, 0.5), between(0.05, 3.0), 60);
        rc.half_width = exp(between(log(1e-4), log(1e-2))) * rc.a.radius;
        rc.creep_ratio = between(-1.2, 1.2);
        rc.elastic_b = rand() % 2;
        rc.b.poisson = between(-0.3, 0.5);
        rc.b.young = rc.a.young * exp(between(-2.0, 2.0));
        rb_rolling_case fine = rc;
        rc.mesh = RB_MESH_FITTED;
        fine.contact_elements = 600;
        OWNED(rb_rolling_solution) s = solved(&rc), f = solved(&fine);
        check_ends(&s, "fitted");
        check_ends(&f, "equal");
        CHECK_REL(s.approach, f.approach, 1e-3, "approach, case %d", k);
        CHECK_REL(s.max_pressure, f.max_pressure, 0.1, "p0, case %d", k);
        CHECK_ABS(s.force_ratio, f.force_ratio, 1e-2, "Q, case %d", k);
        CHECK_ABS(s.contact_from, f.contact_from, 1e-2 * s.half_width, "left, %d", k);
        CHECK_ABS(s.contact_to, f.contact_to, 1e-2 * s.half_width, "right, %d", k);
    }
}

/* Seen upside down B lies on A: the creepage and the friction change their signs and the
 * pressure stays, element by element. */
TEST(exchanged_bodies_have_the_same_pressure)
{
    srand(10);
    for (int k = 0; k < 20; k++) {
        rb_rolling_case rc = halfplane(between(-0.3, 0.5), between(0.05, 2.0), 40);
        set(&rc, "mesh %s half-width %g creep-ratio %g", k % 2 ? "fitted" : "uniform",
            1e-3 * rc.a.radius, between(-1.2, 1.2));
        rc.elastic_b = 1;
        rc.b.radius = exp(between(2.0, 6.0));
        rc.b.poisson = between(-0.3, 0.5);
        rc.b.young = rc.a.young * exp(between(-2.0, 2.0));
        rc.a.datum = rc.b.datum = 40.0;
        rb_rolling_case swapped = rc;
        swapped.a = rc.b;
        swapped.b = rc.a;
        swapped.creep_ratio = -rc.creep_ratio;
        OWNED(rb_rolling_solution) s = solved(&rc), t = solved(&swapped);
        assert_int_equal(s.n, t.n);
        for (int i = 0; i < s.n; i++) {
            CHECK_ABS(t.x[i], s.x[i], 1e-9 * s.half_width, "x, case %d at %d", k, i);
            CHECK_ABS(t.p[i], s.p[i], 1e-6 * s.max_pressure, "p, case %d at %d", k, i);
            CHECK_ABS(t.q[i], -s.q[i], 1e-6 * s.max_pressure, "q, case %d at %d", k, i);
        }
    }
}

/* ---- Potential contact ------------------------------------------------------------- */

/* A flat of half-width b worn into a parabola, under a load whose Hertz contact would be
 * much narrower than the flat. */
enum { POINTS = 2001 };
static double table_x[POINTS], table_gap[POINTS];
static rb_rolling_profile *profile;

/* The table as the gap of the case, until the next one. */
static void take_table(rb_rolling_case *rc)
{
    rb_rolling_profile_free(profile);
    profile = NULL;
    CHECK_OK(rb_rolling_profile_create(POINTS, table_x, table_gap, 0.0, &profile, &message));
    rc->gap = RB_GAP_TABLE;
    rc->profile = profile;
}

static void set_table(rb_rolling_case *rc, double half_length, double flat)
{
    for (int i = 0; i < POINTS; i++) {
        const double x = half_length * (2.0 * i / (POINTS - 1) - 1.0);
        const double beyond = fmax(0.0, fabs(x) - flat);
        table_x[i] = x;
        table_gap[i] = beyond * beyond / (2.0 * rc->a.radius);
    }
    take_table(rc);
}

TEST(a_worn_flat_is_held_by_the_potential_contact)
{
    for (int k = 0; k < 3; k++) {
        rb_rolling_case rc = halfplane(0.5, 0.3, 80);
        set(&rc, "half-width 0.02 creep-ratio 0.4 mesh %s formulation %s",
            k == 0 ? "uniform" : "fitted", k == 2 ? "static" : "steady");
        set_table(&rc, 10.0, 2.0);
        OWNED(rb_rolling_solution) s = solved(&rc);
        check_ends(&s, "flat");
        CHECK_MAX(2.0, s.half_width, "the flat is in contact");
        CHECK_MAX(s.half_width, 2.3, "and little more");
    }
}

/* ---- Patches ----------------------------------------------------------------------- */

/* Two lobes of radius 10 whose lowest points are at -+c, the right one higher by d; with
 * mirror = -1 the left one. */
static void set_lobes(rb_rolling_case *rc, double c, double d, int mirror)
{
    const double half_length = 2.0 * c;
    for (int i = 0; i < POINTS; i++) {
        const double x = half_length * (2.0 * i / (POINTS - 1) - 1.0);
        const double left = (x + mirror * c) * (x + mirror * c) / 20.0;
        table_x[i] = x;
        table_gap[i] = fmin(left, (x - mirror * c) * (x - mirror * c) / 20.0 + d);
    }
    take_table(rc);
}

/* The second patch lies far outside the first guess of the potential contact, on equal
 * elements, fitted ones, half-planes and wheels. */
TEST(every_patch_is_found)
{
    static const rb_bem_support supports[] = {RB_BEM_HALFPLANE, RB_BEM_HUB, RB_BEM_ARC};
    for (int k = 0; k < 6; k++) {
        const double c = k % 2 ? 4.0 : 3.0;
        rb_rolling_case rc = halfplane(0.3, 0.3, 40);
        set(&rc, "near-field exact mesh %s load 4 creep 0.001", k % 2 ? "fitted" : "uniform");
        rc.a.support = supports[k / 2];
        set_lobes(&rc, c, 0.004, 1);
        OWNED(rb_rolling_solution) s = solved(&rc);
        check_ends(&s, "lobes");
        assert_int_equal(s.patches, 2);
        double load = 0.0, force = 0.0;
        for (int i = 0; i < 2; i++) {
            const rb_rolling_patch *p = &s.patch[i];
            const double at = i ? c : -c;
            load += p->normal_load;
            force += p->tangential_load;
            CHECK_MAX(p->from, at, "patch %d of case %d", i, k);
            CHECK_MAX(at, p->to, "patch %d of case %d", i, k);
            CHECK_ABS(p->peak, at, 0.1, "its peak, case %d", k);
            /* each nearly Hertz's contact of its own load */
            const double E = rb_rolling_derive(&rc).modulus;
            CHECK_REL(p->max_pressure, sqrt(p->normal_load * E / (M_PI * 10.0)), 0.05,
                      "its pressure, case %d", k);
            CHECK_REL(p->to - p->from, 2.0 * sqrt(4.0 * p->normal_load * 10.0 / (M_PI * E)), 0.1,
                      "its width, case %d", k);
            CHECK_MAX(9.0, p->contact, "its elements, case %d", k);
        }
        CHECK_REL(load, s.normal_load, 1e-9, "load, case %d", k);
        CHECK_REL(force, s.tangential_load, 1e-9, "force, case %d", k);
    }
}

TEST(a_mirrored_profile_has_mirrored_patches)
{
    rb_rolling_case rc = with(halfplane(0.3, 0.3, 40), "formulation static shift 0 mu 0 load 4");
    for (int k = 0; k < 2; k++) {
        rc.mesh = k ? RB_MESH_FITTED : RB_MESH_UNIFORM;
        set_lobes(&rc, 3.0, 0.004, 1);
        OWNED(rb_rolling_solution) s = solved(&rc);
        set_lobes(&rc, 3.0, 0.004, -1);
        OWNED(rb_rolling_solution) t = solved(&rc);
        assert_int_equal(s.patches, 2);
        assert_int_equal(t.patches, 2);
        for (int i = 0; i < 2; i++) {
            CHECK_REL(t.patch[1 - i].normal_load, s.patch[i].normal_load, 1e-3, "load");
            CHECK_ABS(t.patch[1 - i].from, -s.patch[i].to, 0.02, "edge");
        }
    }
}

/* More patches than elements are fitted to. */
TEST(a_wavy_surface_gets_equal_elements)
{
    rb_rolling_case rc = with(halfplane(0.3, 0.3, 400), "mesh fitted load 40 creep 0.001");
    set_table(&rc, 8.0, 0.0);
    for (int i = 0; i < POINTS; i++)
        table_gap[i] += 0.01 * (1.0 - cos(2.0 * M_PI * table_x[i] / 0.2));
    take_table(&rc);
    OWNED(rb_rolling_solution) s = solved(&rc);
    check_ends(&s, "waves");
    CHECK_MAX(17.0, s.patches, "patches");
    assert_int_equal(s.equal_instead, 1);
    for (int i = 1; i < s.n; i++)
        CHECK_REL(s.h[i], s.h[0], 1e-9, "equal elements");
}

/* Below patches that lie far apart in comparison with their widths. */
TEST(stress_is_looked_for_below_every_patch)
{
    rb_rolling_case rc = with(halfplane(0.3, 0.0, 80), "mesh fitted load 4");
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_solution) s;
    OWNED(rb_rolling_stress_maxima) maxima = {.bonds = 0};
    set_lobes(&rc, 25.0, 0.004, 1);
    if (rb_rolling_solve_model(&rc, &model, &s, &message) != RB_OK ||
        rb_rolling_stress_maxima_find(&model, 0.0, &maxima, &message) != RB_OK)
        fail_msg("%s", message.text);
    assert_int_equal(s.patches, 2);
    const rb_rolling_patch *p = &s.patch[0]; /* the lower lobe carries more */
    const double a = 0.5 * (p->to - p->from);
    CHECK_REL(maxima.max_shear.value, 0.30028 * p->max_pressure, 5e-3, "max shear");
    CHECK_ABS(maxima.max_shear.x, -25.0, 0.05 * a, "its place");
    CHECK_REL(maxima.max_shear.y, 0.78615 * a, 2e-2, "its depth");
}

TEST(a_given_zone_must_hold_every_patch)
{
    rb_rolling_case rc = with(halfplane(0.3, 0.3, 40), "load 4 creep 0.001");
    OWNED(rb_rolling_solution) s;
    set_lobes(&rc, 3.0, 0.004, 1);
    for (int i = 0; i < POINTS; i++) /* the first lobe to the middle */
        table_x[i] += 3.0;
    take_table(&rc);
    rc.zone = 1.0;
    CHECK_SAYS(rb_rolling_solve(&rc, &s, &message), RB_ZONE, "widen it");
}

/* ---- Refusals ---------------------------------------------------------------------- */

TEST(a_contact_without_an_end_is_refused)
{
    rb_rolling_case rc = with(halfplane(0.5, 0.3, 60), "half-width 1 creep-ratio 0.4");
    rb_rolling_solution s;
    set_table(&rc, 0.6, 0.0);
    for (int k = 0; k < 2; k++) {
        rc.mesh = k ? RB_MESH_FITTED : RB_MESH_UNIFORM;
        CHECK_SAYS(rb_rolling_solve(&rc, &s, &message), RB_ZONE, "table");
        assert_int_equal(s.status, RB_ZONE);
        rb_rolling_solution_free(&s);
    }
}

TEST(a_curve_and_a_history_find_the_end_of_their_mesh)
{
    rb_rolling_case rc = with(halfplane(0.0, 1.0, 40), "half-width 1");
    rb_rolling_curve curve;
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_history) history;
    rc.zone = 1.2; /* sliding moves the contact beyond it */
    CHECK_STATUS(rb_rolling_curve_solve(&rc, &(rb_rolling_range){0, 0.0, 3.0, 7, RB_UNITS_MM},
                                        &curve, &message),
                 RB_ZONE);
    rb_rolling_curve_free(&curve);
    set(&rc, "formulation transient creep-ratio 3 distance 3");
    CHECK_STATUS(rb_rolling_history_run(&rc, NULL, NULL, &model, &history, &message), RB_ZONE);
    assert_int_equal(model.state.status, RB_ZONE);
    rc.zone = 0.0;
    CHECK_OK(rb_rolling_curve_solve(&rc, &(rb_rolling_range){0, 0.0, 3.0, 7, RB_UNITS_MM}, &curve,
                                    &message));
    rb_rolling_curve_free(&curve);
}

/* The first zone, 1.3 half-widths, stays where three separated elements stand at either
 * end of it, and grows otherwise. */
TEST(a_zone_ends_with_three_separated_elements)
{
    int kept = 0, grown = 0;
    for (int n = 20; n <= 44; n += 2) {
        rb_rolling_case rc = with(halfplane(0.3, 0.0, n), "mu 0");
        set(&rc, "load %g half-width nan", rb_rolling_hertz_load(&rc, 1.0));
        OWNED(rb_rolling_solution) first, s = solved(&rc);
        CHECK_OK(rb_rolling_solve_between(&rc, -1.3, 1.3, &first, NULL));
        int left = 0, right = 0;
        while (first.zone[left] == RB_ZONE_SEPARATED)
            left++;
        while (first.zone[n - 1 - right] == RB_ZONE_SEPARATED)
            right++;
        assert_int_equal(left, right);
        const double end = s.x[n - 1] + 0.5 * s.h[n - 1];
        if (left >= 3)
            CHECK_REL(end, 1.3, 1e-12, "%d elements", n);
        else
            CHECK_REL(end, 1.3 * 1.3, 1e-12, "%d elements", n);
        kept += left == 3;
        grown += left < 3;
    }
    assert_true(kept > 0 && grown > 0);
}

/* Under a very soft third body the surfaces stay as they are: pressed by an approach,
 * they touch to sqrt(2 R delta); by a load, P = 2 a^3/(3 R L). */
TEST(a_soft_interlayer_has_the_zone_of_its_own_contact)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = halfplane(0.3, 0.0, 40);
        const double R = rc.a.radius, L = 10.0, a = 2.0;
        rc.interlayer_normal = L;
        if (k)
            rc.load = 2.0 * a * a * a / (3.0 * R * L);
        else
            rc.approach = 0.5 * a * a / R;
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_REL(s.x[39] + 0.5 * s.h[39], 1.3 * a, 1e-12, "zone");
        CHECK_ABS(s.contact_to, a, s.h[0], "contact, to an element");
    }
}

/* No choice on the way depends on the unit of length: the potential contact of a layer,
 * which is tightened, and all results are as many times larger. */
TEST(a_contact_has_the_same_zone_in_every_unit)
{
    double ends[2], width[2];
    for (int k = 0; k < 2; k++) {
        const double unit = k ? 1e-3 : 1e3;
        rb_rolling_case rc = with(halfplane(0.3, 0.3, 40), "young 94500");
        rc.a.radius *= unit;
        set(&rc, "layer-thickness %g load %g half-width nan creep-ratio 0.4", 0.2 * unit,
            300.0 * unit);
        OWNED(rb_rolling_solution) s = solved(&rc);
        ends[k] = (s.x[s.n - 1] + 0.5 * s.h[s.n - 1]) / unit;
        width[k] = s.half_width / unit;
        CHECK_MAX(ends[k], 0.9 * 1.3 * rb_rolling_derive(&rc).half_width / unit, "tightened");
    }
    CHECK_REL(ends[1], ends[0], 1e-9, "the end of the zone");
    CHECK_REL(width[1], width[0], 1e-9, "the half-width");
}

/* Similar bodies roll freely without creepage unless something displaces their surfaces:
 * d_T everywhere, which -d_T/e_T undoes. */
TEST(free_rolling_undoes_what_displaces)
{
    rb_rolling_case rc = with(halfplane(0.5, 0.3, 20), "half-width 1 creep-ratio 0.4");
    double creepage;
    OWNED(rb_rolling_model) model = solved_model(&rc);
    CHECK_OK(rb_rolling_free_creepage(&model, &creepage, NULL));
    CHECK_ABS(creepage, 0.0, 0.0, "nothing displaces");
    for (int i = 0; i < model.problem.n; i++)
        model.problem.d_T[i] = 1e-3 * model.problem.e_T[i];
    CHECK_OK(rb_rolling_free_creepage(&model, &creepage, NULL));
    CHECK_REL(creepage, -1e-3, 1e-9, "d_T");
}

/* Sliding towards one side the contact fits elements that end before the contact that
 * rolls freely does: that one is looked for on elements of its own. */
TEST(free_rolling_may_need_other_elements)
{
    rb_rolling_case rc = with(halfplane(0.0, 1.0, 80), "half-width 1 force-ratio 0");
    OWNED(rb_rolling_model) model;
    rb_rolling_mesh mesh;
    double creepage;
    OWNED(rb_rolling_solution) freely = solved(&rc);
    set(&rc, "force-ratio nan creep-ratio 3");
    CHECK_OK(rb_rolling_model_begin(&rc, NULL, &model, &message));
    CHECK_OK(rb_rolling_mesh_uniform(&rc, NULL, -0.85, 1.6, &mesh, &message));
    CHECK_OK(rb_rolling_model_build(&model, &mesh, &message));
    CHECK_OK(rb_rolling_free_creepage(&model, &creepage, &message));
    CHECK_REL(creepage, freely.creepage, 1e-9, "on its own elements");
    case_of_model(&model)->zone = 1.6; /* a given zone stays */
    CHECK_STATUS(rb_rolling_free_creepage(&model, &creepage, &message), RB_ZONE);
}

TEST(every_failed_allocation_is_reported)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = halfplane(0.3, 0.3, 8);
        set(&rc, "load 4 creep 0.001 mesh %s", k ? "fitted" : "uniform");
        set_lobes(&rc, 1.0, 0.004, 1);
        for (int count = 0, refused = 1; refused; count += k ? 61 : 11) {
            OWNED(rb_rolling_solution) s;
            refused = REFUSED_FROM(count, rb_rolling_solve(&rc, &s, NULL));
        }
    }
}

/* At rest the table holds the contact, in sliding not: the zone grows to all of it, and
 * then there is nothing more. */
TEST(a_history_grows_its_zone_to_the_end_of_the_table)
{
    rb_rolling_case rc = halfplane(0.0, 1.0, 40);
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_history) history;
    set(&rc, "half-width 1 formulation transient creep-ratio 3 distance 3");
    set_table(&rc, 1.25, 0.0);
    CHECK_SAYS(rb_rolling_history_run(&rc, NULL, NULL, &model, &history, &message), RB_ZONE,
               "table");
    CHECK_ABS(model.mesh.ends[model.mesh.n], 1.25, 1e-2, "the widest zone");
}

/* An incompressible layer carries by waves as short as it is thick: so long an element
 * may be, and no longer. */
TEST(elements_are_as_long_as_the_layer_at_most)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = with(halfplane(0.5, 0.0, 20), "mu 0 half-width 0.5");
        OWNED(rb_rolling_solution) s;
        rc.zone = 1.0; /* elements of 0.1 */
        rc.a.layer = k ? 0.1 * (1.0 - 1e-6) : 0.1;
        CHECK_STATUS(rb_rolling_solve(&rc, &s, &message), k ? RB_EINVAL : RB_OK);
        if (k)
            assert_non_null(strstr(message.text, "layer-thickness: with nu = 0.5"));
    }
}

int main(void)
{
    const int failed = run_all_tests(NULL, NULL);
    rb_rolling_profile_free(profile);
    return failed;
}
