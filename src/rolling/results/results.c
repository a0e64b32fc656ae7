/* The results, each once, as rows of tables: JSON, tables, studies and error bars are made from
 * these.  What is done with a row is in result_values.c and result_units.c. */
#include "rolling/results/results.h"
#include "rolling/solve/solution.h"
#include "rolling/stress/stress.h"
#include "rolling/study/study.h"

#include <stddef.h>

#define OF(owner, name_, member, ...)                                                              \
    {                                                                                              \
        .name = name_, .offset = offsetof(owner, member), __VA_ARGS__                              \
    }
#define RESULT(name, member, ...) OF(rb_rolling_solution, name, member, __VA_ARGS__)
#define PATCH(name, member, ...) OF(rb_rolling_patch, name, member, __VA_ARGS__)
#define STEP(name, member, ...) OF(rb_rolling_history, name, member, __VA_ARGS__)
#define STRESS(name, member, ...) OF(rb_rolling_stress, name, member, __VA_ARGS__)
#define WEAR(name, member, ...) OF(rb_rolling_wear_history, name, member, __VA_ARGS__)
#define POINT(name, member, ...) OF(rb_rolling_curve, name, member, __VA_ARGS__)

/* A largest value of a cycle and its place. */
#define PEAK(name, member, unit_, condition_, study_, words)                                       \
    RESULT(name "_max", fretting.member.value, .unit = unit_, .no_derivative = 1, .study = study_, \
           .error_bar = RB_SCALE_ONE, .condition = condition_, .meaning = words),                  \
        RESULT(name "_max_at", fretting.member.at, .unit = "mm", .no_derivative = 1,               \
               .condition = condition_, .meaning = "its place")

