/* A crack under the contact of a case: its options, and the contact as its load. */
#include "rolling/case/words.h"

#include <gsl/gsl_math.h>
#include <string.h>

/* Positions farther apart, in half-widths, miss the crack; above NARROW extremes lie
 * between them.  The first one stands at least FAR from the mouth. */
static const double WIDE = 0.5, NARROW = 0.1, FAR = 6.0;
/* Of a B that is a cylinder: the deepest place of a crack in a half-plane, in radii. */
static const double DEEPEST = 0.1;
/* Half-width of the potential contact of a coupled crack, in half-widths. */
static const double ZONE = 1.6;
enum { INTERVALS = 120 };

/* ---- Positions --------------------------------------------------------------------- */

static int intervals(const rb_resolved_case *c)
{
    return c->rc.steps > 0 ? c->rc.steps : INTERVALS;
}

static double from_of(const rb_resolved_case *c, const rb_case_crack *k)
{
    return !isnan(k->from)                                          ? k->from
           : rb_case_has_steps(c) && c->rc.formulation == RB_STATIC ? 0.0
                                                                    : -FAR;
}

static double to_of(const rb_case_crack *k)
{
    return isnan(k->to) ? FAR : k->to;
}

rb_status rb_case_crack_check(const rb_resolved_case *c, const rb_case_crack *k, rb_message *why)
{
    const rb_rolling_case *rc = &c->rc;
    const double a = c->derived.half_width;
    const double deepest = a * (k->depth + k->length * fabs(sin(k->angle * M_PI / 180.0)));

    if (!(k->angle >= 0.0 && k->angle < 180.0) || (k->depth == 0.0 && k->angle == 0.0))
        return rb_fail(why, RB_EINVAL,
                       "--crack-angle: expected more than 0 and less than 180 degrees%s, "
                       "got %g: the crack would lie outside body B",
                       k->depth > 0.0 ? " (0 below the surface)" : "", k->angle);
    if (k->fluid != RB_CRACK_DRY && k->depth > 0.0)
        return rb_fail(why, RB_EINVAL,
                       "--fluid: enters at the mouth, which a crack with --crack-depth "
                       "does not have");
    if (k->locate_closing && k->fluid != RB_CRACK_TRAPPED)
        return rb_fail(why, RB_EINVAL, "--closing located: only for --fluid trapped");
    if (k->unloaded && k->coupled)
        return rb_fail(why, RB_EINVAL, "--unloaded and --coupled exclude each other");
    if (k->unloaded && k->remote_stress == 0.0)
        return rb_fail(why, RB_EINVAL, "--unloaded: needs --remote-stress");
    if (k->unloaded && k->fluid == RB_CRACK_PRESSURE)
        return rb_fail(why, RB_EINVAL,
                       "--fluid pressure: is the contact pressure, and --unloaded has none");
    if (!k->unloaded && rc->elastic_b &&
        !rb_rolling_body_can(&rc->b, RB_BODY_HOMOGENEOUS | RB_BODY_ELASTIC))
        return rb_fail(why, RB_EINVAL,
                       "crack: the stress in body B is known where it is homogeneous and "
                       "elastic only, without a layer, a cover or memory");
    if (!k->unloaded && rc->elastic_b && deepest > DEEPEST * fabs(rc->b.radius))
        return rb_fail(why, RB_EINVAL,
                       "crack: body B counts as a half-plane; a crack as deep as %g of "
                       "its radius needs its shape, expected at most %g",
                       deepest / fabs(rc->b.radius), DEEPEST);
    if (k->coupled && (rb_rolling_largest_mu(rc) > 0.0 || rb_case_has_steps(c)))
        return rb_fail(why, RB_EINVAL,
                       "--coupled: for a contact without friction and without steps of its "
                       "own, --mu 0");
    if (k->coupled && !rc->elastic_b)
        return rb_fail(why, RB_EINVAL,
                       "--coupled: a rigid body B is not changed by its crack; make it "
                       "elastic (--similar, --young-b)");
    if (k->coupled && k->fluid != RB_CRACK_DRY)
        return rb_fail(why, RB_EINVAL, "--coupled: of a crack without fluid");
    const rb_status s = rb_case_check_growth(k, why);
    if (s != RB_OK)
        return s;
    /* Positions of the contact. */
    const double from = from_of(c, k), to = to_of(k);
    const int n = intervals(c), steps = rb_case_has_steps(c);
    if (steps && !isnan(k->to))
        return rb_fail(why, RB_EINVAL, "--to: the history says how far the contact goes");
    if (steps || k->unloaded)
        return RB_OK;
    if (!(from < to))
        return rb_fail(why, RB_EINVAL,
                       "--from and --to: A rolls towards +x; expected --from below --to, "
                       "got %g and %g",
                       from, to);
    if ((to - from) / n > WIDE * (1.0 + 1e-12))
        return rb_fail(why, RB_EINVAL,
                       "--steps: %d steps of %g half-widths would jump over the crack, "
                       "expected at least %d",
                       n, (to - from) / n, (int)ceil((to - from) / WIDE * (1.0 - 1e-12)));
    return RB_OK;
}

