/* The model of a case: mesh, bodies, contact problem and its state. */
#ifndef ROLLBEM_ROLLING_SOLVE_MODEL_H
#define ROLLBEM_ROLLING_SOLVE_MODEL_H

#include "lcp/contact/contact.h"
#include "rolling/body/gap.h"

/* Private members of rb_rolling_model; what pointers point to is owned:
 *
 * varies                in a history: columns of the program, rb_rolling_program_varies
 * first_from, first_to  ends of the equal elements with which the search for the edges began; the
 *                       same value twice: none [length]
 * follows               1: friction and creepage are, until the next solve, those of the case on
 *                       other elements
 * same_bodies           1: `bodies` need not be built again for `rc` on the same mesh
 * carried               state variables of the friction law and of the interface, n each:
 *   temperature         of both surfaces after a rolled step; NULL: not computed
 *   yielded             accumulated plastic slip of the interface before the last step, at the
 *                       places where the particles were then [length]; NULL: zero
 *   mu                  friction coefficients of the particles before the step; NULL: those at
 *                       rest; borrowed, like heat
 *   heat                of the earlier steps; NULL: none
 * conduction            how heat warms these elements, kept from round to round of a friction law;
 *                       NULL: not known yet
 * cycle                 what fretting has done so far in the last cycle of its history; NULL: not
 *                       asked for
 * given                 tractions that were given instead of solved for; NULL: those of the state
 * far                   what the rest of wheels adds, while only the edges of the contact are
 *                       searched for; NULL: bodies have systems
 * freely                solved free rolling of the same case, if it was computed on elements of its
 *                       own; otherwise NULL */

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

/* Peak memory in bytes that rb_rolling_solve needs; serves to refuse sizes that are too
 * large.  n: contact elements; boundary: boundary elements of one wheel (0: half-planes);
 * unknowns: size of Newton's last linear system, elements in contact plus sticking
 * elements, at most 2n. */
double rb_rolling_bytes(const rb_rolling_case *rc, int n, int boundary, int unknowns);

/* ---- What the state says -------------------------------------------------------- */

/* P and Q of the state. */
double rb_rolling_model_load(const rb_rolling_model *model);
double rb_rolling_model_force(const rb_rolling_model *model);
/* Q divided by the maximum friction force mu P; NAN without friction or load. */
double rb_rolling_force_ratio(const rb_rolling_model *model);

/* The outer edges of all patches; NAN without contact. */
void rb_rolling_contact_edges(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                              const rb_contact_state *state, double *from, double *to);

/* p0 of the model's state, MPa: the largest peak of all patches; 0 without contact. */
double rb_rolling_peak_pressure(const rb_rolling_model *model);

#endif
