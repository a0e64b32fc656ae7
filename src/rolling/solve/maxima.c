/* The largest stresses of body A (B8): looked for on its surface, along its bond on both
 * sides of it, and inside; and those of the bond itself, by name. */
#include "rolling/body/body.h"
#include "rolling/solve/field.h"
#include "rolling/solve/model.h"
#include "rolling/solve/patches.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_sort.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Places are (s, depth): along the surface and below it, the arc of a wheel's circle; each
 * material is then a strip between two depths. */
typedef struct {
    rb_rolling_place material;
    double top, bottom; /* depths */
} strip;

/* Points at one depth, s increasing. */
typedef struct {
    const strip *in;
    double depth;
    int first, n;
} row;

typedef struct {
    const rb_rolling_model *model;
    rb_rolling_field *field;
    double radius;      /* 0: flat */
    double low, high;   /* s of the outermost nodes of the tractions */
    double middle;      /* s of the middle of the widest contact */
    double reach;       /* how far on either side of them */
    double *left_out;   /* s of the two ends of a clamped arc, or of jumps of given friction */
    double around_them; /* how far the stress is left out there */
    int left_outs;
    int strips, rows, n;
    strip *strip;
    row *row;
    double *s, *at_s; /* candidates for s; of the points */
    int candidates;
    rb_rolling_stress *at;
    int along_bond; /* 1: stresses have the directions of the bond, not those of x and y */
} search;

static const char *const place_names[] = {"body", "layer", "base"};

const char *rb_rolling_place_name(rb_rolling_place place, char name[RB_ROLLING_PLACE])
{
    if (place < RB_MATERIAL_FIRST)
        return place_names[place];
    snprintf(name, RB_ROLLING_PLACE, "layer %d", (int)place - RB_MATERIAL_FIRST + 1);
    return name;
}

int rb_rolling_place_named(const char *name)
{
    int layer, used = 0;
    for (int k = 0; k < RB_MATERIAL_FIRST; k++)
        if (strcmp(name, place_names[k]) == 0)
            return k;
    const int is_layer = sscanf(name, "layer %d%n", &layer, &used) == 1 && !name[used] && layer > 0;
    return is_layer ? RB_MATERIAL_FIRST + layer - 1 : -1;
}

/* ---- Places ------------------------------------------------------------------------ */

static void to_xy(const search *f, const strip *in, double s, double depth, double xy[2])
{
    if (f->radius == 0.0) {
        xy[0] = s;
        /* what lies below a bond begins behind it, the bond is that of the layer above */
        xy[1] = in->top > 0.0 ? fmax(depth, nextafter(in->top, INFINITY)) : depth;
        return;
    }
    const double angle = s / f->radius;
    xy[0] = (f->radius - depth) * sin(angle);
    xy[1] = depth * cos(angle) + 2.0 * f->radius * gsl_pow_2(sin(0.5 * angle));
}

static int is_left_out(const search *f, double s, double depth)
{
    int is = 0;
    for (int k = 0; k < f->left_outs && !is; k++)
        is = hypot(s - f->left_out[k], depth) < f->around_them;
    return is;
}

/* From x and y to the tangent and the normal of a circle about A's centre. */
static void turn(double radius, rb_rolling_stress *at)
{
    const double angle = atan2(at->x, radius - at->y), c = cos(angle), s = sin(angle),
                 sxx = at->sxx, syy = at->syy, sxy = at->sxy;
    at->sxx = sxx * c * c + 2.0 * sxy * c * s + syy * s * s;
    at->syy = sxx * s * s - 2.0 * sxy * c * s + syy * c * c;
    at->sxy = (syy - sxx) * c * s + sxy * (c - s) * (c + s);
}

