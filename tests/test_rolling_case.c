/* Cases that must be refused, each with its reason, and the quantities derived from good
 * ones. */
#include "refused.h"
#include "rolling/case/options.h"
#include "rolling/rolling.h"

#include <gsl/gsl_math.h>
#include <stddef.h>

typedef struct {
    const char *word; /* that the refusal must contain */
    size_t field;     /* of the double that is wrong */
    double value;
} bad_value;

#define FIELD(name) offsetof(rb_rolling_case, name)

static const bad_value bad_values[] = {
    {"mu", FIELD(mu), -0.1},
    {"mu", FIELD(mu), NAN},
    {"mu", FIELD(mu), INFINITY},
    {"young: expected a number > 0, got 0", FIELD(a.young), 0.0},
    {"young", FIELD(a.young), NAN},
    {"poisson: expected a number in (-1, 0.5]", FIELD(a.poisson), 0.51},
    {"poisson", FIELD(a.poisson), -1.0},
    {"radius", FIELD(a.radius), -1.0},
    {"radius", FIELD(a.radius), INFINITY},
    {"arc", FIELD(a.arc), 91.0},
    {"approach", FIELD(approach), -1.0},
    {"load", FIELD(load), 0.0},
    {"half-width", FIELD(half_width), -2.0},
    {"shift", FIELD(shift), INFINITY},
    {"zone", FIELD(zone), -1.0},
    {"zone", FIELD(zone), 50.0},
    {"tol", FIELD(contact.tol), 0.0},
    {"force-ratio", FIELD(force_ratio), 1.1},
};

TEST(bad_values_are_refused_by_name)
{
    for (size_t k = 0; k < sizeof bad_values / sizeof *bad_values; k++) {
        rb_rolling_case rc = rb_rolling_case_defaults();
        memcpy((char *)&rc + bad_values[k].field, &bad_values[k].value, sizeof(double));
        CHECK_SAYS(rb_rolling_case_check(&rc, &message), RB_EINVAL, bad_values[k].word);
    }
}

/* Cases in which, between them, every option of a body has a meaning. */
static void make_bodies(int k, rb_rolling_case *rc)
{
    static const rb_bem_support support[] = {RB_BEM_ARC, RB_BEM_HUB, RB_BEM_HALFPLANE};
    *rc = rb_rolling_case_defaults();
    rc->a.support = support[k];
    rc->a.cover = support[k] == RB_BEM_HUB ? 1.0 : 0.0;
    rc->a.layer = support[k] == RB_BEM_HALFPLANE ? 1.0 : 0.0;
    rc->a.core_young = rc->a.base_young = 1.0;
    rc->b = rc->a;
    rc->elastic_b = 1;
    rc->heat_a = (rb_rolling_heat){.conductivity = 1.0, .heat_capacity = 1.0};
}

/* 1 if the table refuses x in this case, by the name of the option. */
static int is_refused(const rb_option *o, size_t place, double x, rb_rolling_case rc)
{
    rb_message why = {.text = ""};
    const int whole = (int)x;
    char start[60];
    memcpy((char *)&rc + place,
           o->kind == RB_OPTION_INTEGER ? (const void *)&whole : (const void *)&x,
           o->kind == RB_OPTION_INTEGER ? sizeof whole : sizeof x);
    snprintf(start, sizeof start, "%s: expected a", o->name);
    return rb_rolling_case_check(&rc, &why) == RB_EINVAL &&
           strncmp(why.text, start, strlen(start)) == 0;
}

TEST(each_range_of_the_table_holds_in_a_case)
{
    int refused = 0;
    for (const rb_option *o = rb_case_table; o < rb_case_table + rb_case_table_n; o++) {
        const size_t place = o->into ? o->into : o->offset;
        const rb_range *r = &o->range;
        const double below = r->from_open ? r->from : r->from - 1.0,
                     above = r->to_open ? r->to : r->to + 1.0;
        int applies = 0;
        if ((o->kind != RB_OPTION_NUMBER && o->kind != RB_OPTION_INTEGER) ||
            place >= sizeof(rb_rolling_case))
            continue;
        for (int k = 0; k < 3; k++) {
            rb_rolling_case rc;
            make_bodies(k, &rc);
            if (!rb_option_applies(o, &rc.a))
                continue;
            applies = 1;
            /* zero and infinity may be a word of the option, or that it is not given */
            const double beyond[] = {below == 0.0 ? -1.0 : below, above};
            for (int j = 0; j < 2; j++) {
                const int whole = o->kind == RB_OPTION_INTEGER;
                if ((whole && isinf(beyond[j])) || (o->word && beyond[j] == o->word_value))
                    continue;
                if (!is_refused(o, place, beyond[j], rc))
                    fail_msg("%s = %g is not refused", o->name, beyond[j]);
                refused++;
            }
        }
        assert_true(applies);
    }
    assert_true(refused > 150);
}