static const rb_rolling_result scalars[] = {
    RESULT("iterations", iterations, .kind = RB_RESULT_WHOLE, .study = 15,
           .meaning = "pivots or Newton steps, of all solves"),
    RESULT("residual", residual, .no_derivative = 1, .study = 14,
           .meaning = "natural residual of the scaled problem, from the solution alone"),
    RESULT("residual_gap", residual_gap, .no_derivative = 1, .unit = "mm",
           .meaning = "largest violation of the contact conditions"),
    RESULT("residual_slip", residual_slip, .no_derivative = 1, .unit = "mm",
           .meaning = "largest violation of the slip conditions"),
    RESULT("residual_friction", residual_friction, .no_derivative = 1, .unit = "MPa",
           .meaning = "largest violation of Coulomb's law"),
    RESULT("load_error", load_error, .no_derivative = 1,
           .meaning = "|P - given|/given; under a given load"),
    RESULT("support_balance", support_balance, .no_derivative = 1,
           .meaning = "(reaction at the support + P)/P; not of half-planes and "
                      "covers"),
    RESULT("normal_load", normal_load, .unit = "N/mm", .error_bar = RB_SCALE_LOAD, .study = 1,
           .meaning = "P, the sum of the pressure"),
    RESULT("tangential_load", tangential_load, .unit = "N/mm", .error_bar = RB_SCALE_FRICTION,
           .study = 2, .meaning = "Q, the sum of the friction on A"),
    RESULT("force_ratio", force_ratio, .error_bar = RB_SCALE_ONE, .study = 3,
           .meaning = "Q/(mu P)"),
    RESULT("approach", approach, .unit = "mm", .error_bar = RB_SCALE_APPROACH, .study = 4,
           .meaning = "delta: how far A moved towards B"),
    RESULT("tangential_shift", tangential_shift, .unit = "mm", .error_bar = RB_SCALE_SHIFT,
           .meaning = "rigid shift of A; static contact; of a layer on a smooth base only its "
                      "differences mean something"),
    RESULT("ellipse_a", ellipse.a, .unit = "mm", .no_derivative = 1, .condition = RB_FOR_ELLIPSE,
           .meaning =
               "semi-axis of Hertz's ellipse along the rolling direction, with --wheel-load"),
    RESULT("ellipse_b", ellipse.b, .unit = "mm", .no_derivative = 1, .condition = RB_FOR_ELLIPSE,
           .meaning = "semi-axis across it"),
    RESULT("ellipse_pressure", ellipse.pressure, .unit = "MPa", .no_derivative = 1,
           .condition = RB_FOR_ELLIPSE, .meaning = "p0 of the ellipse"),
    RESULT("ellipse_approach", ellipse.approach, .unit = "mm", .no_derivative = 1,
           .condition = RB_FOR_ELLIPSE, .meaning = "of the bodies that touch in it"),
    RESULT("strip_radius", ellipse.radius, .unit = "mm", .no_derivative = 1,
           .condition = RB_FOR_ELLIPSE,
           .meaning = "E* a/(2 p0): radius of a cylinder with this a and p0, not that of rolling"),
    RESULT("ellipse_force", ellipse_force, .unit = "N", .no_derivative = 1, .study = 30,
           .condition = RB_FOR_ELLIPSE_FORCE,
           .meaning = "Q of the whole ellipse by strips, steady rolling of alike bodies, or with "
                      "--strips"),
    RESULT("ellipse_force_kalker", ellipse_force_kalker, .unit = "N", .no_derivative = 1,
           .study = 31, .condition = RB_FOR_ELLIPSE_FORCE,
           .meaning = "the same of alike bodies with the slope of Kalker's C11, a/b from 0.1 to "
                      "10"),
    RESULT("mean_pressure", mean_pressure, .unit = "MPa", .no_derivative = 1,
           .condition = RB_FOR_PERIOD, .meaning = "P over the period, with --period"),
    RESULT("contact_share", contact_share, .no_derivative = 1, .condition = RB_FOR_PERIOD,
           .meaning = "part of the period in contact, 2a/L of one contact"),
    RESULT("tilt", tilt, .no_derivative = 1, .condition = RB_FOR_TILT,
           .meaning = "of A, with --tilt or --moment"),
    RESULT("creepage", creepage, .error_bar = RB_SCALE_CREEPAGE, .study = 5, .meaning = "xi"),
    RESULT("creep_ratio", creep_ratio, .study = 6, .meaning = "xi R/(mu a), a: hertz_half_width"),
    RESULT("free_creepage", free_creepage, .error_bar = RB_SCALE_CREEPAGE, .study = 7,
           .meaning = "xi where Q = 0; steady rolling"),
    RESULT("creepage_ahead", creepage_ahead, .no_derivative = 1, .condition = RB_FOR_SMOOTH_BASE,
           .meaning = "xi of a layer on a smooth base that is unstrained ahead of the contact"),
    RESULT("creepage_behind", creepage_behind, .no_derivative = 1, .condition = RB_FOR_SMOOTH_BASE,
           .meaning = "xi of a layer on a smooth base that is unstrained behind it"),
    RESULT("hertz_half_width", hertz_half_width, .unit = "mm",
           .meaning = "a of P and the combined radius, Hertz's; with a third body "
                      "or memory theirs by formula: scale of the ratios"),
    RESULT("half_width", half_width, .unit = "mm", .error_bar = RB_SCALE_WIDTH, .study = 8,
           .meaning = "of the contact, where p^2 extrapolates to zero"),
    RESULT("contact_from", contact_from, .unit = "mm", .meaning = "its trailing edge"),
    RESULT("contact_to", contact_to, .unit = "mm", .meaning = "its leading edge"),
    RESULT("nip_width", nip_width, .unit = "mm",
           .meaning = "from the trailing edge to the leading one, 2a of a single contact"),
    RESULT("max_pressure", max_pressure, .unit = "MPa", .error_bar = RB_SCALE_PRESSURE, .study = 9,
           .meaning = "p0"),
    RESULT("contact", contact, .kind = RB_RESULT_WHOLE, .study = 10,
           .meaning = "elements in contact"),
    RESULT("stick", stick, .kind = RB_RESULT_WHOLE, .study = 11, .meaning = "elements that stick"),
    RESULT("slip", slipping, .kind = RB_RESULT_WHOLE, .study = 12, .meaning = "elements that slip"),
    RESULT("yield", yielding, .kind = RB_RESULT_WHOLE, .study = 22, .condition = RB_FOR_YIELD,
           .meaning = "elements whose interface yields, part of those that slip"),
    RESULT("stick_from", stick_from, .no_derivative = 1, .unit = "mm",
           .error_bar = RB_SCALE_ELEMENT, .meaning = "first end of the elements that stick"),
    RESULT("stick_to", stick_to, .no_derivative = 1, .unit = "mm", .error_bar = RB_SCALE_ELEMENT,
           .meaning = "last end of the elements that stick"),
    RESULT("stick_length", stick_length, .unit = "mm", .error_bar = RB_SCALE_ELEMENT,
           .meaning = "length of all elements that stick"),
    RESULT("slip_violations", slip_violations, .kind = RB_RESULT_WHOLE,
           .meaning = "elements whose slip does not oppose the friction"),
    RESULT("dissipation", dissipation, .unit = "N/mm", .error_bar = RB_SCALE_POWER, .study = 13,
           .meaning = "friction power per unit speed"),
    RESULT("resistance_moment", resistance_moment, .unit = "N", .error_bar = RB_SCALE_MOMENT,
           .study = 16, .meaning = "M = int x p dx; > 0: the load acts ahead of x = 0"),
    RESULT("resistance_ratio", resistance_ratio, .error_bar = RB_SCALE_STRAIN, .study = 17,
           .meaning = "M/(P R), 1/R = 1/R_A + 1/R_B, of an ellipse R the strip_radius: the "
                      "coefficient of rolling resistance"),
    RESULT("hysteresis_factor", hysteresis_factor, .no_derivative = 1, .error_bar = RB_SCALE_ONE,
           .condition = RB_FOR_MEMORY,
           .meaning = "Tabor's factor (3 pi/2) M/(P a), a half the width of the contact; steady"),
    RESULT("hysteresis", hysteresis, .unit = "N/mm", .error_bar = RB_SCALE_WORK, .study = 18,
           .meaning = "power per unit speed that bodies which relax lose; steady"),
    RESULT("lever_power", lever_power, .unit = "N/mm", .error_bar = RB_SCALE_WORK,
           .meaning = "power per unit speed that the lever arms of wheels supply: -xi Q + M/R + "
                      "lever_power = dissipation + hysteresis; steady"),
    RESULT("torque_a", torque_a, .unit = "N", .error_bar = RB_SCALE_TORQUE, .study = 24,
           .meaning = "M + Q R_A: torque that turns A's axle the way A rolls; < 0 "
                      "brakes it"),
    RESULT("torque_b", torque_b, .unit = "N", .error_bar = RB_SCALE_TORQUE, .study = 25,
           .condition = RB_FOR_CYLINDER_B, .meaning = "M - Q R_B: the same of B's axle"),
    RESULT("strain_energy", strain_energy, .no_derivative = 1, .unit = "N",
           .meaning = "elastic energy of both bodies per width, half the work of p and q on "
                      "un and ut; of half-planes it depends on datum"),
    RESULT("max_strain", max_strain, .study = 26,
           .meaning = "largest compression of a layer, cover or rim over its thickness; "
                      "without one a/(2R), or p0/E*"),
    RESULT("max_temperature", max_temperature, .unit = "K", .error_bar = RB_SCALE_HEAT, .study = 19,
           .condition = RB_FOR_HEAT, .meaning = "highest temperature of the surfaces in contact"),
    RESULT("max_temperature_at", max_temperature_at, .no_derivative = 1, .unit = "mm",
           .error_bar = RB_SCALE_ELEMENT, .study = 20, .condition = RB_FOR_HEAT,
           .meaning = "its place"),
    RESULT("heat_a", heat_into_a, .unit = "W/m", .no_derivative = 1, .study = 27,
           .condition = RB_FOR_HEAT, .meaning = "heat that enters A per width"),
    RESULT("heat_b", heat_into_b, .unit = "W/m", .no_derivative = 1, .study = 28,
           .condition = RB_FOR_HEAT, .meaning = "heat that enters B"),
    RESULT("heat_share_a", heat_share_a, .no_derivative = 1, .error_bar = RB_SCALE_ONE, .study = 29,
           .condition = RB_FOR_HEAT,
           .meaning = "heat_a over their sum, of bodies that are equally warm far away"),
    RESULT("peclet", peclet, .study = 21, .condition = RB_FOR_HEAT,
           .meaning = "V a/(2 diffusivity of A), a the half-width"),
    RESULT("kappa", kappa, .study = 23, .condition = RB_FOR_MOVING_LAW,
           .meaning = "uniqueness of friction that falls: above 1 there may be several "
                      "solutions"),
    RESULT("work_per_cycle", fretting.work, .unit = "N", .no_derivative = 1,
           .error_bar = RB_SCALE_ONE, .study = 32, .condition = RB_FOR_FRETTING,
           .meaning = "work of friction in the last cycle of a history, with --fretting"),
    PEAK("fretting_work", fretting_work, "N/mm", RB_FOR_FRETTING, 33, "largest fretting_work"),
    PEAK("slip_range", slip_range, "mm", RB_FOR_FRETTING, 34, "largest slip_range"),
    PEAK("ruiz_1", ruiz_1, "N/mm", RB_FOR_FRETTING, 35, "largest ruiz_1"),
    PEAK("ruiz_2", ruiz_2, "MPa.N/mm", RB_FOR_FRETTING, 36, "largest ruiz_2"),
    PEAK("swt", swt, "MPa", RB_FOR_FRETTING, 37, "largest swt, also at the edges of the contact"),
    PEAK("tresca_shear", tresca_shear, "MPa", RB_FOR_FRETTING, 38, "largest tresca_shear"),
    PEAK("ruiz_2_b", ruiz_2_b, "MPa.N/mm", RB_FOR_FRETTING_B, 39, "largest ruiz_2_b"),
    PEAK("swt_b", swt_b, "MPa", RB_FOR_FRETTING_B, 40, "largest swt_b, also at the edges"),
    PEAK("tresca_shear_b", tresca_shear_b, "MPa", RB_FOR_FRETTING_B, 41, "largest tresca_shear_b"),
    RESULT("datum", datum, .unit = "mm",
           .meaning = "distance along the surface at which a load moves nothing; half-planes"),
    RESULT("boundary_elements", boundary_elements, .kind = RB_RESULT_WHOLE,
           .meaning = "of both bodies"),
    RESULT("accuracy_elements", accuracy_elements, .no_derivative = 1, .condition = RB_FOR_ACCURACY,
           .meaning = "contact elements that --accuracy has ended with"),
    RESULT("accuracy_boundary", accuracy_boundary, .no_derivative = 1, .condition = RB_FOR_ACCURACY,
           .meaning = "how many times as fine it has made the boundary of wheels"),
    RESULT("assembly", seconds_assembly, .kind = RB_RESULT_SECONDS,
           .meaning = "boundary-element matrices"),
    RESULT("factor", seconds_factor, .kind = RB_RESULT_SECONDS, .meaning = "their factorisation"),
    RESULT("condense", seconds_condense, .kind = RB_RESULT_SECONDS,
           .meaning = "flexibility of the contact"),
    RESULT("lcp", seconds_lcp, .kind = RB_RESULT_SECONDS, .meaning = "complementarity problem"),
    RESULT("total", seconds_total, .kind = RB_RESULT_SECONDS, .meaning = "everything"),
};

