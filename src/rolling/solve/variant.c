/* The same contact on the same elements for a slightly different case; derivatives of a
 * solution are computed from such variants (theory-solvers.md, D1). */
#include "rolling/body/far_field.h"
#include "rolling/body/perturbation.h"
#include "rolling/body/mesh.h"
#include "rolling/body/surface.h"
#include "rolling/case/derived.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/law_iteration.h"

#include <gsl/gsl_math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* Elements move to shift + scale x. */
typedef struct {
    double shift, scale;
} motion;

static const motion at_rest = {0.0, 1.0};

/* The elements of `of`, moved, with the gap of rc.  Equal ones on a wheel that is another one are
 * arcs of its circle between ends that stay. */
static rb_status copy_mesh(const rb_rolling_case *rc, const rb_rolling_mesh *of, int same_arcs,
                           motion moved, rb_rolling_mesh *mesh, rb_message *why)
{
    /* A wheel of another radius has other arcs between the same ends. */
    if (!same_arcs && rc->mesh == RB_MESH_UNIFORM && !rb_rolling_body_can(&rc->a, RB_BODY_FLAT)) {
        const double passed = mesh->passed;
        const rb_status s =
            rb_rolling_mesh_uniform(rc, NULL, moved.shift + moved.scale * of->ends[0],
                                    moved.shift + moved.scale * of->ends[of->n], mesh, why);
        mesh->passed = passed;
        return s == RB_OK && passed != 0.0 ? rb_rolling_mesh_set_gap(rc, mesh) : s;
    }
    mesh->n = of->n;
    mesh->ends = rb_alloc((size_t)of->n + 2, 1);
    mesh->gap = rb_alloc((size_t)of->n, 1);
    if (!mesh->ends || !mesh->gap)
        return RB_ENOMEM;
    for (int i = 0; i < of->n + 2; i++)
        mesh->ends[i] = moved.shift + moved.scale * of->ends[i];
    return rb_rolling_mesh_set_gap(rc, mesh);
}

static int have_same_boundary(const rb_bem_system *x, const rb_bem_system *y)
{
    return !x || rb_bem_system_mesh(x)->n == rb_bem_system_mesh(y)->n;
}

/* What is between them may differ. */
static int same_but_interlayer(const rb_rolling_case *x, const rb_rolling_case *y)
{
    return rb_rolling_same_body(&x->a, &y->a) && x->elastic_b == y->elastic_b &&
           (!x->elastic_b || rb_rolling_same_body(&x->b, &y->b)) &&
           (x->speed == y->speed || !rb_rolling_relaxes(x));
}

int rb_rolling_same_bodies(const rb_rolling_case *x, const rb_rolling_case *y)
{
    return same_but_interlayer(x, y) && x->interlayer_normal == y->interlayer_normal &&
           x->interlayer_tangential == y->interlayer_tangential;
}

/* The bytes between two members that belong to neither.  A pair that is missing from this list
 * makes equal cases look different, which costs time and nothing else. */
#define BETWEEN(before, after)                                                                     \
    {                                                                                              \
        offsetof(rb_rolling_case, before) + sizeof((rb_rolling_case *)0)->before,                  \
            offsetof(rb_rolling_case, after)                                                       \
    }
static const struct {
    size_t from, to;
} padding[] = {BETWEEN(plane, a),
               BETWEEN(a.support, a.arc),
               BETWEEN(a.memory.n, a.memory.time),
               BETWEEN(b.support, b.arc),
               BETWEEN(b.memory.n, b.memory.time),
               BETWEEN(elastic_b, heat_a),
               BETWEEN(gap, period),
               BETWEEN(irregularity.n, irregularity.x),
               BETWEEN(worn.n, worn.x),
               BETWEEN(friction.law, friction.table),
               BETWEEN(friction.table.n, friction.table.x),
               BETWEEN(increments, speed),
               BETWEEN(contact_elements, zone),
               BETWEEN(outer_elements, outer_refinement),
               BETWEEN(slip_operator, contact),
               BETWEEN(contact.solver, contact.cone_solver),
               BETWEEN(contact.lcp_form, contact.tol)};
#undef BETWEEN

/* 1: equal in all but what the bounds, the given values and the scales depend on: the rows of the
 * contact problem are the same, and only its right side differs. */
