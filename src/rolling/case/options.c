/* The options of a case, each once: everything that reads, shows or checks them is made
 * from this table. */
#include "rolling/body/internal.h"
#include "rolling/case/check.h"
#include "rolling/case/internal.h"
#include "rolling/case/options.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define PLACE(member) offsetof(rb_resolved_case, member)
#define RC(member) offsetof(rb_resolved_case, rc.member)

static const rb_choice planes[] = {
    {"strain", RB_PLANE_STRAIN}, {"stress", RB_PLANE_STRESS}, {NULL, 0}};
static const rb_choice gaps[] = {
    {"parabola", RB_GAP_PARABOLA}, {"exact", RB_GAP_EXACT}, {"wave", RB_GAP_WAVE}, {NULL, 0}};
static const rb_choice formulations[] = {
    {"static", RB_STATIC}, {"steady", RB_STEADY}, {"transient", RB_TRANSIENT}, {NULL, 0}};
static const rb_choice meshes[] = {{"uniform", RB_MESH_UNIFORM},
                                   {"fitted", RB_MESH_FITTED},
                                   {"aligned", RB_MESH_ALIGNED},
                                   {"punch", RB_MESH_PUNCH},
                                   {NULL, 0}};
static const rb_choice layer_bases[] = {
    {"bonded", RB_BASE_BONDED}, {"smooth", RB_BASE_SMOOTH}, {NULL, 0}};
static const rb_choice slip_operators[] = {
    {"upstream", RB_SLIP_UPSTREAM}, {"second", RB_SLIP_SECOND}, {NULL, 0}};
static const rb_choice normals[] = {
    {"obstacle", RB_BEM_NORMALS_OBSTACLE}, {"surface", RB_BEM_NORMALS_SURFACE}, {NULL, 0}};
static const rb_choice near_fields[] = {{"auto", RB_NEAR_FIELD_AUTO},
                                        {"plain", RB_NEAR_FIELD_PLAIN},
                                        {"exact", RB_NEAR_FIELD_EXACT},
                                        {NULL, 0}};
static const rb_choice solvers[] = {
    {"auto", RB_SOLVER_AUTO}, {"lemke", RB_SOLVER_LEMKE}, {"newton", RB_SOLVER_NEWTON}, {NULL, 0}};
static const rb_choice lcp_forms[] = {
    {"pivoted", RB_LCP_PIVOTED}, {"kwak", RB_LCP_KWAK}, {NULL, 0}};

#define CHOICE_OF_LAW(name, help) {#name, RB_FRICTION_##name},
static const rb_choice laws[] = {RB_ROLLING_FRICTION_LAWS(CHOICE_OF_LAW){NULL, 0}};
#define HELP_OF_LAW(name, help) #name ": " help "; "

const rb_choice rb_case_systems[] = {
    {"mm", RB_UNITS_MM}, {"si", RB_UNITS_SI}, {"inch", RB_UNITS_INCH}, {NULL, 0}};

#define ONE_LAYER "one layer on its base; several: --layers FILE"
#define ONE_COVER "one cover on its core, a stack of covers is not modelled"

