/* Where the largest stresses are looked for first: rows of points in each material, which crowd
 * at the edges of the contacts and below them. */
#include "rolling/solve/patches.h"
#include "rolling/stress/search.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_sort.h>
#include <math.h>

/* ---- Places ---------------------------------------------------------------------------- */

/* s of a point of the surface. */
static double along_surface(const rb_search *f, double x)
{
    return f->radius > 0.0 ? f->radius * asin(x / f->radius) : x;
}

void rb_search_xy(const rb_search *f, const rb_search_strip *in, double s, double depth,
                  double xy[2])
{
    if (f->radius == 0.0) {
        xy[0] = s;
        /* what lies below a bond begins behind it, the bond is that of the layer above */
        xy[1] = in->top > 0.0 ? fmax(depth, nextafter(in->top, INFINITY)) : depth;
        return;
    }
    /* s is measured along the circle, depth towards its centre; the second term of y without
     * cancellation (B9). */
    const double angle = s / f->radius;
    xy[0] = (f->radius - depth) * sin(angle);
    xy[1] = depth * cos(angle) + 2.0 * f->radius * gsl_pow_2(sin(0.5 * angle));
}

int rb_search_leaves_out(const rb_search *f, double s, double depth)
{
    int is = 0;
    for (int k = 0; k < f->left_outs && !is; k++)
        is = hypot(s - f->left_out[k], depth) < f->around_them;
    return is;
}

/* From x and y to the tangent and the normal of a circle about A's centre. */
void rb_search_turn(double radius, rb_rolling_stress *at)
{
    const double angle = atan2(at->x, radius - at->y), c = cos(angle), s = sin(angle),
                 sxx = at->sxx, syy = at->syy, sxy = at->sxy;
    at->sxx = sxx * c * c + 2.0 * sxy * c * s + syy * s * s;
    at->syy = sxx * s * s - 2.0 * sxy * c * s + syy * c * c;
    at->sxy = (syy - sxx) * c * s + sxy * (c - s) * (c + s);
}

/* Stress at n places of a strip. */
rb_status rb_search_stress(const rb_search *f, const rb_search_strip *in, int n, const double *s,
                           const double *depth, rb_rolling_stress *at, rb_message *why)
{
    rb_arena scratch = {0};
    double *xy = rb_arena_doubles(&scratch, (size_t)n, 2);
    if (!xy)
        return rb_arena_done(&scratch, RB_ENOMEM);
    for (int k = 0; k < n; k++)
        rb_search_xy(f, in, s[k], depth[k], xy + 2 * k);
    const rb_status status = rb_rolling_field_at(f->field, n, xy, at, why);
    for (int k = 0; k < n && status == RB_OK && f->along_bond && f->radius > 0.0; k++)
        rb_search_turn(f->radius, &at[k]);
    return rb_arena_done(&scratch, status);
}

/* ---- Points ---------------------------------------------------------------------------- */

/* Along the surface: the nodes of the tractions, which crowd at the edges of contacts, and
 * the middles between them; where these are far apart, more; and outwards, in growing steps,
 * as far as the stress may have another peak. */
static rb_status set_candidates(rb_search *f, rb_arena *memory)
{
    enum { FILLED = 100, STEPS = 400 };
    const rb_bem_edge_load *load = rb_rolling_field_load(f->field);
    const double *x = load->x;
    const int n = load->n;
    f->low = along_surface(f, x[0]);
    f->high = along_surface(f, x[n - 1]);
    const double width = f->high - f->low, widest = width / FILLED;
    const double most = f->reach > 0.0 ? f->reach : width;
    double *s = f->s =
        rb_arena_doubles(memory, 2 * (size_t)n + 2 * FILLED + 3 + 2 * (size_t)STEPS, 1);
    if (!s)
        return RB_ENOMEM;
    int m = 0;
    for (int k = 0; k < n; k++) {
        const double here = along_surface(f, x[k]), last = m ? s[m - 1] : here;
        /* At least the middle between two nodes, more where they are far apart. */
        const int parts = k ? (int)fmax(2.0, ceil((here - last) / widest)) : 1;
        for (int i = 1; i < parts; i++)
            s[m++] = last + (here - last) * i / parts;
        s[m++] = here;
    }
    /* Outwards on both sides, each step longer than the one before. */
    double step = widest, away = 0.0;
    for (int k = 0; k < STEPS && away < most; k++) {
        away = fmin(away + step, most);
        s[m++] = f->low - away;
        s[m++] = f->high + away;
        step = fmin(1.2 * step, most / 40.0 + widest);
    }
    s[m++] = f->middle;
    gsl_sort(s, 1, (size_t)m);
    f->candidates = m;
    f->reach = most;
    return RB_OK;
}

/* Adds the points of one depth: the candidates, but as far from each other as fits what
 * changes there.  They are counted from the middle of the contact: below it a symmetric one has
 * ridges that are narrower than this distance. */