#define CYCLE(name, unit_, words)                                                                  \
    RESULT(#name, name, .unit = unit_, .no_derivative = 1, .condition = RB_FOR_FRETTING,           \
           .meaning = words)
#define CYCLE_B(name, unit_, words)                                                                \
    RESULT(#name, name, .unit = unit_, .no_derivative = 1, .condition = RB_FOR_FRETTING_B,         \
           .meaning = words)

static const rb_rolling_result columns[] = {
    RESULT("x", x, .no_derivative = 1, .unit = "mm", .meaning = "midpoint"),
    RESULT("h", h, .no_derivative = 1, .unit = "mm", .meaning = "length"),
    RESULT("gap", gap, .unit = "mm", .meaning = "gap"),
    RESULT("p", p, .unit = "MPa", .meaning = "pressure"),
    RESULT("q", q, .unit = "MPa", .meaning = "friction on A, towards +x"),
    RESULT("un", un, .unit = "mm", .meaning = "displacement along the normal"),
    RESULT("ut", ut, .unit = "mm", .meaning = "displacement along the tangent"),
    RESULT("shift", shift, .unit = "mm", .meaning = "slip displacement; 0 in stick"),
    RESULT("slip", slip, .unit = "1", .meaning = "relative slip velocity"),
    RESULT("zone", zone, .kind = RB_RESULT_WHOLE,
           .meaning = "0 separated, 1 stick, 2 slip with q = -mu p, 3 with q = +mu p; 4, 5 "
                      "the interface yields, q < 0, q > 0"),
    RESULT("temperature", temperature, .unit = "K", .condition = RB_FOR_HEAT,
           .meaning = "of A's surface"),
    RESULT("temperature_b", temperature_b, .unit = "K", .condition = RB_FOR_HEAT,
           .meaning = "of B's surface; in contact A's"),
    RESULT("worn", worn, .unit = "mm", .condition = RB_FOR_WORN,
           .meaning = "depth that is worn off"),
    RESULT("mu", mu, .unit = "1", .condition = RB_FOR_LAW,
           .meaning = "coefficient of friction by the law"),
    RESULT("plastic", plastic, .unit = "mm", .condition = RB_FOR_YIELD,
           .meaning = "what the interface has yielded, of either direction"),
    RESULT("heat_flux_a", heat_a, .no_derivative = 1, .unit = "kW/m2", .condition = RB_FOR_HEAT,
           .meaning = "heat that enters A's surface per area"),
    RESULT("heat_flux_b", heat_b, .no_derivative = 1, .unit = "kW/m2", .condition = RB_FOR_HEAT,
           .meaning = "heat that enters B's surface per area"),
    CYCLE(fretting_work, "N/mm", "work of friction in the last cycle, int |q| ds"),
    CYCLE(slip_range, "mm", "largest less least slip in it, twice the amplitude"),
    CYCLE(ruiz_1, "N/mm", "Ruiz's first parameter, largest |q| times slip_range"),
    CYCLE(tension, "MPa", "largest sxx at A's surface"),
    CYCLE(ruiz_2, "MPa.N/mm", "Ruiz's second parameter, tension times ruiz_1; 0 in compression"),
    CYCLE(swt, "MPa",
          "Smith, Watson and Topper: tension times half the range of the strain along x"),
    CYCLE(tresca_shear, "MPa", "largest shear of all planes at A's surface, after Tresca"),
    CYCLE_B(tension_b, "MPa", "largest sxx at B's surface"),
    CYCLE_B(ruiz_2_b, "MPa.N/mm", "Ruiz's second parameter of B"),
    CYCLE_B(swt_b, "MPa", "Smith, Watson and Topper's of B"),
    CYCLE_B(tresca_shear_b, "MPa", "largest shear of all planes at B's surface"),
};

