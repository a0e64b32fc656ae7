/* Converts cases of CONTACT to cases of rollbem.  Signs: docs/contact.md. */
#include "rolling/case/case.h"

#include <gsl/gsl_math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Adds a clause to what is left out. */
RB_PRINTF(2, 3)
static void leave_out(rb_case_contact *c, const char *format, ...)
{
    char clause[160];
    va_list args;
    va_start(args, format);
    vsnprintf(clause, sizeof clause, format, args);
    va_end(args);
    rb_append(c->left_out, sizeof c->left_out, "%s%s", c->left_out[0] ? "; " : "", clause);
}

/* A rectangle under Hertz's pressure, of given curvature or half-length. */
static int is_line_contact(const rb_io_contact_case *in)
{
    return in->potential == -4 || in->potential == -5;
}

/* The same of how it goes on. */
static int is_another_step(rb_case_contact *c, const rb_io_contact_case *in)
{
    const rb_io_contact_digits *d = &in->digit;
    const int steps = d->T == 1 || d->T == 2;

    if (d->B != 0)
        leave_out(c, "approximate pressure (B = %d)", d->B);
    else if (d->R > 1)
        leave_out(c, "a case that the file itself does not calculate (R = %d)", d->R);
    else if (steps && d->P != 0 && d->P != 2)
        leave_out(c, "another state to go on from (P = %d; 0 and 2 are read)", d->P);
    else if (steps && d->P == 0 && d->M == 1)
        leave_out(c, "a step of viscoelastic bodies (M = 1)");
    else if (d->T == 2 && !(in->dq > 0.0))
        leave_out(c, "a step of no length (DQ = %g)", in->dq);
    else
        return 0;
    return 1;
}

/* 1: what makes the case another one, so that it is not run. */
static int is_outside(rb_case_contact *c, const rb_io_contact_case *in)
{
    const rb_io_contact_digits *d = &in->digit;
    if (in->unread[0])
        leave_out(c, "what cannot be read (%.150s)", in->unread);
    else if (in->module != 3)
        leave_out(c, "module %d (module 3 alone is read)", in->module);
    else if (d->M == 2 || d->M == 3)
        leave_out(c, "the simplified theory (M = %d)", d->M);
    else if (in->law == 6 && d->T > 0)
        leave_out(c, "friction that changes with the temperature (L = 6; rollbem has it as "
                     "--mu-heat)");
    else if (d->V > 0)
        leave_out(c, "friction of its own in every row of elements (V = %d)", d->V);
    else if (in->my > 1)
        leave_out(c, "three dimensions (MY = %d rows of elements)", in->my);
    else if (in->potential < 0 && !is_line_contact(in))
        leave_out(c, "a contact ellipse (IPOTCN = %d; -4 and -5 are of two dimensions)",
                  in->potential);
    else if (is_line_contact(in) && !(d->N == 1 && in->normal > 0.0 && in->hertz[0] > 0.0 &&
                                      in->hertz[1] > 0.0 && in->hertz[2] > 0.0))
        leave_out(c, "Hertzian input without a positive load, radius or length (IPOTCN = %d)",
                  in->potential);
    else if (is_line_contact(in))
        return is_another_step(c, in);
    else if (in->base != 1 && in->base != 2)
        leave_out(c,
                  "IBASE = %d gives the surface by a list of heights or a wavy form; give a "
                  "parabola or circle (IBASE = 1, 2), or the gap to rollbem --gap",
                  in->base);
    else if (in->base == 1 && !(in->b[0] > 0.0))
        leave_out(c, "a gap without curvature (B1 = %g)", in->b[0]);
    else
        return is_another_step(c, in);
    return 1;
}

/* The friction laws L = 2, 3, 4. */
static int falls(const rb_io_contact_case *in)
{
    return in->law >= 2 && in->law <= 4;
}

/* A strip as wide as DY of a half-space. */
static rb_rolling_body body_of(const rb_io_contact_case *in, double width, int k)
{
    const double nu = in->poisson[k];
    rb_rolling_body body = {.young = 2.0 * in->shear[k] * (1.0 + nu),
                            .poisson = nu,
                            .radius = INFINITY,
                            .support = RB_BEM_HALFPLANE,
                            .strip = width};
    if (in->digit.M != 1 || in->ratio[k] == 0.0)
        return body;
    if (in->time[k] > 0.0)
        body.memory = (rb_rolling_memory){1, {in->time[k]}, {in->ratio[k]}};
    else
        body.young /= 1.0 + in->ratio[k]; /* it relaxes at once */
    return body;
}