int rb_rolling_same_rows(const rb_rolling_case *x, const rb_rolling_case *y)
{
    rb_rolling_case like = *x;

    like.mu = y->mu;
    like.friction = y->friction;
    like.approach = y->approach;
    like.load = y->load;
    like.half_width = y->half_width;
    like.shift = y->shift;
    like.creep = y->creep;
    like.creep_ratio = y->creep_ratio;
    like.force = y->force;
    like.force_ratio = y->force_ratio;
    for (size_t k = 0; k < sizeof padding / sizeof *padding; k++)
        memcpy((char *)&like + padding[k].from, (const char *)y + padding[k].from,
               padding[k].to - padding[k].from);
    return memcmp(&like, y, sizeof like) == 0;
}

/* ---- How displacements change, by formula ------------------------------------------ */

/* The bodies of y displace so many times what those of x do, under any tractions: of one elastic
 * material each, they differ in Young's modulus alone, all by this factor.  0: they do not. */
static double softening(const rb_rolling_case *x, const rb_rolling_case *y)
{
    /* E scales all displacements of a homogeneous body; nu does not change with it. */
    const double factor = x->a.young / y->a.young;
    rb_rolling_body a = x->a, b = x->b;

    a.young = y->a.young;
    b.young = y->b.young;
    return rb_rolling_can(x, RB_BODY_HOMOGENEOUS | RB_BODY_ELASTIC) &&
                   rb_rolling_same_body(&a, &y->a) && x->elastic_b == y->elastic_b &&
                   (!x->elastic_b ||
                    (rb_rolling_same_body(&b, &y->b) && x->b.young / y->b.young == factor))
               ? factor
               : 0.0;
}

/* Of both bodies: 1/E*, beta/E* and what the depths of zero displacement add, which are
 * the factors of three matrices that the mesh alone makes (F1 of theory.md 3). */
typedef struct {
    double direct, coupled, datum;
} factors;

static int is_plain_halfplane(const rb_rolling_body *body)
{
    return body->support == RB_BEM_HALFPLANE && body->layer == 0.0 && body->memory.n == 0;
}

static int are_plain_halfplanes(const rb_rolling_case *rc)
{
    return is_plain_halfplane(&rc->a) && (!rc->elastic_b || is_plain_halfplane(&rc->b));
}

static factors factors_of(const rb_rolling_case *rc)
{
    factors all = {0.0, 0.0, 0.0};

    for (int k = 0; k < 1 + rc->elastic_b; k++) {
        double length[RB_ROLLING_TERMS];
        const rb_bem_surface s = rb_rolling_surface_of(rc, k ? &rc->b : &rc->a, length);
        /* (1 - nu)/(2 G) = (1 - nu^2)/E, and the coupling of (B6), which has the other sign in
         * B. */
        const double own = 0.5 * (1.0 - s.material.poisson) / s.material.shear;
        all.direct += own;
        all.datum += own * log(s.datum);
        all.coupled += (k ? -0.25 : 0.25) * (1.0 - 2.0 * s.material.poisson) / s.material.shear;
    }
    return all;
}

/* int sgn(x_i - s) f ds. */
static void sign_integral(const rb_bem_flexibility *f, const double *r, double *b)
{
    double before = 0.0, behind = 0.0;

    for (int j = 0; j < f->n; j++)
        behind += f->h[j] * r[j];
    for (int i = 0; i < f->m; i++) {
        const double own = i < f->n ? f->h[i] * r[i] : 0.0;
        behind -= own;
        b[i] = before - behind;
        before += own;
    }
}

/* Adds what the present tractions of the model displace more than they do, 2m, where its
 * bodies are those of rc and its elements (of half-planes) `scale` times as long, wherever they
 * stand. */