/* New ones at the end: scripts count columns. */
static const rb_rolling_result steps[] = {
    STEP("distance", distance, .no_derivative = 1, .unit = "a",
         .meaning = "rolled so far, in half-widths"),
    STEP("creepage", creepage, .unit = "1", .error_bar = RB_SCALE_CREEPAGE, .is_mean = 1,
         .meaning = "xi; 0 at rest"),
    STEP("shift", shift, .unit = "mm", .error_bar = RB_SCALE_SHIFT,
         .meaning = "rigid shift of A so far, in static steps"),
    STEP("approach", approach, .unit = "mm", .error_bar = RB_SCALE_APPROACH, .meaning = "delta"),
    STEP("normal_load", normal_load, .unit = "N/mm", .error_bar = RB_SCALE_LOAD, .meaning = "P"),
    STEP("tangential_load", tangential_load, .unit = "N/mm", .error_bar = RB_SCALE_FRICTION,
         .meaning = "Q"),
    STEP("force_ratio", force_ratio, .unit = "1", .error_bar = RB_SCALE_ONE, .meaning = "Q/(mu P)"),
    STEP("stick", stick, .unit = "elements", .kind = RB_RESULT_WHOLE,
         .meaning = "elements that stick"),
    STEP("slip", slipping, .unit = "elements", .kind = RB_RESULT_WHOLE,
         .meaning = "elements that slip"),
    STEP("residual", residual, .no_derivative = 1, .unit = "1",
         .meaning = "natural residual of the scaled problem"),
    STEP("max_pressure", max_pressure, .unit = "MPa", .error_bar = RB_SCALE_PRESSURE,
         .meaning = "p0; 0 without contact"),
    STEP("contact_from", contact_from, .unit = "mm", .error_bar = RB_SCALE_WIDTH,
         .meaning = "trailing edge"),
    STEP("contact_to", contact_to, .unit = "mm", .error_bar = RB_SCALE_WIDTH,
         .meaning = "leading edge"),
    STEP("dissipation", dissipation, .unit = "N/mm", .error_bar = RB_SCALE_POWER, .is_mean = 1,
         .meaning = "friction power per unit speed; 0 at rest"),
    STEP("moment", moment, .unit = "N", .error_bar = RB_SCALE_MOMENT,
         .meaning = "int x p dx; > 0: the load acts ahead of x = 0"),
    STEP("max_temperature", max_temperature, .unit = "K", .error_bar = RB_SCALE_HEAT,
         .condition = RB_FOR_HEAT, .meaning = "highest temperature of the surfaces in contact"),
    STEP("time", time, .no_derivative = 1, .unit = "s", .condition = RB_FOR_MEMORY,
         .meaning = "at the end of the step, of bodies that relax"),
    STEP("lost_work", lost_work, .unit = "N", .error_bar = RB_SCALE_WORK,
         .condition = RB_FOR_MEMORY, .meaning = "work that bodies which relax have lost so far"),
    STEP("mu", mu, .unit = "1", .condition = RB_FOR_WAY,
         .meaning = "coefficient of friction at the end of the step"),
    STEP("bulk_stress", bulk_stress, .no_derivative = 1, .unit = "MPa",
         .condition = RB_FOR_BULK_WAY,
         .meaning = "of A at the end of the step, where the history has the column"),
    STEP("bulk_stress_b", bulk_stress_b, .no_derivative = 1, .unit = "MPa",
         .condition = RB_FOR_BULK_B_WAY, .meaning = "likewise of B"),
    STEP("tilt", tilt, .no_derivative = 1, .condition = RB_FOR_TILT_WAY,
         .meaning = "of A at the end of the step, where the history has the column"),
    STEP("torque_a", torque_a, .unit = "N", .error_bar = RB_SCALE_TORQUE,
         .meaning = "on A's axle, > 0 the way A rolls"),
    STEP("torque_b", torque_b, .unit = "N", .error_bar = RB_SCALE_TORQUE,
         .condition = RB_FOR_CYLINDER_B, .meaning = "on B's axle, > 0 the way B rolls"),
    STEP("substeps", substeps, .unit = "1", .kind = RB_RESULT_WHOLE,
         .meaning = "in how many steps the row was computed"),
    STEP("step_work", step_work, .unit = "N",
         .meaning = "work that friction dissipates in the row, also at rest"),
    STEP("friction_work", friction_work, .unit = "N", .error_bar = RB_SCALE_WORK,
         .meaning = "the same so far"),
};