const rb_option rb_case_table[] = {
    RB_GROUP_LINE("body-a", "Body A: the cylinder that rolls"),
    RB_NUMBER_LINE("radius", RC(a.radius), "mm", RB_ABOVE(0), "radius R",
                   .unset = "50; of half-planes under a gap from a file the gap's", .common = 1),
    RB_NUMBER_LINE("young", RC(a.young), "MPa", RB_ABOVE(0), "Young's modulus E, or 60ShoreA",
                   .common = 1, .modulus = 1),
    RB_NUMBER_LINE("poisson", RC(a.poisson), "-", RB_ABOVE_UPTO(-1, 0.5), "Poisson's ratio nu",
                   .common = 1),
    RB_CHOICE_LINE("support", RC(a.support), rb_rolling_supports,
                   "how it is held: clamped arc at the top, rigid core, or a half-plane "
                   "instead of the cylinder's boundary",
                   .common = 1),
    RB_NUMBER_LINE("arc", RC(a.arc), "degrees", RB_ABOVE_UPTO(0, 90),
                   "half-angle of the clamped arc"),
    RB_NUMBER_LINE("hub-ratio", RC(a.hub_ratio), "-", RB_BETWEEN(0, 1),
                   "radius of the rigid core / R"),
    RB_NUMBER_LINE("datum", RC(a.datum), "mm", RB_ABOVE(0),
                   "halfplane: where along the surface a load moves nothing; auto: 2R/e, the "
                   "compression of a half-cylinder",
                   .word = "auto", .word_value = 0.0),
    RB_NUMBER_LINE("layer-thickness", RC(a.layer), "mm", RB_ABOVE(0),
                   "halfplane: thickness of a layer of this material, bonded to a base",
                   .word = "none", .word_value = 0.0, .one_only = ONE_LAYER),
    RB_TEXT_LINE(
        "layers", PLACE(layers_file), "FILE",
        "halfplane: rows thickness [mm], young [MPa], poisson of bonded layers, the first at "
        "the surface, in place of young, poisson and layer-thickness",
        .unset = "none", .file = RB_FILE_READ),
    RB_NUMBER_LINE("base-young", RC(a.base_young), "MPa", RB_ABOVE(0),
                   "Young's modulus of the layer's base", .word = "rigid", .word_value = 0.0,
                   .modulus = 1),
    RB_NUMBER_LINE("base-poisson", RC(a.base_poisson), "-", RB_ABOVE_UPTO(-1, 0.5),
                   "Poisson's ratio of an elastic base"),
    RB_CHOICE_LINE("layer-base", RC(a.layer_base), layer_bases,
                   "whether the layer is bonded to its base or slides on it without friction and "
                   "stays on it"),
    RB_NUMBER_LINE("cover-thickness", RC(a.cover), "mm", RB_ABOVE(0),
                   "hub: thickness of a cover of this material, bonded to the core", .word = "none",
                   .word_value = 0.0, .one_only = ONE_COVER),
    RB_NUMBER_LINE("core-young", RC(a.core_young), "MPa", RB_ABOVE(0),
                   "Young's modulus of the core, a ring between the cover and a rigid hub",
                   .word = "rigid", .word_value = 0.0, .modulus = 1),
    RB_NUMBER_LINE("core-poisson", RC(a.core_poisson), "-", RB_ABOVE_UPTO(-1, 0.5),
                   "Poisson's ratio of an elastic core"),
    RB_NUMBER_LINE("relaxation-time", PLACE(memory_a.time), "s", RB_ABOVE(0),
                   "relaxation times tau_k of the creep compliance J(t) E = 1 + sum f_k (1 - "
                   "exp(-t/tau_k)); --young is then the instantaneous (glassy) modulus. "
                   "Static contact needs a history in time",
                   .unset = "elastic", .list = PLACE(memory_a.times)),
    RB_NUMBER_LINE("relaxation-ratio", PLACE(memory_a.ratio), "-", RB_FROM(0),
                   "the amplitudes f_k, one per --relaxation-time; for one term f = "
                   "E_glassy/E_rubbery - 1",
                   .unset = "elastic", .list = PLACE(memory_a.ratios)),
    RB_NUMBER_LINE("speed", RC(speed), "mm/s", RB_ABOVE(0),
                   "rolling speed, the mean of the speeds at which the two surfaces pass the "
                   "contact; needed for viscoelastic bodies, temperatures and velocity-dependent "
                   "friction",
                   .unset = "not given"),

    RB_GROUP_LINE("body-b", "Body B: a rigid plane unless an option makes it elastic"),
    RB_FLAG_LINE("similar", PLACE(similar),
                 "elastic, of the same material as A, with the same layer, cover and "
                 "viscoelasticity",
                 .excludes = RB_ONE_YOUNG_B | RB_ONE_POISSON_B, .common = 1),
    RB_NUMBER_LINE("young-b", PLACE(young_b), "MPa", RB_ABOVE(0),
                   "Young's modulus; makes B elastic", .unset = "rigid", .excludes = RB_ONE_YOUNG_B,
                   .common = 1, .into = RC(b.young), .of_a = RC(a.young), .if_similar = 1,
                   .modulus = 1),
    RB_NUMBER_LINE("poisson-b", PLACE(poisson_b), "-", RB_ABOVE_UPTO(-1, 0.5), "Poisson's ratio",
                   .unset = "A's", .excludes = RB_ONE_POISSON_B, .into = RC(b.poisson),
                   .of_a = RC(a.poisson)),
    RB_NUMBER_LINE("radius-b", PLACE(radius_b), "mm", RB_ANY,
                   "radius of an elastic B, or plane; < 0: a bore around A (outer race, "
                   "bearing of a journal, internal gear)",
                   .word = "plane", .word_value = INFINITY, .into = RC(b.radius)),
    RB_CHOICE_LINE("support-b", RC(b.support), rb_rolling_supports, "how an elastic B is held"),
    RB_NUMBER_LINE("arc-b", RC(b.arc), "degrees", RB_ABOVE_UPTO(0, 90),
                   "half-angle of its clamped arc"),
    RB_NUMBER_LINE("hub-ratio-b", RC(b.hub_ratio), "-", RB_BETWEEN(0, 1),
                   "radius of its rigid core / radius"),
    RB_NUMBER_LINE("datum-b", RC(b.datum), "mm", RB_ABOVE(0),
                   "halfplane: where along the surface a load moves nothing; auto: 2/e of its "
                   "radius, or of A's for a plane",
                   .word = "auto", .word_value = 0.0),
    RB_NUMBER_LINE("layer-thickness-b", RC(b.layer), "mm", RB_ABOVE(0),
                   "halfplane: thickness of a layer of its material on a base", .word = "none",
                   .word_value = 0.0, .one_only = ONE_LAYER, .of_a = RC(a.layer), .if_similar = 1),
    RB_TEXT_LINE("layers-b", PLACE(layers_file_b), "FILE",
                 "halfplane: the same of B; makes B elastic", .unset = "none",
                 .file = RB_FILE_READ),
    RB_NUMBER_LINE("base-young-b", RC(b.base_young), "MPa", RB_ABOVE(0),
                   "Young's modulus of that base", .word = "rigid", .word_value = 0.0,
                   .of_a = RC(a.base_young), .if_similar = 1, .modulus = 1),
    RB_NUMBER_LINE("base-poisson-b", RC(b.base_poisson), "-", RB_ABOVE_UPTO(-1, 0.5),
                   "Poisson's ratio of an elastic base", .of_a = RC(a.base_poisson),
                   .if_similar = 1),
    RB_CHOICE_LINE("layer-base-b", RC(b.layer_base), layer_bases, "the same of B's layer",
                   .of_a = RC(a.layer_base), .if_similar = 1),
    RB_NUMBER_LINE("cover-thickness-b", RC(b.cover), "mm", RB_ABOVE(0),
                   "hub: thickness of a cover of its material on its core", .word = "none",
                   .word_value = 0.0, .one_only = ONE_COVER, .of_a = RC(a.cover), .if_similar = 1),
    RB_NUMBER_LINE("core-young-b", RC(b.core_young), "MPa", RB_ABOVE(0),
                   "Young's modulus of that core", .word = "rigid", .word_value = 0.0,
                   .of_a = RC(a.core_young), .if_similar = 1, .modulus = 1),
    RB_NUMBER_LINE("core-poisson-b", RC(b.core_poisson), "-", RB_ABOVE_UPTO(-1, 0.5),
                   "Poisson's ratio of an elastic core", .of_a = RC(a.core_poisson),
                   .if_similar = 1),
    RB_NUMBER_LINE("relaxation-time-b", PLACE(memory_b.time), "s", RB_ABOVE(0), "as of A",
                   .unset = "elastic", .list = PLACE(memory_b.times)),
    RB_NUMBER_LINE("relaxation-ratio-b", PLACE(memory_b.ratio), "-", RB_FROM(0), "as of A",
                   .unset = "elastic", .list = PLACE(memory_b.ratios)),

    RB_GROUP_LINE("gap", "Initial gap"),
    RB_CHOICE_LINE("gap", RC(gap), gaps,
                   "x^2/(2R), the exact circle, or a file of rows x, gap [mm]",
                   .path = PLACE(gap_file), .path_value = RB_GAP_TABLE, .path_name = "FILE",
                   .file = RB_FILE_READ),
    RB_NUMBER_LINE(
        "gap-smoothing", PLACE(gap_smoothing), "mm", RB_FROM(0),
        "standard deviation of the noise in the gap file; the gap is then the smoothest "
        "curve with this deviation from the points; 0: a cubic spline through the points",
        .frozen = 1),
    RB_NUMBER_LINE(
        "period", RC(period), "mm", RB_ABOVE(0),
        "static, elastic half-planes, also with a layer: length L after which the gap repeats "
        "itself; "
        "--load and --force are those of one period",
        .word = "none", .word_value = 0.0),
    RB_NUMBER_LINE("amplitude", RC(amplitude), "mm", RB_ABOVE(0),
                   "gap wave, D (1 - cos(2 pi x/L)): its amplitude D, half of the height from "
                   "crest to trough",
                   .word = "none", .word_value = 0.0),
    RB_TEXT_LINE("irregularity", PLACE(irregularity_file), "FILE",
                 "transient: rows x, gap [mm] of a flat (> 0) or a bump (< 0), which is "
                 "added to the gap and moves with the surface towards -x; x: its place "
                 "before rolling; the first and last gap are 0",
                 .unset = "none", .file = RB_FILE_READ),

    RB_TEXT_LINE("worn", PLACE(worn_file), "FILE",
                 "rows x, depth [mm]: worn depth in the contact frame, added to the gap "
                 "(rollbem wear --profile writes it)",
                 .unset = "none", .file = RB_FILE_READ),

    RB_GROUP_LINE("friction", "Friction"),
    RB_NUMBER_LINE("mu", RC(mu), "-", RB_FROM(0),
                   "Coulomb's coefficient; curve: several, separated by commas", .list = PLACE(mus),
                   .excludes = RB_ONE_FRICTION, .common = 1),
    RB_CHOICE_LINE("friction-law", RC(friction.law), laws,
                   RB_ROLLING_FRICTION_LAWS(HELP_OF_LAW) "or a file of rows x [mm], mu: linear "
                                                         "between them, constant beyond",
                   .path = PLACE(friction_file), .path_value = RB_FRICTION_table,
                   .path_name = "FILE", .file = RB_FILE_READ),
    RB_NUMBER_LINE("mu-fall", PLACE(law.fall), "-", RB_ANY,
                   "m1[,m2]: decrease of the coefficient from rest to high slip velocity",
                   .unset = "none", .list = PLACE(law.falls)),
    RB_NUMBER_LINE("slip-scale", PLACE(law.slip_scale), "mm/s", RB_ABOVE(0),
                   "s1[,s2]: slip velocities of this decrease, s in --friction-law",
                   .unset = "none", .list = PLACE(law.slip_scales)),
    RB_NUMBER_LINE("memory", PLACE(law.memory), "mm", RB_ABOVE(0),
                   "d[,s0]: the coefficient approaches the law over a sliding distance "
                   "d; at rest it changes as if sliding at s0 (1 mm/s); static cases whose "
                   "friction falls need it",
                   .unset = "none", .list = PLACE(law.memories)),
    RB_NUMBER_LINE("mu-heat", PLACE(law.heat), "-", RB_ANY,
                   "dmu,Tref,dT: mu changes linearly by dmu while the surface temperature "
                   "rises from Tref to Tref + dT [K]; see --conductivity",
                   .unset = "none", .list = PLACE(law.heats)),

    RB_GROUP_LINE("interlayer", "Third body between the surfaces, elastic or plastic"),
    RB_NUMBER_LINE("interlayer-normal", RC(interlayer_normal), "mm/MPa", RB_FROM(0),
                   "its normal compliance: displacement per pressure"),
    RB_NUMBER_LINE("interlayer-tangential", RC(interlayer_tangential), "mm/MPa", RB_FROM(0),
                   "its tangential compliance: thickness over shear modulus"),
    RB_NUMBER_LINE("yield-stress", RC(yield_stress), "MPa", RB_ABOVE(0),
                   "shear stress at which the third body yields, a second bound on "
                   "friction besides mu p",
                   .word = "none", .word_value = 0.0),
    RB_NUMBER_LINE("hardening", RC(hardening), "MPa/mm", RB_ANY,
                   "hardening modulus: increase of the yield stress per plastic slip "
                   "(negative: softening)"),

    RB_GROUP_LINE("heat", "Heat of friction: flash temperature of steady and transient "
                          "rolling"),
    RB_NUMBER_LINE("conductivity", RC(heat_a.conductivity), "W/(m K)", RB_ABOVE(0),
                   "of A; if it is given, temperatures are computed, which needs --speed",
                   .word = "none", .word_value = 0.0),
    RB_NUMBER_LINE("heat-capacity", RC(heat_a.heat_capacity), "MJ/(m3 K)", RB_ABOVE(0),
                   "of A: density times specific heat", .word = "none", .word_value = 0.0),
    RB_NUMBER_LINE("temperature", RC(heat_a.temperature), "K", RB_ANY,
                   "of A far from the contact; 0: results are temperature rises"),
    RB_NUMBER_LINE("conductivity-b", PLACE(conductivity_b), "W/(m K)", RB_FROM(0),
                   "of B, rigid or elastic; 0: no heat enters B", .unset = "A's",
                   .into = RC(heat_b.conductivity), .of_a = RC(heat_a.conductivity)),
    RB_NUMBER_LINE("heat-capacity-b", PLACE(heat_capacity_b), "MJ/(m3 K)", RB_ABOVE(0), "of B",
                   .unset = "A's", .into = RC(heat_b.heat_capacity),
                   .of_a = RC(heat_a.heat_capacity)),
    RB_NUMBER_LINE("temperature-b", PLACE(temperature_b), "K", RB_ANY, "of B far from the contact",
                   .unset = "A's", .into = RC(heat_b.temperature), .of_a = RC(heat_a.temperature)),

    RB_GROUP_LINE("normal", "Normal direction: one of"),
    RB_NUMBER_LINE("approach", RC(approach), "mm", RB_ABOVE(0),
                   "how far A is moved down, towards B", .unset = "R/2", .excludes = RB_ONE_NORMAL,
                   .common = 1),
    RB_NUMBER_LINE("load", RC(load), "N/mm", RB_ABOVE(0), "normal load P", .unset = "not given",
                   .excludes = RB_ONE_NORMAL, .common = 1),
    RB_NUMBER_LINE("half-width", RC(half_width), "mm", RB_ABOVE(0),
                   "the half-width a of Hertz; the load follows from it", .unset = "not given",
                   .excludes = RB_ONE_NORMAL, .common = 1),
    RB_NUMBER_LINE(
        "max-pressure", RC(max_pressure), "MPa", RB_ABOVE(0),
        "largest pressure p0; the load follows from it, by Hertz's formula or, on layers, "
        "wheels, other gaps and with coupled friction, by a search",
        .unset = "not given", .excludes = RB_ONE_NORMAL),
    RB_NUMBER_LINE(
        "wheel-load", RC(wheel_load), "N", RB_ABOVE(0),
        "load of a contact that is curved across the rolling direction, too: the case is "
        "then the strip through the middle of Hertz's ellipse",
        .unset = "not given", .excludes = RB_ONE_NORMAL),
    RB_NUMBER_LINE("transverse-radius", RC(transverse_radius), "mm", RB_ANY,
                   "wheel-load: radius of A across the rolling direction; < 0: concave",
                   .word = "flat", .word_value = INFINITY),
    RB_NUMBER_LINE("transverse-radius-b", RC(transverse_radius_b), "mm", RB_ANY,
                   "the same of B, as of a rail's head", .word = "flat", .word_value = INFINITY),
    RB_INTEGER_LINE("strips", RC(strips), RB_FROM_TO(0, 1000),
                    "wheel-load, steady: strips of the ellipse, each solved, that are added to "
                    "ellipse_force, 15 do; 0: by formula, of alike bodies"),

    RB_GROUP_LINE("tangential", "Tangential direction: one of (static: see the notes)"),
    RB_NUMBER_LINE("shift", RC(shift), "mm", RB_ANY, "static: rigid displacement of A towards +x",
                   .unset = "a tenth of the approach; 0 under load", .excludes = RB_ONE_LOADING),
    RB_NUMBER_LINE(
        "creep", RC(creep), "-", RB_ANY,
        "creepage xi, the difference of the surfaces' speeds over their mean; > 0: braked "
        "wheel, Q < 0; 2: locked wheel",
        .unset = "not given", .excludes = RB_ONE_CREEPAGE, .common = 1),
    RB_NUMBER_LINE("creep-ratio", RC(creep_ratio), "-", RB_ANY,
                   "xi R/(mu a), the sign of xi; 1: full sliding of similar bodies",
                   .unset = "not given", .excludes = RB_ONE_CREEPAGE, .common = 1),
    RB_NUMBER_LINE("force", RC(force), "N/mm", RB_ANY, "tangential load Q on A, towards +x",
                   .unset = "not given", .excludes = RB_ONE_LOADING),
    RB_NUMBER_LINE("force-ratio", RC(force_ratio), "-", RB_ANY, "Q/(mu P), the sign of Q",
                   .unset = "not given", .excludes = RB_ONE_LOADING, .common = 1),
    RB_FLAG_LINE("free-axle", RC(free_axle),
                 "steady: no torque on A's axle, Q = -M/R_A; M: see resistance_moment",
                 .excludes = RB_ONE_LOADING),

    RB_GROUP_LINE("bulk", "Bulk stress: half-planes that are stretched along the surface"),
    RB_NUMBER_LINE("bulk-stress", RC(bulk_stress), "MPa", RB_ANY,
                   "uniform stress of A along x, far from the contact, tension > 0: its strain "
                   "shifts the stick zone at rest, and the creepage of rolling",
                   .word = "none", .word_value = 0.0),
    RB_NUMBER_LINE("bulk-stress-b", RC(bulk_stress_b), "MPa", RB_ANY,
                   "the same of an elastic B, as of a specimen in a test of fretting fatigue",
                   .word = "none", .word_value = 0.0),

    RB_GROUP_LINE("tilt", "Tilt of A at rest: one of"),
    RB_NUMBER_LINE("tilt", RC(tilt), "-", RB_ANY,
                   "static, half-planes: angle by which A is turned; > 0 lowers it at +x",
                   .word = "none", .word_value = 0.0, .excludes = RB_ONE_TILT),
    RB_NUMBER_LINE("moment", RC(moment), "N", RB_ANY,
                   "M = int x p dx, per width, that the pressure has; the tilt follows",
                   .unset = "not given", .excludes = RB_ONE_TILT),

    RB_GROUP_LINE("problem", "Problem"),
    RB_CHOICE_LINE("formulation", RC(formulation), formulations,
                   "static: displaced without rolling; steady: rolling towards +x; "
                   "transient: rolling from rest, step by step",
                   .common = 1),
    RB_INTEGER_LINE("increments", RC(increments), RB_FROM_TO(0, 1000000),
                    "static, start of a transient: number of increments in which the "
                    "load or approach is applied, and then as many for shift or force; with "
                    "--history: in each of its rows at rest; 0: one, with --history as many as "
                    "the answer needs"),
    RB_NUMBER_LINE("distance", RC(distance), "a", RB_ABOVE(0),
                   "transient: rolled distance, in Hertz half-widths of the load",
                   .unset = "as --history says", .frozen = 1),
    RB_INTEGER_LINE("steps", RC(steps), RB_FROM_TO(0, RB_ROLLING_MOST_STEPS),
                    "transient: number of steps of equal length; 0: steps of at most one element"),
    RB_TEXT_LINE("history", PLACE(history_file), "FILE",
                 "table with named columns: distance (transient, in Hertz half-widths of "
                 "the largest load), time [s] (static, viscoelastic bodies), mu, load or "
                 "approach, shift, creep, creep_ratio, force or force_ratio, bulk_stress, "
                 "bulk_stress_b, tilt; a column replaces the value of the case",
                 .unset = "none", .file = RB_FILE_READ),

    RB_FLAG_LINE("fretting", RC(fretting),
                 "with --history, at rest: what the last cycle of its rows does to each element: "
                 "work of friction, slip range, Ruiz's two parameters, SWT, largest shear"),
    RB_NUMBER_LINE("cycle", PLACE(cycle), "-", RB_FROM(1),
                   "FROM,TO: with --fretting, the cycle from the end of one row of the history to "
                   "the end of another, counted from 1",
                   .unset = "the last one", .list = PLACE(cycles), .frozen = 1),

    RB_NUMBER_LINE("time-step", RC(time_step), "s", RB_ABOVE(0),
                   "static, viscoelastic bodies: longest step between two rows of the "
                   "history; rows: one step for each row",
                   .word = "rows", .word_value = 0.0, .frozen = 1),

    RB_CHOICE_LINE("plane", RC(plane), planes,
                   "strain: long bodies, loads per unit of length; stress: thin discs, "
                   "loads per unit of thickness"),

    RB_GROUP_LINE("mesh", "Mesh"),
    RB_CHOICE_LINE("mesh", RC(mesh), meshes,
                   "equal elements, fitted to the contact edges, equal ones aligned with them, or "
                   "those of a punch that ends where its gap file ends",
                   .unset = "fitted in steady rolling, and at rest with --accuracy, under a given "
                            "load, half-width or approach without zone and gap file, aligned from "
                            "150 elements on between similar half-planes and with --accuracy, "
                            "from 1500 on with wheels without cover; uniform from 241 on where mu "
                            "beta >= 1; else uniform",
                   .common = 1),
    RB_CHOICE_LINE("slip-operator", RC(slip_operator), slip_operators,
                   "steady, equal elements: difference to the element upstream, or of "
                   "second order",
                   .unset = "second on aligned elements, else upstream"),
    RB_INTEGER_LINE("contact-elements", RC(contact_elements),
                    RB_FROM_TO(3, RB_ROLLING_MOST_ELEMENTS),
                    "number of elements: in the potential contact (uniform) or across "
                    "the contact (fitted, aligned)",
                    .unset = "60, fitted 100; more where a table is finer", .common = 1),
    RB_NUMBER_LINE("zone", RC(zone), "mm", RB_ABOVE(0),
                   "half-width of the potential contact; auto: enlarged until each end "
                   "has three separated elements",
                   .word = "auto", .word_value = 0.0, .frozen = 1),
    RB_INTEGER_LINE(
        "outer-elements", RC(outer_elements), RB_FROM_TO(0, RB_ROLLING_MOST_OUTER),
        "wheels: number on the circle outside the contact, one more if that makes the mesh "
        "symmetric; 0: graded, neighbours differ by at most a fifth"),
    RB_CHOICE_LINE("normals", RC(normals), normals,
                   "contact frame: the obstacle's, or the polygon's own as in Addi et al."),
    RB_CHOICE_LINE(
        "near-field", RC(near_field), near_fields,
        "wheels: displacements close to a load, by plain boundary elements, or by the "
        "exact solution of a strip and elements for the remainder; auto: exact on fitted "
        "meshes, and on covers waves around the circumference without elements"),

    RB_GROUP_LINE("units", "Units: values may have one, as 210GPa, 100kN/m, 18in, 0.1%"),
    RB_CHOICE_LINE("units", PLACE(units), rb_case_systems,
                   "of numbers without a unit, also in files, and of the results: mm, N, "
                   "MPa; m, N, Pa; inch, lbf, psi",
                   .common = 1),

    RB_GROUP_LINE("solver", "Solver"),
    RB_CHOICE_LINE("solver", RC(contact.solver), solvers,
                   "method for the complementarity problem; or the name of a cone "
                   "solver, see rollbem help friction",
                   .path = RC(contact.cone_solver.name), .path_value = RB_SOLVER_CONE,
                   .path_name = "NAME"),
    RB_CHOICE_LINE("lcp-form", RC(contact.lcp_form), lcp_forms,
                   "pivoted (no inverse), or kwak: the matrix of Addi et al. (38)"),
    RB_NUMBER_LINE("tol", RC(contact.tol), "-", RB_ABOVE(0),
                   "bound on the natural residual of the scaled problem", .frozen = 1),

    RB_GROUP_LINE("accuracy", "Accuracy"),
    RB_FLAG_LINE("error", PLACE(error),
                 "error bars: estimates of the discretisation error from coarser meshes",
                 .common = 1),
    RB_NUMBER_LINE("accuracy", PLACE(accuracy), "-", RB_BETWEEN(0, 1),
                   "refine until the relative error of forces, half-width, p0 and creepage "
                   "is estimated below this",
                   .word = "off", .word_value = 0.0, .frozen = 1),
};