/* Stress at n places of a strip. */
static rb_status stress_at(const search *f, const strip *in, int n, const double *s,
                           const double *depth, rb_rolling_stress *at, rb_message *why)
{
    rb_arena scratch = {0};
    double *xy = rb_arena_doubles(&scratch, (size_t)n, 2);
    if (!xy)
        return rb_arena_done(&scratch, RB_ENOMEM);
    for (int k = 0; k < n; k++)
        to_xy(f, in, s[k], depth[k], xy + 2 * k);
    const rb_status status = rb_rolling_field_at(f->field, n, xy, at, why);
    for (int k = 0; k < n && status == RB_OK && f->along_bond && f->radius > 0.0; k++)
        turn(f->radius, &at[k]);
    return rb_arena_done(&scratch, status);
}

/* ---- The points that are looked at first ------------------------------------------- */

/* Along the surface: the nodes of the tractions, which crowd at the edges of contacts, and
 * the middles between them; where these are far apart, more; and outwards, in growing steps,
 * as far as the stress may have another peak. */
static rb_status set_candidates(search *f, rb_arena *memory)
{
    enum { FILLED = 100, STEPS = 400 };
    const rb_bem_edge_load *load = rb_rolling_field_load(f->field);
    const double *x = load->x;
    const int n = load->n;
    const double radius = f->radius;
    f->low = radius > 0.0 ? radius * asin(x[0] / radius) : x[0];
    f->high = radius > 0.0 ? radius * asin(x[n - 1] / radius) : x[n - 1];
    const double width = f->high - f->low, widest = width / FILLED;
    const double most = f->reach > 0.0 ? f->reach : width;
    double *s = f->s =
        rb_arena_doubles(memory, 2 * (size_t)n + 2 * FILLED + 3 + 2 * (size_t)STEPS, 1);
    if (!s)
        return RB_ENOMEM;
    int m = 0;
    for (int k = 0; k < n; k++) {
        const double here = radius > 0.0 ? radius * asin(x[k] / radius) : x[k],
                     last = m ? s[m - 1] : here;
        const int parts = k ? (int)fmax(2.0, ceil((here - last) / widest)) : 1;
        for (int i = 1; i < parts; i++)
            s[m++] = last + (here - last) * i / parts;
        s[m++] = here;
    }
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
static void add_row(search *f, const strip *in, double depth)
{
    row *r = &f->row[f->rows++];
    *r = (row){in, depth, f->n, 0};
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
enum { MOST_ROWS = 256, MOST_OUTWARDS = 400 };

static void add_rows(search *f, const strip *in, double first)
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
static strip strip_of(const rb_rolling_body *a, int k, double deep)
{
    const double top = rb_rolling_bond_depth(a, k);
    if (k == rb_rolling_layers(a))
        return (strip){RB_MATERIAL_BASE, top, top + deep};
    return (strip){a->stack ? (rb_rolling_place)(RB_MATERIAL_FIRST + k) : RB_MATERIAL_LAYER, top,
                   rb_rolling_bond_depth(a, k + 1)};
}

/* The middle of the widest patch of the contact.  Returns the width of the narrowest one. */
static double set_middle(search *f, double most)
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
    if (f->radius > 0.0)
        f->middle = f->radius * asin(f->middle / f->radius);
    return narrowest;
}

/* The strips of A down to the depth, and the rows in them. */
static rb_status set_rows(search *f, double depth, rb_arena *memory)
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
    if (!is_flat) {
        const double inner = a->cover > 0.0             ? a->radius - a->cover
                             : a->support == RB_BEM_HUB ? a->hub_ratio * a->radius
                                                        : 0.0;
        f->strip[f->strips++] =
            (strip){a->cover > 0.0 ? RB_MATERIAL_LAYER : RB_MATERIAL_BODY, 0.0, a->radius - inner};
    } else {
        const double deep = 2.5 * width + 3.0 * plate;
        if (layers == 0)
            f->strip[f->strips++] = (strip){RB_MATERIAL_BODY, 0.0, deep};
        for (int k = 0; k < layers + (layers > 0 && a->base_young > 0.0); k++)
            f->strip[f->strips++] = strip_of(a, k, deep);
    }
    for (int k = f->strips - 1; k >= 0 && depth > 0.0; k--) {
        f->strip[k].bottom = fmin(f->strip[k].bottom, depth);
        /* the base may begin deeper */
        if (!(f->strip[k].bottom > f->strip[k].top))
            f->strips = k;
    }
    /* The first row is as deep as a part of the narrowest patch. */
    for (int k = 0; k < f->strips; k++)
        add_rows(f, &f->strip[k], fmax(0.02 * narrowest, 1e-3 * width));
    /* The same again, with memory for the points. */
    f->at_s = rb_arena_doubles(memory, (size_t)f->n, 1);
    f->at = rb_arena_zeros(memory, (size_t)f->n, sizeof *f->at);
    if (memory->failed)
        return RB_ENOMEM;
    f->n = f->rows = 0;
    for (int k = 0; k < f->strips; k++)
        add_rows(f, &f->strip[k], fmax(0.02 * narrowest, 1e-3 * width));
    return RB_OK;
}

