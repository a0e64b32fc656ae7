/* What src/analysis and src/program use of rolling contact besides rollbem/rolling.h: results by
 * name, notes, followers, variants, conversions. */
#ifndef ROLLBEM_SRC_ROLLING_ROLLING_H
#define ROLLBEM_SRC_ROLLING_ROLLING_H

#include "base/units.h"
#include "base/sizes.h"
#include "bem/bem.h"
#include "lcp/contact/contact.h"
#include "rollbem/rolling.h"

/* ---- Case ------------------------------------------------------------------------ */

/* The most of each that a case may ask for: elements of the contact and on the circle outside
 * it, steps of a history, points of a curve. */
enum {
    RB_ROLLING_MOST_ELEMENTS = 1 << 24,
    RB_ROLLING_MOST_OUTER = RB_BEM_MOST_ELEMENTS,
    RB_ROLLING_MOST_STEPS = 10000000,
    RB_ROLLING_MOST_POINTS = 1000000
};

/* Properties of a body, as bits. */
typedef enum {
    RB_BODY_FLAT = 1,        /* its surface is a plane, otherwise a circle */
    RB_BODY_BOUNDARY = 2,    /* has boundary elements outside the contact, too */
    RB_BODY_HOMOGENEOUS = 4, /* of one elastic material: Hertz's half-width applies, and
                                the formulas of heat conduction, too */
    RB_BODY_ELASTIC = 8,     /* elastic: no hysteresis */
    RB_BODY_STRESS = 16,     /* the stress inside can be computed */
    RB_BODY_TURNS = 32       /* rotationally symmetric: its stiffness is the same at every angle */
} rb_rolling_ability;

/* An option that applies to some bodies only; the option of body B has the suffix
 * "-b". */
typedef struct {
    const char *option;                              /* NULL ends the list */
    int (*has_meaning)(const rb_rolling_body *body); /* NULL: every body of the row */
    const char *reason; /* end of the error message for other bodies; NULL: "of the
                           support ..." */
} rb_rolling_parameter;

/* The allowed words of the option `support`; an entry with name NULL ends the list. */
extern const rb_choice rb_rolling_supports[];

/* 1: the body has all properties of the sum `abilities`. */
int rb_rolling_body_can(const rb_rolling_body *body, int abilities);
/* Whether all numbers are the same, NAN included; bytes between them do not count. */
int rb_rolling_same_body(const rb_rolling_body *x, const rb_rolling_body *y);

/* As rb_rolling_profile_create, but one cubic spline without corners, which changes smoothly with
 * its points: of a gap that is searched for. */
rb_status rb_rolling_profile_smooth(int n, const double *x, const double *gap,
                                    rb_rolling_profile **profile, rb_message *why);

/* As rb_rolling_profile_create, of a body that ends where the table ends: the smallest gap may be
 * there. */
rb_status rb_rolling_profile_punch(int n, const double *x, const double *gap, double noise,
                                   rb_rolling_profile **profile, rb_message *why);

/* The radius of the parabola that is nearest to the gap around its smallest value, in the lowest
 * tenth of its range [length]; NAN: the gap has none: it is flat, a roof or hollow there. */
double rb_rolling_profile_radius(const rb_rolling_profile *profile);
/* The first and the last x of the profile. */
void rb_rolling_profile_range(const rb_rolling_profile *profile, double *from, double *to);
/* The gap at any x.  Beyond the ends it is extrapolated by straight lines; a contact
 * there is not accepted. */
double rb_rolling_profile_gap(const rb_rolling_profile *profile, double x);

/* ---- Friction laws (theory-rolling.md 4.11) ------------------------------------------------ */

/* The elastic constants of a body for the plane problem of the case; the second function:
 * those of the base or core below its layer or cover. */
rb_bem_material rb_rolling_material(const rb_rolling_case *rc, const rb_rolling_body *body);
rb_bem_material rb_rolling_base_material(const rb_rolling_case *rc, const rb_rolling_body *body);

/* The largest coefficient of the friction law; it is the mu of Q/(mu P) and of xi R/(mu
 * a). */
double rb_rolling_largest_mu(const rb_rolling_case *rc);
/* The largest coefficient times Dundurs' constant of both bodies: from 1 on the contact may have
 * several solutions, or an open element beside each closed one. */
double rb_rolling_mu_beta(const rb_rolling_case *rc);
/* 1 if the coefficients depend on the solution, so that they have to be iterated: in
 * rolling, if the law depends on the slip velocity or on the temperature. */
int rb_rolling_law_depends_on_state(const rb_rolling_case *rc);
/* 1: A, and B if it is elastic, have all properties of `abilities`. */
int rb_rolling_can(const rb_rolling_case *rc, int abilities);

/* 1 if Carter's law applies: steady rolling of similar homogeneous half-planes whose gap
 * is not a table. */
int rb_rolling_carter_holds(const rb_rolling_case *rc);
/* 1: pressure displaces the surfaces along each other, and friction apart: the bodies are unlike,
 * and tractions have other exponents at the edges than the square root (E1). */
int rb_rolling_couples(const rb_rolling_case *rc);
/* 1: a body of the case is viscoelastic. */
int rb_rolling_relaxes(const rb_rolling_case *rc);

/* What follows from a case. */
rb_rolling_derived rb_rolling_derive(const rb_rolling_case *rc);
/* 1/R = 1/R_A + 1/R_B; Hertz's half-width of a load, and the load of a half-width.  INFINITY: the
 * gap is a table that has no radius, and none was given; what refers to one is NAN then. */
double rb_rolling_radius(const rb_rolling_case *rc);
int rb_rolling_has_radius(const rb_rolling_case *rc);
double rb_rolling_hertz_half_width(const rb_rolling_case *rc, double load);
/* The half-width a of the contact under a load by formula, the unit of distances and of xi R/(mu
 * a): Hertz's; with a third body that gives way and in steady rolling of bodies that relax theirs
 * (theory-rolling.md A1), to one or two per cent; of a gap without a radius half of where it is
 * low. */
double rb_rolling_contact_half_width(const rb_rolling_case *rc, double load);
/* The unit of the distances of a history under this largest load: the same of the bodies at rest,
 * where nothing has relaxed yet. */
double rb_rolling_unit_of_distance(const rb_rolling_case *rc, double load);

/* The case with elastic bodies that are as soft as its own, which relax, in a step of this length
 * [s].  INFINITY: rubbery, as the elements of a history at rest are made for. */
rb_rolling_case rb_rolling_memory_case(const rb_rolling_case *rc, double step);
/* The half-width that an automatic zone follows [length]: Hertz's, or, where it is larger, that
 * between rigid bodies with the normal compliance L_N of the third body, P = 2 a^3/(3 R L_N).
 * load: NaN: those of the given approach. */
double rb_rolling_zone_half_width(const rb_rolling_case *rc, double load);
double rb_rolling_hertz_load(const rb_rolling_case *rc, double half_width);
/* The load of the largest pressure of the case: pi R p^2/E*, or of a gap without a radius an
 * estimate. */