const int rb_case_table_n = sizeof rb_case_table / sizeof rb_case_table[0];

_Static_assert(sizeof rb_case_table / sizeof rb_case_table[0] <= RB_CASE_OPTIONS_MAX,
               "RB_CASE_OPTIONS_MAX is too small");
_Static_assert(PLACE(rc) == 0, "a place in rb_resolved_case is one in its case");

/* ---- Ranges ------------------------------------------------------------------------ */

int rb_option_in_range(const rb_option *o, double value)
{
    const rb_range *r = &o->range;

    return (r->from_open ? value > r->from : value >= r->from) &&
           (r->to_open ? value < r->to : value <= r->to);
}

/* 1e+06, but 16777216: all digits where six are not enough. */
static char *end_text(double end, char text[RB_NUMBER_TEXT])
{
    rb_format(text, RB_NUMBER_TEXT, "%g", end);
    return rb_read_number(text, NULL) == end ? text : rb_number_text(end, text);
}

const char *rb_option_expected(const rb_option *o, char *text, size_t size)
{
    const rb_range *r = &o->range;
    char range[80] = "", from[RB_NUMBER_TEXT], to[RB_NUMBER_TEXT];
    if (isfinite(r->from) && isfinite(r->to))
        snprintf(range, sizeof range, " in %c%s, %s%c", r->from_open ? '(' : '[',
                 end_text(r->from, from), end_text(r->to, to), r->to_open ? ')' : ']');
    else if (isfinite(r->from))
        snprintf(range, sizeof range, " %s %s", r->from_open ? ">" : ">=", end_text(r->from, from));
    else if (isfinite(r->to))
        snprintf(range, sizeof range, " %s %s", r->to_open ? "<" : "<=", end_text(r->to, to));
    switch (o->kind) {
    case RB_OPTION_NUMBER:
        snprintf(text, size, "a number%s%s%s", range, o->word ? " or " : "",
                 o->word ? o->word : "");
        break;
    case RB_OPTION_INTEGER:
        snprintf(text, size, "a whole number%s", range);
        break;
    case RB_OPTION_CHOICE: {
        text[0] = '\0';
        for (int i = 0; o->choices[i].name; i++) {
            const char *between = i == 0 ? "" : o->choices[i + 1].name ? ", " : " or ";
            rb_append(text, size, "%s%s", between, o->choices[i].name);
        }
    } break;
    case RB_OPTION_FLAG:
        snprintf(text, size, "yes or no");
        break;
    case RB_OPTION_TEXT:
    case RB_OPTION_GROUP:
        snprintf(text, size, "a name");
        break;
    }
    return text;
}

