/* A crack again: the contact that passes over it is restored as a result of its own; from its
 * tractions and those of the faces that are stored the openings and the slips are computed again at
 * every position, then the laws of the faces and of the fluid and the stress intensities.  Nothing
 * is solved but where the mouth closes between two positions. */
#include "program/certificate/internal.h"
#include "lcp/contact/contact.h"
#include "analysis/crack/crack.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;
static const double EDGE_CRACK = 1.1215222552; /* Koiter: K_I/sqrt(pi a), unit tension */
static const double TOLERANCE = 1e-9;          /* of the scaled laws */
enum { DIRECTIONS = 3600 };

/* A pass that is restored. */
typedef struct {
    rb_certificate *c;
    const json_t *root;
    rb_resolved_case contact; /* whose tractions load the crack */
    const rb_resolved_case *resolved;
    rb_case_crack crack;
    rb_case_crack_result *r; /* its history becomes what is written again */
    rb_crack_history stored; /* tractions of the faces and of a coupled contact, zones, fluid */
    rb_case_crack_track track;
    rb_crack *body;
    double *T, *hat;           /* 2n: load; n */
    double *length, *force;    /* n: typical D and r of a node */
    double per_D;              /* K over D next to a tip */
    double *gap, *slip, *none; /* of a coupled contact's elements; gap owns them */
} restored;

/* ---- What is stored ---------------------------------------------------------------- */

/* Tractions of the faces at every position, as nodal forces. */
static rb_status read_history(restored *j, rb_message *why)
{
    const json_t *faces = json_object_get(j->root, "faces"),
                 *table = json_object_get(j->root, "table");
    rb_crack_history *h = &j->stored;
    const int n = h->nodes, steps = h->n;
    const size_t apart = 2 * (size_t)n;
    rb_status s = rb_certificate_lists(j->c, faces, "p_MPa", steps, n, apart, h->r, why);

    if (s == RB_OK)
        s = rb_certificate_lists(j->c, faces, "q_MPa", steps, n, apart, h->r + n, why);
    if (s == RB_OK && h->wheel)
        s = rb_certificate_lists(j->c, faces, "contact_p_MPa", steps, h->elements,
                                 (size_t)h->elements, h->wheel, why);
    if (s == RB_OK)
        s = rb_certificate_zones(j->c, faces, "zone", steps, n, 3, h->zone, why);
    if (s == RB_OK)
        s = rb_certificate_list(j->c, table, "fluid_pressure", steps, h->fluid_pressure, why);
    for (int i = 0; i < 2 * steps * n; i++)
        h->r[i] *= j->hat[i % n];
    return s;
}

/* ---- The crack again --------------------------------------------------------------- */

/* K over D of the node next to a tip: from as many elements along a crack of 90 degrees
 * under unit tension, at the surface or deep below it, whose K_I is known. */
static rb_status find_per_D(restored *j, rb_message *why)
{
    rb_crack_shape straight = j->r->shape;
    const double dx = straight.path.x[1] - straight.path.x[0],
                 dy = straight.path.y[1] - straight.path.y[0], a = hypot(dx, dy);
    const int is_deep = j->crack.depth > 0.0;
    rb_crack *known = NULL;

    straight.full_plane = is_deep;
    straight.path = rb_crack_straight(0.0, 0.0, a, 90.0);
    const rb_status s = rb_crack_create(&straight, &known, why);
    if (s == RB_OK) {
        const int n = rb_crack_nodes(known);
        const double D = cblas_ddot(n, rb_crack_flexibility(known) + n - 1, 2 * n, j->hat, 1);
        j->per_D = (is_deep ? sqrt(0.5 * PI * a) : EDGE_CRACK * sqrt(PI * a)) / D;
    }
    rb_crack_free(known);
    return s;
}

/* The largest stress that loads the crack. */
static double largest_stress(const restored *j)
{
    double stress = 0.0;
    for (int k = 0; k < j->track.n; k++)
        stress = fmax(stress, fabs(rb_case_crack_tension(&j->crack, &j->track, k)));
    for (int k = 0; k < j->track.loads; k++)
        for (int i = 0; i < j->track.load[k].n; i++)
            stress = fmax(stress, fmax(fabs(j->track.load[k].p[i]), fabs(j->track.load[k].q[i])));
    return stress;
}