/* Where given friction jumps, sxx is infinite like the logarithm of the distance. */
static rb_status leave_out_jumps(search *f, rb_arena *memory)
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
static rb_status leave_out_ends(search *f, rb_arena *memory)
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

static rb_status compute_stress(search *f, rb_message *why)
{
    rb_arena scratch = {0};
    double *depth = rb_arena_doubles(&scratch, (size_t)f->n, 1);
    rb_status s = depth ? RB_OK : RB_ENOMEM;
    for (int k = 0; k < f->rows && s == RB_OK; k++) {
        const row *r = &f->row[k];
        for (int i = 0; i < r->n; i++)
            depth[i] = r->depth;
        s = stress_at(f, r->in, r->n, f->at_s + r->first, depth, f->at + r->first, why);
    }
    return rb_arena_done(&scratch, s);
}

/* ---- Maxima ------------------------------------------------------------------------ */

typedef double measure(const rb_rolling_stress *s);

static double max_shear(const rb_rolling_stress *s)
{
    return s->max_shear;
}

static double tresca_shear(const rb_rolling_stress *s)
{
    return s->tresca_shear;
}

static double von_mises(const rb_rolling_stress *s)
{
    return s->von_mises;
}

static double orthogonal_shear(const rb_rolling_stress *s)
{
    return fabs(s->sxy);
}

static double tension(const rb_rolling_stress *s)
{
    return s->principal_1;
}

static double compression(const rb_rolling_stress *s)
{
    return -s->principal_2;
}

static double across(const rb_rolling_stress *s)
{
    return s->syy;
}

static double along(const rb_rolling_stress *s)
{
    return s->sxx;
}

/* Of the body, and then of each bond, in its own directions. */
enum { IN_BODY = 6, OF_BOND = 4 };
static measure *const of_body[IN_BODY] = {max_shear,        tresca_shear, von_mises,
                                          orthogonal_shear, tension,      compression},
                      *const of_bond[OF_BOND] = {across, orthogonal_shear, along, along};

static measure *measure_of(int k)
{
    return k < IN_BODY ? of_body[k] : of_bond[(k - IN_BODY) % OF_BOND];
}

rb_rolling_extremum *rb_rolling_maximum(rb_rolling_stress_maxima *m, int k)
{
    rb_rolling_extremum *const all[IN_BODY] = {&m->max_shear, &m->tresca_shear,
                                               &m->von_mises, &m->orthogonal_shear,
                                               &m->tension,   &m->compression};
    if (k < IN_BODY)
        return all[k];
    if (k >= IN_BODY + OF_BOND * m->bonds)
        return NULL;
    const int bond = (k - IN_BODY) / OF_BOND;
    rb_rolling_extremum *const at[OF_BOND] = {&m->bond[bond].peel, &m->bond[bond].shear,
                                              &m->bond[bond].tension_above,
                                              &m->bond[bond].tension_below};
    return at[(k - IN_BODY) % OF_BOND];
}

double *rb_rolling_maximum_number(rb_rolling_stress_maxima *m, int k, int part)
{
    rb_rolling_extremum *at = rb_rolling_maximum(m, k);
    return !at ? NULL : part == 0 ? &at->value : part == 1 ? &at->x : &at->y;
}