double rb_rolling_pressure_load(const rb_rolling_case *rc);
/* 1: that is the load exactly. */
int rb_rolling_pressure_is_hertz(const rb_rolling_case *rc);
/* Finds the load under which the largest pressure of the solved case is that of the case, within
 * 1e-10; sets pressed_by and, of equal elements without one, zone.  RB_EINVAL: the gap has
 * corners. */
rb_status rb_rolling_find_load(rb_rolling_case *rc, rb_message *why);
/* Sets the ellipse of a case with a wheel load. */
rb_status rb_rolling_find_ellipse(rb_rolling_case *rc, rb_message *why);
/* Sets tilted_by, and the zone, of a case with a given moment: solves it some times. */
rb_status rb_rolling_find_tilt(rb_rolling_case *rc, rb_message *why);
/* Layers of a half-plane, 0: none; layer k of them from the surface down; the depth of the bond
 * below the first `bond` of them, of the last one, and Poisson's ratio of what lies at a depth, on
 * a bond of what lies above it. */
typedef struct {
    double thickness, young, poisson; /* [length], [stress], [-] */
} rb_rolling_layer_properties;
int rb_rolling_layers(const rb_rolling_body *body);
rb_rolling_layer_properties rb_rolling_layer_of(const rb_rolling_body *body, int k);
double rb_rolling_bond_depth(const rb_rolling_body *body, int bond);
double rb_rolling_layers_depth(const rb_rolling_body *body);
double rb_rolling_poisson_at(const rb_rolling_body *body, double depth);
/* 1: a body has a finite thickness: a layer, a cover or a wheel on a hub. */
int rb_rolling_has_thickness(const rb_rolling_case *rc);
/* The larger radius of A and B; A's if B is a plane. */
double rb_rolling_larger_radius(const rb_rolling_case *rc);

/* ---- Case -> contact mesh -> flexibility ------------------------------------------- */

/* Compression of boundaries whose flexibility is subtracted from that of others nearby: what
 * hierarchical matrices leave out by chance is divided by the step between them. */
#define RB_ROLLING_CLOSE 1e-13

/* The plan with the values of the case; functions that get plan NULL use it. */
rb_rolling_plan rb_rolling_plan_of(const rb_rolling_case *rc);

/* The elements of a result; borrowed. */
typedef struct {
    int n;
    const double *x, *h; /* n: midpoints, lengths */
    int are_equal;
} rb_rolling_elements;

/* Reconstructs the mesh of a result: equal elements from the two outer ends, fitted
 * elements from every element. */
rb_status rb_rolling_mesh_of_result(const rb_rolling_case *rc, const rb_rolling_elements *elements,
                                    rb_rolling_mesh *mesh, rb_message *why);

/* The undeformed gap of the profile at x, including the worn depth. */
double rb_rolling_initial_gap(const rb_rolling_case *rc, double x);

/* w = w0 + F (p, q), 2m values, m = n + 1.  RB_ENOMEM. */
rb_status rb_rolling_displacement(const rb_rolling_bodies *bodies, const double *p, const double *q,
                                  double *w);

/* A row of the table of bodies (src/rolling/body/body.c).  A body has the row of its support
 * and one row for each addition (layer, cover, viscoelasticity).  It has those properties
 * that all its rows have. */
typedef struct rb_rolling_body_kind rb_rolling_body_kind;

/* Row k = 0, 1, ... of the table; NULL after the last one. */
const rb_rolling_body_kind *rb_rolling_body_kind_get(int k);
/* The row of the body's support. */
const rb_rolling_body_kind *rb_rolling_kind_of(const rb_rolling_body *body);
/* 1: it is a row of this body. */
int rb_rolling_body_is(const rb_rolling_body *body, const rb_rolling_body_kind *kind);
const char *rb_rolling_kind_name(const rb_rolling_body_kind *kind); /* in pictures */
rb_bem_support rb_rolling_kind_support(const rb_rolling_body_kind *kind);
/* The options that apply to some bodies only; an entry without a name ends the list. */
const rb_rolling_parameter *rb_rolling_kind_parameters(const rb_rolling_body_kind *kind);

/* ---- Solution -------------------------------------------------------------------- */

enum { RB_LEFT_BOUNDED = 1, RB_RIGHT_BOUNDED = 2 };

/* ---- The results by name ----------------------------------------------------------- */

typedef enum {
    RB_RESULT_NUMBER,
    RB_RESULT_WHOLE,  /* int */
    RB_RESULT_SECONDS /* a number: time spent on it */
} rb_rolling_result_kind;

/* The scale of a result with an error bar; its rounding error is proportional to this
 * scale. */
typedef enum {
    RB_SCALE_NONE,
    RB_SCALE_ONE,
    RB_SCALE_LOAD,     /* P */
    RB_SCALE_FRICTION, /* mu P */
    RB_SCALE_APPROACH,
    RB_SCALE_SHIFT,    /* mu a^2/R */
    RB_SCALE_CREEPAGE, /* mu a/R */
    RB_SCALE_WIDTH,    /* a */
    RB_SCALE_ELEMENT,  /* length of an element */
    RB_SCALE_PRESSURE, /* p0 */
    RB_SCALE_POWER,    /* mu P times the creepage */
    RB_SCALE_MOMENT,   /* P a */
    RB_SCALE_TORQUE,   /* P a and mu P R */
    RB_SCALE_STRAIN,   /* a/R */
    RB_SCALE_WORK,     /* P a/R */
    RB_SCALE_HEAT      /* rise of the temperature */
} rb_rolling_error_scale;

/* Which cases have a result.  For all other cases a number is NAN, a column is NULL, and
 * reports omit both. */
typedef enum {
    RB_FOR_ALL,
    RB_FOR_HEAT,
    RB_FOR_HEAT_INSIDE, /* heat of steady rolling */
    RB_FOR_WORN,
    RB_FOR_LAW,        /* friction coefficients that differ between elements */
    RB_FOR_MOVING_LAW, /* friction coefficients that depend on the state */
    RB_FOR_WAY,        /* friction coefficient from a column of a history */
    RB_FOR_BULK_WAY,   /* likewise bulk stress, that of B and tilt */
    RB_FOR_BULK_B_WAY,
    RB_FOR_TILT_WAY,
    RB_FOR_PERIOD,
    RB_FOR_MEMORY,
    RB_FOR_YIELD,
    RB_FOR_CYLINDER_B,
    RB_FOR_TILT,
    RB_FOR_ELLIPSE,
    RB_FOR_ELLIPSE_FORCE,
    RB_FOR_SMOOTH_BASE,
    RB_FOR_FRETTING,
    RB_FOR_FRETTING_B /* likewise of an elastic B */
} rb_rolling_condition;

/* Description of one result.  Tables, JSON, studies and error bars are made from these
 * rows. */
typedef struct {
    const char *name; /* in JSON */
    const char *unit; /* "mm"; NULL: none */
    rb_rolling_result_kind kind;
    size_t offset; /* of the value, or of the pointer to the column, in its struct */
    rb_rolling_error_scale error_bar; /* RB_SCALE_NONE: no discretisation error is estimated
                                       */
    int study;                        /* number of its column in a study; 0: none */
    int is_mean;       /* in a rolled step: 1: mean over the step, 0: value at its end */
    int no_derivative; /* 1: has no derivative: a residual, or a place known only to
                          within one element */
    rb_rolling_condition condition;
    const char *symbol; /* heads the column instead of the name; NULL: the name */
    const char *meaning;
} rb_rolling_result;

