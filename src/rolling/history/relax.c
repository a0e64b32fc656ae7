/* Viscoelastic bodies, step by step (theory-bodies.md V5, V6).  In a step each of them behaves
 * like an elastic body that is softer than the glassy one and has an initial displacement
 * from earlier loads.  Filtered tractions are stored, not displacements: tractions move
 * with the material and are zero where there was no load, while displacements are nonzero
 * everywhere. */
#include "rolling/body/internal.h"
#include "rolling/body/surface.h"
#include "rolling/case/derived.h"
#include "rolling/history/internal.h"

#include <cblas.h>
#include <gsl/gsl_math.h>
#include <string.h>

/* ---- One term over one step (V6) --------------------------------------------------- */

/* The dashpot of a term loses in a step (1/tau) int e F e dt, where e, the traction less
 * the filtered one, is e_0 exp(-t/tau) + d b(t) for a change d of the traction: factors
 * of e_0 F e_0, 2 e_0 F d and d F d (V7). */
static void loss_factors(double time, double step, double factor[3])
{
    const double r = step / time, faded = -expm1(-r), twice = -expm1(-2.0 * r);

    factor[0] = 0.5 * twice;
    if (r < 1e-2) {
        factor[1] = r * (0.5 - r * (0.5 - r * 7.0 / 24.0));
        factor[2] = r * (1.0 / 3.0 - r * (1.0 / 4.0 - r * (7.0 / 60.0 - r / 24.0)));
    } else {
        factor[1] = 0.5 * faded * faded / r;
        factor[2] = (r - 2.0 * faded + 0.5 * twice) / (r * r);
    }
}

static void soften(rb_rolling_body *body, double step)
{
    /* Compliance of a step over the glassy one. */
    double sum = 1.0;

    for (int k = 0; k < body->memory.n; k++)
        sum += body->memory.ratio[k] *
               (isinf(step) ? 1.0 : rb_bem_fading_over(body->memory.time[k], step).after);
    body->young /= sum;
    body->memory.n = 0;
}

rb_rolling_case rb_rolling_memory_case(const rb_rolling_case *rc, double step)
{
    rb_rolling_case elastic = *rc;

    soften(&elastic.a, step);
    soften(&elastic.b, step);
    return elastic;
}

/* ---- The past ---------------------------------------------------------------------- */

void rb_rolling_memory_track_free(rb_rolling_memory_track *r)
{
    for (int b = 0; b < 2; b++) {
        rb_bem_flexibility_free(&r->body[b].f);
    }
    memset(r, 0, sizeof *r);
}

static rb_status add_body(const rb_rolling_case *rc, const rb_rolling_body *body, double sign,
                          const rb_rolling_mesh *mesh, rb_arena *memory, rb_rolling_memory_track *r,
                          rb_message *why)
{
    rb_rolling_relaxing *own = &r->body[r->bodies];

    if (body->memory.n == 0)
        return RB_OK;
    *own = (rb_rolling_relaxing){.memory = &body->memory, .sign = sign};
    own->past = rb_arena_doubles(memory, 2 * (size_t)r->all, (size_t)body->memory.n);
    r->bodies++;
    /* Alone, in its own frame.  Of what rolls by transforms, because there may be many
     * elements behind the mesh. */
    if (!own->past)
        return RB_ENOMEM;
    const rb_rolling_plan plan = rb_rolling_plan_of(rc);
    rb_rolling_body glassy = *body;
    rb_rolling_body_flexibility made = {0};

    glassy.memory.n = 0;
    if (r->tail > 0) {
        const rb_bem_surface surface = rb_rolling_surface_of(rc, &glassy, NULL);
        own->datum = surface.datum;
        own->raises = surface.thickness > 0.0
                          ? 0.0
                          : (1.0 - surface.material.poisson) / (M_PI * surface.material.shear);
        return rb_bem_flexibility_toeplitz(mesh->n, mesh->ends, &surface, &own->f, why);
    }
    const rb_status s =
        rb_rolling_kind_of(&glassy)->flexibility(rc, &plan, &glassy, mesh, &made, why);
    rb_bem_system_free(made.system);
    own->f = made.f;
    return s;
}

