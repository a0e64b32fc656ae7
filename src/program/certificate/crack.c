/* The certificate of a crack: the contact is checked as a result of its own; from its
 * tractions and those of the faces that are printed the openings and the slips are
 * computed again at every position, then the laws of the faces and of the fluid, the
 * stress intensities and what the pass comes to.  Nothing is solved. */
#include "program/certificate/internal.h"
#include "rollbem/contact.h"
#include "rollbem/crack.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;
static const double EDGE_CRACK = 1.1215222552; /* Koiter: K_I/sqrt(pi a), unit tension */
static const double TOLERANCE = 1e-9;          /* of the scaled laws */
enum { DIRECTIONS = 3600 };

typedef struct {
    rb_certificate c; /* of whose fields only those of the output are used */
    const json_t *root;
    const rb_resolved_case *resolved;
    rb_case_crack crack;
    rb_case_crack_result r; /* what is printed of contact and faces, and what follows */
    rb_case_crack_track track;
    rb_crack *body;
    rb_crack_history again;    /* computed */
    double *T, *hat;           /* 2n: load; n */
    double *length, *force;    /* n: typical D and r of a node */
    double exact;              /* of D over its length */
    double per_D;              /* K over D next to a tip */
    rb_rolling_model wheel;    /* of a coupled contact, whose pressures are in r.history */
    double *gap, *slip, *none; /* of its elements; gap owns them */
} assessment;

/* ---- Inputs ------------------------------------------------------------------------ */

static rb_status check_kind(const char *name, const json_t *root, rb_message *why)
{
    static const char *const known[] = {"schema", "version",       "command",    "conventions",
                                        "notes",  "units",         "input_hash", "inputs",
                                        "crack",  "contact",       "summary",    "table",
                                        "faces",  "contact_table", "history",    NULL};

    if (json_object_get(root, "growth"))
        return rb_certificate_refuse(
            name, "a crack that grows: the faces at its other lengths are not printed", why);
    if (!json_is_object(json_object_get(root, "faces")))
        return rb_certificate_refuse(
            name, "its stress intensities follow from the faces: take --states", why);
    return rb_certificate_head(name, root, known, why);
}

/* ---- Contact ----------------------------------------------------------------------- */

/* The contact as a result of its own. */
static rb_status check_contact(assessment *j, rb_case *words, rb_message *why)
{
    static const char *const shared[][2] = {{"schema", "schema"},   {"version", "version"},
                                            {"units", "units"},     {"conventions", "conventions"},
                                            {"contact", "summary"}, {"contact_table", "table"},
                                            {"history", "history"}};
    rb_certificate_outcome own = {0};
    const json_t *printed = json_object_get(j->root, "notes");
    json_t *one = json_object(), *notes = json_array();
    rb_status s = RB_OK;

    /* a coupled contact has equal elements, whatever the case says of a steady one */
    if (j->crack.coupled && j->resolved->rc.formulation == RB_STEADY) {
        s = rb_case_set(words, "mesh", "uniform", RB_GIVEN_ARGUMENT, why);
        if (s == RB_OK)
            s = rb_case_set(words, "slip-operator", "upstream", RB_GIVEN_ARGUMENT, why);
        if (s == RB_OK)
            s = rb_case_resolve(words, why);
    }
    rb_case_set_purpose(words, RB_CASE_SINGLE); /* its inputs are without those of the crack */
    for (size_t k = 0; k < sizeof shared / sizeof *shared; k++) {
        json_t *part = json_object_get(j->root, shared[k][0]);
        if (part)
            rb_report_json_set(&one, shared[k][1], json_incref(part));
    }
    /* the notes on the contact come before those on the crack */
    for (size_t k = 0; k + (size_t)j->r.notes < json_array_size(printed); k++)
        rb_report_json_append(&notes, json_incref(json_array_get(printed, k)));
    rb_report_json_set(&one, "notes", notes);
    rb_report_json_set(&one, "inputs", rb_report_json_inputs(words));
    rb_report_json_set(&one, "input_hash", rb_report_json_input_hash(words));
    if (s == RB_OK)
        s = one ? rb_certificate_check(j->c.out, j->c.name, one, words, &own, why) : RB_ENOMEM;
    json_decref(one);
    j->c.found->violations += own.violations;
    j->c.found->numbers += own.numbers;
    j->c.found->residual = own.residual;
    return s;
}

