/* A crack under the contact of a case: its options, and the contact as its load. */
#include "analysis/crack/crack.h"
#include "analysis/crack/crack_case.h"
#include "analysis/crack/internal.h"
#include "rolling/case/words.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_sort.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Positions farther apart, in half-widths, miss the crack; above NARROW, of what is smaller,
 * the half-width or the crack, extremes lie between them.  The first one stands at least FAR
 * from the mouth. */
static const double WIDE = 0.5, NARROW = 0.1, FAR = 6.0;
/* Of a B that is a cylinder: the deepest place of a crack in a half-plane, in radii. */
static const double DEEPEST = 0.1;
/* Half-width of the potential contact of a coupled crack, in half-widths, and how much wider
 * the next one is where the contact reaches its end. */
static const double ZONE = 1.6, WIDER = 1.3;
enum { INTERVALS = 120, MOST_POSITIONS = 4000, MOST_MARKS = 64, SEARCHES = 3, ZONES = 5 };
/* Nodes of the tractions at an edge (B14): a crack feels their mean over its length. */
enum { EDGE_NODES = 10 };

/* ---- Lengths ----------------------------------------------------------------------- */

/* The unit of the lengths as far as the load tells it; NAN: it does not. */
static double unit_of_load(const rb_resolved_case *c, const rb_case_crack *k)
{
    double load = c->derived.load;

    if (!k->unloaded && rb_case_has_steps(c))
        return NAN;
    for (int i = 0; c->program.load && i < c->program.n; i++)
        load = i > 0 ? fmax(load, c->program.load[i]) : c->program.load[i];
    return isnan(load) ? NAN : rb_rolling_unit_of_distance(&c->rc, load);
}

/* That of the contact as it is solved; NAN: there is none. */
static double unit_of(const rb_resolved_case *c, const rb_case_crack *k,
                      const rb_case_crack_result *r)
{
    const rb_rolling_solution *one = &r->contact.solution;
    const double known = unit_of_load(c, k);

    if (!k->unloaded && rb_case_has_steps(c))
        return r->contact.history.half_width;
    return !isnan(known) || k->unloaded   ? known
           : isnan(one->hertz_half_width) ? one->half_width
                                          : one->hertz_half_width;
}

/* All lengths of a crack in mm; those without a unit are multiples of the half-width a. What is not
 * given follows: --from and --to lie FAR half-widths before and behind the mouth, and a crack grows
 * to twice its length. */
rb_case_crack rb_case_crack_lengths(const rb_resolved_case *c, const rb_case_crack *k, double a)
{
    rb_case_crack l = *k;
    const struct {
        double *length;
        int bit;
    } all[] = {{&l.length, RB_CRACK_LENGTH}, {&l.mouth, RB_CRACK_MOUTH},
               {&l.depth, RB_CRACK_DEPTH},   {&l.from, RB_CRACK_FROM},
               {&l.to, RB_CRACK_TO},         {&l.grow_to, RB_CRACK_GROW_TO}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (!(k->in_mm & all[i].bit) && *all[i].length != 0.0)
            *all[i].length *= a;
    if (isnan(l.from))
        l.from = isnan(a) || (rb_case_has_steps(c) && c->rc.formulation == RB_STATIC)
                     ? 0.0
                     : l.mouth - FAR * a;
    if (isnan(l.to))
        l.to = l.mouth + FAR * a;
    if (isnan(l.grow_to))
        l.grow_to = 2.0 * l.length;
    return l;
}

/* Numbers, not lengths: those have their unit first. */
static rb_status check_sizes(const rb_case_crack *k, rb_message *why)
{
    const struct {
        const char *what;
        double value;
    } sizes[] = {{"crack-friction", k->friction}, {"remote-stress", k->remote_stress}};
    rb_status s = RB_OK;

    for (size_t i = 0; i < sizeof sizes / sizeof *sizes && s == RB_OK; i++)
        s = rb_rolling_check_size(sizes[i].what, sizes[i].value, why);
    for (int i = 0; i < k->remote_stresses.n && s == RB_OK; i++)
        s = rb_rolling_check_size("remote-stress", k->remote_stresses.value[i], why);
    return s;
}

/* Places are differences of coordinates, which a crack that lies far away has no digits for. */
static rb_status check_places(const rb_case_crack *l, double a, rb_message *why)
{
    static const double FARTHEST = 1e8;
    const struct {
        const char *what;
        double value;
    } places[] = {{"crack-length", l->length},
                  {"crack-mouth", l->mouth},
                  {"crack-depth", l->depth},
                  {"from", l->from},
                  {"to", l->to}};

    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const rb_status s = rb_rolling_check_size(places[i].what, places[i].value, why);
        if (s != RB_OK)
            return s;
        if (isfinite(a) && fabs(places[i].value) > FARTHEST * fmax(l->length, a))
            return rb_refuse(why, places[i].what,
                             "at %g half-widths places of the crack have no digits left, "
                             "expected at most %g",
                             places[i].value / a, FARTHEST * fmax(l->length, a) / a);
    }
    return RB_OK;
}

