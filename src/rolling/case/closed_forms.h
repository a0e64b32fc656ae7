/* Closed forms of plane contact on half-planes (theory-solvers.md 6): `rollbem verify`, the tests
 * and the pictures compare results with them.  1/E* = sum (1 - nu^2)/E; loads per unit
 * length. References: Johnson, Contact Mechanics (1985), chapters 4, 7, 8; Bentall and
 * Johnson, Int. J. Mech. Sci. 9 (1967) 389-404. */
#ifndef ROLLBEM_CLOSED_FORMS_H
#define ROLLBEM_CLOSED_FORMS_H

#include "base/base.h"

/* ---- Hertz ------------------------------------------------------------------------ */

/* Half-width a of Hertz's contact, from P = pi E* a^2/(4R) [length]. */
double rb_closed_hertz_half_width(double load, double radius, double modulus);
double rb_closed_hertz_load(double half_width, double radius, double modulus);
/* The load of a circular profile instead of the parabola: E* R (K(a/R) - E(a/R)), with
 * complete elliptic integrals of the modulus a/R <= 1.  The function is odd in R.  For a
 * cylinder in a bore add the values of both radii, R > 0 and R < 0. */
double rb_closed_circle_load(double half_width, double radius, double modulus);
/* p0 = 2P/(pi a) [stress]. */
double rb_closed_hertz_max_pressure(double load, double half_width);
/* p0 sqrt(1 - x^2/a^2), 0 outside. */
double rb_closed_hertz_pressure(double max_pressure, double half_width, double x);
/* Approach of a half-cylinder of plane-strain modulus E/(1 - nu^2) under a Hertzian
 * pressure: P(1-nu^2)/(pi E) [2 ln(4R/a) - 1] [length]. */
double rb_closed_half_cylinder_approach(double load, double radius, double plane_modulus,
                                        double half_width);

/* ---- Steady rolling of similar cylinders (Carter) ---------------------------------- */

/* s = xi R/(mu a) with the sign of xi; Q/(mu P) = -sgn(s) |s| (2 - |s|), -sgn(s) beyond
 * full sliding. */
double rb_closed_carter_force_ratio(double s);
/* The creep ratio s at a given Q/(mu P) in [-1, 1]. */
double rb_closed_carter_creep_ratio(double force_ratio);
/* Traction on A at x; the stick strip adjoins the leading edge +a [stress]. */
double rb_closed_carter_traction(double mu, double max_pressure, double half_width, double s,
                                 double x);

/* Maximum temperature rise of the surfaces for the heat flux H0 sqrt(1 - x^2/a^2) at a
 * high Peclet number, 2.1883067 H0 sqrt(a)/((e1 + e2) sqrt(pi V)), at x = -0.65223 a;
 * effusivity: e1 + e2, e = sqrt(conductivity heat capacity). */
double rb_closed_flash_temperature(double heat, double half_width, double speed, double effusivity);

/* Elastic shakedown limit p0/k of a line contact that slides fully with Q = friction P
 * (Johnson): 1/max|sxy| below the surface, at most 1/friction. */
double rb_closed_shakedown_limit(double friction);

/* ---- Tangential load without rolling (Cattaneo, Mindlin) --------------------------- */

/* c/a = sqrt(1 - |Q|/(mu P)): half-width of the centred stick strip. */
double rb_closed_cattaneo_stick(double force_ratio);
double rb_closed_cattaneo_traction(double mu, double max_pressure, double half_width,
                                   double force_ratio, double x);

/* What partial slip wears after many cycles, where c = a times `stick` sticks in each and the rest
 * unloads (theory.md 4.9), R/a^2 = 1: volume V R/a^3 of both bodies, largest depth R/a^2, and
 * p(0)/p0. */
typedef struct {
    double volume, depth, mid_pressure;
} rb_closed_worn;

rb_closed_worn rb_closed_worn_limit(double stick);

/* ---- Dissimilar cylinders under a growing load (Spence) ---------------------------- */

/* The mu for which the fraction c/a = `stick`, in (0, 1), of the contact sticks at every
 * load: beta/mu = K(sqrt(1 - c^2/a^2))/K(c/a), K the complete elliptic integral, for
 * small beta and mu, where friction does not change the pressure.  NAN if stick is
 * outside (0, 1). */
double rb_closed_spence_friction(double beta, double stick);

/* ---- Free rolling of dissimilar cylinders (Bentall, Johnson) ----------------------- */

/* |xi| at Q = 0 for mu -> 0: 2 beta (a/R) k, k = 0.457386; a: Hertz's half-width. */
double rb_closed_bentall_johnson_slip(double beta, double half_width, double radius);

/* Free rolling for mu -> infinity, where the whole contact sticks. */
typedef struct {
    double eta;          /* ln((1+beta)/(1-beta))/(2 pi) */
    double half_width;   /* [length] */
    double creepage;     /* |xi| */
    double mid_pressure; /* p(0) [stress] */
} rb_closed_bentall_johnson;

rb_closed_bentall_johnson rb_closed_bentall_johnson_stick(double beta, double hertz_half_width,
                                                          double radius, double modulus);

#endif