rb_status rb_rolling_memory_track_create(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                         int tail, rb_arena *memory, rb_rolling_memory_track *r,
                                         rb_message *why)
{
    /* The mesh with a tail of elements behind it, where particles are that have left it. traction:
     * of both directions on all elements; force: P and Q of the last steps; scratch: four arrays of
     * both directions. */
    const size_t all = (size_t)(mesh->n + tail);
    const rb_rolling_mesh longer = {.n = (int)all, .ends = rb_arena_doubles(memory, all + 2, 1)};

    *r = (rb_rolling_memory_track){.n = mesh->n,
                                   .tail = tail,
                                   .all = (int)all,
                                   .h = mesh->ends[1] - mesh->ends[0],
                                   .traction = rb_arena_doubles(memory, 2 * all, 1),
                                   .force = rb_arena_doubles(memory, (size_t)tail + 1, 2),
                                   .scratch = rb_arena_doubles(memory, 2 * all + 2, 4)};
    rb_status s = memory->failed ? RB_ENOMEM : RB_OK;
    if (s == RB_OK) {
        /* The tail lies behind the mesh, towards -x, in elements of the same length. */
        for (int i = 0; i < tail; i++)
            longer.ends[i] = mesh->ends[0] - (tail - i) * r->h;
        memcpy(longer.ends + tail, mesh->ends, ((size_t)mesh->n + 2) * sizeof(double));
        s = add_body(rc, &rc->a, 1.0, &longer, memory, r, why);
    }
    if (s == RB_OK && rc->elastic_b)
        s = add_body(rc, &rc->b, -1.0, &longer, memory, r, why);
    return s == RB_ENOMEM
               ? rb_fail(why, s, "out of memory for the past of %d elements", mesh->n + tail)
               : s;
}

/* Numbers of one body at each of its terms, of the tractions, and the energy. */
static size_t past_size(const rb_rolling_memory_track *r, int b)
{
    return 2 * (size_t)r->all * (size_t)r->body[b].memory->n;
}

size_t rb_rolling_memory_track_size(const rb_rolling_memory_track *r)
{
    size_t size = 2 * (size_t)r->all + 1;

    for (int b = 0; b < r->bodies; b++)
        size += past_size(r, b);
    return size;
}

/* The past of all bodies and the tractions, one after the other in `numbers`, there or back. */
static void copy_past(const rb_rolling_memory_track *r, double *numbers, int back)
{
    for (int b = 0; b <= r->bodies; b++) {
        double *own = b < r->bodies ? r->body[b].past : r->traction;
        const size_t size = b < r->bodies ? past_size(r, b) : 2 * (size_t)r->all;
        if (own)
            memcpy(back ? own : numbers, back ? numbers : own, size * sizeof *own);
        numbers += size;
    }
}

void rb_rolling_memory_track_save(const rb_rolling_memory_track *r, double *numbers)
{
    numbers[0] = r->lost;
    copy_past(r, numbers + 1, 0);
}

void rb_rolling_memory_track_restore(rb_rolling_memory_track *r, double *numbers)
{
    r->lost = numbers[0];
    copy_past(r, numbers + 1, 1);
}

/* Values of both directions move by one element towards -x; nothing comes from +x. */
static void move_one_element(int n, double *values)
{
    memmove(values, values + 1, (2 * (size_t)n - 1) * sizeof *values);
    values[n - 1] = values[2 * n - 1] = 0.0;
}

/* Tractions on a body in its own frame: B is mirrored, its tangent points towards -x. */
static void mirror(const rb_rolling_relaxing *body, int n, const double *on_a, double *own)
{
    memcpy(own, on_a, (size_t)n * sizeof *own);
    for (int i = n; i < 2 * n; i++)
        own[i] = body->sign * on_a[i];
}

/* Loads that have moved on raise the whole contact alike (V2): sum over the steps before of
 * their forces, faded as in (V6).  The state at rest has no interval of its own. */
static void raise(const rb_rolling_memory_track *r, rb_rolling_relaxing *body, double step)
{
    const int known = r->rolled < r->tail ? r->rolled + 1 : r->tail + 1;

    for (int way = 0; way < 2; way++) {
        body->raised_before[way] = body->raised[way];
        body->raised[way] = 0.0;
    }
    for (int k = 0; k < body->memory->n; k++) {
        const rb_bem_fading f = rb_bem_fading_over(body->memory->time[k], step);
        double kept = body->raises * body->memory->ratio[k];
        for (int j = 1; j <= known; j++, kept *= f.kept) {
            const double part = f.before + (j <= r->rolled ? f.after * f.kept : 0.0),
                         weight = kept * part * rb_bem_memory_beyond_datum(j * r->h / body->datum);
            for (int way = 0; way < 2; way++)
                body->raised[way] += weight * r->force[2 * (j - 1) + way];
        }
    }
}

/* Before a step: the past moves on with the material, fades over the step, and what it and the
 * present tractions will have relaxed displaces the surfaces by w0 (V5, V6). */