/* Typical displacements and forces of the nodes, as the solver scales them. */
static void set_scales(restored *j)
{
    const int n = rb_crack_nodes(j->body);
    const double *F = rb_crack_flexibility(j->body), stress = largest_stress(j);
    double widest = 0.0, stiffest = 0.0;

    for (int i = 0; i < n; i++) {
        widest = fmax(widest, j->hat[i]);
        stiffest = fmax(stiffest, 1.0 / sqrt(F[i + (size_t)i * 2 * (size_t)n]));
    }
    for (int i = 0; i < n; i++) {
        const double scale = 1.0 / sqrt(F[i + (size_t)i * 2 * (size_t)n]);
        const double size = (stress > 0.0 ? stress : 1.0) * widest / stiffest;
        j->length[i] = size / scale;
        j->force[i] = size * scale;
    }
}

/* The positions of a pass, where the program has chosen them: in order, from --from to --to. */
static rb_status read_positions(restored *j, rb_message *why)
{
    const json_t *table = json_object_get(j->root, "table");
    const int all = (int)json_array_size(json_object_get(table, "x")),
              passes = j->crack.passes > 0 ? j->crack.passes : 1, n = all / passes;
    if (j->crack.unloaded || rb_case_has_steps(j->resolved) || j->resolved->rc.steps > 0)
        return RB_OK;
    if (n < 2)
        return rb_fail(why, RB_EFORMAT, "table has no positions");
    j->r->position = rb_alloc((size_t)all, 1);
    if (!j->r->position)
        return RB_ENOMEM;
    j->r->positions = n;
    const rb_status s = rb_certificate_list(j->c, table, "x", all, j->r->position, why);
    for (int i = 1; i < n && s == RB_OK; i++)
        if (!(j->r->position[i] > j->r->position[i - 1]))
            rb_certificate_violated(j->c, "table.x: position %d, %.17g, is not behind %.17g", i,
                                    j->r->position[i], j->r->position[i - 1]);
    return s;
}

/* The crack with what is stored of its faces, under the contact that is restored. */
static rb_status rebuild(restored *j, rb_message *why)
{
    rb_status s = read_positions(j, why);

    if (s == RB_OK)
        s = rb_case_crack_follow(j->resolved, &j->crack, &rb_case_crack_own_mesh, j->r, &j->track,
                                 why);
    if (s == RB_OK && j->r->positions > 0) {
        const rb_case_crack l = rb_case_crack_lengths(j->resolved, &j->crack, j->r->half_width);
        const double *at = j->r->position, slack = 1e-9 * j->r->half_width;
        rb_certificate_expect(j->c, "table.x: --from", at[0], l.from, slack);
        rb_certificate_expect(j->c, "table.x: --to", at[j->r->positions - 1], l.to, slack);
    }
    const json_t *places = json_object_get(json_object_get(j->root, "faces"), "x_mm"),
                 *x = json_object_get(json_object_get(j->root, "table"), "x");
    const int n = j->crack.elements - (j->crack.depth > 0.0);
    const double steps_wanted = (double)j->track.n * j->r->passes;
    const int steps = (int)json_array_size(x);

    if (s == RB_OK && /* before anything large is computed */
        ((int)json_array_size(places) != n || steps != steps_wanted))
        return rb_fail(why, RB_EFORMAT, "expected %d nodes in faces, %.0f positions in table", n,
                       steps_wanted);
    if (s == RB_OK)
        s = rb_crack_create(&j->r->shape, &j->body, why);
    if (s != RB_OK)
        return s;
    const int elements = j->crack.coupled ? j->r->contact.solution.n : 0;
    j->T = rb_alloc((size_t)n, 7);
    j->gap = rb_alloc((size_t)elements + 1, 3);
    s = j->T && j->gap ? rb_crack_history_alloc(j->body, steps, elements, &j->stored) : RB_ENOMEM;
    if (s == RB_OK)
        s = rb_crack_history_alloc(j->body, steps, elements, &j->r->history);
    if (s != RB_OK)
        return s;
    j->hat = j->T + 4 * n;
    j->length = j->hat + n;
    j->force = j->length + n;
    j->slip = j->gap + elements;
    j->none = j->slip + elements;
    j->stored.n = j->r->history.n = steps;
    rb_crack_places(j->body, NULL, NULL, j->hat, NULL, NULL);
    set_scales(j);
    s = read_history(j, why);
    return s == RB_OK ? find_per_D(j, why) : s;
}