rb_status rb_rolling_stress_maxima_alloc(int bonds, rb_rolling_stress_maxima *m)
{
    *m = (rb_rolling_stress_maxima){.bonds = bonds};
    m->bond = bonds ? calloc((size_t)bonds, sizeof *m->bond) : NULL;
    if (bonds && !m->bond) {
        m->bonds = 0;
        return RB_ENOMEM;
    }
    for (int k = 0; rb_rolling_maximum(m, k); k++)
        *rb_rolling_maximum(m, k) = (rb_rolling_extremum){
            NAN, NAN, NAN, k < IN_BODY ? RB_MATERIAL_BODY : RB_MATERIAL_LAYER};
    return RB_OK;
}

void rb_rolling_stress_maxima_free(rb_rolling_stress_maxima *m)
{
    free(m->bond);
    m->bond = NULL;
    m->bonds = 0;
}

/* The value at point i of a row; nothing where it is left out. */
static double value(const search *f, measure *of, const row *r, int i)
{
    return i < 0 || i >= r->n || is_left_out(f, f->at_s[r->first + i], r->depth)
               ? -INFINITY
               : of(&f->at[r->first + i]);
}

/* The point of the row that is nearest to s. */
static int nearest(const search *f, const row *r, double s)
{
    const double *at = f->at_s + r->first;
    int low = 0, high = r->n - 1;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        *(at[middle] > s ? &high : &low) = middle;
    }
    return s - at[low] < at[high] - s ? low : high;
}

/* 1: neither the neighbours in the row nor those in the rows beside it have more. */
static int is_peak(const search *f, measure *of, int k, int i)
{
    const row *r = &f->row[k];
    const double here = value(f, of, r, i), s = f->at_s[r->first + i];
    if (!(here > -INFINITY && value(f, of, r, i - 1) <= here && value(f, of, r, i + 1) <= here))
        return 0;
    for (int side = -1; side <= 1; side += 2) {
        const row *beside = r + side;
        if (k + side >= 0 && k + side < f->rows && beside->in == r->in &&
            value(f, of, beside, nearest(f, beside, s)) > here)
            return 0;
    }
    return 1;
}

/* From a place to the top: to the best of eight neighbours, or nearer ones where none is
 * better.  It stays in the strip, on whose boundary it may end.  A peak that is `less` than
 * enough for the best one when the steps have become small is given up. */
static rb_status climb(const search *f, measure *of, const strip *in, double step_s,
                       double step_depth, double enough, double place[2], double *top,
                       rb_message *why)
{
    enum { TRIES = 400, AROUND = 8 };
    static const double way[AROUND][2] = {{1, 0},  {-1, 0}, {0, 1}, {0, -1},
                                          {1, -1}, {-1, 1}, {1, 1}, {-1, -1}};
    const double least = 1e-10 * (f->high - f->low);
    const double given_up = 0.1 * step_s;

    for (int k = 0; k < TRIES && fmax(step_s, step_depth) > least; k++) {
        double s[AROUND], depth[AROUND];
        rb_rolling_stress at[AROUND];
        int best = -1;
        for (int i = 0; i < AROUND; i++) {
            s[i] = fmin(fmax(place[0] + way[i][0] * step_s, f->low - f->reach), f->high + f->reach);
            depth[i] = fmin(fmax(place[1] + way[i][1] * step_depth, in->top), in->bottom);
        }
        const rb_status status = stress_at(f, in, AROUND, s, depth, at, why);
        if (status != RB_OK)
            return status;
        for (int i = 0; i < AROUND; i++)
            if (!is_left_out(f, s[i], depth[i]) && of(&at[i]) > *top) {
                *top = of(&at[i]);
                best = i;
            }
        if (best >= 0) {
            place[0] = s[best];
            place[1] = depth[best];
        } else {
            step_s *= 0.5;
            step_depth *= 0.5;
            if (step_s < given_up && *top < enough)
                break;
        }
    }
    return RB_OK;
}