typedef struct {
    int n;
    const rb_rolling_result *row;
} rb_rolling_results;

/* The numbers of rb_rolling_solution, and its columns with one entry per element. */
extern const rb_rolling_results rb_rolling_solution_scalars, rb_rolling_solution_columns;
/* The numbers of rb_rolling_patch. */
extern const rb_rolling_results rb_rolling_patch_scalars;
/* The columns of rb_rolling_history, one entry per step, and of rb_rolling_curve, one
 * entry per creepage. */
extern const rb_rolling_results rb_rolling_history_columns, rb_rolling_curve_columns;
/* The columns of rb_rolling_wear_history, one entry per step. */
extern const rb_rolling_results rb_rolling_wear_columns;
/* The numbers of rb_rolling_stress, and of rb_rolling_stress_maxima: three rows for each
 * maximum, its value and its place; of rb_rolling_bond_maxima, with the names of bond 1. */
extern const rb_rolling_results rb_rolling_stress_scalars, rb_rolling_maxima_scalars,
    rb_rolling_maxima_b_scalars, rb_rolling_bond_scalars, rb_rolling_bond_b_scalars;

/* All these tables; an entry without a name ends the list. */
typedef struct {
    const char *name, *title;
    const rb_rolling_results *results;
} rb_rolling_result_table;
extern const rb_rolling_result_table rb_rolling_result_tables[];

/* The row with this name; NULL: there is none. */
const rb_rolling_result *rb_rolling_find_result(const rb_rolling_results *table, const char *name);
/* Columns of a program that are columns of its history, too. */
enum { RB_VARIES_MU = 1, RB_VARIES_BULK = 2, RB_VARIES_BULK_B = 4, RB_VARIES_TILT = 8 };
unsigned rb_rolling_program_varies(const rb_rolling_program *program);

/* 1 if the case has this result.  varies: in a history with such columns. */
int rb_rolling_has_result(const rb_rolling_result *r, const rb_rolling_case *rc, unsigned varies);
/* 1 if the struct `owner` has this column. */
int rb_rolling_has_column(const rb_rolling_result *r, const void *owner);
/* The numbers of a solution without its columns, which remain with it. */
rb_rolling_solution rb_rolling_scalars_of(const rb_rolling_solution *solution);
/* The number, or entry i of the column, as a double; owner: the struct that the table
 * describes. */
double rb_rolling_number(const rb_rolling_result *r, const void *owner);
double rb_rolling_entry(const rb_rolling_result *r, const void *owner, int i);
/* The column itself, of numbers; NULL: the owner has none. */
double *rb_rolling_column(const rb_rolling_result *r, const void *owner);
void rb_rolling_set_number(const rb_rolling_result *r, void *owner, double value);
/* From mm, N, MPa to other units: the numbers, or the columns of so many rows, that have one. */
void rb_rolling_numbers_convert(const rb_rolling_results *table, void *owner, rb_units units);
void rb_rolling_columns_convert(const rb_rolling_results *table, int rows, void *owner,
                                rb_units units);

/* Writes the name with its unit, as in the heads of columns: "max_pressure_MPa".  Returns
 * heading. */
enum { RB_ROLLING_HEADING = 40 };
const char *rb_rolling_heading(const rb_rolling_result *r, rb_units units,
                               char heading[RB_ROLLING_HEADING]);

/* Column k = 1, 2, ... of a study; NULL after the last one. */
const rb_rolling_result *rb_rolling_study_column(int k);

/* Friction power per area and unit speed [stress], n values with sum power h =
 * dissipation; wear laws use it.  In steady rolling the slip is known between midpoints,
 * and half of it is assigned to each of the two elements (theory-solvers.md 6).  NAN in
 * static. */
void rb_rolling_friction_power(const rb_rolling_solution *s, double *power);

typedef struct {
    int n;
    int kind[RB_ROLLING_NOTES]; /* which note, see rb_rolling_note_name */
    char text[RB_ROLLING_NOTES][RB_ROLLING_NOTE_LENGTH];
    rb_status status; /* RB_ENOMEM: notes are missing */
} rb_rolling_note_list;
extern const char rb_rolling_notes_missing[]; /* the sentence that says so */
rb_rolling_note_list rb_rolling_find_notes(const rb_rolling_case *rc, const rb_rolling_solution *s);
/* "static-creepage", ... of kind k = 0, 1, ...; NULL after the last one. */
const char *rb_rolling_note_name(int k);

/* The notes on one row of a curve or a study: the first few of them. */
enum { RB_ROLLING_ROW_NOTES = 6 };
typedef struct {
    int n, kind[RB_ROLLING_ROW_NOTES];
    char text[RB_ROLLING_ROW_NOTES][RB_ROLLING_NOTE_LENGTH];
    rb_status status; /* RB_ENOMEM: notes are missing */
} rb_rolling_row_notes;
/* Those of a solved case in the units of the solution, but for those on columns of its table. */
rb_rolling_row_notes rb_rolling_find_row_notes(const rb_rolling_case *rc,
                                               const rb_rolling_solution *s);
/* One more, of a kind of the caller's from RB_ROLLING_OWN_NOTES on. */
enum { RB_ROLLING_OWN_NOTES = 37 };
void rb_rolling_add_note(rb_rolling_row_notes *notes, int kind, const char *text);

/* Adds the notes of a row to those on all rows (rb_rolling_study_notes). */
void rb_rolling_add_row_notes(rb_rolling_study_notes *all, int row,
                              const rb_rolling_row_notes *notes);
/* Further rows behind those of `all`. */
void rb_rolling_join_study_notes(rb_rolling_study_notes *all, const rb_rolling_study_notes *more);
/* One line for each kind, with the rows that it is true of; row: "case", "point". */
rb_rolling_note_list rb_rolling_list_study_notes(const rb_rolling_study_notes *all,
                                                 const char *row);
/* 1: the friction power is negative by more than rounding errors, which is an error of
 * the mesh; the text of the note about it. */
int rb_rolling_is_below_zero(double dissipation, double load);
const char *rb_rolling_below_zero(const rb_rolling_case *rc, const rb_rolling_solution *s);

/* Temperature rise at a point of the surface caused by a unit heat flux that enters the
 * body between the distances `from` < `to` upstream of the point (T1), at any Peclet
 * number; conductivity > 0. */
double rb_rolling_heat_response(const rb_rolling_heat *body, double speed, double from, double to);

/* ---- The model of a case -------------------------------------------------------- */

/* 1 if the mesh has so many equal elements that it is solved by Fourier transforms,
 * without a matrix. */
int rb_rolling_is_large(const rb_rolling_case *rc, const rb_rolling_mesh *mesh);
/* The same for a build that has Fourier transforms: the page has none, and takes the same
 * elements. */
int rb_rolling_suits_large(const rb_rolling_case *rc, const rb_rolling_mesh *mesh);

/* As rb_rolling_model_create, by another plan (NULL: that of the case), for a model of zeros, or
 * one that has solved a case which differs at most in friction, load, approach, shift, creepage or
 * force.  Its flexibility is used again if the equal elements have the same ends.  The
 * result is bitwise the same as without it. */