/* ---- Laws -------------------------------------------------------------------------- */

/* D = F (T + r + p_f e) of step k. */
static rb_status displace(restored *j, int k, rb_message *why)
{
    const rb_crack_history *h = &j->stored;
    const rb_case_crack_track *t = &j->track;
    const int n = h->nodes, step = k % t->n;
    const rb_bem_edge_load *load = t->loads > 0 ? &t->load[t->loads > 1 ? step : 0] : NULL;
    const rb_bem_edge_load coupled = {h->elements, t->ends, h->wheel + k * h->elements, j->none};
    const rb_status s = rb_crack_load(j->body, h->wheel ? &coupled : load, t->kind, t->x[step],
                                      rb_case_crack_tension(&j->crack, &j->track, step), j->T);

    if (s != RB_OK)
        return rb_fail(why, s, "step %d: %s", k + 1, rb_status_text(s));
    for (int i = 0; i < 2 * n; i++)
        j->T[i] += h->r[(size_t)k * 2 * (size_t)n + (size_t)i] +
                   (i < n ? h->fluid_pressure[k] * j->hat[i] : 0.0);
    cblas_dgemv(CblasColMajor, CblasNoTrans, 2 * n, 2 * n, 1.0, rb_crack_flexibility(j->body),
                2 * n, j->T, 1, 0.0, j->r->history.D + (size_t)k * 2 * (size_t)n, 1);
    return RB_OK;
}

/* Gaps, pressures and load of a contact that feels the crack in step k: by Betti's
 * theorem the crack moves the surface of B by -C'D, C: of unit forces on the elements. */
static rb_status judge_wheel(restored *j, int k)
{
    const rb_crack_history *h = &j->stored;
    const rb_contact_problem *problem = &j->r->contact.model.problem;
    const int n = h->nodes, m = h->elements;
    const double *p = h->wheel + k * m, *ends = j->track.ends,
                 *D = j->r->history.D + (size_t)k * 2 * (size_t)n;
    const double load = j->r->contact.solution.normal_load;
    const double slack = TOLERANCE * problem->gap_length;
    double carried = 0.0, weighted = 0.0, sum = 0.0;

    memcpy(j->gap, problem->d_N, (size_t)m * sizeof *j->gap);
    rb_contact_operator_add(problem->op, p, j->none, j->gap, j->slip);
    for (int i = 0; i < m; i++) {
        const double width = ends[i + 1] - ends[i], unit = 1.0 / width;
        const rb_bem_edge_load strip = {1, ends + i, &unit, j->none};
        const rb_status s =
            rb_crack_load(j->body, &strip, RB_CRACK_STRIPS, j->track.x[k % j->track.n], 0.0, j->T);
        if (s != RB_OK)
            return s;
        j->gap[i] += cblas_ddot(2 * n, j->T, 1, D, 1);
        carried += p[i] * width;
        weighted += p[i] * j->gap[i];
        sum += p[i];
    }
    for (int i = 0; i < m; i++) { /* against the approach that fits the contact */
        const double gap = j->gap[i] - weighted / sum;
        if (p[i] < 0.0 || gap < -slack || (p[i] > 0.0 && gap > slack))
            rb_certificate_violated(j->c, "contact: element %d: gap %.3g, pressure %.3g", i + 1,
                                    gap, p[i]);
    }
    if (p[0] > 0.0 || p[m - 1] > 0.0)
        rb_certificate_violated(j->c, "the contact reaches an end of its elements");
    rb_certificate_expect(j->c, "contact: its load", carried, load, 1e-9 * load);
    return RB_OK;
}

/* Contact and friction of node i in step k; before: the slips of all nodes until then.  Returns how
 * far they are off. */
