/* Flash temperature: friction heats the surfaces on their way through the contact
 * (theory-rolling.md 4.8). */
#include "bem/bem.h"
#include "lcp/contact/contact.h"
#include "rolling/case/internal.h"
#include "rolling/solve/heat.h"
#include "rolling/solve/patches.h"

#include <cblas.h>
#include <float.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_sf_bessel.h>
#include <lapacke.h>
#include <stdlib.h>
#include <string.h>

static double diffusivity(const rb_rolling_heat *body)
{
    return body->conductivity / body->heat_capacity;
}

double rb_rolling_peclet(const rb_rolling_heat *body, double speed, double half_width)
{
    return body->conductivity > 0.0 ? speed * half_width / (2.0 * diffusivity(body)) : INFINITY;
}

/* ---- One body (T1) ----------------------------------------------------------------- */

/* G(z) = z exp(z) [K0|z| + sgn(z) K1|z|] - 1, the integral of exp(t) K0|t| from 0. */
double rb_rolling_moving_source(double z)
{
    const double r = fabs(z);

    if (r == 0.0)
        return 0.0;
    if (z > 0.0)
        return r * (gsl_sf_bessel_K0_scaled(r) + gsl_sf_bessel_K1_scaled(r)) - 1.0;
    return r > 400.0
               ? -1.0
               : r * exp(-2.0 * r) * (gsl_sf_bessel_K1_scaled(r) - gsl_sf_bessel_K0_scaled(r)) -
                     1.0;
}

/* Rise at the origin from a unit heat per area and time between 0 and x, where the surface comes
 * from +x; speed < 0: from -x. */
static double rise_from_origin(const rb_rolling_heat *body, double speed, double x)
{
    const double P = speed / (2.0 * diffusivity(body)); /* odd in P: the mirror image */

    return rb_rolling_moving_source(P * x) / (M_PI * body->conductivity * P);
}

double rb_rolling_surface_speed(const rb_rolling_case *rc, int of_b, double creepage)
{
    return rc->speed * (of_b ? 1.0 + 0.5 * creepage : 1.0 - 0.5 * creepage);
}

double rb_rolling_heat_response(const rb_rolling_heat *body, double speed, double from, double to)
{
    return rise_from_origin(body, speed, to) - rise_from_origin(body, speed, from);
}

/* The surfaces of one body: rise at the midpoints from heat in the elements. */
typedef struct {
    rb_rolling_heat body;
    double speed;
    int n;
    double h;               /* of the first element */
    const double *x, *all;  /* midpoints and lengths; borrowed */
    double *response;       /* NULL, or of equal elements at distances of 1 - n ... n - 1 of
                               them; owned */
    rb_bem_convolution *by; /* the same, where transforms are sooner; owned */
    double *rows;           /* NULL, or of unequal elements: n rows; x and all that they are
                               for; owned */
} conductor;

struct rb_rolling_conduction {
    conductor a, b;
};

static void conductor_free(conductor *c)
{
    free(c->response);
    free(c->rows);
    rb_bem_convolution_free(c->by);
    *c = (conductor){.n = 0};
}

void rb_rolling_conduction_free(struct rb_rolling_conduction *conduction)
{
    if (!conduction)
        return;
    conductor_free(&conduction->a);
    conductor_free(&conduction->b);
    free(conduction);
}

static int is_alike(const rb_rolling_heat *a, const rb_rolling_heat *b)
{
    return a->conductivity == b->conductivity && a->heat_capacity == b->heat_capacity &&
           a->temperature == b->temperature;
}

/* row_j: rise at midpoint i of a unit heat per area and time in element j, which begins
 * where the one before ends. */
static void conductor_row(const conductor *c, int i, double *row)
{
    if (c->response || c->rows) {
        memcpy(row, c->rows ? &c->rows[(size_t)i * (size_t)c->n] : &c->response[c->n - 1 - i],
               (size_t)c->n * sizeof *row);
        return;
    }
    /* The response of an element is the difference of the primitive at its ends. */
    double before = rise_from_origin(&c->body, c->speed, c->x[0] - 0.5 * c->all[0] - c->x[i]);
    for (int j = 0; j < c->n; j++) {
        const double to = rise_from_origin(&c->body, c->speed, c->x[j] + 0.5 * c->all[j] - c->x[i]);
        row[j] = to - before;
        before = to;
    }
}