static rb_status add_change(const rb_rolling_model *of, const rb_rolling_case *rc, double scale,
                            double *w0)
{
    const rb_bem_flexibility *f = &of->bodies.f;
    const rb_contact_state *state = &of->state;
    const int n = f->n, m = f->m;
    const double layer[2] = {of->rc->interlayer_normal, of->rc->interlayer_tangential};

    if (scale == 1.0 && same_but_interlayer(rc, of->rc))
        return RB_OK;
    double *w = rb_alloc((size_t)m, 4), *b = w ? w + 2 * m : NULL;
    if (!w || rb_rolling_displacement(&of->bodies, state->p, state->q, w) != RB_OK) {
        free(w);
        return RB_ENOMEM;
    }
    if (!are_plain_halfplanes(rc)) {
        const double more = softening(of->rc, rc) - 1.0;
        for (int i = 0; i < 2 * m; i++)
            w0[i] += more * (w[i] - f->w0[i]);
        for (int i = 0; i < n; i++) {
            w0[i] -= more * layer[0] * state->p[i];
            w0[m + i] -= more * layer[1] * state->q[i];
        }
        free(w);
        return RB_OK;
    }
    /* w = direct L + datum sum + coupled b, with L the logarithms, sum the total of the traction
     * and b the signs: L follows from the displacements that are known, and the same L serves the
     * other factors. Longer elements add ln(scale) times the sum. */
    const factors at = factors_of(of->rc), to = factors_of(rc);
    sign_integral(f, state->q, b);     /* of the normal displacement */
    sign_integral(f, state->p, b + m); /* less that of the tangential one */
    for (int part = 0; part < 2; part++) {
        const double *r = part ? state->q : state->p, sign = part ? -1.0 : 1.0;
        double sum = 0.0;
        for (int j = 0; j < n; j++)
            sum += M_2_PI * f->h[j] * r[j];
        for (int i = 0; i < m; i++) {
            const int at_i = part * m + i;
            const double own = i < n ? r[i] : 0.0;
            const double direct = (w[at_i] - f->w0[at_i] - at.datum * sum -
                                   sign * at.coupled * b[at_i] - layer[part] * own) /
                                  at.direct;
            w0[at_i] += (scale * to.direct - at.direct) * direct +
                        (scale * (to.datum - to.direct * log(scale)) - at.datum) * sum +
                        sign * (scale * to.coupled - at.coupled) * b[at_i];
        }
    }
    free(w);
    return RB_OK;
}

/* ---- Variants ---------------------------------------------------------------------- */

int rb_rolling_is_compressed(const rb_rolling_model *model)
{
    const rb_bem_system *a = model->bodies.system_a, *b = model->bodies.system_b;

    return (a && isnan(rb_bem_system_rcond(a))) || (b && isnan(rb_bem_system_rcond(b)));
}

/* How a variant gets what its bodies displace: it builds them anew; or it borrows those of the
 * model, and their change under the model's tractions is known by formula, or to first order by
 * the model's factors (perturbation.c). */
typedef enum { ANEW, BY_FORMULA, PERTURBED } change_kind;

/* results: 1: all are asked for, and kappa of a law asks for the matrix itself. */
static change_kind change_of(const rb_rolling_model *of, const rb_rolling_case *rc, int results,
                             int moves)
{
    const int by_formula =
        (!moves && (same_but_interlayer(rc, of->rc) || softening(of->rc, rc) > 0.0)) ||
        (are_plain_halfplanes(of->rc) && are_plain_halfplanes(rc) &&
         rc->elastic_b == of->rc->elastic_b);

    if (rc->slip_operator != RB_SLIP_UPSTREAM || (results && rb_rolling_law_depends_on_state(rc)))
        return !moves && rb_rolling_same_bodies(rc, of->rc) ? BY_FORMULA : ANEW;
    if (by_formula)
        return BY_FORMULA;
    /* Of wheels that relax hysteresis asks for the matrix of their memory, an incompressible wheel
     * does not tell the pressure on its hub. tells: 1: the model's factors determine the change to
     * first order. */
    int tells = rc->elastic_b == of->rc->elastic_b &&
                (rb_rolling_can(rc, RB_BODY_FLAT) ||
                 !(rb_rolling_relaxes(rc) || rb_rolling_relaxes(of->rc)));
    for (int k = 0; k < 1 + rc->elastic_b; k++) {
        const rb_bem_material is = rb_rolling_material(of->rc, k ? &of->rc->b : &of->rc->a),
                              was = rb_rolling_material(rc, k ? &rc->b : &rc->a);
        tells &= !((k ? of->bodies.system_b : of->bodies.system_a) && is.poisson != was.poisson &&
                   (rb_bem_is_incompressible(is) || rb_bem_is_incompressible(was)));
    }
    return tells ? PERTURBED : ANEW;
}

int rb_rolling_variant_builds(const rb_rolling_model *of, const rb_rolling_case *rc, int results)
{
    return change_of(of, rc, results, 0) == ANEW;
}