static double judge_node(restored *j, int k, int i, const double *before)
{
    const rb_crack_history *h = &j->stored, *again = &j->r->history;
    const int n = h->nodes, zone = h->zone[(size_t)k * (size_t)n + (size_t)i];
    const size_t N = (size_t)k * 2 * (size_t)n + (size_t)i, T = N + (size_t)n;
    const double gap = again->D[N], mu = j->crack.friction, p = h->r[N], q = h->r[T];
    const double slip = again->D[T] - before[i], length = j->length[i], force = j->force[i];
    const double ps = p / force, qs = q / force, ls = slip / length, most = mu * fmax(ps, 0.0);
    double off = fabs(fmin(gap / length, ps));

    off = fmax(off, fabs(qs) - mu * ps);
    off = fmax(off, fabs(qs - fmax(-most, fmin(most, qs - ls))));
    if (j->c->judges && !(off <= TOLERANCE))
        rb_certificate_violated(j->c,
                                "faces: node %d: opening %.3g, pressure force %.3g, friction force "
                                "%.3g, slip %.3g (off by %.2g)",
                                i + 1, gap, p, q, slip, off);
    if (j->c->judges && ((zone == RB_ZONE_SEPARATED) != (p <= TOLERANCE * force) ||
                         (zone == RB_ZONE_SLIP_NEGATIVE && fabs(qs + most) > TOLERANCE) ||
                         (zone == RB_ZONE_SLIP_POSITIVE && fabs(qs - most) > TOLERANCE) ||
                         (zone == RB_ZONE_STICK && fabs(ls) > TOLERANCE)))
        rb_certificate_violated(j->c, "faces: zone of node %d is %d", i + 1, zone);
    return off;
}

/* The fluid in step k (C7): the pressure that a dry crack has, or one that is given; of trapped
 * fluid its volume, and what its pressure may be.  before: the volume until then. */
static void follow_fluid(restored *j, int k, double before)
{
    const rb_crack_history *h = &j->stored;
    rb_crack_history *again = &j->r->history;
    const rb_case_crack_track *t = &j->track;
    const int n = h->nodes, step = k % t->n;
    const double p_f = h->fluid_pressure[k],
                 volume = cblas_ddot(n, j->hat, 1, again->D + (size_t)k * 2 * (size_t)n, 1),
                 slack = TOLERANCE * cblas_ddot(n, j->hat, 1, j->length, 1);

    again->fluid_pressure[k] = again->fluid_volume[k] = 0.0;
    if (j->crack.fluid == RB_CRACK_PRESSURE && t->loads > 0) {
        again->fluid_pressure[k] = rb_crack_pressure(&t->load[t->loads > 1 ? step : 0], t->kind,
                                                     j->r->shape.path.x[0] - t->x[step]);
    }
    if (j->crack.fluid != RB_CRACK_TRAPPED)
        return;
    /* Where it is shut in, its pressure may open the mouth. */
    const int open = h->zone[(size_t)k * (size_t)n] == RB_ZONE_SEPARATED && p_f == 0.0;
    const double V = open ? volume : before;
    again->fluid_pressure[k] = p_f;
    again->fluid_volume[k] = V;
    if (j->c->judges &&
        (p_f < 0.0 || volume < V - slack || (p_f > 0.0 && fabs(volume - V) > slack)))
        rb_certificate_violated(
            j->c, "fluid: pressure %.3g, volume of the crack %.17g, of the fluid %.17g", p_f,
            volume, V);
}

/* What step k is written with: its place, stress intensities, lengths. */
static void record_position(restored *j, int k)
{
    rb_crack_history *again = &j->r->history;
    const int n = again->nodes;
    double *D = again->D + (size_t)k * 2 * (size_t)n;
    const int *zone = again->zone + (size_t)k * (size_t)n;

    for (int i = 0; i < n; i++) {
        D[i] = zone[i] == RB_ZONE_SEPARATED ? D[i] : 0.0;
        again->open_length[k] += zone[i] == RB_ZONE_SEPARATED ? j->hat[i] : 0.0;
        again->stick_length[k] += zone[i] == RB_ZONE_STICK ? j->hat[i] : 0.0;
    }
    again->x[k] = j->track.x[k % j->track.n];
    again->K_I[k] = j->per_D * D[n - 1];
    again->K_II[k] = j->per_D * D[2 * n - 1];
    if (again->K_I_upper) {
        again->K_I_upper[k] = j->per_D * D[0];
        again->K_II_upper[k] = j->per_D * D[n];
    }
    if (again->max_pressure)
        again->max_pressure[k] = rb_norm_inf((size_t)again->elements,
                                             again->wheel + (size_t)k * (size_t)again->elements);
}

/* Step by step, each from the one before; where the mouth closes between two of them and trapped
 * fluid counts from there, from the state just before. */