rb_status rb_rolling_model_reuse(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                 rb_rolling_model *model, rb_message *why);
/* Makes an empty model with a copy of the case; mesh and bodies are built later.  plan
 * NULL: that of the case. RB_ENOMEM; model: overwritten. */
rb_status rb_rolling_model_begin(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                 rb_rolling_model *model, rb_message *why);
/* Takes ownership of the mesh, builds the bodies on it and solves.  RB_ZONE: solved, and
 * the contact does not end within the mesh. */
rb_status rb_rolling_model_build(rb_rolling_model *model, rb_rolling_mesh *mesh, rb_message *why);
/* Solves the model's problem again and adds to its times and counts; warm: 1 to start
 * from its zones.  RB_ZONE as of rb_rolling_model_create.  Every solve on any mesh calls this
 * function. */
rb_status rb_rolling_model_resolve(rb_rolling_model *model, int warm, rb_message *why);
/* The same on the present mesh, from the present zones, after the given load, force or
 * motion of the model's case has changed. */
rb_status rb_rolling_model_control(rb_rolling_model *model, rb_message *why);
/* How many equal elements are used where so many cannot be fitted to the edges of the contact. */
int rb_rolling_equal_elements_instead(int elements);
/* Builds bodies and contact problem on the elements of a result, with a state of zeros,
 * and solves nothing.  plan: NULL: that of the case.  model: all zeros before; free it in
 * any case. */
rb_status rb_rolling_model_of_result(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                     const rb_rolling_elements *elements, rb_rolling_model *model,
                                     rb_message *why);

/* The boundary elements of A or B; n = 0 for half-planes and rigid bodies.  RB_EINVAL,
 * RB_ENOMEM. */
rb_status rb_rolling_boundary_mesh(const rb_rolling_model *model, int of_b, rb_bem_mesh *boundary,
                                   rb_message *why);

/* Forms the matrices of the flexibility and of the problem if the model was solved
 * without them and has fewer than RB_ROLLING_LARGE elements; other models are not
 * changed. RB_ENOMEM. */
rb_status rb_rolling_model_add_matrix(rb_rolling_model *model, rb_message *why);

/* Sets the friction coefficients of the model's problem to those that the friction law
 * gives for its state, and likewise a given force; the residual of the state then
 * includes the friction law.  RB_ENOMEM. */
rb_status rb_rolling_model_friction(rb_rolling_model *model, rb_message *why);

/* The case that rolls without a force. */
rb_rolling_case rb_rolling_without_force(const rb_rolling_case *rc);
/* The creepage at which Q = 0 (steady, mu > 0), on the model's mesh.  The model's
 * solution is not changed, but the data that it keeps for further solves is. */
rb_status rb_rolling_free_creepage(rb_rolling_model *model, double *creepage, rb_message *why);
/* The force of the whole ellipse at the creepage of the solved model, by the strips that its case
 * asks for, each solved on its own; force is left as it is where it asks for none.  A strip without
 * a solution: its status, NAN. */
rb_status rb_rolling_solve_strips(const rb_rolling_model *model, double *force, rb_message *why);

/* P and Q of the state. */
double rb_rolling_model_load(const rb_rolling_model *model);
double rb_rolling_model_force(const rb_rolling_model *model);
/* Q divided by the maximum friction force mu P; NAN without friction or load. */
double rb_rolling_force_ratio(const rb_rolling_model *model);
/* 1: the mesh is a whole period, and its ends are one place. */
int rb_rolling_fills_period(const rb_rolling_case *rc, const rb_rolling_mesh *mesh);
/* The outer edges of all patches; NAN without contact. */
void rb_rolling_contact_edges(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                              const rb_contact_state *state, double *from, double *to);

/* As rb_rolling_model_solution, after a solve that began at `begun` (rb_seconds) and has ended with
 * status s, as far as there is a state; with status and time.  Returns the status of both. */
rb_status rb_rolling_end_solve(const rb_rolling_model *model, rb_status s, double begun,
                               rb_rolling_solution *solution, rb_message *why);
/* The solution without the residuals and temperatures, which stay 0, and the balance of the
 * support, which is NAN. */
rb_status rb_rolling_bare_solution(const rb_rolling_model *model, rb_rolling_solution *solution,
                                   rb_message *why);
/* Its temperatures, if it has such columns, and the highest.  RB_ENOMEM, RB_SINGULAR. */
rb_status rb_rolling_set_temperature(const rb_rolling_model *model, rb_rolling_solution *solution,
                                     rb_message *why);

/* Highest of the temperatures t of elements in contact, by a parabola through the warmest
 * one and its neighbours, and its place; NAN without contact.  x, zone, t: n. */
void rb_rolling_peak_temperature(int n, const double *x, const int *zone, const double *t,
                                 double *value, double *at);
void rb_rolling_conduction_free(struct rb_rolling_conduction *conduction);
rb_status rb_rolling_solution_heat(const rb_rolling_case *rc, const rb_rolling_solution *s,
                                   struct rb_rolling_conduction **conduction, double *t_a,
                                   double *t_b, double *heat_a, double *heat_b, rb_message *why);

/* What the tractions of a solved model displace, kept for all variants of the model; of is
 * borrowed. NULL without memory. */
typedef struct rb_rolling_perturbation rb_rolling_perturbation;
rb_rolling_perturbation *rb_rolling_perturbation_create(const rb_rolling_model *of);
void rb_rolling_perturbation_free(rb_rolling_perturbation *perturbation);

/* A variant of a solved model: a case that differs slightly from the model's in some
 * number, on the same elements, with the model's state and zones, to be completed.  If
 * the flexibility is the same, it is borrowed from the model.  RB_INACCURATE: the number
 * of elements outside the contact differs.  results: 0 if only the equations are needed.
 * own_bodies: 1: the variant has a compressed boundary of its own instead of the model's,
 * so that all variants have it compressed as closely.  perturbation: of the model: where bodies
 * that change leave their flexibility to it, the variant has their change under the tractions of
 * the model alone, which is exact to first order; NULL: they are built.  variant: overwritten; free
 * it in any case. */
rb_status rb_rolling_variant_create(const rb_rolling_model *of, const rb_rolling_case *rc,
                                    int results, int own_bodies,
                                    rb_rolling_perturbation *perturbation,
                                    rb_rolling_model *variant, rb_message *why);
/* 1: such a variant is built with flexibilities of its own. */
int rb_rolling_variant_builds(const rb_rolling_model *of, const rb_rolling_case *rc, int results);
/* A variant with the model's case on elements whose ends x are moved to shift + scale
 * x. */
rb_status rb_rolling_variant_move(const rb_rolling_model *of, rb_rolling_perturbation *perturbation,
                                  double shift, double scale, rb_rolling_model *variant,
                                  rb_message *why);
/* Gap and coefficients of friction on elements moved to shift + scale x, n values each, where the
 * irregularity has come this much further; friction that does not depend on the place alone stays
 * that of the model.  RB_ENOMEM. */
rb_status rb_rolling_variant_data(const rb_rolling_model *of, double shift, double scale,
                                  double further, double *gap, double *bound, rb_message *why);