/* The elements of the crack have to resolve the stress of the contact, which varies over the
 * half-width or, close to the surface, over the depth. */
rb_status rb_case_crack_check_elements(const rb_crack_path *path, int n, double a, rb_message *why)
{
    static const double LONGEST = 2.0;
    double *s = rb_alloc((size_t)n + 1, 1), worst = 0.0, length = 0.0;
    rb_crack_element *element = calloc((size_t)n, sizeof *element);
    const int has_memory = s && element;

    if (has_memory) {
        rb_crack_grade(path, n, s);
        rb_crack_place(path, n, s, element);
        length = s[n];
    }
    for (int j = 0; j < n && has_memory; j++) {
        /* The depths of its two ends: the imaginary axis points upwards, out of B. */
        const rb_crack_element *e = &element[j];
        const double from = -cimag(e->from), to = from - e->length * cimag(e->t);
        worst = fmax(worst, e->length / fmax(a, fmin(from, to)));
    }
    free(s);
    free(element);
    if (!has_memory)
        return rb_fail(why, RB_ENOMEM, "crack: out of memory for %d elements", n);
    if (worst > LONGEST)
        return rb_refuse(why, "crack-elements,grow-to,crack-length",
                         "%d elements along a crack of %g half-widths are up to %g times as long "
                         "as the half-width or their depth, expected at most %g",
                         n, length / a, worst, LONGEST);
    return RB_OK;
}

/* What only the unit of the lengths tells. */
static rb_status check_lengths(const rb_resolved_case *c, const rb_case_crack *k, double a,
                               rb_message *why)
{
    const rb_rolling_case *rc = &c->rc;
    const rb_case_crack l = rb_case_crack_lengths(c, k, a);
    const double deepest = l.depth + l.length * fabs(sin(k->angle * M_PI / 180.0));

    if (!(l.length > 0.0 && isfinite(l.mouth) && l.depth >= 0.0))
        return rb_refuse(why, "unloaded",
                         "without --load and --half-width there is no half-width that "
                         "the lengths of the crack could be measured by; give them with a unit, "
                         "such as --crack-length 0.05mm");
    rb_status s = check_places(&l, a, why);
    if (s == RB_OK && !k->unloaded) {
        const double longest = isnan(k->paris) ? l.length : l.grow_to;
        const rb_crack_path path = rb_crack_straight(l.mouth, l.depth, longest, k->angle);
        s = rb_case_crack_check_elements(&path, k->elements, a, why);
    }
    if (s != RB_OK)
        return s;
    if (!k->unloaded && rc->elastic_b && deepest > DEEPEST * fabs(rc->b.radius))
        return rb_refuse(why, "crack-length,crack-depth,radius-b",
                         "body B counts as a half-plane; a crack as deep as %g of "
                         "its radius needs its shape, expected at most %g",
                         deepest / fabs(rc->b.radius), DEEPEST);
    if (!isnan(k->grow_to) && !(l.grow_to > l.length))
        return rb_refuse(why, "grow-to",
                         "expected more than the length of the crack, %g mm, got %g mm", l.length,
                         l.grow_to);
    if (rb_case_has_steps(c) || k->unloaded)
        return RB_OK;
    if (!(l.from < l.to))
        return rb_refuse(why, "from,to,crack-mouth",
                         "A rolls towards +x; expected --from below --to, "
                         "got %g and %g half-widths",
                         l.from / a, l.to / a);
    const double step = (l.to - l.from) / a / (rc->steps > 0 ? rc->steps : INTERVALS);
    if (step > WIDE * (1.0 + 1e-12))
        return rb_refuse(why, "steps,from,to",
                         "%d steps of %g half-widths would jump over the crack, "
                         "expected at least %.10g",
                         rc->steps > 0 ? rc->steps : INTERVALS, step,
                         ceil((l.to - l.from) / a / WIDE * (1.0 - 1e-12)));
    return RB_OK;
}

int rb_case_crack_cycles(const rb_case_crack *k)
{
    return k->remote_stresses.n == 2;
}

/* A crack without a contact is computed once, unless a cycle of the remote stress repeats. */
static int passes_of(const rb_case_crack *k)
{
    return k->unloaded && !rb_case_crack_cycles(k) ? 1 : k->passes;
}

static rb_status check_remote(const rb_resolved_case *c, const rb_case_crack *k, rb_message *why)
{
    const int cycles = rb_case_crack_cycles(k), bulk = c->rc.bulk_stress_b != 0.0;

    if (k->remote_stresses.n > 2 ||
        (cycles && !(k->remote_stresses.value[0] < k->remote_stresses.value[1])))
        return rb_refuse(why, "remote-stress", "expected one number, or low,high of a cycle");
    if (cycles && !k->unloaded)
        return rb_refuse(why, "remote-stress",
                         "a cycle acts alone, --unloaded; with a contact a column "
                         "bulk_stress_b of --history says how both go together");
    if (cycles && k->fluid != RB_CRACK_DRY)
        return rb_refuse(why, "fluid", "not under a cycle of the remote stress");
    if (k->unloaded && k->remote_stress == 0.0 && !cycles)
        return rb_refuse(why, "unloaded", "needs --remote-stress");
    if (k->unloaded && (bulk || c->program.bulk_stress_b))
        return rb_refuse(why, "bulk-stress-b", "--unloaded takes --remote-stress");
    if (k->unloaded && (!isnan(k->from) || !isnan(k->to) || c->rc.steps > 0))
        return rb_refuse(why, "from,to,steps", "not together with --unloaded: no contact passes");
    if (k->unloaded && !cycles && k->passes > 1)
        return rb_refuse(why, "passes",
                         "nothing passes with --unloaded but a cycle, --remote-stress low,high");
    return RB_OK;
}