TEST(contradictions_name_both_sides)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.approach = rc.load = 1.0;
    check_refused(&rc, "approach", "load");

    rc = rb_rolling_case_defaults();
    rc.creep = rc.creep_ratio = 0.1;
    check_refused(&rc, "creep", "creep-ratio");

    rc = rb_rolling_case_defaults();
    rc.formulation = RB_STEADY;
    rc.shift = 0.1;
    check_refused(&rc, "shift", "creep");

    rc = rb_rolling_case_defaults();
    rc.formulation = RB_STEADY;
    rc.creep = rc.force = 0.1;
    check_refused(&rc, "creep", "force");

    rc = rb_rolling_case_defaults();
    rc.load = 10.0;
    rc.force = 3.1; /* mu P = 3 */
    check_refused(&rc, "force", "mu P");

    rc = rb_rolling_case_defaults();
    rc.a.support = RB_BEM_HALFPLANE;
    rc.normals = RB_BEM_NORMALS_SURFACE;
    check_refused(&rc, "normals", "half-plane");
}

/* One of each list determines the contact, and any two of it contradict each other,
 * whatever the third ones are. */
TEST(any_two_controls_are_refused)
{
    static const struct {
        const char *text;
        rb_rolling_formulation formulation;
        int n;
        size_t field[4];
        double value;
    } lists[] = {
        {"exclude each other",
         RB_STATIC,
         3,
         {FIELD(approach), FIELD(load), FIELD(half_width)},
         1.0},
        {"exclude each other", RB_STATIC, 3, {FIELD(shift), FIELD(force), FIELD(force_ratio)}, 0.1},
        {"exclude each other",
         RB_STEADY,
         4,
         {FIELD(creep), FIELD(creep_ratio), FIELD(force), FIELD(force_ratio)},
         0.1},
        {"exclude each other",
         RB_TRANSIENT,
         4,
         {FIELD(creep), FIELD(creep_ratio), FIELD(force), FIELD(force_ratio)},
         0.1}};
    for (size_t l = 0; l < sizeof lists / sizeof *lists; l++)
        for (int given = 1; given < 1 << lists[l].n; given++) {
            rb_rolling_case rc = rb_rolling_case_defaults();
            rc.formulation = lists[l].formulation;
            for (int i = 0; i < lists[l].n; i++)
                if (given >> i & 1)
                    memcpy((char *)&rc + lists[l].field[i], &lists[l].value, sizeof(double));
            if (given & (given - 1))
                check_refused(&rc, lists[l].text, "");
            else if (rb_rolling_case_check(&rc, &message) != RB_OK)
                fail_msg("list %d, control %d: %s", (int)l, given, message.text);
        }
    for (int i = 0; i < 5; i++) {
        static const size_t field[5] = {FIELD(shift), FIELD(creep), FIELD(creep_ratio),
                                        FIELD(force), FIELD(force_ratio)};
        const double value = 0.1;
        rb_rolling_case rc = rb_rolling_case_defaults();
        rc.formulation = i ? RB_STEADY : RB_STATIC;
        rc.free_axle = 1;
        memcpy((char *)&rc + field[i], &value, sizeof(double));
        check_refused(&rc, "free-axle: it excludes", "");
    }
}

TEST(a_table_gap_needs_its_table)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.gap = RB_GAP_TABLE;
    check_refused(&rc, "gap", "none is given");
}

/* ---- Every range, from both sides -------------------------------------------------- */

TEST(ranges_of_the_bodies)
{
    ACCEPTED(rc.a.poisson = 0.5);
    REFUSED("young: expected a number > 0, got inf", rc.a.young = INFINITY);
    REFUSED("radius-b: expected > 0", rc.elastic_b = 1; rc.b.radius = 0.0);
    REFUSED("support: there is no number 7", rc.a.support = (rb_bem_support)7);
    REFUSED("support-b: a plane has", rc.elastic_b = 1; rc.b.support = RB_BEM_HUB);
    ACCEPTED(rc.a.arc = 90.0);
    REFUSED("arc: expected a number in (0, 90]", rc.a.arc = 0.0);
    ACCEPTED(HUB; rc.a.hub_ratio = 0.999);
    REFUSED("hub-ratio: expected a number in (0, 1), got 0", HUB; rc.a.hub_ratio = 0.0);
    REFUSED("hub-ratio: expected a number in (0, 1), got 1", HUB; rc.a.hub_ratio = 1.0);
    ACCEPTED(PLANE; rc.a.datum = 0.0);
    REFUSED("datum: expected a number > 0 or auto", PLANE; rc.a.datum = -1.0);
    REFUSED("datum-b: expected", rc.elastic_b = 1; rc.b.datum = INFINITY);
}