/* The bodies that the model has, with what their change displaces as w0. */
static rb_status borrow_bodies(const rb_rolling_model *of, const rb_rolling_case *rc, motion moved,
                               rb_rolling_perturbation *perturbation, rb_rolling_model *v,
                               rb_message *why)
{
    const rb_bem_flexibility *f = &of->bodies.f;
    const int moves = moved.scale != 1.0 || moved.shift != 0.0;

    /* All members but those that are replaced below stay those of the model. */
    v->bodies = of->bodies;
    if (rb_rolling_same_bodies(rc, of->rc) && !moves)
        return RB_OK;
    double *w0 = v->bodies.f.w0 = rb_alloc(2 * (size_t)f->m, 1);
    if (moves || perturbation) {
        v->bodies.f.x = rb_alloc((size_t)f->m, 1);
        v->bodies.f.h = rb_alloc((size_t)f->m, 1);
    }
    if (!w0 || !v->bodies.f.x || !v->bodies.f.h)
        return RB_ENOMEM;
    for (int i = 0; i < f->m && (moves || perturbation); i++) {
        v->bodies.f.x[i] = moved.shift + moved.scale * f->x[i];
        v->bodies.f.h[i] = moved.scale * f->h[i];
    }
    memcpy(w0, f->w0, 2 * (size_t)f->m * sizeof *w0);
    for (int i = 0; i < f->n; i++) { /* the interlayer */
        w0[i] += (rc->interlayer_normal - of->rc->interlayer_normal) * of->state.p[i];
        w0[f->m + i] +=
            (rc->interlayer_tangential - of->rc->interlayer_tangential) * of->state.q[i];
    }
    return perturbation
               ? rb_rolling_perturbation_add(perturbation, v, w0, v->bodies.f.x, v->bodies.f.h, why)
               : add_change(of, rc, moved.scale, w0);
}

/* A variant that borrows all of the model but bounds, state and given values. */
static rb_status borrow_rows(const rb_rolling_model *of, rb_rolling_model *v)
{
    v->mesh = of->mesh;
    v->bodies = of->bodies;
    v->problem = of->problem;
    v->problem.bound = rb_alloc((size_t)of->problem.n, 1);
    if (!v->problem.bound)
        return RB_ENOMEM;
    rb_rolling_set_given(v->rc, &v->bodies, &v->problem);
    const rb_status s = rb_contact_state_alloc(of->mesh.n, &v->state);
    if (s == RB_OK)
        rb_rolling_variant_set(&of->state, NULL, 0.0, &v->state);
    return s;
}

/* results: 0: the equations alone; 1: also all results; -1: what needs the flexibilities
 * themselves. perturbation: of the model; NULL: bodies whose change no formula tells are built
 * anew. */
static rb_status create_variant(const rb_rolling_model *of, const rb_rolling_case *rc, int results,
                                int own_bodies, rb_rolling_perturbation *perturbation, motion moved,
                                rb_rolling_model *v, rb_message *why)
{
    rb_rolling_plan plan = rb_rolling_plan_of(rc);
    /* Three ways, from cheap to dear: all rows borrowed, the bodies borrowed with the change of
     * their displacement as w0, or bodies built anew. */
    const int moves = moved.scale != 1.0 || moved.shift != 0.0,
              own = own_bodies && rb_rolling_is_compressed(of),
              shares = results >= 0 && !own && !moves && rb_rolling_same_rows(rc, of->rc),
              is_same = rb_rolling_same_bodies(rc, of->rc) && !moves && !own;
    const change_kind kind = is_same              ? BY_FORMULA
                             : own || results < 0 ? ANEW
                                                  : change_of(of, rc, results, moves);
    const int borrows = kind == BY_FORMULA || (kind == PERTURBED && perturbation);

    plan.compression = RB_ROLLING_CLOSE;
    rb_status s = rb_rolling_model_begin(rc, NULL, v, why);
    v->equal_instead = of->equal_instead;
    v->varies = of->varies;
    if (s == RB_OK && shares)
        return borrow_rows(of, v);
    if (s == RB_OK)
        s = copy_mesh(rc, &of->mesh,
                      kind == BY_FORMULA || (!moves && rc->a.radius == of->rc->a.radius), moved,
                      &v->mesh, why);
    if (borrows)
        v->plan = of->plan;
    if (s == RB_OK && borrows)
        s = borrow_bodies(of, rc, moved, kind == PERTURBED ? perturbation : NULL, v, why);
    else if (s == RB_OK)
        s = rb_rolling_bodies_create(rc, &plan, &v->mesh, &v->bodies, why);
    if (s == RB_OK && !(have_same_boundary(of->bodies.system_a, v->bodies.system_a) &&
                        have_same_boundary(of->bodies.system_b, v->bodies.system_b)))
        s = rb_fail(why, RB_INACCURATE,
                    "the elements outside the contact change with the input; give "
                    "--outer-elements");
    if (s == RB_OK)
        s = borrows && of->rc->formulation == rc->formulation
                ? rb_rolling_problem_share(rc, &v->mesh, &v->bodies, of->problem.op, &v->problem,
                                           why)
                : rb_rolling_problem_create(rc, &v->mesh, &v->bodies, NULL, &v->problem, why);
    if (s == RB_OK)
        s = rb_contact_state_alloc(of->mesh.n, &v->state);
    if (s == RB_OK)
        rb_rolling_variant_set(&of->state, NULL, 0.0, &v->state);
    return s;
}