/* Several peaks may be nearly as high, and the highest point that was looked at need not
 * have the highest top near it. */
static rb_status maximum(const search *f, measure *of, rb_rolling_extremum *best, rb_message *why)
{
    enum { STARTS = 6 };
    int row_of = -1, point = -1;
    double limit = INFINITY, largest = best->value;

    for (int k = 0; k < STARTS; k++) {
        /* The highest peak that is lower than the last one, or behind it. */
        int next_row = -1, next = -1;
        double most = -INFINITY;
        for (int j = 0; j < f->rows; j++)
            for (int i = 0; i < f->row[j].n; i++) {
                const double here = value(f, of, &f->row[j], i);
                const int behind = j > row_of || (j == row_of && i > point);
                if ((here < limit || (here == limit && behind)) && here > most &&
                    is_peak(f, of, j, i)) {
                    next_row = j;
                    next = i;
                    most = here;
                }
            }
        if (next < 0 || most < best->value - 0.1 * fabs(best->value))
            break;
        row_of = next_row;
        point = next;
        limit = most;
        const row *r = &f->row[row_of];
        const double *s = f->at_s + r->first;
        double place[2] = {s[point], r->depth}, top = most;
        const double step_s = fmax(point > 0 ? s[point] - s[point - 1] : 0.0,
                                   point + 1 < r->n ? s[point + 1] - s[point] : 0.0);
        double step_depth = 0.0;
        for (int side = -1; side <= 1; side += 2)
            if (row_of + side >= 0 && row_of + side < f->rows && r[side].in == r->in)
                step_depth = fmax(step_depth, fabs(r[side].depth - r->depth));
        const rb_status status = climb(f, of, r->in, 0.5 * step_s, 0.5 * step_depth,
                                       best->value - 1e-3 * fabs(best->value), place, &top, why);
        if (status != RB_OK)
            return status;
        /* What is on a boundary as far as the search can tell is there. */
        for (int end = 0; end < 2; end++) {
            const double boundary = end ? r->in->bottom : r->in->top;
            rb_rolling_stress at;
            if (place[1] == boundary || fabs(place[1] - boundary) > 1e-4 * (f->high - f->low))
                continue;
            const rb_status there = stress_at(f, r->in, 1, place, &boundary, &at, why);
            if (there != RB_OK)
                return there;
            if (of(&at) >= top - 5e-7 * fabs(top)) {
                place[1] = boundary;
                top = of(&at);
            }
        }
        /* of two that rounding alone tells apart, as in a symmetric contact, that on the right */
        double xy[2];
        to_xy(f, r->in, place[0], place[1], xy);
        const double same = isfinite(largest) ? 1e-7 * fabs(largest) : 0.0;
        if (top > largest + same || (top >= largest - same && xy[0] > best->x))
            *best = (rb_rolling_extremum){top, xy[0], xy[1], r->in->material};
        largest = fmax(largest, top);
    }
    return RB_OK;
}

/* ---- At the bonds ------------------------------------------------------------------ */

/* Places along the bond: the candidates, as far from each other as fits what changes at this depth,
 * and outwards to 5 half-widths and 5 depths from the middle.  Returns how many; s: room for them.
 */
static int along_the_bond(const search *f, double depth, double *s)
{
    const double half = 0.5 * (f->high - f->low),
                 most = f->radius > 0.0 ? f->reach : fmax(f->reach, 4.0 * half + 5.0 * depth);
    int n = 0;
    for (int k = 0; k < f->candidates; k++)
        if (n == 0 || f->s[k] - s[n - 1] >= 0.1 * depth)
            s[n++] = f->s[k];
    double step = fmax(half / 50.0, 0.3 * depth);
    for (double away = f->reach; away < most && n + 2 <= f->candidates + MOST_OUTWARDS;) {
        away = fmin(away + step, most);
        s[n++] = f->low - away;
        s[n++] = f->high + away;
        step = fmin(1.2 * step, 0.05 * most);
    }
    gsl_sort(s, 1, (size_t)n);
    return n;
}

