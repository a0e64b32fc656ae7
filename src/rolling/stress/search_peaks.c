/* From the points that were looked at to the tops of the peaks between them. */
#include "rolling/stress/search.h"

#include <math.h>

/* The value at point i of a row; nothing where it is left out. */
static double value(const rb_search *f, rb_search_measure *of, const rb_search_row *r, int i)
{
    return i < 0 || i >= r->n || rb_search_leaves_out(f, f->at_s[r->first + i], r->depth)
               ? -INFINITY
               : of(&f->at[r->first + i]);
}

/* The point of the row that is nearest to s. */
static int nearest(const rb_search *f, const rb_search_row *r, double s)
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
static int is_peak(const rb_search *f, rb_search_measure *of, int k, int i)
{
    const rb_search_row *r = &f->row[k];
    const double here = value(f, of, r, i), s = f->at_s[r->first + i];
    if (!(here > -INFINITY && value(f, of, r, i - 1) <= here && value(f, of, r, i + 1) <= here))
        return 0;
    for (int side = -1; side <= 1; side += 2) {
        const rb_search_row *beside = r + side;
        if (k + side >= 0 && k + side < f->rows && beside->in == r->in &&
            value(f, of, beside, nearest(f, beside, s)) > here)
            return 0;
    }
    return 1;
}

/* To the best of eight neighbours, or nearer ones where none is better.  It stays in the strip, on
 * whose boundary it may end. */
rb_status rb_search_climb(const rb_search *f, rb_search_measure *of, const rb_search_strip *in,
                          double step_s, double step_depth, double enough, double place[2],
                          double *top, rb_message *why)
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
        const rb_status status = rb_search_stress(f, in, AROUND, s, depth, at, why);
        if (status != RB_OK)
            return status;
        for (int i = 0; i < AROUND; i++)
            if (!rb_search_leaves_out(f, s[i], depth[i]) && of(&at[i]) > *top) {
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

/* A peak among the points: point i of row k. */
typedef struct {
    int row, i;
    double height;
} peak;

/* Goes on to the highest peak that is lower than the last one, or behind it; 0: there is none. */
static int next_peak(const rb_search *f, rb_search_measure *of, peak *last)
{
    peak next = {-1, -1, -INFINITY};

    for (int k = 0; k < f->rows; k++)
        for (int i = 0; i < f->row[k].n; i++) {
            const double here = value(f, of, &f->row[k], i);
            const int behind = k > last->row || (k == last->row && i > last->i);
            if ((here < last->height || (here == last->height && behind)) && here > next.height &&
                is_peak(f, of, k, i))
                next = (peak){k, i, here};
        }
    if (next.row >= 0)
        *last = next;
    return next.row >= 0;
}

/* What is on a boundary of the strip as far as the search can tell is there. */
static rb_status move_to_boundary(const rb_search *f, rb_search_measure *of,
                                  const rb_search_strip *in, double place[2], double *top,
                                  rb_message *why)
{
    for (int end = 0; end < 2; end++) {
        const double boundary = end ? in->bottom : in->top;
        rb_rolling_stress at;
        if (place[1] == boundary || fabs(place[1] - boundary) > 1e-4 * (f->high - f->low))
            continue;
        const rb_status s = rb_search_stress(f, in, 1, place, &boundary, &at, why);
        if (s != RB_OK)
            return s;
        if (of(&at) >= *top - 5e-7 * fabs(*top)) {
            place[1] = boundary;
            *top = of(&at);
        }
    }
    return RB_OK;
}

void rb_search_keep(const rb_search *f, const rb_search_strip *in, const double place[2],
                    double top, double *largest, rb_rolling_extremum *best)
{
    const double same = isfinite(*largest) ? 1e-7 * fabs(*largest) : 0.0;
    double xy[2];

    rb_search_xy(f, in, place[0], place[1], xy);
    if (top > *largest + same || (top >= *largest - same && xy[0] > best->x))
        *best = (rb_rolling_extremum){top, xy[0], xy[1], in->material};
    *largest = fmax(*largest, top);
}

/* Several peaks may be nearly as high, and the highest point that was looked at need not
 * have the highest top near it. */
rb_status rb_search_maximum(const rb_search *f, rb_search_measure *of, rb_rolling_extremum *best,
                            rb_message *why)
{
    enum { STARTS = 6 };
    peak from = {-1, -1, INFINITY};
    double largest = best->value;
    rb_status status = RB_OK;

    for (int k = 0; k < STARTS && status == RB_OK; k++) {
        if (!next_peak(f, of, &from) || from.height < best->value - 0.1 * fabs(best->value))
            break;
        const rb_search_row *r = &f->row[from.row];
        const double *s = f->at_s + r->first;
        double place[2] = {s[from.i], r->depth}, top = from.height, step_depth = 0.0;
        const double step_s = fmax(from.i > 0 ? s[from.i] - s[from.i - 1] : 0.0,
                                   from.i + 1 < r->n ? s[from.i + 1] - s[from.i] : 0.0);
        for (int side = -1; side <= 1; side += 2)
            if (from.row + side >= 0 && from.row + side < f->rows && r[side].in == r->in)
                step_depth = fmax(step_depth, fabs(r[side].depth - r->depth));
        status = rb_search_climb(f, of, r->in, 0.5 * step_s, 0.5 * step_depth,
                                 best->value - 1e-3 * fabs(best->value), place, &top, why);
        if (status == RB_OK)
            status = move_to_boundary(f, of, r->in, place, &top, why);
        if (status == RB_OK)
            rb_search_keep(f, r->in, place, top, &largest, best);
    }
    return status;
}