TEST(ranges_of_layers_and_covers)
{
    ACCEPTED(PLANE; rc.a.base_poisson = 9.0); /* there is no layer */
    REFUSED("base-poisson: expected", PLANE; rc.a.layer = 1.0; rc.a.base_poisson = 9.0);
    ACCEPTED(PLANE; rc.a.layer = 1.0; rc.a.base_young = 1.0; rc.a.base_poisson = 0.5);
    REFUSED("layer-thickness: expected a number > 0 or none", PLANE; rc.a.layer = -1.0);
    REFUSED("layer-thickness: expected a number > 0 or none", PLANE; rc.a.layer = INFINITY);
    REFUSED("for the support halfplane only", HUB; rc.a.layer = 1.0);
    REFUSED("base-young: expected a number > 0 or rigid, got -1", PLANE; rc.a.layer = 1.0;
            rc.a.base_young = -1.0);
    REFUSED("base-young: expected", PLANE; rc.a.layer = 1.0; rc.a.base_young = INFINITY);
    REFUSED("base-poisson: expected a number in (-1, 0.5], got -1", PLANE; rc.a.layer = 1.0;
            rc.a.base_young = 1.0; rc.a.base_poisson = -1.0);
    REFUSED("base-poisson: expected", PLANE; rc.a.layer = 1.0; rc.a.base_young = 1.0;
            rc.a.base_poisson = 0.51);

    ACCEPTED(HUB; rc.a.cover = 49.0; rc.a.core_young = 1.0; rc.a.poisson = 0.499);
    ACCEPTED(HUB; rc.a.cover = 49.0; rc.a.poisson = 0.5);
    REFUSED("cover-thickness: its core holds the wheel", rc.a.cover = 1.0);
    REFUSED("cover-thickness: expected a number > 0 or none", HUB; rc.a.cover = -1.0);
    REFUSED("cover-thickness: expected a number > 0", HUB; rc.a.cover = NAN);
    REFUSED("cover-thickness: expected less than the radius", HUB; rc.a.cover = 50.0);
    ACCEPTED(HUB; rc.a.cover = 1.0; rc.a.core_young = 1.0; rc.a.poisson = 0.5);
    REFUSED("near-field: boundary elements of a cover", HUB; rc.a.cover = 1.0;
            rc.a.core_young = 1.0; rc.a.poisson = 0.4991; rc.near_field = RB_NEAR_FIELD_EXACT);
    REFUSED("core-poisson: expected", HUB; rc.a.cover = 1.0; rc.a.core_young = 1.0;
            rc.a.core_poisson = 0.51);
}

TEST(ranges_of_relaxation)
{
    const rb_rolling_memory one = {1, {2.0}, {0.5}}, late = {1, {0.0}, {0.5}},
                            less = {1, {1.0}, {-0.1}}, endless = {1, {1.0}, {INFINITY}},
                            none = {1, {1.0}, {0.0}};
    const double x[2] = {-1.0, 1.0}, y[2] = {0.0, 0.0};

    ACCEPTED(PLANE; rc.a.memory = one);
    ACCEPTED(PLANE; rc.a.memory = none; rc.time_step = 0.1);
    ACCEPTED(HUB; rc.a.memory = one; STEADY; rc.speed = 1.0);
    ACCEPTED(PLANE; rc.a.memory = one; rc.a.layer = 1.0);
    ACCEPTED(PLANE; rc.a.memory = one; rc.a.layer = 1.0; rc.a.base_young = 1.0; STEADY;
             rc.speed = 1.0);
    REFUSED("terms, got -1", rc.a.memory.n = -1);
    REFUSED("terms, got 17", PLANE; rc.a.memory.n = RB_ROLLING_TERMS + 1);
    REFUSED("relaxation-time: expected a number > 0", PLANE; rc.a.memory = late);
    REFUSED("relaxation-ratio: expected a number >= 0", PLANE; rc.a.memory = less);
    REFUSED("relaxation-ratio: expected a number >= 0", PLANE; rc.a.memory = endless);
    ACCEPTED(PLANE; rc.a.memory = one; TRANSIENT; rc.steps = 3; rc.speed = 1.0);
    REFUSED("a clamped arc cannot turn", rc.a.memory = one; STEADY; rc.speed = 1.0);
    REFUSED("in transient rolling for the support halfplane", HUB; rc.a.memory = one; TRANSIENT;
            rc.speed = 1.0);
    REFUSED("must be rigid, got an elastic one", PLANE; rc.a.memory = one; rc.a.layer = 1.0;
            rc.a.base_young = 1.0);
    REFUSED("must be rigid, got an elastic one", HUB; rc.a.memory = one; rc.a.cover = 1.0;
            rc.a.core_young = 1.0);
    REFUSED("relaxation-time: needs the speed", PLANE; rc.a.memory = one; STEADY);
    REFUSED("speed: expected a number > 0, got inf", PLANE; rc.a.memory = one; TRANSIENT;
            rc.speed = INFINITY);
    REFUSED("a computation with steps needs a parabola", PLANE; rc.a.memory = one;
            rc.gap = RB_GAP_TABLE);
    REFUSED("a computation with steps needs a parabola", PLANE; rc.a.memory = one;
            rc.worn = ((rb_rolling_table){2, x, y}));
    REFUSED("a computation with steps needs a parabola", PLANE; rc.a.memory = one;
            rc.irregularity = ((rb_rolling_table){2, x, y}));
    REFUSED("time-step: expected a number > 0 or rows", PLANE; rc.a.memory = one;
            rc.time_step = -1.0);
    REFUSED("time-step: expected a number > 0 or rows", PLANE; rc.a.memory = one;
            rc.time_step = INFINITY);
    REFUSED("relaxation-time: needs the speed", PLANE; rc.elastic_b = 1; rc.b.memory = one; STEADY);
    ACCEPTED(PLANE; rc.b.memory = one; STEADY); /* B is rigid */
}