static void set_friction(const rb_io_contact_case *in, rb_case_contact *c)
{
    rb_rolling_case *rc = &c->rc;
    static const rb_rolling_friction_law laws[] = {RB_FRICTION_linear, RB_FRICTION_rational,
                                                   RB_FRICTION_exponential};

    rc->mu = in->digit.T == 0 ? 0.0 : in->fstat;
    if (in->digit.T == 0 || !falls(in))
        return;
    if (in->digit.T == 1 && !(in->memory > 0.0)) {
        leave_out(c,
                  "friction that falls in a shift without a sliding distance: mu = %g, its "
                  "value at rest",
                  in->fstat);
        return;
    }
    rc->mu = in->fkin;
    rc->speed = in->velocity;
    rc->friction = (rb_rolling_friction){.law = laws[in->law - 2],
                                         .fall = {in->fall[0], in->fall[1]},
                                         .slip_scale = {in->slip_scale[0], in->slip_scale[1]},
                                         .memory = in->memory,
                                         .memory_slip = in->memory > 0.0 ? in->memory_slip : 0.0};
    if (in->start != 0.0 && in->digit.T == 2) {
        c->start_mu = in->start < 0.0 ? in->fkin : in->fstat;
        c->start = (rb_rolling_table){1, &c->centre, &c->start_mu};
    }
}

void rb_case_from_contact(const rb_io_contact_case *in, rb_case_contact *c)
{
    memset(c, 0, sizeof *c);
    c->rc = rb_rolling_case_defaults();
    if (is_outside(c, in))
        return;
    /* What CONTACT has in a case that is run, and this program has not. */
    const rb_io_contact_digits *d = &in->digit;
    if (in->fstat != in->fkin && d->T > 0 && !falls(in))
        leave_out(c, "another friction law (L = %d): mu = %g, its value at rest", in->law,
                  in->fstat);
    if (d->M > 1 && d->M != 4)
        leave_out(c, "the material (M = %d)", d->M);
    if (d->T > 0 && (in->side != 0.0 || in->spin != 0.0))
        leave_out(c, "CETA, FY and CPHI");
    if (d->T == 3 && !is_line_contact(in) && fabs(in->dq / in->dx - 1.0) > 0.01)
        leave_out(c, "the step DQ = %g: slip is that over an element, DX = %g", in->dq, in->dx);
    if (in->plan > 1)
        leave_out(c, "the planform (IPLAN = %d)", in->plan);
    if (d->H > 0)
        leave_out(c, "temperatures (H = %d)", d->H);
    if (d->E > 1)
        leave_out(c, "the rigid slip per element (E = %d)", d->E);
    const int hertz = is_line_contact(in), T = in->digit.T;
    double from = in->from, to = in->from + in->mx * in->dx;
    c->runs = 1;
    c->width = hertz ? 2.0 * in->hertz[1] : in->dy;
    c->goes_on = (T == 1 || T == 2) && in->digit.P == 0;
    c->step = T == 2 ? in->dq : 0.0;
    c->sign = fabs(fmod(in->chi, 360.0)) > 90.0 && T >= 2 ? -1.0 : 1.0;
    c->rc.a = body_of(in, c->width, 0);
    c->rc.b = body_of(in, c->width, 1);
    c->rc.elastic_b = 1;
    if (hertz) {
        /* The half-length of the rectangle, and the combined radius. */
        const double flexibility = (1.0 - in->poisson[0]) / (2.0 * in->shear[0]) +
                                   (1.0 - in->poisson[1]) / (2.0 * in->shear[1]); /* 1/E* */
        const double square = 4.0 * in->normal / c->width * flexibility / M_PI;   /* a^2/R */
        const double a = in->potential == -4 ? sqrt(square * 0.5 / in->hertz[0]) : in->hertz[0];

        c->rc.gap = RB_GAP_PARABOLA;
        c->rc.a.radius = a * a / square;
        to = in->hertz[2] * a;
        from = -to;
    } else {
        /* Parabola or circle; where its lowest point is. */
        c->rc.gap = in->base == 2 ? RB_GAP_EXACT : RB_GAP_PARABOLA;
        c->rc.a.radius = in->base == 2 ? in->radius : 0.5 / in->b[0];
        c->centre = in->base == 2 ? in->centre : 0.0 - 0.5 * in->b[3] / in->b[0];
    }
    set_friction(in, c);
    /* T = 1: CKSI is a distance; F > 0: FX is a part of FSTAT FN. */
    static const rb_rolling_formulation formulations[] = {RB_STATIC, RB_STATIC, RB_TRANSIENT,
                                                          RB_STEADY};
    const double tangential = c->sign * in->tangential;
    c->rc.formulation = formulations[in->digit.T];
    if (in->digit.N == 1)
        c->rc.load = in->normal / c->width;
    else
        c->rc.approach = in->normal;
    if (in->digit.T == 0)
        c->rc.shift = 0.0;
    else if (in->digit.F > 0)
        c->rc.force_ratio = tangential;
    else if (in->digit.T >= 2)
        c->rc.creep = tangential;
    else
        c->rc.shift = tangential;
    /* M = 4: a layer of compliance LAYTHK/GG3 and yields at TAU_C0, which neither 0 nor
     * more than 1e10 does. */
    if (in->digit.M == 4) {
        if (in->layer != 0.0)
            c->rc.interlayer_tangential = in->layer / in->layer_shear;
        c->rc.yield_stress = in->yield > 1e10 ? 0.0 : in->yield;
        c->rc.hardening = c->rc.yield_stress > 0.0 ? in->hardening : 0.0;
    }
    if (!rb_rolling_can(&c->rc, RB_BODY_ELASTIC))
        c->rc.speed = in->velocity;
    c->rc.mesh = RB_MESH_UNIFORM;
    c->rc.slip_operator = RB_SLIP_UPSTREAM;
    c->rc.contact_elements = in->mx;
    c->from = c->sign * ((c->sign > 0.0 ? from : to) - c->centre);
    c->to = c->sign * ((c->sign > 0.0 ? to : from) - c->centre);
    c->rc.zone = 0.5 * (c->to - c->from);
    if (!(c->from < c->to)) { /* far away, elements are less than the numbers' digits */
        leave_out(c, "a potential contact at %g without width beside %g", from, c->centre);
        c->runs = 0;
    }
}