/* "core-young-b" of body B is the core-young of its row. */
int rb_option_applies(const rb_option *o, const rb_rolling_body *body)
{
    const size_t n = strlen(o->name), of_b = n > 2 && strcmp(o->name + n - 2, "-b") == 0;
    int is_named = 0, applies = 0;

    for (const rb_rolling_body_kind *const *kind = rb_rolling_body_kinds; *kind; kind++)
        for (const rb_rolling_parameter *p = (*kind)->parameters; p->option; p++)
            if (strncmp(p->option, o->name, n - 2 * of_b) == 0 &&
                strlen(p->option) == n - 2 * of_b) {
                is_named = 1;
                applies |= rb_rolling_body_is(body, *kind);
            }
    return applies || !is_named;
}

static double number_at(const rb_rolling_case *rc, const rb_option *o, size_t place)
{
    const void *at = (const char *)rc + place;
    return o->kind == RB_OPTION_INTEGER ? *(const int *)at : *(const double *)at;
}

static rb_status refuse_value(const rb_option *o, double value, rb_message *why)
{
    char expected[200];
    rb_option_expected(o, expected, sizeof expected);
    return o->kind == RB_OPTION_INTEGER
               ? rb_refuse(why, o->name, "expected %s, got %.0f", expected, value)
               : rb_refuse(why, o->name, "expected %s, got %g", expected, value);
}