static void add_row(rb_search *f, const rb_search_strip *in, double depth)
{
    rb_search_row *r = &f->row[f->rows++];
    *r = (rb_search_row){in, depth, f->n, 0};
    for (int right = 0; right < 2; right++) {
        double last = right ? f->middle : INFINITY;
        for (int i = 0; i < f->candidates; i++) {
            const int k = right ? i : f->candidates - 1 - i;
            const double away = right ? f->s[k] - last : last - f->s[k];
            if ((right ? f->s[k] > f->middle : f->s[k] <= f->middle) && away >= 0.3 * depth &&
                away > 0.0) {
                if (f->at_s)
                    f->at_s[f->n] = f->s[k];
                last = f->s[k];
                f->n++;
                r->n++;
            }
        }
        if (f->at_s && !right)
            gsl_sort(f->at_s + r->first, 1, (size_t)r->n); /* those of the left came outwards */
    }
}

/* From both boundaries of the strip into it, in steps that grow with the distance from the
 * boundary; there are so many. */
enum { MOST_ROWS = 256 };

static void add_rows(rb_search *f, const rb_search_strip *in, double first)
{
    const double height = in->bottom - in->top, half = 0.5 * height;
    const int ends = isfinite(height);
    double depth[MOST_ROWS / 2];
    int n = 0;

    for (double below = 0.0; n < MOST_ROWS / 4 && below < (ends ? half : in->bottom);) {
        depth[n++] = below;
        /* across a film the stress is nearly linear */
        below = height < 2.0 * first ? below + height / 3.0
                : below > 0.0        ? fmin(1.35 * below, below + height / 14.0)
                                     : fmin(first, height / 6.0);
    }
    for (int k = 0; k < n; k++)
        add_row(f, in, in->top + depth[k]);
    for (int k = n - 1; k >= 0; k--)
        add_row(f, in, in->bottom - depth[k]);
}

/* Layer `k` of a half-plane, and behind the last one the base. */
rb_search_strip rb_search_strip_of(const rb_rolling_body *a, int k, double deep)
{
    const double top = rb_rolling_bond_depth(a, k);
    if (k == rb_rolling_layers(a))
        return (rb_search_strip){RB_MATERIAL_BASE, top, top + deep};
    return (rb_search_strip){a->stack ? (rb_rolling_place)(RB_MATERIAL_FIRST + k)
                                      : RB_MATERIAL_LAYER,
                             top, rb_rolling_bond_depth(a, k + 1)};
}

/* The middle of the widest patch of the contact.  Returns the width of the narrowest one. */
static double set_middle(rb_search *f, double most)
{
    double narrowest = most, widest = 0.0;
    rb_rolling_run run = {.last = -1};
    while (rb_rolling_next_patch(f->model->rc, &f->model->mesh, &f->model->state, run.last + 1,
                                 &run)) {
        const double width = run.to - run.from;
        if (width > widest)
            f->middle = 0.5 * (run.from + run.to);
        widest = fmax(widest, width);
        narrowest = width > 0.0 ? fmin(narrowest, width) : narrowest;
    }
    f->middle = along_surface(f, f->middle);
    return narrowest;
}

/* The strips of A down to the depth, of a half-plane's body or base so deep. */
static void set_strips(rb_search *f, double depth, double deep)
{
    const rb_rolling_body *a = &f->model->rc->a;
    const int layers = rb_rolling_layers(a);

    if (!rb_rolling_body_can(a, RB_BODY_FLAT)) {
        const double inner = a->cover > 0.0             ? a->radius - a->cover
                             : a->support == RB_BEM_HUB ? a->hub_ratio * a->radius
                                                        : 0.0;
        f->strip[f->strips++] = (rb_search_strip){
            a->cover > 0.0 ? RB_MATERIAL_LAYER : RB_MATERIAL_BODY, 0.0, a->radius - inner};
    } else {
        if (layers == 0)
            f->strip[f->strips++] = (rb_search_strip){RB_MATERIAL_BODY, 0.0, deep};
        for (int k = 0; k < layers + (layers > 0 && a->base_young > 0.0); k++)
            f->strip[f->strips++] = rb_search_strip_of(a, k, deep);
    }
    for (int k = f->strips - 1; k >= 0 && depth > 0.0; k--) {
        f->strip[k].bottom = fmin(f->strip[k].bottom, depth);
        /* the base may begin deeper */
        if (!(f->strip[k].bottom > f->strip[k].top))
            f->strips = k;
    }
}

