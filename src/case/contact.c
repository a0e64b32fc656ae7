/* What a case of CONTACT means here.  Signs: docs/contact.md. */
#include "rollbem/case.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Adds a clause to what is left out. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static void
leave_out(rb_case_contact *c, const char *format, ...)
{
    char clause[160];
    va_list args;
    va_start(args, format);
    vsnprintf(clause, sizeof clause, format, args);
    va_end(args);
    rb_append(c->left_out, sizeof c->left_out, "%s%s", c->left_out[0] ? "; " : "",
              clause);
}

/* 1: what makes the case another one, so that it is not run. */
static int is_outside(rb_case_contact *c, const rb_io_contact_case *in)
{
    const rb_io_contact_digits *d = &in->digit;
    if (in->module != 3)
        leave_out(c, "module %d (module 3 alone is read)", in->module);
    else if (in->potential < 0)
        leave_out(c, "Hertzian input (IPOTCN = %d)", in->potential);
    else if (in->my > 1)
        leave_out(c, "three dimensions (MY = %d rows of elements)", in->my);
    else if (in->base != 1 && in->base != 2)
        leave_out(c, "IBASE = %d (1 and 2 are read)", in->base);
    else if (in->base == 1 && !(in->b[0] > 0.0))
        leave_out(c, "a gap without curvature (B1 = %g)", in->b[0]);
    else if (d->T == 2)
        leave_out(c, "transient rolling that goes on from the case before (T = 2)");
    else if (d->T == 1 && d->P == 0)
        leave_out(c, "a shift that goes on from the case before (P = 0)");
    else if (d->B != 0)
        leave_out(c, "approximate pressure (B = %d)", d->B);
    else
        return 0;
    return 1;
}

/* The friction laws L = 2, 3, 4. */
static int falls(const rb_io_contact_case *in)
{
    return in->law >= 2 && in->law <= 4;
}

/* What CONTACT has in a case that is run, and this program has not. */
static void list_left_out(rb_case_contact *c, const rb_io_contact_case *in)
{
    static const char *const materials[] = {
        "", "", "the flexibility of the simplified theory", "that of Fastsim"};
    const rb_io_contact_digits *d = &in->digit;
    if (in->fstat != in->fkin && d->T > 0 && !falls(in))
        leave_out(c, "another friction law (L = %d): mu = %g, its value at rest", in->law,
                  in->fstat);
    if (d->M > 1 && d->M != 4)
        leave_out(c, "%s (M = %d)", d->M < 4 ? materials[d->M] : "the material", d->M);
    if (d->T > 0 && (in->side != 0.0 || in->spin != 0.0))
        leave_out(c, "CETA, FY and CPHI");
    if (d->T == 3 && fabs(in->dq / in->dx - 1.0) > 0.01)
        leave_out(c, "the step DQ = %g: slip is that over an element, DX = %g", in->dq,
                  in->dx);
    if (in->plan > 1)
        leave_out(c, "the planform (IPLAN = %d)", in->plan);
    if (d->H > 0)
        leave_out(c, "temperatures (H = %d)", d->H);
    if (d->E > 1)
        leave_out(c, "the rigid slip per element (E = %d)", d->E);
}

/* A strip as wide as DY, whose ends the half-space holds: w_N = 0 at the depth DY, as in
 * the plane, but w_T at DY exp(nu/(1 - nu)), because Cerruti's displacement
 * (1 - nu)/r + nu x^2/r^3 has a second part. */
static rb_rolling_body body_of(const rb_io_contact_case *in, int k)
{
    const double nu = in->poisson[k];
    rb_rolling_body body = {.young = 2.0 * in->shear[k] * (1.0 + nu),
                            .poisson = nu,
                            .radius = INFINITY,
                            .support = RB_BEM_HALFPLANE,
                            .datum = in->dy,
                            .datum_tangential = in->dy * exp(nu / (1.0 - nu))};
    if (in->digit.M != 1 || in->ratio[k] == 0.0)
        return body;
    if (in->time[k] > 0.0)
        body.memory = (rb_rolling_memory){1, {in->time[k]}, {in->ratio[k]}};
    else
        body.young /= 1.0 + in->ratio[k]; /* it relaxes at once */
    return body;
}

