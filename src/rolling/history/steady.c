/* From which step on a rolling contact is steady: whether all that has followed it, to the end
 * of the way, differs from it by less than a thousandth, each quantity in its own scale. */
#include "rolling/case/derived.h"
#include "rolling/history/internal.h"

#include <gsl/gsl_math.h>
#include <string.h>

static const double STEADY = 1e-3, NOTHING = 1e-9, ROUNDING = 1e-13;

rb_status rb_rolling_steady_create(int n, rb_arena *memory, rb_rolling_steady *s)
{
    *s = (rb_rolling_steady){.row = -1,
                             .p = rb_arena_doubles(memory, (size_t)n, 1),
                             .q = rb_arena_doubles(memory, (size_t)n, 1)};
    return s->q ? RB_OK : RB_ENOMEM;
}

/* How far a value is from that of the state before, in their own scale, or in `least`. */
static double apart(double a, double b, double least)
{
    const double scale = fmax(fmax(fabs(a), fabs(b)), least);
    return a == b || (isnan(a) && isnan(b)) ? 0.0 : fabs(a - b) / scale;
}

/* The same of n tractions, in the mean: where a zone ends, one element may change a lot. */
static double all_apart(int n, const double *a, const double *b, double least)
{
    double of_a = 0.0, of_b = 0.0, change = 0.0;

    for (int i = 0; i < n; i++) {
        of_a += fabs(a[i]);
        of_b += fabs(b[i]);
        change += fabs(a[i] - b[i]);
    }
    return change > 0.0 ? change / fmax(fmax(of_a, of_b), least) : 0.0;
}

void rb_rolling_steady_see(rb_rolling_steady *s, const rb_rolling_model *model,
                           const rb_rolling_history *h, double way)
{
    const rb_rolling_case *rc = model->rc;
    const rb_contact_state *state = &model->state;
    const int n = state->n, k = h->n;
    const double a = h->half_width, R = rb_rolling_radius(rc), P = h->normal_load[k],
                 warm = h->max_temperature ? h->max_temperature[k] - rc->heat_a.temperature : 0.0;
    double pressed = 0.0, rubbed = 0.0;

    for (int i = 0; i < n; i++) {
        pressed += state->p[i];
        rubbed += fabs(state->q[i]);
    }
    /* The scale of what may fade away is also the largest that it was so far, in units `per`. */
    const struct {
        double now, per;
        int fades;
    } value[RB_ROLLING_STEADY_VALUES] = {{rubbed, pressed, 1},
                                         {h->tangential_load[k], P, 1},
                                         {h->moment[k], P * a, 1},
                                         {state->xi, a / R, 1},
                                         {warm, 1.0, 1},
                                         {h->approach[k], a * a / R, 0},
                                         {P, 0.0, 0}};
    double least[RB_ROLLING_STEADY_VALUES], most = s->row < 0 ? INFINITY : 0.0;

    for (int i = 0; i < RB_ROLLING_STEADY_VALUES; i++) {
        const double part = fabs(value[i].now) / value[i].per;
        if (isfinite(part))
            s->largest[i] = fmax(s->largest[i], part);
        least[i] = value[i].per * (value[i].fades ? fmax(s->largest[i], NOTHING) : 1.0);
        /* a moment may be rounding of the pressure's where friction is next to nothing */
        if (s->row >= 0 && fabs(value[i].now - s->value[i]) > ROUNDING * value[i].per)
            most = fmax(most, apart(value[i].now, s->value[i], least[i]));
    }
    if (s->row >= 0)
        most = fmax(
            most, fmax(all_apart(n, state->p, s->p, 0.0), all_apart(n, state->q, s->q, least[0])));
    s->to = way;
    s->most = fmax(s->most, most);
    if (most <= STEADY)
        return;
    s->row = k;
    s->from = way;
    s->most = 0.0;
    memcpy(s->p, state->p, (size_t)n * sizeof *s->p);
    memcpy(s->q, state->q, (size_t)n * sizeof *s->q);
    for (int i = 0; i < RB_ROLLING_STEADY_VALUES; i++)
        s->value[i] = value[i].now;
}

/* What changes slowly stays within a thousandth for a while: the contact has to have renewed
 * itself, all of its material, and the longest memory has to have passed, unless nothing changes
 * beyond rounding. */
int rb_rolling_steady_from(const rb_rolling_steady *s, const rb_rolling_case *rc,
                           const rb_rolling_history *h)
{
    const rb_rolling_memory *const memory[2] = {&rc->a.memory, &rc->b.memory};
    double least = 2.0 * h->half_width;

    for (int b = 0; b < 1 + rc->elastic_b; b++)
        for (int k = 0; k < memory[b]->n; k++)
            if (memory[b]->ratio[k] > 0.0)
                least = fmax(least, rc->speed * memory[b]->time[k]);
    const double way = s->to - s->from;
    const int steady = way >= (1.0 - 1e-9) * least || (way > 0.0 && s->most <= NOTHING);
    return s->row >= 0 && steady ? s->row : -1;
}
