/* The mesh of a cylinder in parts: graded sides (grading.c), the inner contour (inner_contour.c),
 * all of it (cylinder.c); not installed. */
#ifndef ROLLBEM_BEM_MESH_CYLINDER_H
#define ROLLBEM_BEM_MESH_CYLINDER_H

#include "bem/boundary.h"

#include <math.h>

/* ---- grading.c ------------------------------------------------------------------ */

/* Beside the contact lies one element on each side: the upstream one on the right and its
 * mirror image on the left.  From there to the top each side is graded: at the distance
 * s, an angle, elements have the size h(s) = min(h0 + g s, cap, e0 + f (S - s)), so that
 * N(s) = int ds/h = ln(1 + g s/h0)/g while they grow, linear where they have their largest size
 * and the mirror image of the first towards a clamped arc at S that is small; elements lie
 * between, and ends are where N is a multiple of N(total)/elements.  Both sides count angles from
 * the lowest point as positive: symmetric ends make a symmetric mesh. */
typedef struct {
    double from;     /* angle at which the element beside the contact ends */
    double h0;       /* size of that element */
    double growth;   /* g; negative where the cap is below h0 */
    double cap;      /* largest size */
    double clamped;  /* S at which the clamped arc starts; the top where there is none */
    double e0, fall; /* size beside a small arc and f; e0 = 0: the arc has elements of the cap */
    int free_n, arc_n;
} rb_side;

#define RB_GROWTH 0.15 /* neighbours differ by at most a fifth */
#define RB_LARGEST_ANGLE (2.0 * 3.14159265358979323846 / 72.0)
/* What is finer, a thin rim, would need the whole circle as fine. */
#define RB_SMALLEST_FEATURE 0.003

double rb_side_length(const rb_side *side);
/* Elements that the grading asks for, not a whole number. */
double rb_side_elements(const rb_side *side);
/* Whole numbers of elements on the free and on the clamped part: as many as the grading asks for,
 * or `all` together. */
void rb_side_count(rb_side *side, int all);
/* Angle of end k, k = 0 ... free_n + arc_n, counted from the contact. */
double rb_side_end(const rb_side *side, int k);
/* Rounded, where x.5 is as likely as any other: arcs and sides that are alike have it, and
 * whichever way the last digit of an end has gone, there are as many elements. */
int rb_whole(double elements);

/* A thin wall, of a cover or of the rim around a large hub: what happens in it has died down some
 * thicknesses beside the contact, so that its elements may grow from there. */
int rb_cylinder_is_thin(const rb_bem_cylinder *cylinder);
double rb_cylinder_thickness(const rb_bem_cylinder *cylinder);
/* Factor on the number of elements. */
double rb_cylinder_refinement(const rb_bem_cylinder *cylinder);
/* Radius of the rigid core, or of the core under a cover. */
double rb_cylinder_inner_radius(const rb_bem_cylinder *cylinder);
/* Angle of the largest elements. */
double rb_cylinder_largest_size(const rb_bem_cylinder *cylinder);

/* ---- inner_contour.c ------------------------------------------------------------ */

/* n elements, equal ones around a hub.  Of a thin wall equal elements under the contact, from angle
 * low to high, and graded sides; otherwise middle_n = 0. */
typedef struct {
    int n, middle_n;
    double low, high;
    rb_side right, left;
} rb_inner_layout;

/* finer: the factor by which the outer elements are more than the automatic ones. */
void rb_inner_lay_out(const rb_bem_cylinder *cylinder, int n_c, const double *ends, double finer,
                      rb_inner_layout *inner);
/* Its elements from `first` on, clockwise: the body, of radius R, lies outside. */
void rb_inner_place(double R, double r, const rb_inner_layout *inner, int first, rb_bem_mesh *mesh);

typedef struct {
    double x, y;
} rb_point;
static inline void rb_place(rb_bem_mesh *mesh, int j, rb_point from, rb_point to,
                            rb_bem_condition type)
{
    mesh->x0[j] = from.x;
    mesh->y0[j] = from.y;
    mesh->x1[j] = to.x;
    mesh->y1[j] = to.y;
    mesh->condition[2 * j] = mesh->condition[2 * j + 1] = type;
}

#endif