/* A variant with another case on elements whose ends x are moved to shift + scale x.  The
 * flexibility is computed again if they move or the bodies differ. */
rb_status rb_rolling_variant_place(const rb_rolling_model *of, const rb_rolling_case *rc,
                                   double shift, double scale, rb_rolling_model *variant,
                                   rb_message *why);
/* 1: both cases have the same flexibility. */
int rb_rolling_same_bodies(const rb_rolling_case *x, const rb_rolling_case *y);
/* 1: the cases differ at most in friction and in given load, motion and force, which leave
 * mesh, bodies and all rows of the contact problem but its bounds as they are. */
int rb_rolling_same_rows(const rb_rolling_case *x, const rb_rolling_case *y);
/* A variant that is also solved, starting from the zones of the model. */
rb_status rb_rolling_variant_solve(const rb_rolling_model *of, const rb_rolling_case *rc,
                                   rb_rolling_model *variant, rb_message *why);
/* 1: a variant has as many elements as the model on each side of its wheels, not only as
 * many together: else the flexibility jumps between them. */
int rb_rolling_same_sides(const rb_rolling_model *of, const rb_rolling_model *variant);
/* 1: a boundary of the model is so fine that its matrix is compressed. */
int rb_rolling_is_compressed(const rb_rolling_model *model);
/* The model itself solved again, its boundaries compressed as closely as those of its
 * variants. */
rb_status rb_rolling_variant_closely(const rb_rolling_model *of, rb_rolling_model *variant,
                                     rb_message *why);
/* p0 of the model's state, MPa: the largest peak of all patches; 0 without contact. */
double rb_rolling_peak_pressure(const rb_rolling_model *model);
/* Compression of the layer, cover or rim of A and of B divided by its thickness: of each body
 * that by the approach and that by the pressure, the lesser of which holds; NAN: it has none.
 * max_strain is the larger one of both bodies. */
void rb_rolling_strains(const rb_rolling_case *rc, double approach, double pressure,
                        double strain[4]);
/* The model itself with a matrix of its own, if it has fewer than RB_ROLLING_LARGE
 * elements. */
rb_status rb_rolling_variant_with_matrix(const rb_rolling_model *of, rb_rolling_model *variant,
                                         rb_message *why);
/* What the case of a variant gives at the state of the model, if it differs at most in
 * friction and in given load, motion and force: all else stays, so that no variant is
 * needed.  bound: n, written; problem: overwritten, borrows bound and all rows of the
 * model.  0: the case differs in more. */
int rb_rolling_variant_given(const rb_rolling_model *of, const rb_rolling_case *rc, double *bound,
                             rb_contact_problem *problem, rb_status *status, rb_message *why);
void rb_rolling_variant_free(const rb_rolling_model *of, rb_rolling_model *variant);
/* Sets the state of a variant to that of its model plus `part` times `along` (NULL: 0):
 * p, q, delta and xi; zones are the model's. */
void rb_rolling_variant_set(const rb_contact_state *of, const rb_contact_state *along, double part,
                            rb_contact_state *variant);
/* Computes from them slip (0 in stick), friction coefficients and Hertz's half-width of
 * the variant.  gap, slip: n, of all elements; NULL: not wanted. */
rb_status rb_rolling_variant_complete(rb_rolling_model *variant, double *gap, double *slip,
                                      rb_message *why);

/* kappa (theory-rolling.md F3) of the state, for friction that depends on the state.  Above 1 a
 * single element, or a step, may have several solutions.  RB_ENOMEM. */
rb_status rb_rolling_law_kappa(const rb_rolling_model *model, double *kappa);
/* In steady rolling kappa is the largest of those of the elements: that of one, and the element
 * that has the largest; -1: none, or not steady. */
double rb_rolling_law_kappa_of(const rb_rolling_model *model, int element);
int rb_rolling_law_kappa_element(const rb_rolling_model *model);

/* What part of the coefficient that it had before it a particle keeps behind element i, of friction
 * with a memory (theory-rolling.md F2). */
double rb_rolling_law_kept(const rb_rolling_model *model, int i);

/* Several solutions of one steady case, ordered by decreasing force. */
typedef struct {
    int n;
    rb_rolling_solution *solution; /* the residual of each is computed; owned */
    int starts, failed; /* starts of the iteration that were tried, and those that did not
                           converge */
} rb_rolling_solutions;

/* Finds different solutions of a steady model with a given creepage under a friction law
 * that depends on the state: the model's solution, and those to which the iteration
 * converges on the model's mesh when slip is assumed behind a given place; up to 200
 * places are tried (theory-rolling.md F5).  Solutions to which it does not converge are not
 * found.  The model then holds the last state.  RB_EINVAL: other cases. all: overwritten;
 * free it in any case. */
rb_status rb_rolling_find_solutions(rb_rolling_model *model, rb_rolling_solutions *all,
                                    rb_message *why);
void rb_rolling_solutions_free(rb_rolling_solutions *all);

/* ---- Histories: static increments and transient rolling ---------------------------- */

/* The columns of a program and their names in tables. */
typedef struct {
    const char *name;
    const char *also; /* other names that people give it, "normal load|P"; NULL: none */
    const char *unit; /* in mm, N, MPa (rollbem/units.h) */
    size_t column;    /* offset of its pointer in rb_rolling_program */
    size_t value;     /* offset in rb_rolling_case of the value that it replaces; distance and
                         time: SIZE_MAX */
    int is_mean;      /* 1: a rolled step uses the mean over the step, 0: the value at its end
                       */
} rb_rolling_program_column;

enum { RB_ROLLING_PROGRAM_COLUMNS = 13 };
extern const rb_rolling_program_column rb_rolling_program_columns[RB_ROLLING_PROGRAM_COLUMNS];

/* The case that results of the program refer to; if the program has a column mu, its mu
 * is the largest value. */
rb_rolling_case rb_rolling_program_base(const rb_rolling_program *program,
                                        const rb_rolling_case *rc);

/* 1: the case, without a program, is a sequence of rolling steps or increments. */
int rb_rolling_has_steps(const rb_rolling_case *rc);
/* 1: a layer slides on its base (L9). */
static inline int rb_rolling_slides_on_base(const rb_rolling_case *rc)
{
    return rc->a.layer_base == RB_BASE_SMOOTH ||
           (rc->elastic_b && rc->b.layer_base == RB_BASE_SMOOTH);
}
/* 1: elements of a mesh that is not replaced by equal ones differ in length. */
static inline int rb_rolling_mesh_is_graded(const rb_rolling_case *rc)
{
    return rc->mesh == RB_MESH_FITTED || rc->mesh == RB_MESH_PUNCH;
}

/* The solutions of the steps of a history: n elements, `steps` states. */
typedef struct {
    const rb_rolling_program
        *program; /* the program of the history; NULL: the values of the case; borrowed */
    int n, steps;
    double *x, *h; /* n: midpoints and lengths [length]; owned, like all arrays here */
    double *p, *q, *lambda, *plastic; /* steps x n, one step after the other; plastic: the part of
                                         lambda that the interface yields */
    int *zone;
    int *substeps;     /* steps: in how many steps the row was computed */
    double *delta;     /* steps: approach */
    double *xi;        /* steps: rigid shift of a static step [length], creepage of a rolled step */
    double half_width; /* unit of the distances [length] */
    rb_rolling_rows rows; /* of its history */
} rb_rolling_states;