void rb_case_contact_follow(const rb_case_contact *before, const rb_rolling_solution *solution,
                            rb_case_contact *c)
{
    if (!c->runs || !c->goes_on)
        return;
    if (!before || solution->n == 0)
        leave_out(c, "a step from a case without a result");
    else if (before->sign != c->sign)
        leave_out(c, "a step against the direction of the case before (CHI)");
    else
        return;
    c->runs = 0;
}

rb_status rb_case_contact_solve(const rb_case_contact *c, const rb_rolling_solution *before,
                                rb_rolling_solution *solution, rb_message *why)
{
    return c->goes_on || c->step > 0.0
               ? rb_rolling_step_between(&c->rc, c->from, c->to, c->goes_on ? before : NULL,
                                         c->start.n > 0 ? &c->start : NULL, c->step, solution, why)
               : rb_rolling_solve_between(&c->rc, c->from, c->to, solution, why);
}

double rb_case_contact_power(const rb_io_contact_case *in, const rb_case_contact *c,
                             const rb_rolling_solution *before, const rb_rolling_solution *s)
{
    double power = 0.0;

    if (in->digit.T < 2)
        return NAN;
    const rb_rolling_solution *from = !(c->step > 0.0) ? s : c->goes_on ? before : NULL;
    for (int i = 0; i < s->n; i++) {
        /* The particle of element i was `rolled` elements ahead before, in the state
         * before a step, or in the same one of steady rolling; what it had yielded is linear
         * between midpoints, and nothing beyond the last one. */
        const double rolled = c->step > 0.0 ? c->step / s->h[i] : 1.0;
        const double ahead = i + floor(rolled + 1e-9), t = fmax(0.0, rolled + i - ahead);
        double yields = s->plastic ? s->plastic[i] : 0.0;
        if (s->plastic && from && from->plastic && ahead < from->n) {
            const int j = (int)ahead;
            yields -=
                (1.0 - t) * from->plastic[j] + (j + 1 < from->n ? t * from->plastic[j + 1] : 0.0);
        }
        power -= fabs(s->q[i]) * (fabs(s->shift[i]) - yields) / rolled;
    }
    return power * c->width * in->velocity * 1e-3;
}