/* Whether the conductor is that of the same elements. */
static int is_known(const rb_rolling_heat *body, double speed, const rb_rolling_solution *s,
                    int equal, const conductor *c)
{
    const size_t n = (size_t)s->n;

    if (c->n != s->n || c->speed != speed || !is_alike(&c->body, body))
        return 0;
    return equal ? c->response && c->h == s->h[0]
                 : c->rows && memcmp(c->rows + n * n, s->x, n * sizeof *s->x) == 0 &&
                       memcmp(c->rows + n * n + n, s->h, n * sizeof *s->h) == 0;
}

/* Kept where it is that of the same elements. */
static rb_status conductor_set(const rb_rolling_case *rc, const rb_rolling_heat *body, double speed,
                               const rb_rolling_solution *s, conductor *c)
{
    /* more are sooner by transforms, and rows of more are too large to be kept */
    enum { DIRECT = 200, ROWS = 500 };
    const int n = s->n, equal = !rb_rolling_mesh_is_graded(rc) && n > 0;

    if (is_known(body, speed, s, equal, c)) {
        c->x = s->x;
        c->all = s->h;
        return RB_OK;
    }
    conductor_free(c);
    *c = (conductor){*body, speed, n, n > 0 ? s->h[0] : 0.0, s->x, s->h, NULL, NULL, NULL};
    if (!equal) {
        double *rows = n > 0 && n <= ROWS ? rb_alloc((size_t)n, (size_t)n + 2) : NULL;
        for (int i = 0; i < n && rows; i++)
            conductor_row(c, i, &rows[(size_t)i * (size_t)n]);
        if (rows) {
            memcpy(rows + n * n, s->x, (size_t)n * sizeof *rows);
            memcpy(rows + n * n + n, s->h, (size_t)n * sizeof *rows);
        }
        c->rows = rows;
        return rows || n == 0 || n > ROWS ? RB_OK : RB_ENOMEM;
    }
    /* Equal elements: the response depends on the distance alone, 1 - n ... n - 1 elements. */
    c->response = rb_alloc(2 * (size_t)n - 1, 1);
    double before = rise_from_origin(body, speed, s->h[0] * (0.5 - n));
    for (int k = 1 - n; c->response && k < n; k++) {
        const double to = rise_from_origin(body, speed, s->h[0] * (k + 0.5));
        c->response[n - 1 + k] = to - before;
        before = to;
    }
    if (c->response && n > DIRECT) { /* of distances from the heat */
        double *t = rb_alloc(2 * (size_t)n - 1, 1);
        for (int k = 0; t && k < 2 * n - 1; k++)
            t[k] = c->response[2 * n - 2 - k];
        c->by = t ? rb_bem_convolution_create(n, t) : NULL;
        free(t);
    }
    return c->response ? RB_OK : RB_ENOMEM;
}

/* T = T_0 + K H; elements without heat at the ends cost nothing. */
static rb_status warm(const conductor *c, const double *heat, double *temperature)
{
    const int n = c->n;
    const int is_kept = c->response || c->rows;
    double *own = is_kept ? NULL : rb_alloc((size_t)n, 1);
    int from = 0, to = n;

    if (!is_kept && !own)
        return RB_ENOMEM;
    if (c->by) {
        rb_bem_convolution_apply(c->by, heat, temperature);
        /* Far ahead of the heat the rise is zero, and transforms leave rounding there. */
        const double rounding = 8.0 * DBL_EPSILON * rb_norm_inf((size_t)n, temperature);
        for (int i = 0; i < n; i++)
            temperature[i] =
                c->body.temperature + (fabs(temperature[i]) > rounding ? temperature[i] : 0.0);
        return RB_OK;
    }
    while (from < to && heat[from] == 0.0)
        from++;
    while (from < to && heat[to - 1] == 0.0)
        to--;
    for (int i = 0; i < n; i++) {
        const double *row = c->response ? c->response + n - 1 - i
                            : c->rows   ? &c->rows[(size_t)i * (size_t)n]
                                        : own;
        if (own)
            conductor_row(c, i, own);
        temperature[i] = c->body.temperature + cblas_ddot(to - from, row + from, 1, heat + from, 1);
    }
    free(own);
    return RB_OK;
}

/* Levinson's recursion for m equations with t[i - j] in row i and column j; rhs becomes
 * their solution.  Moving sources have a matrix whose symmetric part is positive
 * definite, so that no pivot vanishes. */