rb_status rb_case_crack_check(const rb_resolved_case *c, const rb_case_crack *k, rb_message *why)
{
    const rb_rolling_case *rc = &c->rc;
    if (!(k->angle >= 0.0 && k->angle < 180.0) || (k->depth == 0.0 && k->angle == 0.0))
        return rb_refuse(why, "crack-angle",
                         "expected more than 0 and less than 180 degrees%s, "
                         "got %g: the crack would lie outside body B",
                         k->depth > 0.0 ? " (0 below the surface)" : "", k->angle);
    if (k->fluid != RB_CRACK_DRY && k->depth > 0.0)
        return rb_refuse(why, "fluid",
                         "enters at the mouth, which a crack with --crack-depth "
                         "does not have");
    if (k->locate_closing && k->fluid != RB_CRACK_TRAPPED)
        return rb_refuse(why, "closing", "located only for --fluid trapped");
    if (k->unloaded && k->coupled)
        return rb_refuse(why, "coupled,unloaded", "not together with --unloaded");
    rb_status s = check_sizes(k, why);
    if (s == RB_OK)
        s = check_remote(c, k, why);
    if (s != RB_OK)
        return s;
    if (k->unloaded && k->fluid == RB_CRACK_PRESSURE)
        return rb_refuse(why, "fluid", "pressure is the contact pressure, and --unloaded has none");
    if (!k->unloaded && rc->period > 0.0)
        return rb_refuse(why, "period", "a crack is that of one contact alone, without --period");
    if (!k->unloaded && rc->elastic_b &&
        !rb_rolling_body_can(&rc->b, RB_BODY_HOMOGENEOUS | RB_BODY_ELASTIC))
        return rb_refuse(why, "layer-thickness-b,layers-b,cover-thickness-b,relaxation-time-b",
                         "below a crack the stress in body B is known where it is homogeneous and "
                         "elastic only, without a layer, a cover or memory");
    if (k->coupled && (rb_rolling_largest_mu(rc) > 0.0 || rb_case_has_steps(c)))
        return rb_refuse(why, "coupled",
                         "for a contact without friction and without steps of its "
                         "own, --mu 0");
    if (k->coupled && !rc->elastic_b)
        return rb_refuse(why, "coupled",
                         "a rigid body B is not changed by its crack; make it "
                         "elastic (--similar, --young-b)");
    if (k->coupled && k->fluid != RB_CRACK_DRY)
        return rb_refuse(why, "coupled", "it needs a crack without fluid");
    s = rb_case_check_growth(k, why);
    if (s != RB_OK)
        return s;
    if (rb_case_has_steps(c) && !isnan(k->to))
        return rb_refuse(why, "to", "the history says how far the contact goes");
    if (rb_case_has_steps(c) && rc->formulation == RB_STATIC && rc->steps > 0)
        return rb_refuse(why, "steps",
                         "a contact at rest stays at --from, and its own steps are those of the "
                         "crack; expected --increments or rows of --history");
    const double a = unit_of_load(c, k); /* before anything is solved, if it is known */
    return isnan(a) ? RB_OK : check_lengths(c, k, a, why);
}

/* ---- Positions --------------------------------------------------------------------- */

const rb_case_crack_mesh rb_case_crack_own_mesh = {1.0, 1.0, 1, 1};

/* The program chooses the positions: what moves is one state. */
static int chooses_positions(const rb_resolved_case *c, const rb_case_crack *k)
{
    return !k->unloaded && !rb_case_has_steps(c) && c->rc.steps == 0;
}

/* What K changes fastest with: the crack, or the half-width. */
static double scale_of(const rb_case_crack *lengths, double a)
{
    return fmin(lengths->length + lengths->depth, a);
}

/* Where the tractions bend: edges of patches, ends of stick. */
static int marks_of(const rb_case_crack_track *t, int n, const int *zone, double *mark)
{
    const rb_bem_edge_load *load = &t->load[0];
    int marks = 0;

    for (int j = 0; t->kind == RB_CRACK_NODES && j < load->n && marks < MOST_MARKS; j++)
        if (load->p[j] == 0.0 &&
            ((j > 0 && load->p[j - 1] > 0.0) || (j + 1 < load->n && load->p[j + 1] > 0.0)))
            mark[marks++] = load->x[j];
    for (int i = 1; i < n && marks < MOST_MARKS; i++) {
        /* The loop above has the edges of tractions in nodes, so that only the ends of stick are
         * left; the pressure of strips also jumps at an edge. */
        const int loaded = zone[i] != RB_ZONE_SEPARATED, before = zone[i - 1] != RB_ZONE_SEPARATED,
                  sticks = zone[i] == RB_ZONE_STICK, stuck = zone[i - 1] == RB_ZONE_STICK;
        if (loaded && before ? sticks != stuck : t->kind == RB_CRACK_STRIPS && loaded != before)
            mark[marks++] = t->ends[i];
    }
    return marks;
}

