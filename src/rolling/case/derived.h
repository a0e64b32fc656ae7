/* What follows from a case without solving it: which formulas hold, lengths, loads, sizes. */
#ifndef ROLLBEM_ROLLING_CASE_DERIVED_H
#define ROLLBEM_ROLLING_CASE_DERIVED_H

#include "bem/boundary.h"
#include "rolling/case/inputs.h"

/* The most of each that a case may ask for: elements of the contact and on the circle outside
 * it, steps of a history, points of a curve. */
enum {
    RB_ROLLING_MOST_ELEMENTS = 1 << 24,
    RB_ROLLING_MOST_OUTER = RB_BEM_MOST_ELEMENTS,
    RB_ROLLING_MOST_STEPS = 10000000,
    RB_ROLLING_MOST_POINTS = 1000000
};

/* ---- What applies to a case ----------------------------------------------------- */

/* The largest coefficient of the friction law; it is the mu of Q/(mu P) and of xi R/(mu
 * a). */
double rb_rolling_largest_mu(const rb_rolling_case *rc);
/* The largest coefficient times Dundurs' constant of both bodies: from 1 on the contact may have
 * several solutions, or an open element beside each closed one. */
double rb_rolling_mu_beta(const rb_rolling_case *rc);
/* 1 if the coefficients depend on the solution, so that they have to be iterated: in
 * rolling, if the law depends on the slip velocity or on the temperature. */
int rb_rolling_law_depends_on_state(const rb_rolling_case *rc);

/* 1 if Carter's law applies: steady rolling of similar homogeneous half-planes whose gap
 * is not a table. */
int rb_rolling_carter_holds(const rb_rolling_case *rc);
/* The same for Cattaneo's, of contact at rest: one step. */
int rb_rolling_cattaneo_holds(const rb_rolling_case *rc);
/* 1: pressure displaces the surfaces along each other, and friction apart: the bodies are unlike,
 * and tractions have other exponents at the edges than the square root (E1). */
int rb_rolling_couples(const rb_rolling_case *rc);
/* 1: a body of the case is viscoelastic. */
int rb_rolling_relaxes(const rb_rolling_case *rc);

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

/* The number of elements from which Fourier transforms are faster than a matrix, and whether the
 * case can be solved by them. */
static inline int rb_rolling_transforms_from(const rb_rolling_case *rc)
{
    return rc->mesh == RB_MESH_FITTED     ? RB_ROLLING_TRANSFORMS_FITTED
           : rc->formulation != RB_STEADY ? RB_ROLLING_TRANSFORMS_STEPS
           : rc->mesh == RB_MESH_ALIGNED  ? RB_ROLLING_TRANSFORMS_ALIGNED
                                          : RB_ROLLING_TRANSFORMS;
}
int rb_rolling_can_transform(const rb_rolling_case *rc);
/* 1 if the mesh has so many equal elements that it is solved by Fourier transforms,
 * without a matrix. */
static inline int rb_rolling_is_large(const rb_rolling_case *rc, const rb_rolling_mesh *mesh)
{
    return mesh->n >= rb_rolling_transforms_from(rc) && rb_rolling_can_transform(rc);
}
/* The same for a build that has Fourier transforms: the page has none, and takes the same
 * elements. */
int rb_rolling_suits_large(const rb_rolling_case *rc, const rb_rolling_mesh *mesh);

/* ---- Lengths and loads ---------------------------------------------------------- */

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

/* 1: a body has a finite thickness: a layer, a cover or a wheel on a hub. */
int rb_rolling_has_thickness(const rb_rolling_case *rc);
/* The larger radius of A and B; A's if B is a plane. */
double rb_rolling_larger_radius(const rb_rolling_case *rc);

/* Compression of the layer, cover or rim of A and of B divided by its thickness: of each body
 * that by the approach and that by the pressure, the lesser of which holds; NAN: it has none.
 * max_strain is the larger one of both bodies. */
void rb_rolling_strains(const rb_rolling_case *rc, double approach, double pressure,
                        double strain[4]);

/* ---- Cases made of it ----------------------------------------------------------- */

/* The plan with the values of the case; functions that get plan NULL use it. */
rb_rolling_plan rb_rolling_plan_of(const rb_rolling_case *rc);

/* The case that rolls without a force. */
rb_rolling_case rb_rolling_without_force(const rb_rolling_case *rc);

/* RB_EINVAL unless squares and products of what is given are numbers, too: a size
 * of 1e-100 to 1e100.  what: the option; 0 is no size. */
rb_status rb_rolling_check_size(const char *what, double value, rb_message *why);

#endif
