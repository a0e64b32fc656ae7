/* The solvers of this folder for the contact problems of rollbem/contact.h. */
#include "lcp/contact/contact.h"
#include "lcp/friction/friction.h"

#include <stdlib.h>

rb_friction_problem rb_friction_of_cone(const rb_contact_cone *cone)
{
    return (rb_friction_problem){.form = RB_FRICTION_LOCAL_DENSE,
                                 .dimension = 2,
                                 .contacts = cone->n,
                                 .mu = cone->mu,
                                 .W = cone->W,
                                 .q = cone->q};
}

static rb_status solve_cone(const char *name, const rb_contact_cone *cone, double tol, double *r,
                            int *iterations, rb_message *why)
{
    const rb_friction_problem problem = rb_friction_of_cone(cone);
    rb_friction_options options = rb_friction_defaults();
    rb_friction_info info;
    double *u = rb_alloc(2 * (size_t)cone->n, 1);

    if (!u)
        return RB_ENOMEM;
    options.tol = tol;
    const rb_friction_solution solution = {r, u, NULL};
    const rb_status s = rb_friction_solve(name, &problem, &options, &solution, &info);
    if (s != RB_OK)
        rb_fail(why, s, "%s: %.240s", name, rb_status_reason(s, &info.msg));
    *iterations += info.iters;
    free(u);
    return s;
}

rb_contact_cone_solver rb_friction_cone_solver(const char *name)
{
    return (rb_contact_cone_solver){name, rb_friction_solver_named(name) ? solve_cone : NULL};
}