static rb_status solve_toeplitz(int m, const double *t, double *rhs)
{
    rb_arena scratch = {0};
    /* Of the inverse of the leading equations: its first and its last column. */
    double *first = rb_arena_doubles(&scratch, (size_t)m, 1),
           *last = rb_arena_doubles(&scratch, (size_t)m, 1);

    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    for (int k = 0; k < m; k++) {
        double ahead = 0.0, behind = 0.0, missing = rhs[k];
        for (int j = 0; j < k; j++) {
            ahead += t[k - j] * first[j];
            behind += t[-1 - j] * last[j];
            missing -= t[k - j] * rhs[j];
        }
        const double pivot = k ? 1.0 - ahead * behind : t[0];
        if (!(fabs(pivot) > 0.0))
            return rb_arena_done(&scratch, RB_SINGULAR);
        memmove(last + 1, last, (size_t)k * sizeof *last);
        last[0] = k ? 0.0 : 1.0;
        first[k] = k ? 0.0 : 1.0;
        rhs[k] = 0.0;
        for (int j = 0; j <= k; j++) {
            const double f = first[j], b = last[j];
            first[j] = (f - ahead * b) / pivot;
            last[j] = (b - behind * f) / pivot;
            rhs[j] += missing * last[j];
        }
    }
    return rb_arena_done(&scratch, RB_OK);
}

/* ---- Both bodies ------------------------------------------------------------------- */

static int is_contact(const rb_rolling_solution *s, int i)
{
    return s->zone[i] != RB_ZONE_SEPARATED;
}

/* Whether there are elements in contact that follow one another. */
static int is_one_contact(const rb_rolling_solution *s)
{
    int edges = 0;

    for (int i = 0; i < s->n; i++)
        edges += is_contact(s, i) && (i == 0 || !is_contact(s, i - 1));
    return edges == 1;
}

/* In contact both surfaces are equally warm: (K_A + K_B) H_A = K_B H + T_B - T_A gives
 * the part H_A of the heat H that enters A. */
static rb_status share_heat(const conductor *a, const conductor *b, const rb_rolling_solution *s,
                            const double *heat, double *heat_a)
{
    const int n = s->n, m = s->contact, toeplitz = a->response && is_one_contact(s);
    rb_arena scratch = {0};
    double *rhs = rb_arena_doubles(&scratch, (size_t)n, 1),
           *row = toeplitz ? NULL : rb_arena_doubles(&scratch, (size_t)n, 2),
           *t = toeplitz ? rb_arena_doubles(&scratch, (size_t)m, 2) : NULL,
           *M = toeplitz ? NULL : rb_arena_doubles(&scratch, (size_t)m, (size_t)m);
    lapack_int *pivots = rb_arena_zeros(&scratch, (size_t)m, sizeof *pivots);
    rb_status status = scratch.failed ? RB_ENOMEM : warm(b, heat, heat_a);

    if (status != RB_OK)
        return rb_arena_done(&scratch, status);
    for (int i = 0, k = 0; i < n; i++)
        if (is_contact(s, i))
            rhs[k++] = heat_a[i] - a->body.temperature;
    if (toeplitz) {
        /* (K_A + K_B) x = rhs in the contact.  Of equal elements that follow one another
         * the matrix depends on distances alone. */
        for (int d = 1 - m; d < m; d++)
            t[m + d] = a->response[n - 1 - d] + b->response[n - 1 - d];
        status = solve_toeplitz(m, t + m, rhs);
    } else {
        for (int i = 0, k = 0; i < n; i++) {
            if (!is_contact(s, i))
                continue;
            conductor_row(a, i, row);
            conductor_row(b, i, row + n);
            for (int j = 0, l = 0; j < n; j++)
                if (is_contact(s, j))
                    M[(size_t)l++ * (size_t)m + (size_t)k] = row[j] + row[n + j];
            k++;
        }
        if (m > 0 && LAPACKE_dgesv_work(LAPACK_COL_MAJOR, m, 1, M, m, pivots, rhs, m) != 0)
            status = RB_SINGULAR;
    }
    for (int i = 0, k = 0; i < n; i++)
        heat_a[i] = is_contact(s, i) ? rhs[k++] : 0.0;
    return rb_arena_done(&scratch, status);
}