TEST(ranges_of_heat)
{
    ACCEPTED(WARM);
    ACCEPTED(WARM; TRANSIENT);
    ACCEPTED(WARM; rc.heat_a.conductivity = 0.0; rc.heat_b.heat_capacity = -1.0);
    REFUSED("heat-capacity: expected a number > 0 or none, got -1", WARM;
            rc.heat_a.heat_capacity = -1.0);
    ACCEPTED(WARM; rc.heat_b.temperature = 20.0);
    ACCEPTED(WARM; rc.contact_elements = 100000);
    ACCEPTED(WARM; rc.heat_b = rc.heat_a; rc.contact_elements = 100000);
    ACCEPTED(WARM; rc.heat_b.temperature = 1.0; rc.contact_elements = 4001);
    REFUSED("conductivity: expected a number > 0 or none, got -1", WARM;
            rc.heat_a.conductivity = -1.0);
    REFUSED("conductivity: expected a number > 0 or none, got inf", WARM;
            rc.heat_a.conductivity = INFINITY);
    REFUSED("conductivity-b: expected a number >= 0", WARM; rc.heat_b.conductivity = -1.0);
    REFUSED("conductivity-b: expected a number >= 0", WARM; rc.heat_b.conductivity = INFINITY);
    REFUSED("needs the heat capacity", WARM; rc.heat_a.heat_capacity = 0.0);
    REFUSED("needs the heat capacity", WARM; rc.heat_b.conductivity = 1.0;
            rc.heat_b.heat_capacity = 0.0);
    REFUSED("temperature: expected a number, got inf", WARM; rc.heat_a.temperature = INFINITY);
    REFUSED("temperature-b: expected a number, got", WARM; rc.heat_b.temperature = NAN);
    REFUSED("a layer or cover conducts differently", WARM; rc.a.layer = 1.0);
    REFUSED("a layer or cover conducts differently", WARM; rc.a.support = RB_BEM_HUB;
            rc.a.cover = 1.0);
    REFUSED("a layer or cover conducts differently", WARM; rc.elastic_b = 1; rc.b.layer = 1.0);
    REFUSED("a viscoelastic body is also heated inside", WARM;
            rc.a.memory = (rb_rolling_memory){.n = 1, .time = {1.0}, .ratio = {1.0}});
    REFUSED("both bodies must have the same temperature", WARM; TRANSIENT;
            rc.heat_b.temperature = 20.0);
    REFUSED("at most 100000 contact elements, got 100001", WARM; rc.contact_elements = 100001);
    for (int k = 0; k < 3; k++)
        REFUSED("at most 4000 contact elements of bodies that conduct differently", WARM;
                rc.heat_b = rc.heat_a; rc.contact_elements = 4001;
                *(k == 0   ? &rc.heat_b.conductivity
                  : k == 1 ? &rc.heat_b.heat_capacity
                           : &rc.heat_b.temperature) += 1.0);
}

TEST(ranges_of_the_interface)
{
    ACCEPTED(rc.yield_stress = 1.0; rc.hardening = -1.0);
    REFUSED("interlayer-normal: expected a number >= 0", rc.interlayer_normal = -1.0);
    REFUSED("interlayer-tangential: expected a number >= 0", rc.interlayer_tangential = INFINITY);
    REFUSED("yield-stress: expected a number > 0 or none", rc.yield_stress = -1.0);
    REFUSED("yield-stress: expected a number > 0 or none", rc.yield_stress = INFINITY);
    REFUSED("hardening: expected a number, got", rc.yield_stress = 1.0; rc.hardening = INFINITY);
    REFUSED("hardening: only for an interface that yields", rc.hardening = 1.0);
    REFUSED("not with a law that follows slip or heat", WARM; rc.yield_stress = 1.0;
            rc.friction.heat = -0.1; rc.friction.heat_range = 100.0);
    REFUSED("not with a law that follows slip or heat", STEADY; rc.speed = 1.0;
            rc.yield_stress = 1.0; rc.friction.law = RB_FRICTION_linear; rc.friction.fall[0] = 0.1;
            rc.friction.slip_scale[0] = 1.0);
    REFUSED("solves Coulomb's law only", rc.yield_stress = 1.0; rc.contact.solver = RB_SOLVER_CONE;
            rc.contact.cone_solver.name = "semismooth");
}