static const rb_rolling_result points[] = {
    POINT("creepage", creepage, .unit = "1", .meaning = "xi"),
    POINT("creep_ratio", creep_ratio, .unit = "1", .meaning = "xi R/(mu a)"),
    POINT("force_ratio", force_ratio, .unit = "1", .error_bar = RB_SCALE_ONE,
          .meaning = "Q/(mu P)"),
    POINT("tangential_load", tangential_load, .symbol = "Q", .unit = "N/mm",
          .error_bar = RB_SCALE_ONE, .meaning = "Q"),
    POINT("normal_load", normal_load, .symbol = "P", .unit = "N/mm", .error_bar = RB_SCALE_ONE,
          .meaning = "P"),
    POINT("stick_ratio", stick_ratio, .unit = "1", .error_bar = RB_SCALE_ONE,
          .meaning = "length that sticks / length in contact"),
    POINT("yield_ratio", yield_ratio, .unit = "1", .error_bar = RB_SCALE_ONE,
          .condition = RB_FOR_YIELD, .meaning = "length that yields / length in contact"),
    POINT("dissipation", dissipation, .unit = "N/mm", .error_bar = RB_SCALE_ONE,
          .meaning = "friction power per unit speed"),
    POINT("residual", residual, .unit = "1", .meaning = "natural residual of the scaled problem"),
    POINT("speed", speed, .unit = "mm/s", .meaning = "of rolling, of bodies that relax"),
    POINT("resistance_moment", resistance_moment, .unit = "N", .error_bar = RB_SCALE_ONE,
          .meaning = "M = int x p dx"),
    POINT("resistance_ratio", resistance_ratio, .unit = "1", .error_bar = RB_SCALE_ONE,
          .meaning = "M/(P R), 1/R = 1/R_A + 1/R_B, of an ellipse R the strip_radius"),
    POINT("hysteresis", hysteresis, .unit = "N/mm", .error_bar = RB_SCALE_ONE,
          .meaning = "power per unit speed that bodies which relax lose"),
    POINT("max_temperature", max_temperature, .unit = "K", .error_bar = RB_SCALE_ONE,
          .condition = RB_FOR_HEAT, .meaning = "highest temperature of the surfaces in contact"),
    POINT("branch", branch, .kind = RB_RESULT_WHOLE, .condition = RB_FOR_MOVING_LAW,
          .meaning = "1: on the way from --from to --to, 2: on the way back"),
    POINT("kappa", kappa, .unit = "1", .condition = RB_FOR_MOVING_LAW,
          .meaning = "uniqueness of friction that falls: above 1 the branches may differ"),
    POINT("torque_a", torque_a, .unit = "N", .error_bar = RB_SCALE_ONE,
          .meaning = "M + Q R_A, on A's axle, > 0 the way A rolls"),
    POINT("torque_b", torque_b, .unit = "N", .error_bar = RB_SCALE_ONE,
          .condition = RB_FOR_CYLINDER_B, .meaning = "M - Q R_B, on B's axle, > 0 the way B rolls"),
    POINT("ellipse_force", ellipse_force, .unit = "N", .condition = RB_FOR_ELLIPSE_FORCE,
          .meaning = "Q of the whole ellipse by strips"),
    POINT("ellipse_force_kalker", ellipse_force_kalker, .unit = "N",
          .condition = RB_FOR_ELLIPSE_FORCE,
          .meaning = "the same of alike bodies with the slope of Kalker's C11"),
};