rb_status rb_rolling_steady_temperature(const rb_rolling_case *rc, const rb_rolling_solution *s,
                                        const double *power, const double *sign,
                                        struct rb_rolling_conduction **conduction, double *t_a,
                                        double *t_b, double *per_area_a, double *per_area_b,
                                        rb_message *why)
{
    /* A surface that rests under the contact has been warmed for ever: it takes no heat. */
    const double V_a = rb_rolling_surface_speed(rc, 0, s->creepage),
                 V_b = rb_rolling_surface_speed(rc, 1, s->creepage);
    const int n = s->n, into_a = V_a != 0.0, into_b = rc->heat_b.conductivity > 0.0 && V_b != 0.0,
              alike = into_a && into_b && V_a == V_b && is_alike(&rc->heat_a, &rc->heat_b),
              shared = into_a && into_b && !alike;
    rb_arena scratch = {0};
    double *heat = rb_arena_doubles(&scratch, (size_t)n, 1),
           *heat_a = rb_arena_doubles(&scratch, (size_t)n, 1);
    struct rb_rolling_conduction *own = *conduction ? *conduction : calloc(1, sizeof *own);
    rb_status status = !scratch.failed && own ? RB_OK : RB_ENOMEM;

    *conduction = own;
    if (status == RB_OK && !into_a && !into_b) {
        rb_arena_free(&scratch);
        return rb_refuse(why, "conductivity,conductivity-b",
                         "at a creepage of %g the surface of A rests under the contact, "
                         "and no heat enters B: it gets warmer for ever",
                         s->creepage);
    }
    if (status == RB_OK && into_a)
        status = conductor_set(rc, &rc->heat_a, V_a, s, &own->a);
    if (status == RB_OK && into_b && !alike)
        status = conductor_set(rc, &rc->heat_b, V_b, s, &own->b);
    if (status == RB_OK) {
        /* Friction heats, it never cools.  Powers of elements that begin or end the
         * contact may be negative on coarse meshes, because they hold a part of what
         * opens beside them: then the others have as much less, down to no heat. */
        double all = 0.0, heats = 0.0;

        for (int i = 0; i < n; i++) {
            all += power[i];
            heat[i] = sign[i] > 0.0 ? power[i] : sign[i] < 0.0 ? 0.0 : fmax(power[i], 0.0);
            heats += heat[i];
        }
        const double part = all > 0.0 ? all / heats : 0.0;
        for (int i = 0; i < n; i++) {
            heat[i] *= rc->speed * part;
            heat_a[i] = alike ? 0.5 * heat[i] : into_a ? heat[i] : 0.0;
        }
        if (shared)
            status = share_heat(&own->a, &own->b, s, heat, heat_a);
    }
    if (status == RB_OK && into_a)
        status = warm(&own->a, heat_a, t_a);
    for (int i = 0; i < n && status == RB_OK; i++)
        heat[i] -= heat_a[i];
    if (status == RB_OK && per_area_a) {
        memcpy(per_area_a, heat_a, (size_t)n * sizeof *heat_a);
        memcpy(per_area_b, heat, (size_t)n * sizeof *heat);
    }
    if (status == RB_OK && into_b && !alike)
        status = warm(&own->b, heat, t_b);
    /* What takes no heat has its own temperature, and in contact that of the other surface. */
    for (int i = 0; i < n && status == RB_OK; i++) {
        const int touches = is_contact(s, i);
        if (alike)
            t_b[i] = t_a[i];
        else if (!into_b)
            t_b[i] = touches ? t_a[i] : rc->heat_b.temperature;
        else if (!into_a)
            t_a[i] = touches ? t_b[i] : rc->heat_a.temperature;
    }
    rb_arena_free(&scratch);
    return status == RB_OK ? RB_OK
                           : rb_fail(why, status, "temperature: %s", rb_status_text(status));
}

/* The parabola through the warmest element in contact and its neighbours there. */
void rb_rolling_peak_temperature(int n, const double *x, const int *zone, const double *t,
                                 double *value, double *at)
{
    int k = -1;

    *value = *at = NAN;
    for (int i = 0; i < n; i++)
        if (zone[i] != RB_ZONE_SEPARATED && (k < 0 || t[i] > t[k]))
            k = i;
    if (k < 0)
        return;
    *value = t[k];
    *at = x[k];
    if (k == 0 || k == n - 1 || zone[k - 1] == RB_ZONE_SEPARATED ||
        zone[k + 1] == RB_ZONE_SEPARATED)
        return;
    const double d[2] = {x[k - 1] - x[k], x[k + 1] - x[k]};
    const double f[2] = {t[k - 1] - t[k], t[k + 1] - t[k]};
    double rise, off;
    if (!rb_rolling_vertex(d, f, &rise, &off))
        return;
    *value += rise;
    *at += off;
}

/* ---- Rolling in time --------------------------------------------------------------- */

/* So much smaller than a Peclet number of 10 the heat that spreads along the surface
 * would count by more than 1e-3. */
static const double LEAST_PECLET = 10.0;