/* The strips of A down to the depth, and the rows in them. */
static rb_status set_rows(rb_search *f, double depth, rb_arena *memory)
{
    const rb_rolling_body *a = &f->model->rc->a;
    const int is_flat = rb_rolling_body_can(a, RB_BODY_FLAT), layers = rb_rolling_layers(a);
    f->strip = rb_arena_zeros(memory, (size_t)layers + 1, sizeof *f->strip);
    f->row = rb_arena_zeros(memory, ((size_t)layers + 1) * MOST_ROWS, sizeof *f->row);
    if (memory->failed)
        return RB_ENOMEM;

    /* Layers bend over a softer base as a plate does: over a length like this. */
    double stiffest = a->young;
    for (int k = 0; k < layers; k++)
        stiffest = fmax(stiffest, rb_rolling_layer_of(a, k).young);
    const double layer = rb_rolling_layers_depth(a),
                 plate = layer > 0.0 && a->base_young > 0.0
                             ? layer * cbrt(fmax(stiffest / a->base_young, 1.0))
                             : layer;
    f->radius = is_flat ? 0.0 : a->radius;
    f->reach = is_flat ? 0.0 : M_PI * a->radius;
    const rb_bem_edge_load *load = rb_rolling_field_load(f->field);
    const double width = load->x[load->n - 1] - load->x[0];
    if (layer > 0.0)
        f->reach = fmax(0.5 * width, 8.0 * plate);
    const double narrowest = set_middle(f, width);
    rb_status s = set_candidates(f, memory);
    if (s != RB_OK)
        return s;
    set_strips(f, depth, 2.5 * width + 3.0 * plate);
    /* The rows are made twice: to count their points, and again with memory for these.  The first
     * one is as deep as a part of the narrowest patch. */
    for (int pass = 0; pass < 2; pass++) {
        f->n = f->rows = 0;
        for (int k = 0; k < f->strips; k++)
            add_rows(f, &f->strip[k], fmax(0.02 * narrowest, 1e-3 * width));
        if (pass == 0) {
            f->at_s = rb_arena_doubles(memory, (size_t)f->n, 1);
            f->at = rb_arena_zeros(memory, (size_t)f->n, sizeof *f->at);
            if (memory->failed)
                return RB_ENOMEM;
        }
    }
    return RB_OK;
}

/* Where given friction jumps, sxx is infinite like the logarithm of the distance. */
static rb_status leave_out_jumps(rb_search *f, rb_arena *memory)
{
    int n = 0;
    for (int k = 0; !isnan(rb_rolling_next_friction_jump(f->model, &k));)
        n++;
    f->left_out = n ? rb_arena_doubles(memory, (size_t)n, 1) : NULL;
    if (n && !f->left_out)
        return RB_ENOMEM;
    for (int k = 0; f->left_outs < n;)
        f->left_out[f->left_outs++] = rb_rolling_next_friction_jump(f->model, &k);
    f->around_them = RB_ROLLING_LEFT_OUT * 0.5 * (f->high - f->low);
    return RB_OK;
}

/* A clamped arc has two ends, where the stress is infinite like a power of the distance. */
static rb_status leave_out_ends(rb_search *f, rb_arena *memory)
{
    const rb_rolling_body *a = &f->model->rc->a;
    if (a->support != RB_BEM_ARC)
        return leave_out_jumps(f, memory);
    f->left_out = rb_arena_doubles(memory, 2, 1);
    if (!f->left_out)
        return RB_ENOMEM;
    rb_bem_mesh mesh = {0};
    const rb_status s = rb_rolling_boundary_mesh(f->model, 0, &mesh, NULL);
    const double half = a->arc * M_PI / 180.0;
    for (int j = 0; j < mesh.n && s == RB_OK; j++) {
        const int next = j + 1 < mesh.n ? j + 1 : 0;
        if (mesh.condition[2 * j] != mesh.condition[2 * next] &&
            (mesh.condition[2 * j] == RB_BEM_DISPLACEMENT ||
             mesh.condition[2 * next] == RB_BEM_DISPLACEMENT))
            for (int k = 0; k < 2; k++) {
                const int i = k ? next : j;
                f->around_them =
                    fmax(f->around_them, hypot(mesh.x1[i] - mesh.x0[i], mesh.y1[i] - mesh.y0[i]));
            }
    }
    f->left_outs = 2;
    f->left_out[0] = -(M_PI - half) * a->radius;
    f->left_out[1] = (M_PI - half) * a->radius;
    rb_bem_mesh_free(&mesh);
    return s;
}

/* The stress at all points, row by row. */
static rb_status compute_stress(rb_search *f, rb_message *why)
{
    rb_arena scratch = {0};
    double *depth = rb_arena_doubles(&scratch, (size_t)f->n, 1);
    rb_status s = depth ? RB_OK : RB_ENOMEM;
    for (int k = 0; k < f->rows && s == RB_OK; k++) {
        const rb_search_row *r = &f->row[k];
        for (int i = 0; i < r->n; i++)
            depth[i] = r->depth;
        s = rb_search_stress(f, r->in, r->n, f->at_s + r->first, depth, f->at + r->first, why);
    }
    return rb_arena_done(&scratch, s);
}

rb_status rb_search_look(rb_search *f, double depth, rb_arena *memory, rb_message *why)
{
    rb_status s = set_rows(f, depth, memory);
    if (s == RB_OK)
        s = leave_out_ends(f, memory);
    return s == RB_OK ? compute_stress(f, why) : s;
}