static const rb_rolling_result wears[] = {
    WEAR("way", way, .meaning = "slid so far [mm]; cycles or turns so far"),
    WEAR("worn", worn, .error_bar = RB_SCALE_ONE, .unit = "mm2",
         .meaning = "worn volume per mm of width"),
    WEAR("max_depth", max_depth, .error_bar = RB_SCALE_ONE, .unit = "mm",
         .meaning = "largest worn depth"),
    WEAR("radius", radius, .error_bar = RB_SCALE_ONE, .unit = "mm", .meaning = "of A"),
    WEAR("worn_b", worn_b, .error_bar = RB_SCALE_ONE, .unit = "mm2",
         .meaning = "worn volume of B, with a share"),
    WEAR("max_depth_b", max_depth_b, .error_bar = RB_SCALE_ONE, .unit = "mm",
         .meaning = "largest worn depth of B; of a track, in one passage"),
    WEAR("radius_b", radius_b, .error_bar = RB_SCALE_ONE, .unit = "mm",
         .meaning = "of B; < 0 of a bore"),
    WEAR("work", work, .error_bar = RB_SCALE_ONE,
         .meaning = "of friction, per slid or rolled mm [N/mm] or cycle [N]"),
    WEAR("stroke", stroke, .error_bar = RB_SCALE_ONE, .unit = "mm",
         .meaning = "fretting: A slides to so far on either side, mean of the contact"),
    WEAR("approach", approach, .error_bar = RB_SCALE_ONE, .unit = "mm", .meaning = "delta"),
    WEAR("normal_load", normal_load, .error_bar = RB_SCALE_ONE, .unit = "N/mm", .meaning = "P"),
    WEAR("max_pressure", max_pressure, .error_bar = RB_SCALE_ONE, .unit = "MPa", .meaning = "p0"),
    WEAR("contact_from", contact_from, .error_bar = RB_SCALE_ONE, .unit = "mm",
         .meaning = "trailing edge"),
    WEAR("contact_to", contact_to, .error_bar = RB_SCALE_ONE, .unit = "mm",
         .meaning = "leading edge"),
    WEAR("residual", residual, .meaning = "natural residual under the worn gap"),
};