rb_status rb_rolling_variant_move(const rb_rolling_model *of, rb_rolling_perturbation *perturbation,
                                  double shift, double scale, rb_rolling_model *v, rb_message *why)
{
    return create_variant(of, of->rc, 1, 0, perturbation, (motion){shift, scale}, v, why);
}

/* Gap and bounds on moved elements alone, n each: the data of the equations without bodies. */
rb_status rb_rolling_variant_data(const rb_rolling_model *of, double shift, double scale,
                                  double further, double *gap, double *bound, rb_message *why)
{
    const size_t n = (size_t)of->mesh.n;
    rb_rolling_mesh mesh = {.passed = of->mesh.passed + further};
    rb_contact_problem p = of->problem;
    rb_rolling_bodies bodies = of->bodies;
    rb_status s = copy_mesh(of->rc, &of->mesh, 0, (motion){shift, scale}, &mesh, why);
    double *x = bodies.f.x = rb_alloc(n + 1, 1);

    if (s == RB_OK && !x)
        s = RB_ENOMEM;
    p.bound = bound;
    memcpy(bound, of->problem.bound, n * sizeof *bound);
    for (size_t i = 0; i < n && s == RB_OK; i++) {
        gap[i] = mesh.gap[i];
        x[i] = 0.5 * (mesh.ends[i] + mesh.ends[i + 1]);
    }
    if (s == RB_OK && !rb_rolling_law_depends_on_state(of->rc))
        rb_rolling_start_bounds(of->rc, NULL, &bodies, &p);
    free(x);
    rb_rolling_mesh_free(&mesh);
    return s;
}

rb_status rb_rolling_variant_place(const rb_rolling_model *of, const rb_rolling_case *rc,
                                   double shift, double scale, rb_rolling_model *v, rb_message *why)
{
    const rb_status s = create_variant(of, rc, -1, 0, NULL, (motion){shift, scale}, v, why);
    return s == RB_OK ? rb_rolling_variant_complete(v, NULL, NULL, why) : s;
}

rb_status rb_rolling_variant_create(const rb_rolling_model *of, const rb_rolling_case *rc,
                                    int results, int own_bodies,
                                    rb_rolling_perturbation *perturbation, rb_rolling_model *v,
                                    rb_message *why)
{
    return create_variant(of, rc, results, own_bodies, perturbation, at_rest, v, why);
}

rb_status rb_rolling_variant_closely(const rb_rolling_model *of, rb_rolling_model *v,
                                     rb_message *why)
{
    rb_status s = create_variant(of, of->rc, -1, 1, NULL, at_rest, v, why);

    if (s == RB_OK)
        s = rb_rolling_variant_complete(v, NULL, NULL, why);
    return s == RB_OK ? rb_rolling_model_control(v, why) : s;
}

rb_status rb_rolling_variant_solve(const rb_rolling_model *of, const rb_rolling_case *rc,
                                   rb_rolling_model *v, rb_message *why)
{
    const rb_status s = rb_rolling_variant_place(of, rc, 0.0, 1.0, v, why);
    return s == RB_OK ? rb_rolling_model_resolve(v, 1, why) : s;
}