/* ---- What is printed --------------------------------------------------------------- */

/* Elements and tractions of the contact, of one state or of all steps, where the track
 * looks for them. */
static rb_status read_contact(assessment *j, rb_message *why)
{
    const json_t *table = json_object_get(j->root, "contact_table"),
                 *history = json_object_get(j->root, "history"),
                 *states = json_object_get(history, "states");
    const int n = (int)json_array_size(json_object_get(table, "x_mm"));
    const int steps = (int)json_array_size(json_object_get(states, "p_MPa"));
    const char *name = j->c.name;
    rb_rolling_states *to = &j->r.states;
    rb_rolling_history *run = &j->r.contact.history;
    rb_rolling_solution *one = &j->r.contact.solution;
    if (n < 3)
        return rb_fail(why, RB_EFORMAT, "contact_table has no elements");
    rb_status s = rb_rolling_states_alloc(n, steps > 0 ? steps : 1, to);

    if (s == RB_OK)
        s = rb_certificate_column(name, table, "x_mm", n, to->x, why);
    if (s == RB_OK)
        s = rb_certificate_column(name, table, "h_mm", n, to->h, why);
    if (s == RB_OK && steps == 0) {
        s = rb_certificate_column(name, table, "p_MPa", n, to->p, why);
        if (s == RB_OK)
            s = rb_certificate_column(name, table, "q_MPa", n, to->q, why);
        one->n = n;
        one->x = to->x; /* lent, see end */
        one->h = to->h;
        one->p = to->p;
        one->q = to->q;
    } else if (s == RB_OK) {
        s = rb_certificate_lists(name, "", states, "p_MPa", steps, n, (size_t)n, to->p, why);
        if (s == RB_OK)
            s = rb_certificate_lists(name, "", states, "q_MPa", steps, n, (size_t)n, to->q, why);
        run->distance = rb_alloc((size_t)steps, 1);
        if (s == RB_OK)
            s = run->distance
                    ? rb_certificate_column(name, history, "distance", steps, run->distance, why)
                    : RB_ENOMEM;
        run->half_width = rb_certificate_member(history, "half_width");
    }
    return s;
}

/* The table, and the faces at every position. */
static rb_status read_history(assessment *j, rb_message *why)
{
    const json_t *faces = json_object_get(j->root, "faces"),
                 *table = json_object_get(j->root, "table");
    rb_crack_history *h = &j->r.history;
    const int n = h->nodes, steps = h->n;
    const size_t apart = 2 * (size_t)n;
    double *zone = rb_alloc((size_t)steps, (size_t)n);
    rb_status s = zone ? RB_OK : RB_ENOMEM;

    const struct {
        const char *key;
        int n;
        size_t apart;
        double *to;
    } lists[] = {{"opening_mm", n, apart, h->D},
                 {"sliding_mm", n, apart, h->D + n},
                 {"p_MPa", n, apart, h->r},
                 {"q_MPa", n, apart, h->r + n},
                 {"contact_p_MPa", h->elements, (size_t)h->elements, h->wheel},
                 {"zone", n, (size_t)n, zone}};

    for (size_t k = 0; k < sizeof lists / sizeof *lists && s == RB_OK; k++)
        if (lists[k].to)
            s = rb_certificate_lists(j->c.name, "", faces, lists[k].key, steps, lists[k].n,
                                     lists[k].apart, lists[k].to, why);
    if (s == RB_OK)
        s = rb_certificate_column(j->c.name, faces, "fluid_volume_mm2", steps, h->fluid_volume,
                                  why);
    for (int k = 0; k < rb_case_crack_columns.n && s == RB_OK; k++) {
        const rb_rolling_result *row = &rb_case_crack_columns.row[k];
        double *column = rb_rolling_column(row, h);
        if (column)
            s = rb_certificate_column(j->c.name, table, row->name, steps, column, why);
    }
    for (int i = 0; i < steps * n && s == RB_OK; i++) {
        if (zone[i] >= 0.0 && zone[i] <= 3.0 && zone[i] == floor(zone[i]))
            h->zone[i] = (int)zone[i];
        else
            s = rb_fail(why, RB_EFORMAT, "%s: faces: zone %g", j->c.name, zone[i]);
    }
    for (int i = 0; i < 2 * steps * n; i++) /* nodal forces */
        h->r[i] *= j->hat[i % n];
    free(zone);
    return s;
}

