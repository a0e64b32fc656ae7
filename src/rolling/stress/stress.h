/* The stress below the surface of A and of B. */
#ifndef ROLLBEM_ROLLING_STRESS_STRESS_H
#define ROLLBEM_ROLLING_STRESS_STRESS_H

#include "bem/bem.h"
#include "rolling/solve/given_tractions.h"
#include "rolling/results/results.h"

/* ---- Body A --------------------------------------------------------------------- */

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

/* ---- Largest stresses ----------------------------------------------------------- */

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

/* From mm, N, MPa to other units. */
void rb_rolling_stress_convert(int n, rb_rolling_stress *at, rb_rolling_stress_maxima *maxima,
                               rb_units units);

/* Computes the values again at the places and in the materials given in maxima.  RB_EINVAL:
 * a place lies outside A. */
rb_status rb_rolling_stress_maxima_at(const rb_rolling_model *model,
                                      rb_rolling_stress_maxima *maxima, rb_message *why);

/* ---- At points and on grids ----------------------------------------------------- */

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

/* Shakedown of A, a half-plane under repeated rolling (theory-bodies.md S1): the yield stress in
 * shear k at which it just shakes down to elastic behaviour, the place that decides, and
 * the residual stress along x that rolling leaves there. */
typedef struct {
    double shear_yield; /* k [stress]; p0/k is 4 under Hertz's pressure without friction */
    double x, y;
    double residual; /* [stress] */
} rb_rolling_shakedown;

/* RB_EINVAL: a wheel, a layer; RB_NO_CONTACT, RB_ENOMEM. */
rb_status rb_rolling_shakedown_find(const rb_rolling_model *model, rb_rolling_shakedown *shakedown,
                                    rb_message *why);

/* Computes shear_yield and x again from the stress at the depth y and the given residual
 * stress. */
rb_status rb_rolling_shakedown_at(const rb_rolling_model *model, rb_rolling_shakedown *shakedown,
                                  rb_message *why);

/* Computes the stress on a grid over the same width and depth as the maxima; nx, ny >= 2; depth
 * INFINITY: of the whole wheel (RB_EINVAL: half-planes).  grid: overwritten. */
rb_status rb_rolling_stress_on_grid(const rb_rolling_model *model, int nx, int ny, double depth,
                                    rb_rolling_stress_grid *grid, rb_message *why);
void rb_rolling_stress_grid_free(rb_rolling_stress_grid *grid);

/* ---- Body B --------------------------------------------------------------------- */

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

#endif
