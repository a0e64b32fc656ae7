/* Strokes that are not small beside the contact: A's profile stays with A and B's with B, and both
 * wear at positions along the stroke (theory-rolling.md 4.9, W5). */
#include "base/base.h"
#include "rolling/history/internal.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <string.h>

/* Positions per half-width of the stroke; half of them are enough below half of it. */
enum { POSITIONS = 16 };

rb_status rb_rolling_stroke_create(int n, int couples, double reach, double half_width, double h,
                                   rb_rolling_stroke *k)
{
    const double long_by = reach / half_width;
    const int points = long_by <= 0.5 ? POSITIONS / 2 : POSITIONS * (int)ceil(long_by);
    const int senses = couples ? 2 : 1;
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc((size_t)points);

    *k = (rb_rolling_stroke){.positions = senses * points, .n = n, .reach = reach, .h = h};
    k->more = (int)ceil(reach / h) + 1;
    k->at = rb_arena_doubles(&k->memory, (size_t)k->positions, 1);
    k->weight = rb_arena_doubles(&k->memory, (size_t)k->positions, 1);
    k->sense = rb_arena_doubles(&k->memory, (size_t)k->positions, 1);
    k->a = rb_arena_doubles(&k->memory, (size_t)(2 * (n + k->more)), 1);
    k->start = rb_arena_doubles(&k->memory, (size_t)(2 * (n + k->more)), 1);
    k->b = k->a ? k->a + n : NULL;
    if (!rule || k->memory.failed) {
        gsl_integration_glfixed_table_free(rule);
        return RB_ENOMEM;
    }
    for (int j = 0; j < k->positions; j++) {
        gsl_integration_glfixed_point(-1.0, 1.0, (size_t)(j / senses), &k->at[j], &k->weight[j],
                                      rule);
        k->weight[j] /= 2.0 * senses; /* their sum is 1 */
        k->sense[j] = !couples ? 0.0 : j % 2 ? -1.0 : 1.0;
    }
    gsl_integration_glfixed_table_free(rule);
    return RB_OK;
}

void rb_rolling_stroke_free(rb_rolling_stroke *k)
{
    rb_arena_free(&k->memory);
    memset(k, 0, sizeof *k);
}

rb_status rb_rolling_stroke_widen(rb_rolling_stroke *k, int more)
{
    const int n = k->n + 2 * more, of_b = k->n + 2 * k->more;
    const size_t all = (size_t)(2 * (n + k->more));
    double *a = rb_arena_doubles(&k->memory, all, 1), *start = rb_arena_doubles(&k->memory, all, 1);

    if (k->memory.failed)
        return RB_ENOMEM;
    memset(a, 0, all * sizeof *a);
    memcpy(a + more, k->a, (size_t)k->n * sizeof *a);
    memcpy(a + n + more, k->b, (size_t)of_b * sizeof *a);
    k->n = n;
    k->a = a;
    k->b = a + n;
    k->start = start;
    return RB_OK;
}

/* Where an element of A lies over the midpoints of B: the one before it, and the part of the way
 * to the next. */
static int over(const rb_rolling_stroke *k, double at, int i, double *part)
{
    const double place = i + k->more + at * k->stroke / k->h;
    const int before = (int)floor(place);

    *part = place - before;
    return before;
}

void rb_rolling_stroke_depth(const rb_rolling_stroke *k, double at, double *depth)
{
    for (int i = 0; i < k->n; i++) {
        double part;
        const double *b = k->b + over(k, at, i, &part);
        depth[i] = k->a[i] + (1.0 - part) * b[0] + (part > 0.0 ? part * b[1] : 0.0);
    }
}

void rb_rolling_stroke_wear(rb_rolling_stroke *k, double rate, double share, const double *p)
{
    for (int j = 0; j < k->positions; j++)
        for (int i = 0; i < k->n; i++) {
            const double depth = rate * k->weight[j] * p[i + k->n * j];
            double part, *b = k->b + over(k, k->at[j], i, &part);
            k->a[i] += (1.0 - share) * depth;
            b[0] += share * (1.0 - part) * depth;
            if (part > 0.0)
                b[1] += share * part * depth;
        }
}

void rb_rolling_stroke_keep(rb_rolling_stroke *k)
{
    memcpy(k->start, k->a, (size_t)(2 * (k->n + k->more)) * sizeof *k->a);
}

void rb_rolling_stroke_restore(rb_rolling_stroke *k)
{
    memcpy(k->a, k->start, (size_t)(2 * (k->n + k->more)) * sizeof *k->a);
}