/* ---- Load -------------------------------------------------------------------------- */

typedef struct {
    rb_rolling_states *states;
    const rb_crack_observer *observer;
    int failed; /* 1: a step could not be kept */
} contact_steps;

static int keep_step(const rb_rolling_model *model, const rb_rolling_history *history, int step,
                     int steps, void *context)
{
    contact_steps *kept = context;
    kept->failed = rb_rolling_states_keep(model, history, step, steps, kept->states) != RB_OK;
    return kept->failed ||
           (kept->observer && kept->observer->stopped(step + 1, steps, kept->observer->context));
}

void rb_case_crack_track_free(rb_case_crack_track *t)
{
    rb_arena_free(&t->memory);
    *t = (rb_case_crack_track){0};
}

/* The ends of n contact elements, and their tractions in each of the loads. */
static rb_status set_loads(int n, const double *x, const double *h, const double *p,
                           const double *q, rb_case_crack_track *t)
{
    t->ends = rb_arena_doubles(&t->memory, (size_t)n + 1, 1);
    if (!t->ends)
        return RB_ENOMEM;
    for (int i = 0; i < n; i++)
        t->ends[i] = x[i] - 0.5 * h[i];
    t->ends[n] = x[n - 1] + 0.5 * h[n - 1];
    for (int i = 0; i < t->loads; i++)
        t->load[i] = (rb_bem_edge_load){n, t->ends, p + (size_t)i * n, q + (size_t)i * n};
    return RB_OK;
}

/* A note where it applies; its text may show the value. */
static void note(rb_case_crack_result *r, int applies, const char *text, double value)
{
    const int kind = r->note_kinds++;

    if (!applies || r->notes == RB_CASE_CRACK_NOTES)
        return;
    r->note_kind[r->notes] = kind;
    snprintf(r->note[r->notes++], sizeof r->note[0], text, value);
}

static void find_notes(const rb_resolved_case *c, const rb_case_crack *k,
                       const rb_case_crack_track *t, rb_case_crack_result *r)
{
    const double a = r->half_width, first = fabs(t->x[0] / a - k->mouth);
    const double radius = c->rc.elastic_b ? c->rc.b.radius : INFINITY;
    double step = 0.0;

    if (k->unloaded)
        return;
    for (int i = 1; i < t->n; i++)
        step = fmax(step, (t->x[i] - t->x[i - 1]) / a);
    note(r, first < FAR * (1.0 - 1e-12) && t->x[t->n - 1] > t->x[0],
         "The first position is %.3g half-widths from the mouth, where the load "
         "already acts on the crack; begin at least 6 away (--from).",
         first);
    note(r, step > NARROW * (1.0 + 1e-9),
         "Positions are %.3g half-widths apart; the extremes of K lie between them "
         "(take at most 0.1, --steps).",
         step);
    note(r, k->fluid == RB_CRACK_TRAPPED && !k->locate_closing,
         "The volume of the trapped fluid is that of the last position with an open "
         "mouth, and depends on the positions; --closing located does not.",
         0.0);
    note(r, !c->rc.elastic_b,
         "Body B is rigid for the contact: K are the limits of a body that is much "
         "stiffer than A.",
         0.0);
    note(r, isfinite(radius),
         radius < 0.0 ? "Body B has a bore; the crack is computed as in a half-plane."
                      : "Body B is a cylinder; the crack is computed as in a half-plane.",
         0.0);
}