rb_status rb_rolling_variant_with_matrix(const rb_rolling_model *of, rb_rolling_model *v,
                                         rb_message *why)
{
    rb_status s = rb_rolling_model_begin(of->rc, &of->plan, v, why);

    v->equal_instead = of->equal_instead;
    if (s == RB_OK)
        s = copy_mesh(of->rc, &of->mesh, 1, at_rest, &v->mesh, why);
    if (s == RB_OK)
        s = rb_rolling_bodies_create(of->rc, &of->plan, &v->mesh, &v->bodies, why);
    if (s == RB_OK)
        s = rb_rolling_problem_create(of->rc, &v->mesh, &v->bodies, NULL, &v->problem, why);
    if (s == RB_OK)
        s = rb_rolling_model_add_matrix(v, why);
    if (s == RB_OK)
        s = rb_contact_state_alloc(of->mesh.n, &v->state);
    if (s != RB_OK)
        return s;
    rb_rolling_variant_set(&of->state, NULL, 0.0, &v->state);
    return rb_rolling_variant_complete(v, NULL, NULL, why);
}

void rb_rolling_variant_free(const rb_rolling_model *of, rb_rolling_model *v)
{
    /* What is borrowed is recognised by its pointer, and is not freed. */
    if (v->mesh.ends && v->mesh.ends == of->mesh.ends) { /* all rows are borrowed */
        free(v->problem.bound);
        memset(&v->problem, 0, sizeof v->problem);
        memset(&v->mesh, 0, sizeof v->mesh);
    }
    if (v->problem.op == of->problem.op)
        v->problem.op = NULL;
    if (v->bodies.f.m && v->bodies.f.data == of->bodies.f.data) { /* borrowed */
        if (v->bodies.f.w0 != of->bodies.f.w0)
            free(v->bodies.f.w0);
        if (v->bodies.f.x != of->bodies.f.x)
            free(v->bodies.f.x);
        if (v->bodies.f.h != of->bodies.f.h)
            free(v->bodies.f.h);
        memset(&v->bodies, 0, sizeof v->bodies);
    }
    rb_rolling_model_free(v);
}

void rb_rolling_variant_set(const rb_contact_state *from, const rb_contact_state *along,
                            double part, rb_contact_state *to)
{
    for (int i = 0; i < from->n; i++) {
        to->p[i] = from->p[i] + (along ? part * along->p[i] : 0.0);
        to->q[i] = from->q[i] + (along ? part * along->q[i] : 0.0);
        to->zone[i] = from->zone[i];
        to->plastic[i] = from->plastic[i]; /* where it slips: whether it yields, too */
    }
    to->delta = from->delta + (along ? part * along->delta : 0.0);
    to->xi = from->xi + (along ? part * along->xi : 0.0);
    to->status = from->status;
    to->solver = from->solver;
    to->lcp_form = from->lcp_form;
}

/* Hertz's half-width of the load that there is, what refers to it, and friction. */
static rb_status follow_state(rb_rolling_model *v, rb_message *why)
{
    const rb_rolling_case *rc = v->rc;
    rb_contact_problem *p = &v->problem;

    v->half_width = rb_rolling_contact_half_width(rc, fmax(0.0, rb_rolling_model_load(v)));
    if (!p->force_given && !p->load_given && rc->formulation != RB_STATIC &&
        !isnan(rc->creep_ratio))
        p->xi = rb_rolling_creepage_of_ratio(v, rc->creep_ratio);
    return rb_rolling_model_friction(v, why);
}

rb_status rb_rolling_variant_complete(rb_rolling_model *v, double *gap, double *slip,
                                      rb_message *why)
{
    rb_contact_state *state = &v->state;
    double *scratch = rb_alloc((size_t)state->n, 1);

    if (!scratch)
        return rb_fail(why, RB_ENOMEM, "out of memory for %d elements", state->n);
    rb_contact_kinematics(&v->problem, state, gap ? gap : scratch, state->lambda);
    if (slip)
        memcpy(slip, state->lambda, (size_t)state->n * sizeof *slip);
    free(scratch);
    for (int i = 0; i < state->n; i++)
        state->lambda[i] *= state->zone[i] != RB_ZONE_STICK;
    rb_contact_set_plastic(&v->problem, state, NULL);
    return follow_state(v, why);
}

int rb_rolling_variant_given(const rb_rolling_model *of, const rb_rolling_case *rc, double *bound,
                             rb_contact_problem *problem, rb_status *status, rb_message *why)
{
    rb_rolling_model v = *of;

    if (!rb_rolling_same_rows(rc, of->rc))
        return 0;
    v.rc = rc;
    v.problem.bound = bound;
    rb_rolling_set_given(rc, &v.bodies, &v.problem);
    *status = follow_state(&v, why);
    *problem = v.problem;
    return 1;
}