/* What friction can carry: mu P = 3. */
TEST(ranges_of_the_loading)
{
    ACCEPTED(rc.load = 10.0; rc.force = 3.0);
    ACCEPTED(rc.load = 10.0; rc.force = -3.0);
    REFUSED("friction carries at most mu P = 3 N/mm", rc.load = 10.0; rc.force = 3.00001);
    REFUSED("friction carries at most mu P = 3 N/mm", rc.load = 10.0; rc.force = -3.00001);
    ACCEPTED(rc.force = 1e9); /* the load is not known before */
    ACCEPTED(rc.force_ratio = -1.0);
    REFUSED("friction carries at most 1", rc.force_ratio = -1.01);
    ACCEPTED(rc.force_ratio = 0.0; rc.mu = 0.0);
    REFUSED("has no meaning at mu = 0", rc.force_ratio = 0.1; rc.mu = 0.0);
    REFUSED("has no meaning at mu = 0", rc.creep_ratio = 0.1; rc.mu = 0.0);
    REFUSED("creep: expected a number, got -inf", rc.creep = -INFINITY);
    REFUSED("force-ratio: expected a number, got inf", rc.force_ratio = INFINITY);
    REFUSED("shift, force and force-ratio exclude", rc.shift = 0.1; rc.force = 0.1);
    REFUSED("shift, force and force-ratio exclude", rc.force_ratio = rc.force = 0.1);
    ACCEPTED(rc.shift = rc.creep = 0.1);
    REFUSED("rolling is driven by", TRANSIENT; rc.shift = 0.1);
    REFUSED("creep, creep-ratio, force and force-ratio exclude", STEADY;
            rc.creep_ratio = rc.force_ratio = 0.1);
    ACCEPTED(STEADY; rc.free_axle = 1);
    REFUSED("free-axle: it excludes", STEADY; rc.free_axle = 1; rc.creep = 0.0);
    REFUSED("free-axle: it needs steady rolling", TRANSIENT; rc.free_axle = 1);
    REFUSED("only friction turns it", STEADY; rc.free_axle = 1; rc.mu = 0.0);

    ACCEPTED(rc.half_width = 49.9);
    REFUSED("less than the radius of either body, 50 mm", rc.half_width = 50.0);
    REFUSED("less than the radius of either body, 20 mm", rc.elastic_b = 1; rc.b.radius = 20.0;
            rc.half_width = 20.0);
    REFUSED("approach, load, half-width, max-pressure and wheel-load exclude each other",
            rc.half_width = rc.load = 1.0);
    REFUSED("approach: expected a number > 0", rc.approach = INFINITY);
}

TEST(ranges_of_tables)
{
    const double x[3] = {-1.0, 0.0, 1.0}, back[3] = {-1.0, 1.0, 1.0}, gone[3] = {-1.0, NAN, 1.0},
                 dent[3] = {0.0, 0.1, 0.0}, begins[3] = {0.1, 0.1, 0.0}, ends[3] = {0.0, 0.1, 0.1};
#define TABLE(x, y) ((rb_rolling_table){3, x, y})
    ACCEPTED(rc.irregularity = TABLE(x, dent));
    REFUSED("irregularity: row 1: expected gap 0", rc.irregularity = TABLE(x, begins));
    REFUSED("irregularity: row 3: expected gap 0", rc.irregularity = TABLE(x, ends));
    REFUSED("irregularity: row 3", rc.irregularity = TABLE(back, dent));
    REFUSED("irregularity: row 2", rc.irregularity = TABLE(gone, dent));
    REFUSED("irregularity: row 2", rc.irregularity = TABLE(x, gone));
    REFUSED("irregularity: only for transient rolling", STEADY; rc.irregularity = TABLE(x, dent));
    ACCEPTED(rc.worn = TABLE(x, begins));
    REFUSED("worn: row 3", rc.worn = TABLE(back, dent));
    REFUSED("worn: row 2", rc.worn = TABLE(gone, dent));
    REFUSED("worn: row 2", rc.worn = TABLE(x, gone));
#undef TABLE
}

static rb_rolling_memory relaxing(double time)
{
    return (rb_rolling_memory){1, {time}, {1.0}};
}

static rb_status solve_nothing(const char *name, const rb_contact_cone *cone, double tol, double *r,
                               int *iterations, rb_message *why)
{
    (void)name, (void)cone, (void)tol, (void)r, (void)iterations, (void)why;
    return RB_OK;
}