/* On RB_ENOMEM states is empty. */
rb_status rb_rolling_states_alloc(int n, int steps, rb_rolling_states *states);
/* Copies the state and the elements of the model after a step into states.  Step 0 begins with
 * new memory for all steps: a run that starts again may have other elements.  RB_ENOMEM. */
rb_status rb_rolling_states_keep(const rb_rolling_model *model, const rb_rolling_history *history,
                                 int step, int steps, rb_rolling_states *states);
/* Copies tractions, slip and its plastic part, zones, delta and xi of a step into a state of as
 * many elements; its status becomes RB_OK. */
void rb_rolling_states_get(const rb_rolling_states *states, int step, rb_contact_state *state);
void rb_rolling_states_free(rb_rolling_states *states);

/* Goes through the program of the given states without solving.  After each step the
 * model has the contact problem of the step, which depends on the earlier states, and the
 * given state with its residual; friction that depends on the state has the coefficients of
 * the given one.  Otherwise like rb_rolling_history_run.  RB_EINVAL: the number of steps
 * differs. */
rb_status rb_rolling_history_follow(const rb_rolling_case *rc, const rb_rolling_states *states,
                                    const rb_rolling_observer *observer, rb_rolling_model *model,
                                    rb_rolling_history *history, rb_message *why);

/* The same step by step, with states that the caller sets: opaque. */
typedef struct rb_rolling_follower rb_rolling_follower;

/* of: another follower, before its first step, whose bodies are borrowed where rc has the
 * same (NULL: none), and which lives longer; scale: of the elements of the states, which
 * are borrowed.  Free it in any case. */
rb_status rb_rolling_follower_create(const rb_rolling_case *rc, const rb_rolling_states *states,
                                     const rb_rolling_follower *of, double scale,
                                     rb_rolling_follower **follower, rb_message *why);
/* The model has the problem of the next step, with the past that the states before it
 * left. */
rb_status rb_rolling_follower_begin(rb_rolling_follower *follower, rb_message *why);
/* 1: the step that has begun is the last one of a row, whose state is among the given ones;
 * 0: it ends inside the row. */
int rb_rolling_follower_ends_row(const rb_rolling_follower *follower);
/* Whose state is to be set between begin and end; borrowed. */
rb_rolling_model *rb_rolling_follower_model(rb_rolling_follower *follower);
/* Solves the step, from the state that the model has, on the elements of the states. */
rb_status rb_rolling_follower_solve(rb_rolling_follower *follower, rb_message *why);
/* Takes the state that the model has, complete, as that of the step. */
void rb_rolling_follower_end(rb_rolling_follower *follower);
/* Of the steps so far; borrowed. */
const rb_rolling_history *rb_rolling_follower_history(const rb_rolling_follower *follower);
void rb_rolling_follower_free(rb_rolling_follower *follower);

/* ---- Wear -------------------------------------------------------------------------- */

/* As rb_rolling_wear_run, with error bars in history->errors: from n/2, 0.7 n and n elements, the
 * boundary outside, and half as many steps.  That of a pressure with a stick edge is NAN.  The
 * observer sees the run itself. */
rb_status rb_rolling_wear_with_errors(const rb_rolling_case *rc, const rb_rolling_wear *wear,
                                      const rb_rolling_wear_observer *observer,
                                      rb_rolling_wear_history *history, rb_rolling_solution *last,
                                      rb_message *why);
/* Converts from mm, N, MPa to other units; call it once only. */
void rb_rolling_wear_history_convert(rb_rolling_wear_history *history, rb_units units);

/* ---- Creep curves ------------------------------------------------------------------ */

/* Convert from mm, N, MPa to other units; call them once only.  The field `units` tells
 * the present units. */
void rb_rolling_solution_convert(rb_rolling_solution *s, rb_units units);
void rb_rolling_history_convert(rb_rolling_history *h, rb_units units);
void rb_rolling_curve_convert(rb_rolling_curve *c, rb_units units);

/* Sees the model at point k; its refusal ends the curve. */
typedef rb_status rb_rolling_point(const rb_rolling_model *model, int k, void *context,
                                   rb_message *why);
/* As rb_rolling_curve_solve, watched. */
rb_status rb_rolling_curve_observe(const rb_rolling_case *rc, const rb_rolling_range *range,
                                   rb_rolling_point *point, void *context, rb_rolling_curve *curve,
                                   rb_message *why);

/* ---- Subsurface stress of body A --------------------------------------------------- */

/* RB_EINVAL: the stress inside A cannot be computed, because A has a viscoelastic cover
 * on an elastic core. */
rb_status rb_rolling_stress_check(const rb_rolling_case *rc, rb_message *why);

/* The tractions p and q of a state, between n + 1 ends along the contact, as nodes between which
 * they are linear (B14): the midpoints of the elements, and close to the edges of patches more of
 * them, where the tractions fall like a power of the distance.  The first and the last node
 * carry nothing.  ends: those of the mesh, or along another line; p, q likewise.  edge_nodes:
 * from an edge on, RB_ROLLING_EDGE_NODES for the stress at the edge itself.  load: in `memory`.
 * RB_ENOMEM. */
enum { RB_ROLLING_EDGE_NODES = 32 };
rb_status rb_rolling_traction_nodes(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                    const struct rb_contact_state *state, const double *ends,
                                    const double *p, const double *q, int edge_nodes,
                                    rb_arena *memory, rb_bem_edge_load *load);

/* Height of A's surface at x: 0 for a half-plane. */
double rb_rolling_surface(const rb_rolling_case *rc, double x);

/* Tractions on A that are given: linear between nodes, two at one place are a jump. */
typedef struct rb_rolling_given {
    rb_bem_edge_load load; /* in memory */
    rb_arena memory;
} rb_rolling_given;
void rb_rolling_given_free(rb_rolling_given *given);
/* A model without bodies that solves nothing, for the stress below given tractions.  x: places of
 * n rows, linear between them and zero outside; s: its loads, its largest pressure, or friction
 * without one, as max_pressure, and half the loaded width.  RB_EFORMAT: the rows cannot be used.
 * Free the model in any case. */
rb_status rb_rolling_model_of_nodes(const rb_rolling_case *rc, int n, const double *x,
                                    const double *p, const double *q, rb_rolling_model *model,
                                    rb_rolling_solution *s, rb_message *why);
/* The same of the elements of a solved contact: midpoints, lengths, tractions and zones. */
rb_status rb_rolling_model_of_elements(const rb_rolling_case *rc, int n, const double *x,
                                       const double *h, const double *p, const double *q,
                                       const double *zone, rb_rolling_model *model,
                                       rb_rolling_solution *s, rb_message *why);
/* Rows of a table of tractions: nodes, or with h and zone elements; all borrowed. */
typedef struct {
    int n;
    const double *x, *p, *q, *h, *zone;
} rb_rolling_traction_rows;
/* By one of the two functions above. */
rb_status rb_rolling_model_of_rows(const rb_rolling_case *rc, const rb_rolling_traction_rows *rows,
                                   rb_rolling_model *model, rb_rolling_solution *s,
                                   rb_message *why);