static const rb_rolling_result patch[] = {
    PATCH("from", from, .unit = "mm", .meaning = "trailing edge"),
    PATCH("to", to, .unit = "mm", .meaning = "leading edge"),
    PATCH("normal_load", normal_load, .unit = "N/mm", .meaning = "its part of P"),
    PATCH("tangential_load", tangential_load, .unit = "N/mm", .meaning = "its part of Q"),
    PATCH("max_pressure", max_pressure, .unit = "MPa", .meaning = "p0"),
    PATCH("peak", peak, .unit = "mm", .meaning = "where p0 is"),
    PATCH("contact", contact, .kind = RB_RESULT_WHOLE, .meaning = "elements in contact"),
    PATCH("stick", stick, .kind = RB_RESULT_WHOLE, .meaning = "elements that stick"),
};

static const rb_rolling_result stresses[] = {
    STRESS("x", x, .unit = "mm", .meaning = "along the surface"),
    STRESS("y", y, .unit = "mm", .meaning = "depth; > 0 inside A"),
    STRESS("sxx", sxx, .unit = "MPa", .meaning = "stress, tension positive"),
    STRESS("syy", syy, .unit = "MPa", .meaning = "stress"),
    STRESS("szz", szz, .unit = "MPa", .meaning = "stress along the axis"),
    STRESS("sxy", sxy, .unit = "MPa", .meaning = "shear stress"),
    STRESS("principal_1", principal_1, .unit = "MPa",
           .meaning = "principal stress in the plane, the larger one"),
    STRESS("principal_2", principal_2, .unit = "MPa",
           .meaning = "principal stress in the plane, the smaller one"),
    STRESS("max_shear", max_shear, .unit = "MPa", .meaning = "largest shear in the plane"),
    STRESS("tresca_shear", tresca_shear, .unit = "MPa",
           .meaning = "largest shear of all planes, after Tresca"),
    STRESS("von_mises", von_mises, .unit = "MPa", .meaning = "stress of von Mises"),
    STRESS("hydrostatic", hydrostatic, .unit = "MPa", .meaning = "a third of the trace"),
    STRESS("temperature", temperature, .unit = "K", .condition = RB_FOR_HEAT_INSIDE,
           .meaning = "under the heat of friction, curvature neglected"),
};