TEST(ranges_of_the_mesh)
{
    ACCEPTED(rc.contact_elements = 3; rc.increments = 1000000);
    ACCEPTED(rc.contact_elements = 1 << 24; rc.outer_elements = 1000000);
    REFUSED("contact-elements: expected a whole number in [3, 16777216], got 2",
            rc.contact_elements = 2);
    REFUSED("contact-elements: expected a whole number in [3, 16777216], got 16777217",
            rc.contact_elements = (1 << 24) + 1);
    REFUSED("outer-elements: expected a whole number in [0, 1e+06], got -1",
            rc.outer_elements = -1);
    REFUSED("outer-elements: expected a whole number in [0, 1e+06], got 1000001",
            rc.outer_elements = 1000001);
    ACCEPTED(rc.outer_refinement = 1000.0);
    REFUSED("outer-refinement: expected 0", rc.outer_refinement = 1001.0);
    REFUSED("outer-refinement: expected 0", rc.outer_refinement = -1.0);
    REFUSED("increments: expected a whole number in [0, 1e+06]", rc.increments = -1);
    REFUSED("increments: expected a whole number in [0, 1e+06]", rc.increments = 1000001);
    ACCEPTED(STEADY; rc.increments = 1);
    REFUSED("steady rolling does not depend", STEADY; rc.increments = 2);
    ACCEPTED(rc.zone = 49.9);
    REFUSED("zone: expected a number > 0 or auto", rc.zone = INFINITY);
    REFUSED("wider than the radius, 20 mm", rc.elastic_b = 1; rc.b.radius = 20.0; rc.zone = 20.0);
    ACCEPTED(rc.mesh = RB_MESH_ALIGNED; rc.contact_elements = 12);
    REFUSED("contact-elements: expected 12", rc.mesh = RB_MESH_ALIGNED; rc.contact_elements = 11);
    ACCEPTED(STEADY; rc.slip_operator = RB_SLIP_SECOND);
    REFUSED("slip-operator: second is only for steady", rc.slip_operator = RB_SLIP_SECOND);
    REFUSED("slip-operator: second is only for equal", STEADY; rc.slip_operator = RB_SLIP_SECOND;
            rc.mesh = RB_MESH_FITTED);
    ACCEPTED(rc.normals = RB_BEM_NORMALS_SURFACE);
    REFUSED("with a rigid plane only", rc.normals = RB_BEM_NORMALS_SURFACE; rc.elastic_b = 1);
    ACCEPTED(rc.contact.solver = RB_SOLVER_CONE; rc.contact.cone_solver.name = "newton";
             rc.contact.cone_solver.solve = solve_nothing);
    REFUSED("got ''", rc.contact.solver = RB_SOLVER_CONE);
    REFUSED("got 'sor'", rc.contact.solver = RB_SOLVER_CONE; rc.contact.cone_solver.name = "sor");
    REFUSED("tol: expected a number > 0", rc.contact.tol = INFINITY);
    ACCEPTED(rc.a.young = 1e-100);
    REFUSED("young: expected a size", rc.a.young = 0.9e-100);
    ACCEPTED(rc.load = 1e100);
    REFUSED("load: expected a size", rc.load = 1.1e100);
    REFUSED("young-b: expected a size", rc.elastic_b = 1; rc.b.young = 1e101);
    REFUSED("radius-b: expected a size", rc.elastic_b = 1; rc.b.radius = 1e101);
    ACCEPTED(PLANE; STEADY; rc.a.memory = relaxing(1e100); rc.speed = 1e-100);
    ACCEPTED(PLANE; STEADY; rc.a.memory = relaxing(1e-100); rc.speed = 1e100);
    REFUSED("speed: expected a size", PLANE; STEADY; rc.a.memory = relaxing(1.0);
            rc.speed = 0.9e-100);
    REFUSED("speed: expected a size", PLANE; STEADY; rc.a.memory = relaxing(1.0);
            rc.speed = 1.1e100);
    REFUSED("relaxation-time: expected a size", PLANE; STEADY; rc.speed = 1.0;
            rc.a.memory = relaxing(0.9e-100));
    REFUSED("relaxation-time-b: expected a size", PLANE; STEADY; rc.speed = 1.0; rc.elastic_b = 1;
            rc.b.memory = relaxing(1.1e100));
}

/* ---- What a case is ---------------------------------------------------------------- */

static rb_rolling_case similar_half_planes(void)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    PLANE;
    STEADY;
    rc.elastic_b = 1;
    rc.b = rc.a;
    rc.b.radius = INFINITY;
    return rc;
}