/* Parabola or circle; where its lowest point is. */
static double set_gap(const rb_io_contact_case *in, rb_rolling_case *rc)
{
    rc->gap = in->base == 2 ? RB_GAP_EXACT : RB_GAP_PARABOLA;
    rc->a.radius = in->base == 2 ? in->radius : 0.5 / in->b[0];
    return in->base == 2 ? in->centre : 0.0 - 0.5 * in->b[3] / in->b[0]; /* no -0 */
}

static void set_friction(const rb_io_contact_case *in, rb_rolling_case *rc)
{
    static const rb_rolling_friction_law laws[] = {
        RB_FRICTION_linear, RB_FRICTION_rational, RB_FRICTION_exponential};

    rc->mu = in->digit.T == 0 ? 0.0 : in->fstat;
    if (in->digit.T == 0 || !falls(in))
        return;
    rc->mu = in->fkin;
    rc->speed = in->velocity;
    rc->friction =
        (rb_rolling_friction){.law = laws[in->law - 2],
                              .fall = {in->fall[0], in->fall[1]},
                              .slip_scale = {in->slip_scale[0], in->slip_scale[1]},
                              .memory = in->memory,
                              .memory_slip = in->memory > 0.0 ? in->memory_slip : 0.0};
}

/* T = 1: CKSI is a distance; F > 0: FX is a part of FSTAT FN. */
static void set_loading(const rb_io_contact_case *in, double sign, rb_rolling_case *rc)
{
    const double tangential = sign * in->tangential;
    rc->formulation = in->digit.T == 3 ? RB_STEADY : RB_STATIC;
    if (in->digit.N == 1)
        rc->load = in->normal / in->dy;
    else
        rc->approach = in->normal;
    if (in->digit.T == 0)
        rc->shift = 0.0;
    else if (in->digit.F > 0)
        rc->force_ratio = tangential;
    else if (in->digit.T == 3)
        rc->creep = tangential;
    else
        rc->shift = tangential;
}

/* M = 4: a layer that gives way by LAYTHK/GG3 and yields at TAU_C0, which neither 0 nor
 * more than 1e10 does. */
static void set_layer(const rb_io_contact_case *in, rb_rolling_case *rc)
{
    if (in->digit.M != 4)
        return;
    if (in->layer != 0.0)
        rc->interlayer_tangential = in->layer / in->layer_shear;
    rc->yield_stress = in->yield > 1e10 ? 0.0 : in->yield;
    rc->hardening = rc->yield_stress > 0.0 ? in->hardening : 0.0;
}

void rb_case_from_contact(const rb_io_contact_case *in, rb_case_contact *c)
{
    memset(c, 0, sizeof *c);
    c->rc = rb_rolling_case_defaults();
    if (is_outside(c, in))
        return;
    list_left_out(c, in);
    c->runs = 1;
    c->sign = fabs(fmod(in->chi, 360.0)) > 90.0 && in->digit.T == 3 ? -1.0 : 1.0;
    c->rc.a = body_of(in, 0);
    c->rc.b = body_of(in, 1);
    c->rc.elastic_b = 1;
    c->centre = set_gap(in, &c->rc);
    set_friction(in, &c->rc);
    set_loading(in, c->sign, &c->rc);
    set_layer(in, &c->rc);
    if (!rb_rolling_can(&c->rc, RB_BODY_ELASTIC))
        c->rc.speed = in->velocity;
    c->rc.mesh = RB_MESH_UNIFORM;
    c->rc.slip_operator = RB_SLIP_UPSTREAM;
    c->rc.contact_elements = in->mx;
    c->from = c->sign * (in->from - c->centre);
    c->to = c->sign * (in->from + in->mx * in->dx - c->centre);
    if (c->sign < 0.0) {
        const double from = c->from;
        c->from = c->to;
        c->to = from;
    }
    c->rc.zone = 0.5 * (c->to - c->from);
    if (!(c->from < c->to)) { /* far away, elements are less than the numbers' digits */
        leave_out(c, "a potential contact at %g without width beside %g", in->from,
                  c->centre);
        c->runs = 0;
    }
}

double rb_case_contact_power(const rb_io_contact_case *in, const rb_rolling_solution *s)
{
    const double *u = s->plastic;
    double power = 0.0;
    for (int i = 0; i < s->n; i++) {
        const double yields = u ? u[i] - (i + 1 < s->n ? u[i + 1] : 0.0) : 0.0;
        power -= fabs(s->q[i]) * (fabs(s->shift[i]) - yields);
    }
    return in->digit.T == 3 ? power * in->dy * in->velocity * 1e-3 : NAN;
}