rb_status rb_case_crack_follow(const rb_resolved_case *c, const rb_case_crack *k,
                               rb_case_crack_result *r, rb_case_crack_track *t, rb_message *why)
{
    const int has_steps = rb_case_has_steps(c) && !k->unloaded,
              rolls = c->rc.formulation == RB_TRANSIENT;
    const double from = from_of(c, k);
    const rb_rolling_states *steps = &r->states;
    const rb_rolling_solution *one = &r->contact.solution;
    rb_status s = RB_OK;

    memset(t, 0, sizeof *t);
    r->half_width = has_steps && rolls ? r->contact.history.half_width : c->derived.half_width;
    const rb_rolling_body *b = c->rc.elastic_b && !k->unloaded ? &c->rc.b : &c->rc.a;
    const double a = r->half_width;
    r->shape = (rb_crack_shape){
        .path = rb_crack_straight(k->mouth * a, k->depth * a, k->length * a, k->angle),
        .elements = k->elements,
        .friction = k->friction,
        .shear = 0.5 * b->young / (1.0 + b->poisson),
        /* of plane stress: the same kappa */
        .poisson = c->rc.plane == RB_PLANE_STRESS ? b->poisson / (1.0 + b->poisson) : b->poisson};
    r->passes = k->unloaded ? 1 : k->passes;
    t->n = k->unloaded ? 1 : has_steps ? steps->steps : intervals(c) + 1;
    t->loads = k->unloaded ? 0 : has_steps ? t->n : 1;
    t->x = rb_arena_doubles(&t->memory, (size_t)t->n, 1);
    t->load = rb_arena_zeros(&t->memory, (size_t)t->n, sizeof *t->load);
    if (t->memory.failed)
        return RB_ENOMEM;
    for (int i = 0; i < t->n; i++)
        t->x[i] = r->half_width * (k->unloaded  ? from
                                   : !has_steps ? from + (to_of(k) - from) * i / (t->n - 1)
                                   : rolls      ? from + r->contact.history.distance[i]
                                                : from);
    for (int i = 1; i < t->n && has_steps; i++)
        if (t->x[i] - t->x[i - 1] > WIDE * r->half_width)
            return rb_fail(why, RB_EINVAL,
                           "--steps: step %d rolls %g half-widths and jumps over the "
                           "crack, expected at most %g",
                           i + 1, (t->x[i] - t->x[i - 1]) / r->half_width, WIDE);
    if (has_steps)
        s = set_loads(steps->n, steps->x, steps->h, steps->p, steps->q, t);
    else if (!k->unloaded)
        s = set_loads(one->n, one->x, one->h, one->p, one->q, t);
    if (s == RB_OK)
        find_notes(c, k, t, r);
    return s;
}

rb_crack_passage rb_case_crack_passage(const rb_case_crack *k, const rb_case_crack_track *t)
{
    return (rb_crack_passage){.steps = t->n,
                              .x = t->x,
                              .loads = t->loads,
                              .load = t->load,
                              .passes = k->unloaded ? 1 : k->passes,
                              .fluid = (rb_crack_fluid)k->fluid,
                              .locate_closing = k->locate_closing,
                              .tension = k->remote_stress};
}

/* ---- Solve ------------------------------------------------------------------------- */

rb_resolved_case rb_case_crack_contact(const rb_resolved_case *c, const rb_case_crack *k)
{
    rb_resolved_case contact = *c;
    contact.error = 0;
    if (k->coupled) { /* the lip of the crack takes part in the contact beyond its edges */
        contact.rc.mesh = RB_MESH_UNIFORM;
        contact.rc.slip_operator = RB_SLIP_UPSTREAM;
        if (contact.rc.zone == 0.0)
            contact.rc.zone = ZONE * c->derived.half_width;
    }
    return contact;
}