/* A wanted value of `function` for that case with these changes. */
#define HOLDS(function, wanted, ...)                                                               \
    do {                                                                                           \
        rb_rolling_case rc = similar_half_planes();                                                \
        __VA_ARGS__;                                                                               \
        if ((function) != (wanted))                                                                \
            fail_msg("%s of %s: not %d", #function, #__VA_ARGS__, wanted);                         \
    } while (0)

TEST(carters_law_is_for_similar_half_planes)
{
    const double x[] = {-1.0, 1.0}, y[] = {0.0, 0.0};
    HOLDS(rb_rolling_carter_holds(&rc), 1, rc.creep = 0.001);
    HOLDS(rb_rolling_carter_holds(&rc), 1, rc.b.radius = 20.0);
    HOLDS(rb_rolling_carter_holds(&rc), 1, rc.elastic_b = 0; rc.a.poisson = 0.5);
    HOLDS(rb_rolling_carter_holds(&rc), 0, rc.elastic_b = 0);
    HOLDS(rb_rolling_carter_holds(&rc), 0, rc.formulation = RB_STATIC);
    HOLDS(rb_rolling_carter_holds(&rc), 0, TRANSIENT);
    HOLDS(rb_rolling_carter_holds(&rc), 0, rc.mu = 0.0);
    HOLDS(rb_rolling_carter_holds(&rc), 0, rc.friction.law = RB_FRICTION_exponential);
    HOLDS(rb_rolling_carter_holds(&rc), 0, rc.friction.heat = -0.1);
    HOLDS(rb_rolling_carter_holds(&rc), 0, rc.interlayer_normal = 1e-9);
    HOLDS(rb_rolling_carter_holds(&rc), 0, rc.interlayer_tangential = 1e-9);
    HOLDS(rb_rolling_carter_holds(&rc), 0, rc.yield_stress = 1.0);
    HOLDS(rb_rolling_carter_holds(&rc), 0, rc.a.layer = 1.0);
    HOLDS(rb_rolling_carter_holds(&rc), 0, rc.b.support = RB_BEM_HUB; rc.b.radius = 9.0);
    HOLDS(rb_rolling_carter_holds(&rc), 0, rc.gap = RB_GAP_TABLE);
    HOLDS(rb_rolling_carter_holds(&rc), 0, rc.worn = ((rb_rolling_table){2, x, y}));
    HOLDS(rb_rolling_carter_holds(&rc), 0, rc.b.young *= 2.0);
    /* Dundurs' beta of -(1 - 2 nu)/(1 - nu) e/4 for moduli of E and (1 + e) E */
    const double nu = similar_half_planes().a.poisson;
    const double e = 4e-9 * (1.0 - nu) / (1.0 - 2.0 * nu);
    HOLDS(rb_rolling_carter_holds(&rc), 1, rc.b.young *= 1.0 + 0.95 * e);
    HOLDS(rb_rolling_carter_holds(&rc), 1, rc.b.young *= 1.0 - 0.95 * e);
    HOLDS(rb_rolling_carter_holds(&rc), 0, rc.b.young *= 1.0 + 1.05 * e);
    HOLDS(rb_rolling_carter_holds(&rc), 0, rc.b.young *= 1.0 - 1.05 * e);
}

TEST(transforms_are_for_many_elements_on_half_planes)
{
    const rb_rolling_mesh large = {.n = RB_ROLLING_TRANSFORMS_STEPS}, small = {.n = large.n - 1};
    HOLDS(rb_rolling_is_large(&rc, &large), 1, rc.creep = 0.001);
    const rb_rolling_mesh some = {.n = RB_ROLLING_TRANSFORMS}, few = {.n = some.n - 1};
    HOLDS(rb_rolling_is_large(&rc, &some), 1, rc.creep = 0.001);
    HOLDS(rb_rolling_is_large(&rc, &few), 0, rc.creep = 0.001);
    HOLDS(rb_rolling_is_large(&rc, &small), 0, rc.formulation = RB_STATIC);
    HOLDS(rb_rolling_is_large(&rc, &some), 1, rc.friction.law = RB_FRICTION_linear);
    HOLDS(rb_rolling_is_large(&rc, &some), 1, rc.friction.heat = -0.1);
    HOLDS(rb_rolling_is_large(&rc, &large), 1, rc.formulation = RB_STATIC);
    HOLDS(rb_rolling_is_large(&rc, &large), 1, rc.contact.solver = RB_SOLVER_NEWTON);
    HOLDS(rb_rolling_is_large(&rc, &large), 0, rc.contact.solver = RB_SOLVER_LEMKE);
    HOLDS(rb_rolling_is_large(&rc, &large), 1, rc.mesh = RB_MESH_ALIGNED);
    const rb_rolling_mesh aligned = {.n = RB_ROLLING_TRANSFORMS_ALIGNED},
                          shorter = {.n = aligned.n - 1};
    HOLDS(rb_rolling_is_large(&rc, &aligned), 1, rc.mesh = RB_MESH_ALIGNED);
    HOLDS(rb_rolling_is_large(&rc, &shorter), 0, rc.mesh = RB_MESH_ALIGNED);
    HOLDS(rb_rolling_is_large(&rc, &aligned), 0, rc.mesh = RB_MESH_ALIGNED;
          rc.formulation = RB_STATIC);
    const rb_rolling_mesh fitted = {.n = RB_ROLLING_TRANSFORMS_FITTED}, below = {.n = fitted.n - 1};
    HOLDS(rb_rolling_is_large(&rc, &fitted), 1, rc.mesh = RB_MESH_FITTED);
    HOLDS(rb_rolling_is_large(&rc, &below), 0, rc.mesh = RB_MESH_FITTED);
    HOLDS(rb_rolling_is_large(&rc, &fitted), 1, rc.mesh = RB_MESH_FITTED;
          rc.formulation = RB_STATIC);
    HOLDS(rb_rolling_is_large(&rc, &fitted), 0, rc.mesh = RB_MESH_FITTED;
          rc.formulation = RB_TRANSIENT);
    HOLDS(rb_rolling_is_large(&rc, &fitted), 1, rc.mesh = RB_MESH_FITTED;
          rc.interlayer_tangential = 1e-6);
    HOLDS(rb_rolling_is_large(&rc, &large), 1, rc.yield_stress = 1.0);
    HOLDS(rb_rolling_is_large(&rc, &some), 1, rc.yield_stress = 1.0);
    HOLDS(rb_rolling_is_large(&rc, &large), 1, rc.interlayer_tangential = 1e-6);
    HOLDS(rb_rolling_is_large(&rc, &large), 1, rc.slip_operator = RB_SLIP_SECOND);
    HOLDS(rb_rolling_is_large(&rc, &large), 1, rc.slip_operator = RB_SLIP_SECOND;
          rc.interlayer_tangential = 1e-6);
    HOLDS(rb_rolling_is_large(&rc, &large), 0, HUB);
    HOLDS(rb_rolling_is_large(&rc, &large), 0, rc.b.support = RB_BEM_HUB);
    HOLDS(rb_rolling_is_large(&rc, &large), 1, rc.b.support = RB_BEM_HUB; rc.elastic_b = 0);
}

TEST(the_list_of_bodies_has_an_end)
{
    int n = 0;
    for (; rb_rolling_body_kind_get(n); n++)
        assert_true(strlen(rb_rolling_kind_name(rb_rolling_body_kind_get(n))) > 0);
    assert_true(n >= 3);
    assert_null(rb_rolling_body_kind_get(n + 1));
    assert_null(rb_rolling_body_kind_get(n + 100));
}

/* ---- Derived quantities ------------------------------------------------------------ */

TEST(hertz_closes_the_circle)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.elastic_b = 1;
    rc.b.radius = 25.0;
    CHECK_REL(rb_rolling_radius(&rc), 50.0 / 3.0, 1e-15, "1/R = 1/50 + 1/25");
    CHECK_REL(rb_rolling_derive(&rc).modulus, 94500.0 / (2 * 0.99), 1e-15, "E*");
    CHECK_ABS(rb_rolling_derive(&rc).dundurs, 0.0, 1e-16, "beta of similar bodies");
    const double P = rb_rolling_hertz_load(&rc, 0.3);
    CHECK_REL(rb_rolling_hertz_half_width(&rc, P), 0.3, 1e-15, "half-width of its load");
    rc.elastic_b = 0;
    CHECK_REL(rb_rolling_derive(&rc).dundurs, 0.8 / 1.8, 1e-14, "beta on a rigid plane, nu = 0.1");
}

