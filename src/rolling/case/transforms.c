/* Whether a case is solved without matrices: displacements by Fourier transforms, for bodies whose
 * response depends on the distance alone. */
#include "rolling/body/internal.h"
#include "rolling/case/internal.h"

/* The page has none: its rule of the Makefile says 0. */
#ifndef RB_TRANSFORMS
#define RB_TRANSFORMS 1
#endif

/* Beside a wheel, a half-plane of one elastic material only. */
static int is_transformed(const rb_rolling_case *rc, const rb_rolling_body *body)
{
    const rb_rolling_body_kind *kind = rb_rolling_kind_of(body);
    return kind->transforms &&
           (kind->transformed
                ? kind->transformed(rc, body)
                : rb_rolling_can(rc, RB_BODY_FLAT) ||
                      rb_rolling_body_can(body, RB_BODY_HOMOGENEOUS | RB_BODY_ELASTIC));
}

/* Elements of any lengths, in one step.
 * From mu beta = 1 on many steps of Newton fail, and those of Lemke want a matrix. */
static int suits_fitted_products(const rb_rolling_case *rc)
{
    return rc->formulation != RB_TRANSIENT && !rb_rolling_has_steps(rc) &&
           rc->slip_operator == RB_SLIP_UPSTREAM && rc->yield_stress == 0.0 &&
           rb_rolling_mu_beta(rc) < 1.0;
}

static int suits_transforms(const rb_rolling_case *rc)
{
    return (rc->contact.solver == RB_SOLVER_AUTO || rc->contact.solver == RB_SOLVER_NEWTON) &&
           (!rb_rolling_mesh_is_graded(rc) || suits_fitted_products(rc)) &&
           is_transformed(rc, &rc->a) && (!rc->elastic_b || is_transformed(rc, &rc->b)) &&
           !(rc->period > 0.0 && (rc->a.layer > 0.0 || (rc->elastic_b && rc->b.layer > 0.0)));
}

int rb_rolling_has_transforms(const rb_rolling_case *rc)
{
    return RB_TRANSFORMS && !rb_rolling_mesh_is_graded(rc) && suits_transforms(rc);
}

int rb_rolling_suits_large(const rb_rolling_case *rc, const rb_rolling_mesh *mesh)
{
    return mesh->n >= rb_rolling_transforms_from(rc) && suits_transforms(rc);
}

int rb_rolling_can_transform(const rb_rolling_case *rc)
{
    return RB_TRANSFORMS && suits_transforms(rc);
}