/* of: behind the names of body B's */
#define LARGEST_OF(owner, name, of, member, words)                                                 \
    OF(owner, name of, member.value, .unit = "MPa", .error_bar = RB_SCALE_PRESSURE,                \
       .meaning = words),                                                                          \
        OF(owner, name "_x" of, member.x, .unit = "mm", .error_bar = RB_SCALE_WIDTH,               \
           .meaning = "its place along the surface"),                                              \
        OF(owner, name "_y" of, member.y, .unit = "mm", .error_bar = RB_SCALE_WIDTH,               \
           .meaning = "its depth")
#define LARGEST(name, of, member, words)                                                           \
    LARGEST_OF(rb_rolling_stress_maxima, name, of, member, words)
#define OF_BOND(name, of, member, words)                                                           \
    LARGEST_OF(rb_rolling_bond_maxima, "bond_1_" name, of, member, words)
#define BOND(of, in)                                                                               \
    OF_BOND("peel", of, peel, "peel at bond 1" in),                                                \
        OF_BOND("shear", of, shear, "shear at bond 1" in),                                         \
        OF_BOND("tension_above", of, tension_above, "tension above bond 1" in),                    \
        OF_BOND("tension_below", of, tension_below, "tension below bond 1" in)
#define MAXIMA(of, in)                                                                             \
    LARGEST("max_shear", of, max_shear, "in-plane shear" in),                                      \
        LARGEST("tresca_shear", of, tresca_shear, "largest (Tresca) shear" in),                    \
        LARGEST("von_mises", of, von_mises, "von Mises" in),                                       \
        LARGEST("orthogonal_shear", of, orthogonal_shear, "orthogonal shear |sxy|" in),            \
        LARGEST("tension", of, tension, "largest principal stress" in),                            \
        LARGEST("compression", of, compression, "largest compression" in)

static const rb_rolling_result maxima[] = {MAXIMA("", "")};
static const rb_rolling_result maxima_b[] = {MAXIMA("_b", " in B")};
static const rb_rolling_result bond[] = {BOND("", "")}, bond_b[] = {BOND("_b", " in B")};

#define TABLE(rows)                                                                                \
    {                                                                                              \
        sizeof(rows) / sizeof *(rows), rows                                                        \
    }
const rb_rolling_results rb_rolling_solution_scalars = TABLE(scalars);
const rb_rolling_results rb_rolling_solution_columns = TABLE(columns);
const rb_rolling_results rb_rolling_patch_scalars = TABLE(patch);
const rb_rolling_results rb_rolling_history_columns = TABLE(steps);
const rb_rolling_results rb_rolling_curve_columns = TABLE(points);
const rb_rolling_results rb_rolling_wear_columns = TABLE(wears);
const rb_rolling_results rb_rolling_stress_scalars = TABLE(stresses);
const rb_rolling_results rb_rolling_maxima_scalars = TABLE(maxima);
const rb_rolling_results rb_rolling_maxima_b_scalars = TABLE(maxima_b);
const rb_rolling_results rb_rolling_bond_scalars = TABLE(bond);
const rb_rolling_results rb_rolling_bond_b_scalars = TABLE(bond_b);

const rb_rolling_result_table rb_rolling_result_tables[] = {
    {"number", "Numbers of a solution", &rb_rolling_solution_scalars},
    {"column", "Columns of the table of tractions", &rb_rolling_solution_columns},
    {"patch", "Patches of a contact", &rb_rolling_patch_scalars},
    {"step", "Steps of a history", &rb_rolling_history_columns},
    {"point", "Points of a creep curve", &rb_rolling_curve_columns},
    {"wear", "Steps of wear", &rb_rolling_wear_columns},
    {"stress", "Stress at a point", &rb_rolling_stress_scalars},
    {"maximum", "Largest stresses", &rb_rolling_maxima_scalars},
    {"bond",
     "Largest stresses at a bond: `bond_1_...`, `bond_2_...` and so on from the surface down",
     &rb_rolling_bond_scalars},
    {"maximum_b", "Largest stresses of body B", &rb_rolling_maxima_b_scalars},
    {"bond_b", "Largest stresses at a bond of body B", &rb_rolling_bond_b_scalars},
    {NULL, NULL, NULL}};