/* The highest peak of one measure among n places along a side of the bond.  What only falls off to
 * the end of the places is no peak. */
static rb_status peak_of_bond(const search *f, const strip *in, double depth, measure *of, int n,
                              const double *s, const rb_rolling_stress *at,
                              rb_rolling_extremum *best, rb_message *why)
{
    double most = 0.0, largest = 0.0;
    *best = (rb_rolling_extremum){0.0, NAN, NAN, in->material};
    for (int i = 0; i < n; i++)
        largest = fmax(largest, fmax(at[i].von_mises, fabs(at[i].hydrostatic)));
    for (int i = 1; i + 1 < n; i++)
        if (of(&at[i]) >= of(&at[i - 1]) && of(&at[i]) > of(&at[i + 1]))
            most = fmax(most, of(&at[i]));
    if (!(most > 1e-7 * largest)) /* less is what waves leave of each other */
        return RB_OK;
    for (int i = 1; i + 1 < n; i++) {
        double top = of(&at[i]), place[2] = {s[i], depth}, xy[2];
        if (!(top >= of(&at[i - 1]) && top > of(&at[i + 1]) && top > 0.9 * most))
            continue;
        const rb_status status = climb(f, of, in, 0.5 * fmax(s[i] - s[i - 1], s[i + 1] - s[i]), 0.0,
                                       (1.0 - 1e-3) * best->value, place, &top, why);
        if (status != RB_OK)
            return status;
        to_xy(f, in, place[0], place[1], xy);
        /* of two that rounding alone tells apart that on the right */
        if (top > best->value * (1.0 + 1e-7) ||
            (top >= best->value * (1.0 - 1e-7) && xy[0] > best->x))
            *best = (rb_rolling_extremum){top, xy[0], xy[1], in->material};
    }
    return RB_OK;
}

/* Peel, shear and tension along a bond, the first one being 0, if the search goes down to it; a
 * rigid base and a core have no stress of their own. */
static rb_status maxima_of_bond(search *f, int which, double searched,
                                rb_rolling_stress_maxima *maxima, rb_message *why)
{
    const rb_rolling_body *a = &f->model->rc->a;
    const int layers = rb_rolling_layers(a);
    const double bond = layers > 0 ? rb_rolling_bond_depth(a, which + 1) : a->cover;
    if (searched > 0.0 && searched < bond)
        return RB_OK;
    const int sides = which + 1 < layers || (layers > 0 && a->base_young > 0.0) ? 2 : 1;
    const strip side[2] = {layers > 0 ? strip_of(a, which, INFINITY)
                                      : (strip){RB_MATERIAL_LAYER, 0.0, bond},
                           layers > 0 ? strip_of(a, which + 1, INFINITY) : (strip){0}};
    const size_t most = (size_t)f->candidates + MOST_OUTWARDS;
    rb_arena scratch = {0};
    double *s = rb_arena_doubles(&scratch, most, 2);
    rb_rolling_stress *at = rb_arena_zeros(&scratch, most, sizeof *at);
    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    double *depth = s + most;
    const int n = along_the_bond(f, bond, s);
    for (int k = 0; k < n; k++)
        depth[k] = bond;
    rb_status status = RB_OK;
    f->along_bond = 1;
    for (int k = 0; k < sides && status == RB_OK; k++) {
        status = stress_at(f, &side[k], n, s, depth, at, why);
        for (int i = 0; i < OF_BOND && status == RB_OK; i++)
            if ((i == OF_BOND - 1) == k)
                status =
                    peak_of_bond(f, &side[k], bond, of_bond[i], n, s, at,
                                 rb_rolling_maximum(maxima, IN_BODY + which * OF_BOND + i), why);
    }
    f->along_bond = 0;
    return rb_arena_done(&scratch, status);
}

/* ---- Far from the contact ---------------------------------------------------------- */

/* A stiff layer takes up what stretches the base over a length l = d E/E_base, many times that
 * over which it bends.  Far behind the contact friction Q pulls it like l Q/x, the pressure P
 * pushes it together like (l/x)^2 P: the tension may be largest at a few l P/Q.  0: not so. */