/* Equal steps, and where a mark passes over a crack that is shorter than the half-width
 * steps of a part of its length.  finer: so many times as many.  Returns how many positions;
 * x: room for MOST_POSITIONS + 1. */
static int first_positions(const rb_case_crack *l, double a, double finer, int marks,
                           const double *mark, double *x)
{
    const int intervals = (int)ceil(finer * INTERVALS);
    const double scale = scale_of(l, a), room = 3.0 * scale;
    double step = NARROW * scale / finer;
    int n = 0;

    /* Equal positions all the way; the last one is exactly its end. */
    for (int i = 0; i <= intervals; i++)
        x[n++] = i < intervals ? l->from + (l->to - l->from) * i / intervals : l->to;
    /* Wider steps near the mouth where the array has no room for so many. */
    while (2.0 * marks * room / step > MOST_POSITIONS - n)
        step *= 1.1;
    for (int m = 0; m < marks && scale < a; m++) {
        const int half = (int)ceil(room / step);
        for (int i = -half; i <= half && n <= MOST_POSITIONS; i++) {
            /* The contact at x has this mark at x + mark, which is the mouth for i = 0. */
            const double at = l->mouth - mark[m] + i * step;
            if (at > l->from && at < l->to)
                x[n++] = at;
        }
    }
    gsl_sort(x, 1, (size_t)n);
    /* those of several marks may nearly be the same */
    int kept = 1;
    for (int i = 1; i < n; i++)
        if (x[i] - x[kept - 1] > 0.2 * step)
            x[kept++] = x[i];
        else if (x[i] == l->to)
            x[kept - 1] = l->to;
    return kept;
}

/* More of them on both sides of the extremes of the last pass, so that these are found on
 * them.  Returns how many positions; 0: there is nothing to be found. */