rb_status rb_rolling_check_option(const rb_option *o, double value, rb_message *why)
{
    return rb_option_in_range(o, value) ? RB_OK : refuse_value(o, value, why);
}

rb_status rb_rolling_check_number(const char *option, double value, rb_message *why)
{
    const rb_option *o = rb_case_table;

    while (o->kind == RB_OPTION_GROUP || strcmp(o->name, option) != 0)
        o++;
    return rb_rolling_check_option(o, value, why);
}

rb_status rb_rolling_check_ranges(const rb_rolling_case *rc, const rb_rolling_case *defaults,
                                  rb_message *why)
{
    for (const rb_option *o = rb_case_table; o < rb_case_table + rb_case_table_n; o++) {
        const size_t at = o->into ? o->into : o->offset;
        const int of_a = at >= RC(a) && at < RC(a) + sizeof rc->a,
                  of_b = at >= RC(b) && at < RC(b) + sizeof rc->b,
                  of_heat_b = at >= RC(heat_b) && at < RC(heat_b) + sizeof rc->heat_b;
        if ((o->kind != RB_OPTION_NUMBER && o->kind != RB_OPTION_INTEGER) || at >= sizeof *rc ||
            (of_b && !rc->elastic_b) || (of_heat_b && rc->heat_a.conductivity == 0.0) ||
            ((of_a || of_b) && !rb_option_applies(o, of_b ? &rc->b : &rc->a)))
            continue;
        const double x = number_at(rc, o, at), unset = number_at(defaults, o, at);
        if (at == RC(a.radius) && isinf(x) &&
            rb_rolling_gap_has_shape(rc)) /* a gap may have none */
            continue;
        if (!rb_option_in_range(o, x) && !(o->word && x == o->word_value) && x != unset &&
            !(isnan(x) && isnan(unset)))
            return refuse_value(o, x, why);
    }
    return RB_OK;
}