static double far_reach(const search *f)
{
    enum { AFFORDABLE = 6000 }; /* thicknesses of the first layer: the number of its waves */
    const rb_rolling_body *a = &f->model->rc->a;
    const rb_bem_edge_load *load = rb_rolling_field_load(f->field);
    double stretched = 0.0, P = 0.0, Q = 0.0;
    for (int k = 0; k < rb_rolling_layers(a) && a->base_young > 0.0; k++)
        stretched += (rb_rolling_bond_depth(a, k + 1) - rb_rolling_bond_depth(a, k)) *
                     rb_rolling_layer_of(a, k).young / a->base_young;
    for (int j = 0; j + 1 < load->n; j++) {
        const double half = 0.5 * (load->x[j + 1] - load->x[j]);
        P += half * (load->p[j] + load->p[j + 1]);
        Q += half * (load->q[j] + load->q[j + 1]);
    }
    const double most = AFFORDABLE * rb_rolling_bond_depth(a, 1),
                 reach = fabs(Q) > 1e-3 * P ? fmin(4.0 * stretched * P / fabs(Q), most) : 0.0;
    return stretched > rb_rolling_layers_depth(a) && reach > f->reach ? reach : 0.0;
}

/* The tension along the top or the bottom of a layer, beyond what has been searched: in the body,
 * and at its bond. */
static rb_status tension_far_away(search *f, int layer, int at_bottom, int n, double *s,
                                  rb_rolling_stress *at, rb_rolling_stress_maxima *maxima,
                                  rb_message *why)
{
    const strip in = strip_of(&f->model->rc->a, layer, INFINITY);
    const double deep = at_bottom ? in.bottom : in.top;
    const int bond = layer - !at_bottom;
    rb_rolling_extremum found, *const to[2] = {&maxima->tension,
                                               bond < 0    ? NULL
                                               : at_bottom ? &maxima->bond[bond].tension_above
                                                           : &maxima->bond[bond].tension_below};
    for (int k = 0; k < n; k++)
        s[n + k] = deep;
    rb_status status = stress_at(f, &in, n, s, s + n, at, why);
    for (int i = 0; i < 2 && status == RB_OK; i++) {
        if (to[i])
            status = peak_of_bond(f, &in, deep, i ? along : tension, n, s, at, &found, why);
        if (to[i] && status == RB_OK && !isnan(found.x) &&
            !(found.value <= to[i]->value * (1.0 + 1e-7)))
            *to[i] = found;
    }
    return status;
}

static rb_status look_far(search *f, double searched, rb_rolling_stress_maxima *maxima,
                          rb_arena *memory, rb_message *why)
{
    enum { STEPS = 40 };
    const rb_rolling_body *a = &f->model->rc->a;
    const double reach = far_reach(f);
    double *s = rb_arena_doubles(memory, 2 * STEPS, 2);
    rb_rolling_stress *at = rb_arena_zeros(memory, 2 * STEPS, sizeof *at);
    if (memory->failed)
        return RB_ENOMEM;
    if (!(reach > 0.0))
        return RB_OK;
    /* they begin where the near search still was, that a peak between the two be one */
    const double from = 0.7 * f->reach;
    for (int k = 0; k < STEPS; k++) {
        const double away = from * pow(reach / from, (double)k / (STEPS - 1));
        s[STEPS - 1 - k] = f->low - away;
        s[STEPS + k] = f->high + away;
    }
    f->reach = reach;
    rb_status status = RB_OK;
    for (int k = 0; k < 2 * rb_rolling_layers(a) && status == RB_OK; k++)
        if (!(searched > 0.0 && searched < rb_rolling_bond_depth(a, k / 2 + k % 2)))
            status = tension_far_away(f, k / 2, k % 2, 2 * STEPS, s, at, maxima, why);
    return status;
}

/* Of the layers of a half-plane, the last of which lies on the base, or of a cover. */
static int bonds_of(const rb_rolling_body *a)
{
    const int layers = rb_rolling_layers(a);
    return layers > 0 ? layers : a->cover > 0.0;
}