/* One mesh: as many elements as times `finer` says, of crack and contact. */
static rb_status solve_once(const rb_resolved_case *c, const rb_case_crack *k, int finer,
                            const rb_crack_observer *observer, rb_case_crack_result *r,
                            rb_message *why)
{
    contact_steps kept = {&r->states, observer, 0};
    rb_resolved_case refined = rb_case_crack_contact(c, k);
    rb_case_crack_track t = {0};
    rb_crack *crack = NULL;

    memset(r, 0, sizeof *r);
    r->passes = k->passes;
    if (!rb_case_has_steps(c))
        refined.rc.contact_elements *= finer;
    rb_status s = k->unloaded ? RB_OK : rb_case_solve(&refined, keep_step, &kept, &r->contact, why);
    if (s == RB_INTERRUPTED && kept.failed)
        s = RB_ENOMEM;
    if (s == RB_OK)
        s = rb_case_crack_follow(c, k, r, &t, why);
    r->shape.elements *= finer;
    if (s == RB_OK && k->coupled)
        s = rb_rolling_model_add_matrix(&r->contact.model, why);
    if (s == RB_OK)
        s = rb_crack_create(&r->shape, &crack, why);
    if (s == RB_OK) {
        const rb_rolling_model *model = &r->contact.model;
        const rb_crack_wheel wheel = {.n = model->mesh.n,
                                      .ends = t.ends,
                                      .F = model->bodies.F,
                                      .ldf = 2 * (model->mesh.n + 1),
                                      .gap = model->problem.d_N,
                                      .load = r->contact.solution.normal_load,
                                      .approach = r->contact.solution.approach};
        rb_crack_passage passage = rb_case_crack_passage(k, &t);
        passage.wheel = k->coupled ? &wheel : NULL;
        passage.observer = observer;
        if (k->coupled && !model->bodies.F)
            s = rb_fail(why, RB_EINVAL, "--coupled: fewer than %d contact elements",
                        RB_ROLLING_LARGE);
        else
            s = rb_crack_pass(crack, &passage, &r->history, why);
        if (s == RB_INTERRUPTED)
            r->passes = r->history.n / passage.steps;
        if (r->history.n > 0)
            r->summary = rb_case_crack_summarise(&r->history, r->passes);
        if (s == RB_OK && !isnan(k->paris) && finer == 1)
            s = rb_case_grow_crack(c, k, &passage, r, why);
        const rb_case_crack_growth *g = &r->growth;
        if ((g->surfaced || g->rests) && r->notes < RB_CASE_CRACK_NOTES)
            snprintf(r->note[r->notes++], sizeof r->note[0],
                     g->surfaced ? "The crack came back to the surface beyond a length of %.4g "
                                   "%s: a piece breaks out."
                                 : "The crack stops: dK is below the threshold at a length of "
                                   "%.4g %s.",
                     rb_unit_shown(c->units, "mm", g->length[g->n - 1]),
                     rb_unit_name(c->units, "mm"));
    }
    rb_crack_free(crack);
    rb_case_crack_track_free(&t);
    return s;
}

rb_status rb_case_crack_solve(const rb_resolved_case *c, const rb_case_crack *k,
                              const rb_crack_observer *observer, rb_case_crack_result *r,
                              rb_message *why)
{
    memset(r, 0, sizeof *r);
    rb_status s = rb_case_crack_check(c, k, why);
    if (s == RB_OK)
        s = solve_once(c, k, 1, observer, r, why);
    if (s == RB_OK && c->error) {
        rb_case_crack_result fine;
        s = solve_once(c, k, 2, observer, &fine, why);
        r->has_errors = s == RB_OK;
        if (s == RB_OK)
            rb_case_crack_set_errors(&fine.summary, r);
        rb_case_crack_free(&fine);
    }
    r->status = s;
    return s == RB_ENOMEM ? rb_fail(why, s, "crack: out of memory") : s;
}

rb_status rb_case_crack_row(const rb_resolved_case *c, const rb_case_crack *k, rb_rolling_row *row,
                            rb_message *why)
{
    rb_case_crack_result r;
    const rb_status s = rb_case_crack_solve(c, k, NULL, &r, why);

    if (r.contact.solution.n > 0) {
        row->solution = rb_rolling_scalars_of(&r.contact.solution);
        rb_rolling_solution_convert(&r.contact.solution, c->units);
        row->notes = rb_rolling_find_row_notes(&c->rc, &r.contact.solution);
    }
    for (int i = 0; i < r.notes; i++)
        rb_rolling_add_note(&row->notes, RB_ROLLING_OWN_NOTES + r.note_kind[i], r.note[i]);
    if (s == RB_OK)
        rb_case_crack_set_row(&r, row);
    rb_case_crack_free(&r);
    return s;
}