static rb_status follow_crack(restored *j, rb_message *why)
{
    rb_crack_history *again = &j->r->history;
    const rb_crack_history *h = &j->stored;
    const size_t n = (size_t)h->nodes, apart = 2 * n;
    const rb_crack_passage passage = rb_case_crack_passage(&j->crack, &j->track);
    const double stress = largest_stress(j);
    rb_crack_state before = {0};
    rb_status s = rb_crack_state_alloc(j->body, &before);

    memcpy(again->r, h->r, (size_t)h->n * apart * sizeof *h->r);
    memcpy(again->zone, h->zone, (size_t)h->n * n * sizeof *h->zone);
    if (h->wheel)
        memcpy(again->wheel, h->wheel, (size_t)(h->n * h->elements) * sizeof *h->wheel);
    for (int k = 0; k < h->n && s == RB_OK; k++) {
        double off = 0.0;
        j->c->step = k + 1;
        if (k > 0) {
            memcpy(before.D, again->D + (size_t)(k - 1) * apart, apart * sizeof *before.D);
            memcpy(before.zone, h->zone + (size_t)(k - 1) * n, n * sizeof *before.zone);
            before.fluid_pressure = again->fluid_pressure[k - 1];
            before.volume = again->fluid_volume[k - 1];
            s = rb_crack_close(j->body, &passage, k % j->track.n, stress, j->T, &before, why);
        }
        if (s == RB_OK)
            s = displace(j, k, why);
        if (s == RB_OK && h->wheel && j->c->judges)
            s = judge_wheel(j, k);
        for (size_t i = 0; i < n && s == RB_OK; i++)
            off = fmax(off, judge_node(j, k, (int)i, before.D + n));
        if (s == RB_OK) {
            record_position(j, k);
            follow_fluid(j, k, before.volume);
            again->residual[k] = off;
        }
    }
    j->c->step = 0;
    rb_crack_state_free(&before);
    return s;
}

/* The largest tension ahead of the tip by trying all directions, which no formula for the
 * direction enters. */
static void judge_direction(restored *j)
{
    const rb_crack_history *h = &j->r->history;
    double most = 0.0, size = 0.0;

    for (int k = h->n - j->track.n; k < h->n; k++)
        for (int i = 0; i < DIRECTIONS; i++) {
            const double theta = PI * (2.0 * i / DIRECTIONS - 1.0), c = cos(0.5 * theta);
            most = fmax(most, c * (h->K_I[k] * c * c - 1.5 * h->K_II[k] * sin(theta)));
            size = fmax(size, fmax(fabs(h->K_I[k]), fabs(h->K_II[k])));
        }
    rb_certificate_expect(j->c, "K_theta_max by trying directions", j->r->summary.K_theta_max, most,
                          3e-6 * size);
}

/* ---- The whole --------------------------------------------------------------------- */

rb_status rb_certificate_restore_crack(rb_certificate *c, const json_t *root, rb_case *words,
                                       rb_case_crack_result *r, rb_message *why)
{
    restored j = {.c = c,
                  .root = root,
                  .resolved = rb_case_resolved(words),
                  .crack = *rb_case_crack_of(words),
                  .r = r};
    const json_t *contact = json_object_get(root, "contact");
    const rb_certificate_contact stored = {contact,
                                           json_object_get(root, "contact_table"),
                                           json_object_get(root, "history"),
                                           rb_certificate_member(contact, "residual"),
                                           NAN,
                                           NAN};
    rb_status s = RB_OK;

    memset(r, 0, sizeof *r);
    j.contact = rb_case_crack_contact(j.resolved, &j.crack);
    if (!j.crack.unloaded)
        s = stored.summary && json_object_get(stored.table, "x_mm")
                ? rb_certificate_restore(c, &j.contact, &stored, &r->contact, &r->states, why)
                : rb_certificate_refuse(c, "contact_table has no elements", why);
    if (s == RB_OK)
        s = rebuild(&j, why);
    if (s == RB_OK)
        s = follow_crack(&j, why);
    if (s == RB_OK) {
        /* Residuals that are small enough are believed: they are those of scaled problems. */
        const double printed = rb_certificate_member(json_object_get(root, "summary"), "residual");
        r->summary = rb_case_crack_summarise(&r->history, r->passes);
        c->found->residual = fmax(c->found->residual, r->summary.residual);
        r->summary.residual = printed >= 0.0 && printed <= TOLERANCE ? printed : TOLERANCE;
        if (c->judges)
            judge_direction(&j);
    }
    rb_case_crack_track_free(&j.track);
    rb_crack_history_free(&j.stored);
    rb_crack_free(j.body);
    free(j.T);
    free(j.gap);
    return s;
}