rb_status rb_rolling_stress_maxima_find(const rb_rolling_model *model, double depth,
                                        rb_rolling_stress_maxima *maxima, rb_message *why)
{
    const rb_rolling_extremum none = {-INFINITY, NAN, NAN, RB_MATERIAL_BODY};
    rb_rolling_run run = {.last = -1};
    rb_arena memory = {0};
    search f = {.model = model};

    *maxima = (rb_rolling_stress_maxima){.bonds = 0};
    rb_status s = rb_rolling_stress_check(model->rc, why);
    if (s == RB_OK && rb_rolling_stress_maxima_alloc(bonds_of(&model->rc->a), maxima) != RB_OK)
        s = rb_fail(why, RB_ENOMEM, "out of memory for the largest stresses");
    if (s != RB_OK)
        return s;
    for (int i = 0; i < IN_BODY; i++)
        *rb_rolling_maximum(maxima, i) = none;
    if (!rb_rolling_next_patch(model->rc, &model->mesh, &model->state, 0, &run))
        return rb_fail(why, RB_NO_CONTACT, "no contact, no stress");
    rb_phase("the largest stresses");
    s = rb_rolling_field_create(model, &f.field, why);
    if (s == RB_OK)
        s = set_rows(&f, depth, &memory);
    if (s == RB_OK)
        s = leave_out_ends(&f, &memory);
    if (s == RB_OK)
        s = compute_stress(&f, why);
    for (int i = 0; i < IN_BODY && s == RB_OK; i++)
        s = maximum(&f, of_body[i], rb_rolling_maximum(maxima, i), why);
    for (int k = 0; k < maxima->bonds && s == RB_OK; k++)
        s = maxima_of_bond(&f, k, depth, maxima, why);
    if (s == RB_OK)
        s = look_far(&f, depth, maxima, &memory, why);
    rb_rolling_field_free(f.field);
    rb_arena_free(&memory);
    return s == RB_ENOMEM ? rb_fail(why, s, "out of memory for the largest stresses") : s;
}

rb_status rb_rolling_stress_maxima_at(const rb_rolling_model *model,
                                      rb_rolling_stress_maxima *maxima, rb_message *why)
{
    const int measures = IN_BODY + OF_BOND * maxima->bonds;
    rb_arena memory = {0};
    double *xy = rb_arena_doubles(&memory, (size_t)measures, 2);
    rb_rolling_stress *at = rb_arena_zeros(&memory, (size_t)measures, sizeof *at);
    int n = 0, *which = rb_arena_zeros(&memory, (size_t)measures, sizeof *which);

    if (memory.failed)
        return rb_arena_done(&memory, RB_ENOMEM);
    for (int k = 0; k < measures; k++) {
        const rb_rolling_extremum *m = rb_rolling_maximum(maxima, k);
        if (isnan(m->x)) /* a bond without it, or none */
            continue;
        xy[2 * n] = m->x;
        xy[2 * n + 1] = m->y;
        /* digits that are lost in other units must not lead to the other side of the bond */
        const rb_rolling_body *a = &model->rc->a;
        for (int j = 0; j < rb_rolling_layers(a); j++) {
            const double bond = rb_rolling_bond_depth(a, j + 1);
            if (fabs(m->y - bond) < 1e-12 * bond)
                xy[2 * n + 1] = m->material == strip_of(a, j + 1, INFINITY).material
                                    ? nextafter(bond, INFINITY)
                                    : bond;
        }
        which[n++] = k;
    }
    const rb_status s = rb_rolling_stress_at(model, n, xy, at, why);
    for (int k = 0; k < n && s == RB_OK; k++) {
        if (which[k] >= IN_BODY && !rb_rolling_body_can(&model->rc->a, RB_BODY_FLAT))
            turn(model->rc->a.radius, &at[k]);
        rb_rolling_maximum(maxima, which[k])->value = measure_of(which[k])(&at[k]);
    }
    return rb_arena_done(&memory, s);
}