/* The largest stresses leave out such a part of half the loaded width around jumps of friction. */
#define RB_ROLLING_LEFT_OUT 1e-3
/* The next place from node *k on where given friction jumps, so that sxx is unbounded at the
 * surface there; NAN: there is no more.  *k: set behind it. */
double rb_rolling_next_friction_jump(const rb_rolling_model *model, int *k);
/* Whether it jumps at this place. */
int rb_rolling_friction_jumps_at(const rb_rolling_model *model, double x);

/* "body", "layer", "base", "layer 1"; and back: -1 where it is none of them. */
enum { RB_ROLLING_PLACE = 24 };
const char *rb_rolling_place_name(rb_rolling_place place, char name[RB_ROLLING_PLACE]);
int rb_rolling_place_named(const char *name);

/* The k-th of them: those in the body, and then four of each bond; NULL: there are no more. */
rb_rolling_extremum *rb_rolling_maximum(rb_rolling_stress_maxima *maxima, int k);
/* Its value, part 0, or a coordinate of its place, 1 and 2, as a result, with the name of its bond.
 */
typedef struct {
    rb_rolling_result result;
    char name[40], meaning[60];
} rb_rolling_maximum_result;
const rb_rolling_result *rb_rolling_describe_maximum(int k, int part, int of_b,
                                                     rb_rolling_maximum_result *described);
double *rb_rolling_maximum_number(rb_rolling_stress_maxima *maxima, int k, int part);
/* 1: the name is that of a bond's number; sets which one it is. */
int rb_rolling_find_bond_number(const char *name, int *k, int *part, int *of_b);
/* NANs of so many bonds, in the place of nothing.  RB_ENOMEM. */
rb_status rb_rolling_stress_maxima_alloc(int bonds, rb_rolling_stress_maxima *maxima);
/* Of its bonds. */
void rb_rolling_errors_free(rb_rolling_errors *errors);

/* From mm, N, MPa to other units. */
void rb_rolling_stress_convert(int n, rb_rolling_stress *at, rb_rolling_stress_maxima *maxima,
                               rb_units units);

/* Computes the values again at the places and in the materials given in maxima.  RB_EINVAL:
 * a place lies outside A. */
rb_status rb_rolling_stress_maxima_at(const rb_rolling_model *model,
                                      rb_rolling_stress_maxima *maxima, rb_message *why);

/* inside[k] = 1 if point k lies in A or on its surface, so that rb_rolling_stress_at can
 * compute the stress there.  RB_ENOMEM. */
rb_status rb_rolling_inside(const rb_rolling_model *model, int n, const double *xy, int *inside);

/* Stress on a grid that follows A's surface, row by row; the first row is on the
 * surface.  Of a whole wheel: around it, x = 0 below the contact in the middle of the row. */
typedef struct {
    int nx, ny;
    rb_rolling_stress *at; /* nx x ny; stresses of points that are not inside are NAN; owned */
    int *inside;           /* nx x ny; owned */
} rb_rolling_stress_grid;

/* Sets the temperature of n points of A, or of B (y <= 0), under the heat of a solution in mm, N,
 * MPa; NAN where the case has none that it can know.  RB_ENOMEM, RB_EINVAL. */
rb_status rb_rolling_temperature_inside(const rb_rolling_case *rc, const rb_rolling_solution *s,
                                        int of_b, int n, rb_rolling_stress *at, rb_message *why);

/* Computes shear_yield and x again from the stress at the depth y and the given residual
 * stress. */
rb_status rb_rolling_shakedown_at(const rb_rolling_model *model, rb_rolling_shakedown *shakedown,
                                  rb_message *why);

/* Computes the stress on a grid over the same width and depth as the maxima; nx, ny >= 2; depth
 * INFINITY: of the whole wheel (RB_EINVAL: half-planes).  grid: overwritten. */
rb_status rb_rolling_stress_on_grid(const rb_rolling_model *model, int nx, int ny, double depth,
                                    rb_rolling_stress_grid *grid, rb_message *why);
void rb_rolling_stress_grid_free(rb_rolling_stress_grid *grid);

/* ---- Subsurface stress of body B --------------------------------------------------- */

/* Body B of a solved model as an upper body, mirrored at y = 0: `model` is one whose body A it
 * is, under the same pressure and the opposite friction, for the functions above.  Borrows the
 * model it is made of. */
typedef struct {
    rb_rolling_model model;
    rb_rolling_case rc;     /* that of the model, with exchanged bodies */
    double *q;              /* owned */
    rb_rolling_given given; /* likewise, of given tractions */
} rb_rolling_mirror;

/* RB_EINVAL: B is rigid, or its stress cannot be computed. */
rb_status rb_rolling_mirror_check(const rb_rolling_case *rc, rb_message *why);
rb_status rb_rolling_mirror_create(const rb_rolling_model *model, rb_rolling_mirror **mirror,
                                   rb_message *why);
void rb_rolling_mirror_free(rb_rolling_mirror *mirror);
/* From the image back to body B: y and sxy change their signs; maxima: NULL, or likewise. */
void rb_rolling_mirror_stress(int n, rb_rolling_stress *at, rb_rolling_stress_maxima *maxima);

/* Likewise of a grid, whose rows then begin with the deepest. */
void rb_rolling_mirror_grid(rb_rolling_stress_grid *grid);

/* As rb_rolling_stress_maxima_find, of body B. */
rb_status rb_rolling_stress_maxima_of_b(const rb_rolling_model *model, double depth,
                                        rb_rolling_stress_maxima *maxima, rb_message *why);

/* Solves a case on equal elements between from and to; the contact may lie anywhere in
 * between.  Of the mesh options of the case only contact_elements is used.  solution is
 * overwritten; free it in any case. */
rb_status rb_rolling_solve_between(const rb_rolling_case *rc, double from, double to,
                                   rb_rolling_solution *solution, rb_message *why);
/* The same for one step that starts from the tractions, friction coefficients and plastic
 * slip of the solution `before` on the same elements, in mm, N, MPa (NULL: no contact
 * before): rolling by `step` [length] (RB_TRANSIENT), or a shift or load at rest
 * (RB_STATIC, step 0). The iteration of a friction law starts from the coefficients
 * `start` (rb_rolling_plan), or from those before (NULL).  RB_EINVAL: steady rolling,
 * other elements, viscoelastic bodies, or temperatures. */
rb_status rb_rolling_step_between(const rb_rolling_case *rc, double from, double to,
                                  const rb_rolling_solution *before, const rb_rolling_table *start,
                                  double step, rb_rolling_solution *solution, rb_message *why);

/* ---- Error bars (theory-solvers.md 5.1) ---------------------------------------------------- */

/* Estimates the errors of a case that is already solved; solution: complete, in mm, N,
 * MPa.  stress, stress_b: its maxima in all of A and of B if error bars for them are wanted,
 * otherwise NULL.  Free the errors in any case. */
rb_status rb_rolling_estimate_errors(const rb_rolling_case *rc, const rb_rolling_solution *solution,
                                     const rb_rolling_stress_maxima *stress,
                                     const rb_rolling_stress_maxima *stress_b,
                                     rb_rolling_errors *errors, rb_message *why);