void rb_rolling_memory_track_begin(rb_rolling_memory_track *r, double step, int rolls, double *w0)
{
    const int all = r->all, m = r->n + 1;
    double *own = r->scratch, *sum = own + 2 * all + 2, *w = sum + 2 * all + 2;

    if (rolls)
        move_one_element(all, r->traction);
    memset(w0, 0, 2 * (size_t)m * sizeof *w0);
    for (int b = 0; b < r->bodies; b++) {
        rb_rolling_relaxing *body = &r->body[b];
        mirror(body, all, r->traction, own);
        memset(sum, 0, 2 * (size_t)all * sizeof *sum);
        for (int k = 0; k < body->memory->n; k++) {
            const rb_bem_fading f = rb_bem_fading_over(body->memory->time[k], step);
            double *past = body->past + 2 * (size_t)k * (size_t)all;
            if (rolls)
                move_one_element(all, past);
            cblas_daxpy(2 * all, body->memory->ratio[k] * f.kept, past, 1, sum, 1);
            cblas_daxpy(2 * all, body->memory->ratio[k] * f.before, own, 1, sum, 1);
        }
        rb_bem_flexibility_apply(&body->f, sum, w);
        cblas_daxpy(m, 1.0, w + r->tail, 1, w0, 1);
        cblas_daxpy(m, body->sign, w + all + 1 + r->tail, 1, w0 + m, 1);
        if (!rolls || body->raises == 0.0)
            continue;
        raise(r, body, step);
        for (int i = 0; i < 2 * m; i++)
            w0[i] += body->raised[i >= m];
    }
}

/* x F y, the work of tractions x on the displacements of tractions y; w = F y. */
static double work_of(const rb_rolling_relaxing *body, const double *x, const double *w)
{
    const int n = body->f.n, m = body->f.m;
    double sum = 0.0;

    for (int i = 0; i < n; i++)
        sum += body->f.h[i] * (x[i] * w[i] + x[n + i] * w[m + i]);
    return sum;
}

/* After a step with the tractions p and q: the past of each term, and what its dashpot has
 * dissipated (V7). */
void rb_rolling_memory_track_end(rb_rolling_memory_track *r, double step, const double *p,
                                 const double *q)
{
    const int n = r->n, all = r->all;
    const size_t scratch = 2 * (size_t)all + 2;
    double *before = r->scratch, *after = before + scratch;
    double force[2] = {0.0, 0.0};

    for (int i = 0; i < n; i++) {
        force[0] += r->h * p[i];
        force[1] += r->h * q[i];
    }
    for (int b = 0; b < r->bodies; b++) {
        mirror(&r->body[b], all, r->traction, before);
        memset(after, 0, scratch * sizeof *after);
        for (int i = 0; i < n; i++) {
            after[r->tail + i] = p[i];
            after[all + r->tail + i] = r->body[b].sign * q[i];
        }
        /* One body from tractions `before` to `after`, both in its frame, behind which the track
         * has room. */
        const rb_rolling_relaxing *body = &r->body[b];
        const size_t size = 2 * (size_t)r->all;
        double *e = r->scratch + 2 * (size + 2), *w = e + size + 2;
        double lost = 0.0, of_change = 0.0, factor[3];

        for (int k = 0; k < body->memory->n && step > 0.0; k++) {
            const double time = body->memory->time[k], ratio = body->memory->ratio[k];
            const rb_bem_fading f = rb_bem_fading_over(time, step);
            double *past = body->past + (size_t)k * size;
            for (size_t i = 0; i < size; i++) {
                e[i] = before[i] - past[i];
                past[i] = f.kept * past[i] + f.before * before[i] + f.after * after[i];
            }
            loss_factors(time, step, factor);
            rb_bem_flexibility_apply(&body->f, e, w);
            lost +=
                ratio * (factor[0] * work_of(body, e, w) +
                         2.0 * factor[1] * (work_of(body, after, w) - work_of(body, before, w)));
            of_change += ratio * factor[2];
        }
        for (size_t i = 0; i < size; i++)
            e[i] = after[i] - before[i];
        rb_bem_flexibility_apply(&body->f, e, w);
        r->lost += lost + of_change * work_of(body, e, w);
        /* what the forces give where loads that have moved on raise the contact */
        for (int way = 0; way < 2; way++)
            r->lost +=
                0.5 * (force[way] + r->force[way]) * (body->raised[way] - body->raised_before[way]);
    }
    memset(r->traction, 0, 2 * (size_t)all * sizeof *r->traction);
    memcpy(r->traction + r->tail, p, (size_t)n * sizeof *p);
    memcpy(r->traction + all + r->tail, q, (size_t)n * sizeof *q);
    memmove(r->force + 2, r->force, 2 * (size_t)r->tail * sizeof *r->force);
    memcpy(r->force, force, sizeof force);
    r->rolled += step > 0.0;
}