rb_status rb_rolling_heat_track_check(const rb_rolling_case *rc, double half_width, double creepage,
                                      rb_message *why)
{
    const rb_rolling_heat *const body[2] = {&rc->heat_a, &rc->heat_b};

    for (int b = 0; b < 2; b++) {
        const double V = rb_rolling_surface_speed(rc, b, creepage),
                     peclet = rb_rolling_peclet(body[b], V, half_width);
        if (!(peclet >= LEAST_PECLET))
            return rb_refuse(
                why, "conductivity,conductivity-b",
                "in transient rolling heat conduction is computed along "
                "the depth only, which needs V a/(2 diffusivity) >= %g of each surface, "
                "got %.3g of %s, V = %.4g mm/s",
                LEAST_PECLET, peclet, b ? "B" : "A", V);
    }
    return RB_OK;
}

rb_status rb_rolling_heat_track_create(const rb_rolling_case *rc, double half_width,
                                       rb_arena *memory, rb_rolling_heat_track *track,
                                       rb_message *why)
{
    track->heat = NULL;
    track->rows = track->newest = track->known = 0;
    track->half_width = half_width;
    const double rows = track->step > 0.0 ? ceil(track->n * track->h / track->step) + 1.0 : 1.0;
    rb_status s = rb_rolling_heat_track_check(rc, half_width, 0.0, why);
    if (s == RB_OK)
        s = rb_memory_check(sizeof(double) * rows * track->n, "temperature: the heat of steps",
                            why);
    if (s != RB_OK)
        return s;
    track->rows = (int)rows;
    track->heat = rb_arena_doubles(memory, (size_t)track->rows, (size_t)track->n);
    return track->heat ? RB_OK : RB_ENOMEM;
}

void rb_rolling_heat_track_advance(rb_rolling_heat_track *t)
{
    t->newest = (t->newest + 1) % t->rows;
    t->known = t->known < t->rows ? t->known + 1 : t->rows;
}

/* What a surface takes grows like the root of its own speed. */
static double taken(const rb_rolling_case *rc, int of_b, double creepage)
{
    const rb_rolling_heat *body = of_b ? &rc->heat_b : &rc->heat_a;

    return sqrt(body->conductivity * body->heat_capacity *
                fabs(rb_rolling_surface_speed(rc, of_b, creepage) / rc->speed));
}

void rb_rolling_heat_by_effusivity(const rb_rolling_case *rc, const double *power,
                                   rb_rolling_solution *s)
{
    const double a = taken(rc, 0, s->creepage), b = taken(rc, 1, s->creepage);

    for (int i = 0; i < s->n; i++) {
        const double heat = rc->speed * power[i] + 0.0; /* not -0 */
        s->heat_a[i] = heat * a / (a + b);
        s->heat_b[i] = heat * b / (a + b);
    }
}

/* (T3) A particle at x was at x + k c when the k-th step back ended. */
void rb_rolling_heat_track_step(const rb_rolling_case *rc, const rb_contact_state *state,
                                rb_rolling_heat_track *t, double *temperature)
{
    const double *q = state->q, *lambda = state->lambda;
    const double effusivity = taken(rc, 0, state->xi) + taken(rc, 1, state->xi);
    const double unit = 2.0 * sqrt(t->step / (M_PI * rc->speed)) / effusivity;

    for (int i = 0; i < t->n; i++) {
        t->heat[(size_t)t->newest * (size_t)t->n + (size_t)i] =
            -q[i] * lambda[i] * rc->speed / t->step;
        temperature[i] = rc->heat_a.temperature;
    }
    for (int k = 0; k < t->known && k * t->step < t->n * t->h; k++) {
        /* temperature += weight times the heat of k steps ago, k c further: between
         * midpoints, and nothing beyond the last one. */
        const double weight = unit * (sqrt(k + 1.0) - sqrt(k));
        const int row = (t->newest - k + t->rows) % t->rows;
        const double *heat = t->heat + (size_t)row * (size_t)t->n;
        const double shift = k * t->step / t->h, whole = floor(shift);
        const double part = shift - whole > 1e-9 ? shift - whole : 0.0;
        const int last = t->n - 1 - (int)whole; /* its left neighbour is the last element */

        for (int i = 0; i < last; i++)
            temperature[i] +=
                weight * ((1.0 - part) * heat[i + (int)whole] + part * heat[i + (int)whole + 1]);
        if (last >= 0)
            temperature[last] += weight * (1.0 - part) * heat[t->n - 1];
    }
}