static int more_positions(const rb_crack_history *h, int passes, double least, double **to)
{
    enum { PARTS = 4 };
    const int n = h->n / passes, from = h->n - n;
    const double *columns[] = {h->K_I, h->K_II, h->K_I_upper, h->K_II_upper};
    int *parts = rb_alloc_int((size_t)n), added = 0;
    double largest = 0.0;

    *to = NULL;
    if (!parts)
        return -1;
    for (int j = 0; j < 4; j++)
        largest = columns[j] ? fmax(largest, rb_norm_inf((size_t)n, columns[j] + from)) : largest;
    /* parts[i]: into how many parts the interval before position i is divided; PARTS beside an
     * extreme of one of the columns, otherwise 0. */
    for (int j = 0; j < 4; j++)
        for (int sign = -1; sign <= 1 && columns[j]; sign += 2) {
            const double *value = columns[j] + from;
            int most = 0;
            for (int i = 1; i < n; i++)
                /* of faces that stick the first of many that are equal but for rounding */
                most = sign * (value[i] - value[most]) > 1e-9 * largest ? i : most;
            for (int i = most; i <= most + 1; i++) /* the intervals before and behind it */
                if (i > 0 && i < n && fabs(value[i] - value[i - 1]) > 1e-9 * largest &&
                    h->x[from + i] - h->x[from + i - 1] > least)
                    parts[i] = PARTS;
        }
    /* The old positions and the new ones between them, in their order. */
    for (int i = 1; i < n; i++)
        added += parts[i] ? PARTS - 1 : 0;
    double *x = added ? rb_alloc((size_t)(n + added), 1) : NULL;
    int m = 0;
    for (int i = 0; x && i < n; i++) {
        for (int k = 1; k < parts[i]; k++)
            x[m++] = h->x[from + i - 1] + (h->x[from + i] - h->x[from + i - 1]) * k / PARTS;
        x[m++] = h->x[from + i];
    }
    free(parts);
    *to = x;
    return x ? m : added ? -1 : 0;
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

/* The ends of n contact elements, and their tractions in each of the loads: nodes between
 * which they are linear (B14), of a coupled contact strips. */
static rb_status set_loads(const rb_resolved_case *c, const rb_case_crack *k, int n,
                           const double *x, const double *h, const double *p, const double *q,
                           const int *zone, rb_case_crack_track *t)
{
    t->ends = rb_arena_doubles(&t->memory, (size_t)n + 1, 1);
    if (!t->ends)
        return RB_ENOMEM;
    for (int i = 0; i < n; i++)
        t->ends[i] = x[i] - 0.5 * h[i];
    t->ends[n] = x[n - 1] + 0.5 * h[n - 1];
    t->kind = k->coupled ? RB_CRACK_STRIPS : RB_CRACK_NODES;
    rb_status s = RB_OK;
    for (int i = 0; i < t->loads && s == RB_OK; i++) {
        const size_t at = (size_t)i * (size_t)n;
        const rb_rolling_mesh mesh = {.n = n, .ends = t->ends};
        const rb_contact_state state = {
            .n = n, .p = (double *)p + at, .q = (double *)q + at, .zone = (int *)zone + at};
        if (k->coupled)
            t->load[i] = (rb_bem_edge_load){n, t->ends, p + at, q + at};
        else
            s = rb_rolling_traction_nodes(&c->rc, &mesh, &state, t->ends, p + at, q + at,
                                          EDGE_NODES, &t->memory, &t->load[i]);
    }
    return s;
}

_Static_assert(RB_ROLLING_OWN_NOTES + RB_CASE_CRACK_NOTES <= (int)RB_CASE_MATERIAL_NOTES,
               "kinds of notes on materials come behind those of cracks");

/* A note where it applies. */
static void RB_PRINTF(3, 4) note(rb_case_crack_result *r, int applies, const char *text, ...)
{
    const int kind = r->note_kinds++;

    if (!applies || kind >= RB_CASE_CRACK_NOTES)
        return;
    va_list values;
    va_start(values, text);
    r->note_kind[r->notes] = kind;
    vsnprintf(r->note[r->notes++], sizeof r->note[0], text, values);
    va_end(values);
}

/* What a user of the result has to know, each with how far it is from what is wanted. */
static void find_notes(const rb_resolved_case *c, const rb_case_crack *k,
                       const rb_case_crack_track *t, rb_case_crack_result *r)
{
    const double a = r->half_width;
    const rb_case_crack l = rb_case_crack_lengths(c, k, a);
    const double radius = c->rc.elastic_b ? c->rc.b.radius : INFINITY, last = t->x[t->n - 1],
                 first = fabs(t->x[0] - l.mouth) / a, wanted = NARROW * scale_of(&l, a) / a;
    double step = 0.0, away = INFINITY;

    if (k->unloaded)
        return;
    for (int i = 1; i < t->n; i++)
        step = fmax(step, (t->x[i] - t->x[i - 1]) / a);
    /* from the nearest place under the load to the mouth */
    for (int i = 0; i < t->n; i++) {
        const rb_bem_edge_load *load = &t->load[t->loads > 1 ? i : 0];
        const double mouth = l.mouth - t->x[i];
        for (int j = 0; j < load->n; j++)
            if (load->p[j] > 0.0)
                away = fmin(away, fabs(mouth - load->x[j]) / a);
    }
    const double spacing = (t->ends[1] - t->ends[0]) / a;
    note(r, first < FAR * (1.0 - 1e-9) && last > t->x[0],
         "The first position is %.3g half-widths from the mouth, where the load "
         "already acts on the crack; begin at least 6 away (--from).",
         first);
    note(r, step > wanted * (1.0 + 1e-9) && !chooses_positions(c, k),
         "Positions are %.3g half-widths apart; the extremes of K lie between them "
         "(take at most %.2g, --steps).",
         step, wanted);
    note(r, last > t->x[0] && away > fmax(step, spacing),
         "The contact does not reach the crack: it ends %.3g half-widths from its mouth "
         "(--distance, --to).",
         away);
    note(r, k->fluid == RB_CRACK_TRAPPED && !k->locate_closing,
         "The volume of the trapped fluid is that of the last position with an open "
         "mouth, and depends on the positions; --closing located does not.");
    note(r, !c->rc.elastic_b || isfinite(radius),
         !c->rc.elastic_b ? "Body B is rigid for the contact: K are the limits of a body that is "
                            "much stiffer than A."
         : radius < 0.0   ? "Body B has a bore; the crack is computed as in a half-plane."
                          : "Body B is a cylinder; the crack is computed as in a half-plane.");
}

/* The positions of the contact: those of the history, equal ones, or the program's own. */
static rb_status set_positions(const rb_resolved_case *c, const rb_case_crack *k,
                               const rb_case_crack_mesh *finer, rb_case_crack_result *r,
                               rb_case_crack_track *t, rb_message *why)
{
    const int has_steps = rb_case_has_steps(c) && !k->unloaded,
              rolls = c->rc.formulation == RB_TRANSIENT;
    const rb_case_crack l = rb_case_crack_lengths(c, k, r->half_width);
    const rb_rolling_solution *one = &r->contact.solution;

    if (chooses_positions(c, k)) {
        double *x = rb_arena_doubles(&t->memory, MOST_POSITIONS + 1, 1);
        double mark[MOST_MARKS];
        if (!x)
            return RB_ENOMEM;
        t->x = r->positions > 0 ? r->position : x;
        t->n = r->positions > 0 ? r->positions
                                : first_positions(&l, r->half_width, finer->positions,
                                                  marks_of(t, one->n, one->zone, mark), mark, x);
        return RB_OK;
    }
    /* Without a choice of the program: the two ends of a cycle, the steps of the history, or equal
     * steps between --from and --to. */
    t->n = k->unloaded ? 1 + rb_case_crack_cycles(k)
           : has_steps ? r->states.steps
                       : finer->steps * c->rc.steps + 1;
    t->x = rb_arena_doubles(&t->memory, (size_t)t->n, 1);
    if (!t->x)
        return RB_ENOMEM;
    for (int i = 0; i < t->n; i++)
        t->x[i] = k->unloaded  ? l.from
                  : !has_steps ? l.from + (l.to - l.from) * i / (t->n - 1)
                  : rolls      ? l.from + r->half_width * r->contact.history.distance[i]
                               : l.from;
    for (int i = 1; i < t->n && has_steps; i++)
        if (t->x[i] - t->x[i - 1] > WIDE * r->half_width)
            return rb_refuse(why, "steps",
                             "step %d rolls %g half-widths and jumps over the "
                             "crack, expected at most %g",
                             i + 1, (t->x[i] - t->x[i - 1]) / r->half_width, WIDE);
    return RB_OK;
}

/* A cycle of the remote stress, or a history of the bulk stress with the contact. */
static rb_status set_tensions(const rb_case_crack *k, const rb_case_crack_result *r,
                              rb_case_crack_track *t)
{
    const double *bulk = t->loads > 1 ? r->contact.history.bulk_stress_b : NULL;

    if (!rb_case_crack_cycles(k) && !bulk)
        return RB_OK;
    t->tension = rb_arena_doubles(&t->memory, (size_t)t->n, 1);
    for (int i = 0; t->tension && i < t->n; i++)
        t->tension[i] = bulk ? k->remote_stress + bulk[i] : k->remote_stresses.value[i];
    return t->tension ? RB_OK : RB_ENOMEM;
}

/* From the solved contact to what acts on the crack: its shape in mm, the loads, where they stand,
 * and the remote stress at each position. */
rb_status rb_case_crack_follow(const rb_resolved_case *c, const rb_case_crack *k,
                               const rb_case_crack_mesh *finer, rb_case_crack_result *r,
                               rb_case_crack_track *t, rb_message *why)
{
    const int has_steps = rb_case_has_steps(c) && !k->unloaded;
    const rb_rolling_states *steps = &r->states;
    const rb_rolling_solution *one = &r->contact.solution;

    memset(t, 0, sizeof *t);
    r->half_width = unit_of(c, k, r);
    rb_status s = check_lengths(c, k, r->half_width, why);
    if (s != RB_OK)
        return s;
    const rb_case_crack l = rb_case_crack_lengths(c, k, r->half_width);
    const rb_rolling_body *b = c->rc.elastic_b && !k->unloaded ? &c->rc.b : &c->rc.a;
    /* G and nu of the body that has the crack; without a contact there is only A. */
    r->shape = (rb_crack_shape){
        .path = rb_crack_straight(l.mouth, l.depth, l.length, k->angle),
        .elements = k->elements,
        .friction = k->friction,
        .shear = 0.5 * b->young / (1.0 + b->poisson),
        /* of plane stress: the same kappa */
        .poisson = c->rc.plane == RB_PLANE_STRESS ? b->poisson / (1.0 + b->poisson) : b->poisson};
    r->passes = passes_of(k);
    t->bulk = c->rc.bulk_stress_b;
    t->loads = k->unloaded ? 0 : has_steps ? steps->steps : 1;
    t->load = rb_arena_zeros(&t->memory, (size_t)t->loads + 1, sizeof *t->load);
    if (t->memory.failed)
        return RB_ENOMEM;
    if (has_steps)
        s = set_loads(c, k, steps->n, steps->x, steps->h, steps->p, steps->q, steps->zone, t);
    else if (!k->unloaded)
        s = set_loads(c, k, one->n, one->x, one->h, one->p, one->q, one->zone, t);
    if (s == RB_OK)
        s = set_positions(c, k, finer, r, t, why);
    if (s == RB_OK)
        s = set_tensions(k, r, t);
    if (s == RB_OK)
        find_notes(c, k, t, r);
    return s;
}

double rb_case_crack_tension(const rb_case_crack *k, const rb_case_crack_track *t, int step)
{
    return t->tension ? t->tension[step] : k->remote_stress + t->bulk;
}

rb_crack_passage rb_case_crack_passage(const rb_case_crack *k, const rb_case_crack_track *t)
{
    return (rb_crack_passage){.steps = t->n,
                              .x = t->x,
                              .loads = t->loads,
                              .load = t->load,
                              .kind = t->kind,
                              .passes = passes_of(k),
                              .fluid = (rb_crack_fluid)k->fluid,
                              .locate_closing = k->locate_closing,
                              .tension = k->remote_stress + t->bulk,
                              .tensions = t->tension};
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

/* Nodal forces of the load at the positions of a pass; those of the positions before, which
 * are among them, are taken from there.  Owned by the caller; NULL: out of memory. */
static double *forces_at(const rb_crack *crack, const rb_crack_passage *to,
                         const rb_crack_passage *before, rb_status *s)
{
    const size_t size = 2 * (size_t)rb_crack_nodes(crack);
    double *T = rb_alloc((size_t)to->steps, size);
    *s = T ? RB_OK : RB_ENOMEM;
    for (int i = 0, j = 0; i < to->steps && *s == RB_OK; i++) {
        double *here = T + (size_t)i * size;
        while (before && j < before->steps && before->x[j] < to->x[i])
            j++;
        if (before && j < before->steps && before->x[j] == to->x[i])
            memcpy(here, before->forces + (size_t)j * size, size * sizeof *here);
        else
            *s = rb_crack_load(crack, to->load, to->kind, to->x[i], to->tension, here);
    }
    return T;
}

/* Moves the load over the crack. The positions are refined beside the extremes of K, at most
 * SEARCHES times, because the range of K in a cycle is that of these extremes. */
rb_status rb_case_crack_pass(const rb_resolved_case *c, const rb_case_crack *l,
                             const rb_case_crack_track *t, const rb_crack_wheel *wheel,
                             const rb_crack_observer *observer, rb_crack *crack,
                             rb_case_crack_result *r, rb_message *why)
{
    rb_crack_passage passage = rb_case_crack_passage(l, t);
    passage.wheel = wheel;
    passage.observer = observer;
    if (!chooses_positions(c, l))
        return rb_crack_pass(crack, &passage, &r->history, why);
    /* Bower's volume is that of a position: others would change it. */
    const int searches = l->fluid == RB_CRACK_TRAPPED && !l->locate_closing ? 0 : SEARCHES;
    rb_status s = RB_OK;
    double *T = wheel ? NULL : forces_at(crack, &passage, NULL, &s);

    passage.forces = T;
    if (s == RB_OK)
        s = rb_crack_pass(crack, &passage, &r->history, why);
    /* Each search computes all positions again, because the faces remember their slip; only the
     * nodal forces of the former positions are kept. */
    for (int i = 0; i < searches && s == RB_OK; i++) {
        rb_crack_passage finer = passage;
        double *x;
        finer.steps =
            more_positions(&r->history, passage.passes, 1e-3 * scale_of(l, r->half_width), &x);
        if (finer.steps <= 0) {
            s = finer.steps < 0 ? RB_ENOMEM : RB_OK;
            break;
        }
        finer.x = x;
        double *more = wheel ? NULL : forces_at(crack, &finer, &passage, &s);
        finer.forces = more;
        free(T);
        T = more;
        free(r->position);
        r->position = x;
        r->positions = finer.steps;
        passage = finer;
        rb_crack_history_free(&r->history);
        if (s == RB_OK)
            s = rb_crack_pass(crack, &passage, &r->history, why);
    }
    free(T);
    return s;
}

/* 1: a pressure at an end of the potential contact, in any step. */
static int reaches_end(const rb_crack_history *h)
{
    for (int i = 0; i < h->n; i++) {
        const double *p = h->wheel + (size_t)i * (size_t)h->elements;
        if (p[0] > 0.0 || p[h->elements - 1] > 0.0)
            return 1;
    }
    return 0;
}

/* One mesh.  zone: half-width of the potential contact of a coupled crack. */
static rb_status solve_once(const rb_resolved_case *c, const rb_case_crack *k,
                            const rb_case_crack_mesh *finer, double zone,
                            const rb_crack_observer *observer, rb_case_crack_result *r,
                            rb_message *why)
{
    contact_steps kept = {&r->states, observer, 0};
    rb_resolved_case refined = rb_case_crack_contact(c, k);
    rb_case_crack_track t = {0};
    rb_crack *crack = NULL;

    memset(r, 0, sizeof *r);
    r->passes = k->passes;
    if (finer->contact > 1.0) /* and the mouth lies elsewhere in its elements */
        refined.rc.contact_elements = (int)ceil(finer->contact * c->rc.contact_elements) + 1;
    if (rb_case_has_steps(c)) {
        refined.rc.steps *= finer->steps;
        refined.rc.increments *= finer->steps;
    }
    if (k->coupled)
        refined.rc.zone = zone;
    /* 1. The contact, whose steps are kept as loads; 2. its way over the crack. */
    rb_status s = k->unloaded ? RB_OK : rb_case_solve(&refined, keep_step, &kept, &r->contact, why);
    if (s == RB_INTERRUPTED && kept.failed)
        s = RB_ENOMEM;
    if (s == RB_OK)
        s = rb_case_crack_follow(c, k, finer, r, &t, why);
    r->shape.elements *= finer->crack;
    /* 3. A crack that changes the contact needs the flexibility of the wheel as a matrix. */
    if (s == RB_OK && k->coupled)
        s = rb_rolling_model_add_matrix(&r->contact.model, why);
    if (s == RB_OK)
        s = rb_crack_create(&r->shape, &crack, why);
    if (s == RB_OK) {
        const rb_rolling_model *model = &r->contact.model;
        /* 4. K at every position, what follows from it, and the growth of the crack. */
        const rb_crack_wheel wheel = {.n = model->mesh.n,
                                      .ends = t.ends,
                                      .F = model->bodies.F,
                                      .ldf = 2 * (model->mesh.n + 1),
                                      .gap = model->problem.d_N,
                                      .load = r->contact.solution.normal_load,
                                      .approach = r->contact.solution.approach};
        const rb_case_crack l = rb_case_crack_lengths(c, k, r->half_width);
        if (k->coupled && !model->bodies.F)
            s = rb_refuse(why, "coupled", "fewer than %d contact elements", RB_ROLLING_LARGE);
        else
            s = rb_case_crack_pass(c, &l, &t, k->coupled ? &wheel : NULL, observer, crack, r, why);
        if (s == RB_INTERRUPTED)
            r->passes = r->history.n / (r->positions > 0 ? r->positions : t.n);
        if (r->history.n > 0)
            r->summary = rb_case_crack_summarise(&r->history, r->passes);
        if (s == RB_OK && !isnan(k->paris) && finer == &rb_case_crack_own_mesh)
            s = rb_case_grow_crack(c, k, &t, observer, r, why);
        const rb_case_crack_growth *g = &r->growth;
        const int ends = g->surfaced || g->rests;
        note(r, ends,
             g->surfaced ? "The crack came back to the surface beyond a length of %.4g %s: a piece "
                           "breaks out."
                         : "The crack stops: dK is below the threshold at a length of %.4g %s.",
             ends ? rb_unit_shown(c->units, "mm", g->length[g->n - 1]) : 0.0,
             rb_unit_name(c->units, "mm"));
    }
    rb_crack_free(crack);
    rb_case_crack_track_free(&t);
    return s;
}

/* A coupled contact may reach beyond its zone where the crack opens: again on a wider one. */
static rb_status solve_on_zones(const rb_resolved_case *c, const rb_case_crack *k,
                                const rb_case_crack_mesh *finer, const rb_crack_observer *observer,
                                rb_case_crack_result *r, rb_message *why)
{
    rb_resolved_case wider = *c;
    double zone = c->rc.zone > 0.0 ? c->rc.zone : ZONE * c->derived.half_width;
    rb_status s = solve_once(c, k, finer, zone, observer, r, why);

    /* The opening of a crack widens the contact a little, so that few zones are tried. */
    for (int i = 1;
         i < ZONES && k->coupled && c->rc.zone == 0.0 && s == RB_OK && reaches_end(&r->history);
         i++) {
        zone *= WIDER;
        wider.rc.contact_elements = (int)ceil(wider.rc.contact_elements * WIDER);
        rb_case_crack_free(r);
        s = solve_once(&wider, k, finer, zone, observer, r, why);
    }
    if (s == RB_OK && k->coupled && reaches_end(&r->history))
        note(r, 1,
             "The contact that the crack opens reaches the end of the potential contact, %.3g mm "
             "from the middle; widen it (--zone).",
             zone);
    return s;
}

rb_status rb_case_crack_solve(const rb_resolved_case *c, const rb_case_crack *k,
                              const rb_crack_observer *observer, rb_case_crack_result *r,
                              rb_message *why)
{
    memset(r, 0, sizeof *r);
    rb_status s = rb_case_crack_check(c, k, why);
    if (s == RB_OK)
        s = solve_on_zones(c, k, &rb_case_crack_own_mesh, observer, r, why);
    /* Two of the contact and one of the crack: on a mesh finer in both their errors may cancel. */
    enum { RUNS = 3 };
    static const rb_case_crack_mesh meshes[RUNS] = {
        {2.0, 1.0, 1, 2}, {1.4, 1.4, 1, 1}, {1.0, 1.0, 2, 1}};
    rb_case_crack_summary others[RUNS];
    /* Error bars: the same on three other meshes. */
    for (int i = 0; i < RUNS && s == RB_OK && c->error; i++) {
        rb_case_crack_result other;
        rb_case_crack finer = *k;
        /* as infinitely many positions do */
        finer.locate_closing |= i == 0 && k->fluid == RB_CRACK_TRAPPED;
        s = solve_on_zones(c, &finer, &meshes[i], observer, &other, why);
        others[i] = other.summary;
        rb_case_crack_free(&other);
    }
    r->has_errors = s == RB_OK && c->error;
    if (r->has_errors)
        rb_case_crack_set_errors(others, &others[2], r);
    r->status = s;
    return s == RB_ENOMEM ? rb_fail(why, s, "crack: out of memory") : s;
}

rb_status rb_case_crack_row(const rb_resolved_case *c, const rb_case_crack *k, rb_rolling_row *row,
                            rb_message *why)
{
    rb_case_crack_result r;
    rb_status s = rb_case_crack_solve(c, k, NULL, &r, why);

    if (r.contact.solution.n > 0) {
        row->solution = rb_rolling_scalars_of(&r.contact.solution);
        rb_rolling_solution_convert(&r.contact.solution, c->units);
        row->notes = rb_rolling_find_row_notes(&c->rc, &r.contact.solution);
        s = s == RB_OK ? row->notes.status : s;
    }
    for (int i = 0; i < r.notes; i++)
        rb_rolling_add_note(&row->notes, RB_ROLLING_OWN_NOTES + r.note_kind[i], r.note[i]);
    if (s == RB_OK)
        rb_case_crack_set_row(&r, row);
    rb_case_crack_free(&r);
    return s;
}