TEST(the_half_width_of_an_approach_inverts_the_compression)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    const double a = 0.01 * rc.a.radius;
    rc.approach = a * a / (4 * rc.a.radius) * (2 * log(4 * rc.a.radius / a) - 1);
    CHECK_REL(rb_rolling_derive(&rc).half_width, a, 1e-14, "delta = %g", rc.approach);
}

/* Every bit of a case counts, but those of what may differ and those that belong to no member:
 * at most the four bytes behind a whole number. */
TEST(cases_are_compared_by_their_members)
{
    static const struct {
        size_t from, size;
    } may_differ[] = {{offsetof(rb_rolling_case, mu), sizeof(double)},
                      {offsetof(rb_rolling_case, friction), sizeof(rb_rolling_friction)},
                      {offsetof(rb_rolling_case, approach), 3 * sizeof(double)},
                      {offsetof(rb_rolling_case, shift), 5 * sizeof(double)}};
    /* behind the members of which the largest alignment leaves bytes unused */
    static const size_t unused[] = {offsetof(rb_rolling_case, a) - 1,
                                    offsetof(rb_rolling_case, b.arc) - 1,
                                    offsetof(rb_rolling_case, a.memory.time) - 1,
                                    offsetof(rb_rolling_case, heat_a) - 1,
                                    offsetof(rb_rolling_case, worn.x) - 1,
                                    offsetof(rb_rolling_case, speed) - 1,
                                    offsetof(rb_rolling_case, contact.tol) - 1};
    static rb_rolling_case x, y;
    size_t run = 0;

    for (size_t at = 0; at < sizeof x; at++) {
        int may = 0;
        for (size_t k = 0; k < sizeof may_differ / sizeof *may_differ; k++)
            may |= at - may_differ[k].from < may_differ[k].size;
        ((unsigned char *)&y)[at] = 0x41;
        const int same = rb_rolling_same_rows(&x, &y);
        ((unsigned char *)&y)[at] = 0;
        run = same && !may ? run + 1 : 0;
        if (may)
            assert_true(same);
        assert_true(run <= 4);
    }
    for (size_t k = 0; sizeof(void *) == 8 && k < sizeof unused / sizeof *unused; k++) {
        ((unsigned char *)&y)[unused[k]] = 0x41;
        assert_true(rb_rolling_same_rows(&x, &y));
    }
}

RUN_TESTS(NULL, NULL)