/* ---- The crack again --------------------------------------------------------------- */

/* K over D of the node next to a tip: from as many elements along a crack of 90 degrees
 * under unit tension, at the surface or deep below it, whose K_I is known. */
static rb_status find_per_D(assessment *j, rb_message *why)
{
    rb_crack_shape straight = j->r.shape;
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

/* Typical displacements and forces of the nodes, as the solver scales them. */
static void set_scales(assessment *j)
{
    const int n = rb_crack_nodes(j->body);
    const double *F = rb_crack_flexibility(j->body);
    double stress = fabs(j->crack.remote_stress), widest = 0.0, stiffest = 0.0;

    for (int k = 0; k < j->track.loads; k++)
        for (int i = 0; i < j->track.load[k].n; i++)
            stress = fmax(stress, fmax(fabs(j->track.load[k].p[i]), fabs(j->track.load[k].q[i])));
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
    const double printed = rb_certificate_member(json_object_get(j->root, "summary"), "residual");
    j->exact = 10.0 * fmax(printed < 1e-10 ? printed : 1e-10, 1e-13);
}

static rb_status rebuild(assessment *j, rb_message *why)
{
    rb_status s = j->crack.unloaded ? RB_OK : read_contact(j, why);

    if (s == RB_OK)
        s = rb_case_crack_follow(j->resolved, &j->crack, &j->r, &j->track, why);
    const json_t *places = json_object_get(json_object_get(j->root, "faces"), "x_mm"),
                 *x = json_object_get(json_object_get(j->root, "table"), "x");
    const int n = j->crack.elements - (j->crack.depth > 0.0);
    const double steps_wanted = (double)j->track.n * j->r.passes;
    const int steps = (int)json_array_size(x);
    if (s == RB_OK && /* before anything large is computed */
        ((int)json_array_size(places) != n || steps != steps_wanted))
        return rb_fail(why, RB_EFORMAT, "expected %d nodes in faces, %.0f positions in table", n,
                       steps_wanted);
    if (s == RB_OK)
        s = rb_crack_create(&j->r.shape, &j->body, why);
    if (s != RB_OK)
        return s;
    j->T = rb_alloc((size_t)n, 5);
    const int elements = j->crack.coupled ? j->r.contact.solution.n : 0;
    s = j->T ? rb_crack_history_alloc(j->body, steps, elements, &j->r.history) : RB_ENOMEM;
    if (s == RB_OK)
        s = rb_crack_history_alloc(j->body, steps, elements, &j->again);
    if (s == RB_OK && elements > 0) {
        /* The contact that feels the crack, on the elements of contact_table. */
        const rb_rolling_solution *of = &j->r.contact.solution;
        j->gap = rb_alloc((size_t)elements, 3);
        if (!j->gap)
            return RB_ENOMEM;
        j->slip = j->gap + elements;
        j->none = j->slip + elements;
        s = rb_rolling_model_of_result(&j->resolved->rc, NULL,
                                       &(rb_rolling_elements){elements, of->x, of->h, 1}, &j->wheel,
                                       why);
    }
    if (s != RB_OK)
        return s;
    j->hat = j->T + 2 * n;
    j->length = j->hat + n;
    j->force = j->length + n;
    j->r.history.n = j->again.n = steps;
    rb_crack_places(j->body, NULL, NULL, j->hat, NULL, NULL);
    set_scales(j);
    s = read_history(j, why);
    return s == RB_OK ? find_per_D(j, why) : s;
}

/* ---- Laws -------------------------------------------------------------------------- */

/* D = F (T + r + p_f e) of step k. */
static rb_status displace(assessment *j, int k, rb_message *why)
{
    const rb_crack_history *h = &j->r.history;
    const rb_case_crack_track *t = &j->track;
    const int n = h->nodes, step = k % t->n;
    const rb_bem_edge_load *load = t->loads > 0 ? &t->load[t->loads > 1 ? step : 0] : NULL;
    const rb_bem_edge_load coupled = {h->elements, t->ends, h->wheel + k * h->elements, j->none};
    const rb_status s = rb_crack_load(j->body, h->wheel ? &coupled : load, t->x[step],
                                      j->crack.remote_stress, j->T);

    if (s != RB_OK)
        return rb_fail(why, s, "step %d: %s", k + 1, rb_status_text(s));
    for (int i = 0; i < 2 * n; i++)
        j->T[i] += h->r[(size_t)k * 2 * (size_t)n + (size_t)i] +
                   (i < n ? h->fluid_pressure[k] * j->hat[i] : 0.0);
    cblas_dgemv(CblasColMajor, CblasNoTrans, 2 * n, 2 * n, 1.0, rb_crack_flexibility(j->body),
                2 * n, j->T, 1, 0.0, j->again.D + (size_t)k * 2 * (size_t)n, 1);
    return RB_OK;
}

/* Gaps, pressures and load of a contact that feels the crack in step k: by Betti's
 * theorem the crack moves the surface of B by -C'D, C: of unit forces on the elements. */
static rb_status check_wheel(assessment *j, int k)
{
    const rb_crack_history *h = &j->r.history;
    const rb_contact_problem *problem = &j->wheel.problem;
    const int n = h->nodes, m = h->elements;
    const double *p = h->wheel + k * m, *ends = j->track.ends,
                 *D = j->again.D + (size_t)k * 2 * (size_t)n;
    const double load = rb_certificate_member(json_object_get(j->root, "contact"), "normal_load");
    const double slack = TOLERANCE * problem->gap_length;
    double carried = 0.0, weighted = 0.0, sum = 0.0;

    memcpy(j->gap, problem->d_N, (size_t)m * sizeof *j->gap);
    rb_contact_operator_add(problem->op, p, j->none, j->gap, j->slip);
    for (int i = 0; i < m; i++) {
        const double width = ends[i + 1] - ends[i], unit = 1.0 / width;
        const rb_bem_edge_load strip = {1, ends + i, &unit, j->none};
        const rb_status s = rb_crack_load(j->body, &strip, j->track.x[k % j->track.n], 0.0, j->T);
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
            rb_certificate_violated(&j->c, "contact: element %d: gap %.3g, pressure %.3g", i + 1,
                                    gap, p[i]);
        j->again.max_pressure[k] = fmax(j->again.max_pressure[k], p[i]);
    }
    if (p[0] > 0.0 || p[m - 1] > 0.0)
        rb_certificate_violated(&j->c, "the contact reaches an end of its elements");
    rb_certificate_expect(&j->c, "contact: its load", 0, carried, load, 1e-9 * load);
    return RB_OK;
}

/* 1: the fluid comes and goes.  Where it is shut in, its pressure may open the mouth. */
static int is_open(const assessment *j, int k)
{
    const rb_crack_history *h = &j->r.history;
    return h->zone[(size_t)k * (size_t)h->nodes] == RB_ZONE_SEPARATED &&
           h->fluid_pressure[k] == 0.0;
}

/* 1: slips of step k do not count from those that are printed before it, because the
 * place where the mouth closes lies between. */
static int follows_closing(const assessment *j, int k)
{
    return j->crack.locate_closing && k % j->track.n > 0 && is_open(j, k - 1) && !is_open(j, k);
}

/* Contact and friction of node i in step k. */
static void check_node(assessment *j, int k, int i)
{
    const rb_crack_history *h = &j->r.history;
    const int n = h->nodes, zone = h->zone[(size_t)k * (size_t)n + (size_t)i];
    const size_t N = (size_t)k * 2 * (size_t)n + (size_t)i, T = N + (size_t)n;
    const double gap = j->again.D[N], mu = j->crack.friction, p = h->r[N], q = h->r[T];
    const double slip = h->D[T] - (k > 0 ? h->D[T - 2 * (size_t)n] : 0.0);
    const double length = j->length[i], force = j->force[i];
    const double ps = p / force, qs = q / force, ls = slip / length, most = mu * fmax(ps, 0.0);
    double off = fabs(fmin(gap / length, ps));

    off = fmax(off, fabs(qs) - mu * ps);
    if (!follows_closing(j, k))
        off = fmax(off, fabs(qs - fmax(-most, fmin(most, qs - ls))));
    if (!(off <= TOLERANCE))
        rb_certificate_violated(&j->c,
                                "faces: node %d: opening %.3g, pressure force %.3g, friction force "
                                "%.3g, slip %.3g (off by %.2g)",
                                i + 1, gap, p, q, slip, off);
    if ((zone == RB_ZONE_SEPARATED) != (p <= TOLERANCE * force) ||
        (zone == RB_ZONE_SLIP_NEGATIVE && fabs(qs + most) > TOLERANCE) ||
        (zone == RB_ZONE_SLIP_POSITIVE && fabs(qs - most) > TOLERANCE) ||
        (zone == RB_ZONE_STICK && !follows_closing(j, k) && fabs(ls) > TOLERANCE))
        rb_certificate_violated(&j->c, "faces: zone of node %d is %d", i + 1, zone);
    if (zone != RB_ZONE_SEPARATED)
        j->again.D[N] = 0.0;
    j->again.residual[k] = fmax(j->again.residual[k], off);
}

/* The rule of the fluid (C7). */
static void check_fluid(assessment *j, int k)
{
    rb_crack_history *h = &j->r.history;
    const rb_case_crack_track *t = &j->track;
    const int n = h->nodes, step = k % t->n;
    const double p_f = h->fluid_pressure[k],
                 volume = cblas_ddot(n, j->hat, 1, h->D + (size_t)k * 2 * (size_t)n, 1);
    const double before = k > 0 ? h->fluid_volume[k - 1] : 0.0, V = h->fluid_volume[k];
    const double slack = TOLERANCE * cblas_ddot(n, j->hat, 1, j->length, 1);
    double want = 0.0;

    if (j->crack.fluid == RB_CRACK_PRESSURE && t->loads > 0) {
        const rb_bem_edge_load *load = &t->load[t->loads > 1 ? step : 0];
        const double mouth = j->r.shape.path.x[0] - t->x[step];
        for (int i = 0; i < load->n; i++)
            if (load->x[i] <= mouth && mouth < load->x[i + 1])
                want = load->p[i];
    }
    if (j->crack.fluid != RB_CRACK_TRAPPED) {
        rb_certificate_expect(&j->c, "fluid_pressure", 0, p_f, want, 1e-9 * want);
        rb_certificate_expect(&j->c, "faces.fluid_volume_mm2", 0, V, 0.0, 0.0);
        return;
    }
    if (is_open(j, k))
        rb_certificate_expect(&j->c, "faces.fluid_volume_mm2", 0, V, volume, slack);
    else if (!follows_closing(j, k)) /* there it is that of the place in between */
        rb_certificate_expect(&j->c, "faces.fluid_volume_mm2", 0, V, before, 0.0);
    if (p_f < 0.0 || volume < V - slack || (p_f > 0.0 && fabs(volume - V) > slack))
        rb_certificate_violated(
            &j->c, "fluid: pressure %.3g, volume of the crack %.17g, of the fluid %.17g", p_f,
            volume, V);
}

/* Everything that is printed of step k against what was computed. */
static void compare_step(assessment *j, int k)
{
    const rb_crack_history *h = &j->r.history;
    rb_crack_history *again = &j->again;
    const int n = h->nodes;
    const double *D = again->D + (size_t)k * 2 * (size_t)n;

    again->x[k] = j->track.x[k % j->track.n];
    again->K_I[k] = j->per_D * D[n - 1];
    again->K_II[k] = j->per_D * D[2 * n - 1];
    if (again->K_I_upper) {
        again->K_I_upper[k] = j->per_D * D[0];
        again->K_II_upper[k] = j->per_D * D[n];
    }
    for (int i = 0; i < n; i++) {
        const int zone = h->zone[(size_t)k * (size_t)n + (size_t)i];
        again->open_length[k] += zone == RB_ZONE_SEPARATED ? j->hat[i] : 0.0;
        again->stick_length[k] += zone == RB_ZONE_STICK ? j->hat[i] : 0.0;
    }
    again->fluid_pressure[k] = h->fluid_pressure[k];
    for (int i = 0; i < 2 * n; i++) {
        const size_t at = (size_t)k * 2 * (size_t)n + (size_t)i;
        rb_certificate_expect(&j->c, i < n ? "faces.opening_mm" : "faces.sliding_mm", i % n + 1,
                              h->D[at], again->D[at],
                              1e-9 * fabs(again->D[at]) + j->exact * j->length[i % n]);
    }
    for (int r = 0; r < rb_case_crack_columns.n; r++) {
        const rb_rolling_result *row = &rb_case_crack_columns.row[r];
        if (!rb_rolling_has_column(row, h))
            continue;
        const double want = rb_rolling_entry(row, again, k);
        const double size =
            row->error_bar ? j->per_D * j->exact * j->length[n - 1] : 1e-12 * j->r.half_width;
        rb_certificate_expect(&j->c, row->name, 0, rb_rolling_entry(row, h, k), want,
                              1e-9 * fabs(want) + size);
    }
}

/* ---- Summary ----------------------------------------------------------------------- */

/* The largest tension ahead of the tip by trying all directions, which no formula for the
 * direction enters. */
static void check_direction(assessment *j)
{
    const rb_crack_history *h = &j->r.history;
    const double printed =
        rb_certificate_member(json_object_get(j->root, "summary"), "K_theta_max");
    double most = 0.0, size = 0.0;

    for (int k = h->n - j->track.n; k < h->n; k++)
        for (int i = 0; i < DIRECTIONS; i++) {
            const double theta = PI * (2.0 * i / DIRECTIONS - 1.0), c = cos(0.5 * theta);
            most = fmax(most, c * (h->K_I[k] * c * c - 1.5 * h->K_II[k] * sin(theta)));
            size = fmax(size, fmax(fabs(h->K_I[k]), fabs(h->K_II[k])));
        }
    rb_certificate_expect(&j->c, "summary.K_theta_max by trying directions", 0, printed, most,
                          3e-6 * size);
}

static double slack_of_summary(const rb_certificate *c, const char *path, double want)
{
    (void)c;
    return strcmp(rb_certificate_last(path), "residual") == 0 ? TOLERANCE : 1e-12 * fabs(want);
}

/* What the program would print of the printed table, notes, places of the nodes. */
static rb_status compare_rest(assessment *j)
{
    static const char *const nodes[] = {"x_mm", "y_mm", "length_mm"};
    const json_t *faces = json_object_get(j->root, "faces");
    rb_crack_history *h = &j->r.history;
    json_t *again = json_object();

    memcpy(h->residual, j->again.residual, (size_t)h->n * sizeof *h->residual);
    j->c.found->residual = fmax(j->c.found->residual, rb_norm_inf((size_t)h->n, h->residual));
    j->r.summary = rb_case_crack_summarise(h, j->r.passes);
    j->r.contact.solution.n = 0; /* judged as a result of its own */
    rb_report_json_crack(&again, &j->r);
    rb_report_json_crack_faces(&again, &j->r);
    if (!again)
        return RB_ENOMEM;
    rb_certificate_compare(&j->c, "summary", 0, json_object_get(j->root, "summary"),
                           json_object_get(again, "summary"), slack_of_summary);
    rb_certificate_compare(&j->c, "crack", 0, json_object_get(j->root, "crack"),
                           json_object_get(again, "crack"), slack_of_summary);
    for (size_t k = 0; k < sizeof nodes / sizeof *nodes; k++)
        rb_certificate_compare(&j->c, nodes[k], 0, json_object_get(faces, nodes[k]),
                               json_object_get(json_object_get(again, "faces"), nodes[k]),
                               slack_of_summary);
    if (json_object_size(faces) != json_object_size(json_object_get(again, "faces")) ||
        json_object_size(json_object_get(j->root, "table")) !=
            json_object_size(json_object_get(again, "table")))
        rb_certificate_violated(&j->c, "table or faces: other columns than expected");
    json_decref(again);
    check_direction(j);
    const json_t *notes = json_object_get(j->root, "notes");
    const size_t all = json_array_size(notes), own = (size_t)j->r.notes;
    for (size_t k = 0; k < own; k++) {
        const json_t *note = all >= own ? json_array_get(notes, all - own + k) : NULL;
        if (!json_is_string(note) || strcmp(json_string_value(note), j->r.note[k]) != 0)
            rb_certificate_violated(&j->c, "notes are not those of this result");
    }
    return RB_OK;
}

/* ---- The whole --------------------------------------------------------------------- */

rb_status rb_certificate_crack(FILE *out, const char *name, const json_t *root, rb_case *words,
                               rb_certificate_outcome *found, rb_message *why)
{
    assessment j = {.c = {.out = out, .name = name, .found = found}, .root = root};
    rb_message reason = {""};

    memset(found, 0, sizeof *found);
    rb_case_crack_set(words);
    rb_status s = check_kind(name, root, why);
    if (s == RB_OK)
        s = rb_certificate_rebuild_case(name, root, words, why);
    if (s == RB_OK) {
        j.resolved = rb_case_resolved(words);
        j.crack = *rb_case_crack_of(words);
    }
    if (s == RB_OK)
        s = rb_case_crack_check(j.resolved, &j.crack, why);
    if (s == RB_OK)
        s = rb_certificate_hash(&j.c, root, rb_report_json_input_hash(words));
    if (s == RB_OK)
        s = rebuild(&j, &reason);
    if (s == RB_OK && !j.crack.unloaded)
        s = check_contact(&j, words, why);
    for (int k = 0; k < j.r.history.n && s == RB_OK; k++) {
        j.c.step = k + 1;
        s = displace(&j, k, &reason);
        if (s == RB_OK && j.r.history.wheel)
            s = check_wheel(&j, k);
        for (int i = 0; i < j.r.history.nodes && s == RB_OK; i++)
            check_node(&j, k, i);
        if (s == RB_OK) {
            check_fluid(&j, k);
            compare_step(&j, k);
        }
    }
    j.c.step = 0;
    if (s == RB_OK)
        s = compare_rest(&j);
    rb_case_crack_track_free(&j.track);
    rb_crack_history_free(&j.again);
    rb_crack_free(j.body);
    free(j.T);
    free(j.gap);
    rb_rolling_model_free(&j.wheel);
    memset(&j.r.contact.solution, 0, sizeof j.r.contact.solution); /* it was lent */
    rb_case_crack_free(&j.r);
    return s != RB_OK && reason.text[0] ? rb_fail(why, s == RB_ENOMEM ? s : RB_EFORMAT,
                                                  "%s: cannot be checked: %s", name, reason.text)
           : s == RB_ENOMEM             ? rb_fail(why, s, "%s: out of memory", name)
                                        : s;
}