/* The number of coarser runs whose differences are the error bars: 2, with wheels 3. */
int rb_rolling_error_runs(const rb_rolling_case *rc);

/* Computes a curve and its errors: errors->force_ratio[k] and the other columns belong to
 * the k-th creepage; errors->residual has no meaning.  This takes twice as long as the
 * curve alone.  point (may be NULL) also sees the points of the coarser curves.  Free
 * both in any case. */
rb_status rb_rolling_curve_with_errors(const rb_rolling_case *rc, const rb_rolling_range *range,
                                       rb_rolling_point *point, void *context,
                                       rb_rolling_curve *curve, rb_rolling_curve *errors,
                                       rb_message *why);

/* Computes a history with history->errors (their residual has no meaning).  The coarser
 * runs also have longer steps, so that the errors include those of the step length.
 * After the main run the observer is called for the coarser runs with model and history
 * NULL.  Free model and history in any case. */
rb_status rb_rolling_history_with_errors(const rb_rolling_case *rc,
                                         const rb_rolling_program *program,
                                         const rb_rolling_observer *observer,
                                         rb_rolling_model *model, rb_rolling_history *history,
                                         rb_message *why);

/* The error bars of what fretting has done in the last cycle, NAN of all else.  0: there are none.
 */
int rb_rolling_errors_of_cycle(const rb_rolling_history *history, rb_rolling_errors *errors);

/* Peak memory in bytes that rb_rolling_solve needs; serves to refuse sizes that are too
 * large.  n: contact elements; boundary: boundary elements of one wheel (0: half-planes);
 * unknowns: size of Newton's last linear system, elements in contact plus sticking
 * elements, at most 2n. */
double rb_rolling_bytes(const rb_rolling_case *rc, int n, int boundary, int unknowns);

/* The same as rb_rolling_solve, but the model is kept for stresses or further solves;
 * free both in any case. */
rb_status rb_rolling_solve_model(const rb_rolling_case *rc, rb_rolling_model *model,
                                 rb_rolling_solution *solution, rb_message *why);
/* The same for a model that has been solved before, see rb_rolling_model_reuse. */
rb_status rb_rolling_solve_model_reuse(const rb_rolling_case *rc, rb_rolling_model *model,
                                       rb_rolling_solution *solution, rb_message *why);

/* ---- Parameter studies ----------------------------------------------------------- */

enum { RB_ROW_OWN = 128, RB_ROW_BONDS = 128 };

/* A number of a bond, by rb_rolling_maximum_number. */
typedef struct {
    int k, part, of_b;
} rb_rolling_bond_number;

/* The results of one case of a study: numbers only, no columns; NAN if a case has no such
 * result. */
typedef struct {
    rb_rolling_solution solution;              /* with the status of the case */
    rb_rolling_errors errors;                  /* NAN without RB_ROW_ERRORS */
    rb_rolling_stress_maxima stress, stress_b; /* without bonds; NAN without RB_ROW_STRESS, ..._B */
    double bond[RB_ROW_BONDS], bond_error[RB_ROW_BONDS]; /* what the sweep names; otherwise NAN */
    double own[RB_ROW_OWN];     /* values computed by `measure` of the sweep; otherwise NAN */
    rb_rolling_row_notes notes; /* in the units of the sweep */
} rb_rolling_row;

/* bits of rb_rolling_sweep.also */
enum { RB_ROW_ERRORS = 1, RB_ROW_STRESS = 2, RB_ROW_STRESS_B = 4 };

/* From mm, N, MPa to other units. */
void rb_rolling_row_convert(rb_rolling_row *row, rb_units units);

/* A study of the cases first ... first + count - 1, solved by processes of this machine
 * (0: as many as it has processors), one thread each.  `make` makes case k and `measure`
 * computes row->own; both run in these processes.  `see` and `tick` run in the calling
 * process: `see` receives the rows in order, `tick` is called every few milliseconds with
 * the number of rows passed to `see`; a return value other than 0 ends the study.  A
 * process that crashes is replaced and its case is tried once more; if it crashes again,
 * the case gets RB_ENOMEM. */
typedef struct {
    int first, count, workers;
    unsigned also; /* what to compute besides the solution: bits RB_ROW_... */
    int bonds;     /* numbers of bonds, which need RB_ROW_STRESS or ..._B */
    const rb_rolling_bond_number *bond;
    rb_units units; /* of what notes say */
    rb_status (*make)(int k, rb_rolling_case *rc, void *context);
    /* The history of the case that `make` made last, or NULL: the row has the results behind its
     * last row, and of errors those of the cycle; `measure` is not called.  NULL: no case has one.
     */
    const rb_rolling_program *(*program)(void *context);
    /* own: row->own of the case that `make` made last; model: its solved model; may be
     * NULL */
    rb_status (*measure)(const rb_rolling_model *model, double *own, void *context,
                         rb_message *why);
    /* NULL, or in the place of all that: solves case k, of which row has no numbers yet,
     * and returns its status */
    rb_status (*solve)(int k, rb_rolling_row *row, void *context, rb_message *why);
    int (*see)(int k, const rb_rolling_row *row, void *context);
    int (*tick)(int finished, void *context); /* or NULL */
    void *context;
} rb_rolling_sweep;

/* Solves case k in the calling process in the same way as a process of the study does.
 * why: the reason if the case is not solved, see row->solution.status. */
void rb_rolling_sweep_case(const rb_rolling_sweep *sweep, int k, rb_rolling_row *row,
                           rb_message *why);
/* Runs the study.  RB_INTERRUPTED: `see` or `tick` ended it.  In any case no process is
 * left running. */
rb_status rb_rolling_sweep_run(const rb_rolling_sweep *sweep, rb_message *why);

/* A pool of worker processes, as seen by the process that distributes the cases. */
typedef struct rb_rolling_pool {
    int (*idle)(
        struct rb_rolling_pool *pool); /* number of further cases that the pool accepts now */
    rb_status (*submit)(struct rb_rolling_pool *pool,
                        int k); /* submits case k; idle() must be > 0 */
    /* 1: case *k is done, and row is written; 0: no case was done within the given
     * milliseconds; a negative status: the pool has failed. */
    int (*collect)(struct rb_rolling_pool *pool, int milliseconds, int *k, rb_rolling_row *row);
    void (*stop)(struct rb_rolling_pool *pool); /* ends all processes at once and frees the pool */
} rb_rolling_pool;

/* Starts the pool of rb_rolling_sweep_run: sweep->workers processes, at most
 * sweep->count.  sweep is borrowed. */
rb_status rb_rolling_pool_start(const rb_rolling_sweep *sweep, rb_rolling_pool **pool,
                                rb_message *why);
/* The same as rb_rolling_sweep_run with a given pool; the pool is stopped in any case. */
rb_status rb_rolling_sweep_by(const rb_rolling_sweep *sweep, rb_rolling_pool *pool,
                              rb_message *why);

/* rb_contact_prove of the state of a model.  Where its friction depends on the state, the
 * coefficients are those with which the iteration has ended: unique is "fixed friction". */
rb_status rb_rolling_model_prove(const rb_rolling_model *model, rb_contact_proof *proof,
                                 rb_message *why);

#endif
